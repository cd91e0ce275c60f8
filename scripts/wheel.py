"""Build a wheel into dist/ and check it as its user would install it.

The extension may link the C and C++ run times and nothing else: libGL, libEGL and libX11 are opened
at run time, so that the wheel installs on a machine without them. The wheel must have the licences
and the list (software bill of materials) of what is compiled into it, and what compilers and linkers
do against the abuse of mistakes. Then the wheel goes into an empty environment and renders the demo.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "dist"
LINKED = re.compile(r"lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)\.so(\.\d+)?|ld-linux.*")
LARGEST = 5_000_000  # bytes
HELPER = "cubecam/_shader_trial"  # the program that tries users' GLSL
EXPECTED = (
    "cubecam/_core.pyi", "cubecam/conventions.md", "cubecam/data/CREDITS.md", "cubecam/py.typed", HELPER,
)  # fmt: skip
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
COMPONENTS = ("glad", "glm", "pybind11")  # compiled into the extension


def run(*command: str | Path) -> None:
    print(
        "$", *(Path(part).name if isinstance(part, Path) else part for part in command), flush=True
    )
    subprocess.run([str(part) for part in command], cwd=ROOT, check=True)


def build() -> Path:
    before = set(DIST.glob("*.whl"))
    for old in before:
        old.unlink()
    run(
        sys.executable, "-m", "pip", "wheel", "--quiet", "--no-build-isolation", "--no-deps",
        "--config-settings=build-dir=build/{wheel_tag}", "--wheel-dir=dist", ".",
    )  # fmt: skip
    (wheel,) = DIST.glob("*.whl")
    return wheel


def needed_libraries(library: Path) -> list[str]:
    shown = subprocess.run(
        ["readelf", "--dynamic", "--wide", str(library)],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    ).stdout
    return re.findall(r"\(NEEDED\).*\[(.+)\]", shown)


def check_notices(archive: zipfile.ZipFile) -> None:
    """Check that the wheel names what is compiled into it, with versions and licences."""
    names = archive.namelist()
    for component in COMPONENTS:
        if not any(
            name.endswith(f".dist-info/licenses/licenses/{component}.txt") for name in names
        ):
            raise SystemExit(f"expected the licence of {component} in the wheel, got none")
    (path,) = [name for name in names if name.endswith(".dist-info/sboms/cubecam.cdx.json")]
    sbom = json.loads(archive.read(path))
    listed = {part["name"].rstrip("2"): part["version"] for part in sbom["components"]}
    print("compiled in:", ", ".join(f"{name} {version}" for name, version in listed.items()))
    wrong = [name for name in COMPONENTS if not re.match(r"\d+\.\d+", listed.get(name, ""))]
    if wrong or sbom["bomFormat"] != "CycloneDX":
        raise SystemExit(f"{path}: expected versions of {', '.join(COMPONENTS)}, got {listed}")


def missing_hardening(binary: Path) -> list[str]:
    """Name what a shared object or program lacks of the options of cmake/compile_options.cmake."""
    options = ["--dynamic", "--program-headers", "--dyn-syms", "--wide"]
    shown = subprocess.run(
        ["readelf", *options, str(binary)], check=True, stdout=subprocess.PIPE, text=True
    ).stdout
    stack = re.search(r"GNU_STACK\s.*", shown)
    wanted = {
        "BIND_NOW": re.search(r"\(FLAGS\).*BIND_NOW|\(BIND_NOW\)|\(FLAGS_1\).*NOW", shown),
        "RELRO": "GNU_RELRO" in shown,
        "a stack that is not executable": stack is not None and "E" not in stack[0][20:],
        "guards on the stack": "__stack_chk_fail" in shown,
        "checked copies": re.search(r"__\w+_chk\b(?<!stack_chk)", shown),
    }
    return [name for name, found in wanted.items() if not found]


def check_contents(wheel: Path, folder: Path) -> None:
    if wheel.stat().st_size >= LARGEST:
        raise SystemExit(
            f"{wheel.name}: expected less than {LARGEST:,} bytes, got {wheel.stat().st_size:,}"
        )
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        missing = [name for name in EXPECTED if name not in names]
        if missing:
            raise SystemExit(f"{wheel.name}: expected {', '.join(missing)} in it, got none")
        extensions = [name for name in names if name.endswith(".so")]
        if len(extensions) != 1:
            raise SystemExit(f"{wheel.name}: expected one extension module, got {extensions}")
        check_notices(archive)
        if (archive.getinfo(HELPER).external_attr >> 16) & 0o111 == 0:
            raise SystemExit(f"{wheel.name}: expected {HELPER} to be executable")
        for name in (extensions[0], HELPER):
            check_libraries(name, Path(archive.extract(name, folder)))


def check_libraries(name: str, library: Path) -> None:
    needed = needed_libraries(library)
    if missing := missing_hardening(library):
        raise SystemExit(f"{name}: expected {', '.join(missing)}")
    print(f"{name} links {', '.join(needed)}")
    foreign = [name for name in needed if not LINKED.fullmatch(name)]
    if foreign:
        raise SystemExit(f"{name}: expected only C and C++ run times, got {', '.join(foreign)}")


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
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_contents(wheel, folder)
        run(sys.executable, "-m", "auditwheel", "show", wheel)
        try_it(wheel, folder)
    print(f"{wheel.relative_to(ROOT)}: {wheel.stat().st_size / 1e6:.1f} MB, checked")
    return 0


if __name__ == "__main__":
    sys.exit(main())
