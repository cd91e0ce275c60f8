"""A field of objects on a ground and places above it, as plain numbers that every implementation draws."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from . import scene
from .processes import ROOT

TEAPOT = ROOT / "python" / "cubecam" / "data" / "teapot.obj"
GROUND, HEIGHT = 16.0, 0.5  # side of the ground, and how high the middle of an object is above it
GROUND_COLOR = (0.4, 0.4, 0.6)
NEAR, FAR = 0.1, 100.0
CLEAR = (0.2, 0.3, 0.4, 1.0)
KA, KD, KS, SHININESS = 0.2, 0.7, 0.4, 10.0
SUN = (-0.4, -1.0, -0.3)  # the way in which its light travels

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # of glibc's malloc.h


def keep_freed_memory() -> None:
    """Have glibc give memory that was freed to later calls, and not to the system, whose new pages cost time."""
    libc = ctypes.CDLL("libc.so.6")
    libc.mallopt(M_MMAP_THRESHOLD, 1 << 30)
    libc.mallopt(M_TRIM_THRESHOLD, (1 << 31) - 1)


@dataclass(frozen=True)
class Field:
    """What is drawn, and how.

    Attributes
    ----------
    nodes : int
        Objects on the ground; 0: the scene is empty, without a ground, too.
    triangles : int
        Of all objects together, about; they are knots then. 0: they are teapots of 992 triangles.
    colors : int
        Materials of the objects.
    lights : int
        The first is directional, the others are points. Together they are as bright as one.
    probes : int
        Places of one frame.
    size : int
        N, pixels along an edge of a face.
    outputs : tuple of str
        Numbers besides the colour: "distance", "normal", "position", "z".
    samples : int
        Of a pixel.
    format : str
        "rgba8" or "rgba32f".
    """

    nodes: int = 20
    triangles: int = 0
    colors: int = 20
    lights: int = 1
    probes: int = 32
    size: int = 64
    outputs: tuple[str, ...] = ("distance",)
    samples: int = 1
    format: str = "rgba8"

    @classmethod
    def of(cls, options: dict[str, Any]) -> Field:
        """The field of options that came as JSON, where a tuple is a list."""
        return cls(**{**options, "outputs": tuple(options.get("outputs", ("distance",)))})

    @cached_property
    def mesh(self) -> scene.MeshArrays:
        """The mesh of all objects, about two units long."""
        if not self.triangles:
            return scene.obj_mesh(TEAPOT, 2.0)
        across = max(4, round((self.triangles / self.nodes / 20) ** 0.5))
        around = max(8, round(self.triangles / self.nodes / 2 / across))
        return scene.knot_mesh(2.0, around, across)

    @cached_property
    def radius(self) -> float:
        """The radius of the sphere round the middle of an object that holds it."""
        return float(np.linalg.norm(self.mesh.positions, axis=1).max())

    @cached_property
    def ground(self) -> scene.MeshArrays:
        """A square of the side GROUND in the XZ plane."""
        unit = scene.ground_mesh()
        scale = np.float32(GROUND / scene.GROUND_SIZE)
        return scene.MeshArrays(unit.positions * scale, unit.normals, unit.indices)

    @cached_property
    def places(self) -> np.ndarray:
        """(nodes, 3) float64: the middles of the objects."""
        places = np.random.default_rng(19).uniform(-GROUND / 2, GROUND / 2, (self.nodes, 3))
        places[:, 1] = HEIGHT
        return places

    @cached_property
    def turns(self) -> np.ndarray:
        """(nodes,) float64: angles about the Y axis, radians."""
        return np.random.default_rng(20).uniform(0, 2 * np.pi, self.nodes)

    @cached_property
    def palette(self) -> np.ndarray:
        """(colors, 3) float64, linear."""
        return np.random.default_rng(21).uniform(0.1, 1.0, (self.colors, 3))

    @cached_property
    def light_places(self) -> np.ndarray:
        """(lights, 4) float64: the direction towards the first light and 0, then the places of the others and 1."""
        angles = np.arange(self.lights) * 2.4
        found = np.stack([6 * np.cos(angles), 4 + 0 * angles, 6 * np.sin(angles)], axis=1)
        found[:1] = -np.array(SUN) / np.linalg.norm(SUN)
        return np.hstack([found, np.ones((self.lights, 1)) - np.eye(self.lights, 1)])

    def positions(self, frame: int) -> np.ndarray:
        """(probes, 3) float64: the places of a frame's cubemaps, above the objects; other ones for each frame."""
        random = np.random.default_rng(1000 + frame)
        return random.uniform((-4.0, 1.5, -4.0), (4.0, 3.0, 4.0), (self.probes, 3))

    def seen(self, positions: np.ndarray) -> list[list[list[int]]]:
        """For each place and face the objects whose bounding spheres touch the face's pyramid."""
        away = self.places - positions[:, None]  # (probes, nodes, 3)
        reach = self.radius * np.sqrt(2)
        seen = []
        for face in range(6):
            axis, sign = face // 2, 1 - 2 * (face % 2)
            sides = np.abs(np.delete(away, axis, axis=-1)).max(axis=-1)
            seen.append(sides - sign * away[..., axis] <= reach)
        return [[np.flatnonzero(row).tolist() for row in rows] for rows in np.stack(seen, axis=1)]

    def results(self, count: int) -> dict[str, np.ndarray]:
        """Arrays of undefined numbers for `count` cubemaps: "faces" and the outputs."""
        shape = (count, 6, self.size, self.size)
        kind = np.uint8 if self.format == "rgba8" else np.float32
        found = {"faces": np.empty((*shape, 4), kind)}
        for name in self.outputs:
            more = (3,) if name in ("normal", "position") else ()
            found[name] = np.empty(shape + more, np.float32)
        return found
