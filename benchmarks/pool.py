"""The workers of a `cc.Pool` beside one process, beside two that know nothing of each other, and killed at random.

    python -m benchmarks.pool               a table of marks, in two minutes
    python -m benchmarks.pool --json out/pool.json

**Speed:** 600 cubemaps of 64 x 64 pixels with colour and distance, above a ground with 20 teapots. The bytes must be
those of one renderer before a time is taken. Processes take turns, and the figure is the median of the rounds' ratios:
of CPU time, of all threads and processes; by the clock over two processes that each draw half with a renderer of their
own, with the same number of threads.

**Start:** the CPU time of whole programs, from their start to their end.

**Scenes:** the memory of all processes while 10,000 small scenes are captured, and what is left.

**Killed:** a worker is killed at a random time of each of 30 calls; the bytes must be the same.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from typing import Any

from .command import command, measured
from .processes import ROOT, CpuWorker
from .results import Mark, Section

CAPTURES = 600
ONE, TWO, SCENES = (
    "peers.pool_cubecam:One",
    "peers.pool_cubecam:Workers",
    "peers.pool_cubecam:Scenes",
)
#: What workers of a pool on as many cores have.
NO_THREADS = {"LP_NUM_THREADS": "0"}

PROGRAM = """
import sys
from benchmarks.peers.pool_cubecam import One, Workers
if __name__ == "__main__":
    made = Workers(workers=2, captures={captures}) if {pool} else One(captures={captures})
    print(made.digest())
    made.draws.close()
"""


def _started(
    stack: ExitStack, name: str, env: dict[str, str] | None = None, **options: Any
) -> CpuWorker:
    kept = {key: os.environ.get(key) for key in env or {}}
    os.environ.update(env or {})
    try:
        program = CpuWorker(name, **options)
    finally:
        for key, value in kept.items():
            if value is None:
                del os.environ[key]
            else:
                os.environ[key] = value
    stack.callback(program.close)
    return program


def _call(program: CpuWorker, method: str, **options: Any) -> Any:
    return program.ask(do="call", name=method, options=options)["result"]


def speed_marks(rounds: int, captures: int) -> Section:
    """Two workers over one process, and over two that draw half each."""
    section = Section("speed", f"{captures} cubemaps of the field, seconds")
    with ExitStack() as stack:
        one = _started(stack, ONE, captures=captures)
        plain = _started(stack, ONE, NO_THREADS, captures=captures)
        two = _started(stack, TWO, workers=2, captures=captures)
        half = captures // 2
        halves = [
            _started(stack, ONE, NO_THREADS, captures=captures, first=first, count=half)
            for first in (0, half)
        ]
        digests = {_call(program, "digest") for program in (one, plain, two)}
        for program in halves:
            _call(program, "run")
        if len(digests) != 1:
            section.failed = True
            section.notes.append("two workers do not give the bytes of one renderer")
            return section
        found: dict[str, list[float]] = {"cpu": [], "cpu of one thread": [], "wall": []}
        seconds: dict[str, list[float]] = {"one": [], "two": [], "two alone": []}
        with ThreadPoolExecutor(2) as threads:
            for _ in range(rounds):
                first, thread = _call(one, "run"), _call(plain, "run")
                # What else the machine does changes within a second: each is beside the other one twice.
                pairs = [_both(threads, halves), _call(two, "run"), _both(threads, halves)]
                alone, pool = min(pairs[0], pairs[2]), pairs[1]
                found["cpu"].append(pool["cpu"] / first["cpu"])
                found["cpu of one thread"].append(pool["cpu"] / thread["cpu"])
                found["wall"].append(pool["wall"] / ((pairs[0] + pairs[2]) / 2))
                seconds["one"].append(first["wall"])
                seconds["two"].append(pool["wall"])
                seconds["two alone"].append(alone)
    middle = {name: statistics.median(values) for name, values in found.items()}
    section.marks = [
        Mark("CPU time of two workers over one process", middle["cpu"], 1.15),
        Mark("the same over one process with one thread", middle["cpu of one thread"], 1.15),
        Mark("the clock of two workers over two independent processes", middle["wall"], 1.1),
    ]
    section.notes.append(
        "the best rounds by the clock, s: "
        + ", ".join(f"{name} {min(values):.2f}" for name, values in seconds.items())
    )
    section.notes.append(
        "ratios by the clock: " + ", ".join(f"{value:.2f}" for value in found["wall"])
    )
    return section


def _both(threads: ThreadPoolExecutor, programs: list[CpuWorker]) -> float:
    """Seconds until two programs that begin at once have drawn their halves."""
    found = threads.map(lambda each: _call(each, "run"), programs)
    return max(float(each["wall"]) for each in found)


def start_marks(captures: int) -> Section:
    """Whole programs."""
    section = Section(
        "start", f"programs that draw {captures} cubemaps, with their starts and ends"
    )
    ratios = []
    for _ in range(3):
        times = []
        for pool in (False, True):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(
                [sys.executable, "-c", PROGRAM.format(captures=captures, pool=pool)],
                cwd=ROOT,
                check=True,
                stdout=subprocess.DEVNULL,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        ratios.append(times[1] / times[0])
    work = "CPU time of a program with two workers over one without"
    section.marks = [Mark(work, statistics.median(ratios), None)]
    return section


def memory_marks(count: int) -> Section:
    """How much the memory of each process grows, and what is left."""
    section = Section("scenes", "memory of capture_scenes by two workers")
    with ExitStack() as stack:
        program = _started(stack, SCENES)
        found = _call(program, "memory", count=count)
    memory = found["memory"]
    grown = [memory[-1][at] - memory[1][at] for at in range(len(memory[0]))]
    what = f"{count:,} scenes, the last fifth over the second: "
    section.marks = [
        Mark(what + "the caller", grown[0], 1.0, unit="MiB more"),
        Mark(what + "the workers", max(grown[1:]), 1.0, unit="MiB more"),
        Mark("mappings of shared memory that a closed pool leaves", found["mappings"], 0, unit=""),
        Mark("new files in /dev/shm", len(found["files"]), None, unit="", note="of any program"),
    ]
    section.notes.append(
        "MiB of caller and workers, at most, in each fifth: "
        + "; ".join(" ".join(f"{size:.1f}" for size in fifth) for fifth in memory)
    )
    return section


def killed_marks(tries: int, captures: int) -> Section:
    """Workers that are killed."""
    section = Section("killed", f"a worker is killed in each of {tries} calls")
    with ExitStack() as stack:
        program = _started(stack, TWO, workers=2, captures=captures)
        found = _call(program, "killed", tries=tries, seed=20)
    section.marks = [Mark("calls that raised or had other bytes", found["wrong"], 0, unit="")]
    section.notes.append(f"{found['while drawing']} of the {tries} kills met a worker that drew")
    return section


def run(quick: bool) -> list[Section]:
    """All marks of pools."""
    captures = 100 if quick else CAPTURES
    measures = [
        partial(speed_marks, 2 if quick else 9, captures),
        partial(start_marks, captures),
        partial(memory_marks, 1000 if quick else 10_000),
        partial(killed_marks, 5 if quick else 30, 100),
    ]
    return measured("pool", measures)


if __name__ == "__main__":
    sys.exit(command("pool", run, sys.argv[1:]))
