"""to_zarr and open_batch: what comes back, what other programs read, and what is never seen."""

import json
import os
import pickle
import shutil
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import DEVICE

zarr = pytest.importorskip("zarr", minversion="3.1.6")  # Python 3.10 has only zarr 2

OUTPUTS = ("distance", "z", "normal", "position", "id", "label")
MARK = "uniform vec3 tone; out vec2 heat; vec3 shade(Surface s) { heat = s.uv; return tone; }"


@pytest.fixture(scope="module")
def scene():
    made = cc.Scene(background=(0.1, 0.2, 0.3, 0.5))
    made.add(cc.Mesh.sphere(1, 12, 6), cc.PhongMaterial(color="tomato"), label=3)
    made.add(
        cc.Mesh.box(1), cc.ShaderMaterial(MARK, uniforms={"tone": (1, 0, 1)}), position=(2, 1, 0)
    )
    made.add(cc.PointLight((2, 3, 4)))
    return made


@pytest.fixture(scope="module")
def renderer():
    with cc.Renderer(device=DEVICE) as made:
        yield made


def places(count, width=3):
    return np.random.default_rng(count).normal(size=(count, width)) * 2


def assert_equal(got, want):
    """Compare bytes, types, shapes, names and their order, places and encoding."""
    assert type(got) is type(want)
    color = "faces" if isinstance(want, cc.CubeMapBatch) else "color"
    assert list(got.outputs) == list(want.outputs)
    pairs = [(got.outputs[name], want.outputs[name]) for name in want.outputs]
    for one, other in [(getattr(got, color), getattr(want, color)), *pairs]:
        assert (one is None) == (other is None)
        if other is not None:
            read = np.asarray(one)
            assert (read.dtype, read.shape) == (other.dtype, other.shape)
            assert read.tobytes() == other.tobytes()
    assert (len(got), got.size, got.encoding) == (len(want), want.size, want.encoding)
    for name in ("positions", "rotations") if color == "faces" else ():
        one, other = getattr(got, name), getattr(want, name)
        assert (one is None) == (other is None)
        if other is not None:
            assert one.dtype == other.dtype
            np.testing.assert_array_equal(one, other)
    if color == "color":
        assert got.format == want.format


@pytest.mark.parametrize(
    ("form", "count"), [("rgba32f", 5), ("rgba16f", 1), ("rgba8", 0), ("rgb565", 4)]
)
def test_captures_come_back(form, count, scene, renderer, tmp_path):
    batch = renderer.capture_many(
        scene,
        places(count),
        6,
        outputs=(*OUTPUTS, "heat"),
        rotations=places(count, 4),
        format=form,
    )
    batch.to_zarr(tmp_path / "a.zarr", scene=scene, chunk=2)
    again = cc.open_batch(tmp_path / "a.zarr")
    assert_equal(again, batch)
    assert_equal(again[:], batch)
    assert again.scene_hash == again[:].scene_hash == cc.scene_hash(scene)
    assert again.drawn is None
    assert not isinstance(again.faces, np.ndarray)  # nothing was read yet
    assert isinstance(again[:].faces, np.ndarray)


@pytest.mark.parametrize("depth_format", ["depth_component32f", "depth24_stencil8"])
def test_depths_and_stencils_come_back(depth_format, scene, renderer, tmp_path):
    outputs = ("depth", "stencil") if "stencil" in depth_format else ("depth",)
    batch = renderer.capture_many(scene, places(2), 4, outputs=outputs, depth_format=depth_format)
    batch.to_zarr(tmp_path / "a.zarr")
    assert_equal(cc.open_batch(tmp_path / "a.zarr"), batch)
    assert cc.open_batch(tmp_path / "a.zarr").scene_hash is None


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("encoding", ["linear", "srgb"])
def test_batches_of_arrays_come_back(channels, encoding, tmp_path):
    rng = np.random.default_rng(channels)
    faces = rng.integers(0, 256, (3, 6, 2, 2, channels), dtype=np.uint8)
    batch = cc.CubeMapBatch(faces, encoding=encoding)
    batch.to_zarr(tmp_path / "a.zarr")
    assert_equal(cc.open_batch(tmp_path / "a.zarr"), batch)
    # Infinities, NaN and -0 keep their bits.
    odd = np.array([np.nan, np.inf, -np.inf, -0.0], np.float32)
    batch = cc.CubeMapBatch(
        np.resize(odd, (3, 6, 2, 2, channels)), outputs={"own": odd_output(odd)}
    )
    batch.to_zarr(str(tmp_path / "b.zarr"))
    assert_equal(cc.open_batch(str(tmp_path / "b.zarr")), batch)


def odd_output(odd):
    return np.resize(odd, (3, 6, 2, 2, 5))


