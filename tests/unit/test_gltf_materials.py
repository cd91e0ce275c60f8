"""load_scene: every parameter of glTF's materials by value, and the textures with their places and samplers."""

import math

import numpy as np
import pytest

import cubecam as cc
from tests.gltf_files import CORNERS
from tests.scene_files import SQUARE_UVS, SceneFile, material_of, noise, picture


@pytest.fixture
def load(tmp_path):
    def load(file):
        (tmp_path / "a.glb").write_bytes(file.glb())
        return cc.load_scene(tmp_path / "a.glb")

    return load


@pytest.fixture
def material(load):
    """Load one material; textures of its entry are numbers of `SceneFile.texture`."""

    def material(entry, file=None):
        file = file or SceneFile()
        file.node(mesh=file.mesh(file.square(entry)))
        return load(file).nodes[0].material

    return material


def extension(name, **entry):
    return {"extensions": {name: entry}}


# Numbers: (entry, {attribute: value}).
NUMBERS = [
    ({}, {"color": (1, 1, 1, 1), "metallic": 1, "roughness": 1, "alpha_mode": "opaque"}),
    ({"name": "brass"}, {"name": "brass", "double_sided": False, "alpha_cutoff": 0.5}),
    (
        {
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
                "metallicFactor": 0.25,
                "roughnessFactor": 0.75,
            },
            "emissiveFactor": [0.5, 0.25, 2],
            "alphaMode": "BLEND",
            "doubleSided": True,
        },
        {
            "color": (0.1, 0.2, 0.3, 0.4),
            "metallic": 0.25,
            "roughness": 0.75,
            "emissive": (0.5, 0.25, 2),
            "alpha_mode": "blend",
            "double_sided": True,
        },
    ),
    ({"alphaMode": "MASK", "alphaCutoff": 0.3}, {"alpha_mode": "mask", "alpha_cutoff": 0.3}),
    (extension("KHR_materials_unlit"), {"unlit": True}),
    (extension("KHR_materials_emissive_strength", emissiveStrength=5), {"emissive_strength": 5}),
    (extension("KHR_materials_ior", ior=1.7), {"ior": 1.7}),
    (extension("KHR_materials_ior", ior=0), {"ior": 0}),
    (
        extension("KHR_materials_specular", specularFactor=0.2, specularColorFactor=[1, 2, 3]),
        {"specular_weight": 0.2, "specular_color": (1, 2, 3)},
    ),
    (
        extension("KHR_materials_clearcoat", clearcoatFactor=0.9, clearcoatRoughnessFactor=0.1),
        {"clearcoat": 0.9, "clearcoat_roughness": 0.1},
    ),
    (
        extension(
            "KHR_materials_sheen", sheenColorFactor=[0.1, 0.2, 0.3], sheenRoughnessFactor=0.4
        ),
        {"sheen_color": (0.1, 0.2, 0.3), "sheen_roughness": 0.4},
    ),
    (
        extension(
            "KHR_materials_iridescence",
            iridescenceFactor=1,
            iridescenceIor=1.8,
            iridescenceThicknessMinimum=200,
            iridescenceThicknessMaximum=500,
        ),
        {
            "iridescence": 1,
            "iridescence_ior": 1.8,
            "iridescence_thickness_min": 200,
            "iridescence_thickness_max": 500,
        },
    ),
    (
        extension(
            "KHR_materials_anisotropy", anisotropyStrength=0.6, anisotropyRotation=math.pi / 3
        ),
        {"anisotropy": 0.6, "anisotropy_rotation": 60},
    ),
    (
        {
            "extensions": {
                "KHR_materials_transmission": {"transmissionFactor": 0.8},
                "KHR_materials_volume": {
                    "thicknessFactor": 2,
                    "attenuationDistance": 3,
                    "attenuationColor": [0.5, 1, 0.25],
                },
                "KHR_materials_dispersion": {"dispersion": 0.3},
            }
        },
        {
            "transmission": 0.8,
            "thickness": 2,
            "attenuation_distance": 3,
            "attenuation_color": (0.5, 1, 0.25),
            "dispersion": 0.3,
        },
    ),
    (extension("KHR_materials_volume"), {"thickness": 0, "attenuation_distance": math.inf}),
    (
        extension(
            "KHR_materials_pbrSpecularGlossiness",
            diffuseFactor=[0.1, 0.2, 0.3, 1],
            specularFactor=[0.4, 0.5, 0.6],
            glossinessFactor=0.7,
        ),
        {
            "color": (0.1, 0.2, 0.3, 1),
            "specular_color": (0.4, 0.5, 0.6),
            "roughness": 0.3,
            "metallic": 0,
            "ior": 0,
        },
    ),
]


