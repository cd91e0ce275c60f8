"""layout: the faces unfolded; copies attach to the sides beside which they stand, texel for texel."""

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from matplotlib.patches import Rectangle

import cubecam as cc
from tests.helpers import conventions
from tests.plot.artists import array_of
from tests.reference import cube_faces
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import COLORS, face_pattern

SIZE = 16
NAMES = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
#: The row of each convention (docs/conventions.md).
ROWS = {
    "gl": ("-X", "+Z", "+X", "-Z"),
    "three": ("-X", "+Z", "+X", "-Z"),
    "inside": ("-X", "-Z", "+X", "+Z"),
}


def shown_directions(**options):
    """The figure of a cube whose numbers are directions: one component a picture, (3N, columns N, 3)."""
    faces = np.moveaxis(texel_directions(SIZE), -1, 0).astype(np.float32)
    pictures = [
        array_of(cc.plot.layout(component, **options).get_images()[0]) for component in faces
    ]
    return np.ma.filled(np.ma.stack(pictures, axis=-1), np.nan)


def rectangles(ax, filled=False):
    """(left, top, colour of the border) of each face."""
    return [
        (patch.get_x(), patch.get_y(), patch.get_edgecolor())
        for patch in ax.patches
        if isinstance(patch, Rectangle) and patch.get_fill() == filled
    ]


@conventions
@pytest.mark.parametrize("repeat", ["-Z", "all", ("+X", "-X")])
@pytest.mark.parametrize("wrap", [False, True])
def test_pictures_go_on_across_every_edge_between_the_row_and_its_copies(convention, repeat, wrap):
    """Texels on both sides of an edge look into nearly the same direction."""
    drawn = shown_directions(repeat=repeat, wrap=wrap, convention=convention)
    unit = drawn / np.linalg.norm(drawn, axis=-1, keepdims=True)
    row = ROWS[convention]
    sides = {"all": row, "-Z": ("-Z",), ("+X", "-X"): ("+X", "-X")}[repeat]
    checked = 0
    # At an edge texels are at most 2/N of the half edge apart, plus the bend.
    near = np.cos(np.radians(1.5 * 90 / SIZE))
    for column, name in enumerate(row):
        across = slice(column * SIZE, (column + 1) * SIZE)
        for above, below in ((SIZE - 1, SIZE), (2 * SIZE - 1, 2 * SIZE)):
            pair = unit[above, across], unit[below, across]
            if name in sides or column == 1:
                assert (np.sum(pair[0] * pair[1], axis=-1) > near).all(), name
                checked += 1
            else:
                assert np.isnan(pair[0]).all() or np.isnan(pair[1]).all()
    assert checked == 2 * len({*sides, row[1]})
    for column in range(1, 5 if wrap else 4):
        left, right = (unit[SIZE : 2 * SIZE, column * SIZE + i] for i in (-1, 0))
        assert (np.sum(left * right, axis=-1) > near).all()
    assert drawn.shape == (3 * SIZE, (5 if wrap else 4) * SIZE, 3)


@conventions
def test_without_copies_it_is_the_cross(convention):
    pattern = face_pattern(SIZE, 3)
    shown = array_of(cc.plot.layout(pattern, repeat=(), convention=convention).get_images()[0])
    want = cube_faces.to_layout(pattern, "cross", convention)
    np.testing.assert_array_equal(shown[..., :3], want)


def test_the_figure_of_the_document():
    """Six faces in black, copies of +Y and -Y in grey where they attach to -Z, each upside down."""
    ax = cc.plot.layout()
    assert [text.get_text() for text in ax.texts] == [*NAMES, "+Y", "-Y"]
    black, grey = to_rgba("black"), to_rgba("0.6")
    assert [to_rgba(text.get_color()) for text in ax.texts] == [black] * 6 + [grey] * 2
    assert [text.get_rotation() for text in ax.texts] == [0] * 6 + [180] * 2
    places = {text.get_text(): text.get_position() for text in ax.texts[:6]}
    assert places == {
        "+Y": (1, 0), "-X": (0, 1), "+Z": (1, 1), "+X": (2, 1), "-Z": (3, 1), "-Y": (1, 2),
    }  # fmt: skip
    assert [text.get_position() for text in ax.texts[6:]] == [(3, 0), (3, 2)]
    borders = rectangles(ax)
    assert [color for *_, color in borders] == [black] * 6 + [grey] * 2
    assert not ax.get_images()
    assert ax.get_xlim() == (-0.5, 3.5)


def test_the_names_of_copies_turn_with_their_faces():
    """+Y beside the row: its upper edge is that of -Z, so it is turned by a quarter more from side to side."""
    ax = cc.plot.layout(repeat="all", wrap=True)
    copies = [(text.get_text(), text.get_position(), text.get_rotation()) for text in ax.texts[6:]]
    assert sorted(copies) == sorted(
        [
            ("+Y", (0, 0), 90), ("+Y", (2, 0), 270), ("+Y", (3, 0), 180),
            ("-Y", (0, 2), 270), ("-Y", (2, 2), 90), ("-Y", (3, 2), 180),
            ("-X", (4, 1), 0),
        ]
    )  # fmt: skip


def test_copies_are_faded_and_named_at_their_own_upper_edge():
    pattern = face_pattern(64, 3)
    ax = cc.plot.layout(pattern)
    papers = [patch for patch in ax.patches if patch.get_fill()]
    assert [(one.get_x(), one.get_y()) for one in papers] == [(191.5, -0.5), (191.5, 127.5)]  # type: ignore[attr-defined]
    assert all(0.4 < float(one.get_alpha() or 0) < 0.8 for one in papers)
    x, y = ax.texts[6].get_position()
    assert 192 < x < 256
    assert 48 < y < 64, "+Y stands on its head beside -Z"
    shown = array_of(ax.get_images()[0])
    for index, name in enumerate(NAMES):
        column, row = (int(place) // 64 for place in ax.texts[index].get_position())
        here = shown[row * 64 + 32, column * 64 + 32, :3].astype(int)
        assert np.abs(COLORS - here).sum(axis=1).argmin() == index, name


def test_numbers_ids_and_a_cube():
    ids = np.arange(6)[:, None, None].repeat(8, 1).repeat(8, 2)
    ax = cc.plot.layout(ids)
    assert len(ax.figure.axes) == 2, "a list of the ids"
    cube = cc.CubeMap(face_pattern(8, 3))
    ours = array_of(cc.plot.layout(cube, labels=False).get_images()[0])
    np.testing.assert_array_equal(ours, array_of(cc.plot.layout(cube.faces).get_images()[0]))
    assert not cc.plot.layout(cube, labels=False).texts


def test_one_pair_of_axes_is_used():
    from matplotlib import pyplot as plt

    _, axes = plt.subplots(1, 2)
    assert cc.plot.layout(ax=axes[1]) is axes[1]
    assert not axes[0].patches


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"repeat": "+Y"}, ValueError, r'repeat: expected "\+X", .*, got \'\+Y\''),
        ({"repeat": ["-Z", "z"]}, ValueError, r"got 'z'"),
        ({"repeat": [3]}, TypeError, r"repeat: expected names of sides, got 3"),
        ({"convention": "up"}, ValueError, r'convention: expected "gl"'),
        ({"cube": np.zeros((5, 4, 4))}, ValueError, r"got shape \(5, 4, 4\)"),
    ],
)
def test_wrong_options(options, error, message):
    with pytest.raises(error, match=message):
        cc.plot.layout(**options)
