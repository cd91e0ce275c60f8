"""`python -m benchmarks.reflections` measures a plain probe as it was measured once, by other programs."""

import pytest

from benchmarks.reflections.marks import LIMITS
from benchmarks.reflections.methods import METHODS, MissingError
from benchmarks.reflections.reflectors import World
from benchmarks.reflections.table import Bench, Case


def test_a_plain_probe_in_a_room(renderer, tmp_path):
    """A mirror ball among walls 3 to 5 m away: hardly any ray ends where the plain cubemap says."""
    case = Case("room_b", "mirror", "plain")
    (row,) = Bench(renderer, 0, tmp_path, size=160).run([case])
    assert row.missing == ""
    assert row.rmse is not None
    assert row.p1 is not None
    assert 0.14 < row.rmse < 0.2
    assert row.ratio == 1
    assert row.p1 < 0.01
    assert (tmp_path / "room_b_mirror_256_plain.png").exists()


def test_what_is_missing_is_named(renderer, monkeypatch):
    monkeypatch.setattr("benchmarks.reflections.methods.METHODS", METHODS)
    monkeypatch.setitem(METHODS, "strange", type(METHODS["plain"])({"no_such_option": 1}))
    with pytest.raises(MissingError, match="Probe has no no_such_option="):
        METHODS["strange"].prepare(World("room_b", "mirror"), size=16)
    (row,) = Bench(renderer, 0).run([Case("room_b", "mirror", "strange")])
    assert (row.missing, row.rmse) == ("Probe has no no_such_option=", None)


def test_every_mark_has_a_method():
    assert {one.case.method for one in LIMITS} <= set(METHODS)
