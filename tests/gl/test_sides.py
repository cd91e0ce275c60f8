"""Single-sided culls back faces, double-sided turns N to the viewer, negative determinants flip the winding."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from tests.compare import assert_close
from tests.gl.world import World, capture_hits, inner, inner_smooth, perspective
from tests.reference.raycast import interior

MIRRORED = {
    "x": (-1, 1, 1),
    "y": (1, -1, 1),
    "z": (1, 1, -1),
    "all": (-1, -1, -1),
    "two": (-1, -1, 1),
}


def test_back_faces_are_culled(any_path):
    """From inside a box only its surroundings are visible."""
    scene = cc.Scene()
    material = cc.BasicMaterial()
    scene.add(cc.Mesh.box(2), material)
    assert not any_path.capture(scene, size=8, outputs=("id",)).id.any()
    material.double_sided = True
    assert any_path.capture(scene, size=8, outputs=("id",)).id.all()


def test_a_plane_is_seen_from_above_only(renderer):
    scene = cc.Scene()
    material = cc.BasicMaterial()
    scene.add(cc.Mesh.plane(2, 2), material)
    for height, seen in ((1, True), (-1, False)):
        cube = renderer.capture(scene, position=(0.01, height, 0.02), size=8, outputs=("id",))
        assert bool(cube.id.any()) is seen
    material.double_sided = True
    assert renderer.capture(scene, position=(0.01, -1, 0.02), size=8, outputs=("id",)).id.any()


@pytest.mark.parametrize("scale", MIRRORED.values(), ids=MIRRORED)
@pytest.mark.parametrize("double_sided", [False, True])
def test_mirroring_matrices(any_path, scale, double_sided):
    """The outside stays outside: silhouettes, distances and normals equal the oracle's."""
    world = World()
    material = cc.BasicMaterial(color=(1, 0, 0), double_sided=double_sided)
    scale = np.array(scale) * (1, 1.4, 0.7)
    world.sphere(
        0.6, material=material, position=(0.7, 0.1, -2), axis=(1, 1, 0), degrees=30, scale=scale
    )
    world.box(
        (0.5, 0.9, 0.7),
        material=material,
        position=(-0.9, 0.3, -2),
        axis=(1, 2, 3),
        degrees=50,
        scale=scale,
    )
    world.plane(3, 3, material=material, position=(0, -1.1 * scale[1] / 1.4, -1), scale=scale)
    hits = capture_hits(world, size=32)
    assert set(np.unique(hits.id)) == {0, 1, 2, 3}
    cube = any_path.capture(world.scene, size=32, outputs=("id", "normal", "distance"))
    mask = interior(hits.id)
    assert_close(cube.id, hits.id, "exact", mask=mask)
    assert_close(cube.distance, hits.distance, "distance", mask=mask)
    sides = np.where(hits.id == 2, inner(hits), inner_smooth(hits))
    assert_close(cube.normal, hits.normal, "normal", mask=sides)


def test_a_mirrored_parent_flips_too_and_two_flips_cancel(renderer):
    for parent_scale, child_scale in (((-1, 1, 1), (1, 1, 1)), ((-1, 1, 1), (1, 1, -1))):
        world = World()
        parent = world.scene.add(scale=parent_scale)
        world.sphere(0.6, position=(0.3, 0.1, -2), scale=child_scale, parent=parent)
        hits = capture_hits(world, size=24)
        cube = renderer.capture(world.scene, size=24, outputs=("id", "normal"))
        assert_close(cube.id, hits.id, "exact", mask=interior(hits.id))
        assert_close(cube.normal, hits.normal, "normal", mask=inner_smooth(hits))


def test_double_sided_turns_the_normal_to_the_viewer(renderer):
    """Inside a lit shell Phong's model uses the normal that points inwards."""
    world = World()
    material = cc.PhongMaterial(color=(0.5, 0.7, 0.9), double_sided=True)
    world.sphere(2, material=material, subdivisions=2)
    world.scene.add(cc.PointLight(position=(0.5, 0.8, -0.4)))
    hits = capture_hits(world, (0.2, -0.1, 0.3), 24)
    cube = renderer.capture(world.scene, position=(0.2, -0.1, 0.3), size=24, outputs=("normal",))
    assert_close(cube.normal, hits.normal, "normal")
    assert ((cube.normal * hits.position).sum(-1) < 0).all()
    want = shading.phong(
        hits.position,
        hits.normal,
        (0.2, -0.1, 0.3),
        (0.5, 0.7, 0.9),
        [shading.Point((0.5, 0.8, -0.4))],
    )
    assert_close(cube.faces[..., :3], want, "phong")


def test_a_double_sided_mirror_seen_from_behind(renderer):
    """A horizontal mirror shows the ground when it is seen from below, and the sky when seen from above."""
    faces = np.zeros((6, 4, 4, 3), np.float32)
    faces[2], faces[3] = (0, 0, 1), (0, 1, 0)
    scene = cc.Scene(environment=cc.CubeMap(faces), background=(0, 0, 0, 0))
    scene.add(cc.Mesh.plane(9, 9), cc.MirrorMaterial(double_sided=True))
    for height, color in ((2, (0, 0, 1)), (-2, (0, 1, 0))):
        camera = cc.PerspectiveCamera(fov=20, position=(0, height, 0.01), target=(0, 0, 0))
        got = renderer.render(scene, camera, (4, 4), format="rgba32f").color
        np.testing.assert_allclose(got[..., :3], np.broadcast_to(color, (4, 4, 3)), atol=1e-6)


def test_winding_of_each_face_is_that_of_the_others(any_path):
    """A capture's cameras are mirrored, but culling must not be: each face sees an icosphere from outside."""
    for axis in range(6):
        world = World()
        place = np.zeros(3)
        place[axis // 2] = 2 if axis % 2 == 0 else -2
        world.sphere(0.8, position=place + 0.05)
        hits = capture_hits(world, size=16)
        cube = any_path.capture(world.scene, size=16, outputs=("id", "distance"))
        assert cube.id[axis].any()
        assert_close(cube.distance, hits.distance, "distance", mask=interior(hits.id))


def test_a_mirrored_projection_shows_the_mirrored_picture(renderer):
    """Planar mirrors use such projections: what faces the camera still faces it."""
    world = World()
    world.sphere(1, (1, 0, 0))
    world.box(0.8, (0, 1, 0), position=(1.5, 0.3, 0), axis=(1, 1, 1), degrees=40)
    view = perspective((1, 1, 4), (0.5, 0, 0))
    mirror = np.diag([-1.0, 1, 1, 1]) @ view.projection
    camera = cc.Camera(view=view.view, projection=mirror)
    frame = renderer.render(world.scene, camera, view.size, outputs=("id", "z"))
    hits = view.hits(world.shapes)
    mask = interior(hits.id)[:, ::-1]
    assert_close(frame.id, hits.id[:, ::-1], "exact", mask=mask)
    assert_close(frame.z, hits.t[:, ::-1], "distance", mask=mask)


def test_frames_cull_as_captures_do(renderer):
    world = World()
    world.sphere(1, scale=(-1, 1, 1))
    world.box(0.8, position=(1.5, 0, 0), axis=(1, 1, 1), degrees=40)
    view = perspective((1, 1, 4), (0.5, 0, 0))
    hits = view.hits(world.shapes)
    frame = renderer.render(world.scene, view.camera, view.size, outputs=("z",))
    assert_close(frame.z, hits.t, "distance", mask=interior(hits.id))
