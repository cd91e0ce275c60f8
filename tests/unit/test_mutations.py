"""The list of tests/mutation.py fits the sources; `make mutants` applies the changes and runs the tests."""

import dataclasses
from pathlib import Path

import pytest

from tests.mutation import place, stale
from tests.mutations import MUTATIONS

ROOT = Path(__file__).parents[2]


def test_every_place_is_found_exactly_once():
    assert stale(MUTATIONS) == []


def test_there_are_enough_and_all_parts_have_some():
    assert len(MUTATIONS) >= 18
    assert len({m.name for m in MUTATIONS}) == len(MUTATIONS)
    for part in ("cpp", "shaders", "python"):
        assert sum(place(m).parts[0] == part for m in MUTATIONS) >= 4, part


def test_what_is_missing_or_ambiguous_is_stale():
    one = MUTATIONS[0]
    wrong = [
        dataclasses.replace(one, file="nowhere.cpp"),
        dataclasses.replace(one, file="__init__.py"),
        dataclasses.replace(one, old="no such text"),
    ]
    assert [line.split(": expected ")[1].split(",")[0] for line in stale(wrong)] == [
        "one nowhere.cpp", "one __init__.py", f"once in {one.file}",
    ]  # fmt: skip


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda m: m.name)
def test_each_changes_something_and_names_tests(mutation):
    assert mutation.old != mutation.new
    assert mutation.tests
    for name in mutation.tests:
        assert (ROOT / name.split("::")[0]).exists(), name
