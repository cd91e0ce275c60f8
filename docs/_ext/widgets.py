"""Leaves the states of widgets out of the pages: megabytes that only a script of others could use.

The picture beside a live view is what a reader of a page sees.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx


def forget_states(app: Sphinx, env: Any) -> list[str]:
    """Drop what myst-nb would write into each page."""
    for data in getattr(env, "nb_metadata", {}).values():
        data.get("js_files", {}).pop("ipywidgets_state", None)
    return []


def setup(app: Sphinx) -> dict[str, Any]:
    """Connect the step."""
    app.connect("env-updated", forget_states)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
