"""P14, dynamic reflection: time for a frame in cubecam, moderngl and ZenGL."""

from __future__ import annotations

import statistics
import tempfile
from contextlib import ExitStack
from itertools import chain
from pathlib import Path

import numpy as np

from . import pictures, scene
from .processes import Worker, WorkerError
from .results import Row, Section

SIZES = {"teapot": "P14, actors of 992 triangles", "knot": "P14, actors of 18,000 triangles"}
DEFAULT = (
    "cubecam",
    "cubecam, all faces anew",
    "moderngl",
    "moderngl, layered",
    "ZenGL",
)
VARIANTS = ("moderngl, culled by hand", "ZenGL, culled by hand")
MARKS = {"moderngl": 1 / 2, "ZenGL": 2 / 3}
COMPARED_FRAMES = (0, 7, 23, 40)
BLOCK = 6  # frames in a row; the first is not timed, since caches hold another process's data


def _start(names: tuple[str, ...], mesh: Path, stack: ExitStack, section: Section) -> list[Worker]:
    workers = []
    for name in names:
        try:
            worker = Worker(name, mesh)
        except WorkerError as error:
            section.notes.append(f"{name} is left out: {error}")
            section.failed |= name == "cubecam"
            continue
        stack.callback(worker.close)
        workers.append(worker)
    return workers


def _compare(workers: list[Worker], folder: Path, section: Section) -> bool:
    """Whether all workers draw the same pictures; the section's notes say how much they differ."""
    shots: dict[str, list[np.ndarray]] = {}
    for worker in workers:
        for frame in COMPARED_FRAMES:
            path = folder / f"{len(shots)}-{frame}.npy"
            worker.ask(do="picture", frame=frame, path=str(path))
            shots.setdefault(worker.name, []).append(np.load(path))
    reference = next((n for n in shots if n.startswith("moderngl")), workers[0].name)
    worst: dict[str, pictures.Difference] = {}
    for name, found in shots.items():
        differences = [
            pictures.difference(a, b) for a, b in zip(found, shots[reference], strict=True)
        ]
        worst[name] = max(differences, key=lambda d: (not d.same, d.largest, d.mean))
    bad = {name: found for name, found in worst.items() if not found.same}
    if bad:
        section.failed = True
        section.notes += [f"the pictures of {n} are not {reference}'s: {d}" for n, d in bad.items()]
        section.notes.append("no ratios: what differs is not the same work")
        return False
    largest = max(worst.values(), key=lambda d: (d.largest, d.mean))
    section.notes.append(f"pictures compared in {len(COMPARED_FRAMES)} frames: {largest}")
    return True


def run(size: str, teapot: Path, *, quick: bool, variants: bool) -> list[Section]:
    """Compare the pictures, then time frames in turns."""
    section = Section(f"p14-{size}", SIZES[size])
    mesh = scene.actor_mesh(size, teapot)
    rounds = 12 if quick else 40
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        arrays = folder / "mesh.npz"
        np.savez(arrays, positions=mesh.positions, normals=mesh.normals, indices=mesh.indices)
        names = DEFAULT + (VARIANTS if variants else ())
        workers = _start(names, arrays, stack, section)
        if not workers or not _compare(workers, folder, section):
            return [section]
        # One list for each round: the machine's speed may drift, so ratios are taken round by round.
        times: dict[str, list[list[float]]] = {worker.name: [] for worker in workers}
        views: list[int] = []
        for index in range(rounds + 1):
            for worker in workers:
                answer = worker.ask(do="frames", first=100 + index * BLOCK, count=BLOCK)
                if index == 0:
                    continue
                times[worker.name].append(answer["ms"][1:])
                if worker.name == "cubecam":
                    views += answer["views"]
    own = times.get("cubecam")
    for worker in workers:
        found = times[worker.name]
        row = Row(worker.name, statistics.median(chain.from_iterable(found)))
        if own is not None and worker.name != "cubecam":
            row.ratio = statistics.median(
                statistics.median(a) / statistics.median(b) for a, b in zip(own, found, strict=True)
            )
        section.rows.append(row)
    _mark(section)
    if views:
        section.notes.append(f"cubecam drew {statistics.mean(views):.2f} of 7 views a frame")
    return [section]


def _mark(section: Section) -> None:
    """Give each peer's mark to the row of its fastest way to draw every face."""
    for peer, mark in MARKS.items():
        rows = [r for r in section.rows if r.name.startswith(peer) and r.name not in VARIANTS]
        if rows:
            min(rows, key=lambda row: row.ms).mark = mark
