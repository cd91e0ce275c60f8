"""Scene.save: what stands in the file, by the specifications of glTF 2.0 and its extensions."""

import math
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.saved import extras_in, names_in, raw_of, tree_of, without_extras

RNG = np.random.default_rng(5)
PICTURE = RNG.integers(0, 256, (6, 5, 4), dtype=np.uint8)

#: Properties of StandardMaterial, and the place and value that the specification gives them.
WORDS = [
    ({"color": (0.25, 0.5, 1, 0.75)}, "pbrMetallicRoughness.baseColorFactor", [0.25, 0.5, 1, 0.75]),
    ({"metallic": 0.25}, "pbrMetallicRoughness.metallicFactor", 0.25),
    ({"roughness": 0.1}, "pbrMetallicRoughness.roughnessFactor", 0.1),
    ({"emissive": (0, 0.5, 1)}, "emissiveFactor", [0, 0.5, 1]),
    ({"double_sided": True}, "doubleSided", True),
    ({"alpha_mode": "mask"}, "alphaMode", "MASK"),
    ({"alpha_mode": "blend"}, "alphaMode", "BLEND"),
    ({"alpha_mode": "mask", "alpha_cutoff": 0.25}, "alphaCutoff", 0.25),
    ({"emissive_strength": 3}, "KHR_materials_emissive_strength.emissiveStrength", 3),
    ({"ior": 2.4}, "KHR_materials_ior.ior", 2.4),
    ({"ior": 0}, "KHR_materials_ior.ior", 0),
    ({"specular_weight": 0.5}, "KHR_materials_specular.specularFactor", 0.5),
    ({"specular_color": (1, 2, 3)}, "KHR_materials_specular.specularColorFactor", [1, 2, 3]),
    ({"clearcoat": 0.5}, "KHR_materials_clearcoat.clearcoatFactor", 0.5),
    ({"clearcoat_roughness": 0.5}, "KHR_materials_clearcoat.clearcoatRoughnessFactor", 0.5),
    ({"sheen_color": (1, 0, 0.5)}, "KHR_materials_sheen.sheenColorFactor", [1, 0, 0.5]),
    ({"sheen_roughness": 0.5}, "KHR_materials_sheen.sheenRoughnessFactor", 0.5),
    ({"iridescence": 0.5}, "KHR_materials_iridescence.iridescenceFactor", 0.5),
    ({"iridescence_ior": 2}, "KHR_materials_iridescence.iridescenceIor", 2),
    ({"iridescence_thickness_min": 9}, "KHR_materials_iridescence.iridescenceThicknessMinimum", 9),
    ({"iridescence_thickness_max": 9}, "KHR_materials_iridescence.iridescenceThicknessMaximum", 9),
    ({"anisotropy": 0.5}, "KHR_materials_anisotropy.anisotropyStrength", 0.5),
    ({"anisotropy_rotation": 90}, "KHR_materials_anisotropy.anisotropyRotation", math.pi / 2),
    ({"transmission": 0.5}, "KHR_materials_transmission.transmissionFactor", 0.5),
    ({"thickness": 0.5}, "KHR_materials_volume.thicknessFactor", 0.5),
    ({"attenuation_distance": 0.5}, "KHR_materials_volume.attenuationDistance", 0.5),
    ({"attenuation_color": (0, 1, 0)}, "KHR_materials_volume.attenuationColor", [0, 1, 0]),
    ({"dispersion": 0.5}, "KHR_materials_dispersion.dispersion", 0.5),
]  # fmt: skip
MAPS = {
    "map": "pbrMetallicRoughness.baseColorTexture",
    "metallic_roughness_map": "pbrMetallicRoughness.metallicRoughnessTexture",
    "normal_map": "normalTexture",
    "occlusion_map": "occlusionTexture",
    "emissive_map": "emissiveTexture",
    "specular_map": "KHR_materials_specular.specularTexture",
    "specular_color_map": "KHR_materials_specular.specularColorTexture",
    "clearcoat_map": "KHR_materials_clearcoat.clearcoatTexture",
    "clearcoat_roughness_map": "KHR_materials_clearcoat.clearcoatRoughnessTexture",
    "clearcoat_normal_map": "KHR_materials_clearcoat.clearcoatNormalTexture",
    "sheen_color_map": "KHR_materials_sheen.sheenColorTexture",
    "sheen_roughness_map": "KHR_materials_sheen.sheenRoughnessTexture",
    "iridescence_map": "KHR_materials_iridescence.iridescenceTexture",
    "iridescence_thickness_map": "KHR_materials_iridescence.iridescenceThicknessTexture",
    "anisotropy_map": "KHR_materials_anisotropy.anisotropyTexture",
    "transmission_map": "KHR_materials_transmission.transmissionTexture",
    "thickness_map": "KHR_materials_volume.thicknessTexture",
}
COLORS = {"map", "emissive_map", "specular_color_map", "sheen_color_map"}


