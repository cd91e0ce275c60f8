"""Animations: sampling against numpy, scene.set_time, errors, pickles."""

import copy
import gc
import pickle
import re

import numpy as np
import pytest

import cubecam as cc
from tests.reference.animation import sample

WIDTHS = {"translation": 3, "rotation": 4, "scale": 3, "weights": 5}
MODES = ("step", "linear", "cubic")


def random_channel(rng, path, mode, count, node=None):
    times = np.cumsum(rng.uniform(0.1, 2, count)) - 1
    values = rng.normal(size=((3 if mode == "cubic" else 1) * count, WIDTHS[path]))
    node = node if node is not None else cc.Scene().add()
    return cc.AnimationChannel(node, path, times, values, interpolation=mode)


@pytest.mark.parametrize("count", [1, 2, 7])
@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("path", WIDTHS)
def test_samples_equal_the_formulas_of_gltf(path, mode, count):
    rng = np.random.default_rng(count)
    channel = random_channel(rng, path, mode, count)
    low, high = channel.times[0] - 1, channel.times[-1] + 1
    for seconds in [*channel.times, *rng.uniform(low, high, 60), low, high]:
        want = sample(path, mode, channel.times, channel.values, seconds)
        np.testing.assert_allclose(channel.sample(seconds), want, atol=1e-12, err_msg=str(seconds))


def test_rotations_go_the_shorter_way():
    node = cc.Scene().add()
    ends = [cc.axis_angle((0, 1, 0), 10), -cc.axis_angle((0, 1, 0), 50)]
    channel = cc.AnimationChannel(node, "rotation", [0, 1], ends)
    middle = channel.sample(0.25)
    np.testing.assert_allclose(middle, cc.axis_angle((0, 1, 0), 20), atol=1e-12)
    same = cc.AnimationChannel(node, "rotation", [0, 1], [ends[0], -ends[0]])
    np.testing.assert_allclose(same.sample(0.5), ends[0], atol=1e-12)


def test_a_spline_through_zero_keeps_the_rotation_of_its_key():
    rows = np.zeros((6, 4))
    rows[1, 0], rows[4, 0] = 1, -1
    channel = cc.AnimationChannel(cc.Scene().add(), "rotation", [0, 2], rows, interpolation="cubic")
    assert channel.sample(1.0).tolist() == [1, 0, 0, 0]


def test_a_channel_keeps_what_it_was_given():
    scene = cc.Scene()
    node = scene.add()
    times, values = np.array([0, 0.1, 3]), np.arange(9.0).reshape(3, 3)
    channel = cc.AnimationChannel(node, "translation", times, values, interpolation="step")
    animation = cc.Animation([channel], name="walk")
    assert channel.node is node
    assert (channel.path, channel.interpolation) == ("translation", "step")
    np.testing.assert_array_equal(channel.times, times)
    np.testing.assert_array_equal(channel.values, values)
    assert not channel.values.flags.writeable
    assert animation.channels[0] is channel
    assert (animation.name, animation.duration) == ("walk", 3.0)
    assert cc.Animation([]).duration == 0
    values[:] = 7
    assert channel.values[0, 1] == 1


def bad_channels():
    node = cc.Scene().add()
    good = {"node": node, "path": "translation", "times": [0, 1], "values": np.zeros((2, 3))}
    return {
        "no times": ({**good, "times": []}, "times of at least 1 key"),
        "equal times": ({**good, "times": [1, 1]}, "times that increase strictly, got 1, then 1"),
        "times back": ({**good, "times": [1, 0]}, "increase strictly, got 1, then 0"),
        "nan": ({**good, "times": [0, np.nan]}, "times"),
        "matrix of times": ({**good, "times": [[0, 1]]}, r"times: expected shape \(K,\)"),
        "rows": ({**good, "values": np.zeros((3, 3))}, "2 rows for 2 times, got 3"),
        "cubic": ({**good, "interpolation": "cubic"}, r"6 rows for 2 times \(in-tangent"),
        "width": ({**good, "path": "rotation"}, '4 numbers a row for "rotation", got 3'),
        "no weights": (
            {**good, "path": "weights", "values": np.zeros((2, 0))},
            "at least 1 number a row",
        ),
        "infinite": ({**good, "values": np.full((2, 3), np.inf)}, "values"),
        "zero turn": (
            {**good, "path": "rotation", "values": np.eye(4)[:2] * [[1], [0]]},
            "some length, got length 0 at key 1",
        ),
        "path": ({**good, "path": "position"}, "path: expected .*translation"),
        "mode": ({**good, "interpolation": "spline"}, "interpolation: expected .*cubic"),
    }


