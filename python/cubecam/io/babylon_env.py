"""Babylon.js' .env: filtered levels and irradiance of a cubemap in one file.

The format is that of Babylon's environmentTextureTools, version 2: eight bytes, a JSON manifest that ends in a zero
byte, then a PNG for each face of each level down to one texel. Colours are RGBD: light = (rgb / 255)^2.2 / (d / 255).
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import CubeMap
from . import oiio
from .pixels import on_color, srgb_decode, to_float32

if TYPE_CHECKING:
    from .pixels import Array, FloatArray

MAGIC = b"\x86\x16\x87\x96\xf6\xd6\x96\x36"
#: Level k of N texels is looked up where log2(N roughness^2) times this is k.
_SCALE = 0.8
#: Filtered levels that the file's are mixed of.
_LEVELS = 16
#: The factors of the real spherical harmonics, rows as in `CubeMap.sh`, times those of the cosine lobe over pi: 1, 2/3
#: and 1/4. Those count twice, since Babylon takes them away once when it makes harmonics of the polynomial again.
_FIRST, _XY, _ZZ, _XX = 0.488603 * 4 / 9, 1.092548 / 16, 0.315392 / 16, 0.546274 / 16
_SH = np.array([0.282095, _FIRST, _FIRST, _FIRST, _XY, _XY, _ZZ, _XY, _XX])


def encode_env(cube: CubeMap) -> bytes:
    """Make the bytes of a file. Babylon's left-handed world has the scene's -x as +x: the convention "three".

    Raises
    ------
    ValueError
        If the size is no power of two.
    """
    size = cube.size
    if size & (size - 1):
        raise ValueError(
            f"expected a power of two of texels along an edge for .env, got {size}; resize first"
        )
    light = light_of(cube)
    made = light if len(light.levels) > 1 else light.prefilter(levels=_LEVELS)
    blobs = []
    for k in range(size.bit_length()):
        level = _at_roughness(made, level_roughness(k, size), size >> k)
        faces = CubeMap(level).to_convention("three")
        # Babylon turns the pictures upside down when it decodes them.
        blobs += [
            oiio.encode(".png", _rgbd(face[::-1]), {"oiio:UnassociatedAlpha": 1}) for face in faces
        ]
    mipmaps, at = [], 0
    for blob in blobs:
        mipmaps.append({"length": len(blob), "position": at})
        at += len(blob)
    manifest = {
        "version": 2,
        "width": size,
        "imageType": "image/png",
        "irradiance": irradiance_polynomial(light.sh()),
        "specular": {"mipmaps": mipmaps, "lodGenerationScale": _SCALE},
    }
    return MAGIC + json.dumps(manifest).encode() + b"\0" + b"".join(blobs)


def level_roughness(k: int, size: int) -> float:
    """Give the roughness for which Babylon looks up level k: ``log2(size roughness^2) lodGenerationScale = k``."""
    return 0.0 if k == 0 else min(1.0, float((2 ** (k / _SCALE) / size) ** 0.5))


def irradiance_polynomial(sh: Array) -> dict[str, list[float]]:
    """Give Babylon's polynomial of a normal for the diffuse light, from `CubeMap.sh`, in Babylon's axes (-x, y, z)."""
    c = sh[:, :3] * _SH[:, None]
    if c.shape[1] == 1:
        c = np.repeat(c, 3, axis=1)
    flat, y, z, x, xy, yz, zz, xz, xx = c
    constant = flat - zz  # x^2 + y^2 + z^2 is 1
    terms = {
        "x": -x, "y": y, "z": z, "xx": constant + xx, "yy": constant - xx, "zz": constant + 3 * zz,
        "yz": yz, "zx": -xz, "xy": -xy,
    }  # fmt: skip
    return {name: [float(value) for value in values] for name, values in terms.items()}


def light_of(cube: CubeMap) -> CubeMap:
    """Give linear RGB in float32, with the same levels."""
    levels = []
    for level in cube.levels:
        faces: Any = to_float32(level)
        if cube.encoding == "srgb":
            faces = on_color(srgb_decode, faces)
        faces = np.repeat(faces, 3, axis=-1) if faces.shape[-1] == 1 else faces[..., :3]
        faces = np.nan_to_num(np.maximum(faces, 0), posinf=65504)
        levels.append(CubeMap(np.ascontiguousarray(faces), encoding="linear"))
    return levels[0] if len(levels) == 1 else CubeMap.from_levels(levels)


def _at_roughness(cube: CubeMap, roughness: float, size: int) -> FloatArray:
    """Mix the two levels beside a roughness, linearly, as lookups do."""
    place = roughness * (len(cube.levels) - 1)
    low = min(int(place), len(cube.levels) - 2)
    share = np.float32(place - low)
    first, second = (
        CubeMap(cube.levels[low + i]).resize(size, dtype="float32").faces for i in (0, 1)
    )
    mixed: FloatArray = first + (second - first) * share
    return mixed


def _rgbd(face: FloatArray) -> Array:
    """Encode light: d is the largest whole number of 255ths for which no colour is above 1."""
    most = np.maximum(face.max(axis=-1, keepdims=True), 1e-7)
    d = np.clip(np.floor(np.maximum(255 / most, 1)), 1, 255)
    colors = np.clip(face * (d / 255), 0, 1) ** (1 / 2.2)
    return np.floor(np.concatenate([colors, d / 255], axis=-1) * 255 + 0.5).astype(np.uint8)
