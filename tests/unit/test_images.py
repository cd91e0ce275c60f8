"""load_image and save_image: numbers stored as they are, safely."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.reference.tone import srgb_decode, srgb_encode


@pytest.fixture
def colors(rng):
    return rng.integers(0, 256, (5, 7, 3), dtype=np.uint8)


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_png_of_8_bits_is_exact(channels, tmp_path, rng):
    pixels = rng.integers(0, 256, (5, 7, channels), dtype=np.uint8)
    cc.save_image(tmp_path / "a.png", pixels)
    assert_identical(cc.load_image(tmp_path / "a.png"), pixels)


def test_color_under_alpha_0_survives_a_png(tmp_path):
    """Without oiio:UnassociatedAlpha, the colour would be read back multiplied by alpha."""
    pixels = np.full((2, 2, 4), (200, 100, 50, 0), np.uint8)
    pixels[0, 0, 3] = 7
    cc.save_image(tmp_path / "a.png", pixels)
    assert_identical(cc.load_image(tmp_path / "a.png"), pixels)


def test_png_of_16_bits_is_value_by_65535(tmp_path, rng):
    pixels = rng.integers(0, 65536, (5, 7, 3), dtype=np.uint16)
    cc.save_image(tmp_path / "a.png", pixels)
    got = cc.load_image(tmp_path / "a.png")
    assert got.dtype == np.float32
    np.testing.assert_array_equal(np.rint(got * 65535), pixels)


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("dtype", [np.float16, np.float32])
def test_exr_keeps_half_and_float_bit_for_bit(dtype, channels, tmp_path, rng):
    pixels = (rng.normal(size=(5, 7, channels)) * 1000).astype(dtype)
    cc.save_image(tmp_path / "a.exr", pixels)
    assert_identical(cc.load_image(tmp_path / "a.exr"), pixels)


def test_exr_keeps_infinity_and_nan(tmp_path):
    pixels = np.array([[[np.inf], [-np.inf], [np.nan], [1e30]]], np.float32)
    cc.save_image(tmp_path / "a.exr", pixels)
    np.testing.assert_array_equal(cc.load_image(tmp_path / "a.exr"), pixels)


def test_exr_half_on_request(tmp_path, rng):
    pixels = rng.random((4, 4, 3)).astype(np.float32)
    cc.save_image(tmp_path / "a.exr", pixels, half=True)
    assert_identical(cc.load_image(tmp_path / "a.exr"), pixels.astype(np.float16))


def test_hdr_keeps_what_rgbe_keeps(tmp_path, rng):
    """RGBE has one exponent for a pixel and 8 bits a channel: the error is up to 1/128 of the largest channel."""
    pixels = (rng.random((9, 17, 3)) * 10.0 ** rng.integers(-3, 4, (9, 17, 1))).astype(np.float32)
    cc.save_image(tmp_path / "a.hdr", pixels)
    got = cc.load_image(tmp_path / "a.hdr")
    assert got.dtype == np.float32
    assert (np.abs(got - pixels) <= pixels.max(-1, keepdims=True) / 127).all()


def test_jpeg_is_near(tmp_path):
    ramp = np.linspace(0, 255, 64)
    pixels = np.stack(np.broadcast_arrays(ramp[:, None], ramp[None], 128.0), axis=-1).astype(
        np.uint8
    )
    cc.save_image(tmp_path / "a.jpg", pixels)
    got = cc.load_image(tmp_path / "a.jpg")
    assert got.shape == pixels.shape
    assert np.abs(got.astype(int) - pixels).mean() < 2


def test_row_0_is_on_top(tmp_path):
    """Another library checks it: Pillow counts rows from the top too."""
    from PIL import Image as Picture

    pixels = np.zeros((4, 6, 3), np.uint8)
    pixels[0] = 255
    cc.save_image(tmp_path / "a.png", pixels)
    with Picture.open(tmp_path / "a.png") as picture:
        assert_identical(np.asarray(picture), pixels)


def test_srgb_decodes_and_encodes_8_bits(tmp_path, colors):
    cc.save_image(tmp_path / "a.png", colors)
    linear = cc.load_image(tmp_path / "a.png", srgb=True)
    assert linear.dtype == np.float32
    assert_close(linear, srgb_decode(colors / 255), "float32_maths")
    cc.save_image(tmp_path / "b.png", linear, srgb=True)
    assert_identical(cc.load_image(tmp_path / "b.png"), colors)


def test_srgb_leaves_alpha_alone(tmp_path):
    pixels = np.full((2, 2, 4), 128, np.uint8)
    cc.save_image(tmp_path / "a.png", pixels)
    linear = cc.load_image(tmp_path / "a.png", srgb=True)
    np.testing.assert_allclose(linear[..., 3], 128 / 255, atol=1e-6)
    assert linear[0, 0, 0] < 0.22
    cc.save_image(tmp_path / "b.png", linear, srgb=True)
    assert_identical(cc.load_image(tmp_path / "b.png"), pixels)


def test_srgb_does_not_touch_floating_point_files(tmp_path):
    pixels = np.full((2, 2, 3), 0.25, np.float32)
    cc.save_image(tmp_path / "a.exr", pixels, srgb=True)
    assert_identical(cc.load_image(tmp_path / "a.exr", srgb=True), pixels)


def test_floats_are_clipped_and_rounded_into_8_bits(tmp_path):
    values = np.array([[[-1.0, 0.501, 2.0], [0.1, 1.0, 0.703]]])
    with pytest.warns(cc.ClippingWarning, match="1 of 6 numbers are above 1"):
        cc.save_image(tmp_path / "a.png", values)
    want = np.rint(np.clip(values, 0, 1) * 255)
    assert np.abs(cc.load_image(tmp_path / "a.png") - want).max() <= 0.5
    with pytest.warns(cc.ClippingWarning):
        cc.save_image(tmp_path / "b.png", values, srgb=True)
    want = np.rint(srgb_encode(values) * 255)
    assert np.abs(cc.load_image(tmp_path / "b.png") - want).max() <= 0.5


def test_a_matrix_is_a_grey_picture(tmp_path):
    cc.save_image(tmp_path / "a.exr", np.eye(3, dtype=np.float32))
    assert_identical(cc.load_image(tmp_path / "a.exr"), np.eye(3, dtype=np.float32)[..., None])


def test_what_is_loaded_is_yours(tmp_path, colors):
    cc.save_image(tmp_path / "a.png", colors)
    image = cc.load_image(tmp_path / "a.png")
    image[:] = 0
    assert_identical(cc.load_image(tmp_path / "a.png"), colors)


@pytest.mark.parametrize(
    ("pixels", "error"),
    [
        (np.zeros((3, 3, 2), np.uint8), ValueError),
        (np.zeros(3), ValueError),
        (np.zeros((0, 3, 3)), ValueError),
        (np.zeros((3, 3, 3), bool), TypeError),
        (np.zeros((3, 3, 3), complex), TypeError),
        (np.full((3, 3, 3), np.nan), ValueError),
    ],
)
def test_bad_pictures_are_refused_and_nothing_is_written(pixels, error, tmp_path):
    with pytest.raises(error):
        cc.save_image(tmp_path / "a.png", pixels)
    assert not list(tmp_path.iterdir())


def test_alpha_is_not_lost_silently(tmp_path):
    with pytest.raises(ValueError, match="alpha"):
        cc.save_image(tmp_path / "a.jpg", np.full((2, 2, 4), 128, np.uint8))
    cc.save_image(tmp_path / "b.jpg", np.full((2, 2, 4), 255, np.uint8))


@pytest.mark.parametrize("name", ["a.xyz", "a", "a.txt"])
def test_unknown_endings_are_refused_naming_those_there_are(name, tmp_path):
    with pytest.raises(ValueError, match=r"\.exr"):
        cc.save_image(tmp_path / name, np.zeros((2, 2, 3), np.uint8))


@pytest.mark.parametrize("ending", [".png", ".gif"])
def test_animations_hold_their_frames(ending, tmp_path):
    from PIL import Image as Picture

    frames = [np.full((8, 12, 3), level, np.uint8) for level in (0, 100, 250)]
    cc.save_animation(tmp_path / f"a{ending}", frames, fps=10)
    with Picture.open(tmp_path / f"a{ending}") as film:
        assert film.n_frames == 3
        assert film.size == (12, 8)
        for index, level in enumerate((0, 100, 250)):
            film.seek(index)
            assert abs(np.asarray(film.convert("RGB")).astype(int) - level).max() <= 3
            assert film.info["duration"] == pytest.approx(100)


def test_a_gif_has_no_bands(tmp_path):
    """Neighbouring pixels of a GIF mix the colours that its palette lacks, so that means of 8 x 8 pixels are right."""
    from PIL import Image as Picture

    x, y = np.meshgrid(np.linspace(0, 1, 128), np.linspace(0, 1, 128))
    sky = np.rint(np.stack([90 + 90 * x, 120 + 80 * y, 250 - 60 * x * y], axis=-1)).astype(np.uint8)
    cc.save_animation(tmp_path / "a.gif", [sky, sky[::-1]], fps=10)

    def means(picture):
        return picture.astype(float).reshape(16, 8, 16, 8, 3).mean(axis=(1, 3))

    with Picture.open(tmp_path / "a.gif") as film:
        for index, frame in enumerate((sky, sky[::-1])):
            film.seek(index)
            got = np.asarray(film.convert("RGB"))
            assert np.abs(means(got) - means(frame)).max() < 1.5
            assert np.abs(got.astype(int) - frame).max() < 24


@pytest.mark.parametrize(
    ("frames", "fps"),
    [([], 10), ([np.zeros((2, 2, 3)), np.zeros((3, 2, 3))], 10), ([np.zeros((2, 2, 3))], 0)],
    ids=["none", "unequal", "fps"],
)
def test_bad_animations_are_refused(frames, fps, tmp_path):
    with pytest.raises(ValueError, match=r"frame|fps"):
        cc.save_animation(tmp_path / "a.gif", frames, fps=fps)
    assert not list(tmp_path.iterdir())
