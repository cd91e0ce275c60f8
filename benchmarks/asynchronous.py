"""What asynchronous calls save: work of numpy while pictures are drawn, and on a GPU drawing while pixels travel.

    python -m benchmarks.asynchronous                      a table, in a minute
    python -m benchmarks.asynchronous --device gpu --json out/asynchronous.json

**Overlap:** each step captures a scene of moving knots and does work of numpy on the cubemap of the step before, so
long that both take the same time. One program waits for each capture, the other has one under way while numpy works.
Their cubemaps are compared first; then rounds of both take turns, and the figures are medians of the rounds' ratios, of
wall time and of CPU time of all threads. With a driver that draws on the CPU the gain is what drawing and numpy leave
idle; with one core it is none.

**Overhead:** a picture of few pixels, called now and called later, and the time until the later call returns.

**Stream:** captures whose six faces change, one after the other: waited for, and with four under way. Where there is a
CUDA driver, the same bytes are copied from the GPU into pinned memory, which is what no reading can beat.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import statistics
import sys
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import scene

UNDER_WAY = 4


class Moving:
    """Knots that move at each step, so that each capture draws all faces."""

    def __init__(self, triangles: tuple[int, int]) -> None:
        import cubecam as cc

        arrays = scene.knot_mesh(1.0, *triangles)
        mesh = cc.Mesh(arrays.positions, arrays.indices, normals=arrays.normals)
        self.scene = cc.Scene(background=(0.1, 0.2, 0.3))
        self.scene.add(cc.PointLight(position=(1, 2, 1)))
        material = cc.PhongMaterial(color=(0.4, 1.0, 0.4))
        self.nodes = [self.scene.add(mesh, material) for _ in range(4)]

    def step(self, number: int) -> None:
        for at, node in enumerate(self.nodes):
            angle = 0.05 * number + at * np.pi / 2
            place = (3 * np.cos(angle), np.sin(3 * angle), 3 * np.sin(angle))
            node.position = tuple(float(x) for x in place)


def times(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds of a work: of the clock, and of all threads."""
    wall, cpu = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - wall, time.process_time() - cpu


def overlap(device: str, quick: bool) -> dict[str, Any]:
    """A capture and as much work of numpy in each step: waited for, and overlapped."""
    import cubecam as cc

    steps, rounds = (4, 3) if quick else (12, 9)
    size = 64 if quick else 256
    moving = Moving((200, 16))
    with cc.Renderer(device=device) as renderer:

        def draw(number: int) -> cc.CubeMap:
            moving.step(number)
            return renderer.capture(moving.scene, size=size)

        for number in range(3):
            draw(number)
        drawing = statistics.median(times(lambda n=n: draw(n))[0] for n in range(9))  # type: ignore[misc]
        values = np.random.default_rng(1).random(1 << 14)
        one = min(times(lambda: np.sort(values))[0] for _ in range(20))
        count = max(1, round(drawing / one))

        def numpy_work(cube: cc.CubeMap) -> float:
            for _ in range(count):
                np.sort(values)
            return float(cube.faces[0, 0, 0, 0])

        def waiting() -> list[npt.NDArray[Any]]:
            faces = []
            for number in range(steps):
                cube = draw(number)
                numpy_work(cube)
                faces.append(cube.faces)
            return faces

        def overlapped() -> list[npt.NDArray[Any]]:
            faces = []
            coming = None
            for number in range(steps + 1):
                following = None
                if number < steps:
                    moving.step(number)
                    following = renderer.capture_async(moving.scene, size=size)
                if coming is not None:
                    cube = coming.result()
                    # The next one is being drawn meanwhile.
                    numpy_work(cube)
                    faces.append(cube.faces)
                coming = following
            return faces

        for a, b in zip(waiting(), overlapped(), strict=True):
            if a.tobytes() != b.tobytes():
                raise AssertionError("expected equal cubemaps of both programs")
        pairs = [(times(waiting), times(overlapped)) for _ in range(rounds)]
    return {
        "size": size,
        "drawing_ms": 1000 * drawing,
        "numpy_ms": 1000 * one * count,
        "waiting_ms": 1000 * statistics.median(a[0] for a, _ in pairs) / steps,
        "overlapped_ms": 1000 * statistics.median(b[0] for _, b in pairs) / steps,
        "wall_ratio": statistics.median(b[0] / a[0] for a, b in pairs),
        "cpu_ratio": statistics.median(b[1] / a[1] for a, b in pairs),
    }


