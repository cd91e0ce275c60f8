"""Meshes: primitives are closed, face outward and have uvs; smooth normals; mesh files."""

import threading

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.helpers import copies

CLOSED = {
    "box": (lambda: cc.Mesh.box((1, 2, 3)), 6.0),
    "cube": (lambda: cc.Mesh.box(2), 8.0),
    "sphere": (lambda: cc.Mesh.sphere(0.5), np.pi / 6),
    "icosphere": (lambda: cc.Mesh.icosphere(0.5), np.pi / 6),
    "cylinder": (lambda: cc.Mesh.cylinder(0.5, 2), np.pi / 2),
    "cone": (lambda: cc.Mesh.cone(0.5, 3), np.pi / 4),
    "torus": (lambda: cc.Mesh.torus(1, 0.25), 2 * np.pi**2 / 16),
    "arrow": (
        lambda: cc.Mesh.arrow(3, radius=0.2, head_length=1, head_radius=0.5),
        np.pi * (0.04 * 2 + 0.25 / 3),
    ),
}
closed = pytest.mark.parametrize(("make", "volume"), CLOSED.values(), ids=CLOSED)
every = pytest.mark.parametrize(
    "make",
    [make for make, _ in CLOSED.values()] + [lambda: cc.Mesh.plane(2, 3)],
    ids=[*CLOSED, "plane"],
)


def corners(mesh):
    return mesh.positions.astype(float)[mesh.indices]


def face_normals(mesh):
    c = corners(mesh)
    return np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0])


@closed
def test_every_edge_has_two_triangles_that_pass_it_in_opposite_directions(make, volume):
    mesh = make()
    _, welded = np.unique(np.round(mesh.positions, 5) + 0.0, axis=0, return_inverse=True)
    triangles = welded.reshape(-1)[mesh.indices]
    triangles = triangles[
        (triangles != np.roll(triangles, 1, axis=1)).all(1)
    ]  # poles may hold slivers
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    forward = {tuple(edge) for edge in edges.tolist()}
    assert len(forward) == len(edges)
    assert forward == {(b, a) for a, b in forward}


@closed
def test_volume_is_positive_and_right(make, volume):
    c = corners(make())
    got = np.einsum("ij,ij->i", c[:, 0], np.cross(c[:, 1], c[:, 2])).sum() / 6
    assert got == pytest.approx(volume, rel=0.02)


@every
def test_normals_are_unit_and_on_the_side_of_the_winding(make):
    mesh = make()
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=-1), 1, atol=1e-5)
    flat = face_normals(mesh)
    real = np.linalg.norm(flat, axis=-1) > 1e-9
    assert real.sum() >= 2
    assert (np.einsum("ij,ikj->ik", flat[real], mesh.normals[mesh.indices][real]) > 0).all()


@every
def test_uvs_fill_the_unit_square_and_jump_nowhere(make):
    """Seams have their own vertices, so no triangle covers the whole width of the picture backwards."""
    mesh = make()
    assert mesh.uvs.min() >= -1e-6
    assert (
        mesh.uvs.max() < 1.26
    )  # an icosphere's seam triangles end beyond 1, where pictures repeat
    assert np.ptp(mesh.uvs, axis=0).min() > 0.9
    if len(mesh.indices) > 12:
        assert np.ptp(mesh.uvs[mesh.indices], axis=1)[:, 0].max(initial=0) < 0.6


@every
def test_bounds_are_centered(make):
    if make is CLOSED["arrow"][0]:
        return  # it starts at the origin: test_an_arrow_goes_from_the_origin_along_z
    positions = make().positions
    np.testing.assert_allclose(positions.min(0) + positions.max(0), 0, atol=2e-2)


def test_sizes():
    np.testing.assert_allclose(np.ptp(cc.Mesh.box((1, 2, 3)).positions, axis=0), [1, 2, 3])
    np.testing.assert_allclose(np.ptp(cc.Mesh.box(2).positions, axis=0), 2)
    np.testing.assert_allclose(np.ptp(cc.Mesh.plane(2, 3).positions, axis=0), [2, 0, 3])
    for mesh in (cc.Mesh.sphere(0.7), cc.Mesh.icosphere(0.7)):
        np.testing.assert_allclose(np.linalg.norm(mesh.positions, axis=-1), 0.7, atol=1e-6)
        np.testing.assert_allclose(mesh.normals, mesh.positions / 0.7, atol=1e-5)
    cylinder = cc.Mesh.cylinder(0.5, 4).positions
    assert np.ptp(cylinder[:, 1]) == pytest.approx(4)
    np.testing.assert_allclose(np.hypot(cylinder[:, 0], cylinder[:, 2]).max(), 0.5, atol=1e-6)
    tube = cc.Mesh.torus(2, 0.5).positions
    ring = np.hypot(tube[:, 0], tube[:, 2]) - 2
    np.testing.assert_allclose(np.hypot(ring, tube[:, 1]), 0.5, atol=1e-5)


