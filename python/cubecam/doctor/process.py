"""Limits of the process, the program that tries shaders, and the folder in which verdicts about shaders are kept."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from .drawing import Drawing
from .findings import Finding
from .module import Installed
from .system import System

__all__ = ["check_cache", "check_helper", "check_limits"]

HELPER = "_shader_trial"
#: What a driver, its compiler and a frame of a million pixels take.
LEAST_MEMORY = 1 << 29
LEAST_FILES = 128
#: The words of the core's notice.
UNAVAILABLE = "the process for trials cannot be started"


def check_helper(drawing: Drawing, folder: Path) -> list[Finding]:
    """Look whether the program that tries users' shaders can be started; without it a broken one ends the process."""
    file = folder / HELPER
    told = [text for text in drawing.warnings if UNAVAILABLE in text]
    if not file.exists():
        text = f"{file} is missing: shaders are compiled without a trial, and a broken one ends the process"
        return [Finding("shader-trial", "warning", text, _again(folder))]
    mode = file.stat().st_mode
    if not mode & stat.S_IXUSR or not os.access(file, os.X_OK):
        text = f"{file} may not be executed: shaders are compiled without a trial"
        return [Finding("shader-trial", "warning", text, (f"chmod +x {file}",))]
    if told:
        reason = told[0].partition("cannot be started: ")[2].partition(". A source")[0]
        text = f"{file} cannot be started: {reason}"
        return [
            Finding(
                "shader-trial", "warning", text, (f"{file}  # what does it print?", *_again(folder))
            )
        ]
    return (
        [Finding("shader-trial", "ok", "shaders are tried in a process of their own")]
        if drawing.works
        else []
    )


def _again(folder: Path) -> tuple[str, ...]:
    return (Installed(folder).reinstall,)


def check_limits(system: System) -> list[Finding]:
    """Look whether memory and files suffice for a driver."""
    import resource  # which Windows lacks

    from .._core import _memory_left

    found = []
    left, limit = _memory_left(str(system.root))
    if left < LEAST_MEMORY:
        text = f"{int(left) >> 20} MiB of memory are left ({limit}): a driver and a large picture take more"
        found.append(Finding("memory", "warning", text, _more_memory(limit)))
    else:
        shown = (
            "memory without a limit"
            if left == float("inf")
            else f"{int(left) >> 20} MiB of memory are left"
        )
        found.append(Finding("memory", "ok", f"{shown} ({limit})"))
    files = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    if files < LEAST_FILES:
        text = f"this process may open {files} files: a driver with its threads needs more"
        found.append(Finding("files", "warning", text, ("ulimit -n 1024",)))
    return found


def _more_memory(limit: str) -> tuple[str, ...]:
    if "control group" in limit:
        return ("# give the container or the service more:", "docker run --memory 4g IMAGE")
    if "RLIMIT_AS" in limit:
        return ("ulimit -v unlimited",)
    if "RLIMIT_DATA" in limit:
        return ("ulimit -d unlimited",)
    return ("# end other programs, or draw smaller pictures",)


def check_cache(system: System) -> list[Finding]:
    """Look whether verdicts about shaders can be kept; without them each program tries its shaders again."""
    cache = system.environ.get("XDG_CACHE_HOME", "")
    home = system.environ.get("HOME", "")
    cure = ("export XDG_CACHE_HOME=/tmp/cache-of-$(id -u)",)
    if cache.startswith("/"):  # the specification ignores relative paths
        folder = cache
    elif home.startswith("/"):
        folder = f"{home.rstrip('/')}/.cache"
    else:
        text = "neither XDG_CACHE_HOME nor HOME is set: verdicts about shaders are not kept, nor is Mesa's cache"
        return [Finding("cache", "note", text, cure)]
    folder = f"{folder}/cubecam"
    nearest = folder
    while not system.exists(nearest):
        nearest = nearest.rpartition("/")[0] or "/"
    if not system.may(nearest, os.W_OK | os.X_OK) or not system.path(nearest).is_dir():
        text = f"{folder} cannot be written ({nearest}): each program tries its shaders again"
        return [Finding("cache", "note", text, cure)]
    return [Finding("cache", "ok", f"verdicts about shaders are kept in {folder}")]
