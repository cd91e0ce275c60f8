"""StandardMaterial against MirrorMaterial, furnaces and the numpy reference of glTF's appendix B and its extensions."""

# Options are chosen by name, and some values are wrong on purpose.
# mypy: disable-error-code="arg-type, assignment, call-overload, union-attr"

import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import Ambient, Directional, Point, Spot
from cubecam.truth.shading.standard.material import (
    Environment,
    Parameters,
    Surface,
    anisotropy_direction,
    mapped_normal,
    occluded,
)
from cubecam.truth.shading.standard.shade import shade
from tests.compare import assert_close, assert_identical
from tests.gl.flat import flat_camera, quad
from tests.gl.world import World, inner_smooth, perspective, smooth_environment
from tests.reference.lookups import environment_of

GREY = (0.25, 0.5, 0.4)


def constant_cube(color=(1.0, 1.0, 1.0), size=16):
    return cc.CubeMap(np.broadcast_to(np.float32(color), (6, size, size, 3)).copy())


def constant(color):
    """The same for the reference: light of one colour from all sides, and behind the surface."""
    light = np.asarray(color, float)

    def everywhere(directions, *_):
        return np.broadcast_to(light, np.shape(directions)).astype(float)

    return Environment(
        everywhere, everywhere, everywhere, 16, lambda position, *_: everywhere(position)
    )


def ball(material, environment=None, lights=(), size=(48, 36), **place):
    """(World, View) of one sphere."""
    world = World()
    world.sphere(0.9, subdivisions=4, material=material, **place)
    world.scene.environment = environment
    for light in lights:
        world.scene.add(light)
    return world, perspective((0.4, 0.6, 2.4), (0, 0, 0), fov=45, size=size)


def draw(renderer, world, view):
    return renderer.render(world.scene, view.camera, view.size, format="rgba32f").color


def surface_of(world, view, mask, hits):
    return Surface(
        position=hits.position[mask], v=-view.directions()[mask], geometric_n=hits.normal[mask]
    )


def check_ball(
    renderer,
    material,
    parameters,
    environment=None,
    around=None,
    lights=((), ()),
    background=None,
):
    world, view = ball(material, environment, lights[0])
    world.scene.background = background
    got = draw(renderer, world, view)
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    want = np.zeros((*hits.id.shape, 3))
    want[mask] = shade(parameters, surface_of(world, view, mask, hits), lights[1], around)
    assert_close(got[..., :3], want, "standard", mask=mask)


# --- against the reference --------------------------------------------------------------------------------------------

#: Arguments of StandardMaterial; those of the reference follow from them.
CASES: dict[str, dict[str, Any]] = {
    "metal": {"color": (0.9, 0.6, 0.2), "roughness": 0.35},
    "rough metal": {"color": (0.9, 0.6, 0.2), "roughness": 1},
    "dielectric": {"color": GREY, "metallic": 0, "roughness": 0.4},
    "mixed": {"color": GREY, "metallic": 0.4, "roughness": 0.6},
    "single scattering": {
        "color": GREY,
        "metallic": 0.4,
        "roughness": 0.8,
        "multiple_scattering": False,
    },
    "ior": {"color": GREY, "metallic": 0, "roughness": 0.3, "ior": 2.2},
    "specular": {
        "color": GREY,
        "metallic": 0,
        "roughness": 0.3,
        "specular_weight": 0.6,
        "specular_color": (1, 4, 30),
        "ior": 1.8,
    },
    "emissive": {"color": GREY, "emissive": (0.1, 0.2, 0.05), "emissive_strength": 1.5},
    "coat": {"color": GREY, "metallic": 0, "roughness": 0.7, "clearcoat": 0.8},
    "rough coat": {
        "color": GREY,
        "metallic": 0,
        "clearcoat": 1,
        "clearcoat_roughness": 0.5,
        "emissive": (0.2, 0.1, 0),
        "multiple_scattering": False,
    },
    "sheen": {
        "color": GREY,
        "metallic": 0,
        "roughness": 0.8,
        "sheen_color": (0.9, 0.5, 0.3),
        "sheen_roughness": 0.5,
    },
    "film on metal": {
        "color": (0.9, 0.8, 0.7),
        "roughness": 0.4,
        "iridescence": 0.9,
        "iridescence_thickness_max": 350,
    },
    "film on plastic": {
        "color": GREY,
        "metallic": 0.2,
        "roughness": 0.4,
        "iridescence": 1,
        "iridescence_ior": 1.7,
        "iridescence_thickness_max": 480,
    },
    "transmission": {"color": GREY, "metallic": 0, "roughness": 0.2, "transmission": 0.7},
    "volume": {
        "color": (0.9, 1, 0.8),
        "metallic": 0.1,
        "roughness": 0.2,
        "transmission": 1,
        "thickness": 0.5,
        "attenuation_distance": 0.4,
        "attenuation_color": (0.7, 0.2, 0.9),
        "ior": 1.4,
        "dispersion": 0.5,
    },
    "everything": {
        "color": GREY,
        "metallic": 0.3,
        "roughness": 0.5,
        "clearcoat": 0.6,
        "clearcoat_roughness": 0.3,
        "sheen_color": (0.3, 0.5, 0.9),
        "sheen_roughness": 0.7,
        "iridescence": 0.5,
        "transmission": 0.4,
        "emissive": (0.1, 0, 0.1),
    },
}
LIGHTS = (
    [
        cc.PointLight(position=(2, 3, 2), color=(1, 0.9, 0.8), intensity=6, decay=2),
        cc.DirectionalLight(direction=(1, -1, -0.5), color=(0.3, 0.5, 0.9)),
        cc.SpotLight((-1, 1, 3), (0.3, -0.4, -1), angle=25, penumbra=0.6, intensity=1.5),
        cc.AmbientLight(color=(0.2, 0.1, 0.3)),
    ],
    [
        Point((2, 3, 2), (1, 0.9, 0.8), 6, 2),
        Directional((1, -1, -0.5), (0.3, 0.5, 0.9)),
        Spot((-1, 1, 3), (0.3, -0.4, -1), 25, 0.6, intensity=1.5),
        Ambient((0.2, 0.1, 0.3)),
    ],
)


