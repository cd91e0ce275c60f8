"""Infinite numbers in a cubemap, such as distances of the background: no NaN beside them."""

import itertools

import numpy as np
import pytest

import cubecam as cc
from tests.captures import with_outputs
from tests.reference.cube_faces import texel_directions
from tests.reference.equirect import pixel_directions
from tests.reference.sampling import mip_levels, sample_faces

SIZE = 8
RANDOM = np.random.default_rng(8)
NUMBERS = RANDOM.random((6, SIZE, SIZE, 3)).astype(np.float32)
#: Where a number is infinite: by itself in one channel, and in all channels of whole regions.
FAR = RANDOM.random(NUMBERS.shape) < 0.05
FAR[0, :, 3:] = FAR[2, 6:, :5] = True


def cube_of(special, mipmaps=False, dtype=np.float32):
    faces = np.where(FAR, np.float32(special), NUMBERS).astype(dtype)
    return with_outputs(faces, {}, mipmaps=mipmaps)


DIRECTIONS = RANDOM.normal(size=(500, 3))
#: Each way to read a cube.
READ = {
    "sample": lambda c: c.sample(DIRECTIONS),
    "sample texels": lambda c: c.sample(texel_directions(SIZE)),
    "sample levels": lambda c: (
        c.sample(DIRECTIONS, lod=np.linspace(0, 4, 500)) if c.mipmaps else c.sample(DIRECTIONS)
    ),
    "panorama": lambda c: c.to_equirect(width=32),
    "panorama, larger": lambda c: c.to_equirect(width=120),
    "panorama, odd": lambda c: c.to_equirect(width=54),
    "panorama, smaller": lambda c: c.to_equirect(width=12),
    "panorama, tiny": lambda c: c.to_equirect(width=2),
    "panorama with borders": lambda c: c.to_equirect(width=36, sampling="borders"),
    "the same size": lambda c: c.resize(SIZE).faces,
    "larger": lambda c: c.resize(19).faces,
    "half": lambda c: c.resize(SIZE // 2).faces,
    "odd": lambda c: c.resize(5).faces,
    "small": lambda c: c.resize(3).faces,
    "one": lambda c: c.resize(1).faces,
    "openexr": lambda c: c.to_layout("openexr"),
    "from openexr": lambda c: (
        cc.CubeMap.from_layout(c.to_layout("column", convention="inside"), layout="openexr").faces
    ),
}
reads = pytest.mark.parametrize("read", READ.values(), ids=READ)
#: A share of an infinite texel that is surely none, and one that is surely some, for float32.
NONE, SOME = 1e-7, 1e-5


def shares(read):
    """How much of each number is taken from the texels that FAR marks."""
    return read(with_outputs(FAR.astype(np.float32), {}))


@reads
@pytest.mark.parametrize("mipmaps", [False, True])
@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize("special", [np.inf, -np.inf])
def test_weight_decides(read, special, channels, mipmaps):
    """A number is infinite where an infinite texel has a weight; elsewhere it is what it is without infinity."""

    def made(faces):
        return read(with_outputs(np.ascontiguousarray(faces[..., :channels]), {}, mipmaps=mipmaps))

    got = made(np.where(FAR, np.float32(special), NUMBERS))
    share = made(FAR.astype(np.float32))
    finite = made(np.where(FAR, np.float32(0), NUMBERS))
    assert not np.isnan(got).any()
    np.testing.assert_array_equal(got[share > SOME], special)
    untouched = share <= NONE
    np.testing.assert_allclose(got[untouched], finite[untouched], rtol=0, atol=3e-7)
    assert (share > SOME).any()
    assert untouched.any() or share.size <= 18


@pytest.mark.parametrize("read", [READ[n] for n in READ if n != "from openexr"])  # that refuses NaN
def test_nan_stays_where_it_has_weight(read):
    got, share = read(cube_of(np.nan)), shares(read)
    assert np.isnan(got[share > SOME]).all()
    assert np.isfinite(got[share <= NONE]).all()


def test_halves_and_bytes_of_the_result():
    far = cube_of(np.inf, dtype=np.float16)
    assert not np.isnan(far.to_equirect(width=40)).any()
    assert far.to_equirect(width=40).dtype == np.float16
    eight = cube_of(np.inf).to_equirect(width=40, dtype="uint8")
    assert set(eight[shares(lambda c: c.to_equirect(width=40)) > SOME].tolist()) == {255}


def test_lookups_by_numpy():
    """numpy knows nothing of sums without a weight, so it gives the shares and the numbers by themselves."""
    far = cube_of(np.inf)
    for got, directions in (
        (far.sample(DIRECTIONS), DIRECTIONS),
        (far.to_equirect(width=128), pixel_directions(128, 64)),
        (far.resize(24).faces, texel_directions(24)),
    ):
        share = sample_faces(FAR.astype(float), directions)
        want = sample_faces(np.where(FAR, 0, NUMBERS), directions)
        assert (share > SOME).any()
        assert np.isposinf(got[share > SOME]).all()
        untouched = share <= NONE
        assert untouched.any()
        np.testing.assert_allclose(got[untouched], want[untouched], rtol=0, atol=2e-5)


def test_levels_by_numpy():
    """In each level a texel is infinite if one of the four below it is."""
    far = cube_of(np.inf, mipmaps=True)
    for level, want in enumerate(mip_levels(np.where(FAR, np.inf, NUMBERS))):
        directions = texel_directions(want.shape[1])
        np.testing.assert_allclose(far.sample(directions, lod=level), want, rtol=0, atol=2e-6)


def test_opposite_infinities_give_nan_only_in_a_mixture():
    faces = np.zeros((6, 4, 4, 1), np.float32)
    faces[4, 1, 1], faces[4, 1, 2] = np.inf, -np.inf
    got = with_outputs(faces, {}).resize(2).faces
    assert np.isposinf(got[4, 0, 0, 0])
    assert np.isneginf(got[4, 0, 1, 0])
    assert np.isnan(with_outputs(faces, {}).resize(1).faces[4, 0, 0, 0])


def test_great_numbers_do_not_overflow():
    """The difference of two such numbers is infinite in float32, their average is not."""
    faces = np.full((6, 2, 2, 1), 3e38, np.float32)
    faces[:, 0] = -3e38
    for got in (
        with_outputs(faces, {}).resize(1).faces,
        with_outputs(faces, {}, mipmaps=True).sample(texel_directions(1), lod=1),
    ):
        np.testing.assert_allclose(got, 0, atol=1e32)


@pytest.mark.parametrize(("face", "row", "column"), [*itertools.product((0, 3, 5), (0, 3), (0, 3))])
def test_corners_are_averages_of_three(face, row, column):
    """The fourth texel at a corner is the average of three, of which one may be infinite."""
    faces = np.ones((6, 4, 4, 1), np.float32)
    faces[face, row, column] = np.inf
    got = cc.CubeMap(faces).to_equirect(width=64)
    assert not np.isnan(got).any()
    assert set(got[np.isfinite(got)].tolist()) == {1.0}
    assert np.isinf(got).any()


def test_from_equirect_has_no_nan():
    """Panoramas are photographs there: infinity counts as the largest number (test_cubemap_dtypes.py)."""
    panorama = cube_of(np.inf).to_equirect(width=64)
    assert np.isfinite(cc.CubeMap.from_equirect(panorama, size=16).faces).all()
