"""Rays by Embree against the oracle's rays and the renderer, and what must hold for rays from surfaces."""

import sys

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.scene.snapshot import read
from cubecam.truth.shading import normalised
from cubecam.truth.surfaces.geometry import Geometry
from cubecam.truth.surfaces.points import surface_points
from tests.compare import assert_close
from tests.reference import raycast
from tests.reference import transforms as ref
from tests.truth.rays import ids_of, random_directions, random_world, seen

pytest.importorskip("embreex")


@pytest.mark.parametrize("seed", range(4))
def test_rays_meet_what_the_oracle_finds(rng, seed):
    world = random_world(seed)
    directions = random_directions(rng, 3000)
    origins = rng.uniform(-1, 1, (3000, 3))
    want = raycast.cast(world.shapes, origins, directions)
    snapshot = read(world.scene)
    hits = Geometry(snapshot).cast(origins, directions)
    assert 0.2 < want.hit.mean() < 0.98
    same = ids_of(snapshot, hits) == want.id
    # Embree's directions are float32: a ray within 1e-7 of an edge may pass on its other side.
    assert same.mean() > 0.999
    both = same & want.hit
    np.testing.assert_allclose(hits.distance[both], want.distance[both], rtol=1e-9)
    points = surface_points(snapshot, hits, directions).take(both[hits.triangle >= 0])
    np.testing.assert_allclose(points.position, want.position[both], atol=1e-8)
    # The oracle turns interpolated normals to the viewer; the renderer turns those of back faces.
    towards = (points.normal * points.v).sum(axis=1) > 0
    assert_close(points.normal, want.normal[both], "float32_maths", mask=towards, least=0.95)


@pytest.mark.parametrize("seed", range(2))
def test_pixels_show_what_rays_meet(renderer, seed):
    world = random_world(seed)
    size = (96, 64)
    camera = cc.PerspectiveCamera(position=(2, 3, 9), fov=55)
    snapshot, hits, _origins, directions = seen(world.scene, camera, size)
    frame = renderer.render(
        world.scene, camera, size, outputs=("id", "distance", "position", "normal")
    )
    ids = ids_of(snapshot, hits).reshape(64, 96)
    inner = raycast.interior(ids, frame.id)
    assert (ids > 0).mean() > 0.2
    assert np.array_equal(ids[inner], frame.id[inner])
    assert (ids != frame.id).mean() < 0.01
    points = surface_points(snapshot, hits, directions)
    steep = (points.normal * points.v).sum(axis=1) > 0.1
    rows = points.row[steep]
    chosen = np.zeros(64 * 96, bool)
    chosen[rows] = True
    chosen = chosen.reshape(64, 96) & inner
    for name, values, tolerance in (
        ("distance", hits.distance, "distance"),
        ("position", scattered(points, points.position), "position"),
        ("normal", scattered(points, points.normal), "normal"),
    ):
        got = values.reshape(64, 96, *values.shape[1:])
        assert_close(
            getattr(frame, name)[chosen], got[chosen].astype(np.float32), tolerance, name=name
        )


def scattered(points, values):
    found = np.zeros((64 * 96, values.shape[1]))
    found[points.row] = values
    return found


def glass_ball(**more):
    scene = cc.Scene()
    ball = scene.add(cc.Mesh.icosphere(1, subdivisions=4), cc.GlassMaterial(), **more)
    return scene, ball


@pytest.mark.parametrize("scale", [1, (-1, 1, 1)])
def test_rays_in_a_body_meet_its_back(rng, scale):
    scene, _ball = glass_ball(scale=scale)
    scene.add(cc.Mesh.box(0.2), cc.PhongMaterial(), position=(0, 0, 0))
    snapshot = read(scene)
    geometry = Geometry(snapshot)
    origins = random_directions(rng, 500) * 0.6
    directions = random_directions(rng, 500)
    outside = geometry.cast(origins, directions)
    inside = geometry.cast(origins, directions, np.zeros(500, np.int64))
    nodes = snapshot.node[inside.triangle]
    assert np.all(inside.triangle >= 0)
    assert set(nodes) == {0, 1}, "other nodes are met as ever"
    assert set(snapshot.node[outside.triangle[outside.triangle >= 0]]) == {1}
    ends = origins + inside.distance[:, None] * directions
    np.testing.assert_allclose(np.linalg.norm(ends[nodes == 0], axis=1), 1, atol=0.01)
    # The way of a ray that comes from outside: it meets the front, goes on from there, and meets the back.
    start = np.array([[0.1, 0.2, 5.0]])
    forward = np.array([[0, 0, -1.0]])
    first = geometry.cast(start, forward)
    at = start + first.distance[:, None] * forward
    other = Geometry(snapshot, snapshot.node == 0).cast(
        at, forward, np.array([0]), start=first.triangle
    )
    np.testing.assert_allclose(other.distance, 2 * np.sqrt(1 - 0.05), atol=0.02)


