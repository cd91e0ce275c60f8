"""Debian's Chromium, driven by playwright."""

import contextlib
import shutil


@contextlib.contextmanager
def headless_chromium(*arguments):
    """A browser with further arguments of the command line."""
    from playwright.sync_api import sync_playwright

    path = shutil.which("chromium")
    assert path is not None, (
        "expected the program chromium; python3 scripts/system.py --browser installs it"
    )
    with sync_playwright() as playwright:
        # Chromium's own sandbox needs rights that containers do not have.
        browser = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox", *arguments]
        )
        yield browser
        browser.close()
