import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.helpers import dtypes
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import direction_pattern, random_faces
from tests.reference.sampling import mip_levels, sample_faces


def test_growing_is_a_bilinear_lookup(rng):
    pixels = random_faces(rng, 5)
    assert_close(
        cc.CubeMap(pixels).resize(12).faces, sample_faces(pixels, texel_directions(12)), "lookup"
    )


def test_halving_is_the_average_of_four(rng):
    pixels = random_faces(rng, 16)
    assert_close(cc.CubeMap(pixels).resize(8).faces, mip_levels(pixels)[1], "lookup")


def test_shrinking_does_not_alias():
    pixels = (
        (np.indices((64, 64)).sum(0) % 2)[None, :, :, None].repeat(6, axis=0).astype(np.float32)
    )
    assert np.abs(cc.CubeMap(pixels).resize(7).faces - 0.5).max() < 0.1


@dtypes
def test_the_dtype_and_the_same_size_are_kept(dtype, rng):
    pixels = random_faces(rng, 6, 3, np.dtype(dtype))
    assert_identical(cc.CubeMap(pixels).resize(6).faces, pixels)
    assert cc.CubeMap(pixels).resize(3).dtype == np.dtype(dtype)


def test_directions_stay_directions():
    got = cc.CubeMap(direction_pattern(64)).resize(24).faces
    got = got / np.linalg.norm(got, axis=-1, keepdims=True)
    want = texel_directions(24)
    want /= np.linalg.norm(want, axis=-1, keepdims=True)
    assert np.abs(got - want).max() < 2e-3


@pytest.mark.parametrize(
    ("size", "error"), [(0, ValueError), (-1, ValueError), (2.5, TypeError), ("8", TypeError)]
)
def test_bad_sizes_are_refused(size, error):
    with pytest.raises(error):
        cc.CubeMap(direction_pattern(4)).resize(size)
