"""What a user's source leaves without a value is 0, whatever was in memory before.

Targets that are used again, and the memory of the threads that draw, are filled with a pattern first. Then each
picture is compared with numpy.
"""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical

UPRIGHT = cc.axis_angle((1, 0, 0), 90)
CAMERA = cc.OrthographicCamera(height=2, position=(0, 0, 1))
SIZE = 16
PATTERN = 777.25
CENTERS = (np.arange(SIZE, dtype=np.float32) + 0.5) / SIZE
U = np.broadcast_to(CENTERS, (SIZE, SIZE))  # of the wall, in the picture
RIGHT = U > 0.5

FILL = f"""
out vec4 heat;
float filled[300];
vec3 shade(Surface s) {{
    float a[300];
    for (int i = 0; i < 300; ++i) {{ a[i] = {PATTERN}; filled[i] = {PATTERN}; }}
    int i = int(s.uv.x * 299.0);
    heat = vec4({PATTERN});
    return vec3(a[i], filled[i], a[299 - i]);
}}"""


def wall(source, vertex=None, **more):
    scene = cc.Scene(background=(0.25, 0.5, 0.75, 1))
    material = cc.ShaderMaterial(source, vertex=vertex, **more)
    scene.add(cc.Mesh.plane(2, 2), material, rotation=UPRIGHT)
    return scene


def draw(renderer, scene, outputs=(), samples=1, effects=()):
    return renderer.render(
        scene,
        CAMERA,
        (SIZE, SIZE),
        format="rgba32f",
        outputs=outputs,
        samples=samples,
        effects=effects,
    )


def fill(renderer, outputs=("heat",), samples=1):
    """Write the pattern into the target, and into the memory that shaders use."""
    frame = draw(renderer, wall(FILL), outputs, samples)
    assert (frame.color[..., :3] == PATTERN).all()


def constant(*values):
    return np.broadcast_to(np.array(values, np.float32), (SIZE, SIZE, 4)).copy()


def where(mask, yes, no):
    return np.where(mask[..., None], constant(*yes), constant(*no))


