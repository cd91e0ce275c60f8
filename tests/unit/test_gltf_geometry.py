"""glTF geometry by value: modes, attributes, nodes, instances, morph targets, skins."""

import numpy as np
import pytest

import cubecam as cc
from tests.gltf_files import CORNERS, SQUARE, GltfFile, shown


@pytest.fixture
def load(tmp_path):
    def load(file, **options):
        (tmp_path / "a.glb").write_bytes(file.glb())
        return cc.load_mesh(tmp_path / "a.glb", **options)

    return load


def refused(load, file, text):
    with pytest.raises(cc.MeshError, match=text):
        load(file)


def shifted(x):
    return CORNERS + np.array([x, 0, 0], np.float32)


def faced(mesh):
    """The normals of the triangles, by their winding."""
    a, b, c = np.moveaxis(mesh.positions.astype(float)[mesh.indices], 1, 0)
    normals = np.cross(b - a, c - a)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


# Primitives

ZIGZAG = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0], [1, 2, 0]], np.float32)
FAN = np.array([[0, 0, 0], [2, 0, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 0]], np.float32)

MODES = {
    "triangles": (4, ZIGZAG, [[0, 1, 2], [3, 4, 5]]),
    "strip": (5, ZIGZAG, [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]),
    "fan": (6, FAN, [[1, 2, 0], [2, 3, 0], [3, 4, 0]]),
}


@pytest.mark.parametrize(("mode", "positions", "want"), MODES.values(), ids=MODES)
@pytest.mark.parametrize("indices", [None, "uint8", "uint16", "uint32"])
def test_modes_of_triangles(load, mode, positions, want, indices):
    given = None
    if indices is not None:  # the same triangles, from vertices in the opposite order
        positions = positions[::-1]
        given = np.arange(len(positions) - 1, -1, -1).astype(indices)
        want = len(positions) - 1 - np.array(want)
    mesh = load(shown(positions=positions, indices=given, mode=mode))
    np.testing.assert_array_equal(mesh.indices, want)
    np.testing.assert_array_equal(mesh.positions, positions)


def test_strips_and_fans_face_one_way(load):
    np.testing.assert_allclose(faced(load(shown(positions=ZIGZAG, mode=5))), [[0, 0, 1]] * 4)
    np.testing.assert_allclose(faced(load(shown(positions=FAN, mode=6))), [[0, 0, 1]] * 3)


@pytest.mark.parametrize(
    ("mode", "name"), [(0, "points"), (1, "lines"), (2, "line loops"), (3, "line strips")]
)
def test_points_and_lines_are_skipped_and_named_where_there_is_nothing_else(load, mode, name):
    refused(load, shown(mode=mode), f"expected triangles in the default scene, got {name}")
    file = GltfFile()
    file.node(mesh=file.mesh(file.primitive(mode=mode), file.primitive(SQUARE[:3] + 5)))
    np.testing.assert_array_equal(load(file).positions, SQUARE[:3] + 5)


def test_bad_modes_are_refused(load):
    refused(load, shown(mode=7), r"primitives\[0\].mode: expected an integer from 0 to 6, got 7")
    refused(load, shown(positions=ZIGZAG[:4]), "expected a multiple of 3 indices, got 4")
    refused(load, shown(positions=ZIGZAG[:2], mode=5), "expected 3 indices or more, got 2")


@pytest.mark.parametrize(
    ("indices", "text"),
    [
        (np.array([0, 1, 3], np.uint8), "expected indices below 3, got 3"),
        (np.array([0, 1, 255], np.uint8), "expected indices below 3, got 255"),
        (np.array([0, 1, 2], np.int8), "expected an accessor of unsigned integers"),
        (np.array([0, 1, 2], np.float32), "expected an accessor of unsigned integers"),
    ],
)
def test_bad_indices_are_refused(load, indices, text):
    refused(load, shown(indices=indices), rf"meshes\[0\].primitives\[0\].indices: {text}")


def test_the_largest_number_of_a_type_is_no_index(load):
    many = np.zeros((300, 3), np.float32)
    many[:3] = CORNERS
    refused(load, shown(positions=many, indices=np.array([0, 1, 255], np.uint8)), "below 255")
    load(shown(positions=many, indices=np.array([0, 1, 254], np.uint8)), size=None)


def test_primitives_without_positions_are_skipped(load):
    file = GltfFile()
    primitive = file.primitive()
    primitive["attributes"] = {"NORMAL": primitive["attributes"]["POSITION"]}
    file.node(mesh=file.mesh(primitive, file.primitive()))
    np.testing.assert_array_equal(load(file).positions, CORNERS)


def test_texture_coordinates_count_from_the_bottom(load):
    uvs = np.array([[0, 0], [0.25, 0.5], [1, 2]], np.float32)
    got = load(shown(TEXCOORD_0=uvs)).uvs
    np.testing.assert_array_equal(got, [[0, 1], [0.25, 0.5], [1, -1]])


