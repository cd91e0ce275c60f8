"""P1: a cube textured by a cubemap (document 001, Ex10-1).

Six photographs become one cubemap, and every point of a cube shows the colour that lies in the
direction of its own position, as seen from the cube's middle: ``textureCube(u_envCubeMap,
a_Position)``. The direction is taken in object space, before the model matrix, so the pictures turn
with the cube.

Look for: each side shows one whole photograph, and the edges have no seams. The photographs appear
mirrored: they were taken from inside the cube and are seen from outside.

Worth trying: stand in the middle with ``build(eye=(0, 0, 0.001))``, an exercise of the document. Far
away, a face covers fewer pixels than its 512 texels, and with LINEAR filtering alone it flickers as it
turns: give the cubemap mipmaps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import GREY, Photographs, Picture, picture, surroundings
from ._live import Drags, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P1"
TITLE = "A cube textured by a cubemap of six photographs"
FRAMES = 120  # one turn
STILL = 0
SIZE = (512, 512)  # aspect 1

FOV, NEAR, FAR = 60.0, 1.0, 15.0  # degrees, world units
CUBE = 2.0  # cube.obj of the course has its corners at -1 and 1
SCALE = 2.0
EYE = (0.0, 0.0, 7.0)  # the document prints none; it looks at the origin
START, DRAG = 30.0, 3.0  # degrees, and degrees a frame, round both axes: in place of a mouse


@dataclass
class Program:
    """`tilt` turns round X and carries `cube`, which turns round Y."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    tilt: cc.Node
    cube: cc.Node


def build(
    images: Photographs | None = None,
    eye: tuple[float, float, float] = EYE,
    *,
    document: bool = False,
) -> Program:
    """Make the scene.

    images : six arrays or paths in the order +X -X +Y -Y +Z -Z, uploaded as they are; made here by default.
    """
    scene = cc.Scene(background=GREY)
    # WebGL draws back faces by default, so the walls are visible from inside the cube.
    material = cc.BasicMaterial(cubemap=surroundings(images), double_sided=True)
    tilt = scene.add()
    cube = scene.add(cc.Mesh.box(CUBE), material, scale=SCALE, parent=tilt)
    camera = cc.PerspectiveCamera(fov=FOV, position=eye, target=(0, 0, 0), near=NEAR, far=FAR)
    return Program(scene, camera, tilt, cube)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the model matrix is Rx(angleY) Ry(angleX) scale(2), as the document writes it."""
    angle_x = angle_y = START + DRAG * frame
    turn(program, angle_x, angle_y)
    return picture(renderer, program.scene, program.camera, size, options)


def turn(program: Program, angle_x: float, angle_y: float) -> None:
    """Turn the cube: angle_x degrees round Y, then angle_y degrees round X."""
    program.tilt.rotation = cc.axis_angle((1, 0, 0), angle_y)
    program.cube.rotation = cc.axis_angle((0, 1, 0), angle_x)


def live(
    images: Photographs | None = None,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag turns the cube."""
    program = build(images, document=document)
    turn(program, START, START)
    drags = Drags(lambda x, y: turn(program, x, y), start=(START, START))
    return live_view(program, SIZE, TITLE, renderer, controls=drags)
