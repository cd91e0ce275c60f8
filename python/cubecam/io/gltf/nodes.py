"""The tree of nodes: parents, matrices, and the order in which a scene shows them (section 3.5 of glTF 2.0).

Nothing here is recursive, because a file may nest nodes as deep as it likes.
"""

from __future__ import annotations

import numpy as np

from ..._core import MeshError
from ..meshes.placing import Matrices
from .entries import Entry
from .extensions import VISIBILITY
from .matrices import composed, rotations


def local_matrices(nodes: list[Entry]) -> Matrices:
    """Return each node's own matrix, (N, 4, 4), for column vectors."""
    still, upright, unit = [0.0] * 3, [0.0, 0.0, 0.0, 1.0], [1.0] * 3
    translations = [node.numbers("translation", 3) or still for node in nodes]
    quaternions = [node.numbers("rotation", 4) or upright for node in nodes]
    scales = [node.numbers("scale", 3) or unit for node in nodes]
    turned = rotations(
        np.array(quaternions).reshape(-1, 4), lambda index: nodes[index].path("rotation")
    )
    result = composed(
        np.array(translations).reshape(-1, 3), turned, np.array(scales).reshape(-1, 3)
    )
    for index, node in enumerate(nodes):
        matrix = node.numbers("matrix", 16)
        if matrix is not None:
            result[index] = np.array(matrix).reshape(4, 4).T  # columns stand one after another
            result[index, 3] = (0, 0, 0, 1)
    return result


class NodeTree:
    """The nodes of a file: `children[i]`, `parents[i]` (-1 for a root), and `worlds`, (N, 4, 4) for column vectors."""

    def __init__(self, nodes: list[Entry]) -> None:
        count = len(nodes)
        self.children = [node.indices("children", count) for node in nodes]
        self.parents = [-1] * count
        for index, children in enumerate(self.children):
            for child in children:
                if self.parents[child] >= 0:
                    raise MeshError(
                        f"nodes[{child}]: expected one parent, "
                        f"got nodes[{self.parents[child]}] and nodes[{index}]"
                    )
                self.parents[child] = index
        self.roots = [index for index, parent in enumerate(self.parents) if parent < 0]
        order = self.below(self.roots)
        if len(order) < count:
            lost = min(set(range(count)).difference(order))
            raise MeshError(
                f"nodes[{lost}]: expected a tree, got a cycle of nodes above or below it"
            )
        self.worlds = self._worlds(nodes, order)

    def below(self, roots: list[int], skipped: frozenset[int] = frozenset()) -> list[int]:
        """Return the nodes of some subtrees, each once, a parent before its children, in the file's order.

        The subtrees of the nodes in `skipped` are left out.
        """
        order: list[int] = []
        seen: set[int] = set()
        left = roots[::-1]
        while left:
            index = left.pop()
            if index in seen or index in skipped:
                continue
            seen.add(index)
            order.append(index)
            left.extend(self.children[index][::-1])
        return order

    def _worlds(self, nodes: list[Entry], order: list[int]) -> Matrices:
        worlds = local_matrices(nodes)
        with np.errstate(all="ignore"):  # the geometry says so if a number is too big
            for index in order:
                if self.parents[index] >= 0:
                    worlds[index] = worlds[self.parents[index]] @ worlds[index]
        return worlds


def hidden(nodes: list[Entry]) -> frozenset[int]:
    """Return the nodes that KHR_node_visibility hides, with all below them."""
    found = []
    for index, node in enumerate(nodes):
        visibility = node.extension(VISIBILITY)
        if visibility is not None and not visibility.flag("visible", True):
            found.append(index)
    return frozenset(found)
