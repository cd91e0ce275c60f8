"""Lights: KHR_lights_punctual. A light shines from the origin of its node along -Z."""

from __future__ import annotations

import math
from typing import Any

from ...._core import DirectionalLight, Light, Node, PointLight, SpotLight
from ...left_out import LeftOut
from ..document import Gltf
from ..entries import Entry
from .values import Values, at

EXTENSION = "KHR_lights_punctual"
#: SpotLight takes angles below 90 degrees.
_WIDEST = 89.999


def light_of(document: Gltf, entry: Entry, node: Node, left_out: LeftOut) -> Light | None:
    """Make the light of a node; None if it has none."""
    reference = entry.extension(EXTENSION)
    if reference is None:
        return None
    root = document.tree.extension(EXTENSION) or Entry(f"extensions.{EXTENSION}", {})
    number = reference.index("light", len(root.entries("lights")))
    if number is None:
        raise reference.error("light", "the index of a light")
    light = root.member("lights", number)
    values = Values(light, left_out)
    options: dict[str, Any] = {
        "color": values.numbers("color", (1.0,) * 3, 0),
        "intensity": values.number("intensity", 1.0, 0),
        "parent": node,
    }
    kind = light.text("type")
    with at(light):
        if kind == "directional":
            return DirectionalLight((0, 0, -1), **options)
        if kind not in ("point", "spot"):
            raise light.error("type", "directional, point or spot")
        options |= {"decay": 2, "range": values.number("range", math.inf, 1e-9)}
        if kind == "point":
            return PointLight((0, 0, 0), **options)
        cone = Values(light.entry("spot"), left_out)
        outer = cone.number("outerConeAngle", math.pi / 4, 0, math.pi / 2)
        inner = cone.number("innerConeAngle", 0.0, 0, math.pi / 2)
        return SpotLight(
            (0, 0, 0),
            (0, 0, -1),
            angle=min(max(math.degrees(outer), 1e-3), _WIDEST),
            penumbra=1 - min(inner / outer, 1.0) if outer > 0 else 0.0,
            **options,
        )
