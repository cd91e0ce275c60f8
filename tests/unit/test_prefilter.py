"""CubeMap.prefilter and irradiance: against sums over all texels, energy, types, copies, progress and Ctrl-C."""

import os
import signal
import threading

import numpy as np
import pytest

import cubecam as cc
from tests.cubes import noise, photograph, random_directions, rms
from tests.helpers import channel_counts, copies, dtypes
from tests.reference import lighting
from tests.reference.cube_faces import unit_texel_directions

PHOTOGRAPHS = ("courtyard", "forest", "interior", "studio", "sunrise", "sunset")


def error_of(level, cube, roughness, directions):
    expected = lighting.filtered(cube.faces, directions, roughness)
    return rms(cc.CubeMap(level).sample(directions) - expected) / rms(expected)


@pytest.mark.parametrize("name", ["interior", "sunrise"])
def test_lookups_of_photographs_agree_with_the_sum_over_all_texels(name):
    """Karis 2013 by brute force. These photographs have small lamps and the sun; the limits are half of the marks."""
    cube = photograph(name, 128)
    made = cube.prefilter()
    directions = random_directions(60)
    for level, roughness in zip(made.levels[1:], made.roughness[1:], strict=True):
        error = error_of(level, cube, roughness, directions)
        assert error < (0.003 if roughness >= 0.35 else 0.005), (roughness, error)


@pytest.mark.slow
@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_the_marks_of_a_256_cube(name):
    cube = photograph(name, 256)
    made = cube.prefilter()
    directions = random_directions(24, seed=2)
    for level, roughness in zip(made.levels[1:], made.roughness[1:], strict=True):
        error = error_of(level, cube, roughness, directions)
        assert error < (0.003 if roughness >= 0.35 else 0.006), (roughness, error)


@pytest.mark.parametrize("levels", [3, 11])
def test_other_numbers_of_levels(levels):
    cube = photograph("interior", 128)
    made = cube.prefilter(levels)
    assert made.roughness.tolist() == np.linspace(0, 1, levels, dtype=np.float32).tolist()
    directions = random_directions(40)
    for level, roughness in zip(made.levels[1:], made.roughness[1:], strict=True):
        if roughness < 0.2:
            continue  # such lobes are as narrow as the texels of this cube
        assert error_of(level, cube, roughness, directions) < 0.01, roughness


def test_a_lamp_of_one_texel():
    """In the dark, all that a level holds is the lobe around the lamp."""
    faces = np.zeros((6, 64, 64, 3), np.float32)
    faces[2, 20, 37] = (3000, 1000, 200)
    cube = cc.CubeMap(faces)
    made = cube.prefilter()
    directions = random_directions(400)
    for level, roughness in zip(made.levels[2:], made.roughness[2:], strict=True):
        assert error_of(level, cube, roughness, directions) < 0.01, roughness


def test_light_that_is_not_negative_stays_so():
    """Where the cosine of a lamp ends, sharpening the levels for bilinear lookups would give negative light."""
    faces = np.zeros((6, 32, 32, 3), np.float32)
    faces[2, 20, 27] = 1e6
    cube = cc.CubeMap(faces)
    for level in (*cube.prefilter().levels, cube.irradiance(16).faces):
        assert level.min() == 0
        assert level.max() > 0
    below = cc.CubeMap(-faces).prefilter().levels
    assert all(
        level.min() < 0 for level in below
    )  # a difference of two environments keeps its sign


def test_irradiance_of_a_photograph():
    cube = photograph("interior", 64)
    directions = random_directions(200)
    expected = lighting.irradiance(cube.faces, directions)
    assert rms(cube.irradiance(64).sample(directions) - expected) < 0.002 * rms(expected)


def test_irradiance_of_light_that_grows_with_height():
    """Radiance n.y has the irradiance 2/3 pi n.y (Ramamoorthi and Hanrahan 2001)."""
    cube = cc.CubeMap(unit_texel_directions(64)[..., 1:2].astype(np.float32))
    directions = random_directions(100)
    got = cube.irradiance().sample(directions)[:, 0]
    assert got == pytest.approx(2 / 3 * directions[:, 1], abs=1e-3)


def test_sizes_of_levels():
    """The power of two that is nearest to 25.6 / roughness, at least 32, at most the cube's size."""
    sizes = [level.shape[1] for level in noise(256, 1).prefilter().levels]
    assert sizes == [256, 128, 64, 32, 32, 32]
    sizes = [level.shape[1] for level in noise(100, 1).prefilter(11).levels]
    assert sizes == [100, 100, 100, 64, 64, 64, 32, 32, 32, 32, 32]
    assert [level.shape[1] for level in noise(48, 1).prefilter(3).levels] == [48, 48, 32]
    assert [level.shape[1] for level in noise(9, 1).prefilter(3).levels] == [9, 9, 9]