def opaque(**options):
    return cc.StandardMaterial(**{"alpha_mode": "opaque", **options})


def scene_of(*materials, mesh=None):
    scene = cc.Scene()
    for material in materials:
        scene.add(mesh or cc.Mesh.box(), material)
    return scene


def from_top(uvs):
    """Texture coordinates with v from the top, as glTF has them."""
    return uvs * np.array([1, -1]) + np.array([0, 1])


def at(entry, path):
    """Find a value below an entry; a name that begins with KHR_ is an extension of it."""
    if path.startswith("KHR_"):
        entry = entry["extensions"]
    for word in path.split("."):
        entry = entry[word]
    return entry


def test_a_scene_that_gltf_can_say_has_no_extras_and_no_extensions(tmp_path):
    scene = scene_of(opaque(name="red", color="red") if hasattr(cc.Material, "name") else opaque())
    scene.add(parent=scene.nodes[0], position=(1, 2, 3), name="below")
    # A mesh whose normals are computed says so, since they follow its positions.
    scene.nodes[0].mesh.normals = scene.nodes[0].mesh.normals
    raw = raw_of(scene, tmp_path)
    assert extras_in(raw) == 0
    assert "extensionsUsed" not in raw
    assert "extras" not in raw
    assert raw["nodes"][0]["children"] == [1]
    assert raw["nodes"][1] == {"name": "below", "translation": [1, 2, 3]}
    assert raw["scenes"] == [{"nodes": [0]}]
    assert raw["scene"] == 0
    assert raw["asset"] == {"version": "2.0", "generator": f"cubecam {cc.__version__}"}


def test_arrays_of_a_mesh(tmp_path):
    count = 40
    positions = RNG.normal(size=(count, 3)).astype(np.float32)
    mesh = cc.Mesh(
        positions,
        RNG.integers(0, count, (30, 3)),
        normals=RNG.normal(size=(count, 3)),
        uvs=RNG.random((count, 2)),
        uvs1=RNG.random((count, 2)),
        colors=RNG.random((count, 4)),
        tangents=np.c_[RNG.normal(size=(count, 3)), np.ones(count)],
    )
    document = tree_of(scene_of(opaque(), mesh=mesh), tmp_path)
    (primitive,) = document.tree.raw["meshes"][0]["primitives"]
    keys = primitive["attributes"]
    for key, want in {
        "POSITION": mesh.positions,
        "NORMAL": mesh.normals,
        "TANGENT": mesh.tangents,
        "TEXCOORD_0": from_top(mesh.uvs),
        "TEXCOORD_1": from_top(mesh.uvs1),
        "COLOR_0": mesh.colors,
    }.items():
        got = document.accessor(keys.pop(key))
        assert want is not None
        np.testing.assert_allclose(got, want, rtol=0, atol=0 if "TEX" not in key else 2**-24)
    assert not keys
    entry = document.tree.raw["accessors"][0]
    assert np.float32(entry["min"]).tolist() == positions.min(axis=0).tolist()
    assert np.float32(entry["max"]).tolist() == positions.max(axis=0).tolist()
    got = document.accessor(primitive["indices"]).reshape(-1, 3)
    assert got.dtype == np.uint8
    assert (got == mesh.indices).all()


@pytest.mark.parametrize(
    ("most", "dtype"),
    [(254, "uint8"), (255, "uint16"), (65534, "uint16"), (65535, "uint32")],
)
def test_indices_are_of_the_smallest_type_whose_largest_number_is_no_index(most, dtype, tmp_path):
    positions = RNG.random((most + 1, 3))
    mesh = cc.Mesh(positions, [[0, 1, most]], normals=positions + 1)
    document = tree_of(scene_of(opaque(), mesh=mesh), tmp_path)
    got = document.stored(document.tree.raw["meshes"][0]["primitives"][0]["indices"])
    assert got.dtype == dtype
    assert got.tolist() == [0, 1, most]


