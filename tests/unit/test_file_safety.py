"""Missing, broken and unwritable files; a failed write leaves the old file or none."""

import os
from collections.abc import Callable

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import run_python
from tests.reference.pattern import face_pattern

PICTURE = np.full((16, 32, 3), 77, np.uint8)
LOADERS: dict[str, Callable[..., object]] = {
    "image": cc.load_image,
    "cubemap": cc.load_cubemap,
    "environment": cc.load_environment,
    "mesh": cc.load_mesh,
    "scene": cc.load_scene,
}
loaders = pytest.mark.parametrize("load", LOADERS.values(), ids=LOADERS)
ENDING = {cc.load_mesh: "obj", cc.load_scene: "obj"}


def kind(load):
    return cc.MeshError if load in ENDING else cc.ImageError


def named(load, folder):
    return folder / f"a.{ENDING.get(load, 'png')}"


def test_errors_form_the_tree_of_the_design():
    assert issubclass(cc.FileError, cc.Error)
    assert issubclass(cc.ImageError, cc.FileError)
    assert issubclass(cc.MeshError, cc.FileError)
    assert issubclass(cc.ContextError, cc.Error)
    assert issubclass(cc.ShaderError, cc.Error)
    assert not issubclass(cc.FileError, OSError)


@loaders
def test_missing_files_name_the_path(load, tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        load(tmp_path / "nowhere.obj")


@loaders
def test_folders_are_no_files(load, tmp_path):
    with pytest.raises(OSError, match=tmp_path.name):
        load(tmp_path)


@loaders
@pytest.mark.parametrize("device", ["FIFO", "/dev/zero", "/dev/null"])
def test_only_regular_files_are_opened(load, device, tmp_path):
    """A FIFO would be waited for, and /dev/zero be read without an end."""
    path = named(load, tmp_path)
    if device == "FIFO":
        os.mkfifo(path)
    else:
        path.symlink_to(device)
    told = "expected a regular file, got a (FIFO|character device)"
    with pytest.raises(kind(load), match=told):
        load(path)


@loaders
@pytest.mark.parametrize("content", [b"", b"not a file of any kind\n" * 40, bytes(range(256)) * 20])
def test_broken_contents_name_the_path(load, content, tmp_path):
    path = named(load, tmp_path)
    path.write_bytes(content)
    with pytest.raises(kind(load), match="a\\."):
        load(path)


@pytest.mark.parametrize("ending", ["png", "exr", "hdr"])
@pytest.mark.parametrize("part", [0.2, 0.6, 0.9])
def test_files_that_end_early_are_broken(ending, part, tmp_path, rng):
    path = tmp_path / f"a.{ending}"
    cc.save_image(path, rng.random((64, 64, 3)).astype(np.float32))
    whole = path.read_bytes()
    path.write_bytes(whole[: int(len(whole) * part)])
    with pytest.raises(cc.ImageError):
        cc.load_image(path)


@loaders
@pytest.mark.parametrize("path", [3, None, b"bytes.png", ["a"]])
def test_what_is_no_path_is_refused(load, path):
    with pytest.raises((TypeError, ValueError)):
        load(path)


def test_missing_folders_are_os_errors(tmp_path):
    target = tmp_path / "none" / "a.png"
    with pytest.raises(OSError, match="none"):
        cc.save_image(target, PICTURE)
    with pytest.raises(OSError, match="none"):
        cc.CubeMap(face_pattern(4)).save(target, layout="cross")


def writers():
    cube = cc.CubeMap(np.zeros((6, 64, 64, 3), np.float32))
    return {
        "image": lambda path: cc.save_image(path, np.zeros((64, 64, 3), np.float32)),
        "cube": lambda path: cube.save(path, layout="row"),
    }


@pytest.mark.parametrize("writer", ["image", "cube"])
def test_a_failed_rename_leaves_the_old_file_and_nothing_else(writer, tmp_path, monkeypatch):
    path = tmp_path / "a.exr"
    path.write_bytes(b"old")

    def no(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", no)
    with pytest.raises(OSError, match="No space"):
        writers()[writer](path)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.exr"]


def test_a_full_disk_leaves_the_old_file_and_nothing_else(tmp_path):
    """RLIMIT_FSIZE stands in for the disk: writing beyond it fails with EFBIG, in memory files too."""
    path = tmp_path / "a.exr"
    path.write_bytes(b"old")
    run_python(
        f"""
        import resource, signal, numpy as np, cubecam as cc
        cc.save_image({str(tmp_path / "warm.exr")!r}, np.zeros((2, 2, 3), np.float32))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
        noise = np.random.default_rng(0).random((64, 64, 3)).astype(np.float32)
        for save in (lambda: cc.save_image({str(path)!r}, noise),
                     lambda: cc.CubeMap(noise[None].repeat(6, 0)).save({str(path)!r}, layout="row")):
            try:
                save()
            except (OSError, cc.Error) as error:
                print(error)
            else:
                raise SystemExit("expected an OSError")
        """
    )
    assert path.read_bytes() == b"old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.exr", "warm.exr"]


@pytest.mark.parametrize("writer", ["image", "cube"])
def test_a_disk_that_fills_up_on_the_way_leaves_the_old_file(writer, tmp_path, monkeypatch):
    path = tmp_path / "a.exr"
    path.write_bytes(b"old")
    save = writers()[writer]

    def half(self, data):
        with self.open("wb") as file:
            file.write(data[: len(data) // 2])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", half)
    with pytest.raises(OSError, match="No space"):
        save(path)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.exr"]


def test_six_files_are_all_written_or_none(tmp_path):
    paths = [tmp_path / f"{index}.png" for index in range(5)] + [tmp_path / "none" / "5.png"]
    with pytest.raises(OSError, match="none"):
        cc.CubeMap(face_pattern(4)).save(paths)
    assert not list(tmp_path.iterdir())


def test_overwriting_replaces(tmp_path):
    path = tmp_path / "a.png"
    for value in (1, 2):
        cc.save_image(path, np.full((2, 2, 3), value, np.uint8))
    assert cc.load_image(path)[0, 0, 0] == 2
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]
