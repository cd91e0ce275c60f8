"""error_map: the numbers, the mark of the largest one, what has no error."""

import re

import numpy as np
import pytest
from matplotlib.colors import LogNorm, to_rgba

import cubecam as cc
from tests.helpers import conventions
from tests.plot.artists import array_of, mapped_colors, xdata, ydata
from tests.reference import cube_faces
from tests.reference.pattern import random_faces

SIZE = 8


def image_of(ax):
    return array_of(ax.get_images()[0])


@conventions
@pytest.mark.parametrize("over", ["max", "rms"])
def test_errors_of_cubes_are_numpys_and_lie_as_the_cross_does(rng, convention, over):
    a, b = (random_faces(rng, SIZE, 3) for _ in range(2))
    ax = cc.plot.error_map(cc.CubeMap(a), cc.CubeMap(b), over=over, convention=convention)
    apart = np.abs(a.astype(float) - b)
    expected = apart.max(axis=-1) if over == "max" else np.sqrt((apart**2).mean(axis=-1))
    shown = image_of(ax)
    laid_out = cube_faces.to_layout(expected, "cross", convention)
    covered = cube_faces.to_layout(np.ones((6, SIZE, SIZE), bool), "cross", convention)
    np.testing.assert_allclose(np.asarray(shown)[covered], laid_out[covered])
    assert (ax.get_images()[0].get_alpha() == covered).all()
    face, row, column = np.unravel_index(expected.argmax(), expected.shape)
    name = cube_faces.FACE_NAMES[face].upper()
    mean, rms = expected.mean(), np.sqrt((expected**2).mean())
    assert ax.get_title() == (
        f"mean {mean:.3g}, rms {rms:.3g}, max {expected.max():.3g} at {name}, row {row}, column {column}"
    )
    (mark,) = (line for line in ax.lines if line.get_marker() == "o")
    (x,), (y,) = xdata(mark), ydata(mark)
    assert laid_out[y, x] == expected.max()


def test_uint8_counts_as_a_share_of_255():
    a, b = np.zeros((4, 6, 3), np.uint8), np.zeros((4, 6, 3), np.float32)
    a[2, 5] = 51
    ax = cc.plot.error_map(a, b)
    np.testing.assert_allclose(image_of(ax)[2, 5], 0.2)
    assert "max 0.2 at row 2, column 5" in ax.get_title()


def test_frames_are_compared_by_colour(renderer):
    scene = cc.Scene(background=(0.2, 0.4, 0.6))
    camera = cc.PerspectiveCamera()
    a = renderer.render(scene, camera, (12, 8), format="rgba32f")
    scene.background = (0.2, 0.4, 0.7)
    b = renderer.render(scene, camera, (12, 8), format="rgba32f")
    ax = cc.plot.error_map(a, b)
    assert image_of(ax).shape == (8, 12)
    np.testing.assert_allclose(image_of(ax), 0.1, rtol=1e-5)


def test_light_is_not_compared_with_encoded_numbers():
    numbers = np.zeros((6, 2, 2, 3), np.uint8)
    a, b = (cc.CubeMap(numbers, encoding=encoding) for encoding in ("linear", "srgb"))
    with pytest.raises(ValueError, match="two pictures of one encoding, got linear and srgb"):
        cc.plot.error_map(a, b)
    assert cc.plot.error_map(a, b.faces).get_title() == "no difference"


def test_what_has_no_error_is_grey_and_counted():
    a = np.zeros((3, 4))
    b = np.full((3, 4), 0.5)
    a[0, 0] = np.nan
    b[1, 1] = np.inf
    a[2, 2] = b[2, 2] = np.inf
    ax = cc.plot.error_map(a, b)
    assert ax.get_title().endswith("\n2 of 12 pixels without an error (grey)")
    assert ax.get_title().startswith("mean 0.45, rms 0.474, max 0.5 at row 0, column 1")
    (image,) = ax.get_images()
    colors = mapped_colors(image, np.ma.masked_invalid(image_of(ax)))
    for place in ((0, 0), (1, 1)):
        np.testing.assert_allclose(colors[place], to_rgba("0.82"))
    np.testing.assert_allclose(colors[2, 2], image.cmap(0.0))


def test_a_logarithmic_scale_shows_zero_as_its_lowest_colour():
    a, b = np.zeros((2, 5)), np.zeros((2, 5))
    b[0] = [0, 1e-9, 1e-3, 1e-1, 1]
    (image,) = cc.plot.error_map(a, b, scale="log").get_images()
    assert isinstance(image.norm, LogNorm)
    assert image.get_clim() == pytest.approx((1e-6, 1))
    colors = mapped_colors(image)[0]
    np.testing.assert_allclose(colors[0], image.cmap(0.0))
    np.testing.assert_allclose(colors[1], image.cmap(0.0))
    assert np.linalg.norm(colors[2] - colors[1]) > 0.1


def test_limits_of_the_colours_can_be_set():
    a, b = np.zeros((2, 2)), np.ones((2, 2))
    ax = cc.plot.error_map(a, b, vmin=0.5, vmax=2, cmap="viridis")
    assert ax.get_images()[0].get_clim() == (0.5, 2)
    assert ax.get_images()[0].cmap.name == "viridis"
    assert len(ax.figure.axes) == 2  # the picture and its colour bar


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_equal_pictures_have_no_mark(scale):
    picture = np.random.default_rng(0).random((4, 4, 3))
    ax = cc.plot.error_map(picture, picture, scale=scale)
    assert ax.get_title() == "no difference"
    assert not ax.lines[:]
    ax.figure.canvas.draw()


def test_colours_are_of_a_map_whose_lightness_grows():
    """magma is perceptually uniform: the greater the error, the brighter the pixel."""
    (image,) = cc.plot.error_map(np.zeros((1, 32)), np.linspace(0, 1, 32)[None]).get_images()
    colors = mapped_colors(image)[0, :, :3]
    assert (np.diff(colors @ [0.2126, 0.7152, 0.0722]) > 0).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda a: cc.plot.error_map(a, a[:2]), "expected two pictures of one shape, got"),
        (lambda a: cc.plot.error_map(a[0], a[0]), "expected (H, W), (H, W, C)"),
        (lambda a: cc.plot.error_map(a, a, over="mean"), 'over: expected "max" or "rms"'),  # type: ignore[arg-type]
        (lambda a: cc.plot.error_map(a, a, scale="dB"), 'scale: expected "linear" or "log"'),  # type: ignore[arg-type]
        (lambda a: cc.plot.error_map(a, a, convention="up"), "convention: expected"),  # type: ignore[arg-type]
    ],
)
def test_wrong_input(call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call(np.zeros((3, 5)))
