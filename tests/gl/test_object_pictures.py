"""What notebooks and terminals show of objects: valid, escaped, true, bounded, without effects."""

import base64
import io
import pickle
import sys
import threading
import time
from html.parser import HTMLParser

import numpy as np
import PIL.Image
import pytest
import rich.pretty
from rich.console import Console

import cubecam as cc
from cubecam import _core
from cubecam.pictures import describe, objects, rich_text, scenes, studio
from cubecam.pictures.cards import Shot
from tests.gl.full_world import full_world
from tests.helpers import run_python

VOID = {"img", "br", "hr"}
EVIL = '<script>alert("x")</script>&\'[red]'


class Page(HTMLParser):
    """Reads a page, and fails where it is not balanced or could run or load anything."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.text: list[str] = []
        self.pictures: list[np.ndarray] = []
        self.tags: list[str] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        assert tag not in {"script", "style", "link", "iframe", "object", "embed"}
        names = [name for name, _ in attrs]
        assert len(set(names)) == len(names)
        assert not [name for name in names if name.startswith("on") or name in ("class", "href")]
        self.tags.append(tag)
        if tag == "img":
            self.pictures.append(picture(dict(attrs)["src"]))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def picture(source):
    head, _, data = source.partition(",")
    assert head == "data:image/png;base64"
    with PIL.Image.open(io.BytesIO(base64.b64decode(data, validate=True))) as read:
        return np.asarray(read.convert("RGBA"))


def page(thing):
    return Page(thing._repr_html_())


def words(thing):
    return " ".join(page(thing).text)


def printed(thing, width=100, **options):
    text = io.StringIO()
    Console(width=width, file=text, **options).print(thing)
    return text.getvalue()


@pytest.fixture(scope="module")
def world():
    return full_world(np.random.default_rng(7))


def instances(world, renderer):
    """At least one object of every class that has a card."""
    camera = cc.PerspectiveCamera(fov=45, position=(3, 2, 5), target=(0, 0, 0))
    found = [
        thing for kind in (cc.Scene, cc.Node, cc.Mesh, cc.Material) for thing in world.things(kind)
    ]
    found += [
        *world.things(cc.Light),
        *world.textures,
        *world.probes,
        *world.mirrors,
        *world.blends,
        *world.grids,
        *world.effects,
    ]
    found += [
        *world.cameras,
        world.stereo,
        camera,
        cc.Animation([]),
        cc.Shadow(),
        cc.Blend("one", "zero"),
        cc.Stencil(),
        cc.Texture(np.zeros((1, 2, 3), np.uint8)),
    ]
    return [
        *found,
        renderer,
        renderer.info,
        renderer.info.limits,
        renderer.stats,
        renderer.info.device,
    ]


def described():
    """Every class of the core that has a card, except those of which there are no objects."""
    kinds = [thing for thing in vars(_core).values() if isinstance(thing, type)]
    return {
        kind
        for kind in kinds
        if hasattr(kind, "_repr_html_") and kind not in (cc.Material, cc.Light)
    }


def test_every_class_gives_valid_html_and_text(world, renderer):
    things = instances(world, renderer)
    assert {type(thing) for thing in things} == described()
    assert len(described()) >= 25
    for thing in things:
        text = words(thing)
        assert type(thing).__name__ in text
        assert type(thing).__name__ in printed(thing)


def test_every_material_light_and_camera_is_described(world):
    """A class that the core gets later inherits its card."""
    for base in (cc.Material, cc.Light, cc.Camera):
        assert base.__subclasses__()
        for kind in base.__subclasses__():
            assert "_repr_html_" not in vars(kind)
            assert kind._repr_html_ is base._repr_html_


def test_names_and_sources_are_escaped():
    scene = cc.Scene()
    texture = cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), name=EVIL)
    node = scene.add(cc.Mesh.box(), cc.PhongMaterial(), name=EVIL)
    bad = cc.ShaderMaterial("shade " + EVIL)
    scene.add(cc.Mesh.box(), bad)
    for thing in (scene, node, texture, bad):
        assert "<script" not in thing._repr_html_()
        assert EVIL in words(thing)
        assert EVIL in printed(thing, width=200).replace("\n", " ")


# The numbers in pictures


def pixels_of(shot):
    assert shot.problem == ""
    return shot.pixels


def ball_of(material):
    return pixels_of(studio.draw_ball(material))


def middle(pixels):
    return pixels[44:52, 44:52, :3].reshape(-1, 3)


@pytest.mark.parametrize("color", [(255, 99, 71), (12, 200, 30), (255, 255, 255)])
def test_a_basic_ball_has_the_material_s_color(color):
    css = "#{:02x}{:02x}{:02x}".format(*color)
    material = cc.BasicMaterial(color=css)
    assert (middle(ball_of(material)) == color).all()
    (shown,) = page(material).pictures
    assert (middle(shown) == color).all()
    assert css in material._repr_html_()  # the swatch


def test_a_picture_s_numbers_stay_as_they_are():
    """An unlit uint8 picture is sRGB-encoded already, and a float picture is light."""
    encoded = cc.BasicMaterial(map=np.full((4, 4, 3), (120, 40, 200), np.uint8))
    assert np.abs(middle(ball_of(encoded)).astype(int) - (120, 40, 200)).max() <= 1
    light = cc.BasicMaterial(map=np.full((4, 4, 3), 0.25, np.float32))
    assert np.abs(middle(ball_of(light)).astype(int) - 137).max() <= 1  # sRGB of 0.25
    corners = [ball_of(material)[:8, :8].astype(int) for material in (encoded, light)]
    assert np.abs(corners[0] - corners[1]).max() <= 2  # the wall looks the same in both


def test_a_mirror_ball_shows_the_studio():
    """Each pixel of the ball, computed in numpy: the ray, the point, the reflection, the cube's texel, the curve."""
    size = studio.BALL
    eye = np.array([0, 0.45, 2.11])
    forward = -eye / np.linalg.norm(eye)
    right = np.cross(forward, (0, 1, 0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    steps = ((np.arange(size) + 0.5) / size * 2 - 1) * np.tan(np.radians(14))
    rays = forward + steps[None, :, None] * right - steps[:, None, None] * up
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    along = rays @ eye
    root = along**2 - (eye @ eye - 0.25)
    hit = root > 0.06  # away from the silhouette
    points = eye + (-along - np.sqrt(np.maximum(root, 0)))[..., None] * rays
    normals = points / 0.5
    reflected = rays - 2 * (rays * normals).sum(-1, keepdims=True) * normals
    tint = np.array([0.9, 0.6, 0.3])
    light = studio._surroundings().sample(reflected.reshape(-1, 3).astype(np.float32))
    light = light.reshape(size, size, -1)[..., :3] * tint
    want = cc.to_screen(light.astype(np.float32)).astype(int)
    got = ball_of(cc.MirrorMaterial(tint=tint))[..., :3].astype(int)
    error = np.abs(got - want)[hit]
    assert hit.sum() > 2500
    assert np.median(error) <= 1
    assert np.percentile(error, 80) <= 8  # the ball has flat triangles, and edges of lamps move


def test_a_mesh_and_a_scene_fill_their_thumbnails():
    shown = pixels_of(studio.draw_mesh(cc.Mesh.box((3000, 3000, 3000)))).astype(int)
    red, blue = shown[..., 0], shown[..., 2]
    clay = blue - red > 15  # the wall is grey
    assert 0.3 < clay.mean() < 0.8
    rows, columns = np.nonzero(clay)
    for side in (rows, columns):  # centred, and near the border in at least one direction
        assert abs(side.min() + side.max() - 95) < 8
    assert min(rows.min(), columns.min()) < 10
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(cc.Mesh.box(2), cc.BasicMaterial(color=(0.1, 0.3, 0.6)), position=(100, 0, 0))
    shown = pixels_of(studio.draw_scene(scene))[..., :3].astype(int)
    want = cc.to_screen(np.array([[0.1, 0.3, 0.6]], np.float32)).astype(int)
    share = (np.abs(shown - want).max(axis=-1) <= 1).mean()
    assert 0.2 < share < 0.8


def test_translucent_materials_show_the_wall():
    opaque, faint = (
        middle(ball_of(cc.BasicMaterial(color="white", opacity=o))).astype(int).mean()
        for o in (1, 0.25)
    )
    wall = studio._wall(encoded=True).pixels[..., 0].mean()
    assert opaque == 255
    assert wall < faint < 180


def test_half_blocks_are_averages():
    pixels = np.zeros((8, 8, 4), np.uint8)
    pixels[..., 3] = 255
    pixels[:4, :, 0] = 100
    pixels[:2, :, 0] = 200
    text = rich_text.half_blocks(Shot(pixels), 2)
    assert text.plain == "▀▀"
    assert str(text.spans[0].style) == "#960000 on #000000"


# Nothing is changed


def test_a_repr_changes_nothing(world, fresh_renderer):
    scene, camera = world.scene, world.cameras[0]
    things = instances(world, fresh_renderer)
    fresh_renderer.render(scene, camera, (24, 20))
    kept = [thing for thing in things if not isinstance(thing, cc.Renderer)]
    kept = [thing for thing in kept if type(thing) not in (_core.Stats, _core.RendererInfo)]
    before = [repr(thing) for thing in kept], pickle.dumps(scene), str(fresh_renderer.stats)
    np.random.seed(5)  # noqa: NPY002 - the old generator is the one that others share
    numbers = pickle.dumps(np.random.get_state())  # noqa: NPY002
    for thing in things:
        thing._repr_html_()
        printed(thing, force_terminal=True, color_system="truecolor")
    assert before == ([repr(t) for t in kept], pickle.dumps(scene), str(fresh_renderer.stats))
    assert pickle.dumps(np.random.get_state()) == numbers  # noqa: NPY002
    fresh_renderer.render(scene, camera, (24, 20))
    stats = fresh_renderer.stats
    assert (stats.views_drawn, stats.probes_updated, stats.textures_updated) == (0, 0, 0)


# Reprs never raise


def test_a_material_that_does_not_compile_shows_why():
    material = cc.ShaderMaterial("vec3 shade(Surface s) { return nothing; }")
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), material, name="broken")
    shown = page(material)
    assert shown.pictures == []
    assert "nothing" in " ".join(shown.text)
    assert "does not compile" in " ".join(shown.text)
    assert "does not compile" in words(scene)
    assert "does not compile" in printed(material, force_terminal=True, color_system="truecolor")


