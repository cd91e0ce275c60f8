"""Cubemaps to files and back: six files, crosses, row, column, equirect, OpenEXR's cube."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.helpers import conventions, layouts
from tests.reference.cube_faces import FACE_NAMES, convert, face_uv_to_direction, to_layout
from tests.reference.equirect import faces_to_equirect, pixel_directions
from tests.reference.pattern import direction_pattern, face_pattern, random_faces
from tests.reference.tone import srgb_decode


def six(folder, ending="png"):
    return [folder / f"{name}.{ending}" for name in ("px", "nx", "py", "ny", "pz", "nz")]


@conventions
@pytest.mark.parametrize("ending", ["png", "exr"])
def test_six_files_round_trip(convention, ending, tmp_path):
    pattern = face_pattern(8) if ending == "png" else face_pattern(8).astype(np.float16)
    cc.CubeMap(pattern).save(six(tmp_path, ending), convention=convention)
    stored = np.stack([cc.load_image(path) for path in six(tmp_path, ending)])
    assert_identical(stored, convert(pattern, "gl", convention))
    assert_identical(cc.load_cubemap(six(tmp_path, ending), convention=convention).faces, pattern)


@conventions
@layouts
@pytest.mark.parametrize("ending", ["png", "exr"])
def test_one_file_round_trip(layout, convention, ending, tmp_path):
    path = tmp_path / f"a.{ending}"
    pattern = face_pattern(8) if ending == "png" else face_pattern(8).astype(np.float32)
    cc.CubeMap(pattern).save(path, layout=layout, convention=convention)
    assert_identical(cc.load_image(path), to_layout(pattern, layout, convention))
    assert_identical(cc.load_cubemap(path, convention=convention).faces, pattern)
    assert_identical(cc.load_cubemap(path, layout=layout, convention=convention).faces, pattern)


def test_a_template_names_six_files(tmp_path):
    pattern = face_pattern(8)
    cc.CubeMap(pattern).save(str(tmp_path / "sky_{face}.png"))
    assert len(list(tmp_path.glob("sky_*.png"))) == 6
    assert_identical(cc.load_cubemap(str(tmp_path / "sky_{face}.png")).faces, pattern)


@pytest.mark.parametrize("dtype", [np.uint8, np.float16, np.float32])
def test_exr_of_every_dtype(dtype, tmp_path, rng):
    pixels = random_faces(rng, 6, 3, dtype)
    cc.CubeMap(pixels).save(tmp_path / "a.exr", layout="column")
    got = cc.load_cubemap(tmp_path / "a.exr").faces
    want = srgb_decode(pixels / 255) if dtype == np.uint8 else pixels
    assert np.abs(got.astype(float) - want).max() <= (5e-4 if dtype == np.uint8 else 0)


def test_equirect_file(tmp_path):
    cube = cc.CubeMap(direction_pattern(32))
    for center in ("-z", "+z", "+x"):
        path = tmp_path / f"pano{center}.exr"
        cube.save(path, layout="equirect", center=center)
        stored = cc.load_image(path)
        assert np.abs(stored - pixel_directions(128, 64, center)).max() < 1e-2
        back = cc.load_cubemap(path, size=32, center=center)
        assert np.abs(back.faces - direction_pattern(32)).max() < 2e-2


def test_panorama_equals_to_equirect(tmp_path, rng):
    cube = cc.CubeMap(random_faces(rng, 8))
    cc.save_image(tmp_path / "pano.exr", cube.to_equirect(width=128))
    assert_close(
        cc.load_image(tmp_path / "pano.exr"), faces_to_equirect(cube.faces, 128), "resample"
    )


def openexr_directions(size):
    """Directions of OpenEXR's cube (ImfEnvmap.h): faces seen from inside, samples at pos / (size - 1)."""
    border = np.arange(size) / (size - 1)
    t, s = np.meshgrid(border, border, indexing="ij")
    sides = dict.fromkeys((0, 1, 4, 5), (1 - s, t))
    sides.update(dict.fromkeys((2, 3), (s, 1 - t)))
    return np.stack([face_uv_to_direction(face, *sides[face]) for face in range(6)])


