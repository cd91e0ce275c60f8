"""Ten thousand boxes in cubecam: all are moved, one is moved, none is moved, or many are out of view."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import cubecam as cc

from .. import boxes

ORIGIN = (0.0, 0.0, 0.0)
BEHIND = np.array([0.0, 0.0, 40.0])  # offset from the boxes in view to those behind the camera


def _mesh() -> cc.Mesh:
    positions, normals, triangles = boxes.box_arrays()
    return cc.Mesh(positions, triangles, normals=normals)


def _material(color: ArrayLike, lit: bool) -> cc.Material:
    if not lit:
        return cc.BasicMaterial(color=color)
    return cc.PhongMaterial(
        color=color, ka=boxes.KA, kd=boxes.KD, ks=boxes.KS, shininess=boxes.SHININESS
    )


class Boxes:
    """All boxes and a camera.

    `moved`: how many of the boxes move for a frame. `beside`: how many more boxes stand behind the camera.
    `bulk`: whether the boxes are moved by one call of the scene, else one by one.
    """

    def __init__(
        self,
        count: int,
        colors: int,
        lit: bool = True,
        size: tuple[int, int] = boxes.FRAME_SIZE,
        moved: int | None = None,
        beside: int = 0,
        bulk: bool = False,
    ) -> None:
        self.boxes = boxes.Boxes(count, colors)
        self.size = (size[0], size[1])  # a list after its way as JSON
        self.moved = count if moved is None else moved
        self.bulk = bulk
        self.scene = cc.Scene(background=boxes.CLEAR)
        self.scene.add(cc.PointLight(position=boxes.LIGHT))
        mesh = _mesh()
        materials = [_material(color, lit) for color in self.boxes.palette]
        self.nodes = [
            self.scene.add(mesh, materials[material], position=position, rotation=rotation)
            for material, position, rotation in zip(
                self.boxes.material, self.boxes.positions(0), self.boxes.quaternions, strict=True
            )
        ]
        more = boxes.Boxes(beside, colors)
        for material, position in zip(more.material, more.start, strict=True):
            self.scene.add(mesh, materials[material], position=position + BEHIND)
        self.camera = cc.PerspectiveCamera(
            fov=boxes.FOV, position=boxes.EYE, target=ORIGIN, near=boxes.NEAR, far=boxes.FAR
        )
        self.renderer = cc.Renderer()

    def prepare(self, index: int) -> None:
        if self.moved:
            self.positions = self.boxes.positions(index)[: self.moved]

    def move(self, index: int) -> None:
        if not self.moved:
            return
        nodes = self.nodes[: self.moved]
        if self.bulk:
            self.scene.set_positions(nodes, self.positions)
            return
        for node, position in zip(nodes, self.positions.tolist(), strict=True):
            node.position = position

    def draw(self, index: int) -> np.ndarray:
        """(H, W, 4) uint8, row 0 on top."""
        return self.renderer.render(self.scene, self.camera, size=self.size).color
