"""Install what only the system can provide, then make the virtual environment.

The script uses the standard library only, because nothing else is installed yet. On Debian and
Ubuntu, apt installs what is missing, as root or by sudo; on another Linux the script names what is
missing and stops. If nothing is missing, nothing is installed and the network is not used.

    python3 scripts/system.py .venv
    python3 scripts/system.py --browser     Chromium, which `make test-browser` drives
"""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

OLDEST_PYTHON = (3, 10)

# This program opens Mesa without a screen, as cubecam does. It runs in a process of its own,
# because a broken driver may end the process that checks it.
EGL_PROBE = """
import ctypes, os, sys
try:
    egl = ctypes.CDLL(os.environ.get("CUBECAM_EGL_LIBRARY") or "libEGL.so.1")
except OSError:
    sys.exit(3)
egl.eglGetProcAddress.restype = ctypes.c_void_p
egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
address = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
if not address:
    sys.exit(4)
signature = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)
EGL_PLATFORM_SURFACELESS_MESA = 0x31DD
display = signature(address)(EGL_PLATFORM_SURFACELESS_MESA, None, None)
egl.eglInitialize.argtypes = [ctypes.c_void_p] * 3
sys.exit(0 if display and egl.eglInitialize(display, None, None) else 4)
"""
EGL_NO_LIBRARY, EGL_NO_DRIVER = 3, 4


class SetupError(Exception):
    """A problem that the user has to solve; the message says what is wrong and what to do."""


@dataclass(frozen=True)
class Need:
    """One thing the machine must have, and the packages that bring it."""

    name: str
    present: Callable[[], bool]
    debian: tuple[str, ...]
    fedora: str
    arch: str
    required: bool = True
    of_python: bool = False


