"""What a picture of a model needs besides the model: light, a background, an exposure."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np

from .._core import CubeMap, Scene
from .lamp import sky_irradiance, split_lamp

__all__ = ["Background", "blurred", "exposure_for", "light_by"]

Background: TypeAlias = Literal["blurred", "environment", "transparent"]

_BLUR = 3  # the level of six that a blurred background shows
_GREY = 0.6  # the radiance that a white matt surface has on average after `exposure_for`


def light_by(scene: Scene, cube: CubeMap) -> None:
    """Light a scene by an environment: its brightest lamp becomes a light that casts shadows."""
    split = split_lamp(cube)
    scene.environment = split.environment
    if split.light is not None:
        scene.add(split.light)


def blurred(cube: CubeMap) -> CubeMap:
    """Give an environment as it looks behind a thing that a camera is focussed on."""
    levels = cube.prefilter(6, min(cube.size, 256)).levels
    return CubeMap(np.asarray(levels[_BLUR]), encoding=cube.encoding)


def exposure_for(cube: CubeMap, intensity: float = 1.0) -> float:
    """Choose the stops at which a white matt surface, on average over its sides, is as bright as on a photograph."""
    sides = np.concatenate([np.eye(3), -np.eye(3)])
    mean = intensity * float(sky_irradiance(cube, sides).mean()) / np.pi
    return float(np.clip(np.log2(_GREY / mean), -16, 16)) if mean > 0 else 0.0
