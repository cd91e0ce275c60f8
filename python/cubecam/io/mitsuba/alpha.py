"""How much of a surface is there, and how it is mixed with what lies behind it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._core import Image, StandardMaterial
from .looks import Painter, channel_of

Json = dict[str, Any]

#: By how much a picture is enlarged before its alphas are compared with a cutoff.
_FINER = 4


class Alpha:
    """The alpha of one material on one mesh.

    `opacity` is what the BSDF ``mask`` takes: the share of the light behind that does not pass. `factor` multiplies
    what is emitted, and `mapped` says whether the map's (or vertices') alpha does, too.
    """

    def __init__(self, painter: Painter, image: Image | None, vertices: bool) -> None:
        material = painter.material
        color = np.asarray(getattr(material, "color", (1, 1, 1, 1)), float)
        if not hasattr(material, "color") or not hasattr(material, "vertex_colors"):
            tint = np.asarray(getattr(material, "tint", (1, 1, 1, 1)), float)
            color = np.append(np.ones(3), color[3] * tint[3])
        self.opacity: Json | float = 1.0
        self.factor = 1.0
        self.mapped = False
        own = float(material.opacity)
        mode = material.alpha_mode if isinstance(material, StandardMaterial) else None
        if mode == "opaque":
            image, vertices, alpha = None, False, own
        else:
            alpha = own * float(color[3])
        has_map = image is not None and image.channels == 4
        colors = painter.look.surface.colors if vertices else None
        in_vertices = colors is not None and bool((colors[:, 3] < 1).any())
        if in_vertices and (mode == "mask" or has_map or _spread(colors) > 0):
            painter.tell("alphas of vertex colours are left out")
            in_vertices = False
        if in_vertices:
            assert colors is not None
            alpha *= float(colors[0, 3])
        if mode == "mask":
            assert isinstance(material, StandardMaterial)
            self.factor = own
            if image is not None and has_map:
                shown = _enlarged(channel_of(image, 3), image) * color[3] >= material.alpha_cutoff
                self.opacity = {
                    **painter.values(image, shown * np.float32(own)),
                    "filter_type": "nearest",
                }
            else:
                self.opacity = own if color[3] >= material.alpha_cutoff else 0.0
            self._tell_shadow(painter)
            return
        blend = material.blend
        if blend is None:
            blend = "alpha" if alpha < 1 or has_map or mode == "blend" else "opaque"
        if blend == "opaque":
            return
        if blend not in ("alpha", "alpha_keep", "premultiplied", "additive"):
            painter.tell("what is blended in other ways than by alpha is blended by alpha")
        self.mapped = has_map and blend != "premultiplied"
        self.factor = alpha
        if blend == "additive":
            self.opacity = 0.0
        elif image is not None and has_map:
            self.opacity = painter.numbers(alpha, image, 3)
        else:
            self.opacity = alpha
        self._tell_shadow(painter)

    def _tell_shadow(self, painter: Painter) -> None:
        if self.opacity != 1.0:
            painter.tell(
                "translucent surfaces and the holes of alpha masks cast the shadows of solid ones"
            )

    @property
    def is_solid(self) -> bool:
        """Say whether nothing shows through."""
        return self.opacity == 1.0


def _spread(colors: Any) -> float:
    return float(np.ptp(colors[:, 3]))


def _enlarged(pixels: Any, image: Image) -> Any:
    """Return a picture (H, W, 1) with more texels, between which it is linear as on screen."""
    if image.mag_filter == "nearest":
        return pixels
    mode = {"repeat": "wrap", "mirror": "symmetric", "clamp": "edge"}
    wraps = [image.wrap] * 2 if isinstance(image.wrap, str) else list(image.wrap)
    for axis, wrap in ((0, wraps[1]), (1, wraps[0])):
        count = pixels.shape[axis]
        around = [(0, 0)] * 3
        around[axis] = (1, 1)
        padded = np.pad(pixels, around, mode=mode[str(wrap)])  # type: ignore[call-overload]
        at = (np.arange(count * _FINER) + 0.5) / _FINER + 0.5
        low = np.floor(at).astype(int)
        share = (at - low).reshape([-1 if k == axis else 1 for k in range(3)])
        pixels = (1 - share) * padded.take(low, axis) + share * padded.take(low + 1, axis)
    return pixels.astype(np.float32)
