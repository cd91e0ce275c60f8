"""A furnished room for exact rays: a wall mirror, rough metal, glass, and two mirror balls that face each other.

The walls and most of the furniture are `PhongMaterial`, which ends a path, so that the picture soon has little noise.
"""

from __future__ import annotations

import numpy as np

import cubecam as cc

#: Width, height and depth in metres; the floor is y = 0, and the middle of the floor is the origin.
SIZE = (5.2, 2.7, 4.4)
CREAM, SAGE, WHITE = (0.86, 0.79, 0.68), (0.45, 0.55, 0.47), (0.9, 0.89, 0.86)
OAK, WALNUT, LINEN = (0.62, 0.42, 0.24), (0.3, 0.17, 0.1), (0.75, 0.68, 0.58)
BOOKS = ((0.55, 0.16, 0.13), (0.15, 0.28, 0.42), (0.72, 0.55, 0.2), (0.2, 0.36, 0.24), WHITE)


def build() -> cc.Scene:
    """Make the scene, with its camera as ``scene.cameras[0]``."""
    scene = cc.Scene(background=(0.55, 0.68, 0.85))
    scene.add(
        cc.PerspectiveCamera(
            fov=52, position=(1.35, 1.42, 1.75), target=(-0.72, 0.86, -0.55), near=0.05, far=50
        )
    )
    _shell(scene)
    _lamps(scene)
    _table(scene)
    _shelf(scene)
    _sofa(scene)
    return scene


def _matt(color: tuple[float, float, float], gloss: float = 0.0) -> cc.PhongMaterial:
    return cc.PhongMaterial(color=color, ka=0.32, kd=0.75, ks=gloss, shininess=40)


def _box(
    scene: cc.Scene,
    low: tuple[float, float, float],
    high: tuple[float, float, float],
    material: cc.Material,
    name: str,
) -> cc.Node:
    """Add a box between two corners."""
    a, b = np.array(low), np.array(high)
    return scene.add(cc.Mesh.box(b - a), material, position=(a + b) / 2, name=name)


