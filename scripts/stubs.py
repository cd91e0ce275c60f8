"""Write python/cubecam/_core.pyi from the built module; with --check, only compare the two."""

from __future__ import annotations

import ast
import builtins
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
import cubecam.typing
from cubecam import _core

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "python" / "cubecam" / "_core.pyi"


def make_describable() -> None:
    """Undo, in this process, what hides the module's contents from the generator.

    Classes name themselves as users see them, for example cubecam.Scene; the generator would take such names
    for imports.
    Methods and properties that python/cubecam/_attach.py adds are plain functions with annotations as text.
    """
    methods: set[types.FunctionType] = set()  # some belong to several classes
    for name, thing in vars(_core).items():
        if getattr(thing, "__module__", None) != "cubecam":
            continue
        if isinstance(thing, type):
            unwrap_methods(thing)
        thing.__module__ = _core.__name__
        # Signatures name every class as cubecam.Name, those that cubecam does not export as well.
        if not hasattr(cubecam, name):
            setattr(cubecam, name, thing)
        for member in vars(thing).values() if isinstance(thing, type) else ():
            accessors = (member.fget, member.fset) if isinstance(member, property) else (member,)
            for function in accessors:
                if isinstance(function, types.FunctionType) and function.__module__.startswith(
                    "cubecam"
                ):
                    methods.add(function)
    for method in methods:
        make_method(method)


def unwrap_methods(kind: type) -> None:
    """Load the methods that are loaded at their first use, and set the functions below their wrappers instead."""
    for name in list(vars(kind)):
        member = getattr(kind, name, None)  # an old name raises AttributeError
        if isinstance(member, types.FunctionType):
            setattr(kind, name, inspect.unwrap(member))


def make_method(function: types.FunctionType) -> None:
    """Give a function the first argument `self` and annotations with full names."""
    arguments = function.__code__.co_varnames
    function.__annotations__ = {
        name: full_names(annotation, function.__globals__)
        for name, annotation in function.__annotations__.items()
        if name != arguments[0]
    }
    function.__code__ = function.__code__.replace(co_varnames=("self", *arguments[1:]))
    function.__doc__ = inspect.getdoc(function)


def public_module(thing: object) -> str:
    """Return the module that users import a class from: Python 3.13 calls pathlib.Path pathlib._local.Path."""
    module: str = getattr(thing, "__module__", "builtins")
    outer, _, inner = module.rpartition(".")
    name = getattr(thing, "__qualname__", "")
    if inner.startswith("_") and getattr(sys.modules.get(outer), name, None) is thing:
        return outer
    return module


