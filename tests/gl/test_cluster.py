"""cubecam.cluster without a cluster: bytes, what a store goes on with and what it refuses, arrays of Dask.

tests/cluster has clusters, and kills.
"""

import contextlib
import json
import os
import pickle
import sys
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam import cluster
from cubecam.cluster import stores, worker
from cubecam.cluster.plan import plan_of
from tests.helpers import DEVICE

zarr = pytest.importorskip("zarr", minversion="3.1.6")  # Python 3.10 has only zarr 2

PLACES = np.random.default_rng(0).uniform(-3, 3, (11, 3))
TURNS = np.random.default_rng(1).normal(size=(11, 4))
HOW = {"outputs": ("distance", "id"), "format": "rgba16f", "chunk": 4}


@pytest.fixture(autouse=True)
def _device(monkeypatch):
    """Workers draw where the other tests do."""
    if DEVICE is not None:
        monkeypatch.setenv("CUBECAM_DEVICE", str(DEVICE))


def make_scene(color="tomato"):
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    scene.add(cc.Mesh.sphere(1, 12, 6), cc.PhongMaterial(color=color))
    scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(), position=(1, 1, 1), name="box")
    scene.add(cc.PointLight((2, 3, 4)))
    return scene


@pytest.fixture(scope="module")
def scene():
    return make_scene()


@pytest.fixture(scope="module")
def want(scene):
    with cc.Renderer(device=DEVICE) as renderer:
        return renderer.capture_many(scene, PLACES, 8, outputs=("distance", "id"), format="rgba16f")


def write(scene, place, **more):
    return cluster.capture_to_zarr(scene, PLACES, place, 8, **{**HOW, **more})


def files_of(folder):
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def assert_same(batch, want):
    whole = batch[:]
    assert whole.faces.tobytes() == want.faces.tobytes()
    assert list(whole.outputs) == list(want.outputs)
    for name in want.outputs:
        assert whole.outputs[name].tobytes() == want.outputs[name].tobytes()
    np.testing.assert_array_equal(batch.positions, PLACES)


@pytest.fixture(scope="module")
def whole(scene, tmp_path_factory):
    """A store that was written at once."""
    place = tmp_path_factory.mktemp("whole") / "a.zarr"
    write(scene, place)
    return place


def test_the_store_holds_the_bytes_of_a_renderer(scene, want, whole):
    batch = cc.open_batch(whole)
    assert_same(batch, want)
    assert batch.scene_hash == cc.scene_hash(scene)
    assert batch.drawn is None
    attributes = json.loads((whole / "zarr.json").read_text())["attributes"]
    assert attributes["complete"] is True
    assert attributes["request"]["size"] == 8
    # A place is read without the others of its file.
    assert batch.faces.chunks[0] == 1
    assert batch.faces.shards[0] == 4


@pytest.mark.parametrize("way", ["pool", "workers"])
def test_a_pool_writes_the_same_files(way, scene, whole, tmp_path):
    with contextlib.ExitStack() as stack:
        how: dict[str, Any] = {"workers": 1}
        if way == "pool":
            how = {"pool": stack.enter_context(cc.Pool(workers=1, device=DEVICE))}
        write(scene, tmp_path / "a.zarr", **how)
    assert files_of(tmp_path / "a.zarr") == files_of(whole)


def test_nodes_that_can_be_read_once_are_left_out_by_a_pool_too(tmp_path, scene):
    box = next(node for node in scene.nodes if node.name == "box")
    made = [
        write(scene, tmp_path / f"{number}.zarr", exclude=iter([box]), workers=workers)
        for number, workers in enumerate((None, 1))
    ]
    assert not (made[0].outputs["id"][...] == box.id).any()
    np.testing.assert_array_equal(made[0].outputs["id"][...], made[1].outputs["id"][...])


def test_rotations_excluded_nodes_and_a_store_in_memory(scene, renderer):
    (box,) = scene.find("box")
    store = zarr.storage.MemoryStore()
    more: dict[str, Any] = {
        "rotations": TURNS,
        "exclude": [box],
        "near": 0.1,
        "samples": 4,
        "eye": (0, 1, 0),
    }
    for _ in range(2):
        batch = cluster.capture_to_zarr(scene, PLACES, store, 8, chunk=5, **more)
        want = renderer.capture_many(scene, PLACES, 8, **more)
        assert_same(batch, want)
        np.testing.assert_array_equal(batch.rotations, TURNS)
    with pytest.raises(ValueError, match=r"exclude there \[2\], here \[\]"):
        cluster.capture_to_zarr(scene, PLACES, store, 8, chunk=5, **{**more, "exclude": []})


