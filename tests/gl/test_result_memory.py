"""Memory of results is reused once the caller drops it, belongs to the caller until then, and is bounded."""

import gc
import os
import textwrap
import threading

import numpy as np
import psutil
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import need_own_memory, run_python

SIZE = 128  # 1.5 MiB of float32
CAMERA = cc.PerspectiveCamera()


def address(array):
    return array.__array_interface__["data"][0]


def test_memory_that_was_let_go_serves_the_next_result(new_renderer):
    renderer = new_renderer()
    scene = cc.Scene(background=(1, 0, 0))
    first = renderer.capture(scene, size=SIZE)
    place = address(first.faces)
    del first
    assert address(renderer.capture(scene, size=SIZE).faces) == place


def test_results_in_hand_are_never_written_again(new_renderer):
    renderer = new_renderer()
    scene = cc.Scene()
    kept = []
    for step in range(6):
        scene.background = (step, 0, 0)
        kept.append(renderer.render(scene, CAMERA, (SIZE, SIZE), format="rgba32f").color)
        renderer.render(scene, CAMERA, (SIZE, SIZE), format="rgba32f")
    part = kept[0][3:9, ::2, 0]  # a view keeps the whole alive
    places = {address(array) for array in kept}
    assert len(places) == len(kept)
    for step, array in enumerate(kept):
        assert (array[..., 0] == step).all()
    del kept[0], array
    scene.background = (9, 0, 0)
    renderer.render(scene, CAMERA, (SIZE, SIZE), format="rgba32f")
    assert (part == 0).all()


def test_a_reused_block_holds_nothing_of_the_result_before(new_renderer):
    renderer = new_renderer()
    scene = cc.Scene(background=(1, 1, 1))
    box = scene.add(cc.Mesh.box(1), position=(0, 0, -2))
    outputs = ("distance", "normal", "position", "id", "depth")
    for _ in range(3):
        renderer.capture(scene, size=SIZE, outputs=outputs).outputs["normal"].sum()
    scene.remove(box)
    got = renderer.capture(scene, size=SIZE, outputs=outputs)
    fresh = new_renderer(cache_bytes=0).capture(scene, size=SIZE, outputs=outputs)
    assert_identical(got.faces, fresh.faces)
    for name in outputs:
        assert_identical(getattr(got, name), getattr(fresh, name), name)


def test_the_callers_arrays_outlive_the_renderer(new_renderer):
    renderer = new_renderer()
    cube = renderer.capture(cc.Scene(background=(0.5, 0, 0)), size=SIZE)
    faces = cube.faces
    renderer.close()
    del renderer, cube
    gc.collect()
    assert (faces[..., 0] == 0.5).all()


def test_threads_may_let_results_go(new_renderer):
    renderer = new_renderer()
    scenes = [cc.Scene(background=(value, 0, 0)) for value in range(4)]
    wrong = []

    def draw(value):
        for _ in range(20):
            faces = renderer.capture(scenes[value], size=64).faces
            if not (faces[..., 0] == value).all():
                wrong.append(value)

    threads = [threading.Thread(target=draw, args=(value,)) for value in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


# In a process of its own, where no earlier test left free memory in the heap, the allocator maps blocks of more
# than 32 MiB one by one (mallopt(3), M_MMAP_THRESHOLD). Mapped memory counts whether or not it is resident.
MAPPED = """
    import psutil, cubecam as cc
    def mapped():
        return psutil.Process().memory_info().vms
    def expect(freed, expected):
        assert freed > expected - (8 << 20), (freed / 2**20, expected / 2**20)
"""


def test_what_calls_have_no_use_for_is_freed():
    need_own_memory()
    run_python(
        textwrap.dedent(MAPPED)
        + textwrap.dedent("""
            renderer = cc.Renderer(cache_bytes=1 << 30)
            scene = cc.Scene()
            camera = cc.PerspectiveCamera()
            renderer.render(scene, camera, (4, 4))
            for _ in range(2):
                renderer.capture(scene, size=1024, format="rgba8", outputs=("position",))
            held = mapped()
            for _ in range(10):
                renderer.render(scene, camera, (4, 4))
            expect(held - mapped(), 6 * 1024 * 1024 * 12)  # bytes of one output of positions
        """)
    )


@pytest.mark.parametrize(("mebibytes", "freed"), [(1, 3), (60, 2)])
def test_no_more_than_cache_bytes_is_kept(mebibytes, freed):
    need_own_memory()
    run_python(
        textwrap.dedent(MAPPED)
        + textwrap.dedent(f"""
            renderer = cc.Renderer(cache_bytes={mebibytes} << 20)
            scene = cc.Scene()
            cubes = [renderer.capture(scene, size=1024, format="rgba16f") for _ in range(3)]
            held = mapped()
            del cubes
            expect(held - mapped(), {freed} * 48 << 20)  # 3 results of 48 MiB each
        """)
    )


def test_a_forked_process_may_let_results_go():
    run_python(
        "import os, threading, warnings, cubecam as cc\n"
        "warnings.simplefilter('ignore')  # Python warns of forks beside threads\n"
        "renderer = cc.Renderer()\n"
        "scene = cc.Scene()\n"
        "kept = [renderer.capture(scene, size=128) for _ in range(3)]\n"
        "done = []\n"
        "def draw():\n"
        "    while not done:\n"
        "        renderer.capture(scene, size=64)\n"
        "thread = threading.Thread(target=draw)\n"
        "thread.start()\n"
        "for _ in range(5):\n"
        "    child = os.fork()\n"
        "    if child == 0:\n"
        "        kept.clear()\n"
        "        os._exit(0)\n"
        "    assert os.waitpid(child, 0)[1] == 0\n"
        "done.append(1)\n"
        "thread.join()\n"
    )


def test_many_renderers_leave_no_memory():
    need_own_memory()

    def round_trip():
        with cc.Renderer(device=os.environ.get("CUBECAM_TEST_DEVICE", "software")) as renderer:
            faces = renderer.capture(cc.Scene(), size=256).faces
            return np.count_nonzero(faces)

    for _ in range(5):
        round_trip()
    before = psutil.Process().memory_info().rss
    for _ in range(20):
        round_trip()
    assert psutil.Process().memory_info().rss - before < 20 << 20
