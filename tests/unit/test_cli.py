"""The command `cubecam`: what it prints, writes and returns. Exit codes: 0 done, 1 failed, 2 not understood."""

import json
import os
import re
import resource
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import conventions, layouts
from tests.reference.cube_faces import convert, to_layout
from tests.reference.pattern import direction_pattern, face_pattern


def cubecam(*arguments, **environment):
    from cubecam.cli import app

    return CliRunner().invoke(app, [str(a) for a in arguments], env=environment or None)


def run(*arguments, stdout=subprocess.PIPE, timeout=120, **environment):
    """Run the command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "cubecam", *[str(a) for a in arguments]],
        env={**os.environ, **{key: str(value) for key, value in environment.items()}},
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        timeout=timeout,
        check=False,
    )


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


COMMANDS = [
    "info",
    "doctor",
    "demo",
    "render",
    "bake",
    "convert",
    "capture",
    "capture-many",
    "compare",
    "example",
    "view",
    "conventions",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(command):
    result = cubecam(command, "--help")
    assert result.exit_code == 0
    assert len(result.output) > 200
    assert command in cubecam("--help").output


#: Words that a program has for its types, which say nothing to a reader.
TYPE_NAMES = (
    r"\b(TEXT|INTEGER|FLOAT|RANGE|BOOLEAN|PATH|FILENAME|CHOICE)\b|x>=|<(str|int|float|bool)|\["
)


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_says_what_to_write_and_not_types(command):
    text = cubecam(*command.split(), "--help").output
    rows = text.partition("\n\n")[2].replace("[NAME]", "").replace("[SHELL]", "")
    assert re.search(TYPE_NAMES, rows) is None
    for line in text.splitlines():
        assert len(line) <= 100
    flags = {
        "--help",
        "--version",
        "--json",
        "--half",
        "--srgb",
        "--list",
        "--all",
        "--selftest",
    } | {
        "--live",
        "--page",
        "--window",
        "--terminal",
        "--no-browser",
        "--no-preview",
        "--ground",
        "--document",
        "--cube",
        "--no-flip",
    }
    for line in text.splitlines():
        found = re.match(r"^  (?:-\w, )?(--[\w-]+)(.*)", line)
        if found and found[1] not in flags and " if " not in line:
            assert re.match(r" (\[SHELL\]|[A-Z]+( [A-Z])*\b)", found[2]), line


def test_help_names_defaults_and_choices():
    text = " ".join(cubecam("capture", "--help").output.split())
    for words in (
        "cross, vertical_cross, row, column, equirect, openexr or faces",
        "--size TEXELS Texels along a face. Default: 256.",
        "--color R G B Colour (phong) or tint, linear, from 0 to 1. Default: 0.8 0.8 0.8.",
        "--material NAME phong, mirror or glass. Default: phong.",
        "FILE A mesh",
    ):
        assert words in text


NUMBERS = {
    "size": (["convert", "a.png", "--size", "0"], "expected a whole number of at least 1, got '0'"),
    "width": (
        ["convert", "a.png", "--width", "x"],
        "expected a whole number of at least 2, got 'x'",
    ),
    "near": (["capture", "a.obj", "--near", "nan"], "expected a number, got 'nan'"),
    "place": (["capture", "a.obj", "--position", "1", "b", "2"], "expected a number, got 'b'"),
}


@pytest.mark.parametrize(("arguments", "text"), NUMBERS.values(), ids=NUMBERS)
def test_numbers_that_are_none(arguments, text):
    result = cubecam(*arguments)
    assert result.exit_code == 2
    assert text in result.output


def test_info_lists_versions_devices_and_what_was_chosen():
    result = cubecam("info")
    assert result.exit_code == 0, result.output
    for word in (cc.__version__, cc.devices()[0].name.split()[0], "OpenGL 4", "GLSL"):
        assert word in result.output


def test_info_without_a_device_says_why_and_fails():
    result = cubecam("info", "--device", "no such card")
    assert result.exit_code == 1
    assert "no such card" in result.output


def test_info_as_json():
    result = cubecam("info", "--json")
    assert result.exit_code == 0, result.output
    report = json.loads(result.stdout)
    first = cc.devices()[0]
    assert report["cubecam"] == cc.__version__
    assert report["devices"][0]["name"] == first.name
    assert report["devices"][0]["software"] is first.software
    assert report["chosen"]["version"].startswith("4.")
    assert report["chosen"]["device"] in [device["index"] for device in report["devices"]]
    assert report["limits"]["max_samples"] >= 4
    assert report["error"] is None


def test_info_as_json_without_a_device():
    """A device that does not exist, and no EGL at all: standard output has one JSON object, which says why."""
    result = cubecam("info", "--json", "--device", "no such card")
    assert result.exit_code == 1
    report = json.loads(result.stdout)
    assert "no such card" in report["error"]
    assert report["devices"]
    assert report["chosen"] is None
    assert report["limits"] is None
    done = run("info", "--json", CUBECAM_EGL_LIBRARY="libnone.so")
    assert done.returncode == 1
    assert "libnone.so" in json.loads(done.stdout)["error"]
    assert done.stderr == ""


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


def test_convert_a_part(tmp_path):
    from PIL import Image as Picture

    crosses = [to_layout(pattern, "cross") for pattern in (face_pattern(8), face_pattern(8)[::-1])]
    first, second = [Picture.fromarray(cross) for cross in crosses]
    first.save(tmp_path / "two.tif", save_all=True, append_images=[second])
    out = tmp_path / "out.png"
    assert cubecam("convert", tmp_path / "two.tif", "--part", 1, "-o", out).exit_code == 0
    assert_identical(cc.load_image(out), crosses[1])
    result = cubecam("convert", tmp_path / "two.tif", "--part", "beauty", "-o", out)
    assert result.exit_code == 1
    assert "part: expected one of 0, 1; got 'beauty'" in result.output


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


@pytest.fixture
def lamps(tmp_path):
    """A cubemap of floats with numbers up to 4."""
    cube = cc.CubeMap((direction_pattern(8)[..., :3] + 1).astype(np.float32) * 2)
    cube.save(tmp_path / "lamps.exr", layout="row")
    return tmp_path / "lamps.exr", cube


@pytest.mark.parametrize(
    ("options", "look"),
    [
        ([], {}),
        (["--exposure", "-1.5"], {"exposure": -1.5}),
        (["--tonemap", "reinhard", "--exposure", "1"], {"tonemap": "reinhard", "exposure": 1}),
        (["--tonemap", "none", "--exposure", "-3"], {"tonemap": None, "exposure": -3}),
    ],
)
def test_convert_shows_light_as_save_does(lamps, options, look, tmp_path):
    path, cube = lamps
    result = cubecam("convert", path, "-o", tmp_path / "out.png", "-l", "row", *options)
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    want = cc.to_screen(cube.to_layout("row"), **look)
    assert_identical(cc.load_image(tmp_path / "out.png"), want)


def test_convert_keeps_light_in_float_files(lamps, tmp_path):
    path, cube = lamps
    result = cubecam("convert", path, "-o", tmp_path / "out.exr", "-l", "row", "--exposure", 1)
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    assert_identical(cc.load_image(tmp_path / "out.exr"), cube.to_layout("row") * 2)


def test_convert_warns_once_when_it_clips(lamps, tmp_path):
    path, _ = lamps
    for output in (tmp_path / "out.png", tmp_path / "{face}.png"):
        result = cubecam("convert", path, "-o", output, "--tonemap", "none")
        assert result.exit_code == 0, result.output
        assert re.fullmatch(
            rf"warning: {re.escape(str(output))}: \d+ of \d+ numbers are above 1 and are clipped, the largest is "
            r"[34][.\d]*; --tonemap neutral keeps highlights, a lower --exposure makes the picture darker\n",
            result.stderr,
        ), result.stderr
    done = run("convert", path, "-o", tmp_path / "out.png", "--tonemap", "none")
    assert done.returncode == 0
    assert done.stderr.count("\n") == 1


def test_srgb_does_not_change_how_light_looks(tmp_path):
    dim = np.linspace(0, 0.95, 6 * 8 * 8 * 3, dtype=np.float32).reshape(8, 48, 3)
    cc.save_image(tmp_path / "dim.exr", dim)
    for name, options in (("a.png", []), ("b.png", ["--srgb"])):
        result = cubecam(
            "convert", tmp_path / "dim.exr", "-l", "row", "-o", tmp_path / name, *options
        )
        assert result.exit_code == 0, result.output
        assert_identical(cc.load_image(tmp_path / name), cc.to_screen(dim))


def test_srgb_decodes_and_gives_the_same_numbers_back(cross, tmp_path):
    """What a screen shows has no highlights: no curve changes it unless one is given."""
    same, curved, light = tmp_path / "same.png", tmp_path / "curved.png", tmp_path / "light.exr"
    assert cubecam("convert", cross, "--srgb", "-o", same).exit_code == 0
    assert_identical(cc.load_image(same), cc.load_image(cross))
    assert cubecam("convert", cross, "--srgb", "--tonemap", "neutral", "-o", curved).exit_code == 0
    assert not np.array_equal(cc.load_image(curved), cc.load_image(cross))
    assert cubecam("convert", cross, "--srgb", "-o", light).exit_code == 0
    assert_identical(cc.to_screen(cc.load_image(light), tonemap=None), cc.load_image(cross))


def test_capture_writes_what_save_writes(tmp_path):
    given = ["capture", cc.sample_data("bunny.obj"), "-s", 32]
    assert cubecam(*given, "-o", tmp_path / "a.exr").exit_code == 0
    linear = cc.load_image(tmp_path / "a.exr")
    looks: list[tuple[list[str], dict[str, Any]]] = [
        ([], {}),
        (["--exposure", "1", "--tonemap", "aces"], {"exposure": 1, "tonemap": "aces"}),
    ]
    for options, look in looks:
        result = cubecam(*given, *options, "-o", tmp_path / "a.png")
        assert result.exit_code == 0, result.output
        assert_identical(cc.load_image(tmp_path / "a.png"), cc.to_screen(linear, **look))
    result = cubecam(*given, "--exposure", 3, "--tonemap", "none", "-o", tmp_path / "a.png")
    assert "warning: " in result.stderr
    assert result.stderr.count("\n") == 1


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


#: Commands that print, and what they draw or read is small.
PRINTING = {
    "help": ["--help"],
    "help of a command": ["capture", "--help"],
    "version": ["--version"],
    "completion": ["--show-completion", "fish"],
    "info": ["info"],
    "json": ["info", "--json"],
    "doctor": ["doctor"],
    "conventions": ["conventions"],
    "convert": ["convert", "sky.png", "-o", "out.png"],
    "capture": ["capture", "box.obj", "-o", "out.exr", "--size", "8"],
    "list": ["example", "--list"],
    "example": ["example", "P15", "--frames", "1", "--size", "8", "-o", "out.png"],
    "demo": ["demo", "--out", "out", "--frames", "1", "--size", "16"],
}
DRAWING = ("capture", "example", "demo", "doctor")
printing = pytest.mark.parametrize(
    "arguments",
    [
        pytest.param(given, id=name, marks=[pytest.mark.slow] * (name in DRAWING))
        for name, given in PRINTING.items()
    ],
)


@pytest.fixture
def folder(cross, monkeypatch):
    import trimesh

    trimesh.creation.box((1, 1, 1)).export(cross.parent / "box.obj")
    monkeypatch.chdir(cross.parent)
    return cross.parent


@printing
def test_a_reader_that_has_ended_ends_the_command_quietly(arguments, folder):
    """As `cubecam info | head -0`: the exit code is that of a program that SIGPIPE ended."""
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = run(*arguments, stdout=writing)
    finally:
        os.close(writing)
    assert done.returncode == 141
    assert done.stderr == ""


@printing
def test_a_full_disk_is_told_in_one_line(arguments, folder):
    with Path("/dev/full").open("w") as full:
        done = run(*arguments, stdout=full)
    assert done.returncode == 1
    assert done.stderr == "error: standard output: No space left on device\n"


def test_head_of_a_long_list(folder):
    """The command itself writes more than the reader takes."""
    done = subprocess.run(
        ["bash", "-c", f"{sys.executable} -m cubecam info | head -1; echo ${{PIPESTATUS[0]}}"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.startswith("cubecam ")
    assert done.stdout.splitlines()[-1] in ("0", "141")  # 0 if all was written before head ended
    assert done.stderr == ""


def test_messages_that_nobody_can_read_leave_the_exit_code():
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "cubecam", "convert", "nowhere.png"], stderr=full, check=False
        )
        assert done.returncode == 1
        done = subprocess.run([sys.executable, "-m", "cubecam", "blur"], stderr=full, check=False)
        assert done.returncode == 2


LIGHT = {"help": ["--help"], "version": ["--version"], "info": ["info"], "json": ["info", "--json"]}


@pytest.mark.slow
@pytest.mark.parametrize("arguments", LIGHT.values(), ids=LIGHT)
def test_what_is_asked_first_is_quick(arguments):
    """Less than 200 ms of CPU time, of all threads: numpy and rich are not loaded."""
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "cubecam", *arguments],
        capture_output=True,
        text=True,
        check=True,
    )
    for module in ("numpy", "rich", "OpenImageIO", "trimesh", "PIL"):
        assert not re.search(rf"\| +{module}(\.|$)", done.stderr, re.MULTILINE), module

    def seconds():
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        assert run(*arguments).returncode == 0
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    assert min(seconds() for _ in range(4)) < 0.2


def complete(shell, words):
    """What the command answers to a shell that completes the last of the words."""
    answer = run(
        _CUBECAM_COMPLETE=f"{shell}_complete",
        COMP_WORDS=" ".join(words) if shell != "fish" else " ".join(words[:-1]),
        COMP_CWORD=words[-1] if shell == "fish" else len(words) - 1,
    )
    assert answer.returncode == 0, answer.stderr
    assert answer.stderr == ""
    lines = answer.stdout.splitlines()
    if shell == "zsh":  # three lines for each: kind, word, help
        return list(zip(lines[0::3], lines[1::3], strict=False))
    return [tuple(line.partition("\t")[0].split(",", 1)) for line in lines]


shells = pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
COMPLETED = {
    "commands": (
        ["cubecam", "c"],
        {
            ("plain", word)
            for word in ("convert", "capture", "capture-many", "compare", "conventions")
        },
    ),
    "options": (["cubecam", "info", "--j"], {("plain", "--json")}),
    "choices": (
        ["cubecam", "convert", "a.png", "--layout", "c"],
        {("plain", "cross"), ("plain", "column"), ("plain", "cylindrical")},
    ),
    "programs": (["cubecam", "example", "sky"], {("plain", "skybox")}),
    "devices": (["cubecam", "info", "--device", "s"], {("plain", "software")}),
    "files": (["cubecam", "convert", "a"], {("file", "a")}),
    "output": (["cubecam", "capture", "a.obj", "-o", "b"], {("file", "b")}),
}


@shells
@pytest.mark.parametrize(("words", "want"), COMPLETED.values(), ids=COMPLETED)
def test_completion(shell, words, want):
    assert set(complete(shell, words)) == want


def test_bash_itself_completes(tmp_path):
    command = tmp_path / "cubecam"
    command.write_text(f'#!/bin/sh\nexec {sys.executable} -m cubecam "$@"\n')
    command.chmod(0o755)
    script = """
        source <(cubecam --show-completion bash)
        COMP_WORDS=(cubecam ex) COMP_CWORD=1
        _cubecam_completion cubecam
        echo "${COMPREPLY[@]}"
        complete -p cubecam
        """
    done = subprocess.run(
        ["bash", "--norc", "-c", script],
        env={**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.splitlines()[0] == "example", done
    assert "-F _cubecam_completion cubecam" in done.stdout


@shells
def test_completion_is_installed_once(shell, tmp_path):
    own = {"HOME": tmp_path, "SHELL": f"/bin/{shell}", "XDG_DATA_HOME": "", "XDG_CONFIG_HOME": ""}
    start = tmp_path / f".{shell}rc"
    if shell != "fish":
        start.write_text("alias ll='ls -l'\n")
    for _ in range(2):
        done = run("--install-completion", **own)
        assert done.returncode == 0, done.stderr
    script = Path(done.stdout.splitlines()[0])
    assert script.is_relative_to(tmp_path)
    assert script.read_text().rstrip() == run("--show-completion", shell).stdout.rstrip()
    if shell != "fish":
        assert start.read_text() == f"alias ll='ls -l'\nsource '{script}'\n"


def test_completion_for_another_shell_is_refused(tmp_path):
    result = cubecam("--show-completion", SHELL="/bin/dash")
    assert result.exit_code == 2
    assert "expected bash, zsh, fish as the shell, got 'dash'" in result.output
    assert not list(tmp_path.iterdir())


def suzanne_like(path):
    """A GLB whose mesh is far from the origin, large, and placed by a node's matrix."""
    import trimesh

    scene = trimesh.Scene()
    matrix = trimesh.transformations.translation_matrix((300, -20, 50))
    scene.add_geometry(trimesh.creation.icosphere(subdivisions=2, radius=40), transform=matrix)
    scene.add_geometry(trimesh.creation.box((120, 30, 10)), transform=matrix)
    scene.export(path)
    return path


