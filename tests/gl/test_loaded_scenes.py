"""Pictures of scenes that load_scene read: places of textures, cameras, lights, variants, motion, skins."""

import math
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.gl.flat import flat_camera
from tests.scene_files import SceneFile, f32, noise, u8

NEAREST = {"minFilter": 9728, "magFilter": 9728}
UNLIT: dict[str, Any] = {"extensions": {"KHR_materials_unlit": {}}}


@pytest.fixture
def load(tmp_path):
    def load(file):
        (tmp_path / "a.glb").write_bytes(file.glb())
        return cc.load_scene(tmp_path / "a.glb")

    return load


def look(renderer, scene, camera=None, size=(24, 24)):
    camera = camera or flat_camera(1, 1)
    return renderer.render(scene, camera, size, format="rgba32f").color


def colored(color):
    return UNLIT | {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1]}}


def decoded(pixels):
    values = pixels / 255
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def matrix_of(transform):
    """T R S of KHR_texture_transform; the rotation is that of its example, u towards -v."""
    sx, sy = transform.get("scale", (1, 1))
    x, y = transform.get("offset", (0, 0))
    c, s = math.cos(transform.get("rotation", 0)), math.sin(transform.get("rotation", 0))
    move = np.array([[1, 0, x], [0, 1, y], [0, 0, 1]])
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return move @ turn @ np.diag([sx, sy, 1])


@pytest.mark.parametrize(
    "transform",
    [
        {},
        {"offset": [0, 1], "rotation": math.pi / 2, "scale": [0.5, 0.5]},
        {"offset": [0.3, 0.1], "rotation": 0.4, "scale": [1.5, 0.7]},
        {"offset": [0, 1], "scale": [1, -1]},
        {"scale": [3, 2]},
    ],
)
def test_a_texture_lies_where_the_specification_says(renderer, load, transform):
    pixels = noise(4, 4)
    file = SceneFile()
    info = {"index": file.texture(pixels, NEAREST)}
    info["extensions"] = {"KHR_texture_transform": transform}
    entry = UNLIT | {"pbrMetallicRoughness": {"baseColorTexture": info}}
    file.node(mesh=file.mesh(file.square(entry)))
    got = look(renderer, load(file))[..., :3]
    # The file's texture coordinates are (0, 0) at the lower left corner of the square, and of row 0 in a picture.
    side = (np.arange(24) + 0.5) / 24
    x, y = np.meshgrid(side, side[::-1])
    u, v, _ = np.einsum("ij,jhw->ihw", matrix_of(transform), [x, y, np.ones_like(x)])
    column, row = np.floor(u * 4).astype(int) % 4, np.floor(v * 4).astype(int) % 4
    want = decoded(pixels)[row, column]
    # Rounding decides where a pixel's centre lies on the border of two texels.
    near = np.minimum(np.abs(u * 4 - np.rint(u * 4)), np.abs(v * 4 - np.rint(v * 4))) < 1e-3
    assert near.mean() < 0.5
    assert_close(got[~near], want[~near], "srgb_filter")


def test_a_camera_of_a_file(renderer, load):
    file = SceneFile()
    lens = {"yfov": math.pi / 2, "znear": 0.1}
    file.add("cameras", {"type": "perspective", "perspective": lens})
    # The camera stands at x = 5 and looks along -x, at a square of edge 1 before it and right of its axis.
    turned = [0, math.sin(math.pi / 4), 0, math.cos(math.pi / 4)]
    file.node(camera=0, translation=[5, 0, 0], rotation=turned)
    square = file.square(colored((1, 0, 0)) | {"doubleSided": True})
    file.node(mesh=file.mesh(square), translation=[3, 0, 0], rotation=turned)
    scene = load(file)
    got = look(renderer, scene, scene.cameras[0], (40, 40))[..., 0]
    # At a distance of 2 the picture is 4 wide, 10 pixels for 1: right of the middle and above it.
    want = np.zeros((40, 40))
    want[10:20, 20:30] = 1
    np.testing.assert_array_equal(got, want)
    scene.nodes[0].position = (5, 1, 0)
    moved = look(renderer, scene, scene.cameras[0], (40, 40))[..., 0]
    np.testing.assert_array_equal(moved, np.roll(want, 10, axis=0))


@pytest.mark.parametrize(
    ("light", "radiance"),
    [
        ({"type": "directional", "intensity": 2}, 2),
        ({"type": "point", "intensity": 8}, 8 / 4),
        ({"type": "point", "intensity": 8, "range": 4}, 8 / 4 * (1 - (2 / 4) ** 4)),
        ({"type": "spot", "intensity": 8, "spot": {"outerConeAngle": 1}}, 8 / 4),
    ],
)
def test_lights_have_the_units_of_the_extension(renderer, load, light, radiance):
    file = SceneFile()
    matt = {
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
    }
    file.node(mesh=file.mesh(file.square(matt)), translation=[-0.5, -0.5, 0])
    file.use("KHR_lights_punctual", {"lights": [light]})
    lamp = file.node(
        root=False, translation=[0, 0, 1], extensions={"KHR_lights_punctual": {"light": 0}}
    )
    file.node(translation=[0, 0, 1], children=[lamp])
    camera = cc.OrthographicCamera(height=0.01, position=(0, 0, 5))
    got = look(renderer, load(file), camera, (2, 2))[0, 0, 0]
    # The middle of a white matt square, head-on at a distance of 2: irradiance / pi.
    assert got == pytest.approx(radiance / math.pi, rel=1e-3)


