"""What a writer leaves: the old file's mode and owner, devices as they are, and nothing when it is killed."""

import errno
import os
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from cubecam.io import writing

PICTURE = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
CUBE = cc.CubeMap(np.zeros((6, 4, 4, 3), np.uint8), encoding="srgb")


def frames(path):
    cc.save_animation(path, [PICTURE, 255 - PICTURE])


WRITERS = {
    "image": (".png", lambda path: cc.save_image(path, PICTURE)),
    "cube": (".exr", lambda path: CUBE.save(path, layout="row")),
    "animation": (".gif", frames),
}
every = pytest.mark.parametrize(("ending", "write"), WRITERS.values(), ids=WRITERS)


def names(folder):
    return sorted(item.name for item in folder.iterdir())


@pytest.fixture(params=["unnamed", "named"])
def kind_of_draft(request, monkeypatch):
    """Write as Linux does, and as a system without O_TMPFILE does."""
    if request.param == "named":
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    return request.param


@every
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o700, 0o444])
def test_the_mode_of_the_old_file_is_kept(tmp_path, ending, write, mode, kind_of_draft):
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"old")
    path.chmod(mode)
    if not os.access(path, os.W_OK):  # a file that is write-protected stays; root may write it
        with pytest.raises(PermissionError, match="protected"):
            write(path)
        assert path.read_bytes() == b"old"
        return
    write(path)
    assert stat.S_IMODE(path.stat().st_mode) == mode
    assert path.read_bytes() != b"old"
    assert names(tmp_path) == [path.name]


def test_a_new_file_has_the_mode_that_the_umask_allows(tmp_path, kind_of_draft):
    before = os.umask(0o027)
    try:
        cc.save_image(tmp_path / "a.png", PICTURE)
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "a.png").stat().st_mode) == 0o640


def test_a_write_protected_file_is_not_replaced(tmp_path, monkeypatch):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    allowed = os.access
    monkeypatch.setattr(
        "os.access", lambda name, mode: mode != os.W_OK and allowed(name, mode)
    )  # as for a user who is not root
    with pytest.raises(PermissionError, match="cannot write: the file is protected"):
        cc.save_image(path, PICTURE)
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["a.png"]


@every
def test_the_owner_of_the_old_file_is_kept(tmp_path, ending, write, kind_of_draft):
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"old")
    uid, gid = (1234, 4321) if os.geteuid() == 0 else (os.geteuid(), os.getegid())
    os.chown(path, uid, gid)  # only root gives files away
    path.chmod(0o640)
    write(path)
    state = path.stat()
    assert (state.st_uid, state.st_gid, stat.S_IMODE(state.st_mode)) == (uid, gid, 0o640)
    assert path.read_bytes() != b"old"


def refuse_owners(monkeypatch, path):
    """Let the file look as if somebody else owned it, who cannot be given new files."""
    real = os.fstat

    class Other:
        def __init__(self, state):
            self.st_uid, self.st_gid, self.st_mode = state.st_uid + 1, state.st_gid, state.st_mode
            self.st_size = state.st_size

    def refused(*_):
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr("cubecam.io.writing.os.fstat", lambda number: Other(real(number)))
    monkeypatch.setattr("cubecam.io.writing.os.fchown", refused)


@every
def test_a_file_whose_owner_cannot_be_given_is_written_into(
    tmp_path, ending, write, monkeypatch, kind_of_draft
):
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"old" * 10000)
    refuse_owners(monkeypatch, path)
    before = path.stat().st_ino
    write(path)
    monkeypatch.undo()
    assert path.stat().st_ino == before
    assert names(tmp_path) == [path.name]
    other = tmp_path / f"b{ending}"
    write(other)
    if ending != ".exr":  # its header holds the time
        assert path.read_bytes() == other.read_bytes()


