"""From pixels to directions and texels, against the specification's table and the panorama of docs/conventions.md."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.cube_maps import Cross, Look, Panorama
from cubecam.viewer.texels import levels_of, place_in, texel_directions, texel_of
from tests.helpers import conventions, dtypes
from tests.helpers import faces as each_face
from tests.reference import cube_faces, equirect

N = 8
CENTERS = ("-z", "+z", "+x", "-x")
SIZES = [(640, 480), (333, 201), (97, 400)]
sizes = pytest.mark.parametrize("size", SIZES)


def units(directions):
    directions = np.asarray(directions, float)
    return directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def grid(sheet, columns, rows):
    """The pixels of the middles of columns x rows equal parts of a sheet."""
    u = (np.arange(columns) + 0.5) / columns * sheet.wide
    v = (np.arange(rows) + 0.5) / rows * sheet.high
    return np.moveaxis(sheet.pixels(*np.meshgrid(u, v)), -1, 0)


def corners(inwards):
    """The 24 corners of the faces, (24, 3), a little inside each face, and the texels (24, 3) that lie there."""
    found, texels = [], []
    for face in range(6):
        for t in (inwards, 1 - inwards):
            for s in (inwards, 1 - inwards):
                found.append(cube_faces.face_uv_to_direction(face, s, t))
                texels.append((face, int(t * N), int(s * N)))
    return np.array(found), np.array(texels)


@sizes
@conventions
@pytest.mark.parametrize(("zoom", "middle"), [(1, (2, 1.5)), (3.7, (0.4, 2.1))])
def test_each_texel_of_the_cross_is_the_direction_of_the_table(size, convention, zoom, middle):
    cross = Cross(size, convention, zoom, middle)
    got = cross.directions(*grid(cross.sheet, 4 * N, 3 * N))
    expected = cube_faces.to_layout(cube_faces.texel_directions(N), "cross", convention)
    empty = (expected == 0).all(axis=-1)
    assert empty.sum() == 6 * N * N
    assert np.isnan(got[empty]).all()
    np.testing.assert_allclose(got[~empty], expected[~empty], atol=1e-9)


@sizes
@pytest.mark.parametrize("center", CENTERS)
def test_each_pixel_of_the_panorama_is_the_direction_of_the_conventions(size, center):
    panorama = Panorama(size, center, zoom=1.3, middle=(1.1, 0.4))
    got = panorama.directions(*grid(panorama.sheet, 64, 32))
    np.testing.assert_allclose(got, equirect.pixel_directions(64, 32, center), atol=1e-9)


@pytest.mark.parametrize("center", CENTERS)
def test_the_poles_are_the_first_and_the_last_row_and_nothing_lies_beside(center):
    panorama = Panorama((400, 200), center)
    across = np.linspace(0.001, 1.999, 9)
    for v, pole in ((1e-9, 1), (1 - 1e-9, -1)):
        got = panorama.directions(*np.moveaxis(panorama.sheet.pixels(across, np.full(9, v)), -1, 0))
        np.testing.assert_allclose(got, np.tile([0, pole, 0], (9, 1)), atol=1e-7)
    for u, v in ((-0.01, 0.5), (2.01, 0.5), (1, -0.01), (1, 1.01)):
        assert np.isnan(panorama.directions(*panorama.sheet.pixels(u, v))).all()


def rotated(yaw, pitch, vectors):
    """Turn vectors about their own X by pitch, then about the world's Y by yaw (degrees): rotation matrices."""
    a, b = np.radians([yaw, pitch])
    about_y = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    return np.asarray(vectors) @ (about_y @ about_x).T


@sizes
@pytest.mark.parametrize(
    ("yaw", "pitch", "fov"), [(0, 0, 90), (37, 0, 60), (-120, 55, 30), (200, 90, 100), (5, -90, 70)]
)
def test_the_look_is_that_of_a_pinhole_camera(size, yaw, pitch, fov):
    width, height = size
    x, y = np.meshgrid(np.linspace(0, width, 7), np.linspace(0, height, 5))
    tangent = np.tan(np.radians(fov) / 2)
    own = np.stack(
        [(2 * x - width) / height * tangent, (height - 2 * y) / height * tangent, -np.ones_like(x)],
        axis=-1,
    )
    look = Look(size, yaw, pitch, fov)
    np.testing.assert_allclose(look.directions(x, y), rotated(yaw, pitch, own), atol=1e-12)


def test_the_look_is_that_of_the_camera_of_the_package():
    camera = cc.PerspectiveCamera(fov=50)
    camera.yaw(25)
    camera.pitch(-40)
    look = Look((300, 200), 25, -40, 50)
    for x, y in ((0, 0), (300, 0), (70, 160)):
        inverse = np.linalg.inv(camera.projection(aspect=1.5) @ camera.view)
        far = inverse @ [2 * x / 300 - 1, 1 - 2 * y / 200, 0.5, 1]
        ray = far[:3] / far[3] - camera.position
        np.testing.assert_allclose(units(look.directions(x, y)), units(ray), atol=1e-5)


