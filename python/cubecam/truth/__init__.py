"""The same scene by exact rays, and how far a picture is from it.

`render` and `capture` follow rays through a scene with the materials and lights of the renderer, and `compare` measures
a picture against the result. They need the extra `truth`: ``pip install "cubecam[truth]"``.

>>> import cubecam as cc
>>> scene = cc.Scene(background=(.2, .3, .4))
>>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial())
>>> camera = cc.PerspectiveCamera(position=(0, 0, 3))
>>> exact = cc.truth.render(scene, camera, (16, 16), samples=4)
>>> bool(abs(exact.color[8, 8] - (.2, .3, .4, 1)).max() < 1e-6)
True
"""

from __future__ import annotations

from .drawing import capture, render
from .measures.compare import Comparison, compare
from .pictures import TruthCube, TruthFrame

__all__ = ["Comparison", "TruthCube", "TruthFrame", "capture", "compare", "render"]
