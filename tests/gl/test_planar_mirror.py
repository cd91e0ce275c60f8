"""PlanarMirror: what a flat mirror shows equals the scene mirrored at its plane, in every kind of picture.

The reference is a scene without a mirror: everything in it, lights too, is moved by the matrix that mirrors the world.
"""

import copy
import gc
import pickle
from typing import Any, cast

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.images import sample_image
from tests.compare import assert_close, assert_identical
from tests.helpers import DEVICE, need_equal_pixels

SIZE = (60, 44)


def turn(axis, degrees):
    """Rodrigues' matrix of a turn."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


#: The frame of the mirror: it stands turned in the world, and its front is +Z of this frame.
FRAME = np.eye(4)
FRAME[:3, :3] = turn((1, 2, 0.5), 25)
FRAME[:3, 3] = (0.3, -0.2, 0.1)


def mirrored(plane):
    """The matrix that mirrors the world at z = 0 of a frame."""
    return plane @ np.diag([1.0, 1, -1, 1]) @ np.linalg.inv(plane)


def pane(width=4.0, height=3.0):
    corners: Any = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * (
        width / 2,
        height / 2,
        1,
    )
    return cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]], uvs=[[0, 0], [1, 0], [1, 1], [0, 1]])


def placed(x, y, z):
    made = np.eye(4)
    made[:3, 3] = (x, y, z)
    return made


def things(rng, kind):
    """(mesh, material, matrix in the mirror's frame): all before the mirror, and far enough from it."""
    for i in range(14):
        place = rng.uniform((-2, -0.8, 1.5), (0.3, 0.8, 2.6))
        color = rng.uniform(0.2, 1, 3)
        mesh = cc.Mesh.box(rng.uniform(0.3, 0.7, 3)) if i % 2 else cc.Mesh.sphere(0.3, 24, 12)
        material = (
            cc.PhongMaterial(color=color) if kind != "unlit" else cc.BasicMaterial(color=color)
        )
        if kind == "bright":
            material = cc.BasicMaterial(color=30 * color)
        yield mesh, material, placed(*place)
    if kind == "blended":
        for i in range(3):
            smoke = cc.BasicMaterial(color=rng.random(3), opacity=0.4)
            yield cc.Mesh.box(0.9), smoke, placed(0.4 * i - 1.5, 0.3, 2)
        glass = cc.StandardMaterial(
            color=(0.5, 1, 0.7), transmission=1, roughness=0, specular_weight=0, metallic=0
        )
        yield cc.Mesh.box((1, 0.8, 0.05)), glass, placed(-1.2, -0.2, 1.3)


def build(kind="lit", world=FRAME, change=None, seed=5):
    """The scene in the world, or changed by a matrix, which may mirror."""
    rng = np.random.default_rng(seed)
    change = np.eye(4) if change is None else change
    at = change @ world
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    for mesh, material, matrix in things(rng, kind):
        scene.add(mesh, material, matrix=at @ matrix)
    if kind in ("lit", "blended", "shadowed"):
        lamp = at @ (1.2, 1.5, 0.3, 1)
        shadow = cc.Shadow(size=512) if kind == "shadowed" else None
        scene.add(cc.PointLight(lamp[:3], shadow=shadow))
        scene.add(cc.DirectionalLight(at[:3, :3] @ (0.3, -1, -0.6), intensity=0.5))
        scene.add(cc.AmbientLight(intensity=0.3))
    return scene


def with_mirror(scene, world=FRAME, **options):
    material = options.pop("material", cc.MirrorMaterial())
    mesh = options.pop("mesh", pane())
    return scene.add(
        mesh, material, matrix=world, environment=cc.PlanarMirror(**options), name="mirror"
    )


def eye(world=FRAME, **more):
    place, aim = world @ (1.5, 0.3, 3, 1), world @ (0.1, 0.1, 0, 1)
    options = {"fov": 36, "position": place[:3], "target": aim[:3], "near": 0.1, "far": 60}
    return cc.PerspectiveCamera(**{**options, **more})


def parallel(world=FRAME):
    place, aim = world @ (1.7, 0.2, 3, 1), world @ (0.2, 0, 0, 1)
    return cc.OrthographicCamera(height=2.2, position=place[:3], target=aim[:3], near=0.1, far=60)


def away_from_edges(ids, normals):
    """Pixels whose neighbours show the same face of the same node: elsewhere rounding decides what is seen."""
    same = np.ones(ids.shape, bool)
    for axis in (-2, -1):
        for step in (1, -1):
            same &= np.roll(ids, step, axis) == ids
            near = np.roll(normals, step, axis - 1)
            same &= (np.abs(near - normals) < 0.4).all(axis=-1)
    same[..., 0, :] = same[..., -1, :] = same[..., :, 0] = same[..., :, -1] = False
    return same


def compare(renderer, kind, cameras, world=FRAME, tolerance="phong", **options):
    """Compare the pixels of the mirror with those of the mirrored scene."""
    scene, want = build(kind, world), build(kind, world, mirrored(world))
    mirror = with_mirror(scene, world)
    outputs = {"format": "rgba32f", "outputs": ("id", "normal"), **options}
    got = renderer.render(scene, cameras, SIZE, **outputs)
    expected = renderer.render(want, cameras, SIZE, **outputs)
    mask = (got.id == mirror.id) & away_from_edges(expected.id, expected.normal)
    mask &= away_from_edges(got.id, got.normal)
    assert (expected.id[mask] > 0).sum() > 80
    assert_close(got.color, expected.color, tolerance, mask=mask)


VIEWS = {
    "perspective": eye(),
    "shifted": eye(shift=(0.2, -0.3), pixel_aspect=1.2),
    "parallel": parallel(),
    "matrices": cc.Camera(view=eye().view, projection=eye(fov=30).projection(aspect=60 / 44)),
    "mirror image": cc.Camera(
        view=np.diag([-1.0, 1, 1, 1]) @ eye().view, projection=eye().projection(aspect=60 / 44)
    ),
}


@pytest.mark.parametrize("view", VIEWS)
def test_it_shows_the_mirrored_scene(any_path, view):
    compare(any_path, "lit", VIEWS[view])


@pytest.mark.parametrize("kind", ["unlit", "blended", "bright"])
def test_it_shows_all_kinds_of_surfaces(any_path, kind):
    compare(any_path, kind, eye())


def test_shadows(renderer):
    """Those of the mirrored scene lie in other texels of the map, so that their edges differ."""
    scene, want = build("shadowed"), build("shadowed", change=mirrored(FRAME))
    mirror = with_mirror(scene)
    got, expected, plain = (
        renderer.render(one, eye(), SIZE, format="rgba32f", outputs=["id", "normal"])
        for one in (scene, want, build(change=mirrored(FRAME)))
    )
    mask = (got.id == mirror.id) & away_from_edges(expected.id, expected.normal)
    mask &= expected.id > 0
    off = np.abs(got.color - expected.color).max(axis=-1)[mask]
    in_shadow = np.abs(plain.color - expected.color).max(axis=-1)[mask] > 0.02
    assert in_shadow.mean() > 0.04
    assert (off > 0.01).mean() < 0.02


def test_samples(renderer):
    compare(renderer, "lit", eye(), samples=4)


def test_stereo_pictures_have_a_mirror_for_each_eye(any_path):
    step = FRAME[:3, 0] * 0.2
    right = eye(position=eye().position + step, target=eye().target + step)
    both = cc.StereoCamera(eye(), right, layout="side_by_side")
    scene = build()
    with_mirror(scene)
    pair = any_path.render(scene, both, (120, 44), format="rgba32f").color
    alone = [any_path.render(scene, one, SIZE, format="rgba32f").color for one in (eye(), right)]
    assert_identical(pair, np.concatenate(alone, axis=1))
    assert np.abs(alone[0] - alone[1]).max() > 0.1


def test_far_from_the_origin_of_the_world(renderer):
    far = FRAME.copy()
    far[:3, 3] += (1e6, -1e6, 1e6)
    compare(renderer, "unlit", eye(far), far)


def test_what_lies_behind_the_mirror_does_not_show(renderer):
    scene = build()
    with_mirror(scene)
    want = renderer.render(scene, eye(), SIZE, outputs=["id"])
    # One thing behind the mirror, and one that goes through its plane beside it: half of it is cut off.
    scene.add(cc.Mesh.box((3, 2, 0.3)), cc.BasicMaterial(), matrix=FRAME @ placed(0, 0, -0.4))
    got = renderer.render(scene, eye(), SIZE, outputs=["id"])
    seen = got.id == want.id
    assert seen.mean() > 0.5
    assert_identical(got.color[seen], want.color[seen])


def test_what_stands_in_the_plane_is_cut_there(renderer):
    """A pole that goes through a mirror: the half before it and its mirror image look like the pole alone."""
    scene = cc.Scene(background=(0, 0, 0))
    pole = scene.add(
        cc.Mesh.box((0.3, 0.3, 2)), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, 0)
    )
    view = cc.PerspectiveCamera(fov=40, position=(2.5, 1, 3), target=(0, 0, 0))
    alone = renderer.render(scene, view, SIZE).color[..., 0]
    with_mirror(scene, np.eye(4), mesh=pane(8, 8))
    got = renderer.render(scene, view, SIZE, outputs=["id"])
    assert (got.id == pole.id).sum() < 0.7 * (alone == 255).sum()
    assert (got.color[..., 0] != alone).mean() < 0.01


