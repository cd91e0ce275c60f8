"""Panoramas, layouts and sizes keep the type of the numbers; `dtype=` gives another."""

import numpy as np
import pytest

import cubecam as cc

DTYPES = ("uint8", "float16", "float32")
CHANNELS = (1, 3, 4)
both = pytest.mark.parametrize("given", DTYPES)
wanted = pytest.mark.parametrize("wanted", DTYPES)
channels = pytest.mark.parametrize("channels", CHANNELS)


def numbers(shape, dtype, seed=1):
    """Random numbers of a type; of the floats, some are below 0 and some above 1."""
    random = np.random.default_rng(seed)
    if dtype == "uint8":
        return random.integers(0, 256, shape, dtype=np.uint8)
    return (random.random(shape) * 1.5 - 0.25).astype(dtype)


def as_floats(pixels):
    floats = pixels.astype(np.float32)
    return floats / np.float32(255) if pixels.dtype == np.uint8 else floats


def as_dtype(floats, dtype):
    """Convert float32 numbers to a type: uint8 clamps them to 0..1 and rounds to nearest, float16 rounds to nearest."""
    if dtype == "uint8":
        return np.floor(np.clip(floats, 0, 1) * np.float32(255) + np.float32(0.5)).astype(np.uint8)
    return floats.astype(dtype)


def same(got, want, name=""):
    assert got.dtype == want.dtype, name
    np.testing.assert_array_equal(got, want, err_msg=name)


#: Every conversion: a function of an array and the options, and the shape of the array. What a
#: conversion gives in float32 from float32 is compared with numpy by other tests.
CONVERSIONS = {
    "from_equirect": (lambda a, **o: cc.CubeMap.from_equirect(a, size=8, **o).faces, (16, 32)),
    "from_equirect enlarged": (
        lambda a, **o: cc.CubeMap.from_equirect(a, size=90, **o).faces,
        (16, 32),
    ),
    "from_equirect borders": (
        lambda a, **o: cc.CubeMap.from_equirect(a, size=9, sampling="borders", **o).faces,
        (15, 33),
    ),
    "to_equirect": (lambda a, **o: cc.CubeMap(a).to_equirect(width=48, **o), (6, 12, 12)),
    "to_equirect shrunk": (lambda a, **o: cc.CubeMap(a).to_equirect(width=10, **o), (6, 90, 90)),
    "to_equirect borders": (
        lambda a, **o: cc.CubeMap(a).to_equirect(width=20, sampling="borders", **o),
        (6, 7, 7),
    ),
    "resize down": (lambda a, **o: cc.CubeMap(a).resize(5, **o).faces, (6, 12, 12)),
    "resize up": (lambda a, **o: cc.CubeMap(a).resize(75, **o).faces, (6, 12, 12)),
    "resize to one": (lambda a, **o: cc.CubeMap(a).resize(1, **o).faces, (6, 70, 70)),
    "to_layout cross": (lambda a, **o: cc.CubeMap(a).to_layout("cross", **o), (6, 6, 6)),
    "to_layout equirect": (lambda a, **o: cc.CubeMap(a).to_layout("equirect", **o), (6, 6, 6)),
    "to_layout openexr": (lambda a, **o: cc.CubeMap(a).to_layout("openexr", **o), (6, 6, 6)),
    "from_layout row": (lambda a, **o: cc.CubeMap.from_layout(a, **o).faces, (7, 42)),
    "from_layout equirect": (lambda a, **o: cc.CubeMap.from_layout(a, **o).faces, (16, 32)),
    "from_layout openexr": (
        lambda a, **o: cc.CubeMap.from_layout(a, layout="openexr", **o).faces,
        (42, 7),
    ),
}


@pytest.mark.parametrize("name", CONVERSIONS)
@both
@wanted
@channels
def test_every_dtype_and_channel_count(name, given, wanted, channels):
    convert, shape = CONVERSIONS[name]
    pixels = numbers((*shape, channels), given)
    exact = convert(as_floats(pixels))
    assert exact.dtype == np.float32
    same(convert(pixels, dtype=wanted), as_dtype(exact, wanted))
    same(convert(pixels), as_dtype(exact, given))


def test_large_pictures_go_through_many_tiles():
    """The pictures need several tiles of 64 pixels; some tiles are mirrored, and some lie over the poles."""
    pixels = numbers((256, 512, 3), "float32")
    exact = cc.CubeMap.from_equirect(pixels, size=150)
    for dtype in DTYPES:
        same(
            cc.CubeMap.from_equirect(pixels, size=150, dtype=dtype).faces,
            as_dtype(exact.faces, dtype),
        )
        same(
            exact.to_equirect(width=400, dtype=dtype), as_dtype(exact.to_equirect(width=400), dtype)
        )


@both
def test_a_constant_stays_that_constant(given):
    """All 256 bytes, and forty numbers of a float type, stay the same bit for bit."""
    values = np.arange(256) if given == "uint8" else np.linspace(-3, 60000, 40)
    for value in values.astype(given):
        cube = cc.CubeMap.from_equirect(np.full((8, 16, 1), value, given), size=5)
        for pixels in (cube.faces, cube.to_equirect(width=10), cube.resize(3).faces):
            assert pixels.dtype == given
            assert (pixels == value).all()


