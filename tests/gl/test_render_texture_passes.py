"""Render textures with image passes over them, in shaders of one's own, and in effects."""

import gc
import pickle
import weakref

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical

FLAT = cc.OrthographicCamera(height=2, position=(0, 0, 1), far=10)
QUAD = cc.Mesh(
    [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)],
    [(0, 1, 2), (0, 2, 3)],
    uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
)


def screen(map_):
    """A scene that shows a picture pixel by pixel."""
    scene = cc.Scene()
    scene.add(QUAD, cc.BasicMaterial(map=map_))
    return scene


def small_scene():
    scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
    scene.add(cc.Mesh.box(0.7), cc.BasicMaterial(color=(1, 0.5, 0)), position=(0.4, -0.3, -1))
    return scene


def draw(renderer, scene, size=12, **more):
    return renderer.render(scene, FLAT, (size, size), format="rgba32f", **more).color


DOUBLE = "vec3 effect(vec2 uv) { return 2.0 * frame(uv).rgb; }"
PLUS = "vec3 effect(vec2 uv) { return frame(uv).rgb + vec3(uv, 0.0); }"


def test_passes_run_over_the_texture(any_path):
    plain = draw(any_path, small_scene())
    effects = [cc.ImageEffect(DOUBLE), cc.ImageEffect(PLUS)]
    texture = cc.RenderTexture(
        small_scene(), FLAT, size=(12, 12), format="rgba32f", effects=effects
    )
    got = draw(any_path, screen(texture))
    u = np.broadcast_to((np.arange(12) + 0.5) / 12, (12, 12))
    want = 2 * plain[..., :3] + np.stack([u, u.T[::-1], 0 * u], axis=-1)
    assert_close(got[..., :3], want, "lookup")
    assert_close(any_path.read_texture(texture)[..., :3], want, "float32_maths")


def test_a_pass_alone_makes_a_picture(renderer):
    checks = "vec4 effect(vec2 uv) { return vec4(vec3(mod(floor(uv.x * 4.0), 2.0)), 1.0); }"
    texture = cc.RenderTexture(cc.Scene(), FLAT, size=(12, 12), effects=[cc.ImageEffect(checks)])
    got = draw(renderer, screen(texture))
    want = np.arange(12) // 3 % 2
    assert_identical(got[..., 0], np.broadcast_to(want.astype(np.float32), (12, 12)).copy())


def test_mipmaps_are_made_of_the_finished_picture(renderer):
    ramp = "vec4 effect(vec2 uv) { return vec4(uv.x); }"
    texture = cc.RenderTexture(
        cc.Scene(),
        FLAT,
        size=(16, 16),
        format="rgba32f",
        mipmaps=True,
        effects=[cc.ImageEffect(ramp)],
    )
    scene = cc.Scene()
    scene.add(QUAD, cc.BasicMaterial(map=texture))
    got = draw(renderer, scene, size=1)
    assert_close(got[0, 0, :3], np.full(3, 0.5), "lookup")


def test_a_shader_material_shows_a_render_texture_of_this_frame(any_path):
    inner = small_scene()
    texture = cc.RenderTexture(inner, FLAT, size=(12, 12), format="rgba32f")
    material = cc.ShaderMaterial(
        "uniform sampler2D t; vec3 shade(Surface s) { return texture(t, s.uv).bgr; }",
        textures={"t": texture},
    )
    scene = cc.Scene()
    scene.add(QUAD, material)
    for step in range(3):
        inner.nodes[0].position = (0.4 - 0.3 * step, -0.3, -1)
        want = draw(any_path, inner)
        got = draw(any_path, scene)
        assert_close(got[..., :3], want[..., 2::-1], "lookup")
    draw(any_path, scene)
    assert any_path.stats.views_drawn == 0


def test_effects_mix_render_textures(renderer):
    left, right = small_scene(), cc.Scene(background=(0.8, 0.1, 0.4, 1))
    textures = {
        name: cc.RenderTexture(scene, FLAT, size=(12, 12), format="rgba32f")
        for name, scene in (("a", left), ("b", right))
    }
    mix = cc.ImageEffect(
        "uniform sampler2D a; uniform sampler2D b; vec4 effect(vec2 uv) {"
        " return uv.x < 0.5 ? texture(a, uv) : texture(b, uv); }",
        textures=textures,
    )
    got = draw(renderer, cc.Scene(), effects=[mix])
    want = np.where(np.arange(12)[None, :, None] < 6, draw(renderer, left), draw(renderer, right))
    assert_close(got, want, "lookup")
    right.background = (0, 1, 0, 1)
    assert (draw(renderer, cc.Scene(), effects=[mix])[:, 6:] == (0, 1, 0, 1)).all()


