"""Projections of cubes: golden directions, the oracle, round trips, continuity, no aliasing, outputs, bad calls."""

# Some calls are wrong on purpose.
# mypy: disable-error-code="arg-type"

import math

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.reference.cube_faces import texel_directions, unit_texel_directions
from tests.reference.pattern import direction_pattern, random_faces
from tests.reference.projections import pixel_positions, seen, seen_at, viewer_axes
from tests.reference.sampling import sample_faces

#: Name here: name of the methods, options, field of view of the reference, width by height.
KINDS = {
    "perspective": ("perspective", {"fov": 70}, 70, 1.5),
    "equidistant": ("fisheye", {"fov": 200}, 200, 1),
    "equisolid": ("fisheye", {"fov": 220, "model": "equisolid"}, 220, 1),
    "stereographic": ("fisheye", {"fov": 250, "model": "stereographic"}, 250, 1),
    "orthographic": ("fisheye", {"fov": 140, "model": "orthographic"}, 140, 1),
    "mirror_ball": ("mirror_ball", {}, None, 1),
    "angular_map": ("angular_map", {}, None, 1),
    "octahedral": ("octahedral", {}, None, 1),
    "dual_paraboloid": ("dual_paraboloid", {}, None, 2),
    "cylindrical": ("cylindrical", {"fov": 360}, 360, 3),
    "part of a cylinder": ("cylindrical", {"fov": 150}, 150, 2),
}
kinds = pytest.mark.parametrize("kind", KINDS)
WHOLE = ("mirror_ball", "angular_map", "octahedral", "dual_paraboloid")  # these show everything
DISCS = ("equidistant", "equisolid", "stereographic", "orthographic", "mirror_ball", "angular_map")
ASKEW = {"direction": (1, 2, 0.5), "up": (0.2, 1, 0.3)}


def project(cube, kind, height, **options):
    method, given, _, aspect = KINDS[kind]
    size = (int(height * aspect), height) if method in ("perspective", "cylindrical") else height
    return getattr(cube, f"to_{method}")(size=size, **given, **options)


def back(picture, kind, size=None, **options):
    method, given, _, _ = KINDS[kind]
    return getattr(cc.CubeMap, f"from_{method}")(picture, size=size, **given, **options)


def directions_of(kind, height, **placed):
    _, _, fov, aspect = KINDS[kind]
    name = "cylindrical" if kind == "part of a cylinder" else kind
    return seen(name, int(height * aspect), height, fov, **placed)


def smooth(directions):
    d = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    x, y, z = d[..., :1], d[..., 1:2], d[..., 2:]
    return (0.5 + 0.3 * np.sin(3 * x) * np.cos(2 * y) + 0.1 * np.sin(4 * z)).astype(np.float32)


