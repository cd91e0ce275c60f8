"""P16: one cubemap for neighbouring mirrors (document 000, "try and think").

Three mirror balls stand in a row. A cubemap for each ball costs three times as much as one cubemap that
all balls share. Any number of nodes may use one Probe, so this program compares both: in the upper
picture all three balls show the probe of the middle ball; the lower picture is how far it is from one
in which each ball has its own: twice the absolute difference of the colours. The balls move apart and
together again.

Look for: the outer balls of the upper picture show the view of the middle ball, so the figures and the
tiles of the floor lie in wrong places, and the lower picture is bright there. The middle ball is black,
since both pictures show it with its own probe; so is the sky in the balls, since it is infinitely far.
``draw(..., show="both")`` shows the picture with a probe for each below.

How large is the error? `truth` follows rays from the real surfaces of the balls, and
`error_over_distance` compares: the error of the shared cubemap grows with the distance of the balls. A
ball's own probe is wrong, too, because rays start on the ball and not in its middle; but its error is
smaller, and does not depend on the distance. Document 004 says: the approximation looks right as long
as other objects are not too close. Both functions need the extra `truth`,
``pip install "cubecam[truth]"``.

A probe may also know where things are: ``build(method=...)`` takes any ``parallax`` of `cubecam.Probe`. With
"layers" a ray is followed through what the middle ball's probe captured, and one cubemap for all is nearly as good as
one for each: the lower picture gets dark. "box" and "sphere" know the floor, but not the figures; "distance" does
not know what the figures hide from the middle ball. "none" is the classic picture. In the live form the key m goes
through the methods, and `correct` sets one. With ``document=True`` nothing is won: the balls show little but the
lamp's highlight on the ground, which lies elsewhere for each eye, and a probe has it where its own middle sees it.

Worth trying: ``build(document=True)`` has the ground, the actors and the grey background of P14's
document. Or hide floor and figures, ``node.visible = False``: only the sky is left, and there is no
error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.typing import DepthFormat, Format, Parallax

from . import _stage
from ._common import GREY, LIGHT, Photographs, Picture, bunny, picture, teapot
from ._labels import label
from ._live import Clock, live_view, visitor
from ._script import Script
from .cubemap_on_a_cube import (
    BUNNY,
    DEPTH,
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

    from cubecam.truth import TruthFrame
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
SITTING = 0.9  # radius of the staged balls, which lie on the floor
#: Where the document's actors stand: the bunny behind the balls, the teapot before them and below the picture, so that
#: only the balls show it. Both are farther than the cube camera's near plane.
PLACES = ((-0.9, -0.5, -2.0), (0.7, -1.2, 1.9))

#: The ways in which a ball's ray finds what it meets: "none", "box", "sphere", "distance" and "layers".
METHODS: tuple[Parallax, ...] = get_args(Parallax)

Box = tuple[tuple[float, float, float], tuple[float, float, float]]
Whose = Literal["shared", "own"]
Show = Literal["both", "difference", "error"]


@dataclass
class Row:
    """What the scene with the document's numbers and the staged one differ in."""

    scene: cc.Scene
    ground: cc.Node
    camera: cc.PerspectiveCamera
    scale: float  # of the balls
    nearest: float  # of the neighbours' distances
    farthest: float
    show: Show
    labels: bool
    gain: float  # of the difference
    texels: int  # along an edge of a face
    near: float  # of the cameras that draw the faces
    samples: int
    depth: DepthFormat
    box: Box  # the proxy: the floor, and nothing else that is near


@dataclass
class Program:
    """`balls` are the left, the middle and the right one; `probes` are theirs, should each have its own.

    `method` is the parallax of all probes, and `depth` their depth format where no ray is followed.
    """

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ground: cc.Node
    balls: tuple[cc.Node, ...]
    probes: tuple[cc.Probe, ...]
    nearest: float
    farthest: float
    show: Show
    labels: bool
    gain: float
    depth: DepthFormat
    method: Parallax = "none"


@dataclass
class Errors:
    """Mean absolute errors of the neighbours' pixels, of colours from 0 to 1: arrays to plot over `distance`."""

    distance: npt.NDArray[np.float64]
    shared: npt.NDArray[np.float64]
    own: npt.NDArray[np.float64]


