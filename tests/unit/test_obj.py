"""Wavefront OBJ files by value: text in all its forms, indices, polygons, colours, names, broken files."""

import itertools
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from cubecam.io.meshes.obj import _split, parsed, read
from tests.helpers import least_cpu_seconds, run_python

VERTICES = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"


def part(text):
    (only,) = read(Path("a.obj"), text if isinstance(text, bytes) else text.encode())
    return only


def corners(text):
    """The positions of all triangles' corners."""
    only = part(text)
    return only.positions[only.faces].tolist()


def load(tmp_path, text):
    path = tmp_path / "a.obj"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return cc.load_mesh(path)


def test_nan_of_windows_is_no_comment_in_a_file_without_comments(tmp_path):
    normals = "vn -nan(ind) 0 0\nvn -1.#IND 0 1\nvn 1.#QNAN00 0 0\n"
    mesh = load(tmp_path, "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + normals + "f 1//1 2//2 3//3\n")
    assert mesh.normals.tolist() == [[0, 0, 1]] * 3


def refused(text, match):
    with pytest.raises(cc.MeshError, match=match):
        part(text)


# --- text


FORMS: dict[str, str | bytes] = {
    "plain": TRIANGLE,
    "CRLF": TRIANGLE.replace("\n", "\r\n"),
    "CR": TRIANGLE.replace("\n", "\r"),
    "mixed line ends": "v 0 0 0\rv 1 0 0\r\nv 1 1 0\n\rf 1 2 3\r",
    "no last line end": TRIANGLE[:-1],
    "blank lines": "\n\n" + TRIANGLE.replace("\n", "\n \t \n"),
    "tabs": TRIANGLE.replace(" ", "\t"),
    "tabs after the letter": TRIANGLE.replace("v ", "v\t").replace("f ", "f\t"),
    "a tab in one line": TRIANGLE.replace("v 1 0", "v\t1 0"),
    "many blanks": TRIANGLE.replace(" ", " \t  "),
    "vertical tabs and form feeds": TRIANGLE.replace("1 2", "1\v2").replace("1 1", "1\f1"),
    "leading blanks": "  \t" + TRIANGLE.replace("\n", "\n  \t"),
    "blanks at the end": TRIANGLE.replace("\n", " \t \n"),
    "no-break spaces": TRIANGLE.replace(" ", "\xa0"),
    "byte order mark": b"\xef\xbb\xbf" + TRIANGLE.encode(),
    "two joined files": b"\xef\xbb\xbfg a\n\xef\xbb\xbf" + TRIANGLE.encode(),
    "UTF-16": TRIANGLE.encode("utf-16"),
    "UTF-16 BE with mark": b"\xfe\xff" + TRIANGLE.encode("utf-16-be"),
    "UTF-16 LE": TRIANGLE.encode("utf-16-le"),
    "UTF-16 BE": TRIANGLE.encode("utf-16-be"),
    "UTF-16 CRLF": TRIANGLE.replace("\n", "\r\n").encode("utf-16"),
    "UTF-16 cut": ("o \u4e2d\u6587\n" + TRIANGLE + "#").encode("utf-16")[:-1],
    "latin-1": "o M\xf6bel\n# gr\xfcn\n".encode("latin-1") + TRIANGLE.encode(),
    "latin-1 no-break spaces": TRIANGLE.replace(" ", "\xa0").encode("latin-1"),
    "UTF-8": ("o M\xf6bel \u4e2d\u6587\n" + TRIANGLE).encode(),
    "zero bytes at the end": TRIANGLE.encode() + bytes(9),
    "end of file mark": TRIANGLE.encode() + b"\x1a",
    "comments": "#\n# one\n" + TRIANGLE.replace("\n", " # v 9 9 9\n"),
    "comments without a blank": TRIANGLE.replace("\n", "#comment\n"),
    "comments with blanks before": "  \t# v 1 2 3\n" + TRIANGLE,
    "many signs": "####\n" + TRIANGLE.replace("\n", "## # f 1 2\n"),
    "a comment that ends in a backslash": "# C:\\models\\\n" + TRIANGLE,
    "each comment ends in a backslash": TRIANGLE.replace("\n", " # \\\n"),
    "a comment that ends in a backslash, CRLF": ("# a\\\n" + TRIANGLE).replace("\n", "\r\n"),
    "continued": "v 0 0 \\\n0\nv 1 \\\n 0 0\nv \\\n1 \\\n1 0\nf 1 2\\\n 3\n",
    "continued, CRLF": "v 0 0 \\\r\n0\r\nv 1 0 0\r\nv 1 1 0\r\nf 1 \\\r\n2 \\\r\n3",
    "continued, blanks behind": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 \\  \n2 \\\t\n3\n",
    "continued at the end": TRIANGLE[:-1] + " \\",
    "continued over a comment": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 \\\n3 # last \\\n",
    "exponents": "v 0E0 0e+5 0\nv 1e0 0 0\nv .1E1 10.e-1 -0\nf 1 2 3\n",
    "signs": "v +0 -0 0\nv +1 0 0\nv +1. +.1e+1 0\nf +1 +2 +3\n",
    "points": "v .0 0. 0\nv 1. 0 0\nv 1.0 1.000 0\nf 1 2 3\n",
    "many digits": "v 0 0 0\nv 1.00000000000000000000000001 0 0\nv 1 1 0\nf 000001 02 3\n",
    "weights": "v 0 0 0 1\nv 1 0 0 1.0\nv 1 1 0 0.5\nf 1 2 3\n",
    "forward": "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n",
    "old face word": TRIANGLE.replace("f ", "fo "),
    "relative": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n",
    "relative and not": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 -2 3\nv 5 5 5\n",
    "lines, points and curves": "vp 0.5 0.5\np 1 2\nl 1 2 3\ncstype bezier\ndeg 3\ncurv 0 1 1 2\n"
    "parm u 0 1\nend\nsurf 0 1 0 1 1 2\ncall other.obj\ncsh rm a\n" + TRIANGLE,
    "faces of two corners": TRIANGLE + "f 1 2\nf 1\nf\n",
    "unknown words": "version 3\nvx 1\nfoo 1 2\nf2 1 2 3\nvtx 1\n" + TRIANGLE,
    "unused vertices": "v 8 8 8\nv 0 0 0\nv 1 0 0\nv 9 9 9\nv 1 1 0\nf 2 3 5\nv 7 7 7\n",
}


@pytest.mark.parametrize("text", FORMS.values(), ids=FORMS)
def test_files_as_people_write_them(text, tmp_path):
    mesh = load(tmp_path, text)
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    assert mesh.indices.tolist() == [[0, 1, 2]]
    assert mesh.uvs is None
    assert mesh.colors is None
    np.testing.assert_allclose(mesh.normals, [[0, 0, 1]] * 3)


def test_numbers_are_those_of_the_file(rng):
    values = rng.normal(size=(300, 3)) * 10.0 ** rng.integers(-12, 12, (300, 3))
    styles = ("{!r}", "{:e}", "{:+.17g}", "{:.17E}")
    text = "".join(
        "v " + "  ".join(style.format(float(v)) for v in row) + "\n"
        for row, style in zip(values, itertools.cycle(styles), strict=False)
    )
    exact = np.array([[float(s) for s in line.split()[1:]] for line in text.splitlines()])
    only = part(text + "f" + " {}".format(" ".join(str(k + 1) for k in range(300))) + "\n")
    np.testing.assert_array_equal(only.positions, exact)


BAD = {
    "comma": ("v 0,5 0 0\n" + TRIANGLE, "line 1: expected a number, got '0,5'"),
    "word": (TRIANGLE + "# x\nv 1 2 \\\nthree\n", "line 6: expected a number, got 'three'"),
    "Fortran": ("\n\nv 1d0 0 0\n" + TRIANGLE, "line 3: expected a number, got '1d0'"),
    "underscore": ("v 1_0 0 0\n" + TRIANGLE, "expected a number, got '1_0'"),
    "hexadecimal": ("v 0x10 0 0\n" + TRIANGLE, "expected a number, got '0x10'"),
    "two numbers in a word": ("v 1-2 0 0\n" + TRIANGLE, "line 1: expected a number, got '1-2'"),
    "texture word": (TRIANGLE + "vt 0 u\n", "line 5: expected a number, got 'u'"),
    "normal word": (TRIANGLE + "vn 0 0 z\n", "line 5: expected a number, got 'z'"),
    "two of position": ("v 0 0 0\nv 0 0\nf 1 2 1\n", "line 2: .*three numbers.*got 2"),
    "five of position": ("v 0 0 0 1 1\nf 1 1 1\n", "line 1: .*got 5"),
    "eight of position": (TRIANGLE + "v 1 2 3 4 5 6 7 8\n", "line 5: .*got 8"),
    "no position": ("v\n" + TRIANGLE, "line 1: .*got 0"),
    "two of a normal": (TRIANGLE + "vn 1 0\n", "line 5: .*normal of three numbers, got 2"),
    "four of a normal": (TRIANGLE + "vn 1 0 0 0\n", "line 5: .*normal of three numbers, got 4"),
    "no texture": (TRIANGLE + "vt\n", "line 5: .*texture coordinates, got 0"),
    "four of texture": (TRIANGLE + "vt 1 2 3 4\n", "line 5: .*texture coordinates, got 4"),
    "zero": (VERTICES + "f 1 2 3\nf 1 0 2\n", "line 6: expected indices from 1.* got 0"),
    "zero of texture": (VERTICES + "vt 0 0\nf 1/1 2/0 3/1\n", "line 6: expected indices from 1"),
    "above": (VERTICES + "f 1 2 3\nf 1 2 5\n", "line 6: .* 1 to 4 or -4 to -1, got 5"),
    "below": (VERTICES + "f -1 -2 -5\n", "line 5: .* 1 to 4 or -4 to -1, got -5"),
    "below its line": (
        "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 1 1 0\n",
        "line 3: .*positions 1 to 3 or -2 to -1, got -3",
    ),
    "above of texture": (
        VERTICES + "vt 0 0\nf 1/1 2/2 3/1\n",
        "line 6: .*texture coordinates 1 to 1 or -1 to -1, got 2",
    ),
    "above of normals": (
        VERTICES + "vn 0 0 1\nf 1//1 2//1 3//-2\n",
        "line 6: .*normals 1 to 1 or -1 to -1, got -2",
    ),
    "no texture coordinates": (
        VERTICES + "f 1/1 2/1 3/1\n",
        "line 5: .*no indices of texture coordinates, since the file has none, got 1",
    ),
    "huge": (VERTICES + "f 1 2 99999999999999999999999\n", "line 5: .*1 to 4"),
    "hugely below": (VERTICES + "f 1 2 -99999999999999999999999\n", "line 5: .*1 to 4"),
    "fraction": (VERTICES + "f 1 2 3.0\n", "line 5: expected corners.*got '3.0'"),
    "letter": (VERTICES + "f 1 2 3\nf 1 2 a\n", "line 6: expected corners.*got 'a'"),
    "four parts": (VERTICES + "f 1 2 3/1/1/1\n", "line 5: expected corners.*got '3/1/1/1'"),
    "no first part": (VERTICES + "vt 0 0\nf 1/1 2/1 /1\n", "line 6: expected corners.*got '/1'"),
    "slashes": (VERTICES + "f 1 2 3 / //\n", "line 5: expected corners.*got '/'"),
    "parts apart": (VERTICES + "vt 0 0\nf 1 /1 2/1 3/1\n", "line 6: expected corners.*got '/1'"),
    "parts that make up for others": (
        VERTICES + "vt 0 0\nvn 0 0 1\nf 1/1/ 1/1/1-1 2/1/1\n",
        "line 7: expected corners.*got '1/1/1-1'",
    ),
    "nothing": ("", "expected triangles, got 0 vertices"),
    "vertices": (VERTICES, "expected triangles, got 4 vertices"),
    "lines and points": (VERTICES + "l 1 2 3\np 1\nf 1 2\n", "expected triangles"),
}


@pytest.mark.parametrize(("text", "match"), BAD.values(), ids=BAD)
def test_what_is_wrong_and_where(text, match):
    refused(text, match)
    if "\\" not in text:
        refused(text.replace("\n", "\r\n"), match)


def test_errors_name_the_file(tmp_path):
    with pytest.raises(cc.MeshError, match=r"a\.obj: line 5: expected indices"):
        load(tmp_path, VERTICES + "f 1 2 9\n")


@pytest.mark.parametrize("value", ["nan", "inf", "-inf", "1e999", "1.#IND", "-1.#QNAN0", "1e39"])
def test_positions_that_are_no_numbers_are_refused(value, tmp_path):
    with pytest.raises(cc.MeshError):
        load(tmp_path, f"v 0 0 {value}\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")


def test_normals_that_are_no_numbers_become_smooth(tmp_path):
    """Windows' C library prints NaN as -1.#IND00: no comment."""
    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn -1.#IND00 -1.#IND00 1.#QNAN # 1.#IND\nvn 1 0 0\nf 1//1 2//2 3//1\n"
    np.testing.assert_allclose(load(tmp_path, text).normals, [[0, 0, 1], [1, 0, 0], [0, 0, 1]])


# --- indices


def test_relative_indices_count_from_their_line():
    text = "".join(
        f"v 0 0 {z}\nv 1 0 {z}\nvt {z} 0\nvn 0 0 {z + 1}\nv 0 1 {z}\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n"
        for z in (0, 5, 9)
    )
    only = part(text)
    assert only.positions[only.faces][:, :, 2].tolist() == [[0] * 3, [5] * 3, [9] * 3]
    assert only.uvs[only.faces][:, :, 0].tolist() == [[0] * 3, [5] * 3, [9] * 3]
    assert only.normals[only.faces][:, :, 2].tolist() == [[1] * 3, [6] * 3, [10] * 3]


@pytest.mark.parametrize("name", ["bunny", "teapot"])
def test_relative_and_absolute_indices_give_the_same_mesh(name):
    data = cc.sample_data(f"{name}.obj").read_bytes().decode()
    plain = part(data)
    lines, seen = [], 0
    for line in data.splitlines():
        word, *rest = line.split() or [""]
        seen += word == "v"
        if word == "f":
            heads = [corner.partition("/")[0] for corner in rest]
            line = "f " + " ".join(str(int(head) - seen - 1) for head in heads)
        lines.append(line)
    other = part("\n".join(lines))
    np.testing.assert_array_equal(other.positions[other.faces], plain.positions[plain.faces])


ATTRIBUTES = "vt 0.25 0.5\nvt 1\nvt 0.125 0.75 9\nvn 0 0 2\nvn 0 3 0\n"


def test_the_forms_of_a_corner():
    text = VERTICES + ATTRIBUTES
    only = part(text + "f 1/2 2/1 3/3\n")
    assert only.uvs.tolist() == [[1, 0], [0.25, 0.5], [0.125, 0.75]]
    assert only.normals is None
    only = part(text + "f 1//2 2//1 3//1\n")
    assert only.normals.tolist() == [[0, 3, 0], [0, 0, 2], [0, 0, 2]]
    assert only.uvs is None
    only = part(text + "f 1/2/1 2/1/2 3/3/1\n")
    assert only.uvs.tolist() == [[1, 0], [0.25, 0.5], [0.125, 0.75]]
    assert only.normals.tolist() == [[0, 0, 2], [0, 3, 0], [0, 0, 2]]
    for odd in ("f 1/2/ 2/1/ 3/3/\n", "f 1/2/ 2/1 3/3/\n"):
        only = part(text + odd)
        assert only.uvs.tolist() == [[1, 0], [0.25, 0.5], [0.125, 0.75]]
        assert only.normals is None
    assert part(text + "f 1// 2/ 3\n").uvs is None


def test_forms_of_corners_mixed_in_a_file():
    only = part(VERTICES + ATTRIBUTES + "f 1 2/1 3//2 4/3/-2\nf 1/2 2/1 3/-1\n")
    assert only.faces.tolist() == [[0, 2, 3], [0, 3, 5], [1, 2, 4]]
    assert only.positions.tolist() == [
        [0, 0, 0], [0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 0], [0, 1, 0]
    ]  # fmt: skip
    assert only.uvs.tolist() == [[0, 0], [1, 0], [0.25, 0.5], [0, 0], [0.125, 0.75], [0.125, 0.75]]
    zero = [0, 0, 0]
    assert only.normals.tolist() == [zero, zero, zero, [0, 3, 0], zero, [0, 0, 2]]


def test_corners_without_a_normal_get_smooth_ones(tmp_path):
    mesh = load(tmp_path, VERTICES + "vn 1 0 0\nf 1//1 2 3//1\n")
    np.testing.assert_allclose(mesh.normals, [[1, 0, 0], [0, 0, 1], [1, 0, 0]])


@pytest.mark.parametrize("seed", range(8))
def test_random_files_have_the_corners_of_a_plain_reading(seed):
    """Against a reading word by word. Triples that are equal share a vertex; vertices are in the file's order."""
    rng = np.random.default_rng(seed)
    counts = {"v": 0, "vt": 0, "vn": 0}
    data: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    lines, want, triples = [], [], set()
    for step in range(300):
        word = str(rng.choice(["v", "vt", "vn"])) if step < 20 or rng.random() < 0.4 else "f"
        if word != "f":
            row = rng.integers(0, 4, 2 if word == "vt" else 3).tolist()
            data[word].append(row)
            counts[word] += 1
            lines.append(f"{word} {' '.join(map(str, row))}")
            continue
        words, face = [], []
        for _ in range(3):
            chosen, shown = [], []
            for kind in ("v", "vt", "vn"):
                if kind != "v" and (not counts[kind] or rng.random() < 0.3):
                    chosen.append(-1)
                    shown.append("")
                    continue
                index = int(rng.integers(counts[kind]))
                chosen.append(index)
                shown.append(str(index + 1 if rng.random() < 0.5 else index - counts[kind]))
            words.append("/".join(shown).rstrip("/"))
            face.append(tuple(chosen))
        lines.append("f " + " ".join(words))
        want.append(face)
        triples.update(face)
    only = part("\n".join(lines))
    assert len(only.positions) == len(triples)
    assert len(only.faces) == len(want)
    used = [triple[0] for triple in sorted(triples)]
    assert only.positions.tolist() == [data["v"][index] for index in used]
    for name, kind, place in (("positions", "v", 0), ("uvs", "vt", 1), ("normals", "vn", 2)):
        zero = [0] * len(data[kind][0])
        values = [[data[kind][c[place]] if c[place] >= 0 else zero for c in f] for f in want]
        assert getattr(only, name)[only.faces].tolist() == values


def test_vertices_of_the_samples_keep_their_order():
    data = cc.sample_data("bunny.obj").read_bytes()
    rows = [line.split()[1:4] for line in data.decode().splitlines() if line.startswith("v ")]
    only = part(data)
    np.testing.assert_array_equal(only.positions, np.array(rows, dtype=float))
    assert only.faces.shape == (3674, 3)


def test_an_equal_column_splits_no_vertex():
    text = VERTICES + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    only = part(text + "f 4/4/1 3/3/1 2/2/1\nf 2/2/1 1/1/1 4/4/1\n")
    assert only.positions.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert only.uvs.tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert only.faces.tolist() == [[3, 2, 1], [1, 0, 3]]


def test_very_many_triples_do_not_run_over():
    """Indices of some million in three columns make a product beyond 64 bits."""
    most = 4_000_000
    positions = np.array([most, 0, most, 0])
    textures = np.array([most, most - 1, most, most - 1])
    normals = np.array([0, most, most, most])
    number, chosen = _split([positions, textures, normals], most + 1)
    assert number.tolist() == [1, 0, 2, 0]
    assert chosen.tolist() == [1, 0, 2]


# --- polygons


@pytest.mark.parametrize("first", range(6))
@pytest.mark.parametrize("turned", [False, True])
def test_concave_polygons_keep_their_area_and_their_corners(first, turned):
    flat = [(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)]
    flat = flat[first:] + flat[:first]
    flat = flat[::-1] if turned else flat
    vertices = "".join(f"v {x} 7 {y}\nvt {x} {y}\n" for x, y in flat)
    only = part(vertices + "f 1/1 2/2 3/3 4/4 5/5 6/6\n")
    a, b, c = np.moveaxis(only.positions[only.faces], 1, 0)
    areas = np.cross(b - a, c - a)[:, 1] / 2 * (1 if turned else -1)
    assert areas.sum() == 3
    assert areas.min() > 0
    np.testing.assert_array_equal(only.uvs, only.positions[:, [0, 2]])


def test_a_polygon_over_continued_lines():
    text = VERTICES + "f 1 \\\n2 \\\n# not the end \\\n3 4\n"
    assert corners(VERTICES + "f 1 \\\n2 \\\n3 4\n") == corners(VERTICES + "f 1 2 3 4\n")
    refused(text, "line 8|expected triangles")


# --- colours


COLORS = {
    "floats": ("0.25 0.5 0.75", [0.25, 0.5, 0.75, 1]),
    "one": ("1 1 1", [1, 1, 1, 1]),
    "black": ("0 0 0", [0, 0, 0, 1]),
    "bytes": ("255 51 0", [1, 0.2, 0, 1]),
    "bytes with points": ("255.0 102.0 0.0", [1, 0.4, 0, 1]),
    "dark bytes": ("2 1 0", [2 / 255, 1 / 255, 0, 1]),
    "alpha": ("0.25 0.5 0.75 0.5", [0.25, 0.5, 0.75, 0.5]),
    "alpha bytes": ("255 0 51 51", [1, 0, 0.2, 0.2]),
    "rounded up": ("1.0000001 0.5 0", [1.0000001, 0.5, 0, 1]),
}


@pytest.mark.parametrize(("text", "want"), COLORS.values(), ids=COLORS)
def test_colors_of_vertices(text, want, tmp_path):
    given = f"v 0 0 0 {text}\nv 1 0 0 {text}\nv 1 1 0 {text}\nf 1 2 3\n"
    mesh = load(tmp_path, given)
    np.testing.assert_allclose(mesh.colors, [want] * 3, rtol=1e-6)
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]


