"""Two rooms of 10 x 6 x 8 m: one with things around its middle, one with its furniture along the walls."""

from __future__ import annotations

import numpy as np

import cubecam as cc

from . import paint
from .paint import BLUE, BOOKS, CREAM, GOLD, OAK, RED, SAGE, TEAL, WALNUT, WHITE
from .stage import Stage, in_corners, model, shadowed

#: The corners of both rooms, metres; the middle of the floor is the origin.
LOW, HIGH = (-5.0, 0.0, -4.0), (5.0, 6.0, 4.0)


def room_a() -> cc.Scene:
    """A hall of 10 x 6 x 8 m with twelve things around its middle, where the reflector stands on a pedestal."""
    stage = Stage()
    spots = [
        (0, 0, 0.32, 0.32), (2.0, 1.9, 0.6, 0.6), (-2.0, 1.9, 0.6, 0.6), (2.0, -1.9, 0.6, 0.6), (-2.0, -1.9, 0.6, 0.6),
        (2.35, 0, 0.6, 0.9), (-1.9, 0.1, 0.6, 0.6), (0, -2.0, 1.0, 0.6), (1.35, 0.95, 0.6, 0.6),
        (-1.15, 1.45, 0.6, 0.6), (1.15, -1.15, 0.5, 0.5), (-1.2, -1.3, 0.8, 0.8),
    ]  # fmt: skip
    tiles = np.tile(paint.checks(4, 4, (0.84, 0.77, 0.67), (0.6, 0.53, 0.48), 128), (2, 3, 1))
    floor = (
        np.asarray(cc.Image(paint.in_bytes(tiles)), float)[:, :320][:256] / 255
    )  # 10 x 8 tiles of a metre
    floor = shadowed(floor, (-5, -4), (5, 4), spots)
    coffers = paint.mixed(
        np.clip(8 * (np.abs((paint.grid(320, 256)[0] * 5) % 1 - 0.5).clip(0.4) - 0.42), 0, 1),
        WHITE,
        (0.82, 0.72, 0.6),
    )
    beam = np.abs((paint.grid(320, 256)[1] * 4) % 1 - 0.5) > 0.44
    coffers[beam] = (0.82, 0.72, 0.6)
    stage.walls(
        LOW,
        HIGH,
        (
            floor,
            coffers,
            _panelled(CREAM, BLUE, 640),
            _panelled(CREAM, RED, 512),
            _panelled(CREAM, TEAL, 640),
            _panelled(CREAM, GOLD, 512),
        ),
        (1, 1),
    )
    for number, (x, z) in enumerate(((-2.6, -3.97), (2.6, -3.97))):
        stage.quad(
            (x - 0.9, 1.6, z), (1.8, 0, 0), (0, 2.6, 0), paint.window(), f"window {number + 1}"
        )
    for number, (z, seed) in enumerate(((-1.8, 4), (1.8, 9))):
        stage.quad(
            (4.97, 2.2, z - 0.9),
            (0, 0, 1.8),
            (0, 1.4, 0),
            paint.painting(seed),
            f"painting {number + 1}",
        )
        stage.quad(
            (-4.97, 2.2, z + 0.9),
            (0, 0, -1.8),
            (0, 1.4, 0),
            paint.painting(seed + 20),
            f"painting {number + 3}",
        )
    stage.quad((0.8, 0, 3.97), (-1.6, 0, 0), (0, 2.6, 0), paint.door(), "door")

    # The pedestal, and twelve things around it.
    stage.add(
        cc.Mesh.cylinder(0.15, 0.8, 48),
        paint.stripes(12, (0.72, 0.62, 0.5), (0.62, 0.52, 0.41)),
        (0, 0.4, 0),
        name="pedestal",
    )
    stage.add(cc.Mesh.cylinder(0.2, 0.06, 48), OAK, (0, 0.83, 0), name="pedestal top")
    marbles = (RED, TEAL, GOLD, BLUE)
    for number, (x, z) in enumerate(((2.0, 1.9), (-2.0, 1.9), (2.0, -1.9), (-2.0, -1.9))):
        shaft = paint.stripes(
            3, (0.9, 0.86, 0.8), tuple(0.55 * c + 0.38 for c in marbles[number]), 4
        )
        stage.add(cc.Mesh.cylinder(0.3, 5.4, 48), shaft, (x, 3, z), name=f"column {number + 1}")
        stage.box((x - 0.42, 0, z - 0.42), (x + 0.42, 0.3, z + 0.42), WHITE, "base")
        stage.box((x - 0.42, 5.7, z - 0.42), (x + 0.42, 6, z + 0.42), WHITE, "capital")
    stage.box((2.1, 0, -0.7), (2.6, 2.3, 0.7), paint.books(BOOKS), "bookcase")
    stage.box(
        (-2.2, 0, -0.2),
        (-1.6, 0.8, 0.4),
        paint.checks(4, 4, (0.85, 0.84, 0.8), (0.4, 0.6, 0.6)),
        "plinth",
    )
    stage.add(model("bunny.obj", 1.2), (0.92, 0.8, 0.62), (-1.9, 0.8, 0.1), turn=80, name="bunny")
    stage.box((-0.7, 0, -2.3), (0.7, 0.9, -1.7), paint.planks(OAK, WALNUT, 6), "cabinet")
    stage.add(model("suzanne.glb", 1.1), (0.55, 0.75, 0.95), (0, 0.9, -2.0), name="head")
    stage.add(
        cc.Mesh.sphere(0.48, 48, 24),
        paint.checks(6, 1, (0.8, 0.42, 0.36), (0.92, 0.88, 0.8)),
        (1.35, 0.48, 0.95),
        turn=30,
        axis=(1, 0, 1),
        name="ball",
    )
    crate = paint.crate()
    stage.add(cc.Mesh.box(0.8), crate, (-1.15, 0.4, 1.45), turn=20, name="crate")
    stage.add(cc.Mesh.box(0.55), crate, (-1.1, 1.075, 1.45), turn=-15, name="small crate")
    stage.add(
        cc.Mesh.cylinder(0.26, 0.5, 32),
        paint.stripes(8, BLUE, WHITE),
        (1.15, 0.25, -1.15),
        name="pot",
    )
    for number, (y, r) in enumerate(((0.95, 0.5), (1.45, 0.42), (1.9, 0.3))):
        leaf = paint.mixed(paint.clouds(128, 128, 12, 8), (0.12, 0.32, 0.12), (0.5, 0.75, 0.3))
        stage.add(cc.Mesh.sphere(r, 32, 16), leaf, (1.15, y, -1.15), name=f"leaves {number + 1}")
    seat = paint.checks(6, 6, (0.72, 0.44, 0.38), (0.8, 0.58, 0.44), 128)
    for name, size, at in (
        ("armchair", (0.9, 0.45, 0.8), (0, 0.225, 0)),
        ("armchair back", (0.9, 0.75, 0.2), (0, 0.7, -0.35)),
        ("armchair left", (0.16, 0.3, 0.78), (-0.38, 0.58, 0)),
        ("armchair right", (0.16, 0.3, 0.78), (0.38, 0.58, 0)),
    ):
        c = np.cos(np.radians(45)) * np.array(at)
        x, z = -1.2 + c[0] + c[2], -1.3 - c[0] + c[2]
        stage.add(cc.Mesh.box(size), seat, (x, at[1], z), turn=45, name=name)
    stage.add(
        cc.Mesh.sphere(0.32, 32, 16), (1.0, 0.95, 0.8), (0.5, 3.0, -0.5), name="lamp", even=True
    )
    stage.add(cc.Mesh.cylinder(0.015, 2.7, 8), (0.15, 0.13, 0.12), (0.5, 4.65, -0.5), name="cord")
    return stage.finish((0, 1.42, 0), (0.55, 1.75, 1.8), 40)


