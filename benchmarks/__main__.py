"""`python -m benchmarks`: cubecam next to its peers, as a table of ratios."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from rich.console import Console

from . import batches, equirect, live, machine, marks, reflection, startup
from .processes import ROOT
from .reflections import marks as reflection_marks
from .results import Section, print_sections

TEAPOT = ROOT / "python" / "cubecam" / "data" / "teapot.obj"


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="fewer rounds: noisier, in half a minute"
    )
    parser.add_argument(
        "--only",
        action="append",
        metavar="NAME",
        choices=[
            "p14-teapot",
            "p14-knot",
            "equirect",
            "startup",
            "live",
            "reflections",
            "batches",
            "marks",
            *marks.PARTS,
        ],
        help="p14-teapot, p14-knot, equirect, startup, live, reflections, batches, marks, or one of "
        + ", ".join(marks.PARTS)
        + "; may be given several times",
    )
    parser.add_argument(
        "--variants", action="store_true", help="also time peers that cull objects by hand"
    )
    parser.add_argument(
        "--before",
        type=Path,
        metavar="DIR",
        help="a built tree of the version before; without, marks-p14 builds one from git",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all numbers to FILE")
    return parser.parse_args()


def main() -> int:
    """Run the chosen benchmarks; return 1 if a picture differs or cubecam does not run."""
    arguments = _arguments()
    console = Console()
    if not console.is_terminal:
        console.width = 110
    found = machine.describe()
    console.print(" · ".join(f"{key} {value}" for key, value in found.items()), highlight=False)

    workloads: dict[str, Callable[[], list[Section]]] = {
        f"p14-{size}": partial(
            reflection.run, size, TEAPOT, quick=arguments.quick, variants=arguments.variants
        )
        for size in reflection.SIZES
    }
    workloads["equirect"] = partial(equirect.run, arguments.quick)
    workloads["startup"] = partial(startup.run, arguments.quick)
    workloads["live"] = partial(live.run, arguments.quick)
    workloads["reflections"] = partial(reflection_marks.run, arguments.quick)
    workloads["batches"] = partial(batches.run, arguments.quick)
    for part in marks.PARTS:
        workloads[part] = partial(marks.run, part, quick=arguments.quick, old=arguments.before)

    wanted: list[str] = []
    for name in arguments.only or workloads:
        wanted += marks.PARTS if name == "marks" else [name]
    sections: list[Section] = []
    for name in dict.fromkeys(wanted):
        with console.status(f"{name} ..."):
            sections += workloads[name]()
    print_sections(console, sections)
    if arguments.json:
        data = {"machine": found, "sections": [section.as_json() for section in sections]}
        arguments.json.write_text(json.dumps(data, indent=2) + "\n")
        console.print(f"wrote {arguments.json}")
    return int(any(section.failed for section in sections))


if __name__ == "__main__":
    sys.exit(main())
