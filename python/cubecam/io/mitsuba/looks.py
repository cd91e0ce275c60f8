"""What a material becomes in Mitsuba: a BSDF, the light that it emits, and what its mesh must hold for these."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import Image, Material, Texture
from ..left_out import LeftOut
from .files import Files, Textures, numbers_of
from .geometry import Surface

Array = npt.NDArray[Any]
Json = dict[str, Any]

#: A surface that reflects nothing. Unlike a black ``diffuse``, it is not asked about each lamp.
BLACK: Json = {
    "type": "conductor",
    "material": "none",
    "specular_reflectance": {"type": "rgb", "value": [0.0, 0.0, 0.0]},
}

#: How many texels the colours of a mesh's triangles may take, and along an edge of one patch.
_PATCH_TEXELS = 4e6
_FINEST_PATCH = 16


@dataclass
class Look:
    """How one mesh looks with one material."""

    surface: Surface
    bsdf: Json = field(default_factory=lambda: BLACK)
    radiance: Json | None = None
    """What the surface emits from its front, on which it is seen; None: nothing."""
    uvs: Array | None = None
    colors: Array | None = None
    """(V, 3): the attribute ``vertex_color``."""
    both_sides: bool = False
    """Whether a second mesh behind this one must show its back, since Mitsuba's surfaces emit only from their front."""
    inside: Json | None = None
    """The medium within the surface."""


