"""What a test of the self-test measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["Measurement", "worst"]


@dataclass(frozen=True)
class Measurement:
    """One line of the self-test.

    Attributes
    ----------
    name : str
        What was tested: "orientation", "seams", "formats", "mirrors" or "shader".
    what : str
        Which numbers were compared.
    error : float
        The largest difference between the picture and numpy; NaN if there was no picture.
    tolerance : float
        The largest one that passes.
    failure : str
        What else went wrong; "" if nothing did.
    """

    name: str
    what: str
    error: float
    tolerance: float
    failure: str = ""

    @property
    def passed(self) -> bool:
        """Whether the test passed; an error that is NaN does not."""
        return not self.failure and self.error <= self.tolerance


def worst(got: Any, expected: Any) -> float:
    """Give the largest difference of two arrays of one shape; infinity if one of them is no number there."""
    import numpy as np

    one, other = np.asarray(got, np.float64), np.asarray(expected, np.float64)
    if one.shape != other.shape:
        raise ValueError(f"expected an array of shape {other.shape}, got {one.shape}")
    with np.errstate(invalid="ignore"):  # infinity equals infinity
        difference = np.where(one == other, 0.0, np.abs(one - other))
    return float(np.nan_to_num(difference, nan=np.inf).max(initial=0.0))
