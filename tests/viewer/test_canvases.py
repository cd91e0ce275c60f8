"""Where views are shown: the choice, the shared server of pages, and a terminal in a pseudo-terminal."""

import fcntl
import importlib.util
import os
import pty
import re
import select
import struct
import subprocess
import sys
import termios
import time
import urllib.request

import pytest

import cubecam as cc
from cubecam.viewer import canvases


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


@pytest.mark.slow
def test_the_terminal_shows_a_picture_in_blocks_of_colour():
    script = (
        "import cubecam as cc\n"
        "scene = cc.Scene(background=(1, 0, 0))\n"
        "scene.show('terminal', size=(40, 20), tonemap=None)\n"
    )
    master, slave = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-c", script],
        stdin=slave,
        stdout=slave,
        stderr=slave,
        env={
            **os.environ,
            "TERM": "xterm-256color",
            "COLORTERM": "truecolor",
            "COLUMNS": "80",
            "LINES": "24",
        },
        close_fds=True,
    )
    os.close(slave)
    fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    seen = b""
    try:
        deadline = time.monotonic() + 60
        while b"255;0;0" not in seen and time.monotonic() < deadline:
            if select.select([master], [], [], 0.2)[0]:
                more = os.read(master, 65536)
                seen += more
                # Terminals answer where the cursor is; the program waits for that.
                os.write(master, b"\x1b[1;1R" * more.count(b"\x1b[6n"))
        assert b"255;0;0" in seen, seen[-2000:]
    finally:
        process.terminate()
        process.wait(10)
        os.close(master)
