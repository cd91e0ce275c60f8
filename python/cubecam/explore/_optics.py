"""What `ReflectionView` shows, as numbers: the vectors, the texel that is hit, the light that comes back."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import CubeMap
from ..io.pixels import on_color, srgb_decode
from ..optics import fresnel, reflect, refract
from ..viewer.texels import Texel, texel_of
from ._lobe import density, lobe

__all__ = ["Facts", "Plane", "facts_of"]

Floats = npt.NDArray[np.float64]

#: How many facets of a rough surface are followed.
FACETS = 512


@dataclass(frozen=True)
class Plane:
    """The plane of the diagram: through the middle of the cube, upright, turned by `azimuth` degrees about +Y."""

    azimuth: float

    @property
    def axes(self) -> Floats:
        """Two directions of the world, (2, 3): to the right in the diagram (+X at azimuth 0), and up."""
        a = math.radians(self.azimuth)
        return np.array([[math.cos(a), 0.0, -math.sin(a)], [0.0, 1.0, 0.0]])

    @property
    def reach(self) -> tuple[float, float]:
        """Half the width and half the height at which the plane cuts the cube of half extent 1."""
        a = math.radians(self.azimuth)
        return 1 / max(abs(math.cos(a)), abs(math.sin(a))), 1.0

    def world(self, flat: npt.ArrayLike) -> Floats:
        """Convert (..., 2) in the diagram, y up, to (..., 3) in the world."""
        return np.asarray(np.asarray(flat, float) @ self.axes)

    def flat(self, world: npt.ArrayLike) -> Floats:
        """Convert (..., 3) in the world to (..., 2) in the diagram: what is out of the plane is seen from the front."""
        return np.asarray(np.asarray(world, float) @ self.axes.T)


def turned(degrees: float) -> Floats:
    """Give (2,): up in the diagram, turned counter-clockwise."""
    a = math.radians(degrees)
    return np.array([-math.sin(a), math.cos(a)])


@dataclass(frozen=True)
class Facts:
    """All that one picture of the diagram says; directions are (3,) in the world, of length 1."""

    incident: Floats
    normal: Floats
    reflected: Floats
    refracted: Floats | None
    cosine: float
    behind: bool
    eta: float
    share: float
    critical: float | None
    hit: Texel
    spread: Floats
    spread_color: Floats
    color: Floats
    mode: str
    roughness: float

    @property
    def facing(self) -> Floats:
        """The normal on the side that the light comes from."""
        return -self.normal if self.behind else self.normal

    @property
    def main(self) -> Floats:
        """The direction whose texel is `hit`: R, or T where light is refracted."""
        use = self.mode == "refraction" and self.refracted is not None
        return self.refracted if use and self.refracted is not None else self.reflected

    def outline(self, plane: Plane, count: int = 721) -> Floats:
        """Give the lobe's section with the plane, (count, 2): its greatest length is 1. Empty for a smooth surface."""
        if not self.roughness:
            return np.zeros((0, 2))
        around = np.linspace(0, 2 * np.pi, count)
        flat = np.stack([np.cos(around), np.sin(around)], axis=-1)
        through = self.mode == "refraction" and self.refracted is not None
        dense = density(
            plane.world(flat), self.incident, self.facing, self.roughness**2,
            self.eta if through else None,
        )  # fmt: skip
        return np.asarray(flat * (dense / max(float(dense.max()), 1e-300))[:, None])


def facts_of(
    environment: CubeMap,
    plane: Plane,
    angle: float,
    eye: float,
    ior: float,
    roughness: float,
    mode: str,
) -> Facts:
    """Compute everything from what can be set."""
    incident, normal = plane.world(-turned(eye)), plane.world(turned(angle))
    cosine = float(normal @ incident)
    behind = cosine > 0
    facing = -normal if behind else normal
    # n_outside / n_inside, seen from the side of the light: the body is on the side that N turns its back to.
    eta = ior if behind else 1 / ior
    reflected = np.asarray(reflect(incident, normal), float)
    bent = np.asarray(refract(incident, facing, eta), float)
    refracted = bent if mode == "refraction" and bent.any() else None
    share = float(fresnel(incident, facing, eta))
    critical = math.degrees(math.asin(1 / eta)) if eta > 1 else None
    main = reflected if refracted is None else refracted
    spread, weights = np.zeros((0, 3)), np.zeros(0)
    if roughness:
        through = None if refracted is None else eta
        spread, weights = lobe(incident, facing, roughness**2, FACETS, through)
    seen = _light(environment, main, spread, weights)
    color = seen
    if refracted is not None:
        back: tuple[Any, Any] = (np.zeros((0, 3)), np.zeros(0))
        if roughness:
            back = lobe(incident, facing, roughness**2, FACETS, None)
        color = share * _light(environment, reflected, *back) + (1 - share) * seen
    return Facts(
        incident, normal, reflected, refracted, cosine, behind, eta, share, critical,
        texel_of(environment, main), spread, seen, color, mode, roughness,
    )  # fmt: skip


def _light(environment: CubeMap, mirror: Floats, spread: Floats, weights: Floats) -> Floats:
    """Give the linear light from one direction, or the weighted mean of a spread of directions."""
    if not len(spread) or not weights.sum():
        spread, weights = mirror[None], np.ones(1)
    values = environment.sample(spread)
    if environment.encoding == "srgb":
        values = on_color(srgb_decode, values)
    return np.asarray((values * weights[:, None]).sum(axis=0) / weights.sum(), float)
