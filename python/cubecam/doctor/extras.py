"""Packages that only some features need: information, no fault."""

from __future__ import annotations

import importlib.util
import shutil
import sys

from .findings import Finding

__all__ = ["EXTRAS", "check_extras"]

#: Extra: (what it is for, the modules that it brings). The extras of developers are not listed.
EXTRAS: dict[str, tuple[str, tuple[str, ...]]] = {
    "plot": ("cc.plot", ("matplotlib",)),
    "viewer": (
        "cubecam view, scene.show(): pages and terminals",
        ("blessed", "rendercanvas", "simplejpeg", "textual_image", "uvicorn", "websockets"),
    ),
    "window": ("live views in windows", ("rendercanvas", "PySide6")),
    "jupyter": (
        "live views in notebooks",
        (
            "anywidget",
            "ipykernel",
            "ipywidgets",
            "matplotlib",
            "rendercanvas",
            "simplejpeg",
            "trimesh",
        ),
    ),
    "gltf": ("compressed glTF", ("DracoPy", "opengl_basisu", "zstd", "meshopt")),
    "ktx2": ("compressed KTX2", ("opengl_basisu", "zstd")),
    "video": ("MP4 without ffmpeg on PATH", ("imageio_ffmpeg",)),
    "cluster": (
        "captures by clusters of Dask, Zarr stores",
        ("dask", "distributed", "xarray", "zarr"),
    ),
    "truth": (
        "pictures by exact rays, and comparisons with them",
        ("embreex", "flip_evaluator", "skimage", "trimesh"),
    ),
}


def check_extras() -> list[Finding]:
    """Say which extras are there, and which command installs another one."""
    missing = {name: lacks for name in EXTRAS if (lacks := _missing(name))}
    there = [name for name in EXTRAS if name not in missing]
    found = [Finding("extras", "ok", f"installed extras: {', '.join(there)}")] if there else []
    lines = [
        f'pip install "cubecam[{name}]"  # {EXTRAS[name][0]} ({", ".join(lacks)})'
        for name, lacks in missing.items()
    ]
    if lines:
        found.append(
            Finding("extras", "note", "packages that only some features need:", tuple(lines))
        )
    return found


def _missing(extra: str) -> list[str]:
    if extra == "video" and shutil.which("ffmpeg"):
        return []
    return [name for name in EXTRAS[extra][1] if not _is_there(name)]


def _is_there(module: str) -> bool:
    if module == "zstd":  # in the standard library from Python 3.14 on
        return any(map(_is_there, ("compression.zstd", "backports.zstd")))
    if module == "flip_evaluator" and sys.version_info >= (
        3,
        14,
    ):  # no wheel, and cubecam does without
        return True
    try:
        return importlib.util.find_spec(module) is not None
    except (
        ModuleNotFoundError,
        ValueError,
    ):  # the package above it; a module without a specification
        return False
