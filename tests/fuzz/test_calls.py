"""A part of `make fuzz`: calls, pickles and shaders with fixed numbers, and all that was once a fault."""

import ast
import io
import re

import numpy as np
import pytest

import cubecam as cc
from tests.fuzz import api, glsl, hostile, pickles, runner
from tests.fuzz.killers import KILLERS
from tests.fuzz.targets import NAMES, target
from tests.fuzz.world import World

#: Cases of a target that the test suite tries.
SOME = {"api": 60, "pickles": 30, "glsl": 30}


@pytest.mark.slow
@pytest.mark.parametrize("name", SOME)
def test_some_cases_are_no_fault(name, tmp_path):
    found, tried = runner.run(target(name), SOME[name], 0, tmp_path)
    assert found == []
    assert tried == SOME[name]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_what_was_a_fault_is_none_now(name, tmp_path):
    count = len(runner.kept(name))
    if count:
        assert runner.run(target(name), count, -count, tmp_path) == ([], count)
    assert list(tmp_path.iterdir()) == []


def test_programs_call_all_that_the_stubs_list():
    """Each class, method and property that can be set is called by some program."""
    called = {(call.receiver, call.name.split(".")[-1]) for call in api.calls() if call.parameters}
    stub = ast.parse(api.STUB.read_text(encoding="utf-8"))
    missing = []
    for kind in (node for node in stub.body if isinstance(node, ast.ClassDef)):
        for member in (m for m in kind.body if isinstance(m, ast.FunctionDef)):
            setter = any(ast.unparse(d).endswith(".setter") for d in member.decorator_list)
            if setter and (kind.name, member.name) not in called:
                missing.append(f"{kind.name}.{member.name}")
    assert missing == []
    text = b"\n".join(api.make(number) for number in range(3000)).decode()
    assert len(re.findall(r"^(?:r\d = )?\S+?\.\w+", text, re.MULTILINE)) > 5000
    made = {call.name for call in api.calls() if call.name.startswith("cc.")}
    assert {name for name in made if f"{name}(" not in text} == set()


def test_hostile_values_are_python():
    names = {"cc": cc, "hostile": hostile, "np": np}
    for text in hostile.VALUES:
        compile(text, text, "eval")
    assert len(hostile.deep(9)) == 1
    assert eval("hostile.wide(2**40, 3)", names).shape == (2**40, 3)
    with pytest.raises(hostile.HostileError):
        float(hostile.Raises())


def test_pickles_of_all_classes_are_broken():
    made = {type(getattr(World(), name)).__name__ for name in pickles.THINGS}
    want = {name for name in api.OBJECTS if "__setstate__" in vars(getattr(cc, name, object))}
    assert want - {"Light", "Material"} <= made


def test_an_unpickler_finds_no_other_names():
    with pytest.raises(Exception, match="not among the names"):
        pickles.Unpickler(io.BytesIO(b"cos\nsystem\n.")).load()


def test_shaders_of_the_grammar_draw(renderer):
    """Most of them compile: otherwise they would try the parser alone."""
    drawn = 0
    for number in range(12):
        rng = np.random.default_rng(number)
        kind, _, source = glsl._made(rng).partition("\n")
        try:
            drawn += glsl.picture(renderer, kind[3:], source).shape == (5, 6, 4)
        except cc.ShaderError:
            continue
    assert drawn >= 9


def test_killers_have_a_size():
    for make, size in KILLERS.values():
        assert len(make(min(size, 3))) < 5000
        assert size >= 1
