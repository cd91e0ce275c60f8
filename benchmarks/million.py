"""What a million cubemaps take: CPU time, bytes, memory and the start of a worker, measured, and what follows.

    python -m benchmarks.million                                  tables of Markdown, in two minutes
    python -m benchmarks.million --page docs/howto/million.md     writes them into the page
    python -m benchmarks.million --device gpu                     on a GPU: times are by the clock

Each kind of scene is measured in a process of its own, as a worker of `cc.Pool` is: with LP_NUM_THREADS=0, so that a
worker is a thread. It starts when Python does, and ends to start with the first cubemap. `draw` is the median of some
calls of `capture_many`, `write` that of `to_zarr` with its defaults. The memory is the most that the process had in RAM
when 64 cubemaps, a file of the store, were drawn and written. The scenes:

- **boxes**: a room with 12 boxes, one lamp, Phong; faces of 64 pixels
- **teapots**: 20 teapots on a ground (`benchmarks/field.py`), Phong; 64 pixels
- **gallery**: `gallery.glb` of cubecam's data, metallic-roughness with a map, one lamp and an environment; 256 pixels
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from . import field, machine
from .processes import ROOT

BEGIN, END = "<!-- benchmarks.million -->", "<!-- end -->"
MILLION = 1_000_000
GROUP = 64  # cubemaps of one file of a store
#: Faces in pixels, and cubemaps of one call.
KINDS = {"boxes": (64, 256), "teapots": (64, 256), "gallery": (256, 64)}
ROUNDS = 5
FORMATS = ("rgba8", "rgba16f", "rgba32f")
OUTPUTS = ("distance", "id", "normal")
#: What the tables of hours take: half floats and the distance.
FORMAT, OUTPUT = "rgba16f", "distance"
STARTS, MEMORY = "worker starts, s of CPU / clock", "memory of a worker, MiB"
CORES = 64  # of the machine for which minutes are reckoned


@dataclasses.dataclass
class Kind:
    """What was measured of a kind of scene; times are milliseconds of one cubemap, sizes are bytes of one cubemap."""

    name: str
    size: int
    draw: float
    write: float
    start_cpu: float  # seconds
    start_wall: float  # seconds
    memory: int  # MiB, the most that the process had in RAM
    raw: dict[str, int]
    stored: dict[str, int]


def make_scene(name: str) -> tuple[Any, np.ndarray]:
    """A scene, and the corners (2, 3) of the box in which its captures are."""
    import cubecam as cc

    if name == "teapots":
        from .peers.batches_cubecam import make_scene as teapots

        return teapots(field.Field()), np.array([(-4.0, 1.5, -4.0), (4.0, 3.0, 4.0)])
    if name == "gallery":
        scene = cc.load_scene(cc.sample_data("gallery.glb"))
        scene.environment = cc.load_environment(cc.sample_data("interior.exr"), size=128)
        low, high = scene.bounds
        return scene, np.array([0.8 * low + 0.2 * high, 0.2 * low + 0.8 * high])
    random = np.random.default_rng(20)
    scene = cc.Scene()
    scene.add(cc.PointLight((0.5, 1.2, 0.3)))
    walls = cc.PhongMaterial(color=(0.8, 0.8, 0.7), double_sided=True)
    scene.add(cc.Mesh.box((6, 3, 5)), walls)
    for _ in range(12):
        paint = cc.PhongMaterial(color=random.uniform(0.2, 1, 3))
        place = random.uniform((-2.5, -1.3, -2), (2.5, 0, 2))
        scene.add(cc.Mesh.box(random.uniform(0.2, 0.8, 3)), paint, position=place)
    return scene, np.array([(-2.5, 0.0, -2.0), (2.5, 1.3, 2.0)])


# ----- measuring, in a process of its own


def measure(name: str, device: str, rounds: int) -> dict[str, Any]:
    """Everything that one process finds out about a kind of scene."""
    import cubecam as cc

    size, many = KINDS[name]
    scene, box = make_scene(name)
    random = np.random.default_rng(5)
    renderer = cc.Renderer(device=device)
    clock = time.process_time if renderer.info.software else time.perf_counter

    def capture(count: int, pixels: Any, outputs: tuple[str, ...]) -> cc.CubeMapBatch:
        places = random.uniform(box[0], box[1], (count, 3))
        return renderer.capture_many(
            scene, places, size, format=pixels, outputs=outputs, progress=False
        )

    capture(1, FORMAT, (OUTPUT,))
    found: dict[str, Any] = {"start_cpu": time.process_time(), "ready": time.monotonic()}
    draws, writes = [], []
    with tempfile.TemporaryDirectory() as folder:
        capture(GROUP, FORMAT, (OUTPUT,)).to_zarr(Path(folder) / "first.zarr")
        found["memory"] = _most_memory()
        for number in range(rounds):
            begin = clock()
            batch = capture(many, FORMAT, (OUTPUT,))
            drawn = clock()
            batch.to_zarr(Path(folder) / f"{number}.zarr")
            draws.append((drawn - begin) * 1e3 / many)
            writes.append((clock() - drawn) * 1e3 / many)
        found |= {"draw": statistics.median(draws), "write": statistics.median(writes)}
        found |= {"raw": {}, "stored": {}}
        for pixels in FORMATS:
            outputs = OUTPUTS if pixels == FORMATS[0] else ()
            batch = capture(GROUP, pixels, outputs)
            store = Path(folder) / f"{pixels}.zarr"
            batch.to_zarr(store)
            arrays = {pixels: batch.faces, **batch.outputs}
            for part, array in arrays.items():
                kept = store / ("color" if part == pixels else part)
                files = sum(path.stat().st_size for path in kept.rglob("*") if path.is_file())
                found["raw"][part] = array.nbytes // GROUP
                found["stored"][part] = files // GROUP
    return found


def _most_memory() -> int:
    """MiB: the most that this process had in RAM."""
    (line,) = re.findall(r"VmHWM:\s+(\d+) kB", Path("/proc/self/status").read_text())
    return round(int(line) / 1024)


def measured(name: str, device: str, rounds: int) -> Kind:
    """Measure a kind of scene in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.million", "--measure", name]
    command += ["--device", device, "--rounds", str(rounds)]
    begin = time.monotonic()
    done = subprocess.run(
        command,
        cwd=ROOT,
        env={**os.environ, "LP_NUM_THREADS": "0", "OMP_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    found = json.loads(done.stdout.splitlines()[-1])
    found["start_wall"] = found.pop("ready") - begin
    return Kind(name=name, size=KINDS[name][0], **found)


# ----- what follows


def followed(kind: Kind) -> list[str]:
    """What a million cubemaps take: the cells of a row."""
    one = (kind.draw + kind.write) / 1e3  # seconds of a core
    raw, stored = (sum(of[part] for part in (FORMAT, OUTPUT)) for of in (kind.raw, kind.stored))
    return [
        f"{MILLION * one / 3600:.2f}",
        f"{MILLION * one / 60 / CORES:.1f}",
        f"{MILLION * raw / 1e9:.0f}",
        f"{MILLION * stored / 1e9:.0f}",
        f"{CORES / one * stored / 1e6:.0f}",
    ]


def tables(kinds: list[Kind], about: dict[str, Any], per: str) -> str:
    """All tables, as Markdown. `per` is what times are of: "CPU" or "clock"."""
    names = [kind.name for kind in kinds]
    lines = [
        f"Measured on {about['cores']} cores of {about['cpu']}; {about['gl']}; {FORMAT} and {OUTPUT}.",
        "",
        f"| scene | faces | draw, ms of {per} | write, ms of {per} | {STARTS} | {MEMORY} |",
        "|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {k.name} | {k.size} | {k.draw:.2f} | {k.write:.2f} | {k.start_cpu:.1f} / {k.start_wall:.1f} | {k.memory} |"
        for k in kinds
    ]
    lines += [
        "",
        f"| KB of a cubemap, raw / stored | {' | '.join(names)} |",
        "|---" * (1 + len(kinds)) + "|",
    ]
    for part in (*FORMATS, *OUTPUTS):
        cells = [f"{k.raw[part] / 1e3:.1f} / {k.stored[part] / 1e3:.1f}" for k in kinds]
        lines.append(f"| {part} | {' | '.join(cells)} |")
    lines += [
        "",
        f"| a million | core hours | minutes on {CORES} cores | GB raw | GB stored | MB/s that {CORES} cores write |",
        "|---" * 6 + "|",
    ]
    lines += [f"| {kind.name} | {' | '.join(followed(kind))} |" for kind in kinds]
    return "\n".join(lines)


def write_page(path: Path, text: str) -> None:
    """Put the tables between a document's marks."""
    before, _, rest = path.read_text(encoding="utf-8").partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise SystemExit(f"{path}: expected the lines {BEGIN} and {END}, got none")
    path.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.million")
    parser.add_argument("--device", default="software", help="as cubecam.Renderer(device=)")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="fewer: noisier")
    parser.add_argument("--page", type=Path, help="a document that gets the tables")
    parser.add_argument("--json", type=Path, help="where the figures go, besides the tables")
    parser.add_argument("--measure", choices=KINDS, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    if options.measure:
        print(json.dumps(measure(options.measure, options.device, options.rounds)))
        return 0
    kinds = [measured(name, options.device, options.rounds) for name in KINDS]
    about = machine.describe()
    text = tables(kinds, about, "CPU" if options.device == "software" else "clock")
    print(text)
    if options.page:
        write_page(options.page, text)
    if options.json:
        data = {"machine": about, "kinds": [dataclasses.asdict(kind) for kind in kinds]}
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(data, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
