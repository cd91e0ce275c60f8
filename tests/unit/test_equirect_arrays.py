"""Panoramas as arrays, many at once: every type against numpy, NaN anywhere, `out`, kept taps, threads and forks."""

import os
import subprocess
import sys
import textwrap
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import cubecam as cc
from cubecam import _core
from tests.reference.cube_faces import unit_texel_directions
from tests.reference.equirect import equirect_boxes, faces_to_equirect

DTYPES = ("uint8", "float16", "float32")
dtypes = pytest.mark.parametrize("dtype", DTYPES)
channels = pytest.mark.parametrize("channels", [1, 2, 3, 4])
#: How far a result may be from the exact filter: rounding to the type, and the filter in float32.
STEP = {"uint8": 0.5 / 255, "float16": 2.0**-11, "float32": 0.0}
FILTER = 4e-6


def pixels(shape, dtype="float32", seed=1):
    random = np.random.default_rng(seed)
    if dtype == "uint8":
        return random.integers(0, 256, shape, dtype=np.uint8)
    return random.random(shape).astype(dtype)


def as_floats(numbers):
    return numbers.astype(float) / (255 if numbers.dtype == np.uint8 else 1)


@dtypes
@channels
@pytest.mark.parametrize(("height", "size"), [(24, 5), (24, 8), (40, 6), (12, 16)])
def test_faces_equal_averages_over_boxes(dtype, channels, height, size):
    image = pixels((height, 2 * height, channels), dtype)
    got = cc.equirect_to_faces(image, size=size)
    assert got.dtype == dtype
    want = equirect_boxes(as_floats(image), size)
    assert np.abs(as_floats(got) - want).max() <= STEP[dtype] + FILTER


@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_boxes_under_every_center(center):
    """The widths 40 and 36 are not both a multiple of 8; sizes in turn must not share their taps."""
    for height in (20, 18, 20, 18, 20):
        image = pixels((height, 2 * height, 3))
        got = cc.equirect_to_faces(image, size=7, center=center)
        assert np.abs(got - equirect_boxes(image, 7, center)).max() <= FILTER


@dtypes
@channels
def test_panoramas_equal_the_oracle_where_pixels_are_small(dtype, channels):
    faces = pixels((6, 4, 4, channels), dtype)
    got = cc.faces_to_equirect(faces, width=128)
    assert got.dtype == dtype
    assert np.abs(as_floats(got) - faces_to_equirect(as_floats(faces), 128)).max() <= (
        STEP[dtype] + 2e-5
    )


@dtypes
@pytest.mark.parametrize("front", [(), (1,), (5,), (2, 3), (0,)])
def test_many_equal_single_ones(dtype, front):
    images = pixels((*front, 30, 60, 3), dtype)
    faces = cc.equirect_to_faces(images, size=20)
    assert faces.shape == (*front, 6, 20, 20, 3)
    back = cc.faces_to_equirect(faces, width=48, center="+x", dtype="float32")
    assert back.shape == (*front, 24, 48, 3)
    assert back.dtype == np.float32
    for i in np.ndindex(front):
        cube = cc.CubeMap.from_equirect(images[i], size=20)
        np.testing.assert_array_equal(faces[i], cube.faces)
        np.testing.assert_array_equal(
            back[i], cube.to_equirect(width=48, center="+x", dtype="float32")
        )


def test_two_channels_are_those_of_four():
    faces = pixels((3, 6, 9, 9, 4), "float16")
    four, two = cc.faces_to_equirect(faces), cc.faces_to_equirect(faces[..., 1:3])
    np.testing.assert_array_equal(two, four[..., 1:3])
    np.testing.assert_array_equal(
        cc.equirect_to_faces(two, size=5), cc.equirect_to_faces(four, size=5)[..., 1:3]
    )


def test_round_trip():
    directions = unit_texel_directions(64).astype(np.float32)
    back = cc.equirect_to_faces(cc.faces_to_equirect(directions[None]), size=64)
    assert np.abs(back[0] - directions).max() < 5e-3


