"""Random edits of random worlds: after each, every picture equals one that is drawn from scratch.

The edits are those of tests/gl/edits.py, one for each property that can be set and each class that has it. A fault
names the seed of its world and the number of its edit: the same seed makes the same edits.
"""

from __future__ import annotations

import copy
import functools
import time
import traceback
from collections.abc import Callable
from typing import Any

import numpy as np

import cubecam as cc
from tests.compare import assert_identical
from tests.gl import edits
from tests.gl.full_world import full_world, pictures
from tests.helpers import DEVICE
from tests.soak.report import Report

EDITS = 60  # in one world: later edits meet what earlier ones left


def difference(got: dict[str, Any], want: dict[str, Any]) -> str | None:
    """Say in which picture two dicts differ; a picture that the other renderer has not drawn is skipped."""
    for name, picture in want.items():
        if isinstance(picture, str) and "renderer has drawn" in picture:
            continue
        if name not in got:
            return f"{name} is missing"
        try:
            if isinstance(picture, str) or isinstance(got[name], str):
                assert isinstance(picture, str) == isinstance(got[name], str), (
                    "a picture and an error"
                )
                assert got[name] == picture
            else:
                assert_identical(got[name], picture)
        except AssertionError as error:
            return f"{name}: {str(error).splitlines()[0] if str(error) else 'another error'}"
    return None


def names() -> list[str]:
    """Return the edits, each once for each class that has it: a property of all materials is drawn for each kind."""
    return [*edits.NAMES, *edits.METHODS]


def one_world(
    live: cc.Renderer,
    scratch: cc.Renderer,
    seed: int,
    count: int,
    report: Report,
    until: float = float("inf"),
    draw: Callable[[cc.Renderer, Any], dict[str, Any]] = pictures,
) -> None:
    """Edit one world `count` times, and draw it with a renderer that saw all edits and one that saw none.

    `scratch` draws deep copies, of whose objects it has kept nothing; only its programs are not compiled again.
    """
    rng = np.random.default_rng([seed, 14])
    world = full_world(rng)
    all_names = names()
    draw(live, world)
    for number in range(count):
        if time.monotonic() > until:
            return
        name = all_names[rng.integers(len(all_names))]
        what, undo = edits.edit(name, world, rng, functools.partial(pictures, live, world))
        got = draw(live, world)
        found = difference(got, pictures(scratch, copy.deepcopy(world)))
        report.count("edits")
        if found:
            report.faults.append(f"edits, seed {seed}, edit {number}, {what}: {found}")
            return
        refused = any(isinstance(x, str) and "renderer has drawn" not in x for x in got.values())
        if undo is not None and (refused or rng.random() < 0.3):
            undo()
            draw(live, world)


def run(until: float, seed: int) -> Report:
    """Edit worlds until then (time.monotonic)."""
    report = Report()
    while time.monotonic() < until:
        with cc.Renderer(device=DEVICE) as live, cc.Renderer(device=DEVICE) as scratch:
            for _ in range(20):  # a renderer compiles a hundred programs for its first world
                try:
                    one_world(live, scratch, seed, EDITS, report, until)
                except Exception as error:
                    place = traceback.format_exc().splitlines()[-3].strip()
                    what = f"{type(error).__name__}: {error} ({place})"
                    report.faults.append(f"edits, seed {seed}: {what}")
                report.count("worlds")
                seed += 1
                if time.monotonic() > until:
                    break
    return report
