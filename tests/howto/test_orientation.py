"""docs/howto/orientation.md: the figure, the conversions, and the table of other programs."""

import numpy as np
import pytest

import cubecam as cc
from tests.documents import text_of
from tests.interop.directions import DIRECTIONS, sky, sky_cube
from tests.reference.cube_faces import unit_texel_directions

NAME = "docs/howto/orientation.md"


@pytest.mark.slow
def test_the_figure_shows_letters_rightly_from_inside(pages):
    folder, scope = pages(NAME)
    picture = cc.load_image(folder / "orientation.png")
    assert picture.shape[:2] == (640, 832)
    inside = scope["cube"].to_convention("inside")
    for face in cc.Face:
        letters = scope["cube"].faces[face]
        assert (letters[:14] == (255, 210, 0)).all()  # row 0
        # Letters stand in the upper half of a view from inside, and begin with a sign, which has less ink.
        white = (inside[face] == 255).all(axis=-1)
        assert white[:128].sum() > 500
        assert not white[128:].any()
        columns = np.nonzero(white.any(axis=0))[0]
        middle = (columns[0] + columns[-1]) // 2
        assert white[:, :middle].sum() < white[:, middle:].sum()


@pytest.mark.slow
def test_the_conversions_go_there_and_back(pages):
    _, scope = pages(NAME)
    sky_ = scope["sky"]
    np.testing.assert_array_equal(scope["again"].faces, sky_.faces)
    np.testing.assert_array_equal(scope["for_opengl"], sky_.faces)
    np.testing.assert_allclose(scope["up_is_z"].sample((0, 0, 1)), sky_.sample((0, 1, 0)))


def lookup(faces, directions):
    """OpenGL's lookup: which texel a shader finds in a direction."""
    return cc.CubeMap(np.ascontiguousarray(faces)).sample(directions)


@pytest.mark.parametrize(
    ("program", "convention", "turn"),
    [
        ("OpenGL, Vulkan", "gl", np.diag([1, 1, 1])),
        ("three.js, pygfx", "three", np.diag([-1, 1, 1])),
    ],
)
def test_a_lookup_finds_the_sky(program, convention, turn):
    assert f"| {program}" in text_of(NAME)
    faces = sky_cube().to_convention(convention)
    found = lookup(faces, DIRECTIONS @ turn)
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.03


def test_vtk_looks_up_with_z_mirrored():
    assert "views from inside, +Z and -Z exchanged" in text_of(NAME)
    faces = sky_cube().to_convention("inside")[[0, 1, 2, 3, 5, 4]]
    found = lookup(faces, DIRECTIONS * (1, 1, -1))
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.03


def test_py360converts_faces_are_views_from_inside():
    """F R B L U D in py360convert's own coordinates (its function xyzcube): x right, y up, z to the front."""
    assert "F R B L U D = -Z +X +Z -X +Y -Y" in text_of(NAME)
    inside = cc.CubeMap(sky(unit_texel_directions(32))).to_convention("inside")
    across = (np.arange(32) + 0.5) / 32 * 2 - 1
    x, y = np.meshgrid(across, -across)
    one = np.ones_like(x)
    theirs = {
        cc.Face.NEG_Z: (x, y, one), cc.Face.POS_X: (one, y, -x), cc.Face.POS_Z: (-x, y, -one),
        cc.Face.NEG_X: (-one, y, x), cc.Face.POS_Y: (x, one, -y), cc.Face.NEG_Y: (x, -one, y),
    }  # fmt: skip
    for face, (right, up, front) in theirs.items():
        np.testing.assert_allclose(
            inside[face], sky(np.stack([right, up, -front], axis=-1)), atol=1e-6
        )
