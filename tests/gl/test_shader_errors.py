"""Sources that do not compile, or must not: each is refused, and the message names the user's own line."""

import pathlib

import pytest

import cubecam as cc

SHADE = "vec3 shade(Surface s) { return vec3(1.0); }\n"
EFFECT = "vec4 effect(vec2 uv) { return frame(uv); }\n"
MOVE = "void vertex(inout Vertex v) {}\n"
USED = "expected a name that cubecam's own shaders do not use, got "
FUNCTION = "expected a function vec3 shade(Surface surface), or vec4 with an alpha, got "

# The name, the source, the line that the message must name, words of the message.
FRAGMENTS = [
    # what is not closed
    ("comment", "\nfloat a;\n/* never\n" + SHADE, 3, "expected a comment that ends"),
    ("comment at the end", SHADE + "/*", 2, "expected a comment that ends"),
    ("brace", "float a() {\n return 1.0;\n\n" + SHADE, 1, "closes this {"),
    (
        "brace of if",
        "vec3 shade(Surface s) {\n if (true) {\n return vec3(1.0);\n}\n",
        1,
        "closes this {",
    ),
    ("bracket", SHADE + "\nfloat x = (1.0", 3, "closes this ("),
    ("square bracket", SHADE + "float x[\n3", 2, "closes this ["),
    ("one brace too many", SHADE + "}\n", 2, "syntax error"),
    ("wrong bracket", "vec3 shade(Surface s) {\n return vec3(1.0;\n}", 2, "syntax error"),
    ("semicolon", SHADE + "float x = 1.0\n", 2, "a semicolon missing?"),
    ("semicolon of a struct", SHADE + "\nstruct A { float x; }", 3, "a semicolon missing?"),
    ("half a declaration", SHADE + "\n\nfloat\n\n\n", 4, "behind the end of this source"),
    ("#if", "#ifdef X\n" + SHADE, 1, "expected an #endif for this #ifdef"),
    ("#else", SHADE + "\n#if 1\n#else\n", 3, "expected an #endif for this #if"),
    (
        "two #else",
        SHADE + "#if 1\n#else\n#else\n#endif\n",
        4,
        "expected #endif after #else, got #else",
    ),
    ("#elif after #else", SHADE + "#if 1\n#else\n#elif 1\n#endif", 4, "got #elif"),
    ("#endif", SHADE + "\n#endif\n", 3, "expected an #if before this #endif"),
    ("#elif", SHADE + "#elif 1\n", 2, "expected an #if before this #elif"),
    (
        "# within a line",
        "\nvec3 shade(Surface s) { return vec3(1.0); #else\n}",
        2,
        "expected # at the",
    ),
    ("# within a macro", "#define A 1 #endif\n" + SHADE, 1, "expected # at the beginning"),
    ("#if in a comment", "/* #if 1\n*/\n#endif\n" + SHADE, 3, "expected an #if before"),
    # lines and directives
    ("#line", "#line 500\n\nvec3 shade(Surface s) { return nope; }", 3, "nope"),
    (
        "#line again",
        "#line 7 3\n# line 9\\\n 8\nvec3 shade(Surface s) {\n return nope; }",
        5,
        "nope",
    ),
    ("#version", "\n#version 330\n" + SHADE, 2, "a #version line"),
    (
        "#version in a comment",
        "/*\n#version 330\n*/\nvec3 shade(Surface s) { return nope; }",
        4,
        "nope",
    ),
    ("#include", '\n#include "include/node.glsl"\n' + SHADE, 2, "got an #include"),
    (
        "#include in a comment",
        '/*\n#include "a.glsl"\n*/\nvec3 shade(Surface s) { return nope; }',
        4,
        "nope",
    ),
    (
        "#include // comment",
        '// #include "a"\n// \\\n#include "b"\nvec3 shade(Surface s) { return nope; }',
        4,
        "nope",
    ),
    ("#error", "\n\n#error oh no\n" + SHADE, 3, "oh no"),
    ("#extension", "\n#extension GL_NO_such : require\n" + SHADE, 2, "GL_NO_such"),
    (
        "#extension later",
        "float a;\n\n#extension GL_ARB_gpu_shader5 : require\n" + SHADE,
        3,
        "#extension",
    ),
    ("byte order mark", "\ufeffvec3 shade(Surface s) {\n return nope; }", 2, "nope"),
    ("CR", "\r\rvec3 shade(Surface s) {\r return nope; }\r", 4, "nope"),
    ("CR LF", "\r\n\r\nvec3 shade(Surface s) {\r\n return nope; }\r\n", 4, "nope"),
    ("all line ends", "\r\n\n\rvec3 shade(Surface s) {\r return nope; }\r", 5, "nope"),
    (
        "continued lines",
        "#define A \\\n 1.0 + \\\n 2.0\nvec3 shade(Surface s) { return vec3(A)\n + nope; }",
        5,
        "nope",
    ),
    (
        "branches",
        "#if 1\nvec3 shade(Surface s) {\n#else\nvec3 shade(Surface t) {\n#endif\nreturn nope;\n}\n",
        6,
        "nope",
    ),
    # functions
    ("main", SHADE + "\nvoid main() {}\n", 3, "expected no main()"),
    ("main declared", "void main(void);\n" + SHADE, 1, "expected no main()"),
    ("main as a macro", "\n#define main other\n" + SHADE, 2, "a macro with a name"),
    (
        "main in pieces",
        "#define J(a, b) a##b\nvoid J(ma, in)() {}\n" + SHADE,
        3,
        "`main' redefined",
    ),
    ("main over lines", SHADE + "void ma\\\nin() {}\n", 2, "expected no main()"),
    (
        "recursion",
        "\nvec3 f(float x);\nvec3 shade(Surface s) { return f(1.0); }\nvec3 f(float x) { return f(x); }\n",
        2,
        "recursion",
    ),
    ("recursion of shade", "\nvec3 shade(Surface s) { return shade(s); }", 2, "recursion"),
    (
        "mutual recursion",
        (
            "\nfloat b(float x);\nfloat a(float x) { return b(x); }\nfloat b(float x) { return a(x); }\n"
            "vec3 shade(Surface s) { return vec3(a(1.0)); }"
        ),
        3,
        "recursion",
    ),
    (
        "never defined",
        "\nfloat f(float x);\nvec3 shade(Surface s) { return vec3(f(1.0)); }",
        2,
        "unresolved reference",
    ),
    ("shade declared", "\nvec3 shade(Surface s);\n", 2, FUNCTION + "one without a body"),
    (
        "shade of float",
        "\n\nfloat shade(vec2 s) { return 1.0; }",
        3,
        FUNCTION + "float shade(vec2 s)",
    ),
    (
        "shade of two",
        "vec3 shade(Surface s, float x) { return vec3(x); }",
        1,
        FUNCTION + "vec3 shade(Surface s,float x)",
    ),
    (
        "shade in a comment",
        "\n// shade\nvec3 f(Surface s) { return vec3(1.0); }",
        2,
        FUNCTION + "it only in a comment",
    ),
    ("a variable shade", "\nfloat shade = 1.0;", 2, FUNCTION + "only the name"),
    ("two functions shade", SHADE + "\n" + SHADE, 3, "redefined"),
    ("wrong result", "\nvec3 shade(Surface s) { return vec2(1.0); }", 2, "return value"),
    # blocks, buffers, names
    (
        "block",
        "\nuniform Lamp { vec4 c; };\nvec3 shade(Surface s) { return c.rgb; }",
        2,
        "got the block Lamp",
    ),
    (
        "named block",
        "layout(std140, binding = 1) uniform Lamp {\n vec4 c; } lamp;\n" + SHADE,
        1,
        "got the block Lamp",
    ),
    (
        "block of a macro",
        "#define B uniform Lamp\n#define C {\nB C vec4 c; };\nvec3 shade(Surface s) { return c.rgb; }",
        1,
        "got the block Lamp",
    ),
    (
        "buffer",
        "\n\nlayout(std430) buffer Data { float d[]; };\nvec3 shade(Surface s) { return vec3(d[0]); }",
        3,
        "got the buffer Data",
    ),
    (
        "buffer of a macro",
        "#define B buffer\nB Data { float d[]; };\nvec3 shade(Surface s) { return vec3(d[0]); }",
        2,
        "got the buffer Data",
    ),
    ("block of inputs", "\nin Lamp { vec4 c; };\n" + SHADE, 2, "got the block Lamp"),
    ("image", "\nuniform image2D t;\n" + SHADE, 2, "got image2D"),
    ("counter", "\nlayout(binding = 0) uniform atomic_uint t;\n" + SHADE, 2, "got atomic_uint"),
    ("subroutine", "subroutine vec3 F();\n" + SHADE, 1, "got the subroutine F"),
    ("shared", "\nshared float x;\n" + SHADE, 2, "expected no shared variables, got x"),
    (
        "u_frame",
        "\nuniform vec4 u_frame;\nvec3 shade(Surface s) { return u_frame.rgb; }",
        2,
        USED + "u_frame",
    ),
    ("u_cube", "\n\nuniform samplerCube u_cube;\n" + SHADE, 3, USED + "u_cube"),
    ("u_gain", "uniform float u_gain;\n" + SHADE, 1, USED + "u_gain"),
    (
        "own names are not read",
        "\nvec3 shade(Surface s) { return u_origin.rgb; }",
        2,
        USED + "u_origin",
    ),
    ("v_alpha", "float v_alpha = 1.0;\n" + SHADE, 1, USED + "v_alpha"),
    ("o_z", "\nfloat o_z = 1.0;\n" + SHADE, 2, USED + "o_z"),
    ("with_alpha", "\nvec4 with_alpha(vec4 c) { return c; }\n" + SHADE, 2, USED + "with_alpha"),
    ("to_face", "\nfloat to_face(float c) { return c; }\n" + SHADE, 2, USED + "to_face"),
    ("Light", "struct Light { float x; };\n" + SHADE, 1, USED + "Light"),
    ("Surface", "struct Surface { float x; };\n" + SHADE, 1, USED + "Surface"),
    ("environment", "\nfloat environment = 1.0;\n" + SHADE, 2, USED + "environment"),
    ("cubecam_zeros", "\nvoid cubecam_zeros() {}\n" + SHADE, 2, USED + "cubecam_zeros"),
    ("LAYERED", "\n#define LAYERED 1\n" + SHADE, 2, "do not use, got LAYERED"),
    ("USER_SOURCE", "\n#undef USER_SOURCE\n" + SHADE, 2, "do not use, got USER_SOURCE"),
    (
        "LIGHT_COUNT",
        "\nvec3 shade(Surface s) { int LIGHT_COUNT = 3; return vec3(1.0); }",
        2,
        USED + "LIGHT_COUNT",
    ),
    (
        "gl_FragCoord",
        "layout(origin_upper_left) in vec4 gl_FragCoord;\n" + SHADE,
        1,
        "a declaration of gl_FragCoord",
    ),
    (
        "struct without a name",
        "struct { float x; } a;\n" + SHADE,
        1,
        "expected a struct with a name",
    ),
    (
        "output of a macro",
        "#define OUT out\nOUT vec4 heat;\nvec3 shade(Surface s) { heat = vec4(1.0); return vec3(1.0); }",
        2,
        "without a macro, got heat",
    ),
    # amounts
    (
        "array",
        "\nvec3 shade(Surface s) { float a[1000000000]; return vec3(a[3]); }",
        2,
        "at most 65536 elements, got 1000000000",
    ),
    ("array, hexadecimal", "\nfloat a[0x7fffffff];\n" + SHADE, 2, "got 0x7fffffff"),
    (
        "array of a macro",
        "\n#define DECLARE float a[5]\n" + SHADE,
        2,
        "a macro that declares no array, got DECLARE",
    ),
    (
        "sum",
        "vec3 shade(Surface s) {\n return vec3(" + "+".join(["s.uv.x"] * 5000) + "); }",
        2,
        "at most 2000 operators",
    ),
    (
        "brackets",
        "vec3 shade(Surface s) {\n return vec3(" + "(" * 3000 + "1.0" + ")" * 3000 + "); }",
        2,
        "at most 200 brackets",
    ),
    ("words", "float a;\n" * 40_000 + SHADE, 33_334, "at most 100000 words"),
    (
        "functions",
        "".join(f"float f{i}() {{ return 1.0; }}\n" for i in range(1500)) + SHADE,
        1001,
        "at most 1000 functions",
    ),
    (
        "uniforms",
        "\nuniform float x[60000];\nuniform int i; vec3 shade(Surface s) { return vec3(x[i]); }",
        2,
        "uniform",
    ),
    # characters
    ("no-break space", "\nvec3 shade(Surface s) {\u00a0return vec3(1.0); }", 2, 'got "\u00a0"'),
    ("quotes", "\nvec3 shade(Surface s) { return vec3(\u201ca\u201d); }", 2, 'got "\u201c"'),
    ("umlaut in a macro", "\n\n#define A \u00fc\n" + SHADE, 3, 'got "\u00fc"'),
    (
        "control character",
        "\nvec3 shade(Surface s) {\x07 return vec3(1.0); }",
        2,
        "got the control character 07",
    ),
    # what the driver finds
    (
        "unknown name",
        "uniform float a;\n\nvec3 shade(Surface s) {\n return vec3(a * nope);\n}",
        4,
        "nope",
    ),
    ("unknown type", "\nvec3 shade(Surface s) {\n Foo x; return vec3(1.0); }", 3, "syntax error"),
    (
        "const",
        "vec3 shade(Surface s) {\n const float x; return vec3(x); }",
        2,
        "must be initialized",
    ),
    ("index", "\nuniform vec3 c[3];\nvec3 shade(Surface s) { return c[7]; }", 3, "array index"),
    ("argument without a name", "\nvec4 shade(Surface) { return vec4(1.0); }", 2, "lacks a name"),
    ("own struct's member", "\nstruct A { float u_alpha; };\n" + SHADE, 2, USED + "u_alpha"),
    (
        "built-in as a macro",
        "\n#define gl_FragCoord 3\n" + SHADE,
        2,
        "do not use, got gl_FragCoord",
    ),
    ("varying", "\nin vec3 way;\nvec3 shade(Surface s) { return way; }", 2, "way"),
    ("invariant", "\ninvariant gl_Position;\n" + SHADE, 2, "gl_Position"),
]