@pytest.mark.parametrize("form", ["rgba8", "rgba16f", None])
def test_frames_come_back(form, scene, renderer, tmp_path):
    cameras = [cc.PerspectiveCamera(position=(0, 0, z)) for z in (3, 4, 5)]
    batch = renderer.render_many(
        scene, cameras, (9, 7), format=form, outputs=("normal", "id", "heat")
    )
    batch.to_zarr(tmp_path / "a.zarr", scene=scene, chunk=2)
    again = cc.open_batch(tmp_path / "a.zarr")
    assert_equal(again, batch)
    assert again.scene_hash == cc.scene_hash(scene)
    if form is not None:
        np.testing.assert_array_equal(again.color[1], batch.color[1])
        np.testing.assert_array_equal(again, batch)


def test_parts_of_an_opened_batch(scene, renderer, tmp_path):
    batch = renderer.capture_many(scene, places(7), 4, outputs=["distance"], rotations=places(7, 4))
    batch.to_zarr(tmp_path / "a.zarr", chunk=3)
    again = cc.open_batch(tmp_path / "a.zarr")
    assert len(again) == 7
    for number in (0, 3, 6, -1, -7):
        cube, want = again[number], batch[number]
        assert isinstance(cube, cc.CubeMap)
        assert cube.faces.tobytes() == want.faces.tobytes()
        assert cube.distance.tobytes() == want.distance.tobytes()
    for number in (7, -8):
        with pytest.raises(IndexError, match="expected -7 to 6, got"):
            again[number]
    mask = np.arange(7) % 3 == 0
    for part in (
        slice(2, 5), slice(None, None, 2), slice(None, None, -1), slice(5, 1, -2), slice(4, 4), [3, -1, 3], mask,
    ):  # fmt: skip
        assert_equal(again[part], batch[part])
    assert [cube.faces.tobytes() for cube in again] == [cube.faces.tobytes() for cube in batch]
    np.testing.assert_array_equal(again, batch.faces)


def test_an_opened_batch_is_pickled_as_a_name(scene, renderer, tmp_path):
    """So that it goes to the workers of a loader, and each reads for itself."""
    batch = renderer.capture_many(scene, places(8), 32, outputs=["distance"])
    batch.to_zarr(tmp_path / "a.zarr")
    packed = pickle.dumps(cc.open_batch(tmp_path / "a.zarr"))
    assert len(packed) < batch.faces.nbytes / 20
    assert_equal(pickle.loads(packed), batch)


def test_an_opened_batch_is_written_again(scene, renderer, tmp_path):
    batch = renderer.capture_many(scene, places(5), 4, outputs=["normal"])
    batch.to_zarr(tmp_path / "a.zarr", scene=scene, chunk=2)
    cc.open_batch(tmp_path / "a.zarr").to_zarr(tmp_path / "b.zarr", chunk=3)
    again = cc.open_batch(tmp_path / "b.zarr")
    assert_equal(again, batch)
    assert again.scene_hash == cc.scene_hash(scene)
    assert again.faces.shards[0] == 3


def test_xarray_reads_a_store(scene, renderer, tmp_path):
    """Axes, coordinates and attributes are those of to_xarray, and there is no warning."""
    xarray = pytest.importorskip("xarray")
    batch = renderer.capture_many(
        scene, places(5), 4, outputs=["normal", "id"], rotations=places(5, 4)
    )
    batch.to_zarr(tmp_path / "a.zarr", scene=scene)
    data, want = xarray.open_zarr(tmp_path / "a.zarr", chunks=None), batch.to_xarray(scene=scene)
    assert dict(data.sizes) == dict(want.sizes)
    for name in (*want.data_vars, *want.coords):
        assert data[name].dims == want[name].dims
        np.testing.assert_array_equal(data[name], want[name])
        assert data[name].attrs == want[name].attrs
    assert set(data.coords) == set(want.coords)
    assert data.color.dtype == batch.dtype
    assert {name: data.attrs[name] for name in want.attrs} == want.attrs
    assert data.attrs["complete"] is True
    assert want.attrs["scene_hash"] == cc.scene_hash(scene)
    assert want.attrs["convention"] == "gl"
    assert want.attrs["encoding"] == batch.encoding
    assert want.attrs["source"] == f"cubecam {cc.__version__}"
    np.testing.assert_array_equal(
        data.color.sel(face="-y", channel="g")[2], batch.faces[2, 3, :, :, 1]
    )
    assert data.normal.sel(axis="z").dims == ("probe", "face", "row", "column")
    read = cc.open_batch(tmp_path / "a.zarr").to_xarray()
    assert read.identical(want)


