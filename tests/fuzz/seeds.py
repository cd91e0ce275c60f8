"""Small sound files of every kind that cubecam reads, to be broken."""

from __future__ import annotations

import functools
import struct
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

import cubecam as cc
from cubecam.io import ktx2
from tests.gltf_files import GltfFile
from tests.scene_files import SceneFile, f32, noise

SQUARE = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]


@functools.cache
def seeds() -> dict[str, list[bytes]]:
    """Make the files of each kind; the kind is the extension."""
    with tempfile.TemporaryDirectory() as name:
        return {**_meshes(), **_pictures(Path(name))}


def _meshes() -> dict[str, list[bytes]]:
    return {"obj": _obj(), "mtl": _mtl(), "ply": _ply(), "stl": _stl(), "off": _off(), **_gltf()}


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


def _mtl() -> list[bytes]:
    texts = [
        "newmtl a\nKd .1 .2 .3\nKs 1 1 1\nNs 90\nNi 1.5\nd .5\nillum 3\nnewmtl b c\nPr .5\nPm 1\nKe 1 1 1\n",
        "newmtl a\nmap_Kd -s 2 2 1 -o .5 0 -clamp on missing.png\nTr .5\nnewmtl b c\nmap_Bump -bm 2 x.png\n",
        "# by hand\nnewmtl a\nPc 1\nPcr .5\nPs .5\naniso .5\nanisor .25\nnewmtl b c\nmap_d -mm 0 1 d.png\n",
    ]
    return [text.encode() for text in texts]


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


def _gltf() -> dict[str, list[bytes]]:
    """Make files with all that moves vertices: sparse and small numbers, skins, shapes, instances, compression."""
    points = np.array([[float(x) for x in row.split()] for row in SQUARE], np.float32)
    made = []

    def begin() -> GltfFile:
        made.append(GltfFile())
        return made[-1]

    file = begin()
    around = file.node(mesh=file.mesh(), scale=[2, 1, -1], rotation=[0, 0.6, 0, 0.8], children=[1])
    file.node(root=False, mesh=0, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, around, 2, 3, 1])

    file = begin()
    joint = file.node(translation=[0, 0, 3])
    weights = np.tile(np.array([255, 0, 0, 0], np.uint8), (4, 1))
    where = file.primitive(
        points,
        np.array([0, 1, 2, 3], np.uint8),
        mode=6,
        JOINTS_0=np.zeros((4, 4), np.uint8),
        WEIGHTS_0=file.accessor(weights, normalized=True),
        COLOR_0=file.accessor(weights, normalized=True),
        TEXCOORD_0=points[:, :2],
        NORMAL=points,
    )
    where["targets"] = [{"POSITION": file.accessor(points), "NORMAL": file.accessor(points)}]
    bind = file.accessor(np.eye(4, dtype=np.float32).reshape(1, 16))
    file.add("skins", {"joints": [joint], "inverseBindMatrices": bind})
    file.node(mesh=file.mesh(where, weights=[0.5]), skin=0)

    file = begin()
    small = np.array([[0, 0, 0, 0], [32767, 0, 0, 0], [0, -32767, 0, 0]], np.int16)
    view = file.view(small.tobytes(), byteStride=8)
    entry = {
        "bufferView": view,
        "componentType": 5122,
        "normalized": True,
        "count": 3,
        "type": "VEC3",
    }
    thing = file.mesh(file.primitive(file.add("accessors", entry)))
    moved = {
        "TRANSLATION": file.accessor(points),
        "ROTATION": file.accessor(np.tile([0, 0, 0, 1], (4, 1)).astype("f4")),
    }
    file.node(mesh=thing, extensions={"EXT_mesh_gpu_instancing": {"attributes": moved}})
    sparse = file.accessor(points)
    file.tree["accessors"][sparse]["sparse"] = {
        "count": 2,
        "indices": {
            "bufferView": file.view(np.array([1, 2], np.uint16).tobytes()),
            "componentType": 5123,
        },
        "values": {"bufferView": file.view(points[2:].tobytes())},
    }
    file.node(mesh=file.mesh(file.primitive(sparse, np.array([0, 1, 2, 3], np.uint16), mode=5)))
    made.append(_whole_scene())
    return {
        "glb": [*(item.glb() for item in made), *_compressed()],
        "gltf": [item.gltf() for item in made],
    }