def test_an_error_inside_is_a_line_of_text(monkeypatch):
    def fail(thing):
        raise ValueError("a broken card")

    monkeypatch.setattr(objects, "card_of", fail)
    for text in (words(cc.Mesh.box()), printed(cc.Mesh.box())):
        assert "a broken card" in text
        assert "Mesh(24 vertices, 12 triangles)" in text


def test_empty_things():
    assert "the scene is empty" in words(cc.Scene())
    sky = cc.Scene(background=(0.2, 0.4, 0.9))
    assert len(page(sky).pictures) == 1
    group = cc.Scene().add(name="group")
    assert "none: a group" in words(group)


def test_closed_renderer(new_renderer):
    made = new_renderer()
    made.close()
    assert "closed" in words(made)


def test_a_large_mesh_has_no_picture(monkeypatch):
    monkeypatch.setattr(studio, "_MOST_TRIANGLES", 11)
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), cc.PhongMaterial())
    for thing in (cc.Mesh.box(), scene):
        shown = page(thing)
        assert shown.pictures == [] or thing is scene  # balls of materials are small
        assert "12 triangles take too long" in " ".join(shown.text)


def test_without_opengl_there_is_text():
    run_python(
        """
        import io, cubecam as cc
        from rich.console import Console
        scene = cc.Scene(background="white")
        node = scene.add(cc.Mesh.box(), cc.PhongMaterial(color="red"), name="crate")
        for thing in (scene, node, node.mesh, node.material):
            html = thing._repr_html_()
            assert "<img" not in html, html
            assert "libnone.so" in html, html
            out = io.StringIO()
            Console(file=out, force_terminal=True, color_system="truecolor", width=100).print(thing)
            assert "libnone.so" in out.getvalue() and "▀" not in out.getvalue(), out.getvalue()
        assert "crate" in scene._repr_html_() and "#ff0000" in scene._repr_html_()
        assert "frustum" not in repr(scene)
        """,
        CUBECAM_EGL_LIBRARY="libnone.so",
    )


