"""A shader of the user's is tried in a process of its own, compiled and drawn with its uniform."""

from __future__ import annotations

import os
import warnings
from typing import Any

from ..._core import Mesh, PerspectiveCamera, Scene, ShaderMaterial
from ..process import UNAVAILABLE
from .measurement import Measurement, worst

__all__ = ["prove_shader"]

SOURCE = """
uniform float gain;
vec3 shade(Surface surface) { return gain * (0.5 + 0.5 * surface.normal); }
"""
GAIN = 0.75
#: Two normals that a driver interpolates by two programs.
TOLERANCE = 1e-4


def prove_shader(renderer: Any) -> list[Measurement]:
    """Draw a ball by a source that this machine has never seen."""
    what = "ShaderMaterial, a formula of the normal"
    # No verdict is kept for this text: the process for trials has to start.
    source = f"{SOURCE}// {os.urandom(8).hex()}"
    scene = Scene()
    ball = scene.add(Mesh.icosphere(1.0, 3), ShaderMaterial(source, uniforms={"gain": GAIN}))
    camera = PerspectiveCamera(fov=38, position=(1, 0.5, 3), target=(0, 0, 0))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        frame = renderer.render(scene, camera, (64, 64), format="rgba32f", outputs=("normal", "id"))
    seen = frame.id == ball.id
    expected = GAIN * (0.5 + 0.5 * frame.normal[seen].astype(float))
    untried = [str(item.message) for item in caught if UNAVAILABLE in str(item.message)]
    failure = (
        untried[0] if untried else "" if seen.any() else "expected a ball in the picture, got none"
    )
    return [
        Measurement("shader", what, worst(frame.color[seen][:, :3], expected), TOLERANCE, failure)
    ]