def _whole_scene() -> GltfFile:
    """Make a file with all that load_scene reads and load_mesh does not."""
    file = SceneFile()
    deep = noise(2, 2, 4)
    names = ("baseColorTexture", "metallicRoughnessTexture")
    plain = {"index": file.texture(noise(3, 2), {"wrapS": 33071, "minFilter": 9987})}
    moved = {
        "index": file.texture(file.image(noise(4, 4), "JPEG")),
        "texCoord": 1,
        "extensions": {
            "KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 1]}
        },
    }
    web = file.add(
        "textures",
        {"extensions": {"EXT_texture_webp": {"source": file.image(noise(2, 2), "WEBP")}}},
    )
    material = {
        "name": "all",
        "pbrMetallicRoughness": dict(zip(names, (plain, moved), strict=True)),
        "normalTexture": {"index": web, "scale": 0.5},
        "occlusionTexture": {**plain, "strength": 0.5},
        "emissiveFactor": [1, 0.5, 0],
        "alphaMode": "MASK",
        "extensions": {
            "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": plain},
            "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2},
        },
    }
    glossy = {"specularGlossinessTexture": {"index": file.texture(deep)}, "glossinessFactor": 0.5}
    number = file.add("materials", material)
    other = file.add("materials", {"extensions": {"KHR_materials_pbrSpecularGlossiness": glossy}})
    square = file.square(number)
    mapping = {"mappings": [{"material": other, "variants": [0]}]}
    square["extensions"] = {"KHR_materials_variants": mapping}
    file.use("KHR_materials_variants", {"variants": [{"name": "b"}]})
    lamp = {"type": "spot", "intensity": 2, "range": 9, "spot": {"outerConeAngle": 0.5}}
    file.use("KHR_lights_punctual", {"lights": [lamp, {"type": "directional"}]})
    lens = {"yfov": 1, "znear": 0.1}
    file.add("cameras", {"type": "perspective", "perspective": lens})
    shape = {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}
    file.add("cameras", {"type": "orthographic", "orthographic": shape})
    node = file.node(mesh=file.mesh(square, square), name="a", camera=0)
    file.node(camera=1, extensions={"KHR_lights_punctual": {"light": 0}})
    times = file.accessor(f32([0, 1]))
    rows = file.accessor(f32([[0, 0, 0, 1], [0, 1, 0, 0]]))
    channel = {"sampler": 0, "target": {"node": node, "path": "rotation"}}
    file.add("animations", {"channels": [channel], "samplers": [{"input": times, "output": rows}]})
    light = {"specularImages": [[file.image(deep)] * 6], "intensity": 2, "rotation": [0, 0, 0, 1]}
    file.use("EXT_lights_image_based", {"lights": [light]})
    file.tree["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}
    return file


def _compressed() -> list[bytes]:
    """Make files of Draco and meshopt data; the latter package needs Python 3.11."""
    import DracoPy

    ball = cc.Mesh.icosphere(1, subdivisions=1)
    draco = GltfFile(extensionsRequired=["KHR_draco_mesh_compression"])
    data = DracoPy.encode(ball.positions, ball.indices)
    count, corners = len(ball.positions), ball.indices.size
    where = {
        "attributes": {
            "POSITION": draco.add(
                "accessors", {"componentType": 5126, "type": "VEC3", "count": count}
            )
        },
        "indices": draco.add(
            "accessors", {"componentType": 5125, "type": "SCALAR", "count": corners}
        ),
        "extensions": {
            "KHR_draco_mesh_compression": {
                "bufferView": draco.view(data),
                "attributes": {"POSITION": 0},
            }
        },
    }
    draco.node(mesh=draco.mesh(where))
    files = [draco.glb()]
    try:
        import meshopt
    except ImportError:
        return files
    packed = GltfFile(extensionsRequired=["EXT_meshopt_compression"])
    packed.binary = bytes(
        meshopt.encode_gltf_buffer(np.ascontiguousarray(ball.positions), "ATTRIBUTES", 0)
    )
    entry = {
        "buffer": 0,
        "byteLength": len(packed.binary),
        "byteStride": 12,
        "count": count,
        "mode": "ATTRIBUTES",
    }
    view = packed.add(
        "bufferViews",
        {"buffer": 1, "byteLength": 12 * count, "extensions": {"EXT_meshopt_compression": entry}},
    )
    accessor = {"bufferView": view, "componentType": 5126, "count": count, "type": "VEC3"}
    packed.node(
        mesh=packed.mesh(packed.primitive(packed.add("accessors", accessor), ball.indices.ravel()))
    )
    fallback = {
        "byteLength": 12 * count,
        "extensions": {"EXT_meshopt_compression": {"fallback": True}},
    }
    files.append(packed.glb(buffers=[{"byteLength": len(packed.binary)}, fallback]))
    return files


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
    filtered = cc.CubeMap.from_levels([cube, cc.CubeMap(rng.random((6, 4, 4, 3), "f4"))])
    filtered.save(folder / "a.dds")
    keep("dds", folder / "a.dds")
    for compression in (None, "zlib", "zstd"):
        filtered.save(folder / "a.ktx2", compression=compression)
        keep("ktx2", folder / "a.ktx2")
    files["ktx2"] += _ktx2(rng)
    return files


def _ktx2(rng: np.random.Generator) -> list[bytes]:
    """Make pictures: 8 bits, blocks of BC1, and a header of Basis Universal without what it tells of."""
    plain = ktx2.write([rng.integers(0, 255, (4, 4, 4)).astype("u1")], encoding="srgb")
    blocks = bytearray(plain[: -64 + 8])
    blocks[12:16] = struct.pack("<I", 133)
    blocks[88:104] = struct.pack("<2Q", 8, 8)
    return [plain, bytes(blocks)]


def _exr_parts(path: Path, light: np.ndarray) -> None:
    depth = oiio.ImageSpec(24, 12, 1, "float")
    depth.channelnames = ("Z",)
    depth.attribute("oiio:subimagename", "depth")
    color = oiio.ImageSpec(24, 12, 3, "half")
    color.attribute("oiio:subimagename", "beauty")
    file = oiio.ImageOutput.create(str(path))
    assert file is not None
    assert file.open(str(path), (depth, color))
    assert file.write_image(np.ascontiguousarray(light[..., :1]))
    assert file.open(str(path), color, "AppendSubimage")
    assert file.write_image(light)
    file.close()
    del file  # the last bytes are written when the writer goes


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
        head(4, 4, struct.pack("<I", 113), 0, 0xFE00, 1)
        + rng.random(6 * 64).astype("<f2").tobytes(),
        head(4, 4, b"DX10", 0, 0xFE00, 1) + struct.pack("<5I", 28, 3, 4, 1, 0) + rng.bytes(6 * 64),
        head(4, 4, b"DXT1", 0, 0, 1) + rng.bytes(8),
    ]
