"""GlassMaterial(surfaces=2): light through both sides of a body, against the exact way through balls and prisms.

The surroundings show directions, so that a pixel of a body without reflections is the direction in which light leaves
it; in a room whose walls show places, it is the point that the light comes from.
"""

import itertools
import pickle

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import bodies
from cubecam.truth.shading.cubes import directions_of_texels
from cubecam.truth.shading.fresnel import fresnel_dielectric
from cubecam.truth.shading.vectors import dot, normalised, refract
from tests.compare import assert_identical
from tests.reference.transforms import rotation

SIZE = (48, 40)
WHITE = cc.CubeMap(np.ones((6, 1, 1, 3), np.float32))
CAMERA = cc.PerspectiveCamera(position=(0.9, 0.7, 3.0), target=(0, 0, 0), fov=40)


def compass():
    """Surroundings that show the direction in which they are seen."""
    return cc.CubeMap(normalised(directions_of_texels(64)).astype(np.float32))


def glass(**options):
    return cc.GlassMaterial(**{"surfaces": 2, "fresnel": False, **options})


def prism():
    """Equal sides and flat faces, along z."""
    angles = np.radians([90, 210, 330])
    triangle = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    points = np.concatenate(
        [np.column_stack([triangle, np.full(3, z)]) for z in (-0.8, 0.8)]
    ).astype(np.float32)
    sides = [t for i, k in ((0, 1), (1, 2), (2, 0)) for t in ((i, k, k + 3), (i, k + 3, i + 3))]
    faces = [(0, 2, 1), (3, 4, 5), *sides]
    return cc.Mesh(points, np.array(faces, np.uint32)).flat_shaded()


def planes_of(mesh):
    """The planes of a convex mesh of flat faces: normals and heights."""
    corners = np.asarray(mesh.positions, float)[np.asarray(mesh.indices)]
    normals = normalised(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    return normals, (normals * corners[:, 0]).sum(axis=-1)


def shown(renderer, mesh, material, camera=CAMERA, around=None, **placing):
    """Of a body's pixels: the colour, the place and the normal, and the direction of the ray to it."""
    scene = cc.Scene(background=(0, 0, 0), environment=compass() if around is None else around)
    node = scene.add(mesh, material, **placing)
    frame = renderer.render(
        scene, camera, SIZE, format="rgba32f", outputs=("position", "normal", "id")
    )
    on = frame.outputs["id"] == node.id
    position, normal = (frame.outputs[name][on].astype(float) for name in ("position", "normal"))
    incident = normalised(position - camera.position)
    return frame.color[on][:, :3].astype(float), position, normal, incident


def passages(position, normal, incident, ior, leave):
    return bodies.through(position, refract(incident, normal, 1 / ior), ior, leave)


def degrees_between(a, b):
    a, b = normalised(a), normalised(b)
    return np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(a - b, axis=-1) / 2, 0, 1)))


BALL = cc.Mesh.icosphere(0.8, subdivisions=5)


@pytest.mark.parametrize("ior", [1.1, 1.33, 1.5, 2.4, 1 / 1.33])
def test_a_ball_refracts_twice(any_path, ior):
    color, _, normal, incident = shown(any_path, BALL, glass(ior=ior))
    inside = 1 - (1 - dot(incident, normal)[:, 0] ** 2) / ior**2 > 0.02  # not near total reflection
    # The exact ball: from the direction of the ray and the normal alone.
    found = passages(normal * 0.8, normal, incident, ior, bodies.ball(0.8))
    off = degrees_between(color, found.direction)[inside]
    assert inside.sum() > 300
    assert np.median(off) < 0.15
    assert np.quantile(off, 0.98) < 0.8
    # One refraction alone shows something else.
    once, *_ = shown(any_path, BALL, glass(ior=ior, surfaces=1))
    assert np.median(degrees_between(once, found.direction)[inside]) > 2


