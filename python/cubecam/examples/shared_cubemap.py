"""P16: one cubemap for neighbouring mirrors (document 000, "try and think").

Three mirror balls stand in a row. A cubemap for each ball costs three times as much as one cubemap
that all balls share. Any number of nodes may use one Probe, so this program compares both: in the upper
picture all three balls show the probe of the middle ball; in the lower picture each has its own. The
balls move apart and together again.

Look for: the outer balls of the upper picture show the view of the middle ball, so the actors and the
edges of the ground lie in wrong places; the error grows with the distance of the balls.
``draw(..., show="difference")`` shows the difference of the two pictures.

How large is the error? `truth` casts rays from the real surfaces of the balls, and
`error_over_distance` compares. A ball's own probe is wrong, too, because rays start on the ball and not
in its middle; but its error is smaller, and does not depend on the distance. Document 004 says: the
approximation looks right as long as other objects are not too close. Both functions need embreex:
``pip install "cubecam[truth]"``.

Worth trying: give the scene a skybox, and hide the ground and the actors, ``node.visible = False``. The
sky is infinitely far, so one cubemap is right for all balls, and there is no error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.typing import Format

from ._common import GREY, LIGHT, Picture, bunny, picture, teapot
from ._live import Clock, Visitor, live_view
from ._truth import Truth, mirror_image
from .cubemap_on_a_cube import (
    BUNNY,
    FAR,
    GROUND,
    GROUND_COLOR,
    NEAR,
    PROBE,
    QUAD,
    TEAPOT,
    phong,
)
from .dynamic_reflection import BALL, gold

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P16"
TITLE = "One cubemap shared by neighbouring mirrors, and its error"
FRAMES = 60
STILL = 30
SIZE = (512, 512)  # two pictures of 2:1, one above the other

FOV, EYE = 45.0, (0.0, 0.9, 3.2)  # degrees, world units
SCALE = 0.3  # of the balls of radius 1
NEAREST, FARTHEST = 0.65, 2.0  # world units from the middle ball's centre to its neighbours'
#: Where the actors stand: the bunny behind the balls, the teapot before them and below the picture, so that
#: only the balls show it. Both are farther than the cube camera's near plane.
PLACES = ((-0.9, -0.5, -2.0), (0.7, -1.2, 1.9))

Whose = Literal["shared", "own"]


@dataclass
class Program:
    """`balls` are the left, the middle and the right one; `probes` are theirs, should each have its own."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ground: cc.Node
    balls: tuple[cc.Node, ...]
    probes: tuple[cc.Probe, ...]


@dataclass
class Errors:
    """Mean absolute errors of the neighbours' pixels, of colours from 0 to 1: arrays to plot over `distance`."""

    distance: npt.NDArray[np.float64]
    shared: npt.NDArray[np.float64]
    own: npt.NDArray[np.float64]


def build(
    probe_size: int = PROBE, probe_format: Format = "rgba8", *, document: bool = False
) -> Program:
    """Make the scene: P14's ground and actors, the latter standing still, and three balls in a row."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    ground = scene.add(cc.Mesh.plane(QUAD, QUAD), phong(GROUND_COLOR), position=GROUND)
    scene.add(bunny(), phong(BUNNY[1]), position=PLACES[0])
    scene.add(teapot(), phong(TEAPOT[1]), position=PLACES[1])
    mesh, mirror = cc.Mesh.sphere(BALL), gold()
    # No cubemap shows a ball, so the cubemaps differ only in the place from which they are drawn.
    balls = tuple(scene.add(mesh, mirror, scale=SCALE, in_captures=False) for _ in range(3))
    probes = tuple(
        cc.Probe(size=probe_size, near=NEAR, far=FAR, format=probe_format, parent=ball)
        for ball in balls
    )
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    program = Program(scene, camera, ground, balls, probes)
    place(program, NEAREST)
    share(program, "shared")
    return program


def place(program: Program, distance: float) -> None:
    """Put the neighbours at a distance from the middle ball, centre to centre, world units."""
    for ball, x in zip(program.balls, (-distance, 0.0, distance), strict=True):
        ball.position = (x, 0, 0)


def share(program: Program, whose: Whose) -> None:
    """Let all balls show the middle one's probe ("shared"), or each its own ("own")."""
    if whose not in ("shared", "own"):
        raise ValueError(f'whose: expected "shared" or "own", got {whose!r}')
    for ball, own in zip(program.balls, program.probes, strict=True):
        ball.environment = program.probes[1] if whose == "shared" else own


