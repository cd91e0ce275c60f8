"""scripts/check_site.py finds links that lead nowhere, and what a page loads from elsewhere."""

import json

import pytest

from tests.helpers import load_script


@pytest.fixture(scope="module")
def script():
    return load_script("check_site")


@pytest.fixture
def site(tmp_path):
    """A site of two pages without a fault, in the place where `make docs` writes it."""
    root = tmp_path / "docs" / "_build" / "html"
    (root / "howto").mkdir(parents=True)
    (root / "picture.png").write_bytes(b"")
    (root / "index.html").write_text('<a href="howto/a.html#one">a</a><img src="picture.png">')
    (root / "howto" / "a.html").write_text('<h1 id="one">A</h1><a href="../">home</a>')
    return root


def test_a_site_without_a_fault(script, site):
    assert script.problems(site) == []


@pytest.mark.parametrize(
    ("html", "words"),
    [
        ('<a href="b.html">', "b.html leads to no file"),
        ('<a href="howto/a.html#two">', "howto/a.html#two: the page has no place of this name"),
        ('<a href="#here">', "#here: the page has no place of this name"),
        ('<img src="other.png">', "other.png leads to no file"),
        ('<a href="../../../secret.txt">', "../../../secret.txt leads to no file"),
        ('<script src="https://host/a.js">', "loads https://host/a.js from elsewhere"),
        ('<link rel="stylesheet" href="//host/a.css">', "loads //host/a.css from elsewhere"),
    ],
)
def test_a_fault_is_found(html, words, script, site):
    (site.parent.parent.parent / "secret.txt").write_text("")
    (site / "index.html").write_text(html)
    assert script.problems(site) == [f"index.html:1: {words}"]


@pytest.mark.parametrize(
    "html",
    [
        '<a href="https://example.org/x">',
        '<a href="mailto:a@example.org">',
        '<link rel="canonical" href="https://host/index.html">',
    ],
)
def test_links_to_elsewhere_are_left_alone(html, script, site):
    (site / "index.html").write_text(html)
    assert script.problems(site) == []


def test_a_style_that_loads_a_font(script, site):
    (site / "site.css").write_text("@font-face { src: url('https://host/a.woff2') }")
    assert script.problems(site) == ["site.css: loads something from elsewhere"]


def test_an_empty_folder_is_no_site(script, tmp_path):
    assert script.problems(tmp_path) == [f"{tmp_path}: expected pages, got none"]


def test_a_lesson_without_its_pictures(script, site, tmp_path):
    outputs = [{"data": {"image/png": ""}}, {"data": {"text/plain": ""}}, {"text": ""}]
    (tmp_path / "01.ipynb").write_text(json.dumps({"cells": [{"outputs": outputs}, {}]}))
    (site / "lessons").mkdir()
    page = site / "lessons" / "01.html"
    page.write_text('<img src="../_images/a.png">')
    assert script.without_pictures(tmp_path, site) == []
    page.write_text('<img src="../_static/logo.svg">')
    assert script.without_pictures(tmp_path, site) == [
        "lessons/01.html: expected 1 pictures, got 0"
    ]


def test_a_source_without_a_page(script, site):
    sources = site.parent.parent
    (sources / "index.md").write_text("")
    (sources / "lost.md").write_text("")
    (sources / "_ext").mkdir()
    (sources / "_ext" / "notes.md").write_text("")
    assert script.unwritten(sources, site) == ["lost.md: no page was written"]