@pytest.mark.parametrize(("entry", "want"), NUMBERS)
def test_numbers(material, entry, want):
    made = material(entry)
    for name, value in want.items():
        got = getattr(made, name)
        if isinstance(value, (str, bool)):
            assert got == value, name
        else:
            np.testing.assert_allclose(got, value, rtol=1e-6, err_msg=name)


#: Where each texture stands in an entry, and the attribute that shows it; colours are sRGB.
MAPS = {
    ("pbrMetallicRoughness", "baseColorTexture"): ("map", "srgb"),
    ("pbrMetallicRoughness", "metallicRoughnessTexture"): ("metallic_roughness_map", "linear"),
    ("normalTexture",): ("normal_map", "linear"),
    ("occlusionTexture",): ("occlusion_map", "linear"),
    ("emissiveTexture",): ("emissive_map", "srgb"),
    ("extensions", "KHR_materials_specular", "specularTexture"): ("specular_map", "linear"),
    ("extensions", "KHR_materials_specular", "specularColorTexture"): (
        "specular_color_map",
        "srgb",
    ),
    ("extensions", "KHR_materials_clearcoat", "clearcoatTexture"): ("clearcoat_map", "linear"),
    ("extensions", "KHR_materials_clearcoat", "clearcoatRoughnessTexture"): (
        "clearcoat_roughness_map",
        "linear",
    ),
    ("extensions", "KHR_materials_clearcoat", "clearcoatNormalTexture"): (
        "clearcoat_normal_map",
        "linear",
    ),
    ("extensions", "KHR_materials_sheen", "sheenColorTexture"): ("sheen_color_map", "srgb"),
    ("extensions", "KHR_materials_sheen", "sheenRoughnessTexture"): (
        "sheen_roughness_map",
        "linear",
    ),
    ("extensions", "KHR_materials_iridescence", "iridescenceTexture"): (
        "iridescence_map",
        "linear",
    ),
    ("extensions", "KHR_materials_iridescence", "iridescenceThicknessTexture"): (
        "iridescence_thickness_map",
        "linear",
    ),
    ("extensions", "KHR_materials_anisotropy", "anisotropyTexture"): ("anisotropy_map", "linear"),
    ("extensions", "KHR_materials_transmission", "transmissionTexture"): (
        "transmission_map",
        "linear",
    ),
    ("extensions", "KHR_materials_volume", "thicknessTexture"): ("thickness_map", "linear"),
    ("extensions", "KHR_materials_pbrSpecularGlossiness", "diffuseTexture"): ("map", "srgb"),
}


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path[-1])
def test_maps(material, path):
    file, pixels = SceneFile(), noise(5, 3)
    info = {"index": file.texture(pixels), "texCoord": 1, "scale": 0.5, "strength": 0.25}
    entry = info
    for key in reversed(path):
        entry = {key: entry}
    name, encoding = MAPS[path]
    made = material(entry, file)
    shown = getattr(made, name)
    assert shown.uv_set == 1
    assert shown.source.encoding == encoding
    np.testing.assert_array_equal(shown.source.pixels, pixels)
    others = [n for n, _ in MAPS.values() if n != name]
    assert all(getattr(made, other) is None for other in others)
    if name == "normal_map":
        assert made.normal_scale == 0.5
    if name == "clearcoat_normal_map":
        assert made.clearcoat_normal_scale == 0.5
    if name == "occlusion_map":
        assert made.occlusion_strength == 0.25


def test_specular_glossiness_maps(material):
    file, pixels = SceneFile(), noise(4, 4, 4)
    made = material(
        extension(
            "KHR_materials_pbrSpecularGlossiness",
            glossinessFactor=0.5,
            specularGlossinessTexture={"index": file.texture(pixels)},
        ),
        file,
    )
    np.testing.assert_array_equal(made.specular_color_map.pixels, pixels)
    assert made.specular_color_map.encoding == "srgb"
    assert made.roughness == 1
    rough = made.metallic_roughness_map
    assert rough.encoding == "linear"
    np.testing.assert_allclose(
        rough.pixels[..., 1] / 255, 1 - 0.5 * pixels[..., 3] / 255, atol=0.5 / 255
    )


