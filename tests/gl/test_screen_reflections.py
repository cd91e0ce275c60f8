"""`screen_reflections`: what a frame's mirrors show is looked up in the frame first.

The reference follows each ray through the frame's own outputs, in numpy (cubecam.truth.shading.screen); where it meets
nothing, the picture is that without the option, bit for bit.
"""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.screen import screen_hits
from tests.compare import assert_identical

SIZE = (72, 54)
ON: Any = {"screen_reflections": True}
NOTES: Any = {"format": "rgba32f", "outputs": ("depth", "id", "normal", "position")}


def waves(seed, size=64):
    """A smooth picture, so that a lookup half a pixel off changes little, and a wrong surface much."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:size, :size][..., None] / size * 2 * np.pi
    phases = rng.uniform(0, 6, (4, 3))
    found = (
        0.5
        + 0.2 * np.sin(x + phases[0]) * np.cos(y + phases[1])
        + 0.2 * np.sin(2 * y - x + phases[2])
    )
    return cc.Image((255 * np.clip(found * rng.uniform(0.5, 1, 3), 0, 1)).astype("uint8"))


def room():
    """Walls and two blocks, seen from inside; nothing reflects."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    walls = cc.BasicMaterial(map=waves(1), double_sided=True)
    scene.add(cc.Mesh.box((6, 4, 6)), walls, position=(0, 1.9, 0))
    scene.add(
        cc.Mesh.box((0.9, 1.2, 0.8)), cc.BasicMaterial(map=waves(2)), position=(-0.9, 0.6, -1.2)
    )
    scene.add(
        cc.Mesh.box((0.7, 0.5, 0.7)), cc.BasicMaterial(map=waves(3)), position=(1.0, 0.25, -0.3)
    )
    return scene


def floor(scene, material=None, **more):
    turned = cc.Mesh.box((5.9, 0.02, 5.9))
    options: Any = {"environment": cc.Probe((0, 1.2, 0), size=32), **more}
    return scene.add(turned, material or cc.MirrorMaterial(), position=(0, -0.01, 0), **options)


def ball(scene, material=None, **more):
    options: Any = {"environment": cc.Probe(size=32), **more}
    return scene.add(
        cc.Mesh.sphere(0.6, 48, 24),
        material or cc.MirrorMaterial(),
        position=(0.2, 0.8, -0.9),
        **options,
    )


def eye(**more):
    options: Any = {
        "fov": 55,
        "position": (0.3, 1.7, 2.6),
        "target": (0, 0.6, -0.8),
        "near": 0.1,
        "far": 30,
    }
    return cc.PerspectiveCamera(**{**options, **more})


def parallel():
    return cc.OrthographicCamera(
        height=3.4, position=(0.4, 2.2, 2.7), target=(0, 0.5, -0.8), near=0.1, far=30
    )


VIEWS = {
    "perspective": eye(),
    "shifted": eye(shift=(0.2, -0.3), pixel_aspect=1.2),
    "parallel": parallel(),
    "mirror image": cc.Camera(
        view=np.diag([-1.0, 1, 1, 1]) @ eye().view,
        projection=eye().projection(aspect=SIZE[0] / SIZE[1]),
    ),
}


def rays(frame, camera, mask):
    """Where the rays of a mask start, and where a mirror sends them."""
    start, normal = frame.position[mask].astype(float), frame.normal[mask].astype(float)
    world = np.linalg.inv(camera.view)
    projection = camera.projection(aspect=SIZE[0] / SIZE[1])
    incident = (
        start - world[:3, 3]
        if projection[3, 2] != 0
        else np.broadcast_to(-world[:3, 2], start.shape)
    )
    incident = incident / np.linalg.norm(incident, axis=-1, keepdims=True)
    return (
        start,
        incident - 2 * (incident * normal).sum(-1, keepdims=True) * normal,
        projection @ camera.view,
    )


