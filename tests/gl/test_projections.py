"""Captures with turned axes, and projections beside what the renderer draws."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import direction_pattern

TURN = cc.axis_angle((1, 2, -0.5), 40)


@pytest.fixture
def scene():
    scene = cc.Scene(environment=cc.CubeMap(direction_pattern(64)))
    scene.add(cc.PointLight(position=(0.3, 2, 0.5)))
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(color=(1, 0.4, 0.2)), position=(0.5, 0.3, -3))
    scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(2, 0, 2))
    scene.add(cc.Mesh.plane(8, 8), cc.PhongMaterial(color=(0.4, 0.5, 1)), position=(0, -1, 0))
    return scene


def matrix_of(rotation):
    node = cc.Scene().add(cc.Mesh.box(1), rotation=rotation)
    return node.matrix[:3, :3]


def test_a_turned_capture_shows_the_scene_in_its_own_axes(renderer, scene):
    """What the world shows in R d, the cube shows in d; world vectors stay world vectors."""
    outputs = ("distance", "z", "normal", "position", "id")
    plain = renderer.capture(scene, size=128, outputs=outputs)
    turned = renderer.capture(scene, size=128, outputs=outputs, rotation=TURN)
    directions = texel_directions(128)
    world = directions @ matrix_of(TURN).T
    expected_id = plain.sample(world, output="id")
    same = expected_id == turned.id
    assert same.mean() > 0.98
    for output in ("distance", "position", "normal"):
        expected = plain.sample(world, output=output)
        got = turned.outputs[output]
        error = np.abs(got[same & (expected_id > 0)] - expected[same & (expected_id > 0)])
        assert np.quantile(error, 0.95) < 0.1
    # The ray of a texel is the distance along its axis times a length that the texel alone gives.
    seen = np.isfinite(turned.distance)
    lengths = np.linalg.norm(directions, axis=-1)
    np.testing.assert_allclose(turned.distance[seen], (turned.z * lengths)[seen], rtol=1e-4)
    # Positions lie on the rays.
    unit = world / lengths[..., None]
    np.testing.assert_allclose(
        turned.position[seen], (unit * turned.distance[..., None])[seen], atol=2e-2
    )


def test_a_turned_capture_turned_back_is_the_plain_one(renderer, scene):
    plain = renderer.capture(scene, size=64, outputs=("z", "id", "distance"))
    quarter = cc.axis_angle((0, 1, 0), 90)
    turned = renderer.capture(scene, size=64, outputs=("z", "id", "distance"), rotation=quarter)
    again = turned.rotate(quarter)
    # Triangles are snapped to 1/256 pixel on other faces: silhouettes may move by a texel.
    assert (again.id == plain.id).mean() > 0.99
    assert np.quantile(np.abs(again.faces - plain.faces), 0.97) < 0.01
    arbitrary = renderer.capture(scene, size=64, outputs=("z", "id", "distance"), rotation=TURN)
    back = arbitrary.rotate(TURN)
    assert (back.id == plain.id).mean() > 0.97
    same = (back.id == plain.id) & (plain.id > 0)
    assert np.quantile(np.abs(back.z[same] / plain.z[same] - 1), 0.9) < 0.05


def test_no_rotation_is_the_identity(renderer, scene):
    plain = renderer.capture(scene, size=32)
    assert renderer.capture(scene, size=32, rotation=(1, 0, 0, 0)) == plain
    assert renderer.capture(scene, size=32, rotation=(-3, 0, 0, 0)) == plain
    assert renderer.capture(scene, size=32, rotation=TURN) != plain


def test_a_turned_capture_is_not_the_kept_picture(renderer, scene):
    renderer.capture(scene, size=32)
    turned = renderer.capture(scene, size=32, rotation=TURN)
    with cc.Renderer() as other:
        assert other.capture(scene, size=32, rotation=TURN) == turned
    renderer.capture(scene, size=32, rotation=TURN)
    assert renderer.stats.views_drawn == 0


@pytest.mark.parametrize("bad", [(0, 0, 0, 0), (1, 0, 0), (np.nan, 0, 0, 1), "left"])
def test_bad_rotations_are_refused(renderer, scene, bad):
    with pytest.raises((ValueError, TypeError), match="rotation"):
        renderer.capture(scene, size=8, rotation=bad)


def test_a_mirror_ball_is_what_the_renderer_draws(renderer):
    """A sphere that mirrors the cube, seen by parallel rays."""
    cube = cc.CubeMap(direction_pattern(128))
    scene = cc.Scene(environment=cube, background=(0, 0, 0, 0))
    scene.add(cc.Mesh.icosphere(1, 6), cc.MirrorMaterial())
    for direction in ((0, 0, -1), (1, 0.3, 0.2)):
        away = -3 * np.asarray(direction) / np.linalg.norm(direction)
        camera = cc.OrthographicCamera(height=2, position=away, target=(0, 0, 0))
        frame = renderer.render(scene, camera, size=(200, 200), format="rgba32f")
        ball = cube.to_mirror_ball(200, direction=direction)
        rows, columns = np.indices((200, 200)) + 0.5
        inner = np.hypot(rows - 100, columns - 100) < 85
        assert_close(frame.color[..., :3], ball, "mirror_ball", mask=inner)


def test_a_perspective_is_what_a_camera_sees(renderer):
    cube = cc.CubeMap(direction_pattern(128))
    scene = cc.Scene(background=cube)
    camera = cc.PerspectiveCamera(fov=65, position=(0, 0, 0), target=(1, 0.4, -0.3))
    frame = renderer.render(scene, camera, size=(160, 90), format="rgba32f")
    picture = cube.to_perspective(65, (160, 90), direction=(1, 0.4, -0.3))
    assert_close(frame.color[..., :3], picture, "window")
