"""Calls with absurd arguments: short programs, of calls and assignments to properties that the stubs list.

A case is the text of a program, one statement a line. Each line may raise what `world.EXPECTED` lists, so that the next
one runs; in the end everything is drawn, pickled and shown. About half of the arguments fit their annotations: a call
whose every argument is wrong ends at the first check.
"""

from __future__ import annotations

import ast
import functools
import inspect
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import numpy as np

import cubecam as cc
import cubecam.navigation
import cubecam.typing
from tests.fuzz import hostile
from tests.fuzz.runner import Target
from tests.fuzz.world import World, draw, expected, use

STUB = Path(cc.__file__).parent / "_core.pyi"
#: These open windows, start servers, or end with the process only.
LEFT_OUT = {"show", "Viewer", "__dlpack__", "__exit__", "devices", "__init_subclass__"}
#: Functions of Python: the stubs list what the extension has.
FUNCTIONS = [
    "cc.brdf", "cc.fresnel", "cc.reflect", "cc.refract", "cc.schlick", "cc.to_screen", "cc.save_image",
    "cc.save_animation", "cc.load_image", "cc.load_mesh", "cc.load_scene", "cc.load_cubemap", "cc.load_environment",
    "cc.sample_data", "cc.scene_hash", "cc.navigation.yaw", "cc.navigation.pitch", "cc.navigation.walk", "cc.navigation.strafe",
    "cc.navigation.orbit", "cc.navigation.look",
]  # fmt: skip

#: Expressions that give an object of a class, in the world of a program.
OBJECTS = {
    "Node": ["w.node", "w.ball", "w.bent", "w.group", "w.scene[0]", "cc.Scene().add(w.mesh)"],
    "Scene": ["w.scene", "w.scene", "w.other", "cc.Scene()"],
    "Mesh": ["w.mesh", "w.node.mesh", "cc.Mesh.box()", "cc.Mesh.icosphere(1, 0)"],
    "Material": ["w.basic", "w.phong", "w.mirror", "w.glass", "w.standard", "w.shader"],
    "BasicMaterial": ["w.basic"],
    "PhongMaterial": ["w.phong"],
    "MirrorMaterial": ["w.mirror"],
    "GlassMaterial": ["w.glass"],
    "StandardMaterial": ["w.standard"],
    "ShaderMaterial": ["w.shader"],
    "ImageEffect": ["w.effect", "cc.ImageEffect('vec3 effect(vec2 uv) { return vec3(uv, 1.0); }')"],
    "Light": ["w.point", "w.spot", "w.sun", "w.ambient"],
    "AnyLight": ["w.point", "w.spot", "w.sun", "w.ambient", "cc.PointLight()"],
    "PointLight": ["w.point", "cc.PointLight()"],
    "SpotLight": ["w.spot"],
    "DirectionalLight": ["w.sun"],
    "AmbientLight": ["w.ambient"],
    "Camera": ["w.matrices", "w.camera", "w.flat"],
    "PerspectiveCamera": ["w.camera", "cc.PerspectiveCamera()"],
    "OrthographicCamera": ["w.flat"],
    "StereoCamera": ["w.stereo"],
    "CubeMap": ["w.cube", "cc.CubeMap(np.ones((6, 2, 2, 4), np.uint8))"],
    "Image": ["w.image"],
    "Texture": ["w.texture"],
    "RenderTexture": ["w.screen"],
    "Probe": ["w.probe", "cc.Probe(size=2)"],
    "PlanarMirror": ["cc.PlanarMirror()"],
    "ProbeBlend": ["cc.ProbeBlend([w.probe])"],
    "ProbeGrid": ["cc.ProbeGrid(((-1, -1, -1), (1, 1, 1)), (2, 2, 2), size=2, resolution=4)"],
    "MorphTarget": ["w.target"],
    "Skin": ["w.skin"],
    "Animation": ["w.animation"],
    "AnimationChannel": ["w.channel"],
    "Shadow": ["w.shadow"],
    "Blend": ["w.blend"],
    "Stencil": ["w.stencil"],
    "Frame": ["w.frame"],
    "Renderer": ["w.renderer"],
    "Stats": ["w.renderer.stats"],
    "RendererInfo": ["w.renderer.info"],
    "Limits": ["w.renderer.info.limits"],
    "Face": ["cc.Face(0)"],
    "Device": ["None"],
}  # fmt: skip

