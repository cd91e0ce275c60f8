"""Textures: pictures with samplers (section 3.8 of glTF 2.0) and KHR_texture_transform."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, cast

from ...._core import FileError, Image, MeshError, Texture
from ....typing import MagFilter, MinFilter, Wrap
from ...left_out import LeftOut
from ...model_pictures import Key, ModelPictures, numbers_for
from ..document import Gltf
from ..entries import Entry
from ..extras import Extras
from ..references import read_uri
from .values import Values

#: Extensions of a texture that name another picture, the one to be preferred first.
SOURCES = ("KHR_texture_basisu", "EXT_texture_webp", "MSFT_texture_dds")

_WRAPS: dict[int, Wrap] = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
_MAG_FILTERS: dict[int, MagFilter] = {9728: "nearest", 9729: "linear"}
_MIN_FILTERS: dict[int, MinFilter] = {
    9728: "nearest",
    9729: "linear",
    9984: "nearest_mipmap_nearest",
    9985: "linear_mipmap_nearest",
    9986: "nearest_mipmap_linear",
    9987: "linear_mipmap_linear",
}
#: The maps of colours, whose numbers are sRGB.
_COLORS = frozenset(
    {
        "baseColorTexture",
        "diffuseTexture",
        "emissiveTexture",
        "sheenColorTexture",
        "specularColorTexture",
        "specularGlossinessTexture",
    }
)


class Textures:
    """The textures of a document.

    A picture that several textures show with equal samplers is one `Image`. `sets` says which of the document's
    texture coordinates are the first and second ones of a mesh.
    """

    def __init__(self, document: Gltf, extras: Extras, left_out: LeftOut) -> None:
        self.document = document
        self.left_out = left_out
        self.pictures = ModelPictures(self._source)
        self.sets: dict[int, int] = {0: 0, 1: 1}
        self._extras = extras
        #: What cubecam wrote beside some textures: images that need no picture.
        self._given: dict[int, Image] = {}
        self._colors: set[tuple[Key, ...]] = set()
        self._images: dict[tuple[Any, ...], Image] = {}

    def prepare(self, materials: list[Entry]) -> None:
        """Decode all pictures of some materials, and find out what they are used for."""
        keys: list[Key] = []
        used: set[int] = set()
        for name, info in _infos(materials):
            used.add(self._set_of(info))
            index = info.index("index", self.document.count("textures"))
            if index is None or self._own(index) is not None:
                continue
            source = self._picture_of(self.document.entry("textures", index))
            if source is None:
                continue
            keys.append(source)
            if name in _COLORS:
                self._colors.add((source, self._sampler(index)))
        self.pictures.prefetch(keys)
        if not used <= {0, 1} and len(used) <= 2:
            self.sets = {number: place for place, number in enumerate(sorted(used))}

    def slot(self, entry: Entry | None, name: str) -> Texture | Image | None:
        """Read a map of a material, the object `name` of an entry; None if there is none, or none that can be read."""
        info = None if entry is None else entry.entry(name)
        if info is None:
            return None
        index = info.index("index", self.document.count("textures"))
        if index is None:
            raise info.error("index", "the index of a texture")
        image = self.image(index, info.path("index"))
        return None if image is None else self._placed(image, info)

    def image(self, index: int, place: str = "") -> Image | None:
        """Return the picture of a texture with its sampler; None if it cannot be read, which is noted."""
        given = self._own(index)
        if given is not None:
            return given
        texture = self.document.entry("textures", index)
        key = self._picture_of(texture)
        if key is None:
            self.left_out.add("a texture without a picture is left out", texture.where)
            return None
        sampler = self._sampler(index)
        color = (key, sampler) in self._colors
        try:
            pixels = self.pictures.pixels(key)
        except FileError as error:
            for name in SOURCES:
                if name in self.document.required and texture.extension(name) is not None:
                    raise MeshError(
                        f"{texture.where}: {name}, which is required: {error}"
                    ) from None
            self.left_out.add(f"a picture is left out: {error}", texture.where)
            return None
        written = self._extras.image(index, pixels)
        if written is not None:
            self._given[index] = written
            return written
        # Two textures of equal picture and sampler are one image.
        found = self._images.get((key, sampler))
        if found is None:
            wrap, mag, small = sampler
            try:
                found = Image(
                    numbers_for(pixels, color=color),
                    wrap=wrap,
                    mag_filter=mag,
                    min_filter=small,
                    encoding="srgb" if color and pixels.dtype == "uint8" else "linear",
                )
            except ValueError as error:
                self.left_out.add(f"a picture is left out: {error}", texture.where)
                return None
            self._images[key, sampler] = found
        return found

    def pictures_of(self, images: list[int]) -> list[Any]:
        """Return the pixels of images, decoded at the same time; `FileError` if one of them cannot be read."""
        keys = [self._key(number) for number in images]
        self.pictures.prefetch(keys)
        return [self.pictures.pixels(key) for key in keys]

    def like(self, placed: Texture | Image, pixels: Any) -> Texture | Image:
        """Put other pixels, linear ones, in the place of a map's own."""
        old = cast(Image, placed.source if isinstance(placed, Texture) else placed)
        image = Image(
            pixels,
            wrap=old.wrap,
            mag_filter=old.mag_filter,
            min_filter=old.min_filter,
            encoding="linear",
        )
        if not isinstance(placed, Texture):
            return image
        return Texture(
            image,
            uv_set=placed.uv_set,
            offset=placed.offset,
            rotation=placed.rotation,
            scale=placed.scale,
        )

    def _own(self, index: int) -> Image | None:
        if index not in self._given:
            image = self._extras.image(index)
            if image is None:
                return None
            self._given[index] = image
        return self._given[index]

    def _placed(self, image: Image, info: Entry) -> Texture | Image:
        """Read where a map lies: its set of texture coordinates, and KHR_texture_transform."""
        number = self._set_of(info)
        if number not in self.sets:
            self.left_out.add(
                "more than two sets of texture coordinates are used, so that some maps lie by the first one",
                info.where,
            )
        uv_set = self.sets.get(number, 0)
        transform = info.extension("KHR_texture_transform")
        values = Values(transform, self.left_out)
        x, y = values.numbers("offset", (0.0, 0.0))
        sx, sy = values.numbers("scale", (1.0, 1.0))
        turn = values.number("rotation", 0.0)
        if not uv_set and (x, y, sx, sy, turn) == (0, 0, 1, 1, 0):
            return image
        # The file's v counts from the top, v' = 1 - v. Its T R S is u' = x + cos sx u + sin sy v, v' = y - sin sx u +
        # cos sy v; both sides written with 1 - v give the same rotation and scale with another offset.
        offset = (x + math.sin(turn) * sy, 1 - y - math.cos(turn) * sy)
        return Texture(
            image, uv_set=uv_set, offset=offset, rotation=math.degrees(turn), scale=(sx, sy)
        )

    @staticmethod
    def _set_of(info: Entry) -> int:
        transform = info.extension("KHR_texture_transform")
        if transform is not None and "texCoord" in transform:
            return transform.integer("texCoord")
        return info.integer("texCoord", 0)

    def _sampler(self, index: int) -> tuple[Wrap | tuple[Wrap, Wrap], MagFilter, MinFilter]:
        texture = self.document.entry("textures", index)
        number = texture.index("sampler", self.document.count("samplers"))
        sampler = Entry("", {}) if number is None else self.document.entry("samplers", number)
        u = _of(_WRAPS, sampler, "wrapS", "repeat")
        v = _of(_WRAPS, sampler, "wrapT", "repeat")
        mag = _of(_MAG_FILTERS, sampler, "magFilter", "linear")
        # A file that leaves the choice gets what shows no noise where a texture is small.
        small = _of(_MIN_FILTERS, sampler, "minFilter", "linear_mipmap_linear")
        return (u if u == v else (u, v)), mag, small

    def _picture_of(self, texture: Entry) -> Key | None:
        """Find the picture of a texture: the first one of an extension that can be read, else the texture's own."""
        document = self.document
        count = document.count("images")
        choices = []
        for name in SOURCES:
            entry = texture.extension(name)
            number = None if entry is None else entry.index("source", count)
            if number is not None:
                choices.append(number)
        plain = texture.index("source", count)
        if plain is not None:
            # A picture that every reader knows is the safe choice, unless the extension's is one of ours.
            choices.append(plain)
        for number in choices:
            key = self._key(number)
            if len(choices) == 1 or self._reads(key):
                return key
        return self._key(choices[0]) if choices else None

    def _reads(self, key: Key) -> bool:
        try:
            self.pictures.pixels(key)
        except MeshError:
            raise
        except FileError:
            return False
        return True

    def _key(self, number: int) -> Key:
        """Name the bytes of an image: two images may show the same ones."""
        image = self.document.entry("images", number)
        view = image.index("bufferView", self.document.count("bufferViews"))
        if view is not None:
            return ("view", view)
        uri = image.text("uri")
        if uri is None:
            raise image.error("uri", "a URI or a bufferView")
        return ("uri", uri)

    def _source(self, key: Key) -> bytes:
        kind, name = cast("tuple[str, Any]", key)
        if kind == "view":
            return bytes(self.document.view(name).data)
        return read_uri(name, self.document.path.parent)


def _of(table: dict[int, Any], entry: Entry, key: str, default: Any) -> Any:
    if key not in entry:
        return default
    value = entry.raw[key]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or value not in table:
        raise entry.error(key, f"one of {', '.join(map(str, table))}")
    return table[int(value)]


def _infos(materials: list[Entry]) -> Iterator[tuple[str, Entry]]:
    """Find all maps of materials, those of extensions included, with the names that they have there."""
    left: list[tuple[str, Entry]] = [("", material) for material in reversed(materials)]
    while left:
        name, entry = left.pop()
        if name.endswith("Texture") and "index" in entry:
            yield name, entry
            continue
        for key, value in entry.raw.items():
            if isinstance(value, dict) and key != "extras":
                left.append((key, Entry(entry.path(key), value)))