BAD = bad_channels()


@pytest.mark.parametrize("case", BAD)
def test_bad_channels_are_refused(case):
    options, message = BAD[case]
    with pytest.raises(ValueError, match=message):
        cc.AnimationChannel(**{**options, "node": cc.Scene().add()})


@pytest.mark.parametrize("node", [None, 3, "node"])
def test_a_channel_needs_a_node(node):
    with pytest.raises(TypeError, match="node: expected a Node"):
        cc.AnimationChannel(node, "scale", [0], [(1, 1, 1)])


def test_bad_animations_are_refused():
    rng = np.random.default_rng(1)
    node, other = cc.Scene().add(), cc.Scene().add()
    same = [random_channel(rng, "scale", "linear", 2, node) for _ in range(2)]
    with pytest.raises(ValueError, match='got two of "scale" for node 1'):
        cc.Animation(same)
    cc.Animation([same[0], random_channel(rng, "scale", "linear", 2, other)])
    for bad in (same[0], 5, [node]):
        with pytest.raises(TypeError, match="channels: expected"):
            cc.Animation(bad)  # type: ignore[arg-type]


def moving_scene(rng):
    """A scene of a few nodes with random channels of all paths but weights, in two animations."""
    scene = cc.Scene()
    nodes = [scene.add(cc.Mesh.box(), name=str(i)) for i in range(4)]
    for name in ("first", "second"):
        channels = [
            random_channel(rng, path, mode, 5, node)
            for node, mode in zip(nodes, ("step", "linear", "cubic", "linear"), strict=True)
            for path in ("translation", "rotation", "scale")
        ]
        scene.add(cc.Animation(channels[:-2], name=name))
    return scene, nodes


def test_set_time_moves_the_nodes():
    scene, nodes = moving_scene(np.random.default_rng(2))
    read = {"translation": "position", "rotation": "rotation", "scale": "scale"}
    for which, animation in enumerate(scene.animations):
        for key in (which, which - 2, animation.name, animation):
            for seconds in (-9, 0.3, 1.7, 99):
                before = nodes[3].rotation.copy(), nodes[3].scale.copy()
                assert scene.set_time(seconds, key) is scene
                for channel in animation.channels:
                    got = getattr(channel.node, read[channel.path])
                    want = channel.sample(seconds)
                    np.testing.assert_allclose(got, want, atol=1e-12)
                # What no channel names stays.
                np.testing.assert_array_equal(nodes[3].rotation, before[0])
                np.testing.assert_array_equal(nodes[3].scale, before[1])


def test_set_time_moves_children_and_bounds():
    scene = cc.Scene()
    arm = scene.add()
    hand = scene.add(cc.Mesh.box(1), position=(1, 0, 0), parent=arm)
    turns = [cc.axis_angle((0, 0, 1), degrees) for degrees in (0, 90)]
    scene.add(cc.Animation([cc.AnimationChannel(arm, "rotation", [0, 1], turns)]))
    scene.set_time(1)
    np.testing.assert_allclose(hand.world_matrix[:3, 3], (0, 1, 0), atol=1e-12)
    np.testing.assert_allclose(scene.bounds.mean(0), (0, 1, 0), atol=1e-12)


