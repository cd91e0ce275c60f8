"""Rules for all pages: short programs, an index that names each page, links that lead somewhere, small pictures."""

import re
from pathlib import Path

import pytest

from tests.documents import ROOT, python_blocks, text_of
from tests.howto.pages import EXPLANATION, HOWTO, PAGES, PROGRAMS

TESTS = "\n".join(
    path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*.py")
)


@pytest.mark.parametrize(
    ("folder", "names"), [("docs/howto", HOWTO), ("docs/explanation", EXPLANATION)]
)
def test_the_index_names_all_pages(folder, names):
    linked = re.findall(r"\]\((\w+\.md)\)", text_of(f"{folder}/README.md"))
    assert {f"{folder}/{name}" for name in linked} == set(names) - {f"{folder}/README.md"}


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_has_at_most_25_lines_and_runs(name):
    for code in python_blocks(name):
        assert len([line for line in code.splitlines() if line.strip()]) <= 25
    # A page whose programs are run by no test of its own would rot.
    assert f'"{name}"' in TESTS


@pytest.mark.parametrize("name", sorted(set(HOWTO) - {"docs/howto/README.md"}))
def test_a_how_to_page_has_code(name):
    assert "\n```" in text_of(name)


def test_every_picture_is_shown_by_a_page():
    shown = {
        name
        for page in PAGES
        for name in re.findall(r"images/((?:howto|why)-[\w.-]+)", text_of(page))
    }
    folder = ROOT / "docs/images"
    assert shown == {path.name for kind in ("howto-*", "why-*") for path in folder.glob(kind)}


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_to_files_and_pictures_are_small(name):
    text = re.sub(r"```.*?```", "", text_of(name), flags=re.DOTALL)
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
        path = (ROOT / name).parent / target
        assert path.exists(), target
        if path.suffix in (".png", ".jpg"):
            assert path.stat().st_size <= 200_000


@pytest.mark.parametrize("name", PAGES)
def test_links_to_headings_lead_to_headings(name):
    for target, heading in re.findall(r"\]\(([^)#:]*)#([^)]+)\)", text_of(name)):
        path = (ROOT / name).parent / target if target else ROOT / name
        headings = re.findall(r"^#+ (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        slugs = {
            re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
            for title in (title.replace("`", "") for title in headings)
        }
        assert heading in slugs, f"{target}#{heading}"
