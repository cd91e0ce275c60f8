"""Probes whose reflections know where things are, against the march and the proxies of numpy.

Every surface of these scenes shows where it is in the world, so that a mirror's pixel is the point that it reflects.
"""

import itertools
import pickle

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import parallax
from tests.compare import assert_identical
from tests.gl.flat import quad
from tests.reference.transforms import rotation

PLACE = cc.ShaderMaterial("vec3 shade(Surface s) { return s.position; }", double_sided=True)
CENTER = np.array([0.4, -0.3, 0.2])
LOW, HIGH = np.array([-3.0, -2, -2.5]), np.array([3.5, 2.5, 2])
CAMERA = cc.PerspectiveCamera(position=(1.1, 0.8, 1.4), target=CENTER, fov=45)
SIZE = (48, 40)
METHODS = ("box", "sphere", "distance", "layers")


def room(things=()):
    """A room whose walls show their places, and boxes in it: (position, size)."""
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(cc.Mesh.box(1), PLACE, position=(LOW + HIGH) / 2, scale=HIGH - LOW)
    for position, size in things:
        scene.add(cc.Mesh.box(1), PLACE, position=position, scale=size)
    return scene


FURNITURE = [
    ((-1.6, -1.2, 0.3), (0.7, 1.6, 0.9)),
    ((2.2, 0.6, -0.9), (0.5, 0.8, 1.1)),
    ((0.6, -1.7, 1.4), (1.3, 0.4, 0.5)),
    ((0.2, 1.6, -1.1), (0.9, 0.5, 0.6)),
]


def add_ball(scene, **options):
    """A mirror in the middle of the picture, whose probe is of float32."""
    ball = scene.add(cc.Mesh.icosphere(0.4, subdivisions=4), cc.MirrorMaterial(), position=CENTER)
    ball.environment = cc.Probe(CENTER, size=128, format="rgba32f", **options)
    return ball


def mirrored(renderer, scene, ball, camera=CAMERA):
    """Of the ball's pixels: the point that each shows, where it is itself, and the direction of its reflection."""
    frame = renderer.render(
        scene, camera, SIZE, format="rgba32f", outputs=("position", "normal", "id")
    )
    on = frame.outputs["id"] == ball.id
    position, normal = (frame.outputs[name][on].astype(float) for name in ("position", "normal"))
    incident = position - camera.position
    incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
    way = incident - 2 * (incident * normal).sum(axis=-1, keepdims=True) * normal
    return frame.color[on][:, :3].astype(float), position, way


def exact_hit(position, way):
    """Where rays meet the walls of the room, without any cube."""
    with np.errstate(divide="ignore"):
        reach = np.where(way > 0, HIGH - position, LOW - position) / way
    return position + reach.min(axis=-1, keepdims=True) * way


def seen(found):
    return CENTER + found.direction * 1.0


def depths(renderer, scene, ball, **options):
    frames = renderer.capture(
        scene, CENTER, size=128, exclude=[ball], outputs=("z",), near=0.05, **options
    )
    return frames.outputs["z"]


