"""The machine that the doctor looks at: files below a root, the environment, programs. Tests make one in a folder."""

from __future__ import annotations

import os
import platform
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

__all__ = ["Ran", "System", "os_release"]

#: How long a program may take that only looks, in seconds.
LONGEST = 20.0
#: Loads a library in a process of its own, since the code that a library runs when it is loaded may crash.
_LOAD = (
    "import ctypes, sys\ntry:\n ctypes.CDLL(sys.argv[1])\nexcept OSError as e:\n sys.exit(str(e))"
)


@dataclass(frozen=True)
class Ran:
    """How a program ended; `code` is None if it could not be started, or gave no answer in time and is `late`."""

    code: int | None
    out: str = ""
    err: str = ""
    late: bool = False

    @property
    def last_line(self) -> str:
        """The last line of its errors that is not empty; "" if there is none."""
        return next((line for line in reversed(self.err.splitlines()) if line.strip()), "")

    def end(self, longest: float) -> str:
        """Say how it ended: by a signal, with a status, or not at all in its time."""
        if self.late:
            return f"gave no answer within {longest:.0f} s"
        if self.code is None:
            return "could not be started"
        if self.code >= 0:
            return f"ended with status {self.code}"
        try:
            name = signal.Signals(-self.code).name
        except ValueError:
            name = f"signal {-self.code}"
        return f"was ended by {name}"


@dataclass(frozen=True)
class System:
    """This machine, unless a test gives other values."""

    root: Path = Path("/")
    environ: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    uid: int = field(default_factory=lambda: _number_of("geteuid"))
    groups: frozenset[int] = field(
        default_factory=lambda: frozenset({*_groups(), _number_of("getegid")})
    )
    machine: str = field(default_factory=platform.machine)
    python: str = sys.executable or ""

    def path(self, name: str) -> Path:
        """Give a path below the root for one that begins with /."""
        return self.root / name.lstrip("/")

    def read(self, name: str) -> str:
        """Read a file of text; "" if it cannot be read."""
        try:
            return self.path(name).read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""

    def exists(self, name: str) -> bool:
        """Say whether there is a file or a folder of this name."""
        try:
            return self.path(name).exists()
        except OSError:  # a folder above it may not be entered
            return False

    def glob(self, pattern: str) -> list[str]:
        """List the names that match a pattern below the root, sorted, each beginning with /."""
        found = self.root.glob(pattern.lstrip("/"))
        return sorted(f"/{path.relative_to(self.root)}" for path in found)

    def may(self, name: str, mode: int) -> bool:
        """Say whether this user may read, write or execute a file (os.access)."""
        return os.access(self.path(name), mode)

    def group_number(self, name: str) -> int:
        """Give the number of a file's group."""
        return self.path(name).stat().st_gid

    def group_of(self, name: str) -> tuple[int, str]:
        """Give the number and the name of a file's group; the name is "" where /etc/group has none."""
        number = self.group_number(name)
        for line in self.read("/etc/group").splitlines():
            parts = line.split(":")
            if len(parts) >= 3 and parts[2] == str(number):
                return number, parts[0]
        return number, ""

    def user(self) -> str:
        """Give the user's name; "" if the number has none, as in containers."""
        import pwd  # which Windows lacks

        try:
            return pwd.getpwuid(self.uid).pw_name
        except KeyError:
            return ""

    def is_member(self, group: str) -> bool:
        """Say whether /etc/group lists this user in a group, whether or not this process has the group yet."""
        for line in self.read("/etc/group").splitlines():
            parts = line.split(":")
            if len(parts) == 4 and parts[0] == group:
                return self.user() in parts[3].split(",") and self.user() != ""
        return False

    def run(self, command: Sequence[str], timeout: float = LONGEST) -> Ran:
        """Run a program and wait for its end."""
        try:
            done = subprocess.run(
                list(command),
                env=dict(self.environ),
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=timeout,
                check=False,
            )
        except subprocess.TimeoutExpired as late:
            return Ran(None, _text(late.stdout), _text(late.stderr), late=True)
        except (OSError, ValueError) as error:  # ValueError: a null byte in a word
            return Ran(None, "", str(error))
        return Ran(done.returncode, _text(done.stdout), _text(done.stderr))

    def library_problem(self, name: str) -> str:
        """Say why a library cannot be loaded; "" if it can."""
        ran = self.run([self.python, "-I", "-S", "-c", _LOAD, name], timeout=LONGEST)
        if ran.code == 0:
            return ""
        return ran.last_line or f"a process that loads it {ran.end(LONGEST)}"


def os_release(system: System) -> Mapping[str, str]:
    """Read /etc/os-release: ID, ID_LIKE, PRETTY_NAME and others."""
    return dict(_fields(system.read("/etc/os-release") or system.read("/usr/lib/os-release")))


def _fields(text: str) -> Iterator[tuple[str, str]]:
    for line in text.splitlines():
        key, equals, value = line.partition("=")
        if equals:
            yield key.strip(), value.strip().strip("\"'")


def _number_of(name: str) -> int:
    """Call os.geteuid or os.getegid; Windows, on which only an error is explained, lacks both."""
    function = getattr(os, name, None)
    return function() if function else -1


def _groups() -> list[int]:
    function = getattr(os, "getgroups", None)
    return function() if function else []


def _text(output: bytes | None) -> str:
    return (output or b"").decode("utf-8", "replace")
