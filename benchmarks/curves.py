"""How the cost of a cubemap depends on the scene and on the arguments of the capture.

    python -m benchmarks.curves                                    all curves, in five minutes
    python -m benchmarks.curves --only lights --only samples
    python -m benchmarks.curves --history out/curves --page docs/explanation/cost_curves.md

Each curve changes one number of a field (`benchmarks/field.py`): teapots on a ground, captured from a place that is
another one for each frame, so that all faces are drawn. At each point cubecam, programs in moderngl and ZenGL that
cull by hand, VTK, Panda3D and a loop in C++ over OpenGL calls draw the same frames; their arrays are compared first,
and then they take turns. A last time is that of copying the result's bytes, which nothing can be below. Times are
medians: CPU time of all threads, and by the clock.

`--history` gets a file for each run: commit, machine, driver and all points. `--page` writes the table and the lines
into a document, between its marks, and the figure beside it. `--callgrind` counts instructions with valgrind.
"""

from __future__ import annotations

import argparse
import dataclasses
import datetime
import json
import os
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from . import batches, machine
from .processes import ROOT, CpuWorker, WorkerError

#: What stands in a document before and after the tables.
BEGIN, END = "<!-- benchmarks.curves -->", "<!-- end -->"
PICTURE = ROOT / "docs" / "images" / "why-cost-curves.svg"
OUTPUTS = ("distance", "normal", "position", "z")
#: Programs that draw the same. In moderngl, ZenGL and C++ their objects are culled by hand; VTK and Panda3D cull by
#: themselves. The loop in C++ calls OpenGL and nothing else.
PEERS = {
    "moderngl": batches.MODERNGL,
    "ZenGL": "peers.batches_zengl:Culled",
    "VTK": "peers.batches_vtk:Actors",
    "Panda3D": "peers.batches_panda3d:Nodes",
    "C++": "peers.batches_floor:Loop",
}
COLORS_ALONE = {"VTK", "Panda3D"}
ONE_SAMPLE = {"Panda3D"}
#: Packages that a peer needs, if its name in lower case is not the only one.
NEEDED = {"C++": ("glad", "moderngl"), "Panda3D": ("panda3d", "moderngl")}
OWN, OTHER_PICTURES = "cubecam", "other pictures"
BASE: dict[str, Any] = {"probes": 1, "size": 128, "outputs": []}


@dataclasses.dataclass(frozen=True)
class Curve:
    """One number that changes, and what a field has for a value of it."""

    name: str
    unit: str  # what one more is
    fixed: str  # what does not change
    values: tuple[int, ...]
    options: Callable[[int], dict[str, Any]]
    program: str = batches.SINGLE


CURVES = (
    Curve(
        "triangles",
        "1,000 triangles",
        "20 knots, 128 pixels",
        (2_000, 8_000, 32_000, 128_000, 512_000),
        lambda n: {"triangles": n},
    ),
    Curve(
        "nodes",
        "node",
        "5 materials, 100 triangles a node",
        (1, 10, 100, 1_000),
        lambda n: {"nodes": n, "triangles": 100 * n, "colors": min(n, 5)},
    ),
    Curve(
        "materials",
        "material",
        "200 nodes of 100 triangles",
        (1, 4, 20, 100, 200),
        lambda n: {"nodes": 200, "triangles": 20_000, "colors": n},
    ),
    Curve("lights", "light", "20 teapots", (1, 2, 4, 8, 16), lambda n: {"lights": n}),
    Curve(
        "probes",
        "cubemap",
        "20 teapots, one capture_many",
        (1, 4, 16, 64),
        lambda n: {"probes": n},
        batches.BATCH,
    ),
    Curve(
        "face size",
        "1,000 pixels of a face",
        "20 teapots",
        (16, 64, 128, 256, 512),
        lambda n: {"size": n},
    ),
    Curve(
        "outputs",
        "output",
        "20 teapots; " + ", ".join(OUTPUTS),
        (0, 1, 2, 3, 4),
        lambda n: {"outputs": list(OUTPUTS[:n])},
    ),
    Curve("samples", "sample", "20 teapots", (1, 2, 4, 8), lambda n: {"samples": n}),
)


@dataclasses.dataclass
class Point:
    """The times of one value of a curve, milliseconds, by programs' names; a peer that draws something else has none.

    `cpu_ratio` and `wall_ratio` are cubecam's time over the peer's, the median of the rounds' ratios.
    """

    curve: str
    value: int
    cpu: dict[str, float]
    wall: dict[str, float]
    cpu_ratio: dict[str, float]
    wall_ratio: dict[str, float]
    copy: float  # of the result's bytes, by np.copyto into memory that is kept
    bytes: int


