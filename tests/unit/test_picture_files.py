"""Parts of picture files, display windows, limits before memory is taken, and the kinds that are refused by name."""

import struct
import subprocess
import sys
import zlib
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical

HEIGHT, WIDTH = 6, 12
DTYPES = {0: "<u4", 1: "<f2", 2: "<f4"}


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def exr(path, channels, data, display=None, packing=0, attributes=b"", flags=2):
    """Write an EXR file by hand ("OpenEXR File Layout"): `channels` are (name, type, sampling, (h, w) pixels)."""
    listed = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", kind, 0, step, step)
        for name, kind, step, _ in channels
    )
    head = struct.pack("<2i", 20000630, flags)
    head += attribute("channels", "chlist", listed + b"\0")
    head += attribute("compression", "compression", bytes([packing]))
    head += attribute("dataWindow", "box2i", struct.pack("<4i", *data))
    head += attribute("displayWindow", "box2i", struct.pack("<4i", *(display or data)))
    head += attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + attributes + b"\0"
    rows, table = [], b""
    for y in range(data[1], data[3] + 1):
        body = b"".join(
            np.ascontiguousarray(pixels[(y - data[1]) // step], DTYPES[kind]).tobytes()
            for _, kind, step, pixels in channels
            if y % step == 0
        )
        rows.append(struct.pack("<2i", y, len(body)) + body)
    at = len(head) + 8 * len(rows)
    for row in rows:
        table += struct.pack("<Q", at)
        at += len(row)
    path.write_bytes(head + table + b"".join(rows))
    return path


def parts(path, *given):
    """Write an EXR of several parts: (name, view, channel names, (h, w, c) pixels)."""
    import OpenImageIO as oiio

    specs = []
    for name, view, channels, pixels in given:
        height, width, count = pixels.shape
        spec = oiio.ImageSpec(
            width, height, count, "half" if pixels.dtype == np.float16 else "float"
        )
        spec.channelnames = channels
        spec.attribute("oiio:subimagename", name)
        if view:
            spec.attribute("view", view)
        specs.append(spec)
    file = oiio.ImageOutput.create("parts.exr")
    assert file is not None
    assert file.open(str(path), tuple(specs))
    for index, (_, _, _, pixels) in enumerate(given):
        if index:
            assert file.open(str(path), specs[index], "AppendSubimage")
        assert file.write_image(pixels)
    assert file.close()
    return path


@pytest.fixture
def color(rng):
    return rng.random((HEIGHT, WIDTH, 3)).astype(np.float16)


@pytest.fixture
def depth(rng):
    return rng.random((HEIGHT, WIDTH, 1)).astype(np.float32)


def test_the_first_part_with_colours_is_the_default(color, depth, tmp_path):
    path = parts(
        tmp_path / "a.exr",
        ("depth", "", ["Z"], depth),
        ("motion", "", ["x", "y2"], np.repeat(depth, 2, axis=2)),
        ("beauty", "", ["R", "G", "B"], color),
        ("again", "", ["R", "G", "B"], color[::-1].copy()),
    )
    assert_identical(cc.load_image(path), color)
    assert_identical(cc.load_image(path, part=0), depth)
    assert_identical(cc.load_image(path, part="depth"), depth)
    assert_identical(cc.load_image(path, part="beauty"), color)
    assert_identical(cc.load_image(path, part=np.int64(3)), color[::-1])
    cube = cc.load_cubemap(path, part="again", size=4)
    assert_identical(cube.faces, cc.CubeMap.from_equirect(color[::-1], size=4).faces)
    assert_identical(
        cc.load_environment(path, size=4).faces, cc.CubeMap.from_equirect(color, size=4).faces
    )


def test_layers_count_as_colours_and_grey_comes_after(color, depth, tmp_path):
    layered = parts(
        tmp_path / "a.exr",
        ("grey", "", ["Y"], depth),
        ("view", "", ["view.R", "view.G", "view.B"], color),
    )
    assert_identical(cc.load_image(layered), color)
    grey = parts(
        tmp_path / "b.exr", ("z", "", ["Z"], depth), ("grey", "", ["Y"], depth[::-1].copy())
    )
    assert_identical(cc.load_image(grey), depth[::-1])
    neither = parts(
        tmp_path / "c.exr", ("z", "", ["Z"], depth), ("w", "", ["W"], depth[::-1].copy())
    )
    assert_identical(cc.load_image(neither), depth)


def test_a_part_that_is_not_there_is_refused_with_those_that_are(color, depth, tmp_path):
    path = parts(
        tmp_path / "a.exr",
        ("depth", "", ["Z"], depth),
        ("beauty", "", ["N.x", "N.y", "N.z"], color),
    )
    told = r"a\.exr: part: expected one of 0 'depth', 1 'beauty' or a layer: N; got "
    for load in (cc.load_image, cc.load_cubemap):
        with pytest.raises(ValueError, match=told + "2"):
            load(path, part=2)
        with pytest.raises(ValueError, match=told + "'Depth'"):
            load(path, part="Depth")
        with pytest.raises(ValueError, match="expected an int of at least 0, got -1"):
            load(path, part=-1)
        wrong: list[Any] = [True, 1.0, ["depth"]]
        for part in wrong:
            with pytest.raises(TypeError, match="part: expected a whole number or a name"):
                load(path, part=part)
    cc.save_image(tmp_path / "a.png", np.zeros((2, 4, 3), np.uint8))
    assert cc.load_image(tmp_path / "a.png", part=0).shape == (2, 4, 3)
    with pytest.raises(ValueError, match="expected one of 0; got 1"):
        cc.load_image(tmp_path / "a.png", part=1)
    cc.save_image(tmp_path / "a.hdr", np.zeros((2, 4, 3), np.float32))
    with pytest.raises(ValueError, match="holds one picture; got 1"):
        cc.load_image(tmp_path / "a.hdr", part=1)


def test_two_views_in_two_parts(color, tmp_path):
    right = color[::-1].copy()
    path = parts(
        tmp_path / "a.exr",
        ("rgb.left", "left", ["R", "G", "B"], color),
        ("rgb.right", "right", ["R", "G", "B"], right),
    )
    assert_identical(cc.load_image(path), color)
    assert_identical(cc.load_image(path, part="left"), color)
    assert_identical(cc.load_image(path, part="right"), right)
    assert_identical(cc.load_image(path, part="rgb.right"), right)


def test_two_views_and_layers_in_one_part(color, tmp_path):
    """The channels of the first view have no prefix ("Multi-View OpenEXR")."""
    right = color[::-1]
    views = struct.pack("<i", 4) + b"left" + struct.pack("<i", 5) + b"right"
    channels = [
        (prefix + name, 1, 1, pixels[..., index])
        for prefix, pixels in (("", color), ("right.", right))
        for index, name in ((2, "B"), (1, "G"), (0, "R"))
    ]
    channels.insert(3, ("albedo.Y", 1, 1, color[..., 0]))
    channels.sort(key=lambda channel: channel[0])
    path = exr(
        tmp_path / "a.exr", channels, (0, 0, WIDTH - 1, HEIGHT - 1),
        attributes=attribute("multiView", "stringvector", views),
    )  # fmt: skip
    assert_identical(cc.load_image(path), color)
    assert_identical(cc.load_image(path, part="right"), right)
    assert_identical(cc.load_image(path, part="left"), color)
    assert_identical(cc.load_image(path, part="albedo"), color[..., :1])


def test_y_is_grey_beside_a_depth_and_a_coordinate_beside_x(color, depth, tmp_path):
    """The channels Y, A, Z were the three colours, and a layer N.X, N.Y, N.Z gave N.Y alone."""
    grey = parts(tmp_path / "a.exr", ("", "", ["Y", "A", "Z"], color))
    assert_identical(cc.load_image(grey), color[..., [0, 0, 0, 1]])
    names = ["N.X", "N.Y", "N.Z"]
    normals = parts(
        tmp_path / "b.exr",
        ("", "", [*names, "R", "G", "B"], np.concatenate([color, color[::-1]], 2)),
    )
    assert_identical(cc.load_image(normals), color[::-1])
    assert_identical(cc.load_image(normals, part="N"), color)
    after = parts(tmp_path / "c.exr", ("n", "", names, color), ("grey", "", ["Y"], depth))
    assert_identical(cc.load_image(after), depth)
    motion = np.concatenate([color, color[..., :2]], 2)
    path = parts(tmp_path / "d.exr", ("", "", [*names, "motion.X", "motion.Y"], motion))
    for part in (None, "motion"):
        with pytest.raises(cc.ImageError, match="expected 1, 3 or 4 channels"):
            cc.load_image(path, part=part)


@pytest.mark.parametrize("ending", ["gif", "webp", "png", "tif"])
def test_frames_and_pages(ending, tmp_path):
    from PIL import Image as Picture

    frames = [np.full((8, 16, 3), level, np.uint8) for level in (40, 120, 240)]
    if ending == "tif":
        first, *others = [Picture.fromarray(frame) for frame in frames]
        first.save(tmp_path / "a.tif", save_all=True, append_images=others)
    else:
        cc.save_animation(tmp_path / f"a.{ending}", frames)
    path = tmp_path / f"a.{ending}"
    assert np.abs(cc.load_image(path)[..., :3].astype(int) - 40).max() <= 2
    if ending == "png":  # OpenImageIO reads the first frame of an animated PNG
        return
    for index, level in enumerate((40, 120, 240)):
        assert np.abs(cc.load_image(path, part=index)[..., :3].astype(int) - level).max() <= 2
    with pytest.raises(ValueError, match="expected one of 0, 1, 2; got 3"):
        cc.load_image(path, part=3)


def test_tiles_and_the_first_of_several_levels(tmp_path, rng):
    import OpenImageIO as oiio

    pixels = rng.random((32, 64, 3)).astype(np.float16)
    spec = oiio.ImageSpec(64, 32, 3, "half")
    spec.tile_width = spec.tile_height = 16
    file = oiio.ImageOutput.create("tiles.exr")
    assert file is not None
    assert file.open(str(tmp_path / "tiles.exr"), spec)
    assert file.write_image(pixels)
    assert file.close()
    buffer = oiio.ImageBuf(pixels)
    oiio.ImageBufAlgo.make_texture(oiio.MakeTxTexture, buffer, str(tmp_path / "levels.exr"))
    for name in ("tiles", "levels"):
        assert_identical(cc.load_image(tmp_path / f"{name}.exr").astype(np.float16), pixels)


@pytest.mark.parametrize("left", [-3, 0, 5, 30])
@pytest.mark.parametrize("top", [-2, 0, 4, -30])
def test_data_lie_in_their_display_window(left, top, color, tmp_path):
    """The display window is 20 x 10 at (2, 1); outside the data it is 0."""
    channels = [(name, 1, 1, color[..., index]) for index, name in ((2, "B"), (1, "G"), (0, "R"))]
    data = (2 + left, 1 + top, 2 + left + WIDTH - 1, 1 + top + HEIGHT - 1)
    path = exr(tmp_path / "a.exr", channels, data, (2, 1, 21, 10))
    want = np.zeros((10, 20, 3), np.float16)
    for y in range(10):
        for x in range(20):
            if 0 <= y - top < HEIGHT and 0 <= x - left < WIDTH:
                want[y, x] = color[y - top, x - left]
    assert_identical(cc.load_image(path), want)


def test_a_small_file_with_a_large_display_window(tmp_path):
    """Zeros outside the data take no bytes: 8192 x 4096 are allowed, 20001 x 20001 are not."""
    one = [("R", 1, 1, np.ones((1, 1)))]
    path = exr(tmp_path / "a.exr", one, (0, 0, 0, 0), (0, 0, 20000, 20000))
    assert path.stat().st_size < 400
    with pytest.raises(cc.ImageError, match=r"a.exr: expected a display window.*20001 x 20001"):
        cc.load_image(path)
    path = exr(tmp_path / "b.exr", one, (4, 2, 4, 2), (0, 0, 8191, 4095))
    got = cc.load_image(path)
    assert got.shape == (4096, 8192, 1)
    assert got[2, 4, 0] == 1
    assert int(np.count_nonzero(got)) == 1


def png(width, height, color=2, depth=8, data=b""):
    def chunk(kind, body):
        return (
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        )

    size = struct.pack(">2I5B", width, height, depth, color, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def tiff(width, height, packing=1):
    tags = {
        256: width,
        257: height,
        258: 8,
        259: packing,
        262: 1,
        273: 8,
        277: 1,
        278: height,
        279: 64,
    }
    entries = b"".join(struct.pack("<2H2I", tag, 4, 1, value) for tag, value in tags.items())
    return (
        b"II*\0"
        + struct.pack("<I", 72)
        + bytes(64)
        + struct.pack("<H", len(tags))
        + entries
        + bytes(4)
    )


def webp(size):
    """A lossless picture whose pixels are missing."""
    body = b"VP8L" + struct.pack("<IBI", 25, 0x2F, (size - 1) | (size - 1) << 14) + bytes(20)
    return b"RIFF" + struct.pack("<I", len(body) + 4) + b"WEBP" + body


def claims(size):
    """Files of about 200 bytes whose headers tell of `size` x `size` pixels."""
    frame = b"," + struct.pack("<4HB", 0, 0, size, size, 0) + b"\2\2\x4c\1\0;"
    return {
        "png": png(size, size),
        "bmp": b"BM"
        + struct.pack("<4I2i2H6I", 200, 0, 54, 40, size, size, 1, 24, *6 * [0])
        + bytes(146),
        "tga": struct.pack("<3B2HB4H2B", 0, 0, 2, 0, 0, 0, 0, 0, size, size, 32, 0) + bytes(200),
        "tif": tiff(size, size),
        "ppm": f"P6\n{size} {size}\n255\n".encode() + bytes(200),
        "webp": webp(min(size, 16000)),
        "gif": b"GIF89a" + struct.pack("<2H3B", size, size, 0x80, 0, 0) + bytes(6) + frame,
    }


CLAIMS = {
    f"{size}.{ending}": data for size in (10000, 60000) for ending, data in claims(size).items()
}


@pytest.mark.parametrize("name", CLAIMS)
def test_headers_cannot_claim_more_than_the_bytes_hold(name, tmp_path):
    path = tmp_path / name
    path.write_bytes(CLAIMS[name])
    # OpenImageIO has checks of its own when it opens these.
    told = "claim" if name.endswith("tga") or "60000" in name else "expected at most"
    with pytest.raises(cc.ImageError, match=rf"{name}: .*({told}|expected at most)"):
        cc.load_image(path)


def test_refused_claims_take_no_memory(tmp_path):
    """A process that may hold 1 GiB reads them all: the largest claims 14 GB."""
    paths = []
    for name, data in CLAIMS.items():
        paths.append(tmp_path / name)
        paths[-1].write_bytes(data)
    paths.append(
        exr(tmp_path / "a.exr", [("R", 1, 1, np.ones((1, 1)))], (0, 0, 0, 0), (0, 0, 20000, 20000))
    )
    script = """
        import resource, sys, cubecam as cc, numpy as np, pathlib
        cc.save_image(pathlib.Path(sys.argv[1]).with_name("warm.png"), np.zeros((2, 2, 3), np.uint8))
        def peak(): return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        before = peak()
        for path in sys.argv[1:]:
            try: cc.load_image(path)
            except cc.ImageError: pass
            else: raise SystemExit(f"{path}: expected an ImageError")
        print(peak() - before)
    """
    code = "\n".join(line[8:] for line in script.splitlines())
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, paths)], capture_output=True, text=True, check=True
    )
    assert float(done.stdout) < 64


