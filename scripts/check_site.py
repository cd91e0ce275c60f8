"""Check the links of the built site without a network: `make docs` runs this after Sphinx.

    python scripts/check_site.py docs/_build/html

Every local link leads to a file and, with a #, to a name on that page; every page of the sources was written; a
lesson has its pictures; and no page loads a script, a style, a font or a picture from elsewhere. What is wrong is
printed, one line each.
"""

from __future__ import annotations

import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

#: What a page loads by itself, by the attribute that names it; of a <link> only some kinds.
_LOADS = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "video": "src",
    "link": "href",
}
_LINKS = {"a": "href", **_LOADS}
#: Kinds of <link> that name a page instead of loading something.
_NAMES = {"next", "prev", "search", "index", "canonical", "author", "copyright"}


class Page(HTMLParser):
    """What a page names: links with their lines, what it loads, and its anchors."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.links: list[tuple[int, str]] = []
        self.loads: list[tuple[int, str]] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Collect what one tag names."""
        values = dict(attrs)
        for key in ("id", "name"):
            if values.get(key):
                self.anchors.add(str(values[key]))
        target = values.get(_LINKS.get(tag, ""))
        if target is None:
            return
        row = self.getpos()[0]
        self.links.append((row, target))
        if tag in _LOADS and not _NAMES & set((values.get("rel") or "").split()):
            self.loads.append((row, target))


def problems(root: Path) -> list[str]:
    """List what is wrong in the pages below a folder."""
    pages = {
        path: Page(path.read_text(encoding="utf-8"))
        for path in sorted(root.rglob("*.html"))
        if "_static" not in path.relative_to(root).parts
    }
    if not pages:
        return [f"{root}: expected pages, got none"]
    found = []
    for path, page in pages.items():
        place = path.relative_to(root).as_posix()
        for row, target in page.loads:
            if urlsplit(target).netloc:
                found.append(f"{place}:{row}: loads {target} from elsewhere")
        for row, target in page.links:
            wrong = _wrong(path, target, root, pages)
            if wrong:
                found.append(f"{place}:{row}: {wrong}")
    return found + _styles(root)


def _wrong(path: Path, target: str, root: Path, pages: dict[Path, Page]) -> str:
    """Say what is wrong with a link; an empty text if nothing is."""
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return ""
    there = path.parent / unquote(parts.path) if parts.path else path
    there = Path(*there.parts).resolve()
    if there.is_dir():
        there = there / "index.html"
    if not there.is_relative_to(root.resolve()) or not there.is_file():
        return f"{target} leads to no file"
    page = pages.get(there)
    anchor = unquote(parts.fragment)
    if page is not None and anchor and anchor not in page.anchors:
        return f"{target}: the page has no place of this name"
    return ""


def _styles(root: Path) -> list[str]:
    """List styles that load something from elsewhere."""
    return [
        f"{path.relative_to(root).as_posix()}: loads something from elsewhere"
        for path in sorted(root.rglob("*.css"))
        for text in [path.read_text(encoding="utf-8").replace("'", "").replace('"', "")]
        if "url(http" in text or "url(//" in text or "@import http" in text
    ]


def unwritten(sources: Path, root: Path) -> list[str]:
    """List sources without a page: a build in several processes may lose some without an error."""
    skipped = {"_build", "_ext", "images"}
    return [
        f"{path.relative_to(sources).as_posix()}: no page was written"
        for ending in ("*.md", "*.ipynb", "*.rst")
        for path in sorted(sources.rglob(ending))
        if path.relative_to(sources).parts[0] not in skipped
        and not (path.relative_to(sources).parts[0] == "gallery" and path.suffix == ".ipynb")
        and not (root / path.relative_to(sources)).with_suffix(".html").is_file()
    ]


def without_pictures(lessons: Path, root: Path) -> list[str]:
    """List lessons whose page has fewer pictures than the notebook had when its outputs were committed."""
    found = []
    for path in sorted(lessons.glob("*.ipynb")):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        wanted = sum(
            any(kind.startswith("image/") for kind in output.get("data", {}))
            for cell in cells
            for output in cell.get("outputs", ())
        )
        page = root / "lessons" / f"{path.stem}.html"
        got = len(re.findall(r"<img[^>]*_images/", page.read_text(encoding="utf-8")))
        if got < wanted:
            found.append(f"lessons/{page.name}: expected {wanted} pictures, got {got}")
    return found


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    root = Path(arguments[0]).resolve()
    sources = root.parents[1]
    found = problems(root) + unwritten(sources, root)
    found += without_pictures(sources.parent / "notebooks", root)
    for line in found:
        print(line)
    pages = sum(1 for _ in root.rglob("*.html"))
    print(f"{pages} pages, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
