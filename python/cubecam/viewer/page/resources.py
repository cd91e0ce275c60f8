"""The files of the page, read once: a request can name an entry of this table and nothing else."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import NamedTuple

__all__ = ["Resource", "login_page", "resources"]


class Resource(NamedTuple):
    """A file as it is sent."""

    content_type: str
    body: bytes


_OWN = {
    "": ("index.html", "text/html; charset=utf-8"),
    "page.js": ("page.js", "text/javascript; charset=utf-8"),
    "panel.js": ("panel.js", "text/javascript; charset=utf-8"),
    "page.css": ("page.css", "text/css; charset=utf-8"),
    "icon.svg": ("icon.svg", "image/svg+xml"),
}


@cache
def resources() -> dict[bytes, Resource]:
    """Give what a page consists of, by the last part of its address."""
    found = {
        name.encode(): Resource(kind, files(__package__).joinpath(file).read_bytes())
        for name, (file, kind) in _OWN.items()
    }
    events = files("rendercanvas.core").joinpath("renderview.js").read_bytes()
    found[b"renderview.js"] = Resource("text/javascript; charset=utf-8", events)
    return found


def login_page(wrong: bool) -> bytes:
    """Give the form for the password."""
    text = files(__package__).joinpath("login.html").read_text(encoding="utf-8")
    return text.replace("{message}", "The password is wrong." if wrong else "").encode()
