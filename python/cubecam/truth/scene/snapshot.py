"""A scene at one moment as plain data, which worker processes can be given: no nodes and no OpenGL."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ..._core import (
    AmbientLight,
    Blend,
    CubeMap,
    DirectionalLight,
    Material,
    Node,
    PlanarMirror,
    PointLight,
    Probe,
    ProbeBlend,
    RenderTexture,
    Scene,
    SpotLight,
)
from ..._drawn_meshes import DrawnMesh, drawn_mesh
from ..._nodes import holds, shown_nodes, upwards
from ..._rotations import rotation_matrix
from ..arrays import Array, Ints
from ..shading import Directional, Point, Spot
from .material_records import MaterialReader, blends
from .records import BlendRecord, MaterialRecord, NodeRecord, Radiance
from .refusals import check_depth_write, check_gathering, kind_of

__all__ = ["BlendRecord", "NodeRecord", "Radiance", "Snapshot", "read"]


@dataclass
class Snapshot:
    """The triangles of all visible nodes in world space, and all that shades them.

    Attributes
    ----------
    corners : ndarray (T, 3, 3) float64
        World positions, counter-clockwise seen from the front, whatever the matrix mirrors.
    normals : ndarray (T, 3, 3) float64
        At the corners, world, of any length.
    uvs, uvs1 : ndarray (T, 3, 2) float32
        0 where the mesh has none.
    tangents : ndarray (T, 3, 4) float64
        World, of any length, and the sign of the bitangent; 0 where the mesh has none.
    colors : ndarray (T, 3, 4) float32
        White where the mesh has none or the material ignores them.
    places : ndarray (T, 3, 3) float32
        Positions in the mesh's own space.
    node : ndarray (T,) int64
        Places in `nodes`.
    lights, shadows
        The lights except ambient ones, and for each of them whether it casts shadows.
    ambient : ndarray (3,)
        The sum of the ambient lights.
    """

    corners: Array
    normals: Array
    uvs: npt.NDArray[np.float32]
    uvs1: npt.NDArray[np.float32]
    tangents: Array
    colors: npt.NDArray[np.float32]
    places: npt.NDArray[np.float32]
    node: Ints
    nodes: list[NodeRecord]
    materials: list[MaterialRecord]
    lights: list[Point | Directional | Spot]
    shadows: list[bool]
    ambient: Array
    background: Radiance
    surroundings: list[Radiance]


def read(
    scene: Scene,
    *,
    exclude: Iterable[Node] = (),
    textures: Callable[[RenderTexture], npt.NDArray[np.generic]] | None = None,
) -> Snapshot:
    """Read a scene as it is now.

    Parameters
    ----------
    scene : Scene
    exclude : iterable of Node
        Nodes that the camera does not see, with all nodes below them.
    textures : callable, optional
        Returns the picture (H, W, C) of a RenderTexture, row 0 on top: floats, or uint8 where the picture is "srgb".

    Returns
    -------
    Snapshot

    Raises
    ------
    ValueError
        For what rays cannot follow: a ShaderMaterial, a stencil, ``depth_test=False``, channels that are not written,
        an opaque surface that writes no depth, a Blend that is not A + B * D with the colour D behind, effects of a
        render texture, a render texture without `textures`, a probe as `BasicMaterial.cubemap`. The message names the
        node and the property.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.truth.scene.snapshot import read
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(1, segments=8, rings=4), cc.PhongMaterial(), name="ball")
    >>> found = read(scene)
    >>> found.corners.shape, found.nodes[0].name
    ((48, 3, 3), 'ball')
    """
    excluded = {node.id for node in exclude if node in scene}
    ids = frozenset(node.id for node in scene.nodes)
    environment = _environment(scene)
    background = _background(scene, environment)
    around = _Surroundings(environment, background)
    reader = MaterialReader(textures)
    records: list[NodeRecord] = []
    parts = [_NO_TRIANGLES]
    for node in shown_nodes(scene):
        kind = kind_of(node)
        drawn = drawn_mesh(node, ids)
        material = node.material
        assert material is not None  # nodes with a mesh have one
        blend = _blend(node, material, drawn)
        record = NodeRecord(
            id=node.id,
            label=node.label,
            name=node.name,
            material=reader.place_of(node, drawn.mesh),
            kind=kind,
            surroundings=around.place_of(node),
            double_sided=material.double_sided,
            receive_shadow=node.receive_shadow,
            casts_shadow=blend is None and holds(node, "cast_shadow"),
            in_captures=holds(node, "in_captures"),
            visible=not any(above.id in excluded for above in upwards(node)),
            blend=blend,
            opacity=reader.opacity(material),
            scale=np.linalg.norm(drawn.matrix[:3, :3], axis=0),
        )
        parts.append(_triangles(drawn, reader.shows_colors(material), len(records)))
        records.append(record)
    lights, shadows, ambient = _lights(scene)
    return Snapshot(
        **{name: np.concatenate([part[name] for part in parts]) for name in parts[0]},
        nodes=records,
        materials=reader.records,
        lights=lights,
        shadows=shadows,
        ambient=ambient,
        background=background,
        surroundings=around.all,
    )


def _blend(node: Node, material: Material, drawn: DrawnMesh) -> BlendRecord | None:
    mode = material.blend
    if mode is None:
        mode = "alpha" if blends(material, drawn.mesh) else "opaque"
    check_depth_write(node, mode == "opaque")
    if isinstance(mode, Blend):
        check_gathering(node, mode.src, mode.dst)
        return BlendRecord("factors", mode.src, mode.dst, mode.src_alpha, mode.dst_alpha)
    check_gathering(node, mode)
    return None if mode == "opaque" else BlendRecord(mode)


#: The arrays of the triangles of one node, by their names in the snapshot.
_Part: TypeAlias = dict[str, npt.NDArray[Any]]
_NO_TRIANGLES: _Part = {
    "corners": np.zeros((0, 3, 3)),
    "normals": np.zeros((0, 3, 3)),
    "uvs": np.zeros((0, 3, 2), np.float32),
    "uvs1": np.zeros((0, 3, 2), np.float32),
    "tangents": np.zeros((0, 3, 4)),
    "colors": np.zeros((0, 3, 4), np.float32),
    "places": np.zeros((0, 3, 3), np.float32),
    "node": np.zeros(0, np.int64),
}


def _triangles(drawn: DrawnMesh, shows_colors: bool, place: int) -> _Part:
    mesh, matrix = drawn.mesh, drawn.matrix
    linear = matrix[:3, :3]
    mirrors = np.linalg.det(linear) < 0
    indices = mesh.indices.astype(np.int64)
    if mirrors:  # counter-clockwise becomes clockwise
        indices = indices[:, [0, 2, 1]]
    count = len(indices)
    positions = mesh.positions.astype(np.float64) @ linear.T + matrix[:3, 3]
    normals = mesh.normals.astype(np.float64) @ np.linalg.inv(linear)
    tangents = np.zeros((count, 3, 4))
    if mesh.tangents is not None:
        turned = mesh.tangents.astype(np.float64)
        turned[:, :3] = turned[:, :3] @ linear.T
        turned[:, 3] *= -1 if mirrors else 1
        tangents = turned[indices]
    nothing = np.zeros((count, 3, 2), np.float32)
    colors = np.ones((count, 3, 4), np.float32)
    if shows_colors and mesh.colors is not None:
        colors = mesh.colors[indices]
    return {
        "corners": positions[indices],
        "normals": normals[indices],
        "uvs": nothing if mesh.uvs is None else mesh.uvs[indices],
        "uvs1": nothing if mesh.uvs1 is None else mesh.uvs1[indices],
        "tangents": tangents,
        "colors": colors,
        "places": mesh.positions[indices],
        "node": np.full(count, place, np.int64),
    }


class _Surroundings:
    """What nodes see where a ray meets nothing, each cubemap once; the scene's own environment comes first."""

    def __init__(self, environment: Radiance, background: Radiance) -> None:
        self.all = [environment, background]
        self._known: dict[int, tuple[CubeMap, int]] = {}

    def place_of(self, node: Node) -> int:
        own = node.environment
        if own is None:
            return 0
        if isinstance(own, (Probe, ProbeBlend, PlanarMirror)):
            return 1
        if id(own) not in self._known:  # the cubemap is kept, so that its id stays its own
            self._known[id(own)] = (own, len(self.all))
            self.all.append(Radiance("cube", cube=own))
        return self._known[id(own)][1]