def parameters_of(options: dict[str, Any]) -> Parameters:
    """The reference's parameters for the arguments of StandardMaterial."""
    mine = dict(options)
    if "iridescence_thickness_max" in mine:
        mine["iridescence_thickness"] = mine.pop("iridescence_thickness_max")
    if "anisotropy_rotation" in mine:
        mine["anisotropy_direction"] = anisotropy_direction(mine.pop("anisotropy_rotation"))
    return Parameters(**mine)


@pytest.mark.parametrize("options", CASES.values(), ids=CASES)
def test_lights(renderer, options):
    material = cc.StandardMaterial(**options)
    check_ball(renderer, material, parameters_of(options), lights=LIGHTS)


@pytest.mark.parametrize("specular", ["levels", "sampled"])
@pytest.mark.parametrize("options", CASES.values(), ids=CASES)
def test_light_from_all_sides(renderer, options, specular):
    light = (0.6, 0.5, 0.4)
    options = {**options, "specular": specular}
    material = cc.StandardMaterial(**options)
    check_ball(renderer, material, parameters_of(options), constant_cube(light), constant(light))


#: The background: the scene behind the surface, however rough it is (test_behind.py tries the rest).
BEHIND = (0.3, 0.6, 0.2)


@pytest.fixture(scope="module")
def surroundings():
    """A smooth environment with its filtered levels, for the product and for the reference."""
    cube = cc.CubeMap(smooth_environment(32)).prefilter()
    around = environment_of(cube.levels[0], cube.levels[1:], cube.irradiance(size=32).faces)
    around.behind = lambda position, *_: np.broadcast_to(BEHIND, position.shape).astype(float)
    return cube, around


@pytest.mark.parametrize("specular", ["levels", "sampled"])
@pytest.mark.parametrize("options", CASES.values(), ids=CASES)
def test_an_environment(renderer, surroundings, options, specular):
    cube, around = surroundings
    options = {**options, "specular": specular, "specular_samples": 9}
    material = cc.StandardMaterial(**options)
    check_ball(renderer, material, parameters_of(options), cube, around, background=(*BEHIND, 1.0))


@pytest.mark.parametrize("specular", ["levels", "sampled"])
@pytest.mark.parametrize(
    ("roughness", "multiple_scattering"), [(0.3, True), (0.3, False), (0.0, True)]
)
def test_an_anisotropic_surface(renderer, surroundings, specular, roughness, multiple_scattering):
    """A rectangle seen from the side: highlights are stretched along its turned tangent."""
    cube, around = surroundings
    options = {
        "color": (0.9, 0.7, 0.5),
        "roughness": roughness,
        "anisotropy": 0.8,
        "anisotropy_rotation": 30,
        "specular": specular,
        "multiple_scattering": multiple_scattering,
    }
    world = World()
    material = cc.StandardMaterial(**options)
    world.plane(3, 3, material=material, degrees=20)
    world.scene.environment = cube
    world.scene.add(cc.PointLight(position=(0.3, 1, 0), intensity=0.3))
    view = perspective((0.4, 1.0, 1.6), (0, 0, 0), fov=60)
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    # Mesh.plane lies in XZ; u grows along its own +X, v along -Z.
    along = np.append(world.shapes[0].matrix[:3, 0], 1.0)
    surface = surface_of(world, view, mask, hits)
    surface.tangent = np.broadcast_to(along, (*surface.v.shape[:-1], 4))
    want = np.zeros((*hits.id.shape, 3))
    lights = [Point((0.3, 1, 0), intensity=0.3)]
    want[mask] = shade(parameters_of(options), surface, lights, around)
    assert_close(draw(renderer, world, view)[..., :3], want, "standard", mask=mask)


