"""The radiance that a surface sends to the viewer: glTF 2.0 appendix B.2 with the layers of the extensions.

    clear coat over (emission + sheen + mix(dielectric, metal, metallic))

Each of dielectric and metal is a `Fresnel`, F0 and F90; the rest of both is shared.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..lights import Ambient, Directional, Light, Point, Spot, falloff, way_to
from ..vectors import Array, Numbers, dot, normalised, reflect, refract
from .iridescence import iridescent_fresnel, schlick_to_f0
from .material import Environment, Parameters, Surface, anisotropy_frame
from .microfacets import (
    SMALLEST_ALPHA,
    max3,
    mix,
    schlick,
    sheen_brdf,
    specular_brdf,
    specular_brdf_anisotropic,
)
from .samples import frame_around, hammersley, sampled_lobes
from .tables import brdf_terms, sheen_albedo


@dataclass
class Fresnel:
    """The reflectance of one of the two materials at normal and at grazing incidence, and its thin film."""

    f0: Any
    f90: Any
    film: Any = None  # (share, ior, thickness)

    def at(self, cosine: Any) -> Array:
        """Of a microfacet."""
        f = schlick(self.f0, self.f90, cosine)
        if self.film is None:
            return f
        share, ior, thickness = self.film
        result: Array = mix(f, iridescent_fresnel(cosine, ior, thickness, self.f0), share)
        return result

    def for_environment(self, n_v: Any) -> Fresnel:
        """The same without a film: its colour at n.v becomes a part of F0."""
        if self.film is None:
            return self
        share, ior, thickness = self.film
        film = schlick_to_f0(iridescent_fresnel(n_v, ior, thickness, self.f0), n_v)
        return Fresnel(mix(self.f0, film, share), self.f90)


def fresnels(p: Parameters) -> tuple[Fresnel, Fresnel]:
    """(dielectric, metal): KHR_materials_ior, KHR_materials_specular, KHR_materials_iridescence."""
    from_ior = ((np.asarray(p.ior, float) - 1) / (np.asarray(p.ior, float) + 1)) ** 2
    f0 = np.minimum(from_ior * np.asarray(p.specular_color, float), 1) * p.specular_weight
    film = None
    if np.any(p.iridescence):
        film = (p.iridescence, p.iridescence_ior, p.iridescence_thickness)
    return Fresnel(f0, p.specular_weight, film), Fresnel(np.asarray(p.color, float), 1.0, film)


def facing(n: Array, v: Array) -> Array:
    return np.clip(dot(n, v), 1e-4, 1)


def dominant_direction(n: Array, r: Array, roughness: Any) -> Array:
    """Where most of a rough reflection comes from: Lagarde and de Rousiers 2014, section 4.9.3; not normalised."""
    a = np.asarray(roughness, float) ** 2
    result: Array = mix(n, r, (1 - a) * (np.sqrt(1 - a) + a))
    return result


def alphas(p: Parameters) -> tuple[Any, Any]:
    """(alpha_t, alpha_b): along the direction of anisotropy, and across it."""
    alpha = np.asarray(p.roughness, float) ** 2
    return mix(alpha, 1, np.asarray(p.anisotropy, float) ** 2), alpha


def lobe_frame(p: Parameters, surface: Surface) -> tuple[Array, Array, Array]:
    if np.any(p.anisotropy):
        return anisotropy_frame(surface, p.anisotropy_direction)
    return (*frame_around(surface.n), surface.n)


# --- lights -----------------------------------------------------------------------------------------------------------


def arriving(light: Point | Directional | Spot, position: Array) -> tuple[Array, Array]:
    """(l, the irradiance of a surface that faces the light): lux of a directional light, else candela."""
    l, distance = way_to(light, position)  # noqa: E741
    irradiance = np.asarray(light.color, float) * light.intensity
    if isinstance(light, (Point, Spot)):
        irradiance = irradiance * falloff(light, distance)
    if isinstance(light, Spot):
        irradiance = irradiance * light.share(l)
    return l, np.broadcast_to(irradiance, position.shape)


def lit_base(p: Parameters, surface: Surface, l: Array) -> Array:  # noqa: E741
    """The BRDF of dielectric and metal for one light, sheen included, times n.l."""
    n, v = surface.n, surface.v
    n_l = np.maximum(dot(n, l), 0)
    h = normalised(v + l)
    v_h = dot(v, h)
    alpha_t, alpha_b = (np.maximum(alpha, SMALLEST_ALPHA) for alpha in alphas(p))
    if np.any(p.anisotropy):
        layer = specular_brdf_anisotropic(lobe_frame(p, surface), v, l, alpha_t, alpha_b)
    else:
        layer = specular_brdf(n, v, l, alpha_b)

    dielectric, metal = fresnels(p)
    f = dielectric.at(v_h)
    base = np.asarray(p.color, float) / np.pi * (1 - p.transmission)
    material = mix((1 - max3(f)) * base + f * layer, metal.at(v_h) * layer, p.metallic)

    sheen_color = np.asarray(p.sheen_color, float)
    if np.any(sheen_color):
        albedo = np.maximum(
            sheen_albedo(facing(n, v), p.sheen_roughness), sheen_albedo(n_l, p.sheen_roughness)
        )
        material = material * (1 - max3(sheen_color) * albedo)
        material = material + sheen_color * sheen_brdf(n, v, l, p.sheen_roughness)
    result: Array = material * n_l
    return result


def lit_coat(p: Parameters, surface: Surface, l: Array) -> Array:  # noqa: E741
    """The clear coat's lobe for one light, without its Fresnel term."""
    n = surface.clearcoat_n
    alpha = np.maximum(np.asarray(p.clearcoat_roughness, float) ** 2, SMALLEST_ALPHA)
    return specular_brdf(n, surface.v, l, alpha) * np.maximum(dot(n, l), 0)


