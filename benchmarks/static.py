"""The CPU time of a frame in which a small ball moves before a million triangles, over that of a whole redraw.

`python -m benchmarks.static`. One process draws: a block of frames in which the ball moves, then one in which all is
drawn anew, and so on; each time is that of all threads, and each ratio that of two blocks which follow each other. A
renderer that has drawn nothing yet draws the last picture of each kind of frame, too: the bytes must be the same.
"""

from __future__ import annotations

import argparse
import copy
import statistics
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import cubecam as cc

SIDE = 708  # squares along a side of the terrain: 1,002,528 triangles
BLOCK = 20
ROUNDS = 9
WARM_UP = 8  # frames until a renderer has made up its mind about the mesh
OUTPUTS = ("distance", "id", "normal")

Draw = Callable[[cc.Renderer, cc.Scene], Any]


class Found(NamedTuple):
    """CPU milliseconds of the median block, and what was sent for the frame of the moved ball."""

    moved: float
    whole: float
    ratio: float
    sent: int
    skipped: int


def terrain(side: int = SIDE, shuffled: bool = False) -> cc.Mesh:
    """Hills over a square of 2 x 2: 2 * side^2 triangles, row by row or in a random order."""
    x, z = np.meshgrid(*2 * [np.linspace(-1, 1, side + 1)])
    positions = np.stack([x, 0.1 * np.sin(9 * x) * np.cos(7 * z), z], axis=-1).reshape(-1, 3)
    row, column = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    a = row * (side + 1) + column
    triangles = np.stack([a, a + side + 1, a + 1, a + 1, a + side + 1, a + side + 2], axis=-1)
    triangles = triangles.reshape(-1, 3)
    if shuffled:
        triangles = np.random.default_rng(0).permutation(triangles)
    return cc.Mesh(positions, triangles)


class Stage:
    """The terrain, and a ball above it."""

    def __init__(self, mesh: cc.Mesh | None) -> None:
        self.scene = cc.Scene(background=(0.1, 0.1, 0.1))
        self.scene.add(cc.DirectionalLight((-1, -1, -2)))
        if mesh is not None:
            self.scene.add(mesh, cc.PhongMaterial(color=(0.5, 0.7, 0.4)))
        ball = cc.Mesh.sphere(0.04, segments=24, rings=12)
        self.ball = self.scene.add(ball, cc.PhongMaterial(color="red"))

    def move(self, frame: int) -> None:
        turn = 0.03 * frame
        self.ball.position = (0.3 * np.sin(turn), 0.3, 0.3 * np.cos(turn))

    def change_all(self, frame: int) -> None:
        self.move(frame)
        self.scene.background = (0.1, 0.1, 0.1 + 0.0001 * (1 + frame % 1000))


def arrays(picture: Any) -> list[np.ndarray[Any, Any]]:
    color = picture.faces if isinstance(picture, cc.CubeMap) else picture.color
    return [np.array(color), *(np.array(getattr(picture, name)) for name in picture.outputs)]


def measure(mesh: cc.Mesh | None, draw: Draw, rounds: int = ROUNDS, block: int = BLOCK) -> Found:
    """Draw blocks of frames in turns. @raises AssertionError: the pictures differ."""
    stage, renderer = Stage(mesh), cc.Renderer()
    moved: list[float] = []
    whole: list[float] = []
    frame = 0

    def timed(change: Callable[[int], None], count: int) -> float:
        nonlocal frame
        begin = time.process_time()
        for _ in range(count):
            frame += 1
            change(frame)
            draw(renderer, stage.scene)
        return 1e3 * (time.process_time() - begin) / count

    timed(stage.move, WARM_UP)
    for _ in range(rounds):
        timed(stage.move, 2)  # what the whole redraw drove out of the caches comes back
        moved.append(timed(stage.move, block))
        stats = renderer.stats
        whole.append(timed(stage.change_all, 1))
    stage.move(frame)
    got = draw(renderer, stage.scene)
    with cc.Renderer() as fresh:
        want = draw(fresh, copy.deepcopy(stage.scene))
    for a, b in zip(arrays(got), arrays(want), strict=True):
        assert np.array_equal(a, b, equal_nan=True), "the pictures differ"
    renderer.close()
    ratio = statistics.median(a / b for a, b in zip(moved, whole, strict=True))
    return Found(
        statistics.median(moved),
        statistics.median(whole),
        ratio,
        stats.triangles,
        stats.triangles_skipped,
    )


def frame_of(size: int = 512, **options: Any) -> Draw:
    camera = cc.PerspectiveCamera(fov=45, position=(0, 1.6, 2), target=(0, 0, 0))
    return lambda renderer, scene: renderer.render(scene, camera, (size, size), **options)


def cube_of(size: int = 256) -> Draw:
    return lambda renderer, scene: renderer.capture(scene, (0, 0.5, 0), size=size)


def kinds() -> dict[str, tuple[cc.Mesh | None, Draw]]:
    rows, mixed = terrain(), terrain(shuffled=True)
    return {
        "a frame of 512 x 512": (rows, frame_of()),
        "triangles in a random order": (mixed, frame_of()),
        "a tone curve and sRGB": (rows, frame_of(tonemap="aces", encode="srgb")),
        "distance, id and normal": (rows, frame_of(outputs=OUTPUTS)),
        "4 samples": (rows, frame_of(samples=4)),
        "a frame of 1024 x 1024": (rows, frame_of(1024)),
        "a capture of 6 x 256 x 256": (rows, cube_of()),
        "without the terrain": (None, frame_of()),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", help="the name of one kind of frame, or a part of it")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    wanted = parser.parse_args()
    print("| | the ball moved, ms | all drawn anew, ms | ratio | triangles sent | not sent |")
    print("|---|---|---|---|---|---|")
    for name, (mesh, draw) in kinds().items():
        if wanted.only and wanted.only not in name:
            continue
        found = measure(mesh, draw, wanted.rounds)
        print(
            f"| {name} | {found.moved:.2f} | {found.whole:.1f} | 1/{1 / found.ratio:.0f}"
            f" | {found.sent:,} | {found.skipped:,} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
