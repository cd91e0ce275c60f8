"""Lights and cameras that follow nodes: where they are, what methods do, pickles; cameras of scenes."""

import copy
import gc
import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.reference.transforms import look_at

PLACED = (cc.PerspectiveCamera, cc.OrthographicCamera)
TURN = cc.axis_angle((1, 2, 0.5), 40)


def holder(scale=(1, 1, 1)):
    """A scene with a node in a turned and scaled node, and its matrix in numpy."""
    scene = cc.Scene()
    above = scene.add(position=(1, 2, 3), rotation=TURN, scale=scale)
    node = scene.add(cc.Mesh.box(), position=(0.5, 0, -1), rotation=TURN, parent=above)
    return scene, node, above.matrix @ node.matrix


def at(matrix, point):
    return matrix[:3, :3] @ point + matrix[:3, 3]


@pytest.mark.parametrize("scale", [1, 3, (2, 0.5, 1), (-1, 1, 2)])
@pytest.mark.parametrize("kind", PLACED)
def test_a_camera_looks_from_its_node(kind, scale):
    scene, node, matrix = holder(np.broadcast_to(scale, 3))
    position, target, up = (0.2, 0.3, -0.4), (1, -1, 2), (0.1, 1, 0)
    camera = kind(position=position, target=target, up=up, parent=node)
    assert camera.parent is node
    want = look_at(at(matrix, position), at(matrix, target), matrix[:3, :3] @ up)
    np.testing.assert_allclose(camera.view, want, atol=1e-12)
    np.testing.assert_allclose(camera.world_to_camera_gl, want, atol=1e-12)
    np.testing.assert_allclose(camera.world_position, at(matrix, position), atol=1e-12)
    assert (camera.position.tolist(), camera.target.tolist()) == (list(position), list(target))
    # Neither lens nor size depends on the node.
    np.testing.assert_array_equal(camera.projection(2), kind().projection(2))
    assert scene.nodes[1] is node


