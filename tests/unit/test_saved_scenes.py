"""load_scene of a saved scene equals the scene; what stands in extras is checked like user input."""

import json
import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import cubecam as cc
from tests.saved_scenes import KINDS, image, mesh, scene_of, scenes
from tests.scenes_equal import assert_scenes_equal

SHADER = "vec3 shade(Surface s) { return vec3(0.5); }"


def loaded(scene, path):
    """Save a scene and load it, neither of which may warn."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.save(path)
        return cc.load_scene(path)


@pytest.mark.parametrize("ending", ["glb", "gltf"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_scene_comes_back(kind, ending, tmp_path):
    scene = scene_of(kind)
    once = loaded(scene, tmp_path / f"a.{ending}")
    assert_scenes_equal(once, scene)
    # What was loaded is saved as it was: nothing drifts.
    assert_scenes_equal(loaded(once, tmp_path / f"b.{ending}"), scene)


@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(scenes())
def test_any_scene_comes_back(tmp_path, scene):
    assert_scenes_equal(loaded(scene, tmp_path / "a.glb"), scene)


def test_saving_changes_no_object_of_the_scene(tmp_path):
    for kind in KINDS:
        scene = scene_of(kind)
        scene.save(tmp_path / "a.glb")
        before = (tmp_path / "a.glb").read_bytes()
        scene.save(tmp_path / "a.glb")
        assert (tmp_path / "a.glb").read_bytes() == before


def _change_material(scene):
    scene.nodes[0].material.roughness = 0.25


def _change_matrix(scene):
    scene.nodes[0].position = (0, 0, 1e-5)


def _share(scene):
    scene.nodes[1].material = scene.nodes[0].material


def _change_light(scene):
    scene.lights[0].intensity = 2


def _change_parent(scene):
    scene.nodes[1].parent = scene.nodes[0]


@pytest.mark.parametrize(
    "change", [_change_material, _change_matrix, _share, _change_light, _change_parent]
)
def test_the_comparison_of_scenes_finds_differences(change):
    def scene():
        made = cc.Scene()
        for _ in range(2):
            made.add(cc.Mesh.box(), cc.StandardMaterial())
        made.add(cc.PointLight())
        return made

    one, other = scene(), scene()
    assert_scenes_equal(one, other)
    change(one)
    with pytest.raises(AssertionError, match="scene"):
        assert_scenes_equal(one, other)


def edited(tmp_path, scene, change):
    """Save a scene as .gltf, change its tree, and return the path."""
    path = tmp_path / "x.gltf"
    scene.save(path)
    tree = json.loads(path.read_text())
    change(tree)
    path.write_text(json.dumps(tree))
    return path


def simple():
    scene = cc.Scene(background=(1, 0, 0))
    node = scene.add(mesh(), cc.MirrorMaterial(f0=0.5), label=3)
    node.environment = cc.Probe(size=16, parent=node)
    scene.add(mesh(), cc.ShaderMaterial(SHADER, uniforms={"k": 2}))
    scene.add(mesh(uvs=np.zeros((5, 2))), cc.StandardMaterial(map=image(dtype=np.float32)))
    scene.add(cc.SpotLight())
    scene.add(cc.AmbientLight())
    scene.environment = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float16)).prefilter(levels=2)
    return scene


def node(tree, index=0):
    return tree["nodes"][index]["extras"]["cubecam"]


def material(tree, index=0):
    return tree["materials"][index]["extras"]["cubecam"]


def objects(tree):
    return tree["extras"]["cubecam"]["objects"]


def probe(tree):
    return next(o for o in objects(tree) if o["class"] == "Probe")


def cube(tree):
    return next(o for o in objects(tree) if o["class"] == "CubeMap")


def scene_extras(tree):
    return tree["scenes"][0]["extras"]["cubecam"]


BROKEN = {
    "unknown property of a node": (lambda t: node(t).update(mesh=3), r"nodes\[0\].extras.cubecam.mesh"),
    "private name": (lambda t: node(t).update(__class__="x"), "__class__"),
    "wrong type": (lambda t: node(t).update(label="x"), r"label: label: expected"),
    "float for an int": (lambda t: node(t).update(label=1.5), "label"),
    "out of range": (lambda t: node(t).update(label=2**40), "label"),
    "no object": (lambda t: t["nodes"][0]["extras"].update(cubecam=[1]), "expected an object"),
    "unknown class": (lambda t: material(t).update({"class": "Popen"}), "class: expected one of"),
    "class of another kind": (lambda t: material(t).update({"class": "Probe"}), "MirrorMaterial"),
    "class of a wrong type": (lambda t: material(t).update({"class": 7}), "class"),
    "property of another kind": (lambda t: material(t).update(roughness=0.5), "roughness"),
    "refused value": (lambda t: material(t).update(f0=2), "f0"),
    "infinite list": (lambda t: material(t).update(tint={"float": "1e999"}), "float"),
    "a form with two words": (lambda t: node(t).update(environment={"object": 0, "x": 1}), "environment"),
    "an unknown form": (lambda t: node(t).update(environment={"eval": "1"}), "environment"),
    "an object that is not there": (lambda t: node(t).update(environment={"object": 99}), "index below"),
    "a negative object": (lambda t: node(t).update(environment={"object": -1}), "index below"),
    "an object of another class": (lambda t: node(t).update(environment={"node": 0}), "environment"),
    "a node that is not there": (lambda t: probe(t).update(parent={"node": 99}), "index of a node"),
    "a bool for an index": (lambda t: probe(t).update(parent={"node": True}), "index of a node"),
    "a texture that is not there": (
        lambda t: material(t, 1).update(textures={"dict": {"a": {"texture": 9}}}), "index below"
    ),
    "a view that is not there": (lambda t: cube(t)["faces"].update(array=99), "index below"),
    "a wrong shape": (lambda t: cube(t)["faces"].update(shape=[6, 4, 4, 4]), "bytes in bufferViews"),
    "a huge shape": (lambda t: cube(t)["faces"].update(shape=[2**31 - 1] * 4), "bytes in bufferViews"),
    "a shape of another cube": (lambda t: cube(t)["faces"].update(shape=[4, 6, 4, 3]), "faces"),
    "an object dtype": (lambda t: cube(t)["faces"].update(dtype="object"), "dtype"),
    "levels of another size": (
        lambda t: cube(t)["levels"][0][1].update(shape=[6, 2, 8, 3]), "levels"
    ),
    "levels out of order": (lambda t: cube(t)["levels"].reverse() or cube(t)["levels"][0].__setitem__(0, 2), "levels"),
    "levels that are numbers": (lambda t: cube(t).update(levels=[1]), "levels"),
    "outputs that are numbers": (lambda t: cube(t).update(outputs={"dict": {"id": 3}}), "outputs"),
    "objects that are no list": (lambda t: t["extras"]["cubecam"].update(objects=3), "objects"),
    "an object that is a list": (lambda t: objects(t).__setitem__(0, []), r"objects\[0\]"),
    "an object in itself": (
        lambda t: probe(t).update(position=[{"object": objects(t).index(probe(t))}] * 3), "itself"
    ),
    "deep lists": (lambda t: node(t).update(label=eval("[" * 60 + "]" * 60)), "moderate depth"),
    "a source without shade": (lambda t: material(t, 1).update(fragment="x"), "fragment"),
    "a source that is a number": (lambda t: material(t, 1).update(fragment=7), "fragment"),
    "a light among cameras": (
        lambda t: scene_extras(t).update(cameras=[{"class": "AmbientLight"}]), "Camera"
    ),
    "a texture among lights": (
        lambda t: scene_extras(t).update(lights=[{"class": "Blend", "src": "one", "dst": "one"}]), "Light"
    ),
    "pixels of no shape": (
        lambda t: t["textures"][0]["extras"]["cubecam"].update(pixels=[[1], [2, 3]]), "pixels"
    ),
    "a texture of another class": (
        lambda t: t["textures"][0]["extras"]["cubecam"].update({"class": "Probe"}), "class"
    ),
    "a mesh of another size": (
        lambda t: t["meshes"][0].setdefault("extras", {}).update(cubecam={"uvs": [[0, 0]]}), "uvs"
    ),
    "a carrier that is no bool": (
        lambda t: node(t, 3).update(carrier="yes"), "carrier: expected true or false"
    ),
    "a light that is a list": (lambda t: node(t, 3).update(light=[]), "light: expected an object"),
    "a light with a camera's property": (lambda t: node(t, 3)["light"].update(fov=3), "fov"),
    "a format that is text": (lambda t: t["extras"]["cubecam"].update(format="1"), "format"),
}  # fmt: skip


@pytest.mark.parametrize("case", BROKEN)
def test_extras_that_cubecam_did_not_write_are_refused_by_place(case, tmp_path):
    change, match = BROKEN[case]
    path = edited(tmp_path, simple(), change)
    with pytest.raises(cc.MeshError, match=match) as caught:
        cc.load_scene(path)
    assert "x.gltf" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("other", [(2, 3), (4, 4), (16, 3)])
def test_levels_fit_their_cubemap(other, tmp_path):
    """Faces of another size or with other channels than those of the levels, which the core takes as they are."""
    size, channels = other
    scene = cc.Scene(background=cc.CubeMap(np.zeros((6, size, size, channels), np.float16)))
    scene.environment = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float16)).prefilter(levels=2)

    def change(tree):
        background, environment = sorted(objects(tree), key=lambda o: "levels" in o)
        environment["faces"] = background["faces"]

    path = edited(tmp_path, scene, change)
    if size > 4 and channels == 3:
        assert cc.load_scene(path).environment.size == size  # levels may be smaller
    else:
        with pytest.raises(cc.MeshError, match="levels: expected pairs"):
            cc.load_scene(path)


def test_extras_of_a_later_format_are_left_out_with_one_warning(tmp_path):
    path = edited(tmp_path, simple(), lambda t: t["extras"]["cubecam"].update(format=2))
    with pytest.warns(cc.SceneWarning, match="format 2") as told:
        scene = cc.load_scene(path)
    assert len(told) == 1
    assert isinstance(scene.nodes[0].material, cc.StandardMaterial)
    assert scene.nodes[0].label == 0


@pytest.mark.parametrize("extras", [None, 3, "cubecam", [], {"cubecam": 3}, {"other": {}}])
def test_extras_of_others_are_skipped(extras, tmp_path):
    """Extras may be any JSON; without cubecam's mark at the root, a key of that name is somebody else's."""

    def change(tree):
        tree.pop("extras", None)
        for kind in ("nodes", "materials", "meshes", "scenes"):
            for entry in tree[kind]:
                entry["extras"] = extras

    scene = cc.Scene()
    scene.add(mesh(), cc.StandardMaterial(alpha_mode="opaque"))
    again = cc.load_scene(edited(tmp_path, scene, change))
    assert type(again.nodes[0].material) is cc.StandardMaterial


def test_a_subclass_is_saved_as_its_class_of_cubecam(tmp_path):
    class Mine(cc.MirrorMaterial):
        pass

    scene = cc.Scene()
    scene.add(mesh(), Mine(f0=0.5))
    again = loaded(scene, tmp_path / "x.glb").nodes[0].material
    assert type(again) is cc.MirrorMaterial
    assert again.f0 == 0.5