@pytest.mark.parametrize("dtype", ["float16", "float32"])
@pytest.mark.parametrize("size", [1, 2, 3, 5, 16, 40])
def test_a_nan_anywhere_is_found(dtype, size, rng):
    """Also where boxes, which are as wide as a texel is at its middle, leave a gap."""
    height = 64
    image = pixels((height, 2 * height, 3), dtype)
    places: list[tuple[int, ...]] = [
        (0, 0, 0),
        (height - 1, 2 * height - 1, 2),
        (height // 2, height, 1),
    ]
    places += [tuple(int(rng.integers(n)) for n in image.shape) for _ in range(20)]
    for row, column, channel in places:
        spoiled = image.copy()
        spoiled[row, column, channel] = np.nan
        with pytest.raises(
            ValueError, match=rf"image: expected no NaN, got nan at \[{row}, {column}, {channel}\]"
        ):
            cc.CubeMap.from_equirect(spoiled, size=size)


def test_a_nan_anywhere_in_a_coarse_cube_is_found():
    """The faces' middles: two texels of half a face leave a gap between their boxes there."""
    image = np.zeros((256, 512, 1), np.float32)
    for column in range(0, 512, 16):
        image[128, column] = np.nan
        with pytest.raises(ValueError, match=rf"\[128, {column}, 0\]"):
            cc.equirect_to_faces(image, size=2)
        image[128, column] = 0


def test_nan_and_infinity_in_a_batch():
    images = pixels((2, 3, 16, 32, 3))
    images[1, 0, 4, 5, 2] = np.inf
    got = cc.equirect_to_faces(images, size=8)
    for i in np.ndindex(2, 3):
        np.testing.assert_array_equal(
            got[i], cc.CubeMap.from_equirect(images[i].copy(), size=8).faces
        )
    assert np.isfinite(got).all()
    assert got[1, 0].max() > 1000
    assert got[1, 1].max() < 1
    images[1, 2, 7, 9, 0] = np.nan
    with pytest.raises(ValueError, match=r"images: expected no NaN, got nan at \[1, 2, 7, 9, 0\]"):
        cc.equirect_to_faces(images, size=8)


def test_faces_keep_nan_where_it_has_weight():
    faces = pixels((2, 6, 8, 8, 1))
    faces[1, 2, 3, 3] = np.nan
    got = cc.faces_to_equirect(faces, width=64)
    assert np.isfinite(got[0]).all()
    assert 0 < np.isnan(got[1]).mean() < 0.1


def test_out():
    images = pixels((2, 16, 32, 3))
    want = cc.equirect_to_faces(images, size=8)
    out = np.empty_like(want)
    assert cc.equirect_to_faces(images, size=8, out=out) is out
    np.testing.assert_array_equal(out, want)
    half = np.empty(want.shape, np.float16)
    cc.equirect_to_faces(images, size=8, out=half)
    np.testing.assert_array_equal(half, want.astype(np.float16))
    back = np.empty((2, 16, 32, 3), np.uint8)
    assert cc.faces_to_equirect(want, out=back) is back
    np.testing.assert_array_equal(back, cc.faces_to_equirect(want, dtype="uint8"))


def _locked():
    out = np.empty((1, 6, 4, 4, 3), np.float32)
    out.flags.writeable = False
    return out


BAD = {
    "list": (lambda: [[1.0]], TypeError, "out: expected a numpy array or None, got list"),
    "shape": (
        lambda: np.empty((6, 4, 4, 3), np.float32),
        ValueError,
        r"out: expected shape \(1, 6, 4, 4, 3\), got \(6, 4, 4, 3\)",
    ),
    "dtype": (
        lambda: np.empty((1, 6, 4, 4, 3)),
        ValueError,
        "dtype: expected uint8, float16 or float32, got float64",
    ),
    "order": (
        lambda: np.empty((1, 6, 4, 4, 3), np.float32, order="F"),
        ValueError,
        "out: expected an array in C order",
    ),
    "locked": (_locked, ValueError, "out: expected an array that may be written"),
}


@pytest.mark.parametrize(("make", "error", "text"), BAD.values(), ids=BAD)
def test_an_out_that_does_not_fit_is_refused(make, error, text):
    with pytest.raises(error, match=text):
        cc.equirect_to_faces(np.zeros((1, 8, 16, 3), np.float32), size=4, out=make())


def test_an_out_of_another_dtype_or_of_the_same_memory_is_refused():
    memory = np.zeros(6 * 4 * 4 * 3 + 8 * 16 * 3, np.float32)
    image = memory[: 8 * 16 * 3].reshape(8, 16, 3)
    beside = memory[8 * 16 * 3 :].reshape(6, 4, 4, 3)
    cc.equirect_to_faces(image, size=4, out=beside)
    over = memory[8:][: 6 * 4 * 4 * 3].reshape(6, 4, 4, 3)
    with pytest.raises(ValueError, match="out: expected memory of its own, got that of images"):
        cc.equirect_to_faces(image, size=4, out=over)
    with pytest.raises(ValueError, match="out: expected dtype uint8, got float32"):
        cc.equirect_to_faces(image, size=4, dtype="uint8", out=beside)


@pytest.mark.parametrize(
    ("shape", "text"),
    [
        ((16, 32), "expected shape"),
        ((2, 16, 30, 3), "twice as wide as high"),
        ((16, 32, 5), r"expected 1 to 4 channels on the last axis, got 5"),
        ((16, 32, 0), r"expected 1 to 4 channels"),
    ],
)
def test_pictures_that_do_not_fit_are_refused(shape, text):
    with pytest.raises(ValueError, match=text):
        cc.equirect_to_faces(np.zeros(shape, np.float32))


@pytest.mark.parametrize("shape", [(6, 4, 4), (5, 4, 4, 3), (2, 6, 4, 5, 3), (6, 4, 4, 5)])
def test_faces_that_do_not_fit_are_refused(shape):
    with pytest.raises(ValueError, match=r"expected.*got"):
        cc.faces_to_equirect(np.zeros(shape, np.float32))


def test_a_cubemap_has_no_two_channels():
    with pytest.raises(ValueError, match="expected 1, 3 or 4 channels"):
        cc.CubeMap.from_equirect(np.zeros((8, 16, 2), np.float32))


# Kept taps


def let_go():
    """What is kept is freed before a check of memory refuses anything."""
    with pytest.raises(ValueError, match="expected what fits"):
        _core._check_memory(1e18, "a test")
    assert _core._kept_taps() == 0


def test_taps_are_kept_from_the_second_time_on():
    let_go()
    image = pixels((64, 128, 1))
    first = cc.equirect_to_faces(image, size=32)
    assert _core._kept_taps() == 0
    second = cc.equirect_to_faces(image, size=32)
    kept = _core._kept_taps()
    assert kept > 32 * 32 * 16
    third = cc.equirect_to_faces(image, size=32)
    assert _core._kept_taps() == kept
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first, third)
    let_go()
    np.testing.assert_array_equal(first, cc.equirect_to_faces(image, size=32))


