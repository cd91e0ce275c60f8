"""What every live view does: when it draws, at which quality, what it hands on, and where it is shown.

A live view knows nothing of scenes. A subclass draws pictures (`_picture`) and answers events (`_handle`); canvases of
`rendercanvas` show the pictures. Nothing is drawn while nothing changes: one thread watches all views that are shown,
and compares the newest revision of this process (`core/revision.hpp`) with the one that was drawn.
"""

from __future__ import annotations

import contextlib
import logging
import math
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from .._calls import checked_call
from .._checks import pair, text_of
from .._core import _check_memory, _newest_revision
from ..io.files import PathLike
from .shown import REST, Shown
from .watcher import watch

if TYPE_CHECKING:
    import numpy.typing as npt

    from ..typing import Place
    from .panel import Section

__all__ = ["LiveView", "shown_at"]

Self = TypeVar("Self", bound="LiveView")

_LARGEST = 1 << 20  # pixels along a side
_PIXEL = 64.0  # bytes of a pixel while it is drawn: a direction, colours, and what is computed between them


class LiveView:
    """A picture that moves: the base of `Viewer` and of all other live views.

    Parameters
    ----------
    size : (int, int)
        The (width, height) in logical pixels of a canvas that has no size of its own.
    title : str
        The title of the page or of the window.

    Attributes
    ----------
    size, title
        As given.
    text : str
        The line below the picture, which says what is under the pointer.
    help : str
        What mouse and keys do.
    """

    def __init__(self, *, size: tuple[int, int] = (640, 480), title: str = "cubecam") -> None:
        self.size = size
        self.title = title
        self._text = ""
        self._reported: set[str] = set()
        self._closed = False
        self._lock = threading.RLock()  # a page draws in its server's thread
        self._canvases: list[Shown] = []
        self._listeners: list[Callable[[str, Any], object]] = []
        self._handlers: list[tuple[Callable[[dict[str, Any]], object], frozenset[str]]] = []
        self._animation: Callable[[float], object] | None = None
        self._began = 0.0
        self._moving_until = 0.0

    # ----- what a subclass gives

    def _picture(self, size: tuple[int, int], moving: bool) -> npt.NDArray[np.uint8]:
        """Draw uint8 (height, width, 4) at a size (width, height); `moving` asks for speed instead of quality."""
        raise NotImplementedError

    def _handle(self, event: dict[str, Any]) -> None:
        """Answer an event of rendercanvas; x and y are logical pixels from the top left corner."""

    def _tick(self, now: float) -> None:
        """Do what goes on while a key is held; called about 40 times a second while the view is shown."""

    def _release(self) -> None:
        """Give back what the view owns."""

    def panel(self) -> list[Section]:
        """Give the sections of what can be set, for `cubecam.viewer.panel`."""
        return []

    @property
    def help(self) -> str:
        """What mouse and keys do, one line each."""
        return "h  this list"

    # ----- state

    @property
    def size(self) -> tuple[int, int]:
        """The (width, height) in logical pixels of `draw`, and of canvases that are opened later."""
        return self._size

    @size.setter
    def size(self, value: tuple[int, int]) -> None:
        self._size = _checked_size(value)

    @property
    def text(self) -> str:
        """The line below the picture."""
        return self._text

    @text.setter
    def text(self, value: str) -> None:
        if not isinstance(value, str):
            raise TypeError(f"text: expected a str, got {text_of(value)}")
        if value != self._text:
            self._text = value
            self._tell("text", value)

    @property
    def closed(self) -> bool:
        """Whether `close` was called, or the window was closed."""
        return self._closed

    @property
    def moving(self) -> bool:
        """Whether pictures are drawn quickly now, because something moves."""
        return self._animation is not None or time.monotonic() < self._moving_until

    @checked_call
    def changed(self, moving: bool = True) -> None:
        """Draw soon, quickly; a picture of full quality follows as soon as nothing has changed for 0.1 seconds.

        Parameters
        ----------
        moving : bool
            False: draw in full quality at once.
        """
        self._moving_until = time.monotonic() + REST if moving else 0.0
        for shown in list(self._canvases):
            shown.request()

    def add_event_handler(
        self, function: Callable[[dict[str, Any]], object], *types: str
    ) -> Callable[[dict[str, Any]], object]:
        """Call a function with each event, before the view's own controls.

        Parameters
        ----------
        function : callable
            It gets the event, a dict as rendercanvas describes it: "event_type", "x", "y", "button", "key" and so on.
            If it returns True, the view's own controls do not see the event.
        *types : str
            The types of events, for example "pointer_down"; none for all.
        """
        _check_callable(function)
        self._handlers.append((function, frozenset(types)))
        return function

    def remove_event_handler(self, function: Callable[[dict[str, Any]], object]) -> None:
        """Forget a function of `add_event_handler`; one that is not known is no error."""
        self._handlers = [pair for pair in self._handlers if pair[0] != function]

    def add_listener(self, function: Callable[[str, Any], object]) -> None:
        """Call function(name, value) when "text", "panel" or "closed" changes; for canvases and panels."""
        _check_callable(function)
        self._listeners.append(function)

    def remove_listener(self, function: Callable[[str, Any], object]) -> None:
        """Forget a function of `add_listener`; one that is not known is no error."""
        with contextlib.suppress(ValueError):
            self._listeners.remove(function)

    def animate(self, function: Callable[[float], object] | None) -> None:
        """Move things: call a function before each picture, with the seconds since now. None ends the animation.

        If the function fails, the error is logged, the view's text shows it, and the animation ends.
        """
        if function is not None:
            _check_callable(function)
        self._began = time.monotonic()
        self._animation = function
        self.changed()

    # ----- pictures

    @checked_call
    def draw(self, size: tuple[int, int] | None = None) -> npt.NDArray[np.uint8]:
        """Draw in full quality now.

        Parameters
        ----------
        size : (int, int), optional
            (width, height) in pixels; the view's own size by default.

        Returns
        -------
        ndarray uint8 (height, width, 4)
        """
        with self._lock:
            self._check_open()
            return self._picture(self.size if size is None else _checked_size(size), False)

    @checked_call
    def snapshot(self, path: PathLike | None = None) -> npt.NDArray[np.uint8]:
        """Draw in full quality; with a path write the picture to that file, too.

        Parameters
        ----------
        path : str or os.PathLike, optional
            A name of a picture's file, as for `save_image`.

        Returns
        -------
        ndarray uint8 (height, width, 4)
        """
        picture = self.draw()
        if path is not None:
            from ..io.images import save_image

            save_image(path, picture)
        return picture

    @checked_call
    def record(self, path: PathLike, *, seconds: float = 4.0, fps: float = 25.0) -> None:
        """Write the animation to a film: the function of `animate` at equal steps of time, in full quality.

        Parameters
        ----------
        path : str or os.PathLike
            A name that ends in .mp4 (needs imageio-ffmpeg or the command ffmpeg), .png, .gif or .webp.
        seconds : float
            How long the film is.
        fps : float
            Frames a second.

        Raises
        ------
        ValueError
            For a length or a rate that is not above 0, or another extension.
        FileError
            If ffmpeg is missing or fails.
        """
        if not (0 < seconds < math.inf and 0 < fps < math.inf):
            raise ValueError(f"expected seconds and fps above 0, got {seconds} and {fps}")
        count = max(1, round(seconds * fps))

        def picture(index: int) -> npt.NDArray[np.uint8]:
            with (
                self._lock
            ):  # not while the film is written: a generator that fails would keep the lock
                if self._animation is not None:
                    self._animation(index / fps)
                drawn: npt.NDArray[np.uint8] = self.draw().copy()
                return drawn

        self._check_open()
        pictures = (picture(index) for index in range(count))

        if Path(path).suffix.lower() == ".mp4":
            from ..io.movie import save_mp4

            save_mp4(path, pictures, fps)
        else:
            from ..io.images import save_animation

            save_animation(path, pictures, fps=fps)
        self._began = time.monotonic()

    # ----- life

    @checked_call
    def show(
        self: Self,
        where: str | None = None,
        *,
        browser: bool = True,
        block: bool | None = None,
    ) -> Self:
        """Show the view and let the user explore it.

        Parameters
        ----------
        where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
            Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a
            page for a browser on this machine.
        browser : bool
            Whether a page is opened in the browser.
        block : bool, optional
            Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
            notebooks and in Python's prompt no.

        Returns
        -------
        LiveView
            The view itself.

        Raises
        ------
        ValueError
            For another name.
        ImportError
            If a package is missing; the message names the extra of cubecam that has it.
        """
        from .canvases import show

        self._check_open()
        show(self, where, browser=browser, block=block)
        return self

    def close(self) -> None:
        """Close canvases, panels and what the view owns; a second call does nothing."""
        if self._closed:
            return
        self._closed = True
        self._animation = None
        self._tell("closed", True)
        for shown in list(self._canvases):
            self._detach(shown.canvas)
            shown.canvas.close()
        self._handlers.clear()
        self._listeners.clear()
        with self._lock:
            self._release()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "closed" if self.closed else f"{self.size[0]} x {self.size[1]}"
        return f"<cubecam.{type(self).__name__} {self.title!r}: {state}>"

    def _check_open(self) -> None:
        if self._closed:
            raise RuntimeError(
                f"expected a {type(self).__name__} that is open, got one that was closed"
            )

    # ----- notebooks

    def _ipython_display_(self) -> None:
        from .notebook import display_view

        display_view(self)

    def _display_(self) -> Any:  # marimo's protocol
        from .notebook import notebook_canvas

        return notebook_canvas(self)

    # ----- canvases

    def _attach(self, canvas: Any) -> None:
        """Show the view on a canvas of rendercanvas, too."""
        self._check_open()
        shown = Shown(self, canvas)
        self._canvases.append(shown)
        shown.request()
        watch(self)

    def _detach(self, canvas: Any) -> None:
        """Forget a canvas; one that is not known is no error."""
        for shown in [one for one in self._canvases if one.canvas is canvas]:
            self._canvases.remove(shown)
            shown.forget()

    def _answer(self, event: dict[str, Any]) -> None:
        kind = event.get("event_type", "")
        for function, types in list(self._handlers):
            if (not types or kind in types) and function(event) is True:
                return
        if kind == "key_down" and event.get("key") == "h":
            self.text = "" if self.text == self._short_help() else self._short_help()
        self._handle(event)

    def _short_help(self) -> str:
        return "  |  ".join(" ".join(line.split()) for line in self.help.splitlines())

    def _tell(self, name: str, value: Any) -> None:
        for function in list(self._listeners):
            try:
                function(name, value)
            except Exception as error:  # the other listeners, and `close`, go on
                self._report(error)

    def _report(self, error: Exception) -> None:
        """Log an error, the same one only once, and show it as the view's text."""
        words = f"{type(error).__name__}: {error}"
        if words not in self._reported:
            self._reported.add(words)
            logging.getLogger("cubecam").error("%r: %s", self, words, exc_info=error)
            self.text = words

    def _animate_now(self) -> None:
        if self._animation is not None:
            try:
                self._animation(time.monotonic() - self._began)
            except Exception as error:
                self._animation = None
                self._report(error)

    def _watch(self) -> None:
        """Request what is due; called by the watching thread."""
        self._canvases_that_closed()
        now = time.monotonic()
        self._tick(now)
        newest = _newest_revision()
        for shown in list(self._canvases):
            shown.watch(newest, self.moving)

    def _canvases_that_closed(self) -> None:
        for shown in list(self._canvases):
            if shown.canvas.get_closed():
                self._detach(shown.canvas)
                if shown.only_one and not self._canvases:
                    self.close()


def _check_callable(function: object) -> None:
    if not callable(function):
        raise TypeError(f"function: expected a function, got {text_of(function)}")


def _checked_size(value: object) -> tuple[int, int]:
    """Give (width, height) of a picture that is no larger than a texture can be, and that the memory holds."""
    width, height = pair(value, "size")
    if not (1 <= width <= _LARGEST and 1 <= height <= _LARGEST):
        raise ValueError(
            f"size: expected a width and a height from 1 to {_LARGEST}, got {text_of(value)}"
        )
    _check_memory(_PIXEL * width * height, f"{width} x {height} pixels")
    return width, height


def shown_at(view: Self, where: Place | None, browser: bool, block: bool | None) -> Self:
    """Show a view that was made for this call; it is closed again if it cannot be shown."""
    try:
        return view.show(where, browser=browser, block=block)
    except BaseException:
        view.close()
        raise
