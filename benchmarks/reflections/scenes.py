"""Three scenes to reflect: two rooms and a village. Each has a camera, and an empty node where the reflector stands.

They are written to room_a.glb, room_b.glb and outdoor.glb beside this file (`python -m benchmarks.reflections --write`), which
are what the benchmark loads. `load` adds the sky to the village, a photograph of the package's own data, which would be large.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import cubecam as cc

from . import paint
from .stage import Stage, in_corners, shadowed

FOLDER = Path(__file__).parent
#: The name of the empty node at the middle of the reflector.
PLACE = "place of the reflector"
SKY = "sunrise.exr"

CREAM, SAGE, WHITE, GREY = (0.93, 0.87, 0.75), (0.56, 0.68, 0.58), (0.94, 0.94, 0.92), (0.5, 0.5, 0.52)
OAK, WALNUT, RED, BLUE = (0.76, 0.56, 0.36), (0.42, 0.27, 0.17), (0.74, 0.22, 0.18), (0.2, 0.36, 0.62)
GOLD, GREEN, TEAL = (0.87, 0.68, 0.26), (0.24, 0.5, 0.25), (0.13, 0.46, 0.48)
BOOKS = (RED, BLUE, GOLD, GREEN, WHITE, TEAL, (0.35, 0.16, 0.3))


@dataclass(frozen=True)
class Place:
    """What is known of a scene.

    Attributes
    ----------
    build : callable
        Makes the scene.
    radius : float
        Of the mirror ball, metres.
    low, high : tuple of float
        The corners of the box that stands for the scene: the room, or a box about as wide as the village's middle.
    linear : bool
        Whether the colours are light, and are encoded for a screen before they are compared.
    """

    build: Callable[[], cc.Scene]
    radius: float
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    linear: bool = False


ROOM_LOW, ROOM_HIGH = (-5.0, 0.0, -4.0), (5.0, 6.0, 4.0)


def load(name: str) -> cc.Scene:
    """Load a scene of `PLACES` from its file."""
    scene = cc.load_scene(FOLDER / f"{name}.glb")
    return _under_the_sky(scene) if PLACES[name].linear else scene


def write(folder: Path = FOLDER) -> None:
    """Write the files of all scenes."""
    for name, place in PLACES.items():
        place.build().save(folder / f"{name}.glb")


def _under_the_sky(scene: cc.Scene) -> cc.Scene:
    sky = cc.load_environment(cc.sample_data(SKY), size=512)
    scene.environment = sky
    scene.background = sky
    return scene


def _finish(stage: Stage, middle: tuple[float, float, float], eye: tuple[float, float, float], fov: float) -> cc.Scene:
    stage.scene.add(position=middle, name=PLACE)
    stage.scene.add(
        cc.PerspectiveCamera(fov=fov, position=eye, target=middle, near=0.05, far=400)
    )
    return stage.scene


def _model(name: str, size: float) -> cc.Mesh:
    """A mesh of the package's data that stands on y = 0, `size` metres high or wide, without its own uvs."""
    mesh = cc.load_mesh(cc.sample_data(name)).resized(size)
    positions = np.asarray(mesh.positions).copy()
    low, high = mesh.bounds
    positions -= ((low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2)
    return cc.Mesh(positions, mesh.indices, normals=mesh.normals)


def room_a() -> cc.Scene:
    """A hall of 10 x 6 x 8 m with twelve things around its middle, where the reflector stands on a pedestal."""
    stage = Stage()
    spots = [
        (0, 0, 0.5, 0.5), (2.0, 1.9, 0.6, 0.6), (-2.0, 1.9, 0.6, 0.6), (2.0, -1.9, 0.6, 0.6), (-2.0, -1.9, 0.6, 0.6),
        (2.35, 0, 0.6, 0.9), (-1.9, 0.1, 0.6, 0.6), (0, -2.0, 1.0, 0.6), (1.35, 0.95, 0.6, 0.6), (-1.15, 1.45, 0.6, 0.6),
        (1.15, -1.15, 0.5, 0.5), (-1.2, -1.3, 0.8, 0.8),
    ]  # fmt: skip
    tiles = np.tile(paint.checks(4, 4, (0.86, 0.8, 0.7), (0.34, 0.3, 0.3), 128), (2, 3, 1))
    floor = np.asarray(
        cc.Image(paint.in_bytes(tiles)), float
    )[:, :320][:256] / 255  # 10 x 8 tiles of a metre
    floor = shadowed(floor, (-5, -4), (5, 4), spots)
    coffers = paint.mixed(
        np.clip(8 * (np.abs((paint.grid(320, 256)[0] * 5) % 1 - 0.5).clip(0.4) - 0.42), 0, 1), WHITE, OAK
    )
    beam = np.abs((paint.grid(320, 256)[1] * 4) % 1 - 0.5) > 0.44
    coffers[beam] = OAK
    stage.walls(
        ROOM_LOW,
        ROOM_HIGH,
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
        stage.quad((x - 0.9, 1.6, z), (1.8, 0, 0), (0, 2.6, 0), paint.window(), f"window {number + 1}")
    for number, (z, seed) in enumerate(((-1.8, 4), (1.8, 9))):
        stage.quad((4.97, 2.2, z - 0.9), (0, 0, 1.8), (0, 1.4, 0), paint.painting(seed), f"painting {number + 1}")
        stage.quad(
            (-4.97, 2.2, z + 0.9), (0, 0, -1.8), (0, 1.4, 0), paint.painting(seed + 20), f"painting {number + 3}"
        )
    stage.quad((0.8, 0, 3.97), (-1.6, 0, 0), (0, 2.6, 0), _door(), "door")

    # The pedestal, and twelve things around it.
    stage.add(cc.Mesh.cylinder(0.26, 0.86, 48), paint.stripes(12, WHITE, GREY), (0, 0.43, 0), name="pedestal")
    stage.add(cc.Mesh.cylinder(0.3, 0.06, 48), OAK, (0, 0.89, 0), name="pedestal top")
    marbles = (RED, TEAL, GOLD, BLUE)
    for number, (x, z) in enumerate(((2.0, 1.9), (-2.0, 1.9), (2.0, -1.9), (-2.0, -1.9))):
        shaft = paint.stripes(4, WHITE, marbles[number], 8)
        stage.add(cc.Mesh.cylinder(0.3, 5.4, 48), shaft, (x, 3, z), name=f"column {number + 1}")
        stage.box((x - 0.42, 0, z - 0.42), (x + 0.42, 0.3, z + 0.42), WHITE, "base")
        stage.box((x - 0.42, 5.7, z - 0.42), (x + 0.42, 6, z + 0.42), WHITE, "capital")
    stage.box((2.1, 0, -0.7), (2.6, 2.3, 0.7), paint.books(BOOKS), "bookcase")
    stage.box((-2.2, 0, -0.2), (-1.6, 0.8, 0.4), paint.checks(4, 4, WHITE, TEAL), "plinth")
    stage.add(_model("bunny.obj", 1.2), (0.92, 0.8, 0.62), (-1.9, 0.8, 0.1), turn=80, name="bunny")
    stage.box((-0.7, 0, -2.3), (0.7, 0.9, -1.7), paint.planks(OAK, WALNUT, 6), "cabinet")
    stage.add(_model("suzanne.glb", 1.1), (0.55, 0.75, 0.95), (0, 0.9, -2.0), name="head")
    stage.add(cc.Mesh.sphere(0.48, 48, 24), paint.checks(6, 1, RED, WHITE), (1.35, 0.48, 0.95), turn=30, axis=(1, 0, 1), name="ball")
    crate = _crate()
    stage.add(cc.Mesh.box(0.8), crate, (-1.15, 0.4, 1.45), turn=20, name="crate")
    stage.add(cc.Mesh.box(0.55), crate, (-1.1, 1.075, 1.45), turn=-15, name="small crate")
    stage.add(cc.Mesh.cylinder(0.26, 0.5, 32), paint.stripes(8, BLUE, WHITE), (1.15, 0.25, -1.15), name="pot")
    for number, (y, r) in enumerate(((0.95, 0.5), (1.45, 0.42), (1.9, 0.3))):
        leaf = paint.mixed(paint.clouds(128, 128, 12, 8), (0.12, 0.32, 0.12), (0.5, 0.75, 0.3))
        stage.add(cc.Mesh.sphere(r, 32, 16), leaf, (1.15, y, -1.15), name=f"leaves {number + 1}")
    seat = paint.checks(6, 6, (0.7, 0.35, 0.3), (0.85, 0.6, 0.4), 128)
    for name, size, at in (
        ("armchair", (0.9, 0.45, 0.8), (0, 0.225, 0)),
        ("armchair back", (0.9, 0.75, 0.2), (0, 0.7, -0.35)),
        ("armchair left", (0.16, 0.3, 0.78), (-0.38, 0.58, 0)),
        ("armchair right", (0.16, 0.3, 0.78), (0.38, 0.58, 0)),
    ):
        c = np.cos(np.radians(45)) * np.array(at)
        x, z = -1.2 + c[0] + c[2], -1.3 - c[0] + c[2]
        stage.add(cc.Mesh.box(size), seat, (x, at[1], z), turn=45, name=name)
    stage.add(cc.Mesh.sphere(0.32, 32, 16), (1.0, 0.95, 0.8), (0.5, 3.0, -0.5), name="lamp", even=True)
    stage.add(cc.Mesh.cylinder(0.015, 2.7, 8), (0.15, 0.13, 0.12), (0.5, 4.65, -0.5), name="cord")
    return _finish(stage, (0, 1.42, 0), (0.55, 1.75, 1.8), 40)


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
        ROOM_LOW,
        ROOM_HIGH,
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
    stage.quad((-2.6, 0.01, 1.9), (5.2, 0, 0), (0, 0, -3.8), paint.rug(RED, GOLD, (0.14, 0.2, 0.36)), "rug")
    # Left: a sofa and two paintings above it.
    cloth = paint.mixed(paint.stripes(24, (0, 0, 0), (1, 1, 1), size=128)[..., 0], (0.3, 0.42, 0.6), (0.36, 0.5, 0.68))
    stage.box((-4.98, 0.15, -1.6), (-3.9, 0.5, 1.6), cloth, "sofa")
    stage.box((-4.98, 0.5, -1.6), (-4.6, 1.05, 1.6), cloth, "sofa back")
    stage.box((-4.98, 0.5, -1.6), (-3.9, 0.75, -1.3), cloth, "left arm")
    stage.box((-4.98, 0.5, 1.3), (-3.9, 0.75, 1.6), cloth, "right arm")
    for number, (z, color) in enumerate(((-0.8, GOLD), (0, WHITE), (0.8, RED))):
        cushion = paint.checks(4, 4, color, tuple(0.75 * c for c in color), 64)
        stage.add(cc.Mesh.box((0.18, 0.45, 0.5)), cushion, (-4.45, 0.73, z), turn=18, axis=(0, 0, 1), name=f"cushion {number + 1}")
    for number, (z, seed) in enumerate(((-0.95, 5), (0.95, 14))):
        stage.quad((-4.97, 2.0, z + 0.8), (0, 0, -1.6), (0, 1.2, 0), paint.painting(seed), f"painting {number + 1}")
    # In front: a fireplace between a bookcase and a desk.
    stone = paint.bricks((0.62, 0.36, 0.28), (0.75, 0.72, 0.68), 12)
    stage.box((-0.9, 0, -3.99), (2.1, 1.5, -3.5), stone, "fireplace", repeat=(1.5, 1))
    stage.box((-1.0, 1.5, -3.99), (2.2, 1.62, -3.4), OAK, "mantelpiece")
    stage.box((0.0, 1.62, -3.99), (1.2, 5.99, -3.6), stone, "chimney", repeat=(0.7, 3))
    fire = paint.mixed(paint.clouds(64, 64, 5, 6) * np.clip(1.5 - 1.4 * paint.grid(64, 64)[1], 0, 1), (0.1, 0.05, 0.03), (1, 0.75, 0.2))
    stage.quad((0.1, 0.12, -3.49), (1.0, 0, 0), (0, 0.95, 0), fire, "fire")
    stage.add(_model("bunny.obj", 0.5), GOLD, (-0.5, 1.62, -3.65), name="bunny")
    stage.add(_model("suzanne.glb", 0.5), TEAL, (1.7, 1.62, -3.65), name="head")
    for number, x in enumerate((-4.3, -2.9)):
        stage.box((x, 0, -3.99), (x + 1.3, 3.0, -3.55), paint.books(BOOKS, 5), f"bookcase {number + 1}")
    stage.box((2.9, 0.72, -3.95), (4.9, 0.8, -3.0), WALNUT, "desk")
    for number, (x, z) in enumerate(((3.0, -3.85), (4.8, -3.85), (3.0, -3.1), (4.8, -3.1))):
        stage.box((x - 0.04, 0, z - 0.04), (x + 0.04, 0.72, z + 0.04), WALNUT, f"leg {number + 1}")
    stage.box((3.5, 0.8, -3.8), (4.3, 1.35, -3.74), paint.painting(31), "screen")
    # Right: a window with curtains, and a long bench.
    stage.quad((4.97, 1.2, -1.3), (0, 0, 2.6), (0, 2.7, 0), paint.window(), "window")
    curtain = paint.mixed(0.5 + 0.5 * np.sin(2 * np.pi * 5 * paint.grid(128, 32)[0]), (0.55, 0.16, 0.16), (0.8, 0.32, 0.28))
    for number, z in enumerate((-2.0, 1.3)):
        stage.box((4.8, 0.3, z), (4.95, 4.2, z + 0.7), curtain, f"curtain {number + 1}")
    stage.box((4.3, 0, -1.1), (4.98, 0.5, 1.1), paint.planks(OAK, WALNUT, 5, 128), "bench")
    stage.add(_model("teapot.obj", 0.6), (0.85, 0.88, 0.95), (4.6, 0.5, 0.5), turn=30, name="teapot")
    # Behind: a door and a sideboard; plants and lamps in the corners.
    stage.quad((4.3, 0, 3.97), (-1.4, 0, 0), (0, 2.5, 0), _door(), "door")
    stage.box((-2.0, 0, 3.5), (0.9, 0.95, 3.99), paint.planks(WALNUT, OAK, 3, 128, 5), "sideboard")
    stage.quad((0.4, 1.6, 3.96), (-1.9, 0, 0), (0, 1.4, 0), paint.painting(42), "painting 3")
    stage.add(cc.Mesh.cylinder(0.14, 0.5, 32), paint.stripes(3, WHITE, BLUE, 3, 64), (-1.5, 1.2, 3.7), name="vase")
    stage.add(cc.Mesh.cylinder(0.32, 0.55, 32), (0.72, 0.42, 0.3), (-4.4, 0.275, 3.4), name="pot")
    leaf = paint.mixed(paint.clouds(128, 128, 12, 8), (0.12, 0.32, 0.12), (0.5, 0.75, 0.3))
    for number, (y, r) in enumerate(((1.0, 0.52), (1.6, 0.45), (2.15, 0.34))):
        stage.add(cc.Mesh.sphere(r, 32, 16), leaf, (-4.35, y, 3.35), name=f"leaves {number + 1}")
    stage.add(cc.Mesh.cylinder(0.03, 1.9, 12), (0.2, 0.18, 0.16), (3.9, 0.95, 3.2), name="lamp's foot")
    stage.add(cc.Mesh.cone(0.42, 0.55, 32), (1.0, 0.9, 0.68), (3.9, 2.1, 3.2), name="lamp", even=True)
    stage.add(cc.Mesh.cylinder(0.55, 0.12, 48), (1.0, 0.97, 0.88), (0, 5.93, 0), name="ceiling lamp", even=True)
    # The foot of the reflector.
    stage.add(cc.Mesh.cylinder(0.32, 0.04, 48), (0.3, 0.3, 0.32), (0, 0.03, 0), name="foot")
    stage.add(cc.Mesh.cylinder(0.03, 0.83, 16), (0.3, 0.3, 0.32), (0, 0.45, 0), name="rod")
    return _finish(stage, (0, 1.5, 0), (1.05, 1.9, 2.15), 38)


def outdoor() -> cc.Scene:
    """A village green: houses, trees, crates and a wall at 3 to 60 m, under a sky of high dynamic range."""
    stage = Stage(linear=True)
    green = paint.mixed(paint.clouds(128, 128, 6, 11), (0.3, 0.4, 0.16), (0.52, 0.6, 0.28))
    plane = cc.Mesh.plane(130, 130)
    stage.add(plane, green, name="ground", even=True, repeat=(16, 16))
    # Paving round the reflector, just above the grass.
    slabs = paint.bricks((0.66, 0.62, 0.56), (0.42, 0.4, 0.36), 8, 128, 12)
    stage.add(cc.Mesh.plane(7, 7), slabs, (0, 0.02, 0), name="paving", even=True, repeat=(2, 2))
    stage.add(cc.Mesh.plane(3, 50), slabs, (0, 0.01, -28), name="path", even=True, repeat=(1, 14))
    stage.add(cc.Mesh.cylinder(0.3, 0.68, 48), paint.stripes(8, (0.75, 0.72, 0.68), (0.55, 0.52, 0.5), size=64), (0, 0.34, 0), name="plinth")
    roof, walls = paint.bricks((0.6, 0.26, 0.18), (0.4, 0.16, 0.12), 12, 128), (CREAM, (0.9, 0.72, 0.55), WHITE, (0.72, 0.78, 0.86), SAGE)
    places = ((-9, -12, 20), (8, -15, -15), (15, 2, 95), (-14, 4, -80), (4, 16, 170), (-8, 20, 160), (26, -22, -40), (-28, -18, 50), (30, 24, 130), (-24, 34, 200), (-3, -46, 5), (12, -52, -5))  # fmt: skip
    for number, (x, z, turn) in enumerate(places):
        color = walls[number % len(walls)]
        wide, deep, tall = 6 + number % 3, 5 + number % 2, 3.6 + 1.2 * (number % 5 % 2)
        front = paint.facade(color, WHITE, 3, 1 + number % 5 % 2, door=True)
        stage.add(cc.Mesh.box((wide, tall, deep)), front, (x, tall / 2, z), turn=turn, name=f"house {number + 1}")
        stage.add(_gable(wide + 0.8, 2.4, deep + 0.8), roof, (x, tall, z), turn=turn, name=f"roof {number + 1}", repeat=(2, 1))
    rng = np.random.default_rng(5)
    bark = paint.stripes(6, (0.36, 0.26, 0.18), (0.46, 0.35, 0.26), 1, 64)
    leaf = paint.mixed(paint.clouds(128, 128, 10, 8), (0.16, 0.3, 0.1), (0.5, 0.62, 0.26))
    trees = [(-3.4, -2.6), (3.6, -4.2), (-5.5, 3.6), (6.0, 5.5)]
    while len(trees) < 26:
        way, far = rng.uniform(0, 2 * np.pi), rng.uniform(9, 60)
        x, z = far * np.sin(way), far * np.cos(way)
        if abs(x) > 2.5 and min(np.hypot(x - a, z - b) for a, b, _ in places) > 6:
            trees.append((x, z))
    for number, (x, z) in enumerate(trees):
        near = number < 4
        tall = 1.5 if near else rng.uniform(1.5, 2.6)
        size = 0.75 if near else rng.uniform(1.2, 2.2)
        stage.add(cc.Mesh.cylinder(0.12 if near else 0.25, tall, 16), bark, (x, tall / 2, z), name=f"trunk {number + 1}")
        if number % 3 == 0:
            for layer in range(3):
                cone = cc.Mesh.cone(size * (1.1 - 0.25 * layer), size * 1.2, 24)
                stage.add(cone, leaf, (x, tall + size * (0.3 + 0.7 * layer), z), name=f"fir {number + 1}", repeat=(2, 1))
        else:
            stage.add(cc.Mesh.sphere(size, 24, 12), leaf, (x, tall + 0.8 * size, z), name=f"crown {number + 1}", repeat=(2, 1))
    for number, (x, z, size, turn) in enumerate(((2.9, 0.6, 1.0, 20), (3.1, 1.9, 0.7, 50), (-2.8, 1.4, 0.8, 10), (-2.9, -0.4, 0.5, 35))):
        stage.add(cc.Mesh.box(size), _crate(), (x, 0.02 + size / 2, z), turn=turn, name=f"crate {number + 1}")
    stone = paint.bricks((0.6, 0.57, 0.52), (0.4, 0.38, 0.35), 6, 128, 3)
    stage.box((-4.5, 0, -7.4), (-1.8, 1.1, -7.0), stone, "left wall", repeat=(3, 1))
    stage.box((1.8, 0, -7.4), (4.5, 1.1, -7.0), stone, "right wall", repeat=(3, 1))
    stage.box((1.2, 0.4, -3.2), (3.0, 0.5, -2.7), OAK, "bench")
    for x in (1.35, 2.75):
        stage.box((x, 0, -3.1), (x + 0.1, 0.4, -2.8), WALNUT, "bench's foot")
    scene = _finish(stage, (0, 1.2, 0), (0.7, 1.55, 1.85), 40)
    return scene


def _panelled(above: paint.Color, below: paint.Color, width: int) -> paint.Array:
    """A wall with a chequered band, panels below it and stripes above, (384, width, 3)."""
    u, v = paint.grid(width, 384)
    meter = u * width / 64
    color = paint.mixed(((meter * 2) % 1 < 0.5) * 0.35, above, tuple(0.75 * c for c in above))
    panel = (np.abs((meter / 1.25) % 1 - 0.5) < 0.4) & (v > 0.03) & (v < 0.16)
    color[v < 0.2] = tuple(0.75 * c for c in below)
    color[panel] = below
    band = (v >= 0.2) & (v < 0.26)
    color[band] = paint.mixed((((meter * 4) + np.floor((v - 0.2) / 0.03)) % 2 < 1) * 1.0, WHITE, below)[band]
    frieze = (v > 0.88) & (v < 0.96)
    color[frieze] = paint.mixed((np.abs((meter * 2) % 1 - 0.5) < 0.3 * (1 - np.abs(v - 0.92) / 0.04)) * 1.0, below, WHITE)[frieze]
    return in_corners(color)


def _wallpaper(width: int, color: paint.Color) -> paint.Array:
    """Wallpaper with a pattern of rhombs, over a dark dado, (384, width, 3)."""
    u, v = paint.grid(width, 384)
    x, y = u * width / 64 * 1.6, v * 6 * 1.6
    rhomb = np.abs(x % 1 - 0.5) + np.abs(y % 1 - 0.5)
    found = paint.mixed((rhomb < 0.36) * 0.5, color, tuple(0.6 * c for c in color))
    found[(rhomb < 0.14)] = WHITE
    found[v < 0.17] = tuple(0.5 * c for c in color)
    found[(v > 0.15) & (v < 0.18)] = WHITE
    found[v < 0.025] = WHITE
    found[v > 0.97] = WHITE
    return in_corners(found)


def _door() -> paint.Array:
    """A door with four panels in a frame, (192, 128, 3)."""
    u, v = paint.grid(128, 192)
    color = np.broadcast_to(np.asarray(WALNUT) * 1.2, (192, 128, 3)).copy()
    panel = (np.abs((u * 2) % 1 - 0.5) < 0.33) & (np.abs((v * 2) % 1 - 0.5) < 0.38)
    color[panel] = np.asarray(WALNUT) * 0.85
    color[(np.minimum(u, 1 - u) < 0.06) | (v > 0.96)] = WHITE
    color[np.hypot((u - 0.86) * 0.67, v - 0.48) < 0.025] = GOLD
    return color


def _crate() -> paint.Array:
    """The side of a wooden crate, (128, 128, 3)."""
    u, v = paint.grid(128, 128)
    color = paint.planks((0.78, 0.6, 0.38), (0.62, 0.45, 0.27), 5, 128, 9)
    edge = np.minimum(np.minimum(u, 1 - u), np.minimum(v, 1 - v))
    color[(edge < 0.13) | (np.abs(u - v) < 0.09)] = (0.55, 0.38, 0.22)
    color[(np.abs(edge - 0.13) < 0.012) | (np.abs(np.abs(u - v) - 0.09) < 0.012)] = (0.25, 0.17, 0.1)
    return color


def _gable(wide: float, tall: float, deep: float) -> cc.Mesh:
    """A gabled roof over a rectangle on y = 0, its ridge along x; flat faces, closed."""
    w, d = wide / 2, deep / 2
    a, b, c, e = (-w, 0, d), (w, 0, d), (w, 0, -d), (-w, 0, -d)
    left, right = (-w, tall, 0), (w, tall, 0)
    sides = ((a, b, right, left), (c, e, left, right), (b, c, right), (e, a, left), (e, c, b, a))
    positions, indices, uvs = [], [], []
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


PLACES = {
    "room_a": Place(room_a, 0.5, ROOM_LOW, ROOM_HIGH),
    "room_b": Place(room_b, 0.6, ROOM_LOW, ROOM_HIGH),
    "outdoor": Place(outdoor, 0.5, (-20, 0, -20), (20, 15, 20), linear=True),
}
