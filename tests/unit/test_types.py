"""The types that editors and mypy see: arrays by their numbers, choices by their names, and nothing of unknown type."""

import ast
import importlib
import inspect
import os
import pathlib
import re
import subprocess
import sys
import typing

import pytest

import cubecam as cc
import cubecam.typing
from cubecam import demo, examples, navigation, pictures

PACKAGE = pathlib.Path(cc.__file__).parent
STUB = ast.parse((PACKAGE / "_core.pyi").read_text(encoding="utf-8"))

RIGHT = """\
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cubecam as cc
from cubecam.typing import Center, Convention, Pixels, Tonemap

def picture(tonemap: Tonemap | None = None) -> Pixels:
    scene = cc.Scene(environment=cc.load_environment(cc.sample_data("studio.exr"), size=64), background="navy")
    ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(tint=(1, 0.9, 0.8)), position=np.zeros(3))
    ball.position = [1, 2, 3]
    ball.position = ball.position + 1
    ball.scale = 2
    light = scene.add(cc.PointLight((0, 3, 0), color="white"))
    light.intensity = np.float32(2)
    glow = cc.ShaderMaterial("void shade() {}", uniforms={"time": 0.5, "tint": (1, 0, 0)})
    glow.uniforms["time"] = 2
    glow.uniforms = {"time": 3}
    glow.textures["map"] = cc.Image(np.zeros((4, 4, 3), np.float32), wrap="clamp")
    with cc.Renderer() as renderer:
        camera = cc.PerspectiveCamera()
        frame = renderer.render(scene, camera, (64, 48), outputs=["id"], tonemap=tonemap, format="rgba16f")
        cube = renderer.capture(scene, (0, 0, 0), 64, exclude=[ball], outputs="distance")
    nearest: np.float32 = cube.distance.min()
    ids: NDArray[np.int32] = frame.id
    width: int = frame.size[0]
    height: int = frame.color.shape[0]
    rgb = frame.color[..., :3]
    halved: NDArray[np.floating[Any]] = frame.color * 0.5
    print(nearest, ids.max(), width, height, halved, rgb.mean(), frame.outputs["id"].dtype)
    cube.save(Path("cube.exr"), layout="equirect", center="+z")
    cc.plot.cross(cube, arrows=True).set_title("probe")
    cc.plot.panorama(cube.distance, center="+x", ax=cc.plot.error_map(frame, frame, over="rms"))
    steps: NDArray[np.float64] = cc.plot.seam_ratios(cube)
    print(steps, cc.plot.EDGE_NAMES[0])
    return rgb

def convert(cube: cc.CubeMap, convention: Convention = "three", center: Center = "-z") -> Pixels:
    format_of = cc.Probe(format="rgba8", update=3).format
    same = cc.Probe(format=format_of, depth_format=None)
    assert same != cube
    return cube.to_convention(convention) if center == "-z" else cube.to_equirect(center=center)
"""

