"""CubeMap as a value: what the class accepts, what it returns and what it refuses."""

import copy
import gc
import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import channel_counts, copies, dtypes, faces
from tests.reference.cube_faces import FACE_NAMES
from tests.reference.pattern import face_pattern, random_faces


@dtypes
@channel_counts
def test_keeps_dtype_channels_and_every_bit(dtype, channels, rng):
    pixels = random_faces(rng, 5, channels, np.dtype(dtype))
    cube = cc.CubeMap(pixels)
    assert (cube.size, cube.channels, cube.dtype, cube.mipmaps) == (
        5,
        channels,
        np.dtype(dtype),
        False,
    )
    assert_identical(cube.faces, pixels)


def test_float64_becomes_float32():
    assert cc.CubeMap(np.ones((6, 2, 2, 3))).dtype == np.float32


def test_any_memory_order_is_taken(rng):
    pixels = random_faces(rng, 6)
    strided = np.asfortranarray(pixels)[:, ::2, ::-1][:, :, ::2]
    assert_identical(cc.CubeMap(strided).faces, np.ascontiguousarray(strided))


def test_the_array_given_is_copied(rng):
    pixels = random_faces(rng, 4)
    kept = pixels.copy()
    cube = cc.CubeMap(pixels)
    pixels[:] = 7
    assert_identical(cube.faces, kept)


def test_views_are_read_only_and_outlive_their_owner(rng):
    pixels = random_faces(rng, 32)
    view = cc.CubeMap(pixels).faces
    gc.collect()
    noise = [np.full((6, 32, 32, 4), 9, np.float32) for _ in range(20)]  # may reuse freed memory
    assert_identical(view, pixels)
    assert noise
    with pytest.raises(ValueError, match="read-only"):
        view[0, 0, 0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        view.flags.writeable = True


def test_an_old_view_does_not_change_under_set_face(rng):
    pixels = random_faces(rng, 4)
    cube = cc.CubeMap(pixels)
    view = cube.faces
    cube.set_face(0, np.zeros((4, 4, 4), np.float32))
    assert_identical(view, pixels)
    assert not cube.faces[0].any()


@faces
@pytest.mark.parametrize("spelling", ["name", "number", "enum"])
def test_set_face_replaces_one_face(face, spelling, rng):
    pixels = random_faces(rng, 4, dtype=np.uint8)
    cube = cc.CubeMap(pixels)
    new = rng.integers(0, 256, (4, 4, 4), dtype=np.uint8)
    which = {"name": FACE_NAMES[face], "number": face, "enum": list(cc.Face)[face]}[spelling]
    cube.set_face(which, new)
    pixels[face] = new
    assert_identical(cube.faces, pixels)


def test_face_enum_is_in_gl_order():
    names = ["POS_X", "NEG_X", "POS_Y", "NEG_Y", "POS_Z", "NEG_Z"]
    assert [face.name for face in cc.Face] == names
    assert [int(face) for face in cc.Face] == list(range(6))


@faces
def test_set_face_in_a_convention_puts_it_where_the_constructor_does(face):
    pattern = face_pattern(8)
    for convention in ("inside", "three"):
        cube = cc.CubeMap(np.zeros_like(pattern))
        for index in range(6):
            cube.set_face(index, pattern[index], convention=convention)
        assert_identical(cube.faces, cc.CubeMap(pattern, convention=convention).faces)


@pytest.mark.parametrize(
    ("which", "error"),
    [(6, IndexError), (-1, IndexError), ("left", ValueError), ("+w", ValueError), (1.5, TypeError)],
)
def test_set_face_refuses_what_is_no_face(which, error):
    with pytest.raises(error):
        cc.CubeMap(face_pattern(4)).set_face(which, face_pattern(4)[0])


def test_set_face_refuses_other_shapes_with_both_sizes():
    cube = cc.CubeMap(face_pattern(8))
    with pytest.raises(ValueError, match=r"8.*4|4.*8"):
        cube.set_face(0, face_pattern(4)[0])
    with pytest.raises(ValueError, match="8"):
        cube.set_face(0, np.zeros((8, 9, 4), np.uint8))
    assert_identical(cube.faces, face_pattern(8))


def test_equality_compares_contents():
    pattern = face_pattern(4)
    cube = cc.CubeMap(pattern)
    assert cube == cc.CubeMap(pattern)
    assert (cube != cc.CubeMap(pattern)) is False
    changed = pattern.copy()
    changed[5, 3, 3, 2] ^= 1
    assert cube != cc.CubeMap(changed)
    assert cube != cc.CubeMap(pattern.astype(np.float32))
    assert cube != "cube"


@copies
@pytest.mark.parametrize("mipmaps", [False, True])
def test_copies_are_equal_and_independent(make_copy, mipmaps, rng):
    cube = cc.CubeMap(random_faces(rng, 4, 3, np.float16), mipmaps=mipmaps)
    other = make_copy(cube)
    assert other == cube
    assert other.mipmaps is mipmaps
    other.set_face(2, np.zeros((4, 4, 3), np.float16))
    assert other != cube
    assert cube.faces[2].any()


def test_copy_is_independent(rng):
    cube = cc.CubeMap(random_faces(rng, 4))
    other = copy.copy(cube)
    other.set_face(0, np.zeros((4, 4, 4), np.float32))
    assert cube.faces[0].any()


def test_captured_outputs_are_none_unless_captured():
    cube = cc.CubeMap(face_pattern(4))
    for name in ("distance", "z", "normal", "position", "id"):
        assert getattr(cube, name) is None


def test_repr_says_size_channels_and_dtype():
    text = repr(cc.CubeMap(face_pattern(8, 3)))
    for word in ("CubeMap", "8", "uint8"):
        assert word in text


def test_picture_of_itself_is_a_png():
    png = cc.CubeMap(face_pattern(8))._repr_png_()
    assert png.startswith(b"\x89PNG")


def test_pickle_keeps_no_revision():
    """Equal cubes pickle to equal bytes, also after different changes."""
    a, b = cc.CubeMap(face_pattern(4)), cc.CubeMap(np.zeros((6, 4, 4, 4), np.uint8))
    for face, pixels in enumerate(face_pattern(4)):
        b.set_face(face, pixels)
    assert pickle.dumps(a) == pickle.dumps(b)


def test_the_picture_of_a_cube_is_unmirrored_seen_from_within():
    """-Z is in the middle, +X right of it and +Y above it; each pixel shows what lies in its direction."""
    from cubecam.pictures import cube_picture

    size = 4
    cube = cc.CubeMap(face_pattern(size))
    picture = cube_picture(cube)
    x, y = np.meshgrid(
        (np.arange(size) + 0.5) / size * 2 - 1, 1 - (np.arange(size) + 0.5) / size * 2
    )
    one = np.ones_like(x)
    cells = {(1, 1): (x, y, -one), (1, 2): (one, y, x), (1, 0): (-one, y, -x), (1, 3): (-x, y, one)}
    cells |= {(0, 1): (x, one, y), (2, 1): (x, -one, -y)}
    for (row, column), direction in cells.items():
        cell = picture[row * size : (row + 1) * size, column * size : (column + 1) * size]
        want = np.rint(cube.sample(np.stack(direction, axis=-1)) * 255)
        np.testing.assert_array_equal(cell[..., :3], want[..., :3], f"row {row}, column {column}")
