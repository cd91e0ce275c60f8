"""`cc.Pool`: the bytes of one renderer, whatever becomes of the processes that draw, and nothing left behind."""

import concurrent.futures
import contextlib
import gc
import inspect
import multiprocessing
import os
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
import weakref
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from benchmarks.peers import pool_cubecam
from cubecam.pool import crew as crews
from cubecam.pool import memory, remote
from tests.gl import pool_scenes
from tests.gl.full_world import full_world
from tests.helpers import DEVICE, open_files, run_python

SIZE = 8


def places(count, reach=1.5):
    return np.random.default_rng(count).uniform(-reach, reach, (count, 3))


def boxes(count=6):
    rng = np.random.default_rng(3)
    scene = cc.Scene(background=(0.2, 0.4, 0.8))
    scene.add(cc.DirectionalLight((-0.3, -1, -0.2)))
    for _ in range(count):
        material = cc.PhongMaterial(color=tuple(rng.random(3)))
        scene.add(cc.Mesh.box(0.5), material, position=rng.uniform(-3, 3, 3))
    return scene


def assert_same(batch, other):
    """Batches of cubemaps or frames with the same bytes."""
    assert len(batch) == len(other)
    assert batch.encoding == other.encoding
    color = [each.faces if hasattr(each, "faces") else each.color for each in (batch, other)]
    assert color[0].dtype == color[1].dtype
    assert color[0].tobytes() == color[1].tobytes()
    assert list(batch.outputs) == list(other.outputs)
    for name, values in other.outputs.items():
        assert batch.outputs[name].dtype == values.dtype
        assert batch.outputs[name].tobytes() == values.tobytes(), name


def children():
    """Processes of this one, also those that nobody has waited for, but for what multiprocessing keeps."""
    found = set()
    for task in Path("/proc/self/task").iterdir():
        try:
            for number in (task / "children").read_text().split():
                if b"resource_tracker" not in Path(f"/proc/{number}/cmdline").read_bytes():
                    found.add(number)
        except OSError:  # a thread or a process that has ended
            continue
    return found


def shared_memory():
    """The mappings and descriptors of shared memory that this process has."""
    maps = [
        line for line in Path("/proc/self/maps").read_text().splitlines() if "memfd:cubecam" in line
    ]
    for number in Path("/proc/self/fd").iterdir():
        try:
            if "memfd:cubecam" in str(number.readlink()):
                maps.append(number.name)
        except OSError:
            continue
    return maps


def crew_of(pool):
    """The processes of a pool."""
    assert isinstance(pool._crew, crews.Crew)
    return pool._crew


