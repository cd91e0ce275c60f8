"""What all plots share: matplotlib's import, axes, colours for a screen, labels that can be read on any picture."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._checks import text_of
from .._core import CubeMap, Frame, Image, _to_array
from ..io import screen

if TYPE_CHECKING:
    from types import ModuleType

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable

    from ..typing import Encode, Tonemap

Array = npt.NDArray[Any]

#: The colour of numbers that a colour map cannot show: NaN, infinities, vectors of length 0.
APART = "0.82"
#: More values than these in a picture of ids, and there is no list of them beside it.
_MOST_LABELS = 20


def pyplot() -> ModuleType:
    """Import matplotlib when the first picture is drawn, so that `import cubecam` needs none."""
    try:
        from matplotlib import pyplot as plt
    except ImportError as error:
        raise ImportError(
            "cc.plot needs matplotlib, which is not installed: pip install cubecam[plot]"
        ) from error
    return plt


def axes_for(ax: Axes | None, size: tuple[float, float], projection: str | None = None) -> Axes:
    """Give the caller's axes, or the axes of a new figure of `size` inches."""
    plt = pyplot()
    if ax is not None:
        if not hasattr(ax, "imshow"):
            more = "; choose one of them, such as axes[0]" if isinstance(ax, np.ndarray) else ""
            raise TypeError(f"ax: expected one matplotlib Axes, got {type(ax).__name__}{more}")
        return ax
    figure = plt.figure(figsize=size, layout="compressed")
    made: Axes = figure.add_subplot(projection=projection)
    return made


def numbers_of(thing: object) -> Array:
    """Give the pixels of a CubeMap, a Frame or an Image, or the array itself."""
    if isinstance(thing, (CubeMap, Frame, Image)):
        return screen.numbers_of(thing)[0]
    if thing is None:
        raise TypeError(
            'expected numbers, got None: an output that outputs= did not request, such as ("distance", "id")'
        )
    if isinstance(thing, (str, os.PathLike)):
        raise TypeError(
            f"expected numbers, got the name {text_of(os.fspath(thing))}: cc.load_cubemap and cc.load_image read files"
        )
    pixels = _to_array(thing, "numbers")
    if pixels.dtype.kind not in "buif":
        raise TypeError(f"expected an array of numbers, got dtype {pixels.dtype}")
    return pixels


def is_cube(pixels: Array) -> bool:
    """Whether an array is (6, N, N) or (6, N, N, C)."""
    return pixels.ndim in (3, 4) and pixels.shape[0] == 6 and pixels.shape[1] == pixels.shape[2]


def faces_of(thing: object) -> Array:
    """Give (6, N, N) or (6, N, N, C) numbers of a cube."""
    pixels = numbers_of(thing)
    if not is_cube(pixels) or not pixels.size:
        raise ValueError(
            f"expected a CubeMap or an array (6, N, N) or (6, N, N, C), got {_shape(thing, pixels)}"
        )
    return pixels


def _shape(thing: object, pixels: Array) -> str:
    name = type(thing).__name__
    return f"shape {pixels.shape}" if isinstance(thing, np.ndarray) else f"{name} {pixels.shape}"


def are_colors(pixels: Array, leading: int) -> bool:
    """Whether numbers are colours, with 1, 3 or 4 channels after `leading` axes; else there is one number a pixel."""
    if pixels.ndim == leading:
        return False
    if pixels.ndim == leading + 1 and pixels.shape[-1] in (1, 3, 4):
        return True
    raise ValueError(f"expected 1, 3 or 4 channels on the last axis, got shape {pixels.shape}")


def on_screen(
    thing: CubeMap | Frame | Image | npt.ArrayLike,
    exposure: float,
    tonemap: Tonemap | None,
    encode: Encode | None = "srgb",
) -> npt.NDArray[np.uint8]:
    """Turn colours (..., C) into opaque uint8 (..., 3) for a screen."""
    shown = screen.to_screen(thing, exposure=exposure, tonemap=tonemap, encode=encode)
    return np.repeat(shown, 3, axis=-1) if shown.shape[-1] == 1 else shown[..., :3]


