"""The server of the pages: each view is an application of its own, mounted by path, in one process behind one token."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import socket
import threading
from typing import TYPE_CHECKING, Any

from .access import Access, Receive, Scope, Send, answer, refuse
from .resources import resources

if TYPE_CHECKING:
    from ..live import LiveView
    from .app import PageApp

__all__ = ["PageServer"]

_START_TIME = 30.0  # seconds that a server may take to start, on a machine that is busy
_LOCAL = ("127.0.0.1", "localhost", "::1")
_ANY = ("0.0.0.0", "::")


class PageServer:
    """Show live views as pages of a browser. The server runs in a thread of its own until `close`.

    Parameters
    ----------
    host : str
        The address to listen on. Other machines reach "0.0.0.0" or an address of this machine, and then a password is
        wanted.
    port : int
        The port; 0 takes a free one.
    password : str, optional
        What a person writes before the page is shown.

    Raises
    ------
    ValueError
        For an address that other machines reach, without a password.
    OSError
        If the address or the port cannot be used.

    Attributes
    ----------
    address : str
        "http://HOST:PORT/TOKEN/", without the part that names a view.
    """

    def __init__(
        self, host: str = "127.0.0.1", port: int = 0, *, password: str | None = None
    ) -> None:
        if host not in _LOCAL and not password:
            raise ValueError(
                f"host: expected 127.0.0.1, or a password for {host!r}, which other machines may reach"
            )
        self._token = secrets.token_urlsafe(24)
        self._apps: dict[bytes, PageApp] = {}
        self._socket = _listening(host, port)
        self.port: int = self._socket.getsockname()[1]
        names = [_in_address(name) for name in _names(host)]
        self.address = f"http://{names[0]}:{self.port}/{self._token}/"
        hosts = [f"{name}:{self.port}" for name in names]
        if self.port == 80:
            hosts += names  # browsers leave the port of http out
        self._access = Access(self._serve, self._token, hosts, password)
        self._started = threading.Event()
        self._closed = threading.Event()
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._server: Any = None
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="cubecam page", daemon=True)
        self._thread.start()
        if not self._started.wait(_START_TIME) or self._error is not None:
            self.close()
            raise OSError(f"the server of the page did not start: {self._error}")

    # ----- views

    def add(self, view: LiveView, name: str | None = None) -> str:
        """Show a view; return its address. `name` is the last part of the address, else a new one."""
        from .app import PageApp

        if self.closed:
            raise RuntimeError("expected a server that is open, got one that was closed")
        assert self._loop is not None
        key = (name or secrets.token_hex(4)).encode()
        app = PageApp(view, self._loop, lambda: self._forget(key))
        with self._lock:
            before = self._apps.get(key)
            self._apps[key] = app
        if before is not None:
            before.close()
        return f"{self.address}{key.decode()}/"

    def remove(self, view: LiveView) -> None:
        """Stop showing a view, which stays open; a view that is not shown is no error."""
        with self._lock:
            found = [key for key, app in self._apps.items() if app.view is view]
            apps = [self._apps.pop(key) for key in found]
        for app in apps:
            app.close()

    @property
    def views(self) -> list[LiveView]:
        """The views that are shown."""
        with self._lock:
            return [app.view for app in self._apps.values()]

    def _forget(self, key: bytes) -> None:
        with self._lock:
            self._apps.pop(key, None)

    # ----- life

    @property
    def closed(self) -> bool:
        """Whether the server has ended."""
        return self._closed.is_set()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait until the server is closed, or that long; return whether it is closed."""
        return self._closed.wait(seconds)

    def close(self) -> None:
        """Disconnect all browsers and end the server; nothing is left, no thread and no socket."""
        with self._lock:
            apps = list(self._apps.values())
            self._apps.clear()
        for app in apps:
            app.close()
        if self._server is not None:
            self._server.should_exit = True
        if threading.current_thread() is not self._thread:
            self._thread.join()
        self._closed.set()

    def __enter__(self) -> PageServer:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # ----- in the thread

    def _run(self) -> None:
        try:
            asyncio.run(self._main())
        except BaseException as error:  # the thread that waits for the start raises it
            self._error = error
        finally:
            with contextlib.suppress(OSError):
                self._socket.close()
            self._started.set()
            self._closed.set()

    async def _main(self) -> None:
        import uvicorn

        config = uvicorn.Config(
            self._access,
            http="h11",
            ws="websockets-sansio",
            ws_max_size=64 * 1024,
            ws_per_message_deflate=False,  # the pictures are compressed
            lifespan="off",
            log_config=None,
            log_level="critical",  # addresses hold the token: they are written nowhere
            access_log=False,
            proxy_headers=False,
            server_header=False,
            date_header=False,
            timeout_graceful_shutdown=2,
        )
        self._loop = asyncio.get_running_loop()
        self._server = uvicorn.Server(config)
        self._loop.call_soon(self._started.set)
        await self._server.serve(sockets=[self._socket])

    async def _serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand a request that `Access` has let through to the view that its address names."""
        key, *rest = scope["cubecam.path"] or [b""]
        app = self._apps.get(key)
        if app is None or len(rest) > 1:
            await refuse(scope, receive, send, 404)
        elif scope["type"] == "websocket":
            await (app.canvas if rest == [b""] else refuse)(scope, receive, send)
        elif not rest:
            location = f"/{self._token}/{key.decode()}/".encode()
            await answer(scope, send, 308, headers=[(b"location", location)])
        else:
            resource = resources().get(rest[0])
            if resource is None:
                await refuse(scope, receive, send, 404)
            else:
                await answer(scope, send, 200, resource.body, resource.content_type)


def _listening(host: str, port: int) -> socket.socket:
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    except (socket.gaierror, OverflowError, UnicodeError) as error:
        raise OSError(
            f"host: expected an address of this machine, got {host!r}: {error}"
        ) from error
    family, _, _, _, place = found[0]
    try:
        made = socket.create_server(place[:2], family=family, backlog=128)
    except OSError as error:
        raise OSError(f"cannot listen on {host}, port {port}: {error.strerror or error}") from error
    # Its connections inherit this. asyncio sets it only for sockets made with the number of TCP. Without it a frame,
    # which is two messages, waits until the other side has confirmed the first: 40 ms.
    made.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return made


def _names(host: str) -> list[str]:
    """List the names under which a browser may reach a server on this address, the best one first."""
    if host in _LOCAL:
        return list(dict.fromkeys((host, *_LOCAL)))
    if host not in _ANY:
        return [host]
    own = socket.gethostname()
    names = [own, socket.getfqdn()]
    with contextlib.suppress(OSError):
        names += [str(entry[4][0]).partition("%")[0] for entry in socket.getaddrinfo(own, None)]
    # The address that leads outwards; connecting a datagram socket sends nothing.
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.connect(("192.0.2.1", 9))
        names.insert(0, str(probe.getsockname()[0]))
    return list(dict.fromkeys((*names, *_LOCAL)))


def _in_address(host: str) -> str:
    return f"[{host}]" if ":" in host else host
