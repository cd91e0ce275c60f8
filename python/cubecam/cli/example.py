"""`cubecam example`: draw the programs of the course documents as pictures, animations and a sheet of thumbnails."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from .. import Image, Renderer, examples
from ..io.cubemap_names import by_their_names
from ..typing import Parallax
from .common import (
    FILE,
    NUMBER,
    WholeNumber,
    choice,
    device_option,
    fail,
    failures_reported,
    parse_device,
    parse_place,
    place_options,
    words,
)
from .help import Command, argument, option

if TYPE_CHECKING:
    from rich.table import Table

    from ..examples import Example

_MOVING = (".png", ".apng", ".gif", ".webp", ".mp4")
_ONLY_MOVING = (".apng", ".gif", ".mp4")
_SAMPLES = 4  # samples of each pixel, or fewer if the device allows fewer
_THUMBNAIL = 208  # pixels


def _names(ctx: Any, param: Any, incomplete: str) -> list[CompletionItem]:
    """List the programs whose names begin so, for completion in a shell."""
    return [CompletionItem(name) for name in examples.NAMES if name.startswith(incomplete)]


class _Command(Command):
    """Takes six files after --images, as a shell writes the pattern ``{px,nx,py,ny,pz,nz}.jpg``."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Write the option before each of the files, as click has it."""
        return super().parse_args(ctx, _each_with_its_option(args))


def _each_with_its_option(args: Sequence[str]) -> list[str]:
    found: list[str] = []
    rest = list(args)
    while rest:
        word = rest.pop(0)
        found.append(word)
        if word == "--images":
            files = list(takewhile(lambda one: not one.startswith("-") and not _is_name(one), rest))
            for index, file in enumerate(files[:6]):
                found += [file] if index == 0 else ["--images", file]
            del rest[: len(files[:6])]
    return found


def _is_name(word: str) -> bool:
    return word in examples.NAMES or re.fullmatch(r"[Pp]\d+", word) is not None


