"""Names of types, for annotations in your own code; cubecam's own signatures use them, too.

Every choice is the list of the names that an argument accepts, as a `typing.Literal`, so that type checkers refuse
others and editors complete them.

>>> from cubecam.typing import Tonemap
>>> def curve(name: Tonemap = "neutral") -> dict[str, Tonemap]:
...     return {"tonemap": name}
>>> curve("aces")
{'tonemap': 'aces'}
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, TypedDict

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import SupportsFloat, SupportsIndex

    from ._array_types import Color, FilePixels, Outputs, Pixels
    from ._core import ImageEffect
else:

    def __getattr__(name):
        """Load numpy when a type of arrays is first used; names alone do without."""
        if name in ("Color", "FilePixels", "Outputs", "Pixels"):
            from . import _array_types

            return getattr(_array_types, name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__all__ = [
    "AlphaMode",
    "AnimationPath",
    "BlendEquation",
    "BlendFactor",
    "BlendMode",
    "Center",
    "Color",
    "Compression",
    "ControlsName",
    "Convention",
    "CubeMode",
    "DepthFormat",
    "DepthOrder",
    "Encode",
    "Encoding",
    "Engine",
    "FaceName",
    "Fetches",
    "FileLayout",
    "FilePixels",
    "FisheyeModel",
    "Format",
    "InfluenceShape",
    "Interpolation",
    "Layout",
    "MagFilter",
    "MinFilter",
    "Output",
    "Outputs",
    "Parallax",
    "Pixels",
    "Place",
    "ProbeUpdate",
    "RenderOptions",
    "Sampling",
    "SpecularMode",
    "StencilFunc",
    "StencilOp",
    "StereoLayout",
    "Theme",
    "Tonemap",
    "Wrap",
]

# The tables in C++ list the names as well; scripts/stubs.py reports a list that differs from its table.
AlphaMode: TypeAlias = Literal["opaque", "mask", "blend"]
AnimationPath: TypeAlias = Literal["translation", "rotation", "scale", "weights"]
BlendEquation: TypeAlias = Literal["add", "subtract", "reverse_subtract", "min", "max"]
BlendFactor: TypeAlias = Literal[
    "zero",
    "one",
    "src_color",
    "one_minus_src_color",
    "dst_color",
    "one_minus_dst_color",
    "src_alpha",
    "one_minus_src_alpha",
    "dst_alpha",
    "one_minus_dst_alpha",
    "src_alpha_saturate",
]
Compression: TypeAlias = Literal["zstd", "zlib"]
BlendMode: TypeAlias = Literal[
    "opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied"
]
Center: TypeAlias = Literal["-z", "+z", "+x", "-x"]
ControlsName: TypeAlias = Literal["orbit", "first_person", "fly"]
Convention: TypeAlias = Literal["gl", "inside", "three"]
DepthFormat: TypeAlias = Literal[
    "depth_component16",
    "depth_component24",
    "depth_component32f",
    "depth24_stencil8",
    "depth32f_stencil8",
    "stencil_index8",
]
DepthOrder: TypeAlias = Literal["nearest", "farthest"]
Encode: TypeAlias = Literal["srgb"]
Encoding: TypeAlias = Literal["linear", "srgb"]
Engine: TypeAlias = Literal["three", "babylon", "unity", "godot", "blender", "filament"]
FaceName: TypeAlias = Literal[
    "+x",
    "-x",
    "+y",
    "-y",
    "+z",
    "-z",
    "px",
    "nx",
    "py",
    "ny",
    "pz",
    "nz",
    "pos_x",
    "neg_x",
    "pos_y",
    "neg_y",
    "pos_z",
    "neg_z",
]
Fetches: TypeAlias = Literal[6, 14, 35]
FisheyeModel: TypeAlias = Literal["equidistant", "equisolid", "stereographic", "orthographic"]
Format: TypeAlias = Literal["rgba8", "rgba16f", "rgba32f", "rgb565"]
Interpolation: TypeAlias = Literal["step", "linear", "cubic"]
Layout: TypeAlias = Literal["cross", "vertical_cross", "row", "column", "equirect", "openexr"]
CubeMode: TypeAlias = Literal["cross", "panorama", "look"]
Theme: TypeAlias = Literal["dark", "light"]
MagFilter: TypeAlias = Literal["linear", "nearest"]
MinFilter: TypeAlias = Literal[
    "linear",
    "nearest",
    "linear_mipmap_linear",
    "linear_mipmap_nearest",
    "nearest_mipmap_linear",
    "nearest_mipmap_nearest",
]
Output: TypeAlias = Literal["color", "distance", "normal", "id"]
Place: TypeAlias = Literal["notebook", "page", "window", "terminal", "offscreen"]
Parallax: TypeAlias = Literal["none", "box", "sphere", "distance", "layers"]
InfluenceShape: TypeAlias = Literal["box", "sphere"]
ProbeUpdate: TypeAlias = Literal["on_change", "once", "manual"]
Sampling: TypeAlias = Literal["centers", "borders"]
SpecularMode: TypeAlias = Literal["levels", "sampled"]
StencilFunc: TypeAlias = Literal[
    "never", "less", "equal", "lequal", "greater", "notequal", "gequal", "always"
]
StencilOp: TypeAlias = Literal[
    "keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert"
]
StereoLayout: TypeAlias = Literal["anaglyph", "side_by_side", "top_bottom"]
Tonemap: TypeAlias = Literal["reinhard", "aces", "neutral"]

Wrap: TypeAlias = Literal["repeat", "clamp", "mirror"]

#: A layout of the files of a cubemap: "faces" stands for six files.
FileLayout: TypeAlias = Literal[Layout, "faces"]


class RenderOptions(TypedDict, total=False):
    """The options of `Renderer.render`, for functions that pass them on as ``**options: Unpack[RenderOptions]``."""

    outputs: Iterable[str]
    format: Format | None
    samples: SupportsIndex
    exposure: SupportsFloat | SupportsIndex
    tonemap: Tonemap | None
    encode: Encode | None
    effects: Iterable[ImageEffect]
    depth_format: DepthFormat | None
    screen_reflections: bool
    max_lod_error: SupportsFloat | SupportsIndex
