"""The stencil test and its operations (OpenGL 4.6, section 17.3.3), and a canvas that draws by them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

FUNCS: dict[str, Callable[[Any, Any], Any]] = {
    "never": lambda a, b: np.zeros(np.broadcast(a, b).shape, bool),
    "less": np.less,
    "equal": np.equal,
    "lequal": np.less_equal,
    "greater": np.greater,
    "notequal": np.not_equal,
    "gequal": np.greater_equal,
    "always": lambda a, b: np.ones(np.broadcast(a, b).shape, bool),
}

OPS = {
    "keep": lambda stored, reference: stored,
    "zero": lambda stored, reference: 0 * stored,
    "replace": lambda stored, reference: 0 * stored + reference,
    "incr": lambda stored, reference: np.minimum(stored + 1, 255),
    "incr_wrap": lambda stored, reference: (stored + 1) % 256,
    "decr": lambda stored, reference: np.maximum(stored - 1, 0),
    "decr_wrap": lambda stored, reference: (stored - 1) % 256,
    "invert": lambda stored, reference: 255 - stored,
}


@dataclass
class Stencil:
    """The product's parameters, under the same names."""

    func: str = "always"
    reference: int = 0
    read_mask: int = 255
    write_mask: int = 255
    fail: str = "keep"
    depth_fail: str = "keep"
    depth_pass: str = "keep"

    def test(self, stored):
        return FUNCS[self.func](self.reference & self.read_mask, stored & self.read_mask)

    def updated(self, stored, passed, near):
        """The new stencil values; `passed` and `near` say which pixels passed the stencil and the depth test."""
        result = stored
        for where, op in (
            (~passed, self.fail),
            (passed & ~near, self.depth_fail),
            (passed & near, self.depth_pass),
        ):
            value = OPS[op](stored, self.reference)
            value = (value & self.write_mask) | (stored & ~np.int64(self.write_mask))
            result = np.where(where, value, result)
        return result


class Canvas:
    """Colour, distance and stencil of a picture that flat things are drawn into, one after the other."""

    def __init__(self, shape, background, depth=True):
        self.color = np.broadcast_to(np.asarray(background, float), (*shape, 4)).copy()
        self.z = np.full(shape, np.inf)
        self.stencil = np.zeros(shape, np.int64)
        self.depth = depth

    def draw(self, covered, z, color, stencil=None):
        """Draw an opaque thing at one distance into the pixels that are `covered`."""
        near = (z < self.z) if self.depth else np.ones_like(covered)
        passed = np.ones_like(covered) if stencil is None else stencil.test(self.stencil)
        if stencil is not None:
            updated = stencil.updated(self.stencil, passed, near)
            self.stencil = np.where(covered, updated, self.stencil)
        drawn = covered & passed & near
        self.color[drawn] = color
        self.z[drawn] = z
