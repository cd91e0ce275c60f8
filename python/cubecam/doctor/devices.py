"""GPUs that were passed over, and the variables that choose a driver."""

from __future__ import annotations

from .drawing import Drawing
from .findings import Finding, Status
from .surroundings import in_wsl
from .system import System

__all__ = ["check_devices", "check_variables"]

#: Variables that choose Mesa's driver or what it offers; the value says what each does.
_VARIABLES = {
    "LIBGL_ALWAYS_SOFTWARE": "Mesa draws in software, whatever GPU there is",
    "GALLIUM_DRIVER": "Mesa takes this driver and no other",
    "MESA_LOADER_DRIVER_OVERRIDE": "Mesa takes this driver and no other",
    "MESA_GL_VERSION_OVERRIDE": "Mesa offers this version of OpenGL",
    "EGL_PLATFORM": "EGL's default display is of this platform",
}
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "kms_swrast")
_OFF = ("", "0", "false", "n", "no", "f")


def check_devices(system: System, drawing: Drawing, device: str | None) -> list[Finding]:
    """Say which GPUs EGL lists, and why one is not used."""
    gpus = [item for item in drawing.devices if not item["software"]]
    broken = [item for item in gpus if item["problem"]]
    found = [
        Finding(
            "gpu",
            "warning",
            f"device {item['index']} ({item['name']}) is a GPU that does not start: {item['problem']}",
            (
                f"# see what is said about {item['drm_node'] or 'its driver'} here",
                *(("cubecam doctor --device gpu",) if device in (None, "auto") else ()),
            ),
        )
        for item in broken
    ]
    sound = [item for item in gpus if not item["problem"]]
    if sound and drawing.works and drawing.chosen["software"]:
        names = ", ".join(f"device {item['index']} ({item['name']})" for item in sound)
        reason = _why_software(system, device)
        are = "is a GPU" if len(sound) == 1 else "are GPUs"
        text = f"{names} {are} that can be used, and pictures are drawn in software{reason}"
        found.append(
            Finding(
                "gpu", "warning" if not reason else "note", text, ("cubecam doctor --device gpu",)
            )
        )
    elif sound:
        found.append(
            Finding("gpu", "ok", "GPUs: " + ", ".join(str(item["name"]) for item in sound))
        )
    elif drawing.works and not broken:
        found.append(Finding("gpu", "note", "EGL lists no GPU: pictures are drawn in software"))
    return found


def check_variables(system: System, drawing: Drawing, device: str | None) -> list[Finding]:
    """Name the variables that choose a driver; those of a driver that failed are a cause."""
    found = []
    for name, effect in _VARIABLES.items():
        value = system.environ.get(name, "")
        if value.lower() in _OFF:
            continue
        text = f"{name}={value} is set: {effect}"
        # The error of a driver that does not start names the variables that choose it.
        status: Status = "problem" if name in drawing.error else "note"
        # In WSL the doctor itself advises this one.
        wanted = in_wsl(system) and (name, value) == ("GALLIUM_DRIVER", "d3d12") and drawing.works
        found.append(Finding("variables", status, text, () if wanted else (f"unset {name}",)))
    value = system.environ.get("CUBECAM_DEVICE", "")
    if value and device in (None, "auto"):
        text = f"CUBECAM_DEVICE={value} is set: a Renderer takes this device unless its argument names another one"
        # The error of a device that does not exist says where its name comes from.
        status = "problem" if "CUBECAM_DEVICE" in drawing.error else "note"
        found.append(Finding("variables", status, text, ("unset CUBECAM_DEVICE",)))
    return found


def _why_software(system: System, device: str | None) -> str:
    if device not in (None, "auto"):
        return f", as --device {device} says"
    if value := system.environ.get("CUBECAM_DEVICE", ""):
        return f", as CUBECAM_DEVICE={value} says"
    if system.environ.get("LIBGL_ALWAYS_SOFTWARE", "").lower() not in _OFF:
        return ", as LIBGL_ALWAYS_SOFTWARE says"
    for name in ("GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE"):
        if system.environ.get(name) in _SOFTWARE:
            return f", as {name} says"
    return ""
