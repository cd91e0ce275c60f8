"""The command `cubecam view`: what it reads, that it reads again, how it ends."""

import os
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc
from cubecam.cli import view_source
from cubecam.cli.view import _Watched
from cubecam.cli.view_source import stamp
from tests.documents import ROOT
from tests.viewer.pages import get, open_socket, receive, resize

SCRIPT = """
import cubecam as cc
scene = cc.Scene(background="white")
scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=%r), name="box")
"""


#: mypy: the tests know what each file holds.
read: Any = view_source.read


@pytest.fixture
def script(tmp_path):
    path = tmp_path / "scene.py"
    path.write_text(SCRIPT % "red")
    return path


def write(path, text):
    """Write a file so that its time differs, however coarse the clock of the disk is."""
    path.write_text(text)
    later = time.time_ns() + 1_000_000_000
    os.utime(path, ns=(later, later))


def test_a_model_is_lit_and_fills_the_picture(renderer):
    shown = read(str(cc.sample_data("suzanne.glb")))
    with shown.as_view("x") as view:
        picture = view.draw((120, 90))[..., :3].astype(int)
        frame = renderer.render(shown.scene, view.camera, (120, 90), outputs=("id",), format=None)
    assert 0.2 < (frame.id > 0).mean() < 0.7
    assert 50 < picture[frame.id > 0].mean() < 220
    assert picture.std() > 12
    assert shown.told == "1 node, 2,012 vertices, 3,936 triangles"


def test_a_scene_shows_its_light_and_plays_its_animation():
    shown = read(str(cc.sample_data("gallery.glb")))
    assert [type(light) for light in shown.scene.lights] == [cc.PointLight]
    assert shown.told.endswith("1 animation")
    with shown.as_view("x") as view:
        assert view.playing
        assert view.animation == "turn"
        assert 40 < view.draw((120, 90))[..., :3].mean() < 200


@pytest.mark.parametrize("name", ["panorama.png", "cross.png", "{face}.png"])
def test_a_panorama_is_looked_at_from_within_and_a_cubemap_is_a_cross(tmp_path, name):
    cube = cc.load_environment(cc.sample_data("studio.exr"), size=16)
    layout: Any = {"panorama.png": "equirect", "cross.png": "cross", "{face}.png": "faces"}[name]
    cube.save(str(tmp_path / name), layout=layout)
    with read(str(tmp_path / name)).as_view("x") as view:
        assert view.mode == ("look" if name == "panorama.png" else "cross")
        assert view.names == (name != "panorama.png")
        assert view.cube == cc.load_cubemap(str(tmp_path / name))
        assert view.text == f"six faces of {view.cube.size} x {view.cube.size} texels, uint8"
        assert view.draw((40, 30))[..., :3].std() > 5


def test_a_cubemap_that_is_written_again_is_shown_and_the_view_stays(tmp_path):
    path = tmp_path / "cross.png"
    cc.CubeMap(np.full((6, 4, 4, 3), 200, np.uint8)).save(str(path), layout="cross")
    watched = _Watched(str(path))
    view: Any = watched.view
    try:
        view.look_at((1, 0, 0))
        view.mode, view.names = "look", False
        assert view.draw((8, 6))[3, 4].tolist() == [200, 200, 200, 255]
        cc.CubeMap(np.full((6, 8, 8, 3), 90, np.uint8)).save(str(path), layout="cross")
        watched.look()
        kept = watched.view is view
        assert kept
        assert (view.mode, view.yaw, view.cube.size) == ("look", -90, 8)
        assert view.draw((8, 6))[3, 4].tolist() == [90, 90, 90, 255]
        assert "8 x 8" in view.text
    finally:
        watched.close()


def test_a_script_gives_its_scene_camera_and_view(script):
    assert read(str(script)).scene["box"].name == "box"
    write(script, SCRIPT % "red" + "camera = cc.PerspectiveCamera(position=(0, 0, 9))")
    assert read(str(script)).camera.position.tolist() == [0, 0, 9]
    write(script, SCRIPT % "red" + "view = cc.Viewer(scene, size=(11, 7))")
    with read(str(script)).as_view("x") as view:
        assert view.size == (11, 7)


