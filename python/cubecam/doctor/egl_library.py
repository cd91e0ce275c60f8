"""The EGL library, libEGL.so.1: whether it can be loaded."""

from __future__ import annotations

from .drawing import Drawing
from .findings import Finding
from .packages import install_mesa
from .rights import as_root
from .system import System

__all__ = ["LIBRARY", "check_egl_library"]

LIBRARY = "libEGL.so.1"
VARIABLE = "CUBECAM_EGL_LIBRARY"
#: Folders in which packages put libraries.
_FOLDERS = ("usr/lib/*-linux-gnu", "usr/lib64", "usr/lib", "usr/local/lib", "lib64")


def check_egl_library(system: System, drawing: Drawing) -> list[Finding]:
    """Load the library that cubecam loads."""
    chosen = system.environ.get(VARIABLE, "")
    if chosen:
        return [_check_chosen(system, drawing, chosen)]
    problem = system.library_problem(LIBRARY)
    if not problem:
        return [Finding("egl-library", "ok", f"{LIBRARY} can be loaded")]
    places = [place for folder in _FOLDERS for place in system.glob(f"{folder}/{LIBRARY}")]
    if places and "cannot open shared object file" in problem and LIBRARY in problem:
        cure = (
            *as_root(system, "ldconfig"),
            "# or, if that changes nothing:",
            f"export {VARIABLE}={places[0]}",
        )
        text = f"{LIBRARY} lies at {places[0]}, and the loader does not find it: {problem}"
        return [Finding("egl-library", drawing.blocking, text, cure)]
    text = f"{LIBRARY} cannot be loaded: {problem}"
    return [Finding("egl-library", drawing.blocking, text, install_mesa(system))]


def _check_chosen(system: System, drawing: Drawing, chosen: str) -> Finding:
    problem = system.library_problem(chosen)
    if not problem:
        return Finding("egl-library", "ok", f"{VARIABLE}={chosen} can be loaded")
    other = system.library_problem(LIBRARY)
    # The usual one may be missing, too.
    cure = (f"unset {VARIABLE}", *(install_mesa(system) if other else ()))
    text = f"{VARIABLE}={chosen} cannot be loaded: {problem}"
    return Finding("egl-library", drawing.blocking, text, cure)
