"""Pictures of a scene and of what load_scene makes of its file."""

import json

import numpy as np
import pytest

import cubecam as cc
from tests.gltf_files import GltfFile
from tests.saved_scenes import KINDS, mesh, scene_of
from tests.scenes_equal import assert_scenes_equal


def picture(renderer, scene):
    """Draw a scene from its first camera, or from one that sees all of it."""
    camera = cc.PerspectiveCamera(position=(4, 3, 9), target=(0, 0, 0))
    camera.fit(scene)
    frame = renderer.render(scene, camera, size=(48, 32), format="rgba32f", outputs=["label"])
    return frame.color, frame.label


@pytest.mark.parametrize("kind", KINDS)
def test_pictures_are_equal(kind, renderer, tmp_path):
    scene = scene_of(kind)
    if not scene.nodes or not any(n.mesh for n in scene.nodes):
        scene.add(mesh(), cc.StandardMaterial())
    scene.save(tmp_path / "x.glb")
    again = cc.load_scene(tmp_path / "x.glb")
    for number in (None, *range(len(scene.animations))):
        if number is not None:
            scene.set_time(0.7, number)
            again.set_time(0.7, number)
        for got, want in zip(picture(renderer, again), picture(renderer, scene), strict=True):
            # The last bits of uvs that are small numbers.
            np.testing.assert_allclose(got, want, rtol=1e-5, atol=1e-5)


def test_each_variant_is_drawn_again(renderer, tmp_path):
    scene = scene_of("variants")
    scene.add(cc.AmbientLight())
    scene.environment = cc.CubeMap(np.ones((6, 4, 4, 3), np.float32))
    for index, node in enumerate(scene.nodes):
        node.mesh, node.position = cc.Mesh.sphere(), (3 * index, 0, 0)
    scene.save(tmp_path / "x.glb")
    again = cc.load_scene(tmp_path / "x.glb")
    assert again.variant == "night"
    seen = set()
    for variant in (None, *scene.variants):
        scene.variant = again.variant = variant
        got, want = picture(renderer, again)[0], picture(renderer, scene)[0]
        np.testing.assert_array_equal(got, want)
        seen.add(got.tobytes())
    assert len(seen) == len(scene.variants) + 1


def test_other_programs_see_a_mirror_as_smooth_metal(renderer, tmp_path):
    """The file without the mark of cubecam's extras, as others read it."""
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(), cc.MirrorMaterial(tint=(1, 0.5, 0.25)))
    scene.save(tmp_path / "x.gltf")
    tree = json.loads((tmp_path / "x.gltf").read_text())
    del tree["extras"]
    (tmp_path / "x.gltf").write_text(json.dumps(tree))
    again = cc.load_scene(tmp_path / "x.gltf")
    assert isinstance(again.nodes[0].material, cc.StandardMaterial)
    sky = cc.CubeMap(np.random.default_rng(1).random((6, 8, 8, 3)).astype(np.float32))
    scene.environment = again.environment = sky
    camera = cc.PerspectiveCamera(position=(0, 0, 4))
    got, want = (
        renderer.render(s, camera, size=(32, 32), format="rgba32f").color for s in (again, scene)
    )
    middle = (slice(12, 20), slice(12, 20))
    # Metal reflects a little more at grazing angles (Schlick).
    assert np.abs(got[middle] - want[middle]).max() < 0.08


@pytest.mark.parametrize("name", ["suzanne.glb", "bunny.obj"])
def test_samples_do_not_drift(name, tmp_path):
    first = cc.load_scene(cc.sample_data(name))
    first.save(tmp_path / "a.glb")
    second = cc.load_scene(tmp_path / "a.glb")
    assert_scenes_equal(second, first)
    second.save(tmp_path / "b.glb")
    assert_scenes_equal(cc.load_scene(tmp_path / "b.glb"), first)


def test_a_file_of_others_keeps_what_cubecam_reads(tmp_path):
    """Several primitives, a quad without normals, integer uvs, a matrix, a mirrored node."""
    file = GltfFile()
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    uvs = file.accessor(
        np.array([[0, 0], [255, 0], [255, 255], [0, 255]], np.uint8), normalized=True
    )
    primitives = [
        file.primitive(square, np.array([0, 1, 2, 0, 2, 3], np.uint8), TEXCOORD_0=uvs),
        file.primitive(square + 2, np.array([0, 1, 2], np.uint16)),
    ]
    pair = file.mesh(*primitives, name="pair")
    file.node(mesh=pair, scale=[-1, 1, 2], name="left")
    file.node(mesh=pair, matrix=[1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1])
    (tmp_path / "a.glb").write_bytes(file.glb())
    first = cc.load_scene(tmp_path / "a.glb")
    first.save(tmp_path / "b.glb")
    assert_scenes_equal(cc.load_scene(tmp_path / "b.glb"), first)
