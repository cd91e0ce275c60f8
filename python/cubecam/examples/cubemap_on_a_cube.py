"""P13: a cubemap drawn on the fly, shown on a cube (document 000, Ex12-1).

A camera at the origin draws the hall and the figures in it into the six faces of a cubemap, 90 degrees
each, aspect 1. A cube above the middle shows the cubemap as the cube of P1 shows photographs: without
reflection, in the direction of the object-space position. It turns by 0.45 degrees a frame about (1, 1,
1). A Probe as a material's cubemap serves as that camera, and leaves the cube out.

Look for: floor, ceiling, columns and figures on the cube's sides, mirrored as in P1; they turn with the
cube. The side that faces you shows what is behind you.

Worth trying: ``build(document=True)`` makes the document's scene: ground, ceiling and two actors before
a grey background. ``build(angles=(30, 10))`` turns the view by the document's angleX and angleY in
degrees, as drags of the mouse do.
``renderer.capture(program.scene, size=256, near=1, far=100, exclude=[program.cube])`` returns the six
faces. The document computes their highlights for the position of the main camera; in cubecam the eye of
a capture is its own position, and ``capture(..., eye=(0, 1, 5))`` draws the document's picture.

What is garbled in the document: the matrices of ground and ceiling are
``setTranslate(-1.0, -2.0, 4.0)`` and ``setTranslate(-1.0, 3.0, 4.0)``, which are used here, and for
both ``scale(0.8, 1.0)``, two numbers where three belong. Here both are 10 x 10 and horizontal, and the
ceiling shows its lit side downwards. The document prints no place of the lamp and of the main camera;
here they are (5, 5, 5) and (0, 1, 5).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import DepthFormat, Format

from . import _stage
from ._common import GREY, LIGHT, Photographs, Picture, bunny, picture, teapot
from ._live import SCREEN, Clock, live_view, visitor
from ._script import Script

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P13"
TITLE = "A cubemap drawn on the fly, shown on a turning cube"
FRAMES = 120
STILL = 70
SIZE = (512, 512)  # aspect 1

FOV, NEAR, FAR = 70.0, 1.0, 100.0  # main view: degrees, world units
EYE = (0.0, 1.0, 5.0)  # the document prints none; it looks at the origin
PROBE = 256  # texels along an edge of a face; 90 degrees, aspect 1, near 1, far 100
DEPTH: DepthFormat = "depth_component16"  # of the framebuffer that the faces are drawn in
CUBE = 2.0  # cube.obj of the course has its corners at -1 and 1
PLACE, SCALE = (0.0, 0.8, 0.0), 0.8
AXIS, TURN = (1.0, 1.0, 1.0), 0.45  # degrees a frame
#: The document prints no clear scale of the quads; here they are 10 x 10.
QUAD = 10.0
GROUND, GROUND_COLOR = (-1.0, -2.0, 4.0), (0.4, 0.4, 1.0)
CEILING, CEILING_COLOR = (-1.0, 3.0, 4.0), (0.4, 1.0, 1.0)
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
    still: int


@dataclass
class Hall:
    """What the document's scene and the staged one differ in."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    scale: float  # of the cube
    still: int
    texels: int  # along an edge of a face
    near: float  # of the camera that draws the faces
    samples: int
    depth: DepthFormat


def phong(color: tuple[float, float, float]) -> cc.PhongMaterial:
    """Make the document's material: Ka 0.2, Kd 0.7, Ks 1, shininess 10, highlights white."""
    return cc.PhongMaterial(color=color, ka=0.2, kd=0.7, ks=1.0, shininess=10.0)