def test_colors_stay_with_their_vertices_where_only_some_have_them():
    text = (
        "o plain\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\no red\nv 0 0 5 1 0 0\nv 1 0 5 0 1 0 .5\n"
        "v 0 1 5\nvt 0 0\nvt 1 1\nf 6/1 5/1 4/1\nf 4/2 2/1 3/1\n"
    )
    only = part(text)
    assert only.positions[:, 2].tolist() == [0, 0, 5, 5, 5, 5]
    white = [1, 1, 1, 1]
    assert only.colors.tolist() == [white, white, [1, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 0.5], white]


def test_weights_are_no_colors_and_move_nothing():
    only = part("v 2 0 0 2\nv 1 0 0 3\nv 1 1 0\nf 1 2 3\n")
    assert only.colors is None
    assert only.positions.tolist() == [[2, 0, 0], [1, 0, 0], [1, 1, 0]]


def test_colors_that_zbrush_writes_into_comments():
    text = VERTICES + "#MRGB ffff0000ff00ff00\n#MRGB ff0000ff\t\n#MRGB 00333333\nf 1 2 3 4\n"
    want = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [51, 51, 51]]) / 255
    np.testing.assert_array_equal(part(text).colors[:, :3], want)
    np.testing.assert_array_equal(part(text).colors[:, 3], 1)
    assert part(text.replace("00333333", "003333")).colors is None
    assert part(text.replace("00333333", "003333zz")).colors is None


