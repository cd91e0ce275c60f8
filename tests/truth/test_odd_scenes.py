"""Scenes that are unusual: glass over a floor, infinite light, many nodes, all materials at once."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import work
from cubecam.truth.paths import tracer
from cubecam.truth.surfaces.geometry import Geometry

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


def test_a_floor_below_a_pane_gets_all_light():
    """What the pane lets through was not counted by the direction to the sky, which the pane blocks."""
    scene = cc.Scene(environment=WHITE)
    scene.add(cc.Mesh.plane(2, 2), MATT)
    pane = cc.BasicMaterial(opacity=0.5, double_sided=True)
    scene.add(cc.Mesh.plane(9, 9), pane, position=(0, 0.5, 0))
    picture = rendered(scene, down(1), (8, 8), samples=64)
    assert picture.color[..., :3].mean() == pytest.approx(1, abs=0.02)


@pytest.mark.parametrize("gap", [0.0, 1e-8])
@pytest.mark.parametrize("kind", ["glass", "standard", "pane"])
def test_no_light_comes_through_a_floor_that_touches_glass(kind, gap):
    """The lower side of the box and the floor lie in one plane, or nearly: rays left the box and missed the floor."""
    scene = cc.Scene(background=(0, 0, 1))
    scene.add(cc.Mesh.plane(40, 40), cc.BasicMaterial(color=(1, 0, 0)), position=(0, -gap, 0))
    material = {
        "glass": cc.GlassMaterial(ior=1.5, fresnel=False),
        "standard": cc.StandardMaterial(
            metallic=0, roughness=0, transmission=1, thickness=1, specular_weight=0
        ),
        "pane": cc.BasicMaterial(color=(1, 0, 0), opacity=0.5),
    }[kind]
    mesh, height = (cc.Mesh.plane(0.8, 0.8), 0) if kind == "pane" else (cc.Mesh.box(1), 0.5)
    scene.add(mesh, material, position=(0.13, height, 0.07))
    view = cc.PerspectiveCamera(fov=12, position=(0.8, 3, 0.9), target=(0.13, 0.3, 0.07))
    color = rendered(scene, view, (40, 40), samples=1, bounces=6).color
    assert color[..., 2].max() < 1e-6


def test_the_far_plane_also_ends_rays_behind_panes():
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(cc.Mesh.plane(9, 9), cc.BasicMaterial(color=(1, 1, 1)), position=(0, -1, 0))
    view = down(1)
    for pane in (False, True):
        if pane:
            glow = cc.BasicMaterial(color=(0, 0, 0), opacity=0.5)
            scene.add(cc.Mesh.plane(9, 9), glow, position=(0, 1, 0))
        for far, light in ((2.9, 0), (3.1, 0.5 if pane else 1)):
            view.far = far
            color = rendered(scene, view, samples=1).color
            assert color[..., :3] == pytest.approx(light)


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


def test_one_tree_of_triangles_is_enough(monkeypatch):
    made = []

    class Counted(Geometry):
        def __init__(self, *args):
            made.append(args)
            super().__init__(*args)

    monkeypatch.setattr(tracer, "Geometry", Counted)
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box(1), MATT)
    scene.add(cc.PointLight(position=(0, 3, 0), shadow=cc.Shadow()))
    rendered(scene, samples=1)
    assert len(made) == 1
    node.cast_shadow = False
    rendered(scene, samples=1)
    assert len(made) == 3


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


# --- textures that are pictures ---------------------------------------------------------------------------------------


def monitor():
    """A scene that shows a picture of another one."""
    inner = cc.Scene(environment=WHITE)
    inner.add(cc.Mesh.box(1), MATT)
    view = cc.PerspectiveCamera(position=(0, 0, 3), target=(0, 0, 0))
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(map=cc.RenderTexture(inner, view, size=(8, 8))))
    return scene


def test_a_deadline_counts_for_textures_too():
    picture = rendered(monitor(), samples=60000, deadline=0.3)
    assert not picture.complete
    assert picture.seconds < 20
    assert rendered(monitor(), samples=4).complete


def test_a_texture_that_is_not_complete_shows_in_the_picture():
    """The inner picture is noisy, the outer one is not."""
    assert rendered(monitor(), samples=16, target_error=0.5).complete
    assert not rendered(monitor(), samples=16, target_error=1e-6).complete


def test_ctrl_c_in_a_texture_ends_the_whole_picture(monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    scene = monitor()
    monkeypatch.setattr(work, "drawn", interrupted)
    with pytest.raises(KeyboardInterrupt):
        rendered(scene)
    plain = cc.Scene()
    assert not rendered(plain).complete


# --- refusals ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("blend", ["multiply", cc.Blend("one", "src_color")])
def test_products_of_two_lights_are_refused(blend):
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box(1), cc.MirrorMaterial(blend=blend), name="filter")
    for material in (cc.MirrorMaterial, cc.GlassMaterial, cc.StandardMaterial):
        node.material = material(blend=blend)
        message = f"'filter', material.blend: expected a sum on a {material.__name__}"
        with pytest.raises(ValueError, match=message):
            rendered(scene)
    node.material = cc.StandardMaterial(blend=blend, unlit=True)
    assert rendered(scene, samples=1).complete


def test_nodes_of_another_scene_cannot_be_left_out():
    other = cc.Scene()
    node = other.add(cc.Mesh.box(1))
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1))
    with pytest.raises(ValueError, match=r"exclude: expected nodes of this scene, got Node\(id=1"):
        rendered(scene, exclude=[node])


def test_pictures_that_no_memory_holds():
    with pytest.raises(ValueError, match=r"expected what fits into .* memory .*shape \(1000000, "):
        rendered(cc.Scene(), size=(10**6, 10**6))
    with pytest.raises(ValueError, match=r"shape \(6, 1000000, 1000000\)"):
        cc.truth.capture(cc.Scene(), size=10**6)
