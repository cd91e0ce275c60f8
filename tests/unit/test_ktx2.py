"""KTX2 files by the specification (KTX 2.0, revision 4): written ones by struct alone, read ones by value."""

import builtins
import struct
import sys
import zlib

import numpy as np
import pytest

import cubecam as cc
from cubecam.io import ktx2

MAGIC = bytes([0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32, 0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A])
HEAD = struct.Struct("<12s9I4I2Q")


def parsed(data):
    """Read a file by the text of the specification: header, level offsets, descriptor, keys."""
    head = HEAD.unpack_from(data)
    assert head[0] == MAGIC
    index = [struct.unpack_from("<3Q", data, 80 + 24 * k) for k in range(head[8])]
    form = data[head[10] : head[10] + head[11]]
    keys, at, told = data[head[12] : head[12] + head[13]], 0, {}
    while at < len(keys):
        length = struct.unpack_from("<I", keys, at)[0]
        name, _, value = keys[at + 4 : at + 4 + length].partition(b"\0")
        told[name.decode()] = value
        at += 4 + length + -length % 4
    return head, index, form, told


def made(
    number, size, texels, *, type_size=1, faces=1, layers=0, scheme=0, unpacked=None, keys=b"", form=b"", levels=1
):  # fmt: skip
    """Write a file of one level by hand."""
    start = 80 + 24 * levels + len(form) + len(keys)
    head = HEAD.pack(
        MAGIC, number, type_size, *size, 0, layers, faces, levels, scheme,
        80 + 24 * levels if form else 0, len(form), 80 + 24 * levels + len(form) if keys else 0, len(keys), 0, 0,
    )  # fmt: skip
    row = struct.pack("<3Q", start, len(texels), len(texels) if unpacked is None else unpacked)
    return head + row * levels + form + keys + texels


def key(name, value):
    both = name.encode() + b"\0" + value.encode() + b"\0"
    return struct.pack("<I", len(both)) + both + bytes(-len(both) % 4)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.mark.parametrize(
    ("dtype", "encoding", "number"),
    [
        ("u1", "linear", 37), ("u1", "srgb", 43), ("f2", "linear", 97), ("f4", "linear", 109),
    ],
)  # fmt: skip
def test_a_file_is_laid_out_as_the_specification_says(dtype, encoding, number, rng):
    levels = [(rng.random((6, n, n, 4)) * 200).astype(dtype) for n in (12, 6, 3)]
    data = ktx2.write(levels, encoding=encoding, key_values={"Zoo": "z", "a": "b"})
    head, index, form, told = parsed(data)
    size = np.dtype(dtype).itemsize
    assert head[1:10] == (number, size, 12, 12, 0, 0, 6, 3, 0)
    assert list(told) == ["KTXorientation", "KTXwriter", "Zoo", "a"]  # sorted by code points
    assert told["KTXorientation"] == b"rd\0"
    # The smallest level first, each aligned to the least common multiple of texel and 4 bytes.
    starts = [row[0] for row in index]
    assert starts == sorted(starts, reverse=True)
    assert all(start % max(4, 4 * size) == 0 for start in starts)
    assert index[0][0] + index[0][1] == len(data)
    for (start, length, unpacked), level in zip(index, levels, strict=True):
        assert length == unpacked == level.nbytes
        found = np.frombuffer(data, np.dtype(dtype).newbyteorder("<"), level.size, start)
        np.testing.assert_array_equal(found.reshape(level.shape), level)
    total, kind, version, block = struct.unpack_from("<2I2H", form)
    assert (total, kind, version, block) == (len(form), 0, 2, len(form) - 4)
    assert list(form[12:16]) == [1, 1, 2 if encoding == "srgb" else 1, 0]
    assert form[20] == 4 * size
    for c in range(4):
        offset, bits, channel, _, low, high = struct.unpack_from("<HBB3I", form, 28 + 16 * c)
        assert (offset, bits) == (8 * size * c, 8 * size - 1)
        assert channel & 15 == (0, 1, 2, 15)[c]
        if dtype == "u1":
            assert (low, high) == (0, 255)
            assert channel & 0xF0 == (0x10 if encoding == "srgb" and c == 3 else 0)
        else:
            assert struct.unpack("<2f", struct.pack("<2I", low, high)) == (-1, 1)
            assert channel & 0xF0 == 0xC0


