"""A live view on one canvas of rendercanvas: which picture the canvas has, and which it needs."""

from __future__ import annotations

import contextlib
import time
import weakref
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import _newest_revision
from .quality import Quality

if TYPE_CHECKING:
    import numpy.typing as npt

    from .live import LiveView

__all__ = ["REST", "Shown"]

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
_JPEG, _PNG = 80, 100  # rendercanvas' words for how its canvases encode a picture


class DrawCancelled(Exception):
    """Tells rendercanvas that the last picture still stands."""


class Shown:
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
