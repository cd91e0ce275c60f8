"""The way of light through bodies in numpy, against laws of optics that do not follow from how it is computed."""

import numpy as np
import pytest

from cubecam.truth.shading import bodies
from cubecam.truth.shading.cubes import directions_of_texels, largest_part
from cubecam.truth.shading.vectors import normalised, refract

AXES = np.concatenate([np.eye(3), -np.eye(3)])
BOX = bodies.convex(AXES, [1.0, 0.5, 0.7] * 2)


def entering_a_ball(count=200, ior=1.5):
    """Rays that enter the unit ball: places, directions before and after."""
    rng = np.random.default_rng(4)
    normal = normalised(rng.normal(size=(count, 3)))
    incident = normalised(rng.normal(size=(count, 3)))
    incident = np.where((incident * normal).sum(-1, keepdims=True) > 0, -incident, incident)
    return normal, incident, refract(incident, normal, 1 / ior)


def test_a_ball_turns_light_by_twice_the_difference_of_the_angles():
    """Descartes: the deviation of light that goes through a drop is 2 (i - t), with sin i = n sin t."""
    normal, incident, inside = entering_a_ball()
    found = bodies.through(normal, inside, 1.5, bodies.ball(1.0))
    sine = np.sqrt(1 - (incident * normal).sum(-1) ** 2)
    i, t = np.arcsin(np.minimum(sine, 1)), np.arcsin(sine / 1.5)
    turned = np.arccos(np.clip((incident * found.direction).sum(-1), -1, 1))
    np.testing.assert_allclose(turned, 2 * (i - t), atol=1e-6)
    np.testing.assert_allclose(found.way, 2 * np.cos(t), atol=1e-9)
    assert (found.met == 1).all()


def test_a_pane_does_not_turn_light():
    incident = normalised(np.array([[0.3, -0.9, 0.2], [-0.1, -1, 0.4]]))
    start = np.array([[0.0, 0.5, 0.1], [0.1, 0.5, -0.2]])
    inside = refract(incident, np.array([[0.0, 1, 0]] * 2), 1 / 1.6)
    found = bodies.through(start, inside, 1.6, BOX)
    np.testing.assert_allclose(found.direction, incident, atol=1e-12)
    np.testing.assert_allclose(found.way, -1 / inside[:, 1], atol=1e-12)


def test_light_in_a_cube_of_glass_is_reflected_by_the_next_side():
    """It enters the front at a grazing angle and cannot leave through a side, since 1.5 is above the root of 2."""
    incident = normalised(np.array([[-2.0, 0.001, -0.3]]))
    inside = refract(incident, np.array([[0.0, 0, 1]]), 1 / 1.5)
    found = bodies.through([[-0.7, 0, 0.7]], inside, 1.5, BOX)
    assert found.met.tolist() == [2]
    np.testing.assert_allclose(found.direction, incident * [-1, 1, 1], atol=1e-12)
    # After the last meeting it leaves in the direction of the reflection.
    cut = bodies.through([[-0.7, 0, 0.7]], inside, 1.5, BOX, most=1)
    np.testing.assert_allclose(cut.direction, inside * [-1, 1, 1], atol=1e-12)
    assert cut.met.tolist() == [1]


def box_cube(size):
    """1 / z and the normals of the inner side of the cube from -1 to 1, but for a hole in its ceiling."""
    direction = directions_of_texels(size)
    hole = (direction[..., 1] == 1) & (np.abs(direction[..., 0]) < 0.5)
    return np.where(hole, 0.0, 1 / largest_part(direction)), np.eye(3)[
        np.abs(direction).argmax(axis=-1)
    ] * np.sign(direction)


def test_a_body_that_a_cube_knows():
    nearness, normals = box_cube(32)
    seen, exact = bodies.seen_from_middle(nearness, normals), bodies.convex(AXES, [1.0] * 6)
    start = np.array([[0.2, -1, 0.3], [-0.5, -1, 0.1], [0.9, -1, -0.4]])
    way = normalised(np.array([[0.9, 0.5, 0.1], [-0.3, 0.4, -0.9], [0.2, 0.3, 0.95]]))
    got, want = seen(start, way), exact(start, way)
    np.testing.assert_allclose(got[0], want[0], atol=1e-6)
    np.testing.assert_allclose(got[1], want[1], atol=1e-6)
    # A slanting plane is exact, too, since 1 / z is linear on a face.
    normal = normalised(np.array([1.0, 2, 0.5]))
    slanting = directions_of_texels(32) @ normal / 0.6
    seen = bodies.seen_from_middle(
        np.maximum(slanting, nearness), np.broadcast_to(normal, (6, 32, 32, 3))
    )
    distance, _ = seen(np.array([[0.0, -0.3, 0]]), normal[None])
    np.testing.assert_allclose(distance, 0.6 + 0.3 * normal[1], atol=1e-6)


def test_a_far_side_that_is_not_known():
    seen = bodies.seen_from_middle(*box_cube(32))
    found = bodies.through([[0.0, -1, 0]], [[0.0, 1, 0]], 1.5, seen)
    assert found.met.tolist() == [0]
    assert (found.position.tolist(), found.direction.tolist()) == ([[0, -1, 0]], [[0, 1, 0]])
    assert found.way.tolist() == [0]


@pytest.mark.parametrize(
    ("ior", "want"), [(1.5, (1.475, 1.5, 1.525)), (1.01, (1.0095, 1.01, 1.0105))]
)
def test_the_indices_of_three_colours(ior, want):
    """KHR_materials_dispersion: halfSpread = (ior - 1) * 0.025 * dispersion."""
    np.testing.assert_allclose(bodies.spread(ior, 2.0), want, atol=1e-12)
    np.testing.assert_allclose(bodies.spread(1 / ior, 2.0), 1 / np.array(want), atol=1e-12)


def test_absorption():
    """KHR_materials_volume: T(x) = c^(x / d)."""
    assert bodies.extinction((0.3, 0.5, 1), np.inf).tolist() == [0, 0, 0]
    left = np.exp(-0.8 * bodies.extinction((0.3, 0.5, 1), 0.4))
    np.testing.assert_allclose(left, [0.09, 0.25, 1])
    assert np.exp(-1e-3 * bodies.extinction((0, 1, 1), 1.0))[0] == pytest.approx(10**-0.03)