@pytest.mark.parametrize("ior", [1.2, 1.5])
def test_total_reflection_in_a_prism_and_a_block(any_path, ior):
    """Flat faces are exact but for places where a lookup mixes two of them."""
    for mesh in (prism(), cc.Mesh.box((1.6, 1.1, 0.9))):
        color, position, normal, incident = shown(any_path, mesh, glass(ior=ior))
        found = passages(position, normal, incident, ior, bodies.convex(*planes_of(mesh)))
        reflected = found.met > 1
        off = degrees_between(color, found.direction)
        assert len(off) > 300
        assert reflected.mean() > (0.1 if ior == 1.5 else 0)
        assert np.median(off) < 0.05
        assert (off < 0.5).mean() > 0.9
        if ior == 1.5:
            assert (off[reflected] < 0.5).mean() > 0.8


def test_a_pane_shifts_light_and_does_not_bend_it(any_path):
    """A thin box fills as many texels of its inner side as a thick one."""
    pane = cc.Mesh.box((2, 2, 0.02))
    color, _, normal, incident = shown(any_path, pane, glass(ior=1.5))
    front = normal[:, 2] > 0.99
    assert front.sum() > 500
    assert np.quantile(degrees_between(color, incident)[front], 0.95) < 0.02


@pytest.mark.parametrize(
    "matrix",
    [
        np.diag([1.5, 0.6, 1.0]),
        rotation((0.9, 0.1, 0.4, -0.15))[:3, :3] @ np.diag([0.7, 1.2, 1.1]),
        np.diag([-1.0, 1.2, 0.8]),
        np.array([[1.0, 0.4, 0], [0, 0.9, 0], [0.2, 0, 1.1]]),
        np.diag([1e-3, 1.2e-3, 0.8e-3]),
    ],
    ids=["uneven", "turned", "mirrored", "sheared", "small"],
)
def test_a_matrix_of_the_node_equals_one_of_the_mesh(any_path, matrix):
    size = np.abs(matrix).max()
    camera = cc.PerspectiveCamera(
        position=size * np.array([0.9, 0.7, 3.0]), target=(0, 0, 0), fov=40, near=size / 100, far=99
    )
    look = glass(ior=1.4, attenuation_color=(0.9, 0.5, 0.2), attenuation_distance=float(size))
    node = np.eye(4)
    node[:3, :3] = matrix
    got, *_ = shown(any_path, BALL, look, camera, matrix=node)
    positions = np.asarray(BALL.positions, float) @ matrix.T
    normals = normalised(np.asarray(BALL.normals, float) @ np.linalg.inv(matrix))
    faces = np.asarray(BALL.indices)
    if np.linalg.det(matrix) < 0:
        faces = faces[:, ::-1]
    baked = cc.Mesh(positions.astype(np.float32), faces, normals=normals.astype(np.float32))
    want, *_ = shown(any_path, baked, look, camera)
    assert got.shape == want.shape
    off = np.abs(got - want)
    assert np.median(off) < 2e-3
    assert np.quantile(off, 0.97) < 0.03


def test_light_is_absorbed_along_the_way(any_path):
    """exp(-x / d ln(1 / c)), x the length of the way in the world, also where light is reflected inside."""
    tint, color, distance = (0.9, 0.8, 1), (0.5, 0.25, 0.9), 0.7
    look = glass(
        ior=1.5, tint=tint, attenuation_color=color, attenuation_distance=distance, fresnel=False
    )
    for mesh, leave in (
        (BALL, bodies.ball(0.8)),
        (prism(), bodies.convex(*planes_of(prism()))),
    ):
        got, position, normal, incident = shown(any_path, mesh, look, around=WHITE)
        start = 0.8 * normal if mesh is BALL else position
        found = passages(start, normal, incident, 1.5, leave)
        want = np.array(tint) * np.array(color) ** (found.way[:, None] / distance)
        off = np.abs(got - want).max(axis=-1)
        assert np.quantile(off, 0.9) < 0.01
    small, large = (shown(any_path, BALL, look, around=WHITE, scale=s)[0] for s in (1.0, 1.2))
    assert large.mean() < 0.95 * small.mean()


