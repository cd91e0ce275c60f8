"""Notebooks are committed clean, numbered without gaps and shown with pictures; nbmake runs each as a whole."""

from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[1]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
each = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def test_they_are_numbered_from_01():
    assert NOTEBOOKS
    assert [path.name[:2] for path in NOTEBOOKS] == [
        f"{i:02}" for i in range(1, len(NOTEBOOKS) + 1)
    ]


def test_the_suite_runs_them(pytestconfig):
    """nbmake collects the notebooks in notebooks/, and `pytest` without arguments runs them."""
    assert "notebooks" in pytestconfig.getini("testpaths")
    assert pytestconfig.option.nbmake


@each
def test_it_is_committed_clean(path):
    for cell in nbformat.read(path, as_version=4).cells:
        if cell.cell_type == "code":
            assert not cell.outputs
            assert cell.execution_count is None


@each
def test_it_says_what_it_does(path):
    cells = nbformat.read(path, as_version=4).cells
    assert cells[0].cell_type == "markdown"
    assert cells[0].source.startswith("# ")
    assert sum(cell.cell_type == "markdown" for cell in cells) >= 3
