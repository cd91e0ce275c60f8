"""One browser that is connected: what it was sent, and what waits to be sent. Nothing ever queues."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from .access import Receive, Send
from .events import read_message

__all__ = ["Client"]

_IN_FLIGHT = 2  # frames that a browser may have received and not yet shown


class Client:
    """The server's side of a websocket.

    A message has a slot, and a newer message in a slot takes the place of one that was not sent yet: a slow browser
    gets fewer messages, and never old ones.
    """

    def __init__(self) -> None:
        self.size: tuple[int, int, float] | None = None  # what the browser shows, in its pixels
        self.shown = 0  # the number of the newest frame that was put into the slot
        self._sent = self._confirmed = 0
        self._slots: dict[str, tuple[str, bytes | None]] = {}
        self._wake = asyncio.Event()
        self._closing = False

    @property
    def ready(self) -> bool:
        """Whether another frame may be sent."""
        return self._sent - self._confirmed < _IN_FLIGHT and not self._closing

    def put(self, slot: str, message: dict[str, Any], data: bytes | None = None) -> None:
        """Send a message soon; `data` follows it as a binary message."""
        self._slots.pop(slot, None)
        self._slots[slot] = json.dumps(message), data
        self._wake.set()

    def put_frame(self, number: int, frame: dict[str, Any], data: bytes) -> None:
        """Send a frame; the caller has looked at `ready`."""
        self._sent += 1
        self.shown = number
        self.put("frame", {**frame, "index": self._sent}, data)

    def confirm(self, index: Any) -> None:
        """Note that the browser has shown a frame."""
        if isinstance(index, int) and self._confirmed < index <= self._sent:
            self._confirmed = index

    def close(self) -> None:
        """Close the connection after what waits was sent."""
        self._closing = True
        self._wake.set()

    async def run(self, receive: Receive, send: Send, handle: Any) -> None:
        """Serve the connection until one side ends it; `handle(client, message)` gets what comes."""
        reading = asyncio.ensure_future(self._read(receive, handle))
        writing = asyncio.ensure_future(self._write(send))
        try:
            await asyncio.wait([reading, writing], return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in (reading, writing):
                task.cancel()
            await asyncio.gather(reading, writing, return_exceptions=True)

    async def _read(self, receive: Receive, handle: Any) -> None:
        while True:
            received = await receive()
            if received["type"] == "websocket.disconnect":
                return
            message = read_message(received.get("text") or "")
            if message is not None:
                handle(self, message)

    async def _write(self, send: Send) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._slots:
                text, data = self._slots.pop(next(iter(self._slots)))
                await send({"type": "websocket.send", "text": text})
                if data is not None:
                    await send({"type": "websocket.send", "bytes": data})
            if self._closing:
                await send({"type": "websocket.close", "code": 1001})
                return
