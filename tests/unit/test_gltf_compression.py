"""Compressed glTF: Draco and meshopt by value, what takes their place, missing packages, broken bytes."""

import random
import sys

import DracoPy
import numpy as np
import pytest

import cubecam as cc
from cubecam.io.gltf.compression import draco_counts
from tests.gltf_files import CORNERS, SQUARE, GltfFile

try:
    import meshopt
except (
    ImportError
):  # there is none for Python 3.10, where the tests of it check that the error names it
    meshopt = None

DRACO = "KHR_draco_mesh_compression"
NAMES = ["EXT_meshopt_compression", "KHR_meshopt_compression"]
HALVES = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)

with_meshopt = pytest.mark.parametrize(
    "name", NAMES if meshopt else [], ids=NAMES if meshopt else []
)


@pytest.fixture
def load(tmp_path):
    def load(file):
        (tmp_path / "a.glb").write_bytes(file.glb())
        return cc.load_mesh(tmp_path / "a.glb")

    return load


def refused(load, file, text):
    with pytest.raises(cc.MeshError, match=text):
        load(file)


# Draco


def draco_file(data, forms, indices=6, mode=None, required=True):
    """A file of one primitive. `forms` are component type, type and id in the Draco data of each attribute."""
    file = GltfFile(extensionsUsed=[DRACO])
    if required:
        file.tree["extensionsRequired"] = [DRACO]
    attributes, ids = {}, {}
    for key, (component, kind, number, *normalized) in forms.items():
        entry = {"componentType": component, "type": kind, "count": 4}
        if normalized:
            entry["normalized"] = True
        attributes[key] = file.add("accessors", entry)
        ids[key] = number
    entry = {
        "attributes": attributes,
        "indices": file.add(
            "accessors", {"componentType": 5125, "type": "SCALAR", "count": indices}
        ),
        "extensions": {DRACO: {"bufferView": file.view(data), "attributes": ids}},
    }
    if mode is not None:
        entry["mode"] = mode
    file.node(mesh=file.mesh(entry), scale=[1, 1, -1])
    return file


def encoded(positions=SQUARE, **more):
    return DracoPy.encode(positions, HALVES, preserve_order=True, **more)


PLAIN = {"POSITION": (5126, "VEC3", 0)}


@pytest.mark.parametrize("mode", [None, 4, 5])
def test_draco_triangles(load, mode):
    mesh = load(draco_file(encoded(), PLAIN, mode=mode))
    np.testing.assert_allclose(mesh.positions, SQUARE, atol=1e-3)
    np.testing.assert_array_equal(mesh.indices, HALVES[:, ::-1])  # the node mirrors


@pytest.mark.parametrize("level", [0, 5, 10])
def test_draco_meshes_in_another_order(load, level):
    ball = cc.Mesh.icosphere(1, subdivisions=2)
    data = DracoPy.encode(ball.positions, ball.indices, compression_level=level)
    mesh = load(draco_file(data, PLAIN))
    assert len(mesh.indices) == len(ball.indices)
    np.testing.assert_allclose(np.linalg.norm(mesh.positions, axis=1), 1, atol=1e-3)
    a, b, c = np.moveaxis(mesh.positions[mesh.indices], 1, 0)
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0).all()


