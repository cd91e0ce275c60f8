"""In a child forked after EGL was opened every call raises ContextError, naming spawn; nothing hangs."""

import pytest

from tests.helpers import run_python

FORK = """
import gc, os, signal, sys
import numpy as np
import cubecam as cc

scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 4, 4, 3), np.float32)))
probe = cc.Probe(position=(0, 0, 0))
scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, 0, -3)).environment = probe
camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 3), target=(0, 0, 0))
renderer = cc.Renderer()
want = renderer.capture(scene, size=4).faces
sys.stdout.flush()
child = os.fork()
if child == 0:
    signal.alarm(20)  # a hang ends by SIGALRM, status 14
    try:
        {child}
    except BaseException as error:
        print("child:", type(error).__name__, error, flush=True)
        os._exit(1)
    os._exit(0)
_, status = os.waitpid(child, 0)
assert status == 0, status
{parent}
assert (renderer.capture(scene, size=4).faces == want).all()
scene.background = (1, 1, 1)
renderer.capture(scene, size=4)
"""

REFUSED = """
        for call in ({calls}):
            try:
                call()
            except cc.ContextError as error:
                assert "spawn" in str(error), error
            else:
                raise AssertionError("expected a ContextError")
"""

CALLS = {
    "capture": "lambda: renderer.capture(scene, size=4)",
    "render": "lambda: renderer.render(scene, camera, (4, 4))",
    "update": "lambda: renderer.update_probes(scene)",
    "cubemap": "lambda: renderer.read_probe(probe)",
    "Renderer": "lambda: cc.Renderer()",
    "devices": "lambda: cc.devices()",
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_calls_in_the_child_are_refused(call):
    child = REFUSED.replace("{calls}", call + ",").strip()
    run_python(FORK.replace("{child}", child).replace("{parent}", ""), timeout=60)


def test_closing_and_collecting_in_the_child_touch_nothing():
    child = "renderer.close(); del renderer; gc.collect()"
    run_python(FORK.replace("{child}", child).replace("{parent}", ""), timeout=60)


def test_the_end_of_the_child_is_quiet():
    """sys.exit in the child runs all destructors: the child must end without an error."""
    script = FORK.replace("        {child}\n", "        sys.exit(0)\n").replace("{parent}", "")
    script = script.replace(
        "    except BaseException as error:", "    except ZeroDivisionError as error:"
    )
    run_python(script, timeout=60)


def test_exit_handlers_of_the_parent_do_not_run_in_the_child(tmp_path):
    """A driver's handler may wait for threads that a child does not have, as Mesa 26's do: here, one waits for ever."""
    run_python(
        f"""
        import atexit, ctypes, os, signal, sys
        import cubecam as cc
        renderer = cc.Renderer()
        renderer.capture(cc.Scene(), size=4)
        libc = ctypes.CDLL(None)
        hang = ctypes.cast(libc.pause, ctypes.c_void_p)
        assert libc.__cxa_atexit(hang, None, None) == 0
        libc.fopen.restype = ctypes.c_void_p
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # a hang ends by SIGALRM, status 14
            atexit.register(print, "python's handlers run", flush=True)
            file = ctypes.c_void_p(libc.fopen({str(tmp_path / "a").encode()!r}, b"w"))
            libc.fputs(b"written", file)  # into C's buffer
            sys.exit(3)
        status = os.waitpid(child, 0)[1]
        assert os.waitstatus_to_exitcode(status) == 3, status
        sys.stdout.flush()
        os._exit(0)  # the handler would hang here, too
        """,
        timeout=120,
    )
    assert (tmp_path / "a").read_text() == "written"


def test_cpu_work_goes_on_in_the_child():
    child = "cube = cc.CubeMap(np.ones((6, 8, 8, 3))); cube.to_equirect(); cube.resize(300); scene.add(cc.Mesh.box(1))"
    run_python(FORK.replace("{child}", child).replace("{parent}", ""), timeout=60)


def test_a_child_forked_before_egl_was_opened_may_draw():
    run_python(
        """
        import os, signal
        import cubecam as cc
        child = os.fork()
        if child == 0:
            signal.alarm(30)
            cc.Renderer().capture(cc.Scene(), size=4)
            os._exit(0)
        assert os.waitpid(child, 0)[1] == 0
        cc.Renderer().capture(cc.Scene(), size=4)
        """,
        timeout=60,
    )


def test_spawned_processes_may_draw(tmp_path):
    script = tmp_path / "main.py"
    script.write_text(
        "import multiprocessing, cubecam as cc\n"
        "def work(color):\n"
        "    with cc.Renderer() as renderer:\n"
        "        return renderer.capture(cc.Scene(background=color), size=2)\n"
        "if __name__ == '__main__':\n"
        "    cc.Renderer().capture(cc.Scene(), size=2)\n"
        "    with multiprocessing.get_context('spawn').Pool(1) as pool:\n"
        "        cube = pool.map(work, [(0.5, 0.25, 1)])[0]\n"
        "    assert cube.faces[0, 0, 0].tolist() == [0.5, 0.25, 1, 1], cube.faces\n"
    )
    run_python(f"import runpy; runpy.run_path({str(script)!r}, run_name='__main__')", timeout=90)
