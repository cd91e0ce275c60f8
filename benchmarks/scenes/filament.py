"""Filament by filly (PyPI). Its pixels have 8 bits: pictures of several exposures are put together to linear light.

Filament's exposure does not count for what a material emits, nor for unlit materials. A picture that is exposed so
darkly that nothing else remains shows both, and is taken off the others before exposures are undone.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

#: Stops of exposure, from bright to dark: each pixel comes from the first in which no channel is clipped.
STOPS = (-2.0, 0.0, 3.0, 6.0)
#: Stops that leave what is emitted alone.
DARK = 24.0


def linear(pixels: Array) -> Array:
    """Light of sRGB bytes (IEC 61966-2-1)."""
    share = pixels.astype(np.float64) / 255
    made: Array = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    return made


def put_together(pictures: list[tuple[float, Array]], emitted: Array) -> Array:
    """(H, W, 3) light of [(stops, bytes)], brightest first, and of the bytes of what is emitted."""
    unexposed = linear(emitted)
    made = np.zeros(unexposed.shape)
    missing = np.ones(made.shape[:2], bool)
    for stops, pixels in pictures:
        # At EV 100 of `stops`, luminance is divided by 1.2 * 2^stops.
        light = np.maximum(linear(pixels) - unexposed, 0) * 1.2 * 2.0**stops + unexposed
        here = missing & (pixels.max(-1) < 250) if stops != pictures[-1][0] else missing
        made[here] = light[here]
        missing &= ~here
    return made.astype(np.float32)


def draw(
    path: Path,
    panorama: Array,
    size: tuple[int, int],
    *,
    camera: dict[str, Any] | None = None,
    time: float | None = None,
    animation: int = 0,
) -> Array:
    """(H, W, 3) float32 light. Without a camera, the first of the file."""
    import filly

    with filly.Renderer() as renderer:
        scene = renderer.create_scene()
        model = scene.load(str(path))
        if time is not None and model.animations:
            model.apply_animation(animation, time, loop=False)
        if camera is None:
            eye = model.cameras[0]
        else:
            eye = renderer.create_camera()
            eye.set_perspective(
                fov_y_deg=camera["fov"],
                aspect=size[0] / size[1],
                near=camera["near"],
                far=camera["far"],
            )
            eye.position = list(camera["position"])
            eye.look_at(list(camera["target"]))
        scene.camera = eye
        scene.environment = renderer.create_environment(np.ascontiguousarray(panorama))
        scene.environment_intensity = 1.0
        scene.environment_rotation_deg = 180.0  # +Z is in the centre of its panoramas
        scene.environment_visible = False
        scene.background = [0.0, 0.0, 0.0, 1.0]
        scene.tone_mapping, scene.encoding = "linear", "srgb"
        scene.msaa = 4
        scene.shadows = scene.ssao = scene.bloom = scene.dithering = False
        target = renderer.create_render_target(width=size[0], height=size[1])
        pictures = []
        for stops in (*STOPS, DARK):
            eye.exposure = stops
            renderer.render(scene, target)
            pictures.append((stops, np.array(target.read())[..., :3]))
    return put_together(pictures[:-1], pictures[-1][1])
