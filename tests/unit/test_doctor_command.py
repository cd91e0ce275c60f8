"""`cubecam doctor` and `cubecam conventions` as a user starts them, in environments that are really broken."""

import json
import os
import pty
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

import cubecam as cc
from cubecam.cli import app
from cubecam.cli.conventions import conventions_file, section_of
from tests.gl.fakes import build_fake
from tests.helpers import need_no_sanitizer, need_terminals, run_python

ROOT = Path(__file__).resolve().parents[2]
EGL = ROOT / "cpp" / "cubecam" / "gl" / "egl.cpp"
PACKAGE = Path(cc.__file__).parent
DOCUMENT = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")


def cubecam(*words, package=None, **environment):
    """Run the command in a process of its own, with another copy of the package if one is named."""
    paths = [str(path) for path in (package, os.environ.get("PYTHONPATH")) if path]
    return subprocess.run(
        [sys.executable, "-m", "cubecam", *words],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths), **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def problems(done):
    """Give {name: cure} of the problems of a report in JSON."""
    found = json.loads(done.stdout)["findings"]
    return {one["name"]: one["cure"] for one in found if one["status"] == "problem"}


def test_a_sound_machine():
    done = cubecam("doctor")
    assert done.returncode == 0, done.stdout
    assert "\nok       drawing: a picture was drawn by " in done.stdout
    assert "Pictures can be drawn" in done.stdout.splitlines()[-1]


@pytest.mark.llvmpipe("the variables are those of Mesa, and of a machine with Mesa alone")
@pytest.mark.parametrize(
    ("variable", "value", "name"),
    [
        ("CUBECAM_EGL_LIBRARY", "/nonexistent", "egl-library"),
        ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", "egl-vendors"),
        ("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", "egl-vendors"),
        ("GALLIUM_DRIVER", "softpipe", "variables"),
        ("MESA_GL_VERSION_OVERRIDE", "3.3", "variables"),
        ("CUBECAM_DEVICE", "no such card", "variables"),
    ],
)
def test_broken_environments(variable, value, name):
    """Each is found, and its cure is the line that mends it."""
    done = cubecam("doctor", "--json", **{variable: value})
    assert done.returncode == 1
    found = problems(done)
    assert set(found) == {name, "drawing"}
    assert found[name][0] == f"unset {variable}"
    assert json.loads(done.stdout)["works"] is False


@pytest.mark.llvmpipe("the variable is Mesa's")
def test_a_wrong_path_of_drivers():
    """Newer versions of Mesa have their drivers in one library, and do not read the variable: then it is a warning."""
    done = cubecam("doctor", "--json", LIBGL_DRIVERS_PATH="/nonexistent")
    found = json.loads(done.stdout)
    (one,) = [one for one in found["findings"] if one["name"] == "mesa-drivers"]
    assert one["status"] == ("warning" if found["works"] else "problem")
    assert one["cure"] == ["unset LIBGL_DRIVERS_PATH"]


@pytest.fixture(scope="module")
def fake(tmp_path_factory):
    return build_fake(tmp_path_factory.mktemp("fake"))


@pytest.mark.slow
@pytest.mark.llvmpipe("the stand-in has llvmpipe below it")
def test_a_gpu_that_does_not_start(fake):
    done = cubecam("doctor", "--json", CUBECAM_EGL_LIBRARY=str(fake), FAKE_GPU="1")
    report = json.loads(done.stdout)
    (one,) = [one for one in report["findings"] if one["name"] == "gpu"]
    assert (report["works"], one["status"]) == (True, "warning")
    assert "is a GPU that does not start: " in one["text"]
    wanted = cubecam(
        "doctor", "--json", "--device", "gpu", CUBECAM_EGL_LIBRARY=str(fake), FAKE_GPU="1"
    )
    assert wanted.returncode == 1
    assert "drawing" in problems(wanted)


def test_a_library_that_crashes(tmp_path):
    """The doctor lives on, and names the signal."""
    source, library = tmp_path / "crash.c", tmp_path / "libcrash.so"
    source.write_text(
        "#include <stdlib.h>\n#include <stdio.h>\nvoid* eglGetProcAddress(const char* n) { abort(); }\n"
        + "".join(
            f"void* {name}(void) {{ abort(); }}\n"
            for name in re.findall(r'"(egl(?!GetProcAddress)\w+)"', EGL.read_text())
        )
    )
    compiler = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc")
    subprocess.run([str(compiler), "-shared", "-fPIC", str(source), "-o", str(library)], check=True)
    done = cubecam("doctor", CUBECAM_EGL_LIBRARY=str(library))
    assert done.returncode == 1
    assert "was ended by SIGABRT while listing the devices" in done.stdout


