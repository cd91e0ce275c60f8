"""capture_async and render_async: the bytes, order and scene of the call, whatever else happens meanwhile."""

import asyncio
import concurrent.futures
import contextlib
import gc
import threading
import weakref
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import DEVICE, run_python

EYES = cc.StereoCamera(cc.PerspectiveCamera(), cc.PerspectiveCamera(), layout="side_by_side")
OUTPUTS = ("distance", "z", "normal", "position", "id", "label", "depth")


@pytest.fixture(params=[False, True], ids=["in place", "through buffers"])
def buffers(request):
    """Read in place, as software drivers do, and through mapped buffers, as GPUs do."""
    before = cc._core._read_through_buffers(request.param)
    yield request.param
    cc._core._read_through_buffers(before)


@pytest.fixture
def renderer(new_renderer):
    return new_renderer()


def scene_of(*colors):
    """A scene with one small box for each colour, in different directions."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    for at, color in enumerate(colors):
        place = np.roll((2.0, 0.3 * at, 0.1), at)
        scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=color), position=place)
    return scene


def same_cube(got, want):
    assert_identical(got.faces, want.faces)
    assert list(got.outputs) == list(want.outputs)
    for name in want.outputs:
        assert_identical(got.outputs[name], want.outputs[name])


def while_drawing(renderer, work):
    """Call a function inside a call of the renderer: what it hands over cannot begin before that call ends."""
    done = []

    def look():
        cc._core._at_interrupt_check(None)
        done.append(work())

    before = cc._core._interrupt_pause(0)
    cc._core._at_interrupt_check(look)
    try:
        renderer.capture(cc.Scene(background=(1, 1, 1)), size=2)
    finally:
        cc._core._at_interrupt_check(None)
        cc._core._interrupt_pause(before)
    return done[0]


@contextlib.contextmanager
def occupied(renderer):
    """Keep the thread of a renderer busy in a callback: in this block no call begins."""
    entered, gate = threading.Event(), threading.Event()

    def wait(_):
        entered.set()
        gate.wait(60)

    # Inside a call of the renderer, so that the callback is there before the future is done.
    while_drawing(
        renderer, lambda: renderer.capture_async(cc.Scene(), size=1).add_done_callback(wait)
    )
    entered.wait()
    try:
        yield gate
    finally:
        gate.set()


def test_the_bytes_are_those_of_the_synchronous_calls(new_renderer, buffers):
    """Captures, frames and stereo frames with all outputs, formats, samples, effects and tone curves."""
    scene = scene_of((1, 0, 0), (0, 1, 0), (0, 0, 1))
    heat = "out vec4 heat; vec3 shade(Surface s) { heat = vec4(s.normal, 1.0); return s.normal; }"
    scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(heat), position=(0, 0, -2), label=-7)
    mirror = scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, -2, 0))
    mirror.environment = cc.Probe(size=8)
    effect = cc.ImageEffect("vec3 effect(vec2 uv) { return frame(uv).bgr; }")
    stereo = cc.StereoCamera.off_axis(
        cc.PerspectiveCamera(position=(2, 2, 2)), convergence=2.0, layout="side_by_side"
    )
    captures: list[dict[str, Any]] = [
        {"size": 24, "outputs": (*OUTPUTS, "heat"), "samples": 4},
        {"size": 16, "format": "rgb565", "depth_order": "farthest"},
        {
            "size": 16,
            "format": "rgba16f",
            "depth_format": "depth24_stencil8",
            "outputs": ["stencil"],
        },
    ]
    camera = cc.PerspectiveCamera(position=(2.5, 2, 2.2), target=(0, 0, 0))
    frames: list[tuple[Any, dict[str, Any]]] = [
        (camera, {"outputs": OUTPUTS, "tonemap": "aces", "effects": [effect], "samples": 4}),
        (camera, {"format": None, "outputs": ["id"]}),
        (stereo, {"format": "rgba32f", "outputs": ["distance"], "encode": "srgb"}),
        (stereo, {"format": "rgba8", "screen_reflections": True}),
    ]  # fmt: skip
    with cc.Renderer(device=DEVICE) as other:
        want_cubes = [other.capture(scene, **how) for how in captures]
        want_frames = [other.render(scene, seen, (24, 20), **how) for seen, how in frames]
    renderer = new_renderer()
    cubes = [renderer.capture_async(scene, **how) for how in captures]
    pictures = [renderer.render_async(scene, seen, (24, 20), **how) for seen, how in frames]
    for future, want in zip(cubes, want_cubes, strict=True):
        same_cube(future.result(), want)
    for picture, wanted in zip(pictures, want_frames, strict=True):
        got = picture.result()
        assert (got.encoding, got.format) == (wanted.encoding, wanted.format)
        assert list(got.outputs) == list(wanted.outputs)
        both: list[tuple[Any, Any]] = [(got.color, wanted.color)]
        both += zip(got.outputs.values(), wanted.outputs.values(), strict=True)
        for a, b in both:
            assert (a is None) == (b is None)
            if a is not None:
                assert_identical(a, b)


def test_each_call_shows_the_scene_of_its_moment(renderer, buffers):
    """Nodes, materials, meshes, cubemaps, cameras, scenes of render textures: all change before anything is drawn."""
    inner = cc.Scene(background=(1, 0, 0))
    screen = cc.RenderTexture(inner, cc.PerspectiveCamera(), size=(4, 4))
    sky = cc.CubeMap(np.full((6, 4, 4, 3), 0.25, np.float32))
    scene = cc.Scene(background=sky)
    mesh, material = cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0.5, 0))
    box = scene.add(mesh, material, position=(2, 0, 0))
    scene.add(cc.Mesh.plane(9, 9), cc.BasicMaterial(map=screen), position=(0, -2, 0))
    camera = cc.PerspectiveCamera(position=(0, 3, 6), target=(0, 0, 0))
    edits = [
        lambda: setattr(box, "position", (0, 0, 2)),
        lambda: setattr(material, "color", (0, 1, 1)),
        lambda: mesh.update(positions=mesh.positions * np.float32(1.5)),
        lambda: sky.set_face("-z", np.ones((4, 4, 3), np.float32)),
        lambda: setattr(inner, "background", (0, 1, 0)),
        lambda: setattr(camera, "position", (3, 3, 6)),
        lambda: setattr(box, "visible", False),
    ]

    def call():
        return renderer.capture_async(scene, size=16), renderer.render_async(
            scene, camera, (16, 12)
        )

    def edit_all():
        made = [call()]
        for edit in edits:
            edit()
            made.append(call())
        return made

    # The pictures of each moment are drawn by another renderer, in a second pass over the same edits.
    with cc.Renderer(device=DEVICE) as other:

        def want():
            return other.capture(scene, size=16), other.render(scene, camera, (16, 12))

        with occupied(renderer):
            futures = edit_all()
        got = [(cube.result(), frame.result()) for cube, frame in futures]
        same_cube(got[-1][0], want()[0])
        box.visible, box.position, material.color = True, (2, 0, 0), (1, 0.5, 0)
        mesh.update(positions=mesh.positions / np.float32(1.5))
        sky.set_face("-z", np.full((4, 4, 3), 0.25, np.float32))
        inner.background, camera.position = (1, 0, 0), (0, 3, 6)
        wanted = [want()]
        for edit in edits:
            edit()
            wanted.append(want())
    for (cube, frame), (want_cube, want_frame) in zip(got, wanted, strict=True):
        same_cube(cube, want_cube)
        assert_identical(frame.color, want_frame.color)
    frames = {frame.color.tobytes() for _, frame in got}
    assert len(frames) > 5  # the edits show


def test_results_come_in_the_order_of_the_calls(renderer, buffers):
    """Also where a later call is quicker, or draws nothing new."""
    scene = scene_of((1, 0, 0), (0, 1, 0))
    order = []
    sizes = [200, 2, 100, 2, 2, 64, 2]

    def submit():
        made = [renderer.capture_async(scene, size=size) for size in sizes]
        for number, future in enumerate(made):
            future.add_done_callback(lambda _, number=number: order.append(number))
        return made

    with occupied(renderer):
        futures = submit()
    concurrent.futures.wait(futures)
    assert [future.result().size for future in futures] == sizes
    with renderer:  # the last callback may still run when the last result is there
        pass
    assert order == list(range(len(sizes)))


def test_calls_of_both_kinds_are_drawn_in_the_order_of_the_program(renderer, buffers):
    """A probe that only update_probes draws: a call before it shows the old picture, a call after it the new one."""
    scene = cc.Scene(background=(1, 0, 0))
    probe = cc.Probe(size=4, update="manual", format="rgba32f")
    scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), environment=probe)
    camera = cc.PerspectiveCamera(position=(0, 0, 3), target=(0, 0, 0))
    renderer.update_probes(scene)

    def shown():
        return renderer.render_async(scene, camera, (8, 8), format="rgba32f")

    futures = []
    for step in range(6):
        futures.append(shown())
        scene.background = (0, step / 8, 1)
        renderer.update_probes(scene)
        futures.append(shown())
    middle = [future.result().color[4, 4, :3].tolist() for future in futures]
    held = [[1, 0, 0]] + [[0, step / 8, 1] for step in range(6)]
    assert middle == [held[0]] + [color for color in held[1:-1] for _ in range(2)] + [held[-1]]
    with occupied(renderer):
        before = shown()
        scene.background = (1, 1, 0)
        thread = threading.Thread(target=renderer.update_probes, args=(scene,))
        thread.start()
        thread.join(0.3)  # long enough to draw, if it did not wait for its turn
        assert thread.is_alive()
    thread.join()
    assert before.result().color[4, 4, :3].tolist() == held[-1]
    assert shown().result().color[4, 4, :3].tolist() == [1, 1, 0]


def test_asyncio_gathers_twenty(renderer, buffers):
    scene = scene_of((1, 0, 0), (0, 0, 1), (0, 1, 0))
    places = [(0.02 * step, 0, 0) for step in range(20)]
    want = [renderer.capture(scene, place, 12).faces for place in places]

    async def captures():
        first = await renderer.capture_async(scene, places[0], 12)
        return first, await asyncio.gather(
            *(renderer.capture_async(scene, place, 12) for place in places)
        )

    first, cubes = asyncio.run(captures())
    assert_identical(first.faces, want[0])
    for cube, faces in zip(cubes, want, strict=True):
        assert_identical(cube.faces, faces)


def test_asyncio_cancels_a_call_that_waits(renderer):
    """A task that is cancelled, and wait_for whose time is over; the calls after it are drawn."""

    async def wait_for(future):
        return await future

    async def work():
        with occupied(renderer):
            futures = [renderer.capture_async(cc.Scene(), size=2) for _ in range(4)]
            task = asyncio.ensure_future(wait_for(futures[1]))
            await asyncio.sleep(0)
            task.cancel()
            with pytest.raises(asyncio.CancelledError):
                await task
            with pytest.raises(asyncio.TimeoutError):
                await asyncio.wait_for(wait_for(futures[2]), 0.01)
        assert (await futures[0]).size == (await futures[3]).size == 2
        return futures

    cancelled = asyncio.run(work())
    assert [future.cancelled() for future in cancelled] == [False, True, True, False]


def test_a_call_can_be_cancelled_until_it_begins(renderer):
    with occupied(renderer):
        futures = [renderer.capture_async(cc.Scene(), size=2) for _ in range(3)]
        assert not any(future.done() or future.running() for future in futures)
        assert futures[1].cancel()
        with pytest.raises(concurrent.futures.CancelledError):
            futures[1].result()
        with pytest.raises(concurrent.futures.TimeoutError):
            futures[2].result(timeout=0.01)
    assert futures[0].result().size == futures[2].result().size == 2
    assert not futures[2].cancel()
    assert futures[2].exception() is None


@pytest.mark.parametrize(
    ("arguments", "error", "match"),
    [
        ({"size": 0}, ValueError, "size: expected 1 to"),
        ({"size": 10**6}, ValueError, "size: expected 1 to"),
        ({"size": "large"}, TypeError, "size: expected"),
        ({"samples": 1000}, ValueError, "samples: expected 1 to"),
        ({"near": 2, "far": 1}, ValueError, "near, far: expected"),
        ({"position": (0, np.nan, 0)}, ValueError, "position: expected"),
        ({"outputs": ["heat"]}, ValueError, 'outputs: expected .* got "heat"'),
        ({"outputs": ["stencil"]}, ValueError, "outputs: expected"),
        ({"exclude": [cc.Scene().add(cc.Mesh.box(1))]}, ValueError, "exclude: expected"),
        ({"colour": 1}, TypeError, "colour"),
    ],
)
def test_wrong_arguments_are_refused_by_the_call(renderer, arguments, error, match):
    """With the words of the synchronous call."""
    with pytest.raises(error, match=match) as later:
        renderer.capture_async(cc.Scene(), **arguments)
    with pytest.raises(error) as now:
        renderer.capture(cc.Scene(), **arguments)
    assert str(later.value).replace("_async", "") == str(now.value)


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        ({"size": (0, 4)}, "size: expected"),
        ({"format": None, "effects": [cc.ImageEffect("vec3 effect(vec2 uv) { return frame(uv).rgb; }")]}, "effects: "),
        ({"format": None, "tonemap": "aces"}, "tonemap"),
        ({"camera": EYES, "size": (3, 4)}, "even width"),
    ],
)  # fmt: skip
def test_wrong_frames_are_refused_by_the_call(renderer, arguments, match):
    how = {"camera": cc.PerspectiveCamera(), "size": (4, 4)} | arguments
    with pytest.raises(ValueError, match=match) as later:
        renderer.render_async(cc.Scene(), **how)
    with pytest.raises(ValueError) as now:  # noqa: PT011 - compared below
        renderer.render(cc.Scene(), **how)
    assert str(later.value) == str(now.value)


def test_what_drawing_finds_is_raised_by_the_future(renderer, buffers):
    """The error of the synchronous call; the calls before and after are drawn."""
    good, bad = cc.Scene(background=(0, 1, 0)), cc.Scene()
    bad.add(cc.Mesh.box(1), cc.ShaderMaterial("vec3 shade(Surface s) { return nothing; }"))
    with pytest.raises(cc.ShaderError) as now:
        renderer.capture(bad, size=2)
    order: list[cc.PictureFuture] = []
    with occupied(renderer):
        futures = [renderer.capture_async(scene, size=2) for scene in (good, bad, good, bad)]
        for future in futures:
            future.add_done_callback(order.append)
    concurrent.futures.wait(futures)
    assert futures[2].result().faces[0, 0, 0].tolist() == [0, 1, 0, 1]
    for future in futures[1::2]:
        with pytest.raises(cc.ShaderError) as later:
            future.result()
        assert str(later.value) == str(now.value)
        assert future.exception() is later.value
    with renderer:  # then the last callback has run
        assert isinstance(asyncio.run(failure(renderer, bad)), cc.ShaderError)
    assert order == futures


async def failure(renderer, scene):
    try:
        await renderer.capture_async(scene, size=2)
    except cc.Error as error:
        return error


def test_64_calls_wait_and_the_next_one_waits_for_room(renderer):
    """The call itself waits, so that a loop over many places holds few snapshots."""
    made, futures = [], []

    def submit():
        for number in range(80):
            futures.append(renderer.capture_async(cc.Scene(background=(number / 80, 0, 0)), size=1))
            made.append(number)

    thread = threading.Thread(target=submit)
    with occupied(renderer):
        thread.start()
        while len(made) < 64:
            thread.join(0.01)
        thread.join(0.2)
        assert len(made) == 64
        assert thread.is_alive()
    thread.join()
    reds = [float(future.result().faces[0, 0, 0, 0]) for future in futures]
    assert reds == pytest.approx(np.arange(80) / 80)


def test_memory_is_asked_for_all_results_that_are_not_there(renderer, monkeypatch):
    """A call waits until the results of the calls before it are there, and is refused if it is too large alone."""
    asked = []
    one = 6 * 512 * 512 * 16

    def check(size, what):
        asked.append(size)
        if size >= 3 * one:
            raise ValueError(f"size: expected what fits, got {what}")

    monkeypatch.setattr(cc._core, "_check_memory", check)
    futures = []

    def submit():
        for _ in range(4):
            futures.append(renderer.capture_async(cc.Scene(), size=512))

    thread = threading.Thread(target=submit)
    with occupied(renderer):
        thread.start()
        while len(futures) < 2 or asked[-1] < 3 * one:
            thread.join(0.01)
        thread.join(0.2)
        assert len(futures) == 2
    thread.join()
    assert [future.result().size for future in futures] == [512] * 4
    assert {size // one for size in asked} >= {1, 2, 3}
    with pytest.raises(ValueError, match="size: expected what fits"):
        renderer.capture_async(cc.Scene(), size=1024)


def test_a_with_block_draws_what_was_called_in_it(renderer, buffers):
    scene = scene_of((1, 0, 0))
    with renderer:
        futures = [renderer.capture_async(scene, (0.1 * step, 0, 0), 8) for step in range(9)]
    assert all(future.done() for future in futures)
    assert futures[8].result().size == 8
    for call in (renderer.capture_async, renderer.capture):
        with pytest.raises(cc.ContextError, match="closed"):
            call(scene, size=2)


def test_an_exception_in_a_with_block_cancels_what_waits(renderer):
    with contextlib.ExitStack() as stack, contextlib.suppress(ZeroDivisionError), renderer:
        stack.enter_context(occupied(renderer))
        futures = [renderer.capture_async(cc.Scene(), size=2) for _ in range(3)]
        futures[-1].add_done_callback(lambda _: stack.close())  # else close() would wait for ever
        raise ZeroDivisionError
    assert renderer.closed
    assert all(future.cancelled() for future in futures)


def ended(reference):
    """Whether an object ends within a few seconds."""
    for _ in range(500):
        gc.collect()
        if reference() is None:
            return True
        threading.Event().wait(0.01)
    return False


def test_a_renderer_lives_until_its_calls_are_done(buffers):
    """And no longer: neither its thread nor an error that a future keeps holds it."""
    made = cc.Renderer(device=DEVICE)
    gone = weakref.ref(made)
    futures = [made.capture_async(scene_of((1, 0, 0)), size=4 + step) for step in range(5)]
    bad = cc.Scene()
    bad.add(cc.Mesh.box(1), cc.ShaderMaterial("vec3 shade(Surface s) { return nothing; }"))
    wrong = made.capture_async(bad, size=4)
    del made
    assert [future.result().size for future in futures] == [4, 5, 6, 7, 8]
    assert isinstance(wrong.exception(), cc.ShaderError)
    assert ended(gone)


def test_a_result_ends_with_its_future(renderer, buffers):
    """The thread that waits for the next call does not hold it."""
    futures = [renderer.capture_async(cc.Scene(), size=4) for _ in range(3)]
    gone = [weakref.ref(future.result()) for future in futures]
    del futures
    assert all(ended(reference) for reference in gone)


def test_a_callback_may_use_the_renderer(renderer, buffers):
    """It runs on the thread that draws: its calls are drawn at once, before those that wait; close() waits for none."""
    scene = scene_of((1, 0, 0), (0, 1, 0))
    want = renderer.capture(scene, size=9).faces
    got = []

    def use(_):
        got.append(renderer.capture(scene, size=9).faces)
        got.append(renderer.capture_async(scene, size=9))
        renderer.close()

    with occupied(renderer):
        first = renderer.capture_async(scene, size=2)
        first.add_done_callback(use)
        last = renderer.capture_async(scene, size=3)
    assert first.result().size == 2
    for future in (last, got[1] if len(got) > 1 else last):
        with pytest.raises(cc.ContextError, match="closed"):
            future.result(60)
    assert_identical(got[0], want)


def test_threads_mix_both_kinds_of_calls(renderer, buffers):
    scenes = [scene_of((1, 0.2 * seed, 0), (0, 1, 0.2 * seed)) for seed in range(4)]
    want = [renderer.capture(scene, size=10, outputs=("distance",)) for scene in scenes]

    def work(number):
        got = []
        for step in range(8):
            call = renderer.capture if step % 3 == number % 3 else renderer.capture_async
            got.append(call(scenes[number], size=10, outputs=("distance",)))
        return [item if isinstance(item, cc.CubeMap) else item.result() for item in got]

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for cubes, wanted in zip(pool.map(work, range(4)), want, strict=True):
            for cube in cubes:
                same_cube(cube, wanted)


def test_the_call_does_not_wait_for_drawing(renderer):
    """While the renderer's thread is busy, calls return; a call that waited for it would never do so."""
    with occupied(renderer):
        future = renderer.capture_async(scene_of((1, 0, 0)), size=64, samples=4)
        assert not future.done()
    assert future.result().size == 64


