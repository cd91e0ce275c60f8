"""Source over destination: colour by SRC_ALPHA, ONE_MINUS_SRC_ALPHA, and alpha by ONE, ONE_MINUS_SRC_ALPHA."""

import numpy as np


def over(source, destination):
    """Composite (..., 4) over (..., 4); the colours are not multiplied by alpha."""
    source, destination = np.broadcast_arrays(
        np.asarray(source, float), np.asarray(destination, float)
    )
    alpha = source[..., 3:]
    color = source[..., :3] * alpha + destination[..., :3] * (1 - alpha)
    return np.concatenate([color, alpha + destination[..., 3:] * (1 - alpha)], axis=-1)


def composite(background, *layers):
    """Composite layers, given from far to near, over a background."""
    result = np.asarray(background, float)
    for layer in layers:
        result = over(layer, result)
    return result


BLENDS = ("opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied")


def blend(mode, source, destination):
    """Blend one surface with the destination by the formula of its mode; `source` has straight alpha.

    A premultiplied source is a straight one whose colour was multiplied by its alpha, so it gives the same picture.
    """
    source, destination = np.broadcast_arrays(
        np.asarray(source, float), np.asarray(destination, float)
    )
    s, a, d = source[..., :3], source[..., 3:], destination[..., :3]
    kept = destination[..., 3:]
    color, alpha = {
        "opaque": (s, np.ones_like(a)),
        "alpha": (a * s + (1 - a) * d, a + (1 - a) * kept),
        "alpha_keep": (a * s + (1 - a) * d, kept),
        "additive": (a * s + d, a + kept),
        "multiply": ((1 - a + a * s) * d, kept),
        "premultiplied": (a * s + (1 - a) * d, a + (1 - a) * kept),
    }[mode]
    return np.concatenate([color, alpha], axis=-1)
