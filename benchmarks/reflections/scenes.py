"""Three scenes to reflect: two rooms and a village. Each has a camera, and an empty node where the reflector stands.

They are written to room_a.glb, room_b.glb and outdoor.glb beside this file (`python -m benchmarks.reflections
--write`), which are what the benchmark loads. `load` adds the sky to the village, a photograph of the package's own
data, which would be large.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cubecam as cc

from .rooms import HIGH, LOW, room_a, room_b
from .village import village

FOLDER = Path(__file__).parent
SKY = "sunrise.exr"


@dataclass(frozen=True)
class Place:
    """What is known of a scene.

    Attributes
    ----------
    build : callable
        Makes the scene.
    radius : float
        Of the mirror ball, metres.
    low, high : tuple of float
        The corners of the box that stands for the scene: the room, or a box about as wide as the village's middle.
    linear : bool
        Whether the colours are light, and are encoded for a screen before they are compared.
    """

    build: Callable[[], cc.Scene]
    radius: float
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    linear: bool = False


def load(name: str) -> cc.Scene:
    """Load a scene of `PLACES` from its file."""
    scene = cc.load_scene(FOLDER / f"{name}.glb")
    return _under_the_sky(scene) if PLACES[name].linear else scene


def write(folder: Path = FOLDER) -> None:
    """Write the files of all scenes."""
    for name, place in PLACES.items():
        place.build().save(folder / f"{name}.glb")


def _under_the_sky(scene: cc.Scene) -> cc.Scene:
    sky = cc.load_environment(cc.sample_data(SKY), size=512)
    scene.environment = sky
    scene.background = sky
    return scene


PLACES = {
    "room_a": Place(room_a, 0.5, LOW, HIGH),
    "room_b": Place(room_b, 0.6, LOW, HIGH),
    "outdoor": Place(village, 0.5, (-20, 0, -20), (20, 15, 20), linear=True),
}
