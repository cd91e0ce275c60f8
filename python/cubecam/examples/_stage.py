"""The staged scene of P13 to P17, made for eyes: a tiled floor beside the quay, lamps, figures of enamel.

The documents print the numbers of their scenes, and ``build(document=True)`` uses them. The parts here are for the
scenes that are looked at. The light is Phong's, as in the documents, and its numbers are shown unchanged.
"""

from __future__ import annotations

import functools
from typing import TypeAlias

import numpy as np

import cubecam as cc

from ._common import Photographs, Picture, bunny, surroundings, teapot

Color: TypeAlias = tuple[float, float, float]
#: "bunny" or "teapot", its largest extent in world units, and its colour.
Figure: TypeAlias = tuple[str, float, Color]

GREEN, RED = (0.35, 0.8, 0.35), (0.95, 0.3, 0.25)
YELLOW, BLUE = (0.98, 0.7, 0.15), (0.2, 0.6, 0.95)
IVORY, SLATE, MORTAR = (0.86, 0.83, 0.77), (0.36, 0.44, 0.62), (0.55, 0.53, 0.5)
STONE = (0.93, 0.86, 0.74)


@functools.cache
def tiles(
    count: int,
    colors: tuple[Color, Color] = (IVORY, SLATE),
    joint: tuple[float, Color] = (0.06, MORTAR),
    texels: int = 1024,
) -> Picture:
    """Draw a floor of `count` x `count` tiles, (N, N, 3) uint8, in two colours by turns.

    joint : the width of the gaps in tiles, and their colour. texels : N, at least; each tile has a whole number.
    """
    edge = -(-texels // count)
    tile, within = np.divmod(np.arange(count * edge), edge)
    odd = (tile[:, None] + tile[None, :]) % 2 == 1
    floor = np.where(odd[..., None], *(np.array(color) for color in colors))
    # No two tiles of a floor are burnt alike.
    burnt = 1 + 0.06 * (np.random.default_rng(1).random((count, count)) - 0.5)
    floor *= burnt[tile[:, None], tile[None, :], None]
    gap = np.abs(within + 0.5 - edge / 2) > (1 - joint[0]) * edge / 2
    floor[gap[:, None] | gap[None, :]] = joint[1]
    pixels = np.asarray(np.rint(255 * np.clip(floor, 0, 1)), np.uint8)
    pixels.setflags(write=False)  # all programs share it
    return pixels


def glaze(color: Color) -> cc.PhongMaterial:
    """Make the material of the figures: a strong colour with a small white highlight."""
    return cc.PhongMaterial(color=color, ka=0.3, kd=0.75, ks=0.6, shininess=30)


def stone(pattern: Picture | None = None) -> cc.PhongMaterial:
    """Make a material with little gloss: sandstone, or the picture of tiles."""
    color = STONE if pattern is None else (1.0, 1.0, 1.0)
    return cc.PhongMaterial(color=color, ka=0.35, kd=0.75, ks=0.08, shininess=20, map=pattern)


def quay(images: Photographs | None = None, shadows: bool = True, turn: float = 0.0) -> cc.Scene:
    """Make a scene with the photographs round it and the light of a late afternoon, and nothing else.

    turn : degrees by which the photographs are turned round +Y; the light is not.
    """
    scene = cc.Scene(
        environment=surroundings(images), environment_rotation=cc.axis_angle((0, 1, 0), turn)
    )
    shadow = cc.Shadow(size=1024, radius=1) if shadows else None
    scene.add(cc.DirectionalLight((1.2, -1.8, -0.6), color=(1, 0.95, 0.85), shadow=shadow))
    # The sky lights what the sun does not reach, so that no figure is black in a mirror.
    scene.add(cc.DirectionalLight((-0.6, -0.8, 1.0), color=(0.6, 0.7, 0.9), intensity=0.5))
    # The floor throws light back.
    scene.add(cc.DirectionalLight((0, 1, 0), color=(1, 0.95, 0.85), intensity=0.45))
    return scene


def lay_floor(scene: cc.Scene, height: float, edge: int = 40, tile: int = 1) -> cc.Node:
    """Lay a square floor of square tiles round the +Y axis; edges of both in world units."""
    return scene.add(
        cc.Mesh.plane(edge, edge),
        stone(tiles(edge // tile, joint=(0.06 / tile, MORTAR), texels=2048)),
        position=(0, height, 0),
        cast_shadow=False,
    )


@functools.cache
def figure(kind: str, size: float) -> cc.Mesh:
    """Return the "bunny" or the "teapot" with its origin under its feet, largest extent `size` world units."""
    mesh = {"bunny": bunny, "teapot": teapot}[kind](size)
    raised = mesh.positions - (0.0, float(mesh.bounds[0][1]), 0.0)
    return cc.Mesh(raised.astype(np.float32), mesh.indices, normals=mesh.normals)


def shade(scene: cc.Scene, node: cc.Node, radius: float) -> cc.Node:
    """Darken the floor under a node, in place of a shadow that the lamp makes; radius in the node's own units."""
    across = (np.arange(64) + 0.5) / 32 - 1
    away = np.hypot(across[:, None], across[None, :])
    dark = np.zeros((64, 64, 4))
    dark[..., 3] = 0.65 * np.clip(1 - away, 0, 1) ** 1.5
    pixels = np.asarray(np.rint(255 * dark), np.uint8)
    return scene.add(
        cc.Mesh.plane(2 * radius, 2 * radius),
        cc.BasicMaterial(map=pixels, blend="alpha"),
        position=(0, 0.01, 0),
        parent=node,
    )


def no_photographs(images: Photographs | None) -> None:
    """Refuse photographs for the scene of a document that has none."""
    if images is not None:
        raise ValueError(
            "images: expected None with document=True, since the document's scene has no photographs; "
            f"got {type(images).__name__}"
        )