def test_more_samples_are_closer_to_the_integral(renderer):
    photograph = cc.load_environment(cc.sample_data("forest.exr"), size=64)
    world, view = ball(cc.StandardMaterial(roughness=0.3, specular="sampled"), photograph)
    material = world.scene.nodes[0].material
    mask = inner_smooth(view.hits(world.shapes)) & view.hits(world.shapes).hit

    def drawn(count):
        material.specular_samples = count
        return draw(renderer, world, view)[mask][:, :3].astype(float)

    exact = drawn(1024)
    errors = [np.sqrt(((drawn(n) - exact) ** 2).mean() / (exact**2).mean()) for n in (4, 16, 64)]
    assert errors[2] < 0.05 < errors[0]
    assert errors == sorted(errors, reverse=True)


# --- mirrors and furnaces ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("specular", ["levels", "sampled"])
def test_a_smooth_metal_is_a_mirror(any_path, specular):
    photograph = cc.load_environment(cc.sample_data("forest.exr"), size=64)
    for f0, color in ((None, (1, 1, 1)), (0.6, (0.6, 0.6, 0.6))):
        standard = cc.StandardMaterial(color=color, roughness=0, specular=specular)
        (world, view), (other, _) = (
            ball(material, photograph) for material in (standard, cc.MirrorMaterial(f0=f0))
        )
        got, want = draw(any_path, world, view), draw(any_path, other, view)
        np.testing.assert_allclose(got, want, atol=1 / 255)
        assert want.std() > 0.1


FURNACE: dict[str, dict[str, Any]] = {
    "plain": {},
    "coat": {"clearcoat": 1, "clearcoat_roughness": 0.6},
    "sheen": {"sheen_color": (1, 1, 1), "sheen_roughness": 0.6},
    "transmission": {"transmission": 0.5},
    "sampled": {"specular": "sampled", "specular_samples": 256},
}


@pytest.mark.parametrize("metallic", [0, 0.5, 1])
@pytest.mark.parametrize("options", FURNACE.values(), ids=FURNACE)
def test_white_furnace(renderer, metallic, options):
    """A white surface in light from all sides is not to be seen: it loses no light, and makes none."""
    for roughness in (0, 0.1, 0.35, 0.6, 1):
        material = cc.StandardMaterial(metallic=metallic, roughness=roughness, **options)
        world, view = ball(material, constant_cube(), size=(24, 18))
        got = draw(renderer, world, view)[..., :3]
        np.testing.assert_allclose(got, 1, atol=0.03 if "specular" in options else 0.01)
        np.testing.assert_allclose(got.mean(), 1, atol=0.002)


def test_single_scattering_loses_light(renderer):
    darkest: list[float] = []
    for roughness in (0.1, 0.5, 1):
        material = cc.StandardMaterial(roughness=roughness, multiple_scattering=False)
        world, view = ball(material, constant_cube(), size=(24, 18))
        darkest.append(draw(renderer, world, view)[..., :3].min())
    assert darkest[0] > 0.97
    assert darkest == sorted(darkest, reverse=True)
    assert 0.25 < darkest[2] < 0.4


def test_an_ambient_light_is_a_constant_environment(renderer):
    material = cc.StandardMaterial(color=GREY, metallic=0.5, roughness=0.6, clearcoat=0.5)
    first, view = ball(material, constant_cube((0.3, 0.2, 0.1)))
    second, _ = ball(material, None, [cc.AmbientLight(color=(0.3, 0.2, 0.1))])
    second.scene.background = first.scene.background = (0, 0, 0, 0)
    got = draw(renderer, second, view)
    np.testing.assert_allclose(got, draw(renderer, first, view), atol=2e-6)
    assert got[..., :3].max() > 0.1


# --- maps -------------------------------------------------------------------------------------------------------------

