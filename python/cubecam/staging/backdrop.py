"""Pictures of models for screens: a plain colour behind the model is that colour, and alpha is what files expect."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..io.pixels import srgb_decode, srgb_encode
from ..io.screen import to_screen

if TYPE_CHECKING:
    from ..typing import Tonemap

__all__ = ["over_color", "straight"]

Light = npt.NDArray[np.float32]
Pixels = npt.NDArray[np.uint8]


def straight(light: Light, *, exposure: float, tonemap: Tonemap | None) -> Pixels:
    """Turn linear light (H, W, 4) over a transparent background into 8-bit pixels with straight alpha.

    A renderer leaves light times alpha, and PNG, WebP, GIF and TIFF hold colours that are not yet multiplied by
    alpha. The division comes before the tone curve and the sRGB encoding, which are not linear.
    """
    alpha = light[..., 3:]
    color = np.where(alpha > 0, light[..., :3] / np.maximum(alpha, 1e-6), 0)
    if tonemap is None:
        color = np.minimum(
            color, 2.0**-exposure
        )  # clipping is what was chosen, and needs no warning
    whole = np.concatenate([color, alpha], axis=-1).astype(np.float32)
    return to_screen(whole, exposure=exposure, tonemap=tonemap)


def over_color(
    light: Light, behind: Sequence[float], *, exposure: float, tonemap: Tonemap | None
) -> Pixels:
    """Lay linear light (H, W, 4) over a colour, which neither exposure nor tone curve changes: 8-bit pixels (H, W, 3).

    Parameters
    ----------
    light : ndarray (H, W, 4)
        Drawn over ``behind / 2**exposure`` with an alpha of 0, so that glass shows the colour, too.
    behind : sequence of 3 floats
        The linear colour.
    exposure, tonemap
        As in `to_screen`, for the model alone.
    """
    color = np.asarray(behind, np.float32)[:3]
    left = 1 - light[..., 3:]
    model = light.copy()
    model[..., :3] = np.maximum(light[..., :3] - left * color / np.float32(2**exposure), 0)
    pixels = straight(model, exposure=exposure, tonemap=tonemap)
    alpha = light[..., 3:]
    mixed = alpha * srgb_decode(pixels[..., :3] / np.float32(255)) + left * color
    return np.asarray(np.rint(255 * srgb_encode(np.clip(mixed, 0, 1))), np.uint8)
