"""Levels of detail of a mesh: what is left out, the stated error against numpy, and how meshes keep them."""

import copy
import itertools
import pickle
from collections import Counter
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.surfaces import bumpy, grid, samples, surface_distances


def corners(mesh, indices):
    return np.asarray(mesh.positions, float)[np.asarray(indices)]


def edges_by_place(mesh, indices):
    """How many triangles have each edge, where vertices at one place count as one."""
    _, place = np.unique(np.asarray(mesh.positions), axis=0, return_inverse=True)
    places = place.ravel()[np.asarray(indices)]
    assert all(len(set(triangle)) == 3 for triangle in places)
    found: Counter[tuple[int, ...]] = Counter()
    for triangle in places:
        for i in range(3):
            found[tuple(sorted((triangle[i], triangle[(i + 1) % 3])))] += 1
    return found


MESHES = {
    "sphere": lambda: cc.Mesh.sphere(1, 12, 6),
    "torus": lambda: cc.Mesh.torus(1, 0.4, 12, 8),
    "cylinder": lambda: cc.Mesh.cylinder(0.5, 2, 16),
    "bumpy": lambda: bumpy(8),
    "icosphere": lambda: cc.Mesh.icosphere(2, 2),
}


@pytest.mark.parametrize("name", MESHES)
def test_no_surface_lies_farther_from_the_other_than_the_error(name):
    mesh = MESHES[name]()
    made = mesh.with_levels()
    assert len(made.levels) >= 2
    exact = corners(mesh, mesh.indices)
    last = 0.0
    for indices, error in made.levels[::2]:
        level = corners(mesh, indices)
        away = surface_distances(samples(exact, 3), level).max()
        back = surface_distances(samples(level, 5), exact).max()
        assert max(away, back) <= error * (1 + 1e-6)
        assert error >= last
        last = error


def test_the_error_is_no_more_than_five_percent_too_large():
    """Equal normals leave the distance alone."""
    ball = cc.Mesh.icosphere(1, 2)
    plain = cc.Mesh(
        ball.positions, ball.indices, normals=np.tile((0, 0, 1), (len(ball.positions), 1))
    )
    exact = corners(plain, plain.indices)
    for indices, error in plain.with_levels().levels[:2]:
        level = corners(plain, indices)
        found = max(
            surface_distances(samples(exact, 4), level).max(),
            surface_distances(samples(level, 7), exact).max(),
        )
        assert error <= 1.1 * found  # samples miss a little


@pytest.mark.parametrize("name", ["sphere", "torus", "cylinder", "icosphere"])
def test_a_closed_surface_stays_closed_and_keeps_its_side(name):
    mesh = MESHES[name]()
    for indices, _ in mesh.with_levels().levels:
        assert set(edges_by_place(mesh, indices).values()) == {2}
        a, b, c = np.moveaxis(corners(mesh, indices), 1, 0)
        assert (np.cross(a, b) * c).sum() > 0


@pytest.mark.parametrize("ratio", [0.25, 0.5, 0.8])
def test_each_level_has_its_share_of_the_triangles(ratio):
    mesh = cc.Mesh.icosphere(1, 3)
    counts = [
        len(mesh.indices),
        *(len(indices) for indices, _ in mesh.with_levels(ratio=ratio).levels),
    ]
    for before, now in itertools.pairwise(count for count in counts if count > 100):
        assert 0.97 * ratio * before - 4 <= now <= ratio * before


