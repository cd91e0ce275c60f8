"""P14: the probe against ray casting, and each pixel of the ball against a lookup of it."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import dynamic_reflection as example
from tests.compare import assert_close
from tests.programs.oracle import (
    GOLD,
    Look,
    lit,
    looked_up,
    mesh,
    near_enough,
    scaled,
    stage,
    unbroken,
)
from tests.reference import raycast, shading

SIZE, FACE = (72, 72), 40


@pytest.mark.slow
@pytest.mark.parametrize("frame", [0, 17, 40])
def test_frames(renderer, frame):
    program = example.build(probe_size=FACE, probe_format="rgba32f")
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
    program = example.build()
    probe = program.probe
    assert (probe.size, probe.near, probe.far, probe.format) == (256, 1, 100, "rgba8")
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
    program = example.build(probe_size=8)
    example.draw(program, renderer, 0, size=(8, 8))
    start = program.actors[0].position
    example.draw(program, renderer, example.FRAMES, size=(8, 8))
    assert 0 < np.linalg.norm(program.actors[0].position - start) < 0.05
