"""The sky is exact to 1e-5 for every camera: float64 directions from the camera's own numbers, never from an inverse.

near and far must not matter, whatever a camera accepts; nor the field of view, the place in a large picture, the
path of drawing, multisamples, or which rectangle of a picture is drawn.
"""

import itertools

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import normalised
from tests.compare import assert_close, assert_identical
from tests.gl.world import smooth_environment
from tests.reference import transforms as ref
from tests.reference.cube_faces import texel_directions
from tests.reference.sampling import sample_faces

FACES = smooth_environment(16)
#: Ranges of depth that a perspective camera accepts; a projection's inverse in single precision gives most of them up.
RANGES = [
    (0.1, 1000),
    (1, 1.0001),
    (1, np.nextafter(1, 2)),
    (1e-30, 1e30),
    (5e-324, 3e38),
    (1e6, 1e6 + 1e-3),
    (1e30, 2e30),
]
#: Ranges for parallel rays, which also see what is behind the camera.
PARALLEL_RANGES = [*RANGES, (0, 1), (-1, 1), (-1e30, 1e-30), (-3e38, 3e38)]
FIELDS = [1e-300, 1e-3, 0.1, 5, 60, 90, 120, 170, 179, 179.99, 179.9999999]
SIZES = [(24, 16), (25, 17), (7, 40), (1, 1), (64, 1)]


@pytest.fixture
def sky():
    return cc.Scene(environment=cc.CubeMap(FACES))


def axes(position, target, up):
    """The camera's right, upper and forward direction in the world."""
    forward = normalised(np.subtract(target, position))
    right = normalised(np.cross(forward, up))
    return right, np.cross(right, forward), forward


def centres(size):
    """x to the right and y upwards of the pixels' centres, in pixels from the picture's middle, row 0 on top."""
    width, height = size
    x, y = np.arange(width) + 0.5 - width / 2, height / 2 - (np.arange(height) + 0.5)
    return np.meshgrid(x, y)


def combined(right, upper, forward, x, y, z):
    return x[..., None] * right + y[..., None] * upper + z * forward


def perspective_rays(camera, size):
    """The directions that the documentation of fov, shift and pixel_aspect gives."""
    x, y = centres(size)
    height = size[1]
    half = 1.0 if camera.fov == 90 else np.tan(np.radians(camera.fov) / 2)
    x = camera.pixel_aspect * x / height + camera.shift[0]
    y = y / height + camera.shift[1]
    right, upper, forward = axes(camera.position, camera.target, camera.up)
    return combined(right, upper, forward, 2 * half * x, 2 * half * y, 1.0)


def k_rays(k, view, size):
    """The directions of a pinhole camera: K (x, y, 1) in pixels from the top left, y downwards."""
    x, y = centres(size)
    x, y = x + size[0] / 2, size[1] / 2 - y
    down = (y - k[1, 2]) / k[1, 1]
    across = (x - k[0, 2] - k[0, 1] * down) / k[0, 0]
    return combined(view[0, :3], view[1, :3], -view[2, :3], across, -down, 1.0)


def want_of(rays, faces=FACES):
    return sample_faces(faces, rays / np.abs(rays).max(-1, keepdims=True))


def check(renderer, scene, camera, size, rays, **options):
    frame = renderer.render(scene, camera, size, format="rgba32f", **options)
    assert_close(frame.color[..., :3], want_of(rays), "sky")
    assert (frame.color[..., 3] == 1).all()


def random_placing(rng):
    position = rng.normal(size=3) * 10.0 ** rng.uniform(-3, 5)
    return {
        "position": position,
        "target": position + rng.normal(size=3) * np.abs(position).max(),
        "up": rng.normal(size=3),
    }


@pytest.mark.parametrize("fov", FIELDS)
def test_perspective(any_path, sky, fov):
    """Each field of view with each range of depth, from random places, with windows off the axis too."""
    rng = np.random.default_rng(3)
    for number, (near, far) in enumerate(RANGES):
        size = SIZES[number % len(SIZES)]
        for shift, aspect in (((0, 0), 1), (rng.normal(size=2), rng.uniform(0.3, 3))):
            camera = cc.PerspectiveCamera(fov=fov, near=near, far=far, **random_placing(rng))
            camera.shift, camera.pixel_aspect = shift, aspect
            check(any_path, sky, camera, size, perspective_rays(camera, size))