def test_golden_rows():
    """Directions of single pixels, worked out by hand. A cube of directions shows them as colours."""
    cube = cc.CubeMap(direction_pattern(256))
    half = math.sqrt(0.5)

    def check(picture, row, column, expected):
        np.testing.assert_allclose(picture[row, column], expected, atol=4e-3)

    camera = cube.to_perspective(90, (901, 301))  # pixels of 2/301 on a plane at distance 1
    check(camera, 150, 450, (0, 0, -1))
    check(camera, 50, 450, np.array([0, 200, -301]) / math.hypot(200, 301))
    check(camera, 150, 850, np.array([800, 0, -301]) / math.hypot(800, 301))
    # Of 1001 pixels, 501 + 250 is 250 / 500.5 of the radius: nearly half.
    fisheye = cube.to_fisheye(1001)
    check(fisheye, 500, 500, (0, 0, -1))
    check(fisheye, 500, 750, (half, 0, -half))
    check(fisheye, 250, 500, (0, half, -half))
    check(fisheye, 500, 1000, (1, 0, 0))
    equisolid = cube.to_fisheye(1001, model="equisolid")  # sin(a/2) = sin(45) / 2
    check(equisolid, 500, 750, (math.sin(0.7227), 0, -math.cos(0.7227)))
    stereographic = cube.to_fisheye(1001, model="stereographic")  # tan(a/2) = 1/2: 3, 4, 5
    check(stereographic, 500, 750, (0.8, 0, -0.6))
    orthographic = cube.to_fisheye(1001, model="orthographic")  # sin(a) = 1/2
    check(orthographic, 500, 750, (0.5, 0, -math.sqrt(0.75)))
    ball = cube.to_mirror_ball(1001)
    check(ball, 500, 500, (0, 0, 1))  # behind the camera
    check(ball, 500, 854, (1, 0, 0))  # the normal at 45 degrees, sqrt(1/2) from the middle
    check(ball, 146, 500, (0, 1, 0))
    probe = cube.to_angular_map(1001)
    check(probe, 500, 500, (0, 0, -1))
    check(probe, 500, 750, (1, 0, 0))
    check(probe, 750, 500, (0, -1, 0))
    check(probe, 500, 1000, (0, 0, 1))
    octahedral = cube.to_octahedral(1001)
    check(octahedral, 500, 500, (0, 0, -1))
    check(octahedral, 500, 1000, (1, 0, 0))
    check(octahedral, 0, 500, (0, 1, 0))
    check(octahedral, 250, 750, np.array([1, 1, 0]) * half)
    check(octahedral, 0, 0, (0, 0, 1))
    check(octahedral, 1000, 1000, (0, 0, 1))
    check(octahedral, 125, 875, np.array([1, 1, 2]) / math.sqrt(6))  # (3/4, 3/4), folded: 1/4, 1/4
    dual = cube.to_dual_paraboloid(1001)
    check(dual, 500, 500, (0, 0, -1))
    check(dual, 500, 750, (0.8, 0, -0.6))
    check(dual, 500, 1501, (0, 0, 1))
    check(dual, 500, 1751, (-0.8, 0, 0.6))  # who looks back has -X to the right
    check(dual, 250, 1501, (0, 0.8, 0.6))
    cylinder = cube.to_cylindrical((1001, 801))
    focal = 1001 / math.tau
    check(cylinder, 400, 500, (0, 0, -1))
    check(cylinder, 400, 750, (1, 0, 0))
    check(cylinder, 400 - round(focal), 500, (0, half, -half))


@kinds
@pytest.mark.parametrize("placed", [{}, ASKEW], ids=["ahead", "askew"])
def test_a_cube_of_directions_becomes_a_picture_of_directions(kind, placed):
    got = project(cc.CubeMap(direction_pattern(64)), kind, 120, **placed)
    expected = directions_of(kind, 120, **placed)
    outside = np.isnan(expected[..., 0])
    assert outside.mean() == pytest.approx(1 - math.pi / 4, abs=0.01) or not outside.any()
    assert (got[outside] == 0).all()
    error = np.abs(got - expected)[~outside].max(-1)
    assert error.mean() < 1e-3
    # At the rim of a ball a pixel covers a tenth of the world; its mean is not its middle.
    assert error.max() < (0.15 if kind in ("mirror_ball", "equisolid") else 1.5e-2)


@kinds
def test_to_equals_lookups_of_the_definition_where_pixels_are_small(kind, rng):
    pixels = random_faces(rng, 4)
    got = project(cc.CubeMap(pixels), kind, 90, **ASKEW)
    expected = directions_of(kind, 90, **ASKEW)
    # Near the rim of a ball pixels are large.
    inside = ~np.isnan(expected[..., 0])
    if kind == "mirror_ball":
        inside &= expected @ viewer_axes(**ASKEW)[2] < 0.5
    looked_up = sample_faces(pixels, np.where(inside[..., None], expected, 1.0))
    assert_close(got, looked_up, "resample", mask=inside)


