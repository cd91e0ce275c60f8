"""P12: a cube camera (document 004, section 7.4.4).

A ball, or a teapot, mirrors the skybox and the coloured cubes that move between the two. So the
skybox cannot serve as its cubemap. A camera in the middle of the ball draws the cubemap again when the
cubes move: six views along the axes, 90 degrees each, without the ball. In cubecam that camera is a
Probe: assigned to the ball, it is kept up to date.

Look for: the cubes are seen twice, themselves and in the ball. The large purple cube passes behind the viewer, and is
then seen in the ball alone. The teapot (``build(reflector="teapot")``) shows the cubes but never its own spout,
since the probe leaves the whole teapot out.

Worth trying: ``renderer.read_probe(program.probe)`` returns the cubemap of the probe;
``cubecam.plot.layout(cube)`` draws it as the document's figure does. The document finds by experiment that each
picture must be scaled by (-1, -1, 1); document 000 gets the same result from its up vectors. Both follow from the
face table of docs/conventions.md: a face is stored as seen from outside, with row 0 at t = 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import cubecam as cc
from cubecam.typing import DepthFormat, Format

from ._common import LIGHT, Photographs, Picture, on_circle, picture, surroundings, teapot
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P12"
TITLE = "Cube camera: a mirror for a skybox and for moving cubes in front of it"
FRAMES = 120  # one round of the cubes
STILL = 0
SIZE = (512, 512)

PROBE = 512  # texels along an edge of a face
NEAR, FAR = 1.0, 100.0  # of the cube camera, world units
Vector: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Box:
    """A cube: what it looks like, its path round +Y, and where it starts."""

    color: Vector
    edge: float  # world units
    radius: float  # of its path
    height: float
    start: float  # degrees


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    boxes: tuple[Box, ...]
    ka: float
    kd: float
    ks: float
    light: Vector
    eye: Vector
    fov: float  # degrees
    depth: DepthFormat  # of the cube camera's framebuffer


DOCUMENT = Stage(
    (
        Box((1.0, 0.2, 0.2), 1.4, 5.0, 0.6, 0.0),
        Box((0.2, 0.9, 0.3), 1.0, 4.0, -1.2, 70.0),
        Box((0.3, 0.4, 1.0), 1.8, 6.5, 1.8, 130.0),
        Box((1.0, 0.9, 0.2), 1.1, 4.5, -0.2, 190.0),
        Box((0.9, 0.3, 0.9), 1.6, 6.0, -1.8, 250.0),
        Box((0.2, 0.9, 0.9), 0.9, 3.6, 1.2, 310.0),
    ),
    ka=0.4,
    kd=0.7,
    ks=1,
    light=LIGHT,
    eye=(0, 2, 12),
    fov=50,
    depth="depth_component16",
)

#: A large ball before the houses of the photograph, small cubes close to it, and a large one that passes behind the
#: eye.
STAGED = Stage(
    (
        Box((0.9, 0.15, 0.15), 1.0, 2.9, 0.9, 200.0),
        Box((0.1, 0.75, 0.2), 0.8, 2.5, -0.9, 62.0),
        Box((0.2, 0.35, 0.95), 0.9, 3.3, 0.4, 300.0),
        Box((0.95, 0.8, 0.1), 0.9, 3.0, -0.5, 10.0),
        Box((0.85, 0.2, 0.8), 3.0, 8.0, 2.4, 75.0),
        Box((0.1, 0.8, 0.8), 0.7, 2.4, 1.5, 120.0),
    ),
    ka=0.4,
    kd=0.5,
    ks=0.2,
    light=(-3, 5, -6),
    eye=(0, 0.8, -5.4),
    fov=66,
    depth="depth_component32f",
)


@dataclass
class Program:
    """`cubes` move; `reflector` shows `probe`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    reflector: cc.Node
    cubes: tuple[cc.Node, ...]
    probe: cc.Probe
    stage: Stage


def build(
    images: Photographs | None = None,
    reflector: Literal["sphere", "teapot"] = "sphere",
    probe_size: int = PROBE,
    probe_format: Format = "rgba8",
    *,
    document: bool = False,
) -> Program:
    """Make the scene; images as in P1, the probe's texels of 8 bits as in the document."""
    if reflector not in ("sphere", "teapot"):
        raise ValueError(f'reflector: expected "sphere" or "teapot", got {reflector!r}')
    scene = cc.Scene(environment=surroundings(images))
    stage = DOCUMENT if document else STAGED
    scene.add(cc.PointLight(position=stage.light))
    cubes = tuple(
        scene.add(
            cc.Mesh.box(box.edge),
            cc.PhongMaterial(color=box.color, ka=stage.ka, kd=stage.kd, ks=stage.ks),
        )
        for box in stage.boxes
    )
    mirror = scene.add(shape(reflector), cc.MirrorMaterial())
    probe = cc.Probe(
        position=(0, 0, 0),
        size=probe_size,
        near=NEAR,
        far=FAR,
        format=probe_format,
        depth_format=stage.depth,
    )
    mirror.environment = probe
    camera = cc.PerspectiveCamera(
        fov=stage.fov, position=stage.eye, target=(0, 0, 0), near=NEAR, far=FAR
    )
    return Program(scene, camera, mirror, cubes, probe, stage)


def shape(reflector: Literal["sphere", "teapot"]) -> cc.Mesh:
    """Return the mesh of a reflector."""
    return cc.Mesh.sphere(1.5) if reflector == "sphere" else teapot(4)


def place(program: Program, frame: float) -> None:
    """Place the cubes of a frame: they spin on circles round +Y, every second one backwards."""
    for index, (node, box) in enumerate(zip(program.cubes, program.stage.boxes, strict=True)):
        turn = 360 * frame / FRAMES * (1 if index % 2 == 0 else -1)
        node.position = on_circle(box.radius, box.height, math.radians(box.start + turn))
        node.rotation = cc.axis_angle((1, index + 1, 2), 2 * turn)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; the probe is brought up to date with it."""
    place(program, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    images: Photographs | None = None,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag moves the camera round the reflector, and t changes ball and teapot."""
    program = build(images, document=document)
    place(program, 0)
    shapes = [shape("teapot"), shape("sphere")]

    def exchange() -> None:
        program.reflector.mesh = shapes[0]
        shapes.reverse()

    return live_view(
        program,
        SIZE,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: place(program, frame)),
        keys={"t": (exchange, "ball or teapot")},
    )