def test_a_device_that_does_not_exist():
    done = cubecam("doctor", "--json", "--device", "no such card")
    assert done.returncode == 1
    assert problems(done)["drawing"][-1] == "cubecam doctor --device auto"


def copy_of_the_package(folder):
    """Copy the package, without the data, so that a test may break it."""
    left_out = shutil.ignore_patterns("*.exr", "*.glb", "__pycache__")
    shutil.copytree(PACKAGE, folder / "cubecam", ignore=left_out)
    return folder


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    need_no_sanitizer("the module is elsewhere")
    folder = copy_of_the_package(tmp_path_factory.mktemp("broken"))
    (module,) = (folder / "cubecam").glob("_core*.so")
    module.rename(module.with_name("_core.cpython-399-x86_64-linux-gnu.so"))
    return folder


def test_a_broken_installation_is_examined(broken):
    """The core cannot be imported, and the doctor says why and goes on."""
    done = cubecam("doctor", package=broken)
    assert done.returncode == 1
    assert done.stderr == ""
    assert "problem  module: the compiled module is for another Python or processor" in done.stdout
    assert "pip install --force-reinstall" in done.stdout
    assert "egl-library: " in done.stdout
    report = cubecam("doctor", "--json", package=broken)
    assert set(problems(report)) == {"module"}
    assert report.stderr == ""


