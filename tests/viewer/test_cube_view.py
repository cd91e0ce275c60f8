"""`cube.show()`: its pictures, what it says is under the pointer, its events and its panel, against numpy."""

# Places are known to hold a texel, and options are passed as dicts.
# mypy: disable-error-code="arg-type, union-attr"

import numpy as np
import pytest

import cubecam as cc
from cubecam.plot import EDGE_NAMES, inner_steps, seam_steps
from cubecam.viewer.cube_drawing import SEAM_LIMIT, Painter, face_places, seam_color
from cubecam.viewer.cube_view import CubeView
from tests.helpers import conventions
from tests.reference import cube_faces, equirect
from tests.reference.sampling import sample_faces

N = 6
PLAIN = {"names": False, "tonemap": None}
sizes = pytest.mark.parametrize("size", [(640, 480), (320, 200), (233, 301)])


def noise(size=N, channels=3, seed=3):
    """Faces whose 8-bit numbers are all different places of a random pattern."""
    rng = np.random.default_rng(seed)
    return rng.integers(0, 256, (6, size, size, channels)).astype(np.uint8)


def shot(view):
    picture = view.draw()
    assert picture.dtype == np.uint8
    assert picture.shape == (view.size[1], view.size[0], 4)
    assert (picture[..., 3] == 255).all()
    return picture[..., :3]


def pixels_at(view, picture, directions):
    """The colours that a picture has where it shows directions, rounded down to a pixel."""
    x, y = np.moveaxis(view.projection().places(directions), -1, 0)
    return picture[np.floor(y).astype(int), np.floor(x).astype(int)]


def move(view, *places, kind="pointer_move", **more):
    for x, y in places:
        view._answer({"event_type": kind, "x": x, "y": y, **more})


def drag(view, start, end, steps=3):
    move(view, start, kind="pointer_down", button=1)
    move(view, *np.linspace(start, end, steps + 1)[1:].tolist(), buttons=(1,))
    move(view, end, kind="pointer_up", button=1)


@sizes
@conventions
def test_the_cross_shows_each_texel_at_its_place(size, convention):
    faces = noise()
    view = CubeView(cc.CubeMap(faces), size=size, convention=convention, **PLAIN)
    picture = shot(view)
    cells = cube_faces.to_layout(faces, "cross", convention)
    sheet = view.projection().sheet
    u, v = np.meshgrid((np.arange(4 * N) + 0.5) / N, (np.arange(3 * N) + 0.5) / N)
    x, y = np.floor(np.moveaxis(sheet.pixels(u, v), -1, 0)).astype(int)
    covered = cube_faces.to_layout(np.ones((6, N, N, 1), bool), "cross", convention)[..., 0]
    assert (picture[y, x][covered] == cells[covered]).all()
    assert (picture[y, x][~covered] == (22, 25, 30)).all()


def test_large_faces_are_averaged_in_the_cross():
    faces = noise(64).astype(np.float32) / 255
    view = CubeView(cc.CubeMap(faces), size=(100, 75), **PLAIN)
    mean = shot(view)[30:45, 5:95].astype(float).mean()
    aliased = noise(64).astype(float).mean()
    small = cc.CubeMap(faces).resize(24)
    light = cc.to_screen(small, tonemap=None).astype(float)
    assert abs(mean - light[[0, 1, 4, 5]].mean()) < 2
    assert abs(mean - aliased) > 30  # numbers of single texels are far darker than their mean light


@pytest.mark.parametrize("center", ["-z", "+x"])
def test_the_panorama_shows_lookups(center):
    faces = noise().astype(np.float32) / 255
    view = CubeView(cc.CubeMap(faces), mode="panorama", center=center, size=(480, 240), **PLAIN)
    picture = shot(view)
    directions = equirect.pixel_directions(40, 20, center)
    x, y = np.floor(np.moveaxis(view.projection().places(directions), -1, 0)).astype(int)
    exact = view.projection().directions(x + 0.5, y + 0.5)
    expected = cc.to_screen(sample_faces(faces, exact).astype(np.float32), tonemap=None)
    assert np.abs(picture[y, x].astype(int) - expected).max() <= 1