PRELUDE = f"""
import asyncio, atexit, concurrent.futures, os, signal, sys, threading, time
import numpy as np
import cubecam as cc
from tests.gl.test_async import occupied, scene_of, while_drawing
device = {DEVICE!r}
scene = scene_of((1, 0, 0), (0, 1, 0))
renderer = cc.Renderer(device=device)
want = renderer.capture(scene, size=8).faces
"""


def test_in_a_forked_child():
    """Pictures that were there stay there, those that were not raise, and nothing hangs, the end included."""
    run_python(
        PRELUDE
        + """
there = renderer.capture_async(scene, size=8)
there.result()
for end in ("os._exit(0)", "sys.exit(0)"):
    with occupied(renderer):
        waiting = [renderer.capture_async(scene, size=8) for _ in range(3)]
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            signal.alarm(60)
            assert (there.result().faces == want).all()
            for call in (waiting[0].result, waiting[1].exception, lambda: renderer.capture_async(scene, size=8)):
                try:
                    call()
                except cc.ContextError as error:
                    assert "process" in str(error), error
                else:
                    os._exit(1)
            renderer.close()
            del waiting, renderer
            exec(end)
        assert os.waitpid(child, 0)[1] == 0
    assert all((future.result().faces == want).all() for future in waiting)
""",
        timeout=200,
    )


