"""Mesh.tangents and Mesh.with_tangents: MikkTSpace against a numpy version and against surfaces with known tangents."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies
from tests.reference.mikktspace import corner_tangents

COUNT = len(cc.Mesh.icosphere(1, subdivisions=1).positions)


def quad(**more):
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    return cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]], **more)


def corners_of(mesh):
    return np.asarray(mesh.tangents)[mesh.indices]


def tangents_of(mesh):
    return np.asarray(mesh.tangents)


def check_frames(mesh):
    """Every tangent is finite, of unit length and in the plane of its normal."""
    assert mesh.tangents is not None
    assert len(mesh.tangents) == len(mesh.positions)
    np.testing.assert_allclose(np.linalg.norm(mesh.tangents[:, :3], axis=1), 1, atol=1e-6)
    np.testing.assert_allclose((mesh.tangents[:, :3] * mesh.normals).sum(axis=1), 0, atol=1e-6)
    assert set(np.unique(mesh.tangents[:, 3])) <= {-1, 1}


def lump(rng, **more):
    """A closed mesh without any symmetry, whose uvs have seams, and mirrored and stretched triangles."""
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    positions = ball.positions * (1, 0.7, 1.3) + rng.uniform(-0.1, 0.1, (len(ball.positions), 3))
    seams = rng.random(len(positions)) < 0.1
    uvs = positions[:, :2] @ rng.normal(size=(2, 2)) + rng.uniform(-0.2, 0.2, (len(positions), 2))
    uvs[seams] += 3
    return cc.Mesh(positions, ball.indices, uvs=uvs, **more)


@pytest.mark.parametrize("seed", range(6))
def test_a_lump_is_numpys(seed):
    mesh = lump(np.random.default_rng(seed))
    made = mesh.with_tangents()
    want = corner_tangents(mesh.positions, mesh.normals, mesh.uvs, mesh.indices)
    assert {-1, 1} == set(np.unique(want[..., 3]))
    np.testing.assert_allclose(corners_of(made), want, atol=2e-5)
    check_frames(made)
    # Only vertices were split, and the first ones are those of the mesh.
    count = len(mesh.positions)
    assert len(made.positions) > count
    for name in ("positions", "normals", "uvs"):
        np.testing.assert_array_equal(getattr(made, name)[:count], getattr(mesh, name))
        np.testing.assert_array_equal(
            getattr(made, name)[made.indices], getattr(mesh, name)[mesh.indices]
        )
    assert len(np.unique(np.c_[made.positions, made.tangents], axis=0)) == len(made.positions)


def test_vertices_that_are_equal_count_as_one(rng):
    """Triangles that share no vertex get the tangents that they get when they do."""
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    smooth = cc.Mesh(
        ball.positions, ball.indices, normals=ball.normals, uvs=rng.random((len(ball.positions), 2))
    )
    apart = {
        name: getattr(smooth, name)[smooth.indices].reshape(3 * len(smooth.indices), -1)
        for name in ("positions", "normals", "uvs")
    }
    loose = cc.Mesh(
        indices=np.arange(3 * len(smooth.indices)).reshape(-1, 3), **apart
    ).with_tangents()
    assert len(loose.positions) == 3 * len(smooth.indices)
    np.testing.assert_allclose(corners_of(loose), corners_of(smooth.with_tangents()), atol=1e-6)


def test_a_plane_has_the_axes():
    mesh = cc.Mesh.plane(2, 3).with_tangents()
    np.testing.assert_array_equal(mesh.tangents, np.tile([1, 0, 0, 1], (4, 1)))
    bitangent = np.cross(mesh.normals, tangents_of(mesh)[:, :3])
    np.testing.assert_array_equal(bitangent, np.tile([0, 0, -1], (4, 1)))


@pytest.mark.parametrize(
    ("matrix", "tangent", "sign"),
    [
        ([[1, 0], [0, 1]], (1, 0, 0), 1),
        ([[2, 0], [0, 0.5]], (1, 0, 0), 1),
        ([[0, -1], [1, 0]], (0, -1, 0), 1),
        ([[-1, 0], [0, 1]], (-1, 0, 0), -1),
        ([[1, 0], [0, -1]], (1, 0, 0), -1),
        ([[0, 1], [1, 0]], (0, 1, 0), -1),
        ([[1, 1], [0, 1]], (1, 0, 0), 1),
    ],
)
def test_uvs_that_are_turned_or_mirrored(matrix, tangent, sign):
    """uv = matrix @ (x, y): +u points along the first column of the inverse."""
    positions = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    mesh = quad(uvs=positions @ np.transpose(matrix)).with_tangents()
    want = np.linalg.inv(matrix)[:, 0]
    np.testing.assert_allclose(want / np.linalg.norm(want), tangent[:2], atol=1e-12)
    np.testing.assert_allclose(mesh.tangents, np.tile([*tangent, sign], (4, 1)), atol=1e-7)


@pytest.mark.parametrize("shape", ["sphere", "torus", "cylinder"])
def test_round_shapes_have_the_tangents_of_their_parallels(shape):
    """On these shapes u runs round the Y axis, from the right to the left of someone inside."""
    mesh = {
        "sphere": lambda: cc.Mesh.sphere(1, 96, 48),
        "torus": lambda: cc.Mesh.torus(1, 0.3, segments=96, sides=48),
        "cylinder": lambda: cc.Mesh.cylinder(1, 2, segments=96),
    }[shape]().with_tangents()
    check_frames(mesh)
    radius = np.hypot(mesh.positions[:, 0], mesh.positions[:, 2])
    upright = np.abs(mesh.normals[:, 1]) < 0.9
    seen = (radius > 0.3) & upright
    want = (
        np.c_[mesh.positions[:, 2], 0 * radius, -mesh.positions[:, 0]]
        / np.maximum(radius, 1e-9)[:, None]
    )
    cosine = (tangents_of(mesh)[:, :3] * want).sum(axis=1)[seen]
    assert seen.sum() > 90
    assert cosine.min() > np.cos(np.radians(2))
    assert (tangents_of(mesh)[seen, 3] == 1).all()


def test_where_the_uvs_are_mirrored_vertices_are_split():
    """A strip over x = -1..1 with u = |x|, as models with one texture for both halves have it."""
    x, y = np.meshgrid([-1.0, 0, 1], [0.0, 1], indexing="ij")
    mesh = cc.Mesh(
        np.c_[x.ravel(), y.ravel(), 0 * y.ravel()],
        [[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]],
        uvs=np.c_[np.abs(x).ravel(), y.ravel()],
    )
    made = mesh.with_tangents()
    assert len(made.positions) == 8
    for face, corner in zip(made.indices, corners_of(made), strict=True):
        side = -1 if made.positions[face, 0].min() < 0 else 1
        np.testing.assert_allclose(corner, np.tile([side, 0, 0, side], (3, 1)), atol=1e-7)
    np.testing.assert_array_equal(made.positions[6:, 0], 0)


def test_triangles_without_an_area_of_uvs_take_a_neighbours_tangent():
    """The second triangle's uvs are one point of the first: it has no direction of its own."""
    mesh = quad(uvs=[[0, 0], [0, 1], [1, 1], [0, 0]])
    first = corner_tangents(
        mesh.positions[:3], mesh.normals[:3], mesh.uvs[:3], np.array([[0, 1, 2]])
    )
    made = mesh.with_tangents()
    check_frames(made)
    np.testing.assert_allclose(corners_of(made)[0], first[0], atol=1e-6)
    np.testing.assert_array_equal(corners_of(made)[1, 0], corners_of(made)[0, 0])
    np.testing.assert_array_equal(corners_of(made)[1, 1], corners_of(made)[0, 2])


