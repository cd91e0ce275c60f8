"""Build a wheel into dist/ and try it as its user would install it.

`check_wheel.py` checks what is in it, auditwheel says for which systems it is, and twine whether an
index takes it. Then the wheel goes into an empty environment and renders the demo.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "dist"
#: A source with which Mesa's compiler crashes: only the helper may notice.
TRIAL = """
import cubecam as cc
scene = cc.Scene()
scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial("vec3 shade(Surface s) { return vec3((-2147483647 - 1) / -1); }"))
try:
    cc.Renderer(device="software").capture(scene, size=4)
except cc.ShaderError as error:
    print(error)
"""


def run(*command: str | Path) -> None:
    print(
        "$", *(Path(part).name if isinstance(part, Path) else part for part in command), flush=True
    )
    subprocess.run([str(part) for part in command], cwd=ROOT, check=True)


def build() -> Path:
    for old in DIST.glob("*.whl"):
        old.unlink()
    run(
        sys.executable, "-m", "pip", "wheel", "--quiet", "--no-build-isolation", "--no-deps",
        "--config-settings=build-dir=build/{wheel_tag}", "--wheel-dir=dist", ".",
    )  # fmt: skip
    (wheel,) = DIST.glob("*.whl")
    return wheel


def try_it(wheel: Path, folder: Path) -> None:
    run(sys.executable, "-m", "venv", folder / "venv")
    python = folder / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", wheel)
    # This is not the folder of the checkout, so that only the files of the wheel can be used.
    os.chdir(folder)
    subprocess.run([str(python), "-m", "cubecam", "demo", "--out", str(folder / "out")], check=True)
    # A warning says that the helper cannot be started.
    subprocess.run([str(python), "-W", "error", "-c", TRIAL], check=True)


def main() -> int:
    wheel = build()
    run(sys.executable, "scripts/check_wheel.py", wheel)
    run(sys.executable, "-m", "auditwheel", "show", wheel)
    run(sys.executable, "-m", "twine", "check", "--strict", wheel)
    with tempfile.TemporaryDirectory() as name:
        try_it(wheel, Path(name))
    print(f"{wheel.relative_to(ROOT)}: {wheel.stat().st_size / 1e6:.1f} MB, checked")
    return 0


if __name__ == "__main__":
    sys.exit(main())
