"""A village green: houses, trees, crates and walls at 3 to 60 m."""

from __future__ import annotations

import numpy as np

import cubecam as cc

from . import paint
from .paint import CREAM, OAK, SAGE, WALNUT, WHITE
from .stage import Stage

#: Where houses stand, (x, z), and by how many degrees they are turned.
HOUSES = (
    (-9, -12, 20),
    (8, -15, -15),
    (15, 2, 95),
    (-14, 4, -80),
    (4, 16, 170),
    (-8, 20, 160),
    (26, -22, -40),
    (-28, -18, 50),
    (30, 24, 130),
    (-24, 34, 200),
    (-3, -46, 5),
    (12, -52, -5),
)


def village() -> cc.Scene:
    """A village green: houses, trees, crates and a wall at 3 to 60 m, under a sky of high dynamic range."""
    stage = Stage(linear=True)
    green = paint.mixed(paint.clouds(128, 128, 6, 11), (0.3, 0.4, 0.16), (0.52, 0.6, 0.28))
    slabs = paint.bricks((0.66, 0.62, 0.56), (0.42, 0.4, 0.36), 8, 128, 12)
    # Nothing lies on top of the grass: a farthest layer would show the grass below the slabs.
    stage.ground((-65, -65), (-3.5, 65), green, "grass", 8)
    stage.ground((3.5, -65), (65, 65), green, "grass", 8)
    stage.ground((-3.5, 3.5), (3.5, 65), green, "grass", 8)
    stage.ground((-3.5, -53.5), (-1.5, -3.5), green, "grass", 8)
    stage.ground((1.5, -53.5), (3.5, -3.5), green, "grass", 8)
    stage.ground((-3.5, -65), (3.5, -53.5), green, "grass", 8)
    stage.ground((-3.5, -3.5), (3.5, 3.5), slabs, "paving", 3.5)
    stage.ground((-1.5, -53.5), (1.5, -3.5), slabs, "path", 3.5)
    stage.add(
        cc.Mesh.cylinder(0.3, 0.68, 48),
        paint.stripes(8, (0.75, 0.72, 0.68), (0.55, 0.52, 0.5), size=64),
        (0, 0.34, 0),
        name="plinth",
    )
    _houses(stage)
    _trees(stage)
    for number, (x, z, size, turn) in enumerate(
        ((2.9, 0.6, 1.0, 20), (3.1, 1.9, 0.7, 50), (-2.8, 1.4, 0.8, 10), (-2.9, -0.4, 0.5, 35))
    ):
        stage.add(
            cc.Mesh.box(size),
            paint.crate(),
            (x, size / 2, z),
            turn=turn,
            name=f"crate {number + 1}",
        )
    stone = paint.bricks((0.6, 0.57, 0.52), (0.4, 0.38, 0.35), 6, 128, 3)
    stage.box((-4.5, 0, -7.4), (-1.8, 1.1, -7.0), stone, "left wall", repeat=(3, 1))
    stage.box((1.8, 0, -7.4), (4.5, 1.1, -7.0), stone, "right wall", repeat=(3, 1))
    stage.box((1.2, 0.4, -3.2), (3.0, 0.5, -2.7), OAK, "bench")
    for left in (1.35, 2.75):
        stage.box((left, 0, -3.1), (left + 0.1, 0.4, -2.8), WALNUT, "bench's foot")
    return stage.finish((0, 1.2, 0), (0.7, 1.55, 1.85), 40)


def _houses(stage: Stage) -> None:
    roof, walls = (
        paint.bricks((0.6, 0.26, 0.18), (0.4, 0.16, 0.12), 12, 128),
        (CREAM, (0.9, 0.72, 0.55), WHITE, (0.72, 0.78, 0.86), SAGE),
    )
    for number, (x, z, turn) in enumerate(HOUSES):
        color = walls[number % len(walls)]
        wide, deep = 6.0 + number % 3, 5.0 + number % 2
        tall = 3.6 + 1.2 * (number % 5 % 2)
        front = paint.facade(color, WHITE, 3, 1 + number % 5 % 2, door=True)
        stage.add(
            cc.Mesh.box((wide, tall, deep)),
            front,
            (x, tall / 2, z),
            turn=turn,
            name=f"house {number + 1}",
        )
        stage.add(
            _gable(wide + 0.8, 2.4, deep + 0.8),
            roof,
            (x, tall, z),
            turn=turn,
            name=f"roof {number + 1}",
            repeat=(2, 1),
        )


def _trees(stage: Stage) -> None:
    rng = np.random.default_rng(5)
    bark = paint.stripes(6, (0.36, 0.26, 0.18), (0.46, 0.35, 0.26), 1, 64)
    leaf = paint.mixed(paint.clouds(128, 128, 10, 8), (0.16, 0.3, 0.1), (0.5, 0.62, 0.26))
    trees = [(-3.4, -2.6), (3.6, -4.2), (-5.5, 3.6), (6.0, 5.5)]
    while len(trees) < 26:
        way, far = rng.uniform(0, 2 * np.pi), rng.uniform(9, 60)
        x, z = far * np.sin(way), far * np.cos(way)
        if abs(x) > 2.5 and min(np.hypot(x - a, z - b) for a, b, _ in HOUSES) > 6:
            trees.append((x, z))
    for number, (x, z) in enumerate(trees):
        near = number < 4
        tall = 1.5 if near else rng.uniform(1.5, 2.6)
        size = 0.75 if near else rng.uniform(1.2, 2.2)
        stage.add(
            cc.Mesh.cylinder(0.12 if near else 0.25, tall, 16),
            bark,
            (x, tall / 2, z),
            name=f"trunk {number + 1}",
        )
        if number % 3 == 0:
            for layer in range(3):
                cone = cc.Mesh.cone(size * (1.1 - 0.25 * layer), size * 1.2, 24)
                stage.add(
                    cone,
                    leaf,
                    (x, tall + size * (0.3 + 0.7 * layer), z),
                    name=f"fir {number + 1}",
                    repeat=(2, 1),
                )
        else:
            stage.add(
                cc.Mesh.sphere(size, 24, 12),
                leaf,
                (x, tall + 0.8 * size, z),
                name=f"crown {number + 1}",
                repeat=(2, 1),
            )


def _gable(wide: float, tall: float, deep: float) -> cc.Mesh:
    """A gabled roof over a rectangle on y = 0, its ridge along x; flat faces, closed."""
    w, d = wide / 2, deep / 2
    a, b, c, e = (-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)
    left, right = (-w, tall, 0), (w, tall, 0)
    sides = ((a, b, right, left), (c, e, left, right), (b, c, right), (e, a, left), (e, c, b, a))
    positions: list[tuple[float, float, float]] = []
    uvs: list[tuple[float, float]] = []
    indices: list[tuple[int, int, int]] = []
    for side in sides:
        first = len(positions)
        positions += side
        uvs += [(0, 0), (1, 0), (1, 1), (0, 1)] if len(side) == 4 else [(0, 0), (1, 0), (0.5, 1)]
        indices += [(first, first + k, first + k + 1) for k in range(1, len(side) - 1)]
    at = np.array(positions)
    normals = np.zeros_like(at)
    for i, j, k in indices:
        normal = np.cross(at[j] - at[i], at[k] - at[i])
        normals[[i, j, k]] = normal / np.linalg.norm(normal)
    return cc.Mesh(at, indices, normals=normals, uvs=uvs)
