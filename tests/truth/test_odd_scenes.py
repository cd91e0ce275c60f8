"""Scenes that are unusual: glass over a floor, infinite light, many nodes, all materials at once."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import tracer, work

WHITE = cc.CubeMap(np.ones((6, 4, 4, 3), np.float32))
MATT = cc.StandardMaterial(metallic=0, roughness=1, specular_weight=0)


def down(height):
    return cc.OrthographicCamera(height=height, position=(0, 2, 0), target=(0, 0, 0), up=(0, 0, -1))


def rendered(scene, camera=None, size=(16, 16), **options):
    view = camera or cc.PerspectiveCamera(position=(0, 1, 3), target=(0, 0, 0))
    return cc.truth.render(scene, view, size, **{"processes": 1, **options})


@pytest.mark.parametrize("bounces", [1, 2, 3])
@pytest.mark.parametrize("open_body", [False, True])
def test_a_floor_in_a_body_of_glass_gets_all_light(bounces, open_body):
    """Inside of a body no direction is chosen by the brightness of the sky, so that none may be counted as if."""
    scene = cc.Scene(environment=WHITE)
    scene.add(cc.Mesh.plane(2, 2), MATT)
    body = cc.Mesh.plane(3, 3) if open_body else cc.Mesh.box((3, 0.2, 3))
    scene.add(body, cc.GlassMaterial(ior=1, fresnel=False), position=(0, 0.1, 0))
    picture = rendered(scene, down(1), (8, 8), samples=64, bounces=bounces)
    error = np.sqrt((picture.deviation.astype(float) ** 2).sum()) / 64
    assert error < 0.01
    assert picture.color[..., :3].mean() == pytest.approx(1, abs=5 * error + 1e-3)


def test_infinite_light_is_much_light_for_surfaces_and_infinite_in_mirrors():
    faces = np.full((6, 8, 8, 3), 0.5, np.float32)
    faces[2, 3, 3] = np.inf
    scene = cc.Scene(environment=cc.CubeMap(faces))
    node = scene.add(cc.Mesh.sphere(0.8, 16, 8), MATT)
    for material in (MATT, cc.StandardMaterial(metallic=1, roughness=0)):
        node.material = material
        color = rendered(scene, samples=16, outputs=("id",))
        light = color.color[color.id > 0]
        assert np.isfinite(light).all()
        assert light[..., :3].max() > 100
    node.material = cc.MirrorMaterial()
    assert np.isposinf(rendered(scene, samples=16).color).any()


def test_the_work_does_not_grow_with_the_number_of_nodes(monkeypatch):
    calls: list[None] = []
    original = tracer.add
    monkeypatch.setattr(tracer, "add", lambda *args: calls.append(original(*args)))
    counts = []
    for count in (2, 100):
        scene = cc.Scene(environment=WHITE)
        box = cc.Mesh.box(0.15)
        glossy = cc.StandardMaterial(metallic=0, roughness=0.5)
        pane = cc.BasicMaterial(color=(1, 0, 0, 0.5))
        for i in range(count):
            place = (i % 10 * 0.2 - 1, 0, i // 10 * 0.2 - 1)
            scene.add(box, (glossy, pane)[i % 2], position=place)
        calls.clear()
        picture = rendered(scene, down(2.2), samples=2, bounces=1, outputs=("id",))
        assert len(np.unique(picture.id)) > count / 4
        counts.append(len(calls))
    assert counts[1] <= counts[0] + 6  # some more steps, since there are panes before panes


def all_materials():
    """One scene with each way that light can go."""
    rng = np.random.default_rng(0)
    faces = np.full((6, 8, 8, 3), 0.2, np.float32)
    faces[2, 2:4, 2:5] = (60, 40, 30)
    scene = cc.Scene(
        environment=cc.CubeMap(faces), environment_rotation=cc.axis_angle((1, 2, 3), 35)
    )
    scene.add(cc.PointLight(position=(1, 3, 2), shadow=cc.Shadow(), intensity=4))
    scene.add(cc.DirectionalLight(direction=(-1, -2, -1), shadow=cc.Shadow(), intensity=0.5))
    scene.add(cc.AmbientLight(intensity=0.1))
    pixels = rng.random((8, 8, 4)).astype(np.float32)
    turned = cc.Texture(pixels, scale=(3, 2), rotation=30, offset=(0.1, 0.2))
    bumps = np.full((4, 4, 3), (0.5, 0.5, 1), np.float32)
    bumps[::2] = (0.7, 0.5, 0.8)
    standard = cc.StandardMaterial
    materials = [
        cc.PhongMaterial(map=pixels),
        cc.BasicMaterial(map=pixels[..., :3], opacity=0.6),
        cc.MirrorMaterial(f0=0.3, opacity=0.5),
        cc.GlassMaterial(roughness=0.4),
        standard(map=turned, alpha_mode="mask", alpha_cutoff=0.4, double_sided=True),
        standard(
            metallic=0.5, roughness=0.4, clearcoat=0.7, clearcoat_roughness=0.1, iridescence=0.8,
            sheen_color=(0.3, 0.2, 0.1), normal_map=bumps, anisotropy=0.4,
        ),
        standard(
            metallic=0, roughness=0.2, transmission=1, thickness=1, dispersion=3,
            attenuation_color=(0.5, 0.8, 0.9), attenuation_distance=0.5,
        ),
        standard(metallic=0, roughness=0.2, transmission=0.7, opacity=0.7),
        standard(unlit=True, map=turned),
    ]  # fmt: skip
    floor = standard(metallic=0, roughness=0.7, map=turned)
    scene.add(cc.Mesh.plane(8, 8), floor, position=(0, -1.4, 0))
    for i, material in enumerate(materials):
        place = (i % 3 - 1, i // 3 - 1, -(i % 3) * 0.3)
        scene.add(cc.Mesh.sphere(0.42, 16, 8), material, position=place)
    return scene


def test_pieces_and_processes_change_no_byte_of_any_material(monkeypatch):
    scene = all_materials()
    alone = rendered(scene, size=(16, 12), samples=6)
    monkeypatch.setattr(work, "PATHS", 500)
    for processes in (1, 2):
        other = rendered(scene, size=(16, 12), samples=6, processes=processes)
        assert other.color.tobytes() == alone.color.tobytes()
        assert other.deviation.tobytes() == alone.deviation.tobytes()
    assert np.isfinite(alone.color).all()