def test_the_second_set_counts_from_the_bottom_too(load):
    uvs = np.array([[0, 0], [0.25, 0.5], [1, 2]], np.float32)
    mesh = load(shown(TEXCOORD_1=uvs))
    assert mesh.uvs is None
    np.testing.assert_array_equal(mesh.uvs1, [[0, 1], [0.25, 0.5], [1, -1]])
    file = GltfFile()
    file.node(mesh=file.mesh(file.primitive(TEXCOORD_1=uvs), file.primitive()))
    np.testing.assert_array_equal(load(file).uvs1[3:], 0)


UP = np.array([[0, 0, 1]] * 3, np.float32)
TANGENTS = np.array([[1, 0, 0, 1], [0, 1, 0, -1], [0.6, 0.8, 0, 1]], np.float32)


def test_tangents_go_with_the_nodes(load):
    file = GltfFile()
    mesh = file.mesh(file.primitive(NORMAL=UP, TANGENT=TANGENTS))
    file.node(mesh=mesh, scale=[2, 1, 1])
    file.node(mesh=mesh, scale=[-1, 1, 1])
    got = load(file).tangents
    stretched = np.array([[1, 0, 0], [0, 1, 0], np.array([1.2, 0.8, 0]) / np.hypot(1.2, 0.8)])
    np.testing.assert_allclose(got[:3], np.c_[stretched, [1, -1, 1]], atol=1e-6)
    # A mirror turns round the cross product of normal and tangent, so that the signs change.
    np.testing.assert_allclose(got[3:], TANGENTS * (-1, 1, 1, -1), atol=1e-6)


@pytest.mark.parametrize(
    "case", ["without normals", "not a number", "of one part", "moved by a morph target"]
)
def test_tangents_that_do_not_count(load, case):
    file = GltfFile()
    bad = np.full((3, 4), np.nan, np.float32)
    target = {"POSITION": file.accessor(CORNERS)}
    parts = {
        "without normals": [file.primitive(TANGENT=TANGENTS)],
        "not a number": [file.primitive(NORMAL=UP, TANGENT=bad)],
        "of one part": [file.primitive(NORMAL=UP, TANGENT=TANGENTS), file.primitive(NORMAL=UP)],
        "moved by a morph target": [
            {**file.primitive(NORMAL=UP, TANGENT=TANGENTS), "targets": [target]}
        ],
    }[case]
    file.node(
        mesh=file.mesh(*parts, **({"weights": [0.5]} if case == "moved by a morph target" else {}))
    )
    assert load(file).tangents is None


COLORS = np.array([[1, 0, 0, 1], [0, 0.4, 0, 0.2], [0.2, 0.6, 1, 0]])


@pytest.mark.parametrize("width", [3, 4])
@pytest.mark.parametrize("name", ["float32", "uint8", "uint16"])
def test_colors(load, name, width):
    most = 1 if name == "float32" else np.iinfo(name).max
    values = np.round(COLORS[:, :width] * most) if most > 1 else COLORS[:, :width]
    if name == "float32" or width == 4:
        file = GltfFile()
        number = file.accessor(values.astype(name), **({} if most == 1 else {"normalized": True}))
    else:  # three small components, with the padding that attributes have
        file = GltfFile()
        padded = np.concatenate([values, np.full((3, 1), 77)], axis=1).astype(name)
        number = file.accessor(padded, normalized=True, type="VEC3")
        file.tree["bufferViews"][0]["byteStride"] = padded.itemsize * 4
    file.node(mesh=file.mesh(file.primitive(COLOR_0=number)))
    want = COLORS.copy()
    if width == 3:
        want[:, 3] = 1
    np.testing.assert_array_equal(load(file).colors, want.astype(np.float32))


def test_colors_are_clamped_and_need_no_flag(load):
    bright = np.array([[2, -1, 0.5]] * 3, np.float32)
    np.testing.assert_array_equal(load(shown(COLOR_0=bright)).colors, [[1, 0, 0.5, 1]] * 3)
    coded = np.array([[255, 0, 51, 255]] * 3, np.uint8)
    np.testing.assert_allclose(load(shown(COLOR_0=coded)).colors, [[1, 0, 0.2, 1]] * 3)


def test_a_part_without_colors_or_uvs_gets_white_and_zero(load):
    file = GltfFile()
    colors, uvs = np.full((3, 4), 0.5, np.float32), np.full((3, 2), 0.25, np.float32)
    file.node(mesh=file.mesh(file.primitive(COLOR_0=colors, TEXCOORD_0=uvs), file.primitive()))
    mesh = load(file)
    np.testing.assert_array_equal(mesh.colors, np.repeat([[0.5] * 4, [1] * 4], 3, axis=0))
    np.testing.assert_array_equal(mesh.uvs, np.repeat([[0.25, 0.75], [0, 0]], 3, axis=0))


