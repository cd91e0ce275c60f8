"""Try cubecam on the GPU of this machine, and write all figures to one JSON file.

    python scripts/gpu_check.py                        every part, into out/gpu_check
    python scripts/gpu_check.py --only info --only probes
    python scripts/gpu_check.py --device software --quick

The parts are `info` (device, limits, driver), `suite` (the tests with CUBECAM_TEST_DEVICE), `benchmarks` (against
moderngl, where it is installed), `readback` (bytes a second by format and size), `asynchronous` (captures with four
under way, over a copy into pinned memory), `probes` (1,000 mirrors with a probe each) and `pictures` (the reference
pictures, drawn and compared with llvmpipe's). Each part runs in a process of its own with a limit of time, so that a
driver that ends or blocks one part does not end the others.

The script fails if a part fails. docs/gpu.md describes the figures.
"""

from __future__ import annotations

import argparse
import functools
import itertools
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import cubecam as cc

ROOT = Path(__file__).resolve().parent.parent
FORMATS = ("rgba8", "rgba16f", "rgba32f")
OUTPUTS = ("depth", "distance", "id", "normal", "position")
SECONDS = 3600


class CheckError(Exception):
    """A part that cannot be done; the message says why."""


def rounded(value: float, digits: int = 4) -> float:
    return float(f"{value:.{digits}g}")


def timed(work: Callable[[], object], rounds: int) -> float:
    """The median time of a work in milliseconds, after one round that does not count."""
    work()
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(1000 * (time.perf_counter() - start))
    return rounded(statistics.median(times))


def nvidia() -> str | None:
    """What nvidia-smi says about the cards: name, driver, memory."""
    if shutil.which("nvidia-smi") is None:
        return None
    query = ["nvidia-smi", "--query-gpu=name,driver_version,memory.total", "--format=csv,noheader"]
    done = subprocess.run(query, capture_output=True, text=True, timeout=60)
    return done.stdout.strip() or done.stderr.strip()


def info(options: argparse.Namespace) -> dict[str, Any]:
    import cubecam as cc

    with cc.Renderer(device=options.device) as renderer:
        found = renderer.info
        names = ("renderer", "vendor", "version", "glsl_version", "egl_version", "platform")
        described: dict[str, Any] = {name: getattr(found, name) for name in names}
        described |= {"layered": found.layered, "software": found.software}
        limits = [name for name in dir(found.limits) if not name.startswith("_")]
        described["limits"] = {name: getattr(found.limits, name) for name in limits}
    return {
        **described,
        "cubecam": cc.__version__,
        "devices": [repr(device) for device in cc.devices()],
        "nvidia_smi": nvidia(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "system": platform.platform(),
        "cores": len(os.sched_getaffinity(0)),
    }


def suite(options: argparse.Namespace) -> dict[str, Any]:
    """Run the tests on the device; return counts, the names that failed and the reasons of skips."""
    report = options.out / "suite.xml"
    report.unlink(missing_ok=True)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        f"--junitxml={report}",
        "-p",
        "no:cacheprovider",
    ]
    command += ["-n", str(options.workers), "--dist", "loadfile", *options.pytest]
    environment = {**os.environ, "CUBECAM_TEST_DEVICE": options.device}
    start = time.perf_counter()
    with (options.out / "suite.txt").open("w") as log:
        subprocess.run(command, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT)
    if not report.exists():
        raise CheckError("pytest wrote no report; suite.txt has its last words")
    result = counted(report)
    result["seconds"] = rounded(time.perf_counter() - start)
    return result


def counted(report: Path) -> dict[str, Any]:
    """The numbers in a JUnit report of pytest."""
    passed, failed = 0, []
    skipped: Counter[str] = Counter()
    for case in ET.parse(report).getroot().iter("testcase"):
        name = f"{case.get('classname')}::{case.get('name')}"
        skip = case.find("skipped")
        bad = case.find("failure") if case.find("failure") is not None else case.find("error")
        if bad is not None:
            failed.append({"test": name, "message": (bad.get("message") or "")[:400]})
        elif skip is not None:
            skipped[skip.get("message") or ""] += 1
        else:
            passed += 1
    return {"passed": passed, "failed": failed, "skipped": dict(skipped)}


