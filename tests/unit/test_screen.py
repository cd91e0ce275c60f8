"""`to_screen` and what is written to files: the same light gives the same 8-bit numbers everywhere."""

import io
import warnings

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.reference.tone import TONE_CURVES, srgb_decode, srgb_encode

FLOATS = (10.0 ** np.random.default_rng(3).uniform(-3, 2, (6, 8, 8, 3))).astype(np.float32)
BYTES = np.random.default_rng(4).integers(0, 256, (6, 8, 8, 3)).astype(np.uint8)


def rounded(values):
    return np.floor(np.clip(values, 0, 1) * 255 + 0.5)


def shown(linear, exposure=0.0, tonemap="neutral"):
    """What a screen shows of linear floats, from the specifications."""
    light = np.maximum(linear.astype(float), 0) * 2.0**exposure
    light = TONE_CURVES[tonemap](light) if tonemap else np.clip(light, 0, 1)
    return rounded(srgb_encode(light))


def assert_near(got, want):
    """Equal but for a rounding of .5, which float32 may decide in another way than float64."""
    assert got.dtype == np.uint8
    difference = np.abs(got.astype(int) - want)
    assert difference.max() <= 1
    assert (difference > 0).mean() < 0.01


@pytest.mark.parametrize("tonemap", ["neutral", "reinhard", "aces"])
@pytest.mark.parametrize("exposure", [-3.5, 0, 2])
@pytest.mark.parametrize("dtype", ["float16", "float32", "float64"])
def test_floats_are_exposed_mapped_and_encoded(tonemap, exposure, dtype):
    values = FLOATS.astype(dtype)
    assert_near(
        cc.to_screen(values, exposure=exposure, tonemap=tonemap), shown(values, exposure, tonemap)
    )


def test_the_default_is_neutral_and_srgb():
    assert_identical(
        cc.to_screen(FLOATS), cc.to_screen(FLOATS, exposure=0, tonemap="neutral", encode="srgb")
    )


def test_without_encoding_light_stays_linear():
    low = FLOATS / FLOATS.max()
    assert_near(cc.to_screen(low, tonemap=None, encode=None), rounded(low))
    assert_near(cc.to_screen(BYTES, encode=None), rounded(srgb_decode(BYTES / 255)))


def test_bytes_are_what_a_screen_shows():
    got = cc.to_screen(BYTES)
    assert_identical(got, BYTES)
    assert not np.shares_memory(got, BYTES)


def test_bytes_are_exposed_in_linear_light_and_never_mapped():
    want = rounded(srgb_encode(np.clip(srgb_decode(BYTES / 255) / 4, 0, 1)))
    assert_near(cc.to_screen(BYTES, exposure=-2), want)


def test_alpha_is_kept_and_grey_is_a_channel():
    values = np.full((2, 3, 4), 0.25, np.float32)
    values[..., 3] = 0.5
    got = cc.to_screen(values, exposure=1)
    assert (got[..., 3] == 128).all()
    assert_near(got[..., :3], shown(values[..., :3], 1))
    grey = np.array([[0.1, 0.5, 5.0]], np.float32)
    assert_identical(cc.to_screen(grey), cc.to_screen(np.repeat(grey[..., None], 3, 2))[..., 0])


def test_what_is_no_number_is_black_and_infinite_light_is_white():
    values = np.array(
        [[[np.nan, 0.5, 0.25]], [[np.inf, np.inf, np.inf]], [[-np.inf, -1, 0]]], np.float32
    )
    got = cc.to_screen(values)
    assert_identical(got[0, 0], cc.to_screen(np.array([[[0, 0.5, 0.25]]], np.float32))[0, 0])
    assert (got[1] == 255).all()
    assert (got[2] == 0).all()