def looked_up(shown, uv):
    """Where a map is looked up, in the file's coordinates, for uv of the file."""
    u, v = uv
    x, y = shown.matrix @ (u, 1 - v, 1)
    return x, 1 - y


@pytest.mark.parametrize(
    ("transform", "uv", "want"),
    [
        # The example of the specification: the lower left quadrant, turned clockwise by 90 degrees.
        ({"offset": [0, 1], "rotation": math.pi / 2, "scale": [0.5, 0.5]}, (0, 0), (0, 1)),
        ({"offset": [0, 1], "rotation": math.pi / 2, "scale": [0.5, 0.5]}, (1, 0), (0, 0.5)),
        ({"offset": [0, 1], "rotation": math.pi / 2, "scale": [0.5, 0.5]}, (0, 1), (0.5, 1)),
        ({"offset": [0, 1], "scale": [1, -1]}, (0.25, 0.25), (0.25, 0.75)),
        # T R S: scale first, offset last.
        ({"offset": [3, 4], "rotation": math.pi / 2, "scale": [2, 5]}, (1, 0), (3, 2)),
        ({"offset": [3, 4], "rotation": math.pi / 2, "scale": [2, 5]}, (0, 1), (8, 4)),
        ({"rotation": math.pi / 6}, (1, 0), (math.cos(math.pi / 6), -0.5)),
        ({"offset": [0.5, 0.25]}, (0, 0), (0.5, 0.25)),
    ],
)
def test_texture_transforms(material, transform, uv, want):
    file = SceneFile()
    info = {"index": file.texture(noise(4, 4)), **extension("KHR_texture_transform", **transform)}
    shown = material({"emissiveTexture": info}, file).emissive_map
    np.testing.assert_allclose(looked_up(shown, uv), want, atol=1e-6)


def test_a_transform_names_texture_coordinates(material):
    file = SceneFile()
    transform = extension("KHR_texture_transform", texCoord=1)
    info = {"index": file.texture(noise(4, 4)), "texCoord": 0, **transform}
    assert material({"emissiveTexture": info}, file).emissive_map.uv_set == 1


WRAPS = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
SMALL = {
    9728: "nearest",
    9729: "linear",
    9984: "nearest_mipmap_nearest",
    9985: "linear_mipmap_nearest",
    9986: "nearest_mipmap_linear",
    9987: "linear_mipmap_linear",
}


@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("small", SMALL)
@pytest.mark.parametrize(("large", "mag_filter"), [(9728, "nearest"), (9729, "linear")])
def test_samplers(material, wrap, small, large, mag_filter):
    file = SceneFile()
    sampler = {"wrapS": wrap, "wrapT": 33071, "minFilter": small, "magFilter": large}
    shown = material({"emissiveTexture": {"index": file.texture(noise(4, 4), sampler)}}, file)
    image = shown.emissive_map
    pair = image.wrap if isinstance(image.wrap, tuple) else (image.wrap, image.wrap)
    assert pair == (WRAPS[wrap], "clamp")
    assert image.min_filter == SMALL[small]
    assert image.mag_filter == mag_filter


def test_no_sampler_repeats_and_uses_levels(material):
    file = SceneFile()
    image = material({"emissiveTexture": {"index": file.texture(noise(4, 4))}}, file).emissive_map
    assert (image.wrap, image.mag_filter, image.min_filter) == (
        "repeat",
        "linear",
        "linear_mipmap_linear",
    )


def test_what_is_used_twice_is_one_object(load):
    file = SceneFile()
    source = file.image(noise(4, 4))
    first, second = file.texture(source), file.texture(source)
    other = file.texture(source, {"wrapS": 33071})
    base = {"pbrMetallicRoughness": {"baseColorTexture": {"index": first}}}
    entries = [
        base | {"emissiveTexture": {"index": second}},
        base | {"emissiveTexture": {"index": other}},
    ]
    numbers = [file.add("materials", entry) for entry in entries]
    data = file.square()
    primitives = [{**data, "material": number} for number in (*numbers, numbers[0])]
    file.node(mesh=file.mesh(*primitives))
    a, b, c = (node for node in load(file).nodes if node.mesh is not None)
    assert a.mesh is b.mesh is c.mesh
    assert a.material is c.material is not b.material
    assert a.material.map is a.material.emissive_map is b.material.map
    assert b.material.emissive_map is not b.material.map
    assert b.material.emissive_map.wrap == ("clamp", "repeat")


