"""glTF files: containers, references, extensions, and accessors by value."""

import json
import os
import struct
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from cubecam.io.gltf import Gltf, read_gltf
from tests.gltf_files import CORNERS, GltfFile, glb_of, shown


@pytest.fixture
def load(tmp_path):
    """Write bytes or a `GltfFile`, and load them."""

    def load(content, name="a.glb", **options):
        if isinstance(content, GltfFile):
            content = content.gltf() if name.endswith(".gltf") else content.glb()
        (tmp_path / name).write_bytes(content)
        return cc.load_mesh(tmp_path / name, **options)

    return load


def refused(load, content, text, name="a.glb"):
    with pytest.raises(cc.MeshError, match=text):
        load(content, name)


def is_the_triangle(mesh):
    np.testing.assert_array_equal(mesh.positions, CORNERS)
    np.testing.assert_array_equal(mesh.indices, [[0, 1, 2]])


# Containers


@pytest.mark.parametrize("name", ["a.glb", "a.gltf", "A.GLB"])
def test_both_containers_hold_the_same(load, name):
    is_the_triangle(load(shown(), name))


@pytest.mark.parametrize(("name", "method"), [("a.gltf", "glb"), ("a.glb", "gltf")])
def test_the_content_says_which_container_it_is(load, name, method):
    is_the_triangle(load(getattr(shown(), method)(), name))


def test_json_with_a_byte_order_mark(load):
    is_the_triangle(load(b"\xef\xbb\xbf" + shown().gltf(), "a.gltf"))


def test_zeros_after_the_json(load):
    text, binary = parts_of(shown())
    is_the_triangle(load(glb_of((b"JSON", text + bytes(4)), (b"BIN\0", binary))))


def test_integers_may_have_a_fraction_of_zero(load):
    text, binary = parts_of(shown())

    def floats(value):
        if isinstance(value, dict):
            return {key: floats(each) for key, each in value.items()}
        if isinstance(value, list):
            return [floats(each) for each in value]
        return float(value) if isinstance(value, int) else value

    text = json.dumps(floats(json.loads(text))).encode()
    is_the_triangle(load(glb_of((b"JSON", text), (b"BIN\0", binary))))


def parts_of(file):
    data = file.glb()
    size = struct.unpack_from("<I", data, 12)[0]
    return data[20 : 20 + size], data[28 + size :]


def test_chunks_of_unknown_types_are_skipped(load):
    text, binary = parts_of(shown())
    is_the_triangle(load(glb_of((b"JSON", text), (b"BIN\0", binary), (b"XYZ!", b"abcd"))))


def test_a_second_binary_chunk_is_skipped(load):
    text, binary = parts_of(shown())
    is_the_triangle(load(glb_of((b"JSON", text), (b"BIN\0", binary), (b"BIN\0", bytes(36)))))


BAD_CONTAINERS = {
    "shorter than a header": (b"glTF\2\0\0\0", "header of 12 bytes, got 8"),
    "version 1": (glb_of((b"JSON", b"{}"), version=1), "expected glTF 2.0, got a GLB .*version 1"),
    "shorter than it says": (shown().glb()[:-4], r"expected the \d+ bytes that the GLB header"),
    "longer than it says": (
        shown().glb() + bytes(4),
        r"expected the \d+ bytes that the GLB header",
    ),
    "no chunk": (glb_of(), "no chunk"),
    "the first chunk is no JSON": (glb_of((b"BIN\0", b"abcd")), "first chunk of JSON"),
    "a chunk beyond the end": (
        b"glTF" + struct.pack("<III4s", 2, 24, 100, b"JSON") + b"{}  ",
        "chunk of 100 bytes at byte 12, got 4",
    ),
    "half a chunk header": (
        b"glTF" + struct.pack("<II", 2, 16) + bytes(4),
        "chunk header of 8 bytes at byte 12",
    ),
    "no JSON": (b"{", "expected JSON"),
    "nothing": (b"", "expected JSON"),
    "a list": (b"[]", "expected an object of JSON"),
    "not UTF-8": (b'{"a": "\xff"}', "UTF-8"),
    "NaN": (b'{"a": NaN}', "the word NaN"),
    "too deep": (b'{"a":' + b"[" * 100_000, "too deep"),
    "no asset": (b"{}", "asset: expected an object, got none"),
    "no version": (b'{"asset": {}}', "asset.version: expected a string"),
    "glTF 1.0": (b'{"asset": {"version": "1.0"}}', "expected glTF 2.0, got asset.version '1.0'"),
    "glTF 3": (b'{"asset": {"version": "3.0"}}', "expected glTF 2.0"),
    "minVersion": (b'{"asset": {"version": "2.1", "minVersion": "2.1"}}', "minVersion '2.1'"),
    "no scene": (b'{"asset": {"version": "2.0"}}', "expected triangles .*, got no mesh"),
}


