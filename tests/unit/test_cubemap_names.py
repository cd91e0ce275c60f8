"""Names in files: which face {face} means, and the convention and centre that a file of cubecam carries."""

import re
from typing import Any

import numpy as np
import pytest

import cubecam as cc

#: What each word means, face by face in GL's order; the product's table is not read here.
WORDS = {
    "+x": "px posx pos-x pos_x xpos +x right rt",
    "-x": "nx negx neg-x neg_x xneg -x left lf",
    "+y": "py posy pos-y pos_y ypos +y top up",
    "-y": "ny negy neg-y neg_y yneg -y bottom down dn",
    "+z": "pz posz pos-z pos_z zpos +z front ft",
    "-z": "nz negz neg-z neg_z zneg -z back bk",
}
ORDER = list(WORDS)
MEANING = {word: ORDER.index(face) for face, words in WORDS.items() for word in words.split()}
SETS = [
    "nz nx ny pz py px",
    "posz posy posx negx negy negz",
    "neg-z neg-y neg-x pos-x pos-y pos-z",
    "pos_x neg_x pos_y neg_y pos_z neg_z",
    "zneg zpos yneg ypos xneg xpos",
    "-z +z -y +y -x +x",
    "front back left right top bottom",
    "back front up down right left",
    "up dn rt bk lf ft",
]
CASES = {
    "lower": str,
    "upper": str.upper,
    "first": str.capitalize,
    "last": lambda text: text[:-1] + text[-1].upper(),
    "both": lambda text: text[0].upper() + text[1:-1] + text[-1].upper(),
}


def paint(path, value):
    path.parent.mkdir(parents=True, exist_ok=True)
    cc.save_image(path, np.full((2, 2, 3), value, np.uint8))


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
@pytest.mark.parametrize("words", SETS)
def test_face_stands_for_the_usual_words(tmp_path, words, case):
    for word in words.split():
        paint(tmp_path / f"sky_{case(word)}_1k.png", 10 + 40 * MEANING[word])
    cube = cc.load_cubemap(tmp_path / "sky_{face}_1k.png")
    assert cube.faces[:, 0, 0, 0].tolist() == [10, 50, 90, 130, 170, 210]


@pytest.mark.parametrize("first", [0, 1])
def test_numbers_are_in_the_order_of_the_faces(tmp_path, first):
    for face in range(6):
        paint(tmp_path / f"{face + first}.png", 40 * face)
    assert cc.load_cubemap(tmp_path / "{face}.png").faces[:, 0, 0, 0].tolist() == [
        0, 40, 80, 120, 160, 200
    ]  # fmt: skip


def test_face_may_stand_in_the_folder_and_twice(tmp_path):
    for word in SETS[6].split():
        paint(tmp_path / word / f"{word}.png", 40 * MEANING[word])
    cube = cc.load_cubemap(tmp_path / "{face}" / "{face}.png")
    assert cube.faces[:, 0, 0, 0].tolist() == [0, 40, 80, 120, 160, 200]


def test_a_full_set_goes_before_one_with_a_missing_file(tmp_path):
    for word in ("px", "nx"):
        paint(tmp_path / f"{word}.png", 255)
    for word in SETS[8].split():
        paint(tmp_path / f"{word}.png", 40 * MEANING[word])
    cube = cc.load_cubemap(tmp_path / "{face}.png")
    assert cube.faces[:, 0, 0, 0].tolist() == [0, 40, 80, 120, 160, 200]


def test_a_missing_file_is_named_by_the_words_of_the_others(tmp_path):
    for word in ["right", "left", "top", "bottom", "back"]:
        paint(tmp_path / f"{word}.png", 0)
    with pytest.raises(FileNotFoundError, match=r"front\.png"):
        cc.load_cubemap(tmp_path / "{face}.png")


def test_the_error_without_any_file_says_what_was_tried(tmp_path):
    told = r"{face} was tried as px, posx, pos-x, pos_x, xpos, +x, right, rt, 0, 1 (for +X), also in capitals"
    with pytest.raises(FileNotFoundError, match=re.escape(told)):
        cc.load_cubemap(tmp_path / "{face}.png")


# What a file says of itself.

CUBE = cc.CubeMap(
    (np.arange(6 * 16 * 16 * 3) % 251).reshape(6, 16, 16, 3).astype(np.uint8), encoding="srgb"
)
STATING = [".exr", ".png", ".tif", ".tga"]
CONVENTIONS = ["gl", "inside", "three"]


@pytest.mark.parametrize("ending", STATING)
@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("layout", ["cross", "vertical_cross", "row", "column", "faces"])
def test_a_file_of_cubecam_is_read_in_its_own_convention(tmp_path, layout, convention, ending):
    path = tmp_path / ("{face}" + ending if layout == "faces" else "a" + ending)
    CUBE.save(path, layout=layout, convention=convention, srgb=False)
    for given in (None, convention.upper()):
        faces = cc.load_cubemap(path, convention=given).faces
        whole = faces if faces.dtype == np.uint8 else np.rint(faces * 255)  # EXR holds value/255
        assert np.array_equal(whole, CUBE.faces)