ROWS, COLUMNS = 6, 9
PICTURE = np.random.default_rng(12).uniform(0.05, 0.95, (ROWS, COLUMNS, 4)).astype(np.float32)
PICTURE[..., 3] = np.random.default_rng(13).uniform(0.3, 1, (ROWS, COLUMNS))
PLASTIC: dict[str, Any] = {"color": GREY, "metallic": 0.5, "roughness": 0.8}
TANGENT = np.array([1.0, 0, 0, 1])


def times(name, channels):
    """The texel's channels multiply the parameter."""

    def change(texel, parameters):
        value = np.asarray(getattr(parameters, name), float)
        setattr(parameters, name, value * texel[..., channels])

    return change


def metal_and_roughness(texel, parameters):
    parameters.roughness = parameters.roughness * texel[..., 1:2]
    parameters.metallic = parameters.metallic * texel[..., 2:3]


def occlusion(texel, parameters):
    parameters.occlusion = occluded(texel[..., :1], 0.7)


def film_thickness(texel, parameters):
    parameters.iridescence_thickness = 150 + (420 - 150) * texel[..., 1:2]


def stretch(texel, parameters):
    parameters.anisotropy_direction = anisotropy_direction(25, texel)
    parameters.anisotropy = parameters.anisotropy * texel[..., 2:3]


RED, GREEN, ALPHA, RGB = slice(0, 1), slice(1, 2), slice(3, 4), slice(0, 3)

#: Map: further arguments, and what its texels do to the reference's parameters.
MAPS: dict[str, tuple[dict[str, Any], Any]] = {
    "map": ({}, times("color", RGB)),
    "metallic_roughness_map": ({}, metal_and_roughness),
    "occlusion_map": (
        {"occlusion_strength": 0.7, "transmission": 0.6, "clearcoat": 0.5, "sheen_color": GREY},
        occlusion,
    ),
    "emissive_map": ({"emissive": (0.5, 0.6, 0.7)}, times("emissive", RGB)),
    "specular_map": ({"specular_weight": 0.9, "ior": 2}, times("specular_weight", ALPHA)),
    "specular_color_map": (
        {"specular_color": (0.5, 1, 2), "ior": 2},
        times("specular_color", RGB),
    ),
    "clearcoat_map": ({"clearcoat": 0.9}, times("clearcoat", RED)),
    "clearcoat_roughness_map": (
        {"clearcoat": 0.9, "clearcoat_roughness": 0.8},
        times("clearcoat_roughness", GREEN),
    ),
    "sheen_color_map": (
        {"sheen_color": (1, 0.5, 0.8), "sheen_roughness": 0.6},
        times("sheen_color", RGB),
    ),
    "sheen_roughness_map": (
        {"sheen_color": (1, 0.5, 0.8), "sheen_roughness": 0.9},
        times("sheen_roughness", ALPHA),
    ),
    "iridescence_map": (
        {"iridescence": 0.9, "iridescence_thickness_max": 400},
        times("iridescence", RED),
    ),
    "iridescence_thickness_map": (
        {
            "iridescence": 0.9,
            "iridescence_thickness_min": 150,
            "iridescence_thickness_max": 420,
        },
        film_thickness,
    ),
    "anisotropy_map": ({"anisotropy": 0.9, "anisotropy_rotation": 25}, stretch),
    "transmission_map": ({"transmission": 0.9}, times("transmission", RED)),
    "thickness_map": (
        {
            "transmission": 0.9,
            "thickness": 0.8,
            "attenuation_distance": 0.5,
            "attenuation_color": (0.3, 0.6, 0.9),
        },
        times("thickness", GREEN),
    ),
}
FLAT_LIGHTS = (
    [cc.DirectionalLight(direction=(0.3, -0.4, -1)), cc.AmbientLight(color=(0.1, 0.2, 0.1))],
    [Directional((0.3, -0.4, -1)), Ambient((0.1, 0.2, 0.1))],
)


def flat(renderer, material, mesh=None, environment=None, lights=FLAT_LIGHTS[0]):
    """The picture of a rectangle with one texel for each pixel, seen from in front."""
    # The environment is behind a transmissive surface, too.
    background = None if environment else (0, 0, 0, 0)
    scene = cc.Scene(environment=environment, background=background)
    for light in lights:
        scene.add(light)
    scene.add(mesh or quad(COLUMNS, ROWS), material)
    size = (COLUMNS, ROWS)
    return renderer.render(scene, flat_camera(*size), size, format="rgba32f").color


