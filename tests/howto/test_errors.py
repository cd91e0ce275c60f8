"""docs/howto/errors.md: each program raises the message that the page shows after it."""

import re
import subprocess
import sys
import warnings

import pytest

import cubecam as cc
from tests.documents import run_block, text_of

NAME = "docs/howto/errors.md"
CASES = re.findall(
    r"^### (.+?)$|```python\n(.*?)```\n\n```text\n(.*?)```", text_of(NAME), re.MULTILINE | re.DOTALL
)


def _cases():
    """The programs with their messages; those without a heading of their own have that of the last one."""
    title = ""
    for heading, code, message in CASES:
        title = heading or title
        if code:
            llvmpipe = pytest.mark.llvmpipe("another driver may take this source")
            marks = [llvmpipe] if "2147483647" in code else []
            yield pytest.param(code, message, id=title.lower().replace(" ", "-"), marks=marks)


ALL = list(_cases())


def pattern(message):
    """What the page says, with `...` for anything."""
    return re.escape(message.strip()).replace(r"\.\.\.", ".*")


@pytest.mark.parametrize(("code", "message"), ALL)
def test_the_program_raises_the_message(code, message, tmp_path, monkeypatch):
    # What changes the process for good, or depends on its past, has a process of its own.
    if re.search(r"^import (os|multiprocessing|resource)$", code, re.MULTILINE):
        script = tmp_path / "program.py"
        script.write_text(code, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=120
        )
        assert done.returncode == 1
        said = re.sub(r"\ncubecam\.", "\n", done.stderr)
        assert re.search(rf"^{pattern(message)}\s*\Z", said, re.DOTALL | re.MULTILINE), said
        return
    with warnings.catch_warnings(), pytest.raises(Exception) as raised:  # noqa: PT011
        run_block(code, NAME, tmp_path, monkeypatch)
    said = f"{raised.type.__name__}: {raised.value}"
    assert re.fullmatch(pattern(message), said.strip(), re.DOTALL), said


def test_every_program_has_its_message():
    text = text_of(NAME)
    assert len(ALL) == text.count("```python") == text.count("```text") > 15


def test_it_names_every_class_of_error():
    classes = {
        name
        for name, value in vars(cc).items()
        if isinstance(value, type) and issubclass(value, cc.Error)
    }
    assert classes <= set(re.findall(r"`(?:cc\.)?(\w+)`", text_of(NAME)))
    assert {"ContextError", "ShaderError", "MeshError"} <= classes
