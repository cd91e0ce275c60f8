"""Public names of cubecam with their signatures and docstrings, read from the sources.

The signatures of the compiled module are those of `python/cubecam/_core.pyi`, which has types for people; everything
else is read from the module that defines it. The objects themselves say only where that is.
"""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cubecam

from .topics import known_names

PACKAGE = Path(cubecam.__file__).parent
STUB = PACKAGE / "_core.pyi"

#: Special methods that users call by operators; the others are for pickles, notebooks and numpy.
OPERATORS = ("__getitem__", "__contains__", "__iter__", "__len__")

#: What the types of bindings mean for those who call them.
_PLAIN_TYPES = (
    ("typing.SupportsFloat | typing.SupportsIndex", "float"),
    ("SupportsFloat | SupportsIndex", "float"),
    ("typing.SupportsInt | typing.SupportsIndex", "int"),
    ("typing.SupportsIndex", "int"),
    ("SupportsIndex", "int"),
)
#: What the names mean that modules give to types for themselves.
_PRIVATE_TYPES = {
    "AnyCamera": "PerspectiveCamera | OrthographicCamera",
    "Array": "NDArray[float64]",
    "Floats": "NDArray[float32 | float64]",
    "Mode": "Literal['reflection', 'refraction']",
    "OutputArrays": "dict[str, NDArray]",
    "Part": "int | str",
    "Picture": "Frame | CubeMap | Image",
    "Source": "PathLike | Sequence[PathLike]",
    "Status": "Literal['ok', 'note', 'warning', 'problem']",
    "Textures": "MutableMapping",
    "Uniforms": "MutableMapping",
}
_PREFIXES = re.compile(
    r"\b(?:np\.typing|numpy\.typing|npt|collections\.abc|pathlib|typing|types)\.(?=[A-Z])|\bnp\.(?=[a-z])"
)
#: Private modules in which a class is defined that users know otherwise.
_PRIVATE_MODULE = re.compile(r"\bcubecam(?:\.\w+)*\._\w+\.(?=[A-Z])")


@dataclass
class Item:
    """A name with what a reference says about it."""

    name: str  # "cubecam.Scene", "cubecam.Scene.add"
    kind: (
        str  # of Sphinx's domain py: class, exception, method, property, attribute, function, data
    )
    signatures: list[str] = field(default_factory=list)  # "(a: int) -> None"; of overloads several
    type: str = ""  # of a property or a value
    value: str = ""
    doc: str = ""
    static: bool = False
    classmethod: bool = False
    bases: list[str] = field(default_factory=list)
    members: list[Item] = field(default_factory=list)

    @property
    def short(self) -> str:
        """The last part of the name."""
        return self.name.rpartition(".")[2]


@functools.cache
def item(name: str) -> Item:
    """Read a public name, such as "cubecam.Scene" or "cubecam.plot.cross", with all members."""
    thing = resolve(name)
    if inspect.isclass(thing):
        return _class(name, thing)
    if inspect.isroutine(thing):
        function = inspect.unwrap(thing)
        return _function(name, _definitions(function))
    return _value(name)


def resolve(name: str) -> Any:
    """Import what a dotted name means; classes that cubecam does not export are those of its compiled module."""
    parts = name.split(".")
    for count in range(len(parts) - 1, 0, -1):
        try:
            thing: Any = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for part in parts[count:]:
            if thing is cubecam and not hasattr(thing, part):
                thing = cubecam._core
            thing = getattr(thing, part)
        return thing
    raise LookupError(f"expected a name of cubecam, got {name}")


def clean_type(text: str) -> str:
    """Write a type of a signature for people, with the full names of public classes."""
    for long, short in _PLAIN_TYPES:
        text = text.replace(long, short)
    text = _PREFIXES.sub("", text)
    text = text.replace("os.PathLike[str]", "PathLike").replace("os.PathLike", "PathLike")
    text = _PRIVATE_MODULE.sub("", text)
    for short, long in _PRIVATE_TYPES.items():
        text = re.sub(rf"(?<![\w.]){short}\b", long, text)
    return re.sub(r"(?<![\w.\"'])[A-Za-z]\w*(?:\.\w+)*(?![\w\"'])", _full_name, text)


def _full_name(match: re.Match[str]) -> str:
    return known_names().get(match[0], match[0])


@functools.cache
def _parsed(path: Path) -> tuple[ast.Module, list[str]]:
    text = path.read_text(encoding="utf-8")
    return ast.parse(text), text.splitlines()


@functools.cache
def _classes_of(path: Path) -> dict[str, ast.ClassDef]:
    return {node.name: node for node in _parsed(path)[0].body if isinstance(node, ast.ClassDef)}


