"""Tangents by M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), section 3, for small meshes.

Edges must have at most two triangles, and every triangle an area of its uvs.
"""

import itertools

import numpy as np


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def in_plane(v, normal):
    return unit(v - np.dot(v, normal) * normal)


def corner_tangents(positions, normals, uvs, indices):
    """The tangent and the sign of each corner of each triangle: (F, 3, 4)."""
    p, n, t = (np.asarray(a, float) for a in (positions, normals, uvs))
    values = np.concatenate([p, n, t], axis=1)
    _, vertex = np.unique(values, axis=0, return_inverse=True)
    corners = vertex.reshape(-1)[indices]  # (F, 3): equal numbers are one vertex

    e = p[indices][:, 1:] - p[indices][:, :1]  # (F, 2, 3)
    d = t[indices][:, 1:] - t[indices][:, :1]  # (F, 2, 2)
    area = d[:, 0, 0] * d[:, 1, 1] - d[:, 0, 1] * d[:, 1, 0]
    # (dp/du, dp/dv) from e = d @ (dp/du, dp/dv)
    along_u = np.linalg.solve(d, e)[:, 0]
    positive = area > 0

    # Corners that belong together: a union of sets over the shared edges.
    parent = {corner: corner for corner in itertools.product(range(len(corners)), range(3))}

    def root(corner):
        while parent[corner] != corner:
            corner = parent[corner]
        return corner

    by_edge = {}
    for face in range(len(corners)):
        for i in range(3):
            by_edge[corners[face, i], corners[face, (i + 1) % 3]] = (face, i)
    for (a, b), (face, i) in by_edge.items():
        other = by_edge.get((b, a))
        if other is None or positive[face] != positive[other[0]]:
            continue
        there, j = other
        parent[root((face, i))] = root((there, (j + 1) % 3))
        parent[root((face, (i + 1) % 3))] = root((there, j))

    sums: dict[tuple[int, int], np.ndarray] = {}
    for face, i in parent:
        v = indices[face, i]
        before, after = (p[indices[face, (i + k) % 3]] - p[v] for k in (2, 1))
        angle = np.arccos(np.clip(np.dot(in_plane(before, n[v]), in_plane(after, n[v])), -1, 1))
        sums.setdefault(root((face, i)), np.zeros(3))
        sums[root((face, i))] += angle * in_plane(along_u[face], n[v])
    result = np.zeros((*indices.shape, 4))
    for face, i in parent:
        result[face, i, :3] = in_plane(sums[root((face, i))], n[indices[face, i]])
        result[face, i, 3] = 1 if positive[face] else -1
    return result
