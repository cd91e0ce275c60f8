"""Debian's Chromium, driven by playwright."""

import shutil

import pytest
from playwright.sync_api import sync_playwright


@pytest.fixture(scope="session")
def chromium():
    """One browser for the session."""
    path = shutil.which("chromium")
    assert path is not None, (
        "expected the program chromium; python3 scripts/system.py --browser installs it"
    )
    with sync_playwright() as playwright:
        # Chromium's own sandbox needs rights that containers do not have.
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield browser
        browser.close()


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
