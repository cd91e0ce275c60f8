"""The documentation's site in Chromium: pages, pictures, both themes, and the search. `make docs` builds it first."""

import functools
import http.server
import threading

import pytest

from tests.documents import ROOT

pytestmark = pytest.mark.browser

SITE = ROOT / "docs" / "_build" / "html"
#: Pages that are opened, and how many pictures each has at least.
PAGES = {
    "index.html": 3,
    "tutorial.html": 8,
    "gallery/index.html": 18,
    "howto/orientation.html": 1,
    "lessons/03-reflection-and-refraction.html": 13,
}


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves files, and says nothing."""

    def log_message(self, *arguments):
        """Leave out the line of each request."""


@pytest.fixture(scope="module")
def address():
    assert (SITE / "index.html").exists(), "expected the built site; make docs builds it"
    with http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Quiet, directory=SITE)
    ) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()
        thread.join()


@pytest.fixture(params=["light", "dark"])
def page(request, chromium, address):
    """A tab in one of both themes; messages of its console, and requests to elsewhere, fail the test."""
    context = chromium.new_context(
        viewport={"width": 1400, "height": 900}, color_scheme=request.param
    )
    made = context.new_page()
    wrong = []
    made.on("pageerror", lambda error: wrong.append(str(error)))
    made.on(
        "console",
        lambda line: wrong.append(line.text) if line.type in ("error", "warning") else None,
    )
    made.on(
        "request",
        lambda asked: (
            wrong.append(f"the page loads {asked.url}")
            if not asked.url.startswith((address, "data:", "blob:"))
            else None
        ),
    )
    made.theme = request.param
    yield made
    context.close()
    assert wrong == []


def seen_pictures(tab):
    """Scroll down, so that late pictures are loaded; the names of those without pixels, and how many there are."""
    return tab.evaluate(
        """async () => {
          const found = [...document.querySelectorAll('.bd-content img, article img')]
          for (const one of found) {
            one.scrollIntoView()
            await one.decode().catch(() => undefined)
          }
          return [found.filter((one) => !one.naturalWidth).map((one) => one.src), found.length]
        }"""
    )


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_its_pictures_in_both_themes(name, page, address):
    page.goto(address + name)
    empty, count = seen_pictures(page)
    assert empty == []
    assert count >= PAGES[name]
    red, green, blue = page.evaluate(
        "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3).map(Number)"
    )
    brightness = (red + green + blue) / 3
    assert brightness > 200 if page.theme == "light" else brightness < 60


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.parametrize("width", [390, 1400])
def test_no_page_is_wider_than_the_screen(name, width, page, address):
    page.set_viewport_size({"width": width, "height": 844})
    page.goto(address + name)
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_gallery_shows_a_loop(page, address):
    page.goto(address + "gallery/index.html")
    page.locator(".sphx-glr-thumbcontainer", has_text="P14").locator("a").first.click()
    loop = page.locator("img.loop")
    loop.scroll_into_view_if_needed()
    assert loop.get_attribute("src").endswith(".webp")
    assert page.locator("h1").inner_text().startswith("P14")


@pytest.mark.parametrize(
    ("words", "where"),
    [
        ("read_probe", "reference/renderer.html"),
        ("panorama of depths", "howto/outputs.html"),
        ("MirrorMaterial", "reference/materials.html"),
    ],
)
def test_the_search_finds(words, where, page, address):
    page.goto(address + "index.html")
    page.locator("button.search-button__button:visible, .search-button-field:visible").first.click()
    field = page.locator("input[type=search]:visible").first
    field.fill(words)
    field.press("Enter")
    page.wait_for_url("**/search.html?q=*")
    hit = page.locator(f"ul.search li a[href*='{where}']").first
    hit.wait_for(timeout=10_000)
    hit.click()
    page.wait_for_url(f"**/{where}*")
