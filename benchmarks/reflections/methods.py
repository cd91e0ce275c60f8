"""Ways to show what is around a reflector: each sets up its environment."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import cubecam as cc

from .reflectors import World


class MissingError(Exception):
    """What this version of cubecam does not have; the message names it."""


@dataclass(frozen=True)
class Method:
    """A kind of environment, with its options.

    Attributes
    ----------
    probe : dict
        Options of `cubecam.Probe`.
    proxy : bool
        Whether the probe gets the place's box.
    planar : bool
        Whether the reflectors are planar mirrors.
    screen : bool
        Whether the frame's own depth is marched first.
    shift : array_like (3,)
        Where the probe stands, from the middle of the reflector, metres.
    material : dict
        Properties of the reflectors' materials.
    """

    probe: dict[str, Any] = field(default_factory=dict)
    proxy: bool = False
    planar: bool = False
    screen: bool = False
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    material: dict[str, Any] = field(default_factory=dict)

    def prepare(
        self, world: World, *, size: int, bounces: int | None = None, texels: str = "rgba16f"
    ) -> dict[str, Any]:
        """Give the nodes of a world their environments, and return the options that its frames need.

        Parameters
        ----------
        world : World
        size : int
            Texels along an edge of a face.
        bounces : int, optional
            How many mirrors of a circle a path meets. None: the default.
        texels : str
            The format of the probes.

        Raises
        ------
        MissingError
            If this version of cubecam lacks an option.
        """
        counted = {} if bounces is None else {"bounces": bounces}
        for node in world.nodes:
            for name, value in self.material.items():
                if not hasattr(node.material, name):
                    raise MissingError(f"{type(node.material).__name__} has no {name}")
                setattr(node.material, name, value)
            if self.planar:
                node.environment = _made("PlanarMirror", **counted)
                continue
            options: dict[str, Any] = {"size": size, "format": texels, **self.probe, **counted}
            if self.proxy:
                options["box"] = (world.place.low, world.place.high)
            if np.any(self.shift):
                options["exclude"] = world.nodes
            node.environment = _made("Probe", self.shift, parent=node, **options)
        return _frame_options(self.screen)


def _made(name: str, *arguments: Any, **options: Any) -> Any:
    """Make an environment; as long as the parts of cubecam arrive one by one, refuse what is not there yet."""
    kind = getattr(cc, name, None)
    if kind is None:
        raise MissingError(f"no {name}")
    known = inspect.getdoc(kind.__init__) or ""
    for option in options:
        if f" {option}: " not in known:
            raise MissingError(f"{name} has no {option}=")
    return kind(*arguments, **options)


def _frame_options(screen: bool) -> dict[str, Any]:
    if not screen:
        return {}
    if " screen_reflections: " not in (inspect.getdoc(cc.Renderer.render) or ""):
        raise MissingError("frames have no screen_reflections=")
    return {"screen_reflections": True}


#: Glass through both sides of the body.
BOTH: dict[str, Any] = {"surfaces": 2}

METHODS = {
    "plain": Method(),
    "box": Method({"parallax": "box"}, proxy=True),
    "sphere": Method({"parallax": "sphere"}, proxy=True),
    "distance 6": Method({"parallax": "distance", "fetches": 6}),
    "distance 14": Method({"parallax": "distance", "fetches": 14}),
    "distance 35": Method({"parallax": "distance", "fetches": 35}),
    "layers 6": Method({"parallax": "layers", "fetches": 6}),
    "layers 14": Method({"parallax": "layers", "fetches": 14}),
    "layers 35": Method({"parallax": "layers", "fetches": 35}),
    "plain, .5 m off": Method(shift=(0.3, 0.2, 0.346)),
    "layers 35, .5 m off": Method({"parallax": "layers", "fetches": 35}, shift=(0.3, 0.2, 0.346)),
    "screen, plain": Method(screen=True),
    "screen, distance 14": Method({"parallax": "distance", "fetches": 14}, screen=True),
    "screen, layers 14": Method({"parallax": "layers", "fetches": 14}, screen=True),
    "planar": Method(planar=True),
    "both sides, plain": Method(material=BOTH),
    "both sides, box": Method({"parallax": "box"}, proxy=True, material=BOTH),
    "both sides, distance 14": Method({"parallax": "distance", "fetches": 14}, material=BOTH),
    "both sides, layers 35": Method({"parallax": "layers", "fetches": 35}, material=BOTH),
}
