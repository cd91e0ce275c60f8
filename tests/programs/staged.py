"""What the staged pictures show, measured: what a mirror holds, and how much of it looks like the background."""

import numpy as np

from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.reference.cube_faces import direction_to_face_uv


def held(renderer, program, node, probe, size=(256, 256), eta=None):
    """Return where a node is in the picture, and the ids that its cubemap holds at these pixels.

    The directions are those of reflection, or, with eta, of refraction at the front surface.
    """
    outputs = ("id", "position", "normal")
    frame = renderer.render(program.scene, program.camera, size, outputs=outputs)
    on_node = frame.id == node.id
    incident = normalised(frame.position[on_node].astype(float) - program.camera.position)
    normal = frame.normal[on_node].astype(float)
    bent = (
        shading.reflect(incident, normal) if eta is None else shading.refract(incident, normal, eta)
    )
    cube = renderer.capture(
        program.scene,
        position=probe.position,
        size=256,
        near=probe.near,
        far=probe.far,
        exclude=[node],
        outputs=("id",),
    )
    face, s, t = direction_to_face_uv(bent)
    column, row = (np.clip((x * 256).astype(int), 0, 255) for x in (s, t))
    return on_node, cube.id[face, row, column]


def shares(ids, nodes):
    """Return for each node the part of `ids` that is its own."""
    return np.array([(ids == node.id).mean() for node in nodes])


def like_the_background(renderer, program, node, size=(256, 256), steps=4):
    """Return the part of a node's pixels that differ by at most some steps of 255 from the picture without the node."""
    with_node = renderer.render(program.scene, program.camera, size, outputs=("id",))
    node.visible = False
    without = renderer.render(program.scene, program.camera, size)
    node.visible = True
    apart = np.abs(with_node.color[..., :3].astype(int) - without.color[..., :3]).max(axis=-1)
    return (apart[with_node.id == node.id] <= steps).mean()


def gaze(camera):
    """Return the unit vector in which a camera with a target looks."""
    assert camera.target is not None
    return normalised(camera.target - camera.position)