@pytest.mark.parametrize("scale", [1, (2, 0.5, 1), (-1, 1, 2)])
@pytest.mark.parametrize("kind", PLACED)
def test_a_camera_at_its_node_is_that_of_gltf(kind, scale):
    """The view is the inverse of the node's matrix without its scale; -Z of the node is kept exactly."""
    _, node, matrix = holder(np.broadcast_to(scale, 3))
    view = kind(parent=node).view
    back = matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
    np.testing.assert_allclose(view[2, :3], back, atol=1e-12)
    np.testing.assert_allclose(view[:3, :3] @ view[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.linalg.det(view[:3, :3]) == pytest.approx(1)
    if np.isscalar(scale):
        np.testing.assert_allclose(view, np.linalg.inv(matrix), atol=1e-12)


@pytest.mark.parametrize("kind", PLACED)
def test_methods_work_in_the_world(kind):
    """A camera with a parent ends where one without does."""
    scene, node, matrix = holder((2, 0.7, -1.5))
    position, target, up = (0.2, 0.3, -0.4), (1, -1, 2), (0, 1, 0.2)
    child = kind(position=position, target=target, up=up, parent=node)
    free = kind(position=at(matrix, position), target=at(matrix, target), up=matrix[:3, :3] @ up)
    steps = [
        lambda c: c.orbit(yaw=30, pitch=-10),
        lambda c: c.walk(0.7),
        lambda c: c.strafe(-0.3),
        lambda c: c.yaw(12),
        lambda c: c.pitch(5),
        lambda c: c.look((1, 0.2, 0.3)),
        lambda c: c.look_at((4, 5, 6), up=(1, 0, 0)),
        lambda c: c.look_at(node),
        lambda c: c.fit(scene, size=(4, 3)),
    ]
    for step in steps:
        step(child)
        step(free)
        np.testing.assert_allclose(child.view, free.view, atol=1e-9)
        np.testing.assert_allclose(child.world_position, free.position, atol=1e-9)
        np.testing.assert_allclose(child.projection(1.5), free.projection(1.5), atol=1e-9)
    assert child.parent is node


@pytest.mark.parametrize("kind", PLACED)
def test_methods_of_a_camera_without_a_target(kind):
    _, node, matrix = holder()
    child = kind(parent=node)
    child.walk(2)
    ahead = -matrix[:3, 2]
    np.testing.assert_allclose(child.world_position, matrix[:3, 3] + 2 * ahead, atol=1e-12)
    assert child.target is None
    child.yaw(90)
    left = -matrix[:3, 0]
    np.testing.assert_allclose(-child.view[2, :3], left, atol=1e-12)


@pytest.mark.parametrize("make", [cc.StereoCamera.off_axis, cc.StereoCamera.toe_in])
@pytest.mark.parametrize("target", [None, (0.5, 0, -3)])
def test_eyes_have_the_parent(make, target):
    if target is None and make is cc.StereoCamera.toe_in:
        target = (0, 0, -2)
    _, node, matrix = holder()
    child = cc.PerspectiveCamera(target=target, parent=node)
    ahead = at(matrix, (0, 0, -1) if target is None else target)
    free = cc.PerspectiveCamera(position=at(matrix, (0, 0, 0)), target=ahead, up=matrix[:3, 1])
    mine, other = make(child), make(free)
    for ours, theirs in ((mine.left, other.left), (mine.right, other.right)):
        assert ours.parent is node
        np.testing.assert_allclose(ours.view, theirs.view, atol=1e-12)


def test_intrinsics_do_not_depend_on_the_parent():
    _, node, _ = holder((2, 2, 2))
    camera = cc.PerspectiveCamera(fov=40, shift=(0.1, 0.2))
    before = camera.intrinsics((40, 30))
    camera.parent = node
    np.testing.assert_array_equal(camera.intrinsics((40, 30)), before)


def test_where_lights_are():
    _, node, matrix = holder((2, 0.5, -1))
    place, way = (0.1, 0.2, 0.3), (0.3, -1, 0.2)
    spot = cc.SpotLight(place, way, parent=node)
    np.testing.assert_allclose(spot.world_position, at(matrix, place), atol=1e-12)
    turned = matrix[:3, :3] @ (np.asarray(way) / np.linalg.norm(way))
    np.testing.assert_allclose(spot.world_direction, turned / np.linalg.norm(turned), atol=1e-12)
    point = cc.PointLight(place, parent=node)
    np.testing.assert_allclose(point.world_position, at(matrix, place), atol=1e-12)
    sun = cc.DirectionalLight(way, parent=node)
    np.testing.assert_allclose(sun.world_direction, spot.world_direction, atol=1e-12)
    assert point.position.tolist() == list(place)
    point.parent = None
    assert point.world_position.tolist() == list(place)
    assert not hasattr(cc.AmbientLight(), "parent")


LIGHTS = (cc.PointLight, cc.SpotLight, cc.DirectionalLight)


@pytest.mark.parametrize("kind", [*LIGHTS, *PLACED])
def test_parents_are_not_kept(kind):
    scene = cc.Scene()
    node = scene.add(position=(1, 2, 3))
    thing = kind(parent=node)
    assert thing.parent is node
    assert "parent=node 1" in repr(thing)
    scene.remove(node)
    assert thing.parent is node
    del node
    gc.collect()
    assert thing.parent is None
    assert "parent" not in repr(thing)


@pytest.mark.parametrize("bad", [3, "node", cc.Scene()])
@pytest.mark.parametrize("kind", [*LIGHTS, *PLACED])
def test_bad_parents(kind, bad):
    with pytest.raises(TypeError, match="parent: expected a Node or None"):
        kind(parent=bad)
    thing = kind()
    with pytest.raises(TypeError, match="parent: expected a Node or None"):
        thing.parent = bad


@pytest.mark.parametrize("make", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_copies(make):
    scene, node, _ = holder()
    things = [scene.add(kind(parent=node)) for kind in (*LIGHTS, *PLACED)]
    same = make(scene)
    copies = [*same.lights, *same.cameras]
    assert [type(thing) for thing in copies] == [type(thing) for thing in things]
    assert all(thing.parent is same.nodes[1] for thing in copies)
    np.testing.assert_array_equal(same.cameras[0].view, things[3].view)
    light, kept = make((things[0], scene))
    assert light is kept.lights[0]
    assert light.parent is kept.nodes[1]


def test_ranges():
    for kind in (cc.PointLight, cc.SpotLight):
        assert kind().range == np.inf
        light = kind(range=2.5)
        assert light.range == 2.5
        assert "range=2.5" in repr(light)
        assert "range" not in repr(kind())
        assert pickle.loads(pickle.dumps(light)).range == 2.5
        for bad in (0, -1, np.nan, 1e300):
            with pytest.raises(ValueError, match="a range above 0, or infinity for none"):
                light.range = bad
        assert light.range == 2.5
        light.range = np.inf
        assert light.range == np.inf


def test_cameras_of_a_scene():
    scene = cc.Scene()
    first, second = cc.PerspectiveCamera(), cc.Camera(view=np.eye(4), projection=np.eye(4))
    assert not scene.cameras
    assert scene.add(first) is first
    scene.add(second)
    assert scene.cameras == (first, second)
    assert first in scene
    assert cc.PerspectiveCamera() not in scene
    assert len(scene) == 0  # counts nodes
    with pytest.raises(ValueError, match="a camera that is not in the scene, got one that is"):
        scene.add(first)
    scene.remove(first)
    assert list(scene.cameras) == [second]
    with pytest.raises(ValueError, match="a camera of this scene"):
        scene.remove(first)
    scene.clear()
    assert not scene.cameras
    with pytest.raises(TypeError, match="a Light, a Camera, an Animation or None"):
        scene.add("camera")
    with pytest.raises(TypeError, match="a Node, a Light, a Camera or an Animation"):
        scene.remove("camera")