def room_b() -> cc.Scene:
    """A living room of 10 x 6 x 8 m with its furniture along the walls; the reflector stands free in its middle."""
    stage = Stage()
    wood = np.tile(paint.planks((0.8, 0.6, 0.4), (0.6, 0.4, 0.25), 8, 256), (2, 2, 1))[:410, :512]
    spots = [
        (-4.4, 0, 0.9, 1.8), (0.6, -3.7, 1.9, 0.6), (-3.4, -3.6, 1.1, 0.7), (3.4, 3.5, 1.1, 0.8), (4.5, -3.4, 0.7, 0.7),
        (-0.6, 3.7, 1.6, 0.5), (4.6, 0, 0.6, 1.6), (-4.4, 3.4, 0.6, 0.6), (0, 0, 0.4, 0.4),
    ]  # fmt: skip
    wallpaper = _wallpaper
    stage.walls(
        LOW,
        HIGH,
        (
            shadowed(wood, (-5, -4), (5, 4), spots),
            in_corners(np.broadcast_to(np.asarray(WHITE), (64, 80, 3)), 0.15),
            wallpaper(640, SAGE),
            wallpaper(512, CREAM),
            wallpaper(640, SAGE),
            wallpaper(512, CREAM),
        ),
        (1, 1),
    )
    stage.quad(
        (-2.6, 0.01, 1.9),
        (5.2, 0, 0),
        (0, 0, -3.8),
        paint.rug((0.66, 0.3, 0.26), (0.78, 0.62, 0.38), (0.3, 0.34, 0.44)),
        "rug",
    )
    # Left: a sofa and two paintings above it.
    cloth = paint.mixed(
        paint.stripes(24, (0, 0, 0), (1, 1, 1), size=128)[..., 0],
        (0.3, 0.42, 0.6),
        (0.36, 0.5, 0.68),
    )
    stage.box((-4.98, 0.15, -1.6), (-3.9, 0.5, 1.6), cloth, "sofa")
    stage.box((-4.98, 0.5, -1.6), (-4.6, 1.05, 1.6), cloth, "sofa back")
    stage.box((-4.98, 0.5, -1.6), (-3.9, 0.75, -1.3), cloth, "left arm")
    stage.box((-4.98, 0.5, 1.3), (-3.9, 0.75, 1.6), cloth, "right arm")
    for number, (z, color) in enumerate(((-0.8, GOLD), (0, WHITE), (0.8, RED))):
        cushion = paint.checks(4, 4, color, tuple(0.75 * c for c in color), 64)
        stage.add(
            cc.Mesh.box((0.18, 0.45, 0.5)),
            cushion,
            (-4.45, 0.73, z),
            turn=18,
            axis=(0, 0, 1),
            name=f"cushion {number + 1}",
        )
    for number, (z, seed) in enumerate(((-0.95, 5), (0.95, 14))):
        stage.quad(
            (-4.97, 2.0, z + 0.8),
            (0, 0, -1.6),
            (0, 1.2, 0),
            paint.painting(seed),
            f"painting {number + 1}",
        )
    # In front: a fireplace between a bookcase and a desk.
    stone = paint.bricks((0.62, 0.36, 0.28), (0.75, 0.72, 0.68), 12)
    stage.box((-0.9, 0, -3.99), (2.1, 1.5, -3.5), stone, "fireplace", repeat=(1.5, 1))
    stage.box((-1.0, 1.5, -3.99), (2.2, 1.62, -3.4), OAK, "mantelpiece")
    stage.box((0.0, 1.62, -3.99), (1.2, 5.99, -3.6), stone, "chimney", repeat=(0.7, 3))
    fire = paint.mixed(
        paint.clouds(64, 64, 5, 6) * np.clip(1.5 - 1.4 * paint.grid(64, 64)[1], 0, 1),
        (0.1, 0.05, 0.03),
        (1, 0.75, 0.2),
    )
    stage.quad((0.1, 0.12, -3.49), (1.0, 0, 0), (0, 0.95, 0), fire, "fire")
    stage.add(model("bunny.obj", 0.5), GOLD, (-0.5, 1.62, -3.65), name="bunny")
    stage.add(model("suzanne.glb", 0.5), TEAL, (1.7, 1.62, -3.65), name="head")
    for number, x in enumerate((-4.3, -2.9)):
        stage.box(
            (x, 0, -3.99), (x + 1.3, 3.0, -3.55), paint.books(BOOKS, 5), f"bookcase {number + 1}"
        )
    stage.box((2.9, 0.72, -3.95), (4.9, 0.8, -3.0), WALNUT, "desk")
    for number, (x, z) in enumerate(((3.0, -3.85), (4.8, -3.85), (3.0, -3.1), (4.8, -3.1))):
        stage.box((x - 0.04, 0, z - 0.04), (x + 0.04, 0.72, z + 0.04), WALNUT, f"leg {number + 1}")
    stage.box((3.5, 0.8, -3.8), (4.3, 1.35, -3.74), paint.painting(31), "screen")
    # Right: a window with curtains, and a long bench.
    stage.quad((4.97, 1.2, -1.3), (0, 0, 2.6), (0, 2.7, 0), paint.window(), "window")
    curtain = paint.mixed(
        0.5 + 0.5 * np.sin(2 * np.pi * 5 * paint.grid(128, 32)[0]),
        (0.55, 0.16, 0.16),
        (0.8, 0.32, 0.28),
    )
    for number, z in enumerate((-2.0, 1.3)):
        stage.box((4.8, 0.3, z), (4.95, 4.2, z + 0.7), curtain, f"curtain {number + 1}")
    stage.box((4.3, 0, -1.1), (4.98, 0.5, 1.1), paint.planks(OAK, WALNUT, 5, 128), "bench")
    stage.add(model("teapot.obj", 0.6), (0.85, 0.88, 0.95), (4.6, 0.5, 0.5), turn=30, name="teapot")
    # Behind: a door and a sideboard; plants and lamps in the corners.
    stage.quad((4.3, 0, 3.97), (-1.4, 0, 0), (0, 2.5, 0), paint.door(), "door")
    stage.box((-2.0, 0, 3.5), (0.9, 0.95, 3.99), paint.planks(WALNUT, OAK, 3, 128, 5), "sideboard")
    stage.quad((0.4, 1.6, 3.96), (-1.9, 0, 0), (0, 1.4, 0), paint.painting(42), "painting 3")
    stage.add(
        cc.Mesh.cylinder(0.14, 0.5, 32),
        paint.stripes(3, WHITE, BLUE, 3, 64),
        (-1.5, 1.2, 3.7),
        name="vase",
    )
    stage.add(cc.Mesh.cylinder(0.32, 0.55, 32), (0.72, 0.42, 0.3), (-4.4, 0.275, 3.4), name="pot")
    leaf = paint.mixed(paint.clouds(128, 128, 12, 8), (0.12, 0.32, 0.12), (0.5, 0.75, 0.3))
    for number, (y, r) in enumerate(((1.0, 0.52), (1.6, 0.45), (2.15, 0.34))):
        stage.add(cc.Mesh.sphere(r, 32, 16), leaf, (-4.35, y, 3.35), name=f"leaves {number + 1}")
    stage.add(
        cc.Mesh.cylinder(0.03, 1.9, 12), (0.2, 0.18, 0.16), (3.9, 0.95, 3.2), name="lamp's foot"
    )
    stage.add(
        cc.Mesh.cone(0.42, 0.55, 32), (1.0, 0.9, 0.68), (3.9, 2.1, 3.2), name="lamp", even=True
    )
    stage.add(
        cc.Mesh.cylinder(0.55, 0.12, 48),
        (1.0, 0.97, 0.88),
        (0, 5.93, 0),
        name="ceiling lamp",
        even=True,
    )
    # The foot of the reflector.
    stage.add(cc.Mesh.cylinder(0.32, 0.04, 48), (0.3, 0.3, 0.32), (0, 0.03, 0), name="foot")
    stage.add(cc.Mesh.cylinder(0.03, 0.83, 16), (0.3, 0.3, 0.32), (0, 0.45, 0), name="rod")
    return stage.finish((0, 1.5, 0), (1.05, 1.9, 2.15), 38)