def _planks() -> np.ndarray:
    """Draw a floor of oak, (1024, 1024, 3) uint8: boards of different tones with grain along them."""
    rng = np.random.default_rng(4)
    row, column = np.mgrid[0:1024, 0:1024]
    board = row // 64
    shift = rng.integers(0, 1024, 16)[board]
    piece = ((column + shift) // 384) % 8
    tone = 1 + 0.28 * (rng.random((16, 8))[board, piece] - 0.5)
    grain = np.sin((row % 64) * 1.7 + 6 * np.sin((column + shift) / 90) + board * 3)
    color = np.array(OAK) * (tone * (1 + 0.05 * grain))[..., None]
    gap = (row % 64 < 2) | ((column + shift) % 384 < 2)
    color[gap] *= 0.45
    return np.asarray(np.rint(255 * np.clip(color, 0, 1)), np.uint8)


def _rug() -> np.ndarray:
    """Draw a rug with a border and rhombs, (512, 768, 3) uint8."""
    y, x = np.mgrid[0:512, 0:768]
    color = np.empty((512, 768, 3))
    color[:] = (0.5, 0.13, 0.12)
    rhombs = np.abs((x % 128) - 64) + np.abs((y % 128) - 64)
    color[rhombs < 44] = (0.82, 0.68, 0.45)
    color[rhombs < 28] = (0.13, 0.2, 0.33)
    edge = np.minimum.reduce([x, 767 - x, y, 511 - y])
    color[edge < 40] = (0.13, 0.2, 0.33)
    color[(edge < 24) | ((edge > 40) & (edge < 46))] = (0.82, 0.68, 0.45)
    thread = 1 - 0.12 * ((x + y) % 3 == 0)
    return np.asarray(np.rint(255 * color * thread[..., None]), np.uint8)


def _shell(scene: cc.Scene) -> None:
    """Add floor, ceiling, walls, a window with the sky in it, and a mirror on the left wall."""
    w, h, d = SIZE
    wall, side = _matt(CREAM), _matt(SAGE)
    thick = 0.12
    floor = cc.PhongMaterial(
        color=(1, 1, 1), ka=0.32, kd=0.75, ks=0.12, shininess=30, map=_planks()
    )
    scene.add(cc.Mesh.plane(w, d), floor, name="floor")
    _box(scene, (-w / 2, h, -d / 2), (w / 2, h + thick, d / 2), _matt(WHITE), "ceiling")
    _box(scene, (-w / 2 - thick, 0, -d / 2), (-w / 2, h, d / 2), side, "left wall")
    _box(scene, (w / 2, 0, -d / 2), (w / 2 + thick, h, d / 2), side, "right wall")
    _box(scene, (-w / 2, 0, d / 2), (w / 2, h, d / 2 + thick), wall, "wall behind")
    # The wall in front has a hole for the window.
    left, right, sill, top = 0.35, 1.75, 0.95, 2.2
    z = -d / 2
    for name, low, high in (
        ("wall left of the window", (-w / 2, 0), (left, h)),
        ("wall right of the window", (right, 0), (w / 2, h)),
        ("wall below the window", (left, 0), (right, sill)),
        ("wall above the window", (left, top), (right, h)),
    ):
        _box(scene, (*low, z - thick), (*high, z), wall, name)
    frame = _matt(WHITE, 0.2)
    bar = 0.05
    middle = (left + right) / 2
    for name, low, high in (
        ("window sill", (left - 0.06, sill - 0.04), (right + 0.06, sill)),
        ("window bar", (middle - bar / 2, sill), (middle + bar / 2, top)),
        ("window lintel", (left, top - bar), (right, top)),
        ("window left", (left, sill), (left + bar, top)),
        ("window right", (right - bar, sill), (right, top)),
    ):
        deep = 0.1 if name == "window sill" else 0.0
        _box(scene, (*low, z - 0.08), (*high, z - 0.02 + deep), frame, name)
    rug = cc.PhongMaterial(color=(1, 1, 1), ka=0.32, kd=0.75, ks=0, map=_rug())
    scene.add(cc.Mesh.plane(2.4, 1.6), rug, position=(-0.5, 0.004, 0.1), name="rug")
    quarter = cc.axis_angle((0, 0, 1), -90)
    x = -w / 2 + 0.03
    scene.add(
        cc.Mesh.plane(1.3, 1.7),
        cc.MirrorMaterial(tint=(0.96, 0.97, 0.96)),
        position=(x + 0.012, 1.3, -0.35),
        rotation=quarter,
        name="wall mirror",
    )
    _box(scene, (x - 0.03, 0.6, -1.25), (x, 2.0, 0.55), _matt(WALNUT, 0.3), "mirror frame")
    skirting = _matt(WHITE, 0.1)
    _box(scene, (-w / 2, 0, z), (w / 2, 0.09, z + 0.015), skirting, "skirting in front")
    _box(scene, (-w / 2, 0, z), (-w / 2 + 0.015, 0.09, d / 2), skirting, "skirting left")


def _lamps(scene: cc.Scene) -> None:
    """Add a lamp over the table and the light of the window."""
    at = np.array((-0.5, 1.85, 0.0))
    shade = cc.BasicMaterial(color=(1.0, 0.93, 0.78))
    globe = scene.add(cc.Mesh.sphere(0.11, 48, 24), shade, position=at, name="lamp")
    globe.cast_shadow = False
    cord = scene.add(
        cc.Mesh.cylinder(0.008, SIZE[1] - at[1], 12),
        _matt((0.1, 0.1, 0.1)),
        position=(at[0], (SIZE[1] + at[1]) / 2, at[2]),
        name="cord",
    )
    cord.cast_shadow = False
    warm, sky = (1.0, 0.86, 0.68), (0.75, 0.86, 1.0)
    scene.add(
        cc.PointLight(
            position=at, color=warm, intensity=1.15, decay=1.0, shadow=cc.Shadow(size=1024)
        )
    )
    scene.add(
        cc.DirectionalLight(
            direction=(-0.6, -0.75, 0.85), color=sky, intensity=0.55, shadow=cc.Shadow(size=2048)
        )
    )


def _table(scene: cc.Scene) -> None:
    """Add the table with two mirror balls, a glass ball, and a rough golden teapot on it."""
    top, wood = 0.74, _matt(WALNUT, 0.35)
    x, z = -0.5, 0.0
    _box(scene, (x - 0.85, top - 0.04, z - 0.5), (x + 0.85, top, z + 0.5), wood, "table")
    for i, (dx, dz) in enumerate(((-0.78, -0.43), (0.78, -0.43), (-0.78, 0.43), (0.78, 0.43))):
        _box(
            scene,
            (x + dx - 0.03, 0, z + dz - 0.03),
            (x + dx + 0.03, top - 0.04, z + dz + 0.03),
            wood,
            f"leg {i + 1}",
        )
    ball = cc.Mesh.sphere(0.17, 128, 64)
    mirror = cc.MirrorMaterial(tint=(0.97, 0.96, 0.94))
    for name, dx, dz in (("left mirror ball", -0.5, 0.2), ("right mirror ball", -0.12, -0.16)):
        scene.add(ball, mirror, position=(x + dx, top + 0.17, z + dz), name=name)
    scene.add(
        cc.Mesh.sphere(0.13, 128, 64),
        cc.GlassMaterial(ior=1.5, tint=(0.97, 1.0, 0.98)),
        position=(x + 0.22, top + 0.13, z + 0.3),
        name="glass ball",
    )
    teapot = cc.load_mesh(cc.sample_data("teapot.obj")).resized(0.52)
    low = teapot.bounds[0][1]
    scene.add(
        teapot,
        cc.StandardMaterial(color=(1.0, 0.77, 0.34), metallic=1, roughness=0.28, double_sided=True),
        position=(x + 0.48, top - low, z - 0.18),
        rotation=cc.axis_angle((0, 1, 0), -35),
        name="teapot",
    )


def _shelf(scene: cc.Scene) -> None:
    """Add a shelf with books on the wall in front, left of the window."""
    rng = np.random.default_rng(2)
    wood = _matt(OAK, 0.2)
    left, right, z = -1.75, -0.2, -SIZE[2] / 2
    for number, height in enumerate((0.95, 1.35, 1.75)):
        _box(
            scene, (left, height, z), (right, height + 0.03, z + 0.26), wood, f"board {number + 1}"
        )
        x = left + 0.04
        while x < right - 0.3 - 0.25 * number:
            thick, tall = rng.uniform(0.025, 0.055), rng.uniform(0.2, 0.3)
            color = BOOKS[int(rng.integers(len(BOOKS)))]
            _box(
                scene,
                (x, height + 0.03, z + 0.02),
                (x + thick, height + 0.03 + tall, z + 0.2),
                _matt(color, 0.15),
                "book",
            )
            x += thick + 0.003
    bunny = cc.load_mesh(cc.sample_data("bunny.obj")).resized(0.28)
    scene.add(
        bunny,
        _matt(WHITE, 0.3),
        position=(right - 0.18, 1.38 - bunny.bounds[0][1], z + 0.14),
        rotation=cc.axis_angle((0, 1, 0), 25),
        name="bunny",
    )


def _sofa(scene: cc.Scene) -> None:
    """Add a sofa below the window, and a vase of blue glass beside it on the sill."""
    cloth = _matt((0.32, 0.4, 0.5))
    x, z = 1.1, -SIZE[2] / 2 + 0.12
    _box(scene, (x - 0.95, 0.12, z), (x + 0.95, 0.42, z + 0.8), cloth, "sofa")
    _box(scene, (x - 0.95, 0.42, z), (x + 0.95, 0.82, z + 0.2), cloth, "sofa back")
    for name, a in (("left arm", x - 0.95), ("right arm", x + 0.77)):
        _box(scene, (a, 0.12, z), (a + 0.18, 0.6, z + 0.8), cloth, name)
    for name, dx, color in (("cushion 1", -0.5, BOOKS[2]), ("cushion 2", 0.35, BOOKS[0])):
        scene.add(
            cc.Mesh.box((0.4, 0.36, 0.12)),
            _matt(color),
            position=(x + dx, 0.6, z + 0.3),
            rotation=cc.axis_angle((1, 0, 0), -20),
            name=name,
        )
    scene.add(
        cc.Mesh.cylinder(0.06, 0.26, 64),
        cc.StandardMaterial(color=(0.06, 0.16, 0.5), metallic=0, roughness=0.08, clearcoat=1),
        position=(0.62, 0.95 + 0.13, -SIZE[2] / 2 + 0.03),
        name="vase",
    )