ARRAYS = [
    "(0, 1, 0)", "(0.5, 0.25, 1)", "(1, 0, 0, 0.5)", "np.eye(4)", "np.eye(3)", "np.ones((24, 3), 'f4')", "w.mesh.indices",
    "w.mesh.positions", "w.mesh.uvs", "np.ones((4, 8, 3), 'f4')", "np.ones((4, 4, 3), np.uint8)", "[0.5]", "(0.5, 2)",
    "np.ones((6, 4, 4, 3), np.float32)", "np.ones((4, 4, 3), np.float32)", "np.ones((9, 3))", "[0, 1]", "[[0, 0, 0], [1, 1, 1]]",
]  # fmt: skip
PATHS = [
    "'a.png'",
    "'a.exr'",
    "'a.hdr'",
    "Path('a.ktx2')",
    "'a.dds'",
    "'a.glb'",
    "'a.gif'",
    "'nowhere/a.png'",
    "'.'",
]
WORDS = [
    "'color'",
    "'a'",
    "'id'",
    "'distance'",
    "'heat'",
    "'srgb'",
    "'studio.exr'",
    "'tone'",
    "'veil'",
    "'strength'",
]


@dataclass(frozen=True)
class Call:
    """A function, or a property that is set: its parameters have annotations, as text."""

    receiver: str  # the class of the object before the dot; empty: no object
    name: str
    parameters: tuple[tuple[str, str, bool], ...]  # name, annotation, whether it may be left out
    by_name: frozenset[str]  # parameters that only a name reaches
    kind: str  # call, get, set


def _parameters(arguments: ast.arguments) -> list[tuple[str, str, bool]]:
    plain = [*arguments.posonlyargs, *arguments.args]
    free = [False] * (len(plain) - len(arguments.defaults)) + [True] * len(arguments.defaults)
    found = [
        (a.arg, ast.unparse(a.annotation) if a.annotation else "object", optional)
        for a, optional in zip(plain, free, strict=True)
    ]
    for a, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
        text = ast.unparse(a.annotation) if a.annotation else "object"
        found.append((a.arg, text, default is not None))
    return found


def _of_function(owner: str, function: ast.FunctionDef) -> Call | None:
    words = [ast.unparse(decorator) for decorator in function.decorator_list]
    if function.name in LEFT_OUT or (function.name[:1] == "_" and function.name[:2] != "__"):
        return None
    parameters = _parameters(function.args)
    named = frozenset(a.arg for a in function.args.kwonlyargs)
    static = "staticmethod" in words or not owner
    if not static:
        parameters = parameters[1:]
    name, kind, receiver = function.name, "call", owner
    if any(word.endswith(".setter") for word in words):
        kind = "set"
    elif "property" in words:
        kind = "get"
    if name == "__init__":
        receiver, name = "", f"cc.{owner}"
    elif static:
        receiver, name = "", f"cc.{owner}.{name}".replace("..", ".")
    return Call(receiver, name, tuple(parameters), named, kind)


@functools.cache
def calls() -> tuple[Call, ...]:
    """All that programs can do, from the stubs and from the signatures of the functions in Python."""
    found = []
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef):
            found.append(_of_function("", node))
        elif isinstance(node, ast.ClassDef) and node.name in OBJECTS:
            found += [
                _of_function(node.name, m) for m in node.body if isinstance(m, ast.FunctionDef)
            ]
    for text in FUNCTIONS:
        parameters = inspect.signature(eval(text, {"cc": cc})).parameters.values()
        found.append(
            Call(
                "",
                text,
                tuple((p.name, str(p.annotation), p.default is not p.empty) for p in parameters),
                frozenset(p.name for p in parameters if p.kind is p.KEYWORD_ONLY),
                "call",
            )
        )
    kept = [call for call in found if call is not None]
    # What takes no argument says little; some of it is there, to be called after other lines.
    return (
        *(call for call in kept if call.parameters),
        *[c for c in kept if not c.parameters][::6],
    )


def _literals(word: str) -> list[str]:
    """The names that a choice accepts, as Python."""
    alias = getattr(cubecam.typing, word, None)
    return [repr(value) for value in get_args(alias)] if alias is not None else []


