"""The asymmetric pattern through every path: a swap, a flip and a quarter turn of any face each fail."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import perspective
from tests.helpers import conventions, faces, layouts
from tests.reference.cube_faces import FORWARD, convert, texel_directions, to_layout
from tests.reference.pattern import face_pattern
from tests.reference.sampling import sample_faces

N = 16
PATTERN = face_pattern(N, 3)
UPS = [(0, 1, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (0, 1, 0), (0, 1, 0)]


def captured(renderer, cube, **options):
    return renderer.capture(cc.Scene(background=cube), size=N, **options)


@conventions
def test_a_captured_background_is_the_background(any_path, convention):
    cube = cc.CubeMap(convert(PATTERN, "gl", convention), convention=convention)
    got = captured(any_path, cube, position=(3, -2, 5), format="rgba8")
    assert_identical(got.faces[..., :3], PATTERN)
    assert (got.faces[..., 3] == 255).all()


@pytest.mark.parametrize("dtype", [np.uint8, np.float16, np.float32])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_every_dtype_and_channel_count_is_uploaded(renderer, dtype, channels):
    pixels = face_pattern(N, channels)
    if channels == 4:
        pixels[..., 3] = 255
    scaled = pixels if dtype == np.uint8 else (pixels / 256).astype(dtype)
    got = captured(renderer, cc.CubeMap(scaled)).faces
    want = scaled / 255 if dtype == np.uint8 else scaled.astype(float)
    want = np.repeat(want, 3, axis=-1) if channels == 1 else want[..., :3]
    assert_close(got[..., :3], want, "lookup")


@faces
def test_a_skybox_seen_along_each_axis(any_path, face):
    view = perspective(
        (1, 2, 3), np.array([1, 2, 3]) + FORWARD[face], fov=80, size=(40, 30), up=UPS[face]
    )
    got = any_path.render(
        cc.Scene(background=cc.CubeMap(PATTERN)), view.camera, view.size, format="rgba32f"
    )
    assert_close(got.color[..., :3], sample_faces(PATTERN, view.directions()), "lookup")


def test_a_skybox_seen_along_minus_z_is_the_natural_picture(renderer):
    """The pattern's white corner is top left in a file of convention "inside", and so it is on the screen."""
    cube = cc.CubeMap(PATTERN, convention="inside")
    camera = cc.PerspectiveCamera(fov=90, position=(0, 0, 0), target=(0, 0, -1))
    frame = renderer.render(cc.Scene(background=cube), camera, (N, N))
    assert_identical(frame.color[..., :3], PATTERN[5])


@conventions
@layouts
def test_capture_save_load_capture(renderer, convention, layout, tmp_path):
    first = captured(renderer, cc.CubeMap(PATTERN), format="rgba8")
    first.save(tmp_path / "a.png", layout=layout, convention=convention)
    stored = cc.load_image(tmp_path / "a.png")
    assert_identical(stored[..., :3], to_layout(PATTERN, layout, convention))
    again = captured(
        renderer, cc.load_cubemap(tmp_path / "a.png", convention=convention), format="rgba8"
    )
    assert_identical(again.faces, first.faces)


@faces
def test_set_face_uploads_that_face(renderer, face):
    cube = cc.CubeMap(np.zeros_like(PATTERN))
    captured(renderer, cube)
    cube.set_face(face, PATTERN[face])
    want = np.zeros_like(PATTERN)
    want[face] = PATTERN[face]
    got = captured(renderer, cube, format="rgba8").faces
    assert_identical(got[..., :3], want)


def test_faces_of_one_color_are_replaced_as_pictures_arrive(renderer):
    """P5: the cube is usable before, while and after pictures arrive; it has mipmaps, but level 0 is seen."""
    want = np.full((6, N, N, 3), 128, np.uint8)
    cube = cc.CubeMap(want, mipmaps=True)
    scene = cc.Scene(background=cube)
    directions = texel_directions(2 * N)
    for face in (3, 0, 5, 1, 4, 2):
        got = renderer.capture(scene, size=2 * N).faces
        assert_close(got[..., :3], sample_faces(want, directions), "unorm8_filter")
        cube.set_face(face, PATTERN[face])
        want[face] = PATTERN[face]
    got = renderer.capture(scene, size=2 * N).faces
    assert_close(got[..., :3], sample_faces(PATTERN, directions), "unorm8_filter")


def test_a_capture_of_a_capture_is_the_same(renderer):
    first = captured(renderer, cc.CubeMap(PATTERN), format="rgba8")
    assert_identical(captured(renderer, first, format="rgba8").faces, first.faces)


def test_a_frame_shows_a_pictures_top_on_top(renderer):
    """A square with a picture on it, seen from the front, shows the same picture."""
    picture = PATTERN[0]
    scene = cc.Scene()
    scene.add(
        cc.Mesh.plane(2, 2), cc.BasicMaterial(map=picture), rotation=cc.axis_angle((1, 0, 0), 90)
    )
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 2), target=(0, 0, 0))
    frame = renderer.render(scene, camera, (N, N))
    assert_identical(frame.color[..., :3], picture)
