"""Translucent nodes: sorting, blending with a separate alpha, agreement of the faces, the outputs they write."""

import itertools

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.panes import LAYERS, UPRIGHT, front, pane
from tests.reference.compositing import composite


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
@pytest.mark.parametrize("background", [(0, 0, 0, 0), (0.3, 0.6, 0.9, 1), (0.5, 0.5, 0.5, 0.5)])
def test_panes_are_composited_from_far_to_near(renderer, order, background):
    scene = cc.Scene(background=background)
    for index in order:
        pane(scene, *LAYERS[index])
    want = composite(background, *[(*color, alpha) for color, alpha, _ in reversed(LAYERS)])
    color = front(scene)(renderer).color
    assert_close(color, np.broadcast_to(want, color.shape), "blend")


@pytest.mark.parametrize("depth", [-1, -2.5, -3.5, -9])
def test_an_opaque_wall_hides_what_is_behind_it_only(renderer, depth):
    scene = cc.Scene(background=(0, 0, 0, 0))
    for layer in LAYERS:
        pane(scene, *layer)
    pane(scene, (1, 1, 0), 1, depth)
    seen = [(*color, alpha) for color, alpha, z in reversed(LAYERS) if z > depth]
    color = front(scene)(renderer).color
    assert_close(color, np.broadcast_to(composite((1, 1, 0, 1), *seen), color.shape), "blend")


@pytest.mark.parametrize(
    "make",
    [
        lambda: cc.BasicMaterial(color=(1, 0, 0, 0.5)),
        lambda: cc.BasicMaterial(color=(1, 0, 0), opacity=0.5),
        lambda: cc.BasicMaterial(color=(1, 0, 0, 0.625), opacity=0.8),
        lambda: cc.BasicMaterial(map=np.full((2, 2, 4), (1, 0, 0, 0.5), np.float32)),
        lambda: cc.PhongMaterial(color=(5, 0, 0, 0.5)),
    ],
    ids=["fourth number", "opacity", "both", "map", "phong"],
)
def test_every_source_of_alpha(renderer, make):
    """The color of a Phong material without a light is ka * color = 0.2 * 5."""
    scene = cc.Scene(background=(0, 0, 1, 1))
    scene.add(cc.Mesh.plane(20, 20), make(), position=(0, 0, -2), rotation=UPRIGHT)
    color = front(scene)(renderer).color
    assert_close(color, np.broadcast_to([0.5, 0, 0.5, 1], color.shape), "blend")


def test_vertex_alpha(renderer):
    scene = cc.Scene(background=(0, 0, 1, 1))
    plane = cc.Mesh.plane(20, 20)
    mesh = cc.Mesh(
        plane.positions, plane.indices, colors=np.full((len(plane.positions), 4), (1, 0, 0, 0.25))
    )
    scene.add(mesh, cc.BasicMaterial(vertex_colors=True), position=(0, 0, -2), rotation=UPRIGHT)
    color = front(scene)(renderer).color
    assert_close(color, np.broadcast_to([0.25, 0, 0.75, 1], color.shape), "blend")


@pytest.mark.parametrize("make", [cc.MirrorMaterial, cc.GlassMaterial])
def test_mirrors_and_glass_have_opacity_too(renderer, make):
    scene = cc.Scene(
        environment=cc.CubeMap(np.ones((6, 2, 2, 3), np.float32)), background=(0, 0, 1, 1)
    )
    scene.add(cc.Mesh.plane(20, 20), make(opacity=0.25), position=(0, 0, -2), rotation=UPRIGHT)
    color = front(scene)(renderer).color
    assert_close(color, np.broadcast_to([0.25, 0.25, 1, 1], color.shape), "blend")


def test_opaque_surfaces_write_alpha_1(renderer):
    scene = cc.Scene()
    pane(scene, (0.5, 0.5, 0.5), 1, -2)
    assert (front(scene)(renderer).color[..., 3] == 1).all()


def test_only_opaque_nodes_write_the_other_outputs(renderer):
    scene = cc.Scene()
    pane(scene, (1, 0, 0), 0.5, -2)
    wall = pane(scene, (0, 1, 0), 1, -5)
    frame = front(scene)(renderer, outputs=("id", "z", "normal", "position", "distance"))
    assert (frame.id == wall.id).all()
    np.testing.assert_allclose(frame.z, 5, rtol=1e-5)
    np.testing.assert_allclose(frame.position[..., 2], -5, rtol=1e-5)
    scene.remove(wall)
    frame = front(scene)(renderer, outputs=("id", "z"))
    assert not frame.id.any()
    assert np.isinf(frame.z).all()


def test_ties_are_drawn_in_order_of_ids(renderer):
    """Two panes are at one place: depth writes are off, so the pane with the higher id is drawn over the other."""
    for first, second in (((1, 0, 0), (0, 1, 0)), ((0, 1, 0), (1, 0, 0))):
        scene = cc.Scene(background=(0, 0, 0, 1))
        pane(scene, first, 0.5, -2)
        pane(scene, second, 0.5, -2)
        color = front(scene)(renderer).color
        want = composite((0, 0, 0, 1), (*first, 0.5), (*second, 0.5))
        assert_close(color, np.broadcast_to(want, color.shape), "blend")


def test_sorting_goes_by_the_distance_of_the_centers_not_by_depth(renderer):
    """The six faces agree, because nodes are sorted by distance from the eye, not by depth along each face's axis.

    Two long panes cross the edge between two faces; sorted by the z of each face, their order would differ."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    near = scene.add(
        cc.Mesh.box((8, 1, 0.01)),
        cc.BasicMaterial(color=(1, 0, 0), opacity=0.5, double_sided=True),
        position=(2.5, 0, -2),
    )
    far = scene.add(
        cc.Mesh.box((8, 1, 0.01)),
        cc.BasicMaterial(color=(0, 1, 0), opacity=0.5, double_sided=True),
        position=(-3, 0, -2.2),
    )
    assert np.linalg.norm(near.position) < np.linalg.norm(far.position)
    cube = renderer.capture(scene, size=33)
    # Straight ahead each box shows two walls; the near box is drawn over the far box as a whole.
    want = composite((0, 0, 0, 1), (0, 1, 0, 0.5), (0, 1, 0, 0.5), (1, 0, 0, 0.5), (1, 0, 0, 0.5))
    assert_close(cube.faces[5, 16, 16], want, "blend")
    assert cube.faces[0, 16].any()


@pytest.mark.parametrize("opacity", [0.0, 0.5])
def test_capture_equals_frame(any_path, opacity):
    """The -Z face equals the frame of a camera that looks along -Z, except that faces are mirrored."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
    for color, alpha, z in LAYERS:
        scene.add(
            cc.Mesh.box((1, 1, 0.1)),
            cc.BasicMaterial(color=color, opacity=alpha * opacity),
            position=(z / 9, 0, z),
        )
    cube = any_path.capture(scene, size=16)
    camera = cc.PerspectiveCamera(
        fov=90, position=(0, 0, 0), target=(0, 0, -1), near=0.05, far=1000
    )
    frame = any_path.render(scene, camera, (16, 16), format="rgba32f")
    assert_close(cube.faces[5], frame.color[:, ::-1], "blend")


def test_opacity_0_draws_nothing_in_color(renderer):
    scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
    before = front(scene)(renderer).color
    pane(scene, (1, 0, 0), 0, -2)
    assert_identical(front(scene)(renderer).color, before)
