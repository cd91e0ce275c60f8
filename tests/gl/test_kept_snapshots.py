"""A scene without render textures keeps its snapshot, and the next picture is right whatever is edited."""

import copy
from types import SimpleNamespace

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import DEVICE

CAMERA = cc.PerspectiveCamera(fov=50, position=(0, 1, 9), target=(0, 0, 0), near=0.5, far=40)


def make_world(rng):
    """Groups in groups, a crowd, mirrors with probes that follow nodes, a shadow, a cubemap."""
    cube = cc.CubeMap(rng.uniform(0, 1, (6, 4, 4, 3)).astype(np.float32))
    scene = cc.Scene(environment=cube, background=(0.1, 0.1, 0.2))
    sun = scene.add(cc.DirectionalLight((1, -2, -1), shadow=cc.Shadow(size=32)))
    lamp = scene.add(cc.PointLight((0, 3, 4)))
    paint = cc.PhongMaterial(color=(0.7, 0.4, 0.2))
    mesh = cc.Mesh.box(0.5)
    floor = scene.add(cc.Mesh.plane(12, 12), paint, position=(0, -2, 0))
    arm = scene.add(position=(-2, 0, 0))
    hand = scene.add(position=(1, 0, 0), parent=arm)
    held = [scene.add(mesh, paint, position=(0.3, y, 0), parent=hand) for y in (-1, 0, 1)]
    crowd = [
        scene.add(mesh, cc.BasicMaterial(color=tuple(rng.uniform(0, 1, 3))), position=place)
        for place in rng.uniform((-4, -1, -4), (4, 3, -1), (24, 3))
    ]
    probe = cc.Probe(parent=hand, size=16)
    ball = scene.add(
        cc.Mesh.icosphere(0.6, subdivisions=2), cc.MirrorMaterial(), parent=hand, environment=probe
    )
    still = cc.Probe(position=(2, 0, 0), size=16)
    other = scene.add(
        cc.Mesh.box(1), cc.GlassMaterial(), position=(2, 0, 0), environment=still, name="glass"
    )
    bone = scene.add(position=(0, 1, 1), parent=arm)
    tip = scene.add(position=(0, 0.4, 0), parent=bone)
    stick = cc.Mesh.box((0.3, 1, 0.3))
    upper = stick.positions[:, 1:2] > 0
    stick.update(
        joints=np.tile((0, 1, 0, 0), (len(upper), 1)),
        joint_weights=np.c_[~upper, upper, 0 * upper, 0 * upper],
        morph_targets=[cc.MorphTarget(positions=0.3 * stick.normals)],
    )
    bent = scene.add(stick, paint, skin=cc.Skin([bone, tip]), weights=[0.2])
    swollen = scene.add(stick, paint, position=(-1, -1, 2), weights=[0.2])
    return SimpleNamespace(**{key: value for key, value in locals().items() if key != "rng"})


def move_crowd(world, rng):
    chosen = [node for node in world.crowd if rng.random() < 0.3 and node in world.scene]
    world.scene.set_positions(chosen, rng.uniform((-4, -1, -4), (4, 3, -1), (len(chosen), 3)))


def remove_and_add(world, rng):
    node = world.crowd.pop(int(rng.integers(len(world.crowd))))
    world.scene.remove(node)
    world.crowd.append(world.scene.add(world.mesh, node.material, position=rng.uniform(-2, 2, 3)))


def swap_parents(world, rng):
    child = world.held[int(rng.integers(3))]
    child.parent = world.arm if child.parent is world.hand else world.hand


EDITS = {
    "arm": lambda w, rng: setattr(w.arm, "rotation", cc.axis_angle((0, 0, 1), rng.uniform(0, 90))),
    "hand": lambda w, rng: setattr(w.hand, "position", rng.uniform(-1, 1, 3)),
    "hand's matrix": lambda w, rng: setattr(
        w.hand, "matrix", np.diag([*rng.uniform(0.5, 2, 3), 1])
    ),
    "held": lambda w, rng: setattr(w.held[1], "position", rng.uniform(-1, 1, 3)),
    "mirrored": lambda w, rng: setattr(w.held[0], "scale", rng.choice([-1, 1], 3)),
    "crowd": move_crowd,
    "removed and added": remove_and_add,
    "parents": swap_parents,
    "color": lambda w, rng: setattr(w.paint, "color", rng.uniform(0, 1, 3)),
    "own material": lambda w, rng: setattr(
        w.held[2], "material", cc.BasicMaterial(color=tuple(rng.uniform(0, 1, 3)))
    ),
    "mesh": lambda w, rng: w.mesh.update(positions=w.mesh.positions * rng.uniform(0.8, 1.2)),
    "lamp": lambda w, rng: setattr(w.lamp, "intensity", rng.uniform(0, 2)),
    "sun": lambda w, rng: setattr(w.sun, "direction", (rng.uniform(-1, 1), -2, -1)),
    "face": lambda w, rng: w.cube.set_face(
        cc.Face(int(rng.integers(6))), rng.uniform(0, 1, (4, 4, 3)).astype(np.float32)
    ),
    "probe": lambda w, rng: setattr(w.still, "position", rng.uniform(-2, 2, 3)),
    "probe's parent": lambda w, rng: setattr(w.still, "parent", w.hand),
    "hidden": lambda w, rng: setattr(w.hand, "visible", not w.hand.visible),
    "background": lambda w, rng: setattr(w.scene, "background", rng.uniform(0, 1, 3)),
    "environment": lambda w, rng: setattr(w.other, "environment", None),
    "joint": lambda w, rng: setattr(w.tip, "position", rng.uniform(-0.5, 0.5, 3)),
    "first joint": lambda w, rng: setattr(w.bone, "rotation", rng.normal(size=4)),
    "weights": lambda w, rng: setattr(w.swollen, "weights", rng.random(1)),
    "weights of a skin": lambda w, rng: setattr(w.bent, "weights", rng.random(1)),
    "bent mesh": lambda w, rng: w.stick.update(positions=w.stick.positions * 1.1),
    "place of a skin": lambda w, rng: setattr(w.bent, "position", rng.uniform(-1, 1, 3)),
    "nothing": lambda w, rng: None,
}


