"""The steps over the 12 edges of a cube: numbers and a plot."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from ._faces import EDGE_NAMES, edge_texels
from ._figure import axes_for, faces_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._core import CubeMap

Array = npt.NDArray[Any]

_OVER, _BESIDE, _HIGH = "#2f7ed8", "#a9b0b8", "#d8432f"


@checked_call
def seam_steps(cube: CubeMap | npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Compare the texels on both sides of the 12 edges of a cube.

    A cube that shows one world changes as little over an edge as inside a face (`inner_steps`). A face that is
    turned, mirrored or drawn from another point changes more over each of its four edges. Which texels are neighbours
    follows from OpenGL's table (4.6, section 8.13; docs/conventions.md). matplotlib is not needed.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N)
        Arrays are in "gl". uint8 counts as value/255.

    Returns
    -------
    ndarray (12, N) float64
        The largest absolute difference of the channels of two neighbours, along each edge. The edges are in the order
        of `EDGE_NAMES`, from "+X|+Y" to "-Y|-Z". Equal infinities differ by 0; NaN gives NaN.

    Raises
    ------
    ValueError
        For an array of another shape.

    Examples
    --------
    >>> import cubecam as cc
    >>> faces = np.zeros((6, 4, 4))
    >>> faces[cc.Face.POS_X] = 1
    >>> [name for name, step in zip(cc.plot.EDGE_NAMES, cc.plot.seam_steps(faces)) if step.max() > 0]
    ['+X|+Y', '+X|-Y', '+X|+Z', '+X|-Z']
    """
    values = _values(cube)
    first, second = edge_texels(values.shape[1])
    return _step(values, first, second)


@checked_call
def inner_steps(cube: CubeMap | npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Compare the texels at the 12 edges with the next ones inside their faces: what `seam_steps` is measured by.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N)
        As in `seam_steps`; N is at least 2.

    Returns
    -------
    ndarray (12, N) float64
        At each place of `seam_steps`, the mean of the two steps from the edge inwards, one on each side.

    Raises
    ------
    ValueError
        For an array of another shape, or faces of one texel.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("studio.exr"))
    >>> ratio = cc.plot.seam_steps(cube).mean() / cc.plot.inner_steps(cube).mean()
    >>> bool(0.8 < ratio < 1.2)
    True
    """
    values = _values(cube)
    size = values.shape[1]
    if size < 2:
        raise ValueError("expected faces of at least 2 x 2 texels, got 1 x 1")
    outer, inner = edge_texels(size), edge_texels(size, depth=1)
    a, b = (_step(values, outer[side], inner[side]) for side in (0, 1))
    return np.asarray((a + b) / 2)


@checked_call
def seam_ratios(cube: CubeMap | npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Divide the mean step over each edge by the mean step beside it: one number for each edge.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N)
        As in `seam_steps`; N is at least 2. Places where a step is not finite are left out of the means.

    Returns
    -------
    ndarray (12,) float64
        About 1 where there is no seam, and 1 where both means are 0; inf for a step beside which all is flat. The
        edges are in the order of `EDGE_NAMES`.

    Raises
    ------
    ValueError
        As `inner_steps`.

    Notes
    -----
    Small faces have ratios between 0.3 and 2 by chance, since what stands at an edge may be coarser or finer than its
    surroundings. On the six sample photographs the greatest of the 12 ratios is below 1.2 at 512 texels, and a
    mirrored face has ratios from 6 upwards.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("studio.exr"))
    >>> bool(cc.plot.seam_ratios(cube).max() < 1.2)
    True
    """
    return _ratios(_means(seam_steps(cube)), _means(inner_steps(cube)))


def _ratios(over: Array, beside: Array) -> npt.NDArray[np.float64]:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(over == beside, 1.0, over / beside))


def _values(cube: CubeMap | npt.ArrayLike) -> npt.NDArray[np.float64]:
    pixels = faces_of(cube)
    values = np.asarray(pixels, float)
    values = values / 255 if pixels.dtype == np.uint8 else values
    return values.reshape(*values.shape[:3], -1)


