"""What pictures of models are made with: the camera that sees all, the lamp of an environment, the ground's shadow."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam._nodes import shown_nodes
from cubecam.staging.fit import axes_towards, fit_camera, fit_turntable
from cubecam.staging.ground import Ground
from cubecam.staging.lamp import directions_of_light, sky_irradiance, split_lamp, texels
from cubecam.staging.stage import exposure_for
from tests.compare import assert_close

VIEWS = [(0, 0), (30, 15), (-100, 60), (180, -40), (77, 89)]
ASPECTS = [1, 16 / 9, 0.3]


def model():
    """A tall head beside a flat disc that is turned, in a group that is scaled and hides a far thing."""
    scene = cc.Scene()
    group = scene.add(position=(3, -2, 5), scale=(1, 2, 0.5), rotation=cc.axis_angle((1, 2, 3), 40))
    scene.add(cc.load_mesh(cc.sample_data("suzanne.glb")), parent=group)
    scene.add(cc.Mesh.cylinder(2, 0.1), parent=group, rotation=cc.axis_angle((0, 0, 1), 70))
    hidden = scene.add(cc.Mesh.sphere(1), position=(50, 0, 0))
    hidden.visible = False
    return scene


def projected(camera, nodes, aspect):
    """The vertices in the picture, x and y from -1 to 1, and their depth, by a pinhole camera."""
    away = camera.position - camera.target
    away /= np.linalg.norm(away)
    right = np.cross((0, 1, 0), away)
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(away, right), away])
    half = np.tan(np.radians(camera.fov) / 2)
    found = []
    for node in nodes:
        points = node.mesh.positions @ node.world_matrix[:3, :3].T + node.world_matrix[:3, 3]
        seen = (points - camera.position) @ axes.T
        depth = -seen[:, 2]
        found.append(
            np.stack([seen[:, 0] / depth / half / aspect, seen[:, 1] / depth / half, depth], 1)
        )
    return np.concatenate(found)


@pytest.mark.parametrize("at", VIEWS)
@pytest.mark.parametrize("aspect", ASPECTS)
def test_the_camera_sees_all_and_two_borders_are_reached(at, aspect):
    nodes = shown_nodes(model())
    camera = fit_camera(nodes, at=at, aspect=aspect, margin=0.1)
    seen = projected(camera, nodes, aspect)
    assert (seen[:, 2] > camera.near).all()
    assert (seen[:, 2] < camera.far).all()
    reach = np.abs(seen[:, :2]).max(axis=0)
    assert reach.max() == pytest.approx(0.8, abs=1e-6)
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    wide = int(reach.argmax())
    assert -low[wide] == pytest.approx(high[wide], abs=1e-6)  # in the middle
    assert camera.target is not None
    away = (camera.position - camera.target) / np.linalg.norm(camera.position - camera.target)
    assert away == pytest.approx(axes_towards(*at)[2])


def test_azimuth_and_elevation():
    assert axes_towards(0, 0)[2] == pytest.approx([0, 0, 1])
    assert axes_towards(90, 0)[2] == pytest.approx([1, 0, 0])
    assert axes_towards(0, 89.999)[2] == pytest.approx([0, 1, 0], abs=1e-4)


@pytest.mark.parametrize("aspect", ASPECTS)
def test_a_turntable_sees_all_from_all_round(aspect):
    nodes = shown_nodes(model())
    camera = fit_turntable(nodes, at=(20, 25), aspect=aspect)
    widest = 0.0
    for _ in range(36):
        seen = float(np.abs(projected(camera, nodes, aspect)[:, :2]).max())
        assert seen <= 0.84 * 1.01
        widest = max(widest, seen)
        camera.orbit(yaw=10)
    assert widest > 0.75


def test_a_model_without_extent_is_refused():
    scene = cc.Scene()
    with pytest.raises(ValueError, match="expected a model with vertices that are shown, got none"):
        fit_camera(shown_nodes(scene), at=(0, 0), aspect=1)
    scene.add(cc.Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]])))
    with pytest.raises(ValueError, match="expected a model with an extent"):
        fit_camera(shown_nodes(scene), at=(0, 0), aspect=1)


@pytest.mark.parametrize("fit", [fit_camera, fit_turntable])
@pytest.mark.parametrize("size", [1e-6, 1, 2e4, 1e7])
def test_models_of_all_sizes_lie_between_the_clip_planes(fit, size):
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1), scale=size)
    camera = fit(shown_nodes(scene), at=(30, 15), aspect=4 / 3)
    depth = projected(camera, shown_nodes(scene), 4 / 3)[:, 2]
    assert camera.near < depth.min()
    assert depth.max() < camera.far


def test_moments_of_an_animation_are_all_seen():
    scene = cc.Scene()
    ball = scene.add(cc.Mesh.sphere(1))

    def moments():
        for x in (0, 5):
            ball.position = (x, 0, 0)
            yield

    camera = fit_camera([ball], at=(0, 0), aspect=1, moments=moments())
    assert camera.position[0] == pytest.approx(2.5, abs=1e-3)


def test_texels_cover_the_sphere_and_look_like_the_faces():
    directions, solid = texels(32)
    assert solid.sum() == pytest.approx(4 * np.pi, rel=1e-3)
    cube = cc.CubeMap(((directions + 1) / 2).astype(np.float32))
    assert_close(
        cube.sample(directions.reshape(-1, 3)), (directions.reshape(-1, 3) + 1) / 2, "lookup"
    )


def lamp_in_a_room(size=64, level=20.0):
    directions, solid = texels(size)
    towards = np.array([0.6, 0.64, 0.48])
    inside = directions @ towards > np.cos(np.radians(6))
    faces = np.full((6, size, size, 3), 0.5, np.float32)
    faces[inside] = (level, level / 2, level / 4)
    energy = ((faces[inside] - 0.5) * solid[inside][:, None]).sum(axis=0)
    return cc.CubeMap(faces), towards, energy


def test_the_lamp_becomes_a_light_of_the_same_irradiance():
    cube, towards, energy = lamp_in_a_room()
    split = split_lamp(cube)
    assert split.light is not None
    assert -split.light.direction == pytest.approx(towards, abs=0.01)
    assert split.light.color * split.light.intensity == pytest.approx(energy, rel=0.01)
    assert float(split.environment.faces.max()) == pytest.approx(0.5)
    up = np.array([0, 1, 0])
    lamp = (energy @ (0.2126, 0.7152, 0.0722)) * towards[1]
    before, after = sky_irradiance(cube, up), sky_irradiance(split.environment, up)
    assert before == pytest.approx(after + lamp, rel=0.02)
    assert after == pytest.approx(0.5 * np.pi, rel=0.01)


def test_even_light_has_no_lamp():
    cube = cc.CubeMap(np.full((6, 16, 16, 3), 0.5, np.float32))
    split = split_lamp(cube)
    assert split.light is None
    assert split.environment is cube
    assert exposure_for(cube) == pytest.approx(np.log2(0.6 / 0.5), abs=0.01)
    assert exposure_for(cube, 4) == pytest.approx(np.log2(0.6 / 2), abs=0.01)
    assert exposure_for(cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32))) == 0


def test_directions_share_the_light_of_the_ground():
    cube, towards, _ = lamp_in_a_room(level=200)
    found = directions_of_light(cube, 64)
    assert np.linalg.norm(found, axis=1) == pytest.approx(1)
    assert (found[:, 1] > 0).all()
    small = cube.resize(32)
    directions, solid = texels(32)
    share = (
        small.faces @ np.array([0.2126, 0.7152, 0.0722]) * solid * np.maximum(directions[..., 1], 0)
    )
    wanted = share[directions @ towards > np.cos(np.radians(9))].sum() / share.sum()
    assert np.mean(found @ towards > np.cos(np.radians(9))) == pytest.approx(wanted, abs=0.05)


def alpha_of(ground):
    material: Any = ground.node.material
    return material.map.pixels[..., 3]


def test_the_ground_loses_the_light_that_a_box_hides(renderer):
    """One light at 45 degrees: the shadow of a box of height 2 is 2 long, and black; it lies where the box stands."""
    scene = cc.Scene()
    box = scene.add(cc.Mesh.box(2), position=(0, 5, 0))
    ground = Ground(scene, [box], np.array([[1, 1, 0]]) / np.sqrt(2), texels=256)
    ground.update(renderer)
    assert ground.node.position[1] == pytest.approx(4, abs=0.01)
    lost = alpha_of(ground)
    steps = ((np.arange(256) + 0.5) / 256 - 0.5) * ground.side
    x, z = np.meshgrid(steps, steps)
    inside = (np.abs(z) < 0.85) & (x > -2.85) & (x < 0.85)
    outside = (np.abs(z) > 1.15) | (x > 1.15) | (x < -3.15)
    assert (lost[inside] > 0.99).all()
    assert (lost[outside] < 0.01).all()
    assert ground.node.visible


def test_a_shadow_is_not_mirrored(renderer):
    """A high box at +Z and a low one at -Z, light from +X: the shadow at +Z is the longer one."""
    scene = cc.Scene()
    boxes = [
        scene.add(cc.Mesh.box((1, height, 1)), position=(0, height / 2, z))
        for height, z in ((3, 2), (0.5, -2))
    ]
    ground = Ground(scene, boxes, np.array([[1, 1, 0]]) / np.sqrt(2), texels=256)
    ground.update(renderer)
    dark = alpha_of(ground) > 0.5
    rows = [int((1 - 2 * (0.5 - z / ground.side)) * 128 + 128) for z in (2, -2)]
    lengths = [dark[row].sum() * ground.side / 256 for row in rows]
    assert lengths == pytest.approx([4, 1.5], abs=0.2)


def test_the_ground_fades_and_does_not_hide_from_below(renderer):
    scene = cc.Scene(background=(1, 1, 1))
    box = scene.add(cc.Mesh.box((1, 0.001, 1)), cc.BasicMaterial(color="red"))
    ground = Ground(scene, [box], np.array([[0.0, 1, 0]]))
    ground.update(renderer)
    assert alpha_of(ground)[[0, -1]].max() == 0
    below = fit_camera([box], at=(0, -60), aspect=1)
    picture = renderer.render(scene, below, (32, 32)).color
    assert (picture[0, 0, :3] == 255).all()
