"""Saved scenes for tests: the tree of a file, and its arrays."""

import json
from pathlib import Path

from cubecam.io.gltf import read_gltf


def tree_of(scene, folder, name="scene.glb"):
    """Save a scene and return its document; `tree.raw` is the JSON."""
    path = Path(folder) / name
    scene.save(path)
    return read_gltf(path)


def raw_of(scene, folder):
    return tree_of(scene, folder).tree.raw


def names_in(tree):
    """Yield the names of all extensions that stand anywhere in a tree."""
    if isinstance(tree, dict):
        yield from tree.get("extensions", {})
        for key, value in tree.items():
            if key != "extras":
                yield from names_in(value)
    elif isinstance(tree, list):
        for value in tree:
            yield from names_in(value)


def without_extras(tree):
    """Return a copy of a tree as a reader sees it that skips extras."""
    if isinstance(tree, dict):
        return {key: without_extras(value) for key, value in tree.items() if key != "extras"}
    return [without_extras(value) for value in tree] if isinstance(tree, list) else tree


def extras_in(tree):
    """Return all extras of cubecam in a tree."""
    text = json.dumps(tree)
    return text.count('"cubecam":')