@pytest.mark.parametrize(
    ("given", "options", "error", "message"),
    [
        (np.zeros((2, 2, 3), bool), {}, TypeError, "picture: expected floats, uint8 or uint16"),
        (np.zeros((2, 2, 3), np.int32), {}, TypeError, "got dtype int32"),
        ("picture.png", {}, TypeError, "expected floats"),
        (np.zeros((2, 2, 2)), {}, ValueError, "1, 3 or 4 channels"),
        (np.zeros((0, 2, 3)), {}, ValueError, "picture: expected shape"),
        (
            FLOATS,
            {"tonemap": "filmic"},
            ValueError,
            'tonemap: expected "neutral", "reinhard", "aces"',
        ),
        (FLOATS, {"tonemap": []}, TypeError, 'tonemap: expected "reinhard"'),
        (FLOATS, {"encode": "rec709"}, ValueError, 'encode: expected "srgb" or None'),
        (FLOATS, {"exposure": np.nan}, ValueError, "exposure: expected -64 to 64"),
        (FLOATS, {"exposure": 65}, ValueError, "exposure: expected -64 to 64"),
        (FLOATS, {"exposure": "2"}, TypeError, "exposure: expected float, got '2'"),
    ],
)
def test_bad_arguments(given, options, error, message):
    with pytest.raises(error, match=message):
        cc.to_screen(given, **options)


def test_clipping_warns_once_at_the_line_of_the_user():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        got = cc.to_screen(FLOATS, tonemap=None)
    assert [w.category for w in caught] == [cc.ClippingWarning]
    assert caught[0].filename == __file__
    assert f"{int((FLOATS > 1 + 0.5 / 255).sum())} of {FLOATS.size}" in str(caught[0].message)
    assert_near(got, shown(FLOATS, tonemap=None))