@dtypes
@channel_counts
def test_a_constant_cube_is_unchanged(dtype, channels):
    color = np.array([0.2, 0.4, 0.6, 0.8][:channels])
    color = (color * 255).astype("uint8") if dtype == "uint8" else color.astype(dtype)
    cube = cc.CubeMap(np.broadcast_to(color, (6, 40, 40, channels)))
    made = cube.prefilter()
    for level in (*made.levels, cube.irradiance().faces):
        assert level.dtype == dtype
        assert level.shape == (6, level.shape[1], level.shape[1], channels)
        assert np.abs(level.astype(float) - color.astype(float)).max() < 2e-6


@pytest.mark.parametrize("size", [1, 2, 3, 5, 33])
def test_small_and_odd_cubes(size):
    cube = noise(size, 3)
    made = cube.prefilter(levels=4)
    for level in made.levels:
        assert level.min() >= cube.faces.min()
        assert level.max() <= cube.faces.max()
    mean = (cube.faces * lighting.solid_angles(size)[..., None]).sum((0, 1, 2)) / (4 * np.pi)
    around = cube.irradiance().sample(random_directions(2000)).mean(0)
    assert around == pytest.approx(mean, abs=0.02)


def test_levels_keep_the_energy():
    """The lobe is the same for each direction, so the mean over all directions does not change."""
    cube = photograph("sunset", 128)

    def mean(faces):
        weights = lighting.solid_angles(faces.shape[1])[..., None]
        return (faces.astype(float) * weights).sum((0, 1, 2)) / (4 * np.pi)

    expected = mean(cube.faces)
    for level in (*cube.prefilter().levels, cube.irradiance().faces):
        assert mean(level) == pytest.approx(expected, rel=2e-3)


def test_filtering_is_linear():
    made = noise(32, 3).prefilter()
    doubled = cc.CubeMap(noise(32, 3).faces * 2).prefilter()
    for one, two in zip(made.levels, doubled.levels, strict=True):
        assert np.array_equal(2 * one, two)
    first, second = noise(32, 1, seed=1), noise(32, 1, seed=2)
    both = cc.CubeMap(first.faces + second.faces).prefilter()
    parts = zip(first.prefilter().levels, second.prefilter().levels, both.levels, strict=True)
    for one, two, together in parts:
        assert np.abs(one + two - together).max() < 3e-4


def test_channels_do_not_mix():
    four = noise(32, 4)
    levels = four.prefilter().levels
    for channel in range(4):
        alone = cc.CubeMap(four.faces[..., channel : channel + 1]).prefilter().levels
        for all_channels, one in zip(levels, alone, strict=True):
            # Alpha is summed over other places than red, so that a constant alpha stays constant.
            error = 0 if channel < 3 else 6e-3
            assert np.abs(all_channels[..., channel : channel + 1] - one).max() <= error


def test_numbers_of_8_and_16_bits_are_rounded():
    exact = noise(32, 3, "uint8")
    levels = cc.CubeMap(exact.faces.astype(np.float32) / 255).prefilter().levels
    for got, expected in zip(exact.prefilter().levels[1:], levels[1:], strict=True):
        assert np.array_equal(got, np.floor(expected * np.float32(255) + 0.5).astype(np.uint8))
    half = noise(32, 3, "float16")
    levels = cc.CubeMap(half.faces.astype(np.float32)).prefilter().levels
    for got, expected in zip(half.prefilter().levels, levels, strict=True):
        assert np.array_equal(got, expected.astype(np.float16))


def test_the_encoding_and_mipmaps_are_kept_and_change_no_number():
    faces = noise(16, 3, "uint8").faces
    made = cc.CubeMap(faces, encoding="srgb", mipmaps=True).prefilter()
    assert made.encoding == "srgb"
    assert made.mipmaps
    plain = cc.CubeMap(faces, encoding="linear").prefilter()
    assert all(np.array_equal(a, b) for a, b in zip(made.levels, plain.levels, strict=True))
    assert cc.CubeMap(faces).irradiance().encoding == "srgb"


def test_numbers_that_are_not_finite():
    """NaN cannot come from Python arrays; infinity counts as 65504, the largest float16."""
    faces = noise(16, 3).faces.copy()
    faces[4, 5, 6] = (np.inf, -np.inf, 3e38)
    finite = faces.copy()
    finite[4, 5, 6] = (65504, -65504, 1e30)
    got = cc.CubeMap(faces).prefilter().levels
    expected = cc.CubeMap(finite).prefilter().levels
    for one, other in zip(got[1:], expected[1:], strict=True):
        assert np.isfinite(one).all()
        assert np.array_equal(one, other)
    assert np.array_equal(cc.CubeMap(faces).sh(), cc.CubeMap(finite).sh())


