"""The command `cubecam`: what it prints, writes and returns. Exit codes: 0 done, 1 failed, 2 not understood."""

import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import conventions, layouts
from tests.reference.cube_faces import convert, to_layout
from tests.reference.pattern import direction_pattern, face_pattern


def cubecam(*arguments, **environment):
    from cubecam.cli import app

    return CliRunner().invoke(app, [str(a) for a in arguments], env=environment or None)


@pytest.fixture
def cross(tmp_path):
    path = tmp_path / "sky.png"
    cc.CubeMap(face_pattern(8)).save(path, layout="cross")
    return path


@pytest.mark.parametrize(
    "start", [[sys.executable, "-m", "cubecam"], [Path(sysconfig.get_path("scripts")) / "cubecam"]]
)
def test_the_command_is_installed(start):
    done = subprocess.run([*start, "--version"], capture_output=True, text=True, check=True)
    assert cc.__version__ in done.stdout


@pytest.mark.parametrize("command", ["info", "demo", "convert", "capture", "example"])
def test_every_command_has_help(command):
    result = cubecam(command, "--help")
    assert result.exit_code == 0
    assert len(result.output) > 200
    assert command in cubecam("--help").output


def test_info_lists_versions_devices_and_what_was_chosen():
    result = cubecam("info")
    assert result.exit_code == 0, result.output
    for word in (cc.__version__, cc.devices()[0].name.split()[0], "OpenGL 4", "GLSL"):
        assert word in result.output


def test_info_without_a_device_says_why_and_fails():
    result = cubecam("info", "--device", "no such card")
    assert result.exit_code == 1
    assert "no such card" in result.output


