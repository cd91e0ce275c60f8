"""`cubecam render`: pictures, turntables, films, what is refused, the small picture in the terminal."""

import os
import pty
import re
import select
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import cubecam as cc
from tests.helpers import need_terminals

SUZANNE = cc.sample_data("suzanne.glb")


@pytest.fixture(scope="module", autouse=True)
def photographs_are_blurred_once():
    """Each command blurs the photograph behind its model, for most of a second; here it is done once for each."""
    from cubecam.staging import shoot, stage

    done: list[tuple[cc.CubeMap, cc.CubeMap]] = []

    def once(cube):
        for before, made in done:
            if before == cube:
                return made
        done.append((cube.copy(), stage.blurred(cube)))
        return done[-1][1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(shoot, "blurred", once)
        yield


def cubecam(*arguments):
    from cubecam.cli import app

    return CliRunner().invoke(app, [str(a) for a in arguments])


def drawn(path, *arguments):
    result = cubecam("render", *arguments, "-o", path)
    assert result.exit_code == 0, result.output
    assert result.output.splitlines()[0] == str(path)
    return result.output


def covered(picture):
    """Where a transparent picture shows the model: rows and columns of its first and last pixels, and its share."""
    alpha = picture[..., 3] > 0
    rows, columns = np.nonzero(alpha.any(axis=1))[0], np.nonzero(alpha.any(axis=0))[0]
    return rows[[0, -1]], columns[[0, -1]], alpha.mean()


@pytest.mark.parametrize(("width", "height"), [(96, 96), (160, 40), (40, 160)])
@pytest.mark.parametrize("at", ["0,0", "30,15", "-120,60"])
def test_all_of_the_model_is_in_the_picture_and_fills_it(width, height, at, tmp_path):
    path = tmp_path / "x.png"
    drawn(path, SUZANNE, "--size", f"{width}x{height}", f"--at={at}", "--background", "transparent")
    picture = cc.load_image(path)
    assert picture.shape == (height, width, 4)
    rows, columns, _ = covered(picture)
    margins = [
        rows[0] / height,
        1 - (rows[1] + 1) / height,
        columns[0] / width,
        1 - (columns[1] + 1) / width,
    ]
    assert min(margins) > 0.03
    assert min(min(margins[:2]) - 0.08, min(margins[2:]) - 0.08) < 0.02


@pytest.mark.parametrize("name", ["bunny.obj", "teapot.obj", "suzanne.glb"])
@pytest.mark.parametrize("environment", [None, "studio", "interior"])
def test_a_picture_is_neither_dark_nor_pale(name, environment, tmp_path):
    path = tmp_path / "x.png"
    more = ["-e", environment] if environment else []
    drawn(path, cc.sample_data(name), *more, "--size", "160x120", "--ground")
    grey = cc.load_image(path).astype(float).mean(axis=-1)
    assert 40 < grey.mean() < 225
    assert grey.std() > 12
    assert (grey > 252).mean() < 0.08


def test_the_ground_shows_a_shadow_below_the_model_and_nothing_else(tmp_path):
    pictures = []
    for more in ([], ["--ground"]):
        drawn(tmp_path / "x.png", SUZANNE, "--size", "160x120", "-e", "sunset", *more)
        pictures.append(cc.load_image(tmp_path / "x.png").astype(int))
    change = pictures[1] - pictures[0]
    assert change.max() <= 2  # a shadow makes nothing brighter
    assert change[80:].min() < -25
    assert np.abs(change[:30]).max() <= 1


def test_the_ground_is_a_shadow_alone_in_a_transparent_picture(tmp_path):
    drawn(tmp_path / "x.png", SUZANNE, "--size", 160, "--ground", "--background", "transparent")
    picture = cc.load_image(tmp_path / "x.png")
    shadow = (picture[..., 3] > 8) & (picture[..., 3] < 200)
    assert shadow.sum() > 200
    assert picture[shadow][:, :3].mean() < 40
    assert (picture[0, :, 3] == 0).all()


@pytest.mark.parametrize("tonemap", ["neutral", "none"])
def test_a_colour_behind_the_model_is_the_colour_that_was_given(tonemap, tmp_path):
    for name in ("#336699", "#ffffff", "#ff0000"):
        looks = ["--size", "32x24", "--background", name, "--exposure", 1, "--tonemap", tonemap]
        drawn(tmp_path / "x.png", SUZANNE, *looks)
        expected = [int(name[i : i + 2], 16) for i in (1, 3, 5)]
        assert cc.load_image(tmp_path / "x.png")[0, 0, :3].tolist() == expected
    drawn(tmp_path / "x.gif", SUZANNE, *looks, "--seconds", 0.1)
    assert cc.load_image(tmp_path / "x.gif")[0, 0, :3].tolist() == expected


def test_half_a_surface_is_half_over_a_colour_and_keeps_its_colour_over_nothing(tmp_path):
    scene = cc.Scene()
    sheet = cc.BasicMaterial(color=(0.5, 0.2, 0.1, 0.25))
    scene.add(cc.Mesh.plane(2, 2), sheet, rotation=cc.axis_angle((1, 0, 0), 90))
    scene.save(tmp_path / "x.glb")
    looks = ["--size", "32x32", "--at", "0,0", "-e", "studio", "--tonemap", "none"]
    drawn(tmp_path / "none.png", tmp_path / "x.glb", *looks, "--background", "transparent")
    alpha = int(cc.load_image(tmp_path / "none.png")[16, 16, 3])
    assert alpha == pytest.approx(64, abs=1)
    light = cc.load_image(tmp_path / "none.png", srgb=True)[16, 16, :3]
    drawn(tmp_path / "over.png", tmp_path / "x.glb", *looks, "--background", "#3060ff")
    over = cc.load_image(tmp_path / "over.png", srgb=True)[16, 16, :3]
    behind = np.array([0x30, 0x60, 0xFF]) / 255
    behind = ((behind + 0.055) / 1.055) ** 2.4
    assert light[0] / light[1] == pytest.approx(2.5, rel=0.03)
    assert over == pytest.approx(0.25 * light + 0.75 * behind, abs=0.01)


def test_the_ground_of_a_film_lies_below_all_its_moments(tmp_path):
    scene = cc.Scene()
    box = scene.add(cc.Mesh.box(1), cc.StandardMaterial(color="red", metallic=0))
    scene.add(cc.SpotLight((0, 4, 4), (0, -1, -1), angle=30, intensity=100, decay=2))
    moves = [
        cc.AnimationChannel(box, "translation", [0, 1], [(0, 0, 0), (0, 2, 0)]),
        cc.AnimationChannel(box, "scale", [0, 1], [(1, 1, 1), (1, 3, 1)]),
    ]
    scene.add(cc.Animation(moves))
    scene.save(tmp_path / "x.glb")
    looks = ["-s", "96x96", "--fps", 2, "--background", "transparent"]
    drawn(tmp_path / "with.webp", tmp_path / "x.glb", *looks, "--ground")
    drawn(tmp_path / "without.webp", tmp_path / "x.glb", *looks)
    films = []
    for name in ("with.webp", "without.webp"):
        with Image.open(tmp_path / name) as film:
            films.append(np.asarray(film.convert("RGBA")).astype(int))
    # In the first picture the box is at its lowest: the ground must not darken what is seen of it.
    whole = films[1][..., 3] == 255
    assert whole.sum() > 50
    assert np.abs(films[0] - films[1])[whole].max() < 40


def test_light_files_hold_light(tmp_path):
    drawn(tmp_path / "a.exr", SUZANNE, "--size", "64x48", "--background", "#ff8000")
    drawn(
        tmp_path / "b.exr", SUZANNE, "--size", "64x48", "--background", "#ff8000", "--exposure", 1
    )
    one, two = (cc.load_image(tmp_path / name) for name in ("a.exr", "b.exr"))
    assert one.dtype == np.float32
    assert two[..., :3] == pytest.approx(2 * one[..., :3], rel=1e-3)
    assert one[0, 0, :3] == pytest.approx([1, 0.2159, 0], abs=1e-3)


def test_a_turntable_goes_round_once(tmp_path):
    path = tmp_path / "x.webp"
    drawn(
        path, SUZANNE, "--size", "48x48", "--seconds", 1, "--fps", 8, "--background", "transparent"
    )
    with Image.open(path) as film:
        assert film.n_frames == 8
        film.load()
        assert film.info["duration"] == 125
        frames = []
        for index in range(8):
            film.seek(index)
            frames.append(np.asarray(film.convert("RGBA")))
    for frame in frames:
        rows, columns, share = covered(frame)
        assert rows[0] > 0
        assert rows[1] < 47
        assert columns[0] > 0
        assert columns[1] < 47
        assert share > 0.1
    # The head is as wide from behind as from the front, and narrower from its side.
    assert all((frames[0] != frame).any() for frame in frames[1:])
    again = tmp_path / "y.webp"
    more = ["--seconds", 1, "--fps", 8, "--turns", 2, "--background", "transparent"]
    drawn(again, SUZANNE, "--size", "48x48", *more)
    with Image.open(again) as film:
        film.seek(1)
        assert (np.asarray(film.convert("RGBA")) == frames[2]).all()


def test_an_mp4_is_a_film(tmp_path):
    import imageio_ffmpeg

    path = tmp_path / "x.mp4"
    drawn(path, SUZANNE, "--size", "64x48", "--seconds", 1, "--fps", 10, "--ground")
    frames, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert (frames, seconds) == (10, pytest.approx(1))


REFUSED = {
    "missing": (["no.glb"], 1, "No such file or directory: no.glb"),
    "kind": (["a.txt"], 1, "expected a file of a scene that ends in .glb"),
    "angles": ([SUZANNE, "--at", "30"], 2, "expected two numbers as 30,15, got '30'"),
    "elevation": ([SUZANNE, "--at", "0,90"], 2, "expected an elevation from -89 to 89, got 90"),
    "size": ([SUZANNE, "--size", "12y9"], 2, "expected 1200x900 or 1200, sides from 1 to 16384, got '12y9'"),
    "large": ([SUZANNE, "--size", "99999"], 2, "sides from 1 to 16384"),
    "both": ([SUZANNE, "--at", "0,0", "--camera", "0"], 2, "expected one of --at and --camera"),
    "camera": ([SUZANNE, "--camera", "0"], 1, "--camera: expected a file with a camera, got one without"),
    "animation": ([SUZANNE, "--animation", "run"], 1, "expected a file with an animation, got one without"),
    "variant": ([SUZANNE, "--variant", "red"], 1, "--variant: expected a file with a variant, got one without"),
    "turns": ([SUZANNE, "--turns", "1"], 2, "expected with a film only"),
    "seconds": ([SUZANNE, "-o", "a.gif", "--seconds", "0"], 2, "expected a number above 0 and up to 3600, got 0"),
    "fps": ([SUZANNE, "-o", "a.gif", "--fps", "101"], 2, "expected a number above 0 and up to 100, got 101"),
    "time": ([SUZANNE, "-o", "a.gif", "--time", "1"], 2, "expected with a still picture only"),
    "alpha": ([SUZANNE, "-o", "a.jpg", "--background", "transparent"], 2, "expected a file that holds alpha"),
    "colour": ([SUZANNE, "--background", "reddish"], 1, "reddish"),
    "environment": ([SUZANNE, "-e", "no.exr"], 1, "no.exr"),
    "ending": ([SUZANNE, "-o", "a.xyz"], 1, "expected a file name that ends in"),
}  # fmt: skip


@pytest.mark.parametrize(("arguments", "code", "text"), REFUSED.values(), ids=REFUSED)
def test_what_is_refused(arguments, code, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.txt").write_text("x")
    result = cubecam("render", *arguments)
    assert result.exit_code == code, result.output
    assert text in " ".join(result.output.split())
    assert "Traceback" not in result.output
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.txt"]


def test_without_ffmpeg_both_ways_to_get_it_are_named(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    result = cubecam("render", SUZANNE, "-o", tmp_path / "x.mp4", "--device", "no such device")
    assert result.exit_code == 1
    for words in ("imageio-ffmpeg", "command ffmpeg on PATH", 'pip install "cubecam[video]"'):
        assert words in result.output
    assert "no such device" not in result.output


def test_a_closed_pipe_and_a_full_disk(tmp_path):
    command = f"'{sys.executable}' -m cubecam render '{SUZANNE}' -s 32 -o '{tmp_path}/x.png'"
    done = subprocess.run(
        ["bash", "-c", f"{command} | head -0; exit ${{PIPESTATUS[0]}}"], capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (141, "")
    full = subprocess.run(
        ["bash", "-c", f"{command} > /dev/full"], capture_output=True, text=True, check=False
    )
    assert full.returncode == 1
    assert full.stderr == "error: standard output: No space left on device\n"


def seen_in_terminal(*arguments, **environment):
    """What the command writes to a terminal of 80 columns with 24-bit colours."""
    need_terminals()
    owner, end = pty.openpty()
    variables = {**os.environ, "TERM": "xterm-256color", "COLORTERM": "truecolor", "COLUMNS": "80"}
    variables.pop("NO_COLOR", None)
    process = subprocess.Popen(
        [sys.executable, "-m", "cubecam", *map(str, arguments)],
        stdin=subprocess.DEVNULL, stdout=end, stderr=end, env={**variables, **environment},
    )  # fmt: skip
    os.close(end)
    told = b""
    while select.select([owner], [], [], 60)[0]:
        try:
            part = os.read(owner, 65536)
        except OSError:
            break
        if not part:
            break
        told += part
    assert process.wait() == 0
    os.close(owner)
    return told.decode()


def test_the_terminal_shows_a_small_picture(tmp_path):
    arguments = [
        "render",
        SUZANNE,
        "-s",
        "96x72",
        "--background",
        "#ff0000",
        "-o",
        tmp_path / "x.png",
    ]
    told = seen_in_terminal(*arguments)
    rows = [line for line in told.splitlines() if "▀" in line]
    assert 15 < len(rows) < 25
    assert len(re.findall("▀", rows[0])) > 30
    assert re.search(r"38;2;2[345]\d;\d{1,2};\d{1,2}", rows[0])  # the red background
    for quiet in (
        seen_in_terminal(*arguments, "--no-preview"),
        seen_in_terminal(*arguments, NO_COLOR="1"),
        cubecam(*arguments).output,
    ):
        assert "▀" not in quiet