def test_both_sides_of_a_leaf_are_seen():
    scene = cc.Scene()
    top = scene.add(cc.Mesh.plane(2, 2), cc.BasicMaterial())
    under = scene.add(
        cc.Mesh.plane(2, 2), cc.BasicMaterial(), rotation=cc.axis_angle((1, 0, 0), 180)
    )
    snapshot = read(scene)
    grid = np.stack(np.meshgrid(np.linspace(-0.9, 0.9, 30), np.linspace(-0.9, 0.9, 30)), -1)
    origins = np.insert(grid.reshape(-1, 2), 1, 3, axis=1)
    for height, seen_one in ((3, top), (-3, under)):
        origins[:, 1] = height
        directions = np.broadcast_to((0.0, -np.sign(height), 0.0), origins.shape)
        hits = Geometry(snapshot).cast(origins, directions)
        assert np.all(ids_of(snapshot, hits) == seen_one.id)
        np.testing.assert_allclose(hits.distance, 3, rtol=1e-12)


def test_many_back_faces_are_passed():
    scene = cc.Scene()
    for index in range(50):
        scene.add(cc.Mesh.plane(2, 2), cc.BasicMaterial(), position=(0, 1 + 1e-4 * index, 0))
    last = scene.add(
        cc.Mesh.plane(2, 2),
        cc.BasicMaterial(),
        position=(0, 1.1, 0),
        rotation=cc.axis_angle((1, 0, 0), 180),
    )
    snapshot = read(scene)
    origins = np.zeros((20, 3))
    directions = np.array([(x, 1, 0.1) for x in np.linspace(-0.5, 0.5, 20)])
    hits = Geometry(snapshot).cast(origins, directions)
    assert np.all(ids_of(snapshot, hits) == last.id)
    np.testing.assert_allclose(hits.distance, 1.1, rtol=1e-7)


@pytest.mark.parametrize("middle", [(0, 0, 0), (1, 2, 3), (-8000, 300, 5000)])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e4])
def test_surfaces_neither_hide_nor_shade_themselves(rng, size, middle):
    """A sphere of 100,000 triangles: no reflected ray meets it again, and its lit side has no dark spots."""
    place = np.array(middle) * min(size, 1)
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1, 320, 160), cc.PhongMaterial(), position=place, scale=size)
    snapshot = read(scene)
    assert len(snapshot.corners) > 1e5
    geometry = Geometry(snapshot)
    directions = -random_directions(rng, 4000)
    origins = place - 3 * size * directions + size * rng.uniform(-0.5, 0.5, (4000, 3))
    hits = geometry.cast(origins, directions)
    points = surface_points(snapshot, hits, directions, origins)
    assert len(points) > 3000
    mirrored = 2 * (points.face_normal * points.v).sum(axis=1, keepdims=True) * points.face_normal
    again = geometry.cast(points.position, mirrored - points.v, start=points.triangle)
    assert np.all(again.triangle < 0)
    light = place + np.array((3, 5, 2)) * size
    way = light - points.lifted
    lit = (points.normal * way).sum(axis=1) > 0
    dark = geometry.blocked(points.lifted, way, np.ones(len(way)), start=points.triangle)
    assert 0.2 < lit.mean() < 0.8
    assert not np.any(dark[lit])
    beyond = (points.normal * way).sum(axis=1) < -0.3 * np.linalg.norm(way, axis=1)
    assert np.all(dark[beyond])


def test_the_triangle_that_a_ray_leaves_never_counts():
    """A lifted point lies above its triangle, so that a flat ray to a light may run through it."""
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(2, 2), cc.PhongMaterial(double_sided=True))
    geometry = Geometry(read(scene))
    above, down = np.array([[0.3, 0.01, 0.2]]), np.array([[0.1, -1, 0.0]])
    hits = geometry.cast(above, down)
    assert hits.distance[0] == pytest.approx(0.01)
    assert geometry.cast(above, down, start=hits.triangle).triangle[0] == -1
    assert geometry.blocked(above, down, np.array([1.0]))
    assert not geometry.blocked(above, down, np.array([1.0]), start=hits.triangle)
    assert geometry.blocked(above, down, np.array([1.0]), start=np.array([-1]))


