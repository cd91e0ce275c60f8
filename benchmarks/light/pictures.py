"""`python -m benchmarks.light.pictures`: the same scenes drawn by cubecam and by Filament (PyPI: filly), side by side.

A grid of metals and dielectrics over roughness, a mesh in metal and a clear-coated ball, in two photographs. Both get
the same GLB file or its arrays, camera and panorama; linear light, clipped at 1, then the curve of sRGB. A renderer
that is not installed is left out; pictures that lie in the folder from an earlier run are put beside the new ones.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from . import spheres

SIZE = (768, 288)
FOV = 24.0
ROUGHNESSES = (0.0, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0)
SUZANNE = spheres.DATA / "suzanne.glb"


@dataclass
class Ball:
    """A sphere of radius .5 with numbers of StandardMaterial."""

    position: tuple[float, float, float]
    material: dict[str, Any]


@dataclass
class Picture:
    balls: list[Ball] = field(default_factory=list)
    mesh: Path | None = None
    size: tuple[int, int] = SIZE
    eye: tuple[float, float, float] = (0.0, 0.0, 7.0)


def pictures() -> dict[str, Picture]:
    grid = [
        Ball((1.15 * (column - 3), 0.6 - 1.2 * row, 0.0), {**material, "roughness": roughness})
        for row, material in enumerate(
            (
                {"color": (1.0, 0.78, 0.34), "metallic": 1.0},
                {"color": (0.6, 0.05, 0.05), "metallic": 0.0},
            )
        )
        for column, roughness in enumerate(ROUGHNESSES)
    ]
    paint = {
        "color": (0.5, 0.02, 0.03),
        "metallic": 0.6,
        "roughness": 0.5,
        "clearcoat": 1.0,
        "clearcoat_roughness": 0.03,
    }
    return {
        "grid": Picture(grid, size=(1024, 320)),
        "paint": Picture([Ball((0, 0, 0), paint)], size=(384, 384), eye=(0.0, 0.4, 2.8)),
        "suzanne": Picture(mesh=SUZANNE, size=(384, 384), eye=(0.8, 0.3, 6.5)),
    }


def sphere(segments: int = 96, rings: int = 48) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """(positions = normals of radius 1, triangles)."""
    theta = np.linspace(0, np.pi, rings + 1)
    phi = np.linspace(0, 2 * np.pi, segments + 1)
    t, p = (a.ravel() for a in np.meshgrid(theta, phi, indexing="ij"))
    points = np.stack([np.sin(t) * np.sin(p), np.cos(t), np.sin(t) * np.cos(p)], -1)
    row, column = (a.ravel() for a in np.meshgrid(np.arange(rings), np.arange(segments)))
    a = row * (segments + 1) + column
    b = a + segments + 1
    triangles = np.concatenate([np.stack([a, b, b + 1], -1), np.stack([a, b + 1, a + 1], -1)])
    return points.astype(np.float32), triangles.astype(np.uint32)


def glb(balls: list[Ball]) -> bytes:
    """The balls as a glTF 2.0 binary file."""
    points, triangles = sphere()
    indices = triangles.tobytes()
    blob = (points / 2).astype(np.float32).tobytes() + points.tobytes() + indices
    length = points.nbytes
    materials: list[dict[str, Any]] = []
    for ball in balls:
        m = ball.material
        entry: dict[str, Any] = {
            "pbrMetallicRoughness": {
                "baseColorFactor": [*m["color"], 1.0],
                "metallicFactor": m["metallic"],
                "roughnessFactor": m["roughness"],
            }
        }
        if "clearcoat" in m:
            entry["extensions"] = {
                "KHR_materials_clearcoat": {
                    "clearcoatFactor": m["clearcoat"],
                    "clearcoatRoughnessFactor": m["clearcoat_roughness"],
                }
            }
        materials.append(entry)
    bounds = {"min": [-0.5] * 3, "max": [0.5] * 3}
    common = {"componentType": 5126, "count": len(points), "type": "VEC3"}
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_clearcoat"],
        "scene": 0,
        "scenes": [{"nodes": list(range(len(balls)))}],
        "nodes": [{"mesh": i, "translation": list(ball.position)} for i, ball in enumerate(balls)],
        "meshes": [
            {
                "primitives": [
                    {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": i}
                ]
            }
            for i in range(len(balls))
        ],
        "materials": materials,
        "buffers": [{"byteLength": len(blob)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": length},
            {"buffer": 0, "byteOffset": length, "byteLength": length},
            {"buffer": 0, "byteOffset": 2 * length, "byteLength": len(indices)},
        ],
        "accessors": [
            {"bufferView": 0, **common, **bounds},
            {"bufferView": 1, **common},
            {"bufferView": 2, "componentType": 5125, "count": triangles.size, "type": "SCALAR"},
        ],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    whole = 12 + 8 + len(text) + 8 + len(blob)
    return (
        struct.pack("<4sII", b"glTF", 2, whole)
        + struct.pack("<II", len(text), 0x4E4F534A)
        + text
        + struct.pack("<II", len(blob), 0x004E4942)
        + blob
    )


def material_in(path: Path) -> dict[str, Any]:
    """The numbers of the first material of a GLB file."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    found = json.loads(data[20 : 20 + length])["materials"][0].get("pbrMetallicRoughness", {})
    return {
        "color": tuple(found.get("baseColorFactor", (1, 1, 1, 1))[:3]),
        "metallic": found.get("metallicFactor", 1.0),
        "roughness": found.get("roughnessFactor", 1.0),
    }


