"""P7: translucent objects after opaque ones (document 004, section 7.4.1).

Opaque objects are drawn first. Translucent objects follow from far to near, with the depth test on, so
that opaque objects hide them, and depth writes off, so that they do not hide each other. Colours are
blended with SRC_ALPHA, ONE_MINUS_SRC_ALPHA. The renderer does all this for a material whose opacity is
below 1. Alpha is blended separately, with ZERO, ONE: it stays 1 over an opaque background, so that a web
page behind the picture does not show through.

Look for: a green ball and a red and a blue pane stand in front of the bunny. Each tints what is behind it,
and where several lie behind each other, the light passes all of them: bunny, ball and panes stay visible.
What stands behind the bunny is hidden by it, as the yellow pane is.

``build(blend="plain")`` blends the alpha with the same two factors as the colours, which is the pair that
most programs use. A surface of alpha a then leaves a a + 1 (1 - a) behind: .75 for the red pane's .5, although
everything is opaque. ``draw(..., page=True)`` lays the picture over a web page of light and dark squares, as
a browser does: the squares shine through every translucent surface, and through nothing else.

Worth trying: opacity 1 for one of the panes. It is drawn with the opaque things then, and what is
behind it is gone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import cubecam as cc

from ._common import LIGHT, Picture, bunny, on_circle, picture, squares
from ._live import Clock, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P7"
TITLE = "Translucent panes and balls, drawn from far to near after the opaque bunny"
FRAMES = 120  # one turn of the ring
STILL = 0
SIZE = (512, 512)

TURN = 3.0  # degrees a frame
#: Colour and opacity of the panes and balls of the document's scene.
PANES = (((1.0, 0.2, 0.1), 0.5), ((0.1, 0.8, 0.2), 0.35), ((0.1, 0.3, 1.0), 0.6))
BALLS = (((1.0, 0.8, 0.1), 0.4), ((0.7, 0.1, 0.9), 0.55))

Vector: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Thing:
    """A pane or a ball of the ring: where it stands at frame 0, and what it looks like."""

    kind: Literal["pane", "ball"]
    color: Vector
    opacity: float
    degrees: float  # round +Y; 270 is in front of the bunny
    radius: float = 1.5  # of its path, world units


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    background: tuple[float, float, float, float]
    ground: float  # its edge, world units
    squares: int  # of the ground's pattern, along an edge; 1: one colour
    bunny: float  # its largest extent, world units
    ka: float
    pane: Vector  # edges
    ball: float  # radius
    eye: Vector
    fov: float  # degrees
    things: tuple[Thing, ...]
    still: int = 0  # the best frame for a single picture


#: Panes and balls in turn, at equal angles; the background is white, as the page of most web sites.
DOCUMENT = Stage(
    background=(1.0, 1.0, 1.0, 1.0),
    ground=4,
    squares=1,
    bunny=1.5,
    ka=0.2,
    pane=(1.1, 1.3, 0.04),
    ball=0.4,
    eye=(0, 1.5, 5),
    fov=45,
    things=(
        Thing("pane", *PANES[0], 0),
        Thing("ball", *BALLS[0], 72),
        Thing("pane", *PANES[1], 144),
        Thing("ball", *BALLS[1], 216),
        Thing("pane", *PANES[2], 288),
    ),
    still=60,
)

#: Panes and balls overlap in front of the bunny, and stand on a ground of squares that shows what is tinted.
STAGED = Stage(
    background=(0.66, 0.74, 0.82, 1.0),
    ground=7,
    squares=10,
    bunny=2.6,
    ka=0.4,
    pane=(1.7, 1.7, 0.04),
    ball=0.5,
    eye=(0, 1.7, 7),
    fov=36,
    things=(
        Thing("pane", (1.0, 0.15, 0.1), 0.5, 250, 2.0),
        Thing("ball", (0.1, 0.85, 0.2), 0.45, 268, 1.65),
        Thing("pane", (0.1, 0.25, 1.0), 0.45, 286, 2.4),
        Thing("ball", (0.75, 0.1, 0.9), 0.55, 12, 1.9),
        Thing("pane", (1.0, 0.8, 0.1), 0.5, 85, 1.7),
    ),
)

#: What a browser does with a picture whose alpha is below 1: its colours count as multiplied with the alpha.
_PAGE = """
    vec4 effect(vec2 uv) {
        ivec2 square = ivec2(gl_FragCoord.xy) / 16;
        vec3 page = vec3((square.x + square.y) % 2 == 0 ? 1.0 : 0.45);
        vec4 picture = frame_pixel(ivec2(gl_FragCoord.xy));
        return vec4(picture.rgb + (1.0 - picture.a) * page, 1.0);
    }
