"""A part of `make fuzz`: each kind of file broken some hundred times, with fixed numbers."""

import pytest

import cubecam as cc
from tests.fuzz import files
from tests.fuzz.seeds import seeds


def kinds():
    return [*["obj", "mtl", "ply", "stl", "off", "glb", "gltf"], *files.PICTURES]


def test_every_kind_has_sound_files():
    assert sorted(seeds()) == sorted(kinds())


@pytest.mark.filterwarnings("ignore::cubecam.SceneWarning")  # they name files that are not there
@pytest.mark.parametrize("kind", kinds())
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


@pytest.mark.parametrize("kind", kinds())
def test_broken_files_are_an_error_or_are_read(kind, tmp_path):
    assert files.faults_in_process(kind, range(150), tmp_path) == []


@pytest.mark.parametrize(
    ("planted", "told"),
    [
        ("error", "KeyError: 'planted'"),
        ("slow", "took 1."),
        ("hang", "no answer within 4 s"),
        ("crash", "the process ended with status -11"),
        ("memory", "memory grew by 3"),
    ],
)
def test_faults_are_found_and_the_file_is_kept(tmp_path, planted, told):
    found = files.run("stl", 3, 0, tmp_path, seconds=1, planted=planted)
    assert len(found) == 1
    assert found[0].startswith(f"stl 1: {told}")
    assert [path.name for path in tmp_path.iterdir()] == ["1.stl"]
    assert (tmp_path / "1.stl").read_bytes() == files.broken("stl", 1)


def test_without_a_planted_fault_none_is_found(tmp_path):
    assert files.run("stl", 20, 0, tmp_path) == []
    assert list(tmp_path.iterdir()) == []