def test_cone_points_up():
    positions = cc.Mesh.cone(0.5, 3).positions
    assert np.abs(positions[positions[:, 1] > 1.49][:, [0, 2]]).max() < 1e-5


def test_an_arrow_goes_from_the_origin_along_z():
    p = cc.Mesh.arrow(3, radius=0.2, head_length=1, head_radius=0.5).positions
    radius, height = np.hypot(p[:, 0], p[:, 1]), p[:, 2]
    circles = {
        (round(float(r), 5), round(float(z), 5)) for r, z in zip(radius, height, strict=True)
    }
    assert circles == {(0, 0), (0.2, 0), (0.2, 2), (0.5, 2), (0, 3)}
    mesh = cc.Mesh.arrow(3)
    np.testing.assert_allclose(mesh.bounds, [[-0.3, -0.3, 0], [0.3, 0.3, 3]], atol=1e-6)
    assert len(cc.Mesh.arrow(segments=16).indices) == 6 * 16


def test_the_uvs_of_an_arrow_run_round_and_along_it():
    mesh = cc.Mesh.arrow(2, segments=8)
    side = np.abs(mesh.normals[:, 2]) < 0.9  # the shaft and the head; the rest is flat
    assert mesh.uvs is not None
    np.testing.assert_allclose(mesh.uvs[side, 1], mesh.positions[side, 2] / 2, atol=1e-6)
    flat = cc.Mesh.cylinder(0.1, 2, segments=8)
    assert flat.uvs is not None
    shaft = side & (np.abs(mesh.normals[:, 2]) < 1e-6)
    np.testing.assert_allclose(np.unique(mesh.uvs[shaft, 0]), np.unique(flat.uvs[:18, 0]))


def test_plane_faces_up_with_uv_0_0_where_a_picture_reads_upright():
    mesh = cc.Mesh.plane(2, 4)
    np.testing.assert_array_equal(mesh.normals, np.broadcast_to([0, 1, 0], mesh.normals.shape))
    assert mesh.uvs is not None
    origin = mesh.positions[np.abs(mesh.uvs).sum(-1).argmin()]
    np.testing.assert_allclose(origin, [-1, 0, 2])


def angle_weighted(positions, triangles):
    """Normals by Thuermer and Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998."""
    total = np.zeros_like(positions)
    for triangle in triangles:
        p = positions[triangle]
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        normal = normal / np.linalg.norm(normal)
        for k in range(3):
            a, b = p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]
            angle = np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1))
            total[triangle[k]] += angle * normal
    return total / np.linalg.norm(total, axis=-1, keepdims=True)


def test_missing_normals_are_smooth(rng):
    positions = rng.normal(size=(40, 3))
    triangles = np.stack([rng.permutation(40)[:3] for _ in range(80)])
    used = np.unique(triangles)
    got = cc.Mesh(positions, triangles).normals
    assert_close(got[used], angle_weighted(positions, triangles)[used], "normal")


def test_smooth_normals_of_a_cube_do_not_depend_on_its_diagonals():
    corner = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    box = cc.Mesh.box(2)
    welded = [int(np.abs(corner - p).sum(-1).argmin()) for p in box.positions]
    mesh = cc.Mesh(corner, np.array(welded)[box.indices])
    np.testing.assert_allclose(mesh.normals, corner / np.sqrt(3), atol=1e-6)


def test_given_normals_are_kept(rng):
    normals = np.eye(3, dtype=np.float32)
    mesh = cc.Mesh(rng.normal(size=(3, 3)), [[0, 1, 2]], normals=normals)
    np.testing.assert_allclose(mesh.normals, normals)


def test_degenerate_triangles_do_no_harm():
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], [[0, 1, 2], [0, 0, 1], [3, 3, 3]])
    assert np.isfinite(mesh.normals).all()
    np.testing.assert_allclose(mesh.normals[:3], [[0, 0, 1]] * 3)


def test_optional_arrays_are_none_unless_given():
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert mesh.uvs is None
    assert mesh.colors is None