def _step(values: Array, here: Array, there: Array) -> npt.NDArray[np.float64]:
    a, b = (values[tuple(np.moveaxis(side, -1, 0))] for side in (here, there))
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(a == b, 0.0, np.abs(a - b)).max(axis=-1))


@checked_call
def seams(
    cube: CubeMap | npt.ArrayLike,
    *,
    limit: float = 2.5,
    scale: Literal["linear", "log"] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the steps over the 12 edges beside those inside the faces.

    Each edge, "+X|+Y" to "-Y|-Z", has two marks: the mean step over the edge (`seam_steps`), and the mean step beside
    it, inside the faces (`inner_steps`). Their ratio stands above. It is about 1 where there is no seam; an edge whose
    ratio is above `limit` is red.

    Parameters
    ----------
    cube : CubeMap or array_like (6, N, N, C) or (6, N, N)
        As in `seam_steps`. Places where a step is not finite are left out of the means.
    limit : float, default 2.5
        The ratio above which an edge is red, see the notes of `seam_ratios`.
    scale : {"linear", "log"}, optional
        The scale of the steps. None: "log", on which equal ratios are equally long, or "linear" if a mean is 0.
    ax : matplotlib Axes, optional
        Where to draw. None: a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        The axes; edge k of `EDGE_NAMES` is at x = k.

    Raises
    ------
    ValueError
        For an array of another shape, faces of one texel, or another scale.

    Examples
    --------
    >>> import cubecam as cc
    >>> ax = cc.plot.seams(cc.load_environment(cc.sample_data("studio.exr")))
    >>> ax.get_title()
    'no seam: no edge is above 2.5x'
    """
    if scale not in (None, "linear", "log"):
        raise ValueError(f'scale: expected "linear", "log" or None, got {text_of(scale)}')
    over, beside = (_means(steps(cube)) for steps in (seam_steps, inner_steps))
    ratio = _ratios(over, beside)
    high = ratio > limit
    ax = axes_for(ax, (9.5, 4.2))
    places = np.arange(12)
    for k in range(12):
        ax.plot([k, k], [beside[k], over[k]], color=_HIGH if high[k] else _OVER, alpha=0.35, lw=5)
    ax.plot(places, beside, "o", color=_BESIDE, label="beside the edge, inside the faces", ms=9)
    ax.plot(places, np.where(high, np.nan, over), "o", color=_OVER, label="over the edge", ms=9)
    if high.any():
        label = f"over the edge, above {limit:g}x"
        ax.plot(places, np.where(high, over, np.nan), "o", color=_HIGH, label=label, ms=9)
    for k, top in enumerate(np.fmax(over, beside)):
        if np.isfinite(top):
            ax.annotate(
                _times(ratio[k]), (k, top), xytext=(0, 8), textcoords="offset points",
                ha="center", fontsize=9, color=_HIGH if high[k] else None,
            )  # fmt: skip
    logarithmic = (np.fmin(over, beside) > 0).all() if scale is None else scale == "log"
    ax.set(xlim=(-0.6, 11.6), ylabel="mean step between neighbours")
    ax.set_yscale("log" if logarithmic else "linear")
    ax.margins(y=0.15)
    ax.set_xticks(places, EDGE_NAMES)
    ax.grid(axis="y", color="0.5", alpha=0.2)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3)
    ax.set_title(_title(ratio, high, limit), fontsize=11)
    return ax


def _means(steps: Array) -> npt.NDArray[np.float64]:
    """Give the mean of the finite steps along each edge, NaN where there is none."""
    finite = np.isfinite(steps)
    total = np.where(finite, steps, 0).sum(axis=1)
    with np.errstate(invalid="ignore"):
        return np.asarray(total / finite.sum(axis=1))


def _times(ratio: float) -> str:
    return f"{ratio:.0f}x" if ratio >= 10 else f"{ratio:.2g}x"


def _title(ratio: Array, high: Array, limit: float) -> str:
    if np.isnan(ratio).all():
        return "no step is finite"
    if not high.any():
        return f"no seam: no edge is above {limit:g}x"
    names = [EDGE_NAMES[k] for k in np.flatnonzero(high)]
    return f"{len(names)} of 12 edges with a seam: {', '.join(names)}"
