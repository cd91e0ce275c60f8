"""Folders depend on each other in one direction only: the tests read the C++ includes and the Python imports.

Only the two tables below state which part may depend on which; docs/architecture.md draws them.
"""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

#: A folder of cpp/ may include from itself and from those named before it in this order, except the pairs below.
CPP_ORDER = (
    "core",
    "math",
    "image",
    "cubemap",
    "lighting",  # filters of whole cubemaps
    "geometry",
    "materials",
    "scene",
    "gl",
    "trial",  # users' GLSL in a process of its own
    "render/resources",
    "render/passes",
    "render/graph",
    "render",
    "bindings",
)
#: Folders that may include from fewer folders than the order allows.
CPP_KNOWS = {
    "gl": {"core"},
    "math": {"core"},
    "lighting": {"core", "math", "image", "cubemap"},
    "trial": {"core", "gl"},
}

#: The parts of python/cubecam in the same kind of order; a part is a folder or a module.
PYTHON_ORDER = (
    "_array_types",  # needs numpy
    "typing",
    "_core",
    "doctor",  # runs when the core cannot be loaded: it imports it in functions alone
    "_checks",  # what a bool, an int, a float and a str are
    "_calls",  # errors of wrong calls, in words
    "_late",
    "_warnings",
    "_progress",  # a bar in the terminal
    "_processes",  # other Python processes that work for this one
    "_futures",  # calls of a renderer that are drawn later
    "data",  # the packaged files and their list
    "_nodes",  # which nodes are shown
    "_rotations",  # matrices of quaternions
    "_drawn_meshes",  # meshes with their morph targets and skins
    "_scene_hash",  # what tells whether two scenes are equal
    "_grid_bake",  # what the nodes of a grid of probes capture
    "io",
    "pictures",
    "_array_protocol",
    "batches",  # many captures and frames in one call
    "pool",  # the same by several processes
    "cluster",  # the same by many machines
    "plot",
    "navigation",
    "optics",
    "projections",
    "truth",  # the same scene by exact rays, and comparisons with it
    "staging",  # light, ground and camera for a model
    "viewer",
    "explore",
    "_shader_inputs",
    "_pickling",
    "_old_names",
    "_arguments",
    "_attach",
    "cubecam",  # the package itself: __init__.py
    "truth",  # the same scene by exact rays
    "examples",
    "demo",
    "cli",
    "__main__",
)
PYTHON_KNOWS = {
    "_checks": {"typing", "_core"},
    "_calls": {"_checks"},
    "doctor": {"_core"},
    "_late": set(),
    "_warnings": set(),
    "navigation": {"_core", "_checks", "_calls"},
    "optics": {"_core", "_checks", "_calls"},
    "projections": {"typing", "_core", "_checks", "_calls"},
    "_shader_inputs": {"_core"},
    "_pickling": {"_core"},
}


def allowed(part, order, knows):
    return knows.get(part, set(order[: order.index(part)])) | {part}


def cpp_folder(path):
    """The folder of the table in which a source or a header lies; None for other headers."""
    found = [name for name in CPP_ORDER if str(path).startswith(f"cubecam/{name}/")]
    if str(path).startswith("bindings/"):
        return "bindings"
    return max(found, key=len) if found else None


def cpp_arrows():
    """Yield (file, its folder, the folder it includes from, the header) for each include of the C++ sources."""
    for path in sorted((ROOT / "cpp").rglob("*.[ch]pp")):
        inside = path.relative_to(ROOT / "cpp")
        folder = cpp_folder(inside.as_posix())
        if folder is None:
            continue
        for name in re.findall(r'^\s*#include "([^"]+)"', path.read_text(), re.MULTILINE):
            other = cpp_folder(name)
            if other is not None:
                yield inside, folder, other, name


def python_part(module):
    """The part of the table to which a module belongs; the name is dotted and starts below cubecam."""
    first = module.split(".")[0]
    return first or "cubecam"


def python_arrows():
    """Yield (file, its part, the part it imports), also for imports in functions; imports for types are left out."""
    package = ROOT / "python" / "cubecam"
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package).with_suffix("").parts
        here = parts[:-1]
        part = python_part("" if parts == ("__init__",) else parts[0])
        tree = ast.parse(path.read_text())
        for_types = {
            id(node)
            for block in ast.walk(tree)
            if isinstance(block, ast.If) and "TYPE_CHECKING" in ast.unparse(block.test)
            for node in ast.walk(block)
        }
        for node in ast.walk(tree):
            if id(node) in for_types:
                continue
            for name in imported(node, here):
                yield path.relative_to(package), part, python_part(name)


def imported(node, here):
    """The modules of cubecam that a statement imports, as dotted names that start below cubecam."""
    if isinstance(node, ast.Import):
        names = [name.name for name in node.names]
        return [
            n.partition("cubecam")[2].lstrip(".") for n in names if n.split(".")[0] == "cubecam"
        ]
    if not isinstance(node, ast.ImportFrom):
        return []
    if node.level == 0:
        package, *base = (node.module or "").split(".")
        if package != "cubecam":
            return []
    else:
        base = [*here[: len(here) - node.level + 1], *(node.module or "").split(".")]
        base = [word for word in base if word]
    if base:
        return [".".join(base)]
    known = {path.stem for path in (ROOT / "python" / "cubecam").iterdir()} | {"_core"}
    return [name.name if name.name in known else "" for name in node.names]


def test_every_folder_is_in_the_table():
    sources = (ROOT / "cpp" / "cubecam").rglob("*.[ch]pp")
    folders = {cpp_folder(path.relative_to(ROOT / "cpp").as_posix()) for path in sources}
    assert folders == set(CPP_ORDER) - {"bindings"}
    parts = {
        path.stem
        for path in (ROOT / "python" / "cubecam").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    assert parts - {"__init__"} == set(PYTHON_ORDER) - {"_core", "cubecam"}


def test_cpp_includes_go_down():
    arrows = list(cpp_arrows())
    assert len(arrows) > 300
    wrong = [
        f"{file} of {folder} includes {name}"
        for file, folder, other, name in arrows
        if other not in allowed(folder, CPP_ORDER, CPP_KNOWS)
    ]
    assert wrong == []


def test_python_imports_go_down():
    arrows = list(python_arrows())
    assert len(arrows) > 60
    wrong = [
        f"{file} of {part} imports {other}"
        for file, part, other in arrows
        if other not in allowed(part, PYTHON_ORDER, PYTHON_KNOWS)
    ]
    assert wrong == []


def test_shading_is_plain_numpy():
    """It judges the renderer, so nothing of it may come from there."""
    wrong = [
        f"{file} imports {other}"
        for file, part, other in python_arrows()
        if file.parts[:2] == ("truth", "shading") and other != "truth"
    ]
    assert wrong == []


def test_the_core_knows_neither_python_nor_opengl_below_gl():
    for path in sorted((ROOT / "cpp" / "cubecam").rglob("*.[ch]pp")):
        text = path.read_text()
        assert not re.search(r"#include [<\"](pybind11|Python\.h)", text), path
        folder = cpp_folder(path.relative_to(ROOT / "cpp").as_posix())
        if CPP_ORDER.index(folder) < CPP_ORDER.index("gl"):
            assert not re.search(r"#include <(glad|EGL|GL)/", text), path
