"""The six faces unfolded, with copies of neighbours beside the faces to which they attach."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap
from ._faces import NAMES, TABLE, cells
from ._figure import are_colors, axes_for, faces_of, on_screen, put_label, show_numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from ..typing import Convention, Tonemap
    from ._faces import Cell

Array = npt.NDArray[Any]

_SIDES = ("+X", "-X", "+Z", "-Z")
#: What shines through the paper that lies over a copy.
_PAPER, _GREY = 0.62, "0.6"


class Placed(NamedTuple):
    """A face in the figure: its cell, where it stands, its quarter turns counter-clockwise, whether it is a copy."""

    cell: Cell
    row: int
    column: int
    turns: int
    copy: bool

    def picture(self, faces: Array) -> Array:
        """Cut the picture of this place out of faces (6, N, N, ...) in "gl"."""
        return np.rot90(self.cell.picture(faces), self.turns)


def _directions(cell: Cell, turns: int) -> tuple[Array, Array]:
    """Give the directions in the world to the right and downwards in a cell that was turned."""
    right, down = cell.right, cell.down
    for _ in range(turns):
        right, down = down, -right
    return right, down


def _turned_to(cell: Cell, side: Cell, above: bool) -> int:
    """Find the quarter turns that attach a cell to the upper or the lower edge of a side."""
    # The normal of the side: on the neighbour, this is the way towards the edge that both share.
    towards = TABLE[side.face, 2]
    wanted = (side.right, towards if above else -towards)
    fits = [
        turns
        for turns in range(4)
        if all(np.array_equal(a, b) for a, b in zip(_directions(cell, turns), wanted, strict=True))
    ]
    return fits[0]


def places_of(convention: Convention, repeated: Sequence[str], wrap: bool) -> list[Placed]:
    """List the six faces, then the copies of their neighbours."""
    known = cells(convention)
    found = [Placed(cell, cell.row, cell.column, 0, False) for cell in known]
    for name in repeated:
        side = known[NAMES.index(name)]
        for slot, above in ((2, True), (3, False)):
            cell, row = known[slot], 0 if above else 2
            if side.column != cell.column:  # there is the neighbour itself
                turns = _turned_to(cell, side, above)
                found.append(Placed(cell, row, side.column, turns, True))
    if wrap:
        first = next(cell for cell in known if (cell.row, cell.column) == (1, 0))
        found.append(Placed(first, 1, 4, 0, True))
    return found


@checked_call
def layout(
    cube: CubeMap | npt.ArrayLike | None = None,
    *,
    repeat: str | Sequence[str] = "-Z",
    wrap: bool = False,
    labels: bool = True,
    convention: Convention = "gl",
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    cmap: str | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the six faces unfolded, with faded copies that show where else a face attaches.

    Without a cube this is the figure by which lessons explain cubemaps: the six faces with their names in black, and
    grey copies of +Y and -Y above and below -Z.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N), optional
        As in `cross`. None: outlines and names alone.
    repeat : str or sequence of str, default "-Z"
        Sides, of "+X", "-X", "+Z" and "-Z", that get copies of +Y and -Y above and below; "all", or () for none. The
        copies are turned so that their pictures go on across the edge. One side has +Y and -Y themselves.
    wrap : bool, default False
        Whether a copy of the first face of the row follows the last one, to which it attaches.
    labels : bool, default True
        Whether each face shows its name. The names of copies are turned as their faces are.
    convention : {"gl", "inside", "three"}, default "gl"
        How the faces are stored in the picture (docs/conventions.md). "gl" is the cube seen from outside.
    exposure, tonemap, cmap, vmin, vmax
        As in `cross`.
    ax : matplotlib Axes, optional
        Where to draw. None: a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes. Its data coordinates are pixels, from the upper left corner of the cross; without a cube a face is
        one pixel.

    Raises
    ------
    ValueError
        For an array of another shape, another name of a side, or an unknown convention.
    TypeError
        For names that are no str.
    ImportError
        If matplotlib is missing.

    Examples
    --------
    >>> import cubecam as cc
    >>> ax = cc.plot.layout()
    >>> [text.get_text() for text in ax.texts]
    ['+X', '-X', '+Y', '-Y', '+Z', '-Z', '+Y', '-Y']
    >>> [text.get_rotation() for text in ax.texts[6:]]
    [180.0, 180.0]
    """
    pixels = None if cube is None else faces_of(cube)
    places = places_of(convention, _sides(repeat), wrap)
    size = 1 if pixels is None else pixels.shape[1]
    columns = 5 if wrap else 4
    ax = axes_for(ax, (2 * columns, 6))
    if pixels is not None:
        _show(ax, places, pixels, columns, cube, exposure, tonemap, cmap, vmin, vmax)
    for place in places:
        _decorate(ax, place, size, labels, pixels is not None)
    ax.set(xlim=(-0.5, columns * size - 0.5), ylim=(3 * size - 0.5, -0.5), aspect="equal")
    ax.set_axis_off()
    return ax


