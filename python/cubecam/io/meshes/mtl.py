"""MTL files: the materials of Wavefront OBJ, by appendix B5 of the manual and the words that PBR exporters add.

`parsed` reads the text. Nothing is opened here; `mtl_materials.py` makes materials of it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from .obj_text import readable

#: How many words follow an option of a map; the numbers of -o, -s and -t may be one to three.
_FLAGS = {"-blendu", "-blendv", "-cc", "-clamp", "-imfchan", "-texres", "-type", "-bm", "-boost"}
_VECTORS = {"-o", "-s", "-t"}
_PAIRS = {"-mm"}

#: The words that may start with a capital or not, as programs write them.
_MAPS = {
    "map_ka": "map_Ka",
    "map_kd": "map_Kd",
    "map_ks": "map_Ks",
    "map_ke": "map_Ke",
    "map_ns": "map_Ns",
    "map_d": "map_d",
    "map_bump": "map_Bump",
    "bump": "map_Bump",
    "norm": "norm",
    "map_kn": "norm",
    "map_pr": "map_Pr",
    "map_pm": "map_Pm",
    "map_ps": "map_Ps",
    "map_tr": "map_Tr",
    "refl": "refl",
    "map_refl": "refl",
    "disp": "disp",
    "decal": "decal",
}


@dataclass(frozen=True)
class MapLine:
    """A picture: the name of its file, and where it lies: looked up at offset + scale * (u, v)."""

    file: str
    offset: tuple[float, float] = (0.0, 0.0)
    scale: tuple[float, float] = (1.0, 1.0)
    clamp: bool = False
    #: The factor of bumps.
    strength: float = 1.0


@dataclass
class Mtl:
    """A material: `numbers` by their words, and `maps` by the words of `_MAPS`."""

    name: str
    numbers: dict[str, list[float]] = field(default_factory=dict)
    maps: dict[str, MapLine] = field(default_factory=dict)

    def color(self, word: str) -> tuple[float, float, float] | None:
        """Return a colour; one number stands for grey."""
        values = self.numbers.get(word)
        if not values:
            return None
        red, green, blue = values[:3] if len(values) >= 3 else [values[0]] * 3
        return red, green, blue

    def number(self, word: str) -> float | None:
        values = self.numbers.get(word)
        return values[0] if values else None


def parsed(data: bytes) -> dict[str, Mtl]:
    """Read the materials of a file by name; the first one of a name counts. What is not known is skipped."""
    found: dict[str, Mtl] = {}
    now: Mtl | None = None
    for raw in readable(data).decode("utf-8", "replace").split("\n"):
        line = raw.split(" #")[0].strip()
        word, _, rest = line.partition(" ")
        rest = rest.strip()
        if word.lower() == "newmtl":
            now = Mtl(rest)
            found.setdefault(rest, now)
        elif now is None or not rest or word.startswith("#"):
            continue
        elif word.lower() in _MAPS:
            line_of_map = _map(rest)
            if line_of_map is not None:
                now.maps.setdefault(_MAPS[word.lower()], line_of_map)
        else:
            numbers = _numbers(rest.split())
            if numbers:
                now.numbers.setdefault(word.lower(), numbers)
    return found


def _numbers(words: list[str]) -> list[float]:
    """Read finite numbers up to the first word that is none."""
    result = []
    for word in words:
        try:
            value = float(word)
        except ValueError:
            break
        if not math.isfinite(value):
            break
        result.append(value)
    return result


def _map(rest: str) -> MapLine | None:
    """Read the options of a map, and the name of its file, which may have blanks."""
    words = rest.split()
    options: dict[str, list[str]] = {}
    place = 0
    while place < len(words) and words[place] in _FLAGS | _VECTORS | _PAIRS:
        option = words[place]
        place += 1
        count = 2 if option in _PAIRS else 1
        if option in _VECTORS:
            count = len(_numbers(words[place : place + 3]))
        options[option] = words[place : place + count]
        place += count
    # The name goes on to the end of the line; `split` would lose doubled blanks in it.
    name = rest
    for word in words[:place]:
        name = name.lstrip()[len(word) :]
    name = name.strip().strip('"')
    if not name:
        return None
    strength = _numbers(options.get("-bm", []))
    return MapLine(
        name,
        _pair(options.get("-o", []), 0.0),
        _pair(options.get("-s", []), 1.0),
        options.get("-clamp") == ["on"],
        strength[0] if strength else 1.0,
    )


def _pair(words: list[str], missing: float) -> tuple[float, float]:
    values = [*_numbers(words), missing, missing]
    given = len(values) - 2
    return values[0], values[1] if given > 1 else missing
