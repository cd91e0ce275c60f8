"""The file python/cubecam/_core.pyi is equal to what the generator makes from the built module."""

import subprocess
import sys
from pathlib import Path

from tests.helpers import need_no_sanitizer

ROOT = Path(__file__).parents[2]


def test_stubs_are_current():
    need_no_sanitizer("the module has functions with planted faults")
    done = subprocess.run(
        [sys.executable, "scripts/stubs.py", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
