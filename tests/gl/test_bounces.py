"""Probes that see each other: `Probe.bounces`, alike for all mirrors of a circle, whichever was added first."""

import itertools
import math
import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import smooth_environment
from tests.helpers import DEVICE

WHITE = cc.CubeMap(np.ones((6, 1, 1, 3), np.float32))
LIGHT = np.array([1, 2, 0.5])
COLORED = cc.CubeMap(np.full((6, 1, 1, 3), LIGHT, np.float32))
#: Sees one of the balls of `room(2)`.
ONE = cc.PerspectiveCamera(fov=14, position=(0.7, 0, 3), target=(0.7, 0, 0))
EYE = cc.PerspectiveCamera(fov=40, position=(0.3, 0.5, 3), target=(0, 0, 0))


def look(renderer, scene, camera=EYE, size=(24, 16)):
    return renderer.render(scene, camera, size, format="rgba32f").color


def probe_at(place, **options):
    return cc.Probe(**{"position": place, "size": 8, "format": "rgba32f", **options})


# Probes that see nothing but a mirror: each level is a product of tints.

TINTS = ((0.5, 0.25, 1), (0.25, 1, 0.5), (1, 0.5, 0.25), (0.5, 0.5, 0.25))


def ring(count, environment=COLORED, order=None, **options):
    """Boxes in a ring, each around the place of a probe: mirror i shows in all directions mirror i + 1.

    Returns the scene and its mirrors; `order` is that in which they are added.
    """
    scene = cc.Scene(environment=environment, background=(0, 0, 0, 1))
    mirrors = {}
    for i in order or range(count):
        mirror = scene.add(
            cc.Mesh.box(1),
            cc.MirrorMaterial(tint=TINTS[i], double_sided=True),
            position=(2 * ((i - 1) % count), 0, 0),
        )
        mirror.environment = probe_at((2 * i, 0, 0), **options)
        mirrors[i] = mirror
    return scene, [mirrors[i] for i in range(count)]


def product(count, first, bounces, light=LIGHT):
    """What the probe of mirror `first` holds in a ring: `bounces` mirrors, then the light."""
    color = np.array(light, float)
    for step in range(1, bounces + 1):
        color = color * TINTS[(first + step) % count]
    return color


def held(renderer, mirror):
    return renderer.read_probe(mirror.environment).faces[..., :3]


def ring_view(count):
    return cc.OrthographicCamera(height=4, position=(count - 1, 0, 9), target=(count - 1, 0, 0))


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("bounces", [1, 2, 3, 16])
def test_each_bounce_adds_a_mirror(any_path, count, bounces):
    scene, mirrors = ring(count, bounces=bounces)
    picture = look(any_path, scene, ring_view(count), (24, 8))
    for i, mirror in enumerate(mirrors):
        want = product(count, i, bounces)
        assert_close(held(any_path, mirror), np.broadcast_to(want, (6, 8, 8, 3)), "lookup")
        column = round(2 * (mirror.position[0] - (count - 1) + 6))
        assert_close(picture[3:5, column, :3], [want * TINTS[i]] * 2, "lookup")


@pytest.mark.parametrize("environment", [COLORED, None])
def test_the_last_mirror_shows_the_environment_as_it_is_placed_or_black(renderer, environment):
    scene, mirrors = ring(2, environment, bounces=2)
    scene.environment_intensity = 3
    look(renderer, scene, ring_view(2))
    want = 0 * LIGHT if environment is None else product(2, 0, 2, 3 * LIGHT)
    assert_close(held(renderer, mirrors[0])[0, 0], [want] * 8, "lookup")


@pytest.mark.parametrize("count", [2, 3])
def test_the_order_of_adding_does_not_matter(new_renderer, count):
    pictures = []
    for order in itertools.permutations(range(count)):
        scene, _ = ring(count, order=list(order), bounces=2)
        pictures.append(look(new_renderer(), scene, ring_view(count), (24, 8)))
    for picture in pictures:
        assert_identical(picture, pictures[0])


