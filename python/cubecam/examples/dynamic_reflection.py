"""P14: dynamic reflection (document 000, Ex12-2).

A ball at the origin replaces the cube of P13. It mirrors the cubemap that the camera in its middle
draws: 0.78 times the cubemap in the direction R, plus 0.3 times the ball's own gold. There is no
ceiling, and the two actors circle the ball.

Look for: an actor that passes in front of the ball appears large in it; an actor that goes behind the
ball moves to the rim and disappears.

Worth trying: ``build(probe_size=16)``: reflections need few texels. P15 shows when the cubemap need not
be drawn again, P16 shares one cubemap between several balls, and P17 refracts instead of reflecting.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import Format

from ._common import GREY, LIGHT, Picture, bunny, on_circle, picture, teapot
from ._live import Clock, Visitor, live_view
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
TITLE = "Dynamic reflection: a ball mirrors the actors that circle it"
FRAMES = 63  # one round: 2 pi in tenths of a radian
STILL = 12
SIZE = (512, 512)  # aspect 1

BALL, SCALE = 1.0, 0.5  # radius of sphere.obj, and its scale at the origin
GOLD = (0.95, 0.85, 0.4)
ENV_WEIGHT, COLOR_WEIGHT = 0.78, 0.3
RADIUS, HEIGHT = 2.5, -0.5  # of the circle round +Y, world units
TURN = 0.1  # radians a frame


@dataclass
class Program:
    """`actors` circle; `ball` shows `probe`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ball: cc.Node
    actors: tuple[cc.Node, cc.Node]
    probe: cc.Probe


def build(
    probe_size: int = PROBE, probe_format: Format = "rgba8", *, document: bool = False
) -> Program:
    """Make the scene; the probe's texels are of 8 bits as in the document."""
    scene, actors = stage()
    ball = scene.add(cc.Mesh.sphere(BALL), gold(), scale=SCALE)
    probe = cc.Probe(
        position=(0, 0, 0),
        size=probe_size,
        near=NEAR,
        far=FAR,
        format=probe_format,
        depth_format=DEPTH,
    )
    ball.environment = probe
    return Program(scene, main_camera(), ball, actors, probe)


def stage() -> tuple[cc.Scene, tuple[cc.Node, cc.Node]]:
    """Make the parts that do not reflect: lamp, ground and the two actors."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    scene.add(cc.Mesh.plane(QUAD, QUAD), phong(GROUND_COLOR), position=GROUND)
    actors = scene.add(bunny(), phong(BUNNY[1])), scene.add(teapot(), phong(TEAPOT[1]))
    return scene, actors


def gold() -> cc.MirrorMaterial:
    """Make the material 0.78 * environment + 0.3 * colour."""
    return cc.MirrorMaterial(color=GOLD, env_weight=ENV_WEIGHT, color_weight=COLOR_WEIGHT)


def main_camera() -> cc.PerspectiveCamera:
    """Make the main view: 70 degrees, near 1, far 100, from (0, 1, 5) to the origin."""
    return cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)


def circle(actor: cc.Node, radians: float) -> None:
    """Place an actor on the circle round +Y, and turn it by the same angle."""
    actor.position = on_circle(RADIUS, HEIGHT, radians)
    actor.rotation = cc.axis_angle((0, 1, 0), math.degrees(radians))


def go_round(actors: tuple[cc.Node, cc.Node], frame: float) -> None:
    """Place the actors, opposite each other; they move by a tenth of a radian a frame."""
    for index, actor in enumerate(actors):
        circle(actor, TURN * frame + index * math.pi)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the actors, opposite each other, move by a tenth of a radian a frame."""
    go_round(program.actors, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    probe_size: int = PROBE, renderer: cc.Renderer | None = None, *, document: bool = False
) -> Viewer:
    """Show the program live: the actors circle, a drag turns the view, w and s walk."""
    program = build(probe_size, document=document)
    clock = Clock(lambda frame, _: go_round(program.actors, frame))
    return live_view(program, SIZE, TITLE, renderer, controls=Visitor(program.camera), clock=clock)
