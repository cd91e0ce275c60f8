"""The hash of a scene's contents: what tells whether two scenes, in any two processes, are the same."""

from __future__ import annotations

import hashlib
import operator
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._checks import text_of
from ._core import Camera, Light, Node, PlanarMirror, Probe, ProbeBlend, RenderTexture, Scene

__all__ = ["scene_hash"]

#: What may lead back to itself, or belong to several others: it is described where it is met first, and is a number
#: afterwards. Everything else is a value, which is described wherever it is met.
_NUMBERED = (Scene, Node, Probe, ProbeBlend, PlanarMirror, RenderTexture, Light, Camera)


@checked_call
def scene_hash(scene: Scene) -> str:
    """Give the hash of all that a scene holds.

    Two scenes have one hash if they were made alike: in this process or in another, today or in a later run, as
    originals or as copies by `copy.deepcopy` or pickle. Everything counts that a pickle keeps: nodes with their ids,
    places and names, meshes, materials with their pictures, lights, environments, probes, what render textures show,
    animations and variants. What a renderer has drawn for a probe does not count, and neither does whether two nodes
    share a mesh or a material, or have equal ones. Objects of subclasses count as those of the class of cubecam.

    Parameters
    ----------
    scene : Scene
        The scene, as it is now.

    Returns
    -------
    str
        SHA-256 (FIPS 180-4), 64 hexadecimal digits. Another version of cubecam may give the same scene another hash.

    Raises
    ------
    TypeError
        For another object.

    Examples
    --------
    >>> import cubecam as cc
    >>> def make(color):
    ...     scene = cc.Scene()
    ...     scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color=color))
    ...     return scene
    >>> cc.scene_hash(make("red")) == cc.scene_hash(make("red"))
    True
    >>> cc.scene_hash(make("red")) == cc.scene_hash(make("blue"))
    False
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: expected a Scene, got {text_of(scene)}")
    digest = hashlib.sha256(b"cubecam scene 1;")
    digest.update(_Description().of(scene))
    return digest.hexdigest()


class _Description:
    """Bytes that describe objects by what their pickles hold; each piece begins with its kind and its length.

    A pickle itself would not do: what is shared in it depends on how Python keeps equal texts and numbers.
    """

    def __init__(self) -> None:
        self._numbers: dict[int, int] = {}  # of objects, by `id`
        self._values: dict[int, bytes] = {}  # descriptions of values that hold nothing numbered
        self._kept: list[Any] = []  # objects whose `id` must stay theirs
        self._met = 0  # how many numbered objects were met so far, again or for the first time

    def of(self, thing: Any) -> bytes:
        """Describe anything that the state of a pickle may hold."""
        if thing is None or thing is True or thing is False:
            return f"{thing};".encode()
        if type(thing) is str:
            return _piece(b"s", thing.encode("utf-8", "surrogatepass"))
        if type(thing) is bytes:
            return _piece(b"b", thing)
        if isinstance(thing, np.ndarray):
            return _array(thing)
        if isinstance(thing, (bool, np.bool_)):
            return f"{bool(thing)};".encode()
        if isinstance(thing, (int, np.integer)):
            return f"i{int(thing)};".encode()
        if isinstance(thing, (float, np.floating)):
            return b"f" + struct.pack("<d", float(thing))
        if isinstance(thing, (tuple, list)):
            return _piece(b"l", b"".join(map(self.of, thing)))
        if isinstance(thing, dict):
            rows = sorted((self.of(key), self.of(thing[key])) for key in sorted(thing))
            return _piece(b"d", b"".join(key + value for key, value in rows))
        return self._object(thing)

    def _object(self, thing: Any) -> bytes:
        known = self._values.get(id(thing))
        if known is not None:
            return known
        if isinstance(thing, _NUMBERED):
            self._met += 1
            number = self._numbers.get(id(thing))
            if number is not None:
                return f"n{number};".encode()
            self._numbers[id(thing)] = len(self._numbers)
        self._kept.append(thing)
        before = self._met
        made = _piece(b"o", self._contents(thing))
        if self._met == before and not isinstance(thing, _NUMBERED):
            # Of meshes and pictures, which many nodes share, only the digest is kept.
            made = _piece(b"h", hashlib.sha256(made).digest())
            self._values[id(thing)] = made
        return made

    def _contents(self, thing: Any) -> bytes:
        function, arguments, *states = thing.__reduce__()
        classes = (base for base in type(thing).__mro__ if base.__module__ == "cubecam")
        parts = [
            next(classes).__name__,
            *(part for part in arguments if not isinstance(part, type)),
        ]
        if isinstance(function, operator.methodcaller):  # of nodes and of channels of animations
            parts += function.__reduce__()[1]
        return self.of([*parts, *states])


def _piece(kind: bytes, contents: bytes) -> bytes:
    return b"%s%d:%s" % (kind, len(contents), contents)


def _array(array: npt.NDArray[Any]) -> bytes:
    little = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
    return _piece(b"a", f"{little.dtype.str}{array.shape};".encode() + little.tobytes())