@pytest.mark.parametrize("method", ["box", "distance", "layers"])
@pytest.mark.parametrize("fetches", [6, 14, 35])
def test_the_walls_of_a_room_are_exact(any_path, method, fetches):
    scene = room()
    ball = add_ball(scene, parallax=method, box=(LOW, HIGH), fetches=fetches)
    got, position, way = mirrored(any_path, scene, ball)
    want = exact_hit(position, way)
    off = np.linalg.norm(got - want, axis=-1) / np.linalg.norm(want - position, axis=-1)
    assert len(off) > 250
    # Between the texels of two walls a lookup mixes both.
    assert np.quantile(off, 0.8) < (0.01 if fetches > 6 or method == "box" else 0.03)
    assert np.quantile(off, 0.97) < 0.05
    ball.environment.parallax = "none"
    plain, *_ = mirrored(any_path, scene, ball)
    assert np.median(np.linalg.norm(plain - want, axis=-1)) > 0.15


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("method", ["box", "sphere"])
@pytest.mark.parametrize("where", ["inside", "outside"])
def test_proxies_are_those_of_numpy(any_path, method, turned, where):
    """The cube's texels show directions; the mirror then shows which direction was looked up."""
    scene = cc.Scene()
    compass = cc.ShaderMaterial(
        "uniform vec3 center; vec3 shade(Surface s) { return normalize(s.position - center); }",
        uniforms={"center": CENTER},
        double_sided=True,
    )
    scene.add(cc.Mesh.icosphere(50, subdivisions=4), compass)
    low, high = (LOW, HIGH) if where == "inside" else (np.array([1, -2, -1]), np.array([4, 2, 3]))
    matrix = np.eye(4)
    if turned:
        matrix[:3, :3] = rotation((0.9, 0.1, 0.4, -0.15))[:3, :3] * [1.2, 0.9, 1]
        matrix[:3, 3] = (0.3, -0.2, 0.1)
    ball = add_ball(
        scene, parallax=method, box=(low, high), proxy_matrix=matrix if turned else None
    )
    got, position, way = mirrored(any_path, scene, ball)
    function = parallax.box_direction if method == "box" else parallax.sphere_direction
    found = function(position, way, CENTER, low, high, matrix)
    want = found.direction / np.linalg.norm(found.direction, axis=-1, keepdims=True)
    if where == "outside":  # some rays miss, and see the cube as if it were far away
        assert 20 < np.isfinite(found.distance).sum() < len(want) - 20
    off = np.linalg.norm(got - want, axis=-1)
    assert np.quantile(off, 0.98) < 0.004, np.quantile(off, [0.5, 0.9, 0.98])  # but for rims
    assert np.linalg.norm(got - way, axis=-1).max() > 0.1


@pytest.mark.parametrize(
    ("layers", "fetches", "share"), [(1, 14, 0.87), (1, 35, 0.9), (2, 35, 0.93)]
)
def test_a_march_finds_what_numpy_finds(any_path, layers, fetches, share):
    scene = room(FURNITURE)
    method = "distance" if layers == 1 else "layers"
    ball = add_ball(scene, parallax=method, fetches=fetches)
    got, position, way = mirrored(any_path, scene, ball)
    near = depths(any_path, scene, ball)
    far = depths(any_path, scene, ball, depth_order="farthest") if layers == 2 else None
    found = parallax.march(position, way, CENTER, near, far, steps=160)
    want = CENTER + found.direction
    off = np.linalg.norm(got - want, axis=-1) / found.distance
    assert np.mean(off < 0.02) > share, np.mean(off < 0.02)
    # The same march finds none of them from a place beside the real one.
    wrong = parallax.march(position, way, CENTER + 0.3, near, far, steps=64)
    assert np.mean(np.linalg.norm(got - CENTER - wrong.direction, axis=-1) < 0.02) < 0.2


def test_the_second_layer_has_what_furniture_hides(renderer):
    rng = np.random.default_rng(5)
    around = rng.normal(size=(60, 3))
    around *= 0.8 / np.linalg.norm(around, axis=-1, keepdims=True)
    scene = room([(CENTER + place, (0.15, 0.15, 0.15)) for place in around])
    ball = add_ball(scene, parallax="layers", fetches=35)
    right = {}
    for method in ("distance", "layers"):
        ball.environment.parallax = method
        got, position, way = mirrored(renderer, scene, ball)
        far = depths(renderer, scene, ball, depth_order="farthest")
        near = depths(renderer, scene, ball)
        found = parallax.march(position, way, CENTER, near, far, steps=160)
        hidden = (found.layer == parallax.FAR) & found.accepted
        assert hidden.sum() > 40
        off = np.linalg.norm(got - CENTER - found.direction, axis=-1)
        right[method] = np.mean(off[hidden] < 0.1)
    assert right["layers"] > 0.8
    assert right["distance"] < 0.4


