"""The numbers that a screen shows: exposure, a tone curve and the sRGB encoding, in this order.

Files of 8 bits, pictures in notebooks and the command line all go through `to_screen`, so that the same light looks the
same everywhere.
"""

from __future__ import annotations

import contextlib
import functools
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from .._calls import checked_call
from .._checks import one_of, real_number, text_of, truth
from .._core import CubeMap, Frame, Image
from .._warnings import warn_user
from ..typing import Encode, Encoding, Tonemap
from .pixels import Array, FloatArray, check_colors, on_color, srgb_decode, srgb_encode, to_float32

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy.typing as npt

__all__ = ["ClippingWarning", "to_screen"]

Picture: TypeAlias = Frame | CubeMap | Image

_LARGEST = np.float32(
    1e18
)  # the square of the largest light must be finite, as in shaders/passes/tonemap.frag
_VISIBLE = 1 + 0.5 / 255  # linear numbers above this are visibly clipped

# What helps against clipping, as far as the numbers allow it.
DARKEN = "a lower exposure= makes the picture darker, "
MAP_OR_DARKEN = f'tonemap="neutral" keeps highlights, {DARKEN}'


class ClippingWarning(UserWarning):
    """Numbers above 1 were clipped on their way into an 8-bit picture."""

    __module__ = "cubecam"


@checked_call
def to_screen(
    picture: npt.ArrayLike | Picture,
    *,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    encode: Encode | None = "srgb",
) -> npt.NDArray[np.uint8]:
    """Turn a picture into the 8-bit numbers that a screen shows.

    Parameters
    ----------
    picture : Frame, CubeMap, Image or array_like (..., C) or (H, W)
        The attribute `encoding` of an object says what its numbers are. In a plain array, uint8 and uint16 are
        sRGB-encoded and floats are linear. C is 1, 3 or 4; a fourth channel is alpha. An array of two dimensions is
        grey.
    exposure : float
        Stops: the light is multiplied by ``2**exposure``.
    tonemap : {"neutral", "reinhard", "aces"} or None
        The curve that maps linear floats of any size into 0..1, as in `Renderer.render`: "neutral" is the Khronos PBR
        Neutral Tone Mapper (2024), "reinhard" is equation 3 of Reinhard et al. (2002), and "aces" is Narkowicz's fit
        (2015). None clips. Numbers that are sRGB-encoded or 8-bit hold no highlights and are never mapped, and frames
        that were rendered with a curve are not mapped again.
    encode : {"srgb"} or None
        "srgb" encodes with the transfer function of IEC 61966-2-1, which screens expect; None leaves light linear.

    Returns
    -------
    ndarray uint8
        A new array of the picture's shape. NaN counts as 0; alpha is not changed by exposure, curve and encoding.

    Warns
    -----
    ClippingWarning
        If numbers above 1 are clipped, which happens without a tone curve only.

    Raises
    ------
    TypeError
        For bool, complex, text, or whole numbers of more than 16 bits, such as ids.
    ValueError
        For another shape, an unknown name, an exposure that is not from -64 to 64, or a frame without a colour.

    Examples
    --------
    >>> import cubecam as cc, numpy as np
    >>> cc.to_screen(np.float32([[0.0, 0.2, 0.5], [1.0, 4.0, 100.0]])).tolist()
    [[0, 111, 181], [240, 253, 255]]
    >>> cc.to_screen(np.float32([[0.0, 0.2, 0.5]]), tonemap=None, exposure=1).tolist()
    [[0, 170, 255]]
    >>> cc.to_screen(np.uint8([[7, 77, 177]])).tolist()
    [[7, 77, 177]]
    """
    check_look(exposure, tonemap)
    one_of(encode, "encode", ("srgb", None))
    if isinstance(picture, (Frame, CubeMap, Image)):
        pixels, encoding = numbers_of(picture)
    else:
        pixels = check_colors(picture, "picture")
        encoding = encoding_of(pixels)
    curve = curve_for(picture, pixels, tonemap)
    shown = screen_pixels(pixels, encoding, exposure, curve, encode is not None)
    # A grey array (H, W) is (H, W, 1) here.
    return shown[..., 0] if np.ndim(picture) == 2 else shown


