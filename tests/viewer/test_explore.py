"""`cc.explore.reflection()`: its numbers against the formulas, its picture against the texels, its events."""

# Options are passed as dicts, places are known to hold a texel, and some calls are wrong on purpose.
# mypy: disable-error-code="arg-type, union-attr, call-arg"

import numpy as np
import pytest

import cubecam as cc
from cubecam.explore import ReflectionView
from cubecam.explore._diagram import BAND, EYE, RAYS, Layout, in_band
from cubecam.explore._lobe import density, distribution, facet_normals, lobe, shadowing
from cubecam.explore._optics import Plane, turned
from cubecam.viewer.cube_drawing import THEMES
from tests.reference import cube_faces
from tests.reference.sampling import sample_faces

N = 8
ETAS = [None, 1 / 1.5, 1.5]


def noise(size=N):
    return np.random.default_rng(3).integers(0, 256, (6, size, size, 3)).astype(np.uint8)


def view_of(**settings):
    return ReflectionView(cc.CubeMap(noise()), **settings)


def reflect(i, n):
    return i - 2 * (n @ i) * n


def snell(i, n, n1, n2):
    """Snell's law by angles: sin t = n1 / n2 sin i, in the plane of i and n; None beyond the critical angle."""
    sine = n1 / n2 * np.linalg.norm(np.cross(i, n))
    if sine > 1:
        return None
    along = i - (i @ n) * n
    return sine * along / np.linalg.norm(along) - np.sqrt(1 - sine * sine) * n


@pytest.mark.parametrize("azimuth", [0, 30, -135])
@pytest.mark.parametrize("angle", [-170, -20, 0, 20, 100])
@pytest.mark.parametrize("eye", [55, -40])
def test_the_vectors(azimuth, angle, eye):
    view = view_of(angle=angle, eye=eye, azimuth=azimuth, mode="refraction", ior=1.5)
    a = np.radians(azimuth)
    right = np.array([np.cos(a), 0, -np.sin(a)])  # +X, turned about +Y

    def up_turned(degrees):
        t = np.radians(degrees)
        return np.cos(t) * np.array([0, 1, 0]) - np.sin(t) * right

    i, n = -up_turned(eye), up_turned(angle)
    np.testing.assert_allclose(view.incident, i, atol=1e-12)
    np.testing.assert_allclose(view.normal, n, atol=1e-12)
    np.testing.assert_allclose(view.reflected, reflect(i, n), atol=1e-12)
    inside = i @ n > 0  # the eye is in the glass
    bent = snell(i, -n if inside else n, *((1.5, 1) if inside else (1, 1.5)))
    main = reflect(i, n) if bent is None else bent
    if bent is None:
        assert view.refracted is None
        assert view.share == 1
    else:
        np.testing.assert_allclose(view.refracted, bent, atol=1e-12)
        assert 0 < view.share < 1
    face, s, t = cube_faces.direction_to_face_uv(main)
    inner = [abs(x * N - round(x * N)) > 1e-9 for x in (s, t)]
    hit = view.hit
    assert int(hit.face) == face
    if all(inner):
        assert (hit.row, hit.column) == (int(t * N), int(s * N))
        assert hit.stored == tuple(noise()[face, hit.row, hit.column].tolist())
    np.testing.assert_allclose(hit.direction, main, atol=1e-12)


def test_a_mirror_has_no_t_and_shows_r():
    view = view_of(angle=0, eye=45)
    assert view.refracted is None
    np.testing.assert_allclose(view.hit.direction, np.array([1, 1, 0]) / np.sqrt(2), atol=1e-12)
    view.mode = "refraction"
    assert view.hit.direction[1] < 0


def test_total_reflection_begins_at_the_critical_angle():
    critical = np.degrees(np.arcsin(1 / 1.5))
    view = view_of(mode="refraction", angle=180, eye=0, ior=1.5)
    for beyond in (-0.01, 0.01):
        view.eye = critical + beyond
        assert (view.refracted is None) == (beyond > 0)
    assert view.text.startswith("R hits")
    assert view.facts.critical == pytest.approx(critical)
    view.angle = 0  # from outside there is none
    view.eye = 89
    assert view.refracted is not None
    assert view.facts.critical is None