def test_a_mesh_in_two_materials_is_stored_once(tmp_path):
    mesh = cc.Mesh.sphere(segments=8, rings=4)
    one, other = opaque(metallic=0), opaque(metallic=0.5)
    raw = raw_of(scene_of(one, other, one, mesh=mesh), tmp_path)
    assert [node["mesh"] for node in raw["nodes"]] == [0, 1, 0]
    first, second = (entry["primitives"][0] for entry in raw["meshes"])
    assert first["attributes"] == second["attributes"]
    assert first["indices"] == second["indices"]
    assert (first["material"], second["material"]) == (0, 1)


def test_a_mesh_without_uvs_in_a_material_with_a_map_gets_uvs_for_the_file(tmp_path):
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    material = opaque(map=cc.Texture(PICTURE, uv_set=1))
    document = tree_of(scene_of(material, mesh=mesh), tmp_path)
    entry = document.tree.raw["meshes"][0]
    attributes = entry["primitives"][0]["attributes"]
    for key in ("TEXCOORD_0", "TEXCOORD_1"):
        assert document.accessor(attributes[key]).tolist() == [[0, 1]] * 3
    assert entry["extras"]["cubecam"]["uvs"] is None
    assert entry["extras"]["cubecam"]["uvs1"] is None


def test_colors_that_a_material_does_not_show_are_no_attribute(tmp_path):
    mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], colors=np.eye(3))
    raw = raw_of(scene_of(opaque(vertex_colors=False), cc.BasicMaterial(), mesh=mesh), tmp_path)
    assert not any("COLOR_0" in m["primitives"][0]["attributes"] for m in raw["meshes"])
    raw = raw_of(scene_of(opaque(), mesh=mesh), tmp_path)
    assert "COLOR_0" in raw["meshes"][0]["primitives"][0]["attributes"]


@pytest.mark.parametrize(("options", "path", "want"), WORDS)
def test_words_of_materials(options, path, want, tmp_path):
    raw = raw_of(scene_of(opaque(**options)), tmp_path)
    got = at(raw["materials"][0], path)
    assert got == pytest.approx(want, abs=1e-15)
    assert extras_in(raw["materials"]) == 0
    # The word, and nothing else but what it needs.
    used = set(raw.get("extensionsUsed", []))
    assert used == set(names_in(raw))
    needed = {"KHR_materials_volume", "KHR_materials_transmission"} if "KHR_" in path else set()
    assert used - needed <= {path.split(".")[0]}


