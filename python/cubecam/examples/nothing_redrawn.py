"""P15: nothing is drawn again while nothing changes (document 000, "try and think").

Drawing six faces for every frame is expensive, and not necessary if most objects stand still. The
scene is that of P14. For ten frames nothing moves, for ten frames the bunny walks, then nothing moves
again, and so on. The renderer keeps each picture together with a key of everything that it depends on,
and draws a picture again only if the key changes.

Look for: `views_drawn` after each frame. It is 0 while nothing moves. While the bunny moves, it counts
the main view and the faces of the probe that show the bunny, not all six.

Worth trying: ``cubecam.Renderer(cache_bytes=0)`` keeps no frames, but still keeps the probe. Or set the
colour of an actor to its present colour: an equal value is no change.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc
from cubecam.typing import Format

from . import dynamic_reflection
from ._common import Picture, picture
from ._live import Clock, Visitor, live_view
from .cubemap_on_a_cube import PROBE
from .dynamic_reflection import TURN, circle, go_round

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P15"
TITLE = "No picture is drawn again while nothing in it changes"
PHASE = 10  # frames of rest, then as many of movement
FRAMES = 4 * PHASE
STILL = 15
SIZE = (512, 512)  # aspect 1


@dataclass
class Program:
    """`walker` moves in some frames; the rest is the scene of P14."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ball: cc.Node
    walker: cc.Node
    probe: cc.Probe


def build(
    probe_size: int = PROBE, probe_format: Format = "rgba8", *, document: bool = False
) -> Program:
    """Make P14's scene, actors in their places of frame 0."""
    made = dynamic_reflection.build(probe_size, probe_format, document=document)
    go_round(made.actors, 0)
    return Program(made.scene, made.camera, made.ball, made.actors[0], made.probe)


def steps(frame: int) -> int:
    """Return the number of steps of the walker: none in a phase of rest, one a frame in the next phase."""
    phases, within = divmod(max(frame, 0), PHASE)
    return PHASE * (phases // 2) + (within + 1 if phases % 2 else 0)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; `views_drawn` then returns how many pictures it took."""
    circle(program.walker, TURN * steps(frame))
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    probe_size: int = PROBE, renderer: cc.Renderer | None = None, *, document: bool = False
) -> Viewer:
    """Show the program live: the bunny walks and rests, a drag turns the view, w and s walk.

    The line below the picture tells how many views the last picture took.
    """
    program = build(probe_size, document=document)

    def walk(frame: float, _: float) -> None:
        circle(program.walker, TURN * steps(int(frame)))

    clock = Clock(walk)
    controls = Visitor(program.camera)
    viewer = live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)

    def walk_and_tell(frame: float, step: float) -> None:
        viewer.text = f"views drawn: {viewer.renderer.stats.views_drawn}"
        walk(frame, step)

    clock.place = walk_and_tell
    return viewer


def views_drawn(program: Program, renderer: cc.Renderer) -> int:
    """Return how many pictures the last frame took, from 0 to 7: the main view and six faces of the probe."""
    return renderer.stats.views_drawn
