"""The directive ``commands``: a section for each command of `cubecam`, made of what its --help says."""

from __future__ import annotations

import re
from typing import Any

import click
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx

from cubecam.cli import app as cubecam_app
from cubecam.cli.help import rows_by_title

from .docstrings import escaped

_EXAMPLES = re.compile(r"\bExamples?: ")


def text_of(program: str, command: click.Command) -> str:
    """Write what a command does, how it is called, and its parameters in groups."""
    context = click.Context(command, info_name=program)
    usage = " ".join([program, *command.collect_usage_pieces(context)])
    parts = [f".. program:: {program}", *_paragraphs(command.help or "")]
    parts.append(f".. code-block:: text\n\n   {usage}")
    for title, rows in rows_by_title(command.get_params(context)).items():
        parts.append(f".. rubric:: {title}")
        for names, words in rows:
            if names.startswith("-"):
                parts.append(f".. option:: {names}\n\n   {escaped(words)}")
            else:
                parts.append(f"``{names}``\n   {escaped(words)}")
    return "\n\n".join(parts)


def _paragraphs(text: str) -> list[str]:
    """Split the help; the commands after the word Examples become code."""
    before, *after = _EXAMPLES.split(text, maxsplit=1)
    parts = [escaped(" ".join(part.split())) for part in before.split("\n\n") if part.strip()]
    if after:
        lines = [line.strip() for line in " ".join(after[0].split()).split(";")]
        parts.append(".. code-block:: sh\n\n" + "\n".join(f"   {line}" for line in lines))
    return parts


class Commands(Directive):
    """Documents the program and all of its commands."""

    def run(self) -> list[nodes.Node]:
        """Make a section for each."""
        everything = {"cubecam": cubecam_app} | {
            f"cubecam {name}": command for name, command in cubecam_app.commands.items()
        }
        return [self._section(program, command) for program, command in everything.items()]

    def _section(self, program: str, command: click.Command) -> nodes.section:
        name = program.replace(" ", "-")
        section = nodes.section(ids=[name], names=[name])
        section += nodes.title(program, "", nodes.literal(program, program))
        lines = StringList(text_of(program, command).splitlines(), source="cubecam --help")
        self.state.nested_parse(lines, self.content_offset, section)
        self.state.document.note_explicit_target(section)
        return section


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