@pytest.mark.parametrize("method", METHODS)
def test_a_miss_shows_the_background(renderer, method):
    """In the open, rays that meet nothing see the sky, whatever stands around."""
    scene = cc.Scene(background=(0.25, 0.5, 1))
    white = cc.BasicMaterial(color=(1, 1, 1))
    for i in range(12):
        scene.add(
            cc.Mesh.box(0.3),
            white,
            position=CENTER + np.array((3 * np.cos(i), -0.4, 3 * np.sin(i))),
        )
    for fetches in (6, 14, 35):
        ball = add_ball(scene, parallax=method, box=(LOW, HIGH), fetches=fetches)
        got, _, way = mirrored(renderer, scene, ball)
        assert np.all(got >= np.array([0.25, 0.5, 1]) - 1e-6)
        assert np.all(got[way[:, 1] > 0.3] == [0.25, 0.5, 1])
        scene.remove(ball)


@pytest.mark.parametrize("method", METHODS)
def test_moving_parts_equal_a_new_renderer(any_path, new_renderer, method):
    """Things, the mirror, the proxy and the options change: the next picture is that of a new renderer."""
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax=method, box=(LOW, HIGH))
    ball.environment.size = 32
    chair = scene.nodes[1]
    matrix = np.eye(4)
    matrix[:3, 3] = 0.2

    def step(number):
        probe = ball.environment
        if number == 1:
            chair.position = (-1.4, -1.0, 0.6)
        elif number == 2:
            ball.position = CENTER + 0.1
        elif number == 3:
            probe.position = CENTER + 0.2
        elif number == 4:
            probe.box = (LOW * 1.1, HIGH)
        elif number == 5:
            probe.proxy_matrix = matrix
        elif number == 6:
            probe.fetches = 35
        elif number == 7:
            probe.parallax = "layers"
        elif number == 8:
            probe.parallax = "distance"
        elif number == 9:
            probe.parallax = "sphere"
        elif number == 10:
            probe.samples, probe.parallax = 4, "layers"

    pictures = []
    for number in range(11):
        step(number)
        pictures.append(any_path.render(scene, CAMERA, SIZE, format="rgba32f").color)
        fresh = new_renderer().render(scene, CAMERA, SIZE, format="rgba32f").color
        assert_identical(pictures[-1], fresh)
    changed = [not np.array_equal(a, b) for a, b in itertools.pairwise(pictures)]
    assert sum(changed) >= 6


@pytest.mark.parametrize("method", METHODS)
def test_nothing_is_drawn_again_without_a_change(renderer, method):
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax=method, box=(LOW, HIGH))
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.views_drawn == 1 + 6 * (2 if method == "layers" else 1)
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.views_drawn == 0
    ball.environment.far = 900
    renderer.render(scene, CAMERA, SIZE)
    assert renderer.stats.views_drawn >= 7


@pytest.mark.parametrize("update", ["once", "manual", 2])
def test_policies_keep_cube_and_distances_together(fresh_renderer, new_renderer, update):
    """A cube that is not drawn again is looked up with the distances of its own time."""
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax="layers", update=update)
    fresh_renderer.update_probes(scene, probes=ball.environment)
    first = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    ball.visible = True
    scene.nodes[1].position = (-2.2, 0.9, 0.5)
    other = new_renderer()
    other.update_probes(scene, probes=ball.environment)
    moved = other.render(scene, CAMERA, SIZE, format="rgba32f")
    fresh_renderer.update_probes(scene, probes=ball.environment)
    now = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    assert_identical(now, moved.color)
    assert not np.array_equal(first, now)


def test_layers_of_a_probe_that_is_drawn_once(fresh_renderer):
    """If a probe with the policy "once" gets a second layer later, the renderer draws that layer."""
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax="distance", update="once", fetches=35)
    fresh_renderer.render(scene, CAMERA, SIZE)
    ball.environment.parallax = "layers"
    frame = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    scene.remove(ball)
    add_ball(scene, parallax="layers", fetches=35)
    assert_identical(frame, fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color)