def test_the_largest_bounces_of_a_circle_count(renderer):
    scene, mirrors = ring(3)
    mirrors[1].environment.bounces = 4
    look(renderer, scene, ring_view(3))
    for i, mirror in enumerate(mirrors):
        assert_close(held(renderer, mirror)[0, 0], [product(3, i, 4)] * 8, "lookup")


# Balls: levels made one by one, with fixed cubemaps in the place of the probes.


def room(count=2, **options):
    """Mirror balls in a coloured room with a box; returns the scene and the balls."""
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(8)))
    scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(1, 0.1, 0)), position=(0, 0.8, 0.4))
    balls = []
    for i in range(count):
        angle = 2 * math.pi * i / count
        place = (0.7 * math.cos(angle), 0, 0.7 * math.sin(angle))
        tint = (0.9, 0.7 + 0.1 * i, 0.6)
        ball = scene.add(
            cc.Mesh.icosphere(0.5, subdivisions=3), cc.MirrorMaterial(tint=tint), position=place
        )
        ball.environment = probe_at(place, size=16, **options)
        balls.append(ball)
    return scene, balls


def by_hand(renderer, scene, nodes, bounces):
    """The faces that the probes of a circle must hold, and the picture with them, without any probe being drawn."""
    probes = [node.environment for node in nodes]
    held: list = [None] * len(nodes)
    for _ in range(bounces):
        for node, faces in zip(nodes, held, strict=True):
            node.environment = None if faces is None else cc.CubeMap(faces)
        held = [
            renderer.capture(
                scene, probe.position, probe.size, format="rgba32f", exclude=[node, *probe.exclude]
            ).faces
            for node, probe in zip(nodes, probes, strict=True)
        ]
    for node, faces in zip(nodes, held, strict=True):
        node.environment = cc.CubeMap(faces)
    picture = look(renderer, scene)
    for node, probe in zip(nodes, probes, strict=True):
        node.environment = probe
    return held, picture


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("bounces", [1, 2, 3])
def test_balls_equal_levels_made_by_hand(any_path, new_renderer, count, bounces):
    scene, balls = room(count, bounces=bounces)
    want, want_picture = by_hand(any_path, scene, balls, bounces)
    picture = look(any_path, scene)
    for ball, faces in zip(balls, want, strict=True):
        assert_identical(any_path.read_probe(ball.environment).faces, faces, across="programs")
    assert_identical(picture, want_picture, across="programs")


@pytest.mark.parametrize(
    "material",
    [
        cc.StandardMaterial(metallic=1, roughness=0.4),
        cc.GlassMaterial(roughness=0.3),
        cc.StandardMaterial(metallic=0, roughness=0.2, transmission=1),
    ],
    ids=["rough metal", "rough glass", "transmissive"],
)
def test_filtered_levels_and_what_is_behind(new_renderer, material):
    scene, balls = room(2, bounces=2)
    for ball in balls:
        ball.material = material
    one = new_renderer()
    want, want_picture = by_hand(one, scene, balls, 2)
    picture = look(one, scene)
    for ball, faces in zip(balls, want, strict=True):
        assert_close(one.read_probe(ball.environment).faces, faces, "filtered_lookup")
    assert_close(picture, want_picture, "filtered_lookup")
    assert_identical(picture, look(new_renderer(), scene))


def test_mirrors_in_either_order_show_the_same(new_renderer):
    scene, balls = room(2, bounces=2)
    picture = look(new_renderer(), scene)
    swapped, _ = room(0)
    for ball in reversed(balls):
        ball.environment = pickle.loads(pickle.dumps(ball.environment))
        swapped.add(ball.mesh, ball.material, position=ball.position).environment = ball.environment
    assert_identical(look(new_renderer(), swapped), picture)


# What is outside of a circle, and where circles end.


