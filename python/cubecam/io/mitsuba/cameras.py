"""Cameras as sensors of Mitsuba."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._core import Camera, OrthographicCamera, PerspectiveCamera
from ..left_out import LeftOut

Json = dict[str, Any]
#: A sensor of Mitsuba looks along +Z, with +Y up and +X to the left of the picture.
_AXES = np.diag([-1.0, 1.0, -1.0, 1.0])


def sensor_of(camera: Camera, size: tuple[int, int], samples: int, left_out: LeftOut) -> Json:
    """Return the sensor of a camera, with its film and its sampler."""
    width, height = size
    to_world = np.linalg.inv(np.asarray(camera.view, float)) @ _AXES
    sensor: Json
    if isinstance(camera, PerspectiveCamera):
        sensor = {"type": "perspective", "fov": float(camera.fov), "fov_axis": "y"}
        x, y = camera.shift
        if x or y:
            # In widths and heights of the picture, and downwards.
            sensor["principal_point_offset_x"] = float(x) * height / width
            sensor["principal_point_offset_y"] = -float(y)
        if camera.pixel_aspect != 1:
            left_out.add(
                "a pixel of a Mitsuba film is square: pixel_aspect of the camera is left out"
            )
    elif isinstance(camera, OrthographicCamera):
        # The width of the picture is 2 in the sensor's own coordinates.
        half = float(camera.height) * width / height / 2
        to_world = to_world @ np.diag([half, half, 1.0, 1.0])
        sensor = {"type": "orthographic"}
    else:
        raise TypeError(
            f"camera: expected a PerspectiveCamera or an OrthographicCamera, got {type(camera).__name__}"
        )
    return {
        **sensor,
        "near_clip": float(camera.near),
        "far_clip": float(camera.far),
        "to_world": to_world,
        "film": {
            "type": "hdrfilm",
            "width": int(width),
            "height": int(height),
            "pixel_format": "rgba",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": "independent", "sample_count": int(samples)},
    }
