"""The holes of alpha masks: where the alpha of a surface is below the material's cutoff (glTF 2.0, section 3.9.4)."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Bools, Ints
from ..scene.records import GlassRecord, StandardRecord
from ..scene.snapshot import Snapshot
from .interpolation import interpolated


def nodes_with_holes(snapshot: Snapshot) -> Bools:
    """Return (nodes,) which nodes have a material with an alpha mask."""
    return np.array(
        [
            isinstance(material, StandardRecord) and material.holes
            for material in (snapshot.materials[node.material] for node in snapshot.nodes)
        ],
        bool,
    )


def solid_nodes(snapshot: Snapshot) -> Bools:
    """Return (nodes,) which nodes are neither blended nor glass, so that a ray never goes through their surface."""
    solid = []
    for node in snapshot.nodes:
        material = snapshot.materials[node.material]
        passes = isinstance(material, GlassRecord) or (
            isinstance(material, StandardRecord) and material.numbers["transmission"] > 0
        )
        solid.append(node.blend is None and not passes)
    return np.array(solid, bool)


def in_holes(snapshot: Snapshot, triangles: Ints, weights: Array, masked: Bools) -> Bools:
    """Return (R,) whether points on triangles (R,), of the weights (R, 3) of their corners, lie in holes.

    `masked` is what `nodes_with_holes` returned.
    """
    found = np.zeros(len(triangles), bool)
    nodes = snapshot.node[triangles]
    places, which = np.unique(nodes, return_inverse=True)
    of_place = np.array([snapshot.nodes[i].material if masked[i] else -1 for i in places], np.int64)
    materials = of_place[which.reshape(-1)]
    for index in np.unique(materials[materials >= 0]):
        material = snapshot.materials[index]
        assert isinstance(material, StandardRecord)  # no other material has holes
        rows = np.flatnonzero(materials == index)
        at, share = triangles[rows], weights[rows]
        alpha = interpolated(share, snapshot.colors[at])[:, 3]
        if "map" in material.maps:
            uv = interpolated(share, snapshot.uvs[at])
            uv1 = interpolated(share, snapshot.uvs1[at])
            alpha = alpha * material.maps["map"].at(uv, uv1)[:, 3]
        found[rows] = alpha * material.color[3] < material.numbers["alpha_cutoff"]
    return found
