"""Outputs of batches: arrays by name, and properties for the names that the core knows."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from .._core import _output_table

__all__ = ["MEANINGS", "Output", "OutputArrays"]

#: Numbers of an output.
OutputArrays = dict[str, npt.NDArray[np.float32 | np.int32 | np.uint8]]

#: Channels, dtype and meaning of the outputs that the core knows.
MEANINGS = {name: (channels, dtype, text) for name, _, channels, dtype, text in _output_table()}


class _HasOutputs(Protocol):
    @property
    def outputs(self) -> OutputArrays: ...


class Output:
    """A property of a batch: the array of an output, or None if it was not requested."""

    def __init__(self, axes: str) -> None:
        self._axes = axes

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name
        channels, dtype, meaning = MEANINGS[name]
        shape = f"({self._axes}, {channels})" if channels > 1 else f"({self._axes})"
        self.__doc__ = f"ndarray {shape} {dtype}, or None: {meaning}."

    def __get__(self, batch: _HasOutputs | None, owner: type | None = None) -> Any:
        return self if batch is None else batch.outputs.get(self._name)
