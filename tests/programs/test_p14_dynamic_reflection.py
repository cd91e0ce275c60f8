"""P14: the probe against ray casting, and each pixel of the ball against a lookup of it."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import dynamic_reflection as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.programs.oracle import (
    GOLD,
    Look,
    lit,
    looked_up,
    mesh,
    near_enough,
    rx,
    ry,
    scaled,
    stage,
    unbroken,
)
from tests.programs.staged import gaze, held, like_the_background, shares
from tests.reference import raycast

SIZE, FACE = (72, 72), 40


@pytest.mark.slow
@pytest.mark.parametrize("frame", [0, 17, 40])
def test_frames(renderer, frame):
    program = example.build(probe_size=FACE, probe_format="rgba32f", document=True)
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
    held = renderer.read_probe(program.probe).faces
    shapes, colors = stage(program, frame)
    seen = raycast.cast_cube(shapes, (0, 0, 0), FACE, 1, 100)
    assert set(np.unique(seen.id)) == {0, *colors}
    assert_close(held[..., :3], lit(seen, colors, np.zeros(3)), "phong", mask=unbroken(seen, 0.06))
    look = Look((0, 1, 5), (0, 0, 0), 70, 1, 100, SIZE)
    hits = look.hits([*shapes, mesh(program.ball, scaled(0.5))])
    want = lit(hits, colors, look.eye)
    ball = hits.id == program.ball.id
    bounced = shading.reflect(look.directions()[ball], hits.normal[ball])
    want[ball] = 0.78 * looked_up(held, bounced)[:, :3] + 0.3 * GOLD
    mask = unbroken(hits, 0.06)
    assert_close(color, want, "phong", mask=mask & ~ball)
    near_enough(color, want, mask & ball, 2e-3, 6e-3, "ball")


def test_numbers_of_the_document():
    program = example.build(document=True)
    probe = program.probe
    assert (probe.size, probe.near, probe.far, probe.format) == (256, 1, 100, "rgba8")
    assert probe.depth_format == "depth_component16"
    assert program.ball.mesh is not None
    np.testing.assert_allclose(program.ball.mesh.bounds, [[-1] * 3, [1] * 3], atol=1e-6)
    assert program.ball.scale.tolist() == [0.5] * 3
    material = program.ball.material
    assert isinstance(material, cc.MirrorMaterial)
    assert (material.env_weight, material.color_weight) == (0.78, 0.3)
    np.testing.assert_allclose(material.color[:3], GOLD)
    assert material.f0 is None


def test_one_round(renderer):
    """63 frames are one round, except for a part of one step."""
    program = example.build(probe_size=8, document=True)
    example.draw(program, renderer, 0, size=(8, 8))
    start = program.actors[0].position
    example.draw(program, renderer, example.FRAMES, size=(8, 8))
    assert 0 < np.linalg.norm(program.actors[0].position - start) < 0.05


def nearest(program):
    """The index of the actor that is nearest to the eye."""
    away = [np.linalg.norm(actor.position - program.camera.position) for actor in program.actors]
    return int(np.argmin(away))


def test_the_staged_still_is_about_the_ball(renderer):
    """At the still the ball fills 4 % of the picture and more, and 15 % of it and more are actors."""
    program = example.build()
    example.draw(program, renderer, program.still, size=(16, 16))
    on_ball, ids = held(renderer, program, program.ball, program.probe)
    assert on_ball.mean() > 0.04
    assert shares(ids, program.actors).sum() > 0.15
    assert like_the_background(renderer, program, program.ball) < 0.05
    assert (ids == 0).mean() < 0.6  # the sky


def test_an_actor_that_passes_in_front_comes_up_large(renderer):
    """In front of the ball an actor covers a good part of its middle; behind it, it is pressed against the rim."""
    program = example.build(probe_size=16)
    found = []
    for frame in range(0, 63, 3):
        example.go_round(program.actors, program.circle, frame)
        size = (128, 128)
        on_ball, ids = held(renderer, program, program.ball, program.probe, size)
        # The ball's picture is a disk; some of it may be hidden by the figure in front.
        rows, columns = np.nonzero(on_ball)
        radius = np.ptp(columns) / 2
        center = rows.min() + radius, (columns.min() + columns.max()) / 2
        away = np.hypot(rows - center[0], columns - center[1]) / radius
        found.append((nearest(program), shares(ids, program.actors), ids, away))
    for index, actor in enumerate(program.actors):
        front = [entry for entry in found if entry[0] == index]
        back = [entry for entry in found if entry[0] == (index + 2) % 4]
        assert max(share[index] for _, share, _, _ in front) > 0.05
        assert min(away[ids == actor.id].mean() for _, _, ids, away in front) < 0.6
        assert max(away[ids == actor.id].mean() for _, _, ids, away in back) > 0.9


def test_the_staged_figures_stand_on_the_floor_and_touch_nothing():
    program = example.build()
    example.go_round(program.actors, program.circle, 7)
    floor = program.circle.height
    assert program.ball.world_bounds[0][1] == pytest.approx(floor)
    for actor in program.actors:
        assert actor.world_bounds[0][1] == pytest.approx(floor, abs=1e-6)
        assert actor.mesh is not None
        positions = actor.mesh.positions @ actor.world_matrix[:3, :3].T + actor.position
        assert np.linalg.norm(positions, axis=1).min() > program.ball.scale[0] - 0.02


@pytest.mark.parametrize("document", [False, True])
def test_view_angles(document):
    program = example.build(angles=(30, -10), document=document)
    camera, first = program.camera, example.build(document=document).camera
    want = (rx(-10) @ ry(30))[:3, :3] @ gaze(first)
    np.testing.assert_allclose(gaze(camera), want, atol=1e-9)
