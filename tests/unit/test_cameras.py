"""Camera matrices against the oracle, and what cameras refuse."""

import numpy as np
import pytest

import cubecam as cc
from tests.reference import transforms as ref

EYE, TARGET = (1, 2, 5), (0.5, 0, -1)


@pytest.mark.parametrize("aspect", [1, 16 / 9, 0.5])
def test_perspective(aspect):
    camera = cc.PerspectiveCamera(fov=50, position=EYE, target=TARGET, near=0.2, far=50)
    np.testing.assert_allclose(camera.view, ref.look_at(EYE, TARGET), atol=1e-12)
    np.testing.assert_allclose(
        camera.projection(aspect), ref.perspective(50, aspect, 0.2, 50), rtol=1e-12
    )


def test_defaults_near_and_far():
    camera = cc.PerspectiveCamera(fov=70, position=(0, 0, 1), target=(0, 0, 0))
    assert (camera.near, camera.far) == (0.1, 1000)


def test_up_turns_the_picture():
    camera = cc.PerspectiveCamera(fov=50, position=EYE, target=TARGET, up=(1, 0, 0))
    np.testing.assert_allclose(camera.view, ref.look_at(EYE, TARGET, (1, 0, 0)), atol=1e-12)


@pytest.mark.parametrize("aspect", [1, 2])
def test_orthographic(aspect):
    camera = cc.OrthographicCamera(height=3, position=EYE, target=TARGET, near=0.2, far=50)
    np.testing.assert_allclose(camera.view, ref.look_at(EYE, TARGET), atol=1e-12)
    want = ref.orthographic(-1.5 * aspect, 1.5 * aspect, -1.5, 1.5, 0.2, 50)
    np.testing.assert_allclose(camera.projection(aspect), want, rtol=1e-12, atol=1e-12)


def test_matrices_are_taken_as_they_are(rng):
    view = ref.look_at(EYE, TARGET)
    projection = ref.perspective(40, 1.3, 1, 9)
    camera = cc.Camera(view=view, projection=projection)
    np.testing.assert_array_equal(camera.view, view)
    np.testing.assert_array_equal(camera.projection(7), projection)


def test_properties_move_the_camera():
    camera = cc.PerspectiveCamera(fov=50, position=EYE, target=TARGET)
    camera.position, camera.target, camera.fov = (3, 3, 3), (0, 1, 0), 30
    np.testing.assert_allclose(camera.view, ref.look_at((3, 3, 3), (0, 1, 0)), atol=1e-12)
    with pytest.raises(ValueError, match="read-only"):
        camera.position[0] = 3


BAD = {
    "target is position": ({"target": EYE}, ValueError, "target"),
    "up along the view": ({"position": (0, 0, 0), "target": (0, 3, 0)}, ValueError, "up"),
    "up zero": ({"up": (0, 0, 0)}, ValueError, "up"),
    "near >= far": ({"near": 5, "far": 5}, ValueError, "near"),
    "near > far": ({"near": 6, "far": 5}, ValueError, "near"),
    "near 0": ({"near": 0}, ValueError, "near"),
    "near negative": ({"near": -1}, ValueError, "near"),
    "far inf": ({"far": np.inf}, ValueError, "far"),
    "fov 0": ({"fov": 0}, ValueError, "fov"),
    "fov 180": ({"fov": 180}, ValueError, "fov"),
    "fov nan": ({"fov": np.nan}, ValueError, "fov"),
    "fov text": ({"fov": "wide"}, TypeError, "fov"),
    "position nan": ({"position": (0, np.nan, 0)}, ValueError, "position"),
    "position of 2": ({"position": (0, 1)}, ValueError, "position"),
}


@pytest.mark.parametrize(("change", "error", "text"), BAD.values(), ids=BAD)
def test_bad_perspectives(change, error, text):
    with pytest.raises(error, match=text):
        cc.PerspectiveCamera(**{"fov": 50, "position": EYE, "target": TARGET, **change})


@pytest.mark.parametrize("name", ["target", "position"])
def test_a_setter_that_would_break_the_camera_leaves_it(name):
    camera = cc.PerspectiveCamera(fov=50, position=EYE, target=TARGET)
    with pytest.raises(ValueError, match="target"):
        setattr(camera, name, TARGET if name == "position" else EYE)
    np.testing.assert_allclose(camera.view, ref.look_at(EYE, TARGET), atol=1e-12)


def test_the_message_names_the_point():
    with pytest.raises(ValueError, match=r"1.*2.*5"):
        cc.PerspectiveCamera(fov=50, position=EYE, target=EYE)


@pytest.mark.parametrize(
    ("view", "projection", "error", "text"),
    [
        (np.diag([1, 1, 0, 1.0]), np.eye(4), ValueError, r"view.*singular|singular.*view"),
        (np.eye(4), np.zeros((4, 4)), ValueError, r"projection.*singular|singular.*projection"),
        (np.eye(3), np.eye(4), ValueError, "view"),
        (np.full((4, 4), np.nan), np.eye(4), ValueError, "view"),
        (np.eye(4), "ortho", TypeError, "projection"),
    ],
)
def test_bad_matrices(view, projection, error, text):
    with pytest.raises(error, match=text):
        cc.Camera(view=view, projection=projection)


@pytest.mark.parametrize(
    ("change", "text"), [({"height": 0}, "height"), ({"near": 3, "far": 2}, "near")]
)
def test_bad_orthographics(change, text):
    with pytest.raises(ValueError, match=text):
        cc.OrthographicCamera(**{"height": 3, "position": EYE, "target": TARGET, **change})
