"""Panels as data: every property of every object has a control that reads and sets it, or a reason to have none."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import cubecam as cc
from cubecam.viewer.panel import Control, Memory, Section, panel_to_json, properties, set_control
from cubecam.viewer.properties import color_to_hex, hex_to_color, slider

GLSL = """
uniform float wave; uniform vec3 tone_color; uniform vec4 veil_color; uniform vec2 shift;
vec3 shade(Surface surface) { return tone_color * wave + veil_color.rgb + vec3(shift, 0); }
"""
EFFECT = "uniform float gain; vec4 effect(vec2 uv) { return texture(u_image, uv) * gain; }"

#: Objects of every class of cubecam that has properties to set. A test finds classes that are missing.
MAKERS: dict[str, Any] = {
    "AmbientLight": cc.AmbientLight,
    "BasicMaterial": cc.BasicMaterial,
    "DirectionalLight": lambda: cc.DirectionalLight((0, -1, 0)),
    "GlassMaterial": cc.GlassMaterial,
    "ImageEffect": lambda: cc.ImageEffect(EFFECT, uniforms={"gain": 0.5}),
    "MirrorMaterial": cc.MirrorMaterial,
    "Node": lambda: cc.Scene().add(cc.Mesh.sphere(1), name="ball"),
    "OrthographicCamera": cc.OrthographicCamera,
    "PerspectiveCamera": cc.PerspectiveCamera,
    "PhongMaterial": cc.PhongMaterial,
    "PointLight": lambda: cc.PointLight((1, 2, 3)),
    "PlanarMirror": cc.PlanarMirror,
    "ProbeGrid": lambda: cc.ProbeGrid(((-1, -1, -1), (1, 1, 1)), (2, 2, 2)),
    "Probe": lambda: cc.Probe((0, 1, 0), box=((-1, -1, -1), (1, 1, 1))),
    "RenderTexture": lambda: cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), size=(8, 4)),
    "Scene": lambda: cc.Scene(background=(0.25, 0.5, 1)),
    "ShaderMaterial": lambda: cc.ShaderMaterial(
        GLSL,
        uniforms={
            "wave": 0.5,
            "tone_color": (0.1, 0.2, 0.3),
            "veil_color": (0, 0, 0, 0.5),
            "shift": (1, 2),
        },
    ),
    "SpotLight": lambda: cc.SpotLight((0, 2, 0), (0, -1, 0)),
    "StandardMaterial": cc.StandardMaterial,
    "StereoCamera": lambda: cc.StereoCamera.off_axis(cc.PerspectiveCamera(), separation=0.1),
}
#: Properties without a control, each with its reason.
WITHOUT = {
    **{name: "a picture" for name in dir(cc.StandardMaterial) if name.endswith("_map")},
    "map": "a picture",
    "cubemap": "a cubemap or a probe",
    "environment": "a cubemap or a probe",
    "textures": "pictures",
    "mesh": "a mesh",
    "material": "an object, which has a section of its own",
    "parent": "a node",
    "exclude": "nodes",
    "box": "two corners",
    "proxy_matrix": "a matrix",
    "influence": "a box",
    "coefficients": "an array",
    "distances": "an array",
    "active": "an array",
    "probe_grid": "an object",
    "camera": "an object",
    "scene": "an object",
    "left": "a camera",
    "right": "a camera",
    "effects": "objects",
    "stencil": "an object of many words",
    "skin": "an object",
    "weights": "a slider for each morph target, see test_scene_panel.py",
    "variant": "a choice among the scene's names, see test_scene_panel.py",
    "variants": "objects",
    "matrix": "position, rotation and scale have controls",
    "view": "position and target have controls",
    "fragment": "GLSL, which has lines",
    "vertex": "GLSL, which has lines",
}


def settable(kind):
    """The names of all properties of a class that can be set, found without the code under test."""
    names = [name for base in kind.__mro__ for name in vars(base)]
    found = {name: getattr(kind, name, None) for name in names if not name.startswith("_")}
    return {name for name, p in found.items() if isinstance(p, property) and p.fset is not None}


def by_name(thing):
    return {control.name: control for control in properties(thing)}


def other_value(control):
    """A value that differs from today's."""
    today = control.get()
    match control.kind:
        case "flag":
            return not today
        case "number" if control.low is not None:
            low, high = control.low, control.high
            return today + (0.4 if today < (low + high) / 2 else -0.4) * (high - low)
        case "number" | "integer":
            return today - 1 if today > 5 else today + 1
        case "choice":
            return next(word for word in control.choices if word != today)
        case "color":
            return "#336699"
        case "vector":
            return [today[0] + 1 + len(control.name), *today[1:]]
        case "text":
            return "another"
    raise AssertionError(control.kind)