def test_the_small_panorama_is_that_of_the_cube():
    cube = cc.CubeMap(noise(64))
    view = CubeView(cube, mode="panorama", size=(200, 100), **PLAIN)
    sheet = view.projection().sheet
    assert sheet.scale == pytest.approx(96)
    expected = cube.to_equirect(width=192)
    assert (shot(view)[2:98, 4:196] == expected).all()


@sizes
@pytest.mark.parametrize(("yaw", "pitch"), [(0, 0), (75, 40), (180, -90)])
@pytest.mark.parametrize("smooth", [True, False])
def test_the_look_shows_lookups(size, yaw, pitch, smooth):
    faces = noise()
    view = CubeView(
        cc.CubeMap(faces), mode="look", yaw=yaw, pitch=pitch, size=size, smooth=smooth, **PLAIN
    )
    picture = shot(view)
    x, y = np.meshgrid(np.arange(0, size[0], 7), np.arange(0, size[1], 7))
    directions = view.projection().directions(x + 0.5, y + 0.5)
    if smooth:
        expected = np.round(sample_faces(faces, directions) * 255)
        assert np.abs(picture[y, x] - expected).max() <= 1
    else:
        face, s, t = cube_faces.direction_to_face_uv(directions)
        texels = faces[face, (t * N).astype(int).clip(0, N - 1), (s * N).astype(int).clip(0, N - 1)]
        # A place on the border of two texels may be rounded either way.
        assert (picture[y, x] != texels).any(axis=-1).mean() < 0.01


@conventions
@pytest.mark.parametrize("mode", ["cross", "panorama", "look"])
@sizes
def test_at_gives_the_texel_that_is_drawn(mode, convention, size):
    faces = noise()
    view = CubeView(
        cc.CubeMap(faces), mode=mode, convention=convention, size=size, smooth=False, pitch=30,
        **PLAIN,
    )  # fmt: skip
    picture, found = shot(view), 0
    for y in range(0, size[1], 23):
        for x in range(0, size[0], 23):
            texel = view.at(x + 0.5, y + 0.5)
            if texel is None:
                assert (picture[y, x] == (22, 25, 30)).all()
                continue
            found += 1
            if mode != "panorama" or view.projection().pixels_per_face > N:
                assert texel.stored == tuple(picture[y, x].tolist())
            for name, place in texel.places.items():
                slot = cube_faces.FACE_NAMES.index(place.face.lower())
                converted = cube_faces.convert(faces, "gl", name)
                assert tuple(converted[slot, place.row, place.column]) == texel.stored
    assert found > 20


def test_a_flipped_face_is_seen():
    faces = noise()
    flipped = faces.copy()
    flipped[2] = flipped[2][::-1]
    right, wrong = (CubeView(cc.CubeMap(f), size=(320, 240), **PLAIN) for f in (faces, flipped))
    x, y = np.meshgrid(np.arange(320) + 0.5, np.arange(240) + 0.5)
    directions = np.nan_to_num(right.projection().directions(x, y), nan=9)
    cells = cube_faces.direction_to_face_uv(directions)[0]
    differs = (shot(right) != shot(wrong)).any(axis=-1)
    assert differs.any()
    assert set(cells[differs]) == {2}


def test_hovering_says_what_is_there():
    view = CubeView(cc.CubeMap(noise()), size=(400, 300))
    heard: list[tuple] = []
    view.add_listener(lambda name, value: heard.append((name, value)))
    move(view, (200, 150))
    texel = view.at(200, 150)
    assert view.text == str(texel)
    for word in ("gl: ", "inside: ", "three: ", "direction (", "value ("):
        assert word in view.text
    assert heard == [("text", view.text)]
    move(view, (3, 3))
    assert view.text == ""


