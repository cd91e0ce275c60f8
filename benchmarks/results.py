"""The results of a benchmark, as rows of a table and as JSON."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from rich.console import Console
from rich.table import Table


@dataclass
class Row:
    """The time of one implementation, and cubecam's time as a share of it."""

    name: str
    ms: float
    ratio: float | None = None
    mark: float | None = None
    note: str = ""

    @property
    def met(self) -> bool | None:
        if self.ratio is None or self.mark is None:
            return None
        return self.ratio <= self.mark


@dataclass
class Mark:
    """A work, its figure and the limit of the figure; a mark without a limit only informs."""

    work: str
    figure: float | None  # None if it was not measured; the note then says why
    limit: float | None
    unit: str = "x"  # "ms" for a time, "ms more" for a difference, "x" for a ratio
    note: str = ""
    own_ms: float | None = None
    other_ms: float | None = None

    @property
    def holds(self) -> bool | None:
        if self.limit is None:
            return None
        return self.figure is not None and self.figure <= self.limit


@dataclass
class Section:
    """One workload: its rows or marks, and lines to print under them."""

    key: str
    title: str
    rows: list[Row] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    failed: bool = False

    def as_json(self) -> dict[str, Any]:
        data = asdict(self)
        for row, source in zip(data["rows"], self.rows, strict=True):
            row["met"] = source.met
        for mark, found in zip(data["marks"], self.marks, strict=True):
            mark["holds"] = found.holds
        return data


def _share(value: float) -> str:
    return f"{value:.2f}" if value >= 0.1 else f"{value:.3f} (1/{1 / value:.0f})"


ANSWERS = {None: "", True: "[green]yes[/green]", False: "[red]no[/red]"}


def _rows_table(sections: list[Section]) -> Table:
    table = Table(title="cubecam and its peers: median times", title_justify="left")
    table.add_column("workload")
    table.add_column("ms", justify="right")
    table.add_column("cubecam / it", justify="right")
    table.add_column("mark", justify="right")
    table.add_column("met")
    for section in sections:
        table.add_section()
        table.add_row(f"[bold]{section.title}[/bold]")
        for row in section.rows:
            table.add_row(
                f"  {row.name}" + (f" [dim]{row.note}[/dim]" if row.note else ""),
                f"{row.ms:.2f}",
                "" if row.ratio is None else _share(row.ratio),
                "" if row.mark is None else f"<= {_share(row.mark)}",
                ANSWERS[row.met],
            )
    return table


def _marks_table(sections: list[Section]) -> Table:
    table = Table(title="marks: CPU time of all threads, medians", title_justify="left")
    table.add_column("work")
    table.add_column("ms / ms", justify="right")
    table.add_column("figure", justify="right")
    table.add_column("mark", justify="right")
    table.add_column("holds")
    for section in sections:
        table.add_section()
        for mark in section.marks:
            both = mark.own_ms is not None and mark.other_ms is not None
            table.add_row(
                mark.work + (f" [dim]({mark.note})[/dim]" if mark.note else ""),
                f"{mark.own_ms:.2f} / {mark.other_ms:.2f}" if both else "",
                "" if mark.figure is None else f"{mark.figure:.2f} {mark.unit}",
                "" if mark.limit is None else f"<= {mark.limit:g}",
                ANSWERS[mark.holds],
            )
    return table


def print_sections(console: Console, sections: list[Section]) -> None:
    """Print rows and marks as one table each, and the notes under them."""
    with_rows = [section for section in sections if section.rows]
    with_marks = [section for section in sections if section.marks]
    if with_rows:
        console.print(_rows_table(with_rows))
    if with_marks:
        console.print(_marks_table(with_marks))
    for section in sections:
        for note in section.notes:
            style = "red" if section.failed else "dim"
            console.print(f"[{style}]{section.key}: {note}[/{style}]", highlight=False)
