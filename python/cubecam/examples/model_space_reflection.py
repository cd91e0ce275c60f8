"""P6: reflection in model space, from a cubemap of one image (document 003).

One picture holds all six faces as a cross, here shown in the middle; its shape tells the layout. The
shader gets the eye in model space, inverse(view * model) * (0, 0, 0, 1), reflects there with the mesh's
own normal, and takes the result to the world by mat3(model). The teapots on the left are made so; those
on the right reflect in world space, as P4 does. The two of a row differ only in their place.

Look for: above, both teapots show the same room, as two mirrors side by side do. A rotation and one
scale for all axes keep angles, so both spaces give the same reflection. Below, the teapots are twice as
long as they should be, diag(2, 1, 1), and the left one is wrong, by up to 73 degrees, because
mat3(model) changes the angle of a direction that is already reflected.

Worth trying: ``build(stretch=(1, 3, 1))`` stretches the lower row otherwise. ``build(document=True)`` has
one row and, like the document, neither the cross nor words; there ``stretch`` is that of its two teapots.
``build(per_vertex=True)`` reflects at the vertices and interpolates, as the document does; on
a mesh of few triangles the picture shows kinks along their edges, so try
``mesh=cubecam.Mesh.icosphere(0.75, subdivisions=1)`` with it. ``build(skybox=True)`` is the
document's RENDER_SKYBOX. The eye in model space is a number of one camera; a probe that sees the
teapot looks from elsewhere, and would need ``inverse(model_matrix()) * vec4(eye_position(), 1)``,
in the shader.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import cubecam as cc

from ._common import Photographs, Picture, picture, surroundings, teapot
from ._labels import Corner, label
from ._live import Clock, Followed, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P6"
TITLE = "Reflection in model space, from a cubemap of one image"
FRAMES = 90  # one turn
STILL = 84
SIZE = (768, 384)

TURN = 4.0  # degrees a frame round Y


@dataclass(frozen=True)
class Row:
    """A teapot reflected in model space and one reflected in world space."""

    height: float  # of their middle, world units
    teapot: float  # largest extent before it is stretched, world units
    stretched: bool


@dataclass(frozen=True)
class Stage:
    """What differs between the document's scene and the staged one."""

    sample: str  # the photographs
    fov: float  # degrees
    eye: tuple[float, float, float]
    apart: float  # world units from the middle to each teapot
    rows: tuple[Row, ...]
    stretch: tuple[float, float, float]
    explained: bool  # whether the picture shows the cross, and words
    size: tuple[int, int]
    still: int


DOCUMENT = Stage(
    "sunset.exr",
    28.0,
    (0.0, 0.8, 4.0),
    0.95,
    (Row(0.0, 1.5, True),),
    (1.0, 1.0, 1.0),
    False,
    (512, 256),
    7,
)
STAGED = Stage(
    "interior.exr",
    15.5,
    (0.0, 1.6, 8.0),  # far away, so that both teapots of a row are seen from nearly the same side
    1.42,
    (Row(0.42, 1.3, False), Row(-0.48, 0.75, True)),
    (2.0, 1.0, 1.0),
    True,
    SIZE,
    STILL,
)
#: The words of the four corners: above and below, of the left and the right teapot.
WORDS = (
    ("reflected in model space", "in world space"),
    ("stretched: wrong", "stretched: right"),
)
CORNERS: tuple[tuple[Corner, Corner], tuple[Corner, Corner]] = (
    ("top left", "bottom left"),
    ("top right", "bottom right"),
)
#: Width and height of the cross, world units.
CROSS = (1.48, 1.11)

