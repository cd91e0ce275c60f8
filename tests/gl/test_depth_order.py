"""Captures of the farthest surface, against the ray caster, which goes through every nearer surface."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import OUTPUTS, World, inner, inner_smooth, room, smooth_environment
from tests.reference.raycast import cast_cube, interior

SIZE = 32
FARTHEST: dict[str, Any] = {"size": SIZE, "outputs": (*OUTPUTS, "depth"), "depth_order": "farthest"}
SPHERES = (6, 8)


def hall():
    """The room with more nodes behind its nodes: the nearest order hides them. Some nodes are seen from inside."""
    world = room()
    world.box((5, 5, 0.2), (0.6, 0.1, 0.4), position=(0.3, 0.2, -4))
    world.sphere(1.6, (0.3, 0.8, 0.8), position=(-0.8, 0.3, 4.5))
    double = cc.BasicMaterial(color=(0.7, 0.6, 0.1), double_sided=True)
    world.box((2.2, 2.4, 2.1), (0.7, 0.6, 0.1), material=double, position=(4.2, 0.4, 0.6))
    return world


@pytest.fixture(scope="module")
def world():
    return hall()


@pytest.fixture(scope="module")
def hits(world):
    return cast_cube(world.shapes, (0, 0, 0), SIZE, farthest=True)


@pytest.fixture(params=[1, 4], ids=["samples_1", "samples_4"])
def cube(request, any_path, world):
    return any_path.capture(world.scene, samples=request.param, **FARTHEST)


def test_the_order_changes_what_is_seen(world, hits):
    nearest = cast_cube(world.shapes, (0, 0, 0), SIZE)
    assert ((nearest.id != hits.id) & interior(hits.id)).mean() > 0.04
    assert {9, 10, 11} <= set(np.unique(hits.id))


def test_color(cube, hits, world):
    assert_close(cube.faces, world.paint(hits), "float32_maths", mask=interior(hits.id))


def test_outputs(cube, hits):
    clear = interior(hits.id, hits.part)
    assert_close(cube.id, hits.id, "exact", mask=interior(hits.id))
    assert_close(cube.distance, hits.distance, "distance", mask=clear)
    assert_close(cube.z, hits.t, "distance", mask=clear)
    assert_close(cube.position, hits.position, "position", mask=clear)
    mask = np.where(np.isin(hits.id, SPHERES), inner_smooth(hits), inner(hits))
    mask[hits.id == 10] &= hits.facing[hits.id == 10] > 0.1
    assert_close(cube.normal, hits.normal, "normal", mask=mask)


def test_depth_is_that_of_the_surface_and_1_where_nothing_is(cube, hits):
    near, far = 0.05, 1000.0
    with np.errstate(invalid="ignore"):
        expected = np.where(hits.hit, far / (far - near) * (1 - near / hits.t), 1.0)
    assert_close(cube.depth, expected, "window_depth", mask=interior(hits.id, hits.part))
    assert (cube.depth[~hits.hit & interior(hits.id)] == 1).all()


def test_few_pixels_fall_to_the_other_side_of_a_silhouette(cube, hits):
    assert (cube.id != hits.id).mean() < 0.004


@pytest.mark.parametrize("samples", [1, 4])
def test_layered_and_one_pass_are_equal(new_renderer, world, samples):
    cubes = [
        new_renderer(layered=layered).capture(world.scene, samples=samples, **FARTHEST)
        for layered in (True, False)
    ]
    assert_identical(cubes[0].faces, cubes[1].faces, across="programs")
    for name, values in cubes[0].outputs.items():
        assert_identical(values, cubes[1].outputs[name], name, across="programs")


@pytest.mark.parametrize("depth_format", ["depth_component24", "depth24_stencil8"])
def test_depths_of_whole_numbers(renderer, world, hits, depth_format):
    cube = renderer.capture(world.scene, depth_format=depth_format, **FARTHEST)
    assert_close(cube.id, hits.id, "exact", mask=interior(hits.id))
    assert (cube.depth[~hits.hit & interior(hits.id)] == 1).all()


@pytest.mark.parametrize("samples", [1, 4])
def test_the_sky_shows_where_nothing_was_drawn_and_nowhere_else(any_path, samples):
    sky = cc.CubeMap(smooth_environment(16))
    world = hall()
    world.scene.background = sky
    got = any_path.capture(world.scene, samples=samples, **FARTHEST)
    nearest = any_path.capture(world.scene, size=SIZE, samples=samples)
    found = cast_cube(world.shapes, (0, 0, 0), SIZE, farthest=True)
    inside = interior(found.id)
    assert_close(got.faces, world.paint(found), "float32_maths", mask=inside & found.hit)
    empty = ~found.hit & inside
    assert empty.any()
    assert_identical(got.faces[empty], nearest.faces[empty])


def test_both_orders_of_one_scene_are_kept(fresh_renderer, world):
    first = fresh_renderer.capture(world.scene, **FARTHEST)
    near = fresh_renderer.capture(world.scene, **{**FARTHEST, "depth_order": "nearest"})
    assert not np.array_equal(first.id, near.id)
    again = fresh_renderer.capture(world.scene, **FARTHEST)
    assert fresh_renderer.stats.views_drawn == 0
    assert_identical(first.faces, again.faces)


def test_incremental_equals_from_scratch(new_renderer):
    world = hall()
    kept = new_renderer()
    node = next(node for node in world.scene.nodes if node.id == 9)
    kept.capture(world.scene, **FARTHEST)
    for step in range(4):
        node.position = (0.3 + 0.2 * step, 0.2, -4 + 0.9 * step)
        got = kept.capture(world.scene, **FARTHEST)
        assert kept.stats.views_skipped > 0
        fresh = new_renderer().capture(world.scene, **FARTHEST)
        assert_identical(got.faces, fresh.faces)
        for name, values in fresh.outputs.items():
            assert_identical(got.outputs[name], values, name)


def test_single_sided_bodies_show_their_fronts_alone():
    world = World()
    world.sphere(1.0, position=(0, 0, -3))
    with cc.Renderer() as renderer:
        cube = renderer.capture(world.scene, **FARTHEST)
    middle = cube.distance[5, SIZE // 2, SIZE // 2]
    assert 1.99 < middle < 2.03


def test_translucent_nodes_show_beyond_the_farthest_surface(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -4))
    glass = cc.BasicMaterial(color=(0, 1, 0), opacity=0.5)
    pane = scene.add(cc.Mesh.box(1), glass, position=(0, 0, -2))
    cube = renderer.capture(scene, **FARTHEST)
    assert cube.faces[5, SIZE // 2, SIZE // 2].tolist() == [1, 0, 0, 1]
    pane.position = (0, 0, -6)
    cube = renderer.capture(scene, **FARTHEST)
    assert_close(cube.faces[5, SIZE // 2, SIZE // 2], [0.5, 0.5, 0, 1], "blend")


def test_bad_orders_are_refused(renderer):
    with pytest.raises(ValueError, match='depth_order: expected "nearest", "farthest", got "back"'):
        renderer.capture(cc.Scene(), size=4, depth_order="back")
    with pytest.raises(ValueError, match='depth_order: expected "nearest" without a depth buffer'):
        renderer.capture(cc.Scene(), size=4, depth_order="farthest", depth_format=None)
