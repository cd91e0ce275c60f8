"""What each kind of material sends back along a ray, and the ways on which the light came there."""

from __future__ import annotations

import numpy as np

from ..scene.records import BasicRecord, GlassRecord, MirrorRecord, PhongRecord
from ..scene.snapshot import Snapshot
from ..shading.fresnel import schlick
from ..shading.lights import Ambient
from ..shading.phong_model import phong
from ..shading.vectors import dot, reflect
from ..surfaces.colors import basic_color, phong_parameters
from ..surfaces.geometry import Geometry
from .bodies import Bodies
from .far_light import FarLight
from .glass import glass_way
from .groups import CHOICE, FACET, Group, Shaded, Way
from .lamps import Lamps
from .standard import StandardLight


class Materials:
    """The materials of a snapshot, with what `Lamps` and `FarLight` shine on them."""

    def __init__(
        self,
        snapshot: Snapshot,
        lamps: Lamps,
        far: FarLight,
        bodies: Bodies,
        captured: Geometry,
        *,
        bounces: int,
        seed: int,
    ) -> None:
        self._snapshot, self._lamps, self._bodies, self._seed = snapshot, lamps, bodies, seed
        self._standard = StandardLight(snapshot, lamps, far, captured, bounces=bounces, seed=seed)

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
        return self._standard.shade(group, material)

    def _basic(self, group: Group) -> Shaded:
        return Shaded(*basic_color(self._snapshot, group.material, group.points))

    def _phong(self, group: Group) -> Shaded:
        found = phong_parameters(self._snapshot, group.material, group.points)
        lights = [*self._lamps.all, Ambient(tuple(self._lamps.ambient))]
        visibility = [self._lamps.visibility(group, index) for index in range(len(lights) - 1)]
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
        if material.dispersion > 0 and material.ior != 1:
            return self._dispersed(group, material)
        way = self._glass_way(group, material)
        return Shaded(np.zeros((len(group.paths), 3)), np.ones((len(group.paths), 1)), [way])

    def _dispersed(self, group: Group, material: GlassRecord) -> Shaded:
        """Part white light into three ways, one for each colour; light of one colour stays as it is."""
        count = len(group.paths)
        ways = []
        for channel in range(3):
            rows = np.flatnonzero((group.paths.channel < 0) | (group.paths.channel == channel))
            if not len(rows):
                continue
            part = group.take(rows)
            part.paths.channel = np.full(len(rows), channel)
            way = self._glass_way(part, material)
            way.rows, way.channel = rows, part.paths.channel
            way.weight = way.weight * (np.arange(3) == channel)
            ways.append(way)
        return Shaded(np.zeros((count, 3)), np.ones((count, 1)), ways)

    def _glass_way(self, group: Group, material: GlassRecord) -> Way:
        paths, points, inside = group.paths, group.points, group.inside
        own = self._bodies.ior[points.node, np.where(paths.channel < 0, 1, paths.channel)][:, None]
        # What lies on the other side of the surface: the next body for a ray that leaves, the present one else.
        other = self._bodies.ior_around(paths, np.where(inside, 1, 0))[:, None]
        eta = np.where(inside[:, None], own / other, other / own)
        numbers = group.three(self._seed, FACET, CHOICE)
        way = glass_way(
            points.normal,
            -paths.direction,
            eta,
            float(material.roughness) ** 2,
            material.fresnel,
            numbers,
        )
        # The tint colours the light once, where it enters.
        goes_in = way.through & ~inside
        weight = way.weight * np.where(goes_in[:, None], material.tint[:3], 1.0)
        return Way(
            np.arange(len(paths)),
            way.direction,
            weight,
            entered=goes_in,
            left=way.through & inside,
        )
