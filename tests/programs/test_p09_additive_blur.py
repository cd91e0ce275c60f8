"""P9: nine passes add up to the numpy box filter; in 8 bits nine roundings are off by at most 4.5 of 255."""

import numpy as np
import pytest

from cubecam.examples import additive_blur as example
from tests.compare import assert_close

SIZE = (60, 50)


def noise(rng, height=45, width=54):
    """Noise with as many texels as the rectangle has pixels, so that each pixel shows one texel."""
    return rng.integers(0, 256, (height, width, 3)).astype(np.uint8)


def rectangle(pixels):
    """The document's rectangle in a black picture, with one texel for each pixel."""
    picture = np.zeros((SIZE[1], SIZE[0], 3))
    top, left = (SIZE[1] - pixels.shape[0]) // 2, (SIZE[0] - pixels.shape[1]) // 2
    picture[top : top + pixels.shape[0], left : left + pixels.shape[1]] = pixels / 255
    return picture


def shifted(picture, right, up):
    return np.roll(picture, (-up, right), axis=(0, 1))


def passes(picture, count):
    return [shifted(picture, *offset) / 9 for offset in example.OFFSETS[:count]]


@pytest.fixture
def image(rng):
    # The margin in the 60 x 50 picture is a whole number of pixels; 45 rows would need half pixels.
    return noise(rng, 46, 54)


@pytest.fixture
def program(image, monkeypatch):
    monkeypatch.setattr(example, "MARGIN", 0.9)
    built = example.build(image)
    for node in built.passes:
        node.scale = (54, 1, 46)
    return built


def draw(program, renderer, frame, **options):
    """Draw as the example does, with a rectangle 46 pixels high, so that each texel covers one pixel."""
    program.camera.height = SIZE[1]
    for index, (node, offset) in enumerate(zip(program.passes, example.OFFSETS, strict=True)):
        node.visible = index < frame
        node.position = (*offset, 0)
    return renderer.render(program.scene, program.camera, SIZE, **options).color


@pytest.mark.parametrize("frame", range(10))
def test_each_pass_adds_its_ninth(any_path, program, image, frame):
    got = draw(program, any_path, frame, format="rgba32f")
    want = sum(passes(rectangle(image), frame), np.zeros((SIZE[1], SIZE[0], 3)))
    assert_close(got[..., :3], want, "float32_maths")
    assert (got[..., 3] == 1).all()


def test_nine_passes_are_the_box_filter(any_path, program, image):
    got = draw(program, any_path, 9, format="rgba32f")
    padded = np.pad(rectangle(image), ((1, 1), (1, 1), (0, 0)))
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    assert_close(got[..., :3], windows.mean(axis=(-1, -2)), "float32_maths")


def test_eight_bits_round_nine_times(any_path, program, image):
    got = draw(program, any_path, 9) / 255
    exact = sum(passes(rectangle(image), 9))
    error = np.abs(got[..., :3] - exact) * 255
    assert error.max() <= 4.5
    assert error.max() > 0.5, "more than the one rounding of a picture drawn at once"
    rounded = sum(np.rint(part * 255) for part in passes(rectangle(image), 9)) / 255
    assert_close(got[..., :3], rounded, "exact")


def test_the_example_draws_its_own_picture(renderer):
    """The picture of draw() itself is the 3 x 3 mean of the photograph, which is black beyond its borders."""
    program = example.build()
    sharp = example.draw(program, renderer, 0, (100, 100), blurred=False, format="rgba32f")
    blurred = example.draw(program, renderer, 9, (100, 100), format="rgba32f")
    padded = np.pad(sharp[..., :3].astype(float), ((1, 1), (1, 1), (0, 0)))
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    assert_close(blurred[..., :3], windows.mean(axis=(-1, -2)), "lookup")
    assert example.draw(program, renderer, 4, (100, 100)).mean() < blurred.mean() * 255
