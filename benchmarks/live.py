"""What a frame of a live view costs while the user drags: CPU time of all threads, from the event to the JPEG.

The views are shown on canvases of rendercanvas that encode each picture as a page and a notebook do. All views take
turns, a frame each, and the figure is the median. What moves by itself goes on, as for a user: P14's actors circle, so
that faces of its probe are drawn again, and P12's cubes move.
"""

from __future__ import annotations

import math
import statistics
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import scene
from .results import Mark, Section

#: Side of the canvas in pixels: the limit of P14 in milliseconds.
LIMITS = {512: 30.0, 1024: 60.0}
FPS = 25.0
#: Frames before the first timed one: buffers are made, and the view chooses the size of its moving pictures.
WARM = 12
TRIANGLES = (1250, 40)  # of the knot: 2 * 1250 * 40 are 100,000


@dataclass
class _Times:
    """Milliseconds of each frame, as a whole and of its stages."""

    whole: list[float] = field(default_factory=list)
    jpeg: list[float] = field(default_factory=list)
    picture: list[float] = field(default_factory=list)
    render: list[float] = field(default_factory=list)

    def median(self, stage: str) -> float:
        return float(statistics.median(getattr(self, stage)))


def _knot(renderer: Any) -> Any:
    """A viewer of a mesh of 100,000 triangles."""
    import cubecam as cc

    arrays = scene.knot_mesh(3.0, *TRIANGLES)
    world = cc.Scene(background=scene.CLEAR)
    world.add(cc.PointLight(position=scene.LIGHT))
    mesh = cc.Mesh(arrays.positions, arrays.indices, normals=arrays.normals)
    world.add(mesh, cc.PhongMaterial(color=(0.4, 1.0, 0.4)))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 2, 4), target=(0, 0, 0))
    return cc.Viewer(world, camera, renderer=renderer)


def _example(name: str) -> Any:
    from cubecam import examples

    return lambda renderer: examples.load(name).live(renderer=renderer, document=True)  # type: ignore[attr-defined]


WORKS = {
    "P14": _example("P14"),
    "mesh of 100,000 triangles": _knot,
    "P12": _example("P12"),
}


class _Dragged:
    """A view on a canvas, whose user drags it."""

    def __init__(self, view: Any, side: int) -> None:
        from rendercanvas.core.encoders import encode_array
        from rendercanvas.offscreen import OffscreenRenderCanvas

        times = self.times = _Times()

        class Canvas(OffscreenRenderCanvas):  # type: ignore[misc] # rendercanvas has no types
            _quality = 80

            def _rc_present_bitmap(self, *, data: npt.NDArray[np.uint8], **_: Any) -> None:
                start = time.process_time()
                encode_array(np.asarray(data), self._quality)
                times.jpeg.append((time.process_time() - start) * 1e3)
                self.shape = data.shape

        self.view = view
        self.canvas = Canvas(size=(side, side))
        self.animation = view._animation
        view.animate(None)
        view._attach(self.canvas)
        self.side, self.x, self.moves = side, side / 2, 0
        self.send("pointer_down")

    def drag(self) -> None:
        """Move the pointer on: to and fro, so that the view stays near its first one."""
        self.moves += 1
        self.x = self.side * (0.5 + 0.15 * math.sin(0.37 * self.moves))
        self.send("pointer_move")

    def send(self, kind: str) -> None:
        pointer = {"button": 1, "buttons": (1,), "modifiers": (), "ntouches": 0, "touches": {}}
        self.canvas.submit_event({"event_type": kind, "x": self.x, "y": 100.0, **pointer})
        self.canvas._process_events()

    def frame(self, number: int) -> None:
        """Time a frame: the animation goes on, the pointer moves, the canvas draws and encodes."""
        start = time.process_time()
        if self.animation is not None:
            self.animation(number / FPS)
        self.drag()
        self.canvas.force_draw()
        self.times.whole.append((time.process_time() - start) * 1e3)

    def stages(self, number: int) -> None:
        """Time what the view does for such a picture, and what the renderer does for it, each on its own."""
        height, width = self.canvas.shape[:2]
        for part in ("picture", "render"):
            if self.animation is not None:
                self.animation(number / FPS + (0.3 if part == "render" else 0.0))
            self.drag()
            start = time.process_time()
            if part == "picture":
                self.view._picture((width, height), True)
            else:
                view = self.view
                np.asarray(
                    view.renderer.render(view.scene, view.camera, (width, height), samples=1).color
                )
            getattr(self.times, part).append((time.process_time() - start) * 1e3)


def run(quick: bool) -> list[Section]:
    """Measure all works at both sizes."""
    import cubecam as cc

    section = Section("live", "a frame of a live view while the user drags")
    frames = 15 if quick else 60
    with cc.Renderer() as renderer:
        views = {
            (work, side): _Dragged(make(renderer), side)
            for work, make in WORKS.items()
            for side in LIMITS
        }
        for number in range(WARM + frames):
            for dragged in views.values():
                if number == WARM:
                    dragged.times.whole.clear()
                    dragged.times.jpeg.clear()
                dragged.frame(number)
        for number in range(frames):
            for dragged in views.values():
                dragged.stages(number)
        for (work, side), dragged in views.items():
            times, (height, width) = dragged.times, dragged.canvas.shape[:2]
            section.marks.append(
                Mark(
                    f"{work}, {side} x {side}: drag, JPEG included",
                    times.median("whole"),
                    LIMITS[side] if work == "P14" else None,
                    "ms",
                    note=f"pictures of {width} x {height}",
                )
            )
            render, picture = times.median("render"), times.median("picture")
            section.notes.append(
                f"{work}, {side}: render and readback {render:.1f} ms, the view's picture with them {picture:.1f} ms, "
                f"JPEG {times.median('jpeg'):.1f} ms, largest frame {max(times.whole):.1f} ms"
            )
            dragged.view.close()
    return [section]
