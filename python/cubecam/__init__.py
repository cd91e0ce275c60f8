"""Headless cubemap renderer: a scene to a cubemap in a numpy array, and mirrors that show it.

>>> import cubecam as cc
>>> scene = cc.Scene(environment=cc.load_environment(cc.sample_data("studio.exr"), size=64))
>>> ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial())
>>> with cc.Renderer() as renderer:
...     cube = renderer.capture(scene, position=(0, 0, 0), size=64, exclude=[ball])
>>> cube.faces.shape
(6, 64, 64, 4)

Conventions (axes, faces, rows, colour, depth) are in docs/conventions.md. The import makes no OpenGL context and loads
no library for files; both happen at their first use.
"""

from __future__ import annotations

from . import _attach, _core
from . import typing as typing
from ._core import *  # noqa: F403 - what _core.__all__ lists, so that a new class is exported at once
from ._core import __version__
from .data import sample_data
from .io.cubemaps import load_cubemap, load_environment
from .io.images import load_image, save_animation, save_image
from .io.meshes import load_mesh
from .io.screen import ClippingWarning, to_screen

__all__ = [
    "ClippingWarning",
    "__version__",
    "load_cubemap",
    "load_environment",
    "load_image",
    "load_mesh",
    "sample_data",
    "save_animation",
    "save_image",
    "to_screen",
]
__all__ += _core.__all__

_attach.attach()