def scale(curve: str, value: float) -> float:
    """A value in the curve's unit."""
    if curve == "triangles":
        return value / 1000
    return value * value / 1000 if curve == "face size" else value


def copy_ms(arrays: batches.Arrays) -> float:
    """Milliseconds of copying arrays into memory that is kept."""
    kept = [np.zeros_like(array) for array in arrays.values()]
    times = []
    for _ in range(15):
        start = time.perf_counter()
        for into, array in zip(kept, arrays.values(), strict=True):
            np.copyto(into, array)
        times.append((time.perf_counter() - start) * 1e3)
    return min(times)


def installed() -> dict[str, str]:
    """Those of PEERS whose packages there are, and the loop in C++ if there is a compiler."""
    compiler = shutil.which("c++") or shutil.which("g++")
    return {
        name: path
        for name, path in PEERS.items()
        if all(find_spec(package) for package in NEEDED.get(name, (name.lower(),)))
        and (name != "C++" or compiler)
    }


def measure(
    curve: Curve, value: int, rounds: int, base: dict[str, Any] = BASE
) -> tuple[Point | None, list[str]]:
    """One point, None if cubecam cannot draw it, and what was left out, in words."""
    options = {**base, **curve.options(value)}
    notes: list[str] = []
    programs: dict[str, CpuWorker] = {}
    own: batches.Arrays = {}
    with ExitStack() as stack:
        for name, path in {OWN: curve.program, **installed()}.items():
            if name in COLORS_ALONE and options["outputs"]:
                continue
            if name in ONE_SAMPLE and options.get("samples", 1) > 1:
                continue
            try:
                program = CpuWorker(path, **options)
                stack.callback(program.close)
                arrays = batches.arrays_of(program, 1)
            except WorkerError as error:
                notes.append(f"{curve.name} {value}, {name}: {error}")
            else:
                own = own or arrays
                if wrong := batches.difference(own, arrays):
                    notes.append(f"{curve.name} {value}, {name}: {OTHER_PICTURES}: {wrong}")
                else:
                    programs[name] = program
            if OWN not in programs:
                return None, notes
        found = dict(
            zip(
                programs,
                batches.turns(
                    list(programs.values()),
                    rounds,
                    5 if value < 512 and curve.name != "probes" else 3,
                ),
                strict=True,
            )
        )
    middle = {
        clock: {name: statistics.median(times[clock]) for name, times in found.items()}
        for clock in ("cpu", "wall")
    }
    ratios = {
        clock: {
            name: batches.ratio(found[OWN][clock], times[clock])
            for name, times in found.items()
            if name != OWN
        }
        for clock in ("cpu", "wall")
    }
    size = sum(array.nbytes for array in own.values())
    point = Point(
        curve.name,
        value,
        middle["cpu"],
        middle["wall"],
        ratios["cpu"],
        ratios["wall"],
        copy_ms(own),
        size,
    )
    return point, notes


def line(xs: Iterable[float], ys: Iterable[float]) -> tuple[float, float]:
    """The line a + b x of the least squares of relative errors: (a, b)."""
    x, y = np.array(list(xs), float), np.array(list(ys), float)
    b, a = np.polyfit(x, y, 1, w=1 / y)
    return float(a), float(b)


def _points_of(points: list[Point], curve: Curve) -> list[Point]:
    return [point for point in points if point.curve == curve.name]


def _text(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}" if value < 100 else f"{value:.0f}"


def lines_markdown(points: list[Point]) -> str:
    """A table of the lines through the curves' points."""
    names = [OWN, *PEERS]
    rows = [
        f"| curve | what stays | {' | '.join(names)} | one more is |",
        "|---" * (3 + len(names)) + "|",
    ]
    for curve in CURVES:
        found = _points_of(points, curve)
        cells = []
        for name in names:
            known = [point for point in found if name in point.cpu]
            if len(known) < 2:
                cells.append("")
                continue
            xs = [scale(curve.name, point.value) for point in known]
            a, b = line(xs, [point.cpu[name] for point in known])
            cells.append(f"{_signed(a)} {'-' if b < 0 else '+'} {abs(b):.3g}")
        if found:
            rows.append(f"| {curve.name} | {curve.fixed} | {' | '.join(cells)} | {curve.unit} |")
    return "\n".join(rows)


def _signed(value: float) -> str:
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