def test_a_picture_of_16_bits_is_decoded_where_it_is_a_colour(material, tmp_path):
    pixels = np.array([[[0, 20000, 65535]]], np.uint16)
    cc.save_image(tmp_path / "deep.png", pixels)
    file = SceneFile()
    index = file.texture((tmp_path / "deep.png").read_bytes())
    made = material({"emissiveTexture": {"index": index}}, file)
    encoded = 20000 / 65535
    want = [0, ((encoded + 0.055) / 1.055) ** 2.4, 1]  # IEC 61966-2-1
    np.testing.assert_allclose(made.emissive_map.pixels[0, 0], want, rtol=1e-5)
    file = SceneFile()
    index = file.texture((tmp_path / "deep.png").read_bytes())
    made = material({"normalTexture": {"index": index}}, file)
    np.testing.assert_allclose(made.normal_map.pixels[0, 0], [0, encoded, 1], rtol=1e-5)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP"])
def test_kinds_of_pictures(material, kind):
    file, pixels = SceneFile(), np.full((4, 6, 3), 200, np.uint8)
    source = file.image(pixels, kind)
    entry = {"source": source}
    if kind == "WEBP":
        entry = extension("EXT_texture_webp", source=source)
        file.use("EXT_texture_webp", required=True)
    index = file.add("textures", entry)
    image = material({"emissiveTexture": {"index": index}}, file).emissive_map
    assert image.size == (6, 4)
    np.testing.assert_allclose(image.pixels, 200, atol=2)


def test_a_ktx2_picture(material):
    file, pixels = SceneFile(), noise(4, 4, 4)
    from cubecam.io import ktx2

    data = ktx2.write([pixels], encoding="srgb")
    source = file.image(data, "KTX2")
    file.use("KHR_texture_basisu", required=True)
    index = file.add("textures", extension("KHR_texture_basisu", source=source))
    image = material({"emissiveTexture": {"index": index}}, file).emissive_map
    np.testing.assert_array_equal(image.pixels, pixels)


def test_files_beside_the_model(tmp_path):
    pixels = noise(4, 4)
    folder = tmp_path / "maps"
    folder.mkdir()
    (folder / "a b.png").write_bytes(picture(pixels))
    file = SceneFile()
    image = file.add("images", {"uri": "maps/a%20b.png"})
    entry = {"emissiveTexture": {"index": file.add("textures", {"source": image})}}
    file.node(mesh=file.mesh(file.square(entry)))
    (tmp_path / "a.gltf").write_bytes(file.gltf())
    made = material_of(cc.load_scene(tmp_path / "a.gltf"))
    np.testing.assert_array_equal(made.emissive_map.pixels, pixels)


@pytest.mark.parametrize(
    ("uri", "text"),
    [
        ("missing.png", "not there"),
        ("../secret.png", "leads out"),
        ("file:///etc/passwd", "below the folder"),
        ("data:image/png;base64,AAAA", "another kind"),
    ],
)
def test_a_picture_that_cannot_be_read_is_left_out(tmp_path, uri, text):
    (tmp_path / "secret.png").write_bytes(picture(noise(4, 4)))
    (tmp_path / "model").mkdir()
    file = SceneFile()
    image = file.add("images", {"uri": uri})
    texture = file.add("textures", {"source": image})
    entry = {"emissiveTexture": {"index": texture}, "normalTexture": {"index": texture}}
    file.node(mesh=file.mesh(file.square(entry)))
    (tmp_path / "model" / "a.gltf").write_bytes(file.gltf())
    with pytest.warns(cc.SceneWarning, match=text) as seen:
        made = material_of(cc.load_scene(tmp_path / "model" / "a.gltf"))
    assert len(seen) == 1
    assert "textures[0]" in str(seen[0].message)
    assert made.emissive_map is None


