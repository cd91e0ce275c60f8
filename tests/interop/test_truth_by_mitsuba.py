"""`truth.render` beside Mitsuba 3: two path tracers that share no line give the same light, within their noise."""

import numpy as np
import pytest

import cubecam as cc
from tests.interop.mitsuba import cube_of_place, rendered

pytestmark = pytest.mark.interop
SIZE = (48, 32)


def matt(color):
    return cc.StandardMaterial(color=color, metallic=0, roughness=1, specular_weight=0)


def corner():
    """Three matt walls of a corner under the sky, which light each other."""
    scene = cc.Scene(environment=cube_of_place())
    scene.add(cc.Mesh.box((6, 0.2, 6)), matt((0.5, 0.5, 0.6)), position=(0, -1.1, 0))
    scene.add(cc.Mesh.box((0.2, 4, 6)), matt((0.6, 0.2, 0.2)), position=(-2, 0.5, 0))
    scene.add(cc.Mesh.box((6, 4, 0.2)), matt((0.2, 0.5, 0.2)), position=(0, 0.5, -2))
    return scene


def metals():
    scene = corner()
    for x, roughness in ((-1, 0.2), (0, 0.4), (1, 0.8)):
        gold = cc.StandardMaterial(
            color=(1, 0.77, 0.34), metallic=1, roughness=roughness, multiple_scattering=False
        )
        scene.add(cc.Mesh.icosphere(0.45, 5), gold, position=(x, -0.5, 0))
    return scene


def mirrors():
    scene = corner()
    ball = cc.Mesh.icosphere(0.6, 5)
    for x in (-0.8, 0.6):
        scene.add(ball, cc.MirrorMaterial(tint=(0.9, 0.8, 0.9)), position=(x, -0.4, 0.2))
    return scene


def glass():
    scene = corner()
    scene.add(cc.Mesh.icosphere(0.6, 6), cc.GlassMaterial(ior=1.5), position=(-0.6, -0.39, 0.3))
    scene.add(cc.Mesh.box(0.8), cc.GlassMaterial(ior=1.3), position=(0.8, -0.58, 0.2))
    return scene


def lamps():
    scene = corner()
    scene.environment = None
    scene.background = (0, 0, 0)
    scene.add(cc.PointLight(position=(1, 2, 1.5), intensity=12, decay=2, shadow=cc.Shadow()))
    scene.add(cc.DirectionalLight(direction=(-1, -2, -1), intensity=2, shadow=cc.Shadow()))
    scene.add(cc.Mesh.icosphere(0.6, 5), matt((0.8, 0.7, 0.2)), position=(0, -0.4, 0))
    return scene


@pytest.mark.parametrize("make", [corner, metals, mirrors, glass, lamps])
def test_two_path_tracers_agree(tmp_path, make):
    scene = make()
    camera = cc.PerspectiveCamera(fov=45, position=(2, 1.2, 4), target=(-0.3, -0.3, 0))
    bounces = 10
    exact = cc.truth.render(scene, camera, SIZE, samples=256, bounces=bounces, outputs=("id",))
    exported = scene.to_mitsuba(camera, SIZE, samples=512, max_depth=bounces + 2)
    (other,) = rendered(tmp_path, [exported])
    ours, theirs = exact.color[..., :3].astype(float), other[..., :3].astype(float)
    for number in np.unique(exact.id):
        on = exact.id == number
        if on.sum() < 40:
            continue
        a, b = ours[on].mean(axis=0), theirs[on].mean(axis=0)
        # Both are noisy; silhouettes have other filters.
        assert a == pytest.approx(b, rel=0.03, abs=0.004), (number, a, b)
    # In blocks of 4 x 4 pixels the noise of both is small enough to see shadows and reflections at their places.
    blocks = [
        c.reshape(SIZE[1] // 4, 4, SIZE[0] // 4, 4, 3).mean(axis=(1, 3)) for c in (ours, theirs)
    ]
    apart = np.abs(blocks[0] - blocks[1])
    assert np.median(apart) < 0.015 * ours.mean()
    assert np.quantile(apart, 0.95) < 0.08 * ours.mean()
