"""P5: a mirror cube while its photographs arrive (document 002, environment maps).

On the web, images load one after another. Therefore all six faces are first made of one colour, so
that the cubemap can be used from the first frame; each image that arrives replaces a face, and the
mipmaps are computed again. One photograph arrives in a second, while the cube spins; the picture says how
many are there. The second half of the animation starts again, and shows the same cubemap also as the
skybox.

Look for: one side of the cube after another shows a photograph, while others are still grey; a side that
mirrors two faces changes twice. The sides are flat mirrors, since each corner of a cube has a normal for
each of its sides.

Worth trying: pass a picture to ``build`` that is not square, or has another size than the first. When
it arrives, it raises an error with both sizes in the message, and the face keeps its colour.
``build(document=True)`` shows the state after k arrivals in frame k, in the view that the document prints.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import cubecam as cc

from ._common import PHOTOGRAPH, Photographs, Picture, photographs, picture
from ._labels import label
from ._live import RATE, Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import FilePixels, RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P5"
TITLE = "A mirror cube while its photographs arrive"
SECOND = round(RATE)  # frames
HALF = (
    7 * SECOND
)  # frames without a skybox, and again as many with it: six arrivals, and a second with all six
FRAMES = 2 * HALF
STILL = HALF + 3 * SECOND + 2
SIZE = (512, 512)

NEAR, FAR = 1.0, 2000.0  # world units
BLANK = 102  # of 255: the colour of a face whose photograph is not there yet


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    sample: str  # the photographs
    fov: float  # degrees
    eye: tuple[float, float, float]
    tint: tuple[float, float, float]  # of the mirror
    tilt: float  # degrees round X in frame 0
    spin: tuple[float, float]  # degrees a frame round X and Y
    wait: int  # frames from one arrival to the next
    order: tuple[int, ...]  # of arrival, which is not the order of the requests
    half: int  # frames without a skybox
    still: int
    labelled: bool  # whether the picture says how many have arrived


DOCUMENT = Stage(
    "sunset.exr",
    60.0,
    (0.0, 0.0, 2.0),
    (1.0, 1.0, 1.0),
    0.0,
    (1.6, 2.8),
    1,
    (4, 1, 0, 5, 3, 2),
    45,
    65,
    False,
)
#: The mirror darkens a little, so that it is seen before a skybox that has one colour with it.
STAGED = Stage(
    "interior.exr",
    66.0,
    (0.0, 0.0, 2.0),
    (0.82, 0.88, 0.92),
    12.0,
    (0.0, 1.3),
    SECOND,
    (4, 5, 1, 0, 3, 2),
    HALF,
    STILL,
    True,
)


@dataclass
class Program:
    """`tilt` turns round X and carries `cube`; the cube mirrors `cubemap`. `arrived` photographs are there."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    tilt: cc.Node
    cube: cc.Node
    cubemap: cc.CubeMap
    photographs: list[FilePixels]
    stage: Stage
    arrived: int
    frames: int
    still: int


def build(
    images: Photographs | None = None, size: int | None = None, *, document: bool = False
) -> Program:
    """Make the scene with a cubemap whose faces are still of one colour.

    images : the photographs that arrive, as in P1. size : texels along an edge of a face, by default as many as the
    first photograph has.
    """
    stage = DOCUMENT if document else STAGED
    found = photographs(images, stage.sample)
    size = (PHOTOGRAPH if images is None else found[0].shape[0]) if size is None else size
    cubemap = cc.CubeMap(np.full((6, size, size, 3), BLANK, np.uint8), mipmaps=True)
    scene = cc.Scene(environment=cubemap, background=(0, 0, 0, 1))
    tilt = scene.add()
    cube = scene.add(cc.Mesh.box(1), cc.MirrorMaterial(tint=stage.tint), parent=tilt)
    camera = cc.PerspectiveCamera(
        fov=stage.fov, position=stage.eye, target=(0, 0, 0), near=NEAR, far=FAR
    )
    return Program(scene, camera, tilt, cube, cubemap, found, stage, 0, 2 * stage.half, stage.still)


def arrive(program: Program, count: int) -> None:
    """Set the state after the first `count` photographs have arrived.

    Raises ValueError for a photograph that is not square or not of the cubemap's size; earlier ones are set.
    """
    cubemap = program.cubemap
    for number, face in enumerate(program.stage.order):
        if number < count:
            cubemap.set_face(face, program.photographs[face])
        else:
            cubemap.set_face(face, np.full((cubemap.size, cubemap.size, 3), BLANK, np.uint8))


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; in the second half the photographs arrive again, with the skybox."""
    place(program, frame)
    return _labelled(program, renderer, size, options)


def place(program: Program, frame: float) -> None:
    """Let the photographs arrive that are there in a frame, and turn the cube as it is then."""
    stage = program.stage
    half, within = divmod(frame, stage.half)
    count = int(within // stage.wait)
    if count != program.arrived or count == 0:
        arrive(program, count)
        program.arrived = count
    program.scene.background = program.cubemap if half % 2 else (0, 0, 0, 1)
    program.tilt.rotation = cc.axis_angle((1, 0, 0), stage.tilt + stage.spin[0] * frame)
    program.cube.rotation = cc.axis_angle((0, 1, 0), stage.spin[1] * frame)


def _labelled(
    program: Program, renderer: cc.Renderer, size: tuple[int, int], options: RenderOptions
) -> Picture:
    drawn = picture(renderer, program.scene, program.camera, size, options)
    if not program.stage.labelled:
        return drawn
    words = f"{min(program.arrived, 6)} of 6 photographs"
    return label(drawn, words)


def live(
    images: Photographs | None = None,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: photographs arrive while the cube spins, and a drag moves the camera round it."""
    program = build(images, document=document)
    return live_view(
        program,
        SIZE,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: place(program, frame)),
        draw=lambda drawer, size, samples: _labelled(program, drawer, size, {"samples": samples}),
    )
