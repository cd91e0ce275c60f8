"""Polygons cut into triangles: areas by the shoelace formula, every corner used, no edge without a partner."""

import numpy as np
import pytest

from cubecam.io.meshes.polygons import triangles
from tests.helpers import least_cpu_seconds

# Flat polygons, counter-clockwise; by area, computed by hand.
SHAPES = {
    "triangle": ([(0, 0), (2, 0), (0, 1)], 1),
    "square": ([(0, 0), (1, 0), (1, 1), (0, 1)], 1),
    "dart": ([(0, 0), (4, -2), (1, 0), (4, 2)], 2),
    "quad with a corner on a side": ([(0, 0), (1, 0), (2, 0), (0, 2)], 2),
    "L": ([(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)], 3),
    "L with corners on its sides": (
        [(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1)],
        3,
    ),
    "square with the middle of each side": (
        [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)],
        4,
    ),
    "U": ([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], 7),
    "plus": (
        [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)],
        5,
    ),
    "comb": (
        [(0, -1), (9, -1), (8, 2), (7, 0), (6, 2), (5, 0), (4, 2), (3, 0), (2, 2), (1, 0)],
        None,
    ),
    "stairs with corners on each side": (
        [(0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 4), (0, 4), (0, 2)],
        9,
    ),
    "many corners on the sides of an L": (
        [(x, 0) for x in range(9)]
        + [(8, y) for y in range(1, 5)]
        + [(x, 4) for x in range(7, 3, -1)]
        + [(4, y) for y in range(5, 9)]
        + [(x, 8) for x in range(3, -1, -1)]
        + [(0, y) for y in range(7, 0, -1)],
        48,
    ),
    "ring with a slit": (
        [(0, 0), (3, 0), (3, 3), (0, 3), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)],
        8,
    ),
}  # fmt: skip
PLANES = {
    "xy": np.eye(3),
    "yz": np.eye(3)[[1, 2, 0]],
    "zx": np.eye(3)[[2, 0, 1]],
    "slanted": np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0],
}


def shoelace(flat):
    x, y = np.asarray(flat, float).T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def in_space(flat, frame, origin=(0, 0, 0)):
    """Put a flat polygon into the plane of the first two rows of a frame."""
    flat = np.asarray(flat, float)
    return flat @ frame[:2] + np.asarray(origin, float)


def areas(positions, cut, normal):
    """Signed areas of triangles, seen against a normal."""
    a, b, c = np.moveaxis(positions[cut], 1, 0)
    return np.cross(b - a, c - a) @ normal / 2


def one(positions):
    count = len(positions)
    cut, owners = triangles(positions, np.arange(count), np.array([count]))
    assert cut.dtype == owners.dtype == np.int64
    assert owners.tolist() == [0] * len(cut)
    return cut


def check(positions, normal, area, scale=1.0, slivers=True):
    """Check the triangles of one simple polygon that goes counter-clockwise about a normal."""
    cut = one(positions)
    count = len(positions)
    assert cut.shape == (count - 2, 3)
    assert set(cut.ravel().tolist()) == set(range(count))
    found = areas(positions, cut, normal)
    np.testing.assert_allclose(found.sum(), area, rtol=1e-9)
    assert found.min() > (-1e-12 * scale**2 if slivers else 0)
    # No cracks: each edge has a partner in the other direction, or is an edge of the polygon.
    edges = {(t[k], t[(k + 1) % 3]) for t in cut.tolist() for k in range(3)}
    assert len(edges) == 3 * len(cut)
    open_ = {(a, b) for a, b in edges if (b, a) not in edges}
    assert open_ == {(k, (k + 1) % count) for k in range(count)}


@pytest.mark.parametrize("plane", PLANES.values(), ids=PLANES)
@pytest.mark.parametrize(("flat", "area"), SHAPES.values(), ids=SHAPES)
def test_shapes_from_every_first_corner_and_both_ways_round(flat, area, plane):
    if area is not None:
        assert shoelace(flat) == area
    exact = np.count_nonzero(plane) == 3
    normal = np.cross(plane[0], plane[1])
    for first in range(len(flat)):
        turned = flat[first:] + flat[:first]
        points = in_space(turned, plane, (5, -3, 2))
        check(points, normal, shoelace(flat), slivers=not exact)
        check(points[::-1].copy(), -normal, shoelace(flat), slivers=not exact)


