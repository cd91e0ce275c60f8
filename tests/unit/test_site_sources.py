"""What the site is made of: links that are turned to its pages, and the programs and loops of the gallery."""

import importlib
import io
import re
import sys

import numpy as np
import pytest
from PIL import Image

from cubecam import examples
from tests.documents import ROOT

DOCS = ROOT / "docs"
URL = "https://host/owner/cubecam/blob/v1"


@pytest.fixture(scope="module")
def extension():
    """A module of docs/_ext, by its name; those that need Sphinx are not loaded here."""
    sys.path.insert(0, str(DOCS))
    yield lambda name: importlib.import_module(f"_ext.{name}")
    sys.path.remove(str(DOCS))


@pytest.fixture
def turned(extension):
    repository = extension("repository")

    def turn(text, source="docs/howto/three_js.md", page=None, url=""):
        place = DOCS / page if page else ROOT / source
        return repository.turned_links(text, ROOT / source, place, url)

    return turn


@pytest.mark.parametrize(
    ("link", "expected"),
    [
        ("../conventions.md#numbers", "../conventions.md#numbers"),
        ("../../CHANGELOG.md", "../project/changelog.md"),
        ("../../README.md", "../index.md"),
        ("../../README.md#explore", "../project/readme.md#explore"),
        (
            "../../notebooks/03-reflection-and-refraction.ipynb",
            "../lessons/03-reflection-and-refraction.ipynb",
        ),
        ("../../notebooks", "../lessons.md"),
        ("../adr", "../adr/README.md"),
        ("https://w3.org/a", "https://w3.org/a"),
        ("#below", "#below"),
        ("nothing.md", "nothing.md"),
    ],
)
def test_a_link_leads_to_the_page_of_the_site(link, expected, turned):
    assert turned(f"See [this `one`]({link}), and") == f"See [this `one`]({expected}), and"


def test_the_words_of_a_link_may_be_on_two_lines(turned):
    assert turned("[the\n  log](../../CHANGELOG.md)") == "[the\n  log](../project/changelog.md)"
    apart = "[ is open\n\nand ](../../CHANGELOG.md)"  # two paragraphs are no link
    assert turned(apart) == apart


def test_no_document_of_the_root_has_a_link_that_leads_nowhere(extension):
    """Pages that the build copies or runs are not there yet."""
    repository = extension("repository")
    made = {DOCS / place for place in repository.COPIED.values()}
    made |= {DOCS / "lessons" / path.name for path in (ROOT / "notebooks").glob("*.ipynb")}
    for name, place in repository.COPIED.items():
        text = repository.turned_links(
            (ROOT / name).read_text(encoding="utf-8"), ROOT / name, DOCS / place
        )
        prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
        for target in re.findall(r"\]\(([^)\s#]+)[^)\s]*\)", prose):
            there = ((DOCS / place).parent / target).resolve()  # its folder may not be there yet
            known = there in made or there.exists() or re.match("[a-z]+:", target)
            assert known, f"{name}: {target}"


def test_a_document_of_the_root_gets_links_from_its_new_place(turned):
    text = "[a](docs/gpu.md), [b](SECURITY.md), ![c](docs/images/frame.jpg)"
    assert turned(text, "CONTRIBUTING.md", "project/contributing.md") == (
        "[a](../gpu.md), [b](security_policy.md), ![c](../images/frame.jpg)"
    )


def test_a_source_file_is_a_link_only_where_the_repository_is_known(turned):
    text = "[stubs](../../python/cubecam/_core.pyi)"
    assert turned(text) == "stubs"
    assert turned(text, url=URL) == f"[stubs]({URL}/python/cubecam/_core.pyi)"


def test_a_link_may_begin_on_one_line_and_end_on_the_next(turned):
    assert turned("[a\nb](../../CHANGELOG.md)\n") == "[a\nb](../project/changelog.md)\n"


def test_the_pages_of_a_folder_stand_in_the_order_of_its_index(extension):
    listed = extension("repository").listed_pages
    text = "[b](b.md), [a\nb](a-1.md#part), [again](b.md), [c](../c.md), ![d](d.png), [e](https://w3.org/e.md)"
    assert listed(text) == ["b", "a-1"]
    howto = listed((DOCS / "howto/README.md").read_text(encoding="utf-8"))
    assert howto[0] == "servers_and_docker"
    assert set(howto) == {path.stem for path in (DOCS / "howto").glob("*.md")} - {"README"}


def test_code_is_left_alone(turned):
    text = "```md\n[a](../../CHANGELOG.md)\n```\n[a](../../CHANGELOG.md)"
    assert turned(text) == "```md\n[a](../../CHANGELOG.md)\n```\n[a](../project/changelog.md)"


@pytest.mark.slow
@pytest.mark.parametrize("name", examples.NAMES)
def test_each_example_gives_a_program(name, extension):
    text = extension("gallery").script_of(name)
    compile(text, name, "exec")
    module = examples.load(name)
    assert text.splitlines()[1].startswith(module.PROGRAM + " ")
    assert module.TITLE in text
    assert ("loop = [" in text) == (module.FRAMES > 1)
    assert (ROOT / f"python/cubecam/examples/{name}.py").exists()


@pytest.fixture
def film(extension, monkeypatch):
    """Encode six pictures of noise, of at most so many bytes."""
    gallery = extension("gallery")
    noise = np.random.default_rng(1).integers(0, 255, (6, 60, 80, 3), dtype=np.uint8)

    def encode(most):
        monkeypatch.setattr(gallery, "MOST", most)
        return gallery.animation(list(noise), 2)

    return encode


def test_a_loop_is_as_small_as_its_limit(film):
    for most, height in ((1_000_000, 60), (12_500, 48)):
        data = film(most)
        assert len(data) <= most
        with Image.open(io.BytesIO(data)) as made:
            assert (made.n_frames, made.height) == (6, height)
            made.seek(1)
            made.load()
            assert made.info["duration"] == 80


def test_a_loop_that_cannot_be_small_is_an_error(film):
    with pytest.raises(ValueError, match=r"expected an animation of 500 bytes at most, got \d+"):
        film(500)
