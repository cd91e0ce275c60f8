"""An NVIDIA GPU whose driver has no EGL here: a container without the right to draw, or a driver for computing only."""

from __future__ import annotations

import re

from .drawing import Drawing
from .findings import Finding
from .packages import install_nvidia
from .surroundings import container_sign, in_wsl
from .system import Ran, System
from .vendors import library_of, vendor_file_cure, vendor_files

__all__ = ["check_nvidia", "nvidia_cure", "nvidia_signs"]

LIBRARY = "libEGL_nvidia.so.0"
CAPABILITIES = "NVIDIA_DRIVER_CAPABILITIES"


def nvidia_signs(system: System) -> list[str]:
    """List what says that there is an NVIDIA GPU that this system may use."""
    return _signs(system, system.run(["nvidia-smi", "-L"]))


def _signs(system: System, smi: Ran) -> list[str]:
    files = [name for name in ("/dev/nvidia0", "/dev/nvidiactl") if system.exists(name)]
    return [*files, "nvidia-smi"] if smi.code == 0 else files


def nvidia_cure(system: System) -> tuple[str, ...]:
    """Say how this system gets NVIDIA's EGL."""
    if container_sign(system):
        if _may_draw(system):
            return (
                "# the host's driver has no EGL; on the host, install the OpenGL part of NVIDIA's driver,",
                "# such as libnvidia-gl-NUMBER on Ubuntu, and start the container again",
            )
        return (
            "# start the container with the right to draw (NVIDIA Container Toolkit on the host):",
            f"docker run --gpus all -e {CAPABILITIES}=all IMAGE",
            "# or, in the image's Dockerfile:",
            f"ENV {CAPABILITIES}=all",
        )
    return install_nvidia(system, _branch(system))


def _may_draw(system: System) -> bool:
    """Say whether this container was started with NVIDIA's right to draw."""
    words = system.environ.get(CAPABILITIES, "").replace(" ", "").split(",")
    return "graphics" in words or "all" in words


def check_nvidia(system: System, drawing: Drawing) -> list[Finding]:
    """Look for NVIDIA's EGL where there is an NVIDIA GPU."""
    if in_wsl(system):
        return []  # the driver is that of Windows, reached by Mesa's d3d12; NVIDIA's for Linux must not be installed
    ran = system.run(["nvidia-smi", "-L"])
    if ran.code not in (0, None) and "mismatch" in (ran.out + ran.err).lower():
        text = "NVIDIA's libraries and its kernel module have different versions: " + _line(
            ran.out + ran.err
        )
        return [
            Finding(
                "nvidia",
                drawing.blocking,
                text,
                ("# restart the machine, or load the module again",),
            )
        ]
    signs = _signs(system, ran)  # nvidia-smi takes seconds where nothing keeps the driver awake
    if not signs:
        return []
    where = ", ".join(signs)
    libraries = [library_of(system, file) or "" for file in vendor_files(system)]
    if any("nvidia" in library for library in libraries):
        return [Finding("nvidia", "ok", f"an NVIDIA GPU ({where}) with a vendor file of EGL")]
    if system.environ.get("__EGL_VENDOR_LIBRARY_FILENAMES"):
        text = f"an NVIDIA GPU ({where}), left out by __EGL_VENDOR_LIBRARY_FILENAMES"
        return [Finding("nvidia", "warning", text, ("unset __EGL_VENDOR_LIBRARY_FILENAMES",))]
    if not system.library_problem(LIBRARY):
        text = f"an NVIDIA GPU ({where}) and {LIBRARY}, and no vendor file that names it"
        cure = vendor_file_cure(system, "10_nvidia.json", LIBRARY)
        return [Finding("nvidia", "warning", text, cure)]
    text = f"an NVIDIA GPU ({where}), and no {LIBRARY}: pictures are not drawn on it"
    allowed = system.environ.get(CAPABILITIES)
    if container_sign(system) and not _may_draw(system):
        text += (
            f"; {CAPABILITIES}={allowed} lacks graphics"
            if allowed
            else f"; {CAPABILITIES} is not set"
        )
    return [Finding("nvidia", "warning", text, nvidia_cure(system))]


def _branch(system: System) -> str:
    """The branch of the kernel module, such as "570"; packages of the libraries have it in their names."""
    # Ubuntu's packages of one branch are of two kinds, libnvidia-compute-570 and -570-server, and exclude each other.
    for name in system.glob("/var/lib/dpkg/info/libnvidia-compute-*.list"):
        if installed := re.search(r"libnvidia-compute-(\d+(-server)?)(:\w+)?\.list$", name):
            return installed[1]
    found = re.search(r"Kernel Module.*?\s(\d+)\.\d+", system.read("/proc/driver/nvidia/version"))
    return found[1] if found else ""


def _line(text: str) -> str:
    return next((line.strip() for line in text.splitlines() if line.strip()), "")