def test_origins_on_a_surface_do_not_meet_it(rng):
    """Even without its triangle, up to the rounding of float64: both sides of this surface would count."""
    scene = cc.Scene()
    turn = cc.axis_angle((1, 2, 3), 50)
    scene.add(cc.Mesh.plane(2, 2), cc.PhongMaterial(double_sided=True), rotation=turn)
    matrix = ref.rotation(turn)[:3, :3]
    origins = np.insert(rng.uniform(-0.9, 0.9, (500, 2)), 1, 0, axis=1) @ matrix.T
    directions = random_directions(rng, 500)
    geometry = Geometry(read(scene))
    assert np.all(geometry.cast(origins, directions).triangle == -1)
    assert not np.any(geometry.blocked(origins, directions, np.full(500, np.inf)))
    behind = origins - 1e-9 * matrix[:, 1]
    hits = geometry.cast(behind, directions)
    upwards = directions @ matrix[:, 1] > 0
    assert np.all(hits.triangle[~upwards] == -1)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e4])
def test_rays_in_a_corner_meet_the_wall(size):
    """Offsets must not carry rays through a wall that is near."""
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(2, 2), cc.PhongMaterial(), scale=size)
    scene.add(
        cc.Mesh.plane(2, 2),
        cc.PhongMaterial(),
        position=(size, 0, 0),
        rotation=cc.axis_angle((0, 0, 1), 90),
        scale=size,
    )
    snapshot = read(scene)
    geometry = Geometry(snapshot)
    near = size * np.geomspace(1e-5, 0.5, 40)
    floor = np.stack([size - near, np.ones(40) * 0, size * np.linspace(-0.4, 0.4, 40)], axis=1)
    down = np.broadcast_to((0.0, -1.0, 0.0), floor.shape)
    first = geometry.cast(floor - size * down, down)
    assert np.all(snapshot.node[first.triangle] == 0)
    directions = np.broadcast_to((1.0, 0.5, 0.01), floor.shape)
    hits = geometry.cast(floor, directions, start=first.triangle)
    assert np.all(snapshot.node[hits.triangle] == 1)
    np.testing.assert_allclose(hits.distance, near, rtol=1e-9)
    assert np.all(geometry.blocked(floor, directions, near * 1.001, start=first.triangle))
    assert not np.any(geometry.blocked(floor, directions, near * 0.999, start=first.triangle))


@pytest.mark.parametrize("seed", range(2))
def test_shadow_rays_agree_with_the_oracle(rng, seed):
    world = random_world(seed)
    origins = rng.uniform(-6, 6, (2000, 3))
    lamp = np.array((0.5, 0.2, -0.3))
    want = raycast.visible(world.shapes, origins, lamp - origins, 1e9) == 0
    snapshot = read(world.scene)
    geometry = Geometry(snapshot)
    way = lamp - origins
    got = geometry.blocked(origins, way, np.full(2000, np.inf))
    assert 0.1 < want.mean() < 0.9
    assert (got == want).mean() > 0.999
    distance = np.linalg.norm(way, axis=1, keepdims=True)
    near = raycast.visible(world.shapes, origins, way, distance[:, 0]) == 0
    assert (near != want).any()
    assert (geometry.blocked(origins, way / distance, distance[:, 0]) == near).mean() > 0.999


def fence(**more):
    """A plane whose map has holes in every other column of texels."""
    alpha = np.full((1, 8, 4), 255, np.uint8)
    alpha[:, ::2, 3] = 0
    image = cc.Image(alpha, mag_filter="nearest")
    return cc.StandardMaterial(map=image, alpha_mode="mask", **more)


@pytest.mark.parametrize("double_sided", [False, True])
def test_rays_pass_the_holes_of_masks(double_sided):
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(8, 8), fence(double_sided=double_sided))
    scene.add(cc.Mesh.plane(8, 8), fence(alpha_cutoff=0), position=(0, -1, 0))
    snapshot = read(scene)
    geometry = Geometry(snapshot)
    x = np.linspace(-3.9, 3.9, 79)
    hole = np.floor(x + 4) % 2 == 0
    origins = np.stack([x, np.ones(79), 0 * x + 0.2], axis=1)
    down = np.broadcast_to((0.0, -1.0, 0.0), origins.shape)
    hits = geometry.cast(origins, down)
    np.testing.assert_array_equal(snapshot.node[hits.triangle], hole.astype(int))
    assert np.array_equal(geometry.blocked(origins, down, np.full(79, 1.5)), ~hole)
    assert np.all(geometry.blocked(origins, down, np.full(79, 2.5)))
    below = origins - (0, 1.5, 0)
    hits = geometry.cast(below, -down)
    assert np.array_equal(hits.triangle >= 0, ~hole & double_sided)
    # From below, too, shadow rays are stopped by what is left of a single-sided surface.
    assert np.array_equal(geometry.blocked(below, -down, np.full(79, 2.0)), ~hole)


