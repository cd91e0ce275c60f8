"""Check what docs/releasing.md asks for and a program can check.

    .venv/bin/python scripts/release.py              versions agree, the changelog has the version, git is clean
    .venv/bin/python scripts/release.py --tagged     also: HEAD has the tag of the version
    .venv/bin/python scripts/release.py --dist       also: dist/ has the packages of the version, all of them
    .venv/bin/python scripts/release.py --notes      print the version's part of the changelog, no more

--partial accepts a dist/ without the wheels of some Pythons and systems, for a rehearsal.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

from check_wheel import WheelError, check

ROOT = Path(__file__).resolve().parent.parent
TAG = "manylinux_2_28"
PYTHONS = ("cp310", "cp311", "cp312", "cp313", "cp314")
MACHINES = ("x86_64", "aarch64")
#: Files that state the version, and how.
STATED = {
    "pyproject.toml": r'^version = "(.+)"$',
    "CITATION.cff": r"^version: (.+)$",
    "conda/recipe.yaml": r'^  version: "(.+)"$',
    "python/cubecam/_core.pyi": r'^__version__: str = "(.+)"$',
}


def versions(root: Path = ROOT) -> dict[str, str]:
    """The version that each file states."""
    found = {}
    for name, pattern in STATED.items():
        match = re.search(pattern, (root / name).read_text(encoding="utf-8"), re.MULTILINE)
        found[name] = match[1] if match else "none"
    return found


def notes(changelog: str, version: str) -> str:
    """What the changelog says about a version, or nothing."""
    heading = rf"^## {re.escape(version)}( - \d{{4}}-\d\d-\d\d)?\n"
    parts = re.split(heading, changelog, maxsplit=1, flags=re.MULTILINE)
    return (
        re.split(r"^## ", parts[-1], maxsplit=1, flags=re.MULTILINE)[0].strip() if parts[1:] else ""
    )


def version_faults(root: Path = ROOT) -> list[str]:
    stated = versions(root)
    version = stated["pyproject.toml"]
    faults = [
        f"{name}: expected version {version} as in pyproject.toml, got {other}"
        for name, other in stated.items()
        if other != version
    ]
    changelog = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"^## {re.escape(version)} - \d{{4}}-\d\d-\d\d$", changelog, re.MULTILINE):
        faults.append(f'CHANGELOG.md: expected a heading "## {version} - YEAR-MONTH-DAY", got none')
    elif not notes(changelog, version):
        faults.append(f"CHANGELOG.md: expected what is new in {version}, got nothing")
    if "## Unreleased" not in changelog:
        faults.append('CHANGELOG.md: expected a heading "## Unreleased", got none')
    elif left := notes(changelog, "Unreleased"):
        faults.append(f"CHANGELOG.md: expected nothing under Unreleased, got {left[:60]!r}")
    return faults


def git(*arguments: str) -> str:
    command = ["git", "-C", str(ROOT), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def git_faults(version: str, tagged: bool) -> list[str]:
    faults = []
    if changed := git("status", "--porcelain"):
        faults.append(f"git: expected no changes, got {changed.splitlines()[0]!r}")
    tag = f"v{version}"
    kind = git("cat-file", "-t", tag)
    here = git("rev-parse", f"{tag}^{{commit}}") == git("rev-parse", "HEAD") if kind else False
    if kind and not here:
        faults.append(f"git: the tag {tag} exists and is on another commit")
    if tagged and kind != "tag":
        faults.append(f"git: expected an annotated tag {tag}, got {kind or 'none'}")
    return faults


def missing_packages(names: set[str], version: str) -> list[str]:
    """The packages of a version that are not among the names of files."""
    missing = [] if f"cubecam-{version}.tar.gz" in names else [f"cubecam-{version}.tar.gz"]
    for python in PYTHONS:
        for machine in MACHINES:
            wheel = rf"cubecam-{re.escape(version)}-{python}-{python}-\S*{TAG}_{machine}\S*\.whl"
            if not any(re.fullmatch(wheel, name) for name in names):
                missing.append(f"{python} {machine}")
    return missing


def dist_faults(version: str, partial: bool) -> list[str]:
    packages = sorted([*ROOT.glob("dist/*.whl"), *ROOT.glob("dist/*.tar.gz")])
    names = {path.name for path in packages}
    faults = [
        f"dist/{name}: expected version {version} alone in dist/"
        for name in sorted(names)
        if not name.startswith((f"cubecam-{version}-", f"cubecam-{version}.tar.gz"))
    ]
    missing = missing_packages(names, version)
    if missing and not partial:
        faults.append(f"dist/: expected all packages, these are missing: {', '.join(missing)}")
    for wheel in (path for path in packages if path.suffix == ".whl"):
        try:
            check(wheel, TAG)
        except WheelError as error:
            faults.append(str(error))
    if packages:
        twine = [sys.executable, "-m", "twine", "check", "--strict", *map(str, packages)]
        if subprocess.run(twine).returncode:
            faults.append("dist/: an index would not take these packages (twine check)")
    else:
        faults.append("dist/: expected packages, got none")
    return faults


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    for name in ("tagged", "dist", "partial", "notes"):
        parser.add_argument(f"--{name}", action="store_true")
    arguments = parser.parse_args()
    version = versions()["pyproject.toml"]
    if arguments.notes:
        print(notes((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), version))
        return 0
    faults = version_faults() + git_faults(version, arguments.tagged)
    if arguments.dist:
        faults += dist_faults(version, arguments.partial)
    for fault in faults:
        print(fault, file=sys.stderr)
    if not faults:
        print(f"cubecam {version}: ready")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
