"""Where a live view is shown: the canvas of rendercanvas that serves it, and the extra of cubecam that has it."""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from .._checks import text_of

if TYPE_CHECKING:
    from .live import LiveView
    from .page.server import PageServer

__all__ = ["PLACES", "choose", "needs", "needs_page", "show"]

PLACES = ("notebook", "page", "window", "terminal", "offscreen")
#: Toolkits for windows, in the order in which they are tried; rendercanvas presents bitmaps to them.
_QT = ("PySide6", "PyQt6")


def needs(module: str, extra: str) -> Any:
    """Import a module that an extra of cubecam installs.

    Raises
    ------
    ImportError
        If it is missing; the message names the extra.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = error.name or module.split(".")[0]
        raise ImportError(
            f"expected the package {package}, which is not installed or cannot be loaded ({error}); "
            f'pip install "cubecam[{extra}]" installs it',
            name=package,
        ) from error


def needs_page() -> None:
    """Import what a page takes; ImportError names the extra, as in `needs`."""
    for package in ("rendercanvas", "uvicorn", "websockets"):
        needs(package, "viewer")


def choose() -> str:
    """Choose where a view is shown: notebook, window, terminal or page."""
    if in_notebook():
        return "notebook"
    screen = bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    if screen and any(importlib.util.find_spec(name) for name in _QT):
        return "window"
    if os.environ.get("SSH_CONNECTION") and sys.stdout is not None and sys.stdout.isatty():
        return "terminal"
    return "page"


def in_notebook() -> bool:
    """Whether this process is the kernel of a notebook."""
    return getattr(_shell(), "kernel", None) is not None


def interactive() -> bool:
    """Whether a person types at Python's prompt or in a notebook."""
    return _shell() is not None or hasattr(sys, "ps1") or bool(sys.flags.interactive)


def _shell() -> Any:
    """Return IPython's shell, or None; IPython itself is not imported."""
    ipython = sys.modules.get("IPython")
    return None if ipython is None else ipython.get_ipython()


def show(view: LiveView, where: str | None, *, browser: bool, block: bool | None) -> None:
    """Show a view at one of `PLACES`; None chooses."""
    place = choose() if where is None else where
    if place not in PLACES:
        raise ValueError(
            f"where: expected None or one of {', '.join(PLACES)}, got {text_of(where)}"
        )
    waits = not interactive() if block is None else block
    if place == "notebook":
        view._ipython_display_()
    elif place == "page":
        show_page(view, browser=browser, block=waits)
    else:
        _open(view, place, waits)


def show_page(view: LiveView, *, browser: bool = True, block: bool = True) -> str:
    """Show a view on a page of this process's server; print and return the address.

    All views of a process share one server, each at an address of its own. The server ends with the last view. With
    `block` the call ends with the view, or at Ctrl-C, which closes it.
    """
    server = _server()
    try:
        address = str(server.add(view))
        view.add_listener(lambda name, _: _end_if_empty() if name == "closed" else None)
        print(address, flush=True)
        if browser:
            threading.Thread(
                target=_open_browser, args=(address, view), name="cubecam browser", daemon=True
            ).start()
        while block and not view.closed and not server.wait(0.2):
            pass
    except KeyboardInterrupt:
        view.close()
    except BaseException:
        view.close()
        _end_if_empty()
        raise
    return address


_lock = threading.Lock()
_shared: PageServer | None = None


def _server() -> PageServer:
    """Give the server of this process; make one if there is none."""
    global _shared
    needs_page()
    from .page.server import PageServer

    with _lock:
        if _shared is None or _shared.closed:
            _shared = PageServer()
        return _shared


def _end_if_empty() -> None:
    """End the server when it shows nothing any more; from any thread, also from its own."""
    threading.Thread(target=_close_if_empty, name="cubecam page ends").start()


def _close_if_empty() -> None:
    global _shared
    with _lock:
        if _shared is not None and all(view.closed for view in _shared.views):
            _shared.close()
            _shared = None


def _open_browser(address: str, view: LiveView) -> None:
    from .page.browser import open_browser

    with open_browser(address):
        for _ in range(150):  # 30 s are enough for a slow browser to read the file
            if view.closed:
                return
            time.sleep(0.2)


def _open(view: LiveView, place: str, block: bool) -> None:
    module = _canvas_module(place)
    options = {} if place == "offscreen" else {"max_fps": 30}
    canvas = module.RenderCanvas(size=view.size, title=view.title, **options)
    canvas._cubecam_owns_view = place in ("window", "terminal")
    view._attach(canvas)
    if place == "window":
        view.add_listener(
            lambda name, value: canvas.set_title(_title(view, value)) if name == "text" else None
        )
    if place != "offscreen" and block:
        try:
            module.loop.run()
        except KeyboardInterrupt:
            pass
        finally:
            view.close()


def _title(view: LiveView, text: str) -> str:
    return f"{view.title}: {text}" if text else view.title


def _canvas_module(place: str) -> Any:
    if place == "window":
        needs("rendercanvas", "viewer")
        for name in _QT:
            if importlib.util.find_spec(name):
                return importlib.import_module(f"rendercanvas.{name.lower()}")
        if importlib.util.find_spec("glfw") and importlib.util.find_spec("wgpu"):
            return importlib.import_module("rendercanvas.glfw")
        raise ImportError(
            "expected PySide6, PyQt6, or glfw and wgpu for a window, found none of them; "
            'pip install "cubecam[window]" installs PySide6'
        )
    return needs(f"rendercanvas.{place}", "viewer")
