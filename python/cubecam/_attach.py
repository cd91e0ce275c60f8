"""Gives the core's classes the methods that are better written in Python.

The methods are set on the core's own classes and not on subclasses, so that objects that the core returns have them,
too. No other module does this. The methods import what they need when they are called, so that attaching costs no time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _old_names, _shader_inputs, navigation
from ._core import (
    CubeMap,
    Frame,
    Image,
    ImageEffect,
    OrthographicCamera,
    PerspectiveCamera,
    ShaderMaterial,
)
from .io.cubemap_save import save_cubemap

if TYPE_CHECKING:
    from collections.abc import Callable


def _cube_repr_png(self: CubeMap) -> bytes:
    """Give the picture that Jupyter shows: a cross seen from within, tone-mapped if the numbers are floats."""
    from .pictures import cube_png

    return cube_png(self)


def _frame_repr_png(self: Frame) -> bytes | None:
    """Give the picture that Jupyter shows: the colour, opaque, tone-mapped if the numbers are floats; None without."""
    from .pictures import frame_png

    return None if self.color is None else frame_png(self)


def _image_repr_png(self: Image) -> bytes:
    """Give the picture that Jupyter shows."""
    from .pictures import image_png

    return image_png(self)


def _attach(target: type, name: str, method: Callable[..., Any] | property) -> None:
    setattr(target, name, method)


def attach() -> None:
    """Attach every method; called once, by `cubecam/__init__.py`."""
    _attach(CubeMap, "save", save_cubemap)
    _attach(CubeMap, "_repr_png_", _cube_repr_png)
    _attach(Frame, "_repr_png_", _frame_repr_png)
    _attach(Image, "_repr_png_", _image_repr_png)
    inputs = {
        "uniforms": property(_shader_inputs.uniforms, _shader_inputs.set_uniforms),
        "textures": property(_shader_inputs.textures, _shader_inputs.set_textures),
    }
    for shader in (ShaderMaterial, ImageEffect):
        for name, mapping in inputs.items():
            _attach(shader, name, mapping)
    for camera in (PerspectiveCamera, OrthographicCamera):
        for name in ("yaw", "pitch", "walk", "strafe", "orbit", "look"):
            _attach(camera, name, getattr(navigation, name))
    _old_names.answer_old_names()