def test_uint8_is_rounded_to_nearest():
    """Two texels become one: the result is the byte nearest to their mean, which may lie half-way between bytes."""
    for low, high, want in ((10, 11, 11), (10, 13, 12), (0, 255, 128), (7, 7, 7)):
        faces = np.empty((6, 2, 2, 1), np.uint8)
        faces[:, :, 0], faces[:, :, 1] = low, high
        assert abs(int(cc.CubeMap(faces).resize(1).faces[0, 0, 0, 0]) - (low + high) / 2) <= 0.5
        exact = cc.CubeMap(faces.astype(np.float32) / 255).resize(1).faces
        assert cc.CubeMap(faces).resize(1).faces[0, 0, 0, 0] == np.floor(
            exact[0, 0, 0, 0] * 255 + 0.5
        )
        assert want - 1 <= cc.CubeMap(faces).resize(1).faces[0, 0, 0, 0] <= want


def test_what_a_type_cannot_hold():
    bright = np.full((8, 16, 3), 70000, np.float32)
    bright[..., 1] = -5
    cube = cc.CubeMap.from_equirect(bright, size=4)
    assert cube.resize(2, dtype="uint8").faces[0, 0, 0].tolist() == [255, 0, 255]
    assert cube.resize(2, dtype="float16").faces[0, 0, 0].tolist() == [np.inf, -5, np.inf]


@both
def test_infinities_count_as_the_largest_number(given):
    pixels = np.ones((16, 32, 1), given)
    if given != "uint8":
        pixels[4, 7] = np.inf
    cube = cc.CubeMap.from_equirect(pixels, size=8)
    assert cube.dtype == given
    assert np.isfinite(cube.faces).all()
    assert cube.faces.max() == 1 if given == "uint8" else cube.faces.max() > 10000


def test_nan_in_a_panorama_is_found():
    pixels = np.zeros((16, 32, 3), np.float16)
    pixels[3, 5, 1] = np.nan
    with pytest.raises(ValueError, match=r"image: expected no NaN, got nan at \[3, 5, 1\]"):
        cc.CubeMap.from_equirect(pixels)


@both
def test_sample_gives_float32(given):
    faces = numbers((6, 8, 8, 3), given)
    directions = [[1.0, 0.0, 0.0], [0.3, -1.0, 0.2]]
    got = cc.CubeMap(faces).sample(directions)
    same(got, cc.CubeMap(as_floats(faces)).sample(directions))


def test_float64_becomes_float32():
    assert cc.CubeMap.from_equirect(np.zeros((4, 8, 1))).dtype == np.float32


@pytest.mark.parametrize(
    "dtype", [np.uint8, np.dtype("float16"), "f4", "<f2", np.float32], ids=lambda d: str(d)
)
def test_dtypes_by_any_name(dtype):
    assert cc.CubeMap(np.zeros((6, 4, 4, 1))).resize(2, dtype=dtype).dtype == np.dtype(dtype)


BAD = {
    "float64": ("float64", ValueError, "dtype: expected uint8, float16 or float32, got float64"),
    "int": (int, ValueError, "got int64"),
    "uint16": (np.uint16, ValueError, "got uint16"),
    "big-endian": (">f4", ValueError, "got >f4"),
    "text": ("pixels", TypeError, "pixels"),
    "number": (8, TypeError, "expected uint8, float16 or float32, got 8"),
}


@pytest.mark.parametrize(("dtype", "error", "text"), BAD.values(), ids=BAD)
@pytest.mark.parametrize("name", CONVERSIONS)
def test_other_dtypes_are_refused(name, dtype, error, text):
    convert, shape = CONVERSIONS[name]
    with pytest.raises(error, match=text):
        convert(np.zeros((*shape, 1), np.float32), dtype=dtype)


@both
def test_files(tmp_path, given):
    """Loading keeps the type of the file, or gives the one that is named."""
    pixels = numbers((16, 32, 3), given)
    path = tmp_path / ("pano.png" if given == "uint8" else "pano.exr")
    cc.save_image(path, pixels)
    want = cc.CubeMap.from_equirect(pixels, size=8)
    for load in (cc.load_environment, cc.load_cubemap):
        assert load(path, size=8) == want
        assert load(path, size=8).dtype == given
        other = load(path, size=8, dtype="float32")
        assert other == cc.CubeMap.from_equirect(pixels, size=8, dtype="float32")
        assert other.encoding == ("srgb" if given == "uint8" else "linear")
    faces = cc.CubeMap(numbers((6, 8, 8, 3), given))
    cross = tmp_path / f"cross{path.suffix}"
    faces.save(cross, layout="cross")
    for dtype in DTYPES:
        assert cc.load_cubemap(cross, dtype=dtype) == cc.CubeMap(
            as_dtype(as_floats(faces.faces), dtype), encoding=faces.encoding
        )
        assert cc.load_cubemap(cross, size=4, dtype=dtype) == faces.resize(4, dtype=dtype)
