"""Tone curves and the sRGB curve."""

import numpy as np


def reinhard(c):
    """Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, equation 3, per channel."""
    return c / (1 + c)


def aces(c):
    """Narkowicz, "ACES Filmic Tone Mapping Curve", 2015."""
    return np.clip(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0, 1)


def neutral(color):
    """Khronos PBR Neutral Tone Mapper (2024), by the steps of its specification."""
    color = np.asarray(color, float)
    start, desaturation = 0.8 - 0.04, 0.15
    low = color.min(-1, keepdims=True)
    offset = np.where(low < 0.08, low - 6.25 * low * low, 0.04)
    color = color - offset
    peak = color.max(-1, keepdims=True)
    d = 1 - start
    new_peak = 1 - d * d / (peak + d - start)
    squeezed = color * new_peak / np.where(peak == 0, 1, peak)
    g = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    return np.where(peak < start, color, squeezed * (1 - g) + new_peak * g)


TONE_CURVES = {"reinhard": reinhard, "aces": aces, "neutral": neutral}


def srgb_encode(c):
    """IEC 61966-2-1, linear to stored."""
    c = np.clip(c, 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def srgb_decode(c):
    """IEC 61966-2-1, stored to linear."""
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
