"""P2: standing inside the box (document 001, Ex10-2).

The cube of P1 stands still, and the camera in its middle turns and walks: a drag of the mouse turns
the view, "w" and "s" take a step of 0.1 along the view. Two angles sum up the drags; the view direction
is Rx(angleY) Ry(angleX) (0, 0, 1), both turns about the world's axes. `SCRIPT` replaces mouse and
keyboard: frame k shows the view after k of its events.

Look for: the walls come nearer as the camera walks, parts of them disappear in front of the near
plane, and in the end the camera stands outside. The document asks how to avoid this; P3 is the answer.

Worth trying: turn by 90 degrees and then drag up and down: nothing happens, because the second turn is
about the world's X axis, along which the camera looks. `camera.yaw` and `camera.pitch` turn like a
person's head.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import GREY, Photographs, Picture, picture, surroundings
from ._live import STEP, Visitor, direction, live_view, look

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
FIRST = (0.0, 0.0, 1.0)  # view direction before any drag

#: "w", "s", or a drag (angleX, angleY) in degrees.
Event = str | tuple[float, float]
SCRIPT: tuple[Event, ...] = (
    *[(6.0, 0.0)] * 15,
    *[(0.0, 3.0)] * 8,
    *["w"] * 6,
    *[(4.0, -4.0)] * 12,
    *["s"] * 12,
    *[(-4.0, 2.0)] * 12,
    *["w"] * 30,
)
FRAMES = len(SCRIPT) + 1
STILL = 35


@dataclass
class Program:
    """`camera` moves."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    script: tuple[Event, ...]


def build(images: Photographs | None = None, script: Sequence[Event] = SCRIPT) -> Program:
    """Make the scene; see `SCRIPT` for what a script holds, and P1 for the images."""
    scene = cc.Scene(background=GREY)
    material = cc.BasicMaterial(cubemap=surroundings(images), double_sided=True)
    scene.add(cc.Mesh.box(CUBE), material, scale=SCALE)
    return Program(scene, walker(), tuple(script))


def walker() -> cc.PerspectiveCamera:
    """Make the camera in the middle, looking along (0, 0, 1)."""
    return cc.PerspectiveCamera(fov=FOV, position=(0, 0, 0), target=FIRST, near=NEAR, far=FAR)


def replay(camera: cc.PerspectiveCamera, events: Sequence[Event]) -> None:
    """Put the camera at its start, and replay the events."""
    camera.target = None
    camera.position = (0, 0, 0)
    camera.look(FIRST)
    angle_x = angle_y = 0.0
    for event in events:
        if event in ("w", "s"):
            camera.walk(STEP if event == "w" else -STEP)
        elif isinstance(event, str):
            raise ValueError(f'script: expected "w", "s" or a drag of two angles, got {event!r}')
        else:
            angle_x, angle_y = angle_x + event[0], angle_y + event[1]
            look(camera, direction(angle_x, angle_y))


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


def live(images: Photographs | None = None, renderer: cc.Renderer | None = None) -> Viewer:
    """Show the program live: a drag turns the view, w and s walk."""
    program = build(images)
    return live_view(program, SIZE, TITLE, renderer, controls=Visitor(program.camera))
