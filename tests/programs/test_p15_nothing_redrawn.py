"""P15: the counter of drawn views is 0 while nothing changes, and is right when something changes."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import nothing_redrawn as example

SIZE = (24, 24)


def counted(program, renderer, frames):
    counts = []
    for frame in frames:
        example.draw(program, renderer, frame, size=SIZE)
        counts.append(example.views_drawn(program, renderer))
    return counts


def test_counter(fresh_renderer):
    program = example.build(probe_size=32, document=True)
    counts = counted(program, fresh_renderer, range(example.FRAMES))
    assert counts[0] == 7  # the main view and six faces, once
    assert counts[1:10] == [0] * 9
    moving = counts[10:20]
    assert all(
        2 <= count < 7 for count in moving
    )  # the main view, and the faces that see the walker
    assert counts[20:30] == [0] * 10
    assert all(count >= 2 for count in counts[30:40])


def test_where_the_walker_is():
    """The walker rests for ten frames, makes ten steps of a tenth of a radian, then rests at its new place."""
    steps = [example.steps(frame) for frame in range(-1, 41)]
    assert steps == [0] * 11 + list(range(1, 11)) + [10] * 10 + list(range(11, 21)) + [20]


def test_it_stands_where_the_steps_lead(fresh_renderer):
    program = example.build(probe_size=8, document=True)
    for frame, angle in ((0, 0), (14, 0.5), (25, 1.0), (39, 2.0)):
        example.draw(program, fresh_renderer, frame, size=(8, 8))
        want = (2.5 * np.cos(angle), -0.5, -2.5 * np.sin(angle))
        np.testing.assert_allclose(program.walker.position, want, atol=1e-12)


def test_pictures_are_those_of_a_renderer_that_never_rested(fresh_renderer, new_renderer):
    program, other = (
        example.build(probe_size=32, document=True),
        example.build(probe_size=32, document=True),
    )
    forgetful = new_renderer(cache_bytes=0)
    for frame in (0, 5, 12, 19, 22):
        got = example.draw(program, fresh_renderer, frame, size=SIZE)
        want = example.draw(other, forgetful, frame, size=SIZE)
        np.testing.assert_array_equal(got, want)


@pytest.mark.parametrize("what", ["position", "color"])
def test_an_equal_value_is_no_change(fresh_renderer, what):
    program = example.build(probe_size=16, document=True)
    example.draw(program, fresh_renderer, 0, size=SIZE)
    if what == "position":
        program.walker.position = tuple(program.walker.position)
    else:
        material = program.walker.material
        assert isinstance(material, cc.PhongMaterial)
        material.color = tuple(material.color)
    example.draw(program, fresh_renderer, 0, size=SIZE)
    assert example.views_drawn(program, fresh_renderer) == 0


@pytest.fixture(scope="module")
def staged(shared_renderers):
    """The staged pictures of some frames, from one renderer in this order, and their program."""
    program, renderer = example.build(probe_size=32), shared_renderers(None)
    return program, {
        frame: example.draw(program, renderer, frame, size=(320, 320))
        for frame in (0, 5, 14, 39, 25)
    }


def lit_squares(picture, frame):
    """The lit squares of a frame's column in the counter, which fills the lowest fifth of a picture 320 high."""
    strip = picture[256:, :, :3].astype(int)
    lit = (np.abs(strip - example.FACE)).sum(axis=-1) == 0
    lit |= np.abs(strip - example.MAIN).sum(axis=-1) == 0
    margin = round(0.08 * 64)
    column = lit[:, margin + (2 * frame + 1) * (320 - 2 * margin) // (2 * example.FRAMES)]
    # Squares are runs of lit rows: a gap divides them.
    return int((np.diff(np.concatenate([[False], column]).astype(int)) == 1).sum())


def test_the_counter_is_in_the_picture(staged):
    program, pictures = staged
    for frame, picture in pictures.items():
        assert picture.shape == (320, 320, 4)
        assert (picture[256:, :, 3] == 255).all()
        for earlier in range(frame + 1):
            assert lit_squares(picture, earlier) == program.counts[earlier], (frame, earlier)
        for later in range(frame + 1, example.FRAMES):
            assert lit_squares(picture, later) == 0


def test_what_the_counter_counts(staged):
    """All seven when the lamp is switched on, none at rest, and a few faces while the bunny walks."""
    counts = staged[0].counts
    assert counts[0] == 7
    assert [counts[frame] for frame in (*range(1, 10), *range(20, 30))] == [0] * 19
    assert all(2 <= counts[frame] <= 5 for frame in (*range(10, 20), *range(30, 40)))


def test_the_scene_above_the_counter_is_that_without(new_renderer):
    program = example.build(probe_size=16)
    renderer = new_renderer()
    with_counter = example.draw(program, renderer, 12, size=(80, 100))
    without = example.draw(program, renderer, 12, size=(80, 80), counter=False)
    np.testing.assert_array_equal(with_counter[:80], without)


def test_a_renderer_that_keeps_no_frames_is_counted_so(new_renderer):
    """The counts are those of the renderer at hand, not of one before it."""
    program = example.build(probe_size=16)
    example.draw(program, new_renderer(), 5, size=(80, 80))
    assert [program.counts[frame] for frame in range(6)] == [7, 0, 0, 0, 0, 0]
    example.draw(program, new_renderer(cache_bytes=0), 5, size=(80, 80))
    assert [program.counts[frame] for frame in range(6)] == [7, 1, 1, 1, 1, 1]


def test_the_counter_of_a_float_picture(new_renderer):
    program = example.build(probe_size=16)
    renderer = new_renderer()
    picture = example.draw(program, renderer, 11, size=(100, 100), format="rgba32f")
    small = example.draw(program, renderer, 11, size=(100, 100))
    assert picture.dtype == np.float32
    np.testing.assert_allclose(picture[80:], small[80:] / 255, atol=1e-6)


def test_the_document_has_no_counter(new_renderer):
    program = example.build(probe_size=16, document=True)
    renderer = new_renderer()
    picture = example.draw(program, renderer, 0, size=(40, 40))
    want = renderer.render(program.scene, program.camera, (40, 40)).color
    np.testing.assert_array_equal(picture, want)
    assert program.probe.depth_format == "depth_component16"
