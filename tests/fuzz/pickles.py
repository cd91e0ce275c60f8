"""Broken pickles: the states of all classes with parts changed, and the bytes of whole pickles.

A case says how it is made: `state CLASS NUMBER` or `bytes CLASS NUMBER`. States go to `__setstate__` and to the function
that the pickle names; they may raise what absurd arguments may (world.EXPECTED). The bytes of a pickle are read by an
unpickler that finds only names of cubecam and numpy; what Python's own pickle raises for broken bytes is no fault, but
SystemError, a crash, a hang and memory are.
"""

from __future__ import annotations

import copy
import functools
import io
import pickle
import pickletools
from pathlib import Path
from typing import Any

import numpy as np

import cubecam as cc
from tests.fuzz import hostile
from tests.fuzz.mutate import mutated
from tests.fuzz.runner import Target
from tests.fuzz.world import World, draw, expected, use

#: The objects whose pickles are broken: names of attributes of World.
THINGS = [
    "cube", "image", "scene", "mesh", "target", "texture", "basic", "phong", "mirror", "glass", "standard", "shader",
    "effect", "shadow", "point", "spot", "sun", "ambient", "probe", "grid", "skin", "bent", "node", "camera", "flat", "matrices",
    "stereo", "screen", "channel", "animation", "blend", "stencil", "frame",
]  # fmt: skip
#: What else Python's pickle may raise for broken bytes.
UNPICKLING = (
    pickle.UnpicklingError,
    EOFError,
    ImportError,
    OverflowError,
    MemoryError,
    AssertionError,
    UnicodeError,
)


class Unpickler(pickle.Unpickler):
    """Finds the names that cubecam's pickles hold, and no others."""

    def find_class(self, module: str, name: str) -> Any:
        """Find a name of cubecam, numpy's arrays, or copyreg."""
        if module.split(".")[0] in ("cubecam", "numpy") and name in NAMES:
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"{module}.{name} is not among the names of these pickles")


@functools.cache
def _pickles() -> dict[str, bytes]:
    world = World()
    return {name: pickle.dumps(getattr(world, name), 4) for name in THINGS}


@functools.cache
def _names() -> frozenset[str]:
    """All names of classes and functions that the sound pickles hold."""
    found = set()
    for data in _pickles().values():
        words = [
            argument for _, argument, _ in pickletools.genops(data) if isinstance(argument, str)
        ]
        found |= {word for word in words if word.isidentifier()}
    return frozenset(found)


class _Names:
    def __contains__(self, name: str) -> bool:
        return name in _names()


NAMES = _Names()


def _changed(value: Any, rng: np.random.Generator, names: dict[str, Any]) -> Any:
    """A copy of a state in which one part is something else."""
    if isinstance(value, (tuple, list)) and len(value) and rng.random() < 0.85:
        items = list(value)
        place = int(rng.integers(len(items)))
        way = rng.random()
        if way < 0.1:
            del items[place]
        elif way < 0.2:
            items.insert(place, items[place])
        elif way < 0.3:
            other = int(rng.integers(len(items)))
            items[place], items[other] = items[other], items[place]
        else:
            items[place] = _changed(items[place], rng, names)
        return type(value)(items) if type(value) in (tuple, list) else items
    if isinstance(value, dict) and value and rng.random() < 0.85:
        made = dict(value)
        key = list(made)[rng.integers(len(made))]
        if rng.random() < 0.2:
            del made[key]
        elif rng.random() < 0.2:
            made[hostile.HostileError] = 1
        else:
            made[key] = _changed(made[key], rng, names)
        return made
    if isinstance(value, np.ndarray) and value.size and rng.random() < 0.6:
        flat = np.array(value)
        place = int(rng.integers(flat.size))
        with np.errstate(all="ignore"):
            worst = [np.nan, np.inf, -1, 2**31 - 1, 1e30]
            flat.flat[place] = np.array(worst[rng.integers(len(worst))]).astype(flat.dtype)
        return flat if rng.random() < 0.7 else flat[..., :-1]
    if isinstance(value, int) and rng.random() < 0.4:
        return value + int(rng.choice([-1, 1, 1000, 2**31, 2**40]))
    if isinstance(value, bytes) and rng.random() < 0.6:
        return mutated(value, rng)
    text = hostile.VALUES[rng.integers(len(hostile.VALUES))]
    return eval(text, names)


def _restore(thing: Any, rng: np.random.Generator, world: World) -> Any:
    """Make an object as pickle does, from what `__reduce_ex__` returns, with a part that is changed."""
    names = {
        "cc": cc, "np": np, "w": world, "hostile": hostile, "nan": hostile.NAN, "inf": hostile.INF, "Path": Path,
    }  # fmt: skip
    function, arguments, *rest = thing.__reduce_ex__(4)
    state = rest[0] if rest else None
    if state is None or (rng.random() < 0.5 and arguments):
        first = arguments[:1] if arguments and isinstance(arguments[0], type) else ()
        rest_of_them = _changed(arguments[len(first) :], rng, names)
        arguments = (
            *first,
            *(rest_of_them if isinstance(rest_of_them, tuple) else (rest_of_them,)),
        )
    else:
        state = _changed(state, rng, names)
    made = function(*arguments)
    if state is not None and hasattr(made, "__setstate__"):
        made.__setstate__(state)
    return made


def make(number: int) -> bytes:
    """Write which pickle is broken, and how."""
    rng = np.random.default_rng([number, 6])
    way = "state" if rng.random() < 0.7 else "bytes"
    return f"{way} {THINGS[rng.integers(len(THINGS))]} {number}".encode()


def attempt(case: bytes, folder: Path) -> None:
    """Restore an object, and use it if that succeeds."""
    way, name, number = case.decode().split()
    rng = np.random.default_rng([int(number), 7])
    world = World()
    made = None
    if way == "state":
        for _ in range(4):
            with expected():
                made = _restore(getattr(world, name), rng, world)
            if made is not None:
                use(made, world)
                with expected():
                    copy.deepcopy(made)
    else:
        for _ in range(8):
            data = mutated(_pickles()[name], rng)
            try:
                made = Unpickler(io.BytesIO(data)).load()
            except RecursionError:
                raise
            except (*UNPICKLING, Exception) as error:
                if isinstance(error, (SystemError, RuntimeError)) and not isinstance(
                    error, cc.Error
                ):
                    raise
                continue
            use(made, world)
    if made is not None:
        draw(world, int(number))


TARGET = Target(
    name="pickles",
    make=make,
    attempt=attempt,
    sound=lambda: [f"state {name} 0".encode() for name in THINGS],
    seconds=10.0,
    memory=1200 << 20,
)
