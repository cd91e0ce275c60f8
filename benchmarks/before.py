"""The previous version, built from git, with which the marks of speed compare the present one."""

from __future__ import annotations

import io
import shutil
import subprocess
import sys
import sysconfig
import tarfile
from pathlib import Path

from .processes import ROOT

COMMIT = "f890032a2931"
FOLDER = ROOT / "build" / f"before-{COMMIT}"


class BeforeError(Exception):
    """The previous version cannot be built; the message says why."""


def _tool(name: str) -> str:
    beside = Path(sysconfig.get_path("scripts")) / name
    found = str(beside) if beside.exists() else shutil.which(name)
    if not found:
        raise BeforeError(f"expected {name} in {beside.parent} or on PATH")
    return found


def _run(*command: object) -> bytes:
    done = subprocess.run([str(part) for part in command], cwd=ROOT, capture_output=True)
    if done.returncode:
        said = (done.stdout + done.stderr).decode(errors="replace").strip().splitlines()
        raise BeforeError(said[-1] if said else f"{command[0]} ended with {done.returncode}")
    return done.stdout


def tree(given: Path | None = None) -> Path:
    """The folder of the previous version, with its module in python/cubecam.

    It is built once and kept under build/. `given` is a folder that holds a built version already.
    """
    folder = given.resolve() if given else FOLDER
    package = folder / "python" / "cubecam"
    if list(package.glob("_core.*.so")):
        return folder
    if given:
        raise BeforeError(f"expected a built module in {package}, found none")
    import pybind11

    git = shutil.which("git")
    if git is None:
        raise BeforeError("expected git on PATH: the version before is taken from its history")
    with tarfile.open(fileobj=io.BytesIO(_run(git, "archive", COMMIT))) as archive:
        archive.extractall(folder)
    build = folder / "build"
    _run(
        _tool("cmake"), "-S", folder, "-B", build, "-G", "Ninja",
        f"-DCMAKE_MAKE_PROGRAM={_tool('ninja')}", f"-DPython_EXECUTABLE={sys.executable}",
        f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", "-DCUBECAM_BUILD_MODULE=ON",
        "-DCMAKE_BUILD_TYPE=Release",
    )  # fmt: skip
    _run(_tool("cmake"), "--build", build, "--target", "_core", "--parallel", "2")
    (module,) = build.rglob("_core.*.so")
    shutil.copy2(module, package)
    return folder
