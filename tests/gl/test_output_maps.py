"""Panoramas, layouts and files of what a capture saw, against the ray caster along the directions of the texels."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import OUTPUTS, capture_hits, room
from tests.reference.cube_faces import direction_to_face_uv
from tests.reference.equirect import pixel_directions
from tests.reference.raycast import interior

SIZE = 32
WIDTH = 96


@pytest.fixture(scope="module")
def seen(shared_renderers):
    """(captured cube, hits of the ray caster along the texels)."""
    world = room()
    renderer = shared_renderers(None)
    cube = renderer.capture(world.scene, size=SIZE, outputs=(*OUTPUTS, "depth"))
    return cube, capture_hits(world, (0, 0, 0), SIZE)


def nearest(values, center="-z"):
    """The values at the texels that the pixels of a panorama meet."""
    face, s, t = direction_to_face_uv(pixel_directions(WIDTH, WIDTH // 2, center))
    row, column = (np.clip((x * SIZE).astype(int), 0, SIZE - 1) for x in (t, s))
    return values[face, row, column]


@pytest.mark.parametrize("center", ["-z", "+z", "+x", "-x"])
def test_panoramas_show_what_rays_meet(seen, center):
    cube, hits = seen
    mask = nearest(interior(hits.id), center)
    assert mask.mean() > 0.5
    for name, want, tolerance in (
        ("id", hits.id, "exact"),
        ("distance", hits.distance, "distance"),
        ("z", hits.t, "distance"),
        ("position", hits.position, "position"),
    ):
        got = cube.to_equirect(width=WIDTH, center=center, output=name)
        assert_close(got, nearest(want, center), tolerance, mask=mask, name=name)


def test_a_ray_of_the_panorama_ends_at_its_position(seen):
    """Positions are of the world, so they lie along the pixel's direction, a texel beside it at most."""
    cube, _ = seen
    position = cube.to_equirect(width=WIDTH, output="position").astype(float)
    distance = cube.to_equirect(width=WIDTH, output="distance")
    known = np.isfinite(distance)
    assert known.mean() > 0.3
    length = np.linalg.norm(position[known], axis=-1)
    np.testing.assert_allclose(length, distance[known], rtol=1e-4)
    along = (position[known] / length[:, None] * pixel_directions(WIDTH, WIDTH // 2)[known]).sum(-1)
    assert along.min() > np.cos(1.5 * np.sqrt(2) / SIZE)


def test_no_number_is_new(seen):
    cube, _ = seen
    for name, values in cube.outputs.items():
        for made in (
            cube.to_equirect(width=WIDTH, output=name),
            cube.resize(11).outputs[name],
            cube.to_layout("row", output=name),
            cube.sample(pixel_directions(10, 5), output=name),
        ):
            assert made.dtype == values.dtype
            held = np.unique(values.view(f"u{values.itemsize}"))
            assert np.isin(np.unique(np.ascontiguousarray(made).view(held.dtype)), held).all(), name
    assert set(np.unique(cube.to_equirect(output="id"))) == set(np.unique(cube.id))


def test_distances_of_a_ball_and_its_background(renderer):
    """A ball of radius 1 at a distance of 4: from 3 to its silhouette at sqrt(15), and infinity."""
    scene = cc.Scene()
    ball = scene.add(cc.Mesh.sphere(1, 64, 48), cc.BasicMaterial(), position=(0, 0, -4))
    cube = renderer.capture(scene, size=64, outputs=("distance", "id"))
    panorama = cube.to_equirect(width=256, output="distance")
    assert panorama.shape == (128, 256)
    seen = np.isfinite(panorama)
    assert 3 - 1e-3 <= panorama[seen].min() < 3.01
    assert panorama[seen].max() <= 15**0.5 + 1e-2
    assert np.isposinf(panorama[~seen]).all()
    assert_identical(seen, cube.to_equirect(width=256, output="id") == ball.id)
    assert seen[64, 128]


def test_outputs_of_a_shader(renderer):
    """An output that GLSL declares is looked up like any other."""
    material = cc.ShaderMaterial(
        "out vec4 heat; vec3 shade(Surface surface) { heat = vec4(0.25, 0.5, 0.75, 2.0); return vec3(1.0); }"
    )
    scene = cc.Scene()
    scene.add(cc.Mesh.box((2, 2, 2)), material, position=(0, 0, -3))
    cube = renderer.capture(scene, size=16, outputs=("heat",))
    heat = cube.to_equirect(output="heat")
    assert heat.shape == (32, 64, 4)
    assert heat[16, 32].tolist() == [0.25, 0.5, 0.75, 2.0]
    assert set(map(tuple, heat.reshape(-1, 4).tolist())) == {(0.25, 0.5, 0.75, 2.0), (0.0,) * 4}