def test_no_places(scene, tmp_path):
    batch = cluster.capture_to_zarr(scene, np.zeros((0, 3)), tmp_path / "a.zarr", 8, outputs=["id"])
    assert batch[:].faces.shape == (0, 6, 8, 8, 4)
    assert batch.id.shape == (0, 6, 8, 8)


#: Arrays that are written when a store is made: x, y, z, face, channel.
COORDINATES = 5


class Ended(BaseException):
    """The end of a process, as if by a kill."""


def ended_at(monkeypatch, number):
    """Let the process end at the n-th write of an array: in each chunk color, distance, id and drawn are written."""
    counted = iter(range(number))
    write = zarr.Array.__setitem__

    def broken(self, *arguments):
        if next(counted, None) is None:
            raise Ended
        write(self, *arguments)

    monkeypatch.setattr(zarr.Array, "__setitem__", broken)


@pytest.mark.parametrize("at", range(12))
def test_whatever_was_written_the_next_call_goes_on(at, scene, want, whole, tmp_path, monkeypatch):
    """Three chunks: the process ends before each write; what the store says to be there is there."""
    place = tmp_path / "a.zarr"
    with monkeypatch.context() as patch:
        ended_at(patch, COORDINATES + at)
        with pytest.raises(Ended):
            write(scene, place)
    batch = cc.open_batch(place, incomplete=True)
    chunks = at // 4
    there = np.arange(11) < 4 * chunks
    np.testing.assert_array_equal(batch.drawn, there)
    np.testing.assert_array_equal(batch.faces[: 4 * chunks], want.faces[: 4 * chunks])
    np.testing.assert_array_equal(batch.id[: 4 * chunks], want.id[: 4 * chunks])
    drawn = []

    def counted(*given):
        drawn.append(given)
        return worker.draw(*given)

    with monkeypatch.context() as patch:
        patch.setattr(stores, "draw", counted)
        assert_same(write(scene, place), want)
    assert len(drawn) == 3 - chunks  # what is there is not drawn again
    assert files_of(place) == files_of(whole)


def test_an_unfinished_store_says_what_is_missing(scene, tmp_path, monkeypatch):
    place = tmp_path / "a.zarr"
    ended_at(monkeypatch, COORDINATES + 4)
    with pytest.raises(Ended):
        write(scene, place)
    monkeypatch.undo()
    with pytest.raises(ValueError, match="got one in which 7 of 11 places are missing; open_batch"):
        cc.open_batch(place)
    batch = cc.open_batch(place, incomplete=True)
    assert batch.drawn.tolist() == [True] * 4 + [False] * 7
    assert batch[2:6].drawn.tolist() == [True, True, False, False]
    assert (batch[5].faces == 0).all()


def test_a_process_that_ends_while_it_makes_the_store_leaves_none(scene, tmp_path, monkeypatch):
    for at in range(COORDINATES):
        with monkeypatch.context() as patch:
            ended_at(patch, at)
            with pytest.raises(Ended):
                write(scene, tmp_path / "a.zarr")
        assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["color", "drawn"])
def test_damaged_files_are_errors_or_drawn_again(name, scene, want, tmp_path):
    """A cut ledger says nothing, so its chunk is drawn again; other cut files have a wrong checksum."""
    place = tmp_path / "a.zarr"
    write(scene, place)
    change(place, lambda attributes: attributes.update(complete=False))
    (path,) = [p for p in (place / name / "c" / "1").rglob("*") if p.is_file()] or [
        place / name / "c" / "1"
    ]
    path.write_bytes(path.read_bytes()[:-3])
    if name == "drawn":
        assert cc.open_batch(place, incomplete=True).drawn.sum() == 7
        assert_same(write(scene, place), want)
    else:
        with pytest.raises(Exception, match=r"(?i)crc|checksum|shard|index|bytes"):
            cc.open_batch(place, incomplete=True)[:]


def change(place, edit):
    path = place / "zarr.json"
    tree = json.loads(path.read_text())
    edit(tree["attributes"])
    path.write_text(json.dumps(tree))


