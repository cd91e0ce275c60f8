"""The parent's side of worker processes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]


class WorkerError(Exception):
    """A worker has ended; the message is the last line that it wrote."""


class Process:
    """A running program that answers one JSON line for each JSON line that it reads."""

    def __init__(self, name: str, arguments: list[str], env: dict[str, str] | None = None) -> None:
        self.name = name
        self._errors = tempfile.TemporaryFile("w+")  # noqa: SIM115 (closed by close)
        self._process = subprocess.Popen(
            [sys.executable, *arguments],
            cwd=ROOT,
            env=env,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            text=True,
        )
        try:
            self._read()
        except WorkerError:
            self.close()
            raise

    def ask(self, **request: Any) -> dict[str, Any]:
        """Send one request and wait for its answer."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        return self._read()

    def close(self) -> None:
        """End the process and wait for it."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        if not self._process.stdin.closed:
            self._process.stdin.close()
        try:
            self._process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()
        self._errors.close()

    def _read(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            self._process.wait()
            self._errors.seek(0)
            said = [text for text in self._errors.read().splitlines() if text.strip()]
            raise WorkerError(said[-1] if said else f"exit status {self._process.returncode}")
        answer: dict[str, Any] = json.loads(line)
        return answer


class Worker(Process):
    """A running `benchmarks.worker`."""

    def __init__(self, name: str, mesh: Path) -> None:
        super().__init__(name, ["-m", "benchmarks.worker", name, str(mesh)])


class CpuWorker(Process):
    """A running `benchmarks/cpu_worker.py`: `program` is MODULE:CLASS in `tree`'s benchmarks.

    If `tree` is not this one, the package `cubecam` is imported from the folder python of `tree`.
    """

    def __init__(self, program: str, tree: Path = ROOT, **options: Any) -> None:
        env = dict(os.environ)
        if tree != ROOT:
            env["PYTHONPATH"] = str(tree / "python")
        script = str(ROOT / "benchmarks" / "cpu_worker.py")
        super().__init__(program, [script, str(tree), program, json.dumps(options)], env)


def run_python(code: str, env: dict[str, str]) -> dict[str, Any]:
    """The JSON that a new interpreter prints in its last line."""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=env, capture_output=True, text=True
    )
    if done.returncode:
        said = [text for text in done.stderr.splitlines() if text.strip()]
        raise WorkerError(said[-1] if said else f"exit status {done.returncode}")
    answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return answer
