"""cross, faces and panorama: the pixels and the places of all labels."""

import re

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_rgba
from matplotlib.patches import FancyBboxPatch
from matplotlib.text import Annotation, Text

import cubecam as cc
from tests.helpers import conventions
from tests.helpers import faces as each_face
from tests.plot.artists import array_of, mapped_colors, xdata, ydata
from tests.reference import cube_faces, equirect
from tests.reference.pattern import COLORS, face_pattern

SIZE = 16
NAMES = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]


def image_of(ax, index=0):
    return np.asarray(array_of(ax.get_images()[index]))


def label_places(ax):
    """The names that the axes show, with the pixel at which each stands."""
    return {text.get_text(): text.get_position() for text in ax.texts}


def box_of(text: Text) -> FancyBboxPatch:
    """The box that is drawn behind a text."""
    box = text.get_bbox_patch()
    assert box is not None
    return box


@conventions
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_cross_shows_the_pixels_of_to_layout(convention, channels):
    cube = cc.CubeMap(face_pattern(SIZE, channels))
    shown = image_of(cc.plot.cross(cube, convention=convention))
    expected = cube.to_layout("cross", convention=convention)[..., :3]
    assert shown.dtype == np.uint8
    np.testing.assert_array_equal(
        shown[..., :3], np.broadcast_to(expected, (*expected.shape[:2], 3))
    )
    covered = cc.CubeMap(np.ones((6, SIZE, SIZE, 1), np.uint8)).to_layout("cross")[..., 0]
    np.testing.assert_array_equal(shown[..., 3], covered * 255)


