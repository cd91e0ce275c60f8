"""The classes whose objects may stand in `extras.cubecam`, and the properties of which each consists.

Both directions follow this table: what is written, and what a file may set. A name that is not here is refused. Each
value goes through the constructor or the setter that users call, and is checked there.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .... import _core

#: The key in `extras`, and the number of what stands there. Files of another number are read as plain glTF.
KEY = "cubecam"
FORMAT = 1


@dataclass(frozen=True)
class Plan:
    """A class: `made` are arguments of its constructor; `later` is set when all objects are there.

    What may lead back to the object itself, such as the nodes that a probe leaves out, must be in `later`.
    """

    kind: type[Any]
    made: tuple[str, ...]
    later: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        return self.made + self.later


#: The parts of a cubemap's pickle, in their order.
CUBE = ("faces", "mipmaps", "outputs", "encoding", "levels")
_LIGHT = ("color", "intensity")
_PLACED = ("position", "target", "up", "near", "far")

#: Objects that have no entry of glTF, and the lights and cameras, whose entries lack some properties.
PLANS = {
    plan.kind.__name__: plan
    for plan in (
        Plan(_core.Blend, ("src", "dst", "src_alpha", "dst_alpha", "equation")),
        Plan(
            _core.Stencil,
            ("func", "reference", "read_mask", "write_mask", "fail", "depth_fail", "depth_pass"),
        ),
        Plan(_core.Shadow, ("size", "radius", "bias", "near", "far", "extent")),
        Plan(_core.Texture, ("source", "uv_set", "offset", "rotation", "scale")),
        Plan(
            _core.Image, ("pixels", "mipmaps", "wrap", "encoding", "mag_filter", "min_filter")
        ),
        Plan(_core.CubeMap, CUBE),
        Plan(
            _core.MorphTarget,
            ("positions", "normals", "tangents", "uvs", "uvs1", "colors", "name"),
        ),
        Plan(
            _core.Probe,
            (
                "position", "size", "near", "far", "format", "mipmaps", "samples", "update",
                "faces_per_frame", "depth_format", "prefilter", "parallax", "box", "proxy_matrix",
                "fetches", "bounces", "influence", "influence_shape", "blend_distance",
            ),
            ("parent", "exclude"),
        ),
        Plan(_core.PlanarMirror, ("bounces", "distance")),
        Plan(_core.ProbeBlend, ("probes",)),
        Plan(
            _core.ProbeGrid,
            ("box", "counts", "size", "resolution", "visibility", "normal_bias", "view_bias"),
            ("coefficients", "distances", "active"),
        ),
        Plan(
            _core.RenderTexture,
            (
                "scene", "camera", "size", "format", "samples", "mipmaps", "wrap", "name",
                "depth_format",
            ),
            ("exclude", "effects"),
        ),
        Plan(_core.ImageEffect, ("fragment", "uniforms"), ("textures",)),
        Plan(_core.Camera, ("view", "projection")),
        Plan(_core.PerspectiveCamera, ("fov", *_PLACED, "shift", "pixel_aspect"), ("parent",)),
        Plan(_core.OrthographicCamera, ("height", *_PLACED), ("parent",)),
        Plan(_core.AmbientLight, _LIGHT),
        Plan(_core.PointLight, ("position", *_LIGHT, "decay", "range", "shadow"), ("parent",)),
        Plan(
            _core.SpotLight,
            ("position", "direction", "angle", "penumbra", *_LIGHT, "decay", "range", "shadow"),
            ("parent",),
        ),
        Plan(_core.DirectionalLight, ("direction", *_LIGHT, "shadow"), ("parent",)),
    )
}  # fmt: skip

#: Properties of an entry's object that glTF has no word for.
NODE = ("in_captures", "render_order", "cast_shadow", "receive_shadow", "label", "environment")
MESH = ("normals", "uvs", "colors", "uvs1", "tangents")
SCENE = (
    "background",
    "environment",
    "environment_intensity",
    "environment_rotation",
    "probe_grid",
)

#: The properties of a ShaderMaterial that its constructor does not need.
_SHADER = ("vertex", "uniforms", "textures", "displacement")


@functools.cache
def materials() -> dict[str, type[Any]]:
    """Return the kinds of materials by name; a new kind needs no line here."""
    return {
        name: kind
        for name, kind in vars(_core).items()
        if isinstance(kind, type)
        and issubclass(kind, _core.Material)
        and kind is not _core.Material
    }


@functools.cache
def material_names(kind: Callable[..., Any]) -> tuple[str, ...]:
    """Return the properties of a kind of material: those that its pickles hold."""
    if kind is _core.ShaderMaterial:
        surface = _core.ShaderMaterial("vec3 shade(Surface s) { return vec3(0.0); }")
        return ("fragment", *_SHADER, *state_of(surface)[5])
    return tuple(state_of(kind()))


def state_of(thing: object) -> Any:
    """Return the state of an object in its pickle."""
    reduced: Any = thing.__reduce__()
    return reduced[2][1]


def arguments_of(thing: object) -> Any:
    """Return the arguments of the constructor in an object's pickle."""
    reduced: Any = thing.__reduce__()
    return reduced[1][2]


def blank(kind: type[Any], fragment: str) -> Any:
    """Make a material of a kind with default properties; `fragment` is the source that a ShaderMaterial cannot lack."""
    return kind(fragment) if kind is _core.ShaderMaterial else kind()