@kinds
@pytest.mark.parametrize("placed", [{}, ASKEW], ids=["ahead", "askew"])
def test_from_looks_up_the_position_that_shows_a_direction(kind, placed):
    """A picture of its own positions, which interpolation keeps; the definition gives their directions."""
    _, _, fov, aspect = KINDS[kind]
    height = 64
    width = int(height * aspect)
    x, y = pixel_positions(width, height)
    ramps = np.stack([x, y, np.ones_like(x)], -1).astype(np.float32)
    faces = back(ramps, kind, 160, **placed).faces
    x, y = faces[..., 0].astype(float), faces[..., 1].astype(float)
    # Off the borders, where pixels of the other side or few of the disc count, and off the seams, where a texel
    # has positions of both sides, whose mean is nowhere.
    shown = (faces[..., 2] == 1) & (np.abs(x) < 0.96) & (np.abs(y) < 0.96)
    right, above, ahead = np.moveaxis(unit_texel_directions(160) @ viewer_axes(**placed).T, -1, 0)
    if kind == "dual_paraboloid":
        shown &= np.hypot(np.where(x < 0, 2 * x + 1, 2 * x - 1), y) < 0.93
    elif kind in DISCS:
        shown &= np.hypot(x, y) < 0.93
        shown &= (ahead < 0.85) if kind == "mirror_ball" else (ahead > -0.85)
    elif kind == "octahedral":
        shown &= (ahead > 0) | (np.minimum(np.abs(right), np.abs(above)) > 0.05)
    elif kind == "cylindrical":
        shown &= (ahead > 0) | (np.abs(right) > 0.05)
    name = "cylindrical" if kind == "part of a cylinder" else kind
    directions = seen_at(name, x, y, width, height, fov, **placed)
    expected = unit_texel_directions(160)
    assert shown.mean() > 0.1
    error = np.linalg.norm(directions - expected, axis=-1)[shown]
    # Where the texels are larger than the pixels, the mean of the positions is not that of the middle.
    assert error.max() < 1e-2
    assert np.quantile(error, 0.9) < 1e-5


@kinds
@pytest.mark.parametrize("placed", [{}, ASKEW], ids=["ahead", "askew"])
def test_round_trip_of_a_smooth_cube(kind, placed):
    faces = smooth(texel_directions(64))
    picture = project(cc.CubeMap(faces), kind, 256, **placed)
    cube = back(picture, kind, 64, **placed)
    shown = back(np.ones_like(picture), kind, 64, **placed).faces[..., 0]
    assert set(np.unique(shown)) <= {0.0, 1.0}
    assert shown.mean() == pytest.approx(
        {"perspective": 0.12, "equidistant": 0.587, "equisolid": 0.671, "stereographic": 0.787,
         "orthographic": 0.329, "cylindrical": 0.72, "part of a cylinder": 0.23}.get(kind, 1),
        abs=0.08,
    )  # fmt: skip
    error = np.abs(cube.faces - faces)[shown == 1]
    assert error.mean() < 1e-3
    # The rim of the ball is a single direction, and pixels beside it cover a tenth of the world.
    assert error.max() < (0.15 if kind == "mirror_ball" else 0.03)
    if kind in WHOLE:
        again = project(cube, kind, 256, **placed)
        inside = ~np.isnan(directions_of(kind, 256, **placed)[..., 0])
        assert np.abs(again - picture)[inside].mean() < 1e-3


@kinds
def test_a_constant_stays_the_same_constant(kind):
    value = np.float32(0.1)
    picture = project(cc.CubeMap(np.full((6, 20, 20, 3), value)), kind, 33)
    inside = ~np.isnan(directions_of(kind, 33)[..., 0])
    assert (picture[inside] == value).all()
    assert (picture[~inside] == 0).all()
    cube = back(np.full_like(picture, value), kind, 21)
    assert set(np.unique(cube.faces)) <= {np.float32(0), value}
    assert (cube.faces == value).any()


@pytest.mark.parametrize("kind", WHOLE)
def test_what_lies_outside_a_disc_does_not_matter(kind, rng):
    picture = project(cc.CubeMap(random_faces(rng, 16, 3)), kind, 40)
    outside = np.isnan(directions_of(kind, 40)[..., 0])
    marked = picture.copy()
    marked[outside] = 1000
    assert back(marked, kind, 16) == back(picture, kind, 16)
    assert back(picture, kind, 16).faces.min() > 0


