"""A model on its stage: the scene of a file, lit, on a ground if wanted, seen by a camera, at any moment."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._core import (
    AmbientLight,
    CubeMap,
    DirectionalLight,
    Frame,
    Light,
    PerspectiveCamera,
    Renderer,
    Scene,
    StandardMaterial,
)
from .._nodes import shown_nodes
from ..io.pixels import LUMINANCE
from .fit import Extent, fit_camera, fit_turntable
from .ground import Ground
from .lamp import directions_of_light
from .stage import blurred, exposure_for, light_by

if TYPE_CHECKING:
    from .._core import Camera

__all__ = ["Shoot"]

_MOMENTS = 12  # at which an animation is looked at before the camera is placed
_STILL, _MOVING = 64, 24  # directions of light for the shadow on a ground
_FILL = (
    0.15  # of the light of a file's lamps comes from all around, where the file has no environment
)
_KEY = 0.4  # what a clay model shows on average, before the tone curve


class Shoot:
    """A scene that is made ready for pictures.

    Parameters
    ----------
    scene : Scene
        The file's scene; it gets light if it has none, and a background if it has none.
    environment : CubeMap or None
        The light from all around in place of the file's; None keeps what the file has.
    sample : callable
        Gives the environment for a file that has neither light nor environment.

    Attributes
    ----------
    told : list of str
        What was chosen by default, in words.
    """

    def __init__(self, scene: Scene, environment: CubeMap | None, sample: Any) -> None:
        self.scene = scene
        self.nodes = shown_nodes(scene)
        if not self.nodes:
            raise ValueError("expected a model with something to see, got none")
        self.told: list[str] = []
        self.camera: Camera | None = None
        self.ground: Ground | None = None
        self._own_lights = bool(scene.lights)
        self._around = environment if environment is not None else scene.environment
        if environment is not None or not (self._own_lights or scene.environment is not None):
            cube = environment if environment is not None else sample()
            self._around = cube
            if environment is None:
                self.told.append("in a sample photograph")
            if self._own_lights:
                scene.environment = cube
            else:
                scene.environment_intensity, scene.environment_rotation = 1.0, (1, 0, 0, 0)
                light_by(scene, cube)
        elif scene.environment is None:
            self._around = cube = sample()
            scene.environment = cube
            scene.environment_intensity = _FILL * self._light_of_lamps() / max(_mean(cube), 1e-9)
            self.told.append(
                "lit by the file's lights, with a little light from a sample photograph"
            )

    # ----- light

    def _sphere(self) -> tuple[npt.NDArray[np.float64], float]:
        """Give the middle of the model and the distance of the corners of its box."""
        low, high = Extent.box(self.nodes)
        return (low + high) / 2, float(np.linalg.norm(high - low)) / 2

    def _light_of_lamps(self) -> float:
        """Give the mean radiance of a white matt surface in the middle of the model, over six sides."""
        middle, radius = self._sphere()
        return sum(_arriving(light, middle, radius) for light in self.scene.lights)

    def set_background(self, background: str | tuple[float, ...] | None) -> None:
        """Show "blurred", "environment", "transparent", or a colour behind the model; None keeps the file's."""
        if background is None and self.scene.background is not None:
            return
        if background in (None, "blurred"):
            self.scene.background = (
                None if self._around is None else _turned(self.scene, blurred(self._around))
            )
        elif background == "environment":
            self.scene.background = (
                None if self._around is None else _turned(self.scene, self._around)
            )
        elif background == "transparent":
            self.scene.background = (0, 0, 0, 0)
        else:
            self.scene.background = background

    @property
    def measures(self) -> bool:
        """Whether `exposure` needs a renderer and a camera: light of lamps is measured on the model."""
        return self._own_lights or self._around is None

    def exposure(self, renderer: Renderer | None) -> float:
        """Choose the stops that make a grey model neither dark nor pale in this light."""
        if not self.measures or renderer is None:
            assert self._around is not None
            return exposure_for(self._around, self.scene.environment_intensity)
        return self._measured(renderer)

    def _measured(self, renderer: Renderer) -> float:
        """Look at the model as of clay, in its own light."""
        assert self.camera is not None
        clay = StandardMaterial(color=(0.6, 0.6, 0.6), metallic=0, roughness=1, double_sided=True)
        kept = [(node, node.material) for node in self.nodes]
        try:
            for node in self.nodes:
                node.material = clay
            frame = renderer.render(
                self.scene, self.camera, (96, 96), format="rgba32f", outputs=("id",)
            )
        finally:
            for node, material in kept:
                node.material = material
        ids = [node.id for node in self.nodes]
        light = frame.color[np.isin(frame.id, ids)][:, :3] @ LUMINANCE
        mean = float(np.exp(np.log(np.maximum(light, 1e-9)).mean())) if len(light) else 0.0
        return float(np.clip(np.log2(_KEY / mean), -20, 20)) if mean > 1e-8 else 0.0

    # ----- ground

    def add_ground(
        self,
        renderer: Renderer,
        *,
        moving: bool,
        moments: Sequence[float] = (),
        animation: int | str = 0,
    ) -> None:
        """Lay a ground under the model that catches its shadow."""
        count = _MOVING if moving else _STILL
        if self._own_lights:
            directions = self._directions_of_lamps(count)
        else:
            assert self._around is not None
            directions = directions_of_light(self._around, count)
            directions = directions @ _rotation(self.scene.environment_rotation).T
        # No moment of a film goes below the ground.
        self.ground = Ground(
            self.scene,
            self.nodes,
            directions,
            texels=160 if moving else 320,
            moments=self._run(moments, animation),
        )
        self.ground.update(renderer)

    def _directions_of_lamps(self, count: int) -> npt.NDArray[np.float64]:
        """Share the directions among the lamps by the light that each brings to the ground; a lamp has some width."""
        middle, radius = self._sphere()
        found, weights = [], []
        for light in self.scene.lights:
            towards = _towards(light, middle, radius)
            if towards is not None and towards[1] > 0.05:
                found.append(towards)
                weights.append(towards[1] * _arriving(light, middle, radius))
        rng = np.random.default_rng(1)
        dome = rng.normal(size=(count, 3))
        dome[:, 1] = np.abs(dome[:, 1]) + 0.1
        dome /= np.linalg.norm(dome, axis=1, keepdims=True)
        if not sum(weights) > 0:
            return dome
        share = np.cumsum(weights) / sum(weights)
        picked = np.searchsorted(share, (np.arange(count) + 0.5) / count)
        around = np.array(found)[picked] + 0.06 * rng.normal(size=(count, 3))
        around[: round(_FILL * count)] = dome[: round(_FILL * count)]
        around[:, 1] = np.maximum(around[:, 1], 0.03)
        return np.asarray(around / np.linalg.norm(around, axis=1, keepdims=True))

    # ----- camera

    def place_camera(
        self,
        at: tuple[float, float],
        aspect: float,
        *,
        turns: bool,
        moments: list[float],
        animation: int | str,
    ) -> None:
        """Fit the camera to the model, for a turntable and for all moments of an animation if there are any."""
        fit = fit_turntable if turns else fit_camera
        self.camera = fit(self.nodes, at=at, aspect=aspect, moments=self._run(moments, animation))

    def _run(self, moments: Sequence[float], animation: int | str) -> Iterator[None]:
        """Go through moments of an animation; without any, stay once at the present one."""
        for moment in moments:
            self.set_time(moment, animation)
            yield
        if not moments:
            yield

    def set_time(self, seconds: float, animation: int | str) -> None:
        """Move what an animation moves."""
        self.scene.set_time(seconds, animation)

    def moments_of(self, seconds: float) -> list[float]:
        """Give the times at which an animation is looked at before the camera is placed."""
        return [seconds * k / _MOMENTS for k in range(_MOMENTS + 1)]

    # ----- pictures

    def draw(self, renderer: Renderer, size: tuple[int, int], **look: Any) -> Frame:
        """Draw a frame."""
        assert self.camera is not None
        return renderer.render(self.scene, self.camera, size, **look)

    def frames(
        self,
        renderer: Renderer,
        size: tuple[int, int],
        count: int,
        *,
        turns: float,
        seconds: float,
        animation: int | str | None,
        **look: Any,
    ) -> Iterator[Frame]:
        """Draw the frames of a film that begins again at its end: turns of the camera, and an animation's time."""
        for index in range(count):
            if animation is not None:
                # The last frame of an animation is shown, too: it is seldom equal to the first one.
                self.set_time(seconds * index / max(count - 1, 1), animation)
                if self.ground is not None:
                    self.ground.update(renderer)
            frame = self.draw(renderer, size, **look)
            yield frame
            if turns:
                assert isinstance(self.camera, PerspectiveCamera)
                self.camera.orbit(yaw=360 * turns / count)