def test_modules_beside_a_script_are_read_again(script):
    (script.parent / "colours_of_the_test.py").write_text("mine = 'red'")
    text = SCRIPT.replace("%r", "mine").replace(
        "import cubecam as cc", "import cubecam as cc\nfrom colours_of_the_test import mine"
    )
    write(script, text)
    shown = read(str(script))
    before = stamp(str(script), shown)
    write(script.parent / "colours_of_the_test.py", "mine = 'blue'  # another one")
    assert stamp(str(script), shown) != before
    assert read(str(script)).scene["box"].material.color.tolist() == [0, 0, 1, 1]


BROKEN = {
    "x = 1": "expected a script that makes `scene`, a cc.Scene, or `view`, a live view",
    "scene = 5": "got int",
    "\n\n1 / 0": ":3: ZeroDivisionError: division by zero",
    "x = (": ":1: '(' was never closed",
    "import sys; sys.exit(3)": ":1: SystemExit: 3",
    "import no_such_module_at_all": "ModuleNotFoundError",
}


@pytest.mark.parametrize("text", BROKEN)
def test_scripts_that_fail_name_file_and_line(script, text):
    write(script, text)
    path, arguments = list(sys.path), list(sys.argv)
    with pytest.raises(ValueError, match=str(script)) as caught:
        read(str(script))
    assert BROKEN[text] in str(caught.value)
    assert (sys.path, sys.argv) == (path, arguments)


def test_a_broken_file_keeps_the_old_scene_and_is_told(script):
    watched = _Watched(str(script))
    view: Any = watched.view
    view.camera.orbit(yaw=20)
    place = view.camera.position
    try:
        old = view.scene
        watched.look()
        assert view.scene is old
        write(script, "scene = (")
        watched.look()
        assert view.scene is old
        assert f"{script}:1:" in view.text
        write(script, SCRIPT % "blue" + "# mended")
        watched.look()
        assert view.scene is not old
        assert view.scene["box"].material.color.tolist() == [0, 0, 1, 1]
        np.testing.assert_array_equal(view.camera.position, place)
        script.unlink()
        watched.look()
        assert "No such file" in view.text
    finally:
        watched.close()


WRONG = {
    "missing": (["no.glb"], 1, "no.glb"),
    "unknown": ([__file__ + ".xyz"], 1, "No such file"),
    "kind": (["Makefile"], 1, "expected a model (.glb"),
    "two": (["a.glb", "--page", "--window"], 2, "expected one of --page, --window and --terminal"),
    "host": (["{script}", "--host", "0.0.0.0"], 1, "or a password for '0.0.0.0'"),
    "port": (["{script}", "--port", "70000"], 2, "expected at most 65535, got 70000"),
    "terminal": (["{script}", "--terminal", "--port", "1"], 2, "expected with --page only"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_wrong_calls(name, script, monkeypatch):
    from cubecam.cli import app

    monkeypatch.chdir(ROOT)
    arguments, code, text = WRONG[name]
    result = CliRunner().invoke(app, ["view", *(a.format(script=script) for a in arguments)])
    assert result.exit_code == code, result.output
    assert text in " ".join(result.output.split())


def test_a_missing_package_names_the_extra(script, monkeypatch):
    from cubecam.cli import app

    monkeypatch.setitem(sys.modules, "uvicorn", None)
    result = CliRunner().invoke(app, ["view", str(script)])
    assert result.exit_code == 1
    assert 'pip install "cubecam[viewer]"' in result.output


@pytest.mark.slow
@pytest.mark.parametrize("ending", [signal.SIGINT])
def test_the_command_shows_a_page_follows_the_file_and_ends(script, ending):
    process = subprocess.Popen(
        [sys.executable, "-W", "error", "-m", "cubecam", "view", str(script), "--no-browser"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        url = process.stdout.readline()
        assert url.startswith("http://127.0.0.1:")
        assert url.split() == [url.strip()]
        url = url.strip()
        assert get(url)[0] == 200
        with open_socket(url) as connection:
            resize(connection, 40, 30)
            receive(connection, "framebufferdata", timeout=30)
            write(script, "1 / 0")
            while "ZeroDivisionError" not in receive(connection, "text", timeout=30)["value"]:
                pass
        process.send_signal(ending)
        out, err = process.communicate(timeout=20)
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 0
    assert (out.strip(), err) == ("", "")
