"""Render textures that show themselves raise an error with their name, and the renderer stays usable."""

import itertools
import re
import threading
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.flat import flat_camera, flat_texture, look, quad, random_picture, screen_scene

PICTURE = random_picture(1)
OUT = "; leave the nodes that show it out with exclude="


def empty(name=""):
    """A texture of an empty scene."""
    return cc.RenderTexture(cc.Scene(), flat_camera(9, 6), size=(9, 6), format="rgba32f", name=name)


def show(texture, scene, **place):
    """Put a screen into a scene."""
    return scene.add(quad(9, 6), cc.BasicMaterial(map=texture), **place)


def refused(renderer, text, draw):
    """Check that the message is `text` and that the renderer draws other scenes as before."""
    with pytest.raises(ValueError, match="shows itself") as error:
        draw()
    assert str(error.value) == text + OUT
    assert_close(look(renderer, screen_scene(flat_texture(PICTURE))[0])[..., :3], PICTURE, "lookup")


def test_directly(any_path):
    a = empty("a")
    node = show(a, a.scene)
    refused(any_path, 'RenderTexture "a" shows itself: "a" -> "a"', lambda: look(any_path, a.scene))
    a.exclude = [node]
    look(any_path, a.scene)
    assert any_path.stats.textures_updated == 1


def test_without_a_name(renderer):
    a = empty()
    show(a, a.scene)
    refused(
        renderer,
        "RenderTexture 1 shows itself: RenderTexture 1 -> RenderTexture 1",
        lambda: look(renderer, a.scene),
    )


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_by_way_of_others(renderer, order):
    """The chain in the message starts with the texture that is shown first."""
    textures = [empty("a"), empty(), empty("c")]
    for index in order:
        show(textures[(index + 1) % 3], textures[index].scene)
    names = ['"a"', "RenderTexture 2", '"c"']
    scene, node = screen_scene(textures[0])
    refused(
        renderer,
        f'RenderTexture "a" shows itself: {" -> ".join([*names, names[0]])}',
        lambda: look(renderer, scene),
    )
    textures[2].exclude = textures[2].scene.nodes
    look(renderer, scene)
    assert renderer.stats.textures_updated == 3
    assert node.visible


def test_nothing_is_drawn_before_it_is_refused(renderer):
    a, fine = empty("a"), flat_texture(PICTURE)
    show(fine, a.scene)
    show(a, a.scene, position=(0, 0, 1))
    refused(renderer, 'RenderTexture "a" shows itself: "a" -> "a"', lambda: look(renderer, a.scene))
    with pytest.raises(ValueError, match="one that this renderer has drawn"):
        renderer.read_texture(fine)


def test_the_chain_is_the_shortest(renderer):
    a, b, c = empty("a"), empty("b"), empty("c")
    for texture, shown in ((a, b), (b, c), (c, a), (a, c)):
        show(shown, texture.scene)
    scene, _ = screen_scene(a)
    refused(
        renderer,
        'RenderTexture "a" shows itself: "a" -> "c" -> "a"',
        lambda: look(renderer, scene),
    )


def test_a_texture_beside_the_circle_is_not_blamed(renderer):
    a, b = empty("a"), empty("b")
    show(b, a.scene)
    show(b, b.scene)
    scene, _ = screen_scene(a)
    refused(renderer, 'RenderTexture "b" shows itself: "b" -> "b"', lambda: look(renderer, scene))


def by_probe():
    """The texture's room holds a mirror whose probe sees the screen."""
    a = empty("a")
    screen = show(a, a.scene)
    a.exclude = [screen]
    ball = a.scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(4, 3, 2))
    ball.environment = cc.Probe(parent=ball, size=8)
    text = 'RenderTexture "a" shows itself: "a" -> the probe of node 2 -> "a"'
    return a, screen, ball, text


