"""Run for a long time: `python -m tests.soak --minutes 60 --only edits --seed 7`.

The minutes are shared out among the parts: edits (random edits of random worlds, each picture compared with one of a
renderer that has drawn nothing before), threads (eight threads that edit and draw, compared with each of them alone)
and contexts (renderers that come and go). The exit status is 1 if there is a fault; its line says which seed repeats it.
"""

from __future__ import annotations

import argparse
import sys
import time

from tests.soak import contexts, edits, threads

PARTS = {"edits": edits.run, "threads": threads.run, "contexts": contexts.run}


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.soak", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10, help="all parts together")
    parser.add_argument("--seed", type=int, default=0, help="another number gives other worlds")
    parser.add_argument("--only", default=",".join(PARTS), help="parts, with commas between")
    options = parser.parse_args()
    names = options.only.split(",")
    faults = 0
    for name in names:
        begun = time.monotonic()
        report = PARTS[name](begun + 60 * options.minutes / len(names), options.seed)
        print(f"{name:8} {report}, seed {options.seed}, {time.monotonic() - begun:.0f} s", flush=True)
        for text in report.faults:
            print("   ", text, flush=True)
        faults += len(report.faults)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
