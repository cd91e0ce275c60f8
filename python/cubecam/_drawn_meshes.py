"""Meshes as the renderer draws them: with morph targets, skins, flat shading and tangents, in world space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import Material, Mesh, MorphTarget, Node, StandardMaterial

Array = npt.NDArray[np.float64]
Floats = npt.NDArray[np.float32]


@dataclass
class DrawnMesh:
    """A node's mesh in its own space, and the matrix to the world."""

    mesh: Mesh
    matrix: Array


def drawn_mesh(node: Node, nodes: frozenset[int]) -> DrawnMesh:
    """Return the mesh of a node in the form in which it is drawn, as `deformed_mesh` and with what its material needs.

    This is flat shading, and tangents for bumps and stretched highlights.
    """
    material = node.material
    assert material is not None  # nodes with a mesh have one

    def shaped(mesh: Mesh) -> Mesh:
        uv_set = tangent_uv_set(material)
        makes = uv_set is not None and mesh.tangents is None and _uvs(mesh, uv_set) is not None
        if material.flat_shading:
            mesh = mesh.flat_shaded()
        return mesh.with_tangents(uv_set=uv_set) if makes and uv_set is not None else mesh

    return deformed_mesh(node, nodes, shaped)


def deformed_mesh(
    node: Node, nodes: frozenset[int], shaped: Callable[[Mesh], Mesh] | None = None
) -> DrawnMesh:
    """Return the mesh of a node with its morph targets and its skin.

    `nodes` are the ids of all nodes of the scene: a skin counts only while all of its joints are among them. `shaped`
    changes the mesh before the joints move it.
    """
    mesh = node.mesh
    assert mesh is not None  # nodes without a mesh are not drawn
    matrix = np.asarray(node.world_matrix, np.float64)
    if np.any(node.weights):
        mesh = _morphed(mesh, np.asarray(node.weights, np.float64))
    if shaped is not None:
        mesh = shaped(mesh)
    skin = node.skin
    if skin is None or mesh.joints is None or mesh.joint_weights is None:
        return DrawnMesh(mesh, matrix)
    joints = [joint for joint in skin.joints if joint is not None and joint.id in nodes]
    if len(joints) < len(skin.joints):
        return DrawnMesh(mesh, matrix)
    # The mesh stands beside its first joint, which matters for lookups by its own positions.
    origin = np.asarray(joints[0].world_matrix, np.float64)[:3, 3]
    matrices = np.array([joint.world_matrix for joint in joints], np.float64)
    matrices[:, :3, 3] -= origin
    placed = np.eye(4)
    placed[:3, 3] = origin
    return DrawnMesh(_skinned(mesh, matrices @ skin.inverse_bind_matrices), placed)


def tangent_uv_set(material: Material) -> int | None:
    """Return the set of uvs by which a material's tangents run; None if it uses no tangents."""
    if not isinstance(material, StandardMaterial) or material.unlit:
        return None
    coat = material.clearcoat_normal_map if material.clearcoat > 0 else None
    if material.normal_map is None and coat is None and not material.anisotropy > 0:
        return None
    for found in (material.normal_map, material.anisotropy_map, material.clearcoat_normal_map):
        if found is not None:
            return int(getattr(found, "uv_set", 0))
    return 0


def _uvs(mesh: Mesh, uv_set: int) -> Floats | None:
    return mesh.uvs if uv_set == 0 else mesh.uvs1


def _state(mesh: Mesh) -> dict[str, Any]:
    """Return the arrays of a mesh by name; normals that the mesh computed are None."""
    state: dict[str, Any] = dict(mesh.__reduce__()[1][2])  # type: ignore[index]
    state.pop("morph_targets", None)
    return state


def _morphed(mesh: Mesh, weights: Array) -> Mesh:
    """Add morph targets (glTF 2.0, section 3.7.2.2); smooth normals are computed anew."""
    arrays = _state(mesh)
    active = [pair for pair in zip(mesh.morph_targets, weights, strict=False) if pair[1] != 0]
    for name in ("positions", "normals", "uvs", "uvs1", "colors"):
        if arrays[name] is not None:
            arrays[name] = _displaced(arrays[name], active, name)
    if arrays["normals"] is not None:
        arrays["normals"] = unit(arrays["normals"])
    if arrays["colors"] is not None:
        arrays["colors"] = np.clip(arrays["colors"], 0, 1)
    if arrays["tangents"] is not None:
        signs = arrays["tangents"][:, 3:]
        along = unit(_displaced(arrays["tangents"][:, :3], active, "tangents"))
        arrays["tangents"] = np.concatenate([along, signs], axis=1)
    return Mesh(**arrays)


def _displaced(base: Any, targets: list[tuple[MorphTarget, Any]], name: str) -> Array:
    total = np.array(base, np.float64)
    for target, weight in targets:
        change = getattr(target, name)
        if change is not None:
            total[:, : change.shape[1]] += weight * change
    return total


def _skinned(mesh: Mesh, matrices: Array) -> Mesh:
    """Move the vertices by their joints (glTF 2.0, section 3.7.3).

    Normals are multiplied by the inverse of the transposed matrix, and triangles whose corners are mostly mirrored are
    turned round. A vertex without weight goes with the first joint.
    """
    arrays = _state(mesh)
    joints = np.asarray(arrays.pop("joints"), np.int64)
    weights = np.array(arrays.pop("joint_weights"), np.float64)
    lost = weights.sum(axis=1) == 0
    joints[lost], weights[lost, 0] = 0, 1
    weights /= weights.sum(axis=1, keepdims=True)
    means = np.zeros((len(joints), 3, 4))
    for column in range(joints.shape[1]):  # not all at once, since that would be large
        means += weights[:, column, None, None] * matrices[joints[:, column], :3]
    linear = means[:, :, :3]
    sides = np.where(np.linalg.det(linear) < 0, -1, 1)
    positions = np.asarray(arrays["positions"], np.float64)
    arrays["positions"] = np.einsum("vij,vj->vi", linear, positions) + means[:, :, 3]
    if arrays["normals"] is not None:
        turned = np.einsum("vij,vj->vi", cofactors(linear), np.asarray(arrays["normals"]))
        arrays["normals"] = unit(turned) * sides[:, None]
    if arrays["tangents"] is not None:
        tangents = np.asarray(arrays["tangents"], np.float64)
        along = unit(np.einsum("vij,vj->vi", linear, tangents[:, :3]))
        arrays["tangents"] = np.concatenate([along, tangents[:, 3:] * sides[:, None]], axis=1)
    indices = np.asarray(arrays["indices"], np.int64)
    mirrored = sides[indices].sum(axis=1) < 0
    arrays["indices"] = np.where(mirrored[:, None], indices[:, ::-1], indices).astype(np.uint32)
    return Mesh(**arrays)


def cofactors(m: Array) -> Array:
    """Return the cofactors of matrices (..., 3, 3): the determinant times the inverse of the transposed matrix."""
    return np.stack(
        [
            np.cross(m[..., 1, :], m[..., 2, :]),
            np.cross(m[..., 2, :], m[..., 0, :]),
            np.cross(m[..., 0, :], m[..., 1, :]),
        ],
        axis=-2,
    )


def unit(vectors: Array) -> Array:
    """Give vectors (..., 3) the length 1; those without a length stay 0."""
    vectors = np.asarray(vectors, np.float64)
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    scaled: Array = vectors / np.where(length > 0, length, 1)
    return scaled
