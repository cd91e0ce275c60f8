"""Source over destination, with alpha ONE, ONE_MINUS_SRC_ALPHA apart from colour SRC_ALPHA, ONE_MINUS_SRC_ALPHA."""

import numpy as np


def over(source, destination):
    """(..., 4) over (..., 4), colours not multiplied by alpha."""
    source, destination = np.broadcast_arrays(
        np.asarray(source, float), np.asarray(destination, float)
    )
    alpha = source[..., 3:]
    color = source[..., :3] * alpha + destination[..., :3] * (1 - alpha)
    return np.concatenate([color, alpha + destination[..., 3:] * (1 - alpha)], axis=-1)


def composite(background, *layers):
    """Layers from far to near over a background."""
    result = np.asarray(background, float)
    for layer in layers:
        result = over(layer, result)
    return result