def test_weights_are_set():
    target = cc.MorphTarget(positions=np.ones((24, 3)))
    box = cc.Mesh.box()
    mesh = cc.Mesh(box.positions, box.indices, normals=box.normals, morph_targets=[target, target])
    scene = cc.Scene()
    node = scene.add(mesh)
    channel = cc.AnimationChannel(node, "weights", [0, 2], [(0, 1), (1, 0)])
    scene.add(cc.Animation([channel]))
    assert scene.set_time(0.5).nodes[0].weights.tolist() == [0.25, 0.75]
    wrong = cc.AnimationChannel(node, "weights", [0], [(1, 2, 3)])
    moves = cc.AnimationChannel(node, "translation", [0], [(1, 2, 3)])
    scene.add(cc.Animation([moves, wrong], name="wrong"))
    with pytest.raises(ValueError, match="as many weights as the mesh has morph targets, 2, got 3"):
        scene.set_time(0, "wrong")
    assert node.position.tolist() == [0, 0, 0]
    assert node.weights.tolist() == [0.25, 0.75]


def test_which_animation():
    scene = cc.Scene()
    with pytest.raises(IndexError, match="of the scene's 0 animations, got 0"):
        scene.set_time(0)
    scene.add(cc.Animation([], name="walk"))
    scene.add(cc.Animation([]))
    for index in (2, -3):
        with pytest.raises(IndexError, match=f"of the scene's 2 animations, got {index}"):
            scene.set_time(0, index)
    with pytest.raises(KeyError, match="got 'wal'; did you mean 'walk'"):
        scene.set_time(0, "wal")
    with pytest.raises(KeyError, match="got ''"):
        scene.set_time(0, "")
    for bad in (True, None, 1.5):
        with pytest.raises(TypeError, match="animation: expected an index, a name or an Animation"):
            scene.set_time(0, bad)  # type: ignore[arg-type]
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match="seconds"):
            scene.set_time(bad)


def test_a_scale_of_zero_stays_invertible():
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box())
    scene.add(
        cc.Animation([cc.AnimationChannel(node, "scale", [0, 1], [(0, 1, 0), (1, -1, -1e-9)])])
    )
    assert scene.set_time(0).nodes[0].scale.tolist() == [1e-6, 1, 1e-6]
    assert scene.set_time(0.5).nodes[0].scale.tolist() == [0.5, 1e-6, -1e-6]
    assert scene.set_time(1).nodes[0].scale.tolist() == [1, -1, -1e-6]


def test_nodes_of_a_whole_matrix():
    """They are taken apart; a shear, which parts cannot express, is refused and nothing moves."""
    scene = cc.Scene()
    turned = np.eye(4)
    turned[:3, :3] = [[0, -2, 0], [2, 0, 0], [0, 0, 2]]
    node, other = scene.add(matrix=turned), scene.add()
    shift = cc.AnimationChannel(node, "translation", [0], [(1, 2, 3)])
    moved = cc.AnimationChannel(other, "translation", [0], [(1, 2, 3)])
    scene.add(cc.Animation([moved, shift]))
    scene.set_time(0)
    turned[:3, 3] = 1, 2, 3
    np.testing.assert_allclose(node.matrix, turned, atol=1e-12)
    sheared = np.eye(4)
    sheared[0, 1] = 0.5
    node.matrix = sheared
    other.position = (0, 0, 0)
    with pytest.raises(ValueError, match="shear"):
        scene.set_time(0)
    assert other.position.tolist() == [0, 0, 0]


def test_nodes_of_other_scenes():
    scene, other = cc.Scene(), cc.Scene()
    node, foreign = scene.add(), other.add()
    channels = [
        cc.AnimationChannel(one, "translation", [0], [(1, 2, 3)]) for one in (node, foreign)
    ]
    with pytest.raises(ValueError, match="nodes of this scene, got node 1, which is in another"):
        scene.add(cc.Animation(channels))
    scene.set_time(0, cc.Animation(channels))  # skips it
    assert foreign.position.tolist() == [0, 0, 0]
    assert node.position.tolist() == [1, 2, 3]