def linear(values):
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def test_the_light_that_the_eye_gets():
    faces = noise()
    view = view_of(angle=13, eye=50)
    lookups = [linear(sample_faces(faces, v)) for v in (view.reflected,)]
    np.testing.assert_allclose(view.color, lookups[0], atol=2e-4)
    view.mode = "refraction"
    through = linear(sample_faces(faces, view.refracted))
    expected = view.share * lookups[0] + (1 - view.share) * through
    np.testing.assert_allclose(view.color, expected, atol=2e-4)


def test_a_rough_surface_shows_the_mean_of_its_lobe():
    view = view_of(angle=13, eye=50, roughness=0.6)
    directions, weights = lobe(view.incident, view.normal, 0.36, 512, None)
    values = linear(sample_faces(noise(), directions))
    expected = (values * weights[:, None]).sum(axis=0) / weights.sum()
    np.testing.assert_allclose(view.color, expected, atol=2e-4)
    assert np.abs(view.color - view_of(angle=13, eye=50).color).max() > 0.01
    one = cc.CubeMap(np.full((6, 4, 4, 3), 0.25, np.float32))
    for mode in ("reflection", "refraction"):
        even = ReflectionView(one, mode=mode, roughness=1, angle=-160)
        np.testing.assert_allclose(even.color, 0.25, rtol=1e-5)  # no light is lost or made


# The lobe -----------------------------------------------------------------------------------------------------


def sphere(count=700):
    """Directions on a sphere, and the solid angle of each."""
    theta = (np.arange(count) + 0.5) / count * np.pi
    phi = (np.arange(2 * count) + 0.5) / count * np.pi
    t, p = np.meshgrid(theta, phi, indexing="ij")
    directions = np.stack([np.sin(t) * np.cos(p), np.cos(t), np.sin(t) * np.sin(p)], axis=-1)
    return directions, np.sin(t) * (np.pi / count) ** 2


@pytest.mark.parametrize("alpha", [0.1, 0.5, 1.0])
def test_facets_are_normalised_and_drawn_as_their_density(alpha):
    directions, solid = sphere()
    n = np.array([0.36, 0.8, -0.48])
    cosine = directions @ n
    weight = distribution(cosine, alpha) * np.maximum(cosine, 0) * solid
    assert weight.sum() == pytest.approx(1, abs=2e-3)  # equation 4 of Walter 2007
    m = facet_normals(n, alpha, 4096)
    np.testing.assert_allclose(np.linalg.norm(m, axis=-1), 1)
    np.testing.assert_allclose(
        m.mean(axis=0), (directions * weight[..., None]).sum(axis=(0, 1)), atol=5e-3
    )
    for limit in (0.5, 0.8, 0.95):
        assert (m @ n > limit).mean() == pytest.approx(weight[cosine > limit].sum(), abs=0.01)


@pytest.mark.parametrize("eta", ETAS)
@pytest.mark.parametrize("alpha", [0.16, 0.5])
def test_directions_are_spread_as_their_density(eta, alpha):
    n = np.array([0.0, 0.6, 0.8])
    i = np.array([0.48, -0.6, -0.64])
    out, _ = lobe(i, n, alpha, 8192, eta)
    directions, solid = sphere()
    weight = density(directions, i, n, alpha, eta) * solid
    assert len(out) / 8192 == pytest.approx(weight.sum(), abs=5e-3)
    np.testing.assert_allclose(
        out.sum(axis=0) / 8192, (directions * weight[..., None]).sum(axis=(0, 1)), atol=5e-3
    )


