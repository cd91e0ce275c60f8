"""K and world-to-camera matrices against numpy; tests/gl/test_projected_pixels.py compares them with pictures."""

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies
from tests.reference import transforms as ref

SIZES = [(640, 480), (33, 57), (1, 1)]
FLIP = np.diag([1.0, -1, -1, 1])


def lens(rng):
    return {
        "fov": rng.uniform(5, 160),
        "shift": rng.normal(size=2),
        "pixel_aspect": rng.uniform(0.5, 2),
    }


def pixels(camera, points, size):
    """Pixel coordinates of points of the world by OpenGL's own way: clip space, then the viewport."""
    clip = np.c_[points, np.ones(len(points))] @ camera.view.T
    clip = clip @ camera.projection(size[0] / size[1]).T
    ndc = clip[:, :2] / clip[:, 3:]
    return (ndc * (1, -1) + 1) / 2 * size


@pytest.mark.parametrize("size", SIZES)
def test_k_projects_as_opengl_does(size, rng):
    for _ in range(20):
        camera = cc.PerspectiveCamera(position=(1, 2, 3), target=rng.normal(size=3), **lens(rng))
        k, extrinsics = camera.intrinsics(size), camera.world_to_camera_cv
        points = np.linalg.inv(extrinsics) @ np.c_[rng.normal(size=(9, 2)), np.ones((9, 2))].T
        seen = k @ (extrinsics @ points)[:3]
        want = pixels(camera, points[:3].T, size)
        np.testing.assert_allclose((seen[:2] / seen[2]).T, want, rtol=1e-9, atol=1e-9)
        assert k[1, 0] == k[0, 1] == 0
        assert k.flags.writeable  # it belongs to the caller


def test_a_lens_of_square_pixels_has_one_focal_length():
    k = cc.PerspectiveCamera(fov=60).intrinsics((200, 100))
    focal = 50 / np.tan(np.radians(30))
    np.testing.assert_allclose(k, [[focal, 0, 100], [0, focal, 50], [0, 0, 1]])


