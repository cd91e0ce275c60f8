"""`python -m benchmarks.light.truth`: spheres of white metal in photographs, path traced by Mitsuba 3.

One bounce, since a sphere reflects no light on itself; GGX with separable masking and alpha = roughness^2, as glTF 2.0
appendix B.3.1 has it. Each pixel is the mean over its area. Mitsuba's fast variants need a libLLVM; DRJIT_LIBLLVM_PATH
names it.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from . import spheres


def photograph(mi: Any, path: Path) -> Any:
    """As Mitsuba looks it up: +Z in the centre of the picture, where cubecam's panoramas have -Z."""
    file = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    pixels = np.maximum(np.array(file), 0)
    return mi.Bitmap(np.roll(pixels, pixels.shape[1] // 2, axis=1))


def sphere(mi: Any, bitmap: Any, roughness: float, view: tuple[float, float, float]) -> Any:
    to_world = mi.ScalarTransform4f().look_at(
        origin=list(4 * spheres.camera_axes(view)[2]), target=[0, 0, 0], up=[0, 1, 0]
    )
    smooth = {"type": "conductor", "material": "none"}
    rough = {
        "type": "roughconductor",
        "material": "none",
        "distribution": "ggx",
        "alpha": roughness**2,
    }
    film = {
        "type": "hdrfilm",
        "width": spheres.SIZE,
        "height": spheres.SIZE,
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
    }
    return mi.load_dict(
        {
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 2, "hide_emitters": True},
            "sensor": {"type": "orthographic", "to_world": to_world, "film": film},
            "environment": {"type": "envmap", "bitmap": bitmap},
            "sphere": {"type": "sphere", "bsdf": rough if roughness else smooth},
        }
    )


def main() -> None:
    """Write one file for each photograph and roughness: (views, SIZE, SIZE, 3) float32."""
    import mitsuba as mi

    parser = argparse.ArgumentParser(prog="python -m benchmarks.light.truth", description=__doc__)
    parser.add_argument(
        "photographs", nargs="*", help="names of cubecam's photographs, or EXR files"
    )
    parser.add_argument("--roughness", type=float, nargs="*", default=list(spheres.ROUGHNESSES))
    parser.add_argument("--samples", type=int, default=4096, help="paths a pixel")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="scalar_rgb needs no libLLVM")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=spheres.TRUTH, metavar="DIR")
    arguments = parser.parse_args()
    mi.set_variant(arguments.variant)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in arguments.photographs or spheres.PHOTOGRAPHS:
        path = Path(name) if name.endswith(".exr") else spheres.DATA / f"{name}.exr"
        bitmap = photograph(mi, path)
        for roughness in arguments.roughness:
            views = []
            for index, view in enumerate(spheres.VIEWS):
                scene = sphere(mi, bitmap, roughness, view)
                seed = arguments.seed * len(spheres.VIEWS) + index
                views.append(np.array(mi.render(scene, spp=arguments.samples, seed=seed)))
            target = spheres.truth_file(arguments.out, path.stem, roughness)
            np.save(target, np.stack(views).astype(np.float32))
            print(f"wrote {target}", flush=True)


if __name__ == "__main__":
    main()