#: Each line is a mistake, with the text that mypy's report of it must hold.
WRONG = {
    'renderer.render(scene, camera, (4, 4), tonemap="bogus")': r"tonemap.*'reinhard', 'aces', 'neutral'",
    'renderer.render(scene, camera, (4, 4), encode="gamma")': "encode.*'srgb'",
    'renderer.render(scene, camera, (4, 4), format="rgba9")': "format.*'rgba8', 'rgba16f', 'rgba32f'",
    'renderer.render(scene, camera, (4, 4), depth_format="d24")': "depth_format.*'depth24_stencil8'",
    "renderer.render(scene, camera, 4)": r"tuple\[int, int\]",
    "renderer.render(scene, camera, (4, 4), sample=4)": "sample",
    'renderer.capture(scene, depth_order="back")': "depth_order.*'nearest', 'farthest'",
    'cube.to_convention("opengl")': "'gl', 'inside', 'three'",
    'cube.to_layout("strip")': "'cross', 'vertical_cross'",
    'cube.to_equirect(center="north")': "center.*'-z'",
    'cube.to_equirect(sampling="corners")': "sampling.*'centers', 'borders'",
    'cube.set_face("left", faces)': r"'\+x', '-x'",
    'cube.save("cube.png", layout="strip")': "layout.*'faces'",
    'cc.load_cubemap("a.png", convention="opengl")': "convention.*'gl', 'inside', 'three'",
    'cc.PhongMaterial(blend="x")': "blend.*'opaque', 'alpha'",
    'cc.Blend("half", "one")': "'zero', 'one', 'src_color'",
    'cc.Blend("one", "one", equation="sum")': "equation.*'add', 'subtract'",
    'cc.Stencil(func="eq")': "func.*'never', 'less'",
    'cc.Stencil(fail="drop")': "fail.*'keep', 'zero'",
    'cc.Image(faces, wrap="edge")': "wrap.*'repeat', 'clamp'",
    'cc.Probe(update="often")': "update.*'on_change', 'once', 'manual'",
    'cc.StereoCamera(camera, camera, layout="left")': "layout.*'anaglyph', 'side_by_side'",
    'cc.plot.cross(cube, convention="opengl")': "convention.*'gl', 'inside', 'three'",
    'cc.plot.error_map(cube, cube, over="mean")': "over.*'max', 'rms'",
    "cc.plot.strip(cube)": 'no attribute "strip"',
    "camera.fov = 'wide'": "SupportsFloat",
    "frame.colour": 'no attribute "colour"',
    "frame.color.shap": 'no attribute "shap"',
}
WRONG_HEAD = """\
import cubecam as cc

def mistakes(
    renderer: cc.Renderer, scene: cc.Scene, camera: cc.PerspectiveCamera, cube: cc.CubeMap, frame: cc.Frame
) -> None:
    faces = cube.faces
"""


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """Check both programs as a user does, and return what mypy says of each: (line, text)."""
    folder = tmp_path_factory.mktemp("programs")
    (folder / "right.py").write_text(RIGHT, encoding="utf-8")
    wrong = WRONG_HEAD + "".join(f"    {line}\n" for line in WRONG)
    (folder / "wrong.py").write_text(wrong, encoding="utf-8")
    installed = "site-packages" in PACKAGE.parts
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--config-file=", "right.py", "wrong.py"],
        cwd=folder,
        env=os.environ | ({} if installed else {"MYPYPATH": str(PACKAGE.parent)}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert re.search(r"Found \d+ errors", done.stdout), done.stdout
    # Of a function with several signatures, notes below the error have the names.
    found = re.findall(
        r"^(right|wrong)\.py:(\d+): (?:error|note): (.*)$", done.stdout, re.MULTILINE
    )
    return {
        program: [(int(line), text) for name, line, text in found if name == program]
        for program in ("right", "wrong")
    }


@pytest.mark.slow
def test_a_program_without_mistakes(reports):
    assert reports["right"] == []


@pytest.mark.slow
def test_each_mistake_has_its_report(reports):
    first = WRONG_HEAD.count("\n") + 1
    assert {line for line, _ in reports["wrong"]} == set(range(first, first + len(WRONG)))
    for number, (line, expected) in enumerate(WRONG.items(), start=first):
        said = " ".join(text for at, text in reports["wrong"] if at == number)
        assert re.search(expected, said), (line, said)


def functions(tree, owner=""):
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            yield from functions(node, node.name)
        elif isinstance(node, ast.FunctionDef):
            yield f"{owner}.{node.name}".lstrip("."), node


#: Names of cubecam.typing that are no list of names.
NOT_CHOICES = {"Color", "FilePixels", "Outputs", "Pixels", "RenderOptions"}
FUNCTIONS = list(functions(STUB))


def parameters(node):
    every = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    return every + [more for more in (node.args.vararg, node.args.kwarg) if more is not None]


def test_the_stub_has_types_for_everything():
    assert len(FUNCTIONS) > 300
    for name, node in FUNCTIONS:
        assert node.returns is not None or node.name == "__init__", name
        for parameter in parameters(node):
            assert not re.fullmatch(r"arg\d+", parameter.arg), f"{name}: {parameter.arg}"
            assert parameter.annotation is not None or parameter.arg == "self", name
        types = [p.annotation for p in parameters(node)] + [node.returns]
        for kind in filter(None, types):
            text = ast.unparse(kind)
            assert not re.search(r"\bAny\b", text), f"{name}: {text}"
            assert not re.search(r"\b(tuple|dict|list|ndarray)\b(?!\[)", text), f"{name}: {text}"


def is_getter(node):
    return any(ast.unparse(decorator) == "property" for decorator in node.decorator_list)


def test_arrays_have_their_numbers_and_their_shape():
    arrays = 0
    for name, node in FUNCTIONS:
        if not is_getter(node) or "NDArray" not in ast.unparse(node.returns):
            continue
        arrays += 1
        kinds = re.findall(r"NDArray\[(.*?)\]", ast.unparse(node.returns))
        assert all(
            re.fullmatch(r"(np\.\w+\d+)( \| np\.\w+\d+)*|np\.bool_", kind) for kind in kinds
        ), name
        summary = ast.get_docstring(node) or ""
        if "dict" not in ast.unparse(node.returns):
            assert re.match(r"ndarray \([^)]*,[^)]*\)", summary), f"{name}: {summary}"
    assert arrays > 40


def test_getters_of_choices_name_them():
    """A value that was read can be given back, so a getter and its setter have the same names."""
    getters = {name: node.returns for name, node in FUNCTIONS if is_getter(node)}
    setters = {
        name: ast.unparse(node.args.args[1].annotation)
        for name, node in FUNCTIONS
        if any(ast.unparse(d).endswith(".setter") for d in node.decorator_list)
    }
    choices = set(cubecam.typing.__all__) - NOT_CHOICES
    found = 0
    for name, given in setters.items():
        taken = set(re.findall(r"\w+", given)) & choices
        assert taken == set(re.findall(r"\w+", ast.unparse(getters[name]))) & choices, name
        found += bool(taken)
    assert found >= 8


@pytest.mark.parametrize("name", sorted(set(cubecam.typing.__all__) - NOT_CHOICES))
def test_choices_are_used(name):
    names = typing.get_args(getattr(cubecam.typing, name))
    assert names
    assert all(isinstance(one, int if name == "Fetches" else str) for one in names)
    used = [f for f, node in FUNCTIONS if re.search(rf"\b{name}\b", ast.unparse(node.args))]
    assert used, f"no function of the core takes a {name}"


def python_functions():
    """Yield the public functions written in Python and the public methods of their modules, by name."""
    for name in cc.__all__:
        if inspect.isfunction(getattr(cc, name)):
            yield name, getattr(cc, name)
    programs = [importlib.import_module(f"cubecam.examples.{name}") for name in examples.NAMES]
    for module in (demo, examples, navigation, pictures, *programs):
        for owner in (module, *vars(module).values()):
            inside = owner is module or inspect.isclass(owner)
            if not inside or getattr(owner, "__module__", module.__name__) != module.__name__:
                continue
            for name, thing in vars(owner).items():
                public = inspect.isfunction(thing) and not name.startswith("_")
                if public and thing.__module__ == module.__name__:
                    yield f"{module.__name__}.{thing.__qualname__}", inspect.unwrap(thing)


PYTHON_FUNCTIONS = dict(python_functions())
#: Functions that give one of two types, as a file says: with a union every program would have to ask which one it is.
GIVE_EITHER = {"open_batch"}


@pytest.mark.parametrize("name", PYTHON_FUNCTIONS)
def test_public_python_functions_have_exact_types(name):
    function = PYTHON_FUNCTIONS[name]
    types = function.__annotations__
    assert set(types) - {"return"} == set(inspect.signature(function).parameters) - {"self"}
    assert "return" in types
    for argument, kind in types.items():
        if argument == "return" and name in GIVE_EITHER:
            continue
        assert not re.search(r"\b(Any|Array)\b", kind), f"{argument}: {kind}"


def test_the_walk_finds_python_functions():
    assert {"load_cubemap", "cubecam.navigation.yaw", "cubecam.demo.DemoScene.turn"} <= set(
        PYTHON_FUNCTIONS
    )
    assert "cubecam.examples.skybox.draw" in PYTHON_FUNCTIONS


def test_render_options_are_those_of_render():
    render = next(node for name, node in FUNCTIONS if name == "Renderer.render")
    options = {p.arg: ast.unparse(p.annotation) for p in render.args.kwonlyargs}
    plain = {
        name: re.sub(r"\b(collections\.abc|typing)\.", "", kind) for name, kind in options.items()
    }
    source = ast.parse((PACKAGE / "typing.py").read_text(encoding="utf-8"))
    (mine,) = (node for node in source.body if isinstance(node, ast.ClassDef))
    fields = [node for node in mine.body if isinstance(node, ast.AnnAssign)]
    given = {ast.unparse(field.target): ast.unparse(field.annotation) for field in fields}
    assert given == plain
