"""Outputs of a capture as panoramas, layouts, other sizes and files: the nearest texel, and never a mixture."""

import numpy as np
import pytest

import cubecam as cc
from tests.captures import with_outputs
from tests.compare import assert_identical
from tests.helpers import conventions, copies, layouts
from tests.reference.cube_faces import convert, direction_to_face_uv, to_layout
from tests.reference.equirect import equirect_uv_to_direction, pixel_directions

SIZE = 7


def outputs_of(size):
    """Every kind of output, with the numbers that filters spoil: inf, NaN, whole numbers beyond float32."""
    rng = np.random.default_rng(5)

    def floats(*channels):
        return rng.random((6, size, size, *channels)).astype(np.float32)

    distance, position = floats(), floats(3)
    distance[rng.random(distance.shape) < 0.4] = np.inf
    position[rng.random(distance.shape) < 0.4] = np.nan
    ids = rng.integers(2**24, 2**31 - 1, (6, size, size), dtype=np.int32)
    return {
        "distance": distance,
        "z": floats(),
        "normal": floats(3) * 2 - 1,
        "position": position,
        "id": ids,
        "label": -ids,
        "depth": floats(),
        "stencil": rng.integers(0, 256, (6, size, size), dtype=np.uint8),
        "flow": floats(2),
        "heat": floats(4),
    }


OUTPUTS = outputs_of(SIZE)
FACES = np.random.default_rng(6).random((6, SIZE, SIZE, 3)).astype(np.float32)
CUBE = with_outputs(FACES, OUTPUTS, mipmaps=True)
outputs = pytest.mark.parametrize("name", OUTPUTS)


def texels_along(directions, size):
    """(face, row, column) of the texels that directions meet, and where no rounding can choose another one."""
    face, s, t = direction_to_face_uv(directions)
    place = np.stack([t, s]) * size
    row, column = np.clip(place.astype(int), 0, size - 1)
    ordered = np.sort(np.abs(directions), axis=-1)
    certain = (np.abs(place - np.round(place)) > 1e-6).all(axis=0)
    certain &= ordered[..., 2] - ordered[..., 1] > 1e-6 * ordered[..., 2]
    return (face, row, column), certain


def assert_texels(got, values, directions, places=1.0):
    where, certain = texels_along(directions, values.shape[1])
    assert got.dtype == values.dtype
    assert got.shape == (*directions.shape[:-1], *values.shape[3:])
    assert certain.mean() > 0.5 * places
    assert_identical(got[certain], values[where][certain])
    # No number is new, not even where directions lie between two texels.
    channels = values.reshape(6 * values.shape[1] ** 2, -1).T
    for found, held in zip(got.reshape(-1, len(channels)).T, channels, strict=True):
        assert np.isin(
            found.view(f"u{found.itemsize}"), held.copy().view(f"u{held.itemsize}")
        ).all()


