"""The bodies of glass: how they bend light and how much of it they absorb."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Ints
from ..scene.records import GlassRecord, StandardRecord
from ..scene.snapshot import Snapshot
from .state import Paths

#: What stands for an index of refraction of 0, which is infinity (KHR_materials_ior).
_INFINITE = 1e6


class Bodies:
    """Tables of all nodes: `ior` (K, 3) for red, green and blue, and `extinction` (K, 3) for each world unit."""

    def __init__(self, snapshot: Snapshot) -> None:
        materials = [snapshot.materials[n.material] for n in snapshot.nodes]
        count = len(materials)
        self.ior, self.extinction = np.ones((count, 3)), np.zeros((count, 3))
        for index, material in enumerate(materials):
            if isinstance(material, GlassRecord):
                self.ior[index] = material.ior
            elif isinstance(material, StandardRecord):
                self.ior[index] = _spread(material.numbers["ior"], material.numbers["dispersion"])
                self.extinction[index] = _extinction(
                    material.attenuation_color, material.numbers["attenuation_distance"]
                )

    def ior_around(self, paths: Paths, level: Ints) -> Array:
        """Give the index of refraction (R,) of the body at a level, 0 for the innermost; 1 outside of all bodies."""
        body = np.take_along_axis(paths.bodies, level[:, None], axis=1)[:, 0]
        channel = np.where(paths.channel < 0, 1, paths.channel)
        return np.where(body >= 0, self.ior[body, channel], 1.0)


def _spread(ior: float, dispersion: float) -> Array:
    """KHR_materials_dispersion, "Implementation": the indices of red, green and blue."""
    middle = ior if ior > 0 else _INFINITE
    half = (middle - 1) * 0.025 * dispersion
    return np.maximum(middle + half * np.array([-1.0, 0.0, 1.0]), 1.0)


def _extinction(color: Array, distance: float) -> Array:
    """KHR_materials_volume, "Attenuation": white light has the colour after the distance."""
    if not np.isfinite(distance):
        return np.zeros(3)
    # A colour of 0 lets nothing through; its logarithm must stay finite, since 0 times infinity is no number.
    return np.asarray(-np.log(np.maximum(np.asarray(color, np.float64), 1e-30)) / distance)
