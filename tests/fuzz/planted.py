"""Targets whose case 1 is a fault: they show that the runner finds each kind of fault."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

from tests.fuzz.runner import Target

MEMORY = 30 << 20


def _raise() -> None:
    raise KeyError("planted")


def _spin() -> None:
    end = time.process_time() + 0.8
    while time.process_time() < end:
        pass


FAULTS: dict[str, Callable[[], object]] = {
    "error": _raise,
    "slow": _spin,
    "hang": lambda: time.sleep(60),
    "crash": lambda: os.kill(os.getpid(), signal.SIGSEGV),
    "memory": lambda: len(os.urandom(2 * MEMORY)),
    "none": lambda: None,
}


def _target(name: str) -> Target:
    def attempt(case: bytes, folder: Path) -> None:
        if case == b"case 1":
            FAULTS[name]()

    return Target(
        name=f"planted-{name}",
        make=lambda number: f"case {number}".encode(),
        attempt=attempt,
        seconds=0.5,
        wall=2.0 if name == "hang" else 60.0,
        memory=MEMORY,
    )


TARGETS = {f"planted-{name}": _target(name) for name in FAULTS}
