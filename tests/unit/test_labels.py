"""Labels of nodes: values, errors, pickles, searches."""

import copy
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies


def test_default_and_any_int32():
    scene = cc.Scene()
    assert scene.add().label == 0
    for label in (-(2**31), -1, 0, 7, 2**31 - 1, np.int64(5), np.uint8(200)):
        node = scene.add(label=label)
        assert node.label == label
        node.label = 0
        node.label = label
        assert node.label == label
        assert type(node.label) is int


@pytest.mark.parametrize(
    ("label", "error", "message"),
    [
        (
            2**31,
            ValueError,
            "label: expected an int from -2147483648 to 2147483647, got 2147483648",
        ),
        (-(2**31) - 1, ValueError, "label: expected an int from -2147483648"),
        (10**30, ValueError, "label: expected an int from"),
        (1.0, TypeError, "label: expected an int, got 1.0"),
        (True, TypeError, "label: expected an int, got True"),
        ("car", TypeError, "label: expected an int, got 'car'"),
        (None, TypeError, "label: expected an int, got None"),
    ],
)
def test_bad_labels(label, error, message):
    scene = cc.Scene()
    node = scene.add(label=3)
    with pytest.raises(error, match=message):
        node.label = label
    with pytest.raises(error, match=message):
        scene.add(label=label)
    assert [node.label for node in scene] == [3]
    if label is not None:
        with pytest.raises(error, match=message):
            scene.find(label=label)


@copies
def test_copies_keep_labels(make_copy):
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box(), label=-3)
    assert [node.label for node in make_copy(scene)] == [-3]
    scene.remove(node)
    assert make_copy(node).label == -3


def test_older_states_have_none():
    """`Scene.__setstate__` reads states of nodes without their last member, too."""
    scene = cc.Scene()
    scene.add(name="old", label=4)
    closed: Any = scene.__reduce__()[2]
    version, state = closed
    state = copy.copy(state)
    state["nodes"] = [(id_, parent, node[:13]) for id_, parent, node in state["nodes"]]
    old = cc.Scene()
    old.__setstate__((version, state))
    assert [(node.name, node.label) for node in old] == [("old", 0)]


def test_find():
    scene = cc.Scene()
    car, tree, other = (
        scene.add(name=name, label=label) for name, label in (("car", 1), ("tree", 2), ("car", 2))
    )
    assert scene.find(label=2) == [tree, other]
    assert scene.find("car", label=1) == [car]
    assert scene.find("car") == [car, other]
    assert scene.find(label=0) == []
    with pytest.raises(TypeError, match="expected a name or a label, got neither"):
        scene.find()
    with pytest.raises(TypeError, match="name: expected a str or None, got int"):
        scene.find(2)  # type: ignore[arg-type]
