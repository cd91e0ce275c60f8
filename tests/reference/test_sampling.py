import numpy as np
import pytest

from cubecam.truth.shading.images import sample_image

from .cube_faces import face_uv_to_direction, texel_directions
from .equirect import (
    CENTERS,
    direction_to_equirect_uv,
    equirect_to_faces,
    equirect_uv_to_direction,
    faces_to_equirect,
    pixel_directions,
)
from .pattern import direction_pattern, random_faces
from .sampling import sample_faces, sample_trilinear


def test_texel_centers_give_the_texels(rng):
    faces = random_faces(rng, 7)
    np.testing.assert_allclose(sample_faces(faces, texel_directions(7)), faces, atol=1e-12)


def test_uint8_counts_as_value_by_255(rng):
    faces = random_faces(rng, 4, dtype=np.uint8)
    np.testing.assert_allclose(sample_faces(faces, texel_directions(4)), faces / 255, atol=1e-12)


def test_both_sides_of_every_edge_agree(rng):
    faces = random_faces(rng, 6)
    along = np.linspace(0.01, 0.99, 37)
    for face in range(6):
        for s, t in ((1e-9, along), (1 - 1e-9, along), (along, 1e-9), (along, 1 - 1e-9)):
            s, t = np.broadcast_arrays(s, t)
            inside = face_uv_to_direction(face, s, t)
            outward = (np.array([s, t]) - 0.5) * (
                np.abs(np.array([s, t]) - 0.5) > 0.499
            ) * 1e-8 + np.array([s, t])
            outside = face_uv_to_direction(face, *outward)
            np.testing.assert_allclose(
                sample_faces(faces, inside), sample_faces(faces, outside), atol=1e-6
            )


def test_corner_is_the_average_of_three(rng):
    faces = random_faces(rng, 5)
    corner = sample_faces(faces, np.array([1.0, 1.0, 1.0]))
    # By the table, the texels at (1, 1, 1) are +X s=0 t=0, +Y s=1 t=1 and +Z s=1 t=0.
    three = faces[0, 0, 0] + faces[2, 4, 4] + faces[4, 0, 4]
    np.testing.assert_allclose(corner, three / 3, atol=1e-6)


def test_directions_held_in_a_cube_come_back(rng):
    directions = rng.normal(size=(1000, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    assert np.abs(sample_faces(direction_pattern(64), directions) - directions).max() < 4e-3


def test_trilinear_averages_and_interpolates(rng):
    faces = random_faces(rng, 8)
    np.testing.assert_allclose(
        sample_trilinear(faces, texel_directions(8), 0), sample_faces(faces, texel_directions(8))
    )
    top = sample_trilinear(faces, np.array([0, 0, 1.0]), 3)
    np.testing.assert_allclose(top, faces[4].astype(float).mean((0, 1)), atol=1e-9)
    middle = sample_trilinear(faces, np.array([0, 0, 1.0]), 2.5)
    np.testing.assert_allclose(
        middle, (sample_trilinear(faces, np.array([0, 0, 1.0]), 2) + top) / 2, atol=1e-9
    )


@pytest.mark.parametrize("center", CENTERS)
def test_equirect_round_trip(center, rng):
    uv = rng.uniform(0.01, 0.99, (2, 500))
    u, v = direction_to_equirect_uv(equirect_uv_to_direction(uv[0], uv[1], center), center)
    np.testing.assert_allclose([u, v], uv, atol=1e-9)


@pytest.mark.parametrize(
    ("center", "u"),
    # field.md 3c: OpenEXR's, three.js's and the camera-forward columns of +X -X +Z -Z
    [("+z", (0.25, 0.75, 0.5, 0)), ("+x", (0.5, 1, 0.75, 0.25)), ("-z", (0.75, 0.25, 1, 0.5))],
)
def test_equirect_golden_columns(center, u):
    axes = np.array([[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]], float)
    found, v = direction_to_equirect_uv(axes, center)
    np.testing.assert_allclose((found - u) % 1 % 1.0, 0, atol=1e-12)
    np.testing.assert_allclose(v, 0.5)


def test_equirect_row_0_is_up():
    assert pixel_directions(64, 32)[0, :, 1].min() > 0.99


@pytest.mark.parametrize("center", CENTERS)
def test_equirect_to_cube_and_back_keeps_directions(center):
    image = pixel_directions(512, 256, center)
    faces = equirect_to_faces(image, 64, center)
    unit = texel_directions(64)
    unit /= np.linalg.norm(unit, axis=-1, keepdims=True)
    assert np.abs(faces - unit).max() < 0.01
    assert np.abs(faces_to_equirect(faces, 512, center) - image).max() < 0.015


def test_image_uv_0_0_is_the_bottom_left():
    image = np.arange(6.0).reshape(2, 3, 1)
    assert sample_image(image, np.array([1 / 6, 0.25])) == image[1, 0]
    assert sample_image(image, np.array([5 / 6, 0.75])) == image[0, 2]
    assert sample_image(image, np.array([0.0, 0.25])) == (image[1, 0] + image[1, 2]) / 2
    assert sample_image(image, np.array([0.0, 0.25]), "clamp") == image[1, 0]
