"""PLY files by value: text and both orders of bytes, lists of any lengths, strips, wedges, colours of all types."""

import struct

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import least_cpu_seconds
from tests.mesh_files import close, corner_values, load, survives, triangles

SQUARE = [[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]]
HALVES = [[0, 1, 2], [0, 2, 3]]
FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
XYZ = ["float x", "float y", "float z"]
INDICES = ["list uchar int vertex_indices"]
CODES = {
    "char": "b",
    "int8": "b",
    "uchar": "B",
    "uint8": "B",
    "short": "h",
    "int16": "h",
    "ushort": "H",
    "uint16": "H",
    "int": "i",
    "int32": "i",
    "uint": "I",
    "uint32": "I",
    "float": "f",
    "float32": "f",
    "double": "d",
    "float64": "d",
}
every_format = pytest.mark.parametrize("form", FORMATS)


def ply(form, *elements, end="\n", comments=()):
    """Write elements, each (name, properties, rows); the value of a list property is a list."""
    header = ["ply", f"format {form} 1.0", *comments]
    body = []
    for name, properties, rows in elements:
        header.append(f"element {name} {len(rows)}")
        header += [f"property {each}" for each in properties]
        for row in rows:
            fields = []
            for each, value in zip(properties, row, strict=True):
                types = each.split()[:-1]
                if types[0] == "list":
                    fields.append((types[1], len(value)))
                    fields += [(types[2], item) for item in value]
                else:
                    fields.append((types[0], value))
            if form == "ascii":
                body.append((" ".join(repr(value) for _, value in fields) + end).encode())
            else:
                body += [struct.pack(FORMATS[form] + CODES[t], v) for t, v in fields]
    return (end.join([*header, "end_header"]) + end).encode() + b"".join(body)


def vertices(more=(), values=((), (), (), ())):
    return ("vertex", [*XYZ, *more], [[*p, *v] for p, v in zip(SQUARE, values, strict=True)])


def faces(lists, properties=INDICES):
    return ("face", properties, [[each] for each in lists])


@every_format
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_square(tmp_path, form, end):
    comments = ["comment element face 7", "obj_info any words", "comment"]
    mesh = load(
        tmp_path, "a.ply", ply(form, vertices(), faces([[0, 1, 2, 3]]), end=end, comments=comments)
    )
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES
    close(mesh.normals, [[0, 0, 1]] * 4)
    assert mesh.colors is None
    assert mesh.uvs is None


def test_the_first_byte_of_the_data_may_look_like_a_line_feed(tmp_path):
    data = (
        "face",
        ["list uint8 int vertex_index"],
        [[[0, 1, 2, 3, 3, 3, 3, 3, 3, 3]], [[0, 1, 2, 3]]],
    )
    data = ply("binary_big_endian", data, vertices(), end="\r")
    assert b"end_header\r\n" in data
    mesh = load(tmp_path, "a.ply", data)
    assert mesh.indices[-2:].tolist() == HALVES


@every_format
@pytest.mark.parametrize("type_", CODES)
def test_every_type_of_positions_and_indices(tmp_path, form, type_):
    properties = [f"{type_} {name}" for name in "xyz"]
    data = [("vertex", properties, SQUARE), faces(HALVES, [f"list uint32 {type_} vertex_index"])]
    mesh = load(tmp_path, "a.ply", ply(form, *data))
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES


@every_format
@pytest.mark.parametrize("type_", [name for name, code in CODES.items() if code not in "fd"])
def test_every_type_of_a_lists_length(tmp_path, form, type_):
    """Also where the lengths differ, so that each list says where the next one is."""
    lists = [[0, 1, 2], [0, 1, 2, 3], [], [0, 1], [2, 3, 0]]
    mesh = load(
        tmp_path,
        "a.ply",
        ply(form, vertices(), faces(lists, [f"list {type_} short vertex_indices"])),
    )
    assert mesh.indices.tolist() == [[0, 1, 2], *HALVES, [2, 3, 0]]


@every_format
def test_properties_and_elements_in_any_order(tmp_path, form):
    rows = [[9.5, [7, 7], z, 3, y, [], x] for x, y, z in SQUARE]
    names = [
        "double quality",
        "list uchar ushort ring",
        "float z",
        "char flag",
        "float y",
        "list int int more",
        "double x",
    ]
    rows[2][1] = [1, 2, 3]
    flags = ["uchar flags", *INDICES, "list short float other", "double area"]
    face = ("face", flags, [[1, [0, 1, 2], [0.5, 0.5], 3.0], [2, [0, 2, 3], [0.25], 3.0]])
    edge = (
        "edge",
        ["int vertex1", "int vertex2", "list uchar uchar names"],
        [[0, 1, [1]], [1, 2, [1, 2, 3]]],
    )
    camera = ("camera", ["float view_px", "int viewportx"], [[1.5, 640]])
    nothing = ("material", (), [()] * 3)
    empty = ("tristrips", ["list int int vertex_indices"], ())
    mesh = load(
        tmp_path,
        "a.ply",
        ply(form, camera, face, nothing, edge, ("vertex", names, rows), empty, edge),
    )
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES


