"""Conventions and layouts: every conversion keeps an asymmetric pattern exactly."""

import itertools

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import channel_counts, conventions, dtypes, layouts
from tests.reference.cube_faces import CONVENTIONS, convert, texel_directions, to_layout
from tests.reference.pattern import face_pattern, random_faces


@conventions
def test_faces_are_held_in_gl(convention):
    pattern = face_pattern(8)
    assert_identical(
        cc.CubeMap(pattern, convention=convention).faces, convert(pattern, convention, "gl")
    )


@pytest.mark.parametrize(("source", "target"), list(itertools.product(CONVENTIONS, repeat=2)))
@dtypes
def test_each_converts_exactly_to_each(source, target, dtype, rng):
    pixels = random_faces(rng, 5, 3, np.dtype(dtype))
    cube = cc.CubeMap(pixels, convention=source)
    assert_identical(cube.to_convention(target), convert(pixels, source, target))
    assert cc.CubeMap(cube.to_convention(target), convention=target) == cube


def test_a_conversion_is_the_callers_own_array():
    cube = cc.CubeMap(face_pattern(4))
    mine = cube.to_convention("gl")
    mine[:] = 0
    assert_identical(cube.faces, face_pattern(4))


@conventions
@layouts
@channel_counts
def test_layouts_agree_with_the_oracle(layout, convention, channels):
    pattern = face_pattern(8, channels)
    picture = cc.CubeMap(pattern).to_layout(layout, convention=convention)
    assert_identical(picture, to_layout(pattern, layout, convention))


@conventions
@layouts
@pytest.mark.parametrize("named", [True, False], ids=["named", "recognised"])
def test_layouts_are_read_back_exactly(layout, convention, named):
    pattern = face_pattern(8)
    picture = to_layout(pattern, layout, convention)
    cube = cc.CubeMap.from_layout(picture, layout=layout if named else None, convention=convention)
    assert_identical(cube.faces, pattern)


def test_horizontal_cross_is_another_name_of_cross():
    cube = cc.CubeMap(face_pattern(4))
    assert_identical(
        cube.to_layout("horizontal_cross", convention="gl"),  # type: ignore[call-overload]
        cube.to_layout("cross", convention="gl"),
    )


def test_default_convention_is_gl():
    cube = cc.CubeMap(face_pattern(4))
    assert_identical(cc.CubeMap.from_layout(to_layout(face_pattern(4), "cross")).faces, cube.faces)


def test_equirect_is_recognised_from_its_shape():
    directions = cc.CubeMap.from_layout(np.ones((16, 32, 3), np.float32))
    np.testing.assert_allclose(directions.faces, 1, atol=1e-6)


def test_one_axis_marked_in_every_convention():
    """Each convention shows in its own place a light that is ahead (-Z), a little to the right (+X) and up."""
    cube = np.zeros((6, 9, 9, 1), np.uint8)
    directions = texel_directions(9)
    nearest = (
        directions @ np.array([0.3, 0.6, -1.0]) / np.linalg.norm(directions, axis=-1)
    ).argmax()
    cube.reshape(-1)[nearest] = 255
    held = cc.CubeMap(cube)
    inside = np.argwhere(held.to_convention("inside"))[0]
    assert inside[0] == 5  # the light is on the face of world -Z ...
    assert inside[1] < 4 < inside[2]  # ... above and right of its middle, as seen from inside
    gl = np.argwhere(held.to_convention("gl"))[0]
    assert gl[0] == 5
    assert gl[2] < 4  # this convention mirrors the face
    three = np.argwhere(held.to_convention("three"))[0]
    assert three[0] == 5
    assert three[2] > 4


@pytest.mark.parametrize("bad", ["opengl", "d3d", "", None, 3])
def test_unknown_conventions_are_refused(bad):
    with pytest.raises((ValueError, TypeError), match=r"gl|convention"):
        cc.CubeMap(face_pattern(4), convention=bad)
    with pytest.raises((ValueError, TypeError), match=r"gl|convention"):
        cc.CubeMap(face_pattern(4)).to_convention(bad)


def test_unknown_layouts_are_refused_naming_those_there_are():
    with pytest.raises(ValueError, match=r"cross.*spiral|spiral.*cross"):
        cc.CubeMap(face_pattern(4)).to_layout("spiral", convention="gl")  # type: ignore[call-overload]


@pytest.mark.parametrize(
    ("shape", "layout"),
    [
        ((10, 13, 3), None),
        ((12, 16, 3), "vertical_cross"),
        ((5, 29, 3), "row"),
        ((12, 15, 3), "cross"),
    ],
)
def test_shapes_that_are_no_layout_are_refused_with_the_shape(shape, layout):
    with pytest.raises(ValueError, match=rf"{shape[0]}|{shape[1]}"):
        cc.CubeMap.from_layout(np.zeros(shape, np.uint8), layout=layout)