@pytest.mark.parametrize(("data", "text"), BAD_CONTAINERS.values(), ids=BAD_CONTAINERS)
@pytest.mark.parametrize("name", ["a.glb", "a.gltf"])
def test_bad_containers_are_refused(load, data, text, name):
    refused(load, data, text, name)


# References

FILES = {
    "plain": ("b.bin", "b.bin"),
    "percent": ("my%20buffer.bin", "my buffer.bin"),
    "not encoded": ("my buffer.bin", "my buffer.bin"),
    "unicode": ("bü漢.bin", "bü漢.bin"),
    "unicode in percents": ("b%C3%BC.bin", "bü.bin"),
    "subfolder": ("sub/b.bin", "sub/b.bin"),
    "back again": ("sub/../b.bin", "b.bin"),
    "a percent sign": ("100%.bin", "100%.bin"),
    "percents in the name": ("my%20buffer.bin", "my%20buffer.bin"),
    "a query": ("sub/my%20b.bin?v=1&w=%2F", "sub/my b.bin"),
    "a fragment": ("b.bin#1", "b.bin"),
    "a question mark in the name": ("b?.bin", "b?.bin"),
    "folders of Windows": ("sub\\b.bin", "sub/b.bin"),
}


@pytest.mark.parametrize(("uri", "name"), FILES.values(), ids=FILES)
def test_buffers_in_files(load, tmp_path, uri, name):
    file = shown()
    (tmp_path / "sub").mkdir()
    (tmp_path / name).write_bytes(file.binary)
    is_the_triangle(load(file.gltf(uri), "a.gltf"))


@pytest.mark.parametrize(
    "head",
    ["data:application/octet-stream;base64,", "data:;base64,", "DATA:a/b;c=d;BASE64,"],
)
def test_data_uris(load, head):
    text = shown().gltf().decode()
    standard = "data:application/octet-stream;base64,"
    is_the_triangle(load(text.replace(standard, head).encode(), "a.gltf"))


def test_data_uris_with_percents(load):
    file = shown()
    coded = "".join(f"%{byte:02x}" for byte in file.binary)
    is_the_triangle(load(file.gltf("data:," + coded), "a.gltf"))


REFUSED_URIS = {
    "absolute": ("/etc/hostname", "below the folder"),
    "out": ("../b.bin", "which leads out"),
    "out in percents": ("%2e%2e/b.bin", "which leads out"),
    "out and in": ("sub/../../folder2/b.bin", "which leads out"),
    "file": ("file:///etc/hostname", "below the folder"),
    "http": ("http://example.com/b.bin", "below the folder"),
    "https": ("HTTPS://example.com/b.bin", "below the folder"),
    "network": ("//example.com/b.bin", "below the folder"),
    "link": ("link.bin", "which leads out"),
    "linked folder": ("up/b.bin", "which leads out"),
    "a query that leads out": ("../b.bin?x", "leads out"),
    "folders of Windows that lead out": ("sub\\..\\..\\b.bin", "leads out"),
    "missing": ("no.bin", r"buffers\[0\].uri: expected a file, got 'no.bin', which is not there"),
    "folder": ("sub", "folder|directory"),
    "fifo": ("fifo", "expected a regular file, got a FIFO"),
    "device": ("null", "which leads out"),
    "base64": ("data:;base64,AA*A", "expected base64"),
    "no comma": ("data:;base64", "with a comma"),
    "surrogate": ("\ud800.bin", "expected a URI"),
    "zero byte": ("a%00b", "a.00b"),
}


