"""Move a camera like a person who walks or flies through the scene: yaw, pitch, look, walk, strafe, orbit.

The functions take a `PerspectiveCamera` or an `OrthographicCamera`, and these have them as methods, too:
`camera.yaw(10)` is `yaw(camera, 10)`. They change the camera in place and return None. A function that
raises an error does not change the camera. Up is the camera's own `up`; the poles are the directions up and down.
Lengths and directions are those of the world, also for a camera with a `parent`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._checks import finite_number
from ._core import OrthographicCamera, PerspectiveCamera, _to_array

if TYPE_CHECKING:
    Vector: TypeAlias = npt.NDArray[np.float64]

__all__ = ["POLE_MARGIN", "look", "orbit", "pitch", "strafe", "walk", "yaw"]

#: Degrees that `pitch` and `orbit` stay away from straight up and straight down, where up loses its meaning.
POLE_MARGIN = 1.0


@checked_call
def yaw(camera: PerspectiveCamera | OrthographicCamera, degrees: float) -> None:
    """Turn the view to the left, round the camera's `up` through its position.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
    degrees : float
        Positive turns left: counter-clockwise seen from above.

    Raises
    ------
    ValueError
        For a number that is not finite.
    TypeError
        For a camera given by its matrices, or an angle that is not a number.

    Notes
    -----
    The position and the distance to the target stay. A camera without a target gets one at distance 1.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(position=(0, 1, 0), target=(0, 1, -2))
    >>> camera.yaw(30)
    >>> camera.target.round(3).tolist()
    [-1.0, 1.0, -1.732]
    """
    angle = math.radians(finite_number(degrees, "degrees"))
    if angle == 0:
        return
    standing = Standing(camera)
    standing.turn(_turned(standing.direction, standing.up, angle))


@checked_call
def pitch(camera: PerspectiveCamera | OrthographicCamera, degrees: float) -> None:
    """Turn the view up, round the camera's right.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
    degrees : float
        Positive looks up. The view stops 1 degree (`POLE_MARGIN`) before straight up and straight down; a view that
        is already nearer to a pole does not move towards it.

    Raises
    ------
    ValueError, TypeError
        As `yaw`.

    Notes
    -----
    The position and the distance to the target stay. A camera without a target gets one at distance 1.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(position=(0, 1, 0))
    >>> camera.pitch(30)
    >>> camera.target.round(3).tolist()
    [0.0, 1.5, -0.866]
    """
    change = finite_number(degrees, "degrees")
    if change == 0:
        return
    standing = Standing(camera)
    standing.turn(_raised(standing.direction, standing.up, change))


@checked_call
def walk(camera: PerspectiveCamera | OrthographicCamera, distance: float) -> None:
    """Move position and target along the view direction.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
    distance : float
        World units; negative walks backwards.

    Raises
    ------
    ValueError
        For a number that is not finite, or a step so long that position and target cannot be told apart.
    TypeError
        As `yaw`.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(position=(0, 0, 5), target=(0, 0, 0))
    >>> camera.walk(2)
    >>> camera.position.tolist(), camera.target.tolist()
    ([0.0, 0.0, 3.0], [0.0, 0.0, -2.0])
    """
    standing = Standing(camera)
    standing.move(finite_number(distance, "distance") * standing.direction)


@checked_call
def strafe(camera: PerspectiveCamera | OrthographicCamera, distance: float) -> None:
    """Move position and target to the right.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
    distance : float
        World units; negative moves left.

    Raises
    ------
    ValueError, TypeError
        As `walk`.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera()
    >>> camera.strafe(.5)
    >>> camera.position.tolist()
    [0.5, 0.0, 0.0]
    """
    standing = Standing(camera)
    standing.move(finite_number(distance, "distance") * standing.right)


@checked_call
def orbit(
    camera: PerspectiveCamera | OrthographicCamera, *, yaw: float = 0.0, pitch: float = 0.0
) -> None:
    """Move round the target, as if the viewer turned the scene by hand.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
        A camera with a target.
    yaw : float
        Degrees round `up`. Positive turns the scene to the right, like a drag to the right: the camera moves to its
        left.
    pitch : float
        Degrees of elevation. Positive tips the scene towards the viewer, like a drag downwards: the camera rises. It
        stops 1 degree (`POLE_MARGIN`) before straight above and straight below the target.

    Raises
    ------
    ValueError
        For a camera without a target, or a number that is not finite.
    TypeError
        As `yaw`.

    Notes
    -----
    The target and the distance to it stay.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
    >>> camera.orbit(yaw=30)
    >>> camera.position.round(3).tolist()
    [-2.0, 0.0, 3.464]
    """
    turn, rise = finite_number(yaw, "yaw"), finite_number(pitch, "pitch")
    standing = Standing(camera)
    if standing.target is None:
        raise ValueError("target: expected a camera with a target to orbit, got None")
    # From the target the camera lies opposite to the view.
    outward = -standing.direction
    if turn != 0:
        outward = _turned(outward, standing.up, -math.radians(turn))
    if rise != 0:
        outward = _raised(outward, standing.up, rise)
    if turn != 0 or rise != 0:
        standing.place(standing.target + standing.distance * outward, standing.target)


@checked_call
def look(camera: PerspectiveCamera | OrthographicCamera, direction: npt.ArrayLike) -> None:
    """Turn the view along a direction of the world.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
    direction : array_like (3,)
        World space, of any length but 0, not along `up`.

    Raises
    ------
    ValueError
        For a direction that is not three finite numbers, has length 0, or lies along `up`.
    TypeError
        For a camera given by its matrices, or a direction that is not a vector.

    Notes
    -----
    The new target lies in this direction, at the distance of the old target, or at distance 1 if there was none.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(position=(1, 0, 0))
    >>> camera.look((0, 0, 2))
    >>> camera.target.tolist()
    [1.0, 0.0, 1.0]
    """
    Standing(camera).turn(_direction(direction))


class Standing:
    """The position and the direction of a camera in the world, read once."""

    def __init__(self, camera: PerspectiveCamera | OrthographicCamera) -> None:
        if not isinstance(camera, (PerspectiveCamera, OrthographicCamera)):
            raise TypeError(
                "camera: expected a PerspectiveCamera or an OrthographicCamera, "
                f"got {type(camera).__name__}"
            )
        self.camera = camera
        self.position, self.target, up, ahead = camera._world_placement()
        self.up, self.direction = _unit(up), _unit(ahead)
        self.distance = 1.0 if self.target is None else float(_length(ahead))

    @property
    def right(self) -> Vector:
        """The direction to the right, of length 1."""
        return _unit(np.cross(self.direction, self.up))

    def turn(self, direction: Vector) -> None:
        """Set the target at the present distance in a direction of length 1."""
        self.place(self.position, self.position + self.distance * direction)

    def place(self, position: Vector, target: Vector | None) -> None:
        """Set position and target in the world, both or neither."""
        self.camera._place_in_world(position, target)

    def move(self, offset: Vector) -> None:
        """Move position and target by the same offset, both or neither."""
        if offset.any():
            target = None if self.target is None else self.target + offset
            self.place(self.position + offset, target)


def _turned(vector: Vector, axis: Vector, radians: float) -> Vector:
    """Rotate round an axis of length 1; counter-clockwise if the axis points at the viewer (Rodrigues)."""
    cos, sin = math.cos(radians), math.sin(radians)
    along = axis * float(axis @ vector)
    turned: Vector = along + cos * (vector - along) + sin * np.cross(axis, vector)
    return turned


def _raised(direction: Vector, up: Vector, degrees: float) -> Vector:
    """Turn a direction of length 1 towards up, in the plane of both, and keep it off the poles."""
    sine = float(direction @ up)
    level = direction - sine * up
    elevation = math.degrees(math.atan2(sine, float(_length(level))))
    # A direction that is nearer to a pole than the margin may stay or move away from the pole.
    limit = max(90.0 - POLE_MARGIN, abs(elevation))
    wanted = math.radians(min(max(elevation + degrees, -limit), limit))
    raised: Vector = math.cos(wanted) * _unit(level) + math.sin(wanted) * up
    return raised


def _length(vector: Vector) -> float:
    """Return the length, also for numbers near the limits of double."""
    return math.hypot(*vector)


def _unit(vector: Vector) -> Vector:
    # The division by the maximum comes first: the length of great numbers overflows, that of tiny ones loses digits.
    scaled = vector / np.abs(vector).max()
    unit: Vector = scaled / _length(scaled)
    return unit


def _direction(value: Any) -> Vector:
    given = _to_array(value, "direction")
    if given.dtype.kind not in "iuf":
        raise TypeError(f"direction: expected three numbers, got {given.dtype}")
    vector = given.astype(np.float64)
    if vector.shape != (3,):
        raise ValueError(f"direction: expected three numbers, got shape {vector.shape}")
    if not np.isfinite(vector).all():
        raise ValueError(f"direction: expected finite numbers, got {tuple(vector.tolist())}")
    if not vector.any():
        raise ValueError("direction: expected a vector of a length other than 0, got (0, 0, 0)")
    return _unit(vector)
