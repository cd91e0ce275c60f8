"""StandardMaterial against the reference that is written from the texts of glTF 2.0: all parameters, within 2/255.

|got - expected| <= 2/255 max(1, expected): numbers on a screen, and brighter ones in proportion.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from cubecam.truth.shading.images import sample_image
from cubecam.truth.shading.standard.material import (
    Parameters,
    Surface,
    anisotropy_direction,
    mapped_normal,
    occluded,
)
from cubecam.truth.shading.standard.shade import shade
from tests.compare import assert_close
from tests.gl.world import World, inner_smooth, orthographic, perspective, smooth_environment
from tests.reference.lookups import environment_of

VIEWS = {
    "near": perspective((0.6, 0.8, 2.4), (0, 0, 0), fov=50),
    "above": orthographic((-1, 3, 0.5), (0, 0, 0), height=2.6),
    "low": perspective((-2.5, 0.7, -1), (0, 0, 0), fov=45),
}


BEHIND = (0.2, 0.5, 0.9)  # the colour of the background, which is all that is seen through glass


@lru_cache(maxsize=1)
def environment():
    """(the filtered cubemap, the reference's lookups of the same levels); some lamps stand in soft waves."""
    faces = smooth_environment(64)
    faces[0, 20:28, 30:38] += (6, 5, 4)
    faces[2, 40:50, 10:20] += (2, 3, 4)
    cube = cc.CubeMap(faces).prefilter(levels=6)
    around = environment_of(
        faces, [np.asarray(level) for level in cube.levels[1:]], np.asarray(cube.irradiance().faces)
    )
    return cube, around


def surroundings(view):
    """The reference's lookups, with what is behind: the background where the exit is in the picture, else lookups."""
    around = environment()[1]

    def behind(exit_point, direction, roughness):
        clip = exit_point @ (view.projection @ view.view)[:, :3].T
        clip = clip + (view.projection @ view.view)[:, 3]
        inside = (np.abs(clip[..., :2]) <= clip[..., 3:]).all(-1, keepdims=True)
        return np.where(inside, BEHIND, around.radiance(direction, roughness))

    return replace(around, behind=behind)


def lights():
    """For the product in lux and candela, and for the oracle."""
    ours = [
        cc.DirectionalLight(direction=(-1, -2, -0.5), color=(1, 0.9, 0.7), intensity=1.5),
        cc.PointLight(position=(1.5, 1.2, 2), color=(0.5, 0.7, 1), intensity=4, decay=2),
        cc.SpotLight(
            position=(-2, 2, 1), direction=(2, -2, -1), angle=35, penumbra=0.5, intensity=6, decay=2
        ),
        cc.AmbientLight(color=(0.1, 0.05, 0.15)),
    ]
    theirs = [
        shading.Directional((-1, -2, -0.5), (1, 0.9, 0.7), 1.5),
        shading.Point((1.5, 1.2, 2), (0.5, 0.7, 1), 4, 2),
        shading.Spot((-2, 2, 1), (2, -2, -1), 35, 0.5, (1, 1, 1), 6, 2),
        shading.Ambient((0.1, 0.05, 0.15)),
    ]
    return ours, theirs


def world_of(shape, material, lamps=True, scale=1.0):
    """A sphere, or a plane whose tangent is known, in the environment; returns (world, lights of the oracle)."""
    world = World()
    world.scene.environment = environment()[0]
    world.scene.background = BEHIND
    if shape == "sphere":
        world.sphere(1, subdivisions=3, material=material, scale=scale)
    else:
        place = {"axis": (1, 2, 0.5), "degrees": 20}
        world.mesh(cc.Mesh.plane(3, 3), material=material, **place)
    ours, theirs = lights()
    if not lamps:
        return world, []
    for light in ours:
        world.scene.add(light)
    return world, theirs


def surface_of(world, view, hits, good):
    """The oracle's surface at K pixels; the plane's tangent is its x, and +v is its -z: cross(n, t) = -z, so w = 1."""
    position = hits.position[good]
    parallel = isinstance(view.camera, cc.OrthographicCamera)
    v = -view.directions()[good] if parallel else normalised(view.eye - position)
    tangent = np.broadcast_to([*np.asarray(world.shapes[0].matrix)[:3, 0], 1.0], (len(v), 4))
    return Surface(position, v, hits.normal[good], tangent=tangent)


def check(
    renderer, shape, view, given, change=None, lamps=True, mask=None, rule="standard", scale=1.0
):
    """Draw and compare. change(parameters, surface, uv): returns both with the texels of maps in them."""
    view = VIEWS[view]
    world, theirs = world_of(shape, cc.StandardMaterial(**given), lamps, scale)
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    good = inner_smooth(hits) & hits.hit
    if mask is not None:
        good &= mask(hits)
    assert good.mean() > 0.2
    surface = surface_of(world, view, hits, good)
    surface.scale = np.broadcast_to(scale, 3)
    p = parameters_of(given)
    if change is not None:
        p, surface = change(p, surface, hits.uv[good])
    expected = shade(p, surface, theirs, surroundings(view))
    unit = np.maximum(1, expected)
    assert_close(frame.color[good][:, :3] / unit, expected / unit, rule)
    return frame.color[..., :3], good


def parameters_of(given):
    """The reference's parameters of the product's, without maps."""
    own = {key: value for key, value in given.items() if key in Parameters.__dataclass_fields__}
    p = Parameters(**own)
    p.iridescence_thickness = given.get("iridescence_thickness_max", 400.0)
    p.anisotropy_direction = anisotropy_direction(given.get("anisotropy_rotation", 0.0))
    return p


def random_parameters(seed, everything=False):
    """Numbers for all parameters; each extension is present in about half of the sets."""
    rng = np.random.default_rng(seed)

    def color(low=0.0, high=1.0):
        return tuple(rng.uniform(low, high, 3).tolist())

    def number(low, high):
        return float(rng.uniform(low, high))

    given = {
        "color": color(0.05),
        "metallic": float(rng.choice([0, number(0, 1), 1])),
        "roughness": number(0.2, 1),
        "emissive": color(0, 0.3),
        "emissive_strength": number(0, 2),
        "ior": number(1, 2.4),
        "specular_weight": number(0, 1),
        "specular_color": color(0, 1.5),
        "multiple_scattering": bool(rng.random() < 0.7),
    }
    extensions = [
        {"clearcoat": number(0.3, 1), "clearcoat_roughness": number(0.15, 0.8)},
        {"sheen_color": color(), "sheen_roughness": number(0.2, 1)},
        {
            "iridescence": number(0.3, 1),
            "iridescence_ior": number(1.1, 2),
            "iridescence_thickness_max": number(150, 700),
        },
        {"anisotropy": number(0.2, 0.9), "anisotropy_rotation": number(-180, 180)},
        {
            "transmission": number(0.3, 1),
            "thickness": number(0, 1),
            "attenuation_distance": number(0.3, 2),
            "attenuation_color": color(0.2),
            "dispersion": number(0, 2),
        },
    ]
    for extension in extensions:
        if everything or rng.random() < 0.5:
            given.update(extension)
    return given


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("seed", range(8))
def test_random_materials_on_a_sphere(renderer, seed, view):
    given = random_parameters(seed)
    for key in ("anisotropy", "anisotropy_rotation"):  # the sphere's tangents are tried elsewhere
        given.pop(key, None)
    check(renderer, "sphere", view, given)


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("seed", range(100, 108))
def test_random_materials_on_a_plane(renderer, seed, view):
    check(renderer, "plane", view, random_parameters(seed, everything=seed % 2 == 0))


# A set that shows each extension alone, so that a failure names it.
ALONE = {
    "metal": {"color": (0.9, 0.6, 0.3), "roughness": 0.3},
    "dielectric": {"color": (0.2, 0.5, 0.8), "metallic": 0.0, "roughness": 0.4},
    "single": {"color": (0.9, 0.6, 0.3), "roughness": 0.8, "multiple_scattering": False},
    "ior": {"color": (0.2, 0.5, 0.8), "metallic": 0.0, "roughness": 0.5, "ior": 2.2},
    "specular": {
        "color": (0.2, 0.5, 0.8),
        "metallic": 0.2,
        "roughness": 0.5,
        "specular_weight": 0.6,
        "specular_color": (2, 0.5, 0.1),
    },
    "clearcoat": {"color": (0.5, 0.1, 0.1), "clearcoat": 0.8, "clearcoat_roughness": 0.2},
    "clearcoat-single": {
        "color": (0.5, 0.1, 0.1),
        "clearcoat": 0.8,
        "clearcoat_roughness": 0.7,
        "multiple_scattering": False,
    },
    "sheen": {
        "color": (0.3, 0.3, 0.1),
        "metallic": 0.0,
        "sheen_color": (0.8, 0.3, 0.9),
        "sheen_roughness": 0.4,
    },
    "film-on-metal": {
        "color": (0.7, 0.7, 0.6),
        "roughness": 0.3,
        "iridescence": 1.0,
        "iridescence_thickness_max": 420.0,
    },
    "film-on-dielectric": {
        "color": (0.1, 0.1, 0.1),
        "metallic": 0.0,
        "roughness": 0.3,
        "iridescence": 0.8,
        "iridescence_ior": 1.8,
    },
    "emission": {"color": (0.1, 0.1, 0.1), "emissive": (0.5, 1, 0.2), "emissive_strength": 3.0},
    "sheet": {"color": (0.9, 0.7, 0.9), "metallic": 0.0, "roughness": 0.3, "transmission": 0.9},
    "volume": {
        "color": (0.9, 0.7, 0.9),
        "metallic": 0.0,
        "roughness": 0.3,
        "transmission": 0.9,
        "thickness": 0.5,
        "attenuation_distance": 0.4,
        "attenuation_color": (0.9, 0.5, 0.2),
        "dispersion": 1.0,
    },
}


@pytest.mark.parametrize("name", ALONE)
def test_each_extension_alone(renderer, name):
    check(renderer, "sphere", "near", ALONE[name])


@pytest.mark.parametrize("name", ALONE)
def test_each_extension_alone_in_the_environment(renderer, name):
    check(renderer, "sphere", "low", ALONE[name], lamps=False)


def test_the_way_through_a_volume_grows_with_the_node(renderer):
    """KHR_materials_volume: thickness is in units of the mesh, and transformations of the node apply to it."""
    given = {**ALONE["volume"], "attenuation_distance": 0.8}
    check(renderer, "sphere", "near", given, scale=(0.9, 1.1, 0.7))


@pytest.mark.parametrize("rotation", [0, 70])
def test_brushed_metal(renderer, rotation):
    given = {"color": (0.9, 0.8, 0.6), "roughness": 0.3, "anisotropy": 0.8}
    check(renderer, "plane", "near", {**given, "anisotropy_rotation": rotation})


@pytest.mark.parametrize("count", [16, 64])
@pytest.mark.parametrize("brushed", [False, True], ids=["round", "brushed"])
def test_samples(renderer, count, brushed):
    """Every pixel takes the same points, so that even the noise is the reference's."""
    given = {
        "color": (0.9, 0.7, 0.4),
        "metallic": 0.7,
        "roughness": 0.5,
        "specular": "sampled",
        "specular_samples": count,
        "iridescence": 0.5,
    }
    if brushed:
        check(renderer, "plane", "near", {**given, "anisotropy": 0.7, "anisotropy_rotation": 30})
    else:
        # Where n.z changes its sign, so does the frame round n.
        off = lambda hits: np.abs(hits.normal[..., 2]) > 0.02  # noqa: E731
        check(renderer, "sphere", "near", given, mask=off)


# --- maps -------------------------------------------------------------------------------------------------------------


def picture(rng, channels=4, low=0.2, high=1.0, size=4):
    return rng.uniform(low, high, (size, size, channels)).astype(np.float32)


def test_all_maps(renderer, rng):
    """Float pictures on the plane, looked up bilinearly, each in the channels that the texts name."""
    maps = {
        name: picture(rng)
        for name in (
            "map",
            "metallic_roughness_map",
            "occlusion_map",
            "emissive_map",
            "specular_map",
            "specular_color_map",
            "clearcoat_map",
            "clearcoat_roughness_map",
            "sheen_color_map",
            "sheen_roughness_map",
            "iridescence_map",
            "iridescence_thickness_map",
            "anisotropy_map",
            "transmission_map",
            "thickness_map",
        )
    }
    maps["map"][..., 3] = 1
    maps["anisotropy_map"][..., 0] = maps["anisotropy_map"][..., 0] * 0.3 + 0.7
    for name in ("normal_map", "clearcoat_normal_map"):
        maps[name] = picture(rng, low=0.35, high=0.65)
        maps[name][..., 2] = 1
    given = {
        **random_parameters(4, everything=True),
        "metallic": 0.6,
        "iridescence_thickness_min": 200.0,
        "occlusion_strength": 0.7,
        "normal_scale": 0.6,
        "clearcoat_normal_scale": 0.5,
    }

    def change(p, surface, uv):
        at = {name: sample_image(image, uv) for name, image in maps.items()}
        texel = lambda name, channel: at[name][..., channel : channel + 1]  # noqa: E731
        p.color = np.array(p.color) * at["map"][..., :3]
        p.roughness = p.roughness * texel("metallic_roughness_map", 1)
        p.metallic = p.metallic * texel("metallic_roughness_map", 2)
        p.occlusion = occluded(texel("occlusion_map", 0), 0.7)
        p.emissive = np.array(p.emissive) * at["emissive_map"][..., :3]
        p.specular_weight = p.specular_weight * texel("specular_map", 3)
        p.specular_color = np.array(p.specular_color) * at["specular_color_map"][..., :3]
        p.clearcoat = p.clearcoat * texel("clearcoat_map", 0)
        p.clearcoat_roughness = p.clearcoat_roughness * texel("clearcoat_roughness_map", 1)
        p.sheen_color = np.array(p.sheen_color) * at["sheen_color_map"][..., :3]
        p.sheen_roughness = p.sheen_roughness * texel("sheen_roughness_map", 3)
        p.iridescence = p.iridescence * texel("iridescence_map", 0)
        thickest = given["iridescence_thickness_max"]
        p.iridescence_thickness = 200 + (thickest - 200) * texel("iridescence_thickness_map", 1)
        p.anisotropy = p.anisotropy * texel("anisotropy_map", 2)
        p.anisotropy_direction = anisotropy_direction(
            given["anisotropy_rotation"], at["anisotropy_map"]
        )
        p.transmission = p.transmission * texel("transmission_map", 0)
        p.thickness = p.thickness * texel("thickness_map", 1)
        n = surface.geometric_n
        surface.n = mapped_normal(n, surface.tangent, at["normal_map"], 0.6)
        surface.clearcoat_n = mapped_normal(n, surface.tangent, at["clearcoat_normal_map"], 0.5)
        return p, surface

    check(renderer, "plane", "above", {**given, **maps}, change)


def test_bytes_of_colours_are_srgb_and_all_others_are_not(renderer, rng):
    """IEC 61966-2-1, decoded before the lookup interpolates."""
    colors = rng.integers(100, 220, (4, 4, 3), dtype=np.uint8)
    numbers = rng.integers(150, 256, (4, 4, 3), dtype=np.uint8)

    def change(p, surface, uv):
        value = colors / 255
        linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
        color, number = sample_image(linear, uv), sample_image(numbers / 255, uv)
        p.color, p.emissive = np.array(p.color) * color, np.array(p.emissive) * color
        p.roughness = p.roughness * number[..., 1:2]
        p.metallic = p.metallic * number[..., 2:3]
        p.occlusion = occluded(number[..., :1], 1.0)
        return p, surface

    given = {"color": (1, 0.8, 0.9), "emissive": (0.3, 0.3, 0.1), "roughness": 0.9}
    maps = {
        "map": colors,
        "emissive_map": colors,
        "metallic_roughness_map": numbers,
        "occlusion_map": numbers,
    }
    # Bytes are filtered in 8 bits by llvmpipe; floats are not, see above.
    check(renderer, "plane", "above", {**given, **maps}, change, rule="unorm8_filter")


def test_roughness_0_equals_a_mirror(renderer):
    """MirrorMaterial's f0 by Schlick, tinted with the colour of a metal without roughness."""
    color, good = check(
        renderer, "sphere", "near", {"color": (1, 1, 1), "roughness": 0.0}, lamps=False
    )
    world, _ = world_of("sphere", cc.MirrorMaterial(), lamps=False)
    view = VIEWS["near"]
    mirror = renderer.render(world.scene, view.camera, view.size, format="rgba32f").color[..., :3]
    assert_close(color[good], mirror[good], "unorm8")