@pytest.mark.parametrize("ending", ["png", "webp", "jpg"])
def test_large_constant_pictures_are_read(ending, tmp_path):
    cc.save_image(tmp_path / f"a.{ending}", np.full((4096, 8192, 3), 7, np.uint8))
    assert (tmp_path / f"a.{ending}").stat().st_size < 1_000_000
    got = cc.load_image(tmp_path / f"a.{ending}")
    assert got.shape == (4096, 8192, 3)
    assert (got == 7).all()


@pytest.mark.parametrize("packing", ["zip", "piz", "dwab"])
def test_large_constant_exr_files_of_every_packing(packing, tmp_path):
    """ "dwab" makes 14 kB of 200 MB."""
    import OpenImageIO as oiio

    spec = oiio.ImageSpec(8192, 4096, 3, "half")
    spec.attribute("compression", packing)
    file = oiio.ImageOutput.create("a.exr")
    assert file is not None
    assert file.open(str(tmp_path / "a.exr"), spec)
    assert file.write_image(np.ones((4096, 8192, 3), np.float16))
    assert file.close()
    assert (tmp_path / "a.exr").stat().st_size < 1_000_000
    got = cc.load_image(tmp_path / "a.exr")
    assert got.shape == (4096, 8192, 3)
    assert np.ptp(got) == 0
    assert abs(got[0, 0, 0] - 1) < 0.01


