"""One piece of a picture: some pixels and some samples of each, in this process or in another one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .arrays import Array
from .eyes import Eye
from .matrices import luminance
from .paths.sampler import pairs
from .paths.state import first_paths
from .paths.tracer import Tracer
from .scene.snapshot import Snapshot

#: Paths of a piece: enough that numpy's own cost for each call does not matter, few enough for the processor's caches.
PATHS = 1 << 16


@dataclass(frozen=True)
class Job:
    """All that a process needs to know to draw any piece of a picture."""

    snapshot: Snapshot
    eye: Eye
    bounces: int
    samples: int
    seed: int
    self_hits: bool
    of_capture: bool = False  # whether the eye sees what captures see

    def tracer(self) -> Tracer:
        return Tracer(
            self.snapshot,
            bounces=self.bounces,
            seed=self.seed,
            self_hits=self.self_hits,
            of_capture=self.of_capture,
        )


@dataclass(frozen=True)
class Piece:
    """Pixels `pixels[0]` to below `pixels[1]`, and in the same way samples."""

    pixels: tuple[int, int]
    samples: tuple[int, int]


def pieces(pixels: int, samples: tuple[int, int], paths: int) -> list[Piece]:
    """Cut some samples of all pixels into pieces of at most `paths` paths, but at least a pixel."""
    step = max(min(paths, PATHS) // (samples[1] - samples[0]), 1)
    return [Piece((a, min(a + step, pixels)), samples) for a in range(0, pixels, step)]


def drawn(job: Job, tracer: Tracer, piece: Piece) -> tuple[Array, Array]:
    """Draw a piece.

    Returns the sums of colour and alpha over the samples (P, 4), and the sums of their squared luminance (P,).
    """
    pixel = np.arange(*piece.pixels)
    sample = np.arange(*piece.samples)
    count = len(pixel) * len(sample)
    each_pixel, each_sample = np.repeat(pixel, len(sample)), np.tile(sample, len(pixel))
    place: npt.ArrayLike = (0.5, 0.5)
    if job.samples > 1:
        place = pairs(each_pixel, each_sample, 0, job.seed)
    rays = job.eye.rays(each_pixel, place)
    paths = first_paths(
        rays.origin, rays.direction, rays.reach, each_pixel, each_sample, np.arange(count)
    )
    light = tracer.light(paths, count).reshape(len(pixel), len(sample), 4)
    return light.sum(axis=1), (luminance(light) ** 2).sum(axis=1)
