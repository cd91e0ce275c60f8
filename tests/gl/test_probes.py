"""Probes: when they draw, what they leave out, where they stand, who shares them."""

import itertools
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close, assert_identical
from tests.gl.world import smooth_environment

CAMERA: dict[str, Any] = {"fov": 50, "position": (0, 1, 5), "target": (0, 0, 0)}


def stage(**probe):
    """A mirror ball at the origin, a box that moves, and the ball's probe."""
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(8)))
    box = scene.add(cc.Mesh.box(0.8), cc.BasicMaterial(color=(1, 0, 0)), position=(1.5, 0, 0))
    ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial())
    ball.environment = cc.Probe(**{"position": (0, 0, 0), "size": 16, "format": "rgba32f", **probe})
    return scene, box, ball


def frame(renderer, scene):
    return renderer.render(scene, cc.PerspectiveCamera(**CAMERA), (24, 24), format="rgba32f").color


def truth(renderer, scene, ball, **options):
    """What the probe should hold: a capture without the nodes that use the probe."""
    return renderer.capture(scene, **{"size": 16, "exclude": [ball], **options}).faces


def test_on_change_is_always_true(any_path):
    scene, box, ball = stage()
    for x in (1.5, -1.5, 2.0):
        box.position = (x, 0, 0.3)
        frame(any_path, scene)
        held = any_path.read_probe(ball.environment).faces
        assert_identical(held, truth(any_path, scene, ball))
        assert (held[0 if x > 0 else 1, ..., 0] == 1).any()


def test_the_ball_shows_what_its_probe_holds(renderer):
    scene, box, _ = stage()
    before = frame(renderer, scene)
    box.position = (-1.5, 0, 0)
    after = frame(renderer, scene)
    assert (before[12, 8:16] != after[12, 8:16]).any()


@pytest.mark.parametrize("mipmaps", [False, True])
@pytest.mark.parametrize("fmt", ["rgba8", "rgba16f", "rgba32f"])
def test_formats_and_mipmaps(renderer, fmt, mipmaps):
    scene, _, ball = stage(format=fmt, mipmaps=mipmaps)
    frame(renderer, scene)
    held = renderer.read_probe(ball.environment)
    assert held.mipmaps is mipmaps
    assert_identical(held.faces, truth(renderer, scene, ball, format=fmt))


def test_near_far_and_size(renderer):
    scene, _, ball = stage(size=20, near=1.0, far=1.3)
    frame(renderer, scene)
    held = renderer.read_probe(ball.environment)
    assert_identical(held.faces, truth(renderer, scene, ball, size=20, near=1.0, far=1.3))
    assert held.size == 20


def test_once_draws_the_first_time_it_is_needed(renderer):
    scene, box, ball = stage(update="once")
    frame(renderer, scene)
    first = renderer.read_probe(ball.environment).faces
    assert_identical(first, truth(renderer, scene, ball))
    box.position = (-1.5, 0, 0)
    frame(renderer, scene)
    assert_identical(renderer.read_probe(ball.environment).faces, first)
    renderer.update_probes(scene, probes=[ball.environment])
    assert_identical(renderer.read_probe(ball.environment).faces, truth(renderer, scene, ball))


def test_manual_draws_only_when_told(renderer):
    scene, box, ball = stage(update="manual")
    renderer.update_probes(scene, probes=[ball.environment])
    first = renderer.read_probe(ball.environment).faces
    assert_identical(first, truth(renderer, scene, ball))
    shown = frame(renderer, scene)
    box.material = cc.BasicMaterial(color=(0, 1, 0))
    after = frame(renderer, scene)
    assert_identical(renderer.read_probe(ball.environment).faces, first)
    center = (slice(10, 16), slice(10, 14))
    assert_identical(after[center], shown[center])
    renderer.update_probes(scene, probes=[ball.environment])
    assert_identical(renderer.read_probe(ball.environment).faces, truth(renderer, scene, ball))
    assert (frame(renderer, scene) != after).any()


def test_every_third_frame(renderer):
    scene, box, ball = stage(update=3)
    seen = []
    for step in range(7):
        box.material.color = (step / 8, 0, 0)
        frame(renderer, scene)
        seen.append(renderer.read_probe(ball.environment).faces.copy())
    changed = [bool((a != b).any()) for a, b in itertools.pairwise(seen)]
    assert changed == [False, False, True, False, False, True]


