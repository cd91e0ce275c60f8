"""Compile the module for AddressSanitizer and UndefinedBehaviorSanitizer, and run the tests with it.

    python scripts/sanitize.py [options of pytest]         without options: tests/unit and tests/gl

The module lies in build/asan beside a copy of the Python files. Both sanitizers are preloaded, because the
interpreter contains neither: AddressSanitizer alone would stop at the first exception of C++.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import build_version

ROOT = Path(__file__).resolve().parent.parent
FLAGS = (
    "-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer"
)
#: These leaks are not reported, because the interpreter never frees all that it holds.
SUPPRESSIONS = "leak:libpython3\nleak:_PyObject\nleak:PyType\n"


def library(name: str) -> str:
    """The path at which the compiler finds a library."""
    command = [os.environ.get("CXX", "c++"), f"-print-file-name={name}"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def main(arguments: list[str]) -> int:
    folder = ROOT / "build" / "asan"
    package = folder / "python" / "cubecam"
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(
        ROOT / "python" / "cubecam",
        package,
        ignore=shutil.ignore_patterns("*.so", "_shader_trial", "__pycache__"),
    )
    print("[sanitize] compiling", flush=True)
    module = build_version.compile_module(
        ROOT, folder / "objects", "-DCMAKE_BUILD_TYPE=Debug", f"-DCMAKE_CXX_FLAGS={FLAGS}"
    )
    build_version.copy_module(module, package)
    suppressions = folder / "suppressions.txt"
    suppressions.write_text(SUPPRESSIONS)
    environment = {
        **os.environ,
        "PYTHONPATH": str(folder / "python"),
        "PYTHONMALLOC": "malloc",
        "LD_PRELOAD": f"{library('libasan.so')} {library('libubsan.so')}",
        "LSAN_OPTIONS": f"suppressions={suppressions}",
        "UBSAN_OPTIONS": "print_stacktrace=1",
    }
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-p",
        "no:cacheprovider",
        "-m",
        "not slow and not build",
    ]
    return subprocess.run(
        [*command, *(arguments or ["tests/unit", "tests/gl"])], cwd=ROOT, env=environment
    ).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
