"""What a file of cubecam says about itself: layout, convention, centre, face, levels, channels.

The text stands in the description of the file: the attribute `comments` of EXR, the text `Description` of PNG, the tag
`ImageDescription` of TIFF and JPEG. OpenImageIO names all of them `ImageDescription`. In KTX2 it is the value of the
key "cubecam", in DDS it stands in the reserved bytes of the header.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from .._warnings import ConventionWarning, warn_user
from .cubemap_names import CENTERS, CONVENTIONS, FACE_NAMES, LAYOUTS

Name = TypeVar("Name")

ATTRIBUTE = "ImageDescription"
#: The key of a KTX2 file.
KTX_KEY = "cubecam"
_KNOWN: dict[str, tuple[str, ...]] = {
    "layout": LAYOUTS,
    "convention": CONVENTIONS,
    "center": CENTERS,
    "face": FACE_NAMES[0],
    # The smaller levels are filtered light: level k of L has the roughness k / (L - 1).
    "levels": ("roughness",),
    # The fourth channel was added when the file was written.
    "channels": ("3",),
}
_TEXT = re.compile(r"^cubecam: (\w+=[^, ]+(?:, \w+=[^, ]+)*)\s*$")
#: The header of a DDS file has room for the values alone; no two fields share one.
_SHORT = re.compile(r"^cubecam:(\w+(?:,\w+)*)$")


@dataclass(frozen=True)
class StoredAs:
    """How the texels of a file are stored; None where the file does not say it."""

    layout: Any = None
    convention: Any = None
    center: Any = None
    face: Any = None
    levels: Any = None
    channels: Any = None

    def attributes(self) -> dict[str, str]:
        """Give the attribute that OpenImageIO writes."""
        return {ATTRIBUTE: self.text()}

    def text(self) -> str:
        """Give the remark."""
        named = [(field.name, getattr(self, field.name)) for field in fields(self)]
        told = ", ".join(f"{name}={value}" for name, value in named if value is not None)
        return f"cubecam: {told}"

    def short_text(self) -> str:
        """Give the values without the names, for a remark of at most 44 characters."""
        values = [getattr(self, field.name) for field in fields(self)]
        return "cubecam:" + ",".join(value for value in values if value is not None)

    @staticmethod
    def read(attributes: Mapping[str, Any]) -> StoredAs:
        """Read what `attributes` wrote; other texts and unknown words say nothing."""
        told = str(attributes.get(ATTRIBUTE, ""))
        short = _SHORT.match(told)
        if short:
            words = short[1].split(",")
            places = {value: name for name, values in _KNOWN.items() for value in values}
            return StoredAs(**{places[word]: word for word in words if word in places})
        match = _TEXT.match(told)
        if not match:
            return StoredAs()
        pairs = (pair.split("=", 1) for pair in match[1].split(", "))
        known = {name: value for name, value in pairs if value in _KNOWN.get(name, ())}
        return StoredAs(**known)


def stored_files(
    six: Sequence[object] | None, layout: str | None, convention: str, center: str
) -> list[StoredAs]:
    """Say what each of the files holds that a cubemap is written to: six of them, or one."""
    if six is not None:
        return [StoredAs("faces", convention.lower(), face=name) for name in FACE_NAMES[0]]
    if layout == "equirect":  # a panorama has no faces, and so no convention
        return [StoredAs(layout, center=center.lower())]
    return [StoredAs(layout or "cross", convention.lower())]


def chosen(what: str, given: Name | None, stated: Name | None, file: object) -> Name | None:
    """Return the caller's name, or else the file's; warn if they differ."""
    if given is None or stated is None:
        return stated if given is None else given
    if str(given).lower() != stated:
        warn_user(
            f"{file}: cubecam wrote this file with {what}={stated!r}, and it is read with {what}={given!r}",
            ConventionWarning,
        )
    return given