# --- names


def test_names_are_kept_for_later():
    text = (
        "mtllib a.mtl my colours.mtl # two\nmtllib ../b.mtl\n"
        + VERTICES
        + "f 1 2 3\no chair\ng legs wood\nusemtl dark oak#2 # brown\ns 1\nf 1 2 3 4\nf 1 2\nf 2 3 4\n"
        "g\ns off\nusemtl \u4e2d\nl 1 2\nf 1 3 4\n \tg\tseat # x\nusemtl \u4e2d\nf 1 2 4\n"
    )
    found = parsed(text.encode())
    assert found.libraries == ["a.mtl my colours.mtl", "../b.mtl"]
    names = [(r.object, r.groups, r.material, r.smoothing, r.first, r.stop) for r in found.runs]
    assert names == [
        ("", (), "", "", 0, 1),
        ("chair", ("legs", "wood"), "dark oak#2", "1", 1, 3),
        ("chair", (), "\u4e2d", "off", 3, 4),
        ("chair", ("seat",), "\u4e2d", "off", 4, 5),
    ]
    assert found.polygons.tolist() == [0, 1, 1, 2, 3, 4]


def test_names_of_old_exporters_and_over_two_lines():
    found = parsed(b"o Stra\xdfe\ng a \\\nb\n" + TRIANGLE.encode())
    assert [(r.object, r.groups) for r in found.runs] == [("Stra\xdfe", ("a", "b"))]


