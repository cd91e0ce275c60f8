"""P5: a mirror cube while its photographs arrive (document 002, environment maps).

On the web, images load one after another. Therefore all six faces are first made of one colour, so
that the cubemap can be used from the first frame; each image that arrives replaces a face, and the
mipmaps are computed again. Frame k shows the state after k arrivals, while the cube spins. The second
half of the animation starts again, and shows the same cubemap also as the skybox.

Look for: one side of the cube after another shows a photograph; a side that mirrors two faces changes
twice. The sides are flat mirrors, since each corner of a cube has a normal for each of its sides.

Worth trying: pass a picture to ``build`` that is not square, or has another size than the others. When
it arrives, it raises an error with both sizes in the message, and the face keeps its colour.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import cubecam as cc

from ._common import PHOTOGRAPH, Photographs, Picture, photographs, picture

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import FilePixels, RenderOptions

PROGRAM = "P5"
TITLE = "A mirror cube while its photographs arrive"
HALF = 45  # frames without a skybox, and again as many with it
FRAMES = 2 * HALF
STILL = HALF + 20
SIZE = (512, 512)

FOV, NEAR, FAR = 60.0, 1.0, 2000.0  # degrees, world units
EYE = (0.0, 0.0, 2.0)
SPIN = (1.6, 2.8)  # degrees a frame round X and Y
BLANK = 102  # of 255: the colour of a face whose photograph is not there yet
#: The faces in the order of their arrival, which is not the order of the requests.
ARRIVALS = (4, 1, 0, 5, 3, 2)


@dataclass
class Program:
    """`tilt` turns round X and carries `cube`; the cube mirrors `cubemap`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    tilt: cc.Node
    cube: cc.Node
    cubemap: cc.CubeMap
    photographs: list[FilePixels]


def build(
    images: Photographs | None = None, size: int = PHOTOGRAPH, *, document: bool = False
) -> Program:
    """Make the scene with a cubemap whose faces are still of one colour.

    images : the photographs that arrive, as in P1. size : texels along an edge of a face.
    """
    cubemap = cc.CubeMap(np.full((6, size, size, 3), BLANK, np.uint8), mipmaps=True)
    scene = cc.Scene(environment=cubemap, background=(0, 0, 0, 1))
    tilt = scene.add()
    cube = scene.add(cc.Mesh.box(1), cc.MirrorMaterial(), parent=tilt)
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0), near=NEAR, far=FAR)
    return Program(scene, camera, tilt, cube, cubemap, photographs(images))


def arrive(program: Program, count: int) -> None:
    """Set the state after the first `count` photographs have arrived.

    Raises ValueError for a photograph that is not square or not of the cubemap's size; earlier ones are set.
    """
    cubemap = program.cubemap
    for number, face in enumerate(ARRIVALS):
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
    """Draw a frame: k photographs have arrived; from frame `HALF` on they arrive again, with the skybox."""
    arrive(program, frame % HALF)
    program.scene.background = program.cubemap if frame // HALF % 2 else (0, 0, 0, 1)
    program.tilt.rotation = cc.axis_angle((1, 0, 0), SPIN[0] * frame)
    program.cube.rotation = cc.axis_angle((0, 1, 0), SPIN[1] * frame)
    return picture(renderer, program.scene, program.camera, size, options)
