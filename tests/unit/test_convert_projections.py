"""`cubecam convert` to projections and from them, and --rotate."""

import typing

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc
from cubecam.cli.convert import Projection
from tests.compare import assert_close
from tests.reference.cube_faces import texel_directions

NAMES = typing.get_args(Projection)


def convert(*arguments):
    from cubecam.cli import app

    return CliRunner().invoke(app, ["convert", *map(str, arguments)])


@pytest.fixture
def light(tmp_path):
    """A smooth cube of floats in a file, and the cube."""
    d = texel_directions(32)
    faces = (0.5 + 0.3 * np.sin(2 * d / np.linalg.norm(d, axis=-1, keepdims=True))).astype(
        "float32"
    )
    cc.CubeMap(faces).save(tmp_path / "sky.exr", layout="row")
    return tmp_path / "sky.exr", cc.CubeMap(faces)


@pytest.mark.parametrize("name", NAMES)
def test_every_projection_is_what_the_method_gives(name, light, tmp_path):
    path, cube = light
    out = tmp_path / "out.exr"
    assert convert(path, "-l", name, "-o", out, "--size", 40).exit_code == 0
    given = {"fov": 90.0} if name == "perspective" else {}
    np.testing.assert_array_equal(cc.load_image(out), getattr(cube, f"to_{name}")(size=40, **given))


@pytest.mark.parametrize("name", NAMES)
def test_what_was_written_is_read(name, light, tmp_path):
    path, cube = light
    out, back = tmp_path / "out.exr", tmp_path / "back.exr"
    assert convert(path, "-l", name, "-o", out, "--size", 128).exit_code == 0
    done = convert(out, "--from-layout", name, "-l", "row", "--size", 32, "-o", back)
    assert done.exit_code == 0, done.output
    found = cc.load_cubemap(back).faces
    shown = found.max(-1) > 0
    assert shown[5, 12:20, 12:20].all()
    error = np.abs(found - cube.faces)[shown]
    assert np.quantile(error, 0.99) < 0.02


def test_options_reach_the_methods(light, tmp_path):
    path, cube = light
    out = tmp_path / "out.exr"

    def written(*options):
        done = convert(path, "-o", out, *options)
        assert done.exit_code == 0, done.output
        return cc.load_image(out)

    view = written("-l", "perspective", "--fov", 40, "--direction", 1, 2, 0, "--size", "30x20")
    np.testing.assert_array_equal(view, cube.to_perspective(40, (30, 20), direction=(1, 2, 0)))
    above = written("-l", "fisheye", "--model", "equisolid", "--direction", 0, 1, 0, "--size", 20)
    expected = cube.to_fisheye(20, model="equisolid", direction=(0, 1, 0), up=(0, 0, 1))
    np.testing.assert_array_equal(above, expected)
    np.testing.assert_array_equal(written("-l", "perspective"), cube.to_perspective(90, 64))
    np.testing.assert_array_equal(written("-l", "mirror_ball"), cube.to_mirror_ball())
    np.testing.assert_array_equal(
        written("-l", "cylindrical", "--fov", 100), cube.to_cylindrical(fov=100)
    )


def test_rotate_turns_every_layout(light, tmp_path):
    path, cube = light
    out = tmp_path / "out.exr"
    turn = cc.axis_angle((1, 1, 0), 25)
    for layout, expected in {
        "row": cube.rotate(turn).to_layout("row"),
        "equirect": cube.rotate(turn).to_equirect(),
        "octahedral": cube.rotate(turn).to_octahedral(),
    }.items():
        assert convert(path, "-l", layout, "--rotate", 1, 1, 0, 25, "-o", out).exit_code == 0
        assert_close(cc.load_image(out), expected, "float32_maths")


def test_screens_and_corners(light, tmp_path):
    """8 bits hold what a screen shows; corners are black in JPEG, transparent in PNG of a cube with alpha."""
    path, cube = light
    for name in ("a.jpg", "a.png"):
        assert (
            convert(path, "-l", "mirror_ball", "--size", 64, "-o", tmp_path / name).exit_code == 0
        )
        picture = cc.load_image(tmp_path / name)
        assert picture.shape == (64, 64, 3)
        assert picture[0, 0].max() < 8
        shown = cc.to_screen(cube.to_mirror_ball(64), tonemap="neutral")
        middle = picture[24:40, 24:40].astype(int) - shown[24:40, 24:40, :3]
        assert np.abs(middle).max() <= 3
    opaque = np.concatenate([cube.faces, np.ones_like(cube.faces[..., :1])], -1)
    cc.CubeMap(opaque).save(tmp_path / "alpha.exr", layout="row")
    for name, channels in (("b.png", 4), ("b.jpg", 3)):
        done = convert(tmp_path / "alpha.exr", "-l", "angular_map", "-o", tmp_path / name)
        assert done.exit_code == 0, done.output
        picture = cc.load_image(tmp_path / name)
        assert picture.shape[2] == channels
        if channels == 4:
            assert picture[0, 0, 3] == 0
            assert picture[50, 50, 3] == 255
    numbers = np.full((6, 8, 8, 3), 77, np.uint8)
    cc.CubeMap(numbers).save(tmp_path / "sky.png", layout="row")
    convert(tmp_path / "sky.png", "-l", "octahedral", "-o", tmp_path / "o.png")
    assert (cc.load_image(tmp_path / "o.png") == 77).all()


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--fov", "90"], "perspective, fisheye or cylindrical only"),
        (["-l", "octahedral", "--fov", "90"], "perspective, fisheye or cylindrical only"),
        (["--direction", "1", "0", "0"], "with a projection only"),
        (["-l", "equirect", "--size", "64x32"], "expected one number"),
        (["-l", "mirror_ball", "--size", "64x32"], "expected one number"),
        (
            ["-l", "mirror_ball", "--size", "64x"],
            "expected a whole number of at least 1, got '64x'",
        ),
        (["-l", "mirror_ball", "--size", "0x3"], "expected a whole number"),
        (["-l", "mirror_ball", "--width", "64"], "with --layout equirect only"),
        (["--rotate", "0", "1", "0"], "--rotate"),
        (["--from-layout", "cross", "--from-fov", "90"], "only"),
    ],
)
def test_options_that_do_not_fit_are_refused(options, text, light):
    result = convert(light[0], *options)
    assert result.exit_code == 2, result.output
    assert text in " ".join(result.output.split())


def test_bad_values_are_told(light, tmp_path):
    path, _ = light
    for options in (
        ["-l", "fisheye", "--fov", "400"],
        ["--rotate", "0", "0", "0", "90"],
        ["-l", "perspective", "--direction", "0", "0", "0"],
        ["--from-layout", "mirror_ball"],
    ):
        result = convert(path, *options, "-o", tmp_path / "no.exr")
        assert result.exit_code == 1, result.output
        assert "error: " in result.output
        assert "Traceback" not in result.output
    assert not (tmp_path / "no.exr").exists()
