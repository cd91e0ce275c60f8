"""Effects of a frame: compared with numpy, in order, before tone mapping, redrawn when anything they use changes."""

import copy
import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.reference import tone

IDENTITY = "vec4 effect(vec2 uv) { return frame(uv); }"
BLUR = """
vec4 effect(vec2 uv) {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) sum += frame_pixel(here + ivec2(x, y));
    return sum / 9.0;
}"""
CAMERA = cc.PerspectiveCamera(fov=50, position=(0.4, 0.3, 3), target=(0, 0, 0))


def some_scene():
    scene = cc.Scene(background=(0.1, 0.2, 0.4, 0.5))
    scene.add(cc.PointLight((2, 3, 4)))
    scene.add(
        cc.Mesh.icosphere(0.6), cc.PhongMaterial(color=(1, 0.4, 0.2)), position=(-0.4, 0.2, 0)
    )
    scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(2, 3, 0.1)), position=(0.6, -0.4, 0.2))
    return scene


def draw(renderer, scene=None, effects=(), size=(30, 20), **more):
    options = {"format": "rgba32f", **more}
    return renderer.render(scene or some_scene(), CAMERA, size, effects=effects, **options)


def box_filter(picture, radius=1):
    padded = np.pad(
        picture.astype(float), ((radius, radius), (radius, radius), (0, 0)), mode="edge"
    )
    height, width = picture.shape[:2]
    span = range(2 * radius + 1)
    parts = [padded[y : y + height, x : x + width] for y in span for x in span]
    return np.mean(parts, axis=0)


@pytest.mark.parametrize(
    ("kind", "samples"),
    [("rgba8", 1), ("rgba16f", 1), ("rgba32f", 1), ("rgba16f", 4), ("rgba32f", 4)],
)
def test_identity_changes_nothing(renderer, kind, samples):
    """rgba8 with samples clips each sample if no effect follows, and does not clip it if one follows."""
    options = {"format": kind, "samples": samples}
    plain = draw(renderer, **options)
    effect = cc.ImageEffect(IDENTITY)
    for count in (1, 2, 3):
        got = draw(renderer, effects=[effect] * count, **options).color
        tolerance = {"rgba8": "unorm8_counts", "rgba16f": "half", "rgba32f": "float32_maths"}[kind]
        if kind == "rgba8":
            got, want = got.astype(int), plain.color.astype(int)
        else:
            want = plain.color
        assert_close(got, want, tolerance)


@pytest.mark.parametrize("times", [1, 2, 5])
def test_nine_taps_are_the_box_filter(renderer, times):
    want = draw(renderer).color
    for _ in range(times):
        want = box_filter(want)
    got = draw(renderer, effects=[cc.ImageEffect(BLUR)] * times).color
    assert_close(got, want, "blend")


def test_uv_and_pixels_count_from_the_bottom_left(renderer):
    width, height = 6, 4
    where = cc.ImageEffect("vec4 effect(vec2 uv) { return vec4(uv, vec2(frame_size())); }")
    got = draw(renderer, effects=[where], size=(width, height)).color
    assert_close(
        got[..., 0],
        np.broadcast_to((np.arange(width) + 0.5) / width, (height, width)),
        "float32_maths",
    )
    rows = (height - 0.5 - np.arange(height)) / height
    assert_close(got[..., 1], np.broadcast_to(rows[:, None], (height, width)), "float32_maths")
    assert (got[..., 2:] == (width, height)).all()
    corner = cc.ImageEffect("vec4 effect(vec2 uv) { return frame_pixel(ivec2(0)); }")
    plain = draw(renderer).color
    got = draw(renderer, effects=[corner]).color
    assert_identical(got, np.broadcast_to(plain[-1, 0], got.shape).copy())