def test_taps_that_nobody_uses_are_let_go():
    let_go()
    image = np.zeros((4, 8, 1), np.uint8)
    for _ in range(2):
        cc.equirect_to_faces(image, size=50)
    kept = _core._kept_taps()
    for _ in range(70):
        cc.equirect_to_faces(image, size=1)
    assert 0 < _core._kept_taps() < kept


def test_kept_taps_have_a_bound():
    let_go()
    image = np.zeros((2, 4, 1), np.uint8)
    most = 0
    for size in (700, 710, 720, 730, 740, 750, 760, 770):
        for _ in range(2):
            cc.equirect_to_faces(image, size=size)
        most = max(most, _core._kept_taps())
        assert most <= 64 << 20
    assert most > 40 << 20
    let_go()


def convert_all(seed):
    """Bytes of conversions of several sizes, each twice, so that taps are made, kept and used."""
    found = []
    for repeat in range(2):
        for height, size in ((16, 9), (20, 40), (33, 70), (16, 9)):
            faces = cc.equirect_to_faces(
                pixels((height, 2 * height, 3), "float32", seed), size=size
            )
            found.append(faces.tobytes())
            found.append(cc.faces_to_equirect(faces, width=2 * height).tobytes())
        assert found[: len(found) // (repeat + 1)] == found[-len(found) // (repeat + 1) :]
    return found


def test_threads_at_once():
    want = [convert_all(seed) for seed in range(8)]
    let_go()
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(convert_all, range(8))) == want


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="needs sched_setaffinity")
def test_one_core_gives_the_same_bytes():
    want = convert_all(5)
    cores = os.sched_getaffinity(0)
    let_go()
    try:
        os.sched_setaffinity(0, {min(cores)})
        assert convert_all(5) == want
    finally:
        os.sched_setaffinity(0, cores)


FORKS = """
import os, threading
import numpy as np
import cubecam as cc

image = np.random.default_rng(1).random((32, 64, 3)).astype(np.float32)
want = cc.equirect_to_faces(image, size=40)
end = threading.Event()

def convert():
    while not end.is_set():
        cc.equirect_to_faces(image, size=40)
        cc.faces_to_equirect(want, width=60)

threads = [threading.Thread(target=convert) for _ in range(3)]
for thread in threads: thread.start()
children = []
for _ in range(12):
    child = os.fork()
    if child == 0:
        good = all((cc.equirect_to_faces(image, size=40) == want).all() for _ in range(3))
        os._exit(0 if good else 1)
    children.append(child)
codes = [os.waitpid(child, 0)[1] for child in children]
end.set()
for thread in threads: thread.join()
print(codes)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_forks_while_others_convert():
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(FORKS)],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert done.stdout.strip() == str([0] * 12), done.stderr