def test_captures_show_mirrors(any_path):
    scene, want = build(), build(change=mirrored(FRAME))
    mirror = with_mirror(scene)
    place = (FRAME @ (0.9, 0.2, 1, 1))[:3]
    options = {"format": "rgba32f", "outputs": ("id", "normal")}
    got = any_path.capture(scene, place, 32, **options)
    expected = any_path.capture(want, place, 32, **options)
    mask = (got.id == mirror.id) & away_from_edges(expected.id, expected.normal)
    assert len(set(np.nonzero(mask)[0])) > 1
    # A cube looks up directions: those of the middles of texels, up to their rounding.
    assert_close(got.faces, expected.faces, "phong", mask=mask, least=0.02)


def test_captures_with_another_eye(renderer):
    """Reflections are seen from the eye: each point of the mirror shows what the eye sees there."""
    scene, want = build("unlit"), build("unlit", change=mirrored(FRAME))
    mirror = with_mirror(scene)
    place, other = (FRAME @ (0.4, 0.2, 3, 1))[:3], (FRAME @ (-0.3, 0, 2.6, 1))[:3]
    got = renderer.capture(
        scene, place, 48, eye=other, format="rgba32f", outputs=["id", "position"]
    )
    cube = renderer.capture(want, other, 48, format="rgba32f")
    on_mirror = got.id == mirror.id
    expected = cube.sample((got.position[on_mirror] - other).astype(np.float32))
    off = np.abs(got.faces[on_mirror] - expected)[..., :3].max(axis=-1)
    assert (
        off < 0.01
    ).mean() > 0.97  # the picture is a cube of the same size, drawn from the same place
    assert on_mirror.sum() > 500