def _file_of(thing: Any) -> Path:
    """Find the file that defines a class or a function; for compiled ones that is the stub."""
    if getattr(cubecam._core, thing.__name__, None) is thing:
        return STUB
    if inspect.isclass(thing) and thing.__module__ == "cubecam":  # warnings name the package
        return next(path for path in PACKAGE.rglob("*.py") if thing.__name__ in _classes_of(path))
    return Path(inspect.getsourcefile(thing) or STUB)


def _definitions(function: Any) -> list[ast.FunctionDef]:
    """Find the definition of a function; of one with overloads all of them."""
    body = _parsed(_file_of(function))[0].body
    return [
        node
        for node in body
        if isinstance(node, ast.FunctionDef) and node.name == function.__name__
    ]


def _class(name: str, kind: type) -> Item:
    node = _classes_of(_file_of(kind))[kind.__name__]
    made = Item(name, "exception" if issubclass(kind, Exception) else "class", doc=_doc(node))
    made.bases = [
        known_names()[base.__name__] for base in kind.__bases__ if base.__name__ in known_names()
    ]
    inits: list[ast.FunctionDef] = []
    members: dict[str, list[ast.FunctionDef]] = {}
    fields: list[ast.AnnAssign] = []
    for part in _bodies(kind):
        if isinstance(part, ast.FunctionDef) and part.name == "__init__":
            inits.append(part)
        elif isinstance(part, ast.FunctionDef) and (
            not part.name.startswith("_") or part.name in OPERATORS
        ):
            members.setdefault(part.name, []).append(part)
        elif isinstance(part, ast.AnnAssign | ast.Assign):
            fields += _field(part)
    if _is_dataclass(node):
        made.signatures = [_fields_signature(fields)]
    elif inits:
        made.signatures = [_signature(init, method=True, returns=False) for init in inits]
    documented = _documented_attributes(made.doc)
    for plain in fields:
        assert isinstance(plain.target, ast.Name)
        if not plain.target.id.startswith("_"):
            made.members.append(
                Item(
                    f"{name}.{plain.target.id}",
                    "attribute",
                    type=clean_type(ast.unparse(plain.annotation)),
                    doc=documented.get(plain.target.id, ""),
                )
            )
    for member, found in members.items():
        made.members.append(_member(f"{name}.{member}", found, documented))
    _add_enum_members(made, kind)
    return made


def _bodies(kind: type) -> Iterator[ast.stmt]:
    """Give the statements of a class, and of its private bases where the class does not replace them."""
    seen: set[str] = set()
    for owner in kind.__mro__:
        if owner is not kind and (
            owner.__name__ in known_names() or not owner.__module__.startswith("cubecam")
        ):
            continue
        if owner is not kind and not owner.__name__.startswith("_"):
            continue
        here = set()
        for part in _classes_of(_file_of(owner))[owner.__name__].body:
            label = getattr(part, "name", "")
            if label in seen:
                continue
            here.add(label)
            yield part
        seen |= here


def _field(part: ast.AnnAssign | ast.Assign) -> list[ast.AnnAssign]:
    return [part] if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name) else []


def _is_dataclass(node: ast.ClassDef) -> bool:
    words = [ast.unparse(decorator) for decorator in node.decorator_list]
    return any("dataclass" in word for word in words) or any(
        ast.unparse(base) == "NamedTuple" for base in node.bases
    )


def _fields_signature(fields: list[ast.AnnAssign]) -> str:
    parts = []
    for one in fields:
        text = f"{ast.unparse(one.target)}: {clean_type(ast.unparse(one.annotation))}"
        parts.append(text if one.value is None else f"{text} = {ast.unparse(one.value)}")
    return f"({', '.join(parts)})"


def _add_enum_members(made: Item, kind: type) -> None:
    for label, member in getattr(kind, "__members__", {}).items():
        made.members.append(Item(f"{made.name}.{label}", "attribute", value=str(member.value)))


def _member(name: str, found: list[ast.FunctionDef], documented: dict[str, str]) -> Item:
    first = found[0]
    decorators = [ast.unparse(decorator) for node in found for decorator in node.decorator_list]
    if "property" in decorators:
        doc = _doc(first)
        kind, text = _split_type(doc)
        declared = clean_type(ast.unparse(first.returns)) if first.returns else kind
        return Item(
            name,
            "property",
            type=declared,
            doc=text or documented.get(first.name, ""),
        )
    made = _function(name, found, method=True)
    made.kind = "method"
    made.static, made.classmethod = "staticmethod" in decorators, "classmethod" in decorators
    if made.static:
        made.signatures = [_signature(node, method=False) for node in _overloads(found)]
    return made


def _split_type(doc: str) -> tuple[str, str]:
    """Split "int: how many." of a property; the type may not hold a full stop."""
    match = re.match(r"([\w, ()\[\].|\"*]+?): (?=\S)(.*)", doc, re.DOTALL)
    if match is None or re.search(r"[a-z]\. ", match[1]) or len(match[1]) > 70:
        return "", doc
    return match[1], match[2][:1].upper() + match[2][1:]