OTHERS = {
    "scene": lambda: {"scene": make_scene("blue")},
    "size": lambda: {"size": 4},
    "outputs": lambda: {"outputs": ("distance",)},
    "format": lambda: {"format": "rgba32f"},
    "near": lambda: {"near": 0.2},
    "far": lambda: {"far": 50.0},
    "samples": lambda: {"samples": 4},
    "chunk": lambda: {"chunk": 3},
    "places": lambda: {"positions": PLACES + 1},
    "rotations": lambda: {"rotations": TURNS},
    "count": lambda: {"positions": PLACES[:5]},
    "eye": lambda: {"eye": (0, 0, 1)},
    "depth_format": lambda: {"depth_format": "depth_component24"},
}


@pytest.mark.parametrize("what", OTHERS)
def test_other_captures_do_not_go_on_with_a_store(what, scene, whole):
    before = files_of(whole)
    given = {"scene": scene, "positions": PLACES, "size": 8, **HOW, **OTHERS[what]()}
    word = {"scene": "scene_hash", "rotations": "places"}.get(what, what)
    with pytest.raises(ValueError, match=rf"store of the same captures .*: .*{word} there .*here"):
        cluster.capture_to_zarr(store=whole, **given)
    assert files_of(whole) == before


def test_another_version_does_not_go_on_with_a_store(scene, tmp_path):
    """Its pictures may have other bytes."""
    place = tmp_path / "a.zarr"
    write(scene, place)
    change(place, lambda attributes: attributes.update(source="cubecam 0.0.1"))
    with pytest.raises(ValueError, match=r"source there 'cubecam 0\.0\.1', here 'cubecam"):
        write(scene, place)


def test_overwrite_and_no_resume(scene, want, tmp_path):
    place = tmp_path / "a.zarr"
    write(scene, place, near=1.0)
    with pytest.raises(FileExistsError, match="expected no store of this name, or resume=True"):
        write(scene, place, near=1.0, resume=False)
    assert_same(write(scene, place, overwrite=True), want)
    assert [path.name for path in tmp_path.iterdir()] == ["a.zarr"]


def test_what_is_no_such_store_is_left_alone(scene, tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "letter.txt").write_text("dear")
    with pytest.raises(ValueError, match="expected a Zarr 3 group that to_zarr"):
        write(scene, tmp_path / "folder")
    with pytest.raises(FileExistsError, match="expected a Zarr group"):
        write(scene, tmp_path / "folder", overwrite=True)
    cc.CubeMapBatch(np.zeros((3, 6, 2, 2, 3), np.float32)).to_zarr(tmp_path / "b.zarr")
    with pytest.raises(ValueError, match=r"expected a store that capture_to_zarr\(\) began"):
        write(scene, tmp_path / "b.zarr")
    assert (tmp_path / "folder" / "letter.txt").read_text() == "dear"


def test_a_store_that_was_replaced_is_not_written_to(scene, want, tmp_path):
    """A worker that comes late must not put its chunk into the store of another call."""
    place = tmp_path / "a.zarr"
    write(scene, place)
    job = stores._Job(str(place), ["distance", "id"], 4, "", [], {"scene_hash": "another"})
    before = files_of(place)
    with pytest.raises(ValueError, match="it was replaced in the meantime"):
        stores._write(job, 0, [want.faces[:4]])
    assert files_of(place) == before


def test_what_a_killed_process_left_is_cleared_away(scene, whole, tmp_path):
    place = tmp_path / "a.zarr"
    write(scene, place)
    change(place, lambda attributes: attributes.update(complete=False))
    (place / "color" / "c" / "0.0123.partial").write_bytes(b"half")
    write(scene, place)
    assert files_of(place).keys() == files_of(whole).keys()


@pytest.mark.parametrize(
    "options", [{"update": "once"}, {"update": 2}, {}, {"faces_per_frame": 2}, {"bounces": 2}]
)
def test_probes_give_the_bytes_of_a_new_renderer(options, tmp_path):
    scene = make_scene()
    probe = cc.Probe(size=4, position=(0, 2, 0), **options)
    scene.add(cc.Mesh.box(), cc.MirrorMaterial(), position=(0, 2, -1), environment=probe)
    with cc.Renderer(device=DEVICE) as renderer:
        want = renderer.capture_many(scene, PLACES, 8, outputs=("distance", "id"), format="rgba16f")
    assert_same(write(scene, tmp_path / "a.zarr"), want)
    scene.background = (1, 0, 0)  # another scene for the same renderer
    with cc.Renderer(device=DEVICE) as renderer:
        want = renderer.capture_many(scene, PLACES, 8, outputs=("distance", "id"), format="rgba16f")
    assert_same(write(scene, tmp_path / "b.zarr"), want)


