"""The files by which libglvnd finds the EGL of each driver: 10_nvidia.json, 50_mesa.json.

libglvnd, src/EGL/icd_enumeration.md: __EGL_VENDOR_LIBRARY_FILENAMES names files, otherwise
__EGL_VENDOR_LIBRARY_DIRS names folders, otherwise two folders of the system are read.
"""

from __future__ import annotations

import json

from .drawing import Drawing
from .findings import Finding
from .packages import install_mesa
from .rights import as_root
from .system import System

__all__ = [
    "DEFAULT_FOLDERS",
    "check_vendors",
    "has_glvnd",
    "library_of",
    "vendor_file_cure",
    "vendor_files",
]

DEFAULT_FOLDERS = ("/etc/glvnd/egl_vendor.d", "/usr/share/glvnd/egl_vendor.d")
FILENAMES = "__EGL_VENDOR_LIBRARY_FILENAMES"
FOLDERS = "__EGL_VENDOR_LIBRARY_DIRS"
MESA = "libEGL_mesa.so.0"


def has_glvnd(system: System) -> bool:
    """Say whether libEGL.so.1 is libglvnd's; that of Alpine Linux is Mesa's own, which reads no vendor files."""
    return not system.library_problem("libGLdispatch.so.0")


def vendor_files(system: System) -> list[str]:
    """List the files that libglvnd reads on this system, those that do not exist left out."""
    names = system.environ.get(FILENAMES)
    if names:
        return [name for name in names.split(":") if name and system.exists(name)]
    return [name for folder in _folders(system) for name in system.glob(f"{folder}/*.json")]


def library_of(system: System, file: str) -> str | None:
    """Give the library that a vendor file names; None if it names none."""
    try:
        return str(json.loads(system.read(file))["ICD"]["library_path"])
    except (ValueError, KeyError, TypeError):
        return None


def vendor_file_cure(system: System, name: str, library: str) -> tuple[str, ...]:
    """Give the commands that write a vendor file for a library."""
    folder = DEFAULT_FOLDERS[1]
    text = json.dumps({"file_format_version": "1.0.0", "ICD": {"library_path": library}})
    return as_root(system, f"mkdir -p {folder}", f"echo '{text}' | tee {folder}/{name}")


def check_vendors(system: System, drawing: Drawing) -> list[Finding]:
    """Read the vendor files, and load the library that each names."""
    if system.environ.get("CUBECAM_EGL_LIBRARY") or not has_glvnd(system):
        return []
    wrong = _check_variables(system, drawing)
    if wrong:
        return wrong
    files = vendor_files(system)
    if not files:
        folders = " or ".join(_folders(system))
        text = f"no driver: there is no vendor file in {folders}"
        # The library may be there without its file, which a package that is installed does not bring again.
        there = not system.library_problem(MESA)
        cure = vendor_file_cure(system, "50_mesa.json", MESA) if there else install_mesa(system)
        return [Finding("egl-vendors", drawing.blocking, text, cure)]
    found, sound = [], []
    for file in files:
        library = library_of(system, file)
        if library is None:
            text = f'{file}: expected {{"ICD": {{"library_path": ...}}}}, got another text'
            cure = as_root(system, f"rm {file}")
            found.append(Finding("egl-vendors", drawing.blocking, text, cure))
            continue
        problem = system.library_problem(library)
        if problem:
            found.append(_broken(system, drawing, file, library, problem))
        else:
            sound.append(f"{file.rpartition('/')[2]} ({library})")
    if sound:
        # With one driver that can be loaded, others that cannot be only explain why a GPU is not used.
        found = [Finding(f.name, "warning", f.text, f.cure) for f in found]
        found.insert(0, Finding("egl-vendors", "ok", f"drivers: {', '.join(sound)}"))
    return found


def _broken(system: System, drawing: Drawing, file: str, library: str, problem: str) -> Finding:
    if "nvidia" in library:
        from .nvidia import nvidia_cure

        cure = nvidia_cure(system)
    elif "mesa" in library:
        cure = install_mesa(system)
    else:
        cure = (
            f"# install {library}, or remove the file that names it:",
            *as_root(system, f"rm {file}"),
        )
    text = f"{file} names {library}, which cannot be loaded: {problem}"
    return Finding("egl-vendors", drawing.blocking, text, cure)


def _check_variables(system: System, drawing: Drawing) -> list[Finding]:
    names = system.environ.get(FILENAMES)
    if names:
        missing = [name for name in names.split(":") if name and not system.exists(name)]
        if missing:
            text = f"{FILENAMES} names {', '.join(missing)}, which does not exist"
            return [_unset(system, drawing, FILENAMES, text)]
        return []
    folders = system.environ.get(FOLDERS)
    if folders and not vendor_files(system):
        text = f"{FOLDERS}={folders}: there is no vendor file in it"
        return [_unset(system, drawing, FOLDERS, text)]
    return []


def _unset(system: System, drawing: Drawing, variable: str, text: str) -> Finding:
    there = [name for folder in DEFAULT_FOLDERS for name in system.glob(f"{folder}/*.json")]
    then = (f"# without it libglvnd reads {', '.join(there)}",) if there else install_mesa(system)
    return Finding("egl-vendors", drawing.blocking, text, (f"unset {variable}", *then))


def _folders(system: System) -> list[str]:
    named = [name for name in system.environ.get(FOLDERS, "").split(":") if name]
    if named:
        return named
    # libglvnd of conda-forge has its own folder.
    conda = system.environ.get("CONDA_PREFIX")
    return [*DEFAULT_FOLDERS, *([f"{conda}/share/glvnd/egl_vendor.d"] if conda else [])]