def test_by_way_of_a_probe(renderer):
    a, screen, ball, text = by_probe()
    refused(renderer, text, lambda: look(renderer, a.scene))
    refused(renderer, text, lambda: renderer.capture(a.scene, size=8))
    refused(renderer, text, lambda: renderer.update_probes(a.scene))
    refused(renderer, text, lambda: renderer.update_probes(a.scene, probes=ball.environment))
    ball.environment.exclude = [screen]
    look(renderer, a.scene)
    ball.environment.exclude = []
    screen.in_captures = False
    look(renderer, a.scene)
    assert renderer.stats.textures_updated == 0
    screen.in_captures = True
    a.exclude = [screen, ball]
    look(renderer, a.scene)
    assert (renderer.stats.textures_updated, renderer.stats.probes_updated) == (1, 1)


@pytest.mark.parametrize("update", ["on_change", "once", "manual", 3])
def test_whatever_the_probe_is_due(renderer, update):
    """The error must not depend on the number of frames drawn."""
    a, _, ball, text = by_probe()
    ball.environment.update = update
    for _ in range(2):
        refused(renderer, text, lambda: look(renderer, a.scene))


def test_by_way_of_probes_that_see_each_other(renderer):
    a, screen, ball, _ = by_probe()
    ball.environment.exclude = [screen]
    other = a.scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(6, 3, 2))
    other.environment = cc.Probe(parent=other, size=8)
    refused(
        renderer,
        'RenderTexture "a" shows itself: "a" -> the probe of node 3 -> "a"',
        lambda: look(renderer, a.scene),
    )
    other.environment.exclude = [screen]
    look(renderer, a.scene)
    assert renderer.stats.probes_updated == 2


def test_by_way_of_a_probe_in_another_scene(renderer):
    a, b = empty("a"), empty("b")
    show(b, a.scene)
    show(a, b.scene, in_captures=True)
    b.exclude = b.scene.nodes
    shown = b.scene.add(
        cc.Mesh.box(1), cc.BasicMaterial(cubemap=cc.Probe(size=8)), position=(3, 3, 0)
    )
    scene, _ = screen_scene(a)
    refused(
        renderer,
        'RenderTexture "a" shows itself: "a" -> "b" -> the probe of node 2 -> "a"',
        lambda: look(renderer, scene),
    )
    shown.visible = False
    look(renderer, scene)


def test_captures_refuse_what_they_see(renderer):
    a = empty("a")
    node = show(a, a.scene)
    text = 'RenderTexture "a" shows itself: "a" -> "a"'
    refused(renderer, text, lambda: renderer.capture(a.scene, size=8))
    renderer.capture(a.scene, size=8, exclude=[node])
    node.in_captures = False
    renderer.capture(a.scene, size=8)


def test_turning_the_camera_makes_no_error_appear_or_go(renderer):
    a = empty("a")
    node = show(a, a.scene, position=(0, 0, 50))  # the node is behind every camera
    text = 'RenderTexture "a" shows itself: "a" -> "a"'
    refused(renderer, text, lambda: look(renderer, a.scene))
    node.position = (0, 0, 0)
    a.camera.position = (4.5, 3, -5)
    a.camera.target = (4.5, 3, -6)  # the texture's own camera looks away
    refused(renderer, text, lambda: look(renderer, a.scene))
    node.visible = False
    look(renderer, a.scene)


def test_what_no_picture_of_the_call_may_lead_to_is_no_error(renderer):
    """The circle is in a scene that only an excluded node shows."""
    a, b = empty("a"), empty("b")
    show(b, b.scene)
    a.exclude = [show(b, a.scene)]
    scene, _ = screen_scene(a)
    look(renderer, scene)
    assert renderer.stats.textures_updated == 1


def test_long_chains_are_cut(renderer):
    textures = [empty(f"t{index}") for index in range(400)]
    for texture, shown in itertools.pairwise([*textures, textures[0]]):
        show(shown, texture.scene)
    with pytest.raises(ValueError, match=re.escape('"t11" -> 388 more -> "t0"')) as error:
        look(renderer, screen_scene(textures[0])[0])
    assert len(str(error.value)) < 300