EFFECTS = [
    ("comment", "\n/*\n" + EFFECT, 2, "expected a comment that ends"),
    ("semicolon", EFFECT + "\nfloat", 3, "behind the end of this source"),
    ("unknown", "\n\nvec4 effect(vec2 uv) { return nope; }", 3, "nope"),
    ("no argument", "\nvec4 effect() { return vec4(1.0); }", 2, "got vec4 effect()"),
    ("in a comment", "vec4 f(vec2 uv) { return vec4(1.0); } // effect", 1, "only in a comment"),
    ("main", EFFECT + "void main() {}", 2, "since cubecam's own calls effect()"),
    ("input", "\nin vec3 x;\n" + EFFECT, 2, "got the input x"),
    ("output", "\nout vec4 x;\n" + EFFECT, 2, "got the output x"),
    ("u_frame", "\nuniform vec4 u_frame;\n" + EFFECT, 2, USED + "u_frame"),
    ("u_layer", "\n\nuniform int u_layer;\n" + EFFECT, 3, USED + "u_layer"),
    ("frame", "float frame;\n" + EFFECT, 1, USED + "frame"),
    ("block", "\nuniform B { vec4 b; };\n" + EFFECT, 2, "got the block B"),
    ("buffer", "buffer B { vec4 b; };\n" + EFFECT, 1, "got the buffer B"),
    ("recursion", "\nvec4 effect(vec2 uv) { return effect(uv); }", 2, "recursion"),
    ("never defined", "vec4 f(vec2 uv);\nvec4 effect(vec2 uv) { return f(uv); }", 1, "unresolved"),
]