def python_package(suffix: str) -> str:
    """Debian's name of a part of this Python: python3-venv for the system's Python, else such as python3.12-venv."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    default = Path("/usr/bin/python3").resolve().name
    return suffix.format("3" if default == f"python{version}" else version)


def has_python_headers() -> bool:
    return Path(sysconfig.get_path("include"), "Python.h").is_file()


def compiler() -> str | None:
    chosen = os.environ.get("CXX")
    candidates = (
        [shlex.split(chosen)[0]] if chosen and chosen.strip() else ["c++", "g++", "clang++"]
    )
    return next((path for path in map(shutil.which, candidates) if path), None)


def compiles(source: str) -> bool:
    program = compiler()
    if program is None:
        return False
    command = [program, "-std=c++20", "-fsyntax-only", "-x", "c++", "-"]
    return subprocess.run(command, input=source, text=True, capture_output=True).returncode == 0


def egl_status() -> int:
    try:
        probe = subprocess.run([sys.executable, "-c", EGL_PROBE], capture_output=True, timeout=60)
    except subprocess.TimeoutExpired:
        return EGL_NO_DRIVER
    return probe.returncode


def needs(venv: Path) -> list[Need]:
    return [
        Need(
            "the Python modules venv and ensurepip",
            lambda: works(venv) or all(map(importlib.util.find_spec, ("venv", "ensurepip"))),
            (python_package("python{}-venv"),),
            "python3",
            "python",
            of_python=True,
        ),
        Need(
            "the Python headers (Python.h)",
            has_python_headers,
            (python_package("libpython{}-dev"),),
            "python3-devel",
            "python",
            of_python=True,
        ),
        Need("a C++ compiler", lambda: compiler() is not None, ("g++",), "gcc-c++", "gcc"),
        # GLM is not required: CMake fetches it where it is not installed.
        Need(
            "GLM",
            lambda: compiles("#include <glm/glm.hpp>\n"),
            ("libglm-dev",),
            "glm-devel",
            "glm",
            required=False,
        ),
        Need(
            "the EGL library (libEGL.so.1)",
            lambda: egl_status() != EGL_NO_LIBRARY,
            ("libegl1",),
            "libglvnd-egl",
            "libglvnd",
        ),
        Need(
            "Mesa's software OpenGL driver",
            lambda: egl_status() == 0,
            ("libegl-mesa0", "libgl1-mesa-dri"),
            "mesa-libEGL mesa-dri-drivers",
            "mesa",
        ),
    ]


def browser() -> Need:
    return Need(
        "Chromium",
        lambda: shutil.which("chromium") is not None,
        ("chromium",),
        "chromium",
        "chromium",
    )


def distribution() -> set[str]:
    """The names of this Linux in /etc/os-release: its own name and those of similar systems."""
    try:
        text = Path("/etc/os-release").read_text(encoding="utf-8")
    except OSError:
        return set()
    fields = dict(line.split("=", 1) for line in text.splitlines() if "=" in line)
    return {
        name
        for key in ("ID", "ID_LIKE")
        for name in fields.get(key, "").strip("\"'").lower().split()
    }


def describe(missing: list[Need]) -> str:
    lines = [
        f"  {need.name}\n"
        f"      Debian, Ubuntu: {' '.join(need.debian)}   Fedora: {need.fedora}   Arch: {need.arch}"
        for need in missing
    ]
    return "\n".join(lines)


def has_apt() -> bool:
    return bool({"debian", "ubuntu"} & distribution()) and shutil.which("apt-get") is not None


def may_install() -> bool:
    return os.geteuid() == 0 or shutil.which("sudo") is not None


def install_with_apt(packages: list[str]) -> None:
    if not may_install():
        raise SetupError(
            "packages are missing, and this is neither root nor is there sudo. As root, run\n"
            f"  apt-get install {' '.join(packages)}"
        )
    prefix = [] if os.geteuid() == 0 else ["sudo"]
    say(f"installing with apt: {' '.join(packages)}")
    # A new Ubuntu holds apt's lock in its first minutes, for its own updates.
    apt = [
        *prefix,
        "env",
        "DEBIAN_FRONTEND=noninteractive",
        "apt-get",
        "-qq",
        "-o",
        "DPkg::Lock::Timeout=300",
    ]
    # A broken third-party source fails the update, although the needed packages may be installed.
    update = subprocess.run(
        [*apt, "update"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    install = subprocess.run(
        [*apt, "install", "-y", "--no-install-recommends", *packages],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if install.returncode != 0:
        log = "\n".join((update.stdout + install.stdout).splitlines()[-30:])
        raise SetupError(f"apt-get install {' '.join(packages)} failed:\n{log}")


def prepare_system(venv: Path) -> None:
    if sys.version_info < OLDEST_PYTHON:
        raise SetupError(
            "expected Python {}.{} or newer, got {}.{} ({}); name another with PYTHON=...".format(
                *OLDEST_PYTHON, *sys.version_info[:2], sys.executable
            )
        )
    missing = [need for need in needs(venv) if not need.present()]
    if has_apt() and (any(need.required for need in missing) or (missing and may_install())):
        own = [need.name for need in missing if need.of_python]
        if own and sys.base_prefix != "/usr":
            # No package brings headers to an interpreter that did not come from a package.
            raise SetupError(
                f"{sys.executable} lacks {' and '.join(own)}.\n"
                "Install that for it, or choose the system's own: make PYTHON=/usr/bin/python3 ..."
            )
        install_with_apt([package for need in missing for package in need.debian])
        importlib.invalidate_caches()
        missing = [need for need in missing if not need.present()]
    required = [need for need in missing if need.required]
    if required:
        raise SetupError(f"install what is missing and try again:\n{describe(required)}")
    for need in missing:
        say(f"{need.name} is not installed; the build will fetch it")
    if not compiles("#include <concepts>\n#include <span>\n#include <version>\n"):
        raise SetupError(f"expected a compiler with C++20 (GCC 11 or newer), got {compiler()}")


def prepare_browser() -> None:
    need = browser()
    if not need.present() and has_apt():
        install_with_apt(list(need.debian))
    if not need.present():
        raise SetupError(f"install what is missing and try again:\n{describe([need])}")


def works(venv: Path) -> bool:
    python = venv / "bin" / "python"
    command = [str(python), "-c", "import pip"]
    return python.exists() and subprocess.run(command, capture_output=True).returncode == 0


def make_venv(venv: Path) -> None:
    if works(venv):
        return
    say(f"making {venv}")
    made = subprocess.run(
        [sys.executable, "-m", "venv", "--clear", str(venv)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if made.returncode != 0:
        raise SetupError(f"{sys.executable} -m venv {venv} failed:\n{made.stdout}")


def say(message: str) -> None:
    print(f"[setup] {message}", flush=True)


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(f"usage: {Path(__file__).name} VENV or --browser", file=sys.stderr)
        return 2
    venv = Path(arguments[0])
    try:
        if arguments == ["--browser"]:
            prepare_browser()
            return 0
        prepare_system(venv)
        make_venv(venv)
    except SetupError as error:
        print(f"[setup] {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
