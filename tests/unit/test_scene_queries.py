"""Scenes as containers of nodes, and the bounds of scenes and nodes against numpy."""

import numpy as np
import pytest

import cubecam as cc

NOTHING = [[np.inf] * 3, [-np.inf] * 3]


@pytest.fixture
def scene():
    return cc.Scene()


def test_iteration_is_in_order_of_id(scene):
    parent = scene.add(name="parent")
    child = scene.add(parent=parent)
    other = scene.add(cc.Mesh.box())
    scene.remove(parent)
    late = scene.add()
    assert [*scene] == [other, late] == list(scene.nodes)
    assert len(scene) == 2
    assert child not in scene


def test_iteration_allows_changes(scene):
    for _ in range(3):
        scene.add()
    for node in scene:
        scene.remove(node)
    assert len(scene) == 0
    assert bool(scene), "`scene or other` must stay the scene"


def test_names(scene):
    first, second, other = (scene.add(name=name) for name in ("tree", "tree", "house"))
    assert scene["tree"] is first
    assert scene["house"] is other
    assert scene.find("tree") == [first, second]
    assert scene.find("tre") == []
    assert "tree" in scene
    assert "tre" not in scene
    scene.remove(first)
    assert scene["tree"] is second
    second.name = "bush"
    assert "tree" not in scene


@pytest.mark.parametrize(
    ("names", "wanted", "message"),
    [
        (["ball", "house"], "bal", "got 'bal'; did you mean 'ball'?"),
        (["lamp 1", "lamp 2"], "lamp", "got 'lamp'; did you mean 'lamp 2' or 'lamp 1'?"),
        (["ball"], "house", "got 'house'"),
        ([], "", "got ''"),
    ],
)
def test_a_missing_name_is_an_error_of_one_line(scene, names, wanted, message):
    for name in names:
        scene.add(name=name)
    with pytest.raises(KeyError) as caught:
        scene[wanted]
    assert caught.value.args == (f"expected the name of a node of the scene, {message}",)


def test_a_node_without_a_name_is_found_by_the_empty_name(scene):
    node = scene.add()
    assert scene[""] is node


@pytest.mark.parametrize("key", [0, 1.5, b"tree", slice(None)])
def test_a_key_that_is_no_name_is_an_error(scene, key):
    with pytest.raises(TypeError, match=f"name: expected .*, got {type(key).__name__}"):
        scene[key]


def world_positions(node):
    positions = node.mesh.positions.astype(float)
    return positions @ node.world_matrix[:3, :3].T + node.world_matrix[:3, 3]


def bounds_of(nodes):
    points = np.concatenate([world_positions(node) for node in nodes])
    return np.stack([points.min(axis=0), points.max(axis=0)])


def random_matrix(rng):
    matrix = np.eye(4)
    matrix[:3] = rng.normal(size=(3, 4))
    return matrix


def test_bounds_are_exact_for_the_vertices(scene, rng):
    top = scene.add(cc.Mesh.torus(), matrix=random_matrix(rng))
    low = scene.add(cc.Mesh.cone(), matrix=random_matrix(rng), parent=top)
    lower = scene.add(cc.Mesh.arrow(), matrix=random_matrix(rng), parent=low)
    alone = scene.add(cc.Mesh.sphere(2), scale=(-1, 2, 0.5), position=(9, 9, 9))
    for nodes, got in (
        ([top, low, lower, alone], scene.bounds),
        ([top, low, lower], top.world_bounds),
        ([low, lower], low.world_bounds),
        ([alone], alone.world_bounds),
    ):
        np.testing.assert_allclose(got, bounds_of(nodes), rtol=1e-12, atol=1e-12)
        assert got.shape == (2, 3)
        assert got.dtype == np.float64
        assert not got.flags.writeable


@pytest.mark.parametrize("turns", range(4))
def test_quarter_turns_are_exact(scene, turns):
    """The matrix of such a node takes another way through the code; both agree."""
    axes = np.roll(np.eye(3), turns, axis=0) * (-1) ** turns
    matrix = np.eye(4)
    matrix[:3, :3] = axes * (1, 2, 3)
    matrix[:3, 3] = (5, 6, 7)
    node = scene.add(cc.Mesh.cone(), matrix=matrix)
    np.testing.assert_array_equal(node.world_bounds, bounds_of([node]))


def test_hidden_nodes_do_not_count(scene):
    base = scene.add(cc.Mesh.box())
    hidden = scene.add(cc.Mesh.box(), position=(10, 0, 0), visible=False, parent=base)
    below = scene.add(cc.Mesh.box(), position=(10, 0, 0), parent=hidden)
    np.testing.assert_array_equal(scene.bounds, bounds_of([base]))
    np.testing.assert_array_equal(base.world_bounds, bounds_of([base]))
    np.testing.assert_array_equal(hidden.world_bounds, bounds_of([hidden, below]))
    np.testing.assert_array_equal(below.world_bounds, bounds_of([below]))
    hidden.visible = True
    np.testing.assert_array_equal(scene.bounds, bounds_of([base, hidden, below]))


def test_bounds_of_nothing_unite_with_any(scene):
    group = scene.add()
    scene.add(cc.PointLight())
    np.testing.assert_array_equal(scene.bounds, NOTHING)
    np.testing.assert_array_equal(group.world_bounds, NOTHING)
    box = cc.Mesh.box().bounds
    low, high = np.stack([scene.bounds, box], axis=1)
    np.testing.assert_array_equal([low.min(axis=0), high.max(axis=0)], box)


def test_bounds_follow_the_mesh_and_the_node(scene):
    mesh = cc.Mesh.plane()
    node = scene.add(mesh, rotation=cc.axis_angle((1, 1, 0), 20))
    mesh.positions = mesh.positions * 3 + 1
    node.position = (1, 2, 3)
    np.testing.assert_allclose(scene.bounds, bounds_of([node]), rtol=1e-12)
    scene.remove(node)
    np.testing.assert_allclose(node.world_bounds, bounds_of([node]), rtol=1e-12)


def test_bounds_of_a_long_chain(scene):
    node = scene.add(position=(1, 0, 0))
    for _ in range(19_999):
        node = scene.add(parent=node, position=(1, 0, 0))
    node.mesh = cc.Mesh.box()
    assert scene.bounds.tolist() == [[19_999.5, -0.5, -0.5], [20_000.5, 0.5, 0.5]]


@pytest.mark.parametrize("take", [
    lambda scene: cc.Scene(background=scene), lambda scene: cc.BasicMaterial(map=scene)
])  # fmt: skip
def test_a_scene_is_no_array(take, scene):
    """numpy makes an array of anything that can be iterated over."""
    with pytest.raises(TypeError, match=r"expected .*, got Scene"):
        take(scene)
