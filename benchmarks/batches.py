"""Batches of cubemaps: one `capture_many` beside single captures, and beside a program that culls by hand.

    python -m benchmarks.batches            a table of marks, in a minute
    python -m benchmarks.batches --json out/batches.json

**Field:** 400 cubemaps of 64 x 64 pixels with colour and distance, above a ground with 20 teapots. The batch's bytes
must be those of single captures, and its pictures those of the program in moderngl but for rounding, before a time is
taken. Groups of 32 cubemaps take turns, and the figure is the median of the groups' ratios of CPU time of all threads.

**Levels:** the same field of teapots, or of knots of 60,000 triangles together, with levels of detail within half a
pixel or four of the exact pictures, over a batch without.

**Empty:** a scene with a background alone, captured from places that change: what a cubemap costs besides drawing. The
results' memory is new for each frame, or that of the frame before.

**Scenes:** the memory of a process in which `capture_scenes` draws 10,000 small scenes, without the results' own bytes.
"""

from __future__ import annotations

import statistics
import sys
import tempfile
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .command import command, measured
from .processes import CpuWorker
from .results import Mark, Section

PROBES, GROUP = 400, 32
BATCH, SINGLE, MODERNGL = (
    "peers.batches_cubecam:Batch",
    "peers.batches_cubecam:Single",
    "peers.batches_moderngl:Culled",
)
# Rasterisers round a vertex to 1/256 of a pixel, so that another order of the same sums can move a silhouette by a
# pixel; there are many silhouettes in 64 x 64 pixels.
STEPS, FAR_OFF, OUTLIERS = 2, 1e-3, 0.002

Arrays = dict[str, np.ndarray]
Times = dict[
    str, list[float]
]  # CPU ("cpu") and clock ("wall") milliseconds of a frame, a median for each round


def arrays_of(program: CpuWorker, frame: int) -> Arrays:
    """All arrays that a program draws for a frame."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "arrays.npz"
        program.ask(do="arrays", frame=frame, path=str(path))
        with np.load(path) as found:
            return {name: found[name] for name in found}


def difference(own: Arrays, other: Arrays) -> str | None:
    """None if two programs drew the same but for rounding, else how much they differ.

    Colours may differ by STEPS of 255, other numbers by FAR_OFF of a unit, and more in a share OUTLIERS of the texels.
    """
    if own.keys() != other.keys():
        return f"expected the arrays {sorted(own)}, got {sorted(other)}"
    for name, array in own.items():
        against = other[name]
        if array.shape != against.shape or array.dtype != against.dtype:
            return f"{name}: {array.dtype} {array.shape} against {against.dtype} {against.shape}"
        if array.dtype == np.uint8:
            off = np.abs(array.astype(np.int16) - against.astype(np.int16)) > STEPS
        else:
            limit = STEPS / 255 if name == "faces" else FAR_OFF
            off = ~np.isclose(array, against, rtol=limit, atol=limit, equal_nan=True)
        if off.mean() > OUTLIERS:
            return f"{name}: {off.mean():.2%} of the numbers differ"
    return None


def same_bytes(own: Arrays, other: Arrays) -> str | None:
    """None if two programs drew the same bytes, else the name of an array that differs."""
    for name in own.keys() | other.keys():
        if name not in own or name not in other or own[name].tobytes() != other[name].tobytes():
            return f"{name}: other bytes"
    return None


def turns(programs: list[CpuWorker], rounds: int, frames: int = 3) -> list[Times]:
    """The times of programs that take turns; the first frame of a turn is not counted, since caches hold other data."""
    found: list[Times] = [{"cpu": [], "wall": []} for _ in programs]
    for index in range(rounds + 1):
        for program, times in zip(programs, found, strict=True):
            answer = program.ask(do="frames", first=100 + index * frames, count=frames)
            if index:  # the first round compiles shaders and fills caches
                cpu = np.add(answer["move"], answer["draw"])[1:]
                times["cpu"].append(statistics.median(cpu.tolist()))
                times["wall"].append(statistics.median(answer["wall"][1:]))
    return found


def ratio(own: list[float], other: list[float]) -> float:
    """The median of the rounds' ratios."""
    return statistics.median(a / b for a, b in zip(own, other, strict=True))


def _mark(work: str, own: Times, other: Times, limit: float | None, probes: int) -> Mark:
    wall = ratio(own["wall"], other["wall"])
    mark = Mark(work, ratio(own["cpu"], other["cpu"]), limit, note=f"by the clock {wall:.2f}")
    mark.own_ms = statistics.median(own["cpu"]) / probes
    mark.other_ms = statistics.median(other["cpu"]) / probes
    return mark


