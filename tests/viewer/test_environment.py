"""A turned environment against numpy: the direction of the turn, and the values between texels."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.environment import EnvironmentTurn, turned
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import random_faces
from tests.reference.sampling import sample_faces


def about_y(degrees):
    """The right-handed turn about +Y: +Z goes to +X."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@pytest.fixture
def cube():
    return cc.CubeMap(random_faces(np.random.default_rng(1), 8, 3, np.float32))


@pytest.mark.parametrize("degrees", [30, -75.5, 90, 180, 270, 359, 725])
def test_what_was_at_a_direction_is_at_the_turned_one(cube, degrees):
    got = turned(cube, degrees)
    directions = texel_directions(8)
    # The new texel at d shows what the old cube had at R^-1 d.
    want = sample_faces(cube.faces, directions @ about_y(degrees))
    assert np.abs(got.faces - want).max() < 1e-5


def test_at_90_degrees_z_is_at_x():
    faces = np.zeros((6, 4, 4, 1), np.float32)
    faces[4] = 1  # +Z
    got = turned(cc.CubeMap(faces), 90)
    lit = [[1, 0, 0], [0, 0, 1], [-1, 0, 0], [0, 0, -1], [0, 1, 0], [0, -1, 0]]
    assert np.allclose(got.sample(lit).ravel(), [1, 0, 0, 0, 0, 0], atol=1e-6)


def test_the_axis_is_plus_y_and_four_right_angles_are_a_whole_turn(cube):
    got = cube
    for _ in range(4):
        got = turned(got, 90)
    assert np.abs(got.faces - cube.faces).max() < 1e-5
    assert turned(cube, 0) is cube
    assert turned(cube, -720) is cube


@pytest.mark.parametrize("dtype", [np.uint8, np.float16, np.float32])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_kind_of_numbers_stays(dtype, channels):
    faces = random_faces(np.random.default_rng(2), 4, channels, dtype)
    before = cc.CubeMap(faces, mipmaps=True)
    after = turned(before, 90)
    assert (after.dtype, after.channels, after.size) == (before.dtype, channels, 4)
    assert (after.mipmaps, after.encoding) == (before.mipmaps, before.encoding)
    want = sample_faces(before.faces, texel_directions(4) @ about_y(90))
    scale = 255 if dtype == np.uint8 else 1
    step = {np.uint8: 0.51, np.float16: 2e-3, np.float32: 1e-5}[dtype]
    assert np.abs(after.faces.astype(float) - want * scale).max() <= step


@pytest.mark.parametrize("degrees", [float("nan"), float("inf")])
def test_angles_that_are_none(cube, degrees):
    with pytest.raises(ValueError, match="degrees: expected a finite number, got"):
        turned(cube, degrees)


def test_every_turn_starts_from_the_first_cube(cube):
    scene = cc.Scene(environment=cube)
    turn = EnvironmentTurn(scene)
    for degrees in (10, 25, 40):
        turn.degrees = degrees
    assert scene.environment == turned(cube, 40)
    assert turn.degrees == 40
    turn.degrees = 0
    assert scene.environment is cube


def test_a_background_turns_if_it_is_the_same_cube(cube):
    other = cc.CubeMap(cube.faces + 1)
    for background, turns in ((cube, True), (other, False), (None, False)):
        scene = cc.Scene(environment=cube, background=background)
        EnvironmentTurn(scene).degrees = 30
        assert (scene.background is scene.environment) == turns
        if not turns:
            assert scene.background is background


def test_an_environment_that_a_program_sets_is_a_new_start(cube):
    scene = cc.Scene(environment=cube)
    turn = EnvironmentTurn(scene)
    turn.degrees = 30
    scene.environment = other = cc.CubeMap(cube.faces + 1)
    assert turn.degrees == 0
    turn.degrees = 90
    assert scene.environment == turned(other, 90)
    scene.environment = None
    turn.degrees = 50
    assert scene.environment is None
    assert turn.degrees == 0


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
