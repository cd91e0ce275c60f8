"""Materials as plain data, with the pictures that a mesh can show."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from ..._core import (
    BasicMaterial,
    CubeMap,
    GlassMaterial,
    Image,
    Material,
    Mesh,
    MirrorMaterial,
    Node,
    PhongMaterial,
    RenderTexture,
    StandardMaterial,
    Texture,
)
from ..._drawn_meshes import tangent_uv_set
from ..arrays import Array
from .records import (
    BasicRecord,
    GlassRecord,
    MaterialRecord,
    MirrorRecord,
    PhongRecord,
    StandardRecord,
)
from .refusals import check_texture, no_textures
from .textures import Lookup

Textures: TypeAlias = Callable[[RenderTexture], npt.NDArray[np.generic]]

#: Maps of colours, whose 8-bit numbers are decoded if they are sRGB.
_COLORS = ("map", "emissive_map", "specular_color_map", "sheen_color_map")
_MAPS = (
    *_COLORS,
    "metallic_roughness_map",
    "normal_map",
    "specular_map",
    "clearcoat_map",
    "clearcoat_roughness_map",
    "clearcoat_normal_map",
    "sheen_roughness_map",
    "iridescence_map",
    "iridescence_thickness_map",
    "anisotropy_map",
    "transmission_map",
    "thickness_map",
)  # an occlusion map is left out, since rays find what occludes
_NUMBERS = (
    "metallic",
    "roughness",
    "normal_scale",
    "emissive_strength",
    "alpha_cutoff",
    "ior",
    "specular_weight",
    "clearcoat",
    "clearcoat_roughness",
    "clearcoat_normal_scale",
    "sheen_roughness",
    "iridescence",
    "iridescence_ior",
    "iridescence_thickness_min",
    "iridescence_thickness_max",
    "anisotropy",
    "anisotropy_rotation",
    "transmission",
    "thickness",
    "attenuation_distance",
    "dispersion",
)


def blends(material: Material, mesh: Mesh) -> bool:
    """Return whether a surface is blended if its `blend` is None (docs/conventions.md, "Blending")."""
    if _opacity(material) < 1:
        return True
    if isinstance(material, StandardMaterial) and material.alpha_mode is not None:
        return material.alpha_mode == "blend"
    if not isinstance(material, (BasicMaterial, PhongMaterial, StandardMaterial)):
        return False
    if material.vertex_colors and mesh.colors is not None and np.any(mesh.colors[:, 3] < 1):
        return True
    shown = material.map
    image = shown.source if isinstance(shown, Texture) else shown
    if not isinstance(image, Image) or image.channels != 4:
        return False
    full = 255 if image.dtype == np.uint8 else 1
    return bool(np.any(image.pixels[..., 3] < full))


def _opacity(material: Material) -> float:
    """Return opacity times the alphas of the material's colours."""
    alpha = np.float32(material.opacity)
    if isinstance(material, StandardMaterial):
        if material.alpha_mode in (None, "blend"):
            alpha *= material.color[3]
    elif isinstance(material, (GlassMaterial, MirrorMaterial)):
        alpha *= material.tint[3]
        if isinstance(material, MirrorMaterial):
            alpha *= material.color[3]
    elif isinstance(material, (BasicMaterial, PhongMaterial)):
        alpha *= material.color[3]
    return float(alpha)


