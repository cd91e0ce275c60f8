"""The programs of the course documents, ready to run: each a short module that only says `import cubecam as cc`.

Each module has

- ``build(...)``, which makes the scene, the camera and the nodes that move, in one dataclass;
- ``draw(program, renderer, frame, size=SIZE, **options)``, which gives frame 0, 1, 2, ... as an array (H, W, 4), row 0
  on top. A frame depends on its number alone, so they may be drawn in any order. The options are those of
  `Renderer.render`, such as ``format="rgba32f"``;
- ``TITLE``, ``PROGRAM`` (its number, such as "P7"), ``FRAMES`` (a sensible length of its animation; 1: nothing
  moves), ``STILL`` (the frame that a single picture shows best) and ``SIZE`` (width and height in pixels).

Colours are the documents': what an 8-bit picture holds is shown as it is, light is added up in those numbers, and
nothing is tone-mapped or encoded.

The command line draws them: ``cubecam example --list``.
"""

from __future__ import annotations

import importlib
from typing import Any, Protocol, cast

__all__ = ["NAMES", "Example", "load"]

#: In the order of their numbers, P1 to P17.
NAMES: tuple[str, ...] = (
    "textured_cube",
    "inside_the_box",
    "skybox",
    "reflection_and_refraction",
    "arriving_faces",
    "model_space_reflection",
    "translucent_objects",
    "anaglyph",
    "additive_blur",
    "render_to_texture",
    "framebuffer_parts",
    "cube_camera",
    "cubemap_on_a_cube",
    "dynamic_reflection",
    "nothing_redrawn",
    "shared_cubemap",
    "dynamic_refraction",
)


class Example(Protocol):
    """What every module here has."""

    TITLE: str
    PROGRAM: str
    FRAMES: int
    STILL: int
    SIZE: tuple[int, int]

    def build(self) -> Any:
        """Make the scene; each module's own has options."""

    def draw(
        self, program: Any, renderer: Any, frame: int, size: tuple[int, int] = ..., **options: Any
    ) -> Any:
        """Draw a frame, ndarray (H, W, 4)."""


def load(name: str) -> Example:
    """Import an example.

    Parameters
    ----------
    name : str
        One of `NAMES`, or its number, such as "P14" or "p14".

    Returns
    -------
    module
        See the head of this module.

    Raises
    ------
    ValueError
        Another name; the message lists those there are.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam import examples
    >>> ball = examples.load("P14")
    >>> program = ball.build()
    >>> with cc.Renderer() as renderer:
    ...     picture = ball.draw(program, renderer, frame=10, size=(64, 48))
    >>> picture.shape
    (48, 64, 4)
    """
    if not isinstance(name, str):
        raise TypeError(f"name: expected a str, got {type(name).__name__}")
    for known in NAMES:
        if name == known:
            return _module(known)
    for known in NAMES:
        found = _module(known)
        if name.upper() == found.PROGRAM:
            return found
    listed = ", ".join(f"{_module(known).PROGRAM} {known}" for known in NAMES)
    raise ValueError(f"name: expected one of {listed}; got {name!r}")


def _module(name: str) -> Example:
    return cast("Example", importlib.import_module(f"{__name__}.{name}"))
