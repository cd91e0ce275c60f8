"""Joints, weights and morph targets as data: checks, copies, pickles, who keeps what alive."""

import gc
import pickle
import re
import weakref
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
TRIANGLES = [[0, 1, 2], [0, 2, 3]]
RNG = np.random.default_rng(1)
JOINTS = RNG.integers(0, 3, (4, 8))
SHARES = RNG.uniform(0.1, 1, (4, 8)).astype(np.float32)
UVS = np.array(CORNERS, np.float32)[:, :2]


def wrong(value) -> Any:
    """A value of a type that the call refuses."""
    return value


def target(**more):
    return cc.MorphTarget(
        positions=RNG.normal(size=(4, 3)), colors=RNG.random((4, 3)), name="smile", **more
    )


def quad(**more):
    return cc.Mesh(CORNERS, TRIANGLES, uvs=UVS, joints=JOINTS, joint_weights=SHARES, **more)


def test_arrays_come_back_as_they_were_given():
    mesh = quad(morph_targets=[target(), target(normals=RNG.normal(size=(4, 3)))])
    assert mesh.joints.dtype == np.uint16
    np.testing.assert_array_equal(mesh.joints, JOINTS)
    np.testing.assert_array_equal(mesh.joint_weights, SHARES)
    assert [t.name for t in mesh.morph_targets] == ["smile", "smile"]
    assert mesh.morph_targets[0].colors.shape == (4, 4)
    np.testing.assert_array_equal(mesh.morph_targets[0].colors[:, 3], 0)
    assert mesh.morph_targets[0].normals is None
    for array in (mesh.joints, mesh.joint_weights, mesh.morph_targets[0].positions):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    plain = cc.Mesh(CORNERS, TRIANGLES)
    assert plain.joints is None
    assert plain.joint_weights is None
    assert plain.morph_targets == ()


def test_the_number_of_a_joint_without_weight_means_nothing():
    shares = np.where(JOINTS == 2, 0, SHARES)
    numbers = np.where(JOINTS == 2, 60_000, JOINTS)
    mesh = cc.Mesh(CORNERS, TRIANGLES, joints=numbers, joint_weights=shares)
    np.testing.assert_array_equal(mesh.joints, np.where(JOINTS == 2, 0, JOINTS))
    scene = cc.Scene()
    scene.add(mesh, skin=cc.Skin([scene.add(), scene.add()]))


def test_an_update_replaces_joints_weights_and_targets():
    mesh = quad(morph_targets=[target()])
    mesh.update(joint_weights=SHARES[::-1])
    np.testing.assert_array_equal(mesh.joint_weights, SHARES[::-1])
    np.testing.assert_array_equal(mesh.joints, JOINTS)
    mesh.update(joints=JOINTS[::-1])
    np.testing.assert_array_equal(mesh.joints, JOINTS[::-1])
    mesh.update(joints=JOINTS[:, :4], joint_weights=SHARES[:, :4])
    assert mesh.joints.shape == (4, 4)
    mesh.positions = mesh.positions * 2
    assert mesh.joints.shape == (4, 4)
    assert len(mesh.morph_targets) == 1
    mesh.morph_targets = [target(), target()]
    assert len(mesh.morph_targets) == 2
    mesh.update(morph_targets=[])
    assert mesh.morph_targets == ()


@pytest.mark.parametrize("uv_set", [None, 0])
def test_copies_with_other_vertices_keep_joints_and_targets(uv_set):
    """Each vertex of the copy has the joints and displacements of the vertex from which it was made."""
    mesh = quad(morph_targets=[target(uvs=UVS)])
    copy = mesh.flat_shaded() if uv_set is None else mesh.with_tangents(uv_set=uv_set)
    for i, place in enumerate(copy.positions):
        source = np.flatnonzero((mesh.positions == place).all(axis=1))[0]
        np.testing.assert_array_equal(copy.joints[i], mesh.joints[source])
        np.testing.assert_array_equal(copy.joint_weights[i], mesh.joint_weights[source])
        for name in ("positions", "colors", "uvs"):
            got, want = (getattr(m.morph_targets[0], name) for m in (copy, mesh))
            np.testing.assert_array_equal(got[i], want[source])