def test_a_drag_turns_the_look_as_numpy_predicts():
    view = CubeView(cc.CubeMap(noise()), mode="look", size=(400, 300), fov=60, yaw=10, pitch=5)
    drag(view, (200, 150), (230, 130))
    degrees = np.degrees(2 * np.tan(np.radians(30)) / 300)
    assert view.yaw == pytest.approx(10 + 30 * degrees)
    assert view.pitch == pytest.approx(5 - 20 * degrees)
    move(view, (10, 10), (90, 90))  # no button is held
    assert view.yaw == pytest.approx(10 + 30 * degrees)
    drag(view, (200, 150), (200, 9000))
    assert view.pitch == 90
    assert abs(view.at(200, 150).direction[1]) > 0.9999


def test_what_is_grabbed_stays_under_the_pointer():
    view = CubeView(cc.CubeMap(noise(32)), mode="look", size=(400, 300), fov=60)
    before = view.at(205, 150).direction
    drag(view, (205, 150), (209, 150), steps=1)
    np.testing.assert_allclose(view.at(209, 150).direction, before, atol=1e-3)
    for mode in ("cross", "panorama"):
        view.mode = mode
        view.zoom = 5
        before = view.at(180, 140).direction
        drag(view, (180, 140), (235, 101))
        np.testing.assert_allclose(view.at(235, 101).direction, before, atol=1e-9)


@pytest.mark.parametrize("mode", ["cross", "panorama"])
def test_the_wheel_zooms_about_the_pointer(mode):
    view = CubeView(cc.CubeMap(noise(32)), mode=mode, size=(400, 300))
    before = view.at(150, 160).direction
    move(view, (150, 160), kind="wheel", dx=0, dy=-400)
    assert view.zoom == pytest.approx(2)
    np.testing.assert_allclose(view.at(150, 160).direction, before, atol=1e-9)
    move(view, (150, 160), kind="wheel", dx=0, dy=99999)
    assert view.zoom == 1
    np.testing.assert_allclose(
        view.at(150, 160).direction, before, atol=1e-9
    )  # everything fits again


def test_the_wheel_changes_the_field_of_view():
    view = CubeView(cc.CubeMap(noise()), mode="look", fov=80)
    move(view, (10, 10), kind="wheel", dx=0, dy=-400)
    assert view.fov == pytest.approx(40)
    move(view, (10, 10), kind="wheel", dx=0, dy=99999)
    assert view.fov == 150


def test_two_fingers_zoom():
    view = CubeView(cc.CubeMap(noise()), mode="look", fov=80)

    def fingers(apart):
        touches = {1: {"x": 100 - apart, "y": 90}, 2: {"x": 100 + apart, "y": 90}}
        move(view, (100, 90), touches=touches)

    fingers(20)
    assert view.fov == 80
    fingers(40)
    assert view.fov == pytest.approx(40)
    assert view.yaw == 0


def test_places_follow_the_canvas():
    view = CubeView(cc.CubeMap(noise()), size=(400, 300))
    expected = view.at(110, 130)
    move(view, (220, 260), size=(800, 600))
    assert view.text == str(expected)


def test_a_double_click_looks_there():
    view = CubeView(cc.CubeMap(noise()), size=(400, 300))
    there = view.at(60, 130).direction
    move(view, (60, 130), kind="double_click", button=1)
    assert view.mode == "look"
    np.testing.assert_allclose(view.projection().forward, there, atol=1e-12)
    for pole in (1, -1):
        view.look_at((0, pole, 0))
        np.testing.assert_allclose(view.projection().forward, (0, pole, 0), atol=1e-12)


