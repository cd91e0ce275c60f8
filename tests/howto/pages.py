"""What the pages hold, read from their text."""

import re

from tests.documents import ROOT, fenced, python_blocks

HOWTO = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs/howto").glob("*.md"))
EXPLANATION = sorted(
    path.relative_to(ROOT).as_posix() for path in (ROOT / "docs/explanation").glob("*.md")
)
PAGES = HOWTO + EXPLANATION
PROGRAMS = [name for name in PAGES if python_blocks(name)]
SIX = ("px", "nx", "py", "ny", "pz", "nz")


def printed(name):
    """What a page says that its programs print."""
    return fenced(name, "text")[0]


def written(name):
    """The files and folders that the programs of a page write, as their code names them."""
    code = "\n".join(python_blocks(name))
    plain = re.findall(r'(?:save\w*|open_group|to_zarr|mkdir|write_text|Path)\("([^"]+)"', code)
    plain += re.findall(r'capture_to_zarr\([^"]*"([^"]+)"', code)
    folders = re.findall(r'save_for\("\w+", "([^"]+)"', code)
    named = set(folders) | (set(plain) - set(re.findall(r'save_for\("(\w+)"', code)))
    for path in [path for path in named if "{face}" in path]:
        named.remove(path)
        named |= {path.format(face=face) for face in SIX}
    return {path.split("/")[0] for path in named}
