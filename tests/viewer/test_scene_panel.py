"""The panel of a viewer: which sections a scene has, what they change, and the button that brings all back."""

# A small class stands for a Viewer.
# mypy: disable-error-code="arg-type"

import gc
import json
import weakref
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.panel import panel_to_json, set_control
from cubecam.viewer.scene_panel import probes_of, scene_sections


class View:
    """The attributes of a Viewer that the panel reads and sets."""

    def __init__(self, scene, camera=None):
        self.scene = scene
        self.camera = camera or cc.PerspectiveCamera()
        self.exposure = 0.0
        self.tonemap = None
        self.output: Any = "color"


@pytest.fixture
def view():
    scene = cc.Scene(
        environment=cc.CubeMap(np.random.default_rng(0).random((6, 4, 4, 3), np.float32))
    )
    probe = cc.Probe((0, 1, 0))
    mirror = cc.MirrorMaterial()
    scene.add(cc.Mesh.sphere(1), mirror, name="ball", environment=probe)
    scene.add(cc.Mesh.box(1), mirror, name="box")
    scene.add(cc.Mesh.plane(4, 4), cc.PhongMaterial(color="red"))
    scene.add(cc.PointLight((0, 3, 0)))
    scene.add(cc.AmbientLight(intensity=0.25))
    return View(scene)


def titles(view):
    return [section.title for section in scene_sections(view)]


def find(view, title, name):
    sections = scene_sections(view)
    s = [section.title for section in sections].index(title)
    return sections, s, [control.name for control in sections[s].controls].index(name)


def change(view, title, name, value):
    sections, s, c = find(view, title, name)
    set_control(sections, s, c, value)


def get(view, title, name):
    sections, s, c = find(view, title, name)
    return sections[s].controls[c].get()


def test_sections_follow_the_scene(view):
    plain = view.scene.nodes[2]
    assert titles(view) == [
        "View",
        "ball, box: MirrorMaterial",
        "ball, box: surface",
        f"node {plain.id}: PhongMaterial",
        f"node {plain.id}: surface",
        "Light 1: PointLight",
        "Light 2: AmbientLight",
        "Environment",
        "ball: probe",
        "Lens",
        "ball: node",
        "box: node",
        f"node {plain.id}: node",
        "Reset",
    ]
    view.scene.remove(plain)
    view.scene.add(cc.Mesh.sphere(1), cc.GlassMaterial(), name="drop")
    now = titles(view)
    assert "drop: GlassMaterial" in now
    assert f"node {plain.id}: node" not in now


def test_the_panel_is_json(view):
    panel = panel_to_json(scene_sections(view))
    assert json.loads(json.dumps(panel, allow_nan=False)) == panel


def test_a_material_shows_its_own_properties_apart_from_the_surface(view):
    sections = {section.title: section for section in scene_sections(view)}
    own = [control.name for control in sections["ball, box: MirrorMaterial"].controls]
    assert {"env_weight", "tint", "opacity"} <= set(own)
    rest = [control.name for control in sections["ball, box: surface"].controls]
    assert {"blend", "depth_test", "color_write red"} <= set(rest)
    assert not set(own) & set(rest)
    assert not sections["ball, box: surface"].open


@pytest.mark.parametrize(
    ("title", "name", "value", "read"),
    [
        ("View", "exposure", 1.5, lambda v: v.exposure),
        ("View", "tonemap", "aces", lambda v: v.tonemap),
        ("View", "output", "normal", lambda v: v.output),
        ("ball, box: MirrorMaterial", "env_weight", 0.5, lambda v: v.scene["ball"].material.env_weight),
        ("ball, box: surface", "double_sided", True, lambda v: v.scene["box"].material.double_sided),
        ("Light 1: PointLight", "intensity", 2.0, lambda v: v.scene.lights[0].intensity),
        ("ball: probe", "far", 50.0, lambda v: v.scene["ball"].environment.far),
        ("Lens", "fov", 30.0, lambda v: v.camera.fov),
        ("box: node", "visible", False, lambda v: v.scene["box"].visible),
        ("box: node", "position", [1.0, 2.0, 3.0], lambda v: v.scene["box"].position.tolist()),
    ],
)  # fmt: skip
def test_controls_change_the_objects_and_reset_brings_them_back(view, title, name, value, read):
    scene_sections(view)
    before = read(view)
    change(view, title, name, value)
    assert read(view) == value
    assert get(view, title, name) == value
    assert before != value
    change(view, "Reset", "Reset", None)
    assert read(view) == before


def test_a_probe_is_an_output(view):
    sections, s, c = find(view, "View", "output")
    choices = sections[s].controls[c].choices
    assert choices == ("color", "distance", "normal", "id", "what the probe of ball sees")
    change(view, "View", "output", choices[-1])
    assert view.output is view.scene["ball"].environment
    assert get(view, "View", "output") == choices[-1]
    view.scene["box"].environment = cc.Probe((2, 0, 0))
    sections, s, c = find(view, "View", "output")
    assert sections[s].controls[c].choices[-1] == "what the probe of box sees"
    change(view, "Reset", "Reset", None)
    assert view.output == "color"


