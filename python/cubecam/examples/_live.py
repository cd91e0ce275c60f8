"""The live forms of the programs: the mouse and the keys of the documents, and their animation.

Documents 000 and 001 add up the drags in two angles of degrees, angleX and angleY, and print where these go, but not
by how much a drag changes them. Here it is as in RotateObject.js of the WebGL Programming Guide, from which the
programs have their matrices: 100 degrees for the height of the picture, angleX to the right, angleY downwards.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeAlias

import numpy as np

import cubecam as cc
from cubecam.viewer.controls import Controls, Orbit

from ._script import DRAG, Script, events

if TYPE_CHECKING:
    import numpy.typing as npt

    from cubecam.viewer import Viewer
    from cubecam.viewer.controls import AnyCamera
    from cubecam.viewer.picking import Pick

    from ._common import Picture

#: World units, one press of w or s.
STEP = 0.1
#: Frames a second of an animation, as in the files of `cubecam example`.
RATE = 25.0
#: Frames a second of requestAnimationFrame on most screens, in which document 000 counts.
SCREEN = 60.0

#: Draws a picture uint8 (H, W, 4) with a renderer, at a size (width, height), with a number of samples a pixel.
Drawing: TypeAlias = Callable[[cc.Renderer, tuple[int, int], int], "Picture"]
Direction: TypeAlias = tuple[float, float, float]
#: For each key what it does, and how the help names it.
Keys: TypeAlias = Mapping[str, tuple[Callable[[], object], str]]


class Program(Protocol):
    """What every program has."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera


