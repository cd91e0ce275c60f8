"""Gives the core's classes the methods that are better written in Python.

The methods are set on the core's own classes and not on subclasses, so that objects that the core returns have them,
too. No other module does this. Modules that need numpy are loaded when a method is first used, so that attaching costs
no time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core, _old_names, _shader_inputs
from ._core import (
    CubeMap,
    Frame,
    Image,
    ImageEffect,
    OrthographicCamera,
    PerspectiveCamera,
    Scene,
    ShaderMaterial,
)
from ._late import LateFunction, LateMethod

if TYPE_CHECKING:
    from collections.abc import Callable

#: Classes that notebooks and rich show as cards; their subclasses inherit this, so that a new material needs no line.
_DESCRIBED = (
    _core.Scene,
    _core.Node,
    _core.Mesh,
    _core.Material,
    _core.Light,
    _core.Shadow,
    _core.Animation,
    _core.Probe,
    _core.PlanarMirror,
    _core.ProbeBlend,
    _core.ProbeGrid,
    _core.RenderTexture,
    _core.Camera,
    _core.StereoCamera,
    _core.ImageEffect,
    _core.Blend,
    _core.Stencil,
    _core.Texture,
    _core.Renderer,
    _core.RendererInfo,
    _core.Limits,
    _core.Stats,
    _core.Device,
)

#: Projections: a cube has the methods to_<name> and from_<name> of each.
_PROJECTIONS = (
    "perspective",
    "fisheye",
    "mirror_ball",
    "angular_map",
    "octahedral",
    "dual_paraboloid",
    "cylindrical",
)


def _cube_repr_png(self: CubeMap) -> bytes:
    """Give the picture that Jupyter shows: a cross seen from within, as `to_screen` turns it into 8 bits."""
    from .pictures import cube_png

    return cube_png(self)


def _frame_repr_png(self: Frame) -> bytes | None:
    """Give the picture that Jupyter shows: the file that `Frame.save` writes; None for a frame without a colour."""
    from .pictures import frame_png

    return None if self.color is None else frame_png(self)


def _image_repr_png(self: Image) -> bytes:
    """Give the picture that Jupyter shows."""
    from .pictures import image_png

    return image_png(self)


def _attach(target: type, name: str, method: Callable[..., Any] | property | LateMethod) -> None:
    if isinstance(method, LateMethod):
        method.__set_name__(target, name)
    setattr(target, name, method)


def attach() -> None:
    """Attach every method; called once, by `cubecam/__init__.py`."""
    _attach(CubeMap, "save", LateMethod("io.cubemap_save", "save_cubemap"))
    _attach(CubeMap, "save_for", LateMethod("io.engines", "save_for"))
    _attach(CubeMap, "_repr_png_", _cube_repr_png)
    _attach(CubeMap, "numpy", LateMethod("_array_protocol", "cube_numpy"))
    for projection in _PROJECTIONS:
        _attach(CubeMap, f"to_{projection}", LateMethod("projections", f"to_{projection}"))
        _attach(CubeMap, f"from_{projection}", LateFunction("projections", f"from_{projection}"))
    _attach(Frame, "save", LateMethod("io.images", "save_frame"))
    _attach(Frame, "_repr_png_", _frame_repr_png)
    _attach(Image, "_repr_png_", _image_repr_png)
    for picture in (CubeMap, Frame, Image):
        _attach(picture, "__array__", LateMethod("_array_protocol", "as_array"))
        _attach(picture, "__dlpack__", LateMethod("_array_protocol", "dlpack"))
        _attach(picture, "__dlpack_device__", LateMethod("_array_protocol", "dlpack_device"))
    _attach(Scene, "save", LateMethod("io.gltf.write.save", "save_scene"))
    _attach(Scene, "to_mitsuba", LateMethod("io.mitsuba.save", "to_mitsuba"))
    _attach(Scene, "show", LateMethod("viewer.viewer", "show_scene"))
    _attach(CubeMap, "show", LateMethod("viewer.cube_view", "show_cube"))
    for many in ("capture_many", "iter_captures"):
        _attach(_core.Renderer, many, LateMethod("batches.captures", many))
    _attach(_core.Renderer, "render_many", LateMethod("batches.renders", "render_many"))
    _attach(_core.ProbeGrid, "bake", LateMethod("_grid_bake", "bake"))
    for described in _DESCRIBED:
        _attach(described, "_repr_html_", LateMethod("pictures.objects", "repr_html"))
        _attach(described, "__rich__", LateMethod("pictures.objects", "rich_object"))
    inputs = {
        "uniforms": property(_shader_inputs.uniforms, _shader_inputs.set_uniforms),
        "textures": property(_shader_inputs.textures, _shader_inputs.set_textures),
    }
    for shader in (ShaderMaterial, ImageEffect):
        for name, mapping in inputs.items():
            _attach(shader, name, mapping)
    for camera in (PerspectiveCamera, OrthographicCamera):
        for name in ("yaw", "pitch", "walk", "strafe", "orbit", "look"):
            _attach(camera, name, LateMethod("navigation", name))
    _old_names.answer_old_names()
