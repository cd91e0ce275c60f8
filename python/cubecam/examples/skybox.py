"""P3: the skybox (document 001, Ex10-3).

The viewer must never leave the sky, so it is not a box: a quad on the far plane covers the picture,
and each of its points looks up its direction, inverse(projection * view without translation) * clip
position. In cubecam this is a scene whose background is a CubeMap. The camera makes the drags and steps
of P2. Unlike in the document, three boxes stand in the scene, so that walking is visible.

Look for: turning moves the sky; walking does not move a pixel of it; the boxes stand in front of the
sky at any distance.

Worth trying: with ``build(boxes=False)``, pressing w seems to do nothing, although
`program.camera.position` changes. The document divides the direction by w before it normalises; a
float loses this w if far / near is 1e8. Without the division the direction is the same, so the renderer
does not divide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from . import inside_the_box
from ._common import Photographs, Picture, picture, surroundings
from ._live import live_view
from ._script import Event, Script
from .inside_the_box import SCRIPT, replay

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

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
    """`camera` moves: 60 degrees, near 1, far 15, as in P2. `frames` and `still` follow from the script."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    script: tuple[Event, ...]
    frames: int
    still: int


def build(
    images: Photographs | None = None,
    script: Script | None = None,
    boxes: bool = True,
    *,
    document: bool = False,
) -> Program:
    """Make the scene; images as in P1, the script as in P2."""
    scene = cc.Scene(background=surroundings(images))
    for color, place, size in BOXES if boxes else ():
        scene.add(cc.Mesh.box(size), cc.BasicMaterial(color=color), position=place)
    walk, frames, still = inside_the_box.walk_of(script)
    return Program(scene, inside_the_box.walker(), walk, frames, STILL if script is None else still)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw the view after the first `frame` events of the script."""
    replay(program.camera, program.script[: max(frame, 0)])
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    images: Photographs | None = None,
    boxes: bool = True,
    renderer: cc.Renderer | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag turns the view, w and s walk, and the sky stays where it is."""
    program = build(images, boxes=boxes, document=document)
    controls = inside_the_box.visitor(program.camera, script)
    return live_view(program, SIZE, TITLE, renderer, controls=controls)
