"""The kinds of arrays that rays are made of; the first axis is that of the rays."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from .shading.vectors import Array

__all__ = ["Array", "Bools", "Ints"]

Bools: TypeAlias = npt.NDArray[np.bool_]
Ints: TypeAlias = npt.NDArray[np.int64]
