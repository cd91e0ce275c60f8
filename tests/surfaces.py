"""Meshes made in numpy, and distances between surfaces of triangles."""

import numpy as np

import cubecam as cc


def grid(n, height):
    """A sheet of n x n squares over the unit square, with z = height(x, y)."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    positions = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + j).ravel()
    b, c, d = a + n + 1, a + n + 2, a + 1
    triangles = np.stack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)], axis=1)
    return cc.Mesh(positions, triangles.reshape(-1, 3))


def bumpy(n):
    """A sheet of hills."""
    return grid(n, lambda x, y: 0.2 * np.sin(7 * x) * np.cos(5 * y) + 0.02 * np.sin(40 * x * y))


def samples(corners, n):
    """Points of triangles (F, 3, 3): a grid of n steps a side on each, corners included."""
    steps = [(i / n, j / n) for i in range(n + 1) for j in range(n + 1 - i)]
    weights = np.array([(1 - u - v, u, v) for u, v in steps])
    return np.einsum("sk,fkc->fsc", weights, corners).reshape(-1, 3)


def _segment_distances(points, a, b):
    along = b - a
    t = ((points[:, None] - a) * along).sum(-1) / np.maximum((along * along).sum(-1), 1e-300)
    return np.linalg.norm(points[:, None] - (a + np.clip(t, 0, 1)[..., None] * along), axis=-1)


def surface_distances(points, corners):
    """The distance of each point (P, 3) from the nearest of all triangles (F, 3, 3), by brute force."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    found = []
    for part in np.array_split(points, len(points) * len(corners) // 400_000 + 1):
        best = np.minimum.reduce(
            [_segment_distances(part, p, q) for p, q in ((a, b), (b, c), (c, a))]
        )
        height = ((part[:, None] - a) * normal).sum(-1)
        inside = np.ones_like(height, bool)
        for p, q in ((a, b), (b, c), (c, a)):
            inside &= (np.cross(q - p, part[:, None] - p) * normal).sum(-1) >= 0
        found.append(np.where(inside, np.abs(height), best).min(axis=1))
    return np.concatenate(found)