def show_numbers(
    ax: Axes,
    numbers: Array,
    *,
    cmap: str | None,
    vmin: float | None,
    vmax: float | None,
    bar: Axes | list[Axes] | None,
    covered: npt.NDArray[np.bool_] | None = None,
    among: Array | None = None,
    **image: Any,
) -> ScalarMappable:
    """Draw one number a pixel: whole numbers in a colour each, all others by a colour map.

    A colour bar, or a list of the whole numbers, stands beside the axes `bar`. Numbers that are not finite are drawn
    in APART; pixels that `covered` leaves out are transparent. Whole numbers have their colours by their place
    among the values of `among`, so that several pictures agree.
    """
    if numbers.dtype.kind in "bui":
        values = np.unique(numbers if among is None else among)
        return _show_labels(ax, numbers, values, cmap, bar, covered, **image)
    finite = np.isfinite(numbers)
    known = numbers[finite if covered is None else finite & covered]
    low = vmin if vmin is not None else (known.min() if known.size else 0.0)
    high = vmax if vmax is not None else (known.max() if known.size else 1.0)
    _paint_apart(ax, ~finite, covered, **image)
    values = np.ma.masked_array(numbers, ~finite if covered is None else ~(finite & covered))
    drawn = ax.imshow(values, cmap=cmap or "viridis", vmin=float(low), vmax=float(high), **image)
    if bar is not None:
        add_bar(drawn, bar)
    return drawn


def add_bar(drawn: ScalarMappable, ax: Axes | list[Axes], **options: Any) -> Any:
    first = ax[0] if isinstance(ax, list) else ax
    return first.figure.colorbar(drawn, ax=ax, fraction=0.035, pad=0.02, **options)


def _paint_apart(
    ax: Axes, apart: Array, covered: npt.NDArray[np.bool_] | None, **image: Any
) -> None:
    """Put APART below the pixels that the colour map leaves out."""
    from matplotlib.colors import to_rgba

    if covered is not None:
        apart = apart & covered
    if apart.any():
        ground = np.zeros((*apart.shape, 4))
        ground[apart] = to_rgba(APART)
        ax.imshow(ground, interpolation="nearest", **image)


def _show_labels(
    ax: Axes,
    numbers: Array,
    values: Array,
    cmap: str | None,
    bar: Axes | list[Axes] | None,
    covered: npt.NDArray[np.bool_] | None,
    **image: Any,
) -> ScalarMappable:
    from matplotlib.colors import ListedColormap

    places = np.searchsorted(values, numbers)
    shown = np.ma.masked_array(
        places, np.zeros(places.shape, bool) if covered is None else ~covered
    )
    drawn = ax.imshow(
        shown,
        cmap=ListedColormap(_label_colors(values, cmap)),
        vmin=-0.5,
        vmax=len(values) - 0.5,
        interpolation="nearest",
        **image,
    )
    if bar is not None and len(values) <= _MOST_LABELS:
        listed = add_bar(drawn, bar, ticks=range(len(values)))
        listed.ax.set_yticklabels([str(value) for value in values.tolist()])
        listed.ax.tick_params(length=0)
    return drawn


def _label_colors(values: Array, cmap: str | None) -> list[Any]:
    """Choose a colour for each value; without a colour map, 0 (no node) is grey and the others repeat tab20."""
    plt = pyplot()
    if cmap is not None:
        return list(plt.get_cmap(cmap)(np.linspace(0, 1, len(values))))
    palette = plt.get_cmap("tab20").colors
    # First the ten strong colours of tab20, then its ten pale ones.
    order = [*range(0, 20, 2), *range(1, 20, 2)]
    others = [value for value in values.tolist() if value != 0]
    colors = {value: palette[order[i % 20]] for i, value in enumerate(others)}
    return [colors.get(value, APART) for value in values.tolist()]


def put_label(ax: Axes, x: float, y: float, text: str, **options: Any) -> Artist:
    """Write white letters on a dark ground, which can be read on any picture."""
    style: dict[str, Any] = {"color": "white", "fontsize": 10, "fontweight": "bold"}
    ground = {"boxstyle": "round,pad=0.25", "facecolor": (0.05, 0.05, 0.05, 0.72), "linewidth": 0}
    return ax.text(x, y, text, bbox=ground, **{**style, **options})


def dark_edge(width: float, strength: float = 0.8) -> list[Any]:
    """Give path effects that set a bright line or letter off from a bright ground."""
    from matplotlib import patheffects

    return [patheffects.withStroke(linewidth=width, foreground=(0.05, 0.05, 0.05, strength))]
