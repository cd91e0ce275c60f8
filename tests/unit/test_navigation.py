"""Camera movements against rotation matrices in numpy; signs, poles, what stays the same, what is refused."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam import navigation
from cubecam.truth.shading import normalised
from tests.reference.transforms import look_at

EYE, TARGET, UP = (1.0, 2.0, 5.0), (0.5, 0.2, -1.0), (0.1, 1.0, 0.2)
CAMERAS: dict[str, Callable[..., Any]] = {
    "perspective": lambda **more: cc.PerspectiveCamera(
        **{"position": EYE, "target": TARGET, "up": UP, **more}
    ),
    "orthographic": lambda **more: cc.OrthographicCamera(
        **{"position": EYE, "target": TARGET, "up": UP, **more}
    ),
}
cameras = pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
VERBS = ("yaw", "pitch", "walk", "strafe", "orbit", "look")


def rx(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


def ry(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def about(axis, degrees):
    """Rotation matrix about any axis, counter-clockwise seen with the axis pointing at the viewer."""
    x, y, z = normalised(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array(
        [
            [c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)],
        ]
    )


def close(got, want):
    np.testing.assert_allclose(got, want, rtol=1e-12, atol=1e-12)


def same(camera, position, target):
    close(camera.position, position)
    close(camera.target, target)
    close(camera.view, look_at(position, target, camera.up))


def elevation(direction, up):
    return math.degrees(math.asin(float(normalised(direction) @ normalised(up))))


@cameras
@pytest.mark.parametrize("degrees", [30, -75.5, 180, 400, 1e-3])
def test_yaw(make, degrees):
    camera = make()
    camera.yaw(degrees)
    offset = np.subtract(TARGET, EYE)
    same(camera, EYE, EYE + about(UP, degrees) @ offset)


def test_yaw_is_to_the_left():
    camera = cc.PerspectiveCamera(position=(0, 0, 0), target=(0, 0, -3))
    camera.yaw(90)
    close(camera.target, (-3, 0, 0))


@cameras
@pytest.mark.parametrize("degrees", [20, -35])
def test_pitch(make, degrees):
    camera = make()
    camera.pitch(degrees)
    offset = np.subtract(TARGET, EYE)
    right = np.cross(offset, UP)
    same(camera, EYE, EYE + about(right, degrees) @ offset)


def test_pitch_is_upwards():
    camera = cc.PerspectiveCamera(position=(0, 0, 0), target=(0, 0, -2))
    camera.pitch(30)
    close(camera.target, (0, 1, -math.sqrt(3)))


@cameras
@pytest.mark.parametrize("sign", [1, -1])
def test_pitch_stops_a_degree_before_the_poles_and_comes_back(make, sign):
    camera = make()
    right = camera.view[0, :3]
    for _ in range(5):
        camera.pitch(sign * 70)
    assert elevation(camera.target - camera.position, UP) == pytest.approx(sign * 89)
    assert navigation.POLE_MARGIN == 1
    close(camera.view[0, :3], right)  # the camera never passes the pole, so right stays right
    close(np.linalg.norm(camera.target - camera.position), np.linalg.norm(np.subtract(TARGET, EYE)))
    camera.pitch(-sign * 10)
    assert elevation(camera.target - camera.position, UP) == pytest.approx(sign * 79)


def test_a_camera_that_is_nearer_to_the_pole_is_not_pulled_away():
    steep = (math.cos(math.radians(89.6)), math.sin(math.radians(89.6)), 0)
    camera = cc.PerspectiveCamera(position=(0, 0, 0), target=steep)
    camera.pitch(5)
    close(camera.target, steep)
    camera.pitch(-2)
    assert elevation(camera.target, (0, 1, 0)) == pytest.approx(87.6)


@cameras
@pytest.mark.parametrize("distance", [0.1, -0.1, 6.3, -50])
def test_walk(make, distance):
    camera = make()
    camera.walk(distance)
    step = distance * normalised(np.subtract(TARGET, EYE))
    same(camera, EYE + step, TARGET + step)


def test_walk_to_where_the_target_was():
    """Position and target never meet on the way."""
    for step in (3, -3, 1.5):
        camera = cc.PerspectiveCamera(position=(0, 0, 0), target=(0, 0, -3))
        camera.walk(step)
        same(camera, (0, 0, -step), (0, 0, -3 - step))


@cameras
@pytest.mark.parametrize("distance", [0.4, -7])
def test_strafe(make, distance):
    camera = make()
    camera.strafe(distance)
    step = distance * normalised(np.cross(np.subtract(TARGET, EYE), UP))
    same(camera, EYE + step, TARGET + step)


@cameras
@pytest.mark.parametrize("turn", [0, 25, -130])
@pytest.mark.parametrize("rise", [0, 15, -40])
def test_orbit(make, turn, rise):
    camera = make()
    camera.orbit(yaw=turn, pitch=rise)
    outward = about(UP, -turn) @ np.subtract(EYE, TARGET)
    # The axis points to the left of the camera, as `outward` points from the target to it.
    outward = about(np.cross(outward, UP), rise) @ outward
    same(camera, TARGET + outward, TARGET)


def test_orbit_turns_the_scene_with_the_drag():
    """After a drag to the right, the nearest point moves right in the picture; after a drag down, it moves down."""
    for drag, axis in (({"yaw": 10}, 0), ({"pitch": 10}, 1)):
        camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
        camera.orbit(**drag)
        seen = camera.view @ np.array([0, 0, 1, 1.0])  # the nearest point of a unit ball
        sign = 1 if axis == 0 else -1
        assert sign * seen[axis] > 0.1
    assert camera.position[1] > 0  # the camera has moved up


@pytest.mark.parametrize("sign", [1, -1])
def test_orbit_stops_before_the_poles(sign):
    camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
    camera.orbit(yaw=0, pitch=sign * 500)
    close(
        camera.position, (0, sign * 4 * math.sin(math.radians(89)), 4 * math.cos(math.radians(89)))
    )
    close(camera.view[0, :3], (1, 0, 0))


@cameras
def test_look(make):
    camera = make()
    camera.look((3, -1, 2))
    distance = np.linalg.norm(np.subtract(TARGET, EYE))
    same(camera, EYE, EYE + distance * normalised((3, -1, 2)))


@cameras
def test_without_a_target(make):
    """The view is along -Z; yaw, pitch and look set a target at distance 1, but walk and strafe set none."""
    camera = make(target=None, up=(0, 1, 0))
    camera.walk(2)
    camera.strafe(0.5)
    assert camera.target is None
    position = np.add(EYE, (0.5, 0, -2))
    close(camera.position, position)
    for verb, argument, direction in (
        ("yaw", 90, (-1, 0, 0)),
        ("pitch", 60, (0, math.sqrt(3) / 2, -0.5)),
        ("look", (0, 0, 7), (0, 0, 1)),
    ):
        camera.target = None
        getattr(camera, verb)(argument)
        same(camera, position, position + direction)
    camera.target = None
    with pytest.raises(
        ValueError, match="target: expected a camera with a target to orbit, got None"
    ):
        camera.orbit(yaw=10)


def test_the_document_s_drags_and_keys():
    """Ex10-2: direction = Rx(angleY) Ry(angleX) d, about the world's axes; the keys w and s move 0.1 along it."""
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, 1), near=1, far=15)
    angle_x = angle_y = 0.0
    where, first = np.zeros(3), np.array([0.0, 0, 1])
    events: list[str | tuple[float, float]] = [
        (30, 0),
        "w",
        "w",
        (0, 20),
        "w",
        (-75, 35),
        "s",
        (12, -80),
        "w",
        "w",
        "s",
        (100, 3),
        "w",
    ]
    for event in events:
        if not isinstance(event, str):
            angle_x, angle_y = angle_x + event[0], angle_y + event[1]
            camera.look(rx(angle_y) @ ry(angle_x) @ first)
        else:
            camera.walk({"w": 0.1, "s": -0.1}[event])
            where = where + {"w": 0.1, "s": -0.1}[event] * (rx(angle_y) @ ry(angle_x) @ first)
        direction = rx(angle_y) @ ry(angle_x) @ first
        close(camera.position, where)
        close(camera.view, look_at(where, where + direction))
    # The order of these turns matters: Ry Rx would give another direction.
    assert np.abs(direction - ry(angle_x) @ rx(angle_y) @ first).max() > 0.1