def test_keys():
    view = CubeView(cc.CubeMap(noise()))
    told: list[str] = []
    view.add_listener(lambda name, value: told.append(name))

    def press(*keys):
        for key in keys:
            view._answer({"event_type": "key_down", "key": key, "modifiers": ()})

    press("3", "ArrowLeft", "ArrowUp", "+", "s", "n")
    assert (view.mode, view.yaw, view.pitch, view.exposure) == ("look", 5, 5, 0.5)
    assert (view.seams, view.names) == (True, False)
    assert told.count("panel") == 6
    press("r", "1")
    assert (view.mode, view.yaw, view.pitch, view.exposure) == ("cross", 0, 0, 0)
    press("h")
    assert "double click" in view.text


@pytest.mark.filterwarnings("ignore::cubecam.ClippingWarning")  # of the expected cube
def test_light_is_prepared_as_by_to_screen():
    light = np.random.default_rng(2).random((6, N, N, 3)).astype(np.float32) * 5
    for cube in (cc.CubeMap(light), cc.CubeMap(light / 5, encoding="srgb"), cc.CubeMap(noise())):
        for exposure in (0.0, -1.5):
            for tonemap in ("neutral", "aces", None):
                view = CubeView(
                    cube, size=(320, 240), exposure=exposure, tonemap=tonemap, names=False
                )
                faces = cc.CubeMap(cc.to_screen(cube, exposure=exposure, tonemap=tonemap))
                expected = CubeView(faces, size=(320, 240), **PLAIN)
                assert (shot(view) == shot(expected)).all()


def test_grey_and_alpha():
    grey = noise(channels=1)
    three = CubeView(cc.CubeMap(grey.repeat(3, axis=-1)), size=(160, 120), **PLAIN)
    assert (shot(CubeView(cc.CubeMap(grey), size=(160, 120), **PLAIN)) == shot(three)).all()
    clear = np.concatenate([noise(), np.zeros((6, N, N, 1), np.uint8)], axis=-1)
    view = CubeView(cc.CubeMap(clear), size=(160, 120), background="light", **PLAIN)
    assert (shot(view) == (250, 250, 248)).all()


def test_levels():
    cube = cc.CubeMap(noise(8).astype(np.float32) / 255, mipmaps=True)
    view = CubeView(cube, size=(320, 240), **PLAIN)
    assert view.levels == 4
    view.level = 2
    assert view.at(160, 120).size == 2
    assert view.at(160, 120).level == 2
    direction = view.at(160, 120).direction
    texel = view.at(160, 120)
    center = cube_faces.face_uv_to_direction(
        int(texel.face), (texel.column + 0.5) / 2, (texel.row + 0.5) / 2
    )
    np.testing.assert_allclose(texel.value, cube.sample(center, lod=2), atol=1e-6)
    assert direction == texel.direction
    plain = cc.CubeMap(cube.sample(cube_faces.texel_directions(2), lod=2))
    assert (shot(view) == shot(CubeView(plain, size=(320, 240), **PLAIN))).all()
    wrong: list[tuple] = [(4, ValueError), (-1, ValueError), (1.0, TypeError), (True, TypeError)]
    for value, error in wrong:
        with pytest.raises(error, match="level: expected"):
            view.level = value
    assert view.level == 2


def controls_of(view):
    return {c.name: c for section in view.panel() for c in section.controls}


def test_the_panel_has_a_slider_for_levels_only_where_there_are_some():
    assert "level" not in controls_of(CubeView(cc.CubeMap(noise())))
    several = [cc.CubeMap(noise(n)) for n in (8, 4, 2)]
    view = CubeView(several)
    control = controls_of(view)["level"]
    assert (control.kind, control.low, control.high) == ("integer", 0, 2)
    control.set(1)
    assert view.level == 1
    assert view.shown is several[1]


