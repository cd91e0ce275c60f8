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
    built = example.build(image, document=True)
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
    program = example.build(document=True)
    sharp = example.draw(program, renderer, 0, (100, 100), blurred=False, format="rgba32f")
    blurred = example.draw(program, renderer, 9, (100, 100), format="rgba32f")
    padded = np.pad(sharp[..., :3].astype(float), ((1, 1), (1, 1), (0, 0)))
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    assert_close(blurred[..., :3], windows.mean(axis=(-1, -2)), "lookup")
    assert example.draw(program, renderer, 4, (100, 100)).mean() < blurred.mean() * 255


@pytest.mark.parametrize("frame", [0, 1, 10, 11, 45, 80, 81, 105])
def test_partial_sums_are_as_bright_as_the_source(any_path, frame):
    """The right half is the sum of the first k passes times 9/k; the left half is the source."""
    program = example.build()
    size = (2 * example.SMALL, example.SMALL)
    got = example.draw(program, any_path, frame, size, format="rgba32f")
    source, total = np.split(got[..., :3].astype(float), 2, axis=1)
    count = 9 if frame in (0, 81, 105) else {1: 1, 10: 1, 11: 2, 45: 5, 80: 8}[frame]
    image = np.zeros((example.SMALL, example.SMALL, 3))
    image[4:124, 4:124] = example._detail() / 255
    # The words stand in the upper rows.
    assert_close(source[20:], image[20:], "lookup")
    want = sum(passes(image, count)) * 9 / count
    assert_close(total[20:], want[20:], "lookup")
    inside = slice(30, 120), slice(10, 118)
    assert total[inside].mean() == pytest.approx(source[inside].mean(), rel=0.02)


def test_the_finished_picture_is_first_and_is_held_for_a_second(renderer):
    program = example.build()
    size = (256, 128)
    first = example.draw(program, renderer, 0, size)
    for frame in range(example.FRAMES - 25, example.FRAMES):
        assert example.count_of(program, frame) == 9
    assert example.count_of(program, example.FRAMES - 26) == 8
    np.testing.assert_array_equal(first, example.draw(program, renderer, example.STILL, size))
    assert [example.count_of(program, frame) for frame in (1, 10, 11, 20)] == [1, 1, 2, 2]


def test_the_blur_can_be_seen(renderer):
    """The staged picture shows each pixel as a square of four: the mean step between neighbours falls by a quarter."""
    program = example.build()
    picture = example.draw(program, renderer, example.STILL, (1024, 512)).astype(float)
    squares = picture.reshape(128, 4, 256, 4, 4)
    assert (squares[32:, :1, :, :1] == squares[32:]).all(), "each pixel is a square"
    small = squares[32:, 0, :, 0, :3]
    source, total = small[:, 8:120], small[:, 136:248]
    steps = [np.abs(np.diff(half, axis=1)).mean() for half in (source, total)]
    assert steps[1] < 0.75 * steps[0]
    differs = (np.abs(source - total).max(-1) > 8).mean()
    assert differs > 0.25


def test_a_picture_from_a_file(renderer, tmp_path, image):
    from PIL import Image

    Image.fromarray(image).save(tmp_path / "noise.png")
    given = [example.build(one, document=True) for one in (image, tmp_path / "noise.png")]
    drawn = [example.draw(one, renderer, 9, SIZE) for one in given]
    np.testing.assert_array_equal(drawn[0], drawn[1])
