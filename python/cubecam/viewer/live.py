"""What every live view does: when it draws, at which quality, what it hands on, and where it is shown.

A live view knows nothing of scenes. A subclass draws pictures (`_picture`) and answers events (`_handle`); canvases of
`rendercanvas` show the pictures. Nothing is drawn while nothing changes: one thread watches all views that are shown,
and compares the newest revision of this process (`core/revision.hpp`) with the one that was drawn.
"""

from __future__ import annotations

import contextlib
import logging
import os
import threading
import time
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from .._core import _newest_revision
from ..io.files import PathLike
from .quality import Quality

if TYPE_CHECKING:
    import numpy.typing as npt

    from .panel import Section

__all__ = ["EVENTS", "LiveView"]

Self = TypeVar("Self", bound="LiveView")

#: The events of rendercanvas that a view answers.
EVENTS = (
    "pointer_down",
    "pointer_move",
    "pointer_up",
    "pointer_leave",
    "double_click",
    "wheel",
    "key_down",
    "key_up",
)
#: Seconds without a change after which a picture is drawn in full quality.
REST = 0.1
#: Seconds between two looks of the watching thread.
WATCH = 0.025
_JPEG, _PNG = 80, 100  # rendercanvas' words for how its canvases encode a picture


class DrawCancelled(Exception):
    """Tells rendercanvas that the last picture still stands."""


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
        self._canvases: list[_Shown] = []
        self._listeners: list[Callable[[str, Any], object]] = []
        self._handlers: list[tuple[Callable[[dict[str, Any]], object], frozenset[str]]] = []
        self._animation: Callable[[float], object] | None = None
        self._began = 0.0
        self._moving_until = 0.0
        self._on_show: list[Callable[[], object]] = []

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
        try:
            width, height = (int(side) for side in value)
        except (TypeError, ValueError, OverflowError):
            width = height = 0
        if width < 1 or height < 1:
            raise ValueError(f"size: expected two whole numbers above 0, got {value!r}")
        self._size = (width, height)

    @property
    def text(self) -> str:
        """The line below the picture."""
        return self._text

    @text.setter
    def text(self, value: str) -> None:
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
        self._handlers.append((function, frozenset(types)))
        return function

    def remove_event_handler(self, function: Callable[[dict[str, Any]], object]) -> None:
        """Forget a function of `add_event_handler`; one that is not known is no error."""
        self._handlers = [pair for pair in self._handlers if pair[0] != function]

    def add_listener(self, function: Callable[[str, Any], object]) -> None:
        """Call function(name, value) when "text", "panel" or "closed" changes; for canvases and panels."""
        self._listeners.append(function)

    def remove_listener(self, function: Callable[[str, Any], object]) -> None:
        """Forget a function of `add_listener`; one that is not known is no error."""
        with contextlib.suppress(ValueError):
            self._listeners.remove(function)

    def animate(self, function: Callable[[float], object] | None) -> None:
        """Move things: call a function before each picture, with the seconds since now. None ends the animation.

        If the function fails, the error is logged, the view's text shows it, and the animation ends.
        """
        self._began = time.monotonic()
        self._animation = function
        self.changed()

    # ----- pictures

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
            return self._picture(self.size if size is None else size, False)

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

    def record(self, path: PathLike, *, seconds: float = 4.0, fps: float = 25.0) -> None:
        """Write the animation to a film: the function of `animate` at equal steps of time, in full quality.

        Parameters
        ----------
        path : str or os.PathLike
            A name that ends in .mp4 (needs the command ffmpeg), .png, .gif or .webp.
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
        if not (seconds > 0 and fps > 0):
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
        shown = _Shown(self, canvas)
        self._canvases.append(shown)
        shown.request()
        _watcher.watch(self)

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


class _Shown:
    """A view on one canvas: which picture the canvas has, and which it needs."""

    def __init__(self, view: LiveView, canvas: Any) -> None:
        self.canvas = canvas
        #: Whether the view ends with this canvas: windows and terminals, which the user closes.
        self.only_one = bool(getattr(canvas, "_cubecam_owns_view", False))
        self._view = weakref.ref(view)
        self._context = canvas.get_bitmap_context()
        self._quality = Quality()
        self._revision = -1  # at the last picture
        self._quick: npt.NDArray[np.uint8] | None = (
            None  # the last quick picture, while it is up to date
        )
        self._still = False  # whether the canvas shows full quality
        self._pressed = 0.0  # when a button of the pointer went down
        self._told = True  # whether the view itself reported a change
        self._doubt_until = (
            0.0  # when to see whether full quality shows a change that the quick picture does not
        )
        self._last: npt.NDArray[np.uint8] | None = None  # the still picture that the canvas shows
        canvas.add_event_handler(self._answer, *EVENTS)
        canvas.request_draw(self._present)

    def forget(self) -> None:
        """Take the handlers off the canvas."""
        self._quick = self._last = None
        with contextlib.suppress(Exception):
            self.canvas.remove_event_handler(self._answer, *EVENTS)

    def request(self) -> None:
        """Draw soon, because the view reported a change."""
        self._told = True
        self.canvas.request_draw()

    def watch(self, newest: int, moving: bool) -> None:
        """Draw if something changed, or if the picture is a quick one and nothing moves any more."""
        view = self._view()
        if view is None:
            return
        if (
            newest != self._revision
            or view._animation is not None
            or (not self._still and not moving)
            or 0 < self._doubt_until < time.monotonic()
        ):
            self.canvas.request_draw()

    def _answer(self, event: dict[str, Any]) -> None:
        view = self._view()
        if view is None or view.closed or self._is_late(event):
            return
        with view._lock:
            if event.get("event_type", "").startswith("pointer") or "x" in event:
                event = {**event, "size": self.canvas.get_logical_size()}
            view._answer(event)

    def _is_late(self, event: dict[str, Any]) -> bool:
        """Whether a move is older than the press that came before it: rendercanvas holds moves back to unite them."""
        kind, at = event.get("event_type"), float(event.get("time_stamp", 0.0))
        if kind == "pointer_down":
            self._pressed = at
        return kind == "pointer_move" and at < self._pressed

    def _present(self) -> None:
        """Draw what the canvas needs now; called by rendercanvas."""
        view = self._view()
        if view is None or view.closed:
            raise DrawCancelled
        with view._lock:
            view._animate_now()
            width, height = (int(side) for side in self.canvas.get_physical_size())
            if width < 1 or height < 1:
                raise DrawCancelled
            told, self._told = self._told, False
            outside = not told and self._still and view._animation is None
            revision = _newest_revision()
            came_to_rest = not self._still
            doubt = 0 < self._doubt_until < time.monotonic() and revision == self._revision
            try:
                if view.moving or (outside and not doubt):
                    picture = self._quick_picture(view, (width, height), outside)
                else:
                    picture = self._still_picture(view, (width, height), told, revision)
            except DrawCancelled:
                raise
            except Exception as error:  # the next change draws again
                self._revision, self._still, self._doubt_until = _newest_revision(), True, 0.0
                view._report(error)
                raise DrawCancelled from error
            self._revision = revision
            self.canvas._quality = _PNG if self._still else _JPEG
            # Windows of rendercanvas read the memory of `picture.base`, which must be the picture itself.
            self._context.set_bitmap(picture if picture.base is None else picture.copy())
            if came_to_rest and self._still:
                view._tell("panel", None)  # what moved may have been set by a program

    def _quick_picture(
        self, view: LiveView, size: tuple[int, int], outside: bool
    ) -> npt.NDArray[np.uint8]:
        """Draw a small picture; cancel if it shows what the last one showed, which is not sent again."""
        with self._quality.measured(size) as reduced:
            picture = view._picture(reduced, True)
        known = self._quick
        if known is not None and np.array_equal(known, picture):
            self._revision = _newest_revision()
            if outside:
                self._doubt_until = time.monotonic() + REST
            raise DrawCancelled
        if outside:  # what changed elsewhere in the process is seen here
            view._moving_until = time.monotonic() + REST
        self._quick, self._still = picture.copy(), False
        return picture

    def _still_picture(
        self, view: LiveView, size: tuple[int, int], told: bool, revision: int
    ) -> npt.NDArray[np.uint8]:
        """Draw in full quality, and a small picture to compare later ones with; cancel if the canvas shows it."""
        doubt, self._doubt_until = self._doubt_until > 0, 0.0
        reduced = self._quality.reduced(size)
        known = self._quick
        same = known is not None and known.shape[1::-1] == reduced
        if told or doubt or not same or revision != self._revision:
            self._quick = view._picture(reduced, True).copy()
        picture = view._picture(size, False)
        if (
            self._still
            and not told
            and self._last is not None
            and np.array_equal(self._last, picture)
        ):
            self._revision = revision
            raise DrawCancelled
        self._still, self._last = True, picture.copy()
        return picture


class _Watcher:
    """One thread for all views that are shown; it ends when there are none."""

    def __init__(self) -> None:
        self._views: weakref.WeakSet[LiveView] = weakref.WeakSet()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None

    def watch(self, view: LiveView) -> None:
        with self._lock:
            self._views.add(view)
            if self._thread is None or not self._thread.is_alive():
                self._thread = threading.Thread(target=self._run, name="cubecam views", daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while True:
            time.sleep(WATCH)
            with self._lock:
                views = [view for view in self._views if not view.closed and view._canvases]
                if not views:
                    self._thread = None
                    return
            for view in views:
                try:
                    view._watch()
                except Exception as error:  # the other views go on
                    view._report(error)
            del view, views

    def after_fork(self) -> None:
        """Begin anew in a child process, which has no thread, and a lock that nobody opens."""
        self.__init__()  # type: ignore[misc]


_watcher = _Watcher()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_watcher.after_fork)