def looked_up(frame, place):
    """Bilinear lookups in a frame's colours."""
    x, y = place.T - 0.5
    j, i = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - j)[:, None], (y - i)[:, None]
    c = frame.color[..., :3].astype(float)
    rows, columns = np.clip([i, i + 1], 0, len(c) - 1), np.clip([j, j + 1], 0, c.shape[1] - 1)
    upper = c[rows[0], columns[0]] * (1 - fx) + c[rows[0], columns[1]] * fx
    lower = c[rows[1], columns[0]] * (1 - fx) + c[rows[1], columns[1]] * fx
    return upper * (1 - fy) + lower * fy


def inner(ids, own):
    """Pixels of a node whose neighbours are of the same node."""
    mask = ids == own
    for axis in (0, 1):
        for step in (1, -1):
            mask &= np.roll(ids == own, step, axis)
    mask[[0, -1]] = mask[:, [0, -1]] = False
    return mask


def both(renderer, scene, camera=None, size=SIZE):
    """The frame with and without."""
    camera = camera or eye()
    off: Any = {}
    return [renderer.render(scene, camera, size, **NOTES, **o) for o in (ON, off)]


def followed(frame, camera, node, **options):
    """The reference: the mask of a mirror's pixels, what its rays meet, and the colours that it shows then."""
    mask = inner(frame.id, node.id)
    start, way, to_clip = rays(frame, camera, mask)
    hits = screen_hits(start, way, to_clip, frame.depth, frame.id, node.id, **options)
    seen = looked_up(frame, np.where(hits.found[:, None], hits.seen, 1.0))
    around = frame.color[mask][:, :3]
    return mask, hits, around + hits.share[:, None] * (seen - around)


@pytest.mark.parametrize("mirror", [floor, ball])
@pytest.mark.parametrize("view", VIEWS)
def test_it_shows_what_the_reference_finds(renderer, view, mirror):
    scene = room()
    node = mirror(scene)
    got, plain = both(renderer, scene, VIEWS[view])
    assert_identical(got.id, plain.id)
    mask, hits, expected = followed(plain, VIEWS[view], node)
    assert (hits.share > 0.9).sum() > 30
    off = np.abs(got.color[mask][:, :3] - expected).max(-1)
    # At silhouettes rounding decides what is met.
    assert (off > 0.01).mean() < 0.03
    assert np.abs(plain.color[mask][:, :3] - expected).max(-1).mean() > 5 * off.mean()
    assert_identical(got.color[~(got.id == node.id)], plain.color[~(got.id == node.id)])


def test_what_leaves_the_picture_is_that_of_the_probe(renderer):
    scene = room()
    node = ball(scene)
    got, plain = both(renderer, scene)
    mask, hits, _ = followed(plain, eye(), node)
    assert 0.2 < hits.found.mean() < 0.9
    same = (got.color[mask] == plain.color[mask]).all(-1)
    assert same[~hits.found].mean() > 0.97
    # Rays that go back to the eye leave the picture behind it.
    middle = tuple(np.round(np.argwhere(mask).mean(0)).astype(int))
    assert_identical(got.color[middle], plain.color[middle])


def test_it_is_as_exact_as_a_planar_mirror(renderer):
    scene, want = room(), room()
    node = floor(scene)
    want.add(cc.Mesh.plane(5.9, 5.9), cc.MirrorMaterial(), environment=cc.PlanarMirror())
    size: Any = (112, 84)
    got, plain = both(renderer, scene, size=size)
    exact = renderer.render(want, eye(), size, format="rgba32f").color
    mask, hits, _ = followed(plain, eye(), node)
    known = hits.share == 1
    assert known.sum() > 300
    off = np.abs(got.color - exact)[mask][known][:, :3].max(-1)
    assert np.median(off) < 0.004
    assert (off > 0.02).mean() < 0.08  # silhouettes, and small patterns between pixels
    assert np.abs(plain.color - exact)[mask][known].max(-1).mean() > 0.1