def test_the_lobe_of_a_smooth_surface_is_one_direction():
    i, n = np.array([0.6, -0.8, 0]), np.array([0.0, 1, 0])
    for eta, expected in ((None, reflect(i, n)), (1 / 1.5, snell(i, n, 1, 1.5))):
        out, weights = lobe(i, n, 1e-6, 64, eta)
        np.testing.assert_allclose(out, np.tile(expected, (64, 1)), atol=1e-4)
        np.testing.assert_allclose(weights, 1, atol=1e-4)
    assert shadowing(1.0, 0.7) == 1
    assert shadowing(1e-6, 0.7) < 1e-5


def test_the_outline_is_longest_near_r_and_lies_on_its_side():
    view = view_of(roughness=0.3, angle=20, eye=55, azimuth=40)
    outline = view.facts.outline(view.plane)
    long = np.linalg.norm(outline, axis=-1)
    assert long.max() == pytest.approx(1)
    longest = outline[long.argmax()]
    assert longest @ view.plane.flat(view.reflected) > 0.99
    assert (outline @ view.plane.flat(view.normal) > -1e-9).all()
    assert len(view_of().facts.outline(view.plane)) == 0


# Pictures -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("azimuth", [0, 30])
@pytest.mark.parametrize("size", [(960, 600), (400, 300), (500, 800)])
def test_the_band_shows_the_texels_in_their_directions(azimuth, size):
    faces = noise()
    view = ReflectionView(cc.CubeMap(faces), azimuth=azimuth, size=size, angle=170, eye=170)
    picture = view._picture(size, True)
    layout, plane = Layout.of(size), Plane(azimuth)
    x, y = np.meshgrid(np.arange(0, size[0], 5), np.arange(0, size[1], 5))
    flat = layout.flat(x + 0.5, y + 0.5, plane)
    reach = np.array(plane.reach)
    # A little inside the band there are no lines.
    size_ = np.abs(flat)
    band = (size_ < reach + 0.75 * BAND).all(axis=-1) & (size_ > reach + 0.25 * BAND).any(axis=-1)
    band &= flat[..., 1] > -0.5  # the ray ends in the lower part
    face, s, t = cube_faces.direction_to_face_uv(plane.world(flat))
    texels = faces[face, (t * N).astype(int).clip(0, N - 1), (s * N).astype(int).clip(0, N - 1)]
    same = (picture[y, x][..., :3] == texels).all(axis=-1)
    assert band.sum() > 40
    assert same[band].mean() > 0.98  # a place on the border of two texels may be rounded either way
    for px, py in zip(x[band][::9].tolist(), y[band][::9].tolist(), strict=True):
        texel = view.at(px + 0.5, py + 0.5)
        assert texel is not None
    assert view.at(*layout.pixel((0, 0), plane)) is None


def test_a_ray_ends_at_the_texel_that_it_hits():
    for mode in ("reflection", "refraction"):
        for angle in range(-80, 81, 20):
            view = view_of(angle=angle, eye=10, mode=mode, azimuth=25)
            flat = view.plane.flat(view.facts.main)
            far = min((np.array(view.plane.reach) + BAND / 2) / np.abs(flat))
            found = view.at(*view._layout.pixel(far * flat, view.plane))
            assert (found.face, found.row, found.column) == (
                view.hit.face,
                view.hit.row,
                view.hit.column,
            )


def close_to(picture, color):
    return (np.abs(picture[..., :3].astype(int) - color) < 40).all(axis=-1)


@pytest.mark.parametrize("background", ["dark", "light"])
def test_the_rays_are_where_they_point(background):
    view = view_of(background=background, angle=10, eye=60, mode="refraction", size=(960, 600))
    picture, rays = view.draw(), RAYS[background]
    layout, plane = Layout.of(view.size), view.plane
    for direction, color in (
        (view.normal, rays.normal),
        (-view.incident, rays.incident),
        (view.refracted, rays.refracted),
    ):
        x, y = np.floor(layout.pixel(0.4 * plane.flat(direction), plane)).astype(int)
        assert close_to(picture[y - 1 : y + 2, x - 1 : x + 2], color).any()
    view.mode = "reflection"
    x, y = np.floor(layout.pixel(0.4 * plane.flat(view.reflected), plane)).astype(int)
    assert close_to(view.draw()[y - 1 : y + 2, x - 1 : x + 2], rays.reflected).any()