def _environment(scene: Scene) -> Radiance:
    """Return the scene's environment as it is turned; its intensity multiplies its light."""
    cube = scene.environment
    if cube is None:
        return Radiance()
    to_world = rotation_matrix(np.asarray(scene.environment_rotation))
    return Radiance("cube", cube=cube, turn=to_world.T, scale=scene.environment_intensity)


def _background(scene: Scene, environment: Radiance) -> Radiance:
    shown = scene.background
    if shown is None:
        return environment
    if isinstance(shown, CubeMap):
        return Radiance("cube", cube=shown)
    return Radiance("color", color=np.asarray(shown, np.float64))


def _lights(scene: Scene) -> tuple[list[Point | Directional | Spot], list[bool], Array]:
    lights: list[Point | Directional | Spot] = []
    shadows: list[bool] = []
    ambient = np.zeros(3)
    for light in scene.lights:
        color = light.color.astype(np.float64)
        if isinstance(light, AmbientLight):
            ambient += color * light.intensity
        elif isinstance(light, (DirectionalLight, PointLight, SpotLight)):
            lights.append(_light(light))
            shadows.append(light.shadow is not None)
    return lights, shadows, ambient


def _light(light: DirectionalLight | PointLight | SpotLight) -> Point | Directional | Spot:
    color, strength = light.color.tolist(), light.intensity
    if isinstance(light, DirectionalLight):
        return Directional(light.world_direction.tolist(), color, strength)
    position = light.world_position.tolist()
    if isinstance(light, PointLight):
        return Point(position, color, strength, light.decay, light.range)
    travels = light.world_direction.tolist()
    cone = (light.angle, light.penumbra)
    return Spot(position, travels, *cone, color, strength, light.decay, light.range)
