"""The light of `StandardMaterial`: of lamps by their formulas, from all around by random directions."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

import numpy as np

from ..arrays import Array, Bools, Ints
from ..bsdf.standard import Sampled, StandardBsdf
from ..scene.records import StandardRecord
from ..scene.snapshot import Snapshot
from ..shading.standard.material import Parameters, Surface
from ..shading.standard.microfacets import mix, schlick
from ..shading.standard.shade import arriving, facing, lit_base, lit_coat
from ..surfaces.colors import standard_point
from ..surfaces.geometry import Geometry
from .far_light import FarLight, balance
from .groups import CHOICE, FACET, LIGHT, LIGHT_TEXEL, Group, Shaded, Way
from .lamps import Lamps

_Rows = TypeVar("_Rows", Parameters, Surface)


class StandardLight:
    """What points of `StandardMaterial` send back, and how their paths go on."""

    def __init__(
        self,
        snapshot: Snapshot,
        lamps: Lamps,
        far: FarLight,
        captured: Geometry,
        *,
        bounces: int,
        seed: int,
    ) -> None:
        self._snapshot, self._lamps, self._far, self._captured = snapshot, lamps, far, captured
        self._bounces, self._seed = bounces, seed

    def shade(self, group: Group, material: StandardRecord) -> Shaded:
        """Shade the points that a group of paths meets."""
        count = len(group.paths)
        p, surface, alpha = standard_point(self._snapshot, group.material, group.points)
        if material.unlit:
            return Shaded(np.broadcast_to(p.color, (count, 3)), alpha)
        numbers = group.three(self._seed, FACET, CHOICE)
        light, ways = np.zeros((count, 3)), []
        inside = group.inside
        for within in (False, True):
            rows = np.flatnonzero(inside == within)
            if not len(rows):
                continue
            part = group.take(rows)
            bsdf = StandardBsdf(_taken(p, rows, count), _taken(surface, rows, count))
            channel = part.paths.channel
            if within:
                found = bsdf.sample_exit(numbers[rows], channel)
                ways.append(_way(rows, found, left=found.transmitted))
            else:
                light[rows] = self._of_lamps(part, bsdf) + self._from_afar(part, bsdf)
                found = bsdf.sample(numbers[rows], channel)
                # In a body, no direction is chosen by the brightness of the environment.
                found.pdf[part.paths.bodies[:, 0] >= 0] = 0
                thick = np.broadcast_to(bsdf.p.thickness, (len(rows), 1))[:, 0] > 0
                ways.append(_way(rows, found, entered=found.transmitted & thick))
        return Shaded(light, alpha, ways)

    def _of_lamps(self, group: Group, bsdf: StandardBsdf) -> Array:
        """Give what the surface emits, and what it sends back of the light of lamps."""
        p, surface = bsdf.p, bsdf.surface
        base = np.asarray(p.emissive, float) * p.emissive_strength * np.ones_like(surface.v)
        coat = np.zeros_like(base)
        coated = bool(np.any(p.clearcoat))
        for index, lamp in enumerate(self._lamps.all):
            towards, irradiance = arriving(lamp, surface.position)
            share = self._lamps.visibility(group, index)
            if share is not None:
                irradiance = irradiance * share[:, None]
            base += lit_base(p, surface, towards) * irradiance
            if coated:
                coat += lit_coat(p, surface, towards) * irradiance
        if not coated:
            return np.asarray(base)
        cosine = facing(surface.clearcoat_n, surface.v)
        both: Array = np.asarray(mix(base, coat, p.clearcoat * schlick(0.04, 1.0, cosine)))
        return both

    def _from_afar(self, group: Group, bsdf: StandardBsdf) -> Array:
        """Give what the surface sends back of the environment, for one direction that is chosen by its brightness."""
        paths, points = group.paths, group.points
        light = np.zeros((len(paths), 3))
        ends = paths.bounces >= self._bounces
        around = self._far.seen_from(points.node, ends)
        numbers = group.three(self._seed, LIGHT, LIGHT_TEXEL)
        direction, density, sky = self._far.toward(around, numbers)
        # A ray in a body of glass meets its surface first.
        rows = np.flatnonzero((density > 0) & (paths.bodies[:, 0] < 0))
        if not len(rows):
            return light
        answer = bsdf.evaluate(direction)[rows] * sky[rows]
        own = density[rows, None]
        answer *= balance(own, bsdf.pdf(direction)[rows]) / own
        lit = np.flatnonzero(answer.any(axis=1))
        free = ends[rows[lit]]
        seen = np.flatnonzero(~free)
        if len(seen):
            at = rows[lit[seen]]
            hits = self._captured.cast(
                points.position[at], direction[at], start=points.triangle[at]
            )
            free[seen] = hits.triangle < 0
        light[rows[lit]] = answer[lit] * free[:, None]
        return light


def _way(
    rows: Ints, found: Sampled, entered: Bools | None = None, left: Bools | None = None
) -> Way:
    return Way(
        rows,
        found.l,
        found.weight,
        density=found.pdf[:, 0],
        entered=entered,
        left=left,
        channel=found.channel,
        ambient=True,
    )


def _taken(values: _Rows, rows: Ints, count: int) -> _Rows:
    """Give some rows of parameters or of surfaces; numbers that are the same for all rows stay as they are."""
    taken: dict[str, Any] = {}
    for each in fields(values):
        value = getattr(values, each.name)
        some = isinstance(value, np.ndarray) and value.ndim == 2 and len(value) == count
        taken[each.name] = value[rows] if some else value
    return type(values)(**taken)
