"""P11: the parts of a framebuffer (document 004, sections 7.4 and 7.4.3).

A framebuffer has colour buffers, a depth buffer and sometimes a stencil buffer, each in a format:
RGBA8 or RGB565, DEPTH_COMPONENT16, STENCIL_INDEX8. One pass can fill several colour buffers: here
colour, distance, normal, position, id, and two that the shader of this program declares itself, `paint` and `light`.
A framebuffer may also have only a depth buffer: a shadow map is such a framebuffer, drawn from the lamp.

Look for, row by row: the colour in RGBA8, and in RGB565, in bands of 32, 64 and 32 steps; the two buffers of the
shader: what the surfaces are painted with, and the light that falls on them, whose product is the colour without
its highlights. Then normals and positions as colours, a colour for each id, and the distance from the eye, dark
near it. Then the depth of 16 bits, which has most of its steps near the camera, so that all is light, and the
same, stretched; the stencil, which counts the surfaces that cover a pixel, hidden ones included; and the
shadow map, light near the lamp.

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

from ._common import LIGHT, Picture, bunny, on_circle, teapot
from ._labels import panels
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import Encode, Tonemap
    from cubecam.viewer import Viewer

PROGRAM = "P11"
TITLE = "The parts of a framebuffer, two of them outputs of the shader itself"
FRAMES = 120  # one turn
STILL = 50
COLUMNS, ROWS = 4, 3
SIZE = (1024, 768)  # four by three pictures

GREY = (0.4, 0.4, 0.4, 1.0)
NEAR, FAR = 1.0, 20.0  # world units
SHADOW = 512  # pixels along an edge of the shadow map
TURN = 3.0  # degrees a frame
OUTPUTS = ("distance", "z", "normal", "position", "id", "depth")
#: The colour buffers that the shader declares.
OWN = ("paint", "light")
#: The Phong model of document 000 in two factors, and its highlights. Each `out` is a colour buffer of the pass.
SHADER = """
    uniform vec3 color;
    uniform float ka, kd, ks, shininess;
    out vec3 paint;
    out vec3 light;

    vec3 shade(Surface surface) {
        paint = color;
        light = phong(surface, vec3(1.0), ka, kd, 0.0, shininess);
        vec3 highlight = phong(surface, vec3(0.0), 0.0, 0.0, ks, shininess);
        return paint * light + highlight;
    }
"""


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    background: tuple[float, float, float, float]
    cone: (
        float | None
    )  # degrees from the lamp's axis to the edge of its light; None: it shines all around
    lamp: tuple[float, float, float]
    ka: float
    ground: tuple[float, float, float]  # its colour
    grown: float  # a factor of the things
    eye: tuple[float, float, float]
    still: int  # the best frame for a single picture


DOCUMENT = Stage(GREY, None, LIGHT, 0.2, (0.6, 0.6, 0.7), 1.0, (0, 2.5, 5), 0)
#: A lamp with one shadow map, whose light fades on the ground, and things that fill the small pictures.
STAGED = Stage(
    (0.2, 0.24, 0.3, 1.0), 27.0, (2.5, 6, 5), 0.3, (0.85, 0.82, 0.75), 1.25, (0, 3.4, 4.2), STILL
)


@dataclass
class Program:
    """`ring` turns; `things` stand on it, above `ground`."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    lamp: cc.PointLight | cc.SpotLight
    ground: cc.Node
    ring: cc.Node
    things: tuple[cc.Node, ...]
    still: int


def build(*, document: bool = False) -> Program:
    """Make the scene: bunny, teapot and box on a ground under one lamp that throws shadows."""
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=stage.background)
    shadow = cc.Shadow(size=SHADOW)
    lamp: cc.PointLight | cc.SpotLight
    if stage.cone is None:
        lamp = cc.PointLight(position=stage.lamp, shadow=shadow)
    else:
        down = tuple(-x for x in stage.lamp)
        lamp = cc.SpotLight(stage.lamp, down, angle=stage.cone, penumbra=0.4, shadow=shadow)
    scene.add(lamp)
    grown = stage.grown
    ground = scene.add(
        cc.Mesh.plane(8, 8), _material(stage.ground, stage.ka, 0), position=(0, -0.6 * grown, 0)
    )
    ring = scene.add()
    things = (
        (bunny(1.2 * grown), (0.4, 1.0, 0.4)),
        (teapot(1.2 * grown), (1.0, 0.4, 0.4)),
        (cc.Mesh.box(0.8 * grown), (0.4, 0.4, 1.0)),
    )
    nodes = tuple(
        scene.add(
            mesh,
            _material(color, stage.ka, 1),
            position=on_circle(1.4, 0, math.radians(360 * index / len(things))),
            parent=ring,
        )
        for index, (mesh, color) in enumerate(things)
    )
    camera = cc.PerspectiveCamera(fov=45, position=stage.eye, target=(0, 0, 0), near=NEAR, far=FAR)
    return Program(scene, camera, lamp, ground, ring, nodes, stage.still)