def test_probes_and_render_textures_show_mirrors(renderer):
    scene = build()
    with_mirror(scene)
    place = (FRAME @ (0.4, 0.2, 3, 1))[:3]
    ball = scene.add(cc.Mesh.sphere(0.2), cc.MirrorMaterial(), position=place, in_captures=False)
    ball.environment = cc.Probe(parent=ball, size=24, near=0.1, far=60, format="rgba32f")
    renderer.render(scene, eye(target=place), SIZE)
    want = renderer.capture(scene, place, 24, near=0.1, far=60, format="rgba32f")
    assert_identical(renderer.read_probe(ball.environment).faces, want.faces)

    texture = cc.RenderTexture(scene, eye(), size=SIZE, format="rgba32f")
    screen = cc.Scene()
    screen.add(pane(), cc.BasicMaterial(map=texture))
    renderer.render(screen, cc.OrthographicCamera(height=3, position=(0, 0, 1)), SIZE)
    want = renderer.render(scene, eye(), SIZE, format="rgba32f")
    assert_identical(renderer.read_texture(texture), want.color)


def test_a_probe_sees_its_own_ball_in_the_mirror(renderer):
    """The ball is left out of its probe's views, which it would fill, but not of the mirror in them."""
    scene = cc.Scene(background=(0, 0, 0))
    ball = scene.add(
        cc.Mesh.sphere(0.3), cc.MirrorMaterial(color=(1, 0, 0), color_weight=1), position=(0, 0, 1)
    )
    ball.environment = cc.Probe(parent=ball, size=32)
    with_mirror(scene, np.eye(4))
    renderer.render(scene, eye(np.eye(4)), SIZE)
    face = renderer.read_probe(ball.environment).faces[5, ..., 0]  # towards -Z, to the mirror
    seen = np.degrees(np.arcsin(0.3 / 2))  # of its mirror image, two away
    share = np.pi * np.tan(np.radians(seen)) ** 2 / 4
    assert face.max() == 1
    assert abs((face > 0.5).mean() - share) < 0.01


