"""The sample files: what there is, what their documents say of them, and how large they are."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import load_script

ROOT = Path(__file__).resolve().parents[2]
FOLDER = cc.sample_data("bunny.obj").parent
PHOTOGRAPHS = [name for name in cc.sample_data() if name.endswith(".exr")]
SCENE = "gallery.glb"
MESHES = [name for name in cc.sample_data() if not name.endswith(".exr") and name != SCENE]
CREDITS = (FOLDER / "CREDITS.md").read_text(encoding="utf-8")


def cells(text, name):
    """The last line of a table that starts with `name`, as a list of its cells."""
    return [
        [cell.strip() for cell in re.split(r"\||\s{2,}", line.strip().strip("|"))]
        for line in text.splitlines()
        if line.strip().strip("| ").startswith(name)
    ][-1]


def test_the_list_is_the_folder():
    other = {"CREDITS.md", "__init__.py", "__pycache__"}
    assert set(cc.sample_data()) == {path.name for path in FOLDER.iterdir()} - other
    assert len(PHOTOGRAPHS) == 6
    assert len(MESHES) == 3


@pytest.mark.parametrize("name", cc.sample_data())
def test_each_name_is_a_file_with_a_credit_and_a_line_of_the_docstring(name):
    assert cc.sample_data(name).is_file()
    assert name in CREDITS
    assert name in (cc.sample_data.__doc__ or "")


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_photographs_hold_what_the_documents_say(name):
    pixels = cc.load_image(cc.sample_data(name))
    assert pixels.shape == (512, 1024, 3)
    assert pixels.dtype == np.float16
    assert np.isfinite(pixels).all()
    assert pixels.min() >= 0
    peak = float(pixels.max())
    size = cc.sample_data(name).stat().st_size
    _, kilobytes, highest, *_ = cells(CREDITS, name)
    assert (round(size / 1000), float(highest.replace(",", ""))) == (int(kilobytes), peak)
    *_, stated = cells(cc.sample_data.__doc__, name)
    assert float(stated.replace(",", "")) == pytest.approx(peak, rel=1e-3)


def test_the_scene_is_what_its_script_makes():
    script = load_script("gallery")
    made, read = script.build(), cc.load_scene(cc.sample_data(SCENE))
    assert [node.name for node in read.nodes] == [node.name for node in made.nodes]
    for one, other in zip(read.nodes, made.nodes, strict=True):
        assert np.allclose(one.world_matrix, other.world_matrix, atol=1e-6)
    assert [animation.duration for animation in read.animations] == [8]
    cameras: Any = read.cameras
    lights: Any = read.lights
    assert [camera.parent.name for camera in cameras] == ["view"]
    assert [light.parent.name for light in lights] == ["bulb"]
    assert cc.sample_data(SCENE).stat().st_size < 200_000


@pytest.mark.parametrize("name", MESHES)
def test_meshes_hold_what_the_documents_say(name):
    mesh = cc.load_mesh(cc.sample_data(name))
    _, _, vertices, triangles, size = cells(cc.sample_data.__doc__, name)
    assert len(mesh.positions) == int(vertices.replace(",", ""))
    assert len(mesh.indices) == int(triangles.replace(",", ""))
    extent = np.ptp(mesh.positions, axis=0)
    np.testing.assert_allclose([float(x) for x in size.split(",")], extent, atol=0.06)


def test_the_files_leave_room_in_a_wheel_of_5_megabytes():
    assert sum(cc.sample_data(name).stat().st_size for name in cc.sample_data()) < 2.4e6


def test_suzanne_looks_along_z():
    """The nose, the foremost part of the head, is on +Z; the ears are on the sides, the crown is up."""
    positions = cc.load_mesh(cc.sample_data("suzanne.glb"), size=2).positions
    nose = positions[positions[:, 2].argmax()]
    assert abs(nose[0]) < 0.3
    assert np.ptp(positions, axis=0).argmax() == 0


@pytest.mark.parametrize(
    ("name", "near"),
    [("sunst.exr", "sunset.exr"), ("suzanne.obj", "suzanne.glb"), ("bunny", "bunny.obj")],
)
def test_unknown_names_are_refused_with_the_list_and_a_near_name(name, near):
    with pytest.raises(ValueError, match=f"courtyard.exr, .*teapot.obj; got '{name}'") as caught:
        cc.sample_data(name)
    assert str(caught.value).endswith(f"did you mean '{near}'?")


def test_names_that_are_near_to_none_get_no_proposal():
    with pytest.raises(ValueError, match=r"teapot\.obj; got 'qqq'$"):
        cc.sample_data("qqq")
