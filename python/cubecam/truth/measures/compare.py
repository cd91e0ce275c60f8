"""How far a picture is from the truth: numbers, the worst place, an error map and a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..._calls import checked_call
from ..._checks import one_of
from ..._core import CubeMap, Frame, Image, _to_array
from ...io.pixels import check_colors
from ...io.screen import encoding_of, numbers_of
from . import scores
from .comparison import Comparison

if TYPE_CHECKING:
    from ...typing import Encoding

__all__ = ["Comparison", "compare"]

Array = npt.NDArray[Any]
Mask = npt.NDArray[np.bool_]


@checked_call
def compare(
    picture: CubeMap | Frame | Image | npt.ArrayLike,
    truth: CubeMap | Frame | Image | npt.ArrayLike,
    mask: npt.ArrayLike | None = None,
    *,
    encoding: Encoding | None = None,
    flip: bool = True,
) -> Comparison:
    """Measure how far a picture is from the truth.

    Parameters
    ----------
    picture, truth : CubeMap, Frame, Image or array_like
        Two of one size: (H, W, C), (H, W) or, for cubes, (6, N, N, C), of floats, uint8 or uint16. Frames stand for
        their colour. uint8 stands for value/255 and uint16 for value/65535; nothing is decoded. Of C = 1, 3 or 4
        channels a fourth is alpha, which is left out.
    mask : array_like of bool (H, W) or (6, N, N), optional
        True where a pixel counts. None: all pixels.
    encoding : {"linear", "srgb"}, optional
        What the numbers of plain arrays are, for SSIM and FLIP; objects know it. None: as the other picture says if
        that is an object; else "srgb" if both are whole numbers, "linear" if one is of floats.
    flip : bool, default True
        Whether FLIP is measured, which takes most of the time: about 1.5 s of CPU for 1024 x 1024 pixels, and about as
        much again for each exposure of HDR-FLIP.

    Returns
    -------
    Comparison
        The numbers, the error of each pixel, and ``plot()``.

    Raises
    ------
    ValueError
        For two sizes, a shape that is no picture, two objects of different `encoding`, an `encoding` that an object
        contradicts, two frames of which one has a tone curve, or no pixel that counts.
    TypeError
        For bool, complex, text, ids, and a mask that is not of bool.

    Notes
    -----
    With p the picture, t the truth, and means over the channels of all pixels that count:

    - RMSE is sqrt(mean((p - t)^2)), and the relative RMSE is RMSE / sqrt(mean(t^2)), which does not change with the
      exposure. Where the truth is black there is none.
    - The error of a pixel is the largest abs(p - t) of its channels; `max` is the largest of all.
    - SSIM (Wang, Bovik, Sheikh, Simoncelli 2004) is scikit-image's with their parameters: a Gaussian window of 11 x 11
      with sigma 1.5, K1 = .01, K2 = .03, L = 1, covariances of the population, for each channel, then the mean over the
      channels. Its constants are shares of a screen's range, and light has none; therefore linear pictures get the
      curve "neutral" (not if both are whole numbers, or a frame has a curve already) and the sRGB encoding first, like
      `to_screen`, but are not rounded. Pixels less than 5 from a border have no SSIM. Faces of cubes are separate.
    - FLIP is measured by its authors' package, at 67 pixels per degree: the perceived difference if one flips between
      the pictures, 0 to 1. It is HDR-FLIP if the truth is linear and exceeds 1, else LDR-FLIP, with both pictures
      clipped to 0..1: the truth alone decides, so that all pictures of one truth are measured alike. HDR-FLIP's
      exposures follow from the truth's pixels that count. `flip` is their mean. The package has no wheel for
      Python 3.14, where `flip` is None and `notes` says why.

    Pixels where either picture is NaN or infinite do not count; `not_finite` is their number. SSIM and FLIP look at
    the neighbours of a pixel; where these do not count, both pictures show the truth's numbers, or 0 where those are
    not finite.

    Examples
    --------
    >>> import cubecam as cc, numpy as np
    >>> truth = np.full((16, 16, 3), 0.5, np.float32)
    >>> picture = truth.copy()
    >>> picture[3, 4, 0] = 0.75
    >>> found = cc.truth.compare(picture, truth)
    >>> round(found.rmse, 5), found.max, found.worst
    (0.00902, 0.25, (3, 4))
    """
    one_of(encoding, "encoding", ("linear", "srgb", None))
    p, t = _colors_of(picture, "picture"), _colors_of(truth, "truth")
    if p.shape != t.shape:
        raise ValueError(
            f"expected two pictures of one size and number of colour channels, got {p.shape} and {t.shape}"
        )
    linear, curve = _nature(picture, truth, encoding)
    known = np.isfinite(p).all(axis=-1) & np.isfinite(t).all(axis=-1)
    wanted = _mask_of(mask, known.shape)
    counted = wanted & known
    if not counted.any():
        raise ValueError(
            f"expected a pixel in which both pictures are finite, got none among {int(wanted.sum())}"
        )
    t_all = np.where(np.isfinite(t), t, 0.0)
    p_all = np.where(counted[..., None], p, t_all)
    numbers = _errors(p_all, t_all, counted)
    notes = [] if numbers["relative_rmse"] is not None else ["the truth is black: no relative RMSE"]
    # Faces, or one picture, on the first axis.
    faces = known.shape if known.ndim == 3 else (1, *known.shape)
    stacks = [one.reshape(*faces, -1) for one in (p_all, t_all)]
    shown = [scores.screen_values(one, linear=linear, curve=curve) for one in stacks]
    similarity, why = scores.ssim(shown[0], shown[1], counted.reshape(faces))
    notes += [why] if why else []
    high = linear and curve and float(t[counted].max()) > 1
    kind: scores.Range = "HDR" if high else "LDR"
    flips: Array | None = None
    if flip:
        flips, why = scores.flip(
            stacks[0], stacks[1], counted.reshape(faces), linear=linear, kind=kind
        )
        notes += [why] if why else []
    else:
        notes.append("flip=False")
    if flips is not None:
        flips = np.where(counted, flips.reshape(known.shape), np.float32(np.nan))
    return Comparison(
        **numbers,
        ssim=similarity,
        flip=None if flips is None else float(flips[counted].mean(dtype=float)),
        flip_range=None if flips is None else kind,
        counted=int(counted.sum()),
        total=counted.size,
        not_finite=int((wanted & ~known).sum()),
        notes=tuple(notes),
        flip_map=flips,
        picture=p,
        truth=t,
        encoding="linear" if linear else "srgb",
        curve=curve,
    )


def _colors_of(thing: object, name: str) -> Array:
    """Give the colours (H, W, C) or (6, N, N, C) as float64, without alpha."""
    pixels = numbers_of(thing)[0] if isinstance(thing, (CubeMap, Frame, Image)) else thing
    array = check_colors(pixels, name)
    cube = array.ndim == 4 and array.shape[0] == 6 and array.shape[1] == array.shape[2]
    if not (cube or array.ndim == 3):
        raise ValueError(
            f"{name}: expected (H, W), (H, W, C) or, for cubes, (6, N, N, C), got {array.shape}"
        )
    if array.shape[-1] == 4:
        array = array[..., :3]
    if array.dtype.kind == "u":
        return np.asarray(array / float(np.iinfo(array.dtype).max))
    return array.astype(float)


def _nature(picture: object, truth: object, given: Encoding | None) -> tuple[bool, bool]:
    """Say whether the numbers are linear, and whether a curve may map them."""
    both = (picture, truth)
    objects = [one for one in both if isinstance(one, (CubeMap, Frame, Image))]
    told = {numbers_of(one)[1] for one in objects}
    if len(told) > 1:
        first, second = (numbers_of(one)[1] for one in objects)
        raise ValueError(
            f"expected two pictures of one encoding, got {first} and {second}; load files of 8 bits with srgb=True, "
            "or compare cc.to_screen of both"
        )
    if given is not None and told and told != {given}:
        raise ValueError(f"encoding: expected {told.pop()}, as the picture says, got {given}")
    mapped = [one._tonemapped for one in both if isinstance(one, Frame)]
    if len(set(mapped)) > 1:
        raise ValueError(
            "expected two frames of one look, got one that was rendered with a tone curve and one without"
        )
    arrays = [
        numbers_of(one)[0] if isinstance(one, (CubeMap, Frame, Image)) else check_colors(one)
        for one in both
    ]
    plain = "srgb" if all(encoding_of(one) == "srgb" for one in arrays) else "linear"
    encoding = given or (told.pop() if told else plain)
    floats = any(one.dtype.kind == "f" for one in arrays)
    return encoding == "linear", floats and not any(mapped)


def _mask_of(mask: npt.ArrayLike | None, shape: tuple[int, ...]) -> Mask:
    """Give a mask of the pictures' shape that has at least one pixel."""
    if mask is None:
        return np.ones(shape, bool)
    array = _to_array(mask, "mask")
    if array.dtype != np.bool_:
        raise TypeError(f"mask: expected an array of bool, got dtype {array.dtype}")
    if array.shape != shape:
        raise ValueError(f"mask: expected the pictures' shape {shape}, got {array.shape}")
    if not array.any():
        raise ValueError("mask: expected at least one pixel that counts, got none")
    return np.asarray(array, bool)


def _errors(p: Array, t: Array, counted: Mask) -> dict[str, Any]:
    """Measure what needs each pixel alone."""
    with np.errstate(over="ignore"):  # numbers near 1e308
        apart = np.abs(p - t)
        size = scores.rms(t[counted])
        rmse = scores.rms(apart[counted])
    error = np.where(counted, apart.max(axis=-1), np.nan)
    worst = tuple(int(i) for i in np.unravel_index(np.nanargmax(error), error.shape))
    return {
        "rmse": rmse,
        "relative_rmse": rmse / size if size else None,
        "mean_absolute": float(apart[counted].mean()),
        "max": float(error[worst]),
        "worst": worst,
        "picture_value": tuple(p[worst].tolist()),
        "truth_value": tuple(t[worst].tolist()),
        "error": error,
    }