@pytest.mark.parametrize(("uri", "text"), REFUSED_URIS.values(), ids=REFUSED_URIS)
def test_references_stay_below_the_folder(tmp_path, uri, text):
    folder = tmp_path / "folder"
    (folder / "sub").mkdir(parents=True)
    file = shown()
    (tmp_path / "b.bin").write_bytes(file.binary)
    (folder / "link.bin").symlink_to(tmp_path / "b.bin")
    (folder / "up").symlink_to(tmp_path)
    (folder / "null").symlink_to("/dev/null")
    os.mkfifo(folder / "fifo")
    (folder / "a.gltf").write_bytes(file.gltf(uri))
    with pytest.raises(cc.MeshError, match=text) as error:
        cc.load_mesh(folder / "a.gltf")
    assert "buffers[0].uri" in str(error.value)


def test_a_link_inside_the_folder_is_followed(load, tmp_path):
    file = shown()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "b.bin").write_bytes(file.binary)
    (tmp_path / "link.bin").symlink_to("sub/b.bin")
    is_the_triangle(load(file.gltf("link.bin"), "a.gltf"))


def test_a_buffer_may_be_shorter_than_its_file_but_not_longer(load):
    file = shown()
    is_the_triangle(load(file.glb(buffers=[{"byteLength": len(file.binary)}])))
    refused(
        load,
        file.glb(buffers=[{"byteLength": 37}]),
        r"buffers\[0\].byteLength: .*36 bytes, got|there, got 37",
    )
    refused(load, file.glb(buffers=[{"byteLength": 12}]), r"bufferViews\[0\]: expected 36 bytes")
    refused(load, file.glb(buffers=[{}]), r"buffers\[0\].byteLength: expected an integer")


def test_only_the_first_buffer_is_in_the_binary_chunk(load):
    file = shown()
    file.tree["bufferViews"][0]["buffer"] = 1
    size = len(file.binary)
    refused(load, file.glb(buffers=[{"byteLength": size}] * 2), r"buffers\[1\].uri: expected a URI")


# Extensions


@pytest.mark.parametrize(
    "name",
    ["KHR_materials_clearcoat", "KHR_texture_transform", "KHR_lights_punctual", "EXT_texture_webp"],
)
def test_required_extensions_that_do_not_move_triangles_are_known(load, name):
    is_the_triangle(load(shown().glb(extensionsUsed=[name], extensionsRequired=[name])))


def test_a_required_extension_that_is_not_known_is_refused_by_name(load):
    refused(load, shown().glb(extensionsRequired=["XYZ_moves"]), r"\[0\]: .*'XYZ_moves'")
    refused(load, shown().glb(extensionsRequired=[7]), "expected the name of an extension, got 7")
    is_the_triangle(load(shown().glb(extensionsUsed=["XYZ_moves"])))


# Accessors


def document(file):
    return Gltf(Path("a.glb"), file.glb())


@pytest.mark.parametrize("name", ["int8", "uint8", "int16", "uint16", "uint32", "float32"])
@pytest.mark.parametrize("width", [1, 2, 3, 4])
def test_component_types(rng, name, width):
    dtype = np.dtype(name)
    values = (
        (rng.random((5, width)) * 1000).astype(dtype)
        if dtype.kind == "f"
        else rng.integers(
            np.iinfo(dtype).min, np.iinfo(dtype).max, (5, width), dtype, endpoint=True
        )
    )
    values = values[:, 0] if width == 1 else values
    file = GltfFile()
    plain = file.accessor(values)
    got = document(file).accessor(plain)
    np.testing.assert_array_equal(got, values)
    assert got.dtype == dtype


NORMALIZED = {
    "int8": ([-128, -127, -64, 0, 1, 127], 127),
    "uint8": ([0, 1, 128, 255], 255),
    "int16": ([-32768, -32767, 0, 16384, 32767], 32767),
    "uint16": ([0, 1, 32768, 65535], 65535),
}


@pytest.mark.parametrize("name", NORMALIZED)
def test_normalized_integers(name):
    values, most = NORMALIZED[name]
    file = GltfFile()
    index = file.accessor(np.array(values, name), normalized=True)
    want = [max(value / most, -1) for value in values]
    assert document(file).accessor(index).tolist() == want