def test_each_control_sets_its_property_and_the_picture_follows():
    view = CubeView(cc.CubeMap(noise(8).astype(np.float32), mipmaps=True), size=(160, 120))
    view.mode = "look"
    known = {"flag": lambda c: not c.get(), "number": lambda c: c.high, "integer": lambda c: c.high}
    known["choice"] = lambda c: next(name for name in c.choices if name != c.get())
    for name, control in controls_of(view).items():
        if control.kind == "button":
            continue
        value = known[control.kind](control)
        control.set(value)
        expected = -180 if name == "yaw" else value  # 180 degrees are -180 degrees
        assert control.get() == expected, name
        assert getattr(view, name) == (None if expected == "none" else expected)
    controls_of(view)["reset"].set(None)
    assert (view.yaw, view.zoom, view.fov) == (0, 1, 75)
    with pytest.raises(ValueError, match='tonemap: expected "neutral", "reinhard", "aces" or None'):
        controls_of(view)["tonemap"].set("film")


def test_the_picture_follows_the_cube():
    cube = cc.CubeMap(noise(), mipmaps=True)
    view = CubeView(cube, size=(320, 240), **PLAIN)
    view.level = 1
    shot(view)
    cube.set_face("+z", noise(seed=9)[0])
    fresh = CubeView(cube, size=(320, 240), level=1, **PLAIN)
    assert (shot(view) == shot(fresh)).all()


@pytest.mark.parametrize("size", [(640, 480), (97, 61), (1, 1)])
@pytest.mark.parametrize("mode", ["cross", "panorama", "look"])
@pytest.mark.parametrize("background", ["dark", "light"])
def test_everything_can_be_drawn_at_every_size(mode, size, background):
    for edge in (1, 5, 64):
        view = CubeView(
            cc.CubeMap(noise(edge)), mode=mode, size=size, seams=True, background=background
        )
        shot(view)
        assert view._picture(size, True).shape == (size[1], size[0], 4)


def test_seams_are_those_of_the_plot():
    """Every place of the table is the step that the plot's function gives for the same two texels."""
    cube = cc.CubeMap(noise().astype(np.float32))
    table = Painter(cube).seam_table()
    directions = cube_faces.texel_directions(N)
    ratios = seam_steps(cube) / inner_steps(cube).mean(axis=1, keepdims=True)
    faces = np.asarray(cube.faces)
    for face in range(6):
        for side in range(4):
            for k in range(N):
                row, column = ((k, 0), (k, N - 1), (0, k), (N - 1, k))[side]
                # The nearest texel of another face is the neighbour.
                apart = np.linalg.norm(directions - directions[face, row, column], axis=-1)
                apart[face] = 9
                if row in (0, N - 1) and column in (0, N - 1):
                    continue  # a corner has two neighbours; its sides are compared below
                other, i, j = np.unravel_index(apart.argmin(), apart.shape)
                step = np.abs(faces[face, row, column] - faces[other, i, j]).max()
                names = [cube_faces.FACE_NAMES[f].upper() for f in sorted((face, int(other)))]
                edge = EDGE_NAMES.index("|".join(names))
                assert table[face, side, k] == pytest.approx(
                    step / inner_steps(cube)[edge].mean(), rel=1e-5
                )
                assert ratios[edge].min() <= table[face, side, k] <= ratios[edge].max()
    assert np.sort(table.ravel()) == pytest.approx(
        np.sort(np.concatenate([ratios, ratios]).ravel())
    )


def test_a_mirrored_face_has_red_edges_and_a_whole_world_has_blue_ones():
    smooth = cube_faces.unit_texel_directions(64).astype(np.float32) / 2 + 0.5
    broken = smooth.copy()
    broken[4] = broken[4][:, ::-1]
    shares = []
    for faces in (smooth, broken):
        view = CubeView(cc.CubeMap(faces), size=(800, 600), **PLAIN)
        painter = view._painter()
        colors, near = painter.seam_band(view.projection(), view.size)
        assert near.any()
        red = (colors == seam_color(9.0)).all(axis=-1) & near
        shares.append(red.sum() / near.sum())
        without = shot(view)
        view.seams, view.names = True, False
        changed = (shot(view) != without).any(axis=-1)
        assert changed[near].mean() > 0.9
    # All red places lie at the four edges of +Z: on +Z, or on a neighbour on the side of +Z.
    x, y = np.meshgrid(np.arange(800) + 0.5, np.arange(600) + 0.5)
    directions = view.projection().directions(x, y)[red]
    axes = np.abs(directions).argsort(axis=-1)[:, 1:]
    assert (axes == 2).any(axis=-1).all()
    assert (directions[:, 2] > 0).all()
    assert shares[0] == 0
    assert 0.2 < shares[1] < 0.4  # four of twelve edges, without the places where both sides agree


