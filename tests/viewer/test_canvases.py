"""Where views are shown: the choice, the shared server of pages, and a terminal in a pseudo-terminal."""

import fcntl
import importlib.util
import os
import pty
import re
import select
import signal
import struct
import sys
import termios
import time
import urllib.request

import pytest
from rendercanvas.contexts import BitmapContext
from rendercanvas.offscreen import RenderCanvas

import cubecam as cc
from cubecam.viewer import canvases
from tests.helpers import need_terminals


@pytest.mark.parametrize(
    ("environment", "terminal", "expected"),
    [
        ({}, False, "page"),
        ({"SSH_CONNECTION": "a"}, True, "terminal"),
        ({"SSH_CONNECTION": "a"}, False, "page"),
        ({"DISPLAY": ":0"}, False, "window"),
        ({"WAYLAND_DISPLAY": "wayland-0", "SSH_CONNECTION": "a"}, True, "window"),
    ],
)
def test_the_place_follows_from_the_surroundings(monkeypatch, environment, terminal, expected):
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "SSH_CONNECTION"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(canvases, "in_notebook", lambda: False)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: object())
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal)
    assert canvases.choose() == expected


def test_a_screen_without_a_toolkit_gets_a_page(monkeypatch):
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.delenv("SSH_CONNECTION", raising=False)
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert canvases.choose() == "page"


def test_views_share_a_server_that_ends_with_the_last(capsys):
    views = [
        cc.Scene(background=color).show("page", browser=False, block=False, size=(16, 16))
        for color in ("red", "green")
    ]
    addresses = capsys.readouterr().out.split()
    assert len(addresses) == 2
    assert all(re.fullmatch(r"http://127\.0\.0\.1:\d+/[\w-]{20,}/\w+/", one) for one in addresses)
    assert len({address.rsplit("/", 2)[0] for address in addresses}) == 1
    for address in addresses:
        with urllib.request.urlopen(address) as answer:
            assert answer.status == 200
    views[0].close()
    with urllib.request.urlopen(addresses[1]) as answer:
        assert answer.status == 200
    views[1].close()
    deadline = time.monotonic() + 10
    while canvases._shared is not None:
        assert time.monotonic() < deadline
        time.sleep(0.02)


class _Terminal:
    """A program in a pseudo-terminal of 80 x 24 characters, which answers where the cursor is, as terminals do."""

    def __init__(self, *command):
        need_terminals()
        self.seen = b""
        colors = {
            "TERM": "xterm-256color",
            "COLORTERM": "truecolor",
            "COLUMNS": "80",
            "LINES": "24",
        }
        self.process, self.master = pty.fork()
        if self.process == 0:
            os.execve(sys.executable, [sys.executable, *command], {**os.environ, **colors})
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))

    def read_until(self, condition, seconds=60):
        deadline = time.monotonic() + seconds
        while not condition(self.seen) and time.monotonic() < deadline:
            if select.select([self.master], [], [], 0.2)[0]:
                try:
                    more = os.read(self.master, 65536)
                except OSError:  # the program has ended
                    break
                self.seen += more
                os.write(self.master, b"\x1b[1;1R" * more.count(b"\x1b[6n"))
        return condition(self.seen)

    def end(self):
        """End the program by Ctrl-C and return its exit code."""
        os.write(self.master, b"\x03")
        deadline = time.monotonic() + 15
        done = status = 0
        while done == 0 and time.monotonic() < deadline:
            self.read_until(lambda seen: False, seconds=0.2)
            done, status = os.waitpid(self.process, os.WNOHANG)
        if done == 0:
            os.kill(self.process, signal.SIGKILL)
            os.waitpid(self.process, 0)
        os.close(self.master)
        return os.waitstatus_to_exitcode(status) if done else "it went on"


SCRIPT = "import cubecam as cc\nscene = cc.Scene(background=(1, 0, 0))\n"


@pytest.mark.slow
@pytest.mark.parametrize("how", ["show", "cubecam view"])
def test_the_terminal_shows_a_picture_in_blocks_of_colour(tmp_path, how):
    path = tmp_path / "scene.py"
    if how == "show":
        path.write_text(SCRIPT + "scene.show('terminal', size=(40, 20), tonemap=None)\n")
        terminal = _Terminal(str(path))
    else:
        path.write_text(SCRIPT + "view = cc.Viewer(scene, size=(40, 20), tonemap=None)\n")
        terminal = _Terminal("-m", "cubecam", "view", str(path), "--terminal")
    shown = terminal.read_until(lambda seen: b"255;0;0" in seen)
    code = terminal.end()
    assert shown, terminal.seen[-2000:]
    assert code == 0


def test_windows_get_pictures_that_own_their_memory(monkeypatch):
    """The window of rendercanvas reads the memory of `picture.base`, which is nothing that Qt knows."""
    given = []
    monkeypatch.setattr(BitmapContext, "set_bitmap", lambda self, bitmap: given.append(bitmap))
    with cc.Viewer(cc.Scene(background="red"), size=(16, 12)) as viewer:
        canvas = RenderCanvas(size=(16, 12))
        viewer._attach(canvas)
        for moving in (True, False):
            viewer.changed(moving)
            canvas.draw()
    assert len(given) >= 2
    assert all(picture.base is None for picture in given)
