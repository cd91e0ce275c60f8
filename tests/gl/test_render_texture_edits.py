"""Render textures under random edits: incremental equals from scratch, bit for bit, errors included."""

import copy

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.conftest import DEVICE
from tests.gl import test_incremental as incremental
from tests.gl.flat import quad

STEPS = 8


def textured_scene(rng):
    """The scene of test_incremental with three screens: a texture of a scene with a mirror, one that shows that one,
    and a monitor that shows the room without itself."""
    scene = incremental.probed_scene(rng)
    far = cc.Scene(background=rng.random(3))
    far.add(cc.PointLight(position=(2, 4, 1)))
    far.add(cc.Mesh.box(0.6), cc.PhongMaterial(color=rng.random(3)), position=(0.7, 0, 0))
    ball = far.add(cc.Mesh.sphere(0.4, segments=12, rings=6), cc.MirrorMaterial())
    ball.environment = cc.Probe(parent=ball, size=8, format="rgba32f")
    lens = cc.PerspectiveCamera(fov=50, position=(0.5, 0.6, 2), target=(0, 0, 0))
    inner = cc.RenderTexture(far, lens, size=(12, 9), format="rgba16f", mipmaps=True, name="inner")

    near = cc.Scene(background=(0.2, 0.2, 0.2, 0.5))
    near.add(quad(), cc.BasicMaterial(map=inner), position=(-0.6, -0.4, 0))
    near.add(cc.Mesh.box(0.3), cc.BasicMaterial(color=rng.random(3)), position=(0.5, 0.5, 0))
    outer = cc.RenderTexture(near, lens, size=(16, 16), samples=4, name="outer")

    room = cc.PerspectiveCamera(fov=70, position=(2, 2, 2), target=(0, 0, 0))
    monitor = cc.RenderTexture(scene, room, size=(16, 12), format="rgba32f", name="monitor")
    for index, texture in enumerate((inner, outer, monitor)):
        screen = scene.add(
            quad(1.5, 1.5),
            cc.BasicMaterial(map=texture, double_sided=True),
            position=(0.8 * index - 1.5, 0.3 * index - 0.5, 1 - index),
            rotation=cc.axis_angle((0, 1, 0), 30 * index),
            name=f"screen{index}",
            in_captures=texture is not monitor,
        )
    monitor.exclude = [screen]
    return scene


def textures(scene):
    """What the screens show, by name, whether they stand in the scene or not any more."""
    found = {}
    for node in scene.nodes:
        texture = getattr(node.material, "map", None)
        if isinstance(texture, cc.RenderTexture) and texture.name not in found:
            found[texture.name] = texture
            if texture.scene is not scene:
                found |= textures(texture.scene)
    return found


def pick(scene, rng):
    return list(textures(scene).values())[rng.integers(len(textures(scene)))]


def edit_inside(scene, rng):
    """A thing in a texture's own scene."""
    nodes = pick(scene, rng).scene.nodes
    node = nodes[rng.integers(len(nodes))]
    node.position = np.array(node.position) + rng.uniform(-0.3, 0.3, 3)


def edit_inner_background(scene, rng):
    texture = pick(scene, rng)
    if texture.scene is not scene:
        texture.scene.background = rng.random(3)


def edit_lens(scene, rng):
    pick(scene, rng).camera.fov = rng.uniform(40, 80)


def edit_size(scene, rng):
    pick(scene, rng).size = tuple(rng.integers(6, 20, 2).tolist())


def edit_quality(scene, rng):
    texture = pick(scene, rng)
    texture.samples = int(rng.choice([1, 4]))
    texture.mipmaps = bool(rng.integers(2))
    texture.wrap = str(rng.choice(["clamp", "repeat"]))
    texture.format = str(rng.choice(["rgba8", "rgba16f", "rgba32f"]))


def edit_exclude_inside(scene, rng):
    texture = pick(scene, rng)
    if texture.scene is not scene:
        texture.exclude = [texture.scene.nodes[rng.integers(len(texture.scene.nodes))]]


def edit_screens(scene, rng):
    """One screen shows what another shows: now and then the monitor, seen by probes, which is an error."""
    screens = [node for node in scene.nodes if node.name.startswith("screen")]
    a, b = rng.choice(len(screens), 2, replace=False)
    screens[a].material = screens[b].material


EDITS = [value for name, value in sorted(globals().items()) if name.startswith("edit_")]


def pictures(renderer, scene, view):
    """Frame, capture and every texture that was drawn, or what the renderer refuses."""
    try:
        return incremental.pictures(renderer, scene, view)
    except ValueError as error:
        return str(error)


def check(got, want, what):
    if isinstance(want, str):
        assert got == want, what
        return
    for index, (a, b) in enumerate(zip(got, want, strict=True)):
        assert_identical(a, b, f"{what}, picture {index}")


@pytest.mark.parametrize("seed", range(6))
def test_random_edits(new_renderer, seed):
    rng = np.random.default_rng(seed)
    scene = textured_scene(rng)
    live = new_renderer()
    script = []
    for step in range(STEPS):
        for _ in range(rng.integers(0, 3)):
            edits = EDITS if rng.random() < 0.7 else incremental.EDITS
            edit = edits[rng.integers(len(edits))]
            script.append(edit.__name__)
            edit(scene, rng)
        view = ((3, 1, 2), (-1, 2, 3))[rng.integers(2)]
        got = pictures(live, scene, view)
        with cc.Renderer(device=DEVICE) as scratch:
            want = pictures(scratch, scene, view)
        check(got, want, f"step {step} after {script}")


@pytest.mark.parametrize("edit", EDITS, ids=[edit.__name__[5:] for edit in EDITS])
def test_each_edit_alone(new_renderer, edit):
    rng = np.random.default_rng(21)
    scene = textured_scene(rng)
    live, scratch = new_renderer(), new_renderer()
    assert not isinstance(pictures(live, scene, (3, 1, 2)), str)
    edit(scene, rng)
    check(pictures(live, scene, (3, 1, 2)), pictures(scratch, scene, (3, 1, 2)), edit.__name__)
    for name, texture in textures(scene).items():
        try:
            want = scratch.read_texture(texture)
        except ValueError:  # not in view
            continue
        assert_identical(live.read_texture(texture), want, name)


def test_unchanged_it_draws_nothing(any_path):
    scene = textured_scene(np.random.default_rng(22))
    first = pictures(any_path, scene, (3, 1, 2))
    camera = cc.PerspectiveCamera(fov=65, position=(3, 1, 2), target=(0, 0, 0))
    any_path.render(scene, camera, (24, 20), format="rgba32f", outputs=("id",))
    assert any_path.stats.views_drawn == 0
    check(pictures(any_path, scene, (3, 1, 2)), first, "again")


def test_layered_equals_one_pass(shared_renderers):
    scene = textured_scene(np.random.default_rng(23))
    check(
        pictures(shared_renderers(None), scene, (3, 1, 2)),
        pictures(shared_renderers(False), scene, (3, 1, 2)),
        "one pass",
    )


def test_a_twin_draws_the_same(new_renderer):
    scene = textured_scene(np.random.default_rng(24))
    twin = copy.deepcopy(scene)
    assert set(textures(twin)) == {"inner", "outer", "monitor"}
    assert textures(twin)["monitor"].scene is twin
    check(
        pictures(new_renderer(), scene, (3, 1, 2)),
        pictures(new_renderer(), twin, (3, 1, 2)),
        "twin",
    )
