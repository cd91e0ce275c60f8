"""P8: red-cyan stereo from one scene (document 004, section 7.4.1).

The document draws the scene twice into one picture, from two eyes: first only the red channel, then,
after it clears the depth buffer, the green and blue channels. "One way to set up the views from the left
and right eyes is simply to rotate the view by a few degrees about the y-axis": here the axis is the view's
own y axis, which goes up in the picture and through the target, and the eyes are 4 degrees apart.
`cubecam.StereoCamera` draws both as two views of one pass and combines the channels.

Look for: red and cyan borders of the light things. The ball, nearer than the target, has cyan on its left and red
on its right; the box and the bunny, farther away, have red on the left. With red-cyan glasses, red on the left, the
former stand in front of the screen and the latter behind it.

``build(axis="world")`` turns the view about the world's y axis instead. This camera looks down, so the two
pictures are then rolled against each other, by 4 sin(17) = 1.2 degrees: red and cyan also lie one above the
other at the left and right borders of the picture, which eyes do not like.

Worth trying: greater angles strain the eyes, and 0 gives a flat picture. Only one eye sees a red
object, so it flickers; grey is best.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, picture, squares, teapot

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P8"
TITLE = "Red-cyan stereo: two eyes, turned about the view's own y axis"
FRAMES = 120  # one turn
STILL = 10
SIZE = (512, 512)

DEGREES = 4.0  # between the eyes
TURN = 3.0  # degrees a frame
GREY, DARK = (0.7, 0.7, 0.7), (0.25, 0.25, 0.25)


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    background: tuple[float, float, float, float]
    grown: float  # a factor of the things
    radius: float  # of the ring, world units
    ka: float
    light: tuple[float, float, float]
    ground: float  # its edge, world units; 0: there is none


#: The document clears to black.
DOCUMENT = Stage((0.0, 0.0, 0.0, 1.0), 1.0, 1.5, 0.2, LIGHT, 0)
STAGED = Stage((0.0, 0.0, 0.0, 1.0), 1.25, 1.35, 0.45, (1.0, 6.0, 6.0), 9)


@dataclass
class Program:
    """`ring` turns; `camera` stands in the middle between the two eyes of `stereo`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    stereo: cc.StereoCamera
    ring: cc.Node


def build(
    degrees: float = DEGREES, axis: Literal["view", "world"] = "view", *, document: bool = False
) -> Program:
    """Make the scene: bunny, teapot, box and ball in greys, on a circle.

    degrees : between the eyes. axis : whose y axis the views are turned about. document : whether to make the
    document's own scene.
    """
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=stage.background)
    scene.add(cc.PointLight(position=stage.light))
    ring = scene.add()
    grown = stage.grown
    things = (
        bunny(1.2 * grown),
        cc.Mesh.box(0.8 * grown),
        teapot(1.2 * grown),
        cc.Mesh.sphere(0.45 * grown),
    )
    for index, mesh in enumerate(things):
        scene.add(
            mesh,
            cc.PhongMaterial(color=GREY, ks=0.3, ka=stage.ka),
            position=on_circle(stage.radius, 0, math.radians(360 * index / len(things))),
            parent=ring,
        )
    if stage.ground:
        scene.add(
            cc.Mesh.plane(stage.ground, stage.ground),
            cc.PhongMaterial(color=DARK, ks=0, ka=stage.ka, map=squares(12)),
            position=(0, -0.7 * grown, 0),
        )
    return Program(scene, _camera(), eyes(degrees, axis), ring)


def _camera(position: tuple[float, float, float] = (0, 1.5, 5)) -> cc.PerspectiveCamera:
    return cc.PerspectiveCamera(fov=45, position=position, target=(0, 0, 0), near=1, far=100)


def eyes(degrees: float = DEGREES, axis: Literal["view", "world"] = "view") -> cc.StereoCamera:
    """Place the two eyes: the camera's view, turned by half the angle to either side, about the target."""
    if axis not in ("view", "world"):
        raise ValueError(f'axis: expected "view" or "world", got {axis!r}')
    if axis == "view":
        return cc.StereoCamera.toe_in(_camera(), degrees=degrees, layout="anaglyph")
    x, y, z = _camera().position.tolist()  # from the target, which is the world's origin
    left, right = (
        (x * math.cos(turn) + z * math.sin(turn), y, z * math.cos(turn) - x * math.sin(turn))
        for turn in (math.radians(-degrees / 2), math.radians(degrees / 2))
    )
    return cc.StereoCamera(_camera(left), _camera(right), layout="anaglyph")


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