"""

Pair: TypeAlias = Literal["separate", "plain"]
_BLENDS: dict[Pair, cc.Blend | Literal["alpha_keep"]] = {
    # SRC_ALPHA, ONE_MINUS_SRC_ALPHA for colours, and ZERO, ONE for the alpha.
    "separate": "alpha_keep",
    "plain": cc.Blend("src_alpha", "one_minus_src_alpha"),
}


@dataclass
class Program:
    """`ring` turns, with the nodes `translucent`; `page` is what lies behind the picture in a browser."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    ring: cc.Node
    opaque: tuple[cc.Node, ...]
    translucent: tuple[cc.Node, ...]
    page: cc.ImageEffect
    still: int


def build(blend: Pair = "separate", *, document: bool = False) -> Program:
    """Make the scene: an opaque bunny on a ground, three panes and two balls round it.

    blend : "separate": the alpha of the picture stays; "plain": alpha is blended as if it were a colour.
    document : whether to make the document's own scene.
    """
    stage = DOCUMENT if document else STAGED
    scene = cc.Scene(background=stage.background)
    scene.add(cc.PointLight(position=LIGHT))
    half = -stage.bunny / 2
    paint = cc.PhongMaterial(color=(0.8, 0.8, 0.8), ks=0, ka=stage.ka)
    if stage.squares > 1:
        paint.map = squares(stage.squares)
    ground = scene.add(cc.Mesh.plane(stage.ground, stage.ground), paint, position=(0, half, 0))
    body = scene.add(
        bunny(stage.bunny), cc.PhongMaterial(color=(0.8, 0.6, 0.5), ks=0.3, ka=stage.ka)
    )
    ring = scene.add()
    meshes = {"pane": cc.Mesh.box(stage.pane), "ball": cc.Mesh.sphere(stage.ball)}
    translucent = tuple(
        scene.add(
            meshes[thing.kind],
            cc.PhongMaterial(color=thing.color, ks=0.5, ka=stage.ka, opacity=thing.opacity),
            position=on_circle(thing.radius, 0, math.radians(thing.degrees)),
            rotation=cc.axis_angle((0, 1, 0), thing.degrees + 90),
            parent=ring,
        )
        for thing in stage.things
    )
    camera = cc.PerspectiveCamera(
        fov=stage.fov, position=stage.eye, target=(0, 0, 0), near=1, far=100
    )
    program = Program(
        scene, camera, ring, (ground, body), translucent, cc.ImageEffect(_PAGE), stage.still
    )
    set_blend(program, blend)
    return program


def set_blend(program: Program, blend: Pair) -> None:
    """Choose the factors of the alpha: "separate" or "plain"."""
    if blend not in _BLENDS:
        raise ValueError(f'blend: expected "separate" or "plain", got {blend!r}')
    for node in program.translucent:
        assert node.material is not None
        node.material.blend = _BLENDS[blend]


def place(program: Program, frame: float) -> None:
    """Turn the ring: 3 degrees a frame."""
    program.ring.rotation = cc.axis_angle((0, 1, 0), TURN * frame)


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    page: bool = False,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame; page: whether the picture is laid over a web page, which shows where its alpha is below 1."""
    place(program, frame)
    if page:
        options = {**options, "effects": [*options.get("effects", ()), program.page]}
    return picture(renderer, program.scene, program.camera, size, options)


def live(
    renderer: cc.Renderer | None = None, *, blend: Pair = "separate", document: bool = False
) -> Viewer:
    """Show the program live over a web page: a drag moves the camera, and b changes how alpha is blended."""
    program = build(blend, document=document)
    pairs: list[Pair] = ["separate", "plain"]
    if blend == "plain":
        pairs.reverse()

    def exchange() -> None:
        pairs.reverse()
        set_blend(program, pairs[0])

    def drawn(renderer: cc.Renderer, size: tuple[int, int], samples: int) -> Picture:
        # With the separate factors the page is hidden everywhere.
        options: RenderOptions = {"samples": samples}
        if pairs[0] == "plain":
            options["effects"] = [program.page]
        return picture(renderer, program.scene, program.camera, size, options)

    return live_view(
        program,
        SIZE,
        TITLE,
        renderer,
        clock=Clock(lambda frame, _: place(program, frame)),
        keys={"b": (exchange, "alpha: separate factors, or the plain pair")},
        draw=drawn,
    )