@conventions
def test_each_name_stands_on_its_face(convention):
    """The pattern's colour under each label is the colour of the face that the convention calls by this name."""
    pattern = face_pattern(64, 3)
    ax = cc.plot.cross(pattern, convention=convention)
    layout = cube_faces.to_layout(pattern, "cross", convention)
    places = label_places(ax)
    assert list(places) == NAMES
    for slot, name in enumerate(NAMES):
        x, y = (int(place) // 64 * 64 + 32 for place in places[name])
        here = layout[y, x].astype(int)
        face = slot ^ 1 if convention == "three" and slot < 2 else slot
        assert np.abs(COLORS - here).sum(axis=1).argmin() == face, name


@conventions
def test_arrows_begin_at_the_first_texel_and_follow_s_and_t(convention):
    size = 40
    s = np.broadcast_to(np.arange(size, dtype=np.float32), (6, size, size))
    t = np.swapaxes(s, 1, 2)
    where_s, where_t = (cube_faces.to_layout(grid, "cross", convention) for grid in (s, t))
    ax = cc.plot.cross(np.ones((6, size, size)), labels=False, arrows=True, convention=convention)
    arrows = [text for text in ax.texts if getattr(text, "arrow_patch", None) is not None]
    letters = [text.get_text() for text in ax.texts if text not in arrows]
    assert letters == ["s", "t"] * 6
    for k, arrow in enumerate(arrows):
        assert isinstance(arrow, Annotation)
        (x1, y1), (x0, y0) = np.round(arrow.xy).astype(int), np.round(arrow.xyann).astype(int)
        along, across = (where_s, where_t) if k % 2 == 0 else (where_t, where_s)
        assert along[y0, x0] < 0.1 * size
        assert across[y0, x0] < 0.1 * size
        assert 0.3 * size < along[y1, x1] - along[y0, x0] < 0.4 * size
        assert abs(across[y1, x1] - across[y0, x0]) <= 1


def test_labels_can_be_left_out_and_the_axes_count_pixels():
    ax = cc.plot.cross(face_pattern(SIZE), False)
    assert ax.texts[:] == []
    assert ax.get_xlim() == (-0.5, 4 * SIZE - 0.5)
    assert ax.get_ylim() == (3 * SIZE - 0.5, -0.5)
    assert not ax.axison


def test_names_are_inside_their_cells_also_with_arrows():
    ax = cc.plot.cross(face_pattern(SIZE), arrows=True)
    figure = ax.figure
    figure.canvas.draw()
    for cell, name in zip([(2, 1), (0, 1), (1, 0), (1, 2), (3, 1), (1, 1)], NAMES, strict=True):
        (text,) = (text for text in ax.texts if text.get_text() == name)
        box = box_of(text).get_window_extent().transformed(ax.transData.inverted())
        column, row = cell
        assert column * SIZE - 0.5 <= box.xmin < box.xmax <= (column + 1) * SIZE - 0.5
        low, high = sorted((box.ymin, box.ymax))
        assert row * SIZE - 0.5 <= low < high <= (row + 1) * SIZE - 0.5


def luminance(color):
    linear = np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("ground", [0, 255])
def test_names_can_be_read_on_black_and_on_white(ground):
    """The contrast of the letters to what is around them is at least 4.5, as WCAG 2 demands of text."""
    ax = cc.plot.cross(np.full((6, 8, 8, 3), ground, np.uint8))
    red, green, blue, alpha = to_rgba(box_of(ax.texts[0]).get_facecolor())
    behind = alpha * np.array([red, green, blue]) + (1 - alpha) * ground / 255
    letters = np.ones(3)
    assert ax.texts[0].get_color() == "white"
    assert (luminance(letters) + 0.05) / (luminance(behind) + 0.05) >= 4.5


def test_light_is_prepared_for_the_screen():
    light = np.full((6, 4, 4, 3), 0.25, np.float32)
    half = image_of(cc.plot.cross(light))[5, 5, 0]
    brighter = image_of(cc.plot.cross(light, exposure=1))[5, 5, 0]
    np.testing.assert_array_equal(brighter, image_of(cc.plot.cross(2 * light))[5, 5, 0])
    assert half < brighter
    assert image_of(cc.plot.cross(light, tonemap=None))[5, 5, 0] == 137  # sRGB's curve at 0.25


def test_numbers_of_8_bits_are_light_in_a_capture_and_encoded_in_a_file():
    numbers = np.full((6, 4, 4, 3), 64, np.uint8)
    light = cc.CubeMap(numbers, encoding="linear")
    for draw in (cc.plot.cross, cc.plot.panorama):
        assert image_of(draw(cc.CubeMap(numbers)))[5, 5, 0] == 64
        assert image_of(draw(light))[5, 5, 0] == cc.to_screen(light)[0, 0, 0, 0] > 100
    assert image_of(cc.plot.faces(light)[2])[1, 1, 0] > 100


def test_one_number_a_texel_has_a_colour_map_and_what_is_not_finite_is_apart():
    distance = np.random.default_rng(1).random((6, SIZE, SIZE)).astype(np.float32) + 1
    distance[0, :4] = np.inf
    distance[1, 0, 0] = np.nan
    ax = cc.plot.cross(distance, vmax=1.5)
    shown = array_of(ax.get_images()[-1])
    expected = cube_faces.to_layout(distance, "cross", "inside")
    finite = np.isfinite(expected) & (expected > 0)
    np.testing.assert_array_equal(~np.ma.getmaskarray(shown), finite)
    np.testing.assert_array_equal(shown[finite], expected[finite])
    ground = image_of(ax)
    np.testing.assert_array_equal(ground[..., 3] > 0, ~np.isfinite(expected))
    assert ax.get_images()[-1].get_clim() == (float(np.nanmin(distance)), 1.5)
    assert len(ax.figure.axes) == 2
    assert len(cc.plot.cross(distance, colorbar=False).figure.axes) == 1


def test_ids_have_a_colour_each_and_a_list():
    ids = np.zeros((6, SIZE, SIZE), np.int32)
    ids[0] = 7
    ids[3, :, 3:] = 12
    ax = cc.plot.cross(ids)
    (image,) = ax.get_images()
    bar = ax.figure.axes[1]
    assert [label.get_text() for label in bar.get_yticklabels()] == ["0", "7", "12"]
    colors = mapped_colors(image)
    expected = cube_faces.to_layout(ids, "cross", "inside")
    covered = ~np.ma.getmaskarray(array_of(image))
    assert covered.sum() == 6 * SIZE**2
    for value in (0, 7, 12):
        assert len(np.unique(colors[covered & (expected == value)], axis=0)) == 1
    assert len(np.unique(colors[covered], axis=0)) == 3


@conventions
def test_faces_shows_each_face_with_its_name(convention):
    cube = cc.CubeMap(face_pattern(SIZE, 3))
    axes = cc.plot.faces(cube, convention=convention)
    assert axes.shape == (6,)
    assert [ax.get_title() for ax in axes] == NAMES
    for ax, expected in zip(axes, cube.to_convention(convention), strict=True):
        np.testing.assert_array_equal(image_of(ax), expected)


def arrows_of(ax):
    """The tails and heads of the arrows s and t, (n, 2, 2)."""
    return np.array(
        [[text.xyann, text.xy] for text in ax.texts if getattr(text, "arrow_patch", None)]
    )


@conventions
def test_faces_have_the_arrows_of_the_cross(convention):
    middle = {"inside": (1, 5, 0, 4)}.get(convention, (1, 4, 0, 5))
    whole = arrows_of(cc.plot.cross(face_pattern(SIZE), arrows=True, convention=convention))
    axes = cc.plot.faces(face_pattern(SIZE), arrows=True, convention=convention)
    for face, ax in enumerate(axes):
        column, row = (1, 0 if face == 2 else 2) if face in (2, 3) else (middle.index(face), 1)
        expected = whole[2 * face : 2 * face + 2] - np.multiply((column, row), SIZE)
        np.testing.assert_allclose(arrows_of(ax), expected)
        assert [text.get_text() for text in ax.texts if text.get_text()] == ["s", "t"]


def test_faces_share_one_scale_of_numbers():
    numbers = np.arange(6.0)[:, None, None] * np.ones((6, 3, 3))
    axes = cc.plot.faces(numbers, columns=6)
    assert {ax.get_images()[-1].get_clim() for ax in axes} == {(0.0, 5.0)}
    assert len(axes[0].figure.axes) == 7


def test_ids_have_the_same_colour_on_all_faces():
    ids = np.zeros((6, 4, 4), np.int32)
    ids[:, 0, 0] = [1, 2, 3, 4, 5, 9]
    axes = cc.plot.faces(ids)
    for ax, number in zip(axes, [1, 2, 3, 4, 5, 6], strict=True):
        assert array_of(ax.get_images()[0]).max() == number
        assert ax.get_images()[0].get_clim() == (-0.5, 6.5)


@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_panorama_marks_the_axes_where_they_are(center):
    """The colour below each name is that of the face in this direction, at the degrees of docs/conventions.md."""
    pattern = face_pattern(64, 3)
    ax = cc.plot.panorama(cc.CubeMap(pattern), center=center)
    picture = image_of(ax)
    np.testing.assert_array_equal(picture, cc.CubeMap(pattern).to_equirect(center=center))
    height, width = picture.shape[:2]
    found = []
    for text in ax.texts:
        longitude, latitude = text.get_position()
        row = int(np.clip((90 - latitude) / 180 * height, 0, height - 1))
        column = int(np.clip((longitude + 180) / 360 * width, 0, width - 1))
        face = np.abs(COLORS - picture[row, column].astype(int)).sum(axis=1).argmin()
        assert NAMES[face] == text.get_text()
        found.append(text.get_text())
    assert sorted(found) == sorted([*NAMES, found[0]])
    (middle,) = (text for text in ax.texts if text.get_position() == (0, 0))
    assert middle.get_text().lower() == center
    edges = {text.get_text() for text in ax.texts if abs(text.get_position()[0]) > 170}
    assert len(edges) == 1


def test_panorama_counts_degrees():
    ax = cc.plot.panorama(cc.CubeMap(face_pattern(8, 3)), graticule=45)
    assert tuple(ax.get_images()[0].get_extent()) == (-180, 180, -90, 90)
    vertical = sorted(xdata(line)[0] for line in ax.lines if len(set(xdata(line))) == 1)
    level = sorted(ydata(line)[0] for line in ax.lines if len(set(ydata(line))) == 1)
    assert vertical == [-135, -90, -45, 0, 45, 90, 135]
    assert level == [-45, 0, 45]
    ax.figure.canvas.draw()
    names = [label.get_text() for label in ax.get_xticklabels()]
    assert "45°" in names
    assert "-180°" in names
    assert not cc.plot.panorama(np.zeros((4, 8)), graticule=None).lines[:]


@each_face
@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_panorama_of_numbers_takes_the_nearest_texel(face, center):
    numbers = np.zeros((6, 32, 32))
    numbers[face] = np.arange(32 * 32).reshape(32, 32) + 1
    shown = image_of(cc.plot.panorama(numbers, center=center, width=64))
    directions = equirect.pixel_directions(64, 32, center)
    met, s, t = cube_faces.direction_to_face_uv(directions)
    row, column = (np.clip((x * 32).astype(int), 0, 31) for x in (t, s))
    np.testing.assert_array_equal(shown, numbers[met, row, column])


def test_a_panorama_is_drawn_as_it_is():
    picture = np.random.default_rng(0).integers(0, 256, (8, 16, 3), np.uint8)
    np.testing.assert_array_equal(image_of(cc.plot.panorama(picture)), picture)


def test_plots_draw_on_the_given_axes_and_make_no_figure():
    _, axes = plt.subplots(2, 3)
    cube = cc.CubeMap(face_pattern(4, 3))
    assert cc.plot.cross(cube, ax=axes[0, 0]) is axes[0, 0]
    assert cc.plot.panorama(cube, ax=axes[0, 1]) is axes[0, 1]
    assert cc.plot.error_map(cube, cube, ax=axes[0, 2]) is axes[0, 2]
    assert cc.plot.seams(cube, ax=axes[1, 0]) is axes[1, 0]
    assert cc.plot.vectors(cube.faces / 255.0, ax=axes[1, 1]) is axes[1, 1]
    _, axes = plt.subplots(3, 2)
    assert cc.plot.faces(cube, ax=axes).tolist() == axes.ravel().tolist()
    assert len(plt.get_fignums()) == 2


def test_settings_of_matplotlib_stay_as_they_are():
    before = dict(plt.rcParams)
    cc.plot.cross(face_pattern(4))
    cc.plot.face_axes()
    assert dict(plt.rcParams) == before


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: cc.plot.cross(np.zeros((6, 4, 4, 2))), "expected 1, 3 or 4 channels"),
        (lambda: cc.plot.cross(np.zeros((4, 4, 3))), "expected a CubeMap or an array"),
        (lambda: cc.plot.cross(face_pattern(4), convention="inner"), "convention: expected"),  # type: ignore[arg-type]
        (lambda: cc.plot.faces(face_pattern(4), columns=4), "columns: expected 1, 2, 3 or 6"),
        (lambda: cc.plot.panorama(np.zeros((4, 9, 3))), "expected a CubeMap, an array"),
        (lambda: cc.plot.panorama(np.zeros((4, 8, 3)), center="up"), "center: expected"),  # type: ignore[arg-type]
        (lambda: cc.plot.panorama(np.zeros((4, 8, 3)), graticule=0), "graticule: expected"),
        (lambda: cc.plot.panorama(np.zeros((6, 4, 4)), width=7), "width: expected an even number"),
    ],
)
def test_wrong_input(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_wrong_number_of_axes():
    _, axes = plt.subplots(2, 2)
    with pytest.raises(ValueError, match="ax: expected 6 axes, got 4"):
        cc.plot.faces(face_pattern(4), ax=axes)


@pytest.mark.parametrize(
    ("thing", "message"),
    [
        ("sky.png", "got the name 'sky.png': cc.load_cubemap and cc.load_image read files"),
        (None, "got None: an output that outputs= did not request"),
        ([["a", "b"]], "expected an array of numbers, got dtype <U1"),
    ],
)
def test_what_is_no_picture(thing, message):
    with pytest.raises(TypeError, match=re.escape(message)):
        cc.plot.cross(thing)


def test_several_axes_for_one_picture():
    _, axes = plt.subplots(1, 2)
    for draw in (cc.plot.cross, cc.plot.panorama, cc.plot.seams):
        with pytest.raises(
            TypeError, match=re.escape("expected one matplotlib Axes, got ndarray; ")
        ):
            draw(face_pattern(4), ax=axes)
