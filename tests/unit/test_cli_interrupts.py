"""Ctrl-C in the command `cubecam`: exit status 130, one empty line, no traceback and no unfinished file."""

import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import DEVICE

#: Runs the command; the `stop_at`-th look of the library for signals finds a SIGINT.
COMMAND = """
import os, signal, sys
import cubecam as cc
from cubecam.cli import main

stop_at, looks = int(sys.argv.pop(1)), 0

def look():
    global looks
    looks += 1
    if looks == stop_at:
        os.kill(os.getpid(), signal.SIGINT)

cc._core._interrupt_pause(0)
cc._core._at_interrupt_check(look)
try:
    main()
finally:
    if not 0 < stop_at <= looks:
        print("looks", looks, file=sys.stderr)
"""

#: A small picture of light; the command's own photograph takes seconds.
SKY = ("-e", "sky.hdr")

COMMANDS = {
    "render": ("render", "ball.obj", "-o", "out/ball.png", "--size", "300x200", "--no-preview", *SKY),
    "film": (
        *("render", "ball.obj", "-o", "out/ball.gif", "--size", "64", "--no-preview"),
        *("--seconds", ".4", "--fps", "10", *SKY),
    ),
    "bake a photograph": ("bake", "sky.hdr", "--for", "babylon", "-o", "out", "-s", "32", "--no-preview"),
    "bake a scene": ("bake", "ball.obj", "--for", "three", "-o", "out", "-s", "64", "--no-preview"),
    "capture": ("capture", "ball.obj", "-o", "out/ball.exr", "--size", "64"),
    "convert": ("convert", "sky.hdr", "-o", "out/cross.exr", "--layout", "cross"),
}  # fmt: skip


def run(arguments, stop_at, folder):
    device = () if arguments[0] == "convert" else ("--device", DEVICE)
    return subprocess.run(
        [sys.executable, "-c", COMMAND, str(stop_at), *arguments, *device],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def files(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def folder(tmp_path):
    mesh = cc.Mesh.sphere(1, 24, 12)
    with (tmp_path / "ball.obj").open("w") as file:
        file.writelines("v {} {} {}\n".format(*place) for place in mesh.positions)
        file.writelines("f {} {} {}\n".format(*corners) for corners in mesh.indices + 1)
    cc.save_image(tmp_path / "sky.hdr", np.random.default_rng(1).random((64, 128, 3), "f4"))
    (tmp_path / "out").mkdir()
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
def test_ctrl_c_ends_a_command_without_a_traceback_and_half_files(command, folder):
    arguments = COMMANDS[command]
    whole = run(arguments, 0, folder)
    assert whole.returncode == 0, whole.stderr
    looks = int(whole.stderr.split()[-1])
    assert looks > 3
    want = files(folder / "out")
    assert want
    for share in (0.1, 0.5, 0.8):
        for name in want:
            (folder / "out" / name).write_bytes(b"old")
        done = run(arguments, max(1, int(share * looks)), folder)
        # While the command waits it looks as well, so that a run may have fewer looks than a slower one before. Such a
        # run has ended before its signal came; its own number is the better one.
        for _ in range(8):
            if not done.stderr.startswith("looks"):
                break
            looks = int(done.stderr.split()[-1])
            for name in want:
                (folder / "out" / name).write_bytes(b"old")
            done = run(arguments, max(1, int(share * looks)), folder)
        assert done.returncode == 130, (share, looks, done.stderr)
        assert done.stderr == "\n"
        got = files(folder / "out")
        assert set(got) <= set(want)
        assert all(data in (b"old", want[name]) for name, data in got.items())
        assert b"old" in got.values()


#: A large read of OpenImageIO, which looks for no signals: it waits here until the test lets it go on.
OUTSIDE = """
import os, signal, sys, threading
import cubecam as cc
from cubecam.io import oiio

begun, go_on, ended = threading.Event(), threading.Event(), threading.Event()
read = oiio._read

@oiio.calls_outside
def slow(*arguments):
    begun.set()
    go_on.wait()
    ended.set()
    return read(*arguments)

oiio._read, oiio._LARGE = slow, 1

def press():
    begun.wait()
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press, daemon=True).start()
"""


def test_ctrl_c_ends_the_wait_for_a_large_picture(tmp_path):
    """The read goes on in its thread; the interpreter ends after it, and other reads work meanwhile."""
    cc.save_image(tmp_path / "sky.png", np.zeros((8, 8, 3), "u1"))
    code = OUTSIDE + (
        "try:\n"
        "    cc.load_image(sys.argv[1])\n"
        "except KeyboardInterrupt:\n"
        "    assert not ended.is_set()\n"
        "else:\n"
        "    raise AssertionError('expected KeyboardInterrupt')\n"
        "assert cc.io.outside.calls_run()\n"
        "go_on.set()\n"
        "assert cc.load_image(sys.argv[1]).shape == (8, 8, 3)\n"
        "print('sound')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, tmp_path / "sky.png"],
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (0, "sound\n", "")


def test_ctrl_c_ends_a_command_that_reads_a_large_picture(folder):
    """The process does not wait for the read, which never ends here."""
    cc.save_image(folder / "sky.png", np.zeros((8, 16, 3), "u1"))
    code = OUTSIDE + "from cubecam.cli import main\nmain()\n"
    done = subprocess.run(
        [sys.executable, "-c", code, "convert", "sky.png", "-o", "out/cross.png"],
        cwd=folder, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "\n")
    assert files(folder / "out") == {}
