"""Plots of what a cube holds: the cross, the six faces, the panorama; and pictures side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap, Frame, Image
from ._faces import cells, cross_of, texels_of
from ._figure import (
    are_colors,
    axes_for,
    dark_edge,
    faces_of,
    is_cube,
    numbers_of,
    on_screen,
    put_label,
    pyplot,
    show_numbers,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from ..typing import Center, Convention, Encode, Tonemap
    from ._faces import Cell

Array = npt.NDArray[Any]

_S, _T = "#ff5a4d", "#35d07f"  # the arrows s and t


@checked_call
def cross(
    cube: CubeMap | npt.ArrayLike,
    labels: bool = True,
    *,
    convention: Convention = "inside",
    arrows: bool = False,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    cmap: str | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    colorbar: bool = True,
    ax: Axes | None = None,
) -> Axes:
    """Draw the six faces unfolded as a horizontal cross.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N)
        Colours of C = 1, 3 or 4 channels (alpha is not shown), or one number for each texel, such as
        ``cube.distance`` (drawn by a colour map) and ``cube.id`` (one colour for each id). Arrays are in "gl".
    labels : bool, default True
        Whether each face shows its name.
    convention : {"inside", "gl", "three"}, default "inside"
        How the faces are stored in the picture (docs/conventions.md). "inside" is the view from the center; "gl"
        shows the faces as they lie in memory, which is the mirror image.
    arrows : bool, default False
        Whether each face shows where s and t grow, from the corner of ``faces[f, 0, 0]``.
    exposure : float, default 0
        Stops: linear colours are multiplied by 2 ** exposure.
    tonemap : {"neutral", "reinhard", "aces"} or None, default "neutral"
        The curve for linear colours, see `to_screen`; None clips them at 1.
    cmap : str, optional
        The name of a colour map of matplotlib, for one number a texel. None: "viridis", or "tab20" for ids.
    vmin, vmax : float, optional
        The numbers at both ends of the colour map. None: the least and the greatest finite number.
    colorbar : bool, default True
        Whether numbers have a colour bar, and ids a list.
    ax : matplotlib Axes, optional
        Where to draw. None: a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes. Its data coordinates are pixels of ``cube.to_layout("cross", convention=convention)``.

    Raises
    ------
    ValueError
        For an array of another shape, or an unknown convention.
    ImportError
        If matplotlib is missing.

    Examples
    --------
    >>> import cubecam as cc
    >>> sky = cc.CubeMap.from_equirect(np.ones((8, 16, 3), np.float32))
    >>> ax = cc.plot.cross(sky)
    >>> [text.get_text() for text in ax.texts]
    ['+X', '-X', '+Y', '-Y', '+Z', '-Z']
    """
    pixels = faces_of(cube)
    colors = are_colors(pixels, 3)
    places = cells(convention)
    n = pixels.shape[1]
    ax = axes_for(ax, (8, 6))
    covered = cross_of(np.ones((6, n, n), bool), places, False)
    if colors:
        opaque = np.full((6, n, n, 1), 255, np.uint8)
        shown = np.concatenate([on_screen(cube, exposure, tonemap), opaque], axis=-1)
        ax.imshow(cross_of(shown, places, 0))
    else:
        numbers = cross_of(pixels, places, 0)
        bar = ax if colorbar else None
        show_numbers(
            ax, numbers, cmap=cmap, vmin=vmin, vmax=vmax, bar=bar, covered=covered, among=pixels
        )
    decorate_cross(ax, places, n, labels=labels, arrows=arrows)
    return ax


def decorate_cross(
    ax: Axes, places: Sequence[Cell], size: int, *, labels: bool, arrows: bool = False
) -> None:
    """Draw the borders of the faces, their names, and the arrows s and t; hide the frame of the axes."""
    for cell in places:
        left, top = cell.column * size - 0.5, cell.row * size - 0.5
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) * size
        x, y = np.transpose(corners + np.array([left, top]))
        ax.plot(x, y, color="0.5", linewidth=0.6, alpha=0.6, clip_on=False)
        if labels:
            # The left corner belongs to the arrows, unless s begins at the right.
            share, side = (0.95, "right") if arrows and not cell.mirrored_s else (0.05, "left")
            at = (left + share * size, top + 0.05 * size)
            put_label(ax, *at, cell.name, ha=side, va="top")
        if arrows:
            _st_arrows(ax, cell, left, top, size)
    ax.set(xlim=(-0.5, 4 * size - 0.5), ylim=(3 * size - 0.5, -0.5), aspect="equal")
    ax.set_axis_off()


def _st_arrows(ax: Axes, cell: Cell, left: float, top: float, size: int) -> None:
    x = left + (0.93 if cell.mirrored_s else 0.07) * size
    y = top + (0.93 if cell.mirrored_t else 0.07) * size
    dark = dark_edge(3.5)
    along_s = (-0.34 if cell.mirrored_s else 0.34) * size
    along_t = (-0.34 if cell.mirrored_t else 0.34) * size
    for name, dx, dy, color in (("s", along_s, 0.0, _S), ("t", 0.0, along_t, _T)):
        style: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "linewidth": 1.6}
        style |= {"shrinkA": 0, "shrinkB": 0}
        arrow = ax.annotate("", (x + dx, y + dy), (x, y), arrowprops=style).arrow_patch
        if arrow is not None:
            arrow.set_path_effects(dark)
        ax.text(
            x + 1.16 * dx, y + 1.16 * dy, name, color=color, ha="center", va="center",
            fontweight="bold", path_effects=dark,
        )  # fmt: skip


@checked_call
def faces(
    cube: CubeMap | npt.ArrayLike,
    *,
    convention: Convention = "inside",
    columns: int = 3,
    arrows: bool = False,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    cmap: str | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    colorbar: bool = True,
    ax: Sequence[Axes] | npt.NDArray[Any] | None = None,
) -> npt.NDArray[Any]:
    """Draw the six faces side by side, each with its name above.

    Parameters
    ----------
    cube, convention, exposure, tonemap, cmap, vmin, vmax, colorbar
        As in `cross`. Numbers of all faces share one colour map and one bar.
    columns : {1, 2, 3, 6}, default 3
        Faces in a row of a new figure.
    arrows : bool, default False
        As in `cross`.
    ax : sequence of 6 Axes, optional
        Where to draw, in the order +X -X +Y -Y +Z -Z. None: a new figure.

    Returns
    -------
    ndarray (6,) of matplotlib.axes.Axes
        In the order of the faces. The title of each is the name of its face in the convention.

    Raises
    ------
    ValueError
        As `cross`; also for another number of axes or columns.

    Examples
    --------
    >>> import cubecam as cc
    >>> axes = cc.plot.faces(cc.CubeMap(np.zeros((6, 4, 4, 3), np.uint8)), convention="gl")
    >>> [ax.get_title() for ax in axes]
    ['+X', '-X', '+Y', '-Y', '+Z', '-Z']
    """
    pixels = faces_of(cube)
    colors = are_colors(pixels, 3)
    places = cells(convention)
    axes = _six_axes(ax, columns)
    shown = on_screen(cube, exposure, tonemap) if colors else pixels
    if not colors and pixels.dtype.kind == "f":
        known = pixels[np.isfinite(pixels)]
        vmin = vmin if vmin is not None else float(known.min() if known.size else 0)
        vmax = vmax if vmax is not None else float(known.max() if known.size else 1)
    for one, cell in zip(axes, places, strict=True):
        picture = cell.picture(shown)
        if colors:
            one.imshow(picture)
        else:
            bar = list(axes) if colorbar and one is axes[-1] else None
            show_numbers(one, picture, cmap=cmap, vmin=vmin, vmax=vmax, bar=bar, among=pixels)
        if arrows:
            _st_arrows(one, cell, -0.5, -0.5, pixels.shape[1])
        one.set_title(cell.name)
        one.set(xticks=[], yticks=[])
    return axes


def _six_axes(ax: Sequence[Axes] | npt.NDArray[Any] | None, columns: int) -> npt.NDArray[Any]:
    plt = pyplot()
    if ax is not None:
        axes = np.ravel(np.asarray(ax, object))
        if len(axes) != 6:
            raise ValueError(f"ax: expected 6 axes, got {len(axes)}")
        return axes
    if columns not in (1, 2, 3, 6):
        raise ValueError(f"columns: expected 1, 2, 3 or 6, got {text_of(columns)}")
    rows = 6 // columns
    width = 2.0 if columns == 6 else 2.6
    _, made = plt.subplots(
        rows, columns, figsize=(width * columns, (width + 0.35) * rows), layout="compressed"
    )
    return np.ravel(made)


@checked_call
def panorama(
    cube: CubeMap | npt.ArrayLike,
    *,
    center: Center = "-z",
    width: int | None = None,
    graticule: float | None = 30,
    labels: bool = True,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    cmap: str | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    colorbar: bool = True,
    ax: Axes | None = None,
) -> Axes:
    """Draw a panorama with lines of longitude and latitude and the names of the six axes.

    Parameters
    ----------
    cube : CubeMap or array_like
        A cube, as in `cross`, or a panorama (H, 2H, C) or (H, 2H) with `center` in its middle. One number for each
        texel of a cube (``cube.distance``) is looked up in the nearest texel.
    center : {"-z", "+z", "+x", "-x"}, default "-z"
        The axis in the middle of the picture (docs/conventions.md).
    width : int, optional
        Pixels of a row, an even number, for a cube. None: 4 N.
    graticule : float or None, default 30
        Degrees from one line to the next. None: no lines.
    labels : bool, default True
        Whether the six axes, +X to -Z, are marked.
    exposure, tonemap, cmap, vmin, vmax, colorbar, ax
        As in `cross`.

    Returns
    -------
    matplotlib.axes.Axes
        The axes. Its data coordinates are degrees: x is the longitude, which counts from `center` to the right, and y
        the latitude, which is 90 at +Y.

    Raises
    ------
    ValueError
        For an array of another shape, an odd width, an unknown center, or a graticule that is not above 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> ax = cc.plot.panorama(np.zeros((16, 32, 3)), center="+x")
    >>> [text.get_text() for text in ax.texts]
    ['-X', '-Z', '+X', '+Z', '-X', '+Y', '-Y']
    """
    names = _named_directions(center)
    if graticule is not None and not graticule > 0:
        raise ValueError(f"graticule: expected degrees above 0 or None, got {text_of(graticule)}")
    picture = _panorama_of(cube, center, width)
    ax = axes_for(ax, (10, 5.4))
    extent = (-180.0, 180.0, -90.0, 90.0)
    if are_colors(picture, 2):
        # A cube's panorama is a plain array; the picture has the encoding of the cube again.
        known = Image(picture, encoding=cube.encoding) if isinstance(cube, CubeMap) else picture
        ax.imshow(on_screen(known, exposure, tonemap), extent=extent)
    else:
        bar = ax if colorbar else None
        show_numbers(ax, picture, cmap=cmap, vmin=vmin, vmax=vmax, bar=bar, extent=extent)
    _draw_graticule(ax, graticule)
    if labels:
        for name, longitude, latitude in names:
            _mark_direction(ax, name, longitude, latitude)
    ax.set(xlim=(-180, 180), ylim=(-90, 90), xlabel="longitude", ylabel="latitude")
    return ax


# The axes at the left edge, the first quarter, the middle and the third quarter (docs/conventions.md).
_AROUND = {
    "-z": ("+Z", "-X", "-Z", "+X"),
    "+z": ("-Z", "+X", "+Z", "-X"),
    "+x": ("-X", "-Z", "+X", "+Z"),
    "-x": ("+X", "+Z", "-X", "-Z"),
}


def _named_directions(center: Center) -> list[tuple[str, float, float]]:
    if center not in _AROUND:
        raise ValueError(f'center: expected "-z", "+z", "+x" or "-x", got {text_of(center)}')
    around = [(name, -180.0 + 90 * i, 0.0) for i, name in enumerate(_AROUND[center])]
    return [*around, (around[0][0], 180.0, 0.0), ("+Y", 0.0, 90.0), ("-Y", 0.0, -90.0)]


def _panorama_of(cube: CubeMap | npt.ArrayLike, center: Center, width: int | None) -> Array:
    pixels = numbers_of(cube)
    if not is_cube(pixels):
        if pixels.ndim not in (2, 3) or pixels.shape[1] != 2 * pixels.shape[0] or not pixels.size:
            raise ValueError(
                "expected a CubeMap, an array (6, N, N, C) or (6, N, N), or a panorama (H, 2H, C) or (H, 2H), "
                f"got shape {pixels.shape}"
            )
        return pixels
    if pixels.ndim == 4 and pixels.dtype.kind != "b":
        whole = cube if isinstance(cube, CubeMap) else CubeMap(pixels)
        return np.asarray(whole.to_equirect(width=width, center=center))
    columns = 4 * pixels.shape[1] if width is None else width
    if columns < 2 or columns % 2:
        raise ValueError(f"width: expected an even number from 2, got {text_of(width)}")
    longitude = ((np.arange(columns) + 0.5) / columns - 0.5) * 2 * np.pi
    latitude = (0.5 - (np.arange(columns // 2) + 0.5) / (columns // 2)) * np.pi
    l, b = np.meshgrid(longitude, latitude)  # noqa: E741 - the names of docs/conventions.md
    forward, right = (_axis(_AROUND[center][i]) for i in (2, 3))
    up = np.array([0.0, 1.0, 0.0])
    directions = (
        (np.cos(b) * np.cos(l))[..., None] * forward
        + (np.cos(b) * np.sin(l))[..., None] * right
        + np.sin(b)[..., None] * up
    )
    return np.asarray(pixels[texels_of(directions, pixels.shape[1])])


def _axis(name: str) -> npt.NDArray[np.float64]:
    axis = np.zeros(3)
    axis["XYZ".index(name[1])] = 1 if name[0] == "+" else -1
    return axis


def _draw_graticule(ax: Axes, step: float | None) -> None:
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    spacing = step or 45
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MultipleLocator(spacing))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}\N{DEGREE SIGN}"))
    if step is None:
        return
    count = int(np.ceil(180 / step))
    for k in range(-count, count + 1):
        degrees = k * step
        strong = 0.75 if degrees == 0 else 0.45
        style: dict[str, Any] = {"color": "white", "alpha": strong, "linewidth": 0.8}
        style["path_effects"] = dark_edge(1.6, 0.3)
        if abs(degrees) < 180:
            ax.axvline(degrees, **style)
        if abs(degrees) < 90:
            ax.axhline(degrees, **style)


def _mark_direction(ax: Axes, name: str, longitude: float, latitude: float) -> None:
    side = {-180.0: "left", 180.0: "right"}.get(longitude, "center")
    height = {90.0: "top", -90.0: "bottom"}.get(latitude, "center")
    inset_x = {"left": 4, "right": -4}.get(side, 0)
    inset_y = {"top": -4, "bottom": 4}.get(height, 0)
    put_label(
        ax, longitude + inset_x, latitude + inset_y, name, ha=side, va=height, clip_on=True
    )  # fmt: skip


@checked_call
def pictures(
    pictures: Sequence[Frame | Image | npt.ArrayLike],
    titles: Sequence[str] | None = None,
    *,
    columns: int | None = None,
    width: float = 3.0,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    encode: Encode | None = "srgb",
    cmap: str | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    colorbar: bool = True,
    ax: Sequence[Axes] | npt.NDArray[Any] | None = None,
) -> npt.NDArray[Any]:
    """Draw pictures side by side, each with a title above.

    Parameters
    ----------
    pictures : sequence of Frame, Image or array_like (H, W, C) or (H, W)
        Colours of C = 1, 3 or 4 channels (alpha is not shown), or one number for each pixel, such as
        ``frame.distance`` (drawn by a colour map), ``frame.id`` and masks (one colour for each value). Pictures may
        differ in size. Frames stand for their colour.
    titles : sequence of str, optional
        One for each picture. None: no titles.
    columns : int, optional
        Pictures in a row of a new figure. None: all of them.
    width : float, default 3
        Inches of a picture in a new figure.
    exposure, tonemap, encode
        How colours are prepared, see `to_screen`. ``tonemap=None, encode=None`` shows floats from 0 to 1 as the
        numbers of the screen, which is how OpenGL would store them in 8 bits. Arrays of uint8 are such numbers
        already, and are shown as they are.
    cmap, vmin, vmax, colorbar
        As in `cross`. Numbers of all pictures share one colour map and one bar, beside the last picture of numbers.
    ax : sequence of Axes, optional
        Where to draw, one for each picture. None: a new figure.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        One for each picture.

    Raises
    ------
    ValueError
        For no picture, an array of another shape, another number of titles or axes, columns below 1, or a width
        that is not above 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> grey, red = np.full((4, 6, 3), 0.5), np.full((4, 6, 3), (1.0, 0, 0))
    >>> axes = cc.plot.pictures([grey, red], ["grey", "red"])
    >>> [ax.get_title() for ax in axes]
    ['grey', 'red']
    """
    if isinstance(pictures, (Frame, Image)) or not hasattr(pictures, "__len__"):
        raise TypeError(
            f"pictures: expected a list of pictures, got {type(pictures).__name__}; write [picture]"
        )
    if not len(pictures):
        raise ValueError("pictures: expected at least one picture, got none")
    if titles is not None and (isinstance(titles, str) or len(titles) != len(pictures)):
        raise ValueError(
            f"titles: expected {len(pictures)}, one for each picture, got {text_of(titles)}"
        )
    pixels = [_picture_of(picture) for picture in pictures]
    colors = [are_colors(one, 2) for one in pixels]
    axes = _row_of_axes(ax, pixels, columns, width)
    numbers = [one for one, is_color in zip(pixels, colors, strict=True) if not is_color]
    among = np.concatenate([one.ravel() for one in numbers]) if numbers else None
    if among is not None and among.dtype.kind == "f":
        known = among[np.isfinite(among)]
        vmin = vmin if vmin is not None else float(known.min() if known.size else 0)
        vmax = vmax if vmax is not None else float(known.max() if known.size else 1)
    last = max((k for k, is_color in enumerate(colors) if not is_color), default=None)
    for k, (one, picture, values) in enumerate(zip(axes, pictures, pixels, strict=True)):
        if colors[k]:
            plain = not isinstance(picture, (Frame, Image))
            # Whole numbers of a plain array are the screen's own already.
            encoded = "srgb" if plain and values.dtype.kind == "u" else encode
            one.imshow(on_screen(values if plain else picture, exposure, tonemap, encoded))
        else:
            bar = one if colorbar and k == last else None
            if values.dtype != among.dtype:  # type: ignore[union-attr] # a mask beside distances
                values = values.astype(among.dtype)  # type: ignore[union-attr]
            show_numbers(one, values, cmap=cmap, vmin=vmin, vmax=vmax, bar=bar, among=among)
        if titles is not None:
            one.set_title(titles[k], fontsize=10)
        one.set_axis_off()
    return axes


def _picture_of(thing: object) -> Array:
    """Give the pixels (H, W) or (H, W, C) of one picture."""
    pixels = numbers_of(thing)
    if isinstance(thing, CubeMap) or pixels.ndim not in (2, 3) or not pixels.size:
        raise ValueError(
            f"pictures: expected pictures (H, W) or (H, W, C), got shape {pixels.shape}"
        )
    return pixels


def _row_of_axes(
    ax: Sequence[Axes] | npt.NDArray[Any] | None,
    pixels: list[Array],
    columns: int | None,
    width: float,
) -> npt.NDArray[Any]:
    """Give the caller's axes, or those of a new figure with a place for each picture."""
    plt = pyplot()
    count = len(pixels)
    if ax is not None:
        axes = np.ravel(np.asarray(ax, object))
        if len(axes) != count:
            raise ValueError(f"ax: expected {count} axes, one for each picture, got {len(axes)}")
        for one in axes:
            axes_for(one, (1, 1))
        return axes
    if columns is not None and columns < 1:
        raise ValueError(f"columns: expected a number from 1, got {text_of(columns)}")
    if not width > 0:
        raise ValueError(f"width: expected inches above 0, got {text_of(width)}")
    across = min(columns or count, count)
    rows = -(-count // across)
    height = width * max(one.shape[0] / one.shape[1] for one in pixels)
    _, made = plt.subplots(
        rows, across, figsize=(width * across, (height + 0.3) * rows), layout="compressed",
        squeeze=False,
    )  # fmt: skip
    places = made.ravel()
    for place in places[count:]:
        place.remove()
    return np.asarray(places[:count])
