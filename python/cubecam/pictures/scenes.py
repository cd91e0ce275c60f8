"""Cards of scenes and nodes: a picture, the materials as balls, lights and probes, and the tree of nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from .._core import CubeMap, Material, Mesh, Node, PlanarMirror, Probe, ProbeBlend, Scene
from .cards import Card, Fact, Row, Shot, count, number, shorten, swatch_of, vector
from .describe import animation_text, camera_text, card_of, color_of, light_text, mesh_text
from .studio import BALL, draw_ball, draw_mesh, draw_scene, draw_solid

#: More nodes, balls and lights than these are counted, not listed.
MOST_NODES, MOST_BALLS, MOST_LIGHTS = 50, 12, 20
#: The width of the thumbnail beside a node, pixels.
_SMALL = 48
#: The width of the ball of one of many materials, pixels.
_TILE = 84


@card_of.register
def _(scene: Scene) -> Card:
    nodes, lights = scene.nodes, scene.lights
    materials = _distinct(node.material for node in nodes)
    triangles = sum(len(mesh.indices) for mesh in _meshes(nodes))
    facts = [
        Fact("nodes", f"{len(nodes):,}"),
        Fact("lights", f"{len(lights):,}"),
        Fact("triangles", f"{triangles:,}"),
        _size(scene.bounds),
        _surroundings("environment", scene.environment),
        *_placing(scene),
        _surroundings("background", scene.background),
    ]
    if scene.variants:
        shown = "none" if scene.variant is None else shorten(scene.variant)
        facts.append(Fact("variants", f"{shorten(', '.join(scene.variants))}; shown: {shown}"))
    names = {id(material): f"M{index + 1}" for index, material in enumerate(materials)}
    card = Card(
        "Scene",
        facts,
        picture=lambda: draw_scene(scene),
        tiles=[_tile(material, names) for material in materials[:MOST_BALLS]],
        tiles_title=count(len(materials), "material"),
    )
    if len(materials) > MOST_BALLS:
        card.tiles_title += f", {MOST_BALLS} shown"
    if lights:
        rows = [
            Row(type(light).__name__, light_text(light), swatch=swatch_of(light.color))
            for light in lights[:MOST_LIGHTS]
        ]
        card.lists.append((count(len(lights), "light"), rows + _more(lights, MOST_LIGHTS)))
    if cameras := scene.cameras:
        rows = [Row(type(one).__name__, camera_text(one)) for one in cameras[:MOST_LIGHTS]]
        card.lists.append((count(len(cameras), "camera"), rows + _more(cameras, MOST_LIGHTS)))
    if animations := scene.animations:
        rows = [
            Row(shorten(one.name or "Animation"), animation_text(one))
            for one in animations[:MOST_LIGHTS]
        ]
        more = _more(animations, MOST_LIGHTS)
        card.lists.append((count(len(animations), "animation"), rows + more))
    probes = _distinct(probe for node in nodes for probe in _probes_of(node))
    if probes:
        rows = [Row("Probe", _probe_text(probe)) for probe in probes[:MOST_LIGHTS]]
        card.lists.append((count(len(probes), "probe"), rows + _more(probes, MOST_LIGHTS)))
    if nodes:
        roots = [node for node in nodes if node.parent is None]
        card.lists.append((count(len(nodes), "node"), _tree(roots, len(nodes), names)))
    return card


@card_of.register
def _(node: Node) -> Card:
    facts = [Fact("id", str(node.id))]
    facts += [Fact("name", shorten(node.name))] if node.name else []
    if node.mesh is not None:
        facts.append(Fact("mesh", mesh_text(node.mesh)))
        facts.append(Fact("material", shorten(node.material), color_of(node.material)))
    else:
        facts.append(Fact("mesh", "none: a group"))
    facts.append(Fact("position", vector(node.position)))
    if not np.allclose(node.rotation, (1, 0, 0, 0)):
        facts.append(Fact("rotation", f"quaternion {vector(node.rotation)}"))
    if not np.allclose(node.scale, 1):
        facts.append(Fact("scale", vector(node.scale)))
    facts.append(_size(node.world_bounds))
    if node.environment is not None:
        facts.append(_surroundings("environment", node.environment))
    facts += [Fact("flags", ", ".join(_flags(node)))] if _flags(node) else []
    if node.label or node.render_order:
        facts.append(Fact("label, order", f"{node.label}, {node.render_order}"))
    card = Card("Node", facts, picture=_solid(node))
    below = _tree(node.children, None, {})
    if below:
        card.lists.append((count(len(node.children), "child").replace("childs", "children"), below))
    return card


def _tree(roots: Iterable[Node], total: int | None, names: dict[int, str]) -> list[Row]:
    """List the nodes below the roots, each parent before its children, `MOST_NODES` at most.

    A mesh with a material that came before has no second thumbnail.
    """
    rows: list[Row] = []
    seen: set[tuple[int, int]] = set()
    waiting = [(node, 0) for node in reversed(list(roots))]
    while waiting and len(rows) < MOST_NODES:
        node, depth = waiting.pop()
        pair = (id(node.mesh), id(node.material))
        picture = None if pair in seen else _solid(node, _SMALL)
        seen.add(pair)
        parts = [vector(node.position)]
        if node.mesh is None:
            parts.insert(0, "group")
        else:
            kind = f"{names.get(id(node.material), '')} {_name_of(node.material)}".strip()
            parts[:0] = [mesh_text(node.mesh), kind]
        if isinstance(node.environment, (Probe, ProbeBlend, PlanarMirror)):
            parts.append(type(node.environment).__name__)
        parts += _flags(node)
        label = f"#{node.id}" + (f" {shorten(node.name, 40)}" if node.name else "")
        swatch = "" if node.mesh is None else color_of(node.material)
        rows.append(Row(label, " · ".join(parts), depth, swatch, not node.visible, picture))
        waiting += [(child, depth + 1) for child in reversed(list(node.children))]
    if waiting:
        left = (total - len(rows)) if total is not None else _below(waiting)
        rows.append(Row("", f"… and {left:,} more", faint=True))
    return rows


def _below(waiting: list[tuple[Node, int]]) -> int:
    """Count the nodes that are left and all nodes below them."""
    found = 0
    stack = [node for node, _ in waiting]
    while stack:
        found += 1
        stack += stack.pop().children
    return found


def _solid(node: Node, size: int = BALL) -> Callable[[], Shot] | None:
    mesh, material = node.mesh, node.material
    if mesh is None:
        return None
    if material is None:
        return lambda: draw_mesh(mesh)
    return lambda: draw_solid(mesh, material, size)


def _tile(material: Material, names: dict[int, str]) -> Card:
    return Card(
        f"{names[id(material)]} {_name_of(material)}",
        [Fact("", "", color_of(material))],
        picture=lambda: draw_ball(material, _TILE),
    )


def _name_of(material: Material | None) -> str:
    name = "" if material is None else material.name
    return shorten(name, 40) if name else type(material).__name__


def _distinct(things: Iterable[Any]) -> list[Any]:
    """Keep the first of each object, in order; equal objects that are not the same stay apart."""
    return list({id(thing): thing for thing in things if thing is not None}.values())


def _meshes(nodes: Iterable[Node]) -> Iterable[Mesh]:
    for node in nodes:
        mesh = node.mesh
        if mesh is not None:
            yield mesh


def _more(things: Sequence[Any], most: int) -> list[Row]:
    left = len(things) - most
    return [Row("", f"… and {left:,} more", faint=True)] if left > 0 else []


def _flags(node: Node) -> list[str]:
    flags = {
        "hidden": not node.visible,
        "not in captures": not node.in_captures,
        "casts no shadow": not node.cast_shadow,
        "receives no shadow": not node.receive_shadow,
    }
    return [word for word, holds in flags.items() if holds]


def _probes_of(node: Node) -> tuple[Probe, ...]:
    shown = node.environment
    if isinstance(shown, ProbeBlend):
        return shown.probes
    return (shown,) if isinstance(shown, Probe) else ()


def _probe_text(probe: Probe) -> str:
    return f"{vector(probe.position)}, {probe.size} texels, {probe.format}, update {probe.update}"


def _size(bounds: Any) -> Fact:
    low, high = np.asarray(bounds)
    if not (np.isfinite(low).all() and np.isfinite(high).all()):
        return Fact("size", "none")
    sides = " × ".join(number(side) for side in high - low)
    return Fact("size", f"{sides} units around {vector((low + high) / 2)}")


def _placing(scene: Scene) -> list[Fact]:
    """Say how the environment is shown, where that is not as it is."""
    found = []
    if scene.environment_intensity != 1:
        found.append(Fact("environment intensity", f"{scene.environment_intensity:g}"))
    if scene.environment_rotation[0] != 1:
        found.append(Fact("environment rotation", vector(scene.environment_rotation)))
    return found


def _surroundings(name: str, thing: Any) -> Fact:
    if thing is None:
        return Fact(name, "none")
    if isinstance(thing, (CubeMap, Probe)):
        return Fact(name, f"{type(thing).__name__}, faces of {thing.size} × {thing.size} texels")
    if isinstance(thing, PlanarMirror):
        return Fact(name, f"PlanarMirror, {count(thing.bounces, 'bounce')}")
    if isinstance(thing, ProbeBlend):
        return Fact(name, f"ProbeBlend, {count(len(thing.probes), 'probe')}")
    return Fact(name, vector(thing), swatch_of(thing))
