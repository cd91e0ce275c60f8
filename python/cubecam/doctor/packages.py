"""Which packages of a distribution bring what EGL needs, and the commands that install them."""

from __future__ import annotations

from dataclasses import dataclass

from .rights import as_root
from .system import System, os_release

__all__ = ["install_mesa", "install_nvidia"]


@dataclass(frozen=True)
class _Distribution:
    names: frozenset[str]  # of ID and ID_LIKE in /etc/os-release
    update: str  # what must be run before, without root's rights in front
    install: str
    mesa: str  # the EGL library, Mesa's part of it, and the software driver
    nvidia: str  # the GL part of NVIDIA's driver; {branch} is the driver's branch, such as 535
    source: str = ""  # where that package is, if not in the distribution itself


_DISTRIBUTIONS = (
    _Distribution(
        frozenset({"ubuntu"}),
        "apt-get update",
        "apt-get install -y",
        "libegl1 libegl-mesa0 libgl1-mesa-dri",
        "libnvidia-gl-{branch}",
    ),
    _Distribution(
        frozenset({"debian"}),
        "apt-get update",
        "apt-get install -y",
        "libegl1 libegl-mesa0 libgl1-mesa-dri",
        "nvidia-egl-icd",
        "in Debian's components contrib and non-free",
    ),
    _Distribution(
        frozenset({"fedora", "rhel", "centos", "almalinux", "rocky", "amzn"}),
        "",
        "dnf install -y",
        "libglvnd-egl mesa-libEGL mesa-dri-drivers",
        "xorg-x11-drv-nvidia-libs",
        "of RPM Fusion; in NVIDIA's own repository it is called nvidia-driver-libs",
    ),
    _Distribution(
        frozenset({"arch", "archlinux", "manjaro"}),
        "",
        "pacman -S --needed --noconfirm",
        "libglvnd mesa",
        "nvidia-utils",
    ),
    _Distribution(frozenset({"alpine"}), "", "apk add", "mesa-egl mesa-dri-gallium", ""),
    _Distribution(
        frozenset({"suse", "opensuse", "opensuse-leap", "opensuse-tumbleweed", "sles"}),
        "",
        "zypper install -y",
        "libglvnd Mesa-libEGL1 Mesa-dri",
        "nvidia-gl-G06",
        "of NVIDIA's repository for openSUSE",
    ),
)


def install_mesa(system: System) -> tuple[str, ...]:
    """Give the commands that install libEGL.so.1, Mesa's EGL and its software driver."""
    known = _distribution(system)
    if known is None:
        return (
            "# install libEGL.so.1, libEGL_mesa.so.0 and Mesa's drivers, often called libglvnd and mesa",
        )
    return _commands(system, known, known.mesa)


def install_nvidia(system: System, branch: str) -> tuple[str, ...]:
    """Give the commands that install libEGL_nvidia.so.0.

    `branch` is that of the driver, such as "535" or "535-server"; "" if it is not known.
    """
    known = _distribution(system)
    if known is None or not known.nvidia or ("{branch}" in known.nvidia and not branch):
        return (
            "# install the OpenGL part of NVIDIA's driver: libEGL_nvidia.so.0 and 10_nvidia.json",
        )
    where = (f"# {known.nvidia} is {known.source}:",) if known.source else ()
    return (*where, *_commands(system, known, known.nvidia.format(branch=branch)))


def _distribution(system: System) -> _Distribution | None:
    release = os_release(system)
    own = release.get("ID", "").lower()
    like = release.get("ID_LIKE", "").lower().split()
    for name in (own, *like):
        for known in _DISTRIBUTIONS:
            if name in known.names:
                return known
    return None


def _commands(system: System, known: _Distribution, packages: str) -> tuple[str, ...]:
    first = (known.update,) if known.update else ()
    return as_root(system, *first, f"{known.install} {packages}")