def test_nodes_that_left_are_skipped():
    scene = cc.Scene()
    stays, leaves = scene.add(), scene.add()
    channels = [
        cc.AnimationChannel(one, "translation", [0], [(1, 2, 3)]) for one in (stays, leaves)
    ]
    animation = scene.add(cc.Animation(channels))
    scene.remove(leaves)
    scene.set_time(0)
    assert leaves.position.tolist() == [0, 0, 0]
    del leaves
    assert channels[1].node is None
    assert "no node" in repr(channels[1])
    scene.set_time(0)
    copied = pickle.loads(pickle.dumps(scene))
    assert [channel.node for channel in copied.animations[0].channels] == [copied.nodes[0], None]
    assert animation.channels[1] is channels[1]


def test_add_and_remove():
    scene = cc.Scene()
    walk = cc.Animation([], name="walk")
    assert scene.add(walk) is walk
    assert walk in scene
    assert scene.animations == (walk,)
    with pytest.raises(ValueError, match="not in the scene, got one that is"):
        scene.add(walk)
    scene.remove(walk)
    assert walk not in scene
    with pytest.raises(ValueError, match="an animation of this scene"):
        scene.remove(walk)
    scene.add(walk)
    scene.clear()
    assert not scene.animations


@pytest.mark.parametrize("make", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_copies_of_a_scene_hold_its_animations(make):
    scene, nodes = moving_scene(np.random.default_rng(3))
    same = make(scene)
    assert [one.name for one in same.animations] == ["first", "second"]
    for ours, theirs in zip(scene.animations, same.animations, strict=True):
        for a, b in zip(ours.channels, theirs.channels, strict=True):
            assert b.node is same.nodes[a.node.id - 1]
            assert (a.path, a.interpolation) == (b.path, b.interpolation)
            np.testing.assert_array_equal(a.times, b.times)
            np.testing.assert_array_equal(a.values, b.values)
    same.set_time(0.7, "second")
    assert (same.nodes[0].matrix != nodes[0].matrix).any()
    scene.set_time(0.7, "second")
    np.testing.assert_array_equal(same.nodes[0].matrix, nodes[0].matrix)


def test_pickles_that_start_at_a_channel_or_an_animation():
    scene, nodes = moving_scene(np.random.default_rng(4))
    animation = scene.animations[0]
    channel, kept = pickle.loads(pickle.dumps((animation.channels[0], scene)))
    assert channel is kept.animations[0].channels[0]
    assert channel.node is kept.nodes[0]
    same, kept = pickle.loads(pickle.dumps((animation, scene)))
    assert same is kept.animations[0]
    loose = pickle.loads(pickle.dumps(animation))
    assert [c.path for c in loose.channels] == [c.path for c in animation.channels]
    assert nodes[0] in scene


def test_nothing_leaks():
    scene, nodes = moving_scene(np.random.default_rng(5))
    lights = [cc.PointLight(parent=node) for node in nodes]  # know whether the core has the nodes
    animations = scene.animations
    del scene, nodes
    gc.collect()
    assert [light.parent for light in lights] == [None] * 4
    assert all(channel.node is None for one in animations for channel in one.channels)


def test_texts():
    scene = cc.Scene()
    node = scene.add(name="a")
    channel = cc.AnimationChannel(node, "scale", [0.5], [(1, 1, 1)])
    assert repr(channel) == "AnimationChannel(node 1, 'scale', 1 key, 0.5 to 0.5 s, 'linear')"
    assert repr(cc.Animation([channel])) == "Animation(1 channel, 0.5 s)"
    assert re.match(r"Animation\(name='n', 0 channels, 0 s\)", repr(cc.Animation([], name="n")))