def _overloads(found: list[ast.FunctionDef]) -> list[ast.FunctionDef]:
    """Leave out the definition that implements overloads in a Python file."""
    marked = [
        node
        for node in found
        if any("overload" in ast.unparse(decorator) for decorator in node.decorator_list)
    ]
    return marked or found[:1]


def _function(name: str, found: list[ast.FunctionDef], method: bool = False) -> Item:
    overloads = _overloads(found)
    docs = [doc for doc in dict.fromkeys(map(_doc, [*overloads, *found])) if doc]
    made = Item(name, "function", doc="\n\n".join(docs[:1]))
    made.signatures = [_signature(node, method=method) for node in overloads]
    if len(docs) > 1:
        made.members = [
            Item(name, "overload", signatures=[_signature(node, method=method)], doc=_doc(node))
            for node in overloads
        ]
    return made


def _signature(node: ast.FunctionDef, *, method: bool, returns: bool = True) -> str:
    arguments = node.args
    positional = [*arguments.posonlyargs, *arguments.args]
    defaults: list[ast.expr | None] = [None] * (len(positional) - len(arguments.defaults))
    defaults += arguments.defaults
    parts = [
        _parameter(argument, default)
        for argument, default in list(zip(positional, defaults, strict=True))[method:]
    ]
    if arguments.vararg:
        parts.append("*" + _parameter(arguments.vararg, None))
    elif arguments.kwonlyargs:
        parts.append("*")
    parts += [
        _parameter(argument, default)
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    ]
    if arguments.kwarg:
        parts.append("**" + _parameter(arguments.kwarg, None))
    text = f"({', '.join(parts)})"
    if returns and node.returns is not None:
        text += f" -> {clean_type(ast.unparse(node.returns))}"
    return text


def _parameter(argument: ast.arg, default: ast.expr | None) -> str:
    text = argument.arg
    if argument.annotation is not None:
        text += f": {clean_type(ast.unparse(argument.annotation))}"
    if default is not None:
        equals = " = " if argument.annotation is not None else "="
        text += f"{equals}{_default(default)}"
    return text


def _default(default: ast.expr) -> str:
    text = ast.unparse(default)
    if text == "268435456":
        return "256 * 2**20"
    return text


def _documented_attributes(doc: str) -> dict[str, str]:
    """Read the section Attributes of a class's docstring: a text for each name."""
    match = re.search(
        r"^Attributes\n-+\n(.*?)(?=^\w[\w ]*\n-+\n|\Z)", doc, re.DOTALL | re.MULTILINE
    )
    texts: dict[str, str] = {}
    names: list[str] = []
    for line in match[1].splitlines() if match else ():
        if line and not line.startswith(" "):
            names = [part.strip() for part in line.partition(" : ")[0].split(",")]
            texts |= dict.fromkeys(names, "")
        else:
            for name in names:
                texts[name] += line.strip() + "\n"
    return {name: text.strip() for name, text in texts.items()}


def _doc(node: ast.FunctionDef | ast.ClassDef) -> str:
    return ast.get_docstring(node) or ""


def _value(name: str) -> Item:
    """Read a constant or the name of a type, with the comment ``#:`` above it."""
    module, _, short = name.rpartition(".")
    for path in _files_of(importlib.import_module(module)):
        tree, lines = _parsed(path)
        for node in tree.body:
            target = _assigned(node)
            if target != short:
                continue
            comment: list[str] = []
            row = node.lineno - 2
            while row >= 0 and lines[row].startswith("#:"):
                comment.insert(0, lines[row][2:].strip())
                row -= 1
            made = Item(name, "data", doc="\n".join(comment))
            assert isinstance(node, ast.Assign | ast.AnnAssign)
            assert node.value is not None
            text = clean_type(ast.unparse(node.value))
            if isinstance(node, ast.AnnAssign) and ast.unparse(node.annotation) == "TypeAlias":
                made.kind, made.value = "type", text
            else:
                made.value = text if len(text) < 200 else ""
                made.type = (
                    clean_type(ast.unparse(node.annotation))
                    if isinstance(node, ast.AnnAssign)
                    else ""
                )
            return made
    raise LookupError(f"expected the definition of {name} in {module}")


def _assigned(node: ast.stmt) -> str:
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value:
        return node.target.id
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
        return node.targets[0].id
    return ""


def _files_of(module: Any) -> list[Path]:
    """Give the file of a module, and the private files from which a package takes its names."""
    path = Path(module.__file__)
    private = sorted(path.parent.glob("_*.py")) if path.name == "__init__.py" else []
    return [path, *private, PACKAGE / "_array_types.py"]
