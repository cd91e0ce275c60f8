"""cc.Texture: a picture with its place, as KHR_texture_transform of glTF places it."""

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc

PIXELS = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)


def placed(uv, offset, rotation, scale):
    """T * R * S from the text of the extension, in homogeneous coordinates, with v upwards."""
    a = np.radians(rotation)
    t = np.array([[1, 0, offset[0]], [0, 1, offset[1]], [0, 0, 1]])
    r = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    s = np.diag([*scale, 1])
    return (t @ r @ s @ [*uv, 1])[:2]


@pytest.mark.parametrize(
    ("offset", "rotation", "scale"),
    [
        ((0, 0), 0, (1, 1)),
        ((0.25, -3), 0, (2, 0.5)),
        ((0.1, 0.7), 30, (-1, 3)),
        ((0, 1), -725, (0, 1)),
    ],
)
def test_the_matrix_is_scale_then_rotation_then_offset(offset, rotation, scale):
    texture = cc.Texture(PIXELS, offset=offset, rotation=rotation, scale=scale)
    assert texture.matrix.shape == (2, 3)
    for uv in ((0, 0), (1, 0), (0, 1), (0.3, 0.9)):
        want = placed(uv, offset, rotation, scale)
        np.testing.assert_allclose(texture.matrix @ [*uv, 1], want, atol=1e-6)


def test_the_conversion_from_gltf_in_the_docstring():
    """glTF counts v downwards: a picture placed by its offset there lies at the same pixels here."""
    (x, y), rotation, (sx, sy) = (0.2, 0.3), 40.0, (2.0, 3.0)
    sine, cosine = np.sin(np.radians(rotation)), np.cos(np.radians(rotation))
    here = cc.Texture(
        PIXELS, offset=(x + sine * sy, 1 - y - cosine * sy), rotation=rotation, scale=(sx, sy)
    )
    for u, v_down in ((0, 0), (0.4, 0.1), (1, 0.8)):
        # counter-clockwise for a reader who sees v pointing downwards
        there = np.array(
            [cosine * sx * u + sine * sy * v_down + x, -sine * sx * u + cosine * sy * v_down + y]
        )
        got = here.matrix @ [u, 1 - v_down, 1]
        np.testing.assert_allclose([got[0], 1 - got[1]], there, atol=1e-6)


@pytest.mark.parametrize("quarters", [-5, -1, 1, 2, 3, 4, 400])
def test_quarter_turns_are_exact(quarters):
    turned = cc.Texture(PIXELS, rotation=90 * quarters).matrix[:, :2]
    np.testing.assert_array_equal(turned, np.linalg.matrix_power([[0, -1], [1, 0]], quarters % 4))


def test_values_that_are_read_are_those_that_were_given():
    texture = cc.Texture(PIXELS, uv_set=1, offset=[0.1, 0.2], rotation=12.5, scale=np.array([3, 4]))
    assert (texture.uv_set, texture.offset, texture.rotation, texture.scale) == (
        1,
        (0.1, 0.2),
        12.5,
        (3.0, 4.0),
    )
    assert isinstance(texture.source, cc.Image)
    np.testing.assert_array_equal(texture.source.pixels, PIXELS)
    assert cc.Texture(texture.source).source is texture.source
    assert repr(texture).endswith(
        "srgb), uv_set=1, offset=(0.1, 0.2), rotation=12.5, scale=(3, 4))"
    )
    with pytest.raises(AttributeError):
        texture.rotation = 3  # type: ignore[misc]


def test_textures_are_compared_by_picture_and_numbers():
    image = cc.Image(PIXELS)
    one = cc.Texture(image, offset=(1, 2))
    assert one == cc.Texture(image, offset=(1, 2))
    assert hash(one) == hash(cc.Texture(image, offset=(1, 2)))
    for other in (
        cc.Texture(image),
        cc.Texture(cc.Image(PIXELS), offset=(1, 2)),
        cc.Texture(image, offset=(1, 2), uv_set=1),
        cc.Texture(image, offset=(1, 2), rotation=1),
        cc.Texture(image, offset=(1, 2), scale=(1, 2)),
        image,
        None,
    ):
        assert one != other


def test_copies_and_pickles():
    texture = cc.Texture(cc.Image(PIXELS), uv_set=1, rotation=30)
    assert copy.copy(texture) == texture == copy.deepcopy(texture)
    again = pickle.loads(pickle.dumps(texture))
    np.testing.assert_array_equal(again.source.pixels, PIXELS)
    assert (again.uv_set, again.rotation, again.offset, again.scale) == (1, 30, (0, 0), (1, 1))


def test_a_render_texture_may_be_the_source():
    shown = cc.RenderTexture(cc.Scene(), cc.PerspectiveCamera(), size=(3, 4))
    assert cc.Texture(shown).source is shown


@pytest.mark.parametrize(
    ("error", "message", "given"),
    [
        (
            TypeError,
            "source: expected an Image, an array .* or a RenderTexture, got None",
            {"source": None},
        ),
        (TypeError, "source: expected an Image.*, got str", {"source": "wood.png"}),
        (
            TypeError,
            "source: expected an Image.* without a place, got Texture",
            {"source": cc.Texture(PIXELS)},
        ),
        (ValueError, "uv_set: expected an int from 0 to 1, got 2", {"uv_set": 2}),
        (TypeError, "uv_set: expected an int, got 0.5", {"uv_set": 0.5}),
        (ValueError, r"offset: expected shape \(2,\)", {"offset": (1, 2, 3)}),
        (ValueError, "offset.*nan", {"offset": (0, np.nan)}),
        (ValueError, "expected rotation finite.*, got inf", {"rotation": np.inf}),
        (ValueError, r"scale: expected shape \(2,\)", {"scale": 2}),
        (ValueError, "scale.*float32", {"scale": (1e39, 1)}),
    ],
)
def test_wrong_arguments_are_errors(error, message, given):
    arguments = {"source": PIXELS, **given}
    source = arguments.pop("source")
    with pytest.raises(error, match=message):
        cc.Texture(source, **arguments)


def test_materials_with_one_map_take_no_place():
    place: Any = cc.Texture(PIXELS)
    for make in (cc.BasicMaterial, cc.PhongMaterial):
        with pytest.raises(
            TypeError, match=r"map: expected an Image.* without a place, got Texture"
        ):
            make(map=place)
