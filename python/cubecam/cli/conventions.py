"""`cubecam conventions`: what faces, rows, axes and numbers mean, from docs/conventions.md."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import click

from .common import failures_reported
from .help import Command, option

__all__ = ["conventions", "conventions_file", "section_of"]

_PACKAGE = Path(__file__).resolve().parent.parent
_WIDEST = 120


def conventions_file() -> Path:
    """Find the document: in the installed package, or in the checkout that the package is imported from.

    Raises
    ------
    FileNotFoundError
        If it is in neither place.
    """
    checkout = _PACKAGE.parent.parent / "docs" / "conventions.md"
    if checkout.is_file() and (_PACKAGE.parent.parent / "pyproject.toml").is_file():
        return checkout
    installed = _PACKAGE / "conventions.md"
    if not installed.is_file():
        raise FileNotFoundError(
            f"expected {installed}, which comes with the package; `cubecam doctor` says how to install it again"
        )
    return installed


def section_of(text: str, words: str) -> str:
    """Give the sections whose titles contain some words, each with what stands below it.

    Raises
    ------
    ValueError
        If no title does; the error lists all.
    """
    lines = text.splitlines()
    titles = [at for at, line in enumerate(lines) if line.startswith("#")]
    found: list[str] = []
    end = 0
    for at in titles:
        if at < end or words.lower() not in lines[at].lower():
            continue
        depth = lines[at].index(" ")
        later = [other for other in titles if other > at and lines[other].index(" ") <= depth]
        end = later[0] if later else len(lines)
        found += lines[at:end]
    if not found:
        known = "; ".join(lines[at].lstrip("# ") for at in titles[1:])
        raise ValueError(
            f"--section: expected words of a title, got {words!r}; the titles are: {known}"
        )
    return "\n".join(found).strip() + "\n"


@click.command(cls=Command)
@option("--section", metavar="WORDS", help="Print only the sections whose titles have these words.")
def conventions(section: str | None) -> None:
    """Print what faces, rows, axes, layouts and numbers mean: Markdown, laid out in a terminal."""
    with failures_reported():
        text = conventions_file().read_text(encoding="utf-8")
        if section is not None:
            text = section_of(text, section)
        if sys.stdout.isatty():
            _lay_out(text)
        else:
            click.echo(text, nl=False)


def _lay_out(text: str) -> None:
    from rich.console import Console
    from rich.markdown import Markdown

    console = Console()
    # Links lead to other documents, which are not in the package: their words are enough.
    words = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", text)
    console.print(Markdown(words), width=min(console.width, _WIDEST))
