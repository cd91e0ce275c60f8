"""Packages of npm in a folder of temporary files, a server of files, and headless Chromium with WebGL in software."""

import hashlib
import http.server
import json
import shutil
import subprocess
import tempfile
import threading
from functools import partial
from pathlib import Path

import pytest

from tests.chromium import headless_chromium

HERE = Path(__file__).parent
#: Chromium's WebGL by SwiftShader.
WEBGL = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]


@pytest.fixture(scope="session")
def npm():
    """The folder whose node_modules holds what package.json pins; it is kept for the next run."""
    assert shutil.which("npm"), "expected the program npm"
    wanted = (HERE / "package.json").read_bytes()
    key = hashlib.sha256(wanted).hexdigest()[:12]
    folder = Path(tempfile.gettempdir(), f"cubecam-interop-{key}")
    done = folder / "installed"
    if not done.exists():
        folder.mkdir(exist_ok=True)
        (folder / "package.json").write_bytes(wanted)
        subprocess.run(
            ["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts"],
            cwd=folder,
            check=True,
            capture_output=True,
        )
        done.touch()
    return folder


@pytest.fixture
def node(npm, tmp_path):
    """Run an ES module in node, with the packages of npm; it prints JSON, which is returned."""

    def run(code, *arguments):
        script = npm / f"{tmp_path.name}.mjs"
        script.write_text(code, encoding="utf-8")
        try:
            done = subprocess.run(
                ["node", script, *map(str, arguments)], capture_output=True, text=True, timeout=120
            )
        finally:
            script.unlink()
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


class _Files(http.server.SimpleHTTPRequestHandler):
    """Serves /npm/ (packages), /pages/ (of this folder) and the folder of the test."""

    def __init__(self, *arguments, npm, folder, **options):
        self._roots = {"npm": npm / "node_modules", "pages": HERE / "pages"}
        super().__init__(*arguments, directory=str(folder), **options)

    def translate_path(self, path):
        first, _, rest = path.split("?")[0].lstrip("/").partition("/")
        if first in self._roots:
            return str(self._roots[first] / rest)
        return super().translate_path(path)

    def log_message(self, *_):
        pass


@pytest.fixture
def served(npm, tmp_path):
    """The address of a server of `tmp_path`."""
    handler = partial(_Files, npm=npm, folder=tmp_path)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


@pytest.fixture(scope="session")
def chromium():
    """One browser for the session."""
    with headless_chromium(*WEBGL) as browser:
        yield browser


@pytest.fixture
def page(chromium, served):
    """Open a page of `pages/` and call its function `run(argument)`; an error of the page fails the test."""

    def run(name, argument):
        tab = chromium.new_page(viewport={"width": 400, "height": 300})
        errors = []
        tab.on("pageerror", lambda error: errors.append(str(error)))
        try:
            tab.goto(f"{served}/pages/{name}")
            tab.wait_for_function("window.run !== undefined", timeout=60000)
            result = tab.evaluate("argument => window.run(argument)", argument)
        finally:
            tab.close()
        assert errors == []
        return result

    return run
