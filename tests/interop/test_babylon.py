"""Babylon.js reflects in each direction what the cubemap holds there, and filters as cubecam does."""

import numpy as np
import pytest

import cubecam as cc
from tests.interop.directions import DIRECTIONS, sky, sky_cube

pytestmark = pytest.mark.interop


def shown(page, url, **options):
    argument = {"url": url, "metallic": 1, "roughness": 0, "directions": DIRECTIONS.tolist()}
    return np.array(page("babylon.html", {**argument, **options}))


@pytest.mark.parametrize("right", [False, True])
def test_a_mirror(right, tmp_path, page):
    sky_cube().save_for("babylon", tmp_path)
    found = shown(page, "/environment.env", rightHanded=right)
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.03


@pytest.mark.parametrize("roughness", [0.4, 0.7])
def test_rough_metal(roughness, tmp_path, page):
    """A patch of light, filtered. Babylon mixes the diffuse light in, by the square of the roughness."""
    cube = lit_patch()
    cube.save_for("babylon", tmp_path)
    found = shown(page, "/environment.env", roughness=roughness)
    filtered = cube.prefilter(levels=11)
    level = filtered.levels[round(roughness * 10)]
    share = roughness**2
    want = (1 - share) * cc.CubeMap(level).sample(DIRECTIONS) + share * diffuse(cube)
    spread = want.max() - want.min()
    assert spread > 0.3
    assert np.abs(found - want).max() < 0.12 * spread + 0.03


def test_the_irradiance(tmp_path, page):
    cube = lit_patch()
    cube.save_for("babylon", tmp_path)
    found = shown(page, "/environment.env", metallic=0, roughness=1)
    assert np.abs(found - diffuse(cube)).max() < 0.03


def test_dds(tmp_path, page):
    cube = sky_cube().prefilter(levels=4)
    cube.save(tmp_path / "sky.dds", convention="three", half=True)
    found = shown(page, "/sky.dds")
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.03


def diffuse(cube):
    rows = cube.sh() * np.array([1, *[2 / 3] * 3, *[1 / 4] * 5])[:, None]
    return np.maximum(cc.CubeMap.from_sh(rows, size=64).sample(DIRECTIONS), 0)


def lit_patch(size=64):
    faces = np.full((6, size, size, 3), 0.1, np.float32)
    faces[cc.Face.POS_X, : size // 2] = (4, 2, 0.5)
    faces[cc.Face.NEG_Z, :, size // 2 :] = (0.5, 1, 3)
    return cc.CubeMap(faces)
