"""`cubecam capture`: capture a mesh file in an environment to a cubemap or a panorama."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

import click

from .. import (
    CubeMap,
    GlassMaterial,
    Material,
    MirrorMaterial,
    PhongMaterial,
    PointLight,
    Renderer,
    Scene,
)
from .._core import _output_table
from ..typing import Center, Convention, FileLayout
from .common import (
    FILE,
    NUMBER,
    Curve,
    Triple,
    WholeNumber,
    choice,
    device_option,
    failures_reported,
    look_options,
    parse_device,
    warnings_reported,
    words,
)
from .help import Command, argument, option

if TYPE_CHECKING:
    from .. import Mesh

_OUTPUTS = tuple(name for name, shaded, *_ in _output_table() if shaded)
MaterialName: TypeAlias = Literal["phong", "mirror", "glass"]

# How much of the face -Z a mesh covers, from its middle to a side, if no option says where the mesh is.
_COVERED = 0.65
_GREY = 0.18  # the background without --environment and --light: the middle grey of photographers
_SAMPLE = "forest.exr"  # what a mirror shows without --environment


@click.command(cls=Command)
@argument(
    "mesh", type=FILE, metavar="FILE", help="A mesh: an OBJ, PLY, STL, glTF, GLB or OFF file."
)
@option(
    "--output",
    "-o",
    type=FILE,
    metavar="FILE",
    default="capture.exr",
    help="The picture to write; a name with {face} for six files.",
)
@option(
    "--mesh-position",
    type=NUMBER,
    nargs=3,
    metavar="X Y Z",
    help="The position of the mesh.",
    note="in front (-Z) of the capture; 0 0 0 with --position",
)
@option(
    "--mesh-size",
    type=NUMBER,
    metavar="NUMBER",
    help="Center the mesh and scale its largest extent to this size.",
    note="1; as in the file with --position or --mesh-position",
)
@option(
    "--position",
    "-p",
    type=NUMBER,
    nargs=3,
    metavar="X Y Z",
    help="The position of the capture.",
    note="0 0 0",
)
@option(
    "--light",
    type=NUMBER,
    nargs=3,
    metavar="X Y Z",
    help="The position of the point light.",
    note="two lights beside the capture; 5 5 5 with --environment",
)
@option(
    "--environment",
    "-e",
    type=FILE,
    metavar="FILE",
    help="Panorama or cubemap that surrounds the mesh; for six files, a name with {face}.",
    note="none; a sample photograph for a mirror and glass",
)
@option(
    "--from-convention",
    **choice(Convention),
    help=f"How the faces of an --environment are stored: {words(Convention)}.",
    note="gl",
)
@option(
    "--material",
    "-m",
    **choice(MaterialName),
    default="phong",
    help=f"{words(MaterialName)}.",
)
@option(
    "--color",
    type=NUMBER,
    nargs=3,
    metavar="R G B",
    default=(0.8, 0.8, 0.8),
    help="Colour (phong) or tint, linear, from 0 to 1.",
)
@option(
    "--size",
    "-s",
    type=WholeNumber(1),
    metavar="TEXELS",
    default=256,
    help="Texels along a face.",
)
@option("--samples", type=WholeNumber(1), metavar="COUNT", default=1, help="Samples of each texel.")
@option(
    "--layout",
    "-l",
    **choice(FileLayout),
    help=f"{words(FileLayout)}.",
    note="cross; faces for an output with {face}",
)
@option("--convention", "-c", **choice(Convention), help=f"{words(Convention)}.", note="gl")
@option(
    "--center",
    **choice(Center),
    default="-z",
    help=f"The middle of an equirect: {words(Center)}.",
)
@option(
    "--width",
    type=WholeNumber(2),
    metavar="PIXELS",
    help="Width of an equirect.",
    note="4 times --size",
)
@option(
    "--outputs",
    metavar="NAMES",
    default="",
    help="Further outputs, written to EXR files named after the output, in the layout of the picture: "
    f"any of {', '.join(_OUTPUTS)}, separated by commas.",
)
@option("--near", type=NUMBER, metavar="NUMBER", default=0.05, help="Nearest distance drawn.")
@option("--far", type=NUMBER, metavar="NUMBER", default=1000.0, help="Farthest distance drawn.")
@look_options()
@option(
    "--srgb",
    is_flag=True,
    help="Decode an --environment of 8 or 16 bits to linear floats.",
    note="only with phong, whose light is linear, too",
)
@device_option
def capture(
    mesh: str,
    output: str,
    mesh_position: Triple | None,
    mesh_size: float | None,
    position: Triple | None,
    light: Triple | None,
    environment: str | None,
    from_convention: Convention | None,
    material: MaterialName,
    color: Triple,
    size: int,
    samples: int,
    layout: FileLayout | None,
    convention: Convention | None,
    center: Center,
    width: int | None,
    outputs: str,
    near: float,
    far: float,
    exposure: float,
    tonemap: Curve | None,
    srgb: bool,
    device: str | None,
) -> None:
    """Capture a mesh and its surroundings to a cubemap or a panorama.

    Without options the mesh is scaled to 1, placed in front of the capture and lit. An option means exactly what it
    says.

    Example: cubecam capture bunny.obj -e studio.exr -o probe.exr --layout equirect
    """
    wanted = layout or ("faces" if "{face}" in output else "cross")
    more = [name.strip() for name in outputs.split(",") if name.strip()]
    _check_options(wanted, output, width, more)
    with failures_reported():
        place = _Place.of(mesh, position, mesh_position, mesh_size, near)
        scene = Scene()
        # Light and sRGB-encoded numbers in one picture would be encoded together, and look pale.
        decoded = srgb or material == "phong"
        around = None if environment is None else _read(environment, decoded, from_convention)
        scene.add(place.mesh, _material(material, color), position=place.position)
        told = [*place.told, *_surround(scene, around, material, light)]
        if material == "phong":  # a mirror and glass show their surroundings alone
            told += _light(scene, place, light, environment)
        with Renderer(device=parse_device(device)) as renderer:
            cube = renderer.capture(
                scene,
                position=place.capture,
                size=size,
                near=near,
                far=far,
                samples=samples,
                outputs=tuple(more),
            )
            drawn_by = str(renderer.info.renderer)
        written = [output]
        with warnings_reported(output):
            cube.save(
                output,
                layout=wanted,
                convention=convention,
                width=width,
                center=center,
                exposure=exposure,
                tonemap=None if tonemap == "none" else tonemap or "neutral",
            )
        picture = Path(output)
        for name in more:
            target = str(picture.with_name(f"{picture.stem}_{name}.exr"))
            cube.save(
                target,
                layout=wanted,
                convention=convention,
                width=width,
                center=center,
                output=name,
            )
            written.append(target)
        for path in written:
            click.echo(path)
        triangles = len(place.mesh.indices)
        click.echo(f"{triangles} triangles, 6 x {size} x {size} texels, drawn by {drawn_by}")
        if told:
            click.echo(f"by default: {'; '.join(told)}")


@dataclass(frozen=True)
class _Place:
    """Where the capture and the mesh are, to which size the mesh is scaled, and what no option has said."""

    capture: Triple
    position: Triple
    mesh: Mesh
    told: tuple[str, ...]

    @staticmethod
    def of(
        path: str, capture: Triple | None, position: Triple | None, size: float | None, near: float
    ) -> _Place:
        import numpy as np

        from ..io.meshes.load import load_mesh

        if capture is not None or position is not None:
            mesh = load_mesh(path, size=size)
            return _Place(capture or (0, 0, 0), position or (0, 0, 0), mesh, ())
        mesh = load_mesh(path, size=1.0 if size is None else size)
        # The nearest distance at which every vertex is within that part of the face, and behind the near plane.
        aside, ahead = np.abs(mesh.positions[:, :2]).max(axis=1), mesh.positions[:, 2]
        distance = max((ahead + aside / _COVERED).max(), ahead.max() + 2 * near)
        distance = float(f"{distance:.3g}")
        told = ("scaled to 1",) if size is None else ()
        placed = f"the mesh is at 0 0 {-distance:g}, the capture at 0 0 0"
        return _Place((0, 0, 0), (0, 0, -distance), mesh, (*told, placed))


def _read(path: str, srgb: bool, convention: Convention | None) -> CubeMap:
    from ..io.cubemaps import load_environment

    with warnings_reported(path):
        return load_environment(path, srgb=srgb, convention=convention)


def _surround(
    scene: Scene, environment: CubeMap | None, material: str, light: Triple | None
) -> list[str]:
    """Give the scene its environment and background; return what no option has said."""
    from ..data import sample_data
    from ..io.cubemaps import load_environment

    if environment is not None:
        scene.environment = environment
        return []
    if light is not None:
        return []
    if material != "phong":
        scene.environment = load_environment(sample_data(_SAMPLE), size=256)
        return [f"in the sample photograph {_SAMPLE}"]
    scene.background = (_GREY, _GREY, _GREY)
    return ["on a grey background"]


def _light(scene: Scene, place: _Place, light: Triple | None, environment: str | None) -> list[str]:
    """Add the lights; return what no option has said."""
    if light is not None or environment is not None:
        scene.add(PointLight(position=light or (5, 5, 5)))
        return []
    import numpy as np

    # Light from beside the capture reaches what the capture sees, also where it stands inside the mesh.
    eye, corners = np.array(place.capture), place.mesh.positions + np.array(place.position)
    low, high = corners.min(axis=0), corners.max(axis=0)
    outside = np.maximum(np.maximum(low - eye, eye - high), 0)
    reach = float(np.linalg.norm(outside) + 0.1 * (high - low).max())
    for offset, strength in (((0.7, 1.0, 0.3), 0.38), ((-1.0, 0.1, 0.5), 0.15)):
        scene.add(PointLight(position=eye + reach * np.array(offset), intensity=strength))
    return ["lit by two lights beside the capture"]


def _check_options(layout: str, output: str, width: int | None, outputs: list[str]) -> None:
    if (layout == "faces") != ("{face}" in output):
        raise click.BadParameter(
            f"expected {{face}} in the name for six files only, got {output}", param_hint="--output"
        )
    if width is not None and layout != "equirect":
        raise click.BadParameter("expected with --layout equirect only", param_hint="--width")
    for name in outputs:
        if name not in _OUTPUTS:
            raise click.BadParameter(
                f"expected some of {', '.join(_OUTPUTS)}, got {name}", param_hint="--outputs"
            )


def _material(name: MaterialName, color: Triple) -> Material:
    if name == "mirror":
        return MirrorMaterial(tint=color)
    if name == "glass":
        return GlassMaterial(tint=color)
    return PhongMaterial(color=color)
