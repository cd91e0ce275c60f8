"""The reference for reflections on the screen against planes, whose hits are known in closed form."""

import numpy as np
import pytest

from cubecam.truth.shading.screen import screen_hits

WIDTH, HEIGHT = 80, 60
WALL, NEAR, FAR = -5.0, 0.5, 20.0


def perspective(shift=0.0):
    """OpenGL's projection of a camera at the origin that looks along -z, near 0.5, far 20."""
    p = np.diag([1.2, 1.6, -(FAR + NEAR) / (FAR - NEAR), 0.0])
    p[2, 3], p[3, 2], p[0, 2] = -2 * FAR * NEAR / (FAR - NEAR), -1, shift
    return p


def parallel():
    p = np.diag([0.5, 0.6, -2 / (FAR - NEAR), 1.0])
    p[2, 3] = -(FAR + NEAR) / (FAR - NEAR)
    return p


def projected(points, matrix):
    """(x, y, depth) of points (..., 3): pixels from the upper left corner, depth from 0 to 1."""
    clip = np.concatenate([points, np.ones_like(points[..., :1])], -1) @ matrix.T
    at = clip[..., :3] / clip[..., 3:]
    return np.stack(
        [(at[..., 0] + 1) / 2 * WIDTH, (1 - at[..., 1]) / 2 * HEIGHT, (at[..., 2] + 1) / 2], -1
    )


def depth_of(z, matrix):
    """The depth of the plane at z, over the picture."""
    return np.full((HEIGHT, WIDTH), projected(np.array([0.0, 0.0, z]), matrix)[2])


VIEWS = {"perspective": perspective(), "shifted": perspective(0.3), "parallel": parallel()}


def rays(count=60):
    rng = np.random.default_rng(4)
    start = rng.uniform((-1, -1, -3.5), (1, 1, -2.5), (count, 3))
    way = rng.uniform((-0.5, -0.5, -1), (0.5, 0.5, -0.4), (count, 3))
    return start, way / np.linalg.norm(way, axis=1, keepdims=True)


@pytest.mark.parametrize("view", VIEWS)
def test_rays_end_on_a_wall(view):
    matrix = VIEWS[view]
    start, way = rays()
    got = screen_hits(start, way, matrix, depth_of(WALL, matrix), np.ones((HEIGHT, WIDTH), int))
    met = start + ((WALL - start[:, 2]) / way[:, 2])[:, None] * way
    expected = projected(met, matrix)[:, :2]
    inside = (expected > 0.6).all(1) & (expected < np.array([WIDTH, HEIGHT]) - 0.6).all(1)
    assert inside.sum() > 20
    assert (got.found == inside).mean() > 0.97
    assert np.abs(got.place - expected)[inside].max() < 1e-6


@pytest.mark.parametrize("view", VIEWS)
def test_the_width_of_a_lobe(view):
    matrix = VIEWS[view]
    start, way = rays(10)
    got = screen_hits(
        start, way, matrix, depth_of(WALL, matrix), np.ones((HEIGHT, WIDTH), int), spread=0.05
    )
    length = (WALL - start[:, 2]) / way[:, 2]
    met = start + length[:, None] * way
    across = 2 * 0.05 * length[:, None] * (0, 1, 0)
    pixels = np.abs(projected(met + across / 2, matrix) - projected(met - across / 2, matrix))[:, 1]
    np.testing.assert_allclose(got.width[got.found], pixels[got.found], rtol=1e-6)


def test_what_is_not_met():
    matrix = perspective()
    depth, ids = depth_of(WALL, matrix), np.ones((HEIGHT, WIDTH), int)
    start, way = np.array([[0.0, 0, -3]]), np.array([[0.3, 0, -0.954]])
    assert screen_hits(start, way, matrix, depth, ids).found.all()
    assert not screen_hits(start, way, matrix, depth, ids, own=1).found.any()  # the node itself
    assert not screen_hits(start, way, matrix, depth, 0 * ids).found.any()  # the background
    assert not screen_hits(start, -way, matrix, depth, ids).found.any()  # back to the eye
    assert not screen_hits(
        start - (0, 0, 3), way, matrix, depth, ids
    ).found.any()  # behind the wall
    block = depth.copy()
    block[:, 42:60] = depth_of(-2.0, matrix)[:, 42:60]
    assert not screen_hits(start, way, matrix, block, ids).found.any()  # it ends behind the block
    post = depth.copy()
    post[:, 42:44] = depth_of(-1.0, matrix)[:, 42:44]
    assert screen_hits(
        start, way, matrix, post, ids
    ).found.all()  # it goes on far behind a thin post
    post[:, 42:44] = depth_of(-3.7, matrix)[:, 42:44]
    met = screen_hits(start, way, matrix, post, ids)
    assert met.found.all()  # it ends on a post that it touches
    assert met.place[0, 0] < 44.5


def test_the_share_falls_to_the_border():
    matrix = parallel()
    depth, ids = depth_of(WALL, matrix), np.ones((HEIGHT, WIDTH), int)
    x = (np.array([0.9, 1.5, 2.5, 3.5, 40]) / WIDTH * 2 - 1) / 0.5
    start = np.stack([x + 0.001, 0 * x, 0 * x - 3], 1)
    way = np.tile([-0.001, 0, -2.0], (5, 1)) / np.hypot(0.001, 2)
    got = screen_hits(start, way, matrix, depth, ids)
    np.testing.assert_allclose(
        got.share, np.minimum((np.array([0.9, 1.5, 2.5, 3.5, 40]) - 0.5) / 3, 1), atol=1e-3
    )
