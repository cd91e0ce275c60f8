"""A GLB of 16 materials, written with json and struct alone: no reader or writer of cubecam has a part in it.

Four rows of four tiles hang below a turned root: one is moved, one turned, one mirrored, one squeezed by a matrix.
A camera and three lights (directional, point with a range, spot) hang below the same root.
"""

from __future__ import annotations

import io
import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

Array = npt.NDArray[Any]

EDGE = 4  # tiles along an edge
STEP = 1.25  # between the middles of two tiles
DISTANCE = 12.0  # of the camera from the middle of the tiles
TILES = (
    ("gold", "rough metal", "plastic", "base map"),
    ("normal map", "occlusion, emission", "vertex colours", "mask"),
    ("blend", "clearcoat", "sheen", "iridescence"),
    ("anisotropy", "glass", "ior, specular", "unlit"),
)
NAMES = tuple(name for row in TILES for name in row)
#: The cosine of the spot light's cones, and its angles.
SPOT = (0.12, 0.24)
RANGE = 12.0


class Writer:
    """glTF's lists, and one buffer."""

    def __init__(self) -> None:
        self.blob = b""
        self.tree: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "benchmarks.scenes"},
            "scene": 0,
            "scenes": [{"nodes": []}],
        }

    def add(self, kind: str, entry: dict[str, Any]) -> int:
        entries: list[Any] = self.tree.setdefault(kind, [])
        entries.append(entry)
        return len(entries) - 1

    def view(self, data: bytes, target: int | None = None) -> int:
        self.blob += b"\0" * (-len(self.blob) % 4)
        entry = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target is not None:
            entry["target"] = target
        self.blob += data
        return self.add("bufferViews", entry)

    def accessor(self, values: Array, *, bounds: bool = False) -> int:
        indices = values.dtype == np.uint32
        entry: dict[str, Any] = {
            "bufferView": self.view(values.tobytes(), 34963 if indices else 34962),
            "componentType": 5125 if indices else 5126,
            "count": len(values),
            "type": "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}",
        }
        if bounds:
            entry["min"] = values.min(0).tolist()
            entry["max"] = values.max(0).tolist()
        return self.add("accessors", entry)

    def texture(self, pixels: Array) -> int:
        file = io.BytesIO()
        Image.fromarray(pixels).save(file, "png")
        image = self.add(
            "images", {"bufferView": self.view(file.getvalue()), "mimeType": "image/png"}
        )
        return self.add("textures", {"source": image, "sampler": 0})

    def glb(self) -> bytes:
        self.tree["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(self.tree).encode()
        text += b" " * (-len(text) % 4)
        blob = self.blob + b"\0" * (-len(self.blob) % 4)
        return (
            struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(blob))
            + struct.pack("<I4s", len(text), b"JSON")
            + text
            + struct.pack("<I4s", len(blob), b"BIN\0")
            + blob
        )


def sphere(
    upper: float = 0.0, lower: float = np.pi, segments: int = 96, rings: int = 48
) -> tuple[Array, Array, Array, Array]:
    """(points = normals, uvs, tangents, triangles) between two polar angles; v runs down, as in glTF."""
    polar = np.linspace(upper, lower, rings + 1)
    around = np.linspace(0, 2 * np.pi, segments + 1)
    theta, phi = (a.ravel() for a in np.meshgrid(polar, around, indexing="ij"))
    points = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1)
    uvs = np.stack([phi / (2 * np.pi), theta / np.pi], -1)
    # glTF's bitangent points upwards in a picture, against growing v: here it is cross(n, t), w = 1.
    tangents = np.stack([np.cos(phi), 0 * phi, -np.sin(phi), np.ones_like(phi)], -1)
    row, column = (a.ravel() for a in np.meshgrid(np.arange(rings), np.arange(segments)))
    a = row * (segments + 1) + column
    b = a + segments + 1
    triangles = np.concatenate([np.stack([a, b, b + 1], -1), np.stack([a, b + 1, a + 1], -1)])
    return (
        points.astype(np.float32),
        uvs.astype(np.float32),
        tangents.astype(np.float32),
        triangles.ravel().astype(np.uint32),
    )