def test_two_textures_of_one_room_leave_each_other_out(renderer, new_renderer):
    """Of two monitors the left one shows the room with the right one; the right one shows the room alone."""
    room = cc.Scene(background=(0.2, 0, 0))
    left, right = (
        cc.RenderTexture(room, flat_camera(9, 6), size=(9, 6), format="rgba32f", name=name)
        for name in ("left", "right")
    )
    room.add(quad(2, 2), cc.BasicMaterial(color=(0, 1, 0)), position=(6, 4, -1))
    a = room.add(quad(4, 3), cc.BasicMaterial(map=left))
    b = room.add(quad(4, 3), cc.BasicMaterial(map=right), position=(5, 0, 0))
    left.exclude = [a]
    for exclude in ([], [b]):
        right.exclude = exclude
        with pytest.raises(ValueError, match='"left" shows itself: "left" -> "right" -> "left"'):
            look(renderer, room)
    right.exclude = [a]
    with pytest.raises(ValueError, match='"right" shows itself: "right" -> "right"'):
        look(renderer, room)
    right.exclude = [a, b]
    color = look(renderer, room)
    assert renderer.stats.textures_updated == 2
    assert_identical(color, look(new_renderer(), room))
    background = np.array([0.2, 0, 0], np.float32)
    assert (renderer.read_texture(right)[..., :3] == background).all(-1).sum() == 54 - 4
    # The left picture shows the green itself and, smaller, the green on the right monitor.
    assert (renderer.read_texture(left)[..., :3] != background).any(-1).sum() > 4


def test_two_scenes_that_show_each_other_on_two_threads(new_renderer):
    """The scenes are edited, drawn and refused at the same time, and no thread waits for ever."""
    a, b = empty("a"), empty("b")
    show(b, a.scene)
    node = show(a, b.scene)
    stop = threading.Event()
    outcomes: dict[Any, Any] = {}

    def draw(scene, renderer):
        seen = outcomes.setdefault(threading.get_ident(), set())
        for step in range(40):
            try:
                look(renderer, scene)
                seen.add("drawn")
            except ValueError as error:
                assert "shows itself" in str(error)  # noqa: PT017
                seen.add("refused")
            scene.nodes[0].position = (0, 0, -0.1 * (step % 3))

    def edit():
        while not stop.is_set():
            node.visible = not node.visible
            b.exclude = [node] if node.visible else []
            a.scene.background = np.random.default_rng().random(3)

    threads = [
        threading.Thread(target=draw, args=(texture.scene, new_renderer()), daemon=True)
        for texture in (a, b)
    ]
    editor = threading.Thread(target=edit, daemon=True)
    for thread in (*threads, editor):
        thread.start()
    for thread in threads:
        thread.join(timeout=120)
        assert not thread.is_alive()
    stop.set()
    editor.join()
    node.visible, b.exclude = True, []
    renderer = new_renderer()
    for scene in (a.scene, b.scene):
        with pytest.raises(ValueError, match="shows itself"):
            look(renderer, scene)


def test_each_scene_is_seen_at_one_moment(new_renderer):
    """A box that two textures of one scene and the frame show has one place in all three pictures."""
    inner_scene = cc.Scene(background=(0, 0, 0, 1))
    box = inner_scene.add(quad(), cc.BasicMaterial())
    textures = [
        cc.RenderTexture(inner_scene, flat_camera(9, 1), size=(9, 1), format="rgba32f")
        for _ in range(2)
    ]
    scene = cc.Scene()
    for row, texture in enumerate(textures):
        scene.add(quad(9, 1), cc.BasicMaterial(map=texture), position=(0, row, 0))
    renderer = new_renderer()
    stop = threading.Event()

    def edit():
        step = 0
        while not stop.is_set():
            step += 1
            box.position = (step % 9, 0, 0)

    thread = threading.Thread(target=edit)
    thread.start()
    try:
        for _ in range(60):
            color = look(renderer, scene, 9, 2)
            assert_identical(color[0], color[1])
            assert color[0, :, 0].sum() == pytest.approx(1)
    finally:
        stop.set()
        thread.join()


