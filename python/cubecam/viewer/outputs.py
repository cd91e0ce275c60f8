"""Pictures of what is not a colour: distances, normals, ids, and what a probe sees."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..pictures import cube_picture

if TYPE_CHECKING:
    import numpy.typing as npt

    from .._core import Frame, Probe, Renderer, Scene
    from ..typing import Tonemap

__all__ = ["OUTPUTS", "output_picture", "probe_picture"]

OUTPUTS = ("color", "distance", "normal", "id")


def output_picture(frame: Frame, output: str) -> npt.NDArray[np.uint8]:
    """Turn an output of a frame into uint8 (height, width, 4); the background is black."""
    values = frame.outputs[output]
    picture = np.zeros((*values.shape[:2], 4), np.uint8)
    picture[..., 3] = 255
    if output == "distance":
        seen = np.isfinite(values) & (values > 0)
        if seen.any():
            near, far = float(values[seen].min()), float(values[seen].max())
            share = (far - values[seen]) / (far - near) if far > near else np.ones(1)
            picture[seen, :3] = np.round(40 + 215 * share)[:, None]
    elif output == "normal":
        seen = (values != 0).any(axis=-1)
        picture[seen, :3] = np.round((values[seen] + 1) * 127.5)
    else:
        seen = values != 0
        # The golden ratio spreads the hues of neighbouring numbers (Knuth's multiplicative hash).
        hues = (values[seen].astype(np.float64) * 0.618033988749895) % 1.0
        picture[seen, :3] = _bright(hues)
    return picture


def probe_picture(
    renderer: Renderer,
    scene: Scene,
    probe: Probe,
    size: tuple[int, int],
    exposure: float,
    tonemap: Tonemap | None,
) -> npt.NDArray[np.uint8]:
    """Draw the cubemap that a probe sees as a cross in the middle of a picture (width, height), seen from inside."""
    renderer.update_probes(scene)
    cross = cube_picture(renderer.read_probe(probe), exposure=exposure, tonemap=tonemap)
    width, height = size
    scale = min(width / cross.shape[1], height / cross.shape[0])
    wide, high = max(1, int(cross.shape[1] * scale)), max(1, int(cross.shape[0] * scale))
    rows = np.arange(high) * cross.shape[0] // high
    columns = np.arange(wide) * cross.shape[1] // wide
    picture = np.zeros((height, width, 4), np.uint8)
    top, left = (height - high) // 2, (width - wide) // 2
    picture[top : top + high, left : left + wide] = cross[rows[:, None], columns]
    return picture


def _bright(hues: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Give colours (..., 3) from 0 to 255 of hues from 0 to 1, at HSV saturation 0.7 and value 1."""
    wheel = np.abs((hues[..., None] * 6.0 + np.array([0.0, 4.0, 2.0])) % 6.0 - 3.0) - 1.0
    colors: npt.NDArray[np.float64] = np.round(255 * (1 - 0.7 * (1 - np.clip(wheel, 0.0, 1.0))))
    return colors