def test_draco_attributes_by_their_ids(load):
    normals = np.array([[0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8], [0, 0, 1]])
    uvs = np.array([[0, 0], [1, 0], [1, 0.25], [0, 0.5]])
    colors = np.array([[255, 0, 51, 255], [0, 102, 0, 0], [1, 2, 3, 4], [9, 8, 7, 6]], np.uint8)
    weights = np.array([[3, 1, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0]], np.float32)
    joints = np.array([[0, 1, 0, 0]] * 4, np.uint16)
    data = encoded(
        normals=normals, tex_coord=uvs, colors=colors, generic_attributes={3: weights, 5: joints}
    )
    ids = {a["attribute_type"]: a["unique_id"] for a in DracoPy.decode(data).attributes}
    forms = {
        "POSITION": (5126, "VEC3", ids[0]),
        "NORMAL": (5126, "VEC3", ids[1]),
        "TEXCOORD_0": (5126, "VEC2", ids[3]),
        "COLOR_0": (5121, "VEC4", ids[2], True),
        "WEIGHTS_0": (5126, "VEC4", 3),
        "JOINTS_0": (5123, "VEC4", 5),
    }
    mesh = load(draco_file(data, forms))
    np.testing.assert_allclose(mesh.normals, normals * [1, 1, -1], atol=1e-6)
    np.testing.assert_allclose(mesh.uvs, uvs * [1, -1] + [0, 1], atol=1e-6)
    np.testing.assert_allclose(mesh.colors, colors / 255, atol=1e-7)
    file = draco_file(data, forms)
    file.tree["nodes"][0]["skin"] = 0
    file.tree["skins"] = [
        {"joints": [file.node(translation=[0, 0, 4]), file.node(translation=[0, 8, 0])]}
    ]
    moves = np.array([[0, 2, 3], [0, 0, 4], [0, 8, 0], [0, 4, 2]])
    np.testing.assert_allclose(load(file).positions, SQUARE + moves, atol=1e-3)


def test_the_accessor_of_a_draco_attribute_says_whether_it_is_normalized(load):
    whole = np.array([[0, 0, 0], [32767, 0, 0], [32767, 16384, 0], [0, 100, 0]], np.int32)
    normalized = load(draco_file(encoded(whole), {"POSITION": (5122, "VEC3", 0, True)}))
    np.testing.assert_allclose(normalized.positions, whole / 32767, atol=1e-6)
    plain = load(draco_file(encoded(whole), {"POSITION": (5122, "VEC3", 0)}))
    np.testing.assert_allclose(plain.positions, whole)


