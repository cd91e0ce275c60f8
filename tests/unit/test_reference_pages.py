"""Every public name stands on exactly one page of the site's reference."""

import importlib
import inspect
import re
from collections import Counter

import pytest

import cubecam as cc
from tests.documents import ROOT

PAGES = sorted((ROOT / "docs" / "reference").glob("*.md"))
#: Modules whose `__all__` users may rely on.
MODULES = [
    "",
    "plot",
    "explore",
    "typing",
    "examples",
    "viewer",
    "optics",
    "navigation",
    "demo",
    "pictures",
    "doctor",
    "truth",
    "cluster",
]


def names_on(text):
    """The names below the directives ``api`` of a page, as a program imports them."""
    blocks = re.findall(r"^\.\. api::\n((?:   .*\n)*)", text, re.MULTILINE)
    return [f"cubecam.{name}" for block in blocks for name in block.split()]


def documented():
    return [name for page in PAGES for name in names_on(page.read_text(encoding="utf-8"))]


def found(name):
    """What a dotted name is; classes that only results have are in the compiled module."""
    parts = name.split(".")
    for count in range(len(parts) - 1, 0, -1):
        try:
            thing = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            thing = getattr(thing if hasattr(thing, part) else cc._core, part)
        return thing
    raise AssertionError(name)


def public():
    """Each public name with what it is."""
    for module in MODULES:
        path = f"cubecam.{module}".rstrip(".")
        home = importlib.import_module(path)
        for name in home.__all__:
            thing = getattr(home, name)
            if name != "__version__" and not inspect.ismodule(thing):
                yield f"{path}.{name}", thing


def missing(names):
    """Public names that no name of a list stands for, be it as another name or as a method of the same function."""
    things = [found(name) for name in names]
    known = {id(thing) for thing in things}
    known |= {
        id(inspect.unwrap(getattr(thing, name)))
        for thing in things
        if inspect.isclass(thing)
        for name in dir(thing)
        if callable(getattr(thing, name, None))
    }
    return [
        name
        for name, thing in public()
        if name not in names and id(thing) not in known and id(inspect.unwrap(thing)) not in known
    ]


def test_every_public_name_is_on_a_page():
    assert missing(documented()) == []


@pytest.mark.parametrize("name", ["cubecam.Scene", "cubecam.plot.cross", "cubecam.typing.Wrap"])
def test_a_name_that_is_left_out_is_missed(name):
    assert missing([other for other in documented() if other != name]) == [name]


def test_no_name_is_on_two_pages():
    assert [name for name, count in Counter(documented()).items() if count > 1] == []


@pytest.mark.parametrize("name", documented())
def test_a_documented_name_exists(name):
    assert found(name) is not None


def test_the_index_lists_every_page():
    index = (ROOT / "docs/reference/index.md").read_text(encoding="utf-8")
    block = re.findall(r"```\{toctree\}\n:hidden:\n\n(.*?)```", index, re.DOTALL)[0]
    listed = sorted(set(block.split()) - {"../conventions"})
    assert listed == [page.stem for page in PAGES if page.stem != "index"]