def full_names(annotation: str, scope: dict[str, object]) -> str:
    """Turn "NDArray[np.float32]" into "numpy.typing.NDArray[numpy.float32]"."""

    class FullNames(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            thing = scope.get(node.id, getattr(builtins, node.id, None))
            for module in (cubecam.typing, npt):
                # An alias of a union has no name of its own; None: only type checkers import it.
                if node.id in module.__all__ and thing in (None, getattr(module, node.id)):
                    return ast.parse(f"{module.__name__}.{node.id}", mode="eval").body
            if isinstance(thing, types.ModuleType):
                return ast.parse(thing.__name__, mode="eval").body
            if thing is None:
                raise SystemExit(
                    f"{node.id} in {annotation}: expected a name that exists when the program runs"
                )
            if typing.get_origin(thing) is not None:  # another alias
                return ast.parse(str(thing), mode="eval").body
            name = getattr(thing, "__qualname__", node.id)
            package = public_module(thing)
            full = name if package == "builtins" else f"{package}.{name}"
            return ast.parse(full, mode="eval").body

    return ast.unparse(FullNames().visit(ast.parse(annotation, mode="eval")))


def names_of_choices() -> dict[tuple[str, ...], str]:
    """Map the names that a choice has to the alias of the choice in cubecam.typing."""
    return {
        tuple(map(str, typing.get_args(alias))): name
        for name, alias in vars(cubecam.typing).items()
        if typing.get_origin(alias) is typing.Literal
    }


class ExactTypes(ast.NodeTransformer):
    """Replaces types that pybind11 cannot say more exactly, and lists of names by their aliases."""

    def __init__(self) -> None:
        self.choices = names_of_choices()
        self.unknown: list[str] = []

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.FunctionDef:
        arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
        arguments += [more for more in (node.args.vararg, node.args.kwarg) if more]
        if any(ast.unparse(decorator).endswith(".setter") for decorator in node.decorator_list):
            arguments[1].arg = "value"
        for argument in arguments[1 if arguments[:1] and arguments[0].arg == "self" else 0 :]:
            argument.annotation = self.visit(argument.annotation or ast.Name("object"))
        if node.returns is not None:
            node.returns = self.visit(node.returns)
        if node.name == "add" and arguments[1].arg == "light":  # returns the light that it takes
            arguments[1].annotation = node.returns = ast.Name("AnyLight")
        if node.name in ("__eq__", "__ne__"):  # both return NotImplemented for other classes
            arguments[1].annotation = ast.Name("object")
            node.returns = ast.Name("bool")
        if node.name == "__setstate__":  # raises TypeError for a state of another class
            arguments[1].arg = "state"
            arguments[1].annotation = ast.Name("object")
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        kind = ast.unparse(node.value)
        if kind == "typing.Literal":
            parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
            names = tuple(str(part.value) for part in parts if isinstance(part, ast.Constant))
            if names not in self.choices:
                self.unknown.append(", ".join(map(str, names)))
                return node
            return ast.Name(self.choices[names])
        # The names of these types stay; only what the brackets hold is visited.
        node.slice = self.visit(node.slice)
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        whole = ast.unparse(node)
        if whole.startswith("cubecam.typing."):
            return ast.Name(node.attr)
        return ast.Name("object") if whole == "typing.Any" else node

    def visit_Name(self, node: ast.Name) -> ast.expr:
        bare = {"tuple": "tuple[object, ...]", "dict": "dict[str, object]", "list": "list[object]"}
        return ast.parse(bare.get(node.id, node.id), mode="eval").body


def with_exact_types(text: str) -> str:
    """Apply ExactTypes to a stub, and import the aliases that the stub uses."""
    exact = ExactTypes()
    tree = exact.visit(ast.parse(text))
    if exact.unknown:
        lists = "\n".join(dict.fromkeys(exact.unknown))
        raise SystemExit(
            f"expected an alias in cubecam.typing for each choice, got none for\n{lists}"
        )
    imported = ", ".join(cubecam.typing.__all__)
    variable = ast.parse('AnyLight = typing.TypeVar("AnyLight", bound="Light")').body
    tree.body[-1:-1] = variable
    lines = ast.unparse(tree).splitlines(keepends=True)
    at = lines.index("from __future__ import annotations\n") + 1
    lines = [line for line in lines if line not in ("import cubecam\n", "import cubecam.typing\n")]
    return "".join([*lines[:at], f"from cubecam.typing import {imported}\n", *lines[at:]])


def with_excuses(text: str) -> str:
    """Mark what the core does on purpose although type checkers refuse it.

    A class without a hash has None in its place, and a camera that computes its view has no setter for it.
    """
    lines = text.splitlines()
    classes = [node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)]
    setters = {
        (kind.name, member.name)
        for kind in classes
        for member in kind.body
        if isinstance(member, ast.FunctionDef) and len(member.decorator_list) == 1
        if ast.unparse(member.decorator_list[0]).endswith(".setter")
    }
    for kind in classes:
        for member in kind.body:
            if isinstance(member, ast.AnnAssign) and ast.unparse(member.target) == "__hash__":
                lines[member.lineno - 1] += "  # type: ignore[assignment]"
            name = getattr(member, "name", "")
            inherits = any((ast.unparse(base), name) in setters for base in kind.bases)
            if inherits and (kind.name, name) not in setters:
                line = getattr(member, "decorator_list", [member])[0].lineno
                lines[line - 1] += "  # type: ignore[misc]"
    return "\n".join(lines) + "\n"


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
    text = with_exact_types(text)
    text = ruff(text, "check", "--select=I,F401", "--fix-only")
    return with_excuses(ruff(text, "format"))


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
