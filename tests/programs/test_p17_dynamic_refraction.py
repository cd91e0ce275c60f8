"""P17: each pixel of the glass ball against a lookup of its probe by `refract`, and the mirror ball beside it."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import dynamic_refraction as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.programs.oracle import (
    GOLD,
    Look,
    lit,
    looked_up,
    mesh,
    moved,
    near_enough,
    scaled,
    stage,
    unbroken,
)
from tests.programs.staged import held, like_the_background, shares
from tests.reference import raycast

SIZE, FACE = (96, 96), 40


@pytest.mark.slow
@pytest.mark.parametrize(("frame", "eta"), [(0, 1 / 1.52), (13, 1 / 1.52), (29, 1 / 1.33)])
def test_frames(renderer, frame, eta):
    program = example.build(eta=eta, probe_size=FACE, probe_format="rgba32f", document=True)
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
    shapes, colors = stage(program, frame)
    look = Look((0, 1, 5), (0, 0, 0), 70, 1, 100, SIZE)
    balls = [(program.glass, -0.7), (program.mirror, 0.7)]
    hits = look.hits([*shapes, *[mesh(node, moved(x, 0, 0) @ scaled(0.5)) for node, x in balls]])
    want = lit(hits, colors, look.eye)
    for (node, x), probe in zip(balls, program.probes, strict=True):
        seen = raycast.cast_cube(shapes, (x, 0, 0), FACE, 1, 100)
        held = renderer.read_probe(probe).faces
        center = np.array([x, 0, 0.0])
        assert_close(held[..., :3], lit(seen, colors, center), "phong", mask=unbroken(seen, 0.06))
        rows = hits.id == node.id
        incident, normal = look.directions()[rows], hits.normal[rows]
        if node is program.glass:
            want[rows] = looked_up(held, shading.refract(incident, normal, eta))[:, :3]
        else:
            bounced = looked_up(held, shading.reflect(incident, normal))[:, :3]
            want[rows] = 0.78 * bounced + 0.3 * GOLD
    mask = unbroken(hits, 0.06)
    ids = [node.id for node, _ in balls]
    assert_close(color, want, "phong", mask=mask & ~np.isin(hits.id, ids))
    for number, name in zip(ids, ("glass", "mirror"), strict=True):
        near_enough(color, want, mask & (hits.id == number), 2e-3, 6e-3, name)


def test_numbers():
    program = example.build(document=True)
    material = program.glass.material
    assert isinstance(material, cc.GlassMaterial)
    assert material.ior == pytest.approx(1.52)
    assert not material.fresnel
    assert [probe.size for probe in program.probes] == [256, 256]
    assert [probe.format for probe in program.probes] == ["rgba8", "rgba8"]
    assert [probe.depth_format for probe in program.probes] == ["depth_component16"] * 2
    np.testing.assert_array_equal(material.tint[:3], (1, 1, 1))


def test_the_balls_are_not_in_each_other_s_cubemap(renderer):
    program = example.build(probe_size=16, document=True)
    example.draw(program, renderer, 3, size=(16, 16))
    held = [renderer.read_probe(probe).faces for probe in program.probes]
    program.glass.visible = program.mirror.visible = False
    for probe, faces in zip(program.probes, held, strict=True):
        cube = renderer.capture(
            program.scene, position=probe.position, size=16, near=1, far=100, format="rgba8"
        )
        np.testing.assert_array_equal(cube.faces, faces)


def test_the_staged_balls_are_unlike_their_background(renderer):
    program = example.build()
    for frame in (program.still, 0, 30, 50):
        example.draw(program, renderer, frame, size=(16, 16))
        ids = renderer.render(program.scene, program.camera, (128, 128), outputs=("id",)).id
        for ball in (program.glass, program.mirror):
            assert (ids == ball.id).mean() > 0.05
            assert like_the_background(renderer, program, ball) < 0.05


def test_the_staged_still_shows_figures_in_both_balls(renderer):
    """The glass shows the figure behind it upside down, the mirror those before it."""
    program = example.build(probe_size=16)
    example.draw(program, renderer, program.still, size=(16, 16))
    glass, mirror = program.probes
    on_glass, through = held(renderer, program, program.glass, glass, eta=1 / 1.52)
    _, back = held(renderer, program, program.mirror, mirror)
    behind = min(program.actors, key=lambda actor: actor.position[2])
    assert shares(through, [behind])[0] > 0.2
    assert shares(back, program.actors).sum() > 0.05
    # The teapot stands lower than the ball, and its picture is in the upper half of the ball.
    rows = np.nonzero(on_glass)[0]
    assert rows[through == behind.id].mean() < rows.mean()
