"""Blending, backgrounds and surroundings as the renderer shows them."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.scene.snapshot import read
from tests.compare import assert_close
from tests.gl.world import smooth_environment
from tests.reference import transforms as ref
from tests.truth.rays import FRONT as CAMERA
from tests.truth.rays import one

BACKGROUNDS: dict[str, Any] = {
    "none": {},
    "color": {"background": (0.2, 0.4, 3, 0.5)},
    "environment": {
        "environment": cc.CubeMap(smooth_environment(16)),
        "environment_intensity": 1.5,
        "environment_rotation": cc.axis_angle((1, 2, 3), 70),
    },
    "translucent cube": {
        "environment": cc.CubeMap(smooth_environment(2)),
        "environment_intensity": 1.5,
        "environment_rotation": cc.axis_angle((1, 2, 3), 70),
        "background": cc.CubeMap(
            np.concatenate([smooth_environment(16), np.full((6, 16, 16, 1), 0.25)], axis=-1)
        ),
    },
    "grey cube": {"background": cc.CubeMap(smooth_environment(16)[..., :1])},
}


@pytest.mark.parametrize("name", BACKGROUNDS)
def test_backgrounds_are_as_the_renderer_shows_them(renderer, name):
    scene = cc.Scene(**BACKGROUNDS[name])
    frame = renderer.render(scene, CAMERA, (24, 16), format="rgba32f")
    _, directions = ref.pixel_rays(CAMERA.view, CAMERA.projection(1.5), (24, 16))
    got = read(scene).background.at(directions.reshape(-1, 3)).reshape(16, 24, 4)
    assert_close(got, frame.color, "sky")


def test_surroundings_are_those_of_the_node():
    scene, node = one(cc.MirrorMaterial())
    scene.environment = cc.CubeMap(smooth_environment(4))
    scene.background = (0.1, 0.2, 0.3)
    other = scene.add(cc.Mesh.box(1), cc.MirrorMaterial())
    last = scene.add(cc.Mesh.box(1), cc.MirrorMaterial())
    other.environment = last.environment = cc.CubeMap(np.full((6, 1, 1, 3), 0.5, np.float32))
    scene.add(cc.Mesh.box(1), cc.MirrorMaterial(), environment=cc.Probe())
    found = read(scene)
    up = np.array([[0, 1.0, 0]])
    seen = [found.surroundings[each.surroundings].at(up)[0].tolist() for each in found.nodes]
    np.testing.assert_allclose(seen[0][:3], scene.environment.sample((0, 1, 0)))
    assert seen[1] == seen[2] == [0.5, 0.5, 0.5, 1]
    np.testing.assert_allclose(seen[3], (0.1, 0.2, 0.3, 1), rtol=1e-6)
    assert found.nodes[1].surroundings == found.nodes[2].surroundings
    assert node.id == found.nodes[0].id


BLENDS = [
    "alpha",
    "alpha_keep",
    "additive",
    "multiply",
    "premultiplied",
    cc.Blend("src_alpha", "one_minus_src_color"),
    cc.Blend("one_minus_src_alpha", "src_alpha", src_alpha="one", dst_alpha="one_minus_src_alpha"),
    cc.Blend("src_color", "src_color", src_alpha="src_alpha_saturate", dst_alpha="zero"),
    cc.Blend("zero", "one_minus_src_color", src_alpha="one_minus_src_color"),
]


@pytest.mark.parametrize("blend", BLENDS, ids=str)
def test_blending_is_that_of_the_renderer(renderer, blend):
    picture = np.full((1, 1, 4), (0.9, 0.3, 0.6, 0.8), np.float32)
    color = np.array((0.5, 0.7, 0.4, 0.6))
    scene, _ = one(cc.BasicMaterial(color=color, map=picture, opacity=0.75, blend=blend))
    behind = np.array((0.2, 0.8, 0.5, 0.7))
    scene.background = behind
    got = renderer.render(scene, CAMERA, (9, 9), format="rgba32f").color[4, 4]
    record = read(scene).nodes[0]
    np.testing.assert_allclose(record.opacity, 0.45, rtol=1e-6)
    s = (color[:3] * picture[0, 0, :3].astype(float))[None]
    a = np.array([[0.45 * 0.8]])
    assert record.blend is not None
    plus, times = record.blend.terms(s, a, record.opacity)
    assert plus.shape == times.shape == (1, 4)
    assert_close(plus[0] + times[0] * behind, got, "blend")


@pytest.mark.parametrize(
    ("material", "blended"),
    [
        (cc.PhongMaterial(), False),
        (cc.PhongMaterial(opacity=0.9), True),
        (cc.PhongMaterial(opacity=0.9, blend="opaque"), False),
        (cc.PhongMaterial(map=np.full((2, 2, 4), 0.5)), True),
        (cc.PhongMaterial(map=np.full((2, 2, 4), 1.0)), False),
        (cc.PhongMaterial(map=np.full((2, 2, 4), 254, np.uint8)), True),
        (cc.MirrorMaterial(tint=(1, 1, 1, 0.5)), True),
        (cc.GlassMaterial(tint=(1, 1, 1, 0.5)), True),
        (cc.StandardMaterial(color=(1, 1, 1, 0.5)), True),
        (cc.StandardMaterial(color=(1, 1, 1, 0.5), alpha_mode="opaque"), False),
        (cc.StandardMaterial(color=(1, 1, 1, 0.5), alpha_mode="mask"), False),
        (cc.StandardMaterial(alpha_mode="mask", opacity=0.5), True),
        (cc.StandardMaterial(alpha_mode="blend"), True),
        (cc.StandardMaterial(map=cc.Texture(np.full((2, 2, 4), 0.5), scale=(2, 2))), True),
    ],
    ids=str,
)
def test_what_is_blended(renderer, material, blended):
    scene, node = one(material)
    record = read(scene).nodes[0]
    assert (record.blend is not None) == blended
    assert record.casts_shadow != blended
    # Blended surfaces write no id.
    shown = renderer.render(scene, CAMERA, (3, 3), outputs=("id",)).id[1, 1]
    assert shown == (0 if blended else node.id)


def test_vertex_colors_blend_where_they_count():
    for used in (False, True):
        scene, node = one(cc.PhongMaterial(vertex_colors=used))
        colors = np.full((4, 4), 0.5, np.float32)
        node.mesh.colors = colors
        found = read(scene)
        assert (found.nodes[0].blend is not None) == used
        assert np.all(found.colors == (0.5 if used else 1))