class Drags(Controls):
    """The documents' mouse: `turn` gets the sums of all drags, angleX and angleY in degrees."""

    help = "drag  turn"

    def __init__(
        self, turn: Callable[[float, float], object], start: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        super().__init__()
        self.turn = turn
        self.angle_x, self.angle_y = start

    def play(self, script: Script) -> None:
        """Answer the events of a script, one after another, as if a hand made them."""
        for event in events(script):
            if isinstance(event, str):
                self._walk_by(event)
            else:
                self._add(*event)

    def _drag(
        self, camera: AnyCamera, dx: float, dy: float, height: float, button: int, shift: bool
    ) -> bool:
        self._add(DRAG * dx / height, DRAG * dy / height)
        return True

    def _add(self, angle_x: float, angle_y: float) -> None:
        self.angle_x += angle_x
        self.angle_y += angle_y
        self.turn(self.angle_x, self.angle_y)

    def _walk_by(self, key: str) -> None:
        raise ValueError(f'script: expected drags only, since nobody walks here; got "{key}"')


class Visitor(Drags):
    """Mouse and keys of P2, for a camera whose present view is that before any drag."""

    help = "drag  turn the view\nw s  walk"
    keys: ClassVar = {"w": (1, 0, 0), "s": (-1, 0, 0)}

    def __init__(self, camera: cc.PerspectiveCamera) -> None:
        assert camera.target is not None
        gaze = camera.target - camera.position
        x, y, z = (gaze / math.hypot(*gaze)).tolist()
        super().__init__(lambda a, b: look(camera, direction(a, b, first=(x, y, z))))
        self.step = STEP
        self._camera = camera

    def _walk_by(self, key: str) -> None:
        self._camera.walk(STEP if key == "w" else -STEP)


def visitor(
    camera: cc.PerspectiveCamera, angles: tuple[float, float], script: Script, height: float
) -> Visitor:
    """Return mouse and keys after a drag by two angles, in degrees, and after a script.

    height : of the picture in which the script's pixels are counted.
    """
    controls = Visitor(camera)
    controls.play((angles, *events(script, height)))
    return controls


class Followed(Orbit):
    """Orbit control that calls `follow` after each move of the camera."""

    def __init__(self, follow: Callable[[], object]) -> None:
        super().__init__()
        self.follow = follow

    def handle(self, event: dict[str, Any], camera: AnyCamera, size: tuple[float, float]) -> bool:
        """Answer an event, and let the program follow the camera."""
        moved = super().handle(event, camera, size)
        if moved:
            self.follow()
        return moved


def direction(angle_x: float, angle_y: float, first: Direction = (0.0, 0.0, 1.0)) -> Direction:
    """Return Rx(angle_y) Ry(angle_x) first, angles in degrees."""
    x, y = math.radians(angle_x), math.radians(angle_y)
    side = math.cos(x) * first[0] + math.sin(x) * first[2]
    depth = math.cos(x) * first[2] - math.sin(x) * first[0]
    return (
        side,
        math.cos(y) * first[1] - math.sin(y) * depth,
        math.sin(y) * first[1] + math.cos(y) * depth,
    )


def look(camera: cc.PerspectiveCamera, view: Direction) -> None:
    """Turn the view. Straight up and straight down there is no view with +Y up; the last view stays."""
    if math.hypot(view[0], view[2]) > 1e-6:
        camera.look(view)


@functools.cache
def _drawn_viewer() -> type:
    """Make the viewer whose pictures a function draws; `cubecam.Viewer` is loaded with it, at the first use."""

    class Drawn(cc.Viewer):
        """A viewer of a program that makes its picture of several parts."""

        def __init__(
            self, drawing: Drawing, cells: tuple[int, int], *arguments: Any, **options: Any
        ) -> None:
            self._drawing, self._cells = drawing, cells
            super().__init__(*arguments, **options)

        def _picture(self, size: tuple[int, int], moving: bool) -> npt.NDArray[np.uint8]:
            if self.output != "color":
                return super()._picture(size, moving)
            return np.asarray(self._drawing(self.renderer, size, 1 if moving else self.samples))

        def pick(
            self, x: float, y: float, *, size: tuple[float, float] | None = None
        ) -> Pick | None:
            """Find what a pixel shows, in whichever of the pictures it is."""
            width, height = self.size if size is None else size
            if self.output != "color" or not (0 <= x < width and 0 <= y < height):
                return super().pick(x, y, size=(width, height))
            width, height = width / self._cells[0], height / self._cells[1]
            return super().pick(x % width, y % height, size=(width, height))

    return Drawn


class Clock:
    """An animation: `place` gets the number of the frame, of any fraction, and how many frames passed since the last.

    The clock can stand still; it goes on where it stopped.
    """

    def __init__(self, place: Callable[[float, float], object], rate: float = RATE) -> None:
        self.place = place
        self.rate = rate
        self.frame = self._start = 0.0
        self.running = False

    def tick(self, seconds: float) -> None:
        """Place everything as it is so many seconds after the clock was started."""
        before, self.frame = self.frame, self._start + self.rate * seconds
        self.place(self.frame, self.frame - before)

    def toggle(self, viewer: Viewer) -> None:
        """Start, or stop."""
        self._start = self.frame
        self.running = not self.running
        viewer.animate(self.tick if self.running else None)


def live_view(
    program: Program,
    size: tuple[int, int],
    title: str,
    renderer: cc.Renderer | None = None,
    *,
    controls: Controls | None = None,
    clock: Clock | None = None,
    keys: Keys | None = None,
    screen: bool = False,
    draw: Drawing | None = None,
    cells: tuple[int, int] = (1, 1),
) -> Viewer:
    """Make the live form of a program.

    controls : the document's mouse; without, a drag moves the camera round its target. clock : the animation, which the
    space bar stops. keys : what other keys do. screen : whether light is made for a screen (tone curve and sRGB);
    without, the numbers of a picture are shown unchanged, as `draw` of the module does it. draw : what draws the
    pictures, if these are not just the scene as the camera sees it. cells : the columns and rows of such a picture that
    shows the scene several times.
    """
    controls = controls or Orbit()
    make: Any = cc.Viewer if draw is None else functools.partial(_drawn_viewer(), draw, cells)
    viewer: Viewer = make(
        program.scene,
        program.camera,
        controls,
        size=size,
        title=title,
        renderer=renderer,
        tonemap="neutral" if screen else None,
        encode="srgb" if screen else None,
    )
    actions = dict(keys or {})
    if clock is not None:
        clock.place(0.0, 0.0)
        clock.toggle(viewer)
        actions[" "] = (lambda: clock.toggle(viewer), "stop and go on")
    for key, (_, words) in actions.items():
        controls.help += f"\n{'space' if key == ' ' else key}  {words}"

    def press(event: dict[str, Any]) -> None:
        action = actions.get(event.get("key", ""))
        if action is not None:
            action[0]()
            viewer.changed()

    viewer.add_event_handler(press, "key_down")
    return viewer