@pytest.mark.parametrize(("angle", "eye"), [(0, 0), (-60, -60), (30, 30), (20, 55)])
def test_the_name_of_n_is_not_hidden_by_r(angle, eye):
    """Straight from above R lies on N; the name stands beside both, in the colour of N."""
    view = view_of(angle=angle, eye=eye)
    picture = view.draw()[..., :3].astype(int)
    y, x = np.mgrid[: picture.shape[0], : picture.shape[1]]
    layout = Layout.of(view.size)
    middle, tip = (layout.pixel(place, view.plane) for place in (np.zeros(2), turned(angle)))
    along = (tip - middle) / np.linalg.norm(tip - middle)
    # Pixels beside the line of N, in front of the surface and in its colour.
    beside = (x - middle[0]) * along[1] - (y - middle[1]) * along[0]
    front = (x - middle[0]) * along[0] + (y - middle[1]) * along[1]
    green = np.abs(picture - RAYS["dark"].normal).max(axis=-1) < 60
    reach = np.linalg.norm(tip - middle)
    name = green & (np.abs(front) < reach) & (front > 0.2 * reach) & (np.abs(beside) < 30)
    assert (name & (np.abs(beside) > 9 if angle == eye else True)).sum() > 20


def test_the_texel_is_marked_on_the_cross():
    view = view_of(size=(960, 600))
    layout = Layout.of(view.size)
    left, top = layout.cross[:2]
    x, y = layout.of_cross().places(view.hit.direction) + (left, top)  # noqa: RUF005
    around = view.draw()[int(y) - 20 : int(y) + 20, int(x) - 20 : int(x) + 20]
    assert close_to(around, RAYS["dark"].reflected).sum() > 30
    texel = view.at(x, y)
    assert (texel.face, texel.row, texel.column) == (view.hit.face, view.hit.row, view.hit.column)


@pytest.mark.parametrize("size", [(960, 600), (320, 240), (200, 700), (31, 17), (1, 1)])
@pytest.mark.parametrize("mode", ["reflection", "refraction"])
def test_everything_can_be_drawn_at_every_size(size, mode):
    for angle in (20, -170):
        view = view_of(size=size, mode=mode, roughness=0.5, angle=angle, background="light")
        for moving in (True, False):
            picture = view._picture(size, moving)
            assert picture.shape == (size[1], size[0], 4)
            assert picture.dtype == np.uint8
    if min(size) > 100:
        assert (view.draw()[..., :3] == THEMES["light"].paper).all(axis=-1).any()


def test_a_small_picture_is_the_large_one_made_smaller():
    """While something moves, a picture of half the size stands in for the large one: nothing may change its place."""
    view = view_of(size=(960, 600))
    large = view.draw()[..., :3].astype(float)
    half = large.reshape(300, 2, 480, 2, 3).mean(axis=(1, 3))
    small = view._picture((480, 300), False)[..., :3]
    assert np.abs(half - small).mean() < 4


