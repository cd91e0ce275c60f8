"""Animations (section 3.11 of glTF 2.0)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from ...._core import Animation, AnimationChannel, Node
from ....typing import AnimationPath, Interpolation
from ...left_out import LeftOut
from ..document import Gltf
from ..entries import Entry
from ..limits import Limits
from ..primitives import accessor_index, check_type
from .values import at

_PATHS: dict[str, tuple[AnimationPath, str]] = {
    "translation": ("translation", "VEC3"),
    "rotation": ("rotation", "VEC4"),
    "scale": ("scale", "VEC3"),
    "weights": ("weights", "SCALAR"),
}
_INTERPOLATIONS: dict[str, Interpolation] = {
    "STEP": "step",
    "LINEAR": "linear",
    "CUBICSPLINE": "cubic",
}


class Animations:
    """The animations of a document.

    `nodes` are the nodes of glTF, `shown` those that show a glTF node's mesh, which have its weights.
    """

    def __init__(
        self,
        document: Gltf,
        nodes: Mapping[int, Node],
        shown: Mapping[int, list[Node]],
        limits: Limits,
        left_out: LeftOut,
    ) -> None:
        self._document = document
        self._nodes = nodes
        self._shown = shown
        self._limits = limits
        self._left_out = left_out

    def all(self) -> list[Animation | None]:
        """Return all animations; None in place of one that moves nothing in the scene."""
        found: list[Animation | None] = []
        for entry in self._document.all("animations"):
            channels: list[AnimationChannel] = []
            for number in range(len(entry.entries("channels"))):
                channels += self._channels(entry, entry.member("channels", number))
            name = entry.text("name") or ""
            with at(entry):
                found.append(Animation(channels, name=name) if channels else None)
        return found

    def _channels(self, animation: Entry, channel: Entry) -> list[AnimationChannel]:
        target = channel.needed("target")
        path = target.text("path")
        if path not in _PATHS:
            if path == "pointer" or target.extension("KHR_animation_pointer") is not None:
                self._left_out.add("the extension KHR_animation_pointer is not read", channel.where)
                return []
            raise target.error("path", f"one of {', '.join(_PATHS)}")
        number = target.index("node", self._document.count("nodes"))
        if number is None or number not in self._nodes:
            return []
        name, kind = _PATHS[path]
        moved = [self._nodes[number]]
        if name == "weights":
            moved = [node for node in self._shown.get(number, []) if len(node.weights)]
            if not moved:
                return []
        index = channel.index("sampler", len(animation.entries("samplers")))
        if index is None:
            raise channel.error("sampler", "the index of a sampler")
        sampler = animation.member("samplers", index)
        how = sampler.text("interpolation") or "LINEAR"
        if how not in _INTERPOLATIONS:
            raise sampler.error("interpolation", f"one of {', '.join(_INTERPOLATIONS)}")
        times = self._read(sampler, "input", "SCALAR", len(moved))
        values = self._read(sampler, "output", kind, len(moved))
        if name == "rotation":
            values = values[:, [3, 0, 1, 2]]
        elif name == "weights":
            width = len(moved[0].weights)
            if values.size % width:
                raise sampler.error("output", f"an accessor of a multiple of {width} weights")
            values = values.reshape(-1, width)
        times, values = self._increasing(times, values, sampler)
        with at(sampler):
            return [
                AnimationChannel(node, name, times, values, interpolation=_INTERPOLATIONS[how])
                for node in moved
            ]

    def _increasing(
        self, times: npt.NDArray[np.float64], values: npt.NDArray[np.float64], sampler: Entry
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Keep the last of several keys of one time, which some exporters write and glTF forbids."""
        kept = np.append(np.diff(times) != 0, True)
        if kept.all() or len(values) % len(times):
            return times, values
        self._left_out.add("keys of equal times are one key, the last", sampler.where)
        per_key = len(values) // len(times)
        return times[kept], values[np.repeat(kept, per_key)]

    def _read(self, sampler: Entry, key: str, kind: str, times: int) -> npt.NDArray[np.float64]:
        number = accessor_index(self._document, sampler, key)
        form = self._document.layout(number)
        check_type(sampler, key, form, kind)
        self._limits.motion(times * form.count * (1 if kind == "SCALAR" else 4), sampler)
        return np.asarray(self._document.accessor(number), np.float64)
