"""Where a ray from P along R meets what a cubemap shows that was captured in C: the direction to look up.

Positions and directions are world vectors (..., 3) that broadcast together; directions R are unit vectors. C is where
the cube was captured, its axes are the world's. X = P - C.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .cubes import footprint, gathered, largest_part, padded, sample_padded
from .vectors import Array

#: `Parallax.layer`: the ray meets nothing, a surface of the near layer or a proxy, a surface of the far layer.
NOTHING, NEAR, FAR = -1, 0, 1

#: Bisections of an interval: t is exact to 1e-9 even where |X| is a millionth of it.
_HALVINGS = 40


class Parallax(NamedTuple):
    """Where rays end.

    Attributes
    ----------
    direction : ndarray (..., 3) float64
        What to look up: the vector from C to the hit, not normalised; R itself where the ray meets nothing.
    distance : ndarray (...) float64
        The distance t from P to the hit, in units of the world; inf where the ray meets nothing.
    layer : ndarray (...) int64
        The layer to look up: `NEAR` (also for proxies), `FAR`, or `NOTHING` where the ray meets nothing.
    accepted : ndarray (...) bool
        Whether the hit lies on a captured surface. False for a guess where no crossing does, and for `NOTHING`.
    """

    direction: Array
    distance: Array
    layer: npt.NDArray[np.int64]
    accepted: npt.NDArray[np.bool_]


def box_direction(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    center: npt.ArrayLike,
    low: npt.ArrayLike,
    high: npt.ArrayLike,
    matrix: npt.ArrayLike | None = None,
) -> Parallax:
    """The direction through the point where rays leave a box.

    S. Lagarde, A. Zanuttini, "Local image-based lighting with parallax-corrected cubemaps" (SIGGRAPH 2012 talks): the
    first point where the ray leaves a slab is the exit. A ray from outside that meets the box leaves it as well. The
    slabs are those of T. Kay, J. Kajiya, "Ray tracing complex scenes" (SIGGRAPH 1986).

    Parameters
    ----------
    position, direction : array_like (..., 3)
        P and R.
    center : array_like (3,)
        C, in the world.
    low, high : array_like (3,)
        Two opposite corners of the box in its own space, low < high.
    matrix : array_like (4, 4), optional
        From the box's space to the world. None: the space is the world.

    Returns
    -------
    Parallax
        R itself for rays that miss the box, or that the box lies behind of.

    Examples
    --------
    >>> found = box_direction((0.5, 0, 0), (0, 1, 0), (0, 0, 0), (-1, -2, -1), (1, 2, 1))
    >>> found.direction.tolist(), float(found.distance)
    ([0.5, 2.0, 0.0], 2.0)
    """
    p, r = _in_space(position, direction, matrix)
    low, high = np.asarray(low, float), np.asarray(high, float)
    across = r != 0
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (low - p) / r, (high - p) / r
    within = (low <= p) & (p <= high)
    # A ray along a slab is between its planes for ever, or never.
    enters = np.where(across, np.minimum(first, second), np.where(within, -np.inf, np.inf))
    leaves = np.where(across, np.maximum(first, second), np.where(within, np.inf, -np.inf))
    exit_ = leaves.min(axis=-1)
    met = (enters.max(axis=-1) <= exit_) & (exit_ > 0)
    return _of_proxy(position, direction, center, np.where(met, exit_, np.inf))


def sphere_direction(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    center: npt.ArrayLike,
    low: npt.ArrayLike,
    high: npt.ArrayLike,
    matrix: npt.ArrayLike | None = None,
) -> Parallax:
    """The direction through the point where rays leave the ellipsoid that a box encloses.

    K. Bjorke, "Image-based lighting" (GPU Gems, chapter 19), for a sphere; a box of unequal edges scales its space so
    that the ellipsoid becomes the unit sphere, in which |p + t r|^2 = 1 has the exit as its greater root.

    Parameters
    ----------
    position, direction, center, low, high, matrix
        As for `box_direction`; the ellipsoid touches the box's six sides.

    Returns
    -------
    Parallax
        R itself for rays that miss the ellipsoid, or that it lies behind of.

    Examples
    --------
    >>> found = sphere_direction((0.6, 0, 0), (0, 1, 0), (0, 0, 0), (-1, -1, -1), (1, 1, 1))
    >>> found.direction.tolist(), float(found.distance)
    ([0.6, 0.8, 0.0], 0.8)
    """
    p, r = _in_space(position, direction, matrix)
    low, high = np.asarray(low, float), np.asarray(high, float)
    p, r = (p - (low + high) / 2) / ((high - low) / 2), r / ((high - low) / 2)
    a, b, c = ((x * y).sum(axis=-1) for x, y in ((r, r), (p, r), (p, p)))
    square = b * b - a * (c - 1)
    exit_ = (-b + np.sqrt(np.maximum(square, 0))) / a
    met = (square >= 0) & (exit_ > 0)
    return _of_proxy(position, direction, center, np.where(met, exit_, np.inf))


def inverse_depth(z: npt.ArrayLike) -> Array:
    """W = 1/z of the output "z" of a capture; 0 where nothing was captured (z infinite).

    z is the distance along the face's axis, max(|x|, |y|, |z|) of the point seen from C. On a face 1/z of a plane is
    linear in s and t, so that bilinear lookups of W stay on planes; those of z or of the distance do not.
    """
    z = np.asarray(z, float)
    w: Array = np.divide(1.0, z, out=np.zeros_like(z), where=np.isfinite(z) & (z > 0))
    return w


def march(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    center: npt.ArrayLike,
    near: npt.ArrayLike,
    far: npt.ArrayLike | None = None,
    *,
    steps: int = 512,
    tolerance: float | None = None,
) -> Parallax:
    """The direction through the first captured surface along rays.

    After L. Szirmay-Kalos and others, "Approximate ray-tracing on the GPU with distance impostors" (Computer Graphics
    Forum 24(3), 2005), whose impostors hold distances; here they hold W (`inverse_depth`). A point Q = X + t R of the
    ray is in front of the captured surface where f(t) = max(|Qx|, |Qy|, |Qz|) W(Q) - 1 is below 0, and behind it
    above 0. The ray is walked in many steps, so that no surface of some size is overlooked; each change of sign is
    bisected.

    A lookup of W mixes four texels, which makes a wall of what lies between an object and what is behind it. A
    crossing is accepted if it lies on what one of the four texels shows: |max(|Qx|, |Qy|, |Qz|) Wi - 1| < tolerance
    for one of them.

    Parameters
    ----------
    position, direction : array_like (..., 3)
        P and R.
    center : array_like (3,)
        C.
    near : array_like (6, N, N)
        z of the nearest surfaces, world units; inf where there is none: the output "z" of ``renderer.capture``. Rays
        meet them from the front only, f from below to above 0.
    far : array_like (6, N, N), optional
        z of the farthest surfaces, which ``depth_order="farthest"`` gives. Rays meet them from both sides.
    steps : int
        Intervals, uniform in s from 0 to 1, where t = |X| s / (1 - s): the last one reaches to infinity.
    tolerance : float, optional
        None: .02 + 3 / N.

    Returns
    -------
    Parallax
        The nearest accepted hit. Without one, the last crossing of the near layer, not accepted. R where the ray
        crosses nothing, as when it leaves to the background.

    Examples
    --------
    A cube of half extent 2 around C, seen from a place beside C:

    >>> room = np.full((6, 4, 4), 2.0)
    >>> found = march((0.5, 0, 0), (0, 1, 0), (0, 0, 0), room)
    >>> found.direction.round(9).tolist(), round(float(found.distance), 9), int(found.layer)
    ([0.5, 2.0, 0.0], 2.0, 0)
    """
    p, r = np.broadcast_arrays(np.asarray(position, float), np.asarray(direction, float))
    shape = p.shape[:-1]
    x, r = (p - np.asarray(center, float)).reshape(-1, 3), r.reshape(-1, 3)
    layers = [padded(inverse_depth(z)) for z in (near, far) if z is not None]
    size = layers[0].shape[1] - 2
    limit = 0.02 + 3 / size if tolerance is None else tolerance

    # A ray from C sees one texel all along, on which it ends; s would not move it.
    at_center = ~x.any(axis=-1)
    inverse = largest_part(r) * sample_padded(layers[0], r)
    accepted = at_center & (inverse > 0)
    distance = np.divide(1.0, inverse, out=np.full(len(x), np.inf), where=accepted)
    layer = np.where(accepted, NEAR, NOTHING).astype(np.int64)
    rays = np.flatnonzero(~at_center)  # those that have met nothing yet
    before = [_height(w, x[rays], r[rays], 0.0) for w in layers]
    for step in range(1, steps + 1):
        if not len(rays):
            break
        ends = ((step - 1) / steps, step / steps)
        after = [_height(w, x[rays], r[rays], ends[1]) for w in layers]
        best = np.full(len(rays), np.inf)
        which = np.full(len(rays), NOTHING, np.int64)
        for number, w in enumerate(layers):
            into = (before[number] < 0) & (after[number] > 0)
            out = (before[number] > 0) & (after[number] < 0)
            crossed = np.flatnonzero(into | out if number == FAR else into)
            if not len(crossed):
                continue
            ray = rays[crossed]
            t = _bisected(w, x[ray], r[ray], ends, into[crossed])
            good = _on_a_surface(w, x[ray] + t[:, None] * r[ray], limit)
            if number == NEAR:  # a guess, until something is accepted
                distance[ray], layer[ray] = t, NEAR
            nearer = good & (t < best[crossed])
            best[crossed[nearer]], which[crossed[nearer]] = t[nearer], number
        done = which != NOTHING
        distance[rays[done]], layer[rays[done]] = best[done], which[done]
        accepted[rays[done]] = True
        # A layer that a ray only touches keeps the sign that it had.
        before = [np.where(a == 0, b, a)[~done] for a, b in zip(after, before, strict=True)]
        rays = rays[~done]
    met = layer != NOTHING
    found = np.where(met[:, None], x + np.where(met, distance, 0.0)[:, None] * r, r)
    return Parallax(
        found.reshape(*shape, 3),
        distance.reshape(shape),
        layer.reshape(shape),
        accepted.reshape(shape),
    )


def roughness_at(roughness: npt.ArrayLike, found: Parallax) -> Array:
    """The roughness by which to look up what a rough surface in P sees of a cube that was filtered in C.

    After S. Lagarde, C. de Rousiers, "Moving Frostbite to physically based rendering 3.0" (SIGGRAPH 2014 course
    notes), section 4.9.3: the lobe's cone has a footprint at the hit, and the cone from C with the same footprint
    tells the roughness. Half of the facets of GGX lie within the angle atan(alpha) of the normal (B. Walter and
    others, "Microfacet models for refraction through rough surfaces", EGSR 2007, equation 35), so that half of the
    light comes from within 2 atan(alpha) of the lobe's middle. With a tangent that is t / |X + t R| times as large
    from C, atan(alpha') is half of that angle. Alpha is roughness^2. For small alpha, roughness' is roughness times
    the root of t / |X + t R|.

    Parameters
    ----------
    roughness : array_like (...)
        From 0 to 1.
    found : Parallax
        Where the ray along the middle of the lobe ends. Where it meets nothing, the roughness remains.

    Returns
    -------
    ndarray (...) float64

    Examples
    --------
    >>> found = box_direction((1, 0, 0), (1, 0, 0), (0, 0, 0), (-2, -2, -2), (2, 2, 2))
    >>> float(roughness_at(0.1, found).round(4)), round(0.1 * 0.5**0.5, 4)
    (0.0707, 0.0707)
    """
    met = np.isfinite(found.distance)
    from_center = np.sqrt((found.direction**2).sum(axis=-1))
    with np.errstate(divide="ignore"):
        ratio = np.where(met, found.distance, 1.0) / np.where(met, from_center, 1.0)
    angle = 2 * np.arctan(np.asarray(roughness, float) ** 2)
    seen = np.arctan2(ratio * np.sin(angle), np.cos(angle))
    result: Array = np.sqrt(np.tan(seen / 2))
    return result


def _in_space(
    position: npt.ArrayLike, direction: npt.ArrayLike, matrix: npt.ArrayLike | None
) -> tuple[Array, Array]:
    """P and R in the space of a proxy. R is not normalised again, so that t stays the distance in the world."""
    p, r = np.asarray(position, float), np.asarray(direction, float)
    if matrix is None:
        return p, r
    inverse = np.linalg.inv(np.asarray(matrix, float))
    return p @ inverse[:3, :3].T + inverse[:3, 3], r @ inverse[:3, :3].T


def _of_proxy(
    position: npt.ArrayLike, direction: npt.ArrayLike, center: npt.ArrayLike, t: Array
) -> Parallax:
    p, r = np.broadcast_arrays(np.asarray(position, float), np.asarray(direction, float))
    met = np.isfinite(t)
    hit = p - np.asarray(center, float) + np.where(met, t, 0.0)[..., None] * r
    return Parallax(
        np.where(met[..., None], hit, r), t, np.where(met, NEAR, NOTHING).astype(np.int64), met
    )


def _distance(x: Array, s: Array | float) -> Array:
    """t = |X| s / (1 - s)."""
    result: Array = np.sqrt((x * x).sum(axis=-1)) * s / (1 - s)
    return result


def _height(w: Array, x: Array, r: Array, s: Array | float) -> Array:
    """f at s; at s = 1 the sign of what lies in the direction R, infinitely far away."""
    if np.isscalar(s) and s == 1:
        return np.where(sample_padded(w, r) > 0, 1.0, -1.0)
    q = x + _distance(x, s)[..., None] * r
    at_center = largest_part(q) == 0
    q = np.where(at_center[..., None], r, q)
    return np.where(at_center, -1.0, largest_part(q) * sample_padded(w, q) - 1)


def _bisected(
    w: Array, x: Array, r: Array, ends: tuple[float, float], into: npt.NDArray[np.bool_]
) -> Array:
    """t where f changes its sign between two s, from below to above 0 where `into`."""
    low, high = np.full(len(x), ends[0]), np.full(len(x), ends[1])
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        passed = (_height(w, x, r, middle) > 0) == into
        low, high = np.where(passed, low, middle), np.where(passed, middle, high)
    return _distance(x, low)


def _on_a_surface(w: Array, q: Array, limit: float) -> npt.NDArray[np.bool_]:
    """Whether points lie on what one of the four texels around them shows."""
    texels = gathered(w, footprint(q, w.shape[1] - 2))
    found: npt.NDArray[np.bool_] = (
        np.abs(largest_part(q)[..., None] * texels - 1).min(axis=-1) < limit
    )
    return found