def test_two_circles_have_bounces_of_their_own(renderer):
    """Two rings of two; only the first sees the second."""
    scene, first = ring(2, bounces=3)
    second = []
    for i in range(2):
        mirror = scene.add(
            cc.Mesh.box(1),
            cc.MirrorMaterial(tint=TINTS[i], double_sided=True),
            position=(2 * (1 - i), 0, -5),
        )
        mirror.environment = probe_at((2 * i, 0, -5), bounces=1, exclude=first)
        second.append(mirror)
    camera = cc.OrthographicCamera(height=4, position=(1, 3, 9), target=(1, 0, -2))
    for excluded in ([], second):  # with and without the way from the first circle to the second
        for mirror in first:
            mirror.environment.exclude = excluded
        look(renderer, scene, camera)
        for i in range(2):
            assert_close(held(renderer, first[i])[0, 0], [product(2, i, 3)] * 8, "lookup")
            assert_close(held(renderer, second[i])[0, 0], [product(2, i, 1)] * 8, "lookup")
    # Seen both ways, all four are one circle.
    for mirror in (*first, *second):
        mirror.environment.exclude = []
    look(renderer, scene, camera)
    for i in range(2):
        assert_close(held(renderer, second[i])[0, 0], [product(2, i, 3)] * 8, "lookup")


def test_what_a_probe_excludes_opens_the_circle(new_renderer):
    """One-way mirrors are no circle: the second shows the first as any frame does."""
    scene, balls = room(2, bounces=3)
    balls[0].environment.exclude = [balls[1]]
    one = new_renderer()
    picture = look(one, scene)
    # Of one picture each.
    assert one.stats.views_drawn == 6 + 6 + 1
    assert one.stats.bounce_changes == ()
    first, second = balls
    faces = one.capture(scene, first.environment.position, 16, format="rgba32f", exclude=balls)
    assert_identical(one.read_probe(first.environment).faces, faces.faces)
    probe, first.environment = first.environment, cc.CubeMap(faces.faces)
    want = one.capture(scene, second.environment.position, 16, format="rgba32f", exclude=[second])
    first.environment = probe
    assert_identical(one.read_probe(second.environment).faces, want.faces, across="programs")
    # A node out of captures is in no circle either.
    balls[0].environment.exclude = []
    balls[1].in_captures = False
    look(one, scene)
    assert one.stats.bounce_changes == ()
    balls[1].in_captures = True
    look(one, scene)
    assert len(one.stats.bounce_changes) == 2
    assert_identical(look(one, scene), look(new_renderer(), scene))
    assert (picture != look(one, scene)).any()


def test_a_node_that_uses_two_probes_is_in_the_circle_of_what_it_shows(new_renderer):
    """The environment of a material that looks up none hides the node from that probe, and shows nothing."""
    scene, mirrors = ring(2, bounces=2)
    hidden = probe_at((9, 0, 0))
    shown = scene.add(cc.Mesh.box(0.1), cc.BasicMaterial(), position=(0, 0.9, 0))
    shown.material.cubemap = mirrors[0].environment
    shown.environment = hidden
    renderer = new_renderer()
    look(renderer, scene, ring_view(2))
    for i in range(2):
        assert_close(held(renderer, mirrors[i])[3, 0], [product(2, i, 2)] * 8, "lookup")
    # The other probe is used by nothing that looks it up: it is never drawn.
    with pytest.raises(ValueError, match="has drawn"):
        renderer.read_probe(hidden)


def test_several_scenes(new_renderer):
    """A circle in a scene that a texture shows, its probes in a scene without a circle, and captures."""
    inner, mirrors = ring(2, bounces=2)
    texture = cc.RenderTexture(inner, ring_view(2), size=(24, 8), format="rgba32f")
    scene = cc.Scene(environment=WHITE)
    scene.add(
        cc.Mesh.plane(3, 1), cc.BasicMaterial(map=texture), position=(0, 0, 1)
    ).rotation = cc.axis_angle((1, 0, 0), 90)
    alone = scene.add(
        cc.Mesh.box(0.5), cc.BasicMaterial(cubemap=mirrors[0].environment), position=(0, -0.6, 1)
    )
    renderer = new_renderer()
    color = look(renderer, scene, size=(48, 32))
    changes = renderer.stats.bounce_changes
    direct = new_renderer()
    assert_identical(renderer.read_texture(texture), look(direct, inner, ring_view(2), (24, 8)))
    # In its other scene the probe sees the texture on the plane; it is in no circle there.
    assert (color[..., :3] != 1).any()
    assert changes == direct.stats.bounce_changes
    assert len(changes) == 1
    capture = direct.capture(inner, (1, 0, 3), 16, format="rgba32f").faces
    assert {tuple(c) for c in np.round(capture[5, ..., :3].reshape(-1, 3), 5)} == {
        tuple(c) for c in np.round([LIGHT, *(product(2, i, 2) * TINTS[i] for i in range(2))], 5)
    } - {tuple(np.round(LIGHT, 5))} | {(0.0, 0.0, 0.0)}
    alone.visible = False
    assert_identical(
        look(renderer, scene, size=(48, 32)), look(new_renderer(), scene, size=(48, 32))
    )


