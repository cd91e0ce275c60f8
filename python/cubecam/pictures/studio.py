"""Thumbnails of meshes, materials and scenes, drawn by one renderer of the process.

The renderer is made at the first thumbnail and closed when the process ends. Every thumbnail has a scene of its own,
which is gone after the call: nothing here keeps a user's object alive, and no user's object is changed. A picture that
cannot be drawn is a reason in words, never an exception.
"""

from __future__ import annotations

import atexit
import functools
import os
import threading
from typing import TYPE_CHECKING, Literal

import numpy as np

from .._core import (
    AmbientLight,
    BasicMaterial,
    CubeMap,
    DirectionalLight,
    Image,
    Material,
    Mesh,
    PerspectiveCamera,
    PhongMaterial,
    Probe,
    Renderer,
    Scene,
)
from ..io.pixels import srgb_decode
from .cards import Shot, shorten

if TYPE_CHECKING:
    import numpy.typing as npt

    from ..typing import Tonemap

__all__ = ["BALL", "draw_ball", "draw_mesh", "draw_scene", "draw_solid"]

#: Width and height of the thumbnail of a material or a mesh, pixels.
BALL = 96
_SAMPLES = 4
# More triangles would take a software renderer longer than a reader waits for a repr.
_MOST_TRIANGLES = 2_000_000
# Probes of more texels than this (6 faces of 512 x 512, twice) would stay in the memory of the process's renderer.
_MOST_KEPT = 6 * 512 * 512 * 2
# A stencil material needs a stencil buffer; no thumbnail needs more depth.
_DEPTH: Literal["depth24_stencil8"] = "depth24_stencil8"


class _Studio:
    """The renderer of the process: made when it is first needed, made anew in a forked child."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._renderer: Renderer | None = None
        self._problem = ""

    def renderer(self) -> Renderer:
        """Give the renderer.

        Raises
        ------
        RuntimeError
            If there is no OpenGL. The first attempt decides: another one would take as long to fail.
        """
        with self._lock:
            if self._problem:
                raise RuntimeError(self._problem)
            if self._renderer is None:
                try:
                    self._renderer = Renderer()
                except Exception as error:
                    self._problem = shorten(error)
                    raise
            return self._renderer

    def close(self) -> None:
        """Close the renderer at the end of the process."""
        with self._lock:
            if self._renderer is not None:
                self._renderer.close()
            self._renderer, self._problem = None, "the process ends"

    def forget(self) -> None:
        """Start again in a forked child, where another thread's lock would stay locked for ever."""
        self.__init__()  # type: ignore[misc]


_studio = _Studio()
atexit.register(_studio.close)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_studio.forget)


def draw_ball(material: Material, size: int = BALL) -> Shot:
    """Draw a ball of the material in a small studio, before a chequered wall."""
    return draw_solid(_ball(), material, size)


def draw_mesh(mesh: Mesh) -> Shot:
    """Draw a mesh as of clay, or in the colours of its vertices, from above and from one side."""
    colored = mesh.colors is not None
    clay = PhongMaterial(
        color=(0.85, 0.85, 0.85) if colored else (0.36, 0.46, 0.6),
        vertex_colors=colored,
        ks=0.15,
        double_sided=True,
        flat_shading=mesh.normals is None,
    )
    return draw_solid(mesh, clay)


def draw_solid(mesh: Mesh, material: Material, size: int = BALL) -> Shot:
    """Draw a mesh with a material in the studio; (size, size, 4)."""
    try:
        _check_triangles(len(mesh.indices))
        low, high = mesh.bounds
        scene = Scene()
        unlit = isinstance(material, BasicMaterial)
        if not unlit:
            scene.environment = _surroundings()
            for light in _lamps():
                scene.add(light)
        radius = float(np.linalg.norm(high - low)) / 2 or 1.0
        node = scene.add(mesh, material, scale=0.5 / radius if mesh is not _ball() else None)
        node.position = -node.world_bounds.mean(axis=0)
        camera = PerspectiveCamera(fov=28, position=(0, 0.45, 2.11), target=(0, 0, 0))
        if mesh is not _ball():
            camera = PerspectiveCamera(fov=28, position=(1.15, 0.95, 1.7), target=(0, 0, 0))
            camera.fit(node, margin=0.06)
        wall = BasicMaterial(map=_wall(encoded=unlit))
        scene.add(_square(), wall, matrix=_behind(camera), cast_shadow=False)
        # Unlit pictures keep their numbers only where the whole frame has numbers of the screen.
        if unlit and _studio.renderer().render(scene, camera, (1, 1)).encoding == "linear":
            wall.map = _wall(encoded=False)
        return _shot(scene, camera, (size, size), None if unlit else "neutral")
    except Exception as error:
        return Shot(None, shorten(error, 240))