@pytest.mark.parametrize("kind", WHOLE)
def test_no_seam_anywhere_on_the_cube(kind):
    """Neighbour directions across folds, rims and halves differ no more than elsewhere."""
    picture = smooth(np.nan_to_num(directions_of(kind, 200), nan=1.0))
    cube = back(picture, kind, 64)
    error = np.abs(cube.faces - smooth(texel_directions(64)))
    assert error.max() < (0.15 if kind == "mirror_ball" else 0.012)


def test_a_cylinder_closes():
    picture = smooth(directions_of("cylindrical", 100))
    back_side = back(picture, "cylindrical", 32).sample([[0.002, 0, 1], [-0.002, 0, 1], [0, 0, 1]])
    assert np.abs(np.diff(back_side, axis=0)).max() < 0.01
    assert np.abs(back_side - smooth(np.array([0.0, 0, 1]))).max() < 0.01


def test_the_fold_of_an_octahedral_map_is_where_its_borders_meet(rng):
    """Two places at a border, mirrored at its middle, are one direction."""
    picture = project(cc.CubeMap(smooth(texel_directions(64))), "octahedral", 128)
    assert np.abs(picture[0] - picture[0, ::-1]).max() < 0.02
    assert np.abs(picture[:, -1] - picture[::-1, -1]).max() < 0.02


@kinds
def test_stripes_do_not_alias_when_shrinking(kind):
    checks = (np.indices((96, 96)).sum(0) % 2)[None, :, :, None].repeat(6, 0).astype(np.float32)
    picture = project(cc.CubeMap(checks), kind, 8)
    inside = ~np.isnan(directions_of(kind, 8)[..., 0])
    assert np.abs(picture - 0.5)[inside].max() < 0.12
    height = 192
    stripes = np.indices((height, int(height * KINDS[kind][3]))).sum(0) % 2
    cube = back(stripes[..., None].astype(np.float32), kind, 4)
    shown = back(np.ones((*stripes.shape, 1), np.float32), kind, 4).faces == 1
    # A texel whose centre the picture just shows has the mean of few pixels.
    assert np.abs(cube.faces - 0.5)[shown].max() < 0.2


def test_a_perspective_of_one_face_is_that_face_seen_from_inside(rng):
    pixels = random_faces(rng, 64, 3)
    cube = cc.CubeMap(pixels)
    picture = cube.to_perspective(90, 64)
    assert_close(picture, cube.to_convention("inside")[5], "resample")
    small = cube.to_perspective(90, 8)
    boxes = cube.to_convention("inside")[5].reshape(8, 8, 8, 8, 3).mean((1, 3))
    assert_close(small, boxes, "resample")


@kinds
@pytest.mark.parametrize("dtype", ["uint8", "float16", "float32"])
def test_dtype_and_channels_are_kept(kind, dtype, rng):
    for channels in (1, 3, 4):
        numbers = random_faces(rng, 8, channels, np.dtype(dtype))
        cube = cc.CubeMap(numbers)
        picture = project(cube, kind, 16)
        assert picture.dtype == dtype
        assert picture.shape[2] == channels
        floats = project(cube, kind, 16, dtype="float32")
        again = back(picture, kind, 8)
        assert again.dtype == dtype
        assert again.channels == channels
        if dtype == "uint8":
            np.testing.assert_array_equal(picture, np.floor(floats * 255 + 0.5).astype(np.uint8))
            assert again.encoding == "srgb"
        elif dtype == "float16":
            np.testing.assert_array_equal(picture, floats.astype(np.float16))


