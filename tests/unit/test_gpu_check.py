"""scripts/gpu_check.py: the parts on this machine's device, what a bad part does, what a report counts."""

import argparse
import json
import os

import pytest

from tests.helpers import DEVICE, load_script


@pytest.fixture(scope="module")
def script():
    return load_script("gpu_check")


@pytest.mark.slow
def test_the_parts_write_one_report(script, tmp_path):
    parts = ("info", "pictures", "readback", "asynchronous", "probes")
    only = [word for part in parts for word in ("--only", part)]
    found = script.main(["--device", DEVICE, "--quick", "--out", str(tmp_path), *only])
    report = json.loads((tmp_path / "gpu_check.json").read_text())
    assert found == 0, report
    assert set(report) == {"device", "quick", *parts}
    assert report["info"]["version"].startswith("4.")
    assert report["info"]["limits"]["max_samples"] >= 4
    assert len(report["pictures"]) == 4
    assert all((tmp_path / "pictures" / f"{name}.png").exists() for name in report["pictures"])
    for row in report["readback"]:
        pixels = 6 * row["size"] ** 2
        color = {"rgba8": 4, "rgba16f": 8, "rgba32f": 16}[row["format"]]
        # depth, distance and id take 4 bytes; normal and position 12
        assert row["bytes"] == pixels * (color + (36 if row["outputs"] else 0))
        assert row["ms"] > 0
    assert report["asynchronous"]["overlap"]["wall_ratio"] > 0
    assert [row["bytes"] for row in report["asynchronous"]["stream"]] == [
        6 * n * n * 16 for n in (64, 256)
    ]
    assert report["probes"]["probes"] == 125
    assert report["probes"]["one_moved_views_drawn"] > 0


def test_a_part_that_ends_the_process_or_raises_is_reported(script, tmp_path, monkeypatch, capsys):
    assert script.main(["--device", "no such card", "--out", str(tmp_path), "--only", "info"]) == 1
    report = json.loads((tmp_path / "gpu_check.json").read_text())
    assert "no such card" in report["info"]["error"]
    assert "info: " in capsys.readouterr().out
    monkeypatch.setattr(script, "__file__", os.devnull)  # an empty program writes no result
    assert "ended with status 0" in script.run_apart("info", [], tmp_path)["error"]
    monkeypatch.setattr(script, "SECONDS", 0)
    assert "not ready within 0 s" in script.run_apart("info", [], tmp_path)["error"]


def test_tests_that_fail_make_the_part_fail(script, tmp_path):
    """The counts come from pytest's own report of tests that pass, fail, raise and are skipped."""
    (tmp_path / "test_it.py").write_text(
        """
import pytest

def test_good(): pass
def test_bad(): assert 1 == 2
@pytest.fixture
def broken(): raise OSError("no")
def test_broken(broken): pass
@pytest.mark.parametrize("i", range(3))
def test_left_out(i): pytest.skip("why")
"""
    )
    options = argparse.Namespace(
        out=tmp_path,
        device=DEVICE,
        workers=0,
        pytest=[str(tmp_path / "test_it.py"), "-c", os.devnull, "--rootdir", str(tmp_path)],
    )
    found = script.suite(options)
    assert found["passed"] == 1
    assert [case["test"].rpartition("::")[2] for case in found["failed"]] == [
        "test_bad",
        "test_broken",
    ]
    assert found["skipped"] == {"why": 3}
    assert script.failure("suite", found) == "2 of the tests fail"
    assert script.failure("suite", {**found, "failed": []}) is None
    assert (tmp_path / "suite.txt").exists()


def test_without_options_the_device_is_a_gpu_and_every_part_runs(script, tmp_path):
    options = script.parse(["--out", str(tmp_path)])
    assert options.device == "gpu"
    assert options.only is None
    assert not options.quick