ENDS = {
    "by itself": ("", ""),
    "pixels under way": ("cc._core._read_through_buffers(True)", ""),
    "a thread waits": ("", "threading.Thread(target=wait).start()"),
    "a handler waits": ("atexit.register(late)", ""),
    "sys.exit": ("", "sys.exit(0)"),
    "no renderer": ("", "del renderer"),
}


@pytest.mark.parametrize(("first", "last"), ENDS.values(), ids=ENDS)
def test_the_interpreter_ends_with_calls_that_wait(first, last):
    """At once and in silence; who can still wait gets a picture or CancelledError, and calls in destructors work."""
    done = run_python(
        PRELUDE
        + f"""
def wait():
    assert (futures[3].result().faces == want).all()
    print("drawn")
def late():
    try:
        futures[-1].result()
    except concurrent.futures.CancelledError:
        print("cancelled")
class AtTheEnd:
    renderer, scene, write = renderer, scene, staticmethod(os.write)
    def __del__(self):  # Python does not promise to call it
        self.renderer.update_probes(self.scene)
        self.write(1, b"updated\\n")
kept = AtTheEnd()
{first}
futures = [renderer.capture_async(scene, size=8) for _ in range(4)]
futures += [renderer.capture_async(scene, size=300) for _ in range(40)]
{last}
""",
        timeout=100,
    )
    assert done.stderr == ""
    word = "drawn\n" if "wait" in last else "cancelled\n" if first.startswith("atexit") else ""
    assert done.stdout in (word, word + "updated\n")