# --- the environment --------------------------------------------------------------------------------------------------


def scattered(fresnel: Fresnel, a: Numbers, b: Numbers) -> tuple[Array, Array]:
    """(Fss, Fms): Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting"."""
    single = fresnel.f0 * a + fresnel.f90 * b
    missing = 1 - (a + b)
    average = fresnel.f0 + (fresnel.f90 - fresnel.f0) / 21
    return single, single * average / (1 - average * missing) * missing


def reflection_direction(p: Parameters, surface: Surface) -> Array:
    """Where the one lookup of "levels" goes; KHR_materials_anisotropy bends the normal it reflects about."""
    n, v = surface.n, surface.v
    if np.any(p.anisotropy):
        _, b, _ = lobe_frame(p, surface)
        bent = np.cross(np.cross(b, v), b)
        bent = bent / np.maximum(np.linalg.norm(bent, axis=-1, keepdims=True), 1e-12)
        kept = (1 - np.asarray(p.anisotropy) * (1 - np.asarray(p.roughness))) ** 4
        n = normalised(mix(bent, n, kept))
    return dominant_direction(n, reflect(-v, n), p.roughness)


def reflected(
    p: Parameters,
    surface: Surface,
    environment: Environment,
    of_environment: Sequence[Fresnel],
    a: Array,
    b: Array,
) -> list[Array]:
    """The single-scattered specular radiance of each Fresnel in `of_environment`."""
    if p.specular == "levels":
        radiance = environment.radiance(reflection_direction(p, surface), p.roughness)
        return [radiance * (f.f0 * a + f.f90 * b) for f in of_environment]
    alpha_t, alpha_b = (np.maximum(alpha, 1e-6) for alpha in alphas(p))
    lobes = sampled_lobes(
        lobe_frame(p, surface),
        surface.v,
        alpha_t,
        alpha_b,
        hammersley(p.specular_samples),
        environment.size,
    )
    totals: list[Any] = [0.0 for _ in of_environment]
    for l, v_h, weight, lod in lobes:  # noqa: E741
        radiance = environment.mip(l, lod) * weight
        totals = [
            total + radiance * schlick(f.f0, f.f90, v_h)
            for total, f in zip(totals, of_environment, strict=True)
        ]
    return [total / p.specular_samples for total in totals]


