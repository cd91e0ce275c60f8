"""Captures of a closed room with balls: drawn again under some lights, or unchanged beside a copy."""

from __future__ import annotations

import math

import numpy as np

import cubecam as cc

ROOM = 8.0


def _room(lights: int) -> tuple[cc.Scene, list[cc.Light]]:
    """Every pixel of a capture from the middle shows a PhongMaterial."""
    scene = cc.Scene()
    walls = cc.PhongMaterial(color=(0.7, 0.7, 0.8), double_sided=True, kd=0.2, ks=0.2)
    scene.add(cc.Mesh.box(ROOM), walls)
    ball = cc.Mesh.sphere(0.8)
    for index in range(6):
        angle = index * math.pi / 3
        place = (2.2 * math.cos(angle), (-1) ** index, 2.2 * math.sin(angle))
        scene.add(
            ball, cc.PhongMaterial(color=(1, 0.2 * index, 0.3), kd=0.2, ks=0.2), position=place
        )
    found: list[cc.Light] = []
    for index in range(lights):
        angle = index * 2 * math.pi / max(lights, 1)
        place = (3 * math.cos(angle), 2, 3 * math.sin(angle))
        found.append(scene.add(cc.PointLight(position=place)))
    return scene, found


class Lit:
    """A capture of 6 x 256 x 256 under `lights` point lights, all faces drawn for each frame."""

    def __init__(self, lights: int) -> None:
        self.scene, self.lights = _room(lights)
        self.renderer = cc.Renderer()

    def move(self, index: int) -> None:
        # No pixel changes visibly, but every face has to be drawn again.
        self.lights[0].intensity = 1.0 if index % 2 else math.nextafter(1.0, 0.0) - 1e-7

    def draw(self, index: int) -> np.ndarray:
        """(6, 256, 256, C), the faces."""
        faces = self.renderer.capture(self.scene, size=256, format="rgba8").faces
        assert self.renderer.stats.views_drawn == 6
        return faces


class Unchanged:
    """A capture in which nothing changes, in the default format."""

    def __init__(self, size: int) -> None:
        self.size = size
        self.scene, _ = _room(1)
        self.renderer = cc.Renderer(cache_bytes=2**30)

    def draw(self, index: int) -> np.ndarray:
        return self.renderer.capture(self.scene, size=self.size).faces


class Copied:
    """A copy of the picture of `Unchanged` into memory that is kept, whose time is compared."""

    def __init__(self, size: int) -> None:
        with cc.Renderer() as renderer:
            self.faces = renderer.capture(_room(1)[0], size=size).faces
        self.kept = np.zeros_like(self.faces)

    def draw(self, index: int) -> np.ndarray:
        np.copyto(self.kept, self.faces)
        return self.kept