@pytest.mark.parametrize(
    ("start", "told"),
    [
        (b"\xabKTX 20\xbb\r\n\x1a\n", "expected 1 to 65536 texels along an edge"),
        (b"\xabKTX 11\xbb\r\n\x1a\n", "KTX files are not read yet"),
        (b"sB\x13\0", "Basis files"),
        (b"\x86\x16\x87\x96\xf6\xd6\x96\x36", r"Babylon.js .env files"),
        (b"\0\0\0\x1cftypavif", "AVIF files"),
        (b"\0\0\0\x1cftypheic", "HEIC files"),
    ],
)
@pytest.mark.parametrize("load", [cc.load_image, cc.load_cubemap, cc.load_environment])
@pytest.mark.parametrize("name", ["a.ktx2", "a.png"])
def test_kinds_that_are_not_read_are_named(load, start, told, name, tmp_path):
    (tmp_path / name).write_bytes(start + bytes(100))
    with pytest.raises(cc.ImageError, match=f"{name}: {told}"):
        load(tmp_path / name)


def test_deep_and_luminance_chroma_files_are_named(color, tmp_path):
    import OpenImageIO as oiio

    spec = oiio.ImageSpec(4, 2, 1, "float")
    spec.channelnames, spec.deep, spec.channelformats = ["Z"], True, ("float",)
    file = oiio.ImageOutput.create("deep.exr")
    assert file is not None
    assert file.open(str(tmp_path / "deep.exr"), spec)
    samples = oiio.DeepData()
    samples.init(8, 1, ("float",), ("Z",))
    assert file.write_deep_image(samples)
    assert file.close()
    with pytest.raises(
        cc.ImageError, match=r"deep.exr: expected one sample a pixel, got a deep EXR"
    ):
        cc.load_image(tmp_path / "deep.exr")
    luminance = color[..., 0]
    for step, chroma in ((2, luminance[::2, ::2]), (1, luminance)):
        channels = [("BY", 1, step, chroma), ("RY", 1, step, chroma), ("Y", 1, 1, luminance)]
        path = exr(tmp_path / "lc.exr", channels, (0, 0, WIDTH - 1, HEIGHT - 1))
        if oiio.VERSION < 30200 and step == 2:  # given as red, green and blue
            picture = cc.load_image(path).astype(np.float32)
            found = picture @ np.array((0.2126, 0.7152, 0.0722), np.float32)
            assert np.abs(found - luminance).max() <= 2e-3 * luminance.max()
            continue
        with pytest.raises(cc.ImageError, match=r"lc.exr: .*(chroma|Subsampled channels|BY)"):
            cc.load_image(path)


