"""ProbeGrid without OpenGL: the reference of its light against what can be computed by hand, and its properties."""

import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import probe_grid as reference


def any_of(value: Any) -> Any:
    return value


BOX = np.array([(-1.0, 0, -2), (2, 2, 2)])
COUNTS = (4, 3, 5)
UNIFORM = np.sqrt(4 * np.pi)


def arrays(light):
    """Coefficients of uniform radiance `light` (nz, ny, nx, 3), endless distances, all nodes active."""
    shape = COUNTS[::-1]
    coefficients = np.zeros((*shape, 9, 3))
    coefficients[..., 0, :] = np.broadcast_to(light, (*shape, 3)) * UNIFORM
    distances = np.broadcast_to((1e3, 1e6), (*shape, 8, 8, 2))
    return coefficients, distances, np.ones(shape, bool)


def nodes():
    axes = [np.linspace(BOX[0, i], BOX[1, i], COUNTS[i]) for i in range(3)]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return np.stack([x, y, z], axis=-1)


def somewhere(count, rng):
    directions = rng.normal(size=(2, count, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    return rng.uniform(*BOX, (count, 3)), *directions


def test_uniform_light_is_exact_whatever_the_nodes_see():
    rng = np.random.default_rng(1)
    coefficients, distances, active = arrays((0.5, 1, 2))
    mean = rng.uniform(0.1, 3, distances.shape[:-1])
    distances = np.stack([mean, mean**2 + rng.random(mean.shape)], axis=-1)
    active[rng.random(active.shape) < 0.3] = False
    at, normals, incident = somewhere(100, rng)
    got = reference.irradiance(
        at, normals, incident, BOX[0], BOX[1], coefficients, distances, active
    )
    np.testing.assert_allclose(got, np.broadcast_to((0.5, 1, 2), (100, 3)), rtol=1e-12)


def test_a_linear_field_is_exact_between_nodes_without_visibility():
    rng = np.random.default_rng(2)
    slope, start = np.array([(0.2, 0.1, -0.1), (0.3, 0, 0.2), (-0.1, 0.2, 0.3)]), 2.0
    coefficients, distances, active = arrays(nodes() @ slope + start)
    at, normals, incident = somewhere(200, rng)
    got = reference.irradiance(
        at, normals, incident, BOX[0], BOX[1], coefficients, distances, active, visibility=False
    )
    np.testing.assert_allclose(got, at @ slope + start, atol=1e-12)
    biased = reference.irradiance(
        at, normals, incident, BOX[0], BOX[1], coefficients, distances, active
    )
    assert np.abs(biased - got).max() > 0.01  # nodes before the surface count more


def test_a_lamp_is_what_its_integral_says():
    """Radiance L (1 + cos) round an axis: irradiance over pi is L (1 + 2/3 cos), exactly of orders 0 and 1."""
    rng = np.random.default_rng(3)
    faces = cc.CubeMap(np.ones((6, 64, 64, 3), np.float32))
    axis = np.array([0.6, -0.64, 0.48])
    from cubecam.truth.shading.cubes import directions_of_texels

    d = directions_of_texels(64)
    d = d / np.linalg.norm(d, axis=-1, keepdims=True)
    light = (1 + d @ axis)[..., None] * np.array([1, 2, 0.5])
    c = cc.CubeMap(light.astype(np.float32)).sh(2)
    normals = rng.normal(size=(50, 3))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    want = (1 + 2 / 3 * normals @ axis)[:, None] * np.array([1, 2, 0.5])
    np.testing.assert_allclose(reference.node_light(c, normals), want, atol=2e-3)
    assert reference.node_light(-faces.sh(2), normals).max() == 0


def test_weights_by_hand():
    up, no = np.array([[0.0, 1, 0]]), np.zeros((1, 3))
    above, below = np.array([[0.0, 2, 0]]), np.array([[0.0, -2, 0]])

    def weight(way, moments=None):
        given = None if moments is None else np.array([moments])
        return float(reference.visibility_weight(way, up, no, given)[0])

    assert weight(above) == pytest.approx(1.2)
    assert weight(below) == pytest.approx(0.2)  # not below the limit
    assert weight(above, (2.5, 7)) == pytest.approx(1.2)  # nothing is nearer
    # mean 1, variance .5, 1 too far: a third, cubed.
    assert weight(above, (1, 1.5)) == pytest.approx((1.2 / 27) ** 3 / 0.04)
    assert weight(above, (1.9, 3.61 + 0.04)) == pytest.approx(1.2 * 0.8**3)
    assert weight(above, (1, 1)) == pytest.approx(1e-18 / 0.04)


def test_octahedral_maps_have_no_seams():
    d = reference.octahedral_directions(32)
    ticks = (np.arange(32) + 0.5) / 16 - 1
    uv = np.stack(np.broadcast_arrays(ticks[None], ticks[:, None]), axis=-1)
    np.testing.assert_allclose(reference.octahedral_place(d), uv, atol=1e-12)
    field = np.stack([d @ (0.3, 0.5, -0.2), (d @ (1, 0, 1)) ** 2], axis=-1)
    rng = np.random.default_rng(4)
    ways = rng.normal(size=(500, 3))
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    want = np.stack([ways @ (0.3, 0.5, -0.2), (ways @ (1, 0, 1)) ** 2], axis=-1)
    got = reference.looked_up(np.broadcast_to(field, (500, *field.shape)), ways)
    assert np.abs(got - want).max() < 0.06
    # Beyond an edge lies what is on its other half: without that, noise would end there.
    noise = rng.random((1, 8, 8, 1))
    for v in (-0.7, 0.1, 0.45):
        half = [0.999999 * np.array(at) for at in ((1, v), (1, -v), (v, 1), (-v, 1))]
        near = [
            np.array([x - np.copysign(f, x), y - np.copysign(f, y), -f])
            for (x, y), f in (((x, y), abs(x) + abs(y) - 1) for x, y in half)
        ]
        one, two, three, four = (float(reference.looked_up(noise, way[None])[0, 0]) for way in near)
        assert abs(one - two) < 1e-4
        assert abs(three - four) < 1e-4


def test_properties_and_pickles():
    grid = cc.ProbeGrid(BOX, COUNTS, resolution=8, view_bias=0.5)
    assert repr(grid) == "ProbeGrid(4 x 3 x 5 nodes)"
    assert grid.counts == COUNTS
    np.testing.assert_array_equal(grid.box, BOX)
    rng = np.random.default_rng(0)
    grid.coefficients = rng.random(grid.coefficients.shape)
    grid.distances = rng.random(grid.distances.shape)
    grid.active = rng.random(grid.active.shape) < 0.5
    grid.visibility = False
    scene = cc.Scene()
    scene.probe_grid = grid
    again = pickle.loads(pickle.dumps(scene)).probe_grid
    for name in ("coefficients", "distances", "active", "box"):
        np.testing.assert_array_equal(getattr(again, name), getattr(grid, name))
    for name in ("counts", "size", "resolution", "visibility", "normal_bias", "view_bias"):
        assert getattr(again, name) == getattr(grid, name)
    with pytest.raises(ValueError, match="read-only"):
        grid.coefficients[0] = 1


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda g: cc.ProbeGrid(BOX[::-1], COUNTS), ValueError, "low < high"),
        (lambda g: cc.ProbeGrid(BOX, (1, 2, 2)), ValueError, "counts"),
        (lambda g: cc.ProbeGrid(BOX, any_of((2, 2))), TypeError, "three whole numbers"),
        (lambda g: cc.ProbeGrid(BOX, (2, 200, 200)), ValueError, "nx and ny \\* nz of at most"),
        (lambda g: cc.ProbeGrid(BOX, COUNTS, resolution=3), ValueError, "resolution from 4 to 32"),
        (lambda g: cc.ProbeGrid(BOX, COUNTS, size=0), ValueError, "size from 1 to 128"),
        (lambda g: cc.ProbeGrid(BOX, COUNTS, view_bias=-1), ValueError, "view_bias"),
        (
            lambda g: setattr(g, "coefficients", np.zeros((5, 3, 4, 4, 3))),
            ValueError,
            r"coefficients: expected shape \(5, 3, 4, 9, 3\)",
        ),
        (lambda g: setattr(g, "active", np.ones((5, 3, 4))), TypeError, "an array of bool"),
        (lambda g: setattr(cc.Scene(), "probe_grid", 3), TypeError, "a ProbeGrid or None"),
    ],
)
def test_what_is_refused(make, error, message):
    with pytest.raises(error, match=message):
        make(cc.ProbeGrid(BOX, COUNTS))
