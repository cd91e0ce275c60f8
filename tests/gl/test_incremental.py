"""The promise of on_change: incremental equals from scratch, bit for bit, under random edits."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.conftest import DEVICE

STEPS = 8


def probed_scene(rng):
    """Boxes; two balls with probes, one seen by the other's; two mirrors in a cycle; a box that shows a probe."""
    scene = cc.Scene(environment=cc.CubeMap(rng.random((6, 4, 4, 3)).astype(np.float32)))
    scene.add(cc.PointLight(position=(2, 4, 1)))
    group = scene.add(position=(0, 0, 0), name="group")
    for index in range(5):
        scene.add(
            cc.Mesh.box(rng.uniform(0.3, 0.8, 3)),
            cc.PhongMaterial(color=rng.random(3))
            if index % 2
            else cc.BasicMaterial(color=rng.random(3)),
            position=rng.uniform(-2, 2, 3),
            parent=group if index < 2 else None,
        )
    sphere = cc.Mesh.sphere(0.3, segments=16, rings=8)
    balls = [
        scene.add(sphere, cc.MirrorMaterial(env_weight=0.9), position=place, name=f"ball{index}")
        for index, place in enumerate([(0, 0, 0), (1, 0.3, 0.5), (-1, 0, 1), (-1, 0.2, -1)])
    ]
    for ball in balls:
        ball.environment = cc.Probe(position=ball.position, size=12, format="rgba32f")
    balls[2].environment.parent, balls[3].environment.parent = balls[2], balls[3]
    balls[2].environment.position = balls[3].environment.position = (0, 0, 0)
    scene.add(
        cc.Mesh.box(0.5),
        cc.BasicMaterial(cubemap=balls[1].environment),
        position=(0.5, -0.7, 1.2),
        name="shown",
    )
    return scene


def shadowed_scene(rng):
    """The same under lights with shadows, so that what moves changes what it does not touch."""
    scene = probed_scene(rng)
    scene.add(cc.Mesh.plane(6, 5), cc.PhongMaterial(), position=(0, -1.5, 0), name="floor")
    scene.lights[0].shadow = cc.Shadow(size=24)
    scene.add(cc.DirectionalLight((-1, -2, 0.4), intensity=0.4, shadow=cc.Shadow(size=32)))
    scene.add(cc.SpotLight((2, 3, 2), (-2, -3, -2), angle=50, shadow=cc.Shadow(size=32, radius=0)))
    return scene


SCENES = {"probed": probed_scene, "shadowed": shadowed_scene}


def edit_move(scene, rng):
    node = scene.nodes[rng.integers(len(scene.nodes))]
    node.position = np.array(node.position) + rng.uniform(-0.5, 0.5, 3)


def edit_turn(scene, rng):
    node = scene.nodes[rng.integers(len(scene.nodes))]
    node.rotation = cc.axis_angle(rng.normal(size=3), rng.uniform(0, 360))


def edit_scale(scene, rng):
    scene.nodes[rng.integers(len(scene.nodes))].scale = rng.choice([-1, 1]) * rng.uniform(0.5, 1.5)


def edit_color(scene, rng):
    material = scene.nodes[rng.integers(1, 6)].material
    name = "tint" if isinstance(material, cc.GlassMaterial) else "color"
    setattr(material, name, rng.random(3))


def edit_opacity(scene, rng):
    scene.nodes[rng.integers(1, 6)].material.opacity = rng.choice([0.3, 0.7, 1])


def edit_visible(scene, rng):
    node = scene.nodes[rng.integers(len(scene.nodes))]
    node.visible = not node.visible


def edit_in_captures(scene, rng):
    node = scene.nodes[rng.integers(len(scene.nodes))]
    node.in_captures = not node.in_captures


def edit_material(scene, rng):
    scene.nodes[rng.integers(1, 6)].material = (
        [cc.MirrorMaterial(), cc.GlassMaterial(), cc.PhongMaterial()][rng.integers(3)]
        if rng.random() < 0.3
        else cc.BasicMaterial(color=rng.random(3))
    )


def edit_environment(scene, rng):
    if rng.random() < 0.5:
        scene.environment = cc.CubeMap(rng.random((6, 4, 4, 3)).astype(np.float32))
    else:
        scene.environment.set_face(int(rng.integers(6)), rng.random((4, 4, 3)).astype(np.float32))


def edit_light(scene, rng):
    scene.lights[0].position = rng.uniform(-4, 4, 3)


