"""Pages of live views in real Chromium: what is shown, what mouse and keys do, the panel, and what is refused."""

import re
import time
from urllib.parse import urlsplit

import numpy as np
import pytest

import cubecam as cc
from cubecam.viewer.page.server import PageServer

pytestmark = pytest.mark.browser

WIDTH, HEIGHT = 600, 400


@pytest.fixture
def server():
    with PageServer() as made:
        yield made


@pytest.fixture
def scene():
    made = cc.Scene(background=(0.1, 0.2, 0.4))
    made.add(cc.Mesh.box(1), cc.BasicMaterial(color=(0.9, 0.5, 0.1)), name="box")
    return made


@pytest.fixture
def viewer(scene):
    camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
    with cc.Viewer(scene, camera, size=(WIDTH, HEIGHT), title="a box") as made:
        yield made


@pytest.fixture
def walker(scene):
    camera = cc.PerspectiveCamera(position=(1, 2, 5), target=(0, 0, 0))
    with cc.Viewer(scene, camera, "first_person", size=(WIDTH, HEIGHT)) as made:
        yield made


def until(condition, tab, seconds=10):
    """Wait as playwright wants it: its events come only while it waits."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it took too long"
        tab.wait_for_timeout(20)


def opened(tab, address):
    """Open a page and wait for the first picture of full quality; in a window this small the panel is folded."""
    tab.goto(address)
    still(tab)
    return tab


def shown(tab):
    """The pixels of the picture, as the browser decoded them: (height, width, 3)."""
    numbers = tab.evaluate(
        """() => {
          const picture = document.getElementById('picture')
          const canvas = document.createElement('canvas')
          canvas.width = picture.naturalWidth
          canvas.height = picture.naturalHeight
          const context = canvas.getContext('2d')
          context.drawImage(picture, 0, 0)
          return [canvas.width, canvas.height, Array.from(context.getImageData(0, 0, canvas.width, canvas.height).data)]
        }"""
    )
    width, height, data = numbers
    return np.array(data, np.uint8).reshape(height, width, 4)[..., :3]


def still(tab):
    tab.locator("#picture[data-kind='image/png']").wait_for(timeout=10_000)


def turned(vector, axis, degrees):
    """Rotate round an axis (Rodrigues), counter-clockwise if the axis points at the viewer."""
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    angle = np.radians(degrees)
    return (
        vector * np.cos(angle)
        + np.cross(axis, vector) * np.sin(angle)
        + axis * (axis @ vector) * (1 - np.cos(angle))
    )


def test_the_picture_is_that_of_render_bit_for_bit(tab, server, viewer):
    opened(tab, server.add(viewer))
    with cc.Renderer() as renderer:
        expected = renderer.render(
            viewer.scene,
            viewer.camera,
            (WIDTH, HEIGHT),
            samples=4,
            tonemap="neutral",
            encode="srgb",
        )
    np.testing.assert_array_equal(shown(tab), expected.color[..., :3])
    assert tab.title() == "a box"


def test_a_drag_turns_the_camera_as_numpy_predicts(tab, server, viewer):
    """A drag over the whole height is a whole turn: 50 pixels of 400 are 45 degrees, 20 are 18."""
    opened(tab, server.add(viewer))
    tab.mouse.move(200, 150)
    tab.mouse.down()
    tab.mouse.move(250, 170, steps=5)
    tab.mouse.up()
    yaw, pitch = 360 * 50 / HEIGHT, 360 * 20 / HEIGHT
    # The scene turns to the right, so the camera goes to its left, and rises by the pitch.
    level = turned(np.array([0, 0, 4.0]), (0, 1, 0), -yaw)
    expected = turned(level, np.cross(level, (0, 1, 0)), pitch)
    until(lambda: np.allclose(viewer.camera.position, expected, atol=1e-6), tab)
    still(tab)
    with cc.Renderer() as renderer:
        frame = renderer.render(
            viewer.scene,
            viewer.camera,
            (WIDTH, HEIGHT),
            samples=4,
            tonemap="neutral",
            encode="srgb",
        )
    until(lambda: (shown(tab) == frame.color[..., :3]).all(), tab)


def test_while_it_moves_the_picture_is_a_jpeg_and_fills_the_window(tab, server, viewer):
    opened(tab, server.add(viewer))
    angle = []

    def turn(seconds):
        angle.append(seconds)
        viewer.camera.orbit(yaw=2)

    viewer.animate(turn)
    tab.locator("#picture[data-kind='image/jpeg']").wait_for(timeout=10_000)
    box = tab.locator("#picture").bounding_box()
    assert (box["width"], box["height"]) == (WIDTH, HEIGHT)
    assert tab.locator("#picture").evaluate("p => getComputedStyle(p).imageRendering") == "auto"
    viewer.animate(None)
    still(tab)
    assert len(angle) > 1


def test_w_walks_a_tenth_in_first_person(tab, server, walker):
    opened(tab, server.add(walker))
    position, target = walker.camera.position, walker.camera.target
    forward = (target - position) / np.linalg.norm(target - position)
    tab.mouse.move(300, 200)
    for step in range(1, 4):
        tab.keyboard.press("w")
        expected = position + 0.1 * step * forward
        until(lambda expected=expected: np.allclose(walker.camera.position, expected), tab)
    tab.keyboard.press("s")
    until(lambda: np.allclose(walker.camera.position, position + 0.2 * forward), tab)


def test_the_wheel_comes_nearer_without_a_click(tab, server, viewer):
    opened(tab, server.add(viewer))
    tab.mouse.move(300, 200)
    tab.mouse.wheel(0, -300)
    until(lambda: np.allclose(viewer.camera.position, (0, 0, 4 * 2**-0.5)), tab)


def test_a_double_click_sets_the_pivot(tab, server, viewer):
    opened(tab, server.add(viewer))
    tab.mouse.dblclick(310, 190)
    until(lambda: abs(viewer.camera.target[2] - 0.5) < 1e-3, tab)
    # The pixel's ray meets the front of the box, z = 0.5, at 3.5 from the camera.
    per_pixel = 2 * 3.5 * np.tan(np.radians(viewer.camera.fov) / 2) / HEIGHT
    expected = (10.5 * per_pixel, 9.5 * per_pixel, 0.5)
    np.testing.assert_allclose(viewer.camera.target, expected, atol=1.01 * per_pixel)


def test_the_line_below_the_picture_names_what_is_under_the_pointer(tab, server, viewer):
    opened(tab, server.add(viewer))
    tab.mouse.move(310, 205)
    until(lambda: "box" in tab.locator("#text").text_content(), tab)
    tab.mouse.move(20, 20)
    until(lambda: "box" not in tab.locator("#text").text_content(), tab)


def test_h_lists_the_keys_and_goes_again(tab, server, viewer):
    opened(tab, server.add(viewer))
    tab.mouse.move(300, 200)
    tab.keyboard.press("h")
    until(lambda: tab.locator("#help").is_visible(), tab)
    told = tab.locator("#help").inner_text()
    for line in viewer.help.splitlines():
        for part in re.split(" {2,}", line):
            assert part in told
    tab.keyboard.press("h")
    until(lambda: not tab.locator("#help").is_visible(), tab)


class TestPanel:
    @pytest.fixture
    def panel(self, tab, server, viewer):
        opened(tab, server.add(viewer))
        tab.locator("#unfold").click()
        return tab

    def test_a_slider_changes_the_material(self, panel, viewer, scene):
        material = scene["box"].material
        slider = panel.locator("input[type=range][data-name=opacity]").first
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        panel.mouse.move(box["x"] + box["width"] - 7, box["y"] + box["height"] / 2)
        panel.mouse.down()
        panel.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, steps=6)
        panel.mouse.up()
        until(lambda: 0.4 < material.opacity < 0.6, panel)
        before = shown(panel)
        until(lambda: panel.locator("#picture[data-kind='image/png']").count() == 1, panel)
        assert before.shape[2] == 3
        number = panel.locator("input[type=number][data-name=opacity]").first
        assert float(number.input_value()) == pytest.approx(material.opacity, abs=1e-5)

    def test_a_number_is_written(self, panel, scene):
        number = panel.locator("input[type=number][data-name=opacity]").first
        number.fill("0.25")
        number.press("Enter")
        until(lambda: scene["box"].material.opacity == 0.25, panel)

    def test_a_wrong_number_is_answered_beside_the_control(self, panel, scene):
        number = panel.locator("input[type=number][data-name=opacity]").first
        number.fill("7")
        number.press("Enter")
        row = panel.locator(".row", has=number)
        until(lambda: "expected" in row.locator(".problem").inner_text(), panel)
        assert "7" in row.locator(".problem").inner_text()
        assert scene["box"].material.opacity == 1
        number.fill("0.5")
        number.press("Enter")
        until(lambda: row.locator(".problem").inner_text() == "", panel)

    def test_a_colour_is_written(self, panel, scene):
        field = panel.locator("input[type=text][data-name=color]").first
        field.fill("#0000ff")
        field.press("Enter")
        until(lambda: tuple(scene["box"].material.color[:3]) == (0, 0, 1), panel)

    def test_what_python_changes_is_shown(self, panel, viewer):
        viewer.exposure = 1.5
        number = panel.locator("input[type=number][data-name=exposure]").first
        until(lambda: number.input_value() == "1.5", panel)


def test_the_page_comes_back_after_the_connection_was_lost(tab, server, viewer):
    address = opened(tab, server.add(viewer, "box")).url
    server.remove(viewer)
    until(lambda: tab.locator("#notice").is_visible(), tab)
    assert server.add(viewer, "box") == address
    until(lambda: not tab.locator("#notice").is_visible(), tab)
    tab.mouse.move(200, 150)
    tab.mouse.wheel(0, 600)
    until(lambda: viewer.camera.position[2] > 7, tab)


def test_nothing_lies_on_the_picture_in_a_large_window(tab, server):
    cube = cc.CubeMap(np.ones((6, 8, 8, 3), np.float32))
    tab.set_viewport_size({"width": 1200, "height": 700})
    with cube.show("offscreen") as view:
        opened(tab, server.add(view))
        tab.mouse.move(330, 325)
        until(lambda: "three: -Z" in tab.locator("#text").text_content(), tab)
        picture = tab.locator("#picture").bounding_box()
        panel, status = (tab.locator(name).bounding_box() for name in ("#panel", "#status"))
        assert picture["x"] + picture["width"] <= panel["x"]
        assert picture["y"] + picture["height"] <= status["y"]
        assert panel["y"] + panel["height"] <= status["y"]
        assert tab.locator("#text").evaluate("text => text.scrollWidth <= text.clientWidth")
        tab.locator("#fold").click()
        until(lambda: tab.locator("#picture").bounding_box()["width"] == 1200, tab)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_colours_follow_the_system(chromium, server, viewer, scheme):
    context = chromium.new_context(color_scheme=scheme)
    page = context.new_page()
    page.goto(server.add(viewer))
    color = page.evaluate("getComputedStyle(document.body).backgroundColor")
    brightness = np.mean([int(number) for number in re.findall(r"\d+", color)[:3]])
    assert (brightness > 128) == (scheme == "light")
    context.close()


class TestRefusals:
    """From within the browser: fetch and WebSocket of a page that is not the view's own."""

    @pytest.fixture
    def other(self, chromium):
        context = chromium.new_context()
        page = context.new_page()
        yield page
        context.close()

    def test_no_token_a_wrong_token_and_paths_of_the_disk(self, other, server, viewer):
        address = server.add(viewer)
        parts = urlsplit(address)
        token = parts.path.split("/")[1]
        root = f"http://{parts.netloc}"
        for path in (
            "/",
            "/view/",
            "/page.js",
            parts.path.replace(token, token[::-1]),
            "/..%2f..%2fetc/passwd",
        ):
            assert other.goto(root + path).status == 403
        for path in ("nope", "..%2f..%2fetc/passwd", "%2e%2e/%2e%2e/etc/passwd"):
            assert other.goto(address + path).status in (403, 404)

    def test_a_foreign_host(self, chromium, server, viewer):
        """A name that leads to this machine, as in an attack by DNS rebinding."""
        address = server.add(viewer)
        import shutil

        from playwright.sync_api import Error

        foreign = address.replace("127.0.0.1", "evil.example")
        browser = chromium.browser_type.launch(
            executable_path=shutil.which("chromium"),
            args=["--no-sandbox", "--host-resolver-rules=MAP evil.example 127.0.0.1"],
        )
        try:
            page = browser.new_page()
            assert page.goto(foreign).status == 403
        except Error as error:
            pytest.fail(f"expected an answer, got {error}")
        finally:
            browser.close()

    def test_another_origin_gets_no_websocket_and_no_script(self, other, server, viewer):
        """A page of another server of this machine, which knows even the token."""
        address = server.add(viewer)
        with PageServer() as stranger, cc.Viewer(viewer.scene) as its_view:
            # The policy of a page of cubecam forbids other hosts by itself: the stranger's page has none.
            other.route(
                "**/strange",
                lambda route: route.fulfill(
                    status=200, content_type="text/html", body="<p>strange"
                ),
            )
            other.goto(stranger.add(its_view) + "strange")
            closed = other.evaluate(
                """(address) => new Promise((resolve) => {
                  const socket = new WebSocket(address)
                  socket.onopen = () => resolve('open')
                  socket.onclose = () => resolve('closed')
                })""",
                address.replace("http", "ws"),
            )
            assert closed == "closed"
            loaded = other.evaluate(
                """(address) => new Promise((resolve) => {
                  const script = document.createElement('script')
                  script.onload = () => resolve('loaded')
                  script.onerror = () => resolve('refused')
                  script.crossOrigin = 'anonymous'
                  script.src = address
                  document.body.append(script)
                })""",
                address + "page.js",
            )
            assert loaded == "refused"

    def test_no_frame_shows_the_page(self, other, server, viewer):
        address = server.add(viewer)
        other.route(
            "**/strange",
            lambda route: route.fulfill(
                status=200, content_type="text/html", body=f"<iframe src='{address}'></iframe>"
            ),
        )
        other.goto("http://127.0.0.1:1/strange")
        other.wait_for_timeout(500)
        frame = other.frames[1]
        assert frame.locator("#picture").count() == 0


def test_a_password_is_asked_for_first(tab, viewer):
    with PageServer(password="Grüße") as server:
        address = server.add(viewer)
        tab.goto(address)
        assert tab.locator("#picture").count() == 0
        tab.fill("#password", "Grüße")
        tab.press("#password", "Enter")
        picture = tab.locator("#picture[data-kind='image/png']")
        picture.wait_for(timeout=10_000)
        assert picture.count() == 1
