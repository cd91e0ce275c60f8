"""The values of Shadow, of the lights that have a shadow, of SpotLight and of the flags of nodes."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import copies

FIELDS: dict[str, Any] = {
    "size": 512,
    "radius": 2.5,
    "bias": 0.01,
    "near": 0.1,
    "far": 30.0,
    "extent": 8.0,
}
LIGHTS = [cc.PointLight, cc.DirectionalLight, cc.SpotLight]


def test_defaults():
    shadow = cc.Shadow()
    assert (shadow.size, shadow.radius, shadow.bias, shadow.near) == (1024, 1, 0, 0.05)
    assert shadow.far is None
    assert shadow.extent is None


@pytest.mark.parametrize("name", FIELDS)
def test_fields_are_kept_and_cannot_be_set(name):
    shadow = cc.Shadow(**FIELDS)
    assert getattr(shadow, name) == FIELDS[name]
    with pytest.raises(AttributeError):
        setattr(shadow, name, FIELDS[name])


def test_equality_and_hash():
    assert cc.Shadow() == cc.Shadow(size=1024)
    assert hash(cc.Shadow(**FIELDS)) == hash(cc.Shadow(**FIELDS))
    for name in FIELDS:
        other = cc.Shadow(**{key: value for key, value in FIELDS.items() if key != name})
        assert other != cc.Shadow(**FIELDS)
    assert cc.Shadow() != 1024
    assert cc.Shadow() is not None


@copies
def test_copies(make_copy):
    assert make_copy(cc.Shadow(**FIELDS)) == cc.Shadow(**FIELDS)
    assert make_copy(cc.Shadow()) == cc.Shadow()


BAD = {
    "size 7": ({"size": 7, "radius": 0}, "size of at least 8 texels for a radius of 0, got 7"),
    "size for radius": ({"size": 19, "radius": 2.5}, "size of at least 20 .* 2.5, got 19"),
    "size 0": ({"size": 0}, "size"),
    "size negative": ({"size": -1}, "size"),
    "radius negative": ({"radius": -0.1}, "radius from 0 to 16 texels, got -0.1"),
    "radius large": ({"radius": 17}, "radius"),
    "radius nan": ({"radius": np.nan}, "radius"),
    "bias negative": ({"bias": -1}, "bias"),
    "bias inf": ({"bias": np.inf}, "bias"),
    "near 0": ({"near": 0}, "near"),
    "near nan": ({"near": np.nan}, "near"),
    "far below near": ({"near": 2, "far": 1}, "near below far"),
    "far inf": ({"far": np.inf}, "far"),
    "extent 0": ({"extent": 0}, "extent"),
    "extent negative": ({"extent": -2}, "extent"),
}


@pytest.mark.parametrize(("options", "message"), BAD.values(), ids=BAD)
def test_bad_values(options, message):
    with pytest.raises(ValueError, match=message):
        cc.Shadow(**options)


@pytest.mark.parametrize(
    "options", [{"size": "512"}, {"size": 1.5}, {"radius": None}, {"far": "x"}]
)
def test_bad_types(options):
    with pytest.raises(TypeError):
        cc.Shadow(**options)


def test_a_size_beyond_an_int():
    with pytest.raises((ValueError, TypeError, OverflowError)):
        cc.Shadow(size=1 << 70)


def test_repr_is_code():
    shadow = cc.Shadow(**FIELDS)
    assert eval(repr(shadow), {"Shadow": cc.Shadow}) == shadow


@pytest.mark.parametrize("light", LIGHTS)
def test_the_shadow_of_a_light(light):
    assert light().shadow is None
    assert light(shadow=True).shadow == cc.Shadow()
    lamp = light(shadow=cc.Shadow(size=256))
    assert lamp.shadow == cc.Shadow(size=256)
    lamp.shadow = cc.Shadow(size=128)
    assert lamp.shadow.size == 128
    lamp.shadow = True
    assert lamp.shadow == cc.Shadow()
    lamp.shadow = None
    assert lamp.shadow is None
    assert "shadow" not in repr(lamp)
    lamp.shadow = True
    assert repr(cc.Shadow()) in repr(lamp)
    for wrong in (1, 1024, "yes", (512, 1)):
        with pytest.raises(TypeError, match="shadow: expected a Shadow, True or None, got"):
            lamp.shadow = wrong
        with pytest.raises(TypeError):
            light(shadow=wrong)
    assert lamp.shadow == cc.Shadow()


def test_ambient_light_has_none():
    light = cc.AmbientLight()
    assert not hasattr(light, "shadow")
    with pytest.raises(TypeError):
        cc.AmbientLight(shadow=True)  # type: ignore[call-arg]


@copies
@pytest.mark.parametrize("light", LIGHTS)
def test_a_lights_copy_keeps_its_shadow(make_copy, light):
    assert make_copy(light(shadow=cc.Shadow(**FIELDS))).shadow == cc.Shadow(**FIELDS)
    assert make_copy(light()).shadow is None


# The tests of SpotLight.


def test_spot_defaults():
    light = cc.SpotLight()
    np.testing.assert_array_equal(light.position, [0, 0, 0])
    np.testing.assert_array_equal(light.direction, [0, -1, 0])
    np.testing.assert_array_equal(light.color, [1, 1, 1])
    assert (light.angle, light.penumbra, light.intensity, light.decay) == (30, 0, 1, 0)


@copies
def test_a_copy_of_a_spot(make_copy):
    light = make_copy(
        cc.SpotLight(
            (1, 2, 3),
            (0, 0, -3),
            angle=20,
            penumbra=0.25,
            color=(1, 0.5, 0.25),
            intensity=2,
            decay=1.5,
            shadow=cc.Shadow(size=64),
        )
    )
    assert isinstance(light, cc.SpotLight)
    np.testing.assert_array_equal(light.position, [1, 2, 3])
    np.testing.assert_array_equal(light.direction, [0, 0, -1])
    np.testing.assert_array_equal(light.color, [1, 0.5, 0.25])
    assert (light.angle, light.penumbra, light.intensity, light.decay) == (20, 0.25, 2, 1.5)
    assert light.shadow == cc.Shadow(size=64)


def test_spot_setters():
    light = cc.SpotLight()
    light.direction = (3, 0, 4)
    np.testing.assert_allclose(light.direction, [0.6, 0, 0.8])
    light.position, light.angle, light.penumbra, light.decay = (1, 2, 3), 45, 1, 2
    np.testing.assert_array_equal(light.position, [1, 2, 3])
    assert (light.angle, light.penumbra, light.decay) == (45, 1, 2)
    with pytest.raises(ValueError, match="read-only"):
        light.position[0] = 5


SPOTS = {
    "angle 0": ({"angle": 0}, "angle above 0 and below 90 degrees, got 0"),
    "angle 90": ({"angle": 90}, "angle"),
    "angle nan": ({"angle": np.nan}, "angle"),
    "penumbra": ({"penumbra": 1.1}, "penumbra from 0 to 1, got 1.1"),
    "penumbra negative": ({"penumbra": -0.1}, "penumbra"),
    "direction": ({"direction": (0, 0, 0)}, "direction"),
    "position": ({"position": (np.inf, 0, 0)}, "position"),
    "decay": ({"decay": -1}, "decay"),
    "color": ({"color": (-1, 0, 0)}, "color"),
}


@pytest.mark.parametrize(("options", "message"), SPOTS.values(), ids=SPOTS)
def test_bad_spots(options, message):
    with pytest.raises(ValueError, match=message):
        cc.SpotLight(**options)
    light = cc.SpotLight()
    ((name, value),) = options.items()
    before = getattr(light, name)
    with pytest.raises(ValueError, match=message):
        setattr(light, name, value)
    np.testing.assert_array_equal(getattr(light, name), before)


# The tests of the flags of nodes.


def test_flags_of_nodes():
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box())
    assert node.cast_shadow is True
    assert node.receive_shadow is True
    node.cast_shadow = False
    node.receive_shadow = False
    assert node.cast_shadow is False
    assert node.receive_shadow is False
    other = scene.add(cc.Mesh.box(), cast_shadow=False, receive_shadow=False, name="x")
    assert not other.cast_shadow
    assert not other.receive_shadow


@copies
def test_a_copy_of_a_node_keeps_its_flags(make_copy):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), cast_shadow=False)
    scene.add(cc.Mesh.box(), receive_shadow=False)
    scene.add(cc.PointLight(shadow=cc.Shadow(size=64)))
    other = make_copy(scene)
    assert [n.cast_shadow for n in other.nodes] == [False, True]
    assert [n.receive_shadow for n in other.nodes] == [True, False]
    assert other.lights[0].shadow == cc.Shadow(size=64)
