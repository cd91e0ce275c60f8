"""The nine numbers of a cubemap's diffuse light, for each channel, as JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .._core import CubeMap

#: The rows: l, m and the function of a direction, with its factor.
BASIS = (
    "0.282095", "0.488603 y", "0.488603 z", "0.488603 x", "1.092548 x y", "1.092548 y z",
    "0.315392 (3 z z - 1)", "1.092548 x z", "0.546274 (x x - y y)",
)  # fmt: skip
#: Factors that make irradiance over pi of radiance (Ramamoorthi and Hanrahan 2001), by row.
_COSINE = (1.0, *[2 / 3] * 3, *[1 / 4] * 5)


def encode_sh(cube: CubeMap) -> bytes:
    """Make the bytes of a file: `radiance`, rows of `CubeMap.sh`, and `irradiance_over_pi`, each 9 rows of channels."""
    rows = cube.sh()
    told = {
        "basis": BASIS,
        "radiance": [[float(value) for value in row] for row in rows],
        "irradiance_over_pi": [
            [float(value) * factor for value in row]
            for row, factor in zip(rows, _COSINE, strict=True)
        ],
    }
    return (json.dumps(told, indent=1) + "\n").encode()
