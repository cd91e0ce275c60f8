"""Shaders that end or stop a driver: what an attack on cubecam found, and their relatives.

Each is a function of a size. With its own size it is as bad as it can be; mutations of it have other sizes.
"""

from __future__ import annotations

from collections.abc import Callable

SHADE = "vec3 shade(Surface s) {{ {} }}"


def body(text: str, before: str = "") -> str:
    """A fragment source with statements in its `shade`."""
    return before + "vec3 shade(Surface s) { " + text + " }"


def calls(size: int) -> str:
    """A chain of functions, each of which calls the one before twice."""
    parts = ["float f0(float x) { return x + 1.0; }\n"]
    parts += [f"float f{i}(float x) {{ return f{i - 1}(x) + f{i - 1}(x * 0.5); }}\n" for i in range(1, size)]
    return body(f"return vec3(f{max(size, 1) - 1}(s.uv.x));", "".join(parts))


def doubling(size: int) -> str:
    """Macros that double what the one before gives."""
    lines = ["#define M0 s.uv.x\n", *(f"#define M{i} M{i - 1} + M{i - 1}\n" for i in range(1, size + 1))]
    return body(f"return vec3(M{size});", "".join(lines))


def structs(size: int) -> str:
    """Structs that hold two of the one before."""
    lines = ["struct S0 { float a; };\n", *(f"struct S{i} {{ S{i - 1} a; S{i - 1} b; }};\n" for i in range(1, size))]
    return body(f"S{max(size, 1) - 1} t; return vec3(s.uv, 0.0);", "".join(lines))


def uniforms(size: int) -> str:
    """As many uniforms of four numbers."""
    lines = "".join(f"uniform vec4 a{i} = vec4(1.0);\n" for i in range(size))
    return body(f"return a{max(size, 1) - 1}.rgb;", lines)


def samplers(size: int) -> str:
    """As many samplers."""
    lines = "".join(f"uniform sampler2D t{i};\n" for i in range(size))
    terms = " + ".join(f"texture(t{i}, s.uv).rgb" for i in range(size)) or "vec3(0.0)"
    return body(f"return {terms};", lines)


def outputs(size: int) -> str:
    """As many outputs."""
    lines = "".join(f"out vec4 o{i};\n" for i in range(size))
    return body("".join(f"o{i} = vec4(1.0);" for i in range(size)) + "return vec3(1.0);", lines)


def loops(size: int) -> str:
    """Loops in loops, of constant length."""
    head = "".join(f"for (int i{i} = 0; i{i} < 64; ++i{i}) " for i in range(size))
    return body(f"float x = 0.0; {head} x += s.uv.x; return vec3(x);")


def nested(before: str, inner: str, after: str) -> Callable[[int], str]:
    """An expression in an expression."""
    return lambda size: body(f"return vec3({before * size}{inner}{after * size});")