BLACK = (0, 0, 0, 1)
LEFT_UNDONE = {
    "endless loop": ("while (true) x += s.uv.x; return vec3(x);", constant(*BLACK)),
    "endless for": ("for (;;) x += s.uv.x; return vec3(x);", constant(*BLACK)),
    "forgotten step": (
        "for (int i = 0; i < 10;) x += s.uv.x; return vec3(x);",
        constant(*BLACK),
    ),
    "endless do": ("do x += 1.0; while (1 < 2); return vec3(x);", constant(*BLACK)),
    "endless on one side": (
        "if (s.uv.x > 0.5) while (true) x += 1.0; return vec3(0.5);",
        None,
    ),
    "endless in a function": ("return vec3(endless(x));", constant(*BLACK)),
    "no value": ("vec3 c; return c;", constant(*BLACK)),
    "value on one side": (
        "vec3 c; if (s.uv.x > 0.5) c = vec3(0.5); return c;",
        where(RIGHT, (0.5, 0.5, 0.5, 1), BLACK),
    ),
    "no return": ("if (s.uv.x > 0.5) return vec3(0.5);", where(RIGHT, (0.5, 0.5, 0.5, 1), BLACK)),
    "no return of a function": (
        "return vec3(half_done(s.uv.x));",
        where(RIGHT, (2, 2, 2, 1), BLACK),
    ),
    "out argument": (
        "vec2 a; half_given(s.uv.x, a); return vec3(a, 0.0);",
        where(RIGHT, (3, 3, 0, 1), BLACK),
    ),
    "array": (
        "float a[300]; a[7] = 1.0; return vec3(a[int(s.uv.x * 299.0)], a[298], a[7]);",
        np.stack([(U * np.float32(299)).astype(int) == 7, 0 * U, 0 * U + 1, 0 * U + 1], -1).astype(
            np.float32
        ),
    ),
    "array partly": (
        (
            "float a[8]; for (int i = 0; i < int(s.uv.x * 8.0); ++i) a[i] = 1.0;"
            " return vec3(a[0] + a[1] + a[2] + a[3] + a[4] + a[5] + a[6] + a[7]);"
        ),
        np.stack([np.floor(U * 8)] * 3 + [0 * U + 1], -1).astype(np.float32),
    ),
    "array of arrays": (
        "float[40] a[9]; a[2][3] = 1.0; return vec3(a[int(s.uv.x * 9.0)][int(s.uv.y * 39.0)] * 0.0, a[2][3], a[3][2]);",
        constant(0, 1, 0, 1),
    ),
    "global": ("return g;", constant(*BLACK)),
    "global array": (
        "ga[7] = 1.0; return vec3(ga[int(s.uv.x * 6.9)], ga[8], ga[7]);",
        constant(0, 0, 1, 1),
    ),
    "structure": (
        "Pair p; p.a = 1.0; return vec3(p.a, p.b.y, p.many[int(s.uv.x * 99.0)].z);",
        constant(1, 0, 0, 1),
    ),
    "global structure": (
        "return vec3(gp.a, gp.b.y, gp.many[int(s.uv.x * 99.0)].z);",
        constant(*BLACK),
    ),
    "local structure": (
        "struct Own { float f[300]; } own; return vec3(own.f[int(s.uv.x * 299.0)]);",
        constant(*BLACK),
    ),
    "own surface": (
        "Surface t; return t.position + t.tangent.xyz + t.color.rgb;",
        constant(*BLACK),
    ),
    "matrix": (
        "mat4 m; int i = int(s.uv.x * 4.0); m[i] = vec4(1.0); return m[3 - i].xyz;",
        constant(*BLACK),
    ),
    "types of a macro": (
        "real x2, y2[300]; highp real z2; return vec3(x2, y2[int(s.uv.x * 299.0)], z2);",
        constant(*BLACK),
    ),
    "array of a function": (
        "float[9] a = half_array(s.uv.x); return vec3(a[int(s.uv.x * 8.9)], a[0], a[8]);",
        where(RIGHT, (1, 1, 1, 1), BLACK),
    ),
    "past a declaration": (
        "switch (int(s.uv.x * 2.0)) { case 0: float y = 5.0; break; case 1: return vec3(y); } return vec3(0.0);",
        constant(*BLACK),
    ),
    "past no declaration": (
        (
            "switch (int(s.uv.x * 2.0)) { case 0: float y = 5.0; vec2 z; case 1: z.y += 1.0; return vec3(y, z); }"
            " return vec3(0.0);"
        ),
        where(RIGHT, (0, 0, 1, 1), (5, 0, 1, 1)),
    ),
    "past an array": (
        (
            "float t = 0.0; for (int i = 0; i < 3; ++i) switch (int(s.uv.x * 2.0) + i) {"
            " case 0: float y[9]; y[3] = 5.0; case 1: t += y[3]; y[3] = 7.0; break; case 2: t += y[3]; }"
            " return vec3(t, 0.0, 0.0);"
        ),
        where(RIGHT, (0, 0, 0, 1), (5, 0, 0, 1)),
    ),
    "past a declaration, with conditions": (
        (
            "switch (int(s.uv.x * 2.0)) { case 0: float y = 5.0;\n#ifdef real\n float z = y; break; case 1:\n#else\n"
            " case 3:\n#endif\n return vec3(y); } return vec3(0.0);"
        ),
        constant(*BLACK),
    ),
    "past a declaration that has conditions": (
        (
            "switch (int(s.uv.x * 2.0)) { case 0: float y =\n#ifndef real\n 1.0;\n#else\n 5.0;\n#endif\n"
            " case 1: return s.uv.x < 0.5 ? vec3(y) : vec3(0.0); } return vec3(0.0);"
        ),
        where(RIGHT, BLACK, (5, 5, 5, 1)),
    ),
    "a switch that begins in two ways": (
        (
            "\n#ifdef real\n switch (int(s.uv.x * 2.0)) {\n#else\n switch (0) {\n#endif\n case 0: ;\n#ifdef nothing\n"
            " float y = 5.0;\n#endif\n case 1: ;\n#ifdef nothing\n return vec3(y);\n#endif\n return vec3(1.0); }"
            " return vec3(0.5);"
        ),
        constant(1, 1, 1, 1),
    ),
    "hidden by macros": (
        "FLOAT(a1), b1; HIGH float c1; TABLE d1; return vec3(a1 + b1, c1, d1[int(s.uv.x * 299.0)]);",
        constant(*BLACK),
    ),
    "return of a macro": (
        "return vec3(half_macro(s.uv.x));",
        where(RIGHT, (2, 2, 2, 1), BLACK),
    ),
    "structure of macros": (
        "Made m; Held h; return vec3(m.a, h.a, h.many[int(s.uv.x * 99.0)]);",
        constant(*BLACK),
    ),
    "global of a macro": ("return vec3(gm, gn[int(s.uv.x * 8.9)], gn[0]);", constant(*BLACK)),
    "declared by a macro": ("DECLARE return vec3(d1, d2.x, 0.0);", constant(*BLACK)),
    "integers": (
        "int i; uint j; bool b; return vec3(float(i), float(j), b ? 1.0 : 0.0);",
        constant(*BLACK),
    ),
    "depth on one side": (
        "if (s.uv.x > 0.5) gl_FragDepth = 0.5; return vec3(1.0);",
        constant(1, 1, 1, 1),
    ),
    "discard": (
        "if (s.uv.x > 0.5) discard; return vec3(1.0);",
        where(RIGHT, (0.25, 0.5, 0.75, 1), (1, 1, 1, 1)),
    ),
    "discard and loop": (
        "if (s.uv.x > 0.5) discard; while (true) x += 1.0; return vec3(x);",
        None,
    ),
}
AHEAD = """
#define real float
#define DECLARE float d1; vec3 d2;
#define FLOAT(name) float name
#define HIGH highp
#define TABLE float[300]
#define GIVE(x) return x
#define MAKE struct Made { float a; };
MAKE
FLOAT(gm);
HIGH float gn[9];
struct Held { HIGH float a, many[100]; };
float[9] half_array(float x) { if (x > 0.5) return float[9](1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0); }
float half_macro(float x) { if (x > 0.5) GIVE(2.0); }
struct Pair { float a; vec2 b; vec3 many[100]; };
Pair gp;
vec3 g;
float ga[9];
float endless(float x) { while (true) x += 1.0; return x; }
float half_done(float x) { if (x > 0.5) return 2.0; }
void half_given(float x, out vec2 a) { if (x > 0.5) a = vec2(3.0); }
vec3 shade(Surface s) {
    float x = 0.0;
    """


