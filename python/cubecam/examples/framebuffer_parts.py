"""P11: the parts of a framebuffer (document 004, sections 7.4 and 7.4.3).

A framebuffer has colour buffers, a depth buffer and sometimes a stencil buffer, each in a format:
RGBA8 or RGB565, DEPTH_COMPONENT16, STENCIL_INDEX8. One pass can fill several colour buffers: here
colour, distance, normal, position and id. A framebuffer may also have only a depth buffer: a shadow map
is such a framebuffer, drawn from the lamp.

Look for, from left to right, in the upper row: colour with shadows in RGBA8; the same in RGB565, in
bands of 32, 64 and 32 steps; depth, dark near the camera; the lamp's shadow map, bright near the lamp.
In the lower row: normals and positions as colours; a colour for each id; the stencil, which counts the
surfaces that cover a pixel, hidden ones included.

Worth trying: ``parts(program, renderer, frame, size)`` returns the parts as arrays of numbers. A depth
of 16 bits has 65,536 steps between near and far, most of them near the camera: set near to 0.01 and see
how few steps are left for the ground.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias, TypedDict

import numpy as np
import numpy.typing as npt

import cubecam as cc

from ._common import LIGHT, bunny, on_circle, teapot

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import Encode, Tonemap

PROGRAM = "P11"
TITLE = "The parts of a framebuffer, and a shadow map"
FRAMES = 120  # one turn
STILL = 0
SIZE = (1024, 512)  # four by two pictures

GREY = (0.4, 0.4, 0.4, 1.0)
NEAR, FAR = 1.0, 20.0  # world units
SHADOW = 512  # pixels along an edge of the shadow map
TURN = 3.0  # degrees a frame
OUTPUTS = ("distance", "z", "normal", "position", "id", "depth")


@dataclass
class Program:
    """`ring` turns; `things` stand on it, above `ground`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    lamp: cc.PointLight
    ground: cc.Node
    ring: cc.Node
    things: tuple[cc.Node, ...]


def build(*, document: bool = False) -> Program:
    """Make the scene: bunny, teapot and box on a ground under one lamp that throws shadows."""
    scene = cc.Scene(background=GREY)
    lamp = cc.PointLight(position=LIGHT, shadow=cc.Shadow(size=SHADOW))
    scene.add(lamp)
    count = cc.Stencil(depth_pass="incr", depth_fail="incr")
    ground = scene.add(
        cc.Mesh.plane(8, 8),
        cc.PhongMaterial(color=(0.6, 0.6, 0.7), ks=0, stencil=count),
        position=(0, -0.6, 0),
    )
    ring = scene.add()
    things = (
        (bunny(), (0.4, 1.0, 0.4)),
        (teapot(), (1.0, 0.4, 0.4)),
        (cc.Mesh.box(0.8), (0.4, 0.4, 1.0)),
    )
    nodes = tuple(
        scene.add(
            mesh,
            cc.PhongMaterial(color=color, stencil=count),
            position=on_circle(1.4, 0, math.radians(360 * index / len(things))),
            parent=ring,
        )
        for index, (mesh, color) in enumerate(things)
    )
    camera = cc.PerspectiveCamera(
        fov=45, position=(0, 2.5, 5), target=(0, 0, 0), near=NEAR, far=FAR
    )
    return Program(scene, camera, lamp, ground, ring, nodes)


#: Colours, distances, ids or what is computed from them.
Part: TypeAlias = npt.NDArray[np.uint8 | np.int32 | np.float16 | np.float32 | np.float64]


class Look(TypedDict, total=False):
    """The options of `Renderer.render` that do not choose what is drawn."""

    samples: int
    exposure: float
    tonemap: Tonemap | None
    encode: Encode | None
    effects: Sequence[cc.ImageEffect]


def parts(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int],
    **options: Unpack[Look],
) -> dict[str, Part]:
    """Return every part as an array.

    "color", "distance", "z", "normal", "position", "id" and "depth" are of one pass with a depth buffer of 16 bits,
    "rgb565" is of one with 16 bits for a colour, "stencil" of one with a stencil buffer beside the depth,
    "depth_only" of one without any colour buffer, and "shadow" is the lamp's map, six faces.
    """
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    scene, camera = program.scene, program.camera
    drawn = renderer.render(
        scene, camera, size, outputs=OUTPUTS, depth_format="depth_component16", **options
    )
    small = renderer.render(scene, camera, size, format="rgb565", **options)
    counted = renderer.render(
        scene, camera, size, outputs=("stencil",), depth_format="depth24_stencil8", **options
    )
    alone = renderer.render(scene, camera, size, outputs=("depth",), format=None)
    return {
        "color": drawn.color,
        **{name: getattr(drawn, name) for name in OUTPUTS},
        "rgb565": small.color,
        "stencil": counted.stencil,
        "depth_only": alone.depth,
        "shadow": renderer.shadow_map(scene, program.lamp),
    }


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[Look],
) -> Part:
    """Draw a frame as four by two pictures, uint8. `format` is not an option, since each picture has its own."""
    cell = (max(size[0] // 4, 1), max(size[1] // 2, 1))
    part = parts(program, renderer, frame, cell, **options)
    normal = part["normal"] / 2 + 0.5
    position = np.nan_to_num(part["position"] / 4 + 0.5, nan=0.4)
    # Ids that follow each other get colours that differ much.
    hues = (part["id"][..., None] * np.array([0.37, 0.61, 0.83])) % 1
    above = [part["color"], part["rgb565"], _grey(part["depth"]), _grey(_shadow(part, cell))]
    below = [normal, position, hues, _grey(part["stencil"] / 4)]
    rows = [np.concatenate([_bytes(item) for item in row], axis=1) for row in (above, below)]
    return np.concatenate(rows)


def _grey(values: Part) -> Part:
    return np.repeat(np.asarray(values, np.float64)[..., None], 3, axis=2)


def _shadow(part: dict[str, Part], cell: tuple[int, int]) -> Part:
    """Return the two faces that look down from the lamp, -Y beside -X, as a picture of the cell's size."""
    width, height = cell
    distances = part["shadow"][[3, 1]]
    pair = np.concatenate(list(np.clip((9 - distances) / 6, 0, 1)), axis=1)
    rows = (np.arange(height) + 0.5) * pair.shape[0] / height
    columns = (np.arange(width) + 0.5) * pair.shape[1] / width
    found: Part = pair[rows.astype(int)[:, None], columns.astype(int)[None, :]]
    return found


def _bytes(picture: Part) -> Part:
    """Turn uint8, or numbers from 0 to 1, into opaque (H, W, 4) uint8."""
    color = picture[..., :3]
    if color.dtype != np.uint8:
        color = np.rint(np.clip(color, 0, 1) * 255).astype(np.uint8)
    return np.concatenate([color, np.full_like(color[..., :1], 255)], axis=2)