class MaterialReader:
    """Makes a record of each material, for each kind of mesh that shows it: maps need uvs, and bumps need tangents."""

    def __init__(self, textures: Textures | None) -> None:
        self.records: list[MaterialRecord] = []
        self._known: dict[tuple[int, bool, bool, bool], tuple[Material, int]] = {}
        self._textures = textures
        self._pictures: dict[int, tuple[RenderTexture, npt.NDArray[np.generic]]] = {}

    @staticmethod
    def opacity(material: Material) -> float:
        """Return opacity times the alphas of the material's colours."""
        return _opacity(material)

    @staticmethod
    def shows_colors(material: Material) -> bool:
        """Return whether the material uses the mesh's colours."""
        return bool(getattr(material, "vertex_colors", False))

    def place_of(self, node: Node, mesh: Mesh) -> int:
        """Return the place of the record of a node's material."""
        material = node.material
        assert material is not None  # nodes with a mesh have one
        has = (mesh.uvs is not None, mesh.uvs1 is not None, mesh.tangents is not None)
        key = (id(material), *has)
        if key not in self._known:  # the material is kept, so that its id stays its own
            self._known[key] = (material, len(self.records))
            self.records.append(self._record(node, material, mesh))
        return self._known[key][1]

    def _record(self, node: Node, material: Material, mesh: Mesh) -> MaterialRecord:
        if isinstance(material, MirrorMaterial):
            return MirrorRecord(
                _numbers(material.tint),
                material.env_weight,
                _numbers(material.color),
                material.color_weight,
                material.f0,
            )
        if isinstance(material, GlassMaterial):
            return GlassRecord(
                material.ior,
                material.fresnel,
                _numbers(material.tint),
                material.roughness,
                material.dispersion,
                material.attenuation_distance,
                _numbers(material.attenuation_color),
            )
        if isinstance(material, StandardMaterial):
            return self._standard(node, material, mesh)
        assert isinstance(material, (BasicMaterial, PhongMaterial))  # others were refused
        shown = self._lookup(node, mesh, "map", material.map, decodes=False)
        if isinstance(material, PhongMaterial):
            return PhongRecord(
                _numbers(material.color),
                material.ka,
                material.kd,
                material.ks,
                material.shininess,
                shown,
            )
        cube = material.cubemap
        return BasicRecord(
            _numbers(material.color), shown, cube if isinstance(cube, CubeMap) else None
        )

    def _standard(self, node: Node, material: StandardMaterial, mesh: Mesh) -> StandardRecord:
        maps = {}
        tangents = tangent_uv_set(material) is not None and mesh.tangents is not None
        for name in _MAPS:
            lookup = self._lookup(
                node, mesh, name, getattr(material, name), decodes=name in _COLORS
            )
            if lookup is not None and (tangents or not name.endswith("normal_map")):
                maps[name] = lookup
        return StandardRecord(
            color=_numbers(material.color),
            emissive=_numbers(material.emissive),
            specular_color=_numbers(material.specular_color),
            sheen_color=_numbers(material.sheen_color),
            attenuation_color=_numbers(material.attenuation_color),
            numbers={name: float(getattr(material, name)) for name in _NUMBERS},
            maps=maps,
            tangents=tangents,
            alpha_mode=material.alpha_mode,
            unlit=material.unlit,
            specular=material.specular,
            specular_samples=material.specular_samples,
            multiple_scattering=material.multiple_scattering,
        )

    def _lookup(
        self,
        node: Node,
        mesh: Mesh,
        name: str,
        shown: Texture | Image | RenderTexture | None,
        *,
        decodes: bool,
    ) -> Lookup | None:
        """Make the lookup of a map; None where the mesh has no uvs for it."""
        matrix, uv_set = None, 0
        source: Image | RenderTexture | None
        if isinstance(shown, Texture):
            source, uv_set = shown.source, shown.uv_set
            matrix = np.asarray(shown.matrix, np.float64)
        else:
            source = shown
        if source is None or (mesh.uvs if uv_set == 0 else mesh.uvs1) is None:
            return None
        if isinstance(source, RenderTexture):
            pixels = self._picture(node, name, source)
            wraps: str | tuple[str, str] = source.wrap
            decode, nearest = decodes and pixels.dtype == np.uint8, False
        else:
            pixels, wraps = np.array(source.pixels), source.wrap
            decode = decodes and source.encoding == "srgb"
            nearest = source.mag_filter == "nearest"
        pair = (wraps, wraps) if isinstance(wraps, str) else wraps
        return Lookup(pixels, pair, nearest, matrix, uv_set, decode)

    def _picture(self, node: Node, name: str, texture: RenderTexture) -> npt.NDArray[np.generic]:
        check_texture(node, name, texture)
        if self._textures is None:
            no_textures(node, name, texture)
        if id(texture) not in self._pictures:
            picture = np.asarray(self._textures(texture))
            if picture.dtype != np.uint8 and texture.format in ("rgba8", "rgb565"):
                picture = np.clip(picture, 0, 1)
            self._pictures[id(texture)] = (texture, picture)
        return self._pictures[id(texture)][1]


def _numbers(color: npt.ArrayLike) -> Array:
    return np.array(color, np.float64)
