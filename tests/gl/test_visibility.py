"""visible, in_captures and exclude, over whole subtrees."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc

CAMERA: dict[str, Any] = {"fov": 70, "position": (0, 0, 6), "target": (0, 0, 0)}


@pytest.fixture
def tree():
    """The nodes root > child > grandchild, each with a box of its own, and one node beside them."""
    scene = cc.Scene()
    nodes = {}
    parent = None
    for index, name in enumerate(("root", "child", "grandchild")):
        place = (-2, 0, 0) if index == 0 else (1.2, 0, 0)
        parent = scene.add(
            cc.Mesh.box(0.8), cc.BasicMaterial(), position=place, parent=parent, name=name
        )
        nodes[name] = parent
    nodes["other"] = scene.add(
        cc.Mesh.box(0.8), cc.BasicMaterial(), position=(0, 2, 0), name="other"
    )
    return scene, nodes


def in_frame(renderer, scene):
    camera = cc.PerspectiveCamera(**CAMERA)
    return set(np.unique(renderer.render(scene, camera, (32, 32), outputs=("id",)).id)) - {0}


def in_capture(renderer, scene, **options):
    cube = renderer.capture(scene, position=(0, 0, 6), size=32, outputs=("id",), **options)
    return set(np.unique(cube.id)) - {0}


CASES = {
    "none": (None, {1, 2, 3, 4}),
    "root": ("root", {4}),
    "child": ("child", {1, 4}),
    "grandchild": ("grandchild", {1, 2, 4}),
    "other": ("other", {1, 2, 3}),
}
cases = pytest.mark.parametrize(("name", "left"), CASES.values(), ids=CASES)


@cases
def test_visible_false_hides_the_subtree_everywhere(any_path, tree, name, left):
    scene, nodes = tree
    if name:
        nodes[name].visible = False
    assert in_frame(any_path, scene) == left
    assert in_capture(any_path, scene) == left


@cases
def test_in_captures_false_hides_the_subtree_in_captures_only(any_path, tree, name, left):
    scene, nodes = tree
    if name:
        nodes[name].in_captures = False
    assert in_frame(any_path, scene) == {1, 2, 3, 4}
    assert in_capture(any_path, scene) == left


@cases
def test_exclude_hides_the_subtree_in_that_capture_only(any_path, tree, name, left):
    scene, nodes = tree
    exclude = [nodes[name]] if name else []
    assert in_capture(any_path, scene, exclude=exclude) == left
    assert in_capture(any_path, scene) == {1, 2, 3, 4}


def test_a_visible_child_of_a_hidden_parent_stays_hidden(renderer, tree):
    scene, nodes = tree
    nodes["root"].visible = False
    nodes["child"].visible = True
    assert in_frame(renderer, scene) == {4}


def test_moving_a_child_out_shows_it(renderer, tree):
    scene, nodes = tree
    nodes["root"].visible = False
    nodes["child"].parent = None
    assert in_frame(renderer, scene) == {2, 3, 4}


def test_removed_nodes_are_gone_with_their_subtree(renderer, tree):
    scene, nodes = tree
    scene.remove(nodes["child"])
    assert in_frame(renderer, scene) == {1, 4}


def test_exclude_takes_any_sequence(renderer, tree):
    scene, nodes = tree
    assert in_capture(renderer, scene, exclude=(nodes["other"], nodes["child"])) == {1}
    assert in_capture(renderer, scene, exclude=iter([nodes["other"]])) == {1, 2, 3}


@pytest.mark.parametrize("exclude", [["ball"], [3], 3, [None]])
def test_exclude_refuses_what_is_no_node(renderer, tree, exclude):
    with pytest.raises(TypeError):
        renderer.capture(tree[0], size=4, exclude=exclude)


def test_excluding_a_node_of_another_scene_is_refused_or_without_effect(renderer, tree):
    stranger = cc.Scene().add(cc.Mesh.box(1))
    try:
        got = in_capture(renderer, tree[0], exclude=[stranger])
    except ValueError as error:
        assert "scene" in str(error)  # noqa: PT017
    else:
        assert got == {1, 2, 3, 4}
