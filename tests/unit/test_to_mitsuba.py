"""Scene.to_mitsuba: what stands in the dict and in the files. tests/interop/test_mitsuba.py renders them."""

import math
import pickle
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import cubecam as cc

CAMERA = cc.PerspectiveCamera(fov=40, position=(1, 2, 3), target=(0, 0, 0))


def quietly(scene, *arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", cc.SceneWarning)
        return scene.to_mitsuba(*arguments, **options)


def told(scene, camera=CAMERA, **options):
    """What the warnings of a call say."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always", cc.SceneWarning)
        scene.to_mitsuba(camera, (8, 8), **options)
    return [str(w.message) for w in seen]


def with_node(material, mesh=None, **options):
    scene = cc.Scene()
    scene.add(mesh or cc.Mesh.box(), material, **options)
    return scene


def bsdf_of(made, node=1):
    return made[made[f"node-{node}"]["bsdf"]["id"]]


def matt(color=(0.5, 0.25, 1), **options):
    return cc.StandardMaterial(color=color, metallic=0, specular_weight=0, **options)


def test_no_mitsuba_is_needed_and_the_dict_is_plain(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mitsuba", None)  # importing it fails
    made = quietly(with_node(cc.StandardMaterial()), CAMERA)
    assert pickle.loads(pickle.dumps(made))["type"] == "scene"
    assert list(made) == ["type", "integrator", "sensor", "material-0", "node-1"]


class TestCamera:
    def test_perspective(self):
        sensor = quietly(cc.Scene(), CAMERA, (64, 32), samples=5)["sensor"]
        assert (sensor["type"], sensor["fov_axis"]) == ("perspective", "y")
        assert sensor["fov"] == 40
        assert sensor["film"]["width"] == 64
        assert sensor["film"]["height"] == 32
        assert sensor["sampler"]["sample_count"] == 5
        assert ((sensor["near_clip"], sensor["far_clip"])) == (CAMERA.near, CAMERA.far)
        matrix = sensor["to_world"]
        assert matrix[:3, 3] == pytest.approx([1, 2, 3])
        # Along +Z it looks to the target, and +X is left of the picture.
        assert matrix[:3, 2] == pytest.approx(-np.array([1, 2, 3]) / math.sqrt(14))
        right = np.asarray(CAMERA.view)[0, :3]
        assert matrix[:3, 0] == pytest.approx(-right)

    def test_orthographic(self):
        camera = cc.OrthographicCamera(height=3, position=(0, 0, 5))
        sensor = quietly(cc.Scene(), camera, (40, 20))["sensor"]
        assert sensor["type"] == "orthographic"
        # Half the width of the picture.
        assert np.linalg.norm(sensor["to_world"][:3, 0]) == pytest.approx(3)

    def test_shift_and_pixel_aspect(self):
        camera = cc.PerspectiveCamera(shift=(0.1, 0.2), pixel_aspect=1.5)
        sensor = quietly(cc.Scene(), camera, (40, 20))["sensor"]
        assert sensor["principal_point_offset_x"] == pytest.approx(0.05)
        assert sensor["principal_point_offset_y"] == pytest.approx(-0.2)
        assert any("pixel_aspect" in text for text in told(cc.Scene(), camera))

    def test_without_a_camera_the_scenes_own_or_one_that_sees_all(self):
        scene = with_node(matt(), position=(5, 0, 0))
        seen = quietly(scene)["sensor"]["to_world"]
        way = np.array([5, 0, 0]) - seen[:3, 3]
        assert way @ seen[:3, 2] == pytest.approx(np.linalg.norm(way), rel=1e-3)
        scene.add(CAMERA)
        assert quietly(scene)["sensor"]["to_world"][:3, 3] == pytest.approx([1, 2, 3])
        with pytest.raises(ValueError, match="expected a camera, got None"):
            cc.Scene().to_mitsuba()

    def test_transform(self):
        class Transform:
            def __init__(self, matrix):
                self.matrix = matrix.copy()

        scene = cc.Scene()
        scene.add(cc.Mesh.box(), matt())
        scene.add(cc.SpotLight(decay=2, shadow=True))
        made = quietly(scene, CAMERA, transform=Transform)
        assert isinstance(made["sensor"]["to_world"], Transform)
        assert isinstance(made["light-0"]["to_world"], Transform)
        assert quietly(scene, CAMERA)["sensor"]["to_world"] == pytest.approx(
            made["sensor"]["to_world"].matrix
        )


class TestMeshes:
    def test_world_space(self):
        scene = cc.Scene()
        parent = scene.add(position=(1, 2, 3), scale=2)
        node = scene.add(cc.Mesh.box(), matt(), parent=parent, scale=(-1, 1, 3))
        mesh = cc.load_mesh(quietly(scene, CAMERA)["node-2"]["filename"])
        assert mesh.bounds == pytest.approx(node.world_bounds)
        # The order of corners follows the mirrored shape: outwards.
        corners = mesh.positions[mesh.indices] - mesh.bounds.mean(axis=0)
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert ((outward * corners.mean(axis=1)).sum(axis=1) > 0).all()
        normals = mesh.normals[mesh.indices[:, 0]]
        assert ((outward * normals).sum(axis=1) > 0).all()

    def test_skins_and_morph_targets(self):
        stick = cc.Mesh.box((0.1, 2, 0.1))
        upper = stick.positions[:, 1] > 0
        stick.update(
            joints=np.c_[upper, np.zeros((len(upper), 3), int)],
            joint_weights=np.tile((1, 0, 0, 0), (len(upper), 1)),
        )
        stick.morph_targets = [cc.MorphTarget(positions=np.tile((0, 0, 0.5), (len(upper), 1)))]
        scene = cc.Scene()
        root = scene.add(position=(0, -1, 0))
        elbow = scene.add(position=(0, 1, 0), parent=root)
        rest = [np.linalg.inv(joint.world_matrix) for joint in (root, elbow)]
        node = scene.add(stick, matt(), skin=cc.Skin([root, elbow], rest), weights=[1.0])
        elbow.rotation = cc.axis_angle((0, 0, 1), -90)
        mesh = cc.load_mesh(quietly(scene, CAMERA)[f"node-{node.id}"]["filename"])
        assert mesh.bounds == pytest.approx(node.world_bounds, abs=1e-6)

    def test_only_what_is_visible(self):
        scene = cc.Scene()
        hidden = scene.add(visible=False)
        scene.add(cc.Mesh.box(), matt(), parent=hidden)
        scene.add(cc.Mesh.box(), matt(), visible=False)
        assert not [name for name in quietly(scene, CAMERA) if name.startswith("node")]

    def test_equal_materials_meshes_and_pictures_are_written_once(self):
        scene = cc.Scene()
        pixels = np.random.default_rng(0).uniform(size=(4, 4, 3)).astype(np.float32)
        for k in range(3):
            scene.add(cc.Mesh.box(), matt((1, 1, 1), map=pixels), position=(k % 2, 0, 0))
        made = quietly(scene, CAMERA)
        assert "material-1" not in made
        folder = Path(made["node-1"]["filename"]).parent
        assert sorted(path.name for path in folder.iterdir()) == [
            "scene-0.exr", "scene-0.ply", "scene-1.ply"
        ]  # fmt: skip

    def test_flat_shading(self):
        assert quietly(with_node(matt(flat_shading=True)), CAMERA)["node-1"]["face_normals"] is True
        assert quietly(with_node(matt()), CAMERA)["node-1"]["face_normals"] is False

    def test_double_sided_lamps_have_a_second_mesh(self):
        made = quietly(with_node(cc.BasicMaterial(double_sided=True), cc.Mesh.plane()), CAMERA)
        front, back = (cc.load_mesh(made[name]["filename"]) for name in ("node-1", "node-1-back"))
        assert back.normals[0] == pytest.approx(-front.normals[0])
        assert -1e-3 < back.positions[0, 1] < 0
        # Its triangles are turned round, too.
        a, b, c = back.positions[back.indices[0]]
        assert np.cross(b - a, c - a) @ back.normals[0] > 0

    def test_open_meshes_that_are_not_double_sided_are_told(self):
        text = "surfaces that are not double-sided are black from behind, not invisible"
        assert any(text in t for t in told(with_node(matt(), cc.Mesh.plane())))
        for mesh in (cc.Mesh.box(), cc.Mesh.sphere(), cc.Mesh.torus(), cc.Mesh.cylinder()):
            assert told(with_node(matt(), mesh)) == []
        assert told(with_node(matt(double_sided=True), cc.Mesh.plane())) == []


class TestMaterials:
    def test_basic(self):
        made = quietly(with_node(cc.BasicMaterial(color=(1, 2, 3))), CAMERA)
        assert made["node-1"]["emitter"]["radiance"] == {"type": "rgb", "value": [1, 2, 3]}
        assert bsdf_of(made)["specular_reflectance"]["value"] == [0, 0, 0]

    def test_a_black_surface_is_no_lamp(self):
        mesh = cc.Mesh.box()
        mesh.update(colors=np.zeros((len(mesh.positions), 3)))
        for material in (
            cc.BasicMaterial(color="black"),
            cc.BasicMaterial(map=np.zeros((2, 2, 4), np.float32)),
            cc.BasicMaterial(vertex_colors=True),
            cc.BasicMaterial(color="black", double_sided=True),
        ):
            made = quietly(with_node(material, mesh), CAMERA)
            assert "emitter" not in made["node-1"]
            assert "node-1-back" not in made

    def test_opacity_scales_what_is_emitted(self):
        material = cc.BasicMaterial(color=(1, 2, 3, 0.5), opacity=0.5)
        made = quietly(with_node(material), CAMERA)
        assert made["node-1"]["emitter"]["radiance"]["value"] == [0.25, 0.5, 0.75]
        assert (bsdf_of(made)["type"], bsdf_of(made)["opacity"]) == ("mask", 0.25)

    def test_additive(self):
        made = quietly(with_node(cc.BasicMaterial(blend="additive", opacity=0.5)), CAMERA)
        assert made["node-1"]["emitter"]["radiance"]["value"] == [0.5, 0.5, 0.5]
        assert bsdf_of(made)["opacity"] == 0

    def test_a_metal_is_principled(self):
        bsdf = bsdf_of(
            quietly(with_node(cc.StandardMaterial(color=(1, 0.5, 0.25), roughness=0.3)), CAMERA)
        )
        assert bsdf["type"] == "principled"
        assert bsdf["metallic"] == 1
        assert bsdf["roughness"] == pytest.approx(0.3)
        assert bsdf["base_color"]["value"] == [1, 0.5, 0.25]

    def test_what_only_scatters_is_diffuse(self):
        assert bsdf_of(quietly(with_node(matt()), CAMERA)) == {
            "type": "diffuse", "reflectance": {"type": "rgb", "value": [0.5, 0.25, 1]}
        }  # fmt: skip

    def test_the_index_of_a_dielectric(self):
        bsdf = bsdf_of(quietly(with_node(cc.StandardMaterial(metallic=0, ior=1.8)), CAMERA))
        assert bsdf["eta"] == pytest.approx(1.8)
        half = cc.StandardMaterial(metallic=0, ior=1.5, specular_weight=0.5)
        assert bsdf_of(quietly(with_node(half), CAMERA))["eta"] == pytest.approx(
            (1 + math.sqrt(0.02)) / (1 - math.sqrt(0.02))
        )

    def test_anisotropy_has_the_two_alphas(self):
        material = cc.StandardMaterial(roughness=0.5, anisotropy=0.6)
        made = quietly(with_node(material), CAMERA)
        bsdf = bsdf_of(made)
        aspect = math.sqrt(1 - 0.9 * bsdf["anisotropic"])
        assert bsdf["roughness"] ** 2 * aspect == pytest.approx(0.25)
        assert bsdf["roughness"] ** 2 / aspect == pytest.approx(0.25 + 0.75 * 0.36)
        assert cc.load_mesh(made["node-1"]["filename"]).uvs is not None

    def test_emission(self):
        made = quietly(
            with_node(cc.StandardMaterial(emissive=(1, 0, 2), emissive_strength=3)), CAMERA
        )
        assert made["node-1"]["emitter"]["radiance"]["value"] == [3, 0, 6]

    def test_glass_and_volumes(self):
        glass = bsdf_of(quietly(with_node(cc.GlassMaterial(ior=1.3, tint=(1, 0.5, 1))), CAMERA))
        assert (glass["type"], glass["int_ior"]) == ("dielectric", 1.3)
        assert glass["specular_transmittance"]["value"] == [1, 0.5, 1]
        frosted = bsdf_of(quietly(with_node(cc.GlassMaterial(roughness=0.5)), CAMERA))
        assert ((frosted["type"], frosted["alpha"])) == ("roughdielectric", 0.25)
        body = cc.StandardMaterial(
            metallic=0, roughness=0, transmission=1, thickness=1,
            attenuation_distance=2, attenuation_color=(1, 0.5, 0.25),
        )  # fmt: skip
        made = quietly(with_node(body), CAMERA)
        assert made["integrator"]["type"] == "volpath"
        sigma = made["node-1"]["interior"]["sigma_t"]["value"]
        assert np.exp(-2 * np.array(sigma)) == pytest.approx([1, 0.5, 0.25])
        thin = cc.StandardMaterial(metallic=0, roughness=0, transmission=1)
        assert bsdf_of(quietly(with_node(thin), CAMERA))["type"] == "thindielectric"

    @pytest.mark.parametrize("f0", [0.02, 0.1, 0.5, 0.9])
    def test_a_mirrors_f0_is_nearly_schlicks(self, f0):
        bsdf = bsdf_of(quietly(with_node(cc.MirrorMaterial(f0=f0)), CAMERA))
        index = bsdf["eta"] + 1j * bsdf["k"]
        assert abs((index - 1) / (index + 1)) ** 2 == pytest.approx(f0, rel=1e-3)
        cosine = 0.5
        inside = np.sqrt(index**2 - 1 + cosine**2)
        across = abs((cosine - inside) / (cosine + inside)) ** 2
        along = abs((index**2 * cosine - inside) / (index**2 * cosine + inside)) ** 2
        assert (across + along) / 2 == pytest.approx(f0 + (1 - f0) * 0.5**5, abs=0.03)

    def test_a_mirror_with_a_colour_emits_it(self):
        material = cc.MirrorMaterial(
            tint=(1, 0.5, 0), env_weight=0.5, color=(1, 1, 0), color_weight=2
        )
        made = quietly(with_node(material), CAMERA)
        assert bsdf_of(made)["specular_reflectance"]["value"] == [0.5, 0.25, 0]
        assert made["node-1"]["emitter"]["radiance"]["value"] == [2, 2, 0]

    def test_phong_alone_has_brighter_lights_and_beside_others_a_higher_reflectance(self):
        scene = with_node(cc.PhongMaterial(color=(1, 0.5, 0), kd=0.5))
        scene.add(cc.DirectionalLight(intensity=2, shadow=True))
        made = quietly(scene, CAMERA)
        assert made["light-0"]["irradiance"]["value"] == pytest.approx([2 * math.pi] * 3)
        assert bsdf_of(made)["reflectance"]["value"] == [0.5, 0.25, 0]
        scene.add(cc.Mesh.box(), matt())
        made = quietly(scene, CAMERA)
        assert made["light-0"]["irradiance"]["value"] == [2, 2, 2]
        assert bsdf_of(made)["reflectance"] == {
            "type": "rawconstant", "value": pytest.approx([0.5 * math.pi, 0.25 * math.pi, 0])
        }  # fmt: skip

    def test_user_materials_are_grey(self):
        shader = cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1.0); }")
        assert bsdf_of(quietly(with_node(shader), CAMERA))["type"] == "diffuse"
        assert any("ShaderMaterial has no counterpart" in t for t in told(with_node(shader)))


class TestMaps:
    def test_eight_bit_colours_are_a_png_that_mitsuba_decodes(self):
        pixels = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
        image = cc.Image(pixels, wrap="mirror", mag_filter="nearest")
        made = quietly(with_node(matt((1, 1, 1), map=image)), CAMERA)
        bitmap = bsdf_of(made)["reflectance"]
        assert {k: v for k, v in bitmap.items() if k != "filename"} == {
            "type": "bitmap", "filter_type": "nearest", "wrap_mode": "mirror", "format": "variant"
        }  # fmt: skip
        assert np.array_equal(cc.load_image(bitmap["filename"]), pixels)

    def test_other_colours_are_linear_floats_times_the_factor(self):
        pixels = np.full((2, 2, 3), 128, np.uint8)
        decoded = ((128 / 255 + 0.055) / 1.055) ** 2.4
        made = quietly(with_node(matt((0.5, 1, 1), map=pixels)), CAMERA)
        picture = cc.load_image(bsdf_of(made)["reflectance"]["filename"])
        assert picture[0, 0] == pytest.approx([0.5 * decoded, decoded, decoded], rel=1e-5)
        # A BasicMaterial shows numbers as they are.
        made = quietly(with_node(cc.BasicMaterial(map=pixels)), CAMERA)
        picture = cc.load_image(made["node-1"]["emitter"]["radiance"]["filename"])
        assert picture[0, 0] == pytest.approx([128 / 255] * 3)

    def test_roughness_and_metallic_are_green_and_blue(self):
        pixels = np.tile(np.array([0.1, 0.5, 0.25], np.float32), (2, 2, 1))
        material = cc.StandardMaterial(roughness=0.5, metallic_roughness_map=pixels)
        bsdf = bsdf_of(quietly(with_node(material), CAMERA))
        assert cc.load_image(bsdf["roughness"]["filename"])[0, 0] == pytest.approx(0.25)
        assert cc.load_image(bsdf["metallic"]["filename"])[0, 0] == pytest.approx(0.25)
        assert bsdf["roughness"]["raw"] is True

    def test_a_texture_moves_the_uvs_and_chooses_their_set(self):
        mesh = cc.Mesh.plane()
        mesh.update(uvs1=np.asarray(mesh.uvs) * 0.5)
        place = cc.Texture(np.ones((2, 2, 3), np.float32), uv_set=1, offset=(0.25, 0), scale=(2, 4))
        made = quietly(with_node(matt(map=place), mesh), CAMERA)
        uvs = cc.load_mesh(made["node-1"]["filename"]).uvs
        assert uvs == pytest.approx(np.asarray(mesh.uvs) * (1, 2) + (0.25, 0))

    def test_two_places_are_told(self):
        image = cc.Image(np.ones((2, 2, 3), np.float32))
        material = cc.StandardMaterial(
            map=image, metallic_roughness_map=cc.Texture(image, scale=(2, 2))
        )
        assert any("placed differently" in text for text in told(with_node(material)))

    def test_vertex_colours(self):
        mesh = cc.Mesh.box()
        mesh.update(colors=np.clip(mesh.positions + 0.5, 0, 1))
        made = quietly(with_node(matt((1, 0.5, 1)), mesh), CAMERA)
        assert bsdf_of(made)["reflectance"] == {"type": "mesh_attribute", "name": "vertex_color"}
        wanted = np.clip(mesh.positions + 0.5, 0, 1) * (1, 0.5, 1)
        colors = np.asarray(cc.load_mesh(made["node-1"]["filename"]).colors)
        assert colors[:, :3] == pytest.approx(wanted)

    def test_vertex_colours_that_are_emitted_become_a_picture(self):
        mesh = cc.Mesh.box()
        mesh.update(colors=np.clip(mesh.positions + 0.5, 0, 1))
        made = quietly(with_node(cc.BasicMaterial(vertex_colors=True), mesh), CAMERA)
        written = cc.load_mesh(made["node-1"]["filename"])
        image = cc.load_image(made["node-1"]["emitter"]["radiance"]["filename"])
        height, width = image.shape[:2]
        # At each vertex, in the middle of a texel, the picture has its colour.
        u, v = np.asarray(written.uvs).T
        column, row = (
            np.round(u * width - 0.5).astype(int),
            np.round((1 - v) * height - 0.5).astype(int),
        )
        assert image[row, column] == pytest.approx(written.positions + 0.5, abs=1e-6)

    def test_masks(self):
        pixels = np.ones((4, 4, 4), np.float32)
        pixels[:, 2:, 3] = 0
        made = quietly(
            with_node(
                matt((1, 1, 1), map=cc.Image(pixels, mag_filter="nearest"), alpha_mode="mask")
            ),
            CAMERA,
        )
        opacity = cc.load_image(bsdf_of(made)["opacity"]["filename"])[..., 0]
        assert np.array_equal(opacity, pixels[..., 3])
        assert bsdf_of(made)["opacity"]["filter_type"] == "nearest"


class TestLights:
    def scene(self, light):
        scene = with_node(matt())
        scene.add(light)
        return scene

    def test_point_and_directional(self):
        point = cc.PointLight((1, 2, 3), color=(1, 0.5, 0), intensity=4, decay=2, shadow=True)
        made = quietly(self.scene(point), CAMERA)["light-0"]
        assert made["position"] == [1, 2, 3]
        assert made["intensity"]["value"] == [4, 2, 0]
        assert told(self.scene(point)) == []
        sun = cc.DirectionalLight((0, -1, 1), intensity=3, shadow=True)
        made = quietly(self.scene(sun), CAMERA)["light-0"]
        assert made["direction"] == pytest.approx([0, -math.sqrt(0.5), math.sqrt(0.5)])
        assert made["irradiance"]["value"] == [3, 3, 3]

    def test_another_decay_is_as_strong_at_the_centre(self):
        lamp = cc.PointLight((0, 3, 0), intensity=4, decay=1, shadow=True)
        assert quietly(self.scene(lamp), CAMERA)["light-0"]["intensity"]["value"] == [12] * 3
        assert any("decay=2" in text for text in told(self.scene(lamp)))

    def test_spot(self):
        lamp = cc.SpotLight((1, 2, 3), (0, 0, -2), angle=30, penumbra=0.5, decay=2, shadow=True)
        made = quietly(self.scene(lamp), CAMERA)["light-0"]
        assert made["cutoff_angle"] == 30
        assert made["to_world"][:3, 2] == pytest.approx([0, 0, -1])
        assert np.linalg.det(made["to_world"][:3, :3]) == pytest.approx(1)
        fade = cc.load_image(made["texture"]["filename"])[..., 0]
        # On the axis all, half-way between the cosines a quarter, at the edge nothing.
        half = (math.cos(math.radians(15)) + math.cos(math.radians(30))) / 2
        at = math.tan(math.acos(half)) / math.tan(math.radians(30))
        size = len(fade)
        assert fade[size // 2, size // 2] == 1
        assert fade[size // 2, int((1 + at) / 2 * size)] == pytest.approx(0.25, abs=0.01)
        assert fade[0, 0] == 0

    def test_what_is_told(self):
        texts = told(self.scene(cc.PointLight(decay=2, range=5)))
        assert any("no range" in text for text in texts)
        assert any("lights without shadow" in text for text in texts)

    def test_lights_that_nothing_answers_are_left_out(self):
        scene = with_node(cc.BasicMaterial())
        scene.add(cc.PointLight())
        assert "light-0" not in quietly(scene, CAMERA)
        assert told(scene) == []


class TestSurroundings:
    CUBE = cc.CubeMap(np.random.default_rng(1).uniform(size=(6, 4, 4, 3)).astype(np.float32))

    def test_the_environment_is_looked_up_as_envmap_does(self):
        scene = with_node(cc.MirrorMaterial())
        scene.environment, scene.environment_intensity = self.CUBE, 2
        scene.environment_rotation = cc.axis_angle((1, 2, 3), 40)
        made = quietly(scene, CAMERA)
        assert made["environment"]["scale"] == 2
        assert made["integrator"]["hide_emitters"] is False
        picture = cc.load_image(made["environment"]["filename"])
        height, width = picture.shape[:2]
        i, j = height // 3, width // 5
        phi, theta = (j + 0.5) / width * 2 * math.pi, i / (height - 1) * math.pi
        way = [math.sin(phi) * math.sin(theta), math.cos(theta), -math.cos(phi) * math.sin(theta)]
        # The inverse rotation, from the world to the cube.
        w, x, y, z = scene.environment_rotation
        axis = np.array([x, y, z])
        into = np.array(way) - 2 * w * np.cross(axis, way) + 2 * np.cross(axis, np.cross(axis, way))
        assert picture[i, j] == pytest.approx(self.CUBE.sample(into)[:3], abs=1e-5)
        assert np.ptp(picture[0], axis=0).max() < 1e-5  # a pole

    def test_a_black_environment_is_no_picture(self):
        scene = with_node(cc.MirrorMaterial())
        scene.environment = cc.CubeMap(np.zeros((6, 2, 2, 3), np.float32))
        made = quietly(scene, CAMERA)["environment"]
        assert (made["type"], made["sampling_weight"]) == ("constant", 0)

    def test_backgrounds(self):
        mirror = with_node(cc.MirrorMaterial())
        mirror.environment, mirror.background = self.CUBE, "black"
        made = quietly(mirror, CAMERA)
        assert made["integrator"]["hide_emitters"] is True
        basic = with_node(cc.BasicMaterial())
        basic.background = (0.1, 0.2, 0.3, 1)
        made = quietly(basic, CAMERA)
        assert made["environment"]["radiance"]["value"] == pytest.approx([0.1, 0.2, 0.3])
        lit = with_node(matt())
        lit.background = (0.1, 0.2, 0.3, 1)
        assert "environment" not in quietly(lit, CAMERA)
        assert any("the background is left out" in text for text in told(lit))

    def test_ambient_light(self):
        scene = with_node(cc.StandardMaterial())
        scene.add(cc.AmbientLight(color=(1, 0.5, 0), intensity=2))
        made = quietly(scene, CAMERA)
        assert made["environment"] == {
            "type": "constant", "radiance": {"type": "rgb", "value": [2, 1, 0]}
        }  # fmt: skip
        assert made["integrator"]["hide_emitters"] is True
        scene.environment = cc.CubeMap(np.ones((6, 2, 2, 3), np.float32))
        made = quietly(scene, CAMERA)
        assert cc.load_image(made["environment"]["filename"])[3, 3] == pytest.approx([3, 2, 1])


class TestFiles:
    def test_xml(self, tmp_path):
        scene = with_node(matt(map=np.ones((2, 2, 3), np.float32)), name="a <b> & c")
        scene.add(cc.PointLight((1, 2, 3), decay=2))
        made = quietly(scene, CAMERA, path=tmp_path / "room.xml", max_depth=3)
        assert sorted(p.name for p in tmp_path.iterdir()) == [
            "room-0.exr",
            "room-0.ply",
            "room.xml",
        ]
        assert made["node-1"]["filename"] == str(tmp_path / "room-0.ply")
        root = ElementTree.parse(tmp_path / "room.xml").getroot()

        def attribute(place, name):
            (found,) = root.findall(place)
            return found.attrib[name]

        assert attribute("integrator/integer[@name='max_depth']", "value") == "3"
        assert attribute("shape/string[@name='filename']", "value") == "room-0.ply"
        assert attribute("shape/ref", "id") == attribute("bsdf", "id")
        matrix = np.array(attribute("sensor/transform/matrix", "value").split(), float)
        assert matrix.reshape(4, 4) == pytest.approx(made["sensor"]["to_world"])

    def test_nothing_is_written_where_a_file_may_not_be(self, tmp_path):
        (tmp_path / "room-0.ply").mkdir()
        with pytest.raises(OSError, match=r"room-0\.ply"):
            quietly(with_node(matt()), CAMERA, path=tmp_path / "room.xml")
        assert [p.name for p in tmp_path.iterdir()] == ["room-0.ply"]

    def test_wrong_arguments(self, tmp_path):
        scene = with_node(matt())
        with pytest.raises(ValueError, match=r"a file name that ends in \.xml; got"):
            scene.to_mitsuba(path=tmp_path / "a.json")
        with pytest.raises(ValueError, match="size"):
            scene.to_mitsuba(CAMERA, (0, 5))
        with pytest.raises(ValueError, match="samples"):
            scene.to_mitsuba(CAMERA, samples=0)
        with pytest.raises(ValueError, match="max_depth"):
            scene.to_mitsuba(CAMERA, max_depth=0)
        with pytest.raises(TypeError, match="camera: expected"):
            scene.to_mitsuba("front")
        with pytest.raises(TypeError, match="transform: expected a callable"):
            scene.to_mitsuba(CAMERA, transform=3)

    def test_each_reason_is_told_once_with_names(self):
        scene = cc.Scene()
        for k in range(5):
            scene.add(cc.Mesh.box(), cc.PhongMaterial(ks=0), name=f"box {k}")
        texts = told(scene)
        assert len(texts) == 1
        assert texts[0] == (
            "Scene.to_mitsuba: the share ka of a PhongMaterial, light without a lamp, is left out "
            "('box 0', 'box 1', 'box 2' and 2 more)"
        )
