"""Limits of glTF: small files that would become large, and a seeded fuzz of whole files."""

import random
import resource

import numpy as np
import pytest

import cubecam as cc
from tests.gltf_files import CORNERS, SQUARE, GltfFile
from tests.helpers import least_cpu_seconds


@pytest.fixture
def load(tmp_path):
    def load(data, name="a.glb"):
        (tmp_path / name).write_bytes(data)
        return cc.load_mesh(tmp_path / name)

    return load


def is_refused(load, file, text):
    with pytest.raises(cc.MeshError, match=text):
        load(file.glb())


def refused(load, file, text):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    seconds, _ = least_cpu_seconds(lambda: is_refused(load, file, text), 2)
    assert seconds < 2
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000  # kB


def large(vertices):
    """A strip of many vertices in one accessor of zeros with some sparse ones: a few hundred bytes."""
    file = GltfFile()
    number = file.accessor(CORNERS)
    entry = file.tree["accessors"][number]
    del entry["bufferView"]
    entry["count"] = vertices
    entry["sparse"] = {
        "count": 3,
        "indices": {"bufferView": file.view(bytes([0, 1, 2])), "componentType": 5121},
        "values": {"bufferView": 0},
    }
    return file, file.mesh(file.primitive(number, mode=5))


def test_positions_without_bytes(load):
    file, mesh = large(100_000_000)
    file.node(mesh=mesh)
    refused(load, file, r"accessors\[0\].count: expected at most \d+ elements")
    file.tree["accessors"][0]["count"] = 1000
    assert len(load(file.glb()).positions) == 1000


def test_many_nodes_that_show_one_large_mesh(load):
    file, mesh = large(60_000)
    for _ in range(1000):
        file.node(mesh=mesh)
    refused(load, file, "expected at most 4\\d+ vertices and triangles of a file of")


def test_many_meshes_that_share_large_accessors(load):
    file, mesh = large(60_000)
    primitive = file.tree["meshes"][mesh]["primitives"][0]
    file.tree["meshes"][mesh]["primitives"] = [primitive] * 1000
    file.node(mesh=mesh)
    text = r"expected at most 4\d+ vertices and triangles"
    seconds, _ = least_cpu_seconds(lambda: is_refused(load, file, text), 10)
    assert seconds < 10


def test_many_instances(load):
    file = GltfFile()
    count = 65_000
    number = file.add("accessors", {"componentType": 5126, "count": count, "type": "VEC3"})
    instances = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": number}}}
    mesh = file.mesh()
    for _ in range(100):
        file.node(mesh=mesh, extensions=instances)
    refused(load, file, "expected at most 4\\d+ vertices and triangles")


def test_many_targets_of_one_large_accessor(load):
    file, mesh = large(60_000)
    primitive = file.tree["meshes"][mesh]["primitives"][0]
    primitive["targets"] = [primitive["attributes"]] * 3000
    file.tree["meshes"][mesh]["weights"] = [1] * 3000
    file.node(mesh=mesh)
    text = r"expected at most .* numbers of morph targets"
    seconds, _ = least_cpu_seconds(lambda: is_refused(load, file, text), 10)
    assert seconds < 10


def test_thousands_of_instances_are_no_problem(load):
    file = GltfFile()
    mesh = file.mesh(file.primitive(SQUARE, np.array([0, 1, 2, 0, 2, 3], np.uint8)))
    for index in range(5000):
        file.node(mesh=mesh, translation=[index, 0, 0])
    seconds, found = least_cpu_seconds(lambda: load(file.glb()), 2)
    assert len(found.indices) == 10_000
    np.testing.assert_array_equal(found.positions[-4:], SQUARE + np.array([4999, 0, 0]))
    assert seconds < 2


def complete():
    """A file that has everything: the fuzz changes its bytes."""
    file = GltfFile(extensionsUsed=["EXT_mesh_gpu_instancing"])
    colors = file.accessor(np.array([[9, 8, 7, 6]] * 4, np.uint8), normalized=True)
    joints = np.array([[0, 1, 0, 0]] * 4, np.uint8)
    weights = np.array([[0.5, 0.5, 0, 0]] * 4, np.float32)
    first = file.primitive(
        SQUARE,
        np.array([0, 1, 3, 2], np.uint8),
        mode=5,
        NORMAL=np.array([[0, 0, 1]] * 4, np.float32),
        TEXCOORD_0=SQUARE[:, :2],
        COLOR_0=colors,
    )
    second = file.primitive(SQUARE, JOINTS_0=joints, WEIGHTS_0=weights, mode=6)
    second["targets"] = [{"POSITION": file.accessor(SQUARE)}]
    sparse = file.tree["accessors"][second["targets"][0]["POSITION"]]
    sparse["sparse"] = {
        "count": 2,
        "indices": {"bufferView": file.view(bytes([1, 2])), "componentType": 5121},
        "values": {"bufferView": file.view(CORNERS[:2].tobytes())},
    }
    places = file.accessor(CORNERS)
    instances = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}
    child = file.node(mesh=file.mesh(first), root=False, extensions=instances)
    file.node(children=[child], scale=[1, 2, -3], rotation=[0, 0, 0.6, 0.8])
    bones = [file.node(translation=[0, 1, 0]), file.node()]
    matrices = file.accessor(np.tile(np.eye(4).ravel(), (2, 1)))
    file.add("skins", {"joints": bones, "inverseBindMatrices": matrices})
    file.node(mesh=file.mesh(second, weights=[0.5]), skin=0)
    return file


WORDS = [b"-1", b"1e999", b"99999999", b"true", b'"0"', b"[]", b"{}", b"null", b"0.5", b"0", b"7"]


def mutated(data, choose):
    data = bytearray(data)
    for _ in range(choose.choice([1, 1, 1, 2, 4])):
        place = choose.randrange(len(data))
        kind = choose.randrange(5)
        if kind == 0:
            data[place] ^= 1 << choose.randrange(8)
        elif kind == 1:
            data[place] = choose.choice(b'\x00\xff\x7f0179[]{}",:')
        elif kind == 2:
            del data[place : place + choose.choice([1, 4, 100])]
        else:  # one number of the tree becomes something else
            digits = [
                i for i in range(20, len(data)) if 48 <= data[i] < 58 and data[i - 1] in b" ["
            ]
            if digits:
                place = choose.choice(digits)
                end = place
                while end < len(data) and data[end] in b"0123456789.":
                    end += 1
                data[place:end] = choose.choice(WORDS)
    return bytes(data)


@pytest.mark.parametrize("method", ["glb", "gltf"])
def test_any_bytes_are_a_mesh_or_a_mesh_error(load, method):
    data = getattr(complete(), method)()
    assert len(load(data).indices) == 3 * 2 + 2
    outcomes = {"mesh": 0, "error": 0}
    for seed in range(400):
        broken = mutated(data, random.Random(seed))
        if broken[:4] == b"glTF":  # so that the tree is read, not only the length compared
            broken = broken[:8] + len(broken).to_bytes(4, "little") + broken[12:]
        try:
            load(broken)
            outcomes["mesh"] += 1
        except cc.MeshError:
            outcomes["error"] += 1
    assert min(outcomes.values()) > 20, outcomes
