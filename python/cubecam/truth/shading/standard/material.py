"""Parameters of the material, the geometry that it shades, and what surrounds it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..vectors import Array, dot, normalised


@dataclass
class Parameters:
    """Numbers of StandardMaterial with the texels of its maps multiplied in: scalars (..., 1), colours (..., 3).

    `occlusion` is the red channel of its map after `occlusion_strength`, see `occluded`; `iridescence_thickness` is
    in nanometres; `anisotropy_direction` (..., 2) is in the tangent frame, see `anisotropy_direction`.
    """

    color: Any = (1.0, 1.0, 1.0)
    metallic: Any = 1.0
    roughness: Any = 1.0
    occlusion: Any = 1.0
    emissive: Any = (0.0, 0.0, 0.0)
    emissive_strength: Any = 1.0
    ior: Any = 1.5
    specular_weight: Any = 1.0
    specular_color: Any = (1.0, 1.0, 1.0)
    clearcoat: Any = 0.0
    clearcoat_roughness: Any = 0.0
    sheen_color: Any = (0.0, 0.0, 0.0)
    sheen_roughness: Any = 0.0
    iridescence: Any = 0.0
    iridescence_ior: Any = 1.3
    iridescence_thickness: Any = 400.0
    anisotropy: Any = 0.0
    anisotropy_direction: Any = (1.0, 0.0)
    transmission: Any = 0.0
    thickness: Any = 0.0
    attenuation_distance: Any = np.inf
    attenuation_color: Any = (1.0, 1.0, 1.0)
    dispersion: Any = 0.0
    unlit: bool = False
    specular: str = "levels"
    specular_samples: int = 16
    multiple_scattering: bool = True


@dataclass
class Surface:
    """What each pixel sees, arrays (..., 3): its place, the way to the viewer, and three normals on the viewer's side.

    `n` has the normal map in it, `clearcoat_n` the clear coat's (without one it is the geometric normal).
    `tangent` (..., 4) is the mesh's, with the sign of the bitangent. `scale` are the lengths of the model matrix'
    columns.
    """

    position: Any
    v: Any
    geometric_n: Any
    n: Any = None
    clearcoat_n: Any = None
    tangent: Any = None
    scale: Any = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        self.n = self.geometric_n if self.n is None else self.n
        self.clearcoat_n = self.geometric_n if self.clearcoat_n is None else self.clearcoat_n


def _nothing(directions: Array, *_: Any) -> Array:
    return np.zeros(np.shape(directions))


@dataclass
class Environment:
    """Lookups of light from far away: of radiance filtered by roughness, of irradiance / pi, of box mips, and behind.

    radiance(directions (..., 3), roughness); irradiance(normals); mip(directions, lod) of a cube with `size` texels
    along an edge; behind(exit points, directions, roughness). Scalars are (..., 1), results (..., 3).
    """

    radiance: Any = _nothing
    irradiance: Any = _nothing
    mip: Any = _nothing
    size: int = 1
    behind: Any = field(default=_nothing)

    def with_ambient(self, ambient: Any) -> Environment:
        """The same with a uniform radiance from all sides added: an ambient light is nothing else."""
        if not np.any(ambient):
            return self
        return Environment(
            lambda d, roughness: self.radiance(d, roughness) + ambient,
            lambda n: self.irradiance(n) + ambient,
            lambda d, lod: self.mip(d, lod) + ambient,
            self.size,
            self.behind,
        )


def occluded(texel: Any, strength: Any) -> Array:
    """Section 3.9.3: 1 + strength (texel - 1)."""
    result: Array = 1 + strength * (np.asarray(texel, float) - 1)
    return result


def bitangent(n: Array, tangent: Array) -> Array:
    """Section 3.7.2.1: cross(normal, tangent.xyz) * tangent.w."""
    return np.cross(n, tangent[..., :3]) * tangent[..., 3:]


def mapped_normal(n: Array, tangent: Array, texel: Any, scale: Any = 1.0) -> Array:
    """Section 3.9.3: the texel (..., 3) from 0..1 to -1..1, x and y times the scale, in the tangent frame.

    A texel without a length gives the normal n.
    """
    x, y, z = np.moveaxis(2 * np.asarray(texel, float)[..., :3] - 1, -1, 0)
    x, y, z = x[..., None] * scale, y[..., None] * scale, z[..., None]
    turned = x * tangent[..., :3] + y * bitangent(n, tangent) + z * n
    some = np.any(turned, axis=-1, keepdims=True)
    return np.where(some, normalised(np.where(some, turned, n)), n)


def anisotropy_direction(rotation: Any, texel: Any = (1.0, 0.5)) -> Array:
    """KHR_materials_anisotropy: red and green from 0..1 to -1..1, normalised, turned by a rotation in degrees.

    A texel without a length stands for (1, 0).
    """
    along = 2 * np.asarray(texel, float)[..., :2] - 1
    direction = normalised(np.where(np.any(along, axis=-1, keepdims=True), along, (1.0, 0.0)))
    x, y = direction[..., 0], direction[..., 1]
    c, s = np.cos(np.radians(rotation)), np.sin(np.radians(rotation))
    return np.stack([c * x - s * y, s * x + c * y], -1)


def anisotropy_frame(surface: Surface, direction: Any) -> tuple[Array, Array, Array]:
    """(t, b, n): the direction of more roughness, made orthogonal to the mapped normal; b stands on both."""
    direction = np.asarray(direction, float)
    along = direction[..., :1] * surface.tangent[..., :3] + direction[..., 1:] * bitangent(
        surface.geometric_n, surface.tangent
    )
    t = normalised(along - dot(along, surface.n) * surface.n)
    return t, np.cross(surface.n, t), surface.n