#: The function that both shaders share: the document's lines, with its names.
REFLECTION = """
uniform vec3 camPosModel;
uniform mat3 matModelToWorld;

vec3 reflection(vec3 position, vec3 normal) {
    vec3 eyeDir = normalize(position - camPosModel);
    return matModelToWorld * reflect(eyeDir, normal);
}
"""
#: Per fragment: the mesh's position and normal are interpolated, then reflected.
FRAGMENT = (
    REFLECTION
    + """
uniform samplerCube textureCubeMap;

vec3 shade(Surface surface) {
    vec3 normal = normalize(surface.normal_object);
    return texture(textureCubeMap, reflection(surface.position_object, normal)).rgb;
}
"""
)
#: Per vertex, as the document has it: reflected first, then interpolated. v_ is the renderer's, hence the name.
VERTEX = (
    REFLECTION
    + """
out vec3 reflectionVector;

void vertex(inout Vertex vertex) {
    reflectionVector = reflection(vertex.position, vertex.normal);
}
"""
)
FRAGMENT_OF_VERTEX = """
uniform samplerCube textureCubeMap;
in vec3 reflectionVector;

vec3 shade(Surface surface) {
    return texture(textureCubeMap, reflectionVector).rgb;
}
"""


@dataclass
class Pair:
    """`model` is reflected in model space, by `material`, and `world` in world space."""

    model: cc.Node
    world: cc.Node
    material: cc.ShaderMaterial


@dataclass
class Program:
    """`pairs` turn; `model`, `world` and `material` are those of the last pair, which may be stretched."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    pairs: tuple[Pair, ...]
    explained: bool
    size: tuple[int, int]
    still: int

    @property
    def model(self) -> cc.Node:
        """The node that is reflected in model space."""
        return self.pairs[-1].model

    @property
    def world(self) -> cc.Node:
        """The node that is reflected in world space."""
        return self.pairs[-1].world

    @property
    def material(self) -> cc.ShaderMaterial:
        """The material of `model`."""
        return self.pairs[-1].material


def cross(images: Photographs | None = None, sample: str = STAGED.sample) -> Picture:
    """Make one picture of six photographs, 4 N x 3 N, as a stand-in for the document's cm.jpg."""
    return surroundings(images, sample).to_layout("cross")


def build(
    image: str | os.PathLike[str] | npt.NDArray[np.generic] | None = None,
    stretch: tuple[float, float, float] | None = None,
    per_vertex: bool = False,
    skybox: bool = False,
    mesh: cc.Mesh | None = None,
    *,
    document: bool = False,
) -> Program:
    """Make the scene.

    image : path or array (H, W, C) of one picture that holds six faces; its shape tells the layout. stretch : scale of
    the stretched teapots along their own axes; by default 1 in the document's scene, 2 along X in the staged one.
    mesh : in place of the teapot.
    """
    stage = DOCUMENT if document else STAGED
    if image is None:
        image = cross(sample=stage.sample)
    cubemap = (
        cc.CubeMap.from_layout(image) if isinstance(image, np.ndarray) else cc.load_cubemap(image)
    )
    scene = cc.Scene(environment=cubemap, background=None if skybox else (0, 0, 0, 1))
    pairs = []
    for row in stage.rows:
        material = cc.ShaderMaterial(
            FRAGMENT_OF_VERTEX if per_vertex else FRAGMENT,
            vertex=VERTEX if per_vertex else None,
            textures={"textureCubeMap": cubemap},
            displacement=0,  # the vertex function moves no vertex
        )
        shape = teapot(row.teapot) if mesh is None else mesh
        scale = (stretch or stage.stretch) if row.stretched else (1.0, 1.0, 1.0)
        model, world = (
            scene.add(shape, paint, position=(x, row.height, 0), scale=scale)
            for x, paint in ((-stage.apart, material), (stage.apart, cc.MirrorMaterial()))
        )
        pairs.append(Pair(model, world, material))
    camera = cc.PerspectiveCamera(fov=stage.fov, position=stage.eye, target=(0, 0, 0))
    if stage.explained:
        # The plane lies in XZ; upright it faces +Z, and tilted back it faces the eye.
        upright = cc.axis_angle(
            (1, 0, 0), 90 - math.degrees(math.atan2(stage.eye[1], stage.eye[2]))
        )
        shown = cc.Image(cubemap.to_layout("cross"), mipmaps=True)
        scene.add(cc.Mesh.plane(*CROSS), cc.BasicMaterial(map=shown), rotation=upright)
    return Program(scene, camera, tuple(pairs), stage.explained, stage.size, stage.still)


