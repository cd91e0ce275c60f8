"""The README for a package index, which shows no files of a repository: links and pictures with whole addresses.

`[[tool.dynamic-metadata]]` of pyproject.toml names this module, so that every build calls it. The address of the
repository comes from one of two places:

- the environment variable CUBECAM_REPOSITORY, which a release sets, for example "https://HOST/OWNER/cubecam";
- the key `repository` beside it in pyproject.toml.

Where neither has one, there is nothing to link to: the text of a link stays without the link, and the description of a
picture takes its place. So the page of an index never has a link that leads nowhere.

    python scripts/index_readme.py [ADDRESS]    print what an index would show
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

README = Path(__file__).resolve().parent.parent / "README.md"
VARIABLE = "CUBECAM_REPOSITORY"

_FENCED = re.compile(r"(^```.*?^```\n?)", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")


def whole_links(text: str, repository: str, version: str) -> str:
    """Give relative links of Markdown the address of the repository, at a version's tag; "" takes the links out."""

    def replace(match: re.Match[str]) -> str:
        picture, words, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        if not repository:
            return f"*{words}*" if picture else words
        # The words of GitHub, which GitLab and Gitea understand too: the page of a file, and the file itself.
        kind = "raw" if picture else "blob"
        return f"{picture}[{words}]({repository.rstrip('/')}/{kind}/v{version}/{target})"

    parts = _FENCED.split(text)  # code is at the odd places
    return "".join(part if i % 2 else _LINK.sub(replace, part) for i, part in enumerate(parts))


def dynamic_metadata(settings: Mapping[str, Any], project: Mapping[str, Any]) -> dict[str, Any]:
    """Give what `readme` of pyproject.toml would be; the build calls this."""
    unknown = sorted(set(settings) - {"repository"})
    if unknown:
        raise ValueError(f"expected the key repository, got {', '.join(unknown)}")
    repository = os.environ.get(VARIABLE) or str(settings.get("repository", ""))
    if repository and not repository.startswith("https://"):
        raise ValueError(f"{VARIABLE}: expected https://HOST/OWNER/NAME, got {repository}")
    text = whole_links(README.read_text(encoding="utf-8"), repository, str(project["version"]))
    return {"readme": {"content-type": "text/markdown", "text": text}}


if __name__ == "__main__":
    told = sys.argv[1] if len(sys.argv) > 1 else os.environ.get(VARIABLE, "")
    print(whole_links(README.read_text(encoding="utf-8"), told, "X.Y.Z"), end="")
