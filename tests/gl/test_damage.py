"""Only the rectangles in which a picture can differ are drawn again: the rest must be what it would have been.

After each small edit the picture equals, bit for bit, that of a renderer which keeps nothing.
"""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS, smooth_environment

STEPS = 12


def crowd(rng, offset=(0, 0, 0), size=4.0):
    """Opaque, translucent, textured and mirrored things of all sizes, some of them touching."""
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(16), mipmaps=True))
    scene.add(cc.PointLight(position=np.add(offset, (2, 5, 3))))
    root = scene.add(position=offset)
    picture = rng.integers(0, 256, (16, 16, 3), dtype=np.uint8)
    materials = [
        cc.PhongMaterial(color=(1, 0.5, 0.2)),
        cc.BasicMaterial(color=(0.2, 0.8, 1), opacity=0.5, double_sided=True),
        cc.MirrorMaterial(),
        cc.BasicMaterial(map=cc.Image(picture, mipmaps=True)),
        cc.GlassMaterial(opacity=0.7),
    ]
    meshes = [cc.Mesh.box(1), cc.Mesh.sphere(0.6, segments=12, rings=6), cc.Mesh.plane(1.5, 1)]
    for index in range(14):
        scene.add(
            meshes[index % 3],
            materials[index % 5],
            position=rng.uniform(-size / 2, size / 2, 3),
            rotation=cc.axis_angle(rng.normal(size=3), rng.uniform(0, 360)),
            scale=rng.uniform(0.05, 1.2, 3),
            parent=root,
        )
    return scene


def small_edit(scene, rng):
    """What an animation does: one thing, a little."""
    node = scene.nodes[rng.integers(1, len(scene.nodes))]
    kind = rng.integers(5)
    if kind == 0:
        node.position = np.array(node.position) + rng.normal(size=3) * 0.3
    elif kind == 1:
        node.rotation = cc.axis_angle(rng.normal(size=3), rng.uniform(0, 360))
    elif kind == 2:
        node.scale = rng.uniform(0.02, 1.5, 3) * rng.choice([-1, 1])
    elif kind == 3:
        node.visible = not node.visible
    else:
        node.position = rng.uniform(-3, 3, 3)


def follow(live, scratch, draw, scene, rng, names):
    for step in range(STEPS):
        for _ in range(rng.integers(1, 3)):
            small_edit(scene, rng)
        got, want = draw(live), draw(scratch)
        for name in names:
            assert_identical(getattr(got, name), getattr(want, name), f"{name} of step {step}")


@pytest.fixture
def both(new_renderer):
    """One that keeps pictures, one that keeps none."""
    return new_renderer(), new_renderer(cache_bytes=0)


OPTIONS = {
    "plain": {},
    "float": {"format": "rgba32f"},
    "samples": {"samples": 4},
    "graded": {"tonemap": "aces", "encode": "srgb", "samples": 4},
    "outputs": {"outputs": OUTPUTS},
    "outputs and samples": {"outputs": OUTPUTS, "samples": 4, "format": "rgba16f"},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@pytest.mark.parametrize("seed", range(3))
def test_frames(both, options, seed):
    rng = np.random.default_rng(seed)
    scene = crowd(rng)
    camera = cc.PerspectiveCamera(fov=50, position=(2, 1.5, 5), target=(0, 0, 0))
    names = ("color", *options.get("outputs", ()))
    follow(*both, lambda r: r.render(scene, camera, (97, 71), **options), scene, rng, names)


CAMERAS = {
    "in the crowd": lambda: cc.PerspectiveCamera(
        fov=100, position=(0.3, 0.2, 0.1), target=(1, 0, 0), near=0.3
    ),
    "from afar": lambda: cc.PerspectiveCamera(fov=4, position=(20, 30, 60), target=(0, 0, 0)),
    "orthographic": lambda: cc.OrthographicCamera(height=4, position=(3, 4, 5), target=(0, 0, 0)),
    "a corner of the picture": lambda: cc.PerspectiveCamera(
        fov=30, position=(2, 1, 6), target=(3, 2, 0)
    ),
    "cut by near and far": lambda: cc.PerspectiveCamera(
        fov=50, position=(2, 1.5, 5), target=(0, 0, 0), near=4, far=6
    ),
}


@pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
def test_cameras(both, make):
    rng = np.random.default_rng(7)
    scene, camera = crowd(rng), make()
    follow(*both, lambda r: r.render(scene, camera, (80, 60)), scene, rng, ["color"])


@pytest.mark.parametrize("layered", [None, False], ids=["layered", "one_pass"])
@pytest.mark.parametrize("samples", [1, 4])
def test_captures(new_renderer, layered, samples):
    rng = np.random.default_rng(8)
    scene = crowd(rng)
    pair = new_renderer(layered=layered), new_renderer(layered=layered, cache_bytes=0)
    follow(
        *pair,
        lambda r: r.capture(
            scene, position=(0.1, 0.2, 0.3), size=40, samples=samples, outputs=("id", "distance")
        ),
        scene,
        rng,
        ["faces", "id", "distance"],
    )


@pytest.mark.parametrize("distance", [1e3, 1e5, 1e6, 4e6])
def test_far_from_the_origin(both, distance):
    """Maps count in metres from afar: single precision moves vertices by several pixels there."""
    rng = np.random.default_rng(12)
    offset = np.array([distance, 0.3 * distance, -0.7 * distance])
    scene = crowd(rng, offset)
    camera = cc.PerspectiveCamera(fov=40, position=np.add(offset, (2, 1.5, 5)), target=offset)
    follow(*both, lambda r: r.render(scene, camera, (128, 96)), scene, rng, ["color"])


def test_what_leaves_the_picture_leaves_no_trace(both):
    scene = cc.Scene(background=(0.2, 0.3, 0.4, 1))
    node = scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color=(1, 0, 0)))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 5), target=(0, 0, 0))
    for x in (0, 1.0, 1.9, 2.31, 2.8, 9, -2.3, 0, 0):
        node.position = (x, x / 3, 0)
        got, want = (r.render(scene, camera, (64, 64), samples=4).color for r in both)
        assert_identical(got, want)


def test_translucent_things_that_change_places(both):
    """One pane passes through two that stay: their order changes only for the one that moves."""
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
    """The point of it: a small thing that moves before many others costs few draw calls."""
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