@every_format
@pytest.mark.parametrize(
    ("strips", "expected"),
    [
        ([[0, 1, 2, 3]], [[0, 1, 2], [2, 1, 3]]),
        ([[0, 1, 2, -1, 3, 2, 1]], [[0, 1, 2], [3, 2, 1]]),
        ([[0, 1, 2, 3, -1, 3, 2, 1, 0, -1]], [[0, 1, 2], [2, 1, 3], [3, 2, 1], [1, 2, 0]]),
        ([[-1, -1, 1, 2, 3, -1, 0, 1, -1], [2, 3], [], [3, 0, 1]], [[1, 2, 3], [3, 0, 1]]),
        ([[0, 1, 2, 2, 3, 3, 0, 1]], [[0, 1, 2], [0, 3, 1]]),
    ],
)
def test_strips_turn_every_second_triangle(tmp_path, form, strips, expected):
    strips = ("tristrips", ["list int int vertex_indices"], [[each] for each in strips])
    mesh = load(tmp_path, "a.ply", ply(form, vertices(), strips))
    got = [tuple(np.roll(t, -t.index(min(t)))) for t in mesh.indices.tolist()]
    assert got == [tuple(np.roll(t, -t.index(min(t)))) for t in expected]


def test_faces_and_strips_of_one_file(tmp_path):
    strips = ("tristrips", ["list int int vertex_index"], [[[0, 2, 3]]])
    face = ("face", [*INDICES, "list uchar float texcoord"], [[[0, 1, 2], [0, 0, 1, 0, 1, 1]]])
    mesh = load(tmp_path, "a.ply", ply("ascii", strips, vertices(), face))
    assert triangles(mesh).tolist() == np.array(SQUARE)[HALVES].tolist()
    assert corner_values(mesh, mesh.uvs)[0].tolist() == [[0, 0], [1, 0], [1, 1]]


UVS = [(0.25, 0.5), (1, 0), (0.75, 1), (0, 1)]
COLORS: dict[str, list[tuple[float, ...]]] = {
    "uchar": [(255, 0, 51), (0, 102, 0), (0, 0, 0), (1, 2, 3)],
    "ushort": [(65535, 0, 13107), (0, 256, 0), (0, 0, 0), (1, 2, 3)],
    "float": [(1.0, 0, 0.25), (0, 1.5, 0), (0, 0, 0), (0.5, 0.125, 2)],
    "double": [(1.0, 0, 0.25), (0, 0.5, 0), (0, 0, 0), (0.5, 0.125, 1)],
    "int": [(255, 0, 51), (0, 102, 0), (0, 0, 0), (1, 2, 3)],
}
SCALES = {"uchar": 255, "ushort": 65535, "float": 1, "double": 1, "int": 255}
NAMES = ["red green blue", "diffuse_red diffuse_green diffuse_blue", "r g b", "Red Green Blue"]


@every_format
@pytest.mark.parametrize("type_", COLORS)
@pytest.mark.parametrize("names", NAMES)
@pytest.mark.parametrize("pair", ["s t", "u v", "texture_u texture_v", "texture_s texture_t", None])
def test_colours_beside_texture_coordinates(tmp_path, form, type_, names, pair):
    colors, scale = COLORS[type_], SCALES[type_]
    rows = [[*c, *(uv if pair else ())] for c, uv in zip(colors, UVS, strict=True)]
    more = [f"{type_} {n}" for n in names.split()] + [f"float {n}" for n in (pair or "").split()]
    mesh = load(tmp_path, "a.ply", ply(form, vertices(more, rows), faces(HALVES)))
    close(mesh.colors[:, :3], np.array(colors) / scale)
    assert (mesh.colors[:, 3] == 1).all()
    if pair:
        close(mesh.uvs, UVS)
    else:
        assert mesh.uvs is None


@pytest.mark.parametrize(
    "names", ["red green blue alpha", "diffuse_red diffuse_green diffuse_blue alpha", "r g b a"]
)
def test_alpha(tmp_path, names):
    rows = [[255, 0, 0, 51], [0, 255, 0, 255], [0, 0, 255, 0], [51, 51, 51, 102]]
    data = ply(
        "binary_big_endian", vertices([f"uint8 {n}" for n in names.split()], rows), faces(HALVES)
    )
    close(load(tmp_path, "a.ply", data).colors, np.array(rows) / 255)


