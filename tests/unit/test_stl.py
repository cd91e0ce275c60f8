"""STL files by value: both forms told apart by their contents, as many programs write them."""

import struct

import numpy as np
import pytest

import cubecam as cc
from tests.mesh_files import close, corner_values, load, survives, triangles

TETRAHEDRON = np.array(
    [
        [[0, 0, 0], [0, 2, 0], [3, 0, 0]],
        [[0, 0, 0], [3, 0, 0], [0, 0, 5]],
        [[0, 0, 0], [0, 0, 5], [0, 2, 0]],
        [[3, 0, 0], [0, 2, 0], [0, 0, 5]],
    ],
    float,
)


def binary(corners, header=b"made by hand", count=None, attributes=None, rest=b""):
    result = header.ljust(80, b" ") + struct.pack("<I", len(corners) if count is None else count)
    for i, corner in enumerate(corners):
        attribute = 0 if attributes is None else attributes[i]
        result += struct.pack("<12fH", 0, 0, 1, *np.ravel(corner), attribute)
    return result + rest


def text(corners, name=" part", indent="  ", word="{}"):
    lines = [f"solid{name}"]
    for corner in corners:
        lines += [f"{indent}facet normal 0 0 1", f"{indent}{indent}outer loop"]
        lines += [f"{indent * 3}vertex {x:e} {y:e} {z:e}" for x, y, z in corner]
        lines += [f"{indent}{indent}endloop", f"{indent}endfacet"]
    return "\n".join([*lines, f"endsolid{name}"]) + "\n"


BINARY = {
    "plain": binary(TETRAHEDRON),
    "solid": binary(TETRAHEDRON, b"solid exported facet normal"),
    "solid and a line": binary(TETRAHEDRON, b"solid a\nfacet normal 0 0 1\nouter loop\nvertex"),
    "zeros": binary(TETRAHEDRON, b"\0" * 80),
    "bytes after": binary(TETRAHEDRON, rest=b"\0" * 33),
    "solid, bytes after": binary(TETRAHEDRON, b"solid", rest=b"made by"),
    "more records than counted": binary(TETRAHEDRON, rest=b"\1" * 50),
    "count 0 of a stream": binary(TETRAHEDRON, count=0),
    "largest count of a stream": binary(TETRAHEDRON, count=0xFFFFFFFF),
    "other attributes": binary(TETRAHEDRON, attributes=[0, 7, 0x8001, 0]),
}
TEXT = {
    "plain": text(TETRAHEDRON),
    "no name": text(TETRAHEDRON, ""),
    "upper case": text(TETRAHEDRON).upper(),
    "tabs": text(TETRAHEDRON, indent="\t").replace(" ", "\t"),
    "no indent": text(TETRAHEDRON, indent=""),
    "carriage returns": text(TETRAHEDRON).replace("\n", "\r"),
    "both": text(TETRAHEDRON).replace("\n", "\r\n"),
    "facet in the name": text(TETRAHEDRON, " a facet with vertex 1 2 3 and endloop"),
    "endsolid in the name": text(TETRAHEDRON, " endsolid solid"),
    "words glued to the name": text(TETRAHEDRON, " vertex"),
    "UTF-16": text(TETRAHEDRON).encode("utf-16"),
    "mark": "\ufeff" + text(TETRAHEDRON),
    "blanks before": "\n \n" + text(TETRAHEDRON),
    "two solids": text(TETRAHEDRON[:1], " one") + "\n" + text(TETRAHEDRON[1:], " two vertex"),
    "without an end": text(TETRAHEDRON)[: text(TETRAHEDRON).rindex("endsolid")],
    "broken normals": text(TETRAHEDRON).replace("normal 0 0 1", "normal -nan(ind) nan 1.#QNAN"),
    "no normals": text(TETRAHEDRON).replace(" normal 0 0 1", ""),
    "blanks at ends": text(TETRAHEDRON).replace("\n", "  \n\n"),
    "more words": text(TETRAHEDRON).replace("  endfacet", "  color 0.5 0 0 purple\nendfacet"),
    "padding": text(TETRAHEDRON) + "\0" * 700,
    "padding of a short file": text(TETRAHEDRON, indent="").replace("0000e+00", "")
    + "\x1a"
    + "\0" * 20,
    "control characters in the name": text(TETRAHEDRON, " \x01\x1b part\0\0"),
    "one line": " ".join(text(TETRAHEDRON).split()),
    "a line for each facet": text(TETRAHEDRON).replace("\n   ", " ").replace("\n  end", " end"),
    "numbers on lines of their own": text(TETRAHEDRON).replace(" ", "\n").replace("\n\n", "\n"),
}


@pytest.mark.parametrize("data", [*BINARY.values(), *TEXT.values()], ids=[*BINARY, *TEXT])
def test_the_triangles_are_those_of_the_file(tmp_path, data):
    mesh = load(tmp_path, "a.stl", data)
    close(triangles(mesh), TETRAHEDRON)
    assert len(mesh.positions) == 4
    assert mesh.colors is None
    assert mesh.uvs is None


def test_normals_are_computed_over_the_merged_corners(tmp_path):
    mesh = load(tmp_path, "a.stl", binary(TETRAHEDRON))
    same = cc.Mesh(mesh.positions, mesh.indices)
    close(mesh.normals, same.normals, atol=1e-6)


