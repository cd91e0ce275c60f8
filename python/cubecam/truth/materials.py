"""What each kind of material sends back along a ray, and the ways on which the light came there."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .bodies import Bodies
from .far_light import FarLight
from .geometry import Geometry
from .glass import glass_way
from .paths import Flags, Paths, Whole
from .records import BasicRecord, GlassRecord, MirrorRecord, PhongRecord, StandardRecord
from .sampler import Array, pairs
from .shading.fresnel import schlick
from .shading.lights import Ambient, way_to
from .shading.phong_model import phong
from .shading.vectors import dot, reflect
from .snapshot import Snapshot
from .surfaces import Points, basic_color, phong_parameters

#: Pairs of random numbers that a path uses at each surface; pair 0 is the place in the pixel.
_PAIRS = 4
_FACET, _CHOICE, _LIGHT, _LIGHT_TEXEL = range(_PAIRS)


@dataclass
class Way:
    """How some of the paths at a surface go on: rows of the group, directions (R, 3) and weights (R, 3).

    `density` (R,) is that of the choice of a rough surface, 0 where there was none. `entered` and `left` say which rays
    go into the body of the surface or out of it.
    """

    rows: Whole
    direction: Array
    weight: Array
    density: Array | None = None
    entered: Flags | None = None
    left: Flags | None = None
    channel: Whole | None = None
    ambient: bool = False


@dataclass
class Shaded:
    """What a surface sends back (R, 3) without the ways on, its alpha (R, 1), and these ways."""

    light: Array
    alpha: Array
    ways: list[Way] = field(default_factory=list)


@dataclass
class Group:
    """Paths that meet surfaces of one material."""

    paths: Paths
    points: Points
    material: int  # its place in the snapshot

    @property
    def inside(self) -> Flags:
        """Whether each ray meets the body that it runs in from within."""
        return self.points.back & (self.paths.bodies[:, 0] == self.points.node)

    def take(self, rows: Whole) -> Group:
        """Give some of the paths with their points."""
        return Group(self.paths.rows(rows), self.points.take(rows), self.material)

    def numbers(self, seed: int, pair: int) -> Array:
        """Give (R, 2) random numbers for one of the pairs of this surface."""
        p = self.paths
        return pairs(p.pixel, p.sample, 1 + p.step * _PAIRS + pair, seed)


class Materials:
    """The materials of a snapshot under its lights, with what stands in the way of these.

    Parameters
    ----------
    snapshot : Snapshot
    casters : Geometry or None
        What stops the light of lamps with shadows.
    captured : Geometry
        What surfaces reflect, and what therefore stops light from far away.
    far : FarLight
    bodies : Bodies
    bounces, seed : int
        As for `Tracer`.
    """

    def __init__(
        self,
        snapshot: Snapshot,
        casters: Geometry | None,
        captured: Geometry,
        far: FarLight,
        bodies: Bodies,
        *,
        bounces: int,
        seed: int,
    ) -> None:
        self._snapshot, self._casters, self._captured = snapshot, casters, captured
        self._far, self._bodies = far, bodies
        self._bounces, self._seed = bounces, seed
        nodes = snapshot.nodes
        self._receives = np.array([n.receive_shadow for n in nodes], np.bool_)

    def shade(self, group: Group) -> Shaded:
        """Shade the points that a group of paths meets."""
        material = self._snapshot.materials[group.material]
        if isinstance(material, BasicRecord):
            return self._basic(group)
        if isinstance(material, PhongRecord):
            return self._phong(group)
        if isinstance(material, MirrorRecord):
            return self._mirror(group, material)
        if isinstance(material, GlassRecord):
            return self._glass(group, material)
        return self._standard(group, material)

    def _basic(self, group: Group) -> Shaded:
        return Shaded(*basic_color(self._snapshot, group.material, group.points))

    def _phong(self, group: Group) -> Shaded:
        found = phong_parameters(self._snapshot, group.material, group.points)
        lights = [*self._snapshot.lights, Ambient(self._snapshot.ambient)]
        visibility = [self._visibility(group, index) for index in range(len(lights) - 1)]
        light = phong(
            group.points.position,
            group.points.normal,
            # The eye lies somewhere back along the ray.
            group.points.position - group.paths.direction,
            found.color,
            lights,
            found.ka,
            found.kd,
            found.ks,
            found.shininess,
            [*visibility, None],
        )
        return Shaded(light, found.alpha)

    def _mirror(self, group: Group, material: MirrorRecord) -> Shaded:
        points, paths = group.points, group.paths
        direction = reflect(paths.direction, points.normal)
        weight = np.broadcast_to(material.env_weight * material.tint[:3], direction.shape)
        if material.f0 is not None:
            weight = weight * schlick(material.f0, -dot(paths.direction, points.normal))
        light = np.broadcast_to(material.color_weight * material.color[:3], direction.shape)
        one = np.ones((len(paths), 1))
        return Shaded(light, one, [Way(np.arange(len(paths)), direction, weight)])

    def _glass(self, group: Group, material: GlassRecord) -> Shaded:
        paths, points, inside = group.paths, group.points, group.inside
        own = np.full((len(paths), 1), material.ior)
        # What lies on the other side of the surface: the next body for a ray that leaves, the present one else.
        other = self._bodies.ior_around(paths, np.where(inside, 1, 0))[:, None]
        eta = np.where(inside[:, None], own / other, other / own)
        numbers = np.concatenate(
            [group.numbers(self._seed, _FACET), group.numbers(self._seed, _CHOICE)], axis=1
        )[:, :3]
        way = glass_way(
            points.normal, -paths.direction, eta, float(material.roughness) ** 2, material.fresnel, numbers
        )
        # The tint colours the light once, where it enters.
        goes_in = way.through & ~inside
        weight = way.weight * np.where(goes_in[:, None], material.tint[:3], 1.0)
        ways = [
            Way(
                np.arange(len(paths)),
                way.direction,
                weight,
                entered=goes_in,
                left=way.through & inside,
            )
        ]
        return Shaded(np.zeros((len(paths), 3)), np.ones((len(paths), 1)), ways)

    def _visibility(self, group: Group, index: int) -> Array | None:
        """Give the share (R,) of a lamp's light that arrives, None if nothing stops it."""
        if self._casters is None or not self._snapshot.shadows[index]:
            return None
        points = group.points
        towards, distance = way_to(self._snapshot.lights[index], points.position)
        rows = np.flatnonzero(
            self._receives[points.node] & (dot(points.normal, towards)[:, 0] > 0)
        )
        share = np.ones(len(points.node))
        if len(rows):
            towards, distance = way_to(self._snapshot.lights[index], points.lifted[rows])
            blocked = self._casters.blocked(
                points.lifted[rows], towards, distance[:, 0], start=points.triangle[rows]
            )
            share[rows] = ~blocked
        return share

    def _standard(self, group: Group, material: StandardRecord) -> Shaded:
        raise NotImplementedError