def test_from_behind(renderer):
    scene = build()
    mirror = with_mirror(scene)
    back = eye(position=(FRAME @ (1.5, 0.3, -3, 1))[:3])
    renderer.render(scene, back, SIZE, outputs=["id"])
    assert renderer.stats.views_drawn == 1  # one side shows nothing
    mirror.material.double_sided = True
    turned = FRAME @ np.diag([1.0, 1, -1, 1])
    behind = build("unlit", turned)
    for node in scene.nodes[:-1]:
        scene.remove(node)
    for node in behind.nodes:
        scene.add(node.mesh, node.material, matrix=node.matrix)
    got = renderer.render(scene, back, SIZE, outputs=["id"], format="rgba32f")
    want = renderer.render(
        build("unlit", turned, mirrored(FRAME)),
        back,
        SIZE,
        outputs=["id", "normal"],
        format="rgba32f",
    )
    mask = (got.id == mirror.id) & away_from_edges(want.id, want.normal)
    assert (want.id[mask] > 0).mean() > 0.1
    assert_close(got.color, want.color, "half", mask=mask)


def facing(bounces, tilt=6.0):
    """Two mirrors that face each other, with boxes of one colour each between them."""
    rng = np.random.default_rng(3)
    scene = cc.Scene(background=(0.05, 0.1, 0.2))
    for _ in range(8):
        color = rng.integers(1, 256, 3) / 255
        place = rng.uniform((-1.2, -0.9, -1.4), (1.2, 0.9, 1.4))
        scene.add(
            cc.Mesh.box(rng.uniform(0.2, 0.5, 3)), cc.BasicMaterial(color=color), position=place
        )
    for z, angle in ((-2.5, 0), (2.5, 180 + tilt)):
        scene.add(
            pane(),
            cc.MirrorMaterial(),
            position=(0, 0, z),
            rotation=cc.axis_angle((0, 1, 0), angle),
            environment=cc.PlanarMirror(bounces=bounces),
        )
    return scene, cc.PerspectiveCamera(fov=65, position=(1.3, 0.3, 1.9), target=(0, 0, -2.5))


@pytest.mark.parametrize("bounces", [1, 2, 3, 4])
def test_facing_mirrors_equal_exact_rays(any_path, bounces):
    """Boxes have one colour each, so that a pixel whose neighbours have its colour shows no silhouette."""
    pytest.importorskip("embreex")
    scene, camera = facing(bounces)
    got = any_path.render(scene, camera, (96, 80), format="rgba32f").color[..., :3]
    want = cc.truth.render(
        scene, camera, (96, 80), bounces=bounces, samples=1, processes=1, progress=False
    ).color[..., :3]
    inner = np.ones(want.shape[:2], bool)
    for step in ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
        inner &= (np.abs(np.roll(want, step, (0, 1)) - want) < 1e-3).all(axis=-1)
    assert inner.mean() > 0.6
    assert np.abs(got - want)[inner].max() < 1 / 255
    # Along silhouettes only the side of an edge may differ.
    assert (np.abs(got - want).max(axis=-1) > 1 / 255).mean() < 0.005
    assert any_path.stats.views_drawn == 1 + bounces


def test_after_the_last_bounce_there_is_the_environment(renderer, rng):
    """As with truth: mirrors beyond it show the scene's environment where rays would meet another mirror."""
    pytest.importorskip("embreex")
    scene, camera = facing(2)
    scene.environment = cc.CubeMap(np.full((6, 4, 4, 3), 0.7, np.float32))
    got = renderer.render(scene, camera, SIZE, format="rgba32f").color[..., :3]
    options: dict[str, Any] = {"samples": 1, "processes": 1, "progress": False}
    want = cc.truth.render(scene, camera, SIZE, bounces=2, **options).color[..., :3]
    assert (np.abs(got - want).max(axis=-1) > 1 / 255).mean() < 0.01
    assert (np.abs(want - 0.7) < 1e-3).all(axis=-1).mean() > 0.005


def test_mirrors_may_have_different_bounces(renderer):
    scene, camera = facing(1)
    *_, first, second = scene.nodes
    renderer.render(scene, camera, SIZE)
    assert renderer.stats.views_drawn == 2  # the frame, and the first mirror in it
    second.environment.bounces = 2
    renderer.render(scene, camera, SIZE)
    assert renderer.stats.views_drawn == 3  # and the second one in the first
    first.environment.bounces = 3
    renderer.render(scene, camera, SIZE)
    assert renderer.stats.views_drawn == 4


