"""Open an address in the browser without showing it to other users of this machine."""

from __future__ import annotations

import contextlib
import html
import os
import tempfile
import webbrowser
from collections.abc import Iterator
from pathlib import Path

__all__ = ["open_browser"]

_PAGE = """<!DOCTYPE html>
<meta charset="utf-8"><meta name="referrer" content="no-referrer"><title>cubecam</title>
<meta http-equiv="refresh" content="0; url={url}"><a href="{url}">cubecam</a>
"""


@contextlib.contextmanager
def open_browser(url: str) -> Iterator[None]:
    """Open an address; it stays readable for this user alone until the body ends.

    All users of a machine see the arguments of all processes, and the address holds the token. The browser gets the
    name of a file that leads on to the address.
    """
    handle, name = tempfile.mkstemp(
        prefix="cubecam-", suffix=".html"
    )  # readable by its owner alone
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(_PAGE.format(url=html.escape(url)))
        with contextlib.suppress(Exception):  # no browser is no error: the address was printed
            webbrowser.open(Path(name).as_uri())
        yield
    finally:
        Path(name).unlink(missing_ok=True)
