"""Colours by name: every colour property accepts CSS's names, and decodes them by the curve of sRGB."""

import numpy as np
import pytest

import cubecam as cc

#: CSS Color Module Level 4, section 6.1, "Named Colors": the sRGB bytes as the specification lists them.
CSS = """
aliceblue #f0f8ff
antiquewhite #faebd7
aqua #00ffff
aquamarine #7fffd4
azure #f0ffff
beige #f5f5dc
bisque #ffe4c4
black #000000
blanchedalmond #ffebcd
blue #0000ff
blueviolet #8a2be2
brown #a52a2a
burlywood #deb887
cadetblue #5f9ea0
chartreuse #7fff00
chocolate #d2691e
coral #ff7f50
cornflowerblue #6495ed
cornsilk #fff8dc
crimson #dc143c
cyan #00ffff
darkblue #00008b
darkcyan #008b8b
darkgoldenrod #b8860b
darkgray #a9a9a9
darkgreen #006400
darkgrey #a9a9a9
darkkhaki #bdb76b
darkmagenta #8b008b
darkolivegreen #556b2f
darkorange #ff8c00
darkorchid #9932cc
darkred #8b0000
darksalmon #e9967a
darkseagreen #8fbc8f
darkslateblue #483d8b
darkslategray #2f4f4f
darkslategrey #2f4f4f
darkturquoise #00ced1
darkviolet #9400d3
deeppink #ff1493
deepskyblue #00bfff
dimgray #696969
dimgrey #696969
dodgerblue #1e90ff
firebrick #b22222
floralwhite #fffaf0
forestgreen #228b22
fuchsia #ff00ff
gainsboro #dcdcdc
ghostwhite #f8f8ff
gold #ffd700
goldenrod #daa520
gray #808080
green #008000
greenyellow #adff2f
grey #808080
honeydew #f0fff0
hotpink #ff69b4
indianred #cd5c5c
indigo #4b0082
ivory #fffff0
khaki #f0e68c
lavender #e6e6fa
lavenderblush #fff0f5
lawngreen #7cfc00
lemonchiffon #fffacd
lightblue #add8e6
lightcoral #f08080
lightcyan #e0ffff
lightgoldenrodyellow #fafad2
lightgray #d3d3d3
lightgreen #90ee90
lightgrey #d3d3d3
lightpink #ffb6c1
lightsalmon #ffa07a
lightseagreen #20b2aa
lightskyblue #87cefa
lightslategray #778899
lightslategrey #778899
lightsteelblue #b0c4de
lightyellow #ffffe0
lime #00ff00
limegreen #32cd32
linen #faf0e6
magenta #ff00ff
maroon #800000
mediumaquamarine #66cdaa
mediumblue #0000cd
mediumorchid #ba55d3
mediumpurple #9370db
mediumseagreen #3cb371
mediumslateblue #7b68ee
mediumspringgreen #00fa9a
mediumturquoise #48d1cc
mediumvioletred #c71585
midnightblue #191970
mintcream #f5fffa
mistyrose #ffe4e1
moccasin #ffe4b5
navajowhite #ffdead
navy #000080
oldlace #fdf5e6
olive #808000
olivedrab #6b8e23
orange #ffa500
orangered #ff4500
orchid #da70d6
palegoldenrod #eee8aa
palegreen #98fb98
paleturquoise #afeeee
palevioletred #db7093
papayawhip #ffefd5
peachpuff #ffdab9
peru #cd853f
pink #ffc0cb
plum #dda0dd
powderblue #b0e0e6
purple #800080
rebeccapurple #663399
red #ff0000
rosybrown #bc8f8f
royalblue #4169e1
saddlebrown #8b4513
salmon #fa8072
sandybrown #f4a460
seagreen #2e8b57
seashell #fff5ee
sienna #a0522d
silver #c0c0c0
skyblue #87ceeb
slateblue #6a5acd
slategray #708090
slategrey #708090
snow #fffafa
springgreen #00ff7f
steelblue #4682b4
tan #d2b48c
teal #008080
thistle #d8bfd8
tomato #ff6347
turquoise #40e0d0
violet #ee82ee
wheat #f5deb3
white #ffffff
whitesmoke #f5f5f5
yellow #ffff00
yellowgreen #9acd32
"""
NAMED = dict(line.split() for line in CSS.split("\n") if line)


def decoded(*bytes_):
    """Linear numbers from sRGB bytes, by IEC 61966-2-1, section 5.2."""
    encoded = np.array(bytes_) / 255
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def bytes_of(code):
    return [int(code[i : i + 2], 16) for i in range(1, len(code), 2)]


def background(color):
    got = cc.Scene(background=color).background
    assert isinstance(got, np.ndarray)
    return got


def test_the_table_is_whole():
    assert len(NAMED) == 148
    assert "rebeccapurple" in NAMED


