"""Tests of assert_close and assert_identical: each must fail when arrays differ."""

import numpy as np
import pytest

from tests import compare
from tests.compare import assert_close, assert_identical, place
from tests.tolerances import TOLERANCES


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.setattr(compare, "FAILURES", tmp_path)


def test_reports_the_largest_the_mean_and_the_worst_place(tmp_path):
    expected = np.zeros((6, 8, 8, 3))
    got = expected.copy()
    got[4, 2, 7, 1] = 0.5
    with pytest.raises(AssertionError) as raised:
        assert_close(got, expected, "lookup")
    text = str(raised.value)
    assert "largest 0.5" in text
    assert f"mean {0.5 / got.size:g}" in text
    assert "face +z, row 2, column 7, channel 1" in text
    assert len(list(tmp_path.glob("*.png"))) == 1


@pytest.mark.parametrize(
    ("got", "expected"), [(np.nan, 0.0), (0.0, np.nan), (np.inf, 1.0), (np.inf, -np.inf)]
)
def test_nan_and_infinity_must_stand_where_they_are_expected(got, expected):
    with pytest.raises(AssertionError):
        assert_close(np.full((2, 2), got), np.full((2, 2), expected), "edge")
    assert_close(np.full((2, 2), expected), np.full((2, 2), expected), "exact")


def test_a_mask_hides_and_may_not_hide_everything():
    got, expected = np.zeros((4, 4)), np.zeros((4, 4))
    got[0, 0] = 1
    mask = got == 0
    assert_close(got, expected, "exact", mask=mask)
    with pytest.raises(AssertionError, match="leaves"):
        assert_close(got, expected, "exact", mask=np.zeros((4, 4), bool))
    with pytest.raises(AssertionError, match="shape"):
        assert_close(got, expected[:2], "exact")


def test_the_mean_counts_too():
    got = np.full((4, 4), 0.9)
    with pytest.raises(AssertionError, match="mean"):
        assert_close(got, np.zeros((4, 4)), "unorm8_counts")


def test_a_few_values_may_be_farther_off_where_the_rule_says_so():
    rule = "reference_image_of_another_mesa"
    got, expected = np.zeros((64, 64)), np.zeros((64, 64))
    got[:2, :2] = 3
    assert_close(got, expected, rule)
    with pytest.raises(AssertionError, match="largest 3"):
        assert_close(got, expected, "reference_image")
    got[2, 0] = 3
    with pytest.raises(AssertionError, match="5 of 4096"):
        assert_close(got, expected, rule)
    got[:3] = 0
    got[0, 0] = 5
    with pytest.raises(AssertionError, match="largest 5"):
        assert_close(got, expected, rule)


@pytest.fixture
def another_driver(monkeypatch):
    monkeypatch.setattr(compare, "on_llvmpipe", lambda: False)


def test_another_driver_may_round_the_weights_of_filters(another_driver):
    """By a share of the range of the expected values: 3/512 of it, and no more."""
    expected = np.linspace(0, 100, 16).reshape(4, 4)
    assert_close(expected + 0.5, expected, "lookup")
    with pytest.raises(AssertionError, match=r"largest 0\.7"):
        assert_close(expected + 0.7, expected, "lookup")
    with pytest.raises(AssertionError, match=r"largest 0\.5"):
        assert_close(expected + 0.5, expected, "phong")


def test_what_holds_on_llvmpipe_alone_is_skipped_elsewhere(another_driver):
    same = np.zeros((4, 4))
    for compared in (
        lambda: assert_identical(same, same + 1, across="programs"),
        lambda: assert_identical(same, same + 1, across="filters"),
        lambda: assert_close(same + 9, same, "reference_image"),
    ):
        with pytest.raises(pytest.skip.Exception, match="holds on llvmpipe alone"):
            compared()
    with pytest.raises(AssertionError):
        assert_identical(same, same + 1)


def test_identical_minds_the_dtype_and_the_sign_of_zero():
    with pytest.raises(AssertionError, match="float32"):
        assert_identical(np.zeros(2, np.float64), np.zeros(2, np.float32))
    with pytest.raises(AssertionError, match="bit for bit"):
        assert_identical(np.array([0.0]), np.array([-0.0]))


def test_places_in_words():
    assert place((3, 1, 2, 0), (6, 8, 8, 3)) == "face -y, row 1, column 2, channel 0"
    assert place((0, 1, 2), (6, 8, 8)) == "face +x, row 1, column 2"
    assert place((1, 2), (6, 6)) == "index (1, 2)"


def test_on_llvmpipe_nothing_is_skipped(monkeypatch):
    monkeypatch.setattr(compare, "on_llvmpipe", lambda: True)
    with pytest.raises(AssertionError):
        assert_identical(np.zeros(2), np.ones(2), across="programs")
    with pytest.raises(AssertionError):
        assert_close(np.zeros((2, 2)), np.full((2, 2), 0.01), "lookup")


def test_every_tolerance_has_a_reason():
    for name, rule in TOLERANCES.items():
        assert len(rule.reason) > 15, name
