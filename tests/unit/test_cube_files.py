"""Cubemaps as KTX2, DDS, .env, JSON and files of levels, and `save_for`: by value, with readers of their own."""

import json
import struct

import numpy as np
import pytest

import cubecam as cc
from tests.interop.directions import DIRECTIONS, sky, sky_cube
from tests.reference.cube_faces import unit_texel_directions


def levels_cube(dtype="f4", channels=3, sizes=(32, 16, 8)):
    rng = np.random.default_rng(3)
    made = [(rng.random((6, n, n, channels)) * 200).astype(dtype) for n in sizes]
    return cc.CubeMap.from_levels([cc.CubeMap(faces) for faces in made])


@pytest.mark.parametrize("suffix", [".ktx2", ".dds"])
@pytest.mark.parametrize("dtype", ["u1", "f2", "f4"])
@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize("convention", ["gl", "three", "inside"])
def test_levels_come_back(suffix, dtype, channels, convention, tmp_path):
    cube, path = levels_cube(dtype, channels), tmp_path / f"a{suffix}"
    cube.save(path, convention=convention)
    again = cc.load_cubemap(path)
    assert again == cube
    np.testing.assert_array_equal(again.roughness, [0, 0.5, 1])
    assert cc.load_cubemap(path, levels=False) == cc.CubeMap(cube.faces)
    assert len(cc.load_cubemap(path, size=16).levels) == 1
    wide = cc.load_cubemap(path, dtype="float32")
    assert [level.shape for level in wide.levels] == [level.shape for level in cube.levels]


def test_levels_of_files_that_do_not_say_so(tmp_path):
    cube = cc.CubeMap(levels_cube().faces, mipmaps=True)
    path = tmp_path / "a.ktx2"
    cube.save(path)
    assert cc.load_cubemap(path, mipmaps=True) == cube  # plain mipmaps are no filtered levels
    forced = cc.load_cubemap(path, levels=True)
    assert len(forced.levels) == 6
    # The mean of four texels, down to one.
    half = cube.faces.reshape(6, 16, 2, 16, 2, 3).mean((2, 4))
    np.testing.assert_allclose(forced.levels[1], half, rtol=1e-5)
    assert forced.levels[-1].shape == (6, 1, 1, 3)
    cc.CubeMap(cube.faces).save(path)
    with pytest.raises(ValueError, match="expected a DDS or KTX2 file with several levels"):
        cc.load_cubemap(path, levels=True)


def test_mipmaps_of_srgb_are_means_of_light(tmp_path):
    faces = np.zeros((6, 2, 2, 1), np.uint8)
    faces[:, 0, 0] = 255
    cc.CubeMap(faces, mipmaps=True).save(tmp_path / "a.ktx2")
    assert cc.load_cubemap(tmp_path / "a.ktx2", levels=True).levels[1].ravel()[0] == 137  # .25


@pytest.mark.parametrize("suffix", [".ktx2", ".dds"])
def test_filtered_levels_get_the_sizes_of_the_file(suffix, tmp_path):
    cube = sky_cube(64).prefilter(levels=4)
    assert cube.levels[3].shape[1] == 32
    cube.save(tmp_path / f"a{suffix}")
    again = cc.load_cubemap(tmp_path / f"a{suffix}")
    assert [level.shape[1] for level in again.levels] == [64, 32, 16, 8]
    want = cc.CubeMap(cube.levels[3]).resize(8).faces
    np.testing.assert_array_equal(again.levels[3], want)
    with pytest.raises(ValueError, match="expected at most 7 levels in a file of 64 texels"):
        sky_cube(64).prefilter(levels=8).save(tmp_path / f"a{suffix}")


def test_exposure_and_half(tmp_path):
    cube = levels_cube()
    cube.save(tmp_path / "a.ktx2", exposure=1, half=True)
    again = cc.load_cubemap(tmp_path / "a.ktx2")
    np.testing.assert_array_equal(again.faces, (cube.faces * 2).astype(np.float16))
    bright = cc.CubeMap(np.full((6, 2, 2, 3), 1e5, np.float32))
    with pytest.raises(ValueError, match="up to 65504"):
        bright.save(tmp_path / "a.dds", half=True)


