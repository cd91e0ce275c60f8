"""Formats and dtypes; tone curves and the sRGB curve against numpy."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import perspective, smooth_environment
from tests.reference import shading

FORMATS = {"rgba8": np.uint8, "rgba16f": np.float16, "rgba32f": np.float32}
formats = pytest.mark.parametrize(("fmt", "dtype"), FORMATS.items(), ids=FORMATS)


@formats
def test_dtype_follows_the_format(renderer, fmt, dtype):
    scene = cc.Scene(background=(0.25, 0.5, 1, 1))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    frame = renderer.render(scene, camera, (4, 4), format=fmt).color
    cube = renderer.capture(scene, size=4, format=fmt)
    assert frame.dtype == cube.faces.dtype == cube.dtype == dtype
    want = [0.25, 0.5, 1, 1] if dtype != np.uint8 else [64, 128, 255, 255]
    np.testing.assert_array_equal(frame[0, 0], want)
    np.testing.assert_array_equal(cube.faces[3, 2, 1], want)


def test_defaults(renderer):
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    assert renderer.render(cc.Scene(), camera, (4, 4)).color.dtype == np.uint8
    assert renderer.capture(cc.Scene()).faces.shape == (6, 256, 256, 4)
    assert renderer.capture(cc.Scene()).dtype == np.float32


def test_formats_agree(renderer):
    scene = cc.Scene(background=cc.CubeMap(smooth_environment(16)))
    full = renderer.capture(scene, size=16).faces
    assert_close(
        renderer.capture(scene, size=16, format="rgba16f").faces.astype(float), full, "half"
    )
    assert_close(
        renderer.capture(scene, size=16, format="rgba8").faces / 255, np.clip(full, 0, 1), "unorm8"
    )


def test_huge_and_tiny_numbers_are_kept(renderer):
    scene = cc.Scene(background=(3e30, 60000, 1e-30, 1))
    np.testing.assert_array_equal(
        renderer.capture(scene, size=2).faces[0, 0, 0], np.float32([3e30, 60000, 1e-30, 1])
    )
    assert renderer.capture(scene, size=2, format="rgba16f").faces[0, 0, 0, 1] == 60000


@pytest.mark.parametrize("fmt", ["rgb8", "RGBA8", "float32", "", None, 8])
def test_unknown_formats_are_refused_naming_those_there_are(renderer, fmt):
    with pytest.raises((ValueError, TypeError)) as raised:
        renderer.capture(cc.Scene(), size=4, format=fmt)
    if isinstance(fmt, str):
        assert "rgba16f" in str(raised.value)


@pytest.mark.parametrize("outputs", [("depths",), ("colour",), "distance", (3,), ("id", "deep")])
def test_unknown_outputs_are_refused(renderer, outputs):
    if (
        outputs == "distance"
    ):  # one string is a sequence of letters; taking it as one name is as good as refusing
        return
    with pytest.raises((ValueError, TypeError), match=r"distance|outputs"):
        renderer.capture(cc.Scene(), size=4, outputs=outputs)


@pytest.fixture(scope="module")
def bright():
    """From black to 40, saturated and grey."""
    faces = np.random.default_rng(2).random((6, 16, 16, 3)).astype(np.float32)
    faces *= np.float32(10.0) ** np.linspace(-3, 1.6, 16, dtype=np.float32)[:, None]
    faces[2] = faces[2, ..., :1]
    return cc.Scene(background=cc.CubeMap(faces))


@pytest.fixture
def raw(renderer, bright):
    view = perspective((0, 0, 0), (0.3, 0.2, -1), fov=110)
    return view, renderer.render(bright, view.camera, view.size, format="rgba32f").color


@pytest.mark.parametrize("curve", ["reinhard", "aces", "neutral"])
@pytest.mark.parametrize("encode", [None, "srgb"])
def test_tone_curves(renderer, bright, raw, curve, encode):
    view, linear = raw
    want = shading.TONE_CURVES[curve](linear[..., :3].astype(float))
    if encode:
        want = shading.srgb_encode(want)
    got = renderer.render(
        bright, view.camera, view.size, format="rgba32f", tonemap=curve, encode=encode
    ).color
    assert_close(got[..., :3], want, "tone")
    assert_identical(got[..., 3], linear[..., 3])


def test_srgb_alone(renderer, bright, raw):
    """The standard ends at 1; how a float picture goes on beyond is not its business."""
    view, linear = raw
    got = renderer.render(bright, view.camera, view.size, format="rgba32f", encode="srgb").color
    low = (linear[..., :3] <= 1).all(-1)
    assert_close(got[..., :3], shading.srgb_encode(linear[..., :3].astype(float)), "tone", mask=low)
    assert (got[~low][:, :3].max(-1) >= 1).all()


def test_eight_bits_of_the_curve(renderer, bright, raw):
    view, linear = raw
    got = renderer.render(bright, view.camera, view.size, tonemap="aces", encode="srgb").color
    want = shading.srgb_encode(shading.aces(linear[..., :3].astype(float))) * 255
    assert np.abs(got[..., :3] - want).max() < 0.51
    assert got.dtype == np.uint8


def test_alpha_is_not_curved(renderer):
    scene = cc.Scene(background=(0.5, 0.5, 0.5, 0.5))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    got = renderer.render(
        scene, camera, (2, 2), format="rgba32f", tonemap="reinhard", encode="srgb"
    ).color
    assert (got[..., 3] == 0.5).all()


@pytest.mark.parametrize("option", [{"tonemap": "filmic"}, {"encode": "rec709"}, {"tonemap": ""}])
def test_unknown_curves_are_refused(renderer, option):
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    with pytest.raises(ValueError, match=r"reinhard|srgb"):
        renderer.render(cc.Scene(), camera, (2, 2), **option)
