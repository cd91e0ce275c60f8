"""`cubecam capture-many`: capture a scene from many places into a Zarr store, by this machine or by a cluster."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..typing import Format
from .common import (
    FILE,
    NUMBER,
    WholeNumber,
    choice,
    device_option,
    failures_reported,
    sample_light,
    warnings_reported,
    words,
)
from .help import Command, argument, option

if TYPE_CHECKING:
    from .. import Scene


class _Resources(click.ParamType):
    """Names and numbers, as in GPU=1."""

    name = "resources"

    def convert(self, value: Any, param: Any, ctx: Any) -> dict[str, float]:
        if isinstance(value, dict):
            return value
        found = {}
        for part in str(value).split(","):
            name, sign, number = part.partition("=")
            if not sign or not name.strip():
                self.fail(f"expected names and numbers as GPU=1, got {str(value)!r}", param, ctx)
            found[name.strip()] = NUMBER.convert(number, param, ctx)
        return found


@click.command("capture-many", cls=Command)
@argument(
    "scene",
    type=FILE,
    metavar="FILE",
    help="A Python script that makes `scene`, a cc.Scene, and, without --positions, `positions`; if it makes "
    "`rotations`, they turn the cubes. Or a scene: a GLB, glTF, OBJ, PLY, STL or OFF file.",
)
@option(
    "--output",
    "-o",
    type=FILE,
    metavar="STORE",
    default="captures.zarr",
    help="The Zarr store to write, or to go on with.",
)
@option(
    "--positions",
    "-p",
    type=FILE,
    metavar="FILE",
    help="The places: a .npy file with an array (P, 3), or a .csv file with x, y and z in each line.",
    note="those of the script",
)
@option(
    "--size", "-s", type=WholeNumber(1), metavar="TEXELS", default=256, help="Texels along a face."
)
@option(
    "--outputs",
    metavar="NAMES",
    default="",
    help="Further numbers of each texel, separated by commas, such as distance,normal,id.",
)
@option("--format", "form", **choice(Format), default="rgba16f", help=f"{words(Format)}.")
@option("--samples", type=WholeNumber(1), metavar="COUNT", default=1, help="Samples of each texel.")
@option("--near", type=NUMBER, metavar="NUMBER", default=0.05, help="Nearest distance drawn.")
@option("--far", type=NUMBER, metavar="NUMBER", default=1000.0, help="Farthest distance drawn.")
@option(
    "--chunk",
    type=WholeNumber(1),
    metavar="COUNT",
    default=64,
    help="Places that are drawn at once and make one file of each array.",
)
@option(
    "--workers",
    type=WholeNumber(1),
    metavar="COUNT",
    group="Who draws",
    help="Processes of this machine.",
    note="this process",
)
@option(
    "--scheduler",
    metavar="ADDRESS",
    group="Who draws",
    help="The scheduler of a Dask cluster, such as tcp://host:8786, or its scheduler file (.json).",
)
@option(
    "--resources",
    type=_Resources(),
    metavar="NAMES",
    group="Who draws",
    help="With --scheduler: what a chunk takes of a worker, such as GPU=1.",
)
@option("--no-resume", is_flag=True, help="Fail if there is a store, instead of going on with it.")
@option("--overwrite", is_flag=True, help="Begin anew if there is a store.")
@device_option
def capture_many(
    scene: str,
    output: str,
    positions: str | None,
    size: int,
    outputs: str,
    form: Format,
    samples: int,
    near: float,
    far: float,
    chunk: int,
    workers: int | None,
    scheduler: str | None,
    resources: dict[str, float] | None,
    no_resume: bool,
    overwrite: bool,
    device: str | None,
) -> None:
    """Capture a scene from many places into a Zarr store.

    What was ended, by Ctrl-C or by a kill, goes on where it was when the same command is given again.

    Example: cubecam capture-many scene.py -o probes.zarr --workers 4
    """
    if workers is not None and scheduler is not None:
        raise click.BadParameter("expected without --scheduler", param_hint="--workers")
    if resources is not None and scheduler is None:
        raise click.BadParameter("expected with --scheduler", param_hint="--resources")
    if device is not None and scheduler is not None:
        raise click.BadParameter(
            "expected without --scheduler: workers of a cluster choose their own",
            param_hint="--device",
        )
    with failures_reported():
        try:
            from ..cluster import capture_to_zarr
        except ImportError as error:
            raise ValueError(str(error)) from error
        if device is not None:
            os.environ["CUBECAM_DEVICE"] = device  # of this process and of those that it starts
        made, places, turns = _read(scene, positions)
        options: dict[str, Any] = {
            "outputs": [name.strip() for name in outputs.split(",") if name.strip()],
            "rotations": turns,
            "near": near,
            "far": far,
            "format": form,
            "samples": samples,
            "chunk": chunk,
            "resume": not no_resume,
            "overwrite": overwrite,
        }
        with warnings_reported(scene):
            try:
                if scheduler is None:
                    batch = capture_to_zarr(made, places, output, size, workers=workers, **options)
                else:
                    with _client(scheduler) as client:
                        batch = capture_to_zarr(
                            made,
                            places,
                            output,
                            size,
                            client=client,
                            resources=resources,
                            **options,
                        )
            except ImportError as error:
                raise ValueError(str(error)) from error
        click.echo(output)
        click.echo(f"{len(batch)} cubemaps of 6 x {size} x {size} texels")


def _client(scheduler: str) -> Any:
    try:
        from distributed import Client
    except ImportError as error:
        raise ValueError(
            '--scheduler: expected the packages of pip install "cubecam[cluster]"'
        ) from error
    where = {"scheduler_file": scheduler} if scheduler.endswith(".json") else {"address": scheduler}
    return Client(**where)


def _read(path: str, positions: str | None) -> tuple[Scene, Any, Any]:
    """Read the scene, the places and the rotations."""
    from .. import Scene
    from ..io.scenes import ENDINGS, load_scene

    places: Any = None if positions is None else _places(positions)
    if Path(path).suffix.lower() in ENDINGS:
        from ..staging.shoot import Shoot

        if places is None:
            raise ValueError(f"--positions: expected with a model, got {path} alone")
        with warnings_reported(path):
            scene = load_scene(path)
        Shoot(scene, None, sample_light)  # which lights a model that has no light
        return scene, places, None
    if Path(path).suffix.lower() != ".py":
        raise ValueError(
            f"expected a Python script (.py) or a scene ({', '.join(ENDINGS)}), got {path}"
        )
    from .view_source import run_script

    names, _ = run_script(path)
    made = names.get("scene")
    if not isinstance(made, Scene):
        got = "" if made is None else f", got {type(made).__name__}"
        raise ValueError(f"{path}: expected a script that makes `scene`, a cc.Scene{got}")
    if places is not None:
        return made, places, None
    if names.get("positions") is None:
        raise ValueError(f"{path}: expected a script that makes `positions`, or --positions")
    return made, names["positions"], names.get("rotations")


def _places(path: str) -> Any:
    """Read an array (P, 3)."""
    import numpy as np

    kind = Path(path).suffix.lower()
    if kind == ".npy":
        places = np.load(path, allow_pickle=False)
    elif kind == ".csv":
        places = _table(path)
    else:
        raise ValueError(f"--positions: expected a .npy or a .csv file, got {path}")
    if places.ndim != 2 or places.shape[1] != 3 or places.dtype.kind not in "iuf":
        raise ValueError(
            f"--positions: expected numbers of shape (P, 3) in {path}, got {places.dtype} {places.shape}"
        )
    return places


def _table(path: str) -> Any:
    """Read lines of three numbers; a first line without numbers has the names of the columns."""
    import numpy as np

    rows = []
    with Path(path).open(newline="", encoding="utf-8") as file:
        for number, row in enumerate(csv.reader(file), 1):
            if not row:
                continue
            try:
                x, y, z = map(float, row)
            except ValueError:
                if number == 1 and len(row) == 3:
                    continue
                raise ValueError(
                    f"{path}:{number}: expected three numbers, got {','.join(row)!r}"
                ) from None
            rows.append((x, y, z))
    return np.array(rows, np.float64).reshape(-1, 3)
