"""Which nodes of a scene count, where a property holds for all nodes below one, too."""

from __future__ import annotations

from collections.abc import Iterator

from ._core import Node, Scene

__all__ = ["holds", "shown_nodes", "upwards"]


def upwards(node: Node) -> Iterator[Node]:
    """Iterate over a node and all nodes above it."""
    at: Node | None = node
    while at is not None:
        yield at
        at = at.parent


def holds(node: Node, name: str) -> bool:
    """Find whether a property, such as ``visible``, is true for a node and for all nodes above it."""
    return all(getattr(above, name) for above in upwards(node))


def shown_nodes(scene: Scene) -> list[Node]:
    """List the nodes with a mesh that pictures show."""
    return [node for node in scene.nodes if node.mesh is not None and holds(node, "visible")]
