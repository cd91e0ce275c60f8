"""Animations, cameras and variants of a scene in a viewer and its panel."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.material_panel import _GROUPS, material_controls
from cubecam.viewer.panel import panel_to_json, properties, set_control
from cubecam.viewer.scene_camera import camera_names, free_camera


@pytest.fixture
def scene():
    made = cc.load_scene(cc.sample_data("gallery.glb"))
    (head,) = made.find("head")
    spin = cc.AnimationChannel(head, "translation", [0, 4], [[1, 1, 0], [1, 3, 0]])
    made.add(cc.Animation([spin], name="lift"))
    return made


@pytest.fixture
def view(scene, renderer):
    with cc.Viewer(scene, size=(64, 48), renderer=renderer) as made:
        yield made


def control(view, name, title="Scene"):
    """The place of a control in the panel, and the control."""
    for s, section in enumerate(view.panel()):
        for c, one in enumerate(section.controls):
            if section.title == title and one.name == name:
                return s, c, one
    raise AssertionError(name)


def set_(view, name, value, title="Scene"):
    s, c, _ = control(view, name, title)
    set_control(view.panel(), s, c, value)


def test_time_runs_while_it_plays_and_begins_again(view, scene):
    (head,) = scene.find("head")
    view.animation = "lift"
    view.playing = True
    view._tick(100.0)
    view._tick(101.0)
    assert view.time == pytest.approx(1)
    assert head.position[1] == pytest.approx(1.5)
    view.speed = 2
    view._tick(102.0)
    assert head.position[1] == pytest.approx(2.5)
    view._tick(103.0)  # 5 s are 1 s of the second round
    assert view.time == pytest.approx(1)
    view.playing = False
    view._tick(104.0)
    view._tick(105.0)
    assert view.time == pytest.approx(1)


def test_a_pause_does_not_count(view):
    view.playing = True
    view._tick(10.0)
    view._tick(11.0)
    view.playing = False
    view._tick(12.0)
    view.playing = True
    view._tick(50.0)
    view._tick(50.5)
    assert view.time == pytest.approx(1.5)


def test_setting_the_time_moves_the_scene_and_is_clamped(view, scene):
    view.animation = "lift"
    view.time = 3
    assert scene.find("head")[0].position[1] == pytest.approx(2.5)
    view.time = 99
    assert view.time == 4
    with pytest.raises(ValueError, match="time: expected a finite number, got nan"):
        view.time = np.nan
    with pytest.raises(ValueError, match=r'animation: expected "turn" or "lift", got .jump'):
        view.animation = "jump"
    with pytest.raises(TypeError, match="playing: expected a bool"):
        view.playing = 1


def test_the_space_bar_plays(view):
    view._handle({"event_type": "key_down", "key": " "})
    assert view.playing
    assert "space  play, pause" in view.help
    view._handle({"event_type": "key_down", "key": " "})
    assert not view.playing


def test_the_panel_has_animations_cameras_and_variants(scene, renderer):
    scene.variants = ["red", "blue"]
    (ball,) = scene.find("ball")
    red = cc.StandardMaterial(color="red")
    ball.variants = {"red": red}
    with cc.Viewer(scene, size=(64, 48), renderer=renderer) as view:
        section = next(one for one in panel_to_json(view.panel()) if one["title"] == "Scene")
        kinds = {one["name"]: (one["kind"], one["choices"]) for one in section["controls"]}
        assert kinds["animation"] == ("choice", ["turn", "lift"])
        assert kinds["scene_camera"] == ("choice", ["free", "view"])
        assert kinds["variant"] == ("choice", ["None", "red", "blue"])
        set_(view, "variant", "red")
        assert ball.material is red
        set_(view, "playing", True)
        set_(view, "animation", "lift")
        set_(view, "time", 2.0)
        assert (view.playing, view.animation, view.time) == (True, "lift", 2)


def test_the_view_of_a_camera_on_a_node_follows_it_until_it_is_moved(view, scene, renderer):
    assert list(camera_names(scene)) == ["view"]
    view.scene_camera = "view"
    (node,) = scene.find("view")
    for position in ((0, 1.4, 5.1), (0.5, 1, 4)):
        node.position = position
        options = {"samples": 4, "tonemap": "neutral", "encode": "srgb"}
        want = renderer.render(scene, scene.cameras[0], (64, 48), **options).color
        assert np.abs(view.draw().astype(int) - want).max() <= 1
    assert view.scene_camera == "view"
    for kind, x in (("pointer_down", 10), ("pointer_move", 30), ("pointer_up", 30)):
        view._handle({"event_type": kind, "x": x, "y": 20, "button": 1, "buttons": (1,), "modifiers": ()})  # fmt: skip
    assert view.scene_camera is None
    with pytest.raises(ValueError, match=r'scene_camera: expected "view" or None, got .side.'):
        view.scene_camera = "side"


def test_a_free_camera_keeps_the_lens():
    node = cc.Scene().add(position=(1, 2, 3), scale=2)
    camera = cc.OrthographicCamera(height=3, near=1, far=9, parent=node)
    free = free_camera(camera, 4)
    assert isinstance(free, cc.OrthographicCamera)
    assert (free.height, free.near, free.far) == (3, 1, 9)
    assert free.position == pytest.approx((1, 2, 3))
    assert free.target == pytest.approx((1, 2, -1))


def test_a_scene_without_any_has_no_section(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), name="box")
    with cc.Viewer(scene, size=(8, 8), renderer=renderer) as view:
        assert "Scene" not in [section.title for section in view.panel()]
        view._handle({"event_type": "key_down", "key": " "})
        assert not view.playing


def test_standard_material_has_groups_and_ranges_and_loses_nothing(renderer):
    picture = cc.Image(np.full((2, 2, 3), 200, np.uint8))
    placed = cc.Texture(picture, scale=(2, 3), rotation=30)
    material = cc.StandardMaterial(map=picture, normal_map=placed, clearcoat=0.5)
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1), material, name="ball")
    with cc.Viewer(scene, size=(8, 8), renderer=renderer) as view:
        sections = {s.title.removeprefix("ball: "): s for s in view.panel()}
        titles = ["StandardMaterial", *_GROUPS, "surface"]
        assert titles == [title for title in sections if title in titles]
        shown = [control.name for title in titles for control in sections[title].controls]
        assert sorted(shown) == sorted(c.name for c in properties(material))
        by_name = {c.name: c for c in material_controls(material)}
        ranges = {"metallic": (0, 1), "roughness": (0, 1), "ior": (1, 3)}
        for name, (low, high) in {**ranges, "anisotropy_rotation": (-180, 180)}.items():
            assert (by_name[name].low, by_name[name].high) == (low, high)
        assert by_name["normal_map rotation"].get() == 30
        set_(view, "normal_map scale", [4, 5], "ball: relief")
        assert material.normal_map == cc.Texture(picture, scale=(4, 5), rotation=30)
        set_(view, "normal_map", False, "ball: relief")
        assert material.normal_map is None
        set_(view, "normal_map", True, "ball: relief")
        assert material.normal_map.scale == (4, 5)
        set_(view, "map uv_set", "1", "ball: StandardMaterial")
        assert material.map == cc.Texture(picture, uv_set=1)
        set_(view, "Reset", None, "Reset")
        assert material.normal_map == placed
        assert material.map == picture


def test_morph_targets_have_sliders(renderer):
    box = cc.Mesh.box(1)
    moved = np.ones_like(box.positions)
    targets = [cc.MorphTarget(positions=moved, name="smile"), cc.MorphTarget(positions=-moved)]
    mesh = cc.Mesh(box.positions, box.indices, normals=box.normals, morph_targets=targets)
    scene = cc.Scene()
    node = scene.add(mesh, name="face")
    with cc.Viewer(scene, size=(8, 8), renderer=renderer) as view:
        set_(view, "smile", 0.5, "face: node")
        set_(view, "weight 1", 0.25, "face: node")
        assert node.weights.tolist() == [0.5, 0.25]
        set_(view, "Reset", None, "Reset")
        assert node.weights.tolist() == [0, 0]