def test_too_many_mirrors_in_mirrors(fresh_renderer):
    scene, mirrors = cc.Scene(), []
    for angle in range(0, 360, 30):
        spin = np.eye(4)
        spin[:3, :3] = turn((0, 1, 0), angle)
        wall = spin @ placed(0, 0, -3)
        mirrors.append(cc.PlanarMirror(bounces=12))
        scene.add(pane(1.5, 3), cc.MirrorMaterial(), matrix=wall, environment=mirrors[-1])
    camera = cc.PerspectiveCamera(fov=90, position=(0, 0, 0), target=(0, 0, -1))
    with pytest.raises(ValueError, match="at most 256 pictures of mirrors in mirrors"):
        fresh_renderer.render(scene, camera, (16, 12))
    for mirror in mirrors:
        mirror.bounces = 2
    fresh_renderer.render(scene, camera, (16, 12))


def test_the_sky_is_mirrored(renderer, rng):
    """Numpy: the direction of each pixel, mirrored, in the background."""
    cube = cc.CubeMap(rng.random((6, 8, 8, 3)).astype(np.float32))
    scene = cc.Scene(background=cube)
    with_mirror(scene, mesh=pane(40, 40))
    frame = renderer.render(scene, eye(), SIZE, format="rgba32f", outputs=["id"])
    camera, half = eye(), np.tan(np.radians(18))
    x = ((np.arange(60) + 0.5) / 30 - 1) * half * 60 / 44
    y = (1 - (np.arange(44) + 0.5) / 22) * half
    ray = np.stack([*np.meshgrid(x, y), -np.ones((44, 60))], axis=-1) @ camera.view[:3, :3]
    seen = ray @ mirrored(FRAME)[:3, :3].T
    assert (frame.id == 1).all()
    assert_close(frame.color[..., :3], cube.sample(seen.astype(np.float32))[..., :3], "half")


def test_all_nodes_that_captures_show(renderer):
    scene = build("unlit")
    with_mirror(scene)
    wide = {"camera": eye(fov=100), "size": SIZE, "outputs": ["id"], "format": "rgba32f"}
    ids = renderer.render(scene, **wide).id
    number = int(np.bincount(ids[(ids > 0) & (ids < 15)]).argmax()) - 1
    hidden = scene.nodes[number]
    want_scene = copy.deepcopy(scene)
    want_scene.remove(want_scene.nodes[number])
    want = renderer.render(want_scene, **wide)
    hidden.in_captures = False
    got = renderer.render(scene, **wide)
    mirror = got.id == scene.nodes[-1].id
    assert (got.id == hidden.id).any()  # the frame shows it
    assert_identical(got.color[mirror], want.color[mirror])
    hidden.in_captures = True
    place = (FRAME @ (0.4, 0.2, 3, 1))[:3]
    cube = renderer.capture(scene, place, 24, exclude=[hidden], format="rgba32f").faces
    assert_identical(cube, renderer.capture(want_scene, place, 24, format="rgba32f").faces)


# ---------------------------------------------------------------- what is drawn, and when


def test_unchanged_it_draws_nothing_and_changes_draw_what_they_touch(fresh_renderer):
    need_equal_pixels()
    scene, camera = facing(2)
    box, mirror = scene.nodes[0], scene.nodes[-2]
    steps = (
        lambda: setattr(box, "position", np.add(box.position, (0.2, 0, 0))),
        lambda: setattr(mirror, "position", np.add(mirror.position, (0, 0, 0.1))),
        lambda: setattr(mirror, "rotation", cc.axis_angle((0, 1, 0), 3)),
        lambda: setattr(mirror, "matrix", mirror.matrix @ np.diag([-1.0, 1, 1, 1])),
        lambda: setattr(mirror.environment, "bounces", 1),
        lambda: setattr(mirror, "visible", False),
        lambda: setattr(mirror, "visible", True),
        lambda: setattr(box, "material", cc.PhongMaterial()),
        lambda: scene.add(cc.PointLight((0, 1, 0), shadow=cc.Shadow(size=32))),
        lambda: setattr(mirror, "environment", None),
        lambda: setattr(scene, "background", (1, 0, 0)),
    )
    for step in (None, *steps):
        if step is not None:
            step()
        got = fresh_renderer.render(scene, camera, SIZE, samples=1).color
        cube = fresh_renderer.capture(scene, (0, 0, 0), 12).faces
        with cc.Renderer(device=DEVICE) as scratch:
            assert_identical(got, scratch.render(scene, camera, SIZE).color)
            assert_identical(cube, scratch.capture(scene, (0, 0, 0), 12).faces)
        fresh_renderer.render(scene, camera, SIZE)
        assert fresh_renderer.stats.views_drawn == 0


