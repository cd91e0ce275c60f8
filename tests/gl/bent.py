"""A sheet with joints and morph targets, and the same sheet as numpy bends it."""

from typing import Any

import numpy as np

import cubecam as cc
from tests.reference import deformation

ROWS = 9


def grid():
    """Positions (81, 3) of a sheet from -4 to 4 in X and Y, its triangles and texture coordinates."""
    x, y = np.meshgrid(np.linspace(-4, 4, ROWS), np.linspace(-4, 4, ROWS))
    corner = np.arange(ROWS * (ROWS - 1)).reshape(-1, ROWS)[:, :-1].ravel()
    triangles = np.r_[
        np.c_[corner, corner + 1, corner + ROWS + 1],
        np.c_[corner, corner + ROWS + 1, corner + ROWS],
    ]
    positions = np.stack([x, y, 0.1 * np.sin(3 * x + y)], axis=-1).reshape(-1, 3)
    return positions, triangles, positions[:, :2] / 8 + 0.5


def random_matrix(rng, mirrored=False):
    """Something near the unit matrix, with shear and scale."""
    matrix = np.eye(4)
    matrix[:3, :3] += rng.uniform(-0.25, 0.25, (3, 3))
    matrix[:3, 3] = rng.uniform(-0.3, 0.3, 3)
    if mirrored:
        matrix[:3, 0] *= -1
    return matrix


class Bent:
    """A scene with joints; `numbers` are the arrays of the sheet as the specification bends it."""

    def __init__(
        self, rng, sets=1, normals=True, joints=5, targets=2, material=None, place=(0, 0, 0)
    ):
        positions, triangles, uvs = grid()
        count = len(positions)
        given = deformation.unit(rng.uniform((-0.4, -0.4, 0.6), (0.4, 0.4, 1.4), (count, 3)))
        along = deformation.unit(np.cross((0, 1, 0), given))
        self.positions = np.float32(positions)
        self.normals = np.float32(given) if normals else None
        self.tangents: Any = (
            np.c_[np.float32(along), np.full(count, rng.choice([-1, 1]))] if normals else None
        )
        self.colors = np.float32(rng.uniform(0.2, 0.8, (count, 4)))
        self.colors[:, 3] = 1
        self.uvs = np.float32(uvs)
        self.triangles = triangles
        self.targets = [
            cc.MorphTarget(
                positions=rng.uniform(-0.2, 0.2, (count, 3)),
                normals=rng.uniform(-0.2, 0.2, (count, 3)) if normals else None,
                tangents=rng.uniform(-0.2, 0.2, (count, 3)) if normals else None,
                uvs=rng.uniform(-0.1, 0.1, (count, 2)) if index else None,
                colors=rng.uniform(-1.5, 1.5, (count, 3)) if index else None,
                name=f"target {index}",
            )
            for index in range(targets)
        ]
        self.joints = rng.integers(0, joints, (count, 4 * sets))
        self.shares = rng.random((count, 4 * sets)) * (rng.random((count, 4 * sets)) < 0.7)
        self.shares[:, 0] += 0.1
        self.mesh = cc.Mesh(
            self.positions,
            triangles,
            normals=self.normals,
            uvs=self.uvs,
            colors=self.colors,
            tangents=self.tangents,
            joints=self.joints,
            joint_weights=self.shares,
            morph_targets=self.targets,
        )
        self.scene = cc.Scene(background=(0, 0, 0))
        self.root = self.scene.add(position=place)
        self.nodes: list[cc.Node] = []
        for _ in range(joints):
            above = self.nodes[-1] if self.nodes and rng.random() < 0.3 else self.root
            self.nodes.append(self.scene.add(parent=above))
        self.rest = np.array([np.linalg.inv(random_matrix(rng)) for _ in range(joints)])
        self.pose(rng)
        self.node = self.scene.add(
            self.mesh,
            material,
            matrix=random_matrix(rng),
            skin=cc.Skin(self.nodes, self.rest),
            weights=rng.uniform(-0.5, 1, targets) if targets else None,
        )

    def pose(self, rng, mirrored=False):
        for node in self.nodes:
            node.matrix = random_matrix(rng, mirrored)

    def arrays(self):
        """The arrays of the mesh that a picture must show, in the world."""
        weights = self.node.weights.astype(float)

        def mixed(base, name):
            return deformation.morph(base, [getattr(t, name) for t in self.targets], weights)

        positions = mixed(self.positions, "positions")
        normals = np.tile((0.0, 0.0, 1.0), (len(positions), 1))
        tangents = None
        if self.normals is not None:
            normals = deformation.unit(mixed(self.normals, "normals"))
            along = deformation.unit(mixed(self.tangents[:, :3], "tangents"))
            tangents = np.c_[along, self.tangents[:, 3]]
        worlds = [node.world_matrix for node in self.nodes]
        matrices = deformation.vertex_matrices(self.joints, self.shares, worlds, self.rest)
        moved, turned, along = deformation.skin(positions, normals, tangents, matrices)
        sides = np.linalg.det(matrices[:, :3, :3]) < 0
        flip = sides[self.triangles].sum(axis=1) > 1
        return {
            "positions": moved,
            "indices": np.where(flip[:, None], self.triangles[:, ::-1], self.triangles),
            "normals": None if self.normals is None else turned,
            "tangents": along,
            "uvs": mixed(self.uvs, "uvs"),
            "colors": np.clip(mixed(self.colors, "colors"), 0, 1),
        }

    def baked(self, material):
        """A scene with the sheet as numpy bends it."""
        scene = cc.Scene(background=(0, 0, 0))
        scene.add(cc.Mesh(**self.arrays()), material)
        return scene
