"""`__setstate__` of anything: an object, TypeError or ValueError. Other errors would show how pickles are read."""

import contextlib
import pickle
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.fuzz.pickles import THINGS
from tests.fuzz.world import World

DEEP: list[Any] = []
for _ in range(100_000):
    DEEP = [DEEP]

#: What takes the place of a part.
OTHERS: tuple[Any, ...] = (
    None, "x", "\ud800", {"\ud800": 1}, ["\ud800"], 10**400, -1, 2**40, True, 1.5, float("nan"), object(), {}, (), [],
    b"a", np.zeros((2, 2)), DEEP,
)  # fmt: skip


def changed(part: Any, depth: int = 0) -> Iterator[Any]:
    """Yield versions of a state with one part replaced, left out or added, at every depth."""
    yield from OTHERS
    yield [part]
    if depth > 4:
        return
    if isinstance(part, tuple | list):
        kind: Any = type(part)
        for i in range(min(len(part), 6)):
            yield part[:i]
            yield kind([*part[:i], *part[i + 1 :]])
            for other in changed(part[i], depth + 1):
                yield kind([*part[:i], other, *part[i + 1 :]])
        yield kind([*part, 1])
    if isinstance(part, dict):
        for key in part:
            yield {other: value for other, value in part.items() if other != key}
            for other in changed(part[key], depth + 1):
                yield {**part, key: other}
        yield {**part, "unknown": 1}
        yield {**part, 1: 2}


@pytest.fixture(scope="module")
def world():
    return World()


def states_of(thing):
    state = thing.__reduce_ex__(2)[2]
    yield from changed(state)
    if (
        isinstance(state, tuple) and len(state) == 2
    ):  # the number of the format, and the state proper
        for other in changed(state[1]):
            yield (state[0], other)


def refuses(call):
    """Whether a call raises TypeError or ValueError; any other error fails the test."""
    try:
        call()
    except (TypeError, ValueError):
        return True
    return False


@pytest.mark.parametrize("name", THINGS)
def test_any_state_is_taken_or_refused_as_a_value(world, name):
    thing: Any = getattr(world, name)
    reduced = thing.__reduce_ex__(2)
    if len(reduced) < 3 or reduced[2] is None or not hasattr(thing, "__setstate__"):
        make, arguments = reduced[0], reduced[1]  # a function makes it from its parts
        wrong = 0
        for other in changed(arguments):
            if not isinstance(other, tuple):
                continue
            # operator.methodcaller, of something that has no such method, raises AttributeError.
            with contextlib.suppress(AttributeError):
                wrong += refuses(lambda other=other: make(*other))
        assert wrong > 0
        return
    wrong = 0
    for state in states_of(thing):
        kind: Any = type(thing)
        made = kind.__new__(kind)
        wrong += refuses(lambda made=made, state=state: made.__setstate__(state))
    assert wrong > 20


def state_of(thing: Any) -> Any:
    return thing.__reduce_ex__(2)[2]


def test_the_error_names_the_class_and_what_is_wrong():
    form, state = state_of(cc.Scene())
    del state["background"]
    with pytest.raises(
        ValueError, match=r"Scene: expected the state of a pickled Scene.*KeyError.*background"
    ) as caught:
        cc.Scene().__setstate__((form, state))
    assert isinstance(caught.value.__cause__, KeyError)
    form, state = state_of(cc.Scene())
    with pytest.raises(ValueError, match="Scene: expected the state of a pickled Scene"):
        cc.Scene().__setstate__(
            (form, {**state, "nodes": [1]})
        )  # Python's own error was SystemError


def test_a_sound_state_still_works():
    scene = cc.Scene(background=(1, 0, 0))
    scene.add(cc.Mesh.box(), position=(1, 2, 3))
    again = pickle.loads(pickle.dumps(scene))
    assert again.nodes[0].position.tolist() == [1, 2, 3]


@pytest.mark.parametrize(
    "call",
    [cc.Mesh.box, cc.Scene, cc.CubeMap.from_sh, cc.PerspectiveCamera, cc.Scene().add, cc.devices],
)
def test_a_keyword_that_is_no_valid_unicode_is_a_type_error(call):
    """This ended the process: pybind11's text of the error failed outside of its own try block."""
    with pytest.raises(TypeError, match="expected"):
        call(**{"\ud800": 1})
    with pytest.raises(TypeError):
        call(**{"\ud800": 1, "size": "\ud801", "width": object()})
