"""Nodes and cameras that turn towards a point: the axes in the world against numpy."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import normalised
from tests.reference import transforms as ref


def unit(vector):
    return normalised(vector)


def check_front(node, target, up=(0, 1, 0)):
    """+Z of the node points at the target; +Y lies in the plane of the direction and up, on the side of up."""
    world = node.world_matrix
    direction = unit(np.asarray(target, float) - world[:3, 3])
    np.testing.assert_allclose(unit(world[:3, 2]), direction, atol=1e-12)
    side = unit(np.cross(up, direction))
    assert abs(unit(world[:3, 1]) @ side) < 1e-9
    assert world[:3, 1] @ (np.asarray(up) - direction * (direction @ up)) > 0


@pytest.mark.parametrize("scale", [1, (2, 0.5, 3), (-1, 1, 1), (1, -2, 1), (1, 2, -1), -1])
@pytest.mark.parametrize("up", [(0, 1, 0), (1, 0.5, -2)])
def test_a_node_without_a_parent(scale, up, rng):
    for target in rng.normal(size=(5, 3)):
        node = cc.Scene().add(position=(3, -1, 2), rotation=rng.normal(size=4), scale=scale)
        node.look_at(target, up=up)
        check_front(node, target, up)
        np.testing.assert_array_equal(node.position, (3, -1, 2))
        np.testing.assert_allclose(node.scale, np.broadcast_to(scale, 3))


def test_its_axes_are_at_right_angles():
    node = cc.Scene().add()
    node.look_at((1, 2, 3))
    want = np.linalg.inv(ref.look_at((0, 0, 0), (-1, -2, -3)))  # a camera looks along -Z
    np.testing.assert_allclose(node.world_matrix, want, atol=1e-12)


def test_parents_of_any_transform(rng):
    for _ in range(20):
        scene = cc.Scene()
        matrix = np.eye(4)
        matrix[:3] = rng.normal(size=(3, 4))  # with shears and mirrors
        above = scene.add(matrix=matrix)
        middle = scene.add(parent=above, rotation=rng.normal(size=4), scale=(1, 2, -3))
        node = scene.add(parent=middle, position=rng.normal(size=3), scale=0.5)
        target, up = rng.normal(size=(2, 3))
        node.look_at(target, up=up)
        check_front(node, target, up)


@pytest.mark.parametrize(
    ("target", "up", "top"),
    [
        ((0, 5, 0), (0, 1, 0), (0, 0, -1)),
        ((0, -5, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 0, 5), (0, 0, 1), (0, 1, 0)),
        ((-5, 0, 0), (2, 0, 0), (0, 1, 0)),
        ((3, 3, 3), (-1, -1, -1), (0, 1, 0)),
    ],
)
def test_an_up_along_the_direction_is_replaced(target, up, top):
    node = cc.Scene().add()
    node.look_at(target, up=up)
    check_front(node, target, top)


def test_a_matrix_becomes_parts():
    node = cc.Scene().add(matrix=ref.trs((1, 2, 3), (1, 2, 3, 4), (1, 2, 3)))
    node.look_at((0, 0, 0))
    check_front(node, (0, 0, 0))
    np.testing.assert_allclose(node.scale, (1, 2, 3))


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda n: n.look_at((1, 2, 3)), ValueError, "expected a target away from the node"),
        (lambda n: n.look_at((0, 0, 0), up=(0, 0, 0)), ValueError, "expected an up vector of some"),
        (lambda n: n.look_at((0, np.nan, 0)), ValueError, "target.*finite"),
        (lambda n: n.look_at((0, 0)), ValueError, r"target: expected shape \(3,\), got \(2,\)"),
        (lambda n: n.look_at("here"), TypeError, "target: expected"),
        (lambda n: n.look_at((0, 0, 0), (0, 1, 0)), TypeError, "by position"),
    ],
)
def test_bad_arguments_change_nothing(call, error, message):
    node = cc.Scene().add(position=(1, 2, 3), rotation=(1, 2, 3, 4))
    before = node.matrix
    with pytest.raises(error, match=message):
        call(node)
    np.testing.assert_array_equal(node.matrix, before)


def test_a_shear_of_its_own_is_an_error():
    matrix = np.eye(4)
    matrix[0, 1] = 1
    with pytest.raises(ValueError, match="without shear"):
        cc.Scene().add(matrix=matrix).look_at((0, 0, 5))


@pytest.mark.parametrize("kind", [cc.PerspectiveCamera, cc.OrthographicCamera])
def test_cameras(kind):
    camera = kind(position=(1, 2, 3), up=(0.2, 1, 0))
    camera.look_at((4, 0, -2))
    np.testing.assert_allclose(camera.view, ref.look_at((1, 2, 3), (4, 0, -2), (0.2, 1, 0)))
    camera.look_at((1, 0, 3), up=(0, 0, -1))
    np.testing.assert_allclose(camera.view, ref.look_at((1, 2, 3), (1, 0, 3), (0, 0, -1)))
    np.testing.assert_array_equal(camera.up, (0, 0, -1))
    for target, up in (((1, 2, 3), None), ((1, 9, 3), (0, 1, 0)), ((0, 0, np.inf), None)):
        with pytest.raises(ValueError, match=r"target|up"):
            camera.look_at(target, up=up)
    np.testing.assert_array_equal(camera.target, (1, 0, 3))


def test_a_camera_of_matrices_has_no_such_method():
    assert not hasattr(cc.Camera(view=np.eye(4), projection=np.eye(4)), "look_at")


@pytest.mark.parametrize("make", [cc.PerspectiveCamera, cc.OrthographicCamera])
def test_a_node_as_the_target_stands_for_its_origin(make):
    scene = cc.Scene()
    group = scene.add(position=(1, 2, 3), scale=2)
    hero = scene.add(cc.Mesh.box(), position=(4, 0, -1), parent=group)
    origin = hero.world_matrix[:3, 3]
    np.testing.assert_allclose(origin, [9, 2, 1])
    camera = make(position=(0, 1, 5))
    camera.look_at(hero)
    np.testing.assert_allclose(camera.target, origin)
    eye = scene.add(cc.Mesh.box(), position=(-3, 1, 2))
    eye.look_at(hero)
    towards = origin - eye.position
    np.testing.assert_allclose(
        eye.world_matrix[:3, 2], towards / np.linalg.norm(towards), atol=1e-12
    )
