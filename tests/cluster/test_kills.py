"""Workers, schedulers and writers are killed at random times: no finished chunk is lost, none is broken.

`make test-cluster` runs these. CUBECAM_KILLS is the number of tries of each kind, 30 by default.
"""

import contextlib
import os
import random
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import cubecam as cc
from tests.cluster import work

distributed = pytest.importorskip("distributed")

pytestmark = [
    pytest.mark.cluster,
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),  # of distributed
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
]

TRIES = int(os.environ.get("CUBECAM_KILLS", "30"))
WRITER = """
import sys
from tests.cluster import work
how, store, address = sys.argv[1:]
if __name__ == "__main__":
    ways = {"none": dict, "pool": lambda: {"workers": 2}}
    if how == "client":
        from distributed import Client
        ways["client"] = lambda: {"client": Client(address, timeout=30)}
    work.write(store, **ways[how]())
"""


@pytest.fixture(scope="module")
def want():
    return work.truth()


@pytest.fixture(scope="module")
def whole(want, tmp_path_factory):
    """The files of a store that nobody interrupted."""
    store = tmp_path_factory.mktemp("whole") / "a.zarr"
    work.write(store)
    work.check(store, want, np.zeros(work.COUNT, bool))
    return work.files(store)


@contextlib.contextmanager
def cluster_of(workers, threads=1):
    with (
        distributed.LocalCluster(
            n_workers=workers, threads_per_worker=threads, dashboard_address=":0"
        ) as made,
        distributed.Client(made) as client,
    ):
        yield client


@pytest.fixture(scope="module")
def local():
    with cluster_of(2) as client:
        yield client


#: Groups of processes that were ended.
KILLED: set[int] = set()


def killed_group(process):
    KILLED.add(process.pid)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(30)