def test_faces_per_frame_spreads_the_work(renderer):
    scene, _, ball = stage(faces_per_frame=2)
    for _ in range(3):
        frame(renderer, scene)
    scene.environment = cc.CubeMap(smooth_environment(8)[..., ::-1].copy())
    want = None
    for step in range(1, 4):
        frame(renderer, scene)
        held = renderer.read_probe(ball.environment).faces
        want = truth(renderer, scene, ball)
        assert sum(np.array_equal(a, b) for a, b in zip(held, want, strict=True)) == 2 * step
    assert_identical(held, want)


def test_unchanged_probes_are_not_drawn(any_path):
    scene, box, _ = stage()
    frame(any_path, scene)
    assert any_path.stats.views_drawn == 7
    assert any_path.stats.probes_updated == 1
    frame(any_path, scene)
    assert any_path.stats.views_drawn == 0
    assert any_path.stats.probes_updated == 0
    box.position = (1.6, 0, 0)  # seen by the probe's +X and by the camera only
    frame(any_path, scene)
    assert any_path.stats.views_drawn == 2


def test_only_probes_that_a_drawn_node_needs_are_updated(renderer):
    scene, _, ball = stage()
    ball.position = (0, 0, 50)  # behind the camera
    frame(renderer, scene)
    assert renderer.stats.probes_updated == 0
    ball.position, ball.visible = (0, 0, 0), False
    frame(renderer, scene)
    assert renderer.stats.probes_updated == 0


def test_users_are_left_out_and_still_receive(renderer):
    scene, _, ball = stage()
    other = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(0, 1, -1.5))
    other.environment = ball.environment
    frame(renderer, scene)
    held = renderer.read_probe(ball.environment).faces
    assert_identical(held, truth(renderer, scene, ball, exclude=[ball, other]))
    assert (frame(renderer, scene)[..., 3] == 1).any()


def test_a_material_that_shows_a_probe_is_left_out_too(renderer):
    scene, _, ball = stage()
    shown = scene.add(
        cc.Mesh.box(0.6), cc.BasicMaterial(cubemap=ball.environment), position=(-1.5, 0, 0)
    )
    frame(renderer, scene)
    assert_identical(
        renderer.read_probe(ball.environment).faces,
        truth(renderer, scene, ball, exclude=[ball, shown]),
    )


def test_exclude_covers_subtrees(renderer):
    scene, box, ball = stage()
    child = scene.add(
        cc.Mesh.box(0.3), cc.BasicMaterial(color=(0, 0, 1)), position=(0, 1, 0), parent=box
    )
    ball.environment.exclude = [box]
    frame(renderer, scene)
    assert_identical(
        renderer.read_probe(ball.environment).faces,
        truth(renderer, scene, ball, exclude=[ball, box, child]),
    )


def test_in_captures_false_is_absent_from_captures_and_probes_but_drawn(renderer):
    scene, box, ball = stage()
    box.in_captures = False
    shown = frame(renderer, scene)
    held = renderer.read_probe(ball.environment).faces
    assert_identical(held, truth(renderer, scene, ball, exclude=[ball, box]))
    assert_identical(renderer.capture(scene, size=16, exclude=[ball]).faces, held)
    assert ((shown[..., :3] == [1, 0, 0]).all(-1)).any()


def test_attached_to_a_node_it_follows_the_position_only(renderer):
    scene, _, ball = stage()
    pivot = scene.add(position=(0, 0.5, 0), rotation=cc.axis_angle((0, 0, 1), 30))
    ball.parent, ball.position = pivot, (0.5, 0, 0)
    ball.rotation, ball.scale = cc.axis_angle((1, 1, 0), 77), 0.7
    ball.environment = cc.Probe(parent=ball, size=16, format="rgba32f")
    frame(renderer, scene)
    where = np.asarray(ball.world_matrix)[:3, 3]
    held = renderer.read_probe(ball.environment).faces
    assert_identical(held, truth(renderer, scene, ball, position=where))
    pivot.position = (0.2, 0.1, 0)
    frame(renderer, scene)
    where = np.asarray(ball.world_matrix)[:3, 3]
    assert_identical(
        renderer.read_probe(ball.environment).faces, truth(renderer, scene, ball, position=where)
    )


def test_what_a_probe_depends_on_is_drawn_first(renderer):
    """Ball B shows a probe that sees ball A, whose probe sees the box: after one frame both are true."""
    scene, box, a = stage()
    b = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(0, 1, 1))
    b.environment = cc.Probe(position=(0, 1, 1), size=16, format="rgba32f")
    a.environment.exclude = [b]
    frame(renderer, scene)
    box.position = (1.5, 0.2, 0.4)
    frame(renderer, scene)
    assert_identical(
        renderer.read_probe(a.environment).faces, truth(renderer, scene, a, exclude=[a, b])
    )
    assert_identical(
        renderer.read_probe(b.environment).faces,
        truth(renderer, scene, b, exclude=[b], position=(0, 1, 1)),
    )