def test_a_spot_fades_as_the_extension_recommends(renderer, load):
    inner, outer, distance = 0.2, 0.6, 1.0
    file = SceneFile()
    matt = {
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
    }
    file.node(mesh=file.mesh(file.square(matt)), translation=[-0.5, -0.5, 0])
    cone = {"innerConeAngle": inner, "outerConeAngle": outer}
    file.use("KHR_lights_punctual", {"lights": [{"type": "spot", "spot": cone}]})
    file.node(translation=[0, 0, 1], extensions={"KHR_lights_punctual": {"light": 0}})
    camera = cc.OrthographicCamera(height=1 / 50, position=(0, 0, 5))
    got = look(renderer, load(file), camera, (50, 1))[0, :, 0]
    x = (np.arange(50) + 0.5) / 50 - 0.5
    cosine = distance / np.hypot(x, distance)
    scale = 1 / (math.cos(inner) - math.cos(outer))
    fade = np.clip(scale * cosine - scale * math.cos(outer), 0, 1) ** 2
    want = fade * cosine / (np.hypot(x, distance) ** 2) / math.pi
    np.testing.assert_allclose(got, want, atol=2e-4)


def test_variants_show(renderer, load):
    file = SceneFile()
    numbers = [file.add("materials", colored(c)) for c in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    file.use("KHR_materials_variants", {"variants": [{"name": "green"}, {"name": "blue"}]})
    square = file.square(numbers[0])
    mappings = [{"material": numbers[n + 1], "variants": [n]} for n in range(2)]
    square["extensions"] = {"KHR_materials_variants": {"mappings": mappings}}
    file.node(mesh=file.mesh(square))
    scene = load(file)
    shown = []
    for name in (None, "green", "blue"):
        scene.variant = name
        shown.append(look(renderer, scene)[12, 12, :3].tolist())
    assert shown == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_an_animation_moves_a_skinned_square(renderer, load):
    file = SceneFile()
    joints, weights = np.zeros((4, 4), np.uint8), f32([[1, 0, 0, 0]] * 4)
    square = file.square(colored((1, 1, 1)), JOINTS_0=joints, WEIGHTS_0=weights)
    file.node(mesh=file.mesh(square), skin=0)
    bone = file.node(scale=[0.5, 0.5, 1])
    file.add("skins", {"joints": [bone]})
    sampler = {
        "input": file.accessor(f32([0, 1])),
        "output": file.accessor(f32([[0, 0, 0], [0.5, 0.5, 0]])),
    }
    channel = {"sampler": 0, "target": {"node": bone, "path": "translation"}}
    file.add("animations", {"channels": [channel], "samplers": [sampler]})
    scene = load(file)
    first = look(renderer, scene.set_time(0))[..., 0]
    second = look(renderer, scene.set_time(1))[..., 0]
    want = np.zeros((24, 24))
    want[12:, :12] = 1  # the lower left quarter
    np.testing.assert_array_equal(first, want)
    np.testing.assert_array_equal(second, want[::-1, ::-1])


def test_a_morph_target_bends_a_square(renderer, load):
    file = SceneFile()
    square = file.square(colored((1, 1, 1)))
    square["targets"] = [{"POSITION": file.accessor(f32([[0.5, 0, 0]] * 4))}]
    file.node(mesh=file.mesh(square, weights=[1]))
    got = look(renderer, load(file))[..., 0]
    np.testing.assert_array_equal(got, np.tile(np.arange(24) >= 12, (24, 1)))


def test_a_surface_without_normals_is_flat(renderer, load):
    # A roof: without normals each side has its own, with shared vertices or not.
    roof = f32([[-1, -1, 0], [0, -1, 1], [1, -1, 0], [-1, 1, 0], [0, 1, 1], [1, 1, 0]])
    indices = u8([0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4])
    file = SceneFile()
    file.node(mesh=file.mesh(file.primitive(roof, indices)))
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 5))
    frame = renderer.render(load(file), camera, (8, 8), outputs=("normal",))
    side = math.sqrt(0.5)
    np.testing.assert_allclose(frame.normal[:, :4], [[[-side, 0, side]] * 4] * 8, atol=1e-6)
    np.testing.assert_allclose(frame.normal[:, 4:], [[[side, 0, side]] * 4] * 8, atol=1e-6)
