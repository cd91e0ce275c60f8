"""`cubecam view`: explore a model, a cubemap, a panorama or a script's scene, which are read again when written."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .common import (
    FILE,
    WholeNumber,
    complain,
    describe,
    failures_reported,
    parse_place,
    place_options,
)
from .help import Command, argument, option

if TYPE_CHECKING:
    from ..viewer.live import LiveView
    from .view_source import Shown

_LOOK = 0.3  # seconds between two looks at the file
_PAGE = "Options for a page"


@click.command(cls=Command)
@argument(
    "path",
    type=FILE,
    metavar="FILE",
    help="A model (GLB, glTF, OBJ, PLY, STL, OFF), a cubemap (for six files, a name with {face}), a panorama, or a "
    "Python script that makes `scene` and, if it likes, `camera`, or `view`.",
)
@place_options()
@option(
    "--host",
    metavar="ADDRESS",
    default="127.0.0.1",
    group=_PAGE,
    help="The address to listen on; another one needs --password.",
)
@option(
    "--port", type=WholeNumber(0), metavar="NUMBER", default=0, group=_PAGE, help="The port.",
    note="a free one",
)  # fmt: skip
@option(
    "--password",
    metavar="WORD",
    envvar="CUBECAM_PASSWORD",
    group=_PAGE,
    help="What a visitor has to write first; better in CUBECAM_PASSWORD, since other users see options.",
)
def view(
    path: str,
    page: bool,
    window: bool,
    terminal: bool,
    no_browser: bool,
    host: str,
    port: int,
    password: str | None,
) -> None:
    """Explore a file: turn it, walk in it, change it. Ctrl-C ends it.

    The picture follows the file: write it again, and the new contents are shown. While the file is broken the old
    contents stay, and the line below the picture says what is wrong.
    """
    where = parse_place(page, window, terminal)
    if where != "page" and (host != "127.0.0.1" or port or password is not None):
        raise click.BadParameter("--host, --port and --password: expected with --page only")
    if port > 65535:
        raise click.BadParameter(f"expected at most 65535, got {port}", param_hint="--port")
    with failures_reported(), _interruptible():
        try:
            _check_extras(where)
            watched = _Watched(path)
            if where == "page":
                _show_page(watched, host, port, password, not no_browser)
            else:
                _show_elsewhere(watched, where)
        except ImportError as error:
            complain(describe(error))
            raise SystemExit(1) from error


def _check_extras(where: str) -> None:
    """Miss a package before a large file is read."""
    from ..viewer.canvases import needs, needs_page

    if where == "page":
        needs_page()
    else:
        needs("rendercanvas", "viewer")


def _show_page(
    watched: _Watched, host: str, port: int, password: str | None, browser: bool
) -> None:
    from ..viewer.page.browser import open_browser
    from ..viewer.page.server import PageServer

    with contextlib.ExitStack() as stack:
        stack.callback(watched.close)
        server = stack.enter_context(PageServer(host, port, password=password))
        url = server.add(watched.view, "view")
        watched.on_new_view = lambda new: server.add(new, "view")
        click.echo(url)
        if browser:
            stack.enter_context(open_browser(url))
        while not server.wait(_LOOK) and not watched.view.closed:
            watched.look()


def _show_elsewhere(watched: _Watched, where: str) -> None:
    """Show a window or the terminal, which run a loop of their own: a thread looks at the file."""
    ended = threading.Event()

    def look() -> None:
        while not ended.wait(_LOOK):
            watched.look()

    thread = threading.Thread(target=look, name="cubecam file", daemon=True)
    thread.start()
    try:
        watched.view.show(where, block=True)
    finally:
        ended.set()
        thread.join()
        watched.close()


class _Watched:
    """The view of a file, and its contents as they were read last."""

    def __init__(self, path: str) -> None:
        from .view_source import read, stamp

        self.path = path
        self.on_new_view: Callable[[LiveView], Any] | None = None
        self._stamp = stamp(path)
        self._shown: Shown = read(path)
        self._stamp = stamp(path, self._shown)
        self.view: LiveView = self._shown.as_view(Path(path).name)

    def look(self) -> None:
        """Read the file again if it was written; the line below the picture reports an error in it."""
        from .view_source import FAILURES, read, stamp

        now = stamp(self.path, self._shown)
        if now == self._stamp:
            return
        self._stamp = now
        try:
            shown = read(self.path)
            self._show(shown)
            self._stamp = stamp(self.path, shown)
        except FAILURES as error:
            text = describe(error)
            self.view.text = text if self.path in text else f"{self.path}: {text}"

    def _show(self, shown: Shown) -> None:
        """Put the new scene into the view; the camera stays where it was moved to, unless the file places it anew."""
        before, self._shown = self._shown, shown
        if shown.cube is not None and before.cube is not None:
            cube_view: Any = self.view
            cube_view.cube = shown.cube
            cube_view.text = shown.told
            return
        if shown.scene is None or before.scene is None:
            if self.on_new_view is None:
                raise ValueError(
                    "expected a scene: a view that a script makes is replaced on a page only"
                )
            old, self.view = self.view, shown.as_view(Path(self.path).name)
            self.on_new_view(self.view)
            old.close()
            return
        view: Any = self.view
        with view._lock:
            if shown.placed != before.placed and shown.camera is not None:
                view.camera = shown.camera
            view.scene = shown.scene
        view.changed()
        view._tell("panel", None)
        view.text = shown.told or "read again"

    def close(self) -> None:
        """Close the view."""
        self.view.close()


@contextlib.contextmanager
def _interruptible() -> Iterator[None]:
    """End with success at Ctrl-C: that is how a person ends a view."""
    try:
        yield
    except KeyboardInterrupt:
        click.echo()