@click.command(cls=_Command)
@argument(
    "name",
    required=False,
    metavar="[NAME]",
    shell_complete=_names,
    help="The name or number of a program from --list, such as skybox or P3.",
)
@option(
    "--out",
    "-o",
    type=FILE,
    metavar="FILE",
    help="The file to write: a still .png, .jpg or .exr, or an animation .png, .gif, .webp or .mp4 "
    "(.mp4 needs imageio-ffmpeg or the command ffmpeg). With --all: a folder.",
    note="the program's name with .png",
)
@option(
    "--frames",
    type=WholeNumber(1),
    metavar="COUNT",
    help="Number of frames; 1 is a still.",
    note="that of the program; 1 for .jpg and .exr",
)
@option(
    "--start",
    type=WholeNumber(0),
    metavar="FRAME",
    help="The first frame.",
    note="0; for a still, the program's best frame",
)
@option(
    "--size",
    type=WholeNumber(1),
    metavar="PIXELS",
    help="Width of the picture.",
    note="that of the program",
)
@option("--fps", type=NUMBER, metavar="NUMBER", default=25.0, help="Frames a second, up to 100.")
@option("--list", "listed", is_flag=True, help="List the programs.")
@option(
    "--sheet",
    type=FILE,
    metavar="FILE",
    help="With --list: draw thumbnails of all programs into this picture.",
)
@option("--all", "everything", is_flag=True, help="Draw every program into the folder --out.")
@option(
    "--document",
    is_flag=True,
    help="Draw the document's own scene, number for number, without multisampling, in place of the staged one.",
)
@option(
    "--images",
    type=FILE,
    multiple=True,
    metavar="FILES",
    group="Inputs",
    help="Six photographs in the order +X -X +Y -Y +Z -Z, or in any order if their names tell the faces, as posx.jpg "
    "does; or one path with {face}, such as 'sky/{face}.jpg'.",
)
@option(
    "--image",
    type=FILE,
    metavar="FILE",
    group="Inputs",
    help="One picture; for P6 one that holds six faces, whose shape tells the layout.",
)
@option(
    "--script",
    metavar="STEPS",
    group="Inputs",
    help="What the visitor does, such as 'drag 30 10; w 5': drag by pixels to the right and down, w and s walk.",
)
@option(
    "--method",
    **choice(Parallax),
    group="Inputs",
    help=f"How the balls of P16 find what their rays meet: {words(Parallax)}.",
    note="none",
)
@option("--live", is_flag=True, group="Live", help="Show the program live: turn it, walk in it.")
@place_options("Live")
@device_option
def example(
    name: str | None,
    out: str | None,
    frames: int | None,
    start: int | None,
    size: int | None,
    fps: float,
    listed: bool,
    sheet: str | None,
    everything: bool,
    document: bool,
    images: tuple[str, ...],
    image: str | None,
    script: str | None,
    method: str | None,
    live: bool,
    page: bool,
    window: bool,
    terminal: bool,
    no_browser: bool,
    device: str | None,
) -> None:
    """Draw a program of the course documents.

    Examples: cubecam example --list; cubecam example dynamic_reflection -o ball.gif; cubecam example P4 --frames 1;
    cubecam example P2 --live; cubecam example P2 --script "drag 30 10; w 5"
    """
    _check_options(name, out, frames, fps, listed, sheet, everything)
    _check_live(name, live, click.get_current_context())
    given = _inputs(name, images, image, script, method)
    where = parse_place(page, window, terminal)
    with failures_reported():
        if listed:
            from rich.console import Console

            Console(soft_wrap=True).print(_table(), highlight=False)
            if sheet is not None:
                with Renderer(device=parse_device(device)) as renderer:
                    _save_sheet(sheet, renderer, document)
                _tell([sheet])
        elif live:
            _show(_load(name), where, not no_browser, device, {"document": document, **given})
        elif everything:
            folder = Path(out or "examples")
            folder.mkdir(parents=True, exist_ok=True)
            with Renderer(device=parse_device(device)) as renderer:
                for known in examples.NAMES:
                    module = examples.load(known)
                    path = str(folder / f"{known}.png")
                    _save(path, module, renderer, frames, start, size, fps, document)
                    _tell([path])
                _save_sheet(str(folder / "sheet.png"), renderer, document)
            _tell([str(folder / "sheet.png")])
        else:
            module = _load(name)
            path = out or f"{module.__name__.rpartition('.')[2]}.png"
            if path.lower().endswith(".mp4"):
                from ..io.movie import find_ffmpeg

                find_ffmpeg(Path(path))  # a missing ffmpeg is an error before anything is drawn
            with Renderer(device=parse_device(device)) as renderer:
                drawn = _save(path, module, renderer, frames, start, size, fps, document, given)
                info = renderer.info
            _tell([path])
            click.echo(f"{drawn}, drawn by {info.renderer}")


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
        raise click.BadParameter("expected a NAME, --list or --all, and only one of them")
    if sheet is not None and not listed:
        raise click.BadParameter("expected with --list only", param_hint="--sheet")
    if not 0 < fps <= 100:
        raise click.BadParameter(
            f"expected a number above 0 and up to 100, got {fps:g}", param_hint="--fps"
        )
    if name is not None:
        _load(name)
        ending = Path(out or ".png").suffix.lower() or Path(out or ".png").name.lower()
        if (frames or 1) > 1 and ending not in _MOVING:
            raise click.BadParameter(
                f"expected a name that ends in {', '.join(_MOVING)} for {frames} frames, got {out}",
                param_hint="--out",
            )


def _check_live(name: str | None, live: bool, context: click.Context) -> None:
    """Refuse options that have no meaning with --live, or without it."""
    others = ("out", "frames", "start", "size", "fps")
    wrong = others if live else ("page", "window", "terminal", "no_browser")
    for parameter in wrong:
        if context.get_parameter_source(parameter) is not ParameterSource.DEFAULT:
            raise click.BadParameter(
                f"expected {'without' if live else 'with'} --live only",
                param_hint=f"--{parameter.replace('_', '-')}",
            )
    if not live:
        return
    if name is None:
        raise click.BadParameter("expected a NAME with it", param_hint="--live")
    if not examples.is_live(name):
        listed = _listed(known for known in examples.NAMES if examples.is_live(known))
        raise click.BadParameter(
            f"expected a program that is live, one of {listed}; got {name}", param_hint="NAME"
        )


def _inputs(
    name: str | None,
    images: tuple[str, ...],
    image: str | None,
    script: str | None,
    method: str | None,
) -> dict[str, Any]:
    """Check the programs' inputs, and return those that were given as arguments of `build` and `live`."""
    given: dict[str, Any] = {}
    if images:
        if len(images) not in (1, 6):
            raise click.BadParameter(
                f"expected six files, or one path with {{face}}, got {len(images)}",
                param_hint="--images",
            )
        given["images"] = images[0] if len(images) == 1 else by_their_names(images)
    if image is not None:
        given["image"] = image
    if script is not None:
        given["script"] = script
    if method is not None:
        given["method"] = method
    for key in given:
        if name is None:
            raise click.BadParameter("expected a NAME with it", param_hint=f"--{key}")
        if key not in examples.inputs_of(name):
            known = [known for known in examples.NAMES if key in examples.inputs_of(known)]
            raise click.BadParameter(
                f"expected a program that takes it, one of {_listed(known)}; got {name}",
                param_hint=f"--{key}",
            )
    return given


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"{examples.load(one).PROGRAM} {one}" for one in names)


