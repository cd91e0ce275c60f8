"""P13: a cubemap drawn on the fly, shown on a cube (document 000, Ex12-1).

A camera at the origin draws the hall and its two actors into the six faces of a cubemap, 90 degrees
each, aspect 1. A cube above the middle shows the cubemap as the cube of P1 shows photographs: without
reflection, in the direction of the object-space position. It turns by 0.45 degrees a frame about
(1, 1, 1). A Probe as a material's cubemap serves as that camera, and leaves the cube out.

Look for: ground, ceiling and actors on the cube's sides, mirrored as in P1; they turn with the cube.

Worth trying: ``renderer.capture(program.scene, size=256, near=1, far=100, exclude=[program.cube])``
returns the six faces. The document computes their highlights for the position of the main camera; in
cubecam the eye of a capture is its own position, and ``capture(..., eye=(0, 1, 5))`` draws the
document's picture.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import DepthFormat, Format

from ._common import GREY, LIGHT, Picture, bunny, picture, teapot
from ._live import SCREEN, Clock, Visitor, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P13"
TITLE = "A cubemap drawn on the fly, shown on a turning cube"
FRAMES = 120
STILL = 100
SIZE = (512, 512)  # aspect 1

FOV, NEAR, FAR = 70.0, 1.0, 100.0  # main view: degrees, world units
EYE = (0.0, 1.0, 5.0)  # the document prints none; it looks at the origin
PROBE = 256  # texels along an edge of a face; 90 degrees, aspect 1, near 1, far 100
DEPTH: DepthFormat = "depth_component16"  # of the framebuffer that the faces are drawn in
CUBE = 2.0  # cube.obj of the course has its corners at -1 and 1
PLACE, SCALE = (0.0, 0.8, 0.0), 0.8
AXIS, TURN = (1.0, 1.0, 1.0), 0.45  # degrees a frame
#: The document prints no clear scale of the quads; here they are 10 x 10 and centred.
QUAD = 10.0
GROUND, GROUND_COLOR = (0.0, -2.0, 0.0), (0.4, 0.4, 1.0)
CEILING, CEILING_COLOR = (0.0, 3.0, 0.0), (0.4, 1.0, 1.0)
#: Place and colour of the meshes that replace sonic.obj and mario.obj.
BUNNY = ((-2.0, -0.5, 2.0), (0.4, 1.0, 0.4))
TEAPOT = ((2.5, -0.5, 1.5), (1.0, 0.4, 0.4))


@dataclass
class Program:
    """`cube` turns and shows `probe`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    cube: cc.Node
    probe: cc.Probe


def phong(color: tuple[float, float, float]) -> cc.PhongMaterial:
    """Make the document's material: Ka 0.2, Kd 0.7, Ks 1, shininess 10, highlights white."""
    return cc.PhongMaterial(color=color, ka=0.2, kd=0.7, ks=1.0, shininess=10.0)


def build(
    probe_size: int = PROBE, probe_format: Format = "rgba8", *, document: bool = False
) -> Program:
    """Make the scene; the probe's texels are of 8 bits as in the document."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    quad = cc.Mesh.plane(QUAD, QUAD)
    scene.add(quad, phong(GROUND_COLOR), position=GROUND)
    # The ceiling is turned over, so that its lit side is visible.
    scene.add(quad, phong(CEILING_COLOR), position=CEILING, rotation=cc.axis_angle((1, 0, 0), 180))
    scene.add(bunny(), phong(BUNNY[1]), position=BUNNY[0])
    scene.add(teapot(), phong(TEAPOT[1]), position=TEAPOT[0])
    probe = cc.Probe(
        position=(0, 0, 0),
        size=probe_size,
        near=NEAR,
        far=FAR,
        format=probe_format,
        depth_format=DEPTH,
    )
    cube = scene.add(
        cc.Mesh.box(CUBE), cc.BasicMaterial(cubemap=probe), position=PLACE, scale=SCALE
    )
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    return Program(scene, camera, cube, probe)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the cube's matrix is translate * scale * rotate(0.45 k, (1, 1, 1))."""
    turn(program, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def turn(program: Program, frame: float) -> None:
    """Turn the cube as in a frame."""
    # The scale is the same for all axes, so the node's own order, translate * rotate * scale, gives the same matrix.
    program.cube.rotation = cc.axis_angle(AXIS, TURN * frame)


def live(
    probe_size: int = PROBE, renderer: cc.Renderer | None = None, *, document: bool = False
) -> Viewer:
    """Show the program live: the cube turns, a drag turns the view, w and s walk."""
    program = build(probe_size, document=document)
    clock = Clock(lambda frame, _: turn(program, frame), rate=SCREEN)
    return live_view(program, SIZE, TITLE, renderer, controls=Visitor(program.camera), clock=clock)