@pytest.mark.parametrize("name", NAMED)
def test_names(name):
    want = [*decoded(*bytes_of(NAMED[name])), 1]
    for text in (name, name.upper(), NAMED[name], NAMED[name].upper()):
        got = background(text)
        np.testing.assert_allclose(got, want, rtol=1e-6, err_msg=text)


def test_transparent():
    assert background("transparent").tolist() == [0, 0, 0, 0]


@pytest.mark.parametrize(
    ("text", "bytes_", "alpha"),
    [
        ("#f80", (0xFF, 0x88, 0x00), 255),
        ("#F80a", (0xFF, 0x88, 0x00), 0xAA),
        ("#010203", (1, 2, 3), 255),
        ("#0a0B0c80", (10, 11, 12), 128),
    ],
)
def test_numbers_of_sixteen(text, bytes_, alpha):
    """Alpha is a share, not a brightness, so the sRGB curve is not applied to it."""
    got = background(text)
    np.testing.assert_allclose(got, [*decoded(*bytes_), alpha / 255], rtol=1e-6)


def test_every_byte():
    for value in range(256):
        got = background(f"#{value:02x}{255 - value:02x}00")
        np.testing.assert_allclose(got[:2], decoded(value, 255 - value), rtol=1e-6)


def test_tuples_stay_as_they_are():
    assert background((0.5, 2, 0.25)).tolist() == [0.5, 2, 0.25, 1]


#: Every property that is called color or tint, and the background of a scene.
OWNERS = {
    "background": (lambda **c: cc.Scene(**c), "background"),
    "basic": (lambda **c: cc.BasicMaterial(**c), "color"),
    "phong": (lambda **c: cc.PhongMaterial(**c), "color"),
    "mirror color": (lambda **c: cc.MirrorMaterial(**c), "color"),
    "mirror tint": (lambda **c: cc.MirrorMaterial(**c), "tint"),
    "glass": (lambda **c: cc.GlassMaterial(**c), "tint"),
    "standard": (lambda **c: cc.StandardMaterial(**c), "color"),
    "ambient": (lambda **c: cc.AmbientLight(**c), "color"),
    "point": (lambda **c: cc.PointLight(**c), "color"),
    "spot": (lambda **c: cc.SpotLight(**c), "color"),
    "directional": (lambda **c: cc.DirectionalLight(**c), "color"),
}


def test_no_owner_is_forgotten():
    found = {
        (kind.__name__, name)
        for kind in vars(cc).values()
        if isinstance(kind, type) and issubclass(kind, (cc.Material, cc.Light))
        for name in ("color", "tint")
        if hasattr(kind, name) and kind not in (cc.Material, cc.Light)
    }
    listed = {(type(make()).__name__, name) for make, name in OWNERS.values()}
    assert found == listed - {("Scene", "background")}


@pytest.mark.parametrize(("make", "name"), OWNERS.values(), ids=OWNERS)
def test_everywhere(make, name):
    want = [*decoded(0x66, 0x33, 0x99), 1]
    owner = make(**{name: "rebeccapurple"})
    size = len(getattr(owner, name))
    np.testing.assert_allclose(getattr(owner, name), want[:size], rtol=1e-6)
    setattr(owner, name, "#ff8000")
    np.testing.assert_allclose(getattr(owner, name), [*decoded(255, 128, 0), 1][:size], rtol=1e-6)
    before = getattr(owner, name).tolist()
    for call in (lambda: make(**{name: "chartruse"}), lambda: setattr(owner, name, "chartruse")):
        with pytest.raises(ValueError, match=f"^{name}: .* 'chartruse'; did you mean 'chartreuse'"):
            call()
    assert getattr(owner, name).tolist() == before


BAD = {
    "rde": "did you mean 'red'",
    "dark blue": "did you mean 'darkblue'",
    "gray50": "did you mean 'gray'",
    "": "expected numbers, a CSS name",
    "zzzzzzzzzzzz": "got 'zzzzzzzzzzzz'$",
    "#": '#rgb", "#rgba", "#rrggbb" or "#rrggbbaa", got \'#\'',
    "#12": "got '#12'",
    "#12345": "got '#12345'",
    "#1234567": "got '#1234567'",
    "#123456789": "got '#123456789'",
    "#ggg": "got '#ggg'",
    "#12 456": "got '#12 456'",
    "#röd": "got",
}


@pytest.mark.parametrize(("text", "message"), BAD.items(), ids=BAD)
def test_what_is_no_color(text, message):
    with pytest.raises(ValueError, match=message):
        cc.BasicMaterial(color=text)


@pytest.mark.parametrize("text", ["transparent", "#ff000080", "#f008"])
def test_light_has_no_alpha(text):
    with pytest.raises(ValueError, match="color: expected a colour without alpha"):
        cc.PointLight(color=text)
    assert cc.PointLight(color="#ff0000ff").color.tolist() == [1, 0, 0]


def test_vertex_colors_are_numbers():
    with pytest.raises(TypeError, match="colors"):
        cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], colors=["red"] * 3)
