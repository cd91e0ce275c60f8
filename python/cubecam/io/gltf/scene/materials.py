"""Materials: section 3.9 of glTF 2.0 and the KHR_materials extensions, as StandardMaterial has them."""

from __future__ import annotations

import copy
import math
from typing import Any, cast

import numpy as np

from ...._core import Image, Material, StandardMaterial, Texture
from ...left_out import LeftOut
from ..document import Gltf
from ..entries import Entry
from ..extras import Extras
from .textures import Textures
from .values import Values, at

Map = Texture | Image | None

_ALPHA_MODES = {"OPAQUE": "opaque", "MASK": "mask", "BLEND": "blend"}


class Materials:
    """The materials of a document, each made once."""

    def __init__(
        self, document: Gltf, textures: Textures, extras: Extras, left_out: LeftOut
    ) -> None:
        self._document = document
        self._textures = textures
        self._extras = extras
        self._left_out = left_out
        #: By index; None is the material of primitives that have none.
        self.made: dict[int | None, Any] = {}
        self._flat: dict[int | None, Any] = {}

    def get(self, index: int | None, *, flat: bool = False) -> Any:
        """Return a material; `flat` is for a primitive without normals (section 3.7.2.1)."""
        if index not in self.made:
            self.made[index] = self._material(index)
        material = self.made[index]
        if not flat or getattr(material, "unlit", False) or material.flat_shading:
            return material
        if index not in self._flat:
            self._flat[index] = copy.copy(material)
            self._flat[index].flat_shading = True
        return self._flat[index]

    def _material(self, index: int | None) -> Material:
        if index is None:
            return StandardMaterial(alpha_mode="opaque")
        entry = self._document.entry("materials", index)
        options: dict[str, Any] = {}
        glossy = entry.extension("KHR_materials_pbrSpecularGlossiness")
        if glossy is None:
            options |= self._metallic(entry.entry("pbrMetallicRoughness"))
        else:
            options |= self._specular_glossiness(glossy)
        options |= self._common(entry)
        for name, read in _EXTENSIONS.items():
            extension = entry.extension(name)
            if extension is not None:
                options |= read(self, extension)
        with at(entry):
            made = StandardMaterial(**options, name=entry.text("name") or "")
        return self._extras.material(index, made)

    def _values(self, entry: Entry | None) -> Values:
        return Values(entry, self._left_out)

    def _map(self, entry: Entry | None, name: str) -> Map:
        return self._textures.slot(entry, name)

    def _metallic(self, entry: Entry | None) -> dict[str, Any]:
        values = self._values(entry)
        return {
            "color": values.numbers("baseColorFactor", (1.0,) * 4, 0, 1),
            "metallic": values.number("metallicFactor", 1.0, 0, 1),
            "roughness": values.number("roughnessFactor", 1.0, 0, 1),
            "map": self._map(entry, "baseColorTexture"),
            "metallic_roughness_map": self._map(entry, "metallicRoughnessTexture"),
        }

    def _common(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        mode = entry.text("alphaMode") or "OPAQUE"
        if mode not in _ALPHA_MODES:
            raise entry.error("alphaMode", f"one of {', '.join(_ALPHA_MODES)}")
        occlusion = self._values(entry.entry("occlusionTexture"))
        return {
            "normal_map": self._map(entry, "normalTexture"),
            "normal_scale": self._values(entry.entry("normalTexture")).number("scale", 1.0),
            "occlusion_map": self._map(entry, "occlusionTexture"),
            "occlusion_strength": occlusion.number("strength", 1.0, 0, 1),
            "emissive": values.numbers("emissiveFactor", (0.0,) * 3, 0),
            "emissive_map": self._map(entry, "emissiveTexture"),
            "alpha_mode": _ALPHA_MODES[mode],
            "alpha_cutoff": values.number("alphaCutoff", 0.5, 0),
            "double_sided": entry.flag("doubleSided"),
        }

    def _specular_glossiness(self, entry: Entry) -> dict[str, Any]:
        """Read KHR_materials_pbrSpecularGlossiness as a dielectric with an infinite index of refraction.

        Its reflectance head-on is then `specular_color`: the conversion for which KHR_materials_ior has ``ior=0``.
        """
        values = self._values(entry)
        gloss = values.number("glossinessFactor", 1.0, 0, 1)
        options: dict[str, Any] = {
            "color": values.numbers("diffuseFactor", (1.0,) * 4, 0, 1),
            "map": self._map(entry, "diffuseTexture"),
            "metallic": 0.0,
            "roughness": 1 - gloss,
            "ior": 0.0,
            "specular_color": values.numbers("specularFactor", (1.0,) * 3, 0, 1),
        }
        placed = self._map(entry, "specularGlossinessTexture")
        if placed is None:
            return options
        options["specular_color_map"] = placed
        image = cast(Image, placed.source if isinstance(placed, Texture) else placed)
        pixels = image.pixels
        if (
            pixels.shape[2] == 4
        ):  # the roughness of a map is a factor, and glossiness its complement
            alpha = pixels[..., 3]
            full = 255 if alpha.dtype == np.uint8 else 1
            rough = np.zeros((*alpha.shape, 3), alpha.dtype)
            rough[..., 1] = np.rint(full - gloss * alpha) if full == 255 else 1 - gloss * alpha
            options["roughness"] = 1.0
            options["metallic_roughness_map"] = self._textures.like(placed, rough)
        return options

    def _ior(self, entry: Entry) -> dict[str, Any]:
        ior = self._values(entry).number("ior", 1.5, 0)
        return {"ior": ior if ior == 0 else max(ior, 1.0)}

    def _specular(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        return {
            "specular_weight": values.number("specularFactor", 1.0, 0, 1),
            "specular_map": self._map(entry, "specularTexture"),
            "specular_color": values.numbers("specularColorFactor", (1.0,) * 3, 0),
            "specular_color_map": self._map(entry, "specularColorTexture"),
        }

    def _clearcoat(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        normals = self._values(entry.entry("clearcoatNormalTexture"))
        return {
            "clearcoat": values.number("clearcoatFactor", 0.0, 0, 1),
            "clearcoat_map": self._map(entry, "clearcoatTexture"),
            "clearcoat_roughness": values.number("clearcoatRoughnessFactor", 0.0, 0, 1),
            "clearcoat_roughness_map": self._map(entry, "clearcoatRoughnessTexture"),
            "clearcoat_normal_map": self._map(entry, "clearcoatNormalTexture"),
            "clearcoat_normal_scale": normals.number("scale", 1.0),
        }

    def _sheen(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        return {
            "sheen_color": values.numbers("sheenColorFactor", (0.0,) * 3, 0, 1),
            "sheen_color_map": self._map(entry, "sheenColorTexture"),
            "sheen_roughness": values.number("sheenRoughnessFactor", 0.0, 0, 1),
            "sheen_roughness_map": self._map(entry, "sheenRoughnessTexture"),
        }

    def _iridescence(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        return {
            "iridescence": values.number("iridescenceFactor", 0.0, 0, 1),
            "iridescence_map": self._map(entry, "iridescenceTexture"),
            "iridescence_ior": values.number("iridescenceIor", 1.3, 1),
            "iridescence_thickness_min": values.number("iridescenceThicknessMinimum", 100.0, 0),
            "iridescence_thickness_max": values.number("iridescenceThicknessMaximum", 400.0, 0),
            "iridescence_thickness_map": self._map(entry, "iridescenceThicknessTexture"),
        }

    def _anisotropy(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        return {
            "anisotropy": values.number("anisotropyStrength", 0.0, 0, 1),
            "anisotropy_rotation": math.degrees(values.number("anisotropyRotation", 0.0)),
            "anisotropy_map": self._map(entry, "anisotropyTexture"),
        }

    def _transmission(self, entry: Entry) -> dict[str, Any]:
        return {
            "transmission": self._values(entry).number("transmissionFactor", 0.0, 0, 1),
            "transmission_map": self._map(entry, "transmissionTexture"),
        }

    def _volume(self, entry: Entry) -> dict[str, Any]:
        values = self._values(entry)
        distance = values.number("attenuationDistance", math.inf, 0)
        return {
            "thickness": values.number("thicknessFactor", 0.0, 0),
            "thickness_map": self._map(entry, "thicknessTexture"),
            "attenuation_distance": max(distance, 1e-9),
            "attenuation_color": values.numbers("attenuationColor", (1.0,) * 3, 0, 1),
        }

    def _dispersion(self, entry: Entry) -> dict[str, Any]:
        return {"dispersion": self._values(entry).number("dispersion", 0.0, 0)}

    def _emissive_strength(self, entry: Entry) -> dict[str, Any]:
        return {"emissive_strength": self._values(entry).number("emissiveStrength", 1.0, 0)}

    def _unlit(self, entry: Entry) -> dict[str, Any]:
        return {"unlit": True}


_EXTENSIONS = {
    "KHR_materials_ior": Materials._ior,
    "KHR_materials_specular": Materials._specular,
    "KHR_materials_clearcoat": Materials._clearcoat,
    "KHR_materials_sheen": Materials._sheen,
    "KHR_materials_iridescence": Materials._iridescence,
    "KHR_materials_anisotropy": Materials._anisotropy,
    "KHR_materials_transmission": Materials._transmission,
    "KHR_materials_volume": Materials._volume,
    "KHR_materials_dispersion": Materials._dispersion,
    "KHR_materials_emissive_strength": Materials._emissive_strength,
    "KHR_materials_unlit": Materials._unlit,
}