def test_quantized_attributes(load):
    file = GltfFile(extensionsRequired=["KHR_mesh_quantization"])
    positions = np.array([[0, 0, 0, 9], [127, 0, 0, 9], [0, -128, 0, 9]], np.int8)
    number = file.accessor(positions, type="VEC3", normalized=True)
    file.tree["bufferViews"][0]["byteStride"] = 4
    uvs = file.accessor(np.array([[0, 0], [300, 7], [2, 65535]], np.uint16))
    file.node(mesh=file.mesh(file.primitive(number, TEXCOORD_0=uvs)), scale=[2, 3, 1])
    mesh = load(file)
    np.testing.assert_array_equal(mesh.positions, [[0, 0, 0], [2, 0, 0], [0, -3, 0]])
    np.testing.assert_array_equal(mesh.uvs, [[0, 1], [300, -6], [2, -65534]])
    plain = shown(positions=np.array([[0, 0, 0, 0], [500, 0, 0, 0], [0, 65535, 0, 0]], np.uint16))
    plain.tree["accessors"][0]["type"] = "VEC3"
    plain.tree["bufferViews"][0]["byteStride"] = 8
    np.testing.assert_array_equal(load(plain).positions, [[0, 0, 0], [500, 0, 0], [0, 65535, 0]])


@pytest.mark.parametrize(
    ("key", "values", "text"),
    [
        (
            "NORMAL",
            np.zeros((2, 3), np.float32),
            "expected 3 elements, as other attributes .*got 2",
        ),
        ("NORMAL", np.zeros((3, 2), np.float32), "expected an accessor of VEC3, got VEC2"),
        ("TEXCOORD_0", np.zeros((4, 2), np.float32), "expected 3 elements"),
        ("COLOR_0", np.zeros((3, 2), np.float32), "expected an accessor of VEC3 or VEC4, got VEC2"),
        ("TEXCOORD_1", np.zeros((3, 3), np.float32), "expected an accessor of VEC2, got VEC3"),
    ],
)
def test_attributes_that_do_not_fit_are_refused(load, key, values, text):
    refused(load, shown(**{key: values}), rf"primitives\[0\].attributes.{key}: {text}")


def test_bad_positions_are_refused(load):
    refused(load, shown(positions=np.full((3, 3), np.nan, np.float32)), "POSITION: .*finite")
    refused(load, shown(positions=np.full((3, 2), 1, np.float32)), "POSITION: .*VEC3, got VEC2")
    file = shown()
    file.tree["nodes"][0]["scale"] = [1e39, 1, 1]
    refused(load, file, "expected finite positions that fit float32")
    file.tree["nodes"][0]["scale"] = [1e300, 1, 1]
    file.tree["nodes"].append({"children": [0], "scale": [1e300, 1, 1]})
    refused(load, file, "expected finite positions that fit float32")


# Nodes


def quaternion(axis, degrees):
    half = np.radians(degrees) / 2
    return [*(np.sin(half) * np.array(axis) / np.linalg.norm(axis)), np.cos(half)]


def turning(axis, degrees):
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def affine(linear, place=(0, 0, 0)):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = linear, place
    return matrix


def moved(matrix, points):
    return np.asarray(points, float) @ matrix[:3, :3].T + matrix[:3, 3]


def test_translation_rotation_and_scale(load):
    corners = np.array([[0, 0, 1], [1, 0, -2], [0, 1, 5]], np.float32)
    file = shown(positions=corners)
    axis = (1, 2, -0.5)
    long = [3 * q for q in quaternion(axis, 40)]  # any length
    file.tree["nodes"][0].update(translation=[5, 6, 7], rotation=long, scale=[2, 3, -4])
    want = affine(turning(axis, 40) @ np.diag([2, 3, -4]), (5, 6, 7))
    np.testing.assert_allclose(load(file).positions, moved(want, corners), atol=1e-5)


def test_children_are_placed_by_their_parents(load):
    file = GltfFile()
    mesh = file.mesh()
    grandchild = file.node(root=False, mesh=mesh, translation=[1, 0, 0])
    child = file.node(root=False, children=[grandchild], rotation=quaternion((0, 0, 1), 90))
    matrix = affine(np.diag([2, 2, 2]), (0, 0, 5))
    file.node(children=[child], matrix=matrix.T.ravel().tolist())  # column by column
    want = matrix @ affine(turning((0, 0, 1), 90)) @ affine(np.eye(3), (1, 0, 0))
    np.testing.assert_allclose(load(file).positions, moved(want, CORNERS), atol=1e-6)