@pytest.mark.parametrize(
    ("dtype", "channels", "dxgi"),
    [("u1", 3, 29), ("u1", 1, 29), ("f2", 4, 10), ("f4", 3, 2), ("f4", 1, 41), ("f2", 1, 54)],
)
def test_the_headers_of_dds(dtype, channels, dxgi, tmp_path):
    """Microsoft, "DDS_HEADER" and "DDS_HEADER_DXT10"; each face with all its levels before the next."""
    cube, path = levels_cube(dtype, channels), tmp_path / "a.dds"
    cube.save(path)
    data = path.read_bytes()
    words = struct.unpack_from("<31I", data, 4)
    stored = 1 if channels == 1 and dtype != "u1" else 4
    item = np.dtype(dtype).itemsize
    assert words[:7] == (124, 0x2100F, 32, 32, 32 * stored * item, 0, 3)
    assert words[18:20] == (32, 4)
    assert data[84:88] == b"DX10"
    assert words[26:28] == (0x401008, 0xFE00)
    assert struct.unpack_from("<5I", data, 128) == (dxgi, 3, 4, 1, 0)
    face = sum(n * n for n in (32, 16, 8)) * stored * item
    assert len(data) == 148 + 6 * face
    start = 148 + 3 * face + 32 * 32 * stored * item  # level 1 of -Y
    level = np.frombuffer(data, dtype, 16 * 16 * stored, start).reshape(16, 16, stored)
    want = cube.levels[1][3] if stored == 4 or channels == 1 else None
    np.testing.assert_array_equal(level[..., :channels], want)


def test_six_files_a_level_and_json(tmp_path):
    cube = levels_cube()
    cube.save(str(tmp_path / "{level}_{face}.exr"))
    for k, level in enumerate(cube.levels):
        again = cc.load_cubemap(str(tmp_path / f"{k}_{{face}}.exr"))
        np.testing.assert_array_equal(again.faces, level)
    cube.save(tmp_path / "light.json")
    told = json.loads((tmp_path / "light.json").read_text())
    np.testing.assert_allclose(told["radiance"], cube.sh(), rtol=1e-12)
    factors = np.array([1, *[2 / 3] * 3, *[1 / 4] * 5])[:, None]
    np.testing.assert_allclose(told["irradiance_over_pi"], cube.sh() * factors)
    assert len(told["basis"]) == 9


def env_parts(data):
    """The manifest and the pictures of a .env, turned upright, as light (H, W, 3)."""
    import io

    from PIL import Image

    assert data[:8] == b"\x86\x16\x87\x96\xf6\xd6\x96\x36"
    text, _, blobs = data[8:].partition(b"\0")
    told = json.loads(text)
    pictures = []
    for part in told["specular"]["mipmaps"]:
        blob = blobs[part["position"] : part["position"] + part["length"]]
        rgbd = np.asarray(Image.open(io.BytesIO(blob)).convert("RGBA")).astype(float) / 255
        pictures.append((rgbd[..., :3] ** 2.2 / rgbd[..., 3:])[::-1])
    return told, pictures


def test_babylons_env(tmp_path):
    cube = sky_cube(32)
    cube.save(tmp_path / "a.env")
    told, pictures = env_parts((tmp_path / "a.env").read_bytes())
    assert (told["version"], told["width"], told["imageType"]) == (2, 32, "image/png")
    assert [p.shape[0] for p in pictures[::6]] == [32, 16, 8, 4, 2, 1]
    directions = unit_texel_directions(32) * [-1, 1, 1]  # Babylon's x is the scene's -x
    np.testing.assert_allclose(np.stack(pictures[:6]), sky(directions), rtol=0.03, atol=0.01)
    # Diffuse light of a constant cube of 1 is 1: the harmonics of the polynomial are those of the light.
    flat = cc.CubeMap(np.ones((6, 8, 8, 3), np.float32))
    flat.save(tmp_path / "a.env")
    told, pictures = env_parts((tmp_path / "a.env").read_bytes())
    for name, value in told["irradiance"].items():
        np.testing.assert_allclose(value, 1 if name in ("xx", "yy", "zz") else 0, atol=1e-4)
    np.testing.assert_allclose(np.concatenate([p.ravel() for p in pictures]), 1, atol=0.02)
    with pytest.raises(ValueError, match="expected a power of two"):
        cc.CubeMap(np.ones((6, 12, 12, 3), np.float32)).save(tmp_path / "a.env")


