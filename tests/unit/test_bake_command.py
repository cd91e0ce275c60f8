"""`cubecam bake`: the light of photographs and of places in scenes, for other programs."""

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc

GALLERY = cc.sample_data("gallery.glb")


def bake(*arguments):
    from cubecam.cli import app

    return CliRunner().invoke(app, ["bake", *[str(a) for a in arguments]])


def test_a_photograph_gives_the_files_of_save_for(tmp_path):
    result = bake("studio", "-o", tmp_path / "a", "--size", 32)
    assert result.exit_code == 0, result.output
    cube = cc.load_environment(cc.sample_data("studio.exr"), size=512).resize(32)
    wanted = cube.save_for("three", tmp_path / "b")
    assert result.output.splitlines()[:-1] == [str(tmp_path / "a" / path.name) for path in wanted]
    for path in wanted[:-1]:  # an EXR also holds the time at which it was written
        assert (cc.load_image(tmp_path / "a" / path.name) == cc.load_image(path)).all()
    assert (tmp_path / "a" / wanted[-1].name).read_bytes() == wanted[-1].read_bytes()
    assert result.output.splitlines()[-1] == "6 x 32 x 32 texels for three"


@pytest.mark.parametrize("program", ["three", "babylon", "unity", "godot", "blender", "filament"])
def test_every_program_has_files_and_a_readme(program, tmp_path):
    result = bake("forest", "--for", program, "-o", tmp_path / "a", "--size", 16)
    assert result.exit_code == 0, result.output
    names = {path.name for path in (tmp_path / "a").iterdir()}
    assert "README.txt" in names
    assert len(names) > 1


@pytest.mark.parametrize("at", [["--at", "head"], ["--at=-0.7,0.6,0.1"], []])
def test_a_scene_is_caught_at_a_node_a_point_or_in_its_middle(at, tmp_path, renderer):
    result = bake(GALLERY, *at, "--for", "unity", "-o", tmp_path, "--size", 32, "-e", "studio")
    assert result.exit_code == 0, result.output
    scene = cc.load_scene(GALLERY)
    scene.environment = cc.load_environment(cc.sample_data("studio.exr"), size=512)
    (head,) = scene.find("head")
    place = head.world_bounds.mean(axis=0) if "head" in at else (-0.7, 0.6, 0.1)
    place = place if at else scene.bounds.mean(axis=0)
    got = cc.load_environment(tmp_path / "environment.exr", size=32).faces[..., :3].astype(float)

    def agreeing(exclude):
        want = renderer.capture(scene, place, 32, samples=4, exclude=exclude, near=0.001, far=50)
        light = want.faces[..., :3]
        return (np.abs(got - light) < 0.05 * (1 + light)).mean()

    assert agreeing([head] if "head" in at else []) > 0.85  # the others lie on edges
    if "head" in at:
        # From within, parts of the head would be seen.
        assert agreeing([]) < agreeing([head]) - 0.01
    assert ("without head" in result.output) == ("head" in at)


REFUSED = {
    "missing": (["no.glb"], 1, "No such file or directory: no.glb"),
    "picture": (["no.exr"], 1, "no.exr"),
    "place": ([GALLERY, "--at", "table"], 1, "expected three numbers as 0,1.5,0, or one of room, floor"),
    "numbers": ([GALLERY, "--at", "1,b,2"], 2, "expected a number, got 'b'"),
    "at": (["studio", "--at", "0,0,0"], 2, "expected with a scene (.glb"),
    "environment": (["studio", "-e", "forest"], 2, "expected with a scene (.glb"),
    "program": (["studio", "--for", "maya"], 2, "maya"),
    "size": (["studio", "--size", "4"], 2, "expected a whole number of at least 8"),
}  # fmt: skip


@pytest.mark.parametrize(("arguments", "code", "text"), REFUSED.values(), ids=REFUSED)
def test_what_is_refused(arguments, code, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = bake(*arguments)
    assert result.exit_code == code, result.output
    assert text in " ".join(result.output.split())
    assert list(tmp_path.iterdir()) == []