def test_smoothing_groups_do_not_part_normals(tmp_path):
    roof = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nv 1 2 0\nv 0 2 0\n"
    faces = "s 1\nf 1 2 3 4\ns 2\nf 4 3 5 6\n"
    np.testing.assert_array_equal(
        load(tmp_path, roof + faces).normals,
        load(tmp_path, roof + "f 1 2 3 4\nf 4 3 5 6\n").normals,
    )


@pytest.mark.parametrize(
    "library",
    ["/dev/zero", "../../secret.mtl", "http://localhost:9/a.mtl", "file:///etc/passwd", "a.mtl"],
)
def test_no_other_file_is_opened(library, tmp_path):
    (tmp_path / "a.mtl").write_text("newmtl m\nmap_Kd /dev/zero\n")
    path = tmp_path / "a.obj"
    path.write_text(
        f"mtllib {library}\nusemtl m\ncall {library}\ncsh touch {tmp_path / 'made'}\n"
        + VERTICES
        + f"maplib {library}\nshadow_obj {library}\ntrace_obj {library}\nf 1 2 3\n"
    )
    code = f"""
        import sys, cubecam as cc
        cc.load_mesh({str(path)!r})
        EVENTS = ("open", "socket.getaddrinfo", "socket.connect", "os.system", "os.exec", "subprocess.Popen")
        seen = []
        def hook(event, arguments):
            # a number is a file that is open already
            if event in EVENTS and isinstance(arguments[0], str):
                seen.append(arguments[0])
        sys.addaudithook(hook)
        cc.load_mesh({str(path)!r})
        print(seen)
    """
    assert run_python(code).stdout.strip() == str([str(path)])
    assert not (tmp_path / "made").exists()


