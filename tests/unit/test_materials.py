"""Materials, lights and probes: their defaults are those of design.md section 1; what they refuse."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc


def test_phong_defaults():
    material = cc.PhongMaterial(color=(0.4, 0.4, 1))
    np.testing.assert_allclose(material.color, [0.4, 0.4, 1, 1], rtol=1e-6)
    assert (material.ka, material.kd, material.ks, material.shininess) == pytest.approx(
        (0.2, 0.7, 1, 10)
    )
    assert material.map is None
    assert material.opacity == 1
    assert material.double_sided is False


def test_basic_defaults():
    material = cc.BasicMaterial()
    np.testing.assert_array_equal(material.color, [1, 1, 1, 1])
    assert material.map is None
    assert material.cubemap is None
    assert material.vertex_colors is False


def test_mirror_defaults():
    material = cc.MirrorMaterial()
    np.testing.assert_array_equal(material.tint[:3], [1, 1, 1])
    np.testing.assert_array_equal(material.color[:3], [0, 0, 0])
    assert (material.env_weight, material.color_weight, material.f0) == (1, 0, None)


def test_glass_defaults():
    material = cc.GlassMaterial()
    assert material.ior == 1.5
    assert material.fresnel is True
    np.testing.assert_array_equal(material.tint[:3], [1, 1, 1])


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (cc.BasicMaterial, (1, 0, 0)),
        (cc.PhongMaterial, (1, 0, 0)),
        (cc.MirrorMaterial, (1, 0, 0)),
        (cc.GlassMaterial, 1.5),
    ],
)
def test_parameters_go_by_name(kind, value):
    with pytest.raises(TypeError):
        kind(value)


def test_of_a_shader_material_only_the_fragment_goes_by_position():
    source = "vec3 shade(Surface s) { return s.normal; }"
    assert cc.ShaderMaterial(source).fragment == source
    with pytest.raises(TypeError):
        cc.ShaderMaterial(source, "void vertex(inout Vertex v) {}")  # type: ignore[call-arg]


@pytest.mark.parametrize(
    ("kind", "old", "new"),
    [(cc.GlassMaterial, "eta", "ior, which is 1 / eta"), (cc.MirrorMaterial, "fresnel", "f0")],
)
def test_old_names_answer_with_the_new_ones(kind, old, new):
    assert old not in dir(kind())
    name = kind.__name__
    answer = f"^{name}.{old} is now {name}.{new}$"
    with pytest.raises(AttributeError, match=answer):
        getattr(kind(), old)
    with pytest.raises(TypeError, match=rf"^{name}\(\): {old} is now {new}$"):
        kind(**{old: 0.5})


def test_fourth_number_of_a_color():
    np.testing.assert_allclose(cc.BasicMaterial(color=(1, 0, 0, 0.25)).color, [1, 0, 0, 0.25])


def test_point_light_defaults():
    light = cc.PointLight(position=(1, 2, 3))
    np.testing.assert_array_equal(light.position, [1, 2, 3])
    np.testing.assert_array_equal(light.color, [1, 1, 1])
    assert (light.intensity, light.decay) == (1, 0)


def test_directions_of_light_are_normalised():
    np.testing.assert_allclose(cc.DirectionalLight(direction=(0, -3, 0)).direction, [0, -1, 0])


def test_probe_defaults():
    probe = cc.Probe(position=(1, 2, 3))
    np.testing.assert_array_equal(probe.position, [1, 2, 3])
    assert (probe.size, probe.near, probe.far, probe.format) == (256, 0.05, 1000, "rgba16f")
    assert (probe.mipmaps, probe.samples, probe.update, probe.faces_per_frame) == (
        False,
        1,
        "on_change",
        6,
    )
    assert list(probe.exclude) == []
    assert probe.parent is None


@pytest.mark.parametrize("update", ["on_change", "once", "manual", 1, 5])
def test_probe_update_reads_back(update):
    assert cc.Probe(position=(0, 0, 0), update=update).update == update


def test_an_array_as_map_becomes_an_image():
    material = cc.BasicMaterial(map=np.full((2, 3, 3), 7, np.uint8))
    assert isinstance(material.map, cc.Image)
    assert (tuple(material.map.size), material.map.channels) == ((3, 2), 3)
    np.testing.assert_array_equal(material.map.pixels, 7)


def test_basic_cubemap_is_a_cubemap_or_a_probe():
    for source in (cc.CubeMap(np.zeros((6, 2, 2, 3))), cc.Probe(position=(0, 0, 0))):
        assert cc.BasicMaterial(cubemap=source).cubemap is source
    with pytest.raises(TypeError):
        cc.BasicMaterial(cubemap=np.zeros((6, 2, 2, 3)))  # type: ignore[arg-type]


BAD: dict[str, tuple[Any, dict[str, Any], type[Exception], str]] = {
    "opacity": (cc.BasicMaterial, {"opacity": 1.5}, ValueError, "opacity"),
    "opacity negative": (cc.BasicMaterial, {"opacity": -0.1}, ValueError, "opacity"),
    "opacity nan": (cc.GlassMaterial, {"opacity": np.nan}, ValueError, "opacity"),
    "color of 2": (cc.BasicMaterial, {"color": (1, 1)}, ValueError, "color"),
    "color of 5": (cc.PhongMaterial, {"color": (1, 1, 1, 1, 1)}, ValueError, "color"),
    "color nan": (cc.PhongMaterial, {"color": (1, np.nan, 1)}, ValueError, "color"),
    "color text": (cc.PhongMaterial, {"color": "rde"}, ValueError, "did you mean 'red'"),
    "color bool": (cc.PhongMaterial, {"color": (True, False, False)}, TypeError, "color"),
    "shininess": (cc.PhongMaterial, {"shininess": -1}, ValueError, "shininess"),
    "ka inf": (cc.PhongMaterial, {"ka": np.inf}, ValueError, "ka"),
    "f0": (cc.MirrorMaterial, {"f0": 1.5}, ValueError, "f0"),
    "env_weight nan": (cc.MirrorMaterial, {"env_weight": np.nan}, ValueError, "env_weight"),
    "ior": (cc.GlassMaterial, {"ior": 0}, ValueError, "ior"),
    "ior too small": (cc.GlassMaterial, {"ior": 1e-40}, ValueError, "ior"),
    "ior nan": (cc.GlassMaterial, {"ior": np.nan}, ValueError, "ior"),
    "tint": (cc.GlassMaterial, {"tint": (np.inf, 1, 1)}, ValueError, "tint"),
    "map": (cc.BasicMaterial, {"map": "brick.png"}, TypeError, "map"),
    "light nan": (cc.PointLight, {"position": (np.nan, 0, 0)}, ValueError, "position"),
    "light intensity": (
        cc.PointLight,
        {"position": (0, 0, 0), "intensity": -1},
        ValueError,
        "intensity",
    ),
    "light decay": (cc.PointLight, {"position": (0, 0, 0), "decay": np.nan}, ValueError, "decay"),
    "light direction": (cc.DirectionalLight, {"direction": (0, 0, 0)}, ValueError, "direction"),
    "light color": (cc.AmbientLight, {"color": (1, 1)}, ValueError, "color"),
    "probe size 0": (cc.Probe, {"position": (0, 0, 0), "size": 0}, ValueError, "size"),
    "probe size float": (cc.Probe, {"position": (0, 0, 0), "size": 2.5}, TypeError, "size"),
    "probe near": (cc.Probe, {"position": (0, 0, 0), "near": 5, "far": 2}, ValueError, "near"),
    "probe format": (cc.Probe, {"position": (0, 0, 0), "format": "rgb"}, ValueError, "rgba16f"),
    "probe samples": (cc.Probe, {"position": (0, 0, 0), "samples": 0}, ValueError, "samples"),
    "probe update": (cc.Probe, {"position": (0, 0, 0), "update": "often"}, ValueError, "on_change"),
    "probe update 0": (cc.Probe, {"position": (0, 0, 0), "update": 0}, ValueError, "update"),
    "probe faces": (
        cc.Probe,
        {"position": (0, 0, 0), "faces_per_frame": 7},
        ValueError,
        "faces_per_frame",
    ),
    "probe position": (cc.Probe, {"position": (0, np.inf, 0)}, ValueError, "position"),
    "probe exclude": (cc.Probe, {"position": (0, 0, 0), "exclude": [3]}, TypeError, "exclude"),
}


@pytest.mark.parametrize(("make", "arguments", "error", "text"), BAD.values(), ids=BAD)
def test_bad_values_are_refused(make, arguments, error, text):
    with pytest.raises(error, match=text):
        make(**arguments)


SETTABLE = [name for name in BAD if name not in ("probe exclude", "probe near")]


@pytest.mark.parametrize("case", SETTABLE)
def test_setters_refuse_the_same_and_keep_the_old(case):
    make, arguments, error, text = BAD[case]
    defaults = {cc.PointLight: {"position": (0, 0, 0)}, cc.Probe: {"position": (0, 0, 0)}}
    defaults[cc.DirectionalLight] = {"direction": (0, -1, 0)}
    thing = make(**defaults.get(make, {}))
    name = list(arguments)[-1]
    before = np.array(getattr(thing, name))
    with pytest.raises(error, match=text):
        setattr(thing, name, arguments[name])
    np.testing.assert_array_equal(np.array(getattr(thing, name)), before)


def test_colors_handed_out_are_read_only():
    with pytest.raises(ValueError, match="read-only"):
        cc.BasicMaterial().color[0] = 0


def test_unknown_arguments_are_refused():
    with pytest.raises(TypeError):
        cc.PhongMaterial(colour=(1, 0, 0))  # type: ignore[call-arg]