def test_arrays_are_read_only():
    mesh = cc.Mesh.box(1)
    for array in (mesh.positions, mesh.indices, mesh.normals, mesh.uvs):
        assert array is not None
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@copies
def test_copies(make_copy):
    mesh = cc.Mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], uvs=np.eye(3)[:, :2], colors=np.eye(3)
    )
    other = make_copy(mesh)
    for name in ("positions", "indices", "normals", "uvs", "colors"):
        np.testing.assert_array_equal(getattr(other, name), getattr(mesh, name))


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: cc.Mesh.sphere(0), "radius"),
        (lambda: cc.Mesh.sphere(-1), "radius"),
        (lambda: cc.Mesh.sphere(np.nan), "radius"),
        (lambda: cc.Mesh.sphere(1, segments=2), "segments"),
        (lambda: cc.Mesh.box((1, 0, 1)), "size"),
        (lambda: cc.Mesh.box(-1), "size"),
        (lambda: cc.Mesh.plane(np.inf, 1), "width"),
        (lambda: cc.Mesh.torus(1, 0), "tube"),
        (lambda: cc.Mesh.arrow(0), "length"),
        (lambda: cc.Mesh.arrow(1, radius=-1), "radius"),
        (lambda: cc.Mesh.arrow(1, head_length=1), "a head shorter than the arrow, got head_length"),
        (lambda: cc.Mesh.arrow(1, radius=0.2, head_radius=0.2), "a head wider than the shaft"),
        (lambda: cc.Mesh.arrow(1, segments=2), "segments"),
        (lambda: cc.Mesh.icosphere(1, subdivisions=-1), "subdivisions"),
        (lambda: cc.Mesh.icosphere(1, subdivisions=30), "subdivisions"),
    ],
)
def test_bad_sizes_are_refused(make, text):
    with pytest.raises(ValueError, match=text):
        make()


@pytest.mark.parametrize(
    ("name", "vertices", "triangles"), [("bunny", 1839, 3674), ("teapot", 792, 992)]
)
def test_sample_meshes(name, vertices, triangles):
    mesh = cc.load_mesh(cc.sample_data(f"{name}.obj"))
    assert len(mesh.indices) == triangles
    assert len(mesh.positions) <= vertices
    assert np.ptp(mesh.positions, axis=0).max() > 5


@pytest.mark.parametrize("size", [1, 2.5])
def test_size_centers_and_scales(size):
    positions = cc.load_mesh(cc.sample_data("bunny.obj"), size=size).positions
    low, high = positions.min(0), positions.max(0)
    np.testing.assert_allclose(low + high, 0, atol=1e-5)
    assert (high - low).max() == pytest.approx(size, rel=1e-5)


@pytest.mark.parametrize("size", [0, -1, np.nan, np.inf])
def test_bad_load_sizes_are_refused(size):
    with pytest.raises(ValueError, match="size"):
        cc.load_mesh(cc.sample_data("bunny.obj"), size=size)


@pytest.mark.parametrize("ending", ["obj", "ply", "stl", "glb"])
def test_formats(ending, tmp_path):
    import trimesh

    box = trimesh.creation.box((1, 2, 3))
    path = tmp_path / f"a.{ending}"
    box.export(path)
    mesh = cc.load_mesh(path)
    assert len(mesh.indices) == 12
    np.testing.assert_allclose(np.ptp(mesh.positions, axis=0), [1, 2, 3], rtol=1e-5)
    c = corners(mesh)
    assert np.einsum("ij,ij->i", c[:, 0], np.cross(c[:, 1], c[:, 2])).sum() / 6 == pytest.approx(6)


def test_glb_places_its_nodes(tmp_path):
    import trimesh

    scene = trimesh.Scene()
    scene.add_geometry(
        trimesh.creation.box((1, 1, 1)),
        transform=trimesh.transformations.translation_matrix((4, 0, 0)),
    )
    scene.add_geometry(trimesh.creation.box((1, 1, 1)))
    scene.export(tmp_path / "a.glb")
    positions = cc.load_mesh(tmp_path / "a.glb").positions
    np.testing.assert_allclose([positions.min(0)[0], positions.max(0)[0]], [-0.5, 4.5])


TRANSFORMS = {
    "stretched": np.diag([3.0, 1, 1, 1]),
    "mirrored": np.diag([-1.0, 1, 1, 1]),
    "mirrored and sheared": np.array(
        [[-2, 0.5, 0, 1], [0, 1, 0.3, 2], [0.2, 0, 0.7, 3], [0, 0, 0, 1.0]]
    ),
}