VERTICES = [
    ("comment", MOVE + "/*", SHADE, 2, "expected a comment that ends"),
    ("semicolon", MOVE + "\nfloat x", SHADE, 3, "behind the end of this source"),
    ("unknown", "\nvoid vertex(inout Vertex v) { v.positions = vec3(0); }", SHADE, 2, "positions"),
    ("attribute", "\nin vec4 tone;\n" + MOVE, SHADE, 2, "got the attribute tone"),
    (
        "attribute of a macro",
        "#define I in\nI vec4 tone;\nvoid vertex(inout Vertex v) { v.position += tone.xyz; }",
        SHADE,
        2,
        "got the attribute tone",
    ),
    (
        "gl_Position",
        "void vertex(inout Vertex v) {\n gl_Position = vec4(1.0); }",
        SHADE,
        2,
        "by vertex.position, got gl_Position",
    ),
    ("gl_Layer", "\nvoid vertex(inout Vertex v) { gl_Layer = 2; }", SHADE, 2, "got gl_Layer"),
    ("main", MOVE + "void main() {}", SHADE, 2, "since cubecam's own calls vertex()"),
    ("not inout", "\nvoid vertex(Vertex v) {}", SHADE, 2, "got void vertex(Vertex v)"),
    ("recursion", "\nvoid vertex(inout Vertex v) { vertex(v); }", SHADE, 2, "recursion"),
    (
        "u_model",
        "\n\nvoid vertex(inout Vertex v) { v.position *= u_model[0].x; }",
        SHADE,
        3,
        USED + "u_model",
    ),
    (
        "v_position",
        "out vec3 leak;\nvoid vertex(inout Vertex v) { leak = v_position; }",
        SHADE,
        2,
        USED + "v_position",
    ),
    ("block", "\nout Block { vec3 x; } block;\n" + MOVE, SHADE, 2, "got the block Block"),
    (
        "two types handed on",
        "\nout vec2 x;\nvoid vertex(inout Vertex v) { x = vec2(1.0); }",
        "in vec3 x;\nvec3 shade(Surface s) { return x; }",
        2,
        "declared as type",
    ),
    (
        "two types of a uniform",
        "\nuniform float k;\nout vec3 x;\nvoid vertex(inout Vertex v) { x = vec3(k); }",
        "in vec3 x;\nuniform vec2 k;\nvec3 shade(Surface s) { return x + vec3(k, 0.0); }",
        2,
        "declared as type",
    ),
    (
        "never handed on",
        MOVE,
        "in vec3 x;\nvec3 shade(Surface s) { return x; }",
        None,
        "fragment:1: x",
    ),
]