def build(
    probe_size: int | None = None,
    probe_format: Format = "rgba8",
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
    method: Parallax = "none",
) -> Program:
    """Make the scene: a floor, figures that stand still, and three balls in a row.

    method : one of `METHODS`, the parallax of the probes. The other parameters are those of P14.
    """
    if document:
        _stage.no_photographs(images)
    made = document_row() if document else quay_row(images)
    mesh, mirror = cc.Mesh.sphere(BALL), gold()
    # No cubemap shows a ball, so the cubemaps differ only in the place from which they are drawn.
    balls = tuple(
        made.scene.add(mesh, mirror, scale=made.scale, in_captures=False) for _ in range(3)
    )
    probes = tuple(
        cc.Probe(
            size=made.texels if probe_size is None else probe_size,
            near=made.near,
            far=FAR,
            format=probe_format,
            samples=made.samples,
            depth_format=made.depth,
            parent=ball,
            box=made.box,
        )
        for ball in balls
    )
    visitor(made.camera, (0, 0), script, SIZE[1] // 2)
    program = Program(
        made.scene,
        made.camera,
        made.ground,
        balls,
        probes,
        made.nearest,
        made.farthest,
        made.show,
        made.labels,
        made.gain,
        made.depth,
    )
    place(program, made.nearest)
    share(program, "shared")
    correct(program, method)
    return program


def document_row() -> Row:
    """Make a scene of the document's parts: P14's lamp, ground and actors, and nothing but grey round them."""
    scene = cc.Scene(background=GREY)
    scene.add(cc.PointLight(position=LIGHT))
    ground = scene.add(cc.Mesh.plane(QUAD, QUAD), phong(GROUND_COLOR), position=GROUND)
    scene.add(bunny(), phong(BUNNY[1]), position=PLACES[0])
    scene.add(teapot(), phong(TEAPOT[1]), position=PLACES[1])
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    x, y, z = GROUND
    box = (x - QUAD / 2, y, z - QUAD / 2), (x + QUAD / 2, y + QUAD, z + QUAD / 2)
    return Row(
        scene,
        ground,
        camera,
        SCALE,
        NEAREST,
        FARTHEST,
        "both",
        False,
        1.0,
        PROBE,
        NEAR,
        1,
        DEPTH,
        box,
    )


def quay_row(images: Photographs | None = None) -> Row:
    """Make the staged scene: the balls on the quay, with figures before and behind them."""
    scene = _stage.quay(images)
    # With tiles of this size the neighbours' patterns differ from the middle ball's, all the way.
    edge = 40
    ground = _stage.lay_floor(scene, -SITTING, edge, tile=2)
    for kind, size, color, (x, z), turn in (
        ("bunny", 1.7, _stage.GREEN, (-1.3, -2.0), 20),
        ("teapot", 2.2, _stage.RED, (1.3, -2.0), 200),
        ("bunny", 1.3, _stage.YELLOW, (-1.2, 1.75), 200),
        ("teapot", 1.7, _stage.BLUE, (1.2, 1.75), 20),
    ):
        scene.add(
            _stage.figure(kind, size),
            _stage.glaze(color),
            position=(x, -SITTING, z),
            rotation=cc.axis_angle((0, 1, 0), turn),
        )
    camera = cc.PerspectiveCamera(
        fov=26, position=(0, 3.2, 7.6), target=(0, -0.1, 0.1), near=0.1, far=FAR
    )
    return Row(
        scene,
        ground,
        camera,
        SITTING,
        1.85,
        2.5,
        "difference",
        True,
        2.0,
        PROBE,
        0.1,
        4,
        "depth_component32f",
        ((-edge / 2, -SITTING, -edge / 2), (edge / 2, edge / 2, edge / 2)),
    )


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


def correct(program: Program, method: Parallax) -> None:
    """Let the balls' rays find what they meet by one of `METHODS`."""
    if method not in METHODS:
        raise ValueError(f"method: expected one of {', '.join(METHODS)}, got {method!r}")
    for probe in program.probes:
        # Rays are followed through depths of 32 bits; the document has 16.
        if method in ("distance", "layers"):
            probe.depth_format = "depth_component32f"
            probe.parallax = method
        else:
            probe.parallax = method
            probe.depth_format = program.depth
    program.method = method


def distance(program: Program, frame: float) -> float:
    """Give the neighbours' distance in a frame: from the nearest to the farthest and back."""
    way = program.farthest - program.nearest
    return program.nearest + way * (1 - math.cos(2 * math.pi * frame / FRAMES)) / 2


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    show: Show | None = None,
    labels: bool | None = None,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame of two pictures, one above the other.

    show : "both": with the shared probe, and below with a probe for each. "difference": the first of these, and
    below how far it is from the second, twice as bright in the staged scene. "error": how far each is from `truth`,
    which needs embreex. None: "difference" for the staged scene, "both" for the document's.
    labels : whether each picture has its name in a corner; None: for the staged scene.
    """
    show = program.show if show is None else show
    if show not in ("both", "difference", "error"):
        raise ValueError(f'show: expected "both", "difference" or "error", got {show!r}')
    half = (size[0], max(size[1] // 2, 1))
    place(program, distance(program, frame))
    shared, own = (_draw(program, renderer, whose, half, options) for whose in ("shared", "own"))
    names = "one cubemap for all three", "a cubemap for each"
    how = f', parallax "{program.method}"' if program.method != "none" else ""
    if show == "difference":
        own = _apart(own, shared, program.gain)
        times = f", times {program.gain:g}" if program.gain != 1 else ""
        names = names[0], f"difference from a cubemap for each{times}"
    if show == "error":
        exact = truth(program, half).color
        shared, own = (_apart(picture, exact, program.gain) for picture in (shared, own))
        names = "error of one cubemap for all three", "error of a cubemap for each"
    pair = np.concatenate([shared, own])
    if program.labels if labels is None else labels:
        pair = label(label(pair, names[0] + how, "top left"), names[1], "bottom left")
    return pair


def live(
    probe_size: int | None = None,
    renderer: cc.Renderer | None = None,
    images: Photographs | None = None,
    *,
    script: Script = (),
    document: bool = False,
    method: Parallax = "none",
) -> Viewer:
    """Show the program live: the balls move apart, and p gives each a probe of its own or one to all.

    A drag turns the view, w and s walk. The picture is the upper one of `draw`, and after p that with a probe for each.
    m goes to the next of `METHODS`, from "layers" to "none", and the view says which it is.
    """
    program = build(probe_size, images=images, document=document, method=method)
    order: list[Whose] = ["own", "shared"]

    def exchange() -> None:
        share(program, order[0])
        order.reverse()

    def next_method() -> None:
        correct(program, METHODS[(METHODS.index(program.method) + 1) % len(METHODS)])
        viewer.text = f"parallax: {program.method}"

    viewer = live_view(
        program,
        (SIZE[0], SIZE[1] // 2),
        TITLE,
        renderer,
        controls=visitor(program.camera, (0, 0), script, SIZE[1] // 2),
        clock=Clock(lambda frame, _: place(program, distance(program, frame))),
        keys={
            "p": (exchange, "one probe for all, or one each"),
            "m": (next_method, "the next method of parallax"),
        },
    )
    return viewer


def truth(program: Program, size: tuple[int, int]) -> TruthFrame:
    """Render the exact picture, with the output "id": rays leave the balls where these really are.

    There is one ray for each pixel, since no surface is rough. Raises ImportError without embreex.
    """
    return cc.truth.render(program.scene, program.camera, size, samples=1, outputs=("id",))


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
        exact = truth(program, size)
        inside = np.isin(_eroded(exact.outputs["id"]), neighbours)
        for whose, found in errors.items():
            got = _draw(program, renderer, whose, size, {"format": "rgba32f"})
            off = got[inside, :3].astype(np.float64) - exact.color[inside, :3]
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


def _apart(got: Picture, wanted: Picture, gain: float = 1.0) -> Picture:
    """Give the absolute difference of colours times a number, opaque, in the first picture's type."""
    scale = 255.0 if got.dtype == np.uint8 else 1.0
    other = wanted / (255.0 if wanted.dtype == np.uint8 else 1.0)
    apart = gain * np.abs(got / scale - np.clip(other, 0, 1 if scale > 1 else None))
    apart = np.clip(apart, 0, 1 if scale > 1 else None)
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