def _fitting(annotation: str, name: str, rng: np.random.Generator) -> str:
    """An expression that may fit an annotation."""
    options: list[str] = []
    if name in ("size", "width", "segments", "rings", "sides", "subdivisions"):
        return _one(rng, "1", "2", "4", "(4, 3)", "np.int32(5)", "(1, 1)")
    if name in ("path", "where") or "PathLike" in annotation:
        return _one(rng, *PATHS)
    if name in ("fragment", "vertex"):
        return _one(
            rng, "w.shader.fragment", "w.effect.fragment", "'void vertex(inout Vertex v) {}'"
        )
    for word in re.findall(r"[A-Za-z_]+", annotation):
        one = OBJECTS.get(word) or _literals(word)
        if one:
            options.append(
                f"[{_one(rng, *one)}]"
                if "Iterable" in annotation or "Sequence" in annotation
                else _one(rng, *one)
            )
    if "ArrayLike" in annotation or "Pixels" in annotation or "Color" in annotation:
        options.append(_one(rng, *ARRAYS))
    if "SupportsFloat" in annotation or "float" in annotation:
        options.append(_one(rng, "0.5", "1", "2.5", "np.float32(0.3)", "0"))
    if re.search(r"SupportsIndex|SupportsInt|\bint\b", annotation):
        options.append(_one(rng, "1", "2", "4", "0"))
    if "bool" in annotation:
        options.append(_one(rng, "True", "False"))
    if "str" in annotation:
        options.append(
            _one(rng, *WORDS) if "Iterable" not in annotation else f"[{_one(rng, *WORDS)}]"
        )
    if "None" in annotation:
        options.append("None")
    if "Mapping" in annotation or "dict" in annotation:
        options.append(
            _one(
                rng,
                "{'tone': (1, 0, 0)}",
                "{'veil': w.image}",
                "{'strength': 1}",
                "{}",
                "{'a': w.phong}",
            )
        )
    if "DType" in annotation or "dtype" in annotation:
        options.append(_one(rng, "'u1'", "'f2'", "np.float32"))
    return _one(rng, *options) if options else _absurd(rng)


def _one(rng: np.random.Generator, *choices: str) -> str:
    return choices[rng.integers(len(choices))]


def _absurd(rng: np.random.Generator) -> str:
    if rng.random() < 0.2:
        thing = _one(rng, *OBJECTS)
        return _one(rng, *OBJECTS[thing], f"cc.{thing}.__new__(cc.{thing})", f"cc.{thing}")
    return _one(rng, *hostile.VALUES)


def _argument(annotation: str, name: str, absurd: float, rng: np.random.Generator) -> str:
    if rng.random() < absurd:
        return _absurd(rng)
    return _fitting(annotation, name, rng)


def _line(call: Call, number: int, rng: np.random.Generator) -> str:
    """One statement of a program."""
    absurd = rng.choice([0.0, 0.15, 0.5, 0.9])
    target = ""
    if call.receiver:
        target = _one(rng, *OBJECTS[call.receiver]) + "."
        if rng.random() < 0.03:
            target = f"cc.{call.receiver}.__new__(cc.{call.receiver})."
        elif rng.random() < 0.1:
            result = f"r{rng.integers(4)}"
            target = f"({target[:-1]} if {result} is None else {result})."
    if call.kind == "set":
        name, annotation, _ = call.parameters[0]
        return f"{target}{call.name} = {_argument(annotation, call.name, max(0.3, absurd), rng)}"
    if call.kind == "get":
        return f"r{number} = {target}{call.name}"
    words = []
    for name, annotation, optional in call.parameters:
        if (optional and rng.random() < 0.6) or rng.random() < 0.02:
            continue
        value = _argument(annotation, name, absurd, rng)
        words.append(f"{name}={value}" if optional or name in call.by_name else value)
    if rng.random() < 0.02:
        words.append("nothing=1")
    words.sort(key=lambda word: bool(re.match(r"\w+=", word)))
    return f"r{number} = {target}{call.name}({', '.join(words)})"


def make(number: int) -> bytes:
    """Write the program of a number."""
    rng = np.random.default_rng([number, 5])
    every = calls()
    lines = [_line(every[rng.integers(len(every))], i, rng) for i in range(rng.integers(1, 5))]
    return "\n".join(lines).encode()


def attempt(case: bytes, folder: Path) -> None:
    """Run a program in a new world; then use and draw what it made."""
    os.chdir(folder)  # programs write files
    world = World()
    names: dict[str, Any] = {
        "cc": cc, "np": np, "w": world, "hostile": hostile, "nan": hostile.NAN, "inf": hostile.INF, "Path": Path,
        "r0": None, "r1": None, "r2": None, "r3": None,
    }  # fmt: skip
    for line in case.decode().splitlines():
        with expected():
            exec(line, names)
    for number in range(4):
        use(names[f"r{number}"], world)
    draw(world, len(case))


TARGET = Target(
    name="api",
    make=make,
    attempt=attempt,
    sound=lambda: [b"r0 = w.scene.add(cc.Mesh.box())", b"w.node.scale = 2"],
    seconds=10.0,
    memory=1200 << 20,
)