def eventually(holds, seconds=20):
    """Wait until a condition holds."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "expected it to hold in time"
        time.sleep(0.02)


@pytest.fixture(scope="module")
def pool():
    """Two workers for all tests that leave them as they were."""
    before = children()
    with cc.Pool(workers=2, device=DEVICE) as made:
        yield made
    assert children() <= before
    assert not list(Path("/dev/shm").glob("*cubecam*"))
    gc.collect()
    assert shared_memory() == []


@pytest.fixture(scope="module")
def one_worker():
    with cc.Pool(workers=1, device=DEVICE) as made:
        yield made


@pytest.mark.parametrize(
    "options",
    [
        {"outputs": ("distance", "normal", "id")},
        {"format": "rgba8", "outputs": ("depth",), "depth_order": "farthest"},
        {"format": "rgb565", "samples": 4, "near": 0.3, "far": 4.0, "eye": (0.5, 0, 0)},
    ],
    ids=str,
)
def test_captures_have_the_bytes_of_one_renderer(pool, one_worker, renderer, options):
    scene, positions = boxes(), places(70)
    turns = np.random.default_rng(1).normal(size=(70, 4))
    arguments = (scene, positions, SIZE)
    options = {**options, "rotations": turns, "exclude": [next(iter(scene.nodes))]}
    single = renderer.capture_many(*arguments, **options)
    two = pool.capture_many(*arguments, **options)
    assert_same(two, single)
    assert_same(one_worker.capture_many(*arguments, **options), single)
    assert (two.positions == positions).all()
    assert (two.rotations == turns).all()
    assert two.faces.flags.writeable
    two.faces[0] = 1  # and nobody writes there any more
    assert two.faces[0].min() == 1
    for cube, expected in zip(pool.iter_captures(*arguments, **options), single, strict=True):
        assert cube.faces.tobytes() == expected.faces.tobytes()
        assert list(cube.outputs) == list(expected.outputs)
        for name, values in expected.outputs.items():
            assert cube.outputs[name].tobytes() == values.tobytes()


@pytest.mark.slow
def test_a_world_with_everything(pool, new_renderer, rng):
    """Render textures, probes, users' shaders, skins, effects: workers draw what one new renderer draws."""
    world = full_world(rng)
    captured = pool.capture_many(world.scene, places(5, 0.5), 12, outputs=["distance"])
    assert_same(
        captured, new_renderer().capture_many(world.scene, places(5, 0.5), 12, outputs=["distance"])
    )
    cameras = [cc.PerspectiveCamera(position=place, target=(0, 0, 0)) for place in places(5, 3)]
    options = {"outputs": ["distance"], "format": "rgba32f", "encode": "srgb", "exposure": 0.5}
    rendered = pool.render_many(world.scene, cameras, (20, 12), **options)
    assert_same(rendered, new_renderer().render_many(world.scene, cameras, (20, 12), **options))


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"format": None, "outputs": ["id"]},
        {"tonemap": "neutral", "encode": "srgb", "format": "rgba16f"},
        {"effects": ["vec3 effect(vec2 uv) { return frame(uv.yx).rgb; }"], "samples": 4},
    ],
    ids=str,
)
def test_frames_have_the_bytes_of_one_renderer(pool, renderer, options):
    scene = boxes()
    if "effects" in options:
        options = {**options, "effects": [cc.ImageEffect(text) for text in options["effects"]]}
    mono = [cc.PerspectiveCamera(position=place, target=(0, 0, 0)) for place in places(4, 3)]
    parent = scene.add(position=(0, 0, 1))
    moved = cc.PerspectiveCamera(position=(0, 0, 2), parent=parent)
    stereo = cc.StereoCamera(mono[0], mono[1], layout="side_by_side")
    for cameras in (mono, [mono[0], moved, stereo]):
        single = renderer.render_many(scene, cameras, (24, 16), **options)
        rendered = pool.render_many(scene, cameras, (24, 16), **options)
        if single.color is None:
            assert rendered.color is None
            assert (rendered.id == single.id).all()
        else:
            assert_same(rendered, single)
        assert (rendered.size, rendered.format) == (single.size, single.format)


def test_scenes_have_the_bytes_of_one_renderer(pool, renderer):
    at = places(50, 0.2)
    made = pool.capture_scenes(
        pool_scenes.numbered, 50, position=at, size=SIZE, outputs=["distance"]
    )
    single = cc.capture_scenes(
        pool_scenes.numbered, 50, position=at, size=SIZE, outputs=["distance"], renderer=renderer
    )
    assert_same(made, single)
    assert (made.positions == at).all()
    assert len(pool.capture_scenes(pool_scenes.numbered, 0, size=SIZE)) == 0
    assert len(pool.capture_many(boxes(), np.zeros((0, 3)), SIZE)) == 0


def test_a_scene_that_is_given_again_begins_anew(pool, one_worker, new_renderer):
    """Else what its probe shows would depend on which numbers one worker has drawn."""
    made = pool.capture_scenes(pool_scenes.same_again, 40, size=SIZE)
    assert_same(made, one_worker.capture_scenes(pool_scenes.same_again, 40, size=SIZE))
    for number in (0, 1, 39):
        alone = new_renderer().capture(pool_scenes.same_again(number), size=SIZE)
        assert made.faces[number].tobytes() == alone.faces.tobytes()


def mirror(**probe):
    scene = boxes()
    ball = scene.add(cc.Mesh.sphere(0.8, 16, 8), cc.MirrorMaterial(), position=(0, 0, -2))
    ball.environment = cc.Probe(parent=ball, size=8, **probe)
    return scene


