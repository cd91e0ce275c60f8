"""Exact mirror images by ray casting, which a cubemap approximates. Needs embreex, the extra `truth`."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

import cubecam as cc

Vectors = npt.NDArray[np.float64]
#: Colours (H, W, 4) and ids of nodes (H, W).
Truth: TypeAlias = tuple[npt.NDArray[np.float32], npt.NDArray[np.int64]]


@dataclass
class Hits:
    """The first hits of rays (R, 3): node ids (0 for no hit), world positions and unit normals."""

    id: npt.NDArray[np.int64]
    position: Vectors
    normal: Vectors


class Geometry:
    """The triangles of some nodes in world space; normals are interpolated as the renderer does."""

    def __init__(self, nodes: Iterable[cc.Node]) -> None:
        try:
            meshes = importlib.import_module("embreex.mesh_construction")
            scenes = importlib.import_module("embreex.rtcore_scene")
        except ImportError as error:
            raise ImportError(
                "ray casting: expected the package embreex, found none; install it by "
                'pip install "cubecam[truth]"'
            ) from error
        corners, normals, ids = [], [], []
        for node in nodes:
            mesh, matrix = node.mesh, np.asarray(node.world_matrix)
            if mesh is None:
                continue
            linear = matrix[:3, :3]
            positions = mesh.positions.astype(np.float64) @ linear.T + matrix[:3, 3]
            # Normals are transformed by the inverse transpose.
            turned = mesh.normals.astype(np.float64) @ np.linalg.inv(linear)
            corners.append(positions[mesh.indices])
            normals.append(turned[mesh.indices])
            ids.append(np.full(len(mesh.indices), node.id))
        self._corners, self._normals = np.concatenate(corners), np.concatenate(normals)
        self._ids = np.concatenate(ids)
        a, b, c = np.moveaxis(self._corners, 1, 0)
        self._across = np.cross(b - a, c - a)
        self._scene = scenes.EmbreeScene()
        self._mesh = meshes.TriangleMesh(self._scene, self._corners.astype(np.float32))

    def cast(self, origins: Vectors, directions: Vectors) -> Hits:
        """Find the first hits of (R, 3) rays of length 1. They pass through back faces, like the renderer."""
        found = np.full(len(origins), -1)
        rows, start = np.arange(len(origins)), origins
        while len(rows):
            met = np.asarray(
                self._scene.run(start.astype(np.float32), directions[rows].astype(np.float32))
            )
            rows, start, met = rows[met >= 0], start[met >= 0], met[met >= 0]
            found[rows] = met
            back = (self._across[met] * directions[rows]).sum(axis=-1) >= 0
            rows, met = rows[back], met[back]
            t = self._distance(met, start[back], directions[rows])
            # The new start lies behind the triangle, farther than the rounding of a float at these coordinates.
            start = start[back] + (t + 1e-4) * directions[rows]
            found[rows] = -1
        hit = found >= 0
        across, (a, b, c) = self._across[found], np.moveaxis(self._corners[found], 1, 0)
        with np.errstate(all="ignore"):  # rays without a hit divide by 0
            # embree finds the triangle in float; the position on it is computed in double.
            position = origins + self._distance(found, origins, directions) * directions
            area = _dot(across, across)
            v = _dot(np.cross(position - a, c - a), across) / area
            w = _dot(np.cross(b - a, position - a), across) / area
            na, nb, nc = np.moveaxis(self._normals[found], 1, 0)
            normal = (1 - v - w) * na + v * nb + w * nc
            normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
        return Hits(np.where(hit, self._ids[found], 0), position, normal)

    def _distance(self, triangles: Any, origins: Vectors, directions: Vectors) -> Vectors:
        """Return (R, 1) distances along rays to the planes of triangles."""
        across = self._across[triangles]
        with np.errstate(all="ignore"):  # rays in the plane divide by 0
            away: Vectors = _dot(self._corners[triangles, 0] - origins, across)
            distance: Vectors = away / _dot(directions, across)
        return distance


def mirror_image(scene: cc.Scene, camera: cc.Camera, size: tuple[int, int]) -> Truth:
    """Render a scene of Phong and mirror materials with a ray for each pixel, and one more from each mirror.

    Nodes with ``in_captures=False`` are visible, but not reflected. Returns colours (H, W, 4) float32 and ids (H, W).
    """
    nodes = [node for node in scene.nodes if node.mesh is not None and node.visible]
    origins, directions = _pixel_rays(camera, size)
    seen = Geometry(nodes).cast(origins, directions)
    background = np.zeros(4) if scene.background is None else scene.background
    color = _phong(scene, nodes, seen, origins, np.asarray(background, dtype=float)[:3])
    mirrors = {
        node.id: node.material for node in nodes if isinstance(node.material, cc.MirrorMaterial)
    }
    reflective = np.isin(seen.id, list(mirrors))
    incident, normal = directions[reflective], seen.normal[reflective]
    bounced = incident - 2 * _dot(normal, incident) * normal
    start = seen.position[reflective]
    around = Geometry(node for node in nodes if node.in_captures and node.id not in mirrors)
    light = _phong(
        scene, nodes, around.cast(start, bounced), start, np.asarray(background, dtype=float)[:3]
    )
    weights = [mirrors[number] for number in seen.id[reflective]]
    tint = np.array([m.env_weight * m.tint[:3] for m in weights]).reshape(-1, 3)
    own = np.array([m.color_weight * m.color[:3] for m in weights]).reshape(-1, 3)
    color[reflective] = tint * light + own
    width, height = size
    picture = np.concatenate([color, np.ones_like(color[:, :1])], axis=1)
    return picture.reshape(height, width, 4).astype(np.float32), seen.id.reshape(height, width)


def _pixel_rays(camera: cc.Camera, size: tuple[int, int]) -> tuple[Vectors, Vectors]:
    """Return origins and unit directions (H * W, 3) of the rays through the pixels' centers, row 0 on top."""
    width, height = size
    x = (np.arange(width) + 0.5) / width * 2 - 1
    y = 1 - (np.arange(height) + 0.5) / height * 2
    y, x = (grid.reshape(-1) for grid in np.meshgrid(y, x, indexing="ij"))
    to_world = np.linalg.inv(camera.projection(width / height) @ camera.view)
    ends = []
    for depth in (-1.0, 1.0):
        clip = np.stack([x, y, np.full_like(x, depth), np.ones_like(x)], axis=-1) @ to_world.T
        ends.append(clip[:, :3] / clip[:, 3:])
    step = ends[1] - ends[0]
    return ends[0], step / np.linalg.norm(step, axis=-1, keepdims=True)