def test_faces_one_by_one(fresh_renderer, new_renderer):
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax="layers", faces_per_frame=1)
    fresh_renderer.render(scene, CAMERA, SIZE)
    scene.nodes[1].position = (-1.2, 0.9, 0.5)
    for _ in range(6):
        frame = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    ball.environment.faces_per_frame = 6
    assert_identical(frame, new_renderer().render(scene, CAMERA, SIZE, format="rgba32f").color)


def test_several_samples_have_the_same_distances(renderer):
    scene = room(FURNITURE)
    ball = add_ball(scene, parallax="distance", fetches=35)
    one, *_ = mirrored(renderer, scene, ball)
    ball.environment.samples = 4
    several, *_ = mirrored(renderer, scene, ball)
    off = np.linalg.norm(one - several, axis=-1)
    assert np.quantile(off, 0.9) < 0.05
    assert off.max() > 0  # the edges of what is seen are smooth now


LOOK = """uniform sampler2D way; uniform sampler2D from; uniform float roughness;
vec3 shade(Surface s) {
    vec3 d = texelFetch(way, ivec2(gl_FragCoord.xy), 0).xyz;
    vec3 p = texelFetch(from, ivec2(gl_FragCoord.xy), 0).xyz;
    return %s;
}"""
COUNT = 40


def looked_up(renderer, scene, expression, ways, places, roughness=0.0, **options):
    """The value of a GLSL expression of a direction `d` and a place `p`, for rows (COUNT, 3) of both.

    It is looked up on a strip of pixels in the room, and returned with the places of these pixels.
    """
    size = 3.0 / COUNT
    node = scene.add(
        quad(COUNT, 1),
        cc.ShaderMaterial(
            LOOK % expression,
            uniforms={"roughness": roughness},
            textures={
                "way": cc.Image(np.float32(ways)[None]),
                "from": cc.Image(np.float32(places)[None]),
            },
        ),
        environment=cc.Probe(CENTER, size=64, format="rgba32f", **options),
        scale=size,
        position=(-1.5, 0, 1),
    )
    middle = (0, size / 2)
    camera = cc.OrthographicCamera(height=size, position=(*middle, 1.5), target=(*middle, 0))
    frame = renderer.render(scene, camera, (COUNT, 1), format="rgba32f", outputs=("position",))
    scene.remove(node)
    return frame.color[0, :, :3].astype(float), frame.outputs["position"][0].astype(float)


def some_rays():
    rng = np.random.default_rng(3)
    ways = rng.normal(size=(COUNT, 3))
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    return ways, CENTER + rng.uniform(-1, 1, (COUNT, 3))


@pytest.mark.parametrize("method", METHODS)
def test_environment_at_another_place(any_path, method):
    """`environment_at(position, direction)` is what a mirror at that position sees in that direction."""
    ways, places = some_rays()
    scene = room()
    options = {"parallax": method, "box": (LOW, HIGH), "fetches": 35}
    got, here = looked_up(any_path, scene, "environment_at(p, d)", ways, places, **options)
    want = exact_hit(places, ways)
    if method == "sphere":
        found = parallax.sphere_direction(places, ways, CENTER, LOW, HIGH)
        want = exact_hit(CENTER[None], found.direction)
    assert np.quantile(np.linalg.norm(got - want, axis=-1), 0.85) < 0.08
    # `environment(direction)` is the same at the surface.
    at_surface, _ = looked_up(
        any_path, scene, "environment_at(s.position, d)", ways, places, **options
    )
    plain, _ = looked_up(any_path, scene, "environment(d)", ways, places, **options)
    assert_identical(at_surface, plain)
    assert np.median(np.linalg.norm(plain - want, axis=-1)) > 0.15
    if method != "sphere":
        want = exact_hit(here, ways)
        assert np.quantile(np.linalg.norm(plain - want, axis=-1), 0.85) < 0.08


