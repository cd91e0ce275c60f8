"""The two methods that `_attach` gives to the classes: what notebooks and what rich show of an object.

A repr must never fail: whatever goes wrong becomes a line of the card.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from . import scenes  # noqa: F401 - registers the cards of scenes and nodes
from .cards import Card, shorten
from .describe import card_of
from .html import card_html

__all__ = ["repr_html", "rich_console"]


def repr_html(thing: Any) -> str:
    """Give the HTML that Jupyter shows."""
    try:
        return card_html(card_of(thing))
    except Exception as error:
        return card_html(_plain(thing, error))


def rich_console(thing: Any, console: Any, options: Any) -> Iterator[Any]:
    """Give what `rich.print` shows on a `rich.console.Console` with its ConsoleOptions."""
    from .rich_text import card_text

    try:
        shown = card_text(card_of(thing), console, options.max_width)
    except Exception as error:
        shown = card_text(_plain(thing, error), console, options.max_width)
    yield shown


def _plain(thing: Any, error: Exception) -> Card:
    """Describe an object by its repr and the reason why there is no more."""
    try:
        text = repr(thing)
    except Exception:
        text = type(thing).__name__
    return Card(shorten(text, 240), note=shorten(error, 240))