def test_tiles_in_one_plane_are_one_mirror(fresh_renderer):
    scene, whole = build(), build()
    with_mirror(whole)
    shared = cc.PlanarMirror()
    for x in (-1, 1):
        scene.add(
            pane(2, 3), cc.MirrorMaterial(), matrix=FRAME @ placed(x, 0, 0)
        ).environment = shared
    got = fresh_renderer.render(scene, eye(), SIZE, format="rgba32f").color
    assert fresh_renderer.stats.views_drawn == 2
    want = fresh_renderer.render(whole, eye(), SIZE, format="rgba32f").color
    assert (np.abs(got - want).max(axis=-1) > 1e-4).mean() < 0.01
    scene.nodes[-1].position = scene.nodes[-1].position + 0.2
    fresh_renderer.render(scene, eye(), SIZE)
    assert fresh_renderer.stats.views_drawn == 3  # in two planes now


@pytest.mark.parametrize("scale", [(-1.0, 1, 1), (1, -0.5, 2), (-1, -1, -1), (1, 1, -3)])
def test_a_node_may_mirror_its_mesh(renderer, scale):
    """The front stays the side that other materials show, wherever a matrix with a negative determinant puts it."""
    scene, want = build(), build()
    mirror, plain = with_mirror(scene, mesh=pane(4, 4)), with_mirror(want, mesh=pane(4, 4))
    mirror.matrix = FRAME @ np.diag([*scale, 1.0])
    frame = renderer.render(scene, eye(), SIZE, format="rgba32f", outputs=["id"])
    mirror.material, mirror.environment = cc.BasicMaterial(), None
    shown = renderer.render(scene, eye(), SIZE, outputs=["id"]).id == mirror.id
    assert_identical(frame.id == mirror.id, shown)
    expected = renderer.render(want, eye(), SIZE, format="rgba32f", outputs=["id"])
    mask = shown & (expected.id == plain.id)
    assert shown.any() == (scale[2] > 0)
    if shown.any():
        assert_close(frame.color, expected.color, "half", mask=mask)
        assert renderer.stats.views_drawn == 2


def test_a_mirror_follows_its_parent(renderer):
    scene, want = build(), build()
    carrier = scene.add(position=(0.3, 0.1, -0.2))
    node = scene.add(pane(), cc.MirrorMaterial(), parent=carrier, environment=cc.PlanarMirror())
    renderer.render(scene, eye(), SIZE)
    carrier.matrix = FRAME
    with_mirror(want)
    got = renderer.render(scene, eye(), SIZE, format="rgba32f").color
    assert_identical(got, renderer.render(want, eye(), SIZE, format="rgba32f").color)
    assert node.environment.bounces == 1


def test_out_of_view_it_costs_nothing(renderer):
    scene = build()
    with_mirror(scene)
    renderer.render(scene, eye(target=(FRAME @ (0.9, 0.5, 9, 1))[:3]), SIZE)
    assert renderer.stats.views_drawn == 1


# ---------------------------------------------------------------- materials


def shaded(renderer, material, **options):
    scene = build("unlit")
    mirror = with_mirror(scene, material=material, **options)
    frame = renderer.render(scene, eye(), SIZE, format="rgba32f", outputs=["id"])
    return frame.color[..., :3], frame.id == mirror.id


def test_every_material_that_has_an_environment_shows_it(any_path):
    want, mask = shaded(any_path, cc.MirrorMaterial())
    polished = cc.StandardMaterial(metallic=1, roughness=0, color=(1, 1, 1))
    users = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment(reflect(s.incident, s.normal)); }"
    )
    mixed = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment_lod(3.0 * reflect(s.incident, s.normal), 0.0); }"
    )
    for material in (polished, users, mixed):
        got, _ = shaded(any_path, material)
        assert_close(got, want, "half", mask=mask)
    # Head-on, glass of ior 1.5 reflects 4 %, and more at other angles.
    got, _ = shaded(any_path, cc.GlassMaterial())
    lit = mask & (want.max(axis=-1) > 0.3)
    share = (got[lit] / np.maximum(want[lit], 1e-3)).max(axis=-1)
    assert 0.039 < share.min() < share.max() < 0.2


def test_light_through_the_plane_is_the_environments(renderer):
    """Refracted rays leave through the back: the picture of the mirror knows nothing of what is there."""
    scene = cc.Scene(background=(0, 0, 0), environment=cc.CubeMap(np.full((6, 2, 2, 3), 0.5)))
    with_mirror(scene, material=cc.GlassMaterial(fresnel=False))
    frame = renderer.render(scene, eye(), SIZE, format="rgba32f", outputs=["id"])
    mask = frame.id == 1
    assert_close(frame.color[..., :3], np.full((44, 60, 3), 0.5), "half", mask=mask)


