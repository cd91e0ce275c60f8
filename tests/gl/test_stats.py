"""P15: no picture is drawn again while nothing in it changes. Counters and pixels show it."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import Triangles, capture_hits, matrix_of, smooth_environment


def ring():
    """A box straight ahead on each side, so small that one face sees it alone."""
    scene = cc.Scene(environment=cc.CubeMap(np.full((6, 2, 2, 3), 0.5, np.float32)))
    for place in ((3, 0, 0), (-3, 0, 0), (0, 3, 0), (0, -3, 0), (0, 0, 3), (0, 0, -3)):
        scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(1, 0, 0)), position=place)
    return scene


CAMERA: dict[str, Any] = {"fov": 60, "position": (0, 1, 9), "target": (0, 0, 0)}


def drawn(renderer):
    return renderer.stats.views_drawn, renderer.stats.views_skipped


def test_an_unchanged_capture_draws_nothing(any_path):
    scene = ring()
    first = any_path.capture(scene, size=16)
    assert drawn(any_path) == (6, 0)
    assert any_path.stats.draw_calls > 0
    second = any_path.capture(scene, size=16)
    assert drawn(any_path) == (0, 6)
    assert any_path.stats.draw_calls == any_path.stats.triangles == 0
    assert_identical(first.faces, second.faces)


def test_an_unchanged_frame_draws_nothing(any_path):
    scene, camera = ring(), cc.PerspectiveCamera(**CAMERA)
    first = any_path.render(scene, camera, (16, 16))
    assert drawn(any_path) == (1, 0)
    second = any_path.render(scene, cc.PerspectiveCamera(**CAMERA), (16, 16))
    assert drawn(any_path) == (0, 1)
    assert_identical(first.color, second.color)


@pytest.mark.parametrize("face", range(6))
def test_only_the_face_that_sees_a_change_is_drawn(any_path, face):
    scene = ring()
    any_path.capture(scene, size=16)
    node = scene.nodes[face]
    node.position = np.array(node.position) * 1.1
    changed = any_path.capture(scene, size=16)
    assert drawn(any_path) == (1, 5)
    node.material.color = (0, 1, 0)
    assert drawn(any_path) == (1, 5)
    any_path.capture(scene, size=16)
    # Each box has a material of its own, so only this box is green.
    assert drawn(any_path) == (1, 5)
    assert changed.faces[face].any()


def test_setting_an_equal_value_changes_nothing(renderer):
    scene = ring()
    light = scene.add(cc.PointLight(position=(1, 2, 3)))
    renderer.capture(scene, size=16)
    for node in scene.nodes:
        node.position = np.array(node.position)
        node.scale = (1, 1, 1)
        node.visible = True
        node.material.color = (1, 0, 0)
        node.material = node.material
        node.environment = None
    light.position = (1, 2, 3)
    light.intensity = 1.0
    scene.environment = scene.environment
    scene.environment.set_face(0, np.full((2, 2, 3), 0.5, np.float32))
    renderer.capture(scene, size=16)
    assert drawn(renderer) == (0, 6)


def test_a_change_and_back_draws_what_was_there(renderer):
    scene = ring()
    first = renderer.capture(scene, size=16)
    scene.nodes[0].position = (3, 1, 0)
    renderer.capture(scene, size=16)
    scene.nodes[0].position = (3, 0, 0)
    assert_identical(renderer.capture(scene, size=16).faces, first.faces)


def move_under_a_parent(scene):
    scene.nodes[0].parent = scene.nodes[2]
    scene.nodes[2].position = (0, 2, 0)


CHANGES = {
    "node moved": lambda s: setattr(s.nodes[0], "position", (3, 0.2, 0)),
    "node turned": lambda s: setattr(s.nodes[0], "rotation", cc.axis_angle((0, 1, 0), 20)),
    "node hidden": lambda s: setattr(s.nodes[0], "visible", False),
    "node out of probes": lambda s: setattr(s.nodes[0], "in_captures", False),
    "material": lambda s: setattr(s.nodes[0], "material", cc.BasicMaterial(color=(0, 0, 1))),
    "colour": lambda s: setattr(s.nodes[0].material, "color", (0, 0, 1)),
    "opacity": lambda s: setattr(s.nodes[0].material, "opacity", 0.5),
    "mesh": lambda s: setattr(s.nodes[0], "mesh", cc.Mesh.box(0.6)),
    "added": lambda s: s.add(
        cc.Mesh.box(0.2), cc.BasicMaterial(color=(0, 0, 1)), position=(2, 0, 0)
    ),
    "removed": lambda s: s.remove(s.nodes[0]),
    "parent": lambda s: setattr(s.nodes[0], "parent", s.nodes[2]),
    "parent moved": move_under_a_parent,
    "environment": lambda s: setattr(
        s, "environment", cc.CubeMap(np.zeros((6, 2, 2, 3), np.float32))
    ),
    "environment's face": lambda s: s.environment.set_face(0, np.zeros((2, 2, 3), np.float32)),
    "background": lambda s: setattr(s, "background", (0.1, 0.1, 0.1)),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_change_is_seen(renderer, fresh_renderer, change):
    """The key has every input: the picture equals that of a renderer that never drew the old picture."""
    scene = ring()
    before = renderer.capture(scene, size=48).faces
    change(scene)
    after = renderer.capture(scene, size=48).faces
    assert renderer.stats.views_drawn > 0
    assert (after != before).any()
    assert_identical(after, fresh_renderer.capture(scene, size=48).faces)


LIT = {
    "added": lambda s: s.add(cc.AmbientLight(color=(0.5, 0, 0))),
    "moved": lambda s: setattr(s.lights[0], "position", (-4, 4, 1)),
    "colour": lambda s: setattr(s.lights[0], "color", (1, 0, 1)),
    "intensity": lambda s: setattr(s.lights[0], "intensity", 0.3),
    "decay": lambda s: setattr(s.lights[0], "decay", 1.0),
    "removed": lambda s: s.remove(s.lights[0]),
    "ka": lambda s: setattr(s.nodes[0].material, "ka", 0.5),
    "shininess": lambda s: setattr(s.nodes[0].material, "shininess", 2.0),
    "map": lambda s: setattr(s.nodes[0].material, "map", np.zeros((2, 2, 3), np.uint8)),
}


@pytest.mark.parametrize("change", LIT.values(), ids=LIT)
def test_every_change_of_light_is_seen(renderer, fresh_renderer, change):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(2), cc.PhongMaterial(color=(1, 0.8, 0.6)), position=(0, 0, -3))
    scene.add(cc.PointLight(position=(1, 2, 3)))
    camera = cc.PerspectiveCamera(fov=60, position=(1, 1, 2), target=(0, 0, -3))
    before = renderer.render(scene, camera, (16, 16), format="rgba32f").color
    change(scene)
    after = renderer.render(scene, camera, (16, 16), format="rgba32f").color
    assert (after != before).any()
    assert_identical(after, fresh_renderer.render(scene, camera, (16, 16), format="rgba32f").color)


OPTIONS = {
    "near": {"near": 2.9},
    "far": {"far": 2.7},
    "position": {"position": (0.2, 0, 0)},
    "samples": {"samples": 4},
    "eye": {"eye": (0, 5, 0)},
    "exclude": {"exclude": [0]},
    "format": {"format": "rgba8"},
    "outputs": {"outputs": ("id",)},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_options_are_part_of_the_key(renderer, fresh_renderer, options):
    scene = ring()
    scene.environment = cc.CubeMap(smooth_environment(8))
    scene.nodes[1].material = cc.MirrorMaterial()
    scene.nodes[1].scale = 3
    if "exclude" in options:
        options = {"exclude": [scene.nodes[0]]}
    before = renderer.capture(scene, size=16)
    got = renderer.capture(scene, size=16, **options)
    assert got != before or "outputs" in options
    assert_identical(got.faces, fresh_renderer.capture(scene, size=16, **options).faces)
    assert_identical(renderer.capture(scene, size=16).faces, before.faces)
    assert_identical(renderer.capture(scene, size=16, **options).faces, got.faces)


def test_frames_have_their_options_in_the_key(renderer, fresh_renderer):
    scene, camera = ring(), cc.PerspectiveCamera(**CAMERA)
    for options in (
        {},
        {"tonemap": "aces"},
        {"encode": "srgb"},
        {"tonemap": "reinhard", "samples": 4},
        {},
    ):
        got = renderer.render(scene, camera, (16, 16), **options)
        assert_identical(got.color, fresh_renderer.render(scene, camera, (16, 16), **options).color)


def test_two_scenes_do_not_mix(renderer):
    a, b = ring(), ring()
    b.nodes[0].material.color = (0, 0, 1)
    first = renderer.capture(a, size=16).faces
    other = renderer.capture(b, size=16).faces
    assert (first != other).any()
    assert_identical(renderer.capture(a, size=16).faces, first)


def test_the_store_is_bounded_and_least_recently_used(new_renderer):
    """With room for one target the second pushes the first out; with no room all is drawn each time."""
    scene = ring()
    none = new_renderer(cache_bytes=0)
    first = none.capture(scene, size=16).faces
    again = none.capture(scene, size=16).faces
    assert none.stats.views_drawn == 6
    assert_identical(first, again)
    roomy = new_renderer(cache_bytes=64 << 20)
    for size in (16, 24, 16, 24):
        roomy.capture(scene, size=size)
    assert roomy.stats.views_drawn == 0


def test_results_are_copies(renderer):
    """A capture that is kept does not change when the next is drawn into the same target."""
    scene = ring()
    first = renderer.capture(scene, size=16)
    kept = first.faces.copy()
    scene.background = (1, 1, 1)
    renderer.capture(scene, size=16)
    assert_identical(first.faces, kept)


def test_triangles_and_time_are_counted(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(), position=(0, 0, -3))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, -1))
    renderer.render(scene, camera, (8, 8))
    assert renderer.stats.triangles == 12
    assert renderer.stats.draw_calls == 1
    assert renderer.stats.milliseconds > 0


def test_what_no_view_sees_is_not_drawn(renderer):
    """A thousand boxes behind the camera are culled and cost no draw call."""
    scene = cc.Scene()
    mesh, material = cc.Mesh.box(0.5), cc.BasicMaterial()
    for index in range(1000):
        scene.add(mesh, material, position=(index % 10, index // 100, 5 + index % 7))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 0), target=(0, 0, -1))
    renderer.render(scene, camera, (8, 8))
    assert renderer.stats.draw_calls == 0
    assert renderer.stats.triangles == 0


@pytest.mark.parametrize("scale", [1, 50, (0.01, 80, 0.01)])
def test_culling_leaves_nothing_out(renderer, scale):
    """Culling keeps large and thin things that reach into a view from far away."""
    scene = cc.Scene()
    scene.add(
        cc.Mesh.sphere(1, segments=12, rings=6),
        cc.BasicMaterial(double_sided=True),
        position=(3, 2, 4),
        scale=scale,
        rotation=cc.axis_angle((1, 2, 3), 70),
    )
    mesh = scene.nodes[0].mesh
    assert mesh is not None
    shape = Triangles(
        1,
        matrix_of((3, 2, 4), (1, 2, 3), 70, scale),
        True,
        positions=mesh.positions,
        indices=mesh.indices,
    )
    hits = capture_hits(None, size=16, shapes=[shape])
    cube = renderer.capture(scene, size=16, outputs=("id",))
    assert (cube.id != hits.id).mean() < 0.01


def test_pictures_that_do_not_fit_the_cache_are_counted(new_renderer):
    """A face of 16 x 16 texels takes 20 bytes a texel: rgba32f and a depth of 32 bits."""
    needed = 6 * 16 * 16 * 20
    scene = cc.Scene(background=(1, 0, 0))
    for cache_bytes, not_kept, skipped in ((needed, 0, 6), (needed - 1, 1, 0), (0, 1, 0)):
        renderer = new_renderer(cache_bytes=cache_bytes)
        for _ in range(2):
            renderer.capture(scene, size=16)
            assert renderer.stats.pictures_not_kept == not_kept, cache_bytes
        assert renderer.stats.views_skipped == skipped, cache_bytes
        renderer.render(scene, cc.PerspectiveCamera(), (4, 4))
        assert renderer.stats.pictures_not_kept == (cache_bytes == 0)
        assert "pictures_not_kept=" in repr(renderer.stats)
