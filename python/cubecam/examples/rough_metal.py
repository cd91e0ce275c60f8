"""P18: roughness and metalness, beside the formula.

Mirrors of document 000 are perfect. Real metal is rough: it reflects a cone of directions, the wider the
rougher. Summing over the cone in every pixel is slow, so the cubemap is summed in advance, once for each
of a few roughnesses (`CubeMap.prefilter`); a pixel then needs one lookup. What the surface itself does with
the light, its reflectance from every angle, stands in a table of two numbers (`cubecam.brdf`). Their
product is the "split sum" of B. Karis, "Real Shading in Unreal Engine 4", 2013.

Three rows of balls stand in a photograph: metal, half metal, and plastic. From left to right they get
rougher. `draw` shows the picture of `StandardMaterial`; ``draw(..., show="formula")`` computes the same
picture in numpy, pixel by pixel, from the definition of glTF 2.0 (appendix B), and
``show="difference"`` shows by how much the two differ.

Look for: the reflections get wider from left to right; plastic has the colour of
its paint and reflects without colour, stronger at grazing angles.

Worth trying: ``build(multiple_scattering=False)``. The rough metal gets darker, because light that meets
the rough surface more than once is then lost.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

import cubecam as cc

from ._common import Picture, picture
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P18"
TITLE = "Roughness and metalness, beside the formula"
FRAMES = 60
STILL = 0
SIZE = (768, 384)

ROUGHNESS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)  # the columns
METALLIC = (1.0, 0.5, 0.0)  # the rows, from above
COLOR = (0.95, 0.64, 0.3)  # linear
RADIUS, STEP = 0.44, 1.0  # world units: of a ball; from one ball to the next
FOV, FAR_AWAY = 26.0, 7.7  # degrees; world units from the eye to the balls
IOR = 1.5  # of the plastic: StandardMaterial's own value

Floats = npt.NDArray[np.float64]


@dataclass
class Program:
    """`levels` and `irradiance` are what the formula looks up; `balls` stand row by row."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    balls: tuple[cc.Node, ...]
    levels: tuple[cc.CubeMap, ...]  # for roughness 0 to 1, in equal steps
    irradiance: cc.CubeMap
    multiple_scattering: bool


