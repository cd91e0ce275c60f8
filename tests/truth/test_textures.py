"""Lookups in pictures against the numpy reference and the renderer's pictures of them."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.scene.textures import Lookup
from cubecam.truth.shading import sample_image
from cubecam.truth.surfaces.colors import basic_color, standard_point, surface_points
from tests.compare import assert_close
from tests.reference.raycast import interior
from tests.truth.rays import seen

WRAPS = ["repeat", "clamp", "mirror", ("clamp", "repeat")]
CAMERA = cc.PerspectiveCamera(position=(0.2, 0.3, 2.5), target=(0, 0.1, 0))
SIZE = (64, 48)


@pytest.mark.parametrize("nearest", [False, True])
@pytest.mark.parametrize("wrap", WRAPS, ids=str)
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_lookups_are_those_of_the_reference(rng, wrap, nearest, channels):
    for pixels in (
        rng.random((5, 7, channels)).astype(np.float32),
        rng.integers(0, 256, (5, 7, channels), dtype=np.uint8),
    ):
        uv = rng.uniform(-2, 3, (400, 2))
        pair = (wrap, wrap) if isinstance(wrap, str) else wrap
        got = Lookup(pixels, pair, nearest).at(uv)
        want = sample_image(pixels, uv, wrap, nearest=nearest)
        assert got.shape == (400, 4)
        np.testing.assert_allclose(got[:, : min(channels, 3)], want[:, :3], atol=1e-12)
        if channels == 1:
            np.testing.assert_allclose(got[:, 1:3], want.repeat(2, axis=1), atol=1e-12)
        np.testing.assert_allclose(got[:, 3:], want[:, 3:] if channels == 4 else 1, atol=1e-12)


def test_colors_are_decoded_before_they_are_mixed():
    pixels = np.array([[[0, 0, 0, 0], [255, 255, 255, 255]]], np.uint8)
    middle = np.array([[0.5, 0.5], [0.25, 0.5]])
    assert Lookup(pixels, decode=True).at(middle).tolist() == [[0.5] * 4, [0] * 4]
    grey = np.full((1, 1, 1), 128, np.uint8)
    want = ((128 / 255 + 0.055) / 1.055) ** 2.4
    np.testing.assert_allclose(Lookup(grey, decode=True).at(middle)[0], [want] * 3 + [1])


def wall(material, rng, uvs1=False):
    """A turned plane with colours, and with uvs beyond 0 to 1."""
    scene = cc.Scene()
    mesh = cc.Mesh.plane(2, 2)
    uvs = np.asarray(mesh.uvs) * 2.3 - 0.4
    mesh.uvs = uvs
    mesh.colors = rng.uniform(0.3, 1, (4, 3))
    if uvs1:
        mesh.uvs1 = uvs[:, ::-1] * 0.7
    scene.add(mesh, material, rotation=cc.axis_angle((1, 0.1, 0.2), 60))
    return scene


def compared(renderer, scene, color_of, tolerance):
    """Compare the renderer's picture with a colour and an alpha for each point."""
    snapshot, hits, origins, directions = seen(scene, CAMERA, SIZE)
    points = surface_points(snapshot, hits, directions, origins)
    want = np.zeros((SIZE[0] * SIZE[1], 4))
    want[points.row] = np.concatenate(color_of(snapshot, points), axis=1)
    picture = want.reshape(SIZE[1], SIZE[0], 4)
    frame = renderer.render(scene, CAMERA, SIZE, format="rgba32f")
    inner = interior((hits.triangle >= 0).reshape(SIZE[1], SIZE[0]))
    assert 0.1 < (want[:, 3] > 0).mean() < 0.9
    assert_close(frame.color, picture, tolerance, mask=inner)


@pytest.mark.parametrize("wrap", WRAPS, ids=str)
@pytest.mark.parametrize("dtype", [np.float32, np.uint8])
def test_basic_materials_show_their_maps(renderer, rng, wrap, dtype):
    pixels = rng.random((9, 5, 3)).astype(np.float32)
    if dtype == np.uint8:
        pixels = np.round(pixels * 255).astype(np.uint8)
    material = cc.BasicMaterial(
        color=(0.9, 0.5, 0.3), map=cc.Image(pixels, wrap=wrap), vertex_colors=True
    )
    tolerance = "unorm8_filter" if dtype == np.uint8 else "shaded"
    compared(
        renderer,
        wall(material, rng),
        lambda snapshot, points: basic_color(snapshot, 0, points),
        tolerance,
    )


def test_basic_materials_show_cubes_by_their_own_positions(renderer, rng):
    from tests.gl.world import smooth_environment

    scene = cc.Scene()
    cube = cc.CubeMap(smooth_environment(32))
    scene.add(
        cc.Mesh.box((1, 1.5, 0.7)),
        cc.BasicMaterial(color=(0.9, 0.5, 0.3), cubemap=cube),
        rotation=cc.axis_angle((1, 0.4, 0.2), 40),
        scale=(-1, 1, 1),
    )
    compared(renderer, scene, lambda snapshot, points: basic_color(snapshot, 0, points), "shaded")


@pytest.mark.parametrize("uv_set", [0, 1])
@pytest.mark.parametrize("kind", ["float", "srgb", "linear"])
def test_standard_materials_place_and_decode_their_maps(renderer, rng, kind, uv_set):
    pixels = rng.random((9, 5, 3)).astype(np.float32)
    image = cc.Image(pixels)
    if kind != "float":
        image = cc.Image(np.round(pixels * 255).astype(np.uint8), encoding=kind)
    placed = cc.Texture(image, uv_set=uv_set, offset=(0.3, -0.2), rotation=25, scale=(1.4, -0.6))
    material = cc.StandardMaterial(color=(0.9, 0.5, 0.3), map=placed, unlit=True)

    def shown(snapshot, points):
        parameters, _surface, alpha = standard_point(snapshot, 0, points)
        assert parameters.unlit
        return parameters.color, alpha

    tolerance = "shaded" if kind == "float" else "unorm8_filter"
    compared(renderer, wall(material, rng, uvs1=True), shown, tolerance)