TRANSFORMS = {
    "stretched": np.diag([3.0, 1, 1]),
    "mirrored": np.diag([-1.0, 1, 1]),
    "mirrored three times": np.diag([-1.0, -2, -3]),
    "flat": np.diag([1.0, 1, 0]),
    "tiny": np.diag([1e-18, -3e-18, 1e-18]),
    "sheared and mirrored": np.array([[-2, 0.5, 0], [0, 1, 0.3], [0.2, 0, 0.7]]),
}


@pytest.mark.parametrize("linear", TRANSFORMS.values(), ids=TRANSFORMS)
def test_normals_go_by_the_inverse_transpose_and_the_outside_stays_outside(load, linear):
    ball = cc.Mesh.icosphere(1, subdivisions=1)
    normals = np.array(ball.positions)  # each vertex is its own normal
    size = np.abs(linear).max()
    place = np.array([1, 2, 3]) * size
    file = shown(
        positions=np.array(ball.positions),
        indices=np.array(ball.indices, np.uint32).ravel(),
        NORMAL=normals,
    )
    file.tree["nodes"][0]["matrix"] = affine(linear, place).T.ravel().tolist()
    mesh = load(file)
    assert_close = np.testing.assert_allclose
    want = moved(affine(linear, place), ball.positions) / size
    assert_close(mesh.positions / size, want, atol=1e-5)
    if np.linalg.det(linear) == 0:  # flattened along z: all normals point along z
        assert_close(np.abs(mesh.normals[np.abs(normals[:, 2]) > 0.1]) @ [0, 0, 1], 1, atol=1e-5)
        return
    want = normals @ np.linalg.inv(linear / size)
    want /= np.linalg.norm(want, axis=1, keepdims=True)
    assert_close(mesh.normals, want, atol=1e-5)
    assert (np.einsum("ij,ij->i", faced(mesh), want[np.asarray(mesh.indices)[:, 0]]) > 0).all()


@pytest.mark.parametrize("name", ["stretched", "mirrored", "mirrored three times"])
def test_missing_normals_are_on_the_outside(load, name):
    linear = TRANSFORMS[name]
    ball = cc.Mesh.icosphere(1, subdivisions=2)
    file = shown(
        positions=np.array(ball.positions), indices=np.array(ball.indices, np.uint32).ravel()
    )
    file.tree["nodes"][0]["matrix"] = affine(linear).T.ravel().tolist()
    mesh = load(file)
    want = np.array(ball.positions) @ np.linalg.inv(linear)
    want /= np.linalg.norm(want, axis=1, keepdims=True)
    np.testing.assert_allclose(mesh.normals, want, atol=0.1)
    assert (np.einsum("ij,ij->i", faced(mesh), want[np.asarray(mesh.indices)[:, 0]]) > 0).all()


def test_one_mesh_is_shown_by_several_nodes(load):
    file = GltfFile()
    uvs = np.array([[0, 0], [0, 1], [1, 1]], np.float32)
    mesh = file.mesh(
        file.primitive(TEXCOORD_0=uvs),
        file.primitive(SQUARE, np.array([0, 1, 2, 0, 2, 3], np.uint8)),
    )
    places = [(0, 0, 0), (10, 0, 0), (0, 20, 0)]
    for place in places:
        file.node(mesh=mesh, translation=list(place), scale=[1, 1, -1 if place[0] else 1])
    got = load(file)
    np.testing.assert_array_equal(
        got.positions,
        np.concatenate(
            [CORNERS + place for place in places] + [SQUARE + place for place in places]
        ),
    )
    triangle, square = np.array([[0, 1, 2]]), np.array([[0, 1, 2], [0, 2, 3]])
    want = [triangle, triangle[:, ::-1] + 3, triangle + 6]
    want += [square + 9, square[:, ::-1] + 13, square + 17]
    np.testing.assert_array_equal(got.indices, np.concatenate(want))
    np.testing.assert_array_equal(got.normals[:9:3], [[0, 0, 1], [0, 0, -1], [0, 0, 1]])
    np.testing.assert_array_equal(got.uvs[:9], np.tile([[0, 1], [0, 0], [1, 0]], (3, 1)))


def test_which_scene_is_shown(load):
    file = GltfFile()
    for x in (0, 10, 20):
        file.node(mesh=file.mesh(file.primitive(shifted(x))), root=False)
    file.tree["scenes"] = [{"nodes": [1]}, {"nodes": [0, 2]}]

    def lowest(**change):
        file.tree.update(change)
        found = load(file).positions
        return sorted({float(x) for x in found[:, 0] if x % 10 == 0})

    assert lowest(scene=1) == [0, 20]
    assert lowest(scene=0) == [10]
    del file.tree["scene"]
    assert lowest() == [10]  # the first one
    del file.tree["scenes"]
    assert lowest() == [0, 10, 20]  # all of them
    file = shown()
    file.tree["scene"] = 3
    refused(load, file, "scene: expected an index below 1, got 3")


