"""Runs the programs of a page, once in each process of pytest."""

from typing import Any

import pytest

from tests.documents import python_blocks, run_block
from tests.howto.pages import written


@pytest.fixture(scope="session")
def pages(tmp_path_factory):
    """Run all blocks of a page, one after the other in one folder; give the folder and their names.

    The folder then holds the files that the page's code names, and no others.
    """
    done = {}

    def get(name):
        if name not in done:
            folder = tmp_path_factory.mktemp("howto")
            scope: dict[str, Any] = {}
            with pytest.MonkeyPatch.context() as patch:
                for code in python_blocks(name):
                    scope = run_block(code, name, folder, patch, scope)
            assert {path.name for path in folder.iterdir()} == written(name)
            done[name] = folder, scope
        return done[name]

    return get