@pytest.mark.parametrize(("name", "path"), MAPS.items(), ids=MAPS)
def test_maps_of_materials(name, path, tmp_path):
    image = cc.Image(
        PICTURE,
        encoding="srgb" if name in COLORS else "linear",
        wrap=("clamp", "mirror"),
        mag_filter="nearest",
        min_filter="linear_mipmap_nearest",
    )
    document = tree_of(scene_of(opaque(**{name: image})), tmp_path)
    raw = document.tree.raw
    assert at(raw["materials"][0], path) == {"index": 0}
    assert extras_in(raw["materials"]) == extras_in(raw["textures"]) == 0
    assert raw["textures"] == [{"sampler": 0, "source": 0}]
    assert raw["samplers"] == [
        {"magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648}
    ]
    assert raw["images"][0]["mimeType"] == "image/png"
    data = bytes(document.view(raw["images"][0]["bufferView"]).data)
    (tmp_path / "x.png").write_bytes(data)
    assert (cc.load_image(tmp_path / "x.png") == PICTURE).all()


def test_factors_of_maps(tmp_path):
    material = opaque(
        normal_map=PICTURE, normal_scale=-0.5, occlusion_map=PICTURE, occlusion_strength=0.5,
        clearcoat=1, clearcoat_normal_map=PICTURE, clearcoat_normal_scale=2,
    )  # fmt: skip
    entry = raw_of(scene_of(material), tmp_path)["materials"][0]
    assert entry["normalTexture"]["scale"] == -0.5
    assert entry["occlusionTexture"]["strength"] == 0.5
    assert at(entry, "KHR_materials_clearcoat.clearcoatNormalTexture.scale") == 2


def test_a_transform_places_the_picture_as_in_gltf(tmp_path):
    """KHR_texture_transform gives T R S for (u, v from the top), whose angle turns from v towards u."""
    place = cc.Texture(PICTURE, uv_set=1, offset=(0.3, -0.2), rotation=35, scale=(2, -3))
    entry = raw_of(scene_of(opaque(map=place)), tmp_path)["materials"][0]
    info = entry["pbrMetallicRoughness"]["baseColorTexture"]
    assert info["texCoord"] == 1
    told = info["extensions"]["KHR_texture_transform"]
    angle = told["rotation"]
    # The matrices of the specification, "Overview".
    move = np.array([[1, 0, told["offset"][0]], [0, 1, told["offset"][1]], [0, 0, 1]])
    turn = np.array(
        [
            [math.cos(angle), math.sin(angle), 0],
            [-math.sin(angle), math.cos(angle), 0],
            [0, 0, 1],
        ]
    )
    size = np.diag([*told["scale"], 1])
    flip = np.array([[1, 0, 0], [0, -1, 1], [0, 0, 1]])
    got = flip @ move @ turn @ size @ flip
    np.testing.assert_allclose(got[:2], place.matrix, rtol=0, atol=1e-6)


def test_numbers_that_png_cannot_hold_are_shown_and_kept(tmp_path):
    """Floats in a map of colours are linear: the PNG is what a screen shows."""
    linear = np.array([[[0, 0.5, 1], [2, 0.25, 0.75]]], np.float32)
    document = tree_of(scene_of(opaque(map=linear)), tmp_path)
    raw = document.tree.raw
    (tmp_path / "x.png").write_bytes(bytes(document.view(raw["images"][0]["bufferView"]).data))
    want = np.clip(linear, 0, 1)
    want = np.where(want <= 0.0031308, 12.92 * want, 1.055 * want ** (1 / 2.4) - 0.055)
    assert cc.load_image(tmp_path / "x.png").tolist() == np.rint(want * 255).tolist()
    assert np.array_equal(raw["textures"][0]["extras"]["cubecam"]["pixels"], linear)


@pytest.mark.parametrize(
    ("material", "want"),
    [
        (
            cc.MirrorMaterial(tint=(1, 0.5, 0)),
            {"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "roughnessFactor": 0}},
        ),
        (
            cc.GlassMaterial(ior=1.25, roughness=0.5),
            {
                "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5},
                "extensions": {
                    "KHR_materials_ior": {"ior": 1.25},
                    "KHR_materials_transmission": {"transmissionFactor": 1},
                },
            },
        ),
        (
            cc.BasicMaterial(color=(1, 0, 0), opacity=0.5),
            {
                "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]},
                "alphaMode": "BLEND",
                "extensions": {"KHR_materials_unlit": {}},
            },
        ),
        (
            cc.PhongMaterial(color=(0, 1, 0), shininess=6, double_sided=True),
            {
                "pbrMetallicRoughness": {
                    "baseColorFactor": [0, 1, 0, 1],
                    "metallicFactor": 0,
                    "roughnessFactor": pytest.approx(0.5**0.5),
                },
                "doubleSided": True,
            },
        ),
    ],
)  # fmt: skip
def test_other_materials_look_similar_elsewhere(material, want, tmp_path):
    entry = raw_of(scene_of(material), tmp_path)["materials"][0]
    assert without_extras(entry) == want
    assert entry["extras"]["cubecam"]["class"] == type(material).__name__


def test_what_is_too_bright_for_gltf_is_scaled(tmp_path):
    scene = scene_of(opaque(emissive=(4, 2, 0), emissive_strength=3))
    scene.add(cc.PointLight(color=(2, 1, 0), intensity=5))
    raw = raw_of(scene, tmp_path)
    assert raw["materials"][0]["emissiveFactor"] == [1, 0.5, 0]
    assert at(raw["materials"][0], "KHR_materials_emissive_strength.emissiveStrength") == 12
    (light,) = raw["extensions"]["KHR_lights_punctual"]["lights"]
    assert light == {"type": "point", "color": [1, 0.5, 0], "intensity": 10}


def turned(entry, vector):
    """Turn a vector by the rotation of a node."""
    x, y, z, w = entry.get("rotation", (0, 0, 0, 1))
    axis = np.array([x, y, z])
    return vector + 2 * np.cross(axis, np.cross(axis, vector) + w * np.asarray(vector))


def test_lights_get_nodes_that_point_along_minus_z(tmp_path):
    scene = cc.Scene()
    scene.add(cc.SpotLight((1, 2, 3), (1, -2, 0.5), angle=40, penumbra=0.25, decay=2))
    scene.add(cc.DirectionalLight((0, 0, 1), intensity=0.5))
    scene.add(cc.AmbientLight())
    raw = raw_of(scene, tmp_path)
    spot, sun = raw["extensions"]["KHR_lights_punctual"]["lights"]
    assert spot["spot"]["outerConeAngle"] == pytest.approx(math.radians(40))
    assert spot["spot"]["innerConeAngle"] == pytest.approx(math.radians(30))
    assert sun == {"type": "directional", "intensity": 0.5}
    assert raw["nodes"][0]["translation"] == [1, 2, 3]
    lights: tuple[Any, ...] = scene.lights
    for node, light in zip(raw["nodes"], lights, strict=False):
        np.testing.assert_allclose(turned(node, (0, 0, -1)), light.direction, atol=1e-12)
        assert node["extras"]["cubecam"]["carrier"]
    assert [n["extensions"]["KHR_lights_punctual"]["light"] for n in raw["nodes"]] == [0, 1]


def test_a_sharp_spot_has_an_inner_angle_below_the_outer_one(tmp_path):
    scene = cc.Scene()
    scene.add(cc.SpotLight(penumbra=0))
    (light,) = raw_of(scene, tmp_path)["extensions"]["KHR_lights_punctual"]["lights"]
    assert 0.999 < light["spot"]["innerConeAngle"] / light["spot"]["outerConeAngle"] < 1


def test_hidden_nodes_and_matrices(tmp_path):
    scene = cc.Scene()
    turn = np.array([[0, -2.0, 0, 5], [2, 0, 0, 6], [0, 0, 2, 7], [0, 0, 0, 1]])
    scene.add(visible=False, matrix=turn)
    shear = np.eye(4)
    shear[0, 1] = 1
    scene.add(matrix=shear)
    raw = raw_of(scene, tmp_path)
    assert raw["nodes"][0] == {
        "matrix": turn.T.reshape(-1).tolist(),
        "extensions": {"KHR_node_visibility": {"visible": False}},
    }
    # glTF has no shear (section 3.5.2): other programs see the nearest rotation and scale.
    assert "matrix" not in raw["nodes"][1]
    assert "scale" in raw["nodes"][1]
    assert raw["nodes"][1]["extras"]["cubecam"]["matrix"] == shear.tolist()


@pytest.mark.parametrize("name", ["a b%.gltf", "ä.gltf", "x.GLTF", "x.GLB"])
def test_files_beside_a_gltf(name, tmp_path):
    scene = scene_of(opaque(map=PICTURE), opaque(map=PICTURE[::-1].copy()))
    document = tree_of(scene, tmp_path, name)
    stem = name.rsplit(".", 1)[0]
    pictures = (
        [f"{stem}-0.png", f"{stem}-1.png", f"{stem}.bin"] if name.lower().endswith("f") else []
    )
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([*pictures, name])
    if pictures:
        assert (cc.load_image(tmp_path / pictures[1]) == PICTURE[::-1]).all()
    np.testing.assert_array_equal(document.accessor(0), cc.Mesh.box().positions)
    assert len(cc.load_mesh(tmp_path / name).positions) == 48


def test_an_empty_scene_can_be_saved(tmp_path):
    assert "nodes" not in raw_of(cc.Scene(), tmp_path)["scenes"][0]


@pytest.mark.parametrize("name", ["x.obj", "x", "x.gltf.zip"])
def test_another_ending_names_what_is_possible(name, tmp_path):
    with pytest.raises(ValueError, match=r"ends in \.glb or \.gltf; got"):
        cc.Scene().save(tmp_path / name)


@pytest.mark.parametrize("ending", ["glb", "gltf"])
def test_a_disk_that_fills_up_leaves_the_old_files(ending, tmp_path, monkeypatch):
    scene = scene_of(opaque(map=PICTURE))
    scene.save(tmp_path / f"x.{ending}")
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}
    scene.add(cc.Mesh.sphere(), opaque(map=PICTURE[::-1].copy()))

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(OSError, match="No space left"):
        scene.save(tmp_path / f"x.{ending}")
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_a_folder_that_is_not_there_is_an_os_error(tmp_path):
    with pytest.raises(FileNotFoundError, match="no such folder"):
        cc.Scene().save(tmp_path / "none" / "x.glb")


def test_a_texture_that_shows_another_scene_is_refused_before_a_byte_is_written(tmp_path):
    other = cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera())
    scene = scene_of(cc.BasicMaterial(map=other))
    with pytest.raises(ValueError, match="shows another scene"):
        scene.save(tmp_path / "x.gltf")
    assert not list(tmp_path.iterdir())