def test_one_surface_absorbs_nothing(renderer):
    options = {"attenuation_color": (0.5, 0.2, 0.1), "attenuation_distance": 0.1}
    plain, *_ = shown(renderer, BALL, glass(surfaces=1))
    same, *_ = shown(renderer, BALL, glass(surfaces=1, **options))
    assert_identical(plain, same)


@pytest.mark.parametrize("surfaces", [1, 2])
@pytest.mark.parametrize("ior", [1.5, 0.7])
def test_each_colour_has_its_own_index(any_path, surfaces, ior):
    dispersion = 3.0
    turned = cc.axis_angle((1, 2, 0), 50)
    mesh = prism() if ior > 1 else BALL  # whose middle is not reflected totally

    def colors(**options):
        return shown(any_path, mesh, glass(surfaces=surfaces, **options), rotation=turned)[0]

    parted = colors(ior=ior, dispersion=dispersion)
    alone = [colors(ior=float(n)) for n in bodies.spread(ior, dispersion)]
    want = np.stack([alone[i][:, i] for i in range(3)], axis=-1)
    off = np.abs(parted - want).max(axis=-1)
    assert np.quantile(off, 0.97) < 1e-4
    assert (np.abs(parted - alone[1]).max(axis=-1) > 0.005).mean() > 0.12


def test_blue_is_bent_more_than_red(renderer):
    """Behind a prism a white line on black is red on one side and blue on the other, the side of its base."""
    faces = np.zeros((6, 256, 256, 3), np.float32)
    height = normalised(directions_of_texels(256))[..., 1]
    faces[np.abs(height + 0.55) < 0.04] = 1
    turned = cc.axis_angle((0, 1, 0), 90)
    camera = cc.PerspectiveCamera(position=(0, 0.1, 4), target=(0, 0.1, 0), fov=30)
    color, position, *_ = shown(
        renderer,
        prism(),
        glass(ior=1.4, dispersion=4.0),
        camera,
        cc.CubeMap(faces),
        rotation=turned,
    )
    at = [np.average(position[:, 1], weights=color[:, i] + 1e-9) for i in range(3)]
    assert color.max() > 0.9
    # More bent light reaches the line from higher up.
    assert at[0] < at[1] < at[2]


def test_a_white_furnace_stays_white(any_path):
    """What the far side reflects in part is taken to be as bright as what it lets through."""
    for mesh in (BALL, prism()):
        got, *_ = shown(any_path, mesh, glass(ior=1.5, fresnel=True), around=WHITE)
        np.testing.assert_allclose(got, 1, atol=1e-6)


def test_the_near_side_reflects_by_fresnel(any_path):
    got, _, normal, incident = shown(
        any_path, BALL, glass(fresnel=True, tint=(0, 0, 0)), around=WHITE
    )
    want = fresnel_dielectric(-dot(incident, normal), 1 / 1.5)
    np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), atol=1e-4)


RING = [
    (np.cos(u) * (0.7 + 0.3 * np.cos(v)), 0.3 * np.sin(v), np.sin(u) * (0.7 + 0.3 * np.cos(v)))
    for u in np.linspace(0, 2 * np.pi, 48, endpoint=False)
    for v in np.linspace(0, 2 * np.pi, 24, endpoint=False)
]


def ring():
    """A torus round y, whose middle is outside of it."""
    at = np.arange(48 * 24).reshape(48, 24)
    a, b = at, np.roll(at, -1, axis=0)
    quads = np.stack([a, np.roll(a, -1, axis=1), np.roll(b, -1, axis=1), b], axis=-1).reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return cc.Mesh(np.array(RING, np.float32), faces.astype(np.uint32))