def test_ctrl_c_ends_the_wait_for_a_result():
    """And nothing else: the call goes on."""
    run_python(
        PRELUDE
        + """
signal.signal(signal.SIGINT, signal.default_int_handler)
with occupied(renderer):
    future = renderer.capture_async(scene, size=8)
    killer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    killer.start()
    try:
        future.result()
    except KeyboardInterrupt:
        pass
    else:
        raise AssertionError("expected a KeyboardInterrupt")
    killer.join()
    assert not future.done()
    futures = [renderer.capture_async(scene, size=8) for _ in range(63)]
    def more(): renderer.capture_async(scene, size=8)
    def now(): renderer.capture(scene, size=8)
    for wait in (more, now, renderer.close):
        killer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        killer.start()
        try:
            wait()
        except KeyboardInterrupt:
            killer.join()
        else:
            raise AssertionError("expected a KeyboardInterrupt")
assert all((future.result().faces == want).all() for future in [future, *futures])
assert (renderer.capture(scene, size=8).faces == want).all()
""",
        timeout=100,
    )


def test_a_signal_handler_may_call_the_renderer_while_a_call_waits_for_its_turn():
    """It has the place of that wait. One that interrupts drawing can submit calls and close: neither waits."""
    run_python(
        PRELUDE
        + """
cc._core._interrupt_pause(0)
seen = []
def handler():
    cc._core._at_interrupt_check(None)
    gate.set()
    seen.append(renderer.capture(scene, size=8).faces)
with occupied(renderer) as gate:
    first = renderer.capture_async(scene, size=8)
    cc._core._at_interrupt_check(handler)
    seen.append(renderer.capture(scene, size=8).faces)
assert len(seen) == 2 and all((faces == want).all() for faces in [*seen, first.result().faces])
assert (renderer.capture(scene, size=8).faces == want).all()
# Inside a drawing call: close() and submitting wait for nothing.
def inside():
    made = [renderer.capture_async(scene, size=8) for _ in range(70)]
    renderer.close()
    return made
futures = while_drawing(renderer, inside)
for future in futures:
    try:
        future.result(60)
    except cc.ContextError as error:
        assert "closed" in str(error)
    else:
        raise AssertionError("expected a ContextError")
""",
        timeout=100,
    )