def test_a_file_of_meshes_without_nodes_is_a_library(load):
    file = GltfFile()
    file.mesh()
    del file.tree["scenes"], file.tree["scene"]
    np.testing.assert_array_equal(load(file).positions, CORNERS)


def test_hidden_nodes_are_left_out(load):
    file = GltfFile()
    mesh = file.mesh()
    child = file.node(root=False, mesh=mesh, translation=[9, 0, 0])
    hidden = {"extensions": {"KHR_node_visibility": {"visible": False}}}
    file.node(children=[child], mesh=mesh, **hidden)
    file.node(mesh=mesh, extensions={"KHR_node_visibility": {}})
    np.testing.assert_array_equal(load(file).positions, CORNERS)


@pytest.mark.parametrize(
    ("children", "text"),
    [
        ([[0], [], []], r"nodes\[0\]: expected a tree, got a cycle"),
        ([[1], [2], [0]], r"nodes\[0\]: expected a tree, got a cycle"),
        ([[], [2], [1]], r"nodes\[1\]: expected a tree, got a cycle"),
        ([[2], [2], []], r"nodes\[2\]: expected one parent, got nodes\[0\] and nodes\[1\]"),
        ([[1, 1], [], []], r"nodes\[1\]: expected one parent"),
        ([[3], [], []], r"nodes\[0\].children\[0\]: expected an index below 3, got 3"),
        ([[1.5], [], []], r"nodes\[0\].children\[0\]: expected an index below 3, got 1.5"),
        ([[True], [], []], "expected an index below 3, got True"),
        ([[-1], [], []], "expected an index below 3, got -1"),
        ([{}, [], []], r"nodes\[0\].children: expected a list of indices"),
    ],
)
def test_what_is_no_tree_of_nodes_is_refused(load, children, text):
    file = GltfFile()
    mesh = file.mesh()
    for entry in children:
        file.node(mesh=mesh, children=entry)
    refused(load, file, text)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"mesh": 7}, r"nodes\[0\].mesh: expected an index below 1, got 7"),
        ({"mesh": "0"}, r"nodes\[0\].mesh: expected an index below 1, got '0'"),
        ({"matrix": [1] * 15}, r"nodes\[0\].matrix: expected a list of 16 numbers"),
        ({"scale": [1, 1, "1"]}, r"nodes\[0\].scale: expected finite numbers"),
        ({"scale": [1, 1, True]}, "scale: expected finite numbers"),
        ({"scale": [1, 1, 10**400]}, "scale: expected finite numbers"),
        ({"translation": 3}, "translation: expected a list of 3 numbers, got 3"),
        ({"rotation": [0, 0, 0, 0]}, r"nodes\[0\].rotation: expected a quaternion of length 1"),
        ({"skin": 0}, r"nodes\[0\].skin: expected an index below 0, got 0"),
        ({"extensions": 1}, r"nodes\[0\].extensions: expected an object, got 1"),
        ({"weights": {}}, "weights: expected a list of numbers"),
    ],
)
def test_bad_nodes_are_refused_with_their_place(load, change, text):
    file = shown()
    file.tree["nodes"][0].update(change)
    refused(load, file, text)


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        ({"nodes": {}}, "nodes: expected a list of objects"),
        ({"nodes": [1]}, r"nodes\[0\]: expected an object, got 1"),
        ({"meshes": [[]]}, r"meshes\[0\]: expected an object"),
        ({"meshes": [{"primitives": 1}]}, r"meshes\[0\].primitives: expected a list"),
        ({"meshes": [{"primitives": [1]}]}, r"meshes\[0\].primitives\[0\]: expected an object"),
        ({"meshes": [{"primitives": [{}]}]}, r"primitives\[0\].attributes: expected an object"),
        ({"scene": "0"}, "scene: expected an index below 1, got '0'"),
        ({"scenes": [{"nodes": [5]}]}, r"scenes\[0\].nodes\[0\]: expected an index below 1, got 5"),
        ({"accessors": [None]}, r"accessors\[0\]: expected an object, got None"),
        ({"asset": []}, "asset: expected an object"),
    ],
)
def test_wrong_types_are_refused_with_their_place(load, tree, text):
    file = shown()
    file.tree.update(tree)
    refused(load, file, text)


def test_a_chain_of_20000_nodes(load):
    file = GltfFile()
    mesh = file.mesh()
    count = 20_000
    file.tree["nodes"] = [{"children": [i + 1], "translation": [0.5, 0, 0]} for i in range(count)]
    file.tree["nodes"].append({"mesh": mesh})
    file.tree["scenes"] = [{"nodes": [0]}]
    np.testing.assert_array_equal(load(file).positions, shifted(count / 2))


# Instances