def test_a_pass_over_another_texture(renderer):
    source = cc.RenderTexture(small_scene(), FLAT, size=(12, 12), format="rgba32f")
    invert = cc.ImageEffect(
        "uniform sampler2D t; vec4 effect(vec2 uv) { return vec4(1.0 - texture(t, uv).rgb, 1.0); }",
        textures={"t": source},
    )
    second = cc.RenderTexture(cc.Scene(), FLAT, size=(12, 12), format="rgba32f", effects=[invert])
    got = draw(renderer, screen(second))
    assert_close(got[..., :3], 1 - draw(renderer, small_scene())[..., :3], "lookup")


def test_changes_anywhere_in_the_chain_redraw(fresh_renderer):
    inner = small_scene()
    source = cc.RenderTexture(inner, FLAT, size=(8, 8))
    effect = cc.ImageEffect(
        "uniform float k = 1.0; uniform sampler2D t; vec3 effect(vec2 uv) { return k * texture(t, uv).rgb; }",
        textures={"t": source},
    )
    scene = screen(cc.RenderTexture(cc.Scene(), FLAT, size=(8, 8), effects=[effect]))

    def drawn():
        draw(fresh_renderer, scene, 8)
        return fresh_renderer.stats.views_drawn, fresh_renderer.stats.textures_updated

    assert drawn() == (3, 2)
    assert drawn() == (0, 0)
    inner.nodes[0].material.color = (0, 1, 0)
    assert drawn() == (3, 2)
    effect.uniforms["k"] = 0.5
    assert drawn() == (2, 1)
    assert drawn() == (0, 0)


def test_circles_through_shaders_and_passes_are_refused_by_name(renderer):
    inner = cc.Scene()
    texture = cc.RenderTexture(inner, FLAT, size=(8, 8), name="hall")
    inner.add(
        QUAD,
        cc.ShaderMaterial(
            "uniform sampler2D t; vec3 shade(Surface s) { return texture(t, s.uv).rgb; }",
            textures={"t": texture},
        ),
    )
    with pytest.raises(ValueError, match='RenderTexture "hall" shows itself: "hall" -> "hall"'):
        draw(renderer, screen(texture))
    mirror = cc.RenderTexture(cc.Scene(), FLAT, size=(8, 8), name="one")
    other = cc.RenderTexture(screen(mirror), FLAT, size=(8, 8), name="two")
    mirror.effects = [
        cc.ImageEffect(
            "uniform sampler2D t; vec4 effect(vec2 uv) { return texture(t, uv); }",
            textures={"t": other},
        )
    ]
    with pytest.raises(ValueError, match=r'"one" -> "two" -> "one"|"two" -> "one" -> "two"'):
        draw(renderer, screen(other))
    assert draw(renderer, small_scene()).max() == 1


def test_a_texture_in_its_own_scenes_shader_is_freed():
    alive = []
    for _ in range(60):
        inner = cc.Scene()
        texture = cc.RenderTexture(inner, FLAT, size=(8, 8))
        inner.add(
            QUAD,
            cc.ShaderMaterial(
                "uniform sampler2D t; vec3 shade(Surface s) { return texture(t, s.uv).rgb; }",
                textures={"t": texture},
            ),
        )
        alive.append(weakref.ref(texture))
    del inner, texture
    gc.collect()
    assert sum(ref() is not None for ref in alive) < 40


def test_they_pickle():
    effect = cc.ImageEffect(DOUBLE)
    texture = cc.RenderTexture(small_scene(), FLAT, size=(8, 8), effects=[effect])
    copied, same = pickle.loads(pickle.dumps((texture, effect)))
    assert copied.effects == (same,)
    assert copied.scene.nodes[0].id == 1


def test_errors():
    with pytest.raises(TypeError, match="effects: expected a sequence of ImageEffects"):
        cc.RenderTexture(cc.Scene(), FLAT, effects=3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="effects: expected ImageEffects, got str"):
        cc.RenderTexture(cc.Scene(), FLAT, effects=["x"])  # type: ignore[list-item]