def ids(table):
    return [row[0] for row in table]


def shown_line(title, source, line):
    """The line of the excerpt that marks a line of the source."""
    text = source.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    written = text.split("\n")[line - 1]
    return f">{line:>5} | {written}"[:100]


def refused(draw, title, source, line, words):
    for _ in range(2):  # a refused source is not kept
        with pytest.raises(cc.ShaderError) as error:
            draw()
        text = str(error.value)
        assert words in text
        assert f"surface.{title}" not in text
        if line is not None:
            assert f"{title}:{line}" in text
            assert shown_line(title, source, line) in text
    return text


def draw_material(renderer, fragment, vertex=None, **more):
    scene = cc.Scene()
    material = cc.ShaderMaterial(fragment, vertex=vertex)
    scene.add(cc.Mesh.box(1), material, position=(0, 0, -3))
    return renderer.render(scene, cc.PerspectiveCamera(), (4, 4), **more)


@pytest.mark.parametrize(("name", "source", "line", "words"), FRAGMENTS, ids=ids(FRAGMENTS))
def test_fragments(renderer, name, source, line, words):
    text = refused(lambda: draw_material(renderer, source), "fragment", source, line, words)
    assert text.startswith("fragment does not ")


@pytest.mark.parametrize(("name", "source", "line", "words"), EFFECTS, ids=ids(EFFECTS))
def test_effects(renderer, name, source, line, words):
    def draw():
        renderer.render(
            cc.Scene(), cc.PerspectiveCamera(), (4, 4), effects=[cc.ImageEffect(source)]
        )

    refused(draw, "fragment", source, line, words)


