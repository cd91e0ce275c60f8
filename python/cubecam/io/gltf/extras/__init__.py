"""What cubecam wrote into `extras` of a glTF file, because glTF has no words for it; `write/` is the other direction.

The loader makes a scene of what every program reads. `Extras` then gives it what is cubecam's own: other kinds of
materials, labels, shadows, environments, probes. `classes.py` is the table of all classes and properties, `values.py`
reads values, `apply.py` sets them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ...._core import Image, Material, MeshError, Scene, StandardMaterial
from ...._warnings import SceneWarning, warn_user
from ..document import Gltf
from ..entries import Entry
from .apply import Application
from .classes import FORMAT, KEY, PLANS, blank, materials
from .values import Parts, Reader, made_of

__all__ = ["Extras"]


class Extras:
    """The extras of a document. It is false, and changes nothing, if the file has none of cubecam.

    Raises
    ------
    MeshError
        For extras that cubecam did not write: it names the place, what was expected and what is there.
    """

    def __init__(self, document: Gltf) -> None:
        self._document = document
        root = _own(document.tree)
        number = FORMAT if root is None else root.integer("format")
        self._active = root is not None and number == FORMAT
        if number != FORMAT:
            warn_user(
                f"{document.path}: extras of cubecam of format {number}, expected {FORMAT}, are left out",
                SceneWarning,
            )
        objects = root.entries("objects") if root is not None and self._active else []
        self._reader = Reader(document, objects, f"extras.{KEY}.objects")

    def __bool__(self) -> bool:
        """Say whether the file has extras of cubecam."""
        return self._active

    def entry(self, kind: str, index: int) -> Entry | None:
        """Return the extras of an entry."""
        return _own(self._document.entry(kind, index)) if self._active else None

    def image(self, index: int, pixels: npt.NDArray[Any] | None = None) -> Image | None:
        """Return the image of a texture whose pixels stand in its extras, or that has `pixels` in its file.

        Without `pixels`, an image whose extras have no pixels is None; with them, one without extras is.
        """
        found = self.entry("textures", index)
        if found is None:
            return None
        plan = PLANS["Image"]
        if found.text("class") != "Image":
            raise found.error("class", '"Image"')
        self._reader.check_names(found, ("class", *plan.names))
        if "pixels" not in found and pixels is None:
            return None
        arguments = {
            name: self._reader.value(found.raw[name], found.path(name))
            for name in plan.made
            if name in found
        }
        if isinstance(arguments.get("pixels"), list):
            arguments["pixels"] = _floats(arguments["pixels"], found)
        image: Image = made_of(Image, {"pixels": pixels, **arguments}, found.where)
        return image

    def material(self, index: int, made: StandardMaterial) -> Material:
        """Return an empty material of the kind that an entry's extras name, or `made`; `finish` sets its properties."""
        found = self.entry("materials", index)
        if found is None or "class" not in found:
            return made
        kind = materials().get(found.text("class") or "")
        if kind is None:
            raise found.error("class", f"one of {', '.join(materials())}")
        try:
            result: Material = blank(kind, found.text("fragment") or "")
        except ValueError as error:
            raise MeshError(f"{found.path('fragment')}: {error}") from None
        return result

    def finish(self, scene: Scene, parts: Parts) -> None:
        """Give a scene, made of the rest of the file, everything that stands in extras."""
        if not self._active:
            return
        self._reader.scene, self._reader.parts = scene, parts
        try:
            Application(self._document, self._reader, scene, parts, self.entry).apply()
        except RecursionError:
            raise MeshError(
                f"extras.{KEY}: expected objects of moderate depth, got objects too deep to read"
            ) from None


def _own(entry: Entry) -> Entry | None:
    """Return what stands in an entry's extras under cubecam's key; extras may be any JSON."""
    extras = entry.raw.get("extras")
    if not isinstance(extras, dict) or KEY not in extras:
        return None
    return Entry(entry.path("extras"), extras).needed(KEY)


def _floats(pixels: list[Any], entry: Entry) -> npt.NDArray[Any]:
    try:
        return np.array(pixels, np.float32)
    except (ValueError, TypeError, OverflowError):
        raise entry.error("pixels", "rows of pixels") from None