@pytest.mark.parametrize("verb", VERBS)
def test_functions_are_methods_and_give_nothing(verb):
    argument = (1, 2, 3) if verb == "look" else 2
    one, other = (cc.PerspectiveCamera(position=EYE, target=TARGET) for _ in range(2))
    given = ((), {"yaw": argument}) if verb == "orbit" else ((argument,), {})
    assert getattr(navigation, verb)(one, *given[0], **given[1]) is None
    assert getattr(other, verb)(*given[0], **given[1]) is None
    np.testing.assert_array_equal(one.view, other.view)
    assert not hasattr(cc, verb)


@pytest.mark.parametrize("verb", ["yaw", "pitch", "walk", "strafe", "orbit"])
def test_nothing_for_nothing(verb):
    """A movement by 0 changes no bit of the camera, so that no picture is drawn again."""
    camera = CAMERAS["perspective"]()
    given = ((), {"yaw": 0, "pitch": 0}) if verb == "orbit" else ((0,), {})
    getattr(camera, verb)(*given[0], **given[1])
    np.testing.assert_array_equal(camera.position, EYE)
    np.testing.assert_array_equal(camera.target, TARGET)


@pytest.mark.parametrize("number", [np.float32(10), np.int64(10), 10, 10.0])
def test_numbers_of_any_kind(number):
    camera, want = CAMERAS["perspective"](), CAMERAS["perspective"]()
    camera.yaw(number)
    want.yaw(10.0)
    np.testing.assert_array_equal(camera.view, want.view)