def test_names_that_stand_for_no_file(tmp_path):
    """OpenImageIO makes up pictures for some extensions, and takes text after a question mark for options."""
    cc.save_image(tmp_path / "a.png", np.full((2, 3, 3), 9, np.uint8))
    for name in ("a.null", "a.NUL", "a.term"):
        (tmp_path / "a.png").replace(tmp_path / name)
        assert_identical(cc.load_image(tmp_path / name), np.full((2, 3, 3), 9, np.uint8))
        (tmp_path / name).replace(tmp_path / "a.png")
    (tmp_path / "a.png").replace(tmp_path / "a?width=7.png")
    assert cc.load_image(tmp_path / "a?width=7.png").shape == (2, 3, 3)


def test_numbers_of_channels(tmp_path, rng):
    import OpenImageIO as oiio

    def written(name, pixels, kind, names=None):
        spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
        if names:
            spec.channelnames = names
        file = oiio.ImageOutput.create(name)
        assert file is not None
        assert file.open(str(tmp_path / name), spec)
        assert file.write_image(pixels)
        assert file.close()
        return tmp_path / name

    five = rng.integers(0, 256, (3, 4, 5), dtype=np.uint8)
    assert_identical(cc.load_image(written("a.tif", five, "uint8")), five[..., :4])
    two = rng.random((3, 4, 2)).astype(np.float32)
    assert_identical(
        cc.load_image(written("a.exr", two, "float", ["Y", "A"])), two[..., [0, 0, 0, 1]]
    )
    assert_identical(cc.load_image(written("b.exr", two, "float", ["Y", "Z"])), two[..., :1])
    with pytest.raises(cc.ImageError, match=r"c.exr: expected 1, 3 or 4 channels.*U, V"):
        cc.load_image(written("c.exr", two, "float", ["U", "V"]))
    ids = rng.integers(0, 2**32, (3, 4, 1), dtype=np.uint32)
    assert_identical(cc.load_image(written("d.exr", ids, "uint", ["id"])), ids)
    one = rng.integers(0, 256, (1, 1, 3), dtype=np.uint8)
    for ending in ("png", "bmp", "tif", "webp", "tga"):
        cc.save_image(tmp_path / f"one.{ending}", one)
        assert_identical(cc.load_image(tmp_path / f"one.{ending}"), one)


