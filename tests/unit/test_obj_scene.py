"""load_scene of OBJ files with MTL: nodes by object, materials by Blender's conversions, maps with options."""

import math

import numpy as np
import pytest

import cubecam as cc
from tests.scene_files import material_of, noise, picture

SHAPE = """mtllib look.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0
vt 0 0
vt 1 0
vt 0 1
vt 1 1
"""
FACE = "f 1/1 2/2 3/3\n"
OTHER = "f 2/2 4/4 3/3\n"


@pytest.fixture
def load(tmp_path):
    def load(mtl, obj=SHAPE + "usemtl m\n" + FACE, **files):
        (tmp_path / "look.mtl").write_text(mtl)
        (tmp_path / "shape.obj").write_text(obj)
        for name, pixels in files.items():
            (tmp_path / f"{name}.png").write_bytes(picture(pixels))
        return cc.load_scene(tmp_path / "shape.obj")

    return load


def test_objects_are_nodes_and_materials_parts_of_them(load):
    obj = SHAPE + "o first\nusemtl m\n" + FACE + "usemtl n\n" + OTHER + "o second\n" + FACE
    scene = load("newmtl m\nKd 1 0 0\nnewmtl n\nKd 0 1 0\n", obj)
    first, second = (node for node in scene.nodes if node.parent is None)
    assert (first.name, second.name) == ("first", "second")
    assert [child.name for child in first.children] == ["first.0", "first.1"]
    assert [child.material.name for child in first.children] == ["m", "n"]
    assert second.material is first.children[1].material
    mesh = first.children[1].mesh
    np.testing.assert_array_equal(
        mesh.positions[mesh.indices[0]], [[1, 0, 0], [1, 1, 0], [0, 1, 0]]
    )
    np.testing.assert_array_equal(mesh.uvs[mesh.indices[0]], [[1, 0], [1, 1], [0, 1]])


def test_groups_are_nodes_where_there_are_no_objects(load):
    obj = SHAPE + "g a b\n" + FACE + "g c\n" + OTHER
    assert [node.name for node in load("", obj).nodes] == ["a b", "c"]


def test_a_file_without_names_is_one_node(load):
    assert [node.name for node in load("", SHAPE + FACE + OTHER).nodes] == ["shape"]


NUMBERS = [
    ("Kd .1 .2 .3", {"color": (0.1, 0.2, 0.3, 1), "metallic": 0, "alpha_mode": "opaque"}),
    ("Kd .5", {"color": (0.5, 0.5, 0.5, 1)}),
    ("", {"color": (0.8, 0.8, 0.8, 1), "roughness": 0.5}),
    ("Ns 250", {"roughness": 1 - math.sqrt(0.25)}),
    ("Ns 5000", {"roughness": 0}),
    ("Ns 250\nPr .25\nPm .75", {"roughness": 0.25, "metallic": 0.75}),
    ("Ka .6 .6 .6\nillum 3", {"metallic": 0.6}),
    ("Ka .6 .6 .6\nillum 2", {"metallic": 0}),
    ("Ks .2 .2 .2", {"specular_weight": 0.4, "specular_color": (1, 1, 1)}),
    ("Ks 1 1 1", {"specular_weight": 1, "specular_color": (2, 2, 2)}),
    ("Ni 1.7", {"ior": 1.7}),
    ("Ni 0", {"ior": 1.5}),
    ("Kd 1 1 1\nd .25", {"color": (1, 1, 1, 0.25), "alpha_mode": "blend"}),
    ("Kd 1 1 1\nTr .25", {"color": (1, 1, 1, 0.75), "alpha_mode": "blend"}),
    ("Ke 1 2 3", {"emissive": (1, 2, 3)}),
    ("Pc .5\nPcr .25", {"clearcoat": 0.5, "clearcoat_roughness": 0.25}),
    ("Ps .5", {"sheen_color": (0.5, 0.5, 0.5)}),
    ("aniso .5\nanisor .25", {"anisotropy": 0.5, "anisotropy_rotation": 90}),
]


@pytest.mark.parametrize(("lines", "want"), NUMBERS, ids=[n[0] for n in NUMBERS])
def test_numbers(load, lines, want):
    made = load(f"newmtl m\n{lines}\n").nodes[0].material
    for name, value in want.items():
        got = getattr(made, name)
        if isinstance(value, str):
            assert got == value
        else:
            np.testing.assert_allclose(got, value, rtol=1e-6, atol=1e-7, err_msg=name)


