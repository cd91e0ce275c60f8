"""DDS cubemaps by value: six faces with a marked corner, levels, and every kind of numbers.

The files are made here, from Microsoft's "Programming guide for DDS".
"""

import struct

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.reference.cube_faces import convert
from tests.reference.tone import srgb_decode

SIZE = 8
ALPHA, FOUR_CC, RGB, LUMINANCE = 1, 4, 0x40, 0x20000
ALL_FACES = 0xFE00
COLORS = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0), (255, 0, 255), (0, 255, 255)]


@pytest.fixture
def faces(rng):
    """Six faces of (8, 8, 4) bytes: a colour each, a corner of noise, and an alpha that varies."""
    found = np.empty((6, SIZE, SIZE, 4), np.uint8)
    found[..., :3] = np.array(COLORS)[:, None, None]
    found[:, :2, :3, :3] = rng.integers(0, 256, (6, 2, 3, 3))
    found[..., 3] = rng.integers(0, 256, (6, SIZE, SIZE))
    return found


def header(size, flags, code=0, bits=0, masks=(0, 0, 0, 0), levels=0, caps2=ALL_FACES, dx10=None):
    """The header, and the one that follows it: (DXGI format, dimension, misc flags, array size)."""
    if isinstance(code, int):
        code = struct.pack("<I", code)
    width, height = size if isinstance(size, tuple) else (size, size)
    caps = 0x1000 | (0x400008 if levels else 8)
    out = struct.pack(
        "<4s7I44x", b"DDS ", 124, 0x21007 if levels else 0x1007, height, width, 0, 0, levels
    )
    out += struct.pack("<2I4s5I", 32, flags, code, bits, *masks)
    out += struct.pack("<5I", caps, caps2, 0, 0, 0)
    return out if dx10 is None else out + struct.pack("<5I", *dx10, 0)


def write(path, head, *pictures):
    path.write_bytes(head + b"".join(np.ascontiguousarray(p).tobytes() for p in pictures))
    return path


def half_sized(face):
    """A level that is unlike the one before."""
    return 255 - face[::2, ::2]


RGBA = (0xFF, 0xFF00, 0xFF0000, 0xFF000000)
BGRA = (0xFF0000, 0xFF00, 0xFF, 0xFF000000)


def packed(faces, bits, masks):
    """Pixels of few bits: the channel's value is rounded down to its bits."""
    words = np.zeros(faces.shape[:3], np.uint32)
    for channel, mask in enumerate(masks):
        width, shift = mask.bit_count(), (mask & -mask).bit_length() - 1
        words |= (faces[..., channel].astype(np.uint32) >> (8 - width)) << shift
    return words.astype("<u2" if bits == 16 else "<u4"), [mask.bit_count() for mask in masks]


BYTES = {
    "RGBA": (ALPHA | RGB, 32, RGBA, lambda f: f, 4),
    "BGRA": (ALPHA | RGB, 32, BGRA, lambda f: f[..., [2, 1, 0, 3]], 4),
    "BGRX": (RGB, 32, (*BGRA[:3], 0), lambda f: f[..., [2, 1, 0, 3]], 3),
    "BGR": (RGB, 24, (*BGRA[:3], 0), lambda f: f[..., [2, 1, 0]], 3),
    "RGB": (RGB, 24, (*RGBA[:3], 0), lambda f: f[..., :3], 3),
    "L": (LUMINANCE, 8, (0xFF, 0, 0, 0), lambda f: f[..., :1], 1),
}


@pytest.mark.parametrize("kind", BYTES)
@pytest.mark.parametrize("levels", [0, 1, 4])
def test_faces_of_bytes_in_order(kind, levels, faces, tmp_path):
    """Each face is stored with all its levels before the next face."""
    flags, bits, masks, arranged, channels = BYTES[kind]
    stored = []
    for face in faces:
        level = face
        for _ in range(max(levels, 1)):
            stored.append(arranged(level))
            level = half_sized(level)
    path = write(tmp_path / "a.dds", header(SIZE, flags, 0, bits, masks, levels), *stored)
    cube = cc.load_cubemap(path)
    assert_identical(cube.faces, faces[..., :channels])
    assert cube.encoding == "srgb"
    assert_identical(cc.load_environment(path).faces, faces[..., :channels])


