"""Phong's model per pixel against numpy, in frames and in captures."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from tests.compare import assert_close
from tests.gl.world import (
    World,
    capture_hits,
    inner,
    inner_smooth,
    orthographic,
    perspective,
    phong_lights,
)

COLORS = {1: (0.4, 0.4, 1), 2: (1, 0.4, 0.4), 3: (0.4, 1, 0.4)}
OURS, THEIRS = phong_lights()
LIGHTS = {
    "point": ([0], [0]),
    "decaying": ([1], [1]),
    "directional": ([2], [2]),
    "ambient": ([3], [3]),
    "none": ([], []),
    "all": ([0, 1, 2, 3], [0, 1, 2, 3]),
}


def lit(which, **options):
    world = World()
    options = {"shininess": 10, **options}
    for add, place in (
        (lambda **p: world.plane(8, 8, **p), {"position": (0, -1, 0)}),
        (
            lambda **p: world.sphere(0.7, **p),
            {"position": (0.8, 0, -1), "scale": (1, 1.4, 0.7), "degrees": 30},
        ),
        (
            lambda **p: world.box((0.8, 1.2, 0.6), **p),
            {"position": (-1, 0, -0.5), "axis": (1, 2, 1), "degrees": 40},
        ),
    ):
        color = COLORS[len(world.shapes) + 1]
        add(color=color, material=cc.PhongMaterial(color=color, **options), **place)
    for index in which:
        world.scene.add(OURS[index])
    return world


def expected(hits, eye, lights, **options):
    color = np.zeros((*hits.id.shape, 3))
    for id_, value in COLORS.items():
        color[hits.id == id_] = value
    return shading.phong(hits.position, hits.normal, eye, color, lights, **options)


def good(hits):
    """The pixels away from silhouettes and from the creases of boxes; the sphere has no creases."""
    return np.where(hits.id == 3, inner(hits), inner_smooth(hits)) & hits.hit


@pytest.mark.parametrize(("ours", "theirs"), LIGHTS.values(), ids=LIGHTS)
def test_frame(renderer, ours, theirs):
    world, view = lit(ours), perspective((1, 1.5, 3), (0, -0.2, -0.5))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    want = expected(hits, view.eye, [THEIRS[i] for i in theirs])
    assert_close(frame.color[..., :3], want, "phong", mask=good(hits))


def test_orthographic_eye_is_at_infinity(renderer):
    """The view direction is the same everywhere, so highlights are those of an eye far behind."""
    world, view = lit([0, 2]), orthographic((1, 1.5, 3), (0, -0.2, -0.5))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    far_eye = view.eye - view.directions()[0, 0] * 1e7
    want = expected(hits, far_eye, [THEIRS[0], THEIRS[2]])
    assert_close(frame.color[..., :3], want, "phong", mask=good(hits))


@pytest.mark.parametrize("eye", [None, (0, 1, 5)], ids=["own", "given"])
def test_capture(any_path, eye):
    world, position = lit([0, 1, 2, 3]), (0.2, 0.4, 1)
    cube = any_path.capture(world.scene, position=position, size=40, eye=eye)
    hits = capture_hits(world, position, 40)
    want = expected(hits, position if eye is None else eye, THEIRS)
    assert_close(cube.faces[..., :3], want, "phong", mask=good(hits))


@pytest.mark.parametrize(
    "options",
    [{"ka": 0.5}, {"kd": 0.1}, {"ks": 0.3}, {"shininess": 3}, {"shininess": 60}, {"ks": 0}],
)
def test_each_parameter(renderer, options):
    world, view = lit([0], **options), perspective((1, 1.5, 3), (0, -0.2, -0.5))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    options = {"shininess": 10, **options}
    want = expected(hits, view.eye, THEIRS[:1], **options)
    mask = good(hits)
    if options["shininess"] == 60:
        mask &= hits.id != 2  # the sphere's normals, times 60, are beyond the tolerance
    assert_close(frame.color[..., :3], want, "phong", mask=mask)


def test_no_highlight_on_the_dark_side(renderer):
    """R.V may be large where the light is behind: the specular term must not shine through."""
    world = World()
    world.plane(4, 4, color=(0.5, 0.5, 0.5), material=cc.PhongMaterial(color=(0.5, 0.5, 0.5)))
    world.scene.add(cc.PointLight(position=(-1, -0.2, 0)))
    view = perspective((1, 0.3, 0.1), (0, 0, 0))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    mask = good(view.hits(world.shapes))
    np.testing.assert_allclose(frame.color[mask][:, :3], 0.1, atol=1e-6)


def test_moving_a_light_draws_anew(renderer):
    world, view = lit([]), perspective((1, 1.5, 3), (0, -0.2, -0.5))
    light = world.scene.add(cc.PointLight(position=(0, 5, 0)))
    first = renderer.render(world.scene, view.camera, view.size).color
    light.position = (5, 5, 5)
    assert (renderer.render(world.scene, view.camera, view.size).color != first).any()


def test_many_lights(renderer):
    """The number of lights is far above the size of a small uniform array."""
    world, view = lit([]), perspective((1, 1.5, 3), (0, -0.2, -0.5))
    rng = np.random.default_rng(6)
    theirs = []
    for position in rng.uniform(-5, 5, (40, 3)):
        world.scene.add(cc.PointLight(position=position, intensity=0.03))
        theirs.append(shading.Point(tuple(position), intensity=0.03))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    assert_close(frame.color[..., :3], expected(hits, view.eye, theirs), "phong", mask=good(hits))


def test_a_map_multiplies_the_color(renderer):
    world = World()
    picture = np.full((4, 4, 3), (51, 102, 204), np.uint8)
    world.plane(4, 4, color=(1, 1, 1), material=cc.PhongMaterial(color=(1, 0.5, 1), map=picture))
    world.scene.add(cc.PointLight(position=(0, 3, 0)))
    view = perspective((0, 2, 2), (0, 0, 0))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    want = shading.phong(
        hits.position, hits.normal, view.eye, (0.2, 0.2, 0.8), [shading.Point((0, 3, 0))]
    )
    assert_close(frame.color[..., :3], want, "phong", mask=good(hits))
