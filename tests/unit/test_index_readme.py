"""The README on the page of a package index: whole links, or none."""

import os
import re
import subprocess
import sys
from email import message_from_string

import pytest

from tests.documents import ROOT, text_of
from tests.helpers import load_script

SCRIPT = load_script("index_readme")
dynamic_metadata, whole_links = SCRIPT.dynamic_metadata, SCRIPT.whole_links
ADDRESS = "https://example.org/someone/cubecam"


def relative(text):
    """What Markdown links to without an address; code does not count."""
    prose = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return [t for t in re.findall(r"\]\(([^)\s]+)\)", prose) if not re.match(r"[a-z]+:|#", t)]


def test_the_readme_itself_has_relative_links():
    assert len(relative(text_of("README.md"))) > 10


def test_links_and_pictures_get_the_address_and_the_tag():
    text = "![two balls](a/b.jpg) and [a page](docs/x.md#part), [here](#below), [there](https://w3.org)\n"
    assert whole_links(text, ADDRESS + "/", "1.2.3") == (
        f"![two balls]({ADDRESS}/raw/v1.2.3/a/b.jpg) and [a page]({ADDRESS}/blob/v1.2.3/docs/x.md#part), "
        "[here](#below), [there](https://w3.org)\n"
    )


def test_without_an_address_only_words_stay():
    text = "![two balls](a/b.jpg) and [a page](docs/x.md), [there](https://w3.org)\n"
    assert whole_links(text, "", "1.2.3") == "*two balls* and a page, [there](https://w3.org)\n"


def test_code_stays_as_it_is():
    text = "[a](b)\n```python\nx = {'[a](b)': 1}\n```\n[a](b)\n```sh\n# [a](b)\n```\n"
    got = whole_links(text, "", "1")
    assert got == "a\n```python\nx = {'[a](b)': 1}\n```\na\n```sh\n# [a](b)\n```\n"


def test_every_link_of_the_readme_leads_to_a_file():
    got = whole_links(text_of("README.md"), ADDRESS, "9")
    assert relative(got) == []
    targets = re.findall(rf"\({ADDRESS}/(?:blob|raw)/v9/([^)#]+)", got)
    assert len(targets) > 10
    for target in targets:
        assert (ROOT / target).exists(), target


def test_the_variable_comes_before_the_setting(monkeypatch):
    project = {"version": "1"}
    monkeypatch.setenv("CUBECAM_REPOSITORY", ADDRESS)
    text = dynamic_metadata({"repository": "https://example.org/other"}, project)["readme"]["text"]
    assert ADDRESS in text
    assert "example.org/other" not in text
    monkeypatch.delenv("CUBECAM_REPOSITORY")
    text = dynamic_metadata({"repository": "https://example.org/other"}, project)["readme"]["text"]
    assert "https://example.org/other/blob/v1/docs" in text


@pytest.mark.parametrize("address", ["example.org/cubecam", "http://example.org/x"])
def test_an_address_that_is_none_is_an_error(address, monkeypatch):
    monkeypatch.setenv("CUBECAM_REPOSITORY", address)
    with pytest.raises(ValueError, match="expected https://HOST/OWNER/NAME, got"):
        dynamic_metadata({}, {"version": "1"})


def test_another_key_is_an_error():
    with pytest.raises(ValueError, match="expected the key repository, got adress"):
        dynamic_metadata({"adress": ""}, {"version": "1"})


@pytest.mark.parametrize("address", ["", ADDRESS])
def test_a_build_has_no_relative_link(address, tmp_path):
    program = (
        "from scikit_build_core.build import prepare_metadata_for_build_wheel as prepare\n"
        f"prepare({str(tmp_path)!r})"
    )
    pytest.importorskip("scikit_build_core")  # an environment without the tools that build
    subprocess.run(
        [sys.executable, "-c", program],
        cwd=ROOT,
        env={**os.environ, "CUBECAM_REPOSITORY": address},
        check=True,
        capture_output=True,
    )
    (found,) = tmp_path.glob("*.dist-info/METADATA")
    message = message_from_string(found.read_text(encoding="utf-8"))
    assert message["Description-Content-Type"] == "text/markdown"
    text = message.get_payload()
    assert isinstance(text, str)
    assert "cubecam draws a scene into a cubemap" in text
    assert relative(text) == []
    assert (f"{ADDRESS}/raw/v" in text) == bool(address)
