"""Pictures and glTF files of whole scenes for tests."""

import io
from typing import Any

import numpy as np
from PIL import Image

from tests.gltf_files import SQUARE, GltfFile

SQUARE_UVS = SQUARE[:, :2].copy()
TWO_TRIANGLES = np.array([0, 1, 2, 0, 2, 3], np.uint8)


def f32(values):
    return np.array(values, np.float32)


def u8(values):
    return np.array(values, np.uint8)


def material_of(scene, place=0):
    """The material of a node, whose class the types of the package do not know."""
    found: Any = scene.nodes[place].material
    return found


def picture(pixels, kind="PNG", **options):
    """The bytes of a picture file of uint8 pixels."""
    data = io.BytesIO()
    pixels = np.asarray(pixels)
    Image.fromarray(pixels[..., 0] if pixels.shape[2] == 1 else pixels).save(data, kind, **options)
    return data.getvalue()


def noise(width, height, channels=3, seed=1):
    return np.random.default_rng(seed).integers(0, 256, (height, width, channels), np.uint8)


class SceneFile(GltfFile):
    """A glTF file with materials and textures."""

    def image(self, pixels, kind="PNG"):
        data = pixels if isinstance(pixels, bytes) else picture(pixels, kind)
        return self.add(
            "images", {"bufferView": self.view(data), "mimeType": f"image/{kind.lower()}"}
        )

    def texture(self, pixels, sampler=None):
        entry = {"source": pixels if isinstance(pixels, int) else self.image(pixels)}
        if sampler is not None:
            entry["sampler"] = self.add("samplers", sampler)
        return self.add("textures", entry)

    def square(self, material=None, **attributes):
        """A square in the xy plane, facing +z, with texture coordinates that have (0, 0) at x, y = (0, 0)."""
        given = {"TEXCOORD_0": SQUARE_UVS, "NORMAL": np.tile(f32([0, 0, 1]), (4, 1))}
        primitive = self.primitive(SQUARE, TWO_TRIANGLES, **{**given, **attributes})
        if material is not None:
            primitive["material"] = (
                material if isinstance(material, int) else self.add("materials", material)
            )
        return primitive

    def use(self, name, entry=None, *, required=False):
        """Name an extension, with what the root says about it."""
        self.tree.setdefault("extensionsUsed", []).append(name)
        if required:
            self.tree.setdefault("extensionsRequired", []).append(name)
        if entry is not None:
            self.tree.setdefault("extensions", {})[name] = entry