# One renderer for the process


def test_one_renderer_for_all_threads(monkeypatch):
    made = []

    def make(*args, **options):
        made.append(cc.Renderer(*args, **options))
        time.sleep(0.05)  # a second thread would now find none
        return made[-1]

    materials = [cc.PhongMaterial(color=(i / 16, 0.5, 0.2)) for i in range(16)]
    want = [material._repr_html_() for material in materials]
    fresh = studio._Studio()
    monkeypatch.setattr(studio, "Renderer", make)
    monkeypatch.setattr(studio, "_studio", fresh)
    got = [""] * len(materials)

    def work(first):
        for index in range(first, len(materials), 4):
            got[index] = materials[index]._repr_html_()

    threads = [threading.Thread(target=work, args=(first,)) for first in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert got == want
    assert len(made) == 1
    fresh.close()
    assert made[0].closed
    assert "the process ends" in words(materials[0])


def test_large_probes_are_not_kept(monkeypatch):
    made: list[cc.Renderer] = []

    def make():
        made.append(cc.Renderer())
        return made[-1]

    monkeypatch.setattr(studio, "Renderer", make)
    scene = cc.Scene(background=(0.1, 0.1, 0.1))
    scene.add(cc.Mesh.sphere(), cc.MirrorMaterial(), environment=cc.Probe(size=16))
    want = pixels_of(studio.draw_scene(scene))
    count = len(made)
    monkeypatch.setattr(studio, "_MOST_KEPT", 6 * 16 * 16 - 1)
    assert np.array_equal(pixels_of(studio.draw_scene(scene)), want)
    assert len(made) == count + 1
    assert made[-1].closed


def test_forked_children_show_text_or_pictures():
    run_python(
        """
        import os, signal, sys, threading
        import cubecam as cc
        from cubecam.pictures import studio

        def child(check):
            sys.stdout.flush()
            made = os.fork()
            if made == 0:
                signal.alarm(60)
                try:
                    check()
                except BaseException as error:
                    print(type(error).__name__, error, flush=True)
                    os._exit(1)
                os._exit(0)
            assert os.waitpid(made, 0)[1] == 0

        def shows_a_picture():
            assert "<img" in material._repr_html_()

        def shows_text():
            html = material._repr_html_()
            assert "<img" not in html and "spawn" in html, html

        material = cc.PhongMaterial()
        studio._studio._lock.acquire()  # another thread is making the renderer
        child(shows_a_picture)
        studio._studio._lock.release()
        shows_a_picture()
        child(shows_text)
        shows_a_picture()
        """
    )


# Bounds


def crowd(count, names="node"):
    rng = np.random.default_rng(2)
    scene = cc.Scene(background=cc.CubeMap(rng.random((6, 64, 64, 3), dtype=np.float32)))
    scene.add(cc.DirectionalLight())
    ball = cc.Mesh.sphere(0.4, 16, 8)
    for index in range(count):
        material = cc.PhongMaterial(map=rng.integers(0, 256, (16, 16, 3), dtype=np.uint8))
        scene.add(ball, material, position=(index % 32, 0, index // 32), name=f"{names} {index}")
    return scene


def test_a_thousand_nodes_are_bounded():
    """The worst case: each node has a noisy material of its own and a long name that is all markup."""
    scene = crowd(1000, names="<&>" * 300)
    html = scene._repr_html_()
    assert len(html.encode()) < 200_000
    assert html.count("<img") == scenes.MOST_BALLS + 7  # the scene, and the faces of its background
    text = " ".join(Page(html).text)
    assert "1,000 nodes" in text
    assert "… and 950 more" in text
    assert f"1,000 materials, {scenes.MOST_BALLS} shown" in text
    assert "#50" in text
    assert "#51" not in text
    assert "… and 950 more" in printed(scene)


def test_a_deep_tree_and_many_lights_are_bounded():
    scene = cc.Scene()
    parent = None
    for _ in range(300):
        parent = scene.add(parent=parent)
    for _ in range(100):
        scene.add(cc.PointLight())
    assert len(scene._repr_html_()) < 60_000
    assert "… and 250 more" in words(scene)
    assert "… and 80 more" in words(scene)
    assert "… and 249 more" in words(scene.nodes[0])
    assert "… and 250 more" in printed(scene)


def test_what_is_shared_is_drawn_once(monkeypatch):
    drawn: list[object] = []

    def draw_ball(material, size):
        drawn.append(material)
        return Shot(None)

    def draw_solid(mesh, material, size):
        drawn.append(mesh)
        return Shot(None)

    monkeypatch.setattr(scenes, "draw_ball", draw_ball)
    monkeypatch.setattr(scenes, "draw_solid", draw_solid)
    scene = cc.Scene()
    box, red, blue = cc.Mesh.box(), cc.PhongMaterial(color="red"), cc.PhongMaterial(color="blue")
    for index in range(20):
        scene.add(box, red if index % 2 else blue)
    shown = words(scene)
    assert drawn == [blue, red, box, box]
    assert "2 materials" in shown
    assert shown.count("M2 PhongMaterial") == 10


# Terminals


def test_the_tree_in_a_terminal():
    scene = cc.Scene(background=(1, 1, 1))
    car = scene.add(name="car")
    scene.add(cc.Mesh.box(), cc.PhongMaterial(color="red"), parent=car, name="wheel", visible=False)
    lines = printed(scene).splitlines()
    (at,) = [index for index, line in enumerate(lines) if "#1 car" in line]
    assert lines[at].startswith("└── #1 car")
    assert lines[at + 1].startswith("    └── ● #2 wheel")
    assert lines[at + 1].rstrip().endswith("hidden")


def test_half_blocks_only_where_they_can_be_seen():
    mesh = cc.Mesh.box()
    colors = {"force_terminal": True, "color_system": "truecolor"}
    assert printed(mesh, **colors).count("▀") == 24 * 12
    assert "▀" not in printed(mesh)
    assert "▀" not in printed(mesh, no_color=True, **colors)
    assert "▀" not in printed(mesh, width=40, **colors)


def test_the_prompt_and_lists_and_classes(monkeypatch):
    """rich's prompt shows the card; an object in a list is its repr; a class is its name."""
    text = io.StringIO()
    monkeypatch.setattr(sys, "displayhook", sys.displayhook)
    rich.pretty.install(Console(width=100, file=text))
    sys.displayhook(cc.PhongMaterial(ka=0.3))
    assert "0.3" in text.getvalue()
    assert "shininess" in text.getvalue()
    assert printed([cc.PhongMaterial()]) == "[PhongMaterial()]\n"
    assert printed(cc.Scene) == "<class 'cubecam.Scene'>\n"


def test_units():
    camera = cc.PerspectiveCamera(fov=45, near=0.5, far=20)
    assert "45°" in words(camera)
    assert "0.5 units" in words(camera)
    assert "svg" in page(camera).tags
    light = cc.SpotLight(angle=25, color="skyblue", shadow=True)
    assert "25°" in words(light)
    assert "#87ceeb" in light._repr_html_()
    assert "256 texels" in words(cc.Probe())


def test_every_property_of_a_light_and_a_probe_is_shown():
    scene = cc.Scene()
    node = scene.add()
    for thing in (
        cc.SpotLight(parent=node, range=2),
        cc.PointLight(parent=node, range=2),
        cc.DirectionalLight(parent=node),
        cc.AmbientLight(),
        cc.Probe(),
    ):
        for name in describe._properties(type(thing)):
            assert name.replace("_", " ") in words(thing)


def test_a_scene_of_cameras_animations_and_variants():
    scene = cc.Scene()
    cart = scene.add(cc.Mesh.box(), cc.PhongMaterial(name="oak"), name="cart")
    scene.add(cc.PerspectiveCamera(fov=40, parent=cart))
    scene.add(cc.Camera(view=np.eye(4), projection=np.eye(4)))
    scene.add(cc.PointLight(range=3, parent=cart))
    roll = cc.AnimationChannel(cart, "translation", [0, 2], np.eye(3)[:2], interpolation="step")
    scene.add(cc.Animation([roll], name="roll"))
    scene.variants = ["red", "blue"]
    scene.variant = "red"
    text = words(scene)
    for part in (
        "2 cameras",
        "fov 40°, position (0, 0, 0), on node #1 cart",
        "given by its matrices",
        "range 3, on node #1 cart",
        "1 animation",
        "2 s, 1 channel of 1 node",
        "red, blue; shown: red",
        "M1 oak",
    ):
        assert part in text, part
    assert "translation, 2 keys, step" in words(scene.animations[0])
    assert "world position" not in words(cc.PointLight())
    assert "world position" in words(scene.lights[0])