def numbers_of(picture: Picture) -> tuple[Array, Encoding]:
    """Give the numbers of an object and what they are; raise ValueError for a frame without a colour."""
    if isinstance(picture, CubeMap):
        return picture.faces, picture.encoding
    if isinstance(picture, Image):
        return picture.pixels, picture.encoding
    if picture.color is None:
        raise ValueError("expected a frame with a colour, got one of format=None")
    return picture.color, picture.encoding


def encoding_of(pixels: Array) -> Encoding:
    """Give the encoding of a plain array: whole numbers are sRGB, as in files, and floats are linear."""
    return "srgb" if pixels.dtype.kind == "u" else "linear"


def curve_for(picture: object, pixels: Array, tonemap: Tonemap | None) -> Tonemap | None:
    """Give the curve for the pixels of a picture.

    Whole numbers hold no highlights that a curve would keep. A frame that was rendered with a curve has none of them
    either, and a second curve would darken it.
    """
    mapped = isinstance(picture, Frame) and picture._tonemapped
    return tonemap if pixels.dtype.kind == "f" and not mapped else None


def check_look(exposure: float, tonemap: str | None, srgb: bool | None = None) -> None:
    """Raise ValueError or TypeError for an exposure or a curve that `to_screen` does not take, or another `srgb`."""
    if srgb is not None:
        truth(srgb, "srgb")
    if not -64 <= real_number(exposure, "exposure") <= 64:
        raise ValueError(f"exposure: expected -64 to 64 stops, got {text_of(exposure)}")
    one_of(tonemap, "tonemap", (*CURVES, None))


def screen_pixels(
    pixels: Array, encoding: Encoding, exposure: float, curve: Tonemap | None, encode: bool
) -> npt.NDArray[np.uint8]:
    """Do what `to_screen` describes with (..., C) numbers of a known encoding."""
    mappable = encoding == "linear" and pixels.dtype.kind == "f"
    advice = MAP_OR_DARKEN if mappable else DARKEN
    if encoding == "srgb" and encode and exposure == 0:
        if pixels.dtype.kind == "f":
            warn_if_clipped(pixels[..., :3], advice)
        return to_bytes(pixels)

    def shown(color: FloatArray) -> FloatArray:
        light = exposed(srgb_decode(color) if encoding == "srgb" else color, exposure)
        if curve is not None and encoding == "linear":
            light = CURVES[curve](light)
        else:
            warn_if_clipped(light, advice)
        light = np.clip(light, 0, 1)
        return srgb_encode(light) if encode else light

    return to_bytes(on_color(shown, to_float32(pixels)))


def exposed(color: FloatArray, exposure: float) -> FloatArray:
    """Multiply light by 2**exposure, in the range that the curves take: NaN and numbers below 0 become 0."""
    gain = np.float32(2.0**exposure)
    with np.errstate(over="ignore"):  # what overflows is infinite, and then the largest light
        light = np.nan_to_num(color, nan=0.0, posinf=float(_LARGEST), neginf=0.0) * gain
    return np.asarray(np.clip(light, 0, _LARGEST), dtype=np.float32)


def to_light(pixels: Array, encoding: Encoding, exposure: float) -> Array:
    """Turn (..., C) numbers into linear floats; linear numbers that need no exposure stay as they are."""
    if encoding == "linear" and exposure == 0:
        return pixels

    def light(color: FloatArray) -> FloatArray:
        linear = srgb_decode(color) if encoding == "srgb" else color
        with np.errstate(over="ignore"):  # what overflows is infinite, which EXR holds
            return np.asarray(linear * np.float32(2.0**exposure), dtype=np.float32)

    values = on_color(light, to_float32(pixels))
    return values.astype(np.float16) if pixels.dtype.itemsize < 4 and _fits_half(values) else values


