"""A comparison of two pictures that should show the same."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Two rasterisers of one scene may round a colour or a vertex differently. That gives a difference
# of one step of 255 each for shading, reflected face and frame. Where a pixel's neighbourhood spans
# more than EDGE, such rounding can move a silhouette by a pixel; those pixels are counted, not
# compared.
STEPS = 3
EDGE = 16
EDGE_SHARE = 0.08
OUTLIERS = 1e-4


@dataclass(frozen=True)
class Difference:
    """How much a picture differs from another, in steps of 255, away from silhouettes."""

    largest: int
    mean: float
    outliers: float
    silhouettes: float

    @property
    def same(self) -> bool:
        return self.outliers <= OUTLIERS and self.silhouettes <= EDGE_SHARE

    def __str__(self) -> str:
        return (
            f"largest {self.largest}, mean {self.mean:.4f} of 255, {self.outliers:.2%} of the pixels"
            f" over {STEPS} ({self.silhouettes:.1%} are silhouettes)"
        )


def _edges(picture: np.ndarray) -> np.ndarray:
    """(H, W) bool: True where a pixel's 3 x 3 neighbourhood spans more than EDGE in some channel."""
    high = low = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    for axis in (0, 1):
        count = high.shape[axis] - 2
        parts = [np.arange(start, start + count) for start in range(3)]
        high = np.maximum.reduce([high.take(part, axis) for part in parts])
        low = np.minimum.reduce([low.take(part, axis) for part in parts])
    edges: np.ndarray = ((high - low) > EDGE).any(axis=-1)
    return edges


def difference(picture: np.ndarray, reference: np.ndarray) -> Difference:
    """Compare two (H, W, 3) uint8 pictures."""
    if picture.shape != reference.shape:
        raise ValueError(f"expected a picture of shape {reference.shape}, got {picture.shape}")
    a, b = picture.astype(np.int16), reference.astype(np.int16)
    edges = _edges(a) | _edges(b)
    off = np.abs(a - b).max(axis=-1)[~edges]
    return Difference(
        int(off.max(initial=0)),
        float(off.mean()),
        float((off > STEPS).mean()),
        float(edges.mean()),
    )
