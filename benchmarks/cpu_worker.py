"""A process that runs one program and reports the CPU time of all its threads, request by request.

    python benchmarks/cpu_worker.py TREE MODULE:CLASS OPTIONS

TREE is the folder whose `benchmarks` package holds the program: this tree, or that of the previous version. OPTIONS
are the class's keyword arguments as JSON; "mesh" names a file of arrays. The process answers one JSON line for each
that it reads. The CPU time counts the rasteriser's threads; other work on the machine changes it less than wall time.

A program has `draw(index)`, which gives a picture or None; where it has them, `prepare(index)` makes the frame's
input before the clock starts, and `move(index)` is timed separately. If it has only `frame(index)`, that is called.
"wall" is the time by the clock of moving and drawing. `arrays(index)` gives all arrays of a frame by their names, and
a request "call" calls any other method.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np


def _nothing(index: int) -> None:
    pass


class _Steps:
    """Those steps of a frame that a program has."""

    def __init__(self, program: Any) -> None:
        self.program: Any = program
        self.prepare: Any = getattr(program, "prepare", _nothing)
        self.move: Any = (
            getattr(program, "move", _nothing) if hasattr(program, "draw") else _nothing
        )
        self.draw: Any = (
            program.draw if hasattr(program, "draw") else getattr(program, "frame", None)
        )

    def picture(self, index: int) -> np.ndarray:
        self.prepare(index)
        self.move(index)
        pixels: np.ndarray = self.draw(index)
        return pixels

    def time(self, index: int) -> tuple[float, float, float]:
        """CPU milliseconds of moving, and of drawing, which includes reading the picture; milliseconds of both."""
        self.prepare(index)
        begin, start = time.perf_counter(), time.process_time()
        self.move(index)
        moved = time.process_time()
        self.draw(index)
        end, now = time.process_time(), time.perf_counter()
        return (moved - start) * 1e3, (end - moved) * 1e3, (now - begin) * 1e3


def _load(tree: str, name: str, options: dict[str, Any]) -> _Steps:
    here = str(Path(__file__).resolve().parent)
    sys.path[:] = [tree] + [path for path in sys.path if path != here]
    import cubecam

    if tree != str(Path(here).parent) and not Path(cubecam.__file__).is_relative_to(tree):
        raise ImportError(f"expected cubecam from {tree}, got {cubecam.__file__}")
    module, factory = name.split(":")
    if "mesh" in options:
        arrays = np.load(options["mesh"])
        kind = importlib.import_module("benchmarks.scene").MeshArrays
        options["mesh"] = kind(arrays["positions"], arrays["normals"], arrays["indices"])
        options["actor"] = options.pop("mesh")
    return _Steps(getattr(importlib.import_module(f"benchmarks.{module}"), factory)(**options))


def _answer(steps: _Steps, request: dict[str, Any]) -> dict[str, Any]:
    if request["do"] == "picture":
        picture = np.ascontiguousarray(steps.picture(request["frame"])[..., :3])
        np.save(request["path"], picture)
        return {}
    if request["do"] == "arrays":
        np.savez(request["path"], **steps.program.arrays(request["frame"]))
        return {}
    if request["do"] == "call":
        return {"result": getattr(steps.program, request["name"])(**request["options"])}
    times = [steps.time(request["first"] + offset) for offset in range(request["count"])]
    return {name: [t[at] for t in times] for at, name in enumerate(("move", "draw", "wall"))}


def main() -> None:
    answers = sys.stdout
    sys.stdout = sys.stderr  # what a library prints must not be taken for an answer
    steps = _load(sys.argv[1], sys.argv[2], json.loads(sys.argv[3]))
    print(json.dumps({}), file=answers, flush=True)
    for line in sys.stdin:
        print(json.dumps(_answer(steps, json.loads(line))), file=answers, flush=True)


if __name__ == "__main__":
    main()
