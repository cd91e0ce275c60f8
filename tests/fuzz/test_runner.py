"""What finds faults finds each kind of fault, keeps its case, and finds none where there is none."""

import time

import pytest

from tests.fuzz import planted, runner
from tests.fuzz.targets import COUNTS, NAMES, target


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("error", "KeyError: 'planted'"),
        ("slow", "took 0."),
        ("hang", "no answer within 2 s"),
        ("crash", "the process ended with status -11"),
        ("memory", "memory grew by "),
    ],
)
def test_faults_are_found_and_the_case_is_kept(tmp_path, name, told):
    found, tried = runner.run(planted.TARGETS[f"planted-{name}"], 3, 0, tmp_path)
    assert [text.partition(": ")[0] for text in found] == [f"planted-{name} 1"]
    assert found[0].partition(": ")[2].startswith(told)
    assert tried == 3
    assert [path.name for path in tmp_path.iterdir()] == [f"planted-{name}-1.txt"]
    assert next(tmp_path.iterdir()).read_bytes() == b"case 1"


@pytest.mark.slow
def test_without_a_fault_none_is_found(tmp_path):
    assert runner.run(planted.TARGETS["planted-none"], 20, 0, tmp_path) == ([], 20)
    assert list(tmp_path.iterdir()) == []


def test_no_worker_starts_after_the_end(tmp_path):
    none = planted.TARGETS["planted-none"]
    assert runner.run(none, 20, 0, tmp_path, until=time.monotonic() - 1) == ([], 0)


@pytest.mark.parametrize("name", NAMES)
def test_a_number_always_makes_the_same_case(name):
    one = target(name)
    assert [one.make(number) for number in range(9)] == [one.make(number) for number in range(9)]
    assert len({one.make(number) for number in range(9)}) > 4
    assert COUNTS[name] > 0


def test_negative_numbers_are_the_corpus():
    for name in NAMES:
        for number, path in enumerate(runner.kept(name)):
            assert runner.case_of(target(name), -1 - number) == path.read_bytes()


def test_the_corpus_is_small():
    paths = [path for path in runner.CORPUS.rglob("*") if path.is_file()]
    assert {path.parent.name for path in paths} <= set(NAMES)
    assert sum(path.stat().st_size for path in paths) < 200_000
