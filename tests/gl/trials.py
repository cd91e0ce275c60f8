"""What tests of the trial of users' GLSL share: hostile sources, and the helper processes of a program."""

import os
import time
from pathlib import Path

RECORD = 32  # bytes of a verdict in the file


def shade(body, before=""):
    """A source that this machine has never seen: verdicts are kept for each text."""
    return f"{before}\nvec3 shade(Surface s) {{ {body} }}\n// {time.time_ns()}\n"


def _chain(count, call):
    """Functions that call each other: `call` is an expression of the function before, {0}."""
    lines = ["float f0(float x) { return sin(x); }"]
    for i in range(1, count):
        lines.append(f"float f{i}(float x) {{ return {call.format(f'f{i - 1}')}; }}")
    return "\n".join(lines)


def _repeated(name, text, between, count):
    """Macros whose last, `name`, is a text 1,000 times `count`: no line of them is long."""
    macros = [f"#define {name}0 {text}"]
    macros += [f"#define {name}{i} {between.join([f'{name}{i - 1}'] * 10)}" for i in (1, 2, 3)]
    return "\n".join([*macros, f"#define {name} {between.join([f'{name}3'] * count)}"])


#: Sources that end the driver at once: what the message says about it. Macros and products hide the amounts of the
#: last ones from cubecam's own limits, which read the text.
DEADLY = {
    "division": (shade("return vec3(float((-2147483647 - 1) / -1));"), "SIGFPE.* compiled"),
    "remainder": (shade("return vec3(float((-2147483647 - 1) % -1));"), "SIGFPE.* compiled"),
    "sum": (shade("return vec3(SUM);", _repeated("SUM", "s.uv.x", "+", 20)), "SIGSEGV.* compiled"),
    "array": (
        shade("float a[1000 * 1000000]; a[int(s.uv.x)] = 1.0; return vec3(a[int(s.uv.y)]);"),
        "1024 MiB of memory",
    ),
}

_MACROS = "\n".join(
    ["#define A0 s.uv.x + s.uv.y", *(f"#define A{i} A{i - 1} + A{i - 1}" for i in range(1, 26))]
)
_CASE = "#define CASE(i) case i: x += sin(x * float(i)); break;"
_FUNCTION = "#define NEXT(f, g) float f(float x) { return g(x) * 1.01 + 1.0; }"

#: Sources that take the driver minutes, or more memory than there is.
ENDLESS = {
    "array": shade(
        "float a[1000 * 1000]; for (int i = 0; i < 1000000; ++i) a[i] = float(i);"
        "return vec3(a[int(s.uv.x * 1e5)]);"
    ),
    "macros": shade("return vec3(A25);", _MACROS),
    "cases": shade(
        "float x = 0.0; switch (int(s.uv.x * 2e4)) {"
        + "\n".join(f"CASE({i})" for i in range(20_000))
        + "} return vec3(x);",
        _CASE,
    ),
    "chain": shade(
        "return vec3(f4999(s.uv.x));",
        "\n".join([_FUNCTION, _chain(1, ""), *(f"NEXT(f{i}, f{i - 1})" for i in range(1, 5000))]),
    ),
    "tree": shade("return vec3(f29(s.uv.x));", _chain(30, "{0}(x) + {0}(x + 1.0)")),
}

#: The same amounts in plain sight: cubecam's own limits refuse them, and no driver sees them.
OBVIOUS = {
    "sum": (shade(f"return vec3({'+'.join(['s.uv.x'] * 2_500)});"), "2000 operators"),
    "array": (shade("float a[1000000]; return vec3(a[int(s.uv.y)]);"), "65536 elements"),
    "chain": (shade("return vec3(1);", _chain(5000, "{0}(x) * 1.01 + 1.0")), "1000 functions"),
    "brackets": (shade(f"return vec3({'(' * 5000}1.0{')' * 5000});"), "200 brackets"),
    "words": (shade(f"float x = 0.0; {'x += 1.0; ' * 30_000} return vec3(x);"), "100000 words"),
}

#: Loops that never end: llvmpipe cuts them.
LOOPS = {
    "while": shade("float x = 0.0; while (true) x += s.uv.x; return vec3(1);"),
    "nested": shade("float x = 0.0; while (true) while (true) x += s.uv.x; return vec3(1);"),
    "counted": shade(
        "float x = 0.0; for (int i = 0; i < 100000; ++i) for (int j = 0; j < 100000; ++j) x += s.uv.x;"
        "return vec3(1);"
    ),
}

#: A source that a stack of some 100 KB is too small for, and one of 1 MB is not.
LONG_SUM = shade("return vec3(SUM);", _repeated("SUM", "s.uv.x", "+", 2))

#: A source that keeps the helper busy for the whole limit.
SLOW = shade(
    "return vec3(IF 1.0 ELSE);",
    _repeated("IF", "s.uv.x > 0.5 ?", " ", 3) + "\n" + _repeated("ELSE", ": s.uv.y", " ", 3),
)


def helpers(owner=None):
    """The ids of the helper processes of a process."""
    owner = str(owner or os.getpid()).encode()
    found = []
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue  # it has ended
        if len(words) > 4 and words[0].endswith(b"/_shader_trial") and words[4] == owner:
            found.append(int(folder.name))
    return found


def wait_until(condition, seconds=10):
    """Whether a condition becomes true in that time."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def is_running(process):
    """Whether a process runs. One that has ended stays in the table of processes until its parent reads its status."""
    try:
        text = Path(f"/proc/{process}/stat").read_text()
    except OSError:
        return False
    return text.rpartition(")")[2].split()[0] not in "ZX"


def draw(renderer, source, material=None, **options):
    """Draw a plane with a source, which fills the picture."""
    import cubecam as cc

    scene = cc.Scene()
    made = cc.ShaderMaterial(source, **(material or {}))
    scene.add(cc.Mesh.plane(4, 4), made, rotation=cc.axis_angle((1, 0, 0), 90))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 2))
    return renderer.render(scene, camera, size=(8, 8), **{"format": "rgba32f", **options})


def draw_plain(value):
    """The red that a new renderer draws for a value; processes of a pool call it."""
    import cubecam as cc

    with cc.Renderer(device="software") as renderer:
        return float(draw(renderer, shade(f"return vec3({value});")).color[0, 0, 0])
