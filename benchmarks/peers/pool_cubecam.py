"""Cubemaps of a field in cubecam, by one process and by the workers of a pool; many scenes; workers that are killed."""

from __future__ import annotations

import hashlib
import os
import random
import signal
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

import cubecam as cc

from .. import field
from .batches_cubecam import make_scene

_TICKS = os.sysconf("SC_CLK_TCK")
BOX = cc.Mesh.box(1)


class _Draws:
    """Captures of a field; `first` and `count` choose some of them.

    Linux may share the cores among sessions first, and among the processes of each then (sched_autogroup). The workers
    of a pool have sessions of their own, so all others get one, too.
    """

    def __init__(self, captures: int, first: int = 0, count: int = 0, **options: Any) -> None:
        with suppress(PermissionError):  # it leads one
            os.setsid()
        self.plan = field.Field(probes=captures, format="rgba32f", **options)
        self.scene = make_scene(self.plan)
        self.positions = self.plan.positions(1)[first : first + (count or captures)]
        self.options: dict[str, Any] = {
            "size": self.plan.size,
            "outputs": self.plan.outputs,
            "near": field.NEAR,
            "far": field.FAR,
            "format": self.plan.format,
            "progress": False,
        }
        self.draws: Any = None

    def run(self) -> dict[str, float]:
        """Seconds of CPU time, of all processes and threads, and of the clock for all captures."""
        begin, start = time.perf_counter(), self.cpu()
        batch = self.draws.capture_many(self.scene, self.positions, **self.options)
        found = {"cpu": self.cpu() - start, "wall": time.perf_counter() - begin}
        del batch
        return found

    def digest(self) -> str:
        """The bytes of all captures, in short."""
        batch = self.draws.capture_many(self.scene, self.positions, **self.options)
        return digest_of(batch)

    def cpu(self) -> float:
        """Seconds of CPU time that the processes have taken."""
        return time.process_time()


def digest_of(batch: cc.CubeMapBatch) -> str:
    """The bytes of a batch, in short."""
    made = hashlib.sha256()
    for values in (batch.faces, *batch.outputs.values()):
        made.update(np.ascontiguousarray(values).data)
    return made.hexdigest()


class One(_Draws):
    """One renderer."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self.draws = cc.Renderer()


class Workers(_Draws):
    """A pool."""

    def __init__(self, workers: int, **options: Any) -> None:
        super().__init__(**options)
        self.draws = cc.Pool(workers=workers)

    def cpu(self) -> float:
        return time.process_time() + sum(_cpu(process) for process in processes(self.draws))

    def killed(self, tries: int, seed: int) -> dict[str, Any]:
        """Kill a worker at a random time of each of many calls; how many calls had other bytes or raised."""
        rng = random.Random(seed)
        wanted, found, seconds = self.digest(), [], self.run()["wall"]
        before = set(processes(self.draws))
        for _ in range(tries):
            after = rng.uniform(0, seconds)
            victim = rng.choice(processes(self.draws))
            timer = threading.Timer(after, os.kill, (victim, signal.SIGKILL))
            timer.start()
            try:
                found.append(self.digest() == wanted)
            except Exception as error:
                found.append(False)
                print(error)
            timer.join()
        replaced = len(set(processes(self.draws)) - before)
        return {"wrong": found.count(False), "replaced": replaced}


def processes(pool: cc.Pool) -> list[int]:
    """The workers of a pool."""
    found: list[int] = pool._crew.pids  # type: ignore[union-attr]
    return found


def _cpu(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def scene(number: int) -> cc.Scene:
    """A small scene, of which a mesh is its own."""
    share = number % 1000 / 1000
    made = cc.Scene(background=(0, 0, share))
    made.add(cc.PointLight(position=(1, 2, 3)))
    material = cc.PhongMaterial(color=(share, 0.5, 0.2))
    made.add(BOX, material, position=(0, 0, -2 - share))
    made.add(cc.Mesh.sphere(1, segments=8, rings=6), material, position=(3, 0, 0))
    return made


class Scenes:
    """The memory of a pool while it captures many small scenes."""

    def __init__(self) -> None:
        self.pool = cc.Pool(workers=2)

    def memory(self, count: int) -> dict[str, Any]:
        """MiB of the caller and the workers, without shared memory, at each fifth of one call, and what is left."""
        names = set(Path("/dev/shm").iterdir())
        found: list[list[float]] = [[0.0] * 3 for _ in range(5)]
        drawing = threading.Thread(
            target=self.pool.capture_scenes,
            args=(scene, count),
            kwargs={"size": 2, "progress": False},
        )
        drawing.start()
        while drawing.is_alive():
            for running in list(self.pool._crew._calls):  # type: ignore[union-attr]
                fifth = found[min(5 * running.taken // running.call.pieces, 4)]
                now = [_own(os.getpid()), *map(_own, processes(self.pool))]
                fifth[:] = map(max, fifth, now)
                del running  # it holds the result
            time.sleep(0.05)
        lines = Path("/proc/self/maps").read_text().splitlines()
        left = sum("memfd:cubecam" in line for line in lines)
        new = [path.name for path in set(Path("/dev/shm").iterdir()) - names]
        self.pool.close()
        return {"memory": found, "mappings": left, "files": new}


def _own(process: int) -> float:
    """MiB of a process's memory that are in RAM, without shared ones."""
    lines = Path(f"/proc/{process}/status").read_text().splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith("RssAnon")) / 1024