def instanced(**attributes):
    file = GltfFile()
    given = {
        key: value if isinstance(value, int) else file.accessor(value)
        for key, value in attributes.items()
    }
    mesh = file.mesh()
    file.node(
        mesh=mesh,
        translation=[100, 0, 0],
        scale=[2, 2, 2],
        extensions={"EXT_mesh_gpu_instancing": {"attributes": given}},
    )
    return file


PLACES = np.array([[0, 0, 0], [5, 0, 0], [0, 5, 1]], np.float32)
SCALES = np.array([[1, 1, 1], [1, 2, 3], [-1, 1, 1]], np.float32)
TURNED = [((0, 0, 1), 0), ((0, 0, 1), 90), ((1, 1, 1), 120)]
TURNS = np.array([quaternion(*turn) for turn in TURNED])


@pytest.mark.parametrize(
    "given",
    [("TRANSLATION",), ("ROTATION",), ("SCALE",), ("TRANSLATION", "ROTATION", "SCALE")],
    ids=str,
)
def test_instances(load, given):
    columns = {"TRANSLATION": PLACES, "ROTATION": TURNS.astype(np.float32), "SCALE": SCALES}
    mesh = load(instanced(**{key: columns[key] for key in given}))
    want = []
    for place, turn, scale in zip(PLACES, TURNED, SCALES, strict=True):
        linear = turning(*turn) if "ROTATION" in given else np.eye(3)
        linear = linear @ np.diag(scale) if "SCALE" in given else linear
        own = affine(linear, place if "TRANSLATION" in given else (0, 0, 0))
        want.append(moved(affine(np.eye(3) * 2, (100, 0, 0)) @ own, CORNERS))
    np.testing.assert_allclose(mesh.positions, np.concatenate(want), atol=1e-5)


@pytest.mark.parametrize("name", ["int8", "int16"])
def test_rotations_of_instances_may_be_normalized_integers(load, name):
    most = np.iinfo(name).max
    file = instanced(ROTATION=np.round(TURNS * most).astype(name))
    file.tree["accessors"][0]["normalized"] = True
    want = [moved(affine(turning((1, 1, 1), 120) * 2, (100, 0, 0)), CORNERS)]
    np.testing.assert_allclose(load(file).positions[6:], want[0], atol=0.05)


def test_bad_instances_are_refused(load):
    refused(load, instanced(TRANSLATION=PLACES, SCALE=SCALES[:2]), "SCALE: expected 3 elements")
    refused(load, instanced(TRANSLATION=PLACES[:, :2]), "TRANSLATION: expected an accessor of VEC3")
    refused(load, instanced(ROTATION=np.zeros((2, 4), np.float32)), "ROTATION: 0: .*quaternion")
    file = instanced()
    np.testing.assert_array_equal(load(file).positions, CORNERS * 2 + [100, 0, 0])


# Morph targets


def morphing(weights_of_mesh=None, weights_of_node=None, **streams):
    """A triangle with two targets; `streams` are pairs: the base, and the change of each target."""
    file = GltfFile()
    changes: list[dict[str, int]] = [{}, {}]
    base = {}
    for key, (values, *targets) in streams.items():
        base[key] = values
        for entry, change in zip(changes, targets, strict=True):
            entry[key] = file.accessor(change)
    primitive = file.primitive(**{k: v for k, v in base.items() if k != "POSITION"})
    primitive["targets"] = changes
    mesh = file.mesh(primitive)
    if weights_of_mesh is not None:
        file.tree["meshes"][mesh]["weights"] = weights_of_mesh
    file.node(mesh=mesh, **({} if weights_of_node is None else {"weights": weights_of_node}))
    return file


UP = np.array([[0, 0, 1], [0, 0, 2], [0, 0, 3]], np.float32)
ASIDE = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 0]], np.float32)


@pytest.mark.parametrize(
    ("of_mesh", "of_node", "weights"),
    [
        (None, None, (0, 0)),
        ([0.5, 0], None, (0.5, 0)),
        ([0.5, 0], [0, -2], (0, -2)),
        (None, [1, 0.25], (1, 0.25)),
        ([1, 1], [0, 0], (0, 0)),
    ],
)
def test_morph_targets_with_the_weights_of_the_node_else_of_the_mesh(
    load, of_mesh, of_node, weights
):
    mesh = load(morphing(of_mesh, of_node, POSITION=(CORNERS, UP, ASIDE)))
    want = CORNERS + weights[0] * UP + weights[1] * ASIDE
    np.testing.assert_allclose(mesh.positions, want, atol=1e-6)


