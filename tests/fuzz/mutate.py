"""Ways in which files break: bytes that change, are missing, come twice or stand elsewhere, and numbers that lie."""

from __future__ import annotations

import json
import re
import struct
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np

Rng = np.random.Generator
WORDS = [
    b"0", b"-1", b"1", b"2147483647", b"-2147483648", b"4294967295", b"18446744073709551616", b"1e308", b"1e400",
    b"nan", b"inf", b"-0", b"0x10", b"1.5", b"", b" ", b"\\\n", b"#", b"/", b"\0", b"\xff", b"999999999",
    b"100000000000", b"..",
]  # fmt: skip
INTEGERS = [
    0,
    1,
    2,
    3,
    4,
    7,
    127,
    128,
    255,
    256,
    32767,
    65535,
    65536,
    10**6,
    10**8,
    2**31 - 1,
    2**31,
    2**32 - 1,
]
VALUES: list[Any] = [
    None, True, False, -1, 0, 1, 2, 3, 0.5, 1e308, 1e400, 2**31, 2**63, 10**30, "", "x", "../a.bin", "data:,", [], {},
    [0], [[]], [None], {"a": 0}, 5120, 5121, 5123, 5125, 5126, "SCALAR", "VEC3", "MAT4",
]  # fmt: skip


def mutated(data: bytes, rng: Rng) -> bytes:
    """Break a file in one to a few places."""
    form = _form(data)
    for _ in range(int(rng.choice([1, 1, 1, 2, 3, 8]))):
        data = form[rng.integers(len(form))](data, rng)
    return data


def _form(data: bytes) -> list[Callable[[bytes, Rng], bytes]]:
    """List the ways that fit a kind of file; ways that go deep stand several times."""
    ways = [_flip, _byte, _integer, _cut, _delete, _insert, _repeat, _swap]
    if data[:4] == b"glTF":
        return [*ways, *[_glb_value] * 16]
    if data[:1] == b"{":
        return [*ways, *[_json_value] * 16]
    if data[:8] == b"\x89PNG\r\n\x1a\n":
        return [*ways, *[_png_chunk] * 8]
    if data.count(b"\n") * 200 > len(data) and b"\0" not in data[:2000]:
        return [*ways, *[_word] * 8, _lines, _lines]
    # The head of a binary file says the most.
    return [*ways, *[_head_integer] * 8, *[_head_word] * 4]


def _place(data: bytes, rng: Rng, size: int = 1) -> int:
    """Choose a place; half of them in the first 400 bytes."""
    top = max(1, len(data) - size + 1)
    return int(rng.integers(min(top, 400) if rng.random() < 0.5 else top))


def _flip(data: bytes, rng: Rng) -> bytes:
    at = _place(data, rng)
    return (
        data[:at] + bytes([data[at] ^ (1 << int(rng.integers(8)))]) + data[at + 1 :]
        if data
        else data
    )


def _byte(data: bytes, rng: Rng) -> bytes:
    at = _place(data, rng)
    return data[:at] + bytes([int(rng.integers(256))]) + data[at + 1 :]


def _pack(rng: Rng) -> bytes:
    value = INTEGERS[rng.integers(len(INTEGERS))]
    size = rng.choice(["<I", ">I", "<H", ">H", "<Q"])
    return struct.pack(size, value % (1 << (8 * struct.calcsize(size))))


def _integer(data: bytes, rng: Rng) -> bytes:
    new = _pack(rng)
    at = _place(data, rng, len(new))
    return data[:at] + new + data[at + len(new) :]


def _head_integer(data: bytes, rng: Rng) -> bytes:
    new = _pack(rng)
    at = int(rng.integers(max(1, min(len(data), 256)))) & ~1
    return data[:at] + new + data[at + len(new) :]


def _head_word(data: bytes, rng: Rng) -> bytes:
    head, rest = data[:600], data[600:]
    return _word(head, rng) + rest


def _cut(data: bytes, rng: Rng) -> bytes:
    return data[: _place(data, rng)]


