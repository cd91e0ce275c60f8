"""flat_shading=True: normals are those of the triangles' planes, for every material and after every change."""

import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import perspective, room
from tests.helpers import DEVICE, copies

RAW = "vec3 shade(Surface s) { return s.normal; }"
MATERIALS: dict[str, Callable[..., cc.Material]] = {
    "basic": cc.BasicMaterial,
    "phong": cc.PhongMaterial,
    "mirror": cc.MirrorMaterial,
    "glass": cc.GlassMaterial,
    "shader": lambda **options: cc.ShaderMaterial(RAW, **options),
}
CAMERA = cc.PerspectiveCamera(fov=50, position=(0.4, 0.7, 3), target=(0, 0, 0))
SIZE = (48, 40)


def lump(rng, **more):
    """A closed mesh of 80 triangles without any symmetry, with uvs and colours."""
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    turn = np.eye(3) + rng.uniform(-0.2, 0.2, (3, 3))
    colors = rng.random((len(ball.positions), 4)) * 0.5 + 0.5
    return cc.Mesh(ball.positions @ turn, ball.indices, uvs=ball.uvs, colors=colors, **more)


def face_normals(mesh):
    corners = mesh.positions.astype(float)[mesh.indices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def test_flat_shaded_is_numpys(rng):
    mesh = lump(rng)
    flat = mesh.flat_shaded()
    np.testing.assert_array_equal(flat.indices, np.arange(3 * len(mesh.indices)).reshape(-1, 3))
    for name in ("positions", "uvs", "colors"):
        want = getattr(mesh, name)[mesh.indices].reshape(len(flat.positions), -1)
        np.testing.assert_array_equal(getattr(flat, name), want)
    want = np.repeat(face_normals(mesh), 3, axis=0)
    np.testing.assert_allclose(flat.normals, want, atol=1e-6)


def test_calls_share_their_arrays_and_not_their_changes(rng):
    mesh = lump(rng)
    one, other = mesh.flat_shaded(), mesh.flat_shaded()
    assert one is not other
    assert np.shares_memory(one.normals, other.normals)
    one.positions = one.positions * 2
    np.testing.assert_array_equal(other.positions, mesh.flat_shaded().positions)
    mesh.positions = mesh.positions[:, ::-1]
    np.testing.assert_array_equal(
        mesh.flat_shaded().positions, mesh.positions[mesh.indices].reshape(-1, 3)
    )


def test_only_what_changed_is_made_anew(rng):
    mesh = lump(rng)
    before = mesh.flat_shaded()
    mesh.colors = rng.random((len(mesh.positions), 3))
    after = mesh.flat_shaded()
    assert np.shares_memory(before.positions, after.positions)
    assert np.shares_memory(before.normals, after.normals)
    assert np.shares_memory(before.indices, after.indices)
    np.testing.assert_array_equal(after.colors, mesh.colors[mesh.indices].reshape(-1, 4))
    mesh.uvs = None
    assert mesh.flat_shaded().uvs is None
    mesh.positions = mesh.positions + 1
    np.testing.assert_array_equal(mesh.flat_shaded().bounds, mesh.bounds)


def test_triangles_without_area_do_no_harm():
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 0, -1], [2, 0, 0]], [[0, 1, 2], [0, 1, 3], [1, 1, 1]])
    np.testing.assert_array_equal(mesh.flat_shaded().normals, np.tile([0, 1, 0], (9, 1)))


def test_a_flat_mesh_stays_flat(rng):
    flat = lump(rng).flat_shaded()
    flat.positions = flat.positions * (1, 2, 3)
    np.testing.assert_allclose(flat.normals, np.repeat(face_normals(flat), 3, axis=0), atol=1e-6)
    np.testing.assert_array_equal(flat.flat_shaded().normals, flat.normals)


@copies
def test_copies(rng, make_copy):
    flat = lump(rng).flat_shaded()
    np.testing.assert_array_equal(make_copy(flat).normals, flat.normals)
    material = cc.PhongMaterial(flat_shading=True)
    assert make_copy(material).flat_shading is True
    assert repr(material) == "PhongMaterial(flat_shading=True)"


@pytest.mark.parametrize("kind", MATERIALS)
def test_the_option_of_every_material(any_path, rng, kind):
    """The normals of a picture are those of the plane that numpy finds at the pixel's position."""
    mesh, scene = lump(rng), cc.Scene(environment=cc.CubeMap(np.ones((6, 4, 4, 3), np.float32)))
    matrix = np.eye(4)
    matrix[:3, :3] = np.diag([1.2, -0.7, 0.9]) @ np.linalg.qr(rng.normal(size=(3, 3)))[0]
    scene.add(mesh, MATERIALS[kind](flat_shading=True), matrix=matrix)
    frame = any_path.render(scene, CAMERA, SIZE, outputs=("normal", "position", "id"))
    corners = mesh.positions.astype(float)[mesh.indices] @ matrix[:3, :3].T
    planes = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    planes *= np.sign(np.linalg.det(matrix)) / np.linalg.norm(planes, axis=1, keepdims=True)
    seen = frame.id > 0
    assert seen.sum() > 300
    # The pixel's plane: the one in whose triangle its position lies.
    points = frame.position[seen].astype(float)
    off = np.abs(np.einsum("fk,pfk->pf", planes, points[:, None] - corners[:, 0]))
    inside = np.ones_like(off, bool)
    for i in range(3):
        edge, start = corners[:, (i + 1) % 3] - corners[:, i], corners[:, i]
        side = np.cross(planes, edge) * np.sign(np.linalg.det(matrix))
        inside &= np.einsum("fk,pfk->pf", side, points[:, None] - start) > 1e-5
    found = (off < 1e-4) & inside
    assert (found.sum(axis=1) <= 1).all()
    clear = found.any(axis=1)
    assert clear.mean() > 0.9
    want = planes[found.argmax(axis=1)]
    np.testing.assert_allclose(frame.normal[seen][clear], want[clear], atol=2e-6)


