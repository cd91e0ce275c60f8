"""Brings what lies outside of docs/ into the site, and keeps links right in the site and in the repository.

Before the build, lessons and documents of the repository's root are copied into folders that git ignores. Links lead to
where a file is in the repository; while Sphinx reads a page they are turned to where the same file is in the site.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import cubecam

if TYPE_CHECKING:  # the functions are tested without Sphinx
    from sphinx.application import Sphinx
    from sphinx.config import Config

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"

#: Documents outside of docs/, and their pages.
COPIED = {
    "README.md": "project/readme.md",
    "CHANGELOG.md": "project/changelog.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "SECURITY.md": "project/security_policy.md",
    "python/cubecam/data/CREDITS.md": "project/credits.md",
}
#: What has another place in the site, or is shown by another page.
PAGES = {**COPIED, "notebooks": "lessons.md"}
#: Folders whose README.md is their page in the site, and which pages are its children there, besides those of the
#: folder that it links to. Sphinx reports a page that no index names.
FOLDERS: dict[str, list[str]] = {"howto": [], "explanation": ["/gpu", "/security"], "adr": []}

_FENCE = re.compile(r"^( *)(```+|~~~+)")
#: The words may go on in the next line, and hold other brackets.
_LINK = re.compile(r"(!?)\[((?:[^\[\]\n]|\n(?!\s*\n)|\[[^\[\]]*\])*)\]\(([^()\s]+)\)")


def turned_links(text: str, source: Path, page: Path, url: str = "") -> str:
    """Turn the links of a document to the pages of the site.

    source, page : the file in the repository, and its place below docs/.
    url : where the repository's files are shown, such as "https://HOST/OWNER/cubecam/blob/main"; without one, a link
        to a file that the site does not have becomes plain text.
    """
    return "\n".join(
        part if code else _LINK.sub(lambda match: _turned(match, source, page, url), part)
        for code, part in _parts(text)
    )


def _parts(text: str) -> list[tuple[bool, str]]:
    """Split Markdown into blocks of code, which are left alone, and what is between them."""
    parts: list[tuple[bool, list[str]]] = []
    fence = ""
    for line in text.split("\n"):
        mark = _FENCE.match(line)
        code = bool(mark or fence)
        if mark and not fence:
            fence = mark[2]
        elif mark and mark[2].startswith(fence) and line.strip() == mark[2]:
            fence = ""
        if not parts or parts[-1][0] != code:
            parts.append((code, []))
        parts[-1][1].append(line)
    return [(code, "\n".join(lines)) for code, lines in parts]


def _turned(match: re.Match[str], source: Path, page: Path, url: str) -> str:
    mark, words, target = match.groups()
    path, hash_, anchor = target.partition("#")
    if not path or re.match(r"[a-z]+:", path):
        return match[0]
    there = (source.parent / path).resolve()
    if not there.exists() or not there.is_relative_to(ROOT):
        return match[0]  # Sphinx reports it
    place = place_in_site(there)
    if place == COPIED["README.md"] and not anchor:
        place = "index.md"
    if place is not None:
        path = os.path.relpath(DOCS / place, page.parent)
        return f"{mark}[{words}]({path}{hash_}{anchor})"
    return f"[{words}]({url}/{there.relative_to(ROOT).as_posix()})" if url else words


def place_in_site(path: Path) -> str | None:
    """Give the place below docs/ of a file or a folder of the repository; None if the site does not have it."""
    name = path.relative_to(ROOT).as_posix()
    if name in PAGES:
        return PAGES[name]
    if name.startswith("notebooks/") and path.suffix == ".ipynb":
        return f"lessons/{path.name}"
    if path.is_relative_to(DOCS):
        inner = path.relative_to(DOCS).as_posix()
        return f"{inner}/README.md" if path.is_dir() else inner
    return None


def copy_sources(app: Sphinx, config: Config) -> None:
    """Copy documents and lessons into the source folder, each only if it has changed."""
    url = config.cubecam_repository
    for name, place in COPIED.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        write_changed(DOCS / place, turned_links(text, ROOT / name, DOCS / place, url))
    wanted = set()
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        notebook = json.loads(path.read_text(encoding="utf-8"))
        target = DOCS / "lessons" / path.name
        for cell in notebook["cells"]:
            if cell["cell_type"] == "markdown":
                cell["source"] = turned_links("".join(cell["source"]), path, target, url)
            else:  # the site's outputs are those of its own build
                cell["outputs"], cell["execution_count"] = [], None
        write_changed(target, json.dumps(notebook))
        wanted.add(path.name)
    for path in (DOCS / "lessons").glob("*.ipynb"):
        if path.name not in wanted:
            path.unlink()


def write_changed(path: Path, text: str) -> None:
    """Write a file, but for one that holds this text already: Sphinx would read it again."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")


def turn_page(app: Sphinx, docname: str, source: list[str]) -> None:
    """Turn the links of a page of docs/, and give an index of a folder its children."""
    path = app.env.doc2path(docname)
    page = Path(path)
    if page.suffix != ".md" or page.relative_to(DOCS).as_posix() in COPIED.values():
        return
    source[0] = turned_links(source[0], page, page, app.config.cubecam_repository)
    folder, _, name = docname.partition("/")
    if folder in FOLDERS and name == "README":
        children = "\n".join([*listed_pages(source[0]), *FOLDERS[folder]])
        source[0] += f"\n\n```{{toctree}}\n:hidden:\n\n{children}\n```\n"


def listed_pages(text: str) -> list[str]:
    """Give the names of the pages of its own folder that an index links to, in its order."""
    targets = [match[3].partition("#")[0] for match in _LINK.finditer(text)]
    own = [target.removesuffix(".md") for target in targets if re.fullmatch(r"[\w-]+\.md", target)]
    return list(dict.fromkeys(own))


def files_url() -> str:
    """Give the address of the repository's files; empty if pyproject.toml and the environment name none."""
    settings = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    found = re.search(r'^repository = "(.+)"', settings, re.MULTILINE)
    address = os.environ.get("CUBECAM_REPOSITORY") or (found[1] if found else "")
    return f"{address.rstrip('/')}/blob/v{cubecam.__version__}" if address else ""


def package_hash() -> str:
    """Give a hash of the installed package: with another one, everything that runs cubecam is built again."""
    digest = hashlib.sha256()
    package = Path(cubecam.__file__).parent
    for path in sorted(package.rglob("*")):
        if path.is_file() and path.suffix != ".pyc":
            digest.update(path.relative_to(package).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect both steps."""
    app.add_config_value("cubecam_repository", "", "env", str)
    app.add_config_value("cubecam_hash", "", "env", str)
    app.connect("config-inited", copy_sources)
    app.connect("source-read", turn_page)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
