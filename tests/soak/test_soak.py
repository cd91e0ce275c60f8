"""A part of `make soak`, with fixed seeds; and that its parts find what they look for."""

import itertools
import time

import numpy as np
import pytest

from tests.gl import edits as random_edits
from tests.soak import contexts, edits, threads
from tests.soak.report import Held, Report


@pytest.mark.slow
def test_edits(shared_renderers):
    """Two renderers of the session, which have most programs; tests/gl/test_incremental.py does each edit once."""
    report = Report()
    edits.one_world(shared_renderers(None), shared_renderers(False), 3, 4, report)
    assert report.faults == []
    assert report.counts == {"edits": 4}


def test_a_stale_picture_is_a_fault(monkeypatch, renderer):
    """A renderer that keeps its third picture for too long is found, and the fault says by which edit."""

    class World:
        value = 0

    def step(world, rng, draw):
        world.value += 1

    calls = itertools.count()

    def fresh(renderer, world):
        return {"frame": np.full(3, world.value)}

    def stale(renderer, world):
        return {"frame": np.full(3, min(next(calls), 3))}

    monkeypatch.setattr(edits, "full_world", lambda rng: World())
    monkeypatch.setattr(edits, "pictures", fresh)
    monkeypatch.setattr(random_edits, "NAMES", ())
    monkeypatch.setattr(random_edits, "METHODS", {"step": step})
    report = Report()
    edits.one_world(renderer, renderer, 5, 12, report, draw=stale)
    assert len(report.faults) == 1
    assert report.faults[0].startswith("edits, seed 5, edit 3, step: frame: ")


def test_each_kind_of_material_is_edited_as_often(monkeypatch, renderer):
    """What a property changes depends on the kind, so a property that several kinds inherit is drawn for each."""
    drawn = []

    def note(name, *_):
        drawn.append(name)
        return name, None

    monkeypatch.setattr(edits, "full_world", lambda rng: None)
    monkeypatch.setattr(edits, "pictures", lambda *_: {})
    monkeypatch.setattr(random_edits, "edit", note)
    edits.one_world(renderer, renderer, 1, 20_000, Report(), draw=lambda *_: {})
    counts = [drawn.count(name) for name in {*random_edits.NAMES, *random_edits.METHODS}]
    mean = 20_000 / len(counts)
    assert "MirrorMaterial.depth_write" in drawn
    assert mean / 2.5 < min(counts) <= max(counts) < 2.5 * mean, (min(counts), max(counts), mean)


def test_differences_are_told():
    one, other = np.zeros(3), np.ones(3)
    assert edits.difference({"a": one, "b": "error"}, {"a": one, "b": "error"}) is None
    assert "a: " in (edits.difference({"a": one}, {"a": other}) or "")
    assert edits.difference({}, {"a": one}) == "a is missing"
    assert "b: " in (edits.difference({"b": "error"}, {"b": one}) or "")


@pytest.mark.slow
@pytest.mark.parametrize("renderers", [1, 4])
def test_threads(renderers):
    report = Report()
    threads.one_round(threads.Shared(1), 1, 3, renderers, report)
    assert report.faults == []
    assert report.counts["pictures"] >= 3 * threads.THREADS


@pytest.mark.slow
def test_another_picture_in_a_thread_is_a_fault(monkeypatch):
    calls = itertools.count()
    monkeypatch.setattr(threads, "pictures", lambda *_: [b"%d" % (next(calls) == 12)])
    report = Report()
    threads.one_round(threads.Shared(1), 1, 1, 1, report)
    assert len(report.faults) == 1
    assert "picture 0 differs" in report.faults[0]


@pytest.mark.slow
def test_contexts():
    report = contexts.run(time.monotonic(), 0, count=contexts.WARM + 3)
    assert report.faults == []
    assert report.counts == {"contexts": contexts.WARM + 3}


def test_what_grows_is_a_fault():
    before = Held(memory=100, threads=2, files=7)
    assert Held(memory=200, threads=2, files=7).growth(before, 100) is None
    assert (
        Held(memory=100 + (3 << 20), threads=2, files=7).growth(before, 100)
        == "memory grew by 3 MiB"
    )
    assert Held(memory=100, threads=3, files=7).growth(before, 100) == "1 more threads"
    assert Held(memory=100, threads=2, files=9).growth(before, 100) == "2 more open files"
    assert Held.now().memory > 1 << 20


def test_a_report_says_what_was_done():
    report = Report()
    report.count("edits", 3)
    report.faults.append("x")
    assert str(report) == "3 edits, 1 faults"