def overhead(device: str, quick: bool) -> dict[str, Any]:
    """A capture of 6 x 8 x 8 texels, of a box that moves."""
    import cubecam as cc

    steps, rounds = (20, 3) if quick else (100, 15)
    world = cc.Scene()
    box = world.add(cc.Mesh.box(1), cc.BasicMaterial(), position=(0, 0, -3))
    with cc.Renderer(device=device) as renderer:

        def move(number: int) -> None:
            box.position = (0.01 * number, 0, -3)

        def now() -> None:
            for number in range(steps):
                move(number)
                renderer.capture(world, size=8)

        def later() -> None:
            for number in range(steps):
                move(number)
                renderer.capture_async(world, size=8).result()

        def together() -> None:
            futures = []
            for number in range(steps):
                move(number)
                futures.append(renderer.capture_async(world, size=8))
            for future in futures:
                future.result()

        for work in (now, later, together):
            work()
        triples = [(times(now), times(later), times(together)) for _ in range(rounds)]
        calls = []
        for number in range(steps):
            move(number)
            begin = time.perf_counter()
            future = renderer.capture_async(world, size=8)
            calls.append(time.perf_counter() - begin)
            future.result()
    return {
        "now_us": 1e6 * statistics.median(t[0][0] for t in triples) / steps,
        "returns_after_us": 1e6 * statistics.median(calls),
        "later_cpu_ratio": statistics.median(t[1][1] / t[0][1] for t in triples),
        "later_wall_ratio": statistics.median(t[1][0] / t[0][0] for t in triples),
        "together_cpu_ratio": statistics.median(t[2][1] / t[0][1] for t in triples),
        "together_wall_ratio": statistics.median(t[2][0] / t[0][0] for t in triples),
    }


def stream(device: str, quick: bool) -> list[dict[str, Any]]:
    """Captures of a colour that changes: bytes a second, waited for and with four under way."""
    import cubecam as cc

    rows = []
    count, rounds = (8, 3) if quick else (16, 5)
    for size in (64, 256) if quick else (256, 1024):
        world = cc.Scene()
        world.add(cc.Mesh.box(1), cc.BasicMaterial(color=(0.9, 0.4, 0.1)), position=(0, 0, -3))
        with cc.Renderer(device=device) as renderer:

            def change(number: int, world: cc.Scene = world) -> cc.Scene:
                world.background = (0.1, 0.2, (number % 50) / 50)
                return world

            def waiting(size: int = size, renderer: cc.Renderer = renderer) -> None:
                for number in range(count):
                    renderer.capture(change(number), size=size)

            def under_way(size: int = size, renderer: cc.Renderer = renderer) -> None:
                futures: deque[Any] = deque()
                for number in range(count):
                    futures.append(renderer.capture_async(change(number), size=size))
                    if len(futures) > UNDER_WAY:
                        futures.popleft().result()
                while futures:
                    futures.popleft().result()

            waiting()
            under_way()
            pairs = [(times(waiting)[0], times(under_way)[0]) for _ in range(rounds)]
        held = 6 * size * size * 16
        row: dict[str, Any] = {
            "size": size,
            "bytes": held,
            "waiting_ms": 1000 * statistics.median(a for a, _ in pairs) / count,
            "under_way_ms": 1000 * statistics.median(b for _, b in pairs) / count,
            "ratio": statistics.median(b / a for a, b in pairs),
        }
        pinned = pinned_copy_ms(held)
        if isinstance(pinned, str):
            row["pinned_copy"] = pinned
        else:
            row |= {"pinned_copy_ms": pinned, "over_pinned_copy": row["under_way_ms"] / pinned}
        rows.append(row)
    return rows


def pinned_copy_ms(count: int) -> float | str:
    """Milliseconds in which CUDA copies bytes from the first GPU into pinned memory; a text where it cannot."""
    try:
        cuda = ctypes.CDLL("libcuda.so.1")
    except OSError:
        return "no CUDA driver"
    device, context = ctypes.c_int(), ctypes.c_void_p()
    on_gpu, pinned = ctypes.c_uint64(), ctypes.c_void_p()

    def check(status: int) -> None:
        if status != 0:
            raise OSError(f"CUDA error {status}")

    try:
        check(cuda.cuInit(0))
        check(cuda.cuDeviceGet(ctypes.byref(device), 0))
        check(cuda.cuDevicePrimaryCtxRetain(ctypes.byref(context), device))
        check(cuda.cuCtxSetCurrent(context))
        check(cuda.cuMemAlloc_v2(ctypes.byref(on_gpu), ctypes.c_size_t(count)))
        check(cuda.cuMemAllocHost_v2(ctypes.byref(pinned), ctypes.c_size_t(count)))

        def copy() -> None:
            check(cuda.cuMemcpyDtoH_v2(pinned, on_gpu, ctypes.c_size_t(count)))

        copy()
        taken = statistics.median(times(copy)[0] for _ in range(15))
        check(cuda.cuMemFreeHost(pinned))
        check(cuda.cuMemFree_v2(on_gpu))
        check(cuda.cuDevicePrimaryCtxRelease_v2(device))
    except OSError as error:
        return str(error)
    return 1000 * taken


def measured(device: str, quick: bool) -> dict[str, Any]:
    """Measure everything; the result goes into JSON."""
    return {
        "overlap": overlap(device, quick),
        "overhead": overhead(device, quick),
        "stream": stream(device, quick),
    }


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.asynchronous")
    parser.add_argument("--device", default="software", help="as of cc.Renderer; default: software")
    parser.add_argument("--quick", action="store_true", help="smaller and noisier")
    parser.add_argument("--json", type=Path, help="where the figures go, besides the table")
    options = parser.parse_args(arguments)
    found = measured(options.device, options.quick)
    for name, rows in found.items():
        for row in rows if isinstance(rows, list) else [rows]:
            print(f"{name:9}", end="")
            for key, value in row.items():
                print(
                    f"  {key} {value:.3g}" if isinstance(value, float) else f"  {key} {value}",
                    end="",
                )
            print()
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(found, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