@pytest.mark.parametrize(
    ("name", "vertex", "fragment", "line", "words"), VERTICES, ids=ids(VERTICES)
)
def test_vertices(renderer, name, vertex, fragment, line, words):
    refused(lambda: draw_material(renderer, fragment, vertex), "vertex", vertex, line, words)


@pytest.mark.parametrize(
    ("declaration", "line", "message"),
    [
        ("\nout int heat;", 2, "expected outputs declared as"),
        ("out vec4 a,\n distance;", 2, "expected an output of a name that is not one of"),
        ("// out\r\rout mat2 x;", 3, "expected outputs declared as"),
        ("l\u00e4yout(x) out vec4 x;", 1, "expected outputs declared as"),
    ],
)
def test_outputs_name_the_line(renderer, declaration, line, message):
    with pytest.raises(ValueError, match=f"^fragment:{line}: {message}"):
        draw_material(renderer, declaration + "\n" + SHADE)


def test_messages_show_the_declaration_as_it_was_written(renderer):
    source = "out vec4 heat; float a = nope;\nvec3 shade(Surface s) { float b; return vec3(b); }"
    with pytest.raises(cc.ShaderError) as error:
        draw_material(renderer, source, outputs=("heat",))
    assert ">    1 | out vec4 heat; float a = nope;\n" in str(error.value)
    assert "    2 | vec3 shade(Surface s) { float b; return vec3(b); }" in str(error.value)