def pictures(renderer, world):
    frame = renderer.render(world.scene, CAMERA, (48, 36), outputs=("id",), format="rgba32f")
    cube = renderer.capture(world.scene, (0.1, 0, 0), 12, exclude=[world.other])
    return {"color": frame.color, "id": frame.id, "faces": cube.faces}


@pytest.mark.parametrize("seed", range(3))
def test_the_next_picture_is_right_whatever_was_edited(fresh_renderer, seed):
    rng = np.random.default_rng(seed)
    world = make_world(rng)
    changed = 0
    with cc.Renderer(device=DEVICE) as scratch:
        before = pictures(fresh_renderer, world)
        for name in [*rng.permutation(list(EDITS)), *rng.permutation(list(EDITS))]:
            EDITS[name](world, rng)
            got = pictures(fresh_renderer, world)
            if rng.random() < 0.3:  # a second call, with nothing changed
                assert_identical(pictures(fresh_renderer, world)["color"], got["color"], name)
                assert fresh_renderer.stats.views_drawn == 0, name
            want = pictures(scratch, copy.deepcopy(world))
            for key, picture in want.items():
                assert_identical(got[key], picture, f"{key} after {name}")
            changed += not np.array_equal(got["color"], before["color"])
            before = got
    assert changed > len(EDITS)


def test_a_probe_drawn_by_hand_shows_in_the_next_frame(fresh_renderer):
    """The scene does not change: only the contents that the renderer keeps for the probe change."""
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(cc.Mesh.box(20), cc.BasicMaterial(color=(1, 0, 0), double_sided=True))
    probe = cc.Probe(size=8, update="manual")
    scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), environment=probe)
    shots = [fresh_renderer.render(scene, CAMERA, (16, 16)).color[8, 8] for _ in range(4)]
    assert fresh_renderer.stats.views_drawn == 0
    assert all(shot.tolist() == [0, 0, 0, 255] for shot in shots)
    fresh_renderer.update_probes(scene)
    shot = fresh_renderer.render(scene, CAMERA, (16, 16)).color[8, 8]
    assert shot.tolist() == [255, 0, 0, 255]


def test_a_snapshot_that_another_thread_draws_is_left_alone(new_renderer):
    """Nodes that move while a picture is drawn do not change that picture."""
    import threading

    scene = cc.Scene(background=(0, 0, 0))
    nodes = [scene.add(cc.Mesh.box(1), cc.BasicMaterial()) for _ in range(50)]
    renderers = [new_renderer(), new_renderer()]
    sums: list[set[float]] = [set(), set()]
    failures: list[Exception] = []

    def draw(renderer, seen):
        try:
            for _ in range(60):
                ids = renderer.render(scene, CAMERA, (16, 16), outputs="id", format=None).id
                seen.add(tuple(np.unique(ids)))
        except Exception as error:
            failures.append(error)

    threads = [
        threading.Thread(target=draw, args=pair) for pair in zip(renderers, sums, strict=True)
    ]
    for thread in threads:
        thread.start()
    flip = 0
    while any(thread.is_alive() for thread in threads):
        flip = 1 - flip  # all nodes are in view, or all are out of view
        scene.set_positions(nodes, np.tile([0, 100.0 * flip, 0], (50, 1)))
    for thread in threads:
        thread.join()
    assert not failures
    assert set().union(*sums) <= {(0,), (0, 1)}


def test_look_at_is_a_move(fresh_renderer):
    """A kept snapshot reads the node again."""
    scene = cc.Scene()
    arrow = scene.add(cc.Mesh.arrow(), cc.BasicMaterial(), position=(0, 0, -3))
    camera = cc.PerspectiveCamera()
    for target, side in (((5, 0, -3), 1), ((-5, 0, -3), -1)):
        arrow.look_at(target)
        seen = fresh_renderer.render(scene, camera, (40, 30)).color[..., 3] > 0
        assert np.sign(np.nonzero(seen)[1].mean() - 19.5) == side
