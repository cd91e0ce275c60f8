"""`StandardMaterial` at points, with its maps looked up (shaders/materials/standard/maps, point and normals.glsl)."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..scene.records import StandardRecord
from ..scene.snapshot import Snapshot
from ..shading.standard.material import (
    Parameters,
    Surface,
    anisotropy_direction,
    mapped_normal,
)
from .points import Points

__all__ = ["standard_point"]


def standard_point(
    snapshot: Snapshot, material: int, points: Points
) -> tuple[Parameters, Surface, Array]:
    """Return the numbers of a `StandardMaterial` at points, its normals, and the base alpha (P, 1).

    `material` is the place in `Snapshot.materials`. Scalars are (P, 1) and colours (P, 3) where a map or the vertices
    change them, else plain numbers. The base alpha is that of map and vertices, 1 for opaque and masked surfaces; the
    alpha of the surface is this alpha times `NodeRecord.opacity`. Occlusion is 1: rays find what occludes.
    """
    record = snapshot.materials[material]
    assert isinstance(record, StandardRecord)
    texels = {name: each.at(points.uv, points.uv1) for name, each in record.maps.items()}
    base = np.concatenate([np.broadcast_to(record.color[:3], (len(points), 3)), _ones(points)], 1)
    base = base * points.color
    if "map" in texels:
        base = base * texels["map"]
    parameters = _parameters(record, texels, base[:, :3])
    alpha = base[:, 3:] if record.alpha_mode in (None, "blend") else _ones(points)
    return parameters, _surface(snapshot, record, texels, points), alpha


def _ones(points: Points) -> Array:
    return np.ones((len(points), 1))


def _parameters(record: StandardRecord, texels: dict[str, Array], color: Array) -> Parameters:
    numbers = record.numbers

    def scaled(name: str, channel: int, which: str = "") -> float | Array:
        texel = texels.get(which or f"{name}_map")
        return numbers[name] if texel is None else numbers[name] * texel[:, channel : channel + 1]

    def tinted(own: Array, name: str) -> Array:
        texel = texels.get(name)
        return own if texel is None else own * texel[:, :3]

    strength, direction = _anisotropy(record, texels)
    return Parameters(
        color=color,
        metallic=scaled("metallic", 2, "metallic_roughness_map"),
        roughness=np.clip(scaled("roughness", 1, "metallic_roughness_map"), 0, 1),
        emissive=tinted(record.emissive, "emissive_map"),
        emissive_strength=numbers["emissive_strength"],
        ior=numbers["ior"],
        specular_weight=scaled("specular_weight", 3, "specular_map"),
        specular_color=tinted(record.specular_color, "specular_color_map"),
        clearcoat=scaled("clearcoat", 0),
        clearcoat_roughness=scaled("clearcoat_roughness", 1),
        sheen_color=tinted(record.sheen_color, "sheen_color_map"),
        sheen_roughness=scaled("sheen_roughness", 3),
        iridescence=scaled("iridescence", 0),
        iridescence_ior=numbers["iridescence_ior"],
        iridescence_thickness=_film(numbers, texels.get("iridescence_thickness_map")),
        anisotropy=strength,
        anisotropy_direction=direction,
        transmission=scaled("transmission", 0),
        thickness=scaled("thickness", 1),
        attenuation_distance=numbers["attenuation_distance"],
        attenuation_color=record.attenuation_color,
        dispersion=numbers["dispersion"],
        unlit=record.unlit,
        specular=record.specular,
        specular_samples=record.specular_samples,
        multiple_scattering=record.multiple_scattering,
    )


def _film(numbers: dict[str, float], texel: Array | None) -> float | Array:
    """Return the thickness of the film: green goes from the least to the greatest."""
    low, high = numbers["iridescence_thickness_min"], numbers["iridescence_thickness_max"]
    return high if texel is None else low + (high - low) * texel[:, 1:2]


def _anisotropy(
    record: StandardRecord, texels: dict[str, Array]
) -> tuple[float | Array, Array | tuple[float, float]]:
    """Return strength and direction (KHR_materials_anisotropy); a mesh without tangents stretches no highlight."""
    if not record.tangents:
        return 0.0, (1.0, 0.0)
    rotation, strength = record.numbers["anisotropy_rotation"], record.numbers["anisotropy"]
    texel = texels.get("anisotropy_map")
    if texel is None:
        return strength, anisotropy_direction(rotation)[None]
    return strength * texel[:, 2:3], anisotropy_direction(rotation, texel)


def _surface(
    snapshot: Snapshot, record: StandardRecord, texels: dict[str, Array], points: Points
) -> Surface:
    nodes, which = np.unique(points.node, return_inverse=True)
    scales = np.array([snapshot.nodes[node].scale for node in nodes]).reshape(-1, 3)
    mapped = {
        name: mapped_normal(
            points.normal, points.tangent, texels[f"{name}_map"], record.numbers[f"{name}_scale"]
        )
        for name in ("normal", "clearcoat_normal")
        if f"{name}_map" in texels
    }
    return Surface(
        position=points.position,
        v=points.v,
        geometric_n=points.normal,
        n=mapped.get("normal"),
        clearcoat_n=mapped.get("clearcoat_normal"),
        tangent=points.tangent,
        scale=scales[which.reshape(-1)],
    )