def test_attributes_beside_the_draco_data(load):
    file = draco_file(encoded(), PLAIN)
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 0.5]], np.float32)
    number = file.accessor(uvs)
    file.tree["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = number
    np.testing.assert_array_equal(load(file).uvs, uvs * [1, -1] + [0, 1])
    file.tree["accessors"][number]["count"] = 3
    refused(load, file, "TEXCOORD_0: expected 4 elements, as other attributes have, got 3")


def test_positions_beside_the_draco_data_have_as_many_elements(load):
    file = draco_file(encoded(), PLAIN)
    primitive = file.tree["meshes"][0]["primitives"][0]
    primitive["extensions"][DRACO]["attributes"] = {}
    number = primitive["attributes"]["POSITION"] = file.accessor(SQUARE * 2)
    np.testing.assert_array_equal(load(file).positions, SQUARE * 2)
    file.tree["accessors"][number]["count"] = 3
    refused(load, file, "attributes.POSITION: expected 4 elements, as other attributes have, got 3")


def test_draco_metadata_are_skipped():
    data = DracoPy.encode(
        SQUARE, HALVES, create_metadata=True, generic_attributes={"mine": SQUARE.copy()}
    )
    assert data[10] & 0x80
    assert draco_counts(data) == (4, 2)


def test_bad_draco_data_are_refused(load):
    place = r"primitives\[0\].extensions.KHR_draco_mesh_compression"
    data = encoded()
    refused(load, draco_file(data[:20], PLAIN), f"{place}: expected bytes of {DRACO}")
    refused(load, draco_file(b"DRACO\2\2" + bytes(40), PLAIN), f"{place}: .*not a mesh")
    refused(load, draco_file(DracoPy.encode(SQUARE), PLAIN), f"{place}: .*not a mesh")
    refused(load, draco_file(bytes(40), PLAIN), f"{place}: .*no Draco header")
    refused(
        load, draco_file(data, {"POSITION": (5126, "VEC3", 7)}), rf"{place}.attributes.POSITION"
    )
    pairs = encoded(generic_attributes={3: np.zeros((4, 2), np.float32)})
    number = next(
        a["unique_id"] for a in DracoPy.decode(pairs).attributes if a["attribute_type"] == 0
    )
    forms = {"POSITION": (5126, "VEC3", number), "NORMAL": (5126, "VEC3", 3)}
    refused(
        load, draco_file(pairs, forms), rf"{place}.attributes.NORMAL: expected an attribute of VEC3"
    )
    refused(load, draco_file(data, {"POSITION": (5126, "VEC2", 0)}), "expected an accessor of VEC3")
    refused(
        load,
        draco_file(data, PLAIN, mode=6),
        rf"primitives\[0\].mode: expected 4 or 5 with {DRACO}",
    )
    file = draco_file(data, PLAIN)
    file.tree["meshes"][0]["primitives"][0]["extensions"][DRACO]["bufferView"] = 4
    refused(load, file, rf"{place}.bufferView: expected an index below 1, got 4")


def varint(value):
    parts = []
    while value > 127:
        parts.append(value % 128 + 128)
        value //= 128
    return bytes([*parts, value])


def test_counts_in_a_draco_header_are_checked_before_anything_is_decoded(load, monkeypatch):
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    data = DracoPy.encode(ball.positions, ball.indices)  # edgebreaker: vertices, faces, ...
    assert data[8] == 1
    assert draco_counts(data) == (42, 80)
    many = varint(50_000_000)
    monkeypatch.setattr(DracoPy, "decode", lambda data: pytest.fail("decoded"))
    for forged in (data[:12] + many + data[13:], data[:13] + many + data[14:]):
        refused(load, draco_file(forged, PLAIN), "expected at most 4\\d+ vertices and triangles")
    flat = encoded()  # sequential: faces, vertices
    assert flat[8] == 0
    assert draco_counts(flat) == (4, 2)
    refused(load, draco_file(flat[:11] + many + flat[12:], PLAIN), "expected at most 4")


# Packages that are missing


@pytest.fixture
def no_packages(monkeypatch):
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    monkeypatch.setitem(sys.modules, "meshopt", None)


def test_without_dracopy_the_error_names_it(load, no_packages):
    text = rf"DracoPy, which reads {DRACO}.*pip install 'cubecam\[gltf\]'"
    refused(load, draco_file(encoded(), PLAIN), text)
    refused(load, draco_file(encoded(), PLAIN, required=False), text)


def test_without_dracopy_plain_data_take_its_place(load, no_packages):
    file = draco_file(encoded(SQUARE * 3), PLAIN, required=False)
    primitive = file.tree["meshes"][0]["primitives"][0]
    primitive["attributes"]["POSITION"] = file.accessor(SQUARE)
    primitive["indices"] = file.accessor(HALVES.ravel())
    np.testing.assert_array_equal(load(file).positions, SQUARE)
    file.tree["extensionsRequired"] = [DRACO]
    refused(load, file, "expected the package DracoPy")


@pytest.mark.parametrize("name", NAMES)
def test_without_meshopt_the_error_names_it(load, no_packages, name):
    text = rf"meshopt, which reads {name}.*pip install 'cubecam\[gltf\]'.*Python 3.11"
    refused(load, compressed(name, b"\xa0" + bytes(40)), text)
    refused(load, compressed(name, b"\xa0" + bytes(40), required=False), text)


@pytest.mark.parametrize("name", NAMES)
def test_without_meshopt_plain_bytes_take_its_place(load, no_packages, name):
    file = compressed(name, b"\xa0" + bytes(40), required=False)
    view = file.tree["bufferViews"][0]
    view.update(buffer=0, byteOffset=len(file.binary))
    file.binary += CORNERS.tobytes()
    file.tree["buffers"][0]["byteLength"] = len(file.binary)
    np.testing.assert_array_equal(load(file).positions, CORNERS)


# meshopt


def compressed(name, data, required=True, **change):
    """A file of a triangle whose positions are in a compressed buffer view; their plain bytes are nowhere."""
    file = GltfFile(extensionsUsed=[name])
    if required:
        file.tree["extensionsRequired"] = [name]
    entry = {"buffer": 0, "byteOffset": 0, "byteLength": len(data), "byteStride": 12, "count": 3}
    file.binary = data
    number = file.add(
        "bufferViews",
        {
            "buffer": 1,
            "byteLength": 36,
            "extensions": {name: {**entry, "mode": "ATTRIBUTES", **change}},
        },
    )
    accessor = {"bufferView": number, "componentType": 5126, "count": 3, "type": "VEC3"}
    file.node(mesh=file.mesh(file.primitive(file.add("accessors", accessor))))
    file.tree["buffers"] = [
        {"byteLength": len(data)},
        {"byteLength": 36, "extensions": {name: {"fallback": True}}},
    ]
    return file


@with_meshopt
@pytest.mark.parametrize("version", [0, 1])
def test_meshopt_attributes(load, name, version):
    data = meshopt.encode_gltf_buffer(CORNERS * 3, "ATTRIBUTES", version)
    np.testing.assert_array_equal(load(compressed(name, data)).positions, CORNERS * 3)


@with_meshopt
@pytest.mark.parametrize("mode", ["TRIANGLES", "INDICES"])
@pytest.mark.parametrize("dtype", [np.uint16, np.uint32])
def test_meshopt_indices(load, name, mode, dtype):
    ball = cc.Mesh.icosphere(1, subdivisions=2)
    indices = np.array(ball.indices, np.uint32).ravel()
    file = GltfFile()
    data = meshopt.encode_gltf_buffer(indices, mode)
    width = np.dtype(dtype).itemsize
    view = file.view(
        data,
        extensions={
            name: {
                "buffer": 0,
                "byteLength": len(data),
                "byteStride": width,
                "count": len(indices),
                "mode": mode,
            }
        },
    )
    file.tree["bufferViews"][view]["byteLength"] = len(indices) * width
    component = {2: 5123, 4: 5125}[width]
    accessor = {"bufferView": view, "componentType": component, "count": len(indices)}
    number = file.add("accessors", {**accessor, "type": "SCALAR"})
    file.node(mesh=file.mesh(file.primitive(np.array(ball.positions), number)))
    got, want = np.asarray(load(file).indices), np.asarray(ball.indices)
    if mode == "TRIANGLES":  # the codec may turn a triangle
        got, want = (np.array([np.roll(t, -t.argmin()) for t in a]) for a in (got, want))
    np.testing.assert_array_equal(got, want)


def filtered(name, rows, stride, filter_name, key, kind, component, normalized):
    """The file of a triangle with one more attribute, whose bytes went through a filter."""
    data = meshopt.encode_gltf_buffer(rows, "ATTRIBUTES")
    file = GltfFile()
    entry = {"buffer": 0, "byteLength": len(data), "byteStride": stride, "count": 3}
    view = file.view(
        data, extensions={name: {**entry, "mode": "ATTRIBUTES", "filter": filter_name}}
    )
    file.tree["bufferViews"][view].update(byteLength=3 * stride, byteStride=stride)
    accessor = {"bufferView": view, "componentType": component, "count": 3, "type": kind}
    number = file.add("accessors", {**accessor, "normalized": normalized})
    file.node(mesh=file.mesh(file.primitive(**{key: number})))
    return file


@with_meshopt
@pytest.mark.parametrize(("stride", "component", "bits"), [(4, 5120, 8), (8, 5122, 16)])
def test_the_octahedral_filter(load, name, stride, component, bits):
    normals = np.array([[0.6, 0, 0.8], [0, -0.6, 0.8], [0.36, 0.48, -0.8]], np.float32)
    rows = meshopt.encode_filter_oct(np.c_[normals, np.zeros(3)], stride, bits)
    file = filtered(name, rows, stride, "OCTAHEDRAL", "NORMAL", "VEC3", component, True)
    np.testing.assert_allclose(load(file).normals, normals, atol=0.02 if stride == 4 else 1e-4)


@with_meshopt
def test_the_exponential_filter(load, name):
    uvs = np.array([[0.5, 300], [1e-3, -7], [0, 1]], np.float32)
    rows = meshopt.encode_filter_exp(uvs, 20, "Separate")
    file = filtered(name, rows, 8, "EXPONENTIAL", "TEXCOORD_0", "VEC2", 5126, False)
    np.testing.assert_allclose(load(file).uvs, uvs * [1, -1] + [0, 1], rtol=1e-5)


@with_meshopt
def test_the_color_filter(load, name):
    colors = np.array([[1, 0, 0, 1], [0, 0.5, 0.25, 0.5], [0.2, 0.4, 0.8, 0]], np.float32)
    rows = meshopt.encode_filter_color(colors, 8, 16)
    file = filtered(name, rows, 8, "COLOR", "COLOR_0", "VEC4", 5123, True)
    np.testing.assert_allclose(load(file).colors, colors, atol=1e-3)


@with_meshopt
def test_the_quaternion_filter(load, name):
    half = np.sqrt(0.5)
    turns = np.array([[0, 0, half, half], [0, 0, 0, 1], [1, 0, 0, 0]], np.float32)
    rows = meshopt.encode_filter_quat(turns, 8, 16)
    file = filtered(name, rows, 8, "QUATERNION", "_TURN", "VEC4", 5122, True)
    attributes = {"ROTATION": file.tree["meshes"][0]["primitives"][0]["attributes"]["_TURN"]}
    file.tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    x, y, z = CORNERS.T
    want = [np.stack([-y, x, z], 1), CORNERS, np.stack([x, -y, -z], 1)]
    np.testing.assert_allclose(load(file).positions, np.concatenate(want), atol=1e-3)


@with_meshopt
@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"mode": "TEXT"}, "mode: expected ATTRIBUTES, TRIANGLES or INDICES, got 'TEXT'"),
        ({"filter": "BLUR"}, "filter: expected NONE, OCTAHEDRAL"),
        ({"filter": "QUATERNION"}, "expected bytes of {name}, got others"),
        ({"byteStride": 6}, "byteStride: expected a multiple of 4, at most 256, got 6"),
        ({"byteStride": 0}, "byteStride: expected an integer from 1, got 0"),
        ({"count": 10**9}, r"count: expected at most \d+ elements of {name}"),
        ({"count": 10**9, "mode": "TRIANGLES", "byteStride": 4}, "count: expected a multiple of 3"),
        ({"count": 999, "mode": "TRIANGLES", "byteStride": 4}, "byteLength: expected at least 334"),
        ({"count": 999, "mode": "INDICES", "byteStride": 4}, "byteLength: expected at least 1000"),
        ({"mode": "INDICES"}, "byteStride: expected 2 or 4, got 12"),
        ({"mode": "INDICES", "byteStride": 4, "filter": "COLOR"}, "filter: expected NONE"),
        ({"count": 2}, r"bufferViews\[0\].byteLength: expected 24, .*got 36"),
        ({"byteLength": 10}, "byteLength: expected at least 25 bytes"),
        ({"byteOffset": 9}, r"expected \d+ bytes in buffers\[0\]"),
        ({"buffer": 1}, r"buffers\[1\].uri: expected a URI"),
    ],
)
def test_bad_meshopt_data_are_refused(load, name, change, text):
    data = meshopt.encode_gltf_buffer(CORNERS, "ATTRIBUTES")
    if change == {
        "count": 4
    }:  # longer than 16 elements would be needed to see it by the bytes alone
        change = {"count": 40}
    refused(load, compressed(name, data, **change), text.replace("{name}", name))


# Broken bytes


def broken(data, seed):
    choose = random.Random(seed)
    data = bytearray(data)
    for _ in range(choose.choice([1, 1, 2, 5])):
        place = choose.randrange(len(data))
        data[place] = choose.choice([0, 1, 127, 128, 255, data[place] ^ 1 << choose.randrange(8)])
    return bytes(data[: choose.choice([len(data)] * 4 + [choose.randrange(1, len(data))])])


def test_broken_draco_data_are_a_mesh_or_a_mesh_error(load):
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    kinds = [
        DracoPy.encode(ball.positions, ball.indices, compression_level=level) for level in (0, 7)
    ]
    refusals = 0
    for seed in range(200):
        try:
            load(draco_file(broken(kinds[seed % 2], seed), PLAIN))
        except cc.MeshError:
            refusals += 1
    assert 50 < refusals < 200


@with_meshopt
def test_broken_meshopt_data_are_a_mesh_or_a_mesh_error(load, name):
    data = meshopt.encode_gltf_buffer(CORNERS, "ATTRIBUTES")
    refusals = 0
    for seed in range(150):
        try:
            load(compressed(name, broken(data, seed)))
        except cc.MeshError:
            refusals += 1
    assert 10 < refusals < 150