@every_format
def test_normals(tmp_path, form):
    rows = [[0, 3, 0], [0, 0, -1], [1, 0, 0], [0, 0, 0]]
    mesh = load(
        tmp_path,
        "a.ply",
        ply(form, vertices(["float nx", "float ny", "float nz"], rows), faces(HALVES)),
    )
    close(mesh.normals, [[0, 1, 0], [0, 0, -1], [1, 0, 0], [0, 0, 1]])


WEDGES = [[0.0, 0, 1, 0, 1, 1], [0.5, 0.5, 1, 1, 0, 0.25]]


@every_format
@pytest.mark.parametrize("extra", [(), ("int texnumber",)])
def test_texture_coordinates_of_corners_split_vertices(tmp_path, form, extra):
    more = ["uchar red", "uchar green", "uchar blue", "float nx", "float ny", "float nz"]
    rows = [[255, 0, 0, 0, 1, 0], [0, 255, 0, 1, 0, 0], [0, 0, 255, 0, 0, 1], [51, 0, 0, 0, 0, -1]]
    faces_ = [[f, uv, *([7] if extra else [])] for f, uv in zip(HALVES, WEDGES, strict=True)]
    face = ("face", [*INDICES, "list uchar float texcoord", *extra], faces_)
    mesh = load(tmp_path, "a.ply", ply(form, vertices(more, rows), face))
    close(corner_values(mesh, mesh.uvs), np.reshape(WEDGES, (2, 3, 2)))
    close(triangles(mesh), np.array(SQUARE, float)[HALVES])
    close(corner_values(mesh, mesh.colors)[..., :3], np.array(rows)[HALVES][..., :3] / 255)
    close(corner_values(mesh, mesh.normals), np.array(rows)[HALVES][..., 3:])
    # Vertex 0 is split, and vertex 2 has (1, 1) in both faces.
    assert mesh.positions.tolist() == [*SQUARE, SQUARE[0]]


def test_texture_coordinates_of_a_concave_polygon_go_with_its_corners(tmp_path):
    places = [[0, 0, 0], [2, -1, 0], [0.5, 0, 0], [2, 1, 0]]
    uvs = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    data = ("face", [*INDICES, "list uchar double texcoord"], [[[0, 1, 2, 3], uvs]])
    mesh = load(tmp_path, "a.ply", ply("ascii", ("vertex", XYZ, places), data))
    close(mesh.positions, places)
    close(mesh.uvs, np.reshape(uvs, (4, 2)))


def test_faces_without_texture_coordinates_have_those_of_their_vertices(tmp_path):
    face = (
        "face",
        [*INDICES, "list uchar float texcoord"],
        [[HALVES[0], WEDGES[0]], [HALVES[1], []]],
    )
    mesh = load(tmp_path, "a.ply", ply("ascii", vertices(["float u", "float v"], UVS), face))
    want = [np.reshape(WEDGES[0], (3, 2)), np.array(UVS)[HALVES[1]]]
    close(corner_values(mesh, mesh.uvs), want)


@every_format
def test_colours_of_faces_split_vertices(tmp_path, form):
    properties = [*INDICES, "uchar red", "uchar green", "uchar blue", "uchar alpha"]
    rows = [[HALVES[0], 255, 0, 0, 255], [HALVES[1], 0, 0, 51, 102], [[3, 1, 0], 255, 0, 0, 255]]
    mesh = load(tmp_path, "a.ply", ply(form, vertices(), ("face", properties, rows)))
    want = [[[1, 0, 0, 1]] * 3, [[0, 0, 0.2, 0.4]] * 3, [[1, 0, 0, 1]] * 3]
    close(corner_values(mesh, mesh.colors), want)
    assert len(mesh.positions) == 7


def test_colours_of_vertices_come_before_those_of_faces(tmp_path):
    color = ["uchar red", "uchar green", "uchar blue"]
    face = ("face", [*INDICES, *color], [[each, 9, 9, 9] for each in HALVES])
    mesh = load(tmp_path, "a.ply", ply("ascii", vertices(color, [[51, 0, 0]] * 4), face))
    close(mesh.colors, [[0.2, 0, 0, 1]] * 4)


