"""Cubemaps in KTX2 and DDS files: six faces with their levels, in the numbers of the cube."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import CubeMap
from . import dds, ktx2
from .formats import FORMATS, fit_samples, for_file
from .pixels import on_color, srgb_decode, srgb_encode, to_float32, to_integers
from .stored_as import KTX_KEY, StoredAs

if TYPE_CHECKING:
    from ..typing import Compression, Convention, Encoding
    from .pixels import Array

#: The kinds of files that hold faces one by one.
SUFFIXES = (".ktx2", ".dds")
#: DXGI_FORMAT by dtype and channels; of uint8 the sRGB one, too.
_DXGI = {
    ("uint8", 1, False): 61,
    ("uint8", 4, False): 28,
    ("uint8", 4, True): 29,
    ("float16", 1, False): 54,
    ("float16", 4, False): 10,
    ("float32", 1, False): 41,
    ("float32", 4, False): 2,
}


def encode_cube(
    cube: CubeMap,
    suffix: str,
    *,
    convention: Convention | None = None,
    exposure: float = 0.0,
    half: bool = False,
    compression: Compression | None = None,
) -> bytes:
    """Make the bytes of a KTX2 or DDS file, with the arguments of `save_cubemap`.

    Raises
    ------
    ValueError
        For more levels than the size allows, numbers that float16 does not hold, or a compression of DDS.
    """
    if compression is not None and suffix != ".ktx2":
        raise ValueError(f'compression: expected with ".ktx2" only, got {compression!r}')
    levels, stored = stored_levels(cube, convention, exposure, half)
    encoding: Encoding = cube.encoding if levels[0].dtype == np.uint8 else "linear"
    if suffix == ".ktx2":
        remark = stored.text()
        return ktx2.write(
            levels, encoding=encoding, compression=compression, key_values={KTX_KEY: remark}
        )
    if levels[0].shape[-1] == 1 and encoding == "srgb":  # DXGI has no sRGB format of one channel
        levels = [np.repeat(level, 3, axis=-1) for level in levels]
        stored = replace(stored, channels="3")
    return _dds(levels, encoding, stored.short_text())


def stored_levels(
    cube: CubeMap, convention: Convention | None, exposure: float, half: bool
) -> tuple[list[Array], StoredAs]:
    """Give the levels of a file, each half as large as the one before, and what the file says of them.

    Filtered levels are resized to those sizes. A cube with ``mipmaps=True`` and no filtered levels gets means of light,
    down to one texel; every other cube has one level.
    """
    filtered = len(cube.levels) > 1
    most = cube.size.bit_length()
    if len(cube.levels) > most:
        raise ValueError(
            f"expected at most {most} levels in a file of {cube.size} texels an edge, got {len(cube.levels)}; "
            f"prefilter(levels={most}) makes them"
        )
    if filtered:
        cubes = [
            CubeMap(level, encoding=cube.encoding).resize(cube.size >> k)
            for k, level in enumerate(cube.levels)
        ]
    elif cube.mipmaps:
        cubes = _mipmaps(cube)
    else:
        cubes = [cube]
    kind: Convention = convention or "gl"
    levels = [_numbers(each.to_convention(kind), cube.encoding, exposure, half) for each in cubes]
    return levels, StoredAs(
        convention=kind.lower(),
        levels="roughness" if filtered else None,
        channels="3" if cube.channels == 3 else None,
    )


def _numbers(pixels: Array, encoding: Encoding, exposure: float, half: bool) -> Array:
    """Give uint8 as it is; floats are light."""
    if pixels.dtype == np.uint8 and exposure == 0:
        return pixels
    light = for_file(pixels, encoding, True, exposure, None, None)
    if light.dtype == np.uint8:
        light = to_float32(light)
    return fit_samples(light, FORMATS[".exr"], ".exr", False, half)


def _mipmaps(cube: CubeMap) -> list[CubeMap]:
    """Give box-filtered levels down to one texel. sRGB numbers are averaged as light, as texture units do."""
    encoded = cube.encoding == "srgb"
    light = on_color(srgb_decode, to_float32(cube.faces)) if encoded else cube.faces
    cubes, last = [cube], CubeMap(light, encoding="linear")
    while last.size > 1:
        last = last.resize(last.size // 2, dtype="float32")
        pixels: Any = on_color(srgb_encode, np.clip(last.faces, 0, 1)) if encoded else last.faces
        pixels = to_integers(pixels, 255) if cube.dtype == np.uint8 else pixels.astype(cube.dtype)
        cubes.append(CubeMap(pixels, encoding=cube.encoding))
    return cubes


def _dds(levels: list[Array], encoding: Encoding, remark: str) -> bytes:
    """Make a DDS file: each face with all its levels before the next face."""
    srgb = encoding == "srgb"
    pictures = [_dds_channels(level) for level in levels]
    first = pictures[0]
    size, channels = first.shape[1], first.shape[-1]
    number = _DXGI[first.dtype.name, channels, srgb]
    head = dds.header(
        size,
        size,
        number,
        levels=len(pictures),
        cube=True,
        row=size * channels * first.dtype.itemsize,
        remark=remark.encode("ascii"),
    )
    little = first.dtype.newbyteorder("<")
    faces = [
        np.ascontiguousarray(picture[face], dtype=little).tobytes()
        for face in range(6)
        for picture in pictures
    ]
    return head + b"".join(faces)


def _dds_channels(level: Array) -> Array:
    if level.shape[-1] != 3:
        return level
    one = 255 if level.dtype == np.uint8 else 1
    return np.concatenate([level, np.full_like(level[..., :1], one)], axis=-1)
