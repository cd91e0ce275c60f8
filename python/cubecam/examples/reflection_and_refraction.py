"""P4: reflection and refraction of a still environment (documents 001 and 002).

For each point, I goes from the eye to it, in world space. A mirror looks up R = I - 2 (N.I) N;
glass looks up what Snell's law makes of I, GLSL's ``refract(I, N, eta)`` with eta the index outside
divided by that inside, the inverse of ``ior``. The camera circles: the pictures on the surfaces change, the photographs
that they show do not.

Look for: the mirrors, on the left, show what is behind the camera; the glass, on the right, shows
what is behind it, upside down in the middle. The upper two are balls stretched along X: their
normals go by the inverse transpose of the model matrix; document 002 takes mat3(model), which is
right for rotations only.

Worth trying: eta 1 makes glass vanish, 1/2.42 is diamond, and above 1 one looks out of the water: at
the rim nothing is refracted, and the glass mirrors. ``GlassMaterial(fresnel=True)`` shows both in the
right proportion.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cubecam as cc

from ._common import Picture, on_circle, picture, surroundings, teapot

PROGRAM = "P4"
TITLE = "Reflection and refraction of a still environment"
FRAMES = 90  # one turn of the camera
STILL = 67
SIZE = (512, 512)

FOV = 45.0  # degrees
ETA = 1 / 1.52  # air to window glass
DISTANCE, HEIGHT, TURN = 5.0, 0.6, 4.0  # of the camera: world units, degrees a frame
#: Half axes of the stretched balls, world units.
STRETCH = (0.9, 0.6, 0.6)


@dataclass
class Program:
    """The camera and the group of the four things turn together; the photographs stay."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    group: cc.Node
    mirrors: tuple[cc.Node, cc.Node]
    glass: tuple[cc.Node, cc.Node]


def build(images: Any = None, eta: float = ETA) -> Program:
    """Make the scene; eta is the refractive index outside divided by that inside, images are as in P1."""
    scene = cc.Scene(environment=surroundings(images))
    group = scene.add()
    mirror, glass = cc.MirrorMaterial(), cc.GlassMaterial(ior=1 / eta, fresnel=False)
    ball, pot = cc.Mesh.sphere(1), teapot(1.6)
    made = [
        (
            scene.add(ball, material, position=(x, 0.8, 0), scale=STRETCH, parent=group),
            scene.add(pot, material, position=(x, -0.8, 0), parent=group),
        )
        for x, material in ((-1.0, mirror), (1.0, glass))
    ]
    camera = cc.PerspectiveCamera(fov=FOV, position=(0, HEIGHT, DISTANCE), target=(0, 0, 0))
    return Program(scene, camera, group, made[0], made[1])


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Any,
) -> Picture:
    """Draw a frame: camera and group have turned by 4 degrees a frame."""
    turned = cc.axis_angle((0, 1, 0), TURN * frame)
    program.group.rotation = turned
    # 0 is on +Z.
    program.camera.position = on_circle(DISTANCE, HEIGHT, math.radians(TURN * frame - 90))
    return picture(renderer, program.scene, program.camera, size, options)
