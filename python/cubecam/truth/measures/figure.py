"""The figure of a comparison: picture, truth, error and FLIP side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from ... import plot
from ...io.screen import Clipping, check_look, screen_pixels
from ...plot._figure import pyplot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ...typing import Convention, Tonemap
    from .comparison import Comparison

Array = npt.NDArray[Any]

_WIDTH = 5.0  # inches of a picture


def comparison_figure(
    found: Comparison, *, exposure: float, scale: Literal["linear", "log"], convention: Convention
) -> Figure:
    """Draw what `Comparison.plot` describes."""
    check_look(exposure, None)
    flips = found.flip_map
    cube = found.error.ndim == 3
    # The cross has 3 rows of 4 cells.
    shape = 0.75 if cube else found.error.shape[0] / found.error.shape[1]
    height = 0.9 * _WIDTH * min(max(shape, 0.2), 2.0) + 0.35
    rows, columns = (1, 3) if flips is None else (2, 2)
    size = ((_WIDTH + 0.4) * columns, height * rows + 0.7)
    figure, axes = pyplot().subplots(
        rows, columns, figsize=size, layout="compressed", squeeze=False
    )
    first, second, third, *rest = axes.ravel()
    for ax, pixels, name in ((first, found.picture, "picture"), (second, found.truth, "truth")):
        _show(ax, _on_screen(found, pixels, exposure), cube, convention)
        ax.set_title(name, fontsize=10)
    plot.error_map(
        found.error, np.zeros_like(found.error), scale=scale, convention=convention, ax=third
    )
    where = f"max {found.max:.4g} at {found.place}" if found.max else "none"
    third.set_title(f"error: {where}", fontsize=10)
    if flips is not None:
        look: dict[str, Any] = {"cmap": "magma", "vmin": 0.0, "vmax": 1.0}
        _show(rest[0], flips, cube, convention, **look)
        rest[0].set_title(f"FLIP ({found.flip_range}): mean {found.flip:.4g}", fontsize=10)
    figure.suptitle(_title(found), fontsize=11)
    made: Figure = figure
    return made


def _on_screen(found: Comparison, pixels: Array, exposure: float) -> npt.NDArray[np.uint8]:
    curve: Tonemap | None = "neutral" if found.curve and found.encoding == "linear" else None
    light = np.clip(pixels, -1e18, 1e18).astype(np.float32)
    with Clipping().gathered():  # a figure needs no warning about what files of 8 bits clip
        return screen_pixels(light, found.encoding, exposure, curve, True)


def _show(ax: Axes, pixels: Array, cube: bool, convention: Convention, **look: Any) -> None:
    if cube:
        plot.cross(pixels, convention=convention, ax=ax, **look)
    else:
        plot.pictures([pixels], ax=[ax], **look)


def _title(found: Comparison) -> str:
    rows = dict(found.rows())
    relative = "" if found.relative_rmse is None else f" ({rows['relative RMSE']} of the truth)"
    parts = [f"RMSE {found.rmse:.4g}{relative}", f"mean absolute {found.mean_absolute:.4g}"]
    parts += [] if found.ssim is None else [f"SSIM {found.ssim:.4f}"]
    parts += [] if found.flip is None else [f"FLIP {found.flip:.4f}"]
    worst = f"worst: {rows['picture there']} in place of {rows['truth there']}"
    apart = (
        f"; {found.counted} of {found.total} pixels count" if found.counted < found.total else ""
    )
    return f"{', '.join(parts)}\n{worst}{apart}"
