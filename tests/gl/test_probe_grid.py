"""ProbeGrid: the light of a grid on surfaces, against numpy, and what a bake captures, against what is known."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import probe_grid as reference
from tests.compare import assert_identical

SIZE = (72, 44)
BOX = np.array([(-1.5, -1, -1), (1.5, 1.5, 1)])
COUNTS = (4, 3, 3)
SKY = 0.3
MATERIALS = {
    "own": lambda: cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment_irradiance(s.normal); }"
    ),
    "matt": lambda: cc.StandardMaterial(
        color=(1, 1, 1), metallic=0, specular_weight=0, roughness=1
    ),
}


def random_grid(**options):
    rng = np.random.default_rng(6)
    grid = cc.ProbeGrid(BOX, COUNTS, resolution=8, **options)
    light = rng.uniform(-0.4, 0.4, grid.coefficients.shape)
    light[..., 0, :] = rng.uniform(1, 5, light[..., 0, :].shape)
    mean = rng.uniform(0.4, 2, grid.distances.shape[:-1])
    grid.coefficients = light
    grid.distances = np.stack([mean, mean**2 + rng.uniform(0.01, 0.3, mean.shape)], axis=-1)
    grid.active = rng.random(grid.active.shape) < 0.8
    return grid


def world(material, grid):
    scene = cc.Scene(background=(0, 0, 0))
    scene.environment = cc.CubeMap(np.full((6, 4, 4, 3), SKY, np.float32))
    scene.probe_grid = grid
    for mesh, place in (
        (cc.Mesh.icosphere(0.8, subdivisions=3), (0.3, 0.2, 0)),
        (cc.Mesh.box(0.9), (-1.2, -0.2, 0.3)),
        (cc.Mesh.box(0.7), (2.9, 0.5, 0)),
    ):
        scene.add(mesh, material, position=place)
    return scene


def expected(frame, camera, grid):
    on = frame.outputs["id"] > 0
    at, normals = (frame.outputs[name][on].astype(float) for name in ("position", "normal"))
    incident = at - camera.position
    incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
    want = reference.irradiance(
        at,
        normals,
        incident,
        grid.box[0],
        grid.box[1],
        grid.coefficients,
        grid.distances,
        grid.active,
        normal_bias=grid.normal_bias,
        view_bias=grid.view_bias,
        visibility=grid.visibility,
        around=SKY,
    )
    return on, want


@pytest.mark.parametrize("visibility", [True, False])
@pytest.mark.parametrize("kind", MATERIALS)
def test_surfaces_have_the_light_of_numpy(any_path, kind, visibility):
    grid = random_grid(visibility=visibility, normal_bias=0.2, view_bias=0.15)
    scene = world(MATERIALS[kind](), grid)
    camera = cc.PerspectiveCamera(position=(0.7, 1, 4), target=(0.2, 0.1, 0), fov=50)
    frame = any_path.render(
        scene, camera, SIZE, format="rgba32f", outputs=("position", "normal", "id")
    )
    on, want = expected(frame, camera, grid)
    got = frame.color[on][:, :3]
    assert on.sum() > 300
    off = np.abs(got - want).max(axis=-1)
    assert np.quantile(off, 0.99) < 2e-3
    assert off.max() < 0.05  # where a weight is on the other side of a limit
    outside = frame.outputs["position"][on][:, 0] > 1.5 + 2
    assert not outside.any() or np.abs(got[outside] - SKY).max() < 1e-3
    assert (frame.outputs["position"][on][:, 0] > 1.5 + 1.2).sum() > 20


def test_the_grid_lights_captures_probes_and_blends_alike(any_path):
    grid = random_grid()
    scene = world(MATERIALS["own"](), grid)
    cube = any_path.capture(
        scene, (0, 0, 2.4), 20, format="rgba32f", outputs=("position", "normal", "id")
    )
    on = cube.outputs["id"] > 0
    at, normals = (cube.outputs[name][on].astype(float) for name in ("position", "normal"))
    incident = at - (0, 0, 2.4)
    incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
    want = reference.irradiance(
        at,
        normals,
        incident,
        BOX[0],
        BOX[1],
        grid.coefficients,
        grid.distances,
        grid.active,
        around=SKY,
    )
    assert np.quantile(np.abs(cube.faces[on][:, :3] - want).max(axis=-1), 0.98) < 3e-3
    # Whatever environments a node blends: their irradiance does not count within the grid.
    ball = scene.nodes[0]
    before = any_path.capture(scene, (0, 0, 2.4), 20).faces
    ball.environment = cc.ProbeBlend([cc.Probe(size=8, influence=((0, -2, -2), (2, 2, 2)))])
    after = any_path.capture(scene, (0, 0, 2.4), 20).faces
    assert np.abs(before - after).max() < 2e-3


def test_a_white_sky_gives_its_own_light(renderer):
    scene = cc.Scene(background=(0.5, 1, 2))
    grid = cc.ProbeGrid(BOX, (2, 2, 2), size=8)
    grid.bake(renderer, scene)
    want = np.zeros((9, 3))
    want[0] = np.sqrt(4 * np.pi) * np.array([0.5, 1, 2])
    assert np.abs(grid.coefficients - want).max() < 1e-4
    assert grid.active.all()
    assert scene.probe_grid is None


def test_bounces_add_what_walls_reflect(renderer):
    """A closed room whose walls shine alike: after k bounces the light is e (1 + a + ... + a^(k - 1))."""
    shine, albedo = 0.4, 0.5
    scene = cc.Scene()
    walls = cc.StandardMaterial(
        color=(albedo,) * 3,
        emissive=(shine,) * 3,
        metallic=0,
        specular_weight=0,
        roughness=1,
        double_sided=True,
    )
    scene.add(cc.Mesh.box(1), walls, scale=(4, 3, 3))
    grid = cc.ProbeGrid(((-1, -1, -1), (1, 1, 1)), (2, 2, 2), size=8)
    light = shine
    for bounces in (1, 2, 3):
        grid.bake(renderer, scene, bounces=bounces)
        got = grid.coefficients[..., 0, :] / np.sqrt(4 * np.pi)
        np.testing.assert_allclose(got, light, rtol=5e-3)
        light = shine + albedo * light


def two_rooms():
    """A bright and a dark room with a thin wall between them, at x = 0."""
    scene = cc.Scene()
    white: dict[str, Any] = {
        "metallic": 0,
        "specular_weight": 0,
        "roughness": 1,
        "double_sided": True,
    }
    matt = cc.StandardMaterial(color=(0.7, 0.7, 0.7), **white)
    scene.add(cc.Mesh.box(1), matt, scale=(6, 2, 3))
    scene.add(cc.Mesh.box(1), matt, scale=(0.05, 2, 3))
    lamp = cc.StandardMaterial(color=(0, 0, 0), emissive=(3, 3, 3), **white)
    scene.add(cc.Mesh.box(1), lamp, position=(1.6, 0.99, 0), scale=(1, 0.02, 1))
    scene.probe_grid = cc.ProbeGrid(
        ((-2.6, -0.7, -1.2), (2.6, 0.7, 1.2)), (6, 3, 3), size=16, resolution=12
    )
    return scene


def test_light_does_not_leak_through_a_thin_wall(renderer):
    scene = two_rooms()
    scene.probe_grid.bake(renderer, scene, bounces=2)
    means = {}
    for visibility in (False, True):
        scene.probe_grid.visibility = visibility
        for side in (-1, 1):  # the dark room, the bright one
            camera = cc.PerspectiveCamera(
                position=(side * 1.2, 0, 1.3), target=(side * 0.3, -0.2, -0.6), fov=70
            )
            picture = renderer.render(scene, camera, SIZE, format="rgba32f").color[..., :3]
            means[visibility, side] = float(picture.mean())
    assert means[True, 1] > 0.1
    assert means[False, -1] > 0.1 * means[False, 1]  # it leaks
    assert means[True, -1] < 0.01 * means[True, 1]
    assert means[True, -1] < 0.05 * means[False, -1]


def test_nodes_in_bodies_do_not_count(renderer):
    scene = cc.Scene(background=(1, 1, 1))
    scene.add(
        cc.Mesh.box(1),
        cc.StandardMaterial(color=(0, 0, 0), metallic=0, specular_weight=0),
        position=(1, 0, 0),
    )
    grid = cc.ProbeGrid(((-1, -0.2, -0.2), (1, 0.2, 0.2)), (3, 2, 2), size=8)
    grid.bake(renderer, scene)
    np.testing.assert_array_equal(grid.active[..., 2], False)
    np.testing.assert_array_equal(grid.active[..., :2], True)
    # They have the light of those beside them, where nothing else counts.
    np.testing.assert_allclose(grid.coefficients[..., 2, :, :], grid.coefficients[..., 1, :, :])


def test_a_change_redraws_what_the_grid_lights_and_nothing_else(fresh_renderer):
    grid = random_grid()
    scene = world(MATERIALS["matt"](), grid)
    camera = cc.PerspectiveCamera(position=(0.7, 1, 4), target=(0.2, 0.1, 0), fov=50)

    def drawn():
        fresh_renderer.render(scene, camera, SIZE, format="rgba32f")
        return fresh_renderer.stats.views_drawn

    assert (drawn(), drawn()) == (1, 0)
    grid.normal_bias = 0.4
    assert (drawn(), drawn()) == (1, 0)
    grid.coefficients = grid.coefficients * 2
    assert (drawn(), drawn()) == (1, 0)
    grid.coefficients = grid.coefficients
    assert drawn() == 0
    scene.probe_grid = None
    assert drawn() == 1
    scene.probe_grid = grid
    assert drawn() == 1
    here = fresh_renderer.render(scene, camera, SIZE, format="rgba32f").color
    with cc.Renderer() as other:
        assert_identical(other.render(scene, camera, SIZE, format="rgba32f").color, here)
    for node in scene.nodes:
        node.material = cc.MirrorMaterial()
    drawn()
    grid.view_bias = 0.4
    assert drawn() == 0


def test_a_bake_that_is_interrupted_leaves_the_grid_as_it_was(renderer):
    scene = cc.Scene(background=(1, 1, 1))
    grid = random_grid()
    before = grid.coefficients, grid.distances, grid.active
    calls = []

    def stop(done, total):
        calls.append((done, total))
        if done == 40:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        grid.bake(renderer, scene, progress=stop)
    assert calls[-1] == (40, 72)
    for old, new in zip(before, (grid.coefficients, grid.distances, grid.active), strict=True):
        np.testing.assert_array_equal(old, new)