def _light(scene, node):
    scene.add(cc.PointLight(parent=node))


def _camera(scene, node):
    scene.add(cc.PerspectiveCamera(parent=node))


def _probe(scene, node):
    scene.add(cc.Mesh.box(), cc.MirrorMaterial()).environment = cc.Probe(parent=node)


def _skin(scene, node):
    shape = cc.Mesh(np.eye(3), [[0, 1, 2]], joints=[[0] * 4] * 3, joint_weights=[[1, 0, 0, 0]] * 3)
    joint = scene.add()
    scene.add(shape, skin=cc.Skin([joint]))
    scene.remove(joint)


@pytest.mark.parametrize("belong", [_light, _camera, _probe, _skin])
def test_what_belongs_to_a_node_of_another_scene_is_refused(belong, tmp_path):
    other = cc.Scene()
    scene = cc.Scene()
    scene.add()  # a node of the same id
    belong(scene, other.add(name="far"))
    with pytest.raises(ValueError, match="of the scene"):
        scene.save(tmp_path / "x.glb")
    assert not list(tmp_path.iterdir())


def test_an_animation_of_nothing_is_left_out_with_a_warning(tmp_path):
    scene = cc.Scene()
    node = scene.add()
    scene.add(cc.Animation([cc.AnimationChannel(node, "scale", [0], [(1, 1, 1)])], name="gone"))
    scene.remove(node)
    with pytest.warns(cc.SceneWarning, match="animation 'gone' moves no node") as told:
        scene.save(tmp_path / "x.glb")
    assert len(told) == 1
    assert told[0].filename == __file__
    assert "animations" not in tree_of(cc.load_scene(tmp_path / "x.glb"), tmp_path).tree.raw


