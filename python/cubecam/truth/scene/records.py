"""What rays need to know of nodes, materials and surroundings: plain data that can be pickled."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from ..._core import CubeMap
from ..arrays import Array
from ..matrices import turned
from .textures import Lookup

Kind: TypeAlias = Literal["basic", "phong", "mirror", "glass", "standard"]


@dataclass
class Radiance:
    """Light from far away: nothing, a colour, or a cubemap that may be turned.

    `turn` (3, 3) goes from the world to the cube; `scale` multiplies the cube's light.
    """

    kind: Literal["none", "color", "cube"] = "none"
    color: Array = field(default_factory=lambda: np.zeros(4))
    cube: CubeMap | None = None
    turn: Array = field(default_factory=lambda: np.eye(3))
    scale: float = 1.0

    def at(self, directions: Array) -> Array:
        """Return (R, 4) for world directions (R, 3) of any length but 0.

        Cubes are looked up at level 0 and have alpha 1, since pictures show them so; a colour has its own alpha.
        """
        found = np.zeros((len(directions), 4))
        if self.kind == "color":
            found[:] = self.color
        elif self.cube is not None and len(directions):
            texels = self.cube.sample(turned(self.turn, directions))
            found[:, :3] = self.scale * texels[:, :3].astype(np.float64)
            found[:, 3] = 1
        return found


@dataclass
class BlendRecord:
    """How a surface's colour S, of alpha a, is combined with the colour D behind it (docs/conventions.md, "Blending").

    The factors matter for the mode "factors" only, which is a `cubecam.Blend`.
    """

    mode: str
    src: str = "one"
    dst: str = "zero"
    src_alpha: str = "one"
    dst_alpha: str = "zero"

    def terms(self, s: Array, a: Array, o: float | Array) -> tuple[Array, Array]:
        """Return A and B, each (R, 4): the picture becomes A + B * D in each of its four channels.

        Parameters
        ----------
        s : ndarray (R, 3)
            The surface's colour.
        a : ndarray (R, 1)
            Its alpha: opacity times the alphas of colour, map and vertices.
        o : float or ndarray (R, 1)
            Opacity times the alpha of the colour, which is `NodeRecord.opacity`.
        """
        one, zero = np.ones_like(a), np.zeros_like(a)
        none = np.zeros_like(s)
        if self.mode == "alpha":
            return _rgba(a * s, a), _rgba(1 - a, 1 - a)
        if self.mode == "alpha_keep":
            return _rgba(a * s, zero), _rgba(1 - a, one)
        if self.mode == "additive":
            return _rgba(a * s, a), _rgba(one, one)
        if self.mode == "multiply":
            return _rgba(none, zero), _rgba(1 - a + a * s, one)
        if self.mode == "premultiplied":
            return _rgba(o * s, a), _rgba(1 - a, 1 - a)
        return (
            _rgba(_factor(self.src, s, a) * s, _factor(self.src_alpha, a, a) * a),
            _rgba(_factor(self.dst, s, a), _factor(self.dst_alpha, a, a)),
        )


#: Factors of `cubecam.Blend` with which the result stays A + B * D.
LINEAR_FACTORS = (
    "zero",
    "one",
    "src_color",
    "one_minus_src_color",
    "src_alpha",
    "one_minus_src_alpha",
)


def _factor(name: str, s: Array, a: Array) -> Array:
    """Return a factor of OpenGL 4.5, section 17.3.6; for alphas `s` is the alpha."""
    if name == "zero":
        return np.zeros_like(s)
    if name == "src_color":
        return s
    if name == "one_minus_src_color":
        return 1 - s
    if name == "src_alpha":
        return np.broadcast_to(a, s.shape)
    if name == "one_minus_src_alpha":
        return np.broadcast_to(1 - a, s.shape)
    return np.ones_like(s)  # "one", and "src_alpha_saturate" for alphas


def _rgba(color: Array, alpha: Array) -> Array:
    return np.concatenate([np.broadcast_to(color, (len(alpha), 3)), alpha], axis=1)


@dataclass
class BasicRecord:
    """A `BasicMaterial`; maps are None where the mesh does not show them."""

    color: Array
    map: Lookup | None
    cubemap: CubeMap | None


@dataclass
class PhongRecord:
    """A `PhongMaterial`."""

    color: Array
    ka: float
    kd: float
    ks: float
    shininess: float
    map: Lookup | None


@dataclass
class MirrorRecord:
    """A `MirrorMaterial`."""

    tint: Array
    env_weight: float
    color: Array
    color_weight: float
    f0: float | None


@dataclass
class GlassRecord:
    """A `GlassMaterial`."""

    ior: float
    fresnel: bool
    tint: Array
    roughness: float
    dispersion: float
    attenuation_distance: float
    attenuation_color: Array


@dataclass
class StandardRecord:
    """A `StandardMaterial`: its numbers by their names, the maps that the mesh shows, and whether it has tangents."""

    color: Array
    emissive: Array
    specular_color: Array
    sheen_color: Array
    attenuation_color: Array
    numbers: dict[str, float]
    maps: dict[str, Lookup]
    tangents: bool
    alpha_mode: str | None
    unlit: bool
    specular: str
    specular_samples: int
    multiple_scattering: bool

    @property
    def holes(self) -> bool:
        """Whether the surface has holes where its alpha is below the cutoff."""
        return self.alpha_mode == "mask"


MaterialRecord: TypeAlias = BasicRecord | PhongRecord | MirrorRecord | GlassRecord | StandardRecord


@dataclass
class NodeRecord:
    """A visible node with a mesh.

    `material` and `surroundings` are places in the lists of the snapshot. `visible` is False for nodes that the picture
    excludes: the camera does not see them, but they cast shadows and are reflected. `opacity` is the material's opacity
    times the alpha of its colours, the "o" of docs/conventions.md. `blend` is None for opaque surfaces. `scale` (3,)
    are the lengths of the columns of the matrix. `label` is the user's number.
    """

    id: int
    label: int
    name: str
    material: int
    kind: Kind
    surroundings: int
    double_sided: bool
    receive_shadow: bool
    casts_shadow: bool
    in_captures: bool
    visible: bool
    blend: BlendRecord | None
    opacity: float
    scale: Array
