"""CPU time of `load_scene` over that of `load_image` for the same pictures: `python -m benchmarks.load_scene`.

A GLB of 2 MB holds a ball with two JPEG pictures of 2,048 x 2,048. The aim is a ratio of at most 1.5. Times are the
least of nine, because the first ones hold imports, and others whatever else the machine does.
"""

from __future__ import annotations

import io
import json
import struct
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

import cubecam as cc

SIZE = 2048


def picture(seed: int) -> bytes:
    """Make a JPEG of soft noise, of about 1 MB."""
    coarse = np.random.default_rng(seed).integers(0, 255, (128, 128, 3), np.uint8)
    data = io.BytesIO()
    large = Image.fromarray(coarse).resize((SIZE, SIZE), Image.Resampling.BICUBIC)
    large.save(data, "JPEG", quality=93)
    return data.getvalue()


def glb(pictures: list[bytes]) -> bytes:
    """Make a GLB of a ball whose material shows two pictures."""
    ball = cc.Mesh.sphere(1)
    arrays = [ball.positions, ball.normals, ball.uvs, ball.indices.astype(np.uint32)]
    parts = [*(np.ascontiguousarray(array).tobytes() for array in arrays), *pictures]
    views, binary = [], b""
    for part in parts:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(part)})
        binary += part + b"\0" * (-len(part) % 4)
    count, corners = len(ball.positions), ball.indices.size
    kinds = (
        ("VEC3", 5126, count),
        ("VEC3", 5126, count),
        ("VEC2", 5126, count),
        ("SCALAR", 5125, corners),
    )
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                        "indices": 3,
                        "material": 0,
                    }
                ]
            }
        ],
        "materials": [
            {
                "pbrMetallicRoughness": {
                    "baseColorTexture": {"index": 0},
                    "metallicRoughnessTexture": {"index": 1},
                }
            }
        ],
        "textures": [{"source": 0}, {"source": 1}],
        "images": [{"bufferView": 4 + n, "mimeType": "image/jpeg"} for n in range(2)],
        "accessors": [
            {"bufferView": n, "type": kind, "componentType": component, "count": size}
            for n, (kind, component, size) in enumerate(kinds)
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def cpu_time(work: Callable[[], object]) -> float:
    """Measure the least CPU time, in seconds, of all threads of this process."""
    times = []
    for _ in range(9):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return min(times)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        pictures = [picture(seed) for seed in range(2)]
        files = [folder / f"{number}.jpg" for number in range(2)]
        for file, data in zip(files, pictures, strict=True):
            file.write_bytes(data)
        model = folder / "ball.glb"
        model.write_bytes(glb(pictures))
        images = cpu_time(lambda: [cc.load_image(file) for file in files])
        scene = cpu_time(lambda: cc.load_scene(model))
        megabytes = model.stat().st_size / 1e6
    print(f"GLB of {megabytes:.1f} MB: load_image {images:.3f} s, load_scene {scene:.3f} s of CPU")
    print(f"ratio {scene / images:.2f}, aim 1.5")


if __name__ == "__main__":
    main()
