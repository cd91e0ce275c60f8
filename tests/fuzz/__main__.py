"""Try broken input of every kind: `python -m tests.fuzz --only api,obj --minutes 30`.

Worker processes make calls with absurd arguments (api), restore broken pickles (pickles), draw with broken shaders
(glsl) and read broken files (obj, ply, ..., ktx2). Each case gives a result or one of the errors that the functions
document. A crash, a hang, memory beyond a bound or another exception is a fault: its case is kept in the folder
`--keep`, and the exit status is 1. Once the fault is mended, its case belongs to tests/fuzz/corpus, which the test
suite tries always.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from tests.fuzz.runner import faults_of, run, work
from tests.fuzz.targets import COUNTS, NAMES, target


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--count", type=int, help="cases of each target")
    parser.add_argument("--seed", type=int, default=0, help="another number gives other cases")
    parser.add_argument("--only", default="", help=f"targets, with commas: {','.join(NAMES)}")
    parser.add_argument("--minutes", type=float, help="go on with other cases until then; 0: until Ctrl-C")
    parser.add_argument("--keep", type=Path, default=Path("tests/failures/fuzz"))
    parser.add_argument("--work", nargs=3, metavar=("TARGET", "FIRST", "END"), help=argparse.SUPPRESS)
    parser.add_argument("--again", nargs=2, metavar=("TARGET", "FILE"), help="try one kept case in this process")
    options = parser.parse_args()
    if options.work:
        name, first, end = options.work
        work(target(name), int(first), int(end))
        return 0
    if options.again:
        name, path = options.again
        faults = faults_of(target(name), Path(path).read_bytes(), Path.cwd())
        print("\n".join(faults) or "no fault")
        return int(bool(faults))
    names = options.only.split(",") if options.only else NAMES
    start = time.monotonic()
    until = start + options.minutes * 60 if options.minutes else float("inf")
    faults, total, seed = [], 0, options.seed
    try:
        while True:
            for name in names:
                found, tried = _one(name, options.count or COUNTS[name], seed, options.keep, until)
                faults += found
                total += tried
            seed += 1
            if options.minutes is None or time.monotonic() > until:
                break
    except KeyboardInterrupt:
        print(f"ended by Ctrl-C in round {seed - options.seed + 1}")
    took = time.monotonic() - start
    print(f"{total} cases of {len(names)} targets, {len(faults)} faults, {took:.0f} s")
    return 1 if faults else 0


def _one(
    name: str, count: int, seed: int, keep: Path, until: float
) -> tuple[list[str], int]:
    """Try a target and print what was found."""
    begun = time.monotonic()
    if begun > until:
        return [], 0
    found, tried = run(target(name), count, seed * 10_000_000, keep, until=until)
    took = time.monotonic() - begun
    print(f"{name:7} {tried:6} cases, seed {seed}, {len(found)} faults, {took:.0f} s", flush=True)
    for text in found[:10]:
        print("   ", text, flush=True)
    return found, tried


if __name__ == "__main__":
    sys.exit(main())