def points_markdown(points: list[Point]) -> str:
    """A table of all points."""
    heads = ["curve", "value", OWN, *(f"{name}" for name in PEERS)]
    heads += [f"CPU over {name}" for name in PEERS] + ["copying the result"]
    rows = [f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
    for p in points:
        cells = [p.curve, f"{p.value:,}"]
        cells += [_both(p, name) for name in (OWN, *PEERS)]
        cells += [_text(p.cpu_ratio.get(name)) for name in PEERS] + [_text(p.copy)]
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


def _both(point: Point, name: str) -> str:
    """CPU time and time by the clock."""
    if name not in point.cpu:
        return ""
    return f"{_text(point.cpu[name])} / {_text(point.wall[name])}"


COPYING = "copying the result"
STYLES = {
    OWN: ("o-", "#c0392b"),
    "moderngl": ("s--", "#2c5f8a"),
    "ZenGL": ("^--", "#3b8a5a"),
    "VTK": ("d--", "#9a6bb0"),
    "Panda3D": ("v--", "#c78a2e"),
    "C++": ("x-", "#333333"),
    COPYING: (":", "#777777"),
}


def draw(points: list[Point], path: Path) -> None:
    """Draw a picture of all curves: milliseconds of CPU time over the value, both logarithmic."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "cubecam", "font.size": 8}):
        figure, panels = plt.subplots(2, 4, figsize=(9.6, 4.6), layout="constrained")
        for curve, panel in zip(CURVES, panels.flat, strict=True):
            found = _points_of(points, curve)
            xs = [point.value for point in found]
            for name, (style, color) in STYLES.items():
                ys = [p.copy if name == COPYING else p.cpu.get(name, np.nan) for p in found]
                panel.plot(xs, ys, style, color=color, markersize=3, linewidth=1.2, label=name)
            panel.set_title(curve.name, fontsize=9)
            panel.set_yscale("log")
            if curve.name != "outputs":
                panel.set_xscale("log", base=10 if max(xs, default=1) > 600 else 2)
            panel.set_xticks(xs, [f"{x // 1000}k" if x >= 2000 else str(x) for x in xs])
            panel.minorticks_off()
            panel.grid(alpha=0.3)
        panels[0, 0].legend(fontsize=6.5)
        for panel in panels[:, 0]:
            panel.set_ylabel("ms of CPU time")
        path.parent.mkdir(parents=True, exist_ok=True)
        metadata = {"Date": None} if path.suffix == ".svg" else None
        figure.savefig(path, metadata=metadata, dpi=120)
        plt.close(figure)


def record(points: list[Point], notes: list[str], found: dict[str, Any]) -> dict[str, Any]:
    """One entry of the history."""
    return {
        "commit": _commit(),
        "time": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "machine": {k: v for k, v in found.items() if k != "gl" and v != "absent"},
        "driver": found["gl"],
        "points": [dataclasses.asdict(point) for point in points],
        "notes": notes,
    }


def _commit() -> str:
    """The commit of this tree, with "+" if files differ from it; "unknown" without git."""
    try:
        head, changed = (
            subprocess.run(
                ["git", *words], cwd=ROOT, capture_output=True, text=True, check=True
            ).stdout.strip()
            for words in (["rev-parse", "HEAD"], ["status", "--porcelain", "-uno"])
        )
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return head + ("+" if changed else "")


def write_history(folder: Path, entry: dict[str, Any]) -> Path:
    """Write an entry into a file of its own, whose name begins with its time."""
    folder.mkdir(parents=True, exist_ok=True)
    name = entry["time"][:19].replace(":", "").replace("-", "") + "-" + entry["commit"][:9]
    path = folder / f"{name}.json"
    path.write_text(json.dumps(entry, indent=1) + "\n")
    return path


def put_into(page: Path, text: str) -> None:
    """Replace what stands between the marks of a document."""
    before, _, rest = page.read_text().partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise SystemExit(f"{page}: expected the marks {BEGIN} and {END}, found none")
    page.write_text(f"{before}{BEGIN}\n\n{text.strip()}\n\n{END}{after}")


CALLS = """
import sys
import cubecam as cc
work, count = sys.argv[1], int(sys.argv[2])
scene = cc.Scene(background=(0.2, 0.3, 0.4))
if work == "unchanged":
    scene.add(cc.Mesh.sphere(1), cc.PhongMaterial(), position=(0, 0, -3))
    scene.add(cc.PointLight(position=(1, 2, 1)))
with cc.Renderer() as renderer:
    for number in range(count):
        place = (0, 0, 0) if work == "unchanged" else (0.01 * number, 0, 0)
        renderer.capture(scene, place, size=8, format="rgba8")
"""
COUNTED = {"unchanged": "a capture that is not drawn again", "empty": "a capture of an empty scene"}


def _counted(work: str, calls: int) -> int:
    """All instructions of a process that makes some calls."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    command += [sys.executable, "-c", CALLS, work, str(calls)]
    # Neither threads nor a cache of compiled shaders may make one process do more than another.
    same = {"LP_NUM_THREADS": "0", "MESA_SHADER_CACHE_DISABLE": "true", "PYTHONHASHSEED": "0"}
    same["OPENBLAS_NUM_THREADS"] = "1"
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, **same}, capture_output=True, text=True
    )
    said = [text for text in done.stderr.splitlines() if "Collected :" in text]
    if done.returncode or not said:
        raise WorkerError((done.stderr.splitlines() or ["valgrind wrote nothing"])[-1])
    return int(said[-1].split(":")[-1])


