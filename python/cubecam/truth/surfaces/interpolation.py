"""Values between the corners of triangles."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import Array


def interpolated(weights: Array, values: npt.NDArray[Any]) -> Array:
    """Return (R, C) of values (R, 3, C) at corners with weights (R, 3); exact where the corners are equal."""
    values = values.astype(np.float64)
    first = values[:, 0]
    mixed: Array = (
        first + weights[:, 1:2] * (values[:, 1] - first) + weights[:, 2:] * (values[:, 2] - first)
    )
    return mixed