def field_marks(rounds: int, **options: Any) -> Section:
    """A batch over single captures, and over moderngl; `options` are those of `field.Field`."""
    section = Section("field", "a cubemap of the field, ms of CPU time")
    options = {"probes": GROUP, **options}
    with ExitStack() as stack:
        programs = [_started(stack, name, options) for name in (BATCH, SINGLE, MODERNGL)]
        batch, single, culled = (arrays_of(program, 1) for program in programs)
        for name, wrong in (
            ("single captures", same_bytes(batch, single)),
            ("moderngl", difference(batch, culled)),
        ):
            if wrong:
                section.failed = True
                section.notes.append(f"a batch does not draw what {name} draw: {wrong}")
        if section.failed:
            return section
        own, one, other = turns(programs, rounds)
    count = options["probes"]
    section.marks = [
        _mark("a batch over single captures, equal bytes", own, one, 0.9, count),
        _mark("a batch over moderngl, culled by hand", own, other, 0.9, count),
        _mark("single captures over moderngl", one, other, None, count),
    ]
    return section


LOD_ERRORS = (0.5, 4.0)  # pixels


def level_marks(rounds: int, **options: Any) -> Section:
    """Batches with levels of detail over one of exact meshes."""
    section = Section("levels", "a cubemap of the field with levels of detail, ms of CPU time")
    for triangles in (0, 60_000):
        given = {"probes": GROUP, "triangles": triangles, **options}
        with ExitStack() as stack:
            exact = _started(stack, BATCH, given)
            others = [_started(stack, BATCH, {**given, "max_lod_error": e}) for e in LOD_ERRORS]
            want = arrays_of(exact, 1)
            found = [arrays_of(program, 1) for program in others]
            own, *times = turns([exact, *others], rounds)
        name = f"knots of {triangles:,} triangles" if triangles else "teapots"
        for error, arrays, time in zip(LOD_ERRORS, found, times, strict=True):
            work = f"{name}, within {error:g} pixels, over exact meshes"
            section.marks.append(_mark(work, time, own, None, GROUP))
            off = (arrays["distance"] != want["distance"]).mean()
            section.notes.append(f"{name}, {error:g} pixels: {off:.1%} of the distances differ")
    return section


def empty_marks(rounds: int) -> Section:
    """A cubemap of a batch over a single capture, where nothing is drawn."""
    section = Section("empty", "a cubemap of an empty scene, ms of CPU time")
    for pixels in ("rgba8", "rgba32f"):
        for memory in ("fresh", "recycled"):
            options: dict[str, Any] = {
                "nodes": 0,
                "format": pixels,
                "outputs": [],
                "memory": memory,
            }
            options["probes"] = GROUP
            with ExitStack() as stack:
                programs = [_started(stack, name, options) for name in (BATCH, SINGLE)]
                wrong = same_bytes(*(arrays_of(program, 1) for program in programs))
                if wrong:
                    section.failed = True
                    section.notes.append(f"{pixels}: {wrong}")
                    continue
                own, one = turns(programs, rounds)
            work = f"{pixels}, {memory} memory: a batch over single captures"
            section.marks.append(_mark(work, own, one, 0.4, GROUP))
    return section


def memory_marks(count: int) -> Section:
    """How much the memory grows between the first 100 scenes and the last."""
    section = Section("scenes", "memory of capture_scenes")
    at = [number for number in (100, 1000, 2000, 5000) if number < count - 1] + [count - 1]
    with ExitStack() as stack:
        program = _started(stack, "peers.batches_cubecam:Scenes", {})
        options = {"count": count, "at": at}
        found = program.ask(do="call", name="memory", options=options)["result"]
    more = found[-1] - found[0]
    work = f"{count:,} scenes, after the first {at[0]}"
    section.marks.append(Mark(work, more, 1.0, unit="MiB more"))
    section.notes.append(
        "MiB after " + ", ".join(f"{n}: {size:.1f}" for n, size in zip(at, found, strict=True))
    )
    return section


def _started(stack: ExitStack, name: str, options: dict[str, Any]) -> CpuWorker:
    program = CpuWorker(name, **options)
    stack.callback(program.close)
    return program


def run(quick: bool) -> list[Section]:
    """All marks of batches."""
    rounds = 3 if quick else -(-PROBES // (2 * GROUP)) + 4
    measures = [
        partial(field_marks, rounds),
        partial(level_marks, rounds),
        partial(empty_marks, rounds),
        partial(memory_marks, 1000 if quick else 10_000),
    ]
    return measured("batches", measures)


if __name__ == "__main__":
    sys.exit(command("batches", run, sys.argv[1:]))
