"""Run the programs of docs/howto and docs/explanation and keep their pictures in docs/images; `make gallery` does.

Each file has at most 200 KB, as a test demands.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import Any

os.environ.setdefault("MPLBACKEND", "agg")

from PIL import Image

import cubecam as cc

ROOT = Path(__file__).resolve().parent.parent

_PROJECTIONS = (
    "perspective",
    "equidistant",
    "equisolid",
    "stereographic",
    "orthographic",
    "mirror_ball",
    "angular_map",
    "octahedral",
    "dual_paraboloid",
    "cylindrical",
)
#: Pages whose programs are files, which name themselves in their first line: which one draws, and what it needs.
FILES = {"howto/train.md": ("main.py", "torch")}
#: For each page of docs, the pictures that its programs write and their files in docs/images.
PICTURES = {
    "howto/seams.md": {"seams.png": "howto-seams.png"},
    "howto/random_scenes.md": {"sample.png": "howto-random-scenes.png"},
    "howto/plots.md": {"plots.png": "howto-plots.jpg"},
    "howto/reflection.md": {"reflection.png": "howto-reflection.jpg"},
    "howto/glb_in_a_probe.md": {"ball.png": "howto-ball.jpg"},
    "howto/own_pictures.md": {"ball.png": "howto-own-pictures.jpg"},
    "howto/several_probes.md": {"rooms.png": "howto-several-probes.jpg"},
    "howto/projections.md": {
        f"{name}.jpg": f"howto-projection-{name}.jpg" for name in _PROJECTIONS
    },
    "howto/orientation.md": {"orientation.png": "howto-orientation.png"},
    "howto/truth.md": {"error.png": "howto-truth.jpg"},
    "howto/train.md": {"train.png": "howto-train.png"},
    "howto/own_materials.md": {"first.png": "howto-own-materials.jpg"},
    "explanation/views.md": {"views.png": "why-views.jpg"},
    "explanation/keys.md": {"keys.png": "why-keys.jpg"},
    "explanation/what_cubemaps_get_wrong.md": {"wrong.png": "why-wrong.jpg"},
}


def main(pages: list[str]) -> None:
    """Draw the pictures of all pages, or of those whose names are given (`howto/seams.md`)."""
    for page, pictures in PICTURES.items():
        if pages and page not in pages:
            continue
        text = (ROOT / "docs" / page).read_text(encoding="utf-8")
        if page in FILES and find_spec(FILES[page][1]) is None:
            print(f"{page}: left out, it needs {FILES[page][1]}")
            continue
        with tempfile.TemporaryDirectory() as folder:
            if page in FILES:
                run_file(text, Path(folder), FILES[page][0])
            else:
                run_blocks(text, folder, page)
            for picture, kept in pictures.items():
                target = ROOT / "docs" / "images" / kept
                colors = cc.load_image(Path(folder) / picture)[..., :3]
                Image.fromarray(colors).save(target, quality=85)
                print(f"{target.relative_to(ROOT)}: {target.stat().st_size // 1000} KB")


def run_blocks(text: str, folder: str, page: str) -> None:
    """Run the blocks of a page, one after the other, in this process."""
    scope: dict[str, Any] = {}
    os.chdir(folder)
    for code in re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL):
        exec(compile(code, page, "exec"), scope)
    os.chdir(ROOT)


def run_file(text: str, folder: Path, name: str) -> None:
    """Write the programs of a page into a folder, and run one of them."""
    for code in re.findall(r"```py\n(# \w+\.py\n.*?)```", text, flags=re.DOTALL):
        (folder / code.split()[1]).write_text(code, encoding="utf-8")
    subprocess.run([sys.executable, name], cwd=folder, check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