def test_colours_of_corners(tmp_path):
    lists = [[1.0, 0, 0, 0, 1, 0, 0, 0, 1], [0.5, 0, 0, 0, 0, 1, 0, 0, 0]]
    face = (
        "face",
        [*INDICES, "list uchar float color"],
        [[f, c] for f, c in zip(HALVES, lists, strict=True)],
    )
    mesh = load(tmp_path, "a.ply", ply("binary_little_endian", vertices(), face))
    close(corner_values(mesh, mesh.colors)[..., :3], np.reshape(lists, (2, 3, 3)))


def test_unused_vertices_stay(tmp_path):
    mesh = load(tmp_path, "a.ply", ply("ascii", vertices(), faces([[0, 1, 2]])))
    assert mesh.positions.tolist() == SQUARE


@pytest.mark.parametrize("rest", [b"\0" * 100, b"\x1a"])
@every_format
def test_bytes_that_fill_the_last_block_are_skipped(tmp_path, form, rest):
    assert (
        load(tmp_path, "a.ply", ply(form, vertices(), faces(HALVES)) + rest).indices.tolist()
        == HALVES
    )


def test_lines_of_a_text_do_not_matter(tmp_path):
    data = ply("ascii", vertices(), faces(HALVES)).decode()
    head, body = data.split("end_header\n")
    body = body.replace("\n", "\n\n").replace("2 3 0", "\t2.0E0\n+3e0 -0")
    mesh = load(tmp_path, "a.ply", "\ufeff" + head + "end_header\n" + body.strip())
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_a_file_of_trimesh_is_read_as_trimesh_reads_it(tmp_path, rng, encoding):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=2)
    ball.visual.vertex_colors = rng.integers(0, 256, (len(ball.vertices), 4), np.uint8)
    ball.export(tmp_path / "a.ply", encoding=encoding, vertex_normal=True)
    mesh = cc.load_mesh(tmp_path / "a.ply")
    close(mesh.positions, ball.vertices, atol=1e-6)
    close(mesh.indices, ball.faces)
    close(mesh.normals, ball.vertex_normals, atol=1e-6)
    close(mesh.colors, np.asarray(ball.visual.vertex_colors) / 255, atol=1e-6)


GOOD = ply("ascii", vertices(), faces(HALVES)).decode()
BYTES = ply("binary_little_endian", vertices(), faces([[0, 1, 2, 3], [0, 1, 2]]))
BROKEN = {
    "empty": ("", "begins with ply"),
    "another kind": ("OFF\n3 1 0\n", "begins with ply.*OFF"),
    "no end": (GOOD.replace("end_header", "comment"), "expected.*line|end_header"),
    "only ply": ("ply\n", "end_header, got the end"),
    "no format": (GOOD.replace("format ascii 1.0\n", ""), "a line with the format"),
    "another format": (GOOD.replace("ascii", "zipped"), "line 2: expected ascii or binary.*zipped"),
    "another type": (GOOD.replace("float y", "real y"), "line 5: expected a type.*real"),
    "a list by floats": (
        GOOD.replace("uchar int", "float int"),
        "line 8: .*length of a list; got 'float'",
    ),
    "half a property": (
        GOOD.replace("property float y", "property float"),
        "line 5: expected property",
    ),
    "half an element": (GOOD.replace("vertex 4", "vertex"), "line 3: expected element"),
    "negative": (GOOD.replace("vertex 4", "vertex -4"), "line 3: expected element.*-4"),
    "property first": (GOOD.replace("element vertex 4\n", ""), "line 3: expected an element"),
    "another word": (GOOD.replace("element face 2", "elements face 2"), "line 7: expected element"),
    "no vertices": (GOOD.replace("vertex 4", "points 4"), "an element vertex, got none"),
    "no z": (GOOD.replace("float z", "float w"), "x, y and z of element vertex, got x, y, w"),
    "no indices": (GOOD.replace("vertex_indices", "corners"), "list vertex_indices.*got corners"),
    "two faces": (
        GOOD.replace("face 2", "face 1\nproperty list int int vertex_index\nelement face 1"),
        "one element face",
    ),
    "points": (ply("ascii", vertices()), "expected faces, got 4 vertices"),
    "too many vertices": (
        GOOD.replace("vertex 4", "vertex 999999999999"),
        "999999999999 rows of element vertex",
    ),
    "too many faces": (GOOD.replace("face 2", "face 3"), "3 rows of element face"),
    "too few faces": (GOOD.replace("face 2", "face 1"), "4 more"),
    "a number more": (GOOD.replace("2 3 0", "2 3 0 1"), "more|rows"),
    "a word in the data": (GOOD.replace("2 3 0", "2 x 0"), "line 12: expected numbers, got 'x'"),
    "not finite": (GOOD.replace("2 3 0", "2 nan 0"), "finite positions"),
    "vertex 4": (GOOD.replace("3 0 2 3", "3 0 2 4"), "vertices 0 to 3 in faces, got 4"),
    "half a vertex": (
        GOOD.replace("3 0 2 3", "3 0 2 2.5"),
        "whole numbers of vertices in faces, got 2.5",
    ),
    "negative length": (
        GOOD.replace("3 0 1 2", "-3 0 1 2"),
        "element face, row 0: .*length of a list, got -3",
    ),
    "half a length": (GOOD.replace("3 0 2 3", "3.5 0 2 3"), "element face, row 1: .*3.5"),
    "huge length": (GOOD.replace("3 0 2 3", "300000000 0 2 3"), "rows of element face"),
    "texcoord": (
        ply(
            "ascii",
            vertices(),
            ("face", [*INDICES, "list uchar int texcoord"], [[HALVES[0], [1, 2]]]),
        ),
        "face 0: expected a texcoord of 6 numbers, got 2",
    ),
    "cut off": (BYTES[:-1], "2 rows of element face"),
    "bytes, too many": (BYTES.replace(b"vertex 4", b"vertex 99999999999"), "99999999999 rows"),
    "bytes, not finite": (
        BYTES.replace(struct.pack("<f", 3), b"\0\0\x80\x7f"),
        "finite positions.*inf",
    ),
}


