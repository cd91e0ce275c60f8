"""Sets of materials by name: Scene.variants, Scene.variant, Node.variants."""

import copy
import gc
import pickle

import pytest

import cubecam as cc


def shop():
    scene = cc.Scene()
    scene.variants = ["red", "blue"]
    own = [cc.PhongMaterial(name=f"own {i}") for i in range(3)]
    shoe, sole, box = (scene.add(cc.Mesh.box(), material) for material in own)
    red, blue = cc.PhongMaterial(name="red"), cc.PhongMaterial(name="blue")
    shoe.variants = {"red": red, "blue": blue}
    sole.variants = {"red": red}
    return scene, (shoe, sole, box)


def shown(nodes):
    return [node.material.name for node in nodes]


def test_a_variant_changes_the_nodes_that_have_a_material_for_it():
    scene, nodes = shop()
    own = ["own 0", "own 1", "own 2"]
    assert (scene.variants, scene.variant) == (("red", "blue"), None)
    for name, want in {
        "red": ["red", "red", "own 2"],
        "blue": ["blue", "own 1", "own 2"],
        None: own,
    }.items():
        scene.variant = name
        assert scene.variant == name
        assert shown(nodes) == want
        assert [node.own_material.name for node in nodes] == own


def test_a_material_that_is_set_by_hand_becomes_the_own_one():
    scene, (shoe, *_) = shop()
    scene.variant = "red"
    shoe.material = cc.PhongMaterial(name="mine")
    assert (shoe.material.name, shoe.own_material.name) == ("mine", "mine")
    scene.variant = "blue"
    assert (shoe.material.name, shoe.own_material.name) == ("blue", "mine")
    scene.variant = None
    assert shoe.material.name == "mine"


def test_materials_of_the_present_variant_show_at_once():
    scene, (shoe, _, box) = shop()
    scene.variant = "blue"
    green = cc.PhongMaterial(name="green")
    box.variants = {"blue": green}
    assert box.material is green
    assert box.variants == {"blue": green}
    box.variants = {}
    assert box.material.name == "own 2"
    shoe.variants = {"red": green}
    assert shoe.material.name == "own 0"


def test_names_that_go_away():
    scene, nodes = shop()
    scene.variant = "blue"
    scene.variants = ["blue", "new"]
    assert (scene.variant, nodes[0].material.name) == ("blue", "blue")
    scene.variants = ("new",)
    assert (scene.variant, nodes[0].material.name) == (None, "own 0")
    with pytest.raises(ValueError, match="variant of the scene or None, got 'nev'; did you mean"):
        scene.variant = "nev"
    scene.variants = ["red"]
    scene.variant = "red"
    scene.clear()
    assert (scene.variants, scene.variant) == ((), None)


def test_groups_have_none_or_a_material():
    scene, _ = shop()
    group = scene.add()
    group.variants = {"red": cc.PhongMaterial(name="red")}
    scene.variant = "red"
    assert (group.material.name, group.own_material) == ("red", None)
    scene.variant = None
    assert group.material is None


def test_a_node_that_leaves_keeps_what_it_shows():
    scene, (shoe, *_) = shop()
    scene.variant = "red"
    scene.remove(shoe)
    scene.variant = None
    assert (shoe.material.name, shoe.own_material.name) == ("red", "own 0")


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        (lambda s, n: setattr(s, "variants", "red"), TypeError, "a sequence of names"),
        (lambda s, n: setattr(s, "variants", [1]), TypeError, "a sequence of names"),
        (lambda s, n: setattr(s, "variants", ["a", "b", "a"]), ValueError, "'a' twice"),
        (lambda s, n: setattr(n, "variants", ["red"]), TypeError, "a dict of Materials"),
        (lambda s, n: setattr(n, "variants", {"red": None}), TypeError, "a dict of Materials"),
        (lambda s, n: setattr(n, "variants", {1: n.material}), TypeError, "a dict of Materials"),
        (lambda s, n: setattr(s, "variant", 3), TypeError, "variant"),
    ],
)
def test_bad_values(change, error, message):
    scene, (shoe, *_) = shop()
    scene.variant = "red"
    with pytest.raises(error, match=message):
        change(scene, shoe)
    assert scene.variants == ("red", "blue")
    assert (scene.variant, shoe.material.name) == ("red", "red")


@pytest.mark.parametrize("make", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_copies(make):
    scene, _ = shop()
    scene.variant = "blue"
    same = make(scene)
    assert (same.variants, same.variant) == (("red", "blue"), "blue")
    assert shown(same.nodes) == ["blue", "own 1", "own 2"]
    assert same.nodes[0].variants["red"] is same.nodes[1].variants["red"]
    same.variant = None
    assert shown(same.nodes) == ["own 0", "own 1", "own 2"]
    assert scene.variant == "blue"


def test_circles_by_way_of_variants_are_freed():
    """A material of a variant, or the own one behind it, may show a texture of its own scene."""
    dead = []
    for hidden in (False, True):
        scene = cc.Scene()
        scene.variants = ["on"]
        texture = cc.RenderTexture(scene, cc.PerspectiveCamera(), size=(2, 2))
        node = scene.add(cc.Mesh.box(), cc.BasicMaterial(map=texture if hidden else None))
        node.variants = {"on": cc.BasicMaterial(map=None if hidden else texture)}
        if hidden:
            scene.variant = "on"
        dead.append(cc.PointLight(parent=node))  # knows whether the core still has the node
        del scene, texture, node
    # The collector runs when the number of textures has doubled; earlier tests may have left many.
    for _ in range(20_000):
        if all(light.parent is None for light in dead):
            break
        cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), size=(2, 2))
    gc.collect()
    assert [light.parent for light in dead] == [None, None]


def test_names_of_materials():
    gold = cc.StandardMaterial(metallic=0.5, name="gold")
    assert (gold.name, repr(gold)) == ("gold", "StandardMaterial(name='gold', metallic=0.5)")
    assert cc.MirrorMaterial().name == ""
    gold.name = "brass"
    assert pickle.loads(pickle.dumps(gold)).name == "brass"
    for kind in (cc.BasicMaterial, cc.PhongMaterial, cc.MirrorMaterial, cc.GlassMaterial):
        assert kind(name="n").name == "n"
    assert cc.ShaderMaterial("vec4 shade(Surface s) { return vec4(1); }", name="n").name == "n"
    with pytest.raises(TypeError):
        gold.name = 3  # type: ignore[assignment]
