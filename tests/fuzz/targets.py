"""All targets by name."""

from __future__ import annotations

from tests.fuzz import api, files, glsl, pickles, planted
from tests.fuzz.runner import Target

FILES = [*files.MESHES, *files.PICTURES]
NAMES = ["api", "pickles", "glsl", *FILES]
#: Cases of `make fuzz` without options: one takes longer than another.
COUNTS = {"api": 20_000, "pickles": 30_000, "glsl": 3_000, **dict.fromkeys(FILES, 30_000)}


def target(name: str) -> Target:
    """Return a target by its name."""
    if name in FILES:
        return files.target(name)
    return {**planted.TARGETS, "api": api.TARGET, "pickles": pickles.TARGET, "glsl": glsl.TARGET}[
        name
    ]
