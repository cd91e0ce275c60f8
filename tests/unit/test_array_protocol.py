"""Cubemaps, frames and images where arrays are expected."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical

FACES = np.random.default_rng(1).random((6, 4, 4, 3)).astype(np.float32)


@pytest.fixture(params=["cube", "image"])
def thing(request):
    return cc.CubeMap(FACES) if request.param == "cube" else cc.Image(FACES[0])


def own(thing):
    return thing.faces if isinstance(thing, cc.CubeMap) else thing.pixels


def test_asarray_shares_memory_and_is_read_only(thing):
    got = np.asarray(thing)
    assert_identical(got, own(thing))
    assert np.shares_memory(got, own(thing))
    with pytest.raises(ValueError, match="read-only"):
        got[0] = 0


def test_array_makes_a_copy(thing):
    got = np.array(thing)
    assert_identical(got, own(thing))
    got[...] = 0
    assert own(thing).max() > 0


def test_the_dtype_that_is_wanted(thing):
    assert np.asarray(thing, dtype=np.float64).dtype == np.float64
    with pytest.raises(ValueError, match="copy=False: expected dtype float32, got float64"):
        thing.__array__(np.dtype("float64"), copy=False)
    assert np.shares_memory(thing.__array__(copy=False), own(thing))


def test_functions_of_numpy_take_objects(thing):
    assert np.mean(thing) == np.mean(own(thing))
    assert np.stack([thing, thing]).shape == (2, *own(thing).shape)
    assert np.abs(np.subtract(thing, own(thing))).max() == 0


def test_numpy_gives_an_array_of_ones_own():
    cube = cc.CubeMap(FACES)
    assert np.shares_memory(cube.numpy(), cube.faces)
    mine = cube.numpy(writable=True)
    mine[...] = 7
    assert_identical(cube.faces, FACES)
    assert_identical(cc.CubeMap(mine).faces, mine)


@pytest.mark.skipif(
    np.lib.NumpyVersion(np.__version__) < "2.1.0", reason="numpy reads DLPack 1 from 2.1 on"
)
def test_dlpack_without_a_copy_for_reading(thing):
    got = np.from_dlpack(thing)
    assert_identical(got, own(thing))
    assert not got.flags.writeable
    assert np.shares_memory(got, own(thing))
    assert thing.__dlpack_device__() == (1, 0)


class OldReader:
    """A reader of DLPack before version 1, which cannot see that numbers are read-only."""

    def __init__(self, thing):
        self.thing = thing

    def __dlpack__(self, **_):
        return self.thing.__dlpack__()

    def __dlpack_device__(self):
        return self.thing.__dlpack_device__()


def test_an_old_reader_gets_a_copy(thing):
    got = np.from_dlpack(OldReader(thing))
    assert_identical(got, own(thing))
    assert not np.shares_memory(got, own(thing))
    with pytest.raises(BufferError, match="read-only"):
        thing.__dlpack__(copy=False)


def test_repr_tells_what_there_is():
    assert repr(cc.CubeMap(FACES)) == (
        "CubeMap(size=4, channels=3, dtype=float32, mipmaps=False, encoding='linear')"
    )
    assert repr(cc.Image(FACES[0])) == "Image(4 x 4, 3 channels, float32, linear)"


BATCHES = {
    "cubes": lambda: cc.CubeMapBatch(np.stack([FACES, 2 * FACES])),
    "some cubes": lambda: cc.CubeMapBatch(np.stack([FACES, FACES, 2 * FACES]))[1:],
}


@pytest.mark.parametrize("name", BATCHES)
def test_a_batch_is_shared_by_dlpack_and_may_be_written(name):
    batch = BATCHES[name]()
    got = np.from_dlpack(batch)
    assert_identical(got, np.stack([FACES, 2 * FACES]))
    assert np.shares_memory(got, batch.faces)
    old = np.from_dlpack(OldReader(batch))
    assert np.shares_memory(old, batch.faces)
    if (
        np.lib.NumpyVersion(np.__version__) >= "2.1.0"
    ):  # older ones mark all that they read as read-only
        got[1] = 3
        assert (batch.faces[1] == 3).all()
    with pytest.raises(BufferError, match=r"expected main memory, \(1, 0\), got \(2, 0\)"):
        batch.__dlpack__(dl_device=(2, 0))