def test_frame_is_bilinear_and_clamps(renderer):
    """Half a pixel to the right of a centre is the mean of two; beyond the border the border pixel is read."""
    shift = cc.ImageEffect(
        "uniform vec2 by; vec4 effect(vec2 uv) { return frame(uv + by / vec2(frame_size())); }"
    )
    plain = draw(renderer).color
    shift.uniforms["by"] = (0.5, 0)
    right = np.concatenate([plain[:, 1:], plain[:, -1:]], axis=1)
    assert_close(draw(renderer, effects=[shift]).color, (plain + right) / 2, "lookup")
    shift.uniforms["by"] = (0, 1)
    up = np.concatenate([plain[:1], plain[:-1]])
    assert_close(draw(renderer, effects=[shift]).color, up, "lookup")


def test_effects_run_in_order(renderer):
    double = cc.ImageEffect("vec3 effect(vec2 uv) { return 2.0 * frame(uv).rgb; }")
    plus = cc.ImageEffect("vec3 effect(vec2 uv) { return frame(uv).rgb + 1.0; }")
    plain = draw(renderer).color
    for order, want in (([double, plus], plain * 2 + 1), ([plus, double], plain * 2 + 2)):
        want[..., 3] = plain[..., 3]
        assert_close(draw(renderer, effects=order).color, want, "float32_maths")


def test_they_see_linear_light_before_the_tone_curve(renderer):
    double = cc.ImageEffect("vec3 effect(vec2 uv) { return 2.0 * frame(uv).rgb; }")
    plain = draw(renderer).color[..., :3].astype(float)
    got = draw(renderer, effects=[double], tonemap="reinhard", encode="srgb").color[..., :3]
    assert_close(got, tone.srgb_encode(tone.reinhard(2 * plain)), "tone")


def test_negative_and_bright_values_pass_between_effects_and_out(renderer):
    minus = cc.ImageEffect("vec4 effect(vec2 uv) { return vec4(-5.0, 1e6, 0.25, -1.0); }")
    got = draw(renderer, effects=[minus, cc.ImageEffect(IDENTITY)]).color
    assert_identical(
        got, np.broadcast_to(np.array([-5, 1e6, 0.25, -1], np.float32), got.shape).copy()
    )
    clamped = draw(renderer, effects=[minus], format="rgba8").color
    assert (clamped == (0, 255, 64, 0)).all()


def test_outputs_are_those_of_the_scene(renderer):
    names = ("distance", "z", "normal", "position", "id")
    plain = draw(renderer, outputs=names)
    other = draw(renderer, outputs=names, effects=[cc.ImageEffect(BLUR)])
    for name in names:
        assert_identical(getattr(plain, name), getattr(other, name), name)


def test_uniforms_and_textures(renderer):
    ramp = np.linspace(0, 1, 4, dtype=np.float32).reshape(1, 4, 1) * np.ones((2, 4, 3), np.float32)
    sky = cc.CubeMap(
        np.arange(6, dtype=np.float32)[:, None, None, None] * np.ones((6, 1, 1, 1), np.float32)
    )
    effect = cc.ImageEffect(
        """uniform vec3 tint; uniform sampler2D ramp; uniform samplerCube sky;
        vec3 effect(vec2 uv) { return tint * texture(ramp, vec2(.875, .5)).r + texture(sky, vec3(0, 1, 0)).r; }""",
        uniforms={"tint": (1, 2, 3)},
        textures={"ramp": ramp, "sky": sky},
    )
    got = draw(renderer, effects=[effect]).color
    assert_close(got[..., :3], np.broadcast_to([3, 4, 5], got[..., :3].shape), "float32_maths")


def test_changes_redraw_and_nothing_else_does(fresh_renderer):
    scene = some_scene()
    effect = cc.ImageEffect(
        "uniform float k = 1.0; vec3 effect(vec2 uv) { return k * frame(uv).rgb; }"
    )
    cube = cc.CubeMap(np.ones((6, 2, 2, 3), np.float32))

    def drawn():
        draw(fresh_renderer, scene, [effect])
        return fresh_renderer.stats.views_drawn

    assert [drawn(), drawn()] == [1, 0]
    effect.uniforms["k"] = 2
    assert [drawn(), drawn()] == [1, 0]
    effect.uniforms["k"] = 2.0
    assert drawn() == 0
    effect.fragment = """uniform samplerCube c; uniform float k;
        vec3 effect(vec2 uv) { return k * texture(c, vec3(1)).rgb; }"""
    effect.textures["c"] = cube
    assert [drawn(), drawn()] == [1, 0]
    cube.set_face(cc.Face.POS_X, np.zeros((2, 2, 3), np.float32))
    assert [drawn(), drawn()] == [1, 0]