def test_a_required_picture_that_cannot_be_read_is_refused(load):
    file = SceneFile()
    source = file.image(b"\xabKTX 20\xbb\r\n\x1a\n" + b"\0" * 90, "KTX2")
    file.use("KHR_texture_basisu", required=True)
    index = file.add("textures", extension("KHR_texture_basisu", source=source))
    file.node(mesh=file.mesh(file.square({"emissiveTexture": {"index": index}})))
    with pytest.raises(cc.MeshError, match=r"textures\[0\]: KHR_texture_basisu"):
        load(file)


def test_a_plain_picture_stands_in_for_one_that_is_not_read(material):
    file, pixels = SceneFile(), noise(4, 4)
    broken = file.image(b"\xabKTX 20\xbb\r\n\x1a\n" + b"\0" * 90, "KTX2")
    file.use("KHR_texture_basisu")
    entry = {"source": file.image(pixels), **extension("KHR_texture_basisu", source=broken)}
    index = file.add("textures", entry)
    image = material({"emissiveTexture": {"index": index}}, file).emissive_map
    np.testing.assert_array_equal(image.pixels, pixels)


def test_a_primitive_without_normals_is_flat(load):
    file = SceneFile()
    number = file.add("materials", {"name": "shared"})
    smooth = file.square(number)
    flat = {**file.primitive(CORNERS), "material": number}
    plain = file.add("materials", extension("KHR_materials_unlit"))
    unlit = {**file.primitive(CORNERS), "material": plain}
    file.node(mesh=file.mesh(smooth, flat, flat, unlit))
    a, b, c, d = (node.material for node in load(file).nodes if node.mesh is not None)
    assert (a.flat_shading, b.flat_shading, d.flat_shading) == (False, True, False)
    assert b is c
    assert a.name == b.name == "shared"


def test_other_sets_of_texture_coordinates(load):
    file, uvs = SceneFile(), SQUARE_UVS * 0.5
    entry = {"emissiveTexture": {"index": file.texture(noise(4, 4)), "texCoord": 3}}
    file.node(mesh=file.mesh(file.square(entry, TEXCOORD_3=uvs)))
    node = load(file).nodes[0]
    np.testing.assert_allclose(node.mesh.uvs, np.stack([uvs[:, 0], 1 - uvs[:, 1]], axis=1))


def test_numbers_out_of_range_are_clamped_with_a_warning(load):
    file = SceneFile()
    entry = {"pbrMetallicRoughness": {"metallicFactor": 1.5, "baseColorFactor": [2, 0, -1, 1]}}
    file.node(mesh=file.mesh(file.square(entry)))
    with pytest.warns(cc.SceneWarning, match=r"from 0 to 1.*materials\[0\]") as seen:
        made = load(file).nodes[0].material
    assert len(seen) == 1
    assert made.metallic == 1
    np.testing.assert_array_equal(made.color, (1, 0, 0, 1))


@pytest.mark.parametrize(
    ("entry", "text"),
    [
        ({"alphaMode": "SOMETIMES"}, r"materials\[0\].alphaMode: expected one of OPAQUE"),
        ({"emissiveFactor": [1, 2]}, r"materials\[0\].emissiveFactor: expected a list of 3"),
        ({"alphaCutoff": "x"}, r"materials\[0\].alphaCutoff: expected a finite number"),
        ({"emissiveTexture": {"index": 7}}, r"emissiveTexture.index: expected an index below 0"),
        ({"emissiveTexture": 3}, r"emissiveTexture: expected an object"),
    ],
)
def test_broken_entries_are_refused_with_their_place(load, entry, text):
    file = SceneFile()
    file.node(mesh=file.mesh(file.square(entry)))
    with pytest.raises(cc.MeshError, match=text):
        load(file)


def test_a_required_extension_that_is_not_followed_is_refused(load):
    file = SceneFile()
    file.use("KHR_materials_diffuse_transmission", required=True)
    file.node(mesh=file.mesh(file.square()))
    with pytest.raises(cc.MeshError, match="KHR_materials_diffuse_transmission"):
        load(file)


def test_an_extension_that_is_not_followed_gives_a_warning(load):
    file = SceneFile()
    file.use("KHR_materials_diffuse_transmission")
    file.use("KHR_xmp_json_ld")
    file.node(mesh=file.mesh(file.square()))
    with pytest.warns(cc.SceneWarning, match="KHR_materials_diffuse_transmission") as seen:
        load(file)
    assert len(seen) == 1
