"""The names of cubecam 0.1 that were removed, and errors that give the new names."""

from __future__ import annotations

from typing import Any, NoReturn

from . import _core

__all__ = ["OLD_NAMES", "PICKLED_ARGUMENTS", "answer_old_names", "renamed", "renamed_argument"]

#: Owner and old name: the new name. An owner is a class, for its attributes and the arguments of its constructor, or a
#: method, for its arguments.
OLD_NAMES = {
    "Renderer": {"update": "update_probes", "cubemap": "read_probe", "texture": "read_texture"},
    "Node": {
        "in_probes": "in_captures",
        "casts_shadows": "cast_shadow",
        "receives_shadows": "receive_shadow",
    },
    "Scene.add": {
        "in_probes": "in_captures",
        "casts_shadows": "cast_shadow",
        "receives_shadows": "receive_shadow",
    },
    "GlassMaterial": {"eta": "ior, which is 1 / eta"},
    "MirrorMaterial": {"fresnel": "f0"},
}

#: How many arguments by position the pickles of 0.1 give, for classes that take fewer now.
PICKLED_ARGUMENTS = {
    "Image": 3,
    "Mesh": 5,
    "Stencil": 7,
    "ImageEffect": 3,
    "Shadow": 6,
    "PointLight": 5,
    "SpotLight": 8,
    "DirectionalLight": 4,
    "AmbientLight": 2,
    "Camera": 2,
    "PerspectiveCamera": 7,
    "OrthographicCamera": 6,
    "StereoCamera": 3,
    "Probe": 12,
    "RenderTexture": 9,
}


def renamed(owner: str, name: str) -> str | None:
    """Give the sentence that names the new name of an attribute; None if there never was one of the old name."""
    new = OLD_NAMES.get(owner, {}).get(name)
    return None if new is None else f"{owner}.{name} is now {owner}.{new}"


def renamed_argument(function: str, call: str, name: str) -> str | None:
    """Give the sentence that names the new name of an argument; `call` is the function in messages, as in "add()"."""
    new = OLD_NAMES.get(function, {}).get(name)
    return None if new is None else f"{call}: {name} is now {new}"


class OldName:
    """An attribute with an old name, which raises AttributeError with the new name."""

    def __init__(self, answer: str) -> None:
        self.answer = answer

    def __get__(self, instance: Any, owner: type | None = None) -> NoReturn:
        """Raise AttributeError with the new name."""
        raise AttributeError(self.answer)

    def __set__(self, instance: Any, value: Any) -> NoReturn:
        """Raise AttributeError with the new name."""
        raise AttributeError(self.answer)


def _listed(self: Any) -> list[str]:
    """List the names without the old ones, for completion."""
    old = {name for kind in type(self).__mro__ for name in OLD_NAMES.get(kind.__name__, {})}
    return [name for name in object.__dir__(self) if name not in old or hasattr(self, name)]


def answer_old_names() -> None:
    """Set an `OldName` for each attribute that a class had; called once, when cubecam is imported."""
    for owner, names in OLD_NAMES.items():
        kind = getattr(_core, owner, None)
        if not isinstance(kind, type):
            continue
        for name in names:
            if not hasattr(kind, name):
                setattr(kind, name, OldName(renamed(owner, name) or ""))
                kind.__dir__ = _listed  # type: ignore[assignment, method-assign]