def exact_passages(mesh, position, normal, incident, ior):
    """By exact rays at all triangles."""
    corners = np.asarray(mesh.positions, float)[np.asarray(mesh.indices)]
    own = np.asarray(mesh.normals, float)[np.asarray(mesh.indices)]

    def leave(place, direction):
        # T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997.
        e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        best, found = np.full(len(place), np.inf), np.zeros((len(place), 3))
        for row, (p, d) in enumerate(zip(place, direction, strict=True)):
            h = np.cross(d, e2)
            det = (e1 * h).sum(axis=-1)
            with np.errstate(divide="ignore", invalid="ignore"):
                s = p - corners[:, 0]
                u = (s * h).sum(axis=-1) / det
                q = np.cross(s, e1)
                v = (q @ d) / det
                t = (e2 * q).sum(axis=-1) / det
            hit = (det < 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-4)  # backs
            if hit.any():
                k = np.flatnonzero(hit)[t[hit].argmin()]
                best[row] = t[k]
                found[row] = (1 - u[k] - v[k]) * own[k, 0] + u[k] * own[k, 1] + v[k] * own[k, 2]
        return best, np.where(np.isfinite(best)[:, None], normalised(found + 1e-30), 0.0)

    return bodies.through(position, refract(incident, normal, 1 / ior), ior, leave)


def test_a_ring_whose_middle_is_outside(any_path):
    mesh = ring()
    camera = cc.PerspectiveCamera(position=(0.5, 2.2, 2.2), target=(0, 0, 0), fov=40)
    color, position, normal, incident = shown(any_path, mesh, glass(ior=1.4), camera)
    want = exact_passages(mesh, position, normal, incident, 1.4)
    off = degrees_between(color, want.direction)
    assert np.isfinite(color).all()
    assert len(off) > 300
    assert np.median(off) < 0.1
    assert (off < 1).mean() > 0.68


def test_a_mesh_without_a_far_side_refracts_once(any_path):
    plane = cc.Mesh.plane(2, 2)
    bowl = cc.Mesh(
        BALL.positions, np.asarray(BALL.indices)[BALL.positions[BALL.indices].mean(1)[:, 2] > 0]
    )
    for mesh, placing in (
        (plane, {"rotation": cc.axis_angle((1, 0, 0), 70)}),
        (bowl, {}),
    ):
        options = {"ior": 1.5, "attenuation_color": (0.1, 0.2, 0.3), "attenuation_distance": 0.1}
        color, *_ = shown(any_path, mesh, glass(**options), **placing)
        once, *_ = shown(any_path, mesh, glass(**{**options, "surfaces": 1}), **placing)
        assert np.isfinite(color).all()
        same = np.abs(color - once).max(axis=-1) < 1e-4
        assert same.mean() > (0.99 if mesh is plane else 0.6)


def test_behind_what_the_middle_sees_light_is_refracted_once(renderer):
    """Two balls in one mesh: the middle, in the greater one, does not see the lesser one behind its side."""
    small = np.asarray(BALL.positions) * 0.3 + (1.3, 0, 0)
    both = cc.Mesh(
        np.concatenate([BALL.positions, small, small - np.array([2.6, 0, 0])]).astype(np.float32),
        np.concatenate([np.asarray(BALL.indices) + i * len(BALL.positions) for i in range(3)]),
    )
    camera = cc.PerspectiveCamera(position=(0, 0, 6), target=(0, 0, 0), fov=30)
    color, position, normal, incident = shown(renderer, both, glass(ior=1.5), camera)
    lesser = np.abs(position[:, 0]) > 0.95
    assert lesser.sum() > 30
    once = refract(incident, normal, 1 / 1.5)
    assert np.quantile(degrees_between(color, once)[lesser], 0.9) < 0.1
    found = passages(0.8 * normal, normal, incident, 1.5, bodies.ball(0.8))
    assert np.median(degrees_between(color, found.direction)[~lesser]) < 0.5