def pictures(size: int = 256) -> dict[str, Array]:
    """The textures, uint8: what each looks like turned or mirrored differs from what it is."""
    x, y = np.meshgrid((np.arange(size) + 0.5) / size, (np.arange(size) + 0.5) / size)
    checks = (np.floor(4 * x) + np.floor(4 * y)) % 2
    base = np.stack([0.25 + 0.7 * x, 0.2 + 0.6 * checks, 0.9 - 0.7 * y], -1)
    slope = 0.5 * np.stack([np.cos(2 * np.pi * 4 * x), np.cos(2 * np.pi * 4 * y)], -1)
    normal = np.concatenate([slope, np.ones((size, size, 1))], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    stripes = 0.5 + 0.5 * np.sin(2 * np.pi * 3 * x)
    metal = np.stack([0 * x, 0.25 + 0.6 * y, (stripes > 0.5).astype(float)], -1)
    occlusion = np.stack([0.35 + 0.65 * (0.5 + 0.5 * np.cos(2 * np.pi * 2 * y))] * 3, -1)
    spots = (np.hypot(x % 0.25 - 0.125, y % 0.25 - 0.125) < 0.05).astype(float)
    emissive = np.stack([spots, spots * (0.3 + 0.5 * x), 0.2 * spots], -1)
    holes = np.hypot(x % 0.125 - 0.0625, y % 0.25 - 0.125) * np.array([1.0])
    mask = np.concatenate([0.3 + 0.6 * base, np.clip(holes * 12, 0, 1)[..., None]], -1)
    every = {
        "base": base,
        "normal": normal / 2 + 0.5,
        "metal": metal,
        "occlusion": occlusion,
        "emissive": emissive,
        "mask": mask,
    }
    return {name: np.round(255 * np.clip(a, 0, 1)).astype(np.uint8) for name, a in every.items()}


def transform(
    offset: tuple[float, float],
    rotation: float,
    scale: tuple[float, float],
    uv_set: int | None = None,
) -> dict[str, Any]:
    entry: dict[str, Any] = {"offset": offset, "rotation": rotation, "scale": scale}
    if uv_set is not None:
        entry["texCoord"] = uv_set
    return {"extensions": {"KHR_texture_transform": entry}}


def materials(texture: dict[str, int]) -> list[dict[str, Any]]:
    """One for each name of NAMES, in their order."""

    def plain(color: tuple[float, ...], metallic: float, roughness: float) -> dict[str, Any]:
        return {
            "baseColorFactor": color if len(color) == 4 else (*color, 1.0),
            "metallicFactor": metallic,
            "roughnessFactor": roughness,
        }

    def extended(base: dict[str, Any], **extensions: dict[str, Any]) -> dict[str, Any]:
        named = {f"KHR_materials_{name}": values for name, values in extensions.items()}
        return {"pbrMetallicRoughness": base, "extensions": named}

    even = transform((0.2, 0.1), 0.5, (2.0, 2.0))
    uneven = transform((0.1, 0.3), 0.6, (3.0, 1.5))
    made: list[dict[str, Any]] = [
        {"pbrMetallicRoughness": plain((1.0, 0.78, 0.34), 1, 0.2)},
        {"pbrMetallicRoughness": plain((0.9, 0.9, 0.92), 1, 0.6)},
        {"pbrMetallicRoughness": plain((0.6, 0.05, 0.05), 0, 0.35)},
        {
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": texture["base"], **even},
                **plain((1, 1, 1), 0, 0.7),
            }
        },
        {
            "pbrMetallicRoughness": {
                **plain((0.9, 0.7, 0.5), 1, 1),
                "metallicRoughnessTexture": {"index": texture["metal"], **uneven},
            },
            "normalTexture": {"index": texture["normal"], "scale": 0.8},
        },
        {
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": texture["base"]},
                **plain((0.9, 0.9, 0.9), 0, 0.6),
            },
            "occlusionTexture": {"index": texture["occlusion"], "texCoord": 1, "strength": 0.9},
            # In both places: Filament does not read the texCoord of the extension.
            "emissiveTexture": {
                "index": texture["emissive"],
                "texCoord": 1,
                **transform((0.5, 0.0), 0.0, (2.0, 1.0), 1),
            },
            "emissiveFactor": (0.3, 0.24, 0.18),
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3.0}},
        },
        {"pbrMetallicRoughness": plain((0.9, 0.9, 0.9), 0, 0.5)},
        {
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": texture["mask"]},
                **plain((1, 1, 1), 0, 0.6),
            },
            "alphaMode": "MASK",
            "alphaCutoff": 0.45,
            "doubleSided": True,
        },
        {
            "pbrMetallicRoughness": plain((0.2, 0.5, 0.9, 0.45), 0, 0.4),
            "alphaMode": "BLEND",
        },
        extended(
            plain((0.3, 0.02, 0.03), 0.6, 0.5),
            clearcoat={"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.1},
        ),
        extended(
            plain((0.15, 0.05, 0.2), 0, 0.9),
            sheen={"sheenColorFactor": (0.9, 0.6, 0.8), "sheenRoughnessFactor": 0.4},
        ),
        extended(
            plain((0.6, 0.6, 0.6), 1, 0.25),
            iridescence={
                "iridescenceFactor": 1.0,
                "iridescenceIor": 1.4,
                "iridescenceThicknessMaximum": 420.0,
            },
        ),
        extended(
            plain((0.9, 0.85, 0.8), 1, 0.5),
            anisotropy={"anisotropyStrength": 0.3, "anisotropyRotation": 0.5},
        ),
        extended(
            plain((1, 1, 1), 0, 0.0),
            transmission={"transmissionFactor": 1.0},
            volume={
                "thicknessFactor": 0.15,
                "attenuationDistance": 0.3,
                "attenuationColor": (0.4, 0.9, 0.6),
            },
            ior={"ior": 1.45},
        ),
        extended(
            plain((0.05, 0.15, 0.05), 0, 0.3),
            ior={"ior": 1.8},
            specular={"specularFactor": 0.8, "specularColorFactor": (1.0, 0.8, 0.5)},
        ),
        extended(plain((0.8, 0.4, 0.1), 0, 1), unlit={}),
    ]
    for name, material in zip(NAMES, made, strict=True):
        material["name"] = name
    return made


