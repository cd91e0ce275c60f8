"""Small sound files of every kind that cubecam reads, to be broken."""

from __future__ import annotations

import functools
import struct
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

import cubecam as cc

SQUARE = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]


@functools.cache
def seeds() -> dict[str, list[bytes]]:
    """Make the files of each kind; the kind is the extension."""
    with tempfile.TemporaryDirectory() as name:
        return {**_meshes(), **_pictures(Path(name))}


def _meshes() -> dict[str, list[bytes]]:
    return {"obj": _obj(), "ply": _ply(), "stl": _stl(), "off": _off(), "glb": _glb()}


def _obj() -> list[bytes]:
    v = "".join(f"v {x}\n" for x in SQUARE)
    rest = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
    texts = [
        v + "f 1 2 3\nf -4 -2 -1\n",
        "mtllib a.mtl\no thing\n"
        + v
        + rest
        + "usemtl red\ng one two\ns 1\nf 1/1/1 2/2/1 3/3/1 4/1/1\nl 1 2\n",
        "\ufeff# text \\\n"
        + v.replace("\n", " 0.5 1 0.25 \\\n\n")
        + rest
        + "f 1//1 2//1 3//1 # end\nf 1/1 3/2 4\n",
        "v 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n".replace("0 0\n", "0 0 0\n", 1)
        + "f 1 2 3 4 5 6\n",
    ]
    return [text.encode() for text in texts] + [texts[1].encode("utf-16")]


def _ply() -> list[bytes]:
    xyz = "property float x\nproperty float y\nproperty float z\n"
    lists = "property list uchar int vertex_indices\n"

    def head(form: str, vertex: str, face: str, more: str = "") -> str:
        return f"ply\nformat {form} 1.0\ncomment c\nelement vertex 4\n{vertex}element face 2\n{face}{more}end_header\n"

    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    rows = "\n".join(f"{x} 255 0 9" for x in SQUARE)
    edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    wedges = "property list uchar float texcoord\n"
    files = [
        (head("ascii", xyz + colors, lists, edges) + rows + "\n3 0 1 2\n3 0 2 3\n0 1\n").encode(),
        (
            head("ascii", xyz, lists + wedges) + "\n".join(SQUARE)
            + "\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0 1\n"
        ).encode(),
        (
            "ply\nformat ascii 1.0\nelement vertex 4\n" + xyz + "element tristrips 1\n"
            "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n6 0 1 2 -1 2 3\n"
        ).encode(),
    ]  # fmt: skip
    points = np.array([x.split() for x in SQUARE], float)
    for form, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        body = b"".join(struct.pack(order + "3f3B", *p, 255, 0, 9) for p in points)
        body += struct.pack(order + "B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3) + struct.pack(
            order + "2i", 0, 1
        )
        files.append(head(form, xyz + colors, lists, edges).encode() + body)
        body = points.astype(order + "f4").tobytes() + struct.pack(
            order + "B3iB4i", 3, 0, 1, 2, 4, 0, 1, 2, 3
        )
        files.append(head(form, xyz, lists).encode() + body)
    return files


def _stl() -> list[bytes]:
    record = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    other = struct.pack("<12fH", 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0xFC1F)
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    return [
        b"solid of a program".ljust(80) + struct.pack("<I", 2) + record + other,
        b"COLOR=\1\2\3\4".ljust(80) + struct.pack("<I", 2) + record + other + b"\0\0",
        f"solid vertex of a facet\n{facet}{facet.upper()}endsolid\n".encode(),
    ]


def _off() -> list[bytes]:
    points = "\n".join(SQUARE)
    return [
        f"OFF\n4 2 0\n{points}\n3 0 1 2\n4 0 1 2 3 255 0 0\n".encode(),
        b"COFF 4 1 0\n" + "\n".join(f"{x} 255 0 9 255" for x in SQUARE).encode() + b"\n4 0 1 2 3\n",
        f"4 2 0 # no word\n{points}\n3 0 1 2 0.5 0.25 1\n3 0 2 3 1 1 1\n".encode(),
        b"OFF BINARY\n" + struct.pack(">3i", 4, 1, 0) + np.array([x.split() for x in SQUARE], ">f4").tobytes()
        + struct.pack(">6i", 4, 0, 1, 2, 3, 0),
    ]  # fmt: skip


