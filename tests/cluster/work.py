"""What the tests of tests/cluster capture, in this process and in others, and what they compare with."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import cubecam as cc
from cubecam import cluster

COUNT, CHUNK, SIZE = 150, 4, 24
OPTIONS: dict[str, Any] = {"outputs": ("distance", "id"), "format": "rgba16f"}
PLACES = np.random.default_rng(0).uniform(-3, 3, (COUNT, 3))


def scene() -> cc.Scene:
    """A lit scene that takes some milliseconds for each place."""
    rng = np.random.default_rng(1)
    made = cc.Scene(background=(0.1, 0.2, 0.4))
    ball = cc.Mesh.sphere(0.4, 48, 24)
    for number in range(16):
        material = cc.PhongMaterial(color=rng.random(3))
        made.add(ball, material, position=rng.uniform(-4, 4, 3), label=number)
    made.add(cc.PointLight((3, 3, 3)))
    return made


def write(store: Any, **how: Any) -> cc.CubeMapBatch:
    """Capture into a store."""
    return cluster.capture_to_zarr(
        scene(), PLACES, store, SIZE, chunk=CHUNK, progress=False, **OPTIONS, **how
    )


def truth() -> cc.CubeMapBatch:
    """The same by one renderer."""
    with cc.Renderer() as renderer:
        return renderer.capture_many(scene(), PLACES, SIZE, **OPTIONS)


def files(folder: Path) -> dict[str, bytes]:
    """All files of a store."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def finished(store: Path) -> np.ndarray:
    """Which places a store says are there; none if there is no store."""
    if not store.exists():
        return np.zeros(COUNT, bool)
    batch = cc.open_batch(store, incomplete=True)
    return np.ones(COUNT, bool) if batch.drawn is None else batch.drawn


def check(store: Path, want: cc.CubeMapBatch, before: np.ndarray) -> np.ndarray:
    """Assert that what was finished is finished, and that all that is finished has the right bytes."""
    drawn = finished(store)
    assert (drawn | ~before).all(), "a finished chunk was lost"
    assert all(
        len(set(drawn[first : first + CHUNK].tolist())) == 1 for first in range(0, COUNT, CHUNK)
    ), "a chunk is there in part"
    if drawn.any():
        batch = cc.open_batch(store, incomplete=True)
        rows = np.flatnonzero(drawn)
        got, right = batch[rows], want[rows]
        assert got.faces.tobytes() == right.faces.tobytes(), "a finished chunk is broken"
        for name in want.outputs:
            assert got.outputs[name].tobytes() == right.outputs[name].tobytes(), name
    return drawn


def started(*command: str, **environment: str) -> subprocess.Popen[bytes]:
    """Start a program of Python in a group of processes of its own."""
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), **environment}
    return subprocess.Popen([sys.executable, *command], env=env, start_new_session=True)