def test_what_is_hidden_is_that_of_the_probe(renderer):
    """A mirror behind a block sees the block's back, which the picture does not show."""
    scene = room()
    block = scene.add(
        cc.Mesh.box((1.6, 1.2, 0.3)), cc.BasicMaterial(map=waves(5)), position=(0, 1.0, -1.0)
    )
    node = scene.add(
        cc.Mesh.box((3, 2.4, 0.05)),
        cc.MirrorMaterial(),
        position=(0, 1.2, -2.4),
        environment=cc.Probe((0, 0, 1), size=32),
    )
    camera = eye(position=(0, 2.6, 2.4), target=(0, 1, -1.4))
    got, plain = both(renderer, scene, camera)
    mask = inner(plain.id, node.id)
    start, way, _ = rays(plain, camera, mask)
    # The back of the block is at z = -1.15.
    t = (-1.15 - start[:, 2]) / way[:, 2]
    met = start + t[:, None] * way - block.position
    hidden = (t > 0) & (np.abs(met[:, :2]) < (0.75, 0.55)).all(-1)
    assert hidden.sum() > 30
    assert_identical(got.color[mask][hidden], plain.color[mask][hidden])


@pytest.mark.parametrize("shape", ["sphere", "bowl"])
def test_no_reflector_meets_itself(renderer, shape):
    """Alone before an environment, a body shows the environment alone, whatever its shape."""
    rng = np.random.default_rng(3)
    cube = cc.CubeMap(rng.integers(0, 255, (6, 8, 8, 3), "uint8"))
    scene = cc.Scene(environment=cube)
    if shape == "sphere":
        scene.add(cc.Mesh.sphere(1, 12, 6), cc.MirrorMaterial())
    else:
        profile = [(r, -np.sqrt(1 - r * r)) for r in np.linspace(0, 0.99, 12)]
        around = np.linspace(0, 2 * np.pi, 24)
        points = np.array([(r * np.cos(a), y, r * np.sin(a)) for r, y in profile for a in around])
        corners = [
            (i * 24 + k, i * 24 + k + 1, i * 24 + k + 24) for i in range(11) for k in range(23)
        ]
        corners += [
            (i * 24 + k + 1, i * 24 + k + 25, i * 24 + k + 24) for i in range(11) for k in range(23)
        ]
        scene.add(cc.Mesh(points, corners), cc.MirrorMaterial(double_sided=True))
    camera = eye(position=(0, 2, 1.6), target=(0, 0, 0))
    got, plain = both(renderer, scene, camera)
    assert (plain.id > 0).mean() > 0.2
    assert_identical(got.color, plain.color)


def test_mirrors_see_each_other(renderer):
    scene = room()
    node = floor(scene)
    ball(scene)
    got, plain = both(renderer, scene)
    mask, _, expected = followed(plain, eye(), node)
    off = np.abs(got.color[mask][:, :3] - expected).max(-1)
    assert (off > 0.01).mean() < 0.03


def test_nodes_that_are_drawn_together_meet_each_other_alone(renderer):
    """One draw call has several nodes, and each has its own id."""
    scene = room()
    mesh, material, probe = (
        cc.Mesh.sphere(0.35, 32, 16),
        cc.MirrorMaterial(),
        cc.Probe((0, 1, 0), size=32),
    )
    nodes = [
        scene.add(mesh, material, position=(x, 0.9, 0.3), environment=probe) for x in (-0.8, 0, 0.8)
    ]
    got, plain = both(renderer, scene)
    assert renderer.stats.draw_calls < 6  # of six nodes
    for node in nodes:
        mask, hits, expected = followed(plain, eye(), node)
        assert hits.found.sum() > 5
        assert (np.abs(got.color[mask][:, :3] - expected).max(-1) > 0.01).mean() < 0.06


def test_what_shows_through_panes_is_that_of_probes(renderer):
    scene = room()
    floor(scene)
    glass = cc.StandardMaterial(transmission=1, roughness=0, specular_weight=0, metallic=0)
    pane = scene.add(cc.Mesh.box((1.5, 1, 0.02)), glass, position=(0.3, 0.6, 0.8))
    got, plain = both(renderer, scene)
    mask = plain.id == pane.id
    assert mask.sum() > 100
    assert_identical(got.color[mask], plain.color[mask])
    assert np.abs(got.color - plain.color).max() > 0.1


