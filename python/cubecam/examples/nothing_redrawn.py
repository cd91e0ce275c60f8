"""P15: nothing is drawn again while nothing changes (document 000, "try and think").

Drawing six faces for every frame is expensive, and not necessary if most objects stand still. The scene
is that of P14, with two figures. For ten frames nothing moves, for ten frames the bunny walks, then
nothing moves again, and so on. The renderer keeps each picture together with a key of everything that
it depends on, and draws a picture again only if the key changes.

Look for: the counter below the picture. Each column is a frame, each lit square a picture that was
drawn for it: blue the main view, orange a face of the ball's cubemap. In frame 0 the lamp is switched
on, and all seven are drawn. While nothing moves, none is drawn. While the bunny walks, the main view is
drawn and the faces that show the bunny or its shadow, not all six.

Worth trying: ``cubecam.Renderer(cache_bytes=0)`` keeps no frames, but still keeps the probe: the main
view is drawn for every frame. Or set the colour of a figure to its present colour: an equal value is no
change. ``build(document=True)`` is the scene of P14's document; its pictures have no counter, which
`views_drawn` returns.
"""

from __future__ import annotations

import weakref
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

import cubecam as cc
from cubecam.typing import Format
from cubecam.viewer.lettering import Lettering

from . import _stage, dynamic_reflection
from ._common import Photographs, Picture, picture
from ._live import Clock, live_view, visitor
from ._script import Script
from .dynamic_reflection import BALL, TURN, Circle, carousel, go_along, go_round, gold

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P15"
TITLE = "No picture is drawn again while nothing in it changes"
PHASE = 10  # frames of rest, then as many of movement
FRAMES = 4 * PHASE
STILL = 34
SIZE = (512, 512)  # aspect 1

MOST = 7  # the main view and six faces
STRIP = 0.2  # of the picture's height, for the counter
#: Colours of the counter: its ground, frames to come, a picture that was not drawn, the main view, a face.
NIGHT, LATER, OFF, MAIN, FACE = (
    (24, 28, 36),
    (33, 38, 47),
    (64, 71, 84),
    (90, 160, 255),
    (255, 170, 60),
)


@dataclass
class Program:
    """`walker` moves in some frames; the rest is the scene of P14. `counts` holds the views drawn for each frame."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ball: cc.Node
    walker: cc.Node
    circle: Circle
    probe: cc.Probe
    still: int
    counted: bool  # whether the pictures have a counter
    counts: dict[int, int] = field(default_factory=dict)
    counter: weakref.ref[cc.Renderer] | None = None  # whose counts these are


def build(
    probe_size: int | None = None,
    probe_format: Format = "rgba8",
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Program:
    """Make P14's scene, actors in their places of frame 0. The parameters are those of P14."""
    if document:
        made = dynamic_reflection.stage(images, document=True)
        made.still = 15
    else:
        # The bunny's way leads past the front of the ball.
        figures = ("bunny", 1.6, _stage.GREEN), ("teapot", 2.1, _stage.RED)
        circle = Circle(2.2, -0.9, 90.0, start=-2.5)
        # The lamp's shadows lie in one map for the whole scene: a change of it would change all pictures.
        made = carousel(images, circle, figures, shadows=False)
        made.still = STILL
        made.camera.position, made.camera.target = (0, 4.2, 6.6), (0, -0.3, 0.4)
        for actor in made.actors:
            _stage.shade(made.scene, actor, 1.0)
    ball = made.scene.add(cc.Mesh.sphere(BALL), gold(), scale=made.scale)
    if not document:
        _stage.shade(made.scene, made.scene.add(position=(0, made.circle.height, 0)), 1.1)
    ball.environment = probe = made.probe(probe_size, probe_format)
    go_round(made.actors, made.circle, 0)
    visitor(made.camera, (0, 0), script, SIZE[1])
    return Program(
        made.scene,
        made.camera,
        ball,
        made.actors[0],
        made.circle,
        probe,
        made.still,
        counted=not document,
    )