def workers_of(client):
    """The processes of two workers that answer; none if they do not come back."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        with contextlib.suppress(OSError):  # the scheduler has not yet seen that one is dead
            found = list(client.run(os.getpid).values())
            if len(found) == 2:
                return found
        time.sleep(0.2)
    return []


def duration(call):
    start = time.monotonic()
    call()
    return time.monotonic() - start


def test_two_workers_one_a_pool_and_none_write_the_same_bytes(want, whole, local, tmp_path):
    work.write(tmp_path / "two.zarr", client=local)
    with cluster_of(1, threads=2) as client:
        work.write(tmp_path / "one.zarr", client=client)
    work.write(tmp_path / "workers.zarr", workers=2)
    with cc.Pool(workers=1) as pool:
        work.write(tmp_path / "pool.zarr", pool=pool)
    for name in ("two", "one", "workers", "pool"):
        assert work.files(tmp_path / f"{name}.zarr") == whole, name


def test_each_worker_gets_the_scene_once(local, tmp_path):
    """The bytes of the scene travel once to a worker, and are read once."""

    def loaded():
        from cubecam.cluster import worker

        return list(worker._desk._scenes)

    work.write(tmp_path / "a.zarr", client=local)
    tokens = local.run(loaded)
    assert len(tokens) == 2
    assert len({token for found in tokens.values() for token in found[-1:]}) == 1


def test_a_large_scene(local, tmp_path):
    """Dask warns of large graphs, of which the scene is a part; that is no concern of the caller."""
    from cubecam import cluster

    noise = np.random.default_rng(0).random((6, 1024, 1024, 3), np.float32)
    scene = cc.Scene(background=cc.CubeMap(noise))
    batch = cluster.capture_to_zarr(
        scene, np.eye(3), tmp_path / "a.zarr", 8, chunk=1, client=local, progress=False
    )
    with cc.Renderer() as renderer:
        want = renderer.capture_many(scene, np.eye(3), 8)
    assert batch[:].faces.tobytes() == want.faces.tobytes()


def test_what_a_worker_raises_is_raised(local, tmp_path, monkeypatch):
    """A full disk, or here a store that another call has replaced, is no lost cluster."""
    from cubecam.batches.store import group_of
    from cubecam.cluster import stores

    monkeypatch.setattr(stores, "_mark", lambda plan: {"scene_hash": "another"})
    monkeypatch.setattr(stores, "_same", lambda place, plan: group_of(place, "r+"))
    with pytest.raises(ValueError, match="it was replaced in the meantime"):
        work.write(tmp_path / "a.zarr", client=local)


def test_a_client_for_coroutines_is_refused(local, tmp_path, monkeypatch):
    monkeypatch.setattr(distributed.Client, "asynchronous", True)
    with pytest.raises(ValueError, match="client: expected one with asynchronous=False"):
        work.write(tmp_path / "a.zarr", client=local)


def test_arrays_of_a_cluster(want, local):
    """Also with a resource, which here no worker has: then they wait."""
    from cubecam import cluster

    def color():
        return cluster.capture_array(
            work.scene(), work.PLACES, work.SIZE, format="rgba16f", chunk=16
        )

    assert color().compute().tobytes() == want.faces.tobytes()
    future = local.compute(color().sum(), resources={"GPU": 1})
    with pytest.raises(distributed.TimeoutError):
        future.result(timeout=2)  # no worker has the resource
    future.cancel()


def test_kill_a_worker(want, whole, tmp_path):
    """The nanny starts another one, and the call goes on by itself."""
    rng = random.Random(1)
    killed = 0
    with contextlib.ExitStack() as stack:
        client = stack.enter_context(cluster_of(2))
        for name in ("first", "second"):  # which finds compiled programs
            took = duration(lambda name=name: work.write(tmp_path / f"{name}.zarr", client=client))
        for number in range(TRIES):
            store = tmp_path / f"{number}.zarr"
            pids = workers_of(client)
            if not pids:  # a nanny gives up a worker that was killed as it began
                stack.close()
                client = stack.enter_context(cluster_of(2))
                pids = workers_of(client)
            victim, seen = rng.choice(pids), list[np.ndarray]()

            def kill(pid=victim, store=store, seen=seen):
                seen.append(work.finished(store))
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)

            timer = threading.Timer(rng.uniform(0, took), kill)
            timer.start()
            work.write(store, client=client)
            timer.join(30)
            work.check(store, want, seen[0])
            assert work.files(store) == whole, number
            killed += not seen[0].all()
    print(f"{killed} of {TRIES} kills of a worker before the end")
    assert killed >= TRIES / 3


def serving(tmp_path):
    """Start a scheduler and two workers, each a process of its own."""
    address = tmp_path / "scheduler.json"
    scheduler = work.started(
        *("-m", "distributed.cli.dask_scheduler", "--port", "0", "--host", "127.0.0.1"),
        *("--no-dashboard", "--scheduler-file", str(address)),
    )
    worker = ("-m", "distributed.cli.dask_worker", "--scheduler-file", str(address))
    workers = [
        work.started(*worker, "--nthreads", "1", "--no-dashboard", "--death-timeout", "30")
        for _ in range(2)
    ]
    return address, scheduler, workers


def test_kill_the_scheduler(want, whole, tmp_path):
    """The call ends with an error that says so, and the next call goes on, here without a cluster."""
    rng = random.Random(2)
    killed = 0
    took = 2.0
    for number in range(TRIES):
        folder = tmp_path / str(number)
        folder.mkdir()
        store = folder / "a.zarr"
        address, scheduler, workers = serving(folder)
        try:
            with distributed.Client(scheduler_file=str(address), timeout=30) as client:
                client.wait_for_workers(2, timeout=60)
                # Programs are compiled, so that the kill falls into the captures.
                client.run(work.truth)
                if number == 0:
                    start = time.monotonic()
                    work.write(folder / "first.zarr", client=client)
                    took = time.monotonic() - start
                seen: list[np.ndarray] = []

                def kill(scheduler=scheduler, store=store, seen=seen):
                    seen.append(work.finished(store))
                    killed_group(scheduler)

                timer = threading.Timer(rng.uniform(0, took), kill)
                timer.start()
                lost = ""
                try:
                    work.write(store, client=client)
                except cc.Error as error:
                    lost = str(error)
                assert not lost or "the cluster was lost" in lost
                killed += bool(lost)
                timer.join(30)
        finally:
            for process in (scheduler, *workers):
                killed_group(process)
        work.check(store, want, seen[0])
        work.write(store)
        assert work.files(store) == whole, number
    print(f"{killed} of {TRIES} kills of the scheduler before the end")
    assert killed >= TRIES / 3


def test_kill_the_writer(want, whole, local, tmp_path):
    """The process that makes the call: alone, with a pool, with a cluster; the next call goes on in another way."""
    rng = random.Random(3)
    address = local.scheduler_info()["address"]
    script = tmp_path / "writer.py"
    script.write_text(WRITER)
    ways = ("none", "pool", "client")
    took = {
        how: duration(
            lambda how=how: work.started(
                str(script), how, str(tmp_path / f"{how}.zarr"), address
            ).wait(120)
        )
        for how in ways
    }
    killed = 0
    for number in range(TRIES):
        how = ways[number % 3]
        store = tmp_path / f"{number}.zarr"
        process = work.started(str(script), how, str(store), address)
        time.sleep(rng.uniform(0.2, 1) * took[how])
        before = work.finished(store)
        ended = process.poll() is not None
        killed_group(process)
        drawn = work.check(store, want, before)
        killed += not ended
        again: dict = {"none": {"client": local}, "pool": {}, "client": {"workers": 2}}[how]
        work.write(store, **again)
        work.check(store, want, drawn)
        assert work.files(store) == whole, number
    print(f"{killed} of {TRIES} kills of the writer before the end")
    assert killed >= TRIES / 3


def test_the_command_with_a_scheduler(want, whole, local, tmp_path):
    """`cubecam capture-many --scheduler` and `--workers` write these bytes, too."""
    script = tmp_path / "scene.py"
    script.write_text(
        "from tests.cluster import work\nscene, positions = work.scene(), work.PLACES\n"
    )
    address = local.scheduler_info()["address"]
    for name, way in {"a": ("--scheduler", address), "b": ("--workers", "2")}.items():
        store = tmp_path / f"{name}.zarr"
        done = work.started(
            *("-m", "cubecam", "capture-many", str(script), "-o", str(store)),
            *("--size", str(work.SIZE), "--chunk", str(work.CHUNK), "--format", "rgba16f"),
            *("--outputs", "distance,id", *way),
        )
        assert done.wait(120) == 0
        assert work.files(store) == whole


def test_nothing_is_left_behind():
    """No writer, and no worker of its pool, outlives these tests."""
    running = subprocess.run(["ps", "-eo", "pgid,args"], capture_output=True, text=True, check=True)
    groups = {int(line.split()[0]) for line in running.stdout.splitlines()[1:]}
    assert groups.isdisjoint(KILLED)