def star(rng, count):
    """A polygon without crossings whose corners go round the origin."""
    angles = np.sort((np.arange(count) + rng.uniform(-0.4, 0.4, count)) * (2 * np.pi / count))
    radii = rng.uniform(0.2, 1, count)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)


@pytest.mark.parametrize("count", [4, 5, 6, 7, 9, 16, 40, 150, 999, 1001, 6000])
def test_random_simple_polygons_in_random_planes(rng, count):
    for scale in (1e-30, 1.0, 1e30) if count < 200 else (1.0,):
        frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        flat = star(rng, count) * scale
        points = in_space(flat, frame, rng.normal(size=3) * scale)
        check(points, np.cross(frame[0], frame[1]), shoelace(flat), scale)


@pytest.mark.parametrize("limit", ["ears", "sweep"])
@pytest.mark.parametrize("turn", [0, 1, 2, 3])
def test_combs_and_spirals_by_ears_and_by_the_sweep(turn, limit, monkeypatch):
    if limit == "sweep":
        monkeypatch.setattr("cubecam.io.meshes.polygons._MOST_EARS", 5)
    teeth = np.arange(300.0)
    comb = [*np.stack([teeth[::-1], teeth % 2], axis=1).tolist(), [0, -3], [299, -3]]
    angles = np.linspace(0, 20, 200)
    spiral = [((1 + a) * np.cos(a), (1 + a) * np.sin(a)) for a in angles]
    spiral = [((2 + a) * np.cos(a), (2 + a) * np.sin(a)) for a in angles] + spiral[::-1]
    steps = [(k + j, -k) for k in range(40) for j in (0, 1)] + [(40, -45), (-5, -45), (-5, 0)]
    for flat in (comb, spiral, steps[::-1]):
        flat = np.array(flat, float) @ np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), turn)
        assert shoelace(flat) > 0
        check(in_space(flat, np.eye(3)), np.array([0, 0, 1.0]), shoelace(flat), scale=300)


@pytest.mark.parametrize("shape", [name for name in SHAPES if "slit" not in name])
def test_the_sweep_cuts_every_shape(shape, monkeypatch):
    monkeypatch.setattr("cubecam.io.meshes.polygons._MOST_EARS", 0)
    monkeypatch.setattr("cubecam.io.meshes.polygons._STARTS", 1)
    flat, _ = SHAPES[shape]
    for first in range(len(flat)):
        points = in_space(flat[first:] + flat[:first], np.eye(3))
        if len(flat) > 4:
            check(points, np.array([0, 0, 1.0]), shoelace(flat), slivers=True)


def test_quads_that_are_not_flat_are_cut_where_both_halves_face_the_same_way(rng):
    """The diagonal from the first corner where it is right, as other readers have it."""
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.0)])
    assert one(square).tolist() == [[0, 1, 2], [0, 2, 3]]
    bent = square + np.array([[0, 0, 0.3], [0, 0, 0], [0, 0, 0.3], [0, 0, 0]])
    assert one(bent).tolist() == [[0, 1, 2], [0, 2, 3]]
    dart = np.array([(0, 0, 0), (4, -2, 1), (1, 0, 0), (4, 2, 1.0)])
    assert np.sort(one(dart), axis=1).tolist() == [[0, 1, 2], [0, 2, 3]]
    turned = np.roll(dart, 1, axis=0)
    assert sorted(map(sorted, one(turned).tolist())) == [[0, 1, 3], [1, 2, 3]]


