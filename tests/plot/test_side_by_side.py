"""cc.plot.pictures: the pixels, titles and places of pictures side by side."""

import re

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_rgba

import cubecam as cc
from tests.plot.artists import array_of, mapped_colors

GREY = np.full((6, 9, 3), 0.5, np.float32)


def image_of(ax, index=0):
    return np.asarray(array_of(ax.get_images()[index]))


def test_bytes_are_shown_as_they_are_and_alpha_is_not_shown(rng):
    pixels = rng.integers(0, 256, (6, 9, 4), dtype=np.uint8)
    one, other, grey = cc.plot.pictures([pixels, pixels[..., :3], pixels[..., :1]])
    assert (image_of(one) == pixels[..., :3]).all()
    assert (image_of(other) == pixels[..., :3]).all()
    assert (image_of(grey) == pixels[..., :1]).all()
    assert image_of(grey).shape == (6, 9, 3)
    (again,) = cc.plot.pictures([pixels], tonemap=None, encode=None)
    assert (image_of(again) == pixels[..., :3]).all()


def test_floats_are_light_unless_the_caller_says_otherwise():
    (light,) = cc.plot.pictures([GREY])
    assert (image_of(light) == cc.to_screen(GREY)).all()
    (darker,) = cc.plot.pictures([GREY], exposure=-1)
    assert (image_of(darker) == cc.to_screen(GREY, exposure=-1)).all()
    (numbers,) = cc.plot.pictures([GREY], tonemap=None, encode=None)
    assert (image_of(numbers) == 128).all()


def test_frames_and_images_have_their_encoding(renderer):
    frame = renderer.render(cc.Scene(background=(0.5, 0.5, 0.5)), cc.PerspectiveCamera(), (9, 6))
    image = cc.Image(frame.color[..., :3], encoding="linear")
    for ax in cc.plot.pictures([frame, image]):
        assert (image_of(ax) == cc.to_screen(frame)[..., :3]).all()
    assert image_of(cc.plot.pictures([frame], encode=None)[0])[0, 0, 0] == 128


def test_numbers_of_all_pictures_share_a_colour_map_and_a_bar():
    low, high = np.zeros((4, 4)), np.full((4, 4), 3.0)
    low[1, 1], high[0, 0] = 1, np.inf
    first, second, third = cc.plot.pictures([low, high, GREY], ["low", "high", "grey"])
    figure = first.figure
    assert len(figure.axes) == 4  # three pictures and the bar
    viridis = plt.get_cmap("viridis")
    np.testing.assert_allclose(mapped_colors(first.get_images()[-1])[0, 0], viridis(0.0))
    np.testing.assert_allclose(mapped_colors(first.get_images()[-1])[1, 1], viridis(1 / 3))
    np.testing.assert_allclose(mapped_colors(second.get_images()[-1])[1, 1], viridis(1.0))
    np.testing.assert_allclose(image_of(second)[0, 0], to_rgba("0.82"))
    assert [ax.get_title() for ax in (first, second, third)] == ["low", "high", "grey"]
    assert len(cc.plot.pictures([low, high], colorbar=False)[0].figure.axes) == 2


def test_masks_and_ids_have_one_colour_for_each_value():
    mask = np.eye(4, dtype=bool)
    ids = np.arange(16, dtype=np.uint32).reshape(4, 4)
    (one,) = cc.plot.pictures([mask])
    assert len(np.unique(mapped_colors(one.get_images()[0]).reshape(-1, 4), axis=0)) == 2
    (two,) = cc.plot.pictures([ids])
    assert len(np.unique(mapped_colors(two.get_images()[0]).reshape(-1, 4), axis=0)) == 16
    both = cc.plot.pictures([mask, np.full((4, 4), 0.25)])
    assert len(both) == 2
    np.testing.assert_allclose(array_of(both[0].get_images()[-1]), mask)


def test_rows_and_columns():
    axes = cc.plot.pictures([GREY] * 5, columns=3, width=2)
    figure = axes[0].figure
    assert len(figure.axes) == 5
    np.testing.assert_allclose(figure.get_size_inches(), (6, 2 * (2 * 6 / 9 + 0.3)))
    spec = [ax.get_subplotspec() for ax in axes]
    assert [(s.rowspan.start, s.colspan.start) for s in spec] == [
        (0, 0), (0, 1), (0, 2), (1, 0), (1, 1),
    ]  # fmt: skip


def test_the_callers_axes():
    _, mine = plt.subplots(1, 2)
    axes = cc.plot.pictures([GREY, GREY], ["a", "b"], ax=mine)
    assert axes[0] is mine[0]
    assert mine[1].get_title() == "b"
    with pytest.raises(ValueError, match="ax: expected 1 axes, one for each picture, got 2"):
        cc.plot.pictures([GREY], ax=mine)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"pictures": []}, "pictures: expected at least one picture, got none"),
        ({"pictures": np.zeros(4)}, re.escape("(H, W) or (H, W, C), got shape ()")),
        ({"pictures": [GREY[..., :2]]}, re.escape("expected 1, 3 or 4 channels")),
        ({"pictures": [np.zeros(4)]}, re.escape("(H, W) or (H, W, C), got shape (4,)")),
        (
            {"pictures": [cc.CubeMap(np.zeros((6, 2, 2, 3)))]},
            re.escape("(H, W) or (H, W, C), got shape (6, 2, 2, 3)"),
        ),
        ({"titles": ["a", "b"]}, "titles: expected 1, one for each picture, got "),
        ({"titles": "a"}, "titles: expected 1, one for each picture, got "),
        ({"columns": 0}, "columns: expected a number from 1, got 0"),
        ({"width": 0}, "width: expected inches above 0, got 0"),
    ],
)
def test_errors(options, message):
    with pytest.raises(ValueError, match=message):
        cc.plot.pictures(**{"pictures": [GREY], **options})


def test_one_picture_is_no_list(renderer):
    frame = renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4))
    with pytest.raises(TypeError, match=re.escape("got Frame; write [picture]")):
        cc.plot.pictures(frame)
