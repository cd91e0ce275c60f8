"""A mirror shows what the formula of reflection says, and a probe shows the scene as it is now."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._core import BasicMaterial, CubeMap, Mesh, MirrorMaterial, PerspectiveCamera, Probe, Scene
from . import reference
from .measurement import Measurement, worst

__all__ = ["prove_mirrors", "smooth_sky"]

SKY = 128  # texels along a face
EYE = (0.8, 0.6, 3.0)
FRAME = (96, 96)
#: Where three texels meet at a corner of the cube a lookup is 7e-4 off the smooth sky; a GPU's weights of 1/256 add
#: 5e-5. A lookup that does not go on in the next face is 4e-3 off.
TOLERANCE = 1e-3
#: Two drawings of one scene, kept as half floats.
SAME = 2e-3


def smooth_sky() -> Any:
    """Give a sky whose colour is its direction: 0.5 + 0.5 d."""
    faces = 0.5 + 0.5 * reference.unit(reference.directions(SKY))
    return CubeMap(faces.astype(np.float32))


def prove_mirrors(renderer: Any) -> list[Measurement]:
    """Render a mirror ball under the smooth sky, then one with a probe, before and after a box has moved."""
    return [_reflection(renderer), *_probe(renderer)]


def _reflection(renderer: Any) -> Measurement:
    scene = Scene(environment=smooth_sky())
    ball = scene.add(Mesh.icosphere(1.0, 4), MirrorMaterial())
    camera = PerspectiveCamera(fov=38, position=EYE, target=(0, 0, 0))
    outputs = ("position", "normal", "id")
    frame = renderer.render(scene, camera, FRAME, format="rgba32f", outputs=outputs)
    seen = frame.id == ball.id
    if seen.mean() < 0.3:
        failure = (
            f"expected a ball in most of the picture, got it in {seen.mean():.0%} of the pixels"
        )
        return Measurement("mirrors", "reflection", float("nan"), TOLERANCE, failure)
    incident = reference.unit(frame.position[seen].astype(float) - EYE)
    mirrored = reference.reflect(incident, frame.normal[seen].astype(float))
    expected = 0.5 + 0.5 * reference.unit(mirrored)
    what = f"MirrorMaterial, {int(seen.sum())} pixels of a ball"
    return Measurement("mirrors", what, worst(frame.color[seen][:, :3], expected), TOLERANCE)


def _probe(renderer: Any) -> list[Measurement]:
    scene = Scene(background=(0.1, 0.2, 0.3))
    ball = scene.add(Mesh.icosphere(0.5, 2), MirrorMaterial())
    ball.environment = Probe(size=16)
    box = scene.add(Mesh.box(1.0), BasicMaterial(color=(1, 0.5, 0)), position=(3, 0.4, 0.2))
    camera = PerspectiveCamera(fov=38, position=EYE, target=(0, 0, 0))
    errors, shown = [], []
    for place in ((3, 0.4, 0.2), (-0.3, 0.2, -3)):
        box.position = place
        renderer.render(scene, camera, FRAME)
        shown.append(renderer.read_probe(ball.environment).faces[..., :3].astype(np.float32))
        captured = renderer.capture(scene, size=16, exclude=[ball], format="rgba16f").faces
        errors.append(worst(shown[-1], captured[..., :3]))
    moved = float(np.abs(shown[0] - shown[1]).max())
    failure = (
        ""
        if moved > 0.5
        else f"expected other faces after the box moved, got a change of {moved:.3g}"
    )
    return [Measurement("mirrors", "a probe follows the scene", max(errors), SAME, failure)]