def clippings(call):
    """The messages of the clipping warnings of a call; all of them are at a line of this file."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    assert {(w.category, w.filename) for w in caught} <= {(cc.ClippingWarning, __file__)}
    return [str(w.message) for w in caught]


OVER = f"{int((FLOATS > 1 + 0.5 / 255).sum())} of {FLOATS.size} numbers"


@pytest.mark.parametrize("name", ["a.png", "a.jpg", "{face}.png"])
def test_a_cube_warns_once_and_counts_its_own_numbers(name, tmp_path):
    (message,) = clippings(lambda: cc.CubeMap(FLOATS).save(tmp_path / name, tonemap=None))
    assert message.startswith(OVER)
    assert f"the largest is {FLOATS.max():.4g}" in message
    assert clippings(lambda: cc.CubeMap(FLOATS).save(tmp_path / name)) == []


@pytest.mark.parametrize("objects", [True, False])
def test_an_animation_warns_once(objects, tmp_path):
    frames = [cc.Image(face) if objects else face for face in FLOATS]
    (message,) = clippings(lambda: cc.save_animation(tmp_path / "a.png", frames, tonemap=None))
    assert message.startswith(OVER)


def test_calls_inside_an_animation_warn_for_themselves(tmp_path):
    frames = (cc.to_screen(face, tonemap=None) for face in FLOATS[:2])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        cc.save_animation(tmp_path / "a.png", frames)
    assert [w.filename for w in caught] == [__file__] * 2


def test_a_warning_names_the_curve_only_where_it_helps():
    for picture, exposure, helps in (
        (FLOATS, 0, True),
        (BYTES, 1, False),
        (cc.Image(FLOATS[0], encoding="srgb"), 0, False),
        (cc.CubeMap(BYTES, encoding="linear"), 2, False),
    ):
        (message,) = clippings(
            lambda p=picture, e=exposure: cc.to_screen(p, exposure=e, tonemap=None)
        )
        assert ('tonemap="neutral"' in message) == helps
        assert "a lower exposure= makes the picture darker" in message


def test_raw_numbers_have_no_look_to_advise(tmp_path):
    cube = cc.CubeMap(FLOATS)
    (message,) = clippings(lambda: cube.save(tmp_path / "a.png", layout="column", srgb=False))
    assert message.startswith(OVER)
    assert message.endswith("; .exr holds all numbers")


@pytest.mark.parametrize("tonemap", ["neutral", "reinhard", "aces"])
@pytest.mark.parametrize("light", [3e38, np.inf])
def test_the_largest_light_is_white(light, tonemap, tmp_path):
    values = np.full((2, 2, 3), light, np.float32)
    assert clippings(lambda: cc.to_screen(values, exposure=64, tonemap=tonemap)) == []
    assert (cc.to_screen(values, exposure=64, tonemap=tonemap) == 255).all()
    cc.save_image(tmp_path / "a.png", values, tonemap=tonemap, exposure=64)
    assert (cc.load_image(tmp_path / "a.png") == 255).all()
    cc.save_image(tmp_path / "a.exr", cc.Image(np.minimum(values, 3e38)), exposure=64)
    assert (cc.load_image(tmp_path / "a.exr") == np.inf).all()


def test_a_curve_that_ends_above_1_clips_nothing(tmp_path):
    bright = np.full((2, 2, 3), 1e4, np.float32)  # Narkowicz's fit gives 1.03
    assert clippings(lambda: cc.save_image(tmp_path / "a.png", bright, tonemap="aces")) == []
    assert (cc.load_image(tmp_path / "a.png") == 255).all()


def test_numbers_that_fit_do_not_warn(tmp_path):
    cc.to_screen(np.clip(FLOATS, 0, 1), tonemap=None)
    cc.save_image(tmp_path / "a.png", np.array([[0, 1.0005]], np.float32))
    assert cc.load_image(tmp_path / "a.png").max() == 255


# Encodings


def test_the_encoding_of_arrays_follows_from_the_type():
    assert cc.CubeMap(BYTES).encoding == "srgb"
    assert cc.CubeMap(FLOATS).encoding == "linear"
    assert cc.CubeMap(BYTES, encoding="linear").encoding == "linear"
    assert cc.Image(BYTES[0]).encoding == "srgb"
    assert cc.Image(FLOATS[0].astype(np.float16)).encoding == "linear"
    assert cc.Image(FLOATS[0], encoding="srgb").encoding == "srgb"
    assert cc.CubeMap.from_equirect(BYTES[0, :4], dtype="float32").encoding == "srgb"
    row = np.concatenate(list(BYTES), axis=1)
    assert cc.CubeMap.from_layout(row).encoding == "srgb"
    assert cc.CubeMap.from_layout(row, encoding="linear").encoding == "linear"


def test_objects_hand_their_encoding_on():
    cube = cc.CubeMap(BYTES, encoding="linear")
    assert cube.resize(4).encoding == cube.copy().encoding == "linear"
    assert cc.CubeMap(cube).encoding == "linear"
    assert cc.Image(cc.Image(BYTES[0], encoding="linear")).encoding == "linear"
    assert cube != cc.CubeMap(BYTES)


def test_an_array_class_with_an_encoding_of_its_own_is_an_array():
    class Text(np.ndarray):
        encoding = "utf-8"

    assert cc.CubeMap(FLOATS.view(Text)).encoding == "linear"
    assert cc.Image(BYTES[0].view(Text)).encoding == "srgb"


@pytest.mark.parametrize("make", [cc.CubeMap, lambda x, **o: cc.Image(x[0], **o)])
def test_an_unknown_encoding(make):
    with pytest.raises(ValueError, match='encoding: expected "linear", "srgb", got "gamma"'):
        make(BYTES, encoding="gamma")


@pytest.mark.parametrize("name", ["a.png", "a.bmp", "a.tif"])
def test_files_of_whole_numbers_are_srgb(name, tmp_path):
    row = np.concatenate(list(BYTES), axis=1)
    cc.save_image(tmp_path / name, row)
    assert cc.load_cubemap(tmp_path / name).encoding == "srgb"
    decoded = cc.load_cubemap(tmp_path / name, srgb=True)
    assert decoded.encoding == "linear"
    assert decoded.dtype == np.float32


def test_16_bits_are_srgb_too_and_floats_are_linear(tmp_path):
    row = np.concatenate(list(BYTES), axis=1)
    cc.save_image(tmp_path / "a.png", row.astype(np.uint16) * 257)
    assert cc.load_cubemap(tmp_path / "a.png").encoding == "srgb"
    for name in ("a.exr", "a.hdr"):
        cc.save_image(tmp_path / name, np.concatenate(list(FLOATS), axis=1))
        assert cc.load_cubemap(tmp_path / name).encoding == "linear"


def test_six_files(tmp_path):
    cc.CubeMap(BYTES).save(tmp_path / "{face}.png")
    assert cc.load_cubemap(tmp_path / "{face}.png").encoding == "srgb"
    assert cc.load_cubemap(tmp_path / "{face}.png", srgb=True).encoding == "linear"


# Files


def column(faces):
    return np.concatenate(list(faces))


@pytest.mark.parametrize("tonemap", ["neutral", "aces"])
def test_a_linear_cube_in_8_bits(tonemap, tmp_path):
    cube = cc.CubeMap(FLOATS)
    cube.save(tmp_path / "a.png", layout="column", tonemap=tonemap, exposure=-1)
    got = cc.load_image(tmp_path / "a.png")
    assert_identical(got, cc.to_screen(column(FLOATS), tonemap=tonemap, exposure=-1))
    assert_near(got, shown(column(FLOATS), -1, tonemap))


def test_six_faces_look_like_one_picture(tmp_path):
    cube = cc.CubeMap(FLOATS)
    cube.save(tmp_path / "{face}.png")
    assert_identical(cc.load_cubemap(tmp_path / "{face}.png").faces, cc.to_screen(cube))


def test_save_image_of_a_cube_is_its_cross(tmp_path):
    cube = cc.CubeMap(FLOATS)
    cube.save(tmp_path / "a.png", exposure=1)
    cc.save_image(tmp_path / "b.png", cube, exposure=1)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_cube_of_bytes_is_written_as_it_is(tmp_path):
    cc.CubeMap(BYTES).save(tmp_path / "a.png", layout="column")
    assert_identical(cc.load_image(tmp_path / "a.png"), column(BYTES))


def test_linear_bytes_are_encoded_without_a_curve(tmp_path):
    cc.CubeMap(BYTES, encoding="linear").save(tmp_path / "a.png", layout="column")
    assert_near(cc.load_image(tmp_path / "a.png"), rounded(srgb_encode(column(BYTES) / 255)))


def test_files_of_floats_hold_light(tmp_path):
    cc.CubeMap(BYTES).save(tmp_path / "a.exr", layout="column")
    np.testing.assert_allclose(
        cc.load_image(tmp_path / "a.exr"), srgb_decode(column(BYTES) / 255), atol=3e-4
    )
    cc.CubeMap(FLOATS).save(tmp_path / "b.exr", layout="column")
    assert_identical(cc.load_image(tmp_path / "b.exr"), column(FLOATS))
    cc.CubeMap(FLOATS).save(tmp_path / "c.exr", layout="column", exposure=3)
    assert_identical(cc.load_image(tmp_path / "c.exr"), column(FLOATS) * 8)


def test_a_tiff_of_bytes_is_srgb_and_one_of_floats_is_linear(tmp_path):
    linear = cc.CubeMap(BYTES, encoding="linear")
    linear.save(tmp_path / "a.tif", layout="column")
    assert_near(cc.load_image(tmp_path / "a.tif"), rounded(srgb_encode(column(BYTES) / 255)))
    linear.save(tmp_path / "b.tif", layout="equirect")
    panorama = linear.to_equirect(dtype="float32")
    assert_near(cc.load_image(tmp_path / "b.tif"), rounded(srgb_encode(panorama)))
    cc.CubeMap(FLOATS).save(tmp_path / "c.tif", layout="column")
    assert_identical(cc.load_image(tmp_path / "c.tif"), column(FLOATS))


def test_srgb_false_writes_the_numbers(tmp_path):
    low = FLOATS / FLOATS.max()
    cc.CubeMap(low).save(tmp_path / "a.png", layout="column", srgb=False)
    assert_near(cc.load_image(tmp_path / "a.png"), rounded(column(low)))
    cc.CubeMap(BYTES).save(tmp_path / "a.exr", layout="column", srgb=False)
    np.testing.assert_allclose(cc.load_image(tmp_path / "a.exr"), column(BYTES) / 255, atol=3e-4)
    with pytest.raises(ValueError, match="exposure: expected 0 with srgb=False"):
        cc.CubeMap(low).save(tmp_path / "a.png", srgb=False, exposure=1)


def test_a_panorama_of_light_is_filtered_before_the_curve(tmp_path):
    cube = cc.CubeMap(FLOATS)
    cube.save(tmp_path / "a.png", layout="equirect", width=16)
    want = cc.to_screen(cube.to_equirect(width=16))
    assert_identical(cc.load_image(tmp_path / "a.png"), want)


def test_a_cube_that_clips_warns(tmp_path):
    with pytest.warns(cc.ClippingWarning):
        cc.CubeMap(FLOATS).save(tmp_path / "a.png", layout="column", tonemap=None)
    assert_near(cc.load_image(tmp_path / "a.png"), shown(column(FLOATS), tonemap=None))


def test_arrays_are_written_as_they_are_unless_a_look_is_named(tmp_path):
    low = FLOATS[0] / FLOATS.max()
    cc.save_image(tmp_path / "a.png", low)
    assert_near(cc.load_image(tmp_path / "a.png"), rounded(low))
    cc.save_image(tmp_path / "b.png", FLOATS[0], tonemap="reinhard", exposure=1, srgb=True)
    assert_near(cc.load_image(tmp_path / "b.png"), shown(FLOATS[0], 1, "reinhard"))
    cc.save_image(tmp_path / "c.exr", FLOATS[0], exposure=-2)
    assert_identical(cc.load_image(tmp_path / "c.exr"), FLOATS[0] / 4)
    with pytest.raises(ValueError, match="tonemap: expected"):
        cc.save_image(tmp_path / "d.png", FLOATS[0], tonemap="filmic")  # type: ignore[arg-type]


def test_a_curve_of_an_array_maps_what_to_screen_maps(tmp_path):
    cc.save_image(tmp_path / "a.png", BYTES[0], tonemap="neutral")
    assert_identical(cc.load_image(tmp_path / "a.png"), BYTES[0])
    cc.save_image(tmp_path / "a.exr", FLOATS[0], tonemap="neutral")
    assert_identical(cc.load_image(tmp_path / "a.exr"), FLOATS[0])
    holes = FLOATS[0].copy()
    holes[2, 1, 0] = np.nan
    with pytest.raises(
        ValueError, match=r"cannot hold NaN, got 1 of them, the first at \(2, 1, 0\)"
    ):
        cc.save_image(tmp_path / "b.png", holes, tonemap="neutral")


@pytest.mark.parametrize("picture", [FLOATS[0], cc.Image(FLOATS[0]), cc.CubeMap(FLOATS)])
@pytest.mark.parametrize("srgb", ["no", 1, "srgb"])
def test_srgb_is_a_bool(picture, srgb, tmp_path):
    with pytest.raises(TypeError, match="srgb: expected bool or None, got"):
        cc.save_image(tmp_path / "a.png", picture, srgb=srgb)


@pytest.mark.parametrize("options", [{"exposure": 1}, {"tonemap": "aces"}])
def test_ids_have_no_look(options, tmp_path):
    with pytest.raises(ValueError, match="exposure, tonemap: expected colours, got int32 numbers"):
        cc.save_image(tmp_path / "a.png", BYTES[0].astype(np.int32), **options)


@pytest.mark.parametrize("name", ["a.gif", "a.apng", "a.webp"])
def test_every_kind_of_animation_takes_objects(name, tmp_path):
    from PIL import Image as Picture

    cc.save_animation(tmp_path / name, [cc.Image(face) for face in FLOATS[:2]])
    with Picture.open(tmp_path / name) as animation:
        got = np.asarray(animation.convert("RGB"))
    # A GIF has 256 colours for 64 pixels.
    assert_identical(got, cc.to_screen(FLOATS[0]))


def test_animations_show_objects_as_files_do(tmp_path):
    from PIL import Image as Picture

    images = [cc.Image(face) for face in FLOATS[:2]]
    cc.save_animation(tmp_path / "a.png", images, exposure=-1)
    with Picture.open(tmp_path / "a.png") as animation:
        for index, face in enumerate(FLOATS[:2]):
            animation.seek(index)
            assert_identical(np.asarray(animation.convert("RGB")), cc.to_screen(face, exposure=-1))


def test_a_notebook_shows_what_a_file_holds(tmp_path):
    from PIL import Image as Picture

    image = cc.Image(FLOATS[0])
    cc.save_image(tmp_path / "a.png", image)
    assert image._repr_png_() == (tmp_path / "a.png").read_bytes()
    cross = cc.to_screen(cc.CubeMap(FLOATS).to_layout("cross", convention="inside"))
    with Picture.open(io.BytesIO(cc.CubeMap(FLOATS)._repr_png_())) as picture:
        got = np.asarray(picture)
    covered = got[..., 3] == 255
    assert covered.sum() == 6 * 64
    assert_identical(got[covered][:, :3], cross[covered])
