"""How scenes and functions travel to other processes.

What is defined in the user's script is found there by importing the script, as `multiprocessing` does. What no import
finds, such as a lambda or a function of a notebook, travels by cloudpickle, if it is installed.
"""

from __future__ import annotations

import io
import itertools
import multiprocessing.spawn
import os
import pickle
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

from .._checks import text_of
from .._core import Scene

__all__ = ["Payload", "PayloadKeeper", "check_outside_import", "load", "packed", "packed_function"]

_numbers = itertools.count()

#: Whether this process, a worker, runs the user's script to find what is defined there.
_importing_script = False


class Payload:
    """What workers load once: the bytes, and a name that no other payload has."""

    def __init__(self, data: memoryview, *, reusable: bool = False) -> None:
        self.data, self.reusable = data, reusable
        self.token = f"{os.getpid()}-{next(_numbers)}"


class PayloadKeeper:
    """Keeps the payload of the last scene: as long as the scene shows the same, it is given again."""

    def __init__(self) -> None:
        self._scene: weakref.ref[Scene] | None = None
        self._revision = 0
        self._payload: Payload | None = None

    def packed(self, scene: Scene, revision: int) -> Payload:
        """Give the payload of a scene, of which a batch told the revision."""
        known = self._scene is not None and self._scene() is scene and self._revision == revision
        if self._payload is None or not known:
            self._payload = Payload(_dumped(scene, pickle.dump), reusable=True)
            self._scene, self._revision = weakref.ref(scene), revision
        return self._payload

    def forget(self) -> None:
        """Keep nothing."""
        self._payload = None


def packed(*things: Any) -> Payload:
    """Give the payload of objects that travel together."""
    return Payload(_dumped(things, pickle.dump))


def packed_function(function: Callable[..., Any], name: str) -> Payload:
    """Give the payload of a user's function.

    Raises
    ------
    TypeError
        If the other process could not find the function.
    """
    reason = ""
    in_session = not _script() and getattr(function, "__module__", None) == "__main__"
    if not in_session:
        try:
            data = _dumped(function, pickle.dump)
        except Exception as error:
            reason = f" ({error})"
        else:
            # What a partial or an object holds may be of a notebook, too.
            in_session = not _script() and b"__main__" in bytes(data)
            if not in_session:
                return Payload(data)
    try:
        import cloudpickle
    except ImportError:
        where = "a notebook or an interactive session" if in_session else "it"
        raise TypeError(
            f"{name}: expected a function at the top of a module or script, which other processes "
            f"can import, got {text_of(function)}{reason}; with the package cloudpickle installed, "
            f"functions of {where} work, too"
        ) from None
    try:
        return Payload(_dumped(function, cloudpickle.dump))
    except Exception as error:
        raise TypeError(
            f"{name}: expected a function that can be pickled, got {text_of(function)} ({error})"
        ) from error


def load(data: bytes | bytearray | memoryview) -> Any:
    """Make the objects of a payload."""
    file = io.BytesIO(data)
    process, script = pickle.load(file)
    return _Unpickler(file, script if process != os.getpid() else {}).load()


def check_outside_import() -> None:
    """Raise RuntimeError in a worker that runs the user's script: the script would make workers without end."""
    if _importing_script:
        raise RuntimeError(
            'Pool: expected the script to make it below `if __name__ == "__main__":`, since '
            "worker processes run the script to find make_scene"
        )


class _Unpickler(pickle.Unpickler):
    """Runs the user's script when a name of it is needed."""

    def __init__(self, file: IO[bytes], script: dict[str, str]) -> None:
        super().__init__(file)
        self._script = script

    def find_class(self, module: str, name: str) -> Any:
        global _importing_script
        if module == "__main__" and self._script:
            _importing_script = True
            try:
                multiprocessing.spawn.prepare(self._script)  # once: it knows what it has run
            finally:
                _importing_script = False
        return super().find_class(module, name)


def _script() -> dict[str, str]:
    """Say how the user's script is found: by its path or as a module; empty for notebooks and sessions."""
    found = multiprocessing.spawn.get_preparation_data("cubecam")
    names = ("init_main_from_name", "init_main_from_path")
    script = {name: str(found[name]) for name in names if found.get(name)}
    path = script.get("init_main_from_path")
    return script if path is None or Path(path).exists() else {}  # "<stdin>" is no script


def _dumped(thing: Any, dump: Callable[..., None]) -> memoryview:
    file = io.BytesIO()
    pickle.dump((os.getpid(), _script()), file, protocol=5)
    dump(thing, file, protocol=5)
    return file.getbuffer()
