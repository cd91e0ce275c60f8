"""ProbeBlend: what surfaces see between several probes, against the weights of numpy."""

import itertools

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.influence import Influence, weights
from tests.compare import assert_identical
from tests.reference.transforms import rotation

SIZE = (40, 32)
CAMERA = cc.PerspectiveCamera(position=(0.4, 1, 7), target=(0.2, 0, 0), fov=60)
COLORS = ((1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0))
MATRIX = rotation((0.95, 0.1, 0.25, -0.1)) @ np.diag([1.2, 0.9, 1, 1])
BOXES = (
    Influence((-3, -1, -1.5), (-0.5, 1, 1.5), 1.2),
    Influence((0, -1.2, -1), (2.5, 1, 1), 0.9, "sphere"),
    Influence((-1, 0.4, -1), (1, 1.6, 1), 0.7, "box", MATRIX),
)
#: User GLSL shows the blend at any place; the others by the direction that they reflect.
MATERIALS = {
    "mirror": lambda: cc.MirrorMaterial(),
    "rough": lambda: cc.StandardMaterial(color=(1, 1, 1), metallic=1, roughness=0.5),
    "matt": lambda: cc.StandardMaterial(
        color=(1, 1, 1), metallic=0, specular_weight=0, roughness=1
    ),
    "own": lambda: cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment_at(s.position, s.normal); }"
    ),
    "lod": lambda: cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment_lod(s.normal, 0.0); }"
    ),
}


def lights(scene):
    """Shells of one colour each, each seen by one probe alone."""
    shells = []
    for color in COLORS:
        glow = cc.BasicMaterial(color=color, double_sided=True)
        shells.append(scene.add(cc.Mesh.box(60), glow))
    return shells


def probe_of(influence, shells, number, **options):
    hidden = [shell for i, shell in enumerate(shells) if i != number]
    options = {"size": 8, "format": "rgba32f", **options}
    return cc.Probe(
        (0, 0.2 * number, 0),
        exclude=hidden,
        influence=None if influence.low is None else (influence.low, influence.high),
        influence_shape=influence.shape,
        blend_distance=influence.blend_distance,
        proxy_matrix=influence.matrix,
        **options,
    )


def world(material, boxes=BOXES, rest=0.25, mesh=None, **options):
    scene = cc.Scene(background=(0, 0, 0))
    scene.environment = cc.CubeMap(np.full((6, 4, 4, 3), rest, np.float32))
    shells = lights(scene)
    probes = [probe_of(box, shells, i, **options) for i, box in enumerate(boxes)]
    node = scene.add(
        cc.Mesh.box() if mesh is None else mesh, material, scale=(6, 2.4, 2), name="thing"
    )
    node.environment = cc.ProbeBlend(probes)
    return scene, node, shells


def seen(renderer, scene, node, camera=CAMERA):
    """The colours of the node's pixels and their places, which lies before the shells."""
    frame = renderer.render(scene, camera, SIZE, format="rgba32f", outputs=("position", "id"))
    on = frame.outputs["id"] == node.id
    return frame.color[on][:, :3].astype(float), frame.outputs["position"][on].astype(float)


def expected(position, boxes=BOXES, rest=0.25):
    w = weights(position, boxes)
    colors = np.vstack([COLORS[: len(boxes)], np.full((1, 3), rest)])
    return w @ colors


@pytest.mark.parametrize("kind", MATERIALS)
def test_each_pixel_has_the_weights_of_its_place(any_path, kind):
    scene, node, _ = world(MATERIALS[kind]())
    got, position = seen(any_path, scene, node)
    want = expected(position)
    assert len(got) > 150
    assert np.abs(got - want).max() < (2e-3 if kind in ("rough", "matt") else 1e-4)
    w = weights(position, BOXES)
    assert (w.max(axis=0) > 0.5).all()  # all of them show, and their mixtures
    assert ((w > 0.1).sum(axis=-1) >= 2).mean() > 0.15


def test_places_elsewhere_have_their_own_weights(renderer):
    source = "vec3 shade(Surface s) { return environment_at(s.position * .6, s.normal); }"
    scene, node, _ = world(cc.ShaderMaterial(source))
    got, position = seen(renderer, scene, node)
    assert np.abs(got - expected(position * 0.6)).max() < 1e-4


