"""`cubecam convert`: convert files between layouts, conventions and formats, many files at a time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import track

from .. import Error
from ..io.cubemaps import load_cubemap
from ..typing import Center, Convention, FileLayout
from .common import describe

_FROM = "Options for reading"
_TO = "Options for writing"


def convert(
    inputs: Annotated[
        list[str],
        typer.Argument(
            help="Files; for six files, one name with {face}, such as 'sky/{face}.png'."
        ),
    ],
    output: Annotated[
        str | None,
        typer.Option(
            "--output",
            "-o",
            help="A file name, a folder, or a name with {name} (the input's) and {face}. "
            "Default: beside the input, with the layout in the name.",
            rich_help_panel=_TO,
        ),
    ] = None,
    layout: Annotated[
        FileLayout | None,
        typer.Option(
            "--layout",
            "-l",
            help="Default: cross; faces for an output with {face}.",
            rich_help_panel=_TO,
        ),
    ] = None,
    convention: Annotated[
        Convention | None,
        typer.Option("--convention", "-c", help="Default: gl.", rich_help_panel=_TO),
    ] = None,
    center: Annotated[
        Center, typer.Option(help="The middle of an equirect.", rich_help_panel=_TO)
    ] = "-z",
    to: Annotated[
        str | None,
        typer.Option(
            "--to",
            help="Extension, such as exr or png. Default: that of the input.",
            rich_help_panel=_TO,
        ),
    ] = None,
    size: Annotated[
        int | None, typer.Option(min=1, help="Texels along a face.", rich_help_panel=_TO)
    ] = None,
    width: Annotated[
        int | None,
        typer.Option(min=2, help="Width of an equirect, in pixels.", rich_help_panel=_TO),
    ] = None,
    half: Annotated[
        bool, typer.Option("--half", help="Store EXR with 16 bits a number.", rich_help_panel=_TO)
    ] = False,
    from_layout: Annotated[
        FileLayout | None,
        typer.Option(help="Default: by the shape of the picture.", rich_help_panel=_FROM),
    ] = None,
    from_convention: Annotated[
        Convention | None, typer.Option(help="Default: gl.", rich_help_panel=_FROM)
    ] = None,
    from_center: Annotated[
        Center | None, typer.Option(help="Default: -z.", rich_help_panel=_FROM)
    ] = None,
    srgb: Annotated[
        bool,
        typer.Option(
            "--srgb",
            help="8 and 16 bit files are sRGB: decode them when reading, encode them when writing.",
        ),
    ] = False,
) -> None:
    """Convert cubemaps and panoramas between layouts, conventions and formats of files.

    The format of an output follows from its extension, and the layout of an input from its shape. The convention of an
    input does not follow from the file: give --from-convention if it is not "gl".
    """
    names = [_Target(item, output, layout, to) for item in inputs]
    written: dict[str, str] = {}
    for item in names:
        if item.path in written:
            raise typer.BadParameter(
                f"{written[item.path]} and {item.source} would both be written to {item.path}; "
                "expected a folder or a name with {name}",
                param_hint="--output",
            )
        written[item.path] = item.source
    if width is not None and any(item.layout != "equirect" for item in names):
        raise typer.BadParameter("expected with --layout equirect only", param_hint="--width")
    console = Console(soft_wrap=True)
    errors = Console(stderr=True, soft_wrap=True)
    failed = 0
    for item in track(
        names, description="converting", console=console, disable=len(names) == 1, transient=True
    ):
        try:
            cube = load_cubemap(
                item.source,
                layout=from_layout,
                convention=from_convention,
                size=size,
                center=from_center,
                srgb=srgb,
            )
            Path(item.path).parent.mkdir(parents=True, exist_ok=True)
            cube.save(
                item.path,
                layout=item.layout,
                convention=convention,
                width=width,
                center=center,
                half=half,
            )
        except (Error, OSError, ValueError, TypeError, MemoryError) as error:
            failed += 1
            text = describe(error)
            told = text if item.source in text else f"{item.source}: {text}"
            errors.print(f"[bold red]error:[/] {escape(told)}", highlight=False)
        else:
            console.print(f"{item.source} -> {item.path}", markup=False, highlight=False)
    if failed:
        if len(names) > 1:
            errors.print(f"{failed} of {len(names)} not converted", highlight=False)
        raise typer.Exit(1)


class _Target:
    """The path and the layout of the output of one input."""

    def __init__(
        self, source: str, output: str | None, layout: FileLayout | None, extension: str | None
    ) -> None:
        self.source = source
        if not Path(source).name:
            raise typer.BadParameter(f"expected a file, got {source!r}")
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
                raise typer.BadParameter(
                    f"expected the extension of {output}, got {extension}", param_hint="--to"
                )
            if self.layout == "faces" and "{face}" not in self.path:
                raise typer.BadParameter(
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
