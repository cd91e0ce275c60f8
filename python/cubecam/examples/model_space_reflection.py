"""P6: reflection in model space, from a cubemap of one image (document 003).

One picture holds all six faces as a cross; its shape tells the layout. The shader gets the eye in
model space, inverse(view * model) * (0, 0, 0, 1), reflects there with the mesh's own normal, and
takes the result to the world by mat3(model). The left teapot is made so; the right one reflects in
world space, as P4 does. Their matrices differ only in their place.

Look for: the two show the same photographs, as two mirrors side by side do. A rotation and one
scale for all axes keep angles, so both spaces give the same reflection.

Worth trying: with ``build(stretch=(2, 1, 1))`` the directions differ by up to 73 degrees, because
mat3(model) changes the angle of a direction that is already reflected. The teapot on the right is
correct. ``build(per_vertex=True)`` reflects at the vertices and interpolates, as the document does; on
a mesh of few triangles the picture shows kinks along their edges, so try
``mesh=cubecam.Mesh.icosphere(0.75, subdivisions=1)`` with it. ``build(skybox=True)`` is the
document's RENDER_SKYBOX. The eye in model space is a number of one camera; a probe that sees the
teapot looks from elsewhere, and would need ``inverse(model_matrix()) * vec4(eye_position(), 1)``,
in the shader.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import cubecam as cc

from ._common import Photographs, Picture, picture, surroundings, teapot
from ._live import Clock, Followed, live_view

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from cubecam.typing import RenderOptions
    from cubecam.viewer import Viewer

PROGRAM = "P6"
TITLE = "Reflection in model space, from a cubemap of one image"
FRAMES = 90  # one turn
STILL = 7
SIZE = (512, 256)

FOV, EYE = 28.0, (0.0, 0.8, 4.0)  # degrees, world units
APART = 0.95  # world units from the middle to each teapot
TEAPOT = 1.5  # largest extent, world units
TURN = 4.0  # degrees a frame round Y

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
class Program:
    """`model` is reflected in model space, `world` in world space; both turn."""

    scene: cc.Scene
    camera: cc.PerspectiveCamera
    model: cc.Node
    world: cc.Node
    material: cc.ShaderMaterial


def cross(images: Photographs | None = None) -> Picture:
    """Make one picture of six photographs, 4 N x 3 N, as a stand-in for the document's cm.jpg."""
    return surroundings(images).to_layout("cross")


def build(
    image: str | os.PathLike[str] | npt.NDArray[np.generic] | None = None,
    stretch: tuple[float, float, float] = (1.0, 1.0, 1.0),
    per_vertex: bool = False,
    skybox: bool = False,
    mesh: cc.Mesh | None = None,
    *,
    document: bool = False,
) -> Program:
    """Make the scene.

    image : path or array (H, W, C) of one picture that holds six faces; its shape tells the layout.
    stretch : scale of both along their own axes. mesh : in place of the teapot.
    """
    if image is None:
        image = cross()
    cubemap = (
        cc.CubeMap.from_layout(image) if isinstance(image, np.ndarray) else cc.load_cubemap(image)
    )
    scene = cc.Scene(environment=cubemap, background=None if skybox else (0, 0, 0, 1))
    material = cc.ShaderMaterial(
        FRAGMENT_OF_VERTEX if per_vertex else FRAGMENT,
        vertex=VERTEX if per_vertex else None,
        textures={"textureCubeMap": cubemap},
        displacement=0,  # the vertex function moves no vertex
    )
    shape = teapot(TEAPOT) if mesh is None else mesh
    model = scene.add(shape, material, position=(-APART, 0, 0), scale=stretch)
    world = scene.add(shape, cc.MirrorMaterial(), position=(APART, 0, 0), scale=stretch)
    camera = cc.PerspectiveCamera(fov=FOV, position=EYE, target=(0, 0, 0))
    return Program(scene, camera, model, world, material)


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
    """Draw a frame: both teapots have turned by 4 degrees a frame."""
    turn(program, frame)
    return picture(renderer, program.scene, program.camera, size, options)


def turn(program: Program, frame: float) -> None:
    """Turn both teapots, and tell the shader where the eye is in model space."""
    for node in (program.model, program.world):
        node.rotation = cc.axis_angle((0, 1, 0), TURN * frame)
    program.material.uniforms = {
        "camPosModel": eye_in_model_space(program.camera, program.model),
        "matModelToWorld": program.model.world_matrix[:3, :3],
    }


def live(
    image: str | os.PathLike[str] | npt.NDArray[np.generic] | None = None,
    stretch: tuple[float, float, float] = (1.0, 1.0, 1.0),
    per_vertex: bool = False,
    skybox: bool = False,
    renderer: cc.Renderer | None = None,
    *,
    document: bool = False,
) -> Viewer:
    """Show the program live: the teapots turn, and a drag moves the camera round them."""
    program = build(image, stretch, per_vertex, skybox, document=document)
    clock = Clock(lambda frame, _: turn(program, frame))
    # The shader must know the eye's new place, also while the clock stands still.
    controls = Followed(lambda: turn(program, clock.frame))
    return live_view(program, SIZE, TITLE, renderer, controls=controls, clock=clock)