def test_infinity_counts_as_the_largest_number():
    picture = np.full((32, 32, 3), 2, np.float32)
    picture[16, 16] = np.inf
    faces = cc.CubeMap.from_octahedral(picture, size=16).faces
    assert np.isfinite(faces).all()
    assert faces.max() > 1000
    assert faces.min() == 2
    cube = np.ones((6, 16, 16, 3), np.float32)
    cube[5, 8, 8] = np.inf
    seen_by_lens = cc.CubeMap(cube).to_fisheye(16)
    assert not np.isnan(seen_by_lens).any()
    assert np.isinf(seen_by_lens).any()


def test_outputs_are_the_nearest_texels(rng):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), position=(0, 0.3, -2))
    scene.add(cc.Mesh.sphere(1), position=(2, 0, 1))
    with cc.Renderer() as renderer:
        cube = renderer.capture(scene, size=64, outputs=("distance", "id", "position", "z"))
    for kind in KINDS:
        directions = directions_of(kind, 50)
        inside = ~np.isnan(directions[..., 0])
        for output, outside in (("id", 0), ("distance", np.inf), ("position", np.nan)):
            got = project(cube, kind, 50, output=output)
            expected = cube.sample(np.where(inside[..., None], directions, 1.0), output=output)
            same = np.isclose(got, expected, equal_nan=True)
            same = same if same.ndim == 2 else same.all(-1)
            assert same[inside].mean() > 0.98  # a direction between two texels may go either way
            assert got.dtype == expected.dtype
            np.testing.assert_array_equal(got[~inside], np.full_like(got[~inside], outside))
    with pytest.raises(ValueError, match="dtype: expected None"):
        cube.to_fisheye(8, output="id", dtype="float32")
    with pytest.raises(ValueError, match="output: expected"):
        cube.to_octahedral(8, output="normal")


def test_default_sizes_keep_the_resolution_in_the_middle():
    cube = cc.CubeMap(np.zeros((6, 64, 64, 3), np.float32))
    shapes = {
        "fisheye": (101, 101, 3),  # 64 * pi / 2
        "mirror_ball": (128, 128, 3),
        "angular_map": (201, 201, 3),
        "octahedral": (128, 128, 3),
        "dual_paraboloid": (128, 256, 3),
        "cylindrical": (64, 201, 3),
    }
    for name, shape in shapes.items():
        picture = getattr(cube, f"to_{name}")()
        assert picture.shape == shape
        size = getattr(cc.CubeMap, f"from_{name}")(picture).size
        assert size == {"octahedral": 128, "dual_paraboloid": 128}.get(name, 64)
    assert cc.CubeMap.from_perspective(np.zeros((60, 80, 3), np.float32), 90).size == 64


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda c: c.to_perspective(180, 8), ValueError, "fov: expected degrees above 0 and below 180"),
        (lambda c: c.to_perspective(0, 8), ValueError, "fov"),
        (lambda c: c.to_perspective(float("nan"), 8), ValueError, "fov"),
        (lambda c: c.to_perspective("wide", 8), TypeError, "fov"),
        (lambda c: c.to_perspective(60, 0), ValueError, "size"),
        (lambda c: c.to_perspective(60, (8, 0)), ValueError, "size"),
        (lambda c: c.to_perspective(60, 8.5), TypeError, "size"),
        (lambda c: c.to_perspective(60), TypeError, "size"),
        (lambda c: c.to_fisheye(8, fov=361), ValueError, "up to 360"),
        (lambda c: c.to_fisheye(8, fov=360, model="stereographic"), ValueError, "below 360"),
        (lambda c: c.to_fisheye(8, fov=181, model="orthographic"), ValueError, "up to 180"),
        (lambda c: c.to_fisheye(8, model="thoby"), ValueError, "model"),
        (lambda c: c.to_octahedral(8, direction=(0, 0, 0)), ValueError, "direction"),
        (lambda c: c.to_octahedral(8, direction=(0, 1, 0)), ValueError, "up: expected"),
        (lambda c: c.to_octahedral(8, direction=(0, np.inf, 0)), ValueError, "direction"),
        (lambda c: c.to_octahedral(8, up=(1, 2)), ValueError, "up"),
        (lambda c: c.to_octahedral(8, up="above"), TypeError, "up"),
        (lambda c: c.to_octahedral(1 << 21), ValueError, "size"),
        (lambda c: c.to_octahedral(8, dtype="int16"), ValueError, "dtype"),
        (lambda c: c.to_cylindrical(fov=400), ValueError, "fov"),
        (lambda c: c.from_octahedral(np.zeros((8, 9, 3))), ValueError, "a square"),
        (lambda c: c.from_fisheye(np.zeros((8, 8))), ValueError, "image"),
        (lambda c: c.from_mirror_ball(np.zeros((8, 8, 2))), ValueError, "image"),
        (lambda c: c.from_dual_paraboloid(np.zeros((8, 8, 3))), ValueError, "twice as wide"),
        (lambda c: c.from_angular_map(np.full((8, 8, 3), np.nan)), ValueError, "NaN|nan"),
        (lambda c: c.from_angular_map(np.zeros((8, 8, 3), int)), TypeError, "image"),
        (lambda c: c.from_cylindrical(np.zeros((0, 8, 3))), ValueError, "image"),
        (lambda c: c.from_cylindrical(np.zeros((4, 8, 3)), size=0), ValueError, "size"),
    ],
)  # fmt: skip
def test_bad_calls_are_refused(call, error, message):
    with pytest.raises(error, match=message):
        call(cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32)))


