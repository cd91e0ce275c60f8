"""Morph targets and skins in numpy, float64, from sections 3.7.2.2 and 3.7.3 of the glTF 2.0 specification."""

import numpy as np


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def morph(base, displacements, weights):
    """base + the sum of weight * displacement; a displacement may be None."""
    total = np.array(base, float)
    for displacement, weight in zip(displacements, weights, strict=True):
        if displacement is not None:
            total = total + weight * np.asarray(displacement, float)
    return total


def vertex_matrices(joints, weights, worlds, inverse_bind):
    """(V, 4, 4): the sum of weight * world * inverse bind of each vertex's joints; the weights sum to 1."""
    weights = np.asarray(weights, float)
    matrices = np.asarray(worlds, float) @ np.asarray(inverse_bind, float)
    shares = weights / weights.sum(axis=1, keepdims=True)
    return (shares[:, :, None, None] * matrices[np.asarray(joints)]).sum(axis=1)


def skin(positions, normals, tangents, matrices):
    """Positions by the matrices, normals by the inverse transposes, tangents by the linear parts.

    The sign of a tangent keeps the third direction of its frame on the side to which the matrix carries it.
    """
    linear = matrices[:, :3, :3]
    moved = np.einsum("vij,vj->vi", linear, positions) + matrices[:, :3, 3]
    turned = np.einsum("vji,vj->vi", np.linalg.inv(linear), normals)
    if tangents is None:
        return moved, unit(turned), None
    along = np.einsum("vij,vj->vi", linear, tangents[:, :3])
    third = np.einsum("vij,vj->vi", linear, np.cross(normals, tangents[:, :3]) * tangents[:, 3:])
    sign = np.sign((np.cross(turned, along) * third).sum(axis=1))
    return moved, unit(turned), np.c_[unit(along), sign]
