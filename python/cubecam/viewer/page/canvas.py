"""A canvas of rendercanvas that is shown by browsers: several of them can be in one process, unlike rendercanvas' own.

The protocol is that of `rendercanvas.http`, so that rendercanvas' own `renderview.js` sends the events. Two things
differ. Text and panels go over the same websocket. And nothing runs by the clock: a canvas draws in the server's loop
when a draw was requested and a browser is ready for another frame; while nothing changes, nothing is awake.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from rendercanvas.base import BaseRenderCanvas
from rendercanvas.core.encoders import encode_array

from ...io.oiio import encode
from .access import Receive, Scope, Send, refuse
from .client import Client
from .events import to_event, to_size

__all__ = ["PageCanvas"]

_QUICK = {"png:compressionLevel": 1}
#: Messages that make a browser the one whose size the picture has, where several browsers show one view.
_DOING_SOMETHING = frozenset(["pointer_down", "key_down", "wheel", "double_click", "control"])


class PageCanvas(BaseRenderCanvas):  # type: ignore[misc] # rendercanvas has no types
    """A canvas whose picture goes to each connected browser, as an ASGI application of its own.

    Parameters
    ----------
    loop : asyncio.AbstractEventLoop
        The server's loop. The canvas draws in it.
    size : tuple of int
        The (width, height) in logical pixels until a browser says how large its window is.
    title : str
        The title of the page.
    max_fps : float
        The most frames a second.
    """

    _rc_canvas_group = None  # no loop and no scheduler of rendercanvas: see the module
    _quality = 80  # of JPEG; with 100 a frame is sent as PNG, which loses nothing

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        *,
        size: tuple[int, int] = (640, 480),
        title: str = "cubecam",
        max_fps: float = 30.0,
    ) -> None:
        super().__init__(size=size, title=title)
        self._loop = loop
        self._interval = 1 / max_fps
        self._closed = False
        self._wanted = True
        self._next_time = 0.0
        self._timer: asyncio.TimerHandle | None = None
        self._clients: list[Client] = []  # the last one is the active one
        self._frame: tuple[dict[str, Any], bytes] | None = None
        self._frame_number = 0
        self._kept: dict[str, dict[str, Any]] = {}  # what a browser that connects later gets first
        self._handlers: dict[str, Callable[[dict[str, Any]], None]] = {}
        self._final_canvas_init()
        self.get_bitmap_context()  # without one rendercanvas draws nothing, and asks no view for a picture

    # ----- for the view

    def request_draw(self, draw_function: Callable[[], None] | None = None) -> None:
        """Draw soon; from any thread."""
        super().request_draw(draw_function)
        self._wanted = True
        self._from_any_thread(self._plan)

    def submit_event(self, event: dict[str, Any]) -> None:
        """Hand an event to the handlers soon; from any thread."""
        super().submit_event(event)
        self._from_any_thread(self._plan)

    def tell(self, kind: str, value: Any, *, keep: bool = True) -> None:
        """Send {"type": kind, "value": value} to each browser, and to later ones if `keep`; from any thread."""
        self._from_any_thread(lambda: self._tell(kind, value, keep))

    def on_message(self, kind: str, function: Callable[[dict[str, Any]], None]) -> None:
        """Call a function with each message of that type; it runs in the server's loop."""
        self._handlers[kind] = function

    # ----- for the server

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a websocket, which `Access` has let through."""
        if self._closed:
            await refuse(scope, receive, send)
            return
        await receive()
        await send({"type": "websocket.accept"})
        client = Client()
        self._clients.append(client)
        for kind, message in self._kept.items():
            client.put(kind, message)
        self._wanted = True  # at this browser's size
        try:
            await client.run(receive, send, self._receive)
        finally:
            self._clients.remove(client)
            self._plan()

    def _receive(self, client: Client, message: dict[str, Any]) -> None:
        kind = message["type"]
        if kind == "_framefeedback":
            client.confirm(message.get("index"))
        elif kind == "resize":
            client.size = to_size(message) or client.size
        elif kind in self._handlers:
            self._handlers[kind](message)
        else:
            event = to_event(message)
            if event is not None:
                super().submit_event(event)
        if kind in _DOING_SOMETHING and client is not self._clients[-1]:
            self._clients.remove(client)
            self._clients.append(client)
        self._plan()

    # ----- drawing

    def _from_any_thread(self, function: Callable[[], None]) -> None:
        if not self._closed:
            try:
                self._loop.call_soon_threadsafe(function)
            except RuntimeError:  # the loop was closed in the meantime
                self._closed = True

    def _plan(self) -> None:
        """Process events and draw at the next time that the frames a second allow."""
        if self._timer is None and not self._closed:
            wait = self._next_time - time.monotonic()
            self._timer = self._loop.call_later(max(0.0, wait), self._tick)

    def _tick(self) -> None:
        self._timer = None
        self._next_time = time.monotonic() + self._interval
        self._take_size()
        self._process_events()
        if self._wanted and self._clients and self._clients[-1].ready and not self._closed:
            self._wanted = False
            self._time_to_draw()
            if self._wanted:
                self._plan()
        self._send_frame()

    def _take_size(self) -> None:
        """Give the canvas the size of the active browser."""
        size = self._clients[-1].size if self._clients else None
        if size is None:
            return
        width, height, ratio = size
        same = self.get_physical_size() == (width, height) and self.get_pixel_ratio() == ratio
        if not same:
            self._size_info.set_physical_size(width, height, ratio)
            self._wanted = True

    def _send_frame(self) -> None:
        """Send the newest frame to the browsers that are ready; the others skip it."""
        if self._frame is not None:
            for client in self._clients:
                if client.ready and client.shown < self._frame_number:
                    client.put_frame(self._frame_number, *self._frame)

    def _tell(self, kind: str, value: Any, keep: bool) -> None:
        message = {"type": kind, "value": value}
        if keep:
            self._kept[kind] = message
        for client in self._clients:
            client.put(kind, message)

    # ----- what rendercanvas wants of a backend

    def _rc_get_present_info(self, present_methods: list[str]) -> dict[str, Any] | None:
        if "bitmap" in present_methods:
            return {"method": "bitmap", "formats": ["rgba-u8"]}
        return None

    def _rc_present_bitmap(self, *, data: npt.NDArray[np.uint8], **_: Any) -> None:
        if self._quality >= 100:
            # As quick as rendercanvas' own PNG (61 ms for 1024 x 1024 pixels), and half as large.
            mimetype, encoded = "image/png", encode(".png", np.asarray(data)[..., :3], _QUICK)
        else:
            mimetype, encoded = encode_array(np.asarray(data), self._quality)
        head = {"type": "framebufferdata", "nbuffers": 1, "mimetype": mimetype}
        self._frame = {**head, "timestamp": time.time()}, encoded
        self._frame_number += 1
        self._from_any_thread(self._send_frame)

    def _rc_set_logical_size(self, width: float, height: float) -> None:
        self._size_info.set_physical_size(round(width), round(height), 1.0)

    def _rc_set_title(self, title: str) -> None:
        self.tell("title", title)

    def _rc_set_cursor(self, cursor: str) -> None:
        self.tell("cursor", cursor)

    def _rc_get_closed(self) -> bool:
        return self._closed

    def _rc_close(self) -> None:
        if not self._closed:
            self._from_any_thread(self._close_clients)
            self._closed = True

    def _close_clients(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        for client in self._clients:
            client.close()
