"""`python -m benchmarks.scenes`: 16 materials in three.js, Filament and cubecam, compared after x / (1 + x).

Each renderer gets the same GLB file and the same panorama, and draws the file's camera and lights. A renderer that is
not installed is left out, and its picture of an earlier run is compared: so each may have a Python of its own.
three.js is npm's package `three` (--three), drawn in Chromium by playwright; Filament is PyPI's package `filly`.
"""

from __future__ import annotations

import argparse
import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from .compare import difference, lit, screen, share, tiles
from .file import EDGE, NAMES, make_glb

Array = npt.NDArray[Any]

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "python" / "cubecam" / "data"
OUT = ROOT / "out" / "scenes"
THREE = ROOT / "out" / "npm" / "node_modules" / "three"
SIZE = (640, 640)
RENDERERS = ("three", "filament", "cubecam")
MARK = 0.90


def installed(*names: str) -> bool:
    return all(importlib.util.find_spec(name) for name in names)


def panorama(photograph: str, folder: Path) -> Array | None:
    """(H, W, 3) float32, -Z in the middle; kept as .npy for a Python that reads no EXR."""
    kept = folder / f"{photograph}.npy"
    if installed("cubecam", "OpenImageIO"):
        import cubecam as cc

        pixels = np.maximum(cc.load_image(DATA / f"{photograph}.exr").astype(np.float32), 0)
        np.save(kept, pixels)
    return np.load(kept) if kept.exists() else None


def draw(path: Path, light: Array, folder: Path, package: Path, only: list[str]) -> None:
    """Write NAME.npy of each renderer that is installed."""
    if "three" in only and installed("playwright") and package.is_dir():
        from .three_js import three_js

        with three_js(package) as three:
            np.save(folder / "three.npy", three.draw(path, light, SIZE))
            print(f"three.js r{three.revision}", *three.problems, sep="\n  ")
    if "filament" in only and installed("filly"):
        from . import filament

        np.save(folder / "filament.npy", filament.draw(path, light, SIZE))
    if "cubecam" in only and installed("cubecam", "OpenImageIO"):
        from . import with_cubecam

        np.save(folder / "cubecam.npy", with_cubecam.draw(path, light, SIZE)[0])


def rows(pictures: dict[str, Array]) -> tuple[list[str], list[list[str]]]:
    """(names of the columns, rows) of the table: each tile, then all of them."""
    pairs = [(a, b) for i, a in enumerate(pictures) for b in list(pictures)[i + 1 :]]
    shown = lit(list(pictures.values()))
    different = {pair: difference(pictures[pair[0]], pictures[pair[1]]) for pair in pairs}
    made = []
    for name, mask in zip(NAMES, tiles(shown, EDGE), strict=True):
        made.append([name, *(f"{share(different[pair], mask):.1%}" for pair in pairs)])
    made.append(["all", *(f"{share(different[pair], shown):.1%}" for pair in pairs)])
    return [" / ".join(pair) for pair in pairs], made


def save_picture(pictures: dict[str, Array], file: Path) -> None:
    """All of them side by side, and how the first ones differ from the last one, eightfold, below."""
    above = [screen(picture) ** (1 / 2.2) for picture in pictures.values()]
    last = screen(list(pictures.values())[-1])
    below = [np.clip(8 * np.abs(screen(picture) - last), 0, 1) for picture in pictures.values()]
    whole = np.concatenate([np.concatenate(above, 1), np.concatenate(below, 1)], 0)
    Image.fromarray(np.round(255 * whole).astype(np.uint8)).save(file)


def main() -> None:
    """Print a row for each tile."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.scenes", description=__doc__)
    parser.add_argument("photograph", nargs="?", default="sunset")
    parser.add_argument("--three", type=Path, default=THREE, metavar="DIR", help="npm's package")
    parser.add_argument("--only", choices=RENDERERS, action="append", help="draw these alone")
    parser.add_argument("--out", type=Path, default=OUT, metavar="DIR")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    path = arguments.out / "tiles.glb"
    path.write_bytes(make_glb())
    light = panorama(arguments.photograph, arguments.out)
    if light is None:
        parser.error("expected cubecam and OpenImageIO, or a panorama of an earlier run in --out")
    folder = arguments.out / arguments.photograph
    folder.mkdir(exist_ok=True)
    draw(path, light, folder, arguments.three, arguments.only or list(RENDERERS))
    files = {name: folder / f"{name}.npy" for name in RENDERERS}
    pictures = {name: np.load(file) for name, file in files.items() if file.exists()}
    columns, lines = rows(pictures)
    width = max(map(len, columns), default=0)
    for line in [["", *columns], *lines]:
        print(f"{line[0]:20}", *(f"{cell:>{width}}" for cell in line[1:]))
    print(f"mark: {MARK:.0%} of all, each with each")
    save_picture(pictures, folder / "pictures.png")


if __name__ == "__main__":
    main()
