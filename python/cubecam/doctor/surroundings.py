"""Where the program runs: in a container, in WSL, beside which GPUs."""

from __future__ import annotations

from .findings import Finding
from .system import System, os_release

__all__ = ["check_surroundings", "container_sign", "graphics_cards", "in_wsl"]

#: PCI vendors of GPUs that draw; the small ones of servers (ASPEED, Matrox) and virtual ones do not count.
_VENDORS = {"0x10de": "NVIDIA", "0x1002": "AMD", "0x8086": "Intel"}
#: Words of a path in /proc/1/cgroup that say which program made the container.
_MAKERS = ("docker", "kubepods", "containerd", "libpod", "lxc")


def container_sign(system: System) -> str:
    """Give what says that this is a container; "" if nothing does."""
    for name in ("/.dockerenv", "/run/.containerenv"):
        if system.exists(name):
            return name
    if system.environ.get("container"):
        return f"container={system.environ['container']}"
    if system.environ.get("KUBERNETES_SERVICE_HOST"):
        return "KUBERNETES_SERVICE_HOST"
    words = system.read("/proc/1/cgroup")
    return next((f"{maker} in /proc/1/cgroup" for maker in _MAKERS if maker in words), "")


def in_wsl(system: System) -> bool:
    """Say whether this is the Windows Subsystem for Linux."""
    return "microsoft" in system.read("/proc/version").lower()


def graphics_cards(system: System) -> list[str]:
    """List the GPUs on the PCI bus, such as "NVIDIA (0000:01:00.0)"; a container sees those of its host, too."""
    found = []
    for name in system.glob("/sys/bus/pci/devices/*/class"):
        folder = name.rpartition("/")[0]
        vendor = _VENDORS.get(system.read(f"{folder}/vendor").strip())
        # 0x03: display controllers; NVIDIA's cards for data centres are 3D controllers, 0x0302.
        if vendor and system.read(name).strip().startswith("0x03"):
            found.append(f"{vendor} ({folder.rpartition('/')[2]})")
    return found


def check_surroundings(system: System) -> list[Finding]:
    """Say what kind of system this is."""
    release = os_release(system).get("PRETTY_NAME", "a Linux without /etc/os-release")
    parts = [release, system.machine]
    sign = container_sign(system)
    if sign:
        parts.append(f"in a container ({sign})")
    wsl = in_wsl(system)
    if wsl:
        parts.append("in WSL")
    found = [Finding("system", "ok", ", ".join(parts))]
    return [*found, _wsl(system)] if wsl else found


def _wsl(system: System) -> Finding:
    if not system.exists("/dev/dxg"):
        if container_sign(system):
            text = "a container in WSL without /dev/dxg: pictures are drawn in software"
            share = "docker run --device /dev/dxg --volume /usr/lib/wsl:/usr/lib/wsl IMAGE"
            return Finding("wsl", "note", text, ("# for the GPU of Windows:", share))
        return Finding(
            "wsl",
            "note",
            "WSL without /dev/dxg: Windows gives it no GPU, and pictures are drawn in software",
            ("# in PowerShell, for a GPU: wsl --update, then wsl --shutdown",),
        )
    return Finding(
        "wsl",
        "note",
        "WSL with /dev/dxg: Mesa's driver d3d12 can draw on the GPU of Windows",
        (
            "# to draw on the GPU:",
            "export GALLIUM_DRIVER=d3d12 LD_LIBRARY_PATH=/usr/lib/wsl/lib",
            "# to draw in software, which is the same on every machine:",
            "export LIBGL_ALWAYS_SOFTWARE=1",
        ),
    )