def _material(color: tuple[float, float, float], ka: float, ks: float) -> cc.ShaderMaterial:
    """Make the material of `SHADER`, which also counts its surfaces in the stencil buffer."""
    return cc.ShaderMaterial(
        SHADER,
        uniforms={"color": color, "ka": ka, "kd": 0.7, "ks": ks, "shininess": 10},
        stencil=cc.Stencil(depth_pass="incr", depth_fail="incr"),
    )


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

    "color", "distance", "z", "normal", "position", "id" and "depth", and the shader's own "paint" and "light", are of
    one pass with a depth buffer of 16 bits, "rgb565" is of one with 16 bits for a colour, "stencil" of one with a
    stencil buffer beside the depth, "depth_only" of one without any colour buffer, and "shadow" is the lamp's map:
    six faces, or one picture of a lamp with a cone.
    """
    place(program, frame)
    return _parts(program, renderer, size, **options)


def place(program: Program, frame: float) -> None:
    """Turn the ring: 3 degrees a frame."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)


def _parts(
    program: Program, renderer: cc.Renderer, size: tuple[int, int], **options: Unpack[Look]
) -> dict[str, Part]:
    scene, camera = program.scene, program.camera
    drawn = renderer.render(
        scene, camera, size, outputs=OUTPUTS + OWN, depth_format="depth_component16", **options
    )
    small = renderer.render(scene, camera, size, format="rgb565", **options)
    counted = renderer.render(
        scene, camera, size, outputs=("stencil",), depth_format="depth24_stencil8", **options
    )
    alone = renderer.render(scene, camera, size, outputs=("depth",), format=None)
    return {
        "color": drawn.color,
        **{name: getattr(drawn, name) for name in OUTPUTS},
        **{name: drawn.outputs[name] for name in OWN},
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
) -> Picture:
    """Draw a frame as four by three pictures, uint8. `format` is not an option, since each picture has its own."""
    place(program, frame)
    return _sheet(program, renderer, size, **options)


def _sheet(
    program: Program, renderer: cc.Renderer, size: tuple[int, int], **options: Unpack[Look]
) -> Picture:
    cell = (max(size[0] // COLUMNS, 1), max(size[1] // ROWS, 1))
    part = _parts(program, renderer, cell, **options)
    depth, distance = part["depth"], part["distance"]
    seen = depth[depth < 1]
    least, most = (seen.min(), seen.max()) if seen.size else (0.0, 1.0)
    # Ids that follow each other get colours that differ much.
    hues = (part["id"][..., None] * np.array([0.37, 0.61, 0.83])) % 1
    rows = (
        (
            ("colour, RGBA8", part["color"]),
            ("colour, RGB565", part["rgb565"]),
            ("own output: paint", part["paint"]),
            ("own output: light", part["light"]),
        ),
        (
            ("normal", part["normal"] / 2 + 0.5),
            ("position", np.nan_to_num(part["position"] / 4 + 0.5, nan=0.4)),
            ("id", np.where(part["id"][..., None] > 0, hues, 0)),
            ("distance", _grey((distance - 2) / 7)),
        ),
        (
            ("depth, 16 bits", _grey(depth)),
            ("the same, stretched", _grey((depth - least) / max(most - least, 1e-6))),
            ("stencil, 8 bits", _grey(part["stencil"] / 4)),
            ("shadow map", _grey(_shadow(program, part["shadow"], cell))),
        ),
    )
    sheet: Picture = panels([[(name, _bytes(shown)) for name, shown in row] for row in rows])
    return sheet


def live(renderer: cc.Renderer | None = None, *, document: bool = False) -> Viewer:
    """Show all parts live: a drag moves the camera of all pictures."""
    program = build(document=document)
    return live_view(
        program,
        SIZE,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: place(program, frame)),
        draw=lambda renderer, size, samples: _sheet(program, renderer, size, samples=samples),
        cells=(COLUMNS, ROWS),
    )


def _grey(values: Part) -> Part:
    return np.repeat(np.asarray(values, np.float64)[..., None], 3, axis=2)


def _shadow(program: Program, shadow: Part, cell: tuple[int, int]) -> Part:
    """Return the lamp's map as a picture of the cell's size, light near the lamp.

    Of the six faces of a lamp that shines all around, the two that see the things: -Y beside -X.
    """
    shown: Part
    if len(shadow) == 6:
        shown = (9 - shadow[[3, 1]]) / 6
    else:
        away = math.hypot(*program.lamp.position.tolist())  # of the ring's middle
        shown = (away + 1.5 - shadow) / 3.5
    pair = np.concatenate(list(np.clip(shown, 0, 1)), axis=1)
    width, height = cell
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
