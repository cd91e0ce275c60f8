"""Cameras (section 3.10 of glTF 2.0). A camera looks from the origin of its node along -Z."""

from __future__ import annotations

import math

from ...._core import Camera, Node, OrthographicCamera, PerspectiveCamera
from ...left_out import LeftOut
from ..document import Gltf
from ..entries import Entry
from .values import Values, at

#: What takes the place of an infinite zfar: depth is reversed, so that a far end costs no precision.
FARTHEST = 1e9


def camera_of(document: Gltf, entry: Entry, node: Node, left_out: LeftOut) -> Camera | None:
    """Make the camera of a node; None if it has none."""
    number = entry.index("camera", document.count("cameras"))
    if number is None:
        return None
    camera = document.entry("cameras", number)
    kind = camera.text("type")
    with at(camera):
        if kind == "perspective":
            lens = camera.needed("perspective")
            values = Values(lens, left_out)
            near = values.number("znear", _missing(lens, "znear"), 1e-6)
            return PerspectiveCamera(
                fov=math.degrees(values.number("yfov", _missing(lens, "yfov"), 1e-4, 3.14)),
                near=near,
                far=values.number("zfar", max(FARTHEST, 2 * near)),
                parent=node,
            )
        if kind == "orthographic":
            lens = camera.needed("orthographic")
            values = Values(lens, left_out)
            return OrthographicCamera(
                height=2 * abs(values.number("ymag", _missing(lens, "ymag"))),
                near=values.number("znear", _missing(lens, "znear")),
                far=values.number("zfar", _missing(lens, "zfar")),
                parent=node,
            )
        raise camera.error("type", "perspective or orthographic")


def _missing(entry: Entry, key: str) -> float:
    """Raise an error if a number that must be there is not; the result has no meaning otherwise."""
    if key not in entry:
        raise entry.error(key, "a number")
    return 0.0
