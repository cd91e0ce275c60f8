"""`cubecam convert`: convert files between layouts, conventions and formats, many files at a time."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar, get_args

import click

from .. import Error, axis_angle
from ..typing import Center, Convention, FileLayout, FisheyeModel, Tonemap
from .common import (
    FILE,
    NUMBER,
    Curve,
    WholeNumber,
    choice,
    complain,
    describe,
    look_options,
    warnings_reported,
    words,
)
from .help import Command, argument, option

if TYPE_CHECKING:
    import numpy as np

    from .. import CubeMap
    from ..typing import Pixels

#: A cube has the methods to_<name> and from_<name> of each.
Projection: TypeAlias = Literal[
    "perspective",
    "fisheye",
    "mirror_ball",
    "angular_map",
    "octahedral",
    "dual_paraboloid",
    "cylindrical",
]
#: How the faces are arranged in files, or a projection that shows the cube.
Arrangement: TypeAlias = Literal[FileLayout, Projection]
_PROJECTIONS: tuple[Projection, ...] = get_args(Projection)
#: The degrees that --fov gives, and what it is for each projection that has one.
_FOVS = {"perspective": 90.0, "fisheye": 180.0, "cylindrical": 360.0}
_FOV_NAMES: TypeAlias = Literal["perspective", "fisheye", "cylindrical"]
_FROM = "Options for reading"
_TO = "Options for writing"

T = TypeVar("T")


class PictureSize(click.ParamType):
    """A whole number, or two as in 640x480."""

    name = "size"

    def convert(self, value: Any, param: Any, ctx: Any) -> int | tuple[int, int]:
        """Parse what was written."""
        parts = str(value).lower().split("x")
        whole = WholeNumber(1)
        if len(parts) == 2 and all(part.isdecimal() and int(part) > 0 for part in parts):
            return int(parts[0]), int(parts[1])
        return whole.convert(value, param, ctx)


@click.command(cls=Command)
@argument(
    "inputs",
    nargs=-1,
    required=True,
    type=FILE,
    metavar="FILE...",
    help="Files to read; for six files, one name with {face}, such as 'sky/{face}.png'.",
)
@option(
    "--output",
    "-o",
    type=FILE,
    metavar="FILE",
    group=_TO,
    help="A file name, a folder, or a name with {name} (the input's) and {face}.",
    note="beside the input, with the layout in the name",
)
@option(
    "--layout",
    "-l",
    **choice(Arrangement),
    group=_TO,
    help=f"{words(FileLayout)}; or a projection: {words(Projection)}.",
    note="cross; faces for an output with {face}",
)
@option(
    "--convention", "-c", **choice(Convention), group=_TO, help=f"{words(Convention)}.", note="gl"
)
@option(
    "--center",
    **choice(Center),
    group=_TO,
    default="-z",
    help=f"The middle of an equirect: {words(Center)}.",
)
@option("--to", metavar="EXTENSION", group=_TO, help="exr, hdr, png, jpg, ...", note="as the input")
@option(
    "--size",
    type=PictureSize(),
    metavar="TEXELS",
    group=_TO,
    help="Texels along a face; of a projection the pixels of an edge, or WIDTHxHEIGHT of a perspective or cylindrical.",
    note="as in the input",
)
@option(
    "--width",
    type=WholeNumber(2),
    metavar="PIXELS",
    group=_TO,
    help="Width of an equirect.",
    note="4 times the texels along a face",
)
@option(
    "--rotate",
    type=NUMBER,
    nargs=4,
    metavar="X Y Z DEGREES",
    group=_TO,
    help="Turn what the cube shows round an axis, counter-clockwise seen from the axis's tip.",
    note="as in the input",
)
@option(
    "--direction",
    type=NUMBER,
    nargs=3,
    metavar="X Y Z",
    group=_TO,
    help="The middle of a projection; of a mirror_ball the camera's direction.",
    note="0 0 -1",
)
@option(
    "--fov",
    type=NUMBER,
    metavar="DEGREES",
    group=_TO,
    help="Field of view: the height of a perspective, the diameter of a fisheye, the width of a cylindrical.",
    note="90, 180, 360",
)
@option(
    "--model",
    **choice(FisheyeModel),
    group=_TO,
    default="equidistant",
    help=f"The lens of a fisheye: {words(FisheyeModel)}.",
)
@look_options("neutral; none for 8 and 16 bit files read with --srgb", _TO)
@option("--half", is_flag=True, group=_TO, help="Store EXR with 16 bits a number.")
@option(
    "--from-layout",
    **choice(Arrangement),
    group=_FROM,
    help="A name of --layout; a projection has -Z in its middle, or is a mirror_ball seen towards -Z.",
    note="by the shape of the picture",
)
@option(
    "--from-convention",
    **choice(Convention),
    group=_FROM,
    help=f"{words(Convention)}.",
    note="as the file says, else gl",
)
@option(
    "--from-center",
    **choice(Center),
    group=_FROM,
    help=f"{words(Center)}.",
    note="as the file says, else -z",
)
@option(
    "--from-fov",
    type=NUMBER,
    metavar="DEGREES",
    group=_FROM,
    help="Field of view of a projection, as --fov.",
    note="90, 180, 360",
)
@option(
    "--from-model",
    **choice(FisheyeModel),
    group=_FROM,
    default="equidistant",
    help="The lens of a fisheye, as --model.",
)
@option(
    "--part",
    metavar="PART",
    group=_FROM,
    help="Which picture of a file that holds several: a number from 0 on, or the name of a part, a view or a layer.",
    note="the first with colours",
)
@option(
    "--srgb",
    is_flag=True,
    group=_FROM,
    help="Decode files of 8 and 16 bits to linear floats, so that they are resampled as light.",
)
def convert(
    inputs: tuple[str, ...],
    output: str | None,
    layout: Arrangement | None,
    convention: Convention | None,
    center: Center,
    to: str | None,
    size: int | tuple[int, int] | None,
    width: int | None,
    rotate: tuple[float, float, float, float] | None,
    direction: tuple[float, float, float] | None,
    fov: float | None,
    model: FisheyeModel,
    exposure: float,
    tonemap: Curve | None,
    half: bool,
    from_layout: Arrangement | None,
    from_convention: Convention | None,
    from_center: Center | None,
    from_fov: float | None,
    from_model: FisheyeModel,
    part: str | None,
    srgb: bool,
) -> None:
    """Convert cubemaps and panoramas to other layouts, projections and files.

    The format of an output follows from its extension, and the layout of an input from its shape. Files that cubecam
    wrote say their convention and centre; for other files give --from-convention if it is not "gl".
    """
    from ..io.cubemaps import load_cubemap
    from ..io.projection_save import save_projection

    names = [_Target(item, output, layout, to) for item in inputs]
    written: dict[str, str] = {}
    for item in names:
        if item.path in written:
            raise click.BadParameter(
                f"{written[item.path]} and {item.source} would both be written to {item.path}; "
                "expected a folder or a name with {name}; six faces are one input, with {face} in its name",
                param_hint="--output",
            )
        written[item.path] = item.source
    if width is not None and any(item.layout != "equirect" for item in names):
        raise click.BadParameter("expected with --layout equirect only", param_hint="--width")
    shown = _projection(layout)
    _check_projection(shown, fov, direction, size)
    _check_fov(_projection(from_layout), from_fov, "--from-fov")
    faces = None if shown or isinstance(size, tuple) else size
    numbered = int(part) if part is not None and part.isdecimal() else part
    failed = 0
    for item in _with_progress(names):
        try:
            with warnings_reported(item.source):
                if read := _projection(from_layout):
                    cube = _load_projection(
                        item.source, read, from_fov, from_model, srgb, numbered, faces
                    )
                else:
                    cube = load_cubemap(
                        item.source,
                        layout=from_layout,  # type: ignore[arg-type]  # no projection
                        convention=from_convention,
                        size=faces,
                        center=from_center,
                        srgb=srgb,
                        part=numbered,
                    )
                if rotate:
                    cube = cube.rotate(axis_angle(rotate[:3], rotate[3]))
            Path(item.path).parent.mkdir(parents=True, exist_ok=True)
            curve = _curve(tonemap, cube, srgb and not _is_light(item.source))
            with warnings_reported(item.path):
                if shown:
                    options = _options(shown, fov, model, direction)
                    if size is not None:
                        options["size"] = size
                    save_projection(
                        cube,
                        item.path,
                        _projected(shown, options),
                        exposure=exposure,
                        tonemap=curve,
                        half=half,
                    )
                else:
                    cube.save(
                        item.path,
                        layout=item.layout,  # type: ignore[arg-type]  # no projection
                        convention=convention,
                        width=width,
                        center=center,
                        exposure=exposure,
                        tonemap=curve,
                        half=half,
                    )
        except (Error, OSError, ValueError, TypeError, MemoryError) as error:
            failed += 1
            text = describe(error)
            complain(text if item.source in text else f"{item.source}: {text}")
        else:
            click.echo(f"{item.source} -> {item.path}")
    if failed:
        if len(names) > 1:
            click.echo(f"{failed} of {len(names)} not converted", err=True)
        raise SystemExit(1)


def _projection(layout: str | None) -> Projection | None:
    return next((name for name in _PROJECTIONS if name == layout), None)


def _check_fov(name: Projection | None, fov: float | None, option: str) -> None:
    if fov is not None and name not in _FOVS:
        raise click.BadParameter(f"expected with {words(_FOV_NAMES)} only", param_hint=option)


def _check_projection(
    name: Projection | None,
    fov: float | None,
    direction: tuple[float, float, float] | None,
    size: int | tuple[int, int] | None,
) -> None:
    """Refuse options that the layout does not have."""
    _check_fov(name, fov, "--fov")
    if direction is not None and name is None:
        raise click.BadParameter("expected with a projection only", param_hint="--direction")
    if isinstance(size, tuple) and name not in ("perspective", "cylindrical"):
        raise click.BadParameter(
            "expected one number, except for perspective and cylindrical", param_hint="--size"
        )


def _options(
    name: Projection,
    fov: float | None,
    model: FisheyeModel,
    direction: tuple[float, float, float] | None = None,
) -> dict[str, Any]:
    """Give the options of the methods to_ and from_ of a projection."""
    options: dict[str, Any] = {}
    if name in _FOVS:
        options["fov"] = _FOVS[name] if fov is None else fov
    if name == "fisheye":
        options["model"] = model
    if direction is not None:
        options["direction"] = direction
        if (
            direction[0] == direction[2] == 0
        ):  # straight up or down: what was ahead is below or above
            options["up"] = (0, 0, 1 if direction[1] > 0 else -1)
    return options


def _projected(
    name: Projection, options: dict[str, Any]
) -> Callable[[CubeMap, np.dtype[Any]], Pixels]:
    """Give the function that makes the picture of a cube."""

    def projected(cube: CubeMap, dtype: np.dtype[Any]) -> Pixels:
        size = {"size": 2 * cube.size} if name == "perspective" else {}
        picture: Pixels = getattr(cube, f"to_{name}")(dtype=dtype, **{**size, **options})
        return picture

    return projected


def _load_projection(
    source: str,
    name: Projection,
    fov: float | None,
    model: FisheyeModel,
    srgb: bool,
    part: int | str | None,
    size: int | None,
) -> CubeMap:
    """Read a picture that a projection made."""
    from .. import CubeMap
    from ..io import formats
    from ..io.picture_files import read_picture

    picture = read_picture(source, part)
    made: CubeMap = getattr(CubeMap, f"from_{name}")(
        formats.decode(picture.pixels, srgb, picture.encoding),
        size=size,
        encoding=formats.encoding_after_decode(picture.pixels, srgb, picture.encoding),
        **_options(name, fov, model),
    )
    return made


def _is_light(source: str) -> bool:
    """Say whether files of this name hold floats, which --srgb leaves as they are."""
    return Path(source).suffix.lower() in (".exr", ".hdr", ".pic", ".rgbe", ".xyze")


def _curve(name: Curve | None, cube: CubeMap, decoded: bool) -> Tonemap | None:
    """Give the tone curve; decoded numbers of a screen have no highlights, so that none keeps them as they are."""
    if name is None and decoded and float(cube.faces[..., :3].max()) <= 1:
        return None
    return None if name == "none" else name or "neutral"


def _with_progress(items: list[T]) -> Iterable[T]:
    """Show a bar on a terminal while several files are converted; lines that are printed stand above it."""
    if len(items) == 1 or not sys.stdout.isatty():
        return items
    from rich.progress import track

    return track(items, description="converting", transient=True)


class _Target:
    """The path and the layout of the output of one input."""

    def __init__(
        self, source: str, output: str | None, layout: Arrangement | None, extension: str | None
    ) -> None:
        self.source = source
        if not Path(source).name:
            raise click.BadParameter(f"expected a file, got {source!r}")
        stem, own = _stem(source), Path(source).suffix
        wanted = "." + extension.lower().lstrip(".") if extension else own
        named = output is not None and (
            Path(output).suffix != "" and not output.endswith("/") and not Path(output).is_dir()
        )
        self.layout: Arrangement = layout or ("faces" if output and "{face}" in output else "cross")
        ending = "{face}" if self.layout == "faces" else self.layout
        if output is None:
            self.path = str(Path(source).with_name(f"{stem}_{ending}{wanted}"))
        elif not named:
            self.path = str(Path(output) / f"{stem}_{ending}{wanted}")
        else:
            self.path = output.replace("{name}", stem)
            if extension and Path(self.path).suffix.lower() != wanted:
                raise click.BadParameter(
                    f"expected the extension of {output}, got {extension}", param_hint="--to"
                )
            if self.layout == "faces" and "{face}" not in self.path:
                raise click.BadParameter(
                    f"expected {{face}} in the name for six files, got {output}",
                    param_hint="--output",
                )


def _stem(source: str) -> str:
    """Return the name without folder and extension; for "sky/{face}.png", the name of the folder, "sky"."""
    stem = Path(source).stem
    if "{face}" not in stem:
        return stem
    rest = stem.replace("{face}", "").strip("_-. ")
    return rest or Path(source).parent.name or "cube"