def test_interleaved_accessors_with_offsets():
    table = np.arange(40, dtype=np.float32).reshape(5, 8)
    file = GltfFile()
    view = file.view(bytes(4) + table.tobytes(), byteStride=32)
    for offset, kind, width in ((4, "VEC3", 3), (16, "VEC2", 2), (28, "SCALAR", 1)):
        index = file.add(
            "accessors",
            {
                "bufferView": view,
                "byteOffset": offset,
                "componentType": 5126,
                "count": 5,
                "type": kind,
            },
        )
        start = offset // 4 - 1
        want = table[:, start] if width == 1 else table[:, start : start + width]
        np.testing.assert_array_equal(document(file).accessor(index), want)


def test_alignment_is_not_asked_for():
    file = GltfFile()
    view = file.view(b"\1" + np.array([3, 4], np.float32).tobytes())
    index = file.add(
        "accessors",
        {"bufferView": view, "byteOffset": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
    )
    assert document(file).accessor(index).tolist() == [3, 4]


MATRICES = {
    ("MAT2", 5121): (2, 4),
    ("MAT3", 5121): (3, 4),
    ("MAT3", 5123): (3, 8),
    ("MAT2", 5126): (2, 8),
    ("MAT4", 5126): (4, 16),
}


@pytest.mark.parametrize(("kind", "component"), MATRICES)
@pytest.mark.parametrize("whole", [True, False], ids=["padded", "last padding missing"])
def test_matrices_stand_in_columns_that_start_at_multiples_of_four(kind, component, whole):
    size, column = MATRICES[kind, component]
    dtype = {5121: "<u1", 5123: "<u2", 5126: "<f4"}[component]
    want = np.arange(2 * size * size).reshape(2, size, size)
    data = b""
    for matrix in want:
        for k in range(size):
            data += matrix[:, k].astype(dtype).tobytes().ljust(column, b"\xee")
    if not whole:
        data = data[: len(data) - column + size * np.dtype(dtype).itemsize]
    file = GltfFile()
    index = file.add(
        "accessors",
        {"bufferView": file.view(data), "componentType": component, "count": 2, "type": kind},
    )
    np.testing.assert_array_equal(document(file).accessor(index), want)


@pytest.mark.parametrize("based", [True, False], ids=["on a view", "on zeros"])
@pytest.mark.parametrize("indices", ["uint8", "uint16", "uint32"])
def test_sparse_elements_take_their_places(based, indices):
    file = GltfFile()
    base = np.arange(12, dtype=np.float32).reshape(4, 3)
    index = file.accessor(base)
    entry = file.tree["accessors"][index]
    if not based:
        del entry["bufferView"]
        base = np.zeros_like(base)
    new = np.array([[7, 8, 9], [-1, -2, -3]], np.float32)
    places = np.array([1, 3], indices)
    component = {"uint8": 5121, "uint16": 5123, "uint32": 5125}[indices]
    entry["sparse"] = {
        "count": 2,
        "indices": {
            "bufferView": file.view(b"xx" + places.tobytes()),
            "byteOffset": 2,
            "componentType": component,
        },
        "values": {"bufferView": file.view(bytes(4) + new.tobytes()), "byteOffset": 4},
    }
    want = base.copy()
    want[[1, 3]] = new
    np.testing.assert_array_equal(document(file).accessor(index), want)
    for wrong, text in (([3, 1], "increasing"), ([1, 1], "increasing"), ([1, 4], "below 4")):
        file.tree["accessors"][index]["sparse"]["indices"]["bufferView"] = file.view(
            b"xx" + np.array(wrong, indices).tobytes()
        )
        with pytest.raises(cc.MeshError, match=f"sparse.indices: expected .*{text}"):
            document(file).accessor(index)


def test_normalized_sparse_elements_are_normalized_once():
    file = GltfFile()
    index = file.accessor(np.array([0, 51, 255], np.uint8), normalized=True)
    file.tree["accessors"][index]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": file.view(bytes([0])), "componentType": 5121},
        "values": {"bufferView": file.view(bytes([102]))},
    }
    assert document(file).accessor(index).tolist() == [0.4, 0.2, 1]


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"count": 4}, r"accessors\[0\]: expected 48 bytes in its buffer view, got 36"),
        ({"count": -1}, r"accessors\[0\].count: expected an integer from 0, got -1"),
        ({"count": 3.5}, r"count: expected an integer from 0, got 3.5"),
        ({"count": True}, r"count: expected an integer from 0, got True"),
        ({"count": "3"}, r"count: expected an integer from 0, got '3'"),
        ({"count": 10**30}, "expected 120+ bytes"),
        ({"byteOffset": 4}, "expected 40 bytes"),
        ({"byteOffset": -4}, "byteOffset: expected an integer from 0"),
        ({"byteOffset": 10**30, "count": 1}, "expected 10+12 bytes"),
        ({"type": "VEC5"}, r"type: expected one of SCALAR, VEC2.*, got 'VEC5'"),
        ({"type": ["VEC3"]}, "type: expected a string"),
        ({"componentType": 5124}, "componentType: expected one of 5120, .*got 5124"),
        ({"bufferView": 1}, r"bufferView: expected an index below 1, got 1"),
        ({"bufferView": None}, "bufferView: expected an index below 1, got None"),
        ({"normalized": 1}, "normalized: expected true or false, got 1"),
        ({"sparse": []}, "sparse: expected an object"),
        ({"sparse": {"count": 4}}, "sparse.count: expected at most the accessor's 3"),
        ({"sparse": {"count": 1}}, "sparse.indices: expected an object, got none"),
    ],
)
def test_bad_accessors_are_refused_with_their_place(load, change, text):
    file = shown()
    file.tree["accessors"][0].update(change)
    refused(load, file, text)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"byteLength": 35}, "expected 36 bytes in its buffer view, got 35"),
        ({"byteLength": 37}, r"bufferViews\[0\]: expected 37 bytes in buffers\[0\], got 36"),
        ({"byteOffset": 10**20}, r"expected 10+36 bytes"),
        ({"byteStride": 8}, "expected a byteStride of at least 12 .*got 8"),
        ({"byteStride": 10**30}, "expected 20+12 bytes"),
        ({"buffer": 1}, r"bufferViews\[0\].buffer: expected an index below 1, got 1"),
        ({"buffer": {}}, "buffer: expected an index below 1"),
    ],
)
def test_bad_buffer_views_are_refused_with_their_place(load, change, text):
    file = shown()
    file.tree["bufferViews"][0].update(change)
    refused(load, file, text)


