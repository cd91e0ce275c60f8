"""P3: the skybox (document 001, Ex10-3).

One is never to leave the box, so it is no box: a quad that covers the picture lies on the far
plane, and each of its points looks up the direction it is seen in, inverse(projection * view
without translation) * clip position. In cubecam that is a scene whose background is a CubeMap. The
same drags and steps as in P2 lead round; here three boxes stand about, which the document has not,
so that walking shows.

Look for: turning moves the sky, walking does not move one pixel of it, and the boxes stand before
it at any distance.

Worth trying: ``build(boxes=False)``: pressing w seems to do nothing, though
`program.camera.position` says otherwise. The document divides the direction by w before it
normalises; a float loses that w when far / near is 1e8. Leaving the division out gives the same
direction, and the renderer does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cubecam as cc

from . import inside_the_box
from ._common import Picture, picture, surroundings
from .inside_the_box import SCRIPT, Event, replay

PROGRAM = "P3"
TITLE = "Skybox: a background that walking never reaches"
FRAMES = len(SCRIPT) + 1
STILL = 23
SIZE = (512, 512)  # aspect 1

#: Colour, place and size of the boxes, world units.
BOXES = (
    ((0.9, 0.3, 0.2), (2.5, -0.4, 0.6), 0.8),
    ((0.2, 0.7, 0.3), (-2.2, 0.5, 3.0), 1.0),
    ((0.2, 0.4, 0.9), (1.2, -0.6, 5.0), 1.2),
)


@dataclass
class Program:
    """The camera is what moves: 60 degrees, near 1, far 15, as in P2."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    script: tuple[Event, ...]


def build(images: Any = None, script: Sequence[Event] = SCRIPT, boxes: bool = True) -> Program:
    """Make the scene; images as in P1, the script as in P2."""
    scene = cc.Scene(background=surroundings(images))
    for color, place, size in BOXES if boxes else ():
        scene.add(cc.Mesh.box(size), cc.BasicMaterial(color=color), position=place)
    return Program(scene, inside_the_box.walker(), tuple(script))


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Any,
) -> Picture:
    """Draw what the first `frame` events of the script lead to."""
    replay(program.camera, program.script[: max(frame, 0)])
    return picture(renderer, program.scene, program.camera, size, options)
