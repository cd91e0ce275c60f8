"""The marks of speed: the CPU time of each work in all threads, or its ratio to a peer's time, next to its limit.

The two sides of a ratio run in two processes that take turns, a block of frames each, and the ratio is the median
over the rounds. Where both draw the same, their pictures are compared first.
"""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from . import before, scene
from .processes import ROOT, CpuWorker, WorkerError
from .results import Mark, Section

COUNT = 10_000
SMALL = (64, 64)
BLOCK = 4  # frames in a row; the first is not timed, since caches hold another process's data
COMPARED_FRAMES = (1, 6)
# Rasterisers round a vertex to 1/256 of a pixel, so that another order of the same sums can move a
# silhouette by a pixel.
STEPS, OUTLIERS = 1, 0.0005

Times = dict[str, list[list[float]]]  # for each step a list of rounds, each a list of times


class _Pair:
    """Programs that take turns."""

    def __init__(self, stack: ExitStack, *programs: CpuWorker) -> None:
        self.programs = programs
        for program in programs:
            stack.callback(program.close)

    def difference(self, limit: float = OUTLIERS, steps: int = STEPS) -> str | None:
        """None if the pictures of the first two programs are the same, else a text that says how much they differ."""
        with tempfile.TemporaryDirectory() as folder:
            for frame in COMPARED_FRAMES:
                shots = []
                for index, program in enumerate(self.programs[:2]):
                    path = Path(folder) / f"{index}.npy"
                    program.ask(do="picture", frame=frame, path=str(path))
                    shots.append(np.load(path).astype(np.int16))
                if np.ptp(shots[1]) == 0:
                    return f"{self.programs[1].name} draws one colour"
                off = np.abs(shots[0] - shots[1]).max(axis=-1) > steps
                if off.mean() > limit:
                    return f"{off.mean():.2%} of the pixels differ by more than {steps} of 255"
        return None

    def times(self, rounds: int, block: int = BLOCK) -> list[Times]:
        """CPU milliseconds of every program: {"move": [...], "draw": [...]}, with one list for each round."""
        found: list[Times] = [{"move": [], "draw": []} for _ in self.programs]
        for index in range(rounds + 1):
            for program, times in zip(self.programs, found, strict=True):
                answer = program.ask(do="frames", first=100 + index * block, count=block)
                if index:  # the first round compiles shaders and fills caches
                    for step in times:
                        times[step].append(answer[step][1:])
        return found


def _whole(times: Times) -> list[float]:
    """The median time of moving and drawing together, for each round."""
    return [
        statistics.median(np.add(move, draw).tolist())
        for move, draw in zip(times["move"], times["draw"], strict=True)
    ]


def _drawn(times: Times) -> list[float]:
    return [statistics.median(draw) for draw in times["draw"]]


def _ratio(own: list[float], other: list[float]) -> float:
    return statistics.median(a / b for a, b in zip(own, other, strict=True))


