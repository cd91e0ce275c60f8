"""The numbers and channels that each kind of picture file holds, and the conversion of an array to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .._checks import text_of
from ..typing import Encoding, Tonemap
from . import oiio
from .pixels import (
    Array,
    check_picture,
    on_color,
    srgb_decode,
    srgb_encode,
    to_float32,
    to_integers,
)
from .screen import (
    MAP_OR_DARKEN,
    encoding_of,
    screen_pixels,
    to_light,
    warn_if_clipped,
)

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class Format:
    """The numbers and channels that a kind of file can hold; `attributes` are OpenImageIO's settings for writing."""

    samples: tuple[str, ...]
    channels: tuple[int, ...] = (1, 3, 4)
    attributes: tuple[tuple[str, Any], ...] = (("oiio:UnassociatedAlpha", 1),)


_JPEG = Format(("uint8",), (1, 3), (("Compression", "jpeg:95"), ("jpeg:subsampling", "4:4:4")))
_TIFF = Format(
    ("uint8", "uint16", "float32"),
    attributes=(("oiio:UnassociatedAlpha", 1), ("compression", "zip")),
)
FORMATS = {
    ".exr": Format(("float16", "float32", "uint32"), attributes=(("compression", "zip"),)),
    ".hdr": Format(("float32",), (3,), ()),
    ".png": Format(("uint8", "uint16")),
    ".jpg": _JPEG,
    ".jpeg": _JPEG,
    ".tif": _TIFF,
    ".tiff": _TIFF,
    ".webp": Format(
        ("uint8",), (3, 4), (("oiio:UnassociatedAlpha", 1), ("compression", "lossless"))
    ),
    ".bmp": Format(("uint8",), (1, 3), ()),
    ".tga": Format(("uint8",)),
}


def for_file(
    pixels: Array,
    encoding: Encoding,
    light: bool,
    exposure: float,
    curve: Tonemap | None,
    srgb: bool | None,
) -> Array:
    """Turn an object's numbers into those of a file: linear if it holds light, else as a screen shows them.

    `curve` is that of `curve_for`. With ``srgb=False`` the numbers stay as they are.
    """
    if srgb is False:
        if exposure != 0:
            raise ValueError(
                f"exposure: expected 0 with srgb=False, which writes numbers as they are, got {exposure}"
            )
        if light or pixels.dtype.kind != "f":
            return pixels
        warn_if_clipped(pixels[..., :3], advice="")
        return np.minimum(pixels, 1)
    if light:
        return to_light(pixels, encoding, exposure)
    return screen_pixels(pixels, encoding, exposure, curve, True)


def decode(pixels: Array, srgb: bool, encoding: Encoding | None = None) -> Array:
    """Turn the numbers of a file into the array that `load_image` returns; `encoding` is what the file says of them."""
    if srgb and pixels.dtype in (np.uint8, np.uint16):
        light = to_float32(pixels)
        return light if encoding == "linear" else on_color(srgb_decode, light)
    return to_float32(pixels) if pixels.dtype == np.uint16 else pixels


def encoding_after_decode(pixels: Array, srgb: bool, encoding: Encoding | None = None) -> Encoding:
    """Say what the numbers are that `decode` makes: whole numbers are sRGB if the file says nothing."""
    if srgb or pixels.dtype.kind == "f":
        return "linear"
    return encoding or encoding_of(pixels)


def encode(
    path: Path,
    pixels: Any,
    *,
    srgb: bool = False,
    half: bool = False,
    attributes: dict[str, Any] | None = None,
) -> bytes:
    """Turn an array into the bytes of the file that `path` names, by the rules of `save_image`."""
    extension, form = find_format(path)
    array = _fit_channels(check_picture(pixels), form, extension)
    array = fit_samples(array, form, extension, srgb, half)
    return oiio.encode(extension, array, {**dict(form.attributes), **(attributes or {})})


def holds_light(path: Path, pixels: Array) -> bool:
    """Say whether a file of this name stores such pixels as floats, which are linear by convention."""
    return _stores_floats(find_format(path)[1], pixels)


