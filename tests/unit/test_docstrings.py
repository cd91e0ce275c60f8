"""Every public object is documented, and the examples in docstrings run and print what they show."""

import doctest
import importlib
import inspect
import pkgutil

import numpy as np
import pytest

import cubecam as cc


def modules():
    names = ["cubecam"] + [
        f"cubecam.{m.name}" for m in pkgutil.iter_modules(cc.__path__) if m.name != "__main__"
    ]
    return [importlib.import_module(name) for name in names]


def documented():
    """Yield (name, object) for the modules, the public classes and functions, and their public members."""
    found = {}
    for module in modules():
        found[module.__name__] = module
        # Names of __all__ and methods may be loaded at their first use.
        for name in dict.fromkeys([*vars(module), *getattr(module, "__all__", ())]):
            thing = getattr(module, name)
            ours = str(getattr(thing, "__module__", "")).startswith("cubecam")
            if name.startswith("_") or not ours or not (inspect.isclass(thing) or callable(thing)):
                continue
            found.setdefault(f"cubecam.{name}", thing)
            if inspect.isclass(thing):
                for member, value in list(vars(thing).items()):
                    if not member.startswith("_"):
                        found.setdefault(f"cubecam.{name}.{member}", getattr(thing, member, value))
    return found


def text_of(thing):
    return inspect.getdoc(getattr(thing, "__func__", thing)) or ""


EXAMPLES = {name: thing for name, thing in documented().items() if ">>>" in text_of(thing)}


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if any(word in text_of(EXAMPLES[name]) for word in ("zarr", "cluster")):
        pytest.importorskip("zarr", minversion="3.1.6")  # Python 3.10 has only zarr 2
    text = text_of(EXAMPLES[name])
    scope = {"cc": cc, "cubecam": cc, "np": np}
    test = doctest.DocTestParser().get_doctest(text, scope, name, name, 0)
    report: list[str] = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    runner.run(test, out=report.append)
    assert runner.summarize(verbose=False).failed == 0, "".join(report)


def test_there_are_examples():
    assert len(EXAMPLES) >= 10
    for name in ("load_image", "CubeMap.save", "PerspectiveCamera.walk", "refract"):
        assert f"cubecam.{name}" in EXAMPLES  # these are loaded at their first use


@pytest.mark.parametrize("name", sorted(cc.__all__))
def test_public_objects_are_documented(name):
    thing = getattr(cc, name)
    if not (inspect.isclass(thing) or callable(thing)):
        return
    text = text_of(thing)
    assert len(text) > 15, f"cubecam.{name} has no docstring"
    if inspect.isclass(thing) and not issubclass(thing, Exception):
        bare = [
            member
            for member in list(vars(thing))
            if not member.startswith("_")
            and callable(value := getattr(thing, member, None))
            and len(text_of(value)) < 10
        ]
        assert not bare, f"methods of cubecam.{name} without a docstring: {bare}"
