"""Scenes that are built twice, for rays and for the oracle, and rays through the pixels of a camera."""

from typing import Any

import numpy as np

import cubecam as cc
from cubecam.truth.scene.snapshot import read
from cubecam.truth.surfaces.geometry import Geometry
from tests.gl.world import World
from tests.reference import transforms as ref

#: It looks at the plane of `one`.
FRONT = cc.PerspectiveCamera(position=(0, 0, 3), fov=60)


def one(material=None, **more):
    """A scene of one plane that faces the camera."""
    scene = cc.Scene()
    node = scene.add(
        cc.Mesh.plane(2, 2),
        material,
        rotation=cc.axis_angle((1, 0, 0), 90),
        name="wall",
        **more,
    )
    return scene, node


def random_world(seed):
    """Turned, scaled and mirrored spheres, boxes, planes and tori round the origin."""
    rng = np.random.default_rng(seed)
    world = World()

    def place():
        direction = rng.normal(size=3)
        scale = rng.uniform(0.5, 1.5, 3) * rng.choice([-1, 1], 3)
        return {
            "position": direction / np.linalg.norm(direction) * rng.uniform(2.5, 4.5),
            "axis": rng.normal(size=3),
            "degrees": rng.uniform(0, 360),
            "scale": scale,
        }

    for _ in range(3):
        world.box(rounded(rng.uniform(1, 2.5, 3)), **place())
        world.sphere(rng.uniform(0.8, 1.4), subdivisions=1, **place())
        world.plane(*rounded(rng.uniform(2, 5, 2)), **place())
    both = cc.BasicMaterial(double_sided=True)
    world.plane(2, 1.5, material=both, **place())
    world.mesh(cc.Mesh.torus(1.2, 0.4, 12, 8), **place())
    world.mesh(cc.Mesh.torus(1.2, 0.4, 12, 8), material=both, **place())
    return world


def rounded(sizes):
    """Numbers that float32 holds, so that meshes have exactly these sizes."""
    return np.round(np.asarray(sizes) * 64) / 64


def random_directions(rng, count):
    directions = rng.normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def ids_of(snapshot, hits):
    """The ids of the nodes that rays met, 0 for none."""
    ids = np.array([node.id for node in snapshot.nodes])
    return np.where(hits.triangle >= 0, ids[snapshot.node[hits.triangle]], 0)


def seen(scene, camera, size):
    """(snapshot, hits, origins, directions) of the rays through a camera's pixels, in rows."""
    snapshot = read(scene)
    origins, directions = ref.pixel_rays(camera.view, camera.projection(size[0] / size[1]), size)
    directions = directions.reshape(-1, 3)
    directions = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    origins = np.broadcast_to(origins, (size[1], size[0], 3)).reshape(-1, 3)
    return snapshot, Geometry(snapshot).cast(origins, directions), origins, directions


def materials_of(snapshot) -> list[Any]:
    """The records of a snapshot's materials; the test knows of which kind they are."""
    return list(snapshot.materials)
