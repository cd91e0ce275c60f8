"""The command `cubecam`: info, demo, convert, capture, example.

Exit codes: 0 for success; 1 for an error, with a message; 2 for a command that is not valid.
"""

from __future__ import annotations

import platform
from typing import Annotated, Any

import typer
from rich.console import Console

from .. import ContextError, Renderer, __version__, devices
from . import capture, convert, example
from .common import DeviceOption, fail, failures_reported, parse_device

__all__ = ["app", "main"]

app = typer.Typer(
    name="cubecam",
    help="Headless cubemap renderer: scenes, photographs and meshes to cubemaps, panoramas and pictures.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"cubecam {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version and exit."
        ),
    ] = False,
) -> None:
    """Headless cubemap renderer: scenes, photographs and meshes to cubemaps, panoramas and pictures."""


def _describe(chosen: Any) -> list[str]:
    """Describe the device and the limits of a renderer, in lines."""
    limits = chosen.limits
    return [
        f"chosen: {chosen.renderer} ({'software' if chosen.software else 'GPU'}, {chosen.vendor})",
        f"OpenGL {chosen.version}, GLSL {chosen.glsl_version}, EGL {chosen.egl_version}, {chosen.platform} platform",
        f"all views of a mesh in one call: {'yes' if chosen.layered else 'no'}",
        f"largest frame: {limits.max_texture_size}, largest face: {limits.max_cube_map_texture_size}",
        f"most layers: {limits.max_array_texture_layers}, most samples: {limits.max_samples}",
    ]


@app.command()
def info(device: DeviceOption = None) -> None:
    """Print the versions, the devices, and the limits of the chosen device."""
    console = Console(soft_wrap=True)
    console.print(
        f"cubecam {__version__}, Python {platform.python_version()}, {platform.platform()}",
        highlight=False,
    )
    with failures_reported():
        for item in devices():
            told = [
                item.vendor,
                item.driver,
                "software" if item.software else "GPU",
                f"{item.platform} platform",
                f"UUID {item.uuid}" if item.uuid else "",
                f"CUDA {item.cuda_index}" if item.cuda_index is not None else "",
                item.problem,
            ]
            line = f"device {item.index}: {item.name}: {', '.join(text for text in told if text)}"
            console.print(line, highlight=False, markup=False)
    try:
        with Renderer(device=parse_device(device)) as renderer:
            for line in _describe(renderer.info):
                console.print(line, highlight=False, markup=False)
    except (ContextError, ValueError) as error:
        fail(error)


@app.command()
def demo(
    out: Annotated[str, typer.Option("--out", "-o", help="The folder to write to.")] = "out",
    frames: Annotated[int, typer.Option(min=1, help="Pictures of the animation.")] = 100,
    size: Annotated[
        int, typer.Option(min=1, help="Width of the frame, in pixels; its height is 3/4 of that.")
    ] = 1024,
    device: DeviceOption = None,
) -> None:
    """Render the sample scene: frame, cubemap cross, panorama and animation."""
    from ..demo import run

    with failures_reported():
        run(out, frames=frames, size=size, device=parse_device(device))


app.command("convert")(convert.convert)
app.command("capture")(capture.capture)
app.command("example")(example.example)


def main() -> None:
    """Run the command; the entry point of the console script."""
    app()