def test_grey_with_alpha(faces, tmp_path):
    head = header(SIZE, ALPHA | LUMINANCE, 0, 16, (0xFF, 0, 0, 0xFF00))
    path = write(tmp_path / "a.dds", head, faces[..., [0, 3]])
    assert_identical(cc.load_cubemap(path).faces, faces[..., [0, 0, 0, 3]])


@pytest.mark.parametrize(
    ("bits", "masks", "flags"),
    [
        (16, (0xF800, 0x7E0, 0x1F), RGB),
        (16, (0x7C00, 0x3E0, 0x1F, 0x8000), RGB | ALPHA),
        (16, (0xF00, 0xF0, 0xF, 0xF000), RGB | ALPHA),
        (32, (0xFF000000, 0xFF0000, 0xFF00), RGB),
    ],
)
def test_channels_of_few_bits(bits, masks, flags, faces, tmp_path):
    words, widths = packed(faces, bits, masks)
    head = header(SIZE, flags, 0, bits, (*masks, 0)[:4])
    got = cc.load_cubemap(write(tmp_path / "a.dds", head, words)).faces
    for channel, width in enumerate(widths):
        most = (1 << width) - 1
        want = (faces[..., channel] >> (8 - width)) / most * 255
        assert np.abs(got[..., channel] - want).max() <= 0.5


def test_ten_bits_are_not_rounded_to_eight(rng, tmp_path):
    masks = (0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000)
    numbers = rng.integers(0, 1024, (6, SIZE, SIZE, 3))
    words = (numbers << np.array([0, 10, 20])).sum(-1).astype("<u4") | np.uint32(0xC0000000)
    for head in (
        header(SIZE, RGB | ALPHA, 0, 32, masks),
        header(SIZE, FOUR_CC, b"DX10", caps2=0, dx10=(24, 3, 4, 1)),
    ):
        cube = cc.load_cubemap(write(tmp_path / "a.dds", head, words))
        np.testing.assert_allclose(cube.faces[..., :3], numbers / 1023, atol=1e-5)
        assert (cube.faces[..., 3] == 1).all()


FLOATS = {
    "R16F": (111, 54, "<f2", 1),
    "A16B16G16R16F": (113, 10, "<f2", 4),
    "R32F": (114, 41, "<f4", 1),
    "A32B32G32R32F": (116, 2, "<f4", 4),
    "R32G32B32F": (None, 6, "<f4", 3),
}


@pytest.mark.parametrize("kind", FLOATS)
@pytest.mark.parametrize("extended", [False, True])
@pytest.mark.parametrize("levels", [0, 2])
def test_faces_of_floats(kind, extended, levels, rng, tmp_path):
    code, number, dtype, channels = FLOATS[kind]
    faces = (rng.normal(size=(6, SIZE, SIZE, channels)) * 100).astype(dtype)
    if extended or code is None:
        head = header(SIZE, FOUR_CC, b"DX10", levels=levels, caps2=0, dx10=(number, 3, 4, 1))
    else:
        head = header(SIZE, FOUR_CC, code, levels=levels)
    stored = [level for face in faces for level in (face, -face[::2, ::2])[: max(levels, 1)]]
    cube = cc.load_cubemap(write(tmp_path / "a.dds", head, *stored))
    assert_identical(cube.faces, faces)
    assert cube.encoding == "linear"


@pytest.mark.parametrize("code", [36, None])
def test_sixteen_bits(code, rng, tmp_path):
    faces = rng.integers(0, 65536, (6, 4, 4, 4)).astype("<u2")
    head = header(4, FOUR_CC, code or b"DX10", dx10=None if code else (11, 3, 4, 1))
    cube = cc.load_cubemap(write(tmp_path / "a.dds", head, faces))
    np.testing.assert_allclose(cube.faces, faces / 65535, atol=1e-7)
    assert cube.encoding == "srgb"


def test_small_floats(rng, tmp_path):
    """R11G11B10: the bits of a half float without the sign and with fewer of the fraction."""
    halves = (
        np.abs(rng.normal(size=(6, 4, 4, 3)) * 10)
        .astype(np.float16)
        .view(np.uint16)
        .astype(np.uint32)
    )
    parts = np.stack([halves[..., 0] >> 4, halves[..., 1] >> 4, halves[..., 2] >> 5], axis=-1)
    words = (parts << np.array([0, 11, 22], np.uint32)).sum(-1).astype("<u4")
    head = header(4, FOUR_CC, b"DX10", dx10=(26, 3, 4, 1))
    cube = cc.load_cubemap(write(tmp_path / "a.dds", head, words))
    shifts = np.array([4, 4, 5], np.uint32)
    assert_identical(cube.faces, (parts << shifts).astype(np.uint16).view(np.float16))


