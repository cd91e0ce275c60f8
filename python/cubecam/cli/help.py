"""The text that --help prints: options in groups, each with a word that says what to write after it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import click

__all__ = ["Command", "Group", "Option", "argument", "option", "rows_by_title"]

F = TypeVar("F", bound=Callable[..., Any])


class Option(click.Option):
    """An option with a group in the help; `group` is the title."""

    def __init__(self, *args: Any, group: str = "Options", **kwargs: Any) -> None:
        self.group = group
        super().__init__(*args, **kwargs)


class Command(click.Command):
    """A command whose help has a section for each group of options, and one for the arguments."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the parameters, each group under its title."""
        _write_parameters(self.get_params(ctx), formatter)


class Group(click.Group):
    """The command that has the others, with the same kind of help."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """List the commands in the order in which they were added."""
        return list(self.commands)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the commands and then the options."""
        self.format_commands(ctx, formatter)
        _write_parameters(self.get_params(ctx), formatter)


def option(*names: str, help: str, **more: Any) -> Callable[[F], F]:
    """Declare an option; `group` is the title of its section in the help, `note` stands in place of its default."""
    note = more.pop("note", None)
    text = f"{help} Default: {note}." if note else help
    return click.option(*names, cls=Option, help=text, show_default=note is None, **more)


def argument(name: str, *, metavar: str, help: str, **more: Any) -> Callable[[F], F]:
    """Declare an argument; click itself has no help for one."""
    return click.argument(name, cls=_Argument, metavar=metavar, help=help, **more)


class _Argument(click.Argument):
    def __init__(self, *args: Any, help: str, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.text = help  # click has a section of its own for what stands in `help`


def rows_by_title(parameters: list[click.Parameter]) -> dict[str, list[tuple[str, str]]]:
    """For each group of parameters their names and what they mean; the site's reference is made of it, too."""
    groups: dict[str, list[tuple[str, str]]] = {}
    for parameter in parameters:
        if isinstance(parameter, _Argument):
            row = (str(parameter.metavar), parameter.text)
            groups.setdefault("Arguments", []).append(row)
        elif isinstance(parameter, click.Option):
            words = " ".join(text for text in (parameter.help, _default(parameter)) if text)
            title = getattr(parameter, "group", "Options")
            groups.setdefault(title, []).append((_names(parameter), words))
    return groups


def _write_parameters(parameters: list[click.Parameter], formatter: click.HelpFormatter) -> None:
    for title, rows in rows_by_title(parameters).items():
        with formatter.section(title):
            formatter.write_dl(rows)


def _names(parameter: click.Option) -> str:
    names = ", ".join(sorted(parameter.opts, key=len))
    return f"{names} {parameter.metavar}" if parameter.metavar else names


def _default(parameter: click.Option) -> str:
    value = parameter.default
    if not parameter.show_default or isinstance(value, bool):
        return ""
    if isinstance(value, tuple):
        return f"Default: {' '.join(f'{number:g}' for number in value)}."
    if isinstance(value, (int, float)):
        return f"Default: {value:g}."
    return f"Default: {value}." if isinstance(value, str) and value else ""