MOVED = """uniform sampler2D t;
void vertex(inout Vertex v) { v.position.x += textureLod(t, vec2(0.5), 0.0).r; }"""
MOVED_BY_CUBE = """uniform samplerCube t;
void vertex(inout Vertex v) { v.position.x += textureLod(t, v.position, 0.0).r; }"""
SHADE = "vec3 shade(Surface s) { return vec3(0.5); }"
BY_SHADOW = OUT + ", those that cast by it with cast_shadow=False"


def lamp_and_floor():
    """A scene in which shadows fall, and a texture that looks at it from above."""
    scene = cc.Scene()
    scene.add(cc.PointLight((0, 3, 0), shadow=cc.Shadow(size=32)))
    floor = scene.add(cc.Mesh.plane(6, 6), cc.PhongMaterial(ks=0), position=(0, -1, 0))
    eye = cc.PerspectiveCamera(position=(0, 5, 0.01), target=(0, 0, 0))
    return scene, floor, cc.RenderTexture(scene, eye, size=(8, 8), format="rgba32f", name="above")


def from_aside(renderer, scene):
    camera = cc.PerspectiveCamera(position=(2, 3, 4), target=(0, 0, 0))
    return renderer.render(scene, camera, (32, 32), format="rgba32f").color


def test_by_the_shadow_of_what_it_moves(any_path):
    """An excluded node still casts a shadow, so this is a circle unless nothing casts or receives shadows."""
    scene, floor, above = lamp_and_floor()
    box = scene.add(cc.Mesh.box(0.8), cc.ShaderMaterial(SHADE, vertex=MOVED, textures={"t": above}))
    above.exclude = [box]
    text = 'RenderTexture "above" shows itself: "above" -> "above"' + BY_SHADOW
    with pytest.raises(ValueError, match="shows itself") as error:
        from_aside(any_path, scene)
    assert str(error.value) == text
    box.cast_shadow = False
    first = from_aside(any_path, scene)
    assert_identical(from_aside(any_path, scene), first)
    assert (any_path.stats.views_drawn, any_path.stats.textures_updated) == (0, 0)
    box.cast_shadow, floor.receive_shadow = True, False
    from_aside(any_path, scene)
    from_aside(any_path, scene)
    assert (any_path.stats.views_drawn, any_path.stats.textures_updated) == (0, 0)


def test_a_probe_by_the_shadow_of_what_it_moves(renderer):
    scene, _, _ = lamp_and_floor()
    probe = cc.Probe(position=(0, 1, 0), size=8)
    box = scene.add(
        cc.Mesh.box(0.8), cc.ShaderMaterial(SHADE, vertex=MOVED_BY_CUBE, textures={"t": probe})
    )
    way = f"the probe of node {box.id}"
    with pytest.raises(ValueError, match="shows itself") as error:
        from_aside(renderer, scene)
    assert str(error.value) == f"{way} shows itself: {way} -> {way}" + BY_SHADOW


@pytest.mark.parametrize("kind", ["sampler2D", "samplerCube"])
def test_what_only_colors_a_moved_caster_is_no_circle(any_path, kind):
    """Waves that mirror a scene with shadows: the shadow depends only on the vertices, so drawing comes to an end."""
    scene, _, above = lamp_and_floor()
    source = above if kind == "sampler2D" else cc.Probe(position=(0, 1, 0), size=8)
    coordinate = "s.uv" if kind == "sampler2D" else "s.normal"
    fragment = f"uniform {kind} t; vec3 shade(Surface s) {{ return texture(t, {coordinate}).rgb; }}"
    wave = "void vertex(inout Vertex v) { v.position.y += 0.1; }"
    box = scene.add(
        cc.Mesh.box(0.8), cc.ShaderMaterial(fragment, vertex=wave, textures={"t": source})
    )
    above.exclude = [box]
    first = from_aside(any_path, scene)
    assert_identical(from_aside(any_path, scene), first)
    stats = any_path.stats
    assert (stats.views_drawn, stats.shadow_views_drawn, stats.probes_updated) == (0, 0, 0)
