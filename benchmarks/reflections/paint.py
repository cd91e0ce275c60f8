"""Pictures for the walls, floors and furniture of the scenes: procedural, (H, W, 3) of numbers from 0 to 1."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Color: TypeAlias = Sequence[float]
Array: TypeAlias = npt.NDArray[np.float64]

CREAM = (0.93, 0.87, 0.75)
SAGE = (0.56, 0.68, 0.58)
WHITE = (0.94, 0.94, 0.92)
OAK = (0.76, 0.56, 0.36)
WALNUT = (0.42, 0.27, 0.17)
RED = (0.74, 0.22, 0.18)
BLUE = (0.2, 0.36, 0.62)
GOLD = (0.87, 0.68, 0.26)
TEAL = (0.13, 0.46, 0.48)
BOOKS = (
    (0.66, 0.32, 0.28),
    (0.32, 0.44, 0.6),
    (0.74, 0.6, 0.36),
    (0.36, 0.52, 0.36),
    (0.78, 0.75, 0.7),
    (0.3, 0.5, 0.5),
)


def grid(width: int, height: int) -> tuple[Array, Array]:
    """Give u (H, W), which grows to the right, and v, which grows upwards; texel middles, 0 to 1."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)
    return u, v


def mixed(share: npt.NDArray[Any], first: Color, second: Color) -> Array:
    """Mix two colours: the first where the share (H, W) is 0, the second where it is 1."""
    part = np.asarray(share, float)[..., None]
    result: Array = (1 - part) * np.asarray(first, float) + part * np.asarray(second, float)
    return result


def clouds(width: int, height: int, cells: int, seed: int) -> Array:
    """Smooth noise (H, W) from 0 to 1 that repeats at the edges: two octaves of random numbers on a lattice."""
    rng = np.random.default_rng(seed)
    u, v = grid(width, height)
    total = np.zeros_like(u)
    for octave, weight in ((1, 0.65), (2, 0.35)):
        n = cells * octave
        table = rng.random((n, n))
        x, y = u * n, v * n
        i, j = x.astype(int) % n, y.astype(int) % n
        fx, fy = (t * t * (3 - 2 * t) for t in (x - np.floor(x), y - np.floor(y)))
        low = table[j, i] * (1 - fx) + table[j, (i + 1) % n] * fx
        high = table[(j + 1) % n, i] * (1 - fx) + table[(j + 1) % n, (i + 1) % n] * fx
        total += weight * (low * (1 - fy) + high * fy)
    return total


def checks(columns: int, rows: int, first: Color, second: Color, size: int = 256) -> Array:
    """A chessboard."""
    u, v = grid(size, size)
    odd = ((u * columns).astype(int) + (v * rows).astype(int)) % 2
    return mixed(odd, first, second)


def stripes(count: int, first: Color, second: Color, slant: float = 0.0, size: int = 256) -> Array:
    """Stripes along v, or slanted: `slant` is how many stripes they move to the right from the bottom to the top."""
    u, v = grid(size, size)
    return mixed(np.floor((u * count + v * slant) * 2) % 2, first, second)


def planks(first: Color, second: Color, boards: int = 8, size: int = 256, seed: int = 1) -> Array:
    """Boards of different tones with dark gaps, along u."""
    rng = np.random.default_rng(seed)
    u, v = grid(size, size)
    board = (v * boards).astype(int) % boards
    shift = rng.random(boards)[board]
    piece = ((u + shift) * 2).astype(int) % 2
    tone = rng.random((boards, 2))[board, piece]
    color = mixed(tone, first, second)
    gap = ((v * boards) % 1 < 0.06) | (((u + shift) * 2) % 1 < 0.012)
    color[gap] *= 0.45
    return color


