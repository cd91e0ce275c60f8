"""Materials of MTL files as StandardMaterial, converted as Blender's importer does (io/wavefront_obj).

- base colour Kd, alpha d (or 1 - Tr), emission Ke, index of refraction Ni
- roughness Pr, or 1 - sqrt(Ns / 1000)
- metallic Pm, or the mean of Ka where `illum` asks for reflections, which is how Blender writes a metal
- reflectance seen head-on: that of Ni times twice the mean of Ks
- clear coat Pc and Pcr, sheen Ps, anisotropy aniso and anisor
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, cast

import numpy as np

from ..._core import FileError, Image, StandardMaterial, Texture
from ..gltf.references import read_uri
from ..left_out import LeftOut
from ..model_pictures import ModelPictures, numbers_for
from ..pixels import Array
from .mtl import MapLine, Mtl

#: The modes of illumination that reflect.
_REFLECTING = (3, 4, 5, 6, 7, 8, 9)
#: Ns at which a surface is a mirror.
_SHARPEST = 1000.0
#: Words that StandardMaterial has no place for.
_UNKNOWN = ("map_Ns", "map_Ps", "map_Tr", "refl", "disp", "decal")
_MAP_ROUGHNESS = 0.5


def read_named(name: str, folder: Path) -> bytes:
    """Read a file that a model names; where that place is not there or not allowed, the file of that name beside it."""
    try:
        return read_uri(name, folder)
    except FileError:
        short = name.replace("\\", "/").rsplit("/", 1)[-1]
        if short in ("", name):
            raise
        return read_uri(short, folder)


class MtlMaterials:
    """Makes the materials of a model in a folder."""

    def __init__(self, folder: Path, left_out: LeftOut) -> None:
        self._left_out = left_out
        self._pictures = ModelPictures(lambda name: read_named(cast(str, name), folder))
        self._images: dict[tuple[Any, ...], Image] = {}

    def prepare(self, materials: list[Mtl]) -> None:
        """Decode all pictures of some materials at the same time."""
        self._pictures.prefetch(
            line.file
            for material in materials
            for word, line in material.maps.items()
            if word not in (*_UNKNOWN, "map_Ka")
        )

    def make(self, mtl: Mtl) -> StandardMaterial:
        for word in _UNKNOWN:
            if word in mtl.maps:
                self._left_out.add(f"{word} of an MTL is not read", mtl.name)
        options = self._surface(mtl) | self._coats(mtl) | self._alpha(mtl) | self._bumps(mtl)
        emission = mtl.color("ke")
        glow = self._image(mtl, "map_Ke", color=True)
        if glow is not None:
            # A factor of black beside a map is what programs write that know the map alone.
            options["emissive_map"] = glow
            emission = emission if emission is not None and any(emission) else (1.0, 1.0, 1.0)
        if emission is not None:
            options["emissive"] = np.maximum(emission, 0)
        return StandardMaterial(**options, name=mtl.name)

    def _surface(self, mtl: Mtl) -> dict[str, Any]:
        shininess = mtl.number("ns")
        illum = int(mtl.number("illum") or 0)
        rough = _MAP_ROUGHNESS
        if shininess is not None:
            rough = 1 - math.sqrt(min(max(shininess / _SHARPEST, 0), 1))
        rough = _unit(mtl.number("pr"), rough)
        ambient = mtl.color("ka")
        metal = sum(ambient) / 3 if ambient is not None and illum in _REFLECTING else 0.0
        metal = _unit(mtl.number("pm"), metal)
        options: dict[str, Any] = {"roughness": rough, "metallic": min(max(metal, 0.0), 1.0)}
        highlight = mtl.color("ks")
        if highlight is not None:
            level = 2 * max(sum(highlight) / 3, 0.0)
            options["specular_weight"] = min(level, 1.0)
            options["specular_color"] = (max(level, 1.0),) * 3
        index = mtl.number("ni")
        if index is not None and index >= 1:
            options["ior"] = index
        shine = self._image(mtl, "map_Ks", color=True)
        if shine is not None:
            options |= {
                "specular_weight": 1.0,
                "specular_color": (2.0,) * 3,
                "specular_color_map": shine,
            }
        return options | self._roughness_maps(mtl)

    def _roughness_maps(self, mtl: Mtl) -> dict[str, Any]:
        """Put map_Pr and map_Pm into the green and blue channel of one map."""
        grey = {word: self._grey(mtl, word) for word in ("map_Pr", "map_Pm")}
        first = next((word for word, values in grey.items() if values is not None), None)
        if first is None:
            return {}
        size = cast(Array, grey[first]).shape
        both = np.full((*size, 3), 1, np.float32)
        result: dict[str, Any] = {}
        for channel, (word, name) in enumerate(
            (("map_Pr", "roughness"), ("map_Pm", "metallic")), 1
        ):
            values = grey[word]
            if values is not None:
                both[..., channel] = _resized(values, size)
                result[name] = 1.0
        pixels = np.rint(both * 255).astype(np.uint8)
        result["metallic_roughness_map"] = _placed(
            _made(pixels, mtl.maps[first], "linear"), mtl.maps[first]
        )
        return result

    def _coats(self, mtl: Mtl) -> dict[str, Any]:
        options: dict[str, Any] = {}
        coat = mtl.number("pc")
        if coat:
            options["clearcoat"] = min(max(coat, 0.0), 1.0)
            options["clearcoat_roughness"] = _unit(mtl.number("pcr"), 0.0)
        sheen = _unit(mtl.number("ps"), 0.0)
        if sheen:
            options["sheen_color"] = (sheen,) * 3
            options["sheen_roughness"] = _MAP_ROUGHNESS
        stretch = _unit(mtl.number("aniso"), 0.0)
        if stretch:
            options["anisotropy"] = stretch
            options["anisotropy_rotation"] = 360 * (mtl.number("anisor") or 0.0)
        return options

    def _alpha(self, mtl: Mtl) -> dict[str, Any]:
        """Read the colour with its alpha. A map of alpha goes into the fourth channel of the map of colour."""
        alpha = mtl.number("d")
        if alpha is None and mtl.number("tr") is not None:
            alpha = 1 - cast(float, mtl.number("tr"))
        alpha = _unit(alpha, 1.0)
        color = mtl.color("kd") or (0.8, 0.8, 0.8)
        picture = self._image(mtl, "map_Kd", color=True)
        if picture is not None:
            color = (1.0, 1.0, 1.0)
        mask = self._grey(mtl, "map_d", of_alpha=True)
        if mask is not None:
            picture = self._with_alpha(mtl, mask)
        elif picture is not None:
            # Alpha that no map_d names is no part of an MTL.
            alpha_counts = alpha < 1
            return {
                "color": (*color, alpha),
                "map": picture,
                "alpha_mode": "blend" if alpha_counts else "opaque",
            }
        return {
            "color": (*np.clip(color, 0, 1), alpha),
            "map": picture,
            "alpha_mode": "blend" if alpha < 1 or mask is not None else "opaque",
        }

    def _with_alpha(self, mtl: Mtl, mask: Array) -> Texture | Image | None:
        base = self._pixels(mtl, "map_Kd", color=True)
        line = mtl.maps.get("map_Kd", mtl.maps["map_d"])
        if base is None:
            base = np.full((*mask.shape, 3), 255, np.uint8)
        mask = _resized(mask, base.shape[:2])
        full = 255 if base.dtype == np.uint8 else 1
        pixels = np.empty((*base.shape[:2], 4), base.dtype)
        pixels[..., :3] = base[..., :3]
        pixels[..., 3] = np.rint(mask * full) if full == 255 else mask
        encoding = "srgb" if full == 255 else "linear"
        return _placed(_made(pixels, line, encoding), line)

    def _bumps(self, mtl: Mtl) -> dict[str, Any]:
        """Read a map of normals; a grey map_Bump is one of heights, which StandardMaterial does not have."""
        for word in ("norm", "map_Bump"):
            pixels = self._pixels(mtl, word, color=False)
            if pixels is None:
                continue
            if pixels.shape[2] < 3 or np.ptp(pixels[..., :3].astype(np.float32), axis=2).max() == 0:
                self._left_out.add("a map of heights is not read", f"{word} of {mtl.name}")
                continue
            options = {"normal_map": self._image(mtl, word, color=False)}
            return options | {"normal_scale": mtl.maps[word].strength}
        return {}

    def _pixels(self, mtl: Mtl, word: str, *, color: bool) -> Array | None:
        line = mtl.maps.get(word)
        if line is None:
            return None
        try:
            return numbers_for(self._pictures.pixels(line.file), color=color)
        except FileError as error:
            self._left_out.add(f"a picture is left out: {error}", f"{word} of {mtl.name}")
            return None

    def _image(self, mtl: Mtl, word: str, *, color: bool) -> Texture | Image | None:
        pixels = self._pixels(mtl, word, color=color)
        if pixels is None:
            return None
        line = mtl.maps[word]
        encoding = "srgb" if color and pixels.dtype == np.uint8 else "linear"
        key = (line.file, line.clamp, encoding)
        if key not in self._images:
            self._images[key] = _made(pixels, line, encoding)
        return _placed(self._images[key], line)

    def _grey(self, mtl: Mtl, word: str, *, of_alpha: bool = False) -> Array | None:
        """Return the numbers 0..1 of a map of one value: its only channel, alpha where asked and there, else red."""
        pixels = self._pixels(mtl, word, color=False)
        if pixels is None:
            return None
        channel = 3 if of_alpha and pixels.shape[2] == 4 else 0
        full = 255 if pixels.dtype == np.uint8 else 1
        values: Array = pixels[..., channel].astype(np.float32) / np.float32(full)
        return values


def _made(pixels: Array, line: MapLine, encoding: Any) -> Image:
    return Image(pixels, mipmaps=True, wrap="clamp" if line.clamp else "repeat", encoding=encoding)


def _placed(image: Image, line: MapLine) -> Texture | Image:
    if line.offset == (0, 0) and line.scale == (1, 1):
        return image
    return Texture(image, offset=line.offset, scale=line.scale)


def _unit(value: float | None, missing: float) -> float:
    return missing if value is None else min(max(value, 0.0), 1.0)


def _resized(values: Array, size: tuple[int, ...]) -> Array:
    """Take the nearest number for each pixel of another size."""
    rows = np.arange(size[0]) * values.shape[0] // size[0]
    columns = np.arange(size[1]) * values.shape[1] // size[1]
    result: Array = values[rows[:, None], columns]
    return result
