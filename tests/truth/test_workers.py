"""The processes that draw: how they begin, what their failures leave behind, and in which programs they work."""

import signal
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from cubecam._progress import bar
from cubecam.truth import drawing, sums, work, workers
from tests.helpers import open_files, run_python

RED = cc.Scene(background=(1, 0, 0))


def rendered(**options):
    return cc.truth.render(RED, cc.PerspectiveCamera(), (8, 8), **{"samples": 4, **options})


def pipes_and_children():
    """The pipes that this process holds, and the processes that it started."""
    task = f"/proc/self/task/{threading.get_native_id()}/children"
    return open_files("pipe:", "socket:"), Path(task).read_text().split()


def test_processes_that_cannot_all_begin_leave_none(monkeypatch):
    """`with` does not call __exit__ for an exception in __enter__."""
    before = pipes_and_children()
    original = subprocess.Popen
    made: list[subprocess.Popen[bytes]] = []

    def start(*args, **options):
        if made:
            raise OSError("no more processes")
        made.append(original(*args, **options))
        return made[0]

    monkeypatch.setattr(subprocess, "Popen", start)
    with pytest.raises(OSError, match="no more processes"):
        rendered(processes=2)
    assert made[0].poll() == -signal.SIGKILL
    assert pipes_and_children() == before


def test_nothing_is_left_after_a_deadline_and_after_an_error(monkeypatch):
    before = pipes_and_children()
    rendered(processes=2, samples=64, deadline=1e-9)
    monkeypatch.setattr(sums.Sums, "add", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        rendered(processes=2)
    for thread in threading.enumerate():
        if thread.name.endswith("(_feed)"):
            thread.join(5)
    assert pipes_and_children() == before


def test_without_an_interpreter(monkeypatch):
    monkeypatch.setattr(sys, "executable", "")
    with pytest.raises(
        RuntimeError, match=r"expected sys.executable to name .* got ''.*processes=1"
    ):
        rendered(processes=2)
    monkeypatch.setattr(drawing, "_FEW", 0)
    assert rendered().complete  # one process then draws, whatever the size
    monkeypatch.setattr(sys, "executable", sys.orig_argv[0])
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    with pytest.raises(RuntimeError, match="in a frozen program"):
        rendered(processes=2)


def test_sys_path_may_hold_anything(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "path", [*sys.path, tmp_path, None])
    assert rendered(processes=2).complete


@pytest.mark.parametrize("stream", ["None", "Closed()", "object()"])
def test_programs_without_an_error_stream(stream):
    """As those of pythonw, of services and of some editors; standard input is closed, too."""
    code = f"""
        import io, os, sys
        import cubecam as cc
        class Closed(io.StringIO):
            def isatty(self):
                raise ValueError("I/O operation on closed file")
        os.close(0)
        kept, sys.stderr = sys.stderr, {stream}
        picture = cc.truth.render(
            cc.Scene(background=(1, 0, 0)), cc.PerspectiveCamera(), (4, 4), samples=2, processes=2
        )
        sys.stderr = kept
        print(picture.color[0, 0].tolist())
    """
    assert run_python(code).stdout.strip() == "[1.0, 0.0, 0.0, 1.0]"


def test_the_bar_without_a_terminal(monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)
    with bar("rays", 3, None) as advance:
        assert advance() is None


def test_two_pictures_at_once_in_threads():
    found = {}

    def draw(seed):
        found[seed] = rendered(seed=seed, processes=2)

    threads = [threading.Thread(target=draw, args=(seed,)) for seed in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(found[i].color, rendered(processes=1).color) for i in range(2))


def test_each_process_has_pieces_of_a_small_picture(monkeypatch):
    """A picture of 64 x 64 pixels was one piece for each pass, so that one process drew and the others waited."""
    seen: list[list[work.Piece]] = []

    def draw(_, pieces):
        seen.append(pieces)
        return iter(())

    monkeypatch.setattr(workers.Workers, "__enter__", lambda self: self)
    monkeypatch.setattr(workers.Workers, "draw", draw)
    cc.truth.render(RED, cc.PerspectiveCamera(), (64, 64), samples=64, processes=4)
    assert [len(pieces) for pieces in seen] == [8] * 4
    seen.clear()
    cc.truth.render(RED, cc.PerspectiveCamera(), (1, 1), samples=65536, processes=1)
    assert [piece.samples for pieces in seen for piece in pieces] == [(0, 65536)]
    assert sum(b - a for a, b in (p.pixels for p in work.pieces(10, (0, 16), 32))) == 10
