"""StandardMaterial as BSDFs of Mitsuba.

``principled`` with metallic=1 is glTF's metal: the same distribution, masking and Schlick's Fresnel. Its dielectric has
the diffuse base of B. Burley, "Physically Based Shading at Disney", 2012, where glTF has Lambert's times 1 - F; the
docstring of `to_mitsuba` says how far they differ. ``diffuse`` is exact where a dielectric reflects nothing.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..._core import StandardMaterial
from .alpha import Alpha
from .looks import BLACK, Painter, constant, seen_through, show_back, turned, with_bump

Json = dict[str, Any]

#: ``principled`` has the alpha of its clear coat between these (gloss 1 and 0).
_COAT_ALPHA = (0.001, 0.1)
#: The greatest ``eta`` that is written where ior=0 stands for infinity.
_LARGE_IOR = 1000.0


def standard(painter: Painter, material: StandardMaterial) -> None:
    """Make the look of a StandardMaterial that is lit."""
    look = painter.look
    image = painter.image_of(material.map)
    alpha = Alpha(painter, image, material.vertex_colors)
    _tell(painter, material)
    emissive = np.asarray(material.emissive, float)[:3] * material.emissive_strength * alpha.factor
    if emissive.any():
        look.radiance = painter.emitted(
            emissive, painter.image_of(material.emissive_map),
            decoded=True, vertices=False, blended=False,
        )  # fmt: skip
    passes = material.transmission > 0 and material.metallic < 1
    bsdf = _glass(painter, material) if passes else None
    if bsdf is None:
        bsdf = _opaque(painter, material, material.transmission if passes else 0.0)
    bump = painter.image_of(material.normal_map)
    if bump is not None:
        bsdf = with_bump(bsdf, painter, bump, material.normal_scale)
    if not passes and not (look.radiance and alpha.is_solid):
        bsdf = turned(painter, bsdf)
    look.bsdf = seen_through(bsdf, alpha.opacity)
    if look.radiance is not None:
        show_back(painter, alpha.is_solid and not passes)


def _opaque(painter: Painter, material: StandardMaterial, transmission: float) -> Json:
    """Return ``principled``, or ``diffuse`` where nothing else is left of it."""
    color = painter.color(
        np.asarray(material.color, float)[:3], painter.image_of(material.map),
        decoded=True, vertices=material.vertex_colors,
    )  # fmt: skip
    f0 = head_on(material)
    plain = (
        not material.metallic and not transmission and not material.clearcoat
        and not np.any(material.sheen_color)
    )  # fmt: skip
    if plain and f0 == 0:
        if np.array_equal(color.get("value", [1]), [0, 0, 0]):
            return BLACK
        return {"type": "diffuse", "reflectance": color}
    maps = painter.image_of(material.metallic_roughness_map)
    bsdf: Json = {
        "type": "principled",
        "base_color": color,
        "metallic": painter.numbers(material.metallic, maps, 2),
        "roughness": painter.numbers(material.roughness, maps, 1),
        "eta": _index(f0),
    }
    if transmission:
        bsdf["spec_trans"] = painter.numbers(
            transmission, painter.image_of(material.transmission_map), 0
        )
    if material.anisotropy:
        bsdf |= _stretched(painter, material)
    if material.clearcoat:
        low, high = _COAT_ALPHA
        gloss = (high - material.clearcoat_roughness**2) / (high - low)
        bsdf["clearcoat"] = painter.numbers(
            material.clearcoat, painter.image_of(material.clearcoat_map), 0
        )
        bsdf["clearcoat_gloss"] = float(np.clip(gloss, 0, 1))
        painter.tell(
            "Mitsuba's clear coat has a quarter of the strength, and its roughness ends at 0.32"
        )
    sheen = np.asarray(material.sheen_color, float)[:3]
    if sheen.any():
        bsdf["sheen"] = float(sheen.max())
        bsdf["sheen_tint"] = 0.0 if np.ptp(sheen) == 0 else 1.0
        painter.tell("sheen is Disney's, in white or the hue of the base, and without a roughness")
    return bsdf


def _glass(painter: Painter, material: StandardMaterial) -> Json | None:
    """Return the BSDF of a dielectric that lets all light pass that enters; None if ``principled`` must show it."""
    if material.transmission < 1 or material.metallic > 0 or material.transmission_map is not None:
        if material.thickness == 0:
            painter.tell("a thin wall that lets a part of the light pass bends it as a body does")
        return None
    image = painter.image_of(material.map)
    color = painter.color(
        np.asarray(material.color, float)[:3], image, decoded=True, vertices=material.vertex_colors
    )
    index = _index(head_on(material))
    bsdf: Json = {"int_ior": index, "ext_ior": 1.0, "specular_transmittance": color}
    if material.thickness == 0:
        if material.roughness > 0:
            painter.tell("a thin wall that lets light pass is smooth in Mitsuba")
        return {"type": "thindielectric", **bsdf}
    distance = material.attenuation_distance
    if not math.isinf(distance):
        tint = np.clip(np.asarray(material.attenuation_color, float)[:3], 1e-6, 1)
        painter.look.inside = {
            "type": "homogeneous",
            "albedo": 0.0,
            "sigma_t": constant(-np.log(tint) / distance),
        }
    if material.roughness > 0:
        rough = float(material.roughness) ** 2
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": rough, **bsdf}
    return {"type": "dielectric", **bsdf}


def head_on(material: StandardMaterial) -> float:
    """Return the reflectance of the dielectric along the normal (KHR_materials_ior, KHR_materials_specular)."""
    ior = material.ior if material.ior > 0 else math.inf
    f0 = 1.0 if math.isinf(ior) else ((ior - 1) / (ior + 1)) ** 2
    color = np.asarray(material.specular_color, float)[:3]
    return min(f0 * float(color.mean()), 1.0) * float(material.specular_weight)


def _index(f0: float) -> float:
    """Return the index of refraction with which a dielectric reflects f0; ``principled`` wants one above 1."""
    root = math.sqrt(min(f0, 0.999))
    return float(np.clip((1 + root) / (1 - root), 1.001, _LARGE_IOR))


def _stretched(painter: Painter, material: StandardMaterial) -> Json:
    """Return roughness and ``anisotropic`` with the two alphas of KHR_materials_anisotropy.

    There the alphas are mix(alpha, 1, anisotropy^2) along the tangent and alpha across it; ``principled`` has
    roughness^2 / aspect and roughness^2 * aspect with aspect = sqrt(1 - 0.9 anisotropic).
    """
    if painter.look.uvs is None:  # Mitsuba's tangents follow from the uvs
        painter.look.uvs = painter.look.surface.uvs
    across = max(float(material.roughness) ** 2, 1e-3)
    along = across + (1 - across) * float(material.anisotropy) ** 2
    if material.metallic_roughness_map is not None or material.anisotropy_map is not None:
        painter.tell("anisotropy and roughness are even: their maps are left out where both count")
    if material.anisotropy_rotation % 180:
        painter.tell("highlights are stretched along u: anisotropy_rotation is left out")
    if across / along < 0.1:
        painter.tell("Mitsuba stretches highlights at most ten times")
    return {
        "roughness": (along * across) ** 0.25,
        "anisotropic": float(min((1 - across / along) / 0.9, 1)),
    }


def _tell(painter: Painter, material: StandardMaterial) -> None:
    """Note what ``principled`` does not have."""
    if material.iridescence:
        painter.tell("iridescence is left out")
    if material.dispersion and material.transmission:
        painter.tell("dispersion is left out")
    if material.specular_map is not None or material.specular_color_map is not None:
        painter.tell("specular_map and specular_color_map are left out")
    if np.ptp(np.asarray(material.specular_color)[:3]):
        painter.tell("the reflection of a dielectric is white: specular_color counts by its mean")
    if material.clearcoat and (
        material.clearcoat_normal_map is not None or material.clearcoat_roughness_map is not None
    ):
        painter.tell("maps of the clear coat's normals and roughness are left out")
    if np.any(material.sheen_color) and (
        material.sheen_color_map is not None or material.sheen_roughness_map is not None
    ):
        painter.tell("maps of sheen are left out")
    if material.thickness_map is not None:
        painter.tell("thickness_map is left out: rays find how thick a body is")
