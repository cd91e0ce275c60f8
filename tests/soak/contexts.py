"""Renderers that come and go, closed or only dropped, in this thread or another: nothing grows."""

from __future__ import annotations

import threading
import time

import numpy as np

import cubecam as cc
from tests.helpers import DEVICE
from tests.soak.report import Held, Report

WARM = 20  # renderers before anything is counted: the driver keeps some memory
GROWTH = 60 << 20


def one(number: int) -> bytes:
    """Make a renderer, draw with it, and end it in one of four ways."""
    scene = cc.Scene(background=(0.2, 0.4, 0.6))
    scene.add(cc.Mesh.box(), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -3))
    renderer = cc.Renderer(device=DEVICE, layered=None if number % 2 else False)
    drawn = renderer.capture(scene, size=8).faces.tobytes()
    if number % 4 == 0:
        renderer.close()
    elif number % 4 == 1:
        with renderer:
            pass
    elif number % 4 == 2:
        thread = threading.Thread(target=renderer.close)
        thread.start()
        thread.join()
    # Else it is dropped; its pictures live on.
    return drawn


def run(until: float, seed: int, count: int | None = None, make: object = one) -> Report:
    """Make renderers until then (time.monotonic), at least a few more than `WARM`."""
    report, number = Report(), 0
    first = one(0)
    before = None
    rng = np.random.default_rng(seed)
    while number < (count or WARM + 4) or (count is None and time.monotonic() < until):
        drawn = make(int(rng.integers(1 << 20)))  # type: ignore[operator]
        report.count("contexts")
        number += 1
        if drawn != first:
            report.faults.append(f"contexts, seed {seed}, renderer {number}: another picture")
        if number == WARM:
            before = Held.now()
    if before is not None and (grown := Held.now().growth(before, GROWTH)):
        report.faults.append(f"contexts: {grown} with {number - WARM} renderers")
    return report
