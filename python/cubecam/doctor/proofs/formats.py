"""Numbers come back as they were drawn: three formats, cubemaps that go to the GPU and back, depths and ids."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._core import BasicMaterial, CubeMap, Mesh, Scene
from . import reference
from .measurement import Measurement, worst

__all__ = ["prove_formats"]

SIZE = 8
NEAR, FAR = 0.25, 8.0
#: Colours that each format holds exactly: steps of 1/255, halves, floats.
COLORS = {
    "rgba8": (51 / 255, 0.4, 0.8),
    "rgba16f": (0.25, 3.5, 0.125),
    "rgba32f": (1 / 3, 1e-5, 4e4),
}
KINDS = {"rgba8": np.uint8, "rgba16f": np.float16, "rgba32f": np.float32}
#: A lookup at a texel's centre: a GPU rounds the weights of the neighbours to 1/256.
LOOKUP = 2e-3


def prove_formats(renderer: Any) -> list[Measurement]:
    """Draw one colour in each format, random cubemaps, and a room whose depths follow from its size."""
    return [
        *(_drawn(renderer, name) for name in COLORS),
        *(_there_and_back(renderer, name) for name in COLORS),
        *_room(renderer),
    ]


def _drawn(renderer: Any, name: str) -> Measurement:
    scene = Scene()
    scene.add(Mesh.box(2.0), BasicMaterial(color=COLORS[name], double_sided=True))
    faces = renderer.capture(scene, size=SIZE, format=name).faces
    expected = np.array(COLORS[name], np.float32)
    if KINDS[name] == np.uint8:
        expected = np.round(expected * 255)
    if faces.dtype != KINDS[name]:
        failure = f"expected {np.dtype(KINDS[name])}, got {faces.dtype}"
        return Measurement("formats", f"{name}, drawn", float("nan"), 0.0, failure)
    whole = np.broadcast_to(expected.astype(KINDS[name]), faces[..., :3].shape)
    return Measurement(
        "formats", f"{name}, a colour drawn and read", worst(faces[..., :3], whole), 0.0
    )


def _there_and_back(renderer: Any, name: str) -> Measurement:
    """Show a cubemap as the sky, and capture it: each texel comes back to its place."""
    numbers = np.random.default_rng(7).random((6, SIZE, SIZE, 4))
    scale = 255 if KINDS[name] == np.uint8 else 1
    sky = np.round(numbers * 255) if scale == 255 else numbers
    sky[..., 3] = scale
    sky = sky.astype(KINDS[name])
    got = renderer.capture(Scene(environment=CubeMap(sky)), size=SIZE, format="rgba32f").faces
    expected = sky[..., :3].astype(np.float32) / scale
    what = f"{name}, a cubemap to the GPU and back"
    return Measurement("formats", what, worst(got[..., :3], expected), LOOKUP)


def _room(renderer: Any) -> list[Measurement]:
    """Capture a cube around the eye: z is 1.5 everywhere."""
    scene = Scene()
    node = scene.add(Mesh.box(3.0), BasicMaterial(double_sided=True))
    node.label = -7
    outputs = ("distance", "z", "depth", "normal", "id", "label")
    cube = renderer.capture(scene, size=SIZE, near=NEAR, far=FAR, outputs=outputs)
    rays = reference.directions(SIZE)
    z = np.full(rays.shape[:-1], 1.5)
    axis = np.abs(rays) == np.abs(rays).max(-1, keepdims=True)
    normals = np.where(axis, -np.sign(rays), 0)  # turned to the viewer
    ids = np.full(z.shape, node.id)
    return [
        Measurement("formats", "z", worst(cube.z, z), 1e-5),
        Measurement(
            "formats", "distance", worst(cube.distance, 1.5 * np.linalg.norm(rays, axis=-1)), 1e-5
        ),
        Measurement(
            "formats", "depth", worst(cube.depth, FAR * (z - NEAR) / (z * (FAR - NEAR))), 1e-5
        ),
        Measurement("formats", "normals", worst(cube.normal, normals), 1e-5),
        Measurement("formats", "ids", worst(cube.id, ids), 0.0),
        Measurement("formats", "labels", worst(cube.label, np.full(z.shape, -7)), 0.0),
    ]
