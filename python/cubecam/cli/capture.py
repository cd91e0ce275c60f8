"""`cubecam capture`: capture a mesh file in an environment to a cubemap or a panorama."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, TypeAlias

import typer
from rich.console import Console

from .. import (
    CubeMap,
    GlassMaterial,
    Material,
    MirrorMaterial,
    PhongMaterial,
    PointLight,
    Renderer,
    Scene,
    load_environment,
    load_mesh,
    save_image,
)
from .._core import _shaded_outputs
from ..io.cubemap_names import FACE_NAMES
from ..io.cubemap_save import arrange
from ..typing import Center, Convention, FileLayout
from .common import DeviceOption, failures_reported, parse_device

_OUTPUTS = tuple(_shaded_outputs())
MaterialName: TypeAlias = Literal["phong", "mirror", "glass"]
Triple: TypeAlias = tuple[float, float, float]


def capture(
    mesh: Annotated[str, typer.Argument(help="OBJ, PLY, STL, glTF, GLB or OFF file.")],
    output: Annotated[
        str,
        typer.Option(
            "--output", "-o", help="The picture to write; a name with {face} for six files."
        ),
    ] = "capture.exr",
    environment: Annotated[
        str | None,
        typer.Option(
            "--environment",
            "-e",
            help="Panorama or cubemap file; for six files, a name with {face}.",
        ),
    ] = None,
    srgb: Annotated[
        bool, typer.Option("--srgb", help="8 bit files that are read or written are sRGB-encoded.")
    ] = False,
    position: Annotated[
        Triple, typer.Option("--position", "-p", help="The position of the capture: X Y Z.")
    ] = (0, 0, 0),
    mesh_position: Annotated[Triple, typer.Option(help="The position of the mesh: X Y Z.")] = (
        0,
        0,
        0,
    ),
    mesh_size: Annotated[
        float | None,
        typer.Option(
            help="Center the mesh and scale its largest extent to this size. Default: as in the file."
        ),
    ] = None,
    material: Annotated[MaterialName, typer.Option("--material", "-m")] = "phong",
    color: Annotated[Triple, typer.Option(help="Colour (phong) or tint: R G B, linear.")] = (
        0.8,
        0.8,
        0.8,
    ),
    light: Annotated[Triple, typer.Option(help="The position of the point light: X Y Z.")] = (
        5,
        5,
        5,
    ),
    size: Annotated[int, typer.Option("--size", "-s", min=1, help="Texels along a face.")] = 256,
    samples: Annotated[int, typer.Option(min=1, help="Samples of each texel.")] = 1,
    layout: Annotated[
        FileLayout | None,
        typer.Option("--layout", "-l", help="Default: cross; faces for an output with {face}."),
    ] = None,
    convention: Annotated[
        Convention | None, typer.Option("--convention", "-c", help="Default: gl.")
    ] = None,
    center: Annotated[Center, typer.Option(help="The middle of an equirect.")] = "-z",
    width: Annotated[
        int | None, typer.Option(min=2, help="Width of an equirect. Default: 4 times --size.")
    ] = None,
    outputs: Annotated[
        str,
        typer.Option(
            help="Further outputs, written to EXR files named after the output: "
            f"any of {', '.join(_OUTPUTS)}, separated by commas."
        ),
    ] = "",
    near: Annotated[float, typer.Option(help="Nearest distance drawn.")] = 0.05,
    far: Annotated[float, typer.Option(help="Farthest distance drawn.")] = 1000.0,
    device: DeviceOption = None,
) -> None:
    """Capture a mesh and an environment to a cubemap or a panorama.

    Example: cubecam capture bunny.obj --mesh-size 1 --mesh-position 0 0 -2 -e studio.exr -o probe.exr --layout equirect
    """
    wanted = layout or ("faces" if "{face}" in output else "cross")
    more = [name.strip() for name in outputs.split(",") if name.strip()]
    _check_options(wanted, output, width, more)
    with failures_reported():
        scene = Scene(environment=load_environment(environment, srgb=srgb) if environment else None)
        scene.add(PointLight(position=light))
        loaded = load_mesh(mesh, size=mesh_size)
        scene.add(loaded, _material(material, color), position=mesh_position)
        with Renderer(device=parse_device(device)) as renderer:
            cube = renderer.capture(
                scene,
                position=position,
                size=size,
                near=near,
                far=far,
                samples=samples,
                outputs=tuple(more),
            )
            drawn_by = str(renderer.info.renderer)
        written = [output]
        cube.save(output, layout=wanted, convention=convention, width=width, center=center)
        for name in more:
            written += _save_output(cube, name, output, wanted, convention or "gl")
        console = Console(soft_wrap=True)
        for path in written:
            console.print(path, markup=False, highlight=False)
        triangles = len(loaded.indices)
        console.print(
            f"{triangles} triangles, 6 x {size} x {size} texels, drawn by {drawn_by}",
            highlight=False,
        )


def _check_options(layout: str, output: str, width: int | None, outputs: list[str]) -> None:
    if (layout == "faces") != ("{face}" in output):
        raise typer.BadParameter(
            f"expected {{face}} in the name for six files only, got {output}", param_hint="--output"
        )
    if width is not None and layout != "equirect":
        raise typer.BadParameter("expected with --layout equirect only", param_hint="--width")
    for name in outputs:
        if name not in _OUTPUTS:
            raise typer.BadParameter(
                f"expected some of {', '.join(_OUTPUTS)}, got {name}", param_hint="--outputs"
            )
    if outputs and layout in ("equirect", "openexr"):
        raise typer.BadParameter(
            f"distances, normals and ids cannot be resampled: expected a layout of whole faces, got {layout}",
            param_hint="--outputs",
        )


def _material(name: MaterialName, color: Triple) -> Material:
    if name == "mirror":
        return MirrorMaterial(tint=color)
    if name == "glass":
        return GlassMaterial(tint=color)
    return PhongMaterial(color=color)


def _save_output(
    cube: CubeMap, name: str, output: str, layout: FileLayout, convention: Convention
) -> list[str]:
    """Write an output as EXR of float or whole numbers, in the layout of the colours."""
    values = getattr(cube, name)
    path = Path(output)
    target = str(path.with_name(f"{path.stem}_{name}.exr"))
    if layout != "faces":
        save_image(target, arrange(values, layout, convention))
        return [target]
    # The column has the faces in their order; it is cut into six pictures.
    column = arrange(values, "column", convention)
    size = column.shape[1]
    for index, face in enumerate(FACE_NAMES[0]):
        save_image(target.replace("{face}", face), column[index * size : (index + 1) * size])
    return [target]