@pytest.mark.parametrize("moved", [0, 0.45])
def test_a_flat_sheet_keeps_its_border_and_has_no_error(rng, moved):
    """Also where the vertices inside are not in rows, so that triangles are near to turning over."""
    sheet = grid(12, lambda x, y: 0 * x)
    positions = np.array(sheet.positions)
    inside = ((positions[:, :2] > 0.01) & (positions[:, :2] < 0.99)).all(axis=1)
    positions[inside, :2] += rng.uniform(-moved, moved, (inside.sum(), 2)) / 12
    sheet = cc.Mesh(positions, sheet.indices, normals=[(0, 0, 1)] * len(positions))
    a, b, c = np.moveaxis(corners(sheet, sheet.indices), 1, 0)
    whole = (np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2).sum()
    levels = sheet.with_levels().levels
    assert len(levels[-1][0]) < 0.15 * len(sheet.indices)
    for indices, error in levels:
        a, b, c = np.moveaxis(corners(sheet, indices), 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        assert areas.sum() <= whole + 1e-6  # no new folds
        assert (np.cross(b - a, c - a)[:, 2] / 2).sum() == pytest.approx(1, abs=1e-6)  # no gaps
        assert error < 2e-4


def test_colors_and_uvs_count_in_the_error():
    sheet = grid(12, lambda x, y: 0 * x)
    x, y = np.asarray(sheet.positions)[:, :2].T
    spot = np.zeros((len(x), 3))
    spot[(np.abs(x - 0.5) < 0.2) & (np.abs(y - 0.5) < 0.2)] = 1
    bent = np.stack([x + 0.2 * np.sin(6 * x), y], axis=1)
    plain = sheet.with_levels().levels
    for other in ({"colors": spot}, {"uvs": bent}):
        mesh = cc.Mesh(sheet.positions, sheet.indices, **other)
        levels = mesh.with_levels().levels
        assert levels[-1][1] > 20 * plain[-1][1]
        assert levels[-1][1] > 1e-3
    straight = cc.Mesh(sheet.positions, sheet.indices, uvs=np.stack([2 * x + y, y - x], axis=1))
    assert straight.with_levels().levels[-1][1] < 2e-4  # a linear map is exact between any vertices


def test_a_seam_of_colors_stays_where_it_is():
    """Two halves of a sheet with colours of their own, whose vertices on the seam are at one place."""
    sheet = grid(12, lambda x, y: 0 * x)
    points = np.asarray(sheet.positions)
    left = np.asarray([t for t in sheet.indices if points[t][:, 0].mean() < 0.5])
    right = np.asarray([t for t in sheet.indices if points[t][:, 0].mean() > 0.5]) + len(points)
    colors = np.repeat([(1.0, 0, 0), (0, 0, 1.0)], len(points), axis=0)
    mesh = cc.Mesh(np.concatenate([points, points]), np.concatenate([left, right]), colors=colors)
    levels = mesh.with_levels().levels
    assert len(levels[-1][0]) < 0.3 * len(mesh.indices)
    for indices, error in levels:
        assert error < 2e-4
        for triangle in indices:
            x = np.asarray(mesh.positions)[triangle][:, 0]
            assert (x.max() <= 0.5 + 1e-6) if triangle[0] < len(points) else (x.min() >= 0.5 - 1e-6)
            assert len({bool(i < len(points)) for i in triangle}) == 1
        count = Counter(edges_by_place(mesh, indices).values())
        assert count[1] <= 48
        assert set(count) == {1, 2}


def test_the_same_mesh_has_the_same_levels():
    one, two = (bumpy(8).with_levels().levels for _ in range(2))
    assert len(one) == len(two)
    for (a, error), (b, other) in zip(one, two, strict=True):
        assert np.array_equal(a, b)
        assert error == other


def test_what_cannot_be_simplified_has_no_levels():
    assert cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).with_levels().levels == ()
    flat = cc.Mesh.icosphere(1, 2).flat_shaded()  # each vertex differs from its neighbours
    assert flat.with_levels().levels == ()


QUAD: dict[str, Any] = {
    "positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
    "indices": [[0, 1, 2], [0, 2, 3]],
}
LEVELS: Any = [([[0, 1, 2]], 0.5), (np.array([[1, 2, 3]], np.int64), 2)]


def assert_levels(mesh, levels):
    assert len(mesh.levels) == len(levels)
    for (indices, error), (want, wanted_error) in zip(mesh.levels, levels, strict=True):
        assert indices.dtype == np.uint32
        assert not indices.flags.writeable
        assert np.array_equal(indices, want)
        assert error == pytest.approx(wanted_error, rel=1e-12)