# Changes at run time.


def test_changed_bounces_draw_what_is_missing(new_renderer):
    scene, balls = room(2, bounces=1)
    renderer = new_renderer()
    for bounces, views in ((1, 13), (2, 13), (4, 25), (4, 0), (2, 1), (1, 1), (3, 25)):
        balls[0].environment.bounces = bounces
        picture = look(renderer, scene)
        assert renderer.stats.views_drawn == views, bounces
        assert renderer.stats.probes_updated == (2 if views > 1 else 0)
        assert_identical(picture, look(new_renderer(), scene))


def test_only_what_changed_is_drawn(new_renderer):
    """Far from both mirrors a box moves: of each level, two faces change."""
    scene, _ = room(2, bounces=3)
    box = scene.add(cc.Mesh.box(0.1), cc.BasicMaterial(), position=(0, 0, -3), scale=0.5)
    renderer = new_renderer()
    look(renderer, scene)
    assert renderer.stats.views_drawn == 37
    box.position = (0, 0.05, -3)
    picture = look(renderer, scene)
    assert 0 < renderer.stats.views_drawn < 25
    assert_identical(picture, look(new_renderer(), scene))
    look(renderer, scene)
    assert renderer.stats.views_drawn == 0


def test_a_mirror_that_is_removed_opens_the_circle(new_renderer):
    scene, balls = room(2, bounces=3)
    renderer = new_renderer()
    look(renderer, scene)
    scene.remove(balls[1])
    picture = look(renderer, scene)
    assert renderer.stats.bounce_changes == ()
    assert_identical(picture, look(new_renderer(), scene))
    balls[0].environment.bounces = 2
    assert_identical(look(renderer, scene), picture)
    assert renderer.stats.views_drawn == 0


def test_memory_of_levels_is_given_back():
    """Many levels of one circle take the memory of those that another circle had before."""
    psutil = pytest.importorskip("psutil")
    process = psutil.Process()
    with cc.Renderer(device=DEVICE) as renderer:
        if not renderer.info.software:
            pytest.skip("textures lie in the memory of the GPU")
        rooms, used = [], []
        for _ in range(4):
            scene, balls = room(2, bounces=16)
            rooms.append((scene, balls))
            for ball in balls:
                ball.environment.size = 128
            look(renderer, scene)
            used.append(process.memory_info().rss)
            balls[0].environment.bounces = balls[1].environment.bounces = 1
            look(renderer, scene)
        # Each level has 16 bytes of colour and 4 of depth a texel. Of 16 levels, 15 are given back.
        level = 6 * 128**2 * 20
        assert used[3] - used[0] < 3 * 2 * 8 * level


# Policies count for all pictures of a probe together.


def moved(scene, step):
    scene.nodes[0].position = (0.05 * step, 0.8, 0.4)


@pytest.mark.parametrize("seen", ["both", "one"])
def test_once_draws_all_levels_the_first_time(new_renderer, seen):
    """Also if at first only the other mirror is in view, which shows one bounce less."""
    scene, balls = room(2, update="once", bounces=3)
    renderer, direct = new_renderer(), new_renderer()
    look(renderer, scene, ONE if seen == "one" else EYE)
    assert renderer.stats.probes_updated == 2
    want = look(direct, scene)
    moved(scene, 3)
    look(renderer, scene)
    assert renderer.stats.probes_updated == 0
    for ball in balls:
        assert_identical(
            renderer.read_probe(ball.environment).faces, direct.read_probe(ball.environment).faces
        )
    moved(scene, 0)
    assert_identical(look(renderer, scene), want)


