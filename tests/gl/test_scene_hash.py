"""cc.scene_hash: another one after each edit, the same one for equal scenes, in other processes, too."""

import copy
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.gl import edits
from tests.gl.full_world import full_world, random_camera

#: No scene leads to such objects.
OUTSIDE = ("StereoCamera", "ImageEffect")


def world_with_all(seed):
    """A world whose scene leads to everything that can be edited, but for OUTSIDE."""
    world = full_world(np.random.default_rng(seed))
    for texture in world.textures:
        texture.effects = world.effects[:1]
    for scene in (world.inner, world.spare):
        world.scene.add(
            cc.Mesh.plane(0.1, 0.1),
            cc.BasicMaterial(map=cc.RenderTexture(scene, random_camera(np.random.default_rng(1)))),
        )
    for camera in world.cameras:
        shown = cc.RenderTexture(world.spare, camera, size=(4, 4))
        world.scene.add(cc.Mesh.plane(0.1, 0.1), cc.BasicMaterial(map=shown))
    return world


def equal(one, other):
    """Whether two values of a property are equal; objects are only equal to themselves and to equal pickles."""
    if isinstance(one, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(one) == len(other) and all(map(equal, one, other))
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(equal(one[key], other[key]) for key in one)
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(np.asarray(one), np.asarray(other))
    return one is other or one == other or pickle.dumps(one) == pickle.dumps(other)


def value_of(thing, attribute):
    value = getattr(thing, attribute)
    return dict(value) if attribute in ("uniforms", "textures") else value


def bending(world):
    """The first node that bends: with a skin and weights."""
    return [node for node in world.scene.nodes if node.skin is not None or len(node.weights)]


@pytest.mark.slow
def test_each_edit_of_a_property_gives_another_hash():
    """The edit is tried on some objects until it changes one to which the scene leads."""
    rng = np.random.default_rng(3)
    world = world_with_all(0)
    never = []
    for name in edits.NAMES:
        kind, attribute = name.split(".")
        if kind in OUTSIDE:
            continue
        things = [t for t in world.things(getattr(cc, kind)) if edits.has_value(t, attribute)]
        things = [t for t in things if t not in (world.stereo.left, world.stereo.right)]
        things = (bending(world) if attribute in ("skin", "weights") else things)[:4]
        before = cc.scene_hash(world.scene)
        for thing in things * 9:
            old = value_of(thing, attribute)
            new = edits.value_for(type(thing), attribute)(world, rng, thing)
            setattr(thing, attribute, new)
            if equal(old, value_of(thing, attribute)):
                continue
            assert cc.scene_hash(world.scene) != before, (name, thing, old, new)
            break
        else:
            never.append(name)
    assert never == []


def test_each_edit_of_things_outside_a_scene_leaves_its_hash():
    world = world_with_all(0)
    before = cc.scene_hash(world.scene)
    world.stereo.layout = "anaglyph"
    world.stereo.left.fov = 33
    assert cc.scene_hash(world.scene) == before


def test_setting_what_is_there_leaves_the_hash():
    """A matrix is taken apart and a quaternion is scaled to length 1, which may change their last digits."""
    world = world_with_all(0)
    before = cc.scene_hash(world.scene)
    for name in edits.NAMES:
        kind, attribute = name.split(".")
        for thing in world.things(getattr(cc, kind))[:1]:
            if edits.has_value(thing, attribute) and name not in ("Node.matrix", "Node.rotation"):
                setattr(thing, attribute, value_of(thing, attribute))
    assert cc.scene_hash(world.scene) == before


def test_each_method_that_changes_a_scene_gives_another_hash():
    rng = np.random.default_rng(5)
    world = world_with_all(0)
    scene = world.scene
    node, cube, mesh = scene.nodes[4], world.cubes[0], world.meshes[0]
    scene.environment = cube
    animation = cc.Animation([cc.AnimationChannel(node, "rotation", [0, 1], np.eye(4)[:2])])
    changes = [
        lambda: cube.set_face(2, rng.random((4, 4, 3)).astype(np.float32)),
        lambda: scene.add(cc.Mesh.box(0.3), cc.PhongMaterial()),
        lambda: scene.remove(scene.nodes[-1]),
        lambda: scene.add(cc.SpotLight((0, 3, 0))),
        lambda: scene.add(animation),
        lambda: scene.set_time(0.3, animation),
        lambda: mesh.update(positions=mesh.positions + 1),
        lambda: scene.set_positions(scene.nodes[4:6], rng.random((2, 3))),
        lambda: scene.set_matrices([node], np.diag([2.0, 2, 2, 1])[None]),
        lambda: node.look_at((1, 2, 3)),
        lambda: world.spare.clear(),
    ]
    seen = {cc.scene_hash(scene)}
    for number, change in enumerate(changes):
        change()
        seen.add(cc.scene_hash(scene))
        assert len(seen) == number + 2


def test_equal_scenes_have_one_hash():
    world = world_with_all(0)
    want = cc.scene_hash(world.scene)
    assert len(want) == 64
    assert int(want, 16) > 0
    for other in (
        world_with_all(0).scene,
        copy.deepcopy(world.scene),
        pickle.loads(pickle.dumps(world.scene)),
    ):
        assert cc.scene_hash(other) == want
    assert cc.scene_hash(world_with_all(1).scene) != want


def test_sharing_does_not_count_and_the_order_of_nodes_does():
    def scene_of(meshes, materials, places=(1, 2)):
        scene = cc.Scene()
        for mesh, material, place in zip(meshes, materials, places, strict=True):
            scene.add(mesh, material, position=(place, 0, 0))
        return cc.scene_hash(scene)

    ball, red = cc.Mesh.sphere(1), cc.BasicMaterial(color="red")
    want = scene_of([ball, ball], [red, red])
    assert scene_of([ball, cc.Mesh.sphere(1)], [red, cc.BasicMaterial(color="red")]) == want
    assert scene_of([ball, ball], [red, red], (2, 1)) != want


def test_a_subclass_counts_as_its_class():
    class Ball(cc.BasicMaterial):
        pass

    scenes = [cc.Scene(), cc.Scene()]
    for scene, kind in zip(scenes, (cc.BasicMaterial, Ball), strict=True):
        scene.add(cc.Mesh.box(), kind(color="red"))
    assert cc.scene_hash(scenes[0]) == cc.scene_hash(scenes[1])


def test_another_process_finds_the_same_hash():
    """Texts have other hashes there, and objects other addresses."""
    code = (
        "import cubecam as cc; from tests.gl.test_scene_hash import world_with_all; "
        "print(cc.scene_hash(world_with_all(0).scene))"
    )
    want = cc.scene_hash(world_with_all(0).scene)
    made = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONHASHSEED": "77", "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert made.stdout.strip() == want


def test_numbers_in_a_texture_of_another_shape_or_type_count():
    """The same bytes in another shape or type are another picture."""
    pixels = np.arange(24, dtype=np.uint8)
    seen = set()
    for shaped in (pixels.reshape(2, 3, 4), pixels.reshape(3, 2, 4), pixels.reshape(2, 4, 3)):
        scene = cc.Scene()
        scene.add(cc.Mesh.box(), cc.BasicMaterial(map=cc.Image(shaped)))
        seen.add(cc.scene_hash(scene))
    assert len(seen) == 3


@pytest.mark.parametrize("wrong", [None, 3, "scene", cc.Renderer])
def test_another_object_is_an_error(wrong):
    with pytest.raises(TypeError, match="scene: expected a Scene, got"):
        cc.scene_hash(wrong)