def test_maps(load):
    kd, ke, normals = noise(4, 3, seed=1), noise(4, 3, seed=2), noise(4, 3, seed=3)
    lines = "map_Kd kd.png\nmap_Ke ke.png\nnorm -bm .5 n.png\nKe 0 0 0\nKd 0 0 0\n"
    made = load(f"newmtl m\n{lines}", kd=kd, ke=ke, n=normals).nodes[0].material
    np.testing.assert_array_equal(made.map.pixels, kd)
    np.testing.assert_array_equal(made.emissive_map.pixels, ke)
    np.testing.assert_array_equal(made.normal_map.pixels, normals)
    assert (made.map.encoding, made.normal_map.encoding) == ("srgb", "linear")
    assert made.map.wrap == "repeat"
    np.testing.assert_array_equal(made.emissive, (1, 1, 1))
    np.testing.assert_array_equal(made.color, (1, 1, 1, 1))
    assert made.normal_scale == 0.5


def test_options_of_a_map(load):
    line = "map_Kd -s 2 3 1 -o .5 .25 -clamp on -mm 0 1 a picture.png"
    made = load(f"newmtl m\n{line}\n", **{"a picture": noise(4, 4)}).nodes[0].material
    assert made.map.scale == (2, 3)
    assert made.map.offset == (0.5, 0.25)
    assert made.map.source.wrap == "clamp"


def test_a_map_of_alpha(load):
    kd = noise(4, 4)
    mask = np.array([[[0], [128]], [[255], [51]]], np.uint8)
    made = load("newmtl m\nmap_Kd kd.png\nmap_d d.png\n", kd=kd, d=mask).nodes[0].material
    np.testing.assert_array_equal(made.map.pixels[..., :3], kd)
    np.testing.assert_array_equal(
        made.map.pixels[..., 3], np.repeat(np.repeat(mask[..., 0], 2, axis=0), 2, axis=1)
    )
    assert made.alpha_mode == "blend"


def test_maps_of_roughness_and_metal(load):
    pr, pm = noise(4, 4, 1, seed=1), noise(2, 2, 1, seed=2)
    made = load("newmtl m\nmap_Pr pr.png\nmap_Pm pm.png\n", pr=pr, pm=pm).nodes[0].material
    pixels = made.metallic_roughness_map.pixels
    np.testing.assert_array_equal(pixels[..., 1], pr[..., 0])
    np.testing.assert_array_equal(pixels[::2, ::2, 2], pm[..., 0])
    assert (made.roughness, made.metallic) == (1, 1)


def test_a_map_of_heights_is_left_out_with_a_warning(load):
    with pytest.warns(cc.SceneWarning, match="a map of heights is not read"):
        made = load("newmtl m\nmap_Bump -bm 2 b.png\n", b=noise(4, 4, 1)).nodes[0].material
    assert made.normal_map is None


@pytest.mark.parametrize(
    ("mtl", "text"),
    [
        ("newmtl m\nmap_Kd missing.png\n", "a picture is left out.*missing.png"),
        ("newmtl m\nmap_Kd ../../secret.png\n", "a picture is left out"),
        ("newmtl other\n", r"a material is in no library \(m\)"),
        ("newmtl m\ndisp a.png\n", "disp of an MTL is not read"),
    ],
)
def test_what_is_left_out(load, mtl, text):
    with pytest.warns(cc.SceneWarning, match=text):
        made = load(mtl).nodes[0].material
    assert made.map is None


def test_a_missing_library(tmp_path):
    (tmp_path / "a.obj").write_text("mtllib b.mtl c.mtl\nusemtl m\n" + SHAPE[16:] + FACE)
    with pytest.warns(cc.SceneWarning, match="a library of materials is left out"):
        made = material_of(cc.load_scene(tmp_path / "a.obj"))
    assert made.name == "m"


def test_an_absolute_path_of_another_machine_finds_the_file_beside_the_model(load):
    kd = noise(4, 4)
    made = load("newmtl m\nmap_Kd C:\\work\\kd.png\n", kd=kd).nodes[0].material
    np.testing.assert_array_equal(made.map.pixels, kd)


def test_smoothing_off_is_flat(load):
    scene = load("newmtl m\n", SHAPE + "usemtl m\ns off\n" + FACE + "s 1\n" + OTHER)
    assert [node.material.flat_shading for node in scene.nodes if node.mesh] == [True, False]


def test_the_first_material_of_a_name_counts(load):
    made = load("newmtl m\nPr .2\nnewmtl m\nPr .9\n").nodes[0].material
    assert made.roughness == pytest.approx(0.2)
