"""Arrays are checked for shape, dtype, finite numbers and range before they are used."""

import numpy as np
import pytest

import cubecam as cc
from tests.reference.pattern import face_pattern

SHAPES = {
    "five faces": (5, 4, 4, 3),
    "not square": (6, 4, 5, 3),
    "two channels": (6, 4, 4, 2),
    "five channels": (6, 4, 4, 5),
    "no channels": (6, 4, 4),
    "empty": (6, 0, 0, 3),
    "one face": (4, 4, 3),
}


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_cubemap_shapes(shape):
    with pytest.raises(ValueError, match=r"expected.*got"):
        cc.CubeMap(np.zeros(shape, np.uint8))


def test_unequal_faces_are_refused_with_both_sizes():
    with pytest.raises(ValueError, match=r"8.*4|4.*8"):
        cc.CubeMap([np.zeros((8, 8, 3), np.uint8)] * 5 + [np.zeros((4, 4, 3), np.uint8)])


@pytest.mark.parametrize(
    "pixels",
    [
        np.zeros((6, 2, 2, 3), bool),
        np.zeros((6, 2, 2, 3), complex),
        np.zeros((6, 2, 2, 3), object),
        np.zeros((6, 2, 2, 3), "U3"),
        "faces",
        None,
    ],
    ids=["bool", "complex", "object", "str", "text", "none"],
)
def test_cubemap_dtypes(pixels):
    with pytest.raises(TypeError):
        cc.CubeMap(pixels)


def test_nan_pixels_are_refused_with_their_place():
    pixels = np.zeros((6, 4, 4, 3), np.float32)
    pixels[3, 1, 2, 0] = np.nan
    with pytest.raises(ValueError, match=r"(?i)nan"):
        cc.CubeMap(pixels)
    cube = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32))
    with pytest.raises(ValueError, match=r"(?i)nan"):
        cube.set_face(0, pixels[3])


TRIANGLE = {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "indices": [[0, 1, 2]]}
BAD_MESHES = {
    "positions of 2": ({"positions": [[0, 0], [1, 0], [0, 1]]}, ValueError, "positions"),
    "positions flat": ({"positions": [0, 0, 0]}, ValueError, "positions"),
    "positions nan": (
        {"positions": [[0, 0, np.nan], [1, 0, 0], [0, 1, 0]]},
        ValueError,
        "positions",
    ),
    "positions inf": (
        {"positions": [[0, 0, np.inf], [1, 0, 0], [0, 1, 0]]},
        ValueError,
        "positions",
    ),
    "positions too large": (
        {"positions": [[0, 0, 1e39], [1, 0, 0], [0, 1, 0]]},
        ValueError,
        "positions",
    ),
    "positions bool": ({"positions": np.zeros((3, 3), bool)}, TypeError, "positions"),
    "positions complex": ({"positions": np.zeros((3, 3), complex)}, TypeError, "positions"),
    "positions text": ({"positions": [["a", "b", "c"]] * 3}, TypeError, "positions"),
    "indices of 4": ({"indices": [[0, 1, 2, 0]]}, ValueError, "indices"),
    "indices flat": ({"indices": [0, 1, 2]}, ValueError, "indices"),
    "indices float": ({"indices": [[0.0, 1.0, 2.0]]}, TypeError, "indices"),
    "indices too large": ({"indices": [[0, 1, 3]]}, IndexError, "3"),
    "indices negative": ({"indices": [[0, 1, -1]]}, IndexError, "-1"),
    "no triangle": ({"indices": np.zeros((0, 3), int)}, ValueError, "triangle"),
    "normals of 2 vertices": ({"normals": [[0, 0, 1]] * 2}, ValueError, "normals"),
    "normals nan": ({"normals": [[0, 0, np.nan]] * 3}, ValueError, "normals"),
    "uvs of 3": ({"uvs": [[0, 0, 0]] * 3}, ValueError, "uvs"),
    "uvs inf": ({"uvs": [[0, np.inf]] * 3}, ValueError, "uvs"),
    "colors of 2": ({"colors": [[0, 0]] * 3}, ValueError, "colors"),
    "colors of 2 vertices": ({"colors": [[0, 0, 0]] * 2}, ValueError, "colors"),
    "colors nan": ({"colors": [[0, np.nan, 0]] * 3}, ValueError, "colors"),
}


@pytest.mark.parametrize(("change", "error", "text"), BAD_MESHES.values(), ids=BAD_MESHES)
def test_meshes(change, error, text):
    with pytest.raises(error, match=text):
        cc.Mesh(**{**TRIANGLE, **change})


@pytest.mark.parametrize("dtype", ["float16", "float32", "float64", "int8", "int64", "uint16"])
def test_real_numbers_of_any_width_are_converted(dtype):
    mesh = cc.Mesh(np.array(TRIANGLE["positions"], dtype), TRIANGLE["indices"])
    assert mesh.positions.dtype == np.float32
    np.testing.assert_array_equal(mesh.positions, TRIANGLE["positions"])


@pytest.mark.parametrize("dtype", ["int8", "uint8", "int32", "uint64", "int64"])
def test_indices_of_any_width_are_converted(dtype):
    mesh = cc.Mesh(TRIANGLE["positions"], np.array(TRIANGLE["indices"], dtype))
    np.testing.assert_array_equal(mesh.indices, TRIANGLE["indices"])


@pytest.mark.parametrize(
    ("pixels", "error"),
    [
        (np.zeros((4, 4, 2), np.uint8), ValueError),
        (np.zeros((4,), np.uint8), ValueError),
        (np.zeros((0, 4, 3), np.uint8), ValueError),
        (np.full((4, 4, 3), np.nan), ValueError),
        (np.zeros((4, 4, 3), bool), TypeError),
        (np.zeros((4, 4, 3), complex), TypeError),
        ("picture.png", TypeError),
    ],
)
def test_images(pixels, error):
    with pytest.raises(error):
        cc.Image(pixels)


def test_image_wrap_is_checked():
    with pytest.raises(ValueError, match=r"repeat.*edge"):
        cc.Image(np.zeros((4, 4, 3), np.uint8), wrap="edge")  # type: ignore[arg-type]


def test_bad_input_leaves_the_cube_as_it_was():
    cube = cc.CubeMap(face_pattern(4))
    for bad in (
        np.zeros((3, 3, 4), np.uint8),
        np.full((4, 4, 4), np.nan),
        "x",
        np.zeros((4, 4, 4), bool),
    ):
        with pytest.raises((ValueError, TypeError)):
            cube.set_face(0, bad)
    assert cube == cc.CubeMap(face_pattern(4))