def bricks(brick: Color, mortar: Color, rows: int = 8, size: int = 256, seed: int = 2) -> Array:
    """A wall of bricks."""
    rng = np.random.default_rng(seed)
    u, v = grid(size, size)
    row = (v * rows).astype(int) % rows
    x = u * rows / 2 + 0.5 * (row % 2)
    tone = 0.75 + 0.4 * rng.random((rows, rows))[row, x.astype(int) % (rows // 2)]
    color: Array = np.asarray(brick, float) * tone[..., None]
    color[((v * rows) % 1 < 0.12) | (x % 1 < 0.06)] = mortar
    return color


def books(colors: Sequence[Color], shelves: int = 4, wood: Color = (0.42, 0.27, 0.15)) -> Array:
    """Shelves full of books, (256, 256, 3)."""
    rng = np.random.default_rng(7)
    u, v = grid(256, 256)
    color: Array = np.broadcast_to(np.asarray(wood, float) * 0.6, (256, 256, 3)).copy()
    for shelf in range(shelves):
        x = 0.03
        while x < 0.95:
            wide, tall = rng.uniform(0.05, 0.1), rng.uniform(0.62, 0.86)
            place = v * shelves - shelf
            on = (u >= x) & (u < min(x + wide, 0.97)) & (place > 0.1) & (place < 0.1 + tall)
            tone = np.asarray(colors[int(rng.integers(len(colors)))], float) * rng.uniform(0.8, 1.1)
            color[on] = tone
            color[on & (np.abs(place - 0.1 - 0.7 * tall) < 0.04)] = tuple(
                0.6 * c + 0.25 for c in tone
            )
            x += wide + 0.004
        color[(v * shelves - shelf >= 0) & (v * shelves - shelf < 0.1)] = wood
    color[(u < 0.03) | (u > 0.97) | (v > 0.98)] = wood
    return color


def painting(seed: int) -> Array:
    """An abstract picture in a frame, (192, 256, 3): discs over fields of colour."""
    rng = np.random.default_rng(seed)
    u, v = grid(256, 192)
    fields = rng.random((3, 3))
    color = mixed(v, fields[0] * 0.9, fields[1] * 0.5 + 0.5)
    color[v < 0.3 + 0.06 * np.sin(9 * u + seed)] = fields[2] * 0.6 + 0.1
    for _ in range(5):
        x, y, r = rng.uniform(0.1, 0.9), rng.uniform(0.2, 0.9), rng.uniform(0.05, 0.2)
        color[(u - x) ** 2 + (0.75 * (v - y)) ** 2 < r * r] = rng.random(3)
    edge = np.minimum(np.minimum(u, 1 - u), 0.75 * np.minimum(v, 1 - v))
    color[edge < 0.05] = (0.93, 0.9, 0.84)
    color[edge < 0.03] = (0.5, 0.36, 0.16)
    return color


def rug(ground: Color, pattern: Color, border: Color) -> Array:
    """A rug with rhombs and borders, (256, 256, 3)."""
    u, v = grid(256, 256)
    rhombs = np.abs((u * 5) % 1 - 0.5) + np.abs((v * 4) % 1 - 0.5)
    color: Array = np.broadcast_to(np.asarray(ground, float), (256, 256, 3)).copy()
    color[rhombs < 0.36] = pattern
    color[rhombs < 0.2] = border
    edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
    color[edge < 0.09] = border
    color[(edge < 0.03) | ((edge > 0.09) & (edge < 0.11))] = pattern
    return color


def window(size: int = 256) -> Array:
    """A window with hills and a sky behind its bars."""
    u, v = grid(size, size)
    color = mixed(np.clip(2 * v - 0.8, 0, 1), (0.93, 0.95, 0.98), (0.42, 0.66, 0.95))
    cloud = clouds(size, size, 5, 3)
    color = (
        color + np.clip(3 * (cloud - 0.55), 0, 1)[..., None] * (1 - color) * (v > 0.45)[..., None]
    )
    color[v < 0.42 + 0.08 * np.sin(7 * u + 1)] = (0.35, 0.55, 0.3)
    color[v < 0.25 + 0.05 * np.sin(11 * u)] = (0.22, 0.42, 0.2)
    bar = (np.minimum(u, 1 - u) < 0.03) | (np.minimum(v, 1 - v) < 0.03)
    bar |= (np.abs(u - 0.5) < 0.018) | (np.abs(v - 0.62) < 0.018)
    color[bar] = (0.95, 0.95, 0.93)
    return color


def facade(
    wall: Color, frame: Color, columns: int = 3, rows: int = 2, *, door: bool = False
) -> Array:
    """The front of a house, (128, 128, 3): plaster, windows with shutters, a door in the middle."""
    u, v = grid(128, 128)
    color: Array = np.asarray(wall, float) * (0.92 + 0.12 * clouds(128, 128, 8, 5))[..., None]
    x, y = (u * columns) % 1, (v * rows) % 1
    inside = (np.abs(x - 0.5) < 0.17) & (np.abs(y - 0.55) < 0.26)
    around = (np.abs(x - 0.5) < 0.21) & (np.abs(y - 0.55) < 0.31)
    shutter = (np.abs(np.abs(x - 0.5) - 0.3) < 0.08) & (np.abs(y - 0.55) < 0.28)
    color[shutter] = np.asarray(frame) * 0.6
    color[around] = frame
    color[inside] = (0.16, 0.22, 0.3)
    color[inside & (np.abs(x - 0.5) < 0.012)] = frame
    if door:
        middle = (np.abs(u - 0.5) < 0.11) & (v < 0.4)
        color[(np.abs(u - 0.5) < 0.17) & (v < 0.5)] = wall
        color[middle] = (0.35, 0.16, 0.1)
        color[middle & (np.abs(u - 0.43) < 0.012) & (np.abs(v - 0.2) < 0.02)] = (0.9, 0.8, 0.4)
    color[v < 0.05] = (0.4, 0.38, 0.36)
    return color


def in_bytes(color: Array) -> npt.NDArray[np.uint8]:
    """Give a picture as uint8, in steps of 4, which files of PNG hold in less than half the bytes."""
    return np.asarray(np.clip(np.rint(np.clip(color, 0, 1) * 255 / 4) * 4, 0, 255), np.uint8)


def crate() -> Array:
    """The side of a wooden crate, (128, 128, 3)."""
    u, v = grid(128, 128)
    color = planks((0.78, 0.6, 0.38), (0.62, 0.45, 0.27), 5, 128, 9)
    edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
    color[(edge < 0.13) | (np.abs(u - v) < 0.09)] = (0.55, 0.38, 0.22)
    color[(np.abs(edge - 0.13) < 0.012) | (np.abs(np.abs(u - v) - 0.09) < 0.012)] = (
        0.38,
        0.26,
        0.16,
    )
    return color


def door() -> Array:
    """A door with four panels in a frame, (192, 128, 3)."""
    u, v = grid(128, 192)
    color: Array = np.broadcast_to(np.asarray(WALNUT) * 1.2, (192, 128, 3)).copy()
    panel = (np.abs((u * 2) % 1 - 0.5) < 0.33) & (np.abs((v * 2) % 1 - 0.5) < 0.38)
    color[panel] = np.asarray(WALNUT) * 0.85
    color[(np.minimum(u, 1 - u) < 0.06) | (v > 0.96)] = WHITE
    color[np.hypot((u - 0.86) * 0.67, v - 0.48) < 0.025] = GOLD
    return color