def pixel_places(points, camera, size):
    """(u, v) in pixels from the upper left corner at which a perspective camera sees points of the world."""
    at = points @ camera.view[:3, :3].T + camera.view[:3, 3]
    width, height = size
    scale = height / 2 / np.tan(np.radians(camera.fov / 2))
    return np.stack(
        [
            width / 2 + scale * at[..., 0] / -at[..., 2],
            height / 2 - scale * at[..., 1] / -at[..., 2],
        ],
        -1,
    )


@pytest.mark.parametrize("distance", [0.5, 2.0])
def test_bent_rays_are_looked_up_at_the_distance(any_path, distance):
    """Numpy: the end of the ray, mirrored at the plane, is projected into a picture of the mirrored scene."""
    bend = (0.12, -0.08, 0.05)
    bent = cc.ShaderMaterial(
        "uniform vec3 bend; vec3 shade(Surface s) {"
        " return environment(normalize(reflect(s.incident, s.normal) + bend)); }",
        uniforms={"bend": bend},
    )
    scene = build("unlit")
    mirror = with_mirror(scene, material=bent, distance=distance)
    camera = eye()
    frame = any_path.render(scene, camera, SIZE, format="rgba32f", outputs=["id", "position"])
    flat = any_path.render(
        build("unlit", change=mirrored(FRAME)), camera, SIZE, format="rgba32f"
    ).color[..., :3]
    incident = frame.position - camera.position
    incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
    normal = FRAME[:3, 2]
    ray = incident - 2 * (incident @ normal)[..., None] * normal + bend
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    ends = frame.position + distance * ray
    ends = ends @ mirrored(FRAME)[:3, :3].T + mirrored(FRAME)[:3, 3]
    uv = pixel_places(np.nan_to_num(ends), camera, SIZE) / SIZE
    want = sample_image(flat, np.stack([uv[..., 0], 1 - uv[..., 1]], axis=-1), "clamp")
    mask = (frame.id == mirror.id) & (np.abs(uv - 0.5) < 0.45).all(axis=-1)
    off = np.abs(frame.color[..., :3] - want).max(axis=-1)[mask]
    assert mask.mean() > 0.1
    assert (off < 0.01).mean() > 0.99
    assert np.abs(frame.color[..., :3] - flat).max(axis=-1)[mask].mean() > 0.01


def test_rays_that_leave_the_picture_see_its_border(renderer):
    bent = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment(reflect(s.incident, s.normal) + vec3(2.0, 0.0, 0.0)); }"
    )
    scene = cc.Scene(background=(0.2, 0.4, 0.8))
    mirror = with_mirror(scene, np.eye(4), material=bent)
    frame = renderer.render(scene, eye(np.eye(4)), SIZE, format="rgba32f", outputs=["id"])
    want = np.broadcast_to(np.array((0.2, 0.4, 0.8), np.float32), (44, 60, 3))
    assert_close(frame.color[..., :3], want, "half", mask=frame.id == mirror.id)


@pytest.mark.parametrize("roughness", [0.2, 0.5])
def test_rough_mirrors_look_up_a_level_of_the_mipmaps(renderer, roughness):
    """Numpy: head-on, level log2(1 + width of the lobe at the distance, in pixels)."""
    size, distance, away = (64, 64), 1.5, 4.0
    rough = cc.ShaderMaterial(
        "uniform float r; vec3 shade(Surface s) { return environment_filtered(reflect(s.incident, s.normal), r); }",
        uniforms={"r": roughness},
    )
    scene, want = build("unlit", np.eye(4)), build("unlit", np.eye(4), np.diag([1.0, 1, -1, 1]))
    with_mirror(scene, np.eye(4), mesh=pane(30, 30), material=rough, distance=distance)
    camera = cc.OrthographicCamera(height=3, position=(0, 0, away), target=(0, 0, 0), near=0.01)
    frame = renderer.render(scene, camera, size, format="rgba32f", outputs=["id"])
    flat = renderer.render(want, camera, size, format="rgba32f").color[..., :3].astype(float)
    levels = [flat]
    for _ in range(6):
        half = levels[-1].shape[0] // 2
        levels.append(levels[-1].reshape(half, 2, half, 2, 3).mean(axis=(1, 3)))
    alpha = roughness**2
    spread = 2 * alpha / (1 - alpha**2)
    level = np.log2(1 + 2 * spread * distance * 64 / 3)
    at = (np.arange(64) + 0.5) / 64
    uv = np.stack(np.meshgrid(at, at[::-1]), axis=-1)
    low, share = int(level), level % 1
    expected = (1 - share) * sample_image(levels[low], uv, "clamp")
    expected += share * sample_image(levels[low + 1], uv, "clamp")
    mask = frame.id == scene.nodes[-1].id
    off = np.abs(frame.color[..., :3] - expected).max(axis=-1)[mask]
    assert off.max() < 0.01
    assert level > 0.5