# --- limits


CROWDS = {
    "one face": VERTICES + "f" + " 1 2 3" * 60_000,
    "one face of triples": VERTICES + "vt 0\nvn 0 0 1\nf" + " 1/1/1 2//1 3" * 20_000,
    "comments": "#\n" * 90_000 + TRIANGLE,
    "continued": TRIANGLE + "\\\n" * 90_000,
    "backslashes": TRIANGLE + "\\  " * 90_000,
    "blank lines": "\n" * 200_000 + TRIANGLE,
    "blanks": " " * 200_000 + TRIANGLE,
    "slashes": TRIANGLE + "f 1" + "/" * 200_000,
    "groups": VERTICES + "g a\nf 1 2 3\ng b\nf 1 2 3\n" * 9_000,
    "names": TRIANGLE + "usemtl a\nmtllib b\ns\n" * 9_000,
    "painted": TRIANGLE + "#MRGB 0\n" * 20_000,
    "a bad number far down": "v 1 2 3\n" * 30_000 + "v 1 2 x\n",
    "a bad corner far down": VERTICES + "f 1 2 3\n" * 30_000 + "f 1 2 3/\n/\n",
    "hexagons that are not convex": VERTICES + "v 2 1 0\nv .5 .2 0\n" + "f 1 2 5 3 4 6\n" * 9_000,
}


