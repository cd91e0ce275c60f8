"""The turn of a scene's environment about +Y: its direction, its range, and what it leaves alone."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.environment import EnvironmentTurn
from tests.reference.pattern import random_faces
from tests.reference.transforms import rotation


def about_y(degrees):
    """The right-handed turn about +Y: +Z goes to +X."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@pytest.fixture
def cube():
    return cc.CubeMap(random_faces(np.random.default_rng(1), 8, 3, np.float32))


@pytest.mark.parametrize("degrees", [0, 30, -75.5, 90, 180, 270, 359, 725])
def test_the_turn_is_a_rotation_about_y(degrees):
    scene = cc.Scene()
    turn = EnvironmentTurn(scene)
    for before in (10, -170, degrees):  # each turn starts from 0, not from the last turn
        turn.degrees = before
    got = rotation(scene.environment_rotation)[:3, :3]
    np.testing.assert_allclose(got, about_y(degrees), atol=1e-12)
    assert -180 <= turn.degrees <= 180
    assert (turn.degrees - degrees) % 360 == pytest.approx(0, abs=1e-9) or (
        turn.degrees - degrees
    ) % 360 == pytest.approx(360, abs=1e-9)


def test_a_tilt_stays():
    tilt = cc.axis_angle((1, 0, 0.5), 40)
    scene = cc.Scene(environment_rotation=tilt)
    turn = EnvironmentTurn(scene)
    assert turn.degrees == pytest.approx(0, abs=1e-9)
    turn.degrees = 120
    want = about_y(120) @ rotation(tilt)[:3, :3]
    np.testing.assert_allclose(rotation(scene.environment_rotation)[:3, :3], want, atol=1e-12)
    turn.degrees = 0
    np.testing.assert_allclose(scene.environment_rotation, tilt, atol=1e-12)


def test_an_angle_that_is_none_is_an_error(cube):
    scene = cc.Scene(environment=cube, background=cube)
    with pytest.raises(ValueError, match="finite"):
        EnvironmentTurn(scene).degrees = float("nan")
    assert scene.environment_rotation.tolist() == [1, 0, 0, 0]
    assert scene.background is cube


def test_a_background_turns_if_it_is_the_same_cube(cube):
    other = cc.CubeMap(cube.faces + 1)
    for background, left in ((cube, None), (other, other), (None, None)):
        scene = cc.Scene(environment=cube, background=background)
        EnvironmentTurn(scene).degrees = 30
        assert scene.environment is cube
        assert scene.background is left


def test_a_picture_turns_with_the_environment(cube):
    """A camera that is turned as well sees the same sky."""
    camera = cc.PerspectiveCamera(fov=50, target=(0, 0, -1))
    scene = cc.Scene(environment=cube)
    with cc.Renderer() as renderer:
        before = renderer.render(scene, camera, (32, 32), format="rgba32f").color
        EnvironmentTurn(scene).degrees = 90
        camera.target = about_y(90) @ (0, 0, -1)
        after = renderer.render(scene, camera, (32, 32), format="rgba32f").color
    assert np.abs(before - after).max() < 1e-4