def test_holes_are_where_the_renderer_has_them(renderer, rng):
    scene = cc.Scene(background=(0, 0, 1))
    image = cc.Image(rng.random((6, 5, 4)).astype(np.float32))
    mesh = cc.Mesh.plane(4, 4)
    mesh.colors = rng.uniform(0.5, 1, (len(mesh.positions), 4))
    material = cc.StandardMaterial(
        map=cc.Texture(image, scale=(1.3, -0.7), offset=(0.2, 0.1), rotation=20),
        color=(1, 1, 1, 0.9),
        alpha_mode="mask",
        alpha_cutoff=0.35,
    )
    scene.add(mesh, material, rotation=cc.axis_angle((1, 0, 0), 70))
    camera = cc.PerspectiveCamera(position=(0, 0, 3.5))
    size = (80, 60)
    snapshot, hits, _, _ = seen(scene, camera, size)
    frame = renderer.render(scene, camera, size, outputs=("id",))
    ids = ids_of(snapshot, hits).reshape(60, 80)
    assert 0.1 < ids.mean() < 0.9
    inner = raycast.interior(ids)
    assert inner.mean() > 0.4
    assert np.array_equal(ids[inner], frame.id[inner])


@pytest.mark.parametrize("place", [(0, 0, 0), (700, -300, 50)])
@pytest.mark.parametrize("outer", [False, True])
def test_closed_meshes_have_no_gaps(rng, outer, place):
    """Rays to corners and edges of triangles meet one of them, also beyond a back face, where halves are searched."""
    scene = cc.Scene()
    mesh = cc.Mesh.icosphere(1, subdivisions=3)
    turn = cc.axis_angle((1, 2, 3), 40)
    scene.add(mesh, cc.PhongMaterial(), scale=(-1.5, 1.5, 1.5), rotation=turn, position=place)
    if outer:
        for size in (1, 2):  # round the place where rays begin
            scene.add(cc.Mesh.box(size), cc.PhongMaterial(), position=np.add(place, (1, 2, 6)))
    snapshot = read(scene)
    corners = snapshot.corners[snapshot.node == 0]
    share = rng.random((len(corners), 1))
    edges = share * corners[:, 0] + (1 - share) * corners[:, 1]
    ends = np.concatenate([corners[:, 0], edges])
    outward = normalised(ends - place)
    geometry = Geometry(snapshot)
    inside = np.zeros(len(outward), np.int64)
    centre = np.broadcast_to(np.array(place, float), outward.shape)
    assert np.all(snapshot.node[geometry.cast(centre, outward, inside).triangle] == 0)
    way = ends - np.add(place, (1, 2, 6))
    seen_ends = (normalised(way) * outward).sum(axis=1) < -0.1
    hits = geometry.cast(ends - way, way)
    assert np.all(snapshot.node[hits.triangle[seen_ends]] == 0)
    np.testing.assert_allclose(hits.distance[seen_ends], 1, atol=1e-4)


def test_chosen_triangles_keep_their_numbers():
    world = random_world(0)
    snapshot = read(world.scene)
    chosen = snapshot.node == 4
    directions = np.broadcast_to(snapshot.corners[chosen].mean(axis=(0, 1)), (1, 3))
    hits = Geometry(snapshot, chosen).cast(np.zeros((1, 3)), directions)
    assert snapshot.node[hits.triangle[0]] == 4


def test_nothing_is_met_where_nothing_is(rng):
    scene = cc.Scene()
    scene.add(cc.Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))  # without an area
    geometry = Geometry(read(scene))
    directions = random_directions(rng, 5)
    hits = geometry.cast(np.zeros((5, 3)), directions)
    assert np.all(hits.triangle == -1)
    assert np.all(np.isinf(hits.distance))
    assert not np.any(geometry.blocked(np.zeros((5, 3)), directions, np.full(5, np.inf)))
    none = geometry.cast(np.zeros((0, 3)), np.zeros((0, 3)))
    assert none.triangle.shape == (0,)


def test_without_embreex_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    with pytest.raises(ImportError, match=r"cubecam\[truth\]"):
        Geometry(read(cc.Scene()))