@pytest.mark.parametrize(("data", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_files_are_refused(tmp_path, data, message):
    with pytest.raises(cc.MeshError, match=message):
        load(tmp_path, "a.ply", data)


def everything(form):
    more = ["uchar red", "uchar green", "uchar blue", "float u", "float v", "list uchar uchar ring"]
    rows = [[1, 2, 3, *uv, [0] * i] for i, uv in enumerate(UVS)]
    face = (
        "face",
        [*INDICES, "list int float texcoord"],
        [[HALVES[0], WEDGES[0]], [[0, 1, 2, 3], []]],
    )
    strips = ("tristrips", ["list int int vertex_indices"], [[[0, 1, 2, -1, 1, 2, 3, 0]]])
    return ply(form, vertices(more, rows), face, strips)


@every_format
def test_broken_bytes_give_a_mesh_or_a_mesh_error(tmp_path, form):
    assert survives(tmp_path, "a.ply", everything(form), seed=len(form)) > 5


def test_the_time_for_a_header_of_many_lists_is_linear(tmp_path):
    count = 20_000
    lists = [f"list uchar uchar x{i}" for i in range(count)]
    data = ply("binary_little_endian", ("a", lists, [[[]] * count] * 2), vertices(), faces(HALVES))
    seconds, mesh = least_cpu_seconds(lambda: load(tmp_path, "a.ply", data), 2)
    assert mesh.indices.tolist() == HALVES
    assert seconds < 2  # 0.2 s; about 20 s where each list is looked up among all


def test_floats_that_mean_bytes_are_divided_by_255(tmp_path):
    rows = [(255.0, 0.0, 51.0, 1.0), (0.0, 2.0, 0.0, 0.5), (1.0, 0.0, 0.0, 1.0), (0.0,) * 4]
    more = [f"float {name}" for name in ("red", "green", "blue", "alpha")]
    mesh = load(tmp_path, "a.ply", ply("ascii", vertices(more, rows), faces(HALVES)))
    close(mesh.colors, np.array(rows) / (255, 255, 255, 1))


@every_format
def test_strips_of_unsigned_numbers_end_at_the_largest_one(tmp_path, form):
    strip = ("tristrips", ["list int uint vertex_indices"], [[[0, 1, 2, 0xFFFFFFFF, 2, 3, 0]]])
    mesh = load(tmp_path, "a.ply", ply(form, vertices([], [()] * 4), strip))
    close(triangles(mesh), np.array(SQUARE, float)[[[0, 1, 2], [2, 3, 0]]])


def test_normals_that_windows_writes_as_no_numbers_are_computed(tmp_path):
    rows = [(0.0, 0.0, 7.0)] * 4
    more = ["float nx", "float ny", "float nz"]
    text = ply("ascii", vertices(more, rows), faces(HALVES)).replace(
        b"0.0 0.0 7.0", b"-1.#IND00 1.#QNAN nan"
    )
    close(load(tmp_path, "a.ply", text).normals, [[0, 0, 1]] * 4)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be"])
def test_text_in_utf_16(tmp_path, encoding):
    text = ply("ascii", vertices(), faces(HALVES)).decode()
    mark = "\ufeff" if encoding == "utf-16-be" else ""
    mesh = load(tmp_path, "a.ply", (mark + text).encode(encoding))
    assert mesh.positions.tolist() == SQUARE