@pytest.mark.parametrize(
    ("more", "error", "message"),
    [
        ({"workers": 0}, ValueError, "workers: expected an int of at least 1"),
        ({"chunk": 0}, ValueError, "chunk: expected an int of at least 1"),
        ({"pool": 3}, TypeError, "pool: expected a Pool or None, got 3"),
        ({"resources": {"GPU": 1}}, ValueError, "resources: expected with client="),
        ({"workers": 1, "pool": 3}, ValueError, "expected one of client=, pool= and workers="),
        ({"outputs": ("nothing",)}, ValueError, "nothing"),
        ({"outputs": 3}, TypeError, "outputs"),
        ({"exclude": 3}, TypeError, "exclude"),
        ({"near": -1.0}, ValueError, "near"),
    ],
)
def test_wrong_arguments(more, error, message, scene, tmp_path):
    with pytest.raises(error, match=message):
        write(scene, tmp_path / "a.zarr", **more)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("wrong", [None, [[1, 2]], [[1, 2, np.nan]], "here"])
def test_wrong_positions(wrong, scene, tmp_path):
    with pytest.raises((TypeError, ValueError), match="positions"):
        cluster.capture_to_zarr(scene, wrong, tmp_path / "a.zarr")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["capture_array", "capture_dataset", "capture_to_zarr"])
def test_without_the_packages_the_error_names_the_command(name, scene, tmp_path, monkeypatch):
    for package in ("zarr", "dask", "dask.array"):
        monkeypatch.setitem(sys.modules, package, None)
    more = (tmp_path / "a.zarr",) if name == "capture_to_zarr" else ()
    with pytest.raises(ImportError, match=r"pip install"):
        getattr(cluster, name)(scene, PLACES, *more)


def test_a_worker_keeps_a_few_scenes_and_one_renderer(scene, want):
    packed = [pickle.dumps(make_scene(color), 5) for color in ("red", "green", "blue")]
    plan = plan_of(
        scene, PLACES, None, (), 4,
        {"size": 8, "near": 0.05, "far": 1000.0, "outputs": ("id",), "format": "rgba16f", "samples": 1, "eye": None,
         "depth_format": "depth_component32f", "depth_order": "nearest", "max_lod_error": 0.0},
    )  # fmt: skip
    for number in range(9):
        worker.draw(packed[number % 3], f"scene {number}", plan.part(0), plan.layout)
    assert list(worker._desk._scenes) == [f"scene {number}" for number in range(5, 9)]
    # A payload that is known is not read.
    worker._desk._scenes["known"] = pickle.loads(plan.payload)
    faces, _ = worker.draw(b"", "known", plan.part(1), plan.layout)
    np.testing.assert_array_equal(faces, want.faces[4:8])


class FakeDevice:
    def __init__(self, cuda_index, uuid, problem=""):
        self.cuda_index, self.uuid, self.problem = cuda_index, uuid, problem


@pytest.mark.parametrize(
    ("variable", "want"),
    [
        ("", "auto"), ("1", 1), ("1,0", 1), ("0", 0), ("7", "auto"), ("GPU-beef", 1), ("GPU-cafe", 0), ("2", "auto"),
        ("MIG-cafe", "auto"),
    ],
)  # fmt: skip
def test_each_worker_draws_on_the_gpu_that_it_was_given(variable, want, monkeypatch):
    found = [FakeDevice(0, "cafe-1"), FakeDevice(1, "beef-1"), FakeDevice(2, "dead", "broken")]
    monkeypatch.setattr(worker, "devices", lambda: found)
    monkeypatch.delenv("CUBECAM_DEVICE", raising=False)
    monkeypatch.setenv("CUDA_VISIBLE_DEVICES", variable)
    assert worker.device_of_worker() is (want if want == "auto" else found[want])
    monkeypatch.setenv("CUBECAM_DEVICE", "software")
    assert worker.device_of_worker() == "auto"  # of which the variable is a part