@pytest.mark.parametrize("shift", [(1e3, 0), (0, -1e6), (1e12, 3), (-3e38, 1e38)])
def test_windows_far_off_the_axis(renderer, sky, shift):
    rng = np.random.default_rng(4)
    for fov in (1e-3, 60, 179):
        camera = cc.PerspectiveCamera(fov=fov, shift=shift, **random_placing(rng))
        check(renderer, sky, camera, (25, 16), perspective_rays(camera, (25, 16)))


@pytest.mark.parametrize(("near", "far"), PARALLEL_RANGES)
def test_orthographic(any_path, sky, near, far):
    rng = np.random.default_rng(5)
    for height in (1e-30, 2, 1e30):
        camera = cc.OrthographicCamera(height=height, near=near, far=far, **random_placing(rng))
        _, _, forward = axes(camera.position, camera.target, camera.up)
        check(any_path, sky, camera, (6, 5), np.broadcast_to(forward, (5, 6, 3)))


def with_depth(projection, near, far):
    """A projection with the rows of depth for a range; far can be infinite, and nearer than near (reversed)."""
    made = np.array(projection, float)
    made[2] = (0, 0, -1, -2 * near) if np.isinf(far) else (0, 0, (far + near) / (near - far), 0)
    if np.isfinite(far):
        made[2, 3] = 2 * far * near / (near - far)
    return made


@pytest.mark.parametrize(("near", "far"), [(0.1, 100), (100, 0.1), (1e-3, np.inf), (1, 1.0001)])
def test_matrices_of_calibrated_cameras(any_path, sky, near, far):
    """Views and projections of one's own, with skewed pixels, reversed depth and no far plane."""
    rng = np.random.default_rng(6)
    for size in SIZES:
        width, height = size
        k = np.array(
            [[rng.uniform(5, 500), rng.normal(), rng.uniform(-2, 2) * width], [0, 0, 0], [0, 0, 1]]
        )
        k[1, 1:] = rng.uniform(5, 500), rng.uniform(-2, 2) * height
        view = ref.look_at(rng.normal(size=3), rng.normal(size=3), rng.normal(size=3))
        projection = np.zeros((4, 4))
        # NDC x = 2 u / width - 1 and y = 1 - 2 v / height, where K (x, -y, -z) = -z (u, v, 1).
        projection[0, :3] = 2 * k[0, 0] / width, -2 * k[0, 1] / width, 1 - 2 * k[0, 2] / width
        projection[1, 1:3] = 2 * k[1, 1] / height, 2 * k[1, 2] / height - 1
        projection[3, 2] = -1
        camera = cc.Camera(view=view, projection=with_depth(projection, near, far))
        check(any_path, sky, camera, size, k_rays(k, view, size))


def test_views_that_stretch_the_world(renderer, sky):
    """A view matrix may scale and mirror: its inverse takes directions back to the world."""
    for sign in (1, -1):
        turn = ref.look_at((1, 2, 3), (0, 0, 0)) @ np.diag([sign, 2, 0.5, 1])
        camera = cc.Camera(view=turn, projection=ref.perspective(70, 24 / 16, 0.1, 10))
        x, y = centres((24, 16))
        half = np.tan(np.radians(35)) / 8
        seen = np.stack([x * half, y * half, np.full_like(x, -1)], -1)
        check(renderer, sky, camera, (24, 16), seen @ np.linalg.inv(turn[:3, :3]).T)


def test_oblique_parallel_rays(renderer, sky):
    """A cabinet projection: parallel rays that are not along the axis."""
    projection = ref.orthographic(-2, 2, -1, 1, 0.1, 10)
    projection[0, 2], projection[1, 2] = 0.3, -0.2
    view = ref.look_at((1, 2, 3), (0, 0.5, 0))
    ray = np.array([0.3 * 2, -0.2, -1]) @ view[:3, :3]  # keeps x / 2 + 0.3 z and y - 0.2 z
    camera = cc.Camera(view=view, projection=projection)
    check(renderer, sky, camera, (8, 4), np.broadcast_to(ray, (4, 8, 3)))


@pytest.mark.parametrize("layout", ["side_by_side", "top_bottom"])
def test_both_eyes(any_path, sky, layout):
    rng = np.random.default_rng(8)
    for near, far in RANGES[:4]:
        middle = cc.PerspectiveCamera(fov=75, near=near, far=far, **random_placing(rng))
        eyes = cc.StereoCamera.off_axis(middle, separation=0.3, convergence=4.0, layout=layout)
        one = (20, 16)
        size = (40, 16) if layout == "side_by_side" else (20, 32)
        color = any_path.render(sky, eyes, size, format="rgba32f").color[..., :3]
        axis = 1 if layout == "side_by_side" else 0
        for half, eye in zip(np.split(color, 2, axis), (eyes.left, eyes.right), strict=True):
            assert_close(half, want_of(perspective_rays(eye, one)), "sky")