def test_morphed_normals_uvs_and_colors(load):
    normals = np.array([[0, 0, 1]] * 3, np.float32)
    turned = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 0]], np.float32)
    uvs = np.array([[0, 0], [1, 0], [0, 1]], np.float32)
    shift = np.array([[0.5, 0.25]] * 3, np.float32)
    colors = np.full((3, 4), 0.5, np.float32)
    change = np.array([[0.25, -2, 0]] * 3, np.float32)
    nothing3, nothing2 = np.zeros((3, 3), np.float32), np.zeros((3, 2), np.float32)
    mesh = load(
        morphing(
            [1, 1],
            NORMAL=(normals, turned, nothing3),
            TEXCOORD_0=(uvs, nothing2, shift),
            COLOR_0=(colors, change, nothing3),
        )
    )
    half = np.sqrt(0.5)
    np.testing.assert_allclose(
        mesh.normals, [[half, 0, half], [0, half, half], [0, 0, 1]], atol=1e-6
    )
    np.testing.assert_allclose(mesh.uvs, [[0.5, 0.75], [1.5, 0.75], [0.5, -0.25]], atol=1e-6)
    np.testing.assert_array_equal(mesh.colors, [[0.75, 0, 0.5, 0.5]] * 3)


def test_missing_normals_are_those_of_the_morphed_mesh(load):
    tilt = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 0]], np.float32)
    mesh = load(morphing([1, 0], POSITION=(CORNERS, tilt, UP)))
    np.testing.assert_allclose(mesh.normals, [[-np.sqrt(0.5), 0, np.sqrt(0.5)]] * 3, atol=1e-6)


def test_a_sparse_morph_target(load):
    file = morphing([2, 0], POSITION=(CORNERS, UP, UP))
    entry = file.tree["accessors"][0]
    del entry["bufferView"]
    entry["sparse"] = {
        "count": 1,
        "indices": {"bufferView": file.view(bytes([1])), "componentType": 5121},
        "values": {"bufferView": file.view(np.array([[0, 0, 4]], np.float32).tobytes())},
    }
    want = CORNERS + np.array([[0, 0, 0], [0, 0, 8], [0, 0, 0]])
    np.testing.assert_array_equal(load(file).positions, want)


def test_bad_morph_targets_are_refused(load):
    refused(load, morphing([1], POSITION=(CORNERS, UP, UP)), r"targets: expected 1 targets.*got 2")
    refused(
        load,
        morphing([1, 0], POSITION=(CORNERS, UP[:2], UP)),
        r"targets\[0\].POSITION: expected 3 elements",
    )


# Skins


def skinned(joints, weights, inverse=None, nodes=None, **attributes):
    """A triangle in front of the origin, with two joints; the node of the mesh is far away."""
    file = GltfFile()
    columns = {}
    for level, (j, w) in enumerate(zip(joints, weights, strict=True)):
        columns[f"JOINTS_{level}"] = j if isinstance(j, int) else np.array(j, np.uint8)
        columns[f"WEIGHTS_{level}"] = np.array(w, np.float32)
    mesh = file.mesh(file.primitive(**columns, **attributes))
    numbers = [file.node(**entry) for entry in nodes or JOINTS]
    skin = {"joints": numbers}
    if inverse is not None:
        stored = np.stack([np.asarray(m, float).T.ravel() for m in inverse])
        skin["inverseBindMatrices"] = file.accessor(stored)
    file.add("skins", skin)
    file.node(mesh=mesh, skin=0, translation=[50, 60, 70], scale=[-9, 9, 9])
    return file


JOINTS = [
    {"translation": [0, 0, 3]},
    {"translation": [0, 1, 0], "rotation": quaternion((0, 0, 1), 90), "scale": [2, 1, 1]},
]
FIRST = affine(np.eye(3), (0, 0, 3))
SECOND = affine(turning((0, 0, 1), 90) @ np.diag([2, 1, 1]), (0, 1, 0))
EACH = [[0, 0, 0, 0], [0, 1, 0, 0], [1, 0, 0, 0]]
MIXED = [[1, 0, 0, 0], [0.25, 0.75, 0, 0], [1, 0, 0, 0]]


def test_joints_alone_place_a_skinned_mesh(load):
    mesh = load(skinned([EACH], [MIXED]))
    want = [
        moved(FIRST, CORNERS[:1])[0],
        moved(0.25 * FIRST + 0.75 * SECOND, CORNERS[1:2])[0],
        moved(SECOND, CORNERS[2:])[0],
    ]
    np.testing.assert_allclose(mesh.positions, want, atol=1e-6)


def test_inverse_bind_matrices_come_first(load):
    inverse = [affine(np.diag([1, 2, 3]), (1, 0, 0)), affine(turning((1, 0, 0), 30), (0, 5, 0))]
    mesh = load(skinned([EACH], [MIXED], inverse))
    first, second = FIRST @ inverse[0], SECOND @ inverse[1]
    want = [
        moved(first, CORNERS[:1])[0],
        moved(0.25 * first + 0.75 * second, CORNERS[1:2])[0],
        moved(second, CORNERS[2:])[0],
    ]
    np.testing.assert_allclose(mesh.positions, want, atol=1e-5)


