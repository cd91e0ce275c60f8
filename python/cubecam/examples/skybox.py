"""P3: the skybox (document 001, Ex10-3).

The viewer must never leave the sky, so it is not a box: a quad on the far plane covers the picture,
and each of its points looks up its direction, inverse(projection * view without translation) * clip
position. In cubecam this is a scene whose background is a CubeMap. Drags turn the camera, w and s walk, as in P2.
Unlike in the document, three boxes stand in the scene, so that walking is visible.

Look for: turning moves the sky; walking does not move a pixel of it; the boxes stand in front of the
sky at any distance.

Worth trying: with ``build(boxes=False)``, pressing w seems to do nothing, although
`program.camera.position` changes. The document divides the direction by w before it normalises; a
float loses this w if far / near is 1e8. Without the division the direction is the same, so the renderer
does not divide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import cubecam as cc

from . import inside_the_box
from ._common import Photographs, Picture, picture, surroundings
from ._live import live_view
from ._script import Event, Script, events
from .inside_the_box import SCRIPT, replay

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P3"
TITLE = "Skybox: a background that walking never reaches"
FRAMES = 151
STILL = 82
SIZE = (512, 512)  # aspect 1

#: Colour, place and size of a box, world units.
Box: TypeAlias = tuple[tuple[float, float, float], tuple[float, float, float], float]
BOXES: tuple[Box, ...] = (
    ((0.9, 0.3, 0.2), (2.5, -0.4, 0.6), 0.8),
    ((0.2, 0.7, 0.3), (-2.2, 0.5, 3.0), 1.0),
    ((0.2, 0.4, 0.9), (1.2, -0.6, 5.0), 1.2),
)

#: The walk of the staged scene: a look round, and a walk between the boxes.
WALK = "drag 160 0; w 30; s 30; drag -160 24; w 40; s 30"
#: The boxes and the lamp of the staged scene: in the middle of the view at the start, lit from behind the viewer.
STANDING: tuple[Box, ...] = (
    ((1.0, 0.35, 0.2), (1.3, -0.7, 3.4), 0.8),
    ((0.95, 0.8, 0.2), (-1.3, -0.6, 4.4), 1.0),
    ((0.25, 0.5, 1.0), (2.6, -0.3, 5.6), 1.5),
)
LAMP = (-4.0, 5.0, -5.0)


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    sample: str  # the photographs
    fov: float  # degrees
    boxes: tuple[Box, ...]
    lit: bool  # whether a lamp shades the boxes
    walk: tuple[Event, ...]
    still: int  # the best frame of the walk


DOCUMENT = Stage("sunset.exr", inside_the_box.FOV, BOXES, False, SCRIPT, 23)
STAGED = Stage("forest.exr", 90.0, STANDING, True, events(WALK, SIZE[1]), STILL)


@dataclass
class Program:
    """`camera` moves: near 1, far 15, as in P2; `frames` and `still` follow from the script."""

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
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=surroundings(images, stage.sample))
    if stage.lit:
        scene.add(cc.PointLight(position=LAMP))
    for color, place, size in stage.boxes if boxes else ():
        paint = (
            cc.PhongMaterial(color=color, ka=0.4, ks=0.2)
            if stage.lit
            else cc.BasicMaterial(color=color)
        )
        scene.add(cc.Mesh.box(size), paint, position=place)
    camera = inside_the_box.walker()
    camera.fov = stage.fov
    return Program(scene, camera, *inside_the_box.walk_of(script, stage.walk, stage.still))


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