@pytest.mark.parametrize("kind", ["dvec3 x", "sampler3D x", "sampler2DArray x", "sampler2D x[2]"])
def test_uniforms_of_other_types_name_the_line(renderer, kind):
    name = "x[1]" if "[" in kind else "x"
    call = {"d": f"vec3({name})", "sampler3D x": "texture(x, s.position).rgb"}.get(
        kind[0] if kind[0] == "d" else kind, f"texture({name}, s.position).rgb"
    )
    if kind == "sampler2D x[2]":
        call = "texture(x[1], s.uv).rgb"
    source = f"\n\nuniform {kind};\nvec3 shade(Surface s) {{ return {call}; }}"
    with pytest.raises(ValueError, match="fragment:3: uniform x: expected a float"):
        draw_material(renderer, source)


def test_a_file_is_named_by_its_path(renderer, tmp_path):
    path = tmp_path / "paint.frag"
    path.write_text("\nuniform Lamp { vec4 c; };\n" + SHADE)
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial(pathlib.Path(path)), position=(0, 0, -3))
    with pytest.raises(cc.ShaderError, match=r"paint\.frag:2: expected uniforms outside of blocks"):
        renderer.render(scene, cc.PerspectiveCamera(), (4, 4))


def test_long_lines_are_cut(renderer):
    source = "vec3 shade(Surface s) { return nope; } // " + "x" * 10_000
    with pytest.raises(cc.ShaderError) as error:
        draw_material(renderer, source)
    assert len(str(error.value)) < 1_000


