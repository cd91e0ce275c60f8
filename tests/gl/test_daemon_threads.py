"""A daemon thread that is inside a call when the interpreter ends ends nothing else: exit status 0, not a word."""

import pytest

from tests.helpers import DEVICE, run_python

#: The loops of the threads of one process. Each loop counts its rounds, so that the process ends inside a call.
LOOPS = {
    "drawing": [
        "r.capture(s, size=64)",
        "r.render(s, cam, (128, 128)); cam.position = (0, 0, cam.position[2] + 1e-3)",
        "cc.Renderer(device=device).close()",
        "q.update_probes(s); q.read_probe(probe)",
        "q.shadow_map(s, sun)",
        "q.read_texture(screen)",
        "cc.devices(); q.stats; q.closed; repr(q)",
        "with cc.Renderer(device=device) as own: own.render(s, cam, (8, 8))",
    ],
    "conversions": [
        "cube.to_equirect()",
        "cube.resize(100)",
        "cc.CubeMap.from_equirect(pano)",
        "cube.sample(directions)",
        "cube.to_layout('cross', convention='three')",
        "cc.CubeMap.from_layout(cube.to_layout('column'), layout='column')",
        "cube.to_convention('inside')",
        "cube.set_face('+x', face, convention='inside')",
        "cube.copy() == cube",
        "cc.CubeMap(cube.faces, convention='three', mipmaps=True)",
        "cube.outputs; capture.to_equirect(output='distance'); capture.resize(9)",
    ],
    "light": [
        "small.prefilter()",
        "small.irradiance(16)",
        "small.sh(4)",
        "cc.CubeMap.from_sh(np.ones((9, 3)), size=64)",
        "cc.brdf(np.ones(9), np.ones(9))",
    ],
    "meshes and files": [
        "cc.Mesh(ball.positions, ball.indices)",
        "ball.update(positions=ball.positions, uvs=ball.uvs)",
        "cc.Mesh.icosphere(1, 4)",
        "cc.Mesh.torus(1, .3)",
        "cc.load_environment(cc.sample_data('studio.exr'), size=32)",
        "cc.load_image(hdr)",
        "pickle.loads(pickle.dumps(s))",
    ],
    "callbacks": [
        "small.prefilter(progress=lambda share: nap())",
        "small.irradiance(16, progress=lambda share: nap())",
        "r.render(s, cam, (4, 4), outputs=(nap() or 'id' for i in range(9)))",
        "r.capture(s, size=4, exclude=(nap() or ball_node for i in range(9)))",
        "r.update_probes(s, probes=(nap() or probe for i in range(9)))",
        "cc.Mesh(Array(), [[0, 1, 2]])",
        "r.capture(s, size=Index())",
        "cc.CubeMap.from_levels(Sequence())",
        "cc.Scene(background=Sequence())",
        "pickle.loads(pickle.dumps([s, State()]))",
    ],
}

SCRIPT = """
import pickle, threading, time, warnings, tempfile, os
import numpy as np
import cubecam as cc

device = {device!r}
cam = cc.PerspectiveCamera(position=(0, 0, 3))
s = cc.Scene()
ball = cc.Mesh.icosphere(1, 3)
ball_node = s.add(ball, cc.MirrorMaterial())
probe = ball_node.environment = cc.Probe(size=16)
sun = s.add(cc.DirectionalLight(shadow=cc.Shadow(size=64)))
screen = cc.RenderTexture(cc.Scene(background=(1, 0, 0)), cc.PerspectiveCamera(), size=(16, 16))
s.add(cc.Mesh.plane(), cc.BasicMaterial(map=screen), position=(0, -1, 0))
r, q = cc.Renderer(device=device), cc.Renderer(device=device)
q.render(s, cam, (8, 8))
capture = r.capture(s, size=16, outputs=("distance",))
cube = cc.CubeMap(np.zeros((6, 128, 128, 3), "f4"))
small = cc.CubeMap(np.ones((6, 32, 32, 3), "f4"))
face = np.zeros((128, 128, 3), "f4")
pano = np.zeros((128, 256, 3), "f4")
directions = np.ones((50_000, 3))
hdr = os.path.join(tempfile.mkdtemp(), "a.hdr")
cc.save_image(hdr, pano)

def nap():
    time.sleep(0.0005)  # gives Python's lock away

class Array:
    def __array__(self, *args, **kwargs):
        nap()
        return np.zeros((3, 3))

class Index:
    def __index__(self):
        nap()
        return 4

class Sequence:
    def __len__(self):
        nap()
        return 3
    def __getitem__(self, i):
        nap()
        return small if i < 3 else [][0]

class State:
    def __getstate__(self):
        nap()
        return {{}}
    def __setstate__(self, state):
        nap()

def loop(number, code):
    code = compile(code, "loop", "exec")
    try:
        while True:
            try:
                exec(code)
            except (ValueError, TypeError):
                pass
            rounds[number] += 1
    except BaseException as error:
        failed.append((number, error))

loops = {loops!r}
rounds, failed = [0] * len(loops), []
for each in enumerate(loops):
    threading.Thread(target=loop, args=each, daemon=True).start()
for _ in range(5000):
    if all(rounds) or failed: break
    time.sleep(0.01)
assert all(rounds) and not failed, (rounds, failed)
"""


@pytest.mark.parametrize("loops", LOOPS.values(), ids=LOOPS)
def test_the_interpreter_ends_while_threads_are_inside_calls(loops):
    done = run_python(SCRIPT.format(device=DEVICE, loops=loops), timeout=300)
    assert done.stderr == ""


def test_a_thread_that_is_drawing_delays_the_end_by_no_more_than_a_part_of_its_picture():
    """The process waits for the next poll and not for the picture: the driver is not inside a call at the end."""
    run_python(
        f"""
        import threading, time
        import cubecam as cc
        r = cc.Renderer(device={DEVICE!r})
        s = cc.Scene()
        s.add(cc.Mesh.box(10), cc.PhongMaterial(double_sided=True))
        r.capture(s, size=4)
        entered = threading.Event()
        def draw():
            while True:
                entered.set()
                r.capture(s, size=1500)
                s.background = (r.stats.milliseconds % 1, 0, 0)
        threading.Thread(target=draw, daemon=True).start()
        entered.wait()
        time.sleep(0.05)
        """,
        timeout=300,
    )
