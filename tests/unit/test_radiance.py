"""Radiance pictures: every orientation and coding, exposure, colour correction and XYZ, by value.

The writers below follow G. Ward, "Real Pixels" (Graphics Gems II, 1991) and the description of pictures in Radiance.
"""

import itertools

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical

HEIGHT, WIDTH = 6, 12
ORIENTATIONS = [
    f"{first}{axis} {{{axis}}} {second}{other} {{{other}}}"
    for axis, other in ("YX", "XY")
    for first, second in itertools.product("-+", repeat=2)
]


def values(rgbe):
    """Component / 256 * 2^(exponent - 128)."""
    exponents = rgbe[..., 3:].astype(float)
    return np.where(exponents > 0, rgbe[..., :3] * 2.0 ** (exponents - 136), 0).astype(np.float32)


def flat(scanlines):
    return scanlines.tobytes()


def old_runs(scanlines):
    """A pixel, then (1, 1, 1, n) for n more; 256 n where it follows another repeat."""
    out = b""
    for row in scanlines:
        at = 0
        while at < len(row):
            end = at + 1
            while end < len(row) and (row[end] == row[at]).all():
                end += 1
            out += row[at].tobytes() + repeats(end - at - 1)
            at = end
    return out


def repeats(count):
    return b"".join(
        bytes([1, 1, 1, byte]) for byte in count.to_bytes((count.bit_length() + 7) // 8, "little")
    )


def new_runs(scanlines):
    out = b""
    for row in scanlines:
        out += bytes([2, 2, len(row) >> 8, len(row) & 255])
        for component in row.T:
            numbers, at = component.tolist(), 0
            while at < len(numbers):
                end = at
                while end < len(numbers) and end - at < 127 and numbers[end] == numbers[at]:
                    end += 1
                if end - at > 2:
                    out += bytes([128 + end - at, numbers[at]])
                else:
                    end = min(at + 3, len(numbers))
                    out += bytes([end - at, *numbers[at:end]])
                at = end
    return out


def mixed(scanlines):
    codings = itertools.cycle([new_runs, old_runs, flat, old_runs])
    return b"".join(code(row[None]) for code, row in zip(codings, scanlines, strict=False))


CODINGS = {"flat": flat, "old": old_runs, "new": new_runs, "mixed": mixed}
codings = pytest.mark.parametrize("coding", CODINGS.values(), ids=CODINGS)


@pytest.fixture
def rgbe(rng):
    """Pixels with runs in rows and in columns; one component is 128 or more, as in every written file."""
    found = rng.integers(0, 256, (HEIGHT, WIDTH, 4), dtype=np.uint8)
    found[..., 0] |= 128
    found[..., 3] = rng.integers(118, 138, (HEIGHT, WIDTH))
    found[2, 3:11] = found[2, 3]
    found[1:5, 1] = found[1, 1]
    found[4, 7] = 0
    return found


def stored(rgbe, size):
    """The scanlines of a picture whose row 0 is on top, in the order that a line such as "+X 12 -Y 6" names."""
    if size.index("Y") > size.index("X"):
        rows = rgbe.transpose(1, 0, 2)
        flips = (size[0] == "-", size.split()[2][0] == "+")
    else:
        rows = rgbe
        flips = (size[0] == "+", size.split()[2][0] == "-")
    rows = rows[::-1] if flips[0] else rows
    rows = rows[:, ::-1] if flips[1] else rows
    return np.ascontiguousarray(rows)


def write(
    path,
    data,
    size=f"-Y {HEIGHT} +X {WIDTH}",
    header="FORMAT=32-bit_rle_rgbe\n",
    magic="#?RADIANCE",
):
    path.write_bytes(f"{magic}\n{header}\n{size}\n".encode() + data)
    return path


@codings
@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_every_orientation_in_every_coding(orientation, coding, rgbe, tmp_path):
    """A wide picture, and a square one, in which rows and columns could be mistaken for each other."""
    wide = np.concatenate([rgbe, rgbe[::-1] ^ np.array([3, 5, 9, 0], np.uint8)])
    for picture in (wide, wide[:, :8][:8]):
        size = orientation.format(Y=picture.shape[0], X=picture.shape[1])
        path = write(tmp_path / "a.hdr", coding(stored(picture, size)), size)
        assert_identical(cc.load_image(path), values(picture))


@pytest.mark.parametrize("width", [1, 7, 8, 32767, 32768, 70000])
def test_widths_at_the_ends_of_the_new_coding(width, rng, tmp_path):
    """Below 8 and above 32767 pixels, a scanline never has the new coding, whatever its first pixel is."""
    picture = rng.integers(128, 140, (2, width, 4), dtype=np.uint8)
    picture[:, width // 3 :] = picture[:, width // 3 : width // 3 + 1]
    coding = new_runs if 8 <= width <= 32767 else old_runs
    path = write(tmp_path / "a.hdr", coding(picture), f"-Y 2 +X {width}")
    assert_identical(cc.load_image(path), values(picture))
    if width < 8 or width > 32767:
        picture[:, 0] = (2, 2, width >> 8 & 127, width & 255)
        path = write(tmp_path / "a.hdr", flat(picture), f"-Y 2 +X {width}")
        assert_identical(cc.load_image(path), values(picture))


def test_repeats_of_the_old_coding_grow_by_256(tmp_path):
    picture = np.full((1, 70000, 4), (200, 100, 50, 130), np.uint8)
    picture[0, -1] = (130, 1, 2, 128)
    data = old_runs(picture)
    assert len(data) == 4 * (2 + 3)  # 69998 repeats are a number of three bytes
    path = write(tmp_path / "a.pic", data, "-Y 1 +X 70000")
    assert_identical(cc.load_image(path), values(picture))


def test_repeats_end_with_their_scanline_as_in_radiance(rgbe, tmp_path):
    """ "If a repetition leads to an overrun, the rest of the repetition will be silently ignored" (color.c)."""
    picture = np.repeat(rgbe[:2, :1], WIDTH, axis=1)
    data = b"".join(row[0].tobytes() + bytes([1, 1, 1, 200]) for row in picture)
    path = write(tmp_path / "a.hdr", data, f"-Y 2 +X {WIDTH}")
    assert_identical(cc.load_image(path), values(picture))


def test_repeats_that_go_on_in_the_next_scanline(rgbe, tmp_path):
    picture = rgbe.copy()
    picture[1, 5:], picture[2, :7] = picture[1, 5], picture[1, 5]
    data = old_runs(picture.reshape(1, -1, 4))
    assert len(data) < len(old_runs(picture))
    assert_identical(cc.load_image(write(tmp_path / "a.hdr", data)), values(picture))


@pytest.mark.parametrize("magic", ["#?RADIANCE", "#?RGBE", "#?AnotherProgram 2.1"])
@pytest.mark.parametrize("ending", ["hdr", "pic", "rgbe", "xyze", "png", "exr"])
def test_the_contents_tell_the_kind(magic, ending, rgbe, tmp_path):
    path = write(tmp_path / f"a.{ending}", new_runs(rgbe), magic=magic)
    assert_identical(cc.load_image(path), values(rgbe))


@pytest.mark.parametrize(
    "header",
    ["", "# a comment = 1\nGAMMA=2.2\nVIEW= -vtv -vp 1 2 3\nPIXASPECT=2\nPRIMARIES=.7 .3 .2 .7 .1 .1 .33 .33\n",
     "rpict -vu 0 0 1\n\tEXPOSURE=7\nSOFTWARE=a b\r\n"],
)  # fmt: skip
def test_headers_that_do_not_change_numbers(header, rgbe, tmp_path):
    """A line that starts with a tab belongs to a picture that this one was made from."""
    path = write(tmp_path / "a.hdr", new_runs(rgbe), header=header)
    assert_identical(cc.load_image(path), values(rgbe))


def test_a_header_may_end_at_the_size(rgbe, tmp_path):
    path = tmp_path / "a.hdr"
    path.write_bytes(f"#?RADIANCE\n-Y {HEIGHT} +X {WIDTH}\n".encode() + flat(rgbe))
    assert_identical(cc.load_image(path), values(rgbe))


def test_exposures_multiply_and_divide(rgbe, tmp_path):
    header = "EXPOSURE=2.5\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 4e-01 \nEXPOSURE=8\n"
    path = write(tmp_path / "a.hdr", new_runs(rgbe), header=header)
    assert_close(cc.load_image(path), values(rgbe) / 8, "float32_maths")


def test_colour_corrections_multiply_and_divide(rgbe, tmp_path):
    header = "COLORCORR=1 2 4\nEXPOSURE=.5\nCOLORCORR= 8 1 0.5\n"
    path = write(tmp_path / "a.hdr", new_runs(rgbe), header=header)
    assert_close(cc.load_image(path), values(rgbe) / (4, 1, 1), "float32_maths")


def test_xyz_becomes_rgb_of_radiances_primaries(rgbe, tmp_path):
    """The primaries of color.h: equal energy is white; a colour of the chromaticity of a primary has one component."""
    x, y = np.array([(0.64, 0.33), (0.29, 0.6), (0.15, 0.06)]).T
    colors = np.stack([x, y, 1 - x - y], axis=-1)
    weights = np.linalg.solve(colors.T, np.ones(3))  # X = Y = Z = 1 is white
    to_xyz = (colors * weights[:, None]).T
    header = "FORMAT=32-bit_rle_xyze\nEXPOSURE=2\nCOLORCORR=1 4 1\n"
    path = write(tmp_path / "a.hdr", new_runs(rgbe), header=header)
    got = cc.load_image(path)
    assert got.dtype == np.float32
    want = (values(rgbe) / (2, 8, 2)) @ np.linalg.inv(to_xyz).T
    assert np.abs(got - want).max() <= 1e-5 * np.abs(want).max()
    white = np.full((1, 1, 4), 128, np.uint8)
    path = write(tmp_path / "b.hdr", flat(white), "-Y 1 +X 1", "FORMAT=32-bit_rle_xyze\n")
    np.testing.assert_allclose(cc.load_image(path), 0.5, rtol=1e-6)
    np.testing.assert_allclose(np.linalg.inv(to_xyz)[0], (2.5653, -1.1668, -0.3984), atol=1e-4)


def test_files_of_other_programs_keep_their_bits(rng, tmp_path):
    """The numbers of OpenImageIO's reader, which cubecam used before, for every component and exponent of light."""
    import OpenImageIO as oiio

    components = np.arange(256, dtype=np.uint8)
    picture = np.empty((256, 256, 4), np.uint8)
    picture[..., 0], picture[..., 1] = components, components[::-1]
    picture[..., 2] = rng.integers(0, 256, (256, 256))
    picture[..., 3] = components[:, None]
    path = write(tmp_path / "a.hdr", flat(picture), "-Y 256 +X 256")
    file = oiio.ImageInput.open(str(path))
    assert file is not None
    before = np.asarray(file.read_image(0, 0, 0, 3, "float"))
    file.close()
    got = cc.load_image(path)
    assert_identical(got, values(picture))
    usual = slice(
        41, 223
    )  # OpenImageIO's powers of 2 for 40, 223 and 226 are off in the last place
    assert_identical(got[usual], before[usual])
    assert (np.abs(got - before) <= 2e-7 * before).all()


def test_what_cubecam_writes_is_read_as_before(rng, tmp_path):
    import OpenImageIO as oiio

    cc.save_image(tmp_path / "a.hdr", rng.random((9, 40, 3)).astype(np.float32) * 50)
    file = oiio.ImageInput.open(str(tmp_path / "a.hdr"))
    assert file is not None
    assert_identical(cc.load_image(tmp_path / "a.hdr"), file.read_image(0, 0, 0, 3, "float"))
    file.close()


def test_a_constant_picture_of_few_bytes(tmp_path):
    data = b"".join([bytes([200, 100, 50, 130]) + repeats(8191)] * 4096)
    got = cc.load_image(write(tmp_path / "a.hdr", data, "-Y 4096 +X 8192"))
    assert got.shape == (4096, 8192, 3)
    assert (got == values(np.array([200, 100, 50, 130], np.uint8))).all()


@pytest.mark.parametrize(
    ("header", "size", "data", "told"),
    [
        ("FORMAT=Radiance_rle_spectra\nNCOMP=12\n", "-Y 1 +X 1", b"abcd", "Radiance_rle_spectra"),
        ("NCOMP=6\n", "-Y 1 +X 1", b"abcd", "NCOMP=3, got 6"),
        ("EXPOSURE=0\n", "-Y 1 +X 1", b"abcd", "EXPOSURE above 0"),
        ("EXPOSURE=-1\n", "-Y 1 +X 1", b"abcd", "EXPOSURE above 0"),
        ("EXPOSURE=nan\n", "-Y 1 +X 1", b"abcd", "after EXPOSURE="),
        ("EXPOSURE=1e999\n", "-Y 1 +X 1", b"abcd", "EXPOSURE above 0"),
        ("EXPOSURE=1e-30\n", "-Y 1 +X 1", b"\x80\x80\x80\xff", "float32"),
        ("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1", b"\xff\x10\x10\xff", "float32"),
        ("COLORCORR=1 2\n", "-Y 1 +X 1", b"abcd", "3 number"),
        ("", "-Y 1 +Y 1", b"abcd", "-Y 512"),
        ("", "-Y 0 +X 4", b"abcd", "-Y 512"),
        ("", "-Y 4 +X", b"abcd", "-Y 512"),
        ("", "-Y 2 +X 2", b"\x80\x80\x80\x80" * 3, "scanline 1"),
        ("", "-Y 2 +X 8", b"\2\2\0\7" + b"\x88\1" * 4, "scanline 0.*another number"),
        ("", "-Y 1 +X 8", b"\2\2\0\x08" + b"\x89\1" * 4, "scanline 0.*too long"),
        ("", "-Y 1 +X 8", b"\2\2\0\x08" + b"\x88\1" * 3, "scanline 0.*early"),
        ("", "-Y 100000 +X 100000", b"\x80\x80\x80\x80" + b"\1\1\1\xff" * 4, "at most 33554432 pixels"),
        ("", "-Y 900000000 +X 900000000", b"abcd", "at most"),
        ("", "-Y 4000 +X 8000", b"\x80\x80\x80\x80", "early"),
    ],
)  # fmt: skip
def test_broken_files_say_what_was_expected(header, size, data, told, tmp_path):
    path = write(tmp_path / "a.hdr", data, size, header=header)
    with pytest.raises(cc.ImageError, match=f"a.hdr: .*{told}"):
        cc.load_image(path)


def test_mutated_files_are_pictures_or_image_errors(rgbe, rng, tmp_path):
    path = tmp_path / "a.hdr"
    whole = [
        write(path, code(rgbe), header="EXPOSURE=2\nFORMAT=32-bit_rle_xyze\n").read_bytes()
        for code in CODINGS.values()
    ]
    read = 0
    for index in range(400):
        data = bytearray(whole[index % len(whole)])
        for _ in range(rng.integers(1, 4)):
            data[rng.integers(len(data))] = rng.choice([0, 1, 2, 48, 57, 255, rng.integers(256)])
        if index % 5 == 0:
            del data[rng.integers(len(data)) :]
        path.write_bytes(data)
        try:
            cc.load_image(path)
            read += 1
        except cc.ImageError:
            pass
    assert 50 < read < 390
