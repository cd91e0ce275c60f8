"""Draws a cube through a projection, and what may stand over it: seams, the outlines and the names of the faces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._core import CubeMap
from ..io.screen import Clipping, curve_for, screen_pixels
from ..plot import seam_ratios, seam_steps
from ..plot._faces import EDGES, NAMES, TABLE, edge_texels
from ..plot._seams import inner_steps
from .cube_maps import Cross, Look, Panorama
from .lettering import Lettering

if TYPE_CHECKING:
    from ..typing import Tonemap

Array = npt.NDArray[Any]
Picture = npt.NDArray[np.uint8]

#: The ratio of a step over an edge to the steps beside it from which `cc.plot.seams` calls it a seam.
SEAM_LIMIT = 2.5
#: How wide the band of colour along an edge is, on each side, as a share of the face's edge.
_BAND = 0.016
# From no seam (blue and red are those of cc.plot.seams) to a seam.
_RAMP = np.array([[0x2F, 0x7E, 0xD8], [0xF2, 0xC1, 0x3C], [0xD8, 0x43, 0x2F]], float)


@dataclass(frozen=True)
class Inks:
    """The colours of a picture's own background."""

    paper: tuple[int, int, int]
    ink: tuple[int, int, int]
    faint: tuple[int, int, int]


THEMES = {
    "dark": Inks((22, 25, 30), (236, 239, 243), (120, 128, 140)),
    "light": Inks((250, 250, 248), (28, 32, 38), (150, 156, 164)),
}


def pixel_middles(size: tuple[int, int]) -> tuple[Array, Array]:
    """Give x and y of the middles of all pixels, each (height, width)."""
    width, height = size
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return x, y