def same(a, b):
    if isinstance(a, list):
        return np.allclose(a, b, rtol=1e-6)
    return a == pytest.approx(b, rel=1e-6) if isinstance(a, float) else a == b


def test_every_class_is_tested():
    classes = {name: getattr(cc, name) for name in cc.__all__}
    classes = {name: kind for name, kind in classes.items() if isinstance(kind, type)}
    abstract = {"Light", "Material", "Camera"}
    edited_by_arrays = {"Mesh"}
    shown_as_view = {"Viewer"}  # test_scene_panel.py
    names = {name for name, kind in classes.items() if settable(kind)}
    assert names - abstract - edited_by_arrays - shown_as_view == set(MAKERS)


@pytest.mark.parametrize("name", MAKERS)
def test_every_property_has_a_control_or_a_reason(name):
    thing = MAKERS[name]()
    first_words = {control.name.split(" ")[0] for control in properties(thing)}
    uniforms = set(getattr(thing, "uniforms", {}))
    assert uniforms <= first_words
    assert first_words - uniforms == settable(type(thing)) - set(WITHOUT) - {"uniforms"}


@pytest.mark.parametrize("name", MAKERS)
def test_every_control_sets_what_it_then_reads(name):
    thing = MAKERS[name]()
    panel = [Section(name, properties(thing))]
    for i, control in enumerate(panel[0].controls):
        if control.name in ("far", "near"):  # they bound each other, and have a test below
            continue
        value = other_value(control)
        set_control(panel, 0, i, value)
        got = control.get()
        rotations = {("Node", "rotation"), ("Scene", "environment_rotation")}
        if (name, control.name) in rotations or control.name == "direction":
            value = (np.array(value) / np.linalg.norm(value)).tolist()  # unit length
        assert same(got, value), control.name


@pytest.mark.parametrize("name", MAKERS)
def test_a_panel_is_json(name):
    [section] = panel_to_json([Section(name, properties(MAKERS[name]()), open=False)])
    assert json.loads(json.dumps(section, allow_nan=False)) == section
    assert (section["title"], section["open"]) == (name, False)
    for control in section["controls"]:
        assert control["kind"] in {
            "number", "integer", "flag", "choice", "color", "vector", "text",
        }  # fmt: skip
        assert control["help"], control["name"]
        if control["kind"] == "choice":
            assert control["value"] in control["choices"]
        if control["kind"] == "number" and control["low"] is not None:
            assert control["low"] <= control["value"] <= control["high"]
            assert not control["logarithmic"] or control["low"] > 0


@pytest.mark.parametrize("name", MAKERS)
def test_reset_brings_back_what_was_there(name):
    thing = MAKERS[name]()
    before = {key: repr(getattr(thing, key)) for key in settable(type(thing))}
    memory = Memory()
    controls = memory.controls(thing, lambda: properties(thing))
    for control in controls:
        if control.name not in ("near", "far"):
            control.set(other_value(control))
    changed = {key: repr(getattr(thing, key)) for key in settable(type(thing))}
    assert changed != before
    memory.reset()
    assert {key: repr(getattr(thing, key)) for key in settable(type(thing))} == before


