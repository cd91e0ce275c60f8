"""Morph targets and skins at their default pose (sections 3.7.2.2 and 3.7.3 of glTF 2.0)."""

from __future__ import annotations

import numpy as np

from ..._core import MeshError
from ..meshes.placing import Matrices, cofactors
from .document import Gltf
from .entries import Entry
from .limits import Limits
from .primitives import Attributes, Floats, Surface, accessor_index, check_type, colors


def morph(document: Gltf, shape: Surface, weights: list[float] | None, limits: Limits) -> None:
    """Add the morph targets of a primitive with their weights; without weights they are 0."""
    count = len(shape.entry.entries("targets"))
    if not count or weights is None:
        return
    if len(weights) != count:
        raise MeshError(
            f"{shape.entry.path('targets')}: expected {len(weights)} targets, one for each weight, "
            f"got {count}"
        )
    for index, weight in enumerate(weights):
        if weight:
            target = shape.entry.member("targets", index)
            limits.morphs(len(shape.positions) * max(1, len(target.raw)), target)
            _add_target(shape, Attributes(document, target, len(shape.positions)), weight)
    if shape.colors is not None:
        shape.colors = np.clip(shape.colors, 0, 1)


def _add_target(shape: Surface, target: Attributes, weight: float) -> None:
    shape.positions = _sum(shape.positions, weight, target.floats("POSITION", "VEC3"))
    if shape.normals is not None:
        shape.normals = _sum(shape.normals, weight, target.floats("NORMAL", "VEC3"))
    if shape.uvs is not None:
        shape.uvs = _sum(shape.uvs, weight, target.floats("TEXCOORD_0", "VEC2"))
    if shape.uvs1 is not None:
        shape.uvs1 = _sum(shape.uvs1, weight, target.floats("TEXCOORD_1", "VEC2"))
    shape.tangents = None  # those of the new shape are made again where a material needs them
    if shape.colors is not None:
        shape.colors = _sum(shape.colors, weight, colors(target, alpha=0.0))


def _sum(values: Floats, weight: float, change: Floats | None) -> Floats:
    return values if change is None else values + weight * change


def skin(document: Gltf, shape: Surface, entry: Entry) -> None:
    """Move a primitive by the joints of a skin to its place in the world."""
    joints = _joint_matrices(document, entry)
    blended = np.zeros((len(shape.positions), 3, 4))
    total = np.zeros(len(shape.positions))
    level = 0
    while level == 0 or f"JOINTS_{level}" in shape.attributes:
        _add_joints(shape.attributes, level, joints, blended, total)
        level += 1
    lost = total == 0  # a vertex without any weight goes with the first joint
    blended[lost], total[lost] = joints[0, :3], 1
    blended /= total[:, None, None]
    linear = blended[:, :, :3]
    shape.positions = np.einsum("vij,vj->vi", linear, shape.positions) + blended[:, :, 3]
    shape.tangents = None
    sides = np.sign(np.linalg.det(linear))
    if shape.normals is not None:
        normals = np.einsum("vij,vj->vi", cofactors(linear), shape.normals)
        shape.normals = np.where(sides < 0, -1.0, 1.0)[:, None] * normals
    # Where joints mirror, counter-clockwise becomes clockwise.
    mirrored = sides[shape.faces].sum(axis=1) < 0
    shape.faces = np.where(mirrored[:, None], shape.faces[:, ::-1], shape.faces)


def _joint_matrices(document: Gltf, entry: Entry) -> Matrices:
    """Return the matrix of each joint: from the space of the mesh to the world."""
    numbers = joints_of(document, entry)
    worlds: Matrices = document.nodes.worlds[numbers]
    bind = inverse_bind_matrices(document, entry, len(numbers))
    return worlds if bind is None else worlds @ bind


def joints_of(document: Gltf, entry: Entry) -> list[int]:
    """Read the nodes that are the joints of a skin."""
    numbers = entry.indices("joints", document.count("nodes"))
    if not numbers:
        raise entry.error("joints", "a list of nodes")
    return numbers


def inverse_bind_matrices(document: Gltf, entry: Entry, joints: int) -> Matrices | None:
    """Read the matrices of a skin, (J, 4, 4), one for each joint; None if it has none."""
    if "inverseBindMatrices" not in entry:
        return None
    inverse = accessor_index(document, entry, "inverseBindMatrices")
    check_type(entry, "inverseBindMatrices", document.layout(inverse), "MAT4")
    bind = np.asarray(document.accessor(inverse), np.float64)
    if len(bind) < joints:
        raise MeshError(
            f"{entry.path('inverseBindMatrices')}: expected {joints} matrices, one for each "
            f"joint, got {len(bind)}"
        )
    return bind[:joints]


def _add_joints(
    attributes: Attributes, level: int, joints: Matrices, blended: Floats, total: Floats
) -> None:
    """Add the matrices of JOINTS_n with the weights WEIGHTS_n, and the weights themselves."""
    which_key, weights_key = f"JOINTS_{level}", f"WEIGHTS_{level}"
    which = attributes.read(which_key, "VEC4")
    if which.dtype.kind != "u":
        raise attributes.entry.error(which_key, "an accessor of unsigned integers")
    weights = np.asarray(attributes.read(weights_key, "VEC4"), np.float64)
    if not (np.isfinite(weights).all() and (weights >= 0).all()):
        path = attributes.entry.path(weights_key)
        raise MeshError(f"{path}: expected weights of 0 or more, got others")
    which = np.where(weights > 0, which, 0)  # a joint without weight may be anything
    if which.size and not which.max() < len(joints):
        path = attributes.entry.path(which_key)
        raise MeshError(f"{path}: expected joints below {len(joints)}, got {which.max()}")
    numbers = which.astype(np.int64)
    for column in range(4):
        blended += weights[:, column, None, None] * joints[numbers[:, column], :3]
    total += weights.sum(axis=1)