def quaternion_matrix(axis, degrees):
    """Rodrigues' formula."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(degrees)
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def test_rotate_shows_in_the_turned_direction_what_was_there(rng):
    pixels = random_faces(rng, 4)
    axis, degrees = (1, -2, 0.5), 37
    turned = cc.CubeMap(pixels).resize(64).rotate(cc.axis_angle(axis, degrees))
    # Row vectors: d R is R^-1 d.
    source = texel_directions(64) @ quaternion_matrix(axis, degrees)
    expected = sample_faces(cc.CubeMap(pixels).resize(64).faces, source)
    assert np.abs(turned.faces - expected).mean() < 2e-3
    assert np.abs(turned.faces - expected).max() < 0.05


@pytest.mark.parametrize("dtype", [np.uint8, np.float16, np.float32])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_quarter_turns_copy_texels(channels, dtype, rng):
    pixels = random_faces(rng, 5, channels, dtype)
    cube = cc.CubeMap(pixels)
    for axis in np.eye(3):
        for degrees in (90, 180, 270, -90):
            turned = cube.rotate(cc.axis_angle(axis, degrees))
            matrix = np.rint(quaternion_matrix(axis, degrees))
            source = texel_directions(5) @ matrix
            from tests.reference.cube_faces import direction_to_face_uv

            face, s, t = direction_to_face_uv(source)
            row, column = np.floor(t * 5).astype(int), np.floor(s * 5).astype(int)
            np.testing.assert_array_equal(turned.faces, pixels[face, row, column])
            assert turned.rotate(cc.axis_angle(axis, -degrees)) == cube
    third = cc.axis_angle((1, 1, 1), 120)
    assert cube.rotate(third).rotate(third).rotate(third) == cube
    assert cube.rotate((1, 0, 0, 0)) == cube


def test_rotate_keeps_what_the_cube_is():
    cube = cc.CubeMap(np.full((6, 8, 8, 4), 0.3, np.float16), mipmaps=True, encoding="srgb")
    turned = cube.rotate(cc.axis_angle((1, 2, 3), 50))
    assert turned == cube
    filtered = cc.CubeMap(direction_pattern(32)).prefilter(levels=3)
    turned = filtered.rotate(cc.axis_angle((0, 0, 1), 90))
    for before, after in zip(filtered.levels, turned.levels, strict=True):
        assert cc.CubeMap(before).rotate(cc.axis_angle((0, 0, 1), 90)) == cc.CubeMap(after)
    for bad in ((0, 0, 0, 0), (1, 0, 0), (1, 0, 0, np.nan)):
        with pytest.raises(ValueError, match="rotation"):
            cube.rotate(bad)
