"""P7: translucent objects after opaque ones (document 004, section 7.4.1).

Opaque objects are drawn first. Translucent objects follow from far to near, with the depth test on, so
that opaque objects hide them, and depth writes off, so that they do not hide each other. Colours are
blended with SRC_ALPHA, ONE_MINUS_SRC_ALPHA. The renderer does all this for a material whose opacity is
below 1. Alpha is blended separately and stays 1 over an opaque background, so that a web page behind
the picture does not show through.

Look for: the bunny is seen through every pane in front of it, tinted once by each; behind it the
panes vanish.

Worth trying: opacity 1 for one of the panes. It is drawn with the opaque things then, and what is
behind it is gone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, picture

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions

PROGRAM = "P7"
TITLE = "Translucent things, drawn from far to near after opaque ones"
FRAMES = 120  # one turn of the ring
STILL = 60
SIZE = (512, 512)

WHITE = (1.0, 1.0, 1.0, 1.0)
TURN = 3.0  # degrees a frame
RADIUS = 1.5  # of the ring, world units
#: Colour and opacity of the objects in the ring.
PANES = (((1.0, 0.2, 0.1), 0.5), ((0.1, 0.8, 0.2), 0.35), ((0.1, 0.3, 1.0), 0.6))
BALLS = (((1.0, 0.8, 0.1), 0.4), ((0.7, 0.1, 0.9), 0.55))


@dataclass
class Program:
    """`ring` turns, with the nodes `translucent`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ring: cc.Node
    opaque: tuple[cc.Node, ...]
    translucent: tuple[cc.Node, ...]


def build(*, document: bool = False) -> Program:
    """Make the scene: an opaque bunny on a ground, three panes and two balls round it."""
    scene = cc.Scene(background=WHITE)
    scene.add(cc.PointLight(position=LIGHT))
    ground = scene.add(
        cc.Mesh.plane(4, 4), cc.PhongMaterial(color=(0.8, 0.8, 0.8), ks=0), position=(0, -0.75, 0)
    )
    body = scene.add(bunny(1.5), cc.PhongMaterial(color=(0.8, 0.6, 0.5), ks=0.3))
    ring = scene.add()
    pane, ball = cc.Mesh.box((1.1, 1.3, 0.04)), cc.Mesh.sphere(0.4)
    things = [(pane, *look) for look in PANES] + [(ball, *look) for look in BALLS]
    order = (0, 3, 1, 4, 2)  # panes and balls in turn
    translucent = []
    for index, (mesh, color, opacity) in enumerate(things[i] for i in order):
        degrees = 360 * index / len(things)
        translucent.append(
            scene.add(
                mesh,
                # SRC_ALPHA, ONE_MINUS_SRC_ALPHA for colour, ZERO, ONE for alpha; no depth is written.
                cc.PhongMaterial(color=color, ks=0.5, opacity=opacity, blend="alpha_keep"),
                position=on_circle(RADIUS, 0, math.radians(degrees)),
                rotation=cc.axis_angle((0, 1, 0), degrees + 90),
                parent=ring,
            )
        )
    camera = cc.PerspectiveCamera(fov=45, position=(0, 1.5, 5), target=(0, 0, 0), near=1, far=100)
    return Program(scene, camera, ring, (ground, body), tuple(translucent))


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the ring turns by 3 degrees a frame."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    return picture(renderer, program.scene, program.camera, size, options)
