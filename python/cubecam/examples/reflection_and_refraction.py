"""P4: reflection and refraction of a still environment (documents 001 and 002).

For each point, I goes from the eye to the point, in world space. A mirror looks up
R = I - 2 (N.I) N; glass looks up the direction of Snell's law, GLSL's ``refract(I, N, eta)``, where eta
is the index outside divided by that inside, the inverse of ``ior``. The camera circles, so the pictures
on the surfaces change; the photographs that they show do not.

Look for: the mirrors, on the left, show the photographs behind the camera; the glass, on the right,
shows those behind the glass, upside down in the middle. The upper two are balls stretched along X:
their normals are transformed by the inverse transpose of the model matrix. Document 002 uses
mat3(model), which is correct only for rotations.

Worth trying: with eta 1 the glass becomes invisible, 1/2.42 is diamond, and eta above 1 is the view out
of water: near the rim there is no refraction, and the surface mirrors. ``GlassMaterial(fresnel=True)``
shows reflection and refraction in the right proportion.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import cubecam as cc

from ._common import Photographs, Picture, on_circle, picture, surroundings, teapot
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P4"
TITLE = "Reflection and refraction of a still environment"
FRAMES = 90  # one turn of the camera
STILL = 73
SIZE = (512, 512)

ETA = 1 / 1.52  # air to window glass
TURN = 4.0  # degrees a frame, of the camera on its circle
#: Half axes of the stretched balls, world units.
STRETCH = (0.9, 0.6, 0.6)


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    fov: float  # degrees
    distance: float  # radius of the camera's circle, world units
    height: float  # of the camera's circle, world units
    teapot: float  # largest extent, world units
    mipmaps: bool
    still: int


DOCUMENT = Stage(45.0, 5.0, 0.6, 1.6, False, 67)
#: Nearer, with a wider angle: more of the photograph is behind the objects, and each of them is larger.
STAGED = Stage(65.0, 3.3, 0.3, 1.7, True, STILL)


@dataclass
class Program:
    """`camera` and `group`, which has the four objects, turn together; the photographs stay.

    `circle` has radius and height of the camera's circle, world units.
    """

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    group: cc.Node
    mirrors: tuple[cc.Node, cc.Node]
    glass: tuple[cc.Node, cc.Node]
    circle: tuple[float, float]
    still: int


def build(
    images: Photographs | None = None, eta: float = ETA, *, document: bool = False
) -> Program:
    """Make the scene; eta is the refractive index outside divided by that inside, images are as in P1."""
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(environment=surroundings(images, mipmaps=stage.mipmaps))
    group = scene.add()
    mirror, glass = cc.MirrorMaterial(), cc.GlassMaterial(ior=1 / eta, fresnel=False)
    ball, pot = cc.Mesh.sphere(1), teapot(stage.teapot)
    made = [
        (
            scene.add(ball, material, position=(x, 0.8, 0), scale=STRETCH, parent=group),
            scene.add(pot, material, position=(x, -0.8, 0), parent=group),
        )
        for x, material in ((-1.0, mirror), (1.0, glass))
    ]
    circle = stage.distance, stage.height
    camera = cc.PerspectiveCamera(
        fov=stage.fov, position=on_circle(*circle, -math.pi / 2), target=(0, 0, 0)
    )
    return Program(scene, camera, group, made[0], made[1], circle, stage.still)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: camera and group turn by 4 degrees a frame."""
    turned = cc.axis_angle((0, 1, 0), TURN * frame)
    program.group.rotation = turned
    # In frame 0 the camera is on +Z.
    program.camera.position = on_circle(*program.circle, math.radians(TURN * frame - 90))
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    images: Photographs | None = None,
    eta: float = ETA,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: a drag moves the camera round the four objects, and both turn on together."""
    program = build(images, eta, document=document)

    def turn_on(frame: float, step: float) -> None:
        program.group.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
        # The camera turns on from where the last drag left it; yaw is counted clockwise, seen from above.
        program.camera.orbit(yaw=-TURN * step)

    return live_view(program, SIZE, TITLE, renderer, clock=Clock(turn_on))
