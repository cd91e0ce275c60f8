"""What both renderers draw: a sphere of radius 1 around the origin, seen by parallel rays along each of VIEWS."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

DATA = Path(__file__).resolve().parents[2] / "python" / "cubecam" / "data"
TRUTH = Path(__file__).resolve().parents[2] / "out" / "truth"
PHOTOGRAPHS = ("forest", "sunset", "studio")
ROUGHNESSES = (0.2, 0.3, 0.5, 0.7, 1.0)
SIZE = 96  # pixels along an edge; the sphere fills them
#: From where the sphere is seen.
VIEWS: tuple[tuple[float, float, float], ...] = (
    (0.0, 0.0, 1.0),
    (1.0, 0.0, 0.0),
    (-0.6, 0.5, -0.6),
)
FACING = 0.1  # pixels count where n.v is greater everywhere in them


def camera_axes(view: tuple[float, float, float]) -> Array:
    """Rows: right, up, and back, the direction to the eye."""
    back = np.asarray(view, float) / np.linalg.norm(view)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(back, right), back])


def normals(size: int, view: tuple[float, float, float]) -> tuple[Array, npt.NDArray[np.bool_]]:
    """((size, size, 3) unit normals at pixel centres, where the sphere is)."""
    x = (np.arange(size) + 0.5) / size * 2 - 1
    across, down = np.meshgrid(x, x)
    rest = 1 - across**2 - down**2
    local = np.stack([across, -down, np.sqrt(np.maximum(rest, 0))], -1)
    return local @ camera_axes(view), rest > 0


def counted(size: int) -> npt.NDArray[np.bool_]:
    """Pixels whose corners all face the eye by more than FACING."""
    edge = np.abs(np.arange(size + 1) / size * 2 - 1)
    farthest = np.maximum(edge[:-1], edge[1:])
    mask: npt.NDArray[np.bool_] = farthest[:, None] ** 2 + farthest[None, :] ** 2 < 1 - FACING**2
    return mask


def relative_error(got: npt.NDArray[Any], truth: npt.NDArray[Any]) -> float:
    """The rms of the difference over the rms of the truth, over counted pixels of pictures (..., H, W, 3)."""
    mask = counted(truth.shape[-2])
    difference = (got.astype(float) - truth)[..., mask, :]
    return float(np.sqrt(np.mean(difference**2) / np.mean(truth[..., mask, :].astype(float) ** 2)))


def averaged(picture: npt.NDArray[Any], size: int) -> npt.NDArray[Any]:
    """The means over squares of pixels: (k size, k size, C) to (size, size, C)."""
    factor = picture.shape[0] // size
    mean: npt.NDArray[Any] = picture.reshape(size, factor, size, factor, -1).mean((1, 3))
    return mean


def truth_file(folder: Path, photograph: str, roughness: float) -> Path:
    return folder / f"{photograph}-{roughness:g}.npy"
