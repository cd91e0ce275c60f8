"""The live forms of the programs: the mouse and the keys of the documents, and their animation.

Documents 000 and 001 add up the drags in two angles of degrees, angleX and angleY, and print where these go, but not
by how much a drag changes them. Here it is as in RotateObject.js of the WebGL Programming Guide, from which the
programs have their matrices: 100 degrees for the height of the picture, angleX to the right, angleY downwards.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, TypeAlias

if TYPE_CHECKING:
    import cubecam as cc

#: Degrees that a drag over the height of the picture adds to an angle.
DRAG = 100.0
#: Frames a second of an animation, as in the files of `cubecam example`.
RATE = 25.0
#: Frames a second of requestAnimationFrame on most screens, which is what the documents count frames by.
SCREEN = 60.0

#: What a key does, and how the help names it.
Keys: TypeAlias = Mapping[str, tuple[Callable[[], object], str]]


class Seen(Protocol):
    """What every program has."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera


@dataclass
class Hand:
    """The documents' mouse: `turn` gets the sums of all drags, angleX and angleY in degrees."""

    turn: Callable[[float, float], object]
    start: tuple[float, float] = (0.0, 0.0)
    help: str = "turn the view"
    keys: Keys = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.angle_x, self.angle_y = self.start

    def drag(self, dx: float, dy: float, height: float) -> None:
        """Add a drag of so many pixels, to the right and down, in a picture of that height."""
        self.angle_x += DRAG * dx / height
        self.angle_y += DRAG * dy / height
        self.turn(self.angle_x, self.angle_y)


@dataclass
class Clock:
    """An animation: `place` gets the number of the frame, of any fraction, and how many frames passed since the last.

    The clock can stand still; it goes on where it stopped.
    """

    place: Callable[[float, float], object]
    rate: float = RATE
    running: bool = True
    frame: float = 0.0
    _seconds: float = 0.0

    def tick(self, seconds: float) -> None:
        """Place everything as it is so many seconds after the animation began."""
        step = self.rate * (seconds - self._seconds) if self.running else 0.0
        self._seconds = seconds
        self.frame += step
        self.place(self.frame, step)

    def toggle(self) -> None:
        """Stop, or go on."""
        self.running = not self.running


def live_view(
    program: Seen,
    size: tuple[int, int],
    title: str,
    renderer: cc.Renderer | None = None,
    *,
    hand: Hand | None = None,
    clock: Clock | None = None,
    keys: Keys | None = None,
) -> Viewer:
    """Make the live form of a program.

    hand : the document's mouse; without one, a drag moves the camera round its target. clock : the animation, which the
    space bar stops. keys : what other keys do.
    """
    raise NotImplementedError