def instructions(work: str, few: int = 20, many: int = 520) -> tuple[float, float]:
    """Instructions of one call, and the difference of two equal processes, shared among the calls."""
    first, again, more = (_counted(work, calls) for calls in (few, few, many))
    return (more - (first + again) / 2) / (many - few), abs(first - again) / (many - few)


def _callgrind(console: Console) -> int:
    if shutil.which("valgrind") is None:
        console.print("expected valgrind on PATH, found none")
        return 1
    failed = False
    for work, meaning in COUNTED.items():
        count, off = instructions(work)
        if count <= 4 * off:  # what else the processes do is not the same: no figure
            failed = True
            console.print(f"{meaning}: no figure, equal processes differ by {off:,.0f} a call")
            continue
        console.print(f"{meaning}: {count:,.0f} instructions, within {off:,.0f}", highlight=False)
    return int(failed)


def _show(console: Console, points: list[Point]) -> None:
    table = Table(title="ms of a frame: CPU time of all threads / by the clock")
    heads = ["curve", "value", OWN, *PEERS, *(f"CPU over {name}" for name in PEERS), "copying"]
    for name in heads:
        table.add_column(name, justify="left" if name == "curve" else "right")
    for p in points:
        both = [_both(p, name) for name in (OWN, *PEERS)]
        ratios = [_text(p.cpu_ratio.get(name)) for name in PEERS]
        table.add_row(p.curve, f"{p.value:,}", *both, *ratios, _text(p.copy))
    console.print(table)


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.curves")
    parser.add_argument("--only", action="append", choices=[curve.name for curve in CURVES])
    parser.add_argument("--quick", action="store_true", help="fewer rounds: noisier")
    parser.add_argument("--history", type=Path, metavar="DIR", help="gets a file for this run")
    parser.add_argument("--page", type=Path, metavar="FILE", help="a document that gets the tables")
    parser.add_argument(
        "--picture", type=Path, default=PICTURE, help="where the figure of --page goes"
    )
    parser.add_argument(
        "--callgrind", action="store_true", help="only count the instructions of two calls"
    )
    options = parser.parse_args(arguments)
    console = Console()
    if not console.is_terminal:
        console.width = 110
    if options.callgrind:
        return _callgrind(console)
    if options.page and options.only:
        parser.error("--page: expected all curves, got --only")
    points: list[Point] = []
    notes = [f"{name}, which is not installed" for name in PEERS if name not in installed()]
    for curve in CURVES:
        if options.only and curve.name not in options.only:
            continue
        for value in curve.values:
            with console.status(f"{curve.name} {value} ..."):
                point, left_out = measure(curve, value, 3 if options.quick else 7)
            points += [point] if point else []
            notes += left_out
    _show(console, points)
    for note in notes:
        console.print(f"left out: {note}", highlight=False)
    entry = record(points, notes, machine.describe())
    if options.history:
        console.print(f"wrote {write_history(options.history, entry)}", highlight=False)
    if options.page:
        draw(points, options.picture)
        where = ", ".join(f"{key} {value}" for key, value in entry["machine"].items())
        measured = f"Measured with {entry['driver']}; {where}."
        missing = "".join(f"\n\nLeft out: {note}." for note in notes)
        text = f"{lines_markdown(points)}\n\n{points_markdown(points)}\n\n{measured}{missing}"
        put_into(options.page, text)
    return int(any(OTHER_PICTURES in note for note in notes))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
