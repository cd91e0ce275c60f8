"""Runs the Python programs of documents: README.md and the pages of docs/howto."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def fenced(name, language):
    """The fenced blocks of one language in a document, in order."""
    return re.findall(rf"```{language}\n(.*?)```", text_of(name), flags=re.DOTALL)


def python_blocks(name):
    """The fenced Python blocks of a document, in order."""
    return fenced(name, "python")


def run_block(code, name, folder, monkeypatch, scope=None):
    """Run a block in a folder of its own; return its names, which a later block of the page gets as `scope`."""
    monkeypatch.chdir(folder)
    scope = {} if scope is None else scope
    exec(compile(code, name, "exec"), scope)
    return scope


def rows_below(name, head):
    """The cells of a document's table whose first line begins with `head`, row by row."""
    lines = text_of(name).splitlines()
    (start,) = (number for number, line in enumerate(lines) if line.startswith(head))
    rows = []
    for line in lines[start + 2 :]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip() for cell in line.strip("|").split("|")])
    return rows