@sizes
@pytest.mark.parametrize(
    "projection",
    [
        *(lambda size, c=c: Cross(size, c, 1.7, (1.2, 1.4)) for c in cube_faces.CONVENTIONS),
        *(lambda size, c=c: Panorama(size, c, 1.7, (1.2, 0.4)) for c in CENTERS),
        lambda size: Look(size, 33, 60, 150),
    ],
)
def test_places_are_the_inverse_of_directions(projection, size):
    projection = projection(size)
    x, y = np.meshgrid(np.linspace(1, size[0] - 1, 40), np.linspace(1, size[1] - 1, 30))
    directions = projection.directions(x, y)
    known = np.isfinite(directions).all(axis=-1)
    assert known.any()
    back = projection.places(directions[known])
    np.testing.assert_allclose(back, np.stack([x, y], axis=-1)[known], atol=1e-6)


@pytest.mark.parametrize("inwards", [0.5 / N, 1e-6])
def test_texels_at_the_24_corners(inwards):
    cube = cc.CubeMap(np.arange(6 * N * N, dtype=np.float32).reshape(6, N, N, 1))
    directions, texels = corners(inwards)
    for direction, (face, row, column) in zip(directions, texels, strict=True):
        texel = texel_of(cube, 7 * direction)
        assert (int(texel.face), texel.row, texel.column) == (face, row, column)
        assert texel.value == (float((face * N + row) * N + column),)
        np.testing.assert_allclose(texel.direction, units(direction))


def test_texels_on_both_sides_of_the_seams():
    along = (np.arange(N) + 0.5) / N
    for face in range(6):
        for side in range(4):
            # Two directions that differ little: one inside the face, one beyond its edge.
            near, beyond = (
                cube_faces.face_uv_to_direction(
                    face,
                    *((edge, along), (1 - edge, along), (along, edge), (along, 1 - edge))[side],
                )
                for edge in (1e-6, -1e-6)
            )
            assert {int(texel_of(cube_of_faces(), d).value[0]) for d in near} == {face}
            other, _, _ = cube_faces.direction_to_face_uv(beyond)
            assert [int(texel_of(cube_of_faces(), d).value[0]) for d in beyond] == other.tolist()
            assert face not in other


def cube_of_faces():
    return cc.CubeMap(np.arange(6, dtype=np.float32).repeat(N * N).reshape(6, N, N, 1))


@conventions
@each_face
def test_a_place_is_where_the_converted_array_has_the_texel(convention, face):
    values = np.arange(6 * N * N).reshape(6, N, N)
    converted = cube_faces.convert(values, "gl", convention)
    for row, column in ((0, 0), (0, N - 1), (5, 2), (N - 1, 0)):
        place = place_in(convention, face, row, column, N)
        slot = cube_faces.FACE_NAMES.index(place.face.lower())
        assert converted[slot, place.row, place.column] == values[face, row, column]


@dtypes
def test_values_are_linear_floats(dtype):
    numbers = (np.arange(6 * 4 * 4 * 4).reshape(6, 4, 4, 4) % 251).astype(dtype)
    if dtype != "uint8":
        numbers = numbers / np.asarray(250, dtype)
    cube = cc.CubeMap(numbers, encoding="srgb")
    texel = texel_of(cube, cube_faces.face_uv_to_direction(3, 0.6, 0.9))
    stored = numbers[3, 3, 2]
    assert texel.stored == tuple(stored.tolist())
    encoded = stored / 255 if dtype == "uint8" else stored.astype(float)
    light = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    light[3] = encoded[3]  # alpha
    np.testing.assert_allclose(texel.value, light, rtol=1e-5)
    raw = texel_of(cc.CubeMap(numbers, encoding="linear"), texel.direction)
    np.testing.assert_allclose(raw.value, encoded, rtol=1e-6)


@pytest.mark.parametrize("size", [8, 6, 5, 1])
def test_levels_are_those_of_the_lookups(size):
    rng = np.random.default_rng(4)
    cube = cc.CubeMap(rng.random((6, size, size, 3)).astype("float32"), mipmaps=True)
    levels = levels_of(cube)
    assert [level.size for level in levels] == [max(1, size >> k) for k in range(size.bit_length())]
    assert levels[0] is cube
    if size == 8:  # where sizes are halves, a level is the mean of four texels
        halves = cube.faces.reshape(6, 4, 2, 4, 2, 3).mean(axis=(2, 4))
        np.testing.assert_allclose(levels[1].faces, halves, atol=1e-6)
    directions = rng.normal(size=(50, 3))
    for k, level in enumerate(levels):
        np.testing.assert_allclose(
            level.sample(directions), cube.sample(directions, lod=k), atol=1e-5
        )


def test_levels_may_be_a_sequence():
    small, large = (cc.CubeMap(np.ones((6, n, n, 3), np.float32)) for n in (2, 8))
    assert levels_of([large, small]) == [large, small]
    assert levels_of(small) == [small]
    grey = cc.CubeMap(np.ones((6, 2, 2, 1), np.float32))
    with pytest.raises(ValueError, match="same channels and encoding"):
        levels_of([large, grey])
    with pytest.raises(ValueError, match="at least one"):
        levels_of([])
    for wrong in (3, [large, 3]):
        with pytest.raises(TypeError, match=r"expected a .*CubeMap.*got int"):
            levels_of(wrong)  # type: ignore[arg-type]


def test_texel_directions_are_those_of_the_table():
    np.testing.assert_allclose(texel_directions(5), cube_faces.texel_directions(5), atol=1e-12)
