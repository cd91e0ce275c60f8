"""CPU time of trying users' GLSL in a helper process, beyond compiling it (docs/adr/0023).

    python -m benchmarks.shader_trial [NUMBER]      NUMBER sources of each kind, 12 by default

Each source is new. It is drawn by a renderer that trusts shaders, and the same text with another number in it by
one that does not; the difference of the CPU times of both processes is what the trial costs. The caches of cubecam
and of Mesa are in an empty folder, as on a machine that has never seen the source.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

SMALL = "vec3 shade(Surface s) { return vec3(s.uv, %d.0 / 7.0); }"
LARGE = """
float noise(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233)) + %d.0) * 43758.5453); }
float smooth_noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(noise(i), noise(i + vec2(1, 0)), f.x), mix(noise(i + vec2(0, 1)), noise(i + vec2(1, 1)), f.x), f.y);
}
vec3 shade(Surface s) {
    float sum = 0.0;
    for (int i = 0; i < 6; ++i) sum += smooth_noise(s.uv * exp2(float(i))) / exp2(float(i));
    return phong(s, vec3(sum), 0.2, 0.7, 1.0, 10.0) + environment(s.normal);
}
"""


def helper_seconds() -> float:
    """The CPU time of this process's helpers so far."""
    total = 0.0
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if len(words) < 5 or not words[0].endswith(b"/_shader_trial"):
                continue
            if words[4] != str(os.getpid()).encode():
                continue
            total += int((folder / "schedstat").read_text().split()[0]) / 1e9
            for task in (folder / "task").iterdir():
                if task.name != folder.name:
                    total += int((task / "schedstat").read_text().split()[0]) / 1e9
        except OSError:
            continue  # the process has ended
    return total


def measure(text: str, trust: bool, count: int) -> tuple[float, float, float]:
    """Milliseconds of CPU of the first source, of a later one, and of one whose verdict is known."""
    import cubecam as cc

    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 2))
    mesh = cc.Mesh.plane(2, 2)

    def draw(renderer: cc.Renderer, number: int) -> float:
        scene = cc.Scene()
        scene.add(cc.PointLight(position=(1, 1, 1)))
        material = cc.ShaderMaterial(text % number)
        scene.add(mesh, material, rotation=cc.axis_angle((1, 0, 0), 90))
        before = helper_seconds()
        own = time.process_time()
        renderer.render(scene, camera, size=(16, 16))
        time.sleep(0.05)  # Mesa's thread for its disk cache belongs to the cost
        own = time.process_time() - own  # without what helper_seconds() takes itself
        return 1000 * (own + helper_seconds() - before)

    offset = 1000 * trust
    with cc.Renderer(device="software", trust_shaders=trust) as renderer:
        first = draw(renderer, offset)
        later = median(draw(renderer, offset + i) for i in range(1, count))
    with cc.Renderer(device="software", trust_shaders=trust) as renderer:
        known = median(draw(renderer, offset + i) for i in range(count))
    return first, later, known


def main() -> None:
    if len(sys.argv) == 4 and sys.argv[1] == "--one":
        trusted, size = sys.argv[2].split(",")
        text = LARGE if size == "large" else SMALL
        print(*measure(text, trusted == "True", int(sys.argv[3])))
        return
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 12
    print("CPU ms of both processes    first   later   known")
    for name in ("small", "large"):
        rows = []
        for trust in (True, False):
            with tempfile.TemporaryDirectory() as folder:
                environment = {
                    **os.environ,
                    "XDG_CACHE_HOME": folder,
                    "MESA_SHADER_CACHE_DIR": folder,
                    "MESA_GLSL_CACHE_DIR": folder,
                }
                command = [sys.executable, "-m", "benchmarks.shader_trial", "--one"]
                done = subprocess.run(
                    [*command, f"{trust},{name}", str(count)],
                    env=environment,
                    check=True,
                    stdout=subprocess.PIPE,
                    text=True,
                )
            rows.append([float(word) for word in done.stdout.split()])
            label = f"{name} source, {'trusted' if trust else 'tried'}"
            print(f"{label:25}", *(f"{value:7.1f}" for value in rows[-1]))
        differences = [tried - trusted for trusted, tried in zip(*rows, strict=True)]
        print(f"{'  the trial':25}", *(f"{value:7.1f}" for value in differences))


if __name__ == "__main__":
    main()
