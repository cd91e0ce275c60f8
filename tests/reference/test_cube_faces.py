import numpy as np
import pytest

from .cube_faces import (
    CONVENTIONS,
    FACE_IDS,
    FORWARD,
    LAYOUTS,
    UP,
    convert,
    direction_to_face_uv,
    face_uv_to_direction,
    texel_directions,
    to_layout,
    view_rotation,
)
from .pattern import dihedral, face_pattern

faces = pytest.mark.parametrize("face", range(6), ids=FACE_IDS)


@faces
def test_the_center_of_a_face_is_its_axis(face):
    np.testing.assert_array_equal(face_uv_to_direction(face, 0.5, 0.5), FORWARD[face])


@faces
def test_capture_camera_sees_s_to_the_right_and_t_upwards_in_its_own_frame(face):
    """Row 0 of a render target is the bottom of the view and has t = 0; the table's `up` takes this into account."""
    right, up, _ = view_rotation(face)
    np.testing.assert_array_equal(face_uv_to_direction(face, 1, 0.5), FORWARD[face] + right)
    np.testing.assert_array_equal(face_uv_to_direction(face, 0.5, 1), FORWARD[face] + up)
    np.testing.assert_array_equal(up, UP[face])


@pytest.mark.parametrize("face", [0, 1, 4, 5])
def test_row_0_of_the_side_faces_is_world_up(face):
    assert face_uv_to_direction(face, 0.5, 0.0)[1] == 1


def test_round_trip_of_random_directions():
    directions = np.random.default_rng(1).normal(size=(10_000, 3))
    face, s, t = direction_to_face_uv(directions)
    back = np.empty_like(directions)
    for i in range(6):
        rows = face == i
        back[rows] = face_uv_to_direction(i, s[rows], t[rows])
    scale = np.abs(directions).max(-1, keepdims=True)
    np.testing.assert_allclose(back * scale, directions, atol=1e-12)


def test_texel_directions_find_their_texel():
    face, s, t = direction_to_face_uv(texel_directions(5))
    assert (face == np.arange(6)[:, None, None]).all()
    np.testing.assert_allclose(s[0, 0] * 5, np.arange(5) + 0.5)
    np.testing.assert_allclose(t[3, :, 0] * 5, np.arange(5) + 0.5)


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_conversions_undo_themselves(convention):
    pattern = face_pattern(8)
    np.testing.assert_array_equal(
        convert(convert(pattern, "gl", convention), convention, "gl"), pattern
    )


def test_golden_texel_of_inside_and_three():
    """The texel towards (1, .9, .9) is top left on gl's +X, so it is top right on the same face seen from inside."""
    cube = np.zeros((6, 10, 10, 1))
    face, s, t = direction_to_face_uv(np.array([1, 0.9, 0.9]))
    cube[face, int(t * 10), int(s * 10)] = 1
    assert cube[0, 0, 0] == 1
    assert convert(cube, "gl", "inside")[0, 0, 9] == 1
    assert convert(cube, "gl", "three")[1, 0, 9] == 1


def continuous_in_picture(a, b, side):
    """Whether two neighbouring cells of directions meet: the texels beside the common edge are close."""
    first, second = (a[:, -1], b[:, 0]) if side == "right" else (a[-1], b[0])
    return np.abs(first - second).max() < 3 / len(a)


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("layout", ["cross", "vertical_cross"])
def test_neighbouring_cells_of_a_cross_meet(layout, convention):
    n = 16
    unit = texel_directions(n)
    unit /= np.linalg.norm(unit, axis=-1, keepdims=True)
    picture = to_layout(unit, layout, convention)
    cells = {}
    for row in range(picture.shape[0] // n):
        for column in range(picture.shape[1] // n):
            cell = picture[row * n : (row + 1) * n, column * n : (column + 1) * n]
            if cell.any():
                cells[row, column] = cell
    assert len(cells) == 6
    joints = 0
    for (row, column), cell in cells.items():
        for other, side in (((row, column + 1), "right"), ((row + 1, column), "below")):
            if other in cells:
                joints += 1
                assert continuous_in_picture(cell, cells[other], side), (row, column, side)
    assert joints == 5


def test_golden_cells_of_the_horizontal_crosses():
    """The middle row shows, by the names of the faces, -X +Z +X -Z in gl and three, and -X -Z +X +Z in inside."""
    numbers = np.broadcast_to(np.arange(1, 7)[:, None, None, None], (6, 2, 2, 1))
    for convention, row in {
        "gl": [2, 5, 1, 6],
        "inside": [2, 6, 1, 5],
        "three": [1, 5, 2, 6],
    }.items():
        picture = to_layout(numbers, "cross", convention)[..., 0]
        np.testing.assert_array_equal(picture[2, ::2], row)
        np.testing.assert_array_equal(picture[::2, 2], [3, row[1], 4])


@pytest.mark.parametrize("layout", LAYOUTS)
def test_layouts_hold_every_texel_once(layout):
    pattern = face_pattern(8, channels=1) + np.uint8(1)
    picture = to_layout(pattern, layout)
    np.testing.assert_array_equal(np.sort(picture[picture > 0]), np.sort(pattern[pattern > 0]))


def test_pattern_tells_every_face_turn_and_mirroring_apart():
    pattern = face_pattern(16)
    pictures = [turned.tobytes() for face in pattern for turned in dihedral(face)]
    assert len(set(pictures)) == 48