def test_reset_finds_the_order_of_values_that_bound_each_other():
    camera = cc.PerspectiveCamera(near=0.5, far=2)
    memory = Memory()
    memory.controls(camera, lambda: properties(camera))
    camera.far, camera.near = 100, 50
    memory.reset()
    assert (camera.near, camera.far) == (0.5, 2)
    camera.near, camera.far = 0.001, 0.01
    memory.reset()
    assert (camera.near, camera.far) == (0.5, 2)


def test_reset_keeps_numbers_that_the_panel_rounds():
    light = cc.AmbientLight(color=(2.5, 1 / 3, 0.1), intensity=1 / 3)
    color = light.color.copy()
    memory = Memory()
    memory.controls(light, lambda: properties(light))
    light.color, light.intensity = (0, 0, 0), 4
    memory.reset()
    assert np.array_equal(light.color, color)
    assert light.intensity == np.float32(1 / 3)


def test_controls_and_ranges_stay_while_values_change():
    memory, glass = Memory(), cc.GlassMaterial(ior=1.2)
    first = memory.controls(glass, lambda: properties(glass))
    glass.ior = 30
    assert memory.controls(glass, lambda: properties(glass)) is first


def test_what_is_no_longer_shown_is_let_go():
    memory = Memory()
    made: list[int] = []
    lights = [cc.AmbientLight(intensity=2), cc.AmbientLight(intensity=3)]
    for light in lights:
        memory.controls(light, lambda one=light: properties(one))  # type: ignore[misc]
    memory.forget_unseen()
    memory.controls(lights[0], lambda: properties(lights[0]))
    memory.forget_unseen()

    def make():
        made.append(1)
        return properties(lights[1])

    memory.controls(lights[1], make)
    assert made == [1]
    lights[0].intensity = lights[1].intensity = 9
    memory.reset()
    assert [light.intensity for light in lights] == [2, 3]


# ---- ranges, units, words


@pytest.mark.parametrize(
    ("doc", "value", "low", "high", "logarithmic", "unit"),
    [
        ("float: from 0 to 1; multiplies the alpha.", 0.5, 0, 1, False, ""),
        ("float: from -1.5 to 2.5.", 0, -1.5, 2.5, False, ""),
        ("float: from 0 to 1.", 3, 0, 3, False, ""),
        ("float: angle from the axis, degrees.", 30, 0, 180, False, "degrees"),
        ("float: a turn in degrees.", -30, -180, 180, False, "degrees"),
        ("float: above 0 and below 180 degrees.", 60, 1, 179, False, "degrees"),
        ("float: a weight.", 0.2, 0, 1, False, ""),
        ("float: a weight.", 1.5, 0, 5, False, ""),
        ("float: a weight.", -1.5, -5, 5, False, ""),
        ("float: an exponent.", 32, 0.32, 3200, True, ""),
        ("float: the near clip distance, world units.", 0.05, 0.0005, 5, True, "world units"),
    ],
)
def test_ranges(doc, value, low, high, logarithmic, unit):
    got = slider(doc, value)
    assert got["low"] == pytest.approx(low)
    assert got["high"] == pytest.approx(high)
    assert got.get("logarithmic", False) == logarithmic
    assert got["unit"] == unit


def test_whole_numbers_have_sliders_only_within_limits():
    assert slider("int: from 1 to 6.", 3, whole=True) == {
        "low": 1, "high": 6, "step": 1, "unit": "",
    }  # fmt: skip
    assert slider("int: texels along an edge.", 256, whole=True) == {"step": 1, "unit": "texels"}


def test_names_of_a_literal_are_choices():
    update = by_name(cc.Probe((0, 0, 0), update="once"))["update"]
    assert (update.kind, update.choices) == ("choice", ("on_change", "once", "manual"))
    assert update.get() == "once"


