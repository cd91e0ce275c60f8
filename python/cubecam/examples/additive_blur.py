"""P9: a blur in nine passes (document 004, section 7.4.1).

A textured rectangle is drawn nine times over a black picture, each time with a ninth of its colour
and moved by one pixel or none in each direction; blending with ONE, ONE adds the nine up. Each
pixel becomes the mean of itself and its eight neighbours: the box filter of 3 x 3.

The left half is the rectangle drawn once, sharp. The right half is the sum of the first 1, 2, ... 9 passes,
which is shown times 9, 9/2, ... 1, so that it is as bright as the source. Both are drawn with few pixels, of which each
is shown as a square, since a blur over three pixels is hard to see in a picture of 512. The finished
picture comes first and last; the last one stays for a second.

Look for: windows and leaves, whose pixels differ, get softer with each pass; the sky, whose pixels are equal, stays as
it is. At the border of the rectangle the passes do not cover each other: there the sum fades in three steps.

Worth trying: ``build(document=True)`` draws the document's picture, whose frame k is the sum of the first k passes
as it is: dark at first, and right only with all nine. A colour buffer of 8 bits rounds after each pass, by up to
half a step of 255, so the sum may be wrong by 4.5 of 255. ``draw(..., format="rgba32f")`` avoids this error.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import cubecam as cc

from ._common import Picture, photographs, picture
from ._labels import panels

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P9"
TITLE = "A blur in nine additive passes, beside its sharp source"
HELD = 10  # frames that each of the first eight sums is shown
LAST = 25  # frames that the finished picture is shown: a second
FRAMES = 1 + 8 * HELD + LAST
STILL = FRAMES - 1
SIZE = (1024, 512)

BLACK = (0.0, 0.0, 0.0, 1.0)
WEIGHT = 1 / 9
MARGIN = 0.9  # of the document's picture is covered by the rectangle
#: Pixels to the right and up: the middle first, then its eight neighbours.
OFFSETS = ((0, 0), (-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1))
#: Pixels along an edge of the staged pictures, and of the rectangle in them, which has one texel for each.
SMALL, INNER = 128, 120


@dataclass
class Program:
    """`passes` are the nine rectangles in the order of drawing; `staged`: whether the source stands beside the sum."""

    scene: cc.Scene
    camera: cc.OrthographicCamera
    passes: tuple[cc.Node, ...]
    sharp: cc.BasicMaterial
    weighted: cc.BasicMaterial
    staged: bool
    frames: int = FRAMES
    still: int = STILL
    size: tuple[int, int] = SIZE


def build(
    image: str | os.PathLike[str] | npt.ArrayLike | None = None, *, document: bool = False
) -> Program:
    """Make the scene.

    image : an array (H, W, C) or a file; one of the photographs, or a detail of it, by default. document : whether to
    make the document's own picture, without the source beside it.
    """
    pixels: Any = image
    if image is None:
        pixels = photographs()[4] if document else _detail()
    elif isinstance(image, str | os.PathLike):
        pixels = cc.load_image(image)
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
    # One world unit is one pixel: `add_up` sets the height to that of the picture.
    camera = cc.OrthographicCamera(height=SIZE[1], position=(0, 0, 1), near=0.5, far=2)
    program = Program(scene, camera, passes, sharp, weighted, staged=not document)
    if document:
        program.frames, program.still, program.size = 10, 9, (512, 512)
    return program


def _detail() -> npt.NDArray[np.uint8]:
    """Cut the house out of a photograph, in pixels as large as those of the panorama that it was made from."""
    large = np.asarray(photographs()[4])[84:324, 270:510, :3].astype(np.float64)
    halved = large.reshape(INNER, 2, INNER, 2, 3).mean(axis=(1, 3))
    return np.asarray(np.rint(halved), np.uint8)


def count_of(program: Program, frame: int) -> int:
    """Give the number of passes of a frame."""
    if not program.staged:
        return min(frame, 9)
    return 9 if frame == 0 else min(1 + (frame - 1) // HELD, 9)


def add_up(
    program: Program,
    renderer: cc.Renderer,
    count: int,
    size: tuple[int, int],
    weight: float | None = WEIGHT,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw the first `count` passes, each with a weight; None: the rectangle once, sharp."""
    width, height = size
    program.camera.height = height
    margin = INNER / SMALL if program.staged else MARGIN
    if weight is not None:
        program.weighted.color = (weight, weight, weight)
    for index, (node, offset) in enumerate(zip(program.passes, OFFSETS, strict=True)):
        node.visible = index < count if weight is not None else index == 0
        node.material = program.weighted if weight is not None else program.sharp
        node.position = (*offset, 0)
        # The plane lies in XZ: its depth is the picture's height.
        node.scale = (round(margin * width), 1, round(margin * height))
    return picture(renderer, program.scene, program.camera, size, options)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    blurred: bool = True,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame. blurred=False: the sharp rectangle alone."""
    count = count_of(program, frame)
    if not program.staged:
        weight = WEIGHT if blurred else None
        return add_up(program, renderer, count, size, weight, **options)
    half = (max(size[0] // 2, 1) if blurred else size[0], size[1])
    times = max(1, round(min(half) / SMALL))  # pixels along an edge of the squares
    small = (-(-half[0] // times), -(-half[1] // times))
    sharp = _enlarged(add_up(program, renderer, 1, small, None, **options), times, half)
    if not blurred:
        return sharp
    # Times 9/k is 1/k in place of 1/9 for each pass.
    total = add_up(program, renderer, count, small, WEIGHT * 9 / count, **options)
    name = "the mean of all 9" if count == 9 else f"the first {count} of 9, times 9/{count}"
    return panels([[("drawn once", sharp), (name, _enlarged(total, times, half))]])


def _enlarged(shown: Picture, times: int, size: tuple[int, int]) -> Picture:
    """Show each pixel as a square."""
    rows, columns = np.arange(size[1]) // times, np.arange(size[0]) // times
    enlarged: Picture = shown[rows[:, None], columns[None, :]]
    return enlarged
