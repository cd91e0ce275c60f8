"""Equirect to cube and back: golden directions, the oracle, round trips, and no aliasing."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.reference.cube_faces import texel_directions, unit_texel_directions
from tests.reference.equirect import (
    direction_to_equirect_uv,
    equirect_to_faces,
    faces_to_equirect,
    pixel_directions,
)
from tests.reference.pattern import direction_pattern, random_faces

centers = pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])


@centers
def test_a_cube_of_directions_becomes_a_picture_of_directions(center):
    got = cc.CubeMap(direction_pattern(64)).to_equirect(width=256, center=center)
    assert got.dtype == np.float32
    assert np.abs(got - pixel_directions(256, 128, center)).max() < 5e-3


@centers
def test_a_picture_of_directions_becomes_a_cube_of_directions(center):
    image = pixel_directions(512, 256, center).astype(np.float32)
    got = cc.CubeMap.from_equirect(image, size=32, center=center)
    assert np.abs(got.faces - unit_texel_directions(32)).max() < 5e-3


def test_minus_z_is_the_default_center():
    got = cc.CubeMap(direction_pattern(32)).to_equirect(width=128)
    np.testing.assert_allclose(got[31:33, 63:65].mean((0, 1)), [0, 0, -1], atol=2e-2)
    np.testing.assert_allclose(got[31:33, 95:97].mean((0, 1)), [1, 0, 0], atol=2e-2)
    assert got[0, :, 1].min() > 0.99


@centers
def test_to_equirect_equals_the_oracle_where_pixels_are_small(center, rng):
    pixels = random_faces(rng, 4)
    got = cc.CubeMap(pixels).to_equirect(width=128, center=center)
    assert_close(got, faces_to_equirect(pixels, 128, center), "resample")


@centers
def test_from_equirect_equals_the_oracle_where_texels_are_small(center, rng):
    """The comparison leaves out the poles, where the pixels of a row are narrower than any texel."""
    image = rng.random((16, 32, 3)).astype(np.float32)
    got = cc.CubeMap.from_equirect(image, size=64, center=center)
    _, v = direction_to_equirect_uv(texel_directions(64), center)
    assert_close(
        got.faces, equirect_to_faces(image, 64, center), "resample", mask=np.abs(v - 0.5) < 0.25
    )


def test_uint8_counts_as_value_by_255():
    cube = cc.CubeMap(np.full((6, 4, 4, 3), 51, np.uint8))
    np.testing.assert_allclose(cube.to_equirect(dtype="float32"), 0.2, atol=1e-6)
    fifth = np.full((8, 16, 3), 51, np.uint8)
    assert cc.CubeMap.from_equirect(fifth, dtype="float32").faces == pytest.approx(0.2)


def test_default_sizes():
    cube = cc.CubeMap(direction_pattern(16))
    assert cube.to_equirect().shape == (32, 64, 3)
    # The size is the next power of two >= width / pi: 512 / pi = 163.
    assert cc.CubeMap.from_equirect(np.zeros((256, 512, 3), np.float32)).size == 256
    assert cc.CubeMap.from_equirect(np.zeros((32, 64, 1), np.float32)).channels == 1


@centers
def test_round_trip_of_a_smooth_picture(center):
    directions = pixel_directions(256, 128, center)
    image = (0.5 + 0.4 * np.sin(3 * directions[..., :1]) * np.cos(2 * directions[..., 1:2])).astype(
        np.float32
    )
    back = cc.CubeMap.from_equirect(image, size=128, center=center).to_equirect(
        width=256, center=center
    )
    assert np.abs(back - image).max() < 4e-3


def test_no_seam_at_the_back():
    """The first and the last column differ no more than any two neighbours do."""
    image = cc.CubeMap(direction_pattern(64)).to_equirect(width=256)
    steps = np.abs(np.diff(image, axis=1)).max()
    assert np.abs(image[:, 0] - image[:, -1]).max() <= steps * 1.05


def test_stripes_do_not_alias_when_shrinking():
    """Stripes of one pixel average to grey; one lookup per texel would give black and white."""
    image = np.zeros((256, 512, 1), np.float32)
    image[:, ::2] = 1
    cube = cc.CubeMap.from_equirect(image, size=16)
    assert np.abs(cube.faces - 0.5).max() < 0.1
    rows = np.zeros((256, 512, 1), np.float32)
    rows[::2] = 1
    assert np.abs(cc.CubeMap.from_equirect(rows, size=16).faces - 0.5).max() < 0.1


def test_the_pole_is_the_average_of_its_row():
    image = np.zeros((64, 128, 1), np.float32)
    image[0] = np.linspace(0, 1, 128)[:, None]
    image[1] = image[0]
    top = cc.CubeMap.from_equirect(image, size=33).faces[2, 16, 16]
    np.testing.assert_allclose(top, 0.5, atol=0.02)


def test_checks_do_not_alias_when_shrinking_to_equirect():
    pixels = (
        (np.indices((64, 64)).sum(0) % 2)[None, :, :, None].repeat(6, axis=0).astype(np.float32)
    )
    assert np.abs(cc.CubeMap(pixels).to_equirect(width=16) - 0.5).max() < 0.1


def test_mean_light_is_kept(rng):
    """The solid-angle mean of an HDR picture with one very bright pixel survives the way to a small cube."""
    image = np.full((128, 256, 1), 0.1, np.float32)
    image[40, 77] = 5000
    rows = np.sin((np.arange(128) + 0.5) / 128 * np.pi)[:, None, None]
    before = (image * rows).sum() / (rows.sum() * 256)
    cube = cc.CubeMap.from_equirect(image, size=16)
    weights = np.linalg.norm(texel_directions(16), axis=-1, keepdims=True) ** -3
    after = (cube.faces * weights).sum() / weights.sum()
    assert after == pytest.approx(before, rel=0.15)


@pytest.mark.parametrize("bad", ["+y", "front", "", "z"])
def test_unknown_centers_are_refused(bad):
    with pytest.raises(ValueError, match="center"):
        cc.CubeMap(direction_pattern(4)).to_equirect(center=bad)
    with pytest.raises(ValueError, match="center"):
        cc.CubeMap.from_equirect(np.zeros((8, 16, 3)), center=bad)


@pytest.mark.parametrize("shape", [(8, 15, 3), (16, 8, 3), (8, 16), (8, 16, 2), (0, 0, 3)])
def test_pictures_that_are_no_equirect_are_refused(shape):
    with pytest.raises(ValueError, match=r"expected.*got"):
        cc.CubeMap.from_equirect(np.zeros(shape, np.float32))


@pytest.mark.parametrize(
    ("width", "error"), [(0, ValueError), (-4, ValueError), (7, ValueError), (4.5, TypeError)]
)
def test_bad_widths_are_refused(width, error):
    with pytest.raises(error):
        cc.CubeMap(direction_pattern(4)).to_equirect(width=width)


def sample_over_the_poles(image, directions):
    """Sample bilinearly; beyond a pole, the rows continue on the other side, half a turn away."""
    height, width = image.shape[:2]
    u, v = direction_to_equirect_uv(directions)
    x, y = u * width - 0.5, v * height - 0.5
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - column)[..., None], (y - row)[..., None]

    def texel(r, c):
        beyond = (r < 0) | (r >= height)
        r = np.where(r < 0, -1 - r, np.where(r >= height, 2 * height - 1 - r, r))
        return image[r, (c + np.where(beyond, width // 2, 0)) % width]

    top = texel(row, column) * (1 - fx) + texel(row, column + 1) * fx
    bottom = texel(row + 1, column) * (1 - fx) + texel(row + 1, column + 1) * fx
    return top * (1 - fy) + bottom * fy


def test_rows_go_on_beyond_the_poles_of_a_small_picture(rng):
    """The mask leaves out the texels at a pole, because they are wider than the pixels of a row there."""
    image = rng.random((8, 16, 3)).astype(np.float32)
    cube = cc.CubeMap.from_equirect(image, size=64)
    directions = unit_texel_directions(64)
    polar = np.degrees(np.arccos(np.abs(directions[..., 1])))
    mask = (polar > 5) & (polar < 180 / 16)  # half a row is 180 / 16 degrees
    want = sample_over_the_poles(image, directions)
    assert_close(cube.faces[2:4], want[2:4], "resample", mask=mask[2:4], least=0.02)


@pytest.mark.parametrize("width", [18, 20, 28, 32, 36])
def test_every_width_equals_the_oracle(width, rng):
    """The side faces look alike only if an eighth of a turn is a whole number of pixels."""
    pixels = random_faces(rng, 1)
    smooth = cc.CubeMap(pixels).resize(2).faces
    got = cc.CubeMap(smooth).to_equirect(width=width)
    assert_close(got, faces_to_equirect(smooth, width), "resample")
