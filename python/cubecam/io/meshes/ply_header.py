"""The header of a PLY file: its elements, and the types of their properties."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..._core import MeshError
from .plain_text import shown

# Codes of numpy, without the order of bytes.
_TYPES = {
    b"char": "i1",
    b"int8": "i1",
    b"uchar": "u1",
    b"uint8": "u1",
    b"short": "i2",
    b"int16": "i2",
    b"ushort": "u2",
    b"uint16": "u2",
    b"int": "i4",
    b"int32": "i4",
    b"uint": "u4",
    b"uint32": "u4",
    b"float": "f4",
    b"float32": "f4",
    b"double": "f8",
    b"float64": "f8",
}
# The order of bytes, "" for text.
_FORMATS = {b"ascii": "", b"binary_little_endian": "<", b"binary_big_endian": ">"}


@dataclass(frozen=True)
class Property:
    """A number of each row, or a list: then `count` is the type of its length."""

    name: str
    type: str
    count: str | None


@dataclass(frozen=True)
class Element:
    """A table of `count` rows."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


@dataclass(frozen=True)
class Header:
    """`order` is that of the bytes, "" for text; `start` is where the data begin, in line number `line`."""

    order: str
    elements: list[Element]
    start: int
    line: int


def read_header(data: bytes) -> Header:
    order = None
    elements: list[Element] = []
    place, end_of_line, number = 0, b"\n", 0
    while True:
        number += 1
        end = data.find(end_of_line, place)
        if number == 1:
            start = data[:200].removeprefix(b"\xef\xbb\xbf")
            if start.split(None, 1)[:1] != [b"ply"]:
                raise MeshError(f"expected a file that begins with ply, got {shown(start[:20])}")
            # Old programs end the lines by carriage returns. What ends the first line ends all of the header: after
            # the last line a byte that looks like a line feed may be the first of the data.
            carriage = data.find(b"\r", 0, end if end >= 0 else len(data))
            if carriage >= 0 and carriage + 1 != end:
                end_of_line, end = b"\r", carriage
        if end < 0:
            raise MeshError("expected a header that ends with end_header, got the end of the file")
        words = data[place:end].split()
        place = end + 1
        word = words[0] if words else b""
        if word == b"end_header":
            break
        if word == b"format" and len(words) > 1:
            order = _FORMATS.get(words[1])
            if order is None:
                raise _wrong(number, " or ".join(name.decode() for name in _FORMATS), words[1])
        elif word == b"element":
            elements.append(_element(number, words))
        elif word == b"property":
            if not elements:
                raise _wrong(number, "an element before its properties", b" ".join(words))
            elements[-1].properties.append(_property(number, words))
        elif words and number > 1 and word not in (b"comment", b"obj_info"):
            raise _wrong(number, "element, property, comment or end_header", b" ".join(words))
    if order is None:
        raise MeshError("expected a line with the format in the header, got none")
    return Header(order, elements, place, number + 1)


def _element(number: int, words: list[bytes]) -> Element:
    if len(words) < 3 or not words[2].isdigit() or len(words[2]) > 18:
        raise _wrong(number, "element, a name and a number of rows", b" ".join(words))
    return Element(words[1].decode("utf-8", "replace"), int(words[2]))


def _property(number: int, words: list[bytes]) -> Property:
    is_list = words[1:2] == [b"list"]
    if len(words) < (5 if is_list else 3):
        raise _wrong(
            number, "property, a type and a name, or property list and two types", b" ".join(words)
        )
    types = words[2:4] if is_list else words[1:2]
    for each in types:
        if each not in _TYPES:
            raise _wrong(number, "a type such as int, uchar or float", each)
    codes = [_TYPES[each] for each in types]
    if is_list and codes[0].startswith("f"):
        raise _wrong(number, "a type of whole numbers for the length of a list", types[0])
    name = words[4 if is_list else 2].decode("utf-8", "replace")
    return Property(name, codes[-1], codes[0] if is_list else None)


def _wrong(number: int, expected: str, got: bytes) -> MeshError:
    return MeshError(f"line {number}: expected {expected}; got {shown(got)}")
