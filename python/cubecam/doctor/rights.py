"""Commands that only root may run, for a user who is root, one who has sudo, and one in a container who has neither."""

from __future__ import annotations

from .surroundings import container_sign
from .system import System

__all__ = ["as_root"]


def as_root(system: System, *commands: str) -> tuple[str, ...]:
    """Give the commands in the form in which this user can run them."""
    if system.uid == 0:
        return commands
    if container_sign(system) and not system.exists("/usr/bin/sudo"):
        return (
            "# this user may not do this here; in the image's Dockerfile, before USER:",
            f"RUN {' && '.join(commands)}",
        )
    return tuple(_with_sudo(command) for command in commands)


def _with_sudo(command: str) -> str:
    # Of `echo text | tee file` the part that writes needs the rights.
    before, pipe, after = command.rpartition(" | ")
    return f"{before}{pipe}sudo {after}"
