"""The command `cubecam`: info, doctor, demo, render, bake, convert, capture, capture-many, compare, example, view, ...

Exit codes: 0 for success; 1 for an error, with a message; 2 for a command that is not valid; 130 for Ctrl-C, which
leaves no unfinished file; 141 if the program that reads the output has ended, as in `cubecam info | head -1`.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from typing import NoReturn

import click

from .. import __version__
from ..io.outside import calls_run
from .bake import bake
from .capture import capture
from .capture_many import capture_many
from .common import FILE, WholeNumber, device_option, failures_reported, parse_device
from .compare import compare
from .completion import completion_options
from .conventions import conventions
from .convert import convert
from .doctor import doctor
from .example import example
from .help import Command, Group, option
from .info import info
from .render import render
from .terminal import guard_streams
from .view import view

__all__ = ["app", "main"]

#: What a shell reports for a program that SIGINT ended: 128 and the signal's number.
INTERRUPTED = 130


@click.group(cls=Group, context_settings={"max_content_width": 100})
@click.version_option(
    __version__, prog_name="cubecam", message="%(prog)s %(version)s", help="Print the version."
)
@completion_options
def app() -> None:
    """Headless cubemap renderer: scenes, photographs and meshes to cubemaps, panoramas and pictures."""


@click.command(cls=Command)
@option("--out", "-o", metavar="FOLDER", type=FILE, default="out", help="The folder to write to.")
@option(
    "--frames", type=WholeNumber(1), metavar="COUNT", default=100, help="Pictures of the animation."
)
@option(
    "--size",
    type=WholeNumber(1),
    metavar="PIXELS",
    default=1024,
    help="Width of the frame; its height is 3/4 of that.",
)
@device_option
def demo(out: str, frames: int, size: int, device: str | None) -> None:
    """Render the sample scene: frame, cross, panorama and animation."""
    from ..demo import run

    with failures_reported():
        run(out, frames=frames, size=size, device=parse_device(device))


for _command in (
    info, doctor, demo, render, bake, convert, capture, capture_many, compare, example, view, conventions,
):  # fmt: skip
    app.add_command(_command)


def main() -> None:
    """Run the command; the entry point of the console script."""
    finish = guard_streams()
    try:
        raise SystemExit(app.main(prog_name="cubecam", standalone_mode=False))
    except click.ClickException as error:
        error.show()
        raise SystemExit(error.exit_code) from None
    except (click.Abort, KeyboardInterrupt):
        _end_interrupted(finish)
    finally:
        finish()


def _end_interrupted(finish: Callable[[], None]) -> NoReturn:
    """End after Ctrl-C; click has ended the line in which the terminal wrote ^C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # pressed again, it would show a traceback
    finish()
    if calls_run():
        os._exit(
            INTERRUPTED
        )  # the interpreter's end would wait for the thread that reads or writes
    raise SystemExit(INTERRUPTED) from None
