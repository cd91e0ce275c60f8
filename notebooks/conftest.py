"""pytest runs each notebook, and compares what it prints and draws with the outputs that are committed."""

from importlib.util import find_spec

import pytest

from tests.helpers import load_script, on_llvmpipe

#: What a notebook needs that has no wheel for every Python and machine of the suite.
NEEDS = {
    "11-truth-and-error": ("embreex", "flip_evaluator"),
    "12-a-room-and-its-parallax": ("embreex",),
    "13-facing-mirrors-and-glass": ("embreex",),
}


def pytest_collect_file(file_path, parent):
    if file_path.suffix == ".ipynb":
        return NotebookFile.from_parent(parent, path=file_path)
    return None


class NotebookFile(pytest.File):
    def collect(self):
        yield NotebookTest.from_parent(self, name=self.path.stem)


class NotebookTest(pytest.Item):
    """One notebook, from the first cell to the last, in a kernel of its own."""

    def runtest(self):
        for package in NEEDS.get(self.path.stem, ()):
            if find_spec(package) is None:
                pytest.skip(f"{package} has no wheel here")
        import nbformat  # late, since a controller of several processes runs no tests

        script = load_script("notebooks")
        found = script.differences(
            script.execute(self.path),
            nbformat.read(self.path, as_version=4),
            numbers=on_llvmpipe(),
        )
        if found:
            raise StaleOutputs("\n".join(["`make notebooks` writes the outputs again:", *found]))

    def repr_failure(self, excinfo, style=None):
        # The traceback of a cell is in the message; the frames of the client say nothing.
        return str(excinfo.value)

    def reportinfo(self):
        return self.path, None, f"notebook {self.name}"


class StaleOutputs(Exception):
    """A notebook's committed outputs are not what its cells give today."""