def _stores_floats(form: Format, pixels: Array) -> bool:
    return "float32" in form.samples and not ("uint8" in form.samples and pixels.dtype.kind == "u")


def find_format(path: Path) -> tuple[str, Format]:
    """Find what a file of this name can hold."""
    extension = path.suffix.lower()
    if extension not in FORMATS:
        raise ValueError(
            f"expected a file name that ends in {', '.join(FORMATS)}; got {text_of(path.name)}"
        )
    return extension, FORMATS[extension]


def holds_alpha(path: Path) -> bool:
    """Say whether a file of this name can hold alpha."""
    return 4 in find_format(path)[1].channels


def stores(path: Path, dtype: np.dtype[Any]) -> bool:
    """Say whether a file of this name holds numbers of a type as they are."""
    return dtype.name in find_format(path)[1].samples


def is_opaque(pixels: Array) -> bool:
    """Say whether a fourth channel is 1 (255, 65535) throughout."""
    one = np.iinfo(pixels.dtype).max if pixels.dtype.kind == "u" else 1
    return bool((pixels[..., 3] == one).all())


def _fit_channels(pixels: Array, form: Format, extension: str) -> Array:
    channels = pixels.shape[2]
    if channels in form.channels:
        return pixels
    if channels == 1:
        return np.repeat(pixels, 3, axis=2)
    if not is_opaque(pixels):
        raise ValueError(
            f"{extension} files hold no alpha: expected 3 channels or an alpha of 1 throughout, got "
            f"{float(pixels[..., 3].min()):.4g} to {float(pixels[..., 3].max()):.4g}; "
            "save as .png or .exr, give the scene a background, or pass pixels[..., :3] of an array"
        )
    return pixels[..., :3]


def fit_samples(pixels: Array, form: Format, extension: str, srgb: bool, half: bool) -> Array:
    if pixels.dtype.kind in "ui" and pixels.dtype not in (np.uint8, np.uint16):
        return _whole_numbers(pixels, form, extension)
    if _stores_floats(form, pixels):
        return _floats(pixels, form, extension, half)
    if pixels.dtype.kind == "f":
        warn_if_clipped(pixels[..., :3], MAP_OR_DARKEN)
    if srgb:
        pixels = on_color(srgb_encode, np.clip(to_float32(pixels), 0, 1))
    wide = pixels.dtype == np.uint16 and "uint16" in form.samples
    return to_integers(pixels, 65535 if wide else 255)


def _whole_numbers(pixels: Array, form: Format, extension: str) -> Array:
    """Store whole numbers wider than 16 bits, which are ids, exactly, or raise ValueError."""
    stored = next((name for name in ("uint32", "uint16") if name in form.samples), None)
    if stored is None:
        raise ValueError(
            f"{extension} files hold no {pixels.dtype} numbers: save ids as .exr or .png, colours as uint8 or float"
        )
    low, high, top = int(pixels.min()), int(pixels.max()), int(np.iinfo(stored).max)
    if low < 0 or high > top:
        raise ValueError(f"{extension} files hold whole numbers 0 to {top}, got {low} to {high}")
    return pixels.astype(stored)


def _floats(pixels: Array, form: Format, extension: str, half: bool) -> Array:
    if "float16" in form.samples:
        half = half or pixels.dtype in (np.float16, np.uint8)
    values = to_float32(pixels)
    if extension == ".hdr":
        if not np.isfinite(values).all():
            raise ValueError(
                ".hdr files hold finite numbers only, got NaN or infinity; save as .exr"
            )
        # The format ends at 2^127 and has no sign (G. Ward, "Real Pixels", Graphics Gems II, 1991).
        return np.clip(values, 0, np.float32(1.7e38))
    if not half or "float16" not in form.samples:
        return values
    peak = float(np.max(np.abs(values), where=np.isfinite(values), initial=0))
    if peak > 65504:
        raise ValueError(
            f"half=True holds numbers up to 65504, got {peak:.6g}; save with half=False"
        )
    return values.astype(np.float16)
