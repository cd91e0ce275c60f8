"""OFF files by value: all words, colours of vertices and faces, comments, text and binary."""

import struct

import numpy as np
import pytest

import cubecam as cc
from tests.mesh_files import close, corner_values, load, survives, triangles

SQUARE = [[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]]
PLACES = "0 0 0\n2 0 0\n2 3 0\n0 3 0\n"
HALVES = [[0, 1, 2], [0, 2, 3]]
UPPER = "0 0 0 .1 .2\n2 0 0 .3 .4\n2 3 0 .5 .6\n0 3 0 .7 .8\n"
UVS = [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6], [0.7, 0.8]]

PLAIN = {
    "plain": f"OFF\n4 1 4\n{PLACES}4 0 1 2 3\n",
    "no word": f"4 1 4\n{PLACES}4 0 1 2 3\n",
    "counts behind the word": f"OFF 4 1 4\n{PLACES}4 0 1 2 3",
    "no edges": f"OFF\n4 1\n{PLACES}4 0 1 2 3\n",
    "wrong edges": f"OFF\n4 1 77\n{PLACES}4 0 1 2 3\n",
    "a count on each line": f"OFF\n4\n1\n4\n{PLACES}4 0 1 2 3\n",
    "lower case": f"off\n4 1 4\n{PLACES}4 0 1 2 3\n",
    "mark": f"\ufeffOFF\n4 1 4\n{PLACES}4 0 1 2 3\n",
    "comments": f"# COFF\nOFF # word\n# 1 2 3\n4 1 4 # counts\n{PLACES}# faces\n4 0 1 2 3 # 1 0 0\n# end",
    "blank lines": f"\n\nOFF\n\n4 1 4\n\n{PLACES}\n  \n4 0 1 2 3\n\n\n",
    "carriage returns": f"OFF\r4 1 4\r{PLACES}4 0 1 2 3\r".replace("\n", "\r"),
    "both": f"OFF\n4 1 4\n{PLACES}4 0 1 2 3\n".replace("\n", "\r\n"),
    "tabs": f"OFF\n4 1 4\n{PLACES}4 0 1 2 3\n".replace(" ", " \t"),
    "triangles": f"OFF\n4 2 4\n{PLACES}3 0 1 2\n3 0 2 3\n",
    "all on one line": f"OFF 4 2 4 {PLACES}3 0 1 2 3 0 2 3".replace("\n", " "),
    "numbers over lines": "OFF\n4 1 4\n0 0\n0 2 0 0\n2 3 0 0 3\n0 4 0 1\n2 3\n",
    "exponents": "OFF\n4 1 4\n0 0 0\n+2 0 0\n20e-1 3. 0\n0 .3E1 -0\n4 0 1 2 3\n",
    "index of a colour": f"OFF\n4 1 4\n{PLACES}4 0 1 2 3 17\n",
    "edges and points": f"OFF\n4 4 4\n{PLACES}2 0 1\n1 3\n4 0 1 2 3\n0\n",
    "normals without the word": "OFF\n4 1 0\n0 0 0 0 0 -1\n2 0 0 0 0 -1\n2 3 0 0 0 -1\n0 3 0 0 0 -1\n4 0 1 2 3\n",
}


@pytest.mark.parametrize("data", PLAIN.values(), ids=PLAIN)
def test_a_square(tmp_path, data):
    mesh = load(tmp_path, "a.off", data)
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES
    assert mesh.colors is None
    assert mesh.uvs is None
    close(mesh.normals, [[0, 0, 1]] * 4)


def test_a_concave_polygon_is_cut_inside(tmp_path):
    mesh = load(tmp_path, "a.off", "OFF\n4 1 0\n0 0 0\n2 -1 0\n.5 0 0\n2 1 0\n4 0 1 2 3\n")
    a, b, c = np.moveaxis(triangles(mesh), 1, 0)
    close(np.cross(b - a, c - a)[:, 2] / 2, [0.25, 0.25])


COLORS = {
    "bytes": ["255 0 0 255", "0 51 0 255", "0 0 255 0", "102 0 0 255"],
    "floats": ["1 0 0 1", "0 .2 0 1", "0 0 1.0 0", "0.4 0 0 1"],
}
WANTED = [[1, 0, 0, 1], [0, 0.2, 0, 1], [0, 0, 1, 0], [0.4, 0, 0, 1]]