def test_shared_exponents(rng, tmp_path):
    """R9G9B9E5: fraction / 512 * 2^(exponent - 15) (EXT_texture_shared_exponent)."""
    fractions = rng.integers(0, 512, (6, 4, 4, 3)).astype(np.uint32)
    exponents = rng.integers(0, 32, (6, 4, 4)).astype(np.uint32)
    words = (fractions << np.array([0, 9, 18], np.uint32)).sum(-1).astype("<u4") | exponents << 27
    head = header(4, FOUR_CC, b"DX10", dx10=(67, 3, 4, 1))
    cube = cc.load_cubemap(write(tmp_path / "a.dds", head, words.astype("<u4")))
    want = fractions / 512 * 2.0 ** (exponents[..., None].astype(float) - 15)
    assert_identical(cube.faces, want.astype(np.float32))


@pytest.mark.parametrize("number", [27, 28, 29, 87, 88, 90, 91, 92, 93])
def test_bytes_of_the_extended_header(number, faces, tmp_path):
    """The formats whose name ends in SRGB, too, are numbers of a screen; `srgb=True` makes light of them."""
    arranged = faces[..., [2, 1, 0, 3]] if number >= 87 else faces
    channels = 3 if number in (88, 92, 93) else 4
    head = header(SIZE, FOUR_CC, b"DX10", dx10=(number, 3, 4, 1))
    path = write(tmp_path / "a.dds", head, arranged)
    cube = cc.load_cubemap(path)
    assert_identical(cube.faces, faces[..., :channels])
    assert cube.encoding == "srgb"
    light = cc.load_cubemap(path, srgb=True)
    assert light.encoding == "linear"
    assert_close(light.faces[..., :3], srgb_decode(faces[..., :3] / 255), "float32_maths")


@pytest.mark.parametrize("count", [1, 6])
def test_programs_count_cubemaps_or_faces(count, faces, tmp_path):
    head = header(SIZE, FOUR_CC, b"DX10", dx10=(28, 3, 4, count))
    assert_identical(cc.load_cubemap(write(tmp_path / "a.dds", head, faces)).faces, faces)


def test_a_cubemap_that_only_the_older_header_names(faces, tmp_path):
    """`load_image` gave the first face in silence."""
    head = header(SIZE, FOUR_CC, b"DX10", dx10=(28, 3, 0, 1))
    path = write(tmp_path / "a.dds", head, faces)
    assert_identical(cc.load_cubemap(path).faces, faces)
    with pytest.raises(cc.ImageError, match="expected a picture, got a DDS cubemap"):
        cc.load_image(path)


def test_several_cubemaps_in_a_file(faces, tmp_path):
    head = header(SIZE, FOUR_CC, b"DX10", levels=2, dx10=(28, 3, 4, 2))
    second = faces[::-1]
    stored = [level for face in (*faces, *second) for level in (face, half_sized(face))]
    path = write(tmp_path / "a.dds", head, *stored)
    assert_identical(cc.load_cubemap(path).faces, faces)
    assert_identical(cc.load_cubemap(path, part=1).faces, second)
    assert_identical(cc.load_image(path, part=8), second[2])
    with pytest.raises(ValueError, match=r"a.dds: part: expected 0 to 1, got 2"):
        cc.load_cubemap(path, part=2)