def flat_surface(**more):
    """The reference's view of the same rectangle."""
    y, x = np.mgrid[ROWS - 1 : -1 : -1, :COLUMNS] + 0.5
    ahead = np.broadcast_to([0.0, 0, 1], (ROWS, COLUMNS, 3))
    place = np.stack([x, y, 0 * x], -1)
    return Surface(
        place, ahead, ahead, tangent=np.broadcast_to(TANGENT, (ROWS, COLUMNS, 4)), **more
    )


@pytest.mark.parametrize("name", MAPS)
def test_a_map(renderer, name):
    options, change = MAPS[name]
    options = {**PLASTIC, **options}
    material = cc.StandardMaterial(
        **options, **{name: PICTURE}, alpha_mode="opaque", vertex_colors=False
    )
    light = (0.3, 0.2, 0.4)
    got = flat(renderer, material, environment=constant_cube(light))

    for extra in ("occlusion_strength", "iridescence_thickness_min"):
        options.pop(extra, None)
    parameters = parameters_of(options)
    change(PICTURE.astype(float), parameters)
    want = shade(parameters, flat_surface(), FLAT_LIGHTS[1], constant(light))
    assert_close(got[..., :3], want, "standard")
    assert want.std() > 0.01


@pytest.mark.parametrize("name", ["map", "emissive_map", "specular_color_map", "sheen_color_map"])
def test_colours_of_8_bits_are_srgb(renderer, name):
    """They are decoded, so the picture is that of the same numbers as linear floats."""
    options, _ = MAPS[name]
    bytes_ = np.round(PICTURE[..., :3] * 255).astype(np.uint8)
    encoded = bytes_ / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    pictures = [
        flat(renderer, cc.StandardMaterial(**PLASTIC, **options, **{name: picture}))
        for picture in (bytes_, linear.astype(np.float32))
    ]
    np.testing.assert_allclose(*pictures, atol=2e-3)


def test_maps_of_numbers_are_linear(renderer):
    bytes_ = np.round(PICTURE[..., :3] * 255).astype(np.uint8)
    pictures = [
        flat(renderer, cc.StandardMaterial(**PLASTIC, metallic_roughness_map=picture))
        for picture in (bytes_, (bytes_ / 255).astype(np.float32))
    ]
    np.testing.assert_allclose(*pictures, atol=2e-3)


def test_a_mesh_without_uvs_shows_no_map(renderer):
    bare = quad(COLUMNS, ROWS, uvs=None)
    plain = flat(renderer, cc.StandardMaterial(**PLASTIC), bare)
    names = ("map", "normal_map", "emissive_map", "occlusion_map", "metallic_roughness_map")
    mapped = cc.StandardMaterial(
        **PLASTIC, **dict.fromkeys(names, PICTURE[..., :3]), anisotropy=0.5
    )
    assert_identical(flat(renderer, mapped, bare), plain)


def test_each_map_has_its_place(renderer):
    """Two maps of one material lie in different places."""
    turned = cc.Texture(PICTURE[..., :3], offset=(1, 1), scale=(-1, -1))
    material = cc.StandardMaterial(unlit=True, map=turned, occlusion_map=PICTURE[..., :3])
    assert_close(flat(renderer, material)[..., :3], PICTURE[::-1, ::-1, :3], "lookup")
    lit = cc.StandardMaterial(
        metallic=0, roughness=1, specular_weight=0, map=turned, occlusion_map=PICTURE[..., :3]
    )
    got = flat(renderer, lit, lights=[cc.AmbientLight()])
    want = PICTURE[::-1, ::-1, :3] * PICTURE[..., :1]
    assert_close(got[..., :3], want, "standard")


def bumps(texels):
    """Texels as normals whose z is at least a half of their length."""
    texels = texels[..., :3].copy()
    texels[..., :2] = 0.5 + 0.6 * (texels[..., :2] - 0.5)
    texels[..., 2] = 0.75 + 0.25 * texels[..., 2]
    return texels


BUMPS = bumps(PICTURE)


def test_a_normal_map(renderer):
    material = cc.StandardMaterial(**PLASTIC, normal_map=BUMPS, normal_scale=0.7)
    want = flat_surface()
    want.n = mapped_normal(want.geometric_n, want.tangent, BUMPS, 0.7)
    got = flat(renderer, material)
    reference = shade(parameters_of(PLASTIC), want, FLAT_LIGHTS[1])
    assert_close(got[..., :3], reference, "standard")
    assert reference.std() > 0.02
    material.normal_scale = -0.7
    want.n = mapped_normal(want.geometric_n, want.tangent, BUMPS, -0.7)
    reference = shade(parameters_of(PLASTIC), want, FLAT_LIGHTS[1])
    assert_close(flat(renderer, material)[..., :3], reference, "standard")