def test_other_commands_of_a_broken_installation(broken):
    done = cubecam("info", package=broken)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith("error: cubecam cannot be loaded: the compiled module")
    assert "`cubecam doctor` says more" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_console_script_of_a_broken_installation(broken, tmp_path):
    script = tmp_path / "cubecam"
    script.write_text("import sys\nfrom cubecam.__main__ import main\nsys.exit(main())\n")
    done = subprocess.run(
        [sys.executable, str(script), "doctor", "--json"],
        env={**os.environ, "PYTHONPATH": str(broken)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, set(problems(done))) == (1, {"module"})


def test_a_program_of_a_broken_installation(broken):
    done = run_python("import cubecam", check=False, PYTHONPATH=broken)
    assert done.returncode == 1
    assert "ImportError: cubecam cannot be loaded: the compiled module" in done.stderr
    assert "--force-reinstall" in done.stderr


def test_another_system_is_named_before_what_it_lacks(broken):
    """Windows has neither pwd nor resource; Python finds that out before anything else would."""
    program = """
import os, pathlib, platform, subprocess, sys
for name in ("geteuid", "getegid", "getgroups"):
    delattr(os, name)
sys.modules |= {"pwd": None, "resource": None}
sys.platform = "win32"
import cubecam
"""
    done = run_python(program, check=False, PYTHONPATH=broken)
    assert done.returncode == 1
    assert (
        "ImportError: cubecam cannot be loaded: cubecam runs on Linux, and this is win32"
        in done.stderr
    )


def test_a_missing_package(tmp_path):
    """Without click there is no command line, and the doctor runs."""
    (tmp_path / "click.py").write_text("raise ModuleNotFoundError('No module named click')\n")
    done = cubecam("doctor", package=tmp_path)
    assert done.returncode == 1
    assert "ok       module: " in done.stdout
    assert "ok       drawing: " in done.stdout
    assert (
        "problem  command: the command line cannot be loaded: No module named click" in done.stdout
    )
    other = cubecam("info", package=tmp_path)
    assert other.returncode == 1
    assert "No module named click" in other.stderr


def test_a_helper_that_may_not_be_executed(tmp_path):
    need_no_sanitizer("the module is elsewhere")
    folder = copy_of_the_package(tmp_path)
    helper = folder / "cubecam" / "_shader_trial"
    helper.chmod(0o644)
    found = json.loads(cubecam("doctor", "--json", package=folder).stdout)["findings"]
    (one,) = [one for one in found if one["name"] == "shader-trial"]
    assert (one["status"], one["cure"]) == ("warning", [f"chmod +x {helper}"])


def test_little_address_space():
    """The limit is that of the shell; its line is the cure."""
    need_no_sanitizer("it takes terabytes of address space")
    done = subprocess.run(
        ["bash", "-c", f"ulimit -v 1000000; {sys.executable} -m cubecam doctor --json"],
        capture_output=True,
        text=True,
        check=False,
    )
    found = {one["name"]: one for one in json.loads(done.stdout)["findings"]}
    assert found["memory"]["status"] == "warning" or "RLIMIT_AS" in found["memory"]["text"]


@pytest.mark.slow
def test_the_selftest():
    done = cubecam(
        "doctor", "--selftest", "--device", os.environ.get("CUBECAM_TEST_DEVICE", "software")
    )
    assert done.returncode == 0, done.stdout
    lines = done.stdout.partition("Pictures can be drawn")[2].splitlines()[1:]
    names = ("orientation", "seams", "formats", "mirrors", "shader")
    for line in lines[:-1]:
        assert re.match(rf"ok       ({'|'.join(names)}): .*: error \S+, tolerance \S+$", line), line
    assert re.match(r"All tests passed, in \d+\.\d s\.", lines[-1])


@pytest.mark.slow
def test_the_selftest_as_json():
    done = cubecam("doctor", "--selftest", "--json")
    report = json.loads(done.stdout)
    assert report["works"] is True
    assert all(test["passed"] for test in report["selftest"])
    assert {test["name"] for test in report["selftest"]} >= {"orientation", "shader"}


def test_no_selftest_where_nothing_can_be_drawn():
    done = cubecam("doctor", "--selftest", CUBECAM_EGL_LIBRARY="/nonexistent")
    assert done.returncode == 1
    assert "orientation" not in done.stdout


def test_a_failed_test_is_shown_and_fails_the_command(monkeypatch):
    from cubecam.doctor.proofs import run
    from cubecam.doctor.proofs.measurement import Measurement

    wrong = [
        Measurement("seams", "steps", 0.5, 1e-4),
        Measurement("shader", "x", float("nan"), 0, "no"),
    ]
    monkeypatch.setattr(run, "prove_apart", lambda system, device: wrong)
    result = CliRunner().invoke(app, ["doctor", "--selftest"])
    assert result.exit_code == 1
    assert (
        "FAILED   seams: steps: error 0.5, tolerance 0.0001\nFAILED   shader: x: no\n"
        in result.output
    )
    assert "2 tests failed" in result.output
    report = CliRunner().invoke(app, ["doctor", "--selftest", "--json"])
    assert json.loads(report.output)["selftest"][1]["error"] is None


# Conventions


def test_the_conventions_in_a_pipe():
    assert cubecam("conventions").stdout == DOCUMENT


def test_the_document_is_that_of_the_checkout_or_the_package():
    assert conventions_file().read_text(encoding="utf-8") == DOCUMENT


def test_the_conventions_of_an_installed_package(tmp_path):
    folder = copy_of_the_package(tmp_path)
    own = folder / "cubecam" / "conventions.md"
    own.write_text("# Conventions\n\ninstalled\n")
    assert cubecam("conventions", package=folder).stdout == own.read_text()
    own.unlink()
    done = cubecam("conventions", package=folder)
    assert done.returncode == 1
    assert f"expected {own}, which comes with the package" in done.stderr


def test_the_build_installs_the_document():
    rules = (ROOT / "cpp" / "bindings" / "CMakeLists.txt").read_text()
    assert 'install(FILES "${PROJECT_SOURCE_DIR}/docs/conventions.md" DESTINATION cubecam)' in rules


def test_the_conventions_in_a_terminal():
    need_terminals()
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [sys.executable, "-m", "cubecam", "conventions", "--section", "panoramas"],
        env={**os.environ, "COLUMNS": "100", "TERM": "xterm-256color"},
        stdout=theirs,
    ) as process:
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 1 << 16)
            except OSError:
                break
            if not part:
                break
            text += part
    os.close(ours)
    assert process.returncode == 0
    shown = text.decode()
    assert "\x1b[" in shown
    assert "##" not in shown
    assert "| left edge |" not in shown  # a table of Markdown is drawn as one
    plain = re.sub(r"\x1b\[[\d;]*m", "", shown)
    assert "Columns run to the right as the viewer turns to the right." in plain
    assert "](" not in plain


def test_sections():
    text = section_of(DOCUMENT, "six faces")
    assert text.startswith("## The six faces")
    assert "## World" not in text
    assert "## Six faces" not in section_of(DOCUMENT, "the six faces")
    both = section_of(DOCUMENT, "panoramas")
    assert "### OpenEXR's border rule" in both  # what stands below
    result = CliRunner().invoke(app, ["conventions", "--section", "no such title"])
    assert result.exit_code == 1
    assert "expected words of a title, got 'no such title'" in result.output
    assert "The six faces" in result.output