def _phong(
    scene: cc.Scene, nodes: list[cc.Node], hits: Hits, eye: Vectors, background: Vectors
) -> Vectors:
    """Shade by the formula of document 000: Ka once, and for each lamp Kd and, on lit surfaces, Ks; eye (R, 3)."""
    color: Vectors = np.empty_like(hits.position)
    color[:] = background
    for node in nodes:
        material = node.material
        if not isinstance(material, cc.PhongMaterial):
            continue
        rows = hits.id == node.id
        position, normal = hits.position[rows], hits.normal[rows]
        own = material.color[:3].astype(np.float64)
        total = np.broadcast_to(material.ka * own, position.shape).copy()
        view = eye[rows] - position
        view /= np.linalg.norm(view, axis=-1, keepdims=True)
        for lamp in scene.lights:
            if not isinstance(lamp, cc.PointLight):
                continue
            to_lamp = lamp.position - position
            distance = np.linalg.norm(to_lamp, axis=-1, keepdims=True)
            to_lamp = to_lamp / distance
            lit = _dot(normal, to_lamp)
            mirrored = 2 * lit * normal - to_lamp
            gloss = np.clip(_dot(mirrored, view), 0, 1) ** material.shininess
            answer = material.kd * own * np.maximum(lit, 0) + material.ks * gloss * (lit > 0)
            total += answer * lamp.color * lamp.intensity / distance**lamp.decay
        color[rows] = total
    return color


def _dot(a: Vectors, b: Vectors) -> Vectors:
    product: Vectors = (a * b).sum(axis=-1, keepdims=True)
    return product
