"""P8: red-cyan stereo from one scene (document 004, section 7.4.1).

The scene is drawn twice into one picture, from two eyes: first with the colour mask on red alone,
then, the depth buffer cleared but not the colour, on green and blue. The eyes are set up as the
document has it, by turning the view a few degrees about the Y axis. `cubecam.StereoCamera` draws
both as two views of one pass and puts the channels together.

Look for: things nearer than the target part to one side, farther ones to the other; with red-cyan
glasses, red on the left, they stand before and behind the screen.

Worth trying: greater angles strain the eyes, 0 gives a flat picture. A red thing is seen by one eye
only and flickers; grey is best.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, picture, teapot

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
    """`ring` is what turns; `camera` is the eye between the two of `stereo`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    stereo: cc.StereoCamera
    ring: cc.Node


def build(degrees: float = DEGREES) -> Program:
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
    **options: Any,
) -> Picture:
    """Draw a frame: red is the left eye's, green and blue are the right eye's."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    return picture(renderer, program.scene, program.stereo, size, options)
