"""Files of every kind, broken: each gives a mesh, a picture, a cubemap or a scene, or a documented error."""

from __future__ import annotations

import contextlib
import functools
from pathlib import Path

import numpy as np

import cubecam as cc
from tests.fuzz.mutate import mutated
from tests.fuzz.runner import Target
from tests.fuzz.seeds import seeds

MESHES = ["obj", "mtl", "ply", "stl", "off", "glb", "gltf"]
PICTURES = ["hdr", "pic", "exr", "png", "jpg", "tif", "webp", "bmp", "tga", "gif", "dds", "ktx2"]
#: What the readers raise for files that are broken; a wrong shape of a cubemap is a ValueError.
EXPECTED = (cc.MeshError, cc.ImageError)

#: Shows a library of materials.
OBJ_OF_MTL = b"mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b c\nf 3 2 1\n"


def read(path: Path) -> None:
    """Read a file in every way that the package has for its kind."""
    if path.suffix == ".mtl":
        shape = path.with_suffix(".obj")
        shape.write_bytes(OBJ_OF_MTL % path.name.encode())
        with contextlib.suppress(*EXPECTED):
            cc.load_scene(shape)
        shape.unlink()
        return
    if path.suffix[1:] not in PICTURES:
        with contextlib.suppress(*EXPECTED):
            cc.load_mesh(path)
        with contextlib.suppress(*EXPECTED):
            cc.load_scene(path)
        return
    with contextlib.suppress(*EXPECTED):
        cc.load_image(path)
    with contextlib.suppress(*EXPECTED, ValueError):
        cc.load_cubemap(path, size=8)
    with contextlib.suppress(*EXPECTED, ValueError):
        cc.load_cubemap(path, levels=True)


def broken(kind: str, number: int) -> bytes:
    """Make a broken file; the same number gives the same bytes."""
    files = seeds()[kind]
    rng = np.random.default_rng([number, *kind.encode()])
    return mutated(files[int(rng.integers(len(files)))], rng)


def attempt(kind: str, data: bytes, folder: Path) -> None:
    """Write a file and read it."""
    path = folder / f"a.{kind}"
    path.write_bytes(data)
    read(path)


def target(kind: str) -> Target:
    """Return the target for a kind of file, which is its extension."""
    return Target(
        name=kind,
        make=functools.partial(broken, kind),
        attempt=functools.partial(attempt, kind),
        sound=lambda: seeds()[kind],
        suffix=kind,
    )
