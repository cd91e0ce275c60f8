"""Turns docstrings in numpydoc's style into reStructuredText.

Sphinx's own napoleon makes a link of each word of a type, also of "(3,)" and of "array_like"; here only names that the
reference has become links, so that a link that leads nowhere is an error of the text.
"""

from __future__ import annotations

import re
import textwrap

from numpydoc.docscrape import NumpyDocString, Parameter

from .topics import known_names

_FIELDS = ("Parameters", "Attributes", "Returns", "Yields", "Raises", "Warns")
#: The length of a vector; reStructuredText would replace it.
_LENGTH = re.compile(r"(?<![`\w])\|(\w+)\|(?![`\w])")
_PAGE = re.compile(r"(?<![`/\w])docs/([\w/]+)\.md\b")


def to_rst(doc: str, *, leave_out: tuple[str, ...] = ()) -> str:
    """Give the text of a docstring.

    leave_out : names of sections, such as "Attributes", that stand elsewhere.
    """
    parsed = NumpyDocString(doc)
    parts = ["\n".join(parsed["Summary"]), "\n".join(parsed["Extended Summary"])]
    for title in _FIELDS:
        rows = parsed[title]
        if rows and title not in leave_out:
            parts.append(f":{title}:\n" + textwrap.indent(_rows(rows, title), "    "))
    for title in ("See Also", "Notes", "References", "Examples"):
        text = _section(parsed, title)
        if text:
            parts.append(f".. rubric:: {title}\n\n{text}")
    return _with_pages("\n\n".join(part for part in parts if part))


def _section(parsed: NumpyDocString, title: str) -> str:
    if title != "See Also":
        return "\n".join(parsed[title])
    rows = []
    for names, text in parsed[title]:
        linked = ", ".join(f"`{name}`" for name, _ in names)
        rows.append(f"{linked}: {' '.join(text)}" if text else linked)
    return "\n\n".join(rows)


def _rows(rows: list[Parameter], title: str) -> str:
    """Write a definition list: a name and a type, and what they mean."""
    written = []
    for name, kind, text in rows:
        kinds = linked_type(kind)
        if title in ("Parameters", "Attributes"):
            head = f"**{escaped(name)}**" + (f" : {kinds}" if kind else "")
        elif name:
            head = f"**{escaped(name)}** : {kinds}"
        else:
            head = kinds
        written.append(head + ("\n" + textwrap.indent("\n".join(text), "    ") if text else ""))
    return "\n".join(written) if all(row[2] for row in rows) else "\n\n".join(written)


def linked_type(text: str) -> str:
    """Write the words of a type; those that are names of the reference become links."""
    parts = re.split(r"(\"[^\"]*\"|``.*?``|[A-Za-z_][\w.]*)", text)
    found = []
    for part in parts:
        name = known_names().get(part) if part[:1].isupper() else None
        if name:
            found.append(f"\\ :py:obj:`~{name}`\\ ")
        elif part.startswith("``"):
            found.append(part)
        else:
            found.append(escaped(part))
    return "".join(found).strip()


def escaped(text: str) -> str:
    """Take the meaning of markup from a text."""
    return re.sub(r"([*`|_\\])", r"\\\1", text)


def _with_pages(text: str) -> str:
    """Link the pages that docstrings name as files of the repository, and keep ``|v|`` as it is."""
    text = _PAGE.sub(lambda match: f":doc:`/{match[1]}`", text)
    return _LENGTH.sub(r"\\|\1\\|", text)