def test_a_resized_mesh_has_resized_targets_and_no_joints():
    mesh = cc.Mesh(CORNERS, TRIANGLES, morph_targets=[target()])
    small = mesh.resized(0.5)
    got, given = small.morph_targets[0].positions, mesh.morph_targets[0].positions
    np.testing.assert_allclose(np.array(got), 0.5 * np.array(given), rtol=1e-6)
    np.testing.assert_array_equal(small.morph_targets[0].colors, mesh.morph_targets[0].colors)
    with pytest.raises(ValueError, match="expected a mesh without joints"):
        quad().resized(1)


def test_weights_belong_to_the_targets_of_the_mesh():
    scene = cc.Scene()
    node = scene.add(quad(morph_targets=[target(), target()]))
    assert node.weights.tolist() == [0, 0]
    assert node.weights.dtype == np.float32
    node.weights = [0.5, -2]
    assert node.weights.tolist() == [0.5, -2]
    with pytest.raises(ValueError, match="read-only"):
        node.weights[0] = 1
    node.mesh.morph_targets = [target()]
    assert node.weights.tolist() == [0.5]
    node.mesh.morph_targets = [target(), target(), target()]
    assert node.weights.tolist() == [0.5, -2, 0]
    node.mesh = quad(morph_targets=[target()])
    assert node.weights.tolist() == [0]
    node.mesh = None
    assert node.weights.tolist() == []
    assert scene.add(quad()).weights.tolist() == []


BAD = {
    "joints alone": (lambda: cc.Mesh(CORNERS, TRIANGLES, joints=JOINTS), "got only joints"),
    "weights alone": (
        lambda: cc.Mesh(CORNERS, TRIANGLES, joint_weights=SHARES),
        "got only joint_weights",
    ),
    "3 joints": (
        lambda: cc.Mesh(CORNERS, TRIANGLES, joints=JOINTS[:, :3], joint_weights=SHARES[:, :3]),
        re.escape("joints: expected shape (4, 4 k), got (4, 3)"),
    ),
    "other shapes": (
        lambda: cc.Mesh(CORNERS, TRIANGLES, joints=JOINTS, joint_weights=SHARES[:, :4]),
        re.escape("joint_weights: expected shape (4, 8), got (4, 4)"),
    ),
    "negative weight": (
        lambda: cc.Mesh(CORNERS, TRIANGLES, joints=JOINTS, joint_weights=-SHARES),
        "expected joint_weights of 0 or more, got -",
    ),
    "no array": (cc.MorphTarget, "expected a morph target of at least one array, got none"),
    "unequal lengths": (
        lambda: target(uvs=np.ones((3, 2))),
        "expected as many uvs as other numbers of the morph target, 4, got 3",
    ),
    "nan": (lambda: cc.MorphTarget(normals=[[np.nan, 0, 0]]), "normals"),
    "another number of vertices": (
        lambda: quad(morph_targets=[cc.MorphTarget(positions=np.ones((3, 3)))]),
        "displacements of a morph target as positions, 4, got 3",
    ),
    "two weights": (lambda: cc.Scene().add(quad(), weights=[1, 2]), "morph targets, 0, got 2"),
    "no joint": (lambda: cc.Skin([]), "expected at least one joint, got none"),
    "two matrices": (
        lambda: cc.Skin([cc.Scene().add()], [np.eye(4)] * 2),
        re.escape("inverse_bind_matrices: expected shape (1, 4, 4), got (2, 4, 4)"),
    ),
    "last row": (
        lambda: cc.Skin([cc.Scene().add()], [np.ones((4, 4))]),
        re.escape("got (1, 1, 1, 1) for joint 0"),
    ),
}


