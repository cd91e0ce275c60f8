"""P2: standing inside the box (document 001, Ex10-2).

The cube of P1 stands still, and the camera in its middle turns and walks: a drag of the mouse turns
the view, "w" and "s" take a step of 0.1 along the view. Two angles sum up the drags; the view direction
is Rx(angleY) Ry(angleX) (0, 0, 1), both turns about the world's axes. `SCRIPT` replaces mouse and
keyboard: frame k shows the view after k of its events.

Look for: in the middle the six photographs look like the place where they were taken. From elsewhere they
bend at the edges of the box, where thin white lines stand, which the document does not have. The walls
come nearer as the camera walks, parts of them disappear in front of the near plane, and in the end the
camera stands outside. The document asks how to avoid this; P3 is the answer.

Worth trying: turn by 90 degrees and then drag up and down: nothing happens, because the second turn is
about the world's X axis, along which the camera looks. `camera.yaw` and `camera.pitch` turn like a
person's head.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import GREY, Photographs, Picture, picture, surroundings
from ._live import Visitor, live_view
from ._script import Event, Script, events

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P2"
TITLE = "Inside the box: drags turn the view, w and s walk"
SIZE = (512, 512)  # aspect 1

FOV, NEAR, FAR = 60.0, 1.0, 15.0  # degrees, world units
CUBE = 2.0  # cube.obj of the course has its corners at -1 and 1
SCALE = 2.0
LINE = 0.02  # width of the lines at the edges, world units
FIRST = (0.0, 0.0, 1.0)  # view direction before any drag

#: A walk through the document's scene, as numbers of its two angles.
SCRIPT: tuple[Event, ...] = (
    *[(6.0, 0.0)] * 15,
    *[(0.0, 3.0)] * 8,
    *["w"] * 6,
    *[(4.0, -4.0)] * 12,
    *["s"] * 12,
    *[(-4.0, 2.0)] * 12,
    *["w"] * 30,
)
#: The walk of the staged scene: to the fence, back into a corner, where the box shows, on until it is all seen.
WALK = "drag 160 0; w 8; s 34; drag -96 0; drag 96 0; s 50"
FRAMES = 115
STILL = 52


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    sample: str  # the photographs
    mipmaps: bool
    edges: bool  # whether white lines stand at the edges of the box
    walk: tuple[Event, ...]
    still: int  # the best frame of the walk


DOCUMENT = Stage("sunset.exr", False, False, SCRIPT, 35)
STAGED = Stage("forest.exr", True, True, events(WALK, SIZE[1]), STILL)


@dataclass
class Program:
    """`camera` moves; `frames` and `still` follow from the script."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    script: tuple[Event, ...]
    frames: int
    still: int


def build(
    images: Photographs | None = None, script: Script | None = None, *, document: bool = False
) -> Program:
    """Make the scene.

    images : as in P1. script : events like those of `SCRIPT`, or a text such as "drag 30 10; w 5", in pixels of a
    picture 512 pixels high; a walk by default.
    """
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=GREY)
    cubemap = surroundings(images, stage.sample, mipmaps=stage.mipmaps)
    material = cc.BasicMaterial(cubemap=cubemap, double_sided=True)
    scene.add(cc.Mesh.box(CUBE), material, scale=SCALE)
    if stage.edges:
        _mark_edges(scene)
    return Program(scene, walker(), *walk_of(script, stage.walk, stage.still))


def _mark_edges(scene: cc.Scene) -> None:
    """Add white bars along the twelve edges."""
    half, white = CUBE * SCALE / 2, cc.BasicMaterial(color=(1, 1, 1))
    ends = ((-half, -half), (-half, half), (half, -half), (half, half))
    for axis in range(3):
        size = [LINE, LINE, LINE]
        size[axis] = CUBE * SCALE
        bar = cc.Mesh.box((size[0], size[1], size[2]))
        for place in ends:
            middle = [*place]
            middle.insert(axis, 0.0)
            scene.add(bar, white, position=(middle[0], middle[1], middle[2]))


def walk_of(
    script: Script | None, own: tuple[Event, ...], still: int
) -> tuple[tuple[Event, ...], int, int]:
    """Return the events of a script or the program's own, the number of frames, and the best of these.

    That is `still` for the program's own events, and the last frame for a script.
    """
    walk = own if script is None else events(script, SIZE[1])
    return walk, len(walk) + 1, still if script is None else len(walk)


def walker() -> cc.PerspectiveCamera:
    """Make the camera in the middle, looking along (0, 0, 1)."""
    return cc.PerspectiveCamera(fov=FOV, position=(0, 0, 0), target=FIRST, near=NEAR, far=FAR)


def replay(camera: cc.PerspectiveCamera, script: Script) -> None:
    """Put the camera at its start, and replay the events."""
    camera.target = None
    camera.position = (0, 0, 0)
    camera.look(FIRST)
    Visitor(camera).play(script)


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
    renderer: cc.Renderer | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag turns the view, w and s walk. The script comes first."""
    program = build(images, document=document)
    return live_view(program, SIZE, TITLE, renderer, controls=visitor(program.camera, script))


def visitor(camera: cc.PerspectiveCamera, script: Script) -> Visitor:
    """Return mouse and keys, with a script played already."""
    controls = Visitor(camera)
    controls.play(events(script, SIZE[1]))
    return controls