def test_a_full_disk_gives_a_file_that_is_written_into_its_contents_back(tmp_path, monkeypatch):
    path = tmp_path / "a.png"
    path.write_bytes(b"old" * 10)
    refuse_owners(monkeypatch, path)
    put, calls = writing._put, []

    def full(file, data):
        calls.append(len(data))
        if len(calls) == 1:
            put(file, data[: len(data) // 2])
            raise OSError(errno.ENOSPC, "No space left on device")
        put(file, data)

    monkeypatch.setattr("cubecam.io.writing._put", full)
    with pytest.raises(OSError, match="No space"):
        cc.save_image(path, PICTURE)
    assert len(calls) == 2
    assert path.read_bytes() == b"old" * 10


@every
def test_a_fifo_gets_the_file_and_stays_a_fifo(tmp_path, ending, write):
    plain, fifo = tmp_path / f"plain{ending}", tmp_path / f"fifo{ending}"
    write(plain)
    os.mkfifo(fifo)
    got = []
    reader = threading.Thread(target=lambda: got.append(fifo.read_bytes()), daemon=True)
    reader.start()
    write(fifo)
    reader.join(30)
    assert stat.S_ISFIFO(fifo.stat().st_mode)
    assert len(got) == 1
    assert got[0][:4] == plain.read_bytes()[:4]
    assert len(got[0]) == plain.stat().st_size
    assert names(tmp_path) == [fifo.name, plain.name]


def test_a_fifo_that_nobody_reads_is_an_error_after_a_while(tmp_path, monkeypatch):
    monkeypatch.setattr("cubecam.io.writing._PATIENCE", 0.05)
    os.mkfifo(tmp_path / "a.png")
    with pytest.raises(OSError, match=r"expected a reader of this FIFO within 0\.05 s"):
        cc.save_image(tmp_path / "a.png", PICTURE)
    assert stat.S_ISFIFO((tmp_path / "a.png").stat().st_mode)


@every
def test_a_link_to_a_device_writes_to_the_device(tmp_path, ending, write):
    path = tmp_path / f"a{ending}"
    path.symlink_to("/dev/null")
    write(path)
    assert path.is_symlink()
    assert stat.S_ISCHR(path.stat().st_mode)


def test_a_device_that_is_full_is_an_os_error(tmp_path):
    path = tmp_path / "a.png"
    path.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space"):
        cc.save_image(path, PICTURE)
    assert stat.S_ISCHR(path.stat().st_mode)


def test_a_socket_is_refused(tmp_path, monkeypatch):
    import socket

    monkeypatch.chdir(tmp_path)  # the path of a socket is short
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("a.png")
        with pytest.raises(OSError, match="expected a file to write, got a socket"):
            cc.save_image("a.png", PICTURE)
        assert stat.S_ISSOCK((tmp_path / "a.png").stat().st_mode)


def test_a_link_to_a_file_stays_a_link(tmp_path, kind_of_draft):
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "real.png").write_bytes(b"old")
    (tmp_path / "a.png").symlink_to("folder/real.png")
    cc.save_image(tmp_path / "a.png", PICTURE)
    assert (tmp_path / "a.png").is_symlink()
    assert np.array_equal(cc.load_image(tmp_path / "folder" / "real.png"), PICTURE)


def test_a_link_to_no_file_makes_the_file(tmp_path, kind_of_draft):
    (tmp_path / "a.png").symlink_to("real.png")
    cc.save_image(tmp_path / "a.png", PICTURE)
    assert (tmp_path / "a.png").is_symlink()
    assert np.array_equal(cc.load_image(tmp_path / "real.png"), PICTURE)


def test_a_circle_of_links_is_an_os_error(tmp_path):
    (tmp_path / "a.png").symlink_to("b.png")
    (tmp_path / "b.png").symlink_to("a.png")
    with pytest.raises(OSError, match="cannot write"):
        cc.save_image(tmp_path / "a.png", PICTURE)


@pytest.mark.parametrize("old", [None, b"old", "fifo"])
def test_a_process_that_is_killed_while_it_writes_leaves_nothing(tmp_path, old):
    """Neither beside the file nor, for what goes to a FIFO, in the folder of temporary files."""
    path = tmp_path / "a.exr"
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    if old == "fifo":
        os.mkfifo(path)
    elif old is not None:
        path.write_bytes(old)
    code = f"""
import pathlib, time
import numpy as np, cubecam as cc
def slowly(self, data):
    with self.open("wb") as file:
        file.write(data[:100])
        file.flush()
        print("go", flush=True)
        time.sleep(60)
pathlib.Path.write_bytes = slowly
cc.CubeMap(np.zeros((6, 8, 8, 3), np.float32)).save({str(path)!r})
"""
    with subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "go\n"
        child.send_signal(signal.SIGKILL)
    left = ["temporary"] if old is None else ["a.exr", "temporary"]
    end = time.monotonic() + 60
    while names(tmp_path) != left and time.monotonic() < end:
        time.sleep(0.01)
    assert names(tmp_path) == left
    assert names(temporary) == []
    assert not isinstance(old, bytes) or path.read_bytes() == old


def test_files_that_are_open_do_not_grow_in_number(tmp_path):
    def count():
        return len(list(Path("/proc/self/fd").iterdir()))

    cc.save_image(tmp_path / "a.png", PICTURE)
    before = count()
    for _ in range(20):
        cc.save_image(tmp_path / "a.png", PICTURE)
        CUBE.save(tmp_path / "{face}.png")
    assert count() == before


def test_attributes_of_the_old_file_are_kept(tmp_path, kind_of_draft, monkeypatch):
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    given: dict[str, bytes] = {}
    monkeypatch.setattr("os.listxattr", lambda name: ["user.note"] if name == path else [])
    monkeypatch.setattr("os.getxattr", lambda name, attribute: b"mine")
    monkeypatch.setattr("os.setxattr", lambda number, *pair: given.update([pair]))
    cc.save_image(path, PICTURE)
    assert given == {"user.note": b"mine"}
