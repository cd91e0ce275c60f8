"""How far a scene's environment is turned about the world's +Y axis, as one number."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .._core import Scene, axis_angle

__all__ = ["EnvironmentTurn"]

_UP = (0, 1, 0)


class EnvironmentTurn:
    """The part of `Scene.environment_rotation` that turns about +Y.

    The turn is counter-clockwise for someone who looks down from +Y: at 90, what was at +Z is at +X. An environment
    that a program has tilted stays tilted.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.environment import EnvironmentTurn
    >>> scene = cc.Scene()
    >>> turn = EnvironmentTurn(scene)
    >>> turn.degrees = 30
    >>> scene.environment_rotation.round(3).tolist()  # cc.axis_angle((0, 1, 0), 30)
    [0.966, 0.0, 0.259, 0.0]
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    @property
    def degrees(self) -> float:
        """float: the turn about +Y in degrees, from -180 to 180.

        A background that is the environment's own cube becomes None when the turn is set: None shows the environment
        as it is turned.
        """
        w, _, y, _ = self._scene.environment_rotation
        angle = float(np.degrees(2 * np.arctan2(y, w)))
        return angle - 360 if angle > 180 else angle + 360 if angle < -180 else angle

    @degrees.setter
    def degrees(self, value: float) -> None:
        # The rotation is a tilt and then this turn ("swing" and "twist").
        back = axis_angle(_UP, -self.degrees)
        tilt = _product(back, self._scene.environment_rotation)
        self._scene.environment_rotation = _product(axis_angle(_UP, value), tilt)
        if self._scene.background is not None and self._scene.background is self._scene.environment:
            self._scene.background = None


def _product(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Multiply two quaternions (w, x, y, z): the rotation `b`, then the rotation `a`."""
    w = a[0] * b[0] - np.dot(a[1:], b[1:])
    return np.concatenate([[w], a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])])
