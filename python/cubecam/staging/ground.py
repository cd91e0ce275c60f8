"""The shadow of a model on a level ground, under light from all around, as a picture for the ground's opacity."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from .._core import BasicMaterial, Image, Mesh, Node, OrthographicCamera, Renderer, Scene
from .fit import Extent

__all__ = ["Ground"]

Vectors = npt.NDArray[np.float64]

_WIDE = 6.0  # the side of the ground in radii of the model
_FADE = 0.35  # the outer part of the ground on which the shadow fades


class Ground:
    """A ground that shows nothing but shadows: black, as opaque as light is missing.

    Parameters
    ----------
    scene : Scene
        The ground is added to it, and hidden while `update` looks for shadows.
    nodes : sequence of Node
        The model, whose lowest point the ground touches. Opaque nodes cast the shadow.
    directions : ndarray (K, 3)
        Unit vectors towards the light; each gives an equal share of the ground's light.
    texels : int
        Texels along the ground.
    moments : iterable
        The nodes are counted once for each; a generator may move them in between.

    Notes
    -----
    A point of the ground has lost the light of those directions in which the model stands. For each direction the
    silhouette of the model is drawn by an orthographic camera that looks along the light, and every texel looks up
    whether it lies in the silhouette: the mean over the directions is the lost share of the irradiance.
    """

    def __init__(
        self,
        scene: Scene,
        nodes: Sequence[Node],
        directions: Vectors,
        *,
        texels: int = 256,
        moments: Iterable[object] = (None,),
    ) -> None:
        self._scene, self._directions, self._texels = scene, directions, texels
        box = Extent(np.concatenate([np.eye(3), -np.eye(3)]))
        for _ in moments:
            box.add(nodes)
        high, low = box.reach[:3], -box.reach[3:]
        self._centre = (low + high) / 2
        self._radius = float(np.linalg.norm(high - low)) / 2
        self.side = _WIDE * self._radius
        self._material = BasicMaterial(color=(0, 0, 0, 1), depth_write=False)
        # A little below the model, whose own lowest faces would flicker in the ground.
        self.height = float(low[1]) - 1e-3 * self._radius
        self.node = scene.add(
            Mesh.plane(self.side, self.side),
            self._material,
            name="ground",
            position=(self._centre[0], self.height, self._centre[2]),
            cast_shadow=False,
        )
        self.node.in_captures = False

    def update(self, renderer: Renderer) -> None:
        """Draw the shadow of the model as it stands now."""
        steps = (np.arange(self._texels) + 0.5) / self._texels * 2 - 1
        across, along = np.meshgrid(steps, steps)  # row 0 is at -Z
        fade = np.clip((1 - np.hypot(across, along)) / _FADE, 0, 1)
        lost = self._lost(renderer, across, along) * fade**2 * (3 - 2 * fade)
        pixels = np.zeros((self._texels, self._texels, 4), np.float32)
        pixels[..., 3] = _softened(lost)
        self._material.map = Image(pixels, encoding="linear")

    def _lost(self, renderer: Renderer, across: Vectors, along: Vectors) -> Vectors:
        """Give the share of light that each texel has lost."""
        half = self.side / 2
        level = np.full_like(across, self.height - self._centre[1])
        points = np.stack([across * half, level, along * half], axis=-1)
        lost = np.zeros(across.shape)
        self.node.visible = False
        try:
            for towards in self._directions:
                camera = OrthographicCamera(
                    height=2.05 * self._radius,
                    near=self._radius,
                    far=5 * self._radius,
                    position=self._centre + 3 * self._radius * towards,
                    target=self._centre,
                    up=(0, 0, -1) if abs(towards[1]) > 0.9 else (0, 1, 0),
                )
                size = (self._texels, self._texels)
                frame = renderer.render(self._scene, camera, size, outputs=("id",), format=None)
                lost += _looked_up(frame.id > 0, points, towards, camera)
        finally:
            self.node.visible = True
        return lost / len(self._directions)


def _looked_up(
    silhouette: npt.NDArray[np.bool_], points: Vectors, towards: Vectors, camera: OrthographicCamera
) -> Vectors:
    """Say for points, as seen from the camera's target, whether the picture that looks along the light covers them."""
    right = np.cross(camera.up, towards)
    right /= np.linalg.norm(right)
    size = len(silhouette)
    x = (points @ right / camera.height + 0.5) * size
    y = (0.5 - points @ np.cross(towards, right) / camera.height) * size
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    inside = (column >= 0) & (column < size) & (row >= 0) & (row < size)
    found = silhouette[np.clip(row, 0, size - 1), np.clip(column, 0, size - 1)]
    return np.asarray(np.where(inside, found, False), np.float64)


def _softened(values: Vectors) -> Vectors:
    """Average with the neighbours by 1 4 6 4 1, which hides the steps between directions."""
    kernel = np.array([1, 4, 6, 4, 1]) / 16
    padded = np.pad(values, 2, mode="edge")
    rows = sum(k * padded[i : i + len(values)] for i, k in enumerate(kernel))
    return np.asarray(sum(k * rows[:, i : i + len(values)] for i, k in enumerate(kernel)))
