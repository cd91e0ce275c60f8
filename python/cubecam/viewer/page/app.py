"""One view as a page: its canvas, its text and its panel."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..panel import panel_to_json, set_control
from .canvas import PageCanvas

if TYPE_CHECKING:
    from ..live import LiveView

__all__ = ["PageApp"]

_REFRESH = 0.2  # seconds between a change and the new numbers of the whole panel


class PageApp:
    """Connect a view and the browsers that show it.

    Parameters
    ----------
    view : LiveView
        What is shown.
    loop : asyncio.AbstractEventLoop
        The server's loop.
    forget : callable
        Called when the view was closed.
    """

    def __init__(
        self, view: LiveView, loop: asyncio.AbstractEventLoop, forget: Callable[[], None]
    ) -> None:
        self.view = view
        self._loop = loop
        self._forget = forget
        self._refreshing: asyncio.TimerHandle | None = None
        self._sections: Any = []
        self.canvas = PageCanvas(loop, size=view.size, title=view.title)
        self.canvas.on_message("control", self._set_control)
        view.add_listener(self._heard)
        view._attach(self.canvas)
        self.canvas.tell("text", view.text)
        self.canvas.tell("help", view.help)
        loop.call_soon_threadsafe(self._send_panel)

    def close(self) -> None:
        """Disconnect the browsers; the view stays open."""
        with contextlib.suppress(ValueError):
            self.view.remove_listener(self._heard)
        self.view._detach(self.canvas)
        self.canvas.close()

    def _heard(self, name: str, value: Any) -> None:
        if name == "text":
            self.canvas.tell("text", str(value))
        elif name == "panel":
            self._loop.call_soon_threadsafe(self._refresh_soon)
        elif name == "closed":
            self._forget()
            self.canvas.close()

    def _refresh_soon(self) -> None:
        if self._refreshing is None:
            self._refreshing = self._loop.call_later(_REFRESH, self._send_panel)

    def _send_panel(self) -> None:
        self._refreshing = None
        self._sections = self.view.panel()
        self.canvas.tell("panel", panel_to_json(self._sections))

    def _set_control(self, message: dict[str, Any]) -> None:
        """Set what a person changed on the page, and say so, or why not."""
        place = message.get("control")
        if not isinstance(place, list) or len(place) != 2 or not all(type(i) is int for i in place):
            return
        try:
            set_control(self._sections, place[0], place[1], message.get("value"))
        except (ValueError, TypeError, IndexError) as error:
            problem = str(error)
        else:
            problem = ""
            self.view.changed()
        self.canvas.tell(f"problem {place[0]} {place[1]}", problem, keep=False)
        self._refresh_soon()
