"""What the commands of benchmarks with marks have in common: measure one part after the other, print, and keep JSON."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterable
from pathlib import Path

from rich.console import Console

from . import machine
from .processes import WorkerError
from .results import Section, print_sections


def measured(name: str, measures: Iterable[Callable[[], Section]]) -> list[Section]:
    """The sections of a benchmark; one that a program cannot measure has failed, and says why."""
    sections = []
    for measure in measures:
        try:
            sections.append(measure())
        except WorkerError as error:
            sections.append(Section(name, name, notes=[f"left out: {error}"]))
            sections[-1].failed = True
    return sections


def command(name: str, run: Callable[[bool], list[Section]], arguments: list[str]) -> int:
    """`python -m benchmarks.NAME [--quick] [--json JSON]`: 0 if nothing failed."""
    parser = argparse.ArgumentParser(prog=f"python -m benchmarks.{name}")
    parser.add_argument("--quick", action="store_true", help="fewer rounds: noisier")
    parser.add_argument("--json", type=Path, help="where the figures go, besides the table")
    options = parser.parse_args(arguments)
    console = Console()
    if not console.is_terminal:
        console.width = 120
    sections = run(options.quick)
    print_sections(console, sections)
    if options.json:
        data = {"machine": machine.describe(), "sections": [part.as_json() for part in sections]}
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(data, indent=2) + "\n")
    return int(any(section.failed for section in sections))
