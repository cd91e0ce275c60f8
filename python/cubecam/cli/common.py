"""Options that the commands share, and their error messages."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from .. import Error

DeviceOption = Annotated[
    str | None,
    typer.Option(
        help="auto, software, gpu, an index, part of a name, or a UUID. Default: CUBECAM_DEVICE, else auto."
    ),
]


@contextlib.contextmanager
def failures_reported() -> Iterator[None]:
    """Turn an error into a message and exit code 1."""
    try:
        yield
    except (Error, OSError, ValueError, TypeError, IndexError, MemoryError) as error:
        fail(error)


def fail(error: Exception) -> None:
    """Print the error on standard error, and exit."""
    Console(stderr=True, soft_wrap=True).print(
        f"[bold red]error:[/] {escape(describe(error))}", highlight=False
    )
    raise typer.Exit(1) from error


def describe(error: Exception) -> str:
    """Give the text of an error as a user reads it."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.strerror}: {error.filename}" if error.filename else error.strerror
    return str(error) or type(error).__name__


def parse_device(device: str | None) -> str | int | None:
    """Turn the option's text into an argument of `Renderer`: digits are an index."""
    return int(device) if device is not None and device.isdecimal() else device
