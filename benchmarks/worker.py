"""A process that draws P14 with one implementation; it reads its requests line by line.

    python -m benchmarks.worker NAME MESH.npz

It answers one JSON line for each JSON line it reads. One process for each implementation keeps their GL
libraries, allocators and caches separate; the parent lets only one process work at a time.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
from typing import Any

import numpy as np

from . import scene

# name: (module, what its Program takes besides the mesh)
IMPLEMENTATIONS: dict[str, tuple[str, dict[str, bool]]] = {
    "cubecam": ("p14_cubecam", {}),
    "cubecam, all faces anew": ("p14_cubecam", {"redraw": True}),
    "moderngl": ("p14_moderngl", {}),
    "moderngl, layered": ("p14_moderngl", {"layered": True}),
    "moderngl, culled by hand": ("p14_moderngl", {"cull": True}),
    "ZenGL": ("p14_zengl", {}),
    "ZenGL, culled by hand": ("p14_zengl", {"cull": True}),
}


def _answer(program: Any, request: dict[str, Any]) -> dict[str, Any]:
    if request["do"] == "versions":
        versions: dict[str, Any] = program.versions()
        return versions
    if request["do"] == "picture":
        np.save(request["path"], np.ascontiguousarray(program.frame(request["frame"])[..., :3]))
        return {}
    times, views = [], []
    for frame in range(request["first"], request["first"] + request["count"]):
        start = time.perf_counter()
        program.frame(frame)
        times.append((time.perf_counter() - start) * 1e3)
        if hasattr(program, "views_drawn"):
            views.append(program.views_drawn())
    return {"ms": times, "views": views}


def main() -> None:
    answers = sys.stdout
    sys.stdout = sys.stderr  # what a library prints must not be taken for an answer
    module, options = IMPLEMENTATIONS[sys.argv[1]]
    arrays = np.load(sys.argv[2])
    mesh = scene.MeshArrays(arrays["positions"], arrays["normals"], arrays["indices"])
    program = importlib.import_module(f".peers.{module}", __package__).Program(mesh, **options)
    print(json.dumps({}), file=answers, flush=True)
    for line in sys.stdin:
        print(json.dumps(_answer(program, json.loads(line))), file=answers, flush=True)


if __name__ == "__main__":
    main()
