"""Maps of colours of 8 bits are sRGB: decoded before they are filtered and before mip levels are made."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.images import sample_image
from tests.compare import assert_close, assert_identical
from tests.gl.flat import CORNERS, flat_camera, quad
from tests.helpers import DEVICE

PICTURE = np.random.default_rng(3).integers(0, 256, (6, 9, 4), dtype=np.uint8)


def decoded(values):
    """Decode by IEC 61966-2-1; alpha, the fourth channel, is linear."""
    values = np.asarray(values) / 255
    colors = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    if values.shape[-1] == 4:
        colors[..., 3] = values[..., 3]
    return colors


def look(renderer, source, size=(20, 14), uvs=CORNERS, **options):
    """The picture of a map that is neither lit nor shaded, and where it was looked up."""
    scene = cc.Scene(background=(0, 0, 0, 0))
    scene.add(quad(size[0], size[1], uvs), cc.StandardMaterial(unlit=True, map=source, **options))
    x, y = ((np.arange(n) + 0.5) / n for n in size)
    uv = np.stack(np.meshgrid(x, y[::-1]), axis=-1)
    return renderer.render(scene, flat_camera(*size), size, format="rgba32f").color.astype(
        float
    ), uv


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_texels_are_decoded_and_then_filtered(renderer, channels):
    picture = PICTURE[..., :channels]
    material = {"alpha_mode": "opaque"}
    got, uv = look(renderer, picture, **material)
    want = sample_image(decoded(picture), uv)
    want = np.repeat(want, 3, axis=-1) if channels == 1 else want[..., :3]
    assert_close(got[..., :3], want, "srgb_filter")
    # Decoding what was filtered gives other numbers.
    wrong = decoded(255 * sample_image(picture, uv)[..., :3])
    assert np.abs(wrong - want).max() > 0.05


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_large_pictures_are_uploaded_in_parts(renderer, channels, encoding):
    """A frame with a pixel for each of more than a million texels shows them all, each in its place."""
    picture = np.random.default_rng(4).integers(0, 256, (1100, 1000, channels), dtype=np.uint8)
    image = cc.Image(picture, encoding=encoding, mag_filter="nearest", min_filter="nearest")
    got, _ = look(renderer, image, (1000, 1100), alpha_mode="opaque")
    want = decoded(picture) if encoding == "srgb" else picture / 255
    want = np.repeat(want, 3, axis=-1) if channels == 1 else want[..., :3]
    assert_close(got[..., :3], want, "srgb_filter")


def test_alpha_is_linear(renderer):
    got, uv = look(renderer, PICTURE, alpha_mode="blend", blend=cc.Blend("one", "zero"))
    assert_close(got[..., 3], sample_image(PICTURE, uv)[..., 3], "srgb_filter")


@pytest.mark.parametrize(
    "source",
    [
        cc.Image(PICTURE[..., :3], encoding="linear"),
        (PICTURE[..., :3] / 255).astype(np.float32),
        cc.Image((PICTURE[..., :3] / 255).astype(np.float32), encoding="srgb"),
    ],
    ids=["linear", "float", "floats that are sRGB"],
)
def test_other_numbers_count_as_they_are(renderer, source):
    got, uv = look(renderer, source)
    assert_close(got[..., :3], sample_image(PICTURE[..., :3], uv), "unorm8_filter")


def test_one_image_may_be_both(renderer):
    """The same image in a map of colours and in a material that computes with its numbers."""
    image = cc.Image(PICTURE[..., :3])
    scene = cc.Scene()
    scene.add(quad(10, 14), cc.StandardMaterial(unlit=True, map=image))
    scene.add(quad(10, 14), cc.BasicMaterial(map=image), position=(10, 0, 0))
    got = renderer.render(scene, flat_camera(20, 14), (20, 14), format="rgba32f").color[..., :3]
    x, y = (np.arange(10) + 0.5) / 10, (np.arange(14) + 0.5) / 14
    uv = np.stack(np.meshgrid(x, y[::-1]), axis=-1)
    assert_close(got[:, :10], sample_image(decoded(PICTURE[..., :3]), uv), "srgb_filter")
    assert_close(got[:, 10:], sample_image(PICTURE[..., :3], uv), "unorm8_filter")


def checks(size=16):
    return (
        (np.indices((size, size)).sum(axis=0)[..., None] % 2 * 255)
        .astype(np.uint8)
        .repeat(3, axis=-1)
    )


def test_levels_are_means_of_decoded_numbers(renderer):
    """Black and white mean light of a half: encoded it is 188, and not 128, which would be a fifth."""
    got, _ = look(renderer, cc.Image(checks(), mipmaps=True), size=(4, 4))
    np.testing.assert_allclose(got[..., :3], 0.5, atol=0.006)
    got, _ = look(renderer, cc.Image(checks(), mipmaps=True, encoding="linear"), size=(4, 4))
    np.testing.assert_allclose(got[..., :3], 0.5, atol=0.006)


def shown(picture, size, **options):
    """A render texture of 8 bits that shows a picture, and the scene in it."""
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(quad(*size), cc.BasicMaterial(map=picture), name="picture")
    return scene, cc.RenderTexture(scene, flat_camera(*size), size=size, **options)


def test_a_render_texture_of_photographs_is_decoded(renderer):
    _, texture = shown(cc.Image(PICTURE[..., :3], wrap="clamp"), (9, 6))
    got, uv = look(renderer, texture)
    want = sample_image(decoded(PICTURE[..., :3]), uv, "clamp")
    assert_close(got[..., :3], want, "srgb_filter")


@pytest.mark.parametrize("change", ["linear", "rgba16f"])
def test_a_render_texture_of_other_numbers_is_not(renderer, change):
    image = cc.Image(
        PICTURE[..., :3], wrap="clamp", encoding="linear" if change == "linear" else "srgb"
    )
    _, texture = shown(image, (9, 6), format="rgba8" if change == "linear" else change)
    got, uv = look(renderer, texture)
    assert_close(got[..., :3], sample_image(PICTURE[..., :3], uv, "clamp"), "unorm8_filter")


def test_levels_of_render_textures(renderer):
    _, texture = shown(checks(), (16, 16), mipmaps=True)
    got, _ = look(renderer, texture, size=(4, 4))
    np.testing.assert_allclose(got[..., :3], 0.5, atol=0.006)


def test_a_light_out_of_view_makes_a_render_texture_linear(renderer):
    """What a picture's numbers are depends on nodes that no pixel shows; the map follows."""
    inner, texture = shown(cc.Image(PICTURE[..., :3], wrap="clamp"), (9, 6))
    scene = cc.Scene(background=(0, 0, 0, 0))
    scene.add(quad(20, 14), cc.StandardMaterial(unlit=True, map=texture))

    def draw(with_renderer):
        return with_renderer.render(scene, flat_camera(20, 14), (20, 14), format="rgba32f").color

    first = draw(renderer)
    node = inner.add(cc.Mesh.box(), cc.PhongMaterial(), position=(0, 0, 50))
    second = draw(renderer)
    assert np.abs(second - first).max() > 0.1
    with cc.Renderer(device=DEVICE) as fresh:
        assert_identical(draw(fresh), second)
    node.visible = False
    assert_identical(draw(renderer), first)
    draw(renderer)
    assert renderer.stats.views_drawn == 0


def test_a_picture_of_decoded_maps_is_linear(renderer):
    scene = cc.Scene(background=(0, 0, 0))
    scene.add(quad(9, 6), cc.StandardMaterial(unlit=True, map=PICTURE[..., :3]))
    assert renderer.render(scene, flat_camera(9, 6), (9, 6)).encoding == "linear"