def distance(frame: float) -> float:
    """Give the neighbours' distance in a frame: from `NEAREST` to `FARTHEST` and back."""
    return NEAREST + (FARTHEST - NEAREST) * (1 - math.cos(2 * math.pi * frame / FRAMES)) / 2


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    show: Literal["both", "difference", "error"] = "both",
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame of two pictures, one above the other.

    show : "both": with the shared probe, and below with a probe for each. "difference": the first of these, and
    below how far it is from the second. "error": how far each is from `truth`, which needs embreex.
    """
    if show not in ("both", "difference", "error"):
        raise ValueError(f'show: expected "both", "difference" or "error", got {show!r}')
    half = (size[0], max(size[1] // 2, 1))
    place(program, distance(frame))
    shared, own = (_draw(program, renderer, whose, half, options) for whose in ("shared", "own"))
    if show == "difference":
        own = _apart(own, shared)
    if show == "error":
        exact, _ = truth(program, half)
        shared, own = _apart(shared, exact), _apart(own, exact)
    return np.concatenate([shared, own])


def live(
    probe_size: int = PROBE, renderer: cc.Renderer | None = None, *, document: bool = False
) -> Viewer:
    """Show the program live: the balls move apart, and p gives each a probe of its own or one to all.

    A drag turns the view, w and s walk. The picture is the upper one of `draw`, and after p the lower one.
    """
    program = build(probe_size, document=document)
    order: list[Whose] = ["own", "shared"]

    def exchange() -> None:
        share(program, order[0])
        order.reverse()

    return live_view(
        program,
        (SIZE[0], SIZE[1] // 2),
        TITLE,
        renderer,
        controls=Visitor(program.camera),
        clock=Clock(lambda frame, _: place(program, distance(frame))),
        keys={"p": (exchange, "one probe for all, or one each")},
    )


def truth(program: Program, size: tuple[int, int]) -> Truth:
    """Cast the exact picture: one bounce off the balls' actual surface, Phong-shaded where it ends.

    Returns colours (H, W, 4) float32 and node ids (H, W). Raises ImportError without embreex.
    """
    return mirror_image(program.scene, program.camera, size)


def error_over_distance(
    program: Program,
    renderer: cc.Renderer,
    distances: Sequence[float] = (0.65, 1.0, 1.35, 1.7, 2.0),
    size: tuple[int, int] = (512, 256),
) -> Errors:
    """Measure how far the neighbours' mirror images are from `truth`, with the shared probe and with their own.

    Pixels on the balls' rims, where both pictures have edges, do not count. Raises ImportError without embreex.
    """
    errors: dict[Whose, list[float]] = {"shared": [], "own": []}
    neighbours = [program.balls[0].id, program.balls[2].id]
    for apart in distances:
        place(program, apart)
        exact, ids = truth(program, size)
        inside = np.isin(_eroded(ids), neighbours)
        for whose, found in errors.items():
            got = _draw(program, renderer, whose, size, {"format": "rgba32f"})
            off = got[inside, :3].astype(np.float64) - exact[inside, :3]
            found.append(float(np.abs(off).mean()))
    return Errors(np.array(distances, float), np.array(errors["shared"]), np.array(errors["own"]))


def _draw(
    program: Program,
    renderer: cc.Renderer,
    whose: Whose,
    size: tuple[int, int],
    options: RenderOptions,
) -> Picture:
    share(program, whose)
    return picture(renderer, program.scene, program.camera, size, options)


def _apart(got: Picture, wanted: Picture) -> Picture:
    """Give the absolute difference of colours, opaque, in the first picture's type."""
    scale = 255.0 if got.dtype == np.uint8 else 1.0
    other = wanted / (255.0 if wanted.dtype == np.uint8 else 1.0)
    apart = np.abs(got / scale - np.clip(other, 0, 1 if scale > 1 else None))
    apart[..., 3] = 1
    return np.asarray(np.rint(apart * 255) if scale > 1 else apart).astype(got.dtype)


def _eroded(ids: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Give 0 wherever a neighbouring pixel holds another id."""
    padded = np.pad(ids, 1, mode="edge")
    height, width = ids.shape
    same = np.ones(ids.shape, bool)
    for row in range(3):
        for column in range(3):
            same &= padded[row : row + height, column : column + width] == ids
    return np.where(same, ids, 0)
