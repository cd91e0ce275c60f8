"""The installation: Python, the package and its module, a second copy, the packages that cubecam needs."""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import os
import platform
import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

from .findings import Finding
from .module import explain, here
from .system import System

__all__ = ["check_copies", "check_module", "check_requirements", "check_script"]


def check_module(system: System, error: str = "") -> list[Finding]:
    """Load the compiled module; `error` is that of an import that has failed already."""
    version = ""
    if not error:
        try:
            version = importlib.import_module("cubecam._core").__version__
        except ImportError as failed:
            error = str(failed)
    installed = here()
    where = (
        f"in {installed.folder}, Python {platform.python_version()} ({sys.executable}), {_libc()}"
    )
    if error:
        return [explain(system, installed, error), Finding("python", "note", f"cubecam {where}")]
    return [Finding("module", "ok", f"cubecam {version} {where}"), *_check_version(version)]


def _check_version(version: str) -> list[Finding]:
    told = _version_of("cubecam")
    if told in ("", version):  # "": a source tree on PYTHONPATH
        return []
    text = f"the imported module is version {version}, and pip has installed version {told}"
    cure = (f"{sys.executable} -m pip install --force-reinstall --no-deps cubecam",)
    return [Finding("copies", "warning", text, cure)]


def check_copies(paths: list[str], used: Path) -> list[Finding]:
    """Look for a second cubecam on sys.path: the first one is imported, and pip may change another one."""
    found = list(dict.fromkeys(_packages(paths)))
    others = [folder for folder in found if folder != used]
    if not others:
        return []
    text = f"cubecam is imported from {used}, and is also in {', '.join(map(str, others))}"
    cure: tuple[str, ...] = (
        "# remove what is not wanted; pip shows and removes its own:",
        f"{sys.executable} -m pip uninstall cubecam",
    )
    if os.environ.get("PYTHONPATH"):
        cure = (f"unset PYTHONPATH  # is {os.environ['PYTHONPATH']}", *cure)
    return [Finding("copies", "warning", text, cure)]


def _packages(paths: list[str]) -> Iterator[Path]:
    for entry in paths:
        folder = (Path(entry or ".") / "cubecam").resolve()  # may be a link to a checkout
        # Path.is_file() raises where this user may not look.
        if os.path.isfile(folder / "__init__.py"):  # noqa: PTH113
            yield folder


def check_script(path: str | None, prefix: str = sys.prefix) -> list[Finding]:
    """Look whether the command `cubecam` that a shell finds belongs to this Python; its first line names one."""
    if path is None:
        return []
    try:
        with Path(path).open(encoding="utf-8", errors="replace") as file:
            first = file.readline().strip()
    except OSError:
        return []
    python = first[2:].strip().strip('"')
    if not first.startswith("#!") or "python" not in python:
        return []
    # The link to the interpreter is not followed: environments link to one interpreter. /bin may be a link to /usr/bin.
    if Path(python).parent.resolve().parent == Path(prefix).resolve():
        return []
    text = f"the command {path} runs {python}, and this is the Python of {prefix}"
    cure = (
        f"{sys.executable} -m cubecam doctor",
        "hash -r  # after installing again, a shell may remember the old one",
    )
    return [Finding("copies", "note", text, cure)]


def check_requirements(requires: list[str] | None = None) -> list[Finding]:
    """Look whether each package that cubecam needs is there, and new enough."""
    if requires is None:
        try:
            requires = importlib.metadata.requires("cubecam") or []
        except importlib.metadata.PackageNotFoundError:
            requires = []
    wrong, sound = [], []
    for line in requires:
        if ";" in line:  # of an extra
            continue
        found = re.match(r"([\w.-]+)(?:>=([\d.]+))?", line)
        if found is None:
            continue
        name, least = found[1], found[2] or "0"
        have = _version_of(name)
        if not have:
            wrong.append((f"{name} is missing", line))
            continue
        if _numbers(have) < _numbers(least):
            wrong.append((f"{name}: expected {least} or newer, got {have}", line))
        else:
            sound.append(f"{name} {have}")
    if wrong:
        text = "; ".join(what for what, _ in wrong)
        packages = " ".join(f'"{line}"' for _, line in wrong)
        cure = (f"{sys.executable} -m pip install {packages}",)
        return [Finding("requirements", "problem" if "missing" in text else "warning", text, cure)]
    return [Finding("requirements", "ok", ", ".join(sound))] if sound else []


def _version_of(package: str) -> str:
    """Give the version of an installed package; "" if it is not there, or is what an update left behind."""
    try:
        return importlib.metadata.version(package) or ""
    except (
        importlib.metadata.PackageNotFoundError,
        KeyError,
    ):  # KeyError: metadata without a version, from 3.14 on
        return ""


def found_script() -> str | None:
    """Give the path of the command that a shell finds."""
    return shutil.which("cubecam")


def _numbers(version: str) -> tuple[int, ...]:
    found = [int(part) for part in re.findall(r"\d+", version.partition("+")[0])[:3]]
    return tuple(found + [0] * (3 - len(found)))  # 2 is 2.0.0


def _libc() -> str:
    name, version = platform.libc_ver()
    return f"{name} {version}" if name else "a C library that is not glibc"