def _fits_half(values: FloatArray) -> bool:
    return bool(np.max(np.abs(values), where=np.isfinite(values), initial=0) <= 65504)


def to_bytes(pixels: Array) -> npt.NDArray[np.uint8]:
    """Round numbers 0..1 to 0..255, in a new array; NaN becomes 0."""
    if pixels.dtype == np.uint8:
        return np.array(pixels, dtype=np.uint8)
    values = np.nan_to_num(to_float32(pixels), nan=0, posinf=1, neginf=0)
    scaled = np.clip(values, 0, 1) * np.float32(255) + np.float32(0.5)
    return np.asarray(scaled).astype(np.uint8)


@dataclass
class Clipping:
    """How many numbers of one or more pictures were visibly above 1, for one warning."""

    over: int = 0
    total: int = 0
    largest: float = 0.0
    advice: str = ""

    @contextlib.contextmanager
    def gathered(self) -> Iterator[None]:
        """Count here what is clipped in the block, in place of a warning for each array."""
        token = _gathering.set(self)
        try:
            yield
        finally:
            _gathering.reset(token)

    def warn(self) -> None:
        """Warn, at the user's line, if anything was clipped."""
        if not self.over:
            return
        warn_user(
            f"{self.over} of {self.total} numbers are above 1 and are clipped, the largest is {self.largest:.4g}; "
            f"{self.advice}.exr holds all numbers",
            ClippingWarning,
        )


_gathering: ContextVar[Clipping | None] = ContextVar("_gathering", default=None)


def warn_if_clipped(color: Array, advice: str) -> None:
    """Warn, at the user's line, if numbers are visibly above 1; `color` has no alpha."""
    gathering = _gathering.get()
    clipping = Clipping() if gathering is None else gathering
    over = int(np.count_nonzero(color > _VISIBLE))
    clipping.over += over
    clipping.total += color.size
    if over:
        clipping.largest = max(clipping.largest, float(np.nanmax(color)))
        clipping.advice = advice
    if gathering is None:
        clipping.warn()


def _neutral(linear: FloatArray) -> FloatArray:
    """Compress highlights into 0..1 and keep darker colours as they are.

    Khronos PBR Neutral Tone Mapper (specification of 2024), whose names the variables keep.
    """
    f90, start = np.float32(0.04), np.float32(0.8 - 0.04)
    desaturation = np.float32(0.15)
    # numpy reduces a short last axis slowly, so channels are compared one after the other.
    low = functools.reduce(np.minimum, np.split(linear, linear.shape[-1], axis=-1))
    offset = np.where(low < 2 * f90, low - low * low / (4 * f90), f90)
    color = linear - offset
    peak = functools.reduce(np.maximum, np.split(color, color.shape[-1], axis=-1))
    d = 1 - start
    # Below the start nothing changes; the maximum keeps the unused branch from dividing by zero.
    new_peak = np.where(peak < start, peak, 1 - d * d / np.maximum(peak + d - start, d))
    scaled = color * (new_peak / np.maximum(peak, np.float32(1e-9)))
    white = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    return np.asarray(scaled + (new_peak - scaled) * white, dtype=np.float32)


def _reinhard(linear: FloatArray) -> FloatArray:
    """E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, equation 3, per channel."""
    return np.asarray(linear / (1 + linear), dtype=np.float32)


def _aces(linear: FloatArray) -> FloatArray:
    """K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: a fit of the reference curve."""
    a, b, c, d, e = (np.float32(x) for x in (2.51, 0.03, 2.43, 0.59, 0.14))
    mapped = linear * (a * linear + b) / (linear * (c * linear + d) + e)
    # The fit ends at 1.03, which is no highlight that is lost.
    return np.asarray(np.minimum(mapped, 1), dtype=np.float32)


CURVES: dict[str, Callable[[FloatArray], FloatArray]] = {
    "neutral": _neutral,
    "reinhard": _reinhard,
    "aces": _aces,
}
