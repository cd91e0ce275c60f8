"""Pages of live views: pictures, events, text and panels over the websocket, and what a server leaves behind."""

import contextlib
import json
import os
import socket
import time
import tracemalloc
from urllib.parse import urlsplit

import numpy as np
import psutil
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from cubecam.viewer.page.events import LARGEST_SIDE, read_message, to_event, to_size
from cubecam.viewer.page.server import PageServer
from cubecam.viewer.panel import Control, Section
from tests.documents import ROOT
from tests.viewer.pages import (
    Footprint,
    TinyView,
    confirm,
    frame,
    get,
    open_socket,
    receive,
    resize,
    send,
    until,
)


@pytest.fixture
def server():
    with PageServer() as made:
        yield made


@pytest.fixture
def view():
    return TinyView()


@pytest.fixture
def opened(server, view):
    """A websocket that shows 40 x 30 pixels of the view."""
    with open_socket(server.add(view)) as connection:
        resize(connection, 40, 30)
        yield connection


class TestPictures:
    def test_a_still_picture_is_a_png_with_the_view_s_own_numbers(self, opened, view):
        message, picture = frame(opened)
        assert message["mimetype"] == "image/png"
        assert picture.shape == (30, 40, 3)
        assert (picture == view.color).all()

    def test_a_moving_picture_is_a_jpeg(self, opened, view):
        frame(opened)
        view.quality = 80
        view.changed()
        message, picture = frame(opened)
        assert message["mimetype"] == "image/jpeg"
        assert np.abs(picture.astype(int) - view.color).max() <= 3

    def test_a_change_is_shown_and_nothing_is_drawn_while_nothing_changes(self, opened, view):
        frame(opened)
        view.color = (1, 2, 3)
        view.changed()
        assert (frame(opened)[1] == (1, 2, 3)).all()
        drawn = view.drawn
        time.sleep(0.3)
        assert view.drawn == drawn
        with pytest.raises(TimeoutError):
            receive(opened, "framebufferdata", timeout=0.1)

    def test_no_browser_no_drawing(self, server, view):
        server.add(view)
        view.changed()
        time.sleep(0.1)
        assert view.drawn == 0

    def test_frames_are_dropped_and_never_queued(self, opened, view):
        """A browser that confirms nothing gets two frames; then the newest one, not those between."""
        message, _ = receive(opened, "framebufferdata")
        for step in range(50):
            view.color = (step, 0, 0)
            view.changed()
            time.sleep(0.005)
        second, _ = receive(opened, "framebufferdata")
        assert second["index"] == message["index"] + 1
        with pytest.raises(TimeoutError):
            receive(opened, "framebufferdata", timeout=0.2)
        assert view.drawn == 2
        confirm(opened, second)
        third, picture = frame(opened)
        assert third["index"] == second["index"] + 1
        assert tuple(picture[0, 0]) == (49, 0, 0)
        assert view.drawn == 3

    def test_at_most_30_frames_a_second(self, opened, view):
        frame(opened)
        start, drawn = time.monotonic(), view.drawn
        while time.monotonic() < start + 0.5:
            view.changed()
            frame(opened)
        assert 5 <= view.drawn - drawn <= 17

    def test_a_draw_that_wants_another_one_goes_on(self, opened, view):
        """What an animation does: each picture requests the next one."""
        frame(opened)
        view.on_draw = view.changed
        view.changed()
        pictures = [frame(opened)[1] for _ in range(5)]
        view.on_draw = None
        assert len(pictures) == 5
        assert all(picture.ndim == 3 for picture in pictures)

    def test_an_error_in_a_drawing_does_not_end_the_page(self, opened, view, caplog):
        frame(opened)

        def fail():
            raise ValueError("no picture today")

        view.on_draw = fail
        view.changed()
        until(lambda: "no picture today" in caplog.text)
        view.on_draw = None
        view.color = (9, 9, 9)
        view.changed()
        until(lambda: (frame(opened)[1] == 9).all())


