"""Broken shaders: sound ones with tokens changed, ones that a grammar makes, and those that end drivers.

A case is a source whose first line says what it is: a fragment source, a vertex source or an effect. It draws, or
raises ShaderError or ValueError. What draws gives the same bytes in another renderer: otherwise memory that nobody
wrote would show.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from typing import Any

import numpy as np

import cubecam as cc
from tests.fuzz.killers import KILLERS, body
from tests.fuzz.runner import Target
from tests.gl.full_world import EFFECT_SOURCES, SOURCES, VERTEX_SOURCES
from tests.helpers import DEVICE

TOKEN = re.compile(r"\s+|\w+(?:\.\d*)?|\d+\.\d*(?:e[+-]?\d+)?|//[^\n]*|[^\w\s]")
OTHER = [
    "0", "1", "-1", "1.0", "0.0", "1e38", "1e-38", "2147483647", "-2147483648", "4294967295u", "0.0/0.0", "1.0/0.0",
    "float", "int", "uint", "bool", "vec2", "vec3", "vec4", "ivec3", "mat3", "mat4", "dvec3", "sampler2D", "samplerCube",
    "void", "const", "in", "out", "inout", "uniform", "flat", "precise", "if", "else", "for", "while", "do", "switch",
    "case", "default", "break", "continue", "return", "discard", "struct", "layout", "true", "false", "s", "s.uv",
    "s.uv.x", "s.normal", "v.position", "uv", "texture", "textureLod", "texelFetch", "frame", "frame_pixel", "phong",
    "environment", "environment_mip", "environment_filtered", "sin", "pow", "inverse", "normalize", "dFdx", "length",
    "+", "-", "*", "/", "%", "<<", ">>", "&", "|", "^", "~", "!", "&&", "||", "^^", "<", ">", "==", "=", "+=", "/=", "%=",
    "?", ":", ";", ",", ".", "(", ")", "{", "}", "[", "]", "++", "--", "#", "\n#define x x\n", "\n#if 0\n", "\n#endif\n",
    "/*", "*/", "//", "\\\n", "\n#line 7\n", "\n#include \"a.glsl\"\n", "main", "gl_FragCoord", "gl_FragDepth",
    "gl_Position", "gl_Layer", "gl_SampleMask[0]", "u_frame", "o_color", "material", "shade", "vertex", "effect", "\u00e4",
]  # fmt: skip

TYPES = ["float", "int", "uint", "bool", "vec2", "vec3", "vec4", "ivec2", "ivec3", "mat2", "mat3", "mat4"]
UNARY = ["sin", "cos", "tan", "asin", "exp", "exp2", "log", "sqrt", "inversesqrt", "abs", "sign", "floor", "fract", "dFdx", "fwidth"]
BINARY = ["pow", "mod", "min", "max", "step", "atan", "reflect", "distance"]


class Grammar:
    """Makes statements and expressions; now and then one has a type that does not fit."""

    def __init__(self, rng: np.random.Generator, names: dict[str, str]) -> None:
        self.rng = rng
        self.names = dict(names)  # name -> type
        self.loops = 0
        self.unary = UNARY if "v.position" not in names else UNARY[:-2]  # vertices have no derivatives

    def one(self, *choices: str) -> str:
        return choices[self.rng.integers(len(choices))]

    def number(self, kind: str) -> str:
        """A constant of a type."""
        if kind == "float":
            return self.one("0.0", "1.0", "0.5", "-2.0", "1e30", "1e-30", f"{self.rng.normal():.4f}")
        if kind == "int":
            return self.one("0", "1", "-1", "7", "2147483647", "(-2147483647 - 1)")
        if kind == "uint":
            return self.one("0u", "1u", "31u", "4294967295u")
        if kind == "bool":
            return self.one("true", "false")
        inner = "int" if kind[0] == "i" else "float"
        return f"{kind}({self.number(inner)})"

    def expression(self, kind: str, depth: int) -> str:
        """An expression of a type."""
        if self.rng.random() < 0.002:
            kind = self.one(*TYPES)
        fits = [name for name, of in self.names.items() if of == kind]
        if depth <= 0 or self.rng.random() < 0.15:
            return self.one(*fits) if fits and self.rng.random() < 0.7 else self.number(kind)
        way = self.rng.random()
        sub = functools.partial(self.expression, depth=depth - 1)
        if way < 0.1:
            return f"({sub('bool')} ? {sub(kind)} : {sub(kind)})"
        if kind == "bool":
            of = self.one("float", "int", "uint")
            return f"({sub(of)} {self.one('<', '>', '==', '<=', '!=')} {sub(of)})"
        if kind in ("int", "uint"):
            if way < 0.3:
                return f"{kind}({sub('float')})"
            signs = ("+", "-", "*", "/", "%", "&", "|", "^", "<<", ">>")
            return f"({sub(kind)} {self.one(*signs)} {sub(kind)})"
        if kind == "float":
            if way < 0.3:
                return f"{sub('vec3')}.{self.one('x', 'y', 'z')}"
            if way < 0.5:
                return f"{self.one(*self.unary)}({sub('float')})"
            if way < 0.6:
                return f"float({sub('int')})"
            if way < 0.7:
                return f"dot({sub('vec3')}, {sub('vec3')})"
        if kind[0] == "m":
            if way < 0.3:
                return f"{self.one('inverse', 'transpose')}({sub(kind)})"
            return f"({sub(kind)} {self.one('+', '-', '*')} {sub(kind)})"
        if kind[0] == "i":
            return f"({sub(kind)} {self.one('+', '*', '/', '%')} {sub(kind)})"
        if kind == "vec3":
            if way < 0.25:
                return f"({sub('mat3')} * {sub('vec3')})"
            if way < 0.35:
                return f"texture(t, {sub('vec2')}).{self.one('rgb', 'bgr', 'xxx')}"
            if way < 0.45:
                return f"vec3({sub('float')}, {sub('vec2')})"
            if way < 0.5:
                return f"normalize({sub('vec3')})"
        if kind in ("vec2", "vec4") and way < 0.3:
            return f"{sub('vec3')}.{'zy' if kind == 'vec2' else 'xyzz'}"
        if way < 0.6 and kind != "float":
            return f"{self.one(*self.unary)}({sub(kind)})"
        if way < 0.75:
            return f"{self.one(*BINARY[:5])}({sub(kind)}, {sub(kind)})"
        return f"({sub(kind)} {self.one('+', '-', '*', '/')} {sub(kind)})"

    def statement(self, depth: int) -> str:
        """A statement: a new name, a value for an old one, a branch or a loop."""
        way = self.rng.random()
        kind = self.one(*TYPES)
        if way < 0.4 or depth <= 0:
            name = f"n{len(self.names)}"
            text = f"{kind} {name} = {self.expression(kind, depth)};"
            if self.rng.random() < 0.05:
                text = f"{kind} {name};"
            self.names[name] = kind
            return text
        if way < 0.6:
            name = self.one(*self.names)
            return f"{name} {self.one('=', '+=', '-=', '*=')} {self.expression(self.names[name], depth)};"
        kept = dict(self.names)
        inner = " ".join(self.statement(depth - 1) for _ in range(self.rng.integers(1, 4)))
        self.names = kept
        if way < 0.75:
            return f"if ({self.expression('bool', depth)}) {{ {inner} }}"
        self.loops += 1
        index = f"i{self.loops}"
        if way < 0.9:
            end = self.one("3", "8", "int(uv.x * 9.0)", "60")
            return f"for (int {index} = 0; {index} < {end}; ++{index}) {{ {inner} }}"
        if way < 0.96:
            return f"for (int {index} = 0; {index} < 99; ++{index}) {{ {inner} if ({self.expression('bool', 1)}) break; }}"
        return f"switch ({self.expression('int', 1)}) {{ case 0: {{ {inner} }} break; default: {{ {inner} }} }}"

    def block(self, size: int) -> str:
        """Statements one after the other."""
        return " ".join(self.statement(3) for _ in range(size))


def _made(rng: np.random.Generator) -> str:
    kind = ["fragment", "vertex", "effect"][rng.choice(3, p=[0.6, 0.2, 0.2])]
    names = {"uv": "vec2"}
    if kind == "vertex":
        grammar = Grammar(rng, {"v.position": "vec3", "v.normal": "vec3", "uv": "vec2"})
        text = grammar.block(int(rng.integers(1, 8)))
        lines = f"uniform sampler2D t; void vertex(inout Vertex v) {{ vec2 uv = v.uv; {text} v.position += {grammar.expression('vec3', 3)}; }}"
        return f"// {kind}\n{lines}"
    grammar = Grammar(rng, {**names, **({"s.normal": "vec3", "s.position": "vec3"} if kind == "fragment" else {})})
    text = grammar.block(int(rng.integers(1, 8)))
    result = grammar.expression("vec3", 4)
    if kind == "effect":
        return f"// effect\nuniform sampler2D t; vec3 effect(vec2 uv) {{ {text} return {result}; }}"
    return "// fragment\nuniform sampler2D t; " + body(f"vec2 uv = s.uv; {text} return {result};")


def _mutated(rng: np.random.Generator) -> str:
    kind, sources = [("fragment", SOURCES), ("vertex", VERTEX_SOURCES), ("effect", EFFECT_SOURCES)][rng.integers(3)]
    text = sources[rng.integers(len(sources))]
    if rng.random() < 0.3:
        text = _made(rng)
        kind, text = text.split("\n", 1)[0][3:], text.split("\n", 1)[1]
    tokens = TOKEN.findall(text)
    for _ in range(rng.choice([1, 1, 2, 3, 8])):
        place = int(rng.integers(len(tokens)))
        way = rng.random()
        if way < 0.2:
            del tokens[place]
        elif way < 0.3:
            tokens.insert(place, tokens[place])
        elif way < 0.4:
            other = int(rng.integers(len(tokens)))
            tokens[place], tokens[other] = tokens[other], tokens[place]
        elif way < 0.45:
            tokens = tokens[:place]
        elif way < 0.75:
            tokens[place] = OTHER[rng.integers(len(OTHER))]
        else:
            tokens.insert(place, " " + OTHER[rng.integers(len(OTHER))] + " ")
        tokens = tokens or [" "]
    return f"// {kind}\n{''.join(tokens)}"


def _killer(rng: np.random.Generator) -> str:
    makers = list(KILLERS.values())
    maker, size = makers[rng.integers(len(makers))]
    return "// fragment\n" + maker(max(1, int(size * 2.0 ** -rng.uniform(0, 12))))


def make(number: int) -> bytes:
    """Write the source of a number."""
    rng = np.random.default_rng([number, 8])
    way = rng.random()
    text = _killer(rng) if way < 0.1 else _mutated(rng) if way < 0.55 else _made(rng)
    return text.encode()


@functools.cache
def _drawn_with() -> tuple[cc.Renderer, cc.Renderer]:
    return cc.Renderer(device=DEVICE), cc.Renderer(device=DEVICE)


@functools.cache
def _image() -> cc.Image:
    return cc.Image(np.arange(60, dtype=np.uint8).reshape(4, 5, 3))


@functools.cache
def _cube() -> cc.CubeMap:
    return cc.CubeMap(np.full((6, 4, 4, 3), 0.5, np.float32))


def picture(renderer: cc.Renderer, kind: str, source: str) -> Any:
    """Draw 6 x 5 pixels with a source."""
    inputs: dict[str, Any] = {"uniforms": {}, "textures": {}}
    for name, value in (("tone", (0.5, 0.6, 0.7)), ("strength", 0.5), ("time", 0.5)):
        if re.search(rf"uniform \w+ {name}\b", source):
            inputs["uniforms"][name] = value
    for name, texture in (("t", _image()), ("veil", _image()), ("picture", _image()), ("around", _cube())):
        if re.search(rf"uniform sampler\w+ {name}\b", source):
            inputs["textures"][name] = texture
    scene, effects = cc.Scene(environment=_cube()), []
    scene.add(cc.PointLight(position=(1, 2, 3)))
    material: cc.Material = cc.BasicMaterial()
    if kind == "effect":
        effects = [cc.ImageEffect(source, **inputs)]
    elif kind == "vertex":
        material = cc.ShaderMaterial("vec3 shade(Surface s) { return s.normal; }", vertex=source, **inputs)
    else:
        material = cc.ShaderMaterial(source, **inputs)
    scene.add(cc.Mesh.plane(2, 2), material, rotation=cc.axis_angle((1, 0, 0), 90))
    camera = cc.PerspectiveCamera(position=(0.1, 0.2, 2), target=(0, 0, 0))
    return renderer.render(scene, camera, (6, 5), format="rgba32f", effects=effects).color


def attempt(case: bytes, folder: Path) -> None:
    """Draw with a source; what draws is drawn by a second renderer, too."""
    head, _, source = case.decode(errors="surrogateescape").partition("\n")
    one, other = _drawn_with()
    try:
        first = picture(one, head[3:], source)
        if len(case) % 3 == 0:
            second = picture(other, head[3:], source)
            assert np.array_equal(first, second, equal_nan=True), "two renderers draw two pictures"
    except (cc.ShaderError, ValueError):
        return


TARGET = Target(
    name="glsl",
    make=make,
    attempt=attempt,
    sound=lambda: [f"// fragment\n{s}".encode() for s in SOURCES],
    suffix="glsl",
    seconds=15.0,  # a limit of 10 s in a helper process, whose CPU is not counted, but which is waited for
    memory=1500 << 20,
)
