"""The compiled module cubecam._core: whether it can be loaded, and why not."""

from __future__ import annotations

import importlib.machinery
import os
import platform
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from .findings import Finding
from .rights import as_root
from .system import System

__all__ = ["Installed", "explain", "here"]


@dataclass(frozen=True)
class Installed:
    """The package as it lies on disk, and the interpreter that imports it."""

    folder: Path
    python: str = sys.executable
    suffixes: tuple[str, ...] = tuple(importlib.machinery.EXTENSION_SUFFIXES)
    platform: str = sys.platform

    @property
    def reinstall(self) -> str:
        """The command that installs the package again, for this interpreter."""
        checkout = self.folder.parent.parent
        if (checkout / "pyproject.toml").is_file() and (checkout / "cpp").is_dir():
            return f"make -C {checkout} dev"
        return f"{self.python} -m pip install --force-reinstall --no-cache-dir cubecam"


def here() -> Installed:
    """Describe the package that this file belongs to."""
    return Installed(Path(__file__).resolve().parent.parent)


def explain(system: System, installed: Installed, error: str) -> Finding:
    """Say why the module cannot be loaded; `error` is the text of the ImportError."""
    text, cure = _reason(system, installed, error)
    return Finding("module", "problem", text, cure)


def _reason(system: System, installed: Installed, error: str) -> tuple[str, tuple[str, ...]]:
    if not installed.platform.startswith("linux"):
        text = f"cubecam runs on Linux, and this is {installed.platform}"
        return text, (
            "# on macOS run it in Docker; on Windows in WSL 2 (wsl --install) or in Docker",
        )
    modules = sorted(path.name for path in installed.folder.glob("_core*.so"))
    fitting = [name for name in modules if name[len("_core") :] in installed.suffixes]
    if not modules:
        text = f"{installed.folder} has no compiled module (_core*.so)"
        return text, (installed.reinstall,)
    if not fitting:
        expected = f"_core{installed.suffixes[0]}"
        return (
            f"the compiled module is for another Python or processor: expected {expected}, got {', '.join(modules)}",
            (installed.reinstall,),
        )
    return _loader_reason(system, installed, fitting[0], error)


def _loader_reason(
    system: System, installed: Installed, name: str, error: str
) -> tuple[str, tuple[str, ...]]:
    """Explain what the loader of the system says."""
    file = installed.folder / name
    text = f"{file} cannot be loaded: {error.removeprefix(f'{file}: ')}"
    if found := re.search(r"version `(GLIBC_[\d.]+)' not found", error):
        have = "-".join(part for part in platform.libc_ver() if part)
        return f"{text} (this system has {have})", (
            f"# {found[1]} or newer is needed: use a newer system, or build here with a C++20 compiler:",
            f"{installed.python} -m pip install --no-binary cubecam cubecam",
        )
    if re.search(r"version `(GLIBCXX|CXXABI)_[\d.]+' not found", error):
        lines = [
            "# an older libstdc++.so.6 is found first; that of the system, or of conda, is newer:"
        ]
        if system.environ.get("LD_LIBRARY_PATH"):
            lines.append(f"unset LD_LIBRARY_PATH  # is {system.environ['LD_LIBRARY_PATH']}")
        if system.environ.get("CONDA_PREFIX"):
            lines.append("conda install -c conda-forge 'libstdcxx-ng>=12'")
        if len(lines) == 1:
            lines.append(f"{installed.python} -m pip install --no-binary cubecam cubecam")
        return text, tuple(lines)
    if "ld-linux" in error or "ld-musl" in error or "libc.so.6" in error or "musl" in error:
        return f"{text}; the wheels are for glibc, and this system has another C library", (
            "# use a system with glibc, such as the image python:3.12-slim, or build here:",
            f"{installed.python} -m pip install --no-binary cubecam cubecam",
        )
    if missing := re.search(r"(lib[\w+.-]+): cannot open shared object file", error):
        packages = {"libstdc++.so.6": "libstdc++6", "libgcc_s.so.1": "libgcc-s1"}
        package = packages.get(missing[1], missing[1])
        return text, (
            f"# on Debian and Ubuntu; elsewhere the package that has {missing[1]}:",
            *as_root(system, f"apt-get install -y {package}"),
        )
    if "failed to map segment" in error or "Operation not permitted" in error:
        mount = _noexec_mount(installed.folder)
        why = f"{mount} is mounted with noexec" if mount else "this system forbids to execute it"
        first = f"sudo mount -o remount,exec {mount}" if mount else f"findmnt -T {installed.folder}"
        other = "# or install elsewhere: python3 -m venv ~/venv && ~/venv/bin/pip install cubecam"
        return f"{text}; {why}", (first, other)
    return text, (installed.reinstall,)


def _noexec_mount(folder: Path) -> Path | None:
    """Give the place at which the folder's file system is mounted, if nothing on it may be executed."""
    if not os.statvfs(folder).f_flag & os.ST_NOEXEC:
        return None
    place = folder.resolve()
    while not place.is_mount() and place != place.parent:
        place = place.parent
    return place