@pytest.mark.parametrize("form", COLORS)
@pytest.mark.parametrize("width", [3, 4])
@pytest.mark.parametrize("word", ["OFF", "COFF", "CNOFF", "NCOFF", "STCOFF", "STCNOFF"])
def test_colours_of_vertices(tmp_path, form, width, word):
    colors = [" ".join(c.split()[:width]) for c in COLORS[form]]
    lines = [
        " ".join([p, "0 -3 0" * ("N" in word), c, uv * ("ST" in word)])
        for p, c, uv in zip(
            PLACES.splitlines(), colors, [".1 .2", ".3 .4", ".5 .6", ".7 .8"], strict=True
        )
    ]
    mesh = load(tmp_path, "a.off", "\n".join([word, "4 1 4", *lines, "4 0 1 2 3 9 9 9"]))
    assert mesh.positions.tolist() == SQUARE
    wanted = np.array(WANTED)
    wanted[:, width:] = 1
    close(mesh.colors, wanted)
    normal = np.array([0, -1, 0] if "N" in word else [0, 0, 1])
    close(mesh.normals, np.tile(normal, (4, 1)))
    if "ST" in word:
        close(mesh.uvs, UVS)
    else:
        assert mesh.uvs is None


def test_texture_coordinates_alone(tmp_path):
    mesh = load(tmp_path, "a.off", f"STOFF\n4 1 4\n{UPPER}4 0 1 2 3\n")
    close(mesh.uvs, UVS)
    assert mesh.colors is None


FACE_COLORS = {
    "bytes": ("255 0 0", "0 255 0 51", [1, 0, 0, 1], [0, 1, 0, 0.2]),
    "floats": ("1 0 0", "0 1 0 .2", [1, 0, 0, 1], [0, 1, 0, 0.2]),
    "both": ("0 0 51", ".5 .25 1", [0, 0, 0.2, 1], [0.5, 0.25, 1, 1]),
    "dark bytes": ("1 0 0", "0 0 255", [1 / 255, 0, 0, 1], [0, 0, 1, 1]),
    "one has none": ("0 0 1", "", [0, 0, 1, 1], [1, 1, 1, 1]),
    "one has an index": ("51 0 0", "3", [0.2, 0, 0, 1], [1, 1, 1, 1]),
}


@pytest.mark.parametrize(("one", "two", "first", "second"), FACE_COLORS.values(), ids=FACE_COLORS)
def test_colours_of_faces_split_the_vertices_that_they_share(tmp_path, one, two, first, second):
    mesh = load(tmp_path, "a.off", f"OFF\n4 2 4\n{PLACES}3 0 1 2 {one}\n3 0 2 3 {two}\n")
    close(triangles(mesh), np.array(SQUARE, float)[HALVES])
    close(corner_values(mesh, mesh.colors), [[first] * 3, [second] * 3])
    assert mesh.positions[:4].tolist() == SQUARE
    assert len(mesh.positions) == 6


def test_faces_of_one_colour_share_their_vertices(tmp_path):
    mesh = load(tmp_path, "a.off", f"OFF\n4 2 4\n{PLACES}3 0 1 2 51 0 0\n3 0 2 3 51 0 0\n")
    assert mesh.positions.tolist() == SQUARE
    close(mesh.colors, [[0.2, 0, 0, 1]] * 4)


def packed(*values):
    return b"".join(struct.pack(">f" if isinstance(v, float) else ">i", v) for v in values)


def test_binary_files_are_big_endian(tmp_path):
    places = packed(*np.ravel(np.array(SQUARE, float)).tolist())
    faces = packed(3, 0, 1, 2, 3, 0.5, 0.25, 0.0, 3, 0, 2, 3, 4, 0.0, 1.0, 0.0, 0.5)
    mesh = load(tmp_path, "a.off", b"OFF BINARY\n" + packed(4, 2, 0) + places + faces)
    close(triangles(mesh), np.array(SQUARE, float)[HALVES])
    want = np.array([[0.5, 0.25, 0, 1], [0, 1, 0, 0.5]])[:, None].repeat(3, axis=1)
    close(corner_values(mesh, mesh.colors), want)


def test_binary_files_have_columns_too(tmp_path):
    values = (
        np.hstack([np.array(each) for each in (SQUARE, [[0, 1, 0]] * 4, WANTED, UVS)])
        .astype(">f4")
        .tobytes()
    )
    data = (
        b"STCNOFF BINARY\r\n" + packed(4, 2, 0) + values + packed(4, 0, 1, 2, 3, 0, 2, 0, 1, 1, 7)
    )
    mesh = load(tmp_path, "a.off", data)
    assert mesh.positions.tolist() == SQUARE
    assert mesh.indices.tolist() == HALVES
    close(mesh.normals, [[0, 1, 0]] * 4)
    close(mesh.colors, WANTED)
    close(mesh.uvs, UVS)


