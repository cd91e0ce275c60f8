"""P10: render to a texture (document 004, section 7.4.2).

A flat picture with moving discs is drawn into a texture of 512 x 512, without a depth buffer, and a
turning cube shows that texture. The texture has a scene and a camera of its own;
`cubecam.RenderTexture` draws it whenever it changes, before the pictures that show it.

Look for: each side of the cube shows the discs of this frame, never those of the last one. The discs
are translucent and drawn in the order in which they were added.

Worth trying: draw the cube's own scene into the texture. A picture cannot show itself, so this raises
an error that names the texture, until the texture leaves the cube out (``exclude=[cube]``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import LIGHT, Picture, picture

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P10"
TITLE = "Render to a texture that an object shows"
FRAMES = 120  # one turn
STILL = 20
SIZE = (512, 512)

TEXTURE = (512, 512)  # pixels
WHITE, BLACK = (1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
TURN = 3.0  # degrees a frame
#: Colour and radius of each disc, and its number of rounds in one turn of the cube.
DISCS = (
    ((0.9, 0.1, 0.1), 0.45, 1),
    ((0.1, 0.6, 0.2), 0.35, -2),
    ((0.1, 0.3, 0.9), 0.3, 3),
    ((0.9, 0.7, 0.1), 0.25, -4),
)


@dataclass
class Program:
    """`discs` move in the texture's scene, `cube` in the main one."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    cube: cc.Node
    inner: cc.Scene
    inner_camera: cc.OrthographicCamera
    discs: tuple[cc.Node, ...]
    texture: cc.RenderTexture


def build(*, document: bool = False) -> Program:
    """Make both scenes; in the inner one a unit is half the texture's edge."""
    inner = cc.Scene(background=WHITE)
    upright = cc.axis_angle((1, 0, 0), 90)
    discs = []
    for color, radius, _ in DISCS:
        discs.append(
            inner.add(
                # A disc is a flat cylinder, seen from above.
                cc.Mesh.cylinder(radius, 0.01),
                cc.BasicMaterial(color=color, opacity=0.6),
                rotation=upright,
            )
        )
    inner_camera = cc.OrthographicCamera(height=2, position=(0, 0, 1), near=0.5, far=2)
    texture = cc.RenderTexture(inner, inner_camera, size=TEXTURE, depth_format=None, name="discs")
    scene = cc.Scene(background=BLACK)
    scene.add(cc.PointLight(position=LIGHT))
    cube = scene.add(cc.Mesh.box(1.6), cc.PhongMaterial(color=(1, 1, 1), ka=0.4, map=texture))
    camera = cc.PerspectiveCamera(fov=45, position=(0, 1.5, 4), target=(0, 0, 0))
    return Program(scene, camera, cube, inner, inner_camera, tuple(discs), texture)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame with the discs and the cube at their places."""
    for node, (_, radius, rounds) in zip(program.discs, DISCS, strict=True):
        angle = rounds * 2 * math.pi * frame / FRAMES
        away = 0.95 - radius
        node.position = (away * math.cos(angle), away * math.sin(angle), 0)
    program.cube.rotation = cc.axis_angle((0.3, 1, 0.2), TURN * frame)
    return picture(renderer, program.scene, program.camera, size, options)