def test_stereo_pictures_have_a_screen_for_each_eye(any_path):
    scene = room()
    ball(scene)
    floor(scene)
    right = eye(position=(0.7, 1.7, 2.6))
    pair = any_path.render(
        scene,
        cc.StereoCamera(eye(), right, layout="side_by_side"),
        (2 * SIZE[0], SIZE[1]),
        format="rgba32f",
        **ON,
    ).color
    alone = [
        any_path.render(scene, one, SIZE, format="rgba32f", **ON).color for one in (eye(), right)
    ]
    assert_identical(pair, np.concatenate(alone, axis=1))


def test_rays_into_a_body_are_those_of_the_environment(renderer):
    scene = room()
    # So small that bent rays end beside it, in the picture.
    glass = cc.GlassMaterial(ior=1.5, fresnel=False)
    node = scene.add(
        cc.Mesh.sphere(0.2, 32, 16), glass, position=(0.2, 1.0, 1.2), environment=cc.Probe(size=32)
    )
    got, plain = both(renderer, scene)
    assert (plain.id == node.id).sum() > 60
    assert_identical(got.color, plain.color)


def test_planar_mirrors_stay_as_they_are(renderer):
    scene = room()
    node = scene.add(cc.Mesh.plane(5.9, 5.9), cc.MirrorMaterial(), environment=cc.PlanarMirror())
    ball(scene)
    got, plain = both(renderer, scene)
    mask = plain.id == node.id
    assert_identical(got.color[mask], plain.color[mask])
    assert np.abs(got.color - plain.color).max() > 0.1


def test_blended_surfaces_are_not_found(renderer):
    """Their depth is not known: what lies behind them is found as if they were not there."""
    without, scene = room(), room()
    node = floor(without)
    floor(scene)
    sheet = scene.add(
        cc.Mesh.box((1.2, 1.5, 0.02)),
        cc.BasicMaterial(color=(1, 0, 0), opacity=0.5),
        position=(0.9, 0.8, -1.5),
    )
    got, plain = both(renderer, scene)
    expected, _ = both(renderer, without)
    mask = inner(plain.id, node.id) & (
        np.abs(plain.color - both(renderer, without)[1].color).max(-1) == 0
    )
    assert sheet.id > 0
    assert_identical(got.color[mask], expected.color[mask])


def test_multisamples(renderer):
    scene = room()
    node = floor(scene)
    one, four = (renderer.render(scene, eye(), SIZE, samples=n, **NOTES, **ON) for n in (1, 4))
    mask = inner(one.id, node.id)
    assert (np.abs(one.color - four.color)[mask].max(-1) > 0.004).mean() < 0.02


def test_rough_surfaces_see_less_sharply(renderer):
    """A wide lobe over a wall of stripes is even; the widest ones are those of the probe."""
    stripes = np.zeros((1, 64, 3), "uint8")
    stripes[:, ::2] = 255
    frames = {}
    for roughness in (0.0, 0.15, 0.8):
        scene = cc.Scene(background=(0.5, 0.5, 0.5))
        scene.add(
            cc.Mesh.box((6, 4, 0.1)),
            cc.BasicMaterial(map=cc.Image(stripes, mag_filter="nearest", mipmaps=True)),
            position=(0, 2, -1.5),
        )
        node = floor(scene, cc.StandardMaterial(color=(1, 1, 1), metallic=1, roughness=roughness))
        frames[roughness] = both(renderer, scene)
    mask = inner(frames[0.0][1].id, node.id)
    mask[:30] = mask[42:] = (
        False  # not at the wall, where lobes are narrow, and rays end in the picture
    )
    mask[:, :10] = mask[:, -10:] = False
    assert mask.sum() > 200
    contrast = {
        r: np.abs(np.diff(f[0].color[..., 1], axis=1))[mask[:, 1:]].mean()
        for r, f in frames.items()
    }
    assert contrast[0.15] < 0.5 * contrast[0.0]
    for roughness in (0.0, 0.15):
        got, plain = frames[roughness]
        assert np.abs(got.color - plain.color)[mask].mean() > 0.01
    assert_identical(frames[0.8][0].color[mask], frames[0.8][1].color[mask])