def document_hall() -> Hall:
    """Make the document's scene: lamp, ground, ceiling, two actors, and nothing but grey round them."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    quad = cc.Mesh.plane(QUAD, QUAD)
    scene.add(quad, phong(GROUND_COLOR), position=GROUND)
    # The ceiling is turned over, so that its lit side is visible.
    scene.add(quad, phong(CEILING_COLOR), position=CEILING, rotation=cc.axis_angle((1, 0, 0), 180))
    scene.add(bunny(), phong(BUNNY[1]), position=BUNNY[0])
    scene.add(teapot(), phong(TEAPOT[1]), position=TEAPOT[0])
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    return Hall(scene, camera, SCALE, 100, PROBE, NEAR, 1, DEPTH)


def pavilion(images: Photographs | None = None) -> Hall:
    """Make the staged scene: a pavilion on the quay, with four figures on pedestals round the cube."""
    scene = _stage.quay(images)
    _stage.lay_floor(scene, -2, edge=10)
    panels = _stage.tiles(5, ((0.35, 0.78, 0.75), (0.3, 0.7, 0.7)), (0.12, _stage.STONE))
    scene.add(
        cc.Mesh.plane(QUAD, QUAD),
        _stage.stone(panels),
        position=(0, 3, 0),
        rotation=cc.axis_angle((1, 0, 0), 180),
        cast_shadow=False,
    )
    sandstone = _stage.stone()
    for x, z in ((-4.6, -4.6), (4.6, -4.6), (-4.6, 4.6), (4.6, 4.6)):
        scene.add(cc.Mesh.cylinder(0.28, 5), sandstone, position=(x, 0.5, z))
        for y in (-1.85, 2.85):
            scene.add(cc.Mesh.box((0.8, 0.3, 0.8)), sandstone, position=(x, y, z))
    for kind, size, color, (x, z), turn in (
        ("bunny", 1.9, _stage.GREEN, (-1.75, 2.3), 100),
        ("teapot", 2.3, _stage.RED, (2.6, 1.0), 200),
        ("bunny", 1.8, _stage.YELLOW, (2.8, -2.6), 30),
        ("teapot", 2.3, _stage.BLUE, (-3.3, -1.6), 0),
    ):
        scene.add(cc.Mesh.cylinder(0.95, 0.9), sandstone, position=(x, -1.55, z))
        scene.add(
            _stage.figure(kind, size),
            _stage.glaze(color),
            position=(x, -1.1, z),
            rotation=cc.axis_angle((0, 1, 0), turn),
        )
    camera = cc.PerspectiveCamera(
        fov=54, position=(1.0, 1.9, 6.6), target=(0, 0.1, 0), near=0.1, far=FAR
    )
    return Hall(scene, camera, 1.15, STILL, 512, 0.1, 4, "depth_component32f")


def build(
    probe_size: int | None = None,
    probe_format: Format = "rgba8",
    images: Photographs | None = None,
    *,
    angles: tuple[float, float] = (0.0, 0.0),
    script: Script = (),
    document: bool = False,
) -> Program:
    """Make the scene; the probe's texels are of 8 bits as in the document.

    probe_size : texels along an edge of a face; None is 256 as in the document, and 512 in the staged scene.
    images : as in P1; they surround the staged scene. angles : the document's angleX and angleY, degrees, by which the
    view is turned. script : drags and steps of the visitor before the first frame, such as "drag 30 10; w 5".
    """
    made = _made(images, document)
    probe = cc.Probe(
        position=(0, 0, 0),
        size=made.texels if probe_size is None else probe_size,
        near=made.near,
        far=FAR,
        format=probe_format,
        samples=made.samples,
        depth_format=made.depth,
    )
    # A shadow of the cube would be on the cube, too, and turning it would change the faces.
    cube = made.scene.add(
        cc.Mesh.box(CUBE),
        cc.BasicMaterial(cubemap=probe),
        position=PLACE,
        scale=made.scale,
        cast_shadow=False,
    )
    visitor(made.camera, angles, script, SIZE[1])
    return Program(made.scene, made.camera, cube, probe, made.still)


def _made(images: Photographs | None, document: bool) -> Hall:
    if not document:
        return pavilion(images)
    _stage.no_photographs(images)
    return document_hall()


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
    probe_size: int | None = None,
    renderer: cc.Renderer | None = None,
    images: Photographs | None = None,
    *,
    angles: tuple[float, float] = (0.0, 0.0),
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: the cube turns, a drag turns the view, w and s walk. Angles and script come first."""
    program = build(probe_size, images=images, document=document)
    clock = Clock(lambda frame, _: turn(program, frame), rate=SCREEN)
    controls = visitor(program.camera, angles, script, SIZE[1])
    return live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)