def _glb() -> list[bytes]:
    return [cc.sample_data("suzanne.glb").read_bytes()]


def _pictures(folder: Path) -> dict[str, list[bytes]]:
    rng = np.random.default_rng(1)
    light = rng.random((12, 24, 3)).astype(np.float32)
    cube = cc.CubeMap(rng.random((6, 8, 8, 3)).astype(np.float32))
    files: dict[str, list[bytes]] = {}

    def keep(kind: str, path: Path) -> None:
        files.setdefault(kind, []).append(path.read_bytes())

    for kind in ["hdr", "exr", "png", "jpg", "tif", "webp", "bmp", "tga"]:
        path = folder / f"a.{kind}"
        cc.save_image(path, light)
        keep(kind, path)
        cube.save(path, layout="cross", tonemap="reinhard")
        keep(kind, path)
    for name in ("a.png", "a.tif", "a.exr"):
        cc.save_image(folder / name, (rng.random((6, 8, 4)) * 65535).astype(np.uint16))
        keep(name[2:], folder / name)
    cube.save(folder / "a.exr", layout="openexr")
    keep("exr", folder / "a.exr")
    _exr_parts(folder / "parts.exr", light)
    keep("exr", folder / "parts.exr")
    for kind in ("gif", "webp", "png"):
        path = folder / f"turn.{kind}"
        cc.save_animation(
            path, [(light * 255).astype(np.uint8), 255 - (light * 255).astype(np.uint8)]
        )
        keep(kind, path)
    files["hdr"] += _radiance(rng)
    files["pic"] = _radiance(rng)[:2]
    files["dds"] = _dds(rng)
    return files


def _exr_parts(path: Path, light: np.ndarray) -> None:
    depth = oiio.ImageSpec(24, 12, 1, "float")
    depth.channelnames = ("Z",)
    depth.attribute("oiio:subimagename", "depth")
    color = oiio.ImageSpec(24, 12, 3, "half")
    color.attribute("oiio:subimagename", "beauty")
    color.tile_width = color.tile_height = 16
    file = oiio.ImageOutput.create(str(path))
    assert file is not None
    assert file.open(str(path), (depth, color))
    file.write_image(light[..., :1])
    file.open(str(path), color, "AppendSubimage")
    file.write_image(light)
    file.close()


def _radiance(rng: np.random.Generator) -> list[bytes]:
    rgbe = rng.integers(0, 256, (6, 12, 4)).astype(np.uint8)
    rgbe[..., 0] |= 128
    flat = rgbe.tobytes()
    old = b"".join(row[0].tobytes() + bytes([1, 1, 1, 5]) + row[6:].tobytes() for row in rgbe)
    heads = [
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 6 +X 12\n",
        "#?RGBE\nFORMAT=32-bit_rle_xyze\n\n+X 12 +Y 6\n",
    ]
    return [heads[0].encode() + flat, heads[1].encode() + flat, heads[0].encode() + old]


def _dds(rng: np.random.Generator) -> list[bytes]:
    def head(size: int, flags: int, code: bytes, bits: int, caps: int, mips: int) -> bytes:
        top = struct.pack("<4s7I44x", b"DDS ", 124, 0x2100F, size, size, size * 4, 0, mips)
        masks = (0xFF0000, 0xFF00, 0xFF, 0xFF000000) if not code.strip(b"\0") else (0, 0, 0, 0)
        form = struct.pack("<2I4s5I", 32, flags, code, bits, *masks)
        return top + form + struct.pack("<5I", 0x401008, caps, 0, 0, 0)

    chain = sum(4 * size * size for size in (4, 2, 1))
    return [
        head(4, 0x41, bytes(4), 32, 0xFE00, 1) + rng.bytes(6 * 64),
        head(4, 0x41, bytes(4), 32, 0xFE00, 3) + rng.bytes(6 * chain),
        head(4, 4, struct.pack("<I", 113), 0, 0xFE00, 1) + rng.bytes(6 * 128),
        head(4, 4, b"DX10", 0, 0xFE00, 1) + struct.pack("<5I", 28, 3, 4, 1, 0) + rng.bytes(6 * 64),
        head(4, 4, b"DXT1", 0, 0, 1) + rng.bytes(8),
    ]
