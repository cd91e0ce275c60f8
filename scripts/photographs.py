"""Write the sample photographs: each EXR of a folder, without negative numbers, as half floats in python/cubecam/data.

    python scripts/photographs.py FOLDER     prints size and error of each file, as CREDITS.md states them

DWAB is lossy, but at these levels it changes no pixel of the tone-mapped picture by more than one of 255 steps. The
compression leaves a few numbers just below 0, so those are raised before it until none is left after it.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.io import oiio

DATA = Path(__file__).resolve().parent.parent / "python" / "cubecam" / "data"
#: A fixed date, so that the same pictures give the same bytes.
ATTRIBUTES = {"DateTime": "2000:01:01 00:00:00"}
#: DWAB's level of loss. The leaves of the forest would take twice the room of any other photograph at 5.
LEVEL, LEVELS = 5, {"forest.exr": 10}

Pixels = npt.NDArray[np.float32]


def load(path: Path) -> Pixels:
    return cc.load_image(path).astype(np.float32)


def write(path: Path, wanted: Pixels) -> Pixels:
    """Write the file and return its pixels as decoded, all of them 0 or more."""
    raised = wanted.copy()
    attributes = {**ATTRIBUTES, "compression": f"dwab:{LEVELS.get(path.name, LEVEL)}"}
    for _ in range(100):
        half: npt.NDArray[Any] = raised.astype(np.float16)
        path.write_bytes(oiio.encode(".exr", half, attributes))
        decoded = load(path)
        if decoded.min() >= 0:
            return decoded
        raised += np.maximum(-2 * decoded, 0) + np.where(decoded < 0, np.float32(1e-6), 0)
    raise SystemExit(f"{path.name}: expected numbers of 0 or more, got {decoded.min()}")


def main() -> int:
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    for source in sorted(Path(sys.argv[1]).glob("*.exr")):
        wanted = np.maximum(load(source), 0)
        target = DATA / source.name
        decoded = write(target, wanted)
        relative = np.sqrt(np.mean((decoded - wanted) ** 2) / np.mean(wanted**2))
        steps = np.abs(cc.to_screen(decoded).astype(int) - cc.to_screen(wanted)).max()
        kilobytes = target.stat().st_size / 1000
        print(
            f"| {source.name} | {kilobytes:.0f} | {decoded.max():,.7g} | {relative:.0e} | {steps} |"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