def test_frames_in_xarray(scene, renderer, tmp_path):
    xarray = pytest.importorskip("xarray")
    batch = renderer.render_many(scene, [cc.PerspectiveCamera()] * 2, (5, 4), outputs=["distance"])
    batch.to_zarr(tmp_path / "a.zarr")
    data = xarray.open_zarr(tmp_path / "a.zarr", chunks=None)
    assert data.color.dims == ("frame", "row", "column", "channel")
    assert data.distance.attrs["units"] == "world units"
    assert data.attrs["format"] == "rgba8"
    assert cc.open_batch(tmp_path / "a.zarr").to_xarray().identical(batch.to_xarray())


def test_units_and_names_of_places(scene, renderer):
    """The output z has the name that the place's z would have: then all three have another one."""
    pytest.importorskip("xarray")
    plain = renderer.capture_many(scene, places(2), 4, outputs=["distance", "id"]).to_xarray()
    assert (plain.x.attrs["units"], plain.distance.attrs["units"]) == ("world units",) * 2
    assert plain.id.attrs["units"] == "1"
    batch = renderer.capture_many(scene, places(2), 4, outputs=["z"])
    data = batch.to_xarray()
    np.testing.assert_array_equal(data.z, batch.z)
    np.testing.assert_array_equal(data.place_z, batch.positions[:, 2])
    assert "x" not in data.coords


@pytest.mark.parametrize("name", ["face", "probe", "channel", "color", "drawn", "row"])
def test_an_output_named_like_an_axis_is_refused(name, tmp_path):
    batch = cc.CubeMapBatch(
        np.zeros((2, 6, 2, 2, 3), np.float32), outputs={name: np.zeros((2, 6, 2, 2))}
    )
    for call in (batch.to_xarray, lambda: batch.to_zarr(tmp_path / "a.zarr")):
        with pytest.raises(ValueError, match=f"outputs: expected no name of .*, got '{name}'"):
            call()
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def black():
    return cc.CubeMapBatch(np.zeros((3, 6, 2, 2, 3), np.float32))


def files_of(folder):
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_equal_batches_have_equal_bytes(scene, renderer, tmp_path):
    """Nothing says when or where the store was written."""
    batch = renderer.capture_many(scene, places(5), 4, outputs=["distance"])
    batch.faces[:2] = 0  # a file of nothing but 0 is not written
    for name in ("a", "b"):
        batch.to_zarr(tmp_path / f"{name}.zarr", scene=scene, chunk=2)
    one, other = files_of(tmp_path / "a.zarr"), files_of(tmp_path / "b.zarr")
    assert one == other
    assert_equal(cc.open_batch(tmp_path / "a.zarr"), batch)


def test_overwriting_must_be_wanted(black, tmp_path):
    place = tmp_path / "a.zarr"
    black.to_zarr(place)
    before = files_of(tmp_path)
    with pytest.raises(FileExistsError, match="expected no file of this name, or overwrite=True"):
        black[:2].to_zarr(place)
    assert files_of(tmp_path) == before
    black[:2].to_zarr(place, overwrite=True)
    assert len(cc.open_batch(place)) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["a.zarr"]


def test_what_is_no_store_is_never_overwritten(black, tmp_path):
    folder, file = tmp_path / "folder", tmp_path / "file.txt"
    folder.mkdir()
    (folder / "letter.txt").write_text("dear")
    file.write_text("dear")
    before = files_of(tmp_path)
    for place in (folder, file):
        with pytest.raises(FileExistsError, match="expected a Zarr group, got something else"):
            black.to_zarr(place, overwrite=True)
    assert files_of(tmp_path) == before


def test_a_folder_that_is_missing_is_not_made(black, tmp_path):
    with pytest.raises(FileNotFoundError):
        black.to_zarr(tmp_path / "none" / "a.zarr")
    assert list(tmp_path.iterdir()) == []


