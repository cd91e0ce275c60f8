"""The weights of several probes: a partition of 1 that nothing makes jump, and what a ProbeBlend refuses."""

import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.influence import Influence, distance_outside, weights
from tests.reference.transforms import rotation


def any_of(value: Any) -> Any:
    return value


TURN = rotation((0.9, 0.2, -0.3, 0.1))
ROOMS = (
    Influence((-3, -1, -2), (0, 2, 2), 0.5),
    Influence((0, -1, -2), (3, 2, 2), 0.8),
    Influence((-1, -1, -1), (2, 1, 1.5), 0.7, "sphere"),
    Influence((-1, -1, -1), (1, 1, 1), 0.6, "box", TURN @ np.diag([1.0, 1.5, 0.7, 1])),
)


def test_weights_sum_to_one_and_no_step_makes_them_jump():
    rng = np.random.default_rng(3)
    starts, ends = rng.uniform(-5, 5, (2, 400, 1, 3))
    s = np.linspace(0, 1, 1001)[:, None]
    along = starts + s * (ends - starts)
    step = np.linalg.norm(ends - starts, axis=-1) / 1000
    found = weights(along, ROOMS)
    assert np.abs(found.sum(axis=-1) - 1).max() < 1e-12
    assert found.min() >= 0
    # The cubic's steepest slope is 1.5 over the blend distance; a matrix stretches it by at most 1.5 / .7, and a
    # quotient of the weights is at most (1 + n) times as steep.
    steepest = (1.5 / 0.5) * (1.5 / 0.7) * 5
    assert (np.abs(np.diff(found, axis=1)).max(axis=(1, 2)) < steepest * step[:, 0]).all()
    assert (found.max(axis=1) > 0.4).any(axis=0).all()  # each of them counts somewhere


def test_weights_by_hand():
    a, b = Influence((-4, 0, 0), (0, 2, 2), 1), Influence((0, 0, 0), (4, 2, 2), 1)
    at = [(-2, 1, 1), (0, 1, 1), (0.25, 1, 1), (5.5, 1, 1), (4.5, 1, 1)]
    w = 1 - 3 / 16 + 2 / 64
    want = [
        (1, 0, 0),
        (0.5, 0.5, 0),
        (w / (1 + w), 1 / (1 + w), 0),
        (0, 0, 1),
        (0, 0.5, 0.5),
    ]
    np.testing.assert_allclose(weights(at, (a, b)), want, atol=1e-12)


def test_distances_are_those_of_dense_samples():
    rng = np.random.default_rng(8)
    points = rng.uniform(-3, 3, (40, 3))
    grid = np.linspace(-1, 1, 41)
    cube = np.stack(np.meshgrid(grid, grid, grid), axis=-1).reshape(-1, 3)
    moved = TURN.copy()
    moved[:3, 3] = (0.5, -0.2, 0.3)
    low, high = np.array([-1, -0.5, -1.5]), np.array([0.5, 0.5, 1])
    inside = (cube * (high - low) / 2 + (low + high) / 2) @ moved[:3, :3].T + moved[:3, 3]
    want = np.linalg.norm(points[:, None] - inside, axis=-1).min(axis=1)
    got = distance_outside(points, Influence(low, high, matrix=moved))
    assert np.abs(got - want).max() < 0.06
    ball = Influence((-1, -1, -1), (1, 1, 1), shape="sphere", matrix=moved)
    want = np.maximum(np.linalg.norm(points - moved[:3, 3], axis=-1) - 1, 0)
    np.testing.assert_allclose(distance_outside(points, ball), want, atol=1e-12)
    wide = Influence((-1, -1, -1), (1, 1, 1), matrix=np.diag([2.0, 1, 3, 1]))
    assert distance_outside([(4, 0, 0), (0, 0, 4.5), (5, 5, 0)], wide).tolist() == [2, 1.5, 5]


def test_a_blend_keeps_its_probes_and_is_pickled():
    probes = [
        cc.Probe((1, 0, 0), influence=((-1, -1, -1), (1, 1, 1)), blend_distance=0.25),
        cc.Probe(influence_shape="sphere"),
    ]
    blend = cc.ProbeBlend(iter(probes))
    assert blend.probes == tuple(probes)
    assert repr(blend) == "ProbeBlend(2 probes)"
    again = pickle.loads(pickle.dumps(blend))
    assert [p.blend_distance for p in again.probes] == [0.25, 1]
    assert again.probes[0].influence.tolist() == [[-1, -1, -1], [1, 1, 1]]
    assert again.probes[1].influence is None
    assert again.probes[1].influence_shape == "sphere"
    node = cc.Scene().add(cc.Mesh.box(), cc.MirrorMaterial(), environment=blend)
    assert node.environment is blend


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: cc.ProbeBlend([]), ValueError, "at least one Probe, got none"),
        (lambda: cc.ProbeBlend([(p := cc.Probe()), p]), ValueError, "each Probe once"),
        (lambda: cc.ProbeBlend(any_of(cc.Probe())), TypeError, "a sequence of Probes"),
        (lambda: cc.ProbeBlend(any_of([1])), TypeError, "Probes"),
        (lambda: cc.Probe(blend_distance=0), ValueError, "blend_distance"),
        (lambda: cc.Probe(influence=((1, 0, 0), (0, 1, 1))), ValueError, "low < high"),
        (lambda: cc.Probe(influence_shape=any_of("cone")), ValueError, "influence_shape"),
        (
            lambda: cc.BasicMaterial(cubemap=any_of(cc.ProbeBlend([cc.Probe()]))),
            TypeError,
            "a CubeMap .* a Probe or None",
        ),
    ],
)
def test_what_is_refused(make, error, message):
    with pytest.raises(error, match=message):
        make()