LOW, HIGH = np.array([-3.0, -2, -2.5]), np.array([3.5, 2.5, 2])
PLACE = cc.ShaderMaterial("vec3 shade(Surface s) { return s.position; }", double_sided=True)


@pytest.mark.parametrize("method", ["box", "distance", "layers"])
def test_in_a_room_light_comes_from_where_the_ray_that_left_the_body_ends(any_path, method):
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(cc.Mesh.box(1), PLACE, position=(LOW + HIGH) / 2, scale=HIGH - LOW)
    node = scene.add(BALL, glass(ior=1.5), position=(0.4, -0.3, 0.2), scale=0.5)
    node.environment = cc.Probe(
        parent=node, size=128, format="rgba32f", parallax=method, box=(LOW, HIGH)
    )
    camera = cc.PerspectiveCamera(position=(1.1, 0.8, 1.4), target=node.position, fov=45)
    frame = any_path.render(
        scene, camera, SIZE, format="rgba32f", outputs=("position", "normal", "id")
    )
    on = frame.outputs["id"] == node.id
    position, normal = (frame.outputs[name][on].astype(float) for name in ("position", "normal"))
    incident = normalised(position - camera.position)
    found = passages(0.4 * normal, normal, incident, 1.5, bodies.ball(0.4))
    start, way = found.position + node.position, found.direction
    with np.errstate(divide="ignore"):
        reach = np.where(way > 0, HIGH - start, LOW - start) / way
    want = start + reach.min(axis=-1, keepdims=True) * way
    off = np.linalg.norm(frame.color[on][:, :3] - want, axis=-1) / reach.min(axis=-1)
    assert len(off) > 200
    assert np.quantile(off, 0.8) < 0.02
    node.environment.parallax = "none"
    plain = any_path.render(scene, camera, SIZE, format="rgba32f").color[on][:, :3]
    assert np.median(np.linalg.norm(plain - want, axis=-1)) > 0.1


def test_captures_and_crowds(any_path, renderer):
    """In layers, face by face and instanced, a body has the same pixels; a face is what a camera sees."""
    scene = cc.Scene(environment=compass())
    look = glass(ior=1.5, fresnel=True, dispersion=0.5)
    for x, y, z in itertools.product((-2, 0, 2), repeat=3):
        if (x, y, z) != (0, 0, 0):
            scene.add(BALL, look, position=(1.5 * x, 1.4 * y, 1.3 * z), scale=(0.9, 1.2, 1))
    cube, other = (
        by.capture(scene, (0.1, 0, 0), size=32, format="rgba32f") for by in (any_path, renderer)
    )
    assert_identical(cube.faces, other.faces, across="programs")
    face = renderer.render(
        scene,
        cc.PerspectiveCamera(position=(0.1, 0, 0), target=(0.1, 0, -1), fov=90),
        (32, 32),
        format="rgba32f",
    )
    # Seen as a picture, a face is the mirror image of what the camera sees.
    off = np.abs(cube.faces[5][:, ::-1, :3] - face.color[..., :3]).max(axis=-1)
    assert np.quantile(off, 0.98) < 1e-4


@pytest.mark.parametrize("roughness", [0.35, 0.5])
def test_rough_glass_is_nearer_to_the_truth_than_clear_glass(renderer, roughness):
    rng = np.random.default_rng(3)
    faces = np.repeat(np.repeat(rng.random((6, 4, 4, 3)), 8, axis=1), 8, axis=2)
    scene = cc.Scene(environment=cc.CubeMap(faces.astype(np.float32)), background=(0, 0, 0))
    look = glass(ior=1.5, roughness=roughness)
    scene.add(BALL, look)
    camera = cc.PerspectiveCamera(position=(0, 0, 3), target=(0, 0, 0), fov=26)
    exact = cc.truth.render(
        scene,
        camera,
        (16, 16),
        samples=256,
        bounces=6,
        self_hits=False,
        progress=False,
        processes=1,
    ).color[..., :3]
    errors = {}
    for r in (roughness, 0.0, min(2 * roughness, 1.0)):
        look.roughness = r
        got = renderer.render(scene, camera, (16, 16), format="rgba32f").color[..., :3]
        errors[r] = float(np.sqrt(np.mean((got - exact)[3:13, 3:13] ** 2)))
    assert errors[roughness] < 0.5 * errors[0.0]
    assert errors[roughness] < errors[min(2 * roughness, 1.0)]