def edit_shadow(scene, rng):
    light = scene.lights[rng.integers(len(scene.lights))]
    size, radius = int(rng.choice([16, 24, 32])), rng.choice([0, 1, 1.5])
    light.shadow = cc.Shadow(size=size, radius=radius) if rng.random() < 0.8 else None


def edit_casting(scene, rng):
    node = scene.nodes[rng.integers(len(scene.nodes))]
    name = ("cast_shadow", "receive_shadow")[rng.integers(2)]
    setattr(node, name, not getattr(node, name))


def edit_probe(scene, rng):
    balls = [node for node in scene.nodes if node.name.startswith("ball")]
    probe = balls[rng.integers(len(balls))].environment
    probe.position = np.array(probe.position) + rng.uniform(-0.2, 0.2, 3)


def edit_exclude(scene, rng):
    balls = [node for node in scene.nodes if node.name.startswith("ball")]
    balls[rng.integers(len(balls))].environment.exclude = [
        scene.nodes[rng.integers(len(scene.nodes))]
    ]


def edit_share(scene, rng):
    balls = [node for node in scene.nodes if node.name.startswith("ball")]
    a, b = rng.choice(len(balls), 2)
    balls[a].environment = balls[b].environment


def edit_tree(scene, rng):
    node = scene.nodes[rng.integers(1, 6)]
    node.parent = None if node.parent is not None else scene.nodes[0]


def edit_add_or_remove(scene, rng):
    if rng.random() < 0.5:
        scene.add(
            cc.Mesh.box(0.3), cc.BasicMaterial(color=rng.random(3)), position=rng.uniform(-2, 2, 3)
        )
    elif scene.nodes[-1].name == "":
        scene.remove(scene.nodes[-1])


EDITS = [value for name, value in sorted(globals().items()) if name.startswith("edit_")]


def pictures(renderer, scene, view):
    camera = cc.PerspectiveCamera(fov=65, position=view, target=(0, 0, 0))
    frame = renderer.render(scene, camera, (24, 20), format="rgba32f", outputs=("id",))
    cube = renderer.capture(scene, position=(0.1, 0.2, 0.3), size=12, outputs=("distance",))
    return frame.color, frame.id, cube.faces, cube.distance


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("make", SCENES.values(), ids=SCENES)
def test_random_edits(new_renderer, make, seed):
    rng = np.random.default_rng(seed)
    scene = make(rng)
    live = new_renderer()
    script = []
    for step in range(STEPS):
        for _ in range(rng.integers(0, 3)):
            edit = EDITS[rng.integers(len(EDITS))]
            script.append(edit.__name__)
            edit(scene, rng)
        view = ((3, 1, 2), (-1, 2, 3))[rng.integers(2)]
        got = pictures(live, scene, view)
        with cc.Renderer(device=DEVICE) as scratch:
            want = pictures(scratch, scene, view)
        for name, a, b in zip(
            ("frame", "frame id", "capture", "capture distance"), got, want, strict=True
        ):
            assert_identical(a, b, f"{name} of step {step} after {script}")


@pytest.mark.parametrize("edit", EDITS, ids=[edit.__name__[5:] for edit in EDITS])
@pytest.mark.parametrize("make", SCENES.values(), ids=SCENES)
def test_each_edit_alone(new_renderer, make, edit):
    """Probe by probe: what the live renderer holds is what a new one draws."""
    rng = np.random.default_rng(11)
    scene = make(rng)
    live = new_renderer()
    pictures(live, scene, (3, 1, 2))
    edit(scene, rng)
    got = pictures(live, scene, (3, 1, 2))
    scratch = new_renderer()
    for a, b in zip(got, pictures(scratch, scene, (3, 1, 2)), strict=True):
        assert_identical(a, b)


def test_unused_frames_between_do_not_matter(new_renderer):
    """One renderer sees every step, the other only the last."""
    rng = np.random.default_rng(12)
    scene = shadowed_scene(rng)
    busy, lazy = new_renderer(), new_renderer()
    pictures(lazy, scene, (3, 1, 2))
    for _ in range(10):
        EDITS[rng.integers(len(EDITS))](scene, rng)
        got = pictures(busy, scene, (3, 1, 2))
    for a, b in zip(got, pictures(lazy, scene, (3, 1, 2)), strict=True):
        assert_identical(a, b)


def test_a_twin_of_the_scene_draws_the_same(new_renderer):
    import copy

    scene = probed_scene(np.random.default_rng(13))
    one, other = new_renderer(), new_renderer()
    for a, b in zip(
        pictures(one, scene, (3, 1, 2)),
        pictures(other, copy.deepcopy(scene), (3, 1, 2)),
        strict=True,
    ):
        assert_identical(a, b)
