"""JupyterLab on a free port of this machine, with folders and settings of its own, for tests in a browser."""

from __future__ import annotations

import ast
import contextlib
import json
import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

import cubecam

ROOT = Path(__file__).resolve().parents[2]
CHROMIUM = shutil.which("chromium") or "/usr/bin/chromium"
#: Software rendering, which every machine has; containers allow no sandbox.
ARGUMENTS = ["--no-sandbox", "--disable-gpu"]


class Lab:
    """A running JupyterLab; `url(path)` is the address of a notebook in `folder`."""

    def __init__(self, folder: Path, theme: str = "JupyterLab Light") -> None:
        self.folder = folder
        self._token = secrets.token_hex(16)
        self._port = _free_port()
        settings = folder / ".settings"
        _write_settings(settings, theme)
        self._log = (folder / ".lab.log").open("w")
        environment = {
            **os.environ,
            # Kernels import the same cubecam as this process, installed or in a checkout.
            "PYTHONPATH": os.pathsep.join([str(Path(cubecam.__file__).parents[1]), str(ROOT)]),
            "PYTHONDONTWRITEBYTECODE": "1",
            "JUPYTER_CONFIG_DIR": str(folder / ".config"),
            "JUPYTER_DATA_DIR": str(folder / ".data"),
            "JUPYTER_RUNTIME_DIR": str(folder / ".runtime"),
            "IPYTHONDIR": str(folder / ".ipython"),
            "JUPYTERLAB_SETTINGS_DIR": str(settings),
            "JUPYTERLAB_WORKSPACES_DIR": str(folder / ".workspaces"),
        }
        command = [
            sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root",
            f"--ServerApp.port={self._port}", "--ServerApp.port_retries=0", "--ServerApp.ip=127.0.0.1",
            f"--IdentityProvider.token={self._token}", f"--ServerApp.root_dir={folder}",
            "--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
        ]  # fmt: skip
        self._process = subprocess.Popen(
            command, env=environment, stdout=self._log, stderr=subprocess.STDOUT,
            start_new_session=True,
        )  # fmt: skip
        try:
            self._wait()
        except BaseException:
            self.close()
            raise

    def url(self, name: str) -> str:
        """The address of a notebook, alone in the window."""
        return f"http://127.0.0.1:{self._port}/lab/tree/{name}?token={self._token}&reset"

    def api(self, path: str) -> object:
        """Ask the server for something as JSON, for example "kernels"."""
        address = f"http://127.0.0.1:{self._port}/api/{path}?token={self._token}"
        with urllib.request.urlopen(address, timeout=10) as answer:
            return json.load(answer)

    def ask(self, expression: str) -> Any:
        """Evaluate an expression in the only kernel; its value must be a literal."""
        from jupyter_client.blocking.client import BlockingKernelClient

        [connection] = (self.folder / ".runtime").glob("kernel-*.json")
        client = BlockingKernelClient(connection_file=str(connection))
        client.load_connection_file()
        client.start_channels()
        try:
            answer = client.execute(
                "", user_expressions={"it": expression}, reply=True, timeout=30, silent=True
            )
        finally:
            client.stop_channels()
        result = answer["content"]["user_expressions"]["it"]
        if result["status"] != "ok":
            raise RuntimeError(f"{result['ename']}: {result['evalue']}")
        return ast.literal_eval(result["data"]["text/plain"])

    def close(self) -> None:
        """End the server and its kernels."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGTERM)
            try:
                self._process.wait(15)
            except subprocess.TimeoutExpired:
                os.killpg(self._process.pid, signal.SIGKILL)
                self._process.wait()
        self._log.close()

    def __enter__(self) -> Lab:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _wait(self) -> None:
        until = time.monotonic() + 60
        while time.monotonic() < until:
            with contextlib.suppress(OSError, urllib.error.URLError):
                self.api("status")
                return
            if self._process.poll() is not None:
                break
            time.sleep(0.2)
        raise RuntimeError("JupyterLab did not start:\n" + (self.folder / ".lab.log").read_text())


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _write_settings(folder: Path, theme: str) -> None:
    chosen = {
        "apputils-extension/themes.jupyterlab-settings": {"theme": theme},
        "apputils-extension/notification.jupyterlab-settings": {
            "fetchNews": "false",
            "checkForUpdates": False,
        },
        "docmanager-extension/plugin.jupyterlab-settings": {"autosave": False},
        # Cells outside the window are drawn as well, so that a test finds their output.
        "notebook-extension/tracker.jupyterlab-settings": {"windowingMode": "none"},
    }
    for name, values in chosen.items():
        path = folder / "@jupyterlab" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(values))


def write_notebook(path: Path, *cells: str) -> None:
    """Write a notebook of code cells."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    path.write_text(
        json.dumps(
            {
                "nbformat": 4,
                "nbformat_minor": 5,
                "metadata": {"kernelspec": kernel},
                "cells": [
                    {
                        "cell_type": "code",
                        "id": f"cell{i}",
                        "metadata": {},
                        "execution_count": None,
                        "outputs": [],
                        "source": cell,
                    }
                    for i, cell in enumerate(cells)
                ],
            }
        )
    )


def run_all(page: Any, timeout: int = 120_000) -> None:
    """Run all cells of the notebook that the page shows, and wait until the last one has finished."""
    page.wait_for_selector(".jp-Notebook", timeout=60_000)
    # The kernel must be there before the menu entry does something.
    page.locator("#jp-main-statusbar", has_text="| Idle").wait_for(timeout=60_000)
    for _ in range(10):
        page.get_by_role("menuitem", name="Run", exact=True).click()
        page.get_by_role("menuitem", name="Run All Cells", exact=True).click()
        # JupyterLab ignores the entry while it restores its windows, and asks for a kernel while it connects to one.
        with contextlib.suppress(Exception):
            page.wait_for_function(_STARTED, timeout=2_000)
            break
        select = page.locator(".jp-Dialog .jp-mod-accept")
        if select.count():
            select.click()
    page.wait_for_function(_FINISHED, timeout=timeout)


_PROMPTS = """[...document.querySelectorAll('.jp-Notebook .jp-CodeCell')]
    .filter(cell => cell.querySelector('.cm-content').textContent.trim() !== '')
    .map(cell => cell.querySelector('.jp-InputPrompt').textContent)"""
_STARTED = f"() => {_PROMPTS}.some(text => /\\[(\\d+|\\*)\\]/.test(text))"
_FINISHED = f"() => {_PROMPTS}.every(text => /\\[\\d+\\]/.test(text))"


def errors(page: Any) -> list[str]:
    """The tracebacks that cells have printed."""
    kinds = ("error", "stderr")
    selector = ", ".join(f'[data-mime-type="application/vnd.jupyter.{kind}"]' for kind in kinds)
    found: list[str] = page.locator(selector).all_inner_texts()
    return found
