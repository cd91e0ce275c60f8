"""What a benchmark found, as rows of a table and as JSON."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from rich.console import Console
from rich.table import Table


@dataclass
class Row:
    """One implementation's time, and cubecam's as a share of it."""

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
class Section:
    """One workload: its rows, and lines to print under them."""

    key: str
    title: str
    rows: list[Row] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    failed: bool = False

    def as_json(self) -> dict[str, Any]:
        data = asdict(self)
        for row, source in zip(data["rows"], self.rows, strict=True):
            row["met"] = source.met
        return data


def _share(value: float) -> str:
    return f"{value:.2f}" if value >= 0.1 else f"{value:.3f} (1/{1 / value:.0f})"


def print_sections(console: Console, sections: list[Section]) -> None:
    """Print the sections as one table, each under its title."""
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
            met = {None: "", True: "[green]yes[/green]", False: "[red]no[/red]"}[row.met]
            table.add_row(
                f"  {row.name}" + (f" [dim]{row.note}[/dim]" if row.note else ""),
                f"{row.ms:.2f}",
                "" if row.ratio is None else _share(row.ratio),
                "" if row.mark is None else f"<= {_share(row.mark)}",
                met,
            )
    console.print(table)
    for section in sections:
        for note in section.notes:
            style = "red" if section.failed else "dim"
            console.print(f"[{style}]{section.key}: {note}[/{style}]", highlight=False)