def test_animations(tmp_path):
    scene = cc.Scene()
    node = scene.add()
    turns = [cc.axis_angle((1, 2, 3), a) for a in (0, 50)]
    moves = RNG.random((6, 3)).astype(np.float32)
    scene.add(
        cc.Animation(
            [
                cc.AnimationChannel(node, "rotation", [0, 1], turns, interpolation="step"),
                cc.AnimationChannel(node, "translation", [0, 2], moves, interpolation="cubic"),
            ]
        )
    )
    document = tree_of(scene, tmp_path)
    (entry,) = document.tree.raw["animations"]
    first, second = entry["samplers"]
    assert (first["interpolation"], second["interpolation"]) == ("STEP", "CUBICSPLINE")
    got = document.accessor(first["output"])
    np.testing.assert_allclose(got, [(*q[1:], q[0]) for q in turns], atol=1e-7)
    np.testing.assert_array_equal(document.accessor(second["output"]), moves)
    times = document.tree.raw["accessors"][second["input"]]
    assert (times["min"], times["max"]) == ([0], [2])
    assert [c["target"] for c in entry["channels"]] == [
        {"node": 0, "path": "rotation"},
        {"node": 0, "path": "translation"},
    ]


def test_joints_without_a_common_root_get_one(tmp_path):
    scene = cc.Scene()
    joints = [scene.add(), scene.add()]
    weights = np.array([[0.5, 0.5, 0, 0], [0.5, 0, 0.5, 0], [3, 1, 0, 0]])
    shape = cc.Mesh(np.eye(3), [[0, 1, 2]], joints=[[1, 0, 1, 1]] * 3, joint_weights=weights)
    scene.add(shape, skin=cc.Skin(joints, skeleton=joints[0]))
    document = tree_of(scene, tmp_path)
    raw = document.tree.raw
    assert raw["scenes"][0]["nodes"] == [2, 3]
    assert raw["nodes"][3] == {"children": [0, 1], "extras": {"cubecam": {"carrier": True}}}
    attributes = raw["meshes"][0]["primitives"][0]["attributes"]
    # Weights have a sum of 1, no joint counts twice, and one without weight is 0 (section 3.7.3.3).
    want = np.array([[0.5, 0.5, 0, 0], [1, 0, 0, 0], [0.75, 0.25, 0, 0]])
    np.testing.assert_allclose(document.accessor(attributes["WEIGHTS_0"]), want, atol=1e-7)
    assert document.accessor(attributes["JOINTS_0"]).tolist() == [[1, 0, 0, 0]] * 3
    # The skeleton is a root of all joints, or is not named.
    assert "skeleton" not in raw["skins"][0]
    assert document.stored(attributes["JOINTS_0"]).dtype == np.uint8


