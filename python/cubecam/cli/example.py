"""`cubecam example`: draw the programs of the course documents as pictures, animations and a sheet of thumbnails."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from .. import Renderer, examples, save_animation, save_image
from .common import DeviceOption, failures_reported, parse_device

if TYPE_CHECKING:
    from ..examples import Example

_MOVING = (".png", ".apng", ".gif", ".webp", ".mp4")
_ONLY_MOVING = (".apng", ".gif", ".mp4")
_SAMPLES = 4  # samples of each pixel, or fewer if the device allows fewer
_THUMBNAIL = 208  # pixels


def example(
    name: Annotated[
        str | None,
        typer.Argument(help="The name or number of a program from --list, such as skybox or P3."),
    ] = None,
    out: Annotated[
        str | None,
        typer.Option(
            "--out",
            "-o",
            help="The file to write: a still .png, .jpg or .exr, or an animation .png, .gif, .webp or .mp4 "
            "(.mp4 needs the command ffmpeg). Default: the program's name with .png. With --all: a folder.",
        ),
    ] = None,
    frames: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="Number of frames; 1 is a still. Default: that of the program; 1 for .jpg and .exr.",
        ),
    ] = None,
    start: Annotated[
        int | None,
        typer.Option(
            min=0, help="The first frame. Default: 0; for a still, the program's best frame."
        ),
    ] = None,
    size: Annotated[
        int | None, typer.Option(min=1, help="Width in pixels. Default: that of the program.")
    ] = None,
    fps: Annotated[float, typer.Option(help="Frames a second, up to 100.")] = 25.0,
    listed: Annotated[bool, typer.Option("--list", help="List the programs.")] = False,
    sheet: Annotated[
        str | None,
        typer.Option(
            "--sheet", help="With --list: draw thumbnails of all programs into this picture."
        ),
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Draw every program into the folder --out.")
    ] = False,
    device: DeviceOption = None,
) -> None:
    """Draw a program of the course documents.

    Examples: cubecam example --list; cubecam example dynamic_reflection -o ball.gif; cubecam example P4 --frames 1
    """
    _check_options(name, out, frames, fps, listed, sheet, everything)
    console = Console(soft_wrap=True)
    with failures_reported():
        if listed:
            console.print(_table(), highlight=False)
            if sheet is not None:
                with Renderer(device=parse_device(device)) as renderer:
                    _save_sheet(sheet, renderer)
                _tell(console, [sheet])
        elif everything:
            folder = Path(out or "examples")
            folder.mkdir(parents=True, exist_ok=True)
            with Renderer(device=parse_device(device)) as renderer:
                for known in examples.NAMES:
                    module = examples.load(known)
                    path = str(folder / f"{known}.png")
                    _save(path, module, renderer, frames, start, size, fps, console)
                    _tell(console, [path])
                _save_sheet(str(folder / "sheet.png"), renderer)
            _tell(console, [str(folder / "sheet.png")])
        else:
            module = _load(name)
            path = out or f"{module.__name__.rpartition('.')[2]}.png"
            if path.lower().endswith(".mp4"):
                from .movie import find_ffmpeg

                find_ffmpeg(Path(path))  # a missing ffmpeg is an error before anything is drawn
            with Renderer(device=parse_device(device)) as renderer:
                drawn = _save(path, module, renderer, frames, start, size, fps, console)
                info = renderer.info
            _tell(console, [path])
            console.print(f"{drawn}, drawn by {info.renderer}", highlight=False, markup=False)


def _check_options(
    name: str | None,
    out: str | None,
    frames: int | None,
    fps: float,
    listed: bool,
    sheet: str | None,
    everything: bool,
) -> None:
    if (name is not None) + listed + everything != 1:
        raise typer.BadParameter("expected a NAME, --list or --all, and only one of them")
    if sheet is not None and not listed:
        raise typer.BadParameter("expected with --list only", param_hint="--sheet")
    if not 0 < fps <= 100:
        raise typer.BadParameter(
            f"expected a number above 0 and up to 100, got {fps:g}", param_hint="--fps"
        )
    if name is not None:
        _load(name)
        ending = Path(out or ".png").suffix.lower() or Path(out or ".png").name.lower()
        if (frames or 1) > 1 and ending not in _MOVING:
            raise typer.BadParameter(
                f"expected a name that ends in {', '.join(_MOVING)} for {frames} frames, got {out}",
                param_hint="--out",
            )


def _load(name: str | None) -> Any:
    try:
        return examples.load(name or "")
    except ValueError as error:
        raise typer.BadParameter(str(error).removeprefix("name: "), param_hint="NAME") from error


def _tell(console: Console, paths: Iterable[str]) -> None:
    for path in paths:
        console.print(path, markup=False, highlight=False)


def _table() -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in ("", "name", "shows"):
        table.add_column(heading, no_wrap=heading != "shows")
    table.add_column("frames", justify="right")
    for known in examples.NAMES:
        module = examples.load(known)
        table.add_row(module.PROGRAM, known, module.TITLE, str(module.FRAMES))
    return table


def _save(
    path: str,
    module: Example,
    renderer: Renderer,
    frames: int | None,
    start: int | None,
    size: int | None,
    fps: float,
    console: Console,
) -> str:
    """Draw one program into a file, and return a description of the picture."""
    ending = Path(path).suffix.lower()
    count = frames or (module.FRAMES if ending in _MOVING else 1)
    first = start if start is not None else (module.STILL if count == 1 else 0)
    width, height = module.SIZE
    if size is not None:
        width, height = size, max(1, round(size * height / width))
    options: dict[str, Any] = {"samples": min(_SAMPLES, renderer.info.limits.max_samples)}
    program = module.build()
    if count == 1 and ending not in _ONLY_MOVING:
        if ending == ".exr":
            save_image(
                path,
                module.draw(
                    program, renderer, first, size=(width, height), format="rgba32f", **options
                ),
            )
        else:
            picture = module.draw(program, renderer, first, size=(width, height), **options)
            save_image(path, picture[..., :3])
        return f"frame {first}, {width} x {height}"

    def pictures() -> Iterator[Any]:
        for frame in track(
            range(first, first + count),
            description=path,
            console=console,
            disable=count == 1 or not console.is_terminal,
            transient=True,
        ):
            yield module.draw(program, renderer, frame, size=(width, height), **options)[..., :3]

    if ending == ".mp4":
        from .movie import save_mp4

        save_mp4(path, pictures(), fps)
    else:
        save_animation(path, pictures(), fps=fps)
    return f"{count} frames from {first} on, {width} x {height}"


def _save_sheet(path: str, renderer: Renderer) -> None:
    """Draw the stills of all programs into one picture, each with its number and name below."""
    from .sheet import contact_sheet

    samples = min(_SAMPLES, renderer.info.limits.max_samples)
    pictures, labels = [], []
    for known in examples.NAMES:
        module = examples.load(known)
        scale = _THUMBNAIL / max(module.SIZE)
        size = (round(module.SIZE[0] * scale), round(module.SIZE[1] * scale))
        pictures.append(
            module.draw(module.build(), renderer, module.STILL, size=size, samples=samples)
        )
        labels.append(f"{module.PROGRAM}  {known}")
    save_image(path, contact_sheet(pictures, labels, _THUMBNAIL))
