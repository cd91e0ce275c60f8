"""Orbit, first person and fly against numpy: what a drag, a wheel, a pinch and a key do to the camera."""

import math

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.controls import Controls, FirstPerson, Fly, Orbit, make_controls

SIZE = (600.0, 400.0)


def camera():
    return cc.PerspectiveCamera(position=(1, 2, 5), target=(0, 0.5, -1), fov=60)


def event(kind, **fields):
    return {"event_type": kind, "modifiers": (), "buttons": (1,), "button": 1, **fields}


def drag(controls, seen, start, end, **fields):
    controls.handle(event("pointer_down", x=start[0], y=start[1], **fields), seen, SIZE)
    changed = controls.handle(event("pointer_move", x=end[0], y=end[1], **fields), seen, SIZE)
    controls.handle(event("pointer_up", x=end[0], y=end[1], **fields), seen, SIZE)
    return changed


def rotation(axis, degrees):
    """Rodrigues' formula as a matrix."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(degrees)
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def test_a_drag_orbits_a_full_turn_for_the_height_of_the_picture():
    seen = camera()
    before, target = seen.position, seen.target
    assert drag(Orbit(), seen, (300, 200), (350, 180))
    turned = rotation((0, 1, 0), -360 * 50 / 400) @ (before - target)
    # A drag upwards lowers the camera: elevation -18 degrees, in the plane of the direction and up.
    axis = np.cross(turned, (0, 1, 0))
    expected = target + rotation(axis, 360 * -20 / 400) @ turned
    np.testing.assert_allclose(seen.position, expected, atol=1e-9)
    np.testing.assert_array_equal(seen.target, target)


@pytest.mark.parametrize("how", [{"button": 2, "buttons": (2,)}, {"modifiers": ("Shift",)}])
def test_what_lies_at_the_pivot_follows_a_pan(how):
    seen = camera()
    pivot = seen.target
    assert drag(Orbit(), seen, (300, 200), (360, 230), **how)
    matrix = seen.projection(SIZE[0] / SIZE[1]) @ seen.view
    clip = matrix @ [*pivot, 1]
    place = (clip[:2] / clip[3] * [1, -1] + 1) / 2 * SIZE
    np.testing.assert_allclose(place, [360, 230], atol=1e-3)


def test_the_wheel_doubles_the_distance_at_600_and_never_passes_the_pivot():
    seen, controls = camera(), Orbit()
    distance = np.linalg.norm(seen.position - seen.target)
    controls.handle(event("wheel", dx=0, dy=600, x=1, y=1), seen, SIZE)
    assert np.linalg.norm(seen.position - seen.target) == pytest.approx(2 * distance)
    controls.handle(event("wheel", dx=0, dy=-1e6, x=1, y=1), seen, SIZE)
    assert np.linalg.norm(seen.position - seen.target) == pytest.approx(1.01 * seen.near)


def test_two_fingers_pinch_and_pan():
    seen, controls = camera(), Orbit()
    distance = np.linalg.norm(seen.position - seen.target)
    two = {1: {"x": 200, "y": 200}, 2: {"x": 400, "y": 200}}
    apart = {1: {"x": 100, "y": 200}, 2: {"x": 500, "y": 200}}
    controls.handle(event("pointer_down", x=200, y=200, touches=two), seen, SIZE)
    assert controls.handle(event("pointer_move", x=100, y=200, touches=apart), seen, SIZE)
    assert np.linalg.norm(seen.position - seen.target) == pytest.approx(distance / 2)
    target = seen.target
    moved = {key: {"x": at["x"] + 10, "y": 200} for key, at in apart.items()}
    controls.handle(event("pointer_move", x=110, y=200, touches=moved), seen, SIZE)
    assert np.linalg.norm(seen.target - target) == pytest.approx(
        10 / 400 * distance * math.tan(math.radians(30)), rel=1e-6
    )
    # One finger is lifted: the other does not turn the scene by a jump.
    position = seen.position
    one = {2: moved[2]}
    controls.handle(event("pointer_up", x=110, y=200, touches=moved), seen, SIZE)
    controls.handle(event("pointer_move", x=400, y=300, touches=one), seen, SIZE)
    np.testing.assert_array_equal(seen.position, position)


def test_first_person_looks_where_the_drag_points():
    seen = camera()
    position = seen.position
    gaze = (seen.target - position) / np.linalg.norm(seen.target - position)
    assert drag(FirstPerson(), seen, (0, 0), (40, 0))
    expected = rotation((0, 1, 0), 60 * 40 / 400) @ gaze
    np.testing.assert_allclose(
        (seen.target - position) / np.linalg.norm(seen.target - position), expected, atol=1e-9
    )
    np.testing.assert_array_equal(seen.position, position)


def test_first_person_looks_up_when_the_scene_is_dragged_down():
    seen = cc.PerspectiveCamera(position=(1, 2, 5), target=(1, 2, 3), fov=60)
    assert drag(FirstPerson(), seen, (0, 0), (0, 40))
    up = math.radians(60 * 40 / 400)
    assert seen.target is not None
    gaze = (seen.target - seen.position) / np.linalg.norm(seen.target - seen.position)
    np.testing.assert_allclose(gaze, (0, math.sin(up), -math.cos(up)), atol=1e-9)


@pytest.mark.parametrize(
    ("key", "move"),
    [
        ("w", (0, 0, -0.1)),
        ("s", (0, 0, 0.1)),
        ("a", (-0.1, 0, 0)),
        ("d", (0.1, 0, 0)),
        ("ArrowUp", (0, 0, -0.1)),
        ("ArrowRight", (0.1, 0, 0)),
        ("W", (0, 0, -0.1)),
    ],
)
def test_a_key_walks_a_tenth(key, move):
    seen, controls = cc.PerspectiveCamera(), FirstPerson()
    assert controls.handle(event("key_down", key=key), seen, SIZE)
    np.testing.assert_allclose(seen.position, move, atol=1e-12)
    assert not controls.handle(event("key_down", key=key), seen, SIZE)  # the keyboard repeats
    controls.handle(event("key_up", key=key), seen, SIZE)
    assert controls.handle(event("key_down", key=key), seen, SIZE)
    np.testing.assert_allclose(seen.position, 2 * np.array(move), atol=1e-12)


def test_a_held_key_goes_on_until_it_is_let_go(monkeypatch):
    seen, controls = cc.PerspectiveCamera(), Fly()
    monkeypatch.setattr("time.monotonic", lambda: 100.0)
    controls.handle(event("key_down", key="e"), seen, SIZE)
    assert not controls.tick(100.2, seen)
    assert controls.tick(100.31, seen)
    assert controls.tick(100.37, seen)
    np.testing.assert_allclose(seen.position, (0, 0.3, 0), atol=1e-9)
    controls.handle(event("key_up", key="e"), seen, SIZE)
    assert not controls.tick(200.0, seen)


def test_shift_is_five_times_as_fast_and_control_does_nothing():
    seen = cc.PerspectiveCamera()
    FirstPerson().handle(event("key_down", key="W", modifiers=("Shift",)), seen, SIZE)
    np.testing.assert_allclose(seen.position, (0, 0, -0.5), atol=1e-12)
    assert not FirstPerson().handle(event("key_down", key="w", modifiers=("Control",)), seen, SIZE)


def test_a_drag_that_ended_outside_is_over():
    seen, controls = camera(), Orbit()
    position = seen.position
    controls.handle(event("pointer_down", x=10, y=10), seen, SIZE)
    assert not controls.handle(event("pointer_move", x=50, y=50, buttons=()), seen, SIZE)
    assert not controls.handle(event("pointer_move", x=90, y=90, buttons=()), seen, SIZE)
    np.testing.assert_array_equal(seen.position, position)


def test_a_parallel_camera_zooms_by_its_height():
    seen = cc.OrthographicCamera(height=4, position=(0, 0, 3), target=(0, 0, 0))
    Orbit().handle(event("wheel", dx=0, dy=-600, x=1, y=1), seen, SIZE)
    assert seen.height == pytest.approx(2)
    drag(Orbit(), seen, (0, 0), (200, 0), button=2, buttons=(2,))
    assert seen.target is not None
    np.testing.assert_allclose(seen.target, (-1, 0, 0), atol=1e-9)


def test_names_of_controls():
    assert isinstance(make_controls("fly"), Fly)
    mine = Controls()
    assert make_controls(mine) is mine
    with pytest.raises(ValueError, match=r'expected "orbit", "first_person" or "fly", got .walk.'):
        make_controls("walk")
