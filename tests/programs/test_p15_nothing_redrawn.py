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
    program = example.build(probe_size=32)
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
    program = example.build(probe_size=8)
    for frame, angle in ((0, 0), (14, 0.5), (25, 1.0), (39, 2.0)):
        example.draw(program, fresh_renderer, frame, size=(8, 8))
        want = (2.5 * np.cos(angle), -0.5, -2.5 * np.sin(angle))
        np.testing.assert_allclose(program.walker.position, want, atol=1e-12)


def test_pictures_are_those_of_a_renderer_that_never_rested(fresh_renderer, new_renderer):
    program, other = example.build(probe_size=32), example.build(probe_size=32)
    forgetful = new_renderer(cache_bytes=0)
    for frame in (0, 5, 12, 19, 22):
        got = example.draw(program, fresh_renderer, frame, size=SIZE)
        want = example.draw(other, forgetful, frame, size=SIZE)
        np.testing.assert_array_equal(got, want)


@pytest.mark.parametrize("what", ["position", "color"])
def test_an_equal_value_is_no_change(fresh_renderer, what):
    program = example.build(probe_size=16)
    example.draw(program, fresh_renderer, 0, size=SIZE)
    if what == "position":
        program.walker.position = tuple(program.walker.position)
    else:
        material = program.walker.material
        assert isinstance(material, cc.PhongMaterial)
        material.color = tuple(material.color)
    example.draw(program, fresh_renderer, 0, size=SIZE)
    assert example.views_drawn(program, fresh_renderer) == 0
