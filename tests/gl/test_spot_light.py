"""Spot lights against numpy: the cone of KHR_lights_punctual."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close
from tests.gl.world import World, capture_hits, inner, perspective

CONES = {
    "sharp": {"angle": 30},
    "soft": {"angle": 35, "penumbra": 0.3},
    "all penumbra": {"angle": 50, "penumbra": 1},
    "narrow": {"angle": 5, "penumbra": 0.5},
    "wide": {"angle": 89, "penumbra": 0.1},
    "decaying": {"angle": 40, "penumbra": 0.4, "decay": 2},
    "with a range": {"angle": 40, "penumbra": 0.4, "range": 3.3},
}
PLACE, WAY = (0.5, 3, 1), (-0.5, -2, -0.2)


def room(number=1):
    world = World()
    options = {"color": (0.5, 0.7, 1), "material": cc.PhongMaterial(color=(0.5, 0.7, 1))}
    world.plane(8, 8, **options)
    world.box((1, 0.6, 0.8), position=(0.6, 0.3, -0.2), degrees=30, **options)
    return world


def want(hits, eye, lights):
    color = shading.phong(hits.position, hits.normal, eye, (0.5, 0.7, 1), lights)
    return np.where(hits.hit[..., None], color, 0)


def away_from_the_edge(hits, light):
    """The pixels away from the cone's edge, which may fall on either side of a pixel's centre."""
    to_light, _ = shading.way_to(light, hits.position)
    cosine = shading.dot(-to_light, normalised(light.travels))[..., 0]
    return np.abs(cosine - np.cos(np.radians(light.angle))) > 1e-3


@pytest.mark.parametrize("options", CONES.values(), ids=CONES)
def test_a_frame(renderer, options):
    world, view = room(), perspective((2, 3, 4), (0, 0.3, 0))
    world.scene.add(cc.SpotLight(PLACE, WAY, **options))
    light = shading.Spot(PLACE, WAY, **options)
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    mask = inner(hits) & hits.hit & away_from_the_edge(hits, light)
    share = light.share(shading.way_to(light, hits.position)[0])[..., 0][mask]
    assert (share > 0).any()
    assert (share == 0).any() or options["angle"] == 89
    assert_close(frame.color[..., :3], want(hits, view.eye, [light]), "phong", mask=mask)


@pytest.mark.parametrize("count", [2, 6])
def test_beside_other_lights_in_a_capture(any_path, count):
    """Other kinds of light have no cone; with six lights the shader reads them from their block."""
    world = room()
    ours = [
        cc.SpotLight(PLACE, WAY, angle=35, penumbra=0.6, color=(1, 0.5, 0.2), intensity=0.8),
        cc.PointLight((2, 3, -1)),
    ]
    theirs = [shading.Spot(PLACE, WAY, 35, 0.6, (1, 0.5, 0.2), 0.8), shading.Point((2, 3, -1))]
    for x in range(count - 2):
        ours += [cc.DirectionalLight((x, -1, 1), intensity=0.1)]
        theirs += [shading.Directional((x, -1, 1), intensity=0.1)]
    for light in ours:
        world.scene.add(light)
    position = (-0.4, 1.5, 0.6)
    cube = any_path.capture(world.scene, position=position, size=32)
    hits = capture_hits(world, position, 32)
    mask = inner(hits) & hits.hit
    assert_close(cube.faces[..., :3], want(hits, position, theirs), "phong", mask=mask)


def test_a_wide_cone_is_a_point_light_within_it(renderer):
    world, view = room(), perspective((2, 3, 4), (0, 0.3, 0))
    spot = world.scene.add(cc.SpotLight(PLACE, (0, -1, 0), angle=89.9))
    got = renderer.render(world.scene, view.camera, view.size, format="rgba32f").color
    world.scene.remove(spot)
    world.scene.add(cc.PointLight(PLACE))
    same = renderer.render(world.scene, view.camera, view.size, format="rgba32f").color
    np.testing.assert_allclose(got, same, atol=1e-6)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("angle", 20),
        ("penumbra", 0.7),
        ("direction", (0, -1, 0)),
        ("position", (1, 3, 1)),
        ("decay", 1),
        ("range", 3),
    ],
)
def test_every_change_is_seen(renderer, fresh_renderer, name, value):
    world, view = room(), perspective((2, 3, 4), (0, 0.3, 0))
    light = world.scene.add(cc.SpotLight(PLACE, WAY, penumbra=0.2))
    before = renderer.render(world.scene, view.camera, view.size).color
    setattr(light, name, value)
    after = renderer.render(world.scene, view.camera, view.size).color
    assert (after != before).any()
    fresh = fresh_renderer.render(world.scene, view.camera, view.size).color
    np.testing.assert_array_equal(after, fresh)