@pytest.mark.parametrize("matrix", TRANSFORMS.values(), ids=TRANSFORMS)
def test_normals_of_a_glb_node_go_by_the_inverse_transpose(tmp_path, matrix):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=1)
    places = np.array(ball.vertices)
    scene = trimesh.Scene()
    scene.add_geometry(
        trimesh.Trimesh(places, ball.faces, vertex_normals=places, process=False), transform=matrix
    )
    (tmp_path / "a.glb").write_bytes(trimesh.exchange.gltf.export_glb(scene, include_normals=True))
    mesh = cc.load_mesh(tmp_path / "a.glb")
    linear = matrix[:3, :3]
    # Each vertex of the unit ball is its own normal.
    on_ball = (np.asarray(mesh.positions) - matrix[:3, 3]) @ np.linalg.inv(linear).T
    want = on_ball @ np.linalg.inv(linear)
    want /= np.linalg.norm(want, axis=1, keepdims=True)
    np.testing.assert_allclose(mesh.normals, want, atol=1e-5)
    a, b, c = np.moveaxis(corners(mesh), 1, 0)
    faced = np.cross(b - a, c - a)
    assert (np.einsum("ij,ij->i", faced, want[np.asarray(mesh.indices)[:, 0]]) > 0).all()


STREAMS = {"positions": 3, "normals": 3, "uvs": 2, "colors": 4, "uvs1": 2, "tangents": 4}


def random_values(rng, name):
    values = rng.random((4, STREAMS[name]))
    if name == "tangents":
        values[:, 3] = 1
    return values


def quad(**more):
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    return cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]], **more)


def by_update(mesh, name, value):
    mesh.update(**{name: value})


@pytest.mark.parametrize("change", [by_update, setattr], ids=["update", "property"])
@pytest.mark.parametrize("name", STREAMS)
def test_vertices_set_anew_are_those_of_a_new_mesh(rng, name, change):
    given = {n: random_values(rng, n) for n in STREAMS}
    mesh = cc.Mesh(indices=[[0, 1, 2], [0, 2, 3]], **given)
    given[name] = random_values(rng, name)
    change(mesh, name, given[name])
    wanted = cc.Mesh(indices=[[0, 1, 2], [0, 2, 3]], **given)
    for other in STREAMS:
        np.testing.assert_array_equal(getattr(mesh, other), getattr(wanted, other))
    np.testing.assert_array_equal(mesh.bounds, wanted.bounds)


def test_arrays_handed_out_keep_their_values(rng):
    mesh = quad(**{n: random_values(rng, n) for n in STREAMS if n != "positions"})
    before = {name: getattr(mesh, name) for name in STREAMS}
    copies = {name: array.copy() for name, array in before.items()}
    mesh.update(**{name: random_values(rng, name) for name in STREAMS})
    for name, array in before.items():
        np.testing.assert_array_equal(array, copies[name])
        assert not np.array_equal(getattr(mesh, name), array)
        with pytest.raises(ValueError, match="read-only"):
            getattr(mesh, name)[0] = 0
    positions = mesh.positions
    del mesh
    assert np.isfinite(positions).all()


def test_the_callers_array_is_copied():
    mesh, positions = quad(), np.zeros((4, 3), np.float32)
    mesh.update(positions=positions)
    positions[:] = 7
    np.testing.assert_array_equal(mesh.positions, 0)


def test_smooth_normals_follow_the_positions():
    mesh = quad()
    mesh.positions = mesh.positions[:, [0, 2, 1]]
    np.testing.assert_allclose(mesh.normals, [[0, -1, 0]] * 4)


def test_given_normals_stay_where_the_positions_are_set():
    mesh = quad(normals=[[1, 0, 0]] * 4)
    mesh.positions = mesh.positions[:, [0, 2, 1]]
    np.testing.assert_array_equal(mesh.normals, [[1, 0, 0]] * 4)


def test_normals_set_once_are_given_and_none_makes_them_smooth_again():
    mesh = quad()
    mesh.update(normals=[[0, 3, 0]] * 4)
    mesh.positions = mesh.positions * 2
    np.testing.assert_array_equal(mesh.normals, [[0, 1, 0]] * 4)
    mesh.normals = None
    np.testing.assert_allclose(mesh.normals, [[0, 0, 1]] * 4)
    mesh.positions = mesh.positions[:, [0, 2, 1]]
    np.testing.assert_allclose(mesh.normals, [[0, -1, 0]] * 4)


@copies
@pytest.mark.parametrize("normals", [None, [[1, 0, 0]] * 4], ids=["smooth", "given"])
def test_the_normals_of_a_copy_follow_its_positions_alike(make_copy, normals):
    mesh = quad(normals=normals)
    other = make_copy(mesh)
    for each in (mesh, other):
        each.positions = each.positions[:, [0, 2, 1]]
    np.testing.assert_array_equal(other.normals, mesh.normals)


