"""Debian's Chromium, driven by playwright."""

import pytest

from tests.chromium import headless_chromium


@pytest.fixture(scope="session")
def chromium():
    """One browser for the session."""
    with headless_chromium() as browser:
        yield browser


@pytest.fixture
def tab(chromium):
    """A tab of 600 x 400 pixels; an error in a script of the page fails the test."""
    context = chromium.new_context(viewport={"width": 600, "height": 400})
    page = context.new_page()
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    # A server that ends before its page does is part of some tests.
    page.on(
        "console",
        lambda line: (
            errors.append(line.text)
            if line.type == "error" and "ERR_CONNECTION_REFUSED" not in line.text
            else None
        ),
    )
    yield page
    context.close()
    assert errors == []
