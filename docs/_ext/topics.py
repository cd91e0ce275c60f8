"""The pages of the reference, and the names that each of them documents."""

from __future__ import annotations

import functools
import re
from pathlib import Path

REFERENCE = Path(__file__).resolve().parent.parent / "reference"
_LISTED = re.compile(r"```{toctree}\n:hidden:\n\n(.*?)```", re.DOTALL)
_BLOCK = re.compile(r"^\.\. api::\n((?:[ ]{3}.*\n|\n)*)", re.MULTILINE)


@functools.cache
def names_by_page() -> dict[str, list[str]]:
    """For each page the full names of its directives ``api``, in order."""
    found = {}
    listed = _LISTED.findall((REFERENCE / "index.md").read_text(encoding="utf-8"))[0].split()
    for path in sorted(REFERENCE.glob("*.md"), key=lambda path: _place(path.stem, listed)):
        text = path.read_text(encoding="utf-8")
        found[path.stem] = [
            full_name(name) for block in _BLOCK.findall(text) for name in block.split()
        ]
    return found


def _place(page: str, listed: list[str]) -> tuple[int, str]:
    """Sort pages as the index has them; one that it forgets comes last."""
    return (listed.index(page) if page in listed else len(listed), page)


def full_name(name: str) -> str:
    """Turn "Scene" and "plot.cross" into the names that a program imports."""
    return f"cubecam.{name}"


@functools.cache
def known_names() -> dict[str, str]:
    """Full names of all that is documented, by what texts call it: "Scene", "plot.cross", "cc.plot.cross".

    The functions of submodules have no short form here, since "faces" is mostly something else than a plot.
    """
    names: dict[str, str] = {}
    everything = [name for page in names_by_page().values() for name in page]
    # Where two names end alike, the one of fewer dots is what texts mean.
    for name in sorted(everything, key=lambda one: -one.count(".")):
        parts = name.split(".")
        inner = ".".join(parts[1:])
        names |= dict.fromkeys([name, inner, f"cc.{inner}"], name)
        if parts[-1][0].isupper():
            names[parts[-1]] = name
    return names