@pytest.mark.parametrize(
    "policy",
    [{"update": "once"}, {"update": 3}, {"faces_per_frame": 1}, {"update": "manual"}],
    ids=str,
)
def test_a_call_shows_the_scene_as_it_is(pool, new_renderer, policy):
    """Whatever the workers have drawn of the scene before."""
    scene = mirror(**policy)
    for color in ("red", "lime"):
        scene.background = color
        batch = pool.capture_many(scene, places(9, 0.3), SIZE)
        assert_same(batch, new_renderer().capture_many(scene, places(9, 0.3), SIZE))


def sent_scenes(monkeypatch):
    """A list that grows by an entry with each scene that a worker gets."""
    sent = []
    load = crews._Seat._load

    def counted(seat, payload):
        sent.append((id(seat), payload.token))
        load(seat, payload)

    monkeypatch.setattr(crews._Seat, "_load", counted)
    return sent


def test_an_unchanged_scene_is_sent_once_to_each_worker(pool, renderer, monkeypatch):
    sent = sent_scenes(monkeypatch)
    scene = boxes()
    for _ in range(3):
        pool.capture_many(scene, places(60), SIZE)
    assert len({token for _, token in sent}) == 1
    next(iter(scene.nodes)).visible = False
    batch = pool.capture_many(scene, places(60), SIZE)
    assert len({token for _, token in sent}) == 2
    assert len(sent) == len(set(sent))
    assert_same(batch, renderer.capture_many(scene, places(60), SIZE))


