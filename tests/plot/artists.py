"""What matplotlib's artists hold, as arrays and with types: matplotlib declares most of it as optional."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.image import AxesImage
from matplotlib.legend import Legend
from matplotlib.lines import Line2D


def array_of(image: AxesImage) -> np.ndarray:
    """The array that an image shows; it may be a masked array."""
    array = image.get_array()
    assert array is not None
    return array


def mapped_colors(image: AxesImage, numbers: Any = None) -> np.ndarray:
    """(..., 4): RGBA that the image's norm and colour map give to its own array or to other numbers."""
    values = array_of(image) if numbers is None else numbers
    return np.asarray(image.cmap(image.norm(values)))


def legend_of(ax: Axes) -> Legend:
    legend = ax.get_legend()
    assert legend is not None
    return legend


def xdata(line: Line2D) -> np.ndarray:
    return np.asarray(line.get_xdata())


def ydata(line: Line2D) -> np.ndarray:
    return np.asarray(line.get_ydata())
