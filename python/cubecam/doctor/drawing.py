"""Whether a picture can be drawn: a process of its own tries it."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, field
from typing import Any

from .findings import Finding, Status
from .system import Ran, System

__all__ = ["Drawing", "check_drawing", "child", "device_of", "read_lines", "try_drawing"]

#: How long the process may take, in seconds; starting a driver takes one, and some ten on a GPU that sleeps.
LONGEST = 90.0


@dataclass(frozen=True)
class Drawing:
    """What the process told before it ended; `error` is "" if it drew a picture."""

    devices: tuple[dict[str, Any], ...] = ()
    chosen: dict[str, Any] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    error: str = ""
    crashed: bool = False
    tried: bool = True

    @property
    def works(self) -> bool:
        """Whether a picture was drawn."""
        return self.tried and not self.error

    @property
    def blocking(self) -> Status:
        """The status of what can prevent drawing: only a problem if nothing was drawn."""
        return "warning" if self.works else "problem"


def child(module: str, device: str | None) -> list[str]:
    """Give the arguments of an interpreter that runs `main` of a module of this package, with this sys.path.

    `main` gets a list of one text, of which `device_of` makes the device.
    """
    code = (
        "import sys; sys.path[:] = sys.argv[1].split('\\n'); "
        f"from cubecam.doctor.{module} import main; main(sys.argv[2:])"
    )
    return ["-c", code, "\n".join(sys.path), device or ""]


def device_of(words: list[str]) -> str | int:
    """Give the device for a `Renderer` that `child` has handed over; digits are an index."""
    device = words[0] if words and words[0] else "auto"
    return int(device) if device.isdecimal() else device


def try_drawing(system: System, device: str | None) -> Drawing:
    """Let a process of its own list the devices and draw."""
    ran = system.run([system.python, *child("probe", device)], timeout=LONGEST)
    return read_drawing(ran)


def read_drawing(ran: Ran) -> Drawing:
    """Make a `Drawing` of what the process printed, and of how it ended."""
    told: dict[str, Any] = {}
    for line in read_lines(ran.out):
        told.update(line)
    error, crashed = str(told.get("error", "")), False
    if not error and (ran.code != 0 or "warnings" not in told):
        crashed = ran.late or (ran.code is not None and ran.code < 0)
        error = f"the process {ran.end(LONGEST)}"
        if ran.late or ran.code is not None:
            error += f" while {told.get('step', 'importing cubecam')}"
        error += f": {ran.last_line}" if ran.last_line else ""
    return Drawing(
        tuple(told.get("devices", ())),
        {**told.get("chosen", {}), "index": told.get("index", -1)} if "chosen" in told else {},
        tuple(told.get("warnings", ())),
        error,
        crashed,
    )


def read_lines(text: str) -> list[dict[str, Any]]:
    """Read the lines that are JSON objects; drivers print other lines, too."""
    found = []
    for line in text.splitlines():
        try:
            value = json.loads(line)
        except ValueError:
            continue
        if isinstance(value, dict):
            found.append(value)
    return found


def check_drawing(system: System, drawing: Drawing, device: str | None) -> list[Finding]:
    """Say what was drawn with, or why nothing was."""
    if not drawing.tried:
        return []
    if drawing.works:
        info = drawing.chosen
        kind = "software" if info["software"] else "GPU"
        return [
            Finding(
                "drawing",
                "ok",
                f"a picture was drawn by {info['renderer']} ({kind}), OpenGL {info['version']}",
            )
        ]
    cure: tuple[str, ...] = ()
    if drawing.crashed:
        cure = _without_a_driver(system)
    elif device not in (None, "auto") and any(not item["problem"] for item in drawing.devices):
        names = ", ".join(f"{item['index']}: {item['name']}" for item in drawing.devices)
        cure = (f"# these devices are there: {names}", "cubecam doctor --device auto")
    return [
        Finding(
            "drawing", "problem", f"no picture was drawn: {_without_advice(drawing.error)}", cure
        )
    ]


def _without_advice(error: str) -> str:
    """Leave out of a ContextError what it advises: the other findings say what fits this machine."""
    first, *lines = error.partition(". To install it:")[0].splitlines()
    return "\n".join([first, *(line for line in lines if line.startswith(" "))])


def _without_a_driver(system: System) -> tuple[str, ...]:
    """Say how to leave out the driver that crashed: by naming another one's vendor file."""
    from .vendors import vendor_files

    files = vendor_files(system)
    if len(files) < 2:
        return ("# a driver that crashes is broken or too old: install a newer version of it",)
    lines = [f"export __EGL_VENDOR_LIBRARY_FILENAMES={file}" for file in files]
    return ("# one of the drivers crashes; one of these lines leaves out the others:", *lines)
