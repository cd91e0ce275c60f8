"""Layered and one-pass drawing give equal bytes, whatever is drawn."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS, perspective, phong_lights, room, smooth_environment
from tests.reference.pattern import face_pattern


def everything():
    """Every material, light, blending and texture at once."""
    world = room()
    scene = world.scene
    scene.environment = cc.CubeMap(smooth_environment(16), mipmaps=True)
    for light in phong_lights()[0]:
        scene.add(light)
    picture = np.random.default_rng(0).integers(0, 256, (8, 8, 4), dtype=np.uint8)
    materials = [
        cc.PhongMaterial(color=(1, 0.5, 0.2)),
        cc.MirrorMaterial(env_weight=0.8, f0=0.1),
        cc.GlassMaterial(),
        cc.BasicMaterial(color=(0.2, 1, 0.5, 0.4)),
        cc.PhongMaterial(map=picture, double_sided=True),
        cc.BasicMaterial(cubemap=cc.CubeMap(face_pattern(8))),
    ]
    for index, material in enumerate(materials):
        angle = index * np.pi / 3
        place = (1.3 * np.cos(angle), 0.3 * np.sin(2 * angle), 1.3 * np.sin(angle))
        scene.add(cc.Mesh.sphere(0.3, segments=16, rings=8), material, position=place)
    mirror = scene.add(cc.Mesh.icosphere(0.25), cc.MirrorMaterial(), position=(0, 0.8, 0))
    mirror.environment = cc.Probe(position=(0, 0.8, 0), size=16, mipmaps=True)
    return scene


@pytest.fixture(scope="module")
def scene():
    return everything()


@pytest.fixture
def both(new_renderer):
    layered, one_pass = new_renderer(), new_renderer(layered=False)
    assert one_pass.info.layered is False
    return layered, one_pass


def same(a, b, names):
    for name in names:
        assert_identical(getattr(a, name), getattr(b, name), name)


def test_the_device_draws_layers_in_one_pass(renderer):
    assert renderer.info.layered is True


@pytest.mark.parametrize("fmt", ["rgba8", "rgba16f", "rgba32f"])
def test_captures(both, scene, fmt):
    cubes = [r.capture(scene, size=24, format=fmt, outputs=OUTPUTS) for r in both]
    same(*cubes, ("faces", *OUTPUTS))


@pytest.mark.parametrize("samples", [2, 4])
def test_multisampled_captures(both, scene, samples):
    cubes = [r.capture(scene, size=16, samples=samples, outputs=OUTPUTS) for r in both]
    same(*cubes, ("faces", *OUTPUTS))


def test_frames_with_a_probe(both, scene):
    view = perspective((2, 1.5, 3), (0, 0, 0))
    frames = [
        r.render(scene, view.camera, view.size, format="rgba32f", outputs=OUTPUTS) for r in both
    ]
    same(*frames, ("color", *OUTPUTS))
    probe = scene.nodes[-1].environment
    same(*(r.read_probe(probe) for r in both), ("faces",))


def test_layered_true_is_the_same_as_auto(new_renderer, both, scene):
    forced = new_renderer(layered=True)
    assert_identical(forced.capture(scene, size=8).faces, both[0].capture(scene, size=8).faces)


def test_one_pass_draws_a_mesh_once_per_view_layered_once_in_all(both):
    """One instanced draw for all the views that see it."""
    scene = cc.Scene()
    scene.add(cc.Mesh.box(5), cc.BasicMaterial(double_sided=True))
    calls = []
    for renderer in both:
        renderer.capture(scene, size=8)
        calls.append(renderer.stats.draw_calls)
    assert calls[0] < calls[1]
    assert calls[1] - calls[0] >= 5


def test_same_input_same_bytes(new_renderer, scene):
    """Renderer by renderer, run by run."""
    assert_identical(
        new_renderer().capture(scene, size=16).faces, new_renderer().capture(scene, size=16).faces
    )