def test_workers_forget_what_nobody_needs(one_worker):
    def memory():
        [process] = crew_of(one_worker).pids
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
        return sum(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024

    found = []
    for number in range(6):
        scene = cc.Scene()
        image = cc.Image(np.full((2048, 2048, 4), number, np.uint8))  # 16 MiB
        scene.add(cc.Mesh.plane(), cc.BasicMaterial(map=image))
        one_worker.capture_many(scene, places(2), SIZE)
        found.append(memory())
    assert found[-1] - found[1] < 3 * 16  # four more would be 64, and again as much for the driver


def test_a_result_is_shared_memory_and_goes_with_its_arrays():
    gc.collect()
    before = len(shared_memory())
    with cc.Pool(workers=1, device=DEVICE, cache_bytes=0) as pool:
        batch = pool.capture_many(boxes(), places(20), SIZE, outputs=["distance"])
        assert len(shared_memory()) == before + 1  # one mapping, no descriptor
        distance = batch.distance
        del batch
        assert len(shared_memory()) == before + 1
        assert np.isfinite(distance).any()
        del distance
        assert len(shared_memory()) == before
        maps = Path(f"/proc/{crew_of(pool).pids[0]}/maps")
        eventually(lambda: "memfd:cubecam" not in maps.read_text())


def test_the_memory_of_a_result_that_is_gone_serves_the_next_one(pool, renderer):
    def drawn(number):
        return pool.capture_many(boxes(number), places(21), SIZE)

    def where(batch):
        return batch.faces.ctypes.data

    first = drawn(1)
    place, numbers = where(first), first.faces.tobytes()
    second = drawn(2)
    assert where(second) != place
    assert first.faces.tobytes() == numbers
    view = first.faces[3:4]
    del first
    third = drawn(3)
    assert where(third) != place
    del view
    fourth = drawn(4)
    assert where(fourth) == place
    for number, batch in ((2, second), (3, third), (4, fourth)):
        assert_same(batch, renderer.capture_many(boxes(number), places(21), SIZE))
    del fourth
    before = len(shared_memory())
    for _ in range(10):
        pool.capture_many(boxes(), places(2), SIZE)
    assert (
        len(shared_memory()) <= before
    )  # that of the fourth is gone; one of the last size is there


def test_memory_into_which_workers_may_still_write_serves_nobody(pool, renderer):
    scene = boxes()
    single = renderer.capture_many(scene, places(90), SIZE)
    for _ in range(10):
        cubes = pool.iter_captures(scene, places(90), SIZE)
        next(cubes)
        running = crew_of(pool)._calls[-1]
        number = running.memory.number
        whole = running.is_whole
        del running
        cubes.close()
        assert crew_of(pool)._store.has(number) == whole
        assert_same(pool.capture_many(scene, places(90), SIZE), single)


def test_iter_captures_never_holds_more_than_a_few_pieces(pool):
    cubes = pool.iter_captures(boxes(), places(400), SIZE, format="rgba8")
    next(cubes)
    running = crew_of(pool)._calls[0]
    time.sleep(0.3)
    assert running.next <= running.call.window == 5
    assert running.call.arrays[0].shape[0] == running.call.rows < 400
    del running
    cubes.close()
    assert crew_of(pool)._calls == []


def test_calls_within_a_loop_and_in_threads(pool, renderer):
    scene = boxes()
    single = renderer.capture_many(scene, places(30), SIZE)
    found = {}

    def draw(number):
        found[number] = pool.capture_many(scene, places(30), SIZE)

    threads = [threading.Thread(target=draw, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for number, cube in enumerate(pool.iter_captures(scene, places(30), SIZE)):
        assert cube.faces.tobytes() == single[number].faces.tobytes()
        if number == 3:
            assert_same(pool.capture_many(scene, places(30), SIZE), single)
    for thread in threads:
        thread.join(60)
    for batch in found.values():
        assert_same(batch, single)
    assert len(found) == 3


def test_the_scene_is_that_of_the_call(pool, renderer):
    scene = boxes()
    single = renderer.capture_many(scene, places(30), SIZE)
    cubes = pool.iter_captures(scene, places(30), SIZE)
    scene.background = (1, 1, 1)
    assert [cube.faces.tobytes() for cube in cubes] == [cube.faces.tobytes() for cube in single]


# ---------------------------------------------------------------------- what goes wrong


def test_a_worker_that_dies_is_replaced(pool, renderer, tmp_path):
    first = set(crew_of(pool).pids)
    made = pool.capture_scenes(pool_scenes.DiesOnce(tmp_path), 12, size=SIZE)
    assert_same(made, cc.capture_scenes(pool_scenes.numbered, 12, size=SIZE, renderer=renderer))
    assert (tmp_path / "died").exists()
    assert set(crew_of(pool).pids) != first


def test_workers_that_are_killed_in_the_middle(pool, renderer):
    scene = boxes()
    single = renderer.capture_many(scene, places(200), SIZE)
    cubes = pool.iter_captures(scene, places(200), SIZE)
    found = []
    for number, cube in enumerate(cubes):
        found.append(cube.faces)
        if number in (3, 60):
            for process in crew_of(pool).pids:
                os.kill(process, signal.SIGKILL)
    assert np.stack(found).tobytes() == single.faces.tobytes()


@pytest.mark.slow
def test_workers_that_died_between_two_calls(pool):
    """They are no sign that a piece kills those who draw it."""
    for _ in range(4):
        for process in crew_of(pool).pids:
            os.kill(process, signal.SIGKILL)
        assert len(pool.capture_many(boxes(), places(1), SIZE)) == 1


@pytest.mark.slow
def test_what_kills_every_worker(pool):
    text = (
        "scenes 3: expected a worker process to draw them, got the end of 3 that tried (SIGKILL, "
        "SIGKILL, SIGKILL)"
    )
    with pytest.raises(cc.Error, match=re.escape(text)):
        pool.capture_scenes(pool_scenes.dying, 12, size=SIZE)
    assert len(pool.capture_many(boxes(), places(5), SIZE)) == 5


@pytest.mark.slow
def test_workers_that_cannot_start(monkeypatch, capfd):
    monkeypatch.setattr(crews, "_WORKER", "cubecam.pool.worker:absent")
    with (
        cc.Pool(workers=1, device=DEVICE) as pool,
        pytest.raises(cc.Error, match=r"expected worker processes to start, .*\(the status 1, "),
    ):
        pool.capture_many(boxes(), places(5), SIZE)
    assert "absent" in capfd.readouterr().err


def test_what_a_worker_raises(pool):
    with pytest.raises(LookupError, match="no scene has the number 7") as caught:
        pool.capture_scenes(pool_scenes.failing, 40, size=SIZE)
    assert "in failing" in str(caught.value.__cause__)
    assert "Traceback (most recent call last)" in str(caught.value.__cause__)
    with pytest.raises(RuntimeError, match=r"SystemExit\('enough'\)"):
        pool.capture_scenes(pool_scenes.leaving, 12, size=SIZE)
    with pytest.raises(ValueError, match=r"same outputs and encoding.*from number 5"):
        pool.capture_scenes(pool_scenes.other_outputs, 12, size=SIZE, outputs=["heat"])
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.ShaderMaterial("vec3 shade(Surface s) { return nothing; }"))
    with pytest.raises(cc.ShaderError, match="nothing") as wrong:
        pool.capture_many(scene, places(20), SIZE)
    assert "in draw" in str(wrong.value.__cause__)
    assert len(pool.capture_many(boxes(), places(5), SIZE)) == 5


def test_the_memory_of_a_call_that_fails_goes_with_its_error(pool, monkeypatch):
    made = []
    original = memory.Memory.__init__

    def noted(new, size):
        original(new, size)
        made.append(weakref.ref(new))

    monkeypatch.setattr(memory.Memory, "__init__", noted)
    gc.disable()
    try:
        for _ in range(3):
            with contextlib.suppress(LookupError):
                pool.capture_scenes(pool_scenes.failing, 43, size=SIZE)
        eventually(lambda: not any(each() for each in made))
    finally:
        gc.enable()
    assert len(made) == 3


def test_which_error_is_raised(pool):
    """The error of the first piece that has one is raised, whoever finds one first."""
    for _ in range(3):
        with pytest.raises(LookupError, match="no scene has the number 7"):
            pool.capture_scenes(pool_scenes.failing_from_7, 400, size=SIZE)


def test_warnings_of_workers_come_to_the_users_line(pool):
    with pytest.warns(UserWarning, match="number 2 is odd") as caught:
        pool.capture_scenes(pool_scenes.warning, 5, size=SIZE)
    assert caught[0].filename == __file__


OTHER = boxes()
FOREIGN = next(iter(OTHER.nodes))

BAD_CALLS = {
    "positions": {"positions": [(0, 0)]},
    "nan": {"positions": [(0, 0, np.nan)]},
    "size": {"size": 0},
    "large": {"size": 10**6},
    "outputs": {"outputs": ["colour"]},
    "rotations": {"rotations": [(0, 0, 0, 0)]},
    "near": {"near": -1},
    "exclude": {"exclude": [3]},
    "foreign": {"exclude": [FOREIGN]},
    "samples": {"samples": 3.5},
    "format": {"format": "rgb"},
    "scene": {"scene": 3},
    "progress": {"progress": 1},
    "room": {"positions": np.zeros((3, 3)), "size": 16384, "outputs": ["position", "normal"]},
}


@pytest.mark.parametrize("bad", BAD_CALLS.values(), ids=BAD_CALLS)
@pytest.mark.parametrize("method", ["capture_many", "iter_captures"])
def test_wrong_arguments_raise_what_the_renderer_raises(pool, renderer, monkeypatch, method, bad):
    sent = sent_scenes(monkeypatch)
    arguments = {"scene": boxes(), "positions": [(0, 0, 0)], "size": SIZE, **bad}
    errors = []
    for draws in (renderer, pool):
        with pytest.raises((TypeError, ValueError)) as caught:
            getattr(draws, method)(**arguments)
        errors.append((caught.type, re.sub(r"[\d.,]+ [KMGT]?i?B", "", str(caught.value))))
    assert errors[0] == errors[1]
    assert sent == []


@pytest.mark.parametrize(
    "bad",
    [
        {"cameras": []},
        {"cameras": [3]},
        {"size": (0, 5)},
        {"outputs": ["nothing"]},
        {"effects": [3]},
        {"format": None, "tonemap": "neutral", "effects": "x"},
        {"size": (10**6, 4)},
    ],
    ids=str,
)
def test_wrong_frames_raise_what_the_renderer_raises(pool, renderer, bad):
    arguments = {"scene": boxes(), "cameras": [cc.PerspectiveCamera()], "size": (8, 8), **bad}
    errors = []
    for draws in (renderer, pool):
        with pytest.raises((TypeError, ValueError)) as caught:
            draws.render_many(**arguments)
        errors.append((caught.type, str(caught.value)))
    assert errors[0] == errors[1]


@pytest.mark.parametrize("workers", [0, -1, 1.5, True, "2"])
def test_a_number_of_workers_is_an_int_of_at_least_one(workers):
    with pytest.raises((TypeError, ValueError), match=r"workers: expected (an int|int or None)"):
        cc.Pool(workers=workers)


def test_wrong_pools():
    with pytest.raises(TypeError, match="executor: expected an Executor"):
        cc.Pool(executor=3)  # type: ignore[arg-type]
    with pytest.raises(cc.ContextError, match="no device 1000000"):
        cc.Pool(device=10**6)
    with pytest.raises(TypeError, match="did you mean 'workers'"):
        cc.Pool(worker=2)  # type: ignore[call-arg]


def test_functions_that_workers_cannot_find(pool, monkeypatch):
    monkeypatch.setitem(sys.modules, "cloudpickle", None)
    with pytest.raises(
        TypeError, match=r"make_scene: expected a function at the top of a module.*cloudpickle"
    ):
        pool.capture_scenes(lambda number: cc.Scene(), 3)
    with pytest.raises(TypeError, match="make_scene: expected a callable, got 3"):
        pool.capture_scenes(3, 3)


def test_functions_of_a_session_are_told_from_those_of_a_script():
    """Also where they are part of something else, which has no module."""
    made = run_python(
        f"""
import functools, sys
import cubecam as cc

def make(color, number):
    return cc.Scene(background=color)

sys.modules["cloudpickle"] = None
with cc.Pool(workers=1, device={DEVICE!r}) as pool:
    try:
        pool.capture_scenes(functools.partial(make, (0, 1, 0)), 2, size=1)
    except TypeError as error:
        print(error)
"""
    )
    assert "functions of a notebook or an interactive session work, too" in made.stdout


def test_functions_that_travel_by_cloudpickle(pool):
    pytest.importorskip("cloudpickle")
    shift = 0.25
    made = pool.capture_scenes(
        lambda number: cc.Scene(background=(number * shift, 0, 0)), 4, size=1
    )
    assert made.faces[:, 0, 0, 0, 0].tolist() == [0, 0.25, 0.5, 0.75]


def test_the_threads_of_all_workers_are_as_many_as_the_cores(pool, monkeypatch):
    def threads(pool):
        [process, *_] = crew_of(pool).pids
        found = Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
        return [each for each in found if each.startswith(b"LP_NUM_THREADS=")]

    each = len(os.sched_getaffinity(0)) // 2
    if "LP_NUM_THREADS" not in os.environ:
        assert threads(pool) == [b"LP_NUM_THREADS=%d" % (each if each > 1 else 0)]
    monkeypatch.setenv("LP_NUM_THREADS", "3")  # the user's own
    with cc.Pool(workers=1, device=DEVICE) as own:
        assert threads(own) == [b"LP_NUM_THREADS=3"]


# ---------------------------------------------------------------------- ends


def test_nothing_is_left_of_a_pool():
    gc.collect()
    before, files = children(), open_files("pipe:", "socket:", "/memfd:cubecam")
    pool = cc.Pool(workers=2, device=DEVICE)
    assert len(children() - before) >= 2
    batch = pool.capture_many(boxes(), places(4), SIZE)
    assert repr(pool) == "Pool(workers=2)"
    with pytest.raises(TypeError, match=r"cannot pickle a cubecam\.Pool"):
        pickle.dumps(pool)
    pool.close()
    pool.close()
    assert repr(pool) == "Pool(workers=2, closed)"
    assert children() <= before
    assert np.isfinite(batch.faces).all()  # the result needs no pool
    with pytest.raises(cc.ContextError, match="the pool is closed"):
        pool.capture_many(boxes(), places(4), SIZE)
    lost = cc.Pool(workers=1, device=DEVICE)
    del lost
    gc.collect()
    assert children() <= before
    del batch
    assert open_files("pipe:", "socket:", "/memfd:cubecam") <= files
    assert not [
        thread
        for thread in threading.enumerate()
        if thread.name == "cubecam pool" and not thread.daemon
    ]


def test_close_ends_the_calls_of_other_threads():
    found = []
    pool = cc.Pool(workers=1, device=DEVICE)

    def draw():
        try:
            pool.capture_scenes(pool_scenes.slow, 3, size=SIZE)
        except cc.ContextError as error:
            found.append(str(error))

    thread = threading.Thread(target=draw)
    thread.start()
    eventually(lambda: any(seat.draws for seat in crew_of(pool)._seats))
    pool.close()
    thread.join(20)
    assert found == ["the pool is closed: expected an open Pool"]


def alive(processes):
    return [
        number
        for number in processes
        if Path(f"/proc/{number}").exists()
        and "State:\tZ" not in Path(f"/proc/{number}/status").read_text()
    ]


SCRIPT = """
    import os, signal, sys, threading, time
    import cubecam as cc
    sys.path.insert(0, {root!r})
    from tests.gl import pool_scenes

    with cc.Pool(workers=2, device={device!r}) as pool:
        print(*pool._crew.pids, flush=True)
        def tell():
            while sum(seat.draws is not None for seat in pool._crew._seats) < 2:
                time.sleep(0.01)
            time.sleep(0.2)
            print("drawing", flush=True)
        threading.Thread(target=tell, daemon=True).start()
        try:
            pool.capture_scenes(pool_scenes.slow, 8, size=8)
        except KeyboardInterrupt:
            print("interrupted", flush=True)
        with open("/proc/self/maps") as file:
            maps = file.read()
        print("memory left:", "memfd:cubecam" in maps, flush=True)
        print(len(pool.capture_many(cc.Scene(), [(0, 0, 0)], 8)), flush=True)
    print("closed", flush=True)
"""


@pytest.fixture
def script():
    """A program whose two workers draw something slow, and their processes."""
    root = str(Path(__file__).resolve().parents[2])
    program = subprocess.Popen(
        [
            sys.executable,
            "-W",
            "error::ResourceWarning",
            "-c",
            textwrap.dedent(SCRIPT).format(root=root, device=DEVICE),
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
    )
    processes: list[int] = []
    try:
        assert program.stdout is not None
        assert program.stderr is not None
        processes = [int(number) for number in program.stdout.readline().split()]
        assert len(processes) == 2
        assert program.stdout.readline() == "drawing\n", program.stderr.read()
        yield program, processes
    finally:
        program.kill()
        for process in alive(processes):  # of a test that fails; they hold the pipes
            os.kill(process, signal.SIGKILL)
        program.communicate()


@pytest.mark.slow
def test_ctrl_c_ends_a_call_and_leaves_nothing(script):
    program, processes = script
    assert len(alive(processes)) == 2
    for process in processes:
        os.kill(process, signal.SIGINT)  # a terminal would not send it to workers; they ignore it
    program.send_signal(signal.SIGINT)
    out, errors = program.communicate(timeout=30)
    assert out.splitlines() == ["interrupted", "memory left: False", "1", "closed"]
    assert errors == ""
    assert program.returncode == 0
    assert alive(processes) == []


@pytest.mark.slow
def test_workers_end_when_the_program_is_killed(script):
    program, processes = script
    program.kill()
    program.wait(10)
    eventually(lambda: alive(processes) == [])


@pytest.mark.slow
def test_the_end_of_the_interpreter():
    """A pool that is not closed ends with the program, without a word; in a forked process it is the parent's."""
    code = f"""
        import os, sys
        import cubecam as cc
        pool = cc.Pool(workers=2, device={DEVICE!r})
        pool.capture_many(cc.Scene(), [(0, 0, 0)] * 4, 4)
        child = os.fork()
        if child == 0:
            try:
                pool.capture_many(cc.Scene(), [(0, 0, 0)] * 4, 4)
            except cc.ContextError as error:
                assert "parent process" in str(error), error
                sys.exit(0)
            sys.exit(1)
        assert os.waitpid(child, 0)[1] == 0
        assert len(pool.capture_many(cc.Scene(), [(0, 0, 0)] * 4, 4)) == 4  # the child took nothing along
        cubes = pool.iter_captures(cc.Scene(), [(0, 0, 0)] * 400, 4)
        next(cubes)
        print(*pool._crew.pids)
    """
    done = run_python(code)
    assert done.stderr == ""
    assert alive(map(int, done.stdout.split())) == []


@pytest.mark.slow
def test_functions_of_scripts(tmp_path):
    """A function of a script is found by importing the script; one that lacks the guard gets an error that says so."""
    script = f"""
import cubecam as cc

def make_scene(number):
    return cc.Scene(background=(number / 2, 0, 0))

def main():
    with cc.Pool(workers=1, device={DEVICE!r}) as pool:
        print(pool.capture_scenes(make_scene, 3, size=2).faces[:, 0, 0, 0, 0].tolist())

"""
    results = {}
    for guard in ('if __name__ == "__main__":\n    main()\n', "main()\n"):
        path = tmp_path / "program.py"
        path.write_text(script + guard)
        results[guard] = subprocess.run(
            [sys.executable, str(path)],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        )
    right, wrong = results.values()
    assert (right.stdout, right.stderr) == ("[0.0, 0.5, 1.0]\n", "")
    assert wrong.returncode != 0
    assert (
        'RuntimeError: Pool: expected the script to make it below `if __name__ == "__main__":`'
        in wrong.stderr
    )


# ---------------------------------------------------------------------- executors


@pytest.fixture(params=["threads", "processes"])
def executor(request):
    spawn = multiprocessing.get_context("spawn")
    made: concurrent.futures.Executor = (
        concurrent.futures.ThreadPoolExecutor(2)
        if request.param == "threads"
        else concurrent.futures.ProcessPoolExecutor(2, mp_context=spawn)
    )
    with made:
        yield made


class Forgets(concurrent.futures.ThreadPoolExecutor):
    """Workers that are new to each piece."""

    def submit(self, function, /, *arguments, **options):
        def forgetting():
            vars(remote._here).clear()
            return function(*arguments, **options)

        return super().submit(forgetting)


def test_a_worker_of_an_executor_that_lacks_the_scene_gets_it(renderer):
    with Forgets(1) as executor, cc.Pool(workers=1, executor=executor, device=DEVICE) as pool:
        batch = pool.capture_scenes(pool_scenes.numbered, 24, size=2)  # eight pieces
    assert_same(batch, cc.capture_scenes(pool_scenes.numbered, 24, size=2, renderer=renderer))


@pytest.mark.slow
def test_executors(executor, new_renderer):
    scene, cameras = boxes(), [cc.PerspectiveCamera(position=(0, 0, z)) for z in (3, 4, 5)]
    single = new_renderer().capture_many(scene, places(40), SIZE, outputs=["distance"])
    with cc.Pool(executor=executor, device=DEVICE) as pool:
        assert pool.workers == 2
        batch = pool.capture_many(scene, places(40), SIZE, outputs=["distance"])
        assert_same(batch, single)
        cubes = pool.iter_captures(scene, places(40), SIZE)
        assert [cube.faces.tobytes() for cube in cubes] == [cube.faces.tobytes() for cube in single]
        frames = pool.render_many(scene, cameras, (20, 12))
        assert_same(frames, new_renderer().render_many(scene, cameras, (20, 12)))
        scenes = pool.capture_scenes(pool_scenes.numbered, 9, size=SIZE)
        assert_same(scenes, cc.capture_scenes(pool_scenes.numbered, 9, size=SIZE))
        with pytest.raises(LookupError, match="no scene has the number 7"):
            pool.capture_scenes(pool_scenes.failing, 40, size=SIZE)
    with pytest.raises(cc.ContextError, match="the pool is closed"):
        pool.capture_many(scene, places(4), SIZE)
    assert executor.submit(abs, -3).result(30) == 3  # it is the user's own


@pytest.mark.slow
def test_what_the_benchmark_draws():
    one, two = pool_cubecam.One(captures=9), pool_cubecam.Workers(workers=2, captures=9)
    assert one.digest() == two.digest()
    assert two.run()["cpu"] > 0
    assert two.killed(tries=2, seed=1)["wrong"] == 0
    one.draws.close()
    two.draws.close()


@pytest.mark.parametrize("name", ["capture_many", "iter_captures", "render_many", "capture_scenes"])
def test_arguments_are_those_of_a_renderer(name):
    own = inspect.signature(getattr(cc.Pool, name)).parameters
    alone = cc.capture_scenes if name == "capture_scenes" else getattr(cc.Renderer, name)
    wanted = {
        key: value
        for key, value in inspect.signature(alone).parameters.items()
        if key != "renderer"
    }
    assert [*own] == ["self", *(key for key in wanted if key != "self")]
    assert all(own[key].default == value.default for key, value in wanted.items() if key != "self")