class TestDask:
    """By the schedulers of this process; tests/cluster has the others."""

    @pytest.fixture(autouse=True)
    def _dask(self):
        pytest.importorskip("dask.array")
        pytest.importorskip("xarray")

    @pytest.mark.parametrize("scheduler", ["sync", "threads"])
    def test_an_array_has_the_bytes_of_a_renderer(self, scheduler, scene, want):
        for output, right in (("color", want.faces), ("distance", want.distance)):
            made = cluster.capture_array(scene, PLACES, 8, output=output, format="rgba16f", chunk=4)
            assert made.chunks[0] == (4, 4, 3)
            assert (made.shape, made.dtype) == (right.shape, right.dtype)
            got = made.compute(scheduler=scheduler)
            assert got.tobytes() == right.tobytes()
            part = made[5:7, 2].compute(scheduler=scheduler)
            np.testing.assert_array_equal(part, right[5:7, 2])

    def test_only_what_is_asked_for_is_drawn(self, scene, want, monkeypatch):
        drawn = []

        def counted(*given):
            drawn.append(given)
            return worker.draw(*given)

        monkeypatch.setattr("cubecam.cluster.arrays.draw", counted)
        data = cluster.capture_dataset(
            scene, PLACES, 8, outputs=("distance", "id"), format="rgba16f", chunk=4
        )
        assert drawn == []
        part = data.isel(probe=slice(0, 4)).compute(scheduler="sync")
        assert len(drawn) == 1  # all arrays of a chunk at once
        np.testing.assert_array_equal(part.id, want.id[:4])

    def test_a_dataset_is_that_of_the_batch(self, scene, want):
        data = cluster.capture_dataset(
            scene, PLACES, 8, outputs=("distance", "id"), format="rgba16f", chunk=4
        )
        assert data.compute(scheduler="sync").identical(want.to_xarray(scene=scene))

    def test_the_scene_of_the_moment_of_the_call_is_drawn(self, want):
        scene = make_scene()
        made = cluster.capture_array(scene, PLACES, 8, format="rgba16f", chunk=4)
        scene.background = (1, 0, 0)
        assert made.compute(scheduler="sync").tobytes() == want.faces.tobytes()

    def test_no_places(self, scene):
        made = cluster.capture_array(scene, np.zeros((0, 3)), 8, output="normal")
        assert made.compute(scheduler="sync").shape == (0, 6, 8, 8, 3)

    def test_a_wrong_output_is_an_error_at_the_call(self, scene):
        with pytest.raises(ValueError, match="nothing"):
            cluster.capture_array(scene, PLACES, 8, output="nothing")


def test_a_client_must_be_one(scene, tmp_path):
    pytest.importorskip("distributed")
    with pytest.raises(TypeError, match="client: expected a Client of distributed or None, got 3"):
        write(scene, tmp_path / "a.zarr", client=3)


def test_a_renderer_is_forgotten_in_a_fork():
    before = worker._desk._lock
    pid = os.fork()
    if pid == 0:
        os._exit(0 if worker._desk._renderer is None and worker._desk._lock is not before else 1)
    assert os.waitpid(pid, 0)[1] == 0


def test_each_file_of_a_chunk_is_written_once_and_the_ledger_last(scene, tmp_path, monkeypatch):
    """One write of zarr is one file, which gets its name when it is whole: docs/adr/0037 builds upon that."""
    written = []
    put = zarr.storage.LocalStore.set

    async def recorded(self, key, value):
        written.append(key)
        await put(self, key, value)

    monkeypatch.setattr(zarr.storage.LocalStore, "set", recorded)
    write(scene, tmp_path / "a.zarr")
    chunks = [key for key in written if key.split("/")[0] in ("color", "distance", "id", "drawn")]
    chunks = [key for key in chunks if "/c/" in key]
    want = [
        f"{name}/c/{number}" + "/0" * axes
        for number in range(3)
        for name, axes in (("color", 4), ("distance", 3), ("id", 3), ("drawn", 0))
    ]
    assert chunks == want
    assert written[-1] == "zarr.json"  # the attribute "complete"


def test_zarr_gives_a_file_its_name_when_it_is_whole(tmp_path, monkeypatch):
    """A process that ends while it writes leaves the file that was there, and one with another name."""
    array = zarr.create_array(tmp_path / "a.zarr", shape=(4,), chunks=(4,), dtype="i4")
    array[:] = 1
    replace = type(tmp_path).replace

    def broken(self, target):
        if self.suffix == ".partial":
            raise Ended
        return replace(self, target)

    monkeypatch.setattr(type(tmp_path), "replace", broken)
    with pytest.raises(Ended):
        array[:] = 2
    monkeypatch.undo()
    assert (zarr.open_array(tmp_path / "a.zarr", mode="r")[:] == 1).all()