def test_probes_with_equal_names_have_different_words():
    scene = cc.Scene()
    for x in (0, 1):
        scene.add(cc.Mesh.sphere(1), name="ball", environment=cc.Probe((x, 0, 0)))
    view = View(scene)
    sections, s, c = find(view, "View", "output")
    words = sections[s].controls[c].choices[-2:]
    for word, node in zip(words, scene.nodes, strict=True):
        change(view, "View", "output", word)
        assert view.output is node.environment


def test_probes_are_found_wherever_they_are_used():
    scene = cc.Scene()
    probes = [cc.Probe((x, 0, 0)) for x in range(3)]
    source = "uniform samplerCube around; vec3 shade(Surface s) { return texture(around, s.normal).rgb; }"
    a = scene.add(cc.Mesh.sphere(1), environment=probes[0])
    b = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(cubemap=probes[1]), environment=probes[0])
    c = scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(source, textures={"around": probes[2]}))
    scene.add(name="group")
    assert probes_of(scene.nodes) == {probes[0]: [a, b], probes[1]: [b], probes[2]: [c]}


def test_the_environment_turns_and_comes_back(view):
    cube = view.scene.environment
    change(view, "Environment", "rotation", 90.0)
    assert view.scene.environment is cube
    np.testing.assert_allclose(view.scene.environment_rotation, cc.axis_angle((0, 1, 0), 90))
    assert get(view, "Environment", "rotation") == pytest.approx(90)
    change(view, "Environment", "environment_intensity", 0.5)
    assert view.scene.environment_intensity == 0.5
    change(view, "Environment", "background is None", False)
    change(view, "Reset", "Reset", None)
    np.testing.assert_allclose(view.scene.environment_rotation, [1, 0, 0, 0], atol=1e-15)
    assert view.scene.environment_intensity == 1
    assert view.scene.background is None


def test_a_background_that_turned_with_the_environment_comes_back(view):
    view.scene.background = cube = view.scene.environment
    scene_sections(view)
    change(view, "Environment", "rotation", 90.0)
    assert view.scene.background is None
    change(view, "Reset", "Reset", None)
    assert view.scene.background is cube


def test_a_scene_without_an_environment_has_no_turn():
    view = View(cc.Scene(background="red"))
    sections = {section.title: section for section in scene_sections(view)}
    names = [control.name for control in sections["Environment"].controls]
    assert names == ["background is None", "background", "background alpha"]


def test_values_that_a_program_sets_show(view):
    sections, s, c = find(view, "Light 1: PointLight", "intensity")
    view.scene.lights[0].intensity = 1.5
    assert panel_to_json(sections)[s]["controls"][c]["value"] == 1.5


def test_controls_are_the_same_in_every_call(view):
    first = panel_to_json(scene_sections(view))
    view.scene["ball"].material.env_weight = 0.75
    again = panel_to_json(scene_sections(view))
    for section in (*first, *again):
        for control in section["controls"]:
            del control["value"]
    assert first == again  # a slider does not change its range under the hand


def test_a_crowd_is_cut_short():
    scene = cc.Scene()
    for i in range(60):
        scene.add(cc.Mesh.box(1), cc.BasicMaterial(), name=f"box {i}")
    found = titles(View(scene))
    assert "and 20 more: nodes" in found
    assert "and 80 more: materials" in found
    assert sum(title.endswith(": node") for title in found) == 40


def test_a_stereo_camera_has_a_layout():
    camera = cc.StereoCamera.off_axis(cc.PerspectiveCamera(), separation=0.1)
    view = View(cc.Scene(), camera)
    change(view, "Lens", "layout", "side_by_side")
    assert camera.layout == "side_by_side"


def test_uniforms_appear_when_they_are_set():
    source = "uniform float a; uniform float b; vec3 shade(Surface s) { return vec3(a, b, 0); }"
    material = cc.ShaderMaterial(source, uniforms={"a": 0.5})
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1), material, name="ball")
    view = View(scene)
    scene_sections(view)
    material.uniforms["b"] = 0.25
    assert get(view, "ball: ShaderMaterial", "b") == 0.25
    change(view, "ball: ShaderMaterial", "a", 0.75)
    change(view, "Reset", "Reset", None)
    assert material.uniforms["a"] == 0.5


def test_a_panel_keeps_neither_its_view_nor_its_objects():
    scene = cc.Scene(environment=cc.CubeMap(np.zeros((6, 2, 2, 3), np.float32)))
    material = cc.GlassMaterial()
    scene.add(cc.Mesh.sphere(1), material, name="ball")
    view = View(scene)
    change(view, "Environment", "rotation", 90.0)
    gone: list[Any] = [weakref.ref(view), weakref.ref(scene), weakref.ref(material)]
    del view, scene, material
    gc.collect()
    assert [one() for one in gone] == [None, None, None]
