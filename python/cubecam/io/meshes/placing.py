"""Parts at their places: positions, normals and winding under matrices, also mirroring and singular ones."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .parts import Part

Matrices = npt.NDArray[np.float64]


def placed(part: Part, matrices: Matrices) -> Part:
    """Repeat a part for each of (N, 4, 4) matrices, column vectors; what was outside stays outside under a mirror."""
    times, vertices = len(matrices), len(part.positions)
    linear = matrices[:, :3, :3]
    positions = products(part.positions, linear) + matrices[:, None, :3, 3]
    mirrored = np.linalg.det(linear)[:, None, None] < 0
    normals = None
    if part.normals is not None:
        # Normals are transformed by the inverse transpose, which the cofactors are up to a positive factor; under a
        # mirror that factor is negative.
        normals = products(part.normals, np.where(mirrored, -1.0, 1.0) * cofactors(linear))
        normals = normals.reshape(-1, 3)
    tangents = None
    if part.tangents is not None:
        # Their fourth number is a factor of the cross product of normal and tangent, which a mirror turns round.
        signs = np.where(mirrored, -1.0, 1.0) * part.tangents[None, :, 3:]
        tangents = np.concatenate([products(part.tangents[:, :3], linear), signs], axis=2).reshape(
            -1, 4
        )
    # A mirror turns counter-clockwise into clockwise.
    faces = np.where(mirrored, part.faces[:, ::-1], part.faces)
    return Part(
        positions.reshape(-1, 3),
        (faces + np.arange(times)[:, None, None] * vertices).reshape(-1, 3),
        normals,
        _repeated(part.uvs, times),
        _repeated(part.colors, times),
        _repeated(part.uvs1, times),
        tangents,
    )


def products(points: Matrices, linear: Matrices) -> Matrices:
    """Multiply (V, 3) points by (N, 3, 3) matrices: (N, V, 3)."""
    # `@` would start threads of BLAS, which take ten times the CPU time for such small matrices.
    result: Matrices = np.einsum("vj,nij->nvi", points, linear)
    return result


def cofactors(linear: Matrices) -> Matrices:
    """Return the cofactors of (N, 3, 3) matrices: the inverse transpose up to a factor, also of a singular matrix."""
    a, b, c = linear[:, 0], linear[:, 1], linear[:, 2]
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)


def _repeated(values: Matrices | None, times: int) -> Matrices | None:
    return values if values is None or times == 1 else np.tile(values, (times, 1))