@pytest.mark.parametrize("options", [{}, {"dispersion": 3.0}, {"attenuation_distance": 0.8}])
def test_a_frame_and_exact_rays_agree(renderer, options):
    """A prism in surroundings that show directions, without the partial reflections that frames leave out."""
    scene = cc.Scene(environment=compass(), background=(0, 0, 0))
    look = glass(attenuation_color=(0.3, 0.6, 0.9), **options)
    scene.add(prism(), look, rotation=cc.axis_angle((1, 2, 0), 30))
    frame = renderer.render(scene, CAMERA, SIZE, format="rgba32f")
    exact = cc.truth.render(scene, CAMERA, SIZE, samples=1, bounces=5, progress=False, processes=1)
    on = exact.color[..., 3] > 0
    off = np.abs(frame.color[on][:, :3] - exact.color[on][:, :3]).max(axis=-1)
    assert on.sum() > 300
    assert (off < 0.01).mean() > 0.85


def test_the_inside_of_a_mesh_is_drawn_once(fresh_renderer):
    scene = cc.Scene(environment=compass())
    look = glass()
    nodes = [scene.add(BALL, look, position=(x, 0, 0), scale=0.2 + 0.1 * x) for x in range(3)]

    def calls():
        fresh_renderer.render(scene, CAMERA, SIZE)
        return fresh_renderer.stats.draw_calls

    first = calls()
    nodes[0].scale = (0.5, 0.3, 0.2)
    assert first - calls() == 6
    mesh = cc.Mesh(BALL.positions, BALL.indices)
    nodes[0].mesh = mesh
    again = calls()
    mesh.update(positions=np.asarray(BALL.positions) * np.float32(0.9))
    moved = calls()
    assert moved == again
    look.tint = (0.9, 0.9, 1)
    assert calls() < again


def test_a_mesh_that_changes_changes_what_is_seen_through_it(renderer, fresh_renderer):
    mesh = cc.Mesh(BALL.positions, BALL.indices)
    scene = cc.Scene(environment=compass())
    scene.add(mesh, glass())
    before = renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    corners = np.asarray(BALL.positions)
    mesh.update(positions=corners * (1 + 0.4 * corners[:, :1] * corners[:, 1:2]))
    after = renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    assert np.abs(before - after).max() > 0.1
    assert_identical(after, fresh_renderer.render(scene, CAMERA, SIZE, format="rgba32f").color)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("surfaces", 2),
        ("dispersion", 2.0),
        ("attenuation_distance", 0.3),
        ("attenuation_color", (0.2, 0.5, 0.9)),
    ],
)
def test_a_change_redraws_and_an_equal_value_does_not(fresh_renderer, name, value):
    look = glass(attenuation_distance=1.0, attenuation_color=(0.5, 0.5, 0.5))
    look.surfaces = 1 if name == "surfaces" else 2
    scene = cc.Scene(environment=compass())
    scene.add(BALL, look)
    before = fresh_renderer.render(scene, CAMERA, SIZE).color
    for drawn in (1, 0):
        setattr(look, name, value)
        after = fresh_renderer.render(scene, CAMERA, SIZE).color
        assert fresh_renderer.stats.views_drawn == drawn
    assert np.any(before != after)


