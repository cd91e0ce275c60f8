"""P17: dynamic refraction (document 000, "try and think").

The scheme of P14 can also refract: the cubemap is looked up in the direction of Snell's law, with
eta = 1 / 1.52 for air to glass. Two balls stand side by side, the left one of glass, the right one the
mirror of P14. Each has a cubemap of its own, and the actors circle both.

Look for: the glass shows the scene behind it upside down, and the mirror shows the scene in front of
it. Both follow the actors.

Worth trying: ``build(fresnel=True)``: the glass also reflects, most of all at its rim. Only the front
surface refracts here; light that leaves a real ball is refracted a second time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import Format

from ._common import Picture, picture
from ._live import Clock, Visitor, live_view
from .cubemap_on_a_cube import FAR, NEAR, PROBE
from .dynamic_reflection import (
    BALL,
    SCALE,
    go_round,
    gold,
    main_camera,
    stage,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P17"
TITLE = "Dynamic refraction: a glass ball beside a mirror"
FRAMES = 63  # one round: 2 pi in tenths of a radian
STILL = 12
SIZE = (512, 512)  # aspect 1

ETA = 1 / 1.52  # air to glass
APART = 0.7  # world units from the middle to each ball's centre


@dataclass
class Program:
    """`actors` circle; `glass` and `mirror` show a probe each."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    glass: cc.Node
    mirror: cc.Node
    actors: tuple[cc.Node, cc.Node]
    probes: tuple[cc.Probe, cc.Probe]


def build(
    eta: float = ETA,
    fresnel: bool = False,
    probe_size: int = PROBE,
    probe_format: Format = "rgba8",
    *,
    document: bool = False,
) -> Program:
    """Make the scene; eta is the refractive index outside divided by that inside."""
    scene, actors = stage()
    ball = cc.Mesh.sphere(BALL)
    materials = cc.GlassMaterial(ior=1 / eta, fresnel=fresnel), gold()
    # The balls do not show each other, so that no mirror shows a mirror.
    glass, mirror = (
        scene.add(ball, material, position=(x, 0, 0), scale=SCALE, in_captures=False)
        for x, material in zip((-APART, APART), materials, strict=True)
    )
    probes = []
    for node in (glass, mirror):
        probe = cc.Probe(
            position=node.position, size=probe_size, near=NEAR, far=FAR, format=probe_format
        )
        node.environment = probe
        probes.append(probe)
    return Program(scene, main_camera(), glass, mirror, actors, (probes[0], probes[1]))


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the actors move by a tenth of a radian a frame."""
    go_round(program.actors, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    eta: float = ETA,
    fresnel: bool = False,
    probe_size: int = PROBE,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: the actors circle, a drag turns the view, w and s walk."""
    program = build(eta, fresnel, probe_size, document=document)
    clock = Clock(lambda frame, _: go_round(program.actors, frame))
    return live_view(program, SIZE, TITLE, renderer, controls=Visitor(program.camera), clock=clock)