BAD = {
    "nan": (lambda c: c.yaw(np.nan), ValueError, "degrees: expected a finite number, got nan"),
    "inf": (lambda c: c.pitch(-np.inf), ValueError, "degrees: expected a finite number, got -inf"),
    "text": (lambda c: c.walk("far"), TypeError, "distance: expected float, got 'far'"),
    "bool": (lambda c: c.strafe(True), TypeError, "distance: expected float, got True"),
    "None": (lambda c: c.orbit(yaw=None), TypeError, "yaw: expected float, got None"),
    "second": (
        lambda c: c.orbit(yaw=1, pitch=np.nan),
        ValueError,
        "pitch: expected a finite number, got nan",
    ),
    "look nan": (
        lambda c: c.look((0, np.nan, 1)),
        ValueError,
        "direction: expected finite numbers",
    ),
    "look 0": (
        lambda c: c.look((0, 0, 0)),
        ValueError,
        "direction: expected a vector of a length other than 0",
    ),
    "look 2": (
        lambda c: c.look((1, 0)),
        ValueError,
        r"direction: expected three numbers, got shape \(2,\)",
    ),
    "look text": (lambda c: c.look("up"), TypeError, "direction: expected three numbers"),
    "look bool": (lambda c: c.look((True, False, False)), TypeError, "direction: .*bool"),
    "look up": (
        lambda c: c.look(UP),
        ValueError,
        "an up vector that is not along the line of sight",
    ),
    "beyond": (lambda c: c.walk(1e17), ValueError, "a target away from the position"),
    "matrices": (
        lambda c: navigation.yaw(cc.Camera(view=np.eye(4), projection=np.eye(4)), 1),  # type: ignore[arg-type]
        TypeError,
        "camera: expected a PerspectiveCamera or an OrthographicCamera, got Camera",
    ),
}


@pytest.mark.parametrize(("call", "error", "text"), BAD.values(), ids=BAD)
def test_what_is_refused_changes_nothing(call, error, text):
    camera = CAMERAS["perspective"]()
    with pytest.raises(error, match=text):
        call(camera)
    np.testing.assert_array_equal(camera.position, EYE)
    np.testing.assert_array_equal(camera.target, TARGET)


@cameras
def test_sizes_of_all_kinds(make):
    """Up vectors and distances may be tiny or huge: the directions do not depend on their length."""
    for scale in (1e-12, 1e-3, 1e12):
        camera = make(up=np.array(UP) * scale)
        want = make()
        for verb, argument in (("yaw", 33), ("pitch", 12), ("strafe", 0.3)):
            getattr(camera, verb)(argument)
            getattr(want, verb)(argument)
        close(camera.position, want.position)
        close(camera.target, want.target)
