"""For tests of pages: a tiny live view, a client by hand of HTTP and the websocket, and what a process holds."""

import asyncio
import http.client
import io
import json
import threading
import time
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import psutil
from PIL import Image
from websockets.sync.client import connect

ANY = object()


class Tiny:
    """What a page needs of a live view: one colour, which a control sets, and a list of the events that came."""

    def __init__(self, size=(64, 48)):
        self.title = "tiny"
        self.size = size
        self.text = "ready"
        self.help = "h  this list"
        self.color = (200, 100, 50)
        self.events = []
        self.drawn = 0
        self.quality = 100
        self.sections = []
        self.on_draw = None
        self._canvas: Any = None
        self._listeners = []

    def panel(self):
        return self.sections

    def add_listener(self, function):
        self._listeners.append(function)

    def remove_listener(self, function):
        self._listeners.remove(function)

    def tell(self, name, value=None):
        for function in list(self._listeners):
            function(name, value)

    def changed(self, moving=True):
        if self._canvas is not None:
            self._canvas.request_draw()

    def _attach(self, canvas):
        self._canvas = canvas
        canvas.add_event_handler(
            self.events.append, "pointer_down", "pointer_move", "key_down", "resize"
        )
        canvas.request_draw(self._draw)

    def _detach(self, canvas):
        self._canvas = None

    def _draw(self):
        self.drawn += 1
        if self.on_draw is not None:
            self.on_draw()
        width, height = self._canvas.get_physical_size()
        picture = np.full((height, width, 4), 255, np.uint8)
        picture[..., :3] = self.color
        self._canvas._quality = self.quality
        self._canvas.get_bitmap_context().set_bitmap(picture)


#: mypy: a page needs less of a view than `LiveView` has.
TinyView: Any = Tiny


def get(url, path=None, headers=None, method="GET", body=None):
    """Send one request as written, path and headers alike; give (status, headers, body). None leaves out a header."""
    parts = urlsplit(url)
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=10)
    try:
        connection.putrequest(method, path if path is not None else parts.path, skip_host=True)
        given = {"Host": parts.netloc, **(headers or {})}
        for name, value in given.items():
            if value is not None:
                connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()
    finally:
        connection.close()


def open_socket(url, origin=ANY, headers=None):
    """Open the websocket of a page as a browser does."""
    parts = urlsplit(url)
    chosen: Any = f"http://{parts.netloc}" if origin is ANY else origin
    return connect(
        url.replace("http://", "ws://"),
        origin=chosen,
        additional_headers=headers,
        compression=None,
        open_timeout=10,
        max_size=None,
    )


def send(socket, **message):
    socket.send(json.dumps({"timestamp": 0.0, **message}))


def resize(socket, width, height, ratio=1.0):
    send(
        socket,
        type="resize",
        width=width / ratio,
        height=height / ratio,
        pwidth=width,
        pheight=height,
        ratio=ratio,
    )


def receive(socket, kind, timeout=10):
    """Return the next message of a type; of a frame (its message, its bytes)."""
    while True:
        message = json.loads(socket.recv(timeout))
        data = socket.recv(timeout) if message["type"] == "framebufferdata" else None
        if message["type"] == kind:
            return message if data is None else (message, data)


def confirm(socket, message):
    send(socket, type="_framefeedback", index=message["index"])


def pixels(data):
    return np.asarray(Image.open(io.BytesIO(data)))


def frame(connection):
    """Receive a frame and confirm it, as a browser does."""
    message, data = receive(connection, "framebufferdata")
    confirm(connection, message)
    return message, pixels(data)


def until(condition, seconds=10):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.005)


class Footprint:
    """What a process holds: threads, files and sockets, and asyncio tasks of a server."""

    def __init__(self, server=None):
        process = psutil.Process()
        self.threads = sorted(thread.name for thread in threading.enumerate())
        self.files = process.num_fds()
        self.sockets = len(process.net_connections("tcp"))
        self.tasks = -1 if server is None else len(tasks_of(server))

    def __eq__(self, other):
        return vars(self) == vars(other)

    def __repr__(self):
        return str(vars(self))


def tasks_of(server):
    found: list[object] = []
    done = threading.Event()

    def look():
        found.extend(asyncio.all_tasks())
        done.set()

    server._loop.call_soon_threadsafe(look)
    assert done.wait(10)
    return found