@outputs
@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_panoramas(name, center):
    for width in (2, 6, 28, 64):
        got = CUBE.to_equirect(width=width, center=center, output=name)
        directions = pixel_directions(width, width // 2, center)
        assert_texels(got, OUTPUTS[name], directions, places=0 if width < 28 else 1)
    assert CUBE.to_equirect(output=name).shape[:2] == (2 * SIZE, 4 * SIZE)


def test_panoramas_of_one_texel_a_face():
    cube = with_outputs(FACES[:, :1, :1], {"id": np.arange(6, dtype=np.int32)[:, None, None]})
    ids = cube.to_equirect(width=64, output="id")
    assert_texels(ids, cube.outputs["id"], pixel_directions(64, 32))
    assert set(ids.ravel().tolist()) == set(range(6))


def test_panoramas_with_samples_on_the_borders():
    v, u = np.meshgrid(np.linspace(0, 1, 20), np.linspace(0, 1, 40), indexing="ij")
    got = CUBE.to_equirect(width=40, sampling="borders", output="normal")
    assert_texels(got, OUTPUTS["normal"], equirect_uv_to_direction(u, v))


@outputs
def test_lookups(name, rng):
    directions = rng.normal(size=(20, 30, 3)).astype(np.float32)
    got = CUBE.sample(directions, output=name)
    assert_texels(got, OUTPUTS[name], directions.astype(float))
    assert CUBE.sample([0, 0, 9.5], output=name).shape == OUTPUTS[name].shape[3:]


def test_lookups_of_outputs_have_one_level():
    with pytest.raises(ValueError, match=r"lod: expected 0 for an output"):
        CUBE.sample([0, 0, 1], lod=1, output="id")


@outputs
@pytest.mark.parametrize("size", [1, 3, 7, 14, 20])
def test_sizes(name, size):
    held = CUBE.resize(size).outputs[name]
    place = ((np.arange(size) + 0.5) / size * SIZE).astype(int)
    assert_identical(held, OUTPUTS[name][:, place[:, None], place])


def test_other_sizes_have_all_outputs_and_the_same_colors():
    small = CUBE.resize(3)
    assert list(small.outputs) == list(OUTPUTS)
    assert small.mipmaps
    assert_identical(small.faces, cc.CubeMap(FACES).resize(3).faces)
    assert_identical(small.id, small.outputs["id"])


@outputs
@conventions
def test_conventions_move_texels_and_leave_vectors(name, convention):
    got = CUBE.to_convention(convention, output=name)
    assert_identical(got, convert(OUTPUTS[name], "gl", convention))


@outputs
@layouts
@conventions
def test_layouts(name, layout, convention):
    got = CUBE.to_layout(layout, convention=convention, output=name)
    assert_identical(got, to_layout(OUTPUTS[name], layout, convention))


@outputs
def test_layouts_that_resample_colors(name):
    got = CUBE.to_layout("openexr", output=name)
    assert_identical(got, to_layout(OUTPUTS[name], "column", "inside"))
    assert_identical(CUBE.to_layout("equirect", output=name), CUBE.to_equirect(output=name))


@copies
def test_copies_keep_outputs(make_copy):
    for cube in (CUBE, CUBE.resize(5)):
        again = make_copy(cube)
        assert again == cube
        for name, values in cube.outputs.items():
            assert_identical(again.outputs[name], values)
            assert_identical(again.copy().outputs[name], values)


def test_color_is_the_default():
    assert_identical(CUBE.to_equirect(output="color"), CUBE.to_equirect())
    assert_identical(CUBE.to_layout("row", output="color"), CUBE.to_layout("row"))
    assert_identical(CUBE.to_convention("inside", output="color"), CUBE.to_convention("inside"))
    assert_identical(CUBE.sample([1, 2, 3], output="color"), CUBE.sample([1, 2, 3]))


USES = {
    "to_equirect": lambda cube, output, path: cube.to_equirect(output=output),
    "to_layout": lambda cube, output, path: cube.to_layout("row", output=output),
    "to_convention": lambda cube, output, path: cube.to_convention("gl", output=output),
    "sample": lambda cube, output, path: cube.sample([0, 0, 1], output=output),
    "save": lambda cube, output, path: cube.save(path / "a.exr", output=output),
}


@pytest.mark.parametrize("use", USES.values(), ids=USES)
def test_other_outputs_are_refused_with_those_there_are(use, tmp_path):
    cube = with_outputs(FACES, {"id": OUTPUTS["id"], "heat": OUTPUTS["heat"]})
    with pytest.raises(
        ValueError,
        match='output: expected "color", "id", "heat", which this cube has; got \'distance\'',
    ):
        use(cube, "distance", tmp_path)
    with pytest.raises(ValueError, match=r'expected "color", since .*outputs=; got \'id\''):
        use(cc.CubeMap(FACES), "id", tmp_path)
    assert not list(tmp_path.iterdir())


def test_outputs_keep_their_type():
    for convert_to in (
        lambda: CUBE.to_equirect(dtype="float32", output="id"),
        lambda: CUBE.to_layout("row", dtype=np.float16, output="id"),
    ):
        with pytest.raises(
            ValueError, match="dtype: expected None with output='id', which stays int32"
        ):
            convert_to()


# Files ----------------------------------------------------------------------------------------------------------------

FILE_OUTPUTS = [name for name in OUTPUTS if name not in ("label", "flow")]


def as_stored(values):
    """The numbers as a file holds them: whole numbers have 32 bits and no sign."""
    return values if values.dtype.kind == "f" else values.astype(np.uint32)


@pytest.mark.parametrize("name", FILE_OUTPUTS)
@pytest.mark.parametrize("layout", ["cross", "vertical_cross", "row", "column", "openexr"])
def test_files_of_every_layout(name, layout, tmp_path):
    CUBE.save(tmp_path / "a.exr", layout=layout, output=name)
    got = cc.load_image(tmp_path / "a.exr")
    want = CUBE.to_layout(layout, output=name)
    assert_identical(got, as_stored(want).reshape(got.shape))


@pytest.mark.parametrize("name", FILE_OUTPUTS)
def test_files_of_panoramas(name, tmp_path):
    CUBE.save(tmp_path / "a.exr", layout="equirect", width=40, center="+x", output=name)
    got = cc.load_image(tmp_path / "a.exr")
    want = CUBE.to_equirect(width=40, center="+x", output=name)
    assert_identical(got, as_stored(want).reshape(got.shape))


@conventions
def test_six_files(convention, tmp_path):
    CUBE.save(tmp_path / "a_{face}.exr", convention=convention, output="id")
    want = convert(OUTPUTS["id"], "gl", convention)
    for face, name in enumerate(("px", "nx", "py", "ny", "pz", "nz")):
        got = cc.load_image(tmp_path / f"a_{name}.exr")
        assert_identical(got[..., 0], want[face].astype(np.uint32))


def test_a_file_of_distances_is_a_cubemap(tmp_path):
    CUBE.save(tmp_path / "a.exr", layout="cross", convention="inside", output="distance")
    again = cc.load_cubemap(tmp_path / "a.exr", convention="inside")
    assert_identical(again.faces[..., 0], OUTPUTS["distance"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"path": "a.png"}, r"expected a file name that ends in \.exr, .* got 'a\.png'"),
        ({"path": "a_{face}.hdr"}, r"expected a file name that ends in \.exr"),
        ({"path": "a_{face}.exr", "layout": "row"}, r'layout: expected "faces" or None'),
        ({"layout": "faces"}, "expected six paths"),
        ({"layout": "openexr", "convention": "gl"}, '"inside" by definition'),
        ({"half": True}, 'half, exposure, srgb: expected with output="color" only'),
        ({"exposure": 1}, 'half, exposure, srgb: expected with output="color" only'),
        ({"width": 8}, "width: expected with layout"),
        ({"output": "label"}, "whole numbers 0 to"),
        ({"output": "flow"}, "expected 1, 3 or 4 channels"),
    ],
)
def test_what_files_cannot_hold_is_refused(options, message, tmp_path):
    path = tmp_path / options.pop("path", "a.exr")
    with pytest.raises(ValueError, match=message):
        CUBE.save(path, **{"output": "id", **options})
    assert not list(tmp_path.iterdir())