def test_pictures_of_other_colour_models(tmp_path, rng):
    from PIL import Image as Picture

    grey = rng.integers(0, 256, (8, 8), dtype=np.uint8)
    Picture.fromarray(grey).convert("P").save(tmp_path / "palette.png")
    assert_identical(
        cc.load_image(tmp_path / "palette.png")[..., :3], grey[..., None].repeat(3, axis=2)
    )
    Picture.fromarray(grey > 99).save(tmp_path / "bits.png")
    assert_identical(
        cc.load_image(tmp_path / "bits.png")[..., 0], np.where(grey > 99, 255, 0).astype(np.uint8)
    )
    flat = np.full((16, 16, 3), (200, 90, 30), np.uint8)
    Picture.fromarray(flat).convert("CMYK").save(tmp_path / "cmyk.jpg", quality=100)
    assert np.abs(cc.load_image(tmp_path / "cmyk.jpg").astype(int) - flat).max() <= 3


def test_mutated_files_are_pictures_or_image_errors(tmp_path, rng, color, depth):
    from PIL import Image as Picture

    pixels = (rng.random((16, 24, 3)) * 255).astype(np.uint8) // 64 * 64
    for ending in ("png", "jpg", "tif", "webp", "bmp", "tga"):
        cc.save_image(tmp_path / f"a.{ending}", pixels)
    cc.save_image(tmp_path / "a.exr", pixels.astype(np.float16))
    Picture.fromarray(pixels).save(tmp_path / "a.gif")
    parts(tmp_path / "b.exr", ("z", "", ["Z"], depth), ("rgb", "", ["R", "G", "B"], color))
    whole = {path: path.read_bytes() for path in tmp_path.iterdir()}
    read = 0
    for index in range(450):
        path = list(whole)[index % len(whole)]
        data = bytearray(whole[path])
        for _ in range(rng.integers(1, 4)):
            at = rng.integers(min(len(data), 300) if index % 2 else len(data))
            data[at] = rng.choice([0, 1, 127, 255, rng.integers(256)])
        if index % 5 == 0:
            del data[rng.integers(len(data)) :]
        path.write_bytes(data)
        try:
            cc.load_image(path)
            read += 1
        except cc.ImageError:
            pass
    assert 50 < read < 440