def build(
    environment: cc.CubeMap | None = None,
    multiple_scattering: bool = True,
    detail: int = 64,
    *,
    document: bool = False,
) -> Program:
    """Make the scene: a photograph, by default a room, and 18 balls.

    multiple_scattering : whether light that meets the rough surface several times is counted. detail : segments of a
    ball.
    """
    if environment is None:
        environment = cc.load_environment(cc.sample_data("interior.exr"), size=256)
    filtered = environment.prefilter()
    scene = cc.Scene(environment=filtered)
    mesh = cc.Mesh.sphere(RADIUS, detail, detail // 2)
    balls = tuple(
        scene.add(
            mesh,
            cc.StandardMaterial(
                color=COLOR,
                metallic=metallic,
                roughness=roughness,
                multiple_scattering=multiple_scattering,
            ),
            position=(
                STEP * (column - (len(ROUGHNESS) - 1) / 2),
                STEP * ((len(METALLIC) - 1) / 2 - row),
                0,
            ),
        )
        for row, metallic in enumerate(METALLIC)
        for column, roughness in enumerate(ROUGHNESS)
    )
    camera = cc.PerspectiveCamera(fov=FOV, position=(0, 0, FAR_AWAY), target=(0, 0, 0))
    levels = tuple(cc.CubeMap(level) for level in filtered.levels)
    return Program(scene, camera, balls, levels, environment.irradiance(), multiple_scattering)


def turn(program: Program, frame: float) -> None:
    """Turn the photograph round the balls: once in `FRAMES` frames."""
    program.scene.environment_rotation = cc.axis_angle((0, 1, 0), 360 * frame / FRAMES)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    show: Literal["picture", "formula", "difference"] = "picture",
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; without a `format` it is made for a screen: tone curve "neutral", sRGB, uint8.

    show : "picture": as the renderer draws it. "formula": as `formula` computes it, over the same background.
    "difference": 20 times the absolute difference of both, linear.
    """
    if show not in ("picture", "formula", "difference"):
        raise ValueError(f'show: expected "picture", "formula" or "difference", got {show!r}')
    turn(program, frame)
    screen = "format" not in options
    if show == "picture":
        if screen:
            options = {"tonemap": "neutral", "encode": "srgb", **options}
        return picture(renderer, program.scene, program.camera, size, options)
    options = {**options, "format": "rgba32f", "outputs": ("position", "normal", "id")}
    drawn = renderer.render(program.scene, program.camera, size, **options)
    color = formula(program, drawn)
    if show == "difference":
        color[..., :3] = 20 * np.abs(color - drawn.color)[..., :3]
    return cc.to_screen(color) if screen else color


def formula(program: Program, frame: cc.Frame) -> Picture:
    """Compute the picture in numpy, (H, W, 4), from a frame's positions, normals and ids."""
    color = np.array(frame.color)
    to_world = _matrix(program.scene.environment_rotation)  # from the photograph's directions
    for ball, (metallic, roughness) in zip(
        program.balls, [(m, r) for m in METALLIC for r in ROUGHNESS], strict=True
    ):
        here = frame.id == ball.id
        normal = frame.normal[here].astype(np.float64)
        incident = frame.position[here] - program.camera.position
        incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
        n_dot_v = np.clip(-(normal * incident).sum(axis=-1), 1e-4, 1)

        # The lobe of a rough surface leans from the mirror's direction towards the normal (Lagarde and de
        # Rousiers, "Moving Frostbite to PBR", 2014).
        alpha = roughness**2
        share = (1 - alpha) * (np.sqrt(1 - alpha) + alpha)
        towards = normal + share * (cc.reflect(incident, normal) - normal)
        radiance = _looked_up(program.levels, towards @ to_world, roughness)
        around = program.irradiance.sample(normal @ to_world)[:, :3].astype(np.float64)

        scale, bias = cc.brdf(n_dot_v, roughness).T[..., None]
        base = np.asarray(COLOR)
        metal, _ = _reflected(program, base, scale, bias, radiance, around)
        f0 = ((IOR - 1) / (IOR + 1)) ** 2
        gloss, taken = _reflected(program, np.full(3, f0), scale, bias, radiance, around)
        plastic = gloss + base * (1 - taken) * around
        color[here, :3] = metallic * metal + (1 - metallic) * plastic
    return color


def _reflected(
    program: Program, f0: Floats, scale: Floats, bias: Floats, radiance: Floats, around: Floats
) -> tuple[Floats, Floats]:
    """Give what a surface with the reflectance `f0` reflects, and which share of the light that is.

    The light that meets the surface several times comes from all around (C. Fdez-Aguera, "A Multiple-Scattering
    Microfacet Model for Real-Time Image-based Lighting", JCGT 8(1), 2019).
    """
    once = f0 * scale + bias
    if not program.multiple_scattering:
        return once * radiance, once.max(axis=-1, keepdims=True)
    lost = 1 - (scale + bias)
    mean = f0 + (1 - f0) / 21  # the mean of Schlick's curve
    again = once * mean / (1 - mean * lost) * lost
    return once * radiance + again * around, (once + again).max(axis=-1, keepdims=True)


def _looked_up(levels: tuple[cc.CubeMap, ...], directions: Floats, roughness: float) -> Floats:
    """Look up between the two levels whose roughnesses are nearest."""
    last = len(levels) - 1
    lower = min(int(roughness * last), last - 1)
    share = roughness * last - lower
    near, far = (level.sample(directions)[:, :3] for level in levels[lower : lower + 2])
    return np.asarray((1 - share) * near + share * far, np.float64)


def _matrix(rotation: npt.ArrayLike) -> Floats:
    """Give the matrix (3, 3) of a quaternion (w, x, y, z)."""
    w, *v = np.asarray(rotation, np.float64)
    cross = np.cross(np.eye(3), v)
    return np.asarray(np.eye(3) + 2 * w * cross + 2 * cross @ cross)


def live(renderer: cc.Renderer | None = None, *, document: bool = False) -> Viewer:
    """Show the program live: the photograph turns, and a drag turns the balls."""
    program = build(document=document)
    return live_view(
        program,
        SIZE,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: turn(program, frame)),
        screen=True,
    )
