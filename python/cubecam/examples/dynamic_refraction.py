"""P17: dynamic refraction (document 000, "try and think").

The scheme of P14 can also refract: the cubemap is looked up in the direction of Snell's law, with eta =
1 / 1.52 for air to glass. Two balls stand side by side, the left one of glass, the right one the mirror
of P14. Each has a cubemap of its own, and the figures circle both.

Look for: the glass shows the scene behind it upside down, and the mirror shows the scene in front of
it. Both follow the figures.

Worth trying: ``build(fresnel=True)``: the glass also reflects, most of all at its rim.
``build(eta=1 / 1.33)`` is water. ``build(document=True)`` puts both balls into the scene of P14's
document, where the glass shows little but grey: its ground is before the balls, and behind them is
nothing. Only the front surface refracts here; light that leaves a real ball is refracted a second time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import Format

from . import _stage
from ._common import Photographs, Picture, picture
from ._live import Clock, live_view, visitor
from ._script import Script
from .dynamic_reflection import (
    BALL,
    Circle,
    carousel,
    go_round,
    gold,
    stage,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P17"
TITLE = "Dynamic refraction: a glass ball beside a mirror"
FRAMES = 63  # one round: 2 pi in tenths of a radian
STILL = 5
SIZE = (512, 512)  # aspect 1

ETA = 1 / 1.52  # air to glass
BOTTLE = (0.9, 0.97, 0.94)  # tint of the staged glass
TURNED = 30.0  # degrees, so that the sun of the photographs is behind the balls
APART = 0.7  # world units from the middle to each ball's centre


@dataclass
class Program:
    """`actors` circle; `glass` and `mirror` show a probe each."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    glass: cc.Node
    mirror: cc.Node
    actors: tuple[cc.Node, ...]
    circle: Circle
    still: int
    probes: tuple[cc.Probe, cc.Probe]


#: Kind, size and colour of the figures of the staged scene.
FIGURES: tuple[_stage.Figure, ...] = (
    ("bunny", 1.6, _stage.GREEN),
    ("teapot", 2.1, _stage.BLUE),
    ("bunny", 1.6, _stage.YELLOW),
    ("teapot", 2.1, _stage.RED),
)


def build(
    eta: float = ETA,
    fresnel: bool = False,
    probe_size: int | None = None,
    probe_format: Format = "rgba8",
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Program:
    """Make the scene; eta is the refractive index outside divided by that inside. The others are those of P14."""
    if document:
        made, apart = stage(images, document=True), APART
        made.still = 12
    else:
        made, apart = carousel(images, Circle(2.3, -1.5, 90.0), FIGURES, turn=TURNED), 1.05
        made.camera.position, made.camera.target = (0, 2.2, 8.3), (0, -0.45, 0)
        made.still = STILL
        for x in (-apart, apart):
            pedestal = cc.Mesh.cylinder(0.55, 0.6)
            made.scene.add(pedestal, _stage.stone(), position=(x, -1.2, 0))
    ball = cc.Mesh.sphere(BALL)
    tint = (1, 1, 1) if document else BOTTLE
    materials = cc.GlassMaterial(ior=1 / eta, fresnel=fresnel, tint=tint), gold()
    # The balls do not show each other, so that no mirror shows a mirror.
    glass, mirror = (
        made.scene.add(ball, material, position=(x, 0, 0), scale=made.scale, in_captures=False)
        for x, material in zip((-apart, apart), materials, strict=True)
    )
    probes = []
    for node in (glass, mirror):
        node.environment = made.probe(probe_size, probe_format, tuple(node.position))
        probes.append(node.environment)
    visitor(made.camera, (0, 0), script, SIZE[1])
    return Program(
        made.scene,
        made.camera,
        glass,
        mirror,
        made.actors,
        made.circle,
        made.still,
        (probes[0], probes[1]),
    )


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the actors move by a tenth of a radian a frame."""
    go_round(program.actors, program.circle, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    eta: float = ETA,
    fresnel: bool = False,
    probe_size: int | None = None,
    renderer: cc.Renderer | None = None,
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: the figures circle, a drag turns the view, w and s walk. The script comes first."""
    program = build(eta, fresnel, probe_size, images=images, document=document)
    clock = Clock(lambda frame, _: go_round(program.actors, program.circle, frame))
    controls = visitor(program.camera, (0, 0), script, SIZE[1])
    return live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)