@pytest.mark.parametrize(
    "uvs",
    [np.zeros((4, 2)), np.full((4, 2), 0.25), [[0, 0], [1, 1], [2, 2], [3, 3]]],
    ids=["zero", "one point", "a line"],
)
def test_degenerate_uvs_give_finite_frames(uvs):
    check_frames(quad(uvs=uvs).with_tangents())


def test_degenerate_triangles_give_finite_frames(rng):
    mesh = cc.Mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0], [5, 5, 5]],
        [[0, 1, 2], [0, 1, 3], [1, 1, 1], [0, 0, 2]],
        uvs=rng.random((5, 2)),
    )
    check_frames(mesh.with_tangents())


def test_edges_of_many_triangles_and_of_opposite_windings(rng):
    positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    mesh = cc.Mesh(
        positions, [[0, 1, 2], [0, 1, 3], [1, 0, 4], [1, 0, 5], [0, 1, 4]], uvs=rng.random((6, 2))
    )
    check_frames(mesh.with_tangents())


def test_the_second_set_of_uvs(rng):
    mesh = lump(rng, uvs1=rng.random((COUNT, 2)))
    other = cc.Mesh(mesh.positions, mesh.indices, uvs=mesh.uvs1)
    np.testing.assert_array_equal(
        corners_of(mesh.with_tangents(uv_set=1)), corners_of(other.with_tangents())
    )
    with pytest.raises(ValueError, match="expected a mesh with uvs1, got none"):
        quad().with_tangents(uv_set=1)
    with pytest.raises(ValueError, match="expected a mesh with uvs, got none"):
        quad().with_tangents()
    with pytest.raises(ValueError, match="uv_set: expected an int from 0 to 1, got 2"):
        quad().with_tangents(uv_set=2)