@pytest.mark.parametrize("parallax", ["box", "sphere", "distance", "layers"])
def test_each_probe_keeps_its_parallax(renderer, parallax):
    """Between two probes a mirror shows the mean of what it shows with either."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    where = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return fract(s.position * .7); }", double_sided=True
    )
    scene.add(cc.Mesh.box(1), where, scale=(8, 4, 6))
    scene.add(cc.Mesh.box(1), where, position=(1.5, -1, 1))
    ball = scene.add(cc.Mesh.icosphere(0.5, subdivisions=3), cc.MirrorMaterial())
    camera = cc.PerspectiveCamera(position=(0.3, 0.4, 2.4), target=(0, 0, 0), fov=32)
    box = ((-4, -2, -3), (4, 2, 3))
    probes = [
        cc.Probe(at, size=64, format="rgba32f", parallax=parallax, box=box)
        for at in ((-0.8, 0.1, 0), (0.9, -0.1, 0.2))
    ]
    alone = []
    for probe in probes:
        # The blend hides the ball from both probes, and so does each alone.
        ball.environment = cc.ProbeBlend([probe])
        alone.append(renderer.render(scene, camera, SIZE, format="rgba32f").color)
        ball.environment = probe
        assert_identical(renderer.render(scene, camera, SIZE, format="rgba32f").color, alone[-1])
    ball.environment = cc.ProbeBlend(probes)
    got = renderer.render(scene, camera, SIZE, format="rgba32f").color
    assert np.abs(alone[0] - alone[1]).max() > 0.2
    # The march may round a ray to another texel in another program.
    off = np.abs(got - (alone[0] + alone[1]) / 2).max(axis=-1)
    assert np.quantile(off, 0.98) < 2e-3


def test_nothing_pops_where_a_ball_rolls_from_room_to_room(renderer):
    scene, ball, _ = world(cc.MirrorMaterial(), BOXES[:2], mesh=cc.Mesh.icosphere(0.3))
    ball.scale = 1, 1, 1
    steps = np.linspace(-5, 5, 41)
    pictures = []
    for x in steps:
        ball.position = (x, 0, 0)
        camera = cc.PerspectiveCamera(position=(x, 0, 2), target=(x, 0, 0), fov=20)
        pictures.append(seen(renderer, scene, ball, camera)[0])
    jumps = [np.abs(b - a).max() for a, b in itertools.pairwise(pictures)]
    # The steepest slope: 1.5 over the blend distance, of .9 at least, times a step of .25; the ellipsoid is
    # 1.25 long and 1 high, which the line to its middle sees steeper.
    assert max(jumps) < 1.5 / 0.9 * 0.25 * 1.5
    assert np.abs(pictures[0] - 0.25).max() < 1e-5  # nothing reaches: the scene's environment
    middle = pictures[int(np.argmin(np.abs(steps + 1.75)))]
    assert np.abs(middle - COLORS[0]).max() < 1e-4


def test_captures_show_the_same(any_path):
    scene, node, _ = world(MATERIALS["own"]())
    cube = any_path.capture(
        scene, (0.3, 0.4, 2), size=24, format="rgba32f", outputs=("position", "id")
    )
    on = cube.outputs["id"] == node.id
    assert on.sum() > 100
    want = expected(cube.outputs["position"][on].astype(float))
    assert np.abs(cube.faces[on][:, :3] - want).max() < 1e-4


def test_a_planar_mirror_shows_the_same(renderer):
    scene, _, _ = world(MATERIALS["own"]())
    pane = scene.add(cc.Mesh.plane(12, 12), cc.MirrorMaterial(), position=(0, -2, 0))
    pane.environment = cc.PlanarMirror()
    camera = cc.PerspectiveCamera(position=(0.3, 1.5, 7), target=(0, -2, 1.5), fov=50)
    # In the probes' own pictures the mirror shows the node, which sees all of the probes: a circle.
    assert np.isfinite(renderer.render(scene, camera, SIZE, format="rgba32f").color).all()
    pane.in_captures = False
    frame = renderer.render(scene, camera, SIZE, format="rgba32f", outputs=("position", "id"))
    on = frame.outputs["id"] == pane.id
    start = frame.outputs["position"][on].astype(float)
    way = start - camera.position
    way[:, 1] *= -1
    # Where the mirrored rays enter the box of the node.
    half = np.array([3, 1.2, 1])
    enters = np.minimum((-half - start) / way, (half - start) / way).max(axis=-1)
    leaves = np.maximum((-half - start) / way, (half - start) / way).min(axis=-1)
    met = (enters > 0) & (enters < leaves - 1e-3)
    want = expected(start + enters[:, None] * way)
    got = frame.color[on][:, :3]
    assert met.sum() > 40
    # The normals of the own material do not matter: each probe shows one colour.
    assert np.quantile(np.abs(got - want)[met].max(axis=-1), 0.95) < 1e-3


def test_a_render_texture_shows_the_same(renderer):
    scene, _, _ = world(MATERIALS["own"]())
    texture = cc.RenderTexture(scene, CAMERA, size=SIZE, format="rgba32f")
    screen = cc.Scene()
    screen.add(cc.Mesh.plane(1, 1), cc.BasicMaterial(map=texture))
    renderer.render(screen, CAMERA, SIZE)
    direct = renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    assert_identical(renderer.read_texture(texture), direct)


def test_a_change_redraws_what_it_must(fresh_renderer):
    scene, node, _ = world(cc.MirrorMaterial(), BOXES[:2])

    def drawn():
        fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f")
        return fresh_renderer.stats.views_drawn

    first, second = node.environment.probes
    assert drawn() > 0
    assert drawn() == 0
    first.blend_distance = 0.4
    assert drawn() == 1
    second.influence_shape = "box"
    assert drawn() == 1
    second.influence = ((0, -1, -1), (2, 1, 1))
    assert drawn() == 1
    second.influence = second.influence
    assert drawn() == 0
    before = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    with cc.Renderer() as other:
        assert_identical(other.render(scene, CAMERA, SIZE, format="rgba32f").color, before)


def test_probes_that_reach_nothing_are_not_drawn(fresh_renderer):
    far = [Influence((50 + i, 0, 0), (51 + i, 1, 1), 0.1) for i in range(6)]
    scene, node, shells = world(cc.MirrorMaterial(), BOXES[:1])
    crowd = [probe_of(box, shells, 0) for box in far]
    node.environment = cc.ProbeBlend([*node.environment.probes, *crowd])
    fresh_renderer.render(scene, CAMERA, SIZE)
    assert fresh_renderer.stats.probes_updated == 1


def test_more_than_four_reaching_probes_are_an_error(renderer):
    scene, node, shells = world(cc.MirrorMaterial())
    around = [probe_of(Influence(), shells, 0) for _ in range(5)]
    node.environment = cc.ProbeBlend(around[:4])
    renderer.render(scene, CAMERA, SIZE)
    node.environment = cc.ProbeBlend(around)
    with pytest.raises(ValueError, match=rf"node {node.id}: expected at most 4 probes .* got 5:"):
        renderer.render(scene, CAMERA, SIZE)


def test_probes_in_a_circle_show_each_others_blends(renderer):
    """Two mirrors, each with two probes of its own: with two bounces each shows the other's reflection."""
    scene = cc.Scene(background=(0.2, 0.4, 0.8))
    balls = []
    for x in (-1, 1):
        ball = scene.add(cc.Mesh.icosphere(0.6), cc.MirrorMaterial(), position=(x, 0, 0))
        probes = [
            cc.Probe((x, y, 0), size=32, influence=((-3, low, -1), (3, high, 1)), bounces=2)
            for y, low, high in ((0.2, 0, 1), (-0.2, -1, 0))
        ]
        ball.environment = cc.ProbeBlend(probes)
        balls.append(ball)
    camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0), fov=40)
    frame = renderer.render(scene, camera, SIZE, format="rgba32f")
    assert np.isfinite(frame.color).all()
    changes = renderer.stats.bounce_changes
    assert len(changes) == 1
    shown = renderer.render(scene, camera, SIZE, format="rgba32f").color
    for ball in balls:
        assert isinstance(ball.environment, cc.ProbeBlend)
        for probe in ball.environment.probes:
            probe.bounces = 1
    other = renderer.render(scene, camera, SIZE, format="rgba32f").color
    assert np.isfinite(other).all()
    assert np.abs(shown - other).max() <= 1