def test_partly_redrawn_pictures_are_those_drawn_anew(new_renderer):
    scene, kept, effects = some_scene(), new_renderer(), [cc.ImageEffect(BLUR)] * 2
    for step in range(4):
        scene.nodes[1].position = (0.6 - 0.2 * step, -0.4 + 0.1 * step, 0.2)
        got = draw(kept, scene, effects, tonemap="aces").color
        assert_identical(got, draw(new_renderer(), scene, effects, tonemap="aces").color)


def test_errors(renderer, tmp_path):
    with pytest.raises(ValueError, match="expected a fragment with a function vec4 effect"):
        cc.ImageEffect("vec4 main() {}")
    with pytest.raises(TypeError, match="effects: expected ImageEffects, got int"):
        draw(renderer, effects=[3])
    with pytest.raises(TypeError, match="effects: expected a sequence of ImageEffects"):
        draw(renderer, effects=cc.ImageEffect(IDENTITY))
    with pytest.raises(ValueError, match="Images, RenderTextures or CubeMaps, got a Probe for t"):
        cc.ImageEffect(IDENTITY, textures={"t": cc.Probe()})
    with pytest.raises(cc.ShaderError, match=r"(?s)fragment does not compile.*fragment:2"):
        draw(renderer, effects=[cc.ImageEffect("\nvec4 effect(vec2 uv) { return nothing; }")])
    with pytest.raises(
        ValueError, match="uniform k: expected none, since the source declares none"
    ):
        draw(renderer, effects=[cc.ImageEffect(IDENTITY, uniforms={"k": 1})])
    path = tmp_path / "fade.frag"
    path.write_text("vec4 effect(vec2 uv) { return vec4(1.0); }")
    effect = cc.ImageEffect(path)
    assert draw(renderer, effects=[effect]).color.min() == 1
    path.write_text("vec4 effect(vec2 uv) { return vec4(0.5); }")
    assert effect.reload() is True
    assert draw(renderer, effects=[effect]).color.max() == 0.5
    assert draw(renderer).color.max() > 1, "the renderer goes on"


def test_copies(renderer):
    effect = cc.ImageEffect(
        "uniform float k; uniform sampler2D t; vec3 effect(vec2 uv) { return k * texture(t, uv).rgb; }",
        uniforms={"k": 3},
        textures={"t": np.full((1, 1, 3), 0.25, np.float32)},
    )
    for copied in (pickle.loads(pickle.dumps(effect)), copy.deepcopy(effect)):
        assert_identical(
            draw(renderer, effects=[copied]).color, draw(renderer, effects=[effect]).color
        )
        copied.uniforms["k"] = 0
    assert effect.uniforms["k"] == 3


SHIFT = "vec4 effect(vec2 uv) { return frame_pixel(ivec2(gl_FragCoord.xy) + ivec2(25, -15)); }"


@pytest.mark.parametrize("effects", [[], [cc.ImageEffect(SHIFT)]], ids=["none", "a shift"])
def test_a_small_change_is_graded_where_it_shows(new_renderer, effects):
    """Without effects only changed rectangles get their tone curve; effects carry a change beyond them."""
    live, scratch = new_renderer(), new_renderer(cache_bytes=0)
    scene = some_scene()
    box = scene.nodes[-1]
    options = {"size": (90, 60), "tonemap": "aces", "encode": "srgb", "format": "rgba8"}
    for step in range(5):
        box.position = (0.6 - 0.1 * step, -0.4, 0.2)
        got, want = (draw(one, scene, effects, **options) for one in (live, scratch))
        assert_identical(got.color, want.color, f"step {step}")