def test_the_picture_follows_the_environment():
    cube = cc.CubeMap(noise())
    view = ReflectionView(cube, size=(320, 200))
    before = view.draw()
    cube.set_face(view.hit.face, noise()[0] // 2)
    assert (view.draw() != before).any()
    assert (view.draw() == ReflectionView(cube, size=(320, 200)).draw()).all()


def test_in_band():
    plane = Plane(0)
    flat = np.array([[0, 0], [0.99, 0], [1.01, 0], [0, -1.1], [1 + BAND + 0.01, 0]])
    assert in_band(flat, plane).tolist() == [False, False, True, True, False]


# Events -------------------------------------------------------------------------------------------------------


def move(view, kind, flat, **more):
    x, y = view._layout.pixel(flat, view.plane).tolist()
    view._answer({"event_type": kind, "x": x, "y": y, **more})


def drag(view, start, end):
    move(view, "pointer_down", start, button=1)
    for k in (0.25, 0.5, 0.75, 1):
        move(view, "pointer_move", (1 - k) * np.asarray(start) + k * np.asarray(end), buttons=(1,))
    move(view, "pointer_up", end, button=1)


def test_a_drag_turns_the_surface():
    view = view_of(angle=20, eye=55)
    told: list[str] = []
    view.add_listener(lambda name, value: told.append(name))
    drag(view, 0.6 * turned(0), 0.5 * turned(30))
    assert view.angle == pytest.approx(50)
    assert view.eye == 55
    assert {"text", "panel"} <= set(told)
    move(view, "pointer_move", (0.3, 0.3), buttons=())
    assert view.angle == pytest.approx(50)


def test_a_drag_at_the_eye_moves_the_eye():
    view = view_of(angle=20, eye=55)
    drag(view, EYE * turned(55), 0.7 * turned(-15))
    assert view.eye == pytest.approx(-15)
    assert view.angle == 20


def test_a_drag_past_straight_down_goes_on():
    view = view_of(angle=175, eye=0)
    drag(view, 0.6 * turned(175), 0.6 * turned(-170))
    assert view.angle == pytest.approx(-170)


def test_keys_and_wheel():
    view = view_of()

    def press(*keys):
        for key in keys:
            view._answer({"event_type": "key_down", "key": key, "modifiers": ()})

    press("ArrowLeft", "ArrowUp", "m")
    assert (view.angle, view.azimuth, view.mode) == (25, 5, "refraction")
    view._answer({"event_type": "wheel", "x": 5, "y": 5, "dx": 0, "dy": 400})
    assert view.roughness == pytest.approx(0.1)
    press("r")
    assert (view.angle, view.azimuth, view.roughness, view.mode) == (20, 0, 0, "refraction")
    press("h")
    assert "turn the surface" in view.text


def test_the_text_says_what_is_hit_and_what_is_under_the_pointer():
    view = view_of(angle=0, eye=30)
    assert view.text == f"R hits {view.hit}"
    move(view, "pointer_move", (1 + BAND / 2, 0.3))
    x, y = view._layout.pixel((1 + BAND / 2, 0.3), view.plane)
    assert view.text == str(view.at(x, y))
    move(view, "pointer_move", (0.2, 0.3))
    assert view.text == f"R hits {view.hit}"


def test_the_panel():
    view = view_of()
    controls = {c.name: c for section in view.panel() for c in section.controls}
    assert {"mode", "angle", "ior", "roughness", "azimuth", "eye"} <= set(controls)
    assert (controls["ior"].low, controls["ior"].high) == (1, 2.5)
    controls["ior"].set(1.33)
    controls["mode"].set("refraction")
    i, n = view.incident, view.normal
    np.testing.assert_allclose(view.refracted, snell(i, n, 1, 1.33), atol=1e-12)
    controls["tonemap"].set("none")
    assert view.tonemap is None
    controls["reset"].set(None)
    assert (view.ior, view.tonemap) == (1.5, "neutral")  # type: ignore[comparison-overlap]


@pytest.mark.parametrize(
    ("name", "value", "error"),
    [
        ("ior", 0.1, ValueError),
        ("ior", None, TypeError),
        ("roughness", 1.1, ValueError),
        ("mode", "both", ValueError),
        ("angle", np.nan, ValueError),
    ],
)
def test_bad_values_are_errors(name, value, error):
    view = view_of()
    before = getattr(view, name)
    with pytest.raises(error, match=f"{name}: expected"):
        setattr(view, name, value)
    assert getattr(view, name) == before
    with pytest.raises(error, match=f"{name}: expected"):
        cc.explore.reflection(where="offscreen", **{name: value})


def test_reflection():
    with cc.explore.reflection(where="offscreen") as view:
        assert view.environment.size == 32
        assert view.draw().shape == (600, 960, 4)
    assert view.closed
    with pytest.raises(TypeError, match="environment: expected a CubeMap or None, got str"):
        cc.explore.reflection("studio.exr", where="offscreen")
    with pytest.raises(TypeError, match="did you mean 'roughness'"):
        cc.explore.reflection(rougness=1)
