"""P8: red-cyan stereo from one scene (document 004, section 7.4.1).

The document draws the scene twice into one picture, from two eyes: first only the red channel, then,
after it clears the depth buffer, the green and blue channels. The eyes are those of the document: the
view is turned a few degrees about the Y axis. `cubecam.StereoCamera` draws both as two views of one
pass and combines the channels.

Look for: the red and the cyan picture of an object lie apart, in one order for objects nearer than the
target and in the other order for farther ones. With red-cyan glasses, red on the left, the former
appear in front of the screen and the latter behind it.

Worth trying: greater angles strain the eyes, and 0 gives a flat picture. Only one eye sees a red
object, so it flickers; grey is best.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, picture, teapot

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P8"
TITLE = "Red-cyan stereo from one scene"
FRAMES = 120  # one turn
STILL = 10
SIZE = (512, 512)

BLACK = (0.0, 0.0, 0.0, 1.0)
DEGREES = 4.0  # between the eyes
TURN = 3.0  # degrees a frame


@dataclass
class Program:
    """`ring` turns; `camera` stands in the middle between the two eyes of `stereo`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    stereo: cc.StereoCamera
    ring: cc.Node


def build(degrees: float = DEGREES, *, document: bool = False) -> Program:
    """Make the scene: bunny, teapot, box and ball in greys, on a circle; degrees lie between the eyes."""
    scene = cc.Scene(background=BLACK)
    scene.add(cc.PointLight(position=LIGHT))
    ring = scene.add()
    things = (bunny(), cc.Mesh.box(0.8), teapot(), cc.Mesh.sphere(0.45))
    for index, mesh in enumerate(things):
        scene.add(
            mesh,
            cc.PhongMaterial(color=(0.7, 0.7, 0.7), ks=0.3),
            position=on_circle(1.5, 0, math.radians(360 * index / len(things))),
            parent=ring,
        )
    camera = cc.PerspectiveCamera(fov=45, position=(0, 1.5, 5), target=(0, 0, 0), near=1, far=100)
    stereo = cc.StereoCamera.toe_in(camera, degrees=degrees, layout="anaglyph")
    return Program(scene, camera, stereo, ring)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: red is the left eye's, green and blue are the right eye's."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    return picture(renderer, program.scene, program.stereo, size, options)
