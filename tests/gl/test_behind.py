"""The scene behind transmissive surfaces: a picture of the same view without them, in every kind of picture."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.images import sample_image
from tests.compare import assert_identical
from tests.helpers import DEVICE, need_equal_pixels

SIZE = (48, 36)


def pane(**options):
    """A surface without reflection: what it transmits is all that it shows."""
    plain = {
        "transmission": 1,
        "metallic": 0,
        "roughness": 0,
        "specular_weight": 0,
        "double_sided": True,
    }
    return cc.StandardMaterial(**{**plain, **options})


def world(rng, background=None):
    """Coloured boxes all around the origin, and a mirror; no surface is lit."""
    cube = cc.CubeMap(rng.random((6, 4, 4, 3)).astype(np.float32) * 0.5)
    scene = cc.Scene(environment=cube, background=background)
    for i in range(40):
        direction = rng.normal(size=3)
        place = direction / np.linalg.norm(direction) * rng.uniform(4, 7)
        scene.add(
            cc.Mesh.box(rng.uniform(0.5, 1.5, 3)),
            cc.BasicMaterial(color=2 * rng.random(3)),
            position=place,
            name=f"box {i}",
        )
    scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, 0.3, -5), name="mirror")
    return scene


def camera(**more):
    return cc.PerspectiveCamera(
        **{"fov": 60, "position": (0, 0, 0), "target": (0.2, 0.1, -1), **more}
    )


def shell(scene, material=None, **place):
    """Panes all around the origin, nearer than all else."""
    return scene.add(cc.Mesh.box(3), material or pane(), **place)


PICTURES = {
    "frame": lambda renderer, scene: renderer.render(scene, camera(), SIZE, format="rgba32f").color,
    "samples": lambda renderer, scene: (
        renderer.render(scene, camera(), SIZE, format="rgba32f", samples=4).color
    ),
    "parallel": lambda renderer, scene: (
        renderer.render(
            scene,
            cc.OrthographicCamera(height=5, position=(0.3, 0, 0), target=(0, 0, -1), near=0.1),
            SIZE,
            format="rgba32f",
        ).color
    ),
    "stereo": lambda renderer, scene: (
        renderer.render(
            scene,
            cc.StereoCamera(
                camera(), camera(position=(0.3, 0, 0), target=(0.5, 0.1, -1)), layout="side_by_side"
            ),
            (96, 36),
            format="rgba32f",
        ).color
    ),
    "graded": lambda renderer, scene: (
        renderer.render(
            scene, camera(), SIZE, tonemap="reinhard", encode="srgb", format="rgba32f"
        ).color
    ),
    "capture": lambda renderer, scene: renderer.capture(scene, (0.2, 0.1, 0), 24).faces,
}


@pytest.mark.parametrize("kind", PICTURES)
def test_a_clear_pane_changes_nothing(any_path, rng, kind):
    scene = world(rng)
    want = PICTURES[kind](any_path, scene)
    shell(scene)
    got = PICTURES[kind](any_path, scene)
    # Half floats have 11 bits. With samples the edges of the box itself are averages of equal pixels.
    np.testing.assert_allclose(got, want, rtol=2e-3, atol=2e-3)
    assert want[..., :3].std() > 0.05


def mirror_of(scene, **probe):
    """A ball in front of the camera whose probe sees the world."""
    ball = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(0, 0, -1.2), name="ball")
    ball.environment = cc.Probe((0.1, 0, 0.2), size=24, format="rgba32f", **probe)
    return ball


def test_a_probe_sees_through_panes(any_path, rng):
    scene = world(rng)
    mirror_of(scene)
    want = PICTURES["frame"](any_path, scene)
    # The camera sees the ball directly, and panes behind it; the probe sees the world through panes.
    shell(scene, position=(0.1, 0, 0.2))
    got = PICTURES["frame"](any_path, scene)
    np.testing.assert_allclose(got, want, rtol=2e-3, atol=2e-3)


def test_a_render_texture_sees_through_panes(any_path, rng):
    inner = world(rng)
    texture = cc.RenderTexture(inner, camera(), size=(48, 36), format="rgba32f")
    screen = cc.Scene()
    corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    uvs = [[0, 0], [1, 0], [1, 1], [0, 1]]
    screen.add(cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]], uvs=uvs), cc.BasicMaterial(map=texture))
    view = cc.OrthographicCamera(height=2, position=(0, 0, 1), target=(0, 0, 0))
    want = any_path.render(screen, view, (36, 36), format="rgba32f").color
    node = shell(inner)
    got = any_path.render(screen, view, (36, 36), format="rgba32f").color
    np.testing.assert_allclose(got, want, rtol=2e-3, atol=2e-3)
    texture.size = (32, 24)  # its picture is made again, that behind it, too
    node.position = (0.1, 0, 0)
    got = any_path.render(screen, view, (36, 36), format="rgba32f").color
    with cc.Renderer(device=DEVICE) as fresh:
        assert_identical(got, fresh.render(screen, view, (36, 36), format="rgba32f").color)


def test_the_colour_tints_what_is_behind(renderer, rng):
    scene = world(rng)
    want = PICTURES["frame"](renderer, scene)
    shell(scene, pane(color=(0.5, 0.25, 1)))
    got = PICTURES["frame"](renderer, scene)
    np.testing.assert_allclose(got[..., :3], want[..., :3] * (0.5, 0.25, 1), rtol=3e-3, atol=2e-3)


def test_light_above_one_is_kept(renderer):
    scene = cc.Scene(background=(30, 20, 10))
    shell(scene, pane(color=(1, 0.1, 0.1)))
    got = PICTURES["frame"](renderer, scene)
    np.testing.assert_allclose(
        got[..., :3], np.broadcast_to((30, 2, 1), got[..., :3].shape), rtol=2e-3
    )


@pytest.mark.parametrize(("roughness", "level"), [(0.2, 1.2), (0.5, 3), (2 / 3, 4), (1, 6)])
def test_rough_panes_look_up_the_level_of_their_roughness(any_path, rng, roughness, level):
    """log2(64) * roughness levels up, each a mean of 2 x 2 texels of the one below."""
    scene = world(rng)
    picture = (
        any_path.render(scene, camera(), (64, 64), format="rgba32f").color[..., :3].astype(float)
    )
    levels = [picture]
    for _ in range(6):
        half = levels[-1].shape[0] // 2
        levels.append(levels[-1].reshape(half, 2, half, 2, 3).mean(axis=(1, 3)))
    shell(scene, pane(roughness=roughness))
    got = any_path.render(scene, camera(), (64, 64), format="rgba32f").color[..., :3]
    at = (np.arange(64) + 0.5) / 64
    uv = np.stack(np.meshgrid(at, at[::-1]), axis=-1)
    low, share = int(np.floor(level)), level % 1
    want = (1 - share) * sample_image(levels[low], uv, "clamp")
    if share:
        want = want + share * sample_image(levels[low + 1], uv, "clamp")
    np.testing.assert_allclose(got, want, atol=0.01 if share else 4e-3)


def test_thick_panes_show_what_is_where_the_ray_leaves_them(renderer, rng):
    """A wall across the view bends each ray; the exit is looked up where the camera sees it."""
    scene = world(rng)
    eye = camera(target=(0, 0, -1))
    clear = renderer.render(scene, eye, (64, 64), format="rgba32f").color[..., :3]
    corners = [[-9, -9, -2], [9, -9, -2], [9, 9, -2], [-9, 9, -2]]
    wall = cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]])
    ior, thickness, scale = 1.5, 0.4, 2.0
    scene.add(
        wall, pane(ior=ior, thickness=thickness), scale=(scale, scale, scale), position=(0, 0, 2)
    )
    got = renderer.render(scene, eye, (64, 64), format="rgba32f").color[..., :3]
    half = np.tan(np.radians(30))
    at = ((np.arange(64) + 0.5) / 32 - 1) * half
    x, y = np.meshgrid(at, -at)
    ray = np.stack([x, y, -np.ones_like(x)], axis=-1)
    point = 2 * ray  # on the wall, at z = -2
    inside = ray / np.linalg.norm(ray, axis=-1, keepdims=True) / ior
    inside[..., 2] = -np.sqrt(1 - (inside[..., :2] ** 2).sum(axis=-1))
    leaves = point + thickness * scale * inside
    uv = 0.5 + 0.5 * leaves[..., :2] / -leaves[..., 2:] / half
    want = sample_image(clear, uv, "clamp")
    # All exits appear nearer to the middle than their entries, so that all are in the picture.
    assert (np.abs(uv - 0.5) < 0.5).all()
    np.testing.assert_allclose(got, want, atol=6e-3)
    assert np.abs(got - clear).max() > 0.3


def test_outside_of_the_picture_there_is_the_environment(renderer):
    """A wall of low index bends rays away from the middle: near the border their exits are out of view."""
    color = np.array([0.2, 0.5, 0.9], np.float32)
    scene = cc.Scene(
        environment=cc.CubeMap(np.broadcast_to(color, (6, 2, 2, 3)).copy()), background=(0, 0, 0)
    )
    corners = [[-9, -9, -2], [9, -9, -2], [9, 9, -2], [-9, 9, -2]]
    slope = cc.Mesh(corners, [[0, 1, 2], [0, 2, 3]], normals=[[0.7, 0, 0.7]] * 4)
    scene.add(slope, pane(ior=1.5, thickness=6))
    got = renderer.render(scene, camera(target=(0, 0, -1)), (32, 32), format="rgba32f").color[
        16, :, :3
    ]
    seen = (np.abs(got) < 0.01).all(axis=-1)
    around = (np.abs(got - color) < 0.01).all(axis=-1)
    assert (seen | around).all()
    assert 2 < around.sum() < 30


def test_panes_do_not_show_through_each_other(renderer, rng):
    scene = world(rng)
    want = PICTURES["frame"](renderer, scene)
    scene.add(cc.Mesh.box(3.4), pane(color=(0, 1, 0)))
    shell(scene, pane(color=(1, 0.5, 1)))
    got = PICTURES["frame"](renderer, scene)
    np.testing.assert_allclose(got[..., :3], want[..., :3] * (1, 0.5, 1), rtol=3e-3, atol=2e-3)


def test_what_a_capture_excludes_is_not_behind_either(renderer, rng):
    scene = world(rng)
    hidden = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(9, 0, 0)), position=(0, 0, -3))
    want = renderer.capture(scene, (0, 0, 0), 16, exclude=[hidden]).faces
    shell(scene)
    got = renderer.capture(scene, (0, 0, 0), 16, exclude=[hidden]).faces
    np.testing.assert_allclose(got, want, rtol=2e-3, atol=2e-3)


def test_blended_surfaces_are_behind(renderer, rng):
    scene = world(rng)
    scene.add(
        cc.Mesh.plane(2, 2),
        cc.BasicMaterial(color=(1, 0, 0), opacity=0.4),
        position=(0, 0, -3),
        rotation=cc.axis_angle((1, 0, 0), 90),
    )
    want = PICTURES["frame"](renderer, scene)
    shell(scene)
    np.testing.assert_allclose(PICTURES["frame"](renderer, scene), want, rtol=2e-3, atol=2e-3)


@pytest.mark.parametrize("depth_format", ["depth_component16", "depth24_stencil8", None])
def test_depth_buffers(renderer, rng, depth_format):
    scene = world(rng)
    node = shell(scene)
    if depth_format is None:
        node.render_order = 1  # without a depth buffer the order of drawing decides

    def draw():
        return renderer.render(
            scene, camera(), SIZE, format="rgba32f", depth_format=depth_format
        ).color

    got = draw()
    node.visible = False
    np.testing.assert_allclose(got, draw(), rtol=2e-3, atol=2e-3)


def test_outputs_are_those_of_the_pane(renderer, rng):
    scene = world(rng)
    node = shell(scene)
    frame = renderer.render(scene, camera(), SIZE, outputs=("id", "distance"))
    assert (frame.id == node.id).all()
    only = renderer.render(scene, camera(), SIZE, outputs=("id",), format=None)
    assert only.color is None
    assert (only.id == node.id).all()
    assert renderer.stats.views_drawn == 1  # without a colour nothing is looked up


def test_counts(fresh_renderer, rng):
    """(drawn, skipped) views after each change: of the frame, and of what is behind it."""
    scene = world(rng)
    seen = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -4))
    back = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, 6))

    def drawn():
        PICTURES["frame"](fresh_renderer, scene)
        return fresh_renderer.stats.views_drawn, fresh_renderer.stats.views_skipped

    assert drawn() == (1, 0)
    node = shell(scene)
    assert drawn() == (2, 0)
    assert drawn() == (0, 2)
    back.position = (0, 0, 7)
    assert drawn() == (0, 2)
    seen.position = (0.1, 0, -4)
    assert drawn() == (2, 0)
    node.position = (0.1, 0, 0)
    assert drawn() == (1, 1)
    node.position = (0, 0, 9)
    assert drawn() == (1, 0)
    fresh_renderer.capture(scene, (0, 0, 0), 8)
    assert fresh_renderer.stats.views_drawn == 12
    node.visible = False
    fresh_renderer.capture(scene, (0, 0, 0), 8)
    assert fresh_renderer.stats.views_drawn == 1  # one face shows the pane no more


def test_pictures_after_changes_equal_pictures_from_scratch(renderer, rng):
    scene = world(rng)
    mirror_of(scene)
    panes = [
        scene.add(cc.Mesh.sphere(0.5), pane(thickness=0.4, roughness=0.2), position=(-0.8, 0, -2)),
        scene.add(
            cc.Mesh.box(0.8), pane(ior=1.3, dispersion=2, thickness=0.3), position=(0.9, 0.2, -2)
        ),
    ]
    box = scene.add(cc.Mesh.box(0.7), cc.BasicMaterial(color=(1, 0, 1)), position=(-0.9, 0.1, -3.5))
    kinds = ("frame", "capture", "samples")
    before = [PICTURES[kind](renderer, scene) for kind in kinds]
    changes = [
        lambda: setattr(box, "position", (0.9, 0.1, -3.5)),
        lambda: setattr(box.material, "color", (0, 1, 0)),
        lambda: setattr(panes[0], "position", (-0.7, 0.2, -2)),
        lambda: setattr(panes[1].material, "roughness", 0.5),
        lambda: setattr(panes[1].material, "transmission", 0),
        lambda: setattr(panes[1].material, "transmission", 0.5),
        lambda: setattr(box, "visible", False),
        lambda: setattr(scene, "background", (0.1, 0.2, 0.3)),
        lambda: setattr(panes[0], "visible", False),
        lambda: setattr(panes[0], "visible", True),
    ]
    for change in changes:
        change()
        got = [PICTURES[kind](renderer, scene) for kind in kinds]
        with cc.Renderer(device=DEVICE) as fresh:
            for one, kind in zip(got, kinds, strict=True):
                # What changed alone may be drawn by the program of one node in place of that of many.
                assert_identical(one, PICTURES[kind](fresh, scene), across="programs")
        assert any(not np.array_equal(one, old) for one, old in zip(got, before, strict=True))
        before = got
        for kind in kinds:
            PICTURES[kind](renderer, scene)
            assert renderer.stats.views_drawn == 0


def test_probes_that_see_each_other_through_panes(renderer, rng):
    """A circle of probes whose pictures also need what is behind panes is drawn in a fixed order."""
    scene = world(rng)
    for x in (-0.6, 0.6):
        ball = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(x, 0, -2))
        ball.environment = cc.Probe((x, 0, -2), size=12, format="rgba32f")
    scene.add(cc.Mesh.box((0.02, 2, 2)), pane(color=(0.5, 1, 1)), position=(0, 0, -2))
    got = PICTURES["frame"](renderer, scene)
    with cc.Renderer(device=DEVICE) as fresh:
        PICTURES["capture"](fresh, scene)
        assert_identical(got, PICTURES["frame"](fresh, scene))
    PICTURES["frame"](renderer, scene)
    assert renderer.stats.views_drawn == 0


@pytest.mark.parametrize("kind", PICTURES)
def test_what_is_blended_before_a_pane_counts_once(any_path, kind):
    """Smoke between the eye and a clear pane is not seen through the pane, too; smoke behind it is."""
    scene = cc.Scene(background=(0.5, 0.25, 0.125, 1))
    smoke = cc.BasicMaterial(color=(0.2, 0.9, 0.4), opacity=0.5)
    for direction in np.concatenate([np.eye(3), -np.eye(3)]):
        for distance in (1.5, 5):
            node = scene.add(
                cc.Mesh.box(0.3 * distance),
                smoke,
                position=distance * direction,
            )
            node.look_at(distance * direction * 2)
    want = PICTURES[kind](any_path, scene)
    scene.add(cc.Mesh.box((7, 7, 0.1)), pane(), position=(0, 0, -3.5))
    got = PICTURES[kind](any_path, scene)
    wrong = (np.abs(got - want) > 2e-3 * (1 + want)).any(-1)  # half floats have 11 bits
    # With samples, pixels on edges of the smoke before and behind are products of averages.
    assert wrong.mean() <= (0.05 if kind == "samples" else 0)
    assert want[..., :3].std() > 0.05


def test_smoke_that_moves_through_a_pane_is_drawn_as_from_scratch(new_renderer):
    need_equal_pixels()
    scene, live = cc.Scene(background=(0.5, 0.25, 0.125, 1)), new_renderer()
    scene.add(cc.Mesh.box((7, 7, 0.1)), pane(), position=(0, 0, -3.5))
    smoke = scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color="lime", opacity=0.5))
    pictures = []
    for z in (-2.5, -3.5, -4.5, -2.5):
        smoke.position = (0, 0, z)
        pictures.append(PICTURES["frame"](live, scene))
        assert_identical(pictures[-1], PICTURES["frame"](new_renderer(), scene))
    assert_identical(pictures[0], pictures[3])
