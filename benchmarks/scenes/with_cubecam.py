"""cubecam: `cc.load_scene`, and one picture of floats."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc

Array = npt.NDArray[Any]


def scene_of(
    path: Path, panorama: Array, time: float | None = None, animation: int = 0
) -> cc.Scene:
    """The scene of a file, lit by a panorama as well, in front of black."""
    scene = cc.load_scene(path)
    scene.environment = cc.CubeMap.from_equirect(panorama, size=256)
    scene.background = (0, 0, 0)
    if time is not None and scene.animations:
        scene.set_time(time, animation=animation)
    return scene


def draw(
    path: Path,
    panorama: Array,
    size: tuple[int, int],
    *,
    camera: dict[str, Any] | None = None,
    time: float | None = None,
    animation: int = 0,
) -> tuple[Array, Array]:
    """((H, W, 3) float32 light, (H, W) bool: pixels of opaque nodes). Without a camera, the first of the file."""
    scene = scene_of(path, panorama, time, animation)
    eye = scene.cameras[0] if camera is None else cc.PerspectiveCamera(**camera)
    with cc.Renderer() as renderer:
        frame = renderer.render(
            scene, eye, size=size, format="rgba32f", samples=4, outputs=("color", "id")
        )
    return np.ascontiguousarray(frame.color[..., :3]), frame.id > 0
