"""camera.fit: the corners of the bounds, projected by numpy, fill the picture and none is outside."""

import itertools
from typing import Any

import numpy as np
import pytest

import cubecam as cc

VIEWS: dict[str, dict[str, Any]] = {
    "along -Z": {},
    "from the side": {"position": (9, 4, -3), "target": (0, 1, 0)},
    "with a roll": {"position": (1, 2, 3), "target": (0, 0, 0), "up": (1, 1, 0.3)},
    "from within": {"position": (0, 0, 0), "target": (0.1, -0.2, 0.3)},
    "turned away": {"position": (0, 0, 5), "target": (0, 1, 50)},
}
LENSES: dict[str, tuple[Any, dict[str, Any]]] = {
    "usual": (cc.PerspectiveCamera, {"fov": 40}),
    "wide": (cc.PerspectiveCamera, {"fov": 100}),
    "shifted": (cc.PerspectiveCamera, {"fov": 50, "shift": (0.3, -0.4)}),
    "axis outside the picture": (cc.PerspectiveCamera, {"fov": 30, "shift": (1.5, 0.8)}),
    "pixels not square": (cc.PerspectiveCamera, {"fov": 50, "pixel_aspect": 1.5}),
    "parallel": (cc.OrthographicCamera, {}),
}
BOUNDS = np.array([[-2, 0.5, -1], [1, 1.5, 3.0]])


def corners(bounds):
    return np.array(list(itertools.product(*np.transpose(bounds))))


def in_the_picture(camera, points, aspect):
    """Normalised device coordinates (N, 3)."""
    whole = np.c_[points, np.ones(len(points))]
    clip = whole @ (camera.projection(aspect) @ camera.view).T
    assert (clip[:, 3] > 0).all()
    return clip[:, :3] / clip[:, 3:]


def direction(camera):
    return -np.linalg.inv(camera.view)[:3, 2]


@pytest.mark.parametrize("aspect", [0.5, 1, 16 / 9])
@pytest.mark.parametrize("margin", [0, 0.05, 0.3])
@pytest.mark.parametrize("lens", LENSES)
@pytest.mark.parametrize("view", VIEWS)
def test_the_corners_fill_the_picture(view, lens, margin, aspect):
    kind, options = LENSES[lens]
    camera = kind(**VIEWS[view], **options)
    before = direction(camera)
    camera.fit(BOUNDS, aspect=aspect, margin=margin)
    np.testing.assert_allclose(direction(camera), before, atol=1e-9)
    seen = in_the_picture(camera, corners(BOUNDS), aspect)
    border = 1 - 2 * margin
    assert np.abs(seen[:, :2]).max() <= border + 1e-9
    assert np.abs(seen[:, 2]).max() <= 1
    # One of the two directions reaches both borders, and the other is in the middle.
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    full = int(np.argmax(high - low))
    np.testing.assert_allclose([low[full], high[full]], [-border, border], atol=1e-9)
    if kind is cc.OrthographicCamera:
        np.testing.assert_allclose(low, -high, atol=1e-9)
    # The target is the point of the axis nearest to the middle of the bounds.
    along = direction(camera)
    middle = BOUNDS.mean(axis=0)
    want = camera.position + along * (along @ (middle - camera.position))
    np.testing.assert_allclose(camera.target, want, atol=1e-9)


def test_scene_node_and_array_agree():
    scene = cc.Scene()
    group = scene.add(position=(1, 2, 3), rotation=cc.axis_angle((1, 1, 0), 30))
    scene.add(cc.Mesh.torus(), parent=group)
    places = []
    for what in (scene, group, scene.bounds, scene.bounds.tolist()):
        camera = cc.PerspectiveCamera(position=(5, 5, 5), target=(0, 0, 0))
        camera.fit(what, size=(640, 480))
        places.append(camera.position)
    np.testing.assert_array_equal(places, [places[0]] * 4)
    camera.fit(scene, aspect=640 / 480)
    np.testing.assert_allclose(camera.position, places[0])


def test_near_and_far_stay_where_they_hold_the_bounds():
    camera = cc.PerspectiveCamera(near=0.5, far=70)
    camera.fit(BOUNDS)
    assert (camera.near, camera.far) == (0.5, 70)