class TestSize:
    def test_the_picture_has_the_browser_s_pixels(self, opened, view):
        frame(opened)
        resize(opened, 80, 60, ratio=2.0)
        assert frame(opened)[1].shape == (60, 80, 3)
        sizes = [event for event in view.events if event["event_type"] == "resize"]
        assert (sizes[-1]["width"], sizes[-1]["height"], sizes[-1]["pixel_ratio"]) == (40, 30, 2)

    def test_the_same_size_again_draws_nothing(self, opened, view):
        frame(opened)
        drawn = view.drawn
        resize(opened, 40, 30)
        time.sleep(0.1)
        assert view.drawn == drawn

    def test_an_enormous_window_gets_a_smaller_picture(self):
        message = {"type": "resize", "pwidth": 20_000, "pheight": 10_000, "ratio": 2.0}
        size = to_size(message)
        assert size is not None
        width, height, ratio = size
        assert (width, height) == (LARGEST_SIDE, LARGEST_SIDE // 2)
        assert width / ratio == pytest.approx(10_000)

    @pytest.mark.parametrize(
        "wrong",
        [{"pwidth": 0}, {"pheight": -1}, {"ratio": 0}, {"ratio": 1e9}, {"pwidth": "10"}, {"pwidth": None},
         {"pheight": float("nan")}, {"pwidth": float("inf")}, {"pwidth": True}, {"ratio": [1]}],
        ids=str,
    )  # fmt: skip
    def test_sizes_that_make_no_sense(self, wrong):
        good = {"type": "resize", "pwidth": 10, "pheight": 10, "ratio": 1}
        assert to_size(good) == (10, 10, 1)
        assert to_size({**good, **wrong}) is None


class TestEvents:
    def test_an_event_reaches_the_view_as_rendercanvas_has_it(self, opened, view):
        send(opened, type="pointer_down", x=3.5, y=4, button=1, buttons=[1], modifiers=["Shift"])
        send(opened, type="key_down", key="w", modifiers=[])
        until(lambda: len([e for e in view.events if e["event_type"] != "resize"]) == 2)
        down, key = (event for event in view.events if event["event_type"] != "resize")
        assert (down["x"], down["y"], down["button"], down["buttons"]) == (3.5, 4.0, 1, (1,))
        assert (down["modifiers"], down["ntouches"], down["touches"]) == (("Shift",), 0, {})
        assert (key["key"], key["modifiers"]) == ("w", ())

    @pytest.mark.parametrize(
        "text",
        ["", "x", "[]", "1", "null", "{}", '{"type": 1}', '{"type": null}', "[" * 100_000, '{"type": "close"}',
         '{"type": "before_draw"}', '{"type": "pointer_down"}', '{"type": "control"}', '{"type": "_framefeedback"}',
         '{"type": "_framefeedback", "index": 99999}', '{"type": "control", "control": [0, 0]}',
         '{"type": "control", "control": [-1, 1e99], "value": 1}', '{"type": "resize"}',
         '{"type": "key_down", "key": 5}',
         '{"type": "pointer_move", "x": 1e400, "y": 0, "button": 0, "buttons": [], "modifiers": []}'],
        ids=lambda text: text[:40],
    )  # fmt: skip
    def test_messages_that_make_no_sense_do_nothing(self, text, server, view):
        with open_socket(server.add(view)) as connection:
            connection.send(text[:60_000])
            connection.send(b"\x00\xff")
            resize(connection, 40, 30)
            frame(connection)
        assert [event["event_type"] for event in view.events] == ["resize"] * len(view.events)

    def test_a_message_that_is_too_long_ends_the_connection(self, opened):
        opened.send("x" * 100_000)
        with pytest.raises(ConnectionClosed):
            receive(opened, "nothing")

    def test_only_known_fields_come_through(self):
        message = {
            "type": "key_down",
            "key": "a",
            "modifiers": [],
            "stop_propagation": True,
            "x": 1,
        }
        assert to_event(message) == {"event_type": "key_down", "key": "a", "modifiers": ()}
        assert to_event({"type": "key_down", "key": "a" * 33, "modifiers": []}) is None
        assert to_event({"type": "key_down", "key": "a", "modifiers": [{}]}) is None
        assert read_message('{"type": "key_down"}') == {"type": "key_down"}


class TestTextAndPanel:
    def test_text_help_and_title_come_at_once_and_when_they_change(self, opened, view):
        got: dict[str, object] = {}
        while set(got) < {"title", "text", "help", "panel"}:
            message = json.loads(opened.recv(10))
            got[message["type"]] = message.get("value")
            if message["type"] == "framebufferdata":
                opened.recv(10)
        assert (got["title"], got["text"], got["help"]) == ("tiny", "ready", "h  this list")
        assert got["panel"] == []
        view.tell("text", "new words")
        assert receive(opened, "text")["value"] == "new words"

    def test_a_browser_that_comes_later_gets_the_last_text(self, server, view):
        url = server.add(view)
        view.tell("text", "one")
        view.tell("text", "two")
        with open_socket(url) as connection:
            assert receive(connection, "text")["value"] == "two"

    @pytest.fixture
    def panel(self, view):
        numbers = {"red": 200.0}

        def set_red(value):
            if value > 255:
                raise ValueError(f"red: expected at most 255, got {value}")
            numbers["red"] = value
            view.color = (int(value), 0, 0)

        control = Control("red", "number", lambda: numbers["red"], set_red, low=0, high=255)
        view.sections = [Section("Colour", (control,))]
        return numbers

    def test_a_control_is_set_and_the_picture_follows(self, panel, opened, view):
        shown = receive(opened, "panel")["value"]
        assert shown[0]["title"] == "Colour"
        assert shown[0]["controls"][0]["value"] == 200
        send(opened, type="control", control=[0, 0], value=7)
        assert receive(opened, "problem 0 0")["value"] == ""
        assert panel["red"] == 7
        assert receive(opened, "panel")["value"][0]["controls"][0]["value"] == 7

    def test_a_wrong_value_is_answered_in_the_property_s_words(self, panel, opened):
        send(opened, type="control", control=[0, 0], value=300)
        assert receive(opened, "problem 0 0")["value"] == "red: expected at most 255, got 300"
        assert panel["red"] == 200

    @pytest.mark.parametrize("place", [[0, 1], [1, 0], [-1, 0], [0, -1]])
    def test_a_control_that_is_not_there_is_no_error_of_the_server(self, place, panel, opened):
        send(opened, type="control", control=place, value=1)
        assert receive(opened, f"problem {place[0]} {place[1]}")["value"]
        assert panel["red"] == 200

    def test_what_changes_in_python_is_shown(self, panel, opened, view):
        receive(opened, "panel")
        panel["red"] = 12.0
        view.tell("panel")
        assert receive(opened, "panel")["value"][0]["controls"][0]["value"] == 12


class TestSeveral:
    def test_two_views_have_two_addresses_and_do_not_mix(self, server):
        red, blue = TinyView(), TinyView()
        red.color, blue.color = (250, 0, 0), (0, 0, 250)
        urls = [server.add(red), server.add(blue)]
        assert len(set(urls)) == 2
        for url, view in zip(urls, (red, blue), strict=True):
            with open_socket(url) as connection:
                resize(connection, 20, 10)
                assert (frame(connection)[1] == view.color).all()
        server.remove(red)
        assert server.views == [blue]
        assert get(urls[0])[0] == 404
        assert get(urls[1])[0] == 200

    def test_two_browsers_see_one_view_and_the_one_in_use_has_its_size(self, server, view):
        url = server.add(view)
        with open_socket(url) as first, open_socket(url) as second:
            resize(first, 40, 30)
            resize(second, 60, 50)
            until(lambda: frame(second)[1].shape == (50, 60, 3))
            send(first, type="key_down", key="w", modifiers=[])
            until(lambda: frame(first)[1].shape == (30, 40, 3))
            until(lambda: frame(second)[1].shape == (30, 40, 3))

    def test_a_slow_browser_does_not_stop_the_other(self, server, view):
        url = server.add(view)
        with open_socket(url) as slow, open_socket(url) as quick:
            resize(slow, 40, 30)
            resize(quick, 40, 30)
            frame(quick)
            for step in range(20):
                view.color = (step, step, step)
                view.changed()
                until(lambda step=step: (frame(quick)[1] == step).all())
            indices = []
            with contextlib.suppress(TimeoutError):
                while True:
                    indices.append(receive(slow, "framebufferdata", timeout=0.2)[0]["index"])
            assert len(indices) <= 2

    def test_a_view_takes_the_place_of_another_under_its_address(self, server):
        old, new = TinyView(), TinyView()
        new.color = (5, 6, 7)
        url = server.add(old, "scene")
        with open_socket(url) as connection:
            assert server.add(new, "scene") == url
            with pytest.raises(ConnectionClosed):
                receive(connection, "nothing")
        with open_socket(url) as connection:
            resize(connection, 20, 10)
            assert (frame(connection)[1] == new.color).all()
        assert server.views == [new]

    def test_a_view_that_is_closed_is_gone_from_the_server(self, server, view):
        url = server.add(view)
        with open_socket(url) as connection:
            view.tell("closed")
            with pytest.raises(ConnectionClosed):
                receive(connection, "nothing")
        until(lambda: server.views == [])
        with pytest.raises(InvalidStatus):
            open_socket(url)


def test_closing_leaves_no_thread_and_no_socket():
    with PageServer():
        pass  # what is loaded at the first use
    before = Footprint()
    for _ in range(3):
        server = PageServer()
        url = server.add(TinyView())
        with open_socket(url) as connection:
            resize(connection, 40, 30)
            frame(connection)
            server.close()
            assert server.closed
            with pytest.raises(ConnectionClosed):
                receive(connection, "nothing")
    server.close()
    until(lambda: Footprint() == before)
    with pytest.raises(OSError, match="refused"):
        get(url)
    with pytest.raises(RuntimeError, match="expected a server that is open"):
        server.add(TinyView())


def test_no_message_waits_until_the_one_before_it_was_confirmed(server, view):
    """TCP_NODELAY: without it the second message of each frame waits 40 ms."""
    with open_socket(server.add(view)):
        own = [c for c in psutil.Process().net_connections("tcp") if c.status == "ESTABLISHED"]
        ends = [c.fd for c in own if c.laddr.port == server.port]
        assert ends
        for end in ends:
            with socket.socket(fileno=os.dup(end)) as copy:
                assert copy.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)


