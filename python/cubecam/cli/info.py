"""`cubecam info`: versions, devices, and the limits of the chosen device, as text or as JSON."""

from __future__ import annotations

import platform
from typing import Any

import click

from .. import Error, Renderer, __version__, devices
from .common import complain, describe, device_option, parse_device
from .help import Command, option

_DEVICE = (
    "index", "name", "vendor", "driver", "software", "platform", "uuid", "cuda_index", "drm_node", "problem",
)  # fmt: skip
_CHOSEN = (
    "renderer", "vendor", "version", "glsl_version", "egl_version", "platform", "software", "layered",
)  # fmt: skip
_LIMITS = (
    "max_frame_size", "max_face_size", "max_texture_size", "max_cube_map_texture_size",
    "max_array_texture_layers", "max_samples", "max_color_attachments",
)  # fmt: skip


@click.command(cls=Command)
@option("--json", "as_json", is_flag=True, help="Print one JSON object, also if no device works.")
@device_option
def info(device: str | None, as_json: bool) -> None:
    """Print versions, devices, and the limits of the chosen device."""
    found: dict[str, Any] = {
        "cubecam": __version__,
        "python": platform.python_version(),
        "system": platform.platform(),
        "devices": [],
        "chosen": None,
        "limits": None,
        "error": None,
    }
    if not as_json:
        click.echo(f"cubecam {__version__}, Python {found['python']}, {found['system']}")
    try:
        for item in devices():
            found["devices"].append(_members(item, _DEVICE))
            if not as_json:
                click.echo(_device_line(item))
        with Renderer(device=parse_device(device)) as renderer:
            chosen = renderer.info
            found["chosen"] = {"device": chosen.device.index, **_members(chosen, _CHOSEN)}
            found["limits"] = _members(chosen.limits, _LIMITS)
            if not as_json:
                click.echo("\n".join(_chosen_lines(chosen)))
    except (Error, ValueError, OSError) as error:
        found["error"] = describe(error)
    if as_json:
        import json

        click.echo(json.dumps(found, indent=2))
    elif found["error"]:
        complain(found["error"])
    if found["error"]:
        raise SystemExit(1)


def _members(thing: Any, names: tuple[str, ...]) -> dict[str, Any]:
    return {name: getattr(thing, name) for name in names}


def _device_line(item: Any) -> str:
    told = [
        item.vendor,
        item.driver,
        "software" if item.software else "GPU",
        f"{item.platform} platform",
        f"UUID {item.uuid}" if item.uuid else "",
        f"CUDA {item.cuda_index}" if item.cuda_index is not None else "",
        item.problem,
    ]
    return f"device {item.index}: {item.name}: {', '.join(text for text in told if text)}"


def _chosen_lines(chosen: Any) -> list[str]:
    """Describe the device and the limits of a renderer."""
    limits = chosen.limits
    return [
        f"chosen: {chosen.renderer} ({'software' if chosen.software else 'GPU'}, {chosen.vendor})",
        f"OpenGL {chosen.version}, GLSL {chosen.glsl_version}, EGL {chosen.egl_version}, {chosen.platform} platform",
        f"all views of a mesh in one call: {'yes' if chosen.layered else 'no'}",
        f"largest frame: {limits.max_frame_size}, largest face: {limits.max_face_size}",
        f"most layers: {limits.max_array_texture_layers}, most samples: {limits.max_samples}",
    ]