# ---------------------------------------------------------------- errors and copies


@pytest.mark.parametrize(
    ("mesh", "message"),
    [
        (cc.Mesh.box(1), r"one of size 1.73\d* with a vertex 0.5\d* off the plane"),
        (
            cc.Mesh(
                np.array([[0, 0, 0], [1, 0, 0], [1, 1, 1e-3], [0, 1, 0]]), [[0, 1, 2], [0, 2, 3]]
            ),
            "with a vertex",
        ),
        (cc.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]), "no area"),
    ],
)
def test_a_mesh_that_is_not_flat_is_an_error(renderer, mesh, message):
    scene = cc.Scene()
    node = scene.add(mesh, cc.MirrorMaterial(), environment=cc.PlanarMirror())
    with pytest.raises(
        ValueError, match=f"node {node.id}: expected a PlanarMirror on a flat mesh.*{message}"
    ):
        renderer.render(scene, eye(), SIZE)
    node.mesh = pane()
    renderer.render(scene, eye(), SIZE)


def test_small_and_far_meshes_may_be_flat(renderer):
    """Floats of a mesh far from its own origin have steps of their own; a small mesh has no smaller ones."""
    tilted = turn((1, 2, 3), 50)
    for scale, shift in ((1e-4, 0.0), (1e4, 0.0), (1.0, 1e3)):
        mesh = cc.Mesh((pane().positions * scale) @ tilted.T + shift, pane().indices)
        scene = cc.Scene()
        scene.add(mesh, cc.MirrorMaterial(), environment=cc.PlanarMirror())
        renderer.render(scene, eye(), SIZE)


def test_only_the_environment_of_a_node_may_be_one():
    mirror = cc.PlanarMirror()
    with pytest.raises(TypeError, match="cubemap: expected a CubeMap"):
        cc.BasicMaterial(cubemap=cast("cc.Probe", mirror))
    with pytest.raises(TypeError, match="environment"):
        cc.Scene(environment=cast("cc.CubeMap", mirror))
    with pytest.raises(
        TypeError,
        match=r"environment: expected a CubeMap .*, a Probe, a ProbeBlend, a PlanarMirror or None",
    ):
        cc.Scene().add(pane(), environment=cast("cc.Probe", 3))


def test_values_and_copies(tmp_path):
    mirror = cc.PlanarMirror(bounces=3, distance=0.5)
    assert repr(mirror) == "PlanarMirror(bounces=3, distance=0.5)"
    again = pickle.loads(pickle.dumps(mirror))
    assert (again.bounces, again.distance) == (3, 0.5)
    scene = build()
    node = with_mirror(scene, bounces=2)
    held = pickle.loads(pickle.dumps(scene)).nodes[-1].environment
    assert held.bounces == 2
    assert node.environment is node.environment
    scene.save(tmp_path / "scene.glb")
    loaded = [node for node in cc.load_scene(tmp_path / "scene.glb").nodes if node.name == "mirror"]
    assert repr(loaded[0].environment) == repr(node.environment)
    assert "PlanarMirror, 2 bounces" in node._repr_html_()
    for values in ({"bounces": 0}, {"distance": 0}, {"distance": np.inf}):
        with pytest.raises(ValueError, match="expected"):
            cc.PlanarMirror(**values)
    with pytest.raises(ValueError, match="bounces of at least 1, got 0"):
        mirror.bounces = 0
    assert mirror.bounces == 3


def test_pictures_are_freed_with_their_scene(fresh_renderer):
    scene = build()
    with_mirror(scene)
    fresh_renderer.render(scene, eye(), SIZE)
    mirror = scene.nodes[-1].environment
    del scene
    gc.collect()
    fresh_renderer.render(build(), eye(), SIZE)
    assert fresh_renderer.stats.views_drawn == 1
    assert mirror.bounces == 1
