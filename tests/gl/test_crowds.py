"""Many nodes that look alike: they are drawn in few calls, with the same pixels as if they were drawn one by one."""

import numpy as np
import pytest

import cubecam as cc
from tests.gl.world import World, capture_hits, inner

CAMERA = cc.PerspectiveCamera(fov=60, position=(0, 0, 12), target=(0, 0, 0), near=1, far=50)
SIZE = (96, 96)


def scene_of(rng, count, make_material, meshes=1, **options):
    """`count` boxes anywhere in front of the camera, some mirrored, some stretched."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    scene.add(cc.PointLight((3, 5, 9), decay=0.5, intensity=3))
    scene.add(cc.DirectionalLight((1, -1, -0.5), color=(0.2, 0.4, 0.3)))
    shapes = [cc.Mesh.box(0.9 + 0.2 * index) for index in range(meshes)]
    nodes = []
    for index in range(count):
        matrix = np.eye(4)
        matrix[:3, :3] = rng.normal(size=(3, 3)) * 0.6
        matrix[:3, 3] = rng.uniform(-4, 4, 3)
        nodes.append(
            scene.add(shapes[index % meshes], make_material(index), matrix=matrix, **options)
        )
    return scene, nodes


def phong(index):
    return cc.PhongMaterial(color=(0.2 + 0.015 * (index % 50), 0.5, 0.3), shininess=5 + index % 7)


def one_by_one(scene, nodes):
    """The same scene without a crowd: a stencil that changes nothing keeps nodes apart."""
    for node in nodes:
        node.material.stencil = cc.Stencil(func="always")


KINDS = {
    "phong": phong,
    "basic": lambda index: cc.BasicMaterial(color=(0.01 * index, 0.5, 1 - 0.01 * index)),
    "mirror": lambda index: cc.MirrorMaterial(env_weight=0.01 * index, color=(0.5, 0.2, 0.1)),
    "glass": lambda index: cc.GlassMaterial(ior=1.1 + 0.01 * index),
    "double_sided": lambda index: cc.PhongMaterial(color=(0.5, 0.01 * index, 1), double_sided=True),
}


def sky(rng):
    return cc.CubeMap(rng.uniform(0, 1, (6, 8, 8, 3)).astype(np.float32))


@pytest.mark.parametrize("kind", KINDS)
def test_a_crowd_has_the_pixels_of_its_nodes(any_path, rng, kind):
    scene, nodes = scene_of(rng, 60, KINDS[kind])
    scene.environment = sky(rng)
    outputs = ("distance", "z", "normal", "position", "id", "label")
    for node in nodes:
        node.label = int(rng.integers(-(2**31), 2**31))
    crowd = any_path.render(scene, CAMERA, SIZE, outputs=outputs, format="rgba32f")
    calls = any_path.stats.draw_calls
    one_by_one(scene, nodes)
    depth = {"depth_format": "depth32f_stencil8"}
    alone = any_path.render(scene, CAMERA, SIZE, outputs=outputs, format="rgba32f", **depth)
    assert any_path.stats.draw_calls >= 55  # what is out of view is not drawn
    assert calls == 2  # one for each winding
    for name in ("color", *outputs):
        np.testing.assert_array_equal(getattr(crowd, name), getattr(alone, name), err_msg=name)


def test_calls_do_not_grow_with_materials(renderer, rng):
    """The numbers of a material are part of each node's record, so a thousand materials need only one call."""
    scene = cc.Scene()
    mesh = cc.Mesh.box(0.2)
    for position in rng.uniform(-3, 3, (1000, 3)):
        scene.add(mesh, cc.BasicMaterial(color=tuple(rng.uniform(0, 1, 3))), position=position)
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.draw_calls == 1
    assert renderer.stats.triangles == 12_000


def test_what_differs_parts_a_crowd(renderer, rng):
    scene, nodes = scene_of(rng, 40, phong)
    for node in nodes[::2]:
        node.receive_shadow = False
    matrices = [np.eye(4) for _ in nodes]
    for matrix, position in zip(matrices, rng.uniform(-4, 4, (len(nodes), 3)), strict=True):
        matrix[:3, 3] = position
    scene.set_matrices(nodes, matrices)
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.draw_calls == 2
    for node in nodes[:20]:
        node.mesh = nodes[-1].mesh if node.mesh is not nodes[-1].mesh else cc.Mesh.box(0.5)
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.draw_calls > 2


def test_a_dense_mesh_keeps_the_numbers_of_each_material(renderer):
    """Constants of dense meshes are stored in a block, and a crowd of such meshes changes it between calls."""
    scene = cc.Scene()
    ball = cc.Mesh.icosphere(0.4, subdivisions=4)  # 5,120 triangles
    places = [(x, y, 0) for x in np.linspace(-4, 4, 5) for y in np.linspace(-4, 4, 5)]
    colors = np.linspace(0.1, 1, len(places))
    for place, color in zip(places, colors, strict=True):
        scene.add(ball, cc.BasicMaterial(color=(color, 0, 0)), position=place)
    frame = renderer.render(scene, CAMERA, SIZE, outputs="id", format="rgba32f")
    for index, color in enumerate(colors):
        found = frame.color[frame.id == index + 1]
        assert len(found) > 10
        np.testing.assert_allclose(found[:, 0], np.float32(color), rtol=1e-6)


def test_transparent_nodes_are_blended_in_their_order(any_path, rng):
    """Nodes are blended from far to near, as a compositor in numpy does it, although they are drawn in one call."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    pane = cc.Mesh.plane(8, 8)
    material = cc.BasicMaterial(color=(1, 0.5, 0.25), opacity=0.3)
    upright = cc.axis_angle((1, 0, 0), 90)
    count = 20
    for depth in rng.permutation(count):
        scene.add(pane, material, position=(0, 0, -0.2 * depth), rotation=upright)
    frame = any_path.render(scene, CAMERA, (8, 8), format="rgba32f")
    assert any_path.stats.draw_calls == 1
    expected = np.zeros(3)
    for _ in range(count):
        expected = 0.3 * np.array([1, 0.5, 0.25]) + 0.7 * expected
    np.testing.assert_allclose(frame.color[4, 4, :3], expected, rtol=1e-5)


def test_a_growing_crowd_is_incremental(fresh_renderer, new_renderer, rng):
    """The sixteenth node makes a crowd and changes the order; the picture equals that of a new renderer."""
    scene, nodes = scene_of(rng, 12, phong)
    for step in range(10):
        matrix = np.eye(4)
        matrix[:3, 3] = rng.uniform(-3, 3, 3)
        nodes.append(scene.add(nodes[0].mesh, phong(step), matrix=matrix))
        if step == 7:
            scene.remove(nodes.pop(0))
        kept = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f")
        anew = new_renderer().render(scene, CAMERA, SIZE, format="rgba32f")
        np.testing.assert_array_equal(kept.color, anew.color)


def test_a_capture_of_a_crowd_meets_the_ray_caster(any_path, rng):
    world = World()
    for _ in range(30):
        world.box(0.5, color=tuple(rng.uniform(0.2, 1, 3)), position=rng.uniform(-4, 4, 3))
    cube = any_path.capture(world.scene, size=24, near=0.05, far=30, outputs="id")
    hits = capture_hits(world, size=24, near=0.05, far=30)
    sure = inner(hits)
    assert sure.mean() > 0.5
    np.testing.assert_array_equal(cube.id[sure], hits.id[sure])
    assert len(np.unique(cube.id)) > 15