@pytest.mark.parametrize("size", SIZES)
def test_there_and_back(size, rng):
    for _ in range(20):
        given = lens(rng)
        camera = cc.PerspectiveCamera(
            position=rng.normal(size=3), target=rng.normal(size=3), up=rng.normal(size=3), **given
        )
        again = cc.PerspectiveCamera.from_intrinsics(
            camera.intrinsics(size), size, world_to_camera_cv=camera.world_to_camera_cv
        )
        assert type(again) is cc.PerspectiveCamera
        assert again.fov == pytest.approx(given["fov"], rel=1e-12)
        assert again.pixel_aspect == pytest.approx(given["pixel_aspect"], rel=1e-12)
        np.testing.assert_allclose(again.shift, given["shift"], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(again.view, camera.view, atol=1e-12)
        np.testing.assert_allclose(again.intrinsics(size), camera.intrinsics(size), rtol=1e-9)


def test_a_calibrated_camera():
    k = [[525.3, 0.0, 318.2], [0.0, 526.1, 243.9], [0.0, 0.0, 1.0]]
    camera = cc.PerspectiveCamera.from_intrinsics(
        k, (640, 480), position=(1, 0, 0), target=(0, 0, 0), up=(0, 0, 1), near=0.5, far=9
    )
    np.testing.assert_allclose(camera.intrinsics((640, 480)), k, rtol=1e-12)
    half = camera.intrinsics((320, 240))
    np.testing.assert_allclose(half[:2], np.array(k)[:2] / 2, rtol=1e-12)
    assert (camera.near, camera.far) == (0.5, 9)
    np.testing.assert_allclose(camera.view, ref.look_at((1, 0, 0), (0, 0, 0), (0, 0, 1)))


def test_world_to_camera():
    cameras = [
        cc.PerspectiveCamera(position=(1, 2, 3), target=(0, 0, 0)),
        cc.OrthographicCamera(position=(1, 2, 3), target=(0, 0, 0)),
        cc.Camera(view=ref.look_at((1, 2, 3), (0, 0, 0)), projection=np.eye(4)),
    ]
    for camera in cameras:
        np.testing.assert_array_equal(camera.world_to_camera_gl, camera.view)
        np.testing.assert_array_equal(camera.world_to_camera_cv, FLIP @ camera.view)
        assert not camera.world_to_camera_cv.flags.writeable
    # The target is ahead: z is positive in OpenCV's axes.
    ahead = cameras[0].world_to_camera_cv @ (0, 0, 0, 1)
    np.testing.assert_allclose(ahead, (0, 0, np.sqrt(14), 1), atol=1e-12)


@copies
def test_copies_keep_the_shape_of_pixels(make_copy):
    camera = cc.PerspectiveCamera(pixel_aspect=1.25, shift=(0.1, 0.2))
    again = make_copy(camera)
    assert again.pixel_aspect == 1.25
    np.testing.assert_array_equal(again.intrinsics((7, 5)), camera.intrinsics((7, 5)))


def test_the_pixels_of_an_off_axis_pair():
    """A point at the convergence is seen at one pixel by both eyes, whatever the shape of the pixels."""
    camera = cc.PerspectiveCamera(fov=50, pixel_aspect=1.6)
    pair = cc.StereoCamera.off_axis(camera, separation=0.3, convergence=4)
    point = [[0.2, -0.3, -4.0]]
    left, right, middle = (pixels(eye, point, (90, 60)) for eye in (pair.left, pair.right, camera))
    np.testing.assert_allclose(left, right)
    np.testing.assert_allclose(left, middle)


def test_a_camera_of_matrices_may_have_a_skew():
    projection = ref.perspective(50, 2, 1, 9)
    projection[0, 1] = 0.1
    camera = cc.Camera(view=np.eye(4), projection=projection)
    k = camera.intrinsics((200, 100))
    assert k[0, 1] == pytest.approx(-10)
    points = np.array([[0.3, 0.2, -2], [-0.4, 0.5, -3]])
    seen = points @ FLIP[:3, :3] @ k.T
    np.testing.assert_allclose(seen[:, :2] / seen[:, 2:], pixels(camera, points, (200, 100)))
    with pytest.raises(ValueError, match=r"without skew \(.*Camera.*got K\[0, 1\] = -10"):
        cc.PerspectiveCamera.from_intrinsics(k, (200, 100))


K = np.array([[100.0, 0, 32], [0, 100, 24], [0, 0, 1]])
MIRROR = np.diag([1.0, 1, -1, 1])


def changed(row, column, value):
    k = K.copy()
    k[row, column] = value
    return k


def make(k=K, size=(64, 48), **options):
    return cc.PerspectiveCamera.from_intrinsics(k, size, **options)


BAD = {
    "negative focal length": (lambda: make(changed(0, 0, -3)), ValueError, "focal lengths"),
    "zero focal length": (lambda: make(changed(1, 1, 0)), ValueError, "focal lengths"),
    "skew": (lambda: make(changed(0, 1, 2)), ValueError, "without skew"),
    "last row": (lambda: make(changed(2, 1, 2)), ValueError, r"\(0, 0, 1\) as its last row"),
    "nan": (lambda: make(changed(0, 2, np.nan)), ValueError, "K: expected finite"),
    "shape": (lambda: make(np.eye(4)), ValueError, r"K: expected shape \(3, 3\), got \(4, 4\)"),
    "size": (lambda: make(size=(0, 3)), ValueError, "size: expected a width and a height"),
    "size of one": (lambda: make(size=3), TypeError, r"size: expected \(width, height\)"),
    "mirror": (lambda: make(world_to_camera_cv=MIRROR), ValueError, "rotation and a translation"),
    "scale": (
        lambda: make(world_to_camera_cv=np.diag([2, 2, 2, 1])), ValueError, "got one with a scale"
    ),
    "two places": (
        lambda: make(world_to_camera_cv=np.eye(4), position=(0, 0, 0)), ValueError, "got both"
    ),
    "parallel rays": (
        lambda: cc.OrthographicCamera().intrinsics((4, 3)), ValueError, "got one of parallel rays"
    ),
    "other last row": (
        lambda: cc.Camera(view=np.eye(4), projection=np.diag([1, 1, 2, 1]) + np.eye(4, k=-1))
        .intrinsics((4, 3)),
        ValueError,
        r"expected a projection with \(0, 0, -1, 0\)",
    ),
    "pixel_aspect": (lambda: cc.PerspectiveCamera(pixel_aspect=0), ValueError, "pixel_aspect"),
}  # fmt: skip


@pytest.mark.parametrize(("call", "error", "message"), BAD.values(), ids=BAD)
def test_bad_arguments(call, error, message):
    with pytest.raises(error, match=message):
        call()
