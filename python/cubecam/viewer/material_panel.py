"""The controls of a material in groups, with ranges that suit its parameters, and its maps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from .._core import Material, StandardMaterial
from .control import Control
from .panel import Memory, properties

__all__ = ["groups", "maps_shown", "material_controls"]

#: The groups of a StandardMaterial: names of properties, or how they begin. What is in no group stands first.
_GROUPS = {
    "relief": ("normal_", "occlusion_"),
    "emission": ("emissive",),
    "reflection": ("ior", "specular_weight", "specular_map", "specular_color"),
    "clear coat": ("clearcoat",),
    "sheen": ("sheen",),
    "thin film": ("iridescence",),
    "brushed metal": ("anisotropy",),
    "glass": ("transmission", "thickness", "attenuation", "dispersion"),
    "method": ("specular", "multiple_scattering", "unlit"),
}
#: Ranges of sliders: low, high, unit. A property may take numbers outside them.
_RANGES: dict[str, tuple[float, float, str]] = {
    "metallic": (0, 1, ""),
    "roughness": (0, 1, ""),
    "normal_scale": (-2, 2, ""),
    "clearcoat_normal_scale": (-2, 2, ""),
    "ior": (1, 3, ""),
    "iridescence_ior": (1, 3, ""),
    "iridescence_thickness_min": (0, 1200, "nm"),
    "iridescence_thickness_max": (0, 1200, "nm"),
    "anisotropy_rotation": (-180, 180, "degrees"),
    "emissive_strength": (0, 10, ""),
    "dispersion": (0, 1, ""),
}


def material_controls(material: Material) -> tuple[Control, ...]:
    """Make the controls of a material; those of a StandardMaterial have the ranges that its parameters have."""
    controls = properties(material)
    if not isinstance(material, StandardMaterial):
        return controls
    return tuple(_ranged(control) for control in controls)


def _ranged(control: Control) -> Control:
    if control.name not in _RANGES:
        return control
    low, high, unit = _RANGES[control.name]
    today = float(control.get())
    return replace(
        control, low=min(low, today), high=max(high, today), unit=unit, logarithmic=False
    )


def groups(
    material: Material, controls: tuple[Control, ...]
) -> Iterator[tuple[str, tuple[Control, ...]]]:
    """Yield the title and the controls of each group; a material without groups is one, with its class's name."""
    found: dict[str, list[Control]] = {type(material).__name__: []}
    for control in controls:
        title = type(material).__name__
        if isinstance(material, StandardMaterial):
            title = _group(control.name.split(" ")[0]) or title
        found.setdefault(title, []).append(control)
    order = [type(material).__name__, *_GROUPS]
    for title in sorted(found, key=order.index):
        yield title, tuple(found[title])


def _group(name: str) -> str | None:
    for title, starts in _GROUPS.items():
        if any(name == start or (name.startswith(start) and start != "ior") for start in starts):
            return title
    return None


def maps_shown(memory: Memory, material: Material) -> frozenset[str]:
    """Name the maps that have controls: those that the material has, or had when a panel first showed it."""
    kept: dict[int, set[str]] = vars(memory).setdefault("maps", {})
    names = kept.setdefault(id(material), set())
    names |= {name for name in _maps(material) if getattr(material, name) is not None}
    return frozenset(names)


def _maps(material: Any) -> Iterator[str]:
    for name in dir(type(material)):
        if name == "map" or name.endswith("_map"):
            yield name
