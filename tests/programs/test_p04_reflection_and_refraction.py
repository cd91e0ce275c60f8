"""P4: the direction and the colour of every reflecting and refracting pixel, for several values of eta."""

import numpy as np
import pytest

from cubecam.examples import reflection_and_refraction as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.gl.world import inner_smooth
from tests.programs.oracle import Look, looked_up, mesh, moved, near_enough, photographs, ry, scaled

SIZE = (64, 64)


def shapes_of(program, turn):
    """The four shapes in their places: two stretched balls above, two teapots below, all turned together."""
    found = {}
    for x, pair in ((-1, program.mirrors), (1, program.glass)):
        ball, pot = pair
        found[ball.id] = mesh(ball, turn @ moved(x, 0.8, 0) @ scaled(0.9, 0.6, 0.6))
        found[pot.id] = mesh(pot, turn @ moved(x, -0.8, 0), ("teapot", 1.6))
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("frame", "eta"), [(0, 1 / 1.52), (19, 1 / 1.52), (52, 1 / 2.42), (70, 1.2), (33, 1.0)]
)
def test_every_pixel(renderer, frame, eta):
    images = photographs()
    program = example.build(images, eta=eta, document=True)
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
    turn = ry(4 * frame)
    shapes = shapes_of(program, turn)
    eye = turn[:3, :3] @ (0, 0.6, 5)
    look = Look(eye, (0, 0, 0), 45, 0.1, 1000, SIZE)
    hits = look.hits(list(shapes.values()))
    incident, normal = look.directions(), hits.normal
    seen = inner_smooth(hits)
    mirrors, glass = (
        np.isin(hits.id, [node.id for node in pair]) for pair in (program.mirrors, program.glass)
    )
    balls = np.isin(hits.id, [program.mirrors[0].id, program.glass[0].id])
    bounced = shading.reflect(incident, normal)
    bent = shading.refract(incident, normal, eta)
    # Where no light can be refracted, the glass mirrors; at the border a rounding decides.
    k = 1 - eta**2 * (1 - shading.dot(incident, normal)[..., 0] ** 2)
    gone = glass & (k < 0)
    sure = ~glass | (np.abs(k) > 0.03)
    directions = np.where((glass & ~gone)[..., None], bent, incident)
    directions = np.where((mirrors | gone)[..., None], bounced, directions)
    want = looked_up(images, directions)
    if eta > 1:
        assert (gone & balls).sum() > 20
    for part, least in ((mirrors & balls, 0.03), (glass & balls, 0.03), (hits.id == 0, 0.4)):
        assert_close(color, want, "mirror", mask=part & seen & sure, least=least)
    # The normals of a teapot change much from one pixel to the next.
    near_enough(color, want, mirrors & ~balls & seen & sure, 2e-3, 6e-3, "mirrored teapot")
    near_enough(color, want, glass & ~balls & seen & sure, 2e-3, 6e-3, "glass teapot")


@pytest.mark.slow
def test_a_stretched_ball_needs_the_inverse_transpose(renderer):
    """mat3(model), as document 002 writes it, would give other directions, and the oracle notices the difference."""
    images = photographs()
    program = example.build(images, document=True)
    color = example.draw(program, renderer, 0, size=SIZE, format="rgba32f")[..., :3]
    shape = shapes_of(program, ry(0))[program.mirrors[0].id]
    look = Look((0, 0.6, 5), (0, 0, 0), 45, 0.1, 1000, SIZE)
    hits = look.hits([shape])
    stretched = hits.normal @ np.diag([0.9, 0.6, 0.6]) ** 2
    stretched /= np.maximum(np.linalg.norm(stretched, axis=-1, keepdims=True), 1e-9)
    wrong = looked_up(images, shading.reflect(look.directions(), stretched))
    mask = inner_smooth(hits) & hits.hit
    assert np.abs(color - wrong)[mask].mean() > 0.02


def test_eta_1_is_invisible(renderer):
    images = photographs()
    program = example.build(images, eta=1.0, document=True)
    picture = example.draw(program, renderer, 5, size=SIZE)
    for node in program.glass:
        node.visible = False
    without = example.draw(program, renderer, 5, size=SIZE)
    difference = np.abs(picture.astype(int) - without)
    assert difference.mean() < 0.2
    assert difference.max() <= 8  # only the rims differ by so much
