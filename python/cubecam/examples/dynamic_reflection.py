"""P14: dynamic reflection (document 000, Ex12-2).

A ball replaces the cube of P13, there is no ceiling, and the figures circle the ball. A camera in the
middle of the ball draws the cubemap for each frame, and the ball mirrors it: 0.78 times the cubemap in
the direction R, plus 0.3 times the ball's own gold.

Look for: a figure that passes in front of the ball appears large in it; one that goes behind the ball
is pressed flat against the rim. Floor and sky bend round the ball, and the figures' shadows are there
as well.

Worth trying: ``build(document=True)`` makes the document's scene: a ground, a smaller ball and two
actors before a grey background. ``build(angles=(20, 5))`` turns the view by the document's angleX and
angleY in degrees. ``build(probe_size=16)``: reflections need few texels. P15 shows when the cubemap
need not be drawn again, P16 shares one cubemap between several balls, and P17 refracts instead of
reflecting.

What is garbled in the document: as in P13, its ground has the translation (-1, -2, 4), which is used
here, and a scale of two numbers; here the ground is 10 x 10. The document prints no orbit; here the
actors circle the +Y axis at radius 2.5, a tenth of a radian a frame.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import DepthFormat, Format

from . import _stage
from ._common import GREY, LIGHT, Photographs, Picture, bunny, on_circle, picture, teapot
from ._live import Clock, live_view, visitor
from ._script import Script
from .cubemap_on_a_cube import (
    BUNNY,
    DEPTH,
    EYE,
    FAR,
    FOV,
    GROUND,
    GROUND_COLOR,
    NEAR,
    PROBE,
    QUAD,
    TEAPOT,
    phong,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P14"
TITLE = "Dynamic reflection: a ball mirrors the figures that circle it"
FRAMES = 63  # one round: 2 pi in tenths of a radian
STILL = 10
SIZE = (512, 512)  # aspect 1

BALL, SCALE = 1.0, 0.5  # radius of sphere.obj, and its scale at the origin
GOLD = (0.95, 0.85, 0.4)
ENV_WEIGHT, COLOR_WEIGHT = 0.78, 0.3
RADIUS, HEIGHT = 2.5, -0.5  # of the circle round +Y, world units
TURN = 0.1  # radians a frame


@dataclass(frozen=True)
class Circle:
    """The circle round +Y on which the actors' origins move."""

    radius: float  # world units
    height: float
    heading: float = 0.0  # degrees by which each actor is turned, beside its turn with the circle
    start: float = 0.0  # radians at which the first actor starts


@dataclass
class Stage:
    """What the document's scene and the staged one differ in; P15 and P17 share it."""

    scene: cc.Scene
    actors: tuple[cc.Node, ...]
    circle: Circle
    camera: cc.PerspectiveCamera
    scale: float  # of the ball
    still: int
    texels: int  # along an edge of a face
    near: float  # of the camera that draws the faces
    samples: int
    depth: DepthFormat

    def probe(
        self,
        size: int | None,
        texel_format: Format,
        position: tuple[float, float, float] = (0, 0, 0),
    ) -> cc.Probe:
        """Make a probe; size None is the stage's own."""
        return cc.Probe(
            position=position,
            size=self.texels if size is None else size,
            near=self.near,
            far=FAR,
            format=texel_format,
            samples=self.samples,
            depth_format=self.depth,
        )


@dataclass
class Program:
    """`actors` move on `circle`; `ball` shows `probe`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ball: cc.Node
    actors: tuple[cc.Node, ...]
    circle: Circle
    probe: cc.Probe
    still: int


def build(
    probe_size: int | None = None,
    probe_format: Format = "rgba8",
    images: Photographs | None = None,
    *,
    angles: tuple[float, float] = (0.0, 0.0),
    script: Script = (),
    document: bool = False,
) -> Program:
    """Make the scene; the probe's texels are of 8 bits as in the document. The parameters are those of P13."""
    made = stage(images, document=document)
    ball = made.scene.add(cc.Mesh.sphere(BALL), gold(), scale=made.scale)
    ball.environment = probe = made.probe(probe_size, probe_format)
    visitor(made.camera, angles, script, SIZE[1])
    return Program(made.scene, made.camera, ball, made.actors, made.circle, probe, made.still)


