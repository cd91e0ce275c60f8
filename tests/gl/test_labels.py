"""Labels of nodes and the output "label". The ray caster of test_capture.py and test_frames.py has them, too."""

import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS, label_of, perspective, room

PLACE = ((0.2, 0.1, -0.1), (2, 0.2, 1))


def test_the_label_of_the_visible_node_shows(any_path):
    world, view = room(), perspective(*PLACE)
    frame = any_path.render(world.scene, view.camera, view.size, outputs=("id", "label"))
    assert len(np.unique(frame.label)) > 3
    np.testing.assert_array_equal(frame.label, label_of(frame.id))
    assert_identical(frame.outputs["label"], frame.label)


def test_layered_and_one_pass_are_equal(shared_renderers):
    one, other = (
        shared_renderers(path).capture(room().scene, size=24, outputs=OUTPUTS)
        for path in (None, False)
    )
    assert_identical(one.label, other.label)
    np.testing.assert_array_equal(one.label, label_of(one.id))


def test_samples_do_not_mix_labels(any_path):
    world, view = room(), perspective(*PLACE)
    one, four = (
        any_path.render(world.scene, view.camera, view.size, outputs="label", samples=samples)
        for samples in (1, 4)
    )
    assert_identical(one.label, four.label)


def test_a_node_of_label_0_hides_what_is_behind_it(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(9), cc.BasicMaterial(), position=(0, 0, -9), label=3)
    scene.add(cc.Mesh.box(), cc.BasicMaterial(), position=(0, 0, -2))
    label = renderer.render(scene, cc.PerspectiveCamera(), (9, 9), outputs="label").label
    assert label[4, 4] == 0
    assert label[0, 0] == 3


def test_blended_nodes_write_no_label(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), cc.BasicMaterial(opacity=0.5), position=(0, 0, -2), label=3)
    frame = renderer.render(scene, cc.PerspectiveCamera(), (5, 5), outputs="label")
    assert not frame.label.any()


def test_a_users_shader_has_labels(any_path):
    scene = cc.Scene()
    source = "vec3 shade(Surface s) { return s.normal; }"
    scene.add(cc.Mesh.box(), cc.ShaderMaterial(source), position=(0, 0, -2), label=-7)
    frame = any_path.render(scene, cc.PerspectiveCamera(), (5, 5), outputs=("label", "id"))
    assert (frame.label[2, 2], frame.id[2, 2]) == (-7, 1)


def test_a_users_shader_cannot_declare_it(renderer):
    scene = cc.Scene()
    source = "out float label; vec3 shade(Surface s) { label = 1.0; return s.normal; }"
    scene.add(cc.Mesh.box(), cc.ShaderMaterial(source), position=(0, 0, -2))
    with pytest.raises(ValueError, match=r'name that is not one of .*"label"'):
        renderer.render(scene, cc.PerspectiveCamera(), (5, 5), outputs="label")


def test_only_pictures_with_labels_are_drawn_again(fresh_renderer):
    world, view = room(), perspective(*PLACE)

    def drawn(**options):
        fresh_renderer.render(world.scene, view.camera, view.size, **options)
        return fresh_renderer.stats.views_drawn

    pictures: list[dict[str, Any]] = [
        {},
        {"outputs": ("id", "normal")},
        {"outputs": ("label",)},
        {"outputs": OUTPUTS},
    ]
    assert [drawn(**options) for options in pictures] == [1, 1, 1, 1]
    node = world.scene.nodes[2]
    before = node.label
    node.label = 77
    assert [drawn(**options) for options in pictures] == [0, 0, 1, 1]
    node.label = 77
    assert [drawn(**options) for options in pictures] == [0, 0, 0, 0]
    node.label = before
    assert [drawn(**options) for options in pictures] == [0, 0, 1, 1]


def test_of_a_capture_only_the_faces_that_see_the_node(fresh_renderer):
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box(1.5), position=(3, 0, 0), label=1)
    fresh_renderer.capture(scene, size=8, outputs="label")
    node.label = 2
    cube = fresh_renderer.capture(scene, size=8, outputs="label")
    assert fresh_renderer.stats.views_drawn == 1
    assert set(np.unique(cube.label)) == {0, 2}


def test_a_crowd_is_drawn_in_one_call_whatever_its_labels(renderer, rng):
    scene, mesh, material = cc.Scene(), cc.Mesh.box(0.2), cc.BasicMaterial()
    labels = rng.integers(-(2**31), 2**31, 200)
    for label in labels:
        place = (*rng.uniform(-3, 3, 2), -5)
        scene.add(mesh, material, position=place, label=label)
    frame = renderer.render(scene, cc.PerspectiveCamera(), (64, 64), outputs=("id", "label"))
    assert renderer.stats.draw_calls == 1
    want = np.concatenate([[0], labels])[frame.id]
    np.testing.assert_array_equal(frame.label, want)


def test_results_pickle(renderer):
    cube = renderer.capture(room().scene, size=8, outputs=("label",))
    assert_identical(pickle.loads(pickle.dumps(cube)).label, cube.label)
