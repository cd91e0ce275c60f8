"""One line about the machine on which the numbers were measured."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path


def _cpu() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def _gl() -> str:
    try:
        import cubecam as cc

        with cc.Renderer() as renderer:
            return f"{renderer.info.renderer}, {renderer.info.version}"
    except Exception as error:  # the line is for people, so any error may appear in it
        return f"no renderer ({error})"


def describe() -> dict[str, str | int]:
    """CPU, cores, GL and the versions of all that is compared."""
    found: dict[str, str | int] = {
        "cpu": _cpu(),
        "cores": len(os.sched_getaffinity(0)),
        "load": f"{os.getloadavg()[0]:.1f}",  # much above 0 if other programs are running
        "gl": _gl(),
        "python": platform.python_version(),
    }
    for package in ("cubecam", "numpy", "moderngl", "zengl", "vtk", "py360convert"):
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            found[package] = "absent"
    return found
