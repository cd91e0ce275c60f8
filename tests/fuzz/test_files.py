"""A part of `make fuzz`: each kind of file broken some hundred times, with fixed numbers."""

import pytest

import cubecam as cc
from tests.fuzz import files
from tests.fuzz.runner import faults_of
from tests.fuzz.seeds import seeds
from tests.fuzz.targets import FILES


def test_every_kind_has_sound_files():
    assert sorted(seeds()) == sorted(FILES)


@pytest.mark.filterwarnings("ignore::cubecam.SceneWarning")  # they name files that are not there
@pytest.mark.parametrize("kind", FILES)
def test_the_unbroken_files_are_read(kind, tmp_path):
    for number, data in enumerate(seeds()[kind]):
        path = tmp_path / f"{number}.{kind}"
        path.write_bytes(data)
        if kind == "mtl":
            shape = tmp_path / "shape.obj"
            shape.write_bytes(files.OBJ_OF_MTL % path.name.encode())
            assert [node.material.name for node in cc.load_scene(shape) if node.material] == [
                "a",
                "b c",
            ]
        elif kind not in files.PICTURES:
            assert len(cc.load_mesh(path).indices) > 0
            assert any(node.mesh for node in cc.load_scene(path))
        elif kind == "dds" and number != 4:  # that one is a picture, not a cubemap
            assert cc.load_cubemap(path).size == (4 if number < 4 else 8)
        elif kind == "ktx2" and number < 3:
            assert len(cc.load_cubemap(path).levels) == 2
        else:
            assert cc.load_image(path).ndim == 3


@pytest.mark.parametrize("kind", FILES)
def test_broken_files_are_an_error_or_are_read(kind, tmp_path):
    target = files.target(kind)
    for number in range(150):
        assert faults_of(target, target.make(number), tmp_path) == [], number