@pytest.mark.parametrize("kind", ["bunny.obj", "teapot.obj", "head.glb"])
@pytest.mark.parametrize("material", ["phong", "mirror", "glass"])
def test_capture_without_options_shows_the_mesh(kind, material, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = suzanne_like(tmp_path / kind) if kind.endswith("glb") else cc.sample_data(kind)
    options = [] if material == "phong" else ["-m", material]
    result = cubecam("capture", path, *options, "--outputs", "id")
    assert result.exit_code == 0, result.output
    ids = cc.load_image("capture_id.exr")[..., 0]
    seen = ids > 0
    color = cc.load_image("capture.exr")[..., :3]
    assert seen.sum() >= 0.02 * 6 * 256 * 256
    # The mesh is on the face -Z alone, the last cell of the cross, and touches none of its sides.
    rows, columns = np.nonzero(seen)
    assert rows.min() > 256
    assert rows.max() < 511
    assert columns.min() > 768
    assert columns.max() < 1023
    if material == "phong":
        assert color[seen].min() > 0.1
        assert color.max() <= 1.0
        assert np.std(color[seen]) > 0.05  # light and shade
        cells = color[256:512]
        assert (cells[~seen[256:512]] == np.float32(0.18)).all()
    else:
        assert np.median(color[seen]) > 0.005
        assert np.std(color[256:512]) > 0.01  # a photograph surrounds the mesh
    told = result.output.splitlines()[-1]
    assert re.match(
        r"by default: scaled to 1; the mesh is at 0 0 -[\d.]+, the capture at 0 0 0; ", told
    )


def capture_of_a_box(tmp_path, *options):
    import trimesh

    box = tmp_path / "box.obj"
    trimesh.creation.box((1, 1, 1)).apply_translation((0, 0, -5)).export(box)
    out = tmp_path / "out.exr"
    result = cubecam(
        "capture", box, *options, "-o", out, "-s", 16, "-l", "row", "--outputs", "distance"
    )
    assert result.exit_code == 0, result.output
    distance = cc.load_image(tmp_path / "out_distance.exr")[8, 5 * 16 + 8, 0]
    return cc.load_image(out), float(distance), result.output


def test_options_of_capture_mean_what_they_say(tmp_path):
    """A place that is given keeps the mesh as it is in the file; a light or an environment keeps the old light."""
    lit = ["--light", 5, 5, 5]
    picture, distance, told = capture_of_a_box(tmp_path, "--position", 0, 0, 0, *lit)
    assert distance == pytest.approx(4.5, abs=0.02)
    assert "by default" not in told
    assert picture[0, 0].tolist() == [0, 0, 0, 0]  # no background
    _, distance, told = capture_of_a_box(tmp_path, "--position", 0, 0, 2, *lit)
    assert distance == pytest.approx(6.5, abs=0.03)
    _, distance, told = capture_of_a_box(tmp_path, "--mesh-position", 0, 0, 1)
    assert distance == pytest.approx(3.5, abs=0.02)
    assert told.splitlines()[-1] == (
        "by default: on a grey background; lit by two lights beside the capture"
    )
    _, distance, told = capture_of_a_box(tmp_path, "--mesh-size", 2, *lit)
    # The front of the box, 1 from its middle to a side, reaches over 0.65 of the face -Z.
    assert distance == pytest.approx(1 / 0.65, abs=0.02)
    assert told.splitlines()[-1] == "by default: the mesh is at 0 0 -2.54, the capture at 0 0 0"


def test_a_capture_within_a_room_is_lit(tmp_path):
    import trimesh

    room = trimesh.creation.box((8, 3, 8))
    room.invert()
    room.export(tmp_path / "room.obj")
    out = tmp_path / "out.exr"
    result = cubecam(
        "capture", tmp_path / "room.obj", "-p", 0, 0, 0, "-s", 16, "-o", out, "-l", "row"
    )
    assert result.exit_code == 0, result.output
    color = cc.load_image(out)[..., :3]
    assert color.min() > 0.2
    assert color.max() <= 1


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


@pytest.mark.parametrize("layout", ["equirect", "openexr", "cross", "faces"])
def test_capture_writes_outputs_in_every_layout(layout, tmp_path):
    """Each number is one that the row of whole faces has, too."""
    options = ["capture", cc.sample_data("bunny.obj"), "-s", 16, "--outputs", "id,distance,normal"]
    out = tmp_path / ("out_{face}.png" if layout == "faces" else "out.exr")
    more = ["--width", 48, "--center", "+z"] if layout == "equirect" else []
    for arguments in (["-o", tmp_path / "row.exr", "-l", "row"], ["-o", out, "-l", layout, *more]):
        result = cubecam(*options, *arguments)
        assert result.exit_code == 0, result.output
    for name in ("id", "distance", "normal"):
        path = str(out.with_name(f"{out.stem}_{name}.exr"))
        assert path in result.output
        row = cc.load_image(tmp_path / f"row_{name}.exr")
        got = cc.load_image(path.replace("{face}", "nz"))
        assert got.dtype == row.dtype
        held = set(row.ravel().tolist()) | ({0} if layout == "cross" else set())
        assert set(got.ravel().tolist()) <= held
        shape = {"equirect": (24, 48), "openexr": (96, 16), "cross": (48, 64), "faces": (16, 16)}
        assert got.shape[:2] == shape[layout]
        assert len(np.unique(got)) > 1
        if layout == "equirect":  # the mesh is in front, at the sides of a panorama round +Z
            assert (got[12, 24] == row[0, 0]).all()


def test_capture_to_a_panorama_with_an_environment(tmp_path):
    out = tmp_path / "pano.png"
    result = cubecam(
        "capture", cc.sample_data("teapot.obj"), "--mesh-size", 1, "--mesh-position", 0, 0, -2, "-m", "mirror",
        "-e", cc.sample_data("studio.exr"), "-o", out, "--layout", "equirect", "--size", 32,
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    assert cc.load_image(out).shape[:2] == (64, 128)


@pytest.mark.parametrize("material", ["phong", "mirror"])
def test_capture_keeps_the_look_of_a_photograph_of_8_bits(material, tmp_path):
    photograph = face_pattern(16)
    cc.save_image(tmp_path / "row.png", to_layout(photograph, "row", "inside"))
    result = cubecam(
        "capture", cc.sample_data("teapot.obj"), "--size", 16, "-e", tmp_path / "row.png", "-l", "row",
        "--from-convention", "inside", "-m", material, "--color", 1, 1, 1, "--tonemap", "none",
        "-o", tmp_path / "out.png",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    out = cc.load_image(tmp_path / "out.png")[..., :3].astype(int)
    apart = np.abs(out - to_layout(photograph, "row")[..., :3])
    assert apart[:, : 5 * 16].max() <= 1  # the teapot is on the sixth face


def test_a_missing_file_with_the_name_of_a_sample_says_where_it_is(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = f"the sample file of this name is '{cc.sample_data('bunny.obj')}'"
    result = cubecam("capture", "bunny.obj")
    assert result.exit_code == 1
    assert told in result.stderr
    with pytest.raises(FileNotFoundError, match=re.escape(told)):
        cc.load_mesh("bunny")
    with pytest.raises(FileNotFoundError, match=r"No such file or directory: 'hare\.obj'"):
        cc.load_mesh("hare.obj")


def test_demo_writes_what_it_promises(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the file names stay short, so a narrow table does not wrap them
    result = cubecam("demo", "--out", "out", "--frames", 2, "--size", 64)
    assert result.exit_code == 0, result.output
    names = {path.suffix for path in (tmp_path / "out").iterdir()}
    assert {".png", ".exr"} <= names
    for path in (tmp_path / "out").iterdir():
        assert path.name in result.output
        assert path.stat().st_size > 500