def draw_scene(scene: Scene, size: tuple[int, int] = (256, 192)) -> Shot:
    """Draw a scene from above and from one side, so that all of it is in the picture."""
    try:
        triangles = 0
        for node in scene.nodes:
            mesh = node.mesh
            triangles += 0 if mesh is None else len(mesh.indices)
        _check_triangles(triangles)
        camera = PerspectiveCamera(fov=35, position=(0.55, 0.45, 1), target=(0, 0, 0))
        if np.isfinite(scene.bounds).all():
            camera.fit(scene, size=size)
        elif scene.environment is None and scene.background is None:
            return Shot(None, "the scene is empty")
        else:  # the surroundings alone, straight ahead
            camera = PerspectiveCamera(fov=75)
        if _probe_texels(scene) > _MOST_KEPT:
            with Renderer() as own:
                return _shot(scene, camera, size, "neutral", own)
        return _shot(scene, camera, size, "neutral")
    except Exception as error:
        return Shot(None, shorten(error, 240))


def _shot(
    scene: Scene,
    camera: PerspectiveCamera,
    size: tuple[int, int],
    curve: Tonemap | None,
    renderer: Renderer | None = None,
) -> Shot:
    frame = (renderer or _studio.renderer()).render(
        scene, camera, size, samples=_SAMPLES, tonemap=curve, encode="srgb", depth_format=_DEPTH
    )
    assert frame.color is not None
    return Shot(np.array(frame.color))


def _probe_texels(scene: Scene) -> int:
    probes = {id(around): around for node in scene.nodes if (around := node.environment)}
    return sum(6 * probe.size**2 for probe in probes.values() if isinstance(probe, Probe))


def _check_triangles(triangles: int) -> None:
    if triangles > _MOST_TRIANGLES:
        raise ValueError(f"no picture: {triangles:,} triangles take too long")


def _behind(camera: PerspectiveCamera) -> npt.NDArray[np.float64]:
    """Place the square, whose normal is +Z, behind the object and at right angles to the line of sight."""
    eye = np.asarray(camera.position)
    away = eye - (np.zeros(3) if camera.target is None else np.asarray(camera.target))
    away /= np.linalg.norm(away)
    side = np.cross((0, 1, 0), away)
    side /= np.linalg.norm(side)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([side, np.cross(away, side), away], axis=1) * 2.2
    matrix[:3, 3] = -1.2 * away
    return matrix


def _lamps() -> list[DirectionalLight | AmbientLight]:
    return [
        DirectionalLight((1, -1.6, -1.4), intensity=0.95),
        DirectionalLight((-2, 0.3, -0.6), color=(0.75, 0.85, 1), intensity=0.25),
        AmbientLight(intensity=0.6),
    ]


@functools.lru_cache(maxsize=1)
def _ball() -> Mesh:
    return Mesh.sphere(0.5, 64, 32)


@functools.lru_cache(maxsize=1)
def _square() -> Mesh:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    return Mesh(
        corners,
        np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
        normals=np.array([[0, 0, 1]] * 4, np.float32),
        uvs=(corners[:, :2] + 1) / 2,
    )


@functools.lru_cache(maxsize=2)
def _wall(*, encoded: bool) -> Image:
    """Grey squares, which show through what is translucent; grey stands out from light and from dark pages."""
    rows, columns = np.indices((256, 256)) // 16
    grey = np.where((rows + columns) % 2, 86, 98) * np.linspace(1.12, 0.8, 256)[:, None]
    pixels = np.repeat(grey.astype(np.uint8)[..., None], 3, axis=2)
    return Image(pixels if encoded else srgb_decode(pixels / 255))


@functools.lru_cache(maxsize=1)
def _surroundings() -> CubeMap:
    """A studio for mirrors and glass: a chequered floor, a grey room, a large lamp, a tall lamp, a warm window."""
    height, width = 192, 384
    up = np.pi * (0.5 - (np.arange(height) + 0.5) / height)[:, None]
    around = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)[None, :]
    room = np.empty((height, width, 3), np.float32)
    room[:] = (0.16 + 0.3 * np.clip(1 - up / 1.2, 0, 1) ** 2)[..., None] * (0.9, 0.97, 1.06)
    depth = np.where(up < -0.02, np.sin(np.minimum(up, -0.02)), -1)
    reach = np.cos(up) / -depth
    squares = np.floor(2 * reach * np.sin(around)) + np.floor(2 * reach * np.cos(around))
    contrast = np.clip(1.5 - reach / 4, 0, 1)
    floor = 0.2 + 0.13 * contrast * np.where(squares % 2, 1, -1)
    room[up[:, 0] < 0] = (floor[..., None] * (1.05, 1, 0.93))[up[:, 0] < 0]

    def lamp(middle: float, wide: float, low: float, high: float, light: tuple[float, ...]) -> None:
        across = np.abs((around - middle + np.pi) % (2 * np.pi) - np.pi)
        room[(across < wide) & (up > low) & (up < high)] = light

    # The middle of the panorama is -Z; the camera stands at +Z, so that lamps near half a turn show on the ball.
    lamp(-2.2, 0.42, 0.45, 1.05, (7, 7, 7))
    lamp(2.1, 0.12, -0.2, 0.95, (3, 3.2, 3.6))
    lamp(-0.9, 0.3, 0.1, 0.5, (2.2, 1.5, 0.9))
    return CubeMap.from_equirect(room, size=128, mipmaps=True)
