"""The test follows CONTRIBUTING's recipe for a material exactly: it adds four files and changes no other file."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import textwrap

import pytest

from tests.build.tools import ROOT, run, tool
from tests.mutation import LEFT_OUT

pytestmark = pytest.mark.build

FILES = {
    "cpp/cubecam/materials/mix.hpp",
    "shaders/materials/mix.glsl",
    "cpp/bindings/bind_mix_material.cpp",
    "tests/gl/test_mix_material.py",
}


def blocks():
    """The recipe's files: the path that opens each step, and the code block of the step."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    section = text.split("## How to add a material", 1)[1].split("\n## ", 1)[0]
    steps = re.findall(r"^\d+\. `([^`]+)`:.*?^ +```\w+\n(.*?)^ +```$", section, re.M | re.S)
    return {path: textwrap.dedent(code) for path, code in steps}


def digests(tree):
    """The hash of every file of a tree, except the files that a build or a run has made."""
    return {
        str(path.relative_to(tree)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in tree.rglob("*")
        if path.is_file()
        and path.suffix != ".so"
        and path.name != "_shader_trial"
        and path.relative_to(tree).parts[0] not in LEFT_OUT
        and "__pycache__" not in path.parts
    }


def left_out(folder, names):
    """The names that shutil.copytree does not copy: caches, and build folders at the top, but not tests/build."""
    return {
        name
        for name in names
        if name == "__pycache__" or (folder == str(ROOT) and name in LEFT_OUT)
    }


def build(tree):
    """Compile the changed sources and copy the module into its package."""
    built = subprocess.run(
        [tool("cmake"), "--build", tree / "build", "--target", "_core"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert built.returncode == 0, built.stdout[-3000:] + built.stderr[-3000:]
    (module,) = (tree / "build").rglob("_core.*.so")
    for made in (module, module.parent / "_shader_trial"):
        shutil.copy2(made, tree / "python" / "cubecam")


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the sources that has the recipe's files and is built."""
    import pybind11

    folder = tmp_path_factory.mktemp("recipe")
    made = folder / "tree"
    shutil.copytree(str(ROOT), made, ignore=left_out)
    for module in (made / "python" / "cubecam").glob("_core*.so"):
        module.unlink()
    before = digests(made)
    for path, code in blocks().items():
        (made / path).write_text(code, encoding="utf-8")
    run(
        tool("cmake"), "-S", made, "-B", made / "build", "-G", "Ninja",
        f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}", f"-DPython_EXECUTABLE={sys.executable}",
        f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", "-DCUBECAM_BUILD_MODULE=ON",
        "-DCUBECAM_WERROR=ON", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O0",
    )  # fmt: skip
    build(made)
    return made, before


def run_in(tree, *command):
    return subprocess.run(
        [sys.executable, *command],
        cwd=tree,
        env={
            **os.environ,
            "PYTHONPATH": str(tree / "python"),
            "PYTHONDONTWRITEBYTECODE": "1",
        },
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_recipe_names_four_files():
    assert set(blocks()) == FILES
    assert not [path for path in FILES if (ROOT / path).exists()]


def check_own_test(tree):
    done = run_in(
        tree, "-m", "pytest", "-q", "-p", "no:cacheprovider",
        "-o", "addopts=--import-mode=importlib", "tests/gl/test_mix_material.py",
        "tests/unit/test_docstrings.py::test_examples",
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    assert " passed" in done.stdout


def test_its_own_test_passes(tree):
    check_own_test(tree[0])


SCRIPT = """
import pickle
import numpy as np
import cubecam as cc
assert cc.__file__.startswith({tree!r}), cc.__file__
assert "MixMaterial" in cc.__all__
first, second = np.zeros((2, 1, 1, 3), np.float32)
first[:], second[:] = (1, .5, 0), (0, .25, 1)
made = pickle.loads(pickle.dumps(cc.MixMaterial(first=first, second=second, share=.25)))
assert np.array_equal(made.first.pixels, first) and np.array_equal(made.second.pixels, second)
scene = cc.Scene(background=(0, 0, 0, 1))
scene.add(cc.Mesh.box((4, 4, .1)), made, position=(0, 0, -1))
with cc.Renderer(device={device!r}) as renderer:
    camera = cc.PerspectiveCamera(position=(0, 0, 1), target=(0, 0, 0))
    color = renderer.render(scene, camera, (3, 3), format="rgba32f").color
np.testing.assert_allclose(color[1, 1], (.75, .4375, .25, 1), atol=1e-5)
print("drawn as numpy says")
"""


def test_it_draws_what_numpy_says(tree):
    made, _ = tree
    device = os.environ.get("CUBECAM_TEST_DEVICE", "software")
    done = run_in(made, "-c", SCRIPT.format(tree=str(made), device=device))
    assert done.returncode == 0, done.stderr
    assert "drawn as numpy says" in done.stdout


def test_four_files_are_new_and_none_has_changed(tree):
    made, before = tree
    after = digests(made)
    assert {path for path in after if path not in before} == FILES
    assert {path: digest for path, digest in after.items() if path in before} == before


def test_a_kind_of_many_numbers_reads_them_from_its_block(tree):
    """Constants of more than two vec4 are no longer flat inputs of the shader (docs/adr/0004)."""
    made, _ = tree
    many = {
        "cpp/cubecam/materials/mix.hpp": [
            ("std::array<glm::vec4, 1>", "std::array<glm::vec4, 40>"),
            (
                "return {glm::vec4(share)};",
                "std::array<glm::vec4, 40> all{}; all[39].y = share; return all;",
            ),
        ],
        "shaders/materials/mix.glsl": [("material[0].x)", "material[39].y)")],
    }
    before = {path: (made / path).read_text(encoding="utf-8") for path in many}
    try:
        for path, changes in many.items():
            text = before[path]
            for old, new in changes:
                assert text.count(old) == 1, old
                text = text.replace(old, new)
            (made / path).write_text(text, encoding="utf-8")
        build(made)
        check_own_test(made)
    finally:
        for path, text in before.items():
            (made / path).write_text(text, encoding="utf-8")