def test_a_file_of_trimesh_is_read_as_trimesh_reads_it(tmp_path):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=2)
    ball.export(tmp_path / "a.off")
    mesh = cc.load_mesh(tmp_path / "a.off")
    close(mesh.positions, ball.vertices, atol=1e-6)
    close(mesh.indices, ball.faces)


BROKEN = {
    "empty": ("", "expected OFF and the numbers"),
    "another word": ("PLY\n3 1 0\n", "expected OFF.*PLY"),
    "four coordinates": ("4OFF\n1 1 1\n", "three coordinates, got 4OFF"),
    "any number of coordinates": ("STnOFF\n3\n1 1 1\n", "three coordinates, got STnOFF"),
    "negative counts": (f"OFF\n-4 1 4\n{PLACES}4 0 1 2 3\n", "numbers of vertices"),
    "too many vertices": (f"OFF\n400000000 1 4\n{PLACES}4 0 1 2 3\n", "400000000 vertices"),
    "too many faces": (f"OFF\n4 400000000 4\n{PLACES}4 0 1 2 3\n", "400000000 faces"),
    "one face more": (f"OFF\n4 2 4\n{PLACES}4 0 1 2 3\n", "face 1: .*end of the file"),
    "one face less": (f"OFF\n4 1 4\n{PLACES}4 0 1 2 3\n4 3 2 1 0", "after 1 faces, got 5 more"),
    "vertices only": (f"OFF\n4 0 0\n{PLACES}", "expected faces, got 4 vertices"),
    "a word": (f"OFF\n4 1 4\n{PLACES}4 0 1 two 3\n", "line 7: expected numbers, got 'two'"),
    "not there": (f"OFF\n4 1 4\n{PLACES}4 0 1 2 4\n", "vertices 0 to 3 in faces, got 4"),
    "negative": (f"OFF\n4 1 4\n{PLACES}4 0 1 2 -1\n", "vertices 0 to 3 in faces, got -1"),
    "half a vertex": (f"OFF\n4 1 4\n{PLACES}4 0 1 2 2.5\n", "whole numbers.*2.5"),
    "half a corner": (f"OFF\n4 1 4\n{PLACES}3.5 0 1 2 3\n", "face 0"),
    "cut off": (f"OFF\n4 1 4\n{PLACES}4 0 1 2\n", "face 0"),
    "not finite": ("OFF\n3 1 0\n0 0 0\ninf 0 0\n0 1 0\n3 0 1 2\n", "finite positions"),
    "binary, cut off": (b"OFF BINARY\n" + packed(4, 1, 0, 0.0), "4 vertices of 3 numbers"),
    "binary, huge": (b"OFF BINARY\n" + packed(2**31 - 1, 1, 0, 0.0), "2147483647"),
    "binary, color": (
        b"OFF BINARY\n" + packed(3, 1, 0, *[0.0] * 9, 3, 0, 1, 2, 5, 1, 1, 1, 1, 1),
        "face 0: expected a colour of 0 to 4 numbers, got 5",
    ),
}


@pytest.mark.parametrize(("data", "message"), BROKEN.values(), ids=BROKEN)
def test_broken_files_are_refused(tmp_path, data, message):
    with pytest.raises(cc.MeshError, match=message):
        load(tmp_path, "a.off", data)


FUZZED = {
    "text": f"STOFF\n4 2 4\n{UPPER}3 0 1 2 1 0 0\n4 0 1 2 3\n".encode(),
    "binary": b"OFF BINARY\n"
    + packed(4, 1, 0, *np.ravel(np.array(SQUARE, float)).tolist(), 4, 0, 1, 2, 3, 0),
}


@pytest.mark.parametrize("data", FUZZED.values(), ids=FUZZED)
def test_broken_bytes_give_a_mesh_or_a_mesh_error(tmp_path, data):
    assert survives(tmp_path, "a.off", data, seed=len(data)) > 5


def test_text_in_utf_16(tmp_path):
    mesh = load(tmp_path, "a.off", "OFF\n3 1 0\n0 0 0\n4 0 0\n0 5 0\n3 0 1 2\n".encode("utf-16"))
    assert mesh.positions.tolist() == [[0, 0, 0], [4, 0, 0], [0, 5, 0]]