def about(axis: tuple[float, float, float], degrees: float) -> list[float]:
    """A quaternion (x, y, z, w)."""
    unit = np.asarray(axis, float) / np.linalg.norm(axis)
    half = np.radians(degrees) / 2
    return [*(np.sin(half) * unit).tolist(), float(np.cos(half))]


def towards(direction: tuple[float, float, float]) -> list[float]:
    """The quaternion (x, y, z, w) that turns -Z along a direction."""
    to = np.asarray(direction, float) / np.linalg.norm(direction)
    axis = np.cross([0, 0, -1], to)
    made = np.array([*axis, 1 - to[2]])
    unit: list[float] = (made / np.linalg.norm(made)).tolist()
    return unit


def rows() -> list[dict[str, Any]]:
    """Nodes of the four rows: a translation, a rotation, a mirror, and a matrix that squeezes."""
    up = [STEP * (1.5 - row) for row in range(EDGE)]
    squeeze = np.diag([1.0, 0.85, 1.0, 1.0])
    squeeze[1, 3] = up[3]
    return [
        {"translation": [0, up[0], 0]},
        {"translation": [0, up[1], 0], "rotation": about((0, 0, 1), 180)},
        {"translation": [0, up[2], 0], "scale": [-1, 1, 1]},
        {"matrix": squeeze.T.ravel().tolist()},
    ]


