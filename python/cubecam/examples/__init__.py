"""The programs of the course documents, and P18, which goes on from them. Each is a short module that imports only
`cubecam as cc`.

Each module has

- ``build(...)``, which makes the scene, the camera and the nodes that move, in one dataclass. It makes the staged
  scene, for eyes: places, light, colours and background are such that the picture shows what it is about. With
  ``document=True`` it makes the scene of the document, with the document's own numbers, which the tests hold;
- ``draw(program, renderer, frame, size=SIZE, **options)``, which returns frame 0, 1, 2, ... as an array (H, W, 4), row
  0 on top. A frame depends only on its number, so frames may be drawn in any order. The options are those of
  `Renderer.render`, such as ``format="rgba32f"``;
- in most modules ``live(...)``, which returns a `cubecam.Viewer` of the program, with the mouse and the keys of its
  document; it has ``document``, too;
- ``TITLE``, ``PROGRAM`` (its number, such as "P7"), ``FRAMES`` (a good length of its animation; 1: nothing moves),
  ``STILL`` (the best frame for a single picture) and ``SIZE`` (width and height in pixels). A program may have its own
  ``frames``, ``still`` and ``size``, which then count (`length_of`, `still_of`, `size_of`): those of a script, or of
  its document.

Where the document has inputs, ``build`` and ``live`` take them: ``images`` (six photographs), ``image`` (one picture of
six faces) and ``script`` (drags and keys of a visitor, such as ``"drag 30 10; w 5"``). P16 takes ``method``, the
parallax of its probes. `inputs_of` lists them.

The programs P1 to P17 treat colours as the documents do: the numbers of an 8-bit picture are shown unchanged, light is
added in these numbers, and no picture is tone-mapped or encoded. P18 computes with light, and shows it on a screen.

The command line draws them: ``cubecam example --list``.
"""

from __future__ import annotations

import importlib
import inspect
from typing import TYPE_CHECKING, Protocol, cast

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .._core import Renderer
    from ..typing import Pixels, RenderOptions

from .._calls import checked_call
from .._checks import text_of

__all__ = [
    "INPUTS",
    "NAMES",
    "Example",
    "inputs_of",
    "is_live",
    "length_of",
    "load",
    "size_of",
    "still_of",
]

#: The names in the order of the programs' numbers, P1 to P18.
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
    "rough_metal",
)

#: The documents' own inputs, and P16's method, as parameters of `build` and `live`.
INPUTS: tuple[str, ...] = ("images", "image", "script", "method")


class Example(Protocol):
    """The members of every module here."""

    TITLE: str
    PROGRAM: str
    FRAMES: int
    STILL: int
    SIZE: tuple[int, int]

    def build(self, *inputs: object, document: bool = False, **options: object) -> object:
        """Make the staged scene, or that of the document; each module has inputs and options of its own."""

    def draw(
        self,
        program: object,
        renderer: Renderer,
        frame: int,
        size: tuple[int, int] = ...,
        **options: Unpack[RenderOptions],
    ) -> Pixels:
        """Draw a frame, ndarray (H, W, 4)."""


@checked_call
def load(name: str) -> Example:
    """Import an example.

    Parameters
    ----------
    name : str
        One of `NAMES`, or its number, such as "P14" or "p14".

    Returns
    -------
    module
        The module, with the members that this package's docstring lists.

    Raises
    ------
    ValueError
        For another name; the message lists all names.

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
    raise ValueError(f"name: expected one of {listed}; got {text_of(name)}")


@checked_call
def is_live(name: str) -> bool:
    """Report whether an example has a live form, ``load(name).live()``.

    Parameters
    ----------
    name : str
        As for `load`.

    Returns
    -------
    bool

    Raises
    ------
    ValueError
        As `load`.

    Examples
    --------
    >>> from cubecam import examples
    >>> examples.is_live("P14"), examples.is_live("additive_blur")
    (True, False)
    """
    return hasattr(load(name), "live")


@checked_call
def inputs_of(name: str) -> tuple[str, ...]:
    """List which of `INPUTS` an example takes.

    Parameters
    ----------
    name : str
        As for `load`.

    Returns
    -------
    tuple of str
        Names of parameters of ``load(name).build``.

    Raises
    ------
    ValueError
        As `load`.

    Examples
    --------
    >>> from cubecam import examples
    >>> examples.inputs_of("P2"), examples.inputs_of("P6")
    (('images', 'script'), ('image',))
    """
    known = inspect.signature(load(name).build).parameters
    return tuple(one for one in INPUTS if one in known)


def length_of(module: Example, program: object) -> int:
    """Give the number of frames of an animation: the program's own ``frames``, or the module's ``FRAMES``."""
    return int(getattr(program, "frames", module.FRAMES))


def still_of(module: Example, program: object) -> int:
    """Give the best frame for a single picture: the program's own ``still``, or the module's ``STILL``."""
    return int(getattr(program, "still", module.STILL))


def size_of(module: Example, program: object) -> tuple[int, int]:
    """Give width and height of the pictures in pixels: the program's own ``size``, or the module's ``SIZE``."""
    width, height = getattr(program, "size", module.SIZE)
    return int(width), int(height)


def _module(name: str) -> Example:
    return cast("Example", importlib.import_module(f"{__name__}.{name}"))
