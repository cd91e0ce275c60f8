"""P7: numpy composites the layers from far to near, and alpha stays 1."""

import numpy as np
import pytest

from cubecam.examples import translucent_objects as example
from tests.compare import assert_close
from tests.programs.oracle import LAMP, Look, box, lit, mesh, moved, quad, ry
from tests.reference import shading
from tests.reference.compositing import composite
from tests.reference.raycast import interior

SIZE = (56, 56)


def order_of(layers, eye):
    """The layers from far to near, by the distance of their centres."""
    return sorted(layers, key=lambda layer: -np.linalg.norm(layer[0].matrix[:3, 3] - eye))


@pytest.mark.slow
@pytest.mark.parametrize("frame", [6, 30, 78, 102])
def test_layers(renderer, frame):
    program = example.build()
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")
    look = Look((0, 1.5, 5), (0, 0, 0), 45, 1, 100, SIZE)
    ground, body = program.opaque
    hits = look.hits([quad(ground, 4, moved(0, -0.75, 0)), mesh(body, np.eye(4), ("bunny", 1.5))])
    eye = look.eye
    base = lit(hits, {ground.id: (0.8, 0.8, 0.8)}, eye, (1, 1, 1), ks=0)
    rows = hits.id == body.id
    base[rows] = shading.phong(
        hits.position[rows], hits.normal[rows], eye, (0.8, 0.6, 0.5), [LAMP], ks=0.3
    )
    labels, layers = [hits.id], []
    for index, node in enumerate(program.translucent):
        # Each node moves counter-clockwise round +Y, 3 degrees a frame, and faces outwards.
        degrees = 72 * index
        matrix = ry(3 * frame) @ ry(degrees) @ moved(1.5, 0, 0) @ ry(90)
        pane = index % 2 == 0
        shape = box(node, (1.1, 1.3, 0.04), matrix) if pane else mesh(node, matrix)
        seen = look.hits([shape])
        paint, opacity = (example.PANES if pane else example.BALLS)[index // 2]
        before = seen.hit & (seen.t < hits.t)
        layer = np.zeros((*seen.id.shape, 4))
        layer[..., :3] = lit(seen, {node.id: paint}, eye, (0, 0, 0), ks=0.5)
        layer[..., 3] = np.where(before, opacity, 0)
        layers.append((shape, layer))
        labels += [before.astype(int), seen.part if pane else seen.hit.astype(int)]
    background = np.concatenate([base, np.ones((*base.shape[:2], 1))], axis=-1)
    ordered = [layer for _, layer in order_of(layers, eye)]
    want = composite(background, *ordered)
    mask = interior(*labels)
    covered = sum((layer[..., 3] > 0).astype(int) for layer in ordered)
    assert (mask & (covered >= 2)).sum() > 5
    assert_close(color, want, "phong", mask=mask)
    assert (color[..., 3] == 1).all()
    # The opposite order would give another picture.
    assert np.abs(composite(background, *ordered[::-1]) - want).max() > 0.05


def test_what_is_behind_the_bunny_is_hidden(renderer):
    """The depth test is on: the bunny hides the panes behind it."""
    program = example.build()
    for node in program.translucent:
        node.visible = node.id == program.translucent[0].id
    frame = 30  # the first pane stands behind
    picture = example.draw(program, renderer, frame, size=SIZE)
    program.translucent[0].visible = False
    without = example.draw(program, renderer, frame, size=SIZE)
    changed = (picture != without).any(-1)
    ids = renderer.render(program.scene, program.camera, SIZE, outputs=("id",)).id
    assert changed.any()
    assert not changed[ids == program.opaque[1].id].any()
