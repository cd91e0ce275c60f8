"""The project's own files: tests that assert, versions that agree, workflows that call targets which exist."""

import ast
import functools
import importlib.metadata
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.helpers import load_script, need_no_sanitizer

ROOT = Path(__file__).resolve().parents[2]
#: Helpers that fail a test when something is wrong.
ASSERTING = {"raises", "fail"}


@functools.cache
def trees():
    """The tests, read once: the syntax tree of each file."""
    return {path: ast.parse(path.read_text()) for path in sorted((ROOT / "tests").rglob("*.py"))}


@functools.cache
def checks(function):
    """Whether a function has an assert or what fails a test, and the names of all that it calls."""
    called = set()
    for node in ast.walk(function):
        if isinstance(node, ast.Assert):
            return True, frozenset()
        if isinstance(node, ast.Call):
            name: str = getattr(node.func, "attr", "") or getattr(node.func, "id", "")
            if name in ASSERTING or name.startswith("assert_"):
                return True, frozenset()
            called.add(name)
    return False, frozenset(called)


def asserts(function):
    """Whether a function checks a result: with assert, or with a helper that is known to check."""
    directly, called = checks(function)
    return directly or not LOCAL.isdisjoint(called)


@functools.cache
def functions(tree):
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]


def asserting_helpers(all_trees):
    """Names of the helpers (not tests) that check a result, directly or through each other."""
    found: set[str] = set()
    while True:
        LOCAL.clear()
        LOCAL.update(found)
        more = {
            function.name
            for tree in all_trees
            for function in functions(tree)
            if not function.name.startswith("test_") and asserts(function)
        }
        if more <= found:
            return found
        found |= more


LOCAL: set[str] = set()


def test_every_test_asserts():
    LOCAL.update(asserting_helpers(trees().values()))
    without = [
        f"{path.relative_to(ROOT)}: {function.name}"
        for path, tree in trees().items()
        for function in functions(tree)
        if function.name.startswith("test_") and not asserts(function)
    ]
    assert without == []


def test_a_test_without_an_assertion_is_found():
    LOCAL.clear()
    tree = ast.parse("def test_a():\n    draw()\ndef test_b():\n    assert draw()\n")
    assert [asserts(function) for function in functions(tree)] == [False, True]


def test_helpers_are_not_imported_from_test_modules():
    for path, tree in trees().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [*node.module.split("."), *(name.name for name in node.names)]
                assert not (names[0] == "tests" and any(n.startswith("test_") for n in names)), path


def test_versions_agree():
    found = re.search(r'^version = "(.+)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert found is not None
    assert f"version: {found[1]}\n" in (ROOT / "CITATION.cff").read_text()


def test_workflows_call_targets_that_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    called = set()
    for path in [*(ROOT / ".github" / "workflows").glob("*.yml"), ROOT / ".ci" / "run"]:
        commands = re.findall(r"(?:run: |exec |^)make ([a-z -]+)", path.read_text(), re.MULTILINE)
        called |= {word for command in commands for word in command.split()}
    assert {"lint", "test", "test-build", "sanitize", "sdist", "wheel", "bench"} <= called
    assert called <= targets


#: What is compiled into the wheel, by the name of its file below licenses/, and the PyPI package that brings the text.
COMPILED_IN = {"pybind11": "pybind11", "glm": None, "glad": "glad2"}


def words(text):
    return " ".join(text.split())


def test_the_licences_are_those_of_what_is_compiled_in():
    """Each text holds that of the installed package, word for word, and every text goes into the wheel."""
    folder = ROOT / "licenses"
    assert {path.stem for path in folder.iterdir()} == set(COMPILED_IN)
    assert '"licenses/*.txt"' in (ROOT / "pyproject.toml").read_text()
    for name, package in COMPILED_IN.items():
        text = words((folder / f"{name}.txt").read_text())
        assert re.search(r"Copyright \(c\) [0-9]{4}", text), name
        for file in importlib.metadata.files(package) or () if package else ():
            if file.name.startswith("LICENSE"):
                # pybind11 adds a sentence about contributions to itself.
                theirs = words(file.read_text()).partition(" Please also refer to the file")[0]
                assert theirs in text, name


def filled_sbom():
    text = (ROOT / "cmake" / "sbom.cdx.json.in").read_text()
    return json.loads(re.sub(r"@(\w+)@", "1.2.3", text))


def test_the_bill_of_materials_names_what_is_compiled_in():
    """CycloneDX 1.6: each component has a version, a purl and a licence, and cubecam depends on all."""
    sbom = filled_sbom()
    assert (sbom["bomFormat"], sbom["specVersion"], sbom["version"]) == ("CycloneDX", "1.6", 1)
    assert {part["name"] for part in sbom["components"]} == {"pybind11", "glm", "glad2"}
    for part in [sbom["metadata"]["component"], *sbom["components"]]:
        assert part["type"] == "library"
        assert part["version"] == "1.2.3"
        assert re.fullmatch(rf"pkg:(pypi|github)/[\w/-]*{part['name']}@1\.2\.3", part["purl"])
        assert part["bom-ref"] == part["purl"]
        (licence,) = part["licenses"]
        assert licence.get("expression") or licence["license"]["id"]
    (cubecam,) = sbom["dependencies"]
    assert cubecam["ref"] == sbom["metadata"]["component"]["purl"]
    assert cubecam["dependsOn"] == [part["purl"] for part in sbom["components"]]


HARDENED = (
    "-O2", "-fstack-protector-strong", "-D_FORTIFY_SOURCE=2",
    "-Wl,-z,relro", "-Wl,-z,now", "-Wl,-z,noexecstack",
)  # fmt: skip
SOFT = {
    "-fno-stack-protector": "guards on the stack",
    "-U_FORTIFY_SOURCE": "checked copies",
    "-Wl,-z,lazy": "BIND_NOW",
    "-Wl,-z,norelro": "RELRO",
    "-Wl,-z,execstack": "a stack that is not executable",
}


@pytest.mark.parametrize("soft", [None, *SOFT])
def test_a_wheel_that_lacks_hardening_is_found(soft, tmp_path):
    """`make wheel` refuses a library that was compiled or linked without one of the options."""
    need_no_sanitizer("the compiler does not start with its library")
    source = tmp_path / "a.c"
    source.write_text(
        "#include <string.h>\n"
        "void use(char *);\n"
        "void copy(const char *from) { char to[64]; strcpy(to, from); use(to); }\n"
    )
    compiler = shutil.which("cc") or shutil.which("gcc")
    assert compiler is not None, "expected a C compiler: make sets one up"
    options = [*HARDENED, *([soft] if soft else [])]
    library = tmp_path / "a.so"
    subprocess.run([compiler, "-shared", "-fPIC", *options, source, "-o", library], check=True)
    assert load_script("check_wheel").missing_hardening(library) == ([SOFT[soft]] if soft else [])