def steps(frame: int) -> int:
    """Return the number of steps of the walker: none in a phase of rest, one a frame in the next phase."""
    phases, within = divmod(max(frame, 0), PHASE)
    return PHASE * (phases // 2) + (within + 1 if phases % 2 else 0)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    counter: bool = True,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; `views_drawn` then returns how many pictures it took.

    counter : whether the counter is below the staged scene. It counts what changed since the frame before, in whatever
    order the frames are drawn.
    """
    if not (counter and program.counted):
        return _draw(program, renderer, frame, size, options)
    strip = max(1, round(STRIP * size[1]))
    view = (size[0], max(1, size[1] - strip))
    _count(program, renderer, frame - 1, (16, 16), {})
    _forget(program, renderer, frame, view, options)
    shown = _draw(program, renderer, frame, view, options)
    program.counts[frame] = views_drawn(program, renderer)
    below = _strip(program.counts, frame, (size[0], strip))
    if shown.dtype != np.uint8:
        below = (below / 255).astype(shown.dtype)
    return np.concatenate([shown, below])


def _draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int],
    options: RenderOptions,
) -> Picture:
    walk(program, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def walk(program: Program, frame: float) -> None:
    """Put the walker where it is in a frame."""
    go_along(program.walker, program.circle, TURN * steps(int(frame)))


def _forget(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int],
    options: RenderOptions,
) -> None:
    """Let the renderer know the frame before and nothing else; before frame 0 the lamp is off."""
    lamp = program.scene.lights[0]
    lit = lamp.intensity
    if frame <= 0:
        lamp.intensity = 0
    _draw(program, renderer, frame - 1, size, options)
    lamp.intensity = lit


def _count(
    program: Program,
    renderer: cc.Renderer,
    last: int,
    size: tuple[int, int],
    options: RenderOptions,
) -> None:
    """Count the views of all frames up to the last, those that are not counted yet, on a small picture."""
    if program.counter is None or program.counter() is not renderer:
        program.counts, program.counter = {}, weakref.ref(renderer)
    for frame in range(last + 1):
        if frame not in program.counts:
            _forget(program, renderer, frame, size, options)
            _draw(program, renderer, frame, size, options)
            program.counts[frame] = views_drawn(program, renderer)


def _strip(counts: dict[int, int], frame: int, size: tuple[int, int]) -> Picture:
    """Draw the counter, opaque (H, W, 4) uint8: a line of text, and a column of squares for each frame until now."""
    width, height = size
    ground = np.full((height, width, 3), NIGHT, np.uint8)
    lettering = Lettering(ground, (255, 255, 255), NIGHT, unit=max(8, 0.2 * height))
    margin = max(1, round(0.08 * height))
    top = margin
    count = counts[frame]
    text = (
        f"frame {frame}: {count} of {MOST} pictures drawn"
        if count
        else f"frame {frame}: none drawn"
    )
    if lettering.width(text) < width - 2 * margin:
        lettering.write(text, (margin, margin), plain=True)
        top = round(margin + 1.35 * lettering.unit)
    strip = np.concatenate([lettering.picture, np.full((height, width, 1), 255, np.uint8)], axis=2)
    cells = np.empty((MOST, FRAMES, 3), np.uint8)
    cells[:] = OFF
    first = FRAMES * (frame // FRAMES)
    for index in range(first, frame + 1):
        for row in range(counts[index]):
            cells[MOST - 1 - row, index - first] = MAIN if row == 0 else FACE
    cells[:, frame - first + 1 :] = LATER
    chart = strip[top : height - margin, margin : width - margin, :3]
    if chart.size:
        rows, row_gap = _cells(chart.shape[0], MOST)
        columns, column_gap = _cells(chart.shape[1], FRAMES)
        chart[:] = cells[rows[:, None], columns[None, :]]
        chart[row_gap[:, None] | column_gap[None, :]] = NIGHT
    return strip


def _cells(pixels: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the cell of each pixel, and which pixels are gaps between cells, where there is room for gaps."""
    cell = np.arange(pixels) * count // pixels
    gap = np.zeros(pixels, bool)
    if pixels >= 4 * count:
        gap[1:] = cell[1:] != cell[:-1]
    return cell, gap


def live(
    probe_size: int | None = None,
    renderer: cc.Renderer | None = None,
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
) -> Viewer:
    """Show the program live: the bunny walks and rests, a drag turns the view, w and s walk.

    The line below the picture tells how many views the last picture took.
    """
    program = build(probe_size, images=images, document=document)
    clock = Clock(lambda frame, _: walk(program, frame))
    controls = visitor(program.camera, (0, 0), script, SIZE[1])
    viewer = live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)

    def walk_and_tell(frame: float, step: float) -> None:
        viewer.text = f"views drawn: {viewer.renderer.stats.views_drawn}"
        walk(program, frame)

    clock.place = walk_and_tell
    return viewer


def views_drawn(program: Program, renderer: cc.Renderer) -> int:
    """Return how many pictures the last frame took, from 0 to 7: the main view and six faces of the probe."""
    return renderer.stats.views_drawn
