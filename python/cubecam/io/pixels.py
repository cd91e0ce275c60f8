"""Conversions between the numbers of picture files and those of arrays."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .._core import _to_array

Array: TypeAlias = npt.NDArray[Any]
FloatArray: TypeAlias = npt.NDArray[np.float32]


#: The shares of red, green and blue in the luminance of linear sRGB (ITU-R BT.709).
LUMINANCE = (0.2126, 0.7152, 0.0722)


def srgb_decode(values: Array) -> FloatArray:
    """Turn sRGB-encoded 0..1 into linear 0..1 (IEC 61966-2-1, section 5.2)."""
    encoded = np.asarray(values, dtype=np.float32)
    linear: FloatArray = np.where(
        encoded <= np.float32(0.04045),
        encoded / np.float32(12.92),
        ((np.maximum(encoded, 0) + np.float32(0.055)) / np.float32(1.055)) ** np.float32(2.4),
    )
    return linear


def srgb_encode(values: Array) -> FloatArray:
    """Turn linear 0..1 into sRGB-encoded 0..1 (IEC 61966-2-1, section 5.2); the inverse of `srgb_decode`."""
    linear = np.asarray(values, dtype=np.float32)
    encoded: FloatArray = np.where(
        linear <= np.float32(0.0031308),
        linear * np.float32(12.92),
        np.float32(1.055) * np.maximum(linear, 0) ** np.float32(1 / 2.4) - np.float32(0.055),
    )
    return encoded


def on_color(curve: Any, pixels: FloatArray) -> FloatArray:
    """Apply a curve to the colour channels; a fourth channel is alpha and stays as it is."""
    if pixels.shape[-1] != 4:
        return np.asarray(curve(pixels), dtype=np.float32)
    return np.concatenate([curve(pixels[..., :3]), pixels[..., 3:]], axis=-1)


def check_picture(pixels: Any, name: str = "pixels") -> Array:
    """Check that an array is a picture: (H, W) or (H, W, 1, 3 or 4) real numbers. Return (H, W, C).

    Raises
    ------
    TypeError
        For bool, complex, object and text.
    ValueError
        For another shape, or an empty array.
    """
    array = _to_array(pixels, name)
    if array.dtype.kind not in "uif":
        hint = " (a mask: pass mask.astype(numpy.uint8) * 255)" if array.dtype.kind == "b" else ""
        raise TypeError(
            f"{name}: expected an array of real numbers, got {_describe(pixels, array)}{hint}"
        )
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or array.size == 0:
        raise ValueError(
            f"{name}: expected shape (height, width) or (height, width, channels) with 1, 3 or 4 channels, "
            f"got {np.shape(pixels)}"
        )
    return array


def check_colors(pixels: Any, name: str = "pixels") -> Array:
    """Check that an array holds colours: (H, W) or (..., 1, 3 or 4), whole numbers of 8 or 16 bits or floats.

    Returns (..., C) with (H, W) as (H, W, 1).

    Raises
    ------
    TypeError
        For bool, complex, object and text, and for wider whole numbers, which are ids.
    ValueError
        For another shape, or an empty array.
    """
    array = _to_array(pixels, name)
    if array.dtype.kind != "f" and array.dtype not in (np.uint8, np.uint16):
        raise TypeError(f"{name}: expected floats, uint8 or uint16, got {_describe(pixels, array)}")
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim < 2 or array.shape[-1] not in (1, 3, 4) or array.size == 0:
        raise ValueError(
            f"{name}: expected shape (..., height, width, channels) with 1, 3 or 4 channels, or (height, width), "
            f"got {np.shape(pixels)}"
        )
    return array


def _describe(value: object, array: Array) -> str:
    return f"dtype {array.dtype}" if isinstance(value, np.ndarray) else type(value).__name__


def to_float32(array: Array, name: str = "pixels") -> FloatArray:
    """Convert to float32 numbers: integers of 8 and 16 bits as value/255 and value/65535."""
    values: FloatArray
    if array.dtype in (np.uint8, np.uint16):
        values = array.astype(np.float32)
        values /= np.float32(np.iinfo(array.dtype).max)
        return values
    if array.dtype.kind == "f" and array.dtype.itemsize > 4:
        limit = np.finfo(np.float32).max
        if np.any(np.isfinite(array) & (np.abs(array) > limit)):
            raise ValueError(
                f"{name}: expected numbers that fit float32, got {np.nanmax(np.abs(array)):.4g}"
            )
    values = array.astype(np.float32)
    return values


def to_integers(array: Array, maximum: int, name: str = "pixels") -> Array:
    """Turn numbers into the integers of a file: clipped to 0..1, scaled to `maximum`, rounded.

    Infinity is clipped like any number; NaN raises ValueError, since integers cannot hold it.
    """
    dtype = np.uint8 if maximum == 255 else np.uint16
    if array.dtype == dtype:
        return array
    values = to_float32(array, name)
    bad = np.isnan(values)
    if bad.any():
        where = tuple(int(i) for i in np.argwhere(bad)[0])
        raise ValueError(
            f"{name}: an 8 or 16 bit file cannot hold NaN, got {int(bad.sum())} of them, the first at {where}; "
            "use numpy.nan_to_num, or save as .exr"
        )
    scaled = np.clip(values.astype(np.float64), 0.0, 1.0) * maximum
    return np.floor(scaled + 0.5).astype(dtype)