def test_all_streams_follow_their_vertices(rng):
    mesh = lump(rng, colors=rng.random((COUNT, 4)), uvs1=rng.random((COUNT, 2)))
    made = mesh.with_tangents()
    for name in ("positions", "normals", "uvs", "uvs1", "colors"):
        np.testing.assert_array_equal(
            getattr(made, name)[made.indices], getattr(mesh, name)[mesh.indices]
        )
    np.testing.assert_array_equal(made.bounds, mesh.bounds)


def test_the_result_is_kept_until_the_mesh_changes(rng):
    mesh = lump(rng)
    one, other = mesh.with_tangents(), mesh.with_tangents()
    assert one is not other
    assert np.shares_memory(one.tangents, other.tangents)
    mesh.colors = rng.random((COUNT, 3))
    assert np.shares_memory(mesh.with_tangents().tangents, one.tangents)
    assert np.shares_memory(mesh.with_tangents().indices, one.indices)
    mesh.uvs = rng.random((COUNT, 2))
    want = cc.Mesh(mesh.positions, mesh.indices, uvs=mesh.uvs).with_tangents()
    np.testing.assert_array_equal(corners_of(mesh.with_tangents()), corners_of(want))
    mesh.positions = mesh.positions * (1, 2, 3)
    want = cc.Mesh(mesh.positions, mesh.indices, uvs=mesh.uvs).with_tangents()
    np.testing.assert_array_equal(corners_of(mesh.with_tangents()), corners_of(want))


def test_tangents_that_are_given(rng):
    given = np.c_[rng.normal(size=(4, 3)), [1, -1, 1, -1]]
    mesh = quad(tangents=given)
    want = given[:, :3] / np.linalg.norm(given[:, :3], axis=1, keepdims=True)
    np.testing.assert_allclose(mesh.tangents, np.c_[want, given[:, 3]], atol=1e-6)
    again = quad(tangents=mesh.tangents)
    np.testing.assert_array_equal(again.tangents, mesh.tangents)
    with pytest.raises(ValueError, match="read-only"):
        mesh.tangents[0] = 0
    mesh.positions = mesh.positions * 2
    np.testing.assert_array_equal(again.tangents, mesh.tangents)
    mesh.tangents = None
    assert mesh.tangents is None


def test_tangents_of_no_length_get_a_direction():
    mesh = quad(tangents=[[0, 0, 0, -1]] * 4)
    check_frames(mesh)
    assert (mesh.tangents[:, 3] == -1).all()


def test_flat_faces_keep_given_tangents(rng):
    mesh = lump(
        rng,
        tangents=np.c_[rng.normal(size=(COUNT, 3)), np.ones(COUNT)],
        uvs1=rng.random((COUNT, 2)),
    )
    flat = mesh.flat_shaded()
    for name in ("tangents", "uvs1"):
        want = getattr(mesh, name)[mesh.indices].reshape(len(flat.positions), -1)
        np.testing.assert_array_equal(getattr(flat, name), want)


@copies
def test_copies(rng, make_copy):
    mesh = lump(rng, uvs1=rng.random((COUNT, 2))).with_tangents()
    copy = make_copy(mesh)
    for name in ("positions", "normals", "uvs", "uvs1", "tangents", "indices"):
        np.testing.assert_array_equal(getattr(copy, name), getattr(mesh, name))
    assert pickle.loads(pickle.dumps(quad())).tangents is None


BAD = {
    "a sign of 0.5": (
        {"tangents": [[1, 0, 0, 0.5]] * 4},
        r"fourth number of 1 or -1, got \(1, 0, 0, 0.5\) at vertex 0",
    ),
    "three numbers": ({"tangents": np.ones((4, 3))}, r"tangents: expected shape \(4, 4\)"),
    "tangents of 3 vertices": ({"tangents": np.ones((3, 4))}, r"tangents: expected shape \(4, 4\)"),
    "tangents nan": ({"tangents": np.full((4, 4), np.nan)}, "tangents.*nan"),
    "uvs1 of 3 vertices": ({"uvs1": np.zeros((3, 2))}, r"uvs1: expected shape \(4, 2\)"),
    "uvs1 nan": ({"uvs1": np.full((4, 2), np.nan)}, "uvs1.*nan"),
}


@pytest.mark.parametrize(("change", "text"), BAD.values(), ids=BAD)
def test_what_is_refused(rng, change, text):
    mesh = quad(uvs1=rng.random((4, 2)), tangents=[[1, 0, 0, 1]] * 4)
    before = mesh.uvs1.copy(), mesh.tangents.copy()
    with pytest.raises(ValueError, match=text):
        mesh.update(**{"positions": np.ones((4, 3)), **change})
    np.testing.assert_array_equal(mesh.uvs1, before[0])
    np.testing.assert_array_equal(mesh.tangents, before[1])
    with pytest.raises(ValueError, match=next(iter(change))):
        quad(**change)
