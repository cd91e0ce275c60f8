"""truth.compare against numpy written from the definitions, and what it refuses."""

import sys

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import Comparison
from cubecam.truth.measures import scores as _measures
from tests.truth.two_pictures import HAS_FLIP, PICTURE, TRUTH, compare, needs_flip


def srgb(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def neutral(light):
    """The Khronos PBR Neutral Tone Mapper, pixel by pixel."""
    shown = np.empty_like(light)
    for place in np.ndindex(light.shape[:2]):
        low = light[place].min()
        color = light[place] - (low - 6.25 * low * low if low < 0.08 else 0.04)
        peak = color.max()
        if peak >= 0.76:
            d = 0.24
            new = 1 - d * d / (peak + d - 0.76)
            g = 1 - 1 / (0.15 * (peak - new) + 1)
            color = color * new / peak * (1 - g) + new * g
        shown[place] = color
    return shown


def wang(x, y):
    """SSIM of one channel, window by window: Wang et al. 2004, equations 13 to 17."""
    offsets = np.arange(-5, 6)
    w = np.exp(-(offsets[:, None] ** 2 + offsets[None, :] ** 2) / (2 * 1.5**2))
    w /= w.sum()
    rows = []
    for i in range(5, x.shape[0] - 5):
        for j in range(5, x.shape[1] - 5):
            a, b = (one[i - 5 : i + 6, j - 5 : j + 6] for one in (x, y))
            ma, mb = (w * a).sum(), (w * b).sum()
            va, vb = (w * (a - ma) ** 2).sum(), (w * (b - mb) ** 2).sum()
            cov = (w * (a - ma) * (b - mb)).sum()
            c1, c2 = 0.01**2, 0.03**2
            rows.append(
                (2 * ma * mb + c1) * (2 * cov + c2) / ((ma**2 + mb**2 + c1) * (va + vb + c2))
            )
    return np.array(rows).reshape(x.shape[0] - 10, x.shape[1] - 10)


def wang_map(x, y):
    return np.mean([wang(x[..., k], y[..., k]) for k in range(3)], axis=0)


def test_numbers_are_the_definitions():
    found = compare(PICTURE, TRUTH)
    apart = PICTURE - TRUTH
    assert found.rmse == pytest.approx(np.sqrt((apart**2).mean()), rel=1e-12)
    assert found.relative_rmse == pytest.approx(
        np.sqrt((apart**2).sum() / (TRUTH**2).sum()), rel=1e-12
    )
    assert found.mean_absolute == pytest.approx(np.abs(apart).mean(), rel=1e-12)
    np.testing.assert_array_equal(found.error, np.abs(apart).max(axis=-1))
    row, column, channel = np.unravel_index(np.abs(apart).argmax(), apart.shape)
    assert found.worst == (row, column)
    assert found.max == abs(apart[row, column, channel])
    assert found.picture_value == tuple(PICTURE[row, column])
    assert found.truth_value == tuple(TRUTH[row, column])
    assert (found.counted, found.total, found.not_finite) == (768, 768, 0)
    assert isinstance(found, Comparison)


def test_relative_rmse_is_of_the_truth_and_not_of_the_picture():
    assert compare(TRUTH * 3, TRUTH).relative_rmse == pytest.approx(2)
    assert compare(TRUTH, TRUTH * 3).relative_rmse == pytest.approx(2 / 3)


@pytest.mark.parametrize("bright", [1, 5])
def test_ssim_of_light_is_that_of_the_screen(bright):
    found = compare(PICTURE * bright, TRUTH * bright)
    shown = [srgb(neutral(one * bright)) for one in (PICTURE, TRUTH)]
    assert found.ssim == pytest.approx(wang_map(*shown).mean(), abs=2e-6)  # curves in float32


def test_ssim_of_encoded_numbers_is_of_these_numbers():
    picture, truth = (np.round(255 * one).astype(np.uint8) for one in (PICTURE, TRUTH))
    want = wang_map(picture / 255, truth / 255).mean()
    assert compare(picture, truth).ssim == pytest.approx(want, abs=1e-9)
    same = compare(picture / 255, truth / 255, encoding="srgb")
    assert same.ssim == pytest.approx(want, abs=1e-9)
    linear = compare(picture, truth, encoding="linear").ssim
    assert linear == pytest.approx(
        wang_map(srgb(picture / 255), srgb(truth / 255)).mean(), abs=2e-6
    )


def test_objects_say_what_their_numbers_are():
    numbers = [np.round(255 * one).astype(np.uint8) for one in (PICTURE, TRUTH)]
    similar = {}
    for encoding in ("linear", "srgb"):
        pictures = [cc.Image(one, encoding=encoding) for one in numbers]
        found = compare(*pictures)
        assert found.encoding == encoding
        assert compare(numbers[0], pictures[1]).ssim == found.ssim
        assert compare(*numbers, encoding=encoding).ssim == found.ssim
        similar[encoding] = found.ssim
    assert similar["linear"] != similar["srgb"]


def test_ssim_with_a_mask_is_the_mean_of_what_counts():
    mask = np.zeros(TRUTH.shape[:2], bool)
    mask[3:15, 4:20] = True
    found = compare(PICTURE, TRUTH, mask, encoding="srgb")
    map_of = wang_map(np.where(mask[..., None], PICTURE, TRUTH), TRUTH)
    assert found.ssim == pytest.approx(map_of[mask[5:-5, 5:-5]].mean(), abs=1e-9)


@needs_flip
def test_flip_of_equal_pictures_is_0_and_black_for_white_is_near_1():
    black, white = np.zeros((48, 48, 3), np.uint8), np.full((48, 48, 3), 255, np.uint8)
    assert compare(PICTURE, PICTURE, flip=True).flip == 0
    assert compare(4 * PICTURE, 4 * PICTURE, flip=True).flip == 0
    found = compare(black, white, flip=True)
    # The largest colour difference of HyAB is that of green and blue; black and white reach .967 of it (HPG 2020).
    assert found.flip == pytest.approx(0.967, abs=0.001)
    assert found.flip_range == "LDR"
    assert compare(white, black, flip=True).flip == pytest.approx(found.flip, abs=1e-6)


@needs_flip
def test_flip_is_that_of_its_authors():
    picture, truth = PICTURE.astype(np.float32), TRUTH.astype(np.float32)

    def their(p, t, kind, **options):
        return pytest.importorskip("flip_evaluator").evaluate(
            t, p, kind, applyMagma=False, **options
        )[0][..., 0]

    found = compare(picture, truth, flip=True)
    np.testing.assert_allclose(found.flip_map, their(picture, truth, "LDR", inputsRGB=False))
    assert found.flip == pytest.approx(found.flip_map.mean(), rel=1e-5)
    found = compare(picture, truth, encoding="srgb", flip=True)
    np.testing.assert_allclose(found.flip_map, their(picture, truth, "LDR", inputsRGB=True))
    found = compare(9 * picture, 9 * truth, flip=True)
    assert found.flip_range == "HDR"
    np.testing.assert_allclose(
        found.flip_map, their(9 * picture, 9 * truth, "HDR"), rtol=0, atol=1e-4
    )
    # Errors are symmetric only at one exposure: those of HDR-FLIP follow from the truth.
    other = compare(9 * truth, 9 * picture, flip=True)
    assert other.flip == pytest.approx(found.flip, abs=0.02)
    assert other.flip != found.flip


@needs_flip
def test_flip_with_a_mask_is_the_mean_of_what_counts():
    mask = np.zeros(TRUTH.shape[:2], bool)
    mask[3:15, 4:20] = True
    found = compare(PICTURE, TRUTH, mask, flip=True)
    whole = compare(np.where(mask[..., None], PICTURE, TRUTH), TRUTH, flip=True)
    assert found.flip_map is not None
    assert whole.flip_map is not None
    np.testing.assert_array_equal(found.flip_map[mask], whole.flip_map[mask])
    assert np.isnan(found.flip_map[~mask]).all()
    assert found.flip == pytest.approx(whole.flip_map[mask].mean(), rel=1e-5)


@needs_flip
def test_the_truth_alone_decides_between_ldr_and_hdr():
    bright = PICTURE.copy()
    bright[3, 3] = 50
    found = compare(bright, TRUTH, flip=True)
    assert found.flip_range == "LDR"
    assert found.flip == compare(np.minimum(bright, 1), TRUTH, flip=True).flip
    assert compare(PICTURE, bright, flip=True).flip_range == "HDR"
    mask = np.ones(TRUTH.shape[:2], bool)
    mask[3, 3] = False
    assert compare(PICTURE, bright, mask, flip=True).flip_range == "LDR"
    assert compare(PICTURE * 2, bright, encoding="srgb", flip=True).flip_range == "LDR"


@needs_flip
def test_exposures_of_truths_that_end_their_program():
    """flip_evaluator ends the interpreter if it finds no exposures; a truth that is mostly black has a median of 0."""
    truth = np.zeros((24, 32, 3))
    truth[4, 5] = (0, 1e30, 0)
    found = compare(truth * 0, truth, flip=True)
    assert found.flip_range == "HDR"
    assert 0 < found.flip < 0.2
    assert compare(truth, truth * 0, flip=True).flip_range == "LDR"
    start, stop = _measures.exposures(np.array([[1e-9, 1e-9, 1e-9], [4.0, 4, 4]])[[0, 0, 0, 1]])
    assert stop - start == 24


def test_flip_that_is_not_there(monkeypatch):
    monkeypatch.setitem(sys.modules, "flip_evaluator", None)
    monkeypatch.setitem(sys.modules, "skimage.metrics", None)
    found = compare(PICTURE, TRUTH, flip=True)
    assert found.flip is found.flip_map is found.flip_range is found.ssim is None
    assert "ssim needs scikit-image" in found.notes[0]
    assert "flip needs flip-evaluator" in found.notes[1]
    assert found.rmse > 0
    monkeypatch.setattr(sys, "version_info", (3, 14, 0, "final", 0))
    assert "no wheel for Python 3.14" in compare(PICTURE, TRUTH, flip=True).notes[1]
    assert compare(PICTURE, TRUTH).notes[1] == "flip=False"


def test_masks():
    mask = np.zeros((24, 32), bool)
    mask[5:, 7:] = True
    found = compare(PICTURE, TRUTH, mask)
    part = compare(PICTURE[5:, 7:], TRUTH[5:, 7:])
    for name in ("rmse", "relative_rmse", "mean_absolute", "max", "picture_value", "counted"):
        assert getattr(found, name) == pytest.approx(getattr(part, name), rel=1e-12), name
    assert found.worst == (part.worst[0] + 5, part.worst[1] + 7)
    assert np.isnan(found.error[~mask]).all()
    np.testing.assert_array_equal(found.error[5:, 7:], part.error)


def test_what_does_not_count_changes_nothing():
    mask = np.ones((24, 32), bool)
    mask[8:12, 8:12] = False
    wild = PICTURE.copy()
    wild[~mask] = (np.nan, 1e9, -np.inf)
    found, other = (compare(one, TRUTH, mask, flip=HAS_FLIP) for one in (PICTURE, wild))
    assert found.numbers() == other.numbers()
    assert other.not_finite == 0


def test_pixels_that_are_not_finite():
    picture, truth = PICTURE.copy(), TRUTH.copy()
    picture[2, 3, 1] = np.nan
    truth[4, 5, 0] = np.inf
    picture[4, 5, 0] = np.inf
    found = compare(picture, truth, flip=HAS_FLIP)
    mask = np.ones((24, 32), bool)
    mask[2, 3] = mask[4, 5] = False
    assert found.rmse == compare(PICTURE, TRUTH, mask).rmse
    assert (found.not_finite, found.counted) == (2, 766)
    assert np.isfinite([found.ssim, found.mean_absolute]).all()
    assert "2 pixels, which do not count" in repr(found)
    with pytest.raises(ValueError, match="both pictures are finite, got none among 768"):
        compare(PICTURE * np.nan, TRUTH)


def test_great_numbers_stay_finite():
    found = compare(TRUTH * 2e300, TRUTH * 1e300, flip=HAS_FLIP)
    assert found.relative_rmse == pytest.approx(1)
    assert found.rmse == pytest.approx(1e300 * np.sqrt((TRUTH**2).mean()))
    assert np.isfinite(found.ssim)


def test_a_black_truth_has_no_relative_error():
    found = compare(PICTURE, TRUTH * 0)
    assert found.relative_rmse is None
    assert "the truth is black" in found.notes[0]


def test_kinds_of_pictures_agree():
    with cc.Renderer() as renderer:
        scene = cc.Scene(background=(0.2, 0.4, 0.8))
        frame = renderer.render(scene, cc.PerspectiveCamera(), (12, 14))
    assert frame.color is not None
    grey = np.full((14, 12, 3), 0.5)
    found = compare(frame, grey)
    assert found.encoding == frame.encoding
    want = np.abs(frame.color[..., :3] / 255 - 0.5)
    np.testing.assert_allclose(found.error, want.max(axis=-1), rtol=1e-12)
    assert compare(np.asarray(frame), grey).rmse == found.rmse
    assert compare(cc.Image(frame.color), grey).rmse == found.rmse
    half = PICTURE.astype(np.float16)
    assert compare(half, TRUTH).rmse == compare(half.astype(float), TRUTH).rmse
    sixteen = np.full((12, 12, 3), 65535, np.uint16)
    assert compare(sixteen, np.ones((12, 12, 3))).rmse == 0
    assert compare(PICTURE[..., 0], TRUTH[..., :1]).max == pytest.approx(
        np.abs(PICTURE - TRUTH)[..., 0].max()
    )


def test_alpha_is_left_out():
    alphas = [np.full((24, 32, 1), a) for a in (0.2, 0.9)]
    one, other = (np.concatenate([p, a], -1) for p, a in zip((PICTURE, TRUTH), alphas, strict=True))
    assert compare(one, other).numbers() == compare(PICTURE, TRUTH).numbers()
    assert compare(one, TRUTH).rmse == compare(PICTURE, TRUTH).rmse


def test_cubes():
    truth = np.stack([np.roll(TRUTH[:24, :24], 3 * k, axis=0) for k in range(6)]).astype(np.float32)
    picture = truth * 0.9
    picture[4, 3, 8] += 0.5
    found = compare(cc.CubeMap(picture), cc.CubeMap(truth), flip=HAS_FLIP)
    assert found.worst == (4, 3, 8)
    assert found.error.shape == (6, 24, 24)
    assert "at +Z, row 3, column 8" in repr(found)
    faces = [compare(p, t, flip=HAS_FLIP) for p, t in zip(picture, truth, strict=True)]
    assert found.ssim == pytest.approx(np.mean([one.ssim for one in faces]), abs=1e-12)
    assert found.rmse == pytest.approx(np.sqrt(np.mean([one.rmse**2 for one in faces])))
    if HAS_FLIP:
        assert found.flip == pytest.approx(np.mean([one.flip for one in faces]), abs=1e-6)
    assert compare(picture, cc.CubeMap(truth)).rmse == found.rmse
    mask = np.zeros((6, 24, 24), bool)
    mask[1] = True
    assert compare(picture, truth, mask).rmse == pytest.approx(faces[1].rmse)


def test_small_pictures_have_no_ssim():
    assert compare(TRUTH[:10], TRUTH[:10]).ssim is None
    assert compare(TRUTH[:10], TRUTH[:10]).notes[0] == "ssim needs 11 x 11 pixels, got 10 x 32"
    assert compare(TRUTH[:11, :11], TRUTH[:11, :11]).ssim == 1
    mask = np.zeros((24, 32), bool)
    mask[:5] = True
    assert "5 or more pixels from the borders" in compare(PICTURE, TRUTH, mask).notes[0]


def image(encoding):
    return cc.Image(np.zeros((4, 6, 3), np.uint8), encoding=encoding)


REFUSED = {
    "sizes": (
        lambda: compare(TRUTH, TRUTH[1:]),
        r"got \(24, 32, 3\) and \(23, 32, 3\)",
    ),
    "channels": (
        lambda: compare(TRUTH, TRUTH[..., :1]),
        r"one size and number of colour channels, got \(24, 32, 3\) and \(24, 32, 1\)",
    ),
    "shape": (lambda: compare(np.zeros((5, 4, 4, 3)), TRUTH), r"picture: expected \(H, W\)"),
    "no picture": (lambda: compare(TRUTH, None), "truth: expected"),
    "ids": (lambda: compare(np.zeros((4, 4, 3), np.int32), TRUTH), "picture: expected floats"),
    "mask of numbers": (
        lambda: compare(PICTURE, TRUTH, np.ones((24, 32))),
        "mask: expected an array of bool, got dtype float64",
    ),
    "mask of another size": (
        lambda: compare(PICTURE, TRUTH, np.ones((24, 31), bool)),
        r"mask: expected the pictures' shape \(24, 32\), got \(24, 31\)",
    ),
    "empty mask": (
        lambda: compare(PICTURE, TRUTH, np.zeros((24, 32), bool)),
        "mask: expected at least one pixel that counts, got none",
    ),
    "encodings": (
        lambda: compare(image("srgb"), image("linear")),
        "expected two pictures of one encoding, got srgb and linear",
    ),
    "encoding that is another": (
        lambda: compare(image("srgb"), image("srgb"), encoding="linear"),
        "encoding: expected srgb, as the picture says, got linear",
    ),
}


@pytest.mark.parametrize(("call", "text"), REFUSED.values(), ids=REFUSED)
def test_refused(call, text):
    with pytest.raises((ValueError, TypeError), match=text):
        call()


def test_frames_of_two_looks_are_refused():
    camera = cc.PerspectiveCamera()
    with cc.Renderer() as renderer:
        scene = cc.Scene(background=(0.2, 0.4, 0.8))
        plain, mapped = (
            renderer.render(scene, camera, (12, 12), tonemap=curve, format="rgba32f")
            for curve in (None, "neutral")
        )
    with pytest.raises(ValueError, match="one look"):
        compare(plain, mapped)
    assert compare(mapped, mapped).curve is False
    assert compare(plain, plain).curve is True


def test_tables():
    import rich.console

    found = compare(PICTURE, TRUTH)
    console = rich.console.Console(width=100)
    with console.capture() as captured:
        console.print(found)
    for text in (repr(found), found._repr_html_(), captured.get()):
        for name, value in found.rows():
            assert name in text
            assert value in text
    assert "row" not in dict(compare(TRUTH, TRUTH).rows())["max"]
