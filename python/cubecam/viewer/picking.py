"""What a pixel shows: the node, the place on its surface, and what a mirror sees from there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import optics
from .._core import (
    CubeMap,
    GlassMaterial,
    MirrorMaterial,
    Node,
    OrthographicCamera,
    Probe,
    _to_array,
)
from ..navigation import Standing
from ..plot._faces import NAMES, texels_of

if TYPE_CHECKING:
    import numpy.typing as npt

    from .._core import Frame
    from .viewer import Viewer

__all__ = ["Pick", "Seen", "pick_of", "uv_at"]


@dataclass(frozen=True)
class Seen:
    """What a mirror or a glass shows at a place.

    Attributes
    ----------
    direction : ndarray float64 (3,)
        World space, length 1: the reflected direction, or the refracted one of a `GlassMaterial`.
    face : str
        "+x", "-x", "+y", "-y", "+z" or "-z": the face of the cubemap that the direction meets.
    texel : (int, int)
        The row and the column of the texel, from the top left corner of the face as OpenGL stores it.
    value : ndarray (C,)
        What the cubemap holds there, filtered as a texture is.
    """

    direction: npt.NDArray[np.float64]
    face: str
    texel: tuple[int, int]
    value: npt.NDArray[Any]


@dataclass(frozen=True)
class Pick:
    """What a pixel shows.

    Attributes
    ----------
    node : Node
        The node in front.
    label : int
        The node's label.
    position : ndarray float64 (3,)
        World space: the place on the surface.
    normal : ndarray float64 (3,)
        World space, length 1, with the winding of the triangle, as the output "normal".
    distance : float
        World units from the camera.
    uv : (float, float) or None
        The texture coordinates; None for a mesh without.
    seen : Seen or None
        What a mirror or a glass shows there; None for other materials, and without an environment.
    """

    node: Node
    label: int
    position: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    distance: float
    uv: tuple[float, float] | None
    seen: Seen | None

    def short(self) -> str:
        """Say in a few words what was found."""
        x, y, z = self.position
        name = self.node.name or f"node {self.node.id}"
        return f"{name}  ({x:.3f}, {y:.3f}, {z:.3f})  distance {self.distance:.3f}"

    def __str__(self) -> str:
        parts = [self.short(), "normal ({:.2f}, {:.2f}, {:.2f})".format(*self.normal)]
        if self.label:
            parts.append(f"label {self.label}")
        if self.uv is not None:
            parts.append("uv ({:.3f}, {:.3f})".format(*self.uv))
        if self.seen is not None:
            row, column = self.seen.texel
            value = ", ".join(f"{number:.3g}" for number in self.seen.value.tolist())
            parts.append(
                "sees ({:.2f}, {:.2f}, {:.2f})".format(*self.seen.direction)
                + f": face {self.seen.face}, row {row}, column {column}: ({value})"
            )
        return "  |  ".join(parts)


def pick_of(
    frame: Frame, x: float, y: float, nodes: dict[int, Node], viewer: Viewer
) -> Pick | None:
    """Read what a frame with the outputs id, position, normal and distance shows; x and y are from 0 to 1."""
    ids = frame.id
    assert ids is not None
    height, width = ids.shape[:2]
    row, column = min(int(y * height), height - 1), min(int(x * width), width - 1)
    node = nodes.get(int(ids[row, column]))
    if node is None:
        return None
    position = np.asarray(frame.position[row, column], np.float64)
    normal = np.asarray(frame.normal[row, column], np.float64)
    return Pick(
        node=node,
        label=int(node.label),
        position=position,
        normal=normal,
        distance=float(frame.distance[row, column]),
        uv=uv_at(node, position),
        seen=_seen(node, position, normal, viewer),
    )


def uv_at(node: Node, position: npt.ArrayLike) -> tuple[float, float] | None:
    """Interpolate the texture coordinates of the point of a node's mesh that is nearest to a world position."""
    mesh = node.mesh
    if mesh is None or mesh.uvs is None:
        return None
    world = np.asarray(node.world_matrix, np.float64)
    local = np.linalg.solve(
        world, np.append(_to_array(position, "position").astype(np.float64), 1.0)
    )[:3]
    corners = np.asarray(mesh.indices).reshape(-1, 3)
    a, b, c = (np.asarray(mesh.positions, np.float64)[corners[:, i]] for i in range(3))
    weights = _nearest_weights(a, b, c, local)
    places = weights[:, :1] * a + weights[:, 1:2] * b + weights[:, 2:] * c
    best = int(((places - local) ** 2).sum(axis=1).argmin())
    u, v = weights[best] @ np.asarray(mesh.uvs, np.float64)[corners[best]]
    return float(u), float(v)


def _nearest_weights(a: Any, b: Any, c: Any, point: Any) -> Any:
    """Give barycentric weights (T, 3) of a point in each triangle's plane, clipped to the triangle.

    Ericson, "Real-Time Collision Detection" (2005), section 3.4. A point on the surface is inside one triangle, where
    the clipping changes nothing; elsewhere it only has to keep other triangles from winning.
    """
    ab, ac, ap = b - a, c - a, point - a
    d00, d01, d11 = (ab * ab).sum(1), (ab * ac).sum(1), (ac * ac).sum(1)
    d20, d21 = (ap * ab).sum(1), (ap * ac).sum(1)
    area = d00 * d11 - d01 * d01
    with np.errstate(divide="ignore", invalid="ignore"):
        v, w = (d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area
    weights = np.stack([1 - v - w, v, w], axis=1)
    weights[~np.isfinite(weights).all(axis=1)] = (1.0, 0.0, 0.0)  # without area: its first corner
    weights = np.clip(weights, 0.0, 1.0)
    return weights / weights.sum(axis=1, keepdims=True)


def _seen(node: Node, position: Any, normal: Any, viewer: Viewer) -> Seen | None:
    material = node.material
    if not isinstance(material, (MirrorMaterial, GlassMaterial)):
        return None
    source = node.environment if node.environment is not None else viewer.scene.environment
    if isinstance(source, Probe):
        cube: Any = viewer.renderer.read_probe(source)
    elif isinstance(source, CubeMap):
        cube = source
    else:
        return None
    camera = viewer.camera
    parallel = isinstance(camera, OrthographicCamera)
    incident = Standing(camera).direction if parallel else position - camera.world_position
    incident = incident / np.linalg.norm(incident)
    length = np.linalg.norm(normal)
    if length == 0:
        return None
    facing = normal / length
    if facing @ incident > 0:
        facing = -facing
    if isinstance(material, GlassMaterial):
        direction = np.asarray(optics.refract(incident, facing, 1.0 / float(material.ior)))
        if not direction.any():  # total internal reflection
            direction = np.asarray(optics.reflect(incident, facing))
    else:
        direction = np.asarray(optics.reflect(incident, facing))
    face, row, column = texels_of(direction, cube.size)
    value = np.asarray(cube.sample(direction[None].astype(np.float32))[0])
    return Seen(direction, NAMES[int(face)].lower(), (int(row), int(column)), value)
