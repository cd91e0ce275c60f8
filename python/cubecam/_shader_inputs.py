"""The mappings `uniforms` and `textures` of shader materials and image effects."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping
from typing import TYPE_CHECKING, TypeVar

from ._core import CubeMap, Image, ImageEffect, Probe, RenderTexture, ShaderMaterial

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "ShaderInputs",
    "Textures",
    "Uniforms",
    "set_textures",
    "set_uniforms",
    "textures",
    "uniforms",
]

Given = TypeVar("Given")


class ShaderInputs(MutableMapping[str, Given]):
    """A live view of an object's uniforms or textures: the next picture shows a value that is set here."""

    _kind: str

    def __init__(self, owner: ShaderMaterial | ImageEffect) -> None:
        self._owner = owner

    def _values(self) -> dict[str, Given]:
        return dict(getattr(self._owner, f"_{self._kind}s")())

    def __getitem__(self, name: str) -> Given:
        """Return a value."""
        return self._values()[name]

    def __setitem__(self, name: str, value: Given) -> None:
        """Set a value; it is checked and copied."""
        getattr(self._owner, f"_set_{self._kind}")(name, value)

    def __delitem__(self, name: str) -> None:
        """Remove a value; the uniform then has the value of its declaration in the source."""
        getattr(self._owner, f"_remove_{self._kind}")(name)

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names in alphabetical order."""
        return iter(self._values())

    def __len__(self) -> int:
        """Return the number of names."""
        return len(self._values())

    def __repr__(self) -> str:
        """Show as a dict."""
        return repr(self._values())


class Uniforms(ShaderInputs["ArrayLike"]):
    """Numbers by name. A value that is read is a float or a read-only array."""

    _kind = "uniform"

    def __getitem__(self, name: str) -> float | NDArray[np.float64]:
        """Return a value."""
        return self._owner._uniforms()[name]


class Textures(ShaderInputs["Image | RenderTexture | CubeMap | Probe | ArrayLike"]):
    """Pictures by name. An array that is set becomes an Image."""

    _kind = "texture"

    def __getitem__(self, name: str) -> Image | RenderTexture | CubeMap | Probe:
        """Return a value."""
        return self._owner._textures()[name]


def uniforms(self: ShaderMaterial | ImageEffect) -> Uniforms:
    """Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture."""
    return Uniforms(self)


def set_uniforms(self: ShaderMaterial | ImageEffect, value: Mapping[str, ArrayLike]) -> None:
    """Replace all uniforms."""
    self._set_inputs(uniforms=value)


def textures(self: ShaderMaterial | ImageEffect) -> Textures:
    """Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture."""
    return Textures(self)


def set_textures(
    self: ShaderMaterial | ImageEffect,
    value: Mapping[str, Image | RenderTexture | CubeMap | Probe | ArrayLike],
) -> None:
    """Replace all textures."""
    self._set_inputs(textures=value)
