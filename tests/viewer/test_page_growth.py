"""Pages leave nothing behind: measured in a process of its own, where no other test's objects come and go."""

import gc
import tracemalloc

import psutil
import pytest

from cubecam.viewer.page.server import PageServer
from tests.helpers import run_python
from tests.viewer.pages import Footprint, TinyView, frame, get, open_socket, resize, send, until

EVENTS = 25  # of each connection


def visit(url, view):
    """Open the page as a browser does, move the pointer, and leave."""
    with open_socket(url) as connection:
        resize(connection, 40, 30)
        frame(connection)
        for step in range(EVENTS):
            send(
                connection,
                type="pointer_move",
                x=step,
                y=1,
                button=0,
                buttons=[1],
                modifiers=[],
            )
        view.changed()
        frame(connection)
    assert get(url + "page.js")[0] == 200
    view.events.clear()


def allocated():
    """Bytes that Python holds, without what waits for the collector of cycles."""
    gc.collect()
    return tracemalloc.get_traced_memory()[0]


def growth(connections=200, warm=20):
    """Return the growth (bytes) of Python's memory and of the process's after the first ``warm`` connections."""
    view = TinyView()
    with PageServer() as server:
        url = server.add(view)
        view._canvas._interval = (
            0  # 30 frames a second would make each visit wait for its second frame
        )
        for _ in range(5):
            visit(url, view)
        until(lambda: Footprint(server).tasks <= 3)
        before = Footprint(server)
        tracemalloc.start()
        for _ in range(warm):
            visit(url, view)
        early, resident = allocated(), psutil.Process().memory_info().rss
        for _ in range(connections - warm):
            visit(url, view)
        until(lambda: Footprint(server) == before)
        assert server.views[0] is view
        return allocated() - early, psutil.Process().memory_info().rss - resident


@pytest.mark.slow
def test_200_connections_and_5000_events_leave_no_growth():
    """Threads, tasks, files and sockets are as before; memory stays within what one more connection takes."""
    done = run_python("from tests.viewer.test_page_growth import growth; print(*growth())")
    python, process = map(int, done.stdout.split())
    assert python < 200_000
    assert process < 8_000_000
