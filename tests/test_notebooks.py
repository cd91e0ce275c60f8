"""The lessons: committed with outputs that are not stale, small and free of what belongs to one machine; their form."""

import base64
import io
import re
from collections import Counter
from pathlib import Path

import nbformat
import numpy as np
import pytest
from nbclient.exceptions import CellExecutionError
from PIL import Image

from tests.helpers import load_script

ROOT = Path(__file__).parents[1]
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
each = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)

#: What belongs to one machine or one run: absolute paths, dates, clocks, addresses, drivers.
FOREIGN = re.compile(
    r"/(?:home|root|work|tmp|usr|opt|mnt|var|Users)/|\d{4}-\d\d-\d\d|\b\d{1,2}:\d\d:\d\d|0x[0-9a-f]{6,}"
    r"|llvmpipe|site-packages",
    re.IGNORECASE,
)


@pytest.fixture(scope="module")
def script():
    return load_script("notebooks")


def cells_of(path, kind=None):
    cells = nbformat.read(path, as_version=4).cells
    return [cell for cell in cells if kind in (None, cell.cell_type)]


def headings(path):
    """The lines of Markdown that begin with #, in order."""
    text = "\n".join(cell.source for cell in cells_of(path, "markdown"))
    return [line for line in text.splitlines() if line.startswith("#")]


def printed(output):
    """The text of an output, without its pictures."""
    data = output.get("data", {})
    return output.get("text", "") + "".join(data.get(k, "") for k in ("text/plain", "text/html"))


def pictures(cell):
    for output in cell.outputs:
        for kind in ("image/png", "image/jpeg"):
            encoded = output.get("data", {}).get(kind)
            if encoded:
                yield Image.open(io.BytesIO(base64.b64decode(encoded)))


def test_they_are_numbered_from_01():
    assert NOTEBOOKS
    assert [path.name[:2] for path in NOTEBOOKS] == [
        f"{i:02}" for i in range(1, len(NOTEBOOKS) + 1)
    ]


def test_the_suite_runs_them(pytestconfig):
    """notebooks/conftest.py collects them, and `pytest` without arguments runs them."""
    assert "notebooks" in pytestconfig.getini("testpaths")
    assert (ROOT / "notebooks" / "conftest.py").exists()


@each
def test_it_is_committed_with_its_outputs(path, script):
    assert path.stat().st_size <= script.MOST_BYTES
    code = cells_of(path, "code")
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    assert sum(1 for cell in code for _ in pictures(cell)) >= 5
    for cell in code:
        drawn = "plt.show()" in cell.source or ".live(" in cell.source
        assert not drawn or list(pictures(cell)), cell.source


@each
def test_its_outputs_belong_to_no_machine(path):
    for cell in cells_of(path, "code"):
        for output in cell.outputs:
            assert output.output_type != "error"
            assert output.get("name") != "stderr", output.text
            assert "application/vnd.jupyter.widget-view+json" not in output.get("data", {})
            assert not FOREIGN.search(printed(output)), printed(output)


@each
def test_its_pictures_are_large_enough_to_be_read(path):
    for cell in cells_of(path, "code"):
        for picture in pictures(cell):
            assert picture.width >= 200
            assert picture.width <= 1300, "letters are too small where a page shrinks the picture"


@each
def test_it_says_what_it_does(path):
    cells = cells_of(path)
    assert cells[0].cell_type == "markdown"
    assert cells[0].source.startswith("# ")
    assert sum(cell.cell_type == "markdown" for cell in cells) >= 3


@each
def test_it_ends_with_three_exercises_and_tested_answers(path):
    wanted = ["## Exercises", "## Appendix: answers", *(f"### Answer {k}" for k in (1, 2, 3))]
    assert headings(path)[-5:] == wanted
    (asked,) = (cell.source for cell in cells_of(path) if cell.source.startswith("## Exercises"))
    assert re.findall(r"^(\d)\. ", asked, re.MULTILINE) == ["1", "2", "3"]
    answers = [cell for cell in cells_of(path, "code") if "answer" in cell.metadata.get("tags", [])]
    assert len(answers) == 3
    assert all("assert " in cell.source for cell in answers)
    assert cells_of(path)[-1] is not None
    assert "answer" in cells_of(path)[-1].metadata.get("tags", [])


@each
def test_its_numbers_are_on_the_page(path):
    for cell in cells_of(path, "code"):
        assert "inspect" not in cell.source


def test_no_helper_is_copied():
    names = Counter(
        name
        for path in NOTEBOOKS
        for name in {
            name
            for cell in cells_of(path, "code")
            for name in re.findall(r"^def (\w+)", cell.source, re.MULTILINE)
        }
    )
    assert not [name for name, count in names.items() if count > 1]


def notebook_of(*sources):
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    return nbformat.v4.new_notebook(cells=cells)


