"""Only the rectangles in which a picture can differ are drawn again; see test_incremental.py for random edits."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical


@pytest.fixture
def both(new_renderer):
    """Two renderers: the first keeps pictures, the second keeps none."""
    return new_renderer(), new_renderer(cache_bytes=0)


def test_what_leaves_the_picture_leaves_no_trace(both):
    scene = cc.Scene(background=(0.2, 0.3, 0.4, 1))
    node = scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color=(1, 0, 0)))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 5), target=(0, 0, 0))
    for x in (0, 1.0, 1.9, 2.31, 2.8, 9, -2.3, 0, 0):
        node.position = (x, x / 3, 0)
        got, want = (r.render(scene, camera, (64, 64), samples=4).color for r in both)
        assert_identical(got, want)


def test_translucent_things_that_change_places(both):
    """One pane passes through two that stay: the order changes only for the pane that moves."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    panes = [
        scene.add(
            cc.Mesh.box((1, 1, 0.01)),
            cc.BasicMaterial(color=color, opacity=0.5, double_sided=True),
            position=(x, 0, z),
        )
        for color, x, z in (((1, 0, 0), -0.4, 0), ((0, 1, 0), 0, -1), ((0, 0, 1), 0.4, -2))
    ]
    camera = cc.PerspectiveCamera(fov=50, position=(0.2, 0.1, 4), target=(0, 0, 0))
    for z in (-3, -2.5, -1.5, -0.5, 0.5, -1.5, -3):
        panes[0].position = (-0.4, 0, z)
        got, want = (r.render(scene, camera, (48, 48), format="rgba32f").color for r in both)
        assert_identical(got, want)


def test_less_is_drawn_than_all(renderer):
    """A small node that moves in front of many others needs few draw calls: this is the purpose of the rectangles."""
    scene = cc.Scene()
    for x in range(10):
        for y in range(10):
            scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(), position=(x - 4.5, y - 4.5, 0))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 10), target=(0, 0, 0))
    renderer.render(scene, camera, (128, 128))
    every = renderer.stats.draw_calls
    scene.nodes[0].position = (-4.4, -4.4, 0)
    renderer.render(scene, camera, (128, 128))
    assert renderer.stats.views_drawn == 1
    assert renderer.stats.draw_calls < every / 3


def test_rgb565_has_the_bits_of_a_whole_picture(both):
    """llvmpipe rounds pixels of rgb565 otherwise where a scissor cuts a block of pixels."""
    rng = np.random.default_rng(8)
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    colors = [cc.BasicMaterial(color=rng.random(3)) for _ in range(3)]
    boxes = [scene.add(cc.Mesh.box(0.8), color) for color in colors]
    for step in range(12):
        boxes[step % 3].position = (*rng.uniform(-0.6, 0.6, 2), -2)
        colors[(step + 1) % 3].color = rng.random(3)
        got, want = (r.capture(scene, size=21, format="rgb565").faces for r in both)
        assert_identical(got, want)