def blocks(colors):
    """BC1 blocks of one colour each: 5, 6 and 5 bits, twice, and the index 0 for every texel."""
    r, g, b = (np.asarray(colors, np.uint32) // (8, 4, 8)).T
    ends = (r << 11 | g << 5 | b).astype("<u2")
    return b"".join(struct.pack("<2HI", int(end), int(end), 0) for end in ends)


@pytest.mark.parametrize("size", [8, 4, 2, 6])
@pytest.mark.parametrize("extended", [False, True])
def test_faces_of_blocks(size, extended, tmp_path):
    """A block is 4 x 4 texels, also where a face is smaller or ends within one."""
    rows = (size + 3) // 4
    colors = np.arange(6 * rows * rows * 3).reshape(6, rows * rows, 3) * 7 % 32 * 8
    head = (
        header(size, FOUR_CC, b"DX10", levels=2, dx10=(72, 3, 4, 1))
        if extended
        else header(size, FOUR_CC, b"DXT1", levels=2)
    )
    below = ((size // 2 + 3) // 4) ** 2
    data = b"".join(blocks(face) + blocks([(0, 0, 0)] * below) for face in colors)
    (tmp_path / "a.dds").write_bytes(head + data)
    cube = cc.load_cubemap(tmp_path / "a.dds")
    five, six = colors // 8 / 31 * 255, colors // 4 / 63 * 255
    want = np.where([False, True, False], six, five).reshape(6, rows, rows, 3)
    want = want.repeat(4, axis=1).repeat(4, axis=2)[:, :size, :size]
    assert cube.faces.dtype == np.uint8
    assert np.abs(cube.faces[..., :3].astype(float) - want).max() <= 1


@pytest.mark.parametrize(
    ("code", "number", "block"),
    [(b"DXT3", None, 16), (b"DXT5", None, 16), (b"ATI1", None, 8), (None, 77, 16), (None, 95, 16), (None, 98, 16)],
)  # fmt: skip
def test_blocks_are_those_of_six_pictures(code, number, block, rng, tmp_path):
    """Whatever the blocks hold, a face is what a file of it alone gives."""
    data = rng.integers(0, 256, (6, 4 * block), dtype=np.uint8)
    if number == 95:
        data[:, ::block] = 3  # the mode in which both ends have ten bits
    kind = code or b"DX10"
    head = header(SIZE, FOUR_CC, kind, dx10=(number, 3, 4, 1) if number else None)
    path = write(tmp_path / "cube.dds", head, data)
    cube = cc.load_cubemap(path)
    head = header(SIZE, FOUR_CC, kind, caps2=0, dx10=(number, 3, 0, 1) if number else None)
    for index in range(6):
        alone = cc.load_image(write(tmp_path / "face.dds", head, data[index]))
        assert_identical(cc.load_image(path, part=index), alone)
        assert_identical(cube.faces[index], alone)
    assert len(np.unique(cube.faces.reshape(6, -1), axis=0)) == 6


def test_a_cubemap_is_no_picture(faces, tmp_path):
    path = write(tmp_path / "a.dds", header(SIZE, ALPHA | RGB, 0, 32, RGBA), faces)
    with pytest.raises(cc.ImageError, match=r"a.dds.*load_cubemap"):
        cc.load_image(path)
    for index, name in enumerate(("+X", "-X", "+Y", "-Y", "+Z", "-Z")):
        assert_identical(cc.load_image(path, part=index), faces[index])
        assert_identical(cc.load_image(path, part=name), faces[index])
    with pytest.raises(ValueError, match=r"0 to 5 or one of \+X.*'\+W'"):
        cc.load_image(path, part="+W")
    with pytest.raises(ValueError, match="layout"):
        cc.load_cubemap(path, layout="cross")


@pytest.mark.parametrize("convention", ["gl", "inside", "three"])
def test_conventions_of_a_dds(convention, faces, tmp_path):
    stored = convert(faces, "gl", convention)
    path = write(tmp_path / "a.dds", header(SIZE, ALPHA | RGB, 0, 32, RGBA), stored)
    assert_identical(cc.load_cubemap(path, convention=convention).faces, faces)


def test_pictures_that_are_no_cubemaps(faces, tmp_path):
    """A row of six faces is a picture; it has a layout as in any other file."""
    row = np.concatenate(faces, axis=1)
    path = write(
        tmp_path / "a.dds", header((6 * SIZE, SIZE), ALPHA | RGB, 0, 32, RGBA, caps2=0), row
    )
    assert_identical(cc.load_image(path), row)
    assert_identical(cc.load_image(path, part=0), row)
    assert_identical(cc.load_cubemap(path).faces, faces)
    floats = np.float32(row) / 7
    path = write(tmp_path / "b.dds", header((6 * SIZE, SIZE), FOUR_CC, 116, caps2=0), floats)
    assert_identical(cc.load_image(path), floats)


def test_the_same_numbers_as_openimageio(rng, tmp_path):
    """Pictures of masks were read by OpenImageIO before."""
    import OpenImageIO as oiio

    words = np.arange(65536, dtype="<u2").reshape(256, 256)
    for masks in ((0xF800, 0x7E0, 0x1F, 0), (0x7C00, 0x3E0, 0x1F, 0x8000)):
        flags = RGB | (ALPHA if masks[3] else 0)
        path = write(tmp_path / "a.dds", header(256, flags, 0, 16, masks, caps2=0), words)
        config = oiio.ImageSpec()
        config.attribute("oiio:UnassociatedAlpha", 1)
        file = oiio.ImageInput.open(str(path), config)
        assert file is not None
        want = np.asarray(file.read_image(0, 0, 0, file.spec().nchannels, "uint8"))
        file.close()
        assert np.abs(cc.load_image(path).astype(int) - want).max() <= 1


BAD = [
    (header(8, RGB, 0, 24, (*RGBA[:3], 0), caps2=0x200 | 0x3C00), r"without \+Z, -Z"),
    (header(8, RGB, 0, 24, (*RGBA[:3], 0), caps2=0x200), r"without \+X, -X, \+Y"),
    (header((8, 4), RGB, 0, 24, (*RGBA[:3], 0)), "square faces, got 8 x 4"),
    (header(8, RGB, 0, 24, (*RGBA[:3], 0), levels=5), "at most 4 levels, got 5"),
    (header(8, RGB, 0, 24, (*RGBA[:3], 0), levels=4), "expected 1530 bytes"),
    (header(8, RGB, 0, 24, (0xF0F, 0xF0, 0, 0)), "a mask for each channel"),
    (header(8, FOUR_CC, 112), "G16R16F, two channels"),
    (header(8, FOUR_CC, b"BC5U"), "BC5U, two channels"),
    (header(8, FOUR_CC, b"ABCD"), "ABCD"),
    (header(8, 0x20), "flags 0x20"),
    (header(8, FOUR_CC, b"DX10", dx10=(16, 3, 4, 1)), "R32G32_FLOAT, two channels"),
    (header(8, FOUR_CC, b"DX10", dx10=(132, 3, 4, 1)), "DXGI format 132"),
    (header(8, FOUR_CC, b"DX10", dx10=(28, 4, 0, 1)), "volume"),
    (header(8, RGB, 0, 24, (*RGBA[:3], 0), caps2=0x200000), "volume"),
    (header(60000, FOUR_CC, b"DX10", dx10=(28, 3, 4, 1)), "expected 86400000000 bytes"),
    (header(0, RGB, 0, 24, (*RGBA[:3], 0)), "1 to 65536 texels"),
    (header(8, FOUR_CC, b"DX10"), "DX10, got a file that ends early"),
    (b"DDS " + bytes(30), "header of 128 bytes"),
]  # fmt: skip


@pytest.mark.parametrize(("head", "told"), BAD)
def test_broken_files_say_what_was_expected(head, told, tmp_path):
    path = tmp_path / "a.dds"
    path.write_bytes(head + bytes(1200 if "early" not in told and len(head) >= 128 else 0))
    with pytest.raises(cc.ImageError, match=f"a.dds: .*{told}"):
        cc.load_cubemap(path)


def test_mutated_files_are_cubemaps_or_errors(faces, rng, tmp_path):
    path = tmp_path / "a.dds"
    whole = [
        header(SIZE, ALPHA | RGB, 0, 32, RGBA) + faces.tobytes(),
        header(SIZE, FOUR_CC, 116) + faces.astype("<f4").tobytes(),
        header(SIZE, FOUR_CC, b"DXT1") + faces.tobytes()[: 6 * 32],
        header(SIZE, FOUR_CC, b"DX10", dx10=(67, 3, 4, 1)) + faces.tobytes(),
    ]
    read, said = 0, list[str]()
    for index in range(400):
        data = bytearray(whole[index % len(whole)])
        for _ in range(rng.integers(1, 4)):
            data[rng.integers(148)] = rng.choice([0, 1, 4, 6, 127, 255, rng.integers(256)])
        if index % 5 == 0:
            del data[rng.integers(len(data)) :]
        path.write_bytes(data)
        for load in (cc.load_cubemap, cc.load_image):
            try:
                load(path)
                read += 1
            except cc.ImageError:
                pass
            except ValueError as error:
                said.append(str(error))  # a picture, but no cubemap
    assert all(text.startswith(f"{path}: expected") for text in said)
    assert 50 < read < 600
