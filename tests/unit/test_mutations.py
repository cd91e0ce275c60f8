"""The list of tests/mutation.py stays in step with the sources; breaking them in earnest is `make mutants`."""

from pathlib import Path

import pytest

from tests.mutation import stale
from tests.mutations import MUTATIONS

ROOT = Path(__file__).parents[2]


def test_every_place_is_found_exactly_once():
    assert stale(MUTATIONS) == []


def test_there_are_enough_and_all_parts_have_some():
    assert len(MUTATIONS) >= 18
    assert len({m.name for m in MUTATIONS}) == len(MUTATIONS)
    for part in ("cpp/", "shaders/", "python/"):
        assert sum(m.file.startswith(part) for m in MUTATIONS) >= 4, part


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda m: m.name)
def test_each_changes_something_and_names_tests(mutation):
    assert mutation.old != mutation.new
    assert mutation.tests
    for name in mutation.tests:
        assert (ROOT / name.split("::")[0]).exists(), name
