"""The lobes of StandardMaterial at a batch of points, and directions drawn from them: see `standard_bsdf`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import Array, Bools
from ..shading.standard.material import Parameters, Surface, anisotropy_frame
from ..shading.standard.microfacets import half_way, max3, mix, schlick, sheen_brdf
from ..shading.standard.samples import frame_around
from ..shading.standard.shade import Fresnel, facing, fresnels, scattered
from ..shading.standard.tables import brdf_terms, sheen_albedo
from ..shading.vectors import dot, refract
from .ggx import GgxLobe

__all__ = ["Sampled", "StandardBsdf"]


#: The lobes from which a direction is drawn.
SPECULAR, COAT, COSINE, UNIFORM, THROUGH = range(5)


def _mean(color: Array) -> Array:
    return dot(color, np.full(3, 1 / 3))


@dataclass
class Sampled:
    """Directions that paths take next.

    Attributes
    ----------
    l : array (R, 3)
        Unit vectors.
    weight : array (R, 3)
        What a path is multiplied with: scattered light times |cos| over the density; 0 where it ends.
    pdf : array (R, 1)
        The density of l, as `pdf` gives it; 0 where `delta` or `transmitted` holds, since no other way of drawing
        directions finds these.
    delta, transmitted : bool arrays (R,)
        Whether the surface is smooth for this lobe; whether l is on the other side.
    channel : int array (R,)
        The colour channel that the path carries alone from here, where dispersion chose one; else -1.
    """

    l: Array  # noqa: E741
    weight: Array
    pdf: Array
    delta: Bools
    transmitted: Bools
    channel: npt.NDArray[np.intp]


class StandardBsdf:
    """The material at R points, with what depends on the viewer alone computed once.

    Parameters
    ----------
    p : Parameters
        Each field is a number, a colour, or an array (R, 1) or (R, 3). `multiple_scattering` may be one, too.
    surface : Surface
        Normals on the viewer's side. `tangent` is read where `anisotropy` is not 0.
    """

    def __init__(self, p: Parameters, surface: Surface) -> None:
        self.p, self.surface = p, surface
        self.count = len(surface.v)
        self.base = GgxLobe(self._base_frame(), surface.v, *self._alphas())
        self.dielectric, self.metal = fresnels(p)
        self.color = self._rows(p.color, 3)
        self.metallic, self.transmission = self._rows(p.metallic), self._rows(p.transmission)

        self.sheen_color = self._rows(p.sheen_color, 3)
        self.has_sheen = max3(self.sheen_color)[:, 0] > 0
        self.sheen_seen = self._sheen_albedo(facing(surface.n, surface.v))

        self.coat_share = self._rows(p.clearcoat) * schlick(
            0.04, 1.0, facing(surface.clearcoat_n, surface.v)
        )

    # --- the parts ----------------------------------------------------------------------------------------------------

    def _rows(self, values: Any, width: int = 1) -> Array:
        return np.broadcast_to(np.asarray(values, float), (self.count, width))

    def _alphas(self) -> tuple[Array, Array]:
        alpha = self._rows(self.p.roughness) ** 2
        return mix(alpha, 1, self._rows(self.p.anisotropy) ** 2), alpha

    def _base_frame(self) -> tuple[Array, Array, Array]:
        s = self.surface
        t, b = frame_around(s.n)
        turned = self._rows(self.p.anisotropy)[:, 0] > 0
        if turned.any():
            of_turned = Surface(
                s.position,
                s.v[turned],
                s.geometric_n[turned],
                s.n[turned],
                tangent=s.tangent[turned],
            )
            direction = self._rows(self.p.anisotropy_direction, 2)[turned]
            t[turned], b[turned], _ = anisotropy_frame(of_turned, direction)
        return t, b, s.n

    @cached_property
    def coat(self) -> GgxLobe:
        n = self.surface.clearcoat_n
        alpha = self._rows(self.p.clearcoat_roughness) ** 2
        return GgxLobe((*frame_around(n), n), self.surface.v, alpha, alpha)

    def _sheen_albedo(self, cosine: Array) -> Array:
        """E (R, 1), 0 where there is no sheen."""
        result = np.zeros((self.count, 1))
        rows = self.has_sheen
        if rows.any():
            roughness = self._rows(self.p.sheen_roughness)[rows]
            result[rows] = sheen_albedo(cosine[rows], roughness)
        return result

    @cached_property
    def mean(self) -> tuple[Array, Array, Array, Array]:
        """Fss and Fms (R, 3) of the dielectric, then of the metal; Fms is 0 without multiple scattering."""
        n_v = facing(self.surface.n, self.surface.v)
        terms = brdf_terms(n_v[:, 0], self._rows(self.p.roughness)[:, 0])
        a, b = terms[:, :1], terms[:, 1:]
        result: list[Array] = []
        for fresnel in (self.dielectric, self.metal):
            single, several = scattered(fresnel.for_environment(n_v), a, b)
            result += [single, several * np.asarray(self.p.multiple_scattering, float)]
        return tuple(np.broadcast_to(r, (self.count, 3)) for r in result)  # type: ignore[return-value]

    def _below_specular(self, v_h: Array) -> Array:
        """The share (R, 1) of light that enters the dielectric at facets that see the viewer at a cosine."""
        return np.maximum(1 - max3(self._at(self.dielectric, v_h)) - max3(self.mean[1]), 0)

    @cached_property
    def entering(self) -> Array:
        """The share (R, 1) of light that enters the dielectric, as the renderer's environment has it."""
        fss, fms = self.mean[:2]
        return np.maximum(1 - max3(fss + fms), 0)

    def _at(self, fresnel: Fresnel, cosine: Array) -> Array:
        return np.broadcast_to(fresnel.at(cosine), (self.count, 3))

    def _covered(self, sheen_albedo: Array) -> Array:
        """What sheen and coat leave of the layers below them (R, 1)."""
        return (1 - max3(self.sheen_color) * sheen_albedo) * (1 - self.coat_share)

    @cached_property
    def shares(self) -> Array:
        """(R, 5): the probabilities of the lobes, about in proportion to what they reflect.

        A lobe that scatters light has one above 0: the means are taken at n.v, so they have lower bounds.
        """
        fss, fms, metal_fss, metal_fms = self.mean
        share = self._covered(self.sheen_seen)
        entering = (1 - self.metallic) * np.maximum(1 - max3(fss) - max3(fms), 0.05)
        entering = entering * _mean(self.color)
        specular = np.maximum(_mean(mix(fss, metal_fss, self.metallic)), 0.02)
        several = _mean(mix(fms, metal_fms, self.metallic))
        sheen = _mean(self.sheen_color) * self.sheen_seen
        estimates = np.concatenate(
            [
                share * specular * self.base.faced,
                self.coat_share * self.coat.faced,
                share * (entering * (1 - self.transmission) + several),
                (1 - self.coat_share) * sheen,
                share * entering * self.transmission,
            ],
            -1,
        )
        total = dot(estimates, np.ones(5))
        return np.where(total > 0, estimates / np.where(total > 0, total, 1), (1.0, 0, 0, 0, 0))

    # --- reflection ---------------------------------------------------------------------------------------------------

    def evaluate(self, l: Array) -> Array:  # noqa: E741
        """As the function `evaluate`."""
        s = self.surface
        n_l = np.maximum(dot(s.n, l), 0)
        v_h = dot(s.v, half_way(s.v, l))
        layer = self.base.value(self.base.local(l))
        diffuse = self.color / np.pi * (1 - self.transmission) * self.entering
        several, metal_several = self.mean[1], self.mean[3]
        material = mix(
            diffuse + self._at(self.dielectric, v_h) * layer + several / np.pi,
            self._at(self.metal, v_h) * layer + metal_several / np.pi,
            self.metallic,
        )
        albedo = np.maximum(self.sheen_seen, self._sheen_albedo(n_l))
        result = material * self._covered(albedo)
        rows = self.has_sheen
        if rows.any():
            roughness = self._rows(self.p.sheen_roughness)[rows]
            sheen = sheen_brdf(s.n[rows], s.v[rows], l[rows], roughness)
            result[rows] += self.sheen_color[rows] * sheen * (1 - self.coat_share[rows])
        result = result * n_l
        if self.coat_share.any():
            local = self.coat.local(l)
            result = result + self.coat_share * self.coat.value(local) * np.maximum(local[:, 2:], 0)
        return np.where(dot(s.geometric_n, l) > 0, result, 0.0)

    def pdf(self, l: Array) -> Array:  # noqa: E741
        """As the function `pdf`."""
        q = self.shares
        n_l = dot(self.surface.n, l)
        result = q[:, SPECULAR, None] * self.base.density(self.base.local(l))
        if self.coat_share.any():
            result = result + q[:, COAT, None] * self.coat.density(self.coat.local(l))
        result = result + q[:, COSINE, None] * np.maximum(n_l, 0) / np.pi
        return result + q[:, UNIFORM, None] * (n_l > 0) / (2 * np.pi)

    def sample(self, u: Array, channel: npt.NDArray[np.intp] | None = None) -> Sampled:
        """As the function `sample`."""
        s = self.surface
        ends = np.cumsum(self.shares, -1)
        lobe = np.minimum((u[:, 2:] >= ends).sum(-1), THROUGH)
        # Rounding must not lead to a lobe that has no share.
        lobe = np.where(self._share_of(lobe) > 0, lobe, np.argmax(self.shares, -1))
        place = (u[:, 2] - ends[np.arange(self.count), lobe]) / self._share_of(lobe) + 1

        l = np.array(s.n)  # noqa: E741
        delta = np.zeros(self.count, bool)
        for which, lobe_of in ((SPECULAR, self.base), (COAT, self.coat)):
            rows = lobe == which
            if rows.any():
                h = lobe_of.facet(u)
                l[rows] = lobe_of.world(2 * dot(lobe_of.v, h) * h - lobe_of.v)[rows]
                delta[rows] = lobe_of.smooth[rows, 0]
        rows = (lobe == COSINE) | (lobe == UNIFORM)
        z = np.where((lobe == COSINE)[:, None], np.sqrt(1 - u[:, :1]), 1 - u[:, :1])
        turn, flat = 2 * np.pi * u[:, 1:2], np.sqrt(np.maximum(1 - z**2, 0))
        up = np.concatenate([flat * np.cos(turn), flat * np.sin(turn), z], -1)
        l[rows] = self.base.world(up)[rows]

        density = np.where(delta[:, None], 0.0, self.pdf(l))
        weight = np.where(density > 0, self.evaluate(l) / np.where(density > 0, density, 1), 0.0)
        if delta.any():
            weight = np.where(delta[:, None], self._mirrored(l, lobe), weight)
        result = Sampled(
            l, weight, density, delta, lobe == THROUGH, np.full(self.count, -1, np.intp)
        )
        if channel is not None:
            result.channel = np.array(channel)
        if result.transmitted.any():
            self._pass_through(result, u, place)
        return result

    def _share_of(self, lobe: npt.NDArray[np.intp]) -> Array:
        return self.shares[np.arange(self.count), lobe]

    def _mirrored(self, l: Array, lobe: npt.NDArray[np.intp]) -> Array:  # noqa: E741
        """The weights (R, 3) of the two mirrors."""
        v_n = dot(self.surface.v, self.surface.n)
        f = mix(self._at(self.dielectric, v_n), self._at(self.metal, v_n), self.metallic)
        value = np.where(
            (lobe == COAT)[:, None], self.coat_share, f * self._covered(self.sheen_seen)
        )
        lit = dot(self.surface.geometric_n, l) > 0
        return np.where(lit, value / self._share_of(lobe)[:, None], 0.0)

    # --- transmission -------------------------------------------------------------------------------------------------

    def _iors(self, channel: npt.NDArray[np.intp]) -> Array:
        """KHR_materials_dispersion: the index (R, 1) of a channel; the middle one where none was chosen."""
        ior = self._rows(self.p.ior)
        spread = (ior - 1) * 0.025 * self._rows(self.p.dispersion)
        return np.maximum(ior + np.where(channel < 0, 0, channel - 1)[:, None] * spread, 1)

    def _pass_through(self, result: Sampled, u: Array, place: Array) -> None:
        """Fill in the rows that are transmitted. place (R,): where in the lobe's share u[:, 2] was."""
        lobe, rows = self.base, result.transmitted
        thin = self._rows(self.p.thickness) == 0
        split = rows & ~thin[:, 0] & (self._rows(self.p.dispersion)[:, 0] > 0)
        fresh = split & (result.channel < 0)
        picked = np.minimum((np.clip(place, 0, 1) * 3).astype(np.intp), 2)
        result.channel = np.where(fresh, picked, result.channel)

        h = lobe.facet(u)
        v_h = dot(lobe.v, h)
        mirrored = 2 * v_h * h - lobe.v
        bent = refract(-lobe.v, h, 1 / self._iors(np.where(split, result.channel, -1)))
        l = np.where(thin, mirrored * (1, 1, -1), bent)  # noqa: E741
        weight = self.color * self.transmission * (1 - self.metallic) * self._below_specular(v_h)
        weight = weight * self._covered(self.sheen_seen) * lobe.masking(l)
        weight = weight / np.maximum(self.shares[:, THROUGH, None], 1e-300)
        weight = weight * np.where(
            fresh[:, None], 3.0 * (np.arange(3) == result.channel[:, None]), 1.0
        )
        world = lobe.world(l)
        below = (l[:, 2:] < 0) & (dot(self.surface.geometric_n, world) < 0) & lobe.faced
        result.l[rows] = world[rows]
        result.weight[rows] = np.where(below, weight, 0.0)[rows]
        result.pdf[rows] = 0.0
        result.delta[rows] = lobe.smooth[rows, 0]

    def sample_exit(self, u: Array, channel: npt.NDArray[np.intp] | None = None) -> Sampled:
        """As the function `sample_exit`."""
        lobe = self.base
        channel = np.full(self.count, -1, np.intp) if channel is None else np.array(channel)
        h = lobe.facet(u)
        v_h = np.maximum(dot(lobe.v, h), 0)
        ior = self._iors(channel)
        bent = refract(-lobe.v, h, ior)
        total = dot(bent, bent) == 0
        # Schlick's curve is that of the larger of the two angles, which is the one outside.
        f = np.where(total, 1.0, self._at(self.dielectric, np.where(total, 1.0, -dot(bent, h))))
        back = max3(f)
        reflected = u[:, 2:] < back
        l = np.where(reflected, 2 * v_h * h - lobe.v, bent)  # noqa: E741
        weight = np.where(reflected, f / np.where(reflected, back, 1), 1.0) * lobe.masking(l)
        world = lobe.world(l)
        side = np.where(reflected, 1, -1)
        kept = (
            (side * l[:, 2:] > 0) & (side * dot(self.surface.geometric_n, world) > 0) & lobe.faced
        )
        return Sampled(
            world,
            np.where(kept, weight, 0.0),
            np.zeros((self.count, 1)),
            np.array(lobe.smooth[:, 0]),
            ~reflected[:, 0],
            channel,
        )