def test_an_accessor_without_a_view_is_zeros_and_not_of_any_size(load):
    file = GltfFile()
    index = file.add("accessors", {"componentType": 5126, "count": 3, "type": "VEC3"})
    assert document(file).accessor(index).tolist() == [[0, 0, 0]] * 3
    file.tree["accessors"][index]["count"] = 100_000_000
    with pytest.raises(cc.MeshError, match=r"accessors\[0\].count: expected at most 6\d+ elements"):
        document(file).accessor(index)


# The document


def test_the_tree_and_the_raw_entries_stay_reachable(tmp_path):
    file = shown()
    file.add("materials", {"name": "red", "extras": {"mine": [1]}})
    number = file.accessor(np.array([[5, 6, 7, 8]], np.float32))
    file.tree["meshes"][0]["primitives"][0]["attributes"]["_CUSTOM"] = number
    (tmp_path / "a.glb").write_bytes(file.glb())
    found = read_gltf(tmp_path / "a.glb")
    assert found.tree.raw == json.loads(
        json.dumps({**file.tree, "buffers": [{"byteLength": len(file.binary)}]})
    )
    assert found.entry("materials", 0).raw["extras"] == {"mine": [1]}
    assert found.count("materials") == 1
    assert found.count("cameras") == 0
    assert found.accessor(number).tolist() == [[5, 6, 7, 8]]
    assert bytes(found.buffer(0)) == file.binary
    assert found.nodes.worlds.shape == (1, 4, 4)
    with pytest.raises(cc.MeshError, match="materials: expected an index below 1, got 3"):
        found.entry("materials", 3)


def test_read_gltf_names_the_file(tmp_path):
    (tmp_path / "a.gltf").write_text("{}")
    with pytest.raises(cc.MeshError, match=r"a\.gltf: asset"):
        read_gltf(tmp_path / "a.gltf")