@pytest.mark.parametrize(("body", "want"), LEFT_UNDONE.values(), ids=LEFT_UNDONE)
@pytest.mark.parametrize("samples", [1, 4])
def test_colors(renderer, body, want, samples):
    fill(renderer, samples=samples)
    color = draw(renderer, wall(AHEAD + body + "\n}"), samples=samples).color
    assert PATTERN not in color
    if want is not None:
        assert_identical(color, want)
    else:
        # llvmpipe ends a loop after 65,536 steps, and can show that number.
        assert set(np.unique(color).tolist()) <= {0, 0.25, 0.5, 0.75, 1, 65536}
    fill(renderer, samples=samples)
    again = draw(renderer, wall(AHEAD + body + "\n}"), samples=samples).color
    assert_identical(again, color)


OUTPUTS = {
    "never": ("return vec3(1.0);", np.zeros((SIZE, SIZE, 4), np.float32)),
    "on one side": (
        "if (s.uv.x > 0.5) heat = vec4(1.0); return vec3(1.0);",
        where(RIGHT, (1, 1, 1, 1), (0, 0, 0, 0)),
    ),
    "one channel": ("heat.y = 1.0; return vec3(1.0);", constant(0, 1, 0, 0)),
    "before a loop": ("heat = vec4(2.0); while (true) heat.x += 1.0; return vec3(1.0);", None),
    "after a loop": (
        "while (true) heat.x += 1.0; heat = vec4(2.0); return vec3(1.0);",
        None,
    ),
    "read first": ("heat += vec4(1.0); return vec3(1.0);", constant(1, 1, 1, 1)),
    "before discard": (
        "heat = vec4(1.0); if (s.uv.x > 0.5) discard; return vec3(1.0);",
        where(RIGHT, (0, 0, 0, 0), (1, 1, 1, 1)),
    ),
}