@pytest.mark.parametrize("name", ["binary", "ascii"])
def test_a_file_of_trimesh_is_read_as_trimesh_reads_it(tmp_path, rng, name):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=2)
    ball.apply_transform(trimesh.transformations.random_rotation_matrix(rng.random(3)))
    kind = "stl" if name == "binary" else "stl_ascii"
    ball.export(tmp_path / "a.stl", file_type=kind)
    mesh = cc.load_mesh(tmp_path / "a.stl")
    close(triangles(mesh), ball.triangles, atol=1e-6)
    assert len(mesh.positions) == len(ball.vertices)


def test_a_triangle_without_area_stays(tmp_path):
    flat = np.concatenate([TETRAHEDRON, [[[0, 0, 0], [0, 0, 0], [3, 0, 0]]]])
    assert len(load(tmp_path, "a.stl", binary(flat)).indices) == 5


def test_minus_zero_is_merged_with_zero(tmp_path):
    corners = TETRAHEDRON.copy()
    corners[2][corners[2] == 0] = -0.0
    assert len(load(tmp_path, "a.stl", binary(corners)).positions) == 4


def test_colours_of_viscam_have_blue_in_the_lowest_bits(tmp_path):
    red, none, green, blue = 0x8000 | 31 << 10, 0, 0x8000 | 31 << 5, 0x8000 | 31
    mesh = load(tmp_path, "a.stl", binary(TETRAHEDRON, attributes=[red, none, green, blue]))
    close(triangles(mesh), TETRAHEDRON)
    want = [[1, 0, 0, 1], [1, 1, 1, 1], [0, 1, 0, 1], [0, 0, 1, 1]]
    colors = corner_values(mesh, mesh.colors)
    close(colors, np.repeat(np.array(want)[:, None], 3, axis=1))


def test_colours_of_magics_have_red_in_the_lowest_bits_and_a_default(tmp_path):
    header = b"COLOR=" + bytes([51, 102, 153, 204]) + b",MATERIAL="
    data = binary(TETRAHEDRON, header, attributes=[31, 0x8000, 0x8000, 31 << 10])
    colors = corner_values(mesh := load(tmp_path, "a.stl", data), mesh.colors)
    want = [[1, 0, 0, 0.8], [0.2, 0.4, 0.6, 0.8], [0.2, 0.4, 0.6, 0.8], [0, 0, 1, 0.8]]
    close(colors, np.repeat(np.array(want)[:, None], 3, axis=1))
    # Corners at one place of triangles of one colour stay merged.
    assert len(mesh.positions) == 3 + 4 + 3
    plain = load(tmp_path, "a.stl", binary(TETRAHEDRON, header))
    close(plain.colors, [[0.2, 0.4, 0.6, 0.8]] * 4)


BROKEN = {
    "empty": (b"", "got 0 bytes"),
    "short": (b"x" * 83, "got 83 bytes"),
    "cut off": (binary(TETRAHEDRON)[:-1], "expected 4 triangles of 50 bytes.*bytes for 3"),
    "count too large": (binary(TETRAHEDRON, count=5), "expected 5 triangles.*for 4"),
    "huge count": (binary(TETRAHEDRON, count=0xFFFFFFF0), "4294967280"),
    "broken stream": (binary(TETRAHEDRON, count=0xFFFFFFFF, rest=b"\0"), "4294967295"),
    "no triangles": (binary([]), "expected triangles, got none"),
    "solid alone": ("solid\n", "expected triangles, got none"),
    "two corners": (
        text(TETRAHEDRON).replace("      vertex 3.000000e+00 0.000000e+00 0.000000e+00\n", "", 1),
        "line 6: expected three vertices in a facet, got 2",
    ),
    "two numbers": (
        text(TETRAHEDRON).replace(" 2.000000e+00 0", " 0", 1),
        "line 5: expected vertex",
    ),
    "a comma": (text(TETRAHEDRON).replace(" 2.000000e+00", " 2,0", 1), "line 5: .*2,0"),
    "cut off text": (text(TETRAHEDRON)[:300], "line|vertices"),
    "not finite": (text(TETRAHEDRON).replace("5.000000e+00", "nan"), "finite positions"),
    "too large": (text(TETRAHEDRON).replace("5.000000e+00", "1e39"), "finite positions.*1e.39"),
}


@pytest.mark.parametrize(("data", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_files_are_refused(tmp_path, data, message):
    with pytest.raises(cc.MeshError, match=message):
        load(tmp_path, "a.stl", data)


def test_numbers_of_one_vertex_do_not_count_for_the_next(tmp_path):
    data = text(TETRAHEDRON).replace(
        "0.000000e+00 2.000000e+00 0.0", "0.000000e+00 2.000000e+00 0 0.0", 1
    )
    data = data.replace("3.000000e+00 0.000000e+00 0.000000e+00", "3.000000e+00 0.000000e+00", 1)
    with pytest.raises(cc.MeshError, match="line 5"):
        load(tmp_path, "a.stl", data)


@pytest.mark.parametrize(
    "data", [binary(TETRAHEDRON), text(TETRAHEDRON).encode()], ids=["binary", "text"]
)
def test_broken_bytes_give_a_mesh_or_a_mesh_error(tmp_path, data):
    assert survives(tmp_path, "a.stl", data, seed=len(data)) > 10
