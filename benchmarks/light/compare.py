"""`python -m benchmarks.light.compare`: how far cubecam's metal is off Mitsuba's, as rms error over rms of the truth.

Both tiers of StandardMaterial, single scattering, in light from the photograph alone. A picture is drawn with 4 x 4
pixels for each of the truth's, and averaged, since the truth is a mean over each pixel. The first figure is over all
views, those in brackets are of each view.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Literal

import numpy as np
from rich.console import Console
from rich.table import Table

import cubecam as cc

from . import spheres

FINER = 4
#: (photograph, roughness): the marks of "levels", and of "sampled" with 64 samples.
LEVELS = {
    **{
        ("forest", r): m
        for r, m in zip(spheres.ROUGHNESSES, (0.15, 0.18, 0.13, 0.10, 0.06), strict=True)
    },
    ("sunset", 1.0): 0.05,
    ("studio", 1.0): 0.16,
}
SAMPLED = {("forest", r): 0.05 for r in (0.2, 0.3, 0.5)}
TIERS: tuple[tuple[Literal["levels", "sampled"], dict[tuple[str, float], float]], ...] = (
    ("levels", LEVELS),
    ("sampled", SAMPLED),
)


def draw(renderer: cc.Renderer, cube: cc.CubeMap, material: cc.StandardMaterial) -> spheres.Array:
    """(views, SIZE, SIZE, 3) means over pixels."""
    scene = cc.Scene(environment=cube, background=(0, 0, 0))
    scene.add(cc.Mesh.icosphere(1, subdivisions=6), material)
    pictures = []
    for view in spheres.VIEWS:
        camera = cc.OrthographicCamera(
            height=2, position=4 * spheres.camera_axes(view)[2], target=(0, 0, 0)
        )
        edge = FINER * spheres.SIZE
        color = renderer.render(scene, camera, size=(edge, edge), format="rgba32f").color
        pictures.append(spheres.averaged(color[..., :3].astype(float), spheres.SIZE))
    return np.stack(pictures)


def figure(got: spheres.Array, truth: spheres.Array, mark: float | None) -> str:
    """The error over all views [of each view], and the mark."""
    each = " ".join(f"{spheres.relative_error(*pair):.3f}" for pair in zip(got, truth, strict=True))
    text = f"{spheres.relative_error(got, truth):.3f} \\[{each}]"
    return text if mark is None else f"{text} mark {mark:g}"


def main() -> None:
    """Print a row for each photograph and roughness of which there is a truth."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.light.compare", description=__doc__)
    parser.add_argument("photographs", nargs="*", default=spheres.PHOTOGRAPHS)
    parser.add_argument("--truth", type=Path, default=spheres.TRUTH, metavar="DIR")
    parser.add_argument("--samples", type=int, default=64, help="of the tier that samples")
    parser.add_argument("--size", type=int, default=256, help="texels along an edge of the cube")
    arguments = parser.parse_args()
    table = Table("photograph", "roughness", "levels", f"sampled, {arguments.samples}")
    with cc.Renderer() as renderer:
        for name in arguments.photographs:
            path = Path(name) if name.endswith(".exr") else spheres.DATA / f"{name}.exr"
            pixels = np.maximum(cc.load_image(path).astype(np.float32), 0)
            cube = cc.CubeMap.from_equirect(pixels, size=arguments.size)
            for roughness in spheres.ROUGHNESSES:
                file = spheres.truth_file(arguments.truth, path.stem, roughness)
                if not file.exists():
                    continue
                truth = np.load(file).astype(float)
                row = []
                for specular, marks in TIERS:
                    material = cc.StandardMaterial(
                        color=(1, 1, 1),
                        roughness=roughness,
                        specular=specular,
                        specular_samples=arguments.samples,
                        multiple_scattering=False,
                    )
                    got = draw(renderer, cube, material)
                    row.append(figure(got, truth, marks.get((path.stem, roughness))))
                table.add_row(path.stem, f"{roughness:g}", *row)
    console = Console()
    console.width = max(console.width, 120)
    console.print(table)


if __name__ == "__main__":
    main()
