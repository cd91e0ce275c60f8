"""A plot of the difference of two pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap, Frame, Image
from ._faces import NAMES, cells, cross_of
from ._figure import APART, add_bar, axes_for, dark_edge, is_cube, numbers_of
from ._pictures import decorate_cross

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..typing import Convention

Array = npt.NDArray[Any]


@checked_call
def error_map(
    a: CubeMap | Frame | Image | npt.ArrayLike,
    b: CubeMap | Frame | Image | npt.ArrayLike,
    *,
    over: Literal["max", "rms"] = "max",
    scale: Literal["linear", "log"] = "linear",
    vmin: float | None = None,
    vmax: float | None = None,
    cmap: str = "magma",
    labels: bool = True,
    convention: Convention = "inside",
    ax: Axes | None = None,
) -> Axes:
    """Draw how far apart two pictures are, pixel by pixel.

    The error of a pixel is the largest absolute difference of its channels, or the root of their mean square. uint8
    counts as value/255, as everywhere. The largest error is marked and named; the title has the mean, the root of
    the mean square and the maximum over all pixels. Cubes are drawn as a cross.

    Parameters
    ----------
    a, b : CubeMap, Frame, Image or array_like
        Two of one shape: (H, W) or (H, W, C), or (6, N, N) or (6, N, N, C) for cubes. Frames stand for their colour;
        ``frame.distance`` and the like are arrays. Alpha is a channel like the others.
    over : {"max", "rms"}, default "max"
        What stands for all channels of a pixel: the largest difference, or the root of their mean square.
    scale : {"linear", "log"}, default "linear"
        The scale of the colours. With "log" the lowest colour also stands for 0.
    vmin, vmax : float, optional
        The errors at both ends of the colour map. None: 0, or with "log" the least error above 0, but no
        less than a millionth of `vmax`; and the largest error.
    cmap : str, default "magma"
        The name of a colour map of matplotlib.
    labels : bool, default True
        Whether the faces of a cube show their names.
    convention : {"inside", "gl", "three"}, default "inside"
        How a cube's faces are drawn, see `cross`.
    ax : matplotlib Axes, optional
        Where to draw. None: a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes. Pixels have no error, are grey, and are counted in the title, where `a` or `b` is NaN, or where one
        of them is infinite and the other is not the same; equal infinities have error 0.

    Raises
    ------
    ValueError
        For two different shapes, two objects of different `encoding`, a shape that is no picture, or an unknown
        `over`, `scale` or convention.

    Examples
    --------
    >>> import cubecam as cc
    >>> a = np.zeros((4, 6, 3), np.float32)
    >>> b = a.copy()
    >>> b[1, 2, 0] = 0.5
    >>> print(cc.plot.error_map(a, b).get_title())
    mean 0.0208, rms 0.102, max 0.5 at row 1, column 2
    """
    if over not in ("max", "rms"):
        raise ValueError(f'over: expected "max" or "rms", got {text_of(over)}')
    if scale not in ("linear", "log"):
        raise ValueError(f'scale: expected "linear" or "log", got {text_of(scale)}')
    error, cube = _errors(a, b, over)
    known = np.isfinite(error)
    ax = axes_for(ax, (8, 6) if cube else (7, 5.4))
    covered = np.ones(error.shape, bool)
    picture, places = error, cells(convention)
    if cube:
        covered = cross_of(covered, places, False)
        picture = cross_of(error, places, np.nan)
    low, high = _range(error[known], scale, vmin, vmax)
    _draw(ax, picture, covered, scale, low, high, cmap)
    where = _worst(error)
    if cube:
        decorate_cross(ax, places, error.shape[1], labels=labels)
    else:
        ax.set_axis_off()
    if where is not None:
        _mark(ax, error, where, cube, convention)
    ax.set_title(_title(error, where, cube), fontsize=10)
    return ax


def _errors(a: object, b: object, over: str) -> tuple[Array, bool]:
    """Give one error for each pixel, NaN where there is none, and whether the pictures are cubes."""
    first, second = numbers_of(a), numbers_of(b)
    if first.shape != second.shape:
        raise ValueError(
            f"expected two pictures of one shape, got {first.shape} and {second.shape}"
        )
    one, other = (getattr(thing, "encoding", None) for thing in (a, b))
    if one and other and one != other:
        raise ValueError(
            f"expected two pictures of one encoding, got {one} and {other}; compare cc.to_screen of both, or load "
            "files of 8 bits with srgb=True"
        )
    cube = is_cube(first)
    if not (cube or first.ndim in (2, 3)) or not first.size:
        raise ValueError(
            f"expected (H, W), (H, W, C), (6, N, N) or (6, N, N, C), got shape {first.shape}"
        )
    x, y = (
        np.asarray(p, float) / 255 if p.dtype == np.uint8 else np.asarray(p, float)
        for p in (first, second)
    )
    with np.errstate(invalid="ignore"):
        apart = np.where(x == y, 0.0, np.abs(x - y))
    apart[np.isinf(apart)] = np.nan
    if apart.ndim == (4 if cube else 3):
        apart = apart.max(axis=-1) if over == "max" else np.sqrt((apart**2).mean(axis=-1))
    return apart, cube


def _range(known: Array, scale: str, vmin: float | None, vmax: float | None) -> tuple[float, float]:
    largest = float(known.max()) if known.size else 0.0
    high = vmax if vmax is not None else (largest or 1.0)
    if vmin is not None:
        return float(vmin), float(high)
    if scale == "linear":
        return 0.0, float(high)
    above = known[known > 0]
    least = float(above.min()) if above.size else high / 10
    return min(max(least, high * 1e-6), high / 10), float(high)


def _draw(
    ax: Axes, picture: Array, covered: Array, scale: str, low: float, high: float, cmap: str
) -> None:
    from matplotlib import colormaps
    from matplotlib.colors import LogNorm, Normalize

    colors = colormaps[cmap].with_extremes(bad=APART)
    norm = LogNorm(low, high) if scale == "log" else Normalize(low, high)
    # The lowest colour stands for 0, which has no logarithm.
    shown = np.maximum(picture, low) if scale == "log" else picture
    drawn = ax.imshow(
        shown, cmap=colors, norm=norm, alpha=covered.astype(float), interpolation="nearest"
    )
    add_bar(drawn, ax, label="error")


def _worst(error: Array) -> tuple[int, ...] | None:
    if not (np.nan_to_num(error) > 0).any():
        return None
    return tuple(int(i) for i in np.unravel_index(np.nanargmax(error), error.shape))


def _name(where: tuple[int, ...], cube: bool) -> str:
    *_, row, column = where
    face = f"{NAMES[where[0]]}, " if cube else ""
    return f"{face}row {row}, column {column}"


def _mark(
    ax: Axes, error: Array, where: tuple[int, ...], cube: bool, convention: Convention
) -> None:
    spot: Array = np.zeros(error.shape, bool)
    spot[where] = True
    if cube:
        spot = cross_of(spot, cells(convention), False)
    y, x = np.argwhere(spot)[0].tolist()
    height, width = spot.shape[0], spot.shape[1]
    dark = dark_edge(3.5)
    ax.plot(
        x, y, "o", markersize=13, markerfacecolor="none", markeredgecolor="white", path_effects=dark
    )
    right, up = x < width / 2, y > height / 2
    ax.annotate(
        f"{error[where]:.3g}", (x, y), xytext=(11 if right else -11, 9 if up else -9),
        textcoords="offset points", color="white", fontweight="bold", path_effects=dark,
        ha="left" if right else "right", va="bottom" if up else "top",
    )  # fmt: skip


def _title(error: Array, where: tuple[int, ...] | None, cube: bool) -> str:
    known = error[np.isfinite(error)]
    unknown = error.size - known.size
    if not known.size:
        return "no pixel of both pictures is finite"
    rms = np.sqrt((known**2).mean())
    text = f"mean {known.mean():.3g}, rms {rms:.3g}, max {known.max():.3g}"
    text = f"{text} at {_name(where, cube)}" if where is not None else "no difference"
    return f"{text}\n{unknown} of {error.size} pixels without an error (grey)" if unknown else text