def pictures(renderer, scene):
    frame = renderer.render(scene, CAMERA, SIZE, outputs=("normal", "id"), format="rgba32f")
    cube = renderer.capture(scene, (0, 0, 1.5), 16, outputs=("normal",))
    return [frame.color, frame.normal, frame.id, cube.faces, cube.normal]


def stage(mesh, flat, other):
    scene = cc.Scene()
    scene.add(cc.PointLight((2, 3, 4), shadow=cc.Shadow(size=32)))
    scene.add(mesh, flat, position=(-0.8, 0, 0))
    scene.add(mesh, other, position=(0.8, 0, 0))
    return scene


@pytest.fixture
def materials():
    paint: dict[str, Any] = {"vertex_colors": True, "blend": "opaque"}
    return cc.PhongMaterial(flat_shading=True, **paint), cc.PhongMaterial(**paint)


def test_it_equals_the_flat_mesh(any_path, rng, materials):
    """Also where a smooth material shows the same mesh."""
    mesh = lump(rng)
    flat, smooth = materials
    got = pictures(any_path, stage(mesh, flat, smooth))
    explicit = stage(mesh, smooth, smooth)
    explicit.nodes[0].mesh = mesh.flat_shaded()
    for a, b in zip(got, pictures(any_path, explicit), strict=True):
        assert_identical(a, b)
    assert not np.array_equal(got[0], pictures(any_path, stage(mesh, smooth, smooth))[0])


def test_changes_draw_what_scratch_draws(fresh_renderer, rng, materials):
    flat, other = materials
    mesh = lump(rng)
    scene = stage(mesh, flat, other)
    size = mesh.positions.shape

    def changes():
        yield lambda: None
        for _ in range(
            3
        ):  # the first update replaces buffers of the GPU, later ones write into them
            yield lambda: mesh.update(positions=mesh.positions * rng.uniform(0.8, 1.2, 3))
        yield lambda: mesh.update(colors=rng.random(size), normals=rng.normal(size=size))
        yield lambda: setattr(other, "flat_shading", True)
        yield lambda: setattr(flat, "flat_shading", False)
        yield lambda: mesh.update(positions=mesh.positions * 0.9)
        yield lambda: setattr(flat, "flat_shading", True)
        yield lambda: setattr(mesh, "colors", None)

    before = None
    for change in changes():
        change()
        got = pictures(fresh_renderer, scene)
        with cc.Renderer(device=DEVICE) as scratch:
            want = pictures(scratch, pickle.loads(pickle.dumps(scene)))
        for a, b in zip(got, want, strict=True):
            # What changed alone may be drawn by the program of one node in place of that of many.
            assert_identical(a, b, across="programs")
        assert before is None or not np.array_equal(before, got[0])
        before = got[0]


def test_unchanged_it_is_not_drawn_again(fresh_renderer, rng, materials):
    scene = stage(lump(rng), *materials)
    for drawn in (7, 0):
        count = 0
        fresh_renderer.render(scene, CAMERA, SIZE)
        count += fresh_renderer.stats.views_drawn
        fresh_renderer.capture(scene, (0, 0, 1.5), 16)
        assert count + fresh_renderer.stats.views_drawn == drawn
    materials[0].flat_shading = True  # it is already
    fresh_renderer.render(scene, CAMERA, SIZE)
    assert fresh_renderer.stats.views_drawn == 0


def test_a_crowd_is_one_call_for_each_shading(renderer, rng):
    mesh, scene = lump(rng), cc.Scene()
    for index in range(60):
        material = cc.PhongMaterial(color=rng.random(3), flat_shading=index % 2 == 0)
        scene.add(mesh, material, position=(*rng.uniform(-1, 1, 2), 0), scale=0.1)
    got = renderer.render(scene, CAMERA, SIZE, outputs=("normal",))
    assert renderer.stats.draw_calls == 2
    flat = mesh.flat_shaded()
    for node in scene:
        assert node.material is not None
        node.mesh = flat if node.material.flat_shading else mesh
        node.material.flat_shading = False
    want = renderer.render(scene, CAMERA, SIZE, outputs=("normal",))
    assert_identical(got.normal, want.normal)
    assert_identical(got.color, want.color)


def test_shadow_maps_are_those_of_the_mesh(renderer, rng, materials):
    scene = stage(lump(rng), *materials)
    lamp = scene.lights[0]
    flat = renderer.shadow_map(scene, lamp)
    materials[0].flat_shading = False
    assert_identical(flat, renderer.shadow_map(scene, lamp))


def test_flat_boxes_look_as_ever(renderer):
    """A box has normals of its faces: flat shading changes only roundings."""
    world, view = room(), perspective((0.2, 0.1, -0.1), (-0.6, 0.2, 2.2), fov=90)
    outputs = ("normal", "id")
    plain = renderer.render(world.scene, view.camera, view.size, outputs=outputs)
    for node in world.scene:
        node.material.flat_shading = True
    flat = renderer.render(world.scene, view.camera, view.size, outputs=outputs)
    box = plain.id != 6  # the sphere
    assert_close(flat.normal[box], plain.normal[box], "normal")
    assert not np.allclose(flat.normal[~box], plain.normal[~box], atol=1e-3)


@pytest.mark.parametrize("value", ["yes", [1, 2]])
def test_a_value_that_is_no_bool(value):
    with pytest.raises(TypeError, match="flat_shading: expected bool, got"):
        cc.PhongMaterial(flat_shading=value)
