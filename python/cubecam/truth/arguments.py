"""Checks of what `render` and `capture` are given."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .. import _core
from .._checks import one_of, real_number, text_of, whole_number
from .._rotations import rotation_matrix
from .outputs import OUTPUTS

if TYPE_CHECKING:
    from .._core import Node, Scene


@dataclass(frozen=True)
class Quality:
    """How good a picture shall be, and what it may cost."""

    bounces: int
    samples: int
    seed: int
    target_error: float | None
    deadline: float | None
    processes: int | None
    self_hits: bool
    progress: bool | None


def quality_of(
    bounces: int,
    samples: int,
    seed: int,
    target_error: float | None,
    deadline: float | None,
    processes: int | None,
    self_hits: bool,
    progress: bool | None,
) -> Quality:
    """Check the options that `render` and `capture` share."""
    for value, name in ((target_error, "target_error"), (deadline, "deadline")):
        if value is not None and not real_number(value, name) > 0:
            raise ValueError(f"{name}: expected a number above 0, got {value}")
    return Quality(
        whole_number(bounces, "bounces", 0, 1000),
        whole_number(samples, "samples", 1, 65536),
        whole_number(seed, "seed", 0, 2**32 - 1),
        target_error,
        deadline,
        None if processes is None else whole_number(processes, "processes", 1, 1024),
        self_hits,
        progress,
    )


def output_names(outputs: Iterable[str]) -> tuple[str, ...]:
    """Give the names of outputs, all of which exist."""
    if isinstance(outputs, str) or not isinstance(outputs, Iterable):
        raise TypeError(f"outputs: expected a sequence of names, got {text_of(outputs)}")
    return tuple(one_of(name, "outputs", OUTPUTS) for name in outputs)


def nodes_of(nodes: Iterable[Node], scene: Scene) -> tuple[Node, ...]:
    """Give the nodes that a picture leaves out, all of which are in the scene."""
    if not isinstance(nodes, Iterable):
        raise TypeError(f"exclude: expected a sequence of nodes, got {text_of(nodes)}")
    found = tuple(nodes)
    for node in found:
        of_class(node, _core.Node, "exclude")
        if node not in scene:
            raise ValueError(f"exclude: expected nodes of this scene, got {node!r}")
    return found


def of_class(value: object, kind: type, name: str) -> None:
    """Raise TypeError for a value that is not an object of a class."""
    if not isinstance(value, kind):
        raise TypeError(f"{name}: expected a {kind.__name__}, got {text_of(value)}")


def vector(value: npt.ArrayLike, length: int, name: str) -> npt.NDArray[np.float64]:
    """Give an array of some finite numbers as float64."""
    found = _core._to_array(value, name)
    if found.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected {length} real numbers, got {text_of(value)}")
    if found.shape != (length,):
        raise ValueError(f"{name}: expected {length} numbers, got an array of shape {found.shape}")
    numbers = found.astype(np.float64)
    if not np.isfinite(numbers).all():
        raise ValueError(f"{name}: expected finite numbers, got {text_of(value)}")
    return numbers


def matrix_of(rotation: npt.ArrayLike | None) -> npt.NDArray[np.float64]:
    """Give the matrix (3, 3) of a quaternion (w, x, y, z) of any length."""
    if rotation is None:
        return np.eye(3)
    quaternion = vector(rotation, 4, "rotation")
    length = np.linalg.norm(quaternion)
    if not length > 0:
        raise ValueError("rotation: expected a quaternion of a length above 0, got 0, 0, 0, 0")
    return rotation_matrix(quaternion / length)