def panorama(path: Path) -> npt.NDArray[Any]:
    """(H, W, 3) float32 of an EXR file, by Mitsuba, since filly reads no EXR."""
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    bitmap = mi.Bitmap(str(path)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.ascontiguousarray(np.maximum(np.array(bitmap), 0))


def with_filament(picture: Picture, photograph: Path, folder: Path) -> npt.NDArray[Any]:
    """(H, W, 3) bytes: rotation and units as measured, so that a mirror and a white ball agree with cubecam's."""
    import filly

    with filly.Renderer() as renderer:
        scene = renderer.create_scene()
        path = picture.mesh
        if path is None:
            path = folder / "balls.glb"
            path.write_bytes(glb(picture.balls))
        scene.load(str(path))
        camera = renderer.create_camera()
        camera.set_perspective(
            fov_y_deg=FOV, aspect=picture.size[0] / picture.size[1], near=0.1, far=100
        )
        camera.position = list(picture.eye)
        camera.look_at([0, 0, 0])
        camera.exposure = 0.0  # EV 100: luminance is divided by 1.2 * 2^EV
        scene.camera = camera
        scene.environment = renderer.create_environment(panorama(photograph))
        scene.environment_intensity = 1.2
        scene.environment_rotation_deg = 180.0  # +Z is in the centre of its panoramas
        scene.environment_visible = True
        scene.tone_mapping, scene.encoding = "linear", "srgb"
        scene.msaa = 4
        target = renderer.create_render_target(width=picture.size[0], height=picture.size[1])
        renderer.render(scene, target)
        pixels: npt.NDArray[Any] = np.array(target.read())[..., :3]
    return pixels


def with_cubecam(
    picture: Picture, photograph: Path, specular: str, multiple_scattering: bool
) -> npt.NDArray[Any]:
    import cubecam as cc

    pixels = np.maximum(cc.load_image(photograph).astype(np.float32), 0)
    scene = cc.Scene(environment=cc.CubeMap.from_equirect(pixels, size=256))
    options: dict[str, Any] = {
        "specular": specular,
        "specular_samples": 64,
        "multiple_scattering": multiple_scattering,
    }
    if picture.mesh is not None:
        material = cc.StandardMaterial(**material_in(picture.mesh), **options)
        scene.add(cc.load_mesh(picture.mesh), material)
    points, triangles = sphere()
    mesh = cc.Mesh(points / 2, triangles, normals=points)
    for ball in picture.balls:
        scene.add(mesh, cc.StandardMaterial(**ball.material, **options), position=ball.position)
    camera = cc.PerspectiveCamera(fov=FOV, position=picture.eye, target=(0, 0, 0))
    with cc.Renderer() as renderer:
        frame = renderer.render(scene, camera, size=picture.size, format="rgba32f", samples=4)
    linear = np.clip(frame.color[..., :3], 0, 1)
    curve = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.round(curve * 255).astype(np.uint8)


def main() -> None:
    """Write NAME-PHOTOGRAPH-RENDERER.png, and NAME-PHOTOGRAPH.png with all of them below each other."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.light.pictures", description=__doc__
    )
    parser.add_argument("photographs", nargs="*", default=["forest", "studio"])
    parser.add_argument("--only", choices=list(pictures()), action="append")
    parser.add_argument("--out", type=Path, default=spheres.TRUTH.parent / "light", metavar="DIR")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, picture in pictures().items():
        if arguments.only and name not in arguments.only:
            continue
        for photograph in arguments.photographs:
            path = spheres.DATA / f"{photograph}.exr"
            drawn = {}
            if importlib.util.find_spec("filly") and importlib.util.find_spec("mitsuba"):
                drawn["filament"] = with_filament(picture, path, arguments.out)
            if importlib.util.find_spec("OpenImageIO"):
                drawn["cubecam"] = with_cubecam(picture, path, "levels", True)
                drawn["cubecam-sampled"] = with_cubecam(picture, path, "sampled", True)
            for renderer, pixels in drawn.items():
                Image.fromarray(pixels).save(arguments.out / f"{name}-{photograph}-{renderer}.png")
            files = [
                arguments.out / f"{name}-{photograph}-{renderer}.png"
                for renderer in ("filament", "cubecam", "cubecam-sampled")
            ]
            if all(file.exists() for file in files):
                shown = [np.asarray(Image.open(file)) for file in files]
                difference = np.abs(shown[0].astype(int) - shown[1]).astype(np.uint8)
                axis = 0 if picture.size[0] > 2 * picture.size[1] else 1
                together = np.concatenate([*shown, difference], axis=axis)
                Image.fromarray(together).save(arguments.out / f"{name}-{photograph}.png")
                print(f"{name} in {photograph}: {(difference.max(-1) <= 10).mean():.1%} within 10")


if __name__ == "__main__":
    main()
