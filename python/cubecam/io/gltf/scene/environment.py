"""EXT_lights_image_based: a cubemap of what lies around the scene.

The largest images are the environment. cubecam makes the levels by roughness and the diffuse light from these, so that
the smaller images and the coefficients of a file are not needed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...._core import CubeMap, FileError, Scene
from ...left_out import LeftOut
from ...pixels import srgb_decode
from ..document import Gltf
from ..entries import Entry
from .textures import Textures
from .values import Values, at

EXTENSION = "EXT_lights_image_based"
#: Babylon.js, for whose files the extension was made, decodes RGBD with this exponent.
_GAMMA = np.float32(2.2)


def add_environment(document: Gltf, scene: Scene, textures: Textures, left_out: LeftOut) -> None:
    """Give a scene the environment that the document's scene refers to."""
    if not document.count("scenes"):
        return
    number = document.tree.index("scene", document.count("scenes")) or 0
    reference = document.entry("scenes", number).extension(EXTENSION)
    if reference is None:
        return
    root = document.tree.extension(EXTENSION) or Entry(f"extensions.{EXTENSION}", {})
    index = reference.index("light", len(root.entries("lights")))
    if index is None:
        raise reference.error("light", "the index of a light")
    light = root.member("lights", index)
    values = Values(light, left_out)
    levels = light.entries("specularImages")
    if not levels or not isinstance(levels[0], list) or len(levels[0]) != 6:
        raise light.error("specularImages", "a list of levels of 6 images each")
    numbers = Entry(light.path("specularImages[0]"), {"faces": levels[0]}).indices(
        "faces", document.count("images")
    )
    try:
        faces = [_radiance(face) for face in textures.pictures_of(numbers)]
    except FileError as error:
        left_out.add(f"the environment is left out: {error}", light.where)
        return
    x, y, z, w = values.numbers("rotation", (0.0, 0.0, 0.0, 1.0))
    with at(light):
        # "Each saved image must be flipped about its vertical axis": a lookup in the images as they are needs a
        # direction with -x, and that is the convention of three.js and Babylon.js.
        scene.environment = CubeMap(faces, convention="three", encoding="linear")
        scene.environment_intensity = values.number("intensity", 1.0, 0)
        scene.environment_rotation = (w, x, y, z)


def _radiance(pixels: npt.NDArray[Any]) -> npt.NDArray[np.float16]:
    """Decode a face: four channels are RGBD, colours to be divided by the fourth; three are sRGB."""
    full = np.iinfo(pixels.dtype).max if pixels.dtype.kind == "u" else 1
    values = pixels.astype(np.float32) / np.float32(full)
    if pixels.shape[2] == 4:
        color = values[..., :3] ** _GAMMA / np.maximum(values[..., 3:], np.float32(1 / 255))
    else:
        color = srgb_decode(values) if pixels.dtype.kind == "u" else values
    result: npt.NDArray[np.float16] = np.minimum(color, np.float32(65504)).astype(np.float16)
    return result
