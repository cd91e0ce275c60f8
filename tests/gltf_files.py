"""Small glTF files for tests: arrays become accessors, the tree is a plain dict that a test may change."""

import base64
import json
import struct
from typing import Any

import numpy as np

COMPONENTS = {
    "int8": 5120,
    "uint8": 5121,
    "int16": 5122,
    "uint16": 5123,
    "uint32": 5125,
    "float32": 5126,
}
TYPES = {2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}

#: A triangle in the xy plane, and the vertices of a unit square.
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)


class GltfFile:
    """A glTF file under construction: `tree` is its JSON, `binary` its only buffer."""

    def __init__(self, **root):
        self.binary = b""
        self.tree = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], **root}

    def add(self, kind, entry):
        self.tree.setdefault(kind, []).append(entry)
        return len(self.tree[kind]) - 1

    def view(self, data, **entry):
        self.binary += b"\0" * (-len(self.binary) % 4)
        start, self.binary = len(self.binary), self.binary + bytes(data)
        return self.add(
            "bufferViews", {"buffer": 0, "byteOffset": start, "byteLength": len(data), **entry}
        )

    def accessor(self, array, **entry):
        """Store an array: (N,), or (N, 2), (N, 3), (N, 4), (N, 16)."""
        array = np.ascontiguousarray(array)
        if array.dtype == np.float64:
            array = array.astype(np.float32)
        return self.add(
            "accessors",
            {
                "bufferView": self.view(array.tobytes()),
                "componentType": COMPONENTS[array.dtype.name],
                "count": len(array),
                "type": "SCALAR" if array.ndim == 1 else TYPES[array.shape[1]],
                **entry,
            },
        )

    def primitive(self, positions=CORNERS, indices=None, *, mode=None, **attributes):
        """Make a primitive. Attributes are arrays, or numbers of accessors."""
        given = {"POSITION": positions, **attributes}
        entry: dict[str, Any] = {
            "attributes": {
                key: value if isinstance(value, int) else self.accessor(value)
                for key, value in given.items()
            }
        }
        if indices is not None:
            entry["indices"] = indices if isinstance(indices, int) else self.accessor(indices)
        if mode is not None:
            entry["mode"] = mode
        return entry

    def mesh(self, *primitives, **entry):
        return self.add("meshes", {"primitives": list(primitives) or [self.primitive()], **entry})

    def node(self, *, root=True, **entry):
        number = self.add("nodes", entry)
        if root:
            self.tree["scenes"][0]["nodes"].append(number)
        return number

    def glb(self, **changes):
        tree = {**self.tree, **changes}
        if self.binary and "buffers" not in tree:
            tree["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(tree).encode()
        chunks = [(b"JSON", text + b" " * (-len(text) % 4))]
        if self.binary:
            chunks.append((b"BIN\0", self.binary + b"\0" * (-len(self.binary) % 4)))
        return glb_of(*chunks)

    def gltf(self, uri=None):
        """Write JSON alone: the buffer is a data URI, or in the file that `uri` names."""
        if uri is None:
            coded = base64.b64encode(self.binary).decode()
            uri = f"data:application/octet-stream;base64,{coded}"
        buffers = [{"byteLength": len(self.binary), "uri": uri}]
        return json.dumps({**self.tree, "buffers": buffers}).encode()


def glb_of(*chunks, version=2, length=None):
    """Pack chunks, pairs of a type and bytes, into a GLB."""
    body = b"".join(struct.pack("<I4s", len(data), kind) + data for kind, data in chunks)
    return struct.pack("<4sII", b"glTF", version, length or 12 + len(body)) + body


def shown(**mesh):
    """Make a file that shows one mesh of one primitive; what is given goes to `primitive`."""
    file = GltfFile()
    file.node(mesh=file.mesh(file.primitive(**mesh)))
    return file
