"""Pictures of objects for notebooks: PNG bytes that a screen shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .io import oiio
from .io.pixels import Array, FloatArray, on_color, srgb_encode, to_float32, to_integers

if TYPE_CHECKING:
    from ._core import CubeMap, Frame, Image

# A notebook keeps every picture in its file: larger faces are shown at this size.
_LARGEST_FACE = 256


def for_screen(pixels: Array) -> Array:
    """Turn (H, W, C) pixels into uint8 for a screen, three channels, opaque.

    uint8 stays as it is. Floats are linear; they are tone-mapped, then sRGB-encoded; NaN becomes black.
    """
    color = np.repeat(pixels, 3, axis=2) if pixels.shape[2] == 1 else pixels[..., :3]
    if color.dtype == np.uint8:
        return color
    values = np.nan_to_num(to_float32(color), nan=0.0, posinf=np.finfo(np.float32).max, neginf=0.0)
    return to_integers(on_color(srgb_encode, tonemap_neutral(np.clip(values, 0, 1e9))), 255)


def tonemap_neutral(linear: FloatArray) -> FloatArray:
    """Compress highlights into 0..1 and keep darker colours as they are.

    Khronos PBR Neutral Tone Mapper (specification of 2024), whose names the variables keep.
    """
    f90, start = np.float32(0.04), np.float32(0.8 - 0.04)
    desaturation = np.float32(0.15)
    low = linear.min(axis=-1, keepdims=True)
    offset = np.where(low < 2 * f90, low - low * low / (4 * f90), f90)
    color = linear - offset
    peak = color.max(axis=-1, keepdims=True)
    d = 1 - start
    # Below the start nothing changes; the maximum keeps the unused branch from dividing by zero.
    new_peak = np.where(peak < start, peak, 1 - d * d / np.maximum(peak + d - start, d))
    scaled = color * (new_peak / np.maximum(peak, np.float32(1e-9)))
    white = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    return np.asarray(scaled + (new_peak - scaled) * white, dtype=np.float32)


def cube_picture(cube: CubeMap) -> Array:
    """Draw the horizontal cross as seen from inside: not mirrored, with -Z in the middle of the view.

    uint8 (3N, 4N, 4); cells that no face covers are transparent, the rest is opaque.
    """
    picture = for_screen(cube.to_layout("cross", convention="inside"))
    covered = np.zeros((*picture.shape[:2], 1), np.uint8)
    covered[cube.size : 2 * cube.size] = 255
    covered[:, cube.size : 2 * cube.size] = 255
    return np.concatenate([picture, covered], axis=2)


def cube_png(cube: CubeMap) -> bytes:
    """Draw `cube_picture` at a size that a notebook can keep."""
    if cube.size > _LARGEST_FACE:
        cube = cube.resize(_LARGEST_FACE)
    return _png(cube_picture(cube))


def frame_png(frame: Frame) -> bytes:
    """Draw the frame's colour."""
    return _png(for_screen(frame.color))


def image_png(image: Image) -> bytes:
    """Draw a material's picture."""
    return _png(for_screen(image.pixels))


def _png(pixels: Array) -> bytes:
    return oiio.encode(".png", pixels, {"oiio:UnassociatedAlpha": 1})