def _mean(cube: CubeMap) -> float:
    """Give the mean radiance of a white matt surface over six sides."""
    return float(0.6 / 2 ** exposure_for(cube))


def _towards(light: Light, point: npt.NDArray[np.float64], radius: float) -> Any:
    """Give the unit vector from a point to a light; None for a light from all around."""
    if isinstance(light, AmbientLight):
        return None
    if isinstance(light, DirectionalLight):
        return -np.asarray(light.world_direction, np.float64)
    lamp: Any = light
    away = np.asarray(lamp.world_position, np.float64) - point
    return away / max(float(np.linalg.norm(away)), 1e-9 * max(radius, 1e-30))


def _arriving(light: Light, point: npt.NDArray[np.float64], radius: float) -> float:
    """Give the mean radiance of white matt surfaces of six directions that a light brings to a point."""
    strength = float(light.intensity) * float(np.asarray(light.color)[:3] @ LUMINANCE)
    towards = _towards(light, point, radius)
    if towards is None:
        return strength
    if not isinstance(light, DirectionalLight):
        lamp: Any = light
        position = np.asarray(lamp.world_position, np.float64)
        # Light falls off from the lamp to the model's surface, not to its middle.
        away = max(float(np.linalg.norm(position - point)), 0.5 * radius, 1e-9)
        strength /= away**lamp.decay
    return strength * float(np.abs(towards).sum()) / 6 / np.pi


def _rotation(quaternion: npt.ArrayLike) -> npt.NDArray[np.float64]:
    return np.asarray(Scene().add(rotation=quaternion).matrix[:3, :3])


def _turned(scene: Scene, cube: CubeMap) -> CubeMap:
    """Turn and scale a background as the scene does with its environment, which no background follows by itself."""
    rotation, factor = _rotation(scene.environment_rotation), scene.environment_intensity
    if np.allclose(rotation, np.eye(3)) and factor == 1:
        return cube
    from .lamp import texels

    directions, _ = texels(cube.size)
    # What the cube shows in a direction d appears in R d.
    faces = cube.sample((directions @ rotation).reshape(-1, 3)).reshape(*directions.shape[:3], -1)
    faces = faces.astype(np.float32)
    faces[..., :3] *= factor
    return CubeMap(faces, encoding=cube.encoding)