def test_polygons_of_many_sizes_keep_their_order_and_their_places(rng):
    counts = rng.integers(0, 9, 400)
    counts[:3] = (2, 0, 1)
    positions: list[np.ndarray] = []
    corners: list[int] = []
    used = 0
    for count in counts:
        ring = in_space(star(rng, max(count, 1)), np.eye(3))[:count]
        positions.append(ring)
        corners.extend(range(used, used + count))
        used += count
    points = np.concatenate(positions)
    shuffled = rng.permutation(used)
    moved = np.empty_like(points)
    moved[shuffled] = points
    cut, owners = triangles(moved, shuffled[np.array(corners)], counts)
    np.testing.assert_array_equal(owners, np.repeat(np.arange(400), np.maximum(counts - 2, 0)))
    starts = np.cumsum(counts) - counts
    for number, count in enumerate(counts.tolist()):
        mine = cut[owners == number]
        if count < 3:
            assert not len(mine)
            continue
        assert set(mine.ravel().tolist()) == set(range(starts[number], starts[number] + count))
        total = areas(points, mine, np.array([0, 0, 1.0])).sum()
        assert total == pytest.approx(shoelace(positions[number][:, :2]), rel=1e-9)


def test_no_polygons_are_no_triangles():
    nothing = np.zeros(0, np.int64)
    cut, owners = triangles(np.zeros((0, 3)), nothing, nothing)
    assert cut.shape == (0, 3)
    assert owners.shape == (0,)


def degenerate(rng):
    yield "one place", np.zeros((7, 3))
    yield "a line", np.arange(8.0)[:, None] * [1, 2, 3]
    yield "there and back", np.array([0, 1, 2, 3, 2, 1.0])[:, None] * [1, 0, 0]
    yield "nan", np.where(np.arange(8)[:, None] == 3, np.nan, rng.random((8, 3)))
    yield "infinity", np.where(np.arange(8)[:, None] == 3, np.inf, rng.random((8, 3)))
    yield "huge", in_space(star(rng, 9) * 1e307, np.eye(3))
    yield "tiny", in_space(star(rng, 9) * 1e-310, np.eye(3))
    yield "mixed", rng.normal(size=(9, 3)) * 10.0 ** rng.integers(-300, 300, (9, 1))
    yield "bow tie", np.array([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0.0)])
    yield "pentagram", np.array([(np.cos(k * 2.5133), np.sin(k * 2.5133), 0) for k in range(5)])
    yield "heptagram", np.array([(np.cos(k * 2.6928), np.sin(k * 2.6928), 0) for k in range(7)])
    yield "corners twice", np.repeat(in_space(star(rng, 6), np.eye(3)), 2, axis=0)
    yield "corners of a small grid", rng.integers(0, 3, (60, 3)).astype(float)
    for count in (6, 12, 50, 400, 2500):
        yield f"random {count}", rng.normal(size=(count, 3))


@pytest.mark.filterwarnings("error")
def test_degenerate_polygons_give_triangles_of_their_corners(rng):
    for name, points in degenerate(rng):
        cut = one(points)
        assert 1 <= len(cut) <= len(points) - 2, name
        assert cut.min() >= 0, name
        assert cut.max() < len(points), name
        assert (np.sort(cut, axis=1)[:, 1:] != np.sort(cut, axis=1)[:, :-1]).all(), name


def test_corners_that_are_there_twice_are_kept():
    flat = [(0, 0), (2, 0), (2, 0), (2, 1), (1, 1), (1, 1), (1, 1), (1, 2), (0, 2)]
    points = in_space(flat, np.eye(3))
    cut = one(points)
    assert len(cut) == 7
    assert set(cut.ravel().tolist()) == set(range(9))
    found = areas(points, cut, np.array([0, 0, 1.0]))
    assert found.sum() == 3
    assert found.min() >= 0


@pytest.mark.parametrize("name", ["star", "comb", "crossing", "few places"])
def test_very_many_corners_take_linear_time(rng, name):
    count = 50_000
    flat = {
        "star": lambda: star(rng, count),
        "comb": lambda: np.stack([np.arange(count)[::-1], np.arange(count) % 2 + 1.0], axis=1),
        "crossing": lambda: rng.random((count, 2)),
        "few places": lambda: rng.integers(0, 40, (count, 2)).astype(float),
    }[name]()
    if name == "comb":
        flat[0], flat[-1] = (count, -1), (-1, -1)
    points = in_space(flat, np.eye(3))
    taken, cut = least_cpu_seconds(lambda: one(points), 3)
    assert len(cut) == count - 2
    if name in ("star", "comb"):
        found = areas(points, cut, np.array([0, 0, 1.0]))
        assert found.sum() == pytest.approx(shoelace(flat), rel=1e-9)
        assert found.min() > -1e-9
    assert taken < 3