def test_a_value_that_is_no_word_is_one_more_choice():
    probe = cc.Probe((0, 0, 0), update=4)
    update = by_name(probe)["update"]
    assert update.choices == ("on_change", "once", "manual", "4")
    update.set("manual")
    update.set("4")
    assert probe.update == 4
    glow = cc.Blend("one", "one")
    material = cc.BasicMaterial(blend=glow)
    blend = by_name(material)["blend"]
    assert blend.get() == str(glow)
    blend.set("None")
    assert material.blend is None
    blend.set(str(glow))
    assert material.blend == glow


def test_none_is_a_choice_or_a_flag():
    mirror: Any = cc.MirrorMaterial(f0=0.25)
    controls = by_name(mirror)
    depth = controls["depth_write"]
    assert depth.choices == ("None", "False", "True")
    depth.set("False")
    assert mirror.depth_write is False
    controls["f0 is None"].set(True)
    assert mirror.f0 is None
    assert controls["f0"].get() == 0.25  # the number waits
    controls["f0 is None"].set(False)
    assert mirror.f0 == 0.25
    controls["f0 is None"].set(True)
    controls["f0"].set(0.5)
    assert [mirror.f0, controls["f0 is None"].get()] == [0.5, False]


def test_a_shadow_is_switched_and_comes_back_as_it_was():
    light = cc.SpotLight((0, 2, 0), (0, -1, 0), shadow=cc.Shadow(size=64))
    switch = by_name(light)["shadow"]
    switch.set(False)
    assert light.shadow is None
    switch.set(True)
    assert light.shadow == cc.Shadow(size=64)


def test_parts_of_a_flag_have_the_names_of_the_docstring():
    material = cc.BasicMaterial()
    controls = by_name(material)
    assert [n for n in controls if n.startswith("color_write")] == [
        "color_write red", "color_write green", "color_write blue", "color_write alpha",
    ]  # fmt: skip
    controls["color_write blue"].set(False)
    assert material.color_write == (True, True, False, True)


# ---- a kind that this package has never seen


class _Paint:
    """A class with the docstrings and signatures that a new binding has, and nothing of cubecam."""

    def __init__(self):
        tone = np.array([0, 0.5, 1, 1], np.float32)
        self._values = {"gloss": 0.5, "mode": "matte", "coats": 3, "tone": tone}


def like_pybind(name, reads, writes, doc):
    def read(self):
        return self._values[name]

    def write(self, value):
        if name == "gloss" and not 0 <= value <= 1:
            raise ValueError(f"expected gloss from 0 to 1, got {value:g}")
        self._values[name] = np.asarray(value, np.float32) if name == "tone" else value

    read.__doc__ = f"(arg0: cubecam.Paint) -> {reads}\n"
    write.__doc__ = f"(arg0: cubecam.Paint, arg1: {writes}) -> None\n"
    return property(read, write, doc=doc)


Paint: Any = _Paint
number = "typing.SupportsFloat | typing.SupportsIndex"
Paint.gloss = like_pybind("gloss", "float", number, "float: from 0 to 1.")
Paint.mode = like_pybind(
    "mode",
    'typing.Literal["matte", "silk"]',
    'typing.Literal["matte", "silk"]',
    "str: the surface.",
)
Paint.coats = like_pybind(
    "coats", "typing.Literal[1, 3, 12]", "typing.Literal[1, 3, 12]", "int: of varnish."
)
Paint.tone = like_pybind(
    "tone", "numpy.typing.NDArray[numpy.float32]", "str | numpy.typing.ArrayLike",
    "ndarray (4,) float32: linear RGBA.",
)  # fmt: skip


