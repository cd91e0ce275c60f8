"""scripts/compare_versions.py: what the script calls equal, a tie or a difference; a run against a changed copy."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import load_script

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "compare_versions.py"


@pytest.fixture(scope="module")
def script():
    return load_script("compare_versions")


def picture():
    return {
        "color": np.arange(2 * 3 * 4, dtype=np.float32).reshape(2, 3, 4),
        "distance": np.array([[1, 2, 3], [4, 5, np.inf]], np.float32),
        "id": np.array([[1, 1, 2], [2, 3, 0]], np.int32),
    }


def test_the_same_bytes_are_equal(script):
    assert script.compare(picture(), picture(), False) == ("equal", True)


def test_the_sign_of_a_zero_differs(script):
    other = picture()
    other["color"][0, 0, 0] = -0.0
    told, fine = script.compare(picture(), other, False)
    assert not fine
    assert told.startswith("DIFFERS: color: 1 of 6 pixels")


def test_only_other_nodes_at_the_same_distance_are_ties(script):
    other = picture()
    other["id"][0, 1], other["color"][0, 1] = 7, 9
    told, fine = script.compare(picture(), other, True)
    assert fine
    assert told.startswith("ties only: color: 1 of 6 pixels")
    assert not script.compare(picture(), other, False)[1]
    other["distance"][0, 1] = np.nextafter(np.float32(2), np.float32(3))
    assert not script.compare(picture(), other, True)[1]
    other = picture()
    other["color"][0, 1] = 9
    assert not script.compare(picture(), other, True)[1]


def test_refusals_are_compared_by_kind(script):
    one, other = {"error": np.array("ValueError")}, {"error": np.array("GlError")}
    assert script.compare(one, one, False) == ("refused by both (ValueError)", True)
    assert not script.compare(one, other, False)[1]
    assert not script.compare(one, picture(), False)[1]


@pytest.mark.slow
def test_a_changed_copy_differs(tmp_path):
    before = tmp_path / "before"
    package = Path(cc.__file__).parent
    shutil.copytree(package, before / "python" / "cubecam", ignore=lambda *_: ["__pycache__"])
    example = before / "python" / "cubecam" / "examples" / "textured_cube.py"
    text = example.read_text()

    def run():
        options = ["--only=P1.0", f"--before={before}", f"--save-differences={tmp_path / 'out'}"]
        command = [sys.executable, str(SCRIPT), *options]
        return subprocess.run(command, capture_output=True, text=True, timeout=120)

    same = run()
    assert same.returncode == 0, same.stdout + same.stderr
    assert "P1.0: equal" in same.stdout
    assert "1 pictures: 1 equal" in same.stdout
    changed = text.replace("fov=", "fov=1.01 * ")
    assert changed != text
    example.write_text(changed)
    other = run()
    assert other.returncode == 1, other.stdout + other.stderr
    assert "P1.0: DIFFERS: color: " in other.stdout
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {
        f"P1.0.color.{word}.png" for word in ("before", "after", "difference")
    }
