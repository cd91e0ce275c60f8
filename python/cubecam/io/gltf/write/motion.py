"""Skins and animations (sections 3.7.3 and 3.11 of glTF 2.0)."""

from __future__ import annotations

import numpy as np

from ...._core import Animation, AnimationChannel, Node, Skin
from ...._warnings import SceneWarning, warn_user
from ..extras.classes import KEY
from .document import Document, Json
from .values import Values

_INTERPOLATIONS = {"step": "STEP", "linear": "LINEAR", "cubic": "CUBICSPLINE"}


class Skins:
    """The skins of a document."""

    def __init__(self, document: Document, nodes: dict[Node, int]) -> None:
        self._document = document
        self._nodes = nodes
        self._known: dict[int, tuple[Skin, int]] = {}

    @property
    def all(self) -> list[Skin]:
        return [skin for skin, _ in self._known.values()]

    def index(self, skin: Skin) -> int:
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
            skeleton = skin.skeleton
            if skeleton is not None and skeleton in self._nodes:
                if all(_is_below(joint, skeleton) for joint in skin.joints):
                    entry["skeleton"] = self._nodes[skeleton]
                else:  # the skeleton of glTF is a root of all joints
                    entry["extras"] = {KEY: {"skeleton": {"node": self._nodes[skeleton]}}}
            self._known[id(skin)] = (skin, self._document.add("skins", entry))
        return self._known[id(skin)][1]


def _is_below(node: Node | None, root: Node) -> bool:
    """Say whether a node is another one or lies below it."""
    while node is not None and node is not root:
        node = node.parent
    return node is root


def add_animation(
    document: Document, nodes: dict[Node, int], animation: Animation, values: Values
) -> Json | None:
    """Write an animation, and return what names it in `extras`; None if none of its channels is in the scene.

    Channels that glTF does not have stand in extras, and so do animations of such channels alone.
    """
    channels: list[Json] = []
    samplers: list[Json] = []
    exact: list[Json] = []
    for channel in animation.channels:
        node = channel.node
        index = None if node is None else nodes.get(node)
        if node is None or index is None:
            continue  # it moves nothing in this scene
        if not _is_sayable(channel, node):
            names = ("path", "times", "values", "interpolation")
            place = len(channels) + len(exact)
            exact.append({"place": place, "node": index, **values.properties(channel, names)})
            continue
        samplers.append(_sampler(document, channel))
        target = {"node": index, "path": channel.path}
        channels.append({"sampler": len(samplers) - 1, "target": target})
    entry: Json = {"name": animation.name} if animation.name else {}
    if channels:
        entry |= {"channels": channels, "samplers": samplers}
        if exact:
            entry["extras"] = {KEY: {"channels": exact}}
        return {"animation": document.add("animations", entry)}
    if exact:
        return {**entry, "channels": exact}
    warn_user(
        f"the animation {animation.name!r} moves no node of the scene and is left out", SceneWarning
    )
    return None


def _is_sayable(channel: AnimationChannel, node: Node) -> bool:
    """Say whether glTF has such a channel: with float32 times that increase from 0 on, and weights of a morph."""
    times = np.asarray(channel.times, np.float32)
    if times[0] < 0 or (np.diff(times) <= 0).any():
        return False
    return channel.path != "weights" or len(node.weights) > 0


def _sampler(document: Document, channel: AnimationChannel) -> Json:
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