def surrounded_base(p: Parameters, surface: Surface, environment: Environment) -> Array:
    """Dielectric, metal and sheen in the environment."""
    n_v = facing(surface.n, surface.v)
    terms = brdf_terms(n_v[..., 0], np.broadcast_to(p.roughness, n_v.shape)[..., 0])
    a, b = terms[..., :1], terms[..., 1:]
    around = environment.irradiance(surface.n)
    dielectric, metal = (f.for_environment(n_v) for f in fresnels(p))
    specular = reflected(p, surface, environment, (dielectric, metal), a, b)

    results, left = [], None
    for f, single in zip((dielectric, metal), specular, strict=True):
        fss, fms = scattered(f, a, b)
        if not p.multiple_scattering:
            fms = 0.0 * fms
        results.append((single + fms * around) * p.occlusion)
        left = 1 - max3(fss + fms) if left is None else left
    diffuse = mix(around * p.occlusion, transmitted(p, surface, environment), p.transmission)
    material: Array = mix(
        results[0] + left * np.asarray(p.color, float) * diffuse, results[1], p.metallic
    )

    sheen_color = np.asarray(p.sheen_color, float)
    if np.any(sheen_color):
        albedo = sheen_albedo(n_v, p.sheen_roughness)
        material = material * (1 - max3(sheen_color) * albedo)
        material = material + sheen_color * albedo * around * p.occlusion
    return material


def transmitted(p: Parameters, surface: Surface, environment: Environment) -> Array | float:
    """What shows through, without the colour of the surface: KHR_materials_transmission, _volume and _dispersion."""
    if not np.any(p.transmission):
        return 0.0
    n, v = surface.n, surface.v
    ior = np.asarray(p.ior, float)
    blurred = p.roughness * np.clip(2 * ior - 2, 0, 1)
    spread = (ior - 1) * 0.025 * p.dispersion
    channels = []
    for channel, offset in enumerate((-1, 0, 1)):
        straight = (np.asarray(p.thickness) == 0) * np.ones_like(v[..., :1])
        bent = refract(-v, n, 1 / np.maximum(ior + offset * spread, 1))
        direction = np.where(straight > 0, -v, bent)
        way = direction * p.thickness * np.asarray(surface.scale, float)
        length = np.linalg.norm(way, axis=-1, keepdims=True)
        behind = environment.behind(surface.position + way, direction, blurred)[..., channel]
        color = np.broadcast_to(np.asarray(p.attenuation_color, float), v.shape)[..., channel]
        channels.append(behind * color ** (length / p.attenuation_distance)[..., 0])
    return np.stack(channels, -1)


def surrounded_coat(p: Parameters, surface: Surface, environment: Environment) -> Array:
    """The clear coat's lobe in the environment, without its Fresnel term."""
    n, v = surface.clearcoat_n, surface.v
    direction = dominant_direction(n, reflect(-v, n), p.clearcoat_roughness)
    radiance = environment.radiance(direction, p.clearcoat_roughness)
    if not p.multiple_scattering:
        n_v = facing(n, v)[..., 0]
        terms = brdf_terms(n_v, np.broadcast_to(p.clearcoat_roughness, (*n_v.shape, 1))[..., 0])
        radiance = radiance * terms.sum(-1, keepdims=True)
    result: Array = radiance * p.occlusion
    return result


# --- the sum ----------------------------------------------------------------------------------------------------------


def shade(
    p: Parameters,
    surface: Surface,
    lights: Sequence[Light] = (),
    environment: Environment | None = None,
    visibility: Sequence[Array | None] | None = None,
) -> Array:
    """The radiance (..., 3) of pixels.

    visibility: for each light the share (..., 1) that arrives, or None if all of it does.
    """
    color = np.broadcast_to(np.asarray(p.color, float), np.shape(surface.v))
    if p.unlit:
        return color
    ambient = np.zeros(3)
    for light in lights:
        if isinstance(light, Ambient):
            ambient = ambient + np.asarray(light.color, float) * light.intensity
    environment = (environment or Environment()).with_ambient(ambient)

    base: Array = surrounded_base(p, surface, environment)
    base = base + np.asarray(p.emissive, float) * p.emissive_strength
    coated = np.any(p.clearcoat)
    coat = surrounded_coat(p, surface, environment) if coated else 0.0
    for index, light in enumerate(lights):
        if isinstance(light, Ambient):
            continue
        l, irradiance = arriving(light, surface.position)  # noqa: E741
        share = None if visibility is None else visibility[index]
        if share is not None:
            irradiance = irradiance * share
        base = base + lit_base(p, surface, l) * irradiance
        if coated:
            coat = coat + lit_coat(p, surface, l) * irradiance
    if coated:
        cosine = facing(surface.clearcoat_n, surface.v)
        base = mix(base, coat, p.clearcoat * schlick(0.04, 1.0, cosine))
    return base