def test_a_new_kind_needs_no_code():
    paint = Paint()
    controls = by_name(paint)
    assert {name: c.kind for name, c in controls.items()} == {
        "gloss": "number", "mode": "choice", "coats": "choice", "tone": "color", "tone alpha": "number",
    }  # fmt: skip
    assert controls["coats"].choices == ("1", "3", "12")
    assert controls["coats"].get() == "3"
    controls["coats"].set("12")
    assert paint._values["coats"] == 12
    assert (controls["gloss"].low, controls["gloss"].high) == (0, 1)
    controls["mode"].set("silk")
    controls["tone"].set("#000000")
    assert paint.mode == "silk"
    assert paint.tone.tolist() == [0, 0, 0, 1]


def test_uniforms_that_are_added_have_controls():
    material = MAKERS["ShaderMaterial"]()
    assert {"wave", "tone_color", "veil_color", "veil_color alpha", "shift"} <= set(
        by_name(material)
    )
    by_name(material)["tone_color"].set("#ffffff")
    by_name(material)["shift"].set([3, 4])
    by_name(material)["veil_color alpha"].set(1)
    assert np.array_equal(material.uniforms["tone_color"], [1, 1, 1])
    assert np.array_equal(material.uniforms["shift"], [3, 4])
    assert np.array_equal(material.uniforms["veil_color"], [0, 0, 0, 1])


def test_a_thing_without_properties():
    with pytest.raises(
        TypeError, match="expected an object with properties that can be set, got int"
    ):
        properties(3)


# ---- wrong values


def panel_of(thing, name: str) -> tuple[list[Section], int]:
    controls = properties(thing)
    return [Section("it", controls)], [c.name for c in controls].index(name)


def test_the_property_says_what_it_expects():
    basic = cc.BasicMaterial(opacity=0.5)
    panel, opacity = panel_of(basic, "opacity")
    with pytest.raises(ValueError, match="expected opacity from 0 to 1, got 2"):
        set_control(panel, 0, opacity, 2)
    assert basic.opacity == 0.5
    camera = cc.PerspectiveCamera(near=1, far=2)
    panel, far = panel_of(camera, "far")
    with pytest.raises(ValueError, match="expected near < far"):
        set_control(panel, 0, far, 0.5)
    assert camera.far == 2


@pytest.mark.parametrize(
    ("thing", "name", "value", "error", "message"),
    [
        (cc.BasicMaterial, "opacity", "1", TypeError, "opacity: expected a finite number, got '1'"),
        (cc.BasicMaterial, "opacity", True, TypeError, "expected a finite number, got True"),
        (cc.BasicMaterial, "opacity", float("nan"), TypeError, "expected a finite number, got nan"),
        (cc.BasicMaterial, "opacity", None, TypeError, "expected a finite number, got None"),
        (cc.BasicMaterial, "depth_test", 1, TypeError, "expected True or False, got 1"),
        (cc.BasicMaterial, "blend", "sum", ValueError, 'expected "None", "opaque", .*got \'sum\''),
        (cc.BasicMaterial, "color", 3, TypeError, "expected \"#rrggbb\", a CSS name, or numbers"),
        (cc.BasicMaterial, "color", "#12", ValueError, "color: expected"),
        (cc.AmbientLight, "color", "redd", (TypeError, ValueError), "expected"),
        (MAKERS["Probe"], "size", 2.5, TypeError, "size: expected a whole number, got 2.5"),
        (MAKERS["Probe"], "position", [1, 2], ValueError, "position: expected 3 numbers, got 2"),
        (MAKERS["Probe"], "position", [1, 2, "3"], TypeError, "position: expected finite numbers"),
        (MAKERS["Probe"], "position", [1, 2, float("inf")], TypeError, "expected finite numbers"),
        (MAKERS["RenderTexture"], "size", [1.5, 2], TypeError, "size: expected whole numbers"),
        (MAKERS["Node"], "name", 7, TypeError, "name: expected text, got 7"),
    ],
)  # fmt: skip
def test_values_of_another_kind(thing, name, value, error, message):
    made = thing()
    panel, index = panel_of(made, name)
    before = panel[0].controls[index].get()
    with pytest.raises(error, match=message):
        set_control(panel, 0, index, value)
    assert panel[0].controls[index].get() == before


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ((1, 0), "expected a section from 0 to 0, got 1"),
        ((-1, 0), "expected a section from 0 to 0, got -1"),
        ((0, 5), "expected a control from 0 to 1, got 5"),
        ((0, -1), "expected a control from 0 to 1, got -1"),
    ],
)
def test_controls_that_do_not_exist(place, message):
    panel = [Section("light", properties(cc.AmbientLight()))]
    with pytest.raises(IndexError, match=message):
        set_control(panel, place[0], place[1], 0.5)


