"""Skins and animations (sections 3.7.3 and 3.11 of glTF 2.0)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...._core import Node
from ...._warnings import warn_user
from ..extras.classes import KEY
from .document import Document, Json
from .values import Values

_INTERPOLATIONS = {"step": "STEP", "linear": "LINEAR", "cubic": "CUBICSPLINE"}


class Skins:
    """The skins of a document."""

    def __init__(self, document: Document, nodes: dict[Node, int]) -> None:
        self._document = document
        self._nodes = nodes
        self._known: dict[int, tuple[Any, int]] = {}

    @property
    def all(self) -> list[Any]:
        return [skin for skin, _ in self._known.values()]

    def index(self, skin: Any) -> int:
        """Return the index of a skin."""
        if id(skin) not in self._known:
            joints = [None if j is None else self._nodes.get(j) for j in skin.joints]
            if None in joints:
                raise ValueError(
                    f"skin: expected joints that are nodes of the scene, got joint {joints.index(None)}, "
                    "which is not"
                )
            entry: Json = {"joints": joints}
            matrices = np.asarray(skin.inverse_bind_matrices, np.float32)
            if (matrices != np.eye(4, dtype=np.float32)).any():
                entry["inverseBindMatrices"] = self._document.accessor(matrices)
            skeleton = getattr(skin, "skeleton", None)
            if skeleton in self._nodes:
                entry["skeleton"] = self._nodes[skeleton]
            self._known[id(skin)] = (skin, self._document.add("skins", entry))
        return self._known[id(skin)][1]


def add_animation(
    document: Document, nodes: dict[Node, int], animation: Any, values: Values
) -> int | None:
    """Write an animation, and return its index; None if none of its channels is in the scene."""
    channels: list[Json] = []
    samplers: list[Json] = []
    exact: list[Json] = []
    targets: set[tuple[int, str]] = set()
    for channel in animation.channels:
        node: Node | None = channel.node
        index = None if node is None else nodes.get(node)
        if node is None or index is None:
            continue  # it moves nothing in this scene
        if not _is_sayable(channel, node) or (index, channel.path) in targets:
            exact.append(
                {
                    "node": index,
                    **values.properties(channel, ("path", "times", "values", "interpolation")),
                }
            )
            continue
        targets.add((index, channel.path))
        samplers.append(_sampler(document, channel))
        target = {"node": index, "path": channel.path}
        channels.append({"sampler": len(samplers) - 1, "target": target})
    if not channels:
        if exact:
            raise ValueError(
                f"animation {animation.name!r}: expected a channel that glTF has, with times from 0 on"
            )
        from ... import gltf

        warn_user(
            f"the animation {animation.name!r} moves no node of the scene and is left out",
            gltf.SceneWarning,  # type: ignore[attr-defined]
        )
        return None
    entry: Json = {"channels": channels, "samplers": samplers}
    if animation.name:
        entry["name"] = animation.name
    if exact:
        entry["extras"] = {KEY: {"channels": exact}}
    return document.add("animations", entry)


def _is_sayable(channel: Any, node: Node) -> bool:
    """Say whether glTF has such a channel: with float32 times that increase from 0 on, and weights of a morph."""
    times = np.asarray(channel.times, np.float32)
    if times[0] < 0 or (np.diff(times) <= 0).any():
        return False
    return channel.path != "weights" or bool(getattr(node.mesh, "morph_targets", ()))


def _sampler(document: Document, channel: Any) -> Json:
    numbers = np.asarray(channel.values, np.float32)
    if channel.path == "rotation":
        numbers = numbers[:, [1, 2, 3, 0]]  # glTF has w last
    elif channel.path == "weights":
        numbers = numbers.reshape(-1)
    return {
        "input": document.accessor(np.asarray(channel.times, np.float32), bounds=True),
        "output": document.accessor(numbers),
        "interpolation": _INTERPOLATIONS[channel.interpolation],
    }