def test_the_joints_of_a_tree(load):
    file = skinned([EACH], [MIXED])
    file.tree["nodes"].append({"children": [0], "translation": [0, 0, 10]})
    file.tree["scenes"][0]["nodes"] = [1, 2, 3]
    np.testing.assert_allclose(load(file).positions[0], [0, 0, 13])


def test_weights_of_two_sets_and_of_any_sum(load):
    second_set = [[1, 0, 0, 0]] * 3
    weights = [[[0.5, 0, 0, 0]] * 3, [[1.5, 0, 0, 0]] * 3]  # a quarter, and three quarters
    mesh = load(skinned([[[0, 9, 9, 9]] * 3, second_set], weights))
    np.testing.assert_allclose(
        mesh.positions, moved(0.25 * FIRST + 0.75 * SECOND, CORNERS), atol=1e-6
    )


@pytest.mark.parametrize(("name", "joints"), [("uint8", "uint16"), ("uint16", "uint8")])
def test_weights_and_joints_of_integers(load, name, joints):
    most = np.iinfo(name).max
    file = skinned([EACH], [MIXED])
    weights = np.round(np.array(MIXED) * most).astype(name)
    attributes = file.tree["meshes"][0]["primitives"][0]["attributes"]
    attributes["WEIGHTS_0"] = file.accessor(weights, normalized=True)
    attributes["JOINTS_0"] = file.accessor(np.array(EACH, joints))
    part = round(0.25 * most) / most
    want = moved(part * FIRST + (1 - part) * SECOND, CORNERS[1:2])[0]
    np.testing.assert_allclose(load(file).positions[1], want, atol=1e-6)


def test_a_vertex_without_weights_goes_with_the_first_joint(load):
    mesh = load(skinned([EACH], [[[1, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0]]]))
    np.testing.assert_allclose(mesh.positions[1], moved(FIRST, CORNERS[1:2])[0])


def test_normals_go_with_the_joints(load):
    normals = np.array([[0, 0, 1], [0.6, 0, 0.8], [0.6, 0.8, 0]], np.float32)
    mesh = load(skinned([EACH], [MIXED], NORMAL=normals))
    matrices = [FIRST, 0.25 * FIRST + 0.75 * SECOND, SECOND]
    want = np.array(
        [
            np.linalg.inv(m[:3, :3]).T @ n
            for m, n in zip(matrices, normals.astype(float), strict=True)
        ]
    )
    np.testing.assert_allclose(
        mesh.normals, want / np.linalg.norm(want, axis=1, keepdims=True), atol=1e-5
    )


def test_joints_that_mirror_keep_the_outside_outside(load):
    normals = np.array([[0, 0, 1]] * 3, np.float32)
    nodes = [{"scale": [-1, 1, 1]}, {"scale": [-1, 1, 1]}]
    mesh = load(skinned([EACH], [MIXED], nodes=nodes, NORMAL=normals))
    np.testing.assert_allclose(mesh.normals, normals, atol=1e-6)
    np.testing.assert_allclose(faced(mesh), [[0, 0, 1]])
    np.testing.assert_array_equal(mesh.positions, CORNERS * [-1, 1, 1])


def test_morph_targets_come_before_the_skin(load):
    file = skinned([[[1, 0, 0, 0]] * 3], [[[1, 0, 0, 0]] * 3])
    primitive = file.tree["meshes"][0]["primitives"][0]
    primitive["targets"] = [{"POSITION": file.accessor(ASIDE)}]
    file.tree["meshes"][0]["weights"] = [2]
    np.testing.assert_allclose(load(file).positions, moved(SECOND, CORNERS + 2 * ASIDE), atol=1e-6)


def test_a_skin_needs_a_node_that_names_it(load):
    file = skinned([EACH], [MIXED])
    del file.tree["nodes"][2]["skin"]
    np.testing.assert_allclose(load(file).positions, CORNERS * [-9, 9, 9] + [50, 60, 70])


def test_bad_skins_are_refused(load):
    refused(load, skinned([], []), "JOINTS_0: expected the index of an accessor, got none")
    refused(
        load, skinned([[[2, 0, 0, 0]] * 3], [MIXED]), "JOINTS_0: expected joints below 2, got 2"
    )
    refused(
        load, skinned([EACH], [[[1, -1, 0, 0]] * 3]), "WEIGHTS_0: expected weights of 0 or more"
    )
    refused(load, skinned([EACH], [[[np.nan, 0, 0, 0]] * 3]), "WEIGHTS_0: expected weights")
    refused(load, skinned([EACH], [MIXED], [np.eye(4)]), "expected 2 matrices, .*got 1")
    file = skinned([EACH], [MIXED])
    file.tree["skins"][0]["joints"] = []
    refused(load, file, r"skins\[0\].joints: expected a list of nodes")
    file.tree["skins"][0]["joints"] = [9]
    refused(load, file, r"skins\[0\].joints\[0\]: expected an index below 3, got 9")
