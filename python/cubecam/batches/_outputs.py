"""Outputs of batches: arrays by name, and properties for the names that the core knows."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

__all__ = ["Output", "OutputArrays"]

#: Numbers of an output.
OutputArrays = dict[str, npt.NDArray[np.float32 | np.int32 | np.uint8]]


class _HasOutputs(Protocol):
    @property
    def outputs(self) -> OutputArrays: ...


class Output:
    """A property of a batch: the array of an output, or None if it was not requested."""

    def __init__(self, shape: str, meaning: str) -> None:
        self.__doc__ = f"ndarray {shape}, or None: {meaning}."

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, batch: _HasOutputs | None, owner: type | None = None) -> Any:
        return self if batch is None else batch.outputs.get(self._name)
