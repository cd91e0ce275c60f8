"""Run the programs of docs/howto and keep their pictures in docs/images; `make gallery` calls this script.

Each file has at most 200 KB, as a test demands.
"""

from __future__ import annotations

import os
import re
import tempfile
from pathlib import Path
from typing import Any

os.environ.setdefault("MPLBACKEND", "agg")

from PIL import Image

import cubecam as cc

ROOT = Path(__file__).resolve().parent.parent

#: For each page, the picture that its program writes and the file in docs/images.
PICTURES = {
    "seams.md": ("seams.png", "howto-seams.png"),
    "random_scenes.md": ("sample.png", "howto-random-scenes.png"),
    "plots.md": ("plots.png", "howto-plots.jpg"),
    "reflection.md": ("reflection.png", "howto-reflection.jpg"),
    "glb_in_a_probe.md": ("ball.png", "howto-ball.jpg"),
    "own_pictures.md": ("ball.png", "howto-own-pictures.jpg"),
}


def main() -> None:
    for page, (picture, kept) in PICTURES.items():
        text = (ROOT / "docs" / "howto" / page).read_text(encoding="utf-8")
        scope: dict[str, Any] = {}
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            for code in re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL):
                exec(compile(code, page, "exec"), scope)
            os.chdir(ROOT)
            target = ROOT / "docs" / "images" / kept
            Image.fromarray(cc.load_image(Path(folder) / picture)[..., :3]).save(target, quality=85)
        print(f"{target.relative_to(ROOT)}: {target.stat().st_size // 1000} KB")


if __name__ == "__main__":
    main()
