"""CubeMap.sample against the oracle: everywhere, on edges, at corners, in mip levels."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.helpers import channel_counts, dtypes, faces
from tests.reference.cube_faces import face_uv_to_direction, texel_directions
from tests.reference.pattern import direction_pattern, random_faces
from tests.reference.sampling import sample_faces, sample_trilinear


@dtypes
@channel_counts
def test_random_directions(dtype, channels, rng):
    pixels = random_faces(rng, 13, channels, np.dtype(dtype))
    directions = rng.normal(size=(4000, 3)) * rng.uniform(0.01, 100, (4000, 1))
    got = cc.CubeMap(pixels).sample(directions)
    assert got.dtype == np.float32
    assert_close(got, sample_faces(pixels, directions), "lookup")


@pytest.mark.parametrize("size", [1, 2, 3, 64])
def test_texel_centers_give_the_texels(size, rng):
    pixels = random_faces(rng, size)
    assert_close(cc.CubeMap(pixels).sample(texel_directions(size)), pixels, "lookup")


@faces
def test_along_the_edges(face, rng):
    """Lookups very near all four edges and the corners also use the texels of neighbouring faces."""
    pixels = random_faces(rng, 6)
    along = np.linspace(0, 1, 101)
    for offset in (1e-4, 0.02, 0.08):
        for s, t in ((offset, along), (1 - offset, along), (along, offset), (along, 1 - offset)):
            directions = face_uv_to_direction(face, *np.broadcast_arrays(s, t))
            inner = (
                np.abs(along - 0.5) < 0.4999
            )  # exactly on an edge, a driver may choose either face
            assert_close(
                cc.CubeMap(pixels).sample(directions)[inner],
                sample_faces(pixels, directions)[inner],
                "lookup",
            )


@pytest.mark.parametrize("corner", range(8))
def test_corners_average_three_texels(corner, rng):
    pixels = random_faces(rng, 4)
    direction = np.array([1 - 2 * ((corner >> bit) & 1) for bit in range(3)], float)
    towards = (texel_directions(4) @ direction) / np.linalg.norm(texel_directions(4), axis=-1)
    three = pixels.reshape(-1, 4)[np.argsort(-towards.reshape(-1))[:3]]
    assert_close(cc.CubeMap(pixels).sample(direction), three.mean(0), "lookup")


def test_both_sides_of_an_edge_agree(rng):
    cube = cc.CubeMap(random_faces(rng, 8))
    points = rng.uniform(-1, 1, (500, 3))
    axis = rng.integers(0, 3, 500)
    rows = np.arange(500)
    points[rows, axis] = rng.choice([-1, 1], 500)
    points[rows, (axis + 1) % 3] = rng.choice([-1, 1], 500)
    one, other = points.copy(), points.copy()
    one[rows, axis] *= 1 + 1e-6
    other[rows, (axis + 1) % 3] *= 1 + 1e-6
    assert np.abs(cube.sample(one) - cube.sample(other)).max() < 1e-4


def test_directions_come_back_from_a_cube_of_directions(rng):
    directions = rng.normal(size=(50, 20, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    got = cc.CubeMap(direction_pattern(128)).sample(directions)
    assert np.abs(got - directions).max() < 2e-3


@pytest.mark.parametrize("shape", [(3,), (0, 3), (2, 3), (2, 3, 4, 3)])
def test_leading_axes_are_kept(shape):
    cube = cc.CubeMap(direction_pattern(4))
    assert cube.sample(np.ones(shape)).shape == (*shape[:-1], 3)


@pytest.mark.parametrize("lod", [0.0, 0.5, 1.0, 1.75, 2.0, 2.5, 3.0])
def test_levels_are_trilinear(lod, rng):
    pixels = random_faces(rng, 8)
    directions = rng.normal(size=(1000, 3))
    got = cc.CubeMap(pixels, mipmaps=True).sample(directions, lod=lod)
    assert_close(got, sample_trilinear(pixels, directions, lod), "lookup")


def test_lods_are_held_to_the_levels_there_are(rng):
    pixels = random_faces(rng, 8)
    directions = rng.normal(size=(100, 3))
    cube = cc.CubeMap(pixels, mipmaps=True)
    assert_close(cube.sample(directions, lod=-3), sample_faces(pixels, directions), "lookup")
    assert_close(cube.sample(directions, lod=50), cube.sample(directions, lod=3), "exact")


def test_levels_of_a_cube_without_mipmaps_are_refused(rng):
    cube = cc.CubeMap(random_faces(rng, 8))
    with pytest.raises(ValueError, match="mipmaps"):
        cube.sample([0, 0, 1], lod=2)


@pytest.mark.parametrize(
    ("directions", "error"),
    [
        (np.zeros(4), ValueError),
        (np.zeros((2, 2)), ValueError),
        ([np.nan, 0, 1], ValueError),
        ([0, np.inf, 0], ValueError),
        ([0, 0, 0], ValueError),
        ([True, False, True], TypeError),
        ([1j, 0, 0], TypeError),
        ("+x", TypeError),
    ],
)
def test_bad_directions_are_refused(directions, error):
    with pytest.raises(error):
        cc.CubeMap(direction_pattern(4)).sample(directions)


def test_integer_directions_are_taken():
    cube = cc.CubeMap(direction_pattern(64))
    np.testing.assert_allclose(cube.sample([0, 0, 2]), [0, 0, 1], atol=1e-3)
