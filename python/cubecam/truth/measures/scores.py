"""Numbers for how far two pictures are apart: root mean squares, SSIM and FLIP."""

from __future__ import annotations

import math
import sys
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ...io.pixels import LUMINANCE, srgb_encode
from ...io.screen import CURVES, exposed

Array = npt.NDArray[Any]
Mask = npt.NDArray[np.bool_]
Range = Literal["LDR", "HDR"]

#: Pixels that SSIM's window reaches to each side: 11 x 11, Wang et al. 2004, section III-B.
SSIM_REACH = 5
#: Light for FLIP is clipped here: its numbers are float32, and exposures multiply and square them.
_BRIGHTEST = 1e6
#: Most stops between the exposures of HDR-FLIP; each stop costs the time of one LDR-FLIP.
_MOST_STOPS = 24.0


def rms(values: Array) -> float:
    """Give the root of the mean square; dividing by the largest first keeps squares finite."""
    largest = float(np.abs(values).max())
    if largest == 0:
        return 0.0
    return largest * math.sqrt(float(np.mean((values / largest) ** 2)))


def screen_values(colors: Array, *, linear: bool, curve: bool) -> Array:
    """Turn float64 colours (..., C) into what a screen shows, 0 to 1 and not rounded."""
    if not linear:
        return np.clip(colors, 0.0, 1.0)
    light = exposed(np.clip(colors, 0.0, 1e18), 0.0)
    if curve:
        light = CURVES["neutral"](light)
    encoded = srgb_encode(np.clip(light, 0, 1))
    return np.asarray(encoded, float)


def ssim(picture: Array, truth: Array, counted: Mask) -> tuple[float | None, str]:
    """Give the mean SSIM of screen values (F, H, W, C) over pixels, or None and the reason.

    Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE
    Transactions on Image Processing 13, 2004, equation 13: Gaussian window of 11 x 11 with sigma 1.5, K1 = .01,
    K2 = .03, L = 1, covariances of the population. Pixels whose window leaves the picture have none.
    """
    try:
        from skimage.metrics import structural_similarity
    except ImportError:
        return None, "ssim needs scikit-image, which is not installed: pip install cubecam[truth]"
    height, width = truth.shape[1:3]
    if min(height, width) <= 2 * SSIM_REACH:
        return None, f"ssim needs 11 x 11 pixels, got {height} x {width}"
    inside = (slice(None), slice(SSIM_REACH, -SSIM_REACH), slice(SSIM_REACH, -SSIM_REACH))
    chosen = counted[inside]
    if not chosen.any():
        return None, "ssim has no pixel that counts 5 or more pixels from the borders"
    maps = [
        structural_similarity(
            one, other, data_range=1.0, channel_axis=-1, gaussian_weights=True, sigma=1.5,
            use_sample_covariance=False, K1=0.01, K2=0.03, full=True,
        )[1]
        for one, other in zip(truth, picture, strict=True)
    ]  # fmt: skip
    return float(np.stack(maps)[inside][chosen].mean()), ""


def flip(
    picture: Array, truth: Array, counted: Mask, *, linear: bool, kind: Range
) -> tuple[Array | None, str]:
    """Give FLIP (F, H, W) of colours (F, H, W, C) by its authors' package, or None and the reason.

    LDR: Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020. HDR: Andersson et al.,
    "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021, with ACES. 67 pixels per degree.
    """
    try:
        from flip_evaluator import evaluate
    except ImportError:
        if sys.version_info >= (3, 14):
            return None, "flip needs flip-evaluator, which has no wheel for Python 3.14"
        return None, "flip needs flip-evaluator, which is not installed: pip install cubecam[truth]"
    options: dict[str, Any] = {}
    if kind == "HDR":
        start, stop = exposures(truth[counted])
        options = {
            "startExposure": start,
            "stopExposure": stop,
            "numExposures": max(2, math.ceil(stop - start)),
        }
    highest = _BRIGHTEST if kind == "HDR" else 1.0
    maps = [
        evaluate(
            _three_channels(one, highest), _three_channels(other, highest), kind,
            inputsRGB=not linear, applyMagma=False, computeMeanError=False, parameters=dict(options),
        )[0][..., 0]
        for one, other in zip(truth, picture, strict=True)
    ]  # fmt: skip
    return np.stack(maps).astype(np.float32), ""


def exposures(light: Array) -> tuple[float, float]:
    """Give the lowest and the highest exposure of HDR-FLIP, in stops, for light (..., C) that is not all black.

    Andersson et al. 2021, section 3: ACES takes the largest luminance, then the median, to .85. If more than half is
    black, the median is that of the rest. They are given here, not left to flip_evaluator, since it ends the
    interpreter where it finds none, and six faces of a cube must share them.
    """
    shown = np.clip(light, 0, _BRIGHTEST)
    weights = np.array(LUMINANCE) if shown.shape[-1] == 3 else np.ones(1)
    luminance = np.sort((shown @ weights).ravel())
    if not luminance[luminance.size // 2] > 0:
        luminance = luminance[luminance > 0]
    # Narkowicz's fit of ACES, with the exposure 0.6 in front, solved for .85.
    a = 0.36 * (2.51 - 0.85 * 2.43)
    b = 0.6 * (0.03 - 0.85 * 0.59)
    c = -0.85 * 0.14
    x = (-b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
    start = math.log2(x / luminance[-1])
    return start, min(math.log2(x / luminance[luminance.size // 2]), start + _MOST_STOPS)


def _three_channels(colors: Array, highest: float) -> npt.NDArray[np.float32]:
    """Give float32 (H, W, 3) in one block, which flip_evaluator reads."""
    shown = np.clip(colors, 0.0, highest).astype(np.float32)
    if shown.shape[-1] == 1:
        shown = np.repeat(shown, 3, axis=-1)
    return np.ascontiguousarray(shown)
