"""Materials of any kind: an entry that every program reads, and in its extras what only cubecam has."""

from __future__ import annotations

from typing import Any

from ...._core import Image, Material, ShaderMaterial, StandardMaterial, Texture
from ..extras.classes import KEY, blank, material_names, materials
from .document import Document, Json
from .looks import similar
from .pictures import Pictures
from .standard import StandardWriter, map_names, plain
from .values import Values


class Materials:
    """The materials of a document."""

    def __init__(self, document: Document, pictures: Pictures) -> None:
        self._document = document
        self._standard = StandardWriter(document, pictures)
        self._known: dict[int, tuple[Material, int]] = {}
        self._plain: dict[int, StandardMaterial] = {}

    def index(self, material: Material) -> int:
        """Return the index of a material."""
        if id(material) not in self._known:
            shown = plain(similar(material), self._is_translucent)
            entry: Json = {"name": material.name} if material.name else {}
            entry |= self._standard.entry(shown)
            index = self._document.add("materials", entry)
            self._known[id(material)] = (material, index)
            self._plain[id(material)] = shown
        return self._known[id(material)][1]

    def uv_sets(self, material: Material) -> set[int]:
        """Return the sets of texture coordinates that the entry of a material looks up."""
        self.index(material)
        shown = self._plain[id(material)]
        maps = [getattr(shown, name) for name in map_names()]
        return {m.uv_set if isinstance(m, Texture) else 0 for m in maps if m is not None}

    def shows_colors(self, material: Material) -> bool:
        """Say whether a material shows the colours of vertices; glTF always multiplies by those of a mesh."""
        if isinstance(material, ShaderMaterial):
            return True
        return bool(getattr(material, "vertex_colors", False))

    def finish(self, values: Values) -> None:
        """Write what glTF cannot say of each material."""
        done = 0
        while done < len(self._known):  # properties may lead to further materials
            material, index = list(self._known.values())[done]
            extras = self._extras(material, values)
            if extras:
                self._document.lists["materials"][index]["extras"] = {KEY: extras}
            done += 1

    def _extras(self, material: Material, values: Values) -> Json:
        kind: Any = kind_of(material)
        names = [name for name in material_names(kind) if name != "name"]
        if kind is StandardMaterial:
            return values.changed(material, self._plain[id(material)], names)
        base: Any = blank(kind, getattr(material, "fragment", ""))
        found = {"class": kind.__name__, **values.changed(material, base, names)}
        if kind is ShaderMaterial:
            found["fragment"] = material.fragment  # type: ignore[attr-defined]
        return found

    @staticmethod
    def _is_translucent(material: StandardMaterial) -> bool:
        """Say whether a material without an alpha mode blends: by its alpha or by the picture of its colours."""
        if material.opacity < 1 or material.color[3] < 1:
            return True
        source: Any = material.map.source if isinstance(material.map, Texture) else material.map
        if not isinstance(source, Image) or source.channels < 4:
            return False
        one = 255 if source.dtype.kind == "u" else 1
        return bool((source.pixels[..., 3] < one).any())


def kind_of(material: Material) -> type[Any]:
    """Return the class of cubecam that a material is of."""
    return next(k for k in type(material).__mro__ if materials().get(k.__name__) is k)
