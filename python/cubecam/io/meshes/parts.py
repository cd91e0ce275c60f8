"""Parts of a mesh file, each at its place in the world, and how they become one mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..._core import Mesh

#: The largest number that a mesh can hold.
LARGEST = float(np.finfo(np.float32).max)


@dataclass
class Part:
    """One geometry at its place: V vertices and T triangles.

    `positions` is (V, 3) in world units, `faces` (T, 3) with indices of vertices, counter-clockwise seen from outside.
    `normals` (V, 3) may have any length, `uvs` (V, 2) have (0, 0) at a picture's bottom-left, `colors` (V, 4) are 0..1
    with alpha. `uvs1` is a second set of `uvs`, `tangents` (V, 4) are those of `Mesh`.
    """

    positions: npt.NDArray[np.float64]
    faces: npt.NDArray[np.int64]
    normals: npt.NDArray[np.float64] | None
    uvs: npt.NDArray[np.float64] | None
    colors: npt.NDArray[np.float64] | None
    uvs1: npt.NDArray[np.float64] | None = None
    tangents: npt.NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        """Drop vertices without a place if no triangle has them, as scanners write them; else raise ValueError."""
        sound = np.asarray((np.abs(self.positions) <= LARGEST).all(axis=1))
        if sound.all():
            return
        check_indices(self.faces, len(sound))
        used = np.zeros_like(sound)
        used[self.faces] = True
        bad = np.flatnonzero(used & ~sound)
        if len(bad):
            x, y, z = self.positions[bad[0]]
            raise ValueError(
                f"expected finite positions that fit float32, got ({x:g}, {y:g}, {z:g}) as vertex {bad[0]}"
            )
        self.positions = self.positions[sound]
        self.faces = (np.cumsum(sound) - 1)[self.faces]
        for name in ("normals", "uvs", "colors", "uvs1", "tangents"):
            values = getattr(self, name)
            setattr(self, name, None if values is None else values[sound])


def check_indices(faces: npt.NDArray[np.int64], count: int) -> None:
    """Raise IndexError if triangles have other vertices than `count` ones."""
    if faces.size and (faces.min() < 0 or faces.max() >= count):
        raise IndexError(f"expected indices 0 to {count - 1}, got {faces.min()} to {faces.max()}")


def unique_positions(
    positions: npt.NDArray[np.float64],
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Give each distinct position once, in the order of first use, and each vertex's index among them."""
    # + 0.0 makes -0.0 equal to 0.0 bit for bit. Sorting whole numbers is much faster than sorting rows.
    x, y, z = (positions.astype(np.float32) + np.float32(0)).view(np.uint32).T.astype(np.uint64)
    half = np.uint64(32)
    _, columns = np.unique(x << half | y, return_inverse=True)
    _, first, inverse = np.unique(
        columns.reshape(-1).astype(np.uint64) << half | z, return_index=True, return_inverse=True
    )
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return positions[first[order]], rank[inverse.reshape(-1)]


def unit_normals(part: Part) -> npt.NDArray[np.float64]:
    """Return the file's normals, of length 1, and smooth ones where the file has none or vectors of length 0."""
    given = part.normals
    if given is not None:
        lengths = np.linalg.norm(given, axis=1, keepdims=True)
        sound = np.isfinite(lengths[:, 0]) & (lengths[:, 0] > 0)
        if sound.all():
            unit: npt.NDArray[np.float64] = given / lengths
            return unit
    positions, index = unique_positions(part.positions)
    computed = np.asarray(Mesh(positions, index[part.faces]).normals, dtype=np.float64)
    smooth: npt.NDArray[np.float64] = computed[index]
    if given is not None:
        smooth[sound] = given[sound] / lengths[sound]
    return smooth


def joined(parts: list[Part], size: float | None) -> Mesh:
    """Make one mesh of parts; with a `size`, centred and scaled to that largest extent."""
    for part in parts:
        check_indices(part.faces, len(part.positions))
    if not any(len(part.faces) for part in parts):
        raise ValueError("expected triangles, got none")
    positions = np.concatenate([part.positions for part in parts])
    starts = np.cumsum([0] + [len(part.positions) for part in parts[:-1]])
    indices = np.concatenate(
        [part.faces + start for part, start in zip(parts, starts, strict=True)]
    )
    low, high = positions.min(axis=0), positions.max(axis=0)
    extent = float((high - low).max())
    if extent == 0:
        raise ValueError("expected triangles of some extent, got all vertices in one place")
    if size is not None:
        positions = (positions - (low + high) / 2) * (size / extent)
    return Mesh(
        positions,
        indices,
        normals=np.concatenate([unit_normals(part) for part in parts]),
        uvs=_column([part.uvs for part in parts], parts, 2, 0.0),
        colors=_column([part.colors for part in parts], parts, 4, 1.0),
        uvs1=_column([part.uvs1 for part in parts], parts, 2, 0.0),
        tangents=_tangents(parts),
    )


def _tangents(parts: list[Part]) -> npt.NDArray[np.float64] | None:
    """Join the tangents if all parts have some; otherwise those of the whole mesh are made when they are needed."""
    given = [part.tangents for part in parts if part.tangents is not None]
    return np.concatenate(given) if len(given) == len(parts) else None


def _column(
    values: list[npt.NDArray[np.float64] | None], parts: list[Part], width: int, missing: float
) -> npt.NDArray[np.float64] | None:
    """Join what some parts have; the others get a constant. None if no part has any."""
    if all(value is None for value in values):
        return None
    return np.concatenate(
        [
            np.full((len(part.positions), width), missing) if value is None else value[:, :width]
            for part, value in zip(parts, values, strict=True)
        ]
    )