@pytest.mark.parametrize("text", CROWDS.values(), ids=CROWDS)
def test_time_and_memory_are_linear_in_the_bytes(text):
    data = text.encode()

    def read():
        tracemalloc.start()
        try:
            part(data)
        except cc.MeshError:
            pass
        finally:
            _, most = tracemalloc.get_traced_memory()
            tracemalloc.stop()
        return most

    seconds, most = least_cpu_seconds(read, 2)
    assert seconds < 2
    assert most < 2**24 + 100 * len(data)


def test_broken_files_are_a_mesh_or_a_mesh_error(tmp_path):
    rng = np.random.default_rng(11)
    seeds = [
        text.encode() if isinstance(text, str) else text
        for text in (*FORMS.values(), *(text for text, _ in BAD.values()))
        if text
    ]
    path = tmp_path / "a.obj"
    words = [b"v ", b"f ", b"vn 0 0 1\n", b"vt 1\n", b"/", b"-", b"\\\n", b"#", b"1e999 ", b"9" * 25,
             b"nan ", b"\0", b"\xff\xfe", b"\n", b"\r", b"1 2 3 ", b"g a\n", b"-1/-1/-1 "]  # fmt: skip
    meshes = 0
    for turn in range(600):
        data = bytearray(seeds[turn % len(seeds)])
        for _ in range(int(rng.integers(1, 3))):
            at = int(rng.integers(len(data)))
            what = rng.integers(4)
            if what == 0:
                data[at : at + int(rng.integers(4))] = words[int(rng.integers(len(words)))]
            elif what == 1:
                data[at] = int(rng.integers(256))
            else:
                data[at] = int(rng.choice(bytearray(b"0123456789 ./-#\n")))
        path.write_bytes(data)
        try:
            mesh = cc.load_mesh(path)
        except cc.MeshError:
            continue
        meshes += 1
        assert np.isfinite(mesh.positions).all()
        assert len(mesh.indices)
    assert 50 < meshes < 500
