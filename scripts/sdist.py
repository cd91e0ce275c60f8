"""Write the source distribution into dist/, and build a wheel from it alone, without a network.

It must hold every file of the repository, so that whoever packages cubecam can run the tests, and no
other file. The wheel is built as distributions do it: with the GLM of the system, which this demands
(by default CMake would fetch GLM where it is missing), and from the tools that are installed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from check_wheel import WheelError, check

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "dist"
WRITTEN = {"PKG-INFO"}  # by the build, from pyproject.toml
#: A network of its own, which has no way out. Users need the permission to make one.
NO_NETWORK = ("unshare", "--map-root-user", "--net")


def build() -> Path:
    for old in DIST.glob("*.tar.gz"):
        old.unlink()
    command = ["-m", "build", "--quiet", "--no-isolation", "--sdist", "--outdir", str(DIST)]
    subprocess.run([sys.executable, *command, str(ROOT)], check=True)
    (sdist,) = DIST.glob("*.tar.gz")
    return sdist


def tracked_files() -> set[str] | None:
    """The files of the repository, or None outside one, in an unpacked source distribution."""
    # A source distribution that is unpacked inside another repository has no files in that one.
    if not (ROOT / ".git").exists():
        return None
    command = ["git", "-C", str(ROOT), "ls-files", "-z"]
    try:
        listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    return {name for name in listed.split("\0") if name and (ROOT / name).exists()}


def check_files(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        found = {
            member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()
        }
    tracked = tracked_files()
    print(f"{sdist.name}: {sdist.stat().st_size / 1e6:.1f} MB, {len(found)} files")
    if tracked is None:
        return
    if missing := sorted(tracked - found):
        raise SystemExit(f"{sdist.name}: expected all files of git, {missing[:5]} are missing")
    if more := sorted(found - tracked - WRITTEN):
        raise SystemExit(f"{sdist.name}: expected files of git alone, got {more[:5]}, too")


def without_network() -> list[str]:
    if subprocess.run([*NO_NETWORK, "true"], stderr=subprocess.DEVNULL).returncode == 0:
        return list(NO_NETWORK)
    print(
        "this user may not make a process without a network, so options tell pip and CMake to stay offline"
    )
    return []


def build_wheel(sdist: Path, folder: Path) -> Path:
    environment = {
        "CMAKE_BUILD_PARALLEL_LEVEL": str(len(os.sched_getaffinity(0))),
        **os.environ,
        "PIP_NO_INDEX": "1",
    }
    prefix = without_network()
    print("building a wheel from it", *(["without a network"] if prefix else []), flush=True)
    subprocess.run(
        [
            *prefix, sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps",
            "--no-build-isolation", "--config-settings=cmake.define.CMAKE_REQUIRE_FIND_PACKAGE_glm=ON",
            f"--wheel-dir={folder}", str(sdist),
        ],
        cwd=folder, env=environment, check=True,
    )  # fmt: skip
    (wheel,) = folder.glob("*.whl")
    return wheel


def main() -> int:
    sdist = build()
    check_files(sdist)
    subprocess.run([sys.executable, "-m", "twine", "check", "--strict", str(sdist)], check=True)
    with tempfile.TemporaryDirectory() as folder:
        try:
            check(build_wheel(sdist, Path(folder)))
        except WheelError as error:
            raise SystemExit(str(error)) from None
    print(f"{sdist.relative_to(ROOT)}: checked")
    return 0


if __name__ == "__main__":
    sys.exit(main())
