"""How far a reflection is from the truth: colours, hit points, and CPU time."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.truth.shading.cubes import directions_of_texels

Array = npt.NDArray[Any]
Mask = npt.NDArray[np.bool_]

#: Positions of the world, in metres, go to colours from 0 to 1; directions of the sky to colours from 2 to 3.
_REACH = 128.0


@dataclass(frozen=True)
class Colors:
    """How far the colours of a reflector are from the truth.

    Attributes
    ----------
    rmse : float
        The root of the mean squared difference over pixels and channels of what a screen shows, from 0 to 1.
    within : float
        The share of pixels of which no channel is off by more than 4/255.
    largest : float
        The largest difference of a channel.
    """

    rmse: float
    within: float
    largest: float


def shown(color: Array, *, linear: bool) -> npt.NDArray[np.float64]:
    """What a screen shows of colours (H, W, 3 or 4), 0 to 1 and not rounded: the numbers themselves, or light in sRGB.

    The encoding is that of IEC 61966-2-1. What exceeds 1 is clipped, so that the sun does not outweigh all else.
    """
    c = np.clip(np.asarray(color, float)[..., :3], 0, 1)
    if not linear:
        return np.asarray(c)
    curved = 1.055 * np.maximum(c, 1e-9) ** (1 / 2.4) - 0.055
    return np.asarray(np.where(c <= 0.0031308, 12.92 * c, curved))


def compare(got: Array, exact: Array, on: Mask) -> Colors:
    """Compare what a screen shows (H, W, 3) on the pixels of a mask (H, W)."""
    off = np.abs(got[on] - exact[on])
    # Half a millionth more: numbers of uint8 that are four steps apart are within.
    within = off.max(axis=-1) <= 4 / 255 + 5e-7
    return Colors(float(np.sqrt(np.mean(off**2))), float(within.mean()), float(off.max()))


def inner(on: Mask) -> Mask:
    """The pixels of a mask whose eight neighbours belong to it as well."""
    wide = np.pad(on, 1)
    rows, columns = on.shape
    parts = [wide[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return np.asarray(np.logical_and.reduce(parts))


def code_positions(scene: cc.Scene, nodes: list[cc.Node]) -> None:
    """Give all but the named nodes colours that say where in the world they are, and the sky colours of its directions.

    A triangle's colours are interpolated as its positions are, so that a mirror shows the hit points of its rays.
    """
    for node in scene.nodes:
        if node.mesh is None or any(node is other for other in nodes):
            continue
        at = np.asarray(node.mesh.positions, float) @ node.world_matrix[:3, :3].T
        at += node.world_matrix[:3, 3]
        colors = (at / _REACH + 1) / 2
        node.mesh = cc.Mesh(
            node.mesh.positions,
            node.mesh.indices,
            normals=node.mesh.normals,
            colors=colors.astype(np.float32),
        )
        node.material = cc.BasicMaterial(vertex_colors=True)
    d = directions_of_texels(256)
    faces = (2.5 + 0.5 * d / np.linalg.norm(d, axis=-1, keepdims=True)).astype(np.float32)
    scene.environment = scene.background = cc.CubeMap(faces)


def hits_found(got: Array, exact: Array, position: Array, on: Mask) -> float:
    """The share of pixels of which the coded hit point is within 1 % of the ray's length; in the sky, within .01 rad.

    Parameters
    ----------
    got, exact : ndarray (H, W, 3 or 4)
        What a mirror shows in a scene of `code_positions`, and the truth.
    position : ndarray (H, W, 3)
        Where the mirror is.
    on : ndarray of bool (H, W)
        The mirror's pixels.
    """
    a, b, p = (np.asarray(x, float)[..., :3][on] for x in (got, exact, position))
    sky, sky_too = b.min(axis=-1) > 1.5, a.min(axis=-1) > 1.5
    hit, other = ((2 * x - 1) * _REACH for x in (b, a))
    off = np.linalg.norm(other - hit, axis=-1)
    near = ~sky & ~sky_too & (off < 0.01 * np.linalg.norm(hit - p, axis=-1))
    turned = np.linalg.norm(2 * (a - b), axis=-1)
    return float((near | (sky & sky_too & (turned < 0.01))).mean())


def cpu_ratio(
    one: Callable[[int], object], other: Callable[[int], object], rounds: int
) -> tuple[float, float]:
    """Time two works in turns: milliseconds of CPU of all threads of the first one, and the median of its ratio.

    Both are called once before, so that shaders are compiled and probes are drawn.
    """
    one(0), other(0)
    times: list[tuple[float, float]] = []
    for index in range(1, rounds + 1):
        start = time.process_time()
        other(index)
        middle = time.process_time()
        one(index)
        times.append((time.process_time() - middle, middle - start))
    own = statistics.median(a for a, _ in times)
    return own * 1e3, statistics.median(a / b for a, b in times)
