"""Lifetime of renderers: closing, garbage collection, threads that end, two hundred contexts, memory."""

import gc
import pickle
import threading
from typing import Any

import numpy as np
import psutil
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import room
from tests.helpers import need_own_memory, run_python

CAMERA: dict[str, Any] = {"fov": 50, "position": (0, 0, 3), "target": (0, 0, 0)}
CALLS = {
    "capture": lambda r, s: r.capture(s, size=4),
    "render": lambda r, s: r.render(s, cc.PerspectiveCamera(**CAMERA), (4, 4)),
    "update": lambda r, s: r.update_probes(s),
    "cubemap": lambda r, s: r.read_probe(cc.Probe(position=(0, 0, 0))),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_use_after_close_is_refused(new_renderer, call):
    renderer = new_renderer()
    renderer.capture(cc.Scene(), size=4)
    assert renderer.closed is False
    renderer.close()
    assert renderer.closed is True
    with pytest.raises((cc.Error, ValueError), match="closed"):
        call(renderer, cc.Scene())


def test_closing_twice_is_nothing(new_renderer):
    renderer = new_renderer()
    renderer.close()
    renderer.close()


def test_with_closes_on_error_too():
    with pytest.raises(RuntimeError, match="mine"), cc.Renderer() as renderer:
        raise RuntimeError("mine")
    assert renderer.closed


def test_what_was_handed_out_outlives_the_renderer(new_renderer):
    renderer = new_renderer()
    cube = renderer.capture(room().scene, size=8, outputs=("distance",))
    frame = renderer.render(room().scene, cc.PerspectiveCamera(**CAMERA), (8, 8))
    kept = cube.faces.copy(), frame.color.copy()
    info = renderer.info
    renderer.close()
    del renderer
    gc.collect()
    assert_identical(cube.faces, kept[0])
    assert_identical(frame.color, kept[1])
    assert info.renderer


def test_a_refused_call_leaves_the_renderer_usable(fresh_renderer):
    scene = room().scene
    first = fresh_renderer.capture(scene, size=8).faces
    for bad in ({"size": 0}, {"near": -1}, {"format": "x"}, {"outputs": ("x",)}, {"samples": 1000}):
        with pytest.raises(ValueError, match=r"expected|got"):
            fresh_renderer.capture(scene, **{"size": 8, **bad})
    assert_identical(fresh_renderer.capture(scene, size=8).faces, first)
    scene.background = (1, 1, 1)
    assert (fresh_renderer.capture(scene, size=8).faces != first).any()


def test_garbage_on_another_thread():
    """The last reference is dropped on a thread that never drew; other renderers can still draw."""
    other = cc.Renderer()
    scene = room().scene
    want = other.capture(scene, size=8).faces
    for _ in range(5):
        box = [cc.Renderer()]
        box[0].capture(scene, size=8)
        thread = threading.Thread(target=lambda held: (held.clear(), gc.collect()), args=(box,))
        thread.start()
        thread.join()
    scene.background = (0, 0, 0, 0)
    assert_identical(other.capture(scene, size=8).faces, want)
    other.close()


def test_a_reference_cycle_is_collected():
    class Holder:
        def __init__(self):
            self.renderer, self.me = cc.Renderer(), self

    holder = Holder()
    holder.renderer.capture(cc.Scene(), size=4)
    before = psutil.Process().num_fds()
    del holder
    gc.collect()
    assert psutil.Process().num_fds() <= before


@pytest.mark.slow
def test_two_hundred_contexts_leave_nothing():
    """Contexts are closed or left to the garbage collector: they leave no file descriptor, thread or memory."""
    need_own_memory()
    done = run_python(
        """
        import gc, psutil, numpy as np, cubecam as cc
        scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 64, 64, 3), np.float32)))
        scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, 0, -3))
        me = psutil.Process()
        def once(close):
            renderer = cc.Renderer()
            renderer.capture(scene, size=32)
            if close:
                renderer.close()
        def state():
            gc.collect()
            return me.num_fds(), me.num_threads(), me.memory_info().rss / 2**20
        for index in range(40):
            once(index % 2)
        before = state()
        for index in range(200):
            once(index % 2)
        print(*before, *state())
        """,
        timeout=300,
    )
    fds, threads, rss, fds_after, threads_after, rss_after = map(float, done.stdout.split())
    assert fds_after <= fds
    assert threads_after <= threads
    # If each of 200 leaked one target (6 x 32 x 32 x 16 bytes and its depth), this would be 25 MB.
    assert rss_after - rss < 12, f"{rss:.0f} MB before, {rss_after:.0f} MB after"


def test_gpu_copies_go_with_their_objects(new_renderer):
    """Cache entries hold weak references and are swept at each call: many scenes in a row do not fill the memory."""
    need_own_memory()
    renderer = new_renderer()
    me = psutil.Process()

    def one(index):
        faces = np.full((6, 256, 256, 3), index, np.float32)
        scene = cc.Scene(environment=cc.CubeMap(faces))
        mesh = cc.Mesh.sphere(1, segments=100, rings=100)
        scene.add(mesh, cc.BasicMaterial(map=faces[0]), position=(0, 0, -3))
        renderer.capture(scene, size=8)

    for index in range(8):
        one(index)
    before = me.memory_info().rss / 2**20
    for index in range(50):
        one(index)
    grown = me.memory_info().rss / 2**20 - before
    # Each cube takes 4.7 MB on the CPU and on the GPU: if fifty were kept, that would be 470 MB.
    assert grown < 100, f"{grown:.0f} MB more after fifty scenes"


def test_the_end_of_the_process_is_quiet():
    """Renderers that are alive at exit, in globals and in cycles, cause no crash and print nothing to stderr."""
    done = run_python(
        """
        import cubecam as cc
        a = cc.Renderer(); a.capture(cc.Scene(), size=4)
        class Holder: pass
        b = Holder(); b.me = b; b.renderer = cc.Renderer(); b.renderer.capture(cc.Scene(), size=4)
        import threading
        threading.Thread(target=lambda: cc.Renderer().capture(cc.Scene(), size=4)).start()
        """
    )
    assert done.stderr == ""


def test_a_renderer_does_not_pickle_and_says_so(renderer):
    with pytest.raises(TypeError, match="Renderer"):
        pickle.dumps(renderer)


def test_scenes_know_no_renderer(new_renderer):
    """A scene that a closed renderer has drawn can be drawn by the next renderer."""
    scene = room().scene
    first = new_renderer()
    want = first.capture(scene, size=8).faces
    first.close()
    assert_identical(new_renderer().capture(scene, size=8).faces, want)
