"""Follows paths through a scene and adds up the light that comes back along them."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np

from ..arrays import Array, Bools, Ints
from ..scene.snapshot import Snapshot
from ..surfaces.colors import Points, surface_points
from ..surfaces.geometry import Geometry, Hits
from .bodies import Bodies
from .far_light import FarLight
from .groups import Group, Way
from .lamps import Lamps
from .materials import Materials
from .state import Paths, entered, joined, left_body


class Tracer:
    """Exact rays in a snapshot of a scene.

    Parameters
    ----------
    snapshot : Snapshot
    bounces : int
        How many mirrors, glass surfaces and rough surfaces a path leaves at most.
    seed : int
        Of the random numbers.
    self_hits : bool
        Whether a ray that leaves a node may meet this node again.
    of_capture : bool
        Whether the eye sees what captures see, without the nodes of ``in_captures=False``.
    """

    def __init__(
        self,
        snapshot: Snapshot,
        *,
        bounces: int,
        seed: int,
        self_hits: bool = True,
        of_capture: bool = False,
    ) -> None:
        self.snapshot, self.bounces, self.seed, self.self_hits = snapshot, bounces, seed, self_hits
        nodes = snapshot.nodes
        seen = np.array([n.visible and (n.in_captures or not of_capture) for n in nodes], np.bool_)
        captured = np.array([n.in_captures for n in nodes], np.bool_)
        casting = np.array([n.casts_shadow for n in nodes], np.bool_)
        # Most often all three are the same triangles, and a tree of many takes time and memory.
        made: dict[bytes, Geometry] = {}
        for chosen in (seen, captured, casting):
            if chosen.tobytes() not in made:
                made[chosen.tobytes()] = Geometry(snapshot, chosen[snapshot.node])
        self._seen, self._captured = made[seen.tobytes()], made[captured.tobytes()]
        self._material = np.array([n.material for n in nodes], np.int64)
        # Nodes are few or many thousands; the ways in which they are blended are few.
        known: dict[tuple[object, ...], int] = {}
        self._blends = [(n.blend, n.opacity) for n in nodes]
        keys = [(b and astuple(b), 1.0 if b is None else opacity) for b, opacity in self._blends]
        self._blending = np.array(
            [known.setdefault(key, i) for i, key in enumerate(keys)], np.int64
        )
        self._far = FarLight(snapshot)
        self._bodies = Bodies(snapshot)
        lamps = Lamps(snapshot, made[casting.tobytes()])
        self._materials = Materials(
            snapshot, lamps, self._far, self._bodies, self._captured, bounces=bounces, seed=seed
        )

    # --- rays ---------------------------------------------------------------------------------------------------------

    def light(self, paths: Paths, count: int) -> Array:
        """Follow paths to their ends and give the sums of their light and alpha for `count` slots (count, 4)."""
        sums = np.zeros((count, 4))
        while len(paths):
            paths = self._step(paths, sums)
        return sums

    def hits(self, paths: Paths) -> Hits:
        """Find what the rays of all paths meet first."""
        found = [np.full(len(paths), -1), np.full(len(paths), np.inf), np.zeros((len(paths), 3))]
        for reflected, geometry in ((False, self._seen), (True, self._captured)):
            rows = np.flatnonzero((paths.reflected == reflected) & ~paths.unblocked)
            if not len(rows):
                continue
            p = paths.rows(rows)
            hits = geometry.cast(p.origin, p.direction, inside=p.bodies[:, 0], start=p.start)
            self._touch(hits, p, geometry)
            near = hits.distance <= p.reach
            found[0][rows] = np.where(near, hits.triangle, -1)
            found[1][rows] = np.where(near, hits.distance, np.inf)
            found[2][rows] = hits.weights
        return Hits(*found)

    def _touch(self, hits: Hits, paths: Paths, geometry: Geometry) -> None:
        """Let rays that went through a surface meet what touches it from behind, as a floor touches glass."""
        rows = np.flatnonzero(paths.crossed)
        if len(rows):
            p = paths.rows(rows)
            found, touched = geometry.touching(p.origin, p.direction, p.start)
            at = rows[found]
            hits.triangle[at], hits.weights[at] = touched.triangle, touched.weights
            hits.distance[at] = touched.distance

    def _step(self, paths: Paths, sums: Array) -> Paths:
        hits = self.hits(paths)
        missed = hits.triangle < 0
        if missed.any():
            lost = paths.rows(missed)
            add(sums, lost.slot, lost.factor * self._far.light(lost))
        met = np.flatnonzero(~missed)
        if not len(met):
            return paths.rows(met)
        paths, hits = paths.rows(met), taken(hits, met)
        paths = self._absorbed(paths, hits.distance)
        points = surface_points(self.snapshot, hits, paths.direction)
        passed = self._own(paths, points)
        going = [self.past(paths.rows(passed), points.take(passed), taken(hits, passed))]
        rest = np.flatnonzero(~passed)
        material = self._material[points.node[rest]]
        for index in np.unique(material):
            rows = rest[material == index]
            group = Group(paths.rows(rows), points.take(rows), int(index))
            going += self._met(group, taken(hits, rows), sums)
        return joined(going)

    def _own(self, paths: Paths, points: Points) -> Bools:
        """Find rays that meet the node that they left, if such hits do not count."""
        if self.self_hits:
            return np.zeros(len(paths), np.bool_)
        own: Bools = paths.left == points.node
        outside: Bools = paths.bodies[:, 0] != points.node
        return own & outside

    def _absorbed(self, paths: Paths, distance: Array) -> Paths:
        body = paths.bodies[:, 0]
        rows = np.flatnonzero(body >= 0)
        if len(rows):
            share = np.exp(-self._bodies.extinction[body[rows]] * distance[rows, None])
            paths.factor[rows, :3] *= share
        return paths

    def past(self, paths: Paths, points: Points, hits: Hits) -> Paths:
        """Let rays go on behind what they met."""
        gone = paths.copy()
        gone.origin, gone.start = points.position, hits.triangle
        gone.reach, gone.crossed = paths.reach - hits.distance, np.ones(len(paths), np.bool_)
        gone.step = paths.step + 1
        # Light that was chosen by its brightness comes from where nothing stands in the way.
        gone.density = np.zeros(len(paths))
        return gone

    def _met(self, group: Group, hits: Hits, sums: Array) -> list[Paths]:
        """Add the light of surfaces that rays meet, and give the paths that go on."""
        paths, points = group.paths, group.points
        shaded = self._materials.shade(group)
        going: list[Paths] = []
        blending = self._blending[points.node]
        for index in np.unique(blending):
            blend, opacity = self._blends[int(index)]
            rows = np.flatnonzero(blending == index)
            factor = paths.factor[rows]
            light = shaded.light[rows]
            if blend is None:
                one = np.ones((len(rows), 1))
                add(sums, paths.slot[rows], factor * np.concatenate([light, one], axis=1))
                onward = np.ones((len(rows), 3))
            else:
                alpha = shaded.alpha[rows] * opacity
                own, behind = blend.terms(light, alpha, opacity)
                add(sums, paths.slot[rows], factor * own)
                past = self.past(paths.rows(rows), points.take(rows), taken(hits, rows))
                past.factor = factor * behind
                going.append(past)
                white, _ = blend.terms(np.ones_like(light), alpha, opacity)
                black, _ = blend.terms(np.zeros_like(light), alpha, opacity)
                onward = (white - black)[:, :3]
            place = np.full(len(paths), -1)
            place[rows] = np.arange(len(rows))
            for way in shaded.ways:
                mine = place[way.rows] >= 0
                if mine.any():
                    going.append(
                        self._onward(group, hits, way, mine, onward[place[way.rows[mine]]])
                    )
        return [p for p in going if len(p)]

    def _onward(self, group: Group, hits: Hits, way: Way, mine: Bools, share: Array) -> Paths:
        """Give the paths that leave a surface along a way."""
        rows = way.rows[mine]
        paths, points = group.paths.rows(rows), group.points.take(rows)
        gone = paths.copy()
        gone.origin, gone.direction = points.position, way.direction[mine]
        gone.reach = np.full(len(rows), np.inf)
        gone.factor[:, :3] *= way.weight[mine] * share
        gone.factor[:, 3] = 0  # the alpha of the picture is that of the first opaque surface
        gone.step = paths.step + 1
        gone.bounces = paths.bounces + 1
        gone.unblocked = gone.bounces > self.bounces
        gone.start, gone.left = hits.triangle[rows], points.node
        gone.crossed = (gone.direction * points.face_normal).sum(axis=-1) < 0
        gone.reflected = np.ones(len(rows), np.bool_)
        gone.surroundings = self._far.seen_from(points.node, gone.unblocked)
        gone.ambient = np.full(len(rows), way.ambient)
        gone.density = np.zeros(len(rows)) if way.density is None else way.density[mine]
        if way.entered is not None:
            into = way.entered[mine]
            gone.bodies[into] = entered(gone.bodies[into], points.node[into])
        if way.left is not None:
            out = way.left[mine]
            gone.bodies[out] = left_body(gone.bodies[out])
        if way.channel is not None:
            gone.channel = way.channel[mine]
        return gone.rows(np.flatnonzero(gone.factor[:, :3].any(axis=1)))


def taken(hits: Hits, rows: Ints | Bools) -> Hits:
    """Give some of the hits."""
    return Hits(hits.triangle[rows], hits.distance[rows], hits.weights[rows])


def add(sums: Array, slot: Ints, light: Array) -> None:
    """Add light (R, 4) to the sums of slots (R,), which may repeat."""
    for channel in range(sums.shape[1]):
        sums[:, channel] += np.bincount(slot, light[:, channel], minlength=len(sums))