def test_openexr_layout_samples_the_borders(tmp_path):
    """Each sample stores its direction: the first one lies on the edge, not half a texel inside."""
    cc.CubeMap(direction_pattern(64)).save(tmp_path / "a.exr", layout="openexr")
    stored = cc.load_image(tmp_path / "a.exr")
    assert stored.shape == (6 * 64, 64, 3)
    want = openexr_directions(64)
    want /= np.linalg.norm(want, axis=-1, keepdims=True)
    assert np.abs(stored.reshape(want.shape) - want).max() < 0.008  # half a texel is 0.011


def test_openexr_file_says_so_to_others(tmp_path):
    import OpenImageIO as oiio

    cc.CubeMap(direction_pattern(8)).save(tmp_path / "a.exr", layout="openexr")
    file = oiio.ImageInput.open(str(tmp_path / "a.exr"))
    assert file is not None
    assert file.spec().getattribute("textureformat") == "CubeFace Environment"
    file.close()


def test_openexr_cube_is_recognised_by_its_attribute_and_resampled(tmp_path):
    """Directions that were stored for samples on the borders are read back for the texel centres."""
    cc.CubeMap(direction_pattern(64)).save(tmp_path / "a.exr", layout="openexr")
    got = cc.load_cubemap(tmp_path / "a.exr")
    assert got.size == 64
    assert np.abs(got.faces - direction_pattern(64)).max() < 3e-3


def write_environment(path, pixels, kind):
    import OpenImageIO as oiio

    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], "float")
    spec.attribute("textureformat", kind)
    file = oiio.ImageOutput.create(str(path))
    assert file is not None
    assert file.open(str(path), spec)
    assert file.write_image(np.ascontiguousarray(pixels, np.float32))
    file.close()
    del file


def test_a_foreign_openexr_cube_is_read(tmp_path):
    n = 33
    directions = openexr_directions(n)
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    write_environment(tmp_path / "a.exr", directions.reshape(6 * n, n, 3), "CubeFace Environment")
    got = cc.load_cubemap(tmp_path / "a.exr")
    assert np.abs(got.faces - direction_pattern(got.size)).max() < 3e-3


def test_a_foreign_openexr_panorama_is_read_from_its_borders(tmp_path):
    """First to last sample: latitude +90 to -90 and longitude +180 to -180; longitude 0 is +Z and 90 is +X."""
    width, height = 129, 65
    longitude = np.pi - np.arange(width) / (width - 1) * 2 * np.pi
    latitude = np.pi / 2 - np.arange(height) / (height - 1) * np.pi
    latitude, longitude = np.meshgrid(latitude, longitude, indexing="ij")
    directions = np.stack(
        [
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
            np.cos(latitude) * np.cos(longitude),
        ],
        axis=-1,
    )
    write_environment(tmp_path / "a.exr", directions, "LatLong Environment")
    got = cc.load_environment(tmp_path / "a.exr", size=32)
    assert np.abs(got.faces - direction_pattern(32)).max() < 6e-3


def test_without_the_attribute_a_column_is_copied(tmp_path):
    pattern = direction_pattern(8)
    cc.save_image(tmp_path / "a.exr", to_layout(pattern, "column"))
    assert_identical(cc.load_cubemap(tmp_path / "a.exr").faces, pattern)


def test_environment_of_a_panorama_has_the_default_size():
    cube = cc.load_environment(cc.sample_data("studio.exr"))
    assert cube.size == 512
    assert cube.channels == 3
    assert cube.faces.max() > 100  # the bright lamps are not clipped