def _delete(data: bytes, rng: Rng) -> bytes:
    at, size = _place(data, rng), int(2 ** rng.uniform(0, 8))
    return data[:at] + data[at + size :]


def _insert(data: bytes, rng: Rng) -> bytes:
    at, size = _place(data, rng), int(2 ** rng.uniform(0, 8))
    return data[:at] + rng.bytes(size) + data[at:]


def _repeat(data: bytes, rng: Rng) -> bytes:
    at, size = _place(data, rng), int(2 ** rng.uniform(0, 8))
    return data[: at + size] + data[at : at + size] * int(rng.integers(1, 40)) + data[at + size :]


def _swap(data: bytes, rng: Rng) -> bytes:
    a, b = sorted((_place(data, rng), _place(data, rng)))
    size = min(b - a, int(rng.integers(1, 64)), len(data) - b)
    if size <= 0:
        return data
    return (
        data[:a] + data[b : b + size] + data[a + size : b] + data[a : a + size] + data[b + size :]
    )


def _word(data: bytes, rng: Rng) -> bytes:
    words = list(re.finditer(rb"[^\s]+", data[:200_000]))
    if not words:
        return data
    one = words[rng.integers(len(words))]
    other = words[rng.integers(len(words))]
    new = other[0] if rng.random() < 0.3 else WORDS[rng.integers(len(WORDS))]
    return data[: one.start()] + new + data[one.end() :]


def _lines(data: bytes, rng: Rng) -> bytes:
    lines = data.split(b"\n")
    a, b = int(rng.integers(len(lines))), int(rng.integers(len(lines)))
    if rng.random() < 0.5:
        lines[a], lines[b] = lines[b], lines[a]
    else:
        del lines[a]
    return b"\n".join(lines)


def _png_chunk(data: bytes, rng: Rng) -> bytes:
    """Change a chunk of a PNG and make its checksum right again."""
    chunks, at = [], 8
    while at + 12 <= len(data):
        size = struct.unpack(">I", data[at : at + 4])[0]
        chunks.append((data[at + 4 : at + 8], data[at + 8 : at + 8 + size]))
        at += 12 + size
    if not chunks:
        return data
    which = int(rng.integers(len(chunks)))
    kind, body = chunks[which]
    if body:
        body = (_integer if rng.random() < 0.6 else _flip)(body, rng)
    chunks[which] = (kind, body)
    return data[:8] + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in chunks
    )


def _json_value(data: bytes, rng: Rng) -> bytes:
    """Change one value of a JSON text: another kind, another number, a key that is missing or new."""
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return _word(data, rng)
    places: list[tuple[Any, Any]] = []
    stack = [tree] if isinstance(tree, (dict, list)) else []
    while stack:
        item = stack.pop()
        pairs = item.items() if isinstance(item, dict) else enumerate(item)
        for key, value in pairs:
            places.append((item, key))
            if isinstance(value, (dict, list)):
                stack.append(value)
    if places:
        holder, key = places[rng.integers(len(places))]
        kind = rng.random()
        if kind < 0.15:
            del holder[key]
        elif kind < 0.3:
            other, name = places[rng.integers(len(places))]
            holder[key] = json.loads(json.dumps(other[name])) if name in _keys(other) else 0
        elif kind < 0.6 and isinstance(holder[key], int):
            holder[key] = int(holder[key]) + int(rng.choice([-1, 1, 2, 1000, 2**31]))
        else:
            holder[key] = VALUES[rng.integers(len(VALUES))]
    return json.dumps(tree).encode()


def _keys(holder: Any) -> Any:
    return holder if isinstance(holder, dict) else range(len(holder))


def _glb_value(data: bytes, rng: Rng) -> bytes:
    """Change a value of a GLB's JSON, and make the lengths right again."""
    if len(data) < 20:
        return data
    size = struct.unpack("<I", data[12:16])[0]
    text = _json_value(data[20 : 20 + size], rng)
    text += b" " * (-len(text) % 4)
    rest = data[20 + size :]
    return (
        struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
        + struct.pack("<I", len(text))
        + b"JSON"
        + text
        + rest
    )
