"""Scenes as files of glTF 2.0: `save_scene`.

`document.py` holds the tree and its bytes, `scene.py` puts it together: nodes, `places.py` for lights and cameras,
`meshes.py`, `materials.py` with `standard.py` and `looks.py`, `pictures.py`, `motion.py` for skins and animations.
`values.py` writes what glTF cannot say.
"""

from __future__ import annotations

from .save import save_scene

__all__ = ["save_scene"]
