"""Write python/cubecam/_core.pyi from the built module; with --check, only compare the two."""

from __future__ import annotations

import difflib
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "python" / "cubecam" / "_core.pyi"


def generate() -> str:
    """Text of the stub, by pybind11-stubgen and ruff of the versions that pyproject.toml pins."""
    with tempfile.TemporaryDirectory() as folder:
        made = subprocess.run(
            [
                sys.executable,
                "-m",
                "pybind11_stubgen",
                "cubecam._core",
                "--output-dir",
                folder,
                "--exit-code",
            ],
            cwd=folder,
            capture_output=True,
            text=True,
        )
        if made.returncode != 0:
            raise SystemExit(f"pybind11-stubgen failed:\n{made.stdout}{made.stderr}")
        text = Path(folder, "cubecam", "_core.pyi").read_text(encoding="utf-8")
    settings = f"--config={ROOT / 'pyproject.toml'}"
    for command in (["check", "--select=I,F401", "--fix-only"], ["format"]):
        text = subprocess.run(
            [sys.executable, "-m", "ruff", *command, settings, "--stdin-filename=_core.pyi", "-"],
            input=text,
            check=True,
            stdout=subprocess.PIPE,
            text=True,
        ).stdout
    return text


def main(arguments: list[str]) -> int:
    text = generate()
    known = STUB.read_text(encoding="utf-8") if STUB.exists() else ""
    if text == known:
        return 0
    if arguments == ["--check"]:
        lines = difflib.unified_diff(
            known.splitlines(), text.splitlines(), "_core.pyi", "the built module", lineterm=""
        )
        print("\n".join(lines))
        print(
            "python/cubecam/_core.pyi is not what the module says: run make stubs", file=sys.stderr
        )
        return 1
    STUB.write_text(text, encoding="utf-8")
    print(f"wrote {STUB.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