@copies
def test_a_copy_is_a_mesh_of_its_own(make_copy):
    mesh = quad()
    make_copy(mesh).positions = np.zeros((4, 3))
    assert mesh.positions.any()


def test_normals_of_no_length_become_smooth_in_an_update():
    mesh = quad(normals=[[1, 0, 0]] * 4)
    mesh.update(normals=[[0, 2, 0], [0, 0, 0], [0, 1, 0], [0, 1, 0]])
    np.testing.assert_allclose(mesh.normals, [[0, 1, 0], [0, 0, 1], [0, 1, 0], [0, 1, 0]])


def test_uvs_and_colors_may_come_and_go(rng):
    mesh = quad()
    mesh.update(uvs=np.zeros((4, 2)), colors=np.full((4, 3), 255, np.uint8))
    np.testing.assert_array_equal(mesh.uvs, 0)
    np.testing.assert_array_equal(mesh.colors, 1)
    mesh.uvs = mesh.colors = None
    assert mesh.uvs is None
    assert mesh.colors is None


BAD_UPDATES = {
    "positions of 3 vertices": (
        {"positions": np.zeros((3, 3))},
        ValueError,
        r"expected shape \(4, 3\)",
    ),
    "positions of 2": ({"positions": np.zeros((4, 2))}, ValueError, r"got \(4, 2\)"),
    "positions nan": ({"positions": np.full((4, 3), np.nan)}, ValueError, "nan"),
    "positions bool": ({"positions": np.zeros((4, 3), bool)}, TypeError, "positions"),
    "normals of 5 vertices": ({"normals": np.zeros((5, 3))}, ValueError, "normals"),
    "no normals": ({"normals": np.zeros((0, 3))}, ValueError, "normals"),
    "uvs of 3 vertices": ({"uvs": np.zeros((3, 2))}, ValueError, "uvs"),
    "colors of 2": ({"colors": np.zeros((4, 2))}, ValueError, r"\(4, 3\) or \(4, 4\)"),
    "alpha of 2": ({"colors": np.full((4, 4), 2.0)}, ValueError, "alpha"),
}


@pytest.mark.parametrize(("change", "error", "text"), BAD_UPDATES.values(), ids=BAD_UPDATES)
def test_a_refused_update_changes_nothing(rng, change, error, text):
    mesh = quad(**{n: random_values(rng, n) for n in STREAMS if n != "positions"})
    before = {name: getattr(mesh, name).copy() for name in STREAMS}
    good = {"positions": np.ones((4, 3)), "uvs": np.ones((4, 2))}
    with pytest.raises(error, match=text):
        mesh.update(**{**good, **change})
    for name, array in before.items():
        np.testing.assert_array_equal(getattr(mesh, name), array)


def test_positions_cannot_be_none():
    with pytest.raises(TypeError, match="positions"):
        quad().positions = None


def test_update_takes_names_only():
    with pytest.raises(TypeError):
        quad().update(np.zeros((4, 3)))


@pytest.mark.parametrize("vertices", [3, 4, 5, 6, 7, 8, 9, 4097])
def test_bounds_are_those_of_numpy(rng, vertices):
    positions = rng.normal(size=(vertices, 3)).astype(np.float32)
    mesh = cc.Mesh(positions, [[0, 1, 2]])
    np.testing.assert_array_equal(mesh.bounds, [positions.min(0), positions.max(0)])


@pytest.mark.parametrize("place", [0, 2500, 4999])
def test_one_normal_of_many_is_made_unit_length(rng, place):
    normals = np.tile(np.array([0, 0, 1], np.float32), (5000, 1))
    normals[place] = (0, 4, 3)
    mesh = cc.Mesh(rng.normal(size=(5000, 3)), [[0, 1, 2]], normals=normals)
    normals[place] = (0, 0.8, 0.6)
    np.testing.assert_allclose(mesh.normals, normals, atol=1e-7)


def test_updates_of_two_threads_are_both_kept(rng):
    mesh = cc.Mesh(rng.random((20_000, 3)), [[0, 1, 2]], normals=np.ones((20_000, 3)))
    for turn in range(20):
        positions = np.full((20_000, 3), turn + 1.0)
        colors = np.full((20_000, 3), turn + 1.0)
        threads = [
            threading.Thread(target=mesh.update, kwargs={"positions": positions}),
            threading.Thread(target=mesh.update, kwargs={"colors": colors}),
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert mesh.positions[0, 0] == turn + 1
        assert mesh.colors is not None
        assert mesh.colors[0, 0] == turn + 1