@pytest.mark.slow
def test_runs_are_equal_and_small(script, tmp_path):
    path = tmp_path / "some.ipynb"
    drawing = """
import matplotlib.pyplot as plt, numpy as np
rng = np.random.default_rng(1)
plt.figure(figsize=(4, 4))
plt.imshow(rng.random((400, 400, 3)))
plt.show()
plt.plot([1, 2])
plt.show()
"""
    nbformat.write(notebook_of("print(1)\nprint(2)", drawing, "7"), path)
    size = script.write(path)
    first = path.read_bytes()
    assert size == len(first)
    assert script.write(path) == size
    assert path.read_bytes() == first
    one, two, three = cells_of(path)
    assert [output.text for output in one.outputs] == ["1\n2\n"]
    assert ["image/jpeg" in output.data for output in two.outputs] == [True, False]
    assert all(script._picture_of(output) for output in two.outputs)
    assert three.outputs[0].execution_count == three.execution_count == 3


@pytest.mark.slow
def test_a_cell_that_fails_is_an_error(script, tmp_path):
    path = tmp_path / "some.ipynb"
    nbformat.write(notebook_of("assert 1 == 2"), path)
    with pytest.raises(CellExecutionError, match="assert 1 == 2"):
        script.execute(path)


def with_output(script, text="", picture=None):
    notebook = notebook_of("show()")
    data = {"text/plain": text}
    if picture is not None:
        buffer = io.BytesIO()
        Image.fromarray(picture).save(buffer, "png")
        data["image/png"] = base64.b64encode(buffer.getvalue()).decode()
    notebook.cells[0].outputs = [nbformat.v4.new_output("display_data", data)]
    return notebook


@pytest.mark.parametrize(
    ("new", "old", "equal"),
    [
        ("a 1.234", "a 1.234", True),
        ("a 1.234", "a 1.236", True),  # 2 of the last digit
        ("a 1.234", "a 1.334", False),
        ("a 1.0e-06", "a 1.3e-15", True),  # rounding errors
        ("a 1.0e-03", "a 1.3e-03", False),
        ("a 15,000 b", "a 15,100 b", True),
        ("a 15,000 b", "a 16,000 b", False),
        ("[ 0.5  1. ]", "[ 0.5  1. ]", True),
        ("a 1", "b 1", False),
        ("a 1 2", "a 1", False),
        ("<Figure size 900x300 with 3 Axes>", "<Figure size 901x300 with 3 Axes>", True),
    ],
)
def test_texts_are_compared(script, new, old, equal):
    found = script.differences(with_output(script, new), with_output(script, old))
    assert (not found) == equal
    loose = script.differences(with_output(script, new), with_output(script, old), numbers=False)
    same_words = re.sub(r"[\d.,e+-]+", "#", new) == re.sub(r"[\d.,e+-]+", "#", old)
    assert (not loose) == same_words


def test_pictures_are_compared(script, rng):
    picture = rng.integers(0, 256, (60, 90, 3), dtype=np.uint8)
    shifted = np.roll(picture, 2, axis=1)
    smooth = np.zeros((60, 90, 3), np.uint8)
    smooth[:, :45] = 200
    wider = np.repeat(smooth, 2, axis=1)[:, 1:]

    def found(new, old):
        return script.differences(
            with_output(script, picture=new), with_output(script, picture=old)
        )

    assert not found(picture, picture)
    assert "the picture differs by" in found(shifted, picture)[0]
    assert not found(wider, smooth)
    assert "the picture differs by" in found(wider[:, ::-1], smooth)[0]
    assert "only one of the outputs has a picture" in found(None, smooth)[0]


def test_cells_and_outputs_are_compared(script):
    some = with_output(script, "1")
    assert "another source" in script.differences(some, notebook_of("other()"))[0]
    assert "another source" in script.differences(some, notebook_of("show()", "more()"))[0]
    assert "an output more" in script.differences(some, notebook_of("show()"))[0]
    assert "an output less" in script.differences(notebook_of("show()"), some)[0]


def test_what_differs_from_run_to_run_is_left_out(script):
    notebook = with_output(script, "Viewer", np.zeros((8, 8, 4), np.uint8))
    (output,) = notebook.cells[0].outputs
    output.data["application/vnd.jupyter.widget-view+json"] = {"model_id": "5f"}
    notebook.cells[0].metadata = {"execution": {"iopub.status.busy": "12:00"}, "tags": ["answer"]}
    notebook.metadata["widgets"] = {"state": {}}
    tidied = script.tidied(notebook)
    assert set(tidied.cells[0].outputs[0].data) == {"text/plain", "image/png"}
    assert tidied.cells[0].metadata == {"tags": ["answer"]}
    assert set(tidied.metadata) == {"kernelspec", "language_info"}
    # What was transparent is white on a page.
    assert script._picture_of(tidied.cells[0].outputs[0]).getpixel((0, 0)) == (255, 255, 255)


def test_the_picture_of_a_live_view_is_small(script):
    picture = np.full((200, 400, 4), 255, np.uint8)
    picture[:, 200:, :3] = 0
    live = with_output(script, "Viewer", picture)
    live.cells[0].outputs[0].data["application/vnd.jupyter.widget-view+json"] = {"model_id": "5f"}
    shown = script._picture_of(script.tidied(live).cells[0].outputs[0])
    assert shown.size == (300, 150)
    assert shown.getpixel((100, 100)) == (255, 255, 255)
    assert shown.getpixel((200, 100)) == (0, 0, 0)
    plain = script.tidied(with_output(script, "Figure", picture))
    assert script._picture_of(plain.cells[0].outputs[0]).size == (400, 200)