def test_a_button_does_something_with_any_value():
    pressed: list[object] = []
    button = Control("Go", "button", get=lambda: None, set=pressed.append)
    set_control([Section("", (button,))], 0, 0, "x")
    assert pressed == [None]


# ---- colours


def srgb(linear):
    """IEC 61966-2-1, section 5.2, in float64."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


@given(st.lists(st.integers(0, 255), min_size=3, max_size=3))
def test_colors_of_the_picker_come_back(numbers):
    text = "#" + bytes(numbers).hex()
    linear = hex_to_color(text)
    assert np.allclose(srgb(linear.astype(float)), np.array(numbers) / 255, atol=1e-6)
    assert color_to_hex(linear) == text
    assert color_to_hex([*linear, 0.5]) == text


@given(st.lists(st.floats(0, 1, width=32), min_size=3, max_size=3))
def test_the_picker_shows_srgb(linear):
    shown = np.array(list(bytes.fromhex(color_to_hex(linear)[1:])))
    assert np.abs(shown - 255 * srgb(np.array(linear, dtype=float))).max() <= 0.5 + 1e-3


def test_the_picker_clips_and_a_color_that_it_shows_keeps_its_numbers():
    light = cc.AmbientLight(color=(2.5, 0.5, 0.1))
    picker = by_name(light)["color"]
    assert picker.get()[:3] == "#ff"
    picker.set(picker.get().upper())
    assert np.array_equal(light.color, np.array([2.5, 0.5, 0.1], np.float32))


def test_a_color_keeps_its_alpha():
    material = cc.BasicMaterial(color=(1, 1, 1, 0.25))
    controls = by_name(material)
    controls["color"].set("#ff0000")
    assert material.color.tolist() == [1, 0, 0, 0.25]
    controls["color alpha"].set(0.5)
    assert material.color.tolist() == [1, 0, 0, 0.5]
    controls["color"].set("gray")  # a CSS name, which the property reads
    assert material.color.tolist() == cc.BasicMaterial(color="gray").color.tolist()


@pytest.mark.parametrize("text", ["ff0000", "#ff00", "#gg0000", "#ff000000", ""])
def test_texts_that_are_no_color(text):
    with pytest.raises(ValueError, match=r'expected a colour as "#rrggbb", got'):
        hex_to_color(text)
    with pytest.raises(TypeError, match="text: expected str, got None"):
        hex_to_color(None)  # type: ignore[arg-type]


def test_a_background_is_a_color_none_or_a_cubemap():
    scene: Any = cc.Scene(background=(1, 0, 0, 0.5))
    controls = by_name(scene)
    controls["background is None"].set(True)
    assert (scene.background,) == (None,)
    controls["background is None"].set(False)
    assert scene.background.tolist() == [1, 0, 0, 0.5]
    cube = cc.CubeMap(np.zeros((6, 2, 2, 3), np.float32))
    scene.background = cube
    memory = Memory()
    memory.controls(scene, lambda: properties(scene))
    controls["background"].set("#00ff00")
    assert scene.background.tolist() == [0, 1, 0, 0.5]
    memory.reset()
    assert scene.background is cube