def test_a_normal_map_of_a_coat(renderer):
    options = {**PLASTIC, "clearcoat": 1, "clearcoat_roughness": 0.6}
    maps = {"clearcoat_normal_map": BUMPS, "normal_map": BUMPS[::-1]}
    material = cc.StandardMaterial(**options, **maps, clearcoat_normal_scale=1.2)
    surface = flat_surface()
    surface.n = mapped_normal(surface.geometric_n, surface.tangent, BUMPS[::-1])
    surface.clearcoat_n = mapped_normal(surface.geometric_n, surface.tangent, BUMPS, 1.2)
    want = shade(parameters_of(options), surface, FLAT_LIGHTS[1])
    assert_close(flat(renderer, material)[..., :3], want, "standard")


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_back_of_a_normal_map(renderer, mirrored):
    """Behind a bump is a dent; a mirrored mesh has mirrored bumps."""
    scene = cc.Scene(background=(0, 0, 0, 0))
    for light in FLAT_LIGHTS[0]:
        scene.add(light)
    material = cc.StandardMaterial(**PLASTIC, normal_map=BUMPS, double_sided=True)
    node = scene.add(quad(COLUMNS, ROWS), material, position=(COLUMNS, 0, 0))
    if mirrored:
        node.scale = (-1, 1, 1)
    else:
        node.rotation = cc.axis_angle((0, 1, 0), 180)
    size = (COLUMNS, ROWS)
    got = renderer.render(scene, flat_camera(*size), size, format="rgba32f").color
    surface, texels = flat_surface(), BUMPS[:, ::-1]
    # The picture is mirrored, and so are the bumps' slopes along x.
    across = np.array([-1.0, 0, 0, -1 if mirrored else 1])
    tangent = np.broadcast_to(across, surface.tangent.shape)
    outside = surface.geometric_n if mirrored else -surface.geometric_n
    mapped = mapped_normal(outside, tangent, texels)
    surface.n = mapped if mirrored else -mapped
    want = shade(parameters_of(PLASTIC), surface, FLAT_LIGHTS[1])
    assert_close(got[..., :3], want, "standard")


