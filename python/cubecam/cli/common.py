"""Options that the commands share, and their error messages."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, Literal, NoReturn, TypeAlias, TypeVar, get_args

import click
from click.shell_completion import CompletionItem

from .. import Error
from ..typing import Tonemap
from .help import option

if TYPE_CHECKING:
    from .. import CubeMap

Curve: TypeAlias = Literal[Tonemap, "none"]
Triple: TypeAlias = tuple[float, float, float]
F = TypeVar("F", bound=Callable[..., Any])

#: The sample photograph that lights a model without light of its own.
SAMPLE_LIGHT = "sunset.exr"


def sample_light() -> CubeMap:
    """Read that photograph."""
    from ..data import sample_data
    from ..io.cubemaps import load_environment

    return load_environment(sample_data(SAMPLE_LIGHT), size=256)


class WholeNumber(click.ParamType):
    """A whole number from `least` on."""

    name = "whole number"

    def __init__(self, least: int) -> None:
        self.least = least

    def convert(self, value: Any, param: Any, ctx: Any) -> int:
        """Parse what was written; a default is an int already."""
        try:
            number = int(value)
        except ValueError:
            number = self.least - 1
        if number < self.least:
            self.fail(
                f"expected a whole number of at least {self.least}, got {str(value)!r}", param, ctx
            )
        return number


class Number(click.ParamType):
    """A finite number."""

    name = "number"

    def convert(self, value: Any, param: Any, ctx: Any) -> float:
        """Parse what was written; a default is a number already."""
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            self.fail(f"expected a number, got {str(value)!r}", param, ctx)
        return number


NUMBER = Number()
#: Files are checked where they are read or written; the type lets a shell complete their names.
FILE = click.Path(readable=False)


def choice(kind: Any) -> dict[str, Any]:
    """Give the arguments of an option that takes one of the words of a Literal."""
    return {"type": click.Choice(get_args(kind)), "metavar": "NAME"}


def words(kind: Any) -> str:
    """List the words of a Literal: "a, b or c"."""
    *most, last = get_args(kind)
    return f"{', '.join(most)} or {last}"


def _device_names(ctx: Any, param: Any, incomplete: str) -> list[CompletionItem]:
    names = ("auto", "software", "gpu")
    return [CompletionItem(name) for name in names if name.startswith(incomplete)]


def device_option(function: F) -> F:
    """Declare the option of commands that draw."""
    return option(
        "--device",
        metavar="DEVICE",
        shell_complete=_device_names,
        help="auto, software, gpu, an index, part of a name, or a UUID.",
        note="CUBECAM_DEVICE, else auto",
    )(function)


def look_options(note: str = "neutral", group: str = "Options") -> Callable[[F], F]:
    """Declare how linear floats become 8 bits: the options of `CubeMap.save`."""

    def declare(function: F) -> F:
        exposure = option(
            "--exposure",
            type=NUMBER,
            metavar="STOPS",
            default=0.0,
            group=group,
            help="Make the picture brighter (above 0) or darker by powers of two.",
        )
        tonemap = option(
            "--tonemap",
            **choice(Curve),
            group=group,
            help=f"The curve that brings linear floats into 8 or 16 bits: {words(Curve)}, which clips.",
            note=note,
        )
        return exposure(tonemap(function))

    return declare


def place_options(group: str = "Options") -> Callable[[F], F]:
    """Declare where a live view is shown: `page`, `window`, `terminal` and `no_browser` of a command."""
    options = {
        "--page": "Show a page for a browser. Default.",
        "--window": "Show a window.",
        "--terminal": "Show the view in this terminal.",
        "--no-browser": "Print the page's address and open no browser.",
    }

    def declare(function: F) -> F:
        for name, text in reversed(options.items()):
            function = option(name, is_flag=True, group=group, help=text)(function)
        return function

    return declare


def parse_place(page: bool, window: bool, terminal: bool) -> Literal["page", "window", "terminal"]:
    """Return where a live view is shown."""
    if page + window + terminal > 1:
        raise click.BadParameter("expected one of --page, --window and --terminal")
    return "window" if window else "terminal" if terminal else "page"


@contextlib.contextmanager
def warnings_reported(path: str) -> Iterator[None]:
    """Report each warning of cubecam in one line: what was clipped and which options help, what was left out."""
    from .._warnings import ConventionWarning, RendererWarning, SceneWarning
    from ..io.screen import ClippingWarning

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ClippingWarning)
        warnings.simplefilter("always", ConventionWarning)
        warnings.simplefilter("always", RendererWarning)
        warnings.simplefilter("always", SceneWarning)
        yield
    for item in caught:
        if issubclass(item.category, ClippingWarning):
            what, _, how = str(item.message).partition("; ")
            curve = "--tonemap neutral keeps highlights, " if "tonemap=" in how else ""
            hint = f"{curve}a lower --exposure makes the picture darker"
            complain(f"{path}: {what}; {hint}", kind="warning")
        elif issubclass(item.category, (ConventionWarning, RendererWarning, SceneWarning)):
            complain(str(item.message), kind="warning")
        else:
            warnings.warn_explicit(item.message, item.category, item.filename, item.lineno)


@contextlib.contextmanager
def failures_reported() -> Iterator[None]:
    """Turn an error into a message and exit code 1."""
    try:
        yield
    except (Error, OSError, ValueError, TypeError, IndexError, MemoryError) as error:
        fail(error)


def fail(error: Exception) -> NoReturn:
    """Print the error on standard error, and exit."""
    complain(describe(error))
    raise SystemExit(1) from error


def complain(text: str, kind: str = "error") -> None:
    """Print an error or a warning on standard error."""
    color = "red" if kind == "error" else "yellow"
    click.echo(f"{click.style(f'{kind}:', fg=color, bold=True)} {text}", err=True)


def describe(error: Exception) -> str:
    """Give the text of an error as a user reads it."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.strerror}: {error.filename}" if error.filename else error.strerror
    return str(error) or type(error).__name__


def parse_device(device: str | None) -> str | int | None:
    """Turn the option's text into an argument of `Renderer`: digits are an index."""
    return int(device) if device is not None and device.isdecimal() else device
