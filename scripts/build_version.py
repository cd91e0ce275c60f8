"""Build the compiled module of another version of this repository, to compare it with the present one.

    python scripts/build_version.py f890032 before     the module then lies in before/python/cubecam

A program uses that version with ``PYTHONPATH=before/python``. The interpreter that runs this script must
have the packages that building needs (``scripts/packages.py build run``).
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def module_of(folder: Path) -> Path | None:
    """Return the compiled module of a tree, or None if the tree has none."""
    return next((folder / "python" / "cubecam").glob("_core*.so"), None)


def build(revision: str, folder: Path) -> Path:
    """Write a revision's files to a folder and compile its module there.

    Parameters
    ----------
    revision : str
        A name that git knows: a commit, a tag or a branch.
    folder : Path
        The folder is made if it does not exist. If it holds a module already, nothing is built.

    Returns
    -------
    Path
        The folder that PYTHONPATH must name to use that version.
    """
    package = folder / "python"
    if module_of(folder) is not None:
        return package
    folder.mkdir(parents=True, exist_ok=True)
    archive = folder / "version.tar"
    run("git", "-C", str(ROOT), "archive", "--output", str(archive.resolve()), revision)
    with tarfile.open(archive) as file:
        file.extractall(folder)
    archive.unlink()
    objects = folder / "build" / "version"
    compile_into(package / "cubecam", folder, objects, "-DCMAKE_BUILD_TYPE=Release")
    return package


def compile_into(package: Path, tree: Path, objects: Path, *options: str) -> Path:
    """Compile a tree's module with options of CMake, in the folder `objects`, and copy it into a folder.

    The program that tries shaders is compiled and copied, too, if the tree has one. Returns the copied module's path.
    """
    import pybind11

    tools = Path(sys.executable).parent
    cmake = shutil.which("cmake", path=f"{tools}{os.pathsep}{os.environ.get('PATH', '')}")
    ninja = shutil.which("ninja", path=f"{tools}{os.pathsep}{os.environ.get('PATH', '')}")
    if cmake is None or ninja is None:
        raise SystemExit("expected cmake and ninja: run scripts/packages.py build")
    run(
        cmake,
        *("-S", str(tree), "-B", str(objects), "-G", "Ninja"),
        f"-DCMAKE_MAKE_PROGRAM={ninja}",
        *options,
        "-DCUBECAM_BUILD_MODULE=ON",
        f"-DPython_EXECUTABLE={sys.executable}",
        f"-Dpybind11_DIR={pybind11.get_cmake_dir()}",
    )
    jobs = str(len(os.sched_getaffinity(0)))
    helper = (tree / "cpp" / "shader_trial").is_dir()  # versions before 0.3 have none
    targets = ["_core", *(["cubecam_shader_trial"] if helper else [])]
    run(cmake, "--build", str(objects), "--target", *targets, "--parallel", jobs)
    if helper:
        shutil.copy2(next(objects.rglob("_shader_trial")), package)
    return Path(shutil.copy2(next(objects.rglob("_core*.so")), package))


def run(*command: str) -> None:
    """Run a command; its output is shown only if it fails."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stdout}\n{done.stderr}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    print(build(sys.argv[1], Path(sys.argv[2])))
