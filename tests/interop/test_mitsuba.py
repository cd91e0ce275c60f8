"""Scenes of `Scene.to_mitsuba`, rendered by Mitsuba 3."""

import warnings

import numpy as np
import pytest

import cubecam as cc
from tests.interop.mitsuba import cube_of_place, rendered

pytestmark = pytest.mark.interop


@pytest.fixture
def mitsuba(tmp_path):
    return lambda *scenes: rendered(tmp_path, scenes)


@pytest.fixture(scope="module")
def renderer():
    with cc.Renderer(device="software") as made:
        yield made


FINER = 4


def mean_over_pixels(renderer, scene, camera, size):
    """cubecam's picture as means over pixels, and where a pixel and its neighbours show one surface only."""
    width, height = size
    large = (FINER * width, FINER * height)
    frame = renderer.render(scene, camera, large, format="rgba32f", outputs=("id",))
    blocks = frame.color.reshape(height, FINER, width, FINER, 4).mean(axis=(1, 3))
    ids = frame.id.reshape(height, FINER, width, FINER)
    low, high = ids.min(axis=(1, 3)), ids.max(axis=(1, 3))
    around = [
        np.roll(np.roll(a, i, 0), j, 1) for a in (low, high) for i in (-1, 0, 1) for j in (-1, 0, 1)
    ]
    return blocks, np.ptp(around, axis=0) == 0


def difference(picture, wanted, where):
    """The mean and the median difference of colours where `where` holds, and how much of the picture that is."""
    error = np.abs(picture - wanted)[where][:, :3]
    return error.mean(), np.median(error), where.mean()