class Painter:
    """One level of a cube, and what is computed from it once."""

    def __init__(self, cube: CubeMap) -> None:
        self.cube = cube
        self._pixels = (
            cube.faces
        )  # keeps the memory, so that its address tells whether the faces were replaced
        self._resized: dict[Any, Array] = {}
        self._seams: Array | None = None

    def fresh(self) -> bool:
        """Whether the cube still has the faces that this painter has read."""
        return self.cube.faces.ctypes.data == self._pixels.ctypes.data

    # The cube's numbers for each pixel -----------------------------------------------------------------------

    def numbers(
        self, projection: Cross | Panorama | Look, size: tuple[int, int], smooth: bool
    ) -> tuple[Array, Array]:
        """Give the cube's numbers (height, width, C) and where there are any (height, width)."""
        if isinstance(projection, Cross):
            return self._cross(projection, size)
        if isinstance(projection, Panorama) and projection.pixels_per_face <= self.cube.size:
            return self._small_panorama(projection, size)
        directions = projection.directions(*pixel_middles(size))
        known = np.isfinite(directions[..., 0])
        directions[~known] = (0.0, 0.0, -1.0)
        if smooth:
            return self.cube.sample(directions.astype(np.float32)), known
        face, s, t = face_places(directions)
        n = self.cube.size
        row, column = (np.minimum((place * n).astype(np.intp), n - 1) for place in (t, s))
        return self.cube.faces[face, row, column], known

    def _cross(self, cross: Cross, size: tuple[int, int]) -> tuple[Array, Array]:
        sheet, n = cross.sheet, min(self.cube.size, max(1, round(cross.sheet.scale)))
        picture = self._kept(
            ("cross", n, cross.convention),
            lambda: self._at(n).to_layout("cross", convention=cross.convention),
        )
        columns, rows = sheet.units(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
        in_columns, in_rows = (columns >= 0) & (columns < 4), (rows >= 0) & (rows < 3)
        at = tuple(
            np.clip(np.floor(units * n).astype(np.intp), 0, most * n - 1)
            for units, most in ((rows, 3), (columns, 4))
        )
        cells = np.zeros((3, 4), bool)
        for cell in cross.cells:
            cells[cell.row, cell.column] = True
        known = cells[at[0] // n][:, at[1] // n] & in_rows[:, None] & in_columns
        return picture[at[0]][:, at[1]], known

    def _small_panorama(self, panorama: Panorama, size: tuple[int, int]) -> tuple[Array, Array]:
        # No panorama pixel is smaller than a texel here, so that the conversion, which filters, is exact.
        sheet = panorama.sheet
        width = max(2, 2 * round(sheet.scale))
        picture = self._kept(
            ("panorama", width, panorama.center),
            lambda: self.cube.to_equirect(width=width, center=panorama.center),
        )
        columns, rows = sheet.units(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
        known = ((rows >= 0) & (rows < 1))[:, None] & (columns >= 0) & (columns < 2)
        height = width // 2
        at = (
            np.clip(np.floor(rows * height).astype(np.intp), 0, height - 1),
            np.clip(np.floor(columns * height).astype(np.intp), 0, width - 1),
        )
        return picture[at[0]][:, at[1]], known

    def _at(self, size: int) -> CubeMap:
        return self.cube if size == self.cube.size else self.cube.resize(size)

    def _kept(self, key: Any, make: Any) -> Array:
        if key not in self._resized:
            # A moving view and one at rest take turns at two sizes.
            last = list(self._resized.items())[-1:]
            self._resized = {**dict(last), key: make()}
        return self._resized[key]

    # Pictures -------------------------------------------------------------------------------------------------

    def paint(
        self,
        projection: Cross | Panorama | Look,
        size: tuple[int, int],
        *,
        exposure: float,
        tonemap: Tonemap | None,
        smooth: bool,
        paper: tuple[int, int, int],
    ) -> Picture:
        """Draw the cube on paper, (height, width, 3)."""
        numbers, known = self.numbers(projection, size, smooth)
        curve = curve_for(None, numbers, tonemap)
        if self.cube.encoding == "srgb":
            curve = None
        with Clipping().gathered():  # a live view does not warn: the exposure is a slider
            shown = screen_pixels(numbers, self.cube.encoding, exposure, curve, True)
        return over_paper(shown, known, paper)

    def seam_band(
        self, projection: Cross | Panorama | Look, size: tuple[int, int]
    ) -> tuple[Array, Array]:
        """Give a colour (height, width, 3) along all edges, and where it stands (height, width)."""
        table = self.seam_table()
        directions = projection.directions(*pixel_middles(size))
        known = np.isfinite(directions[..., 0])
        directions[~known] = (0.0, 0.0, -1.0)
        face, s, t = face_places(directions)
        apart = np.stack([s, 1 - s, t, 1 - t])
        side = apart.argmin(axis=0)
        near = known & (apart.min(axis=0) < _BAND)
        n = self.cube.size
        along = np.where(side < 2, t, s)[near]
        texel = np.clip((along * n).astype(np.intp), 0, n - 1)
        colors = np.zeros((*near.shape, 3), np.uint8)
        colors[near] = seam_color(table[face[near], side[near], texel])
        return colors, near

    def seam_table(self) -> npt.NDArray[np.float64]:
        """Give (6, 4, N): the step over each side of each face, divided by the mean step beside that edge.

        The sides are s = 0, s = 1, t = 0, t = 1. The steps are those of `cc.plot.seam_steps`.
        """
        if self._seams is None:
            self._seams = _seam_table(self.cube)
        return self._seams


def _seam_table(cube: CubeMap) -> npt.NDArray[np.float64]:
    n = cube.size
    beside = inner_steps(cube)
    beside = np.where(np.isfinite(beside), beside, 0).mean(axis=1, keepdims=True)
    steps = np.nan_to_num(seam_steps(cube), nan=0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = np.where(steps == 0, 0.0, steps / beside)
    table = np.zeros((6, 4, n))
    for texels in edge_texels(n):
        for edge, ratio in zip(texels, ratios, strict=True):
            face, rows, columns = int(edge[0, 0]), edge[:, 1], edge[:, 2]
            if (columns == columns[0]).all():
                table[face, 0 if columns[0] == 0 else 1, rows] = ratio
            else:
                table[face, 2 if rows[0] == 0 else 3, columns] = ratio
    return table


def seam_color(ratios: npt.ArrayLike) -> Picture:
    """Give a colour (..., 3) for ratios: blue up to 1, red from `SEAM_LIMIT`, logarithmic between."""
    with np.errstate(divide="ignore"):
        place = np.log(np.asarray(ratios, float)) / np.log(SEAM_LIMIT) * 2
    place = np.clip(place, 0, 2)[..., None]
    low = np.minimum(place.astype(int), 1)[..., 0]
    share = place - low[..., None]
    return np.asarray(_RAMP[low] * (1 - share) + _RAMP[low + 1] * share + 0.5).astype(np.uint8)


def face_places(directions: Array) -> tuple[Array, Array, Array]:
    """Give face, s and t of directions (..., 3); of two equal components the axis of lower index counts."""
    size = np.abs(directions)
    x, y, z = (size[..., k] for k in range(3))
    axis = np.where(x >= np.maximum(y, z), 0, np.where(y >= z, 1, 2))
    major = np.take_along_axis(directions, axis[..., None], axis=-1)[..., 0]
    face = 2 * axis + (major < 0)
    # Each row of the table has one number other than 0: which component it takes, and its sign.
    which = np.abs(TABLE).argmax(axis=-1)
    sign = np.take_along_axis(TABLE, which[..., None], axis=-1)[..., 0]
    found = []
    for k in (0, 1):
        part = np.take_along_axis(directions, which[face, k][..., None], axis=-1)[..., 0]
        found.append((part * sign[face, k] / np.abs(major) + 1) / 2)
    return face, found[0], found[1]


def over_paper(shown: Picture, known: Array, paper: tuple[int, int, int]) -> Picture:
    """Lay 8-bit numbers (height, width, C) over paper by their alpha, which is not multiplied with the colours."""
    color = np.repeat(shown, 3, axis=-1) if shown.shape[-1] == 1 else shown[..., :3]
    ground = np.asarray(paper, np.uint8)
    if shown.shape[-1] == 4 and (shown[..., 3] < 255).any():
        alpha = shown[..., 3:].astype(np.float32) / 255
        color = (color * alpha + ground * (1 - alpha) + 0.5).astype(np.uint8)
    return np.where(known[..., None], color, ground)


# What stands over a picture -----------------------------------------------------------------------------------


def draw_names(letters: Lettering, projection: Cross | Panorama | Look) -> None:
    """Write the names of the faces: in the corners of the cross's cells, else where the axes leave the cube."""
    width, height = letters.size
    if isinstance(projection, Cross):
        edge = projection.sheet.scale
        for cell in projection.cells:
            x, y = projection.sheet.pixels(cell.column, cell.row)
            letters.write(cell.name, (x + 0.06 * edge, y + 0.05 * edge), scale=min(2, edge / 120))
        return
    for axis, name in zip(TABLE[:, 2], NAMES, strict=True):
        if isinstance(projection, Panorama) and axis[1]:
            # A pole is a whole row, so that its name stands in the middle of it.
            edge = projection.sheet.scale
            x, y = projection.sheet.pixels(1, 0.5 - 0.5 * axis[1])
            y += (0.055 if axis[1] > 0 else -0.055) * edge
        else:
            x, y = projection.places(axis)
        if np.isfinite(x) and -20 < x < width + 20 and -20 < y < height + 20:
            letters.write(name, (x, y), anchor="mm", scale=1.2)


def outline(projection: Cross | Panorama | Look, size: tuple[int, int]) -> Array:
    """Find the pixels (height, width) next to which another face begins."""
    directions = projection.directions(*pixel_middles(size))
    known = np.isfinite(directions[..., 0])
    directions[~known] = (0.0, 0.0, -1.0)
    face = np.where(known, face_places(directions)[0], -1)
    edge = np.zeros(face.shape, bool)
    edge[:, 1:] |= (face[:, 1:] != face[:, :-1]) & known[:, 1:] & known[:, :-1]
    edge[1:] |= (face[1:] != face[:-1]) & known[1:] & known[:-1]
    return edge


def seam_words(cube: CubeMap) -> str:
    """Say in one line which edges have a seam, as the title of `cc.plot.seams`."""
    ratios = seam_ratios(cube)
    high = [
        f"{NAMES[f]}|{NAMES[g]}" for (f, g), r in zip(EDGES, ratios, strict=True) if r > SEAM_LIMIT
    ]
    if not high:
        return f"no edge is above {SEAM_LIMIT:g}x; the highest is {np.nanmax(ratios):.2g}x"
    return f"{len(high)} of 12 edges above {SEAM_LIMIT:g}x: {', '.join(high)}"


def draw_legend(letters: Lettering, cube: CubeMap, left: float) -> None:
    """Explain the colours of the seams at the bottom of the picture, from x = `left` in pixels on."""
    width, height = letters.size
    unit = letters.unit
    margin, step = 0.5 * unit, 1.35 * unit
    left += 2 * margin
    head, most = "step over an edge / step beside it", f"{SEAM_LIMIT:g}x and more"
    lines = letters.wrapped(seam_words(cube), max(width - left - 2 * margin, 8 * unit))
    begin, long = left + letters.width("1x "), 6 * unit
    right = max(
        begin + long + margin + letters.width(most),
        *(left + letters.width(t) for t in [head, *lines]),
    )
    top = height - 2 * margin - (len(lines) + 2) * step
    letters.plate((left - margin, top - margin, right + margin, height - margin))
    letters.write(head, (left, top), plain=True)
    y = top + step
    letters.write("1x", (left, y), plain=True)
    ramp = seam_color(np.exp(np.linspace(0, np.log(SEAM_LIMIT), 48)))
    for k, color in enumerate(ramp.tolist()):
        x = begin + long * k / len(ramp)
        letters.box((x, y + 0.2 * unit, x + long / len(ramp), y + 0.9 * unit), tuple(color))
    letters.write(most, (begin + long + margin, y), plain=True)
    for k, line in enumerate(lines):
        letters.write(line, (left, y + (k + 1) * step), plain=True)
