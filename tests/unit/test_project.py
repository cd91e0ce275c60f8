"""The project's own files: tests that assert, versions that agree, workflows that call targets which exist."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
#: Helpers that fail a test when something is wrong.
ASSERTING = {"raises", "fail"}


def asserts(function):
    """Whether a function checks a result: with assert, or with a helper that is known to check."""
    for node in ast.walk(function):
        if isinstance(node, ast.Assert):
            return True
        if isinstance(node, ast.Call):
            name: str = getattr(node.func, "attr", "") or getattr(node.func, "id", "")
            if name in ASSERTING or name in LOCAL or name.startswith("assert_"):
                return True
    return False


def functions(tree):
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]


def asserting_helpers(trees):
    """Names of the helpers (not tests) that check a result, directly or through each other."""
    found: set[str] = set()
    while True:
        LOCAL.clear()
        LOCAL.update(found)
        more = {
            function.name
            for tree in trees
            for function in functions(tree)
            if not function.name.startswith("test_") and asserts(function)
        }
        if more <= found:
            return found
        found |= more


LOCAL: set[str] = set()


def test_every_test_asserts():
    trees = {path: ast.parse(path.read_text()) for path in sorted((ROOT / "tests").rglob("*.py"))}
    LOCAL.update(asserting_helpers(trees.values()))
    without = [
        f"{path.relative_to(ROOT)}: {function.name}"
        for path, tree in trees.items()
        for function in functions(tree)
        if function.name.startswith("test_") and not asserts(function)
    ]
    assert without == []


def test_a_test_without_an_assertion_is_found():
    LOCAL.clear()
    tree = ast.parse("def test_a():\n    draw()\ndef test_b():\n    assert draw()\n")
    assert [asserts(function) for function in functions(tree)] == [False, True]


def test_helpers_are_not_imported_from_test_modules():
    for path in sorted((ROOT / "tests").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
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