def _sides(repeat: str | Sequence[str]) -> list[str]:
    if isinstance(repeat, str):
        repeat = _SIDES if repeat == "all" else (repeat,)
    found: list[str] = []
    for name in repeat:
        if not isinstance(name, str):
            raise TypeError(f"repeat: expected names of sides, got {text_of(name)}")
        if name not in _SIDES:
            raise ValueError(
                f'repeat: expected "+X", "-X", "+Z", "-Z", several of them, or "all", got {text_of(name)}'
            )
        if name not in found:
            found.append(name)
    return found


def _show(
    ax: Axes,
    places: Sequence[Placed],
    pixels: Array,
    columns: int,
    cube: object,
    exposure: float,
    tonemap: Tonemap | None,
    cmap: str | None,
    vmin: float | None,
    vmax: float | None,
) -> None:
    n = pixels.shape[1]
    if are_colors(pixels, 3):
        shown: Any = cube if isinstance(cube, CubeMap) else pixels
        opaque = np.full((6, n, n, 1), 255, np.uint8)
        colors = np.concatenate([on_screen(shown, exposure, tonemap), opaque], axis=-1)
        ax.imshow(canvas_of(colors, places, columns, 0))
        return
    covered = canvas_of(np.ones((6, n, n), bool), places, columns, False)
    numbers = canvas_of(pixels, places, columns, 0)
    show_numbers(
        ax, numbers, cmap=cmap, vmin=vmin, vmax=vmax, bar=ax, covered=covered, among=pixels
    )


def canvas_of(faces: Array, places: Sequence[Placed], columns: int, fill: object) -> Array:
    """Arrange faces (6, N, N, ...) and their copies in a picture (3N, columns N, ...)."""
    n = faces.shape[1]
    canvas = np.full((3 * n, columns * n, *faces.shape[3:]), fill, faces.dtype)
    for place in places:
        rows, across = (slice(i * n, (i + 1) * n) for i in (place.row, place.column))
        canvas[rows, across] = place.picture(faces)
    return canvas


def _decorate(ax: Axes, place: Placed, size: int, labels: bool, pictured: bool) -> None:
    from matplotlib.patches import Rectangle

    left, top = place.column * size - 0.5, place.row * size - 0.5
    color = _GREY if place.copy else "black"
    if place.copy and pictured:
        paper: dict[str, Any] = {"facecolor": "white", "alpha": _PAPER, "linewidth": 0}
        ax.add_patch(Rectangle((left, top), size, size, **paper))
    # The borders of the faces themselves lie above those of copies.
    border: dict[str, Any] = {
        "fill": False,
        "edgecolor": color,
        "linewidth": 1.0 if pictured else 1.8,
    }
    ax.add_patch(
        Rectangle((left, top), size, size, clip_on=False, zorder=2 if place.copy else 3, **border)
    )
    if not labels:
        return
    style: dict[str, Any] = {"ha": "center", "va": "center", "rotation": 90.0 * place.turns}
    if pictured and not place.copy:
        put_label(ax, left + 0.5 * size, top + 0.12 * size, place.cell.name, **style)
        return
    # The name of a copy stands where its own upper edge is, as in the face itself.
    x, y = _at_top(place.turns) if pictured else (0.5, 0.5)
    at = (left + x * size, top + y * size)
    ink = "0.25" if pictured else color
    ax.text(*at, place.cell.name, color=ink, fontsize=12 if pictured else 26, **style)


def _at_top(turns: int) -> tuple[float, float]:
    """Give the place near the upper edge of a cell, after its quarter turns."""
    return ((0.5, 0.12), (0.12, 0.5), (0.5, 0.88), (0.88, 0.5))[turns]