def _rounds(quick: bool, many: int = 11) -> int:
    return max(3, many // 3) if quick else many


def _has_bulk() -> bool:
    import cubecam as cc

    return hasattr(cc.Scene, "set_positions")


def _boxes(section: Section, stack: ExitStack, quick: bool) -> None:
    bulk = _has_bulk()
    works = [
        ("5 Phong materials over one instanced draw", "Instanced", 5, True, 1.5),
        ("5 unlit materials over one instanced draw", "Instanced", 5, False, 1.5),
        ("10,000 Phong materials over a loop of draws", "Loop", COUNT, True, 1.0),
    ]
    for work, peer, colors, lit, limit in works:
        with ExitStack() as inner:
            options: dict[str, Any] = {"count": COUNT, "colors": colors, "lit": lit}
            pair = _Pair(
                inner,
                CpuWorker("peers.boxes_cubecam:Boxes", bulk=bulk, **options),
                CpuWorker(f"peers.boxes_moderngl:{peer}", **options),
            )
            name = f"10,000 boxes moved, {work}"
            if difference := pair.difference():
                section.marks.append(Mark(name, None, limit, note=difference))
                section.failed = True
                continue
            own, other = pair.times(_rounds(quick, 7))
            how = "moved by one call" if bulk else "moved in a Python loop"
            section.marks.append(_compared(name, _whole(own), _whole(other), limit, how))
            section.marks.append(
                _compared("  the frame alone, nodes moved before", _drawn(own), _whole(other), None)
            )


def _compared(
    work: str, own: list[float], other: list[float], limit: float | None, note: str = ""
) -> Mark:
    return Mark(
        work,
        _ratio(own, other),
        limit,
        note=note,
        own_ms=statistics.median(own),
        other_ms=statistics.median(other),
    )


def _still(section: Section, stack: ExitStack, quick: bool) -> None:
    options: dict[str, Any] = {"colors": 5, "size": SMALL}
    programs: list[tuple[str, dict[str, Any], float]] = [
        ("nothing changed", {"count": COUNT, "moved": 0}, 0.15),
        ("one moved", {"count": COUNT, "moved": 1}, 4.0),
    ]
    for work, more, limit in programs:
        with ExitStack() as inner:
            pair = _Pair(inner, CpuWorker("peers.boxes_cubecam:Boxes", **options, **more))
            (times,) = pair.times(_rounds(quick, 15), block=12)
            ms = statistics.median(_whole(times))
            name = f"10,000 nodes, {work}, 64 x 64 frame"
            section.marks.append(Mark(name, ms, limit, unit="ms"))
    few: dict[str, Any] = {"count": 100, "moved": 1, **options}
    pair = _Pair(
        stack,
        CpuWorker("peers.boxes_cubecam:Boxes", beside=COUNT, **few),
        CpuWorker("peers.boxes_cubecam:Boxes", **few),
    )
    own, other = (_whole(times) for times in pair.times(_rounds(quick, 15), block=12))
    section.marks.append(
        Mark(
            "10,000 more nodes off-screen, one of 100 moving",
            statistics.median(np.subtract(own, other).tolist()),
            0.5,
            unit="ms more",
            own_ms=statistics.median(own),
            other_ms=statistics.median(other),
        )
    )


def _p14(section: Section, stack: ExitStack, quick: bool, old: Path | None) -> None:
    teapot = ROOT / "python" / "cubecam" / "data" / "teapot.obj"
    try:
        tree = before.tree(old)
    except before.BeforeError as error:
        section.notes.append(f"P14 is left out: the version before: {error}")
        section.failed = True
        return
    folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
    for size, actor in (("small", "teapot"), ("large", "knot")):
        mesh = scene.actor_mesh(actor, teapot)
        path = folder / f"{actor}.npz"
        np.savez(path, positions=mesh.positions, normals=mesh.normals, indices=mesh.indices)
        with ExitStack() as inner:
            pair = _Pair(
                inner,
                CpuWorker("peers.p14_cubecam:Program", mesh=str(path)),
                CpuWorker("peers.p14_cubecam:Program", tree, mesh=str(path)),
            )
            name = f"P14, {size} actors, over the version before"
            if difference := pair.difference(limit=0.0, steps=0):
                section.marks.append(Mark(name, None, 1.05, note=difference))
                section.failed = True
                continue
            own, other = pair.times(_rounds(quick, 40), block=8)
            section.marks.append(_compared(name, _whole(own), _whole(other), 1.05))


def _lights(section: Section, stack: ExitStack, quick: bool) -> None:
    counts = (4, 5, 8)
    pair = _Pair(stack, *(CpuWorker("peers.captures_cubecam:Lit", lights=n) for n in counts))
    four, five, eight = (_whole(times) for times in pair.times(_rounds(quick, 15), block=6))
    work = "Phong capture of 6 x 256 x 256, {} point lights over 4"
    section.marks.append(_compared(work.format(5), five, four, 1.3))
    section.marks.append(_compared(work.format(8), eight, four, 2.2))


def _unchanged(section: Section, stack: ExitStack, quick: bool) -> None:
    for size in (256, 512, 1024, 2048):
        with ExitStack() as inner:
            pair = _Pair(
                inner,
                CpuWorker("peers.captures_cubecam:Unchanged", size=size),
                CpuWorker("peers.captures_cubecam:Copied", size=size),
            )
            rounds, block = (_rounds(quick, 9), 12) if size < 1024 else (_rounds(quick, 5), 4)
            own, other = (_whole(times) for times in pair.times(rounds, block))
            work = f"unchanged capture of {size} x {size} faces, over np.copyto"
            if size >= 1024:
                section.marks.append(_compared(work, own, other, 1.2))
                continue
            more = statistics.median(np.subtract(own, other).tolist())
            mark = Mark(work, more, 0.1, unit="ms more")
            mark.own_ms, mark.other_ms = statistics.median(own), statistics.median(other)
            section.marks.append(mark)


def _mesh(section: Section, stack: ExitStack, quick: bool) -> None:
    pair = _Pair(stack, CpuWorker("peers.wave_cubecam:Wave"), CpuWorker("peers.wave_moderngl:Wave"))
    name = "100,000 positions and normals anew, over buffer.write and draw"
    if difference := pair.difference():
        section.marks.append(Mark(name, None, 1.3, note=difference))
        section.failed = True
        return
    own, other = pair.times(_rounds(quick, 15), block=6)
    section.marks.append(_compared(name, _whole(own), _whole(other), 1.3))
    moves = [[statistics.median(move) for move in times["move"]] for times in (own, other)]
    section.marks.append(_compared("  setting them alone", moves[0], moves[1], None))


def _skin(section: Section, stack: ExitStack, quick: bool) -> None:
    from . import skinning  # this process draws

    for work, smooth, limit in (
        ("100 joints, 50,000 vertices, over the mesh moved rigidly", False, 2.0),
        ("  the same with computed normals", True, None),
    ):
        own, other, share = skinning.ratio(smooth, rounds=_rounds(quick, 45))
        section.marks.append(Mark(work, share, limit, own_ms=own, other_ms=other))


def _static(section: Section, stack: ExitStack, quick: bool) -> None:
    from . import static  # this process draws

    work = "a small ball moves before 1,002,528 triangles, over all drawn anew"
    try:
        found = static.measure(static.terrain(), static.frame_of(), _rounds(quick, static.ROUNDS))
    except AssertionError as error:
        section.marks.append(Mark(work, None, 0.02, note=str(error)))
        section.failed = True
        return
    mark = Mark(work, found.ratio, 0.02, own_ms=found.moved, other_ms=found.whole)
    section.marks.append(mark)


_PARTS: dict[str, Callable[..., None]] = {
    "marks-boxes": _boxes,
    "marks-still": _still,
    "marks-p14": _p14,
    "marks-lights": _lights,
    "marks-unchanged": _unchanged,
    "marks-mesh": _mesh,
    "marks-skin": _skin,
    "marks-static": _static,
}
PARTS = tuple(_PARTS)


def run(part: str, *, quick: bool, old: Path | None = None) -> list[Section]:
    """The marks of one part; `old` is a built tree of the previous version."""
    section = Section(part, part)
    measure = partial(_p14, old=old) if part == "marks-p14" else _PARTS[part]
    with ExitStack() as stack:
        try:
            measure(section, stack, quick)
        except WorkerError as error:
            section.notes.append(f"left out: {error}")
            section.failed = True
    return [section]