@pytest.mark.parametrize(("call", "words"), BAD.values(), ids=BAD)
def test_bad_values_are_errors(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_bad_joints_and_kinds_are_errors():
    with pytest.raises(IndexError, match="joints: expected indices from 0 to 65536 - 1"):
        cc.Mesh(CORNERS, TRIANGLES, joints=JOINTS + 65536, joint_weights=SHARES)
    with pytest.raises(
        TypeError, match="joints: expected Nodes, or None for a node that is gone, got Scene"
    ):
        cc.Skin([wrong(cc.Scene())])
    with pytest.raises(TypeError, match="morph_targets: expected MorphTargets, got Mesh"):
        quad(morph_targets=[wrong(quad())])
    with pytest.raises(TypeError, match="skin: expected a Skin or None, got Node"):
        cc.Scene().add(quad(), skin=wrong(cc.Scene().add()))


def test_a_skin_must_fit_the_mesh_and_the_scene():
    scene, other = cc.Scene(), cc.Scene()
    joints = [scene.add() for _ in range(3)]
    skin = cc.Skin(joints)
    with pytest.raises(
        ValueError, match="expected a mesh with joints and joint_weights for a skin"
    ):
        scene.add(cc.Mesh.box(), skin=skin)
    with pytest.raises(
        ValueError, match="expected a skin of at least 3 joints, which the mesh names, got 2"
    ):
        scene.add(quad(), skin=cc.Skin(joints[:2]))
    for make in (
        lambda: other.add(quad(), skin=skin),
        lambda: setattr(other.add(quad()), "skin", skin),
    ):
        with pytest.raises(
            ValueError, match="expected a skin whose joints are in the node's scene"
        ):
            make()
    node = scene.add(quad(), skin=skin)
    with pytest.raises(ValueError, match="expected a mesh with joints"):
        node.mesh = cc.Mesh.box()
    assert node.skin is skin
    node.skin = None
    node.mesh = cc.Mesh.box()
    assert len(scene.nodes) == 4


@copies
def test_copies_of_a_scene_have_skins_of_their_own(make_copy):
    scene = cc.Scene()
    joints = [scene.add(position=(i, 0, 0)) for i in range(3)]
    skin = cc.Skin(joints, np.tile(np.diag((2.0, 3, 4, 1)), (3, 1, 1)), skeleton=joints[0])
    mesh = quad(morph_targets=[target()])
    nodes = [scene.add(mesh, skin=skin, weights=[0.5]) for _ in range(2)]
    again = make_copy(scene)
    one, two = again.nodes[3:]
    assert one.skin is two.skin is not skin
    assert one.skin.joints == again.nodes[:3]
    assert one.skin.skeleton is again.nodes[0]
    np.testing.assert_array_equal(one.skin.inverse_bind_matrices, skin.inverse_bind_matrices)
    assert one.weights.tolist() == [0.5]
    np.testing.assert_array_equal(one.world_bounds, nodes[0].world_bounds)
    again.nodes[1].position = (50, 0, 0)
    assert one.world_bounds[1, 0] > 5
    assert nodes[0].world_bounds[1, 0] < 20


def test_older_pickles_of_nodes_have_no_skin_and_no_weights():
    scene = cc.Scene()
    scene.add(quad(morph_targets=[target()]), weights=[2])
    reduced: Any = scene.__reduce__()
    remake, arguments, (number, state) = reduced
    (record,) = state["nodes"]
    assert record[2][14] is None
    assert record[2][15].tolist() == [2]
    again = remake(*arguments)
    again.__setstate__((number, {**state, "nodes": [(*record[:2], record[2][:14])]}))
    assert again.nodes[0].skin is None
    assert again.nodes[0].weights.tolist() == [0]


def test_skins_keep_no_joint_alive_and_make_no_circle():
    """The mesh's node stands above its joints, as files have it; all go with the scene."""
    scene = cc.Scene()
    node = scene.add(quad())
    joints = [scene.add(parent=node) for _ in range(3)]
    node.skin = cc.Skin(joints, skeleton=node)
    skin = node.skin
    gone = [weakref.ref(thing) for thing in (scene, node, *joints)]
    del scene, node, joints
    gc.collect()
    assert [ref() for ref in gone] == [None] * 5
    assert skin.joints == (None, None, None)
    assert skin.skeleton is None
    assert pickle.loads(pickle.dumps(skin)).joints == (None, None, None)