def test_manual_draws_all_levels_when_told(new_renderer):
    scene, balls = room(2, update="manual", bounces=2)
    renderer, direct = new_renderer(), new_renderer()
    black = look(renderer, scene)
    for ball in balls:
        ball.environment.update = "on_change"
    want = look(direct, scene)
    for ball in balls:
        ball.environment.update = "manual"
    assert (want != black).any()
    renderer.update_probes(scene)
    assert (renderer.stats.views_drawn, renderer.stats.probes_updated) == (24, 2)
    assert len(renderer.stats.bounce_changes) == 1
    assert_identical(look(renderer, scene), want)
    # What was drawn stays, whatever its bounces are now, until the next update.
    for ball in balls:
        ball.environment.bounces = 3
    assert_identical(look(renderer, scene), want)
    assert renderer.stats.probes_updated == 0
    renderer.update_probes(scene, probes=balls[0].environment)
    assert (renderer.stats.views_drawn, renderer.stats.probes_updated) == (6, 1)
    for ball in balls:
        ball.environment.bounces = 1
    renderer.update_probes(scene)
    for ball in balls:
        ball.environment.update = "on_change"
    assert_identical(look(renderer, scene), look(new_renderer(), scene))


def test_a_manual_mirror_beside_one_that_follows(new_renderer):
    """The manual one is part of the circle, so the other one's first level shows it with the environment."""
    scene, mirrors = ring(2, bounces=2)
    mirrors[0].environment.update = "manual"
    renderer = new_renderer()
    renderer.update_probes(scene, probes=mirrors[0].environment)
    scene.environment = WHITE
    look(renderer, scene, ring_view(2))
    assert_close(held(renderer, mirrors[0])[0, 0], [product(2, 0, 2)] * 8, "lookup")
    # Mirror 1 shows mirror 0, which shows its first level, drawn in the old light.
    want = product(2, 0, 1) * TINTS[0]
    assert_close(held(renderer, mirrors[1])[0, 0], [want] * 8, "lookup")


def test_every_nth_call_counts_once_for_all_levels(new_renderer):
    scene, _ = room(2, update=3, bounces=3)
    renderer = new_renderer()
    updated = []
    for step in range(7):
        moved(scene, step)
        picture = look(renderer, scene)
        updated.append((renderer.stats.probes_updated, renderer.stats.bounce_changes != ()))
        if step == 6:
            assert_identical(picture, look(new_renderer(), scene))
    assert updated == [(2, True), (0, False), (0, False)] * 2 + [(2, True)]


def test_faces_per_frame_count_for_each_level(new_renderer):
    """After a change of all faces, three calls draw two faces of each level, and levels above follow."""
    scene, balls = room(2, faces_per_frame=2, bounces=2)
    renderer = new_renderer()
    look(renderer, scene)
    assert renderer.stats.views_drawn == 25
    scene.environment = cc.CubeMap(smooth_environment(8)[..., ::-1].copy())
    for _ in range(3):
        look(renderer, scene)
        assert renderer.stats.views_drawn == 1 + 4 * 2
    for _ in range(6):  # faces of level 2 that showed old faces of level 1
        picture = look(renderer, scene)
    assert renderer.stats.views_drawn == 0
    for ball in balls:
        ball.environment.faces_per_frame = 6
    assert_identical(picture, look(new_renderer(), scene))


def test_what_was_drawn_before_leaves_nothing_in_levels(new_renderer):
    scene, balls = room(2, bounces=2)
    renderer = new_renderer()
    look(renderer, scene)
    first = [renderer.read_probe(ball.environment).faces for ball in balls]
    moved(scene, 2)
    look(renderer, scene)
    moved(scene, 0)
    look(renderer, scene)
    for ball, faces in zip(balls, first, strict=True):
        assert_identical(renderer.read_probe(ball.environment).faces, faces)


