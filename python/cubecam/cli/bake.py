"""`cubecam bake`: the light of a photograph, or of a place in a scene, written for another program."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import click

from .common import (
    FILE,
    NUMBER,
    SAMPLE_LIGHT,
    WholeNumber,
    choice,
    device_option,
    failures_reported,
    parse_device,
    sample_light,
    warnings_reported,
    words,
)
from .help import Command, argument, option
from .preview import preview, preview_option

if TYPE_CHECKING:
    from .. import CubeMap, Node, Scene

Program: TypeAlias = Literal["three", "babylon", "unity", "godot", "blender", "filament"]


@click.command(cls=Command)
@argument(
    "source",
    type=FILE,
    metavar="FILE",
    help="A panorama or a cubemap (for six files, a name with {face}), the name of a sample photograph, such as "
    "studio; or a scene: a GLB, glTF, OBJ, PLY, STL or OFF file.",
)
@option("--output", "-o", type=FILE, metavar="FOLDER", default="baked", help="The folder to write to.")  # fmt: skip
@option("--for", "program", **choice(Program), default="three", help=f"{words(Program)}.")
@option(
    "--at",
    metavar="PLACE",
    group="Of a scene",
    help="Where the light is caught: 0,1.5,0, or the name of a node, which is left out of the picture.",
    note="the middle of the scene",
)
@option(
    "--environment",
    "-e",
    metavar="FILE",
    group="Of a scene",
    help="The light from all around, as for cubecam render.",
    note=f"the file's own lights and environment, or {Path(SAMPLE_LIGHT).stem} if it has none",
)
@option(
    "--size",
    "-s",
    type=WholeNumber(8),
    metavar="TEXELS",
    default=256,
    help="Texels along a face.",
)
@option(
    "--samples",
    type=WholeNumber(1),
    metavar="COUNT",
    default=4,
    group="Of a scene",
    help="Samples of each texel.",
)
@preview_option
@device_option
def bake(
    source: str,
    output: str,
    program: Program,
    at: str | None,
    environment: str | None,
    size: int,
    samples: int,
    no_preview: bool,
    device: str | None,
) -> None:
    """Write the light of a photograph, or of a place in a scene, for another program.

    A README says how to load it. Light for Babylon.js is filtered by roughness; the others filter it themselves.

    Examples: cubecam bake studio --for babylon; cubecam bake room.glb --at Lamp -o light
    """
    from ..io.scenes import ENDINGS

    is_scene = Path(source).suffix.lower() in ENDINGS
    if not is_scene:
        for name, value in {"--at": at, "--environment": environment}.items():
            if value is not None:
                told = f"expected with a scene ({', '.join(ENDINGS)}), got {source}"
                raise click.BadParameter(told, param_hint=name)
    with failures_reported():
        told = ""
        if is_scene:
            cube, told = _caught(source, at, environment, size, samples, device)
        else:
            from .render import environment_of

            with warnings_reported(source):
                cube = environment_of(source)
            if cube.size != size:
                cube = cube.resize(size)
        Path(output).mkdir(parents=True, exist_ok=True)
        for path in cube.save_for(program, output):
            click.echo(path)
        if not no_preview:
            from .. import to_screen

            preview(to_screen(cube.to_equirect(width=256)))
        click.echo(f"6 x {size} x {size} texels for {program}{told}")


def _caught(
    source: str,
    at: str | None,
    environment: str | None,
    size: int,
    samples: int,
    device: str | None,
) -> tuple[CubeMap, str]:
    """Capture a scene from one place; say from where."""
    import numpy as np

    from .. import CubeMap, Renderer
    from ..io.scenes import load_scene
    from ..staging.fit import Extent
    from ..staging.shoot import Shoot
    from .render import environment_of

    with warnings_reported(source):
        scene = load_scene(source)
    around = None if environment is None else environment_of(environment)
    shoot = Shoot(scene, around, sample_light)
    low, high = Extent.box(shoot.nodes)
    place, left_out = _place(scene, at, (low + high) / 2)
    length = float(np.linalg.norm(high - low) + np.linalg.norm(place - (low + high) / 2))
    with Renderer(device=parse_device(device)) as renderer:
        cube = renderer.capture(
            scene,
            position=place,
            size=size,
            near=max(length * 1e-4, 1e-6),
            far=max(length * 4, 1.0),
            samples=min(samples, renderer.info.limits.max_samples),
            exclude=left_out,
            format="rgba32f",
        )
    where = f", from {', '.join(f'{x:.3g}' for x in place)}"
    without = f", without {left_out[0].name}" if left_out else ""
    # What a program lights by has no alpha.
    return CubeMap(cube.faces[..., :3], encoding="linear"), where + without


def _place(scene: Scene, at: str | None, middle: Any) -> tuple[Any, list[Node]]:
    """Read a place: three numbers, or a node's name; a node is left out of what is caught."""
    import numpy as np

    if at is None:
        return middle, []
    named = [node for node in scene.nodes if node.name == at]
    if named:
        bounds = np.asarray(named[0].world_bounds, np.float64)
        if np.isfinite(bounds).all():
            return bounds.mean(axis=0), named[:1]
        return np.asarray(named[0].world_matrix, np.float64)[:3, 3], named[:1]
    parts = at.split(",")
    if len(parts) == 3:
        return np.array([NUMBER.convert(part, None, None) for part in parts]), []
    names = [node.name for node in scene.nodes if node.name]
    listed = ", ".join(dict.fromkeys(names[:20])) or "no name, in this file"
    raise ValueError(f"--at: expected three numbers as 0,1.5,0, or one of {listed}; got {at}")
