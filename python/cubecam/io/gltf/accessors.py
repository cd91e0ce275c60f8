"""Accessors: from bytes to arrays (section 3.6.2 of glTF 2.0)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .entries import Entry

Array = npt.NDArray[Any]

_COMPONENTS: dict[int, np.dtype[Any]] = {
    5120: np.dtype("<i1"),
    5121: np.dtype("<u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}

#: Columns and rows of each type. A vector is one column.
_SHAPES = {
    "SCALAR": (1, 1),
    "VEC2": (1, 2),
    "VEC3": (1, 3),
    "VEC4": (1, 4),
    "MAT2": (2, 2),
    "MAT3": (3, 3),
    "MAT4": (4, 4),
}


class View(NamedTuple):
    """The bytes of a buffer view, without compression, and its stride: 0 where elements stand side by side."""

    data: bytes | memoryview
    stride: int


@dataclass(frozen=True)
class Layout:
    """What an accessor says of its elements."""

    count: int
    kind: str
    component: np.dtype[Any]
    normalized: bool

    @property
    def shape(self) -> tuple[int, ...]:
        columns, rows = _SHAPES[self.kind]
        if self.kind == "SCALAR":
            return (self.count,)
        return (self.count, rows) if columns == 1 else (self.count, rows, columns)


def layout(entry: Entry) -> Layout:
    """Read count, type and component type of an accessor."""
    count = entry.integer("count")
    kind = entry.text("type")
    if kind not in _SHAPES:
        raise entry.error("type", f"one of {', '.join(_SHAPES)}")
    component = _component(entry)
    normalized = entry.flag("normalized")
    return Layout(count, kind, component, normalized and component.kind in "iu")


def stored(entry: Entry, view: Callable[[Entry], View | None], most: Callable[[], int]) -> Array:
    """Read the numbers of an accessor as they are stored: without `normalized`, with `sparse`.

    `view(entry)` returns the buffer view that an entry refers to. An accessor without one is all zeros; its count may
    not be above `most()`, because a file of a few bytes may claim any count. The result may show the file's own bytes.
    """
    form = layout(entry)
    found = view(entry)
    entry_of_sparse = entry.entry("sparse")
    # Before the limit is asked, because it depends on the bytes that were read.
    sparse = None if entry_of_sparse is None else _sparse(entry_of_sparse, view, form)
    if found is not None:
        values = _elements(form, found, entry)
    elif form.count > most():
        raise entry.error("count", f"at most {most()} elements without a buffer view")
    else:
        values = np.zeros(form.shape, form.component)
    if sparse is not None:
        values = np.array(values)
        values[sparse[0]] = sparse[1]
    return values


def decoded(values: Array, normalized: bool) -> Array:
    """Turn stored numbers into what they mean: normalized integers become 0..1 or -1..1 (section 3.6.2.2)."""
    if not normalized:
        return values
    most = np.iinfo(values.dtype).max
    result: Array = values / np.float64(most)
    # The lowest signed number, such as -128, means -1 as well.
    return np.maximum(result, -1.0) if values.dtype.kind == "i" else result


def _component(entry: Entry) -> np.dtype[Any]:
    number = entry.integer("componentType")
    if number not in _COMPONENTS:
        raise entry.error("componentType", f"one of {', '.join(map(str, _COMPONENTS))}")
    return _COMPONENTS[number]


def _elements(form: Layout, view: View, entry: Entry) -> Array:
    """Make an array that shows the elements in the bytes of a view."""
    columns, rows = _SHAPES[form.kind]
    width = form.component.itemsize
    # Each column of a matrix starts at a multiple of 4 bytes (section 3.6.2.4).
    column = rows * width if columns == 1 else -(-rows * width // 4) * 4
    size = (columns - 1) * column + rows * width  # the padding of the last column may be missing
    stride = view.stride or columns * column
    if stride < size:
        raise MeshError(
            f"{entry.where}: expected a byteStride of at least {size} in its buffer view, got {stride}"
        )
    offset = entry.integer("byteOffset", 0)
    if form.count == 0:
        return np.zeros(form.shape, form.component)
    end = offset + stride * (form.count - 1) + size
    if end > len(view.data):
        raise MeshError(
            f"{entry.where}: expected {end} bytes in its buffer view, got {len(view.data)}"
        )
    if form.count == 1:
        stride = size  # the stride has no meaning then, and may be any number
    values: Array = np.ndarray(
        (form.count, columns, rows), form.component, view.data, offset, (stride, column, width)
    )
    # Columns stand one after another; as an array, a matrix has rows first.
    return values.transpose(0, 2, 1) if columns > 1 else values.reshape(form.shape)


def _sparse(
    sparse: Entry, view: Callable[[Entry], View | None], form: Layout
) -> tuple[Array, Array]:
    """Read the places of sparse elements and the elements (section 3.6.2.3)."""
    count = sparse.integer("count")
    if count > form.count:
        raise sparse.error("count", f"at most the accessor's {form.count} elements")
    where, what = sparse.needed("indices"), sparse.needed("values")
    component = _component(where)
    if component.kind != "u":
        raise where.error("componentType", "an unsigned integer type")
    places = _sparse_part(Layout(count, "SCALAR", component, False), where, view)
    new = _sparse_part(Layout(count, form.kind, form.component, False), what, view)
    if count and (int(places[-1]) >= form.count or not (places[1:] > places[:-1]).all()):
        raise MeshError(
            f"{where.where}: expected increasing indices below {form.count}, got others"
        )
    return places, new


def _sparse_part(form: Layout, entry: Entry, view: Callable[[Entry], View | None]) -> Array:
    found = view(entry)
    if found is None:
        raise entry.error("bufferView", "an index")
    return _elements(form, View(found.data, 0), entry)
