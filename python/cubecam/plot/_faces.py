"""Where the six faces lie: the table of OpenGL's specification, its edges, and the cells of a cross.

Everything here is numpy and follows from the table in docs/conventions.md (OpenGL 4.6, section 8.13).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._checks import text_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..typing import Convention

NAMES = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")

_X, _Y, _Z = np.eye(3)

# One matrix (3, 3) for each face: its rows, multiplied by a direction, give sc, tc and ma.
TABLE = np.array(
    [
        [-_Z, -_Y, _X],
        [_Z, -_Y, -_X],
        [_X, _Z, _Y],
        [_X, -_Z, -_Y],
        [_X, -_Y, _Z],
        [-_X, -_Y, -_Z],
    ]
)

Array = npt.NDArray[Any]


def texels_of(directions: npt.ArrayLike, size: int) -> tuple[Array, Array, Array]:
    """Give the face, row and column of the texels that directions (..., 3) meet."""
    r = np.asarray(directions, float)
    axis = np.abs(r).argmax(axis=-1)
    face = 2 * axis + (np.take_along_axis(r, axis[..., None], axis=-1)[..., 0] < 0)
    sc, tc, ma = np.moveaxis(np.einsum("...kx,...x->...k", TABLE[face], r), -1, 0)
    column, row = (
        np.clip(((place / ma + 1) / 2 * size).astype(int), 0, size - 1) for place in (sc, tc)
    )
    return face, row, column


def _edges() -> list[tuple[int, int]]:
    return [(f, g) for f in range(6) for g in range(f + 1, 6) if f // 2 != g // 2]


#: The faces at each of the 12 edges.
EDGES = _edges()

#: The names of the edges, "+X|+Y" to "-Y|-Z".
EDGE_NAMES = tuple(f"{NAMES[f]}|{NAMES[g]}" for f, g in EDGES)


def edge_texels(size: int, depth: int = 0) -> tuple[Array, Array]:
    """Find the texels along both sides of the 12 edges.

    `depth` counts the texels from the edge inwards: 0 is the row at the edge itself.

    Returns two arrays (12, N, 3) of face, row, column, for the first and the second face of each edge; entries
    with the same place in both arrays are neighbours.
    """
    along = (np.arange(size) + 0.5) / size * 2 - 1
    sides: tuple[list[Array], list[Array]] = ([], [])
    for first, second in EDGES:
        # The points of the edge: 1 along the axes of both faces, `along` on the third axis.
        third = 3 - first // 2 - second // 2
        points = np.empty((size, 3))
        points[:] = TABLE[first, 2] + TABLE[second, 2]
        points[:, third] = along
        for side, face, other in ((sides[0], first, second), (sides[1], second, first)):
            # One step inwards from the edge lowers the component along the other face's axis.
            inwards = points - (2 * depth + 1) / size * TABLE[other, 2]
            place = (inwards @ TABLE[face, :2].T + 1) / 2 * size
            column, row = np.floor(place).astype(int).T
            side.append(np.stack([np.full(size, face), row, column], axis=-1))
    return np.stack(sides[0]), np.stack(sides[1])


class Cell(NamedTuple):
    """One cell of a cross: the name of its place, the face of "gl" that it shows, where it is, how it is mirrored."""

    name: str
    face: int
    row: int
    column: int
    mirrored_s: bool
    mirrored_t: bool

    @property
    def right(self) -> npt.NDArray[np.float64]:
        """The direction in the world that is to the right in this cell."""
        return np.asarray(TABLE[self.face, 0] * (-1 if self.mirrored_s else 1))

    @property
    def down(self) -> npt.NDArray[np.float64]:
        """The direction in the world that is downwards in this cell."""
        return np.asarray(TABLE[self.face, 1] * (-1 if self.mirrored_t else 1))

    def picture(self, faces: Array) -> Array:
        """Cut this cell's picture out of faces (6, N, N, ...) in "gl"."""
        face: Array = faces[self.face]
        face = face[:, ::-1] if self.mirrored_s else face
        return face[::-1] if self.mirrored_t else face


def cells(convention: Convention) -> list[Cell]:
    """List the six cells of the horizontal cross, in the order +X -X +Y -Y +Z -Z of their names."""
    if convention not in ("gl", "inside", "three"):
        raise ValueError(
            f'convention: expected "gl", "inside" or "three", got {text_of(convention)}'
        )
    middle = (1, 5, 0, 4) if convention == "inside" else (1, 4, 0, 5)
    found = []
    for slot, name in enumerate(NAMES):
        upright = slot in (2, 3)
        row, column = (0 if slot == 2 else 2, 1) if upright else (1, middle.index(slot))
        face = slot ^ 1 if convention == "three" and slot < 2 else slot
        mirrored_s = convention == "three" or (convention == "inside" and not upright)
        found.append(Cell(name, face, row, column, mirrored_s, convention == "inside" and upright))
    return found


def cross_of(faces: Array, places: Sequence[Cell], fill: object) -> Array:
    """Arrange faces (6, N, N, ...) as a cross (3N, 4N, ...); cells without a face hold `fill`."""
    n = faces.shape[1]
    picture = np.full((3 * n, 4 * n, *faces.shape[3:]), fill, faces.dtype)
    for cell in places:
        rows, columns = (slice(i * n, (i + 1) * n) for i in (cell.row, cell.column))
        picture[rows, columns] = cell.picture(faces)
    return picture
