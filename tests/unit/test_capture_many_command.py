"""`cubecam capture-many`: scenes of scripts and files, places of scripts and tables, stores that go on."""

import sys

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc

pytest.importorskip("zarr", minversion="3.1.6")  # Python 3.10 has only zarr 2

SCRIPT = """
import cubecam as cc
scene = cc.Scene(background=(0.2, 0.4, 0.6))
scene.add(cc.Mesh.box(1), cc.BasicMaterial(color="red"), position=(0, 0, -2))
positions = [(x, 0, 0) for x in range(5)]
"""
PLACES = [(x, 0, 0) for x in range(5)]


def capture_many(*arguments):
    from cubecam.cli import app

    return CliRunner().invoke(app, ["capture-many", *[str(a) for a in arguments]])


@pytest.fixture
def script(tmp_path):
    path = tmp_path / "scene.py"
    path.write_text(SCRIPT)
    return path


def scene():
    names: dict = {}
    exec(SCRIPT, names)
    return names["scene"]


def test_a_script_with_positions(script, tmp_path, renderer):
    out = tmp_path / "a.zarr"
    result = capture_many(
        script, "-o", out, "--size", 8, "--outputs", "distance, id", "--chunk", 2, "--far", 50
    )
    assert result.exit_code == 0, result.output
    assert result.output == f"{out}\n5 cubemaps of 6 x 8 x 8 texels\n"
    want = renderer.capture_many(
        scene(), PLACES, 8, outputs=("distance", "id"), far=50, format="rgba16f"
    )
    batch = cc.open_batch(out)
    np.testing.assert_array_equal(batch.faces[:], want.faces)
    np.testing.assert_array_equal(batch.distance[:], want.distance)
    np.testing.assert_array_equal(batch.positions, PLACES)
    assert list(batch.outputs) == ["distance", "id"]
    assert batch.faces.shards[0] == 2
    assert batch.scene_hash == cc.scene_hash(scene())
    # Again: it is there.
    assert (
        capture_many(
            script, "-o", out, "--size", 8, "--outputs", "distance,id", "--chunk", 2, "--far", 50
        ).exit_code
        == 0
    )
    other = capture_many(script, "-o", out, "--size", 4)
    assert other.exit_code == 1
    assert "size there 8, here 4" in other.output
    refused = capture_many(script, "-o", out, "--size", 4, "--no-resume")
    assert refused.exit_code == 1
    assert "expected no store of this name, or resume=True" in refused.output
    assert capture_many(script, "-o", out, "--size", 4, "--overwrite").exit_code == 0
    assert cc.open_batch(out).size == 4


def test_rotations_of_a_script(script, tmp_path, renderer):
    turns = np.random.default_rng(1).normal(size=(5, 4)).tolist()
    script.write_text(f"{SCRIPT}\nrotations = {turns}\n")
    assert capture_many(script, "-o", tmp_path / "a.zarr", "--size", 4).exit_code == 0
    want = renderer.capture_many(scene(), PLACES, 4, rotations=turns, format="rgba16f")
    batch = cc.open_batch(tmp_path / "a.zarr")
    np.testing.assert_array_equal(batch.faces[:], want.faces)
    np.testing.assert_array_equal(batch.rotations, turns)


@pytest.mark.parametrize("kind", ["npy", "csv", "csv with names"])
def test_positions_of_a_file(kind, script, tmp_path):
    places = np.array([[1.5, 2, 3], [-4, 5e-1, 6]])
    path = tmp_path / f"places.{kind[:3]}"
    if kind == "npy":
        np.save(path, places.astype(np.float32))
    else:
        head = "x,y,z\n" if "names" in kind else ""
        path.write_text(f"{head}1.5,2,3\n\n-4, 5e-1 ,6\n")
    result = capture_many(script, "-o", tmp_path / "a.zarr", "-p", path, "--size", 4)
    assert result.exit_code == 0, result.output
    np.testing.assert_array_equal(cc.open_batch(tmp_path / "a.zarr").positions, places)


