"""The GLB of 16 materials that benchmarks/scenes draws: what is read is what its JSON says, by numpy alone."""

import json
import struct
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from benchmarks.scenes.compare import WITHIN, difference, screen, share
from benchmarks.scenes.filament import put_together
from benchmarks.scenes.file import NAMES, RANGE, SPOT, make_glb


@pytest.fixture(scope="module")
def tiles(tmp_path_factory):
    path = tmp_path_factory.mktemp("tiles") / "tiles.glb"
    path.write_bytes(make_glb())
    return path


@pytest.fixture(scope="module")
def tree(tiles):
    data = tiles.read_bytes()
    return json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])


def local(entry):
    """The matrix of a node (section 3.5.3 of glTF 2.0)."""
    if "matrix" in entry:
        return np.reshape(entry["matrix"], (4, 4)).T
    x, y, z, w = entry.get("rotation", (0, 0, 0, 1))
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, :3] *= entry.get("scale", (1, 1, 1))
    made[:3, 3] = entry.get("translation", (0, 0, 0))
    return made


def world_matrices(tree):
    """Of all nodes, by name."""
    found = {}

    def walk(number, above):
        entry = tree["nodes"][number]
        found[entry["name"]] = above @ local(entry)
        for child in entry.get("children", ()):
            walk(child, found[entry["name"]])

    for root in tree["scenes"][0]["nodes"]:
        walk(root, np.eye(4))
    return found


def test_nodes_stand_where_the_file_says(tiles, tree):
    scene = cc.load_scene(tiles)
    wanted = world_matrices(tree)
    assert {node.name for node in scene.nodes} == set(wanted)
    for node in scene.nodes:
        np.testing.assert_allclose(node.world_matrix, wanted[node.name], atol=2e-6)
    assert np.linalg.det(wanted["sheen"][:3, :3]) < 0


def test_16_materials_each_on_its_tile(tiles):
    scene = cc.load_scene(tiles)
    materials: dict[str, Any] = {
        node.name: node.material for node in scene.nodes if node.mesh is not None
    }
    assert [materials[name].name for name in NAMES] == list(NAMES)
    assert materials["behind glass"] is materials["base map"]
    assert materials["glass"].transmission == 1
    assert materials["glass"].ior == pytest.approx(1.45)
    assert materials["anisotropy"].anisotropy == pytest.approx(0.3)
    assert materials["unlit"].unlit
    assert materials["mask"].double_sided


def test_a_camera_and_three_lights(tiles, tree):
    scene = cc.load_scene(tiles)
    wanted = world_matrices(tree)
    camera: Any = scene.cameras[0]
    np.testing.assert_allclose(camera.world_position, wanted["camera"][:3, 3], atol=2e-6)
    lights: Any = scene.lights
    sun, lamp, spot = lights
    forwards = {name: -wanted[name][:3, 2] for name in ("sun", "spot")}
    np.testing.assert_allclose(sun.world_direction, forwards["sun"], atol=2e-6)
    np.testing.assert_allclose(spot.world_direction, forwards["spot"], atol=2e-6)
    np.testing.assert_allclose(lamp.world_position, wanted["lamp"][:3, 3], atol=2e-6)
    assert lamp.range == RANGE
    assert spot.angle == pytest.approx(np.degrees(SPOT[1]))


def test_pictures_of_several_exposures_are_one():
    light = np.geomspace(0.02, 30, 100).reshape(10, 10, 1) * np.ones(3)
    emitted = np.zeros((10, 10, 3))
    emitted[:5] = 0.25

    def bytes_of(share):
        share = np.clip(share, 0, 1)
        low = share * 12.92
        return np.round(
            255 * np.where(share <= 0.0031308, low, 1.055 * share ** (1 / 2.4) - 0.055)
        ).astype(np.uint8)

    stops = (-2.0, 0.0, 3.0, 6.0)
    shots = [(s, bytes_of(light / (1.2 * 2**s) + emitted)) for s in stops]
    made = put_together(shots, bytes_of(emitted))
    np.testing.assert_allclose(screen(made), screen(light + emitted), atol=0.004)


def test_shares_count_the_greatest_channel():
    black = np.zeros((1, 4, 3))
    other = black.copy()
    other[0, :3, 1] = 0.01, 0.04, 0.05
    inside = screen(other)[0, :, 1] <= WITHIN
    assert inside.tolist() == [True, True, False, True]
    assert share(difference(black, other), np.ones((1, 4), bool)) == 0.75
