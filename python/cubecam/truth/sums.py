"""The sums of the samples of a picture, and how far their means can be trusted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .matrices import luminance
from .work import Piece


@dataclass
class Sums:
    """The sums of a picture's pixels, flat: colour and alpha, squared luminance, and the number of samples (P, 6).

    They stand in one array, so that Ctrl-C never comes between colours and their number.
    """

    table: npt.NDArray[np.float64]

    @property
    def color(self) -> npt.NDArray[np.float64]:
        return self.table[:, :4]

    @property
    def squares(self) -> npt.NDArray[np.float64]:
        return self.table[:, 4]

    @property
    def samples(self) -> npt.NDArray[np.int64]:
        return self.table[:, 5].astype(np.int64)

    def add(self, piece: Piece, color: npt.NDArray[Any], squares: npt.NDArray[Any]) -> None:
        """Add the samples of some pixels."""
        number = np.full(len(squares), piece.samples[1] - piece.samples[0])
        self.table[slice(*piece.pixels)] += np.column_stack([color, squares, number])

    def deviation(self) -> npt.NDArray[np.float64]:
        """Give the standard error of each pixel's luminance."""
        n = self.samples
        with np.errstate(divide="ignore", invalid="ignore"):
            mean = self.luminance()
            variance = np.maximum(self.squares / n - mean**2, 0) / (n - 1)
        # Rounding makes a variance of numbers that are all equal.
        variance = np.where(variance * (n - 1) < 1e-12 * mean**2, 0.0, variance)
        return np.where(n > 1, np.sqrt(variance), np.inf)

    def luminance(self) -> npt.NDArray[np.float64]:
        with np.errstate(divide="ignore", invalid="ignore"):
            mean = luminance(self.color) / self.samples
        return np.asarray(np.where(self.samples > 0, mean, 0.0))

    def noise(self) -> float:
        """Give the error of the whole picture, relative to its light."""
        error = float(np.sqrt(np.mean(self.deviation() ** 2)))
        light = float(np.sqrt(np.mean(self.luminance() ** 2)))
        if error == 0:
            return 0.0
        return error / light if light > 0 else math.inf
