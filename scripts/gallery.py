"""Draw the pictures of the README into docs/images:  make gallery

frame.jpg is what README's first program writes, cross.jpg is the cubemap that it captures, and heads.jpg is the
scene of `three_heads`. Each file has at most 200 KB.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.demo import named_cross

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
LARGEST = 200_000  # bytes

Picture = npt.NDArray[np.uint8]

#: Coloured clay under a glaze: light from all sides and from the lamps, and a reflection of the surroundings.
GLAZE = """
uniform vec3 color;

vec3 shade(Surface surface) {
    vec3 light = environment_lod(surface.normal, environment_levels() - 2.0);
    for (int i = 0; i < light_count(); ++i) {
        LightSample lamp = sample_light(i, surface);
        light += max(dot(surface.normal, lamp.direction), 0.0) * lamp.radiance;
    }
    vec3 reflected = environment_lod(reflect(surface.incident, surface.normal), 1.0);
    return mix(color * light, min(reflected, vec3(8.0)), schlick(surface, 0.05));
}
"""


def first_program() -> tuple[Picture, cc.CubeMap]:
    """Run README's first program; return the frame that it writes and its cubemap."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    code = re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)[0]
    scope: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        exec(compile(code, "README.md", "exec"), scope)
        os.chdir(ROOT)
        frame: Picture = cc.load_image(Path(folder) / "frame.png").astype(np.uint8)
    return frame[..., :3], scope["cube"]


def three_heads() -> Picture:
    """Suzanne three times, in gold, glazed clay and glass, in the mist of a sunrise."""
    scene = cc.Scene(environment=cc.load_environment(cc.sample_data("sunrise.exr"), mipmaps=True))
    sharp, soft = cc.Shadow(size=2048, radius=4), cc.Shadow(size=128, radius=5)
    sun = cc.DirectionalLight((-0.5, -0.55, 0.6), color="#ffe0b0", intensity=1.4, shadow=sharp)
    sky = cc.DirectionalLight((-0.2, -1, -0.6), color="#c4d4ff", intensity=0.7, shadow=soft)
    scene.add(sun)
    scene.add(sky)
    stone = cc.PhongMaterial(color="#c0a888", ka=0.12, kd=0.85, ks=0)
    scene.add(cc.Mesh.cylinder(4.3, 0.4, 128), stone, position=(0, -0.2, 0))
    head = cc.load_mesh(cc.sample_data("suzanne.glb"), size=1.5)
    materials = {
        20: cc.MirrorMaterial(tint=(1, 0.78, 0.42)),
        -8: cc.ShaderMaterial(GLAZE, uniforms={"color": (0.75, 0.13, 0.09)}),
        -34: cc.GlassMaterial(ior=1.2),
    }
    for index, (degrees, material) in enumerate(materials.items()):
        place = (1.5 * (index - 1), -head.bounds[0][1] - 0.02, (-0.1, 0.35, -0.1)[index])
        node = scene.add(head, material, position=place)
        node.rotation = cc.axis_angle((0, 1, 0), degrees)
        node.environment = cc.Probe(position=place, size=512, mipmaps=True)
    camera = cc.PerspectiveCamera(fov=21, position=(-1.3, 0.95, 7.6), target=(0, 0.62, 0))
    with cc.Renderer() as renderer:
        frame = renderer.render(scene, camera, (1024, 576), samples=4, format="rgba16f")
    return cc.to_screen(frame)[..., :3]


def on_paper(picture: Picture, paper: tuple[int, int, int] = (255, 255, 255)) -> Picture:
    """Lay a picture with transparent cells on one colour."""
    return np.where(picture[..., 3:] == 0, np.array(paper, np.uint8), picture[..., :3])


def main() -> int:
    IMAGES.mkdir(parents=True, exist_ok=True)
    frame, cube = first_program()
    pictures = {
        "frame.jpg": frame,
        "cross.jpg": on_paper(named_cross(cube.resize(256))),
        "heads.jpg": three_heads(),
    }
    for name, picture in pictures.items():
        path = IMAGES / name
        cc.save_image(path, picture)
        size = path.stat().st_size
        print(f"{path.relative_to(ROOT)}: {picture.shape[1]} x {picture.shape[0]}, {size:,} bytes")
        if size > LARGEST:
            raise SystemExit(f"{name}: expected at most {LARGEST:,} bytes, got {size:,}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
