"""What other programs show in place of materials that glTF does not have: a StandardMaterial that looks similar."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...._core import (
    BasicMaterial,
    GlassMaterial,
    Image,
    Material,
    MirrorMaterial,
    PhongMaterial,
    StandardMaterial,
)


def similar(material: Material) -> StandardMaterial:
    """Return a StandardMaterial that looks similar to a material of any kind."""
    if isinstance(material, StandardMaterial):
        return material
    made = _of_kind(material)
    made.opacity, made.double_sided = material.opacity, material.double_sided
    return made


def _of_kind(material: Material) -> StandardMaterial:
    if isinstance(material, MirrorMaterial):
        tint = np.asarray(material.tint) * (*[material.env_weight] * 3, 1)
        own = np.asarray(material.color)[:3] * material.color_weight
        alpha = float(material.tint[3] * material.color[3])
        return StandardMaterial(color=_color(tint[:3] + own, alpha), metallic=1, roughness=0)
    if isinstance(material, GlassMaterial):
        return StandardMaterial(
            color=_color(material.tint[:3], material.tint[3]),
            metallic=0,
            roughness=material.roughness,
            ior=max(material.ior, 1 / material.ior),
            transmission=1,
            # A body is a volume, whose thickness path tracers take from the mesh.
            thickness=1 if material.surfaces == 2 else 0,
            dispersion=material.dispersion,
            attenuation_distance=material.attenuation_distance,
            attenuation_color=material.attenuation_color,
        )
    if isinstance(material, BasicMaterial):
        return StandardMaterial(
            color=_color(material.color[:3], material.color[3]),
            map=_image(material.map),
            unlit=True,
        )
    if isinstance(material, PhongMaterial):
        # The width of the highlight: B. Walter et al., "Microfacet Models for Refraction", 2007, section 5.2.
        alpha = math.sqrt(2 / (material.shininess + 2))
        return StandardMaterial(
            color=_color(material.color[:3], material.color[3]),
            map=_image(material.map),
            metallic=0,
            roughness=math.sqrt(alpha),
        )
    return StandardMaterial(color=(0.5, 0.5, 0.5), metallic=0)


def _color(rgb: Any, alpha: float) -> tuple[float, ...]:
    return (*np.clip(rgb, 0, 1).tolist(), float(np.clip(alpha, 0, 1)))


def _image(value: Any) -> Image | None:
    return value if isinstance(value, Image) else None
