"""Equirect to cube and back, 2048 x 1024 and six 512 x 512 faces, against py360convert and cv2.remap."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np

from . import remap
from .results import Row, Section

WIDTH, HEIGHT, FACE = 2048, 1024, 512
MARK = 1 / 20
# py360convert samples at borders, cubecam at texel centres, so their samples lie up to half a texel
# apart. The colours of this picture change by less than 3 for each radian, so that the difference
# is below 0.01. A face that is swapped or flipped differs by more than 0.5.
TOLERANCE = 0.01
MARGIN = 8
# py360convert's faces are the natural views of a picture whose centre is -Z.
PY360_ORDER = (1, 3, 4, 5, 2, 0)  # +X -X +Y -Y +Z -Z among its F R B L U D


def _pattern(direction: np.ndarray) -> np.ndarray:
    """(..., 3) smooth colours of directions, which differ on every side and have no symmetry."""
    x, y, z = np.moveaxis(direction, -1, 0)
    colors = [0.5 + 0.3 * x + 0.1 * y * z, 0.5 + 0.3 * y + 0.1 * z * x, 0.5 + 0.3 * z + 0.1 * x * y]
    return np.stack(colors, axis=-1).astype(np.float32)


def _picture() -> np.ndarray:
    """(1024, 2048, 3): the pattern as a panorama whose centre column looks along -Z."""
    longitude = ((np.arange(WIDTH) + 0.5) / WIDTH - 0.5) * 2 * np.pi
    latitude = (0.5 - (np.arange(HEIGHT) + 0.5) / HEIGHT) * np.pi
    lon, lat = np.meshgrid(longitude, latitude)
    return _pattern(
        np.stack([np.cos(lat) * np.sin(lon), np.sin(lat), -np.cos(lat) * np.cos(lon)], axis=-1)
    )


def _times(calls: dict[str, Callable[[], object]], rounds: int) -> dict[str, list[float]]:
    """Milliseconds of each call in each round; the calls take turns, and an additional first round warms up."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds + 1):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            times[name].append((time.perf_counter() - start) * 1e3)
    return times


def _section(key: str, title: str, calls: dict[str, Callable[[], object]], quick: bool) -> Section:
    section = Section(key, title)
    times = _times(calls, 5 if quick else 15)
    own, other = times["cubecam"][1:], times["py360convert"][1:]
    ratio = statistics.median(a / b for a, b in zip(own, other, strict=True))
    section.rows = [
        Row("cubecam", statistics.median(own)),
        Row("py360convert", statistics.median(other), ratio, MARK),
    ]
    section.notes.append(
        "in the first call, before py360convert has cached its coordinates:"
        f" cubecam {times['cubecam'][0]:.1f} ms, py360convert {times['py360convert'][0]:.1f} ms"
    )
    return section


def _refused(section: Section, largest: float) -> Section:
    section.failed = True
    section.notes.append(
        f"the pictures differ by {largest:.3f}, more than {TOLERANCE}: no ratio for other work"
    )
    return section


def run(quick: bool) -> list[Section]:
    """Time both directions in turns, against py360convert and against cv2.remap with ready maps."""
    return [*_against_py360convert(quick), *remap.run(_picture(), FACE, quick)]


def _against_py360convert(quick: bool) -> list[Section]:
    """Compare the pictures, except near the faces' edges, then time both directions."""
    titles = {
        "e2c": "equirect 2048x1024 to cube 512, float32",
        "c2e": "cube 512 to equirect 2048x1024, float32",
    }
    try:
        import py360convert

        import cubecam as cc
    except ImportError as error:
        failed = getattr(error, "name", "") == "cubecam"
        return [Section(k, t, notes=[str(error)], failed=failed) for k, t in titles.items()]

    image = _picture()
    own = cc.CubeMap.from_equirect(image, size=FACE)
    natural = np.asarray(own.to_convention("inside"))
    theirs = py360convert.e2c(image, FACE, cube_format="list")
    inner = slice(MARGIN, -MARGIN)
    largest_e2c = max(
        float(np.abs(natural[face][inner, inner] - theirs[source][inner, inner]).max())
        for face, source in enumerate(PY360_ORDER)
    )
    panorama = np.asarray(own.to_equirect(width=WIDTH))
    faces = [np.ascontiguousarray(natural[PY360_ORDER.index(i)]) for i in range(6)]
    back = py360convert.c2e(faces, HEIGHT, WIDTH, cube_format="list")
    largest_c2e = float(np.abs(panorama - back)[inner, inner].max())

    def clear() -> None:
        for cached in (
            py360convert.utils.EquirecSampler.from_cubemap,
            py360convert.utils.CubeFaceSampler.from_equirec,
            py360convert.utils.xyzcube,
            py360convert.utils.equirect_uvgrid,
            py360convert.utils.equirect_facetype,
        ):
            getattr(cached, "cache_clear", lambda: None)()

    clear()
    sections = []
    if largest_e2c > TOLERANCE:
        sections.append(_refused(Section("e2c", titles["e2c"]), largest_e2c))
    else:
        calls = {
            "cubecam": lambda: cc.CubeMap.from_equirect(image, size=FACE),
            "py360convert": lambda: py360convert.e2c(image, FACE, cube_format="list"),
        }
        sections.append(_section("e2c", titles["e2c"], calls, quick))
        sections[-1].notes.append(f"pictures compared: largest difference {largest_e2c:.4f}")
    if largest_c2e > TOLERANCE:
        sections.append(_refused(Section("c2e", titles["c2e"]), largest_c2e))
    else:
        calls = {
            "cubecam": lambda: own.to_equirect(width=WIDTH),
            "py360convert": lambda: py360convert.c2e(faces, HEIGHT, WIDTH, cube_format="list"),
        }
        sections.append(_section("c2e", titles["c2e"], calls, quick))
        sections[-1].notes.append(f"pictures compared: largest difference {largest_c2e:.4f}")
    return sections
