"""`python -m benchmarks.scenes.foreign FOLDER`: files that other people made, in three.js, Filament and cubecam.

FOLDER holds the packages of SOURCES, unpacked under "NAME-VERSION" (`npm pack`, `tar`; `pip download`, `unzip`); a
file that is missing is left out. The camera is fitted to what cubecam finds in the file, the light is a panorama alone;
animated files are drawn at several times. Like `python -m benchmarks.scenes`, it compares pictures of earlier runs.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from .__main__ import OUT, RENDERERS, THREE, installed, panorama
from .compare import difference, lit, screen, share

Array = npt.NDArray[Any]

SIZE = (384, 384)
FOV = 30.0
#: From where a file is seen.
FROM = np.array([0.5, 0.35, 1.0])


@dataclass(frozen=True)
class Source:
    """A file of a package, times in seconds, and what it is here for."""

    path: str
    why: str
    times: tuple[float, ...] = ()
    animation: int = 0

    @property
    def name(self) -> str:
        return "-".join(Path(self.path).with_suffix("").parts[-2:])


WEBXR = "webxr-input-profiles-assets-1.0.20/package/dist/profiles"
THREEBOX = "threebox-plugin-2.2.7/package/examples/models"
GENESIS = "genesis_world-1.4.5/genesis/assets"
MANI = "mani_skill-3.0.1/mani_skill"
AFRAME = "networked-aframe-0.14.3/package/examples/assets"

SOURCES = (
    # npm threebox-plugin 2.2.7
    Source(f"{THREEBOX}/Soldier.glb", "skins, 4 animations, 68 nodes", (0.0, 0.4, 0.8), 1),
    Source(f"{THREEBOX}/windmill_a/windmill_a.gltf", ".gltf, animated nodes", (0.0, 1.0, 2.0)),
    Source(f"{THREEBOX}/vehicles/truck.glb", "a texture"),
    # npm networked-aframe 0.14.3
    Source(f"{AFRAME}/rightHandHigh.glb", "a skin, 7 animations", (0.0, 0.5), 1),
    # npm @webxr-input-profiles/assets 1.0.20
    Source(f"{WEBXR}/generic-hand/left.glb", "a skin"),
    Source(f"{WEBXR}/samsung-galaxyxr/left.glb", "blended parts, 4 textures"),
    Source(f"{WEBXR}/magicleap-two/none.glb", "transmission, ior, blended parts"),
    Source(f"{WEBXR}/microsoft-mixed-reality/left.glb", "65 nodes, 4 textures"),
    # PyPI mani_skill 3.0.1
    Source(f"{MANI}/utils/scene_builder/table/assets/table.glb", "specular, ior, 3 textures"),
    Source(
        f"{MANI}/utils/scene_builder/table/assets/Dining_Table_204_1.glb",
        "texture transforms, 35 nodes",
    ),
    Source(f"{MANI}/assets/deformable_manipulation/beaker.glb", "transmission"),
    Source(f"{MANI}/assets/maniskill2-scene-2.glb", "a room of 4.6 MB"),
    # PyPI genesis-world 1.4.5
    Source(f"{GENESIS}/meshes/trashbag_rope.glb", "blended parts"),
    Source(f"{GENESIS}/tower/ball_coll.glb", "66 nodes, no material"),
    # PyPI filly 0.2.1
    Source("suzanne.glb", "no texture"),
    # Soldier.glb again, encoded by npm gltfpack 1.3.0 (-cc), ktx2-encoder 0.6.0 (with @gltf-transform), gltf-pipeline
    # 4.3.1 (-d) and @gltf-transform/cli 4.5.1 (webp)
    Source("made/Soldier-meshopt.glb", "meshopt, quantized", (0.4,), 1),
    Source("made/Soldier-ktx2.glb", "KTX2 of ETC1S", (0.4,), 1),
    Source("made/Soldier-uastc.glb", "KTX2 of UASTC", (0.4,), 1),
    Source("made/Soldier-draco.glb", "Draco", (0.4,), 1),
    Source("made/Soldier-webp.glb", "WebP", (0.4,), 1),
)


def fitted(path: Path) -> dict[str, Any]:
    """A camera that sees the nodes of a file."""
    import cubecam as cc

    scene = cc.load_scene(path)
    boxes = [node.world_bounds for node in scene.nodes if node.mesh is not None]
    lower = np.min([box[0] for box in boxes], axis=0)
    upper = np.max([box[1] for box in boxes], axis=0)
    radius = float(np.linalg.norm(upper - lower) / 2)
    middle = (lower + upper) / 2
    distance = radius / np.sin(np.radians(FOV / 2))
    eye = middle + distance * FROM / np.linalg.norm(FROM)
    return {
        "fov": FOV,
        "position": eye.tolist(),
        "target": middle.tolist(),
        "near": distance / 50,
        "far": distance * 4,
    }


def shots(sources: list[Source], folder: Path, out: Path) -> list[tuple[str, Path, dict[str, Any]]]:
    """(name, file, arguments of a renderer's `draw`); cameras are kept in a file for the other renderers."""
    file = out / "cameras.json"
    cameras: dict[str, Any] = json.loads(file.read_text()) if file.exists() else {}
    if installed("cubecam", "OpenImageIO"):
        for source in sources:
            if (folder / source.path).exists() and source.name not in cameras:
                cameras[source.name] = fitted(folder / source.path)
        file.write_text(json.dumps(cameras, indent=1))
    made = []
    for source in sources:
        if source.name in cameras:
            for time in source.times or (None,):
                name = source.name if time is None else f"{source.name}-{time:g}s"
                options = {"camera": cameras[source.name], "time": time}
                options["animation"] = source.animation
                made.append((name, folder / source.path, options))
    return made


def main() -> None:
    """Print how alike the pictures are, and write NAME.png of each shot."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.scenes.foreign", description=__doc__
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--photograph", default="sunset")
    parser.add_argument("--three", type=Path, default=THREE, metavar="DIR", help="npm's package")
    parser.add_argument("--only", choices=RENDERERS, action="append", help="draw with these alone")
    parser.add_argument("--match", default="", help="files whose names contain this")
    parser.add_argument("--out", type=Path, default=OUT / "foreign", metavar="DIR")
    arguments = parser.parse_args()
    out: Path = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    light = panorama(arguments.photograph, out)
    if light is None:
        parser.error("expected cubecam and OpenImageIO, or a panorama of an earlier run in --out")
    sources = [source for source in SOURCES if arguments.match in source.path]
    every = shots(sources, arguments.folder, out)
    only = arguments.only or list(RENDERERS)
    if "three" in only and installed("playwright") and arguments.three.is_dir():
        from .three_js import three_js

        with three_js(arguments.three) as three:
            for name, path, options in every:
                np.save(out / f"{name}-three.npy", three.draw(path, light, SIZE, **options))
            print(*three.problems, sep="\n")
    if "filament" in only and installed("filly"):
        from . import filament

        for name, path, options in every:
            try:
                drawn = filament.draw(path, light, SIZE, **options)
            except (
                Exception
            ) as error:  # the bindings' own errors, of any kind: the row shows no picture
                print(f"{name}: Filament: {error}")
                continue
            np.save(out / f"{name}-filament.npy", drawn)
    if "cubecam" in only and installed("cubecam", "OpenImageIO"):
        from . import with_cubecam

        for name, path, options in every:
            np.save(out / f"{name}-cubecam.npy", with_cubecam.draw(path, light, SIZE, **options)[0])
    for name, _, _ in every:
        files = {key: out / f"{name}-{key}.npy" for key in RENDERERS}
        pictures = {key: np.load(file) for key, file in files.items() if file.exists()}
        if not pictures:
            continue
        Image.fromarray(
            np.round(
                255 * np.concatenate([screen(a) ** (1 / 2.2) for a in pictures.values()], axis=1)
            ).astype(np.uint8)
        ).save(out / f"{name}.png")
        if "cubecam" in pictures:
            shown = lit(list(pictures.values()))
            others = [key for key in pictures if key != "cubecam"]
            alike = [
                f"{key} {share(difference(pictures[key], pictures['cubecam']), shown):.1%}"
                for key in others
            ]
            print(f"{name:40}", *alike)


if __name__ == "__main__":
    main()