def test_environment_center_turns_the_picture():
    a = cc.load_environment(cc.sample_data("studio.exr"), size=32, center="-z")
    b = cc.load_environment(cc.sample_data("studio.exr"), size=32, center="+z")
    np.testing.assert_allclose(b.faces[4], a.faces[5], rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(b.faces[1], a.faces[0], rtol=1e-3, atol=1e-3)


def test_srgb_decodes_a_cross(tmp_path):
    cc.CubeMap(np.full((6, 4, 4, 3), 128, np.uint8)).save(tmp_path / "a.png", layout="cross")
    got = cc.load_cubemap(tmp_path / "a.png", srgb=True)
    assert got.dtype == np.float32
    np.testing.assert_allclose(got.faces, 0.2158605, atol=1e-5)


def test_mipmaps_on_loading(tmp_path):
    cc.CubeMap(face_pattern(8)).save(tmp_path / "a.png", layout="row")
    assert cc.load_cubemap(tmp_path / "a.png", mipmaps=True).mipmaps
    assert not cc.load_cubemap(tmp_path / "a.png").mipmaps


def test_unequal_files_are_refused_with_both_sizes(tmp_path):
    for index, path in enumerate(six(tmp_path)):
        cc.save_image(path, np.zeros((4 if index == 3 else 8,) * 2 + (3,), np.uint8))
    with pytest.raises(ValueError, match=r"8.*4|4.*8"):
        cc.load_cubemap(six(tmp_path))


def test_a_folder_and_a_single_face_point_to_six_names(tmp_path):
    with pytest.raises(IsADirectoryError, match=r"named with \{face\}, such as 'sky/\{face\}.png'"):
        cc.load_cubemap(tmp_path)
    cc.save_image(tmp_path / "px.png", np.zeros((4, 4, 3), np.uint8))
    with pytest.raises(
        ValueError, match=r"got a square of 4 x 4; six files are named with \{face\}"
    ):
        cc.load_environment(tmp_path / "px.png")


def test_files_that_are_not_square_are_refused(tmp_path):
    for path in six(tmp_path):
        cc.save_image(path, np.zeros((8, 9, 3), np.uint8))
    with pytest.raises(ValueError, match=r"8.*9|9.*8"):
        cc.load_cubemap(six(tmp_path))


@pytest.mark.parametrize("count", [0, 1, 5, 7])
def test_other_than_six_files_are_refused(count, tmp_path):
    for path in six(tmp_path):
        cc.save_image(path, np.zeros((8, 8, 3), np.uint8))
    paths = (six(tmp_path) * 2)[:count]
    with pytest.raises(ValueError, match=r"6|six"):
        cc.load_cubemap(paths)


def test_a_picture_of_no_known_shape_is_refused_with_its_shape(tmp_path):
    cc.save_image(tmp_path / "a.png", np.zeros((10, 13, 3), np.uint8))
    with pytest.raises(ValueError, match=r"10.*13|13.*10"):
        cc.load_cubemap(tmp_path / "a.png")


def test_six_files_are_written_by_the_first_names(tmp_path):
    faces = np.arange(6, dtype=np.uint8)[:, None, None, None] * np.ones((2, 2, 3), np.uint8)
    cc.CubeMap(faces).save(tmp_path / "sky {face}.png")
    for number, name in enumerate(["px", "nx", "py", "ny", "pz", "nz"]):
        assert (cc.load_image(tmp_path / f"sky {name}.png") == number).all()


def test_names_of_faces_go_with_the_order():
    assert FACE_NAMES == ("+x", "-x", "+y", "-y", "+z", "-z")


@pytest.mark.parametrize("options", [{"convention": "bogus"}, {"center": "bogus"}])
def test_unknown_names_are_refused_where_they_are_not_needed(tmp_path, options):
    cube = cc.CubeMap(face_pattern(4))
    with pytest.raises(ValueError, match="bogus"):
        cube.save(
            tmp_path / "a.png", layout="equirect" if "convention" in options else None, **options
        )
    with pytest.raises(ValueError, match="bogus"):
        cc.load_cubemap(cc.sample_data("sunset.exr"), **options)


def test_one_path_for_two_faces_is_refused(tmp_path):
    with pytest.raises(ValueError, match="six different paths"):
        cc.CubeMap(face_pattern(4)).save([tmp_path / "a.png"] * 6)
    assert not list(tmp_path.iterdir())
