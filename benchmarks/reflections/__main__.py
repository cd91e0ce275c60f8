"""Reflections by each method against exact rays: python -m benchmarks.reflections --quick

It prints the table and writes it to a folder, as table.md and table.json, with a picture of each row: the truth is on
the left. What this version of cubecam cannot do is named and left out.
"""

from __future__ import annotations

import argparse
import resource
from pathlib import Path

import cubecam as cc

from .. import machine
from . import scenes
from .reflectors import REFLECTORS
from .table import Bench, Row, as_json, cases, markdown

#: What stands in a document before and after the table.
BEGIN, END = "<!-- benchmarks.reflections -->", "<!-- end -->"


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.reflections", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer rows, in a minute")
    parser.add_argument("--out", type=Path, default=Path("out/reflections"))
    parser.add_argument("--place", action="append", choices=list(scenes.PLACES))
    parser.add_argument("--reflector", action="append", choices=list(REFLECTORS))
    parser.add_argument("--rounds", type=int, help="frames that are timed; 0: none")
    parser.add_argument(
        "--page", type=Path, help="a document that gets the table between its marks"
    )
    parser.add_argument("--write", action="store_true", help="only write the files of the scenes")
    options = parser.parse_args()
    if options.write:
        scenes.write()
        return
    options.out.mkdir(parents=True, exist_ok=True)
    chosen = [
        case
        for case in cases(quick=options.quick)
        if case.place in (options.place or scenes.PLACES)
        and case.reflector in (options.reflector or REFLECTORS)
    ]
    rounds = (2 if options.quick else 5) if options.rounds is None else options.rounds
    started = _cpu_seconds()
    with cc.Renderer() as renderer:
        bench = Bench(renderer, rounds, options.out)
        rows = bench.run(chosen, _tell)
    (options.out / "table.md").write_text(markdown(rows))
    (options.out / "table.json").write_text(as_json(rows, machine.describe()))
    if options.page is not None:
        _put_into(options.page, markdown(row for row in rows if not row.missing))
    print(f"{_cpu_seconds() - started:.0f} s of CPU; wrote {options.out / 'table.md'}")


def _put_into(page: Path, table: str) -> None:
    """Replace what stands between the marks of a document."""
    before, _, rest = page.read_text().partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise SystemExit(f"{page}: expected the marks {BEGIN} and {END}, found none")
    page.write_text(f"{before}{BEGIN}\n\n{table.strip()}\n\n{END}{after}")


def _cpu_seconds() -> float:
    """CPU time of this process and of those that drew exact pictures."""
    every = (resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in every)


def _tell(row: Row) -> None:
    print(markdown([row]).splitlines()[-1], flush=True)


if __name__ == "__main__":
    main()