def test_what_touches_a_mirror_is_seen_at_its_edge(renderer):
    scene = cc.Scene(background=(0, 0, 0))
    block = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0.5, -1))
    node = floor(scene)
    got, plain = both(renderer, scene)
    touching = (plain.id == node.id) & np.roll(plain.id == block.id, 1, axis=0)
    assert touching.sum() > 10
    assert (got.color[touching][:, 0] > 0.99).mean() > 0.9


def test_environment_at_of_users(renderer):
    """environment(direction) and environment_at of the same place find the same."""
    frames = []
    for call in ("environment(r)", "environment_at(surface.position, r)"):
        scene = room()
        source = f"vec3 shade(Surface surface) {{ vec3 r = reflect(surface.incident, surface.normal); return {call}; }}"
        node = ball(scene, cc.ShaderMaterial(source))
        frames.append(both(renderer, scene))
    mask, hits, expected = followed(frames[0][1], eye(), node)
    for got, _ in frames:
        assert (np.abs(got.color[mask][:, :3] - expected).max(-1) > 0.01).mean() < 0.03
    assert (hits.share > 0.9).sum() > 30


def test_nothing_changes_without_it(renderer):
    scene = room()
    floor(scene)
    before = renderer.render(scene, eye(), SIZE, **NOTES)
    views = renderer.stats.views_drawn
    renderer.render(scene, eye(), SIZE, **NOTES, **ON)
    after = renderer.render(scene, eye(), SIZE, **NOTES)
    assert_identical(after.color, before.color)
    assert renderer.stats.views_drawn == 1
    assert views >= 1
    # Without a reflecting surface in view the option has no effect.
    plain = room()
    with cc.Renderer() as fresh:
        fresh.render(plain, eye(), SIZE, **ON)
        assert fresh.stats.views_drawn == 1


def test_pictures_are_drawn_when_something_changed(renderer):
    scene = room()
    floor(scene)
    block = scene.nodes[1]
    first = renderer.render(scene, eye(), SIZE, format="rgba32f", **ON)
    assert renderer.stats.views_drawn >= 2
    again = renderer.render(scene, eye(), SIZE, format="rgba32f", **ON)
    assert renderer.stats.views_drawn == 0
    assert renderer.stats.draw_calls == 0
    assert_identical(again.color, first.color)
    for _ in range(2):
        block.position = np.add(block.position, (0.3, 0, 0.1))
        moved = renderer.render(scene, eye(), SIZE, format="rgba32f", **ON)
        assert renderer.stats.views_drawn >= 2
        with cc.Renderer() as fresh:
            assert_identical(
                moved.color, fresh.render(scene, eye(), SIZE, format="rgba32f", **ON).color
            )
    assert np.abs(moved.color - first.color).max() > 0.1


def test_captures_do_without(renderer):
    scene = room()
    floor(scene)
    cube = renderer.capture(scene, (0, 1, 1), 16)
    renderer.render(scene, eye(), SIZE, **ON)
    assert_identical(renderer.capture(scene, (0, 1, 1), 16).faces, cube.faces)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"format": None, "outputs": ["id"]},
            "screen_reflections: expected False without a colour, got True and format None",
        ),
        (
            {"depth_format": None},
            "screen_reflections: expected False without a depth buffer, got True and depth_format none",
        ),
        (
            {"depth_format": "stencil_index8"},
            "without a depth buffer, got True and depth_format stencil_index8",
        ),
    ],
)
def test_it_needs_colour_and_depth(renderer, options, message):
    with pytest.raises(ValueError, match=message):
        renderer.render(room(), eye(), SIZE, **options, **ON)


@pytest.mark.parametrize("depth_format", ["depth_component16", "depth24_stencil8"])
def test_other_depth_buffers(renderer, depth_format):
    scene = room()
    floor(scene)
    got = renderer.render(scene, eye(), SIZE, depth_format=depth_format, **ON)
    expected = renderer.render(scene, eye(), SIZE, **ON)
    assert (np.abs(got.color.astype(int) - expected.color).max(-1) > 2).mean() < 0.01
