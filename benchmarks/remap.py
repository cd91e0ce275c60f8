"""Equirect to cube and back against cv2.remap with ready maps: CPU time of all threads, in turns.

cv2.remap looks up four pixels, unfiltered, by float maps that were made before. cubecam filters over each texel. The
pictures are compared where they must agree: of a smooth picture the two differ by little, everywhere but at the
edges of faces, which the maps clamp.
"""

from __future__ import annotations

import resource
import statistics
from collections.abc import Callable
from typing import Any

import numpy as np

from .results import Row, Section

MARK = 1.0
TOLERANCE = {"float32": 0.004, "uint8": 0.008}
#: The vectors whose dot products with a direction give s, t (in -1..1) and the axis of a face, +X -X +Y -Y +Z -Z.
FACES = np.array(
    [
        [[0, 0, -1], [0, -1, 0], [1, 0, 0]],
        [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],
        [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
        [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[1, 0, 0], [0, -1, 0], [0, 0, 1]],
        [[-1, 0, 0], [0, -1, 0], [0, 0, -1]],
    ],
    float,
)

Map = tuple[np.ndarray, np.ndarray]


def to_cube_map(width: int, height: int, size: int) -> Map:
    """(6 N, N) columns and rows of the panorama for the texels of the faces."""
    middles = (np.arange(size) + 0.5) / size * 2 - 1
    t, s = np.meshgrid(middles, middles, indexing="ij")
    texels = np.stack([s, t, np.ones_like(s)], axis=-1)
    x, y, z = np.moveaxis(np.einsum("ijk,fkl->fijl", texels, FACES), -1, 0)
    column = (0.5 + np.arctan2(x, -z) / (2 * np.pi)) * width - 0.5
    row = (0.5 - np.arctan2(y, np.hypot(x, z)) / np.pi) * height - 0.5
    flat = (6 * size, size)
    return column.astype(np.float32).reshape(flat), row.astype(np.float32).reshape(flat)


def to_equirect_map(width: int, height: int, size: int) -> Map:
    """(H, W) columns and rows of the six faces, one below the other, for the pixels of the panorama."""
    longitude = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    latitude = (0.5 - (np.arange(height) + 0.5) / height) * np.pi
    lon, lat = np.meshgrid(longitude, latitude)
    d = np.stack([np.cos(lat) * np.sin(lon), np.sin(lat), -np.cos(lat) * np.cos(lon)], axis=-1)
    axis = np.abs(d).argmax(-1)
    length = np.take_along_axis(d, axis[..., None], -1)[..., 0]
    face = 2 * axis + (length < 0)
    s, t = (np.einsum("ijk,ijk->ij", FACES[face][..., k, :], d) / np.abs(length) for k in (0, 1))
    column, row = ((u + 1) / 2 * size - 0.5 for u in (s, t))
    return column.astype(np.float32), (row.clip(0, size - 1) + face * size).astype(np.float32)


def _cpu_ms() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF)
    return (used.ru_utime + used.ru_stime) * 1e3


def _times(calls: dict[str, Callable[[], object]], rounds: int) -> dict[str, list[float]]:
    """CPU milliseconds of all threads; the calls take turns, and three rounds warm up."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for number in range(rounds + 3):
        for name, call in calls.items():
            start = _cpu_ms()
            call()
            if number >= 3:
                times[name].append(_cpu_ms() - start)
    return times


def _section(
    key: str, title: str, own: Callable[[], Any], other: Callable[[], Any], quick: bool
) -> Section:
    section = Section(key, title)
    mine, theirs = (np.asarray(call()).reshape(-1) for call in (own, other))
    scale = 255 if mine.dtype == np.uint8 else 1
    # Edges of faces, which the maps clamp, are a few of a thousand pixels.
    apart = np.abs(mine.astype(float) - theirs.astype(float)) / scale
    limit = TOLERANCE[mine.dtype.name]
    share = float((apart > limit).mean())
    if share > 0.02:
        section.failed = True
        section.notes.append(f"the pictures differ by more than {limit} in {share:.1%} of numbers")
        return section
    times = _times({"own": own, "other": other}, 10 if quick else 40)
    ratio = statistics.median(a / b for a, b in zip(times["own"], times["other"], strict=True))
    section.rows = [
        Row("cubecam, filtered", statistics.median(times["own"])),
        Row("cv2.remap, ready maps", statistics.median(times["other"]), ratio, MARK),
    ]
    section.notes.append(
        f"CPU of all threads; least times {min(times['own']):.1f} and {min(times['other']):.1f} ms;"
        f" pictures compared: {share:.2%} of numbers differ by more than {limit}"
    )
    return section


def run(image: np.ndarray, size: int, quick: bool) -> list[Section]:
    """Time both directions of a smooth panorama (H, W, 3), as float32 and as uint8."""
    height, width = image.shape[:2]
    try:
        import cv2

        import cubecam as cc
    except ImportError as error:
        failed = getattr(error, "name", "") == "cubecam"
        return [Section("remap", "panoramas against cv2.remap", notes=[str(error)], failed=failed)]
    to_cube, to_equirect = to_cube_map(width, height, size), to_equirect_map(width, height, size)

    def remap(picture: np.ndarray, places: Map) -> Any:
        return cv2.remap(picture, *places, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)

    sections = []
    for dtype in ("float32", "uint8"):
        picture = (image * 255).round().astype(dtype) if dtype == "uint8" else image
        cube = cc.CubeMap.from_equirect(picture, size=size)
        column = np.array(cube.faces).reshape(6 * size, size, 3)
        sections += [
            _section(
                f"e2c-cv2-{dtype}",
                f"equirect {width}x{height} to cube {size}, {dtype}",
                lambda picture=picture: cc.CubeMap.from_equirect(picture, size=size),  # type: ignore[misc]
                lambda picture=picture: remap(picture, to_cube),  # type: ignore[misc]
                quick,
            ),
            _section(
                f"c2e-cv2-{dtype}",
                f"cube {size} to equirect {width}x{height}, {dtype}",
                lambda cube=cube: cube.to_equirect(width=width),  # type: ignore[misc]
                lambda column=column: remap(column, to_equirect),  # type: ignore[misc]
                quick,
            ),
        ]
    return sections
