"""Mesa's drivers, which its EGL opens: files *_dri.so, or one libgallium-*.so since Mesa 24.3."""

from __future__ import annotations

from .drawing import Drawing
from .findings import Finding
from .packages import install_mesa
from .system import System
from .vendors import MESA

__all__ = ["check_mesa"]

VARIABLE = "LIBGL_DRIVERS_PATH"
_FOLDERS = (
    "/usr/lib/*-linux-gnu",
    "/usr/lib64",
    "/usr/lib",
    "/usr/local/lib",
    "/usr/local/lib/*-linux-gnu",
)


def check_mesa(system: System, drawing: Drawing) -> list[Finding]:
    """Look for the drivers, where Mesa's EGL is installed."""
    if not _has_mesa(system):
        return []
    chosen = system.environ.get(VARIABLE)
    if chosen:
        drivers = [
            name for folder in chosen.split(":") for name in system.glob(f"{folder}/*_dri.so")
        ]
        if not drivers:
            text = f"{VARIABLE}={chosen}: there is no driver (*_dri.so) in it"
            return [Finding("mesa-drivers", drawing.blocking, text, (f"unset {VARIABLE}",))]
    else:
        drivers = [name for folder in _FOLDERS for name in system.glob(f"{folder}/dri/*_dri.so")]
        drivers += [
            name for folder in _FOLDERS for name in system.glob(f"{folder}/libgallium-*.so")
        ]
    if drivers:
        return [Finding("mesa-drivers", "ok", f"Mesa's drivers are in {_folder(drivers[0])}")]
    if drawing.works:  # they lie elsewhere
        return []
    text = "Mesa's EGL is installed, and none of its drivers is: there is no *_dri.so and no libgallium-*.so"
    return [Finding("mesa-drivers", "problem", text, install_mesa(system))]


def _has_mesa(system: System) -> bool:
    return any(system.glob(f"{folder}/{MESA}*") for folder in _FOLDERS)


def _folder(name: str) -> str:
    return name.rpartition("/")[0]