def picture_of_place(size=16):
    """A picture without any symmetry: red grows along u, green along v, and one corner is blue."""
    at = (np.arange(size) + 0.5) / size
    pixels = np.zeros((size, size, 3), np.float32)
    pixels[..., 0] = at
    pixels[..., 1] = 1 - at[:, None]  # row 0 is v = 1
    pixels[: size // 3, : size // 3, 2] = 1
    return pixels


def basic_scene():
    scene = cc.Scene()
    picture = picture_of_place()
    scene.add(
        cc.Mesh.plane(),
        cc.BasicMaterial(map=picture, double_sided=True),
        position=(-0.6, 0, 0),
        rotation=cc.axis_angle((1, 0.2, 0), 70),
    )
    scene.add(
        cc.Mesh.box(0.6),
        cc.BasicMaterial(map=cc.Image(picture, wrap="clamp"), color=(1, 0.5, 2)),
        position=(0.7, 0.2, -0.4),
        rotation=cc.axis_angle((1, 2, 3), 40),
    )
    # A mirrored mesh, whose triangles are turned round.
    ball = cc.Mesh.sphere(0.4)
    ball.update(colors=np.c_[(ball.positions + 0.4) / 0.8])
    scene.add(
        ball, cc.BasicMaterial(vertex_colors=True), position=(0.1, -0.6, 0.3), scale=(-1, 0.7, 1)
    )
    scene.add(
        cc.Mesh.plane(),
        cc.BasicMaterial(color="gold"),
        position=(0, 0.9, -1),
        rotation=cc.axis_angle((1, 0, 0), 90),
    )
    return scene


CAMERAS = {
    "perspective": cc.PerspectiveCamera(fov=45, position=(0.5, 0.8, 3), target=(0, 0.1, 0)),
    "behind": cc.PerspectiveCamera(fov=45, position=(0.5, 0.4, -3), target=(0, 0.1, 0)),
    "shifted": cc.PerspectiveCamera(
        fov=50, position=(0, 0, 3), target=(0, 0, 0), shift=(0.15, -0.1)
    ),
    "orthographic": cc.OrthographicCamera(
        height=2.6, position=(1, 0.5, 3), target=(0, 0.1, 0), up=(0.2, 1, 0)
    ),
}


def quietly(scene, *arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", cc.SceneWarning)
        return scene.to_mitsuba(*arguments, **options)


def test_unlit_surfaces_equal_the_renderers(mitsuba, renderer, tmp_path):
    """Directions of cameras, uvs, colours of vertices, mirrored and double-sided meshes; the file equals the dict."""
    scene, size = basic_scene(), (72, 48)
    dicts = [quietly(scene, camera, size, path=tmp_path / "a.xml") for camera in CAMERAS.values()]
    pictures = mitsuba(*dicts, tmp_path / "a.xml")
    for name, camera, picture in zip(CAMERAS, CAMERAS.values(), pictures, strict=False):
        colors, where = mean_over_pixels(renderer, scene, camera, size)
        mean, median, covered = difference(picture, colors, where)
        assert covered > 0.5, name
        assert mean < 0.002, name  # the edges of texels are sampled
        assert median < 1 / 255, name
    assert np.array_equal(pictures[-1], pictures[-2])


VIEW = cc.PerspectiveCamera(fov=50, position=(0, 2, 3), target=(0, 0, 0))


def place(scene, material, mesh=None, **options):
    scene.add(mesh or cc.Mesh.sphere(1), material, **options)
    return scene


def in_environment():
    scene = cc.Scene()
    scene.environment = cube_of_place()
    scene.environment_rotation = cc.axis_angle((1, 2, 0.5), 50)
    scene.environment_intensity = 1.5
    return scene


def under(*lights):
    scene = cc.Scene()
    for light in lights:
        scene.add(light)
    return scene


def matt(color=(0.8, 0.5, 0.2), **options):
    return cc.StandardMaterial(color=color, metallic=0, specular_weight=0, **options)


def bumps(size=32):
    y, x = np.mgrid[:size, :size] / size * 2 * np.pi
    normals = np.stack([0.6 * np.sin(8 * x), 0.4 * np.cos(4 * y), np.zeros_like(x)], axis=-1)
    normals[..., 2] = np.sqrt(1 - (normals**2).sum(axis=-1))
    return cc.Image(((normals + 1) / 2).astype(np.float32))


def veil(size=8):
    pixels = np.full((size, size, 4), 0.5, np.float32)
    pixels[..., 0] = np.linspace(0, 1, size)
    pixels[..., 3] = np.linspace(0.1, 1, size)[:, None]
    return cc.Image(pixels, wrap="clamp")


def holes(size=8):
    pixels = (np.asarray(veil(size).pixels) * 255).astype(np.uint8)
    pixels[..., 3] = 255
    pixels[2:4, 2:5, 3] = 0
    return cc.Image(pixels)


def rough_map():
    pixels = np.zeros((8, 8, 3), np.float32)
    pixels[..., 1] = np.linspace(0.4, 1, 8)
    pixels[..., 2] = 1
    return cc.Image(pixels, wrap="clamp")


def colorful(mesh):
    low, high = mesh.bounds
    mesh.update(colors=(mesh.positions - low) / np.maximum(high - low, 1e-9))
    return mesh


def over_blue(material, mesh):
    scene = place(cc.Scene(), material, mesh)
    return place(
        scene, cc.BasicMaterial(color=(0.2, 0.3, 0.9)), cc.Mesh.plane(4, 4), position=(0, -0.5, 0)
    )


LAMP = cc.PointLight((0.3, 1, 0.2), intensity=3, decay=2, color=(1, 0.9, 0.8))
HIGH = cc.PointLight((-2, 1, 2), intensity=20, decay=2)
SUN = cc.DirectionalLight((-1, -1, -0.5), intensity=0.8)
FADING = cc.SpotLight((0.3, 1.5, 0.2), (0.2, -1, 0.1), angle=40, penumbra=0.6, intensity=6, decay=2)
SHARP = cc.SpotLight((0.3, 1.5, 0.2), (0.2, -1, 0.1), angle=25, intensity=6, decay=2)
PLANE = cc.Mesh.plane(2, 2)
FLOOR = cc.Mesh.plane(4, 4)

#: Scenes of which cubecam's picture is exact: how to make one, and the greatest mean difference.
EXACT = {
    "environment": (in_environment, 0.002),
    "mirror": (lambda: place(in_environment(), cc.MirrorMaterial(tint=(1, 0.8, 0.6))), 0.003),
    "mirror with a colour": (
        lambda: place(in_environment(), cc.MirrorMaterial(env_weight=0.5, color=(0.2, 0.1, 0.5), color_weight=1)),
        0.003,
    ),
    "no bend": (lambda: place(in_environment(), cc.GlassMaterial(ior=1.0001, tint=(0.9, 0.5, 0.3)), PLANE), 0.002),
    "point": (lambda: place(under(LAMP), matt(double_sided=True), FLOOR), 0.002),
    "spot": (lambda: place(under(FADING), matt(), FLOOR), 0.002),
    "sharp spot": (lambda: place(under(SHARP), matt(), FLOOR), 0.004),
    "phong": (lambda: place(under(SUN), cc.PhongMaterial(color=(0.8, 0.9, 0.3), ka=0, ks=0)), 0.002),
    "phong beside matt": (
        lambda: place(place(under(SUN), cc.PhongMaterial(ka=0, ks=0)), matt(), PLANE, position=(3, 0, -3)),
        0.002,
    ),
    "flat": (lambda: place(under(SUN), matt(flat_shading=True), cc.Mesh.icosphere(1, 1)), 0.003),
    "metal": (lambda: place(under(HIGH), cc.StandardMaterial(color=(1, 0.7, 0.3), roughness=0.5)), 0.004),
    "roughness map": (
        lambda: place(under(LAMP), cc.StandardMaterial(metallic_roughness_map=rough_map()), PLANE),
        0.003,
    ),
    "stretched": (lambda: place(under(HIGH), cc.StandardMaterial(roughness=0.4, anisotropy=0.8)), 0.004),
    "colours of vertices": (
        lambda: place(under(HIGH), cc.StandardMaterial(roughness=0.6), colorful(cc.Mesh.sphere(1))),
        0.003,
    ),
    "bumps": (lambda: place(under(LAMP), matt(normal_map=bumps(), normal_scale=0.7), PLANE), 0.002),
    "bumps on a ball": (lambda: place(under(HIGH), matt(normal_map=bumps(), normal_scale=0.7)), 0.006),
    "placed map": (
        lambda: place(
            under(SUN), matt((1, 1, 1), map=cc.Texture(veil(), offset=(0.1, 0.2), rotation=20, scale=(0.6, 0.5)),
                             alpha_mode="opaque"), PLANE,
        ),
        0.003,
    ),
    "veil": (lambda: over_blue(cc.BasicMaterial(map=veil(), opacity=0.8), PLANE), 0.01),
    "added": (lambda: over_blue(cc.BasicMaterial(map=veil(), opacity=0.8, blend="additive"), PLANE), 0.003),
    "holes": (
        lambda: place(under(SUN), matt((1, 1, 1), map=holes(), alpha_mode="mask"), PLANE),
        0.005,
    ),
    "lamp of many colours": (
        lambda: place(cc.Scene(), cc.BasicMaterial(vertex_colors=True), colorful(cc.Mesh.plane(2, 2))),
        0.002,
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def both(renderer, tmp_path_factory):
    """For each scene of EXACT Mitsuba's picture, cubecam's, and where they can be compared."""
    size, made = (48, 32), {name: make() for name, (make, _) in EXACT.items()}
    scenes = [quietly(scene, VIEW, size, max_depth=3, samples=128) for scene in made.values()]
    pictures = rendered(tmp_path_factory.mktemp("exact"), scenes)
    return {
        name: (picture, *mean_over_pixels(renderer, scene, VIEW, size))
        for (name, scene), picture in zip(made.items(), pictures, strict=True)
    }


@pytest.mark.parametrize("name", EXACT)
def test_what_cubecam_draws_exactly_is_equal(both, name):
    picture, colors, where = both[name]
    assert colors[where][:, :3].max() > 0.05  # something is seen
    mean, _, covered = difference(picture, colors, where)
    assert covered > 0.3
    assert mean < EXACT[name][1]


def test_a_dielectric_is_at_most_a_tenth_brighter(renderer, mitsuba):
    scene = place(under(HIGH), cc.StandardMaterial(color=(1, 0.7, 0.3), metallic=0, roughness=0.5))
    size = (48, 32)
    (picture,) = mitsuba(quietly(scene, VIEW, size, max_depth=2, samples=128))
    colors, where = mean_over_pixels(renderer, scene, VIEW, size)
    ratio = picture[where][:, :3].sum() / colors[where][:, :3].sum()
    assert 1 < ratio < 1.1


def test_a_matt_plane_under_a_point_light_by_its_formula(mitsuba):
    """Radiance = albedo / pi * intensity * cos / distance^2."""
    scene = place(
        under(cc.PointLight((0.5, 2, 0), intensity=7, decay=2)), matt((0.5, 1, 0.25)), FLOOR
    )
    camera = cc.OrthographicCamera(height=2, position=(0, 1, 0), target=(0, 0, 0), up=(0, 0, -1))
    (picture,) = mitsuba(quietly(scene, camera, (20, 20), max_depth=2, samples=256))
    at = (np.arange(20) + 0.5) / 10 - 1
    squared = (at - 0.5) ** 2 + at[:, None] ** 2 + 4
    wanted = 7 / np.pi * 2 / squared**1.5
    assert picture[..., :3] == pytest.approx(wanted[..., None] * [0.5, 1, 0.25], rel=0.01)


def test_a_ball_absorbs_by_its_thickness(mitsuba):
    scene = cc.Scene()
    scene.environment = cc.CubeMap(np.ones((6, 4, 4, 3), np.float32))
    dye = cc.StandardMaterial(
        metallic=0, roughness=0, ior=1.01, transmission=1, thickness=2,
        attenuation_color=(0.5, 0.2, 0.9), attenuation_distance=1,
    )  # fmt: skip
    place(scene, dye, cc.Mesh.sphere(1, 128, 64))
    camera = cc.OrthographicCamera(height=0.2, position=(0, 0, 3))
    (picture,) = mitsuba(quietly(scene, camera, (6, 6), samples=512))
    assert picture[..., :3].mean(axis=(0, 1)) == pytest.approx([0.25, 0.04, 0.81], abs=0.02)
