"""KHR_materials_variants: other materials for the same primitives, by name."""

from __future__ import annotations

from typing import Any

from ..document import Gltf
from ..entries import Entry

EXTENSION = "KHR_materials_variants"


def variant_names(document: Gltf) -> list[str]:
    """Return the names of the variants, each different from the others."""
    root = document.tree.extension(EXTENSION)
    if root is None:
        return []
    names: list[str] = []
    taken: set[str] = set()
    for number in range(len(root.entries("variants"))):
        entry = root.member("variants", number)
        first = name = entry.text("name") or f"variant {number}"
        count = 1
        while name in taken:
            count += 1
            name = f"{first} {count}"
        taken.add(name)
        names.append(name)
    return names


def variant_materials(document: Gltf, primitive: Entry, count: int) -> dict[int, int]:
    """Return the material of a primitive for each variant that changes it, both as indices."""
    extension = primitive.extension(EXTENSION)
    found: dict[int, int] = {}
    if extension is None:
        return found
    for number in range(len(extension.entries("mappings"))):
        mapping: Any = extension.member("mappings", number)
        material = mapping.index("material", document.count("materials"))
        if material is None:
            raise mapping.error("material", "the index of a material")
        for variant in mapping.indices("variants", count):
            found[variant] = material
    return found