@pytest.mark.parametrize(("body", "want"), OUTPUTS.values(), ids=OUTPUTS)
def test_outputs(any_path, body, want):
    names = ("heat", "normal", "id", "z")
    fill(any_path, names)
    source = "out vec4 heat;\nvec3 shade(Surface s) { " + body + " }"
    frame = draw(any_path, wall(source), names)
    hit = frame.id == 1
    assert hit[:, :8].all()
    normal = np.where(hit[..., None], np.array([0, 0, 1]), 0)
    assert_close(frame.normal, normal, "normal")
    assert_identical(frame.z, np.where(hit, np.float32(1), np.float32(np.inf)))
    heat = frame.outputs["heat"]
    assert PATTERN not in heat
    if want is not None:
        assert_identical(heat, want)
    else:
        assert np.isfinite(heat).all()
        assert set(np.unique(heat).tolist()) <= {0, 2}
    fill(any_path, names)
    assert_identical(draw(any_path, wall(source), names).outputs["heat"], heat)


VERTICES = {
    "never": "",
    "on one side": "if (v.uv.x > 2.0) { way = vec3(1.0); ways[1] = 1.0; pair.b = 2.0; }",
    "after a loop": "while (true) v.uv.x += 1.0; way = vec3(1.0);",
}


@pytest.mark.parametrize("body", VERTICES.values(), ids=VERTICES)
def test_what_vertices_hand_on(any_path, body):
    """An endless loop leaves the vertices where they are."""
    fill(any_path)
    shared = "struct Pair { float a, b; };\n{0} vec3 way;\n{0} float ways[3];\n{0} Pair pair;\n"
    vertex = shared.replace("{0}", "out") + "float g;\nvoid vertex(inout Vertex v) { " + body + " }"
    fragment = (
        shared.replace("{0}", "in")
        + "vec3 shade(Surface s) { return way + vec3(ways[0], ways[1], pair.b); }"
    )
    frame = draw(any_path, wall(fragment, vertex), ("id",))
    assert (frame.id == 1).all()
    assert_identical(frame.color, constant(*BLACK))


EFFECTS = {
    "endless loop": (
        "float x = 0.0; while (true) x += uv.x; return vec4(x);",
        constant(0, 0, 0, 0),
    ),
    "no value": ("vec4 c; return c;", constant(0, 0, 0, 0)),
    "no return": ("if (uv.x > 0.5) return vec4(1.0);", where(RIGHT, (1, 1, 1, 1), (0, 0, 0, 0))),
    "array": (
        "float a[300]; a[0] = 1.0; return vec4(a[int(uv.x * 299.0)] * 0.0);",
        constant(0, 0, 0, 0),
    ),
    "global": ("return vec4(g[int(uv.x * 299.0)]);", constant(0, 0, 0, 0)),
}


@pytest.mark.parametrize(("body", "want"), EFFECTS.values(), ids=EFFECTS)
def test_effects(renderer, body, want):
    fill(renderer)
    effect = cc.ImageEffect("float g[300];\nvec4 effect(vec2 uv) { " + body + " }")
    scene = wall(FILL)
    assert_identical(draw(renderer, scene, effects=[effect]).color, want)


def test_a_shadow_of_what_endless_vertices_move(renderer):
    """The vertices stay where they are, also in the shadow map."""
    scene = cc.Scene()
    scene.add(cc.DirectionalLight((0, 0, -1), shadow=True))
    material = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return vec3(1.0); }",
        vertex="void vertex(inout Vertex v) { while (true) v.position.x += 1.0; v.position.x = 9.0; }",
    )
    scene.add(cc.Mesh.plane(0.5, 0.5), material, position=(0, 0, 0.5), rotation=UPRIGHT)
    scene.add(cc.Mesh.plane(2, 2), cc.PhongMaterial(ka=0), rotation=UPRIGHT)
    got = draw(renderer, scene).color
    scene.nodes[0].material = cc.BasicMaterial()
    assert_identical(got, draw(renderer, scene).color)
