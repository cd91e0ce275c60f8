"""The programs of docs/howto/train.md, in a folder from which they can be imported."""

import os
import re
import sys

import pytest

from tests.documents import fenced

NAME = "docs/howto/train.md"


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """A folder with the programs, as the first lines of the page's blocks name them."""
    made = tmp_path_factory.mktemp("train")
    for code in fenced(NAME, "py"):
        name = re.match(r"# (\w+\.py)\n", code)
        assert name, code
        (made / name[1]).write_text(code, encoding="utf-8")
    return made


@pytest.fixture(scope="session", autouse=True)
def importable(folder):
    """Tests import the programs, and so do the processes that they spawn."""
    before = os.environ.get("PYTHONPATH")
    sys.path.insert(0, str(folder))
    os.environ["PYTHONPATH"] = os.pathsep.join([str(folder), *([before] if before else [])])
    yield
    sys.path.remove(str(folder))
    os.environ["PYTHONPATH"] = before or ""
