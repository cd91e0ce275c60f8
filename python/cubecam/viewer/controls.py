"""Controls: what the mouse, the fingers and the keys do to a camera.

All angles are degrees, all distances world units. A controller answers events of rendercanvas and returns whether the
camera changed. Distances of the pointer are taken relative to the height of the picture, so that a drag does the same
on every screen.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from .. import navigation
from .._checks import one_of
from .._core import OrthographicCamera

if TYPE_CHECKING:
    from .._core import PerspectiveCamera

    AnyCamera: TypeAlias = PerspectiveCamera | OrthographicCamera

__all__ = ["CONTROLS", "Controls", "FirstPerson", "Fly", "Orbit", "make_controls"]

#: Degrees that a drag over the whole height of the picture turns the scene in orbit control.
ORBIT_TURN = 360.0
#: Pixels of a wheel's delta that double the distance. A notch of most mice is 100.
WHEEL_DOUBLE = 600.0
#: World units of a step (document 001: "w" and "s" walk 0.1).
STEP = 0.1
_HOLD, _REPEAT = 0.3, 0.05  # seconds until a held key repeats, and between two steps

LEFT, RIGHT, MIDDLE = 1, 2, 3


class Controls:
    """The base: keeps the pointer, counts fingers, repeats held keys."""

    help = ""
    #: What keys do while they are held: (walk, strafe, rise) in steps.
    keys: ClassVar[dict[str, tuple[float, float, float]]] = {}

    def __init__(self) -> None:
        self.step = STEP
        self._pointer: tuple[float, float] | None = None
        self._button = 0
        self._touches: dict[Any, tuple[float, float]] = {}
        self._held: dict[str, float] = {}  # key: when it steps next
        self._fast = False

    def handle(self, event: dict[str, Any], camera: AnyCamera, size: tuple[float, float]) -> bool:
        """Answer an event; return whether the camera changed. `size` is the canvas in logical pixels."""
        kind = event["event_type"]
        if kind in ("pointer_down", "pointer_move", "pointer_up"):
            return self._point(kind, event, camera, size)
        if kind == "wheel":
            return self._wheel(camera, float(event.get("dy", 0.0)), size)
        if kind == "key_down":
            return self._press(event, camera)
        if kind == "key_up":
            self._held.pop(str(event.get("key", "")).lower(), None)
        return False

    def tick(self, now: float, camera: AnyCamera) -> bool:
        """Repeat the keys that are held; return whether the camera changed."""
        due = [key for key, at in self._held.items() if now >= at]
        for key in due:
            self._held[key] = now + _REPEAT
            self._go(camera, key)
        return bool(due)

    def let_go(self) -> None:
        """Forget pointers and keys, for example when the pointer leaves."""
        self._pointer, self._button = None, 0
        self._touches.clear()
        self._held.clear()

    # ----- for subclasses

    def _drag(
        self, camera: AnyCamera, dx: float, dy: float, height: float, button: int, shift: bool
    ) -> bool:
        raise NotImplementedError

    def _wheel(self, camera: AnyCamera, dy: float, size: tuple[float, float]) -> bool:
        return False

    def _pinch(self, camera: AnyCamera, ratio: float, dx: float, dy: float, height: float) -> bool:
        return False

    # ----- the pointer

    def _point(
        self, kind: str, event: dict[str, Any], camera: AnyCamera, size: tuple[float, float]
    ) -> bool:
        here = (float(event.get("x", 0.0)), float(event.get("y", 0.0)))
        touches = {
            key: (float(touch["x"]), float(touch["y"]))
            for key, touch in (event.get("touches") or {}).items()
        }
        if len(touches) >= 2 or len(self._touches) >= 2:
            return self._fingers(touches, camera, size[1])
        if kind == "pointer_down":
            self._button = self._button or int(event.get("button", LEFT)) or LEFT
            self._pointer = here
            return False
        before, button = self._pointer, self._button
        if kind == "pointer_up":
            self.let_go_of_pointer()
        elif event.get("buttons") == ():  # the button was let go outside
            self.let_go_of_pointer()
            return False
        else:
            self._pointer = here if before is not None else None
        if before is None or before == here:
            return False
        shift = "Shift" in (event.get("modifiers") or ())
        return self._drag(camera, here[0] - before[0], here[1] - before[1], size[1], button, shift)

    def let_go_of_pointer(self) -> None:
        """End a drag."""
        self._pointer, self._button = None, 0

    def _fingers(
        self, touches: dict[Any, tuple[float, float]], camera: AnyCamera, height: float
    ) -> bool:
        both = [key for key in touches if key in self._touches][:2]
        before = np.array([self._touches[key] for key in both])
        after = np.array([touches[key] for key in both])
        self._touches = touches if len(touches) >= 2 else {}
        self._pointer = None  # a finger that stays does not jump
        if len(both) < 2:
            return False
        was, now = (float(np.linalg.norm(pair[0] - pair[1])) for pair in (before, after))
        dx, dy = (after.mean(axis=0) - before.mean(axis=0)).tolist()
        ratio = was / now if was > 0 and now > 0 else 1.0
        return self._pinch(camera, ratio, dx, dy, height)

    # ----- keys

    def _press(self, event: dict[str, Any], camera: AnyCamera) -> bool:
        key = str(event.get("key", ""))
        name = key.lower() if len(key) == 1 else key
        modifiers = event.get("modifiers") or ()
        if key in ("Control", "Alt", "Meta"):  # for example Alt + Tab: keys end elsewhere
            self._held.clear()
        if name not in self.keys or any(m in modifiers for m in ("Control", "Alt", "Meta")):
            return False
        if name.lower() in self._held:  # the keyboard's own repetition
            return False
        self._fast = "Shift" in modifiers
        self._held[name.lower()] = time.monotonic() + _HOLD
        self._go(camera, name)
        return True

    def _go(self, camera: AnyCamera, key: str) -> None:
        steps = self.keys.get(key)
        if steps is None:
            steps = next(value for name, value in self.keys.items() if name.lower() == key)
        length = self.step * (5.0 if self._fast else 1.0)
        walk, strafe, rise = (length * step for step in steps)
        if walk:
            navigation.walk(camera, walk)
        if strafe:
            navigation.strafe(camera, strafe)
        if rise:
            standing = navigation.Standing(camera)
            standing.move(rise * standing.up)


class Orbit(Controls):
    """Turn the scene round a pivot, the camera's target, as in three.js' OrbitControls."""

    help = (
        "drag  turn\n"
        "right drag, shift drag, two fingers  move\n"
        "wheel, pinch  nearer, farther\n"
        "double click  set the pivot"
    )

    def _drag(
        self, camera: AnyCamera, dx: float, dy: float, height: float, button: int, shift: bool
    ) -> bool:
        if button in (RIGHT, MIDDLE) or shift:
            return _pan(camera, dx, dy, height)
        navigation.orbit(camera, yaw=ORBIT_TURN * dx / height, pitch=ORBIT_TURN * dy / height)
        return True

    def _wheel(self, camera: AnyCamera, dy: float, size: tuple[float, float]) -> bool:
        return _scale(camera, _zoom(dy))

    def _pinch(self, camera: AnyCamera, ratio: float, dx: float, dy: float, height: float) -> bool:
        moved = _pan(camera, dx, dy, height) if dx or dy else False
        return _scale(camera, ratio) or moved


class FirstPerson(Controls):
    """Stand in the scene: drag to look round, w and s walk, a and d step aside (document 001)."""

    help = (
        "drag  look round\n"
        "w s, arrows  walk\n"
        "a d, arrows  step aside\n"
        "shift  five times as fast\n"
        "wheel  field of view"
    )
    keys: ClassVar[dict[str, tuple[float, float, float]]] = {
        "w": (1, 0, 0),
        "s": (-1, 0, 0),
        "a": (0, -1, 0),
        "d": (0, 1, 0),
        "ArrowUp": (1, 0, 0),
        "ArrowDown": (-1, 0, 0),
        "ArrowLeft": (0, -1, 0),
        "ArrowRight": (0, 1, 0),
    }

    def _drag(
        self, camera: AnyCamera, dx: float, dy: float, height: float, button: int, shift: bool
    ) -> bool:
        # The point under the pointer follows the pointer, in the middle of the picture exactly.
        degrees = _field(camera)
        navigation.yaw(camera, degrees * dx / height)
        navigation.pitch(camera, degrees * dy / height)
        return True

    def _wheel(self, camera: AnyCamera, dy: float, size: tuple[float, float]) -> bool:
        if isinstance(camera, OrthographicCamera):
            return _scale(camera, _zoom(dy))
        camera.fov = min(max(camera.fov * _zoom(dy), 5.0), 140.0)
        return True

    def _pinch(self, camera: AnyCamera, ratio: float, dx: float, dy: float, height: float) -> bool:
        if isinstance(camera, OrthographicCamera):
            return _scale(camera, ratio)
        camera.fov = min(max(camera.fov * ratio, 5.0), 140.0)
        return True


class Fly(FirstPerson):
    """As first person, with e and q to rise and to sink."""

    help = FirstPerson.help + "\ne q  rise, sink"
    keys: ClassVar[dict[str, tuple[float, float, float]]] = {
        **FirstPerson.keys,
        "e": (0, 0, 1),
        "q": (0, 0, -1),
    }


#: The names that `Viewer(controls=)` accepts.
CONTROLS: dict[str, type[Controls]] = {"orbit": Orbit, "first_person": FirstPerson, "fly": Fly}


def make_controls(name: str | Controls) -> Controls:
    """Make the controls of a name; an object stays as it is."""
    if isinstance(name, Controls):
        return name
    return CONTROLS[one_of(name, "controls", CONTROLS)]()  # type: ignore[no-any-return]


# ----- the camera


def _zoom(dy: float) -> float:
    """Return the factor for a wheel's delta, limited to 20 doublings."""
    return float(2.0 ** min(max(dy / WHEEL_DOUBLE, -20.0), 20.0))


def _field(camera: AnyCamera) -> float:
    return 45.0 if isinstance(camera, OrthographicCamera) else float(camera.fov)


def _pan(camera: AnyCamera, dx: float, dy: float, height: float) -> bool:
    """Move camera and target so that what lies in the target's plane follows the pointer."""
    standing = navigation.Standing(camera)
    if isinstance(camera, OrthographicCamera):
        seen = float(camera.height)
    else:
        seen = 2.0 * standing.distance * math.tan(math.radians(camera.fov) / 2)
    right = standing.right
    up = np.cross(right, standing.direction)
    standing.move((-dx * right + dy * up) * (seen / height))
    return True


def _scale(camera: AnyCamera, factor: float) -> bool:
    """Multiply the distance to the target, or the height that a parallel view shows."""
    if factor == 1.0 or not math.isfinite(factor) or factor <= 0:
        return False
    if isinstance(camera, OrthographicCamera):
        camera.height = camera.height * factor
        return True
    standing = navigation.Standing(camera)
    if standing.target is None:
        return False
    nearest = min(1.01 * float(camera.near), standing.distance)
    distance = max(standing.distance * factor, nearest)
    standing.place(standing.target - standing.direction * distance, standing.target)
    return True
