"""P10: render to a texture (document 004, section 7.4.2).

A flat picture with moving discs is drawn into a texture of 512 x 512, without a depth buffer, and a
turning cube shows that texture. The texture has a scene and a camera of its own;
`cubecam.RenderTexture` draws it whenever it changes, before the pictures that show it.

Look for: the flat picture on the left is the texture itself. Each side of the cube shows the same discs, in the
same frame: never those of the last one. The discs are translucent and drawn in the order in which they
were added, red first and yellow last.

Worth trying: draw the cube's own scene into the texture. A picture cannot show itself, so this raises
an error that names the texture, until the texture leaves the cube out (``exclude=[cube]``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import LIGHT, Picture, picture
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P10"
TITLE = "Render to a texture: the picture on the left is on every side of the cube"
FRAMES = 120  # one turn
STILL = 20
SIZE = (768, 512)

TEXTURE = (512, 512)  # pixels
WHITE, BLACK = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
TURN = 3.0  # degrees a frame
#: Colour and radius of each disc, and its number of rounds in one turn of the cube.
DISCS = (
    ((0.9, 0.1, 0.1), 0.45, 1),
    ((0.1, 0.6, 0.2), 0.35, -2),
    ((0.1, 0.3, 0.9), 0.3, 3),
    ((0.9, 0.7, 0.1), 0.25, -4),
)


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    background: tuple[float, float, float, float]
    ka: float
    light: tuple[float, float, float]
    cube: tuple[float, float, float]  # where the cube stands
    flat: (
        tuple[float, float, float] | None
    )  # where the texture stands as a flat picture; None: nowhere
    eye: tuple[float, float, float]
    size: tuple[int, int]  # of the picture, pixels


DOCUMENT = Stage(BLACK, 0.4, LIGHT, (0, 0, 0), None, (0, 1.5, 4), (512, 512))
STAGED = Stage(
    (0.1, 0.1, 0.12, 1.0), 0.4, (0.5, 3.5, 6), (1.1, 0, 0), (-1.35, 0, -0.2), (0, 1.1, 4.2), SIZE
)


@dataclass
class Program:
    """`discs` move in the texture's scene, `cube` in the main one."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    cube: cc.Node
    inner: cc.Scene
    inner_camera: cc.OrthographicCamera
    discs: tuple[cc.Node, ...]
    texture: cc.RenderTexture
    size: tuple[int, int]


def build(*, document: bool = False) -> Program:
    """Make both scenes; in the inner one a unit is half the texture's edge."""
    inner = cc.Scene(background=WHITE)
    upright = cc.axis_angle((1, 0, 0), 90)
    discs = []
    for color, radius, _ in DISCS:
        discs.append(
            inner.add(
                # A disc is a flat cylinder, seen from above.
                cc.Mesh.cylinder(radius, 0.01),
                cc.BasicMaterial(color=color, opacity=0.6),
                rotation=upright,
            )
        )
    inner_camera = cc.OrthographicCamera(height=2, position=(0, 0, 1), near=0.5, far=2)
    texture = cc.RenderTexture(inner, inner_camera, size=TEXTURE, depth_format=None, name="discs")
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=stage.background)
    scene.add(cc.PointLight(position=stage.light))
    cube = scene.add(
        cc.Mesh.box(1.6),
        cc.PhongMaterial(color=(1, 1, 1), ka=stage.ka, map=texture),
        position=stage.cube,
    )
    if stage.flat is not None:
        scene.add(
            cc.Mesh.plane(1.8, 1.8),
            cc.BasicMaterial(map=texture),
            position=stage.flat,
            rotation=upright,
        )
    camera = cc.PerspectiveCamera(fov=45, position=stage.eye, target=(0, 0, 0))
    return Program(scene, camera, cube, inner, inner_camera, tuple(discs), texture, stage.size)


def place(program: Program, frame: float) -> None:
    """Place the discs and turn the cube."""
    for node, (_, radius, rounds) in zip(program.discs, DISCS, strict=True):
        angle = rounds * 2 * math.pi * frame / FRAMES
        away = 0.95 - radius
        node.position = (away * math.cos(angle), away * math.sin(angle), 0)
    program.cube.rotation = cc.axis_angle((0.3, 1, 0.2), TURN * frame)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame with the discs and the cube at their places."""
    place(program, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(renderer: cc.Renderer | None = None, *, document: bool = False) -> Viewer:
    """Show the program live: a drag moves the camera."""
    program = build(document=document)
    return live_view(
        program,
        program.size,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: place(program, frame)),
    )