@pytest.mark.parametrize("mode", ["cross", "panorama", "look"])
def test_one_bright_texel_at_an_edge_is_red_on_both_sides(mode):
    faces = np.zeros((6, N, N, 1), np.float32)
    faces[4, 1, 0] = 1  # on +Z, beside -X
    view = CubeView(cc.CubeMap(faces), mode=mode, size=(800, 600), yaw=135, **PLAIN)
    colors, near = view._painter().seam_band(view.projection(), view.size)
    red = near & (colors == seam_color(9.0)).all(axis=-1)
    x, y = np.meshgrid(np.arange(800) + 0.5, np.arange(600) + 0.5)
    face, s, t = cube_faces.direction_to_face_uv(view.projection().directions(x, y)[red])
    texels = {
        *zip(face.tolist(), (t * N).astype(int).tolist(), (s * N).astype(int).tolist(), strict=True)
    }
    assert texels == {(4, 1, 0), (1, 1, N - 1)}


def test_the_colours_of_seams():
    assert seam_color(0.0).tolist() == seam_color(1.0).tolist() == [0x2F, 0x7E, 0xD8]
    assert seam_color(SEAM_LIMIT).tolist() == seam_color(np.inf).tolist() == [0xD8, 0x43, 0x2F]


def test_face_places_are_those_of_the_table():
    directions = np.random.default_rng(8).normal(size=(500, 3))
    for got, expected in zip(
        face_places(directions), cube_faces.direction_to_face_uv(directions), strict=True
    ):
        np.testing.assert_allclose(got, expected, atol=1e-12)


def test_names_stand_on_the_faces():
    view = CubeView(cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)), size=(800, 600))
    white = (shot(view) > 200).all(axis=-1)
    for cell in view.projection().cells:
        x, y = view.projection().sheet.pixels(cell.column, cell.row).astype(int)
        assert white[y : y + 96, x : x + 96].sum() > 20, cell.name
    view.names = False
    assert not (shot(view) > 200).all(axis=-1).any()


@pytest.mark.parametrize(
    ("name", "value", "error"),
    [
        ("mode", "sphere", ValueError),
        ("convention", ["gl"], TypeError),
        ("exposure", np.nan, ValueError),
        ("exposure", "1", TypeError),
        ("fov", 180, ValueError),
        ("pitch", 91, ValueError),
        ("seams", 1, TypeError),
        ("yaw", np.inf, ValueError),
    ],
)
def test_bad_values_are_errors_and_change_nothing(name, value, error):
    view = CubeView(cc.CubeMap(noise()))
    before = getattr(view, name)
    with pytest.raises(error, match=f"{name}: expected"):
        setattr(view, name, value)
    assert getattr(view, name) == before
    with pytest.raises(error, match=f"{name}: expected"):
        CubeView(cc.CubeMap(noise()), **{name: value})


def test_show():
    cube = cc.CubeMap(noise())
    with cube.show("offscreen", mode="look", size=(200, 100)) as view:
        assert isinstance(view, CubeView)
        assert shot(view).shape == (100, 200, 3)
    assert view.closed
    with pytest.raises(ValueError, match="where: expected"):
        cube.show("moon")
    with pytest.raises(TypeError, match="did you mean 'exposure'"):
        CubeView(cube, exposur=1)
