"""P11: the parts of a framebuffer (document 004, sections 7.4 and 7.4.3).

A framebuffer has colour buffers, a depth buffer, perhaps a stencil buffer, each of a format: RGBA8
or RGB565, DEPTH_COMPONENT16, STENCIL_INDEX8. Several colour buffers are filled in one pass: here
colour, distance, normal, position and id. And it may have depth alone: a shadow map is such a
target, drawn from the lamp.

Look for, from left to right and top to bottom: colour with shadows in RGBA8; the same in RGB565, in
bands of 32, 64 and 32 steps; depth; normals and positions as colours; a colour for each id.

Worth trying: ``parts(program, renderer, frame, size)`` gives them as arrays of numbers. A depth of
16 bits has 65,536 steps between near and far, most of them near: move near to 0.01 and see what is
left for the ground.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, teapot

PROGRAM = "P11"
TITLE = "The parts of a framebuffer, and a shadow map"
FRAMES = 120  # one turn
STILL = 0
SIZE = (768, 512)  # three by two pictures

GREY = (0.4, 0.4, 0.4, 1.0)
NEAR, FAR = 1.0, 20.0  # world units
SHADOW = 512  # pixels along an edge of the shadow map
TURN = 3.0  # degrees a frame
OUTPUTS = ("distance", "normal", "position", "id", "depth", "stencil")


@dataclass
class Program:
    """`ring` is what turns."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ring: cc.Node


def build() -> Program:
    """Make the scene: bunny, teapot and box on a ground under one lamp that throws shadows."""
    scene = cc.Scene(background=GREY)
    lamp: Any = cc.PointLight
    scene.add(lamp(position=LIGHT, shadow=cc.Shadow(size=SHADOW)))
    scene.add(
        cc.Mesh.plane(8, 8), cc.PhongMaterial(color=(0.6, 0.6, 0.7), ks=0), position=(0, -0.6, 0)
    )
    ring = scene.add()
    things = (
        (bunny(), (0.4, 1.0, 0.4)),
        (teapot(), (1.0, 0.4, 0.4)),
        (cc.Mesh.box(0.8), (0.4, 0.4, 1.0)),
    )
    for index, (mesh, color) in enumerate(things):
        place = on_circle(1.4, 0, math.radians(360 * index / len(things)))
        scene.add(mesh, cc.PhongMaterial(color=color), position=place, parent=ring)
    camera = cc.PerspectiveCamera(
        fov=45, position=(0, 2.5, 5), target=(0, 0, 0), near=NEAR, far=FAR
    )
    return Program(scene, camera, ring)


def parts(
    program: Program, renderer: Any, frame: int, size: tuple[int, int], **options: Any
) -> dict[str, Picture]:
    """Give every part as an array: one pass for all outputs, and one more for the colours of 16 bits."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    scene, camera = program.scene, program.camera
    drawn = renderer.render(
        scene, camera, size, outputs=OUTPUTS, depth_format="depth_component16", format="rgba8",
        **options,
    )  # fmt: skip
    small = renderer.render(scene, camera, size, format="rgb565", **options)
    found = {name: getattr(drawn, name) for name in OUTPUTS}
    return {"color": drawn.color, "rgb565": small.color, **found}


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Any,
) -> Picture:
    """Draw a frame as three by two pictures, uint8; each has its own format, which is therefore no option."""
    cell = (max(size[0] // 3, 1), max(size[1] // 2, 1))
    part = parts(program, renderer, frame, cell, **options)
    depth = np.repeat(part["depth"][..., None], 3, axis=2)
    normal = part["normal"] / 2 + 0.5
    position = np.nan_to_num(part["position"] / 4 + 0.5, nan=0.4)
    # Far apart from each other, for ids that follow each other.
    hues = (part["id"][..., None] * np.array([0.37, 0.61, 0.83])) % 1
    cells = [
        _bytes(item) for item in (part["color"], part["rgb565"], depth, normal, position, hues)
    ]
    rows = [np.concatenate(cells[:3], axis=1), np.concatenate(cells[3:], axis=1)]
    return np.concatenate(rows)


def _bytes(picture: Picture) -> Picture:
    """Give (H, W, 4) uint8, opaque, of uint8 or of 0..1."""
    colour = picture[..., :3]
    if colour.dtype != np.uint8:
        colour = np.rint(np.clip(colour, 0, 1) * 255).astype(np.uint8)
    return np.concatenate([colour, np.full_like(colour[..., :1], 255)], axis=2)
