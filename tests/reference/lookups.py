"""An `Environment` of given faces: filtered levels, irradiance and box mips, looked up as a GPU does it."""

import numpy as np

from cubecam.truth.shading.standard.material import Environment

from .cube_faces import direction_to_face_uv
from .sampling import mip_levels, pad_faces, sample_padded


class Levels:
    """Cubes of any sizes, looked up seamlessly bilinearly, and linearly between two of them."""

    def __init__(self, levels):
        self.padded = [pad_faces(np.asarray(level)[..., :3]) for level in levels]

    def at(self, directions, place):
        """(..., 3) at directions (..., 3); place (..., 1): the level, 1.25 for a quarter of level 2."""
        face, s, t = direction_to_face_uv(directions)
        place = np.broadcast_to(np.asarray(place, float), (*face.shape, 1))[..., 0]
        place = np.clip(place, 0, len(self.padded) - 1)
        low = np.minimum(np.floor(place).astype(int), max(len(self.padded) - 2, 0))
        result = np.zeros((*face.shape, 3))
        for level in np.unique(low):
            here = low == level
            share = (place[here] - level)[..., None]
            value = sample_padded(self.padded[level], face[here], s[here], t[here]) * (1 - share)
            if share.any():  # never beyond the last level, whose share is 0
                value = (
                    value
                    + sample_padded(self.padded[level + 1], face[here], s[here], t[here]) * share
                )
            result[here] = value
        return result


def environment_of(faces, levels=None, irradiance=None, behind=None):
    """From the faces themselves (level 0), filtered levels for roughness 1 / (count - 1) ..., and irradiance / pi.

    What is not given is black. `behind` as in `Environment`.
    """
    filtered = Levels([faces, *(levels or [])])
    mips = Levels(mip_levels(faces))
    result = Environment(
        radiance=lambda d, roughness: filtered.at(d, np.asarray(roughness) * len(levels or [])),
        mip=mips.at,
        size=np.shape(faces)[1],
    )
    if irradiance is not None:
        diffuse = Levels([irradiance])
        result.irradiance = lambda n: diffuse.at(n, 0.0)
    if behind is not None:
        result.behind = behind
    return result
