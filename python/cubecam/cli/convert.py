"""`cubecam convert`: convert files between layouts, conventions and formats, many files at a time."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import click

from .. import Error
from ..typing import Center, Convention, FileLayout, Tonemap
from .common import (
    FILE,
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
    from .. import CubeMap

_FROM = "Options for reading"
_TO = "Options for writing"

T = TypeVar("T")


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
    **choice(FileLayout),
    group=_TO,
    help=f"{words(FileLayout)}.",
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
    type=WholeNumber(1),
    metavar="TEXELS",
    group=_TO,
    help="Texels along a face.",
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
@look_options("neutral; none for 8 and 16 bit files read with --srgb", _TO)
@option("--half", is_flag=True, group=_TO, help="Store EXR with 16 bits a number.")
@option(
    "--from-layout",
    **choice(FileLayout),
    group=_FROM,
    help=f"{words(FileLayout)}.",
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
    layout: FileLayout | None,
    convention: Convention | None,
    center: Center,
    to: str | None,
    size: int | None,
    width: int | None,
    exposure: float,
    tonemap: Curve | None,
    half: bool,
    from_layout: FileLayout | None,
    from_convention: Convention | None,
    from_center: Center | None,
    part: str | None,
    srgb: bool,
) -> None:
    """Convert cubemaps and panoramas to other layouts and files.

    The format of an output follows from its extension, and the layout of an input from its shape. Files that cubecam
    wrote say their convention and centre; for other files give --from-convention if it is not "gl".
    """
    from ..io.cubemaps import load_cubemap

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
    failed = 0
    for item in _with_progress(names):
        try:
            with warnings_reported(item.source):
                cube = load_cubemap(
                    item.source,
                    layout=from_layout,
                    convention=from_convention,
                    size=size,
                    center=from_center,
                    srgb=srgb,
                    part=int(part) if part is not None and part.isdecimal() else part,
                )
            Path(item.path).parent.mkdir(parents=True, exist_ok=True)
            with warnings_reported(item.path):
                cube.save(
                    item.path,
                    layout=item.layout,
                    convention=convention,
                    width=width,
                    center=center,
                    exposure=exposure,
                    tonemap=_curve(tonemap, cube, srgb and not _is_light(item.source)),
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
        self, source: str, output: str | None, layout: FileLayout | None, extension: str | None
    ) -> None:
        self.source = source
        if not Path(source).name:
            raise click.BadParameter(f"expected a file, got {source!r}")
        stem, own = _stem(source), Path(source).suffix
        wanted = "." + extension.lower().lstrip(".") if extension else own
        named = output is not None and (
            Path(output).suffix != "" and not output.endswith("/") and not Path(output).is_dir()
        )
        self.layout: FileLayout = layout or ("faces" if output and "{face}" in output else "cross")
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
