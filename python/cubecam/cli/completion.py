"""Completion of the command in a shell: click's scripts, printed or installed."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click
from click.shell_completion import get_completion_class

from .help import option

__all__ = ["completion_options"]

F = TypeVar("F", bound=Callable[..., Any])

_SHELLS = ("bash", "zsh", "fish")
_OWN = "the shell that runs"  # the value of the options without a name behind them


def _script(ctx: click.Context, shell: str) -> str:
    kind = get_completion_class(shell)
    assert kind is not None
    return kind(ctx.command, {}, "cubecam", "_CUBECAM_COMPLETE").source()


def _shell(value: str) -> str:
    name = value if value != _OWN else Path(os.environ.get("SHELL", "")).name
    if name not in _SHELLS:
        raise click.BadParameter(f"expected {', '.join(_SHELLS)} as the shell, got {name!r}")
    return name


def _show(ctx: click.Context, param: click.Parameter, value: str | None) -> None:
    if value is not None and not ctx.resilient_parsing:
        click.echo(_script(ctx, _shell(value)))
        ctx.exit()


def _install(ctx: click.Context, param: click.Parameter, value: str | None) -> None:
    if value is None or ctx.resilient_parsing:
        return
    from ..io.writing import write_files

    shell = _shell(value)
    home = Path.home()
    if shell == "fish":
        config = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
        target = config / "fish" / "completions" / "cubecam.fish"
    else:
        data = Path(os.environ.get("XDG_DATA_HOME") or home / ".local" / "share")
        target = data / "cubecam" / f"complete.{shell}"
    target.parent.mkdir(parents=True, exist_ok=True)
    write_files({target: (_script(ctx, shell) + "\n").encode()})
    click.echo(target)
    if shell != "fish":
        start = home / f".{shell}rc"
        line = f"source '{target}'".encode()
        lines = start.read_bytes() if start.exists() else b""
        if line not in lines.splitlines():
            write_files(
                {start: b"%s\n%s\n" % (lines.rstrip(), line) if lines.strip() else line + b"\n"}
            )
        click.echo(start)
    click.echo("completion works in the next shell")
    ctx.exit()


def completion_options(function: F) -> F:
    """Declare both options."""
    flags: dict[str, Any] = {
        "expose_value": False,
        "is_eager": True,
        "is_flag": False,
        "flag_value": _OWN,
        "metavar": "[SHELL]",
    }
    show = option(
        "--show-completion",
        callback=_show,
        help=f"Print the script that completes commands in {', '.join(_SHELLS)}.",
        **flags,
    )
    install = option(
        "--install-completion",
        callback=_install,
        help="Let the shell complete commands, options and names.",
        **flags,
    )
    return install(show(function))
