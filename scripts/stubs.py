"""Write python/cubecam/_core.pyi from the built module; with --check, only compare the two."""

from __future__ import annotations

import ast
import difflib
import enum
import inspect
import io
import subprocess
import sys
import tempfile
import tokenize
import types
import typing
from pathlib import Path

import numpy.typing as npt
import pybind11_stubgen

import cubecam
from cubecam import _core

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "python" / "cubecam" / "_core.pyi"


#: This type stands for numpy's union of many types, and stubs write it by its name.
ARRAY_LIKE = type("ArrayLike", (), {"__module__": "numpy.typing"})


def make_describable() -> None:
    """Undo, in this process, what hides the module's contents from the generator.

    Classes name themselves as users see them, for example cubecam.Scene; the generator would take such names
    for imports.
    Methods and properties that python/cubecam/_attach.py adds are plain functions with annotations as text.
    """
    for name, thing in vars(_core).items():
        if getattr(thing, "__module__", None) != "cubecam":
            continue
        thing.__module__ = _core.__name__
        # Signatures name every class as cubecam.Name, those that cubecam does not export as well.
        if not hasattr(cubecam, name):
            setattr(cubecam, name, thing)
        for member in vars(thing).values() if isinstance(thing, type) else ():
            accessors = (member.fget, member.fset) if isinstance(member, property) else (member,)
            for function in accessors:
                ours = isinstance(function, types.FunctionType)
                if ours and function.__module__.startswith("cubecam"):
                    make_method(function)


def make_method(function: types.FunctionType) -> None:
    """Give a function the first argument `self` and annotations that are types."""
    arguments = function.__code__.co_varnames
    annotations = typing.get_type_hints(function)
    annotations.pop(arguments[0], None)
    for name, kind in annotations.items():
        annotations[name] = ARRAY_LIKE if kind == npt.ArrayLike else kind
    function.__annotations__ = annotations
    function.__code__ = function.__code__.replace(co_varnames=("self", *arguments[1:]))
    function.__doc__ = inspect.getdoc(function)


def without_package_prefix(text: str) -> str:
    """Turn cubecam.Scene into Scene in code; docstrings stay as they are."""
    lines = text.splitlines(keepends=True)
    tokens = list(tokenize.generate_tokens(io.StringIO(text).readline))
    for first, dot, name in reversed(list(zip(tokens, tokens[1:], tokens[2:], strict=False))):
        if (first.string, dot.string) == ("cubecam", ".") and hasattr(_core, name.string):
            row, column = first.start
            line = lines[row - 1]
            lines[row - 1] = line[:column] + line[name.start[1] :]
    return "".join(lines)


def with_short_numpy(text: str) -> str:
    """Turn numpy.ndarray into np.ndarray in code: in a class with a method `numpy`, the long name is the method."""
    lines = text.splitlines(keepends=True)
    tokens = list(tokenize.generate_tokens(io.StringIO(text).readline))
    for before, name, dot in reversed(list(zip(tokens, tokens[1:], tokens[2:], strict=False))):
        if name.string == "numpy" and dot.string == "." and before.string not in (".", "import"):
            row, column = name.start
            lines[row - 1] = lines[row - 1][:column] + "np" + lines[row - 1][name.end[1] :]
    return "".join(lines).replace("\nimport numpy\n", "\nimport numpy as np\n")


def with_plain_enums(text: str) -> str:
    """Give members of enumerations their values, since type checkers do not see annotated names as members.

    What the module enum itself defines is left out, because it differs between versions of Python.
    """
    lines = text.splitlines(keepends=True)
    for kind in reversed(ast.parse(text).body):
        enumeration = getattr(_core, getattr(kind, "name", ""), None)
        if not isinstance(kind, ast.ClassDef) or not isinstance(enumeration, enum.EnumMeta):
            continue
        for node in reversed(kind.body):
            decorators = getattr(node, "decorator_list", [])
            span = slice(min(part.lineno for part in [node, *decorators]) - 1, node.end_lineno)
            if isinstance(node, ast.FunctionDef):
                del lines[span]
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                name = node.target.id
                lines[span] = [f"    {name} = {enumeration[name].value!r}\n"]
    return "".join(lines)


def ruff(text: str, *command: str) -> str:
    settings = f"--config={ROOT / 'pyproject.toml'}"
    return subprocess.run(
        [
            sys.executable,
            "-m",
            "ruff",
            *command,
            "--quiet",
            settings,
            "--stdin-filename=_core.pyi",
            "-",
        ],
        input=text,
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    ).stdout


def generate() -> str:
    """Return the stub's text, made by pybind11-stubgen and ruff in the versions that pyproject.toml pins."""
    make_describable()
    with tempfile.TemporaryDirectory() as folder:
        pybind11_stubgen.main([_core.__name__, "--output-dir", folder, "--exit-code"])
        text = Path(folder, "cubecam", "_core.pyi").read_text(encoding="utf-8")
    text = with_short_numpy(with_plain_enums(without_package_prefix(text)))
    text = text.replace("__all__: list = [", "__all__: list[str] = [")
    text = ruff(text, "check", "--select=I,F401", "--fix-only")
    return ruff(text, "format")


def main(arguments: list[str]) -> int:
    text = generate()
    known = STUB.read_text(encoding="utf-8") if STUB.exists() else ""
    if text == known:
        return 0
    if arguments == ["--check"]:
        lines = difflib.unified_diff(
            known.splitlines(), text.splitlines(), "_core.pyi", "the built module", lineterm=""
        )
        print("\n".join(list(lines)[:60]))
        print("python/cubecam/_core.pyi is not what the module says: make stubs", file=sys.stderr)
        return 1
    STUB.write_text(text, encoding="utf-8")
    print(f"wrote {STUB.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
