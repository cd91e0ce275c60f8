"""The CPU time of a frame of a skinned mesh over that of the same mesh, moved rigidly.

100 joints and 50,000 vertices: `python -m benchmarks.skinning`. Both scenes are drawn in one process and take turns;
each time is that of all threads.
"""

from __future__ import annotations

import statistics
import time
from typing import Any

import numpy as np

import cubecam as cc

JOINTS, ROUND, RINGS = 100, 100, 500
SIZE = (512, 512)
ROUNDS = 45


def tube(smooth: bool = False, targets: int = 0) -> cc.Mesh:
    """A tube along Y of 50,000 vertices; each moves with the two nearest joints of a chain, and two others."""
    around, along = np.meshgrid(np.linspace(0, 2 * np.pi, ROUND, endpoint=False), np.arange(RINGS))
    sides = np.stack([np.sin(around), 0 * around, np.cos(around)], axis=-1).reshape(-1, 3)
    height = (along / (RINGS - 1)).ravel()
    positions = 0.2 * sides + np.c_[0 * height, 2 * height - 1, 0 * height]
    row, column = np.meshgrid(np.arange(RINGS - 1), np.arange(ROUND), indexing="ij")
    a, b = row * ROUND + column, row * ROUND + (column + 1) % ROUND
    triangles = np.stack([a, b, b + ROUND, a, b + ROUND, a + ROUND], axis=-1).reshape(-1, 3)
    place = height * (JOINTS - 1)
    first = np.clip(place.astype(int), 1, JOINTS - 3)
    joints = np.stack([first - 1, first, first + 1, first + 2], axis=1)
    weights = np.maximum(0, 2 - np.abs(joints - place[:, None]))
    waves = [
        cc.MorphTarget(positions=0.02 * np.sin(20 * index * height)[:, None] * sides)
        for index in range(1, targets + 1)
    ]
    return cc.Mesh(
        positions,
        triangles,
        normals=None if smooth else sides,
        joints=joints,
        joint_weights=weights,
        morph_targets=waves,
    )


class Stage:
    """A scene of one tube, which joints bend or a node turns."""

    def __init__(self, mesh: cc.Mesh, skinned: bool) -> None:
        self.scene = cc.Scene(background=(0.1, 0.1, 0.1))
        self.scene.add(cc.DirectionalLight((-1, -1, -2)))
        self.joints: list[cc.Node] = []
        skin = None
        if skinned:
            above = None
            for index in range(JOINTS):
                place = (0, -1, 0) if index == 0 else (0, 2 / (JOINTS - 1), 0)
                above = self.scene.add(position=place, parent=above)
                self.joints.append(above)
            skin = cc.Skin(
                self.joints, [np.linalg.inv(joint.world_matrix) for joint in self.joints]
            )
        self.node = self.scene.add(mesh, cc.PhongMaterial(), skin=skin)
        self.renderer = cc.Renderer()
        self.camera = cc.PerspectiveCamera(fov=45, position=(0, 0, 4), target=(0, 0, 0))

    def draw(self, frame: int, weights: Any = None) -> None:
        if weights is not None:
            self.node.weights = weights
        if self.joints:
            turn = cc.axis_angle((0, 0, 1), 0.4 * np.sin(0.3 * frame))
            for joint in self.joints:
                joint.rotation = turn
        else:
            self.node.rotation = cc.axis_angle((0, 0, 1), 20 * np.sin(0.3 * frame))
        self.renderer.render(self.scene, self.camera, SIZE)
        assert self.renderer.stats.views_drawn == 1


def ratio(
    smooth: bool = False, targets: int = 0, rounds: int = ROUNDS
) -> tuple[float, float, float]:
    """The median milliseconds of both frames, and the median of their ratios."""
    mesh = tube(smooth, targets)
    stages = [Stage(mesh, True), Stage(mesh, False)]
    times: list[list[float]] = [[], []]
    rng = np.random.default_rng(1)
    for frame in range(rounds + 3):
        for stage, found in zip(stages, times, strict=True):
            weights = rng.random(targets) if targets and stage.joints else None
            begin = time.process_time()
            stage.draw(frame, weights)
            found.append(1e3 * (time.process_time() - begin))
    bent, rigid = (found[3:] for found in times)
    share = statistics.median(a / b for a, b in zip(bent, rigid, strict=True))
    return statistics.median(bent), statistics.median(rigid), share


def main() -> None:
    for name, smooth, targets in (
        ("100 joints, 50,000 vertices with normals", False, 0),
        ("the same with computed normals", True, 0),
        ("the same with normals and 4 morph targets", False, 4),
    ):
        bent, rigid, share = ratio(smooth, targets)
        print(f"{name}: {bent:.1f} ms, moved rigidly {rigid:.1f} ms, {share:.2f} x")


if __name__ == "__main__":
    main()