def test_in_a_circle_the_other_mirror_shows_the_environment(new_renderer):
    """Two mirrors that see each other never show old contents: any order and number of frames gives the same."""
    scene = cc.Scene(environment=cc.CubeMap(np.full((6, 2, 2, 3), (0, 0, 1), np.float32)))
    balls = [
        scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), position=(x, 0, 0)) for x in (-0.8, 0.8)
    ]
    for ball in balls:
        ball.environment = cc.Probe(parent=ball, size=16, format="rgba32f")
    one, many = new_renderer(), new_renderer()
    first = frame(one, scene)
    for _ in range(4):
        later = frame(many, scene)
    assert_identical(first, later)
    scene.environment = None
    assert_identical(frame(one, scene), frame(new_renderer(), scene))
    assert not frame(one, scene)[..., 1].any()


def test_update_and_cubemap_without_a_frame(renderer):
    scene, _, ball = stage()
    renderer.update_probes(scene)
    assert_identical(renderer.read_probe(ball.environment).faces, truth(renderer, scene, ball))


def test_contents_live_in_the_renderer(new_renderer):
    """Two renderers draw one probe: each has contents of its own, and scenes know no renderer."""
    scene, box, ball = stage(update="once")
    a, b = new_renderer(), new_renderer()
    frame(a, scene)
    box.position = (-1.5, 0, 0)
    frame(b, scene)
    held_a, held_b = (r.read_probe(ball.environment).faces for r in (a, b))
    assert (held_a != held_b).any()
    assert_identical(held_b, truth(b, scene, ball))


def test_what_is_handed_out_is_a_copy(renderer):
    scene, box, ball = stage()
    frame(renderer, scene)
    held = renderer.read_probe(ball.environment)
    kept = held.faces.copy()
    box.position = (-1.5, 0, 0)
    frame(renderer, scene)
    assert_identical(held.faces, kept)


def test_a_probe_that_was_never_drawn_is_refused(renderer):
    with pytest.raises((ValueError, KeyError), match="probe"):
        renderer.read_probe(cc.Probe(position=(0, 0, 0)))


def test_a_probe_on_a_cubemap_material_shows_by_object_space(renderer):
    """P13's cube shows the probe, looked up by the position in the cube's own space."""
    scene, _, ball = stage()
    probe = ball.environment
    scene.remove(ball)
    shown = scene.add(cc.Mesh.box(1), cc.BasicMaterial(cubemap=probe), position=(0, 0, 2))
    camera = cc.OrthographicCamera(height=0.9, position=(0, 0, 5), target=(0, 0, 2))
    color = renderer.render(scene, camera, (9, 9), format="rgba32f").color
    held = renderer.read_probe(probe)
    x = (np.arange(9) - 4) / 9 * 0.9
    directions = np.stack(
        [*np.broadcast_arrays(x[None, :], -x[:, None]), np.full((9, 9), 0.5)], axis=-1
    )
    assert shown.id == 3
    assert_close(color[..., :3], held.sample(directions)[..., :3], "mirror")


def test_reflections_use_the_probe_per_pixel(renderer):
    """The ball's middle shows what is behind the eye, and its rim shows what lies beside the eye."""
    scene, box, ball = stage(size=64)
    box.position, box.scale = (0, 0, 3), 1.5
    camera = cc.PerspectiveCamera(fov=20, position=(0, 0, 2), target=(0, 0, 0))
    color = renderer.render(scene, camera, (33, 33), format="rgba32f").color
    np.testing.assert_allclose(color[16, 16], [1, 0, 0, 1], atol=1e-6)
    held = renderer.read_probe(ball.environment)
    incident = normalised([0.16, 0, -1.0])
    # The point where that ray meets the ball.
    b = 2 * -incident[2]
    t = b - np.sqrt(b * b - (4 - 0.25))
    point = np.array([0, 0, 2]) + t * incident
    want = held.sample(shading.reflect(incident, point / 0.5))
    column = 16 + 0.16 / np.tan(np.radians(10)) * 16.5
    got = color[16, int(np.floor(column))]
    assert np.abs(got[:3] - want[:3]).max() < 0.1
