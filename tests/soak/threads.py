"""Threads that edit and draw: each sees what it would see alone.

Eight threads share one renderer, then four of them. Every thread has a scene of its own and edits that follow from a
seed; some meshes, images and cubemaps belong to all. Other threads convert cubemaps, make and end renderers, and collect
garbage meanwhile.
"""

from __future__ import annotations

import gc
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

import cubecam as cc
from tests.helpers import DEVICE
from tests.soak.report import Held, Report

THREADS = 8
GROWTH = 200 << 20  # of memory, from the second round on


class Shared:
    """What all threads look at."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.cube = cc.CubeMap(rng.random((6, 8, 8, 3), dtype=np.float32), mipmaps=True)
        self.image = cc.Image(rng.integers(0, 256, (16, 16, 3), dtype=np.uint8), mipmaps=True)
        self.mesh = cc.Mesh.icosphere(0.4, 2)
        self.box = cc.Mesh.box(0.5)
        self.material = cc.PhongMaterial(map=self.image)


def pictures(renderer: cc.Renderer, shared: Shared, seed: int, steps: int) -> list[bytes]:
    """Make a scene, edit it, and draw it after each edit."""
    rng = np.random.default_rng([seed, 3])
    scene = cc.Scene(environment=shared.cube, background=shared.cube)
    scene.add(cc.PointLight(position=(1, 2, 1), shadow=cc.Shadow(size=16)))
    ball = scene.add(shared.mesh, cc.MirrorMaterial(), environment=cc.Probe(size=8))
    box = scene.add(shared.box, shared.material, position=(0.8, 0, 0))
    floor = scene.add(cc.Mesh.plane(3, 3), cc.PhongMaterial(), position=(0, -0.6, 0))
    camera = cc.PerspectiveCamera(position=(1, 1, 2), target=(0, 0, 0))
    found: list[bytes] = []
    for _ in range(steps):
        way = rng.integers(6)
        if way == 0:
            box.position = rng.uniform(-1, 1, 3)
        elif way == 1:
            floor.material = cc.PhongMaterial(color=rng.random(3))
        elif way == 2:
            ball.scale = float(rng.uniform(0.5, 1.5))
        elif way == 3:
            floor.mesh = cc.Mesh.plane(*rng.uniform(1, 4, 2))
        elif way == 4:
            scene.remove(scene.add(shared.mesh, shared.material, position=rng.uniform(-1, 1, 3)))
        else:
            box.visible = bool(rng.integers(2))
        drawn: Any = renderer.render(scene, camera, (16, 12)).color
        found.append(drawn.tobytes())
        if way == 2:
            found.append(renderer.capture(scene, size=6).faces.tobytes())
    return found


def one_round(shared: Shared, seed: int, steps: int, renderers: int, report: Report) -> None:
    """Let all threads draw at once, and compare with what each draws alone."""
    with cc.Renderer(device=DEVICE) as alone:
        want = [pictures(alone, shared, seed + i, steps) for i in range(THREADS)]
    stop = threading.Event()

    def meddle() -> None:
        while not stop.is_set():
            shared.cube.resize(5)
            shared.cube.to_equirect(width=24)
            gc.collect()
            with cc.Renderer(device=DEVICE) as brief:
                brief.capture(cc.Scene(background=(1, 0, 0)), size=2)
            report.count("contexts")

    held = [cc.Renderer(device=DEVICE) for _ in range(renderers)]
    other = threading.Thread(target=meddle)
    other.start()
    try:
        with ThreadPoolExecutor(THREADS) as pool:
            tasks = [
                pool.submit(pictures, held[i % renderers], shared, seed + i, steps)
                for i in range(THREADS)
            ]
            for i, task in enumerate(tasks):
                try:
                    got = task.result()
                except Exception as error:
                    report.faults.append(
                        f"threads, seed {seed + i}, {renderers} renderers: {type(error).__name__}: {error}"
                    )
                    continue
                report.count("pictures", len(got))
                if got != want[i]:
                    step = next(n for n, (a, b) in enumerate(zip(got, want[i], strict=True)) if a != b)
                    report.faults.append(
                        f"threads, seed {seed + i}, {renderers} renderers: picture {step} differs"
                    )
    finally:
        stop.set()
        other.join()
        for renderer in held:
            renderer.close()
    report.count("rounds")


def run(until: float, seed: int) -> Report:
    """Go from round to round until then (time.monotonic)."""
    report, before, rounds = Report(), None, 0
    while time.monotonic() < until:
        one_round(Shared(seed), seed, 12, (1, 4)[rounds % 2], report)
        rounds += 1
        seed += THREADS
        if rounds == 2:
            before = Held.now()
    if before is not None and (grown := Held.now().growth(before, GROWTH)):
        report.faults.append(f"threads: {grown} in {rounds} rounds")
    return report
