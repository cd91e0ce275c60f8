"""Scripts of a visitor: what a text means, and which texts are refused."""

import numpy as np
import pytest

from cubecam.examples import _script


@pytest.mark.parametrize(
    ("text", "want"),
    [
        ("w", ["w"]),
        ("w 3; s", ["w", "w", "w", "s"]),
        (" s 2 ;; w 0; w ", ["s", "s", "w"]),
        ("w 0", []),
        ("drag 8 -4", [(1.0, -0.5)]),
        ("drag 1.5 1e1", [(0.1875, 1.25)]),
        ("drag 0 0", [(0.0, 0.0)]),
        # A long drag comes in pieces of 16 pixels at most.
        ("drag 48 12; w", [(2.0, 0.5)] * 3 + ["w"]),
        ("drag 0 -17", [(0.0, -1.0625)] * 2),
    ],
)
def test_texts(text, want):
    """In a picture 800 pixels high, a pixel is an eighth of a degree."""
    assert list(_script.parse_script(text, 800)) == want


@pytest.mark.parametrize("height", [100, 512])
def test_the_height_of_the_picture_is_100_degrees(height):
    drags = list(_script.events(f"drag {height} {-height / 2}", height))
    np.testing.assert_allclose(np.array(drags, float).sum(axis=0), (100, -50))


def test_events_stay_as_they_are():
    assert _script.events(["w", (3, 4.5), "s"]) == ("w", (3, 4.5), "s")


@pytest.mark.parametrize(
    "text",
    ["", " ; ", "jump", "drag 1", "drag 1 2 3", "drag a 1", "drag nan 1", "drag inf 1", "w -1",
     "w 1.5", "w 1 2", "W", "s x", "drag 1,2", "w ٣"],
)  # fmt: skip
def test_other_texts_are_refused(text):
    with pytest.raises(ValueError, match=r'script: expected parts such as "drag 30 10"') as caught:
        _script.parse_script(text, 512)
    assert repr(text.strip() if text.strip(" ;") else text) in str(caught.value)


@pytest.mark.parametrize(
    "text", ["w 100001", "w 60000; s 60000", "drag 1e300 0", "w " + "9" * 5000]
)
def test_a_script_without_end_is_refused(text):
    with pytest.raises(ValueError, match=r"expected at most 100,000 events"):
        _script.parse_script(text, 512)


@pytest.mark.parametrize("event", ["jump", "", (1,), (1, 2, 3)])
def test_other_events_are_refused(event):
    with pytest.raises(ValueError, match='expected "w", "s" or a drag of two angles'):
        _script.events(["w", event])