@pytest.mark.parametrize("kind", [cc.PerspectiveCamera, cc.OrthographicCamera])
@pytest.mark.parametrize("factor", [1e-4, 1e5])
def test_near_and_far_follow_other_sizes(kind, factor):
    camera = kind(position=(3, 3, 3), target=(0, 0, 0))
    camera.fit(BOUNDS * factor)
    seen = in_the_picture(camera, corners(BOUNDS * factor), 1)
    assert np.abs(seen).max() <= 1
    depths = (np.c_[corners(BOUNDS * factor), np.ones(8)] @ camera.world_to_camera_cv.T)[:, 2]
    assert camera.near <= depths.min()
    assert camera.far >= depths.max()


def test_an_orthographic_camera_stays_at_its_depth():
    camera = cc.OrthographicCamera(position=(0, 0, 50))
    camera.fit(BOUNDS)
    assert camera.position.tolist() == [-0.5, 1, 50]


@pytest.mark.parametrize("kind", [cc.PerspectiveCamera, cc.OrthographicCamera])
@pytest.mark.parametrize(
    "bounds",
    [
        [[0, 0, -3], [0, 0, 4]],  # a line along the view
        [[0, 0, 2], [0, 5, 2]],
        [[-1, 3, -1], [1, 3, 1]],  # a plane seen from its edge
    ],
)
def test_flat_bounds(kind, bounds):
    camera = kind()
    camera.fit(bounds)
    assert np.abs(in_the_picture(camera, corners(bounds), 1)).max() <= 1


def test_a_wide_lens_keeps_off_the_corners():
    """With 175 degrees the whole box would be seen from its own corner."""
    camera = cc.PerspectiveCamera(fov=175, position=(1, 1, 1), target=(0, 0, 0))
    camera.fit([[-1, -1, -1], [1, 1, 1]])
    depths = (np.c_[corners([[-1] * 3, [1] * 3]), np.ones(8)] @ camera.view.T)[:, 2]
    assert -depths.max() > 1e-3
    assert np.abs(in_the_picture(camera, corners([[-1] * 3, [1] * 3]), 1)).max() <= 1


BAD = {
    "empty scene": (lambda c: c.fit(cc.Scene()), ValueError, "expected bounds of some extent"),
    "group": (lambda c: c.fit(cc.Scene().add()), ValueError, "got nothing that is visible"),
    "point": (lambda c: c.fit([[1, 2, 3]] * 2), ValueError, r"got one point, \(1, 2, 3\)"),
    "corners swapped": (lambda c: c.fit(BOUNDS[::-1]), ValueError, "expected the lowest corner"),
    "shape": (lambda c: c.fit([1, 2, 3]), ValueError, r"expected shape \(2, 3\), got \(3,\)"),
    "infinite": (lambda c: c.fit([[0, 0, 0], [1, 1, np.inf]]), ValueError, "bounds of 3 finite"),
    "nan": (lambda c: c.fit([[0, 0, 0], [1, 1, np.nan]]), ValueError, "what"),
    "none": (lambda c: c.fit(None), TypeError, "expected a Scene, a Node or bounds .*, got None"),
    "text": (lambda c: c.fit("scene"), TypeError, "expected a Scene, a Node or bounds .*, got str"),
    "margin": (lambda c: c.fit(BOUNDS, margin=0.5), ValueError, "margin of at least 0 and below"),
    "margin below": (lambda c: c.fit(BOUNDS, margin=-0.1), ValueError, "margin"),
    "aspect": (lambda c: c.fit(BOUNDS, aspect=0), ValueError, "aspect"),
    "size": (lambda c: c.fit(BOUNDS, size=(0, 4)), ValueError, "size: expected .* at least 1"),
    "both": (lambda c: c.fit(BOUNDS, size=(4, 4), aspect=1), ValueError, "got both"),
}


@pytest.mark.parametrize(("call", "error", "message"), BAD.values(), ids=BAD)
@pytest.mark.parametrize("kind", [cc.PerspectiveCamera, cc.OrthographicCamera])
def test_bad_arguments_change_nothing(kind, call, error, message):
    camera = kind(position=(1, 2, 3))
    with pytest.raises(error, match=message):
        call(camera)
    assert camera.position.tolist() == [1, 2, 3]
    assert camera.target is None
