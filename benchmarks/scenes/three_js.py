"""three.js in headless Chromium, WebGL by SwiftShader; pixels come back as floats of linear light."""

from __future__ import annotations

import contextlib
import functools
import http.server
import shutil
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

PAGE = Path(__file__).with_name("three.html")
TYPES = {".js": "text/javascript", ".html": "text/html", ".wasm": "application/wasm"}


@dataclass
class Site:
    """What the page can fetch: three.js' package, one file with what lies beside it, one panorama."""

    package: Path
    folder: Path = Path()
    panorama: bytes = b""
    result: bytes = b""
    routes: dict[str, Path] = field(default_factory=dict)


class Handler(http.server.BaseHTTPRequestHandler):
    def __init__(self, site: Site, *arguments: Any) -> None:
        self.site = site
        super().__init__(*arguments)

    def log_message(self, *arguments: Any) -> None:
        pass

    def found(self, path: str) -> bytes | None:
        from urllib.parse import unquote

        path = unquote(path.partition("?")[0])
        if path == "/":
            return PAGE.read_bytes()
        if path == "/favicon.ico":
            return b""
        if path == "/panorama":
            return self.site.panorama
        for start, folder in (("/three/", self.site.package), ("/model/", self.site.folder)):
            file = folder / path.removeprefix(start)
            if path.startswith(start) and file.is_file():
                return file.read_bytes()
        return None

    def do_GET(self) -> None:
        body = self.found(self.path)
        self.send_response(200 if body is not None else 404)
        kind = TYPES.get(Path(self.path).suffix, "application/octet-stream")
        self.send_header("Content-Type", "text/html" if self.path == "/" else kind)
        self.send_header("Content-Length", str(len(body or b"")))
        self.end_headers()
        self.wfile.write(body or b"")

    def do_POST(self) -> None:
        self.site.result = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(200)
        self.send_header("Content-Length", "0")
        self.end_headers()


def centred_on_x(pixels: Array) -> Array:
    """(H, W, 4) float32 of a panorama with -Z in its middle, for three.js: bottom row first, +X in the middle."""
    turned = np.roll(pixels[::-1], -pixels.shape[1] // 4, axis=1)
    opaque = np.ones((*turned.shape[:2], 1), np.float32)
    return np.ascontiguousarray(np.concatenate([turned, opaque], -1).astype("<f4"))


class ThreeJs:
    """A tab with three.js; `draw` gives linear light."""

    def __init__(self, page: Any, site: Site) -> None:
        self.page = page
        self.site = site
        self.revision = ""
        self.problems: list[str] = []

    def draw(
        self,
        path: Path,
        panorama: Array,
        size: tuple[int, int],
        *,
        camera: dict[str, Any] | None = None,
        time: float | None = None,
        animation: int = 0,
    ) -> Array:
        """(H, W, 3) float32. Without a camera, the first of the file."""
        self.site.folder = path.parent
        self.site.panorama = centred_on_x(panorama).tobytes()
        self.site.result = b""
        options = {
            "file": f"/model/{path.name}",
            "photograph": "/panorama",
            "photographSize": [panorama.shape[1], panorama.shape[0]],
            "size": list(size),
            "camera": camera,
            "time": time,
            "animation": animation,
        }
        self.revision = self.page.evaluate("draw", options)["revision"]
        pixels = np.frombuffer(self.site.result, "<f4").reshape(size[1], size[0], 4)
        return np.ascontiguousarray(pixels[::-1, :, :3])


@contextlib.contextmanager
def three_js(package: Path) -> Iterator[ThreeJs]:
    """`package`: the folder of npm's package `three`."""
    from playwright.sync_api import sync_playwright

    site = Site(package)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    arguments = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=shutil.which("chromium"), args=arguments
            )
            page = browser.new_page()
            page.set_default_timeout(300_000)
            made = ThreeJs(page, site)
            page.on("pageerror", lambda error: made.problems.append(str(error)))
            page.on(
                "console",
                lambda line: (
                    made.problems.append(line.text) if line.type in ("error", "warning") else None
                ),
            )
            page.goto(f"http://127.0.0.1:{server.server_address[1]}/")
            page.wait_for_function("window.ready")
            yield made
            browser.close()
    finally:
        server.shutdown()
