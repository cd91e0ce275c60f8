"""P1: a cube textured by a cubemap (document 001, Ex10-1).

Six photographs become one cubemap, and every point of a cube shows the colour that lies in the
direction of its own position, as seen from the cube's middle: ``textureCube(u_envCubeMap,
a_Position)``. The direction is taken in object space, before the model matrix, so the pictures turn
with the cube.

Look for: each side shows one whole photograph, and what passes from one side to the next, such as the
fence, goes on without a seam. The photographs appear mirrored: they were taken from inside the cube and
are seen from outside.

Worth trying: stand in the middle with ``build(eye=(0, 0, 0.001))``, an exercise of the document.
``build(angles=(120, -30))`` starts with other angles of the document's mouse, angleX round Y and angleY
round X. The document filters by LINEAR alone, so a far side, whose 512 texels share few pixels, flickers
as it turns; the staged cubemap has mipmaps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import GREY, Photographs, Picture, picture, surroundings
from ._live import Drags, live_view
from ._script import Event, Script, events

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


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    sample: str  # the photographs
    mipmaps: bool
    eye: tuple[float, float, float]  # world units; the document prints none; it looks at the origin
    angles: tuple[float, float]  # degrees of angleX and angleY in frame 0
    turn: tuple[float, float]  # degrees a frame, in place of a mouse


DOCUMENT = Stage("sunset.exr", False, (0.0, 0.0, 7.0), (30.0, 30.0), (3.0, 3.0))
STAGED = Stage("forest.exr", True, (0.0, 0.0, 7.0), (-52.0, 24.0), (3.0, 0.0))


@dataclass
class Program:
    """`tilt` turns round X and carries `cube`, which turns round Y.

    `angles` (angleX, angleY) are those of frame 0; in each frame `turn` is added, or the next drag of a `script`.
    """

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    tilt: cc.Node
    cube: cc.Node
    angles: tuple[float, float]
    turn: tuple[float, float]
    script: tuple[Event, ...]
    frames: int
    still: int


def build(
    images: Photographs | None = None,
    eye: tuple[float, float, float] | None = None,
    angles: tuple[float, float] | None = None,
    script: Script | None = None,
    *,
    document: bool = False,
) -> Program:
    """Make the scene.

    images : six arrays or paths in the order +X -X +Y -Y +Z -Z, uploaded as they are; made here by default. eye : place
    of the camera. angles : angleX and angleY at the start, degrees. script : drags such as "drag 30 10", in pixels of a
    picture 512 pixels high; without, the cube turns by itself.
    """
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=GREY)
    cubemap = surroundings(images, stage.sample, mipmaps=stage.mipmaps)
    # WebGL draws back faces by default, so the walls are visible from inside the cube.
    material = cc.BasicMaterial(cubemap=cubemap, double_sided=True)
    tilt = scene.add()
    cube = scene.add(cc.Mesh.box(CUBE), material, scale=SCALE, parent=tilt)
    camera = cc.PerspectiveCamera(
        fov=FOV, position=eye or stage.eye, target=(0, 0, 0), near=NEAR, far=FAR
    )
    drags = () if script is None else events(script, SIZE[1])
    program = Program(
        scene, camera, tilt, cube, angles or stage.angles, stage.turn, drags, FRAMES, STILL
    )
    if script is not None:
        program.frames, program.still = len(drags) + 1, len(drags)
        mouse(program).play(drags)  # keys are an error now, not in the middle of an animation
    return program


def mouse(program: Program) -> Drags:
    """Return the document's mouse, which adds up drags from the program's angles on."""
    return Drags(lambda x, y: turn(program, x, y), start=program.angles)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the model matrix is Rx(angleY) Ry(angleX) scale(2), as the document writes it."""
    angle_x, angle_y = program.angles
    if program.script:
        turn(program, angle_x, angle_y)
        mouse(program).play(program.script[: max(frame, 0)])
    else:
        turn(program, angle_x + program.turn[0] * frame, angle_y + program.turn[1] * frame)
    return picture(renderer, program.scene, program.camera, size, options)


def turn(program: Program, angle_x: float, angle_y: float) -> None:
    """Turn the cube: angle_x degrees round Y, then angle_y degrees round X."""
    program.tilt.rotation = cc.axis_angle((1, 0, 0), angle_y)
    program.cube.rotation = cc.axis_angle((0, 1, 0), angle_x)


def live(
    images: Photographs | None = None,
    renderer: cc.Renderer | None = None,
    *,
    eye: tuple[float, float, float] | None = None,
    angles: tuple[float, float] | None = None,
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag turns the cube, and the line below the picture tells both angles."""
    program = build(images, eye, angles, document=document)
    drags = mouse(program)
    viewer = live_view(program, SIZE, TITLE, renderer, controls=drags)

    def turn_and_tell(angle_x: float, angle_y: float) -> None:
        turn(program, angle_x, angle_y)
        viewer.text = f"angleX {angle_x:.0f}°, angleY {angle_y:.0f}°"

    drags.turn = turn_and_tell
    turn_and_tell(*program.angles)
    drags.play(events(script, SIZE[1]))
    return viewer