def test_the_second_uvs(renderer):
    """One map lies by each set; a mesh without the second set does not show the map that needs it."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    place = [[0, 0, 0], [COLUMNS, 0, 0], [COLUMNS, ROWS, 0], [0, ROWS, 0]]
    mesh = cc.Mesh(place, [[0, 1, 2], [0, 2, 3]], uvs=corners, uvs1=1 - corners)
    second = cc.Texture(PICTURE[..., :3], uv_set=1)
    material = cc.StandardMaterial(unlit=True, map=second)
    assert_close(flat(renderer, material, mesh)[..., :3], PICTURE[::-1, ::-1, :3], "lookup")
    lit = cc.StandardMaterial(
        metallic=0, specular_weight=0, map=second, occlusion_map=PICTURE[..., :3]
    )
    want = PICTURE[::-1, ::-1, :3] * PICTURE[..., :1]
    assert_close(flat(renderer, lit, mesh, lights=[cc.AmbientLight()])[..., :3], want, "standard")
    assert (flat(renderer, material, quad(COLUMNS, ROWS))[..., :3] == 1).all()


# --- alpha ------------------------------------------------------------------------------------------------------------

HALF: dict[str, Any] = {"unlit": True, "color": (0.2, 0.4, 0.6, 0.5)}


def over_white(renderer, material, mesh=None):
    scene = cc.Scene(background=(1, 1, 1, 1))
    scene.add(mesh or quad(COLUMNS, ROWS), material)
    size = (COLUMNS, ROWS)
    return renderer.render(scene, flat_camera(*size), size, format="rgba32f").color


@pytest.mark.parametrize(
    ("options", "want"),
    [
        ({}, (0.6, 0.7, 0.8, 1)),
        ({"alpha_mode": "blend"}, (0.6, 0.7, 0.8, 1)),
        ({"alpha_mode": "opaque"}, (0.2, 0.4, 0.6, 1)),
        ({"alpha_mode": "mask"}, (0.2, 0.4, 0.6, 1)),
        ({"alpha_mode": "mask", "alpha_cutoff": 0.51}, (1, 1, 1, 1)),
        ({"alpha_mode": "opaque", "opacity": 0.25}, (0.8, 0.85, 0.9, 1)),
        ({"alpha_mode": "mask", "opacity": 0.25}, (0.8, 0.85, 0.9, 1)),
        ({"alpha_mode": "blend", "opacity": 0.5}, (0.8, 0.85, 0.9, 1)),
        ({"blend": "additive"}, (1.1, 1.2, 1.3, 1.5)),
        ({"blend": "opaque"}, (0.2, 0.4, 0.6, 1)),
    ],
)
def test_alpha_modes(any_path, options, want):
    got = over_white(any_path, cc.StandardMaterial(**HALF, **options))
    assert_close(got, np.broadcast_to(np.float32(want), got.shape), "blend")


def test_a_mask_has_holes(renderer):
    """Alpha is the product of colour, map and vertex colours; what is above the cutoff is opaque."""
    corners = np.array([[1, 1, 1, 1.0], [1, 1, 1, 0.5], [1, 1, 1, 0.5], [1, 1, 1, 1]])
    mesh = cc.Mesh(
        [[0, 0, 0], [COLUMNS, 0, 0], [COLUMNS, ROWS, 0], [0, ROWS, 0]],
        [[0, 1, 2], [0, 2, 3]],
        uvs=[[0, 0], [1, 0], [1, 1], [0, 1]],
        colors=corners,
    )
    material = cc.StandardMaterial(
        unlit=True, color=(1, 1, 1, 0.9), map=PICTURE, alpha_mode="mask", alpha_cutoff=0.4
    )
    across = 1 - 0.5 * (np.arange(COLUMNS) + 0.5) / COLUMNS
    alpha = 0.9 * PICTURE[..., 3] * across
    assert (np.abs(alpha - 0.4) > 1e-4).all()
    want = np.where((alpha >= 0.4)[..., None], PICTURE[..., :3], 1)
    assert_close(over_white(renderer, material, mesh)[..., :3], want, "lookup")
    assert 0.2 < (alpha >= 0.4).mean() < 0.8
    material.vertex_colors = False
    want = np.where((0.9 * PICTURE[..., 3:] >= 0.4), PICTURE[..., :3], 1)
    assert_close(over_white(renderer, material, mesh)[..., :3], want, "lookup")


@pytest.mark.parametrize("translucent", [False, True])
def test_blending_makes_a_node_late(renderer, translucent):
    """A late node writes no depth. "blend" makes one of an opaque colour, too; "mask" and "opaque" never do."""
    picture = np.full((2, 2, 4), 255, np.uint8)
    picture[..., 3] = 204 if translucent else 255
    scene = cc.Scene()
    material = cc.StandardMaterial(unlit=True, color="red", map=picture)
    scene.add(quad(9, 6), material, position=(0, 0, 1))
    scene.add(quad(9, 6), cc.StandardMaterial(unlit=True, color="lime"))
    late = {None: translucent, "blend": True, "mask": False, "opaque": False}
    for mode, wanted in late.items():
        material.alpha_mode = mode
        frame = renderer.render(scene, flat_camera(9, 6), (9, 6), outputs=("z",))
        np.testing.assert_allclose(frame.z, 5.0 if wanted else 4.0, atol=1e-4)
        share = 204 if translucent and wanted else 255
        assert (frame.color == (share, 255 - share, 0, 255)).all()


# --- the class --------------------------------------------------------------------------------------------------------

BAD: dict[str, list[Any]] = {
    "color": [(1, 1, 1.1), (-0.1, 0, 0), (1, 1, 1, 2), (np.nan, 0, 0)],
    "metallic": [-0.1, 1.1, np.nan],
    "roughness": [-0.1, 1.1],
    "normal_scale": [np.inf],
    "occlusion_strength": [1.5],
    "emissive": [(-1, 0, 0), (np.inf, 0, 0)],
    "emissive_strength": [-1],
    "alpha_mode": ["cut"],
    "alpha_cutoff": [-0.5],
    "ior": [0.9, -1, np.inf],
    "specular_weight": [1.5],
    "specular_color": [(0, 0, -1)],
    "clearcoat": [2],
    "clearcoat_roughness": [-1],
    "clearcoat_normal_scale": [np.nan],
    "sheen_color": [(2, 0, 0), "transparent"],
    "sheen_roughness": [1.01],
    "iridescence": [-1],
    "iridescence_ior": [0.5],
    "iridescence_thickness_min": [-1],
    "iridescence_thickness_max": [np.inf],
    "anisotropy": [1.5],
    "anisotropy_rotation": [np.inf],
    "transmission": [1.5],
    "thickness": [-1],
    "attenuation_distance": [0, -1, np.nan],
    "attenuation_color": [(0, 0, 1.5)],
    "dispersion": [-0.1],
    "specular": ["exact"],
    "specular_samples": [0, 1025],
}


@pytest.mark.parametrize(("name", "values"), BAD.items(), ids=BAD)
def test_bad_values(name, values):
    material = cc.StandardMaterial()
    before = repr(material)
    for value in values:
        with pytest.raises(ValueError, match=f"{name}.*"):
            cc.StandardMaterial(**{name: value})
        with pytest.raises(ValueError, match=f"{name}.*"):
            setattr(material, name, value)
    assert repr(material) == before


def test_maps_of_other_types_are_refused():
    for value in ("wood.png", cc.Scene()):
        with pytest.raises(TypeError, match=r"normal_map: expected"):
            cc.StandardMaterial(normal_map=value)


def test_every_number_of_its_range_is_accepted():
    material = cc.StandardMaterial(ior=0, attenuation_distance=float("inf"), specular_samples=1024)
    assert material.ior == 0
    assert material.attenuation_distance == float("inf")
    material.attenuation_distance = 0.5
    assert material.attenuation_distance == 0.5
    material.emissive = "white"
    assert material.emissive.tolist() == [1, 1, 1]


def test_repr_and_pickling():
    assert repr(cc.StandardMaterial()) == "StandardMaterial()"
    made = cc.StandardMaterial(
        color=(1, 0.5, 0),
        sheen_color=(0.5, 0, 0),
        alpha_mode="mask",
        specular="sampled",
        specular_samples=4,
        attenuation_distance=2,
    )
    text = (
        "StandardMaterial(color=(1, 0.5, 0, 1), alpha_mode='mask', sheen_color=(0.5, 0, 0), "
        "attenuation_distance=2.0, specular='sampled', specular_samples=4)"
    )
    assert repr(made) == text
    again = pickle.loads(pickle.dumps(made))
    assert repr(again) == text
    placed = cc.StandardMaterial(map=cc.Texture(PICTURE, uv_set=1, scale=(2, 2)))
    again = pickle.loads(pickle.dumps(placed))
    assert repr(again.map) == repr(placed.map)
    assert_identical(again.map.source.pixels, PICTURE)


@pytest.mark.parametrize(
    "options",
    [
        {"attenuation_distance": 1e-45, "attenuation_color": (1e-3, 1, 0.5), "hidden": 0},
        {"attenuation_distance": 1e-45, "attenuation_color": (0, 1, 0.5), "hidden": 0},
        {"thickness": 1e38},
    ],
    ids=["strong attenuation, no way", "black, no way", "a way without end"],
)
def test_volumes_without_measure_give_finite_pictures(renderer, options):
    """The extinction, a logarithm over the distance, or the length of the way exceeds float32."""
    options = dict(options)
    hidden = options.pop("hidden", None)
    if hidden is not None:
        options["thickness_map"] = np.full((1, 1, 3), hidden, np.uint8)
    material = cc.StandardMaterial(
        **{"metallic": 0, "transmission": 1, "thickness": 1, "roughness": 0.2, **options}
    )
    scene = cc.Scene(environment=cc.CubeMap(np.full((6, 2, 2, 3), 0.5, np.float32)))
    scene.add(cc.Mesh.icosphere(1, subdivisions=2), material)
    camera = cc.PerspectiveCamera(fov=40, position=(0, 0, 3), target=(0, 0, 0))
    assert np.isfinite(renderer.render(scene, camera, (16, 16), format="rgba32f").color).all()


def test_a_change_redraws_and_an_equal_value_does_not(fresh_renderer):
    material = cc.StandardMaterial(roughness=0.5)
    world, view = ball(material, constant_cube((0.5, 0.4, 0.3)))
    for roughness, drawn in ((0.5, 1), (0.75, 1), (0.75, 0)):
        material.roughness = roughness
        draw(fresh_renderer, world, view)
        assert fresh_renderer.stats.views_drawn == drawn


def test_the_six_faces_of_a_capture(shared_renderers):
    """Layered drawing, drawing face by face and a frame of the same view agree."""
    world = World()
    for place, options in zip(
        ((1.5, 0, 0), (-1.5, 0.3, 0), (0, 1.5, 0.2), (0, -1.5, 0), (0.3, 0, 1.5), (0, 0, -1.5)),
        ({}, {"clearcoat": 1}, {"sheen_color": "white"}, {"iridescence": 1}, {"metallic": 0}, {"anisotropy": 0.7}),
        strict=True,
    ):  # fmt: skip
        world.sphere(0.7, material=cc.StandardMaterial(roughness=0.4, **options), position=place)
    world.scene.environment = cc.CubeMap(smooth_environment(16))
    for light in LIGHTS[0]:
        world.scene.add(light)
    cubes = [shared_renderers(path).capture(world.scene, size=16) for path in (None, False)]
    assert_identical(cubes[0].faces, cubes[1].faces)
