"""Sliders for the weights of a node's morph targets."""

from __future__ import annotations

from collections.abc import Callable

from .._core import Node
from .control import Control

__all__ = ["morph_names", "weight_controls"]


def morph_names(node: Node) -> tuple[str, ...]:
    """Name the morph targets of a node's mesh; those without a name, or with one that is taken, get numbers."""
    mesh = node.mesh
    names = [] if mesh is None else [target.name for target in mesh.morph_targets]
    return tuple(
        name if name and names.count(name) == 1 else f"{name or 'weight'} {i}"
        for i, name in enumerate(names)
    )


def weight_controls(node: Node, names: tuple[str, ...]) -> tuple[Control, ...]:
    """Make a slider for each weight, from 0 to 1 and to the present value."""
    return tuple(_weight(node, i, name) for i, name in enumerate(names))


def _weight(node: Node, index: int, name: str) -> Control:
    def get() -> float:
        # Another mesh may have fewer targets, until the panel is made again.
        weights = node.weights
        return float(f"{float(weights[index]):.7g}") if index < len(weights) else 0.0

    def set_(value: float) -> None:
        weights = node.weights.copy()
        weights[index] = value
        node.weights = weights

    def keep() -> Callable[[], object]:
        weights = node.weights
        return lambda: setattr(node, "weights", weights)

    return Control(
        name,
        "number",
        get,
        set_,
        low=min(0.0, get()),
        high=max(1.0, get()),
        help="How much of the morph target is added to the mesh.",
        keep=keep if index == 0 else None,
    )
