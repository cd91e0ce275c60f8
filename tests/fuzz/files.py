"""Break files of every kind and read them: `python -m tests.fuzz.files --count 30000`.

A worker process reads the files. Whatever its bytes are, a file gives a mesh, a picture or a cubemap, or one of the
errors that the functions document. A crash, a hang over 5 seconds, more than 300 MiB of memory beyond that of the sound
files, or another exception is a fault; the file is kept in the folder `--keep`, and the exit status is 1.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import select
import signal
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np

import cubecam as cc
from tests.fuzz.mutate import mutated
from tests.fuzz.seeds import seeds

SECONDS = 5.0
MEMORY = 300 << 20  # bytes
PICTURES = ["hdr", "pic", "exr", "png", "jpg", "tif", "webp", "bmp", "tga", "gif", "dds", "ktx2"]
#: What the readers raise for files that are broken; a wrong shape of a cubemap is a ValueError.
EXPECTED = (cc.MeshError, cc.ImageError)

#: Shows a library of materials.
OBJ_OF_MTL = b"mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b c\nf 3 2 1\n"


def read(path: Path) -> None:
    """Read a file in every way that the package has for its kind."""
    if path.suffix == ".mtl":
        shape = path.with_suffix(".obj")
        shape.write_bytes(OBJ_OF_MTL % path.name.encode())
        with contextlib.suppress(*EXPECTED):
            cc.load_scene(shape)
        shape.unlink()
        return
    if path.suffix[1:] not in PICTURES:
        with contextlib.suppress(*EXPECTED):
            cc.load_mesh(path)
        with contextlib.suppress(*EXPECTED):
            cc.load_scene(path)
        return
    with contextlib.suppress(*EXPECTED):
        cc.load_image(path)
    with contextlib.suppress(*EXPECTED, ValueError):
        cc.load_cubemap(path, size=8)
    with contextlib.suppress(*EXPECTED, ValueError):
        cc.load_cubemap(path, levels=True)


def broken(kind: str, number: int) -> bytes:
    """Make a broken file; the same number gives the same bytes."""
    files = seeds()[kind]
    rng = np.random.default_rng([number, *kind.encode()])
    return mutated(files[int(rng.integers(len(files)))], rng)


def faults_in_process(
    kind: str, numbers: range, folder: Path, seconds: float = SECONDS, planted: str = ""
) -> list[str]:
    """Read broken files in this process; return what was not as it should be, except for crashes.

    A planted fault takes the place of file 1: it shows that this program finds it.
    """
    path = folder / f"a.{kind}"
    found = []
    for number in numbers:
        path.write_bytes(broken(kind, number))
        start = time.process_time()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                warnings.simplefilter("ignore", cc.ConventionWarning)
                warnings.simplefilter("ignore", cc.SceneWarning)
                _FAULTS[planted]() if planted and number == 1 else read(path)
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            found.append(f"{type(error).__name__}: {error} ({place.filename}:{place.lineno})")
        if time.process_time() - start > seconds:
            found.append(f"took {time.process_time() - start:.1f} s")
    return found


def _error() -> None:
    raise KeyError("planted")


def _slow() -> None:
    end = time.process_time() + 1.2
    while time.process_time() < end:
        pass


_FAULTS: dict[str, Callable[[], object]] = {
    "error": _error,
    "slow": _slow,
    "hang": lambda: time.sleep(60),
    "crash": lambda: os.kill(os.getpid(), signal.SIGSEGV),
    "memory": lambda: np.ones(MEMORY // 8 + (8 << 20)).sum(),
}


def _peak() -> int:
    """Return the most memory that this process has had, in bytes.

    getrusage would begin with the memory of the process that started this one.
    """
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.partition("VmHWM:")[2].split()[0]) * 1024


def _work(kind: str, first: int, end: int, seconds: float, planted: str) -> None:
    """Read files in a worker process, which says what it does line by line."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for place, data in enumerate(seeds()[kind]):
            sound = folder / f"{place}.{kind}"
            sound.write_bytes(data)
            read(sound)
        calm = _peak()
        for number in range(first, end):
            print("start", number, flush=True)
            for told in faults_in_process(
                kind, range(number, number + 1), folder, seconds, planted
            ):
                print("fault", number, " ".join(told.split()), flush=True)
            if _peak() - calm > MEMORY:
                print("fault", number, f"memory grew by {(_peak() - calm) >> 20} MiB", flush=True)
                return


def run(
    kind: str, count: int, first: int, keep: Path, seconds: float = SECONDS, planted: str = ""
) -> list[str]:
    """Read all files of a kind; a worker that ends early is followed by another one. Return the faults."""
    end, found = first + count, []
    while first < end:
        told, last = _one_worker(kind, first, end, seconds, planted)
        for number, text in told:
            found.append(f"{kind} {number}: {text}")
            _keep(keep, kind, number)
        if last < first:
            break  # the sound files are a fault, and every other worker would end there
        first = last + 1
    return found


def _one_worker(
    kind: str, first: int, end: int, seconds: float, planted: str
) -> tuple[list[tuple[int, str]], int]:
    """Let a worker read files `first` to `end`; return its faults and the number of the last file that it read."""
    words = [kind, str(first), str(end), str(seconds), planted]
    command = [sys.executable, "-m", "tests.fuzz.files", "--work", *words]
    found: list[tuple[int, str]] = []
    number = first - 1
    with (
        tempfile.TemporaryFile() as errors,
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, bufsize=0) as worker,
    ):
        assert worker.stdout is not None
        while True:
            # Without a buffer (bufsize=0), select sees all that is left to read. A worker that starts imports the
            # package and makes the sound files.
            limit = 4 * seconds if number >= first else 120
            if not select.select([worker.stdout], [], [], limit)[0]:
                worker.kill()
                return [*found, (number, f"no answer within {limit:g} s")], number
            words = worker.stdout.readline().decode().split(maxsplit=2)
            if not words:
                break
            number = int(words[1])
            if words[0] == "fault":
                found.append((number, words[2].strip()))
        if worker.wait() != 0:
            errors.seek(0)
            tail = errors.read()[-1500:].decode(errors="replace")
            found.append((number, f"the process ended with status {worker.returncode}: {tail}"))
    return found, number


def _keep(folder: Path, kind: str, number: int) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{number}.{kind}").write_bytes(broken(kind, number))


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=30000, help="files of each kind")
    parser.add_argument("--seed", type=int, default=0, help="another number gives other files")
    parser.add_argument("--only", default="", help="kinds, with commas between")
    parser.add_argument("--keep", type=Path, default=Path("tests/failures/fuzz"))
    parser.add_argument("--work", nargs=5, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.work:
        kind, first, end, seconds, planted = options.work
        _work(kind, int(first), int(end), float(seconds), planted)
        return 0
    kinds = options.only.split(",") if options.only else list(seeds())
    faults, total, start = [], 0, time.monotonic()
    for kind in kinds:
        begun = time.monotonic()
        found = run(kind, options.count, options.seed * 10_000_000, options.keep)
        total += options.count
        faults += found
        print(
            f"{kind:5} {options.count:6} files, {len(found)} faults, {time.monotonic() - begun:.0f} s",
            flush=True,
        )
        for text in found[:5]:
            print("   ", text, flush=True)
    print(
        f"{total} files of {len(kinds)} kinds, {len(faults)} faults, {time.monotonic() - start:.0f} s"
    )
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