def test_level_0_and_its_size():
    cube = noise(32, 3)
    made = cube.prefilter()
    assert np.array_equal(made.levels[0], cube.faces)
    assert np.array_equal(made.faces, cube.faces)
    smaller = cube.prefilter(size=16)
    assert smaller == cube.resize(16).prefilter()
    assert smaller.size == 16
    assert smaller != made


def test_a_cube_that_nobody_filtered():
    cube = noise(8, 3)
    assert cube.roughness.tolist() == [0]
    assert len(cube.levels) == 1
    assert np.array_equal(cube.levels[0], cube.faces)
    assert cc.CubeMap(cube.prefilter().faces) == cube
    assert len(cube.prefilter().resize(4).levels) == 1


def test_levels_are_read_only():
    made = noise(8, 3).prefilter()
    with pytest.raises(ValueError, match="read-only"):
        made.levels[2][0] = 1
    with pytest.raises(ValueError, match="read-only"):
        made.roughness[0] = 1
    with pytest.raises(AttributeError):
        made.levels = ()


@copies
def test_copies_have_the_levels(make_copy):
    made = noise(8, 3, "float16").prefilter(4)
    copy = make_copy(made)
    assert copy == made
    assert copy is not made
    assert repr(copy) == repr(made)
    assert copy.roughness.tolist() == made.roughness.tolist()
    assert all(np.array_equal(a, b) for a, b in zip(copy.levels, made.levels, strict=True))


def test_comparisons_include_the_levels():
    cube = noise(8, 3)
    assert cube.prefilter() == cube.prefilter() == cube.prefilter().copy()
    assert cube.prefilter() != cube
    assert cube.prefilter(5) != cube.prefilter(6)


def test_set_face_refuses_a_filtered_cube():
    made = noise(8, 3).prefilter()
    before = made.copy()
    with pytest.raises(ValueError, match="expected a cubemap without filtered levels, got 6"):
        made.set_face("+x", np.ones((8, 8, 3), np.float32))
    assert made == before


def test_repr_names_the_number_of_levels():
    assert "levels=6" in repr(noise(8, 3).prefilter())
    assert "levels" not in repr(noise(8, 3))


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        ({"levels": 1}, ValueError, "levels: expected an int from 2 to 64, got 1"),
        ({"levels": 65}, ValueError, "levels: expected an int from 2 to 64, got 65"),
        ({"levels": 2.5}, TypeError, "levels: expected an int, got 2.5"),
        ({"size": 0}, ValueError, "size: expected 1 to"),
        ({"size": "big"}, TypeError, "size: expected an int, got 'big'"),
        ({"progress": 3}, TypeError, "progress: expected a function of one number, or None"),
    ],
)
def test_bad_arguments(arguments, error, text):
    with pytest.raises(error, match=text):
        noise(4, 3).prefilter(**arguments)
    if "levels" not in arguments:
        with pytest.raises(error, match=text):
            noise(4, 3).irradiance(**arguments)


def test_progress_grows_to_1_on_the_calling_thread():
    shares, threads = [], set()

    def progress(share):
        shares.append(share)
        threads.add(threading.get_ident())

    cube = noise(128, 3)
    assert cube.prefilter(progress=progress) == cube.prefilter()
    assert len(shares) > 3
    assert shares == sorted(shares)
    assert shares[0] >= 0
    assert shares[-1] == 1
    assert threads == {threading.get_ident()}


def test_an_error_in_progress_ends_the_work():
    class Enough(Exception):
        pass

    def progress(share):
        raise Enough(share)

    cube = noise(128, 3)
    with pytest.raises(Enough):
        cube.prefilter(progress=progress)
    with pytest.raises(Enough):
        cube.irradiance(progress=progress)
    assert cube == noise(128, 3)


@pytest.mark.slow
def test_ctrl_c_ends_the_work():
    cube = noise(512, 3)
    begun = threading.Event()
    shares: list[float] = []
    sent: list[float] = []

    def send():
        begun.wait()
        sent.append(shares[-1])
        os.kill(os.getpid(), signal.SIGINT)

    def progress(share):
        shares.append(share)
        begun.set()

    sender = threading.Thread(target=send)
    sender.start()
    with pytest.raises(KeyboardInterrupt):
        cube.prefilter(levels=60, progress=progress)  # many seconds
    sender.join()
    # How much work was done after the signal, which depends on neither the machine nor its load.
    assert shares[-1] - sent[0] < 0.3
    assert shares[-1] < 0.9
    assert cube == noise(512, 3)


def test_other_threads_run_meanwhile():
    cube = noise(256, 3)
    turns = 0
    done = threading.Event()

    def work():
        cube.prefilter()
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    while not done.wait(0.001):
        turns += 1
    worker.join()
    assert turns > 10
