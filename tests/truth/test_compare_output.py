"""What a comparison draws, and the command `cubecam compare`."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc
from tests.reference.pattern import face_pattern
from tests.truth.two_pictures import HAS_FLIP, PICTURE, TRUTH, compare


def labels(figure):
    return [ax.get_title() for ax in figure.axes if ax.get_title()]


@pytest.mark.parametrize("cube", [False, True])
def test_plot(cube):
    from matplotlib import pyplot as plt

    truth = np.stack([TRUTH[:24, :24]] * 6) if cube else TRUTH
    picture = truth.copy()
    place = (2, 6, 9) if cube else (6, 9)
    picture[place] += 0.5
    mask = np.ones(truth.shape[:-1], bool)
    mask[..., 0] = False
    found = compare(picture, truth, mask, flip=HAS_FLIP)
    figure = found.plot(scale="log")
    spot = "+Y, row 6, column 9" if cube else "row 6, column 9"
    assert labels(figure)[:3] == ["picture", "truth", f"error: max 0.5 at {spot}"]
    assert f"RMSE {found.rmse:.4g}" in figure.get_suptitle()
    assert f"{found.counted} of {found.total} pixels count" in figure.get_suptitle()
    marked = [line for line in figure.axes[2].lines if line.get_marker() == "o"]
    assert len(marked) == 1
    if not cube:
        assert (marked[0].get_xdata()[0], marked[0].get_ydata()[0]) == (9, 6)
    assert len(labels(figure)) == (4 if HAS_FLIP else 3)
    plt.close(figure)
    figure = compare(picture, truth).plot(exposure=1)
    assert len(labels(figure)) == 3
    plt.close(figure)
    with pytest.raises(ValueError, match="scale: expected"):
        found.plot(scale="cube")


def test_plot_shows_the_exposure():
    from matplotlib import pyplot as plt

    found = compare(PICTURE * 9, TRUTH * 9)
    for stops in (0, -3):
        figure = found.plot(exposure=stops)
        shown = figure.axes[1].get_images()[0].get_array()
        np.testing.assert_array_equal(shown, cc.to_screen(TRUTH * 9, exposure=stops))
        plt.close(figure)


def command(*arguments):
    from cubecam.cli import app

    return CliRunner().invoke(app, ["compare", *[str(a) for a in arguments]])


def test_command(tmp_path):
    a, b, mask = (tmp_path / name for name in ("a.exr", "b.exr", "mask.png"))
    cc.save_image(a, PICTURE.astype(np.float32))
    cc.save_image(b, TRUTH.astype(np.float32))
    counts = np.zeros((24, 32, 3), np.uint8)
    counts[4:20, 6:] = 255
    cc.save_image(mask, counts)
    found = compare(cc.load_image(a), cc.load_image(b))
    done = command(a, b, "--no-flip")
    assert done.exit_code == 0, done.output
    for name, value in found.rows():
        assert f"{name:<15}{value}" in done.output
    done = command(a, b, "--no-flip", "--json", "--mask", mask)
    told = json.loads(done.output)
    want = compare(cc.load_image(a), cc.load_image(b), counts[..., 0] > 0).numbers()
    assert {name: told[name] for name in want} == want
    assert (told["picture"], told["truth"]) == (str(a), str(b))
    assert told["counted"] == 16 * 26


def test_command_ends_with_1_above_a_bound(tmp_path):
    a, b = tmp_path / "a.exr", tmp_path / "b.exr"
    cc.save_image(a, np.full((12, 12, 3), 0.5, np.float32))
    cc.save_image(b, np.full((12, 12, 3), 0.25, np.float32))
    assert command(a, b, "--no-flip", "--fail-above", "0.25").exit_code == 0
    done = command(a, b, "--no-flip", "--fail-above", "0.24")
    assert done.exit_code == 1
    assert "expected an RMSE of at most 0.24, got 0.25" in done.output
    done = command(a, tmp_path / "none.exr")
    assert done.exit_code == 1
    assert "none.exr" in done.output


def test_command_on_cubes(tmp_path):
    cube = cc.CubeMap(face_pattern(16))
    dark = cc.CubeMap((cube.faces * 0.5).astype(cube.faces.dtype))
    cube.save(tmp_path / "a.png", layout="cross")
    dark.save(tmp_path / "{face}.png", layout="faces")
    want = compare(
        cc.load_cubemap(tmp_path / "a.png"), cc.load_cubemap(tmp_path / "{face}.png")
    ).numbers()
    for more in ([], ["--cube"]):
        done = command(tmp_path / "a.png", tmp_path / "{face}.png", "--no-flip", "--json", *more)
        told = json.loads(done.output)
        assert {name: told[name] for name in want} == want
    assert want["total"] == 6 * 16 * 16


def test_command_draws(tmp_path):
    a = tmp_path / "a.exr"
    cc.save_image(a, PICTURE.astype(np.float32))
    target = tmp_path / "error.png"
    assert command(a, a, "--no-flip", "-o", target).exit_code == 0
    assert cc.load_image(target).shape[1] > 1000
    for name, text in (("error", "expected a name such as"), ("error.xyz", "xyz")):
        done = command(a, a, "--no-flip", "-o", tmp_path / name)
        assert done.exit_code == 1
        assert text in done.output
        assert not (tmp_path / name).exists()


def test_command_warns_of_numbers_that_are_not_decoded(tmp_path):
    a, b = tmp_path / "a.png", tmp_path / "b.exr"
    cc.save_image(a, TRUTH.astype(np.float32))
    cc.save_image(b, TRUTH.astype(np.float32))
    done = command(a, b, "--no-flip", "--json")
    assert f"warning: {a} holds whole numbers" in done.output
    done = command(a, b, "--no-flip", "--json", "--srgb")
    assert "warning" not in done.output
    assert json.loads(done.output)["encoding"] == "linear"