def test_variants_name_their_materials(tmp_path):
    scene = cc.Scene()
    scene.variants = ["day", "night", "dusk"]
    red, blue = opaque(), opaque(metallic=0)
    node = scene.add(cc.Mesh.box(), red)
    node.variants = {"dusk": blue, "day": blue}
    raw = raw_of(scene, tmp_path)
    name = "KHR_materials_variants"
    assert raw["extensions"][name] == {"variants": [{"name": n} for n in scene.variants]}
    (primitive,) = raw["meshes"][0]["primitives"]
    assert primitive["material"] == 0
    assert primitive["extensions"][name] == {"mappings": [{"material": 1, "variants": [0, 2]}]}


def test_morph_targets(tmp_path):
    change = RNG.normal(size=(24, 3))
    uvs = RNG.normal(size=(24, 2))
    box = cc.Mesh.box()
    targets = [cc.MorphTarget(positions=change, name="up"), cc.MorphTarget(uvs=uvs)]
    shape = cc.Mesh(box.positions, box.indices, uvs=box.uvs, morph_targets=targets)
    scene = cc.Scene()
    scene.add(shape, opaque(), weights=[0.5, 0])
    document = tree_of(scene, tmp_path)
    mesh = document.tree.raw["meshes"][0]
    assert mesh["weights"] == [0, 0]
    assert mesh["extras"]["targetNames"] == ["up", ""]
    assert document.tree.raw["nodes"][0]["weights"] == [0.5, 0]
    first, second = mesh["primitives"][0]["targets"]
    np.testing.assert_array_equal(document.accessor(first["POSITION"]), np.float32(change))
    np.testing.assert_array_equal(
        document.accessor(second["TEXCOORD_0"]), np.float32(uvs * (1, -1))
    )


def test_cameras(tmp_path):
    scene = cc.Scene()
    node = scene.add()
    scene.add(cc.PerspectiveCamera(fov=60, near=0.5, far=20, parent=node))
    scene.add(
        cc.OrthographicCamera(
            height=3, near=1, far=2, position=(1, 2, 3), target=(1, 0, 3), up=(0, 0, 1)
        )
    )
    raw = raw_of(scene, tmp_path)
    assert raw["cameras"] == [
        {
            "type": "perspective",
            "perspective": {"yfov": pytest.approx(math.pi / 3), "znear": 0.5, "zfar": 20},
        },
        {
            "type": "orthographic",
            "orthographic": {"xmag": 1.5, "ymag": 1.5, "znear": 1, "zfar": 2},
        },
    ]
    assert raw["nodes"][0] == {"camera": 0}
    carrier = raw["nodes"][1]
    assert carrier["translation"] == [1, 2, 3]
    np.testing.assert_allclose(turned(carrier, (0, 0, -1)), (0, -1, 0), atol=1e-12)
    np.testing.assert_allclose(turned(carrier, (0, 1, 0)), (0, 0, 1), atol=1e-12)


def test_files_of_equal_scenes_are_equal(tmp_path):
    """No time, no address, no order of a set."""
    scenes = [scene_of(opaque(map=PICTURE), cc.MirrorMaterial()) for _ in range(2)]
    for name, scene in zip("ab", scenes, strict=True):
        scene.save(tmp_path / f"{name}.glb")
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()