@pytest.mark.parametrize("compression", ["zlib", "zstd"])
def test_levels_are_packed_one_by_one(compression, rng):
    levels = [rng.integers(0, 5, (6, n, n, 4)).astype("u1") for n in (16, 8)]
    data = ktx2.write(levels, encoding="srgb", compression=compression)
    head, index, _, _ = parsed(data)
    assert head[9] == {"zstd": 2, "zlib": 3}[compression]
    assert index[0][2] == levels[0].nbytes
    assert index[0][1] < levels[0].nbytes
    if compression == "zlib":
        for (start, length, _), level in zip(index, levels, strict=True):
            assert zlib.decompress(data[start : start + length]) == level.tobytes()
    found = ktx2.read(data)
    assert (found.size, found.faces, found.encoding, found.layers) == ((16, 16), 6, "srgb", 1)
    for got, level in zip(found.levels, levels, strict=True):
        np.testing.assert_array_equal(got, level)


@pytest.mark.parametrize(
    ("number", "dtype", "order"),
    [
        (9, "u1", (0,)), (16, "u1", (0, 1)), (23, "u1", (0, 1, 2)), (30, "u1", (2, 1, 0)), (37, "u1", (0, 1, 2, 3)),
        (44, "u1", (2, 1, 0, 3)), (50, "u1", (2, 1, 0, 3)), (70, "<u2", (0,)), (84, "<u2", (0, 1, 2)),
        (91, "<u2", (0, 1, 2, 3)), (76, "<f2", (0,)), (90, "<f2", (0, 1, 2)), (100, "<f4", (0,)),
        (103, "<f4", (0, 1)), (106, "<f4", (0, 1, 2)), (109, "<f4", (0, 1, 2, 3)),
    ],
)  # fmt: skip
def test_formats(number, dtype, order, rng):
    texels = (rng.random((3, 5, len(order))) * 255).astype(dtype)
    kind = np.dtype(dtype).itemsize
    found = ktx2.read(made(number, (5, 3), texels.tobytes(), type_size=kind))
    want = texels[..., list(order)]
    if len(order) == 2:
        want = np.concatenate([want, np.zeros_like(want[..., :1])], axis=-1)
    np.testing.assert_array_equal(found.levels[0], want)
    assert found.encoding == ("srgb" if number == 50 else "linear")


def test_orientation_and_swizzle(rng):
    texels = rng.integers(0, 255, (3, 5, 2)).astype("u1")
    keys = key("KTXorientation", "lu") + key("KTXswizzle", "rrrg")
    found = ktx2.read(made(16, (5, 3), texels.tobytes(), keys=keys)).levels[0]
    np.testing.assert_array_equal(found, texels[::-1, ::-1][..., [0, 0, 0, 1]])
    found = ktx2.read(made(16, (5, 3), texels.tobytes(), keys=key("KTXswizzle", "g101"))).levels[0]
    np.testing.assert_array_equal(found[..., 0], texels[..., 1])
    assert found.shape[-1] == 3
    assert (found[..., 1] == 255).all()
    assert (found[..., 2] == 0).all()


def test_layers(rng):
    texels = rng.integers(0, 255, (3, 6, 2, 2, 4)).astype("u1")
    data = made(37, (2, 2), texels.tobytes(), faces=6, layers=3)
    np.testing.assert_array_equal(ktx2.read(data, layer=2).levels[0], texels[2])
    with pytest.raises(ValueError, match="expected 0 to 2, got 3"):
        ktx2.read(data, layer=3)


def test_blocks():
    """BC1: two colours of 5, 6 and 5 bits; indices of 2 bits, the first texel in the lowest."""
    block = struct.pack("<2HI", 0xF800, 0x001F, 0b01)
    found = ktx2.read(made(131, (4, 4), block)).levels[0]
    assert found.shape == (4, 4, 3)
    assert found[0, 0].tolist() == [0, 0, 255]
    assert found[0, 1].tolist() == [255, 0, 0]


