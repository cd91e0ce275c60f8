"""2D images on surfaces, wrapping, mip levels, and colours of vertices."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading.images import sample_image
from tests.compare import assert_close
from tests.gl.world import World, inner, perspective
from tests.reference.raycast import Triangles

PICTURE = np.random.default_rng(8).integers(0, 256, (6, 9, 3), dtype=np.uint8)


def quad(uvs=None, colors=None):
    positions = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    return cc.Mesh(positions, [[0, 1, 2], [0, 2, 3]], uvs=uvs, colors=colors)


CORNERS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)


def seen(renderer, mesh, material, view=None, **place):
    world = World()
    shape = Triangles(
        0, positions=mesh.positions, indices=mesh.indices, uvs=mesh.uvs, colors=mesh.colors
    )
    world.add(mesh, shape, material=material, **place)
    view = view or perspective((0.3, -0.2, 2.2), (0, 0, 0), size=(40, 40))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    mask = inner(hits) & hits.hit
    assert mask.sum() > 200
    return frame.color[mask], hits, mask


@pytest.mark.parametrize("dtype", [np.uint8, np.float16, np.float32])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_uv_0_0_is_the_bottom_left(renderer, dtype, channels):
    picture = np.random.default_rng(9).integers(0, 256, (6, 9, channels), dtype=np.uint8)
    if channels == 4:
        picture[..., 3] = 255
    picture = picture if dtype == np.uint8 else (picture / 255).astype(dtype)
    got, hits, mask = seen(renderer, quad(CORNERS), cc.BasicMaterial(map=picture))
    want = sample_image(picture, hits.uv[mask])
    want = np.repeat(want, 3, axis=-1) if channels == 1 else want[..., :3]
    assert_close(got[..., :3], want, "unorm8_filter")


@pytest.mark.parametrize(
    "wrap", ["repeat", "clamp", "mirror", ("mirror", "clamp"), ("clamp", "repeat")]
)
def test_wrapping(renderer, wrap):
    mesh = quad(CORNERS * 3 - 1.2)
    got, hits, mask = seen(renderer, mesh, cc.BasicMaterial(map=cc.Image(PICTURE, wrap=wrap)))
    assert_close(got[..., :3], sample_image(PICTURE, hits.uv[mask], wrap), "unorm8_filter")


def test_the_nearest_texel(renderer):
    image = cc.Image(PICTURE, mag_filter="nearest", wrap=("mirror", "clamp"))
    got, hits, mask = seen(renderer, quad(CORNERS * 2 - 0.3), cc.BasicMaterial(map=image))
    uv = hits.uv[mask]
    # Where the nearest texel changes, rounding decides.
    inside = (np.abs(uv * (9, 6) - np.round(uv * (9, 6))) > 1e-3).all(axis=-1)
    want = sample_image(PICTURE, uv, ("mirror", "clamp"), nearest=True)
    np.testing.assert_allclose(got[inside][:, :3], want[inside], atol=1e-6)


FILTERS = [
    "linear",
    "nearest",
    "linear_mipmap_linear",
    "linear_mipmap_nearest",
    "nearest_mipmap_linear",
    "nearest_mipmap_nearest",
]


@pytest.mark.parametrize("lod", [1, 1.3, 1.7, 2])
@pytest.mark.parametrize("name", FILTERS)
def test_filters_of_texels_smaller_than_a_pixel(renderer, name, lod):
    """At 2^lod texels for each pixel the level is exact (GL 4.6 section 8.14); a level is a mean of 2 x 2 texels."""
    picture = np.random.default_rng(11).random((64, 64, 3)).astype(np.float32)
    levels = [picture.astype(float)]
    for _ in range(3):
        levels.append(levels[-1].reshape(len(levels[-1]) // 2, 2, -1, 2, 3).mean(axis=(1, 3)))
    side = 8 * 2.0**lod / 64  # of the picture, in 8 x 8 pixels
    uvs = CORNERS * side + 0.013
    scene = cc.Scene()
    scene.add(quad(uvs), cc.BasicMaterial(map=cc.Image(picture, min_filter=name)))
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 2), target=(0, 0, 0))
    got = renderer.render(scene, camera, (8, 8), format="rgba32f").color[..., :3]
    at = (np.arange(8) + 0.5) / 8 * side + 0.013
    uv = np.stack(np.meshgrid(at, at[::-1]), axis=-1)
    first, _, between = name.partition("_mipmap_")
    if between == "nearest":
        weights = {int(np.ceil(lod + 0.5) - 1): 1.0}
    elif between == "linear":
        low = int(np.floor(lod))
        weights = {low: 1 - (lod - low), low + 1: lod - low}
    else:
        weights = {0: 1.0}
    want = sum(
        w * sample_image(levels[k], uv, nearest=first == "nearest") for k, w in weights.items()
    )
    # llvmpipe takes the logarithm piece by piece, straight between powers of two.
    np.testing.assert_allclose(got, want, atol=0.02 if between == "linear" and lod % 1 else 1e-3)


def test_what_a_sampler_says():
    image = cc.Image(PICTURE)
    assert (image.wrap, image.mag_filter, image.min_filter, image.mipmaps) == (
        "repeat",
        "linear",
        "linear",
        False,
    )
    image = cc.Image(PICTURE, mipmaps=True, wrap=("clamp", "mirror"), mag_filter="nearest")
    assert (image.wrap, image.mag_filter) == (("clamp", "mirror"), "nearest")
    assert (image.min_filter, image.mipmaps) == ("linear_mipmap_linear", True)
    assert cc.Image(PICTURE, min_filter="nearest_mipmap_linear").mipmaps
    assert cc.Image(PICTURE, wrap=("clamp", "clamp")).wrap == "clamp"
    again = pickle.loads(pickle.dumps(image))
    for name in ("wrap", "mag_filter", "min_filter", "mipmaps"):
        assert getattr(again, name) == getattr(image, name)


@pytest.mark.parametrize(
    ("error", "message", "given"),
    [
        (ValueError, "expected wrap 'repeat', 'clamp' or 'mirror', got 'edge'", {"wrap": "edge"}),
        (ValueError, "expected wrap .*, got 'edge'", {"wrap": ("clamp", "edge")}),
        (TypeError, "wrap: expected a name or a pair of names.*, got int", {"wrap": ("clamp", 3)}),
        (TypeError, "wrap: expected a name or a pair of names.*, got tuple", {"wrap": ("clamp",)}),
        (TypeError, "wrap: expected a name or a pair of names.*, got float", {"wrap": 1.0}),
        (
            ValueError,
            'mag_filter: expected "linear", "nearest", got "cubic"',
            {"mag_filter": "cubic"},
        ),
        (ValueError, 'min_filter: expected "linear", .*, got "cubic"', {"min_filter": "cubic"}),
        (
            ValueError,
            "expected a min_filter of mip levels with mipmaps=True, got 'nearest'",
            {"min_filter": "nearest", "mipmaps": True},
        ),
    ],
)
def test_samplers_that_are_refused(error, message, given):
    with pytest.raises(error, match=message):
        cc.Image(PICTURE, **given)


def test_color_times_map(renderer):
    got, hits, mask = seen(
        renderer, quad(CORNERS), cc.BasicMaterial(color=(0.5, 2, 0.25), map=PICTURE)
    )
    assert_close(
        got[..., :3], sample_image(PICTURE, hits.uv[mask]) * [0.5, 2, 0.25], "unorm8_filter"
    )


def test_perspective_correct(renderer):
    """On a square seen at a slant uvs are interpolated over the surface, not over the screen."""
    view = perspective((0.2, 0.1, 2.2), (0, 0, 0), size=(48, 48))
    got, hits, mask = seen(
        renderer, quad(CORNERS), cc.BasicMaterial(map=PICTURE), view, axis=(1, 1, 0), degrees=55
    )
    assert_close(got[..., :3], sample_image(PICTURE, hits.uv[mask]), "unorm8_filter")


@pytest.mark.parametrize("width", [3, 4])
def test_vertex_colors(renderer, width):
    colors = np.ones((4, 4))
    colors[:, :3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]]
    mesh = quad(colors=colors[:, :width])
    got, hits, mask = seen(renderer, mesh, cc.BasicMaterial(vertex_colors=True, color=(1, 0.5, 1)))
    assert_close(got[..., :3], hits.color[mask][:, :3] * [1, 0.5, 1], "shaded")


def test_vertex_colors_are_off_by_default(renderer):
    got, *_ = seen(renderer, quad(colors=np.zeros((4, 3))), cc.BasicMaterial())
    assert (got == 1).all()


def test_a_map_without_uvs_is_refused_or_one_texel(renderer):
    """An error and one texel are both allowed; a crash or random pixels are not."""
    scene = cc.Scene()
    try:
        scene.add(quad(), cc.BasicMaterial(map=PICTURE))
        color = renderer.capture(scene, position=(0, 0, 1), size=8, format="rgba32f").faces
    except ValueError as error:
        assert "uv" in str(error)  # noqa: PT017
    else:
        assert len(np.unique(color[color[..., 3] == 1], axis=0)) <= 2


def test_mipmaps_average_far_away(renderer):
    picture = np.random.default_rng(10).integers(0, 2, (128, 128, 3)).astype(np.float32)
    spread = {}
    for mipmaps in (False, True):
        scene = cc.Scene()
        scene.add(quad(CORNERS), cc.BasicMaterial(map=cc.Image(picture, mipmaps=mipmaps)))
        camera = cc.OrthographicCamera(height=2, position=(0, 0, 2), target=(0, 0, 0))
        spread[mipmaps] = (
            renderer.render(scene, camera, (8, 8), format="rgba32f").color[..., :3].std()
        )
    assert spread[True] < 0.1 < 0.2 < spread[False]


def test_maps_are_linear_numbers(renderer):
    """There is no hidden sRGB decoding: 128 is 128/255."""
    got, *_ = seen(renderer, quad(CORNERS), cc.BasicMaterial(map=np.full((2, 2, 3), 128, np.uint8)))
    np.testing.assert_allclose(got[..., :3], 128 / 255, atol=1e-6)


def test_a_huge_picture_is_refused_with_the_limit(renderer):
    limit = renderer.info.limits.max_texture_size
    scene = cc.Scene()
    scene.add(quad(CORNERS), cc.BasicMaterial(map=np.zeros((1, limit + 1, 1), np.uint8)))
    with pytest.raises(ValueError, match=str(limit)):
        renderer.capture(scene, position=(0, 0, 1), size=4)