def test_bright_light_in_an_env(tmp_path):
    cube = cc.CubeMap(np.full((6, 4, 4, 3), (200, 20, 2), np.float32))
    cube.save(tmp_path / "a.env")
    _, pictures = env_parts((tmp_path / "a.env").read_bytes())
    np.testing.assert_allclose(pictures[0][0, 0], (200, 20, 2), rtol=0.05)


#: Where each engine's formula places a direction in a panorama, as a share of the width.
PANORAMAS = {
    "three": lambda x, y, z: np.arctan2(z, x) / (2 * np.pi) + 0.5,  # equirectUv of common.glsl
    "godot": lambda x, y, z: np.arctan2(x, -z) / (2 * np.pi) % 1,  # sky.glsl
    "unity": lambda x, y, z: 0.5 - np.arctan2(z, -x) / (2 * np.pi),  # Skybox/Panoramic, of (-x, y, z)
    "blender": lambda x, y, z: -np.arctan2(-z, x) / (2 * np.pi) + 0.5,  # of (x, -z, y)
}  # fmt: skip


@pytest.mark.parametrize("engine", PANORAMAS)
def test_panoramas_are_right_by_the_engines_formulas(engine, tmp_path):
    files = sky_cube().save_for(engine, tmp_path)
    assert files[-1].name == "README.txt"
    assert len(files[-1].read_text().splitlines()) == 5
    picture = cc.load_image(tmp_path / "environment.exr").astype(float)
    assert picture.shape == (128, 256, 3)
    d = DIRECTIONS / np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)
    u = PANORAMAS[engine](*d.T)
    v = np.arccos(d[:, 1]) / np.pi
    rows = np.clip((v * 128).astype(int), 0, 127)
    found = picture[rows, (u * 256).astype(int) % 256]
    np.testing.assert_allclose(found, sky(DIRECTIONS), atol=0.05)


def test_save_for_of_other_kinds(tmp_path):
    grey = cc.CubeMap(np.full((6, 8, 8, 1), 188, np.uint8))  # sRGB of .5
    for engine in ("three", "babylon", "unity", "godot", "blender", "filament"):
        files = grey.save_for(engine, tmp_path / engine)
        assert sorted(path.name for path in files) == sorted(
            path.name for path in (tmp_path / engine).iterdir()
        )
        assert len(files[-1].read_text().splitlines()) == 5
    light = cc.load_image(tmp_path / "godot" / "environment.exr")
    np.testing.assert_allclose(light, 0.503, atol=2e-3)
    with pytest.raises(ValueError, match="engine: expected one of three, babylon"):
        grey.save_for("unreal", tmp_path)  # type: ignore[arg-type]


def test_options_that_do_not_go_together(tmp_path):
    cube = levels_cube()
    with pytest.raises(ValueError, match=r'compression: expected with "\.ktx2" only'):
        cube.save(tmp_path / "a.dds", compression="zlib")
    with pytest.raises(ValueError, match="expected none of them for"):
        cube.save(tmp_path / "a.ktx2", layout="cross")
    cube.save(tmp_path / "a.ktx2")
    with pytest.raises(ValueError, match="layout: expected None for a cubemap that holds faces"):
        cc.load_cubemap(tmp_path / "a.ktx2", layout="cross")


def test_from_levels():
    cube = levels_cube()
    with pytest.raises(ValueError, match="levels: expected 2 to 64, got 1"):
        cc.CubeMap.from_levels([cube])
    with pytest.raises(ValueError, match=r"levels\[1\]: expected 3 channels of float32, got 4"):
        cc.CubeMap.from_levels([cube, cc.CubeMap(np.ones((6, 2, 2, 4), np.float32))])
    with pytest.raises(TypeError, match=r"levels\[1\]: expected a CubeMap"):
        cc.CubeMap.from_levels([cube, 3])  # type: ignore[list-item]
    filtered = sky_cube(16).prefilter(levels=3)
    again = cc.CubeMap.from_levels([cc.CubeMap(level) for level in filtered.levels])
    assert again == filtered
