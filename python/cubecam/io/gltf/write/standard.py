"""StandardMaterial as a material of glTF 2.0 (section 3.9) with the KHR_materials extensions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...._core import Image, StandardMaterial, Texture
from ..extras.classes import state_of
from .document import Document, Json
from .pictures import Pictures
from .values import number, numbers, same

#: The maps whose 8-bit numbers are sRGB (section 3.9, and the extensions).
COLOR_MAPS = frozenset({"map", "emissive_map", "sheen_color_map", "specular_color_map"})

#: Each extension: its words, and the properties that they stand for. Those that end in "Texture" are maps.
_EXTENSIONS: dict[str, dict[str, str]] = {
    "KHR_materials_emissive_strength": {"emissiveStrength": "emissive_strength"},
    "KHR_materials_ior": {"ior": "ior"},
    "KHR_materials_specular": {
        "specularFactor": "specular_weight",
        "specularTexture": "specular_map",
        "specularColorFactor": "specular_color",
        "specularColorTexture": "specular_color_map",
    },
    "KHR_materials_clearcoat": {
        "clearcoatFactor": "clearcoat",
        "clearcoatTexture": "clearcoat_map",
        "clearcoatRoughnessFactor": "clearcoat_roughness",
        "clearcoatRoughnessTexture": "clearcoat_roughness_map",
        "clearcoatNormalTexture": "clearcoat_normal_map",
    },
    "KHR_materials_sheen": {
        "sheenColorFactor": "sheen_color",
        "sheenColorTexture": "sheen_color_map",
        "sheenRoughnessFactor": "sheen_roughness",
        "sheenRoughnessTexture": "sheen_roughness_map",
    },
    "KHR_materials_iridescence": {
        "iridescenceFactor": "iridescence",
        "iridescenceTexture": "iridescence_map",
        "iridescenceIor": "iridescence_ior",
        "iridescenceThicknessMinimum": "iridescence_thickness_min",
        "iridescenceThicknessMaximum": "iridescence_thickness_max",
        "iridescenceThicknessTexture": "iridescence_thickness_map",
    },
    "KHR_materials_anisotropy": {
        "anisotropyStrength": "anisotropy",
        "anisotropyRotation": "anisotropy_rotation",
        "anisotropyTexture": "anisotropy_map",
    },
    "KHR_materials_transmission": {
        "transmissionFactor": "transmission",
        "transmissionTexture": "transmission_map",
    },
    "KHR_materials_volume": {
        "thicknessFactor": "thickness",
        "thicknessTexture": "thickness_map",
        "attenuationDistance": "attenuation_distance",
        "attenuationColor": "attenuation_color",
    },
    "KHR_materials_dispersion": {"dispersion": "dispersion"},
}
#: The extensions without which these have no meaning.
_NEEDED = {
    "KHR_materials_volume": "KHR_materials_transmission",
    "KHR_materials_dispersion": "KHR_materials_volume",
}
_TRANSFORM = "KHR_texture_transform"


@dataclass(frozen=True)
class StandardWriter:
    """Writes what glTF can say of a StandardMaterial; `plain` gives one of which it can say all."""

    document: Document
    pictures: Pictures

    def entry(self, material: StandardMaterial) -> Json:
        """Return the entry of a material that `plain` returned."""
        fresh = _fresh()
        made: Json = {}
        core = self._words(
            material,
            {
                "baseColorFactor": "color",
                "baseColorTexture": "map",
                "metallicFactor": "metallic",
                "roughnessFactor": "roughness",
                "metallicRoughnessTexture": "metallic_roughness_map",
            },
        )
        if core:
            made["pbrMetallicRoughness"] = core
        made |= self._words(
            material,
            {
                "normalTexture": "normal_map",
                "occlusionTexture": "occlusion_map",
                "emissiveTexture": "emissive_map",
                "emissiveFactor": "emissive",
            },
        )
        if material.alpha_mode != "opaque":
            made["alphaMode"] = str(material.alpha_mode).upper()
        if material.alpha_mode == "mask" and material.alpha_cutoff != fresh.alpha_cutoff:
            made["alphaCutoff"] = material.alpha_cutoff
        if material.double_sided:
            made["doubleSided"] = True
        contents = {name: self._words(material, words) for name, words in _EXTENSIONS.items()}
        for name, needed in reversed(_NEEDED.items()):
            if contents[name] and not contents[needed]:
                first, attribute = next(iter(_EXTENSIONS[needed].items()))
                contents[needed] = {first: getattr(material, attribute)}
        if material.unlit:
            self.document.extend(made, "KHR_materials_unlit", {})
        for name, content in contents.items():
            if content:
                self.document.extend(made, name, content)
        return made

    def _words(self, material: StandardMaterial, words: dict[str, str]) -> Json:
        """Return the words whose properties are not at their defaults."""
        fresh = _fresh()
        made: Json = {}
        for word, name in words.items():
            value = getattr(material, name)
            if same(value, getattr(fresh, name)):
                continue
            if word.endswith("Texture"):
                made[word] = self._map(material, name, value)
            elif name == "anisotropy_rotation":
                made[word] = math.radians(value)
            else:
                made[word] = numbers(value) if isinstance(value, np.ndarray) else number(value)
        return made

    def _map(self, material: StandardMaterial, name: str, value: Texture | Image) -> Json:
        """Return a textureInfo."""
        place = value if isinstance(value, Texture) else None
        image: Any = value if place is None else place.source
        made: Json = {"index": self.pictures.texture(image, name in COLOR_MAPS)}
        for of, word, strength in (
            ("normal_map", "scale", "normal_scale"),
            ("clearcoat_normal_map", "scale", "clearcoat_normal_scale"),
            ("occlusion_map", "strength", "occlusion_strength"),
        ):
            if name == of and getattr(material, strength) != 1:
                made[word] = getattr(material, strength)
        if place is not None:
            if place.uv_set:
                made["texCoord"] = place.uv_set
            content = transform(place)
            if content:
                self.document.extend(made, _TRANSFORM, content)
        return made


def transform(place: Texture) -> Json:
    """Return the content of KHR_texture_transform, which counts v downwards; empty if nothing is moved.

    The loader makes (x + sin(r) sy, 1 - y - cos(r) sy) of an offset (x, y); this is the inverse.
    """
    if tuple(place.offset) == (0, 0) and place.rotation == 0 and tuple(place.scale) == (1, 1):
        return {}
    angle = math.radians(place.rotation)
    sy = place.scale[1]
    offset = [place.offset[0] - math.sin(angle) * sy, 1 - place.offset[1] - math.cos(angle) * sy]
    made: Json = {"offset": offset, "rotation": angle, "scale": list(place.scale)}
    plain = {"offset": [0, 0], "rotation": 0, "scale": [1, 1]}
    return {word: value for word, value in made.items() if value != plain[word]}


def plain(
    material: StandardMaterial, translucent: Callable[[StandardMaterial], bool]
) -> StandardMaterial:
    """Return the StandardMaterial nearest to another one of which glTF can say every property.

    `translucent` says what a material without an alpha mode does.
    """
    made = copy_of(material)
    for name in ("blend", "depth_write", "depth_test", "color_write", "stencil", "flat_shading"):
        setattr(made, name, getattr(_fresh(), name))
    for name in ("vertex_colors", "specular", "specular_samples", "multiple_scattering"):
        setattr(made, name, getattr(_fresh(), name))
    for name in map_names():
        value = getattr(made, name)
        source = value.source if isinstance(value, Texture) else value
        if source is not None and not isinstance(source, Image):
            setattr(made, name, None)  # a picture that is drawn
        elif isinstance(value, Texture) and not value.uv_set and not transform(value):
            setattr(made, name, source)  # glTF has no place that changes nothing
    if made.alpha_mode is None:
        made.alpha_mode = "blend" if translucent(material) else "opaque"
    made.color = (*np.asarray(made.color)[:3], float(made.color[3]) * made.opacity)
    made.opacity = 1
    if made.alpha_mode != "mask":
        made.alpha_cutoff = _fresh().alpha_cutoff
    greatest = float(np.max(made.emissive))
    if greatest > 1:  # a factor is at most 1 (section 5.19.6)
        made.emissive_strength = made.emissive_strength * greatest
        made.emissive = np.minimum(made.emissive / greatest, 1)
    for strength, of in (
        ("normal_scale", "normal_map"),
        ("clearcoat_normal_scale", "clearcoat_normal_map"),
        ("occlusion_strength", "occlusion_map"),
    ):
        if getattr(made, of) is None:
            setattr(made, strength, 1)
    if (
        made.unlit
    ):  # the other properties change no picture, and other extensions may not stand beside it
        made = StandardMaterial(
            color=made.color, map=made.map, alpha_mode=made.alpha_mode,
            alpha_cutoff=made.alpha_cutoff, double_sided=made.double_sided, unlit=True,
        )  # fmt: skip
    return made


def map_names() -> list[str]:
    """Return the properties of StandardMaterial that are maps."""
    return [name for name in state_of(_fresh()) if name == "map" or name.endswith("_map")]


def copy_of(material: StandardMaterial) -> StandardMaterial:
    made = StandardMaterial()
    for name, value in state_of(material).items():
        setattr(made, name, value)
    return made


def _fresh() -> StandardMaterial:
    return _FRESH


_FRESH = StandardMaterial(alpha_mode="opaque")