def benchmarks(options: argparse.Namespace) -> dict[str, Any]:
    """`python -m benchmarks` against moderngl: P14, crowds of boxes, a wave of vertices, the start."""
    path = options.out / "benchmarks.json"
    path.unlink(missing_ok=True)
    command = [sys.executable, "-m", "benchmarks", "--json", str(path)]
    for name in ("p14-teapot", "p14-knot", "marks-boxes", "marks-mesh", "startup"):
        command += ["--only", name]
    command += ["--quick"] * options.quick
    environment = {**os.environ, "CUBECAM_DEVICE": options.device}
    with (options.out / "benchmarks.txt").open("w") as log:
        subprocess.run(command, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT)
    if not path.exists():
        lines = (options.out / "benchmarks.txt").read_text().splitlines()
        raise CheckError(lines[-1] if lines else "the benchmarks wrote nothing")
    data: dict[str, Any] = json.loads(path.read_text())
    return data


def readback(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Captures whose six faces change each time: the time of a capture, and the bytes of its results a second.

    The scene is one box before a colour that changes, so that most of the time is that of reading.
    """
    import cubecam as cc

    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(0.9, 0.4, 0.1)), position=(0, 0, -3))
    sizes = (64, 256) if options.quick else (64, 256, 1024, 2048)
    rows = []
    blue = itertools.cycle(np.linspace(0, 1, 50).tolist())

    def changed(renderer: cc.Renderer, **how: Any) -> cc.CubeMap:
        scene.background = (0.1, 0.2, next(blue))
        cube = renderer.capture(scene, **how)
        if renderer.stats.views_drawn != 6:
            raise CheckError(f"expected six new faces, got {renderer.stats.views_drawn}")
        return cube

    with cc.Renderer(device=options.device) as renderer:
        for size, name, outputs in itertools.product(sizes, FORMATS, ((), OUTPUTS)):
            how = {"size": size, "format": name, "outputs": outputs}
            cube = changed(renderer, **how)
            held = cube.faces.nbytes + sum(cube.outputs[key].nbytes for key in outputs)
            work = functools.partial(changed, renderer, **how)
            ms = timed(work, 3 if options.quick else 9)
            rate = rounded(held / ms / 1e6)
            rows.append({**how, "bytes": held, "ms": ms, "gigabytes_per_second": rate})
    return rows


def asynchronous(options: argparse.Namespace) -> dict[str, Any]:
    """Captures that are waited for and captures that are under way, beside numpy and beside a copy of CUDA."""
    from benchmarks.asynchronous import measured

    return measured(options.device, options.quick)


def probes(options: argparse.Namespace) -> dict[str, Any]:
    """1,000 mirror balls in a cube, each with a probe of its own, which the others see."""
    import cubecam as cc

    side = 5 if options.quick else 10
    scene = cc.Scene(background=(0.2, 0.3, 0.5))
    scene.add(cc.DirectionalLight((-1, -2, -1)))
    ball, silver = (
        cc.Mesh.sphere(0.3, 16),
        cc.MirrorMaterial(color=(0.9, 0.3, 0.2), color_weight=0.3),
    )
    nodes = []
    for place in np.ndindex(side, side, side):
        node = scene.add(ball, silver, position=tuple(float(i) - side / 2 for i in place))
        node.environment = cc.Probe(parent=node, size=16)
        nodes.append(node)
    camera = cc.PerspectiveCamera(position=(side * 1.2, side, side * 1.5), target=(0, 0, 0))
    result: dict[str, Any] = {"probes": len(nodes)}
    with cc.Renderer(device=options.device) as renderer:
        start = time.perf_counter()
        frame = renderer.render(scene, camera, (256, 256), format="rgba32f")
        result["first_frame_ms"] = rounded(1000 * (time.perf_counter() - start))
        if not np.isfinite(frame.color).all() or frame.color[..., :3].std() < 0.01:
            raise CheckError(
                "the frame of 1,000 probes is empty, or has numbers that are not finite"
            )

        def step() -> None:
            x, y, z = nodes[0].position
            nodes[0].position = (x + 0.01, y, z)
            renderer.render(scene, camera, (256, 256), format="rgba32f")

        result["one_moved_ms"] = timed(step, 3)
        result["one_moved_views_drawn"] = renderer.stats.views_drawn
        result["nothing_changed_ms"] = timed(
            lambda: renderer.render(scene, camera, (256, 256), format="rgba32f"), 5
        )
    return result


def pictures(options: argparse.Namespace) -> dict[str, Any]:
    """Draw the reference pictures; return how far each is from llvmpipe's, in counts of 255."""
    import cubecam as cc
    from tests.images.pictures import PICTURES

    folder = options.out / "pictures"
    folder.mkdir(exist_ok=True)
    result: dict[str, Any] = {}
    names = list(PICTURES)[:4] if options.quick else list(PICTURES)
    with cc.Renderer(device=options.device) as renderer:
        for name in names:
            got = PICTURES[name](renderer)
            cc.save_image(folder / f"{name}.png", got)
            want = cc.load_image(ROOT / "tests" / "images" / f"{name}.png")
            off = np.abs(got.astype(int) - want.astype(int))
            result[name] = {
                "mean": rounded(float(off.mean())),
                "largest": int(off.max()),
                "values_more_than_2_off": rounded(float((off > 2).mean())),
            }
            # Silhouettes and highlights may differ; a picture of something else differs everywhere.
            if off.mean() > 2:
                raise CheckError(f"{name} is {off.mean():.1f} of 255 off on average")
    return result


PARTS: dict[str, Callable[[argparse.Namespace], Any]] = {
    "info": info,
    "pictures": pictures,
    "readback": readback,
    "asynchronous": asynchronous,
    "probes": probes,
    "benchmarks": benchmarks,
    "suite": suite,
}


def failure(name: str, result: Any) -> str | None:
    """What is wrong with the result of a part; None if it is in order."""
    if isinstance(result, dict) and "error" in result:
        return str(result["error"])
    if name == "suite" and result["failed"]:
        return f"{len(result['failed'])} of the tests fail"
    return None


def run_apart(name: str, arguments: list[str], out: Path) -> Any:
    """The result of a part, done by another process; {"error": ...} if that ended or took too long."""
    path = out / f"{name}.part.json"
    path.unlink(missing_ok=True)
    command = [sys.executable, str(Path(__file__)), *arguments, "--part", name]
    try:
        done = subprocess.run(command, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return {"error": f"not ready within {SECONDS} s"}
    if not path.exists():
        return {"error": f"the process ended with status {done.returncode}"}
    result = json.loads(path.read_text())
    path.unlink()
    return result


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="gpu_check.py", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--device", default="gpu", help="as of cc.Renderer; default: gpu")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "gpu_check")
    parser.add_argument("--only", action="append", choices=PARTS, help="may be given several times")
    parser.add_argument("--quick", action="store_true", help="smaller and noisier")
    parser.add_argument("--workers", default="4", help="processes of pytest; default: 4")
    parser.add_argument("--part", choices=PARTS, help=argparse.SUPPRESS)
    parser.add_argument("pytest", nargs="*", help="options of pytest, after --")
    options = parser.parse_args(arguments)
    options.out = options.out.absolute()
    options.out.mkdir(parents=True, exist_ok=True)
    return options


def main(arguments: list[str]) -> int:
    options = parse(arguments)
    sys.path.insert(0, str(ROOT))
    if options.part:
        try:
            result = PARTS[options.part](options)
        except Exception as error:  # what a driver raises goes into the report
            result = {"error": f"{type(error).__name__}: {error}"}
        path = options.out / f"{options.part}.part.json"
        path.write_text(json.dumps(result))
        return 0
    report: dict[str, Any] = {"device": options.device, "quick": options.quick}
    wrong = 0
    for name in options.only or PARTS:
        print(f"[gpu] {name} ...", flush=True)
        report[name] = run_apart(name, arguments, options.out)
        problem = failure(name, report[name])
        wrong += problem is not None
        if problem is not None:
            print(f"[gpu] {name}: {problem}", flush=True)
    path = options.out / "gpu_check.json"
    path.write_text(json.dumps(report, indent=1) + "\n")
    print(f"[gpu] wrote {path}; {wrong or 'no'} part{'' if wrong == 1 else 's'} failed")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
