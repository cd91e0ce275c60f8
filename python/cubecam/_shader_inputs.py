"""The mappings `uniforms` and `textures` of shader materials and image effects."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from typing import Any

from ._core import ImageEffect, ShaderMaterial

__all__ = ["ShaderInputs", "set_textures", "set_uniforms", "textures", "uniforms"]


class ShaderInputs(MutableMapping[str, Any]):
    """A live view of an object's uniforms or textures: the next picture shows a value that is set here.

    A value that is read is a float, a read-only float64 array, an Image, a RenderTexture, a CubeMap or a Probe.
    """

    def __init__(self, owner: ShaderMaterial | ImageEffect, kind: str) -> None:
        self._owner = owner
        self._kind = kind

    def _values(self) -> dict[str, Any]:
        return dict(getattr(self._owner, f"_{self._kind}s")())

    def __getitem__(self, name: str) -> Any:
        """Return a value."""
        return self._values()[name]

    def __setitem__(self, name: str, value: Any) -> None:
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


def uniforms(self: ShaderMaterial | ImageEffect) -> MutableMapping[str, Any]:
    """Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture."""
    return ShaderInputs(self, "uniform")


def set_uniforms(self: ShaderMaterial | ImageEffect, values: Any) -> None:
    """Replace all uniforms."""
    self._set_inputs(uniforms=values)


def textures(self: ShaderMaterial | ImageEffect) -> MutableMapping[str, Any]:
    """Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture."""
    return ShaderInputs(self, "texture")


def set_textures(self: ShaderMaterial | ImageEffect, values: Any) -> None:
    """Replace all textures."""
    self._set_inputs(textures=values)
