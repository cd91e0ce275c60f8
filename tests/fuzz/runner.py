"""Feed broken input to worker processes, and find what no input may do: crashes, hangs, memory, unclear exceptions.

A target makes cases (bytes) from numbers and tries them; the same number makes the same case. A worker process tries
the cases of a target in order and says what it does line by line, so that a case that ends the worker is known.
"""

from __future__ import annotations

import os
import resource
import select
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import cubecam as cc

#: Cases that once were a fault, in a folder for each target: they are tried first, and always.
CORPUS = Path(__file__).parent / "corpus"
LIMIT = 4 << 30  # bytes that a worker can have: a machine that swaps would hold up other work
START = 120.0  # seconds in which a worker imports the package and tries the sound cases


@dataclass(frozen=True)
class Target:
    """What is tried.

    `make` gives the case of a number. `attempt` tries a case in a folder of its own; an exception that escapes it is a
    fault. `sound` are cases that are no fault, and with which a worker begins: its memory is counted from there on.
    """

    name: str
    make: Callable[[int], bytes]
    attempt: Callable[[bytes, Path], None]
    sound: Callable[[], Iterable[bytes]] = tuple
    suffix: str = "txt"
    seconds: float = 5.0  # of CPU
    wall: float = 60.0  # seconds: a busy machine gives little CPU
    memory: int = 300 << 20  # bytes that a worker may need beyond what the sound cases needed


def faults_of(target: Target, case: bytes, folder: Path) -> list[str]:
    """Try a case in this process; return what was not as it should be, except for crashes."""
    found = []
    start = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for kind in (cc.ConventionWarning, cc.SceneWarning, cc.ClippingWarning):
                warnings.simplefilter("ignore", kind)
            target.attempt(case, folder)
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        found.append(f"{type(error).__name__}: {error} ({place.filename}:{place.lineno})")
    if time.process_time() - start > target.seconds:
        found.append(f"took {time.process_time() - start:.1f} s")
    return found


def kept(name: str) -> list[Path]:
    """The files of the corpus for a target, in order."""
    return sorted(path for path in (CORPUS / name).glob("*") if path.is_file())


def case_of(target: Target, number: int) -> bytes:
    """The case of a number; negative numbers are those of the corpus, -1 its first."""
    return kept(target.name)[-1 - number].read_bytes() if number < 0 else target.make(number)


def peak() -> int:
    """Return the most memory that this process has had, in bytes.

    getrusage would begin with the memory of the process that started this one.
    """
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.partition("VmHWM:")[2].split()[0]) * 1024


def work(target: Target, first: int, end: int) -> None:
    """Try cases in a worker process, which says what it does line by line."""
    resource.setrlimit(resource.RLIMIT_DATA, (LIMIT, LIMIT))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.chdir(folder)
        for case in target.sound():
            target.attempt(case, folder)
        calm = peak()
        for number in range(first, end):
            say("start", number)
            for fault in faults_of(target, case_of(target, number), folder):
                say("fault", number, " ".join(fault.split()))
            if peak() - calm > target.memory:
                say("fault", number, f"memory grew by {(peak() - calm) >> 20} MiB")
                return


#: The worker's lines go where nothing else writes: a case may print.
_LINES = os.dup(1)


def say(*words: object) -> None:
    """Write a line for the process that started this worker."""
    os.write(_LINES, (" ".join(str(word) for word in words) + "\n").encode(errors="replace"))


def run(
    target: Target,
    count: int,
    first: int,
    keep: Path,
    *,
    until: float = float("inf"),
    command: tuple[str, ...] = ("-m", "tests.fuzz", "--work"),
) -> tuple[list[str], int]:
    """Try `count` cases from number `first` on. Return the faults and the number of cases that were tried.

    A worker that ends early is followed by another one. Numbers below 0 are those of the corpus. Cases of faults are kept
    in the folder `keep`. No worker starts after `until` (time.monotonic).
    """
    begin, end, found = first, first + count, []
    while first < end and time.monotonic() < until:
        told, last = _one_worker(target, first, end, until, command)
        for number, text in told:
            found.append(f"{target.name} {number}: {text}")
            keep.mkdir(parents=True, exist_ok=True)
            case = case_of(target, number)
            (keep / f"{target.name}-{number}.{target.suffix}").write_bytes(case)
        if last < first:
            found += [] if told else [f"{target.name}: no case was tried"]
            break  # the sound cases are a fault, and every other worker would end there
        first = last + 1
    return found, first - begin


def _one_worker(
    target: Target, first: int, end: int, until: float, command: tuple[str, ...]
) -> tuple[list[tuple[int, str]], int]:
    """Let a worker try cases `first` to `end`; return its faults and the number of the last case that it tried."""
    arguments = [sys.executable, *command, target.name, str(first), str(end)]
    found: list[tuple[int, str]] = []
    number = first - 1
    with (
        tempfile.TemporaryDirectory() as cache,  # what is known about broken shaders is of no use to anyone
        tempfile.TemporaryFile() as errors,
        subprocess.Popen(
            arguments,
            stdout=subprocess.PIPE,
            stderr=errors,
            bufsize=0,
            env={**os.environ, "XDG_CACHE_HOME": cache},
        ) as worker,
    ):
        assert worker.stdout is not None
        while True:
            # Without a buffer (bufsize=0), select sees all that is left to read.
            limit = target.wall if number >= first else START
            if not select.select([worker.stdout], [], [], limit)[0]:
                worker.kill()
                return [*found, (number, f"no answer within {limit:g} s")], number
            words = worker.stdout.readline().decode().split(maxsplit=2)
            if not words:
                break
            number = int(words[1])
            if words[0] == "fault":
                found.append((number, words[2].strip()))
            elif time.monotonic() > until:
                worker.kill()
                return found, number - 1 if number > first else number
        if worker.wait() != 0:
            errors.seek(0)
            tail = errors.read()[-1500:].decode(errors="replace")
            found.append((number, f"the process ended with status {worker.returncode}: {tail}"))
    return found, number
