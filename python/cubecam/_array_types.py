"""The types of arrays that cubecam.typing exports; apart from it, since they need numpy."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["Color", "FilePixels", "Outputs", "Pixels"]

#: A colour: three or four numbers, a CSS name, or a text such as "#rrggbb".
Color: TypeAlias = str | npt.ArrayLike
#: An array of pixels, such as ``frame.color`` and ``cube.faces``.
Pixels: TypeAlias = npt.NDArray[np.uint8 | np.float16 | np.float32]
#: An array that `load_image` returns: an EXR file may hold whole numbers of 32 bits.
FilePixels: TypeAlias = npt.NDArray[np.uint8 | np.uint32 | np.float16 | np.float32]
#: An array of an output, such as ``frame.outputs["id"]``.
Outputs: TypeAlias = npt.NDArray[np.float32 | np.int32 | np.uint8]
