"""Cards of meshes, materials, lights, probes, cameras and renderers. Nothing here changes an object."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np

from .. import _core
from .._core import (
    AmbientLight,
    Animation,
    BasicMaterial,
    Camera,
    DirectionalLight,
    ImageEffect,
    Light,
    Material,
    Mesh,
    OrthographicCamera,
    PerspectiveCamera,
    PlanarMirror,
    PointLight,
    Probe,
    ProbeBlend,
    ProbeGrid,
    Renderer,
    RenderTexture,
    SpotLight,
    StereoCamera,
)
from . import diagrams
from .cards import Card, Fact, Row, count, number, shorten, swatch_of, vector
from .studio import draw_ball, draw_mesh

__all__ = ["animation_text", "camera_text", "card_of", "color_of", "light_text", "mesh_text"]

#: More channels than these are counted, not listed.
MOST_CHANNELS = 20
#: The same for the probes of a blend.
MOST_PROBES = 20

_UNITS = {
    "fov": "°",
    "angle": "°",
    "near": " units",
    "far": " units",
    "height": " units",
    "extent": " units",
    "radius": " texels",
    "milliseconds": " ms",
    "size": " texels",
}
_PLACES = ("position", "target", "direction", "up")


@functools.singledispatch
def card_of(thing: Any) -> Card:
    """Describe an object by all its properties; `scenes` and the functions below know more of some classes."""
    return Card(_title(thing), _facts(thing, _properties(type(thing))))


@card_of.register
def _(mesh: Mesh) -> Card:
    low, high = (np.asarray(corner) for corner in mesh.bounds)
    facts = [
        Fact("vertices", f"{len(mesh.positions):,}"),
        Fact("triangles", f"{len(mesh.indices):,}"),
        Fact("size", " × ".join(number(side) for side in high - low) + " units"),
        Fact("bounds", f"{vector(low)} to {vector(high)}"),
    ]
    has = [
        name
        for name in ("normals", "uvs", "uvs1", "colors", "tangents")
        if getattr(mesh, name) is not None
    ]
    facts.append(Fact("per vertex", ", ".join(["positions", *has])))
    if mesh.levels:
        counts = [f"{len(indices):,}" for indices, _ in mesh.levels]
        facts.append(Fact("levels", ", ".join(counts) + " triangles"))
    return Card("Mesh", facts, picture=lambda: draw_mesh(mesh))


@card_of.register
def _(material: Material) -> Card:
    own = [name for name in _properties(type(material)) if name not in vars(Material)]
    usual = BasicMaterial()
    options = [name for name in _properties(Material) if not _same(material, usual, name)]
    facts = _facts(material, [name for name in own if getattr(material, name) is not None])
    facts += _facts(material, options)
    return Card(_title(material), facts, picture=lambda: draw_ball(material))


@card_of.register
def _(light: Light) -> Card:
    own = [name for name in _properties(type(light)) if name not in vars(Light)]
    own = [name for name in own if name not in _plain(light)]
    card = Card(_title(light), _facts(light, ["color", "intensity", *own]))
    shown = swatch_of(light.color)
    if isinstance(light, SpotLight):
        card.diagram = diagrams.ray(light.direction, shown, light.angle)
    elif isinstance(light, DirectionalLight):
        card.diagram = diagrams.ray(light.direction, shown)
    elif isinstance(light, (PointLight, AmbientLight)):
        card.diagram = diagrams.lamp(shown, rays=isinstance(light, PointLight))
    return card


@card_of.register
def _(probe: Probe) -> Card:
    card = Card("Probe", _facts(probe, _properties(Probe)))
    card.diagram = diagrams.cross(probe.size)
    return card


@card_of.register
def _(mirror: PlanarMirror) -> Card:
    return Card("PlanarMirror", _facts(mirror, _properties(PlanarMirror)))


@card_of.register
def _(blend: ProbeBlend) -> Card:
    rows = [Row(f"Probe {i}", shorten(probe)) for i, probe in enumerate(blend.probes[:MOST_PROBES])]
    more = len(blend.probes) - len(rows)
    rows += [Row(f"and {more} more", "")] if more else []
    return Card("ProbeBlend", [], lists=[(count(len(blend.probes), "probe"), rows)])


@card_of.register
def _(grid: ProbeGrid) -> Card:
    names = ["box", "counts", "size", "resolution", "visibility", "normal_bias", "view_bias"]
    facts = _facts(grid, names)
    facts.append(Fact("active", f"{int(grid.active.sum()):,} of {grid.active.size:,} nodes"))
    return Card("ProbeGrid", facts)


@card_of.register
def _(camera: PerspectiveCamera) -> Card:
    names = ["fov", "near", "far", "position", "target", "up"]
    names += ["shift"] if any(camera.shift) else []
    names += ["pixel_aspect"] if camera.pixel_aspect != 1 else []
    card = Card("PerspectiveCamera", _facts(camera, names))
    card.diagram = diagrams.frustum(camera.fov, float(camera.shift[1]))
    return card


@card_of.register
def _(camera: OrthographicCamera) -> Card:
    names = ["height", "near", "far", "position", "target", "up"]
    card = Card("OrthographicCamera", _facts(camera, names))
    card.diagram = diagrams.slab(camera.height)
    return card


@card_of.register
def _(camera: Camera) -> Card:
    view = np.asarray(camera.view)
    place = -view[:3, :3].T @ view[:3, 3]
    facts = [Fact("position", vector(place)), Fact("looks along", vector(-view[2, :3]))]
    facts += [Fact("view", _value("view", view))]
    return Card("Camera", facts, note="a view and a projection, given as matrices")


@card_of.register
def _(camera: StereoCamera) -> Card:
    facts = [Fact("layout", camera.layout)]
    facts += [Fact(name, shorten(getattr(camera, name))) for name in ("left", "right")]
    places = [getattr(eye, "position", None) for eye in (camera.left, camera.right)]
    if places[0] is not None and places[1] is not None:
        apart = float(np.linalg.norm(np.subtract(places[0], places[1])))
        facts.append(Fact("separation", f"{number(apart)} units"))
    return Card("StereoCamera", facts, diagram=diagrams.eyes())


@card_of.register
def _(texture: RenderTexture) -> Card:
    width, height = texture.size
    facts = [Fact("size", f"{width} × {height} texels")]
    facts += _facts(texture, [name for name in _properties(RenderTexture) if name != "size"])
    return Card("RenderTexture", facts)


@card_of.register
def _(effect: ImageEffect) -> Card:
    return Card("ImageEffect", _facts(effect, _properties(ImageEffect)))


@card_of.register
def _(info: _core.RendererInfo) -> Card:
    names = [n for n in _properties(_core.RendererInfo) if n not in ("limits", "device")]
    card = Card("RendererInfo", _facts(info, names))
    card.facts += [Fact("device", f"{info.device.index}: {info.device.name}")]
    card.facts += [
        Fact(name.replace("_", " "), f"{getattr(info.limits, name):,}")
        for name in _properties(_core.Limits)
    ]
    return card


@card_of.register
def _(renderer: Renderer) -> Card:
    if renderer.closed:
        return Card("Renderer", note="closed")
    info = renderer.info
    facts = [
        Fact("renderer", info.renderer),
        Fact("kind", "software" if info.software else "GPU"),
        Fact("OpenGL", info.version),
        Fact("all views in one call", _value("", info.layered)),
    ]
    stats = _facts(renderer.stats, _properties(_core.Stats))
    return Card("Renderer", facts + stats)


def color_of(material: Material | None) -> str:
    """Give the "#rrggbb" that stands for a material, or "" for one without a colour of its own."""
    # A mirror adds its own colour by a weight, which is 0 unless somebody sets it.
    names = ("color", "tint") if getattr(material, "color_weight", 1) > 0 else ("tint",)
    for name in names:
        color = getattr(material, name, None)
        if color is not None and not isinstance(color, str):
            return swatch_of(color)
    return ""


def light_text(light: Light) -> str:
    """Describe a light in one line, without its colour."""
    parts = [f"{name} {vector(getattr(light, name))}" for name in _PLACES if hasattr(light, name)]
    parts.append(f"intensity {number(light.intensity)}")
    if getattr(light, "range", np.inf) != np.inf:
        parts.append(f"range {number(light.range)}")  # type: ignore[attr-defined]
    parts += _on_parent(light)
    if getattr(light, "shadow", None) is not None:
        parts.append("with shadow")
    return ", ".join(parts)


def camera_text(camera: Camera) -> str:
    """Describe a camera in one line."""
    parts = [
        f"{name} {number(getattr(camera, name))}{_UNITS[name]}"
        for name in ("fov", "height")
        if hasattr(camera, name)
    ]
    for name in ("position", "target"):
        place = getattr(camera, name, None)
        parts += [] if place is None else [f"{name} {vector(place)}"]
    return ", ".join([*(parts or ["given by its matrices"]), *_on_parent(camera)])


def animation_text(animation: Animation) -> str:
    """Describe an animation in one line."""
    nodes = {id(channel.node): channel.node for channel in animation.channels}
    channels = count(len(animation.channels), "channel")
    return f"{number(animation.duration)} s, {channels} of {count(len(nodes), 'node')}"


def _keys(number_of_keys: int) -> str:
    return "1 key" if number_of_keys == 1 else f"{number_of_keys:,} keys"


def _on_parent(thing: Any) -> list[str]:
    parent = getattr(thing, "parent", None)
    return [] if parent is None else [f"on node #{parent.id} {shorten(parent.name, 40)}".strip()]


def _plain(thing: Any) -> set[str]:
    """Name the properties that say nothing more: places in the world without a parent, and no range."""
    plain: set[str] = set()
    if getattr(thing, "parent", None) is None:
        plain |= {"parent", "world_position", "world_direction"}
    if getattr(thing, "range", None) == np.inf:
        plain.add("range")
    return plain


@card_of.register
def _(animation: Animation) -> Card:
    facts = [Fact("name", shorten(animation.name))] if animation.name else []
    facts.append(Fact("duration", f"{number(animation.duration)} s"))
    facts.append(Fact("channels", str(len(animation.channels))))
    card = Card("Animation", facts)
    rows = [
        Row(
            "gone"
            if channel.node is None
            else f"#{channel.node.id} {shorten(channel.node.name, 40)}",
            f"{channel.path}, {_keys(len(channel.times))}, {channel.interpolation}",
        )
        for channel in animation.channels[:MOST_CHANNELS]
    ]
    left = len(animation.channels) - len(rows)
    rows += [Row("", f"… and {left:,} more", faint=True)] if left else []
    if rows:
        card.lists.append((count(len(animation.channels), "channel"), rows))
    return card


def mesh_text(mesh: Mesh) -> str:
    """Describe a mesh in a few words."""
    return count(len(mesh.indices), "triangle")


def _title(thing: Any) -> str:
    return type(thing).__name__


def _properties(kind: type) -> list[str]:
    """List the properties of a class, those of its own first, in the order of their definition."""
    names: dict[str, None] = {}
    for owner in kind.__mro__:
        for name, value in vars(owner).items():
            if isinstance(value, property) and not name.startswith("_"):
                names.setdefault(name)
    return list(names)


def _same(a: Any, b: Any, name: str) -> bool:
    first, second = getattr(a, name), getattr(b, name)
    return first is second or bool(first == second)


def _facts(thing: Any, names: list[str]) -> list[Fact]:
    facts = []
    for name in names:
        try:
            value = getattr(thing, name)
        except Exception as error:
            facts.append(Fact(_words(name), shorten(error)))
            continue
        colored = name in ("color", "tint") and isinstance(value, np.ndarray)
        facts.append(Fact(_words(name), _value(name, value), swatch_of(value) if colored else ""))
    return facts


def _words(name: str) -> str:
    return name.replace("_", " ")


def _value(name: str, value: Any) -> str:
    """Write a property's value in one line, with its unit."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int) and name == "samples":
        return str(value)
    if isinstance(value, (int, float)):
        text = f"{value:,}" if isinstance(value, int) else number(value)
        return text + _UNITS.get(name, "")
    if name in ("fragment", "vertex"):
        lines = str(value).strip().splitlines()
        return shorten(lines[0]) if len(lines) == 1 else count(len(lines), "line")
    if isinstance(value, np.ndarray) and value.ndim == 1:
        return vector(value)
    if isinstance(value, np.ndarray):
        return " × ".join(str(side) for side in value.shape) + f" {value.dtype.name}"
    if isinstance(value, (list, tuple)) and value and name not in ("size", "shift"):
        return count(len(value), {"exclude": "node"}.get(name, name.rstrip("s") or "item"))
    if isinstance(value, (list, tuple)):
        return vector(value) if value else "none"
    if hasattr(value, "items"):
        return shorten(", ".join(f"{k}: {_value('', v)}" for k, v in value.items()) or "none", 240)
    return shorten(value)