def make_glb() -> bytes:
    """The file."""
    out = Writer()
    out.add("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
    texture = {name: out.texture(pixels) for name, pixels in pictures().items()}
    out.tree["materials"] = materials(texture)

    points, uvs, tangents, triangles = sphere()
    colors = np.concatenate([points / 2 + 0.5, np.ones((len(points), 1))], -1).astype(np.float32)
    whole = {
        "POSITION": out.accessor(points, bounds=True),
        "NORMAL": out.accessor(points),
        "TANGENT": out.accessor(tangents),
        "TEXCOORD_0": out.accessor(uvs),
        "TEXCOORD_1": out.accessor((uvs * [1, 2] + [0.25, 0]).astype(np.float32)),
    }
    colored = {**whole, "COLOR_0": out.accessor(colors)}
    faces = out.accessor(triangles)
    points, uvs, tangents, triangles = sphere(0.9, np.pi)
    bowl = {
        "POSITION": out.accessor(points, bounds=True),
        "NORMAL": out.accessor(points),
        "TANGENT": out.accessor(tangents),
        "TEXCOORD_0": out.accessor(uvs),
    }
    bowl_faces = out.accessor(triangles)
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    panel = {
        "POSITION": out.accessor(corners, bounds=True),
        "NORMAL": out.accessor(np.tile(np.array([0, 0, 1], np.float32), (4, 1))),
        "TEXCOORD_0": out.accessor((corners[:, :2] * [0.5, -0.5] + 0.5).astype(np.float32)),
    }
    panel_faces = out.accessor(np.array([0, 1, 2, 0, 2, 3], np.uint32))

    def mesh(name: str, attributes: dict[str, int], indices: int, material: int) -> int:
        primitive = {"attributes": attributes, "indices": indices, "material": material}
        return out.add("meshes", {"name": name, "primitives": [primitive]})

    backdrop = mesh("backdrop", panel, panel_faces, NAMES.index("base map"))
    row_nodes = []
    for row, (names, entry) in enumerate(zip(TILES, rows(), strict=True)):
        children = []
        for column, name in enumerate(names):
            number = EDGE * row + column
            attributes, indices = (bowl, bowl_faces) if name == "mask" else (whole, faces)
            if name == "vertex colours":
                attributes = colored
            # The row that is turned by 180 degrees and the mirrored one are laid out the other way round.
            across = STEP * (column - 1.5) * (-1 if row in (1, 2) else 1)
            tile = {
                "name": name,
                "mesh": mesh(name, attributes, indices, number),
                "translation": [across, 0, 0],
                "rotation": about((1, 0.3, 0), 25),
                "scale": [0.5, 0.5, 0.5],
            }
            if name in ("blend", "glass"):
                behind = out.add(
                    "nodes",
                    {
                        "name": f"behind {name}",
                        "mesh": backdrop,
                        "translation": [across, 0, -0.7],
                        "scale": [0.62, 0.62, 0.62],
                    },
                )
                children.append(behind)
            children.append(out.add("nodes", tile))
        row_nodes.append(out.add("nodes", {"name": f"row {row}", "children": children, **entry}))

    out.tree["extensions"] = {
        "KHR_lights_punctual": {
            "lights": [
                {"name": "sun", "type": "directional", "color": [1, 0.95, 0.8], "intensity": 2.0},
                {
                    "name": "lamp",
                    "type": "point",
                    "color": [0.5, 0.7, 1],
                    "intensity": 12.0,
                    "range": RANGE,
                },
                {
                    "name": "spot",
                    "type": "spot",
                    "color": [1, 0.6, 0.5],
                    "intensity": 90.0,
                    "range": 4 * RANGE,
                    "spot": {"innerConeAngle": SPOT[0], "outerConeAngle": SPOT[1]},
                },
            ]
        }
    }

    def light(number: int, **entry: Any) -> int:
        found = out.tree["extensions"]["KHR_lights_punctual"]["lights"][number]["name"]
        return out.add(
            "nodes",
            {"name": found, "extensions": {"KHR_lights_punctual": {"light": number}}, **entry},
        )

    lights = [
        light(0, rotation=towards((-0.6, -0.7, -0.5))),
        light(1, translation=[-3.0, -1.0, 3.0]),
        light(2, translation=[2.0, 2.0, 5.0], rotation=towards((-2.5, -2.5, -5.0))),
    ]
    span = EDGE * STEP / 2 / (DISTANCE - 0.25)
    out.add(
        "cameras",
        {
            "type": "perspective",
            "perspective": {
                "yfov": 2 * float(np.arctan(span)),
                "aspectRatio": 1.0,
                "znear": 0.5,
                "zfar": 50.0,
            },
        },
    )
    camera = out.add("nodes", {"name": "camera", "camera": 0, "translation": [0, 0, DISTANCE]})
    turned = np.radians(30)
    matrix = np.array(
        [
            [np.cos(turned), 0, np.sin(turned), 0.5],
            [0, 1, 0, -0.3],
            [-np.sin(turned), 0, np.cos(turned), 0.2],
            [0, 0, 0, 1],
        ]
    )
    root = {
        "name": "root",
        "matrix": matrix.T.ravel().tolist(),
        "children": [*row_nodes, *lights, camera],
    }
    out.tree["scenes"][0]["nodes"] = [out.add("nodes", root)]
    used = {"KHR_lights_punctual", "KHR_texture_transform"}
    for material in out.tree["materials"]:
        used.update(material.get("extensions", {}))
    out.tree["extensionsUsed"] = sorted(used)
    return out.glb()