def test_levels_can_be_given_and_taken_away():
    mesh = cc.Mesh(**QUAD)
    assert mesh.levels == ()
    assert repr(mesh) == "Mesh(4 vertices, 2 triangles)"
    mesh.levels = LEVELS
    assert_levels(mesh, LEVELS)
    assert repr(mesh) == "Mesh(4 vertices, 2 triangles, 2 levels)"
    assert_levels(cc.Mesh(**QUAD, levels=LEVELS), LEVELS)
    again = cc.Mesh(**QUAD, levels=mesh.levels)
    assert_levels(again, LEVELS)
    mesh.levels = []
    assert mesh.levels == ()
    assert_levels(again, LEVELS)


def test_copies_and_pickles_have_them():
    mesh = cc.Mesh(**QUAD, levels=LEVELS)
    for again in (copy.copy(mesh), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))):
        assert_levels(again, LEVELS)
    assert_levels(mesh.with_levels(), [])  # a quad has nothing to leave out
    assert_levels(mesh, LEVELS)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("positions", np.ones((4, 3))),
        ("normals", None),
        ("uvs", np.ones((4, 2))),
        ("uvs1", np.ones((4, 2))),
        ("colors", np.ones((4, 3))),
        ("tangents", [(1, 0, 0, 1)] * 4),
    ],
)
def test_new_vertices_end_them(name, value):
    mesh = cc.Mesh(**QUAD, levels=LEVELS)
    if value is not None:
        mesh.update(**{name: value})
        assert mesh.levels == ()
        mesh.levels = LEVELS
    setattr(mesh, name, value)
    assert mesh.levels == ()


def test_what_makes_other_meshes_of_it():
    mesh = cc.Mesh(**QUAD, uvs=np.asarray(QUAD["positions"])[:, :2], levels=LEVELS)
    assert_levels(mesh.resized(3), [(i, 3 * error) for i, error in LEVELS])
    assert_levels(mesh.with_tangents(), LEVELS)
    assert mesh.flat_shaded().levels == ()
    mesh.morph_targets = [cc.MorphTarget(positions=np.ones((4, 3)))]
    assert_levels(mesh, LEVELS)


@pytest.mark.parametrize(
    ("levels", "error", "text"),
    [
        (3, TypeError, r"levels: expected a sequence of pairs \(indices, error\), got int"),
        ("ab", TypeError, r"levels: expected a sequence of pairs \(indices, error\), got str"),
        (
            [[[0, 1, 2]]],
            TypeError,
            r"levels: expected a sequence of pairs \(indices, error\), got list",
        ),
        (
            [([[0, 1, 2]], "far")],
            TypeError,
            "levels: expected an error as float in each pair, got str",
        ),
        (
            [([[0, 1, 2]], -1)],
            ValueError,
            "error of level 0 that is finite and not negative, got -1",
        ),
        (
            [([[0, 1, 2]], np.nan)],
            ValueError,
            "error of level 0 that is finite and not negative, got nan",
        ),
        (
            [([[0, 1, 2]], np.inf)],
            ValueError,
            "error of level 0 that is finite and not negative, got inf",
        ),
        (LEVELS[::-1], ValueError, "errors of levels that do not decrease, .* got 0.5 after 2"),
        ([([[0, 1, 4]], 1)], IndexError, "levels: expected .*4.*got"),
        ([([[0, 1, -1]], 1)], IndexError, "levels: expected .* got .*-1"),
        ([([[0.0, 1, 2]], 1)], TypeError, "levels: expected integers, got"),
        ([([0, 1, 2], 1)], ValueError, r"levels: expected shape \(F, 3\), got \(3,\)"),
        ([(np.zeros((0, 3), int), 1)], ValueError, "at least one triangle of level 0, got none"),
    ],
    ids=str,
)
def test_bad_levels_are_refused(levels, error, text):
    mesh = cc.Mesh(**QUAD, levels=LEVELS)
    with pytest.raises(error, match=text):
        mesh.levels = levels
    assert_levels(mesh, LEVELS)
    with pytest.raises(error, match=text):
        cc.Mesh(**QUAD, levels=levels)


@pytest.mark.parametrize("ratio", [0, 0.05, 0.95, 1, -0.5, np.nan])
def test_a_bad_ratio_is_refused(ratio):
    with pytest.raises(ValueError, match=r"expected a ratio from 0\.1 to 0\.9, got"):
        cc.Mesh.sphere(1, 8, 6).with_levels(ratio=ratio)
