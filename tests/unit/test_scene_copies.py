"""Pickle and deepcopy copy each object once, keep shared objects shared, and give new revisions."""

import copy
import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies, same_content
from tests.reference.pattern import face_pattern


def furnished():
    """A scene that contains one object of each kind."""
    scene = cc.Scene(environment=cc.CubeMap(face_pattern(4)), background=(0.1, 0.2, 0.3, 1))
    scene.add(cc.PointLight(position=(1, 2, 3), color=(1, 0.5, 0.25), intensity=2, decay=1))
    scene.add(cc.DirectionalLight(direction=(0, -1, 0)))
    scene.add(cc.AmbientLight(color=(0.1, 0.2, 0.3)))
    group = scene.add(position=(1, 0, 0), name="group")
    scene.add(
        cc.Mesh.box(1), cc.PhongMaterial(color=(1, 0, 0)), parent=group, visible=False, name="box"
    )
    scene.add(
        cc.Mesh.plane(1, 1),
        cc.BasicMaterial(map=np.full((2, 2, 3), 9, np.uint8)),
        in_captures=False,
    )
    ball = scene.add(
        cc.Mesh.sphere(0.5), cc.MirrorMaterial(tint=(1, 0.9, 0.8)), matrix=np.diag([2, 2, 2, 1])
    )
    ball.environment = cc.Probe(position=(0, 1, 0), size=32, exclude=[group])
    return scene, group, ball


@copies
def test_everything_is_kept(make_copy):
    scene, *_ = furnished()
    other = make_copy(scene)
    assert same_content(other.environment, scene.environment)
    np.testing.assert_array_equal(other.background, scene.background)
    assert [type(light) for light in other.lights] == [type(light) for light in scene.lights]
    point = other.lights[0]
    np.testing.assert_allclose(point.position, [1, 2, 3])
    np.testing.assert_allclose(point.color, [1, 0.5, 0.25])
    assert (point.intensity, point.decay) == (2, 1)
    for a, b in zip(scene.nodes, other.nodes, strict=True):
        assert (a.id, a.name, a.visible, a.in_captures) == (b.id, b.name, b.visible, b.in_captures)
        np.testing.assert_array_equal(a.world_matrix, b.world_matrix)
        assert type(a.material) is type(b.material)
        if a.mesh is not None:
            np.testing.assert_array_equal(a.mesh.positions, b.mesh.positions)


@copies
def test_a_scene_and_its_ball_stay_together(make_copy):
    scene, _, ball = furnished()
    other, other_ball = make_copy((scene, ball))
    assert other_ball in other.nodes
    assert any(node is other_ball for node in other.nodes)
    assert other_ball is not ball
    other_ball.position = (9, 9, 9)
    assert not np.allclose(ball.position, 9)


@copies
def test_parents_and_probes_point_into_the_copy(make_copy):
    scene, *_ = furnished()
    other = make_copy(scene)
    group = next(node for node in other.nodes if node.name == "group")
    box = next(node for node in other.nodes if node.name == "box")
    assert box.parent is group
    probe = other.nodes[-1].environment
    assert isinstance(probe, cc.Probe)
    assert list(probe.exclude) == [group]
    assert (probe.size, tuple(probe.position)) == (32, (0, 1, 0))


@copies
def test_shared_objects_stay_shared(make_copy):
    scene = cc.Scene()
    mesh, material, probe = cc.Mesh.box(1), cc.MirrorMaterial(), cc.Probe(position=(0, 0, 0))
    for _ in range(2):
        scene.add(mesh, material).environment = probe
    a, b = make_copy(scene).nodes
    assert a.mesh is b.mesh
    assert a.material is b.material
    assert a.environment is b.environment
    assert a.environment is not probe


@copies
def test_a_cycle_of_probes_and_nodes(make_copy):
    """Each of two mirrors shows a probe that is attached to the other mirror."""
    scene = cc.Scene()
    a, b = (
        scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), position=(x, 0, 0)) for x in (-1, 1)
    )
    a.environment = cc.Probe(parent=b)
    b.environment = cc.Probe(parent=a, exclude=[b])
    other_a, other_b = make_copy(scene).nodes
    assert other_a.environment.parent is other_b
    assert other_b.environment.parent is other_a
    assert list(other_b.environment.exclude) == [other_b]


@copies
def test_ids_go_on_where_they_stopped(make_copy):
    scene = cc.Scene()
    nodes = [scene.add() for _ in range(3)]
    scene.remove(nodes[2])
    other = make_copy(scene)
    assert [node.id for node in other.nodes] == [1, 2]
    assert other.add().id == 4


@pytest.mark.parametrize(
    "make",
    [
        lambda: cc.PerspectiveCamera(
            fov=50, position=(1, 2, 3), target=(0, 0, 0), near=0.2, far=50
        ),
        lambda: cc.OrthographicCamera(height=3, position=(1, 2, 3), target=(0, 0, 0)),
        lambda: cc.Camera(view=np.eye(4), projection=np.diag([1, 2, -1, 1])),
    ],
)
@copies
def test_cameras(make, make_copy):
    camera = make()
    for a, b in zip(
        (camera.view, camera.projection(1.5)),
        (make_copy(camera).view, make_copy(camera).projection(1.5)),
        strict=True,
    ):
        np.testing.assert_array_equal(a, b)


@copies
def test_materials_and_images(make_copy):
    image = cc.Image(np.full((2, 3, 4), 7, np.uint8), mipmaps=True, wrap="clamp")
    material = make_copy(
        cc.PhongMaterial(
            color=(1, 0.5, 0), ka=0.3, shininess=20, map=image, opacity=0.5, double_sided=True
        )
    )
    assert (material.ka, material.shininess, material.opacity) == pytest.approx((0.3, 20, 0.5))
    assert material.double_sided is True
    assert (material.map.mipmaps, material.map.wrap) == (True, "clamp")
    np.testing.assert_array_equal(material.map.pixels, image.pixels)


@copies
def test_deep_trees_do_not_overflow_the_stack(make_copy):
    scene = cc.Scene()
    node = None
    for _ in range(3000):
        node = scene.add(parent=node)
    other = make_copy(scene)
    assert len(other.nodes) == 3000
    assert other.nodes[-1].parent is other.nodes[-2]


def test_faces_and_errors_pickle():
    assert pickle.loads(pickle.dumps(cc.Face.NEG_Y)) is cc.Face.NEG_Y
    error = pickle.loads(pickle.dumps(cc.ContextError("no device")))
    assert type(error) is cc.ContextError
    assert str(error) == "no device"


def test_revisions_are_internal():
    scene, *_ = furnished()
    for thing in (
        scene,
        scene.nodes[-1],
        scene.environment,
        scene.nodes[-1].mesh,
        scene.nodes[-1].material,
    ):
        assert not [name for name in dir(thing) if "revision" in name and not name.startswith("_")]


def test_copy_of_a_node_alone_is_refused_or_free_of_the_scene():
    scene, _, ball = furnished()
    count = len(scene.nodes)
    copy.deepcopy(ball)
    assert len(scene.nodes) == count
