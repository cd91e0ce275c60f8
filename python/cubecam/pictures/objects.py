"""The two methods that `_attach` gives to the classes: what notebooks and what rich show of an object.

A repr must never fail: whatever goes wrong becomes a line of the card.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import scenes  # noqa: F401 - registers the cards of scenes and nodes
from .cards import Card, shorten
from .describe import card_of
from .html import card_html

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderResult

__all__ = ["repr_html", "rich_object"]


def repr_html(thing: Any) -> str:
    """Give the HTML that Jupyter shows."""
    try:
        return card_html(card_of(thing))
    except Exception as error:
        return card_html(_plain(thing, error))


def rich_object(thing: Any) -> object:
    """Give what `rich.print` shows."""
    return _Described(thing)


class _Described:
    """An object as rich draws it, for which the console must be known.

    The classes themselves have `__rich__` alone: rich cannot print a class that has `__rich_console__`.
    """

    def __init__(self, thing: Any) -> None:
        self._thing = thing

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        from .rich_text import card_text

        try:
            shown = card_text(card_of(self._thing), console, options.max_width)
        except Exception as error:
            shown = card_text(_plain(self._thing, error), console, options.max_width)
        yield shown


def _plain(thing: Any, error: Exception) -> Card:
    """Describe an object by its repr and the reason why there is no more."""
    try:
        text = repr(thing)
    except Exception:
        text = type(thing).__name__
    return Card(shorten(text, 240), note=shorten(error, 240))
