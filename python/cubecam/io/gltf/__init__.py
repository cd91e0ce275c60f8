"""glTF 2.0: `read` gives the triangles of the default scene, `read_gltf` the document with everything that is in it.

The specification of glTF 2.0 is followed; the numbers of its sections stand in the modules. `container.py` finds the
JSON tree, `references.py` the files it names, `entries.py` checks the types of JSON, `accessors.py` turns bytes into
arrays, `compression.py` decodes Draco and meshopt, `nodes.py` places nodes, `document.py` holds all that together, and
`geometry.py` makes triangles of it.
"""

from __future__ import annotations

from .document import Gltf, read_gltf
from .geometry import Geometry, read

__all__ = ["Geometry", "Gltf", "read", "read_gltf"]
