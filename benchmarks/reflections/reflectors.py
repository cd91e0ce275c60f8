"""What reflects: mirrors, rough metal, glass, two that face each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import cubecam as cc

from .scenes import PLACES, load
from .stage import PLACE

WHITE = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Reflector:
    """One kind of reflector.

    Attributes
    ----------
    add : callable
        Adds the nodes to a `World`'s scene and gives them.
    size : int
        Pixels along an edge of the frame.
    samples : int
        Paths of each pixel of the exact picture. 1, through the middle as in a frame, where there is no noise.
    bounces : int
        Of the exact picture, unless a benchmark counts them.
    mirror : bool
        Whether the hit points can be compared: the surface is a mirror that no other one is seen in.
    """

    add: Callable[[World], list[cc.Node]]
    size: int = 512
    samples: int = 1
    bounces: int = 1
    mirror: bool = False


class World:
    """A scene with a reflector in it, its camera, and what a proxy needs to know.

    Parameters
    ----------
    place, reflector : str
        Names of `PLACES` and `REFLECTORS`.
    """

    def __init__(self, place: str, reflector: str) -> None:
        self.place, self.reflector = PLACES[place], REFLECTORS[reflector]
        self.scene = load(place)
        (empty,) = self.scene.find(PLACE)
        self.middle = np.asarray(empty.position, float)
        (camera,) = self.scene.cameras
        if not isinstance(camera, cc.PerspectiveCamera):
            raise TypeError(f"{place}: expected a PerspectiveCamera, got {camera}")
        self.camera = camera
        self.nodes = self.reflector.add(self)

    def put(self, mesh: cc.Mesh, material: cc.Material, at: tuple[float, float, float]) -> cc.Node:
        """Add a node beside the middle of the place."""
        return self.scene.add(mesh, material, position=np.add(self.middle, at))


def _ball(material: Callable[[], cc.Material]) -> Callable[[World], list[cc.Node]]:
    def add(world: World) -> list[cc.Node]:
        mesh = cc.Mesh.sphere(world.place.radius, 256, 128)
        return [world.put(mesh, material(), (0, 0, 0))]

    return add


def _glossy(roughness: float) -> Callable[[], cc.Material]:
    return lambda: cc.StandardMaterial(color=WHITE, metallic=1, roughness=roughness)


def _teapot(world: World) -> list[cc.Node]:
    mesh = cc.load_mesh(cc.sample_data("teapot.obj")).resized(2.6 * world.place.radius)
    node = world.put(mesh, cc.MirrorMaterial(), (0, 0, 0))
    node.rotation = cc.axis_angle((0, 1, 0), -30)
    return [node]


def _facing_balls(world: World) -> list[cc.Node]:
    radius = 0.72 * world.place.radius
    mesh = cc.Mesh.sphere(radius, 192, 96)
    balls = [
        world.put(mesh, cc.MirrorMaterial(), (x, 0, 0)) for x in (-1.15 * radius, 1.15 * radius)
    ]
    world.camera.position = np.add(world.middle, (0.25, 0.3, 3.9 * world.place.radius))
    world.camera.fov = 46
    return balls


def _facing_planes(world: World) -> list[cc.Node]:
    # Seen by a camera between the two, which looks into the left one.
    mesh, apart = cc.Mesh.plane(1.3, 2.0), 0.85
    found = []
    for side in (-1, 1):
        node = world.put(mesh, cc.MirrorMaterial(tint=(0.9, 0.95, 0.93)), (side * apart, 0.15, 0))
        node.rotation = cc.axis_angle((0, 0, 1), 90 * side)
        found.append(node)
    world.camera.position = np.add(world.middle, (0.55, 0.3, 1.25))
    world.camera.look_at(np.add(world.middle, (-0.75, 0.05, -0.05)))
    world.camera.fov = 62
    return found


def _quad(world: World) -> list[cc.Node]:
    """A mirror on a stand, whose plane a planar mirror or a probe shows."""
    node = world.put(cc.Mesh.plane(0.95, 0.8), cc.MirrorMaterial(), (0, 0.05, 0))
    way = world.camera.position - world.middle
    turn = np.degrees(np.arctan2(way[0], way[2])) - 20
    node.rotation = _times(cc.axis_angle((0, 1, 0), turn), cc.axis_angle((1, 0, 0), 80))
    return [node]


def _floor(world: World) -> list[cc.Node]:
    """A floor of polished stone, seen from above: what stands on it is in the picture."""
    ground = float(world.place.low[1]) + 0.004 - world.middle[1]
    node = world.put(cc.Mesh.plane(6.0, 6.0), cc.MirrorMaterial(), (0, ground, 0))
    world.camera.position = np.add(world.middle, (-0.6, 1.1, 2.9))
    world.camera.look_at(np.add(world.middle, (0.1, 0.6 * ground, -0.9)))
    world.camera.fov = 58
    return [node]


def _times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The product of quaternions (w, x, y, z): first b, then a."""
    (w, x, y, z), (p, q, r, s) = a, b
    return np.array(
        (
            w * p - x * q - y * r - z * s,
            w * q + x * p + y * s - z * r,
            w * r - x * s + y * p + z * q,
            w * s + x * r - y * q + z * p,
        )
    )


REFLECTORS = {
    "mirror": Reflector(_ball(cc.MirrorMaterial), mirror=True),
    "teapot": Reflector(_teapot, mirror=True),
    "glossy .2": Reflector(_ball(_glossy(0.2)), size=112, samples=400),
    "glossy .4": Reflector(_ball(_glossy(0.4)), size=112, samples=400),
    "glass": Reflector(_ball(lambda: cc.GlassMaterial(ior=1.5)), size=256, samples=48, bounces=4),
    "facing balls": Reflector(_facing_balls, bounces=8),
    "plane": Reflector(_quad, mirror=True),
    "floor": Reflector(_floor, mirror=True),
    "facing planes": Reflector(_facing_planes, bounces=4),
}