class Painter:
    """Makes the textures of one material on one mesh."""

    def __init__(
        self, surface: Surface, material: Material, files: Files, left_out: LeftOut, name: str
    ) -> None:
        self.look = Look(surface)
        self.material = material
        self.left_out = left_out
        self.name = name
        self._files = files
        self._textures = Textures(files, left_out)
        self._place: tuple[int, bytes] | None = None

    def tell(self, reason: str) -> None:
        """Note what Mitsuba does not show of this material."""
        self.left_out.add(reason, self.name)

    def image_of(self, value: Any) -> Image | None:
        """Return the picture of a map if Mitsuba can show it on this mesh, and place the mesh's uvs for it."""
        if value is None:
            return None
        place = value if isinstance(value, Texture) else None
        source = value if place is None else place.source
        uv_set = 0 if place is None else place.uv_set
        uvs = self.look.surface.uvs1 if uv_set else self.look.surface.uvs
        if uvs is None:
            return None  # as on screen: without uvs there is no map
        if not isinstance(source, Image):
            self.tell("a render texture has no picture without a renderer: the map is left out")
            return None
        matrix = np.eye(3) if place is None else np.asarray(place.matrix, float)
        wanted = (uv_set, matrix.tobytes())
        if self._place not in (None, wanted):
            self.tell("maps of one material that are placed differently lie as the first one")
            return source
        if self._place is None:
            self._place = wanted
            moved = np.c_[uvs, np.ones(len(uvs))] @ matrix[:2].T
            self.look.uvs = moved.astype(np.float32)
        return source

    def color(
        self, factor: Array, image: Image | None, *, decoded: bool, vertices: bool = False
    ) -> Json:
        """Return what is reflected: a colour (3,) times a map times the mesh's colours."""
        colors = self.look.surface.colors if vertices else None
        if image is not None:
            if colors is not None:
                self.tell("vertex colours are left out where there is a map")
            return self._textures.color(image, factor, decoded=decoded)
        if colors is not None:
            self.look.colors = colors[:, :3] * factor.astype(np.float32)
            return {"type": "mesh_attribute", "name": "vertex_color"}
        return constant(factor)

    def emitted(
        self, factor: Array, image: Image | None, *, decoded: bool, vertices: bool, blended: bool
    ) -> Json | None:
        """Return what is emitted: a colour (3,) times a map times the mesh's colours, times alpha if `blended`.

        None if that is nothing anywhere: a lamp of Mitsuba whose picture is black gives NaN.
        """
        colors = self.look.surface.colors if vertices else None
        if image is not None:
            if colors is not None:
                self.tell("vertex colours are left out where there is a map")
            pixels = numbers_of(image, decoded)
            light = pixels[..., :3] * factor
            if blended and pixels.shape[2] == 4:
                light = light * pixels[..., 3:]
                return (
                    {**self._textures.values(image, light), "raw": False} if light.any() else None
                )
            return self._textures.color(image, factor, decoded=decoded) if light.any() else None
        if colors is not None:
            light = colors[:, :3] * factor
            if blended:
                light = light * colors[:, 3:]
            return self._patches(light) if light.any() else None
        return {"type": "rgb", "value": factor.tolist()} if factor.any() else None

    def numbers(self, factor: float, image: Image | None, channel: int) -> Json | float:
        """Return a number times one channel of a map."""
        if image is None:
            return float(factor)
        return self._textures.values(image, channel_of(image, channel) * np.float32(factor))

    def values(self, image: Image, pixels: Array) -> Json:
        """Return a map of numbers made from those of an image."""
        return self._textures.values(image, pixels)

    def _patches(self, light: Array) -> Json:
        """Return the light of a mesh's vertices, (V, 3), as a picture with a square patch of texels for each triangle.

        Mitsuba 3.9 ends the process where a lamp's radiance is a ``mesh_attribute`` that is sampled. The corners of a
        triangle lie in the middles of three corner texels of its patch; the texels of the other half continue its
        plane, so that bilinear lookups in the triangle are linear. Where that plane falls below 0, which no lamp can
        have, more texels make the error small.
        """
        surface = self.look.surface
        a, b, c = (light[surface.triangles[:, k]] for k in range(3))
        count = len(a)
        n = (
            2
            if (b + c >= a).all()
            else int(np.clip((_PATCH_TEXELS / count) ** 0.5, 2, _FINEST_PATCH))
        )
        across = math.ceil(count**0.5)
        down = -(-count // across)
        at = np.arange(n) / (n - 1)
        part = [x[:, None, None, :] for x in (a, b - a, c - a)]
        patches = part[0] + at[:, None] * part[1] + at[:, None, None] * part[2]
        pixels = np.zeros((down * across, n, n, 3), np.float32)
        pixels[:count] = np.maximum(patches, 0)
        pixels = pixels.reshape(down, across, n, n, 3).transpose(0, 2, 1, 3, 4)
        pixels = pixels.reshape(n * down, n * across, 3)
        row, column = np.divmod(np.arange(count), across)
        right = np.repeat(n * column, 3) + np.tile([0, n - 1, 0], count)
        below = np.repeat(n * row, 3) + np.tile([0, 0, n - 1], count)
        uvs = np.c_[(right + 0.5) / (n * across), 1 - (below + 0.5) / (n * down)]
        corners = surface.triangles.reshape(-1)
        self.look.surface = replace(
            surface,
            positions=surface.positions[corners],
            normals=surface.normals[corners],
            triangles=np.arange(len(corners), dtype=np.int32).reshape(-1, 3),
            uvs=None,
            uvs1=None,
            colors=None,
        )
        self.look.uvs = uvs.astype(np.float32)
        return {
            "type": "bitmap",
            "filename": self._files.picture(pixels),
            "raw": False,
            "wrap_mode": "clamp",
            "format": "variant",
        }


def constant(color: Array) -> Json:
    """Return a colour (3,) that a surface reflects; Mitsuba's ``rgb`` ends at 1."""
    if (color <= 1).all():
        return {"type": "rgb", "value": color.tolist()}
    return {"type": "rawconstant", "value": color.tolist()}


def channel_of(image: Image, channel: int) -> Array:
    """Return one channel (H, W, 1) of an image as float32: 0 to 2 are red to blue, 3 is alpha, 1 if there is none."""
    pixels = numbers_of(image, decoded=False)
    if channel == 3 and pixels.shape[2] == 3:
        return np.ones_like(pixels[..., :1])
    return pixels[..., channel : channel + 1]


def with_bump(bsdf: Json, painter: Painter, image: Image, scale: float) -> Json:
    """Return a BSDF whose normals a map turns; `scale` is the factor of the normals' x and y."""
    pixels = numbers_of(image, decoded=False)[..., :3] * 2 - 1
    pixels = pixels * np.array([scale, scale, 1], np.float32)
    return {
        "type": "normalmap",
        "normalmap": painter.values(image, (pixels + 1) / 2),
        "bsdf": bsdf,
    }


def seen_through(bsdf: Json, opacity: Json | float) -> Json:
    """Return a BSDF of which a share is there; the rest lets all light pass."""
    if opacity == 1.0:
        return bsdf
    return {"type": "mask", "opacity": opacity, "bsdf": bsdf}


def turned(painter: Painter, bsdf: Json) -> Json:
    """Return a BSDF that also works on the back of a surface, if its material is double-sided."""
    return {"type": "twosided", "bsdf": bsdf} if painter.material.double_sided else bsdf


def show_back(painter: Painter, is_solid: bool) -> None:
    """Let a second mesh show the back of a double-sided surface that emits light."""
    if not painter.material.double_sided:
        return
    if is_solid:
        painter.look.both_sides = True
    else:
        painter.tell("a translucent surface that emits light shows its front only")