LOST = (
    PRELUDE
    + """
import warnings
from tests.gl.lost import end_displays, warned
"""
)


def test_a_lost_context_is_made_again_and_the_user_warned_at_the_line_of_the_call():
    run_python(
        LOST
        + """
for through in (False, True):
    cc._core._read_through_buffers(through)
    end_displays()
    with warned(1) as caught:
        line = sys._getframe().f_lineno
        futures = [renderer.capture_async(scene, size=8) for _ in range(3)]
        assert all((future.result().faces == want).all() for future in futures)
    assert caught[0].filename == "<string>", caught[0].filename
    assert caught[0].lineno == line + 1, (caught[0].lineno, line)
    with warned(0):
        assert (renderer.capture_async(scene, size=8).result().faces == want).all()
# As an error it is the future's, and the next call draws.
with warnings.catch_warnings():
    warnings.simplefilter("error")
    end_displays()
    try:
        renderer.capture_async(scene, size=8).result()
    except cc.RendererWarning as error:
        assert "was lost" in str(error)
    else:
        raise AssertionError("expected the warning as an error")
    assert (renderer.capture_async(scene, size=8).result().faces == want).all()
""",
        timeout=100,
    )


def test_pixels_that_are_lost_on_their_way_are_drawn_again():
    """The context goes after a picture is drawn, before its pixels have come; also where another call notices it."""
    run_python(
        LOST
        + """
cc._core._read_through_buffers(True)
cc._futures.submit = lambda renderer, call, size, may_wait: call
def drawn():
    call = renderer.capture_async(scene, size=8)
    call.join_line()
    assert not call.draw()
    return call
for _ in range(3):
    call = drawn()
    end_displays()
    with warned(0):
        assert (call.result().faces == want).all()
    assert len(call.notices) == 1 and "was lost" in call.notices[0]
    call = drawn()
    end_displays()
    with warned(1):
        renderer.capture(scene, size=4)
    assert (call.result().faces == want).all()
    assert call.notices == []
two = [drawn(), drawn()]
assert all((call.result().faces == want).all() for call in two)
del two[0]
call = drawn()
renderer.close()
try:
    call.result()
except cc.ContextError as error:
    assert "closed" in str(error)
else:
    raise AssertionError("expected a ContextError")
""",
        timeout=100,
    )
