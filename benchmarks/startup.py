"""The time from the start of an interpreter to `import` and to the first picture, for cubecam and moderngl."""

from __future__ import annotations

import os
import statistics
import tempfile
from pathlib import Path

from .processes import WorkerError, run_python
from .results import Row, Section

CUBECAM = """
import json, time
start = time.perf_counter()
import cubecam as cc
imported = time.perf_counter()
scene = cc.Scene(background=(0.4, 0.4, 0.4, 1))
scene.add(cc.PointLight(position=(5, 5, 5)))
scene.add(cc.Mesh.sphere(0.5), cc.PhongMaterial(color=(1, 0.4, 0.4)), position=(0, 0, -3))
with cc.Renderer() as renderer:
    faces = renderer.capture(scene, size=256, format="rgba8").faces
    done = time.perf_counter()
assert faces.shape[:3] == (6, 256, 256)
print(json.dumps({"import": imported - start, "picture": done - start}))
"""

# This program draws one triangle without a depth buffer, a light or a matrix: a minimal picture.
MODERNGL = """
import json, time
start = time.perf_counter()
import moderngl
import numpy as np
imported = time.perf_counter()
ctx = moderngl.create_context(
    standalone=True, backend="egl", libgl="libEGL.so.1", libegl="libEGL.so.1"
)
program = ctx.program(
    vertex_shader="#version 330\\nin vec2 p; void main() { gl_Position = vec4(p, 0, 1); }",
    fragment_shader="#version 330\\nout vec4 c; void main() { c = vec4(1); }",
)
corners = np.array([-1, -1, 3, -1, -1, 3], np.float32)
array = ctx.vertex_array(program, ctx.buffer(corners.tobytes()), "p")
target = ctx.simple_framebuffer((256, 256), 4)
target.use()
target.clear()
array.render()
pixels = np.frombuffer(target.read(components=4), np.uint8)
done = time.perf_counter()
assert pixels[0] == 255
print(json.dumps({"import": imported - start, "picture": done - start}))
"""


def run(quick: bool) -> list[Section]:
    """Time cold starts, with the driver's shader cache empty, and warm ones, after a run of the same programs."""
    section = Section("startup", "fresh interpreter to first picture")
    programs = {"cubecam": CUBECAM, "moderngl": MODERNGL}
    found: dict[tuple[str, str], list[dict[str, float]]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for index in range(4 if quick else 9):
            for name, code in list(programs.items()):
                for state in ("cold", "warm"):
                    cache = Path(folder) / name / ("warm" if state == "warm" else str(index))
                    cache.mkdir(parents=True, exist_ok=True)
                    env = {**os.environ, "MESA_SHADER_CACHE_DIR": str(cache)}
                    try:
                        answer = run_python(code, env)
                    except WorkerError as error:
                        section.notes.append(f"{name} is left out: {error}")
                        section.failed |= name == "cubecam"
                        del programs[name]
                        break
                    if index:  # the first round fills the warm caches and the page cache
                        found.setdefault((name, state), []).append(answer)
    steps = (
        ("import", "import", "warm"),
        ("picture", "first picture, cold", "cold"),
        ("picture", "first picture, warm", "warm"),
    )
    for key, title, state in steps:
        medians = {
            name: statistics.median(answer[key] for answer in found[name, state]) * 1e3
            for name in programs
        }
        for name, ms in medians.items():
            ratio = (
                medians.get("cubecam", 0) / ms
                if name != "cubecam" and "cubecam" in medians
                else None
            )
            section.rows.append(Row(f"{name}: {title}", ms, ratio))
    section.notes.append(
        "first picture counts the import: six lit 256x256 faces in cubecam, one triangle in moderngl"
    )
    return [section]