def test_an_error_on_the_way_leaves_nothing(black, tmp_path, monkeypatch):
    from cubecam.batches import store

    black.to_zarr(tmp_path / "a.zarr")
    before = files_of(tmp_path)

    def broken(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(store, "fill", broken)
    with pytest.raises(OSError, match="No space left"):
        black.to_zarr(tmp_path / "b.zarr")
    with pytest.raises(OSError, match="No space left"):
        black.to_zarr(tmp_path / "a.zarr", overwrite=True)
    assert files_of(tmp_path) == before


def test_a_killed_writer_leaves_no_store(tmp_path):
    """What it leaves has another name, and the next one is not disturbed by it."""
    code = f"""
import os, signal
import numpy as np, cubecam as cc
from cubecam.batches import store
store.finish = lambda group: os.kill(os.getpid(), signal.SIGKILL)
cc.CubeMapBatch(np.zeros((3, 6, 2, 2, 3), np.float32)).to_zarr({str(tmp_path / "a.zarr")!r})
"""
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run([sys.executable, "-c", code], env=env, timeout=60, capture_output=True)
    assert done.returncode == -9, done.stderr
    with pytest.raises(FileNotFoundError, match="expected a batch that to_zarr"):
        cc.open_batch(tmp_path / "a.zarr")
    cc.CubeMapBatch(np.ones((3, 6, 2, 2, 3), np.float32)).to_zarr(tmp_path / "a.zarr")
    assert cc.open_batch(tmp_path / "a.zarr")[2].faces.min() == 1
    (left,) = tmp_path.glob(".a.zarr.*.partial")
    with pytest.raises(ValueError, match="the last arrays are missing"):
        cc.open_batch(left)


def test_a_store_of_zarr_in_memory(black):
    store = zarr.storage.MemoryStore()
    black.to_zarr(store)
    assert_equal(cc.open_batch(store), black)
    with pytest.raises(FileExistsError, match="expected an empty store, or overwrite=True"):
        black.to_zarr(store)
    black[:1].to_zarr(store, overwrite=True)
    assert len(cc.open_batch(store)) == 1


def changed(place, change):
    path = place / "zarr.json"
    tree = json.loads(path.read_text())
    change(tree)
    path.write_text(json.dumps(tree))


def test_an_unfinished_store_is_opened_only_on_request(black, tmp_path):
    place = tmp_path / "a.zarr"
    black.to_zarr(place)
    changed(place, lambda tree: tree["attributes"].update(complete=False))
    with pytest.raises(ValueError, match=r"a.zarr: expected a batch that is complete, got one"):
        cc.open_batch(place)
    assert_equal(cc.open_batch(place, incomplete=True), black)


def forget_array(place):
    shutil.rmtree(place / "own")
    changed(place, lambda tree: tree["consolidated_metadata"]["metadata"].pop("own"))


FOREIGN = {
    "another group": (
        lambda place: changed(place, lambda tree: tree["attributes"].pop("cubecam_batch")),
        r"expected a Zarr 3 group that to_zarr\(\) wrote, got one without the attribute .*; its attributes: .*complete",
    ),
    "another kind": (
        lambda place: changed(place, lambda tree: tree["attributes"].update(cubecam_batch=3)),
        "without the attribute cubecam_batch",
    ),
    "a later layout": (
        lambda place: changed(place, lambda tree: tree["attributes"].update(cubecam_layout=9)),
        "expected layout 1 of stores, got 9; it was written by cubecam",
    ),
    "an array is missing": (forget_array, "expected the array 'own', got channel, color"),
    "no group": (lambda place: (place / "zarr.json").unlink(), "got something else"),
    "no JSON": (lambda place: (place / "zarr.json").write_text("{"), "that zarr cannot read"),
    "another count": (
        lambda place: changed(place, lambda tree: tree["attributes"].update(count=7)),
        "expected 7 x",
    ),
}


@pytest.mark.parametrize("case", FOREIGN)
def test_what_is_no_batch_is_an_error(case, tmp_path):
    place = tmp_path / "a.zarr"
    faces = np.zeros((3, 6, 2, 2, 3), np.float32)
    cc.CubeMapBatch(faces, outputs={"own": faces[..., 0]}).to_zarr(place)
    change, message = FOREIGN[case]
    change(place)
    with pytest.raises(ValueError, match=message):
        cc.open_batch(place)


def test_other_places_are_errors(tmp_path):
    with pytest.raises(FileNotFoundError, match="got nothing"):
        cc.open_batch(tmp_path / "none")
    (tmp_path / "file").write_text("hello")
    with pytest.raises(ValueError, match="got something else"):
        cc.open_batch(tmp_path / "file")
    with pytest.raises(TypeError, match="store: expected a path or a store of zarr, got 3"):
        cc.open_batch(3)  # type: ignore[arg-type]


@pytest.mark.parametrize("chunk", [0, -3])
def test_wrong_chunks(chunk, black, tmp_path):
    with pytest.raises(ValueError, match="chunk: expected an int of at least 1"):
        black.to_zarr(tmp_path / "a.zarr", chunk=chunk)


def test_without_zarr_the_error_names_the_command(black, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "zarr", None)
    for call in (lambda: black.to_zarr(tmp_path / "a.zarr"), lambda: cc.open_batch(tmp_path)):
        with pytest.raises(ImportError, match=r"needs zarr 3 .*: pip install 'zarr>=3"):
            call()


def test_with_zarr_2_the_error_names_the_command(black, tmp_path, monkeypatch):
    monkeypatch.setattr(zarr, "__version__", "2.18.3")
    with pytest.raises(ImportError, match=r"got zarr 2.18.3: pip install 'zarr>=3"):
        black.to_zarr(tmp_path / "a.zarr")
