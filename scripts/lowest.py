"""Run the tests with the lowest versions that pyproject.toml declares.

    .venv/bin/python scripts/lowest.py .venv/lowest [options of pytest]

uv resolves each declared requirement to its lowest version (`lowest-direct`; the requirements of those packages
are the newest that fit). The environment and the build, in build/lowest, are its own.

The lowest numpy has no wheels for a Python newer than 3.11, so the script needs Python 3.10 or 3.11:
`make test-lowest PYTHON=python3.11` chooses one.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import packages

NEWEST_PYTHON = (3, 11)


def index() -> dict[str, str]:
    """The settings of pip's package index for uv, which does not read pip's files."""
    names = {"index-url": "UV_DEFAULT_INDEX", "extra-index-url": "UV_INDEX"}
    shown = subprocess.run(
        [sys.executable, "-m", "pip", "config", "list"], capture_output=True, text=True, check=True
    ).stdout
    found = {}
    for line in shown.splitlines():
        key, _, value = line.partition("=")
        name = names.get(key.rpartition(".")[2])
        if name and name not in os.environ:
            found[name] = value.strip("'\"")
    return found


def main(arguments: list[str]) -> int:
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    if sys.version_info[:2] > NEWEST_PYTHON:
        got = "{}.{}".format(*sys.version_info)
        print(f"[lowest] expected Python 3.10 or 3.11, got {got}; see PYTHON=", file=sys.stderr)
        return 1
    venv = Path(arguments[0]).absolute()
    python = str(venv / "bin" / "python")
    subprocess.run([sys.executable, "-m", "venv", "--clear", str(venv)], check=True)
    print("[lowest] Python packages", flush=True)
    wanted = packages.requirements(["build", "run", "test"])
    subprocess.run(
        [
            *(sys.executable, "-m", "uv", "pip", "install", "--quiet", "--python", python),
            *("--resolution", "lowest-direct", *wanted),
        ],
        env={**os.environ, **index()},
        check=True,
    )
    print("[lowest] building cubecam", flush=True)
    environment = {
        **os.environ,
        "PATH": f"{venv / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}",
        "CMAKE_BUILD_PARALLEL_LEVEL": str(len(os.sched_getaffinity(0))),
    }
    subprocess.run(
        [
            *(python, "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps"),
            *("--config-settings=build-dir=build/lowest", "."),
        ],
        cwd=packages.ROOT,
        env=environment,
        check=True,
    )
    return subprocess.run(
        [python, "-m", "pytest", *arguments[1:]], cwd=packages.ROOT, env=environment
    ).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