@pytest.mark.slow
def test_help_needs_no_egl():
    done = subprocess.run(
        [sys.executable, "-m", "cubecam", "convert", "--help"],
        env={"CUBECAM_EGL_LIBRARY": "libnone.so"},
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0


@layouts
@conventions
def test_convert_layouts_and_conventions(cross, layout, convention, tmp_path):
    out = tmp_path / "out.png"
    result = cubecam("convert", cross, "-o", out, "--layout", layout, "--convention", convention)
    assert result.exit_code == 0, result.output
    assert_identical(cc.load_image(out), to_layout(face_pattern(8), layout, convention))


def test_convert_reads_a_convention(tmp_path):
    cc.save_image(tmp_path / "in.png", to_layout(face_pattern(8), "row", "three"))
    result = cubecam(
        "convert",
        tmp_path / "in.png",
        "-o",
        tmp_path / "out.png",
        "--from-convention",
        "three",
        "-l",
        "row",
    )
    assert result.exit_code == 0, result.output
    assert_identical(cc.load_image(tmp_path / "out.png"), to_layout(face_pattern(8), "row"))


def test_convert_to_six_files_and_back(cross, tmp_path):
    faces = tmp_path / "faces" / "{face}.png"
    assert cubecam("convert", cross, "-o", faces, "-c", "inside").exit_code == 0
    assert len(list((tmp_path / "faces").iterdir())) == 6
    stored = np.stack(
        [cc.load_image(str(faces).format(face=n)) for n in ("px", "nx", "py", "ny", "pz", "nz")]
    )
    assert_identical(stored, convert(face_pattern(8), "gl", "inside"))
    back = tmp_path / "back.png"
    assert cubecam("convert", faces, "--from-convention", "inside", "-o", back).exit_code == 0
    assert_identical(cc.load_image(back), cc.load_image(cross))


def test_convert_a_panorama(tmp_path):
    cc.save_image(tmp_path / "pano.exr", cc.CubeMap(direction_pattern(32)).to_equirect(center="+z"))
    result = cubecam(
        "convert",
        tmp_path / "pano.exr",
        "--from-center",
        "+z",
        "--size",
        16,
        "-o",
        tmp_path / "o.exr",
    )
    assert result.exit_code == 0, result.output
    cube = cc.load_cubemap(tmp_path / "o.exr")
    assert np.abs(cube.faces - direction_pattern(16)).max() < 0.02


def test_convert_many_files(tmp_path):
    for name in "abc":
        cc.CubeMap(face_pattern(4)).save(tmp_path / f"{name}.png", layout="row")
    out = tmp_path / "out"
    out.mkdir()
    result = cubecam(
        "convert", *(tmp_path / f"{name}.png" for name in "abc"), "-o", out, "-l", "column"
    )
    assert result.exit_code == 0, result.output
    assert len(list(out.iterdir())) == 3


def test_one_broken_file_of_many_is_told_and_the_others_are_done(tmp_path):
    cc.CubeMap(face_pattern(4)).save(tmp_path / "good.png", layout="row")
    (tmp_path / "bad.png").write_bytes(b"no picture")
    out = tmp_path / "out"
    out.mkdir()
    result = cubecam("convert", tmp_path / "bad.png", tmp_path / "good.png", "-o", out)
    assert result.exit_code == 1
    assert "bad.png" in result.output
    assert [path.name[:4] for path in out.iterdir()] == ["good"]


BAD = {
    "missing file": (["convert", "nowhere.png"], 1, "nowhere.png"),
    "unknown layout": (["convert", "nowhere.png", "--layout", "spiral"], 2, "spiral"),
    "unknown convention": (["convert", "nowhere.png", "--convention", "vulkan"], 2, "vulkan"),
    "unknown command": (["blur"], 2, "blur"),
    "no input": (["convert"], 2, "Missing argument"),
    "width without equirect": (["convert", "nowhere.png", "--width", "64"], 2, "width"),
    "missing mesh": (["capture", "nowhere.obj"], 1, "nowhere.obj"),
    "unknown output": (["capture", "nowhere.obj", "--outputs", "depth"], 2, "depth"),
    "unknown ending": (["convert", "sky.png", "-o", "out.xyz"], 1, "xyz"),
}


@pytest.mark.parametrize(("arguments", "code", "text"), BAD.values(), ids=BAD)
def test_errors_are_told_with_an_exit_code(arguments, code, text, cross, monkeypatch):
    monkeypatch.chdir(cross.parent)
    result = cubecam(*arguments)
    assert result.exit_code == code, result.output
    assert text in result.output
    assert "Traceback" not in result.output


def test_capture_a_mesh(tmp_path):
    import trimesh

    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.obj")
    out = tmp_path / "out.exr"
    result = cubecam(
        "capture", tmp_path / "box.obj", "-o", out, "--size", 16, "--mesh-position", 0, 0, -2, "--layout", "row",
        "--outputs", "id,distance",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    cube = cc.load_cubemap(out)
    ids = cc.load_image(tmp_path / "out_id.exr")
    assert cube.size == 16
    seen = np.zeros((16, 96, 1), bool)
    seen[6:10, 5 * 16 + 6 : 5 * 16 + 10] = True
    assert (ids[seen] == 1).all()
    assert not ids[:, : 5 * 16].any()
    distance = cc.load_image(tmp_path / "out_distance.exr")
    assert distance[8, 5 * 16 + 8, 0] == pytest.approx(1.5, abs=0.02)


def test_capture_to_a_panorama_with_an_environment(tmp_path):
    out = tmp_path / "pano.png"
    result = cubecam(
        "capture", cc.sample_data("teapot.obj"), "--mesh-size", 1, "--mesh-position", 0, 0, -2, "-m", "mirror",
        "-e", cc.sample_data("studio.exr"), "-o", out, "--layout", "equirect", "--size", 32,
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    assert cc.load_image(out).shape[:2] == (64, 128)


def test_demo_writes_what_it_promises(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the file names stay short, so a narrow table does not wrap them
    result = cubecam("demo", "--out", "out", "--frames", 2, "--size", 64)
    assert result.exit_code == 0, result.output
    names = {path.suffix for path in (tmp_path / "out").iterdir()}
    assert {".png", ".exr"} <= names
    for path in (tmp_path / "out").iterdir():
        assert path.name in result.output
        assert path.stat().st_size > 500
