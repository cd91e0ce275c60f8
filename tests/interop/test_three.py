"""three.js shows in each direction what the cubemap holds there."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.io import ktx2
from tests.interop.directions import DIRECTIONS, sky, sky_cube

pytestmark = pytest.mark.interop
#: SwiftShader clips the box of three.js' background wrongly near its corners: these directions are left out there.
CORNERS = [6, 9, 10]
SIX = [f"/{face}.hdr" for face in ("px", "nx", "py", "ny", "pz", "nz")]


@pytest.mark.parametrize(("kind", "url"), [("exr", "/environment.exr"), ("six", SIX)])
@pytest.mark.parametrize("mode", ["background", "mirror"])
def test_what_save_for_writes(kind, url, mode, tmp_path, page):
    sky_cube().save_for("three", tmp_path)
    argument = {"kind": kind, "url": url, "mode": mode, "directions": DIRECTIONS.tolist()}
    found = np.array(page("three.html", argument))
    difference = np.abs(found - sky(DIRECTIONS))
    if mode == "background":
        difference = np.delete(difference, CORNERS, axis=0)
    assert difference.max() < 0.02


def test_a_radiance_panorama(tmp_path, page):
    sky_cube().save(tmp_path / "sky.hdr", layout="equirect", center="+x")
    argument = {"kind": "hdr", "url": "/sky.hdr", "mode": "mirror"}
    found = np.array(page("three.html", {**argument, "directions": DIRECTIONS.tolist()}))
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.02


@pytest.mark.parametrize("kind", ["png", "six_png"])
def test_pictures_of_8_bits(kind, tmp_path, page):
    """As docs/howto/three_js.md says; light above 1 is left out, since 8 bits end there."""
    half = cc.CubeMap(0.5 * sky_cube().faces)
    half.save(tmp_path / "sky.png", layout="equirect", center="+x", tonemap=None)
    half.save(tmp_path / "{face}.png", convention="three", tonemap=None)
    url = "/sky.png" if kind == "png" else [path.replace("hdr", "png") for path in SIX]
    argument = {"kind": kind, "url": url, "mode": "mirror", "directions": DIRECTIONS.tolist()}
    found = np.array(page("three.html", argument))
    assert np.abs(2 * found - sky(DIRECTIONS)).max() < 0.04


def test_a_ktx2_panorama(tmp_path, page):
    """three.js reads uncompressed KTX2 of one face; of a cubemap it takes the first face alone."""
    panorama = sky_cube().to_equirect(width=256, center="+x")[
        ::-1
    ]  # DataTexture has row 0 at the bottom
    data = ktx2.write([np.ascontiguousarray(panorama)], encoding="linear", compression="zstd")
    (tmp_path / "sky.ktx2").write_bytes(data)
    argument = {"kind": "ktx2", "url": "/sky.ktx2", "mode": "mirror"}
    found = np.array(page("three.html", {**argument, "directions": DIRECTIONS.tolist()}))
    assert np.abs(found - sky(DIRECTIONS)).max() < 0.06  # its lookups are not filtered