def _panelled(above: paint.Color, below: paint.Color, width: int) -> paint.Array:
    """A wall with a chequered band, panels below it and stripes above, (384, width, 3)."""
    u, v = paint.grid(width, 384)
    meter = u * width / 64
    color = paint.mixed(((meter * 2) % 1 < 0.5) * 0.5, above, tuple(0.85 * c for c in above))
    panel = (np.abs((meter / 1.25) % 1 - 0.5) < 0.4) & (v > 0.03) & (v < 0.16)
    below = tuple(0.6 * c + 0.28 for c in below)
    color[v < 0.2] = tuple(0.85 * c for c in below)
    color[panel] = below
    band = (v >= 0.2) & (v < 0.26)
    color[band] = paint.mixed(
        (((meter * 4) + np.floor((v - 0.2) / 0.03)) % 2 < 1) * 0.5, WHITE, below
    )[band]
    frieze = (v > 0.88) & (v < 0.96)
    color[frieze] = paint.mixed(
        (np.abs((meter * 2) % 1 - 0.5) < 0.3 * (1 - np.abs(v - 0.92) / 0.04)) * 0.6, below, WHITE
    )[frieze]
    return in_corners(color)


def _wallpaper(width: int, color: paint.Color) -> paint.Array:
    """Wallpaper with a pattern of rhombs, over a dark dado, (384, width, 3)."""
    u, v = paint.grid(width, 384)
    x, y = u * width / 64 * 1.6, v * 6 * 1.6
    rhomb = np.abs(x % 1 - 0.5) + np.abs(y % 1 - 0.5)
    found = paint.mixed((rhomb < 0.36) * 0.5, color, tuple(0.76 * c for c in color))
    found[(rhomb < 0.14)] = tuple(0.5 + 0.5 * c for c in color)
    found[v < 0.17] = tuple(0.5 * c for c in color)
    found[(v > 0.15) & (v < 0.18)] = WHITE
    found[v < 0.025] = WHITE
    found[v > 0.97] = WHITE
    return in_corners(found)
