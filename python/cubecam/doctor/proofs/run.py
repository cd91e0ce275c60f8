"""All proofs, one after the other, in this process or in one of their own."""

from __future__ import annotations

import dataclasses
import json
import sys
from collections.abc import Callable, Iterator
from typing import Any

from ..drawing import child, device_of, read_lines
from ..system import System
from .measurement import Measurement

__all__ = ["NAMES", "main", "prove", "prove_apart"]

NAMES = ("orientation", "seams", "formats", "mirrors", "shader")
#: How long all of them may take, in seconds: they take one to three.
LONGEST = 120.0


def prove(renderer: Any) -> Iterator[Measurement]:
    """Measure everything with a renderer; an exception fails its test and does not end the others."""
    for name in NAMES:
        try:
            yield from _proof(name)(renderer)
        except Exception as error:
            yield _without_picture(name, f"{type(error).__name__}: {error}")


def _proof(name: str) -> Callable[[Any], list[Measurement]]:
    import importlib

    module = importlib.import_module(f".{name}", __package__)
    function: Callable[[Any], list[Measurement]] = getattr(module, f"prove_{name}")
    return function


def main(words: list[str]) -> None:
    """Print each measurement as JSON in a line; `words` may have a device."""
    from ..._core import Renderer

    try:
        renderer = Renderer(device=device_of(words))
    except Exception as error:
        _tell(_without_picture(NAMES[0], f"{type(error).__name__}: {error}"))
        return
    with renderer:
        for found in prove(renderer):
            _tell(found)


def _tell(found: Measurement) -> None:
    sys.stdout.write(json.dumps(dataclasses.asdict(found)) + "\n")
    sys.stdout.flush()


def _without_picture(name: str, failure: str) -> Measurement:
    return Measurement(name, "no picture", float("nan"), 0.0, failure)


def prove_apart(system: System, device: str | None) -> list[Measurement]:
    """Measure everything in a process of its own, so that a driver that crashes fails a test and ends nothing else."""
    ran = system.run([system.python, *child("proofs.run", device)], timeout=LONGEST)
    found = [Measurement(**line) for line in read_lines(ran.out) if "tolerance" in line]
    done = {one.name for one in found}
    left = [name for name in NAMES if name not in done]
    # A driver may end a process with any status, also with that of success.
    if ran.code != 0 or (left and all(one.passed for one in found)):
        text = f"the process {ran.end(LONGEST)}" + (f": {ran.last_line}" if ran.last_line else "")
        found.append(_without_picture(left[0] if left else NAMES[-1], text))
    return found