# How much each round changes.


def directions_of_a_cube(size):
    """The directions of the texels of a cube, (6 * size * size, 3)."""
    s = (np.arange(size) + 0.5) / size * 2 - 1
    a, b = np.meshgrid(s, s)
    one = np.ones_like(a)
    return np.concatenate(
        [np.stack(axes, -1).reshape(-1, 3)
         for sign in (1, -1)
         for axes in ((sign * one, a, b), (a, sign * one, b), (a, b, sign * one))]
    )  # fmt: skip


@pytest.mark.parametrize("size", [16, 48])
def test_the_change_of_each_round(new_renderer, size):
    scene, balls = room(2)
    levels = []
    renderer = new_renderer()
    for ball in balls:
        ball.environment.size = size
    for bounces in (1, 2, 3):
        balls[0].environment.bounces = bounces
        look(renderer, scene)
        found = renderer.stats.bounce_changes
        levels.append([renderer.read_probe(ball.environment) for ball in balls])
    directions = directions_of_a_cube(32)
    want = []
    for less, more in itertools.pairwise(levels):
        squares = [
            (b.sample(directions)[..., :3].astype(float) - a.sample(directions)[..., :3]) ** 2
            for a, b in zip(less, more, strict=True)
        ]
        want.append(np.sqrt(np.mean(squares)))
    # The last call drew the third level alone, and compared all.
    assert found == pytest.approx(want, rel=1e-4)
    assert want[0] > 2 * want[1] > 0
    balls[0].material.tint = (0.2, 0.2, 0.2)
    look(renderer, scene)
    changed = renderer.stats.bounce_changes
    assert changed != pytest.approx(want, rel=1e-4)
    fresh = new_renderer()
    look(fresh, scene)
    assert fresh.stats.bounce_changes == changed
    assert "bounce_changes=(" in repr(fresh.stats)
    look(renderer, scene)
    assert renderer.stats.bounce_changes == ()
    assert "bounce_changes" not in repr(renderer.stats)


def test_rings_halve_the_change(renderer):
    """Mirrors that keep a half: the picture with one bounce more is half as bright everywhere."""
    scene, mirrors = ring(2, WHITE, bounces=4)
    for mirror in mirrors:
        mirror.material.tint = (0.5, 0.5, 0.5)
    look(renderer, scene, ring_view(2))
    assert renderer.stats.bounce_changes == pytest.approx((1 / 4, 1 / 8, 1 / 16))


def test_no_change_is_measured_without_bounces(new_renderer):
    scene, _ = room(2)
    renderer = new_renderer()
    look(renderer, scene)
    assert renderer.stats.bounce_changes == ()


def test_what_only_one_mirror_in_view_needs_is_not_compared(new_renderer):
    """A frame of one mirror needs its second level and the other's first: of neither are there two."""
    scene, balls = room(2, bounces=2)
    renderer = new_renderer()
    look(renderer, scene, ONE)
    assert renderer.stats.views_drawn == 13
    assert renderer.stats.bounce_changes == ()
    # The first level of the other one is what read_probe finds of it.
    want, _ = by_hand(renderer, scene, balls, 1)
    assert_identical(renderer.read_probe(balls[1].environment).faces, want[1], across="programs")


# The property.


def test_bounces_is_a_property():
    probe = cc.Probe(bounces=3)
    assert probe.bounces == 3
    assert "bounces=3" in repr(probe)
    assert "bounces" not in repr(cc.Probe())
    assert pickle.loads(pickle.dumps(probe)).bounces == 3
    probe.bounces = 16
    assert cc.Probe().bounces == 1
    for bad in (0, -1, 17):
        with pytest.raises(ValueError, match=f"expected bounces from 1 to 16, got {bad}"):
            cc.Probe(bounces=bad)
        with pytest.raises(ValueError, match=f"expected bounces from 1 to 16, got {bad}"):
            probe.bounces = bad
    with pytest.raises(TypeError):
        cc.Probe(bounces=1.5)  # type: ignore[arg-type]
    assert probe.bounces == 16
