"""Live views: explore a scene or a cubemap in a notebook, on a page, in a window or in a terminal.

`scene.show()` and `cube.show()` begin here. The canvases are those of the package rendercanvas, which the extras
`cubecam[viewer]` and `cubecam[jupyter]` install.
"""

from __future__ import annotations

from .viewer import Viewer

__all__ = ["Viewer"]