def stage(images: Photographs | None = None, *, document: bool = False) -> Stage:
    """Make the parts that do not reflect: light, ground, actors and the main camera."""
    if not document:
        return carousel(images)
    _stage.no_photographs(images)
    return document_stage()


def document_stage() -> Stage:
    """Make the document's scene: lamp, ground and two actors, and nothing but grey round them."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    scene.add(cc.Mesh.plane(QUAD, QUAD), phong(GROUND_COLOR), position=GROUND)
    actors = scene.add(bunny(), phong(BUNNY[1])), scene.add(teapot(), phong(TEAPOT[1]))
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    return Stage(scene, actors, Circle(RADIUS, HEIGHT), camera, SCALE, 12, PROBE, NEAR, 1, DEPTH)


#: Kind, size and colour of the figures of the staged scene; each has another colour than its neighbours.
FIGURES: tuple[_stage.Figure, ...] = (
    ("bunny", 1.85, _stage.GREEN),
    ("teapot", 2.5, _stage.BLUE),
    ("bunny", 1.85, _stage.YELLOW),
    ("teapot", 2.5, _stage.RED),
)


def carousel(
    images: Photographs | None = None,
    circle: Circle = Circle(1.6, -0.9, 90.0),
    figures: tuple[_stage.Figure, ...] = FIGURES,
    shadows: bool = True,
    turn: float = 0.0,
) -> Stage:
    """Make the staged scene: figures on the quay, so near to the ball that it shows them large."""
    scene = _stage.quay(images, shadows, turn)
    _stage.lay_floor(scene, circle.height)
    actors = tuple(
        scene.add(_stage.figure(kind, size), _stage.glaze(color)) for kind, size, color in figures
    )
    camera = cc.PerspectiveCamera(
        fov=38, position=(0, 3.9, 5.7), target=(0, -0.1, 0.25), near=0.1, far=FAR
    )
    return Stage(scene, actors, circle, camera, 0.9, STILL, PROBE, 0.1, 4, "depth_component32f")


def gold() -> cc.MirrorMaterial:
    """Make the material 0.78 * environment + 0.3 * colour."""
    return cc.MirrorMaterial(color=GOLD, env_weight=ENV_WEIGHT, color_weight=COLOR_WEIGHT)


def go_along(actor: cc.Node, circle: Circle, radians: float) -> None:
    """Place an actor on the circle round +Y, and turn it by the same angle."""
    place = circle.start + radians
    actor.position = on_circle(circle.radius, circle.height, place)
    actor.rotation = cc.axis_angle((0, 1, 0), math.degrees(place) + circle.heading)


def go_round(actors: tuple[cc.Node, ...], circle: Circle, frame: float) -> None:
    """Place the actors, equally far from each other; they move by a tenth of a radian a frame."""
    for index, actor in enumerate(actors):
        go_along(actor, circle, TURN * frame + index * 2 * math.pi / len(actors))


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the actors, equally far from each other, move by a tenth of a radian a frame."""
    go_round(program.actors, program.circle, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    probe_size: int | None = None,
    renderer: cc.Renderer | None = None,
    images: Photographs | None = None,
    *,
    angles: tuple[float, float] = (0.0, 0.0),
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: the actors circle, a drag turns the view, w and s walk. Angles and script come first."""
    program = build(probe_size, images=images, document=document)
    clock = Clock(lambda frame, _: go_round(program.actors, program.circle, frame))
    controls = visitor(program.camera, angles, script, SIZE[1])
    return live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)
