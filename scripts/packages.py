"""Install what pyproject.toml names into the environment whose interpreter runs this.

    .venv/bin/python scripts/packages.py build run      packages that building and running need
    .venv/bin/python scripts/packages.py test docs      extras, by their names in pyproject.toml
    .venv/bin/python scripts/packages.py --package      cubecam itself, compiled in build/

pip installs missing requirements and never upgrades, so that it needs no network when nothing is
missing. Its settings (configuration files, PIP_* variables) are the user's own.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:
    from pip._vendor import tomli as tomllib

ROOT = Path(__file__).resolve().parent.parent
# The environment has build tools of its own, even where the system has some, so that everyone
# builds with the same ones.
BUILD_TOOLS = ["cmake>=3.25", "ninja>=1.11"]


def requirements(groups: list[str]) -> list[str]:
    with (ROOT / "pyproject.toml").open("rb") as file:
        project = tomllib.load(file)
    extras = project["project"]["optional-dependencies"]
    known = {
        "build": project["build-system"]["requires"] + BUILD_TOOLS,
        "run": project["project"]["dependencies"],
        **extras,
    }
    unknown = [name for name in groups if name not in known]
    if unknown:
        raise SystemExit(f"expected some of {', '.join(known)}, got {', '.join(unknown)}")
    return sorted({requirement for name in groups for requirement in known[name]})


def pip(*arguments: str) -> int:
    environment = {
        "PIP_DISABLE_PIP_VERSION_CHECK": "1",
        # Ninja would start two more compilers than there are cores; each takes most of a gigabyte.
        "CMAKE_BUILD_PARALLEL_LEVEL": str(len(os.sched_getaffinity(0))),
        **os.environ,
    }
    command = [sys.executable, "-m", "pip", "install", "--quiet", *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment).returncode


def main(arguments: list[str]) -> int:
    if arguments == ["--package"]:
        print("[setup] building cubecam (a minute or two the first time)", flush=True)
        return pip(
            "--no-build-isolation",
            "--no-deps",
            "--config-settings=build-dir=build/{wheel_tag}",
            ".",
        )
    if not arguments or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    print(f"[setup] Python packages to {' and '.join(arguments)}", flush=True)
    return pip(*requirements(arguments))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