@pytest.mark.parametrize("method", ["box", "distance", "layers"])
@pytest.mark.parametrize("roughness", [0.15, 0.4, 0.8])
def test_the_level_follows_from_the_cone(renderer, method, roughness):
    """A lobe looks the cube up in the corrected direction, by the roughness of its cone seen from the capture."""
    ways, places = some_rays()
    scene = room()
    options = {"parallax": method, "box": (LOW, HIGH), "fetches": 35}
    source = "environment_filtered(d, roughness)"
    got, here = looked_up(renderer, scene, source, ways, places, roughness, **options)
    found = parallax.box_direction(here, ways, CENTER, LOW, HIGH)
    lobes = parallax.roughness_at(np.full(COUNT, roughness), found)
    # The lobe's roughness comes by the first number of `p`, and no parallax is corrected.
    given = np.stack([lobes, lobes, lobes], axis=-1)
    source = "environment_filtered(d, p.x)"
    want, _ = looked_up(renderer, scene, source, found.direction, given)
    # In a march, a pixel is as exact as its place on the wall.
    assert np.quantile(np.abs(got - want), 0.95) < (1e-4 if method == "box" else 0.02)
    for other in (np.full((COUNT, 3), roughness), given**2):
        wrong, _ = looked_up(renderer, scene, source, found.direction, other)
        assert np.abs(wrong - want).mean() > 2 * np.abs(got - want).mean()


def test_box_levels_of_both_layers(fresh_renderer):
    """All surfaces have one colour, so that each level of each layer has it, too."""
    scene = room(FURNITURE)
    for node in scene.nodes:
        node.material = cc.BasicMaterial(color=(0.25, 0.5, 1), double_sided=True)
    ball = add_ball(scene, parallax="layers", fetches=35)
    ball.material = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return environment_mip(reflect(s.incident, s.normal), 3.0); }"
    )
    frame = fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f", outputs=("id",))
    on = frame.outputs["id"] == ball.id
    np.testing.assert_allclose(frame.color[on][:, :3], [[0.25, 0.5, 1]] * on.sum(), rtol=1e-3)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"parallax": "cube"}, "parallax: expected"),
        (
            {"parallax": "box"},
            r"expected box=\(low, high\), the corners of the proxy, with parallax='box', got None",
        ),
        ({"parallax": "sphere"}, "parallax='sphere', got None"),
        ({"box": ((0, 0, 0), (1, 0, 1))}, r"low < high on each axis, got low \(0, 0, 0\)"),
        ({"box": ((0, 0, 0), (1, np.inf, 1))}, "finite"),
        ({"box": (1, 2, 3)}, r"box: expected shape \(2, 3\)"),
        ({"proxy_matrix": np.zeros((4, 4))}, r"last row is \(0, 0, 0, 1\)"),
        ({"proxy_matrix": np.diag([1, 1, 0, 1])}, "can be inverted, got a singular one"),
        ({"fetches": 7}, "fetches of 6, 14 or 35, got 7"),
        (
            {"parallax": "distance", "depth_format": "depth_component24"},
            "depth_format 'depth_component32f'",
        ),
        ({"parallax": "layers", "depth_format": None}, "depth_format 'depth_component32f'"),
    ],
)
def test_what_is_refused(options, message):
    with pytest.raises((ValueError, TypeError), match=message):
        cc.Probe(**options)


def test_properties_and_pickles():
    matrix = np.eye(4)
    matrix[:3, 3] = 1, 2, 3
    probe = cc.Probe(parallax="box", box=((-1, -2, -3), (1, 2, 3)), proxy_matrix=matrix, fetches=6)
    again = pickle.loads(pickle.dumps(probe))
    for one in (probe, again):
        assert (one.parallax, one.fetches) == ("box", 6)
        np.testing.assert_array_equal(one.box, [[-1, -2, -3], [1, 2, 3]])
        np.testing.assert_array_equal(one.proxy_matrix, matrix)
    with pytest.raises(ValueError, match="with parallax='box', got None"):
        probe.box = None
    probe.parallax = "none"
    probe.box = probe.proxy_matrix = None
    assert probe.box is None
    assert probe.proxy_matrix is None
    assert "parallax='box'" in repr(again)