def test_closing_is_quick_with_browsers_that_do_nothing():
    server = PageServer()
    url = server.add(TinyView())
    parts = urlsplit(url)
    with (
        open_socket(url),
        open_socket(url),
        socket.create_connection((parts.hostname, server.port)),
    ):
        start = time.monotonic()
        server.close()
        assert time.monotonic() - start < 3


def test_a_flood_of_events_is_merged_and_memory_stays(opened, view):
    """5,000 moves while the picture is drawn become few calls."""
    frame(opened)
    tracemalloc.start()
    try:
        for step in range(5000):
            send(opened, type="pointer_move", x=step, y=1, button=1, buttons=[1], modifiers=[])
        until(lambda: view.events and view.events[-1].get("x") == 4999)
        assert tracemalloc.get_traced_memory()[0] < 3_000_000
    finally:
        tracemalloc.stop()
    assert len(view.events) < 500


def test_a_process_that_ends_needs_no_close():
    from tests.helpers import run_python

    start = time.monotonic()
    run_python(
        """
        from cubecam.viewer.page.server import PageServer
        from tests.viewer.pages import TinyView, get
        assert get(PageServer().add(TinyView()))[0] == 200
        """,
        PYTHONPATH=os.pathsep.join([os.environ.get("PYTHONPATH", ""), str(ROOT)]),
    )
    assert time.monotonic() - start < 20
