"""P9: a blur in nine passes (document 004, section 7.4.1).

A textured rectangle is drawn nine times over a black picture, each time with a ninth of its colour
and moved by one pixel or none in each direction; blending with ONE, ONE adds the nine up. Each
pixel becomes the mean of itself and its eight neighbours: the box filter of 3 x 3. Frame k draws
the first k passes, so the picture grows brighter from frame to frame; the last frame has all nine.

Look for: the picture is dark at first; only the sum of all passes has the right brightness.

Worth trying: a colour buffer of 8 bits rounds after each of the nine passes, by up to half a step of
255, so the sum may be wrong by 4.5 of 255. ``draw(..., format="rgba32f")`` avoids this error.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import cubecam as cc

from ._common import Picture, photographs, picture

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P9"
TITLE = "A blur in nine additive passes"
FRAMES = 10
STILL = 9
SIZE = (512, 512)

BLACK = (0.0, 0.0, 0.0, 1.0)
WEIGHT = 1 / 9
MARGIN = 0.9  # of the picture is covered by the rectangle
#: Pixels to the right and up: the middle first, then its eight neighbours.
OFFSETS = ((0, 0), (-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1))


@dataclass
class Program:
    """`passes` are the nine rectangles in the order of drawing."""

    scene: cc.Scene
    camera: cc.OrthographicCamera
    passes: tuple[cc.Node, ...]
    sharp: cc.BasicMaterial
    weighted: cc.BasicMaterial


def build(image: npt.ArrayLike | None = None, *, document: bool = False) -> Program:
    """Make the scene; image is an array (H, W, C), one of the photographs by default."""
    pixels = photographs()[4] if image is None else image
    scene = cc.Scene(background=BLACK)
    surface: dict[str, Any] = {
        "map": cc.Image(pixels, wrap="clamp"),
        "blend": "additive",
        "depth_write": False,
        "depth_test": False,
        "color_write": (True, True, True, False),  # alpha stays 1
    }
    weighted = cc.BasicMaterial(color=(WEIGHT, WEIGHT, WEIGHT), **surface)
    sharp = cc.BasicMaterial(color=(1, 1, 1), **surface)
    upright = cc.axis_angle((1, 0, 0), 90)
    passes = tuple(scene.add(cc.Mesh.plane(1, 1), weighted, rotation=upright) for _ in OFFSETS)
    # One world unit is one pixel: `draw` sets the height to that of the picture.
    camera = cc.OrthographicCamera(height=SIZE[1], position=(0, 0, 1), near=0.5, far=2)
    return Program(scene, camera, passes, sharp, weighted)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    blurred: bool = True,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw the first `frame` passes, at most nine. blurred=False: the rectangle once, at full weight."""
    width, height = size
    program.camera.height = height
    for index, (node, offset) in enumerate(zip(program.passes, OFFSETS, strict=True)):
        node.visible = index < frame if blurred else index == 0
        node.material = program.weighted if blurred else program.sharp
        node.position = (*offset, 0)
        # The plane lies in XZ: its depth is the picture's height.
        node.scale = (round(MARGIN * width), 1, round(MARGIN * height))
    return picture(renderer, program.scene, program.camera, size, options)
