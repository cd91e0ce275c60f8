"""The waving sheet in cubecam."""

from __future__ import annotations

import numpy as np

import cubecam as cc

from .. import wave


class Wave:
    """One node whose mesh gets new positions for each frame."""

    def __init__(self) -> None:
        self.scene = cc.Scene(background=wave.CLEAR)
        self.scene.add(cc.PointLight(position=wave.LIGHT))
        positions, normals = wave.arrays(0)
        self.mesh = cc.Mesh(positions, wave.triangles(), normals=normals)
        self.scene.add(
            self.mesh,
            cc.PhongMaterial(
                color=wave.COLOR, ka=wave.KA, kd=wave.KD, ks=wave.KS, shininess=wave.SHININESS
            ),
        )
        self.camera = cc.PerspectiveCamera(
            fov=wave.FOV, position=wave.EYE, target=(0, 0, 0), near=wave.NEAR, far=wave.FAR
        )
        self.renderer = cc.Renderer()

    def prepare(self, index: int) -> None:
        self.positions, self.normals = wave.arrays(index)

    def move(self, index: int) -> None:
        self.mesh.update(positions=self.positions, normals=self.normals)

    def draw(self, index: int) -> np.ndarray:
        """(H, W, 4) uint8, row 0 on top."""
        return self.renderer.render(self.scene, self.camera, size=wave.FRAME_SIZE).color
