"""The skybox: unmoved by translation, behind everything, right for any near and far."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import View, perspective, smooth_environment
from tests.reference import transforms as ref
from tests.reference.sampling import sample_faces

ENVIRONMENT = smooth_environment(16)


@pytest.fixture
def sky():
    return cc.Scene(environment=cc.CubeMap(ENVIRONMENT))


def test_translation_does_not_change_a_pixel(renderer, sky):
    frames = []
    for offset in ((0, 0, 0), (0.1, 0, 0), (1000, -2000, 500), (-3, 0.5, 77)):
        view = ref.look_at((0, 0, 0), (0.3, -0.2, -1)) @ ref.translation(-np.array(offset))
        camera = cc.Camera(view=view, projection=ref.perspective(60, 1, 1, 100))
        frames.append(renderer.render(sky, camera, (24, 24), format="rgba32f").color)
    for frame in frames[1:]:
        assert_identical(frame, frames[0])


def test_position_of_a_capture_does_not_change_a_texel(renderer, sky):
    first = renderer.capture(sky, size=8).faces
    assert_identical(renderer.capture(sky, position=(123, -45, 6789), size=8).faces, first)


@pytest.mark.parametrize(("near", "far"), [(1e-4, 1e4), (0.1, 1000), (5, 6), (1e-3, 1e8), (1, 1e8)])
def test_near_and_far_do_not_matter(renderer, sky, near, far):
    """With far / near of 1e8, w is lost in float32, so the direction must not be divided by w."""
    view = perspective((3, 2, 1), (2, 2.3, 0.2), near=near, far=far)
    frame = renderer.render(sky, view.camera, view.size, format="rgba32f")
    assert_close(frame.color[..., :3], sample_faces(ENVIRONMENT, view.directions()), "shaded")


def test_orthographic_skybox_is_one_direction(renderer, sky):
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 0), target=(1, 2, -3))
    color = renderer.render(sky, camera, (8, 6), format="rgba32f").color
    want = sample_faces(ENVIRONMENT, np.array([1.0, 2, -3]))
    assert_close(color[..., :3], np.broadcast_to(want, (6, 8, 3)), "shaded")


def test_an_oblique_projection(renderer, sky):
    projection = ref.perspective(55, 1.5, 0.1, 100)
    projection[0, 2], projection[1, 2] = 0.4, -0.3
    matrix = ref.look_at((1, 2, 3), (0, 0, 0), (0.3, 1, 0))
    view = View(
        cc.Camera(view=matrix, projection=projection), matrix, projection, (30, 20), 0.1, 100, None
    )
    frame = renderer.render(sky, view.camera, view.size, format="rgba32f")
    assert_close(frame.color[..., :3], sample_faces(ENVIRONMENT, view.directions()), "shaded")


def test_it_is_behind_everything(renderer, sky):
    """A plane just before far hides the skybox; a plane beyond far is not drawn."""
    quad = cc.Mesh.plane(1e4, 1e4)
    node = sky.add(
        quad,
        cc.BasicMaterial(color=(1, 0, 0)),
        position=(0, 0, -99.9),
        rotation=cc.axis_angle((1, 0, 0), 90),
    )
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, -1), near=0.1, far=100)
    color = renderer.render(sky, camera, (8, 8), format="rgba32f").color
    assert (color == [1, 0, 0, 1]).all()
    node.position = (0, 0, -100.2)
    assert (renderer.render(sky, camera, (8, 8), format="rgba32f").color[..., 0] < 1).all()


def test_background_color_is_written_as_it_is(renderer):
    scene = cc.Scene(background=(0.25, 0.5, 2, 0.75))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, -1))
    color = renderer.render(scene, camera, (4, 4), format="rgba32f").color
    assert (color == np.array([0.25, 0.5, 2, 0.75], np.float32)).all()
    assert (
        renderer.capture(scene, size=4).faces == np.array([0.25, 0.5, 2, 0.75], np.float32)
    ).all()


def test_none_is_the_environment_if_there_is_one_else_transparent_black(renderer, sky):
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, -1))
    assert not renderer.render(cc.Scene(), camera, (4, 4), format="rgba32f").color.any()
    color = renderer.render(sky, camera, (4, 4), format="rgba32f").color
    assert (color[..., :3] > 0.1).all()
    assert (color[..., 3] == 1).all()
    sky.background = (0, 0, 0, 0)
    assert not renderer.render(sky, camera, (4, 4), format="rgba32f").color.any()


def test_a_background_of_its_own(renderer, sky):
    other = ENVIRONMENT[..., ::-1].copy()
    sky.background = cc.CubeMap(other)
    view = perspective((0, 0, 0), (1, 0.2, 0.3))
    frame = renderer.render(sky, view.camera, view.size, format="rgba32f")
    assert_close(frame.color[..., :3], sample_faces(other, view.directions()), "shaded")


def test_bright_backgrounds_are_not_clipped(renderer):
    bright = np.full((6, 4, 4, 3), 5000, np.float32)
    got = renderer.capture(cc.Scene(background=cc.CubeMap(bright)), size=4).faces
    np.testing.assert_array_equal(got[..., :3], 5000)
    clipped = renderer.capture(
        cc.Scene(background=cc.CubeMap(bright)), size=4, format="rgba8"
    ).faces
    assert (clipped == 255).all()
