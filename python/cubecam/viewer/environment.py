"""A scene's environment, turned about the world's +Y axis."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._core import CubeMap, Scene
from ..plot._faces import TABLE

__all__ = ["EnvironmentTurn", "turned"]


@checked_call
def turned(cube: CubeMap, degrees: float) -> CubeMap:
    """Turn a cubemap about +Y, counter-clockwise for someone who looks down from +Y: at 90, what was at +Z is at +X.

    Each texel of the new cube is a bilinear lookup (`CubeMap.sample`) of the old one, so that a turn of 90 degrees only
    moves texels and any other turn smooths by less than a texel. A turn of 0 gives the cube itself.

    Parameters
    ----------
    cube : CubeMap
    degrees : float

    Returns
    -------
    CubeMap
        Of the same size, dtype, channels, encoding and mipmaps. Its outputs besides colour are left out.

    Raises
    ------
    ValueError
        If the angle is not finite.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> from cubecam.viewer.environment import turned
    >>> faces = np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1).repeat(2, 1).repeat(2, 2)
    >>> cube = turned(cc.CubeMap(faces), 90)
    >>> cube.sample([[1, 0, 0], [0, 1, 0]]).ravel().round(4)  # +X shows what was face 4, +Z
    array([4., 2.], dtype=float32)
    """
    if not np.isfinite(degrees):
        raise ValueError(f"degrees: expected a finite number, got {degrees}")
    angle = float(degrees) % 360
    if angle == 0:
        return cube
    size, old = cube.size, cube.faces
    values = cube.sample(_directions(size) @ _about_y(-angle).T)
    if old.dtype == np.uint8:
        values = np.round(values * 255)
    return CubeMap(values.astype(old.dtype), mipmaps=cube.mipmaps, encoding=cube.encoding)


def _directions(size: int) -> npt.NDArray[np.float64]:
    """Give the directions of all texel centers, (6, size, size, 3)."""
    centers = (np.arange(size) + 0.5) / size * 2 - 1
    tc, sc = np.meshgrid(centers, centers, indexing="ij")
    # A face's matrix is orthonormal: its transpose takes (sc, tc, ma) back to a direction.
    return np.asarray(np.einsum("fkx,ijk->fijx", TABLE, np.stack([sc, tc, np.ones_like(sc)], -1)))


def _about_y(degrees: float) -> npt.NDArray[np.float64]:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


class EnvironmentTurn:
    """How far a scene's environment is turned; the cube that was set first stays the source of every turn.

    A background that is the environment's own cube turns with it. An environment that a program sets counts as turned
    by 0 degrees.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.environment import EnvironmentTurn
    >>> scene = cc.Scene(environment=cc.load_environment(cc.sample_data("sunset.exr"), size=16))
    >>> first, turn = scene.environment, EnvironmentTurn(scene)
    >>> turn.degrees = 30
    >>> scene.environment == first
    False
    >>> turn.degrees = 0
    >>> scene.environment is first
    True
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._source = self._shown = scene.environment
        self._degrees = 0.0

    @property
    def degrees(self) -> float:
        """float: the turn about +Y in degrees; setting it replaces `Scene.environment`."""
        if self._scene.environment is not self._shown:
            self._source = self._shown = self._scene.environment
            self._degrees = 0.0
        return self._degrees

    @degrees.setter
    def degrees(self, value: float) -> None:
        if value == self.degrees or self._source is None:
            return
        cube = turned(self._source, value)
        with_background = self._scene.background is self._shown
        self._scene.environment = cube
        if with_background:
            self._scene.background = cube
        self._shown, self._degrees = cube, float(value)