def eye_in_model_space(camera: cc.PerspectiveCamera, node: cc.Node) -> npt.NDArray[np.float64]:
    """Give inverse(view * model) * (0, 0, 0, 1), three numbers."""
    inverse = np.asarray(np.linalg.inv(camera.view @ node.world_matrix), np.float64)
    eye: npt.NDArray[np.float64] = inverse[:3, 3]
    return eye


def degrees_apart(camera: cc.PerspectiveCamera, node: cc.Node) -> npt.NDArray[np.float64]:
    """Give the angle between the document's direction and the right one at each vertex that faces the eye."""
    mesh, matrix = node.mesh, np.asarray(node.world_matrix)
    assert mesh is not None
    linear = matrix[:3, :3]
    positions, normals = mesh.positions.astype(np.float64), mesh.normals.astype(np.float64)
    document = _reflect(positions - eye_in_model_space(camera, node), normals) @ linear.T
    incident = positions @ linear.T + matrix[:3, 3] - camera.position
    normals = normals @ np.linalg.inv(linear)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    right = _reflect(incident, normals)
    seen = (incident * normals).sum(axis=-1) < 0
    cosine = (document * right).sum(axis=-1) / (
        np.linalg.norm(document, axis=-1) * np.linalg.norm(right, axis=-1)
    )
    angles: npt.NDArray[np.float64] = np.degrees(np.arccos(np.clip(cosine[seen], -1, 1)))
    return angles


def _reflect(
    incident: npt.NDArray[np.float64], normal: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    bounced: npt.NDArray[np.float64] = (
        incident - 2 * (incident * normal).sum(axis=-1, keepdims=True) * normal
    )
    return bounced


def draw(
    program: Program,
    renderer: cc.Renderer,
    frame: int,
    size: tuple[int, int] = SIZE,
    **options: Unpack[RenderOptions],
) -> Picture:
    """Draw a frame: the teapots have turned by 4 degrees a frame."""
    turn(program, frame)
    return _explained(program, renderer, size, options)


def turn(program: Program, frame: float) -> None:
    """Turn the teapots, and tell the shaders where the eye is in model space."""
    for pair in program.pairs:
        for node in (pair.model, pair.world):
            node.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
        pair.material.uniforms = {
            "camPosModel": eye_in_model_space(program.camera, pair.model),
            "matModelToWorld": pair.model.world_matrix[:3, :3],
        }


def _explained(
    program: Program, renderer: cc.Renderer, size: tuple[int, int], options: RenderOptions
) -> Picture:
    """Draw the scene and, if the program wants them, the words of the four corners."""
    shown = picture(renderer, program.scene, program.camera, size, options)
    if program.explained:
        for words, left, right in zip(WORDS, *CORNERS, strict=True):
            shown = label(label(shown, words[0], left), words[1], right)
    return shown


def live(
    image: str | os.PathLike[str] | npt.NDArray[np.generic] | None = None,
    stretch: tuple[float, float, float] | None = None,
    per_vertex: bool = False,
    skybox: bool = False,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: the teapots turn, and a drag moves the camera round them and the cross."""
    program = build(image, stretch, per_vertex, skybox, document=document)
    clock = Clock(lambda frame, _: turn(program, frame))
    # The shader must know the eye's new place, also while the clock stands still.
    controls = Followed(lambda: turn(program, clock.frame))
    return live_view(
        program,
        program.size,
        TITLE,
        renderer,
        controls=controls,
        clock=clock,
        draw=lambda drawer, size, samples: _explained(program, drawer, size, {"samples": samples}),
    )
