"""Headless cubemap renderer: a scene to a cubemap in a numpy array, and mirrors that show it.

>>> import cubecam as cc
>>> scene = cc.Scene(environment=cc.load_environment(cc.sample_data("studio.exr"), size=64))
>>> ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial())
>>> with cc.Renderer() as renderer:
...     cube = renderer.capture(scene, position=(0, 0, 0), size=64, exclude=[ball])
>>> cube.faces.shape
(6, 64, 64, 4)

Conventions (axes, faces, rows, colour, depth) are in docs/conventions.md. The import makes no OpenGL context and loads
neither numpy nor a library for files; each happens at its first use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

try:
    from . import _core
except ImportError as _error:  # the module is missing, or does not fit the system
    from .doctor.broken import refuse

    refuse(_error)

from . import _attach
from . import typing as typing
from ._core import *  # noqa: F403 - what _core.__all__ lists, so that a new class is exported at once
from ._core import __version__
from ._late import late_names

if TYPE_CHECKING:
    from . import cluster, doctor, explore, plot, truth
    from ._futures import PictureFuture
    from ._scene_hash import scene_hash
    from ._warnings import ConventionWarning, RendererWarning, SceneWarning
    from .batches.captures import capture_scenes
    from .batches.cubemaps import CubeMapBatch
    from .batches.frames import FrameBatch
    from .batches.store import open_batch
    from .data import sample_data
    from .io.cubemaps import load_cubemap, load_environment
    from .io.images import load_image, save_animation, save_image
    from .io.meshes.load import load_mesh
    from .io.scenes import load_scene
    from .io.screen import ClippingWarning, to_screen
    from .optics import brdf, fresnel, reflect, refract, schlick
    from .pool.pool import Pool
    from .viewer.viewer import Viewer
else:
    # What is written in Python needs numpy, which takes more time to load than the core: `cubecam info` does without.
    __getattr__, __dir__ = late_names(
        {
            "_futures": ["PictureFuture"],
            "_scene_hash": ["scene_hash"],
            "_warnings": ["ConventionWarning", "RendererWarning", "SceneWarning"],
            "batches.captures": ["capture_scenes"],
            "batches.cubemaps": ["CubeMapBatch"],
            "batches.frames": ["FrameBatch"],
            "batches.store": ["open_batch"],
            "data": ["sample_data"],
            "io.cubemaps": ["load_cubemap", "load_environment"],
            "io.images": ["load_image", "save_animation", "save_image"],
            "io.meshes.load": ["load_mesh"],
            "io.scenes": ["load_scene"],
            "io.screen": ["ClippingWarning", "to_screen"],
            "optics": ["brdf", "fresnel", "reflect", "refract", "schlick"],
            "pool.pool": ["Pool"],
            "viewer.viewer": ["Viewer"],
        },
        modules=[
            "cluster",
            "demo",
            "doctor",
            "examples",
            "explore",
            "io",
            "navigation",
            "pictures",
            "plot",
            "truth",
            "typing",
            "viewer",
        ],
    )

__all__ = [
    "ClippingWarning",
    "ConventionWarning",
    "CubeMapBatch",
    "FrameBatch",
    "PictureFuture",
    "Pool",
    "RendererWarning",
    "SceneWarning",
    "Viewer",
    "__version__",
    "brdf",
    "capture_scenes",
    "cluster",
    "doctor",
    "explore",
    "fresnel",
    "load_cubemap",
    "load_environment",
    "load_image",
    "load_mesh",
    "load_scene",
    "open_batch",
    "plot",
    "reflect",
    "refract",
    "sample_data",
    "save_animation",
    "save_image",
    "scene_hash",
    "schlick",
    "to_screen",
    "truth",
]
__all__ += _core.__all__

_attach.attach()