@pytest.mark.parametrize("layout", ["cross", "faces"])
@pytest.mark.parametrize(
    ("stored", "read"), [("inside", "gl"), ("gl", "three"), ("three", "inside")]
)
def test_another_convention_than_the_files_warns_and_is_obeyed(tmp_path, stored, read, layout):
    path = tmp_path / ("{face}.png" if layout == "faces" else "a.png")
    CUBE.save(path, layout=layout, convention=stored)
    told = rf"wrote this file with convention='{stored}', and it is read with convention='{read}'"
    with pytest.warns(cc.ConventionWarning, match=told) as caught:
        cube = cc.load_cubemap(path, convention=read)
    assert [warning.filename for warning in caught] == [__file__]
    if layout == "faces":
        wanted = cc.CubeMap(CUBE.to_convention(stored), convention=read)
    else:
        wanted = cc.CubeMap.from_layout(CUBE.to_layout(layout, convention=stored), convention=read)
    assert np.array_equal(cube.faces, wanted.faces)


@pytest.mark.parametrize("ending", STATING)
@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_a_panorama_of_cubecam_is_read_about_its_own_centre(tmp_path, center, ending):
    axis = "xyz".index(center[1])
    middle = np.eye(3)[axis] * (1 if center[0] == "+" else -1)
    CUBE.save(tmp_path / f"a{ending}", layout="equirect", center=center, width=128)
    read = cc.load_environment(tmp_path / f"a{ending}")
    raw = cc.load_image(tmp_path / f"a{ending}")
    assert (
        np.abs(read.sample(middle) - cc.CubeMap.from_equirect(raw).sample([0, 0, -1])).max() < 0.01
    )
    other: cc.typing.Center = "+x" if center != "+x" else "-x"
    with pytest.warns(cc.ConventionWarning, match=f"center='{re.escape(center)}', and it is read"):
        cc.load_environment(tmp_path / f"a{ending}", center=other)


@pytest.mark.parametrize("name", ["a.png", "{face}.png"])
def test_a_convention_in_capitals_is_written_as_others_are(tmp_path, name):
    capitals: Any = "INSIDE"
    CUBE.save(tmp_path / name, convention=capitals)
    assert np.array_equal(cc.load_cubemap(tmp_path / name).faces, CUBE.faces)


def test_six_files_in_another_order_warn(tmp_path):
    CUBE.save(tmp_path / "{face}.png")
    paths = [tmp_path / f"{name}.png" for name in ("nx", "px", "py", "ny", "pz", "nz")]
    with pytest.warns(cc.ConventionWarning) as caught:
        cube = cc.load_cubemap(paths)
    assert [str(warning.message).partition(": ")[2] for warning in caught] == [
        "cubecam wrote this file with face='nx', and it is read with face='px'",
        "cubecam wrote this file with face='px', and it is read with face='nx'",
    ]
    assert np.array_equal(cube.faces[0], CUBE.faces[1])


def test_six_files_of_several_conventions_need_a_name(tmp_path):
    CUBE.save(tmp_path / "{face}.png", convention="inside")
    (tmp_path / "gl").mkdir()
    CUBE.save(tmp_path / "gl" / "{face}.png")
    (tmp_path / "gl" / "py.png").replace(tmp_path / "py.png")
    with pytest.raises(ValueError, match="expected six files of one convention, got inside and gl"):
        cc.load_cubemap(tmp_path / "{face}.png")
    with pytest.warns(cc.ConventionWarning, match="'gl', and it is read with convention='inside'"):
        cc.load_cubemap(tmp_path / "{face}.png", convention="inside")


@pytest.mark.parametrize(
    "text",
    [
        "cubecam: convention=outside, layout=cross",
        "cubecam: convention=",
        "made with cubecam: convention=inside",
        "cubecam: convention=inside and more words",
        "cubecam: __class__=inside, text=gl",
        "",
    ],
)
def test_other_descriptions_say_nothing(tmp_path, text):
    import OpenImageIO as oiio

    spec = oiio.ImageSpec(8, 6, 3, "uint8")
    spec.attribute("ImageDescription", text)
    cross = cc.CubeMap(CUBE.faces[:, :2, :2]).to_layout("cross")
    file = oiio.ImageOutput.create(str(tmp_path / "a.png"))
    assert file is not None
    assert file.open(str(tmp_path / "a.png"), spec)
    file.write_image(np.ascontiguousarray(cross))
    file.close()
    read = cc.load_cubemap(tmp_path / "a.png", convention="gl")
    assert np.array_equal(read.faces, CUBE.faces[:, :2, :2])
    assert np.array_equal(cc.load_cubemap(tmp_path / "a.png").faces, CUBE.faces[:, :2, :2])


def test_other_programs_see_the_convention(tmp_path):
    from PIL import Image

    CUBE.save(tmp_path / "a.png", layout="row", convention="inside")
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.info["Description"] == "cubecam: layout=row, convention=inside"
    CUBE.save(tmp_path / "a.tif", layout="equirect", center="+x")
    with Image.open(tmp_path / "a.tif") as picture:
        assert picture.getexif()[270] == "cubecam: layout=equirect, center=+x"
    CUBE.save(tmp_path / "ny.exr", layout="openexr")
    data = (tmp_path / "ny.exr").read_bytes()
    assert b"comments\0string\0" in data
    assert b"cubecam: layout=openexr, convention=inside" in data