# Sources that look wrong and are right.
RIGHT = [
    ("BOM and CR", "\ufeff// \u00fcber\rvec3 shade(Surface s) { return vec3(1.0); }"),
    ("backslash at the end", "vec3 shade(Surface s) { return vec3(1.0); } // \\"),
    ("backslash and line", "vec3 shade(Surface s) { return vec3(1.0); }\n#define A \\"),
    ("directives in comments", '/*\n#version 1\n#include "x"\n#if\n*/ // #endif\n' + SHADE),
    ("#line", "#line 3\n" + SHADE),
    ("macros for types", "#define vec3 vec4\nvec4 shade(Surface s) { return vec3(1.0); }"),
    (
        "macros of declarations",
        (
            "#define HALF(f, g) float f(float x) { return 0.5 * g(x); }\n#define K const float k = 4.0;\n"
            "HALF(a, float)\nHALF(b, a)\nK\nvec3 shade(Surface s) { return vec3(b(k)); }"
        ),
    ),
    ("macro for nothing", "#define void\n#define float int\n" + SHADE),
    (
        "macros of statements",
        "#define DO float x; x = 1.0;\nvec3 shade(Surface s) { DO return vec3(x); }",
    ),
    ("macro for the function", "#define F(a) vec3 shade(Surface a)\nF(s) { return vec3(1.0); }"),
    (
        "macros of braces",
        "#define BEGIN {\n#define END }\nvec3 shade(Surface s) BEGIN return vec3(1.0); END",
    ),
    ("own alias", "#define real float\nvec3 shade(Surface s) { real x; x = 1.0; return vec3(x); }"),
    (
        "overloads",
        (
            "float schlick(float a) { return a; }\nvec3 environment(float x) { return vec3(x); }\n"
            "vec3 shade(Surface s) { return schlick(1.0) * environment(1.0); }"
        ),
    ),
    (
        "overloaded shade",
        "float shade(float x) { return x; }\nvec3 shade(Surface s) { return vec3(shade(1.0)); }",
    ),
    ("const argument", "vec3 shade(const in Surface s) { return vec3(1.0); }"),
    (
        "members like own names",
        "struct A { float to_face, Light; };\nvec3 shade(Surface s) { A a; a.Light = 1.0; return vec3(a.Light); }",
    ),
    (
        "locals like own functions",
        "vec3 shade(Surface s) { float to_face = 1.0, material = 1.0; return vec3(to_face * material); }",
    ),
    (
        "two structures of one name",
        (
            "#ifdef NOT\nstruct P { vec3 a; };\n#else\nstruct P { vec2 b; };\n#endif\n"
            "vec3 shade(Surface s) { P p; return vec3(p.b + 1.0, 1.0); }"
        ),
    ),
    ("textures in a structure", "struct L { sampler2D t; vec3 c; };\nuniform L lamp;\n" + SHADE),
    (
        "arrays of arrays",
        "vec3 shade(Surface s) { float a[2][3]; vec2[2] b; return vec3(a[1][2] + 1.0 + b[1].x); }",
    ),
    (
        "a name on condition",
        "#ifdef NOT\nfloat g;\n#else\nvec3 g[4];\n#endif\nvec3 shade(Surface s) { return g[2] + 1.0; }",
    ),
    (
        "switch",
        "vec3 shade(Surface s) { switch (3) { case 1: float a; return vec3(a); default: return vec3(1.0); } }",
    ),
    (
        "for without a value",
        "vec3 shade(Surface s) { for (int i; i < 3; ++i) {} return vec3(1.0); }",
    ),
    (
        "lists",
        "const float a[2] = {1.0, 1.0};\nvec3 shade(Surface s) { float b[2] = {1.0, 1.0}; return vec3(a[1] * b[1]); }",
    ),
    (
        "precision",
        "precision highp float;\nvec3 shade(Surface s) { highp float x; return vec3(x + 1.0); }",
    ),
    (
        "location of a uniform",
        "layout(location = 0) uniform float k = 1.0;\nvec3 shade(Surface s) { return vec3(k); }",
    ),
    ("a discard for all", "vec3 shade(Surface s) { if (s.uv.x > 2.0) discard; return vec3(1.0); }"),
    (
        "return in branches",
        (
            "vec3 f(float x) { if (x > 0.0) return vec3(1.0); else return vec3(2.0); }\n"
            "vec3 shade(Surface s) { return f(1.0); }"
        ),
    ),
    (
        "u_ of one's own",
        "uniform float u_share = 1.0;\nvec3 shade(Surface s) { return vec3(u_share); }",
    ),
]


@pytest.mark.parametrize(("name", "source"), RIGHT, ids=ids(RIGHT))
@pytest.mark.parametrize("outputs", [(), ("z", "id")])
def test_sources_that_are_right(renderer, name, source, outputs):
    frame = draw_material(renderer, source, outputs=outputs, format="rgba32f")
    assert frame.color[1:3, 1:3].tolist() == [[[1] * 4] * 2] * 2


def test_macros_of_a_vertex_source_do_not_reach_the_own_code(renderer):
    plain = draw_material(renderer, SHADE, "#define position normal\n" + MOVE)
    assert (plain.color == draw_material(renderer, SHADE).color).all()
