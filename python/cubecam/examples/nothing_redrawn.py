"""P15: nothing is drawn again while nothing changes (document 000, "try and think").

Drawing six faces for every frame is costly; must it be, if most things stand still? The scene is
P14's. For ten frames nothing moves, for ten the bunny walks, for ten all is still again, and so on.
The renderer keeps what it drew with a note of all that went into it, and draws again only what
would come out different.

Look for: `views_drawn` after each frame: 0 while all is still. While the bunny moves it is the main
view and those faces of the probe that see it, not all six.

Worth trying: ``cubecam.Renderer(cache_bytes=0)`` keeps no frames; the probe it keeps all the same.
Or set the colour of an actor to the colour it has: equal is no change.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cubecam as cc

from . import dynamic_reflection
from ._common import Picture, picture
from .cubemap_on_a_cube import PROBE
from .dynamic_reflection import TURN, circle, go_round

PROGRAM = "P15"
TITLE = "Nothing is drawn again while nothing it sees has changed"
PHASE = 10  # frames of rest, then as many of movement
FRAMES = 4 * PHASE
STILL = 15
SIZE = (512, 512)  # aspect 1


@dataclass
class Program:
    """`walker` is the one that moves at times; all else is P14's."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ball: cc.Node
    walker: cc.Node
    probe: cc.Probe


def build(probe_size: int = PROBE, probe_format: str = "rgba8") -> Program:
    """Make P14's scene, actors in their places of frame 0."""
    made = dynamic_reflection.build(probe_size, probe_format)
    go_round(made.actors, 0)
    return Program(made.scene, made.camera, made.ball, made.actors[0], made.probe)


def steps(frame: int) -> int:
    """Give how many steps the walker has made: none in a phase of rest, one a frame in the next."""
    phases, within = divmod(max(frame, 0), PHASE)
    return PHASE * (phases // 2) + (within + 1 if phases % 2 else 0)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Any,
) -> Picture:
    """Draw a frame; then `views_drawn` tells what that took."""
    circle(program.walker, TURN * steps(frame))
    return picture(renderer, program.scene, program.camera, size, options)


def views_drawn(program: Program, renderer: cc.Renderer) -> int:
    """Give how many pictures the last frame took: 0 to 7, the main view and six faces of the probe."""
    return renderer.stats.views_drawn