def test_odd_bodies_have_finite_colours(renderer):
    flat = cc.Mesh(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32), np.array([[0, 1, 2]], np.uint32)
    )
    line = cc.Mesh(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.uint32))
    inside_out = cc.Mesh(BALL.positions, np.asarray(BALL.indices)[:, ::-1])
    scene = cc.Scene(environment=compass())
    for i, mesh in enumerate((flat, line, inside_out, cc.Mesh.plane(1, 1), ring())):
        for both in (False, True):
            look = glass(double_sided=both, roughness=0.3 * both, dispersion=float(both))
            scene.add(mesh, look, position=(i - 2, 0.8 * both, 0), scale=(0.5, 0.4, 0.3))
    color = renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
    assert np.isfinite(color).all()


def test_defaults_pickles_and_words():
    look = cc.GlassMaterial()
    assert (look.surfaces, look.dispersion, look.attenuation_distance) == (1, 0, float("inf"))
    np.testing.assert_array_equal(look.attenuation_color, [1, 1, 1])
    made = cc.GlassMaterial(
        surfaces=2, dispersion=0.5, attenuation_distance=2, attenuation_color=(1, 0.5, 0.25)
    )
    again = pickle.loads(pickle.dumps(made))
    assert repr(again) == repr(made)
    assert "surfaces=2" in repr(made)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"surfaces": 0}, "surfaces of 1 or 2, got 0"),
        ({"surfaces": 3}, "surfaces of 1 or 2, got 3"),
        ({"dispersion": -0.1}, "dispersion finite and not negative"),
        ({"attenuation_distance": 0}, "attenuation_distance above 0, or inf"),
        ({"attenuation_distance": float("nan")}, "attenuation_distance above 0, or inf"),
        ({"attenuation_color": (1, 2, 0)}, "attenuation_color from 0 to 1"),
    ],
)
def test_bad_values(options, message):
    with pytest.raises(ValueError, match=message):
        cc.GlassMaterial(**options)


def test_deformed_meshes_have_inner_sides_of_their_own(renderer):
    """Nodes of one mesh with different weights of a morph target, beside meshes of these shapes."""
    corners = np.asarray(BALL.positions)
    bump = (0.5 * corners * corners[:, :1] * corners[:, 1:2]).astype(np.float32)
    soft = cc.Mesh(corners, BALL.indices, morph_targets=[cc.MorphTarget(positions=bump)])
    for weight in (0.5, 1.0):
        colors = []
        for mesh in (soft, cc.Mesh(corners + np.float32(weight) * bump, BALL.indices)):
            scene = cc.Scene(environment=compass())
            for x, share in ((-0.9, 0.0), (0.9, weight)):
                own = soft if share == 0 else mesh
                node = scene.add(own, glass(), position=(x, 0, 0))
                if own is soft:
                    node.weights = [share]
            colors.append(renderer.render(scene, CAMERA, SIZE, format="rgba32f").color)
        off = np.abs(colors[0] - colors[1]).max(axis=-1)
        assert np.quantile(off, 0.98) < 1e-3


@pytest.mark.parametrize("blend", ["alpha", "additive"])
def test_translucent_glass_is_a_share_of_opaque_glass(any_path, blend):
    around = cc.CubeMap(np.full((6, 4, 4, 3), 8.0, np.float32))  # brighter than a screen
    looks = [
        glass(fresnel=True, attenuation_color=(0.5, 0.7, 0.9), attenuation_distance=1.0, **more)
        for more in ({}, {"opacity": 0.25, "blend": blend})
    ]
    full, part = (shown_colors(any_path, look, around) for look in looks)
    np.testing.assert_allclose(part[..., :3], 0.25 * full[..., :3], atol=1e-5)
    assert full.max() > 2


def shown_colors(renderer, look, around):
    scene = cc.Scene(background=(0, 0, 0), environment=around)
    scene.add(BALL, look)
    return renderer.render(scene, CAMERA, SIZE, format="rgba32f").color
