"""One way to compare arrays: a failure says how much and where they differ, and leaves a picture of the difference."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.helpers import on_llvmpipe, only_on_llvmpipe
from tests.reference.cube_faces import FACE_NAMES
from tests.tolerances import TOLERANCES

#: Why bytes may differ on another driver.
ACROSS = {
    "programs": "other shaders drew the two sides: OpenGL lets their last bits differ",
    "filters": "GPUs round the weights of texture filters",
}

FAILURES = Path(__file__).parent / "failures"


def assert_close(got, expected, tolerance, mask=None, name="difference", least=0.2):
    """Compare by an entry of tolerances.TOLERANCES.

    mask: True where to compare, over the leading axes; `least` of it must be True, so that a test that compares
    nothing fails. NaN and infinities must stand in the same places. An entry with `elsewhere` is wider on a driver
    other than llvmpipe, or skips the test there.
    """
    rule = TOLERANCES[tolerance]
    got, expected = np.asarray(got), np.asarray(expected)
    if rule.elsewhere != 0 and not on_llvmpipe():
        rule = rule_elsewhere(rule, expected)
    assert got.shape == expected.shape, f"{name}: expected shape {expected.shape}, got {got.shape}"
    if mask is None:
        mask = np.ones(got.shape[:1], bool)
    kept = mask.mean() if mask.size else 0.0
    assert kept >= least, f"{name}: the mask leaves {kept:.1%} to compare, {least:.0%} are needed"
    chosen = np.broadcast_to(mask.reshape(mask.shape + (1,) * (got.ndim - mask.ndim)), got.shape)

    a, b = got.astype(float), expected.astype(float)
    finite = np.isfinite(b)
    same_kind = np.where(finite, np.isfinite(a), (a == b) | (np.isnan(a) & np.isnan(b)))
    with np.errstate(invalid="ignore"):
        difference = np.where(
            finite & np.isfinite(a), np.abs(a - b), np.where(same_kind, 0.0, np.inf)
        )
        excess = difference - np.where(finite, rule.absolute + rule.relative * np.abs(b), 0.0)
    difference, excess = np.where(chosen, difference, 0.0), np.where(chosen, excess, -1.0)
    mean = difference[chosen].mean() if chosen.any() else 0.0
    beyond = excess > 0
    few = (
        beyond.sum() <= rule.outliers * chosen.sum() and (difference[beyond] <= rule.outlier).all()
    )
    if (few or not beyond.any()) and mean <= rule.mean:
        return
    worst = np.unravel_index(np.argmax(excess), excess.shape)
    bad = int(beyond.sum())
    picture = save_difference(got, expected, difference, name)
    raise AssertionError(
        f"{name}: {bad} of {int(chosen.sum())} values are off by more than {rule.absolute:g} "
        f"+ {rule.relative:g} of the value ({tolerance}: {rule.reason}).\n"
        f"  largest {difference.max():g}, mean {mean:g} (allowed {rule.mean:g})\n"
        f"  worst at {place(worst, got.shape)}: got {got[worst]!r}, expected {expected[worst]!r}\n"
        f"  pictures (got, expected, difference): {picture}"
    )


def rule_elsewhere(rule, expected):
    """The tolerance on a driver other than llvmpipe; skips the test if there is none."""
    if rule.elsewhere is None:
        only_on_llvmpipe(rule.reason)
    finite = expected[np.isfinite(expected)]
    reach = float(np.ptp(finite.astype(float))) if finite.size else 0.0
    return replace(rule, absolute=rule.absolute + rule.elsewhere * reach, mean=float("inf"))


def place(index, shape):
    """An index in words: (face, row, column, channel) where the array is a cube's."""
    index = tuple(int(i) for i in index)
    if len(shape) >= 3 and shape[0] == 6 and shape[1] == shape[2]:
        words = f"face {FACE_NAMES[index[0]]}, row {index[1]}, column {index[2]}"
        return words + (f", channel {index[3]}" if len(index) > 3 else "")
    return f"index {index}"


def save_difference(got, expected, difference, name):
    """Save three strips, one above the other, as a PNG below tests/failures; None if the arrays are no pictures."""
    strips = [picture_of(array) for array in (got, expected, difference)]
    if any(strip is None for strip in strips):
        return None
    from PIL import Image

    scale = np.nanmax(np.where(np.isfinite(strips[1]), strips[1], 0)) or 1.0
    worst = np.nanmax(np.where(np.isfinite(strips[2]), strips[2], 0)) or 1.0
    strips = [strips[0] / scale, strips[1] / scale, strips[2] / worst]
    pixels = np.clip(np.nan_to_num(np.concatenate(strips), posinf=1.0), 0, 1) * 255
    FAILURES.mkdir(exist_ok=True)
    words = re.sub(r"[^\w.+-]+", "_", f"{current_test()}-{name}")
    path = FAILURES / (words[:200] + ".png")  # a file's name has at most 255 bytes
    Image.fromarray(pixels.astype(np.uint8)).save(path)
    return path


def picture_of(array):
    """(H, W, 3) floats of a cube's faces side by side, or of a picture; None if it is neither."""
    array = np.asarray(array, float)
    if array.ndim >= 3 and array.shape[0] == 6:
        array = np.concatenate(list(array), axis=1)
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or min(array.shape[:2]) < 2 or array.shape[2] > 4:
        return None
    if array.shape[2] == 2:
        array = np.concatenate([array, np.zeros_like(array[..., :1])], axis=-1)
    return np.broadcast_to(array[..., :3], (*array.shape[:2], 3))


def current_test():
    import os

    return os.environ.get("PYTEST_CURRENT_TEST", "outside").split(" ")[0].split("/")[-1]


def assert_identical(got, expected, name="bytes", across=None):
    """Compare bit for bit, with shape and dtype.

    Without `across`, the bytes are equal on any driver: they are copies, or the same programs drew them from the same
    state, which OpenGL makes repeatable (GL 4.5, appendix A.2). `across` names what differs between the two sides:

    - "programs": other shaders drew them, such as those with further outputs or those of the other drawing path.
      OpenGL lets their last bits differ (appendix A.3, rule 4); llvmpipe's are equal.
    - "filters": one side comes from a texture that is read with a filter. GPUs round the weights of filters.

    With `across` the test is skipped on a driver other than llvmpipe.
    """
    if across is not None and not on_llvmpipe():
        only_on_llvmpipe(ACROSS[across])
    got, expected = np.asarray(got), np.asarray(expected)
    assert got.dtype == expected.dtype, f"{name}: expected {expected.dtype}, got {got.dtype}"
    if got.shape == expected.shape and got.tobytes() == expected.tobytes():
        return
    assert_close(got, expected, "exact", name=name)
    raise AssertionError(
        f"{name}: equal as numbers, but not bit for bit (signed zeros or NaN payloads)"
    )