#: By name: what makes the source, and the size at which it is worst.
KILLERS: dict[str, tuple[Callable[[int], str], int]] = {
    "quotient of constants": (lambda n: body("int a = (-2147483647-1)/-1; return vec3(float(a));"), 1),
    "remainder of constants": (lambda n: body("int a = (-2147483647-1)%-1; return vec3(float(a));"), 1),
    "division by zero": (lambda n: body("return vec3(float(1/0) + float(1u/0u) + float(5%0));"), 1),
    "division at run time": (
        lambda n: body("int a = int(s.uv.x) - 2147483647 - 1, b = int(s.uv.y) - 1; return vec3(float(a / b + a % b + a / (b + 1)));"),
        1,
    ),
    "vectors divided": (lambda n: body("ivec3 a = ivec3(-2147483647-1)/ivec3(-1,0,1); return vec3(a);"), 1),
    "a long sum": (lambda n: body("return vec3(" + " + ".join(["s.uv.x"] * max(n, 1)) + ");"), 20_000),
    "a long sum of constants": (lambda n: body("return vec3(" + "+".join(["1.0"] * max(n, 1)) + ");"), 100_000),
    "an array of a billion": (lambda n: body(f"float a[{n}]; a[int(s.uv.x)] = 1.0; return vec3(a[3]);"), 1_000_000_000),
    "an array of a million": (
        lambda n: body(f"float a[{n}]; for (int i = 0; i < {n}; ++i) a[i] = s.uv.x; return vec3(a[int(s.uv.y * 9.0)]);"),
        1_000_000,
    ),
    "an array of arrays": (lambda n: body(f"float a[{n}][{n}][{n}]; a[1][1][1] = 1.0; return vec3(a[0][1][0]);"), 1000),
    "a constant array": (
        lambda n: body("return vec3(a[int(s.uv.x)]);", f"const float a[{n}] = float[{n}](" + ",".join(["1.0"] * n) + ");\n"),
        100_000,
    ),
    "doubling macros": (doubling, 25),
    "many cases": (
        lambda n: body(
            "float x = 0.0; switch (int(s.uv.x * 9.0)) { "
            + "".join(f"case {i}: x += {i}.0; break; " for i in range(n)) + "} return vec3(x);"
        ),
        20_000,
    ),
    "a chain of calls": (calls, 5000),
    "a chain of calls that doubles": (calls, 26),
    "structs that double": (structs, 40),
    "deep parentheses": (nested("(", "s.uv.x", ")"), 100_000),
    "deep calls": (nested("sin(", "s.uv.x", ")"), 20_000),
    "deep negation": (nested("- -", "s.uv.x", ""), 50_000),
    "deep choice": (nested("s.uv.x > 0.5 ? 1.0 : ", "0.0", ""), 20_000),
    "deep blocks": (lambda n: body("{" * n + "}" * n + " return vec3(1.0);"), 50_000),
    "deep conditions": (lambda n: body("float x = 0.0; " + "if (s.uv.x > 0.1) { x += 1.0; " * n + "}" * n + " return vec3(x);"), 5000),
    "deep loops": (loops, 8),
    "many loops": (lambda n: body("float x = 0.0; " + "for (int i = 0; i < 40; ++i) x += sin(x + s.uv.x); " * n + "return vec3(x);"), 400),
    "many uniforms": (uniforms, 20_000),
    "a uniform array": (lambda n: body("return a[int(s.uv.x)].rgb;", f"uniform vec4 a[{n}];\n"), 1_000_000),
    "many samplers": (samplers, 200),
    "many outputs": (outputs, 100),
    "many functions": (lambda n: body("return vec3(1.0);", "".join(f"float f{i}() {{ return {i}.0; }}\n" for i in range(n))), 50_000),
    "many variables": (lambda n: body("".join(f"vec4 v{i} = vec4(s.uv, {i}.0, 1.0); " for i in range(n)) + "return v0.rgb;"), 20_000),
    "live variables": (
        lambda n: body(
            "".join(f"vec4 v{i} = sin(vec4(s.uv, {i}.0, 1.0)); " for i in range(n))
            + "vec4 x = vec4(0.0); " + "".join(f"x += v{i} * v{n - 1 - i}; " for i in range(n)) + "return x.rgb;"
        ),
        3000,
    ),
    "matrices": (lambda n: body("mat4 m = mat4(s.uv.x); " + "m = inverse(m) * m + m; " * n + "return m[0].xyz;"), 500),
    "an endless loop": (lambda n: body("float x = 0.0; while (true) x += s.uv.x; return vec3(x);"), 1),
    "an endless loop without use": (lambda n: body("for (;;) {} return vec3(1.0);"), 1),
    "an endless loop of two": (lambda n: body("float x; for (;;) { for (;;) x += 1.0; } return vec3(x);"), 1),
    "recursion": (lambda n: body("return vec3(f(s.uv.x));", "float f(float x) { return x > 1.0 ? x : f(x + 0.1); }\n"), 1),
    "recursion of two": (lambda n: body("return vec3(f(1.0));", "float g(float x); float f(float x) { return g(x); } float g(float x) { return f(x); }\n"), 1),
    "shifts": (lambda n: body("int a = 1 << 33; int b = -1 >> -5; int c = 1 << int(s.uv.x * 99.0); return vec3(float(a + b + c));"), 1),
    "numbers out of range": (lambda n: body("return vec3(float(int(1e30)) + float(uint(-1e30)) + float(int(0.0/0.0)) + 1e999);"), 1),
    "a place outside": (lambda n: body("float a[4]; a[int(s.uv.x * 1e9) - 7] = 1.0; return vec3(a[int(s.uv.y * -1e9)]);"), 1),
    "a place outside that is constant": (lambda n: body("float a[4]; vec3 v; v[7] = 1.0; a[-1] = 1.0; return vec3(a[99], v[3], 0.0);"), 1),
    "lookups of no number": (lambda n: body("return textureLod(t, vec2(0.0/0.0, 1e38), 1e30).rgb + texelFetch(t, ivec2(2147483647), 99).rgb + textureGrad(t, s.uv, vec2(1e38), vec2(0.0/0.0)).rgb;", "uniform sampler2D t;\n"), 1),
    "uninitialised": (lambda n: body("vec3 a; float b[9]; mat4 m; return a + vec3(b[int(s.uv.x * 9.0)]) + m[1].xyz;"), 1),
    "no return": (lambda n: body("if (s.uv.x > 5.0) return vec3(1.0);"), 1),
    "discard": (lambda n: body("discard; return vec3(1.0);", "out vec4 heat;\n"), 1),
    "a condition of constants": (lambda n: "#if 1/0\n#endif\n#if (1 << 200) % 0\n#endif\n" + body("return vec3(1.0);"), 1),
    "a macro of itself": (lambda n: "#define a a\n#define b(x) b(b(x))\n" + body("float a = 1.0; return vec3(a);"), 1),
    "a macro that pastes": (lambda n: "#define p(x, y) x##y\n" + body("return vec3(p(1., 0) p(+, +) p(s., uv) . x);"), 1),
    "many arguments": (lambda n: "#define f(" + ",".join(f"a{i}" for i in range(n)) + ") 1.0\n" + body("return vec3(f(" + ",".join(["1"] * n) + "));"), 20_000),
    "a long name": (lambda n: body(f"float {'a' * n} = 1.0; return vec3({'a' * n});"), 300_000),
    "a long line": (lambda n: body("return vec3(1.0);") + "//" + "x" * n, 3_000_000),
    "a long number": (lambda n: body(f"return vec3({'1' * n}.0e{'9' * n});"), 50_000),
    "a whole number that is too large": (lambda n: body("return vec3(float(99999999999999999999) + float(0xFFFFFFFFFFFFu));"), 1),
    "an open comment": (lambda n: body("return vec3(1.0);") + "/* ", 1),
    "an open condition": (lambda n: "#if 1\n" + body("return vec3(1.0);"), 1),
    "deep directives": (lambda n: "#if 1\n" * n + body("return vec3(1.0);") + "\n#endif" * n, 50_000),
    "lines": (lambda n: "#line 2147483647\n" + body("return vec3(x);"), 1),
    "lines without end": (lambda n: "#line 99999999999999999999 7\n" + body("return vec3(1.0);"), 1),
    "another version": (lambda n: "#version 100\n" + body("return vec3(1.0);"), 1),
    "extensions": (lambda n: "#extension all : require\n#extension GL_none : enable\n" + body("return vec3(1.0);"), 1),
    "pragmas": (lambda n: "#pragma optimize(off)\n#pragma debug(on)\n#pragma STDGL invariant(all)\n" + body("return vec3(1.0);"), 1),
    "a main of its own": (lambda n: "void main() {}\n" + body("return vec3(1.0);"), 1),
    "a buffer": (lambda n: "layout(std430, binding = 0) buffer B { float b[]; };\n" + body("b[int(s.uv.x * 1e9)] = 1.0; return vec3(b[7], b.length(), 0.0);"), 1),
    "an image": (lambda n: "layout(rgba8, binding = 0) uniform image2D i;\n" + body("imageStore(i, ivec2(-9, 99999), vec4(1.0)); return imageLoad(i, ivec2(0)).rgb;"), 1),
    "an atomic counter": (lambda n: "layout(binding = 0) uniform atomic_uint c;\n" + body("return vec3(float(atomicCounterIncrement(c)));"), 1),
    "subroutines": (lambda n: "subroutine vec3 F(); subroutine uniform F f; subroutine(F) vec3 g() { return vec3(1.0); }\n" + body("return f();"), 1),
    "doubles": (lambda n: body("dvec3 a = dvec3(s.uv, 1.0) / dvec3(0.0LF); dmat4 m = inverse(dmat4(0.0LF)); return vec3(a) + vec3(m[0].xyz);"), 1),
    "an invariant": (lambda n: body("precise vec3 a = dFdx(fwidth(vec3(0.0/0.0))); return interpolateAtOffset(a, vec2(1e38));"), 1),
    "overloads": (lambda n: "".join(f"float f({'float a, ' * i}int b) {{ return {i}.0; }}\n".replace("float a, ", "", 0) for i in range(min(n, 2))) + body("return vec3(f(1));"), 2),
    "other letters": (lambda n: body("float \u00e4 = 1.0; return vec3(\u00e4);") + "// \U0001f600", 1),
    "nothing": (lambda n: "", 1),
    "built-in names": (lambda n: "float sin(float x) { return x; }\n#define texture 1.0\n#define vec3 float\n" + body("return vec3(1.0);"), 1),
}  # fmt: skip
