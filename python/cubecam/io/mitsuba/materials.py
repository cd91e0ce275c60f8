"""The kinds of materials as BSDFs and emitters of Mitsuba."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import (
    BasicMaterial,
    GlassMaterial,
    Material,
    MirrorMaterial,
    PhongMaterial,
    StandardMaterial,
)
from ..left_out import LeftOut
from .alpha import Alpha
from .files import Files
from .geometry import Surface
from .looks import BLACK, Look, Painter, constant, seen_through, show_back, turned
from .standard import standard

Array = npt.NDArray[Any]
Json = dict[str, Any]


@dataclass
class Materials:
    """Makes looks. `phong` is the factor of what a PhongMaterial reflects: 1 if lights are pi times as strong."""

    files: Files
    left_out: LeftOut
    phong: float

    def look(self, surface: Surface, material: Material, name: str) -> Look:
        """Return how a mesh looks with a material; the name is that of the node."""
        painter = Painter(surface, material, self.files, self.left_out, name)
        _tell_common(painter)
        if isinstance(material, BasicMaterial):
            self._basic(painter, material)
        elif isinstance(material, PhongMaterial):
            self._phong(painter, material)
        elif isinstance(material, MirrorMaterial):
            _mirror(painter, material)
        elif isinstance(material, GlassMaterial):
            _glass(painter, material)
        elif isinstance(material, StandardMaterial):
            if material.unlit:
                _unlit(painter, material, decoded=True)
            else:
                standard(painter, material)
        else:
            painter.tell(
                f"{type(material).__name__} has no counterpart in Mitsuba: matt grey is shown"
            )
            painter.look.bsdf = turned(
                painter, {"type": "diffuse", "reflectance": constant(np.full(3, 0.5))}
            )
        return painter.look

    def _basic(self, painter: Painter, material: BasicMaterial) -> None:
        if material.cubemap is not None:
            painter.tell("the cubemap of a BasicMaterial is left out")
        _unlit(painter, material, decoded=False)

    def _phong(self, painter: Painter, material: PhongMaterial) -> None:
        if material.ka > 0:
            painter.tell("the share ka of a PhongMaterial, light without a lamp, is left out")
        if material.ks > 0:
            painter.tell("the highlight of a PhongMaterial (ks) is left out")
        image = painter.image_of(material.map)
        color = np.asarray(material.color, float)[:3] * material.kd * self.phong
        alpha = Alpha(painter, image, material.vertex_colors)
        reflectance = painter.color(color, image, decoded=False, vertices=material.vertex_colors)
        bsdf = turned(painter, {"type": "diffuse", "reflectance": reflectance})
        painter.look.bsdf = seen_through(bsdf, alpha.opacity)


def _unlit(painter: Painter, material: BasicMaterial | StandardMaterial, *, decoded: bool) -> None:
    """What shows its colour and reflects nothing: a lamp with this radiance."""
    image = painter.image_of(material.map)
    alpha = Alpha(painter, image, material.vertex_colors)
    color = np.asarray(material.color, float)[:3] * alpha.factor
    painter.look.radiance = painter.emitted(
        color, image, decoded=decoded, vertices=material.vertex_colors, blended=alpha.mapped
    )
    painter.look.bsdf = seen_through(BLACK, alpha.opacity)
    if painter.look.radiance is not None:
        show_back(painter, alpha.is_solid)


def _mirror(painter: Painter, material: MirrorMaterial) -> None:
    alpha = Alpha(painter, None, False)
    tint = np.asarray(material.tint, float)[:3] * material.env_weight
    own = np.asarray(material.color, float)[:3] * material.color_weight * alpha.factor
    look = painter.look
    if own.any():
        look.radiance = {"type": "rgb", "value": own.tolist()}
    bsdf: Json = {"type": "conductor", "specular_reflectance": constant(tint)}
    if material.f0 is None or material.f0 == 1:
        bsdf["material"] = "none"
    else:
        bsdf["eta"], bsdf["k"] = like_schlick(material.f0)
        painter.tell(
            "the reflectance of a mirror with f0 follows Fresnel's equations for a metal of this f0"
        )
    look.bsdf = seen_through(bsdf if own.any() else turned(painter, bsdf), alpha.opacity)
    if own.any():
        show_back(painter, alpha.is_solid)


def _glass(painter: Painter, material: GlassMaterial) -> None:
    alpha = Alpha(painter, None, False)
    tint = np.asarray(material.tint, float)[:3]
    if not material.fresnel:
        painter.tell("all glass of Mitsuba reflects: fresnel=False is left out")
    if material.dispersion > 0:
        painter.tell("the dispersion of a GlassMaterial is left out")
    if np.isfinite(material.attenuation_distance) and material.surfaces == 2:
        painter.tell("what the body of a GlassMaterial absorbs is left out")
    if material.roughness > 0 and material.ior != 1:
        bsdf: Json = {
            "type": "roughdielectric",
            "distribution": "ggx",
            "alpha": float(material.roughness) ** 2,
        }
    else:
        bsdf = {"type": "dielectric"}
    bsdf |= {
        "int_ior": float(material.ior),
        "ext_ior": 1.0,
        "specular_transmittance": constant(tint),
    }
    painter.look.bsdf = seen_through(bsdf, alpha.opacity)


def like_schlick(f0: float) -> tuple[float, float]:
    """Return eta and k of a metal that reflects f0 head-on, and elsewhere what Schlick's formula says.

    Fresnel's equations: M. Born, E. Wolf, "Principles of Optics", section 14.2. One parameter is left after f0; the
    smallest greatest error is looked for.
    """
    cosine = np.linspace(0.02, 1, 50)
    wanted = f0 + (1 - f0) * (1 - cosine) ** 5
    least = (1 - math.sqrt(f0)) / (1 + math.sqrt(f0))
    eta = np.linspace(least, 1 / least, 400)[:, None]
    k = np.sqrt(np.maximum((f0 * (eta + 1) ** 2 - (eta - 1) ** 2) / (1 - f0), 0))
    error = np.abs(_reflectance(eta, k, cosine) - wanted).max(axis=1)
    best = int(np.argmin(error))
    return float(eta[best, 0]), float(k[best, 0])


def _reflectance(eta: Array, k: Array, cosine: Array) -> Array:
    sine = 1 - cosine**2
    inside = np.sqrt((eta + 1j * k) ** 2 - sine)
    index = (eta + 1j * k) ** 2
    across = (cosine - inside) / (cosine + inside)
    along = (index * cosine - inside) / (index * cosine + inside)
    return np.asarray((np.abs(across) ** 2 + np.abs(along) ** 2) / 2)


def _tell_common(painter: Painter) -> None:
    """Note options of every material that Mitsuba does not have."""
    material = painter.material
    if not material.depth_test or material.depth_write is not None or material.stencil is not None:
        painter.tell("depth_test, depth_write and stencil are left out: rays find what is nearest")
    if not all(material.color_write):
        painter.tell("color_write is left out")
