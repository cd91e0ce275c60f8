"""Exact rays against formulas: furnaces, lamps, irradiance, glass, and mirrors that face each other."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.bsdf.standard import evaluate
from cubecam.truth.shading import fresnel_dielectric, normalised, reflect, refract
from cubecam.truth.shading.standard.material import Parameters, Surface
from tests.reference.transforms import pixel_rays

SIZE = (24, 24)
WHITE = cc.CubeMap(np.ones((6, 2, 2, 3), np.float32))


def eye(distance=3.0, **options):
    return cc.PerspectiveCamera(position=(0, 0, distance), target=(0, 0, -9), near=0.05, **options)


def rendered(scene, camera=None, size=SIZE, **options):
    return cc.truth.render(scene, camera or eye(), size, outputs=("id",), processes=1, **options)


def noise_of(picture, rows):
    """The standard error of the mean of some pixels."""
    return np.sqrt((picture.deviation[rows].astype(float) ** 2).sum()) / rows.sum()


# --- furnaces: in light of 1 from all sides, a white body that keeps all energy cannot be seen ------------------------


@pytest.mark.parametrize(
    "material",
    [
        cc.MirrorMaterial(),
        cc.GlassMaterial(ior=1.5),
        cc.StandardMaterial(metallic=1, roughness=0),
        cc.StandardMaterial(metallic=1, roughness=0.5),
        cc.StandardMaterial(metallic=1, roughness=1),
        cc.StandardMaterial(metallic=0, roughness=1, specular_weight=0),
        cc.StandardMaterial(metallic=0, roughness=0),
        cc.StandardMaterial(metallic=0, roughness=0.4),
        cc.StandardMaterial(metallic=0, roughness=1),
        cc.StandardMaterial(metallic=0, roughness=0, transmission=1, thickness=1),
        cc.StandardMaterial(metallic=0, roughness=0, transmission=1),
    ],
    ids=lambda m: repr(m)[:70],
)
def test_a_white_body_is_not_seen(material):
    scene = cc.Scene(environment=WHITE)
    scene.add(cc.Mesh.sphere(0.8, 48, 24), material)
    picture = rendered(scene, samples=32, bounces=12)
    inside = picture.id == 1
    assert inside.sum() > 30
    mean = picture.color[inside, :3].astype(float).mean(axis=0)
    assert mean == pytest.approx(1, abs=max(5 * noise_of(picture, inside), 2e-3))


def test_ambient_light_is_an_environment():
    scene = cc.Scene()
    scene.add(cc.AmbientLight(color=(0.2, 0.4, 0.6), intensity=0.5))
    scene.add(
        cc.Mesh.sphere(0.8, 48, 24), cc.StandardMaterial(metallic=0, roughness=1, specular_weight=0)
    )
    picture = rendered(scene, samples=16)
    light = picture.color.reshape(-1, 4).sum(axis=0, dtype=float)
    assert light[:3] / light[3] == pytest.approx(
        (0.1, 0.2, 0.3), rel=1e-3
    )  # the background is transparent


# --- lamps ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lamp", "illuminance"),
    [
        (cc.DirectionalLight(direction=(0, -3, -4), intensity=2.5), 2.5 * 0.8),
        (cc.PointLight(position=(0, 0, 2), intensity=8, decay=2), 8 / 4),
        (cc.SpotLight(position=(0, 0, 2), direction=(0, 0, -1), intensity=8, decay=2), 8 / 4),
    ],
)
def test_a_matt_surface_sends_back_a_share_of_the_light_over_pi(lamp, illuminance):
    """KHR_lights_punctual: lux of a directional light; candela over the squared distance."""
    scene = cc.Scene()
    scene.add(lamp)
    matt = cc.StandardMaterial(color=(0.5, 1, 0.25), metallic=0, roughness=1, specular_weight=0)
    scene.add(cc.Mesh.box((0.02, 0.02, 2)), matt, position=(0, 0, -1))
    picture = rendered(scene, eye(3, fov=0.2), samples=4)
    expected = np.array([0.5, 1, 0.25]) * illuminance / np.pi
    assert picture.color[12, 12, :3] == pytest.approx(expected, rel=1e-3)


def test_a_shadow_is_sharp_and_lies_where_rays_are_stopped():
    scene = cc.Scene()
    lamp = scene.add(cc.PointLight(position=(0, 4, 0), shadow=cc.Shadow(size=64, radius=4)))
    floor = scene.add(cc.Mesh.plane(8, 8), cc.PhongMaterial(color="white", ka=0, kd=1, ks=0))
    ball = scene.add(cc.Mesh.icosphere(0.5, 5), cc.PhongMaterial(), position=(0, 2, 0))
    ball.in_captures = False  # a caster all the same
    down = cc.OrthographicCamera(
        height=4, position=(0, 1, 0), target=(0, 0, 0), up=(0, 0, -1), near=0.1
    )
    picture = cc.truth.render(scene, down, (64, 64), samples=1, outputs=("position",), processes=1)
    away = np.linalg.norm(picture.position[..., [0, 2]], axis=-1)
    edge = 4 * np.tan(np.arcsin(0.5 / 2))  # the cone of the lamp that touches the ball
    dark = picture.color[..., 0] == 0
    assert dark[away < edge - 0.02].all()
    assert not dark[away > edge + 0.02].any()
    floor.receive_shadow = False
    assert not (rendered(scene, down).color[..., 0] == 0).any()
    floor.receive_shadow, lamp.shadow = True, None
    assert not (rendered(scene, down).color[..., 0] == 0).any()


# --- light from all around --------------------------------------------------------------------------------------------


def sun_and_sky():
    faces = np.full((6, 16, 16, 3), 0.1, np.float32)
    faces[2, 6:8, 5:9] = (300, 250, 200)
    faces[0] = (0.2, 0.4, 0.8)
    return cc.CubeMap(faces)


def test_matt_light_is_the_irradiance_of_the_environment():
    cube = sun_and_sky()
    turn = cc.axis_angle((1, 2, 3), 40)
    scene = cc.Scene(environment=cube, environment_rotation=turn, environment_intensity=2)
    matt = cc.StandardMaterial(metallic=0, roughness=1, specular_weight=0)
    scene.add(cc.Mesh.icosphere(0.8, 4), matt)
    names = ("id", "normal")
    picture = cc.truth.render(scene, eye(), SIZE, samples=64, processes=1, outputs=names)
    rows = picture.id == 1
    w, x, y, z = turn
    normal = picture.normal[rows].astype(float)
    # R^-1 n: what the cube shows in d appears in R d.
    u = np.array([-x, -y, -z])
    local = normal + 2 * np.cross(u, np.cross(u, normal) + w * normal)
    rng = np.random.default_rng(0)
    spread = rng.normal(size=(1 << 18, 3))
    spread /= np.linalg.norm(spread, axis=-1, keepdims=True)
    light = cube.sample(spread).astype(float)
    for index in rng.choice(len(local), 12, replace=False):
        cosine = np.maximum(spread @ local[index], 0)
        expected = 2 * 4 * (cosine[:, None] * light).mean(axis=0)  # 2: intensity; 4 pi / pi
        got = picture.color[rows][index, :3]
        error = 4 * picture.deviation[rows][index] + 0.02 * expected.max() + 0.02
        assert got == pytest.approx(expected, abs=error)
    # The sun is chosen by its brightness: random directions alone would be a hundred times as noisy.
    assert picture.noise < 0.2


def test_rough_metal_gathers_the_sun_without_bias():
    """Two ways to choose directions, by the lobe and by the brightness of the sky, are counted once together."""
    sky = sun_and_sky()
    scene = cc.Scene(environment=sky)
    gold = cc.StandardMaterial(color=(1, 0.8, 0.4), metallic=1, roughness=0.6)
    scene.add(cc.Mesh.plane(1, 1), gold, rotation=cc.axis_angle((1, 0, 0), 45))
    both = rendered(scene, eye(3, fov=1), (4, 4), samples=512)
    v = np.array([0, 0, 1.0])
    n = np.array([0, np.sqrt(0.5), np.sqrt(0.5)])
    rng = np.random.default_rng(1)
    spread = rng.normal(size=(1 << 19, 3))
    spread /= np.linalg.norm(spread, axis=-1, keepdims=True)
    above = spread[spread @ n > 0]
    surface = Surface(
        np.zeros_like(above), np.tile(v, (len(above), 1)), np.tile(n, (len(above), 1))
    )
    p = Parameters(color=(1, 0.8, 0.4), metallic=1.0, roughness=0.6)
    value = evaluate(p, surface, above) * sky.sample(above)
    expected = 2 * np.pi * value.mean(axis=0)
    assert both.color[..., :3].reshape(-1, 3).mean(axis=0) == pytest.approx(expected, rel=0.05)


def test_light_of_other_surfaces():
    """A matt floor under a glowing ceiling of the same size gets the form factor of two equal squares."""
    scene = cc.Scene()
    matt = cc.StandardMaterial(metallic=0, roughness=1, specular_weight=0)
    scene.add(cc.Mesh.plane(0.02, 0.02), matt)
    glow = cc.StandardMaterial(
        color="black", metallic=0, roughness=1, emissive=(1, 2, 3), specular_weight=0
    )
    scene.add(cc.Mesh.plane(2, 2), glow, position=(0, 1, 0), rotation=cc.axis_angle((1, 0, 0), 180))
    view = cc.PerspectiveCamera(fov=1, position=(0.1, 0.5, 0.1), target=(0, 0, 0), near=0.01)
    picture = cc.truth.render(scene, view, (8, 8), samples=512, processes=1)
    a = 1.0  # half of the side over the distance; J. Howell's configuration factor B-3, of a point below a corner
    quarter = (a / np.sqrt(1 + a * a) * np.arctan(a / np.sqrt(1 + a * a))) / np.pi
    got = picture.color[..., :3].reshape(-1, 3).mean(axis=0)
    assert got == pytest.approx(4 * quarter * np.array([1, 2, 3]), rel=0.01)


# --- glass ------------------------------------------------------------------------------------------------------------


def directions_through(camera, size):
    origin, direction = pixel_rays(camera.view, camera.projection(size[0] / size[1]), size)
    return origin.reshape(-1, 3), normalised(direction.reshape(-1, 3))


def through_a_ball(origin, direction, radius, ior):
    """Where rays that hit a ball leave it, without reflections; and the length of the way inside."""
    b = (origin * direction).sum(-1, keepdims=True)
    c = (origin * origin).sum(-1, keepdims=True) - radius**2
    hit = (b * b - c)[:, 0] > 0
    enter = origin + (-b - np.sqrt(np.maximum(b * b - c, 0))) * direction
    n = enter / radius
    inside = refract(direction, n, 1 / ior)
    length = -2 * (enter * inside).sum(-1, keepdims=True)
    leave = enter + length * inside
    return hit, refract(inside, -leave / radius, ior), length, (direction, n)


def test_light_goes_through_both_sides_of_a_glass_ball():
    rng = np.random.default_rng(2)
    cube = cc.CubeMap(rng.random((6, 4, 4, 3), np.float32))
    scene = cc.Scene(environment=cube)
    scene.add(cc.Mesh.icosphere(1, 6), cc.GlassMaterial(ior=1.5, tint=(1, 0.8, 0.6), fresnel=False))
    picture = rendered(scene, samples=1)
    origin, direction = directions_through(eye(), SIZE)
    hit, out, _, _ = through_a_ball(origin, direction, 1, 1.5)
    rim = np.linalg.norm(np.cross(origin, direction), axis=-1)
    inner = hit & (rim < 0.9)
    expected = cube.sample(out[inner]) * [1, 0.8, 0.6]
    apart = np.abs(picture.color.reshape(-1, 4)[inner, :3] - expected)
    assert inner.sum() > 100
    assert np.quantile(apart, 0.99) < 0.02  # facets bend light a little more or less than a ball


def test_glass_reflects_and_refracts_by_fresnel():
    """Light of 1 from behind the viewer, none from before: a ball shows what the first surface reflects."""
    faces = np.zeros((6, 32, 32, 3), np.float32)
    faces[4] = 1  # +z, behind the viewer
    cube = cc.CubeMap(faces)
    scene = cc.Scene(environment=cube)
    scene.add(cc.Mesh.plane(1, 1), cc.GlassMaterial(ior=1.5), rotation=cc.axis_angle((1, 0, 0), 90))
    picture = rendered(scene, eye(fov=10), samples=256)
    expected = fresnel_dielectric(np.array([1.0]), 1 / 1.5)[0]  # 4 %
    assert picture.color[..., 0].mean() == pytest.approx(expected, rel=0.05)


def test_light_does_not_leave_glass_beyond_the_critical_angle():
    """Inside a glass block a ray at 45 degrees is reflected by a side, of n = 1.5, and leaves below."""
    faces = np.zeros((6, 4, 4, 3), np.float32)
    faces[3] = (1, 0, 0)  # below
    faces[1] = (0, 1, 0)  # where the light would go without total reflection
    scene = cc.Scene(environment=cc.CubeMap(faces))
    # The ray enters a prism straight through the face of z, meets the sloping face at 45 degrees, and leaves downwards.
    corners = np.array([[0, 0, 0], [0, 0, -1], [0, 1, 0]], np.float32)
    aside = np.array([0.5, 0, 0], np.float32)
    points = np.concatenate([corners - aside, corners + aside])
    triangles = [
        (0, 2, 1), (3, 4, 5),  # the two ends
        (0, 3, 5), (0, 5, 2),  # z = 0
        (0, 1, 4), (0, 4, 3),  # y = 0
        (2, 5, 4), (2, 4, 1),  # the slope
    ]  # fmt: skip
    prism = cc.Mesh(points, np.array(triangles, np.uint32)).flat_shaded()
    glass = cc.GlassMaterial(ior=1.5, fresnel=False)
    scene.add(prism, glass)
    view = cc.OrthographicCamera(height=0.2, position=(0, 0.4, 3), target=(0, 0.4, 0))
    color = rendered(scene, view, (4, 4), samples=1).color[..., :3]
    assert color.reshape(-1, 3) == pytest.approx(np.tile([1.0, 0, 0], (16, 1)), abs=1e-6)
    glass.ior = 1.3  # below the square root of 2
    color = rendered(scene, view, (4, 4), samples=1).color[..., :3]
    assert color[..., 0].max() < 0.1


def test_a_body_absorbs_light_along_the_way():
    scene = cc.Scene(environment=WHITE)
    clear = cc.StandardMaterial(
        metallic=0, roughness=0, transmission=1, ior=1, thickness=1,
        attenuation_color=(0.5, 0.25, 1), attenuation_distance=0.4,
    )  # fmt: skip
    scene.add(cc.Mesh.box((1, 1, 0.8)), clear)
    color = rendered(scene, eye(fov=1), (4, 4), samples=64).color[..., :3].reshape(-1, 3)
    assert color.mean(axis=0) == pytest.approx([0.25, 0.0625, 1], rel=0.02)
    assert color[:, 0] / color[:, 2] == pytest.approx(np.full(16, 0.25), rel=1e-3)


def test_a_ball_in_glass_is_seen_through_it():
    """Bodies in bodies: a ball of the same index in a block of glass cannot be seen."""
    rng = np.random.default_rng(4)
    cube = cc.CubeMap(rng.random((6, 4, 4, 3), np.float32))
    glass = cc.GlassMaterial(ior=1.4, fresnel=False)
    pictures = []
    for radius in (None, 0.3):
        scene = cc.Scene(environment=cube)
        scene.add(cc.Mesh.icosphere(0.8, 5), glass)
        if radius:
            scene.add(cc.Mesh.icosphere(radius, 5), glass)
        pictures.append(rendered(scene, samples=1, bounces=8).color)
    assert np.abs(pictures[0] - pictures[1]).max() < 2e-3


def test_dispersion_parts_colours():
    faces = np.zeros((6, 64, 64, 3), np.float32)
    faces[:, :, 32:] = 1  # an edge between black and white on each face
    scene = cc.Scene(environment=cc.CubeMap(faces))
    prism = cc.StandardMaterial(
        metallic=0, roughness=0, transmission=1, thickness=1, ior=1.5, specular_weight=0
    )
    scene.add(cc.Mesh.icosphere(0.8, 5), prism)
    grey = rendered(scene, samples=64).color[..., :3]
    prism.dispersion = 5
    colourful = rendered(scene, samples=64).color[..., :3]
    spread = [np.abs(c[..., 0] - c[..., 2])[6:18, 6:18].max() for c in (grey, colourful)]
    assert spread[0] < 1e-6
    assert spread[1] > 0.2


# --- mirrors ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("bounces", [0, 1, 2, 5])
def test_mirrors_that_face_each_other(bounces):
    """Each mirror keeps a half; after `bounces` of them the last one sees the environment."""
    scene = cc.Scene(environment=WHITE)
    half = cc.MirrorMaterial(tint=(0.5, 0.5, 0.5))
    for z, degrees in ((-1, 90), (1, -90)):
        turn = cc.axis_angle((1, 0, 0), degrees)
        scene.add(cc.Mesh.plane(4, 4), half, position=(0, 0, z), rotation=turn)
    picture = rendered(scene, eye(0.5, fov=20), samples=1, bounces=bounces)
    assert picture.color[..., :3].max() == pytest.approx(0.5 ** (bounces + 1))
    assert picture.color[..., :3].min() == pytest.approx(0.5 ** (bounces + 1))


def test_after_the_last_bounce_a_probe_shows_the_environment_or_black():
    scene = cc.Scene(background=(0, 1, 0))
    mirror = scene.add(
        cc.Mesh.plane(1, 1), cc.MirrorMaterial(), rotation=cc.axis_angle((1, 0, 0), 90)
    )
    mirror.environment = cc.Probe(parent=mirror)
    view = eye(3, fov=10)
    assert rendered(scene, view, samples=1).color[12, 12, :3].tolist() == [0, 1, 0]
    assert rendered(scene, view, samples=1, bounces=0).color[12, 12, :3].tolist() == [0, 0, 0]
    scene.environment = WHITE
    assert rendered(scene, view, samples=1, bounces=0).color[12, 12, :3].tolist() == [1, 1, 1]


def test_a_node_may_show_itself_or_not():
    scene = cc.Scene(environment=WHITE)
    inside_out = cc.Mesh.box(2)
    bowl = cc.Mesh(inside_out.positions, inside_out.indices[:, ::-1], normals=-inside_out.normals)
    scene.add(bowl, cc.MirrorMaterial(tint=(0.5, 0.5, 0.5)))
    assert rendered(scene, eye(0), samples=1, bounces=3).color[9, 13, 0] == pytest.approx(0.5**4)
    alone = rendered(scene, eye(0), samples=1, bounces=3, self_hits=False)
    assert alone.color[9, 13, 0] == pytest.approx(0.5)


def test_mirrors_do_not_show_nodes_that_are_not_in_captures():
    scene = cc.Scene(environment=WHITE)
    scene.add(cc.Mesh.plane(4, 4), cc.MirrorMaterial(), rotation=cc.axis_angle((1, 0, 0), 90))
    black = cc.BasicMaterial(color="black", double_sided=True)
    behind = scene.add(
        cc.Mesh.plane(40, 40), black, position=(0, 0, 5), rotation=cc.axis_angle((1, 0, 0), 90)
    )
    assert rendered(scene, samples=1).color[..., 0][8:16, 8:16].max() == 0
    behind.in_captures = False
    assert rendered(scene, samples=1).color[..., 0][8:16, 8:16].min() == 1


def test_reflect_is_that_of_the_mirror():
    """A tilted mirror shows the texel in the direction of the law of reflection."""
    rng = np.random.default_rng(8)
    cube = cc.CubeMap(rng.random((6, 8, 8, 3), np.float32))
    scene = cc.Scene(environment=cube)
    turn = cc.axis_angle((1, 0.3, 0), 60)
    scene.add(cc.Mesh.plane(2, 2), cc.MirrorMaterial(), rotation=turn)
    names = ("id", "normal")
    picture = cc.truth.render(scene, eye(), SIZE, samples=1, outputs=names, processes=1)
    _, direction = directions_through(eye(), SIZE)
    rows = picture.id.reshape(-1) == 1
    expected = cube.sample(reflect(direction, picture.normal.reshape(-1, 3))[rows])
    assert rows.sum() > 50
    assert picture.color.reshape(-1, 4)[rows, :3] == pytest.approx(expected, abs=1e-4)


def test_each_surface_chooses_anew():
    """A glass plate lets (1 - R) / (1 + R) through: with the same number at both sides it would be 1 - R."""
    faces = np.zeros((6, 4, 4, 3), np.float32)
    faces[5] = 1  # -z, behind the plate
    scene = cc.Scene(environment=cc.CubeMap(faces))
    scene.add(cc.Mesh.box((4, 4, 0.1)), cc.GlassMaterial(ior=2))
    picture = rendered(scene, eye(fov=4), (4, 4), samples=1024, bounces=8)
    share = 1 / 9
    assert picture.color[..., 0].mean() == pytest.approx((1 - share) / (1 + share), abs=0.02)


def test_light_leaves_a_body_of_glass_without_self_hits_too():
    rng = np.random.default_rng(2)
    scene = cc.Scene(environment=cc.CubeMap(rng.random((6, 4, 4, 3), np.float32)))
    scene.add(cc.Mesh.icosphere(0.8, 3), cc.GlassMaterial(fresnel=False))
    both = [rendered(scene, samples=1, self_hits=hits).color for hits in (True, False)]
    assert np.array_equal(both[0], both[1])