TEXELS = bytes(4 * 4 * 4)


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (MAGIC, "expected a KTX2 header of 80 bytes, got 12"),
        (made(37, (4, 4), TEXELS)[:-1], "expected 64 bytes of level 0"),
        (made(37, (4, 5), TEXELS), "expected 80 bytes of R8G8B8A8_UNORM in level 0, got 64"),
        (made(37, (0, 4), TEXELS), "texels along an edge, got 0 x 4"),
        (made(37, (1 << 20, 4), TEXELS), "texels along an edge"),
        (made(37, (4, 2), TEXELS, faces=6), "expected square faces"),
        (made(37, (4, 4), TEXELS, faces=5), "expected one or six faces, got 5"),
        (made(37, (4, 4), TEXELS, levels=4), "expected at most 3 levels, got 4"),
        (made(37, (4, 4), TEXELS, type_size=2), "expected typeSize 1 for R8G8B8A8_UNORM, got 2"),
        (made(37, (4, 4), TEXELS, scheme=7), "the supercompression 7"),
        (made(37, (4, 4), TEXELS, scheme=1), "expected Zstandard or zlib for R8G8B8A8_UNORM, got BasisLZ"),
        (made(37, (4, 4), TEXELS, scheme=3, unpacked=64), "expected a level packed by zlib"),
        (made(37, (4, 4), zlib.compress(bytes(63)), scheme=3, unpacked=64), "in a level packed by zlib, got 63"),
        (made(37, (4, 4), zlib.compress(bytes(65)), scheme=3, unpacked=64), "packed by zlib, got more"),
        (made(37, (4, 4), TEXELS, scheme=2, unpacked=64), "expected a level packed by Zstandard"),
        (made(37, (4, 4), zlib.compress(TEXELS), scheme=3, unpacked=65), "expected uncompressedByteLength 64"),
        (made(37, (60000, 60000), zlib.compress(TEXELS), scheme=3, unpacked=60000**2 * 4), "expected at most"),
        (made(157, (4, 4), TEXELS), "VkFormat 157, ASTC"),
        (made(147, (4, 4), TEXELS), "VkFormat 147, ETC2 or EAC"),
        (made(141, (4, 4), TEXELS), "BC5, two channels"),
        (made(9999, (4, 4), TEXELS), "VkFormat 9999"),
        (made(0, (4, 4), TEXELS), "expected ETC1S or UASTC in a KTX2 file without a VkFormat"),
        (made(37, (4, 4), TEXELS, keys=struct.pack("<I", 99)), "expected 99 bytes of a key, got 0"),
        (made(37, (4, 4), TEXELS, keys=struct.pack("<I", 2) + b"abcd"), "expected a key that ends in a zero byte"),
        (made(37, (4, 4), TEXELS * 6, faces=6, keys=key("KTXorientation", "ru")), "a cubemap of KTXorientation rd"),
    ],
)  # fmt: skip
def test_broken_files(data, told):
    with pytest.raises(cc.ImageError, match=told):
        ktx2.read(data)


def test_a_missing_package_is_named(monkeypatch, rng):
    data = ktx2.write([rng.random((4, 4, 4)).astype("f4")], encoding="linear", compression="zstd")
    basis = bytearray(44)
    basis[:4] = struct.pack("<I", 44)
    basis[12:15] = bytes([166, 1, 2])
    universal = made(0, (4, 4), bytes(16), form=bytes(basis))
    real = builtins.__import__
    for name in ("backports.zstd", "compression.zstd", "opengl_basisu"):
        monkeypatch.setitem(sys.modules, name, None)
    assert real is builtins.__import__
    with pytest.raises(cc.ImageError, match=r"backports\.zstd.*pip install 'cubecam\[ktx2\]'"):
        ktx2.read(data)
    with pytest.raises(
        cc.ImageError, match=r"opengl-basisu, which reads Basis Universal \(UASTC\)"
    ):
        ktx2.read(universal)


def test_pictures_are_read_by_load_image(tmp_path, rng):
    pixels = rng.integers(0, 255, (3, 5, 4)).astype("u1")
    path = tmp_path / "a.ktx2"
    path.write_bytes(ktx2.write([pixels], encoding="srgb"))
    np.testing.assert_array_equal(cc.load_image(path), pixels)
    assert cc.load_image(path, srgb=True).dtype == np.float32
    # Numbers that the file calls linear are not decoded.
    path.write_bytes(ktx2.write([pixels], encoding="linear"))
    np.testing.assert_allclose(cc.load_image(path, srgb=True), pixels / np.float32(255))
    cube = cc.CubeMap(rng.random((6, 4, 4, 3)).astype("f4"))
    cube.save(path)
    with pytest.raises(cc.ImageError, match="got a KTX2 cubemap, which load_cubemap reads"):
        cc.load_image(path)
    np.testing.assert_array_equal(cc.load_image(path, part="-Y")[..., :3], cube.faces[3])
