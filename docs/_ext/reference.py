"""The directive ``api``, which documents the names below it, and ``api-index``, which lists all of them by page."""

from __future__ import annotations

import textwrap
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole

from . import sources
from .docstrings import linked_type, to_rst
from .sources import Item
from .topics import full_name, known_names, names_by_page


def entry(item: Item) -> str:
    """Write a name of a module with its signature, its docstring and its members."""
    return f".. py:currentmodule:: {item.name.rpartition('.')[0]}\n\n" + _entry(item)


def _entry(item: Item) -> str:
    lines = [_head(item)]
    lines += _options(item)
    body = []
    if item.bases:
        body.append("Base: " + ", ".join(f":py:obj:`~{base}`" for base in item.bases) + ".")
    overloads = [member for member in item.members if member.kind == "overload"]
    if overloads:
        body.append(_overloads(overloads))
    elif item.doc:
        left_out = ("Attributes",) if item.members else ()
        body.append(to_rst(item.doc, leave_out=left_out))
    if item.kind == "type":
        body.append(_choices(item.value))
    members = [member for member in item.members if member.kind != "overload"]
    body += [_entry(member) for member in sorted(members, key=_order)]
    text = "\n\n".join(body)
    return "\n".join(lines) + "\n\n" + textwrap.indent(text, "   ") + "\n"


def _head(item: Item) -> str:
    heads = item.signatures or [""]
    head = f".. py:{item.kind}:: "
    return head + ("\n" + " " * len(head)).join(f"{item.short}{one}" for one in heads)


def _options(item: Item) -> list[str]:
    options = []
    if item.type:
        options.append(f"   :type: {item.type}")
    if item.kind == "attribute" and item.value:
        options.append(f"   :value: {item.value}")
    if item.kind == "data" and item.value:
        options.append(f"   :value: {item.value}")
    if item.static:
        options.append("   :staticmethod:")
    if item.classmethod:
        options.append("   :classmethod:")
    return options


def _order(member: Item) -> tuple[int, str]:
    """Sort constructors first, then properties, methods and operators by name; values of enumerations stay in order."""
    if member.kind == "attribute":
        return (0, "")
    if member.short.startswith("__"):
        return (4, member.short)
    kinds = 1 if member.static or member.classmethod else 2 if member.kind == "property" else 3
    return (kinds, member.short)


def _overloads(found: list[Item]) -> str:
    """Write the docstrings of overloads, each below its own signature."""
    parts = []
    for one in found:
        parts.append(f".. rubric:: {one.short}\\ {_code(one.signatures[0])}\n   :class: overload")
        parts.append(to_rst(one.doc))
    return "\n\n".join(parts)


def _code(signature: str) -> str:
    names = [part.strip() for part in _split(signature)]
    return "(" + ", ".join(names).replace("*", r"\*") + ")"


def _split(signature: str) -> list[str]:
    """Give the names of a signature's parameters, without types and defaults."""
    inner, depth, parts, start = signature[1:], 0, [], 0
    for index, letter in enumerate(inner):
        if letter in "([{":
            depth += 1
        elif letter in ")]}":
            depth -= 1
        if (letter == "," and depth == 0) or depth < 0:
            parts.append(inner[start:index].partition(":")[0].partition("=")[0])
            start = index + 1
        if depth < 0:
            break
    return [part for part in parts if part.strip()]


def _choices(value: str) -> str:
    if value.startswith("Literal["):
        inner = value.removeprefix("Literal[").removesuffix("]")
        words = [word.strip() for word in inner.split(",")]
        return (
            "One of "
            + ", ".join(
                f"``{word}``"
                if word.startswith(("'", '"'))
                else linked_type(word.rpartition(".")[2])
                for word in words
            ).replace("'", '"')
            + "."
        )
    return f"The type {linked_type(value)}."


class Api(Directive):
    """Documents each name of its content."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Parse what `entry` writes for each name."""
        text = "\n".join(
            entry(sources.item(full_name(name))) for name in " ".join(self.content).split()
        )
        lines = StringList(text.splitlines(), source="the docstrings of cubecam")
        node = nodes.container(classes=["api"])
        self.state.nested_parse(lines, self.content_offset, node)
        return [*node.children]


class ApiIndex(Directive):
    """Lists the names of all pages, each page with its title."""

    def run(self) -> list[nodes.Node]:
        """Parse one paragraph for each page."""
        lines = []
        for page, names in names_by_page().items():
            if names:
                links = ", ".join(
                    f":py:obj:`{name.removeprefix('cubecam.')} <{name}>`" for name in names
                )
                lines += [f":doc:`/reference/{page}`", f"   {links}", ""]
        node = nodes.container(classes=["api-index"])
        self.state.nested_parse(StringList(lines, source="api-index"), self.content_offset, node)
        return [node]


class NameRole(SphinxRole):
    """Single backticks in docstrings: a link if the reference has the name, else code."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Look up the name, first in the class that is being described."""
        name = self._full_name()
        if name is None:
            return [nodes.literal(self.rawtext, self.text)], []
        return self._link(name)

    def _full_name(self) -> str | None:
        text = self.text.removesuffix("()")
        module = self.env.ref_context.get("py:module") or "cubecam"
        kind = self.env.ref_context.get("py:class") or ""
        head, _, rest = text.rpartition(".")
        for owner, member in (
            (f"{module}.{kind}", text),
            (f"{module}.{text}", ""),
            (text, ""),
            (head, rest),
        ):
            name = known_names().get(owner)
            if name is not None and not member:
                return name
            if name is not None and any(one.short == member for one in sources.item(name).members):
                return f"{name}.{member}"
        return None

    def _link(self, name: str) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        role: Any = self.env.get_domain("py").role("obj")
        made, messages = role("obj", "", f"{self.text} <{name}>", self.lineno, self.inliner)
        return made, messages


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives and the role."""
    app.add_directive("api", Api)
    app.add_directive("api-index", ApiIndex)
    app.add_role("name", NameRole())
    return {"parallel_read_safe": True, "parallel_write_safe": True}