def test_a_model_with_positions(tmp_path):
    np.save(tmp_path / "places.npy", [(0.0, 1.0, 2.0)])
    model = cc.sample_data("suzanne.glb")
    out = tmp_path / "a.zarr"
    result = capture_many(
        model, "-o", out, "-p", tmp_path / "places.npy", "-s", 8, "--outputs", "id"
    )
    assert result.exit_code == 0, result.output
    batch = cc.open_batch(out)[:]
    assert (batch.id > 0).any()
    assert batch.faces[..., :3].max() > 0.1  # it is lit
    alone = capture_many(model, "-o", tmp_path / "b.zarr")
    assert alone.exit_code == 1
    assert "--positions: expected with a model" in alone.output


def test_by_a_pool(script, tmp_path):
    for name, more in {"a": (), "b": ("--workers", 1)}.items():
        done = capture_many(script, "-o", tmp_path / f"{name}.zarr", "-s", 4, *more)
        assert done.exit_code == 0, done.output
    one, other = (cc.open_batch(tmp_path / f"{name}.zarr") for name in "ab")
    np.testing.assert_array_equal(one.faces[:], other.faces[:])


WRONG = {
    "no scene": ("positions = []", (), "expected a script that makes `scene`, a cc.Scene"),
    "another scene": ("scene = 3", (), "expected a script that makes `scene`, a cc.Scene, got int"),
    "no positions": (SCRIPT.replace("positions", "at"), (), "expected a script that makes `positions`, or --positions"),
    "bad positions": (SCRIPT + "positions = 'here'", (), "positions: expected"),
    "an error": ("1 / 0", (), "scene.py:1: ZeroDivisionError: division by zero"),
    "not Python": ("scene =", (), "scene.py:1: invalid syntax"),
    "two in a line": (SCRIPT, ("-p", "two.csv"), "two.csv:2: expected three numbers, got '1,2'"),
    "words": (SCRIPT, ("-p", "words.csv"), "words.csv:2: expected three numbers, got 'a,b,c'"),
    "another shape": (SCRIPT, ("-p", "flat.npy"), "expected numbers of shape (P, 3) in flat.npy, got float64 (3,)"),
    "objects": (SCRIPT, ("-p", "objects.npy"), "allow_pickle"),
    "no file": (SCRIPT, ("-p", "none.npy"), "No such file or directory: none.npy"),
    "another kind": (SCRIPT, ("-p", "a.txt"), "--positions: expected a .npy or a .csv file, got a.txt"),
    "an output": (SCRIPT, ("--outputs", "nothing"), "nothing"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_said_in_a_line(case, script, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "two.csv").write_text("1,2,3\n1,2\n")
    (tmp_path / "words.csv").write_text("x,y,z\na,b,c\n")
    np.save(tmp_path / "flat.npy", np.zeros(3))
    np.save(tmp_path / "objects.npy", np.array([[None] * 3]), allow_pickle=True)
    text, more, message = WRONG[case]
    script.write_text(text)
    result = capture_many("scene.py", "-o", "a.zarr", *more)
    assert result.exit_code == 1, result.output
    assert message in result.output
    assert len(result.output.splitlines()) == 1
    assert not (tmp_path / "a.zarr").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--workers", 2, "--scheduler", "tcp://a:1"), "expected without --scheduler"),
        (("--resources", "GPU=1"), "expected with --scheduler"),
        (("--resources", "GPU"), "expected names and numbers as GPU=1, got 'GPU'"),
        (("--resources", "GPU=x"), "expected a number, got 'x'"),
        (("--scheduler", "tcp://a:1", "--device", "gpu"), "expected without --scheduler"),
        (("--workers", 0), "expected a whole number of at least 1"),
    ],
)
def test_options_that_do_not_fit(arguments, message, script):
    result = capture_many(script, *arguments)
    assert result.exit_code == 2
    assert message in result.output


def test_a_file_of_another_kind(tmp_path):
    result = capture_many(tmp_path / "a.txt")
    assert result.exit_code == 1
    assert "expected a Python script (.py) or a scene (" in result.output


def test_without_zarr(script, monkeypatch):
    monkeypatch.setitem(sys.modules, "zarr", None)
    result = capture_many(script)
    assert result.exit_code == 1
    assert "pip install" in result.output