@pytest.mark.parametrize("samples", [1, 4])
def test_captures(any_path, sky, samples):
    """A capture of the sky shows what the sky's own lookup by direction gives, at any near and far."""
    want = want_of(texel_directions(12))
    for (near, far), place in zip(
        RANGES, itertools.cycle([(0, 0, 0), (1e7, -3, 2e9)]), strict=False
    ):
        cube = any_path.capture(sky, place, 12, near=near, far=far, samples=samples)
        assert_close(cube.faces[..., :3], want, "sky")


def test_a_capture_of_the_same_size_is_the_sky_itself(any_path, sky):
    assert_close(any_path.capture(sky, size=16).faces[..., :3], FACES, "sky")


@pytest.mark.parametrize("samples", [1, 4])
def test_large_pictures_and_their_tiles(any_path, sky, samples):
    """A wide strip of a wide field of view, and its parts drawn alone by windows off the axis."""
    size = (4096, 6)
    camera = cc.PerspectiveCamera(
        fov=2, position=(1, 0, 0), target=(2, 0.3, -1), near=1, far=1.0001
    )
    whole = perspective_rays(camera, size)
    check(any_path, sky, camera, size, whole, samples=samples)
    k = camera.intrinsics(size)
    for left in range(0, 4096, 1024):
        part = k.copy()
        part[0, 2] -= left
        tile = cc.PerspectiveCamera.from_intrinsics(
            part, (1024, 6), world_to_camera_cv=camera.world_to_camera_cv, near=1, far=1.0001
        )
        check(any_path, sky, tile, (1024, 6), whole[:, left : left + 1024], samples=samples)


@pytest.mark.parametrize("samples", [1, 4])
def test_beside_nodes_and_in_rectangles(any_path, sky, samples):
    """The sky round a node, and where a node was in the picture before."""
    camera = cc.PerspectiveCamera(fov=100, position=(0, 0, 3), target=(0, 0, 0), near=1e-3, far=1e9)
    size = (33, 24)
    want = want_of(perspective_rays(camera, size))
    box = sky.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(9, 9, 9)))
    for x in (0, 0.7, -1.5):
        box.position = (x, 0, 0)
        options = {"format": "rgba32f", "samples": samples, "outputs": "id"}
        frame = any_path.render(sky, camera, size, **options)
        away = frame.color[..., 0] <= 1  # no sample of the box
        assert 0.8 < away.mean() < 1
        assert_close(frame.color[..., :3], want, "sky", mask=away)


def test_probes_and_render_textures(any_path, sky):
    """Pictures that other pictures show have the same sky."""
    probe = cc.Probe(size=16, near=1, far=1.0001, format="rgba32f")
    sky.add(cc.Mesh.box(0.1), cc.MirrorMaterial(), position=(0, 0, -2), environment=probe)
    inner = cc.PerspectiveCamera(
        fov=120, position=(1, 2, 3), target=(0, 5, 0), near=1e-30, far=1e30
    )
    texture = cc.RenderTexture(
        cc.Scene(environment=sky.environment), inner, size=(20, 10), format="rgba32f"
    )
    sky.add(cc.Mesh.plane(0.1, 0.1), cc.BasicMaterial(map=texture), position=(0, -0.1, -2))
    any_path.render(sky, cc.PerspectiveCamera(target=(0, 0, -1)), (16, 12))
    assert_close(any_path.read_probe(probe).faces[..., :3], FACES, "sky")
    want = want_of(perspective_rays(inner, (20, 10)))
    assert_close(any_path.read_texture(texture)[..., :3], want, "sky")


def test_a_sky_that_is_turned(any_path, sky):
    """The environment's own rotation turns the directions, whatever the range of depth."""
    rng = np.random.default_rng(9)
    for near, far in RANGES[:4]:
        quaternion = rng.normal(size=4)
        sky.environment_rotation = quaternion
        camera = cc.PerspectiveCamera(fov=130, near=near, far=far, **random_placing(rng))
        rays = perspective_rays(camera, (24, 16)) @ ref.rotation(quaternion)[:3, :3]
        check(any_path, sky, camera, (24, 16), rays)


def test_the_paths_agree_to_the_bit(shared_renderers, sky):
    for samples in (1, 4):
        both = [
            shared_renderers(layered).capture(sky, size=20, near=1, far=1.0001, samples=samples)
            for layered in (None, False)
        ]
        assert_identical(both[0].faces, both[1].faces)