def _load(name: str | None) -> Any:
    try:
        return examples.load(name or "")
    except ValueError as error:
        raise click.BadParameter(str(error).removeprefix("name: "), param_hint="NAME") from error


def _tell(paths: Iterable[str]) -> None:
    for path in paths:
        click.echo(path)


def _table() -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for heading in ("", "name", "shows"):
        table.add_column(heading, no_wrap=heading != "shows")
    table.add_column("frames", justify="right")
    table.add_column("")
    for known in examples.NAMES:
        module = examples.load(known)
        live = "live" if examples.is_live(known) else ""
        table.add_row(module.PROGRAM, known, module.TITLE, str(module.FRAMES), live)
    return table


def _show(
    module: Any, where: str, browser: bool, device: str | None, options: dict[str, Any]
) -> None:
    """Show a program live until the view is closed or Ctrl-C ends it."""
    try:
        with Renderer(device=parse_device(device)) as renderer:
            module.live(renderer=renderer, **options).show(where, browser=browser, block=True)
    except ImportError as error:
        fail(error)


def _save(
    path: str,
    module: Example,
    renderer: Renderer,
    frames: int | None,
    start: int | None,
    size: int | None,
    fps: float,
    document: bool = False,
    inputs: dict[str, Any] | None = None,
) -> str:
    """Draw one program into a file, and return a description of the picture."""
    from .. import save_animation, save_image

    program = module.build(document=document, **(inputs or {}))
    ending = Path(path).suffix.lower()
    count = frames or (examples.length_of(module, program) if ending in _MOVING else 1)
    first = start if start is not None else examples.still_of(module, program) if count == 1 else 0
    width, height = examples.size_of(module, program)
    if size is not None:
        width, height = size, max(1, round(size * height / width))
    options: dict[str, Any] = {"samples": _samples(renderer, document)}
    if count == 1 and ending not in _ONLY_MOVING:
        if ending == ".exr":
            options["format"] = "rgba32f"
            picture = module.draw(program, renderer, first, size=(width, height), **options)
            # The numbers are those of a screen, as in the 8-bit files; an EXR holds the light that looks like them.
            save_image(path, Image(picture, encoding="srgb"))
        else:
            picture = module.draw(program, renderer, first, size=(width, height), **options)
            save_image(path, picture[..., :3])
        return f"frame {first}, {width} x {height}"

    def pictures() -> Iterator[Any]:
        for frame in _with_progress(range(first, first + count), path):
            yield module.draw(program, renderer, frame, size=(width, height), **options)[..., :3]

    if ending == ".mp4":
        from ..io.movie import save_mp4

        save_mp4(path, pictures(), fps)
    else:
        save_animation(path, pictures(), fps=fps)
    return f"{count} frames from {first} on, {width} x {height}"


def _with_progress(frames: range, path: str) -> Iterable[int]:
    """Show a bar on a terminal while several frames are drawn."""
    if len(frames) == 1 or not sys.stdout.isatty():
        return frames
    from rich.progress import track

    return track(frames, description=path, transient=True)


def _samples(renderer: Renderer, document: bool) -> int:
    """Give the samples of a pixel: one as in the documents, or some for smooth edges."""
    return 1 if document else min(_SAMPLES, renderer.info.limits.max_samples)


def _save_sheet(path: str, renderer: Renderer, document: bool) -> None:
    """Draw the stills of all programs into one picture, each with its number and name below."""
    from .. import save_image
    from .sheet import contact_sheet

    samples = _samples(renderer, document)
    pictures, labels = [], []
    for known in examples.NAMES:
        module = examples.load(known)
        program = module.build(document=document)
        width, height = examples.size_of(module, program)
        scale = _THUMBNAIL / max(width, height)
        size = (round(width * scale), round(height * scale))
        still = examples.still_of(module, program)
        pictures.append(module.draw(program, renderer, still, size=size, samples=samples))
        labels.append(f"{module.PROGRAM}  {known}")
    save_image(path, contact_sheet(pictures, labels, _THUMBNAIL))
